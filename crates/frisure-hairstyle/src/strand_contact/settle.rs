//! Hairs settle: contacts are searched again and again, until all is at rest.

use frisure_progress::{Cancelled, StageCounter};
use glam::DVec3;

use super::energy::Head;
use super::interaction::{Interaction, InteractionSummary};
use super::linear::LinearRule;
use super::newton::Newton;
use super::pair_system::PairSystem;
use super::{SettledStrands, StrandCertificate, StrandSystem};

/// Most iterations in all. Chosen by trial; not measured further.
const MOST_ITERATIONS: usize = 600;

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
    let mut interaction = PairSystem::new(head.properties());
    let mut state = head.state(controls);
    let far = std::env::var("FAR").map_or(1.0, |x| x.parse().unwrap());
    let eta = std::env::var("ETA").map_or(0.1, |x| x.parse().unwrap());
    let most = std::env::var("MOST").map_or(50, |x| x.parse().unwrap());
    let mut newton = Newton::new(&head, stage, far);
    let mut iterations = 0;
    head.place(&mut state);
    let least = std::env::var("LEAST").map_or(5, |x| x.parse().unwrap());
    let stages: Vec<(f64, usize, f64)> = std::env::var("STAGES").map_or(vec![], |x| x.split(',').map(|s| { let mut p = s.split(':'); (p.next().unwrap().parse().unwrap(), p.next().unwrap().parse().unwrap(), p.next().unwrap().parse().unwrap()) }).collect());
    let debug = std::env::var("DEBUG").is_ok();
    let begin = std::time::Instant::now();
    let start = state.points.clone();
    let mut all = 0;
    let certificate = loop {
        stage.check()?;
        let mut until = 0;
        let stage_now = stages.iter().find(|s| { until += s.1; iterations < until }).copied().unwrap_or((1.0, 0, far));
        interaction.harden(stage_now.0);
        newton.farthest = stage_now.2;
        // 1. Contacts where hairs are now; friction as it is there.
        let t = std::time::Instant::now();
        let mut summary = interaction.search(&state.points, iterations == MOST_ITERATIONS);
        let t1 = t.elapsed();
        head.evaluate(&mut interaction, &mut state);
        let t2 = t.elapsed();
        // 2. At rest with these?
        let mut gradients = head.gradients(&state);
        if gradients.iter().all(|&gradient| gradient <= tolerance) && summary.change <= FRICTION {
            // With everything that is near.
            summary = interaction.search(&state.points, true);
            head.evaluate(&mut interaction, &mut state);
            gradients = head.gradients(&state);
        }
        let certificate = certificate(&gradients, tolerance, &summary, iterations);
        let at_rest = certificate.balanced == gradients.len() && summary.change <= FRICTION;
        if (at_rest && stage_now.1 == 0) || iterations >= MOST_ITERATIONS {
            break certificate;
        }
        // 3. Downhill.
        let e = state.energy;
        let rule = LinearRule { reduction: eta, most, least };
        let done = newton.step(&mut interaction, &mut state, rule)?;
        all += done.linear;
        if debug {
            let after = head.gradients(&state);
            let rms = (after.iter().map(|g| g * g).sum::<f64>() / after.len() as f64).sqrt();
            let worst = (0..after.len()).max_by(|a, b| gradients[*a].total_cmp(&gradients[*b])).unwrap();
            eprintln!("   after rms {rms:.2e} worst {worst} {:.2e} -> {:.2e} moved {:.2e}", gradients[worst], after[worst], newton.far[worst].0);
            let moved = state.points.iter().zip(&start).map(|(a, b)| a.distance(*b));
            let (sum, max) = moved.fold((0.0, 0.0f64), |(s, m), d| (s + d, m.max(d)));
            eprintln!(
                "{iterations} t {:.2} E {e:.9e} bal {} rms {:.2e} max {:.2e} chg {:.1e} touch {} deep {:.2} | lin {} ({all}) short {:.3} at {:.2} tr {} hold {} damp {} drag {} | moved {:.2e} {:.2e} | search {:.1?} eval {:.1?} step {:.1?}",
                begin.elapsed().as_secs_f64(), certificate.balanced, certificate.rms_gradient, certificate.largest_gradient, summary.change,
                summary.touching, summary.deepest, done.linear, done.shortened, done.at, done.trials, done.holds, newton.linear.damping.iter().filter(|d| **d > 0.0).count(), newton.linear.drag.iter().filter(|d| **d > 0.0).count(),
                sum / start.len() as f64, max, t1, t2 - t1, t.elapsed() - t2
            );
        }
        iterations += 1;
        stage.advance();
    };
    Ok(SettledStrands { controls: state.controls, certificate })
}

fn certificate(
    gradients: &[f64],
    tolerance: f64,
    pairs: &InteractionSummary,
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
