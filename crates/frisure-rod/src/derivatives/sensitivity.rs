//! A rod at rest and its derivatives, from one second variation.

use glam::DVec3;

use super::pieces::Pieces;
use super::{
    AT_REST, DerivativeError, LEAST_EIGENVALUE, ParameterChange, ParameterGradient, Regularity,
    ShapeChange,
};
use crate::chain::{Chain, Shape};
use crate::minimise::{Energy, NodeChanges, Problem, SecondVariation};
use crate::potential::{Derivatives, ElementState, Potential};

/// Most steps of Newton's method that bring the shape to rest to rounding. A guard; two or three are usual.
const MOST_POLISHES: usize = 12;

/// A rod at rest with the second variation from which all its derivatives follow.
///
/// ```
/// use frisure_rod::derivatives::Sensitivity;
/// use frisure_rod::minimise::Problem;
/// use frisure_rod::{
///     Chain, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Load, Root, Section,
///     TorsionConstant, equilibrium,
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
/// let options = Options { resolution: Resolution::Elements(30), ..Options::default() };
/// let rest = equilibrium(&rod, &[], &options);
/// let chain = Chain::uniform(&rod, rest.element, 30);
/// let at_rest = Sensitivity::new(&Problem::new(&chain, &[]), rest.shape)?;
///
/// // The height of the tip: a heavier fibre hangs lower, a stiffer one higher.
/// let mut loss = vec![DVec3::ZERO; 31];
/// loss[30] = DVec3::Z;
/// let gradient = at_rest.vjp(&loss.into())?;
/// let [by_density, by_youngs_modulus, _] = gradient.material(&rod);
/// assert!(by_density < 0.0 && by_youngs_modulus > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Sensitivity {
    shape: Shape,
    variation: SecondVariation,
    /// Of jointed elements.
    pieces: Option<Pieces>,
    /// Whether no other potentials act than the weight.
    alone: bool,
    energy: Energy,
    length: f64,
    /// K (N m²) and length of an element (m).
    stiffness: DVec3,
    spacing: f64,
    /// Mean natural strain of each element (rad/m).
    natural: Vec<DVec3>,
    /// c − c⁰ of each element (rad).
    bent: Vec<DVec3>,
    /// Gradient by the controls of `∫ e_k·(r − r_root) ds`, for the axes k (m²).
    moments: [Vec<DVec3>; 3],
    /// `∫ (r − r_root) ds` (m²).
    first_moment: DVec3,
    /// Load per length (N/m).
    load: DVec3,
    gradient_norm: f64,
    min_eigenvalue: f64,
}

/// The energy of a load of 1 N/m along a direction: `−∫ F·(r − r_root) ds` with the sign turned.
struct Moment {
    direction: DVec3,
    length: f64,
}

impl Potential for Moment {
    fn depends_on_position(&self) -> bool {
        false
    }

    fn element_energy(&self, e: &ElementState<'_>) -> f64 {
        // As for the weight, [paper] (2.4): each element carries all that is beyond it.
        e.work(self.direction, self.length - e.end, 1.0)
    }

    fn add_element_derivatives(&self, e: &ElementState<'_>, sum: &mut Derivatives) {
        e.add_work_derivatives(self.direction, self.length - e.end, 1.0, sum);
    }
}

impl Sensitivity {
    /// Brings a shape to rest to rounding.
    ///
    /// Other potentials have no parameters here, and move along with the root: a rotation of the root is one of the head
    /// with all that holds the rod, while the load keeps its direction.
    ///
    /// # Errors
    /// [`DerivativeError`], if the shape is no minimum or does not come to rest, or if the elements are jointed and another
    /// potential has no form for their halves.
    pub fn new(problem: &Problem<'_>, shape: Shape) -> Result<Self, DerivativeError> {
        let (shape, variation, gradient_norm) = polished(problem, shape)?;
        Self::from_variation(problem, shape, variation, gradient_norm, 1)
    }

    /// The parts of the derivatives of one of several rods at rest together, which touch each other: of all of them the controls change by what the
    /// coupled equations say, which the caller solves; see [`Self::moments_of`] and [`Self::moments_of_change`]. The rods touch each other at `samples`
    /// points per element, those of [`Chain::sample_points`]. The shape is taken as it is; [`Self::vjp`] and [`Self::jvp`] are those while the others
    /// hold still.
    ///
    /// # Errors
    /// [`DerivativeError::JointedElements`], if the elements are jointed and a potential has no form for their halves.
    pub fn among_others(
        problem: &Problem<'_>,
        shape: Shape,
        samples: u32,
    ) -> Result<Self, DerivativeError> {
        let variation = problem.second_variation(&shape, 1);
        let gradient_norm = relative(problem, &variation);
        Self::from_variation(problem, shape, variation, gradient_norm, samples)
    }

