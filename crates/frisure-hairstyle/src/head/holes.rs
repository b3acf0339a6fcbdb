//! Where a mesh is open that ought to be closed: holes in the scalp, and a scalp that is not on the head.

use std::collections::BTreeMap;

use frisure_strands::Surface;
use glam::DVec3;

use super::seams::{Sets, joined};

/// Least length of the open edges of a hole (m) that is told: hair covers what is smaller. Chosen.
const LEAST: f64 = 0.02;

/// Farthest that the scalp may be from the rest of the head (m), where it is a mesh of its own. A cap with room for hair below it
/// lies a few millimetres off. Chosen.
const FARTHEST: f64 = 0.02;

/// Vertices of a scalp whose distance to the head is measured. Chosen; their median is enough.
const SAMPLES: usize = 64;

/// Holes where hair grows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScalpHoles {
    /// Number of holes whose open edges are 2 cm long or longer.
    pub count: usize,
    /// Length of the open edges of the largest (m).
    pub around: f64,
    /// Middle of the open edges of the largest (m).
    pub place: DVec3,
}

/// The holes of a mesh where hair grows; `None` without any. An edge of the scalp is open that belongs to one face only.
pub(super) fn scalp_holes(surface: &Surface, scalp: &[f64]) -> Option<ScalpHoles> {
    let places = surface.positions();
    let same = joined(places);
    let mut faces_of: BTreeMap<[u32; 2], u32> = BTreeMap::new();
    let edges = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|v| same[v as usize]);
        [[a, b], [b, c], [c, a]].map(|[a, b]| [a.min(b), a.max(b)])
    };
    for triangle in surface.triangles() {
        edges(triangle).into_iter().for_each(|edge| *faces_of.entry(edge).or_default() += 1);
    }
    let grows: Vec<bool> = {
        let mut grows = vec![false; places.len()];
        scalp.iter().zip(&same).for_each(|(w, &v)| grows[v as usize] |= *w > 0.5);
        grows
    };
    let open: Vec<[u32; 2]> = faces_of
        .into_iter()
        .filter(|&([a, b], faces)| faces == 1 && a != b && grows[a as usize] && grows[b as usize])
        .map(|(edge, _)| edge)
        .collect();
    // Open edges that meet are those of one hole.
    let mut hole = Sets::new(places.len());
    open.iter().for_each(|[a, b]| hole.join(*a, *b));
    let mut holes: BTreeMap<u32, (f64, DVec3)> = BTreeMap::new();
    for [a, b] in open {
        let (p, q) = (places[a as usize], places[b as usize]);
        let (length, sum) = holes.entry(hole.of(a)).or_default();
        *length += p.distance(q);
        *sum += p.distance(q) * 0.5 * (p + q);
    }
    let mut large: Vec<(f64, DVec3)> = holes.into_values().filter(|h| h.0 >= LEAST).collect();
    large.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.x.total_cmp(&b.1.x)));
    let &(around, sum) = large.first()?;
    Some(ScalpHoles { count: large.len(), around, place: sum / around })
}

/// How far the scalp is from the head (m), where it is a mesh of its own that is farther than a cap would be: no part of the mesh has
/// both faces with hair and faces without.
pub(super) fn floating_scalp(surface: &Surface, scalp: &[f64]) -> Option<f64> {
    let (places, triangles) = (surface.positions(), surface.triangles());
    let same = joined(places);
    let mut parts = Sets::new(places.len());
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| same[v as usize]);
        parts.join(a, b);
        parts.join(b, c);
    }
    let grows = |face: usize| triangles[face].iter().any(|&v| scalp[v as usize] > 0.0);
    let mut with_hair: BTreeMap<u32, [bool; 2]> = BTreeMap::new();
    for face in 0..triangles.len() {
        let part = parts.of(same[triangles[face][0] as usize]);
        with_hair.entry(part).or_default()[usize::from(grows(face))] = true;
    }
    if with_hair.values().any(|&has| has == [true, true]) {
        return None;
    }
    let (mut skin, mut cap) = (Vec::new(), Vec::new());
    for face in 0..triangles.len() {
        let corners = surface.corners(face);
        if grows(face) { cap.push(corners[0]) } else { skin.push(corners) }
    }
    let step = cap.len().div_ceil(SAMPLES).max(1);
    let mut distances: Vec<f64> = cap
        .iter()
        .step_by(step)
        .map(|p| skin.iter().map(|corners| to_triangle(*p, corners)).fold(f64::INFINITY, f64::min))
        .collect();
    distances.sort_by(f64::total_cmp);
    let median = *distances.get(distances.len() / 2)?;
    (median.is_finite() && median > FARTHEST).then_some(median)
}

