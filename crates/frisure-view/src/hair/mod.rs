//! Hair on the device.

mod curves;
mod nearest;
mod ranks;

use bytemuck::cast_slice;
use frisure_look::HairLook;
use frisure_render::preview::chosen_width;
use frisure_render::preview::{Material, Materials, Occluder, glitter};
use frisure_strands::Strands;
use glam::{Vec3, Vec4};
use wgpu::{Device, Queue, Texture, TextureFormat, TextureUsages};

use crate::gpu;
use crate::marks::Mark;
use crate::renderer::Renderer;
use curves::Curves;
pub(crate) use nearest::Nearest;

/// Vertices in a row of a texture; the shaders know it too.
pub(crate) const ROW: u32 = 2048;

/// Strands on the device, with the colours of a look.
#[derive(Debug)]
pub struct Hair {
    strands: Strands,
    curves: Curves,
    /// Changes with the shape.
    shape: u64,
    bounds: (Vec3, Vec3),
    extinction: Vec3,
    reflected: Vec3,
    varies: bool,
    marked: bool,
    textures: Textures,
    /// The bind group of the shaders.
    group: wgpu::BindGroup,
}

#[derive(Debug)]
struct Textures {
    places: Texture,
    traits: Texture,
    materials: [Texture; 3],
    marks: Texture,
}

impl Hair {
    /// Puts strands on the device. Strands that cannot be drawn (fewer than two points, numbers that are not
    /// finite) are left out; where there is too little room for all, evenly chosen ones are, and the others are
    /// wider. Brows and lashes are always drawn, as wide as they are.
    #[must_use]
    pub fn new(
        renderer: &Renderer,
        device: &Device,
        queue: &Queue,
        strands: &Strands,
        look: &HairLook,
    ) -> Self {
        let side = device.limits().max_texture_dimension_2d;
        let most = curves::MOST.min(ROW as usize * side as usize);
        let enough = curves::VERTICES[usize::from(renderer.samples == 1)];
        let curves = Curves::new(strands, enough, most);
        let textures = Textures::new(device, queue, &curves);
        let group = textures.group(renderer, device);
        let shape = gpu::version();
        let mut hair = Self {
            strands: strands.clone(),
            bounds: enclosing(&curves),
            curves,
            shape,
            extinction: Vec3::ONE,
            reflected: Vec3::ZERO,
            varies: false,
            marked: false,
            textures,
            group,
        };
        hair.recolour(renderer, device, queue, look);
        hair
    }

    /// Marks strands, one mark for each of those that the hair was made of; those without one have none.
    pub fn mark(&mut self, queue: &Queue, marks: &[Mark]) {
        let special = |mark: &Mark| mark.chosen || mark.falls_from < 1.0;
        let any = marks.iter().any(special);
        if any || self.marked {
            let of = |&strand: &u32| marks.get(strand as usize).copied().unwrap_or_default();
            let values = self.curves.strands.iter().map(of);
            let bytes = padded(values.map(texel_of), ROW as usize, [0.0, NEVER]);
            gpu::fill(queue, &self.textures.marks, ROW as usize * 8, cast_slice(&bytes));
        }
        self.marked = any;
    }

    /// Strands that are on the device; it may have no room for all.
    #[must_use]
    pub fn strands(&self) -> usize {
        self.curves.strands.len()
    }

    /// Vertices that are on the device.
    #[must_use]
    pub fn vertices(&self) -> usize {
        self.curves.places.len()
    }

    pub(crate) fn shape(&self) -> u64 {
        self.shape
    }

    pub(crate) fn extinction(&self) -> Vec3 {
        self.extinction
    }

    pub(crate) fn reflected(&self) -> Vec3 {
        self.reflected
    }

    pub(crate) fn varies(&self) -> bool {
        self.varies
    }

    /// Smallest and largest corner (m).
    pub(crate) fn bounds(&self) -> (Vec3, Vec3) {
        self.bounds
    }

