//! `frisure cards`: textured strips in place of strands, in levels of detail.

use std::fmt::Write;
use std::path::PathBuf;
use std::sync::Arc;

use frisure::cards::{self, Cards, CardsError, CardsOptions, Level, VIEWS};
use frisure::formats::cards::{self as files, CardsFileError};
use frisure::formats::groom::{Format, Groom};
use frisure::hairstyle::StrandOptions;
use frisure::progress::Progress;
use frisure_engine::memory;
use frisure_engine::{Error, Quality, Runner, input_files, stage_count};

use super::{read_groom, read_scene};
use crate::args;
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, interrupt, outputs};

/// Reads the groom or predicts the scene, makes its cards and writes them.
pub(crate) fn run(arguments: &args::Cards, quiet: bool) -> Result<ExitStatus, Error> {
    let written = paths(arguments)?;
    let texture = arguments.texture_size;
    memory::check_atlas(texture)?;
    let progress = Bar::new(quiet);
    let groom = groom(arguments, &written, &progress)?;
    let strands = groom.strands();
    let colour = groom.colour.map_or(CardsOptions::default().colour, |c| c.colour);
    let (cards, levels, texture) = (arguments.cards, arguments.lods, arguments.texture_size);
    let options = CardsOptions { cards, levels, texture, colour };
    let cards = cards::cards(strands, groom.head.as_ref(), options, &progress);
    let cards = cards.map_err(|e| Error::because(&e, hint(&e)))?;
    for path in &arguments.outputs {
        interrupt::check()?;
        interrupt::writing(|| files::write(path, &cards)).map_err(|e| match e {
            CardsFileError::Write(_) => Error::failed(&e, ""),
            _ => Error::because(&e, ""),
        })?;
    }
    drop(progress);
    if !quiet {
        console::say(&summary(&cards, strands.len(), &written))?;
    }
    Ok(ExitStatus::Success)
}

/// All files that are written.
fn paths(arguments: &args::Cards) -> Result<Vec<PathBuf>, Error> {
    let mut all = Vec::new();
    for path in &arguments.outputs {
        let of = files::files(path, arguments.lods);
        let of = of.map_err(|e| Error::because(&e, "grooms are written by `frisure convert`"))?;
        // `hair.obj` and `hair.usdc` have the same textures.
        all.extend(
            of.into_iter().filter(|file| file == path || !all.contains(file)).collect::<Vec<_>>(),
        );
    }
    Ok(all)
}

fn groom(arguments: &args::Cards, written: &[PathBuf], progress: &Bar) -> Result<Groom, Error> {
    let path = &arguments.input;
    let written: Vec<_> = written.iter().map(AsRef::as_ref).collect();
    if Format::of(path).is_ok() {
        outputs::prepare(&written, &[path])?;
        progress.report("strands", 0.0);
        return read_groom(path, arguments.axes, "set `--unit` and `--up`");
    }
    if arguments.axes.is_given() {
        let message = "`--unit` and `--up` are for grooms";
        let hint = "for the files of a scene, set them in `[head]` and `[groom]`";
        return Err(Error::invalid(message, hint));
    }
    let scene = Arc::new(read_scene(path)?);
    let mut inputs = input_files(&scene);
    inputs.push(path);
    outputs::prepare(&written, &inputs)?;
    let done = stage_count(&scene);
    let loaded = Runner::default().load(&scene, done, Quality::Exact, progress)?;
    let hairs = loaded.draw(StrandOptions::default(), progress)?.strands;
    Ok(loaded.groom(hairs, false))
}

/// How to ask for cards that there are.
fn hint(error: &CardsError) -> &'static str {
    match error {
        CardsError::Texture { .. } => {
            "ask for a larger `--texture-size`, fewer `--cards` or fewer `--lods`"
        }
        _ => "",
    }
}

/// What was made, how far it is from the strands, and where it is.
fn summary(cards: &Cards, strands: usize, written: &[PathBuf]) -> String {
    let Cards { strands: long, drawn, .. } = cards;
    let mut text =
        format!("{strands} strands, {long} with a length and a width, drawn as {drawn}\n");
    text.push_str("level  cards  triangles  texture  silhouette  coverage  covered area\n");
    for (number, level) in cards.levels.iter().enumerate() {
        let Level { cards, mesh, atlas, differences, .. } = level;
        let mean = |of: fn(&cards::Difference) -> f64| {
            100.0 * differences.iter().map(of).sum::<f64>() / VIEWS.len() as f64
        };
        let (silhouette, coverage) = (mean(|d| d.silhouette), mean(|d| d.coverage));
        let (area, triangles, size) = (mean(|d| d.ratio), mesh.triangles.len(), atlas.size);
        let _ = writeln!(
            text,
            "{number:5}  {cards:5}  {triangles:9}  {size:7}  {silhouette:8.1} %  {coverage:6.1} %  {area:10.1} %"
        );
    }
    for path in written {
        let _ = writeln!(text, "wrote {}", console::shown(path));
    }
    text
}
