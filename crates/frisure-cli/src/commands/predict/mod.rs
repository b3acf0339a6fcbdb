//! `frisure predict`: a whole head of hair, from a scene to files.

mod files;
mod summary;

use std::path::Path;
use std::sync::Arc;

use frisure::files::Files;
use frisure::formats::groom::Groom;
use frisure::formats::{picture, report};
use frisure::hairstyle::{
    Checkpoint, DrawnHair, StrandOptions, add_sections, guide_strands, penetration,
};
use frisure::look::EnvironmentMap;
use frisure::progress::Progress;
use frisure::render::Image;
use frisure::render::preview::PreviewOptions;
use frisure::scene::{Output, Scene};
use frisure::strands::Strands;
use frisure_engine::checkpoint::HairCheckpoint;
use frisure_engine::picture::{self as pictures, FrameSet, Subject};
use frisure_engine::report::HairstyleReport;
use frisure_engine::{Error, LoadedScene, Runner, StyledScene, environment_map};

use super::read_scene;
use crate::args::{Predict, Quality};
use crate::diagnostics::ExitStatus;
use crate::pictures::{Turntable, noise_filter, trace};
use crate::progress::Bar;
use crate::{console, grooms, hair_checkpoint, interrupt};

use files::StageFiles;
use summary::summary;

/// Points of each guide by which the camera of several pictures is placed; chosen.
const FRAMED: usize = 24;

/// Computes what the arguments ask for, and writes it.
pub(crate) fn run(arguments: Predict, quiet: bool) -> Result<ExitStatus, Error> {
    let scene = read_scene(&arguments.scene)?;
    run_scene(arguments, scene, None, quiet)
}

/// The same for a scene that was read already, with a turntable of its final picture, if wanted.
pub(crate) fn run_scene(
    arguments: Predict,
    scene: Scene,
    turntable: Option<Turntable>,
    quiet: bool,
) -> Result<ExitStatus, Error> {
    let spec = scene.hairstyle_spec()?;
    check_arguments(&arguments, &scene)?;
    let stages = files::stages(&arguments, &scene, &spec);
    files::prepare(&arguments, &scene, &stages, turntable)?;
    let environment = match arguments.image {
        Some(_) => environment_map(&scene, &Files::default())?,
        None => None,
    };
    let progress = Bar::new(quiet);
    let scene = Arc::new(scene);
    let prediction = Arc::new(Prediction { arguments, scene, turntable, environment, progress });
    let result = write_all(&prediction, stages);
    prediction.progress.finish();
    let Written { report, note, lines } = result?;
    if !quiet {
        console::print(&summary(&report, note.as_deref(), &lines))?;
    }
    let converged = report.guides.not_converged == 0;
    Ok(if converged { ExitStatus::Success } else { ExitStatus::NotConverged })
}

