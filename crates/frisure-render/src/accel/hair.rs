//! Intersection of a ray with eight pieces of hair at once.

use fearless_simd::{Simd, SimdBase, SimdFloat, f32x8};
use glam::{DVec3, Vec3, Vec4};

use super::curves::{Curves, Piece, PieceName, REACH};
use super::node::{Leaf, Primitive, WideRay};
use super::simd::{LANES, Wide3, bits, from_u16, sub_mul};

/// Up to eight pieces, side by side, on a grid of their own; unused lanes have no radius.
///
/// A grid has 65 536 places along each axis of the leaf's box: for the few millimetres of a leaf
/// that is a tenth of a micrometre.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(16))]
pub(super) struct HairLeaf {
    /// Starts, as steps from `low`.
    start: [[u16; LANES]; 3],
    /// From starts to ends, as steps of their own.
    axis: [[i16; LANES]; 3],
    /// Radii at the starts and at the ends.
    radius: [[u16; LANES]; 2],
    point: [u32; LANES],
    number: [u8; LANES],
    low: [f32; 3],
    step: [f32; 3],
    axis_step: f32,
    radius_step: f32,
}

impl Leaf for HairLeaf {
    type Primitives = Curves;

    fn new(curves: &Curves, primitives: &[Primitive]) -> Self {
        let mut leaf = Self {
            start: [[0; LANES]; 3],
            axis: [[0; LANES]; 3],
            radius: [[0; LANES]; 2],
            point: [0; LANES],
            number: [0; LANES],
            low: [0.0; 3],
            step: [0.0; 3],
            axis_step: 0.0,
            radius_step: 0.0,
        };
        // A number below 256 loses nothing.
        let name = |p: &Primitive| PieceName { point: p.index() as u32, number: p.number() as u8 };
        let mut ends = [[Vec4::ZERO; 2]; LANES];
        for (lane, primitive) in primitives.iter().enumerate() {
            let name = name(primitive);
            (leaf.point[lane], leaf.number[lane]) = (name.point, name.number);
            ends[lane] = curves.ends(name);
        }
        leaf.put(&ends[..primitives.len()]);
        leaf
    }

    /// A ray and an axis pass each other at a distance q; there the ray is at `t` and the axis at
    /// `s`. The ray is within the fibre for τ about t with q² + τ²|d⊥|² < (r + κτ)², where d⊥ is the
    /// part of its direction across the axis and κ the change of radius along the ray. The smaller
    /// root is where it enters. Solving about the closest approach, and measuring from where the ray
    /// is nearest to the leaf, keeps digits that thin fibres need.
    ///
    /// Most rays pass by all pieces: their distance from the axes made endless, (x·n)²/n² with n square to
    /// both, says so without a division and whatever the length of the axes.
    #[inline(always)]
    fn intersect<S: Simd>(&self, simd: S, ray: &WideRay<S>, t_max: f32) -> (f32x8<S>, u32) {
        let d = ray.direction;
        let x0 = ray.origin - Wide3::splat(simd, self.low.into());
        let middle = 0.0 - x0.dot(d);
        let start = Wide3::from_u16(simd, &self.start);
        let x = x0.along(middle, d).sub_mul(Wide3::splat(simd, self.step.into()), start);
        let axis = Wide3::from_i16(simd, &self.axis);
        // 1. Whether the ray comes near any axis made endless: (x·n)² < r² |n|² with n = d × axis. No division.
        let n = d.cross(axis);
        let apart = x.dot(n);
        // The thickest radius of the leaf, and a thousandth for rounding.
        let thick = self.radius_step * (1.001 * f32::from(u16::MAX));
        if bits((apart * apart).simd_lt(n.dot(n) * (thick * thick))) == 0 {
            return (middle, 0);
        }
        // 2. The closest approach: parts of x and d across the axis, the ray's distance to it, and the axis's fraction s.
        let axis = axis * self.axis_step;
        let square = axis.dot(axis);
        let inverse = 1.0 / square;
        let (s0, s1) = (x.dot(axis) * inverse, d.dot(axis) * inverse);
        let (x_across, d_across) = (x.against(s0, axis), d.against(s1, axis));
        let dd = d_across.dot(d_across).max(1e-12);
        let to_closest = (0.0 - x_across.dot(d_across)) / dd;
        let q = x_across.along(to_closest, d_across);
        let q2 = q.dot(q);
        let s = s1.mul_add(to_closest, s0);
        let radius0 = from_u16(simd, &self.radius[0]) * self.radius_step;
        let radius1 = from_u16(simd, &self.radius[1]) * self.radius_step;
        let widening = radius1 - radius0;
        let r = widening.mul_add(s, radius0);
        let inside = r * r - q2;
        let passes = inside.simd_gt(0.0);
        if bits(passes) == 0 {
            return (q2, 0);
        }
        // 3. Entry: (|d⊥|² − κ²) τ² − 2 r κ τ − (r² − q²) = 0, the smaller root.
        let kappa = widening * s1;
        let a = sub_mul(dd, kappa, kappa);
        let rk = r * kappa;
        let root = rk.mul_add(rk, a * inside).sqrt();
        let tau = (rk - root) / a;
        let s = s1.mul_add(tau, s);
        let t = middle + (to_closest + tau);
        // 4. Along the piece, or beyond its ends by the squared distance allowed; and ahead of the ray's start.
        let beyond = (0.0 - s).max(s - 1.0).max(0.0);
        let reach = radius0 * REACH;
        let along = (beyond * beyond * square).simd_le(reach * reach);
        let ahead = t.simd_ge(0.0) & t.simd_lt(t_max);
        (t, bits(passes & along & ahead))
    }
}

