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

/// Length (m) of the pieces in which the line between two points of a hair is looked at, where it could be in the body. Chosen: half
/// of the thickness of an ear.
const PIECE: f64 = 2e-3;

/// Depth (m) of such a line that is left as it is, and its height once it is lifted. Chosen: below what is reported as hair in the
/// head; most hairs have no such line.
const LEFT: f64 = 2e-4;
const LIFTED: f64 = 2e-4;

/// How often the lines of a hair are lifted at most, and how far (m) at a time. Chosen by trial: around an ear ten are enough.
const LIFTS: usize = 24;
const LARGEST_LIFT: f64 = 3e-3;

/// Where (shares of it) a line of some length (m) between two points of a hair is looked at, which begins at `arc` (m): not where the hair
/// leaves its follicle.
pub(super) fn looked_at(length: f64, arc: f64) -> impl Iterator<Item = f64> {
    let pieces = (length / PIECE).ceil();
    let shares = (1..pieces as usize).map(move |k| k as f64 / pieces);
    shares.filter(move |share| arc + share * length >= PIECE)
}

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

    /// Lifts the lines between the points of a hair out of the body, where they cut an edge of it: both of its ends, as far as it is deep.
    /// Points that are out already may be on two sides of an ear: then it may end in vain, with the first line that still cuts.
    pub(super) fn lift_lines(&self, points: &mut [DVec3]) -> Option<usize> {
        if self.body == Body::None || points.len() < 2 {
            return None;
        }
        let mut left = None;
        let mut free = Free::NOWHERE;
        // The least that points are out by: no point of a line is lower than half of what its ends have more than it is long.
        let mut heights: Vec<f64> = points.iter().map(|&p| self.height(p, &mut free)).collect();
        for _ in 0..LIFTS {
            let mut cut = None;
            let mut arc = 0.0;
            for k in 0..points.len() - 1 {
                let length = points[k].distance(points[k + 1]);
                let lowest = (0.5 * (heights[k] + heights[k + 1] - length)).min(heights[k + 1]);
                if lowest < -LEFT
                    && let Some((share, depth, out)) = self.deepest(points[k], points[k + 1], arc)
                {
                    // Least squares: the line rises by `lift` there. The root stays.
                    let (a, b) = (if k == 0 { 0.0 } else { 1.0 - share }, share);
                    let lift = (depth + LIFTED).min(LARGEST_LIFT) / (a * a + b * b).max(0.25);
                    points[k] += out * (a * lift);
                    points[k + 1] += out * (b * lift);
                    for end in [k, k + 1] {
                        heights[end] = self.head.signed_distance().value(points[end]);
                    }
                    cut = cut.or(Some(k));
                }
                arc += length;
            }
            left = cut;
            if cut.is_none() {
                break;
            }
        }
        left
    }

    /// How far (m) a point is out of the body at least.
    fn height(&self, p: DVec3, free: &mut Free) -> f64 {
        if free.holds(p) {
            return free.radius - p.distance(free.centre);
        }
        let height = self.head.signed_distance().value(p);
        *free = Free { centre: p, radius: height };
        height
    }

    /// Where the line between two points (m), from `arc` (m) on, is deepest in the body, if that is more than is left there: its share
    /// of the line, its depth (m), and the way out (unit).
    fn deepest(&self, from: DVec3, to: DVec3, arc: f64) -> Option<(f64, f64, DVec3)> {
        let mut deepest = None;
        let mut depth = LEFT;
        // A lift of a line may have moved its end into another side of an ear.
        let length = from.distance(to);
        let end = (arc + length >= PIECE).then_some(1.0);
        for share in looked_at(length, arc).chain(end) {
            let (height, out) = self.head.signed_distance().value_gradient(from.lerp(to, share));
            if -height > depth {
                depth = -height;
                deepest = Some((share, depth, out.normalize_or_zero()));
            }
        }
        deepest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_cut_an_ear_are_lifted_out_of_it() {
        let head = crate::head::test_shapes::mannequin();
        let skin = Skin { head, body: Body::SignedDistance, widest: 1e-3 };
        let field = head.signed_distance();
        let out = |p: DVec3| {
            let mut p = p;
            for _ in 0..40 {
                let (distance, gradient) = field.value_gradient(p);
                if distance >= 4e-4 {
                    break;
                }
                p += gradient.normalize_or_zero() * (5e-4 - distance);
            }
            p
        };
        let depth = |points: &[DVec3]| {
            let lines = points
                .windows(2)
                .flat_map(|p| (0..20).map(|k| p[0].lerp(p[1], f64::from(k) / 20.0)));
            lines.map(|p| -field.value(p)).fold(0.0, f64::max)
        };
        let (mut cut, mut left) = (0, 0);
        // Hair that comes down before, through and behind the ear, its points out of the head; where they are close, one side of the ear
        // is lifted into the other.
        for (apart, x, k) in [0.012, 0.008, 0.0055]
            .into_iter()
            .flat_map(|apart| [0.068, 0.071, 0.074].map(|x| (apart, x)))
            .flat_map(|(apart, x)| (0..40).map(move |k| (apart, x, f64::from(k))))
        {
            let count = (0.1 / apart) as usize;
            let mut points: Vec<DVec3> = (0..count)
                .map(|i| out(DVec3::new(x, -0.03 + 0.0015 * k, 0.05 - apart * i as f64)))
                .collect();
            if depth(&points) <= 5e-4 {
                continue;
            }
            cut += 1;
            match skin.lift_lines(&mut points) {
                None => assert!(depth(&points) < 3e-4, "{apart} {x} {k}: {}", depth(&points)),
                Some(line) => {
                    left += 1;
                    assert!(line < count - 1);
                }
            }
        }
        assert!(cut >= 4 && 2 * left <= cut, "{left} of {cut}");
    }
}
