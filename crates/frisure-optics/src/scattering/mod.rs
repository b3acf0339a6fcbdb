//! The hair BSDF (also BCSDF): scattering of light by one elliptical fibre, for the final picture.
//!
//! It is a near-field model: the offset of the ray across the fibre's width is known. Light leaves by reflection
//! (R), straight through (TT), after one reflection inside (TRT), or later (the rest, spread evenly
//! around the fibre). Each lobe p has an energy A, a spread M along the fibre and N around it,
//!
//! ```text
//! f cos = Σ A_p M_p(θi, θo) N_p(φ),      ∫ M cos θ dθ = ∫ N dφ = 1,      Σ A_p = 1 without absorption,
//! ```
//!
//! so the white furnace holds by construction. For a circle this is Chiang et al. 2016, *A practical
//! and controllable hair and fur model for production path tracing*. For an ellipse the azimuths,
//! reflectances and lengths come from an exact ray through the section.
//!
//! Not reciprocal, as Chiang's is not: the energies belong to the direction towards the eye. Mean over
//! the offset, exchanging light and eye less than 43° from the normal plane at roughness 0.3 changes f
//! by 8 % for a circle and 13 % for an axis ratio of 1.5 (root mean square, weighed by f²; with a tilt
//! of 2° 9 and 13 %).
//!
//! [`Fibre`] is prepared once per hair, [`HairBsdf`] once per hit. [`Marschner2003`] is the older model
//! as it was printed, and [`MarschnerBsdf`] what it makes of a hit.

mod azimuthal;
mod elementary;
mod energy;
mod fibre;
mod film;
mod frame;
mod longitudinal;
mod marschner;
mod marschner_bsdf;
mod section;
mod spec;

use core::f32::consts::TAU;

use glam::{Mat4, Vec3, Vec4};

pub use fibre::Fibre;
pub use film::WATER_INDEX;
pub use frame::FibreFrame;
pub use marschner::Marschner2003;
pub use marschner_bsdf::MarschnerBsdf;
pub use spec::{FibreError, FibreSpec};

use elementary::{atan2, sin_cos};
use energy::energies;
use fibre::towards;
use longitudinal::Inclinations;
use section::{Incident, circle, ellipse};

/// The BSDF of a hair fibre, for one direction to the eye and one offset across its width.
///
/// ```
/// use frisure_optics::scattering::{Fibre, FibreSpec, HairBsdf};
/// use glam::Vec3;
///
/// // White hair with an elliptical section, met a third of its half width beside the middle.
/// let fibre = Fibre::new(FibreSpec { axis_ratio: 1.4, ..FibreSpec::default() })?;
/// let bsdf = HairBsdf::new(&fibre, Vec3::X, 1.0 / 3.0); // local directions: d1, d2, tangent
/// // Without absorption the lobes R, TT, TRT and the rest share out all of the light …
/// let sum: Vec3 = bsdf.energies().iter().sum();
/// assert!((sum - Vec3::ONE).length() < 1e-5);
/// // … and a direction sampled by importance carries its light with the weight 1.
/// let sample = bsdf.sample([0.3, 0.6, 0.2, 0.8]);
/// assert!((sample.weight - Vec3::ONE).length() < 1e-4);
/// # Ok::<(), frisure_optics::scattering::FibreError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct HairBsdf<'a> {
    fibre: &'a Fibre,
    from: Inclinations,
    azimuth: Vec4,
    /// A column for each lobe: its energy, by colour, and its share in the luminance.
    energy: Mat4,
}

/// Value and pdf of a BSDF for a pair of directions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Evaluation {
    /// BSDF times the cosine (1/sr), by colour.
    pub f_cos: Vec3,
    /// Pdf of [`HairBsdf::sample`] for this direction (1/sr).
    pub pdf: f32,
}

/// A direction drawn by importance sampling of a BSDF.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BsdfSample {
    /// Unit direction to the light.
    pub wi: Vec3,
    /// f cos over pdf; 1 without absorption.
    pub weight: Vec3,
    /// Pdf (1/sr).
    pub pdf: f32,
}

impl<'a> HairBsdf<'a> {
    /// Creates the BSDF for the unit local direction `wo` to the eye and the offset `h` in [−1, 1] of the ray across
    /// the fibre's projected width, counted along wo × t ([`Fibre::offset`]).
    #[must_use]
    pub fn new(fibre: &'a Fibre, wo: Vec3, h: f32) -> Self {
        Self::coloured(fibre, fibre.absorption, wo, h)
    }

