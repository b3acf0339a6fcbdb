//! A rod at rest and its derivatives, from one second variation.

use glam::DVec3;

use super::{AT_REST, DerivativeError, ParameterChange, ParameterGradient, Regularity};
use crate::chain::Shape;
use crate::minimise::{Problem, SecondVariation};
use crate::potential::{Derivatives, ElementState, Potential};
use crate::resolution::ElementKind;

/// Smallest eigenvalue, relative to the elastic energy, below which derivatives are [`Regularity::IllConditioned`]. Chosen; of the
/// hairs that were compared with differences some have 0.04.
const LEAST_EIGENVALUE: f64 = 1e-3;

/// Most steps of Newton's method that bring the shape to rest to rounding. A guard; two or three are usual.
const MOST_POLISHES: usize = 12;

/// A rod at rest with the second variation from which all its derivatives follow.
///
/// ```
/// use frisure_rod::derivatives::Sensitivity;
/// use frisure_rod::minimise::Problem;
/// use frisure_rod::{
///     Chain, ElementKind, Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Root, Section,
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
///     gravity: 9.81,
/// })?;
/// let element = ElementKind::Helix;
/// let options = Options { resolution: Resolution::Elements(30), element, ..Options::default() };
/// let rest = equilibrium(&rod, &[], &options);
/// let chain = Chain::uniform(&rod, element, 30);
/// let at_rest = Sensitivity::new(&Problem::new(&chain, &[]), rest.shape)?;
///
/// // The height of the tip: a heavier fibre hangs lower, a stiffer one higher.
/// let mut loss = vec![DVec3::ZERO; 31];
/// loss[30] = DVec3::Z;
/// let gradient = at_rest.vjp(&loss)?;
/// let [by_density, by_youngs_modulus, _] = gradient.material(&rod);
/// assert!(by_density < 0.0 && by_youngs_modulus > 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Sensitivity {
    shape: Shape,
    variation: SecondVariation,
    /// K (N m²) and length of an element (m).
    stiffness: DVec3,
    spacing: f64,
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
    /// [`DerivativeError`], if the elements are jointed, or the shape is no minimum or does not come to rest.
    pub fn new(problem: &Problem<'_>, shape: Shape) -> Result<Self, DerivativeError> {
        let chain = problem.chain();
        if chain.kind() != ElementKind::Helix {
            return Err(DerivativeError::JointedElements);
        }
        let (shape, variation, gradient_norm) = polished(problem, shape)?;
        let rod = chain.rod();
        let axis = |direction: DVec3| {
            let moment = Moment { direction, length: rod.length() };
            let gradient = gradient_of(problem, &moment, &shape);
            (gradient, chain.energy(&shape, &moment))
        };
        let [(x, mx), (y, my), (z, mz)] = [DVec3::X, DVec3::Y, DVec3::Z].map(axis);
        let bent = |(i, c): (usize, &DVec3)| *c - chain.geometry(i).rest();
        let min_eigenvalue = problem.min_eigenvalue(&shape);
        Ok(Self {
            stiffness: rod.stiffness(),
            spacing: rod.length() / chain.len() as f64,
            bent: shape.controls.iter().enumerate().map(bent).collect(),
            moments: [x, y, z],
            first_moment: DVec3::new(mx, my, mz),
            load: DVec3::NEG_Z * problem.gravity.weight,
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

    /// The derivative of a loss by all parameters, from that by the position of each node, the root first (loss per m, world).
    /// docs/theory.md (D1), (D2)
    ///
    /// # Errors
    /// [`DerivativeError::Nodes`], if there is not one vector for each node.
    pub fn vjp(&self, by_nodes: &[DVec3]) -> Result<ParameterGradient, DerivativeError> {
        let nodes = self.shape.positions.len();
        if by_nodes.len() != nodes {
            return Err(DerivativeError::Nodes { given: by_nodes.len(), nodes });
        }
        // 1. H a = (∂x/∂c)ᵀ ∂ℓ/∂x.
        let a = self.solve(&self.variation.by_controls(&by_nodes[1..]))?;
        // 2. −aᵀ ∂g/∂p of each parameter.
        let natural_strain = a.iter().map(|a| self.stiffness * *a).collect();
        let bent = a.iter().zip(&self.bent).map(|(a, bent)| *a * *bent);
        let stiffness = -bent.sum::<DVec3>() / self.spacing;
        let along = |k: usize| -> f64 {
            a.iter().zip(&self.moments[k]).map(|(a, moment)| a.dot(*moment)).sum()
        };
        let load = DVec3::new(along(0), along(1), along(2));
        // 3. The root moves all nodes; turned, it sees the load turned back.
        let root = self.shape.positions[0];
        let lever = |(x, g): (&DVec3, &DVec3)| (*x - root).cross(*g);
        let turned: DVec3 = self.shape.positions.iter().zip(by_nodes).map(lever).sum();
        Ok(ParameterGradient {
            natural_strain,
            stiffness,
            load,
            root_position: by_nodes.iter().sum(),
            root_rotation: turned - self.load.cross(load),
        })
    }

    /// How a change of the parameters moves each node, the root first (m, world), to first order. docs/theory.md (D1)
    ///
    /// # Errors
    /// [`DerivativeError::Elements`], if the change has natural strains, but not one for each element.
    pub fn jvp(&self, change: &ParameterChange) -> Result<Vec<DVec3>, DerivativeError> {
        let elements = self.bent.len();
        let strain = &change.natural_strain;
        if !strain.is_empty() && strain.len() != elements {
            return Err(DerivativeError::Elements { given: strain.len(), elements });
        }
        // 1. −∂g/∂p δp.
        let rotation = change.root_rotation;
        let load = change.load - rotation.cross(self.load);
        let mut right = vec![DVec3::ZERO; elements];
        for (i, right) in right.iter_mut().enumerate() {
            *right = -change.stiffness * self.bent[i] / self.spacing
                + self.moments[0][i] * load.x
                + self.moments[1][i] * load.y
                + self.moments[2][i] * load.z;
            if let Some(strain) = strain.get(i) {
                *right += self.stiffness * *strain;
            }
        }
        // 2. H δc = −∂g/∂p δp, and how that moves nodes.
        let moved = self.variation.displacements(&self.solve(&right)?);
        let root = self.shape.positions[0];
        let rigid = |x: DVec3| change.root_position + rotation.cross(x - root);
        let nodes = self.shape.positions.iter().zip(std::iter::once(DVec3::ZERO).chain(moved));
        Ok(nodes.map(|(x, moved)| moved + rigid(*x)).collect())
    }

    /// The derivative of the energy (J) at rest by all parameters: at rest the controls do not count (envelope theorem).
    #[must_use]
    pub fn by_energy(&self) -> ParameterGradient {
        // E = Σ ½ (c − h u⁰)ᵀ K/h (c − h u⁰) − f·∫ (r − r_root) ds
        let squares: DVec3 = self.bent.iter().map(|bent| *bent * *bent).sum();
        let moved = self.first_moment;
        ParameterGradient {
            natural_strain: self.bent.iter().map(|bent| -self.stiffness * *bent).collect(),
            stiffness: squares * (0.5 / self.spacing),
            load: -moved,
            root_position: DVec3::ZERO,
            root_rotation: -moved.cross(self.load),
        }
    }

    fn solve(&self, right: &[DVec3]) -> Result<Vec<DVec3>, DerivativeError> {
        let factor = self.variation.factor(0.0).ok_or(DerivativeError::NotAMinimum)?;
        Ok(factor.solve(right))
    }
}

/// Gradient of a potential by the controls of a shape.
fn gradient_of(problem: &Problem<'_>, potential: &dyn Potential, shape: &Shape) -> Vec<DVec3> {
    let weightless = Problem::with_load(problem.chain(), &[], 0.0);
    let elastic = weightless.second_variation(shape, 1);
    let with = [potential];
    let both = Problem::with_load(problem.chain(), &with, 0.0).second_variation(shape, 1);
    both.gradient().iter().zip(elastic.gradient()).map(|(both, elastic)| *both - *elastic).collect()
}

/// The shape at rest to rounding, with its second variation and relative gradient.
fn polished(
    problem: &Problem<'_>,
    mut shape: Shape,
) -> Result<(Shape, SecondVariation, f64), DerivativeError> {
    let chain = problem.chain();
    let scale = chain.rod().moment_scale();
    let size = |variation: &SecondVariation| {
        variation.gradient().iter().map(|g| g.length()).fold(0.0, f64::max) / scale
    };
    let mut variation = problem.second_variation(&shape, 1);
    let mut gradient = size(&variation);
    for _ in 0..MOST_POLISHES {
        let factor = variation.factor(0.0).ok_or(DerivativeError::NotAMinimum)?;
        let step = factor.solve(variation.gradient());
        let controls = shape.controls.iter().zip(&step).map(|(c, x)| *c - *x).collect();
        let next = chain.shape(controls);
        let there = problem.second_variation(&next, 1);
        let found = size(&there);
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
