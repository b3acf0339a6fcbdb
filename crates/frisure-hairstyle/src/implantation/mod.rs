//! How hair leaves the scalp: the direction along the skin and the angle to it.

mod flow;
mod lift;
mod parting;
pub(crate) mod regions;
pub(crate) mod rim;
mod roots;
mod tape;
mod ways;

use glam::DVec3;

use crate::head::{Head, Landmarks};
use crate::math::smooth_step;
use crate::random::{Purpose, Stream};
use crate::spec::{Flow, HairstyleSpec, Implantation, Lift, Parting, RegionLength, RegionStyle};

pub use parting::PartingError;
pub(crate) use roots::Scalp;
pub use roots::{Root, scalp_area};
pub(crate) use tape::Tape;
pub(crate) use ways::Ways;

use flow::Whorl;
use parting::{Away, Partings};

/// How hair leaves the scalp of one head: whorls and partings in their places on the skin.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    implantation: Implantation,
    regions: Vec<RegionStyle>,
    marks: Landmarks,
    whorls: Vec<Whorl>,
    partings: Partings,
    /// Angle (rad) between a curl's fibre and the axis that it winds about.
    lead: f64,
}

/// How much longer (m) than its way down to a level a guide is: the way over hair is longer than over skin.
/// Chosen by trial; not measured further.
const SPARE: f64 = 5e-3;

/// Length along the skin below which a flow is no direction: there hair stands up. Chosen by eye; not measured.
const FAINT: f64 = 0.4;

