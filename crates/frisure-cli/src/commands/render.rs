//! `frisure render` and `frisure view`: pictures of a scene, or of a groom.

use std::path::{Path, PathBuf};

use frisure::files::Files;
use frisure::formats::groom::{Format as GroomFormat, HairColour};
use frisure::formats::picture::Format;
use frisure::hairstyle::head::Head;
use frisure::look::{HairLook, absorption_of_colour};
use frisure::progress::Progress;
use frisure::scene::Scene;
use frisure::strands::Strands;
use frisure_engine::memory::{self, Work};
use frisure_engine::picture::{FrameSet, Subject};
use frisure_engine::{Error, HeadCache, environment_map, input_files};

use super::predict;
use super::{read_groom, read_scene};
use crate::args::{Axes, Pictured, Predict, Quality, Render, Tracing, View, Writing};
use crate::console;
use crate::diagnostics::ExitStatus;
use crate::pictures::{self, Turntable, Views, noise_filter};
use crate::progress::Bar;

/// Predicts the scene, or reads the groom, and traces its picture.
pub(crate) fn run(arguments: Render, quiet: bool) -> Result<ExitStatus, Error> {
    let Render { pictured, tracing } = arguments;
    picture(pictured, Quality::Final, tracing, quiet)
}

/// The same by projection.
pub(crate) fn view(arguments: View, quiet: bool) -> Result<ExitStatus, Error> {
    picture(arguments.pictured, Quality::Preview, Tracing::default(), quiet)
}

fn picture(
    pictured: Pictured,
    quality: Quality,
    tracing: Tracing,
    quiet: bool,
) -> Result<ExitStatus, Error> {
    let views = views(&pictured)?;
    if GroomFormat::of(&pictured.scene).is_ok() {
        return GroomPicture { pictured: &pictured, views, quality, tracing }.make(quiet);
    }
    if let Some(look) = &pictured.look {
        let message = format!("`--look {}` is for grooms", look.display());
        let hint = "a scene has its own look; change it there";
        return Err(Error::invalid(message, hint));
    }
    if pictured.axes.is_given() {
        let message = "`--unit` and `--up` are for grooms";
        let hint = "for the files of a scene, set them in `[head]` and `[groom]`";
        return Err(Error::invalid(message, hint));
    }
    let scene = with_view(&pictured, read_scene(&pictured.scene)?);
    let Pictured { scene: path, output, .. } = pictured;
    let arguments = Predict {
        scene: path,
        outputs: Vec::new(),
        image: Some(output),
        report: None,
        quality,
        camera: Vec::new(),
        tracing,
        each_step: false,
        time_samples: false,
        interval: 1.0,
        replicas: None,
        writing: Writing::default(),
        fibres: false,
        accessories: false,
    };
    predict::run_scene(&arguments, scene, views, quiet)
}

fn views(pictured: &Pictured) -> Result<Views, Error> {
    let Some(frames) = pictured.turntable else {
        return Ok(Views::Cameras(pictured.camera.clone()));
    };
    if pictured.camera.len() > 1 {
        let message = "a turntable begins at one camera, not at several";
        return Err(Error::invalid(message, "give one `--camera`, or leave out `--turntable`"));
    }
    let first = pictured.from;
    if first >= frames {
        let message = format!("frame {first} is none of a turntable of {frames}");
        return Err(Error::invalid(message, "frames are numbered from 0"));
    }
    Ok(Views::Turntable(Turntable { frames, first }))
}

/// The scene with the size and the camera of the arguments; of several, the first.
fn with_view(pictured: &Pictured, mut scene: Scene) -> Scene {
    if let Some((width, height)) = pictured.size {
        (scene.output.width, scene.output.height) = (width, height);
    }
    if let Some(camera) = pictured.camera.first() {
        scene.camera.azimuth = camera.azimuth;
    }
    scene
}

/// The hairs of a groom, or its guides where it has no others; and the colour of all.
fn strands(path: &Path, axes: Axes) -> Result<(Strands, Option<HairColour>), Error> {
    let groom = read_groom(path, axes, "set `--unit` and `--up`")?;
    Ok((if groom.hairs.is_empty() { groom.guides } else { groom.hairs }, groom.colour))
}

