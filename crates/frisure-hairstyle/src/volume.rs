//! How much space hair takes.

use std::f64::consts::PI;
use std::sync::atomic::{AtomicU64, Ordering};

use frisure_strands::Strands;
use glam::{DVec3, IVec3};

use crate::head::Head;
use crate::parallel;

/// Space that hair takes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Volume {
    /// The region that hair occupies, air between hairs included (m³).
    pub region: f64,
    /// The hairs themselves (m³).
    pub hair: f64,
    /// Side of the cells over which hair was averaged (m).
    pub cell: f64,
}

/// Side of the cells over which hair is averaged (m) …
const CELL: f64 = 5e-3;

/// … and the fraction of one that hair must fill for it to be occupied. A lone hair of 70 µm fills
/// 0.015 % of a cell that it crosses, and a wisp is several per cent hair: flyaways do not count.
/// Both are chosen (docs/theory.md, "Volume").
const OCCUPIED: f64 = 1e-3;

/// Most cells, a guard on memory: hair that reaches over more is averaged over larger ones.
const MOST_CELLS: f64 = 1.6e7;

/// Longest piece of a hair that is put into one cell, as a fraction of its side. Chosen; a piece lies in the wrong cell by
/// half of it at most.
const PIECE: f64 = 0.25;

/// Most pieces of one segment, however long. A guard on time.
const MOST_PIECES: f64 = 4096.0;

/// Volumes are added as whole multiples of this (m³), so that no order of threads shows.
/// Chosen: far below the volume of a piece, and 2⁶⁴ of them are 18 m³.
const QUANTUM: f64 = 1e-18;

/// Measures the space that strands take around a head on which `grown` hairs grow. If fewer are
/// drawn, each stands for several.
///
/// Space is divided into cells of 5 mm. A cell belongs to the region if hair fills at least 0.1 % of
/// what of it is outside the body. Of a cell at the edge of the region, next to an empty
/// one, only so much counts as its hair would fill at the packing of the cells farther in (the mean
/// of those around it, or the densest where the hair is only a cell thick); so a layer has the volume it has, not a cell's breadth more.
#[must_use]
pub fn volume(strands: &Strands, head: &Head, grown: f64) -> Volume {
    let Some(cells) = Cells::around(strands) else {
        return Volume { cell: CELL, ..Volume::default() };
    };
    let quanta: Vec<AtomicU64> = (0..cells.count()).map(|_| AtomicU64::new(0)).collect();
    parallel::map(strands.len(), |i| cells.fill(strands, i, &quanta));
    let standing_for = (grown / strands.len() as f64).max(1.0);
    let hair: Vec<f64> =
        quanta.into_iter().map(|q| q.into_inner() as f64 * QUANTUM * standing_for).collect();
    // Summed in order, so that it does not depend on threads.
    Volume { region: cells.region(&hair, head), hair: hair.iter().sum(), cell: cells.side }
}

/// Cubic cells around all strands.
struct Cells {
    side: f64,
    low: DVec3,
    size: IVec3,
}

impl Cells {
    /// The cells around all points of strands; `None` without any point.
    fn around(strands: &Strands) -> Option<Self> {
        let places = || strands.points().iter().filter(|p| p.is_finite()).map(|p| p.as_dvec3());
        let low = places().reduce(DVec3::min)?;
        let high = places().reduce(DVec3::max)?;
        let mut side = CELL;
        // A cell of margin all around.
        let size = |side: f64| ((high - low) / side).floor() + DVec3::splat(3.0);
        while size(side).element_product() > MOST_CELLS {
            side *= 1.25;
        }
        Some(Self { side, low: low - DVec3::splat(side), size: size(side).as_ivec3() })
    }

    fn count(&self) -> usize {
        self.size.as_i64vec3().element_product() as usize
    }

    fn index(&self, key: IVec3) -> usize {
        ((key.z * self.size.y + key.y) * self.size.x + key.x) as usize
    }

    fn key(&self, index: usize) -> IVec3 {
        let [x, y] = [self.size.x as usize, self.size.y as usize];
        IVec3::new((index % x) as i32, (index / x % y) as i32, (index / x / y) as i32)
    }

    fn capacity(&self) -> f64 {
        self.side.powi(3)
    }

