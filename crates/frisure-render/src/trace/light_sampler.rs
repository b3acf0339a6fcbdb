//! The light sampler: delta lights, area lights and the environment light, sampled by importance.
//!
//! [`LightSampler::sample`] chooses one light with a probability in proportion to an estimate of its irradiance
//! at the shading point, and a direction to it. [`LightSampler::emitted`] gives, for a direction that BSDF
//! sampling chose, the radiance and the pdf with which `sample` would have chosen it at the same point: the
//! weights of multiple importance sampling (pbrt-v4, §12.6 and §13.4).

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use frisure_look::{AreaLight, AreaShape, EnvironmentLight, EnvironmentMap, Lamp, Lights};

/// Angular radius below which a distant light is a delta light (rad). Chosen: a fiftieth of the sun's, so that a disc of it
/// has no penumbra to see.
const MIN_RADIUS: f64 = 1e-4;

/// Least and greatest share of the samples of [`InfiniteLights`] that the environment gets where there are lamps,
/// too: BSDF sampling finds the environment but rarely a lamp. Chosen by trial; not measured further.
const ENVIRONMENT_SHARE: (f32, f32) = (0.05, 0.6);

/// Relative margin on the area of a disc in [`Disc::contains`], against rounding: a sampled direction must count as on the disc.
const ROUNDING: f32 = 3e-5;

/// All lights of a scene, ready to be sampled.
pub(super) struct LightSampler {
    infinite: InfiniteLights,
    delta: Vec<DeltaLight>,
    local: Vec<LocalLight>,
    /// Sum of the weights of `delta`.
    delta_weight: f32,
}

/// Lights at infinity that BSDF sampling can hit.
struct InfiniteLights {
    lamps: Vec<Disc>,
    environment: Environment,
    /// Share of the samples that the environment gets.
    environment_share: f32,
    weight: f32,
}

/// A distant light: a disc of uniform radiance.
struct Disc {
    towards: Vec3,
    radiance: Vec3,
    /// Square of the chord from the centre to the edge, on the unit sphere.
    chord: f32,
    /// Pdf of a uniform direction on it (1/sr).
    density: f32,
    /// Share of the samples that it gets, and the sum of the shares before it.
    share: f32,
    before: f32,
}

impl Disc {
    /// Whether a unit direction is on it.
    fn contains(&self, towards: Vec3) -> bool {
        (towards - self.towards).length_squared() <= self.chord * (1.0 + ROUNDING)
    }
}

enum Environment {
    /// Radiance `middle` + z · `slope`; the pdf is (1 + `tilt` z)/4π.
    Gradient {
        middle: Vec3,
        slope: Vec3,
        tilt: f32,
    },
    Environment(EnvironmentMap),
}

/// A delta light at infinity: one direction.
struct DeltaLight {
    towards: Vec3,
    irradiance: Vec3,
    weight: f32,
}

/// A light at a finite distance.
enum LocalLight {
    Point { position: Vec3, intensity: Vec3 },
    Area(Area),
}

struct Area {
    centre: Vec3,
    /// Half of the sides.
    arms: [Vec3; 2],
    facing: Vec3,
    radiance: Vec3,
    round: bool,
    area: f32,
    shown: bool,
}

/// A sampled direction to a light.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightSample {
    pub(super) towards: Vec3,
    /// Distance to the light (m).
    pub(super) distance: f32,
    /// Radiance; irradiance for a delta light.
    pub(super) radiance: Vec3,
    /// Pdf (1/sr); the probability of the choice for a delta light.
    pub(super) pdf: f32,
    /// Whether it is a delta light: BSDF sampling never hits it.
    pub(super) is_delta: bool,
}

impl LightSample {
    const NONE: Self = Self {
        towards: Vec3::Z,
        distance: f32::INFINITY,
        radiance: Vec3::ZERO,
        pdf: 0.0,
        is_delta: true,
    };
}

impl LightSampler {
    pub(super) fn new(lights: &Lights) -> Self {
        let (mut discs, mut delta, mut local) = (Vec::new(), Vec::new(), Vec::new());
        for lamp in &lights.lamps {
            match lamp {
                Lamp::Distant(lamp) if lamp.radius() < MIN_RADIUS => delta.push(DeltaLight {
                    towards: lamp.direction().as_vec3(),
                    irradiance: lamp.irradiance(),
                    weight: lamp.irradiance().element_sum(),
                }),
                Lamp::Distant(lamp) => {
                    discs.push((lamp.direction().as_vec3(), lamp.irradiance(), lamp.radius()));
                }
                Lamp::Point(lamp) => local.push(LocalLight::Point {
                    position: lamp.position().as_vec3(),
                    intensity: lamp.intensity(),
                }),
                Lamp::Area(lamp) => local.push(LocalLight::Area(Area::new(lamp))),
            }
        }
        let delta_weight = delta.iter().map(|lamp| lamp.weight).sum();
        Self {
            infinite: InfiniteLights::new(&discs, &lights.environment),
            delta,
            local,
            delta_weight,
        }
    }

