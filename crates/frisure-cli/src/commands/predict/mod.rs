//! `frisure predict`: a whole head of hair, from a scene to files.

mod files;
mod summary;

use std::path::Path;
use std::sync::Arc;

use frisure::files::Files;
use frisure::files::frame::FrameChoice;
use frisure::formats::{picture, report};
use frisure::hairstyle::{Checkpoint, DrawnHair, StrandOptions, add_sections, penetration};
use frisure::look::EnvironmentMap;
use frisure::progress::Progress;
use frisure::scene::Scene;
use frisure::strands::Strands;
use frisure_engine::checkpoint::HairCheckpoint;
use frisure_engine::memory::{self, Work};
use frisure_engine::picture::{FrameSet, Subject};
use frisure_engine::report::HairstyleReport;
use frisure_engine::{Error, LoadedScene, Runner, StyledScene, environment_map, stage_count};

use super::read_scene;
use crate::args::{Predict, Quality};
use crate::diagnostics::ExitStatus;
use crate::grooms::MotionFiles;
use crate::pictures::{Views, noise_filter, previews, trace};
use crate::progress::Bar;
use crate::{console, grooms, hair_checkpoint, interrupt};

use files::StageFiles;
use summary::{buried, summary};

/// Computes what the arguments ask for, and writes it.
pub(crate) fn run(arguments: &Predict, quiet: bool) -> Result<ExitStatus, Error> {
    let views = Views::Cameras(arguments.camera.clone());
    run_scene(arguments, read_scene(&arguments.scene)?, views, quiet)
}

/// The same for a scene that was read already, with these views of it.
pub(crate) fn run_scene(
    arguments: &Predict,
    scene: Scene,
    views: Views,
    quiet: bool,
) -> Result<ExitStatus, Error> {
    let spec = scene.hairstyle_spec()?;
    let requested = scene.requests_accuracy();
    check_arguments(arguments, &scene)?;
    memory::check(&spec, work(arguments, &scene))?;
    if arguments.time_samples {
        memory::check(&spec, Work::Motion(stage_count(&scene)))?;
    }
    let files = files::stages(arguments, &scene, &spec);
    files::prepare(arguments, &scene, &files, &views)?;
    let environment = match arguments.image {
        Some(_) => environment_map(&scene, &Files::default())?,
        None => None,
    };
    let progress = Bar::new(quiet);
    let prediction = Prediction { arguments, views, environment, progress };
    let written = prediction.execute(&Arc::new(scene), &files);
    drop(prediction);
    let Written { report, lines } = written?;
    let (warnings, notes): (Vec<&String>, Vec<&String>) =
        report.head_notes.iter().partition(|line| line.starts_with("warning:"));
    console::warn(&warnings.into_iter().fold(String::new(), |out, line| out + line + "\n"));
    if quiet {
        console::warn(&buried(&report, &spec));
    } else {
        console::say(&summary(&report, &spec, &notes, &lines))?;
    }
    // The default accuracy is what most guides reach in little time, and nothing that was asked for.
    let missed = requested && report.guides.accuracy_missed > 0;
    // A guide on a saddle is not at rest either, nor is a hair that others push on.
    let unbalanced = report.simulated.as_ref().map_or(0, |simulated| match &simulated.contact {
        Some(contact) => contact.hairs - contact.balanced,
        None => simulated.hairs - simulated.stable,
    });
    Ok(match report.guides.not_converged + report.guides.saddles + unbalanced {
        0 if missed || report.guides.undecided > 0 => ExitStatus::Uncertain,
        0 => ExitStatus::Success,
        _ => ExitStatus::NotConverged,
    })
}

/// What is made of the hairs, with the size of the picture.
fn work(arguments: &Predict, scene: &Scene) -> Work {
    let pixels = scene.output.width * scene.output.height;
    match (&arguments.image, arguments.quality) {
        (None, _) => Work::Hairs,
        (Some(_), Quality::Preview) => Work::Preview(pixels),
        (Some(_), Quality::Final) => Work::Traced(pixels),
    }
}

