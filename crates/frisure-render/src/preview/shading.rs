//! Colour of a point of hair and of a point of the head.

use frisure_optics::{Angles, LobeShape, kajiya_kay, lobes};
use glam::Vec3;
use rayon::prelude::*;

use super::ambient::{self, AmbientLight};
use super::constants::{
    ENVIRONMENT_GLOSS, HAIR_BIAS, OVERLAP, SKIN_BIAS, SKIN_GLOSS, SKIN_HAIR_BLUR, SKIN_PENUMBRA,
    SKIN_SPREAD, SKIN_WIDEST, WET_DIFFUSE, WET_GLINT, WET_GLOSS, WET_MIRROR, WET_REFLECTED,
    WET_RETURNED, WET_WIDTH, WRAP, seeping_reach,
};
use super::curves::{Curves, Vertex};
use super::density::{self, DensityMap};
use super::directional::DirectionalLights;
use super::geometry::frame;
use super::head::{Head, HeadPixel};
use super::lumps::Lumps;
use super::material::{Materials, glitter};
use super::shadow::{Penumbra, ShadowMap};
use crate::scene::{Scene, head_centre};
use frisure_look::SkinLook;

/// Optical depth from which a lamp counts for nothing: it leaves less than half a thousandth.
const DARK: f32 = 7.6;

/// Shadows of the head on itself.
const PENUMBRA: Penumbra =
    Penumbra { narrowest: SKIN_PENUMBRA, spread: SKIN_SPREAD, widest: SKIN_WIDEST };

/// What light of a lamp lights, where it is `facing`: light that goes beneath the skin softens the edge of its own shadow.
fn seeping(facing: f32, pixel: &HeadPixel, scatter: f32) -> Vec3 {
    let more = seeping_reach(scatter) * pixel.deep;
    ((Vec3::splat(facing) + more) / (Vec3::ONE + more)).max(Vec3::ZERO)
}

/// A lamp with its shadows.
struct Lamp {
    to_light: Vec3,
    irradiance: Vec3,
    hair: Option<DensityMap>,
    head: Option<ShadowMap>,
}

/// All that is needed to shade a point.
pub(super) struct Shader {
    eye: Vec3,
    lamps: Vec<Lamp>,
    ambient: AmbientLight,
    materials: Materials,
    /// Extinction per hair.
    extinction: Vec3,
    shape: LobeShape,
    skin: SkinLook,
}

impl Shader {
    pub(super) fn new(
        scene: &Scene<'_>,
        curves: &Curves,
        materials: Materials,
        head: Option<&mut Head>,
    ) -> Self {
        let shared = head.as_deref();
        let extinction = materials.extinction(curves.vertices.len(), curves.places());
        let place = head_centre(scene.strands, scene.surface);
        let DirectionalLights { lamps: lit, environment } =
            DirectionalLights::new(&scene.lights, place);
        let lumps = Lumps::new(curves, density::MIN_CELL, density::MAX_CELLS);
        let lamps = || -> Vec<Lamp> {
            lit.par_iter()
                .map(|&(to_light, irradiance)| Lamp {
                    to_light,
                    irradiance,
                    hair: DensityMap::new(&lumps, to_light),
                    head: shared.map(|head| ShadowMap::new(head, to_light)),
                })
                .collect()
        };
        let ambient =
            || AmbientLight::around(&lumps, shared, environment, extinction, ambient::MAX_CELLS);
        let (lamps, ambient) = rayon::join(lamps, ambient);
        if let Some(head) = head {
            head.set_ambient(|point, normal| ambient.on_surface(point, normal));
        }
        let surface = scene.look.hair.surface;
        Self {
            eye: scene.camera.eye().as_vec3(),
            lamps,
            ambient,
            materials,
            extinction,
            shape: LobeShape::of(
                surface.longitudinal_roughness,
                surface.azimuthal_roughness,
                surface.tilt,
            ),
            skin: scene.look.skin,
        }
    }