    /// Visits the light that is emitted along a BSDF-sampled ray from `from`, in front of the hit at `blocked`
    /// (m): radiance, and the pdf (1/sr) with which [`Self::sample`] chooses the direction there.
    pub(super) fn emitted(
        &self,
        from: Vec3,
        towards: Vec3,
        blocked: Option<f32>,
        mut visit: impl FnMut(Vec3, f32),
    ) {
        // Nothing shines in front of a hit but lights at a finite distance.
        if blocked.is_some() && self.local.is_empty() {
            return;
        }
        let whole = self.weight(from);
        if blocked.is_none() {
            let (radiance, pdf) = self.infinite.radiance_and_pdf(towards);
            visit(radiance, pdf * (self.infinite.weight / whole.max(f32::MIN_POSITIVE)));
        }
        for local in &self.local {
            let LocalLight::Area(area) = local else { continue };
            let Some((distance, density)) = area.intersect(from, towards) else { continue };
            if blocked.is_none_or(|blocked| distance < blocked) {
                visit(area.radiance, density * local.weight(from) / whole);
            }
        }
    }

    /// Distance (m) and radiance of the nearest visible area light that a camera ray hits before `blocked` (m).
    pub(super) fn visible_area_light(
        &self,
        from: Vec3,
        towards: Vec3,
        blocked: Option<f32>,
    ) -> Option<(f32, Vec3)> {
        let limit = blocked.unwrap_or(f32::INFINITY);
        let areas = self.local.iter().filter_map(|local| match local {
            LocalLight::Area(area) if area.shown => Some(area),
            _ => None,
        });
        let met = areas.filter_map(|area| Some((area.intersect(from, towards)?.0, area.radiance)));
        let before = met.filter(|(distance, _)| *distance < limit);
        before.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Radiance of the lights at infinity in a unit direction, for the background of a picture.
    pub(super) fn background(&self, towards: Vec3) -> Vec3 {
        let shown = self.infinite.lamps.iter().filter(|lamp| lamp.contains(towards));
        self.infinite.environment.radiance_interpolated(towards)
            + shown.map(|lamp| lamp.radiance).sum::<Vec3>()
    }

    /// Samples a direction from a point (m) to a light, from numbers in [0, 1).
    pub(super) fn sample(&self, from: Vec3, which: f32, place: [f32; 2]) -> LightSample {
        let whole = self.weight(from);
        if !(whole > 0.0) {
            return LightSample::NONE;
        }
        // One number chooses among all lights, in the order infinite, delta, local; each takes its weight from it.
        let mut left = which * whole;
        if left < self.infinite.weight {
            let found = self.infinite.sample(left / self.infinite.weight, place);
            return LightSample { pdf: found.pdf * (self.infinite.weight / whole), ..found };
        }
        left -= self.infinite.weight;
        for lamp in &self.delta {
            if left < lamp.weight {
                return lamp.sample(lamp.weight / whole);
            }
            left -= lamp.weight;
        }
        // Rounding may leave a little after the last.
        let mut last = LightSample::NONE;
        for local in &self.local {
            let weight = local.weight(from);
            if weight > 0.0 && (left < weight || last.pdf == 0.0) {
                last = local.sample(from, place, weight / whole);
            }
            if left < weight {
                break;
            }
            left -= weight;
        }
        last
    }

    /// Sum of the weights of all lights at a point (m).
    fn weight(&self, from: Vec3) -> f32 {
        let local: f32 = self.local.iter().map(|local| local.weight(from)).sum();
        self.infinite.weight + self.delta_weight + local
    }
}

impl DeltaLight {
    fn sample(&self, share: f32) -> LightSample {
        let (towards, radiance) = (self.towards, self.irradiance);
        LightSample { towards, radiance, pdf: share, ..LightSample::NONE }
    }
}

impl InfiniteLights {
    fn new(discs: &[(Vec3, Vec3, f64)], environment: &EnvironmentLight) -> Self {
        let lit = || discs.iter().filter(|lamp| lamp.1.max_element() > 0.0);
        let lamps: f32 = lit().map(|lamp| lamp.1.element_sum()).sum();
        // The irradiance that a fibre's width gets from uniform radiance L is π² L, π/4 of the sphere's 4π L.
        let around = PI * PI * environment.mean().element_sum();
        let weight = lamps + around;
        let environment_share = match (lamps > 0.0, around > 0.0) {
            (true, true) => (around / weight).clamp(ENVIRONMENT_SHARE.0, ENVIRONMENT_SHARE.1),
            (true, false) => 0.0,
            (false, _) => 1.0,
        };
        let mut before = 0.0;
        let disc = |&(towards, irradiance, radius): &(Vec3, Vec3, f64)| {
            let share = (1.0 - environment_share) * irradiance.element_sum() / lamps;
            // The solid angle of the disc is 2π (1 − cos r) = π chord².
            let chord = (2.0 * (0.5 * radius).sin()).powi(2) as f32;
            // A disc of angular radius r that faces the surface gives the irradiance π sin² r times its radiance.
            let radiance = irradiance / (PI * radius.sin().powi(2) as f32);
            before += share;
            let (density, before) = (1.0 / (PI * chord), before - share);
            Disc { towards, radiance, chord, density, share, before }
        };
        Self {
            lamps: lit().map(disc).collect(),
            environment: Environment::new(environment),
            environment_share,
            weight,
        }
    }

