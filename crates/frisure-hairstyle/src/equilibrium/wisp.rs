//! One guide among others that hold still.

use frisure_rod::derivatives::{DerivativeError, Sensitivity};
use frisure_rod::minimise::{
    Minimiser, Minimum, Newton, NewtonStep, Problem, SecondVariation, StoppingCriteria,
};
use frisure_rod::potential::{Field, FieldPotential, Potential, Yielding};
use frisure_rod::{Chain, Equilibrium, Shape};
use glam::DVec3;

use super::fields::{along, body, body_samples, layer, own_skin, samples};
use super::friction_solver::Hold;
use super::lock;
use super::tether::{Tether, farthest, firmness};
use crate::contact::{
    BodyContact, CombedHold, ContactPairs, Friction, FrictionGap, Layer, Pull, Samples, Strand,
    SwitchDistance,
};
use crate::guides::Guide;
use crate::hairstyle::Rest;
use crate::head::Head;
use crate::parallel;
use crate::spec::HairstyleSpec;

/// How often the tether of a guide that moves too far is made four times as stiff. A guard: 4⁴⁰ holds anything.
const MOST_TETHERS: usize = 40;

/// Distance between the points at which contact of wisps is evaluated, as a fraction of their radius …
/// Chosen by trial; not measured further.
const SPACING: f64 = 1.1;

/// The same of density. Chosen: five points across its kernel.
const SPACING_OF_DENSITY: f64 = 1.6;

/// Least distance (m) between these points. Chosen by trial; not measured further.
const LEAST_SPACING: f64 = 1e-3;

/// Factor on the tether of a guide that moved too far, and on that of one that moved less than [`SHORT_MOVE`] of what it may.
/// Chosen by trial; not measured further.
const TIGHTENING: f64 = 4.0;
const LOOSENING: f64 = 0.4;

/// Share of what a guide may move below which its tether is loosened. Chosen by trial; not measured further.
const SHORT_MOVE: f64 = 0.4;

/// Least tether, as a share of the first: not so loose that it takes long to be held again. Chosen by trial.
const LOOSEST: f64 = 1e-4;

/// One guide and where it is.
pub(super) struct Wisp<'a> {
    guide: &'a Guide,
    chain: Chain<'a>,
    body: BodyContact<'a>,
    /// Points per element at which contact with other wisps is evaluated.
    resolution: u32,
    settled: Settled,
    /// Friction on skin, if there is any.
    friction: Option<Friction>,
    /// The hairs inside, if they stick.
    lock: Option<Yielding>,
    /// What pulls at the guide while it lets go.
    letting_go: Option<Pull>,
}

/// Where a guide is, and how it got there.
#[derive(Clone)]
pub(super) struct Settled {
    shape: Shape,
    iterations: usize,
    /// Stiffness (Pa) that holds the guide near where it is during a sweep.
    tether: f64,
}

impl<'a> Wisp<'a> {
    /// A guide where it rested alone; `spacing` is the distance of its points, as a fraction of its radius.
    fn new(guide: &'a Guide, alone: &'a Equilibrium, body: BodyContact<'a>, spacing: f64) -> Self {
        let length = guide.rod.length();
        let spacing = (spacing * guide.thickness.packed(0.5 * length)).max(LEAST_SPACING);
        let resolution = samples(guide, alone.elements, spacing);
        let settled = Settled {
            shape: alone.shape.clone(),
            iterations: alone.certificate.iterations,
            tether: firmness(&guide.rod, 0.0),
        };
        Self {
            guide,
            chain: alone.chain(),
            body,
            resolution,
            settled,
            friction: None,
            lock: None,
            letting_go: None,
        }
    }

    /// Sets what pulls at the guide, besides what holds it, while it lets go.
    pub(super) fn let_go(&mut self, pull: Option<Pull>) {
        self.letting_go = pull;
    }

    /// Sets how the hairs inside stick.
    pub(super) fn set_lock(&mut self, lock: Option<Yielding>) {
        self.lock = lock;
    }

    /// Lets hairs inside that slipped stick where they are now.
    pub(super) fn follow_lock(&mut self) {
        if let Some(lock) = &mut self.lock {
            lock.follow(&self.chain, &self.settled.shape);
        }
    }

    /// The hairs inside, if they stick.
    pub(super) fn lock(&self) -> Option<&Yielding> {
        self.lock.as_ref()
    }