    /// Radiance of hair towards the eye.
    pub(super) fn hair(&self, vertex: &Vertex) -> Vec3 {
        let material = self.materials.at(vertex.strand, vertex.place);
        let wet = vertex.wetness;
        let eye = (self.eye - vertex.position).normalize_or_zero();
        // Wet hair: less light returns through the film, and the film evens out the scales.
        let diffuse = material.diffuse * (1.0 - WET_DIFFUSE * wet);
        let returned = material.returned * (1.0 - WET_RETURNED * wet);
        let shape = LobeShape {
            width: self.shape.width * (1.0 - WET_WIDTH * wet),
            tilt: self.shape.tilt * (1.0 - wet),
            ..self.shape
        };

        let (strength, shift) = glitter(vertex.strand);
        let reflected = strength * (1.0 - WET_REFLECTED * wet) * material.reflected;

        let environment = self.ambient.mean(vertex.position);
        let mut radiance = environment * (diffuse + ENVIRONMENT_GLOSS * reflected + returned);
        for lamp in &self.lamps {
            let hair = lamp.hair.as_ref().map(|map| map.hairs_around(vertex.position));
            let hairs = hair.as_ref().map_or(0.0, |(before, _)| *before);
            // e^(−7.6) of the light of the smallest extinction: no colour of it is left.
            if hairs * self.extinction.min_element() > DARK {
                continue;
            }
            let head = lamp.head.as_ref().map_or(1.0, |m| m.lit(vertex.position, HAIR_BIAS));
            if head <= 0.0 {
                continue;
            }
            // Beer's law over the hairs in between: the extinction per hair of each colour, and light that meets no hair.
            let passed = (-hairs * self.extinction).exp();
            let straight = (-hairs).exp();
            let mut angles = Angles::new(vertex.tangent, lamp.to_light, eye);
            angles.theta_eye += shift;
            let lobe = lobes(angles, &shape);
            let scattered = kajiya_kay::diffuse(vertex.tangent, lamp.to_light)
                * std::f32::consts::FRAC_1_PI
                * diffuse;
            let direct = lobe.r * reflected + lobe.trt * returned;
            let through = lobe.tt * material.transmitted;
            // Within its cell, hair that is seen stands partly in the shadow of other hair that is.
            let around = hair.map_or(0.0, |(_, around)| around());
            let open = 1.0 - OVERLAP * (1.0 - (-around).exp());
            radiance += head
                * lamp.irradiance
                * (passed * scattered
                    + open * (0.5 * (passed + straight) * direct + straight * through));
        }
        radiance
    }

    /// Part of a lamp's light that the hair before a place on the skin lets pass, the mean over a small disc.
    fn past_hair(&self, lamp: &Lamp, place: Vec3) -> Vec3 {
        let Some(map) = &lamp.hair else { return Vec3::ONE };
        let (u, v) = frame(lamp.to_light);
        let passed = |at: Vec3| (-map.hairs_before(at) * self.extinction).exp();
        let around = [u, -u, v, -v].map(|way| passed(place + SKIN_HAIR_BLUR * way));
        (passed(place) + around.iter().sum::<Vec3>()) / 5.0
    }

    /// Radiance of the head towards the eye.
    pub(super) fn skin(&self, pixel: &HeadPixel) -> Vec3 {
        let normal = pixel.normal.normalize_or_zero();
        let eye = (self.eye - pixel.position).normalize_or_zero();
        let mut radiance = pixel.environment * (pixel.colour + pixel.wet * WET_MIRROR);
        for lamp in &self.lamps {
            let facing = (normal.dot(lamp.to_light) + WRAP) / (1.0 + WRAP);
            if facing <= 0.0 {
                continue;
            }
            let lifted = pixel.position + SKIN_BIAS * normal;
            let head =
                lamp.head.as_ref().map_or(1.0, |m| m.softly_lit(lifted, SKIN_BIAS, PENUMBRA));
            let passed = head * self.past_hair(lamp, lifted);
            let half = (lamp.to_light + eye).normalize_or_zero();
            let mirrored = normal.dot(half).max(0.0);
            // The glint of a wet eye is small and bright.
            let gloss = (1.0 - pixel.wet) * pixel.gloss * mirrored.powi(SKIN_GLOSS)
                + pixel.wet * WET_GLINT * mirrored.powi(WET_GLOSS);
            radiance += passed
                * lamp.irradiance
                * std::f32::consts::FRAC_1_PI
                * (seeping(facing, pixel, self.skin.scatter) * pixel.colour
                    + facing.min(1.0) * gloss);
        }
        radiance
    }
}
