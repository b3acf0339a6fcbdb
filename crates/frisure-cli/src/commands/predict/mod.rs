//! `frisure predict`: a whole head of hair, from a scene to files.

mod numbers;
mod steps;

use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use frisure::files::Files;
use frisure::formats::groom::Groom;
use frisure::formats::{picture, report};
use frisure::hairstyle::head::Head;
use frisure::hairstyle::{
    Adoption, Checkpoint, Hairstyle, HairstyleSpec, Simulation, StrandOptions, add_sections,
    guide_strands, penetration, strands, volume,
};
use frisure::look::EnvironmentMap;
use frisure::progress::Progress;
use frisure::render::preview::{self, PreviewError, PreviewOptions};
use frisure::render::trace::Tracer;
use frisure::render::{self, Image};
use frisure::scene::{self, HeadSource, Scene};
use frisure::strands::Strands;
use frisure_engine::CheckpointFile;
use frisure_engine::picture as seen;
use frisure_engine::{
    AdoptionReport, HeadCache, LoadedHead, environment_map, groom, initial_hairstyle,
};

use super::read_scene;
use crate::args::{Predict, Quality};
use crate::exposing::{self, Shot};
use crate::failure::{Done, Failure};
use crate::progress::Bar;
use crate::written::Grooms;
use crate::{console, interrupt, keeping, outputs};

use numbers::{Numbers, litres, numbers, summary};
use steps::Styled;

/// Computes what the arguments ask for, and writes it.
pub(crate) fn run(arguments: Predict, quiet: bool) -> Result<Done, Failure> {
    let scene = read_scene(&arguments.scene)?;
    run_scene(arguments, scene, None, quiet)
}

/// Pictures from all around.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turntable {
    /// How many.
    pub(crate) frames: usize,
    /// The first that is drawn.
    pub(crate) from: usize,
}

/// The same for a scene that was read already, with a turntable of its final picture, if wanted.
pub(crate) fn run_scene(
    arguments: Predict,
    scene: Scene,
    turntable: Option<Turntable>,
    quiet: bool,
) -> Result<Done, Failure> {
    let spec = scene.hairstyle_spec()?;
    check_outputs(&arguments, &scene, &spec, turntable)?;

    let environment = match arguments.image {
        Some(_) => environment_map(&scene, &Files::default())?,
        None => None,
    };
    let progress = Bar::new(quiet);
    let work = Arc::new(Work { arguments, scene, turntable, environment, progress });
    let result = all(&work, spec);
    work.progress.finish();
    let (numbers, written) = result?;

    if !quiet {
        console::print(&summary(&numbers, &written))?;
    }
    let rested = numbers.guides.not_converged == 0;
    Ok(if rested { Done::Well } else { Done::NotConverged })
}

/// Computes on a thread that can be left, and writes on this one, which always ends what it is at;
/// gives the numbers of the last hairstyle, and what was written.
fn all(work: &Arc<Work>, spec: HairstyleSpec) -> Result<(Numbers, Vec<String>), Failure> {
    let mine = work.clone();
    let hair = Arc::new(interrupt::computing(move || mine.hair(&spec))?);
    let frames = hair.styled.hairstyles.len();
    let mut written = Vec::new();
    let mut last = None;
    for frame in 0..frames {
        let (mine, all) = (work.clone(), hair.clone());
        let drawn = interrupt::computing(move || mine.draw(&all, frame)).map_err(|failure| {
            let spec = hair.styled.hairstyles[frame].spec();
            keeping::interrupted(failure, kept(&work.arguments, spec, frame, frames).as_deref())
        });
        let mut drawn = drawn?;
        let kept = drawn.kept.take();
        last = work.write(drawn, frame, frames, &mut written)?;
        keeping::done(kept);
    }
    let mut numbers = last.expect("the last hairstyle has its numbers");
    numbers.groom = hair.adoption.as_ref().map(AdoptionReport::of);
    numbers.head_note.clone_from(&hair.note);
    numbers.steps.clone_from(&hair.styled.steps);
    if let Some(path) = &work.arguments.report {
        interrupt::check()?;
        report::write(path, &numbers).map_err(|e| Failure::failed(&e))?;
        written.push(path.display().to_string());
    }
    Ok((numbers, written))
}