    fn from_variation(
        problem: &Problem<'_>,
        shape: Shape,
        variation: SecondVariation,
        gradient_norm: f64,
        samples: u32,
    ) -> Result<Self, DerivativeError> {
        let chain = problem.chain();
        let rod = chain.rod();
        let axis = |direction: DVec3| {
            let moment = Moment { direction, length: rod.length() };
            let gradient = problem.gradient_of(&moment, &shape);
            (gradient, chain.energy(&shape, &moment))
        };
        let [(x, mx), (y, my), (z, mz)] = [DVec3::X, DVec3::Y, DVec3::Z].map(axis);
        let bent = |(i, c): (usize, &DVec3)| *c - chain.geometry(i).rest();
        let min_eigenvalue = problem.min_eigenvalue(&shape);
        let pieces = Pieces::new(problem, &shape, samples)?;
        let spacing = rod.length() / chain.len() as f64;
        let natural = |i: usize| chain.geometry(i).rest() / spacing;
        Ok(Self {
            alone: problem.external.is_empty(),
            energy: problem.energy(&shape),
            length: rod.length(),
            natural: match &pieces {
                None => (0..chain.len()).map(natural).collect(),
                Some(pieces) => pieces.natural().iter().map(|[a, b]| (*a + *b) * 0.5).collect(),
            },
            pieces,
            stiffness: rod.stiffness(),
            spacing,
            bent: shape.controls.iter().enumerate().map(bent).collect(),
            moments: [x, y, z],
            first_moment: DVec3::new(mx, my, mz),
            load: -problem.gravity.up * problem.gravity.weight,
            shape,
            variation,
            gradient_norm,
            min_eigenvalue,
        })
    }

    /// The shape at rest.
    #[must_use]
    pub fn shape(&self) -> &Shape {
        &self.shape
    }

    /// Largest derivative of the energy by any control, relative to EI/L + ρSgL².
    #[must_use]
    pub fn gradient_norm(&self) -> f64 {
        self.gradient_norm
    }

    /// Smallest eigenvalue, as [`crate::Certificate::min_eigenvalue`]: derivatives of the controls grow as one over it.
    #[must_use]
    pub fn min_eigenvalue(&self) -> f64 {
        self.min_eigenvalue
    }

    /// How far the derivatives can be relied on.
    #[must_use]
    pub fn regularity(&self) -> Regularity {
        if self.min_eigenvalue < LEAST_EIGENVALUE {
            Regularity::IllConditioned
        } else {
            Regularity::Regular
        }
    }

    /// The derivative of a loss by all parameters, from that by the nodes (loss per m and per rad). docs/theory.md (D1), (D2)
    ///
    /// # Errors
    /// [`DerivativeError::Nodes`], if there is not one vector for each node.
    pub fn vjp(&self, by_nodes: &ShapeChange) -> Result<ParameterGradient, DerivativeError> {
        self.vjp_with_halves(by_nodes).map(|(gradient, _)| gradient)
    }

    /// [`Self::vjp`], and the derivatives by the natural strain of both halves of each jointed element; of helix elements there are
    /// none.
    pub(crate) fn vjp_with_halves(
        &self,
        by_nodes: &ShapeChange,
    ) -> Result<(ParameterGradient, Vec<[DVec3; 2]>), DerivativeError> {
        // 1. H a = (∂x/∂c)ᵀ ∂ℓ/∂x.
        let a = self.adjoint(by_nodes)?;
        self.vjp_by_adjoint_with_halves(by_nodes, &a, &[])
    }

