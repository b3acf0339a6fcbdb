//! Pipelines.

use wgpu::{
    BindGroupLayout, BlendComponent, BlendFactor, BlendOperation, BlendState, CompareFunction,
    Device, RenderPipeline, Sampler, ShaderModule, TextureFormat, VertexAttribute,
    VertexBufferLayout, VertexStepMode, vertex_attr_array,
};

use crate::gpu::{self, LIGHT, PipelineSpec, Slot};

/// All that is made once for a device and the format of what the picture is shown on.
#[derive(Debug)]
pub struct Renderer {
    pub(crate) layouts: Layouts,
    pub(crate) pipelines: Pipelines,
    pub(crate) sampler: Sampler,
    /// Samples per pixel of the head.
    pub(crate) samples: u32,
}

/// Groups of what shaders are given.
#[derive(Debug)]
pub(crate) struct Layouts {
    pub(crate) picture: BindGroupLayout,
    pub(crate) shadows: BindGroupLayout,
    pub(crate) hair: BindGroupLayout,
    pub(crate) environment: BindGroupLayout,
    pub(crate) ribbons: BindGroupLayout,
    pub(crate) pieces: BindGroupLayout,
    pub(crate) density: BindGroupLayout,
    pub(crate) current: BindGroupLayout,
    pub(crate) finish: BindGroupLayout,
    pub(crate) compose: BindGroupLayout,
    pub(crate) show: BindGroupLayout,
}

/// Render pipelines.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub(crate) first: RenderPipeline,
    pub(crate) density: RenderPipeline,
    pub(crate) head_depth: RenderPipeline,
    pub(crate) shade: RenderPipeline,
    /// Without and with shadows of hair and soft ones of the head.
    pub(crate) skin: [RenderPipeline; 2],
    pub(crate) skin_depth: RenderPipeline,
    pub(crate) hair: RenderPipeline,
    pub(crate) finish: RenderPipeline,
    /// Without and with the environment as the background.
    pub(crate) compose: [RenderPipeline; 2],
    pub(crate) lines: RenderPipeline,
    pub(crate) lines_on_top: RenderPipeline,
    pub(crate) show: RenderPipeline,
}

impl Renderer {
    /// For a device, and for passes over targets of the format `output` with one sample per pixel. The head's
    /// edges have `samples` samples per pixel: 4, or 1 for what is less, which says that the device is slow: hair is
    /// drawn with fewer pieces, too.
    #[must_use]
    pub fn new(device: &Device, _queue: &wgpu::Queue, output: TextureFormat, samples: u32) -> Self {
        let samples = if samples >= 4 { 4 } else { 1 };
        let layouts = Layouts::new(device);
        let pipelines = Pipelines::new(device, &layouts, output, samples);
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("smooth"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        Self { layouts, pipelines, sampler, samples }
    }
}

impl Layouts {
    fn new(device: &Device) -> Self {
        let (sharp, smooth) = (Slot::Flat { smooth: false }, Slot::Flat { smooth: true });
        let (layers, sampler) = (Slot::Layers { smooth: true }, Slot::Sampler);
        let of = |label, slots: &[Slot]| gpu::layout(device, label, slots);
        Self {
            picture: of("picture", &[Slot::Uniform]),
            shadows: of("shadows", &[layers, layers, Slot::Layers { smooth: false }, sampler]),
            hair: of("hair", &[sharp, Slot::Whole, sharp, sharp, sharp, sharp]),
            environment: of("environment", &[Slot::Volume]),
            ribbons: of("ribbons", &[sharp, sharp]),
            pieces: of("pieces", &[Slot::Whole]),
            density: of("density", &[sharp, layers, sampler]),
            current: of("current lamp", &[Slot::Dynamic]),
            finish: of("finish", &[sharp]),
            compose: of("compose", &[sharp, sharp, smooth, sampler]),
            show: of("show", &[smooth, sampler]),
        }
    }
}

/// The shaders' parts put together.
fn module(device: &Device, label: &str, parts: &[&str]) -> ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(parts.concat().into()),
    })
}

const COMMON: &str = include_str!("shaders/common.wgsl");
const LAYERS: &str = include_str!("shaders/layers.wgsl");
const SHADOWS: &str = include_str!("shaders/shadows.wgsl");
const RIBBON: &str = include_str!("shaders/ribbon.wgsl");

