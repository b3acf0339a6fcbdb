//! The strands of each strip, drawn into its place in the textures.

use frisure_strands::{AttributeValues, Domain, Strands, names};
use glam::{Vec2, Vec3};
use rayon::prelude::*;

use crate::layout::{GAP, Place};
use crate::raster;
use crate::ribbon::{Even, Ribbon};

/// The names of the textures, in their order in [`Atlas::textures`].
pub const TEXTURES: [&str; 3] = ["color", "flow", "data"];

/// Textures of all strips of a level.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Atlas {
    /// Texels along a side.
    pub size: usize,
    /// Eight bits for each of red, green, blue, alpha, from the upper left, a row after another:
    ///
    /// - `color`: colour in the encoding of displays (sRGB), and the part of the texel that hair covers;
    /// - `flow`: red and green are the direction of the hair across and along the strip (from −1 to 1 as 0 to 255; along is
    ///   towards the root), blue is 255, as `KHR_materials_anisotropy` of glTF has it;
    /// - `data`: red is the depth (128 is the strip; more is outward; 127 steps are half the strip's width), green a random
    ///   number of the strand, blue the way from root (0) to tip (255).
    pub textures: [Vec<u8>; 3],
}

/// Texels of the gap about a strip that have the colour of its edge: half of the gap between two.
const MARGIN: usize = GAP / 2;

/// What is drawn: the strands with their colours.
pub(crate) struct Paint<'a> {
    pub(crate) strands: &'a Strands,
    pub(crate) even: &'a Even,
    /// Colour of strands without one of their own (linear).
    pub(crate) colour: [f32; 3],
    /// Factor on the widths.
    pub(crate) widening: f32,
}

/// A texel of a strip while it is drawn: all but the light that passes is multiplied by what covers it.
#[derive(Clone, Copy)]
struct Texel {
    through: f32,
    colour: Vec3,
    flow: Vec2,
    depth: f32,
    number: f32,
    way: f32,
}

const EMPTY: Texel =
    Texel { through: 1.0, colour: Vec3::ZERO, flow: Vec2::ZERO, depth: 0.0, number: 0.0, way: 0.0 };

impl Atlas {
    /// Draws the strands of all strips.
    pub(crate) fn new(
        paint: &Paint<'_>,
        strips: &[(&[usize], Ribbon)],
        places: &[Place],
        size: usize,
    ) -> Self {
        let drawn: Vec<Vec<[u8; 12]>> = strips
            .par_iter()
            .zip(places)
            .map(|((rows, ribbon), place)| paint.strip(rows, ribbon, place))
            .collect();
        let mut textures = [usual_colour(&drawn), [128, 255, 255, 255], [128, 0, 0, 255]]
            .map(|part| part.repeat(size * size));
        for (texels, place) in drawn.iter().zip(places) {
            let Place { width, height, .. } = *place;
            // The edge of a strip goes on into the gap about it, without covering anything there: filtering mixes that in.
            for (down, across) in (0..height + 2 * MARGIN)
                .flat_map(|down| (0..width + 2 * MARGIN).map(move |across| (down, across)))
            {
                let inside = |k: usize, of: usize| k.saturating_sub(MARGIN).min(of - 1);
                let (x, y) = (inside(across, width), inside(down, height));
                let texel = &texels[y * width + x];
                let at = 4 * ((place.y + down - MARGIN) * size + place.x + across - MARGIN);
                for (texture, part) in textures.iter_mut().zip(texel.as_chunks::<4>().0) {
                    texture[at..at + 4].copy_from_slice(part);
                }
                if (down, across) != (y + MARGIN, x + MARGIN) {
                    textures[0][at + 3] = 0;
                }
            }
        }
        Self { size, textures }
    }

    /// The part that hair covers at a place, from 0 to 1 to the right and downwards.
    pub(crate) fn alpha(&self, u: f32, v: f32) -> f32 {
        let at = |x: f32| ((x * self.size as f32) as usize).min(self.size - 1);
        f32::from(self.textures[0][4 * (at(v) * self.size + at(u)) + 3]) / 255.0
    }
}

