//! Light that comes from outside: lamps as soft discs far away, and the room.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::Lights;

/// Half the angle under which a lamp is seen (rad): a softbox some metres away.
const LAMP_RADIUS: f32 = 0.09;

/// Share of the samples that go to the room.
const TO_ROOM: f32 = 0.25;

/// All light from outside.
pub(super) struct Outside {
    lamps: Vec<Disc>,
    lights: Lights,
    /// Cosine of [`LAMP_RADIUS`], and the density on a disc (1/sr).
    cosine: f32,
    density: f32,
}

struct Disc {
    towards: Vec3,
    radiance: Vec3,
    /// Share of the samples that it gets, and that of all before it.
    share: f32,
    before: f32,
}

/// A direction to light.
pub(super) struct LightSample {
    pub(super) towards: Vec3,
    pub(super) radiance: Vec3,
    /// Density (1/sr).
    pub(super) pdf: f32,
}

impl Outside {
    pub(super) fn new(lights: &Lights) -> Self {
        let cosine = LAMP_RADIUS.cos();
        let lit: Vec<(Vec3, Vec3)> = (lights.lamps.iter())
            .filter_map(|lamp| Some((lamp.direction.as_vec3().try_normalize()?, lamp.irradiance)))
            .filter(|lamp| lamp.1.max_element() > 0.0)
            .collect();
        let power: f32 = lit.iter().map(|lamp| lamp.1.element_sum()).sum();
        let mut before = 0.0;
        let lamps = lit.into_iter().map(|(towards, irradiance)| {
            let share = (1.0 - TO_ROOM) * irradiance.element_sum() / power;
            // The irradiance of a disc that faces the surface is its radiance times π sin².
            let radiance = irradiance / (PI * LAMP_RADIUS.sin().powi(2));
            before += share;
            Disc { towards, radiance, share, before: before - share }
        });
        let lamps = lamps.collect();
        let density = 1.0 / (TAU * (1.0 - cosine));
        Self { lamps, lights: lights.clone(), cosine, density }
    }

    /// Radiance from a unit direction.
    pub(super) fn radiance(&self, towards: Vec3) -> Vec3 {
        let seen = self.lamps.iter().filter(|lamp| towards.dot(lamp.towards) > self.cosine);
        seen.map(|lamp| lamp.radiance).sum::<Vec3>() + self.lights.room(towards)
    }

    /// Density with which [`Self::sample`] gives a direction (1/sr).
    pub(super) fn pdf(&self, towards: Vec3) -> f32 {
        let seen = self.lamps.iter().filter(|lamp| towards.dot(lamp.towards) > self.cosine);
        seen.map(|lamp| lamp.share * self.density).sum::<f32>() + self.to_room() / (2.0 * TAU)
    }

    fn to_room(&self) -> f32 {
        if self.lamps.is_empty() { 1.0 } else { TO_ROOM }
    }

    /// A direction to light, from numbers in [0, 1).
    pub(super) fn sample(&self, which: f32, [u, v]: [f32; 2]) -> LightSample {
        let lamp = self
            .lamps
            .iter()
            .rev()
            .find(|lamp| which >= lamp.before && which < lamp.before + lamp.share);
        let towards = match lamp {
            Some(lamp) => {
                let z = 1.0 - u * (1.0 - self.cosine);
                about(lamp.towards, z, TAU * v)
            }
            None => about(Vec3::Z, 1.0 - 2.0 * u, TAU * v),
        };
        LightSample { towards, radiance: self.radiance(towards), pdf: self.pdf(towards) }
    }
}

/// The unit direction at an angle of cosine `z` from an axis, turned by `phi`.
pub(super) fn about(axis: Vec3, z: f32, phi: f32) -> Vec3 {
    let (x, y) = axis.any_orthonormal_pair();
    let r = (1.0 - z * z).max(0.0).sqrt();
    (x * (r * phi.cos()) + y * (r * phi.sin()) + axis * z).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Camera;

    #[test]
    fn samples_of_light_have_the_density_they_say_and_the_power_of_the_lamps() {
        let lights = Lights::studio(&Camera::default());
        let outside = Outside::new(&lights);
        let (mut power, mut whole) = (Vec3::ZERO, 0.0);
        let n = 200;
        for i in 0..n {
            for j in 0..n {
                let u = [(j as f32 + 0.5) / n as f32, ((i * 71 + j * 13) % n) as f32 / n as f32];
                let sample = outside.sample((i as f32 + 0.5) / n as f32, u);
                power += sample.radiance / sample.pdf / (n * n) as f32;
                whole += 1.0 / sample.pdf / (n * n) as f32;
            }
        }
        let disc = TAU * (1.0 - LAMP_RADIUS.cos());
        let lamps = lights.lamps.iter().map(|l| l.irradiance).sum::<Vec3>();
        let lamps = lamps * disc / (PI * LAMP_RADIUS.sin().powi(2));
        let room = (lights.sky + lights.ground) * TAU;
        assert!((whole / (2.0 * TAU) - 1.0).abs() < 0.02, "{whole}");
        assert!(((power / (lamps + room)) - Vec3::ONE).abs().max_element() < 0.02, "{power}");
    }
}
