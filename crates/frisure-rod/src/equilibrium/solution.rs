//! A rod at rest: its shape, energies and certificate.

use glam::{DMat3, DQuat, DVec3};

use super::richardson::Correction;
use crate::chain::{Chain, Shape};
use crate::minimise::{Energy, Minimum, Problem, Stability};
use crate::resolution::ElementKind;
use crate::rod::Rod;

/// Whether the centre line is as near to the exact equilibrium as was asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum AccuracyStatus {
    /// No accuracy was asked for: a number of elements was given.
    #[default]
    NotRequested,
    /// The shape is stable, and the estimate of its error is within the requested accuracy.
    Met,
    /// It is not, with as many elements as were allowed, or that is not known.
    Missed,
}

/// The evidence for an equilibrium: gradient, stability, smallest eigenvalue, accuracy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    /// Relative gradient, see [`Problem::gradient_norm`].
    pub gradient_norm: f64,
    /// Smallest λ in `H x = λ M x`, H the second variation of the energy and M that of the elastic
    /// energy: 1 without loads, 0 where stability is lost. `None` unless [`Options::eigenvalue`](crate::Options::eigenvalue) is set,
    /// and where the gradient does not vanish.
    ///
    /// That of the exact rod, extrapolated, where the error is estimated too; otherwise that of the division.
    pub min_eigenvalue: Option<f64>,
    /// Estimate of its error, or of its rounding error if it is that of the division.
    pub eigenvalue_error: Option<f64>,
    /// Minimum, saddle point, not known or neither: of the exact rod, where the error is estimated; otherwise of the
    /// division.
    pub stability: Stability,
    /// Iterations of the minimiser in all.
    pub iterations: usize,
    /// Whether a requested accuracy was met.
    pub accuracy: AccuracyStatus,
}

/// A rod at rest.
///
/// ```
/// use frisure_rod::{
///     Material, NaturalStrain, Options, Resolution, Rod, RodSpec, Load, Root, Section, Stability,
///     TorsionConstant, equilibrium,
/// };
/// use glam::DVec3;
///
/// // A straight hair of 5 cm, clamped horizontally.
/// let rod = Rod::new(RodSpec {
///     length: 0.05,
///     section: Section::circular(35e-6)?,
///     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
///     torsion: TorsionConstant::SaintVenant,
///     natural: NaturalStrain::STRAIGHT,
///     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
///     load: Load::down(9.81),
/// })?;
/// let options = Options { resolution: Resolution::Elements(20), ..Options::default() };
/// let rest = equilibrium(&rod, &[], &options);
///
/// // It sags by nearly w L⁴/8EI, the deflection of a light cantilever.
/// let light = rod.weight() * 0.05_f64.powi(4) / (8.0 * rod.stiffness().x);
/// assert!(-rest.tip().z > 0.9 * light && -rest.tip().z < light);
/// assert_eq!(rest.certificate.stability, Stability::Stable);
/// // Bending costs energy, and sagging yields more of it.
/// assert!(rest.energy.elastic > 0.0 && rest.energy.total() < 0.0);
/// # Ok::<(), frisure_rod::InvalidQuantity>(())
/// ```
#[derive(Clone, Debug)]
pub struct Equilibrium {
    /// The rod.
    pub rod: Rod,
    /// Curve of the elements, never [`ElementKind::Auto`].
    pub element: ElementKind,
    /// Number of elements of the finest division.
    pub elements: usize,
    /// Shape of the finest division.
    pub shape: Shape,
    /// Energies, extrapolated where the shape is.
    pub energy: Energy,
    /// What certifies it.
    pub certificate: Certificate,
    /// Estimate of the largest distance (m) of the centre line from the exact equilibrium.
    pub error_estimate: Option<f64>,
    /// What extrapolation adds to every node.
    pub(super) correction: Option<Vec<Correction>>,
}

