//! One tile of the picture: hair over the head over the background, from front to back.
//!
//! A pixel is wider than a hair, so a hair covers part of it: exactly how much is the area of its
//! ribbon in the pixel, and what lies behind is dimmed by that much, as if hairs
//! that overlap in a pixel did so by chance. Pieces come sorted by depth, so a pixel is finished once
//! it lets nothing through, and hair that only finished pixels would see is never shaded.

use glam::Vec3;

use super::area::{Area, TILE};
use super::cache::RadianceCache;
use super::curves::{Curves, Vertex};
use super::head::{Cover, Head};
use super::projection::Projection;
use super::shading::Shader;
use super::tiles::{HairPiece, TileGrid};
use frisure_look::{Background, EnvironmentLight};

/// Least softening (pixels): a line that is nearly level would show where it changes row. Chosen by eye.
const SOFTNESS: f32 = 0.35;
/// Transmittance below which a pixel is finished: half a step of an 8-bit picture.
const FINISHED: f32 = 1.0 / 512.0;

/// Paints tiles.
pub(super) struct TilePainter<'a> {
    pub(super) view: &'a Projection,
    pub(super) curves: &'a Curves,
    pub(super) head: Option<&'a Head>,
    pub(super) shader: &'a Shader,
    /// What the shader has computed of the hair.
    pub(super) radiances: RadianceCache,
    pub(super) background: Background,
    pub(super) environment: &'a EnvironmentLight,
    pub(super) samples: usize,
}

/// Accumulated light, and the transmittance that is left.
#[derive(Clone, Copy, Debug)]
struct Layer {
    light: Vec3,
    through: f32,
}

impl Layer {
    const CLEAR: Self = Self { light: Vec3::ZERO, through: 1.0 };

    fn add(&mut self, colour: Vec3, alpha: f32) {
        self.light += self.through * alpha * colour;
        self.through *= 1.0 - alpha;
    }

    /// This layer in front of something of radiance `behind`.
    fn over(&self, behind: Vec3) -> Vec3 {
        self.light + self.through * behind
    }
}

/// A pixel in the making: hair in front of the covered part of the head, and hair in the rest.
struct Pixel {
    coverage: f32,
    depth: f32,
    on_head: Layer,
    beside: Layer,
}

impl Pixel {
    /// A pixel of which the head covers a part at a depth.
    fn new((coverage, depth): (f32, f32)) -> Self {
        Self { coverage, depth, on_head: Layer::CLEAR, beside: Layer::CLEAR }
    }

    /// Whether hair at `depth` would be seen.
    fn open(&self, depth: f32) -> bool {
        (self.coverage < 1.0 && self.beside.through > FINISHED)
            || (self.coverage > 0.0 && depth < self.depth && self.on_head.through > FINISHED)
    }

    fn add(&mut self, colour: Vec3, alpha: f32, depth: f32) {
        if self.coverage < 1.0 {
            self.beside.add(colour, alpha);
        }
        if self.coverage > 0.0 && depth < self.depth {
            self.on_head.add(colour, alpha);
        }
    }
}

/// A piece of hair on the screen, turned so that it runs along the first axis.
struct Line {
    /// Start and end along the axis (pixels), ascending.
    from: f32,
    to: f32,
    /// Position across at `from`, and its slope.
    across: f32,
    slope: f32,
    /// Half of its extent across, measured along the second axis (pixels).
    half: f32,
    /// Depth (m) at `from` and at `to`.
    depth: [f32; 2],
    /// Whether the first axis is y.
    steep: bool,
    /// Whether `from` is the piece's second end.
    reversed: bool,
}

