//! The Hessian of one rod outside of the lanes, factorised: linear systems with it, for what couples rods with each other.

use glam::{DMat3, DVec3};

use super::joint_chain::JointChain;
use crate::rotation::{
    cross_matrix, right_jacobian, right_jacobian_derivative, scaled_identity, symmetric_outer,
};
use crate::stumpff::stumpff;

/// One joint of a factorised rod. Numbers are in single precision: a linear system is solved to 1e-6 or so, which is enough for a
/// preconditioner, and half of the memory is read.
#[derive(Clone, Copy, Debug, Default)]
pub struct JointFactor {
    /// A: rotation of the frame after the joint (rad, world) by its turn, by columns.
    axes: [[f32; 3]; 3],
    /// Derivative of the gradient by the joint's turn by a rotation of the frame before it, and by a shift, by rows.
    by_turn: [[f32; 3]; 3],
    by_shift: [[f32; 3]; 3],
    /// Inverse of the pivot: xx, xy, xz, yy, yz, zz.
    inverse: [f32; 6],
    /// To the next contact point (m, world).
    link: [f32; 3],
}

/// A symmetric matrix, such as the stiffness of a point (N/m, world axes).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Symmetric {
    /// First row and column.
    pub xx: f64,
    /// First row, second column, and the other way round.
    pub xy: f64,
    /// First row, third column, and the other way round.
    pub xz: f64,
    /// Second row and column.
    pub yy: f64,
    /// Second row, third column, and the other way round.
    pub yz: f64,
    /// Third row and column.
    pub zz: f64,
}

impl Symmetric {
    /// `k v vᵀ`.
    #[must_use]
    #[inline]
    pub fn square(v: DVec3, k: f64) -> Self {
        let w = v * k;
        Self {
            xx: w.x * v.x,
            xy: w.x * v.y,
            xz: w.x * v.z,
            yy: w.y * v.y,
            yz: w.y * v.z,
            zz: w.z * v.z,
        }
    }

    /// Of a matrix that is symmetric.
    #[must_use]
    #[inline]
    pub fn of(m: &DMat3) -> Self {
        let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
        Self { xx: x.x, xy: y.x, xz: z.x, yy: y.y, yz: z.y, zz: z.z }
    }

    /// `k` times the identity.
    #[must_use]
    #[inline]
    pub fn identity(k: f64) -> Self {
        Self { xx: k, yy: k, zz: k, ..Self::default() }
    }

    #[inline]
    fn matrix(&self) -> DMat3 {
        DMat3::from_cols(
            DVec3::new(self.xx, self.xy, self.xz),
            DVec3::new(self.xy, self.yy, self.yz),
            DVec3::new(self.xz, self.yz, self.zz),
        )
    }
}

impl std::ops::Mul<DVec3> for Symmetric {
    type Output = DVec3;

    #[inline]
    fn mul(self, v: DVec3) -> DVec3 {
        DVec3::new(
            self.xx * v.x + self.xy * v.y + self.xz * v.z,
            self.xy * v.x + self.yy * v.y + self.yz * v.z,
            self.xz * v.x + self.yz * v.y + self.zz * v.z,
        )
    }
}

impl std::ops::Mul<f64> for Symmetric {
    type Output = Self;

    #[inline]
    fn mul(self, k: f64) -> Self {
        Self {
            xx: self.xx * k,
            xy: self.xy * k,
            xz: self.xz * k,
            yy: self.yy * k,
            yz: self.yz * k,
            zz: self.zz * k,
        }
    }
}

impl std::ops::AddAssign for Symmetric {
    #[inline]
    fn add_assign(&mut self, o: Self) {
        self.xx += o.xx;
        self.xy += o.xy;
        self.xz += o.xz;
        self.yy += o.yy;
        self.yz += o.yz;
        self.zz += o.zz;
    }
}

/// A shape of one rod, and what acts on it.
#[derive(Clone, Copy)]
pub struct ChainShape<'a> {
    /// Turns of joints (rad).
    pub controls: &'a [DVec3],
    /// Contact points (m), of [`JointChain::shape`].
    pub points: &'a [DVec3],
    /// Frames after joints, of [`JointChain::shape`].
    pub frames: &'a [DMat3],
    /// Gradient (N) of every other energy by the contact points.
    pub forces: &'a [DVec3],
    /// Its Hessian (N/m) by each point; what couples two points is left out.
    pub stiffness: &'a [Symmetric],
}

#[inline]
fn narrow(v: DVec3) -> [f32; 3] {
    v.as_vec3().to_array()
}

#[inline]
fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::new(f64::from(v[0]), f64::from(v[1]), f64::from(v[2]))
}

#[inline]
fn times([x, y, z]: &[[f32; 3]; 3], v: DVec3) -> DVec3 {
    wide(*x) * v.x + wide(*y) * v.y + wide(*z) * v.z
}

#[inline]
fn dots([x, y, z]: &[[f32; 3]; 3], v: DVec3) -> DVec3 {
    DVec3::new(wide(*x).dot(v), wide(*y).dot(v), wide(*z).dot(v))
}

