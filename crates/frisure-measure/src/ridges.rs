//! Ridge lines: single hairs, and strands of hairs, within the lock.
//!
//! A ridge is where the contrast is greatest across its own direction: the eigenvector of the Hessian with the most negative eigenvalue is across it, and the
//! first derivative along that vector vanishes (Steger 1998, "An unbiased detector of curvilinear structures", doi:10.1109/34.659930). The structure
//! tensor, the outer product of the gradient under a Gaussian, gives the direction of the lines and its coherence (Bigün & Granlund 1987; Jähne 2005).

use glam::DVec2;

use crate::filter::Grey;
use crate::lock::Lock;

/// Standard deviations of the Gaussians (pixels) in which ridges are looked for: single hairs and strands. Chosen.
pub(crate) const SCALES: [f64; 2] = [1.2, 2.4];

/// Standard deviation of the Gaussian (pixels) of the structure tensor. Chosen.
const TENSOR: f64 = 2.5;

/// Strength of a ridge over that of the strongest, below which it is noise. Chosen.
const LEAST_STRENGTH: f64 = 0.08;

/// Cosine of the largest angle between a ridge and its continuation. Chosen: 40°.
const LARGEST_TURN: f64 = 0.77;

/// Points of the shortest ridge line. Chosen.
const SHORTEST: usize = 10;

/// A point of a ridge, to a part of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RidgePoint {
    /// Where it is (pixels).
    pub(crate) place: DVec2,
    /// Direction of the line there, by the structure tensor.
    pub(crate) direction: DVec2,
    /// (λ1 − λ2)/(λ1 + λ2) of the structure tensor: 1 where all lines run in one direction.
    pub(crate) coherence: f64,
    strength: f64,
    /// Direction of the ridge, by the Hessian.
    along: DVec2,
}

/// Ridge lines, the longest first.
pub(crate) fn ridge_lines(lock: &Lock) -> Vec<Vec<RidgePoint>> {
    let (grey, corner) = cut_out(lock);
    let mut grid: Vec<Option<RidgePoint>> = vec![None; grey.values.len()];
    let tensor = Tensor::new(&grey);
    for sigma in SCALES {
        ridge_points(&grey, sigma, &tensor, &mut grid);
    }
    let top = grid.iter().flatten().map(|p| p.strength).fold(0.0, f64::max);
    for point in &mut grid {
        if point.is_some_and(|p| p.strength < LEAST_STRENGTH * top) {
            *point = None;
        }
    }
    let mut lines = link(&mut grid, grey.width, grey.height);
    for point in lines.iter_mut().flatten() {
        point.place += corner;
    }
    lines
}

/// The part of the picture with the lock, and its corner.
fn cut_out(lock: &Lock) -> (Grey, DVec2) {
    const MARGIN: usize = 10;
    let whole = &lock.grey;
    let (mut low, mut high) = ([usize::MAX; 2], [0; 2]);
    for (p, _) in &lock.pixels {
        for (i, x) in [p.x as usize, p.y as usize].into_iter().enumerate() {
            low[i] = low[i].min(x);
            high[i] = high[i].max(x);
        }
    }
    let low = low.map(|x| x.saturating_sub(MARGIN));
    let size = [
        (high[0] + MARGIN + 1).min(whole.width) - low[0],
        (high[1] + MARGIN + 1).min(whole.height) - low[1],
    ];
    let row = |y: usize| {
        let start = (low[1] + y) * whole.width + low[0];
        whole.values[start..start + size[0]].iter().copied()
    };
    let values = (0..size[1]).flat_map(row).collect();
    let grey = Grey { width: size[0], height: size[1], values };
    (grey, DVec2::new(low[0] as f64, low[1] as f64))
}

/// The structure tensor of each pixel.
struct Tensor([Grey; 3]);

impl Tensor {
    fn new(grey: &Grey) -> Self {
        let (gx, gy) = (grey.gaussian(1.0, 1, 0), grey.gaussian(1.0, 0, 1));
        let product = |a: &Grey, b: &Grey| {
            let values = a.values.iter().zip(&b.values).map(|(x, y)| x * y).collect();
            Grey { values, ..*a }.gaussian(TENSOR, 0, 0)
        };
        Self([product(&gx, &gx), product(&gx, &gy), product(&gy, &gy)])
    }

    /// Direction of the lines at a pixel, and coherence.
    fn at(&self, i: usize) -> (DVec2, f64) {
        let [xx, xy, yy] = [0, 1, 2].map(|c| f64::from(self.0[c].values[i]));
        let (difference, trace) = ((xx - yy).hypot(2.0 * xy), xx + yy);
        let across = 0.5 * (2.0 * xy).atan2(xx - yy);
        let coherence = if trace > 0.0 { difference / trace } else { 0.0 };
        (DVec2::from_angle(across).perp(), coherence)
    }
}

