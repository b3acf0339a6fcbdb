//! Derivatives of many rods at rest, in lanes.

use fearless_simd::{Level, dispatch};
use glam::DVec3;

use super::adjoint_sweep::AdjointBundle;
use super::division::Joints;
use super::lanes::Lanes;
use super::rod_lanes::is_minimum;
use super::solution::BatchSolution;
use super::solver::{Batch, f64s, uniform};
use crate::chain::Chain;
use crate::derivatives::{
    DerivativeError, LEAST_EIGENVALUE, ParameterGradient, Regularity, Sensitivity, ShapeChange,
};
use crate::minimise::Problem;
use crate::resolution::ElementKind;
use crate::rod::Rod;
use crate::strain::NaturalStrain;

/// The derivatives of a loss by the parameters of one rod of a batch; units as in [`ParameterGradient`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodGradient {
    /// By the length.
    pub length: f64,
    /// By the stiffnesses E I1, E I2, μ J.
    pub stiffness: DVec3,
    /// By the load per length.
    pub load: DVec3,
    /// By the root's position.
    pub root_position: DVec3,
    /// By a rotation of the root's frame about the root.
    pub root_rotation: DVec3,
    /// At least the smallest eigenvalue of [`crate::Certificate::min_eigenvalue`], along what the loss asks of the shape: the
    /// derivatives grow as one over it.
    pub eigenvalue_bound: f64,
    /// How far the derivatives can be relied on; where there are none, they are zero.
    pub regularity: Result<Regularity, DerivativeError>,
}

/// The derivatives of a loss by the parameters of rods.
#[derive(Clone, Debug, PartialEq)]
pub struct BatchGradient {
    /// Elements of each rod.
    pub elements: usize,
    /// By the natural strain (rad/m) of both halves of each element, those of a rod one after the other.
    pub natural_strain: Vec<[DVec3; 2]>,
    /// One for each rod.
    pub rods: Vec<RodGradient>,
}

impl RodGradient {
    /// Of a rod that has no derivatives.
    fn none(error: DerivativeError) -> Self {
        Self {
            length: 0.0,
            stiffness: DVec3::ZERO,
            load: DVec3::ZERO,
            root_position: DVec3::ZERO,
            root_rotation: DVec3::ZERO,
            eigenvalue_bound: 0.0,
            regularity: Err(error),
        }
    }
}

impl BatchGradient {
    /// The gradient of one rod.
    ///
    /// # Panics
    /// If there is no rod of that index.
    #[must_use]
    pub fn of(&self, index: usize) -> ParameterGradient {
        let (n, rod) = (self.elements, &self.rods[index]);
        ParameterGradient {
            natural_strain: self.natural_strain[index * n..(index + 1) * n]
                .iter()
                .map(|[before, after]| *before + *after)
                .collect(),
            length: Some(rod.length),
            stiffness: rod.stiffness,
            load: rod.load,
            root_position: rod.root_position,
            root_rotation: rod.root_rotation,
        }
    }
}

/// The derivatives of a loss by the shapes and the energies of rods at rest; each list is empty for none.
#[derive(Clone, Copy, Debug, Default)]
pub struct BatchLoss<'a> {
    /// By the position of each node (loss per m, world), one more for each rod than elements, those of a rod one after the other,
    /// the root first.
    pub positions: &'a [DVec3],
    /// By a rotation of the frame at each node (loss per rad, world).
    pub frames: &'a [DVec3],
    /// By the energy of each rod (loss per J), elastic and of the weight.
    pub energies: &'a [f64],
}

impl<'a> BatchLoss<'a> {
    /// Of the positions of the nodes alone.
    #[must_use]
    pub fn of_positions(positions: &'a [DVec3]) -> Self {
        Self { positions, ..Self::default() }
    }
}

/// The loss of a call, and how many nodes each rod has.
#[derive(Clone, Copy)]
pub(super) struct Loss<'a> {
    of: BatchLoss<'a>,
    nodes: usize,
}

impl Loss<'_> {
    /// That of nothing, of rods of `n` elements.
    pub(super) fn none(n: usize) -> Self {
        Self { of: BatchLoss::default(), nodes: n + 1 }
    }

    fn position(&self, rod: usize, node: usize) -> DVec3 {
        self.of.positions.get(rod * self.nodes + node).copied().unwrap_or(DVec3::ZERO)
    }

    fn frame(&self, rod: usize, node: usize) -> DVec3 {
        self.of.frames.get(rod * self.nodes + node).copied().unwrap_or(DVec3::ZERO)
    }

    fn energy(&self, rod: usize) -> f64 {
        self.of.energies.get(rod).copied().unwrap_or_default()
    }
}

