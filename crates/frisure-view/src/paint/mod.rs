//! One picture, in the order in which it is drawn.

mod compose;
mod hair;
mod head;

use bytemuck::cast_slice;
use wgpu::{BindingResource, CommandEncoder, Device, Queue, RenderPass};

use crate::cache::FrameCache;
use crate::canvas::Canvas;
use crate::context::FrameContext;
use crate::frame::{Frame, Shadows};
use crate::gpu;
use crate::hair::Hair;
use crate::lamps::{Lamp, strongest};
use crate::renderer::Renderer;
use crate::uniforms;

impl Renderer {
    /// Draws into the canvas: shadows, light along the hairs, hair, head, lines. The commands take effect when
    /// the caller submits the encoder.
    pub fn draw(
        &self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        canvas: &mut Canvas,
        frame: &Frame<'_>,
    ) {
        let hair = frame.hair.filter(|hair| hair.strands() > 0);
        let frame = &Frame { hair, ..frame.clone() };
        canvas.cache.prepare(self, device, queue, frame);
        let size = canvas.size;
        let Some(job) = canvas.cache.job(self, (device, queue), frame, size) else { return };
        canvas.cache.draw_maps(&job, encoder);
        canvas.cache.shade(&job, encoder);
        job.draw_head_depth(encoder, canvas);
        job.draw_hair(encoder, canvas);
        job.draw_head(encoder, canvas);
        job.compose(encoder, canvas);
    }

    /// Draws the finished picture over the whole viewport of a pass of the caller.
    pub fn show(&self, device: &Device, pass: &mut RenderPass<'_>, canvas: &Canvas) {
        let view = gpu::whole(&canvas.targets.picture);
        let sampler = BindingResource::Sampler(&self.sampler);
        let resources = [BindingResource::TextureView(&view), sampler];
        let group = gpu::group(device, &self.layouts.show, &resources);
        pass.set_pipeline(&self.pipelines.show);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }
}

impl FrameCache {
    /// The context of a frame, with its numbers on the device.
    fn job<'a>(
        &self,
        renderer: &'a Renderer,
        (device, queue): (&'a Device, &'a Queue),
        frame: &'a Frame<'a>,
        size: [u32; 2],
    ) -> Option<FrameContext<'a>> {
        let (buffer, group) = self.numbers.as_ref()?;
        let (lights, environment) = (self.lights()?, self.environment()?);
        let (hair, head) =
            (frame.hair.map(Hair::bounds), frame.skin.map(crate::skin::Skin::bounds));
        let shadowed = frame.shadows != Shadows::None;
        let of = |lamp| Lamp::new(lamp, hair, head, shadowed);
        let lamps: Vec<Lamp> = strongest(lights).into_iter().map(of).collect();
        let (strands, factor) = frame.hair.map_or((0, 1.0), |hair| hair.shared(frame.share));
        let vertices = frame.hair.map_or(0, |hair| hair.vertices_of(strands));
        let numbers = uniforms::packed(frame, size, environment, &lamps, factor, vertices);
        queue.write_buffer(buffer, 0, cast_slice(&numbers));
        let picture = group.clone();
        Some(FrameContext { renderer, device, queue, frame, picture, lamps, strands, vertices })
    }
}