    /// Puts one strand into the cells it runs through.
    fn fill(&self, strands: &Strands, strand: usize, quanta: &[AtomicU64]) {
        let strand = strands.strand(strand);
        // What is not yet in the cell that the strand has come to: neighbouring pieces are mostly in one.
        let mut held = (None, 0);
        let put = |(cell, share): (Option<usize>, u64)| {
            if let Some(cell) = cell {
                quanta[cell].fetch_add(share, Ordering::Relaxed);
            }
        };
        let cells = 1.0 / self.side;
        for k in 1..strand.points.len() {
            let [a, b] = [k - 1, k].map(|k| strand.points[k].as_dvec3());
            let radii = [k - 1, k].map(|k| f64::from(strand.radii[k]));
            // Mean section of a truncated cone, π (r₀² + r₀ r₁ + r₁²)/3.
            let section =
                PI * (radii[0] * radii[0] + radii[0] * radii[1] + radii[1] * radii[1]) / 3.0;
            let (length, whole) = (a.distance(b), section * a.distance(b));
            if !whole.is_finite() {
                continue;
            }
            let pieces = (length / (PIECE * self.side)).ceil().clamp(1.0, MOST_PIECES);
            let share = (whole / pieces / QUANTUM).round() as u64;
            for piece in 0..pieces as u32 {
                let p = a.lerp(b, (f64::from(piece) + 0.5) / pieces);
                // Not negative: the cast rounds down.
                let cell = Some(self.index(((p - self.low) * cells).as_ivec3()));
                if cell != held.0 {
                    put(std::mem::replace(&mut held, (cell, 0)));
                }
                held.1 += share;
            }
        }
        put(held);
    }

    /// Volume (m³) of the region, of the volumes of hair in each cell.
    fn region(&self, hair: &[f64], head: &Head) -> f64 {
        let filled = parallel::map(hair.len(), |i| {
            Fill::new(hair[i] / self.capacity(), self.outside(i, head))
        });
        let inner = parallel::map(hair.len(), |i| self.inner(i, &filled));
        // In place: there are so many cells that an option of a number for each would take much memory.
        let mut parts = vec![0.0; hair.len()];
        parallel::for_each_mut(&mut parts, |i, part| *part = self.counted(i, &filled, &inner));
        parts.iter().sum::<f64>() * self.capacity()
    }

    /// Fraction of a cell that is outside the body.
    fn outside(&self, index: usize, head: &Head) -> f64 {
        let centre = self.low + (self.key(index).as_dvec3() + 0.5) * self.side;
        // As if the skin were a plane through the cell, at right angles to one of its sides.
        (0.5 + head.signed_distance().value(centre) / self.side).clamp(0.0, 1.0)
    }

    /// Whether a cell is occupied and next to none that is empty. The margin is empty: an occupied
    /// cell has all its neighbours.
    fn inner(&self, index: usize, filled: &[Fill]) -> bool {
        let key = self.key(index);
        let empty = |step: IVec3| filled[self.index(key + step)].empty();
        let mut sides = [IVec3::X, IVec3::Y, IVec3::Z].into_iter();
        filled[index].occupied && sides.all(|s| !empty(s) && !empty(-s))
    }

    /// Fraction of a cell that counts.
    fn counted(&self, index: usize, filled: &[Fill], inner: &[bool]) -> f64 {
        let here = &filled[index];
        if !here.occupied || inner[index] {
            return if here.occupied { here.outside } else { 0.0 };
        }
        let key = self.key(index);
        let (mut sum, mut count, mut most) = (0.0, 0, 0.0_f64);
        for n in 0..27 {
            let step = IVec3::new(n % 3, n / 3 % 3, n / 9) - IVec3::ONE;
            let near = self.index(key + step);
            most = most.max(filled[near].packing);
            if inner[near] {
                (sum, count) = (sum + filled[near].packing, count + 1);
            }
        }
        let full = if count > 0 { sum / f64::from(count) } else { most };
        here.outside * (here.packing / full).min(1.0)
    }
}

/// How full a cell is.
struct Fill {
    /// Fraction of what is outside the body that is hair.
    packing: f64,
    /// Fraction that is outside the body.
    outside: f64,
    occupied: bool,
}

/// Least fraction of a cell outside the body for its packing to be known. Chosen.
const ENOUGH: f64 = 0.2;

impl Fill {
    fn new(fraction: f64, outside: f64) -> Self {
        // Hair that is drawn a little inside the body does not make what is outside full.
        let packing = if outside > ENOUGH { fraction / outside } else { fraction };
        Self { packing, outside, occupied: outside > 0.0 && packing >= OCCUPIED }
    }

