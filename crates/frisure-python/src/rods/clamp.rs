//! How the frame of a clamp turns with the tangent and the d1 that it was made of.

use glam::DVec3;

/// The tangents and the d1 of rods as they were given, neither normalised nor at right angles: each has one row for all rods, or one for each.
pub(crate) struct Clamps {
    pub(super) tangent: Vec<DVec3>,
    pub(super) d1: Vec<DVec3>,
}

/// The clamp of one rod.
pub(super) struct Clamp {
    /// Length and direction of the tangent.
    size: f64,
    tangent: DVec3,
    /// Parts of the given d1 along the tangent and across.
    along: f64,
    width: f64,
    /// The axes d1 and d2 of the frame.
    d1: DVec3,
    d2: DVec3,
}

impl Clamps {
    pub(super) fn of(&self, rod: usize) -> Clamp {
        let at = |rows: &[DVec3]| if rows.len() == 1 { rows[0] } else { rows[rod] };
        let (tangent, given) = (at(&self.tangent), at(&self.d1));
        let size = tangent.length();
        let tangent = tangent / size;
        let along = given.dot(tangent);
        let side = given - tangent * along;
        let width = side.length();
        let d1 = side / width;
        Clamp { size, tangent, along, width, d1, d2: tangent.cross(d1) }
    }
}

impl Clamp {
    /// The derivatives by the tangent and by d1 (loss per unit of what was given), from that by a rotation of the frame (loss per rad, world).
    pub(super) fn by_vectors(&self, by_rotation: DVec3) -> [DVec3; 2] {
        let [about_d1, about_d2, about_tangent] =
            [self.d1, self.d2, self.tangent].map(|axis| by_rotation.dot(axis));
        // The tangent turns the frame about d1 and d2; d1, and the tangent by what of it d1 has, about the tangent.
        let turned =
            self.d1 * about_d2 - self.d2 * (about_d1 + about_tangent * self.along / self.width);
        [turned / self.size, self.d2 * (about_tangent / self.width)]
    }

    /// The rotation of the frame (rad, world) by changes of the tangent and of d1: the transpose of [`Self::by_vectors`].
    pub(super) fn rotation(&self, tangent: DVec3, d1: DVec3) -> DVec3 {
        let change = tangent / self.size;
        let (first, second) = (change.dot(self.d1), change.dot(self.d2));
        let about = (d1.dot(self.d2) - self.along * second) / self.width;
        self.d2 * first - self.d1 * second + self.tangent * about
    }
}