impl Batch {
    /// The derivatives of a loss of rods at rest by the rods' parameters, computed on this thread: what [`Sensitivity::vjp`] and
    /// [`Sensitivity::by_energy`] give for each. docs/theory.md, "Rods in lanes", (L11) to (L13)
    ///
    /// `found` is what [`Self::solve`] gave for the same rods, best with a [`Self::tolerance`] of 1e-10: a rod farther from rest
    /// than 1e-9 goes to [`Sensitivity`], which is slower.
    ///
    /// ```
    /// use frisure_rod::batch::{Batch, BatchLoss};
    /// use frisure_rod::{Material, NaturalStrain, Rod, RodSpec, Load, Root, Section, TorsionConstant};
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
    /// // The height of the tip grows with stiffness, and falls with weight.
    /// let mut loss = vec![DVec3::ZERO; 16];
    /// loss[15] = DVec3::Z;
    /// let gradient = batch.vjp(&rods, &found, BatchLoss::of_positions(&loss)).of(0);
    /// let [by_density, by_youngs_modulus, _] = gradient.material(&rods[0]);
    /// assert!(by_density < 0.0 && by_youngs_modulus > 0.0);
    /// # Ok::<(), frisure_rod::InvalidQuantity>(())
    /// ```
    ///
    /// # Panics
    /// If the rods are not as many as were solved, or a list of the loss has neither one entry for each node or rod, nor none.
    #[must_use]
    pub fn vjp(&self, rods: &[Rod], found: &BatchSolution, loss: BatchLoss<'_>) -> BatchGradient {
        let n = found.elements;
        assert_eq!(rods.len(), found.rods.len(), "the rods that were solved");
        for vectors in [loss.positions, loss.frames] {
            let all = vectors.is_empty() || vectors.len() == rods.len() * (n + 1);
            assert!(all, "one vector for each node, or none");
        }
        let energies = loss.energies.len();
        assert!(energies == 0 || energies == rods.len(), "one number for each rod, or none");
        let none = RodGradient::none(DerivativeError::NotAMinimum);
        let mut gradient = BatchGradient {
            elements: n,
            natural_strain: vec![[DVec3::ZERO; 2]; rods.len() * n],
            rods: vec![none; rods.len()],
        };
        let loss = Loss { of: loss, nodes: n + 1 };
        dispatch!(Level::new(), simd => in_lanes(f64s(simd), rods, found, loss, &mut gradient));
        gradient
    }
}

#[inline(always)]
fn in_lanes<F: Lanes>(
    zero: F,
    rods: &[Rod],
    found: &BatchSolution,
    loss: Loss<'_>,
    gradient: &mut BatchGradient,
) {
    let n = found.elements;
    let mut bundle = AdjointBundle::new(zero, n, uniform(rods));
    let mut joints = Joints::default();
    let mut strains = Vec::new();
    for first in (0..rods.len()).step_by(F::LANES) {
        let lanes = F::LANES.min(rods.len() - first);
        // 1. Rods into lanes. A lane without a rod keeps the one before.
        for (lane, rod) in (0..lanes).zip(first..) {
            joints.divide(&rods[rod], n);
            load(&mut bundle, lane, (&rods[rod], rod), &joints, found, loss);
        }
        // 2. The adjoint and its products.
        let (sums, result, above) = bundle.solve(LEAST_EIGENVALUE);
        // 3. Out of them.
        for (lane, rod) in (0..lanes).zip(first..) {
            let natural_strain = &mut gradient.natural_strain[rod * n..(rod + 1) * n];
            if !is_minimum(&result, lane, &rods[rod]) {
                gradient.rods[rod] = alone(&rods[rod], found, rod, loss, natural_strain);
                continue;
            }
            half_strains(&rods[rod], n, &mut strains);
            let mut by_scale = 0.0;
            for (i, joint) in bundle.joints.iter().enumerate() {
                let halves = joint.by_strain.map(|by| by.get(lane));
                natural_strain[i] = halves;
                by_scale += strains[2 * i].dot(halves[0]) + strains[2 * i + 1].dot(halves[1]);
            }
            // As [`Sensitivity::vjp`].
            let weight = rods[rod].load();
            let load = sums.load.get(lane);
            let turned = sums.torque.get(lane) + loss.frame(rod, 0);
            // Of the energy E = E_el + E_g, by_scale + 2 E_g − E_el = by_scale + 3 E_g − E, and 3 E_g is in the load. (D5)
            let energy = loss.energy(rod) * found.rods[rod].energy;
            let stretched =
                sums.magnification.get(lane) + by_scale + 3.0 * weight.dot(load) - energy;
            let bound = sums.curvature.get(lane) / sums.elastic.get(lane);
            // A loss that asks nothing has no adjoint: its derivatives are zero, whatever the stability.
            let eigenvalue_bound = if bound.is_nan() { 1.0 } else { bound };
            gradient.rods[rod] = RodGradient {
                length: stretched / rods[rod].length(),
                stiffness: sums.bent.get(lane) / bundle.rods.spacing.get(lane),
                load,
                root_position: sums.force.get(lane) + loss.position(rod, 0),
                root_rotation: turned - weight.cross(load),
                eigenvalue_bound,
                regularity: Ok(match above.get(lane) > 0.0 {
                    true => Regularity::Regular,
                    false => Regularity::IllConditioned,
                }),
            };
        }
    }
}