/// Everything that can be known to be wrong before the work.
fn check_outputs(
    arguments: &Predict,
    scene: &Scene,
    spec: &HairstyleSpec,
    turntable: Option<Turntable>,
) -> Result<(), Failure> {
    Grooms::new(&arguments.outputs, arguments.writing)?;
    if arguments.tracing.is_given() && arguments.quality == Quality::Preview {
        let message = "`--paths`, `--noise`, `--bounces` and `--denoise` are for final pictures";
        return Err(Failure::wrong_because(message, "add `--quality final`"));
    }
    if let Some(path) = &arguments.image {
        picture::Format::of(path).map_err(|e| Failure::wrong(&e, ""))?;
        if arguments.quality == Quality::Final {
            let options = arguments.tracing.options(scene);
            options.check().map_err(|e| Failure::wrong(&e, ""))?;
            exposing::denoiser(arguments.tracing.denoise)?;
        }
    }
    let frames = if arguments.each_step { steps::count(scene) } else { 1 };
    let named = |path: &PathBuf| -> Vec<PathBuf> {
        (0..frames).map(|frame| name_of(arguments, path, frame, frames).into_owned()).collect()
    };
    let mut all: Vec<PathBuf> =
        arguments.outputs.iter().chain(&arguments.image).flat_map(named).collect();
    if let (Some(path), Some(turntable)) = (&arguments.image, turntable) {
        all = exposing::names(path, Some(turntable.frames));
    }
    all.extend(arguments.report.clone());
    let pictures = arguments.image.iter().filter(|_| arguments.quality == Quality::Final);
    let parts = pictures.flat_map(|path| match turntable {
        Some(turntable) => exposing::parts(path, Some(turntable.frames)),
        None => named(path).iter().map(|path| exposing::part(path)).collect(),
    });
    let parts: Vec<PathBuf> = parts.collect();
    let mut inputs = read_by(scene);
    inputs.push(&arguments.scene);
    let all: Vec<&Path> = all.iter().chain(&parts).map(AsRef::as_ref).collect();
    outputs::prepare(&all, &inputs)?;
    exposing::check_parts(&parts)?;
    let kept: Vec<PathBuf> =
        (0..frames).filter_map(|frame| kept(arguments, spec, frame, frames)).collect();
    keeping::check(&kept)
}

/// Where the simulated hairs of a frame are kept until it is written.
fn kept(arguments: &Predict, spec: &HairstyleSpec, frame: usize, frames: usize) -> Option<PathBuf> {
    let Predict { outputs, image, report, .. } = arguments;
    let output = outputs.first().or(image.as_ref()).or(report.as_ref())?;
    keeping::part(spec, &name_of(arguments, output, frame, frames))
}

/// The files that a scene reads, beside itself.
pub(crate) fn read_by(scene: &Scene) -> Vec<&Path> {
    let mut inputs: Vec<&Path> = Vec::new();
    if let HeadSource::Mesh(file) = &scene.head {
        inputs.push(&file.path);
        match &file.scalp {
            scene::ScalpSource::Mask(path) | scene::ScalpSource::Weights(path) => inputs.push(path),
            scene::ScalpSource::Guess
            | scene::ScalpSource::Group(_)
            | scene::ScalpSource::Colour(_) => {}
        }
    }
    inputs.extend(scene.groom.iter().map(|file| file.path.as_path()));
    inputs.extend(scene.environment.iter().map(PathBuf::as_path));
    inputs
}

/// Where an output of a frame goes.
fn name_of<'a>(arguments: &Predict, path: &'a Path, frame: usize, frames: usize) -> Cow<'a, Path> {
    match arguments.each_step {
        true => Cow::Owned(exposing::numbered(path, frame, frames)),
        false => Cow::Borrowed(path),
    }
}

