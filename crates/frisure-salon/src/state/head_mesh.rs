//! The mesh of the head, and its intersection with rays.

use frisure::strands::{Attribute, AttributeValues, Domain, Eye, Features, Strands, Surface, Tint};
use frisure_engine::{HeadData, StrandsData};
use glam::{DVec3, Vec3};

/// The mesh of the head.
#[derive(Clone, Debug)]
pub struct HeadMesh {
    surface: Option<Surface>,
    /// Levels that cuts are named by, and their heights (m).
    pub levels: Vec<(String, f64)>,
}

/// Height of the head from crown to chin (m); the shoulders are below.
const HEAD_HEIGHT: f64 = 0.27;

impl HeadMesh {
    /// Creates the mesh from plain arrays.
    #[must_use]
    pub fn new(head: HeadData) -> Self {
        let positions = head.positions.chunks_exact(3).map(|p| DVec3::new(p[0], p[1], p[2]));
        let surface = Surface::new(positions.collect(), head.triangles).ok();
        let levels = head.levels;
        let tints: Vec<Tint> = (head.tints.as_chunks().0.iter())
            .map(|&[lips, flush, garment, scalp]| Tint { lips, flush, garment, scalp })
            .collect();
        let eyes: Vec<Eye> = (head.eyes.iter())
            .map(|&[x, y, z, radius, u, v, w]| Eye {
                centre: DVec3::new(x, y, z),
                radius,
                gaze: DVec3::new(u, v, w),
            })
            .collect();
        if tints.is_empty() && eyes.is_empty() && head.hairs.offsets.is_empty() {
            return Self { surface, levels };
        }
        let (hairs, lashes) = (strands_of(&head.hairs), head.lashes);
        // Tints that do not fit the mesh are left out with the rest.
        let with = |surface: Surface| {
            let features = Features { tints, eyes, hairs, lashes };
            surface.clone().with_features(features).unwrap_or(surface)
        };
        Self { surface: surface.map(with), levels }
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

    /// How far (m) a height is above the nearest level, and the name of the level.
    #[must_use]
    pub fn above_level(&self, z: f64) -> Option<(f64, &str)> {
        let away = |level: &&(String, f64)| (z - level.1).abs();
        let nearest = self.levels.iter().min_by(|a, b| away(a).total_cmp(&away(b)))?;
        Some((z - nearest.1, &nearest.0))
    }

    /// The first hit of a ray (origin in m, unit direction).
    #[must_use]
    pub fn hit(&self, from: DVec3, direction: DVec3) -> Option<DVec3> {
        self.hit_and_normal(from, direction).map(|(hit, _)| hit)
    }

    /// The same with the unit normal of the face that is hit, towards the origin of the ray.
    #[must_use]
    pub fn hit_and_normal(&self, from: DVec3, direction: DVec3) -> Option<(DVec3, DVec3)> {
        let surface = self.surface.as_ref()?;
        let p = surface.positions();
        let hits = surface.triangles().iter().filter_map(|t| {
            let [a, b, c] = t.map(|i| p[i as usize]);
            Some((distance(from, direction, a, b, c)?, (b - a).cross(c - a)))
        });
        let (nearest, normal) = hits.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let normal = normal.normalize_or_zero();
        let towards = if normal.dot(direction) > 0.0 { -normal } else { normal };
        Some((from + nearest * direction, towards))
    }
}

/// Converts plain arrays to strands; pieces out of range are left out.
#[must_use]
pub fn strands_of(data: &StrandsData) -> Strands {
    let mut strands = Strands::with_capacity(data.guide.len(), data.radii.len());
    let points: Vec<Vec3> =
        data.points.as_chunks().0.iter().map(|p| Vec3::from_array(*p)).collect();
    for ends in data.offsets.windows(2) {
        let piece = ends[0] as usize..ends[1] as usize;
        if let (Some(points), Some(radii)) = (points.get(piece.clone()), data.radii.get(piece)) {
            strands.push(points, radii);
        }
    }
    let mut set = |name: &str, domain, values| {
        // An attribute of another length is left out.
        let _ = strands.set_attribute(Attribute { name: name.into(), domain, values });
    };
    if !data.guide.is_empty() {
        set("guide", Domain::Strand, AttributeValues::U32(data.guide.clone()));
    }
    if !data.wetness.is_empty() {
        set("wetness", Domain::Point, AttributeValues::F32(data.wetness.clone()));
    }
    strands
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
