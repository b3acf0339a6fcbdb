//! Where light comes from: lamps far and near, and what is around.
//!
//! One light is chosen for each scattering, as likely as the light that it is thought to give there. Light
//! that is met by chance counts, too: [`Outside::met`] gives the density with which [`Outside::sample`]
//! would have chosen that direction at the same place, so that both can share each path.

use std::f32::consts::{PI, TAU};

use glam::Vec3;

use crate::light::EnvironmentMap;
use crate::{AreaLight, AreaShape, Lamp, Lights, Room};

/// Smallest angular radius of a lamp that is no true direction (rad).
const SHARP: f64 = 1e-4;

/// Most and least of the samples that go to the room where there are lamps, too: light by chance finds
/// the room but not a lamp.
const TO_ROOM: (f32, f32) = (0.05, 0.6);

/// How much wider a lamp is met than it is, against rounding (relative, of its area).
const ROUNDING: f32 = 3e-5;

/// All light.
pub(super) struct Outside {
    far: Far,
    sharp: Vec<Sharp>,
    near: Vec<Near>,
    /// Sum of the weights of `sharp`.
    sharp_weight: f32,
}

/// Light from infinitely far away that can be met by chance.
struct Far {
    lamps: Vec<Disc>,
    room: Around,
    /// Share of its samples that goes to the room.
    to_room: f32,
    weight: f32,
}

struct Disc {
    towards: Vec3,
    radiance: Vec3,
    /// Greatest square of the chord to a direction on the disc.
    chord: f32,
    /// Density on it (1/sr).
    density: f32,
    /// Share of the samples that it gets, and that of all before it.
    share: f32,
    before: f32,
}

impl Disc {
    /// Whether a unit direction is on it.
    fn has(&self, towards: Vec3) -> bool {
        (towards - self.towards).length_squared() <= self.chord * (1.0 + ROUNDING)
    }
}

enum Around {
    /// Radiance `middle` + z · `slope`, and how much of its light's strength changes with z.
    Gradient {
        middle: Vec3,
        slope: Vec3,
        tilt: f32,
    },
    Environment(EnvironmentMap),
}

/// A lamp of no angle.
struct Sharp {
    towards: Vec3,
    irradiance: Vec3,
    weight: f32,
}

/// A lamp at a place.
enum Near {
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

/// A direction to light.
#[derive(Clone, Copy, Debug)]
pub(super) struct LightSample {
    pub(super) towards: Vec3,
    /// How far its lamp is (m).
    pub(super) distance: f32,
    /// Radiance; of a lamp of no size, irradiance.
    pub(super) radiance: Vec3,
    /// Density (1/sr); of a lamp of no size, the probability of its choice.
    pub(super) pdf: f32,
    /// Whether no ray meets it by chance.
    pub(super) sharp: bool,
}

impl LightSample {
    const NONE: Self = Self {
        towards: Vec3::Z,
        distance: f32::INFINITY,
        radiance: Vec3::ZERO,
        pdf: 0.0,
        sharp: true,
    };
}

impl Outside {
    pub(super) fn new(lights: &Lights) -> Self {
        let (mut discs, mut sharp, mut near) = (Vec::new(), Vec::new(), Vec::new());
        for lamp in &lights.lamps {
            match lamp {
                Lamp::Distant(lamp) if lamp.radius() < SHARP => sharp.push(Sharp {
                    towards: lamp.direction().as_vec3(),
                    irradiance: lamp.irradiance(),
                    weight: lamp.irradiance().element_sum(),
                }),
                Lamp::Distant(lamp) => {
                    discs.push((lamp.direction().as_vec3(), lamp.irradiance(), lamp.radius()));
                }
                Lamp::Point(lamp) => near.push(Near::Point {
                    position: lamp.position().as_vec3(),
                    intensity: lamp.intensity(),
                }),
                Lamp::Area(lamp) => near.push(Near::Area(Area::new(lamp))),
            }
        }
        let sharp_weight = sharp.iter().map(|lamp| lamp.weight).sum();
        Self { far: Far::new(&discs, &lights.room), sharp, near, sharp_weight }
    }

