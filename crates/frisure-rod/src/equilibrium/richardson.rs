//! Richardson extrapolation from two divisions of a rod, docs/theory.md, "Extrapolation, accuracy and the estimate of
//! error".

use glam::{DQuat, DVec3};

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

/// Richardson extrapolation of second order at the nodes of the coarse shape:
/// `(4 r_2N − r_N) / 3`.
pub(super) fn extrapolate(coarse: &Shape, fine: &Shape) -> Vec<DVec3> {
    // r_N = r + e h² + O(h⁴): four times the finer less the coarser cancels e.
    let fine = fine.positions.iter().step_by(2);
    coarse.positions.iter().zip(fine).map(|(c, f)| (*f * 4.0 - *c) / 3.0).collect()
}

/// What extrapolation adds to the fine shape at the nodes of the coarse one.
pub(super) fn corrections(coarse: &Shape, fine: &Shape) -> Vec<Correction> {
    (0..coarse.positions.len())
        .map(|i| {
            // (4 x_2N − x_N)/3 − x_2N = (x_2N − x_N)/3, for positions and for rotation vectors alike.
            let (position, frame) = (fine.positions[2 * i], fine.frames[2 * i]);
            // In the world frame: the left factor of R_2N = exp([ω]×) R_N.
            let turn = deviation(&(frame * coarse.frames[i].transpose())) / 3.0;
            Correction {
                shift: (position - coarse.positions[i]) / 3.0,
                slope: DQuat::from_scaled_axis(turn) * frame.z_axis - frame.z_axis,
                turn,
            }
        })
        .collect()
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