/// How much a comb counts for the lean of curls, against the skin's normal. Chosen by eye; not measured.
const COMBED: f64 = 2.0;

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
            lead: lift::lead(spec.curl.strain),
            implantation,
        })
    }

    /// The direction (unit) in which the hair of `root` leaves the scalp, without jitter.
    pub(crate) fn direction(&self, root: &Root) -> DVec3 {
        let marks = &self.marks;
        let (along, combed) = self.along(root);
        let mut angle = self.angle(root, combed);
        for style in &self.regions {
            if let Some(lift) = style.lift {
                angle += (lift - angle) * regions::share(style, marks, root.position);
            }
        }
        // Where sources contradict each other hair stands up, so that its direction in space is continuous there.
        let sure = smooth_step(0.0, FAINT, along.length());
        let angle = angle + (std::f64::consts::FRAC_PI_2 - angle) * (1.0 - sure);
        let along = along.normalize_or_zero();
        (along * angle.cos() + root.normal * angle.sin()).normalize_or(root.normal)
    }

    /// The direction along the skin (no longer than 1), and how much of it is a comb's, 0 to 1.
    fn along(&self, root: &Root) -> (DVec3, f64) {
        let (marks, flow) = (&self.marks, self.implantation.flow);
        let mut along = flow::along_skin(marks, flow, &self.whorls, &self.partings, root);
        let mut combed = f64::from(flow != Flow::Whorl);
        for style in &self.regions {
            if let Some(comb) = style.comb {
                let share = regions::share(style, marks, root.position);
                along = along.lerp(flow::combed(comb, root.normal), share);
                combed += (1.0 - combed) * share;
            }
        }
        (along, combed)
    }

    /// The angle to the skin (rad), before regions ask for theirs.
    fn angle(&self, root: &Root, combed: f64) -> f64 {
        let grown = lift::angle(&self.marks, self.implantation.lift, root.position, combed);
        let Lift::Regional { .. } = self.implantation.lift else { return grown };
        let beside = self.partings.away(root.position, root.normal);
        let flat = beside.map_or(grown, |Away { distance, .. }| lift::laid_flat(grown, distance));
        let raised = lift::turned_back(&self.marks, flat, self.lead, root.position);
        flat + (raised - flat) * combed
    }

    /// The direction to which a curl of this strain (rad/m) leans as it leaves the root along
    /// `tangent`: out of the skin and, where hair is combed, with the comb. A wave too long for an
    /// axis to tell bends to the skin there, not across its neighbours.
    pub(crate) fn lean(&self, root: &Root, tangent: DVec3, strain: DVec3) -> DVec3 {
        let (along, combed) = self.along(root);
        let out = root.normal + along * (COMBED * combed);
        // With the axis across tangent and normal, a wave bends in the plane of both, towards the skin.
        let down = root.normal.cross(tangent) * (COMBED * strain.z.signum());
        out.lerp(down, combed * (1.0 - lift::curly(strain)))
    }

    /// Where to hair was combed that would fall back: out of the face, and over the head to the other side of a parting that is not on
    /// top of it. A sum of horizontal vectors, no longer than 1 each: how much of the hair at a root it is.
    pub(crate) fn held(&self, root: &Root) -> DVec3 {
        let (along, combed) = self.along(root);
        let back = -self.marks.face * (combed * out_of_face(&self.marks, root.position, along));
        let Some(Away { along: away, distance, strength }) =
            self.partings.away(root.position, root.normal)
        else {
            return back;
        };
        let near = (-(distance / BESIDE).powi(2)).exp();
        let over = combed * strength * near * smooth_step(0.0, UPHILL, away.z);
        back + DVec3::new(away.x, away.y, 0.0).normalize_or_zero() * over
    }

    /// Factor on the natural curl at a root.
    pub(crate) fn curl(&self, root: &Root) -> f64 {
        let factor = |style: &RegionStyle| {
            let asked = style.curl.unwrap_or(1.0);
            1.0 + (asked - 1.0) * regions::share(style, &self.marks, root.position)
        };
        self.regions.iter().map(factor).product()
    }

    /// The length (m) that a region has set at a root; none where no region has.
    pub(crate) fn length(&self, head: &Head, root: &Root) -> Option<f64> {
        let style = &self.regions[self.cut(root.position)?];
        let length = style.length?;
        Some(regions::length(length, head, root, self.direction(root)))
    }

    /// How much longer (m) than [`Self::length`] a guide is: the way over hair down to a level is longer than over skin.
    pub(crate) fn spare(&self, root: &Root) -> f64 {
        let length = self.cut(root.position).and_then(|index| self.regions[index].length);
        if let Some(RegionLength::DownTo(_)) = length { SPARE } else { 0.0 }
    }

    /// Which region gives the hair rooted at a point (m) of the skin its length.
    pub(crate) fn cut(&self, p: DVec3) -> Option<usize> {
        regions::cut_at(&self.regions, &self.marks, p)
    }

    /// Where a drawn hair is rooted: beside a parting and in a whorl, nearer to the line or the middle than it grows. Hair
    /// is heaped there and hides the skin; hair drawn one by one from even roots leaves a broad stripe, and a bald star.
    pub(crate) fn gathered(&self, head: &Head, root: Root) -> Root {
        let mut position = self.partings.gathered(root.position);
        if self.implantation.flow == Flow::Whorl {
            position = flow::gathered(&self.whorls, position);
        }
        if position == root.position {
            return root;
        }
        let (distance, away) = head.signed_distance().value_gradient(position);
        Root { position: position - away * distance, ..root }
    }

    /// Whether hair rooted at `a` (m) that is combed from `side` (m) cannot go with that rooted at `b` (m) near it: a parting
    /// lies between them, or the edge of a region with a length of its own.
    pub(crate) fn apart(&self, a: DVec3, side: DVec3, b: DVec3) -> bool {
        self.partings.between(&self.marks, side, b) || self.cut(a) != self.cut(b)
    }

    /// The root from which a hair is combed to a side of a parting: beside its own by chance, because a comb does not part hair
    /// to the width of one, so that some hairs lie over the line.
    pub(crate) fn combed_from(&self, root: &Root, seed: u64, index: usize) -> Root {
        if self.partings.is_empty() {
            return *root;
        }
        let mut random = Stream::new(seed, Purpose::PartingSide, index);
        let mut stray = || STRAY * random.normal();
        let step = DVec3::new(stray(), stray(), stray()).reject_from_normalized(root.normal);
        Root { position: root.position + step, ..*root }
    }

    /// Whether neighbouring hair may have to be kept apart at all.
    pub(crate) fn divides(&self) -> bool {
        !self.partings.is_empty() || self.regions.iter().any(|s| s.length.is_some())
    }
}

/// Distance (m) from a parting within which hair that is combed uphill would fall back over it: it lies on the top of the head from there
/// on. Chosen by eye.
const BESIDE: f64 = 0.04;

/// Slope (sine) of the way uphill from a parting at which all of that hair would. Chosen by eye.
const UPHILL: f64 = 0.06;

/// How much of the hair at a place of the skin (m) that is combed `along` it (no longer than 1), 0 to 1, would fall into the face.
pub(crate) fn out_of_face(marks: &Landmarks, place: DVec3, along: DVec3) -> f64 {
    // Borders in radii of the cranium (y backwards), and slopes to the face: chosen by eye.
    let front = 1.0 - smooth_step(-0.6, 0.1, marks.normalized(place).y);
    front * (1.0 - smooth_step(0.2, 0.6, along.dot(marks.face)))
}

/// Standard deviation (m), along each axis, of the place from which a hair beside a parting is combed. Chosen by eye: the teeth of
/// a comb are 1 to 2 mm apart.
const STRAY: f64 = 1.0e-3;

/// How far (m) a hair must be able to go straight before it meets skin again. Chosen by trial; not measured further.
const CLEAR_PATH: f64 = 0.016;

/// How steeply (distance gained per length) it must leave the skin meanwhile. Chosen by trial; not measured further.
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
            // The direction turns along the gradient of the distance by what is missing there.
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

#[cfg(test)]
mod tests;