    /// The first strands: brows, lashes and a share (0 to 1) of the hairs of the head; and the factor on the width of each of those.
    pub(crate) fn shared(&self, share: f32) -> (usize, f32) {
        let kept = self.strands() - self.curves.facial;
        let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 };
        let drawn = ((kept as f32 * share).ceil() as usize).min(kept);
        (self.curves.facial + drawn, self.factor(drawn))
    }

    /// The first strands: those of which the hairs of the head have at most `pieces` pieces; and the factor on the width of each of those.
    pub(crate) fn some(&self, pieces: usize) -> (usize, f32) {
        let Curves { firsts, facial, .. } = &self.curves;
        let heads = &firsts[*facial..];
        let within = |&first: &u32| (first - heads[0]) as usize <= pieces;
        let drawn = (heads.partition_point(within).max(2) - 1).min(self.strands() - facial);
        (facial + drawn, self.factor(drawn))
    }

    /// The factor on the width of so many hairs of the head.
    fn factor(&self, drawn: usize) -> f32 {
        let all = self.curves.drawable;
        chosen_width(all) * all as f32 / drawn.max(1) as f32
    }

    /// Vertices of the first strands.
    pub(crate) fn vertices_of(&self, strands: usize) -> usize {
        self.curves.firsts[strands.min(self.strands())] as usize
    }

    /// First vertices of the pieces of those of the first strands that are hairs of the head: brows and lashes keep out too little light.
    pub(crate) fn pieces_of(&self, strands: usize) -> Vec<u32> {
        let Curves { firsts, facial, .. } = &self.curves;
        let strands = strands.clamp(*facial, self.strands());
        firsts[*facial..=strands].windows(2).flat_map(|ends| ends[0]..ends[1].max(1) - 1).collect()
    }

    /// The pieces of the first strands by depth.
    pub(crate) fn nearest(&self, strands: usize, eye: Vec3, forward: Vec3) -> Nearest {
        let Curves { places, firsts, .. } = &self.curves;
        Nearest::new(places, firsts, strands, eye, forward)
    }

    /// Those of the first strands that are hairs of the head, `factor` wider, as what keeps the environment's light out.
    pub(crate) fn occluders(&self, strands: usize, factor: f32) -> impl Iterator<Item = Occluder> {
        let (start, end) = (self.vertices_of(self.curves.facial), self.vertices_of(strands));
        (start..end).map(move |i| Occluder {
            position: self.curves.position(i),
            half_width: self.curves.places[i][3] * factor,
            strand: self.curves.traits[i][2],
        })
    }

    /// The bind group of the shaders.
    pub(crate) fn group(&self) -> &wgpu::BindGroup {
        &self.group
    }

    pub(crate) fn places(&self) -> wgpu::TextureView {
        gpu::whole(&self.textures.places)
    }

    /// Gives the strands the colours of a look.
    pub fn recolour(
        &mut self,
        renderer: &Renderer,
        device: &Device,
        queue: &Queue,
        look: &HairLook,
    ) {
        let materials = Materials::new(&self.strands, look);
        let curves = &self.curves;
        let varies = materials.vary_along();
        if varies != self.varies {
            let count = if varies { curves.places.len() } else { curves.strands.len() };
            self.textures.materials = material_textures(device, count);
            self.group = self.textures.group(renderer, device);
            self.varies = varies;
        }
        let strand = |vertex: usize| curves.strands[curves.traits[vertex][2] as usize];
        let places = (0..curves.places.len()).map(|i| (strand(i), curves.along[i]));
        self.extinction = materials.extinction(curves.places.len(), places.clone());
        self.reflected = materials.reflected();
        let texels: Vec<[[u16; 4]; 3]> = if varies {
            places.map(|(strand, place)| texels(&materials.at(strand, place), strand)).collect()
        } else {
            let one = |&strand: &u32| texels(&materials.at(strand, 0.0), strand);
            curves.strands.iter().map(one).collect()
        };
        for (which, texture) in self.textures.materials.iter().enumerate() {
            let bytes = padded(texels.iter().map(|t| t[which]), ROW as usize, [0; 4]);
            gpu::fill(queue, texture, ROW as usize * 8, cast_slice(&bytes));
        }
    }
}

/// No length is cut here.
const NEVER: f32 = 2.0;

/// A mark as its texture has it.
fn texel_of(mark: Mark) -> [f32; 2] {
    let from = if mark.falls_from < 1.0 { mark.falls_from.max(0.0) } else { NEVER };
    [f32::from(u8::from(mark.chosen)), from]
}

/// A material as its textures have it.
fn texels(material: &Material, strand: u32) -> [[u16; 4]; 3] {
    let (strength, shift) = glitter(strand);
    let texel = |colour: Vec3, rest: f32| gpu::halves(Vec4::from((colour, rest)).to_array());
    [
        texel(material.diffuse, strength),
        texel(material.transmitted, shift),
        texel(material.returned, 0.0),
    ]
}

/// Whole rows.
fn padded<T: Clone>(values: impl Iterator<Item = T>, row: usize, nothing: T) -> Vec<T> {
    let mut all: Vec<T> = values.collect();
    all.resize(all.len().next_multiple_of(row), nothing);
    all
}

impl Textures {
    fn new(device: &Device, queue: &Queue, curves: &Curves) -> Self {
        let vertices = curves.places.len();
        let places = rows(device, "places", vertices, TextureFormat::Rgba32Float);
        let traits = rows(device, "traits", vertices, TextureFormat::Rgba32Uint);
        let marks = rows(device, "marks", curves.strands.len(), TextureFormat::Rg32Float);
        let row = ROW as usize;
        let bytes = padded(curves.places.iter().copied(), row, [0.0; 4]);
        gpu::fill(queue, &places, row * 16, cast_slice(&bytes));
        let bytes = padded(curves.traits.iter().copied(), row, [0; 4]);
        gpu::fill(queue, &traits, row * 16, cast_slice(&bytes));
        let bytes = vec![[0.0, NEVER]; curves.strands.len().next_multiple_of(row)];
        gpu::fill(queue, &marks, row * 8, cast_slice(&bytes));
        let materials = material_textures(device, curves.strands.len());
        Self { places, traits, materials, marks }
    }

    fn group(&self, renderer: &Renderer, device: &Device) -> wgpu::BindGroup {
        let [a, b, c] = &self.materials;
        let all = [&self.places, &self.traits, a, b, c, &self.marks].map(gpu::whole);
        let views = all.each_ref().map(wgpu::BindingResource::TextureView);
        gpu::group(device, &renderer.layouts.hair, &views)
    }
}

/// A texture with room for `count` texels in rows.
fn rows(device: &Device, label: &str, count: usize, format: TextureFormat) -> Texture {
    let height = (count as u32).div_ceil(ROW).max(1);
    gpu::texture(device, label, [ROW, height, 1], format, TextureUsages::COPY_DST)
}

fn material_textures(device: &Device, count: usize) -> [Texture; 3] {
    ["diffuse", "transmitted", "returned"]
        .map(|label| rows(device, label, count, TextureFormat::Rgba16Float))
}

/// The box around all vertices.
fn enclosing(curves: &Curves) -> (Vec3, Vec3) {
    let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let grown = |(low, high): (Vec3, Vec3), p: Vec3| (low.min(p), high.max(p));
    let all = (0..curves.places.len()).map(|i| curves.position(i)).fold(empty, grown);
    if all.0.is_finite() { all } else { (Vec3::ZERO, Vec3::ZERO) }
}
