//! The BSDF of skin and floor: a diffuse body under a rough dielectric coat ("rough plastic").
//!
//! The coat is a GGX (Trowbridge–Reitz) microfacet surface with Smith's masking and shadowing (Walter et al. 2007),
//! sampled by its visible normals (Heitz 2018, *Sampling the GGX distribution of visible normals*), with Schlick's
//! approximation of the Fresnel term. The body scatters what the coat transmits twice, after Kelemen and
//! Szirmay-Kalos 2001, *A microfacet based coupled specular-matte BRDF model with importance sampling*: reciprocal
//! and energy-conserving.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

/// The BSDF for one direction to the eye.
#[derive(Clone, Copy, Debug)]
pub(super) struct RoughPlastic {
    frame: [Vec3; 3],
    /// To the eye, in the frame.
    eye: Vec3,
    body: Vec3,
    /// F0: reflectance of the coat at normal incidence.
    f0: f32,
    roughness: f32,
    /// Probability with which the coat is sampled.
    coat_probability: f32,
}

impl RoughPlastic {
    /// The BSDF of a surface with a unit `normal`, for the unit direction `eye` on the same side: diffuse
    /// reflectance `body`, reflectance `f0` of the coat at normal incidence, `roughness` of the coat (GGX α), 0.05
    /// to 1.
    pub(super) fn new(normal: Vec3, eye: Vec3, body: Vec3, f0: f32, roughness: f32) -> Self {
        let x = normal.any_orthonormal_vector();
        let frame = [x, normal.cross(x), normal];
        let local = Vec3::from_array(frame.map(|axis| axis.dot(eye)));
        // An interpolated normal may point away from the eye although the face does not.
        let eye = local.with_z(local.z.max(1e-3)).normalize();
        let coat = fresnel(f0, eye.z);
        let through = (1.0 - coat) * body.max_element();
        // In proportion to what coat and body reflect of light from the eye's direction.
        let coat_probability = if f0 > 0.0 { coat / (coat + through).max(1e-6) } else { 0.0 };
        Self { frame, eye, body, f0, roughness, coat_probability }
    }

    /// The probability with which [`Self::sample`] draws from the coat.
    pub(super) fn coat_probability(&self) -> f32 {
        self.coat_probability
    }

    /// The coat alone, without the body.
    pub(super) fn coat_alone(self) -> Self {
        Self { body: Vec3::ZERO, coat_probability: 1.0, ..self }
    }

    /// Share of the light towards the eye that the coat lets out.
    pub(super) fn let_out(&self) -> f32 {
        // Without a coat nothing is held back.
        if self.f0 > 0.0 { 1.0 - fresnel(self.f0, self.eye.z) } else { 1.0 }
    }

    /// BSDF times the cosine, and the pdf of [`Self::sample`] (1/sr).
    pub(super) fn evaluate(&self, towards: Vec3) -> (Vec3, f32) {
        let towards = Vec3::from_array(self.frame.map(|axis| axis.dot(towards)));
        if towards.z <= 0.0 {
            return (Vec3::ZERO, 0.0);
        }
        let diffuse = (1.0 - self.coat_probability) * towards.z / PI;
        if self.f0 <= 0.0 {
            return (self.body * (towards.z / PI), diffuse);
        }
        let body = self.body * (self.diffuse(towards.z) * towards.z);
        let (coat, density) = self.coat(towards);
        (body + Vec3::splat(coat), diffuse + self.coat_probability * density)
    }

    /// Samples a unit direction from numbers in [0, 1).
    pub(super) fn sample(&self, which: f32, [u, v]: [f32; 2]) -> Vec3 {
        let local = if which < self.coat_probability {
            let half = self.visible_normal(u, v);
            2.0 * self.eye.dot(half) * half - self.eye
        } else {
            // In proportion to the cosine: a uniform disc lifted onto the hemisphere (Malley).
            let (r, (s, c)) = (u.sqrt(), (TAU * v).sin_cos());
            Vec3::new(r * c, r * s, (1.0 - u).sqrt())
        };
        (self.frame[0] * local.x + self.frame[1] * local.y + self.frame[2] * local.z).normalize()
    }

    fn diffuse(&self, cosine: f32) -> f32 {
        let passed = |c: f32| 1.0 - fresnel(self.f0, c);
        // The mean of what passes, weighted by the cosine: of (1 − c)⁵ it is 1/21.
        let mean = (1.0 - self.f0) * 20.0 / 21.0;
        passed(cosine) * passed(self.eye.z) / (PI * mean)
    }