    /// Radiance and pdf (1/sr) in a unit direction.
    fn radiance_and_pdf(&self, towards: Vec3) -> (Vec3, f32) {
        let (mut radiance, pdf) = self.environment.radiance_and_pdf(towards);
        let mut pdf = self.environment_share * pdf;
        for lamp in &self.lamps {
            if lamp.contains(towards) {
                radiance += lamp.radiance;
                pdf += lamp.share * lamp.density;
            }
        }
        (radiance, pdf)
    }

    fn sample(&self, which: f32, [u, v]: [f32; 2]) -> LightSample {
        let chosen = |lamp: &&Disc| which >= lamp.before && which < lamp.before + lamp.share;
        let lamp = self.lamps.iter().rev().find(chosen);
        // Rounding may leave a little after the last.
        let lamp = lamp.or_else(|| self.lamps.last().filter(|_| self.environment_share == 0.0));
        let towards = match lamp {
            Some(lamp) => {
                // The squared chord from the disc's centre is uniform on it.
                let chord = u * lamp.chord;
                tilted(lamp.towards, (chord * (1.0 - 0.25 * chord)).max(0.0).sqrt(), TAU * v)
            }
            None if self.environment_share > 0.0 => self.environment.sample([u, v]),
            None => return LightSample::NONE,
        };
        let (radiance, pdf) = self.radiance_and_pdf(towards);
        LightSample { towards, radiance, pdf, is_delta: false, ..LightSample::NONE }
    }
}

impl Environment {
    fn new(environment: &EnvironmentLight) -> Self {
        match environment {
            EnvironmentLight::Gradient { sky, ground } => {
                let (middle, slope) = (0.5 * (*sky + *ground), 0.5 * (*sky - *ground));
                // ∫ (1 + tilt z)/4π dω = 1 for any tilt up to 1 in size.
                let tilt = slope.element_sum() / middle.element_sum().max(f32::MIN_POSITIVE);
                // The pdf is positive everywhere: a gradient that is dark in sum may have light in one colour.
                Self::Gradient { middle, slope, tilt: tilt.clamp(-0.98, 0.98) }
            }
            EnvironmentLight::Map(map) => Self::Environment(map.clone()),
        }
    }

    fn radiance_and_pdf(&self, towards: Vec3) -> (Vec3, f32) {
        match self {
            Self::Gradient { middle, slope, tilt } => {
                let pdf = (1.0 + tilt * towards.z) / (2.0 * TAU);
                (*middle + *slope * towards.z, pdf)
            }
            Self::Environment(map) => map.radiance_and_pdf(towards),
        }
    }

    fn radiance_interpolated(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Gradient { .. } => self.radiance_and_pdf(towards).0,
            Self::Environment(map) => map.radiance_interpolated(towards),
        }
    }

    fn sample(&self, [u, v]: [f32; 2]) -> Vec3 {
        match self {
            Self::Gradient { tilt, .. } => {
                // u = (z + 1)/2 + tilt (z² − 1)/4, a quadratic in z, solved without cancellation for small tilts.
                let c = 2.0 - tilt - 4.0 * u;
                let z = (-c / (1.0 + (1.0 - tilt * c).max(0.0).sqrt())).clamp(-1.0, 1.0);
                about(Vec3::Z, z, TAU * v)
            }
            Self::Environment(map) => map.sample([u, v]),
        }
    }
}

