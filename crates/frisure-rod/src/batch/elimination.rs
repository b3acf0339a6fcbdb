//! The backward step of one joint in lanes: its energy, gradient and Hessian block, and its elimination.
//!
//! This is the kernel of both sweeps ([`super::weight_sweep`], [`super::contact_sweep`]), docs/theory.md, "Rods in
//! lanes", (L3) to (L6). The scalar solver computes the same in another formulation, for elements of any kind and
//! potentials of any kind ([`crate::minimise`]); `batch/agreement.rs` compares the two at random shapes.

use super::lanes::Lanes;
use super::linear::{Mat3, Sym3, Vec3};
use super::rotation::RotationTable;

/// A pivot this small relative to its diagonal is zero to rounding, as in the scalar solver; some hundred times that of f64.
const PIVOT_ROUNDING: f64 = 1e-13;

/// Trust region: largest change of a joint's turn in one step (rad), as in the scalar solver. Chosen by trial.
const LARGEST_TURN: f64 = 1.0;

/// The result of a backward sweep for each rod.
pub(super) struct SweepResult<F> {
    /// Square of the largest derivative of the energy by a joint's turn (N² m²).
    pub(super) gradient: F,
    /// Decrease of the quadratic model by the whole step (J).
    pub(super) decrease: F,
    /// The least pivot (N m), less its rounding error: positive if the Hessian is positive definite.
    pub(super) pivot: F,
    /// Square of the largest turn of a joint (rad²).
    pub(super) turned: F,
}

impl<F: Lanes> SweepResult<F> {
    #[inline(always)]
    pub(super) fn new(zero: F) -> Self {
        Self { gradient: zero, decrease: zero, pivot: zero.splat(1.0), turned: zero }
    }
}

/// Stiffness of the joints (N m): K of the energy, and `(1 + damping) K` of the model.
pub(super) struct Stiffness<F> {
    elastic: Vec3<F>,
    damped: Vec3<F>,
}

impl<F: Lanes> Stiffness<F> {
    #[inline(always)]
    pub(super) fn new(elastic: Vec3<F>, damping: F) -> Self {
        Self { elastic, damped: elastic * (damping.splat(1.0) + damping) }
    }
}

/// Quadratic model of the energy of everything beyond a joint, by the turn ε of the frame after it:
/// `g·ε + ½ εᵀ P ε`. (L3)
pub(super) struct ValueFunction<F> {
    /// g of the model, in which later joints follow their laws.
    pub(super) slope: Vec3<F>,
    /// g of the energy itself, in which later joints stay as they are.
    pub(super) exact_slope: Vec3<F>,
    /// P.
    pub(super) hessian: Sym3<F>,
}

/// A joint eliminated from the model.
pub(super) struct Elimination<F> {
    /// `exp([c]×)`.
    pub(super) rotation: Mat3<F>,
    /// J: the right Jacobian at c.
    pub(super) jacobian: Mat3<F>,
    factor: BlockFactor<F>,
    /// `z = D⁻¹ L⁻¹ r`, with r the derivative of the model by the joint's turn.
    reduced: Vec3<F>,
    /// `L⁻¹ M`, by rows.
    pub(super) by_turn: [Vec3<F>; 3],
}

impl<F: Lanes> Elimination<F> {
    /// Eliminates the turn x of a joint whose turn is `c` (rad).
    #[inline(always)]
    pub(super) fn new(
        c: Vec3<F>,
        stiffness: &Stiffness<F>,
        value: &ValueFunction<F>,
        result: &mut SweepResult<F>,
    ) -> Self {
        // 1. exp([c]×) and its right Jacobian J. (L1)
        let table = RotationTable::of(c);
        let rotation = table.rotation(c);
        let jacobian = table.jacobian(c);
        // 2. Gradient: r = Jᵀ g + K c, of the model and of the energy. (L4)
        let elastic = stiffness.elastic.component_mul(c);
        let residue = jacobian.transpose_mul(value.slope) + elastic;
        // The two differ by what later joints would do: the gradient that decides on rest is that of the energy.
        let exact = jacobian.transpose_mul(value.exact_slope) + elastic;
        result.gradient = result.gradient.max(exact.dot(exact));
        result.turned = result.turned.max(c.dot(c));
        Self::with_residue(c, (&table, rotation, jacobian), residue, stiffness, value, result)
    }