    /// Creates the BSDF where the fibre absorbs `absorption` per mean radius (not negative), whatever its own:
    /// the colour of a hair changes along it.
    #[must_use]
    pub fn coloured(fibre: &'a Fibre, absorption: Vec3, wo: Vec3, h: f32) -> Self {
        // 1. Inclinations outside and inside: Snell's law along the fibre.
        let sine = wo.z.clamp(-1.0, 1.0);
        // The bound keeps the index η' finite for a ray along the fibre.
        let cosine = (wo.x * wo.x + wo.y * wo.y).sqrt().clamp(1e-4, 1.0);
        let inner_sine = sine / fibre.index;
        // `clamp` would keep NaN, and one bad hit would spoil a picture.
        #[expect(clippy::manual_clamp)]
        let offset = h.max(-1.0).min(1.0);
        let ray = Incident {
            towards: towards(wo),
            offset,
            cosine,
            inner_cosine: (1.0 - inner_sine * inner_sine).sqrt(),
            index: fibre.index,
            wetness: fibre.wetness,
        };
        // 2. The path through the section: azimuths, reflectances and lengths (`section`).
        let round = fibre.is_round();
        let crossing = if round { circle(&ray) } else { ellipse(&ray, fibre.axes) };
        // 3. Energies A_p of the lobes ([Chiang 2016] §3), and the inclination turned by the tilt of each lobe.
        let energy = energies(&crossing, absorption / ray.inner_cosine);
        let from = fibre.tilted(sine, cosine);
        Self { fibre, from, azimuth: crossing.azimuth, energy }
    }

    /// Energies of R, TT, TRT and the rest for a unit of light, by colour.
    #[must_use]
    pub fn energies(&self) -> [Vec3; 4] {
        let e = &self.energy;
        [e.x_axis, e.y_axis, e.z_axis, e.w_axis].map(Vec4::truncate)
    }

    /// The model for unit local direction `wi` to the light.
    #[must_use]
    pub fn evaluate(&self, wi: Vec3) -> Evaluation {
        let cosine = (wi.x * wi.x + wi.y * wi.y).sqrt();
        self.at(wi.z, cosine, atan2(Vec4::splat(wi.y), Vec4::splat(wi.x)).x)
    }

    /// Draws a direction to the light from numbers in [0, 1).
    #[must_use]
    pub fn sample(&self, u: [f32; 4]) -> BsdfSample {
        // 1. A lobe, with a probability in proportion to its energy.
        let p = self.pick(u[0]);
        // 2. The inclination from M_p [d'Eon 2013], the azimuth from N_p.
        let sine = self.fibre.longitudinal.sample(p, &self.from, [u[1], u[2]]);
        let cosine = ((1.0 - sine) * (1.0 + sine)).sqrt();
        let phi =
            if p < 3 { self.azimuth[p] + self.fibre.azimuthal.sample(u[3]) } else { TAU * u[3] };
        // 3. Value and pdf of all lobes in that direction.
        let (y, x) = sin_cos(phi);
        let Evaluation { f_cos, pdf } = self.at(sine, cosine, phi);
        let weight = if pdf > 0.0 { f_cos / pdf } else { Vec3::ZERO };
        BsdfSample { wi: Vec3::new(cosine * x, cosine * y, sine), weight, pdf }
    }

    /// The model for light from inclination (sin θ, cos θ) and azimuth φ.
    fn at(&self, sine: f32, cosine: f32, phi: f32) -> Evaluation {
        let m = self.fibre.longitudinal.values(&self.from, sine, cosine);
        let n = self.fibre.azimuthal.values(self.azimuth, phi);
        let sum = self.energy * (m * n);
        Evaluation { f_cos: sum.truncate(), pdf: sum.w }
    }

    /// The lobe that the number `u` in [0, 1) stands for.
    fn pick(&self, u: f32) -> usize {
        let first = self.energy.x_axis.w;
        let second = first + self.energy.y_axis.w;
        let third = second + self.energy.z_axis.w;
        usize::from(u >= first) + usize::from(u >= second) + usize::from(u >= third)
    }
}