/// The mean colour of what hair covers, covering nothing: for where there is no strip, so that coarse levels of a texture mix no black in.
fn usual_colour(drawn: &[Vec<[u8; 12]>]) -> [u8; 4] {
    let (mut sum, mut covered) = ([0_u64; 3], 0);
    for texel in drawn.iter().flatten() {
        let part = u64::from(texel[3]);
        covered += part;
        for (sum, x) in sum.iter_mut().zip(texel) {
            *sum += part * u64::from(*x);
        }
    }
    let [r, g, b] = sum.map(|sum| sum.checked_div(covered).unwrap_or(0) as u8);
    [r, g, b, 0]
}

impl Paint<'_> {
    /// The texels of a strip: those of the three textures one after another.
    fn strip(&self, rows: &[usize], ribbon: &Ribbon, place: &Place) -> Vec<[u8; 12]> {
        let (width, height) = (place.width, place.height);
        let mut texels = vec![EMPTY; width * height];
        // From the inside outward: what is outside covers what is inside.
        let mut order: Vec<(f32, usize)> =
            rows.iter().map(|&row| (self.depth(row, ribbon), row)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut parts = vec![(0.0_f32, 0.0_f32, Vec3::ZERO, Vec2::ZERO); width * height];
        for (_, row) in order {
            self.strand(row, ribbon, place, &mut texels, &mut parts);
        }
        let covered: f32 = texels.iter().map(|t| 1.0 - t.through).sum();
        let sum: Vec3 = texels.iter().map(|t| t.colour).sum();
        let usual = if covered > 0.0 { sum / covered } else { Vec3::from_array(self.colour) };
        texels.chunks_mut(width).for_each(fill_between);
        texels.iter().map(|t| t.finished(usual, 0.5 * ribbon.width())).collect()
    }

    /// Mean distance of a strand out of its strip (m).
    fn depth(&self, row: usize, ribbon: &Ribbon) -> f32 {
        let (points, _) = self.even.line(row);
        points.iter().enumerate().map(|(k, p)| ribbon.place(k, *p).z).sum::<f32>()
            / points.len() as f32
    }

    /// Draws a strand over those before.
    fn strand(
        &self,
        row: usize,
        ribbon: &Ribbon,
        place: &Place,
        texels: &mut [Texel],
        parts: &mut [(f32, f32, Vec3, Vec2)],
    ) {
        let (points, radii) = self.even.line(row);
        let (width, height) = (place.width as f32, place.height as f32);
        let length = ribbon.length().max(1e-6);
        let metres = Vec2::new(ribbon.width() / width, length / height);
        let places: Vec<Vec3> = (0..points.len()).map(|k| ribbon.place(k, points[k])).collect();
        let at = |p: &Vec3| Vec2::new(0.5 * width * (1.0 + p.x), height * p.y / length);
        let (mut low, mut high) = (usize::MAX, 0);
        for k in 0..points.len() - 1 {
            let ends = [at(&places[k]), at(&places[k + 1])];
            // The texture is stretched to the strip's width: what is narrow in the mesh is wide in it.
            let narrow = (ribbon.half(places[k].y) / (0.5 * ribbon.width())).clamp(0.05, 1.0);
            let half = 0.5 * self.widening * (radii[k] + radii[k + 1]) / narrow;
            let flow = (ends[1] - ends[0]) * metres * Vec2::new(narrow, -1.0);
            raster::piece(ends, half, metres, (place.width, place.height), |x, y, part, t| {
                let i = y * place.width + x;
                (low, high) = (low.min(i), high.max(i + 1));
                // Of the pieces of one strand the one that covers most.
                if part > parts[i].0 {
                    let way = (k as f32 + t) / (points.len() - 1) as f32;
                    let depth = places[k].z + t * (places[k + 1].z - places[k].z);
                    parts[i] = (part, way, Vec3::new(depth, 0.0, 0.0), flow);
                }
            });
        }
        let number = (row as u32).wrapping_mul(0x9e37_79b9) >> 24;
        for i in low.min(high)..high {
            let (part, way, depth, flow) =
                std::mem::replace(&mut parts[i], (0.0, 0.0, Vec3::ZERO, Vec2::ZERO));
            if part > 0.0 {
                let over = Texel {
                    through: 1.0 - part,
                    colour: self.colour_of(row, way),
                    flow: flow.normalize_or(Vec2::NEG_Y),
                    depth: depth.x,
                    number: number as f32,
                    way,
                };
                texels[i].cover(&over, part);
            }
        }
    }

    /// Colour of a strand at a part of its length (linear).
    fn colour_of(&self, row: usize, way: f32) -> Vec3 {
        let own = self.strands.attribute(names::COLOUR);
        let Some(AttributeValues::F32x3(values)) = own.map(|a| &a.values) else {
            return Vec3::from_array(self.colour);
        };
        if own.is_some_and(|a| a.domain == Domain::Strand) {
            return Vec3::from_array(values[row]);
        }
        let (from, to) =
            (self.strands.offsets()[row] as usize, self.strands.offsets()[row + 1] as usize);
        let at = way * (to - from - 1) as f32;
        Vec3::from_array(values[(from + at.round() as usize).min(to - 1)])
    }
}