    /// Lets the guide stick to the skin where it is, if the skin has friction.
    fn stick(&mut self) {
        if !self.body.friction.is_zero() {
            let points = self.body_points();
            let spacing = self.guide.rod.length() / points.len() as f64;
            self.friction = Some(Friction::stuck_at(&points, spacing));
        }
    }

    /// The points (m) at which contact with the body is evaluated.
    fn body_points(&self) -> Vec<DVec3> {
        let samples = body_samples(self.guide, self.chain.len());
        self.chain.sample_points(&self.settled.shape, samples)
    }

    /// How near the guide is to where what it touches by itself begins or ends.
    pub(super) fn switch_distance(&self) -> SwitchDistance {
        let points = self.body_points();
        let spacing = self.guide.rod.length() / points.len() as f64;
        let pulls = || self.guide.pull.iter().chain(&self.letting_go);
        let at = |(k, p): (usize, &DVec3)| {
            let s = spacing * (k + 1) as f64;
            let held =
                pulls().map(|pull| pull.switch_distance(s, *p)).fold(f64::INFINITY, f64::min);
            SwitchDistance { hold: held, ..self.body.switch_distance(s, *p) }
        };
        points.iter().enumerate().map(at).fold(SwitchDistance::FAR, SwitchDistance::and)
    }

    /// Takes over how the guide is pressed on skin where it is now, lets anchors follow what slipped, and returns how far
    /// forces of friction were from the law. docs/theory.md (F2), (F3)
    pub(super) fn press(&mut self) -> FrictionGap {
        let points = self.friction.as_ref().map(|_| self.body_points());
        let (Some(friction), Some(points)) = (&mut self.friction, points) else {
            return FrictionGap::default();
        };
        let gap = friction.press(&self.body, &points);
        friction.slip(&points);
        gap
    }

    /// How far forces of friction on skin are from the law where the guide is now.
    pub(super) fn friction_gap(&self) -> FrictionGap {
        let gap = |friction: &Friction| friction.clone().press(&self.body, &self.body_points());
        self.friction.as_ref().map_or_else(FrictionGap::default, gap)
    }

    pub(super) fn settled(&self) -> &Settled {
        &self.settled
    }

    /// The points (m) at which contact with other wisps is evaluated.
    pub(super) fn points(&self) -> Vec<DVec3> {
        self.points_at(&self.settled)
    }

    /// The same where the guide is not yet.
    pub(super) fn points_at(&self, settled: &Settled) -> Vec<DVec3> {
        self.chain.sample_points(&settled.shape, self.resolution)
    }

    pub(super) fn samples(&self) -> Samples {
        let elements = self.chain.len() as f64;
        let spacing = self.guide.rod.length() / (elements * f64::from(self.resolution));
        Samples::new(self.points(), spacing, &self.guide.thickness).braided(self.braided())
    }

    /// The piece (arc lengths, m) that is held in a braid.
    fn braided(&self) -> Option<[f64; 2]> {
        self.guide.pull.as_ref().and_then(Pull::braided)
    }

    /// The points of the guide, for its density.
    pub(super) fn strand(&self) -> Strand {
        let elements = self.chain.len() as f64;
        let spacing = self.guide.rod.length() / (elements * f64::from(self.resolution));
        let (thickness, braided) = (self.guide.thickness, self.braided());
        Strand { spacing, positions: self.points(), thickness, braided }
    }

    /// Sets the bed of hair that the guide lies on besides the other wisps.
    pub(super) fn set_layer(&mut self, layer: Layer) {
        self.body.layer = layer;
    }

    /// Where the guide is, with a tether of a share of the stiffness at which it would move by [`FIRST_SAG`].
    pub(super) fn anchor(&self, share: f64) -> Anchor {
        let stiffness = share * firmness(&self.guide.rod, 0.0);
        Anchor { stiffness, from: self.settled.shape.clone() }
    }

    /// Stiffness (N/m) of a tether of each node against which weight and elasticity move the guide by some millimetres.
    pub(super) fn node_firmness(&self) -> f64 {
        firmness(&self.guide.rod, 0.0) * self.guide.rod.length() / self.chain.len() as f64
    }

    /// Gradient and second variation of the energy while all others hold still, held by a tether.
    pub(super) fn second_variation(
        &self,
        others: &dyn Field,
        anchor: Option<&Anchor>,
    ) -> SecondVariation {
        let around = FieldPotential::new(others, self.resolution);
        self.held(&around, anchor, |problem| {
            problem.second_variation(&self.settled.shape, self.resolution)
        })
    }

