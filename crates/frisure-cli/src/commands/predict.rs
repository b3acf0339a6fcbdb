//! `frisure predict`: a whole head of hair, from a scene to files.

use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::Path;

use frisure::hairstyle::head::{Head, ScalpSource};
use frisure::hairstyle::{
    Body, HairContact, Hairstyle, HairstyleSpec, Monitor, PredictError, Volume, penetration,
    predict, volume,
};
use frisure::io::groom::{Format, write_groom};
use frisure::io::scene::{self, HeadSource, Scene};
use frisure::io::{picture, report};
use frisure::render::preview::{self, PreviewOptions};
use frisure::strands::Strands;
use serde::Serialize;

use super::read_scene;
use crate::args::Predict;
use crate::failure::{Done, Failure};
use crate::progress::Progress;
use crate::{console, interrupt, outputs};

/// Computes what the arguments ask for, and writes it.
pub(crate) fn run(arguments: Predict, quiet: bool) -> Result<Done, Failure> {
    let scene = read_scene(&arguments.scene)?;
    let spec = scene.hairstyle_spec()?;
    check_outputs(&arguments, &scene)?;

    let progress = Progress::new(quiet);
    let (bar, wanted) = (progress.clone(), Wanted::of(&arguments));
    let result = interrupt::computing(move || compute(&scene, &spec, wanted, &bar));
    progress.finish();
    let result = result?;

    let written = write(&arguments, &result)?;
    if !quiet {
        console::print(&summary(&result.numbers, &written))?;
    }
    let rested = result.numbers.guides.not_converged == 0;
    Ok(if rested { Done::Well } else { Done::NotConverged })
}

/// What has to be computed.
#[derive(Clone, Copy)]
struct Wanted {
    strands: bool,
    picture: bool,
    report: bool,
}

impl Wanted {
    fn of(arguments: &Predict) -> Self {
        let (picture, report) = (arguments.image.is_some(), arguments.report.is_some());
        let strands = picture || report || !arguments.outputs.is_empty();
        Self { strands, picture, report }
    }
}

/// What was computed.
struct Computed {
    numbers: Numbers,
    strands: Strands,
    /// Width, height and pixels.
    picture: Option<(u32, u32, Vec<u8>)>,
}

/// The report; SI units. No time and no machine: the same scene gives the same bytes.
#[derive(Debug, Serialize)]
struct Numbers {
    scene: String,
    hair_type: &'static str,
    seed: u64,
    guides: Guides,
    contact: Contact,
    thickness: Thickness,
    /// Of all guides (J).
    energy: Energies,
    hairs: usize,
    points: usize,
    /// Deepest that a drawn hair is inside the head (m); measured for the report alone.
    hair_penetration: Option<f64>,
    /// Of the drawn hairs; without them there is none.
    volume: Option<Litres>,
    /// Smallest and largest corner of the box around the hair (m).
    bounds: Option<[[f32; 3]; 2]>,
}

/// How the guides came to rest.
#[derive(Debug, Serialize)]
struct Guides {
    count: usize,
    stable: usize,
    saddles: usize,
    not_converged: usize,
    elements: usize,
    iterations: usize,
    /// Over all guides, in which wisps made way for each other.
    sweeps: usize,
    /// Largest relative gradient.
    gradient_norm: f64,
    /// The relative gradient that wisps among each other were to reach.
    tolerance: f64,
    /// Deepest that a guide is inside the head (m).
    penetration: f64,
}

/// The models of contact.
#[derive(Debug, Serialize)]
struct Contact {
    body: &'static str,
    hair: &'static str,
}

/// Mean over wisps, half-way along.
#[derive(Debug, Serialize)]
struct Thickness {
    /// Packed radius (m).
    radius: f64,
    /// Fraction of a wisp that is hair.
    packing: f64,
}

/// Space that the drawn hairs take (m³).
#[derive(Debug, Serialize)]
struct Litres {
    /// Air between hairs included.
    region: f64,
    /// The hairs themselves, for as many as grow.
    hair: f64,
    /// Side of the cells over which hair was averaged (m).
    cell: f64,
}

#[derive(Debug, Serialize)]
struct Energies {
    elastic: f64,
    gravity: f64,
    contact: f64,
    total: f64,
}

