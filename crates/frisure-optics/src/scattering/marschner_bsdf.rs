//! The model of Marschner et al. 2003 as the BSDF of a hit.

use glam::Vec3;

use super::film::under_film;
use super::{BsdfSample, Evaluation, Fibre, HairBsdf, Marschner2003};

/// Offsets across the width for which directions are drawn. Chosen: the lobes of neighbouring ones overlap.
const OFFSETS: usize = 8;

/// The BSDF of a fibre by Marschner et al. 2003, for one direction to the eye: [`Marschner2003`], halved.
///
/// As printed, the Gaussians of the half angle count light twice, and light that goes from fibre to fibre would grow without end.
/// Without absorption, halved, the model scatters the light that falls in, within a tenth: it leaves out what is reflected more than
/// once inside, and approximates the rest.
///
/// It is far-field: the mean over the width of the fibre, wherever the ray meets it. Directions are drawn from the conserving model
/// at one of several offsets, so their weights are not bounded by 1.
///
/// ```
/// use frisure_optics::scattering::{Fibre, FibreSpec, MarschnerBsdf};
/// use glam::Vec3;
///
/// let fibre = Fibre::new(FibreSpec::default())?;
/// let bsdf = MarschnerBsdf::new(&fibre, Vec3::splat(0.2), Vec3::X); // local directions: d1, d2, tangent
/// let sample = bsdf.sample([0.3, 0.6, 0.2, 0.8]);
/// let there = bsdf.evaluate(sample.wi);
/// assert!((sample.weight * sample.pdf - there.f_cos).length() < 1e-3 * there.f_cos.length());
/// # Ok::<(), frisure_optics::scattering::FibreError>(())
/// ```
#[derive(Clone, Debug)]
pub struct MarschnerBsdf<'a> {
    model: Marschner2003,
    /// Unit local direction to the eye.
    wo: Vec3,
    /// The conserving model at offsets across the width.
    drawn: [HairBsdf<'a>; OFFSETS],
}

impl Marschner2003 {
    /// The model of a fibre that absorbs `absorption` per mean radius: as wide along the fibre as the conserving model and shifted
    /// as far; what is particular to this model, the glints, is in the middle of the paper's ranges.
    #[must_use]
    pub fn of(fibre: &Fibre, absorption: Vec3) -> Self {
        let spec = under_film(fibre.spec());
        Self {
            axis_ratio: spec.axis_ratio,
            index: spec.index,
            // The Gaussians are of the half angle: half of what the sum of both inclinations has.
            shift: -spec.tilt,
            width: 0.5 * fibre.longitudinal.deviation(),
            absorption,
            ..Self::default()
        }
    }
}

impl<'a> MarschnerBsdf<'a> {
    /// Creates the BSDF for the unit local direction `wo` to the eye, where the fibre absorbs `absorption` per mean radius.
    #[must_use]
    pub fn new(fibre: &'a Fibre, absorption: Vec3, wo: Vec3) -> Self {
        let offset = |i: usize| (2 * i + 1) as f32 / OFFSETS as f32 - 1.0;
        Self {
            model: Marschner2003::of(fibre, absorption),
            wo,
            drawn: std::array::from_fn(|i| HairBsdf::coloured(fibre, absorption, wo, offset(i))),
        }
    }

    /// The model for unit local direction `wi` to the light, and the pdf of [`Self::sample`].
    #[must_use]
    pub fn evaluate(&self, wi: Vec3) -> Evaluation {
        // ∫ g(θh) dθi = 2, since θh = ½ (θo + θi). The cubic that stands for the azimuth may leave a negative remainder of rounding.
        let f_cos = 0.5 * self.model.evaluate(self.wo, wi).max(Vec3::ZERO);
        let sum: f32 = self.drawn.iter().map(|bsdf| bsdf.evaluate(wi).pdf).sum();
        Evaluation { f_cos, pdf: sum / OFFSETS as f32 }
    }

    /// Draws a direction to the light from numbers in [0, 1).
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> BsdfSample {
        // One number says the offset, and what is left of it the lobe.
        let scaled = u[0] * OFFSETS as f32;
        let which = (scaled as usize).min(OFFSETS - 1);
        let left = (scaled - which as f32).clamp(0.0, 1.0 - f32::EPSILON);
        let wi = self.drawn[which].sample([left, u[1], u[2], u[3]]).wi;
        let Evaluation { f_cos, pdf } = self.evaluate(wi);
        let weight = if pdf > 0.0 { f_cos / pdf } else { Vec3::ZERO };
        BsdfSample { wi, weight, pdf }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scattering::FibreSpec;

    #[test]
    fn the_mean_of_samples_is_the_integral_of_the_model() {
        let fibre = Fibre::new(FibreSpec { axis_ratio: 1.2, ..FibreSpec::default() }).unwrap();
        let wo = Vec3::new(0.8, 0.0, 0.6);
        let bsdf = MarschnerBsdf::new(&fibre, Vec3::new(0.1, 0.4, 1.0), wo);
        let (n, mut exact, mut drawn) = (256_u16, Vec3::ZERO, Vec3::ZERO);
        for i in 0..n {
            for j in 0..n {
                let [u, v] = [i, j].map(|k| (f32::from(k) + 0.5) / f32::from(n));
                // Even over the sphere.
                let (z, phi) = (2.0 * u - 1.0, std::f32::consts::TAU * v);
                let across = (1.0 - z * z).sqrt();
                exact += bsdf.evaluate(Vec3::new(across * phi.cos(), across * phi.sin(), z)).f_cos;
                // The other two numbers by Weyl's sequence.
                let k = f32::from(i) * f32::from(n) + f32::from(j);
                let weyl = |a: f64| (f64::from(k) * a).fract() as f32;
                drawn += bsdf.sample([u, v, weyl(0.754_877_666), weyl(0.569_840_291)]).weight;
            }
        }
        let count = f32::from(n).powi(2);
        let exact = exact * (2.0 * std::f32::consts::TAU / count);
        let apart = (drawn / count - exact).abs() / exact;
        assert!(apart.max_element() < 0.02, "{exact} {apart}");
    }

    #[test]
    fn without_absorption_it_scatters_about_the_light_that_falls_in() {
        for axis_ratio in [1.0, 1.4] {
            let fibre = Fibre::new(FibreSpec { axis_ratio, ..FibreSpec::default() }).unwrap();
            for theta in [0.0_f32, 0.5, 1.0] {
                let bsdf = MarschnerBsdf::new(
                    &fibre,
                    Vec3::ZERO,
                    Vec3::new(theta.cos(), 0.0, theta.sin()),
                );
                let n = 300_u16;
                let part = |i: u16| (f32::from(i) + 0.5) / f32::from(n);
                let places = (0..n).flat_map(|i| (0..n).map(move |j| (part(i), part(j))));
                let sum: f32 = places
                    .map(|(u, v)| {
                        let (z, phi) = (2.0 * u - 1.0, std::f32::consts::TAU * v);
                        let across = (1.0 - z * z).sqrt();
                        bsdf.evaluate(Vec3::new(across * phi.cos(), across * phi.sin(), z)).f_cos.x
                    })
                    .sum();
                let albedo = sum * 2.0 * std::f32::consts::TAU / f32::from(n).powi(2);
                assert!((0.9..1.1).contains(&albedo), "{axis_ratio} {theta}: {albedo}");
            }
        }
    }
}