    /// Whether it is neither hair nor body.
    fn empty(&self) -> bool {
        !self.occupied && self.outside > 0.5
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::head::ScalpSource;
    use crate::head::test_shapes::ball;

    /// A head far below everything that is measured here.
    fn away() -> Head {
        Head::from_surface(ball(0.1, 24), ScalpSource::Guess).unwrap()
    }

    const RADIUS: f64 = 4e-5;

    /// Parallel hairs along a tilted axis through a section of area `width` × `height`, with `apart`
    /// (m) between neighbours, of `points` points.
    fn bundle(strands: &mut Strands, corner: DVec3, sides: [f64; 3], apart: f64, points: usize) {
        let turn = glam::DQuat::from_rotation_z(0.4) * glam::DQuat::from_rotation_x(0.3);
        let count = |side: f64| (side / apart).round() as usize;
        for i in 0..count(sides[0]) {
            for j in 0..count(sides[1]) {
                let [x, y] = [i, j].map(|k| (k as f64 + 0.5) * apart);
                let at = |k: usize| {
                    let z = sides[2] * k as f64 / (points - 1) as f64;
                    (corner + turn * DVec3::new(x, y, z)).as_vec3()
                };
                let line: Vec<Vec3> = (0..points).map(at).collect();
                strands.push(&line, &vec![RADIUS as f32; points]);
            }
        }
    }

    const CORNER: DVec3 = DVec3::new(0.3, 0.4, 0.5);

    fn measured(sides: [f64; 3], apart: f64, points: usize) -> Volume {
        let mut strands = Strands::new();
        bundle(&mut strands, CORNER, sides, apart, points);
        volume(&strands, &away(), 0.0)
    }

    #[test]
    fn a_block_of_parallel_hairs_has_its_own_volume() {
        for (sides, apart) in [([0.05, 0.06, 0.2], 1e-3), ([0.2, 0.02, 0.1], 5e-4)] {
            let found = measured(sides, apart, 20);
            let exact: f64 = sides.iter().product();
            assert!((found.region / exact - 1.0).abs() < 0.1, "{found:?} {exact}");
            let packing = PI * RADIUS * RADIUS / (apart * apart);
            assert!((found.hair / (exact * packing) - 1.0).abs() < 1e-3, "{found:?}");
        }
    }

    #[test]
    fn it_does_not_depend_on_how_many_points_a_hair_has() {
        let [few, many] = [2, 50].map(|points| measured([0.04, 0.04, 0.15], 8e-4, points));
        assert!((few.region / many.region - 1.0).abs() < 0.01, "{few:?} {many:?}");
        assert!((few.hair / many.hair - 1.0).abs() < 1e-4);
    }

    #[test]
    fn two_apart_add_up() {
        let sides = [0.03, 0.04, 0.1];
        let one = measured(sides, 8e-4, 12);
        let mut strands = Strands::new();
        // By a whole number of cells.
        for shift in [DVec3::ZERO, DVec3::X * 0.15] {
            bundle(&mut strands, CORNER + shift, sides, 8e-4, 12);
        }
        let two = volume(&strands, &away(), 0.0);
        assert!((two.region / one.region - 2.0).abs() < 0.01, "{one:?} {two:?}");
        assert!((two.hair / one.hair - 2.0).abs() < 1e-6);
    }

    #[test]
    fn lone_hairs_do_not_count_and_few_stand_for_many() {
        let sides = [0.05, 0.05, 0.1];
        let sparse = measured(sides, 5e-3, 12);
        assert_eq!(sparse.region, 0.0);
        let mut strands = Strands::new();
        bundle(&mut strands, CORNER, sides, 2.5e-3, 12);
        let found = volume(&strands, &away(), 20.0 * strands.len() as f64);
        let exact: f64 = sides.iter().product();
        assert!((found.region / exact - 1.0).abs() < 0.25, "{found:?}");
        assert!((found.hair / (20.0 * 4.0 * sparse.hair) - 1.0).abs() < 1e-3);
    }

    #[test]
    fn hair_on_the_skin_counts_outside_it() {
        // A coat 1 cm thick around a ball.
        let head = away();
        let mut strands = Strands::new();
        let count = 40_000_i32;
        for i in 0..count {
            // Fibonacci's lattice.
            let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(count);
            let (a, r) = (2.399_963 * f64::from(i), (1.0 - z * z).sqrt());
            let out = DVec3::new(r * a.cos(), r * a.sin(), z);
            let line = [0.0997, 0.105, 0.11].map(|d| (out * d).as_vec3());
            strands.push(&line, &[RADIUS as f32; 3]);
        }
        let exact = 4.0 / 3.0 * PI * (0.11_f64.powi(3) - 0.1_f64.powi(3));
        let found = volume(&strands, &head, 10.0 * f64::from(count));
        assert!((found.region / exact - 1.0).abs() < 0.1, "{found:?} {exact}");
    }

    #[test]
    fn nothing_and_hair_without_end() {
        assert_eq!(volume(&Strands::new(), &away(), 1e5).region, 0.0);
        let mut strands = Strands::new();
        strands.push(&[Vec3::splat(f32::NAN), Vec3::ZERO], &[1e-4; 2]);
        strands.push(&[Vec3::ZERO, Vec3::splat(1e6)], &[1e-4; 2]);
        let found = volume(&strands, &away(), 0.0);
        assert!(found.region >= 0.0 && found.hair.is_finite() && found.cell > 1.0, "{found:?}");
    }
}
