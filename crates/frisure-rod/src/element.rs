//! One element: the exact motion from its start to its end as a function of its control.
//!
//! Every kind of element turns by `A exp([c]×) B` and advances by a [`RotationSeries`]; the control
//! `c` (rad) is what the minimiser moves:
//!
//! - **Helix** (\[paper\] §2.4): constant strain u, `c = h u`, A = B = I.
//! - **Jointed**: half an element of the natural helix (A), a joint that turns by `c` and carries
//!   the moment there, the other half (B). Where a curl turns far within one element, a constant
//!   strain must average a moment that turns with it; the joint takes the moment where it is.

use glam::{DMat3, DVec3};

use crate::resolution::ElementKind;
use crate::rotation::{
    RotationSeries, exponential, nearest_turn, right_jacobian, right_jacobian_derivative,
};
use crate::stumpff::{ORDERS, stumpff};

/// The geometry and stiffness of an element, without its control.
#[derive(Clone, Debug)]
pub(crate) struct Geometry {
    /// Length h (m).
    length: f64,
    /// Control at which the element is at rest (rad).
    rest: DVec3,
    /// Stiffness against the control (N m).
    stiffness: DVec3,
    curve: Curve,
}

#[derive(Clone, Debug)]
enum Curve {
    Helix,
    Jointed(Box<Jointed>),
}

/// A joint between two pieces of the natural helix.
#[derive(Clone, Debug)]
struct Jointed {
    before: DMat3,
    after: DMat3,
    /// Mean natural strain before and after the joint (rad/m).
    natural: [DVec3; 2],
    /// Advance (m) and first moment (m²) up to the joint, in the start frame, the latter with the
    /// advance carried along the rest of the element.
    start: [DVec3; 2],
    /// Advance (m) and first moment (m²) after the joint, in the frame after the joint.
    end: [DVec3; 2],
}

impl Geometry {
    /// An element of length `length` (m) and material stiffness E I1, E I2, μ J (N m²), from the
    /// mean natural strain in its two halves (rad/m).
    pub(crate) fn new(
        kind: ElementKind,
        length: f64,
        natural: [DVec3; 2],
        material: DVec3,
    ) -> Self {
        // ½ (c − c⁰)ᵀ (K/h) (c − c⁰), with c⁰ = h u⁰ for a helix and 0 for a joint. [paper] (2.3)
        let stiffness = material / length;
        let mean = (natural[0] + natural[1]) * (0.5 * length);
        match kind {
            ElementKind::Helix => Self { length, rest: mean, stiffness, curve: Curve::Helix },
            ElementKind::Jointed | ElementKind::Auto => {
                // A and B with their advances p and first moments w; the first piece carries its advance along the rest.
                // The joint is in the middle of the element: with it at an end the error would be of first order in h.
                let half = 0.5 * length;
                let (before, p0, w0) = helix_piece(natural[0] * half, half);
                let (after, p1, w1) = helix_piece(natural[1] * half, half);
                let (start, end) = ([p0, w0 + p0 * half], [p1, w1]);
                let curve =
                    Curve::Jointed(Box::new(Jointed { before, after, natural, start, end }));
                Self { length, rest: DVec3::ZERO, stiffness, curve }
            }
        }
    }

    /// A jointed element as three elements that move as it does: a helix of half the length, a joint alone of no length,
    /// and the other helix. The helices have no stiffness, and at their natural controls each is its half of the element.
    /// `None` for a helix.
    pub(crate) fn pieces(&self) -> Option<[Self; 3]> {
        let Curve::Jointed(jointed) = &self.curve else { return None };
        let half = 0.5 * self.length;
        let helix = |natural: DVec3| Self {
            length: half,
            rest: natural * half,
            stiffness: DVec3::ZERO,
            curve: Curve::Helix,
        };
        let alone = Jointed {
            before: DMat3::IDENTITY,
            after: DMat3::IDENTITY,
            natural: [DVec3::ZERO; 2],
            start: [DVec3::ZERO; 2],
            end: [DVec3::ZERO; 2],
        };
        let joint = Self {
            length: 0.0,
            rest: self.rest,
            stiffness: self.stiffness,
            curve: Curve::Jointed(Box::new(alone)),
        };
        let [before, after] = jointed.natural.map(helix);
        Some([before, joint, after])
    }

    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    pub(crate) fn rest(&self) -> DVec3 {
        self.rest
    }