/// `source · a + target · b`, for colour and opacity alike.
fn blend(a: BlendFactor, b: BlendFactor, operation: BlendOperation) -> Option<BlendState> {
    let part = BlendComponent { src_factor: a, dst_factor: b, operation };
    Some(BlendState { color: part, alpha: part })
}

type Buffer = Option<VertexBufferLayout<'static>>;

const fn buffer(
    array_stride: u64,
    step_mode: VertexStepMode,
    attributes: &'static [VertexAttribute],
) -> Buffer {
    Some(VertexBufferLayout { array_stride, step_mode, attributes })
}

/// One number per copy of a shape.
const LEVEL: Buffer = buffer(4, VertexStepMode::Instance, &vertex_attr_array![0 => Float32]);
const STROKE: Buffer = buffer(
    48,
    VertexStepMode::Instance,
    &vertex_attr_array![0 => Float32x4, 1 => Float32x4, 2 => Float32x4],
);
/// Positions of a buffer of positions and normals.
const POSITION: Buffer = buffer(24, VertexStepMode::Vertex, &vertex_attr_array![0 => Float32x3]);
const SKIN: Buffer =
    buffer(24, VertexStepMode::Vertex, &vertex_attr_array![0 => Float32x3, 1 => Float32x3]);
/// Ambient light at the vertices of the head.
const ROOM: Buffer = buffer(12, VertexStepMode::Vertex, &vertex_attr_array![2 => Float32x3]);
/// Tint of the head at its vertices.
const TINT: Buffer = buffer(16, VertexStepMode::Vertex, &vertex_attr_array![3 => Float32x4]);

impl Pipelines {
    fn new(device: &Device, l: &Layouts, output: TextureFormat, samples: u32) -> Self {
        let own = include_str!("shaders/density.wgsl");
        let density = module(device, "density", &[COMMON, LAYERS, RIBBON, own]);
        let surface = module(device, "surface", &[COMMON, include_str!("shaders/surface.wgsl")]);
        let lines = module(device, "lines", &[COMMON, include_str!("shaders/lines.wgsl")]);
        let stroke = |label, depth| stroke(device, l, &lines, label, depth);
        Self {
            first: first(device, l, &density),
            density: self::density(device, l, &density),
            head_depth: head_depth(device, l, &surface),
            shade: shade(device, l),
            skin: skin(device, l, samples),
            skin_depth: skin_depth(device, l, &surface),
            hair: hair(device, l),
            finish: finish(device, l),
            compose: compose(device, l),
            lines: stroke("lines", CompareFunction::Less),
            lines_on_top: stroke("lines on top", CompareFunction::Always),
            show: show(device, l, output),
        }
    }
}

/// A pipeline without groups, buffers, targets and depth.
fn plain<'a>(label: &'a str, shader: &'a ShaderModule, vertex: &'a str) -> PipelineSpec<'a> {
    PipelineSpec {
        label,
        shader,
        vertex,
        fragment: None,
        groups: &[],
        buffers: &[],
        targets: &[],
        depth: None,
        samples: 1,
        constants: &[],
        strip: false,
    }
}

fn first(device: &Device, l: &Layouts, shader: &ShaderModule) -> RenderPipeline {
    let least = blend(BlendFactor::One, BlendFactor::One, BlendOperation::Min);
    PipelineSpec {
        fragment: Some("nearest"),
        groups: &[&l.picture, &l.ribbons, &l.current, &l.pieces],
        targets: &[(TextureFormat::R16Float, least)],
        ..plain("first hair", shader, "first_vertex")
    }
    .pipeline(device)
}

fn density(device: &Device, l: &Layouts, shader: &ShaderModule) -> RenderPipeline {
    let sum = blend(BlendFactor::One, BlendFactor::One, BlendOperation::Add);
    PipelineSpec {
        fragment: Some("lay"),
        groups: &[&l.picture, &l.density, &l.current, &l.pieces],
        targets: &[(LIGHT, sum); 4],
        ..plain("density", shader, "ribbon")
    }
    .pipeline(device)
}

fn head_depth(device: &Device, l: &Layouts, shader: &ShaderModule) -> RenderPipeline {
    PipelineSpec {
        fragment: Some("depth"),
        groups: &[&l.picture, &l.current],
        buffers: &[POSITION],
        targets: &[(TextureFormat::R16Float, None)],
        depth: Some((CompareFunction::Less, true)),
        ..plain("head from a lamp", shader, "from_lamp")
    }
    .pipeline(device)
}