    /// A step downhill while all others hold still, by at most `reach` (m).
    pub(super) fn downhill(&self, others: &dyn Field, reach: f64) -> Settled {
        // One iteration: the others will move, too.
        let stopping = StoppingCriteria { tolerance: 0.0, max_iterations: 1 };
        let from = &self.settled.shape;
        // A trust region in space: the same step with a stiffer tether until no node moves farther than `reach`.
        let mut stiffness = self.settled.tether;
        for _ in 0..MOST_TETHERS {
            let tether = Tether::new(stiffness, &self.chain, from);
            // ½ c |r − r₀|² per length is a damping in space: the softest motions of a long hair are those that move it farthest.
            let tether = FieldPotential::new(&tether, 1);
            let (shape, iterations) = self.among(others, Some(&tether), |problem| {
                let newton = Newton::default();
                // Where there is no step down, a saddle may be left.
                newton.step_downhill(problem, from).map_or_else(
                    || {
                        let found = newton.minimise(problem, from.clone(), stopping);
                        (found.shape, found.iterations)
                    },
                    |shape| (shape, 1),
                )
            });
            let moved = farthest(&shape, from);
            if moved <= reach {
                let looser = if moved < SHORT_MOVE * reach { LOOSENING } else { 1.0 };
                return Settled {
                    shape,
                    iterations,
                    tether: (stiffness * looser).max(LOOSEST * firmness(&self.guide.rod, 0.0)),
                };
            }
            stiffness *= TIGHTENING;
        }
        // No tether holds it: it stays where it is.
        Settled { tether: stiffness, iterations: 0, shape: from.clone() }
    }

    /// Takes a new shape over.
    pub(super) fn take(&mut self, mut settled: Settled) {
        settled.iterations += self.settled.iterations;
        self.settled = settled;
    }

    /// Newton's step while all others hold still, cut to move no node farther than `reach` (m).
    pub(super) fn newton_step(&self, others: &dyn Field, reach: f64) -> NewtonStep {
        let from = &self.settled.shape;
        let mut newton =
            self.among(others, None, |problem| Newton::default().newton_step(problem, from));
        // Scaled as a whole, so that it stays a direction of descent.
        let moved = self.length_of(&newton.step);
        if moved > reach {
            for x in &mut newton.step {
                *x *= reach / moved;
            }
        }
        newton
    }

    /// The shape a fraction of a step away from another.
    fn stepped(&self, from: &Shape, step: &[DVec3], fraction: f64) -> Shape {
        let controls = from.controls.iter().zip(step);
        self.chain.shape(controls.map(|(c, x)| *c + *x * fraction).collect())
    }

    /// Goes a fraction of a step from a given shape; gives [`Self::points`] there.
    pub(super) fn go(&mut self, from: &Settled, step: &[DVec3], fraction: f64) -> Vec<DVec3> {
        self.settled.shape = self.stepped(&from.shape, step, fraction);
        self.settled.iterations = from.iterations + 1;
        self.points()
    }

    /// Where a fraction of a step would take the guide, to be [taken](Self::take).
    pub(super) fn after(&self, step: &[DVec3], fraction: f64) -> Settled {
        let shape = self.stepped(&self.settled.shape, step, fraction);
        Settled { shape, iterations: 1, tether: self.settled.tether }
    }

    /// Largest distance (m) that a step moves a node.
    pub(super) fn length_of(&self, step: &[DVec3]) -> f64 {
        let from = &self.settled.shape;
        farthest(&self.stepped(from, step, 1.0), from)
    }

    /// What gradients are measured against (N m).
    pub(super) fn moment_scale(&self) -> f64 {
        self.guide.rod.moment_scale()
    }