    /// Stiffness against the control (N m): E I1/h, E I2/h, μ J/h.
    pub(crate) fn stiffness(&self) -> DVec3 {
        self.stiffness
    }

    /// Rotation from the start of the element to the frame in which its moment is
    /// `stiffness (c − rest)`, at control `c` (rad).
    pub(crate) fn moment_frame(&self, c: DVec3) -> DMat3 {
        match &self.curve {
            // A constant strain acts all along: its moment belongs to the middle.
            Curve::Helix => {
                let half = c * 0.5;
                exponential(half, &stumpff(half.length_squared()))
            }
            Curve::Jointed(jointed) => jointed.before,
        }
    }

    /// The control (rad) at which the end frame is `turn` seen from the start frame: of all that differ by whole turns the nearest to `near`.
    pub(crate) fn control_for(&self, turn: &DMat3, near: DVec3) -> DVec3 {
        // The turn of the joint alone, Aᵀ Q Bᵀ.
        let turn = match &self.curve {
            Curve::Helix => *turn,
            Curve::Jointed(j) => j.before.transpose() * *turn * j.after.transpose(),
        };
        nearest_turn(glam::DQuat::from_mat3(&turn).normalize().to_scaled_axis(), near)
    }

    /// Rotation and advance (m) from the start of the element to arc length `from` (m) within it, at
    /// control `c` (rad). A joint's turn is spread evenly along its element: the frames at both ends
    /// stay, and what is drawn has no kink.
    pub(crate) fn inside(&self, c: DVec3, from: f64) -> (DMat3, DVec3) {
        match &self.curve {
            Curve::Helix => {
                let (turn, advance, _) = helix_piece(c * (from / self.length), from);
                (turn, advance)
            }
            Curve::Jointed(jointed) => {
                // exp[A c] A B = A exp[c] B: seen from the start frame the joint turns by A c.
                let turn = jointed.before * c / self.length;
                let whole = jointed.smooth(turn, self.length, self.length).1;
                let (rotation, advance) = jointed.smooth(turn, self.length, from);
                // To third order in h the smooth curve ends where the joint's does. That remainder is spread so that the
                // drawn line is continuous at the node, and has the tangent of the node's frame there.
                let rest = self.motion(c).advance() - whole;
                let x = from / self.length;
                (rotation, advance + rest * (x * x * (3.0 - 2.0 * x)))
            }
        }
    }

    /// The motion at control `c` (rad).
    #[inline]
    pub(crate) fn motion(&self, c: DVec3) -> Motion<'_> {
        Motion { geometry: self, control: c, table: stumpff(c.length_squared()) }
    }
}

impl Jointed {
    /// Natural rotation and advance (m) up to arc length `s` (m) of an element of length `h` (m).
    fn rest(&self, h: f64, s: f64) -> (DMat3, DVec3) {
        let half = 0.5 * h;
        let [first, second] = self.natural;
        if s <= half {
            let (turn, advance, _) = helix_piece(first * s, s);
            return (turn, advance);
        }
        let (turn, advance, _) = helix_piece(second * (s - half), s - half);
        // r(s) = p_A + A p_B(s − h/2): the natural element with its joint at rest.
        let start = helix_piece(first * half, half).1;
        (self.before * turn, start + self.before * advance)
    }

    /// Rotation `exp(s[w]) N(s)` and advance (m) up to arc length `s` (m), where N is natural and
    /// `turn` = w (rad/m) turns steadily in the start frame.
    fn smooth(&self, turn: DVec3, h: f64, s: f64) -> (DMat3, DVec3) {
        let turned = |s: f64| DMat3::from_quat(glam::DQuat::from_scaled_axis(turn * s));
        let (rest, mut advance) = self.rest(h, s);
        // What the turn adds to the advance, ∫ (exp(σ[w]×) − I) N(σ) e_3 dσ, by Gauss's rule of three points (weights 5, 8, 5
        // over 18 of a panel, nodes ±√0.6 of its half) on panels of half a radian: chosen, with an error of sixth order.
        let angle = (turn.length() + self.natural[0].length().max(self.natural[1].length())) * s;
        let panels = if turn == DVec3::ZERO { 0.0 } else { (angle / 0.5).ceil().clamp(2.0, 1e4) };
        let panel = s / panels;
        for i in 0..panels as usize {
            let middle = (i as f64 + 0.5) * panel;
            for (offset, weight) in [(-0.6_f64.sqrt(), 5.0), (0.0, 8.0), (0.6_f64.sqrt(), 5.0)] {
                let at = middle + 0.5 * panel * offset;
                let tangent = self.rest(h, at).0.z_axis;
                advance += (turned(at) * tangent - tangent) * (weight / 18.0 * panel);
            }
        }
        (turned(s) * rest, advance)
    }
}

