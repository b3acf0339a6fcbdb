//! Where held hair is: the guides near the place at which they are held.

use frisure_rod::Equilibrium;
use glam::DVec3;

use super::mesh::Axis;
use crate::head::Head;

/// Distance (m) of the points of a piece of a guide.
pub(super) const STEP: f64 = 1e-3;

/// A piece of a guide around the place at which it is held.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    /// Its wisp.
    pub(super) wisp: usize,
    /// Points (m) and unit tangents, [`STEP`] apart.
    points: Vec<(DVec3, DVec3)>,
    /// Index of the place at which the guide is held.
    held: usize,
    /// Radius (m) of the wisp there.
    pub(super) thickness: f64,
}

impl Piece {
    /// The piece of a guide from `before` (m) before the part `at` of its length to `after` (m) beyond, as far as there is hair.
    pub(super) fn new(
        wisp: usize,
        rest: &Equilibrium,
        at: f64,
        [before, after]: [f64; 2],
        thickness: f64,
    ) -> Self {
        let (length, chain) = (rest.rod.length(), rest.chain());
        let steps = |room: f64| (room.max(0.0) / STEP) as usize;
        let held = steps(before.min(at * length));
        let count = held + steps(after.min((1.0 - at) * length)) + 1;
        let point = |k: usize| {
            let s = at * length + (k as f64 - held as f64) * STEP;
            let (p, frame) = rest.at(&chain, (s / length).clamp(0.0, 1.0));
            (p, frame.z_axis)
        };
        Self { wisp, points: (0..count).map(point).collect(), held, thickness }
    }

    /// Point (m) and tangent (unit) so many steps beyond the held place, or at the end of the piece.
    pub(super) fn at(&self, steps: isize) -> (DVec3, DVec3) {
        let last = self.points.len() - 1;
        self.points[self.held.saturating_add_signed(steps).min(last)]
    }

    /// Where (m) the piece passes through the plane across an axis through its centre, the nearest to the axis; none if it does not.
    pub(super) fn through(&self, axis: &Axis) -> Option<DVec3> {
        let side = |p: DVec3| axis.split(p).0;
        let crossing = |pair: &[(DVec3, DVec3)]| {
            let (a, b) = (side(pair[0].0), side(pair[1].0));
            let crosses = (a <= 0.0) != (b <= 0.0);
            crosses.then(|| pair[0].0.lerp(pair[1].0, a / (a - b)))
        };
        let off = |p: &DVec3| axis.split(*p).1.length();
        let all = self.points.windows(2).filter_map(crossing);
        all.min_by(|p, q| off(p).total_cmp(&off(q)))
    }
}

/// The mean point (m) and the mean direction (unit) of pieces so many steps beyond their held places.
pub(super) fn mean(pieces: &[Piece], steps: isize) -> Axis {
    let places = pieces.iter().map(|piece| piece.at(steps));
    let (p, t) = places.fold((DVec3::ZERO, DVec3::ZERO), |(p, t), (q, u)| (p + q, t + u));
    Axis { centre: p / pieces.len() as f64, direction: t.normalize_or(DVec3::NEG_Z) }
}

/// The least distance (m) of the vertices of a mesh from the skin, negative inside.
pub(super) fn clearance(mesh: &frisure_strands::Surface, head: &Head) -> f64 {
    let skin = head.signed_distance();
    mesh.positions().iter().map(|p| skin.value(*p)).fold(f64::INFINITY, f64::min)
}
