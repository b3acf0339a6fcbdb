//! Scenes of the experiment, predicted and drawn.

use std::fmt::Display;
use std::path::Path;

use frisure::formats::picture::png;
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{
    Hairstyle, PredictOptions, StrandOptions, Volume, predict, strands, volume,
};
use frisure::progress::Silent;
use frisure::render::preview::{self, PreviewOptions};
use frisure::scene::{Scene, edit};
use frisure::strands::{AttributeValues, Strands};
use frisure_engine::picture as seen;

use crate::{Cancelled, Effort, Picture, Progress, Stopped};

/// A scene and the hair that it predicts, before any step.
pub(super) struct Hair {
    pub(super) scene: Scene,
    pub(super) hairstyle: Hairstyle,
}

/// The error of a failure, or cancellation.
pub(super) fn failed(progress: &dyn Progress, error: impl Display) -> Stopped {
    match progress.is_cancelled() {
        true => Stopped::Cancelled(Cancelled),
        false => Stopped::Other(error.to_string()),
    }
}

/// Eight-bit colours with alpha.
pub(super) struct Pixels {
    size: [usize; 2],
    rgba: Vec<u8>,
}

impl Hair {
    /// Predicts the hair of a scene's text with some keys changed.
    pub(super) fn of(
        text: &str,
        changes: &[(&str, &str)],
        head: &Head,
        effort: Effort,
        progress: &dyn Progress,
    ) -> Result<Self, Stopped> {
        let [width, height] = effort.pick(["160", "200"], ["340", "420"]);
        let mut all =
            vec![("output.width", width), ("output.height", height), ("output.samples", "2")];
        if effort == Effort::Quick {
            // Fewer wisps in more locks, or a head of large wisps would have fewer locks than hair has.
            all.extend([("wisps.count", "40"), ("wisps.hairs", "3000"), ("wisps.splits", "8")]);
        }
        all.extend(changes);
        let all: Vec<(&str, Option<&str>)> = all.into_iter().map(|(k, v)| (k, Some(v))).collect();
        let text = edit::set_keys(text, &all).map_err(|e| failed(progress, e))?;
        let scene = Scene::parse("scene", text, Path::new("")).map_err(|e| failed(progress, e))?;
        let spec = scene.hairstyle_spec().map_err(|e| failed(progress, e))?;
        let hairstyle = predict(&spec, head, PredictOptions::default(), progress)?;
        Ok(Self { scene, hairstyle })
    }

    pub(super) fn strands(&self, head: &Head, progress: &dyn Progress) -> Result<Strands, Stopped> {
        Ok(strands(&self.hairstyle, head, StrandOptions::default(), progress)?.strands)
    }

    pub(super) fn volume(&self, strands: &Strands, head: &Head) -> Volume {
        volume(strands, head, self.hairstyle.grown())
    }

    /// A picture of strands, with or without the head, framed so that other strands would be inside the frame.
    pub(super) fn picture(
        &self,
        strands: &Strands,
        framed: &Strands,
        head: Option<&Head>,
        width_scale: Option<f32>,
        progress: &dyn Progress,
    ) -> Result<Pixels, Stopped> {
        let surface = head.map(Head::surface);
        let aspect = seen::aspect(&self.scene);
        let drawn = seen::spec(&self.scene, None)
            .framed_scene(strands, framed, surface, aspect)
            .map_err(|e| failed(progress, e))?;
        let output = &self.scene.output;
        let (width, height) = (output.width, output.height);
        let options = PreviewOptions { width, height, samples: output.samples, width_scale };
        let silent = Silent(progress);
        let image = preview::render(&drawn, &options, &silent).map_err(|e| failed(progress, e))?;
        Ok(Pixels { size: [width, height], rgba: seen::developed(&image, output) })
    }
}

/// The drawn hairs of a wisp.
pub(super) fn wisp(strands: &Strands, guide: u32) -> Strands {
    let of = strands.attribute("guide").map(|a| &a.values);
    let mut chosen = Strands::new();
    if let Some(AttributeValues::U32(guides)) = of {
        for i in (0..strands.len()).filter(|&i| guides[i] == guide) {
            chosen.push(strands.strand(i).points, strands.strand(i).radii);
        }
    }
    chosen
}

/// Pictures of one height, side by side.
pub(super) fn strip(name: &str, caption: &str, pictures: &[Pixels]) -> Result<Picture, Stopped> {
    let height = pictures.iter().map(|p| p.size[1]).min().unwrap_or(0);
    let width = pictures.iter().map(|p| p.size[0]).sum();
    let mut rgba = Vec::with_capacity(4 * width * height);
    for y in 0..height {
        for picture in pictures {
            let row = 4 * picture.size[0];
            rgba.extend_from_slice(&picture.rgba[y * row..(y + 1) * row]);
        }
    }
    let png = png::encode(width as u32, height as u32, &rgba)
        .map_err(|e| Stopped::Other(e.to_string()))?;
    Ok(Picture { name: name.to_owned(), caption: caption.to_owned(), width, png })
}
