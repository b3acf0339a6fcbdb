//! Multiple shooting for the hanging rod.

use glam::{DMat3, DVec3};

use super::banded::Banded;
use super::hanging::{Hanging, NoSolution, Nodes, halves, joined};
use super::morse::index;

/// Largest residual of a solution.
const EXACT: f64 = 1e-13;

impl Hanging {
    /// The end of a piece that starts from `y`, and its derivatives, column by column.
    fn across(&self, from: f64, to: f64, steps: usize, y: &[f64; 6]) -> [f64; 42] {
        let f = |s: f64, y: &[f64; 42]| {
            let mut slope = [0.0; 42];
            slope[..6].copy_from_slice(&self.slope(s, y));
            let change = self.linearised(s, y);
            for k in 1..7 {
                let column = change(&y[6 * k..]);
                slope[6 * k..6 * k + 6].copy_from_slice(&column);
            }
            slope
        };
        let mut start = [0.0; 42];
        start[..6].copy_from_slice(y);
        for k in 0..6 {
            start[6 + 7 * k] = 1.0;
        }
        self.integrate(&f, (from, to), steps, start)
    }
}

/// The solution without weight.
fn natural(rod: &Hanging, pieces: usize) -> Nodes {
    let free = rod.with_weight(0.0);
    let mut y = joined(rod.root_zeta(), DVec3::ZERO);
    let mut nodes = vec![y];
    let steps = rod.division().1;
    for i in 0..pieces {
        let f = |s: f64, y: &[f64; 6]| free.slope(s, y);
        let h = 1.0 / pieces as f64;
        y = rod.integrate(&f, (i as f64 * h, (i + 1) as f64 * h), steps, y);
        nodes.push(y);
    }
    nodes
}

/// Newton's method from a start; `None` if it does not converge in a few steps, or if a step is long.
fn newton(rod: &Hanging, nodes: Nodes) -> Option<Nodes> {
    newton_in(rod, nodes, 14, false)
}

/// Newton's method with a limit on the steps; shortens long steps if requested.
fn newton_in(rod: &Hanging, mut nodes: Nodes, most: usize, shorten: bool) -> Option<Nodes> {
    let pieces = nodes.len() - 1;
    let steps = rod.division().1;
    let h = 1.0 / pieces as f64;
    let scale = 1.0 + rod.weight;
    let mut before = f64::INFINITY;
    for _ in 0..most {
        let mut matrix = Banded::new(6 * nodes.len());
        let mut right = vec![0.0; 6 * nodes.len()];
        let wanted = rod.root_zeta();
        for k in 0..3 {
            matrix.set(k, k, 1.0);
            right[k] = wanted[k] - nodes[0][k];
            let (row, column) = (3 + 6 * pieces + k, 6 * pieces + 3 + k);
            matrix.set(row, column, 1.0);
            right[row] = -nodes[pieces][3 + k];
        }
        for i in 0..pieces {
            let end = rod.across(i as f64 * h, (i + 1) as f64 * h, steps, &nodes[i]);
            for k in 0..6 {
                let row = 3 + 6 * i + k;
                matrix.set(row, 6 * (i + 1) + k, 1.0);
                for c in 0..6 {
                    matrix.set(row, 6 * i + c, -end[6 + 6 * c + k]);
                }
                right[row] = end[k] - nodes[i + 1][k];
            }
        }
        let residual = right.iter().fold(0.0_f64, |m, r| m.max(r.abs())) / scale;
        let step = matrix.solve(right)?;
        let size = step.iter().fold(0.0_f64, |m, r| m.max(r.abs())) / scale;
        if !size.is_finite() || (size > 1.0 && !shorten) {
            return None;
        }
        let part = (0.5 / size).min(1.0);
        let part = if shorten { part } else { 1.0 };
        for (node, step) in nodes.iter_mut().zip(step.chunks(6)) {
            for (y, d) in node.iter_mut().zip(step) {
                *y += part * d;
            }
        }
        // A step without progress means that the rounding error is reached.
        if residual < EXACT || (size < 1e-9 && size >= 0.5 * before) {
            return Some(nodes);
        }
        before = size;
    }
    None
}

/// Increases the weight from zero, in steps that become smaller where Newton's method fails, or where it ends in a
/// solution that is not stable and `stable` is set.
pub(super) fn follow(rod: &Hanging, stable: bool) -> Result<Nodes, NoSolution> {
    let nodes = natural(rod, rod.division().0);
    let first = (0.5 / rod.weight).min(1.0);
    // A planar branch may end far beyond the loss of its stability, so its end does not need precision.
    let least = if stable { 1.000_1 } else { 1.005 };
    advance(nodes, (first, least), stable, |part| rod.with_weight(rod.weight * part))
}

