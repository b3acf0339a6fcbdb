//! All guides of a head at rest together, by continuation in the hardness of hair.
//!
//! From guides that rest alone on the bed of hair, which stands for the others, the bed is exchanged for the other wisps step
//! by step: each step is an implicit step of an overdamped motion, solved by Newton's method for all guides together. So
//! which wisp lies on which is decided by the way there, not by where an iteration stops, and a small change of the input
//! moves guides little, as long as no wisp snaps past another. docs/theory.md, "All guides at once"

mod certificate;
mod elimination;
mod hessian;
mod line_search;
mod newton;
mod others;
mod sensitivity;
mod state;

pub use self::sensitivity::{HeadChange, HeadDerivativeError, HeadGradient, HeadSensitivity};

use frisure_progress::{Cancelled, Progress, StageCounter};
use frisure_rod::potential::Yielding;
use frisure_rod::{Equilibrium, Stability};

use self::certificate::lowest_eigenvalue;
use self::hessian::Preconditioner;
use self::newton::{Descent, minimise};
use self::state::HeadState;
use super::friction_solver::Hold;
use super::letting_go::loads;
use crate::contact::Pull;
use crate::guides::Guide;
use crate::hairstyle::{JointCertificate, Rest};
use crate::head::Head;
use crate::spec::HairstyleSpec;

/// Share of the stiffness of hair at the first stage, and the number of stages from there to the whole, each by the same
/// factor. Chosen: at a thousandth wisps hardly move each other. With 8 stages some straight hair is no longer continuous.
const FIRST_SHARE: f64 = 1e-3;
const HARDENING_STAGES: i32 = 20;

/// Stiffness of the tethers at the first share and at the last, as shares of the stiffness at which a guide's weight moves it
/// by 4 mm, so that a stage moves it by about a centimetre. Chosen by trial: with 0.06 at the last, Newton's method does
/// not come to rest in some stages.
const TETHERS: (f64, f64) = (0.6, 0.3);

/// Factor on the tethers from one stage to the next at full hardness, and the stiffness below which they are let go: there a
/// stage moves no guide by a micrometre.
const LOOSENING: f64 = 0.5;
const LOOSEST: f64 = 1e-4;

/// Relative gradient at which a stage ends. Chosen: what is left is amplified by later stages; with 1e-4 and 1e-6 more small
/// changes of the input end in another minimum.
const STEP_TOLERANCE: f64 = 1e-8;

/// Steps of Newton's method after which tethers are made firmer, by a factor, where the guides are then; how often that is
/// tried; and the first stiffness where there was none. Chosen: most stages take 3 to 40 steps.
const MOST_STEPS: usize = 60;
const FIRMER: f64 = 4.0;
const MOST_TRIES: usize = 8;
const FIRST_TETHER: f64 = 1e-3;

/// Relative gradient of the head at rest, and the most steps that it takes without tethers: a guard, one or two are usual.
const TOLERANCE: f64 = 1e-8;
const MOST_LAST_STEPS: usize = 100;

/// Relative gradient below which the head counts as at rest where rounding forbids [`TOLERANCE`]: 1e-5 of EI/L + ρSgL² moves
/// no tip by a hundredth of a millimetre.
const CERTIFIED: f64 = 1e-5;

/// Most times that the last stage is done again until friction agrees with where wisps are. A guard; five are usual.
const MOST_ROUNDS: usize = 60;

/// One stage of the continuation: an implicit step of the overdamped motion.
#[derive(Clone, Copy, Debug)]
struct Stage {
    /// Share of the stiffness of hair.
    share: f64,
    /// Stiffness of the tethers, as a share of the guides' firmness.
    tether: f64,
}

