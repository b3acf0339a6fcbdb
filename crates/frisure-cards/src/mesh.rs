//! The strips of a level as one mesh.

use glam::Vec3;

use crate::layout::Place;
use crate::ribbon::Ribbon;

/// Triangles with normals and texture coordinates.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CardMesh {
    /// Vertices (m, z up).
    pub positions: Vec<Vec3>,
    /// Unit normals of vertices; they look away from the head.
    pub normals: Vec<Vec3>,
    /// Unit vectors across the strips, in which the first texture coordinate grows.
    pub tangents: Vec<Vec3>,
    /// Texture coordinates of vertices: from the left and from the top, 0 to 1. Roots are above tips.
    pub uvs: Vec<[f32; 2]>,
    /// Three vertices for each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl CardMesh {
    /// Adds a strip with its place in a texture of `size` texels a side.
    pub(crate) fn push(&mut self, ribbon: &Ribbon, place: &Place, size: usize) {
        let first = self.positions.len() as u32;
        let (scale, length) = (1.0 / size as f32, ribbon.length().max(1e-6));
        let middle = |k: usize| ribbon.stations[ribbon.kept[k]].middle;
        let last = ribbon.kept.len() - 1;
        for (k, &i) in ribbon.kept.iter().enumerate() {
            let station = &ribbon.stations[i];
            // Of the mesh: where it leaves out the turns of a curl, those of the curl would look elsewhere than its faces.
            let along = middle((k + 1).min(last)) - middle(k.saturating_sub(1));
            let normal = along.cross(station.across).normalize_or(station.normal());
            let down = place.y as f32 + place.height as f32 * station.distance / length;
            let right = [place.x, place.x + place.width];
            for (position, x) in station.edges().into_iter().zip(right) {
                self.positions.push(position);
                self.normals.push(normal);
                self.tangents.push(station.across);
                self.uvs.push([scale * x as f32, scale * down]);
            }
        }
        for k in 0..ribbon.kept.len() as u32 - 1 {
            let [a, b, c, d] = [0, 1, 2, 3].map(|i| first + 2 * k + i);
            self.triangles.extend([[a, c, b], [b, c, d]]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ribbon::{Even, Side};
    use frisure_strands::Strands;

    /// A tight curl that hangs, of 30 strands side by side.
    fn curl() -> Ribbon {
        let mut strands = Strands::new();
        for i in 0..30 {
            let aside = 1e-4 * i as f32;
            let line: Vec<Vec3> = (0..64)
                .map(|k| {
                    let (s, c) = (0.5 * k as f32).sin_cos();
                    Vec3::new(8e-3 * c + aside, 8e-3 * s, -2e-3 * k as f32)
                })
                .collect();
            strands.push(&line, &[5e-5; 64]);
        }
        let rows: Vec<usize> = (0..30).collect();
        Ribbon::new(&Even::new(&strands), &rows, |_| Vec3::Y, Side::Wide, 4e-3)
    }

    #[test]
    fn faces_look_where_their_normals_do() {
        let mut mesh = CardMesh::default();
        mesh.push(&curl(), &Place { x: 4, y: 4, width: 20, height: 100 }, 256);
        assert!(mesh.normals.iter().all(|n| n.is_normalized()));
        for (t, n) in mesh.tangents.iter().zip(&mesh.normals) {
            assert!(t.dot(*n).abs() < 1e-4);
        }
        let looks = |corners: &[u32; 3]| {
            let [a, b, c] = corners.map(|v| mesh.positions[v as usize]);
            let face = (b - a).cross(c - a);
            let normal: Vec3 = corners.iter().map(|v| mesh.normals[*v as usize]).sum();
            face.dot(normal) > 0.0
        };
        assert!(mesh.triangles.iter().all(looks));
        // Places in the texture are within that of the strip, and the root is above.
        assert!(mesh.uvs.iter().all(|uv| (4.0 / 256.0..=104.0 / 256.0).contains(&uv[1])));
        assert_eq!(mesh.uvs[0], [4.0 / 256.0; 2]);
    }
}
