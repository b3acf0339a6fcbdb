//! Morse's index of a solution.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat2, DVec2, DVec3};

use super::hanging::{Hanging, Nodes, halves, joined};

/// Morse's index: the number of independent directions in which the energy decreases. It is the number of points
/// between tip and root where a neighbouring solution with a free tip meets this one.
pub(super) fn index(rod: &Hanging, nodes: &Nodes) -> usize {
    const LOOKS: usize = 16;
    let pieces = nodes.len() - 1;
    let steps = rod.division().1.div_ceil(6);
    let h = 1.0 / pieces as f64;
    let across = halves(&nodes[pieces]).0.any_orthonormal_pair();
    let mut fields = [joined(across.0, DVec3::ZERO), joined(across.1, DVec3::ZERO)];
    let mut met = 0;
    for i in (0..pieces).rev() {
        let mut y = [0.0; 18];
        y[..6].copy_from_slice(&nodes[i + 1]);
        y[6..12].copy_from_slice(&fields[0]);
        y[12..].copy_from_slice(&fields[1]);
        for look in 0..LOOKS {
            let from = (i + 1) as f64 * h - look as f64 * h / LOOKS as f64;
            let (next, count) = looked(rod, (from, from - h / LOOKS as f64), steps, y, 10);
            met += count;
            y = next;
        }
        fields = fields_of(&y);
        orthonormalise(&mut fields);
    }
    met
}

/// The solution and its two neighbours at the other end of an interval, and the number of phases that wrapped around
/// in it. Phases may change quickly, and a large change is ambiguous by a full turn: such
/// an interval is halved, at most a given number of times.
fn looked(
    rod: &Hanging,
    (from, to): (f64, f64),
    steps: usize,
    y: [f64; 18],
    halvings: usize,
) -> ([f64; 18], usize) {
    let f = |s: f64, y: &[f64; 18]| {
        let mut slope = [0.0; 18];
        slope[..6].copy_from_slice(&rod.slope(s, y));
        let change = rod.linearised(s, y);
        for k in 1..3 {
            slope[6 * k..6 * k + 6].copy_from_slice(&change(&y[6 * k..]));
        }
        slope
    };
    let next = rod.integrate(&f, (from, to), steps, y);
    let (count, moved) = passed(phases_at(&y), phases_at(&next));
    if moved < 0.3 || halvings == 0 {
        return (next, count);
    }
    let middle = 0.5 * (from + to);
    let (half, first) = looked(rod, (from, middle), steps, y, halvings - 1);
    let (next, second) = looked(rod, (middle, to), steps, half, halvings - 1);
    (next, first + second)
}

fn fields_of(y: &[f64; 18]) -> [[f64; 6]; 2] {
    [1, 2].map(|k| std::array::from_fn(|c| y[6 * k + c]))
}

fn phases_at(y: &[f64; 18]) -> [f64; 2] {
    phases(&std::array::from_fn(|c| y[c]), &fields_of(y))
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
        // Half of η × M makes the pair canonical in coordinates that rotate with the section.
        let p = d_moment + turn.cross(moment) * 0.5;
        (DVec2::new(turn.dot(e), turn.dot(g)), DVec2::new(p.dot(e), p.dot(g)))
    };
    let [(x0, p0), (x1, p1)] = [part(&fields[0]), part(&fields[1])];
    let (x, p) = (DMat2::from_cols(x0, x1), DMat2::from_cols(p0, p1));
    let det = x.determinant();
    let adjugate = DMat2::from_cols_array(&[x.y_axis.y, -x.x_axis.y, -x.y_axis.x, x.x_axis.x]);
    // P adj(X) is det(X) times the symmetric matrix; this form has no division by zero.
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

/// The number of phases that wrapped around, by the smallest possible motion, and the size of that motion.
fn passed(before: [f64; 2], now: [f64; 2]) -> (usize, f64) {
    let moved = |count: usize| {
        let after = match count {
            0 => now,
            1 => [now[1], now[0] + PI],
            _ => [now[0] + PI, now[1] + PI],
        };
        (after[0] - before[0]).abs() + (after[1] - before[1]).abs()
    };
    let all = [0, 1, 2].map(|count| (count, moved(count)));
    all.into_iter().min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}

/// The fields, orthonormalised; only their plane matters.
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