/// The work that is asked for.
struct Work {
    arguments: Predict,
    scene: Scene,
    turntable: Option<Turntable>,
    /// What the scene's file of surroundings shows.
    environment: Option<EnvironmentMap>,
    progress: Bar,
}

/// All hairstyles that are asked for.
struct Hair {
    head: Arc<Head>,
    /// What had to be guessed of the head.
    note: Option<String>,
    styled: Styled,
    /// What is to be in every picture, if there are several.
    shown: Option<Strands>,
    /// How well the scene's groom was held.
    adoption: Option<Adoption>,
}

/// One of them, drawn.
struct Drawn {
    groom: Groom,
    picture: Option<Picture>,
    /// Of the last.
    numbers: Option<Numbers>,
    /// Its hairs so far, until it is written.
    kept: Option<CheckpointFile>,
}

/// A picture, or what it is made with.
enum Picture {
    Preview(Image),
    Final(Box<Shot>),
}

impl Work {
    fn hair(&self, spec: &HairstyleSpec) -> Result<Hair, Failure> {
        self.progress.report("head", 0.0);
        let watch = &self.progress;
        let files = Files::default();
        let LoadedHead { head, note } = HeadCache::default().load(&self.scene, &files)?;
        let (start, adoption) = initial_hairstyle(&self.scene, spec, &head, &files, watch)?;
        let styled = steps::all(&self.scene, &head, start, self.arguments.each_step, watch)?;
        let several = self.arguments.image.is_some() && styled.hairstyles.len() > 1;
        let shown = several.then(|| swept(&styled.hairstyles));
        Ok(Hair { head, note, styled, shown, adoption })
    }

    fn draw(&self, hair: &Hair, frame: usize) -> Result<Drawn, Failure> {
        let (hairstyle, head) = (&hair.styled.hairstyles[frame], &hair.head);
        let mut keep = None;
        let (mut strands, simulation) = match self.draws() {
            true => {
                let watch = &self.progress;
                let frames = hair.styled.hairstyles.len();
                let part = kept(&self.arguments, hairstyle.spec(), frame, frames);
                keep = keeping::open(part, hairstyle, head, watch)?;
                let checkpoint = keep.as_ref().map(|keep| keep as &dyn Checkpoint);
                let options = StrandOptions { checkpoint, ..StrandOptions::default() };
                let drawn = strands(hairstyle, head, options, watch);
                let drawn = drawn.map_err(|_| Failure::Interrupted)?;
                (drawn.strands, drawn.simulation)
            }
            false => Default::default(),
        };
        if self.arguments.image.is_some() && self.arguments.quality == Quality::Final {
            add_sections(&mut strands, hairstyle, head);
        }
        let shown = hair.shown.as_ref().unwrap_or(&strands);
        let picture = self.arguments.image.as_ref().map(|_| self.picture(&strands, shown, head));
        let picture = picture.transpose()?;
        let is_last = frame + 1 == hair.styled.hairstyles.len();
        let numbers = is_last.then(|| self.numbers(hairstyle, head, (&strands, simulation)));
        let groom = match self.arguments.outputs.is_empty() {
            true => Groom::of(strands),
            false => groom(&self.scene, hairstyle, head, strands, self.arguments.fibres),
        };
        Ok(Drawn { groom, picture, numbers, kept: keep })
    }

    /// Whether hairs have to be drawn.
    fn draws(&self) -> bool {
        let Predict { outputs, image, report, .. } = &self.arguments;
        !outputs.is_empty() || image.is_some() || report.is_some()
    }

    fn numbers(
        &self,
        hairstyle: &Hairstyle,
        head: &Head,
        (strands, simulation): (&Strands, Simulation),
    ) -> Numbers {
        let mut numbers = numbers(&self.scene, hairstyle, head, (strands, simulation));
        numbers.volume = self.draws().then(|| litres(&volume(strands, head, hairstyle.grown())));
        let measured = self.arguments.report.is_some();
        numbers.hair_penetration = measured.then(|| penetration(strands, head));
        numbers
    }

