//! The body as a few spheres, as the paper has it. [paper] §3.1

use frisure_strands::Surface;
use glam::DVec3;

use super::distance::SignedDistance;

/// A ball of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre (m).
    pub centre: DVec3,
    /// Radius (m).
    pub radius: f64,
}

/// The spheres stop being added when no scalp vertex lies farther from them (m) …
const SCALP_GAP: f64 = 2.5e-3;
/// … and no other vertex farther than this (m).
const SKIN_GAP: f64 = 8e-3;
/// … or when there are this many.
const MOST: usize = 96;
/// Smaller spheres are not worth having (m): an ear would take dozens.
const LEAST: f64 = 7e-3;
/// How far a sphere may stand out of the skin (m): it then touches more of it.
const STAND_OUT: f64 = 5e-4;

/// Spheres inside the skin, each the largest that touches the vertex farthest from those before.
pub(crate) fn fit(surface: &Surface, scalp: &[f64], inside: &SignedDistance) -> Vec<Sphere> {
    let normals = surface.vertex_normals();
    let mut gaps = vec![f64::INFINITY; scalp.len()];
    let mut spheres = Vec::new();
    let mut tried = vec![false; scalp.len()];
    while spheres.len() < MOST {
        let Some(worst) = farthest(&gaps, scalp, &tried) else { break };
        tried[worst] = true;
        let p = surface.positions()[worst];
        let sphere = largest_at(p, normals[worst], inside);
        if sphere.radius < LEAST {
            continue;
        }
        spheres.push(sphere);
        for (gap, q) in gaps.iter_mut().zip(surface.positions()) {
            *gap = gap.min(q.distance(sphere.centre) - sphere.radius);
        }
    }
    spheres
}

/// The vertex that most exceeds what it is allowed, if any does.
fn farthest(gaps: &[f64], scalp: &[f64], tried: &[bool]) -> Option<usize> {
    let excess = |i: usize| gaps[i] / if scalp[i] > 0.0 { SCALP_GAP } else { SKIN_GAP };
    (0..gaps.len())
        .filter(|&i| !tried[i] && excess(i) > 1.0)
        .max_by(|&i, &j| excess(i).total_cmp(&excess(j)).then(j.cmp(&i)))
}

/// The largest ball inside the skin that touches it at `p`, where the outward normal is `normal`.
fn largest_at(p: DVec3, normal: DVec3, inside: &SignedDistance) -> Sphere {
    let fits = |r: f64| -inside.value(p - normal * (r - STAND_OUT)) > r - 2.0 * STAND_OUT;
    let (mut low, mut high) = (0.0, 0.2);
    // The first radius that does not fit: beyond the middle of the body another one could.
    let mut r = 2e-3;
    while r < high {
        if fits(r) {
            low = r;
        } else {
            high = r;
        }
        r += 2e-3;
    }
    for _ in 0..20 {
        let middle = 0.5 * (low + high);
        if fits(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Sphere { centre: p - normal * (low - STAND_OUT), radius: low }
}