    /// Calls `act` with the energy of this guide while all others hold still.
    fn among<T>(
        &self,
        others: &dyn Field,
        tether: Option<&dyn Potential>,
        act: impl FnOnce(&Problem<'_>) -> T,
    ) -> T {
        let around = FieldPotential::new(others, self.resolution);
        self.feeling(&around, tether, act)
    }

    /// Calls `act` with the energy of this guide in the body, in what pulls at it, in one more and in a tether.
    fn held<T>(
        &self,
        around: &dyn Potential,
        anchor: Option<&Anchor>,
        act: impl FnOnce(&Problem<'_>) -> T,
    ) -> T {
        let Some(Anchor { stiffness, from }) = anchor else {
            return self.feeling(around, None, act);
        };
        let tether = Tether::new(*stiffness, &self.chain, from);
        self.feeling(around, Some(&FieldPotential::new(&tether, 1)), act)
    }

    /// Calls `act` with the energy of this guide in the body, in what pulls at it and in more.
    fn feeling<T>(
        &self,
        around: &dyn Potential,
        tether: Option<&dyn Potential>,
        act: impl FnOnce(&Problem<'_>) -> T,
    ) -> T {
        let body = along(&self.body, self.guide, self.chain.len());
        let pulls = self.guide.pull.iter().chain(&self.letting_go);
        let pull: Vec<_> = pulls.map(|pull| along(pull, self.guide, self.chain.len())).collect();
        let friction = self.friction.as_ref();
        let friction = friction.map(|friction| along(friction, self.guide, self.chain.len()));
        let mut felt: Vec<&dyn Potential> = vec![&body, around];
        felt.extend(friction.iter().map(|friction| friction as &dyn Potential));
        felt.extend(pull.iter().map(|pull| pull as &dyn Potential));
        felt.extend(lock::felt(self.lock.as_ref()));
        felt.extend(tether);
        act(&Problem::new(&self.chain, &felt))
    }

    /// The parts of the derivatives of the guide.
    pub(super) fn sensitivity(&self, others: &dyn Field) -> Result<Sensitivity, DerivativeError> {
        self.among(others, None, |problem| {
            Sensitivity::among_others(problem, self.settled.shape.clone(), self.resolution)
        })
    }

    /// Derivative by the controls (N m) of the energy of the guide in a field, at each of `samples` points per element.
    fn gradient_of(&self, field: &dyn Field, samples: u32) -> Vec<DVec3> {
        let field = FieldPotential::new(field, samples);
        Problem::new(&self.chain, &[]).gradient_of(&field, &self.settled.shape)
    }

    /// Derivative by the controls (N m) of the energy that the guide has of `others`.
    pub(super) fn gradient_among(&self, others: &dyn Field) -> Vec<DVec3> {
        self.gradient_of(others, self.resolution)
    }

    /// The same of its bed of hair, of a stiffness of 1 Pa.
    pub(super) fn gradient_by_hair(&self) -> Vec<DVec3> {
        let bed = BodyContact { hair: 1.0, skin: 0.0, hold: CombedHold::default(), ..self.body };
        self.gradient_of(&bed, body_samples(self.guide, self.chain.len()))
    }

    /// The same of skin, by the stiffness (Pa) that the description gives it.
    pub(super) fn gradient_by_skin(&self, spec: &HairstyleSpec) -> Vec<DVec3> {
        let skin = if own_skin(spec, self.guide) { self.guide.firmness } else { 0.0 };
        let skin = BodyContact { hair: 0.0, skin, hold: CombedHold::default(), ..self.body };
        self.gradient_of(&skin, body_samples(self.guide, self.chain.len()))
    }

    /// Energy (J) that the guide has of `others`.
    pub(super) fn energy_among(&self, others: &dyn Field) -> f64 {
        self.chain.energy(&self.settled.shape, &FieldPotential::new(others, self.resolution))
    }

    /// What the guide adds to the energy of the head (J), with its tether: `others` is its part of what it shares with them.
    pub(super) fn share(&self, others: &dyn Field, anchor: Option<&Anchor>) -> f64 {
        self.share_at(&self.settled, others, anchor)
    }

    /// The same where the guide is not yet.
    pub(super) fn share_at(
        &self,
        settled: &Settled,
        others: &dyn Field,
        anchor: Option<&Anchor>,
    ) -> f64 {
        let around = FieldPotential::new(others, self.resolution);
        self.held(&around, anchor, |problem| problem.energy(&settled.shape).total())
    }

    /// The guide as an equilibrium.
    pub(super) fn equilibrium(&self, others: &dyn Field, tolerance: f64) -> Equilibrium {
        let stopping = StoppingCriteria { tolerance, max_iterations: 0 };
        self.among(others, None, |problem| {
            // No iteration: only the gradient and the pivots of the shape as it is, hence the certificate.
            let riccati = Newton { escape_saddles: false, ..Newton::default() };
            let found = riccati.minimise(problem, self.settled.shape.clone(), stopping);
            let minimum = Minimum { iterations: self.settled.iterations, ..found };
            Equilibrium::from_minimum(problem, minimum)
        })
    }
}

/// All guides of a head where they rest alone, without the bed of hair that stands for the others, and their pairs; they
/// stick to what they touch there if they are `held`.
pub(super) fn wisps_with_pairs<'a>(
    spec: &HairstyleSpec,
    head: &'a Head,
    guides: &'a [Guide],
    alone: &'a [Equilibrium],
    hold: Hold,
) -> (Vec<Wisp<'a>>, ContactPairs) {
    let wisp =
        |(guide, alone)| Wisp::new(guide, alone, body(spec, head, guide, Layer::NONE), SPACING);
    let wisps = stuck(guides.iter().zip(alone).map(wisp).collect(), hold);
    let samples = wisps.iter().map(Wisp::samples).collect();
    let pairs = ContactPairs::new(samples, spec.contact.hair_stiffness);
    let rubs = hold != Hold::Free;
    let friction = guides.iter().filter(|_| rubs).map(|guide| guide.friction).collect();
    (wisps, pairs.with_friction(friction))
}

/// All guides of a head where they rest alone, on the bed of hair; they stick to what they touch there if they are `held`.
pub(super) fn wisps_on_bed<'a>(
    spec: &HairstyleSpec,
    head: &'a Head,
    guides: &'a [Guide],
    alone: &'a [Equilibrium],
    hold: Hold,
) -> Vec<Wisp<'a>> {
    let wisp = |(guide, alone): (&'a Guide, _)| {
        let bed = layer(spec, guide);
        Wisp::new(guide, alone, body(spec, head, guide, bed), SPACING_OF_DENSITY)
    };
    stuck(guides.iter().zip(alone).map(wisp).collect(), hold)
}