    /// As [`Self::new`] at rest, for a linear system with the Hessian: `right` is the turn of the frame after the joint
    /// by which the right-hand side and later joints slope, with a minus sign. docs/theory.md (L11)
    #[inline(always)]
    pub(super) fn linear(
        c: Vec3<F>,
        stiffness: &Stiffness<F>,
        value: &ValueFunction<F>,
        right: Vec3<F>,
        result: &mut SweepResult<F>,
    ) -> Self {
        let table = RotationTable::of(c);
        let (rotation, jacobian) = (table.rotation(c), table.jacobian(c));
        let exact = jacobian.transpose_mul(value.exact_slope) + stiffness.elastic.component_mul(c);
        result.gradient = result.gradient.max(exact.dot(exact));
        result.turned = result.turned.max(c.dot(c));
        let residue = jacobian.transpose_mul(right);
        Self::with_residue(c, (&table, rotation, jacobian), residue, stiffness, value, result)
    }

    #[inline(always)]
    fn with_residue(
        c: Vec3<F>,
        (table, rotation, jacobian): (&RotationTable<F>, Mat3<F>, Mat3<F>),
        residue: Vec3<F>,
        stiffness: &Stiffness<F>,
        value: &ValueFunction<F>,
        result: &mut SweepResult<F>,
    ) -> Self {
        // 3. Hessian blocks H = (1 + σ) K + Jᵀ P J + D(g) and M = Jᵀ (P + ½ [g]×). (L5)
        let blocks = HessianBlocks::new(table, c, jacobian, value);
        // 4. Pivot: H = L D Lᵀ.
        let factor = BlockFactor::new(blocks.turn_turn.add_diagonal(stiffness.damped));
        result.pivot = result.pivot.min(factor.least);
        // 5. Expected decrease ½ rᵀ H⁻¹ r. (L6)
        // With H = L D Lᵀ: z = D⁻¹ L⁻¹ r serves the step (L⁻ᵀ z), the decrease (½ zᵀ D z) and the slope before (Mᵀ L⁻ᵀ z).
        let lowered = factor.lower(residue);
        let reduced = lowered.component_mul(factor.inverse);
        result.decrease = c.x.splat(0.5).mul_add(lowered.dot(reduced), result.decrease);
        let by_turn = factor.lower_rows(blocks.turn_frame);
        Self { rotation, jacobian, factor, reduced, by_turn }
    }

    /// What further right-hand sides need.
    #[inline(always)]
    pub(super) fn pivot(&self) -> Pivot<F> {
        Pivot { factor: self.factor, by_turn: self.by_turn }
    }

    /// `H⁻¹ r`: the step is its negative. (L6)
    #[inline(always)]
    pub(super) fn step(&self) -> Vec3<F> {
        self.factor.raise(self.reduced)
    }

    /// `L⁻¹` of a matrix by rows.
    #[inline(always)]
    pub(super) fn lower_rows(&self, rows: [Vec3<F>; 3]) -> [Vec3<F>; 3] {
        self.factor.lower_rows(rows)
    }

    /// `H⁻¹ M` from `L⁻¹ M`, as a matrix whose transpose is to be applied: the feedback. (L6)
    #[inline(always)]
    pub(super) fn feedback(&self, rows: [Vec3<F>; 3]) -> Mat3<F> {
        self.factor.raise_rows(rows)
    }

    /// `v − Mᵀ H⁻¹ r` from `L⁻¹ M`: a slope with the joint eliminated. (L6)
    #[inline(always)]
    pub(super) fn reduce_slope(&self, v: Vec3<F>, by_turn: [Vec3<F>; 3]) -> Vec3<F> {
        reduced_slope(v, by_turn, self.reduced)
    }

    /// `P − Mᵀ H⁻¹ M` from `L⁻¹ M`: a Hessian with the joint eliminated. (L6)
    #[inline(always)]
    pub(super) fn reduce_hessian(&self, p: Sym3<F>, [x, y, z]: [Vec3<F>; 3]) -> Sym3<F> {
        let d = self.factor.inverse;
        p.sub_square(d.x, x).sub_square(d.y, y).sub_square(d.z, z)
    }