impl JointFactor {
    #[inline]
    fn inverse(&self, v: DVec3) -> DVec3 {
        let [xx, xy, xz, yy, yz, zz] = self.inverse.map(f64::from);
        Symmetric { xx, xy, xz, yy, yz, zz } * v
    }
}

impl JointChain {
    /// Factorises the Hessian of the energy by the turns of joints, the stiffness of joints `1 + damping` times as large, into
    /// `factors`. Returns the least pivot over the stiffness: positive if the Hessian is positive definite; if it is not, the factors
    /// are of no use. docs/theory.md, "Rods in lanes", (L5), (L6), (L9) and (L10), in world axes and at the exact slopes
    ///
    /// # Panics
    /// If the lengths do not fit.
    pub fn factorise(
        &self,
        shape: &ChainShape<'_>,
        damping: f64,
        factors: &mut [JointFactor],
    ) -> f64 {
        let n = self.joints();
        assert!(factors.len() == n && shape.stiffness.len() == n + 1, "a shape");
        let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
        // P, Q and S of the model beyond, by rotation and shift. (L8)
        let (mut p, mut q, mut s) = (DMat3::ZERO, DMat3::ZERO, DMat3::ZERO);
        let mut least = f64::INFINITY;
        for i in (0..n).rev() {
            let (c, frame) = (shape.controls[i], shape.frames[i]);
            let link = shape.points[i + 1] - shape.points[i];
            let arm = frame * self.arm(i);
            // 1. The contact point, and the link with the weight. (L9)
            force += shape.forces[i + 1];
            s += shape.stiffness[i + 1].matrix();
            moment += link.cross(force) + arm.cross(self.up());
            // W: ε ↦ ε × b.
            let w = cross_matrix(-link);
            let stiff = s * w;
            let qw = q * w;
            p += qw + qw.transpose() + w.transpose() * stiff;
            p += (symmetric_outer(link, force) + symmetric_outer(arm, self.up())) * 0.5;
            p -= scaled_identity(link.dot(force) + arm.dot(self.up()));
            q += stiff.transpose();
            // 2. The joint. (L5)
            let table = stumpff(c.length_squared());
            let axes = frame * right_jacobian(c, &table);
            let local = frame.transpose() * moment;
            let k = self.stiffness();
            let mut pivot = axes.transpose() * p * axes
                + right_jacobian_derivative(c, &table, local)
                + DMat3::from_diagonal(k * (1.0 + damping));
            pivot = (pivot + pivot.transpose()) * 0.5;
            let by_turn = axes.transpose() * (p + cross_matrix(moment) * 0.5);
            let by_shift = axes.transpose() * q;
            least = least.min(least_minor(&pivot) / k.min_element());
            // 3. Eliminated. (L6), (L10)
            let inverse = pivot.inverse();
            let (turn, shift) = (inverse * by_turn, inverse * by_shift);
            p -= by_turn.transpose() * turn;
            q -= by_turn.transpose() * shift;
            s -= by_shift.transpose() * shift;
            let rows = |m: DMat3| {
                let t = m.transpose();
                [t.x_axis, t.y_axis, t.z_axis].map(narrow)
            };
            let Symmetric { xx, xy, xz, yy, yz, zz } = Symmetric::of(&inverse);
            factors[i] = JointFactor {
                axes: [axes.x_axis, axes.y_axis, axes.z_axis].map(narrow),
                by_turn: rows(by_turn),
                by_shift: rows(by_shift),
                inverse: [xx, xy, xz, yy, yz, zz].map(|x| x as f32),
                link: narrow(link),
            };
        }
        least
    }
}

/// The least pivot of a symmetric matrix.
fn least_minor(m: &DMat3) -> f64 {
    let (x, y) = (m.x_axis, m.y_axis);
    let first = x.x;
    let second = y.y - x.y * x.y / first;
    let third = m.determinant() / (first * second);
    let least = first.min(second);
    // A later pivot says nothing after one that is not positive.
    if least > 0.0 { least.min(third) } else { least }
}

/// Solves `H x = r` with a factorised Hessian H: puts x (rad) into `solution`, and the motion (m) of contact points by it into
/// `moved`, one more than joints.
///
/// # Panics
/// If the lengths do not fit.
pub fn solve(
    factors: &[JointFactor],
    right: &[DVec3],
    solution: &mut [DVec3],
    moved: &mut [DVec3],
) {
    let n = factors.len();
    assert!(right.len() == n && solution.len() == n && moved.len() == n + 1, "a rod");
    let (mut turn, mut shift) = (DVec3::ZERO, DVec3::ZERO);
    for ((factor, right), x) in factors.iter().zip(right).zip(&mut *solution).rev() {
        turn += wide(factor.link).cross(shift);
        let slope = dots(&factor.axes, turn) - *right;
        let y = factor.inverse(slope);
        turn -= times(&factor.by_turn, y);
        shift -= times(&factor.by_shift, y);
        *x = slope;
    }
    let (mut turned, mut at) = (DVec3::ZERO, DVec3::ZERO);
    moved[0] = at;
    for ((factor, x), moved) in factors.iter().zip(solution).zip(&mut moved[1..]) {
        let slope = *x + dots(&factor.by_turn, turned) + dots(&factor.by_shift, at);
        *x = -factor.inverse(slope);
        turned += times(&factor.axes, *x);
        at += turned.cross(wide(factor.link));
        *moved = at;
    }
}