/// Checks what the files are asked to hold.
fn check_arguments(arguments: &Predict, scene: &Scene) -> Result<(), Error> {
    grooms::check(&arguments.outputs, arguments.writing)?;
    if arguments.outputs.is_empty() {
        check_without_grooms(arguments)?;
    }
    if arguments.time_samples {
        grooms::check_motion(&arguments.outputs)?;
    }
    if arguments.accessories {
        grooms::check_accessories(&arguments.outputs)?;
    }
    if arguments.tracing.is_given() && arguments.quality == Quality::Preview {
        let message =
            "`--paths`, `--noise`, `--bounces`, `--clamp` and `--denoise` are for final pictures";
        return Err(Error::invalid(message, "add `--quality final`"));
    }
    if let Some(path) = &arguments.image {
        picture::Format::of(path).map_err(|e| Error::because(&e, ""))?;
        if arguments.quality == Quality::Final {
            let options = arguments.tracing.options(scene);
            options.check().map_err(|e| Error::because(&e, ""))?;
            noise_filter(arguments.tracing.denoise)?;
        }
    }
    Ok(())
}

/// Refuses what says how grooms are written where none is.
fn check_without_grooms(arguments: &Predict) -> Result<(), Error> {
    let Predict { writing, fibres, accessories, .. } = arguments;
    let options = [
        (writing.content.is_some(), "--content"),
        (writing.points.is_some(), "--points"),
        (writing.max_points.is_some(), "--max-points"),
        (writing.hairs.is_some(), "--hairs"),
        (writing.program.is_some(), "--for"),
        (writing.axes.choice() != FrameChoice::default(), "--unit` and `--up"),
        (*fibres, "--fibres"),
        (*accessories, "--accessories"),
    ];
    if let Some((_, name)) = options.into_iter().find(|(given, _)| *given) {
        let message = format!("`{name}` is for grooms, and none is written");
        return Err(Error::invalid(message, "add `-o hair.hair`"));
    }
    if arguments.each_step && arguments.image.is_none() {
        let message = "`--each-step` writes grooms and pictures, and none is asked for";
        return Err(Error::invalid(message, "add `-o hair.hair` or `--image hair.png`"));
    }
    Ok(())
}

/// A prediction with its arguments.
struct Prediction<'a> {
    arguments: &'a Predict,
    views: Views,
    environment: Option<EnvironmentMap>,
    progress: Bar,
}

/// What was written.
struct Written {
    /// Of the last hairstyle.
    report: HairstyleReport,
    /// A line about each file.
    lines: Vec<String>,
}

enum Picture {
    /// Written already: a line about each.
    Previews(Vec<String>),
    Final(Box<FrameSet>),
}

