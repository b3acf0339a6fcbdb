//! The digest of what a picture shows.

use frisure_digest::Digest;
use frisure_strands::{AccessoryMaterial, AccessoryMesh, AttributeValues, Eye, Strands, Surface};
use glam::{DVec3, Vec3};

use super::options::TraceOptions;
use crate::scene::Scene;

/// The digest of all that makes a picture but its camera, its lights and the number of paths.
pub(super) fn scene_digest(scene: &Scene<'_>, options: &TraceOptions) -> Digest {
    let mut digest = Digest::new("picture");
    digest.field("version", env!("CARGO_PKG_VERSION"));
    let Scene { strands, surface, accessories, look, camera: _, lights: _ } = scene;
    add_strands(&mut digest, strands);
    if let Some(surface) = surface {
        add_mesh(&mut digest, surface);
        if let Some(features) = surface.features() {
            let tints = features.tints.iter().flat_map(|t| [t.lips, t.flush, t.garment, t.scalp]);
            digest.packed("tints", tints.map(f32::to_le_bytes));
            let eye = |e: &Eye| [e.centre.to_array(), [e.radius; 3], e.gaze.to_array()];
            let eyes = features.eyes.iter().flat_map(eye).flatten();
            digest.packed("eyes", eyes.map(f64::to_le_bytes));
            add_strands(&mut digest, &features.hairs);
            digest.field("lashes", &features.lashes);
        }
    }
    for AccessoryMesh { name: _, material, surface } in *accessories {
        add_mesh(&mut digest, surface);
        let AccessoryMaterial { name: _, colour: [r, g, b], gloss, roughness } = *material;
        digest.packed("material", [r, g, b, gloss, roughness].map(f32::to_le_bytes));
    }
    digest.field("look", look);
    let TraceOptions { width, height, bounces, clamp, seed, .. } = *options;
    digest.field("size", &[width, height]).field("bounces", &bounces).field("seed", &seed);
    if let Some(clamp) = clamp {
        digest.field("clamp", &clamp);
    }
    digest
}

fn add_mesh(digest: &mut Digest, surface: &Surface) {
    let positions = surface.positions().iter().flat_map(DVec3::to_array);
    digest.packed("positions", positions.map(f64::to_le_bytes));
    let corners = surface.triangles().iter().flatten();
    digest.packed("triangles", corners.map(|corner| corner.to_le_bytes()));
}

fn add_strands(digest: &mut Digest, strands: &Strands) {
    digest.packed("lengths", strands.iter().map(|s| (s.points.len() as u64).to_le_bytes()));
    let points = strands.points().iter().flat_map(Vec3::to_array);
    digest.packed("points", points.map(f32::to_le_bytes));
    digest.packed("radii", strands.radii().iter().map(|radius| radius.to_le_bytes()));
    for attribute in strands.attributes() {
        let mut floats = |values: &[f32]| {
            digest.packed(&attribute.name, values.iter().map(|x| x.to_le_bytes()));
        };
        match &attribute.values {
            AttributeValues::F32(values) => floats(values),
            AttributeValues::F32x2(values) => floats(values.as_flattened()),
            AttributeValues::F32x3(values) => floats(values.as_flattened()),
            AttributeValues::U32(values) => {
                digest.packed(&attribute.name, values.iter().map(|x| x.to_le_bytes()));
            }
            AttributeValues::U32x3(values) => {
                let values = values.as_flattened().iter();
                digest.packed(&attribute.name, values.map(|x| x.to_le_bytes()));
            }
        }
    }
}
