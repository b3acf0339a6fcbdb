//! Hair as points that each stand for a short length of it: what the grids around it are filled with.

use glam::Vec3;
use rayon::prelude::*;

use super::curves::Curves;

/// Vertices per parallel job; fixed, so that the work is cut the same way on any machine.
const CHUNK: usize = 1 << 16;

/// Length of the hair that a lump stands for, in cells of the grid: what grids do with a lump spreads it over two. Chosen by trial.
const LENGTH: f32 = 1.2;

/// A point that stands for a short length of hair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lump {
    /// The middle of that length (m).
    pub(super) position: Vec3,
    /// Length times width of the hair (m²), as a vector along it.
    pub(super) area: Vec3,
}

/// All hair as lumps.
pub(super) struct Lumps {
    chunks: Vec<Vec<Lump>>,
    /// The box around the hair (m), from its smallest to its largest corner; without hair the first is infinite.
    pub(super) bounds: (Vec3, Vec3),
}

impl Lumps {
    /// The lumps for a grid with `cells` cells along the longest side of the hair, but none finer than `finest` (m).
    pub(super) fn new(curves: &Curves, finest: f32, cells: f32) -> Self {
        let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let join = |a: (Vec3, Vec3), b: (Vec3, Vec3)| (a.0.min(b.0), a.1.max(b.1));
        let at = curves.vertices.par_iter().map(|v| (v.position, v.position));
        let bounds = at.reduce(|| empty, join);
        let length = LENGTH * ((bounds.1 - bounds.0).max_element() / cells).max(finest);
        let count = curves.vertices.len();
        let chunk = |c: usize| lumps(curves, c * CHUNK..count.min((c + 1) * CHUNK), length);
        Self { chunks: (0..count.div_ceil(CHUNK)).into_par_iter().map(chunk).collect(), bounds }
    }

    /// All lumps, along each strand from its root on.
    pub(super) fn iter(&self) -> impl Iterator<Item = &Lump> {
        self.chunks.iter().flatten()
    }
}

/// The lumps of the pieces that begin at these vertices, each of `length` (m) or a little more.
fn lumps(curves: &Curves, vertices: std::ops::Range<usize>, length: f32) -> Vec<Lump> {
    let (mut lumps, mut held) = (Vec::new(), Held::default());
    for i in vertices {
        let Some((a, b)) = curves.piece(i) else {
            lumps.extend(held.release());
            continue;
        };
        let d = b.position - a.position;
        let (whole, width) = (d.length(), a.half_width + b.half_width);
        // The cast saturates.
        let parts = 1 + (whole / length) as u16;
        let part = 1.0 / f32::from(parts);
        for k in 0..parts {
            let x = (f32::from(k) + 0.5) * part;
            held.add(a.position + x * d, part * d, part * whole, width);
            if held.length > length {
                lumps.extend(held.release());
            }
        }
    }
    lumps.extend(held.release());
    lumps
}

/// A lump in the making.
#[derive(Default)]
struct Held {
    length: f32,
    amount: f32,
    moment: Vec3,
    along: Vec3,
}

impl Held {
    /// Adds hair of a length and width (m) around a position, along the vector `d`.
    fn add(&mut self, position: Vec3, d: Vec3, length: f32, width: f32) {
        let amount = length * width;
        self.length += length;
        self.amount += amount;
        self.moment += amount * position;
        self.along += width * d;
    }

    /// The lump of what is held, if that is anything; holds nothing then.
    fn release(&mut self) -> Option<Lump> {
        let Self { amount, moment, along, .. } = std::mem::take(self);
        // All of its length, also where it bends.
        let area = along.normalize_or(Vec3::Z) * amount;
        (amount > 0.0).then(|| Lump { position: moment / amount, area })
    }
}

#[cfg(test)]
mod tests {
    use super::super::projection::Projection;
    use super::*;
    use frisure_strands::Strands;

    #[test]
    fn a_hair_is_cut_into_lumps_of_all_its_area() {
        let points: Vec<Vec3> = (0..200)
            .map(|i| {
                let (sin, cos) = (i as f32 * 0.1).sin_cos();
                Vec3::new(5e-3 * cos, 5e-3 * sin, 1e-4 * i as f32)
            })
            .collect();
        let mut strands = Strands::new();
        strands.push(&points, &[4e-5; 200]);
        let view = Projection::new(&frisure_look::Camera::default(), 512, 512);
        let curves = Curves::new(&strands, &view, 1.0);
        let lumps = Lumps::new(&curves, 2e-3, 1000.0);
        let length: f32 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let area: f32 = lumps.iter().map(|lump| lump.area.length()).sum();
        assert!((area / (length * 8e-5) - 1.0).abs() < 2e-3, "{area}");
        let radius = |lump: &Lump| lump.position.truncate().length();
        assert!(lumps.iter().all(|lump| (4.8e-3..5.1e-3).contains(&radius(lump))));
        assert!((35..50).contains(&lumps.iter().count()));
    }

    #[test]
    fn a_long_piece_has_several_lumps() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::ZERO, Vec3::X * 0.1], &[4e-5; 2]);
        let view = Projection::new(&frisure_look::Camera::default(), 8, 8);
        let lumps = Lumps::new(&Curves::new(&strands, &view, 1.0), 1e-3, 1000.0);
        let xs: Vec<f32> = lumps.iter().map(|lump| lump.position.x).collect();
        assert!(xs.windows(2).all(|pair| pair[1] - pair[0] < 2.5e-3), "{xs:?}");
        assert!(xs[0] < 2e-3 && xs[xs.len() - 1] > 0.098);
    }
}
