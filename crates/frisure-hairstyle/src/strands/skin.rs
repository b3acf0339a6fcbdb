//! Hairs that would lie in the body are laid on it.

use glam::DVec3;

use crate::head::Head;
use crate::implantation::Root;
use crate::spec::Body;

/// Depth of the first point of a hair below the skin (m), so that no root floats.
/// Chosen: more than the error of the distance field on smooth skin.
const ROOT_DEPTH: f64 = 3e-4;

/// How much longer than it is deep the piece of a hair below the skin is at most, of hair that leaves it flat. Chosen: a line
/// of hair that lies at 12° (docs/theory.md, "Roots and implantation") comes out of the skin where it is rooted.
const LONGEST_BELOW: f64 = 5.0;

/// The first point (m) of a hair that leaves the skin at its root in a direction (unit): below the skin, and so that the hair
/// comes out at the root. Straight below it, hair that lies flat would leave a strip of bare skin beside a parting.
pub(super) fn below(root: &Root, direction: DVec3) -> DVec3 {
    let rise = direction.dot(root.normal).max(1.0 / LONGEST_BELOW);
    let along = direction - root.normal * direction.dot(root.normal);
    root.position - (root.normal + along / rise) * ROOT_DEPTH
}

/// Least distance of a hair from the skin far from its root (m). Chosen by eye; not measured.
pub(super) const LEAST_DISTANCE: f64 = 4e-4;

/// Arc length (m) over which the least distance grows to its full size. Chosen by eye; not measured.
const LEAST_GROWTH: f64 = 0.003;

/// Width over which hairs are moved out of the body, as a fraction of the radius of their wisp …
/// Chosen by eye; not measured.
pub(super) const PRESSED: f64 = 0.3;

/// Least width (m) over which hairs are moved out of the body. Chosen by trial; not measured further.
pub(super) const LAID: f64 = 2e-5;

/// How many widths farther out no hair is moved: there the law moves it by 2.5e-3 of a width. Chosen.
const FREE: f64 = 6.0;

/// Most steps out of the skin. Chosen: on smooth skin one or two suffice, in creases of a coarse mesh eight.
const MOST_STEPS: usize = 16;

/// Least slope of the distance field that a step out of the skin takes for true. Chosen: a step is at most four times the depth.
const FLATTEST: f64 = 0.25;

/// A ball (m) known to be free of the body and of its layers: most points need no look-up.
pub(super) struct Free {
    centre: DVec3,
    radius: f64,
}

impl Free {
    pub(super) const NOWHERE: Self = Self { centre: DVec3::ZERO, radius: -1.0 };

    fn holds(&self, p: DVec3) -> bool {
        self.radius > 0.0 && p.distance_squared(self.centre) < self.radius * self.radius
    }
}

/// The skin that drawn hairs are laid on.
pub(super) struct Skin<'a> {
    pub(super) head: &'a Head,
    pub(super) body: Body,
    /// Largest width (m) over which hairs of any wisp are moved out of the body.
    pub(super) widest: f64,
}

impl Skin<'_> {
    /// Moves a point at arc length `s` (m) that is in the body, or within about `width` (m) of it, out of
    /// it.
    ///
    /// What would lie at the depths of a wisp that is pressed on the skin comes to lie at
    /// `m + w ln(1 + exp((d − m)/w))`, d its distance before: in the same order, nothing in the skin,
    /// and no two layers in one.
    pub(super) fn lay(&self, root: &Root, p: DVec3, s: f64, width: f64, free: &mut Free) -> DVec3 {
        if s <= 0.0 {
            return p;
        }
        if self.body == Body::None || free.holds(p) {
            return p;
        }
        // It grows from zero at the follicle.
        let least = LEAST_DISTANCE * (s / LEAST_GROWTH).min(1.0);
        let (distance, gradient) = self.head.signed_distance().value_gradient(p);
        let beyond = (distance - least) / width;
        // The point stays, and so does all in the ball up to the layers of the thickest wisp.
        if beyond > FREE {
            *free = Free { centre: p, radius: distance - least - FREE * self.widest };
            return p;
        }
        let wanted = least + width * beyond.exp().ln_1p();
        let mut p = p + gradient.normalize_or(root.normal) * (wanted - distance);
        for _ in 0..MOST_STEPS {
            // Where the skin is curved the way out is not straight.
            let (distance, gradient) = self.head.signed_distance().value_gradient(p);
            if distance >= least {
                break;
            }
            // In creases the distance field is rounded, and grows by less than the way: Newton's step.
            let slope = gradient.length().clamp(FLATTEST, 1.0);
            p += gradient.normalize_or(root.normal) * ((least - distance) / slope);
        }
        p
    }
}
