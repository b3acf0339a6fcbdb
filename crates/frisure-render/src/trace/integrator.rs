//! The light along a ray.
//!
//! Path tracing with next-event estimation; light sampling and scattering share each path of light by
//! multiple importance sampling with the power heuristic (Veach 1997).

use std::f32::consts::{FRAC_1_PI, TAU};

use frisure_optics::scattering::{FibreFrame, Scattering};
use glam::Vec3;

use super::hair::Fibres;
use super::lights::{Outside, about};
use super::sampler::Sampler;
use crate::SkinLook;
use crate::accel::{HairHit, Hit, Ray, Scene, SkinHit};

/// Everything that light meets.
pub(super) struct World {
    pub(super) scene: Scene,
    pub(super) fibres: Fibres,
    pub(super) outside: Outside,
    pub(super) skin: SkinLook,
    pub(super) bounces: u32,
}

/// Bounces after which a path may end by chance.
const SURE_BOUNCES: u32 = 6;

/// Farthest that light is followed (m).
const FAR: f32 = 1e4;

/// Width of the skin's soft gloss: exponent of its lobe about the mirrored direction.
const GLOSS: f32 = 24.0;

/// Share of the light that it mirrors, per unit of [`SkinLook::gloss`].
const GLOSSED: f32 = 0.08;

/// Light and coverage along a ray.
pub(super) struct Seen {
    pub(super) radiance: Vec3,
    /// Whether the ray met anything.
    pub(super) covered: bool,
}

/// How light goes on from a hit.
struct Onward {
    towards: Vec3,
    weight: Vec3,
    pdf: f32,
}

/// What a hit does to light.
enum Matter<'a> {
    Hair { frame: FibreFrame, scattering: Scattering<'a> },
    Skin { normal: Vec3, eye: Vec3, look: &'a SkinLook },
}

impl World {
    /// Light that arrives along a ray from its start.
    pub(super) fn seen(&self, ray: Ray, sampler: &mut Sampler) -> Seen {
        let mut seen = Seen { radiance: Vec3::ZERO, covered: false };
        let (mut ray, mut throughput) = (ray, Vec3::ONE);
        // Density of the direction that led here; the eye's own is beyond choice.
        let mut chosen: Option<f32> = None;
        for bounce in 0..=self.bounces {
            let Some(hit) = self.scene.closest_hit(&ray, FAR) else {
                if let Some(pdf) = chosen {
                    let light = self.outside.radiance(ray.direction());
                    let share = power(pdf, self.outside.pdf(ray.direction()));
                    seen.radiance += throughput * light * share;
                }
                return seen;
            };
            seen.covered = true;
            if bounce == self.bounces {
                return seen;
            }
            let matter = self.matter(&hit, ray.direction());
            seen.radiance += throughput * self.direct(&hit, &matter, sampler);
            let Some(onward) = matter.sample(sampler) else { return seen };
            throughput *= onward.weight;
            if bounce >= SURE_BOUNCES {
                // Roulette: what goes on stands for what does not.
                let survives = throughput.max_element().min(0.98);
                if sampler.one() >= survives {
                    return seen;
                }
                throughput /= survives;
            }
            ray = Ray::new(hit.start(onward.towards), onward.towards);
            chosen = Some(onward.pdf);
        }
        seen
    }

    fn matter(&self, hit: &Hit, direction: Vec3) -> Matter<'_> {
        match hit {
            Hit::Hair(hit) => self.hair(hit, direction),
            Hit::Skin(SkinHit { smooth_normal, .. }) => {
                let eye = -direction;
                let normal =
                    if smooth_normal.dot(eye) < 0.0 { -*smooth_normal } else { *smooth_normal };
                Matter::Skin { normal, eye, look: &self.skin }
            }
        }
    }

    fn hair(&self, hit: &HairHit, direction: Vec3) -> Matter<'_> {
        let d1 = self.fibres.director(hit.strand, hit.segment, hit.u);
        let d1 = d1.unwrap_or_else(|| hit.tangent.any_orthonormal_vector());
        let frame = FibreFrame::new(hit.tangent, d1);
        let eye = frame.to_local(-direction);
        // A hit counts its offset along direction × tangent, a scattering along eye × tangent.
        let scattering = Scattering::new(self.fibres.of(hit.strand), eye, -hit.h);
        Matter::Hair { frame, scattering }
    }

    /// Light that comes straight from outside and is scattered towards the eye.
    fn direct(&self, hit: &Hit, matter: &Matter<'_>, sampler: &mut Sampler) -> Vec3 {
        let which = sampler.one();
        let light = self.outside.sample(which, sampler.pair());
        let (value, pdf) = matter.evaluate(light.towards);
        if light.pdf <= 0.0 || value.max_element() <= 0.0 {
            return Vec3::ZERO;
        }
        let ray = Ray::new(hit.start(light.towards), light.towards);
        if self.scene.occluded(&ray, FAR) {
            return Vec3::ZERO;
        }
        value * light.radiance * (power(light.pdf, pdf) / light.pdf)
    }
}

impl Matter<'_> {
    /// Scattering function times the cosine, and the density of [`Self::sample`] (1/sr).
    fn evaluate(&self, towards: Vec3) -> (Vec3, f32) {
        match self {
            Self::Hair { frame, scattering } => {
                let found = scattering.evaluate(frame.to_local(towards));
                (found.f_cos, found.pdf)
            }
            Self::Skin { normal, eye, look } => {
                let cosine = normal.dot(towards);
                if cosine <= 0.0 {
                    return (Vec3::ZERO, 0.0);
                }
                // A lobe about the mirrored direction, on top of what is diffuse; normalised.
                let mirrored = 2.0 * normal.dot(*eye) * *normal - *eye;
                let lobe = mirrored.dot(towards).max(0.0).powf(GLOSS) * (GLOSS + 1.0) / TAU;
                let gloss = GLOSSED * look.gloss;
                let diffuse = look.colour * ((1.0 - gloss) * cosine * FRAC_1_PI);
                (diffuse + Vec3::splat(gloss * lobe), cosine * FRAC_1_PI)
            }
        }
    }

    fn sample(&self, sampler: &mut Sampler) -> Option<Onward> {
        let ([a, b], [c, d]) = (sampler.pair(), sampler.pair());
        match self {
            Self::Hair { frame, scattering } => {
                let sample = scattering.sample([a, b, c, d]);
                let (towards, pdf) = (frame.to_world(sample.wi), sample.pdf);
                (pdf > 0.0).then_some(Onward { towards, weight: sample.weight, pdf })
            }
            Self::Skin { normal, .. } => {
                let towards = about(*normal, (1.0 - a).sqrt(), TAU * b);
                let (value, pdf) = self.evaluate(towards);
                (pdf > 0.0).then(|| Onward { towards, weight: value / pdf, pdf })
            }
        }
    }
}

/// Share of a path that is sampled with the density `mine`, and could have been with `other`.
fn power(mine: f32, other: f32) -> f32 {
    let ratio = other / mine;
    1.0 / (1.0 + ratio * ratio)
}
