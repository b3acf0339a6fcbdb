//! A hanging helix as a spring: what a pull does to radius and pitch, in closed form.
//!
//! A uniform helix that is pulled along its axis with a force F and turns freely about it stays a helix. With the angle ψ of its tangent to the axis and
//! the turns φ′ per length, κ = φ′ sin ψ and τ = φ′ cos ψ, its energy per length is
//!
//! ```text
//! ½ EI (κ − κ⁰)² + ½ GJ (τ − τ⁰)² − F cos ψ.
//! ```
//!
//! Both derivatives vanish at rest, by φ′ and by ψ, and are linear in κ⁰ and τ⁰ (Love 1927, §271, "The theory of spiral springs"):
//!
//! ```text
//! κ⁰ = κ + F sin ψ cos ψ / (EI φ′),   τ⁰ = τ − F sin² ψ / (GJ φ′).
//! ```
//!
//! The weight below a place is F there. It holds where F changes little in a turn and away from the clamp; [`crate::statics`] starts from it.

use std::f64::consts::TAU;

/// Natural curvature and torsion (rad/m) of a fibre that hangs as a helix of a radius and a pitch (m) under a pull (N), with its bending and torsional
/// stiffness (N m²).
///
/// ```
/// // Without a pull the natural helix is the one that is seen.
/// let [curvature, torsion] = frisure_measure::natural_of_hanging(0.005, 0.02, 0.0, [1e-9, 5e-10]);
/// let square = curvature * curvature + torsion * torsion;
/// assert!((curvature / square - 0.005).abs() < 1e-12);
/// // A pull has made the helix narrower and longer than its natural one.
/// let [curvature, torsion] = frisure_measure::natural_of_hanging(0.005, 0.02, 1e-6, [1e-9, 5e-10]);
/// let square = curvature * curvature + torsion * torsion;
/// assert!(curvature / square > 0.005 && std::f64::consts::TAU * torsion / square < 0.02);
/// ```
#[must_use]
pub fn natural_of_hanging(radius: f64, pitch: f64, pull: f64, stiffness: [f64; 2]) -> [f64; 2] {
    let (sin, cos) = (TAU * radius / pitch).atan().sin_cos();
    // One turn of the tangent per pitch along the axis.
    let turning = TAU * cos / pitch;
    let [bending, torsional] = stiffness;
    [
        turning * sin + pull * sin * cos / (bending * turning),
        turning * cos - pull * sin * sin / (torsional * turning),
    ]
}

/// Radius and pitch (m) at which a fibre of a natural curvature and torsion (rad/m) hangs under a pull (N): the inverse of [`natural_of_hanging`], by
/// Newton's method on the logarithms.
pub(crate) fn hanging_of_natural(
    natural: [f64; 2],
    pull: f64,
    stiffness: [f64; 2],
) -> Option<[f64; 2]> {
    let square = natural[0] * natural[0] + natural[1] * natural[1];
    // Pulled in steps, each from the one before.
    let mut x = [(natural[0] / square).ln(), (TAU * natural[1] / square).ln()];
    const PULLS: i32 = 8;
    for step in 1..=PULLS {
        let pull = pull * f64::from(step) / f64::from(PULLS);
        let off = |x: [f64; 2]| {
            let found = natural_of_hanging(x[0].exp(), x[1].exp(), pull, stiffness);
            let scale = square.sqrt();
            [(found[0] - natural[0]) / scale, (found[1] - natural[1]) / scale]
        };
        for _ in 0..12 {
            let f = off(x);
            let d = 1e-6;
            let a = off([x[0] + d, x[1]]);
            let b = off([x[0], x[1] + d]);
            let j =
                [[(a[0] - f[0]) / d, (b[0] - f[0]) / d], [(a[1] - f[1]) / d, (b[1] - f[1]) / d]];
            let det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
            let change = [
                -(f[0] * j[1][1] - f[1] * j[0][1]) / det,
                -(f[1] * j[0][0] - f[0] * j[1][0]) / det,
            ];
            if !change.iter().all(|c| c.is_finite()) {
                return None;
            }
            x = [x[0] + change[0].clamp(-0.5, 0.5), x[1] + change[1].clamp(-0.5, 0.5)];
            if change[0].abs().max(change[1].abs()) < 1e-10 {
                break;
            }
        }
    }
    Some(x.map(f64::exp))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_agree() {
        let stiffness = [4.6e-9, 2.1e-9];
        for (radius, pitch) in [(0.008, 0.02), (0.002, 0.005), (0.012, 0.09)] {
            for pull in [0.0, 1e-6, 1e-5] {
                let natural = natural_of_hanging(radius, pitch, pull, stiffness);
                if natural[1] <= 0.0 {
                    continue;
                }
                let [r, p] = hanging_of_natural(natural, pull, stiffness).unwrap();
                assert!(
                    (r / radius - 1.0).abs() < 1e-6 && (p / pitch - 1.0).abs() < 1e-6,
                    "{radius} {pitch} {pull}: {r} {p}"
                );
            }
        }
    }
}
