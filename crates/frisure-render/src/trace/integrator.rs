//! The path integrator: the radiance along a ray.
//!
//! Path tracing with next-event estimation. Light sampling and BSDF sampling are combined by multiple
//! importance sampling with the power heuristic (Veach 1997, *Robust Monte Carlo methods for light transport
//! simulation*, §9.2; pbrt-v4, §13.4). Paths end by Russian roulette.

use frisure_look::Scattering;
use frisure_optics::scattering::{FibreFrame, HairBsdf, MarschnerBsdf};
use glam::Vec3;

use super::bsdf::Bsdf;
use super::fibres::Fibres;
use super::floor::Floor;
use super::light_sampler::{LightSampler, power_heuristic};
use super::rough_plastic::RoughPlastic;
use super::sampler::Sampler;
use super::subsurface::Subsurface;
use crate::accel::{HairHit, Hit, Ray, SceneBvh, SkinHit};
use crate::complexion::{Material, accessory_material, material};
use frisure_look::SkinLook;
use frisure_strands::{Surface, Tint};

/// The scene that paths are traced through.
pub(super) struct Integrator {
    pub(super) bvh: SceneBvh,
    pub(super) fibres: Fibres,
    pub(super) lights: LightSampler,
    pub(super) skin: SkinLook,
    /// The head with the accessories, for what they are made of.
    pub(super) head: Option<Surface>,
    pub(super) floor: Option<Floor>,
    pub(super) max_bounces: u32,
    /// The most light of a path that was scattered twice or more ([`super::TraceOptions::clamp`]).
    pub(super) clamp: Option<f32>,
}

/// Bounces after which Russian roulette may end a path. Measured: brown hair has the same noise in two thirds
/// of the time that six take; blond hair shows no difference.
const ROULETTE_START: u32 = 2;

/// Greatest probability with which Russian roulette continues a path (pbrt-v4, §13.2.2, uses 0.95; chosen by
/// trial).
const MAX_SURVIVAL: f32 = 0.98;

/// Farthest distance that a ray is traced (m). Chosen: far beyond any lamp of a studio.
const MAX_DISTANCE: f32 = 1e4;

/// Part of the distance to a light that a shadow ray tests, so that it does not hit the light itself. Chosen: 0.1 mm at 1 m,
/// some thousand times the rounding of f32.
const SHADOW_RAY_PART: f32 = 0.9999;

/// Radiance along a camera ray, and its primary hit.
pub(super) struct PathSample {
    pub(super) radiance: Vec3,
    pub(super) primary_hit: Option<PrimaryHit>,
}

/// The first hit of a camera ray.
pub(super) struct PrimaryHit {
    /// Distance (m).
    pub(super) t: f32,
    pub(super) object: Object,
    /// Share of uniform light that is reflected, by colour.
    pub(super) albedo: Vec3,
    /// Unit normal, towards the eye.
    pub(super) normal: Vec3,
}

/// The kind of object that a camera ray hits.
pub(super) enum Object {
    Hair {
        strand: u32,
        tangent: Vec3,
    },
    Skin,
    Lamp,
    /// The floor, with the share of the background that shows through.
    Floor {
        faded: f32,
    },
}

/// The closest intersection of a ray with hair, head or floor.
enum Intersection {
    Hit(Hit),
    Floor { t: f32, point: Vec3 },
}

impl Intersection {
    /// Origin (m) of a ray that leaves in the direction `towards`.
    fn ray_origin(&self, towards: Vec3) -> Vec3 {
        match self {
            Self::Hit(hit) => hit.ray_origin(towards),
            Self::Floor { point, .. } => *point,
        }
    }

    /// Distance (m).
    fn t(&self) -> f32 {
        match self {
            Self::Hit(hit) => hit.t(),
            Self::Floor { t, .. } => *t,
        }
    }

    /// Point from which lights are sampled (m).
    fn shading_point(&self) -> Vec3 {
        match self {
            Self::Hit(Hit::Hair(hit)) => hit.centre,
            Self::Hit(Hit::Skin(hit)) => hit.position,
            Self::Floor { point, .. } => *point,
        }
    }
}

/// What a path sees at an intersection: where, with which BSDF, and the factor on its light.
struct Seen<'a> {
    intersection: Intersection,
    bsdf: Bsdf<'a>,
    weight: Vec3,
}