    /// A picture of strands, framed so that others would be in it, too.
    fn picture(&self, strands: &Strands, shown: &Strands, head: &Head) -> Result<Picture, Failure> {
        let (surface, aspect) = (Some(head.surface()), seen::aspect(&self.scene));
        let spec = seen::spec(&self.scene, self.environment.as_ref());
        let drawn = spec
            .framed_scene(strands, shown, surface, aspect)
            .map_err(|e| Failure::wrong(&e, ""))?;
        if self.arguments.quality == Quality::Preview {
            return self.preview(&drawn).map(Picture::Preview);
        }
        self.progress.report("strands", 1.0);
        let options = self.arguments.tracing.options(&self.scene);
        let tracer = Tracer::new(&drawn, &options).map_err(|e| Failure::wrong(&e, ""))?;
        let Turntable { frames, from } = self.turntable.unwrap_or(Turntable { frames: 0, from: 0 });
        let views = match self.turntable {
            Some(_) => spec
                .turntable(strands, surface, frames, aspect)
                .map_err(|e| Failure::wrong(&e, ""))?,
            None => Vec::new(),
        };
        let denoiser = exposing::denoiser(self.arguments.tracing.denoise)?;
        Ok(Picture::Final(Box::new(Shot { tracer, views, from, denoiser })))
    }

    fn preview(&self, drawn: &render::Scene<'_>) -> Result<Image, Failure> {
        let scene::Output { width, height, samples, .. } = self.scene.output;
        let options = PreviewOptions { width, height, samples, ..Default::default() };
        preview::render(drawn, &options, &self.progress).map_err(|e| match e {
            PreviewError::Cancelled => Failure::Interrupted,
            PreviewError::Size { .. } => Failure::wrong(&e, ""),
        })
    }

    /// Writes what is asked for of one hairstyle, and gives its numbers back.
    fn write(
        &self,
        drawn: Drawn,
        frame: usize,
        frames: usize,
        written: &mut Vec<String>,
    ) -> Result<Option<Numbers>, Failure> {
        let Drawn { groom, picture, numbers, kept: _ } = drawn;
        let name = |path: &PathBuf| name_of(&self.arguments, path, frame, frames).into_owned();
        let paths: Vec<PathBuf> = self.arguments.outputs.iter().map(name).collect();
        let grooms = Grooms::new(&paths, self.arguments.writing)?;
        written.extend(grooms.write(groom, &paths)?);
        let Some((path, picture)) = self.arguments.image.as_ref().zip(picture) else {
            return Ok(numbers);
        };
        interrupt::check()?;
        let (path, output) = (name_of(&self.arguments, path, frame, frames), &self.scene.output);
        match picture {
            Picture::Preview(image) => {
                exposing::write(&path, &image, output).map_err(|e| Failure::failed(&e))?;
                written.push(path.display().to_string());
            }
            Picture::Final(shot) => {
                let all = exposing::shoot(*shot, &path, output, &self.progress)?;
                written.extend(all.iter().map(ToString::to_string));
            }
        }
        Ok(numbers)
    }
}

/// Points of each guide by which a film is framed.
const FRAMED: usize = 24;

/// The guides of all hairstyles of a film, so that all its pictures are taken from one place.
fn swept(hairstyles: &[Hairstyle]) -> Strands {
    let mut all = Strands::new();
    for hairstyle in hairstyles {
        for guide in guide_strands(hairstyle, FRAMED).iter() {
            all.push(guide.points, guide.radii);
        }
    }
    all
}

/// The head of a scene.
pub(crate) fn head(scene: &Scene) -> Result<Arc<Head>, Failure> {
    Ok(HeadCache::default().load(scene, &Files::default())?.head)
}
