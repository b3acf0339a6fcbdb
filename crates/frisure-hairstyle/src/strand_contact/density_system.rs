//! Hair as a volume on a grid, which presses where there is more of it than packs: what couples simulated hairs without contacts.
//!
//! docs/theory.md, "Hairs that press as a volume"

use std::f64::consts::PI;

use frisure_rod::batch::chain_factor::Symmetric;
use glam::{DVec3, IVec3};

use super::interaction::{Interaction, InteractionSummary};
use super::layout::{BLOCK, Layout, bounds};
use super::pairs::StrandProperties;
use crate::parallel;

/// Fraction of space that fibres take at which hair begins to press. As between guides: parallel cylinders that touch take 0.91, those of
/// a bundle in disorder some 0.8.
pub(super) const SOLID: f64 = 0.8;

/// Width of a cell, in contact distances, and the least (m). Chosen: some sixteen hairs that touch are in a cell; the samples of
/// narrower ones take too long.
const CELL: f64 = 4.0;
const LEAST_CELL: f64 = 3e-3;

/// Energy per length of a hair, over the force scale and the contact distance, where distances are shorter than contact distances by
/// all of these. Three pairs of each hair in a hexagonal bundle, k D²/6 each, k = 200 f/D: (S1), (V1).
const BUNDLE: f64 = 100.0;

/// Parts in which volumes are summed up, each by itself, whatever the number of threads. Chosen.
const PARTS: usize = 4;

/// Cells around all hair.
const MARGIN: i32 = 3;

/// The volume of all hairs.
pub(super) struct DensitySystem<'a> {
    layout: &'a Layout,
    /// Volume (m³) of hair per length of each hair (m²): the cross-section of the fibres that it stands for.
    sections: Vec<f64>,
    /// Energy per volume (Pa) of [`Law`].
    modulus: f64,
    cells: Cells,
    parts: Vec<Vec<f64>>,
    /// By cell: fraction of space, or its change; then what that makes of the energy (J) or the pressure (Pa).
    fraction: Vec<f64>,
    pressure: Vec<f64>,
    bulk: Vec<f64>,
    /// The points (m) of the linearisation.
    at: Vec<DVec3>,
}

/// Where cells are.
#[derive(Clone, Copy, Default)]
struct Cells {
    low: DVec3,
    size: IVec3,
    /// Width (m).
    width: f64,
}

/// Weights of the three cells along one axis in the quadratic B-spline, and their derivatives by the place in cells.
fn spline(x: f64) -> (i32, [f64; 3], [f64; 3]) {
    let near = x.round();
    let d = x - near;
    let (a, b) = (0.5 - d, 0.5 + d);
    (near as i32 - 1, [0.5 * a * a, 0.75 - d * d, 0.5 * b * b], [-a, -2.0 * d, b])
}

impl Cells {
    fn count(&self) -> usize {
        self.size.as_i64vec3().element_product() as usize
    }

    /// Calls `act` with index, weight and gradient of the weight (1/m) of each cell around a place (m).
    #[inline]
    fn around(&self, p: DVec3, mut act: impl FnMut(usize, f64, DVec3)) {
        let at = (p - self.low) / self.width - 0.5;
        let inverse = 1.0 / self.width;
        let ((i, wx, dx), (j, wy, dy), (k, wz, dz)) = (spline(at.x), spline(at.y), spline(at.z));
        let first = IVec3::new(i, j, k);
        // Hair that leaves the grid on the way is nowhere.
        if first.min_element() < 0 || (first + 2).cmpge(self.size).any() {
            return;
        }
        for c in 0..3 {
            for b in 0..3 {
                let row = ((k + c as i32) * self.size.y + j + b as i32) * self.size.x + i;
                let (yz, by_y, by_z) = (wy[b] * wz[c], dy[b] * wz[c], wy[b] * dz[c]);
                for a in 0..3 {
                    let slope = DVec3::new(dx[a] * yz, wx[a] * by_y, wx[a] * by_z) * inverse;
                    act(row as usize + a, wx[a] * yz, slope);
                }
            }
        }
    }
}

/// Energy per volume over the modulus by the fraction of space φ, `φ (1 − √(φs/φ))³` beyond φs, and its first and second derivative.
pub(super) fn law(fraction: f64) -> (f64, f64, f64) {
    if fraction <= SOLID {
        return (0.0, 0.0, 0.0);
    }
    let root = (SOLID / fraction).sqrt();
    let e = 1.0 - root;
    // d e/dφ = root/2φ.
    let first = e * e * (e + 1.5 * root);
    let second = 0.75 * e * root / fraction * (e + 2.0 * root);
    (fraction * e * e * e, first, second)
}

