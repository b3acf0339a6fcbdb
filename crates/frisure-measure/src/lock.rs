//! The lock in the picture: its pixels, its axis, and its line across the axis.

use glam::DVec2;

use crate::abstain::Abstention;
use crate::contrast::Contrast;
use crate::filter::Grey;

/// Side (pixels) of the cells in which pieces of the lock are joined, and how many empty cells may be between them, across and down. Chosen: a hair is lost
/// where its highlight is as light as the background.
const CELL: usize = 4;
const GAP: [usize; 2] = [6, 16];

/// Part of the strongest contrast that is hair. Chosen.
const HAIR: f64 = 0.2;

/// Size of a second thing over that of the first at which the picture is not clear. Chosen.
const SECOND: f64 = 0.3;

/// Largest part of the picture that may be hair. Chosen.
const CROWDED: f64 = 0.6;

/// Length over width above which the principal axis of the pixels is that of the lock. Chosen.
const SLENDER: f64 = 4.0;

/// The pixels of a lock and what each counts.
#[derive(Clone, Debug)]
pub(crate) struct Lock {
    /// Position (pixels) and contrast above the threshold.
    pub(crate) pixels: Vec<(DVec2, f64)>,
    /// Contrast; 0 outside of the lock.
    pub(crate) grey: Grey,
}

/// The line of a lock across its axis, one row per pixel along it.
#[derive(Clone, Debug)]
pub(crate) struct Line {
    /// A point of the axis (pixels), and its direction, downwards.
    pub(crate) origin: DVec2,
    pub(crate) axis: DVec2,
    pub(crate) rows: Vec<Row>,
}

/// Where the lock is at one place of its axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// Along the axis from the origin (pixels).
    pub(crate) along: f64,
    /// Mean across the axis (pixels).
    pub(crate) across: f64,
    /// Variance of the contrast about the mean (square pixels).
    pub(crate) variance: f64,
    /// What the row counts.
    pub(crate) weight: f64,
}

impl Lock {
    /// The largest thing that differs from the background.
    pub(crate) fn find(contrast: &Contrast) -> Result<Self, Abstention> {
        let mut grey = contrast.grey.clone();
        let mut sorted = grey.values.clone();
        let strongest = sorted.len() - 1 - (sorted.len() / 1000).min(2000);
        let top = f64::from(*sorted.select_nth_unstable_by(strongest, f32::total_cmp).1);
        let threshold = (HAIR * top).max(1.5 * contrast.noise).max(0.003) as f32;
        grey.values.iter_mut().for_each(|v| *v = (*v - threshold).max(0.0));
        let count = grey.values.iter().filter(|v| **v > 0.0).count();
        let part = count as f64 / grey.values.len() as f64;
        if part > CROWDED {
            return Err(Abstention::Crowded { part });
        }
        let cells = Cells::new(&grey);
        let (largest, second) = cells.largest();
        let Some(largest) = largest else { return Err(Abstention::NoHair) };
        if second > SECOND {
            return Err(Abstention::Several { part: second });
        }
        let mut pixels = Vec::new();
        for y in 0..grey.height {
            for x in 0..grey.width {
                let value = &mut grey.values[y * grey.width + x];
                if cells.label(x, y) != largest {
                    *value = 0.0;
                } else if *value > 0.0 {
                    pixels.push((DVec2::new(x as f64, y as f64), f64::from(*value)));
                }
            }
        }
        if pixels.len() < 50 { Err(Abstention::NoHair) } else { Ok(Self { pixels, grey }) }
    }

    /// A point of the axis and its direction; `upright`: along the picture's height unless the lock is slender.
    pub(crate) fn axis(&self, upright: bool) -> (DVec2, DVec2) {
        let total: f64 = self.pixels.iter().map(|p| p.1).sum();
        let mean = self.pixels.iter().map(|(p, w)| *p * *w).sum::<DVec2>() / total;
        let [mut xx, mut xy, mut yy] = [0.0; 3];
        for (p, w) in &self.pixels {
            let d = *p - mean;
            xx += w * d.x * d.x;
            xy += w * d.x * d.y;
            yy += w * d.y * d.y;
        }
        // Eigenvalues and the first eigenvector of a symmetric 2×2 matrix.
        let (half, root) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
        let slender = half + root > SLENDER * SLENDER * (half - root);
        let angle = 0.5 * (2.0 * xy).atan2(xx - yy);
        let axis = if slender || !upright { DVec2::from_angle(angle) } else { DVec2::Y };
        (mean, if axis.y < 0.0 { -axis } else { axis })
    }