impl HairLeaf {
    fn put(&mut self, ends: &[[Vec4; 2]]) {
        let all = |f: fn(Vec4, Vec4) -> Vec4, of: fn(&[Vec4; 2]) -> Vec4| {
            ends.iter().map(of).reduce(f).unwrap_or_default()
        };
        let low = all(Vec4::min, |[a, _]| *a);
        let step = (all(Vec4::max, |[a, _]| *a) - low) / f32::from(u16::MAX);
        let longest = all(Vec4::max, |[a, b]| (*b - *a).abs()).truncate().max_element();
        self.axis_step = longest / f32::from(i16::MAX);
        let thick = all(Vec4::max, |[a, b]| a.max(*b)).w;
        self.low = low.truncate().to_array();
        self.step = step.truncate().to_array();
        self.radius_step = thick / f32::from(u16::MAX);
        // Steps of 0 lead to 0: the casts saturate, and take not-a-number for 0.
        for (lane, [a, b]) in ends.iter().enumerate() {
            let start = ((*a - low) / step).round();
            let axis = ((*b - *a) / self.axis_step).round();
            for i in 0..3 {
                self.start[i][lane] = start[i] as u16;
                self.axis[i][lane] = axis[i] as i16;
            }
            self.radius[0][lane] = (a.w / self.radius_step).round() as u16;
            self.radius[1][lane] = (b.w / self.radius_step).round() as u16;
        }
    }

    /// The piece in a lane.
    pub(super) fn piece(&self, lane: usize) -> Piece {
        let of = |i: usize| self.low[i] + self.step[i] * f32::from(self.start[i][lane]);
        let axis = |i: usize| self.axis_step * f32::from(self.axis[i][lane]);
        let [radius, last] = self.radius.map(|r| self.radius_step * f32::from(r[lane]));
        Piece {
            start: Vec3::from([0, 1, 2].map(of)),
            axis: Vec3::from([0, 1, 2].map(axis)),
            radius,
            widening: last - radius,
            name: PieceName { point: self.point[lane], number: self.number[lane] },
        }
    }
}

/// The intersection of a ray with a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    /// Distance (m).
    pub(super) t: f64,
    /// From 0 to 1 along the piece, or a little beyond.
    pub(super) s: f64,
    /// From the axis to the ray where they pass each other (m).
    pub(super) pass: DVec3,
    /// From the axis to where the ray enters (m).
    pub(super) out: DVec3,
}

/// Intersects a ray with a piece that it is known to hit, in double precision: the eight lanes are accurate to a few
/// hundredths of a radius, which is enough to choose the closest.
pub(super) fn entry(piece: &Piece, origin: DVec3, direction: DVec3) -> Entry {
    let (axis, r0) = (piece.axis.as_dvec3(), f64::from(piece.radius));
    let widening = f64::from(piece.widening);
    let x = origin - piece.start.as_dvec3();
    let (s0, s1) =
        (x.dot(axis) / axis.length_squared(), direction.dot(axis) / axis.length_squared());
    let (x_across, d_across) = (x - s0 * axis, direction - s1 * axis);
    let dd = d_across.length_squared().max(1e-12);
    let closest = -x_across.dot(d_across) / dd;
    let pass = x_across + closest * d_across;
    let r = r0 + widening * (s0 + s1 * closest);
    let kappa = widening * s1;
    let a = dd - kappa * kappa;
    let inside = (r * r - pass.length_squared()).max(0.0);
    let tau = (r * kappa - (r * r * kappa * kappa + a * inside).max(0.0).sqrt()) / a;
    let t = closest + tau;
    Entry { t, s: s0 + s1 * t, pass, out: pass + tau * d_across }
}
