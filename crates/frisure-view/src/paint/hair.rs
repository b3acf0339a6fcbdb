//! Hair: light at each vertex, then ribbons from near to far.

use bytemuck::cast_slice;
use frisure_look::Camera;
use glam::Vec3;
use wgpu::{Buffer, BufferUsages, CommandEncoder, Device, Queue};

use super::{FrameCache, FrameContext};
use crate::canvas::Canvas;
use crate::gpu;
use crate::hair::{Hair, ROW};
use crate::renderer::Renderer;

/// Parts of the hair, nearest first, between which finished pixels are closed: where each ends, in parts of
/// all. The nearest hair hides most of what is behind it.
const PARTS: [f32; 6] = [0.1, 0.2, 0.32, 0.48, 0.7, 1.0];
/// Pieces that are drawn faster than pixels are closed.
const FEW: usize = 60_000;

/// Light at each vertex.
#[derive(Debug)]
pub(super) struct Shaded {
    pub(super) shape: u64,
    lights: wgpu::Texture,
    /// Places and lights for ribbons.
    pub(super) group: wgpu::BindGroup,
}

/// Pieces from near to far.
#[derive(Debug)]
pub(super) struct Sorted {
    key: (u64, usize, Vec3, Vec3),
    pieces: Buffer,
    /// Depth at which each part ends.
    levels: Buffer,
    /// Pieces up to the end of each part.
    ends: Vec<u32>,
}

impl Shaded {
    pub(super) fn new(renderer: &Renderer, device: &Device, hair: &Hair) -> Self {
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
    fn update(known: &mut Option<Self>, job: &FrameContext<'_>, hair: &Hair) {
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
        let buffer =
            |label, bytes| gpu::buffer(job.device, job.queue, label, bytes, BufferUsages::VERTEX);
        let bytes = cast_slice(&nearest.pieces);
        let pieces = match known.take() {
            Some(old) if old.pieces.size() >= bytes.len() as u64 => {
                rewrite(job.queue, &old.pieces, bytes);
                old.pieces
            }
            _ => buffer("pieces", bytes),
        };
        *known = Some(Self { key, pieces, levels: buffer("levels", cast_slice(&levels)), ends });
    }
}

fn rewrite(queue: &Queue, buffer: &Buffer, bytes: &[u8]) {
    if !bytes.is_empty() {
        queue.write_buffer(buffer, 0, bytes);
    }
}

impl FrameCache {
    /// The light that each vertex sends to the eye.
    pub(super) fn shade(&self, job: &FrameContext<'_>, encoder: &mut CommandEncoder) {
        let (Some(shaded), Some(maps), Some(environment), Some(hair)) =
            (&self.shaded, &self.maps, self.environment(), job.frame.hair)
        else {
            return;
        };
        let view = gpu::whole(&shaded.lights);
        let targets = [gpu::target(&view, Some([0.0; 4]))];
        let mut pass = gpu::pass(encoder, "light along the hairs", &targets, None);
        let rows = (job.vertices as u32).div_ceil(ROW).clamp(1, shaded.lights.height());
        pass.set_scissor_rect(0, 0, ROW, rows);
        pass.set_pipeline(&job.renderer.pipelines.shade);
        pass.set_bind_group(0, &job.picture, &[]);
        pass.set_bind_group(1, maps.group(), &[]);
        pass.set_bind_group(2, hair.group(), &[]);
        pass.set_bind_group(3, &environment.group, &[]);
        pass.draw(0..3, 0..1);
    }
}

impl FrameContext<'_> {
    /// The hair, nearest first.
    pub(super) fn draw_hair(&self, encoder: &mut CommandEncoder, canvas: &mut Canvas) {
        let view = gpu::whole(&canvas.targets.hair);
        let depth = gpu::whole(&canvas.targets.depth);
        drop(gpu::pass(encoder, "no hair yet", &[gpu::target(&view, Some([0.0; 4]))], None));
        let known = &mut canvas.cache;
        let Some(hair) = self.frame.hair else { return };
        Sorted::update(&mut known.sorted, self, hair);
        let (Some(sorted), Some(shaded)) = (&known.sorted, &known.shaded) else { return };
        let resources = [wgpu::BindingResource::TextureView(&view)];
        let covered = gpu::group(self.device, &self.renderer.layouts.finish, &resources);
        let mut begin = 0;
        for (i, &end) in (0_u64..).zip(&sorted.ends).filter(|(_, end)| **end > 0) {
            let depths = Some(gpu::depth_target(&depth, false));
            let mut pass = gpu::pass(encoder, "hair", &[gpu::target(&view, None)], depths);
            if end > begin {
                pass.set_pipeline(&self.renderer.pipelines.hair);
                pass.set_bind_group(0, &self.picture, &[]);
                pass.set_bind_group(1, &shaded.group, &[]);
                let part = u64::from(begin) * 4..u64::from(end) * 4;
                pass.set_vertex_buffer(0, sorted.pieces.slice(part));
                pass.draw(0..4, 0..end - begin);
            }
            drop(pass);
            begin = end;
            if i + 1 == sorted.ends.len() as u64 {
                break;
            }
            let depths = Some(gpu::depth_target(&depth, false));
            let mut pass = gpu::pass(encoder, "finished pixels", &[], depths);
            pass.set_pipeline(&self.renderer.pipelines.finish);
            pass.set_bind_group(0, &self.picture, &[]);
            pass.set_bind_group(1, &covered, &[]);
            pass.set_vertex_buffer(0, sorted.levels.slice(4 * i..4 * i + 4));
            pass.draw(0..3, 0..1);
        }
    }
}
