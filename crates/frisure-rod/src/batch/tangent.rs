//! How many rods at rest move with their parameters, in lanes.

use fearless_simd::{Level, dispatch};
use glam::{DMat3, DVec3};

use super::division::Joints;
use super::gradient::half_strains;
use super::lanes::Lanes;
use super::linear::Vec3;
use super::rod_lanes::is_minimum;
use super::solution::BatchSolution;
use super::solver::{Batch, f64s, uniform};
use super::tangent_sweep::{TangentBundle, TangentDirection};
use crate::chain::Chain;
use crate::derivatives::{DerivativeError, ParameterChange, Sensitivity};
use crate::minimise::{Problem, Stability};
use crate::resolution::ElementKind;
use crate::rod::Rod;

/// A change of the parameters of rods, the same for each; zero by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Direction {
    /// Change of the natural strain (rad/m): one all along, or one for each half of an element; empty for none.
    pub natural_strain: Vec<DVec3>,
    /// Relative change of the stiffnesses E I1, E I2, μ J.
    pub stiffness: DVec3,
    /// Relative change of the load per length.
    pub weight: f64,
    /// Relative change of the length: all elements become longer in proportion, each with its natural strain.
    pub length: f64,
    /// Rotation of the root's frame (rad, world) about the root.
    pub root_rotation: DVec3,
}

/// A node of a rod, or how it moves.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodeMotion {
    /// Shift (m, world).
    pub shift: DVec3,
    /// Rotation of its frame (rad, world).
    pub rotation: DVec3,
}

/// How the nodes of rods move along directions of their parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchTangents {
    /// Elements of each rod.
    pub elements: usize,
    /// How many directions there are.
    pub directions: usize,
    /// Position (m) and frame of each node, those of a rod one after the other, the root first.
    pub nodes: Vec<(DVec3, DMat3)>,
    /// How each node moves along a direction; those of a rod one direction after the other.
    pub motions: Vec<NodeMotion>,
    /// Why a rod has no derivatives; its motions are zero then.
    pub existence: Vec<Result<(), DerivativeError>>,
}

impl BatchTangents {
    /// Positions (m) and frames of the nodes of a rod, the root first.
    ///
    /// # Panics
    /// If there is no rod of that index.
    #[must_use]
    pub fn nodes(&self, rod: usize) -> &[(DVec3, DMat3)] {
        let n = self.elements + 1;
        &self.nodes[rod * n..(rod + 1) * n]
    }

    /// How the nodes of a rod move along a direction, the root first; the root's position stays.
    ///
    /// # Panics
    /// If there is no rod or no direction of that index.
    #[must_use]
    pub fn motions(&self, rod: usize, direction: usize) -> &[NodeMotion] {
        assert!(direction < self.directions, "one of the directions");
        let n = self.elements + 1;
        let first = (rod * self.directions + direction) * n;
        &self.motions[first..first + n]
    }
}

