//! Light that goes beneath the skin and comes out nearby: normalised diffusion.
//!
//! The profile is that of Burley 2015 ("Extending the Disney BRDF to a BSDF with integrated subsurface scattering") with the
//! scale of Christensen and Burley 2015 ("Approximate reflectance profiles for efficient subsurface scattering"); places of
//! exit are found by probe rays along three axes (King et al. 2013, "BSSRDF importance sampling"; pbrt-v3, §15.4).

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::accel::{Ray, SceneBvh, SkinHit};

/// How far green and blue light go in skin, over red light: 1.37 and 0.68 mm over 3.67 mm (Jensen et al. 2001,
/// doi:10.1145/383259.383319, skin 1).
const REACH: Vec3 = Vec3::new(1.0, 0.373, 0.185);

/// Radius of the farthest exit, in lengths d of the profile; 0.4 % of the light comes out farther away. Chosen.
const FARTHEST: f32 = 16.0;

/// Most layers of skin that a probe ray meets. Chosen: an ear has four.
const LAYERS: usize = 6;

/// Probabilities of probe rays along the normal and along the two other axes (as pbrt-v3).
const AXES: [f32; 3] = [0.5, 0.25, 0.25];

/// A material beneath whose surface light scatters.
pub(super) struct Subsurface {
    albedo: Vec3,
    /// Length d of the profile for each colour (m).
    lengths: Vec3,
}

impl Subsurface {
    /// A material of this diffuse reflectance in which red light has this diffuse mean free path (m).
    pub(super) fn new(albedo: Vec3, reach: f32) -> Self {
        // Christensen and Burley 2015, (8): d = ℓ/s with s = 3.5 + 100 (A − 0.33)⁴ for a diffuse mean free path ℓ.
        let shifted = albedo - Vec3::splat(0.33);
        let scale = Vec3::splat(3.5) + 100.0 * (shifted * shifted) * (shifted * shifted);
        Self { albedo, lengths: reach * REACH / scale }
    }

    /// R(r)/A: light per area that comes out at a distance `r` (m) of where it went in, by colour (1/m²).
    fn profile(&self, r: f32) -> Vec3 {
        Vec3::from_array(self.lengths.to_array().map(|d| profile(r, d)))
    }

    /// A place where light comes out that a ray in the direction of `hit` sees, and its weight by colour. `random` has
    /// numbers in [0, 1): colour and axis, radius, angle, layer.
    pub(super) fn exit(
        &self,
        bvh: &SceneBvh,
        hit: &SkinHit,
        random: [f32; 4],
    ) -> Option<(SkinHit, Vec3)> {
        // 1. An axis, and a place on the disc across it by the profile of one colour.
        let frame = frame(hit.normal);
        // One stratified number gives both: a third of its range is a colour, and where it is in that third the axis.
        let scaled = 3.0 * random[0];
        let (colour, which) = ((scaled as usize).min(2), scaled.fract());
        let axis = if which < AXES[0] { 0 } else { 1 + usize::from(which >= AXES[0] + AXES[1]) };
        let d = self.lengths[colour];
        let (radius, farthest) = (sampled_radius(random[1], d), FARTHEST * d);
        if radius >= farthest {
            return None;
        }
        let (sin, cos) = (TAU * random[2]).sin_cos();
        let (u, v, w) = (frame[(axis + 1) % 3], frame[(axis + 2) % 3], frame[axis]);
        let half = (farthest * farthest - radius * radius).sqrt();
        // 2. All skin on the line through it along the axis, within a ball around the hit.
        let start = hit.position + radius * (cos * u + sin * v) + half * w;
        let mut found = [*hit; LAYERS];
        let (mut count, mut from) = (0, 0.0);
        while count < LAYERS {
            let ray = Ray::new(start - from * w, -w);
            let Some(layer) = bvh.closest_skin_hit(&ray, 2.0 * half - from) else { break };
            from += layer.t + STEP;
            found[count] = layer;
            count += 1;
        }
        if count == 0 {
            return None;
        }
        // 3. One of them, and how probable it was by all axes and colours (multiple importance sampling).
        let exit = found[((random[3] * count as f32) as usize).min(count - 1)];
        let way = exit.position - hit.position;
        let distance = way.length();
        // A probe ray of a colour ends at its ball: a colour whose ball the exit lies beyond cannot have found it.
        let reaches = self.lengths.to_array().map(|d| distance < FARTHEST * d);
        let pdf: f32 = (0..3)
            .map(|k| {
                let along = way.dot(frame[k]);
                let across = (way.length_squared() - along * along).max(0.0).sqrt();
                let profiles = self.profile(across).to_array();
                let radial: f32 = (0..3).filter(|c| reaches[*c]).map(|c| profiles[c] / 3.0).sum();
                AXES[k] * radial * exit.normal.dot(frame[k]).abs()
            })
            .sum();
        let weight = self.albedo * self.profile(distance) * (count as f32 / pdf);
        (pdf > 0.0 && weight.is_finite()).then_some((exit, weight))
    }
}

