//! What holds the hair of a scene, as meshes and as plain data.

use frisure::hairstyle::{accessories, accessory_meshes};
use frisure::strands::{AccessoryMaterial, AccessoryMesh, Surface};
use glam::DVec3;

use crate::response::{AccessoryData, AccessoryPart};
use crate::runner::LoadedScene;

impl LoadedScene {
    /// The meshes of what holds the hair; none where nothing is held.
    #[must_use]
    pub fn accessories(&self) -> Vec<AccessoryMesh> {
        accessory_meshes(&accessories(&self.hairstyle, &self.head))
    }

    /// The same for pictures: none if `output.accessories` is false.
    #[must_use]
    pub fn shown_accessories(&self) -> Vec<AccessoryMesh> {
        if self.scene.output.accessories { self.accessories() } else { Vec::new() }
    }
}

impl AccessoryData {
    /// The plain data of meshes.
    #[must_use]
    pub fn new(meshes: &[AccessoryMesh]) -> Self {
        let mut data = Self::default();
        for AccessoryMesh { name, material, surface } in meshes {
            let first = (data.positions.len() / 3) as u32;
            let flat = |v: &DVec3| v.as_vec3().to_array();
            data.positions.extend(surface.positions().iter().flat_map(flat));
            data.normals.extend(surface.vertex_normals().iter().flat_map(flat));
            data.triangles.extend(surface.triangles().iter().map(|t| t.map(|v| v + first)));
            let AccessoryMaterial { colour, gloss, roughness, .. } = *material;
            let (vertices, triangles) = (surface.positions().len(), surface.triangles().len());
            let name = name.clone();
            data.parts.push(AccessoryPart { name, vertices, triangles, colour, gloss, roughness });
        }
        data
    }

    /// The meshes, one for each part; what is no valid mesh is left out.
    #[must_use]
    pub fn meshes(&self) -> Vec<AccessoryMesh> {
        let (mut vertex, mut face) = (0_usize, 0_usize);
        let mut meshes = Vec::with_capacity(self.parts.len());
        for part in &self.parts {
            let (first, first_face) = (vertex, face);
            vertex = first.saturating_add(part.vertices);
            face = first_face.saturating_add(part.triangles);
            let positions = self.positions.as_chunks::<3>().0.get(first..vertex);
            let triangles = self.triangles.get(first_face..face);
            let (Some(positions), Some(triangles)) = (positions, triangles) else { break };
            let positions = positions.iter().map(|p| DVec3::from_array(p.map(f64::from)));
            // An index that is out of range stays so.
            let own = |v: u32| v.checked_sub(first as u32).unwrap_or(u32::MAX);
            let triangles = triangles.iter().map(|t| t.map(own)).collect();
            let AccessoryPart { ref name, colour, gloss, roughness, .. } = *part;
            let material = AccessoryMaterial { name: "accessory", colour, gloss, roughness };
            if let Ok(surface) = Surface::new(positions.collect(), triangles) {
                meshes.push(AccessoryMesh { name: name.clone(), material, surface });
            }
        }
        meshes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(name: &str, at: f64) -> AccessoryMesh {
        let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| p + at * DVec3::Z);
        let surface = Surface::new(corners.to_vec(), vec![[0, 1, 2]]).unwrap();
        let material = AccessoryMaterial {
            name: "accessory",
            colour: [0.1, 0.2, 0.3],
            gloss: 0.4,
            roughness: 0.5,
        };
        AccessoryMesh { name: name.into(), material, surface }
    }

    #[test]
    fn meshes_come_back_from_their_plain_data() {
        let meshes = vec![mesh("tie_0", 0.0), mesh("pin_0", 0.25)];
        let data = AccessoryData::new(&meshes);
        assert_eq!(data.triangles, [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(data.normals[..3], [0.0, 0.0, 1.0]);
        assert_eq!(data.meshes(), meshes);
        assert_eq!(AccessoryData::new(&[]), AccessoryData::default());
        // What does not fit is left out, and nothing panics.
        let mut wrong = data.clone();
        wrong.triangles[1] = [0, 4, 99];
        assert_eq!(wrong.meshes(), meshes[..1]);
        wrong.parts[0].vertices = usize::MAX;
        assert_eq!(wrong.meshes(), []);
    }
}
