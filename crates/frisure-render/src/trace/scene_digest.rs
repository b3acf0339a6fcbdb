//! What the checkpoint digest is made of: named fields as bytes, so that it is stable between builds.

use frisure_strands::AttributeValues;
use glam::{DVec3, Vec3};

use super::digest::Digest;
use super::options::TraceOptions;
use crate::scene::Scene;
use frisure_look::{
    Aperture, AreaShape, Background, Camera, EnvironmentLight, HairLook, Lamp, Lights, Look,
};

/// The digest of all that makes a picture but its camera and lights.
pub(super) fn scene_digest(scene: &Scene<'_>, options: &TraceOptions) -> Digest {
    let mut digest = Digest::new();
    digest.put(env!("CARGO_PKG_VERSION").as_bytes());
    let Scene { strands, surface, look, .. } = scene;
    for strand in strands.iter() {
        strand.points.iter().for_each(|p| put(&mut digest, &p.to_array()));
        put(&mut digest, strand.radii);
    }
    for attribute in strands.attributes() {
        digest.put(attribute.name.as_bytes());
        match &attribute.values {
            AttributeValues::F32(values) => put(&mut digest, values),
            AttributeValues::F32x2(values) => put(&mut digest, values.as_flattened()),
            AttributeValues::F32x3(values) => put(&mut digest, values.as_flattened()),
            AttributeValues::U32(values) => {
                values.iter().for_each(|x| digest.put(&x.to_le_bytes()));
            }
            AttributeValues::U32x3(values) => {
                values.as_flattened().iter().for_each(|x| digest.put(&x.to_le_bytes()));
            }
        }
    }
    if let Some(surface) = surface {
        let corners = surface.positions().iter().flat_map(DVec3::to_array);
        corners.for_each(|x| digest.put(&x.to_le_bytes()));
    }
    add_look(&mut digest, look);
    let TraceOptions { width, height, bounces, seed, .. } = *options;
    digest.field("size", [width, height].map(|n| (n as u64).to_le_bytes()));
    digest.field("bounces, seed", [bounces, seed].map(u32::to_le_bytes));
    digest
}

/// Adds camera and lights.
pub(super) fn add_view(digest: &mut Digest, camera: &Camera, lights: &Lights) {
    for (name, v) in [
        ("eye", camera.eye()),
        ("forward", camera.forward()),
        ("right", camera.right()),
        ("up", camera.up()),
    ] {
        digest.field(name, v.to_array().map(f64::to_le_bytes));
    }
    digest.field("field of view", [camera.vertical_fov().to_le_bytes()]);
    if let Some(Aperture { radius, focus }) = camera.aperture() {
        digest.field("aperture", [radius, focus.unwrap_or(-1.0)].map(f64::to_le_bytes));
    }
    lights.lamps.iter().for_each(|lamp| add_lamp(digest, lamp));
    match &lights.environment {
        EnvironmentLight::Gradient { sky, ground } => {
            colour(digest, "sky", *sky);
            colour(digest, "ground", *ground);
        }
        EnvironmentLight::Map(map) => {
            digest.field("environment map", [map.digest().to_le_bytes()]);
        }
    }
}

fn add_lamp(digest: &mut Digest, lamp: &Lamp) {
    match lamp {
        Lamp::Distant(lamp) => {
            digest.field("distant light", lamp.direction().to_array().map(f64::to_le_bytes));
            digest.field("radius", [lamp.radius().to_le_bytes()]);
            colour(digest, "irradiance", lamp.irradiance());
        }
        Lamp::Point(lamp) => {
            digest.field("point light", lamp.position().to_array().map(f64::to_le_bytes));
            colour(digest, "intensity", lamp.intensity());
        }
        Lamp::Area(lamp) => {
            digest.field("area light", lamp.centre().to_array().map(f64::to_le_bytes));
            for arm in lamp.arms() {
                digest.field("arm", arm.to_array().map(f64::to_le_bytes));
            }
            digest.field("facing", lamp.facing().to_array().map(f64::to_le_bytes));
            let flags = [lamp.shape() == AreaShape::Disc, lamp.is_shown()];
            digest.field("disc, shown", flags.map(|flag| [u8::from(flag)]));
            colour(digest, "radiance", lamp.radiance());
        }
    }
}

fn add_look(digest: &mut Digest, look: &Look) {
    let HairLook { melanin, surface, roots, tips, .. } = look.hair;
    let HairLook { white_share, variation, absorption, dye, seed, .. } = look.hair;
    number(digest, "melanin", [melanin.eumelanin, melanin.pheomelanin]);
    number(digest, "white share, variation", [white_share, variation]);
    number(digest, "roots", [roots.factor, roots.length]);
    number(digest, "tips", [tips.factor, tips.length]);
    if let Some(absorption) = absorption {
        colour(digest, "absorption", absorption);
    }
    if let Some(dye) = dye {
        colour(digest, "dye", dye.absorption);
        number(digest, "dye strength, regrowth", [dye.strength, dye.regrowth]);
    }
    number(digest, "roughness", [surface.longitudinal_roughness, surface.azimuthal_roughness]);
    number(digest, "tilt, index", [surface.tilt, surface.index]);
    digest.field("seed", [seed.to_le_bytes()]);
    colour(digest, "skin", look.skin.colour);
    number(digest, "gloss", [look.skin.gloss]);
    match look.background {
        Background::Transparent => digest.put(b"transparent"),
        Background::Environment => digest.put(b"environment"),
        Background::Gradient { centre, corner } => {
            colour(digest, "background centre", centre);
            colour(digest, "background corner", corner);
        }
    }
    if let Some(floor) = look.floor {
        digest.field("floor", floor.centre.to_array().map(f64::to_le_bytes));
        digest.field("floor radius", [floor.radius.to_le_bytes()]);
        colour(digest, "floor colour", floor.colour);
    }
}

fn number<const N: usize>(digest: &mut Digest, name: &str, values: [f32; N]) {
    digest.field(name, values.map(f32::to_le_bytes));
}

fn colour(digest: &mut Digest, name: &str, value: Vec3) {
    number(digest, name, value.to_array());
}

fn put(digest: &mut Digest, values: &[f32]) {
    values.iter().for_each(|x| digest.put(&x.to_le_bytes()));
}
