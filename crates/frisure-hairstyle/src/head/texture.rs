//! Texture coordinates of the skin, and those of points on it.

use std::f64::consts::PI;

use frisure_strands::Surface;
use glam::{DVec2, DVec3};

use super::Head;
use super::landmarks::Landmarks;
use super::triangles::closest_point;

/// How far (of 1) faces where no hair grows are moved along u, out of the square of the scalp.
const ASIDE: f32 = 1.0;

/// Faces of a leaf of the search. Chosen for speed; no result depends on it.
const LEAF: usize = 8;

/// The skin with texture coordinates and the search of the face beneath a point.
pub(crate) struct Texture {
    surface: Surface,
    faces: Vec<u32>,
    nodes: Vec<Node>,
}

/// A box around a range of faces (m). Its first child is the next node.
struct Node {
    low: DVec3,
    high: DVec3,
    faces: std::ops::Range<usize>,
    second: Option<usize>,
}

impl Texture {
    pub(crate) fn new(head: &Head) -> Self {
        let surface = textured(head);
        let mut faces: Vec<Boxed> = (0..surface.triangles().len())
            .map(|face| {
                let corners = surface.corners(face);
                let low = corners[0].min(corners[1]).min(corners[2]);
                let high = corners[0].max(corners[1]).max(corners[2]);
                Boxed { face: face as u32, low, high, middle: corners.iter().sum() }
            })
            .collect();
        let mut nodes = Vec::new();
        let all = 0..faces.len();
        split(&mut faces, all, &mut nodes);
        Self { surface, faces: faces.into_iter().map(|boxed| boxed.face).collect(), nodes }
    }

    /// The texture coordinates of the point of the skin that is nearest to `p` (m), interpolated in its face.
    pub(crate) fn at(&self, p: DVec3) -> [f32; 2] {
        let (face, foot) = self.nearest(p);
        let [a, b, c] = self.surface.corners(face);
        let weights = barycentric(foot, [a, b, c]);
        let corners = self.surface.texture()[face];
        [0, 1].map(|k| (0..3).map(|i| weights[i] * f64::from(corners[i][k])).sum::<f64>() as f32)
    }

    /// The point of the skin (m) that is nearest to `p` (m).
    pub(crate) fn foot(&self, p: DVec3) -> DVec3 {
        self.nearest(p).1
    }

    /// The face nearest to `p`, of faces equally near the first, and its nearest point.
    fn nearest(&self, p: DVec3) -> (usize, DVec3) {
        let (mut best, mut found, mut foot) = (f64::INFINITY, 0, p);
        let away = |index: usize| {
            let node = &self.nodes[index];
            (p.clamp(node.low, node.high).distance_squared(p), index)
        };
        let mut open = vec![away(0)];
        while let Some((distance, index)) = open.pop() {
            if distance > best {
                continue;
            }
            let node = &self.nodes[index];
            if let Some(second) = node.second {
                // The nearer child first: its faces shorten the search of the other.
                let (a, b) = (away(index + 1), away(second));
                open.extend(if a.0 <= b.0 { [b, a] } else { [a, b] });
                continue;
            }
            for &face in &self.faces[node.faces.clone()] {
                let face = face as usize;
                let point = closest_point(p, self.surface.corners(face));
                let gap = point.distance_squared(p);
                if gap < best || (gap == best && face < found) {
                    (best, found, foot) = (gap, face, point);
                }
            }
        }
        (found, foot)
    }
}

/// A face with the box around it (m), and three times its middle.
struct Boxed {
    face: u32,
    low: DVec3,
    high: DVec3,
    middle: DVec3,
}

/// Adds the nodes of a range of faces, which it puts in order.
fn split(faces: &mut [Boxed], range: std::ops::Range<usize>, nodes: &mut Vec<Node>) {
    let own = &mut faces[range.clone()];
    let low = own.iter().map(|boxed| boxed.low).fold(DVec3::INFINITY, DVec3::min);
    let high = own.iter().map(|boxed| boxed.high).fold(DVec3::NEG_INFINITY, DVec3::max);
    let index = nodes.len();
    nodes.push(Node { low, high, faces: range.clone(), second: None });
    if own.len() <= LEAF {
        return;
    }
    let size = high - low;
    let axis = (0..3).max_by(|a, b| size[*a].total_cmp(&size[*b])).unwrap_or(0);
    // Halves by the middle: in which order faces are within them is of no account.
    let half = own.len() / 2;
    own.select_nth_unstable_by(half, |a, b| {
        a.middle[axis].total_cmp(&b.middle[axis]).then(a.face.cmp(&b.face))
    });
    let half = range.start + half;
    split(faces, range.start..half, nodes);
    nodes[index].second = Some(nodes.len());
    split(faces, half..range.end, nodes);
}