/// The stages of the continuation; where the guides rested among each other before, those at full hardness.
fn stages(among_each_other: bool, density: bool) -> Vec<Stage> {
    if density {
        // Smooth enough for Newton's method from guides that rest alone on the bed of hair.
        return vec![Stage { share: 1.0, tether: 0.0 }];
    }
    let (first, last) = TETHERS;
    let hardening = (0..=HARDENING_STAGES).map(|k| {
        let done = f64::from(k) / f64::from(HARDENING_STAGES);
        Stage { share: FIRST_SHARE.powf(1.0 - done), tether: first * (last / first).powf(done) }
    });
    let looser = std::iter::successors(Some(last * LOOSENING), |tether| Some(tether * LOOSENING));
    let loosening = looser.take_while(|tether| *tether > LOOSEST).chain([0.0]);
    let loosening = loosening.map(|tether| Stage { share: 1.0, tether });
    if among_each_other { loosening.collect() } else { hardening.chain(loosening).collect() }
}

/// How [`settle`] works.
pub(super) struct JointOptions<'a> {
    /// Whether guides start where they rested among each other, not alone on the bed of hair.
    pub(super) among_each_other: bool,
    /// Whether friction holds guides near where they start.
    pub(super) hold: Hold,
    /// How the hairs inside each wisp stick.
    pub(super) locks: Vec<Option<Yielding>>,
    /// What lets go of each guide, in steps.
    pub(super) gone: &'a [Option<Pull>],
    /// Most steps, if guides need not come to rest; then nothing is certified of all together.
    pub(super) most: Option<usize>,
}

/// Brings guides to rest together, from where they are in `start`. Friction, if there is any, follows them after each stage.
///
/// # Errors
/// [`Cancelled`], if the work is cancelled.
pub(super) fn settle(
    spec: &HairstyleSpec,
    head: &Head,
    guides: &[Guide],
    start: &[Equilibrium],
    JointOptions { among_each_other, hold, locks, gone, most }: JointOptions<'_>,
    progress: &dyn Progress,
) -> Result<Rest, Cancelled> {
    let counter = StageCounter::new(progress, "wisps making way", 1);
    let mut state = HeadState::new(spec, head, guides, start, hold);
    state.set_locks(locks);
    if let Some(most) = most {
        state.press();
        let Descent { steps, .. } = minimise(&mut state, TOLERANCE, most, &counter)?;
        state.follow_locks();
        return Ok(Rest {
            sweeps: steps,
            friction: state.friction_ratios(),
            ..state.rest(CERTIFIED)
        });
    }
    let loads = loads(gone);
    let stages = stages(among_each_other, state.is_density());
    let mut steps = 0;
    for (l, load) in loads.iter().enumerate() {
        // What slipped inside wisps under the load before sticks there.
        state.follow_locks();
        state.let_go(gone, *load);
        for (k, stage) in stages.iter().enumerate() {
            state.harden(stage.share);
            state.press();
            steps += settle_stage(&mut state, stage.tether, &counter)?;
            let done = l as f64 + (k + 1) as f64 / stages.len() as f64;
            counter.at(done / loads.len() as f64);
        }
    }
    let mut agrees = state.friction_agrees();
    for _ in 0..MOST_ROUNDS {
        if agrees {
            break;
        }
        state.press();
        steps += settle_stage(&mut state, 0.0, &counter)?;
        agrees = state.friction_agrees();
    }
    state.follow_locks();
    let mut rest = state.rest(CERTIFIED);
    let certificate = certificate(&state, spec.seed);
    let joint = JointCertificate { stable: agrees && certificate.stable, ..certificate };
    if !joint.stable {
        // A guide at a minimum while the others hold still is not at rest if they do not.
        let stability = if joint.gradient_norm > CERTIFIED || !agrees {
            Stability::NotConverged
        } else {
            Stability::Saddle
        };
        for guide in &mut rest.guides {
            guide.certificate.stability = stability;
        }
    }
    let friction = state.friction_ratios();
    Ok(Rest { sweeps: steps, joint: Some(joint), friction, ..rest })
}

