//! The files that a scene names, read: head, groom and environment map.

use std::path::{Path, PathBuf};

use frisure::files::Files;
use frisure::files::frame::FrameChoice;
use frisure::formats::environment;
use frisure::formats::groom::{self, Format, Groom, GroomError};
use frisure::formats::head::{self, HeadFile, HeadFileError, HeadMesh, ScalpSource};
use frisure::look::EnvironmentMap;
use frisure::scene::{GroomFile, HeadSource, Scene, SceneError};

use crate::error::message;
use crate::memory;

/// The files that a scene names, beside itself.
#[must_use]
pub fn input_files(scene: &Scene) -> Vec<&Path> {
    let mut inputs: Vec<&Path> = Vec::new();
    inputs.extend(head_files(&scene.head));
    inputs.extend(scene.groom.iter().flat_map(groom_files));
    inputs.extend(scene.environment.iter().map(PathBuf::as_path));
    inputs
}

/// The files of a head: its mesh, and its scalp where that is another file.
pub(crate) fn head_files(head: &HeadSource) -> impl Iterator<Item = &Path> {
    let file = match head {
        HeadSource::Mesh(file) => Some(file),
        HeadSource::Mannequin | HeadSource::Person { .. } => None,
    };
    let scalp = file.and_then(|file| match &file.scalp {
        ScalpSource::Mask(path) | ScalpSource::Weights(path) => Some(path.as_path()),
        ScalpSource::Guess | ScalpSource::Group(_) | ScalpSource::Colour(_) => None,
    });
    [file.map(|file| file.path.as_path()), scalp].into_iter().flatten()
}

/// The files of a groom: its own, and those of the head that it was made on.
pub(crate) fn groom_files(groom: &GroomFile) -> impl Iterator<Item = &Path> {
    std::iter::once(groom.path.as_path()).chain(groom.head.iter().flat_map(head_files))
}

/// The mesh of the scene's head, which is in `file`.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub(crate) fn head_mesh(
    scene: &Scene,
    file: &HeadFile,
    files: &Files,
) -> Result<HeadMesh, SceneError> {
    head::read(file, files).map_err(|e| {
        let hint = match e {
            HeadFileError::Size { .. } => "set `unit` or `scale`, and `up`, of `[head]`",
            _ => "",
        };
        scene.error_at(key(&e, file), message(&e), hint)
    })
}

/// What the reader assumed of the head's mesh, for a person.
pub(crate) fn head_note(file: &HeadFile, mesh: &HeadMesh) -> Option<String> {
    let path = file.path.display();
    let unit = mesh.guessed_unit.map(|unit| {
        format!("{path} states no unit; {unit} is assumed: set `head.unit` to change it")
    });
    let mask = mesh.mask_repeated.map(|[low, high]| {
        format!(
            "warning: texture coordinates of {path} go from {low:.2} to {high:.2}, and the scalp mask is repeated beyond 0 to 1: a mesh \
             with several tiles needs one whose tile of the scalp is from 0 to 1"
        )
    });
    let notes: Vec<String> = [unit, mask].into_iter().flatten().collect();
    (!notes.is_empty()).then(|| notes.join("\n"))
}

/// How a user says in which unit and axes a groom is.
pub(crate) const GROOM_FRAME: &str = "set `unit` and `up` of `[groom]` in a scene, or `--from-unit` and `--from-up` of `frisure transfer`";

/// The groom that the scene names, if it names one, with the scale that the scene gives it.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub fn scene_groom(scene: &Scene, files: &Files) -> Result<Option<Groom>, SceneError> {
    let Some(file) = &scene.groom else { return Ok(None) };
    memory::check_groom(&file.path)
        .map_err(|e| scene.error_at("groom.file", e.to_string(), e.hint()))?;
    let groom = read_groom(file, file.placement.scale, files).map_err(|e| {
        let hint = if e.may_be_of_unit() { GROOM_FRAME } else { "" };
        scene.error_at("groom.file", message(&e), hint)
    })?;
    if groom.strands().is_empty() {
        let problem = format!("`{}` has no strands", file.path.display());
        return Err(scene.error_at("groom.file", problem, ""));
    }
    Ok(Some(groom))
}

/// The groom in a file in its unit and axes, all lengths times `scale`; neither turned nor moved.
pub(crate) fn read_groom(file: &GroomFile, scale: f64, files: &Files) -> Result<Groom, GroomError> {
    let format = Format::of(&file.path)?;
    let bytes = files.read_bytes(&file.path, groom::MAX_SIZE, "a groom")?;
    // A size that hair can have is asked of the groom as it will lie on the head: with the scale of the scene.
    groom::decode(format, &bytes, &file.path, FrameChoice { scale, ..file.frame })
}

/// The environment map that the scene names, if it names one.
///
/// # Errors
/// [`SceneError`] at the key that names what cannot be used.
pub fn environment_map(scene: &Scene, files: &Files) -> Result<Option<EnvironmentMap>, SceneError> {
    let Some(path) = &scene.environment else { return Ok(None) };
    let wrong = |problem, hint| scene.error_at("light.environment", problem, hint);
    let size = std::fs::metadata(path).map_or(0, |about| about.len());
    let most = memory::room(memory::ENVIRONMENT_PIXEL, size as f64);
    let read = environment::read(path, files, most).map_err(|e| wrong(message(&e), e.hint()))?;
    let map = EnvironmentMap::new(read.width, read.height, read.pixels);
    map.map(Some).map_err(|e| wrong(e.to_string(), ""))
}

/// The key of a scene that has to change.
fn key(error: &HeadFileError, head: &HeadFile) -> &'static str {
    let path: Option<&PathBuf> = match error {
        HeadFileError::NoGroup { .. } => return "head.scalp_group",
        HeadFileError::NoChannel { .. } => return "head.scalp_colour",
        HeadFileError::Size { .. } | HeadFileError::Surface { .. } => return "head.mesh",
        HeadFileError::NoScalp { .. } => None,
        HeadFileError::Line { path, .. } | HeadFileError::Format { path, .. } => Some(path),
        HeadFileError::Read(error) => Some(error.path()),
    };
    match &head.scalp {
        _ if path == Some(&head.path) => "head.mesh",
        ScalpSource::Guess => "head.mesh",
        ScalpSource::Group(_) => "head.scalp_group",
        ScalpSource::Colour(_) => "head.scalp_colour",
        ScalpSource::Mask(_) => "head.scalp_mask",
        ScalpSource::Weights(_) => "head.scalp_weights",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn environment_errors_name_the_key_and_the_reason() {
        let read = |line: &str| {
            let text = format!("[light]\n{line}\n");
            let scene = Scene::parse("a", text, "".as_ref()).unwrap();
            environment_map(&scene, &Files::default()).unwrap_err().to_string()
        };
        let none = read("environment = 'nowhere.hdr'");
        assert!(none.contains("there is no file") && none.contains("a:2:15"), "{none}");
        let screen = read("environment = 'a.png'");
        assert!(screen.contains("`.hdr` and `.exr`") && screen.contains("cuts off"), "{screen}");
    }
}
