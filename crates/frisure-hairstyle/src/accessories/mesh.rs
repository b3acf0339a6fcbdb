//! Closed triangle meshes: profiles turned about an axis, and bars along a path.

use std::f64::consts::TAU;

use frisure_strands::Surface;
use glam::DVec3;

/// Faces round an axis. Chosen: corners are not seen at a tenth of a head.
const AROUND: usize = 48;

/// Corners of the cross-section of a bar. Chosen.
const SECTION: usize = 12;

/// Rings of each rounded end of a bar. Chosen.
const END: usize = 3;

/// An axis: a point on it (m) and its direction (unit).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Axis {
    pub(super) centre: DVec3,
    pub(super) direction: DVec3,
}

impl Axis {
    /// How far along the axis a point is from the centre (m), and its offset from the axis (m).
    pub(super) fn split(&self, p: DVec3) -> (f64, DVec3) {
        let away = p - self.centre;
        let along = away.dot(self.direction);
        (along, away - along * self.direction)
    }
}

/// The surface that a closed profile sweeps about an axis: points (m) at a distance from the axis and along it, counter-clockwise with
/// the distance to the right and the axis upwards. None if it has no area.
pub(super) fn turned(axis: Axis, profile: &[[f64; 2]]) -> Option<Surface> {
    let (u, v) = across(axis.direction);
    let count = profile.len();
    let positions = (0..AROUND).flat_map(|j| {
        let (sine, cosine) = (TAU * j as f64 / AROUND as f64).sin_cos();
        let out = cosine * u + sine * v;
        profile.iter().map(move |[r, z]| axis.centre + *r * out + *z * axis.direction)
    });
    let at = |i: usize, j: usize| ((j % AROUND) * count + i % count) as u32;
    let quads = (0..AROUND).flat_map(|j| (0..count).map(move |i| (i, j)));
    let faces = quads.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        [[a, b, c], [a, c, d]]
    });
    Surface::new(positions.collect(), faces.collect()).ok()
}

/// Two directions (unit) across a direction (unit), right-handed with it.
fn across(direction: DVec3) -> (DVec3, DVec3) {
    let u = direction.any_orthonormal_vector();
    (u, direction.cross(u))
}

/// A bar with rounded ends along a path: points (m) with the direction (unit) that is up there; `half` has half of its width and half of
/// its height (m). None if it has no area.
pub(super) fn bar(path: &[(DVec3, DVec3)], half: [f64; 2]) -> Option<Surface> {
    let [width, height] = half;
    let last = path.len().checked_sub(2)? + 1;
    let tangent = |k: usize| {
        let (from, to) = (path[k.saturating_sub(1)].0, path[(k + 1).min(last)].0);
        (to - from).normalize_or(DVec3::X)
    };
    // Rings of a rounded end: how far beyond the path, in half heights, and their size.
    let end = |i: usize| (std::f64::consts::FRAC_PI_2 * i as f64 / END as f64).sin_cos();
    let mut rings: Vec<(usize, f64, f64)> = Vec::new();
    rings.extend((1..END).rev().map(end).map(|(beyond, size)| (0, -beyond, size)));
    rings.extend((0..=last).map(|k| (k, 0.0, 1.0)));
    rings.extend((1..END).map(end).map(|(beyond, size)| (last, beyond, size)));
    let mut positions: Vec<DVec3> = Vec::with_capacity(rings.len() * SECTION + 2);
    for &(k, beyond, size) in &rings {
        let (p, up) = path[k];
        let t = tangent(k);
        let side = t.cross(up).normalize_or(t.any_orthonormal_vector());
        let up = side.cross(t);
        let p = p + t * (beyond * height);
        positions.extend((0..SECTION).map(|i| {
            let (sine, cosine) = (TAU * i as f64 / SECTION as f64).sin_cos();
            p + side * (cosine * width * size) + up * (sine * height * size)
        }));
    }
    let poles = [positions.len() as u32, positions.len() as u32 + 1];
    positions.push(path[0].0 - tangent(0) * height);
    positions.push(path[last].0 + tangent(last) * height);
    let at = |k: usize, i: usize| (k * SECTION + i % SECTION) as u32;
    let mut faces = Vec::new();
    for i in 0..SECTION {
        faces.push([poles[0], at(0, i), at(0, i + 1)]);
        faces.push([poles[1], at(rings.len() - 1, i + 1), at(rings.len() - 1, i)]);
        for k in 0..rings.len() - 1 {
            let [a, b, c, d] = [at(k, i), at(k + 1, i), at(k + 1, i + 1), at(k, i + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    Surface::new(positions, faces).ok()
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;

    /// Volume (m³) of a mesh that is closed: each edge has a face on either side.
    fn volume(mesh: &Surface) -> f64 {
        let edges = mesh.triangles().iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let once: BTreeSet<(u32, u32)> = edges.clone().collect();
        assert_eq!(once.len(), edges.count(), "an edge has two faces on one side");
        assert!(once.iter().all(|&(a, b)| once.contains(&(b, a))), "an edge is open");
        let corners = (0..mesh.triangles().len()).map(|i| mesh.corners(i));
        corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
    }

    #[test]
    fn a_turned_square_is_a_closed_ring_with_the_volume_of_pappus() {
        let axis = Axis { centre: DVec3::new(1.0, 2.0, 3.0), direction: DVec3::new(0.6, 0.0, 0.8) };
        let ring = turned(axis, &[[2.0, 0.0], [3.0, 0.0], [3.0, 1.0], [2.0, 1.0]]).unwrap();
        let exact = TAU * 2.5;
        assert!((volume(&ring) / exact - 1.0).abs() < 0.01, "{}", volume(&ring));
    }

    #[test]
    fn a_bar_is_closed_and_has_the_volume_of_its_section_times_its_length() {
        let path: Vec<_> = (0..40)
            .map(|k| {
                let (sine, cosine) = (f64::from(k) / 39.0 * 3.0).sin_cos();
                (DVec3::new(cosine, sine, 0.0), DVec3::Z)
            })
            .collect();
        let exact = std::f64::consts::PI * 0.02 * 0.01 * (3.0 + 4.0 / 3.0 * 0.01);
        let found = volume(&bar(&path, [0.02, 0.01]).unwrap());
        assert!((found / exact - 1.0).abs() < 0.06, "{found} {exact}");
        assert_eq!(bar(&path[..1], [0.02, 0.01]), None);
    }
}