impl Batch {
    /// How the nodes of rods at rest move along changes of their parameters, computed on this thread: what
    /// [`Sensitivity::jvp`] gives for each. docs/theory.md, "Rods in lanes", (L14) to (L16)
    ///
    /// `found` is what [`Self::solve`] gave for the same rods. The Hessian of a rod is factorised once; a direction then takes two
    /// linear passes. Where the shape is no minimum the rod has no derivatives.
    ///
    /// ```
    /// use frisure_rod::batch::{Batch, Direction};
    /// use frisure_rod::{
    ///     Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant,
    /// };
    /// use glam::DVec3;
    ///
    /// let rod = Rod::new(RodSpec {
    ///     length: 0.1,
    ///     section: Section::circular(35e-6)?,
    ///     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
    ///     torsion: TorsionConstant::SaintVenant,
    ///     natural: NaturalStrain::helix(0.01, 0.02)?,
    ///     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
    ///     load: Load::down(9.81),
    /// })?;
    /// let (rods, batch) = ([rod], Batch { tolerance: 1e-10, ..Batch::default() });
    /// let found = batch.solve(&rods);
    /// let heavier = Direction { weight: 1.0, ..Direction::default() };
    /// let moved = batch.jvp(&rods, &found, &[heavier]);
    /// assert!(moved.motions(0, 0)[15].shift.z < 0.0); // the tip sinks
    /// # Ok::<(), frisure_rod::InvalidQuantity>(())
    /// ```
    ///
    /// # Panics
    /// If the rods are not as many as were solved, or a direction has neither no natural strain, nor one, nor one for each half of
    /// an element.
    #[must_use]
    pub fn jvp(
        &self,
        rods: &[Rod],
        found: &BatchSolution,
        directions: &[Direction],
    ) -> BatchTangents {
        let n = found.elements;
        assert_eq!(rods.len(), found.rods.len(), "the rods that were solved");
        for direction in directions {
            let given = direction.natural_strain.len();
            assert!(given <= 1 || given == 2 * n, "a strain for each half of an element");
        }
        let motions = rods.len() * directions.len() * (n + 1);
        let mut tangents = BatchTangents {
            elements: n,
            directions: directions.len(),
            nodes: vec![(DVec3::ZERO, DMat3::IDENTITY); rods.len() * (n + 1)],
            motions: vec![NodeMotion::default(); motions],
            existence: vec![Ok(()); rods.len()],
        };
        dispatch!(Level::new(), simd => in_lanes(f64s(simd), rods, found, directions, &mut tangents));
        tangents
    }
}

#[inline(always)]
fn in_lanes<F: Lanes>(
    zero: F,
    rods: &[Rod],
    found: &BatchSolution,
    directions: &[Direction],
    tangents: &mut BatchTangents,
) {
    let n = found.elements;
    let mut bundle = TangentBundle::new(zero, n, uniform(rods));
    let mut columns: Vec<TangentDirection<F>> =
        directions.iter().map(|direction| column(zero, n, uniform(rods), direction)).collect();
    let mut joints = Joints::default();
    let mut strains = Vec::new();
    for first in (0..rods.len()).step_by(F::LANES) {
        let lanes = F::LANES.min(rods.len() - first);
        // 1. Rods into lanes. A lane without a rod keeps the one before.
        for (lane, rod) in (0..lanes).zip(first..) {
            joints.divide(&rods[rod], n);
            load(&mut bundle, lane, (&rods[rod], rod), &joints, found);
            half_strains(&rods[rod], n, &mut strains);
            for (column, direction) in columns.iter_mut().zip(directions) {
                set(column, lane, direction, &rods[rod], &joints, &strains);
            }
        }
        // 2. The factors, and whether they hold.
        let result = bundle.factorise();
        for (lane, rod) in (0..lanes).zip(first..) {
            let exists = is_minimum(&result, lane, &rods[rod]);
            tangents.existence[rod] =
                if exists { Ok(()) } else { Err(DerivativeError::NotAMinimum) };
        }
        bundle.shape(|node, position, frame| {
            for (lane, rod) in (0..lanes).zip(first..) {
                let root = rods[rod].root().position();
                tangents.nodes[rod * (n + 1) + node] = (root + position.get(lane), frame.get(lane));
            }
        });
        // 3. Each direction, out of the lanes.
        for (k, column) in columns.iter().enumerate() {
            bundle.along(column, |node, shift, rotation| {
                for (lane, rod) in (0..lanes).zip(first..) {
                    if tangents.existence[rod].is_ok() {
                        let index = (rod * directions.len() + k) * (n + 1) + node;
                        tangents.motions[index] =
                            NodeMotion { shift: shift.get(lane), rotation: rotation.get(lane) };
                    }
                }
            });
        }
        // 4. By itself: a rod that is not at rest to rounding, or has no derivatives.
        for (_, rod) in (0..lanes).zip(first..) {
            let at_rest = found.rods[rod].stability != Stability::NotConverged;
            if tangents.existence[rod].is_err() && at_rest {
                tangents.existence[rod] = alone(&rods[rod], found, rod, directions, tangents);
            }
        }
    }
}