    /// [`Self::vjp`] with the solution a (rad per unit of the loss) of the adjoint's equation, one vector for each element: for a rod among others that
    /// of the coupled equations of all, whose right sides are [`Self::moments_of`]. `forces` (N per unit of the loss) is ∂²E/∂x∂x′ δx′ at each sample
    /// point x, with δx′ how the adjoints of all rods move the sample points of all, without what the rod has while the others hold still; empty for
    /// none. Helix elements do not need it. docs/theory.md (D2), (D7), (D8)
    ///
    /// # Errors
    /// [`DerivativeError::Nodes`] and [`DerivativeError::Elements`], if there is not one vector for each.
    ///
    /// # Panics
    /// If elements are jointed and there are forces, but not one for each sample point.
    pub fn vjp_by_adjoint(
        &self,
        by_nodes: &ShapeChange,
        adjoint: &[DVec3],
        forces: &[DVec3],
    ) -> Result<ParameterGradient, DerivativeError> {
        self.vjp_by_adjoint_with_halves(by_nodes, adjoint, forces).map(|(gradient, _)| gradient)
    }

    fn vjp_by_adjoint_with_halves(
        &self,
        by_nodes: &ShapeChange,
        a: &[DVec3],
        forces: &[DVec3],
    ) -> Result<(ParameterGradient, Vec<[DVec3; 2]>), DerivativeError> {
        self.one_per_element(a)?;
        // 2. −aᵀ ∂g/∂p of each parameter. (D3), (D4)
        let ShapeChange { positions, rotations } = by_nodes;
        let by_nodes = self.in_frames(by_nodes)?;
        let halves = self.pieces.as_ref().map(|pieces| {
            let mut halves = pieces.by_strain(&by_nodes, a);
            if !forces.is_empty() {
                // Halves move what is beyond them against the other rods, too. (D8)
                for (sum, by_forces) in halves.iter_mut().zip(pieces.by_forces(forces)) {
                    sum.iter_mut().zip(by_forces).for_each(|(sum, by)| *sum -= by);
                }
            }
            halves
        });
        let natural_strain: Vec<DVec3> = match &halves {
            None => a.iter().map(|a| self.stiffness * *a).collect(),
            Some(halves) => halves.iter().map(|[a, b]| *a + *b).collect(),
        };
        let bent = a.iter().zip(&self.bent).map(|(a, bent)| *a * *bent);
        let stiffness = -bent.sum::<DVec3>() / self.spacing;
        let along = |k: usize| -> f64 {
            a.iter().zip(&self.moments[k]).map(|(a, moment)| a.dot(*moment)).sum()
        };
        let load = DVec3::new(along(0), along(1), along(2));
        // 3. The root moves all nodes; turned, it sees the load turned back.
        let root = self.shape.positions[0];
        let arms = self.shape.positions.iter().map(|x| *x - root);
        let lever = |(arm, g): (DVec3, &DVec3)| arm.cross(*g);
        let turned: DVec3 = arms.clone().zip(positions).map(lever).sum();
        let turned = turned + rotations.iter().sum::<DVec3>();
        // 4. A longer rod is a larger picture of one of the same length with more strain and load. (D5)
        let larger: f64 = arms.zip(positions).map(|(arm, g)| arm.dot(*g)).sum();
        let stretched =
            larger + self.by_scale(&natural_strain, halves.as_deref()) + 3.0 * self.load.dot(load);
        let gradient = ParameterGradient {
            natural_strain,
            length: self.alone.then_some(stretched / self.length),
            stiffness,
            load,
            root_position: positions.iter().sum(),
            root_rotation: turned - self.load.cross(load),
        };
        Ok((gradient, halves.unwrap_or_default()))
    }

    /// The derivative of a loss by numbers of other potentials, from that by the nodes (loss per m and per rad): of each number p the potential ∂E/∂p is
    /// given, on the division `chain` of the rod at rest. For the stiffness of a contact it is the same contact with a stiffness of 1, for its place
    /// the slope of its energy against the shift. docs/theory.md (D6)
    ///
    /// Where the second derivative of the potential jumps, as where a node just touches, the derivative is that of the side on which the rod is.
    ///
    /// # Errors
    /// As [`Self::vjp`]; [`DerivativeError::Elements`], if the division has not as many elements as the rod at rest.
    pub fn vjp_by_potentials(
        &self,
        chain: &Chain<'_>,
        by_nodes: &ShapeChange,
        by_numbers: &[&dyn Potential],
    ) -> Result<Vec<f64>, DerivativeError> {
        let a = self.adjoint(by_nodes)?;
        let along = |by_number: &&dyn Potential| {
            let gradient = self.by_controls(chain, *by_number)?;
            Ok(-a.iter().zip(&gradient).map(|(a, g)| a.dot(*g)).sum::<f64>())
        };
        by_numbers.iter().map(along).collect()
    }

