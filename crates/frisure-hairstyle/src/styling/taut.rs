//! The shortest way around a head: how much hair it takes from a root to a point when it is drawn tight.

use glam::DVec3;

use crate::head::Head;

/// Points of the way. Chosen: some 8 mm apart on the longest ways.
const POINTS: usize = 33;

/// Relaxations of the way; each takes out a part of its kinks. Chosen: the length changes by less than a tenth of a per cent
/// with twice as many.
const RELAXATIONS: usize = 400;

/// Height (m) over the skin at which the way starts before it is drawn tight. Chosen: above ears.
const START: f64 = 0.03;

/// Length (m) of the shortest way from a root to a point (both m, in the head's frame) that stays `clearance` (m) off the skin.
pub(super) fn taut_length(head: &Head, root: DVec3, to: DVec3, clearance: f64) -> f64 {
    let centre = head.landmarks().cranium_centre;
    let (from_way, to_way) = (root - centre, to - centre);
    // 1. An arc over the head, about the middle of the cranium.
    let mut way: Vec<DVec3> = (0..POINTS)
        .map(|k| {
            let x = k as f64 / (POINTS - 1) as f64;
            let arc = 4.0 * x * (1.0 - x);
            let direction = from_way.lerp(to_way, x).normalize_or(DVec3::Z);
            let reach = from_way.length() + (to_way.length() - from_way.length()) * x;
            centre + direction * (reach + START * arc)
        })
        .collect();
    (way[0], way[POINTS - 1]) = (root, to);
    // 2. An elastic band: every point to the middle of its neighbours, and out of the skin again.
    let skin = head.signed_distance();
    for _ in 0..RELAXATIONS {
        for k in 1..POINTS - 1 {
            let p = 0.5 * (way[k - 1] + way[k + 1]);
            let (distance, gradient) = skin.value_gradient(p);
            let out = (clearance - distance).max(0.0);
            way[k] = p + gradient.normalize_or_zero() * out;
        }
    }
    way.windows(2).map(|ends| ends[0].distance(ends[1])).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_around_the_cranium_is_about_as_long_as_the_arc() {
        let head = Head::mannequin();
        let land = head.landmarks();
        // From one side over the vertex to the other: half an ellipse of the cranium's width and height.
        let side = |x: f64| land.cranium_centre + DVec3::new(x * land.cranium_radii.x, 0.0, 0.0);
        let found = taut_length(&head, side(1.0), side(-1.0), 0.0);
        let (a, b) = (land.cranium_radii.x, land.cranium_radii.z);
        let h = ((a - b) / (a + b)).powi(2);
        // Ramanujan's approximation of half the perimeter.
        let half = 0.5
            * std::f64::consts::PI
            * (a + b)
            * (1.0 + 3.0 * h / (10.0 + (4.0 - 3.0 * h).sqrt()));
        assert!((found / half - 1.0).abs() < 0.08, "{found} {half}");
    }

    #[test]
    fn a_way_off_the_head_is_straight() {
        let head = Head::mannequin();
        let from = head.landmarks().whorl * 1.2;
        let to = from + DVec3::new(0.0, 0.05, 0.08);
        assert!((taut_length(&head, from, to, 0.0) - from.distance(to)).abs() < 1e-6);
    }
}