impl PrimaryHit {
    /// The face of a visible area light.
    fn lamp(t: f32, direction: Vec3) -> Self {
        Self { t, object: Object::Lamp, albedo: Vec3::ZERO, normal: -direction }
    }
}

impl Integrator {
    /// Radiance that arrives along a ray at its origin (pbrt's `Li`).
    pub(super) fn radiance(&self, ray: Ray, sampler: &mut Sampler) -> PathSample {
        let mut path = PathSample { radiance: Vec3::ZERO, primary_hit: None };
        let (mut ray, mut throughput) = (ray, Vec3::ONE);
        // The last scattering: its point, and the pdf of the ray's direction; none for a camera ray.
        let mut scattered: Option<(Vec3, f32)> = None;
        for bounce in 0..=self.max_bounces {
            // 1. The closest intersection.
            let intersection = self.intersect(&ray);
            let blocked = intersection.as_ref().map(Intersection::t);

            // 2. Light emitted along the ray. After a bounce it is the BSDF-sampled half of multiple importance
            //    sampling; a camera ray shows the faces of visible area lights.
            if let Some((from, pdf)) = scattered {
                self.lights.emitted(from, ray.direction(), blocked, |light, light_pdf| {
                    let light = throughput * light * power_heuristic(pdf, light_pdf);
                    path.radiance += self.clamped(light, bounce);
                });
            } else if let Some((t, radiance)) =
                self.lights.visible_area_light(ray.origin(), ray.direction(), blocked)
            {
                let primary_hit = Some(PrimaryHit::lamp(t, ray.direction()));
                return PathSample { radiance, primary_hit };
            }
            let Some(intersection) = intersection else { return path };
            let material = self.material_at(&intersection, bounce);
            if bounce == 0 {
                let hit = self.primary_hit(&intersection, material.as_ref(), ray.direction());
                path.primary_hit = Some(hit);
            }
            if bounce == self.max_bounces {
                return path;
            }

            // 3. Light that goes beneath the skin is seen where it comes out.
            let Some(Seen { intersection, bsdf, weight }) =
                self.seen(intersection, material, (ray.direction(), bounce), sampler)
            else {
                return path;
            };
            throughput *= weight;

            // 4. Next-event estimation: the light-sampled half.
            let light = throughput * self.direct_light(&intersection, &bsdf, sampler);
            path.radiance += self.clamped(light, bounce + 1);

            // 5. Importance sampling of the BSDF.
            let Some(sample) = bsdf.sample(sampler) else { return path };
            throughput *= sample.weight;

            // 6. Russian roulette.
            if bounce >= ROULETTE_START {
                // A path goes on with probability q and its light is divided by q: the expected value stays.
                let survival = throughput.max_element().min(MAX_SURVIVAL);
                if sampler.one() >= survival {
                    return path;
                }
                throughput /= survival;
            }
            ray = Ray::new(intersection.ray_origin(sample.wi), sample.wi);
            scattered = Some((intersection.shading_point(), sample.pdf));
        }
        path
    }

    /// Light that was scattered so many times, of the same hue and at most as bright as the firefly clamp.
    fn clamped(&self, light: Vec3, scatterings: u32) -> Vec3 {
        match self.clamp {
            Some(most) if scatterings > 1 && light.max_element() > most => {
                light * (most / light.max_element())
            }
            _ => light,
        }
    }

    /// Distance (m) at which a ray hits anything.
    pub(super) fn distance(&self, ray: &Ray) -> Option<f32> {
        self.intersect(ray).map(|intersection| intersection.t())
    }

    fn intersect(&self, ray: &Ray) -> Option<Intersection> {
        let floor = self.floor.as_ref().and_then(|floor| floor.intersect(ray));
        let hit = self.bvh.closest_hit(ray, floor.map_or(MAX_DISTANCE, |(t, _)| t));
        hit.map(Intersection::Hit)
            .or_else(|| floor.map(|(t, point)| Intersection::Floor { t, point }))
    }

    /// Whether anything blocks a shadow ray before a distance (m).
    fn occluded(&self, ray: &Ray, distance: f32) -> bool {
        let before = |(t, _): (f32, Vec3)| t < distance;
        self.floor.as_ref().and_then(|floor| floor.intersect(ray)).is_some_and(before)
            || self.bvh.occluded(ray, distance.min(MAX_DISTANCE))
    }