/// Weights of the corners at a point of a triangle. \[Ericson\] §3.4
fn barycentric(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d00, d01, d11) = (ab.dot(ab), ab.dot(ac), ac.dot(ac));
    let (d20, d21) = (ap.dot(ab), ap.dot(ac));
    let area = d00 * d11 - d01 * d01;
    if area <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let v = (d11 * d20 - d01 * d21) / area;
    let w = (d00 * d21 - d01 * d20) / area;
    [1.0 - v - w, v, w]
}

/// The skin with texture coordinates: its own, or else a map of the head.
///
/// The map is drawn from above the cranium (azimuthal equidistant): (½, ½) is above its middle, u grows to the
/// head's left, v to the back, and the distance from the middle is the angle from the vertical over 2π. Faces
/// where no hair grows have the same map one further along u, from 1 to 2, so that ears and face do not cover the
/// scalp; so have faces that the map flips.
#[must_use]
pub fn textured(head: &Head) -> Surface {
    let surface = head.surface().clone();
    if !surface.texture().is_empty() {
        return surface;
    }
    let marks = head.landmarks();
    let at: Vec<[f32; 2]> = surface.positions().iter().map(|p| map(marks, *p)).collect();
    let corners = |triangle: &[u32; 3]| {
        let corners = triangle.map(|v| at[v as usize]);
        let grows = triangle.iter().any(|v| head.scalp()[*v as usize] > 0.0);
        let [a, b, c] = corners.map(|uv| DVec2::new(uv[0].into(), uv[1].into()));
        let aside = !grows || (b - a).perp_dot(c - a) <= 0.0;
        corners.map(|[u, v]| [if aside { u + ASIDE } else { u }, v])
    };
    let texture = surface.triangles().iter().map(corners).collect();
    surface.with_texture(texture).expect("one for each face, and angles are finite")
}

/// Where on the map of [`textured`] a point is.
fn map(marks: &Landmarks, p: DVec3) -> [f32; 2] {
    let d = marks.normalized(p).normalize_or(DVec3::Z);
    let around = d.x.hypot(d.y);
    let radius = 0.5 * around.atan2(d.z) / PI;
    let (x, y) = if around > 0.0 { (d.x / around, d.y / around) } else { (0.0, 0.0) };
    [(0.5 + radius * x) as f32, (0.5 + radius * y) as f32]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::mannequin;

    #[test]
    fn the_map_has_its_directions() {
        let marks = mannequin().landmarks();
        let at = |d: DVec3| map(marks, marks.cranium_centre + d * marks.cranium_radii);
        assert_eq!(at(DVec3::Z), [0.5, 0.5]);
        assert_eq!(at(DVec3::X), [0.75, 0.5]);
        assert_eq!(at(DVec3::Y), [0.5, 0.75]);
    }

    #[test]
    fn the_face_found_is_the_nearest_of_all() {
        let texture = Texture::new(mannequin());
        let surface = &texture.surface;
        for i in 0..40 {
            let a = f64::from(i);
            let p = DVec3::new(a.sin(), (1.7 * a).cos(), (0.3 * a).sin()) * (0.004 * a);
            let gap = |face| closest_point(p, surface.corners(face)).distance(p);
            let least = (0..surface.triangles().len()).map(gap).fold(f64::INFINITY, f64::min);
            assert_eq!(texture.nearest(p).1.distance(p), least);
        }
    }

    #[test]
    fn a_mesh_keeps_its_own_texture_coordinates() {
        let own = vec![[[0.25, 0.5]; 3]; mannequin().surface().triangles().len()];
        let mut head = mannequin().clone();
        head.surface = head.surface.with_texture(own.clone()).unwrap();
        assert_eq!(textured(&head).texture(), own);
        assert_eq!(Texture::new(&head).at(DVec3::Z), [0.25, 0.5]);
    }

    #[test]
    fn a_point_between_the_corners_has_its_weights() {
        let corners =
            [DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 5.0)];
        let weights = [0.2, 0.5, 0.3];
        let p = (0..3).map(|i| corners[i] * weights[i]).sum();
        let found = barycentric(p, corners);
        assert!((0..3).all(|i| (found[i] - weights[i]).abs() < 1e-12), "{found:?}");
    }
}
