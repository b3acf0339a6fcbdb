//! The 3×3 blocks by which the turns of joints are eliminated.

use super::lanes::{Lanes, Mat3, Sym3, Vec3};
use super::turn::Table;

/// A pivot this small against its diagonal is zero but for rounding.
const ROUNDING: f64 = 1e-13;

/// The model of the energy as a function of a joint's turn x and of the turn θ after it: with slope g and
/// curvature P of what hangs from the joint, `½ xᵀ H x + xᵀ M θ`.
pub(super) struct JointModel<F> {
    /// H, without the joint's own stiffness.
    pub(super) block: Sym3<F>,
    /// Rows of M.
    pub(super) rows: [Vec3<F>; 3],
}

impl<F: Lanes> JointModel<F> {
    #[inline(always)]
    pub(super) fn new(table: &Table<F>, c: Vec3<F>, j: Mat3<F>, g: Vec3<F>, p: Sym3<F>) -> Self {
        let minus_half = c.x.all(-0.5);
        // Columns of J after P.
        let (px, py, pz) = (p.times(j.x), p.times(j.y), p.times(j.z));
        let row = |pj: Vec3<F>, j: Vec3<F>| g.cross(j).scaled_plus(minus_half, pj);
        let block = Sym3 {
            xx: j.x.dot(px),
            xy: j.x.dot(py),
            xz: j.x.dot(pz),
            yy: j.y.dot(py),
            yz: j.y.dot(pz),
            zz: j.z.dot(pz),
        };
        let rows = [row(px, j.x), row(py, j.y), row(pz, j.z)];
        Self { block: table.add_second(c, g, block), rows }
    }
}

/// `L D Lᵀ` of a symmetric block.
pub(super) struct Factor<F> {
    l21: F,
    l31: F,
    l32: F,
    /// D⁻¹.
    pub(super) inverse: Vec3<F>,
    /// The least pivot, but for rounding: positive if the block is.
    pub(super) least: F,
}

impl<F: Lanes> Factor<F> {
    #[inline(always)]
    pub(super) fn of(block: Sym3<F>) -> Self {
        let one = block.xx.all(1.0);
        let small = block.xx.all(ROUNDING);
        let d1 = one / block.xx;
        let (l21, l31) = (block.xy * d1, block.xz * d1);
        let second = (-l21).times_plus(block.xy, block.yy);
        let e = (-l31).times_plus(block.xy, block.yz);
        let d2 = one / second;
        let l32 = e * d2;
        let third = (-l32).times_plus(e, (-l31).times_plus(block.xz, block.zz));
        let d3 = one / third;
        let beyond = |pivot: F, of: F| small.times_plus(-of, pivot);
        let least = block.xx.smallest(beyond(second, block.yy)).smallest(beyond(third, block.zz));
        Self { l21, l31, l32, inverse: Vec3::new(d1, d2, d3), least }
    }

    /// `L⁻¹` of a vector.
    #[inline(always)]
    pub(super) fn lower(&self, v: Vec3<F>) -> Vec3<F> {
        let y = (-self.l21).times_plus(v.x, v.y);
        let z = (-self.l32).times_plus(y, (-self.l31).times_plus(v.x, v.z));
        Vec3::new(v.x, y, z)
    }

    /// `L⁻ᵀ` of a vector.
    #[inline(always)]
    pub(super) fn raise(&self, v: Vec3<F>) -> Vec3<F> {
        let y = (-self.l32).times_plus(v.z, v.y);
        let x = (-self.l21).times_plus(y, (-self.l31).times_plus(v.z, v.x));
        Vec3::new(x, y, v.z)
    }

    /// `L⁻¹` of a matrix by rows.
    #[inline(always)]
    pub(super) fn lower_rows(&self, [x, y, z]: [Vec3<F>; 3]) -> [Vec3<F>; 3] {
        let y = x.scaled_plus(-self.l21, y);
        let z = y.scaled_plus(-self.l32, x.scaled_plus(-self.l31, z));
        [x, y, z]
    }

    /// `L⁻ᵀ D⁻¹` of a matrix by rows, as a matrix whose transpose is to be applied.
    #[inline(always)]
    pub(super) fn raise_rows(&self, [x, y, z]: [Vec3<F>; 3]) -> Mat3<F> {
        let z = z.scaled(self.inverse.z);
        let y = z.scaled_plus(-self.l32, y.scaled(self.inverse.y));
        let x = y.scaled_plus(-self.l21, z.scaled_plus(-self.l31, x.scaled(self.inverse.x)));
        Mat3 { x, y, z }
    }
}