impl TilePainter<'_> {
    /// The pixels of a tile, in rows of [`TILE`].
    pub(super) fn paint(&self, grid: &TileGrid, tile: usize) -> Vec<[f32; 4]> {
        let area = grid.area(tile);
        let faces = grid.head(tile);
        let cover = self.head.filter(|_| !faces.is_empty());
        let cover = cover.map(|head| head.cover(faces, self.view, &area, self.samples));
        let bare = || vec![(0.0, 0.0); TILE * TILE];
        let depths = cover.as_ref().map_or_else(bare, Cover::depths);
        let mut pixels: Vec<Pixel> = depths.into_iter().map(Pixel::new).collect();
        self.lay_hair(grid.hair(tile), &area, &mut pixels);
        self.resolve(&area, cover.as_ref(), &pixels)
    }

    /// Lays the tile's hair over its pixels, nearest first.
    fn lay_hair(&self, hair: &[HairPiece], area: &Area, pixels: &mut [Pixel]) {
        // By depth, then by index: the order does not depend on threads.
        let mut order = hair.to_vec();
        order.sort_unstable();
        for (n, &[key, index]) in order.iter().enumerate() {
            // Every 256 pieces, whether any pixel still lets light through. Chosen.
            if n % 256 == 255 && !any_open(pixels, area, f32::from_bits(key)) {
                return;
            }
            self.lay_piece(index as usize, area, pixels);
        }
    }

    /// Lays one piece over the pixels.
    fn lay_piece(&self, index: usize, area: &Area, pixels: &mut [Pixel]) {
        let Some((a, b)) = self.curves.piece(index) else { return };
        let Some(line) = self.line(a, b) else { return };
        let (low, high, side_low, side_high) = if line.steep {
            (area.y0, area.y1, area.x0, area.x1)
        } else {
            (area.x0, area.x1, area.y0, area.y1)
        };
        let inverse = 1.0 / (line.to - line.from).max(1e-6);
        let rise = line.slope.abs().clamp(SOFTNESS, 1.0);
        let reach = line.half + 0.5 + 0.5 * rise;
        let mut ends: Option<(Vec3, Vec3)> = None;
        // A column belongs to the piece that its middle lies on, so that the pieces of a strand share
        // no pixel at their joints; a strand's ends are rounded to whole pixels. The casts saturate,
        // and the window cuts what lies outside of the tile.
        let columns = ((line.from + 0.5) as usize).max(low)..((line.to + 0.5) as usize).min(high);
        for column in columns {
            let middle = column as f32 + 0.5;
            let centre = line.across + (middle - line.from) * line.slope;
            let x = (middle - line.from) * inverse;
            let depth = line.depth[0] + (line.depth[1] - line.depth[0]) * x;
            if centre + reach < side_low as f32 {
                continue;
            }
            let first = ((centre - reach).max(0.0) as usize).max(side_low);
            let last = ((centre + reach) as usize + 1).min(side_high);
            for row in first..last {
                let (px, py) = if line.steep { (row, column) } else { (column, row) };
                let pixel = &mut pixels[(py - area.y0) * TILE + px - area.x0];
                if !pixel.open(depth) {
                    continue;
                }
                let offset = row as f32 + 0.5 - centre;
                let alpha = ribbon(offset, line.half, rise);
                if alpha > 1e-4 {
                    let (from, to) = *ends.get_or_insert_with(|| self.shade(index, &line));
                    pixel.add(from.lerp(to, x), alpha.min(1.0), depth);
                }
            }
        }
    }

    /// Colours at the start and the end of the line of piece `index`.
    fn shade(&self, index: usize, line: &Line) -> (Vec3, Vec3) {
        let at = |i: usize| self.radiances.get(i, || self.shader.hair(&self.curves.vertices[i]));
        let (a, b) = (at(index), at(index + 1));
        if line.reversed { (b, a) } else { (a, b) }
    }

    /// The piece on the screen; `None` if it has no width or no length there.
    fn line(&self, a: &Vertex, b: &Vertex) -> Option<Line> {
        let (p, q) = (self.view.project(a.position), self.view.project(b.position));
        let (dx, dy) = ((q.x - p.x).abs(), (q.y - p.y).abs());
        let steep = dy > dx;
        let turn = |v: Vec3| if steep { Vec3::new(v.y, v.x, v.z) } else { v };
        let reversed = turn(p).x > turn(q).x;
        let (p, q) = if reversed { (turn(q), turn(p)) } else { (turn(p), turn(q)) };
        let length = q.x - p.x;
        let width = (a.half_width + b.half_width) * self.view.focal / (p.z + q.z);
        if !(length > 1e-4 && width > 0.0) {
            return None;
        }
        let slope = (q.y - p.y) / length;
        // The width across the line, measured along the second axis.
        let half = width * (1.0 + slope * slope).sqrt();
        let depth = [p.z, q.z];
        Some(Line { from: p.x, to: q.x, across: p.y, slope, half, depth, steep, reversed })
    }

    /// Radiance and alpha of what is behind a pixel.
    fn behind(&self, x: usize, y: usize) -> (Vec3, f32) {
        let (x, y) = (x as f32 + 0.5, y as f32 + 0.5);
        let (width, height) = (self.view.width as f32, self.view.height as f32);
        match self.background {
            Background::Environment => {
                (self.environment.radiance_interpolated(self.view.towards(x, y)), 1.0)
            }
            other => other.at(2.0 * x / width - 1.0, 2.0 * y / height - 1.0),
        }
    }

    /// Turns layers into light.
    fn resolve(&self, area: &Area, cover: Option<&Cover<'_>>, pixels: &[Pixel]) -> Vec<[f32; 4]> {
        let mut out = vec![[0.0; 4]; TILE * TILE];
        for y in area.y0..area.y1 {
            for x in area.x0..area.x1 {
                let i = (y - area.y0) * TILE + x - area.x0;
                let pixel = &pixels[i];
                let (behind, alpha) = self.behind(x, y);
                let free = 1.0 - pixel.coverage;
                let mut light = free * pixel.beside.over(behind);
                if let Some(cover) = cover.filter(|_| pixel.coverage > 0.0) {
                    let seen = pixel.on_head.through > FINISHED;
                    let skin = || self.shader.skin(&cover.pixel(i));
                    let skin = if seen { skin() } else { Vec3::ZERO };
                    light += pixel.coverage * pixel.on_head.over(skin);
                }
                let alpha = 1.0 - free * pixel.beside.through * (1.0 - alpha);
                out[i] = [light.x, light.y, light.z, alpha];
            }
        }
        out
    }
}

