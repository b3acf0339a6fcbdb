//! What lies under a rod and bears part of its weight.

use glam::DVec3;

use crate::Rod;
use crate::chain::Shape;

/// Sweeps over all nodes.
const SWEEPS: usize = 80;

/// Share of a node's own lever that keeps forces from growing where they hardly matter.
const RIDGE: f64 = 1e-6;

/// The forces (N) along given directions, none of which pulls, with which the elastic energy of a rod in balance is
/// least: non-negative least squares by coordinate descent.
pub(super) fn least(rod: &Rod, shape: &Shape, beneath: &[Option<DVec3>]) -> Vec<f64> {
    assert_eq!(beneath.len(), shape.positions.len(), "one direction per node");
    let elements = shape.controls.len();
    let h = rod.length() / elements as f64;
    // Moments in units in which their squares are energies.
    let scale = (DVec3::ONE / rod.stiffness()).map(f64::sqrt);
    let middle = |i: usize| 0.5 * (shape.positions[i] + shape.positions[i + 1]);
    let scaled = |i: usize, moment: DVec3| scale * (shape.frames[i].transpose() * moment);
    let pushed = |i: usize, node: usize, way: DVec3| {
        scaled(i, (shape.positions[node] - middle(i)).cross(way))
    };

    let weight = DVec3::NEG_Z * (rod.weight() * h);
    let mut moments: Vec<DVec3> = (0..elements)
        .map(|i| {
            let beyond = (i + 1..elements).map(|k| (middle(k) - middle(i)).cross(weight));
            scaled(i, beyond.sum())
        })
        .collect();
    let mut forces = vec![0.0; beneath.len()];
    let held: Vec<(usize, DVec3, f64)> = (beneath.iter().enumerate().skip(1))
        .filter_map(|(node, way)| {
            let way = (*way)?;
            let lever: f64 = (0..node).map(|i| pushed(i, node, way).length_squared()).sum();
            (lever > 0.0).then_some((node, way, lever * (1.0 + RIDGE)))
        })
        .collect();
    for _ in 0..SWEEPS {
        // From the tip, whose weight has the longest lever.
        for &(node, way, lever) in held.iter().rev() {
            let slope: f64 = (0..node).map(|i| pushed(i, node, way).dot(moments[i])).sum();
            let force = (forces[node] - slope / lever).max(0.0);
            let change = force - forces[node];
            if change != 0.0 {
                for (i, moment) in moments.iter_mut().enumerate().take(node) {
                    *moment += pushed(i, node, way) * change;
                }
                forces[node] = force;
            }
        }
    }
    forces
}
