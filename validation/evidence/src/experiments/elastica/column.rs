//! Euler's column beyond its critical load.

use std::f64::consts::{FRAC_PI_2, PI};

use frisure::rod::potential::{Derivatives, ElementState, Potential};
use frisure::rod::{Stability, equilibrium};
use glam::{DVec2, DVec3};

use crate::extremes::larger;
use crate::plot::{Mark, Plot, Scale};
use crate::rods::{Bar, LENGTH, to_accuracy};
use crate::{Finding, Limit, Stopped, Table};

/// A constant force on the tip (N).
struct TipLoad(DVec3);

impl Potential for TipLoad {
    fn depends_on_position(&self) -> bool {
        false
    }

    fn element_energy(&self, element: &ElementState<'_>) -> f64 {
        -element.work(self.0, 1.0, 0.0)
    }

    fn add_element_derivatives(&self, element: &ElementState<'_>, sum: &mut Derivatives) {
        element.add_work_derivatives(-self.0, 1.0, 0.0, sum);
    }
}

/// Complete elliptic integrals K and E of the modulus k, by the arithmetic–geometric mean.
fn elliptic(k: f64) -> (f64, f64) {
    let (mut a, mut b) = (1.0, (1.0 - k * k).sqrt());
    let (mut sum, mut power) = (0.5 * k * k, 1.0);
    for _ in 0..40 {
        let c = 0.5 * (a - b);
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
        sum += power * c * c;
        power *= 2.0;
    }
    let whole = FRAC_PI_2 / a;
    (whole, whole * (1.0 - sum))
}

/// Columns whose tip leans by these angles (degrees).
const ANGLES: [f64; 9] = [5.0, 20.0, 40.0, 60.0, 90.0, 120.0, 140.0, 160.0, 175.0];

pub(super) fn add(finding: &mut Finding) -> Result<(), Stopped> {
    let mut table = Table::new(
        "Euler's column with a load at its tip",
        &["angle of the tip", "4PL²/π²EI", "sideways", "height", "error over the length"],
    );
    let mut plot = Plot::new(
        "Euler's column",
        "sideways over the length",
        "height over the length",
        [Scale::Linear, Scale::Linear],
    );
    plot.equal = true;
    let mut worst = 0.0_f64;
    let mut tips = Vec::new();
    for angle in ANGLES {
        let k = (0.5 * angle.to_radians()).sin();
        let (whole, second) = elliptic(k);
        let exact = DVec2::new(2.0 * k / whole, 2.0 * second / whole - 1.0);
        let line = bent(whole * whole)?;
        let tip = line[line.len() - 1];
        let error = tip.distance(exact);
        worst = larger(worst, error);
        table.row([
            format!("{angle:.0}°"),
            format!("{:.4}", 4.0 * whole * whole / (PI * PI)),
            format!("{:.6}", exact.x),
            format!("{:.6}", exact.y),
            format!("{error:.1e}"),
        ]);
        plot.add("", Mark::Line, line.into_iter().map(|p| (p.x, p.y))).colour = Some(0);
        tips.push((exact.x, exact.y));
    }
    plot.add("tips by elliptic integrals", Mark::Points, tips).colour = Some(1);
    finding.table(table);
    finding.plot(plot);
    finding.check(
        "largest error of the tip of Euler's column over the length, 1e-6 requested",
        worst,
        Limit::AtMost(1e-6),
    );
    Ok(())
}

/// The line of a column under a load PL²/EI, in its own plane.
fn bent(load: f64) -> Result<Vec<DVec2>, Stopped> {
    let rod = Bar { gamma: 0.0, tangent: DVec3::Z, d1: DVec3::X, ..Bar::STRAIGHT }.rod()?;
    let force = TipLoad(DVec3::NEG_Z * (load * rod.stiffness().x / LENGTH.powi(2)));
    let found = equilibrium(&rod, &[&force], &to_accuracy(&rod, 1e-6));
    if found.certificate.stability != Stability::Stable {
        return Err(Stopped::Other(format!("Euler's column: {:?}", found.certificate)));
    }
    let across = |p: DVec3| DVec2::new(p.truncate().length(), p.z) / LENGTH;
    Ok(found.centre_line(101).into_iter().map(across).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn elliptic_integrals_are_those_of_the_tables() {
        // Abramowitz & Stegun, table 17.1, m = 0.5.
        let (k, e) = elliptic(0.5_f64.sqrt());
        assert!((k - 1.854_074_677_301_372).abs() < 1e-14, "{k}");
        assert!((e - 1.350_643_881_047_675).abs() < 1e-14, "{e}");
    }
}
