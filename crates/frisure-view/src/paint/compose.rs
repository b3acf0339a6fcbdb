//! Composition of hair, head and background, tone mapping, and lines over them.

use bytemuck::cast_slice;
use frisure_look::Background;
use wgpu::{BindingResource, BufferUsages, CommandEncoder};

use crate::canvas::Canvas;
use crate::context::FrameContext;
use crate::frame::Line;
use crate::gpu;

impl FrameContext<'_> {
    /// Hair over head over background, and lines.
    pub(super) fn compose(&self, encoder: &mut CommandEncoder, canvas: &Canvas) {
        let (targets, sampler) = (&canvas.targets, &self.renderer.sampler);
        let Some((_, around)) = &canvas.cache.environment_map else { return };
        let (hair, head) = (gpu::whole(&targets.hair), gpu::whole(&targets.head));
        let [hair, head, around] = [&hair, &head, around].map(BindingResource::TextureView);
        let sampler = BindingResource::Sampler(sampler);
        let resources = [hair, head, around, sampler];
        let layers = gpu::group(self.device, &self.renderer.layouts.compose, &resources);
        let view = gpu::whole(&targets.picture);
        let target = [gpu::target(&view, Some([0.0; 4]))];
        let mut pass = gpu::pass(encoder, "compose", &target, None);
        let seen = matches!(self.frame.look.background, Background::Environment);
        pass.set_pipeline(&self.renderer.pipelines.compose[usize::from(seen)]);
        pass.set_bind_group(0, &self.picture, &[]);
        pass.set_bind_group(1, &layers, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        self.draw_lines(encoder, canvas, &view);
    }

    /// Lines that head and hair may hide, then those on top.
    fn draw_lines(&self, encoder: &mut CommandEncoder, canvas: &Canvas, view: &wgpu::TextureView) {
        let sound = self.frame.lines.iter().filter(|line| sound(line));
        let (over, within): (Vec<&Line>, Vec<&Line>) = sound.partition(|line| line.on_top);
        let strokes: Vec<[f32; 12]> = within.iter().chain(&over).map(|line| stroke(line)).collect();
        if strokes.is_empty() {
            return;
        }
        let (bytes, usage) = (cast_slice(&strokes), BufferUsages::VERTEX);
        let buffer = gpu::buffer(self.device, self.queue, "lines", bytes, usage);
        let depth = gpu::whole(&canvas.targets.depth);
        let depths = Some(gpu::depth_target(&depth, false));
        let mut pass = gpu::pass(encoder, "lines", &[gpu::target(view, None)], depths);
        pass.set_bind_group(0, &self.picture, &[]);
        let pipelines = &self.renderer.pipelines;
        let mut begin = 0;
        for (pipeline, count) in
            [(&pipelines.lines, within.len()), (&pipelines.lines_on_top, over.len())]
        {
            let bytes = 48 * count as u64;
            if count > 0 {
                pass.set_pipeline(pipeline);
                pass.set_vertex_buffer(0, buffer.slice(begin..begin + bytes));
                pass.draw(0..4, 0..count as u32);
            }
            begin += bytes;
        }
    }
}

/// Whether a line can be drawn.
fn sound(line: &Line) -> bool {
    line.from.is_finite() && line.to.is_finite() && line.width > 0.0 && line.width.is_finite()
}

/// A line as its shader has it.
fn stroke(line: &Line) -> [f32; 12] {
    let (p, q, c) = (line.from, line.to, line.colour);
    [p.x, p.y, p.z, line.width, q.x, q.y, q.z, 0.0, c[0], c[1], c[2], c[3]]
}
