//! What holds hair from outside: rollers, ties, pins and clips, as meshes that renderers and files take.

use crate::accessory_material::{AccessoryFaces, AccessoryMaterial};
use crate::surface::Surface;

/// One object that holds hair.
#[derive(Clone, Debug, PartialEq)]
pub struct AccessoryMesh {
    /// Its name among those of a head, in lower case with underscores: `roller_0`.
    pub name: String,
    /// What it is made of.
    pub material: AccessoryMaterial,
    /// Its mesh (m): closed, counter-clockwise seen from outside.
    pub surface: Surface,
}

impl Surface {
    /// The mesh of a head followed by those of accessories, for renderers: [`Self::accessory`] tells them apart. Vertices and
    /// faces of the head keep their numbers and its features stay. Without a head the mesh is that of the accessories; without
    /// accessories too there is none.
    ///
    /// ```
    /// use frisure_strands::{AccessoryMaterial, AccessoryMesh, Surface};
    /// use glam::DVec3;
    ///
    /// let head = Surface::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]])?;
    /// let material = AccessoryMaterial { name: "rubber", colour: [0.02; 3], gloss: 0.1, roughness: 0.5 };
    /// let tie = AccessoryMesh { name: "tie_0".into(), material, surface: head.clone() };
    /// let both = Surface::with_accessories(Some(&head), &[tie]).unwrap();
    /// assert_eq!(both.triangles(), [[0, 1, 2], [3, 4, 5]]);
    /// assert_eq!(both.accessory(0), None);
    /// assert_eq!(both.accessory(1), Some(&material));
    /// # Ok::<(), frisure_strands::SurfaceError>(())
    /// ```
    #[must_use]
    pub fn with_accessories(head: Option<&Self>, accessories: &[AccessoryMesh]) -> Option<Self> {
        let Some((first, rest)) = accessories.split_first() else { return head.cloned() };
        let (mut joined, others) = match head {
            Some(head) => (head.clone(), accessories),
            None => (first.surface.clone(), rest),
        };
        let before = head.map_or(0, |head| head.triangles().len());
        let mut ends = Vec::with_capacity(accessories.len());
        if head.is_none() {
            ends.push((joined.triangles().len(), first.material));
        }
        for accessory in others {
            joined.append(&accessory.surface);
            ends.push((joined.triangles().len(), accessory.material));
        }
        joined.set_accessories(AccessoryFaces::new(before, ends));
        Some(joined)
    }
}
