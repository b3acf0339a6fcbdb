//! Shadow maps of the lamps: of hair by density, of the head by depth.

use bytemuck::cast_slice;
use wgpu::{
    BindGroup, Buffer, BufferUsages, CommandEncoder, Device, Queue, Texture, TextureFormat,
    TextureUsages,
};

use crate::context::FrameContext;
use crate::frame::Shadows;
use crate::gpu::{self, DEPTH, LIGHT};
use crate::hair::Hair;
use crate::lamps::{FIRST_MAP, HAIR_MAP, HEAD_MAP, LAMPS, Lamp};
use crate::pieces::Pieces;
use crate::renderer::Renderer;
use crate::skin::Skin;

/// Pieces of hair that are enough for a density map, and while something moves.
const PIECES: [usize; 2] = [250_000, 50_000];
/// Layers of a density map over numbers in a texel.
const QUARTERS: u32 = 4;
/// Depth of texels without hair (m), near the largest number of 16 bits.
const FAR: f64 = 60_000.0;

/// The maps of all lamps.
#[derive(Debug)]
pub(crate) struct ShadowMaps {
    first: Texture,
    met: Texture,
    head: Texture,
    head_depth: wgpu::TextureView,
    shadows: BindGroup,
    /// Numbers of the lamp whose maps are drawn.
    current: (Buffer, BindGroup),
    /// Pieces of a shape and a number of strands.
    pieces: Option<(u64, usize, Pieces)>,
    hair_key: Option<(u64, usize, Vec<Lamp>)>,
    head_key: Option<(u64, Vec<Lamp>)>,
}

impl ShadowMaps {
    pub(crate) fn new(renderer: &Renderer, device: &Device, queue: &Queue) -> Self {
        let drawn = TextureUsages::RENDER_ATTACHMENT;
        let of = |label, side, layers, format| {
            gpu::texture(device, label, [side, side, layers], format, drawn)
        };
        let lamps = LAMPS as u32;
        let first = of("first hair", FIRST_MAP, lamps, TextureFormat::R16Float);
        let met = of("hair met", HAIR_MAP, QUARTERS * lamps, LIGHT);
        let head = of("head from lamps", HEAD_MAP, lamps, TextureFormat::R16Float);
        let depth =
            gpu::texture(device, "depth from a lamp", [HEAD_MAP, HEAD_MAP, 1], DEPTH, drawn);
        let views = [&first, &met, &head].map(gpu::layers);
        let [a, b, c] = views.each_ref().map(wgpu::BindingResource::TextureView);
        let sampler = wgpu::BindingResource::Sampler(&renderer.sampler);
        let shadows = gpu::group(device, &renderer.layouts.shadows, &[a, b, c, sampler]);
        let bytes = [0; STRIDE as usize * LAMPS];
        let buffer = gpu::buffer(device, queue, "current lamp", &bytes, BufferUsages::UNIFORM);
        let one =
            wgpu::BufferBinding { buffer: &buffer, offset: 0, size: wgpu::BufferSize::new(16) };
        let one = [wgpu::BindingResource::Buffer(one)];
        let group = gpu::group(device, &renderer.layouts.current, &one);
        Self {
            first,
            met,
            head,
            head_depth: gpu::whole(&depth),
            shadows,
            current: (buffer, group),
            pieces: None,
            hair_key: None,
            head_key: None,
        }
    }

    /// The bind group of the shaders.
    pub(crate) fn group(&self) -> &BindGroup {
        &self.shadows
    }

    /// Draws what has changed.
    pub(crate) fn draw(
        &mut self,
        job: &FrameContext<'_>,
        encoder: &mut CommandEncoder,
        ribbons: Option<&BindGroup>,
    ) {
        let places: Vec<Lamp> = job.lamps.iter().map(Lamp::place).collect();
        let most = match job.frame.shadows {
            Shadows::None => None,
            Shadows::Coarse => Some(PIECES[1]),
            Shadows::Fine => Some(PIECES[0]),
        };
        let some = job.frame.hair.and_then(|hair| Some((hair, hair.some(most?))));
        let factor = some.map_or(1.0, |(_, (_, factor))| factor);
        for i in 0..LAMPS {
            let numbers = [i as f32, factor, FIRST_MAP as f32, 0.0];
            job.queue.write_buffer(&self.current.0, STRIDE * i as u64, cast_slice(&numbers));
        }
        if let Some(skin) = job.frame.skin {
            let key = Some((skin.version(), places.clone()));
            if self.head_key != key {
                self.draw_head(job, encoder, skin);
                self.head_key = key;
            }
        }
        let (Some((hair, (strands, _))), Some(ribbons)) = (some, ribbons) else { return };
        let key = Some((hair.shape(), strands, places));
        if self.hair_key != key {
            self.draw_hair(job, encoder, ribbons, hair, strands);
            self.hair_key = key;
        }
    }