    /// The coat's BSDF times the cosine, and the pdf of its samples (1/sr).
    fn coat(&self, towards: Vec3) -> (f32, f32) {
        let half = (towards + self.eye).normalize();
        // D = α²/π ((α² − 1) cos²h + 1)², Smith's Λ = ½ (√(1 + α² tan²θ) − 1).
        let a2 = self.roughness * self.roughness;
        let slope = 1.0 + (a2 - 1.0) * half.z * half.z;
        let density = a2 / (PI * slope * slope);
        let hidden = |c: f32| ((1.0 + a2 * (1.0 / (c * c) - 1.0)).sqrt() - 1.0) * 0.5;
        let (to_eye, to_light) = (hidden(self.eye.z), hidden(towards.z));
        // Visible normals have the density D G₁ h·e/e_z, per light direction D G₁/4e_z with G₁ = 1/(1 + Λ). The BSDF times the
        // cosine is F D G₂/4e_z with the height-correlated G₂ = 1/(1 + Λ + Λ′).
        let pdf = density / (4.0 * self.eye.z * (1.0 + to_eye));
        let both = density / (4.0 * self.eye.z * (1.0 + to_eye + to_light));
        (fresnel(self.f0, half.dot(self.eye)) * both, pdf)
    }

    /// Samples a visible normal of the coat (Heitz 2018, listing 1).
    fn visible_normal(&self, u: f32, v: f32) -> Vec3 {
        let a = self.roughness;
        // 1. Stretch the view so that the microfacets become a hemisphere. 2. A point of the disc that the view shows of it,
        // warped to its projected half. 3. Back onto the hemisphere, and unstretched.
        let stretched = Vec3::new(a * self.eye.x, a * self.eye.y, self.eye.z).normalize();
        let level = stretched.x * stretched.x + stretched.y * stretched.y;
        let x = match level > 1e-12 {
            true => Vec3::new(-stretched.y, stretched.x, 0.0) / level.sqrt(),
            false => Vec3::X,
        };
        let y = stretched.cross(x);
        let (r, (s, c)) = (u.sqrt(), (TAU * v).sin_cos());
        let p = r * c;
        let lean = 0.5 * (1.0 + stretched.z);
        let q = (1.0 - lean) * (1.0 - p * p).max(0.0).sqrt() + lean * r * s;
        let out = p * x + q * y + (1.0 - p * p - q * q).max(0.0).sqrt() * stretched;
        Vec3::new(a * out.x, a * out.y, out.z.max(1e-6)).normalize()
    }
}

/// Schlick's approximation of the Fresnel reflectance (Schlick 1994, (24)).
fn fresnel(f0: f32, cosine: f32) -> f32 {
    f0 + (1.0 - f0) * (1.0 - cosine.clamp(0.0, 1.0)).powi(5)
}

#[cfg(test)]
mod tests {
    use super::*;

    const N: usize = 512;

    fn over_the_sphere(mut f: impl FnMut(Vec3) -> f32) -> f32 {
        let mut sum = 0.0;
        for i in 0..N {
            for j in 0..N {
                let z = 2.0 * (i as f32 + 0.5) / N as f32 - 1.0;
                let (s, c) = (TAU * (j as f32 + 0.5) / N as f32).sin_cos();
                let r = (1.0 - z * z).sqrt();
                sum += f64::from(f(Vec3::new(r * c, r * s, z)));
            }
        }
        (sum * 2.0 * f64::from(TAU) / (N * N) as f64) as f32
    }

    fn seen_at(angle: f32) -> RoughPlastic {
        let (s, c) = angle.sin_cos();
        RoughPlastic::new(Vec3::Z, Vec3::new(s, 0.0, c), Vec3::splat(0.9), 0.04, 0.3)
    }

    #[test]
    fn the_pdf_integrates_to_one_and_no_light_is_gained() {
        for angle in [0.0, 0.7, 1.3, 1.5] {
            let plastic = seen_at(angle);
            let whole = over_the_sphere(|towards| plastic.evaluate(towards).1);
            // Of the coat's mirrored directions some point into the surface.
            assert!(whole < 1.005 && whole > 0.9, "{angle}: {whole}");
            let light = over_the_sphere(|towards| plastic.evaluate(towards).0.x);
            assert!(light < 1.0 && light > if angle < 1.4 { 0.6 } else { 0.4 }, "{angle}: {light}");
        }
    }

    #[test]
    fn importance_sampling_gives_the_integral_over_directions() {
        for angle in [0.2, 1.2] {
            let plastic = seen_at(angle);
            let mut sum = 0.0;
            for i in 0..N {
                for j in 0..N {
                    let (u, v) = (i as f32 + 0.5, j as f32 + 0.5);
                    let which = ((i * 7 + j * 3) % N) as f32 / N as f32;
                    let towards = plastic.sample(which, [u / N as f32, v / N as f32]);
                    let (value, pdf) = plastic.evaluate(towards);
                    sum += if pdf > 0.0 { f64::from(value.x / pdf) } else { 0.0 };
                }
            }
            let light = over_the_sphere(|towards| plastic.evaluate(towards).0.x);
            let sampled = (sum / (N * N) as f64) as f32;
            assert!((sampled / light - 1.0).abs() < 0.01, "{angle}: {sampled} {light}");
        }
    }

    #[test]
    fn the_bsdf_is_reciprocal() {
        let (a, b) = (Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.3, 0.5, 0.7).normalize());
        let from = |eye| RoughPlastic::new(Vec3::Z, eye, Vec3::splat(0.5), 0.04, 0.3);
        let (there, back) = (from(a).evaluate(b).0.x / b.z, from(b).evaluate(a).0.x / a.z);
        assert!((there / back - 1.0).abs() < 1e-3, "{there} {back}");
    }
}
