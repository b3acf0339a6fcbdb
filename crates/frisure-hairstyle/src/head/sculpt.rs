//! Signed-distance clay: a few shapes, and smooth ways to add and remove them, at four places at once.
//!
//! After Quilez's notes on distance functions, <https://iquilezles.org/articles/distfunctions>.
//! Nothing here is an exact distance; all are close to one near their surface. A value is the same to the bit whatever the places
//! beside it and the instruction set: no operation is fused with another. All functions are `inline(always)`, so that they are
//! compiled with the instruction set that `dispatch!` selects; see `fearless_simd`'s notes on inlining. In a browser there is one set
//! only, and the page is to be small: there the largest of them are functions that are called.

use std::ops::Sub;

use fearless_simd::{Select, Simd, SimdBase, SimdFloat, SimdFrom, SimdMask, f64x4, mask64x4};
use glam::{DMat3, DVec3};

use super::mesher::LANES;

/// Places or directions in space, coordinate by coordinate.
#[derive(Clone, Copy)]
pub(super) struct Places<S: Simd> {
    pub(super) x: f64x4<S>,
    pub(super) y: f64x4<S>,
    pub(super) z: f64x4<S>,
}

impl<S: Simd> Places<S> {
    /// Some places.
    #[inline(always)]
    pub(super) fn new(simd: S, places: [DVec3; LANES]) -> Self {
        let [x, y, z] = [0, 1, 2].map(
            #[inline(always)]
            |axis| f64x4::simd_from(simd, places.map(|p| p[axis])),
        );
        Self { x, y, z }
    }

    /// What each place is under a linear map.
    #[inline(always)]
    pub(super) fn mapped(self, map: DMat3) -> Self {
        let [x, y, z] = [map.x_axis, map.y_axis, map.z_axis];
        Self {
            x: self.x * x.x + self.y * y.x + self.z * z.x,
            y: self.x * x.y + self.y * y.y + self.z * z.y,
            z: self.x * x.z + self.y * y.z + self.z * z.z,
        }
    }

    #[inline(always)]
    fn dot(self, other: DVec3) -> f64x4<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    fn length_squared(self) -> f64x4<S> {
        self.x * self.x + self.y * self.y + self.z * self.z
    }

    #[inline(always)]
    pub(super) fn length(self) -> f64x4<S> {
        self.length_squared().sqrt()
    }

    #[inline(always)]
    fn divided(self, by: DVec3) -> Self {
        Self { x: self.x / by.x, y: self.y / by.y, z: self.z / by.z }
    }
}

impl<S: Simd> Sub<DVec3> for Places<S> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: DVec3) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

/// An ellipsoid with half axes `radii`.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
#[cfg_attr(target_arch = "wasm32", inline(never))]
pub(super) fn ellipsoid<S: Simd>(p: Places<S>, centre: DVec3, radii: DVec3) -> f64x4<S> {
    let q = p - centre;
    // k₁ (k₁ − 1)/k₂ with k₁ = |q/r| and k₂ = |q/r²|: first order in the distance near the surface.
    let scaled = q.divided(radii).length();
    let slope = q.divided(radii * radii).length();
    let middle = f64x4::splat(p.x.simd, -radii.min_element());
    slope.simd_lt(1e-12).select(middle, scaled * (scaled - 1.0) / slope)
}

/// An ellipsoid turned about the x axis by `pitch` (its +y towards +z), then about z by `yaw` (rad).
#[inline(always)]
pub(super) fn turned<S: Simd>(
    p: Places<S>,
    centre: DVec3,
    radii: DVec3,
    pitch: f64,
    yaw: f64,
) -> f64x4<S> {
    let frame = DMat3::from_rotation_z(yaw) * DMat3::from_rotation_x(pitch);
    ellipsoid((p - centre).mapped(frame.transpose()), DVec3::ZERO, radii)
}

/// Two balls and the cone that touches both.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
#[cfg_attr(target_arch = "wasm32", inline(never))]
pub(super) fn cone<S: Simd>(p: Places<S>, a: DVec3, b: DVec3, ra: f64, rb: f64) -> f64x4<S> {
    let simd = p.x.simd;
    let ba = b - a;
    let l2 = ba.length_squared();
    let rr = ra - rb;
    let a2 = l2 - rr * rr;
    let il2 = l2.recip();
    let pa = p - a;
    let y = pa.dot(ba);
    let z = y - l2;
    let off = Places { x: pa.x * l2 - y * ba.x, y: pa.y * l2 - y * ba.y, z: pa.z * l2 - y * ba.z };
    let x2 = off.length_squared();
    let y2 = y * y * l2;
    let z2 = z * z * l2;
    let k = x2 * (rr.signum() * rr * rr);
    // Nearest to the second ball, to the first, or to the cone between.
    let one = f64x4::splat(simd, 1.0);
    let second = (one.copysign(z) * a2 * z2).simd_gt(k);
    let first = (one.copysign(y) * a2 * y2).simd_lt(k);
    let square = second.select(x2 + z2, first.select(x2 + y2, x2 * a2 * il2));
    let along = (second | first).select(f64x4::splat(simd, 0.0), y * rr);
    let radius = second.select(f64x4::splat(simd, rb), f64x4::splat(simd, ra));
    (square.sqrt() + along) * il2 - radius
}

