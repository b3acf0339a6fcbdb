//! A scene whose every value was understood.

use std::path::{Path, PathBuf};

use frisure_hairstyle::styling::{Operation, StyleError};
use frisure_hairstyle::{HairstyleSpec, InvalidSpec};
use frisure_look::{CameraSpec, LightSpec, LookSpec, ToneCurve};
use frisure_rod::{Branch, InvalidQuantity, Options, Rod, StrainProfile};

use frisure_files as files;
use frisure_files::frame::FrameChoice;
use frisure_files::head::HeadFile;

use crate::error::{Fault, SceneError};
use crate::source::Source;
use crate::{blame, resolve, step};

/// Largest scene that is read (bytes).
pub const MAX_SIZE: u64 = 16 << 20;

/// A scene whose every value was understood; numbers are SI.
///
/// What a number may be depends on what it is for: [`Self::hairstyle_spec`] and
/// [`Self::single_hair`] check the ranges.
#[derive(Clone, Debug)]
pub struct Scene {
    /// A name for people; empty if none is given.
    pub name: String,
    /// Name of the hair type that the scene starts from.
    pub hair_type: &'static str,
    /// The head, with paths made relative to the scene's folder.
    pub head: HeadSource,
    /// Hair of another program, with paths made relative to the scene's folder.
    pub groom: Option<GroomFile>,
    /// Materials; those not given are the renderer's own.
    pub look: LookSpec,
    /// Direction and lens of the camera.
    pub camera: CameraSpec,
    /// Lights.
    pub light: LightSpec,
    /// The file of an environment map, made relative to the scene's folder.
    pub environment: Option<PathBuf>,
    /// The picture's size.
    pub output: Output,
    pub(crate) spec: HairstyleSpec,
    pub(crate) steps: Vec<Operation>,
    pub(crate) along: Option<StrainProfile>,
    pub(crate) frame: [glam::DVec3; 3],
    pub(crate) branch: Branch,
    pub(crate) source: Source,
}

/// One hair of a scene, and how to compute it.
#[derive(Clone, Debug, PartialEq)]
pub struct SingleHair {
    /// The rod; its root is at the origin.
    pub rod: Rod,
    /// Resolution, element and branch.
    pub options: Options,
}

/// The head of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum HeadSource {
    /// The built-in mannequin.
    Mannequin,
    /// A mesh.
    Mesh(HeadFile),
}

/// Hair of another program.
#[derive(Clone, Debug, PartialEq)]
pub struct GroomFile {
    /// The groom.
    pub path: PathBuf,
    /// Unit and axes, where the scene says them.
    pub frame: FrameChoice,
    /// How many strands become guides at most.
    pub guides: usize,
}

/// The picture's size, and how its light is shown.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Output {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Samples per pixel of a preview, across and down.
    pub samples: usize,
    /// Stops by which it is lighter than the light.
    pub exposure: f64,
    /// Tone curve.
    pub tone: ToneCurve,
}

impl Scene {
    /// Reads a scene file.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn read(path: &Path) -> Result<Self, SceneError> {
        let text = files::read_text(path, MAX_SIZE, "a scene")?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::parse(&path.display().to_string(), text, folder)
    }

    /// Understands the text of a scene; `name` is what errors call it, and paths in it are relative
    /// to `folder`.
    ///
    /// # Errors
    /// [`SceneError`].
    pub fn parse(name: &str, text: impl Into<String>, folder: &Path) -> Result<Self, SceneError> {
        let text = without_mark(text.into());
        resolve::scene(Source { name: name.to_owned(), text }, folder)
    }

    /// The whole head of hair that the scene describes, with every number in range.
    ///
    /// # Errors
    /// [`SceneError`] for a number out of range, and for natural strains along a hair: a head's
    /// wisps vary by chance, not as given.
    pub fn hairstyle_spec(&self) -> Result<HairstyleSpec, SceneError> {
        resolve::hairstyle(self)
    }

    /// What is done to the hair, in this order.
    #[must_use]
    pub fn steps(&self) -> &[Operation] {
        &self.steps
    }

    /// The text that the scene was read from.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.source.text
    }

    /// Why a step, counted from 0, cannot be done, at the step or at the key in it that says what
    /// cannot be.
    #[must_use]
    pub fn step_fault(&self, index: usize, error: &StyleError) -> SceneError {
        let operation = self.steps.get(index).map_or("", Operation::name);
        step::fault(index, operation, error, &self.source)
    }

    /// The single hair that the scene describes, without variation.
    ///
    /// # Errors
    /// [`SceneError`] for a number out of range.
    pub fn single_hair(&self) -> Result<SingleHair, SceneError> {
        resolve::single_hair(self)
    }

    /// An error found later in what `key` says, such as a mesh at `head.mesh` that is no head;
    /// `hint` may be empty.
    #[must_use]
    pub fn fault(
        &self,
        key: &str,
        problem: impl Into<String>,
        hint: impl Into<String>,
    ) -> SceneError {
        let span = self.source.locate(key);
        let value = self.source.slice(span.clone()).to_owned();
        Fault::new(problem).key(key).value(value).hint(hint).at(&self.source, span)
    }

    /// A quantity that was refused later, at the key that it comes from.
    #[must_use]
    pub fn blame(&self, error: &InvalidQuantity) -> SceneError {
        blame::blame(error, &self.source)
    }

    /// A number that was refused later, such as one that only a head shows to be too large, at the
    /// key that it comes from.
    #[must_use]
    pub fn out_of_range(&self, error: &InvalidSpec) -> SceneError {
        blame::out_of_range(error, &self.source)
    }
}

/// A text without the byte order mark that editors on some systems begin it with; TOML has none.
pub(crate) fn without_mark(text: String) -> String {
    text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text)
}
