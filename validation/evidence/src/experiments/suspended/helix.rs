//! The closed form of a helix under tension.

use super::hung::{B, Hung};
use crate::experiments::curls::turns;
use crate::extremes::larger;
use crate::numbers::rounded;
use crate::plot::{Mark, Plot, Scale};
use crate::{Finding, Limit, Stopped, Table};

/// The cosine of the angle at which a curl of κL hangs under a tension T L²/EI.
fn cosine(tension: f64, kappa: f64) -> f64 {
    let ratio = tension / kappa.powi(2);
    if ratio >= B {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let c: f64 = 0.5 * (low + high);
        if B * c / (B - (B - 1.0) * c * c).powi(2) < ratio {
            low = c;
        } else {
            high = c;
        }
    }
    0.5 * (low + high)
}

/// Height over length by the closed form.
fn height(gamma: f64, kappa: f64) -> f64 {
    let n = 2000;
    (0..n).map(|i| cosine(gamma * (f64::from(i) + 0.5) / f64::from(n), kappa)).sum::<f64>()
        / f64::from(n)
}

/// Angles and heights against the closed form.
pub(super) fn add(finding: &mut Finding) -> Result<(), Stopped> {
    let mut plot = Plot::new(
        "Descent of a curl, turn by turn",
        "arc length over length",
        "descent over arc length",
        [Scale::Linear; 2],
    );
    let mut table = Table::new(
        "Height of a hanging curl over its length",
        &["κL", "Γ", "turns of the natural circle", "closed form", "frisure", "difference"],
    );
    let (mut worst, mut angle) = (0.0_f64, 0.0_f64);
    for (i, (kappa, gamma)) in
        [(60.0, 2000.0), (60.0, 8000.0), (120.0, 6000.0), (120.0, 20_000.0)].into_iter().enumerate()
    {
        let hung = Hung::new(gamma, kappa)?;
        let tip = -hung.line[hung.line.len() - 1].z;
        let exact = height(gamma, kappa);
        worst = larger(worst, (tip - exact).abs());
        let name = format!("κL = {kappa}, Γ = {gamma}");
        let steps = (0..=100).map(|k| f64::from(k) / 100.0);
        plot.add(&name, Mark::Line, steps.map(|s| (s, cosine(gamma * (1.0 - s), kappa)))).colour =
            Some(i);
        let turns = turns(&hung.line);
        // Clamp and tip influence the first turns at either end.
        for turn in turns.iter().skip(1).filter(|t| t.middle > 0.1) {
            let exact = cosine(gamma * (1.0 - turn.middle), kappa);
            angle = larger(angle, (turn.descent - exact).abs());
        }
        plot.add("", Mark::Points, turns.iter().map(|t| (t.middle, t.descent))).colour = Some(i);
        table.row([
            format!("{kappa}"),
            format!("{gamma}"),
            format!("{:.1}", kappa / std::f64::consts::TAU),
            format!("{exact:.4}"),
            format!("{tip:.4}"),
            rounded(tip - exact, 4),
        ]);
    }
    finding.plot(plot);
    finding.table(table);
    finding.check(
        "largest difference of the height from the closed form, over the length",
        worst,
        Limit::AtMost(0.005),
    );
    finding.check(
        "largest difference of a turn's descent from the closed form, except for the turns at the ends",
        angle,
        Limit::AtMost(0.01),
    );
    Ok(())
}