/// Distance of a point from a triangle (m): that of its plane where the foot is inside, else that of the nearest side.
fn to_triangle(p: DVec3, [a, b, c]: &[DVec3; 3]) -> f64 {
    let side = |from: DVec3, to: DVec3| {
        let way = to - from;
        let t = ((p - from).dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        p.distance(from + t * way)
    };
    let sides = side(*a, *b).min(side(*b, *c)).min(side(*c, *a));
    let normal = (*b - *a).cross(*c - *a).normalize_or_zero();
    let inside = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|(from, to)| (**to - **from).cross(p - **from).dot(normal) >= 0.0);
    if inside && normal != DVec3::ZERO { (p - *a).dot(normal).abs() } else { sides }
}

#[cfg(test)]
mod tests {
    use super::super::test_shapes::ball;
    use super::*;

    /// A ball of 20 cm without the faces that a test names by their middles.
    fn without(removed: impl Fn(DVec3) -> bool) -> Surface {
        let ball = ball(0.1, 48);
        let middle = |face: usize| ball.corners(face).into_iter().sum::<DVec3>() / 3.0;
        let kept = (0..ball.triangles().len()).filter(|face| !removed(middle(*face)));
        let triangles = kept.map(|face| ball.triangles()[face]).collect();
        Surface::new(ball.positions().to_vec(), triangles).expect("a surface")
    }

    /// Hair on the upper half.
    fn upper(surface: &Surface) -> Vec<f64> {
        surface.positions().iter().map(|p| f64::from(u8::from(p.z > 0.0))).collect()
    }

    #[test]
    fn a_closed_head_and_one_that_is_open_at_the_neck_have_no_holes() {
        for surface in [without(|_| false), without(|p| p.z < -0.08)] {
            assert_eq!(scalp_holes(&surface, &upper(&surface)), None);
        }
    }

    #[test]
    fn a_hole_on_the_crown_is_found() {
        let surface = without(|p| p.z > 0.095);
        let hole = scalp_holes(&surface, &upper(&surface)).expect("a hole");
        // A circle at this height of a ball of 10 cm.
        let around = 2.0 * std::f64::consts::PI * (0.01_f64 - 0.095_f64.powi(2)).sqrt();
        assert_eq!(hole.count, 1);
        assert!((hole.around / around - 1.0).abs() < 0.2, "{hole:?} {around}");
        assert!(hole.place.distance(DVec3::new(0.0, 0.0, 0.095)) < 5e-3, "{hole:?}");
        // Two of them.
        let two = without(|p| p.z > 0.095 || p.y > 0.09 && p.z > 0.02);
        assert_eq!(scalp_holes(&two, &upper(&two)).map(|h| h.count), Some(2));
    }

    #[test]
    fn seams_are_no_holes() {
        let ball = ball(0.1, 24);
        // Each face has vertices of its own.
        let places: Vec<DVec3> =
            (0..ball.triangles().len()).flat_map(|face| ball.corners(face)).collect();
        let triangles = (0..places.len() as u32 / 3).map(|f| [3 * f, 3 * f + 1, 3 * f + 2]);
        let surface = Surface::new(places, triangles.collect()).expect("a surface");
        assert_eq!(scalp_holes(&surface, &upper(&surface)), None);
    }

    #[test]
    fn a_scalp_in_the_air_is_found_and_a_cap_is_not() {
        let ball = ball(0.1, 24);
        let with_cap = |above: f64| {
            let count = ball.positions().len() as u32;
            let mut places = ball.positions().to_vec();
            let mut triangles = ball.triangles().to_vec();
            let mut scalp = vec![0.0; places.len()];
            for face in 0..ball.triangles().len() {
                let corners = ball.corners(face);
                if corners.iter().all(|p| p.z > 0.05) {
                    let first = places.len() as u32;
                    places.extend(corners.map(|p| p * (1.0 + above / 0.1)));
                    triangles.push([first, first + 1, first + 2]);
                }
            }
            scalp.resize(places.len(), 1.0);
            assert!(places.len() as u32 > count);
            (Surface::new(places, triangles).expect("a surface"), scalp)
        };
        let (near, scalp) = with_cap(0.003);
        assert_eq!(floating_scalp(&near, &scalp), None);
        let (far, scalp) = with_cap(0.15);
        let distance = floating_scalp(&far, &scalp).expect("a distance");
        assert!((distance - 0.15).abs() < 2e-3, "{distance}");
        assert_eq!(floating_scalp(&ball, &upper(&ball)), None);
    }
}
