//! The contact forces from beneath with which a rod in balance has the least elastic energy.

use glam::DVec3;

use crate::chain::Shape;
use crate::rod::Rod;

/// Sweeps of coordinate descent over all nodes: a bound on time, since the forces of neighbours converge slowly. Chosen by
/// trial; not measured further.
const SWEEPS: usize = 80;

/// Ridge regularisation, relative to the diagonal: keeps forces bounded where they hardly matter. Chosen by trial.
const RIDGE: f64 = 1e-6;

/// The forces (N) along given directions, none of which pulls, with which the elastic energy of a rod in balance is
/// least: non-negative least squares by coordinate descent.
///
/// `loads` are the weight and what else acts on each element (N), at its middle.
pub(super) fn least_energy_forces(
    rod: &Rod,
    shape: &Shape,
    loads: &[DVec3],
    beneath: &[Option<DVec3>],
) -> Vec<f64> {
    assert_eq!(beneath.len(), shape.positions.len(), "one direction per node");
    let elements = shape.controls.len();
    // Moments in units in which their squares are energies: E = Σ ½ h |K^(−½) Rᵀ M|². docs/theory.md (I2)
    let scale = (DVec3::ONE / rod.stiffness()).map(f64::sqrt);
    let middle = |i: usize| 0.5 * (shape.positions[i] + shape.positions[i + 1]);
    let scaled = |i: usize, moment: DVec3| scale * (shape.frames[i].transpose() * moment);
    let pushed = |i: usize, node: usize, way: DVec3| {
        scaled(i, (shape.positions[node] - middle(i)).cross(way))
    };

    // Moments of the loads alone.
    let mut moments: Vec<DVec3> = (0..elements)
        .map(|i| {
            let beyond = (i + 1..elements).map(|k| (middle(k) - middle(i)).cross(loads[k]));
            scaled(i, beyond.sum())
        })
        .collect();
    // Nodes with a support, and the square of the moments of a unit force there.
    let mut forces = vec![0.0; beneath.len()];
    let supported: Vec<(usize, DVec3, f64)> = (beneath.iter().enumerate().skip(1))
        .filter_map(|(node, way)| {
            let way = (*way)?;
            let lever: f64 = (0..node).map(|i| pushed(i, node, way).length_squared()).sum();
            (lever > 0.0).then_some((node, way, lever * (1.0 + RIDGE)))
        })
        .collect();
    for _ in 0..SWEEPS {
        // From the tip, whose weight has the longest lever.
        for &(node, way, lever) in supported.iter().rev() {
            // Exact minimum of the energy along this force, if it pushes: f_j ← max(0, f_j − m_j·m/|m_j|²). (I2)
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
