//! Hairs settle: contacts are searched again and again, until all is at rest.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;

use super::descent::Descent;
use super::energy::Head;
use super::pairs::{PairSummary, Pairs};
use super::{SettledStrands, StrandCertificate, StrandSystem};

/// Most iterations between two searches for contacts, and in all. Chosen by trial; not measured further.
const ITERATIONS: usize = 12;
const MOST_ITERATIONS: usize = 600;

/// Contacts are searched anew when this share of the hairs has moved by so many contact radii since. Chosen by trial; not measured
/// further.
const MOVED: (f64, f64) = (0.25, 1.5);

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
    let mut state = head.state(controls);
    let mut trial = head.state(state.controls.clone());
    let mut pairs = Pairs::default();
    let mut iterations = 0;
    head.place(&mut state);
    let certificate = loop {
        stage.check()?;
        // 1. Contacts where hairs are now; friction as it is there.
        let (found, summary) = pairs.search(&head.properties(), &state.points);
        pairs = found;
        head.evaluate(&pairs, &mut state);
        // 2. At rest with these?
        let gradients = head.gradients(&state);
        let certificate = certificate(&gradients, tolerance, &summary, iterations);
        let at_rest = certificate.balanced == gradients.len() && summary.change <= FRICTION;
        if at_rest || iterations >= MOST_ITERATIONS {
            break certificate;
        }
        // 3. Downhill.
        let descent = Descent { head: &head, pairs: &pairs, stage, moved: MOVED };
        let most = ITERATIONS.min(MOST_ITERATIONS - iterations);
        // An evaluation counts, too, so that it ends where nothing can move.
        let spent = descent.run(&mut state, &mut trial, most, 0.3 * tolerance)?.max(1);
        iterations += spent;
        (0..spent).for_each(|_| stage.advance());
    };
    Ok(SettledStrands { controls: state.controls, certificate })
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