/// Brings the guides to rest on tethers of a given stiffness; returns the steps taken.
fn settle_stage(
    state: &mut HeadState<'_>,
    tether: f64,
    counter: &StageCounter<'_>,
) -> Result<usize, Cancelled> {
    let mut steps = 0;
    let mut firmness = tether;
    for _ in 0..MOST_TRIES {
        state.hold(firmness);
        let free = firmness == 0.0;
        let (tolerance, most) =
            if free { (TOLERANCE, MOST_LAST_STEPS) } else { (STEP_TOLERANCE, MOST_STEPS) };
        let descent = minimise(state, tolerance, most, counter)?;
        steps += descent.steps;
        if descent.at_rest && firmness == tether {
            break;
        }
        // Not at rest: shorter steps of the motion from where the guides are now, then back to the length asked for.
        firmness = if descent.at_rest { tether } else { (FIRMER * firmness).max(FIRST_TETHER) };
    }
    Ok(steps)
}

/// What holds of all guides together.
fn certificate(state: &HeadState<'_>, seed: u64) -> JointCertificate {
    let hessian = state.hessian();
    let gradient_norm = state.relative(&hessian.gradient());
    // A guide that has to be damped has a direction in which the energy curves downwards.
    let lowest = Preconditioner::new(&hessian)
        .filter(|preconditioner| preconditioner.exact)
        .map(|preconditioner| lowest_eigenvalue(&hessian, &preconditioner, seed));
    let positive = lowest.is_some_and(|lowest| lowest.value > lowest.error);
    JointCertificate {
        gradient_norm,
        lowest_eigenvalue: lowest.map(|lowest| lowest.value),
        eigenvalue_error: lowest.map_or(0.0, |lowest| lowest.error),
        stable: positive && gradient_norm <= CERTIFIED,
    }
}

#[cfg(test)]
mod tests {
    use super::hessian::{Controls, Coupling, add, dot, negative, zero};
    use super::*;
    use crate::random::{Purpose, Stream};
    use crate::{PredictOptions, preset};
    use glam::DVec3;

    #[test]
    fn the_joint_hessian_is_the_derivative_of_the_joint_gradient() {
        let head = Head::mannequin();
        let mut spec = preset("caucasian-curly").unwrap().spec();
        spec.contact.hair = crate::spec::HairContact::Wisps;
        spec.wisps.count = 40;
        spec.equilibrium.resolution = frisure_rod::Resolution::Elements(10);
        let style = crate::predict(&spec, &head, PredictOptions::default(), &()).unwrap();
        // With friction: wisps stick, so that it is there on both sides of the differences.
        spec.contact.friction = 0.3;
        let (guides, rest) = (&style.guides, &style.rest.guides);
        let mut state = HeadState::new(&spec, &head, guides, rest, Hold::ByFriction);
        state.press();
        state.hold(0.1);
        let hessian = state.hessian();
        let Coupling::Pairs(contacts) = &hessian.coupling else { panic!("wisps in pairs") };
        assert!(contacts.iter().map(Vec::len).sum::<usize>() > 1000);
        let mut random = Stream::new(1, Purpose::Lanczos, 1);
        let mut step = zero(&hessian.gradient());
        step.iter_mut().flatten().for_each(|x| *x = DVec3::splat(random.gaussian()) * 1e-4);
        state.make_room(&state.lengths(&step));
        let from = state.shapes();
        let mut gradient = |fraction: f64| -> Controls {
            state.go(&from, &step, fraction);
            state.hessian().gradient()
        };
        // Central differences; the energy is twice differentiable, so that they are exact to first order only.
        let mut expected = gradient(0.1);
        add(&mut expected, -1.0, &gradient(-0.1));
        expected.iter_mut().flatten().for_each(|g| *g /= 0.2);
        let mut gap = hessian.apply(&step).moments;
        let size = dot(&gap, &gap).sqrt();
        add(&mut gap, 1.0, &negative(&expected));
        assert!(dot(&gap, &gap).sqrt() < 1e-4 * size, "{} of {size}", dot(&gap, &gap).sqrt());
    }
}