    /// `Q − Mᵀ H⁻¹ N` from `L⁻¹ M` and `L⁻¹ N`, with the rows of Q as columns: a mixed Hessian with the joint eliminated.
    #[inline(always)]
    pub(super) fn reduce_mixed(
        &self,
        q: Mat3<F>,
        [m1, m2, m3]: [Vec3<F>; 3],
        [n1, n2, n3]: [Vec3<F>; 3],
    ) -> Mat3<F> {
        let d = self.factor.inverse;
        let (e1, e2, e3) = (n1 * d.x, n2 * d.y, n3 * d.z);
        let row = |v: Vec3<F>, a: F, b: F, c: F| e3.mul_add(-c, e2.mul_add(-b, e1.mul_add(-a, v)));
        Mat3 {
            x: row(q.x, m1.x, m2.x, m3.x),
            y: row(q.y, m1.y, m2.y, m3.y),
            z: row(q.z, m1.z, m2.z, m3.z),
        }
    }
}

/// The factorised block of a joint, for many right-hand sides r.
#[derive(Clone, Copy)]
pub(super) struct Pivot<F> {
    factor: BlockFactor<F>,
    /// `L⁻¹ M`, by rows.
    by_turn: [Vec3<F>; 3],
}

impl<F: Lanes> Pivot<F> {
    pub(super) fn zero(zero: F) -> Self {
        let v = Vec3::splat(zero);
        let factor = BlockFactor { l21: zero, l31: zero, l32: zero, inverse: v, least: zero };
        Self { factor, by_turn: [v; 3] }
    }

    /// `D⁻¹ L⁻¹ r`.
    #[inline(always)]
    pub(super) fn reduce(&self, r: Vec3<F>) -> Vec3<F> {
        self.factor.lower(r).component_mul(self.factor.inverse)
    }

    /// `H⁻¹ r` from `D⁻¹ L⁻¹ r`.
    #[inline(always)]
    pub(super) fn raise(&self, reduced: Vec3<F>) -> Vec3<F> {
        self.factor.raise(reduced)
    }

    /// `v − Mᵀ H⁻¹ r` from `D⁻¹ L⁻¹ r`.
    #[inline(always)]
    pub(super) fn reduce_slope(&self, v: Vec3<F>, reduced: Vec3<F>) -> Vec3<F> {
        reduced_slope(v, self.by_turn, reduced)
    }
}

#[inline(always)]
fn reduced_slope<F: Lanes>(v: Vec3<F>, [x, y, z]: [Vec3<F>; 3], q: Vec3<F>) -> Vec3<F> {
    z.mul_add(-q.z, y.mul_add(-q.y, x.mul_add(-q.x, v)))
}

/// A joint's turn (rad) after a step `−feedback`, which the trust region limits. (L7)
#[inline(always)]
pub(super) fn stepped<F: Lanes>(control: Vec3<F>, feedback: Vec3<F>) -> Vec3<F> {
    let one = feedback.x.splat(1.0);
    // A root and a division only where some lane needs them.
    let most = one.splat(LARGEST_TURN);
    let square = feedback.dot(feedback);
    let too_long = (most * most).lt(square);
    let feedback = match F::any_true(too_long) {
        true => feedback * F::select(too_long, most / square.sqrt(), one),
        false => feedback,
    };
    feedback.mul_add(-one, control)
}

/// `energy` plus that of a joint, `½ cᵀ K c + a·y` (J). (L2)
#[inline(always)]
pub(super) fn add_joint_energy<F: Lanes>(
    energy: F,
    c: Vec3<F>,
    stiffness: Vec3<F>,
    arm: Vec3<F>,
    up: Vec3<F>,
) -> F {
    let elastic = c.dot(stiffness.component_mul(c));
    energy.splat(0.5).mul_add(elastic, energy) + arm.dot(up)
}

/// Hessian of the energy by a joint's turn x and the turn θ of the frame before it, `½ xᵀ H x + xᵀ M θ`. (L5)
struct HessianBlocks<F> {
    /// H, without the joint's own stiffness.
    turn_turn: Sym3<F>,
    /// M, by rows.
    turn_frame: [Vec3<F>; 3],
}