impl Prediction<'_> {
    /// Computes all hairstyles and writes their files.
    fn execute(&self, scene: &Arc<Scene>, files: &[StageFiles]) -> Result<Written, Error> {
        self.progress.report("head", 0.0);
        let all = self.arguments.each_step;
        let mut runner = Runner::default();
        let styled = runner.load_stages(scene, all, &self.progress)?;
        let several = self.arguments.image.is_some() && styled.stages.len() > 1;
        let framed = several.then(|| styled.all_guides());
        let StyledScene { stages, steps } = styled;
        let Predict { outputs, writing, interval, time_samples, .. } = self.arguments;
        let mut motion = time_samples.then(|| MotionFiles::new(outputs, *writing, *interval));
        let mut lines = Vec::new();
        let mut report = None;
        for (stage, (loaded, files)) in stages.iter().zip(files).enumerate() {
            let checkpoint = files.hair_checkpoint.as_deref().filter(|_| self.draws_hairs());
            let checkpoint = hair_checkpoint::open(checkpoint, loaded, &self.progress)?;
            let hairs = self.hairs(loaded, checkpoint.as_ref())?;
            if stage + 1 == stages.len() {
                let mut last = self.report(loaded, hairs.as_ref());
                if let Some(count) = self.arguments.replicas {
                    let replicas = runner.replicas(loaded, count as usize, &self.progress)?;
                    last.guides.replicas = Some(replicas);
                }
                report = Some(last);
            }
            if let Some(hairs) = hairs {
                lines.extend(self.write(loaded, hairs, framed.as_ref(), files, motion.as_mut())?);
            }
            hair_checkpoint::remove(checkpoint);
        }
        lines.extend(motion.map(MotionFiles::write).transpose()?.into_iter().flatten());
        let report = report.expect("the last hairstyle has a report");
        let report = HairstyleReport { steps, ..report };
        if let Some(path) = &self.arguments.report {
            interrupt::check()?;
            let write = || report::write(path, &report);
            interrupt::writing(write).map_err(|e| Error::failed(&e, ""))?;
            lines.push(console::shown(path));
        }
        Ok(Written { report, lines })
    }

    /// Whether hairs are needed between the guides.
    fn draws_hairs(&self) -> bool {
        let Predict { outputs, image, report, .. } = self.arguments;
        !outputs.is_empty() || image.is_some() || report.is_some()
    }

    fn hairs(
        &self,
        loaded: &LoadedScene,
        checkpoint: Option<&HairCheckpoint>,
    ) -> Result<Option<DrawnHair>, Error> {
        if !self.draws_hairs() {
            return Ok(None);
        }
        let checkpoint = checkpoint.map(|checkpoint| checkpoint as &dyn Checkpoint);
        let options = StrandOptions { checkpoint, ..StrandOptions::default() };
        let mut hairs = loaded.draw(options, &self.progress)?;
        if self.arguments.image.is_some() && self.arguments.quality == Quality::Final {
            add_sections(&mut hairs.strands, &loaded.hairstyle, &loaded.head);
        }
        Ok(Some(hairs))
    }

    fn report(&self, loaded: &LoadedScene, hairs: Option<&DrawnHair>) -> HairstyleReport {
        let mut report = loaded.report(hairs);
        if let (Some(_), Some(hairs)) = (&self.arguments.report, hairs) {
            report.hair_penetration = Some(penetration(&hairs.strands, &loaded.head));
        }
        report
    }

    /// Writes the grooms and the picture of a hairstyle; returns a line about each. The camera of the picture has
    /// `framed` in it. Where there is a `motion`, the groom is its next time.
    fn write(
        &self,
        loaded: &LoadedScene,
        hairs: DrawnHair,
        framed: Option<&Strands>,
        files: &StageFiles,
        motion: Option<&mut MotionFiles<'_>>,
    ) -> Result<Vec<String>, Error> {
        let Predict { writing, fibres, accessories, .. } = self.arguments;
        let strands = hairs.strands;
        let picture = match &files.image {
            Some(path) => Some((path, self.picture(loaded, &strands, framed, path)?)),
            None => None,
        };
        let mut lines = Vec::new();
        if let Some(motion) = motion {
            motion.push(loaded.groom(strands, *fibres))?;
        } else if !files.grooms.is_empty() {
            let mut groom = loaded.groom(strands, *fibres);
            if *accessories {
                groom.accessories = loaded.accessories();
            }
            lines = grooms::write(groom, &files.grooms, *writing)?;
        }
        if let Some((path, picture)) = picture {
            interrupt::check()?;
            lines.extend(self.write_picture(path, picture)?);
        }
        Ok(lines)
    }

    /// The previews of strands, which this writes, or the tracer of their final pictures.
    fn picture(
        &self,
        loaded: &LoadedScene,
        strands: &Strands,
        framed: Option<&Strands>,
        path: &Path,
    ) -> Result<Picture, Error> {
        let scene = &loaded.scene;
        let subject = loaded.subject(strands, self.environment.as_ref());
        let subject = Subject { framed: framed.unwrap_or(strands), ..subject };
        if self.arguments.quality == Quality::Preview {
            let lines = previews(&subject, path, &self.views, &self.progress);
            return lines.map(Picture::Previews);
        }
        let tracing = &self.arguments.tracing;
        let filter = noise_filter(tracing.denoise)?;
        let frames =
            FrameSet::new(&subject, &tracing.options(scene), &self.views.frames(), filter)?;
        Ok(Picture::Final(Box::new(frames)))
    }

    fn write_picture(&self, path: &Path, picture: Picture) -> Result<Vec<String>, Error> {
        match picture {
            Picture::Previews(lines) => Ok(lines),
            Picture::Final(frames) => trace(*frames, path, &self.views, &self.progress),
        }
    }
}
