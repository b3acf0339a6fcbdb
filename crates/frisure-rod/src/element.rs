//! One element: the exact motion from its start to its end as a function of its control.
//!
//! Both kinds of element turn by `A exp([c]×) B` and advance by a [`RotationSeries`], where the
//! control `c` (rad) is `h u` for a helix and the rotation of the joint for a jointed element:
//!
//! - **Helix** (\[paper\] §2.4): constant strain u, `c = h u`, A = B = I.
//! - **Jointed**: half an element of the natural helix (A), a joint that turns by `c` and carries
//!   the moment there, the other half (B). Where a curl turns far within one element, a constant
//!   strain must average a moment that turns with it; the joint takes the moment where it is.

use glam::{DMat3, DVec3};

use crate::ElementKind;
use crate::rotation::{
    RotationSeries, exponential, right_jacobian, right_jacobian_derivative,
};
use crate::stumpff::{ORDERS, stumpff};

/// What an element has before it is bent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Geometry {
    kind: ElementKind,
    /// Length h (m).
    length: f64,
    /// Control at which the element is at rest (rad).
    rest: DVec3,
    before: DMat3,
    after: DMat3,
    /// Advance (m) and first moment (m²) up to the joint, in the start frame, the latter with the
    /// advance carried along the rest of the element.
    start: [DVec3; 2],
    /// Advance (m) and first moment (m²) after the joint, in the frame after the joint.
    end: [DVec3; 2],
}

impl Geometry {
    /// An element of length `length` (m), from the mean natural strain in its two halves (rad/m).
    pub(crate) fn new(kind: ElementKind, length: f64, natural: [DVec3; 2]) -> Self {
        let plain = Self {
            kind,
            length,
            rest: (natural[0] + natural[1]) * (0.5 * length),
            before: DMat3::IDENTITY,
            after: DMat3::IDENTITY,
            start: [DVec3::ZERO; 2],
            end: [DVec3::ZERO; 2],
        };
        match kind {
            ElementKind::Helix => plain,
            ElementKind::Jointed => {
                let half = 0.5 * length;
                let (before, p0, w0) = helix_piece(natural[0] * half, half);
                let (after, p1, w1) = helix_piece(natural[1] * half, half);
                Self {
                    rest: DVec3::ZERO,
                    before,
                    after,
                    start: [p0, w0 + p0 * half],
                    end: [p1, w1],
                    ..plain
                }
            }
        }
    }

    pub(crate) fn length(&self) -> f64 {
        self.length
    }

    pub(crate) fn rest(&self) -> DVec3 {
        self.rest
    }

    pub(crate) fn kind(&self) -> ElementKind {
        self.kind
    }

    /// Rotation from the start of the element to where its control acts.
    pub(crate) fn before(&self) -> &DMat3 {
        &self.before
    }

    /// The motion at control `c` (rad).
    #[inline]
    pub(crate) fn motion(&self, c: DVec3) -> Motion<'_> {
        Motion { geometry: self, control: c, table: stumpff(c.length_squared()) }
    }
}

/// Rotation, advance (m) and first moment (m²) of a helix that turns by `c` over `length`.
fn helix_piece(c: DVec3, length: f64) -> (DMat3, DVec3, DVec3) {
    let table = stumpff(c.length_squared());
    let advance = RotationSeries::phi(1, &table, length).value(c, DVec3::Z);
    let moment = RotationSeries::phi(2, &table, length * length).value(c, DVec3::Z);
    (exponential(c, &table), advance, moment)
}

/// Position (m, from the start, in the start frame) and frame on a helix.
pub(crate) fn along_helix(c: DVec3, length: f64) -> (DVec3, DMat3) {
    let (rotation, advance, _) = helix_piece(c, length);
    (advance, rotation)
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
        match self.geometry.kind {
            ElementKind::Helix => turn,
            ElementKind::Jointed => self.geometry.before * turn * self.geometry.after,
        }
    }

    /// Matrix J: changing the control by x turns the end frame by J x in itself.
    #[inline]
    pub(crate) fn turning(&self) -> DMat3 {
        let jacobian = right_jacobian(self.control, &self.table);
        match self.geometry.kind {
            ElementKind::Helix => jacobian,
            ElementKind::Jointed => self.geometry.after.transpose() * jacobian,
        }
    }

    /// Second derivative of the turn of the end frame, contracted with `lambda` in that frame.
    #[inline]
    pub(crate) fn turning_derivative(&self, lambda: DVec3) -> DMat3 {
        let lambda = match self.geometry.kind {
            ElementKind::Helix => lambda,
            ElementKind::Jointed => self.geometry.after * lambda,
        };
        right_jacobian_derivative(self.control, &self.table, lambda)
    }

    /// `α (r_end − r_start) + β ∫ (r − r_start) ds`, in the start frame.
    #[inline]
    pub(crate) fn reach(&self, alpha: f64, beta: f64) -> Reach<'_> {
        let g = self.geometry;
        match g.kind {
            ElementKind::Helix => {
                let (h, t) = (g.length, &self.table);
                let advance = RotationSeries::phi(1, t, alpha * h);
                let moment = RotationSeries::phi(2, t, beta * h * h);
                Reach {
                    control: self.control,
                    before: None,
                    offset: DVec3::ZERO,
                    arm: DVec3::Z,
                    series: advance.plus(&moment),
                }
            }
            ElementKind::Jointed => Reach {
                control: self.control,
                before: Some(&g.before),
                offset: g.start[0] * alpha + g.start[1] * beta,
                arm: g.end[0] * alpha + g.end[1] * beta,
                series: RotationSeries::phi(0, &self.table, 1.0),
            },
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
        let (g, c, t) = (self.geometry, self.control, &self.table);
        match g.kind {
            ElementKind::Helix => {
                let (a, b) = (alpha * g.length, beta * g.length * g.length);
                let turned = c.cross(DVec3::Z);
                DVec3::Z * (a + 0.5 * b)
                    + turned * (a * t[2] + b * t[3])
                    + c.cross(turned) * (a * t[3] + b * t[4])
            }
            ElementKind::Jointed => {
                let arm = g.end[0] * alpha + g.end[1] * beta;
                let turned = c.cross(arm);
                let after = arm + turned * t[1] + c.cross(turned) * t[2];
                g.start[0] * alpha + g.start[1] * beta + g.before * after
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
    arm: DVec3,
    series: RotationSeries,
}

impl Reach<'_> {
    /// The vector, in the start frame.
    #[inline]
    pub(crate) fn value(&self) -> DVec3 {
        let v = self.series.value(self.control, self.arm);
        self.offset + self.before.map_or(v, |a| *a * v)
    }

    /// Its derivative by the control.
    #[inline]
    pub(crate) fn jacobian(&self) -> DMat3 {
        let j = self.series.jacobian(self.control, self.arm);
        self.before.map_or(j, |a| *a * j)
    }

    /// Gradient and Hessian by the control of its product with `omega`, a vector in the start
    /// frame.
    #[inline]
    pub(crate) fn contracted(&self, omega: DVec3) -> (DVec3, DMat3) {
        let omega = self.before.map_or(omega, |a| a.transpose() * omega);
        self.series.contracted(self.control, self.arm, omega)
    }
}
