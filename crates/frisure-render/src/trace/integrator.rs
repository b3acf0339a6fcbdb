//! The light along a ray.
//!
//! Path tracing with next-event estimation; light sampling and scattering share each path of light by
//! multiple importance sampling with the power heuristic (Veach 1997).

use frisure_optics::scattering::{FibreFrame, Scattering};
use glam::Vec3;

use super::ground::Ground;
use super::hair::Fibres;
use super::lights::{Outside, power};
use super::matter::Matter;
use super::sampler::Sampler;
use super::surface::Plastic;
use crate::SkinLook;
use crate::accel::{HairHit, Hit, Ray, Scene, SkinHit};

/// Everything that light meets.
pub(super) struct World {
    pub(super) scene: Scene,
    pub(super) fibres: Fibres,
    pub(super) outside: Outside,
    pub(super) skin: SkinLook,
    pub(super) ground: Option<Ground>,
    pub(super) bounces: u32,
}

/// Bounces after which a path may end by chance. Brown hair has the same noise in two thirds of the time
/// as with six; for blond it is all one.
const SURE_BOUNCES: u32 = 2;

/// Farthest that light is followed (m).
const FAR: f32 = 1e4;

/// Part of the way to a lamp in which something can stand.
const BEFORE: f32 = 0.9999;

/// Light along a ray, and what it met first.
pub(super) struct Seen {
    pub(super) radiance: Vec3,
    pub(super) first: Option<First>,
}

/// What a ray from the eye met first.
pub(super) struct First {
    /// Distance (m).
    pub(super) t: f32,
    pub(super) thing: Thing,
    /// Share of the light from everywhere that is given back, by colour.
    pub(super) albedo: Vec3,
    /// Unit normal, towards the eye.
    pub(super) normal: Vec3,
}

/// What is seen.
pub(super) enum Thing {
    Hair {
        strand: u32,
        tangent: Vec3,
    },
    Skin,
    Lamp,
    /// With the share of the background that is seen instead.
    Ground {
        faded: f32,
    },
}

/// What a ray meets.
enum Met {
    Hit(Hit),
    Ground { t: f32, point: Vec3 },
}

impl Met {
    /// Where light that goes on in the direction `towards` starts (m).
    fn start(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Hit(hit) => hit.start(towards),
            Self::Ground { point, .. } => *point,
        }
    }

    /// Distance (m).
    fn t(&self) -> f32 {
        match self {
            Self::Hit(hit) => hit.t(),
            Self::Ground { t, .. } => *t,
        }
    }

    /// Where it is, as lamps at a place see it (m).
    fn place(&self) -> Vec3 {
        match self {
            Self::Hit(Hit::Hair(hit)) => hit.centre,
            Self::Hit(Hit::Skin(hit)) => hit.position,
            Self::Ground { point, .. } => *point,
        }
    }
}

impl First {
    /// The face of a lamp.
    fn lamp(t: f32, direction: Vec3) -> Self {
        Self { t, thing: Thing::Lamp, albedo: Vec3::ZERO, normal: -direction }
    }
}

impl World {
    /// Light that arrives along a ray from its start.
    pub(super) fn seen(&self, ray: Ray, sampler: &mut Sampler) -> Seen {
        let mut seen = Seen { radiance: Vec3::ZERO, first: None };
        let (mut ray, mut throughput) = (ray, Vec3::ONE);
        // Where the light was scattered that led here, and the density of its direction; the eye's own is
        // beyond choice.
        let mut scattered: Option<(Vec3, f32)> = None;
        for bounce in 0..=self.bounces {
            let met = self.meets(&ray);
            let blocked = met.as_ref().map(Met::t);
            if let Some((from, pdf)) = scattered {
                self.outside.met(from, ray.direction(), blocked, |light, other| {
                    seen.radiance += throughput * light * power(pdf, other);
                });
            } else if let Some((t, light)) =
                self.outside.shown(ray.origin(), ray.direction(), blocked)
            {
                return Seen { radiance: light, first: Some(First::lamp(t, ray.direction())) };
            }
            let Some(met) = met else { return seen };
            if bounce == 0 {
                seen.first = Some(self.first(&met, ray.direction()));
            }
            if bounce == self.bounces {
                return seen;
            }
            let matter = self.matter(&met, ray.direction());
            seen.radiance += throughput * self.direct(&met, &matter, sampler);
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
            ray = Ray::new(met.start(onward.towards), onward.towards);
            scattered = Some((met.place(), onward.pdf));
        }
        seen
    }