    /// How each node moves per unit of a number p of another potential, of which ∂E/∂p is given: as [`Self::vjp_by_potentials`]. The root stays.
    ///
    /// # Errors
    /// As [`Self::vjp_by_potentials`].
    pub fn jvp_by_potential(
        &self,
        chain: &Chain<'_>,
        by_number: &dyn Potential,
    ) -> Result<ShapeChange, DerivativeError> {
        let mut right = self.by_controls(chain, by_number)?;
        right.iter_mut().for_each(|g| *g = -*g);
        Ok(self.moved(&ParameterChange::default(), &self.solve(&right)?, None))
    }

    /// The gradient of a potential by the controls at rest.
    fn by_controls(
        &self,
        chain: &Chain<'_>,
        potential: &dyn Potential,
    ) -> Result<Vec<DVec3>, DerivativeError> {
        let elements = self.bent.len();
        if chain.len() != elements {
            return Err(DerivativeError::Elements { given: chain.len(), elements });
        }
        Ok(Problem::new(chain, &[]).gradient_of(potential, &self.shape))
    }

    /// The a of `H a = (∂x/∂c)ᵀ ∂ℓ/∂x`. docs/theory.md (D2)
    fn adjoint(&self, by_nodes: &ShapeChange) -> Result<Vec<DVec3>, DerivativeError> {
        self.solve(&self.moments_of(by_nodes)?)
    }

    /// The derivative `(∂x/∂c)ᵀ ∂ℓ/∂x` of a loss by the controls (loss per rad), one vector for each element, from that by the nodes (loss per m and per
    /// rad): the right side of the adjoint's equation. docs/theory.md (D2)
    ///
    /// # Errors
    /// [`DerivativeError::Nodes`], if there is not one vector for each node.
    pub fn moments_of(&self, by_nodes: &ShapeChange) -> Result<Vec<DVec3>, DerivativeError> {
        Ok(self.variation.by_node_changes(&self.in_frames(by_nodes)?))
    }

    /// A loss by the motion of nodes, with rotations in their material frames.
    fn in_frames(&self, by_nodes: &ShapeChange) -> Result<NodeChanges, DerivativeError> {
        let positions = self.one_per_node(&by_nodes.positions)?;
        let none = vec![DVec3::ZERO; positions.len()];
        let rotations = match &by_nodes.rotations {
            empty if empty.is_empty() => &none,
            given => self.one_per_node(given)?,
        };
        let inside = self.shape.frames.iter().zip(rotations).map(|(r, g)| r.transpose() * *g);
        Ok(NodeChanges::new(positions.iter().copied().zip(inside)))
    }

    /// How a change of the parameters moves each node, to first order. docs/theory.md (D1)
    ///
    /// # Errors
    /// [`DerivativeError::Elements`], if the change has natural strains, but not one for each element;
    /// [`DerivativeError::Length`], if it has one of the length, and other potentials act.
    pub fn jvp(&self, change: &ParameterChange) -> Result<ShapeChange, DerivativeError> {
        self.jvp_with_halves(change, &[])
    }

    /// [`Self::jvp`], with a change of the natural strain of both halves of each jointed element besides; empty for none.
    pub(crate) fn jvp_with_halves(
        &self,
        change: &ParameterChange,
        halves: &[[DVec3; 2]],
    ) -> Result<ShapeChange, DerivativeError> {
        // H δc = −∂g/∂p δp, and how that moves nodes.
        let (right, by_halves) = self.change_with_halves(change, halves)?;
        Ok(self.moved(change, &self.solve(&right)?, by_halves))
    }

    /// The moments −∂g/∂p δp (N m) of a change of the parameters, one vector for each element: the right side of the equation of the controls. For a rod
    /// among others it is the rod's part of that of the coupled equations. docs/theory.md (D1), (D7)
    ///
    /// # Errors
    /// As [`Self::jvp`].
    pub fn moments_of_change(
        &self,
        change: &ParameterChange,
    ) -> Result<Vec<DVec3>, DerivativeError> {
        self.change_with_halves(change, &[]).map(|(right, _)| right)
    }

    /// How each node moves with a change of the parameters and of the controls (rad), which have one vector for each element: for a rod among others those
    /// that solve the coupled equations. docs/theory.md (D1), (D7)
    ///
    /// # Errors
    /// As [`Self::jvp`], and [`DerivativeError::Elements`] if there is not one vector for each element.
    pub fn jvp_by_controls(
        &self,
        change: &ParameterChange,
        controls: &[DVec3],
    ) -> Result<ShapeChange, DerivativeError> {
        self.one_per_element(controls)?;
        let (_, by_halves) = self.change_with_halves(change, &[])?;
        Ok(self.moved(change, controls, by_halves))
    }

