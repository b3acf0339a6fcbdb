//! Multiple shooting for the hanging rod.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat2, DMat3, DQuat, DVec2, DVec3};

use super::banded::Banded;
use super::gauss::integrate;
use super::{Hanging, NoSolution};

/// ζ and M at the ends of all pieces.
pub(super) type Nodes = Vec<[f64; 6]>;

/// Residual at which the equations hold.
const EXACT: f64 = 1e-13;

fn halves(y: &[f64]) -> (DVec3, DVec3) {
    (DVec3::new(y[0], y[1], y[2]), DVec3::new(y[3], y[4], y[5]))
}

fn joined(zeta: DVec3, moment: DVec3) -> [f64; 6] {
    [zeta.x, zeta.y, zeta.z, moment.x, moment.y, moment.z]
}

impl Hanging {
    fn strain(&self, moment: DVec3) -> DVec3 {
        self.natural + moment / self.stiffness
    }

    /// ζ' and M'.
    fn slope(&self, s: f64, y: &[f64]) -> [f64; 6] {
        let (zeta, moment) = halves(y);
        let u = self.strain(moment);
        let load = DVec3::Z.cross(zeta) * (self.weight * (1.0 - s));
        joined(zeta.cross(u), moment.cross(u) + load)
    }

    /// The same for a small change of the solution.
    fn change(&self, s: f64, y: &[f64], by: &[f64]) -> [f64; 6] {
        let (zeta, moment) = halves(y);
        let (d_zeta, d_moment) = halves(by);
        let (u, du) = (self.strain(moment), d_moment / self.stiffness);
        let load = DVec3::Z.cross(d_zeta) * (self.weight * (1.0 - s));
        joined(d_zeta.cross(u) + zeta.cross(du), d_moment.cross(u) + moment.cross(du) + load)
    }

    fn root_zeta(&self) -> DVec3 {
        self.root.transpose() * DVec3::Z
    }

    /// The end of a piece that starts from `y`, and its derivatives, column by column.
    fn across(&self, from: f64, to: f64, steps: usize, y: &[f64; 6]) -> [f64; 42] {
        let f = |s: f64, y: &[f64; 42]| {
            let mut slope = [0.0; 42];
            slope[..6].copy_from_slice(&self.slope(s, y));
            for k in 1..7 {
                let column = self.change(s, y, &y[6 * k..]);
                slope[6 * k..6 * k + 6].copy_from_slice(&column);
            }
            slope
        };
        let mut start = [0.0; 42];
        start[..6].copy_from_slice(y);
        for k in 0..6 {
            start[6 + 7 * k] = 1.0;
        }
        integrate(&f, from, to, steps, start)
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
        y = integrate(&f, i as f64 * h, (i + 1) as f64 * h, steps, y);
        nodes.push(y);
    }
    nodes
}

/// Newton's method from a start; none if it does not come to rest in a few steps.
fn newton(rod: &Hanging, mut nodes: Nodes) -> Option<Nodes> {
    let pieces = nodes.len() - 1;
    let steps = rod.division().1;
    let h = 1.0 / pieces as f64;
    let scale = 1.0 + rod.weight;
    let mut before = f64::INFINITY;
    for _ in 0..14 {
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
        if !size.is_finite() || size > 1.0 {
            return None;
        }
        for (node, step) in nodes.iter_mut().zip(step.chunks(6)) {
            for (y, d) in node.iter_mut().zip(step) {
                *y += d;
            }
        }
        // Rounding is reached where a step brings nothing any more.
        if residual < EXACT || (size < 1e-9 && size >= 0.5 * before) {
            return Some(nodes);
        }
        before = size;
    }
    None
}

/// Turns the weight on, in steps that become smaller where Newton's method fails, or where it ends in a
/// solution that is not stable and `stable` is asked for.
pub(super) fn follow(rod: &Hanging, stable: bool) -> Result<Nodes, NoSolution> {
    let nodes = natural(rod, rod.division().0);
    let first = (0.5 / rod.weight).min(1.0);
    // A branch in a plane may end where the rod has long left it: its end need not be known to a digit.
    let least = if stable { 1.000_1 } else { 1.005 };
    advance(nodes, (first, least), stable, |part| rod.with_weight(rod.weight * part))
}

