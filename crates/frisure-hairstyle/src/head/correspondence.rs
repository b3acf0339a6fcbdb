//! Which places of two heads are the same.

use glam::{DMat3, DVec3};

use super::texture::Texture;
use super::{Head, Landmarks};

/// A point of the skin of the other head.
pub(crate) struct Corresponding {
    /// Where it is (m).
    pub(crate) position: DVec3,
    /// Outward unit normal of the skin there.
    pub(crate) normal: DVec3,
    /// The rotation from the skin about the point of the first head to that about this one.
    pub(crate) turn: DMat3,
}

/// Where points of the skin of one head are on another.
///
/// Places are taken relative to the cranium, in its radii. What the landmarks then still differ by is taken out between them by
/// inverse distances (Shepard 1968, doi:10.1145/800186.810616), and the nearest point of the other skin is the place.
pub(crate) struct Correspondence<'a> {
    from: &'a Landmarks,
    to: &'a Head,
    /// The skin of the first head, and of the other.
    skins: [Texture; 2],
    /// Landmarks of the first head in the cranium's radii, and how far the other's are from them.
    moved: Vec<(DVec3, DVec3)>,
}

/// Distance, in the cranium's radii, within which a landmark takes all along with it. Chosen: a centimetre.
const NEAR: f64 = 0.1;

/// Step (m) of the differences that tell how the skin is turned. Chosen: less than the skin bends over, far above rounding.
const STEP: f64 = 1e-3;

impl<'a> Correspondence<'a> {
    pub(crate) fn new(from: &'a Head, to: &'a Head) -> Self {
        let skins = [from, to].map(Texture::new);
        let (from, other) = (from.landmarks(), to.landmarks());
        let moved = marks(from).into_iter().zip(marks(other)).map(|(a, b)| (a, b - a)).collect();
        Self { from, to, skins, moved }
    }

    /// The point that corresponds to `p` (m) at the skin of the first head, where that has the unit normal `normal`; it is as far
    /// from the other skin as `p` is from that.
    pub(crate) fn at(&self, p: DVec3, normal: DVec3) -> Corresponding {
        let [skin, other_skin] = &self.skins;
        let there = self.warped(p);
        let foot = other_skin.foot(there);
        let other = self.to.signed_distance().value_gradient(foot).1.normalize_or(normal);
        let position = foot + other * (p - skin.foot(p)).dot(normal);
        // Downwards, or where the skin is level to the front.
        let way = if normal.z.abs() < 0.8 { DVec3::NEG_Z } else { DVec3::NEG_Y };
        let along = across(way, normal).normalize_or(normal.any_orthonormal_vector());
        let moved = self.warped(p + STEP * along) - there;
        let after = across(moved, other).normalize_or(other.any_orthonormal_vector());
        let frame = |normal: DVec3, along| DMat3::from_cols(along, normal.cross(along), normal);
        let turn = frame(other, after) * frame(normal, along).transpose();
        Corresponding { position, normal: other, turn }
    }

    /// The place about the other head (m), on or near its skin.
    fn warped(&self, p: DVec3) -> DVec3 {
        let q = self.from.normalized(p);
        let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
        for (mark, moved) in &self.moved {
            let weight = (mark.distance_squared(q) + NEAR * NEAR).powi(-2);
            sum += weight * *moved;
            weights += weight;
        }
        let other = self.to.landmarks();
        other.cranium_centre + (q + sum / weights) * other.cranium_radii
    }
}

/// The part of a vector at right angles to a unit vector.
fn across(v: DVec3, normal: DVec3) -> DVec3 {
    v - normal * normal.dot(v)
}

/// The landmarks that hair is told by, and the ends of the cranium's axes, in its radii.
fn marks(of: &Landmarks) -> Vec<DVec3> {
    let mirrored = DVec3::new(2.0 * of.cranium_centre.x - of.ear.x, of.ear.y, of.ear.z);
    let places = [of.whorl, of.hairline, of.brow, of.ear, mirrored, of.nape];
    let ends = [DVec3::X, DVec3::NEG_X, DVec3::Y, DVec3::Z];
    places.into_iter().map(|p| of.normalized(p)).chain(ends).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::test_shapes::mannequin;

    fn skin(head: &Head) -> Vec<(DVec3, DVec3)> {
        let surface = head.surface();
        let normals = surface.vertex_normals();
        let grows = |v: &usize| head.scalp()[*v] > 0.5;
        let place = |v: usize| (surface.positions()[v], normals[v]);
        (0..normals.len()).filter(grows).step_by(97).map(place).collect()
    }

    #[test]
    fn a_head_corresponds_to_itself() {
        let head = mannequin();
        let same = Correspondence::new(head, head);
        for (p, normal) in skin(head) {
            let there = same.at(p, normal);
            assert!(there.position.distance(p) < 1e-9);
            assert!((there.turn * normal).distance(there.normal) < 1e-9);
            assert!((there.turn.determinant() - 1.0).abs() < 1e-9);
            // The normals are those of the mesh and of the distance field.
            let turn = there.turn;
            let angle =
                turn.x_axis.angle_between(DVec3::X).max(turn.z_axis.angle_between(DVec3::Z));
            assert!(angle < 0.35, "{angle} at {p}");
        }
    }

    #[test]
    fn regions_and_sides_of_people_correspond() {
        let head = mannequin();
        let person = Head::named("european-woman").unwrap();
        let map = Correspondence::new(head, &person);
        let (marks, others) = (head.landmarks(), person.landmarks());
        let skin = skin(head);
        let mut elsewhere = 0;
        for (p, normal) in &skin {
            let there = map.at(*p, *normal);
            assert!(person.signed_distance().value(there.position).abs() < 1.5e-3);
            let inside = map.at(*p - 3e-4 * *normal, *normal).position;
            assert!((inside.distance(there.position) - 3e-4).abs() < 1e-4);
            assert!(there.normal.dot(there.turn * *normal) > 1.0 - 1e-9);
            let side = marks.azimuth(*p).sin();
            assert!(side.abs() < 0.2 || side * others.azimuth(there.position).sin() > 0.0);
            elsewhere += usize::from(marks.region(*p) != others.region(there.position));
        }
        // At the borders of regions.
        assert!(elsewhere * 8 < skin.len(), "{elsewhere} of {}", skin.len());
    }
}
