//! Signed-distance clay: a few shapes, and smooth ways to add and remove them.
//!
//! After Quilez's notes on distance functions, <https://iquilezles.org/articles/distfunctions>.
//! Nothing here is an exact distance; all are close to one near their surface.

use glam::{DMat3, DVec3};

/// An ellipsoid with half axes `radii`.
pub(crate) fn ellipsoid(p: DVec3, centre: DVec3, radii: DVec3) -> f64 {
    let q = p - centre;
    // k₁ (k₁ − 1)/k₂ with k₁ = |q/r| and k₂ = |q/r²|: first order in the distance near the surface.
    let scaled = (q / radii).length();
    let slope = (q / (radii * radii)).length();
    if slope < 1e-12 { -radii.min_element() } else { scaled * (scaled - 1.0) / slope }
}

/// An ellipsoid turned about the x axis by `pitch` (its +y towards +z), then about z by `yaw` (rad).
pub(crate) fn turned(p: DVec3, centre: DVec3, radii: DVec3, pitch: f64, yaw: f64) -> f64 {
    let frame = DMat3::from_rotation_z(yaw) * DMat3::from_rotation_x(pitch);
    ellipsoid(frame.transpose() * (p - centre), DVec3::ZERO, radii)
}

/// Two balls and the cone that touches both.
#[inline]
pub(crate) fn cone(p: DVec3, a: DVec3, b: DVec3, ra: f64, rb: f64) -> f64 {
    let ba = b - a;
    let l2 = ba.length_squared();
    let rr = ra - rb;
    let a2 = l2 - rr * rr;
    let il2 = l2.recip();
    let pa = p - a;
    let y = pa.dot(ba);
    let z = y - l2;
    let x2 = (pa * l2 - ba * y).length_squared();
    let y2 = y * y * l2;
    let z2 = z * z * l2;
    let k = rr.signum() * rr * rr * x2;
    if z.signum() * a2 * z2 > k {
        return (x2 + z2).sqrt() * il2 - rb;
    }
    if y.signum() * a2 * y2 < k {
        return (x2 + y2).sqrt() * il2 - ra;
    }
    ((x2 * a2 * il2).sqrt() + y * rr) * il2 - ra
}

/// A chain of cones through balls `(centre, radius)`.
#[inline]
pub(crate) fn chain(p: DVec3, balls: &[(DVec3, f64)]) -> f64 {
    balls.windows(2).map(|w| cone(p, w[0].0, w[1].0, w[0].1, w[1].1)).fold(f64::INFINITY, f64::min)
}

/// The union, with a fillet of width about `k`.
pub(crate) fn join(a: f64, b: f64, k: f64) -> f64 {
    // Where the two are within k of each other a fillet is added, k/6 at most; mostly they are not.
    let room = k - (a - b).abs();
    if room <= 0.0 {
        return a.min(b);
    }
    let h = room / k;
    // Cubic, so that curvature does not jump where the fillet begins.
    a.min(b) - h * h * h * k / 6.0
}

/// `a` without `b`, the edge rounded over about `k`.
pub(crate) fn carve(a: f64, b: f64, k: f64) -> f64 {
    -join(-a, b, k)
}

/// What is in both, the edge rounded over about `k`.
pub(crate) fn meet(a: f64, b: f64, k: f64) -> f64 {
    -join(-a, -b, k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_vanish_on_their_surface() {
        let r = DVec3::new(1.0, 2.0, 3.0);
        assert!(ellipsoid(DVec3::Y * 2.0, DVec3::ZERO, r).abs() < 1e-12);
        assert!(turned(DVec3::Z * 2.0, DVec3::ZERO, r, std::f64::consts::FRAC_PI_2, 0.0) < 1e-9);
        assert!((cone(DVec3::X * 4.0, DVec3::ZERO, DVec3::Y * 5.0, 3.0, 3.0) - 1.0).abs() < 1e-12);
        assert!((cone(-DVec3::Y * 4.0, DVec3::ZERO, DVec3::Y * 5.0, 3.0, 1.0) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_fillet_only_adds_and_only_nearby() {
        assert_eq!(join(1.0, 5.0, 2.0), 1.0);
        assert!(join(1.0, 1.0, 2.0) < 1.0);
        assert!(carve(-1.0, -1.0, 1.0) > 0.0);
        assert_eq!(meet(1.0, -4.0, 1.0), 1.0);
    }
}
