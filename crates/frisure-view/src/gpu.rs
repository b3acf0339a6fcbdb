//! Short functions for layouts, textures, buffers, pipelines and passes of wgpu.

use std::sync::atomic::{AtomicU64, Ordering};

use half::f16;
use wgpu::{
    BindGroup, BindGroupLayout, BindGroupLayoutEntry, BindingType, BlendState, CompareFunction,
    Device, Extent3d, RenderPipeline, ShaderModule, Texture, TextureDimension, TextureFormat,
    TextureSampleType, TextureUsages, TextureViewDimension,
};

/// Format of light on its way to the eye.
pub(crate) const LIGHT: TextureFormat = TextureFormat::Rgba16Float;
/// Format of depths that are compared by the hardware.
pub(crate) const DEPTH: TextureFormat = TextureFormat::Depth32Float;

/// The type of a binding.
#[derive(Clone, Copy)]
pub(crate) enum Slot {
    Uniform,
    /// One of several pieces of a buffer.
    Dynamic,
    /// A picture that is read between its texels, or not.
    Flat {
        smooth: bool,
    },
    Whole,
    Layers {
        smooth: bool,
    },
    Volume,
    Sampler,
}

impl Slot {
    fn binding(self) -> BindingType {
        let texture = |sample_type, view_dimension| BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        let float = |filterable| TextureSampleType::Float { filterable };
        let uniform = |has_dynamic_offset| BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset,
            min_binding_size: None,
        };
        match self {
            Self::Uniform => uniform(false),
            Self::Dynamic => uniform(true),
            Self::Flat { smooth } => texture(float(smooth), TextureViewDimension::D2),
            Self::Whole => texture(TextureSampleType::Uint, TextureViewDimension::D2),
            Self::Layers { smooth } => texture(float(smooth), TextureViewDimension::D2Array),
            Self::Volume => texture(float(true), TextureViewDimension::D3),
            Self::Sampler => BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
        }
    }
}

/// The layout of a group with these slots.
pub(crate) fn layout(device: &Device, label: &str, slots: &[Slot]) -> BindGroupLayout {
    let entry = |(binding, slot): (u32, &Slot)| BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: slot.binding(),
        count: None,
    };
    let entries: Vec<_> = (0..).zip(slots).map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// A group of what its slots hold.
pub(crate) fn group(
    device: &Device,
    layout: &BindGroupLayout,
    resources: &[wgpu::BindingResource<'_>],
) -> BindGroup {
    let entries: Vec<_> = (0..)
        .zip(resources)
        .map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource: resource.clone() })
        .collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
}

/// A view of all of a texture.
pub(crate) fn whole(texture: &Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// A view of all layers of a texture.
pub(crate) fn layers(texture: &Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2Array),
        ..Default::default()
    })
}

/// A view of one layer.
pub(crate) fn one_layer(texture: &Texture, layer: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

/// A texture that shaders read, and that is written from here or drawn on.
pub(crate) fn texture(
    device: &Device,
    label: &str,
    [width, height, depth]: [u32; 3],
    format: TextureFormat,
    usage: TextureUsages,
) -> Texture {
    texture_of(device, label, [width, height, depth], TextureDimension::D2, format, usage)
}

/// A texture of any dimension that shaders read.
pub(crate) fn texture_of(
    device: &Device,
    label: &str,
    [width, height, depth]: [u32; 3],
    dimension: TextureDimension,
    format: TextureFormat,
    usage: TextureUsages,
) -> Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: Extent3d { width, height, depth_or_array_layers: depth },
        mip_level_count: 1,
        sample_count: 1,
        dimension,
        format,
        usage: usage | TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

/// A target with several samples per pixel, which no shader reads.
pub(crate) fn samples(
    device: &Device,
    label: &str,
    [width, height]: [u32; 2],
    format: TextureFormat,
    sample_count: u32,
) -> Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count,
        dimension: TextureDimension::D2,
        format,
        usage: TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}

/// A buffer with these bytes in it, or room for one number where there are none.
pub(crate) fn buffer(
    device: &Device,
    queue: &wgpu::Queue,
    label: &str,
    bytes: &[u8],
    usage: wgpu::BufferUsages,
) -> wgpu::Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: (bytes.len() as u64).max(16).next_multiple_of(4),
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    if !bytes.is_empty() {
        queue.write_buffer(&buffer, 0, bytes);
    }
    buffer
}

