//! The head on the device, with what holds the hair.

use bytemuck::cast_slice;
use frisure_strands::{AccessoryMesh, Strands, Surface, Tint};
use glam::{DVec3, Vec3};
use wgpu::{Buffer, BufferUsages, Device, Queue};

use crate::gpu;
use crate::renderer::Renderer;

/// A surface on the device.
#[derive(Debug)]
pub struct Skin {
    surface: Surface,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    middle: DVec3,
    version: u64,
    /// Position and normal of each vertex.
    vertices: Buffer,
    /// Tint of each vertex.
    tints: Buffer,
    indices: Buffer,
    corners: u32,
}

impl Skin {
    /// Puts a surface on the device.
    #[must_use]
    pub fn new(renderer: &Renderer, device: &Device, queue: &Queue, surface: &Surface) -> Self {
        Self::with_accessories(renderer, device, queue, surface, &[])
    }

    /// Puts a head and what holds its hair on the device. Accessories hide hair, cast shadows and are lit as the head is; the lamps
    /// are aimed at the middle of the head alone.
    #[must_use]
    pub fn with_accessories(
        _renderer: &Renderer,
        device: &Device,
        queue: &Queue,
        head: &Surface,
        accessories: &[AccessoryMesh],
    ) -> Self {
        let joined = Surface::with_accessories(Some(head), accessories);
        let surface = joined.as_ref().unwrap_or(head);
        let positions: Vec<Vec3> = surface.positions().iter().map(|p| p.as_vec3()).collect();
        let normals: Vec<Vec3> = surface.vertex_normals().iter().map(|n| n.as_vec3()).collect();
        let both = positions.iter().zip(&normals);
        let values: Vec<[f32; 3]> = both.flat_map(|(p, n)| [p.to_array(), n.to_array()]).collect();
        let most = device.limits().max_buffer_size / 24;
        // A surface beyond the device's limit is cut short rather than refused: no head has that many faces.
        let kept = (values.len() / 2).min(most as usize);
        let faces = surface.triangles().iter().filter(|t| t.iter().all(|&v| (v as usize) < kept));
        let indices: Vec<u32> = faces.flatten().copied().take(most as usize / 3 * 3).collect();
        Self {
            middle: frisure_render::head_centre(&Strands::new(), Some(head)),
            vertices: gpu::buffer(
                device,
                queue,
                "head",
                cast_slice(&values[..2 * kept]),
                BufferUsages::VERTEX,
            ),
            tints: gpu::buffer(
                device,
                queue,
                "tints of the head",
                cast_slice(&tints(surface)[..kept]),
                BufferUsages::VERTEX,
            ),
            indices: gpu::buffer(device, queue, "faces", cast_slice(&indices), BufferUsages::INDEX),
            corners: indices.len() as u32,
            surface: surface.clone(),
            positions,
            normals,
            version: gpu::version(),
        }
    }

    /// Draws it with the pipeline that is set.
    pub(crate) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..self.corners, 0, 0..1);
    }

    /// Tints of the vertices.
    pub(crate) fn tints(&self) -> &Buffer {
        &self.tints
    }

    pub(crate) fn version(&self) -> u64 {
        self.version
    }

    pub(crate) fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Places and unit normals of the vertices.
    pub(crate) fn places(&self) -> impl ExactSizeIterator<Item = (Vec3, Vec3)> {
        self.positions.iter().copied().zip(self.normals.iter().copied())
    }

    /// The point at which lamps are aimed (m).
    pub(crate) fn middle(&self) -> DVec3 {
        self.middle
    }

    /// Smallest and largest corner (m).
    pub(crate) fn bounds(&self) -> (Vec3, Vec3) {
        let (low, high) = self.surface.bounds();
        (low.as_vec3(), high.as_vec3())
    }
}

/// Tints of the vertices, which are none for skin without features; the fourth number is half of the scalp's. Vertices of accessories have
/// a fourth number of at least one: their colour, and one plus the strength of their gloss.
fn tints(surface: &Surface) -> Vec<[f32; 4]> {
    let tints = surface.features().map_or(&[][..], |features| &features.tints);
    let of = |index: usize| tints.get(index).copied().unwrap_or_default();
    let packed = |Tint { lips, flush, garment, scalp }| [lips, flush, garment, 0.5 * scalp];
    let mut tints: Vec<_> = (0..surface.positions().len()).map(|index| packed(of(index))).collect();
    for (face, corners) in surface.triangles().iter().enumerate() {
        if let Some(material) = surface.accessory(face) {
            let [r, g, b] = material.colour;
            corners.iter().for_each(|&v| tints[v as usize] = [r, g, b, 1.0 + material.gloss]);
        }
    }
    tints
}
