//! A guide at rest with friction: shape, normal forces and friction agree.
//!
//! Friction has no energy, but with the normal forces fixed it has one (docs/theory.md, "Friction"). So the shape is
//! sought with the normal forces of the one before until both agree (Picard's iteration); then the anchors of what slipped
//! follow, and the load takes its next step.

use frisure_rod::potential::{FieldPotential, Potential, Yielding};
use frisure_rod::{Equilibrium, Options, Rod, Stability, equilibrium_from};
use glam::DVec3;

use super::tether::{Tether, farthest, firmness};
use crate::contact::{Friction, FrictionGap, FrictionSurface};

/// Change of the limits of friction, relative to them, at which normal forces and shape agree (F3).
const AGREEMENT: f64 = 5e-4;

/// The same relative to the weight of the guide, which decides where it hardly touches.
const LIGHT_AGREEMENT: f64 = 1e-5;

/// Largest move (m) of the last shape that is sought: what slides is at rest then. A hundredth of the slip distance.
const STILL: f64 = 5e-7;

/// Most iterations for one step of the load, and for one shape on the way: a shape that is not at rest yet goes on in the next.
/// Guards: a hundred and ten are usual.
const MOST_ITERATIONS: usize = 1500;
const MOST_PER_SHAPE: usize = 60;

/// First stiffness of the tether, in those at which its weight moves a guide by 4 mm: about half a millimetre. The tether is
/// loosened by a factor while limits change by less than [`CALM`] of themselves, tightened while they change by more, and
/// let go below the loosest. Chosen by trial with the capstan and combed heads.
const FIRST_TETHER: f64 = 8.0;
const FIRMEST: f64 = 500.0;
const LOOSENING: f64 = 0.25;
const TIGHTENING: f64 = 4.0;
const LOOSEST: f64 = 1e-2;
const CALM: f64 = 0.1;

/// A guide at rest, and how friction holds it.
pub(super) struct Rested {
    pub(super) rest: Equilibrium,
    /// Largest |f_t| / μ f_n; 0 without friction.
    pub(super) friction: f64,
    /// The hairs of its wisp, if they stuck on the way.
    pub(super) lock: Option<Yielding>,
}

impl Rested {
    /// A guide that no friction holds.
    pub(super) fn free(rest: Equilibrium) -> Self {
        Self { rest, friction: 0.0, lock: None }
    }
}

/// Whether friction holds a guide near where it starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hold {
    /// It slides freely.
    Free,
    /// It sticks where it starts, as far as the scene has friction.
    ByFriction,
}

/// A rod that is moved by steps of the load, with friction on what it lies on: how guides rest on a head, for any surface.
///
/// What friction holds depends on the steps. docs/theory.md, "Friction", (F1) to (F3).
///
/// ```
/// use frisure_hairstyle::FrictionalRod;
/// use frisure_hairstyle::contact::{FrictionSurface, Pressed};
/// use frisure_rod::potential::{Field, FieldPotential};
/// use frisure_rod::*;
/// use glam::{DMat3, DVec3};
///
/// /// A table z = 0 that gives way by weight over stiffness, with a coefficient of friction of a half.
/// struct Table;
/// const STIFFNESS: f64 = 50.0;
///
/// impl Field for Table {
///     fn energy(&self, _: f64, p: DVec3) -> f64 {
///         0.5 * STIFFNESS * p.z.min(0.0).powi(2)
///     }
///
///     fn derivatives(&self, _: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
///         let up = DVec3::Z * (STIFFNESS * p.z);
///         (p.z < 0.0).then(|| (up, DMat3::from_diagonal(DVec3::Z * STIFFNESS)))
///     }
/// }
///
/// impl FrictionSurface for Table {
///     fn pressed(&self, _: f64, p: DVec3) -> Option<Pressed> {
///         (p.z < 0.0).then(|| Pressed { normal: DVec3::Z, limit: 0.5 * STIFFNESS * -p.z })
///     }
/// }
///
/// let hair = RodSpec {
///     length: 0.1,
///     section: Section::from_diameter(70e-6, 1.0)?,
///     material: Material::new(3.9e9, 0.9e9, 1300.0)?,
///     torsion: TorsionConstant::SaintVenant,
///     natural: NaturalStrain::STRAIGHT,
///     root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Y)?,
///     load: Load::down(9.81),
/// };
/// let rod = Rod::new(hair)?;
/// let options = Options { resolution: Resolution::Elements(20), ..Options::default() };
/// let table = FieldPotential::new(&Table, 4);
/// let lying = equilibrium(&rod, &[&table], &options);
/// let mut rod = FrictionalRod::new(&rod, &Table, 4, options, &lying);
/// rod.step(&[&table]);
/// assert!(rod.rest().certificate.stability == Stability::Stable && rod.friction_ratio() <= 1.001);
/// # Ok::<(), InvalidQuantity>(())
/// ```
pub struct FrictionalRod<'a> {
    rod: &'a Rod,
    surface: &'a dyn FrictionSurface,
    /// Points per element at which the surface is felt.
    samples: u32,
    options: Options,
    friction: Friction,
    rest: Equilibrium,
    /// Largest |f_t| / μ f_n after the last step.
    ratio: f64,
}