/// Distance (m) by which a probe ray goes on behind a layer of skin. Chosen.
const STEP: f32 = 2e-6;

/// (e^(−r/d) + e^(−r/3d)) / 8πdr: Burley's profile for one colour, of integral 1 over the plane.
fn profile(r: f32, d: f32) -> f32 {
    // The pole at 0 has a finite integral; a micrometre is below the precision of a hit.
    let r = r.max(1e-6);
    ((-r / d).exp() + (-r / (3.0 * d)).exp()) / (8.0 * PI * d * r)
}

/// A radius with the density 2πr·[`profile`]: a quarter of the first exponential and three quarters of the second.
fn sampled_radius(u: f32, d: f32) -> f32 {
    let (u, scale) = if u < 0.25 { (4.0 * u, d) } else { ((u - 0.25) / 0.75, 3.0 * d) };
    -(1.0 - u).max(1e-7).ln() * scale
}

fn frame(normal: Vec3) -> [Vec3; 3] {
    let (x, y) = normal.any_orthonormal_pair();
    [normal, x, y]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::accel::{CurveOptions, Hit};
    use frisure_strands::{Strands, Surface};
    use glam::DVec3;

    #[test]
    fn the_profile_has_an_integral_of_one_and_radii_are_drawn_from_it() {
        let d = 1e-3;
        let (mut whole, mut mean, n) = (0.0_f64, 0.0_f64, 200_000);
        for i in 0..n {
            let r = 0.04 * (i as f32 + 0.5) / n as f32;
            let part = f64::from(TAU * r * profile(r, d)) * 0.04 / f64::from(n);
            whole += part;
            mean += part * f64::from(r);
        }
        assert!((whole - 1.0).abs() < 2e-3, "{whole}");
        let sampled: f64 = (0..n)
            .map(|i| f64::from(sampled_radius((i as f32 + 0.5) / n as f32, d)) / f64::from(n))
            .sum();
        assert!((sampled / mean - 1.0).abs() < 0.01, "{sampled} {mean}");
    }

    #[test]
    fn a_plane_sends_all_light_out_again() {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
        let positions = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
        let surface = Surface::new(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
        let bvh = SceneBvh::new(&Strands::new(), Some(&surface), &CurveOptions::default()).unwrap();
        let down = Ray::new(Vec3::new(0.1, 0.05, 1.0), -Vec3::Z);
        let Some(Hit::Skin(hit)) = bvh.closest_hit(&down, 2.0) else { panic!("the plane is hit") };
        let skin = Subsurface::new(Vec3::ONE, 3.7e-3);
        let n = 400_000_u32;
        // A Weyl sequence in four dimensions (Roberts' generalised golden ratio).
        let steps = [0.856_674_9_f64, 0.733_891_9, 0.628_706_7, 0.538_597_3];
        let sum: DVec3 = (0..n)
            .filter_map(|i| {
                let random = steps.map(|s| (s * f64::from(i)).fract() as f32);
                skin.exit(&bvh, &hit, random).map(|(_, weight)| weight.as_dvec3())
            })
            .sum();
        let mean = sum / f64::from(n);
        assert!((mean - DVec3::ONE).abs().max_element() < 0.02, "{mean}");
    }
}