/// A chain of cones through balls `(centre, radius)`.
#[inline(always)]
pub(super) fn chain<S: Simd, const N: usize>(p: Places<S>, balls: [(DVec3, f64); N]) -> f64x4<S> {
    let mut least = f64x4::splat(p.x.simd, f64::INFINITY);
    for n in 1..N {
        let ((a, ra), (b, rb)) = (balls[n - 1], balls[n]);
        least = least.min(cone(p, a, b, ra, rb));
    }
    least
}

/// The union, with a fillet of width about `k`.
#[cfg_attr(not(target_arch = "wasm32"), inline(always))]
#[cfg_attr(target_arch = "wasm32", inline(never))]
pub(super) fn join<S: Simd>(a: f64x4<S>, b: f64x4<S>, k: f64) -> f64x4<S> {
    // Where the two are within k of each other a fillet is added, k/6 at most; mostly they are not.
    let room = k - (a - b).abs();
    let least = a.min(b);
    let filled = room.simd_gt(0.0);
    if !filled.any_true() {
        return least;
    }
    let h = room / k;
    // Cubic, so that curvature does not jump where the fillet begins.
    filled.select(least - h * h * h * k / 6.0, least)
}

/// `a` without `b`, the edge rounded over about `k`.
#[inline(always)]
pub(super) fn carve<S: Simd>(a: f64x4<S>, b: f64x4<S>, k: f64) -> f64x4<S> {
    -join(-a, b, k)
}

/// What is in both, the edge rounded over about `k`.
#[inline(always)]
pub(super) fn meet<S: Simd>(a: f64x4<S>, b: f64x4<S>, k: f64) -> f64x4<S> {
    -join(-a, -b, k)
}

/// What `change` makes of `value` at the `chosen` places.
#[inline(always)]
pub(super) fn changed<S: Simd>(
    chosen: mask64x4<S>,
    value: f64x4<S>,
    change: impl FnOnce(f64x4<S>) -> f64x4<S>,
) -> f64x4<S> {
    if chosen.any_true() { chosen.select(change(value), value) } else { value }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use fearless_simd::{Level, dispatch};

    use super::*;

    /// The values of shapes at a place each, and at three that they share.
    #[inline(always)]
    fn shapes<S: Simd>(simd: S) -> [[f64; LANES]; 4] {
        let at = |p: DVec3| Places::new(simd, [p, DVec3::ZERO, DVec3::ONE, -9.0 * DVec3::Y]);
        let r = DVec3::new(1.0, 2.0, 3.0);
        [
            ellipsoid(at(DVec3::Y * 2.0), DVec3::ZERO, r),
            turned(at(DVec3::Z * 2.0), DVec3::ZERO, r, FRAC_PI_2, 0.0),
            cone(at(DVec3::X * 4.0), DVec3::ZERO, DVec3::Y * 5.0, 3.0, 3.0),
            cone(at(-DVec3::Y * 4.0), DVec3::ZERO, DVec3::Y * 5.0, 3.0, 1.0),
        ]
        .map(<[f64; LANES]>::from)
    }

    #[test]
    fn shapes_vanish_on_their_surface() {
        let values = dispatch!(Level::new(), simd => shapes(simd));
        let [ellipsoid, turned, cylinder, cone] = values;
        assert!(ellipsoid[0].abs() < 1e-12 && ellipsoid[1] == -1.0);
        assert!(turned[0] < 1e-9);
        assert!((cylinder[0] - 1.0).abs() < 1e-12 && (cylinder[3] - 6.0).abs() < 1e-12);
        assert!((cone[0] - 1.0).abs() < 1e-12 && (cone[3] - 6.0).abs() < 1e-12);
        // To the bit, whatever the instruction set.
        assert_eq!(values, dispatch!(Level::baseline(), simd => shapes(simd)));
    }

    /// A join of numbers apart and near, a carved and a met one.
    #[inline(always)]
    fn fillets<S: Simd>(simd: S) -> [f64; 4] {
        let number = |x: f64| f64x4::splat(simd, x);
        [
            join(number(1.0), number(5.0), 2.0)[0],
            join(number(1.0), number(1.0), 2.0)[0],
            carve(number(-1.0), number(-1.0), 1.0)[0],
            meet(number(1.0), number(-4.0), 1.0)[0],
        ]
    }

    #[test]
    fn a_fillet_only_adds_and_only_nearby() {
        let [apart, near, carved, met] = dispatch!(Level::new(), simd => fillets(simd));
        assert_eq!((apart, met), (1.0, 1.0));
        assert!(near < 1.0 && carved > 0.0);
    }
}