/// Space for a direction of the rods in the lanes.
#[inline(always)]
fn column<F: Lanes>(
    zero: F,
    n: usize,
    uniform: bool,
    direction: &Direction,
) -> TangentDirection<F> {
    let none = Vec3::splat(zero);
    // A longer rod has more of its own strain, which may vary.
    let turns = match (direction.natural_strain.len(), direction.length != 0.0) {
        (0, false) => 0,
        (0, true) if uniform => 1,
        (1, longer) if uniform || !longer => 1,
        _ => n,
    };
    TangentDirection {
        turns: vec![[none; 2]; turns],
        stiffness: none,
        weight: zero,
        rotation: none,
        magnification: zero,
    }
}

/// Sets the direction of one lane.
#[inline(always)]
fn set<F: Lanes>(
    column: &mut TangentDirection<F>,
    lane: usize,
    direction: &Direction,
    rod: &Rod,
    joints: &Joints,
    strains: &[DVec3],
) {
    let half = 0.5 * joints.h;
    let given = |half: usize| match direction.natural_strain.as_slice() {
        [] => DVec3::ZERO,
        [same] => *same,
        halves => halves[half],
    };
    for (i, turns) in column.turns.iter_mut().enumerate() {
        for (k, turn) in turns.iter_mut().enumerate() {
            let change = given(2 * i + k) + strains[2 * i + k] * direction.length;
            turn.set(lane, change * half);
        }
    }
    column.stiffness.set(lane, direction.stiffness * joints.stiffness);
    // A longer rod is a larger picture of one with more strain and load. docs/theory.md (D5)
    column.weight.set(lane, (direction.weight + 3.0 * direction.length) * rod.weight());
    column.rotation.set(lane, direction.root_rotation);
    column.magnification.set(lane, direction.length);
}

#[inline(always)]
fn load<F: Lanes>(
    bundle: &mut TangentBundle<F>,
    lane: usize,
    (rod, index): (&Rod, usize),
    joints: &Joints,
    found: &BatchSolution,
) {
    let n = found.elements;
    bundle.rods.set(lane, rod, joints);
    let controls = &found.controls[index * n..(index + 1) * n];
    for (i, (joint, control)) in bundle.joints.iter_mut().zip(controls).enumerate() {
        joint.arm.set(lane, joints.arms[i]);
        joint.control.set(lane, *control);
    }
}

/// A rod by itself, by the scalar code.
fn alone(
    rod: &Rod,
    found: &BatchSolution,
    index: usize,
    directions: &[Direction],
    tangents: &mut BatchTangents,
) -> Result<(), DerivativeError> {
    let n = found.elements;
    let chain = Chain::uniform(rod, ElementKind::Jointed, n);
    let at = Sensitivity::new(&Problem::new(&chain, &[]), found.shape(rod, index))?;
    let shape = at.shape();
    let nodes = shape.positions.iter().copied().zip(shape.frames.iter().copied());
    for (place, node) in tangents.nodes[index * (n + 1)..].iter_mut().zip(nodes) {
        *place = node;
    }
    for (k, direction) in directions.iter().enumerate() {
        let halves = match direction.natural_strain.as_slice() {
            [] => Vec::new(),
            [same] => vec![[*same; 2]; n],
            halves => halves.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect(),
        };
        let change = ParameterChange {
            natural_strain: Vec::new(),
            length: direction.length * rod.length(),
            stiffness: direction.stiffness * rod.stiffness(),
            load: rod.load() * direction.weight,
            root_position: DVec3::ZERO,
            root_rotation: direction.root_rotation,
        };
        let moved = at.jvp_with_halves(&change, &halves)?;
        let first = (index * directions.len() + k) * (n + 1);
        let both = moved.positions.iter().zip(&moved.rotations);
        for (place, (shift, rotation)) in tangents.motions[first..].iter_mut().zip(both) {
            *place = NodeMotion { shift: *shift, rotation: *rotation };
        }
    }
    Ok(())
}