impl<F: Lanes> HessianBlocks<F> {
    #[inline(always)]
    fn new(table: &RotationTable<F>, c: Vec3<F>, j: Mat3<F>, value: &ValueFunction<F>) -> Self {
        let (g, p) = (value.slope, value.hessian);
        let minus_half = c.x.splat(-0.5);
        // Columns of P J.
        let (px, py, pz) = (p.mul_vec(j.x), p.mul_vec(j.y), p.mul_vec(j.z));
        // A row of M: (P J)ᵀ − ½ (g × J)ᵀ = Jᵀ (P + ½ [g]×).
        let row = |pj: Vec3<F>, j: Vec3<F>| g.cross(j).mul_add(minus_half, pj);
        let block = Sym3 {
            xx: j.x.dot(px),
            xy: j.x.dot(py),
            xz: j.x.dot(pz),
            yy: j.y.dot(py),
            yz: j.y.dot(pz),
            zz: j.z.dot(pz),
        };
        let turn_frame = [row(px, j.x), row(py, j.y), row(pz, j.z)];
        Self { turn_turn: table.add_second(c, g, block), turn_frame }
    }
}

/// `L D Lᵀ` of a symmetric block.
#[derive(Clone, Copy)]
struct BlockFactor<F> {
    l21: F,
    l31: F,
    l32: F,
    /// D⁻¹.
    inverse: Vec3<F>,
    /// The least pivot, less its rounding error: positive if the block is positive definite.
    least: F,
}

impl<F: Lanes> BlockFactor<F> {
    #[inline(always)]
    fn new(block: Sym3<F>) -> Self {
        let one = block.xx.splat(1.0);
        let small = block.xx.splat(PIVOT_ROUNDING);
        // Column by column: 1/d_k and the column of L below it.
        let d1 = one / block.xx;
        let (l21, l31) = (block.xy * d1, block.xz * d1);
        let second = (-l21).mul_add(block.xy, block.yy);
        let e = (-l31).mul_add(block.xy, block.yz);
        let d2 = one / second;
        let l32 = e * d2;
        let third = (-l32).mul_add(e, (-l31).mul_add(block.xz, block.zz));
        let d3 = one / third;
        // Lanes cannot branch on a pivot: a bad one is reported, and its rod's law is not used.
        let beyond = |pivot: F, of: F| small.mul_add(-of, pivot);
        let least = block.xx.min(beyond(second, block.yy)).min(beyond(third, block.zz));
        Self { l21, l31, l32, inverse: Vec3::new(d1, d2, d3), least }
    }

    /// `L⁻¹` of a vector.
    #[inline(always)]
    fn lower(&self, v: Vec3<F>) -> Vec3<F> {
        let y = (-self.l21).mul_add(v.x, v.y);
        let z = (-self.l32).mul_add(y, (-self.l31).mul_add(v.x, v.z));
        Vec3::new(v.x, y, z)
    }

    /// `L⁻ᵀ` of a vector.
    #[inline(always)]
    fn raise(&self, v: Vec3<F>) -> Vec3<F> {
        let y = (-self.l32).mul_add(v.z, v.y);
        let x = (-self.l21).mul_add(y, (-self.l31).mul_add(v.z, v.x));
        Vec3::new(x, y, v.z)
    }

    /// `L⁻¹` of a matrix by rows.
    #[inline(always)]
    fn lower_rows(&self, [x, y, z]: [Vec3<F>; 3]) -> [Vec3<F>; 3] {
        let y = x.mul_add(-self.l21, y);
        let z = y.mul_add(-self.l32, x.mul_add(-self.l31, z));
        [x, y, z]
    }

    /// `L⁻ᵀ D⁻¹` of a matrix by rows, as a matrix whose transpose is to be applied.
    #[inline(always)]
    fn raise_rows(&self, [x, y, z]: [Vec3<F>; 3]) -> Mat3<F> {
        let z = z * self.inverse.z;
        let y = z.mul_add(-self.l32, y * self.inverse.y);
        let x = y.mul_add(-self.l21, z.mul_add(-self.l31, x * self.inverse.x));
        Mat3 { x, y, z }
    }
}