/// The natural strain of both halves of each element (rad/m).
pub(super) fn half_strains(rod: &Rod, n: usize, strains: &mut Vec<DVec3>) {
    strains.clear();
    match rod.natural() {
        NaturalStrain::Uniform(strain) => strains.resize(2 * n, *strain),
        natural @ NaturalStrain::Varying(_) => {
            strains.extend(natural.means(0.5 * rod.length() / n as f64).take(2 * n));
        }
    }
}

#[inline(always)]
pub(super) fn load<F: Lanes>(
    bundle: &mut AdjointBundle<F>,
    lane: usize,
    (rod, index): (&Rod, usize),
    joints: &Joints,
    found: &BatchSolution,
    loss: Loss<'_>,
) {
    let n = found.elements;
    bundle.rods.set(lane, rod, joints);
    bundle.by_energy.set(lane, loss.energy(index));
    let controls = &found.controls[index * n..(index + 1) * n];
    for (i, (joint, control)) in bundle.joints.iter_mut().zip(controls).enumerate() {
        joint.arm.set(lane, joints.arms[i]);
        joint.control.set(lane, *control);
        joint.by_position.set(lane, loss.position(index, i + 1));
        joint.by_frame.set(lane, loss.frame(index, i + 1));
    }
}

/// A rod by itself: one that is not at rest to rounding, or has no derivatives.
fn alone(
    rod: &Rod,
    found: &BatchSolution,
    index: usize,
    loss: Loss<'_>,
    natural_strain: &mut [[DVec3; 2]],
) -> RodGradient {
    let by_nodes = ShapeChange {
        positions: (0..loss.nodes).map(|node| loss.position(index, node)).collect(),
        rotations: (0..loss.nodes).map(|node| loss.frame(index, node)).collect(),
    };
    let by_energy = loss.energy(index);
    let chain = Chain::uniform(rod, ElementKind::Jointed, found.elements);
    let at = Sensitivity::new(&Problem::new(&chain, &[]), found.shape(rod, index));
    let both = at.and_then(|at| Ok((at.vjp_with_halves(&by_nodes)?, at)));
    match both {
        Ok(((by, halves), at)) => {
            let (energy, of_energy) = at.by_energy_with_halves();
            let pairs = halves.iter().zip(&of_energy);
            for (place, (by, of)) in natural_strain.iter_mut().zip(pairs) {
                *place = [by[0] + of[0] * by_energy, by[1] + of[1] * by_energy];
            }
            let length = |of: &ParameterGradient| of.length.unwrap_or_default();
            RodGradient {
                length: length(&by) + length(&energy) * by_energy,
                stiffness: by.stiffness + energy.stiffness * by_energy,
                load: by.load + energy.load * by_energy,
                root_position: by.root_position + energy.root_position * by_energy,
                root_rotation: by.root_rotation + energy.root_rotation * by_energy,
                eigenvalue_bound: at.min_eigenvalue(),
                regularity: Ok(at.regularity()),
            }
        }
        Err(error) => RodGradient::none(error),
    }
}