/// Whether any pixel of the tile would still show hair at `depth` or behind.
fn any_open(pixels: &[Pixel], area: &Area, depth: f32) -> bool {
    (0..area.y1 - area.y0).any(|y| {
        pixels[y * TILE..y * TILE + area.x1 - area.x0].iter().any(|pixel| pixel.open(depth))
    })
}

/// Part of a pixel that a band covers which is `2 half` high and rises by `rise` within the pixel's
/// column, its middle `offset` away from the pixel's (all in pixels).
///
/// This is the exact area: the band seen through a box a pixel high and a box of the rise. Over the
/// rows of a column it sums to the band's height whatever that is: thin hairs are faint, not broad.
fn ribbon(offset: f32, half: f32, rise: f32) -> f32 {
    let inverse = 1.0 / rise;
    edge(offset + half, rise, inverse) - edge(offset - half, rise, inverse)
}

/// Integral up to `x` of the trapezoid that is a box of width 1 smeared by a box of width `rise`.
fn edge(x: f32, rise: f32, inverse: f32) -> f32 {
    let ramp = |x: f32| {
        let x = x.max(0.0);
        0.5 * x * x * inverse
    };
    let (outer, inner) = (0.5 + 0.5 * rise, 0.5 - 0.5 * rise);
    // Beyond the trapezoid the sum of ramps is 1, but for rounding.
    let x = x.clamp(-outer, outer);
    ramp(x + outer) - ramp(x + inner) - ramp(x - inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ribbon_has_the_area_of_its_width() {
        for half in [0.01, 0.2, 1.0, 4.0] {
            for (phase, rise) in [(0.0, 0.35), (0.3, 0.6), (0.77, 1.0)] {
                let rows = (-20..20).map(|i| ribbon(i as f32 + phase, half, rise));
                let sum: f32 = rows.sum();
                assert!((sum / (2.0 * half) - 1.0).abs() < 1e-3, "{half} {phase}: {sum}");
            }
        }
    }
}