/// A look in the colours that a groom brings.
fn in_own_colours(look: HairLook, colour: Option<HairColour>) -> HairLook {
    let own = HairLook { own_colours: true, ..look };
    match colour {
        Some(HairColour { melanin: Some(melanin), .. }) => {
            HairLook { melanin, absorption: None, ..own }
        }
        Some(HairColour { colour, melanin: None }) => {
            let of = absorption_of_colour(colour.into(), look.surface.azimuthal_roughness);
            HairLook { absorption: Some(of), ..own }
        }
        None => own,
    }
}

/// The pictures of a groom.
struct GroomPicture<'a> {
    pictured: &'a Pictured,
    views: Views,
    quality: Quality,
    tracing: Tracing,
}

impl GroomPicture<'_> {
    fn make(&self, quiet: bool) -> Result<ExitStatus, Error> {
        let Self { pictured, views, quality, tracing } = self;
        let look = match &pictured.look {
            Some(path) => read_scene(path)?,
            None => Scene::parse("", "", Path::new(""))?,
        };
        let mut scene = with_view(pictured, look);
        Format::of(&pictured.output).map_err(|e| Error::because(&e, ""))?;
        let work = self.work(&scene);
        let paths = views.paths(&pictured.output);
        let mut inputs = input_files(&scene);
        inputs.push(&pictured.scene);
        inputs.extend(pictured.look.as_deref());
        match quality {
            Quality::Final => {
                tracing.options(&scene).check().map_err(|e| Error::because(&e, ""))?;
                memory::check_picture(work)?;
                pictures::prepare(&paths, &[], &inputs)?;
            }
            Quality::Preview => {
                memory::check_picture(work)?;
                let paths: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
                pictures::prepare(&[], &paths, &inputs)?;
            }
        }
        let progress = Bar::new(quiet);
        progress.report("strands", 0.0);
        let lines = self.write(&mut scene, &progress)?;
        drop(progress);
        if !quiet {
            let lines: String = lines.iter().map(|line| format!("wrote {line}\n")).collect();
            console::say(&lines)?;
        }
        Ok(ExitStatus::Success)
    }

    fn work(&self, scene: &Scene) -> Work {
        let pixels = scene.output.width * scene.output.height;
        match self.quality {
            Quality::Final => Work::Traced(pixels),
            Quality::Preview => Work::Preview(pixels),
        }
    }

    /// Writes the pictures with the look of a scene; with the scene's head if the scene was given, and else in the colours of the groom. Returns a
    /// line about each.
    fn write(&self, scene: &mut Scene, progress: &Bar) -> Result<Vec<String>, Error> {
        let Self { pictured, views, quality, tracing } = self;
        let (path, files) = (&pictured.scene, Files::default());
        let environment = environment_map(scene, &files)?;
        let filter = noise_filter(tracing.denoise)?;
        let (strands, colour) = strands(path, pictured.axes)?;
        if pictured.look.is_none() {
            scene.look.hair = in_own_colours(scene.look.hair, colour);
        }
        let scene = &*scene;
        memory::check_drawn(strands.points().len(), self.work(scene))?;
        let head = pictured.look.as_ref().map(|_| HeadCache::default().load(scene, &files));
        let head = head.transpose()?.map(|loaded| loaded.head);
        let subject = Subject {
            scene,
            strands: &strands,
            framed: &strands,
            surface: head.as_deref().map(Head::surface),
            accessories: Vec::new(),
            environment: environment.as_ref(),
        };
        let named = |e| match e {
            Error::Invalid { problem, hint } => {
                Error::invalid(format!("`{}`: {problem}", path.display()), &hint)
            }
            e => e,
        };
        if *quality == Quality::Preview {
            return pictures::previews(&subject, &pictured.output, views, progress).map_err(named);
        }
        let frames = FrameSet::new(&subject, &tracing.options(scene), &views.frames(), filter);
        pictures::trace(frames.map_err(named)?, &pictured.output, views, progress)
    }
}
