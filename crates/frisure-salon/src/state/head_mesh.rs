//! The mesh of the head, and its intersection with rays.

use frisure::strands::Surface;
use frisure_engine::HeadData;
use glam::DVec3;

/// The mesh of the head.
#[derive(Clone, Debug)]
pub struct HeadMesh {
    surface: Option<Surface>,
}

/// Height of the head from crown to chin (m); the shoulders are below.
const HEAD_HEIGHT: f64 = 0.27;

impl HeadMesh {
    /// Creates the mesh from plain arrays.
    #[must_use]
    pub fn new(head: HeadData) -> Self {
        let positions = head.positions.chunks_exact(3).map(|p| DVec3::new(p[0], p[1], p[2]));
        Self { surface: Surface::new(positions.collect(), head.triangles).ok() }
    }

    /// The mesh; `None` if the arrays were not a valid one.
    #[must_use]
    pub fn surface(&self) -> Option<&Surface> {
        self.surface.as_ref()
    }

    /// The bounding box (m) of the head without the shoulders.
    #[must_use]
    pub fn framed(&self) -> (DVec3, DVec3) {
        let positions = self.surface.as_ref().map_or(&[][..], Surface::positions);
        let top = positions.iter().map(|p| p.z).fold(f64::NEG_INFINITY, f64::max);
        let shown = positions.iter().filter(|p| p.z > top - HEAD_HEIGHT);
        let empty = (DVec3::splat(f64::INFINITY), DVec3::splat(f64::NEG_INFINITY));
        let all = shown.fold(empty, |(low, high), p| (low.min(*p), high.max(*p)));
        if all.0.is_finite() { all } else { (DVec3::splat(-0.12), DVec3::splat(0.12)) }
    }

    /// The first hit of a ray (origin in m, unit direction).
    #[must_use]
    pub fn hit(&self, from: DVec3, direction: DVec3) -> Option<DVec3> {
        let surface = self.surface.as_ref()?;
        let p = surface.positions();
        let hits = surface.triangles().iter().filter_map(|t| {
            let [a, b, c] = t.map(|i| p[i as usize]);
            distance(from, direction, a, b, c)
        });
        let nearest = hits.fold(f64::INFINITY, f64::min);
        nearest.is_finite().then(|| from + nearest * direction)
    }
}

/// Distance along a ray to a triangle. Möller & Trumbore 1997.
fn distance(from: DVec3, direction: DVec3, a: DVec3, b: DVec3, c: DVec3) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let det = ab.dot(p);
    if det.abs() < 1e-18 {
        return None;
    }
    let s = from - a;
    let (u, q) = (s.dot(p) / det, s.cross(ab));
    let (v, t) = (direction.dot(q) / det, ac.dot(q) / det);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_hits_the_nearer_side() {
        let head = HeadData {
            positions: vec![
                -1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0, //
                -1.0, -1.0, 1.0, 1.0, -1.0, 1.0, 0.0, 1.0, 1.0,
            ],
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            ..HeadData::default()
        };
        let mesh = HeadMesh::new(head);
        let hit = mesh.hit(DVec3::new(0.0, 0.0, 5.0), DVec3::NEG_Z).unwrap();
        assert!((hit.z - 1.0).abs() < 1e-12);
        assert_eq!(mesh.hit(DVec3::new(5.0, 0.0, 5.0), DVec3::NEG_Z), None);
    }
}