/// Rotation, advance (m) and first moment (m²) of a helix that turns by `c` over `length`.
pub(crate) fn helix_piece(c: DVec3, length: f64) -> (DMat3, DVec3, DVec3) {
    // p = h φ_1 e_3 and w = h² φ_2 e_3 with e_3 the tangent at the start. docs/theory.md, "Elements" and (E1)
    let table = stumpff(c.length_squared());
    let advance = RotationSeries::phi(1, &table, length, DVec3::Z).value(c);
    let moment = RotationSeries::phi(2, &table, length * length, DVec3::Z).value(c);
    (exponential(c, &table), advance, moment)
}

/// Advance (m) of a helix that turns by `c` over `length`.
#[inline]
fn helix_advance(c: DVec3, length: f64) -> DVec3 {
    let table = stumpff(c.length_squared());
    let turned = c.cross(DVec3::Z);
    (DVec3::Z + turned * table[2] + c.cross(turned) * table[3]) * length
}

/// The motion over one element at one control.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion<'a> {
    geometry: &'a Geometry,
    control: DVec3,
    table: [f64; ORDERS],
}

impl Motion<'_> {
    /// Rotation from the start frame to the end frame.
    #[inline]
    pub(crate) fn rotation(&self) -> DMat3 {
        let turn = exponential(self.control, &self.table);
        match &self.geometry.curve {
            Curve::Helix => turn,
            Curve::Jointed(jointed) => jointed.before * turn * jointed.after,
        }
    }

    /// Matrix J: changing the control by x turns the end frame by J x in itself.
    #[inline]
    pub(crate) fn turning(&self) -> DMat3 {
        let jacobian = right_jacobian(self.control, &self.table);
        match &self.geometry.curve {
            Curve::Helix => jacobian,
            Curve::Jointed(jointed) => jointed.after.transpose() * jacobian,
        }
    }

    /// Second derivative of the turn of the end frame, contracted with `lambda` in that frame.
    #[inline]
    pub(crate) fn turning_derivative(&self, lambda: DVec3) -> DMat3 {
        let lambda = match &self.geometry.curve {
            Curve::Helix => lambda,
            Curve::Jointed(jointed) => jointed.after * lambda,
        };
        right_jacobian_derivative(self.control, &self.table, lambda)
    }

    /// `α (r_end − r_start) + β ∫ (r − r_start) ds`, in the start frame.
    #[inline]
    pub(crate) fn reach(&self, alpha: f64, beta: f64) -> Reach<'_> {
        let (h, c, t) = (self.geometry.length, self.control, &self.table);
        let (before, offset, series) = match &self.geometry.curve {
            // h φ_1 e_3 is the advance and h² φ_2 e_3 the first moment. docs/theory.md, "Elements"
            Curve::Helix => {
                let advance = RotationSeries::phi(1, t, alpha * h, DVec3::Z);
                let moment = RotationSeries::phi(2, t, beta * h * h, DVec3::Z);
                (None, DVec3::ZERO, advance.plus(&moment))
            }
            // The second piece is rigid in the frame after the joint: A exp[c] b.
            Curve::Jointed(j) => {
                let arm = j.end[0] * alpha + j.end[1] * beta;
                let offset = j.start[0] * alpha + j.start[1] * beta;
                (Some(&j.before), offset, RotationSeries::phi(0, t, 1.0, arm))
            }
        };
        Reach { control: c, before, offset, series }
    }

    /// `r − r_start` at the fraction `x`, 0 to 1, of the element, as [`Self::reach`].
    #[inline]
    pub(crate) fn part(&self, x: f64) -> Part<'_> {
        let h = self.geometry.length;
        match &self.geometry.curve {
            Curve::Helix => {
                // The same helix over the length x h: the control is x c, and the derivative by c gains a factor x.
                let control = self.control * x;
                let table = stumpff(control.length_squared());
                let series = RotationSeries::phi(1, &table, x * h, DVec3::Z);
                let reach = Reach { control, before: None, offset: DVec3::ZERO, series };
                Part { reach, share: x }
            }
            // Before the joint the control has no effect.
            Curve::Jointed(j) if x <= 0.5 => {
                let offset = helix_advance(j.natural[0] * (x * h), x * h);
                let series = RotationSeries::phi(0, &self.table, 0.0, DVec3::Z);
                let reach = Reach { control: self.control, before: None, offset, series };
                Part { reach, share: 0.0 }
            }
            Curve::Jointed(j) => {
                let beyond = (x - 0.5) * h;
                let arm = helix_advance(j.natural[1] * beyond, beyond);
                let series = RotationSeries::phi(0, &self.table, 1.0, arm);
                let (control, before) = (self.control, Some(&j.before));
                let reach = Reach { control, before, offset: j.start[0], series };
                Part { reach, share: 1.0 }
            }
        }
    }

    /// The value of [`Self::part`], without the cost of its derivatives.
    #[inline]
    pub(crate) fn plain_part(&self, x: f64) -> DVec3 {
        let h = self.geometry.length;
        match &self.geometry.curve {
            Curve::Helix => helix_advance(self.control * x, x * h),
            Curve::Jointed(j) if x <= 0.5 => helix_advance(j.natural[0] * (x * h), x * h),
            Curve::Jointed(j) => {
                let beyond = (x - 0.5) * h;
                let arm = helix_advance(j.natural[1] * beyond, beyond);
                let (c, t) = (self.control, &self.table);
                let turned = c.cross(arm);
                j.start[0] + j.before * (arm + turned * t[1] + c.cross(turned) * t[2])
            }
        }
    }

    /// `r_end − r_start` (m), in the start frame, without derivatives.
    #[inline]
    pub(crate) fn advance(&self) -> DVec3 {
        self.plain_reach(1.0, 0.0)
    }

    /// The value of [`Self::reach`], without the cost of its derivatives.
    #[inline]
    pub(crate) fn plain_reach(&self, alpha: f64, beta: f64) -> DVec3 {
        let (h, c, t) = (self.geometry.length, self.control, &self.table);
        match &self.geometry.curve {
            Curve::Helix => {
                let (a, b) = (alpha * h, beta * h * h);
                // (a φ_1 + b φ_2) e_3 with c×e_3 computed once: a line search needs values alone.
                let turned = c.cross(DVec3::Z);
                DVec3::Z * (a + 0.5 * b)
                    + turned * (a * t[2] + b * t[3])
                    + c.cross(turned) * (a * t[3] + b * t[4])
            }
            Curve::Jointed(j) => {
                let arm = j.end[0] * alpha + j.end[1] * beta;
                let turned = c.cross(arm);
                let after = arm + turned * t[1] + c.cross(turned) * t[2];
                j.start[0] * alpha + j.start[1] * beta + j.before * after
            }
        }
    }
}

