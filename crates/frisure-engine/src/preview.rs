//! A hairstyle as plain data to look at.

use frisure::hairstyle::Hairstyle;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::styling::Height;
use frisure::rod::Stability;
use frisure::scene::{Scene, levels};
use frisure::strands::{AttributeValues, Eye, Strands};
use glam::{DVec3, Vec3};

use crate::error::Error;
use crate::metrics::HairstyleMetrics;
use crate::quality::Quality;
use crate::response::{AccessoryData, GuideData, HeadData, Numbers, Preview, StrandsData};
use crate::runner::LoadedScene;

/// The preview of a scene of which every `stride`-th hair is drawn, without its head.
pub(crate) fn preview(
    quality: Quality,
    loaded: &LoadedScene,
    strands: &Strands,
    stride: usize,
) -> Preview {
    let hairstyle = &loaded.hairstyle;
    let root = |position: DVec3| position.as_vec3().to_array();
    Preview {
        quality,
        strands: plain(strands),
        stride,
        head: None,
        numbers: numbers(&loaded.metrics(), strands.len()),
        roots: hairstyle.guides().iter().map(|guide| root(guide.root.position)).collect(),
        wetness: hairstyle.wisps().iter().map(|wisp| wisp.wetness as f32).collect(),
        adoption: loaded.adoption.clone(),
        accessories: AccessoryData::new(&loaded.shown_accessories()),
    }
}

fn plain(strands: &Strands) -> StrandsData {
    let guide = match strands.attribute("guide").map(|a| &a.values) {
        Some(AttributeValues::U32(wisps)) => wisps.clone(),
        _ => Vec::new(),
    };
    let wetness = match strands.attribute("wetness").map(|a| &a.values) {
        Some(AttributeValues::F32(values)) => values.clone(),
        _ => Vec::new(),
    };
    StrandsData {
        offsets: strands.offsets().to_vec(),
        points: strands.points().iter().flat_map(Vec3::to_array).collect(),
        radii: strands.radii().to_vec(),
        guide,
        wetness,
    }
}

/// The surface of a head, and what was guessed of it.
pub(crate) fn head_data(head: &Head, note: Option<String>) -> HeadData {
    let surface = head.surface();
    let features = surface.features();
    let eye = |eye: &Eye| {
        let ([x, y, z], [u, v, w]) = (eye.centre.to_array(), eye.gaze.to_array());
        [x, y, z, eye.radius, u, v, w]
    };
    HeadData {
        positions: surface.positions().iter().flat_map(DVec3::to_array).collect(),
        triangles: surface.triangles().to_vec(),
        tints: features.map_or(Vec::new(), |features| {
            features.tints.iter().flat_map(|t| [t.lips, t.flush, t.garment, t.scalp]).collect()
        }),
        eyes: features.map_or(Vec::new(), |features| features.eyes.iter().map(eye).collect()),
        levels: levels()
            .map(|(name, level)| (name.to_owned(), Height::Above(level, 0.0).on(head)))
            .collect(),
        hairs: features.map(|features| plain(&features.hairs)).unwrap_or_default(),
        lashes: features.map_or(0, |features| features.lashes),
        note: note.unwrap_or_default(),
    }
}

fn numbers(metrics: &HairstyleMetrics, drawn: usize) -> Numbers {
    let settling = &metrics.settling;
    Numbers {
        wisps: settling.guides,
        stable: settling.stable,
        unstable: settling.saddles + settling.undecided,
        moving: settling.not_converged,
        hairs: metrics.hairs,
        drawn,
        mass: metrics.mass,
        length: metrics.length,
        tips: metrics.tip_height,
        seconds: 0.0,
    }
}

/// Most points along one guide.
const MOST_ALONG: usize = 10_000;

/// One guide with its material frames.
pub(crate) fn guide(hairstyle: &Hairstyle, wisp: usize, points: usize) -> Result<GuideData, Error> {
    let Some(rest) = hairstyle.equilibria().get(wisp) else {
        let count = hairstyle.guides().len();
        let problem = format!("there is no wisp {wisp}; this head has {count}");
        return Err(Error::invalid(problem, "choose another hair"));
    };
    let sample = rest.sample(points.clamp(2, MOST_ALONG));
    let array = |v: DVec3| v.as_vec3().to_array();
    let section = rest.rod.spec().section;
    Ok(GuideData {
        wisp,
        points: sample.iter().map(|(p, _)| array(*p)).collect(),
        frames: sample.iter().map(|(_, r)| [r.x_axis, r.y_axis, r.z_axis].map(array)).collect(),
        length: rest.rod.length(),
        section: [section.a(), section.b()],
        energy: [rest.energy.elastic, rest.energy.gravity, rest.energy.external],
        elements: rest.elements,
        iterations: rest.certificate.iterations,
        gradient: rest.certificate.gradient_norm,
        stability: match rest.certificate.stability {
            Stability::Stable => "stable",
            Stability::Saddle => "saddle",
            Stability::Undecided => "undecided",
            Stability::NotConverged => "moving",
        }
        .to_owned(),
    })
}

/// A file name from the name of a scene, in plain characters, or `hair`.
pub(crate) fn file_name(scene: &Scene, extension: &str) -> String {
    let plain = |c: char| if c.is_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
    let name: String = scene.name.chars().take(60).map(plain).collect();
    let words: Vec<&str> = name.split('-').filter(|word| !word.is_empty()).collect();
    let stem = if words.is_empty() { "hair".to_owned() } else { words.join("-") };
    format!("{stem}.{extension}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_names_are_plain() {
        let name = |name: &str| {
            let scene = Scene::parse("a", format!("name = '{name}'"), "".as_ref()).unwrap();
            file_name(&scene, "hair")
        };
        assert_eq!(name("My  hair/../style!"), "my-hair-style.hair");
        assert_eq!(name(""), "hair.hair");
        assert_eq!(name("Frisée"), "frisée.hair");
    }
}