/// The description of a render pipeline.
pub(crate) struct PipelineSpec<'a> {
    pub(crate) label: &'a str,
    pub(crate) shader: &'a ShaderModule,
    pub(crate) vertex: &'a str,
    pub(crate) fragment: Option<&'a str>,
    pub(crate) groups: &'a [&'a BindGroupLayout],
    pub(crate) buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    pub(crate) targets: &'a [(TextureFormat, Option<BlendState>)],
    /// Comparison with the depth buffer, and whether it is written.
    pub(crate) depth: Option<(CompareFunction, bool)>,
    pub(crate) samples: u32,
    /// Constants of the shaders (`override` in WGSL).
    pub(crate) constants: &'a [(&'a str, f64)],
    /// Four corners make a rectangle.
    pub(crate) strip: bool,
}

impl PipelineSpec<'_> {
    pub(crate) fn pipeline(&self, device: &Device) -> RenderPipeline {
        let groups: Vec<_> = self.groups.iter().map(|group| Some(*group)).collect();
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(self.label),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let targets: Vec<_> = self
            .targets
            .iter()
            .map(|&(format, blend)| {
                let write_mask = wgpu::ColorWrites::ALL;
                Some(wgpu::ColorTargetState { format, blend, write_mask })
            })
            .collect();
        let strip = wgpu::PrimitiveTopology::TriangleStrip;
        let topology = if self.strip { strip } else { wgpu::PrimitiveTopology::TriangleList };
        device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: self.shader,
                entry_point: Some(self.vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: self.buffers,
            },
            primitive: wgpu::PrimitiveState { topology, ..Default::default() },
            depth_stencil: self.depth.map(|(compare, write)| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(write),
                depth_compare: Some(compare),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState { count: self.samples, ..Default::default() },
            fragment: self.fragment.map(|entry| wgpu::FragmentState {
                module: self.shader,
                entry_point: Some(entry),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: self.constants,
                    ..Default::default()
                },
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }
}

/// A colour target of a pass: cleared first, or added to.
pub(crate) fn target(
    view: &wgpu::TextureView,
    clear: Option<[f64; 4]>,
) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    let load = match clear {
        Some([r, g, b, a]) => wgpu::LoadOp::Clear(wgpu::Color { r, g, b, a }),
        None => wgpu::LoadOp::Load,
    };
    let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
    Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
}

/// The depth target of a pass: cleared first, or kept.
pub(crate) fn depth_target(
    view: &wgpu::TextureView,
    clear: bool,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    let load = if clear { wgpu::LoadOp::Clear(1.0) } else { wgpu::LoadOp::Load };
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load, store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

/// A pass over these targets.
pub(crate) fn pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    colours: &[Option<wgpu::RenderPassColorAttachment<'_>>],
    depth: Option<wgpu::RenderPassDepthStencilAttachment<'_>>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: colours,
        depth_stencil_attachment: depth,
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// Writes all of a texture of layer 0; rows of `bytes` follow each other.
pub(crate) fn fill(queue: &wgpu::Queue, texture: &Texture, row: usize, bytes: &[u8]) {
    let size = texture.size();
    let rows = (bytes.len() / row.max(1)) as u32;
    let depth =
        if texture.dimension() == TextureDimension::D3 { size.depth_or_array_layers } else { 1 };
    if rows == 0 {
        return;
    }
    queue.write_texture(
        texture.as_image_copy(),
        bytes,
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row as u32),
            rows_per_image: Some(rows / depth),
        },
        Extent3d { width: size.width, height: rows / depth, depth_or_array_layers: depth },
    );
}

/// A number that no other call returns: the version of what is on the device.
pub(crate) fn version() -> u64 {
    static NEXT: AtomicU64 = AtomicU64::new(1);
    NEXT.fetch_add(1, Ordering::Relaxed)
}

/// Four numbers as 16-bit floats (IEEE 754 binary16), for textures; too large numbers become the largest, NaN 0.
pub(crate) fn halves(values: [f32; 4]) -> [u16; 4] {
    let max = f16::MAX.to_f32();
    let half = |x: f32| if x.is_nan() { f16::ZERO } else { f16::from_f32(x.clamp(-max, max)) };
    values.map(|x| half(x).to_bits())
}

#[cfg(test)]
mod tests {
    use super::halves;

    #[test]
    fn halves_of_known_numbers() {
        assert_eq!(halves([0.0, 1.0, -2.0, 65_504.0]), [0, 0x3c00, 0xc000, 0x7bff]);
        assert_eq!(halves([1e9, f32::NAN, 6e-8, 0.1]), [0x7bff, 0, 1, 0x2e66]);
    }
}
