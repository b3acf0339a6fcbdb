//! Closed forms of small deformations.

use glam::DVec2;

/// q L³/√(EI GJ) at which a deep cantilever under its own weight buckles sideways: Prandtl and Michell
/// 1899; 12.85 in Timoshenko & Gere, *Theory of Elastic Stability*, §6.3. The angle of twist β obeys
/// `β'' + (Q²/4) σ⁴ β = 0` at the distance σ from the tip, so that `β = √σ J(Qσ³/6)` of order −1/6.
#[must_use]
pub fn prandtl_michell() -> f64 {
    6.0 * first_zero(-1.0 / 6.0)
}

/// ρSgL³/EI at which a straight rod clamped upright buckles: Greenhill 1881.
#[must_use]
pub fn greenhill() -> f64 {
    2.25 * first_zero(-1.0 / 3.0).powi(2)
}

/// The first zero of the Bessel function of an order between −½ and 0, by its series and bisection.
fn first_zero(order: f64) -> f64 {
    let value = |x: f64| {
        let (mut term, mut sum) = (1.0, 1.0);
        for k in 1..40 {
            let k = f64::from(k);
            term *= -0.25 * x * x / (k * (order + k));
            sum += term;
        }
        sum
    };
    let (mut low, mut high) = (0.5, 2.4);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if value(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// Points (over the length) of a hair of Anjyo, Usami & Kurihara 1992: a chain of rigid segments that leaves
/// the root at the angle `rise` (rad) over the horizontal. Each segment is rotated from the one before, along
/// the direction across the root, by the angle of the cantilever formula for small deflections,
/// `h M/EI`, with the moment `M = ½ ρSg (L − s)² cos(rise)` of the weight on the hair as it grew.
#[must_use]
pub fn anjyo(gamma: f64, rise: f64, segments: usize) -> Vec<DVec2> {
    let h = 1.0 / segments as f64;
    let mut along = DVec2::from_angle(rise);
    // The component of down across the root.
    let across = DVec2::new(rise.sin(), -rise.cos());
    let mut at = DVec2::ZERO;
    let mut points = vec![at];
    for i in 0..segments {
        let left = 1.0 - (i as f64 + 0.5) * h;
        along = (along + across * (0.5 * h * gamma * left * left * rise.cos())).normalize();
        at += along * h;
        points.push(at);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_are_those_of_the_tables() {
        assert!((greenhill() - 7.837_347_438_943_481).abs() < 1e-12);
        assert!((prandtl_michell() - 12.85).abs() < 0.01, "{}", prandtl_michell());
    }

    #[test]
    fn a_light_hair_of_anjyo_is_the_linear_beam() {
        let points = anjyo(1e-3, 0.0, 400);
        assert!((points[400].y / (-1e-3 / 8.0) - 1.0).abs() < 5e-3, "{}", points[400].y);
    }
}
