//! Parts of the preview that the interactive view is made of as well, so that both show the same hair.

use frisure_strands::{Strands, Surface};
use glam::{DVec3, UVec3, Vec3};

pub use super::curves::smooth;
pub use super::material::{Material, Materials, glitter};

use super::ambient::{self, AmbientLight};
use super::curves::{Curves, NOWHERE, Vertex, along, point_wetness, portion};
use super::head::Head;
use crate::Lights;
use crate::light::DirectionalLights;

/// Directions from which the environment's light is known.
pub const DIRECTION_COUNT: usize = 14;

/// Lights in few numbers, as they are at one place.
#[derive(Clone, Debug, PartialEq)]
pub struct LightsAtPoint {
    /// Unit direction to each lamp, and irradiance on a surface that faces it.
    pub lamps: Vec<(Vec3, Vec3)>,
    /// Radiance of the environment about each direction.
    pub environment: [Vec3; DIRECTION_COUNT],
}

impl LightsAtPoint {
    /// The lights as `place` (m) has them.
    #[must_use]
    pub fn new(lights: &Lights, place: DVec3) -> Self {
        let DirectionalLights { lamps, environment } =
            DirectionalLights::new(lights, place, &ambient::directions());
        Self { lamps, environment }
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

/// The environment's light inside and around the hair, on a grid.
pub struct AmbientGrid {
    ambient: AmbientLight,
}

impl AmbientGrid {
    /// Measures the light of a `environment` ([`LightsAtPoint::environment`]) around hair and head; each hair on the way takes
    /// the part `taken` of it. There are at most `cells` along a side.
    #[must_use]
    pub fn new(
        hair: impl Iterator<Item = Occluder>,
        head: Option<&Surface>,
        environment: [Vec3; DIRECTION_COUNT],
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
        Self { ambient: AmbientLight::new(&curves, head.as_ref(), environment, taken, cells) }
    }

    /// Lowest corner of the grid (m), distance between its nodes (m), and nodes along each side.
    #[must_use]
    pub fn grid(&self) -> (Vec3, f32, UVec3) {
        (self.ambient.low, self.ambient.cell, self.ambient.size)
    }

    /// Radiance that white hair at each node would have, x fastest and z slowest.
    #[must_use]
    pub fn nodes(&self) -> &[Vec3] {
        &self.ambient.mean
    }

    /// Irradiance / π on a surface at `point` (m) with a unit normal.
    #[must_use]
    pub fn on_surface(&self, point: Vec3, normal: Vec3) -> Vec3 {
        self.ambient.on_surface(point, normal)
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
