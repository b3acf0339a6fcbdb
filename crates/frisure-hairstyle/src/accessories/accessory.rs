//! An accessory as plain data, and its mesh for renderers and files.

use frisure_strands::{AccessoryMesh, Surface};
use glam::DVec3;

use super::kind::AccessoryKind;

/// An object that holds hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Accessory {
    /// What it is.
    pub kind: AccessoryKind,
    /// The wisps that it holds, by their numbers, rising.
    pub wisps: Vec<usize>,
    /// Its middle (m, head's frame).
    pub centre: DVec3,
    /// Direction (unit): of a roller its axis, of ties and elastics the hair's, of pins and clips their length's.
    pub axis: DVec3,
    /// Radius (m): of a roller that of its outside, of ties and elastics that of the opening, of pins and clips half of their width.
    pub radius: f64,
    /// Length (m) along the axis.
    pub length: f64,
    /// Its mesh (m): closed, counter-clockwise seen from outside.
    pub mesh: Surface,
}

/// The meshes of accessories for renderers and files, in their order, with names such as `roller_0`.
#[must_use]
pub fn accessory_meshes(accessories: &[Accessory]) -> Vec<AccessoryMesh> {
    let mut counts = [0_usize; AccessoryKind::ALL.len()];
    let mesh = |accessory: &Accessory| {
        let count = &mut counts[accessory.kind as usize];
        let name = format!("{}_{count}", accessory.kind.name());
        *count += 1;
        let (material, surface) = (accessory.kind.material(), accessory.mesh.clone());
        AccessoryMesh { name, material, surface }
    };
    accessories.iter().map(mesh).collect()
}