/// Guides that stick to what they touch if they are held.
fn stuck(mut wisps: Vec<Wisp<'_>>, hold: Hold) -> Vec<Wisp<'_>> {
    if hold == Hold::ByFriction {
        wisps.iter_mut().for_each(Wisp::stick);
    }
    wisps
}

/// Takes over how all wisps are pressed on skin and on each other; returns how far forces of friction were from the law.
pub(super) fn press(wisps: &mut [Wisp<'_>], pairs: Option<&mut ContactPairs>) -> Vec<FrictionGap> {
    let on_skin: Vec<FrictionGap> = parallel::map_mut(wisps, |_, wisp| wisp.press());
    joined(on_skin, pairs.map(ContactPairs::press))
}

/// How far forces of friction are from the law where wisps are now.
pub(super) fn friction_gaps(wisps: &[Wisp<'_>], pairs: Option<&ContactPairs>) -> Vec<FrictionGap> {
    let on_skin = parallel::map_slice(wisps, Wisp::friction_gap);
    joined(on_skin, pairs.map(ContactPairs::friction_gaps))
}

fn joined(on_skin: Vec<FrictionGap>, on_hair: Option<Vec<FrictionGap>>) -> Vec<FrictionGap> {
    let Some(on_hair) = on_hair else { return on_skin };
    on_skin.into_iter().zip(on_hair).map(|(skin, hair)| skin.and(hair)).collect()
}

/// Guides among each other as they are, each certified to a relative gradient of `tolerance` while the others hold still.
pub(super) fn rest_among(wisps: &[Wisp<'_>], pairs: &ContactPairs, tolerance: f64) -> Rest {
    let overlaps = wisps.iter().enumerate().map(|(i, wisp)| wisp.energy_among(&pairs.around(i)));
    // Each pair counts on both sides.
    let overlap_energy = overlaps.sum::<f64>() * 0.5;
    let guides = parallel::map(wisps.len(), |i| wisps[i].equilibrium(&pairs.around(i), tolerance));
    Rest { overlap_energy, locks: locks(wisps), ..Rest::apart(guides) }
}

/// How the hairs inside each wisp stick.
fn locks(wisps: &[Wisp<'_>]) -> Vec<Option<Yielding>> {
    wisps.iter().map(|wisp| wisp.lock().cloned()).collect()
}

/// Guides in what each feels of the others as they are, each with its own part of what they share, certified to a relative gradient of
/// `tolerance` while the others hold still.
pub(super) fn rest_in<'a>(
    wisps: &[Wisp<'_>],
    around: impl Fn(usize) -> Box<dyn Field + 'a> + Sync,
    tolerance: f64,
) -> Rest {
    let guides = parallel::map(wisps.len(), |i| wisps[i].equilibrium(&*around(i), tolerance));
    Rest { locks: locks(wisps), ..Rest::apart(guides) }
}

/// Where a tether holds a guide.
pub(super) struct Anchor {
    /// Stiffness of the tether (Pa).
    stiffness: f64,
    from: Shape,
}