    /// The density maps of some strands from all lamps.
    fn draw_hair(
        &mut self,
        job: &FrameContext<'_>,
        encoder: &mut CommandEncoder,
        ribbons: &BindGroup,
        hair: &Hair,
        strands: usize,
    ) {
        if self.pieces.as_ref().is_none_or(|p| (p.0, p.1) != (hair.shape(), strands)) {
            let (some, old) = (hair.pieces_of(strands), self.pieces.take().map(|known| known.2));
            let pieces = Pieces::new(job.renderer, job.device, job.queue, some, old);
            self.pieces = Some((hair.shape(), strands, pieces));
        }
        let view = gpu::layers(&self.first);
        let resources = [
            wgpu::BindingResource::TextureView(&hair.places()),
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&job.renderer.sampler),
        ];
        let density = gpu::group(job.device, &job.renderer.layouts.density, &resources);
        for i in 0..job.lamps.len() as u32 {
            self.draw_first(job, encoder, ribbons, i);
            self.draw_density(job, encoder, &density, i);
        }
    }

    /// Draws the depth of the first hair from a lamp.
    fn draw_first(
        &self,
        job: &FrameContext<'_>,
        encoder: &mut CommandEncoder,
        ribbons: &BindGroup,
        lamp: u32,
    ) {
        let view = gpu::one_layer(&self.first, lamp);
        let targets = [gpu::target(&view, Some([FAR; 4]))];
        let mut pass = gpu::pass(encoder, "first hair", &targets, None);
        pass.set_pipeline(&job.renderer.pipelines.first);
        pass.set_bind_group(1, ribbons, &[]);
        self.draw_pieces(job, &mut pass, lamp);
    }

    /// How much hair is met up to each layer.
    fn draw_density(
        &self,
        job: &FrameContext<'_>,
        encoder: &mut CommandEncoder,
        density: &BindGroup,
        lamp: u32,
    ) {
        let views = [0, 1, 2, 3].map(|i| gpu::one_layer(&self.met, QUARTERS * lamp + i));
        let targets = views.each_ref().map(|view| gpu::target(view, Some([0.0; 4])));
        let mut pass = gpu::pass(encoder, "density", &targets, None);
        pass.set_pipeline(&job.renderer.pipelines.density);
        pass.set_bind_group(1, density, &[]);
        self.draw_pieces(job, &mut pass, lamp);
    }

    /// The pieces, with the pipeline and the group 1 that are set.
    fn draw_pieces(&self, job: &FrameContext<'_>, pass: &mut wgpu::RenderPass<'_>, lamp: u32) {
        let Some((_, _, pieces)) = &self.pieces else { return };
        pass.set_bind_group(0, &job.picture, &[]);
        pass.set_bind_group(2, &self.current.1, &[STRIDE as u32 * lamp]);
        pieces.draw(pass, 3, 0..pieces.count());
    }

    /// Depth of the head from each lamp.
    fn draw_head(&self, job: &FrameContext<'_>, encoder: &mut CommandEncoder, skin: &Skin) {
        for i in 0..job.lamps.len() as u32 {
            let view = gpu::one_layer(&self.head, i);
            let targets = [gpu::target(&view, Some([FAR; 4]))];
            let depth = Some(gpu::depth_target(&self.head_depth, true));
            let mut pass = gpu::pass(encoder, "head from a lamp", &targets, depth);
            pass.set_pipeline(&job.renderer.pipelines.head_depth);
            pass.set_bind_group(0, &job.picture, &[]);
            pass.set_bind_group(1, &self.current.1, &[STRIDE as u32 * i]);
            skin.draw(&mut pass);
        }
    }
}

/// Bytes from one lamp's numbers to the next's.
const STRIDE: u64 = 256;
