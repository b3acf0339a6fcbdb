//! Lamps and the maps that are made as seen from each.

use frisure_render::preview::DirectionalLights;
use glam::{Vec2, Vec3};

/// Lamps that cast shadows. Chosen; the shaders have as many.
pub(crate) const LAMPS: usize = 4;
/// Texels along a side of the maps of hair, of where hair begins, and of the head. Chosen for speed.
pub(crate) const HAIR_MAP: u32 = 256;
pub(crate) const FIRST_MAP: u32 = 128;
pub(crate) const HEAD_MAP: u32 = 640;

/// A lamp as the shaders have it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lamp {
    towards: Vec3,
    irradiance: Vec3,
    right: Vec3,
    down: Vec3,
    hair: Square,
    head: Square,
    shadowed: bool,
}

/// The extent of a map: a square as seen from the lamp.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Square {
    centre: Vec2,
    half: f32,
    nearest: f32,
    deep: f32,
}

/// The strongest lamps; what the others give is added to the one whose direction is nearest.
pub(crate) fn strongest(lights: &DirectionalLights) -> Vec<(Vec3, Vec3)> {
    let mut all = lights.lamps.clone();
    all.sort_by(|a, b| b.1.element_sum().total_cmp(&a.1.element_sum()));
    let rest = all.split_off(all.len().min(LAMPS));
    for (towards, irradiance) in rest {
        let nearness = |lamp: &(Vec3, Vec3)| lamp.0.dot(towards);
        let nearest = all.iter_mut().max_by(|a, b| nearness(a).total_cmp(&nearness(b)));
        if let Some(lamp) = nearest {
            lamp.1 += irradiance;
        }
    }
    all
}

impl Lamp {
    pub(crate) fn new(
        (towards, irradiance): (Vec3, Vec3),
        hair: Option<(Vec3, Vec3)>,
        head: Option<(Vec3, Vec3)>,
        shadowed: bool,
    ) -> Self {
        let right = Vec3::Z.cross(towards).normalize_or(Vec3::X);
        let down = right.cross(towards);
        let square = |of: Option<(Vec3, Vec3)>, texels: u32| {
            of.map_or(Square::default(), |bounds| {
                Square::around(bounds, [right, down, -towards], texels)
            })
        };
        let (hair, head) = (square(hair, FIRST_MAP), square(head, HEAD_MAP));
        let shadowed = shadowed && hair.half > 0.0;
        Self { towards, irradiance, right, down, hair, head, shadowed }
    }

    /// The part of the lamp on which its maps depend.
    pub(crate) fn place(&self) -> Self {
        Self { irradiance: Vec3::ZERO, ..*self }
    }

    /// The lamp's uniforms.
    pub(crate) fn packed(&self, index: usize) -> [[f32; 4]; 7] {
        let four = |v: Vec3, w: f32| [v.x, v.y, v.z, w];
        let size = HAIR_MAP as f32;
        let (hair, head) = (self.hair, self.head);
        let head_texels = if head.half > 0.0 { HEAD_MAP as f32 } else { 0.0 };
        let inverse = |x: f32| if x > 0.0 { 1.0 / x } else { 0.0 };
        [
            four(self.towards, index as f32),
            four(self.irradiance, f32::from(u8::from(self.shadowed))),
            four(self.right, hair.centre.x),
            four(self.down, hair.centre.y),
            [inverse(hair.half), hair.nearest, size, hair.half / size],
            [head.centre.x, head.centre.y, inverse(head.half), head_texels],
            [head.nearest, inverse(head.deep), 0.0, 0.0],
        ]
    }
}

impl Square {
    /// The square that holds a box, seen along the last of three axes, with two texels around it.
    fn around((low, high): (Vec3, Vec3), axes: [Vec3; 3], texels: u32) -> Self {
        let (centre, half) = (0.5 * (low + high), 0.5 * (high - low));
        let [u, v, w] = axes.map(|axis| (axis.dot(centre), axis.abs().dot(half)));
        let side = u.1.max(v.1).max(1e-4) / (1.0 - 4.0 / texels as f32);
        let deep = (2.0 * w.1).max(1e-4);
        Self { centre: Vec2::new(u.0, v.0), half: side, nearest: w.0 - w.1, deep: 1.02 * deep }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weak_lamps_are_kept_in_strong_ones() {
        let lamp = |x: f32, light: f32| (Vec3::new(x, 1.0, 0.0).normalize(), Vec3::splat(light));
        let lamps =
            vec![lamp(0.0, 1.0), lamp(1.0, 5.0), lamp(-1.0, 4.0), lamp(2.0, 3.0), lamp(-2.0, 2.0)];
        let lights = DirectionalLights { lamps, environment: [Vec3::ZERO; 14] };
        let strong = strongest(&lights);
        assert_eq!(strong.len(), LAMPS);
        let all: f32 = strong.iter().map(|lamp| lamp.1.x).sum();
        assert_eq!(all, 15.0);
    }
}
