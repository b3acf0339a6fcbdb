//! Places on the skin as a person measures them with a tape: back over the head, then across.

use glam::DVec3;

use crate::head::Head;

/// Step (m) of the walk along the skin. Chosen: less than the spacing of the distance grid.
const STEP: f64 = 2e-3;

/// Length of the tape (m) back from the forehead's hairline, and down over the forehead.
/// Chosen: to the neck, and to the brows, of a large head.
const REACH: (f64, f64) = (0.5, 0.08);

/// A tape along the middle of the head, from the forehead's hairline back to the neck.
pub(crate) struct Tape<'a> {
    head: &'a Head,
    /// Points of the middle line, a step apart, forwards from the hairline …
    forwards: Vec<DVec3>,
    /// … and backwards.
    backwards: Vec<DVec3>,
}

impl<'a> Tape<'a> {
    pub(crate) fn new(head: &'a Head) -> Self {
        let start = onto_skin(head, head.landmarks().hairline, DVec3::X);
        let walk = |sign: f64, reach: f64| {
            let steps = (reach / STEP) as usize;
            let points = std::iter::successors(Some(start), |&p| {
                Some(onto_skin(head, p + forth(head, p, DVec3::X) * (sign * STEP), DVec3::X))
            });
            points.take(steps + 1).collect()
        };
        Self { head, backwards: walk(1.0, REACH.0), forwards: walk(-1.0, REACH.1) }
    }

    /// The skin `back` (m) behind the forehead's hairline along the middle, and from there `across`
    /// (m) to the head's left.
    pub(crate) fn at(&self, [across, back]: [f64; 2]) -> DVec3 {
        let line = if back < 0.0 { &self.forwards } else { &self.backwards };
        let place = (back.abs() / STEP).min((line.len() - 1) as f64);
        let i = (place as usize).min(line.len() - 2);
        let middle = line[i].lerp(line[i + 1], place - i as f64);
        self.sideways(middle, across)
    }

    /// How far back (m) along the middle the point nearest to `p` (m) is.
    pub(crate) fn back_of(&self, p: DVec3) -> f64 {
        let nearest = |a: &(usize, &DVec3), b: &(usize, &DVec3)| {
            a.1.distance_squared(p).total_cmp(&b.1.distance_squared(p))
        };
        let found = self.backwards.iter().enumerate().min_by(nearest);
        found.map_or(0.0, |(i, _)| i as f64 * STEP)
    }

    /// The point a length (m) to the left of a point of the middle line, in the plane across the line.
    fn sideways(&self, middle: DVec3, across: f64) -> DVec3 {
        let axis = forth(self.head, middle, DVec3::X);
        let mut p = onto_skin(self.head, middle, axis);
        let mut left = across.abs();
        while left > 0.0 {
            let step = left.min(STEP) * across.signum();
            p = onto_skin(self.head, p - forth(self.head, p, axis) * step, axis);
            left -= STEP;
        }
        p
    }
}

/// The direction (unit) along the skin in the plane at right angles to `axis`: backwards for +x.
fn forth(head: &Head, p: DVec3, axis: DVec3) -> DVec3 {
    let (_, away) = head.signed_distance().value_gradient(p);
    let in_plane = (away - axis * away.dot(axis)).normalize_or(DVec3::Z);
    in_plane.cross(axis)
}

/// The skin nearest to a point, in the plane through it at right angles to `axis`.
fn onto_skin(head: &Head, p: DVec3, axis: DVec3) -> DVec3 {
    let mut p = p;
    // Newton's method on the distance along its own gradient, four steps (chosen).
    for _ in 0..4 {
        let (distance, away) = head.signed_distance().value_gradient(p);
        p -= (away - axis * away.dot(axis)) * distance;
    }
    p
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::mannequin;

    #[test]
    fn a_tape_measures_along_the_skin() {
        let head = mannequin();
        let tape = Tape::new(head);
        let (mut length, mut last) = (0.0, tape.at([0.0, 0.0]));
        for i in 1..=50 {
            let p = tape.at([0.0, 0.004 * f64::from(i)]);
            assert!(head.signed_distance().value(p).abs() < 2e-4, "{p}");
            assert!(p.x.abs() < 1e-9);
            length += p.distance(last);
            last = p;
        }
        assert!((length / 0.2 - 1.0).abs() < 0.02, "{length}");
        // Left is +x, and back is behind.
        let p = tape.at([0.05, 0.08]);
        assert!(p.x > 0.04 && head.signed_distance().value(p).abs() < 2e-4, "{p}");
        assert!((tape.at([-0.05, 0.08]).x + p.x).abs() < 2e-3);
        assert!(tape.at([0.0, -0.03]).z < tape.at([0.0, 0.0]).z);
        let whorl = head.landmarks().whorl;
        assert!(tape.at([0.0, tape.back_of(whorl)]).distance(whorl) < 5e-3);
    }
}
