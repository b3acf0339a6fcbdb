//! `frisure render`: the final picture of a scene, or of a groom.

use std::path::Path;

use frisure::files::Files;
use frisure::formats::groom::Format as GroomFormat;
use frisure::formats::picture::Format;
use frisure::hairstyle::head::Head;
use frisure::progress::Progress;
use frisure::scene::Scene;
use frisure::strands::Strands;
use frisure_engine::memory::{self, Work};
use frisure_engine::picture::{FrameSet, Subject};
use frisure_engine::{Error, HeadCache, environment_map, input_files};

use super::predict;
use super::{read_groom, read_scene};
use crate::args::{Axes, Predict, Quality, Render, Writing};
use crate::console;
use crate::diagnostics::ExitStatus;
use crate::pictures::{self, Turntable, noise_filter};
use crate::progress::Bar;

/// Predicts the scene, or reads the groom, and traces its picture.
pub(crate) fn run(arguments: Render, quiet: bool) -> Result<ExitStatus, Error> {
    let turntable = turntable(&arguments)?;
    if GroomFormat::of(&arguments.scene).is_ok() {
        return groom(&arguments, turntable, quiet);
    }
    if let Some(look) = &arguments.look {
        let message = format!("`--look {}` is for grooms", look.display());
        let hint = "a scene has its own look; change it there";
        return Err(Error::invalid(message, hint));
    }
    if arguments.axes.is_given() {
        let message = "`--unit` and `--up` are for grooms";
        let hint = "for the files of a scene, set them in `[head]` and `[groom]`";
        return Err(Error::invalid(message, hint));
    }
    let scene = with_view(&arguments, read_scene(&arguments.scene)?);
    let Render { scene: path, output, tracing, .. } = arguments;
    let arguments = Predict {
        scene: path,
        outputs: Vec::new(),
        image: Some(output),
        report: None,
        quality: Quality::Final,
        tracing,
        each_step: false,
        time_samples: false,
        interval: 1.0,
        replicas: None,
        writing: Writing::default(),
        fibres: false,
    };
    predict::run_scene(&arguments, scene, turntable, quiet)
}

fn turntable(arguments: &Render) -> Result<Option<Turntable>, Error> {
    let Some(frames) = arguments.turntable else { return Ok(None) };
    let first = arguments.from;
    if first >= frames {
        let message = format!("frame {first} is none of a turntable of {frames}");
        return Err(Error::invalid(message, "frames are numbered from 0"));
    }
    Ok(Some(Turntable { frames, first }))
}

/// The scene with the size and the camera of the arguments.
fn with_view(arguments: &Render, mut scene: Scene) -> Scene {
    if let Some((width, height)) = arguments.size {
        (scene.output.width, scene.output.height) = (width, height);
    }
    if let Some(camera) = arguments.camera {
        scene.camera.azimuth = camera.to_radians();
    }
    scene
}

/// The hairs of a groom, or its guides where it has no others.
fn strands(path: &Path, axes: Axes) -> Result<Strands, Error> {
    let groom = read_groom(path, axes, "set `--unit` and `--up`")?;
    Ok(if groom.hairs.is_empty() { groom.guides } else { groom.hairs })
}

fn groom(
    arguments: &Render,
    turntable: Option<Turntable>,
    quiet: bool,
) -> Result<ExitStatus, Error> {
    let look = match &arguments.look {
        Some(path) => read_scene(path)?,
        None => Scene::parse("", "", Path::new(""))?,
    };
    let scene = with_view(arguments, look);
    Format::of(&arguments.output).map_err(|e| Error::because(&e, ""))?;
    arguments.tracing.options(&scene).check().map_err(|e| Error::because(&e, ""))?;
    memory::check_picture(Work::Traced(scene.output.width * scene.output.height))?;
    let mut inputs = input_files(&scene);
    inputs.push(&arguments.scene);
    inputs.extend(arguments.look.as_deref());
    pictures::prepare(&pictures::paths(&arguments.output, turntable), &[], &inputs)?;
    let progress = Bar::new(quiet);
    progress.report("strands", 0.0);
    let frames = groom_frames(arguments, &scene, turntable)?;
    let lines = pictures::trace(frames, &arguments.output, turntable, &progress)?;
    drop(progress);
    if !quiet {
        console::print(&lines.iter().map(|line| format!("wrote {line}\n")).collect::<String>())?;
    }
    Ok(ExitStatus::Success)
}

/// The pictures of a groom with the look of a scene; with the scene's head if the scene was given.
fn groom_frames(
    arguments: &Render,
    scene: &Scene,
    turntable: Option<Turntable>,
) -> Result<FrameSet, Error> {
    let (path, files) = (&arguments.scene, Files::default());
    let environment = environment_map(scene, &files)?;
    let filter = noise_filter(arguments.tracing.denoise)?;
    let strands = strands(path, arguments.axes)?;
    let head = arguments.look.as_ref().map(|_| HeadCache::default().load(scene, &files));
    let head = head.transpose()?.map(|loaded| loaded.head);
    let subject = Subject {
        scene,
        strands: &strands,
        framed: &strands,
        surface: head.as_deref().map(Head::surface),
        environment: environment.as_ref(),
    };
    let turntable = turntable.map(|turntable| turntable.frames);
    FrameSet::new(&subject, &arguments.tracing.options(scene), turntable, filter).map_err(|e| {
        match e {
            Error::Invalid { problem, hint } => {
                Error::invalid(format!("`{}`: {problem}", path.display()), &hint)
            }
            e => e,
        }
    })
}