impl Texel {
    /// Lays a part of a strand over it.
    fn cover(&mut self, over: &Self, part: f32) {
        let rest = 1.0 - part;
        self.through *= rest;
        self.colour = rest * self.colour + part * over.colour;
        self.flow = rest * self.flow + part * over.flow;
        self.depth = rest * self.depth + part * over.depth;
        self.number = rest * self.number + part * over.number;
        self.way = rest * self.way + part * over.way;
    }

    /// The bytes of the three textures. Where there is no hair, the colour is the usual one: filtering mixes it in.
    fn finished(&self, usual: Vec3, half: f32) -> [u8; 12] {
        let alpha = 1.0 - self.through;
        let byte = |x: f32| (255.0 * x.clamp(0.0, 1.0)).round() as u8;
        let mean = |x: f32| if alpha > 0.0 { x / alpha } else { x };
        let colour = if alpha > 0.02 { self.colour / alpha } else { usual };
        let [r, g, b] = colour.to_array().map(|x| byte(encoded(x)));
        let flow = if alpha > 0.0 { self.flow.normalize_or(Vec2::Y) } else { Vec2::Y };
        let depth = mean(self.depth) / half.max(1e-6);
        [
            [r, g, b, byte(alpha)],
            [byte(0.5 + 0.5 * flow.x), byte(0.5 + 0.5 * flow.y), 255, 255],
            [
                byte(0.502 + 0.498 * depth),
                mean(self.number).round() as u8,
                byte(mean(self.way)),
                255,
            ],
        ]
        .concat()
        .try_into()
        .expect("three of four bytes")
    }
}

/// Gives what is between the hairs of a row of texels the depth, the number and the way from the root of the nearest hair: filtering mixes it in.
fn fill_between(row: &mut [Texel]) {
    let hairs: Vec<usize> = (0..row.len()).filter(|&x| row[x].through < 1.0).collect();
    for x in 0..row.len() {
        let next = hairs.partition_point(|&hair| hair < x);
        let near = [next.checked_sub(1), Some(next)].into_iter().flatten();
        let near = near.filter_map(|i| hairs.get(i)).min_by_key(|hair| hair.abs_diff(x));
        let Some(&hair) = near.filter(|&&hair| hair != x) else { continue };
        let Texel { through, depth, number, way, .. } = row[hair];
        let part = 1.0 - through;
        row[x] = Texel { depth: depth / part, number: number / part, way: way / part, ..row[x] };
    }
}

/// Linear light in the encoding of displays.
fn encoded(x: f32) -> f32 {
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * x.powf(1.0 / 2.4) - 0.055 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_texels_between_hairs_have_the_numbers_of_the_nearest_hair() {
        let mut hair: Texel = EMPTY;
        let of = Texel { depth: 2e-3, number: 200.0, way: 0.75, ..EMPTY };
        hair.cover(&of, 0.5);
        let mut row = [EMPTY, EMPTY, hair, EMPTY];
        fill_between(&mut row);
        for texel in [row[0], row[1], row[3]] {
            assert_eq!((texel.depth, texel.number, texel.way), (2e-3, 200.0, 0.75));
            assert_eq!(texel.finished(Vec3::ONE, 4e-3)[3], 0, "it covers nothing");
        }
        let bytes = row.map(|texel| texel.finished(Vec3::ONE, 4e-3));
        assert!(bytes.iter().all(|texel| texel[8..] == bytes[0][8..]), "{bytes:?}");
    }
}