/// Everything that can be known to be wrong before the work.
fn check_outputs(arguments: &Predict, scene: &Scene) -> Result<(), Failure> {
    for path in &arguments.outputs {
        Format::of(path).map_err(|e| Failure::wrong(&e, hint_of(path)))?;
    }
    if let Some(path) = &arguments.image {
        picture::check_name(path).map_err(|e| Failure::wrong(&e, ""))?;
    }
    let grooms = arguments.outputs.iter().map(AsRef::as_ref);
    let others = [&arguments.image, &arguments.report].into_iter().flatten();
    let all: Vec<&Path> = grooms.chain(others.map(AsRef::as_ref)).collect();
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

fn compute(
    scene: &Scene,
    spec: &HairstyleSpec,
    wanted: Wanted,
    progress: &Progress,
) -> Result<Computed, Failure> {
    progress.show("head", 0.0);
    let head = head(scene)?;
    let watch = Watch(progress);
    let hairstyle = predict(spec, &head, &watch).map_err(|e| refused(&e, scene))?;
    let strands = if wanted.strands {
        hairstyle.strands(&head, &watch).map_err(|_| Failure::Interrupted)?
    } else {
        Strands::new()
    };
    let picture = wanted.picture.then(|| draw(scene, &strands, &head, progress)).transpose()?;
    let mut numbers = numbers(scene, &hairstyle, &head, &strands);
    numbers.volume = wanted.strands.then(|| litres(&volume(&strands, &head, hairstyle.grown())));
    numbers.hair_penetration = wanted.report.then(|| penetration(&strands, &head));
    Ok(Computed { numbers, strands, picture })
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

fn draw(
    scene: &Scene,
    strands: &Strands,
    head: &Head,
    progress: &Progress,
) -> Result<(u32, u32, Vec<u8>), Failure> {
    let scene::Output { width, height, samples } = scene.output;
    let options = PreviewOptions { width, height, samples, ..PreviewOptions::default() };
    let watch = |done: f64| {
        progress.show("picture", done);
        if interrupt::interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let drawn = crate::picture::scene(scene, strands, head.surface());
    let image = preview::render(&drawn, &options, &watch).map_err(|e| match e {
        preview::PreviewError::Cancelled => Failure::Interrupted,
        preview::PreviewError::Size { .. } => Failure::wrong(&e, ""),
    })?;
    let [width, height] =
        [width, height].map(|n| u32::try_from(n).expect("scenes have at most 16384 pixels"));
    Ok((width, height, image.to_srgb8()))
}

fn numbers(scene: &Scene, hairstyle: &Hairstyle, head: &Head, strands: &Strands) -> Numbers {
    let (spec, settling) = (hairstyle.spec(), hairstyle.report(head));
    let energy = &settling.energy;
    Numbers {
        scene: scene.name.clone(),
        hair_type: scene.hair_type,
        seed: spec.seed,
        guides: Guides {
            count: settling.guides,
            stable: settling.stable,
            saddles: settling.saddles,
            not_converged: settling.not_converged,
            elements: settling.elements,
            iterations: settling.iterations,
            sweeps: settling.sweeps,
            gradient_norm: settling.gradient_norm,
            tolerance: spec.equilibrium.tolerance,
            penetration: settling.penetration,
        },
        contact: Contact { body: body(spec.contact.body), hair: hair(spec.contact.hair) },
        thickness: thickness(hairstyle),
        energy: Energies {
            elastic: energy.elastic,
            gravity: energy.gravity,
            contact: energy.external,
            total: energy.total(),
        },
        hairs: strands.len(),
        points: strands.points().len(),
        hair_penetration: None,
        volume: None,
        bounds: strands.bounds().map(|(low, high)| [low.to_array(), high.to_array()]),
    }
}

fn body(body: Body) -> &'static str {
    match body {
        Body::None => "none",
        Body::Spheres => "spheres",
        Body::SignedDistance => "signed-distance",
    }
}

fn hair(hair: HairContact) -> &'static str {
    match hair {
        HairContact::None => "none",
        HairContact::Layers => "layers",
        HairContact::Wisps => "wisps",
    }
}

fn thickness(hairstyle: &Hairstyle) -> Thickness {
    let guides = hairstyle.guides();
    let mean = |of: fn(&frisure::hairstyle::contact::Thickness, f64) -> f64| {
        let sum: f64 = guides.iter().map(|g| of(&g.thickness, 0.5 * g.rod.length())).sum();
        sum / guides.len().max(1) as f64
    };
    Thickness {
        radius: mean(frisure::hairstyle::contact::Thickness::packed),
        packing: mean(frisure::hairstyle::contact::Thickness::packing),
    }
}

fn litres(volume: &Volume) -> Litres {
    Litres { region: volume.region, hair: volume.hair, cell: volume.cell }
}

/// Writes all outputs, and gives their paths.
fn write<'a>(arguments: &'a Predict, result: &Computed) -> Result<Vec<&'a Path>, Failure> {
    let mut written = Vec::new();
    for path in &arguments.outputs {
        interrupt::check()?;
        write_groom(path, &result.strands).map_err(|e| Failure::failed(&e))?;
        written.push(path.as_path());
    }
    if let (Some(path), Some((width, height, pixels))) = (&arguments.image, &result.picture) {
        interrupt::check()?;
        picture::write(path, *width, *height, pixels).map_err(|e| Failure::failed(&e))?;
        written.push(path);
    }
    if let Some(path) = &arguments.report {
        interrupt::check()?;
        report::write(path, &result.numbers).map_err(|e| Failure::failed(&e))?;
        written.push(path);
    }
    Ok(written)
}

fn summary(numbers: &Numbers, written: &[&Path]) -> String {
    let guides = &numbers.guides;
    let name = if numbers.scene.is_empty() { numbers.hair_type } else { &numbers.scene };
    let mut out = format!("{name}: {} of {} guides at rest", guides.stable, guides.count);
    // Writing to a String cannot fail.
    if guides.saddles > 0 {
        let _ = write!(out, ", {} on a saddle", guides.saddles);
    }
    if guides.not_converged > 0 {
        let _ = write!(out, ", {} not converged", guides.not_converged);
    }
    if written.is_empty() {
        let hint = "add `-o hair.hair`, `--image hair.png` or `--report hair.json`";
        let _ = writeln!(out, "\nnothing was written: {hint}");
        return out;
    }
    let _ = write!(out, "; {} hairs of {} points in all", numbers.hairs, numbers.points);
    if let Some(volume) = &numbers.volume {
        let _ = write!(out, ", {:.1} litres of hair", volume.region * 1e3);
    }
    out.push('\n');
    for path in written {
        let _ = writeln!(out, "wrote {}", path.display());
    }
    out
}
