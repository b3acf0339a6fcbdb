//! What a hit does to light: the choice between fibre and surface.

use frisure_optics::scattering::{FibreFrame, Scattering};
use glam::Vec3;

use super::sampler::Sampler;
use super::surface::Plastic;

/// What scatters light at a hit.
pub(super) enum Matter<'a> {
    /// A fibre, in its frame.
    Hair { frame: FibreFrame, scattering: Scattering<'a> },
    /// The head, or the ground.
    Surface(Plastic),
}

/// How light goes on from a hit.
pub(super) struct Onward {
    /// Unit direction.
    pub(super) towards: Vec3,
    /// Scattering function times the cosine over the density.
    pub(super) weight: Vec3,
    /// Density (1/sr).
    pub(super) pdf: f32,
}

impl Matter<'_> {
    /// Scattering function times the cosine, and the density of [`Self::sample`] (1/sr).
    pub(super) fn evaluate(&self, towards: Vec3) -> (Vec3, f32) {
        match self {
            Self::Hair { frame, scattering } => {
                let found = scattering.evaluate(frame.to_local(towards));
                (found.f_cos, found.pdf)
            }
            Self::Surface(plastic) => plastic.evaluate(towards),
        }
    }

    /// A direction in which light goes on, where there is one.
    pub(super) fn sample(&self, sampler: &mut Sampler) -> Option<Onward> {
        let (first, second) = (sampler.pair(), sampler.pair());
        match self {
            Self::Hair { frame, scattering } => {
                let [[a, b], [c, d]] = [first, second];
                let sample = scattering.sample([a, b, c, d]);
                let (towards, pdf) = (frame.to_world(sample.wi), sample.pdf);
                (pdf > 0.0).then_some(Onward { towards, weight: sample.weight, pdf })
            }
            Self::Surface(plastic) => {
                let towards = plastic.sample(first[0], second);
                let (value, pdf) = plastic.evaluate(towards);
                (pdf > 0.0).then(|| Onward { towards, weight: value / pdf, pdf })
            }
        }
    }
}