impl<'a> DensitySystem<'a> {
    /// `radii`: contact radius (m) of each hair, that of the cross-section of the fibres for which it stands.
    pub(super) fn new(of: &StrandProperties<'a>) -> Self {
        let sections: Vec<f64> = of.radii.iter().map(|r| PI * r * r).collect();
        let count = sections.len().max(1) as f64;
        let mean = |sum: f64| sum / count;
        let force = mean(of.force_scale.iter().sum());
        let radius = mean(of.radii.iter().sum());
        let width = (CELL * 2.0 * radius).max(LEAST_CELL);
        Self {
            layout: of.layout,
            modulus: BUNDLE * force * 2.0 * radius / mean(sections.iter().sum()),
            sections,
            cells: Cells { width, ..Cells::default() },
            parts: vec![Vec::new(); PARTS],
            fraction: Vec::new(),
            pressure: Vec::new(),
            bulk: Vec::new(),
            at: Vec::new(),
        }
    }

    /// Calls `act` with segment, share of it, and volume (m³) of each sample of the hairs of a part of the chunks.
    fn samples(
        &self,
        points: &[DVec3],
        strands: std::ops::Range<usize>,
        mut act: impl FnMut(usize, f64, f64),
    ) {
        for strand in strands {
            let range = self.layout.points(strand);
            for segment in range.start..range.end - 1 {
                // As many wherever the hair goes: links do not change their lengths.
                let length = points[segment].distance(points[segment + 1]);
                let count = (length / self.cells.width - 1e-6).ceil().max(1.0);
                let volume = self.sections[strand] * length / count;
                for k in 0..count as usize {
                    act(segment, (k as f64 + 0.5) / count, volume);
                }
            }
        }
    }

    /// Puts the sum over samples of `value(segment, share, volume, weight, gradient)` by cell into `fraction`.
    fn gather(
        &mut self,
        points: &[DVec3],
        value: impl Fn(usize, f64, f64, f64, DVec3) -> f64 + Sync,
    ) {
        let count = self.cells.count();
        let per_part = self.layout.strands().div_ceil(PARTS);
        let mut parts = std::mem::take(&mut self.parts);
        let this = &*self;
        parallel::for_each_mut(&mut parts, |index, sums| {
            sums.clear();
            sums.resize(count, 0.0);
            let last = this.layout.strands();
            let strands = (index * per_part).min(last)..((index + 1) * per_part).min(last);
            this.samples(points, strands, |segment, share, volume| {
                let p = points[segment].lerp(points[segment + 1], share);
                this.cells.around(p, |cell, weight, slope| {
                    sums[cell] += value(segment, share, volume, weight, slope);
                });
            });
        });
        let scale = self.cells.width.powi(3).recip();
        self.fraction.resize(count, 0.0);
        let mut blocks: Vec<_> = self.fraction.chunks_mut(BLOCK).collect();
        parallel::for_each_mut(&mut blocks, |index, sums| {
            for (cell, sum) in (index * BLOCK..).zip(sums.iter_mut()) {
                *sum = parts.iter().map(|part| part[cell]).sum::<f64>() * scale;
            }
        });
        self.parts = parts;
    }

    /// Adds the sum over samples of `V Σ_c value_c ∇w_c` to both ends of their segments.
    fn spread(&self, points: &[DVec3], value: &[f64], forces: &mut [DVec3]) {
        let layout = self.layout;
        parallel::for_each_mut(&mut layout.by_point(forces), |index, forces| {
            let chunk = &layout.chunks()[index];
            let first = layout.points(chunk.start).start;
            self.samples(points, chunk.clone(), |segment, share, volume| {
                let p = points[segment].lerp(points[segment + 1], share);
                let mut sum = DVec3::ZERO;
                self.cells.around(p, |cell, _, slope| sum += slope * value[cell]);
                let at = segment - first;
                forces[at] += sum * (volume * (1.0 - share));
                forces[at + 1] += sum * (volume * share);
            });
        });
    }
}