    /// How a change of natural strain moves the sample points of a rod among others by itself (m), with all controls and the root as they are; `None`
    /// for helix elements, whose shape is that of their controls alone. docs/theory.md (D8)
    ///
    /// # Errors
    /// [`DerivativeError::Elements`], if the change has natural strains, but not one for each element.
    pub fn displacements_of_change(
        &self,
        change: &ParameterChange,
    ) -> Result<Option<Vec<DVec3>>, DerivativeError> {
        let Some(pieces) = &self.pieces else { return Ok(None) };
        if change.natural_strain.is_empty() {
            return Ok(None);
        }
        self.one_per_element(&change.natural_strain)?;
        let both: Vec<[DVec3; 2]> = change.natural_strain.iter().map(|u| [*u; 2]).collect();
        Ok(Some(pieces.displacements(&both)))
    }

    /// −∂g/∂p δp, and how a change of the strain of halves moves what is beyond them by itself.
    fn change_with_halves(
        &self,
        change: &ParameterChange,
        halves: &[[DVec3; 2]],
    ) -> Result<(Vec<DVec3>, Option<NodeChanges>), DerivativeError> {
        let elements = self.bent.len();
        let strain = &change.natural_strain;
        if !strain.is_empty() {
            self.one_per_element(strain)?;
        }
        if change.length != 0.0 && !self.alone {
            return Err(DerivativeError::Length);
        }
        // 1. Of stiffness and load; a longer rod has more load. (D3), (D5)
        let larger = change.length / self.length;
        let rotation = change.root_rotation;
        let load = change.load - rotation.cross(self.load) + self.load * (3.0 * larger);
        let mut right = vec![DVec3::ZERO; elements];
        for (i, right) in right.iter_mut().enumerate() {
            *right = -change.stiffness * self.bent[i] / self.spacing
                + self.moments[0][i] * load.x
                + self.moments[1][i] * load.y
                + self.moments[2][i] * load.z;
        }
        // 2. Of natural strain; halves also move what is beyond them by themselves. (D4)
        let given = |i: usize| strain.get(i).copied().unwrap_or(DVec3::ZERO);
        let by_halves = match &self.pieces {
            None => {
                for (i, right) in right.iter_mut().enumerate() {
                    *right += self.stiffness * (given(i) + self.natural[i] * larger);
                }
                None
            }
            Some(pieces) => {
                let more = |i: usize, k: usize| halves.get(i).map_or(DVec3::ZERO, |pair| pair[k]);
                let both = |(i, u): (usize, &[DVec3; 2])| {
                    [0, 1].map(|k| given(i) + more(i, k) + u[k] * larger)
                };
                let natural = pieces.natural().iter().enumerate().map(both).collect::<Vec<_>>();
                let (more, moved) = pieces.along(&natural);
                right.iter_mut().zip(more).for_each(|(right, more)| *right += more);
                Some(moved)
            }
        };
        Ok((right, by_halves))
    }

    /// How nodes move with the controls, with the root and with the length.
    fn moved(
        &self,
        change: &ParameterChange,
        controls: &[DVec3],
        by_halves: Option<NodeChanges>,
    ) -> ShapeChange {
        let mut nodes: Vec<(DVec3, DVec3)> = self.variation.node_changes(controls).iter().collect();
        if let Some(moved) = by_halves {
            for (node, (position, turn)) in nodes.iter_mut().zip(moved.iter()) {
                *node = (node.0 + position, node.1 + turn);
            }
        }
        let (root, larger) = (self.shape.positions[0], change.length / self.length);
        let rotation = change.root_rotation;
        let rigid = |x: DVec3| change.root_position + rotation.cross(x) + x * larger;
        let positions = nodes.iter().zip(&self.shape.positions);
        let rotations = nodes.iter().zip(&self.shape.frames);
        ShapeChange {
            positions: positions.map(|((moved, _), x)| *moved + rigid(*x - root)).collect(),
            rotations: rotations.map(|((_, turn), frame)| rotation + *frame * *turn).collect(),
        }
    }

    /// The derivative of the energy (J) at rest by all parameters: at rest the controls do not count (envelope theorem).
    #[must_use]
    pub fn by_energy(&self) -> ParameterGradient {
        self.by_energy_with_halves().0
    }

