//! The hair's ribbons: light at each vertex, and their order from near to far.

use bytemuck::cast_slice;
use frisure_look::Camera;
use glam::Vec3;
use wgpu::{Buffer, BufferUsages, Device};

use crate::context::FrameContext;
use crate::gpu;
use crate::hair::{Hair, ROW};
use crate::pieces::Pieces;
use crate::renderer::Renderer;

/// Parts of the hair, nearest first, between which finished pixels are closed: where each ends, in parts of
/// all. The nearest hair hides most of what is behind it. Chosen for speed.
const PARTS: [f32; 6] = [0.1, 0.2, 0.32, 0.48, 0.7, 1.0];
/// Pieces that are drawn faster than pixels are closed. Chosen for speed.
const FEW: usize = 60_000;

/// Light at each vertex.
#[derive(Debug)]
pub(crate) struct Shaded {
    pub(crate) shape: u64,
    pub(crate) lights: wgpu::Texture,
    /// Places and lights for ribbons.
    pub(crate) group: wgpu::BindGroup,
}

/// Pieces from near to far.
#[derive(Debug)]
pub(crate) struct Sorted {
    key: (u64, usize, Vec3, Vec3),
    pub(crate) pieces: Pieces,
    /// Depth at which each part ends.
    pub(crate) levels: Buffer,
    /// Pieces up to the end of each part.
    pub(crate) ends: Vec<u32>,
}

impl Shaded {
    pub(crate) fn new(renderer: &Renderer, device: &Device, hair: &Hair) -> Self {
        let height = (hair.vertices() as u32).div_ceil(ROW).max(1);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let lights = gpu::texture(device, "lights", [ROW, height, 1], gpu::LIGHT, usage);
        let (places, view) = (hair.places(), gpu::whole(&lights));
        let resources = [&places, &view].map(wgpu::BindingResource::TextureView);
        let group = gpu::group(device, &renderer.layouts.ribbons, &resources);
        Self { shape: hair.shape(), lights, group }
    }
}

impl Sorted {
    /// Sorts anew, if hair, camera or share are others.
    pub(crate) fn update(known: &mut Option<Self>, job: &FrameContext<'_>, hair: &Hair) {
        let camera: &Camera = &job.frame.camera;
        let (eye, forward) = (camera.eye().as_vec3(), camera.forward().as_vec3());
        let key = (hair.shape(), job.strands, eye, forward);
        if known.as_ref().is_some_and(|sorted| sorted.key == key) {
            return;
        }
        let nearest = hair.nearest(job.strands, eye, forward);
        let count = nearest.pieces.len();
        let parts = if count > FEW { &PARTS[..PARTS.len() - 1] } else { &[] };
        let end = |part: &f32| ((part * count as f32) as u32).min(count as u32);
        let ends: Vec<u32> = parts.iter().map(end).chain([count as u32]).collect();
        let level = |&end: &u32| nearest.depth((end as usize).saturating_sub(1));
        let levels: Vec<f32> = ends.iter().map(level).collect();
        let (usage, bytes) = (BufferUsages::VERTEX, cast_slice(&levels));
        let levels = gpu::buffer(job.device, job.queue, "levels", bytes, usage);
        let old = known.take().map(|sorted| sorted.pieces);
        let pieces = Pieces::new(job.renderer, job.device, job.queue, nearest.pieces, old);
        *known = Some(Self { key, pieces, levels, ends });
    }
}