/// Adds `−k` times the gradient (N m) by the turns of joints of what has the gradient `forces` (N) by contact points to `sum`.
///
/// # Panics
/// If the lengths do not fit.
pub fn subtract_gradient(factors: &[JointFactor], forces: &[DVec3], k: f64, sum: &mut [DVec3]) {
    assert!(sum.len() == factors.len() && forces.len() == factors.len() + 1, "a rod");
    let (mut force, mut moment) = (DVec3::ZERO, DVec3::ZERO);
    for ((factor, more), sum) in factors.iter().zip(&forces[1..]).zip(sum).rev() {
        force += *more;
        moment += wide(factor.link).cross(force);
        *sum -= dots(&factor.axes, moment) * k;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Load, Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant};

    const N: usize = 12;

    fn curl() -> JointChain {
        let rod = Rod::new(RodSpec {
            length: 0.12,
            section: Section::from_diameter(70e-6, 1.4).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(0.01, 0.02).unwrap(),
            root: Root::from_tangent(DVec3::ZERO, DVec3::Y, DVec3::X).unwrap(),
            load: Load::down(9.81),
        });
        JointChain::new(&rod.unwrap(), N)
    }

    /// Gradient (N m) of weight, bending, and springs of `k` (N/m) between the contact points and a place.
    fn gradient(chain: &JointChain, controls: &[DVec3], k: f64) -> Vec<DVec3> {
        let (points, frames, forces) = shape(chain, controls, k);
        let mut gradient = vec![DVec3::ZERO; N];
        chain.gradient(controls, &points, &frames, &forces, &mut gradient);
        gradient
    }

    fn shape(
        chain: &JointChain,
        controls: &[DVec3],
        k: f64,
    ) -> (Vec<DVec3>, Vec<DMat3>, Vec<DVec3>) {
        let (mut points, mut frames) = (vec![DVec3::ZERO; N + 1], vec![DMat3::ZERO; N]);
        chain.shape(controls, &mut points, &mut frames);
        let forces = points.iter().map(|p| (*p - DVec3::new(0.01, 0.03, 0.02)) * k).collect();
        (points, frames, forces)
    }

    #[test]
    fn the_factor_is_that_of_the_derivative_of_the_gradient() {
        let chain = curl();
        let k = 2e-4;
        let wave = |i: usize, a: f64| (i as f64 * a).sin();
        let controls: Vec<DVec3> = (0..N)
            .map(|i| DVec3::new(0.3 * wave(i, 1.3), 0.2 * wave(i, 2.1), 0.25 * wave(i + 1, 0.7)))
            .collect();
        let direction: Vec<DVec3> =
            (0..N).map(|i| DVec3::new(wave(i, 0.9), wave(i + 2, 1.9), wave(i, 3.1))).collect();
        let (points, frames, forces) = shape(&chain, &controls, k);
        let stiffness = vec![Symmetric::identity(k); N + 1];
        let mut factors = vec![JointFactor::default(); N];
        let at = ChainShape {
            controls: &controls,
            points: &points,
            frames: &frames,
            forces: &forces,
            stiffness: &stiffness,
        };
        // Positive or not.
        chain.factorise(&at, 0.0, &mut factors);
        let h = 1e-5;
        let off = |t: f64| -> Vec<DVec3> {
            controls.iter().zip(&direction).map(|(c, d)| *c + *d * t).collect()
        };
        let (up, down) = (gradient(&chain, &off(h), k), gradient(&chain, &off(-h), k));
        let right: Vec<DVec3> = up.iter().zip(&down).map(|(a, b)| (*a - *b) / (2.0 * h)).collect();
        let (mut found, mut moved) = (vec![DVec3::ZERO; N], vec![DVec3::ZERO; N + 1]);
        solve(&factors, &right, &mut found, &mut moved);
        for (found, expected) in found.iter().zip(&direction) {
            assert!(found.distance(*expected) < 1e-4, "{found} {expected}");
        }
        // Points move as the shape does.
        let (ahead, ..) = shape(&chain, &off(h), k);
        let (back, ..) = shape(&chain, &off(-h), k);
        for ((a, b), moved) in ahead.iter().zip(&back).zip(&moved) {
            assert!(((*a - *b) / (2.0 * h)).distance(*moved) < 1e-5);
        }
        // The gradient of forces alone is the transpose of that motion.
        let mut by_turn = vec![DVec3::ZERO; N];
        subtract_gradient(&factors, &forces, -1.0, &mut by_turn);
        let work: f64 = by_turn.iter().zip(&found).map(|(g, x)| g.dot(*x)).sum();
        let expected: f64 = forces.iter().zip(&moved).map(|(f, u)| f.dot(*u)).sum();
        assert!((work / expected - 1.0).abs() < 1e-5, "{work} {expected}");
    }
}
