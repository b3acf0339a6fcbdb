//! `frisure predict`: a whole head of hair, from a scene to files.

mod numbers;
mod steps;

use std::borrow::Cow;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use frisure::hairstyle::head::{Head, ScalpSource};
use frisure::hairstyle::{
    Hairstyle, HairstyleSpec, Monitor, PredictError, penetration, predict, volume,
};
use frisure::io::groom::{Format, write_groom};
use frisure::io::scene::{self, HeadSource, Scene};
use frisure::io::{picture, report};
use frisure::render::preview::{self, PreviewOptions};
use frisure::strands::Strands;

use super::read_scene;
use crate::args::Predict;
use crate::failure::{Done, Failure};
use crate::progress::Progress;
use crate::{console, interrupt, outputs};

use numbers::{Numbers, litres, numbers, summary};

/// Computes what the arguments ask for, and writes it.
pub(crate) fn run(arguments: Predict, quiet: bool) -> Result<Done, Failure> {
    let scene = read_scene(&arguments.scene)?;
    let spec = scene.hairstyle_spec()?;
    check_outputs(&arguments, &scene)?;

    let progress = Progress::new(quiet);
    let bar = progress.clone();
    let result = interrupt::computing(move || Work { arguments, scene, progress: bar }.all(&spec));
    progress.finish();
    let (numbers, written) = result?;

    if !quiet {
        console::print(&summary(&numbers, &written))?;
    }
    let rested = numbers.guides.not_converged == 0;
    Ok(if rested { Done::Well } else { Done::NotConverged })
}

/// Everything that can be known to be wrong before the work.
fn check_outputs(arguments: &Predict, scene: &Scene) -> Result<(), Failure> {
    for path in &arguments.outputs {
        Format::of(path).map_err(|e| Failure::wrong(&e, hint_of(path)))?;
    }
    if let Some(path) = &arguments.image {
        picture::check_name(path).map_err(|e| Failure::wrong(&e, ""))?;
    }
    let frames = if arguments.each_step { steps::count(scene) } else { 1 };
    let named = |path: &PathBuf| -> Vec<PathBuf> {
        (0..frames).map(|frame| name_of(arguments, path, frame, frames).into_owned()).collect()
    };
    let mut all: Vec<PathBuf> =
        arguments.outputs.iter().chain(&arguments.image).flat_map(named).collect();
    all.extend(arguments.report.clone());
    let all: Vec<&Path> = all.iter().map(AsRef::as_ref).collect();
    let mut inputs: Vec<&Path> = vec![&arguments.scene];
    if let HeadSource::Mesh(file) = &scene.head {
        inputs.push(&file.path);
        match &file.scalp {
            scene::ScalpSource::Mask(path) | scene::ScalpSource::Weights(path) => inputs.push(path),
            scene::ScalpSource::Guess | scene::ScalpSource::Group(_) => {}
        }
    }
    outputs::prepare(&all, &inputs)
}

/// Where an output of a frame goes.
fn name_of<'a>(arguments: &Predict, path: &'a Path, frame: usize, frames: usize) -> Cow<'a, Path> {
    match arguments.each_step {
        true => Cow::Owned(steps::numbered(path, frame, frames)),
        false => Cow::Borrowed(path),
    }
}

fn hint_of(path: &Path) -> &'static str {
    match path.extension() {
        Some(e) if e.eq_ignore_ascii_case("png") => "pictures go to `--image`",
        Some(e) if e.eq_ignore_ascii_case("json") => "numbers go to `--report`",
        _ => "",
    }
}

/// Tells how far the work is, and to stop after Ctrl-C.
struct Watch<'a>(&'a Progress);

impl Monitor for Watch<'_> {
    fn progress(&self, stage: &'static str, fraction: f64) {
        self.0.show(stage, fraction);
    }

    fn cancelled(&self) -> bool {
        interrupt::interrupted()
    }
}

/// The work that is asked for.
struct Work {
    arguments: Predict,
    scene: Scene,
    progress: Progress,
}