impl<'a> FrictionalRod<'a> {
    /// Starts where a rod lies in `before`, with the division of the options: there it sticks, without force. The surface is felt
    /// at `samples` points per element.
    #[must_use]
    pub fn new(
        rod: &'a Rod,
        surface: &'a dyn FrictionSurface,
        samples: u32,
        options: Options,
        before: &Equilibrium,
    ) -> Self {
        // No iteration: the shape is transferred by its frames and stays as it is. docs/theory.md, "Warm starts"
        let still = Options { max_iterations: 0, tolerance: 0.0, ..options };
        let rest = equilibrium_from(rod, &[], &still, before);
        let points = rest.chain().sample_points(&rest.shape, samples);
        let spacing = rod.length() / points.len() as f64;
        let friction = Friction::stuck_at(&points, spacing);
        Self { rod, surface, samples, options, friction, rest, ratio: 0.0 }
    }

    /// Brings the rod to rest under one more step of the load, of which `felt` is all but friction and the weight; potentials of the
    /// surface among it have to be evaluated at the same points.
    ///
    /// A rod that does not come to rest is [`Stability::NotConverged`] in [`Self::rest`].
    pub fn step(&mut self, felt: &[&dyn Potential]) {
        let mut iterations = self.rest.certificate.iterations;
        // A draft has fewer: what is left then is done by the exact rest.
        let most = iterations + self.options.max_iterations.min(MOST_ITERATIONS);
        let mut tether = FIRST_TETHER;
        let at_rest;
        let mut limit = self.friction.press(self.surface, &self.points()).limit;
        loop {
            // An implicit step of an overdamped motion: the tether keeps the move small while normal forces follow.
            let firm = firmness(self.rod, limit);
            let found = self.sought(felt, tether * firm);
            let before = std::mem::replace(&mut self.rest, found);
            // Each counts one at least, so that this ends.
            iterations += self.rest.certificate.iterations.max(1);
            let points = self.points();
            let gap = self.friction.press(self.surface, &points);
            self.friction.slip(&points);
            (self.ratio, limit) = (gap.ratio, gap.limit);
            let still = farthest(&self.rest.shape, &before.shape) <= STILL;
            let converged = self.rest.certificate.stability != Stability::NotConverged;
            let rests = tether == 0.0 && still && converged && self.agrees(gap);
            if rests || iterations >= most {
                at_rest = rests;
                break;
            }
            let calm = gap.change <= CALM * gap.limit + LIGHT_AGREEMENT * self.weight();
            tether = match (calm, tether) {
                (true, tether) if tether > LOOSEST => tether * LOOSENING,
                (true, _) => 0.0,
                (false, tether) => (tether.max(LOOSEST) * TIGHTENING).min(FIRMEST),
            };
        }
        // Friction's own energy says where it would go back to; it is no energy of the hair.
        let chain = self.rest.chain();
        self.rest.energy.external =
            felt.iter().map(|felt| chain.energy(&self.rest.shape, *felt)).sum();
        self.rest.certificate.iterations = iterations;
        if !at_rest {
            self.rest.certificate.stability = Stability::NotConverged;
        }
    }

    /// Where the rod rests after the last step. Its energy has no friction in it.
    #[must_use]
    pub fn rest(&self) -> &Equilibrium {
        &self.rest
    }

    /// Largest friction over what the normal force allows, |f_t|/μ f_n, after the last step: 1 where it slips; 0 before any step.
    #[must_use]
    pub fn friction_ratio(&self) -> f64 {
        self.ratio
    }

    /// The guide at rest.
    pub(super) fn finish(self) -> Rested {
        Rested { rest: self.rest, friction: self.ratio, lock: None }
    }

    /// The rest with the normal forces as they are, held where the guide is by a tether of a stiffness (Pa).
    fn sought(&self, felt: &[&dyn Potential], tether: f64) -> Equilibrium {
        let friction = FieldPotential::new(&self.friction, self.samples);
        let chain = self.rest.chain();
        let tethered = Tether::new(tether, &chain, &self.rest.shape);
        let tethered = FieldPotential::new(&tethered, 1);
        let mut felt = felt.to_vec();
        felt.push(&friction);
        if tether > 0.0 {
            felt.push(&tethered);
        }
        let most = self.options.max_iterations.min(MOST_PER_SHAPE);
        let options = Options { max_iterations: most, ..self.options };
        equilibrium_from(self.rod, &felt, &options, &self.rest)
    }

    /// Weight of the whole guide (N).
    fn weight(&self) -> f64 {
        self.rod.weight() * self.rod.length()
    }

    fn points(&self) -> Vec<DVec3> {
        self.rest.chain().sample_points(&self.rest.shape, self.samples)
    }

    fn agrees(&self, gap: FrictionGap) -> bool {
        gap.ratio <= 1.0 + AGREEMENT
            && gap.change <= AGREEMENT * gap.limit + LIGHT_AGREEMENT * self.weight()
    }
}