    /// [`Self::by_energy`], and the derivatives by the natural strain of both halves of each jointed element; of helix elements there
    /// are none.
    pub(crate) fn by_energy_with_halves(&self) -> (ParameterGradient, Vec<[DVec3; 2]>) {
        // E = Σ ½ (c − h u⁰)ᵀ K/h (c − h u⁰) − f·∫ (r − r_root) ds; that of joints has u⁰ in r instead.
        let squares: DVec3 = self.bent.iter().map(|bent| *bent * *bent).sum();
        let moved = self.first_moment;
        let halves = self.pieces.as_ref().map(Pieces::energy_by_strain);
        let natural_strain: Vec<DVec3> = match &halves {
            None => self.bent.iter().map(|bent| -self.stiffness * *bent).collect(),
            Some(halves) => halves.iter().map(|[a, b]| *a + *b).collect(),
        };
        // Elastic energy is as 1/L, that of the weight as L², besides the natural strain. (D5)
        let stretched = 2.0 * self.energy.gravity - self.energy.elastic
            + self.by_scale(&natural_strain, halves.as_deref());
        let gradient = ParameterGradient {
            natural_strain,
            length: self.alone.then_some(stretched / self.length),
            stiffness: squares * (0.5 / self.spacing),
            load: -moved,
            root_position: DVec3::ZERO,
            root_rotation: -moved.cross(self.load),
        };
        (gradient, halves.unwrap_or_default())
    }

    /// The derivative by a factor of all natural strains, from those by each element's, or by each half's of jointed ones.
    fn by_scale(&self, by_elements: &[DVec3], by_halves: Option<&[[DVec3; 2]]>) -> f64 {
        match (&self.pieces, by_halves) {
            (Some(pieces), Some(halves)) => {
                let pairs = pieces.natural().iter().zip(halves);
                pairs.map(|([u, v], [a, b])| u.dot(*a) + v.dot(*b)).sum()
            }
            _ => self.natural.iter().zip(by_elements).map(|(u, g)| u.dot(*g)).sum(),
        }
    }

    fn one_per_node<'a>(&self, given: &'a [DVec3]) -> Result<&'a [DVec3], DerivativeError> {
        let nodes = self.shape.positions.len();
        if given.len() == nodes {
            Ok(given)
        } else {
            Err(DerivativeError::Nodes { given: given.len(), nodes })
        }
    }

    fn one_per_element(&self, given: &[DVec3]) -> Result<(), DerivativeError> {
        let elements = self.bent.len();
        if given.len() == elements {
            Ok(())
        } else {
            Err(DerivativeError::Elements { given: given.len(), elements })
        }
    }

    fn solve(&self, right: &[DVec3]) -> Result<Vec<DVec3>, DerivativeError> {
        let factor = self.variation.factor(0.0).ok_or(DerivativeError::NotAMinimum)?;
        Ok(factor.solve(right))
    }
}

/// Largest derivative of the energy by any control, relative to the moment scale.
fn relative(problem: &Problem<'_>, variation: &SecondVariation) -> f64 {
    let largest = variation.gradient().iter().map(|g| g.length()).fold(0.0, f64::max);
    largest / problem.chain().rod().moment_scale()
}

/// The shape at rest to rounding, with its second variation and relative gradient.
fn polished(
    problem: &Problem<'_>,
    mut shape: Shape,
) -> Result<(Shape, SecondVariation, f64), DerivativeError> {
    let chain = problem.chain();
    let mut variation = problem.second_variation(&shape, 1);
    let mut gradient = relative(problem, &variation);
    for _ in 0..MOST_POLISHES {
        let factor = variation.factor(0.0).ok_or(DerivativeError::NotAMinimum)?;
        let step = factor.solve(variation.gradient());
        let controls = shape.controls.iter().zip(&step).map(|(c, x)| *c - *x).collect();
        let next = chain.shape(controls);
        let there = problem.second_variation(&next, 1);
        let found = relative(problem, &there);
        // Newton's method squares a small gradient: one that is not halved is rounding.
        if !(found < 0.5 * gradient) {
            break;
        }
        (shape, variation, gradient) = (next, there, found);
    }
    if gradient <= AT_REST {
        Ok((shape, variation, gradient))
    } else {
        Err(DerivativeError::NotAtRest { gradient })
    }
}