impl Work {
    /// Computes and writes everything; gives the numbers of the last hairstyle, and what was written.
    fn all(self, spec: &HairstyleSpec) -> Result<(Numbers, Vec<PathBuf>), Failure> {
        self.progress.show("head", 0.0);
        let (head, watch) = (head(&self.scene)?, Watch(&self.progress));
        let each = self.arguments.each_step;
        let start = predict(spec, &head, &watch).map_err(|e| refused(&e, &self.scene))?;
        let styled = steps::all(&self.scene, &head, start, each, &watch)?;
        let mut written = Vec::new();
        let mut last = None;
        let frames = styled.hairstyles.len();
        let shown = (frames > 1).then(|| swept(&styled.hairstyles));
        for (frame, hairstyle) in styled.hairstyles.iter().enumerate() {
            let strands = match self.draws() {
                true => hairstyle.strands(&head, &watch).map_err(|_| Failure::Interrupted)?,
                false => Strands::new(),
            };
            for path in &self.arguments.outputs {
                interrupt::check()?;
                let path = name_of(&self.arguments, path, frame, frames);
                write_groom(&path, &strands).map_err(|e| Failure::failed(&e))?;
                written.push(path.into_owned());
            }
            if let Some(path) = &self.arguments.image {
                let path = name_of(&self.arguments, path, frame, frames);
                self.draw(&path, &strands, shown.as_ref().unwrap_or(&strands), &head)?;
                written.push(path.into_owned());
            }
            if frame + 1 == frames {
                last = Some(self.numbers(hairstyle, &head, &strands));
            }
        }
        let mut numbers = last.expect("there is one hairstyle at least");
        numbers.steps = styled.steps;
        if let Some(path) = &self.arguments.report {
            interrupt::check()?;
            report::write(path, &numbers).map_err(|e| Failure::failed(&e))?;
            written.push(path.clone());
        }
        Ok((numbers, written))
    }

    /// Whether hairs have to be drawn.
    fn draws(&self) -> bool {
        let Predict { outputs, image, report, .. } = &self.arguments;
        !outputs.is_empty() || image.is_some() || report.is_some()
    }

    fn numbers(&self, hairstyle: &Hairstyle, head: &Head, strands: &Strands) -> Numbers {
        let mut numbers = numbers(&self.scene, hairstyle, head, strands);
        numbers.volume = self.draws().then(|| litres(&volume(strands, head, hairstyle.grown())));
        let measured = self.arguments.report.is_some();
        numbers.hair_penetration = measured.then(|| penetration(strands, head));
        numbers
    }

    /// Writes a picture of strands, framed so that others would be in it, too.
    fn draw(
        &self,
        path: &Path,
        strands: &Strands,
        shown: &Strands,
        head: &Head,
    ) -> Result<(), Failure> {
        let scene::Output { width, height, samples } = self.scene.output;
        let options = PreviewOptions { width, height, samples, ..PreviewOptions::default() };
        let watch = |done: f64| {
            self.progress.show("picture", done);
            if interrupt::interrupted() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let drawn = crate::picture::scene(&self.scene, strands, shown, head.surface());
        let image = preview::render(&drawn, &options, &watch).map_err(|e| match e {
            preview::PreviewError::Cancelled => Failure::Interrupted,
            preview::PreviewError::Size { .. } => Failure::wrong(&e, ""),
        })?;
        let [width, height] =
            [width, height].map(|n| u32::try_from(n).expect("scenes have at most 16384 pixels"));
        interrupt::check()?;
        picture::write(path, width, height, &image.to_srgb8()).map_err(|e| Failure::failed(&e))
    }
}

/// Points of each guide by which a film is framed.
const FRAMED: usize = 24;

/// The guides of all hairstyles of a film, so that all its pictures are taken from one place.
fn swept(hairstyles: &[Hairstyle]) -> Strands {
    let mut all = Strands::new();
    for hairstyle in hairstyles {
        for guide in hairstyle.guide_strands(FRAMED).iter() {
            all.push(guide.points, guide.radii);
        }
    }
    all
}

fn head(scene: &Scene) -> Result<Head, Failure> {
    let Some(mesh) = scene.head_mesh()? else { return Ok(Head::mannequin()) };
    let scalp = mesh.scalp.map_or(ScalpSource::Guess, ScalpSource::Weights);
    Head::from_surface(mesh.surface, scalp)
        .map_err(|e| scene.fault("head.mesh", e.to_string(), "").into())
}

fn refused(error: &PredictError, scene: &Scene) -> Failure {
    match error {
        PredictError::Cancelled(_) => Failure::Interrupted,
        PredictError::Quantity(error) => scene.blame(error).into(),
        PredictError::Parting(e) => {
            let key = format!("implantation.partings[{}].line[{}]", e.index, e.place);
            scene.fault(&key, e.to_string(), "").into()
        }
        PredictError::Crowded(e) => scene.fault("wisps.count", e.to_string(), "").into(),
        PredictError::Spec(error) => scene.out_of_range(error).into(),
    }
}