impl Equilibrium {
    /// Wraps the result of a minimiser as it is: not extrapolated, its error not estimated.
    #[must_use]
    pub fn from_minimum(problem: &Problem<'_>, minimum: Minimum) -> Self {
        let chain = problem.chain();
        let energy = problem.energy(&minimum.shape);
        let Minimum { shape, gradient_norm, iterations, stability, .. } = minimum;
        Self {
            rod: chain.rod().clone(),
            element: chain.kind(),
            elements: chain.len(),
            shape,
            energy,
            certificate: Certificate {
                gradient_norm,
                min_eigenvalue: None,
                eigenvalue_error: None,
                stability,
                iterations,
                accuracy: AccuracyStatus::NotRequested,
            },
            error_estimate: None,
            correction: None,
        }
    }

    /// The divided rod whose shape [`Self::shape`] is.
    #[must_use]
    pub fn chain(&self) -> Chain<'_> {
        Chain::uniform(&self.rod, self.element, self.elements)
    }

    /// Estimate of the largest distance (m) of the nodes of [`Self::shape`] from the exact equilibrium: of the division by itself,
    /// without what extrapolation adds. `None` where [`Self::error_estimate`] is.
    #[must_use]
    pub fn division_error(&self) -> Option<f64> {
        let shifts = self.correction.iter().flatten().map(|c| c.shift.length());
        self.error_estimate.map(|estimate| estimate + shifts.fold(0.0, f64::max))
    }

    /// Position of the tip (m).
    #[must_use]
    pub fn tip(&self) -> DVec3 {
        self.node(self.elements)
    }

    fn node(&self, i: usize) -> DVec3 {
        self.shape.positions[i] + self.correction_at(i as f64).0
    }

    /// What extrapolation adds to the position (m), and the rotation vector (rad, world) by which
    /// it turns the frame.
    fn correction_at(&self, node: f64) -> (DVec3, DVec3) {
        let Some(table) = &self.correction else { return (DVec3::ZERO, DVec3::ZERO) };
        let last = table.len() - 1;
        let x = node.clamp(0.0, last as f64);
        let i = (x as usize).min(last.saturating_sub(1));
        let (from, to) = (&table[i], &table[(i + 1).min(last)]);
        let x = x - i as f64;
        let step = self.rod.length() / last as f64;
        // Hermite: cubic, with the slopes at both ends. Within an element both lines are smooth, so that what is left is of
        // fourth order.
        let (rise, y) = (x * x * (3.0 - 2.0 * x), 1.0 - x);
        let bends = (from.slope * y - to.slope * x) * (x * y * step);
        // Frames are of second order within an element anyway: linear is enough for them.
        (from.shift.lerp(to.shift, rise) + bends, from.turn.lerp(to.turn, x))
    }

    /// `points` positions (m) and material frames, evenly spaced in arc length from root to tip;
    /// at least two.
    #[must_use]
    pub fn sample(&self, points: usize) -> Vec<(DVec3, DMat3)> {
        let n = points.max(2);
        let chain = self.chain();
        (0..n).map(|k| self.at(&chain, k as f64 / (n - 1) as f64)).collect()
    }

    /// Position (m) and material frame at a part of the arc length, 0 (root) to 1 (tip), of the
    /// [`Self::chain`].
    #[must_use]
    pub fn at(&self, chain: &Chain<'_>, x: f64) -> (DVec3, DMat3) {
        let (position, frame) = chain.point(&self.shape, x * self.rod.length());
        let (shift, turn) = self.correction_at(x * self.elements as f64);
        (position + shift, DMat3::from_quat(DQuat::from_scaled_axis(turn)) * frame)
    }

    /// The centre line as `points` positions (m), evenly spaced in arc length; at least two.
    #[must_use]
    pub fn centre_line(&self, points: usize) -> Vec<DVec3> {
        self.sample(points).into_iter().map(|(position, _)| position).collect()
    }
}