/// Increases the natural strain of a straight rod that hangs straight down, in steps.
pub(super) fn curl(rod: &Hanging) -> Result<Nodes, NoSolution> {
    let straight = vec![joined(rod.root_zeta(), DVec3::ZERO); rod.division().0 + 1];
    advance(straight, (0.1, 1.000_1), false, |part| Hanging {
        natural: rod.natural.scaled(part),
        ..rod.clone()
    })
}

/// Continuation from 0 to 1: first to `first`, then in steps by a factor, which is never
/// less than `least`.
fn advance(
    mut nodes: Nodes,
    (first, least): (f64, f64),
    stable: bool,
    at: impl Fn(f64) -> Hanging,
) -> Result<Nodes, NoSolution> {
    let mut known = 0.0;
    let mut factor = 1.6;
    while known < 1.0 {
        let next: f64 = if known == 0.0 { first } else { known * factor };
        let next = next.min(1.0);
        let rod = at(next);
        let good = |found: &Nodes| !jumped(&nodes, found) && (!stable || index(&rod, found) == 0);
        match newton(&rod, nodes.clone()) {
            Some(found) if good(&found) => {
                (nodes, known) = (found, next);
                factor = factor.powf(1.4).min(2.5);
            }
            _ if known == 0.0 || factor < least => return Err(NoSolution { fraction: known }),
            _ => factor = factor.powf(0.4),
        }
    }
    Ok(nodes)
}

/// Whether a tangent rotated so far against the vertical that the solution is probably on another branch.
fn jumped(from: &Nodes, to: &Nodes) -> bool {
    let cosine = |(a, b): (&[f64; 6], &[f64; 6])| halves(a).0.dot(halves(b).0);
    from.iter().zip(to).map(cosine).fold(1.0, f64::min) < 0.3
}

/// ζ and M of a line, given as a function from arc length to a frame: a start for Newton's method. M is that of the
/// weight beyond, M' = w(1 − s) t × e_z in the world frame, which needs directions only: the curvatures of a divided
/// line are less accurate.
pub(super) fn of_frames(rod: &Hanging, frame: impl Fn(f64) -> DMat3) -> Nodes {
    const PARTS: usize = 4;
    let pieces = rod.division().0;
    let h = 1.0 / (pieces * PARTS) as f64;
    let load = |s: f64| frame(s).z_axis.cross(DVec3::Z) * (rod.weight * (1.0 - s));
    let mut moment = DVec3::ZERO;
    let mut nodes = Vec::with_capacity(pieces + 1);
    for i in (0..=pieces * PARTS).rev() {
        let s = i as f64 * h;
        if i % PARTS == 0 {
            let turned = frame(s).transpose();
            nodes.push(joined(turned * DVec3::Z, turned * moment));
        }
        if i > 0 {
            // Simpson's rule.
            let sum = load(s) + load(s - 0.5 * h) * 4.0 + load(s - h);
            moment -= sum * (h / 6.0);
        }
    }
    nodes.reverse();
    nodes
}

/// Newton's method from a given line.
pub(super) fn near(rod: &Hanging, start: Nodes) -> Result<Nodes, NoSolution> {
    newton_in(rod, start, 60, true).ok_or(NoSolution { fraction: 0.0 })
}

/// Positions and frames, `each` in each piece, the last at its end.
pub(super) fn line(rod: &Hanging, nodes: &Nodes, each: usize) -> Vec<(DVec3, DMat3)> {
    let pieces = nodes.len() - 1;
    let steps = rod.division().1.div_ceil(each);
    let h = 1.0 / (pieces * each) as f64;
    let mut at = (DVec3::ZERO, rod.root);
    let mut points = vec![at];
    let f = |s: f64, y: &[f64; 18]| {
        let mut slope = [0.0; 18];
        slope[..6].copy_from_slice(&rod.slope(s, y));
        let u = rod.strain(s, halves(y).1);
        let d = |k: usize| DVec3::new(y[6 + 3 * k], y[7 + 3 * k], y[8 + 3 * k]);
        let turning = d(0) * u.x + d(1) * u.y + d(2) * u.z;
        for k in 0..3 {
            slope[6 + 3 * k..9 + 3 * k].copy_from_slice(&turning.cross(d(k)).to_array());
        }
        slope[15..].copy_from_slice(&d(2).to_array());
        slope
    };
    for (i, node) in nodes[..pieces].iter().enumerate() {
        let mut y = [0.0; 18];
        y[..6].copy_from_slice(node);
        y[6..15].copy_from_slice(&at.1.to_cols_array());
        y[15..].copy_from_slice(&at.0.to_array());
        for k in i * each..(i + 1) * each {
            y = rod.integrate(&f, (k as f64 * h, (k + 1) as f64 * h), steps, y);
            let frame: [f64; 9] = std::array::from_fn(|k| y[6 + k]);
            at = (DVec3::new(y[15], y[16], y[17]), DMat3::from_cols_array(&frame));
            points.push(at);
        }
    }
    points
}
