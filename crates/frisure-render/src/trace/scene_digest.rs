//! What the checkpoint digest is made of.

use frisure_strands::AttributeValues;
use glam::DVec3;

use super::digest::Digest;
use super::options::TraceOptions;
use crate::scene::Scene;
use frisure_look::{Camera, Lights};

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
    let TraceOptions { width, height, bounces, seed, .. } = options;
    digest.put(format!("{look:?} {width} {height} {bounces} {seed}").as_bytes());
    digest
}

/// Adds camera and lights.
pub(super) fn add_view(digest: &mut Digest, camera: &Camera, lights: &Lights) {
    digest.put(format!("{camera:?} {lights:?}").as_bytes());
}

fn put(digest: &mut Digest, values: &[f32]) {
    values.iter().for_each(|x| digest.put(&x.to_le_bytes()));
}