fn shade(device: &Device, l: &Layouts) -> RenderPipeline {
    let own = include_str!("shaders/shade.wgsl");
    let shader = module(device, "shade", &[COMMON, LAYERS, SHADOWS, own]);
    PipelineSpec {
        fragment: Some("shade"),
        groups: &[&l.picture, &l.shadows, &l.hair, &l.environment],
        targets: &[(LIGHT, None)],
        ..plain("shade", &shader, "every_vertex")
    }
    .pipeline(device)
}

/// Without and with shadows: see the shader's constant.
fn skin(device: &Device, l: &Layouts, samples: u32) -> [RenderPipeline; 2] {
    let own = include_str!("shaders/skin.wgsl");
    let shader = module(device, "skin", &[COMMON, LAYERS, SHADOWS, own]);
    [0.0, 1.0].map(|on| {
        PipelineSpec {
            fragment: Some("skin"),
            groups: &[&l.picture, &l.shadows, &l.finish],
            buffers: &[SKIN, ROOM, TINT],
            targets: &[(LIGHT, None)],
            depth: Some((CompareFunction::Less, true)),
            samples,
            constants: &[("SHADOWS", on)],
            ..plain("skin", &shader, "skin_vertex")
        }
        .pipeline(device)
    })
}

fn skin_depth(device: &Device, l: &Layouts, shader: &ShaderModule) -> RenderPipeline {
    PipelineSpec {
        groups: &[&l.picture],
        buffers: &[POSITION],
        depth: Some((CompareFunction::Less, true)),
        ..plain("depth of the head", shader, "from_eye")
    }
    .pipeline(device)
}

fn hair(device: &Device, l: &Layouts) -> RenderPipeline {
    let shader = module(device, "hair", &[COMMON, RIBBON, include_str!("shaders/hair.wgsl")]);
    // Pieces are drawn from front to back.
    let under = blend(BlendFactor::OneMinusDstAlpha, BlendFactor::One, BlendOperation::Add);
    PipelineSpec {
        fragment: Some("paint"),
        groups: &[&l.picture, &l.ribbons, &l.pieces],
        targets: &[(LIGHT, under)],
        depth: Some((CompareFunction::Less, false)),
        ..plain("hair", &shader, "ribbon")
    }
    .pipeline(device)
}

fn finish(device: &Device, l: &Layouts) -> RenderPipeline {
    let shader = module(device, "finish", &[COMMON, include_str!("shaders/finish.wgsl")]);
    PipelineSpec {
        fragment: Some("close"),
        groups: &[&l.picture, &l.finish],
        buffers: &[LEVEL],
        depth: Some((CompareFunction::Less, true)),
        ..plain("finish", &shader, "at_depth")
    }
    .pipeline(device)
}

/// Without and with the environment: see the shader's constant.
fn compose(device: &Device, l: &Layouts) -> [RenderPipeline; 2] {
    let shader = module(device, "compose", &[COMMON, include_str!("shaders/compose.wgsl")]);
    [0.0, 1.0].map(|on| {
        PipelineSpec {
            fragment: Some("compose"),
            groups: &[&l.picture, &l.compose],
            targets: &[(TextureFormat::Rgba8Unorm, None)],
            constants: &[("AROUND", on)],
            ..plain("compose", &shader, "whole")
        }
        .pipeline(device)
    })
}

fn stroke(
    device: &Device,
    l: &Layouts,
    shader: &ShaderModule,
    label: &str,
    compare: CompareFunction,
) -> RenderPipeline {
    PipelineSpec {
        fragment: Some("ink"),
        groups: &[&l.picture],
        buffers: &[STROKE],
        targets: &[(TextureFormat::Rgba8Unorm, Some(BlendState::ALPHA_BLENDING))],
        depth: Some((compare, false)),
        strip: true,
        ..plain(label, shader, "stroke")
    }
    .pipeline(device)
}

fn show(device: &Device, l: &Layouts, output: TextureFormat) -> RenderPipeline {
    let shader = module(device, "show", &[include_str!("shaders/show.wgsl")]);
    let fragment = if output.is_srgb() { "show_linear" } else { "show_encoded" };
    PipelineSpec {
        fragment: Some(fragment),
        groups: &[&l.show],
        targets: &[(output, Some(BlendState::PREMULTIPLIED_ALPHA_BLENDING))],
        ..plain("show", &shader, "whole")
    }
    .pipeline(device)
}