/// Checks what the files are asked to hold.
fn check_arguments(arguments: &Predict, scene: &Scene) -> Result<(), Error> {
    grooms::check(&arguments.outputs, arguments.writing)?;
    if arguments.tracing.is_given() && arguments.quality == Quality::Preview {
        let message = "`--paths`, `--noise`, `--bounces` and `--denoise` are for final pictures";
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

/// A prediction with its arguments.
struct Prediction {
    arguments: Predict,
    scene: Arc<Scene>,
    turntable: Option<Turntable>,
    environment: Option<EnvironmentMap>,
    progress: Bar,
}

/// The hairstyles of a prediction.
struct Hairstyles {
    styled: StyledScene,
    /// What every picture has to show, if there are several.
    framed: Option<Strands>,
}

/// A hairstyle with its hairs.
struct Drawn {
    groom: Option<Groom>,
    picture: Option<Picture>,
    /// Of the last hairstyle.
    report: Option<HairstyleReport>,
    /// The simulated hairs so far, until they are written.
    checkpoint: Option<HairCheckpoint>,
}

enum Picture {
    Preview(Image),
    Final(Box<FrameSet>),
}

/// What was written.
struct Written {
    /// Of the last hairstyle.
    report: HairstyleReport,
    note: Option<String>,
    /// A line about each file.
    lines: Vec<String>,
}

/// Computes on threads that can be left behind, and writes on this one, which always finishes the file at hand.
fn write_all(prediction: &Arc<Prediction>, stages: Vec<StageFiles>) -> Result<Written, Error> {
    let worker = prediction.clone();
    let hairstyles = Arc::new(interrupt::compute(move || worker.hairstyles())?);
    let mut lines = Vec::new();
    let mut report = None;
    for (stage, files) in stages.into_iter().enumerate() {
        let (worker, hairstyles) = (prediction.clone(), hairstyles.clone());
        let checkpoint = files.hair_checkpoint.clone();
        let drawn =
            interrupt::compute(move || worker.draw(&hairstyles, stage, checkpoint.as_deref()));
        let drawn =
            drawn.map_err(|e| hair_checkpoint::resumable(e, files.hair_checkpoint.as_deref()))?;
        lines.extend(prediction.write(drawn.groom, drawn.picture, &files)?);
        hair_checkpoint::remove(drawn.checkpoint);
        report = drawn.report;
    }
    let report = report.expect("the last hairstyle has a report");
    if let Some(path) = &prediction.arguments.report {
        interrupt::check()?;
        report::write(path, &report).map_err(|e| Error::failed(&e, ""))?;
        lines.push(path.display().to_string());
    }
    let note = hairstyles.styled.stages[0].note.clone();
    Ok(Written { report, note, lines })
}

impl Prediction {
    fn hairstyles(&self) -> Result<Hairstyles, Error> {
        self.progress.report("head", 0.0);
        let all = self.arguments.each_step;
        let styled = Runner::default().load_stages(&self.scene, all, &self.progress)?;
        let several = self.arguments.image.is_some() && styled.stages.len() > 1;
        let framed = several.then(|| all_guides(&styled.stages));
        Ok(Hairstyles { styled, framed })
    }

    fn draw(
        &self,
        hairstyles: &Hairstyles,
        stage: usize,
        checkpoint: Option<&Path>,
    ) -> Result<Drawn, Error> {
        let Hairstyles { styled: StyledScene { stages, steps }, framed } = hairstyles;
        let (loaded, arguments) = (&stages[stage], &self.arguments);
        let checkpoint = checkpoint.filter(|_| self.draws_hairs());
        let checkpoint = hair_checkpoint::open(checkpoint, loaded, &self.progress)?;
        let hairs = self.draws_hairs().then(|| self.hairs(loaded, checkpoint.as_ref()));
        let hairs = hairs.transpose()?;
        let picture = match (&arguments.image, &hairs) {
            (Some(_), Some(hairs)) => {
                let strands = &hairs.strands;
                Some(self.picture(loaded, strands, framed.as_ref().unwrap_or(strands))?)
            }
            _ => None,
        };
        let report = (stage + 1 == stages.len()).then(|| {
            let steps = steps.clone();
            HairstyleReport { steps, ..self.report(loaded, hairs.as_ref()) }
        });
        let groom = hairs.filter(|_| !arguments.outputs.is_empty());
        let groom = groom.map(|hairs| loaded.groom(hairs.strands, arguments.fibres));
        Ok(Drawn { groom, picture, report, checkpoint })
    }

    /// Whether hairs are needed between the guides.
    fn draws_hairs(&self) -> bool {
        let Predict { outputs, image, report, .. } = &self.arguments;
        !outputs.is_empty() || image.is_some() || report.is_some()
    }

    fn hairs(
        &self,
        loaded: &LoadedScene,
        checkpoint: Option<&HairCheckpoint>,
    ) -> Result<DrawnHair, Error> {
        let checkpoint = checkpoint.map(|checkpoint| checkpoint as &dyn Checkpoint);
        let options = StrandOptions { checkpoint, ..StrandOptions::default() };
        let mut hairs = loaded.draw(options, &self.progress)?;
        if self.arguments.image.is_some() && self.arguments.quality == Quality::Final {
            add_sections(&mut hairs.strands, &loaded.hairstyle, &loaded.head);
        }
        Ok(hairs)
    }

    fn report(&self, loaded: &LoadedScene, hairs: Option<&DrawnHair>) -> HairstyleReport {
        let mut report = loaded.report(hairs);
        if let (Some(_), Some(hairs)) = (&self.arguments.report, hairs) {
            report.hair_penetration = Some(penetration(&hairs.strands, &loaded.head));
        }
        report
    }

    /// The picture of strands, with a camera that has `framed` in it.
    fn picture(
        &self,
        loaded: &LoadedScene,
        strands: &Strands,
        framed: &Strands,
    ) -> Result<Picture, Error> {
        let subject = loaded.subject(strands, self.environment.as_ref());
        let subject = Subject { framed, ..subject };
        if self.arguments.quality == Quality::Preview {
            let Output { width, height, samples, .. } = self.scene.output;
            let options = PreviewOptions { width, height, samples, ..PreviewOptions::default() };
            return subject.preview(&options, &self.progress).map(Picture::Preview);
        }
        let tracing = &self.arguments.tracing;
        let turntable = self.turntable.map(|turntable| turntable.frames);
        let filter = noise_filter(tracing.denoise)?;
        let frames = FrameSet::new(&subject, &tracing.options(&self.scene), turntable, filter)?;
        Ok(Picture::Final(Box::new(frames)))
    }

    /// Writes the files of one hairstyle; returns a line about each.
    fn write(
        &self,
        groom: Option<Groom>,
        picture: Option<Picture>,
        files: &StageFiles,
    ) -> Result<Vec<String>, Error> {
        let mut lines = Vec::new();
        if let Some(groom) = groom {
            lines.extend(grooms::write(groom, &files.grooms, self.arguments.writing)?);
        }
        if let (Some(path), Some(picture)) = (&files.image, picture) {
            interrupt::check()?;
            match picture {
                Picture::Preview(image) => {
                    pictures::write(path, &image, &self.scene.output)?;
                    lines.push(path.display().to_string());
                }
                Picture::Final(frames) => {
                    lines.extend(trace(*frames, path, self.turntable, &self.progress)?);
                }
            }
        }
        Ok(lines)
    }
}

/// The guides of all hairstyles, so that all pictures have one camera.
fn all_guides(stages: &[LoadedScene]) -> Strands {
    let mut all = Strands::new();
    for stage in stages {
        for guide in guide_strands(&stage.hairstyle, FRAMED).iter() {
            all.push(guide.points, guide.radii);
        }
    }
    all
}
