//! How hair leaves the scalp: the direction along the skin and the angle to it.

mod flow;
mod lift;
mod parting;
pub(crate) mod regions;
pub(crate) mod rim;

use glam::DVec3;

use crate::head::{Head, Landmarks};
use crate::roots::Root;
use crate::spec::{Flow, HairstyleSpec, Implantation, Parting, RegionStyle};

pub use parting::PartingError;
pub(crate) use parting::segments_cross;

use flow::Whorl;
use parting::Partings;

/// How hair leaves the scalp of one head: whorls and partings in their places on the skin.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    implantation: Implantation,
    regions: Vec<RegionStyle>,
    marks: Landmarks,
    whorls: Vec<Whorl>,
    partings: Partings,
}

/// Length along the skin below which a flow is no direction: there hair stands up.
const FAINT: f64 = 0.4;

impl Layout {
    /// Finds the places of a description on a head.
    ///
    /// # Errors
    /// [`PartingError`], if a parting is not on the scalp.
    pub(crate) fn new(spec: &HairstyleSpec, head: &Head) -> Result<Self, PartingError> {
        let implantation = spec.implantation.clone();
        let partings = match implantation.flow {
            Flow::Parted { offset } if implantation.partings.is_empty() => {
                &[Parting::Straight { offset }]
            }
            _ => implantation.partings.as_slice(),
        };
        Ok(Self {
            regions: spec.regions.clone(),
            marks: head.landmarks().clone(),
            whorls: flow::whorls(&implantation.whorls, head),
            partings: Partings::new(partings, head)?,
            implantation,
        })
    }

    /// The direction (unit) in which the hair of `root` leaves the scalp, without jitter.
    pub(crate) fn direction(&self, root: &Root) -> DVec3 {
        let (marks, spec) = (&self.marks, &self.implantation);
        let mut along = flow::along_skin(marks, spec.flow, &self.whorls, &self.partings, root);
        let mut angle = lift::angle(marks, spec.lift, root.position);
        for style in &self.regions {
            let share = regions::share(style, marks, root.position);
            if let Some(comb) = style.comb {
                along = along.lerp(flow::combed(comb, root.normal), share);
            }
            if let Some(lift) = style.lift {
                angle += (lift - angle) * share;
            }
        }
        let sure = smooth(0.0, FAINT, along.length());
        let angle = angle + (std::f64::consts::FRAC_PI_2 - angle) * (1.0 - sure);
        let along = along.normalize_or_zero();
        (along * angle.cos() + root.normal * angle.sin()).normalize_or(root.normal)
    }

    /// The direction to which curls lean as they leave the root: out of the skin and, where hair is
    /// combed, back.
    pub(crate) fn lean(&self, root: &Root) -> DVec3 {
        match self.implantation.flow {
            Flow::Whorl => root.normal,
            Flow::Parted { .. } | Flow::SweptBack => root.normal + DVec3::Y,
        }
    }

    /// Factor on the natural curl at a root.
    pub(crate) fn curl(&self, root: &Root) -> f64 {
        let factor = |style: &RegionStyle| {
            let asked = style.curl.unwrap_or(1.0);
            1.0 + (asked - 1.0) * regions::share(style, &self.marks, root.position)
        };
        self.regions.iter().map(factor).product()
    }

    /// The length (m) that a region asks for at a root; none where no region does.
    pub(crate) fn length(&self, head: &Head, root: &Root) -> Option<f64> {
        let style = &self.regions[self.cut(root.position)?];
        let length = style.length?;
        Some(regions::length(length, head, root, self.direction(root)))
    }

    /// Which region gives the hair rooted at a point (m) of the skin its length.
    pub(crate) fn cut(&self, p: DVec3) -> Option<usize> {
        regions::cut_at(&self.regions, &self.marks, p)
    }

    /// Whether hair rooted at two points (m) near each other cannot go together: a parting lies
    /// between them, or the edge of a region with a length of its own.
    pub(crate) fn apart(&self, a: DVec3, b: DVec3) -> bool {
        self.partings.between(&self.marks, a, b) || self.cut(a) != self.cut(b)
    }

    /// Whether neighbouring hair may have to be told apart at all.
    pub(crate) fn divides(&self) -> bool {
        !self.partings.is_empty() || self.regions.iter().any(|s| s.length.is_some())
    }
}

/// How far (m) a hair must be able to go straight before it meets skin again …
const CLEAR_PATH: f64 = 0.016;

/// … and how steeply (distance gained per length) it must leave meanwhile.
const CLEAR_SLOPE: f64 = 0.15;

/// Turns a direction (unit) away from skin that a hair would run into at once: hair rooted in front
/// of an ear does not grow into it.
pub(crate) fn clear_of_skin(head: &Head, root: &Root, direction: DVec3) -> DVec3 {
    const STEPS: i32 = 8;
    let mut direction = direction;
    for _ in 0..4 {
        let mut blocked = false;
        for step in 1..=STEPS {
            let s = CLEAR_PATH * f64::from(step) / f64::from(STEPS);
            let ahead = root.position + direction * s;
            let (distance, away) = head.signed_distance().value_gradient(ahead);
            let missing = CLEAR_SLOPE * s - distance;
            if missing > 0.0 {
                blocked = true;
                let turned = direction + away.normalize_or(root.normal) * (missing / s);
                direction = turned.normalize_or(root.normal);
            }
        }
        if !blocked {
            break;
        }
    }
    direction
}

/// Smooth step from 0 at `low` to 1 at `high`.
pub(crate) fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests;
