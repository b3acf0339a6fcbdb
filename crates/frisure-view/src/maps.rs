//! Maps of what keeps the lamps' light out: hair by density, the head by depth.

use bytemuck::cast_slice;
use wgpu::{
    BindGroup, Buffer, BufferUsages, CommandEncoder, Device, Queue, Texture, TextureFormat,
    TextureUsages,
};

use crate::frame::{Frame, Shadows};
use crate::gpu::{self, DEPTH, LIGHT};
use crate::lamps::{FIRST_MAP, HAIR_MAP, HEAD_MAP, LAMPS, Lamp};
use crate::renderer::Renderer;

/// Pieces of hair that are enough for a density map, and while something moves.
const PIECES: [usize; 2] = [250_000, 50_000];
/// Layers of a density map over numbers in a texel.
const QUARTERS: u32 = 4;
/// Where there is no hair (m), as far as 16 bits can say.
const FAR: f64 = 60_000.0;

/// The maps of all lamps.
#[derive(Debug)]
pub(crate) struct Maps {
    first: Texture,
    met: Texture,
    head: Texture,
    head_depth: wgpu::TextureView,
    shadows: BindGroup,
    /// Numbers of the lamp whose maps are drawn.
    current: (Buffer, BindGroup),
    /// First vertices of pieces.
    pieces: Option<(u64, usize, u32, Buffer)>,
    hair_key: Option<(u64, usize, Vec<Lamp>)>,
    head_key: Option<(u64, Vec<Lamp>)>,
}

impl Maps {
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

    /// What shaders read.
    pub(crate) fn group(&self) -> &BindGroup {
        &self.shadows
    }

    /// Draws what has changed.
    pub(crate) fn draw(
        &mut self,
        renderer: &Renderer,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        (picture, ribbons): (&BindGroup, Option<&BindGroup>),
        frame: &Frame<'_>,
        lamps: &[Lamp],
    ) {
        let places: Vec<Lamp> = lamps.iter().map(Lamp::place).collect();
        let most = match frame.shadows {
            Shadows::None => None,
            Shadows::Coarse => Some(PIECES[1]),
            Shadows::Fine => Some(PIECES[0]),
        };
        let some = frame.hair.and_then(|hair| most.map(|most| hair.some(most)));
        let factor = some.map_or(1.0, |(_, factor)| factor);
        for i in 0..LAMPS {
            let numbers = [i as f32, factor, FIRST_MAP as f32, 0.0];
            queue.write_buffer(&self.current.0, STRIDE * i as u64, cast_slice(&numbers));
        }
        if let Some(skin) = frame.skin {
            let key = Some((skin.version(), places.clone()));
            if self.head_key != key {
                self.draw_head(renderer, encoder, picture, skin, lamps.len());
                self.head_key = key;
            }
        }
        let (Some(hair), Some(ribbons)) = (frame.hair, ribbons) else { return };
        let Some((strands, _)) = some else { return };
        let key = Some((hair.shape(), strands, places));
        if self.hair_key == key {
            return;
        }
        if self.pieces.as_ref().is_none_or(|p| (p.0, p.1) != (hair.shape(), strands)) {
            let pieces = hair.pieces_of(strands);
            let usage = BufferUsages::VERTEX;
            let buffer = gpu::buffer(device, queue, "some pieces", cast_slice(&pieces), usage);
            self.pieces = Some((hair.shape(), strands, pieces.len() as u32, buffer));
        }
        let view = gpu::layers(&self.first);
        let resources = [
            wgpu::BindingResource::TextureView(&hair.places()),
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&renderer.sampler),
        ];
        let density = gpu::group(device, &renderer.layouts.density, &resources);
        for i in 0..lamps.len() {
            self.draw_first(renderer, encoder, picture, ribbons, i);
            self.draw_density(renderer, encoder, picture, &density, i);
        }
        self.hair_key = key;
    }

    /// Where hair begins.
    fn draw_first(
        &self,
        renderer: &Renderer,
        encoder: &mut CommandEncoder,
        picture: &BindGroup,
        ribbons: &BindGroup,
        lamp: usize,
    ) {
        let Some((_, _, count, pieces)) = &self.pieces else { return };
        let view = gpu::one_layer(&self.first, lamp as u32);
        let targets = [gpu::target(&view, Some([FAR; 4]))];
        let mut pass = gpu::pass(encoder, "first hair", &targets, None);
        pass.set_pipeline(&renderer.pipelines.first);
        pass.set_bind_group(0, picture, &[]);
        pass.set_bind_group(1, ribbons, &[]);
        pass.set_bind_group(2, &self.current.1, &[STRIDE as u32 * lamp as u32]);
        pass.set_vertex_buffer(0, pieces.slice(..));
        pass.draw(0..4, 0..*count);
    }

    /// How much hair is met up to each layer.
    fn draw_density(
        &self,
        renderer: &Renderer,
        encoder: &mut CommandEncoder,
        picture: &BindGroup,
        density: &BindGroup,
        lamp: usize,
    ) {
        let Some((_, _, count, pieces)) = &self.pieces else { return };
        let views = [0, 1, 2, 3].map(|i| gpu::one_layer(&self.met, QUARTERS * lamp as u32 + i));
        let targets = views.each_ref().map(|view| gpu::target(view, Some([0.0; 4])));
        let mut pass = gpu::pass(encoder, "density", &targets, None);
        pass.set_pipeline(&renderer.pipelines.density);
        pass.set_bind_group(0, picture, &[]);
        pass.set_bind_group(1, density, &[]);
        pass.set_bind_group(2, &self.current.1, &[STRIDE as u32 * lamp as u32]);
        pass.set_vertex_buffer(0, pieces.slice(..));
        pass.draw(0..4, 0..*count);
    }

    /// Depth of the head from each lamp.
    fn draw_head(
        &self,
        renderer: &Renderer,
        encoder: &mut CommandEncoder,
        picture: &BindGroup,
        skin: &crate::Skin,
        lamps: usize,
    ) {
        for i in 0..lamps as u32 {
            let view = gpu::one_layer(&self.head, i);
            let targets = [gpu::target(&view, Some([FAR; 4]))];
            let depth = Some(gpu::depth_target(&self.head_depth, true));
            let mut pass = gpu::pass(encoder, "head from a lamp", &targets, depth);
            pass.set_pipeline(&renderer.pipelines.head_depth);
            pass.set_bind_group(0, picture, &[]);
            pass.set_bind_group(1, &self.current.1, &[STRIDE as u32 * i]);
            skin.draw(&mut pass);
        }
    }
}

/// Bytes from one lamp's numbers to the next's.
const STRIDE: u64 = 256;