impl Interaction for DensitySystem<'_> {
    fn search(&mut self, points: &[DVec3], _: bool) -> InteractionSummary {
        // 1. A grid around all hair.
        let (low, high) = bounds(points);
        // On multiples of the width, so that cells stay where they are.
        let key = |p: DVec3| (p / self.cells.width).floor();
        self.cells.low = (key(low) - f64::from(MARGIN)) * self.cells.width;
        self.cells.size = (key(high) - key(low)).as_ivec3() + 2 * MARGIN + 1;
        // 2. How dense hair is.
        let mut forces = vec![DVec3::ZERO; points.len()];
        self.add_forces(points, &mut forces);
        let all: f64 = forces.iter().map(|force| force.length()).sum();
        let densest = self.fraction.iter().copied().fold(SOLID, f64::max);
        InteractionSummary {
            touching: forces.iter().filter(|force| **force != DVec3::ZERO).count(),
            deepest: 1.0 - (SOLID / densest).sqrt(),
            ratio: 0.0,
            change: 0.0,
            imbalance: if all > 0.0 { forces.iter().sum::<DVec3>().length() / all } else { 0.0 },
        }
    }

    fn add_forces(&mut self, points: &[DVec3], forces: &mut [DVec3]) -> f64 {
        self.gather(points, |_, _, volume, weight, _| volume * weight);
        let modulus = self.modulus;
        self.pressure.resize(self.fraction.len(), 0.0);
        let blocks = self.pressure.chunks_mut(BLOCK).zip(self.fraction.chunks(BLOCK));
        let mut blocks: Vec<_> = blocks.collect();
        let energies = parallel::map_mut(&mut blocks, |_, (pressures, fractions)| {
            let mut sum = 0.0;
            for (pressure, &fraction) in pressures.iter_mut().zip(*fractions) {
                let (energy, first, _) = law(fraction);
                *pressure = modulus * first;
                sum += modulus * energy;
            }
            sum
        });
        self.spread(points, &self.pressure, forces);
        energies.iter().sum::<f64>() * self.cells.width.powi(3)
    }

    fn linearise(&mut self, points: &[DVec3], own: &mut [Symmetric]) {
        self.gather(points, |_, _, volume, weight, _| volume * weight);
        let modulus = self.modulus;
        self.bulk.resize(self.fraction.len(), 0.0);
        let blocks = self.bulk.chunks_mut(BLOCK).zip(self.fraction.chunks(BLOCK));
        parallel::for_each_mut(&mut blocks.collect::<Vec<_>>(), |_, (bulks, fractions)| {
            for (bulk, &fraction) in bulks.iter_mut().zip(*fractions) {
                *bulk = modulus * law(fraction).2;
            }
        });
        self.at = points.to_vec();
        let scale = self.cells.width.powi(3).recip();
        let layout = self.layout;
        parallel::for_each_mut(&mut layout.by_point(own), |index, own| {
            let chunk = &layout.chunks()[index];
            let first = layout.points(chunk.start).start;
            self.samples(points, chunk.clone(), |segment, share, volume| {
                let p = points[segment].lerp(points[segment + 1], share);
                let mut sum = Symmetric::default();
                self.cells.around(p, |cell, _, slope| {
                    if self.bulk[cell] > 0.0 {
                        sum += Symmetric::square(slope, self.bulk[cell] * scale);
                    }
                });
                let at = segment - first;
                own[at] += sum * (volume * volume * (1.0 - share));
                own[at + 1] += sum * (volume * volume * share);
            });
        });
    }

    fn product(&mut self, motion: &[DVec3], forces: &mut [DVec3]) -> f64 {
        // What is linear in the motion of all samples; the curvature of the kernel is left out.
        let points = std::mem::take(&mut self.at);
        self.gather(&points, |segment, share, volume, _, slope| {
            volume * slope.dot(motion[segment].lerp(motion[segment + 1], share))
        });
        let blocks = self.pressure.chunks_mut(BLOCK).zip(self.fraction.chunks(BLOCK));
        let mut blocks: Vec<_> = blocks.collect();
        let costs = parallel::map_mut(&mut blocks, |index, (pressures, changes)| {
            let mut sum = 0.0;
            let bulks = &self.bulk[index * BLOCK..];
            for ((pressure, change), bulk) in pressures.iter_mut().zip(*changes).zip(bulks) {
                *pressure = bulk * change;
                sum += *pressure * change;
            }
            sum
        });
        forces.fill(DVec3::ZERO);
        self.spread(&points, &self.pressure, forces);
        self.at = points;
        costs.iter().sum::<f64>() * self.cells.width.powi(3)
    }
}
