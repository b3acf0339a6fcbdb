//! A hairstyle as plain data to look at.

use std::sync::Arc;

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{Hairstyle, StrandOptions, settling_report, strands};
use frisure::progress::{Cancelled, Progress};
use frisure::rod::Stability;
use frisure::scene::Scene;
use frisure::strands::{AttributeValues, Strands};
use glam::{DVec3, Vec3};

use crate::error::Error;
use crate::request::Quality;
use crate::response::{GuideData, HeadData, Numbers, Preview, StrandsData};

/// Points of a coarse preview, per thread: as many as a slider leaves time for; chosen by trial.
const COARSE_POINTS: usize = 70_000;

/// Most points of a preview: a page in a browser has 4 GiB in all.
const MOST_POINTS: usize = 16_000_000;

/// The stride between the hairs that are drawn.
pub(crate) fn stride(hairstyle: &Hairstyle, quality: Quality) -> usize {
    let points = hairstyle.drawn().saturating_mul(hairstyle.spec().wisps.points);
    let most = match quality {
        Quality::Coarse => MOST_POINTS.min(COARSE_POINTS * rayon::current_num_threads()),
        Quality::Exact => MOST_POINTS,
    };
    points.div_ceil(most).max(1)
}

/// The strands that were drawn last, so that another light does not draw them again.
#[derive(Debug, Default)]
pub(crate) struct StrandCache {
    last: Option<(Arc<Hairstyle>, usize, Arc<Strands>)>,
}

impl StrandCache {
    /// Every `stride`-th hair.
    pub(crate) fn strands(
        &mut self,
        hairstyle: &Arc<Hairstyle>,
        head: &Head,
        stride: usize,
        progress: &dyn Progress,
    ) -> Result<Arc<Strands>, Cancelled> {
        if let Some((of, step, strands)) = &self.last
            && Arc::ptr_eq(of, hairstyle)
            && *step == stride
        {
            return Ok(strands.clone());
        }
        let options = StrandOptions { stride, ..StrandOptions::default() };
        let strands = Arc::new(strands(hairstyle, head, options, progress)?.strands);
        self.last = Some((hairstyle.clone(), stride, strands.clone()));
        Ok(strands)
    }
}

/// The preview of a hairstyle, without its head.
pub(crate) fn preview(
    quality: Quality,
    hairstyle: &Hairstyle,
    head: &Head,
    (strands, stride): (&Strands, usize),
) -> Preview {
    let root = |position: DVec3| position.as_vec3().to_array();
    Preview {
        quality,
        strands: plain(strands),
        stride,
        head: None,
        numbers: numbers(hairstyle, head, strands.len()),
        roots: hairstyle.guides().iter().map(|guide| root(guide.root.position)).collect(),
        wetness: hairstyle.wisps().iter().map(|wisp| wisp.wetness as f32).collect(),
        adoption: None,
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
pub(crate) fn head_data(head: &Head, note: Option<&String>) -> HeadData {
    let surface = head.surface();
    HeadData {
        positions: surface.positions().iter().flat_map(DVec3::to_array).collect(),
        triangles: surface.triangles().to_vec(),
        note: note.cloned().unwrap_or_default(),
    }
}

fn numbers(hairstyle: &Hairstyle, head: &Head, drawn: usize) -> Numbers {
    let settling = settling_report(hairstyle, head);
    let count = settling.guides.max(1) as f64;
    let mean = |sum: f64| sum / count;
    Numbers {
        wisps: settling.guides,
        stable: settling.stable,
        unstable: settling.saddles,
        moving: settling.not_converged,
        hairs: hairstyle.grown(),
        drawn,
        mass: hairstyle.mass(),
        length: mean(hairstyle.guides().iter().map(|guide| guide.rod.length()).sum()),
        tips: mean(hairstyle.equilibria().iter().map(|rest| rest.tip().z).sum()),
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
    use frisure::hairstyle::{PredictOptions, predict};

    use super::*;

    #[test]
    fn a_preview_of_a_million_hairs_leaves_some_out() {
        let text = "[hair]\nlength = '5 cm'\n[wisps]\ncount = 4\nhairs = 1_000_000\npoints = 32";
        let scene = Scene::parse("a", text, "".as_ref()).unwrap();
        let hair = predict(
            &scene.hairstyle_spec().unwrap(),
            &Head::mannequin(),
            PredictOptions::default(),
            &(),
        )
        .unwrap();
        assert_eq!(hair.drawn(), 1_000_000);
        assert_eq!(stride(&hair, Quality::Exact), 2);
        assert!(stride(&hair, Quality::Coarse) > 2);
    }

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
