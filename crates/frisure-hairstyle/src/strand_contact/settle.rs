//! Hairs settle: contacts are searched again and again, until all is at rest.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;

use super::density_system::DensitySystem;
use super::energy::{Head, State};
use super::interaction::{Interaction, InteractionSummary};
use super::linear::LinearRule;
use super::newton::Newton;
use super::pair_system::PairSystem;
use super::{InteractionForm, SettledStrands, StrandCertificate, StrandSystem};

/// Most iterations in all. Chosen by trial; not measured further.
const MOST_ITERATIONS: usize = 600;

/// Steps without a way down after which it ends. Chosen: hairs are held back more from one to the next; what once stood still for 20 did so for 200.
const STUCK: usize = 15;

/// The way to rest goes from soft contact to hard contact, so that hairs that start in each other part without haste: hardness of the
/// contact between hairs, iterations, and how far hairs may move in each of them, in contact radii. Chosen by trial.
const STAGES: [(f64, usize, f64); 6] = [
    (1e-5, 2, 50.0),
    (1e-4, 2, 30.0),
    (1e-3, 3, 20.0),
    (1e-2, 4, 10.0),
    (0.1, 5, 5.0),
    (0.3, 5, 3.0),
];

/// The same of the last stage. Chosen by trial.
const FARTHEST: f64 = 2.0;

/// How far (m) hairs that press as a volume may move in a step. Chosen: half of a cell.
const DENSITY_STEP: f64 = 1.5e-3;

/// How well linear systems are solved. Chosen by trial.
const LINEAR: LinearRule = LinearRule { reduction: 0.1, least: 5, most: 20 };

/// Change of friction limits over their sum at which friction is at rest: (F3) with a share that is below the tolerance of forces.
const FRICTION: f64 = 1e-3;

/// The number of iterations that [`settle`] reports.
pub(crate) fn stages() -> usize {
    MOST_ITERATIONS
}

/// Brings hairs to rest together, from these turns of their joints (rad); a hair is balanced at `tolerance`, relative to its moment scale.
///
/// # Errors
/// [`Cancelled`], if the progress says so.
pub(crate) fn settle(
    system: &StrandSystem<'_>,
    controls: Vec<DVec3>,
    tolerance: f64,
    stage: &StageCounter<'_>,
) -> Result<SettledStrands, Cancelled> {
    let head = Head::new(system);
    // A volume parts hairs little: they begin where each rests without it. Hairs that touch begin where they do not hang in each other.
    let controls = match system.form {
        InteractionForm::Contacts => controls,
        InteractionForm::Density => head.alone(controls, tolerance),
    };
    let mut pairs;
    let mut density;
    let interaction: &mut dyn Interaction = match system.form {
        InteractionForm::Contacts => {
            pairs = PairSystem::new(head.properties());
            &mut pairs
        }
        InteractionForm::Density => {
            density = DensitySystem::new(&head.properties());
            &mut density
        }
    };
    let mut state = head.state(controls);
    let mut newton = Newton::new(&head, stage, FARTHEST);
    let (mut iterations, mut stuck) = (0, 0);
    let mean_radius = system.radii.iter().sum::<f64>() / system.radii.len().max(1) as f64;
    let widest_step = DENSITY_STEP / mean_radius.max(1e-9);
    head.place(&mut state);
    let soft = system.form == InteractionForm::Contacts && begins_soft(&head, &mut state);
    let certificate = loop {
        stage.check()?;
        let (hardness, farthest) = match system.form {
            InteractionForm::Contacts => stage_at(iterations, soft),
            InteractionForm::Density => (1.0, widest_step),
        };
        interaction.harden(hardness);
        newton.farthest = farthest;
        // 1. Contacts where hairs are now; friction as it is there.
        let mut summary =
            interaction.search(&state.points, iterations == MOST_ITERATIONS || stuck == STUCK);
        head.evaluate(interaction, &mut state);
        // 2. At rest with these?
        let mut gradients = head.gradients(&state);
        if gradients.iter().all(|&gradient| gradient <= tolerance) && summary.change <= FRICTION {
            // With everything that is near.
            let InteractionSummary { ratio, change, .. } = summary;
            summary = interaction.search(&state.points, true);
            // What friction did since the last step; nothing has moved since.
            (summary.ratio, summary.change) =
                (summary.ratio.max(ratio), summary.change.max(change));
            head.evaluate(interaction, &mut state);
            gradients = head.gradients(&state);
        }
        let certificate = certificate(system.form, &gradients, tolerance, &summary, iterations);
        let at_rest = certificate.balanced == gradients.len() && summary.change <= FRICTION;
        let ends = iterations >= MOST_ITERATIONS || stuck >= STUCK;
        if (at_rest && hardness == 1.0) || ends {
            break certificate;
        }
        // 3. Downhill.
        stuck = if newton.step(interaction, &mut state, LINEAR)? { 0 } else { stuck + 1 };
        iterations += 1;
        stage.advance();
    };
    Ok(SettledStrands { controls: state.controls, certificate })
}

/// Hardness of contact, and how far hairs may move (contact radii), in an iteration of a way that begins with soft contact or not.
fn stage_at(iteration: usize, soft: bool) -> (f64, f64) {
    let mut end = 0;
    for (hardness, iterations, farthest) in STAGES.iter().filter(|_| soft) {
        end += iterations;
        if iteration < end {
            return (*hardness, *farthest);
        }
    }
    (1.0, FARTHEST)
}

/// Whether contact begins soft: where hairs start in each other, so that they part without haste. Where they only touch it does not, so that
/// none goes through what bears it: where forces are less than those of weight.
fn begins_soft(head: &Head<'_>, state: &mut State) -> bool {
    // Contacts of its own: nothing has stuck yet.
    let mut pairs = PairSystem::new(head.properties());
    pairs.search(&state.points, true);
    head.evaluate(&mut pairs, state);
    let gradients = head.gradients(state);
    gradients.iter().map(|g| g * g).sum::<f64>() > gradients.len() as f64
}

fn certificate(
    form: InteractionForm,
    gradients: &[f64],
    tolerance: f64,
    pairs: &InteractionSummary,
    iterations: usize,
) -> StrandCertificate {
    let count = gradients.len().max(1) as f64;
    StrandCertificate {
        form,
        strands: gradients.len(),
        represented: 1.0,
        contacts: pairs.touching,
        balanced: gradients.iter().filter(|&&gradient| gradient <= tolerance).count(),
        largest_gradient: gradients.iter().copied().fold(0.0, f64::max),
        rms_gradient: (gradients.iter().map(|g| g * g).sum::<f64>() / count).sqrt(),
        deepest_overlap: pairs.deepest,
        friction_ratio: pairs.ratio,
        friction_change: pairs.change,
        imbalance: pairs.imbalance,
        iterations,
    }
}