    /// Distance (m) at which a ray meets anything.
    pub(super) fn distance(&self, ray: &Ray) -> Option<f32> {
        self.meets(ray).map(|met| met.t())
    }

    fn meets(&self, ray: &Ray) -> Option<Met> {
        let ground = self.ground.as_ref().and_then(|ground| ground.meets(ray));
        let hit = self.scene.closest_hit(ray, ground.map_or(FAR, |(t, _)| t));
        hit.map(Met::Hit).or_else(|| ground.map(|(t, point)| Met::Ground { t, point }))
    }

    /// Whether anything stands in the way before a distance (m).
    fn hidden(&self, ray: &Ray, distance: f32) -> bool {
        let before = |(t, _): (f32, Vec3)| t < distance;
        self.ground.as_ref().and_then(|ground| ground.meets(ray)).is_some_and(before)
            || self.scene.occluded(ray, distance.min(FAR))
    }

    fn first(&self, met: &Met, direction: Vec3) -> First {
        match met {
            Met::Hit(Hit::Hair(hit)) => First {
                t: hit.t,
                thing: Thing::Hair { strand: hit.strand, tangent: hit.tangent },
                albedo: self.fibres.albedo(hit.strand, hit.segment, hit.u),
                normal: hit.normal,
            },
            Met::Hit(Hit::Skin(hit)) => First {
                t: hit.t,
                thing: Thing::Skin,
                albedo: self.skin.colour,
                normal: facing(hit.smooth_normal, -direction),
            },
            Met::Ground { t, point } => {
                let ground = self.ground.as_ref().expect("it was met");
                let (albedo, normal) = (ground.colour(), Vec3::Z);
                First {
                    t: *t,
                    thing: Thing::Ground { faded: ground.faded(*point) },
                    albedo,
                    normal,
                }
            }
        }
    }

    fn matter(&self, met: &Met, direction: Vec3) -> Matter<'_> {
        match met {
            Met::Hit(Hit::Hair(hit)) => self.hair(hit, direction),
            Met::Hit(Hit::Skin(hit)) => Matter::Surface(self.skin(hit, -direction)),
            Met::Ground { .. } => {
                let colour = self.ground.as_ref().map_or(Vec3::ZERO, Ground::colour);
                Matter::Surface(Plastic::new(Vec3::Z, -direction, colour, 0.0, 1.0))
            }
        }
    }

    fn skin(&self, hit: &SkinHit, eye: Vec3) -> Plastic {
        let SkinLook { colour, gloss } = self.skin;
        let normal = facing(hit.smooth_normal, eye);
        Plastic::new(normal, eye, colour, (REFLECTED * gloss).clamp(0.0, 0.2), SKIN_ROUGHNESS)
    }

    fn hair(&self, hit: &HairHit, direction: Vec3) -> Matter<'_> {
        let d1 = self.fibres.director(hit.strand, hit.segment, hit.u);
        let d1 = d1.unwrap_or_else(|| hit.tangent.any_orthonormal_vector());
        let frame = FibreFrame::new(hit.tangent, d1);
        let eye = frame.to_local(-direction);
        // A hit counts its offset along direction × tangent, a scattering along eye × tangent.
        let (fibre, absorption) = self.fibres.at(hit.strand, hit.segment, hit.u);
        let scattering = Scattering::coloured(fibre, absorption, eye, -hit.h);
        Matter::Hair { frame, scattering }
    }

    /// Light that comes straight from a lamp or from outside and is scattered towards the eye.
    fn direct(&self, met: &Met, matter: &Matter<'_>, sampler: &mut Sampler) -> Vec3 {
        let which = sampler.one();
        let light = self.outside.sample(met.place(), which, sampler.pair());
        let (value, pdf) = matter.evaluate(light.towards);
        if light.pdf <= 0.0 || value.max_element() <= 0.0 {
            return Vec3::ZERO;
        }
        let ray = Ray::new(met.start(light.towards), light.towards);
        if self.hidden(&ray, light.distance * BEFORE) {
            return Vec3::ZERO;
        }
        let share = if light.sharp { 1.0 } else { power(light.pdf, pdf) };
        value * light.radiance * (share / light.pdf)
    }
}

/// What skin's coat reflects head-on, per unit of [`SkinLook::gloss`]: about 0.03 by default, an index
/// of 1.4.
const REFLECTED: f32 = 0.24;

/// Roughness of the slopes of skin.
const SKIN_ROUGHNESS: f32 = 0.3;

/// The normal on the side of the eye.
fn facing(normal: Vec3, eye: Vec3) -> Vec3 {
    if normal.dot(eye) < 0.0 { -normal } else { normal }
}
