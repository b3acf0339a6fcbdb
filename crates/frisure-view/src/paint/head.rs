//! The head: how far away it is, and the light that it sends to the eye.

use wgpu::CommandEncoder;

use crate::canvas::{Canvas, Fine};
use crate::context::FrameContext;
use crate::frame::Shadows;
use crate::gpu;

impl FrameContext<'_> {
    /// How far away the head is, for hair that is behind it.
    pub(super) fn draw_head_depth(&self, encoder: &mut CommandEncoder, canvas: &Canvas) {
        let depth = gpu::whole(&canvas.targets.depth);
        let clear = Some(gpu::depth_target(&depth, true));
        let mut pass = gpu::pass(encoder, "depth of the head", &[], clear);
        if let Some(skin) = self.frame.skin {
            pass.set_pipeline(&self.renderer.pipelines.skin_depth);
            pass.set_bind_group(0, &self.picture, &[]);
            skin.draw(&mut pass);
        }
    }

    /// The head, where hair does not hide it.
    pub(super) fn draw_head(&self, encoder: &mut CommandEncoder, canvas: &mut Canvas) {
        let (size, count) = (canvas.size, self.renderer.samples);
        let (Some(maps), Some(environment)) = (&canvas.cache.maps, canvas.cache.environment())
        else {
            return;
        };
        let fine = canvas.fine.get_or_insert_with(|| Fine::new(self.device, size, count));
        let head = gpu::whole(&canvas.targets.head);
        let (light, depth) = (gpu::whole(&fine.light), gpu::whole(&fine.depth));
        let mut target = gpu::target(if count > 1 { &light } else { &head }, Some([0.0; 4]));
        if let Some(target) = &mut target
            && count > 1
        {
            target.resolve_target = Some(&head);
            target.ops.store = wgpu::StoreOp::Discard;
        }
        let hair = gpu::whole(&canvas.targets.hair);
        let resources = [wgpu::BindingResource::TextureView(&hair)];
        let covered = gpu::group(self.device, &self.renderer.layouts.finish, &resources);
        let mut pass = gpu::pass(encoder, "head", &[target], Some(gpu::depth_target(&depth, true)));
        if let Some(skin) = self.frame.skin {
            let shadows = usize::from(self.frame.shadows != Shadows::None);
            pass.set_pipeline(&self.renderer.pipelines.skin[shadows]);
            pass.set_bind_group(0, &self.picture, &[]);
            pass.set_bind_group(1, maps.group(), &[]);
            pass.set_bind_group(2, &covered, &[]);
            pass.set_vertex_buffer(1, environment.on_skin.slice(..));
            pass.set_vertex_buffer(2, skin.tints().slice(..));
            skin.draw(&mut pass);
        }
    }
}
