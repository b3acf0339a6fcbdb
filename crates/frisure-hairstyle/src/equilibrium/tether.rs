//! A tether: damping in space of a guide on its way to rest.

use frisure_rod::potential::Field;
use frisure_rod::{Chain, Rod, Shape};
use glam::{DMat3, DVec3};

/// How far (m) its own weight pulls a guide against a tether of its firmness. Chosen by trial; not measured further.
const FIRST_SAG: f64 = 4e-3;

/// Stiffness (Pa) of a tether against which weight, elasticity and a further force (N) along the guide move it by about
/// [`FIRST_SAG`].
pub(super) fn firmness(rod: &Rod, force: f64) -> f64 {
    // The moment scale EI/L + ρSgL² over L² is a force per length (N/m); over a distance, a stiffness (Pa).
    rod.moment_scale() / rod.length().powi(2) / FIRST_SAG + force / (rod.length() * FIRST_SAG)
}

/// Largest distance (m) between nodes of two shapes.
pub(super) fn farthest(a: &Shape, b: &Shape) -> f64 {
    let moves = a.positions.iter().zip(&b.positions);
    moves.map(|(p, q)| p.distance_squared(*q)).fold(0.0, f64::max).sqrt()
}

/// Holds a guide near where it was, `½ c |r − r₀|²` per length.
pub(super) struct Tether<'a> {
    /// c (Pa).
    stiffness: f64,
    /// Distance between nodes (m).
    spacing: f64,
    from: &'a Shape,
}

impl<'a> Tether<'a> {
    /// Holds a rod of this division with `stiffness` (Pa) at the shape `from`. The field must be evaluated at nodes alone.
    pub(super) fn new(stiffness: f64, chain: &Chain<'_>, from: &'a Shape) -> Self {
        Self { stiffness, spacing: chain.arc()[1], from }
    }
}

impl Tether<'_> {
    fn away(&self, s: f64, p: DVec3) -> DVec3 {
        // With one sample per element the field is evaluated at nodes alone; rounding finds the node again.
        let node = ((s / self.spacing).round() as usize).min(self.from.positions.len() - 1);
        p - self.from.positions[node]
    }
}

impl Field for Tether<'_> {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        0.5 * self.stiffness * self.away(s, p).length_squared()
    }

    fn derivatives(&self, s: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        let identity = DMat3::from_diagonal(DVec3::splat(self.stiffness));
        Some((self.away(s, p) * self.stiffness, identity))
    }
}