    fn primary_hit(
        &self,
        intersection: &Intersection,
        material: Option<&Material>,
        direction: Vec3,
    ) -> PrimaryHit {
        match intersection {
            Intersection::Hit(Hit::Hair(hit)) => PrimaryHit {
                t: hit.t,
                object: Object::Hair { strand: hit.strand, tangent: hit.tangent },
                albedo: self.fibres.albedo(hit.strand, hit.segment, hit.u),
                normal: hit.normal,
            },
            Intersection::Hit(Hit::Skin(hit)) => {
                let normal = material.and_then(|material| material.normal);
                let normal = facing(normal.unwrap_or(hit.smooth_normal), -direction);
                let albedo = material.map_or(Vec3::ZERO, |material| material.colour);
                PrimaryHit { t: hit.t, object: Object::Skin, albedo, normal }
            }
            Intersection::Floor { t, point } => {
                let floor = self.floor.as_ref().expect("the ray hits it");
                let object = Object::Floor { faded: floor.background_share(*point) };
                PrimaryHit { t: *t, object, albedo: floor.colour(), normal: Vec3::Z }
            }
        }
    }

    /// What a ray sees at an intersection: of skin either its coat, or a place where light comes out that went in elsewhere.
    fn seen(
        &self,
        intersection: Intersection,
        material: Option<Material>,
        (direction, bounce): (Vec3, u32),
        sampler: &mut Sampler,
    ) -> Option<Seen<'_>> {
        let bsdf = match (&intersection, material) {
            (Intersection::Hit(Hit::Skin(hit)), Some(material)) => {
                let outside = hit.normal.dot(direction) < 0.0;
                let hit = &SkinHit { position: material.place.unwrap_or(hit.position), ..*hit };
                let deep = self.skin.scatter > 0.0 && material.scatters;
                if deep && outside && bounce < SCATTERED_BOUNCES {
                    return self.scattered(hit, &material, direction, sampler);
                }
                let bsdf = Bsdf::Surface(skin_bsdf(hit, &material, -direction));
                let intersection = Intersection::Hit(Hit::Skin(*hit));
                return Some(Seen { intersection, bsdf, weight: Vec3::ONE });
            }
            (Intersection::Hit(Hit::Hair(hit)), _) => self.hair_bsdf(hit, direction),
            _ => {
                let colour = self.floor.as_ref().map_or(Vec3::ZERO, Floor::colour);
                Bsdf::Surface(RoughPlastic::new(Vec3::Z, -direction, colour, 0.0, 1.0))
            }
        };
        Some(Seen { intersection, bsdf, weight: Vec3::ONE })
    }

    /// The coat of skin, or a place where light comes out, by their shares.
    fn scattered(
        &self,
        hit: &SkinHit,
        material: &Material,
        direction: Vec3,
        sampler: &mut Sampler,
    ) -> Option<Seen<'_>> {
        let surface = skin_bsdf(hit, material, -direction);
        let coat = surface.coat_probability();
        let which = sampler.one();
        let ([a, b], [c, d]) = (sampler.pair(), sampler.pair());
        if which < coat {
            let bsdf = Bsdf::Surface(surface.coat_alone());
            let intersection = Intersection::Hit(Hit::Skin(*hit));
            return Some(Seen { intersection, bsdf, weight: Vec3::splat(1.0 / coat) });
        }
        let skin = Subsurface::new(material.colour, self.skin.scatter);
        let (exit, weight) = skin.exit(&self.bvh, hit, [a, b, c, d])?;
        if !self.material(&exit, None, 0.0).scatters {
            return None;
        }
        let normal = facing(exit.smooth_normal, exit.normal);
        let bsdf = Bsdf::Surface(RoughPlastic::new(normal, normal, Vec3::ONE, 0.0, 1.0));
        let weight = weight * (surface.let_out() / (1.0 - coat));
        Some(Seen { intersection: Intersection::Hit(Hit::Skin(exit)), bsdf, weight })
    }

    /// The material where a path hits the head or an accessory. What it scatters on has no fine structure: only the mean of that is seen.
    fn material_at(&self, intersection: &Intersection, bounce: u32) -> Option<Material> {
        match intersection {
            Intersection::Hit(Hit::Skin(hit)) if bounce == 0 => {
                Some(self.material(hit, Some(hit.smooth_normal), self.skin.texture))
            }
            Intersection::Hit(Hit::Skin(hit)) => Some(self.material(hit, None, 0.0)),
            _ => None,
        }
    }

    /// What the head or an accessory is made of at a hit, with relief on its `normal` and a fine structure of the strength `texture`.
    fn material(&self, hit: &SkinHit, normal: Option<Vec3>, texture: f32) -> Material {
        let accessory = self.head.as_ref().and_then(|head| head.accessory(hit.face as usize));
        if let Some(accessory) = accessory {
            return accessory_material(accessory);
        }
        let features = self.head.as_ref().and_then(Surface::features);
        let tint = |head: &Surface| head.tint(hit.face as usize, hit.barycentric);
        let tint = self.head.as_ref().map_or(Tint::default(), tint);
        material(features, tint, (hit.position, normal), &SkinLook { texture, ..self.skin })
    }

    fn hair_bsdf(&self, hit: &HairHit, direction: Vec3) -> Bsdf<'_> {
        // Without directors the section is a circle, for which any d1 across the tangent will do.
        let d1 = self.fibres.director(hit.strand, hit.segment, hit.u);
        let d1 = d1.unwrap_or_else(|| hit.tangent.any_orthonormal_vector());
        let frame = FibreFrame::new(hit.tangent, d1);
        let eye = frame.to_local(-direction);
        // A hit measures its offset h along direction × tangent, the BSDF along eye × tangent.
        let (fibre, absorption) = self.fibres.at(hit.strand, hit.segment, hit.u);
        match self.fibres.scattering() {
            Scattering::Chiang => {
                Bsdf::Hair { frame, bsdf: HairBsdf::coloured(fibre, absorption, eye, -hit.h) }
            }
            Scattering::Marschner => {
                let bsdf = Box::new(MarschnerBsdf::new(fibre, absorption, eye));
                Bsdf::Marschner { frame, bsdf }
            }
        }
    }

    /// Next-event estimation: radiance from one sampled light that is scattered towards the eye.
    fn direct_light(
        &self,
        intersection: &Intersection,
        bsdf: &Bsdf<'_>,
        sampler: &mut Sampler,
    ) -> Vec3 {
        let which = sampler.one();
        let light = self.lights.sample(intersection.shading_point(), which, sampler.pair());
        // f cos is known before visibility: where it vanishes no shadow ray is needed.
        let (value, pdf) = bsdf.evaluate(light.towards);
        if light.pdf <= 0.0 || value.max_element() <= 0.0 {
            return Vec3::ZERO;
        }
        let ray = Ray::new(intersection.ray_origin(light.towards), light.towards);
        if self.occluded(&ray, light.distance * SHADOW_RAY_PART) {
            return Vec3::ZERO;
        }
        // A delta light cannot be hit by BSDF sampling: its weight is 1.
        let weight = if light.is_delta { 1.0 } else { power_heuristic(light.pdf, pdf) };
        value * light.radiance * (weight / light.pdf)
    }
}

fn skin_bsdf(hit: &SkinHit, material: &Material, eye: Vec3) -> RoughPlastic {
    let normal = facing(material.normal.unwrap_or(hit.smooth_normal), eye);
    // At most that of a refractive index of 2.6, beyond any varnish.
    let f0 = (F0_PER_GLOSS * material.gloss).clamp(0.0, 0.2);
    RoughPlastic::new(normal, eye, material.colour, f0, material.roughness)
}

/// Reflectance F0 of skin's coat at normal incidence per unit of [`SkinLook::gloss`]: about 0.03 by default,
/// which is that of a refractive index of 1.4. Chosen.
const F0_PER_GLOSS: f32 = 0.24;

/// Bounces whose hits on skin scatter light beneath it; later ones reflect where they hit. Chosen: the difference is not seen.
const SCATTERED_BOUNCES: u32 = 2;

/// The normal, flipped to the side of the eye.
fn facing(normal: Vec3, eye: Vec3) -> Vec3 {
    if normal.dot(eye) < 0.0 { -normal } else { normal }
}