    /// Light that a ray which was scattered at `from` meets before `blocked` (m), or all that there is
    /// without it: radiance, and the density (1/sr) with which [`Self::sample`] gives its direction
    /// there.
    pub(super) fn met(
        &self,
        from: Vec3,
        towards: Vec3,
        blocked: Option<f32>,
        mut visit: impl FnMut(Vec3, f32),
    ) {
        if blocked.is_some() && self.near.is_empty() {
            return;
        }
        let whole = self.weight(from);
        if blocked.is_none() {
            let (radiance, pdf) = self.far.look(towards);
            visit(radiance, pdf * (self.far.weight / whole.max(f32::MIN_POSITIVE)));
        }
        for near in &self.near {
            let Near::Area(area) = near else { continue };
            let Some((distance, density)) = area.met(from, towards) else { continue };
            if blocked.is_none_or(|blocked| distance < blocked) {
                visit(area.radiance, density * near.weight(from) / whole);
            }
        }
    }

    /// Distance (m) and radiance of the face of a lamp that is in the picture, if a ray meets one before
    /// `blocked` (m).
    pub(super) fn shown(
        &self,
        from: Vec3,
        towards: Vec3,
        blocked: Option<f32>,
    ) -> Option<(f32, Vec3)> {
        let limit = blocked.unwrap_or(f32::INFINITY);
        let areas = self.near.iter().filter_map(|near| match near {
            Near::Area(area) if area.shown => Some(area),
            _ => None,
        });
        let met = areas.filter_map(|area| Some((area.met(from, towards)?.0, area.radiance)));
        let before = met.filter(|(distance, _)| *distance < limit);
        before.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// Radiance of what is far away in a unit direction, as an eye sees it.
    pub(super) fn seen(&self, towards: Vec3) -> Vec3 {
        let shown = self.far.lamps.iter().filter(|lamp| lamp.has(towards));
        self.far.room.seen(towards) + shown.map(|lamp| lamp.radiance).sum::<Vec3>()
    }

    /// A direction from a place (m) to light, from numbers in [0, 1).
    pub(super) fn sample(&self, from: Vec3, which: f32, place: [f32; 2]) -> LightSample {
        let whole = self.weight(from);
        if !(whole > 0.0) {
            return LightSample::NONE;
        }
        let mut left = which * whole;
        if left < self.far.weight {
            let found = self.far.sample(left / self.far.weight, place);
            return LightSample { pdf: found.pdf * (self.far.weight / whole), ..found };
        }
        left -= self.far.weight;
        for lamp in &self.sharp {
            if left < lamp.weight {
                return lamp.sample(lamp.weight / whole);
            }
            left -= lamp.weight;
        }
        // Rounding may leave a little after the last.
        let mut last = LightSample::NONE;
        for near in &self.near {
            let weight = near.weight(from);
            if weight > 0.0 && (left < weight || last.pdf == 0.0) {
                last = near.sample(from, place, weight / whole);
            }
            if left < weight {
                break;
            }
            left -= weight;
        }
        last
    }

    /// All light that is thought to reach a place.
    fn weight(&self, from: Vec3) -> f32 {
        let near: f32 = self.near.iter().map(|near| near.weight(from)).sum();
        self.far.weight + self.sharp_weight + near
    }
}

impl Sharp {
    fn sample(&self, share: f32) -> LightSample {
        let (towards, radiance) = (self.towards, self.irradiance);
        LightSample { towards, radiance, pdf: share, ..LightSample::NONE }
    }
}

impl Far {
    fn new(discs: &[(Vec3, Vec3, f64)], room: &Room) -> Self {
        let lit = || discs.iter().filter(|lamp| lamp.1.max_element() > 0.0);
        let lamps: f32 = lit().map(|lamp| lamp.1.element_sum()).sum();
        // A fibre across light from everywhere gets π/4 of it.
        let around = PI * PI * room.mean().element_sum();
        let weight = lamps + around;
        let to_room = match (lamps > 0.0, around > 0.0) {
            (true, true) => (around / weight).clamp(TO_ROOM.0, TO_ROOM.1),
            (true, false) => 0.0,
            (false, _) => 1.0,
        };
        let mut before = 0.0;
        let disc = |&(towards, irradiance, radius): &(Vec3, Vec3, f64)| {
            let share = (1.0 - to_room) * irradiance.element_sum() / lamps;
            let chord = (2.0 * (0.5 * radius).sin()).powi(2) as f32;
            // The irradiance of a disc that faces the surface is its radiance times π sin².
            let radiance = irradiance / (PI * radius.sin().powi(2) as f32);
            before += share;
            let (density, before) = (1.0 / (PI * chord), before - share);
            Disc { towards, radiance, chord, density, share, before }
        };
        Self { lamps: lit().map(disc).collect(), room: Around::new(room), to_room, weight }
    }

