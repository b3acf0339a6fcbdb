//! Eight pieces of hair against a ray.

use glam::{DVec3, Vec3};

use super::build::Primitive;
use super::curves::{Piece, PieceName, REACH};
use super::hierarchy::{Leaf, WideRay};
use super::simd::{LANES, Lanes, Simd, Vectors};

/// Up to eight pieces, side by side; unused lanes have no radius.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C, align(32))]
pub(super) struct HairLeaf {
    start: [Lanes; 3],
    axis: [Lanes; 3],
    radius: Lanes,
    widening: Lanes,
    point: [u32; LANES],
    number: [u8; LANES],
}

impl Leaf for HairLeaf {
    type Things = [Piece];

    fn new(pieces: &[Piece], primitives: &[Primitive]) -> Self {
        let zero = Lanes([0.0; LANES]);
        let mut leaf = Self {
            start: [zero; 3],
            axis: [zero, zero, Lanes([1.0; LANES])],
            radius: zero,
            widening: zero,
            point: [0; LANES],
            number: [0; LANES],
        };
        for (lane, primitive) in primitives.iter().enumerate() {
            leaf.put(lane, &pieces[primitive.index()]);
        }
        leaf
    }

    /// A ray and an axis pass each other at a distance q; there the ray is at `t` and the axis at
    /// `s`. The ray is within the fibre for τ about t with q² + τ²|d⊥|² < (r + κτ)², where d⊥ is the
    /// part of its direction across the axis and κ the change of radius along the ray. The smaller
    /// root is where it enters. Solving about the closest approach, and measuring from the middle of
    /// the piece, keeps digits that thin fibres need.
    #[inline(always)]
    fn test<S: Simd>(&self, simd: S, ray: &WideRay<S::F>, t_max: f32) -> (S::F, u32) {
        let d = ray.direction;
        let axis = simd.load3(&self.axis);
        let x0 = simd.sub3(ray.origin, simd.load3(&self.start));
        let to_middle = simd.against(x0, simd.splat(0.5), axis);
        let middle = simd.sub(simd.splat(0.0), simd.dot(to_middle, d));
        let x = simd.along(x0, middle, d);

        let square = simd.dot(axis, axis);
        let inverse = simd.div(simd.splat(1.0), square);
        let s0 = simd.mul(simd.dot(x, axis), inverse);
        let s1 = simd.mul(simd.dot(d, axis), inverse);
        let x_across = simd.against(x, s0, axis);
        let d_across = simd.against(d, s1, axis);
        let dd = simd.max(simd.dot(d_across, d_across), simd.splat(1e-12));
        let to_closest = simd.div(simd.sub(simd.splat(0.0), simd.dot(x_across, d_across)), dd);
        let q = simd.along(x_across, to_closest, d_across);
        let q2 = simd.dot(q, q);
        let s = simd.mul_add(s1, to_closest, s0);
        let widening = simd.load(&self.widening);
        let radius0 = simd.load(&self.radius);
        let r = simd.mul_add(widening, s, radius0);
        let inside = simd.sub(simd.mul(r, r), q2);
        let passes = simd.less(simd.splat(0.0), inside);
        if simd.bits(passes) == 0 {
            return (q2, 0);
        }

        let kappa = simd.mul(widening, s1);
        let a = simd.sub_mul(dd, kappa, kappa);
        let rk = simd.mul(r, kappa);
        let root = simd.sqrt(simd.mul_add(rk, rk, simd.mul(a, inside)));
        let tau = simd.div(simd.sub(rk, root), a);
        let s = simd.mul_add(s1, tau, s);
        let t = simd.add(middle, simd.add(to_closest, tau));
        // Squared distance beyond the ends against that allowed.
        let beyond = simd.max(simd.sub(simd.splat(0.0), s), simd.sub(s, simd.splat(1.0)));
        let beyond = simd.max(beyond, simd.splat(0.0));
        let beyond = simd.mul(simd.mul(beyond, beyond), square);
        let reach = simd.mul(radius0, simd.splat(REACH));
        let along = simd.at_most(beyond, simd.mul(reach, reach));
        let ahead = simd.both(simd.at_most(simd.splat(0.0), t), simd.less(t, simd.splat(t_max)));
        let hit = simd.both(simd.both(passes, along), ahead);
        (t, simd.bits(hit))
    }
}

impl HairLeaf {
    fn put(&mut self, lane: usize, piece: &Piece) {
        for axis in 0..3 {
            self.start[axis].0[lane] = piece.start[axis];
            self.axis[axis].0[lane] = piece.axis[axis];
        }
        self.radius.0[lane] = piece.radius;
        self.widening.0[lane] = piece.widening;
        self.point[lane] = piece.name.point;
        self.number[lane] = piece.name.number;
    }

    /// The piece in a lane.
    pub(super) fn piece(&self, lane: usize) -> Piece {
        let vector = |v: &[Lanes; 3]| Vec3::from([0, 1, 2].map(|axis| v[axis].0[lane]));
        Piece {
            start: vector(&self.start),
            axis: vector(&self.axis),
            radius: self.radius.0[lane],
            widening: self.widening.0[lane],
            name: PieceName { point: self.point[lane], number: self.number[lane] },
        }
    }
}

/// Where on a piece a ray enters it.
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

/// Where a ray enters a piece that it is known to meet, in double precision: what eight lanes at
/// once find is good to a few hundredths of a radius, which is enough to choose.
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
