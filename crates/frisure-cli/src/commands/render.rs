//! `frisure render`: the final picture of a scene, or of a groom.

use std::path::Path;

use frisure::files::Files;
use frisure::formats::picture::Format;
use frisure::hairstyle::head::Head;
use frisure::look::InvalidLight;
use frisure::progress::Progress;
use frisure::render::trace::Tracer;
use frisure::scene::Scene;
use frisure::strands::Strands;

use super::predict::{self, Turntable};
use super::{read_groom, read_scene};
use crate::args::{Axes, Predict, Quality, Render, Writing};
use crate::exposing::{self, Shot};
use crate::failure::{Done, Failure};
use crate::progress::Bar;
use crate::{console, interrupt, outputs};
use frisure_engine::{environment_map, picture};

/// Predicts the scene, or reads the groom, and follows the light in it.
pub(crate) fn run(arguments: Render, quiet: bool) -> Result<Done, Failure> {
    let turntable = turntable(&arguments)?;
    if is_groom(&arguments.scene) {
        return groom(&arguments, turntable, quiet);
    }
    if let Some(look) = &arguments.look {
        let message = format!("`--look {}` is for grooms", look.display());
        let hint = "a scene has its own look; change it there";
        return Err(Failure::wrong_because(message, hint));
    }
    if arguments.axes.is_given() {
        let message = "`--unit` and `--up` are for grooms";
        let hint = "of a scene's files, `[head]` and `[groom]` say them";
        return Err(Failure::wrong_because(message, hint));
    }
    let scene = seen(&arguments, read_scene(&arguments.scene)?);
    let Render { scene: path, output, tracing, .. } = arguments;
    let arguments = Predict {
        scene: path,
        outputs: Vec::new(),
        image: Some(output),
        report: None,
        quality: Quality::Final,
        tracing,
        each_step: false,
        writing: Writing::default(),
        fibres: false,
    };
    predict::run_scene(arguments, scene, turntable, quiet)
}

fn is_groom(path: &Path) -> bool {
    frisure::formats::groom::Format::of(path).is_ok()
}

fn turntable(arguments: &Render) -> Result<Option<Turntable>, Failure> {
    let Some(frames) = arguments.turntable else { return Ok(None) };
    let from = arguments.from;
    if from >= frames {
        let message = format!("frame {from} is none of a turntable of {frames}");
        return Err(Failure::wrong_because(message, "frames are numbered from 0"));
    }
    Ok(Some(Turntable { frames, from }))
}

/// The scene with the size and the camera that were asked for.
fn seen(arguments: &Render, mut scene: Scene) -> Scene {
    if let Some((width, height)) = arguments.size {
        (scene.output.width, scene.output.height) = (width, height);
    }
    if let Some(camera) = arguments.camera {
        scene.camera.azimuth = camera.azimuth();
    }
    scene
}

/// The hairs of a groom, or its guides where it has no others.
fn strands(path: &Path, axes: Axes) -> Result<Strands, Failure> {
    let groom = read_groom(path, axes, "`--unit` and `--up` say what it has")?;
    Ok(if groom.hairs.is_empty() { groom.guides } else { groom.hairs })
}

fn groom(arguments: &Render, turntable: Option<Turntable>, quiet: bool) -> Result<Done, Failure> {
    let look = match &arguments.look {
        Some(path) => read_scene(path)?,
        None => Scene::parse("", "", Path::new(""))?,
    };
    let scene = seen(arguments, look);
    Format::of(&arguments.output).map_err(|e| Failure::wrong(&e, ""))?;
    let options = arguments.tracing.options(&scene);
    options.check().map_err(|e| Failure::wrong(&e, ""))?;
    let names = exposing::names(&arguments.output, arguments.turntable);
    let parts = exposing::parts(&arguments.output, arguments.turntable);
    let names: Vec<&Path> = names.iter().chain(&parts).map(AsRef::as_ref).collect();
    let mut inputs = predict::read_by(&scene);
    inputs.extend(
        [Some(&arguments.scene), arguments.look.as_ref()]
            .into_iter()
            .flatten()
            .map(AsRef::<Path>::as_ref),
    );
    outputs::prepare(&names, &inputs)?;
    exposing::check_parts(&parts)?;
    let environment = environment_map(&scene, &Files::default())?;

    let denoiser = exposing::denoiser(arguments.tracing.denoise)?;
    let progress = Bar::new(quiet);
    let (path, output, has_head) =
        (arguments.scene.clone(), scene.output, arguments.look.is_some());
    let (ready, axes) = (progress.clone(), arguments.axes);
    let shot = interrupt::computing(move || {
        ready.report("strands", 0.0);
        let strands = strands(&path, axes)?;
        let head = if has_head { Some(predict::head(&scene)?) } else { None };
        let surface = head.as_deref().map(Head::surface);
        let wrong = |e: InvalidLight| Failure::wrong(&e, "");
        let (spec, aspect) = (picture::spec(&scene, environment.as_ref()), picture::aspect(&scene));
        let drawn = spec.framed_scene(&strands, &strands, surface, aspect).map_err(wrong)?;
        let named = |e| Failure::wrong_because(format!("`{}`: {e}", path.display()), "");
        let tracer = Tracer::new(&drawn, &options).map_err(named)?;
        let (views, from) = match turntable {
            Some(Turntable { frames, from }) => {
                let views = spec.turntable(&strands, surface, frames, aspect);
                (views.map_err(wrong)?, from)
            }
            None => (Vec::new(), 0),
        };
        Ok(Shot { tracer, views, from, denoiser })
    });
    let exposed =
        shot.and_then(|shot| exposing::shoot(shot, &arguments.output, &output, &progress));
    progress.finish();
    let exposed = exposed?;
    if !quiet {
        let lines: String = exposed.iter().map(|picture| format!("wrote {picture}\n")).collect();
        console::print(&lines)?;
    }
    Ok(Done::Well)
}