fn ridge_points(grey: &Grey, sigma: f64, tensor: &Tensor, grid: &mut [Option<RidgePoint>]) {
    let [gx, gy, hxx, hxy, hyy] =
        [(1, 0), (0, 1), (2, 0), (1, 1), (0, 2)].map(|(dx, dy)| grey.gaussian(sigma, dx, dy));
    for (i, slot) in grid.iter_mut().enumerate() {
        if grey.values[i] <= 0.0 {
            continue;
        }
        let [xx, xy, yy] = [&hxx, &hxy, &hyy].map(|h| f64::from(h.values[i]));
        let (half, root) = (0.5 * (xx + yy), (0.25 * (xx - yy).powi(2) + xy * xy).sqrt());
        let least = half - root;
        if least >= 0.0 {
            continue;
        }
        // The eigenvector of the larger eigenvalue is along the ridge.
        let along = DVec2::from_angle(0.5 * (2.0 * xy).atan2(xx - yy));
        let across = along.perp();
        let slope = f64::from(gx.values[i]) * across.x + f64::from(gy.values[i]) * across.y;
        let shift = across * (-slope / least);
        if shift.abs().max_element() > 0.6 {
            continue;
        }
        let strength = -least * sigma * sigma;
        if slot.is_some_and(|p| p.strength >= strength) {
            continue;
        }
        let (x, y) = (i % grey.width, i / grey.width);
        let (direction, coherence) = tensor.at(i);
        let place = DVec2::new(x as f64, y as f64) + shift;
        *slot = Some(RidgePoint { place, direction, coherence, strength, along });
    }
}

/// Joins points to lines from the strongest on, both ways along the ridge.
fn link(grid: &mut [Option<RidgePoint>], width: usize, height: usize) -> Vec<Vec<RidgePoint>> {
    let mut order: Vec<usize> = (0..grid.len()).filter(|i| grid[*i].is_some()).collect();
    let strength = |i: usize, grid: &[Option<RidgePoint>]| grid[i].map_or(0.0, |p| p.strength);
    order.sort_by(|a, b| strength(*b, grid).total_cmp(&strength(*a, grid)));
    let mut lines = Vec::new();
    for start in order {
        let Some(seed) = grid[start].take() else { continue };
        let mut line: Vec<RidgePoint> = follow(grid, width, height, seed, -seed.along);
        line.reverse();
        line.push(seed);
        line.extend(follow(grid, width, height, seed, seed.along));
        if line.len() >= SHORTEST {
            lines.push(line);
        }
    }
    lines.sort_by_key(|line| std::cmp::Reverse(line.len()));
    lines
}

fn follow(
    grid: &mut [Option<RidgePoint>],
    width: usize,
    height: usize,
    seed: RidgePoint,
    heading: DVec2,
) -> Vec<RidgePoint> {
    let (mut found, mut at, mut heading) = (Vec::new(), seed.place, heading);
    loop {
        let (x, y) = (at.x.round() as i64, at.y.round() as i64);
        let mut best: Option<(f64, usize)> = None;
        for v in (y - 2).max(0)..(y + 3).min(height as i64) {
            for u in (x - 2).max(0)..(x + 3).min(width as i64) {
                let i = v as usize * width + u as usize;
                let Some(p) = grid[i] else { continue };
                let step = p.place - at;
                let ahead = step.dot(heading);
                let turn = p.along.dot(heading).abs();
                if ahead > 0.3 && ahead > 0.6 * step.length() && turn > LARGEST_TURN {
                    let off = step.perp_dot(heading).abs();
                    let cost = ahead + 2.0 * off + 2.0 * (1.0 - turn);
                    if best.is_none_or(|(least, _)| cost < least) {
                        best = Some((cost, i));
                    }
                }
            }
        }
        let Some((_, i)) = best else { return found };
        let Some(p) = grid[i].take() else { return found };
        // Neighbours beside the line belong to it.
        clear_beside(grid, width, height, at, p.place);
        heading = if p.along.dot(heading) < 0.0 { -p.along } else { p.along };
        at = p.place;
        found.push(p);
    }
}

/// Removes points nearer than 0.8 pixels to the middle of a step.
fn clear_beside(
    grid: &mut [Option<RidgePoint>],
    width: usize,
    height: usize,
    from: DVec2,
    to: DVec2,
) {
    let middle = 0.5 * (from + to);
    let (x, y) = (middle.x.round() as i64, middle.y.round() as i64);
    for v in (y - 1).max(0)..(y + 2).min(height as i64) {
        for u in (x - 1).max(0)..(x + 2).min(width as i64) {
            let slot = &mut grid[v as usize * width + u as usize];
            if slot.is_some_and(|p| p.place.distance(middle) < 0.8) {
                *slot = None;
            }
        }
    }
}
