//! Light of the environment on the device: a grid around hair and head.

use bytemuck::cast_slice;
use frisure_look::EnvironmentLight;
use frisure_render::preview::{AmbientLight, DIRECTION_COUNT};
use glam::Vec3;
use wgpu::{BufferUsages, Device, Queue, TextureDimension, TextureFormat, TextureUsages};

use crate::gpu;
use crate::hair::Hair;
use crate::skin::Skin;

/// Most nodes along a side of the grid. Chosen for speed.
const CELLS: f32 = 48.0;
/// Pieces of hair that are enough to know how much hair is where. Chosen for speed.
const PIECES: usize = 150_000;

/// The grid, and what of the environment each vertex of the head has.
#[derive(Debug)]
pub(crate) struct AmbientVolume {
    pub(crate) low: Vec3,
    pub(crate) per_metre: f32,
    pub(crate) size: Vec3,
    pub(crate) group: wgpu::BindGroup,
    pub(crate) on_skin: wgpu::Buffer,
}

impl AmbientVolume {
    pub(crate) fn new(
        layout: &wgpu::BindGroupLayout,
        device: &Device,
        queue: &Queue,
        (hair, skin): (Option<&Hair>, Option<&Skin>),
        environment: [Vec3; DIRECTION_COUNT],
    ) -> Self {
        let (strands, factor) = hair.map_or((0, 1.0), |hair| hair.some(PIECES));
        let occluders = hair.into_iter().flat_map(|hair| hair.occluders(strands, factor));
        let extinction = hair.map_or(Vec3::ONE, Hair::extinction);
        let light =
            AmbientLight::new(occluders, skin.map(Skin::surface), environment, extinction, CELLS);
        let (low, cell, size) = light.grid();
        let nodes: Vec<[u16; 4]> =
            light.nodes().iter().map(|n| gpu::halves([n.x, n.y, n.z, 0.0])).collect();
        let texture = gpu::texture_of(
            device,
            "environment",
            size.to_array(),
            TextureDimension::D3,
            TextureFormat::Rgba16Float,
            TextureUsages::COPY_DST,
        );
        gpu::fill(queue, &texture, size.x as usize * 8, cast_slice(&nodes));
        let view = gpu::whole(&texture);
        let on_skin: Vec<[f32; 3]> = skin
            .into_iter()
            .flat_map(Skin::places)
            .map(|(p, n)| light.on_surface(p, n).to_array())
            .collect();
        Self {
            low,
            per_metre: 1.0 / cell,
            size: size.as_vec3(),
            group: gpu::group(device, layout, &[wgpu::BindingResource::TextureView(&view)]),
            on_skin: gpu::buffer(
                device,
                queue,
                "environment on the head",
                cast_slice(&on_skin),
                BufferUsages::VERTEX,
            ),
        }
    }
}

/// Texels across and down of the environment map.
const AROUND_SIZE: [u32; 2] = [512, 256];

/// The environment light as an equirectangular texture. One texel without a light.
pub(crate) fn environment_texture(
    device: &Device,
    queue: &Queue,
    environment: Option<&EnvironmentLight>,
) -> wgpu::Texture {
    let [width, height] = if environment.is_some() { AROUND_SIZE } else { [1, 1] };
    let format = TextureFormat::Rgba16Float;
    let usage = TextureUsages::COPY_DST;
    let texture = gpu::texture(device, "environment_map", [width, height, 1], format, usage);
    let Some(environment) = environment else { return texture };
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let light = texels.map(|(x, y)| {
        let turn = ((x as f32 + 0.5) / width as f32 - 0.5) * std::f32::consts::TAU;
        let (sine, cosine) = ((y as f32 + 0.5) / height as f32 * std::f32::consts::PI).sin_cos();
        let [r, g, b] = environment
            .radiance_interpolated(Vec3::new(sine * turn.cos(), sine * turn.sin(), cosine))
            .to_array();
        gpu::halves([r, g, b, 1.0])
    });
    let light: Vec<[u16; 4]> = light.collect();
    gpu::fill(queue, &texture, width as usize * 8, cast_slice(&light));
    texture
}