/// Gives a straight rod that hangs straight down its natural strain, in steps.
pub(super) fn curl(rod: &Hanging) -> Result<Nodes, NoSolution> {
    let straight = vec![joined(rod.root_zeta(), DVec3::ZERO); rod.division().0 + 1];
    advance(straight, (0.1, 1.000_1), false, |part| Hanging { natural: rod.natural * part, ..*rod })
}

/// Goes from part 0 to part 1 of something: first to the part `first`, then in steps of a factor, which is never
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

/// Whether a tangent turned by so much against the vertical that another branch is likelier than this one.
fn jumped(from: &Nodes, to: &Nodes) -> bool {
    let cosine = |(a, b): (&[f64; 6], &[f64; 6])| halves(a).0.dot(halves(b).0);
    from.iter().zip(to).map(cosine).fold(1.0, f64::min) < 0.3
}

/// ζ and M of a line, given as a function of arc length to a frame, as nearly as its frames tell them: a start for
/// Newton's method.
pub(super) fn of_frames(rod: &Hanging, frame: impl Fn(f64) -> DMat3) -> Nodes {
    let pieces = rod.division().0;
    // A small part of a piece to either side, but where there is no hair.
    let around = 0.1 / pieces as f64;
    let node = |i: usize| {
        let s = i as f64 / pieces as f64;
        let (from, to) = ((s - around).max(0.0), (s + around).min(1.0));
        let turn = DQuat::from_mat3(&(frame(from).transpose() * frame(to)));
        let strain = turn.to_scaled_axis() / (to - from);
        let moment = (strain - rod.natural) * rod.stiffness;
        joined(frame(s).transpose() * DVec3::Z, moment)
    };
    (0..=pieces).map(node).collect()
}

/// Newton's method from those.
pub(super) fn near(rod: &Hanging, start: Nodes) -> Result<Nodes, NoSolution> {
    newton(rod, start).ok_or(NoSolution { fraction: 0.0 })
}

/// Positions and frames, so many in each piece, the last at its end.
pub(super) fn line(rod: &Hanging, nodes: &Nodes, each: usize) -> Vec<(DVec3, DMat3)> {
    let pieces = nodes.len() - 1;
    let steps = rod.division().1.div_ceil(each);
    let h = 1.0 / (pieces * each) as f64;
    let mut at = (DVec3::ZERO, rod.root);
    let mut points = vec![at];
    let f = |s: f64, y: &[f64; 18]| {
        let mut slope = [0.0; 18];
        slope[..6].copy_from_slice(&rod.slope(s, y));
        let u = rod.strain(halves(y).1);
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
            y = integrate(&f, k as f64 * h, (k + 1) as f64 * h, steps, y);
            let frame: [f64; 9] = std::array::from_fn(|k| y[6 + k]);
            at = (DVec3::new(y[15], y[16], y[17]), DMat3::from_cols_array(&frame));
            points.push(at);
        }
    }
    points
}