/// A vector that depends on an element's control, with derivatives.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reach<'a> {
    control: DVec3,
    before: Option<&'a DMat3>,
    offset: DVec3,
    series: RotationSeries,
}

impl Reach<'_> {
    /// The vector, in the start frame.
    #[inline]
    pub(crate) fn value(&self) -> DVec3 {
        let v = self.series.value(self.control);
        self.offset + self.before.map_or(v, |a| *a * v)
    }

    /// Its derivative by the control.
    #[inline]
    pub(crate) fn jacobian(&self) -> DMat3 {
        let j = self.series.jacobian(self.control);
        self.before.map_or(j, |a| *a * j)
    }

    /// Gradient and Hessian by the control of its product with `omega`, a vector in the start
    /// frame.
    #[inline]
    pub(crate) fn contracted(&self, omega: DVec3) -> (DVec3, DMat3) {
        let omega = self.before.map_or(omega, |a| a.transpose() * omega);
        self.series.contracted(self.control, omega)
    }
}

/// A [`Reach`] to a point inside an element, on which a share of the element's control acts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part<'a> {
    reach: Reach<'a>,
    share: f64,
}

impl Part<'_> {
    /// The vector (m), in the start frame.
    #[inline]
    pub(crate) fn value(&self) -> DVec3 {
        self.reach.value()
    }

    /// Its derivative by the element's control.
    #[inline]
    pub(crate) fn jacobian(&self) -> DMat3 {
        self.reach.jacobian() * self.share
    }

    /// As [`Reach::contracted`], by the element's control.
    #[inline]
    pub(crate) fn contracted(&self, omega: DVec3) -> (DVec3, DMat3) {
        let (gradient, hessian) = self.reach.contracted(omega);
        (gradient * self.share, hessian * (self.share * self.share))
    }
}
