//! The BSDF at a hit: a hair fibre's, or that of a rough plastic surface (skin and floor).

use frisure_optics::scattering::{BsdfSample, FibreFrame, HairBsdf, MarschnerBsdf};
use glam::Vec3;

use super::rough_plastic::RoughPlastic;
use super::sampler::Sampler;

/// The BSDF of a hit, in world directions.
pub(super) enum Bsdf<'a> {
    /// A fibre, in its frame.
    Hair { frame: FibreFrame, bsdf: HairBsdf<'a> },
    /// The same by the model of 2003, which few pictures ask for: boxed, so that it does not make the others larger.
    Marschner { frame: FibreFrame, bsdf: Box<MarschnerBsdf<'a>> },
    /// The head, or the floor.
    Surface(RoughPlastic),
}

impl Bsdf<'_> {
    /// BSDF times the cosine, and the pdf of [`Self::sample`] (1/sr), for light from the unit direction `wi`.
    pub(super) fn evaluate(&self, wi: Vec3) -> (Vec3, f32) {
        match self {
            Self::Hair { frame, bsdf } => {
                let found = bsdf.evaluate(frame.to_local(wi));
                (found.f_cos, found.pdf)
            }
            Self::Marschner { frame, bsdf } => {
                let found = bsdf.evaluate(frame.to_local(wi));
                (found.f_cos, found.pdf)
            }
            Self::Surface(plastic) => plastic.evaluate(wi),
        }
    }

    /// Draws the direction in which the path goes on, by importance sampling; `None` where the pdf is zero.
    pub(super) fn sample(&self, sampler: &mut Sampler) -> Option<BsdfSample> {
        let (first, second) = (sampler.pair(), sampler.pair());
        let four = [first[0], first[1], second[0], second[1]];
        let in_world = |frame: &FibreFrame, sample: BsdfSample| BsdfSample {
            wi: frame.to_world(sample.wi),
            ..sample
        };
        let sample = match self {
            Self::Hair { frame, bsdf } => in_world(frame, bsdf.sample(four)),
            Self::Marschner { frame, bsdf } => in_world(frame, bsdf.sample(four)),
            Self::Surface(plastic) => {
                let wi = plastic.sample(first[0], second);
                let (value, pdf) = plastic.evaluate(wi);
                BsdfSample { wi, weight: value / pdf, pdf }
            }
        };
        (sample.pdf > 0.0).then_some(sample)
    }
}