/// Morse's index: how many independent small changes lower the energy. It is the number of points on the way
/// from tip to root where a neighbouring solution that leaves the tip free meets this one.
pub(super) fn index(rod: &Hanging, nodes: &Nodes) -> usize {
    const LOOKS: usize = 16;
    let pieces = nodes.len() - 1;
    let steps = rod.division().1.div_ceil(6);
    let h = 1.0 / pieces as f64;
    let across = halves(&nodes[pieces]).0.any_orthonormal_pair();
    let mut fields = [joined(across.0, DVec3::ZERO), joined(across.1, DVec3::ZERO)];
    let f = |s: f64, y: &[f64; 18]| {
        let mut slope = [0.0; 18];
        slope[..6].copy_from_slice(&rod.slope(s, y));
        for k in 1..3 {
            slope[6 * k..6 * k + 6].copy_from_slice(&rod.change(s, y, &y[6 * k..]));
        }
        slope
    };
    let mut before = phases(&nodes[pieces], &fields);
    let mut met = 0;
    for i in (0..pieces).rev() {
        let mut y = [0.0; 18];
        y[..6].copy_from_slice(&nodes[i + 1]);
        y[6..12].copy_from_slice(&fields[0]);
        y[12..].copy_from_slice(&fields[1]);
        for look in 0..LOOKS {
            let from = (i + 1) as f64 * h - look as f64 * h / LOOKS as f64;
            y = integrate(&f, from, from - h / LOOKS as f64, steps, y);
            let part = |k: usize| std::array::from_fn(|c| y[6 * k + c]);
            fields = [part(1), part(2)];
            let now = phases(&part(0), &fields);
            met += passed(before, now);
            before = now;
        }
        orthonormalise(&mut fields);
    }
    met
}

/// Phases of the plane of fields: the arctangents of the eigenvalues of `P X⁻¹`, X the fields' rotations across
/// the vertical and P their moments, in order. Where X is singular one of them leaves at π/2 and comes back
/// at −π/2.
fn phases(at: &[f64; 6], fields: &[[f64; 6]; 2]) -> [f64; 2] {
    let (zeta, moment) = halves(at);
    let (e, g) = zeta.normalize().any_orthonormal_pair();
    let part = |field: &[f64; 6]| {
        let (d_zeta, d_moment) = halves(field);
        let turn = d_zeta.cross(zeta);
        // Half of η × M makes the pair canonical in coordinates that turn with the section.
        let p = d_moment + turn.cross(moment) * 0.5;
        (DVec2::new(turn.dot(e), turn.dot(g)), DVec2::new(p.dot(e), p.dot(g)))
    };
    let [(x0, p0), (x1, p1)] = [part(&fields[0]), part(&fields[1])];
    let (x, p) = (DMat2::from_cols(x0, x1), DMat2::from_cols(p0, p1));
    let det = x.determinant();
    let adjugate = DMat2::from_cols_array(&[x.y_axis.y, -x.x_axis.y, -x.y_axis.x, x.x_axis.x]);
    // P adj(X) is det(X) times the symmetric matrix; this way nothing is divided by zero.
    let q = p * adjugate;
    let middle = 0.5 * (q.x_axis.x + q.y_axis.y);
    let half = (0.5 * (q.x_axis.x - q.y_axis.y)).hypot(0.5 * (q.x_axis.y + q.y_axis.x));
    let mut angles = [middle - half, middle + half].map(|m| {
        let angle = m.atan2(det);
        if angle > FRAC_PI_2 {
            angle - PI
        } else if angle < -FRAC_PI_2 {
            angle + PI
        } else {
            angle
        }
    });
    angles.sort_by(f64::total_cmp);
    angles
}

/// How many phases have gone round, by the least that they can have moved.
fn passed(before: [f64; 2], now: [f64; 2]) -> usize {
    let moved = |count: usize| {
        let after = match count {
            0 => now,
            1 => [now[1], now[0] + PI],
            _ => [now[0] + PI, now[1] + PI],
        };
        (after[0] - before[0]).abs() + (after[1] - before[1]).abs()
    };
    (0..3).min_by(|&a, &b| moved(a).total_cmp(&moved(b))).unwrap_or(0)
}

/// The same fields, of size 1 and at right angles to each other: only their plane matters.
fn orthonormalise(fields: &mut [[f64; 6]; 2]) {
    let dot = |a: &[f64; 6], b: &[f64; 6]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let size = dot(&fields[0], &fields[0]).sqrt();
    fields[0] = fields[0].map(|x| x / size);
    let along = dot(&fields[0], &fields[1]);
    let first = fields[0];
    for (x, y) in fields[1].iter_mut().zip(first) {
        *x -= along * y;
    }
    let size = dot(&fields[1], &fields[1]).sqrt();
    fields[1] = fields[1].map(|x| x / size);
}
