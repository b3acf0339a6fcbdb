//! Lists of pieces of hair on the device.

use std::ops::Range;

use bytemuck::cast_slice;
use wgpu::{BindGroup, BindingResource, Device, Queue, RenderPass, Texture, TextureFormat};

use crate::gpu;
use crate::hair::ROW;
use crate::renderer::Renderer;

/// Corners of a piece: two triangles, as `shaders/ribbon.wgsl` has them.
const CORNERS: u32 = 6;

/// The first vertices of pieces, in the order in which they are drawn.
///
/// Shaders look a piece up by the number of its corner. Copies of one rectangle would need two corners less, but software rasterisers
/// draw each copy as a picture of its own: `SwiftShader`, which draws in browsers without a graphics card, takes 14 us for one.
#[derive(Debug)]
pub(crate) struct Pieces {
    list: Texture,
    group: BindGroup,
    count: u32,
}

impl Pieces {
    /// Puts a list on the device, into the texture of one that is no longer needed if there is room.
    pub(crate) fn new(
        renderer: &Renderer,
        device: &Device,
        queue: &Queue,
        mut pieces: Vec<u32>,
        old: Option<Self>,
    ) -> Self {
        let count = pieces.len() as u32;
        let rows = count.div_ceil(ROW).max(1);
        pieces.resize((rows * ROW) as usize, 0);
        let mut list = old.filter(|old| old.list.height() >= rows).unwrap_or_else(|| {
            let usage = wgpu::TextureUsages::COPY_DST;
            let list =
                gpu::texture(device, "pieces", [ROW, rows, 1], TextureFormat::R32Uint, usage);
            let resources = [BindingResource::TextureView(&gpu::whole(&list))];
            let group = gpu::group(device, &renderer.layouts.pieces, &resources);
            Self { list, group, count }
        });
        list.count = count;
        gpu::fill(queue, &list.list, ROW as usize * 4, cast_slice(&pieces));
        list
    }

    /// How many there are.
    pub(crate) fn count(&self) -> u32 {
        self.count
    }

    /// Draws some of them, with the list as the bind group `group` of the shaders.
    pub(crate) fn draw(&self, pass: &mut RenderPass<'_>, group: u32, some: Range<u32>) {
        pass.set_bind_group(group, &self.group, &[]);
        pass.draw(CORNERS * some.start..CORNERS * some.end, 0..1);
    }
}
