//! The body as a few spheres, as the paper has it. [paper] §3.1

use frisure_strands::Surface;
use glam::DVec3;

use super::distance::SignedDistance;
use super::landmarks::Landmarks;

/// A ball of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// Centre (m).
    pub centre: DVec3,
    /// Radius (m).
    pub radius: f64,
}

/// The spheres stop being added when no scalp vertex lies farther from them than this (m) …
const SCALP_GAP: f64 = 2.5e-3;
/// … and no other vertex of the head farther than this (m), more below it …
const SKIN_GAP: f64 = 8e-3;
/// … or when there are this many.
const MOST: usize = 96;
/// Smaller spheres are not worth having (m): an ear would take dozens.
const LEAST: f64 = 1.2e-2;
/// How far a sphere may stand out of the skin (m): it then touches more of it. These five are chosen.
const STAND_OUT: f64 = 1e-3;

/// Spheres inside the skin, each the largest that touches the vertex farthest from those before.
pub(crate) fn fit(
    surface: &Surface,
    scalp: &[f64],
    landmarks: &Landmarks,
    inside: &SignedDistance,
) -> Vec<Sphere> {
    let normals = surface.vertex_normals();
    let allowed: Vec<f64> = surface
        .positions()
        .iter()
        .zip(scalp)
        .map(|(&p, &weight)| if weight >= 0.5 { SCALP_GAP } else { skin_gap(p, landmarks) })
        .collect();
    let mut gaps = vec![f64::INFINITY; scalp.len()];
    let mut spheres = Vec::new();
    while spheres.len() < MOST {
        let Some(worst) = farthest(&gaps, &allowed) else { break };
        let sphere = largest_at(surface.positions()[worst], normals[worst], inside);
        // Whatever comes of it, this vertex has had its turn.
        gaps[worst] = 0.0;
        if sphere.radius >= LEAST {
            spheres.push(sphere);
            for (gap, q) in gaps.iter_mut().zip(surface.positions()) {
                *gap = gap.min(q.distance(sphere.centre) - sphere.radius);
            }
        } else {
            forget(&mut gaps, surface, worst);
        }
    }
    spheres
}

/// What is allowed away from the scalp (m): the shoulders may be rough, hair rarely rests there.
fn skin_gap(p: DVec3, landmarks: &Landmarks) -> f64 {
    // In multiples of about the width of the head, beyond which the shoulders begin.
    let away = p.distance(landmarks.cranium_centre) / (1.9 * landmarks.width / 2.0);
    SKIN_GAP * away.max(1.0).powi(2)
}

/// Leaves out what lies around a vertex where no sphere fits: ears, lips, the tip of the nose.
fn forget(gaps: &mut [f64], surface: &Surface, vertex: usize) {
    let p = surface.positions()[vertex];
    for (gap, q) in gaps.iter_mut().zip(surface.positions()) {
        if q.distance_squared(p) < LEAST * LEAST / 4.0 {
            *gap = 0.0;
        }
    }
}

/// The vertex that most exceeds what it is allowed, if any does.
fn farthest(gaps: &[f64], allowed: &[f64]) -> Option<usize> {
    let excess = |i: usize| gaps[i] / allowed[i];
    (0..gaps.len())
        .filter(|&i| excess(i) > 1.0)
        .max_by(|&i, &j| excess(i).total_cmp(&excess(j)).then(j.cmp(&i)))
}

/// The largest ball inside the skin that touches it at `p`, where the outward normal is `normal`.
fn largest_at(p: DVec3, normal: DVec3, inside: &SignedDistance) -> Sphere {
    let fits = |r: f64| -inside.value(p - normal * (r - STAND_OUT)) > r - 2.0 * STAND_OUT;
    // In steps, since beyond the middle of the body another one could fit; then halving the last. Chosen.
    const STEP: f64 = 2e-3;
    let mut low = STEP;
    while fits(low + STEP) {
        low += STEP;
    }
    // Twelve halvings of 2 mm: to half a micrometre.
    let mut high = low + STEP;
    for _ in 0..12 {
        let middle = 0.5 * (low + high);
        if fits(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    Sphere { centre: p - normal * (low - STAND_OUT), radius: low }
}

#[cfg(test)]
mod tests {
    use crate::head::test_shapes::mannequin;

    #[test]
    fn a_few_dozen_spheres_cover_the_scalp_and_stay_inside() {
        let head = mannequin();
        let spheres = head.spheres();
        assert!((30..=96).contains(&spheres.len()), "{}", spheres.len());
        for (p, &weight) in head.surface().positions().iter().zip(head.scalp()) {
            let gap = spheres
                .iter()
                .map(|s| p.distance(s.centre) - s.radius)
                .fold(f64::INFINITY, f64::min);
            if weight >= 0.5 {
                assert!(gap < 3e-3, "{p} lies {gap} m from the spheres");
                assert!(gap > -3e-3, "a sphere stands {gap} m out of {p}");
            }
            // Ears and nose stand out of the spheres, and below the neck they are rough.
            assert!(
                gap < if p.z > -0.165 { 4e-2 } else { 0.1 },
                "{p} lies {gap} m from the spheres"
            );
        }
    }
}