impl LocalLight {
    /// Estimate of the irradiance on a surface at a point (m) that faces the light.
    fn weight(&self, from: Vec3) -> f32 {
        match self {
            Self::Point { position, intensity } => {
                // The bound (m²) keeps a point on the lamp itself finite.
                intensity.element_sum() / position.distance_squared(from).max(1e-12)
            }
            Self::Area(area) => area.weight(from),
        }
    }

    fn sample(&self, from: Vec3, place: [f32; 2], share: f32) -> LightSample {
        match self {
            Self::Point { position, intensity } => {
                let way = *position - from;
                let square = way.length_squared().max(1e-12);
                let distance = square.sqrt();
                let (towards, radiance) = (way / distance, *intensity / square);
                LightSample { towards, distance, radiance, pdf: share, is_delta: true }
            }
            Self::Area(area) => area.sample(from, place, share),
        }
    }
}

impl Area {
    fn new(lamp: &AreaLight) -> Self {
        Self {
            centre: lamp.centre().as_vec3(),
            arms: lamp.arms().map(glam::DVec3::as_vec3),
            facing: lamp.facing().as_vec3(),
            radiance: lamp.radiance(),
            round: lamp.shape() == AreaShape::Disc,
            area: lamp.area() as f32,
            shown: lamp.is_shown(),
        }
    }

    fn weight(&self, from: Vec3) -> f32 {
        let way = from - self.centre;
        let height = way.dot(self.facing);
        if height <= 0.0 {
            return 0.0;
        }
        // An estimate of A cos/(d² + A/π), the irradiance of a disc on its axis. Any positive weight is unbiased; a good one
        // has less noise. The tenth of the size is chosen.
        let (square, size) = (way.length_squared(), self.area / PI);
        // Close to the face its nearest part counts, not its centre.
        let cosine = (height * height + 0.1 * size) / (square + 0.1 * size);
        let irradiance = self.area / (square + size) * cosine.min(1.0).sqrt();
        self.radiance.element_sum() * irradiance
    }

    /// Intersects a ray with the face: distance (m), and the pdf (1/sr) of uniform sampling of the face.
    fn intersect(&self, from: Vec3, towards: Vec3) -> Option<(f32, f32)> {
        let cosine = -towards.dot(self.facing);
        let height = (from - self.centre).dot(self.facing);
        if !(cosine > 1e-6 && height > 0.0) {
            return None;
        }
        let distance = height / cosine;
        let place = from + distance * towards - self.centre;
        let [x, y] = self.arms.map(|arm| place.dot(arm) / arm.length_squared());
        let inside = if self.round { x * x + y * y <= 1.0 } else { x.abs().max(y.abs()) <= 1.0 };
        // Uniform on the area: the density 1/A per area is d²/(A cos) per solid angle.
        inside.then(|| (distance, distance * distance / (cosine * self.area)))
    }

    fn sample(&self, from: Vec3, [u, v]: [f32; 2], share: f32) -> LightSample {
        let [x, y] = match self.round {
            true => {
                let (sin, cos) = (TAU * v).sin_cos();
                [u.sqrt() * cos, u.sqrt() * sin]
            }
            false => [2.0 * u - 1.0, 2.0 * v - 1.0],
        };
        let way = self.centre + x * self.arms[0] + y * self.arms[1] - from;
        let distance = way.length();
        let towards = way / distance;
        let cosine = -towards.dot(self.facing);
        if !(cosine > 1e-6 && distance > 0.0) {
            return LightSample::NONE;
        }
        let pdf = share * distance * distance / (cosine * self.area);
        LightSample { towards, distance, radiance: self.radiance, pdf, is_delta: false }
    }
}

/// The unit direction at an angle of cosine `z` from an axis, turned by `phi`.
pub(super) fn about(axis: Vec3, z: f32, phi: f32) -> Vec3 {
    let (x, y) = axis.any_orthonormal_pair();
    let r = (1.0 - z * z).max(0.0).sqrt();
    (x * (r * phi.cos()) + y * (r * phi.sin()) + axis * z).normalize()
}

/// The unit direction at an angle of sine `r`, at most a right angle, from an axis, turned by `phi`.
fn tilted(axis: Vec3, r: f32, phi: f32) -> Vec3 {
    let (x, y) = axis.any_orthonormal_pair();
    let z = (1.0 - r * r).max(0.0).sqrt();
    (x * (r * phi.cos()) + y * (r * phi.sin()) + axis * z).normalize()
}

/// Weight in multiple importance sampling of a sample of pdf `mine` that the other strategy would have drawn with
/// pdf `other`: the power heuristic with exponent 2 (Veach 1997, (9.14)).
pub(super) fn power_heuristic(mine: f32, other: f32) -> f32 {
    let ratio = other / mine;
    1.0 / (1.0 + ratio * ratio)
}

#[cfg(test)]
mod tests;
