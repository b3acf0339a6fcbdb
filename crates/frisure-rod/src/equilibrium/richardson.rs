//! Richardson extrapolation from two divisions of a rod, docs/theory.md, "Extrapolation, accuracy and the estimate of
//! error".

use glam::{DMat3, DQuat, DVec3};

use crate::chain::Shape;
use crate::minimise::Energy;
use crate::rotation::deviation;

/// What Richardson extrapolation adds to a node.
#[derive(Clone, Copy, Debug)]
pub(super) struct Correction {
    /// To the position (m).
    pub(super) shift: DVec3,
    /// To the tangent, which is the derivative of the shift by arc length.
    pub(super) slope: DVec3,
    /// To the frame: a rotation vector (rad) in the world.
    pub(super) turn: DVec3,
}

pub(super) fn every(points: &[DVec3], step: usize) -> Vec<DVec3> {
    points.iter().step_by(step).copied().collect()
}

pub(super) fn largest_gap(a: &[DVec3], b: &[DVec3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max)
}

/// The extrapolated positions at all nodes of the fine shape: `(4 r_2N − r_N) / 3` at those of the coarse one.
pub(super) fn extrapolate(coarse: &Shape, fine: &Shape) -> Vec<DVec3> {
    let shifts = at_every_node(&shifts(coarse, fine));
    fine.positions.iter().zip(shifts).map(|(position, shift)| *position + shift).collect()
}

/// What extrapolation adds at the nodes of the coarse shape.
fn shifts(coarse: &Shape, fine: &Shape) -> Vec<DVec3> {
    // r_N = r + e h² + O(h⁴): (4 r_2N − r_N)/3 − r_2N = (r_2N − r_N)/3 cancels e.
    let fine = fine.positions.iter().step_by(2);
    coarse.positions.iter().zip(fine).map(|(coarse, fine)| (*fine - *coarse) / 3.0).collect()
}

/// What extrapolation adds to the fine shape.
pub(super) fn corrections(coarse: &Shape, fine: &Shape) -> Vec<Correction> {
    // In the world frame: the left factor of R_2N = exp([ω]×) R_N. A third of it, as of the positions.
    let turn =
        |(i, frame): (usize, &DMat3)| deviation(&(fine.frames[2 * i] * frame.transpose())) / 3.0;
    let turns: Vec<DVec3> = coarse.frames.iter().enumerate().map(turn).collect();
    (at_every_node(&shifts(coarse, fine)).into_iter().zip(at_every_node(&turns)))
        .zip(&fine.frames)
        .map(|((shift, turn), frame)| {
            let slope = DQuat::from_scaled_axis(turn) * frame.z_axis - frame.z_axis;
            Correction { shift, slope, turn }
        })
        .collect()
}

/// Values at the nodes of the coarse shape, and between them by the cubic through the four nearest.
fn at_every_node(values: &[DVec3]) -> Vec<DVec3> {
    // The error e h² is a smooth function of arc length, so that this one is of sixth order.
    let last = values.len() - 1;
    let middle = |i: usize| match (values.get(i.wrapping_sub(1)), values.get(i + 2)) {
        (Some(before), Some(after)) => {
            ((values[i] + values[i + 1]) * 9.0 - *before - *after) / 16.0
        }
        // At an end the cubic through the four last, with three elements or more.
        (None, Some(_)) if last >= 3 => {
            (values[0] * 5.0 + values[1] * 15.0 - values[2] * 5.0 + values[3]) / 16.0
        }
        (Some(_), None) if last >= 3 => {
            (values[last] * 5.0 + values[last - 1] * 15.0 - values[last - 2] * 5.0
                + values[last - 3])
                / 16.0
        }
        _ => (values[i] + values[i + 1]) * 0.5,
    };
    (0..=2 * last).map(|k| if k % 2 == 0 { values[k / 2] } else { middle(k / 2) }).collect()
}

pub(super) fn extrapolate_energy(coarse: &Energy, fine: &Energy) -> Energy {
    // The error of an energy is of second order in h too.
    let mix = |c: f64, f: f64| (4.0 * f - c) / 3.0;
    Energy {
        elastic: mix(coarse.elastic, fine.elastic),
        gravity: mix(coarse.gravity, fine.gravity),
        external: mix(coarse.external, fine.external),
    }
}
