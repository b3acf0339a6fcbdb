//! Hair as plain data to look at.

use std::sync::Arc;

use frisure::hairstyle::head::Head;
use frisure::hairstyle::{Cancelled, Hairstyle, Monitor, StrandOptions, settling_report, strands};
use frisure::rod::Stability;
use frisure::scene::Scene;
use frisure::strands::{AttributeValues, Strands};
use glam::{DVec3, Vec3};

use crate::order::{Effort, HeadData, Numbers, OneHair, Refusal, Shown, StrandsData};

/// Points that are drawn for a coarse answer, per thread: what a slider leaves time for.
const COARSE_POINTS: usize = 70_000;

/// Most points that are shown: a page in a browser has 4 GiB in all.
const MOST_POINTS: usize = 16_000_000;

/// For how many hairs one is to stand.
pub(crate) fn every(hairstyle: &Hairstyle, effort: Effort) -> usize {
    let points = hairstyle.drawn().saturating_mul(hairstyle.spec().wisps.points);
    let most = match effort {
        Effort::Coarse => MOST_POINTS.min(COARSE_POINTS * rayon::current_num_threads()),
        Effort::Exact => MOST_POINTS,
    };
    points.div_ceil(most).max(1)
}

/// The hairs that were drawn last, so that another light does not draw them again.
#[derive(Debug, Default)]
pub(crate) struct Drawn {
    last: Option<(Arc<Hairstyle>, usize, Arc<Strands>)>,
}

impl Drawn {
    /// Every so manyth hair.
    pub(crate) fn strands(
        &mut self,
        hairstyle: &Arc<Hairstyle>,
        head: &Head,
        every: usize,
        monitor: &dyn Monitor,
    ) -> Result<Arc<Strands>, Cancelled> {
        if let Some((of, thinned, strands)) = &self.last
            && Arc::ptr_eq(of, hairstyle)
            && *thinned == every
        {
            return Ok(strands.clone());
        }
        let options = StrandOptions { stride: every, ..StrandOptions::default() };
        let strands = Arc::new(strands(hairstyle, head, options, monitor)?.strands);
        self.last = Some((hairstyle.clone(), every, strands.clone()));
        Ok(strands)
    }
}

/// A hairstyle to look at, without its head.
pub(crate) fn shown(
    effort: Effort,
    hairstyle: &Hairstyle,
    head: &Head,
    (strands, every): (&Strands, usize),
) -> Shown {
    let root = |position: DVec3| position.as_vec3().to_array();
    Shown {
        effort,
        strands: plain(strands),
        every,
        head: None,
        numbers: numbers(hairstyle, head, strands.len()),
        roots: hairstyle.guides().iter().map(|guide| root(guide.root.position)).collect(),
        wetness: hairstyle.wisps().iter().map(|wisp| wisp.wetness as f32).collect(),
        held: None,
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

/// A head's surface, and what had to be guessed of it.
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

/// Most points along one hair.
const MOST_ALONG: usize = 10_000;

/// One guide.
pub(crate) fn one_hair(
    hairstyle: &Hairstyle,
    wisp: usize,
    points: usize,
) -> Result<OneHair, Refusal> {
    let Some(rest) = hairstyle.equilibria().get(wisp) else {
        let count = hairstyle.guides().len();
        let problem = format!("there is no wisp {wisp}; this head has {count}");
        return Err(Refusal::because(problem, "choose another hair"));
    };
    let sample = rest.sample(points.clamp(2, MOST_ALONG));
    let array = |v: DVec3| v.as_vec3().to_array();
    let section = rest.rod.spec().section;
    Ok(OneHair {
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

/// A file name for what a scene makes: its name in plain characters, or `hair`.
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
    fn a_million_hairs_are_not_more_than_can_be_shown() {
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
        assert_eq!(every(&hair, Effort::Exact), 2);
        assert!(every(&hair, Effort::Coarse) > 2);
    }

    #[test]
    fn names_are_plain() {
        let name = |name: &str| {
            let scene = Scene::parse("a", format!("name = '{name}'"), "".as_ref()).unwrap();
            file_name(&scene, "hair")
        };
        assert_eq!(name("My  hair/../style!"), "my-hair-style.hair");
        assert_eq!(name(""), "hair.hair");
        assert_eq!(name("Frisée"), "frisée.hair");
    }
}
