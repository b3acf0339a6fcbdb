//! Parts of the preview that the interactive view is made of as well, so that both show the same hair.

use frisure_strands::{Strands, Surface};
use glam::{DVec3, UVec3, Vec3};

pub use super::curves::smooth;
pub use super::material::{Material, Materials, glitter};

use super::curves::{Curves, NOWHERE, Vertex, along, point_wetness, portion};
use super::head::Head;
use super::sky::{self, Sky};
use crate::Lights;
use crate::light::PlainLights;

/// Directions from which the room's light is known.
pub const AROUND: usize = 14;

/// Lights in few numbers, as they are at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct FewLights {
    /// Unit direction to each lamp, and irradiance on a surface that faces it.
    pub lamps: Vec<(Vec3, Vec3)>,
    /// Radiance of the room about each direction.
    pub room: [Vec3; AROUND],
}

impl FewLights {
    /// The lights as `place` (m) has them.
    #[must_use]
    pub fn new(lights: &Lights, place: DVec3) -> Self {
        let PlainLights { lamps, room } = PlainLights::new(lights, place, &sky::around());
        Self { lamps, room }
    }
}

/// A point of hair that keeps light out.
#[derive(Clone, Copy, Debug)]
pub struct Occluder {
    /// Where it is (m).
    pub position: Vec3,
    /// Half the width of the hair that it stands for (m).
    pub half_width: f32,
    /// Whose it is; points of one strand follow each other.
    pub strand: u32,
}

/// The room's light inside and around the hair, on a grid.
pub struct RoomLight {
    sky: Sky,
}

impl RoomLight {
    /// Measures the light of a `room` ([`FewLights::room`]) around hair and head; each hair on the way takes
    /// the part `taken` of it. There are at most `cells` along a side.
    #[must_use]
    pub fn new(
        hair: impl Iterator<Item = Occluder>,
        head: Option<&Surface>,
        room: [Vec3; AROUND],
        taken: Vec3,
        cells: f32,
    ) -> Self {
        let vertex = |s: Occluder| Vertex {
            position: s.position,
            half_width: s.half_width,
            strand: s.strand,
            ..NOWHERE
        };
        let curves = Curves { vertices: hair.map(vertex).collect() };
        let head = head.map(Head::new);
        Self { sky: Sky::new(&curves, head.as_ref(), room, taken, cells) }
    }

    /// Lowest corner of the grid (m), distance between its nodes (m), and nodes along each side.
    #[must_use]
    pub fn grid(&self) -> (Vec3, f32, UVec3) {
        (self.sky.low, self.sky.cell, self.sky.size)
    }

    /// Radiance that white hair at each node would have, x fastest and z slowest.
    #[must_use]
    pub fn nodes(&self) -> &[Vec3] {
        &self.sky.mean
    }

    /// Irradiance / π on a surface at `point` (m) with a unit normal.
    #[must_use]
    pub fn on_surface(&self, point: Vec3, normal: Vec3) -> Vec3 {
        self.sky.on_surface(point, normal)
    }
}

/// How wet strands are.
pub struct Wetness<'a> {
    values: Option<&'a [f32]>,
    offsets: &'a [u32],
}

impl<'a> Wetness<'a> {
    /// Of strands, from their attribute `wetness`.
    #[must_use]
    pub fn new(strands: &'a Strands) -> Self {
        Self { values: point_wetness(strands), offsets: strands.offsets() }
    }

    /// Wetness (0 to 1) of a strand, `place` points from its root.
    ///
    /// # Panics
    /// If there is no such strand or place.
    #[must_use]
    pub fn at(&self, strand: usize, place: f32) -> f32 {
        let Some(values) = self.values else { return 0.0 };
        let first = self.offsets[strand] as usize;
        along(place, |i| portion(values[first + i]))
    }
}