    /// The line across an axis.
    pub(crate) fn line(&self, origin: DVec2, axis: DVec2) -> Line {
        let side = axis.perp();
        let place = |p: DVec2| ((p - origin).dot(axis), (p - origin).dot(side));
        let ends = self.pixels.iter().fold((f64::MAX, f64::MIN), |(low, high), (p, _)| {
            let u = place(*p).0;
            (low.min(u), high.max(u))
        });
        let first = ends.0.floor();
        let count = (ends.1 - first).ceil() as usize + 2;
        let mut sums = vec![[0.0_f64; 3]; count];
        for (p, w) in &self.pixels {
            let (u, v) = place(*p);
            let at = u - first;
            let (i, part) = (at as usize, at.fract());
            for (sum, w) in [(i, w * (1.0 - part)), (i + 1, w * part)] {
                let sum = &mut sums[sum.min(count - 1)];
                for (total, x) in sum.iter_mut().zip([1.0, v, v * v]) {
                    *total += w * x;
                }
            }
        }
        let mut weights: Vec<f64> = sums.iter().map(|s| s[0]).collect();
        let usual = crate::dense::median(&mut weights);
        let row = |(i, s): (usize, &[f64; 3])| {
            let across = s[1] / s[0];
            Row {
                along: first + i as f64,
                across,
                variance: (s[2] / s[0] - across * across).max(0.0),
                weight: (s[0] / usual).min(1.0),
            }
        };
        let seen = sums.iter().enumerate().filter(|(_, s)| s[0] > 0.05 * usual);
        Line { origin, axis, rows: seen.map(row).collect() }
    }
}

impl Line {
    /// A place of the picture (pixels).
    pub(crate) fn place(&self, along: f64, across: f64) -> DVec2 {
        self.origin + self.axis * along + self.axis.perp() * across
    }
}

/// Cells of the picture with hair in them, and which are connected.
struct Cells {
    columns: usize,
    labels: Vec<u32>,
    /// What each connected part weighs.
    sizes: Vec<f64>,
}

impl Cells {
    fn new(grey: &Grey) -> Self {
        let (columns, rows) = (grey.width.div_ceil(CELL), grey.height.div_ceil(CELL));
        let mut weights = vec![0.0_f64; columns * rows];
        for y in 0..grey.height {
            for x in 0..grey.width {
                weights[(y / CELL) * columns + x / CELL] += f64::from(grey.at(x, y));
            }
        }
        let mut labels = vec![0_u32; columns * rows];
        let mut sizes = Vec::new();
        for start in 0..labels.len() {
            if labels[start] != 0 || weights[start] == 0.0 {
                continue;
            }
            let label = sizes.len() as u32 + 1;
            labels[start] = label;
            let (mut stack, mut size) = (vec![start], 0.0);
            while let Some(cell) = stack.pop() {
                size += weights[cell];
                let (x, y) = (cell % columns, cell / columns);
                for v in y.saturating_sub(GAP[1])..(y + GAP[1] + 1).min(rows) {
                    for u in x.saturating_sub(GAP[0])..(x + GAP[0] + 1).min(columns) {
                        let next = v * columns + u;
                        if labels[next] == 0 && weights[next] > 0.0 {
                            labels[next] = label;
                            stack.push(next);
                        }
                    }
                }
            }
            sizes.push(size);
        }
        Self { columns, labels, sizes }
    }

    fn label(&self, x: usize, y: usize) -> u32 {
        self.labels[(y / CELL) * self.columns + x / CELL]
    }

    /// The label of the largest part, and the size of the second over its.
    fn largest(&self) -> (Option<u32>, f64) {
        let mut order: Vec<usize> = (0..self.sizes.len()).collect();
        order.sort_by(|a, b| self.sizes[*b].total_cmp(&self.sizes[*a]));
        let first = order.first().map(|i| *i as u32 + 1);
        let part = match order.as_slice() {
            [first, second, ..] => self.sizes[*second] / self.sizes[*first],
            _ => 0.0,
        };
        (first, part)
    }
}
