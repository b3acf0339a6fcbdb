//! Hairs settle: tubes open, contacts are searched again and again, until all is at rest.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;

use super::descent::Descent;
use super::energy::Head;
use super::pairs::{PairSummary, Pairs};
use super::{SettledStrands, StrandCertificate, StrandSystem};

/// How far tubes are open, as a share of what they are in the end, in the stages on the way. From the tubes of single hairs to those
/// of locks in equal factors. Chosen by trial; not measured further.
const OPENINGS: [f64; 4] = [0.15, 0.3, 0.55, 1.0];

/// Most iterations between two searches for contacts, and in all. Chosen by trial; not measured further.
const ITERATIONS: usize = 12;
const MOST_ITERATIONS: usize = 300;

/// Contacts are searched anew when this share of the hairs has moved by so many contact radii since. Chosen by trial; not measured
/// further.
const MOVED: (f64, f64) = (0.01, 0.5);

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
    let mut head = Head::new(system);
    let mut state = head.state(controls);
    let mut trial = head.state(state.controls.clone());
    let mut pairs = Pairs::default();
    let mut iterations = 0;
    head.opening = OPENINGS[0];
    head.place(&mut state);
    let mut at_rest = StrandCertificate::default();
    for round in 0_usize.. {
        stage.check()?;
        let before = OPENINGS.get(round.saturating_sub(1)).copied().unwrap_or(1.0);
        head.opening = OPENINGS.get(round).copied().unwrap_or(1.0);
        // 1. Contacts where hairs are now; friction as it is there.
        let (found, summary) = pairs.search(&head.properties(), &state.points);
        pairs = found;
        head.evaluate(&pairs, &mut state);
        let gradients = head.gradients(&state);
        // 2. At rest with these?
        let opened = head.opening == 1.0 && before == 1.0;
        let balanced = gradients.iter().all(|&gradient| gradient <= tolerance);
        let certificate = certificate(&gradients, tolerance, &summary, iterations);
        at_rest = certificate;
        if opened && balanced && summary.change <= FRICTION || iterations >= MOST_ITERATIONS {
            break;
        }
        // 3. Downhill.
        let descent = Descent { head: &head, pairs: &pairs, stage, moved: MOVED };
        let most = ITERATIONS.min(MOST_ITERATIONS - iterations);
        // An evaluation counts, too, so that it ends where nothing can move.
        let spent = descent.run(&mut state, &mut trial, most, 0.3 * tolerance)?.max(1);
        iterations += spent;
        (0..spent).for_each(|_| stage.advance());
    }
    Ok(SettledStrands { controls: state.controls, certificate: at_rest })
}

fn certificate(
    gradients: &[f64],
    tolerance: f64,
    pairs: &PairSummary,
    iterations: usize,
) -> StrandCertificate {
    let count = gradients.len().max(1) as f64;
    StrandCertificate {
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
