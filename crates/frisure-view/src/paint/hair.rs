//! Hair: light at each vertex, then ribbons from near to far.

use wgpu::CommandEncoder;

use crate::cache::FrameCache;
use crate::canvas::Canvas;
use crate::context::FrameContext;
use crate::gpu;
use crate::hair::ROW;
use crate::ribbons::Sorted;

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
                sorted.pieces.draw(&mut pass, 2, begin..end);
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