    /// Radiance and density of the samples (1/sr) in a unit direction.
    fn look(&self, towards: Vec3) -> (Vec3, f32) {
        let (mut radiance, pdf) = self.room.look(towards);
        let mut pdf = self.to_room * pdf;
        for lamp in &self.lamps {
            if lamp.has(towards) {
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
        let lamp = lamp.or_else(|| self.lamps.last().filter(|_| self.to_room == 0.0));
        let towards = match lamp {
            Some(lamp) => {
                // The square of the chord from a disc's middle is even on it.
                let chord = u * lamp.chord;
                tilted(lamp.towards, (chord * (1.0 - 0.25 * chord)).max(0.0).sqrt(), TAU * v)
            }
            None if self.to_room > 0.0 => self.room.sample([u, v]),
            None => return LightSample::NONE,
        };
        let (radiance, pdf) = self.look(towards);
        LightSample { towards, radiance, pdf, sharp: false, ..LightSample::NONE }
    }
}

impl Around {
    fn new(room: &Room) -> Self {
        match room {
            Room::Gradient { sky, ground } => {
                let (middle, slope) = (0.5 * (*sky + *ground), 0.5 * (*sky - *ground));
                let tilt = slope.element_sum() / middle.element_sum().max(f32::MIN_POSITIVE);
                // Some light from everywhere, or what is dark in sum and not in a colour is never found.
                Self::Gradient { middle, slope, tilt: tilt.clamp(-0.98, 0.98) }
            }
            Room::Environment(map) => Self::Environment(map.clone()),
        }
    }

    fn look(&self, towards: Vec3) -> (Vec3, f32) {
        match self {
            Self::Gradient { middle, slope, tilt } => {
                let pdf = (1.0 + tilt * towards.z) / (2.0 * TAU);
                (*middle + *slope * towards.z, pdf)
            }
            Self::Environment(map) => map.look(towards),
        }
    }

    fn seen(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Gradient { .. } => self.look(towards).0,
            Self::Environment(map) => map.seen(towards),
        }
    }

    fn sample(&self, [u, v]: [f32; 2]) -> Vec3 {
        match self {
            Self::Gradient { tilt, .. } => {
                let c = 2.0 - tilt - 4.0 * u;
                let z = (-c / (1.0 + (1.0 - tilt * c).max(0.0).sqrt())).clamp(-1.0, 1.0);
                about(Vec3::Z, z, TAU * v)
            }
            Self::Environment(map) => map.sample([u, v]),
        }
    }
}

impl Near {
    /// Irradiance that it is thought to give at a place, facing it.
    fn weight(&self, from: Vec3) -> f32 {
        match self {
            Self::Point { position, intensity } => {
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
                LightSample { towards, distance, radiance, pdf: share, sharp: true }
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
        let (square, size) = (way.length_squared(), self.area / PI);
        // Near the face its nearest part is what counts, not its middle.
        let cosine = (height * height + 0.1 * size) / (square + 0.1 * size);
        let irradiance = self.area / (square + size) * cosine.min(1.0).sqrt();
        self.radiance.element_sum() * irradiance
    }

    /// Distance (m) and density (1/sr) of what an even choice on the face would give in a direction.
    fn met(&self, from: Vec3, towards: Vec3) -> Option<(f32, f32)> {
        let cosine = -towards.dot(self.facing);
        let height = (from - self.centre).dot(self.facing);
        if !(cosine > 1e-6 && height > 0.0) {
            return None;
        }
        let distance = height / cosine;
        let place = from + distance * towards - self.centre;
        let [x, y] = self.arms.map(|arm| place.dot(arm) / arm.length_squared());
        let inside = if self.round { x * x + y * y <= 1.0 } else { x.abs().max(y.abs()) <= 1.0 };
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
        LightSample { towards, distance, radiance: self.radiance, pdf, sharp: false }
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

/// Share of a path that is sampled with the density `mine`, and could have been with `other` (the power
/// heuristic, Veach 1997).
pub(super) fn power(mine: f32, other: f32) -> f32 {
    let ratio = other / mine;
    1.0 / (1.0 + ratio * ratio)
}

#[cfg(test)]
mod tests;
