//! The commands, one per file.

#[cfg(feature = "batch")]
pub(crate) mod batch;
pub(crate) mod cards;
pub(crate) mod convert;
pub(crate) mod fit;
pub(crate) mod hair;
pub(crate) mod measure;
pub(crate) mod measured;
pub(crate) mod new;
pub(crate) mod predict;
pub(crate) mod presets;
pub(crate) mod render;
pub(crate) mod schema;
pub(crate) mod style;
pub(crate) mod transfer;
#[cfg(feature = "validate")]
pub(crate) mod validate;

use std::io::Read;
use std::path::Path;

use frisure::files;
use frisure::formats::groom::{self, Groom};
use frisure::scene::{MAX_SIZE, Scene};
use frisure_engine::{Error, memory};

use crate::args::Axes;
use crate::console;

/// The name of a scene in errors about its size.
const SCENE_FILE: &str = "a scene";

/// The error of a command that this build does not have.
#[cfg(not(all(feature = "batch", feature = "validate")))]
pub(crate) fn not_built(name: &str) -> Error {
    let hint = format!("build with `--features {name}`");
    Error::invalid(format!("this build has no `{name}`"), &hint)
}

/// The scene in a file, or on standard input for `-`.
fn read_scene(path: &Path) -> Result<Scene, Error> {
    parse_scene(path, read_text(path)?)
}

/// Parses the text of a scene file.
fn parse_scene(path: &Path, text: String) -> Result<Scene, Error> {
    let folder = path.parent().unwrap_or(Path::new(""));
    Ok(Scene::parse(&name(path), text, folder)?)
}

/// The text of a scene in a file, or on standard input for `-`.
fn read_text(path: &Path) -> Result<String, Error> {
    if path != Path::new("-") {
        return Ok(files::read_text(path, MAX_SIZE, SCENE_FILE)?);
    }
    let name = name(path);
    let path = Path::new(&name);
    let mut bytes = Vec::new();
    let input = std::io::stdin().lock();
    input.take(MAX_SIZE + 1).read_to_end(&mut bytes).map_err(|e| Error::failed(&e, ""))?;
    if bytes.len() as u64 > MAX_SIZE {
        let (path, limit) = (path.into(), MAX_SIZE);
        return Err(files::ReadError::TooLarge { path, limit, what: SCENE_FILE }.into());
    }
    Ok(files::to_text(bytes, path)?)
}

/// The groom in a file; `hint` names the flags for its unit and axes.
fn read_groom(path: &Path, axes: Axes, hint: &str) -> Result<Groom, Error> {
    memory::check_groom(path)?;
    let read = groom::read_groom(path, axes.choice())
        .map_err(|e| Error::because(&e, if e.may_be_of_unit() { hint } else { "" }))?;
    if read.strands().is_empty() {
        let problem = format!("there is no hair in `{}`: no strand has two points", path.display());
        return Err(Error::invalid(problem, ""));
    }
    if let Some(told) = read.told() {
        console::note(&format!("{}: {told}", path.display()));
    }
    Ok(read)
}

/// The name of a scene in errors.
fn name(path: &Path) -> String {
    if path == Path::new("-") { "<stdin>".into() } else { path.display().to_string() }
}
