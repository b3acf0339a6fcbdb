//! A scene as it is read: plain data.

use std::path::PathBuf;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{Operation, Selection};
use frisure_hairstyle::{HairstyleSpec, RegionStyle};
use frisure_look::{CameraSpec, LightSpec, LookSpec, ToneCurve};
use frisure_rod::{Branch, Options, Rod, StrainProfile};

use frisure_files::frame::FrameChoice;
use frisure_files::head::HeadFile;

use crate::keywords::MANNEQUIN;
use crate::placement::Placement;
use crate::source::Source;

/// Largest scene that is read (bytes).
pub const MAX_SIZE: u64 = 16 << 20;

/// A scene as it is read; numbers are in SI units.
///
/// The range of a number depends on its use: [`Self::hairstyle_spec`] and
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
    /// Named parts of the hair for the salon, in their order.
    pub sections: Vec<Section>,
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

/// A named part of the hair, which the salon works on by itself. It changes neither hair nor pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its name; no other section has it.
    pub name: String,
    /// Its wisps.
    pub selection: Selection,
    /// Whether the salon does not show it.
    pub hidden: bool,
    /// Whether steps that are made in the salon leave it as it is.
    pub locked: bool,
}

/// The head of a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum HeadSource {
    /// The built-in mannequin.
    Mannequin,
    /// A built-in head of a person.
    Person {
        /// Its name.
        name: &'static str,
        /// The seed of its face; 0 for that of the model.
        face: u32,
    },
    /// A mesh.
    Mesh(HeadFile),
}

impl HeadSource {
    /// The built-in head of a name; `None`, if no head has it.
    #[must_use]
    pub fn built_in(name: &str) -> Option<Self> {
        let name = Head::names().find(|known| *known == name)?;
        Some(if name == MANNEQUIN { Self::Mannequin } else { Self::Person { name, face: 0 } })
    }
}

/// Hair of another program.
#[derive(Clone, Debug, PartialEq)]
pub struct GroomFile {
    /// The groom.
    pub path: PathBuf,
    /// Unit and axes, where the scene gives them.
    pub frame: FrameChoice,
    /// The head that it was made on, where that is not the head of the scene.
    pub head: Option<HeadSource>,
    /// Where it lies on the head that it was made on.
    pub placement: Placement,
    /// How many strands become guides at most.
    pub guides: usize,
}

impl GroomFile {
    /// A groom that was made on the head of the scene, with the unit and axes that its file states, and the default number of
    /// guides.
    #[must_use]
    pub fn new(path: PathBuf) -> Self {
        let (frame, placement) = (FrameChoice::default(), Placement::default());
        Self { path, frame, head: None, placement, guides: 300 }
    }
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
    /// Whether pictures show what holds the hair: rollers, ties, pins and clips.
    pub accessories: bool,
}

impl Default for Output {
    fn default() -> Self {
        let tone = ToneCurve::default();
        Self { width: 900, height: 1100, samples: 4, exposure: 0.0, tone, accessories: true }
    }
}

impl Scene {
    /// The styles of regions, as they are written.
    #[must_use]
    pub fn regions(&self) -> &[RegionStyle] {
        &self.spec.regions
    }

    /// The operations of the steps, in order.
    #[must_use]
    pub fn steps(&self) -> &[Operation] {
        &self.steps
    }

    /// Whether the scene itself has an accuracy (`equilibrium.accuracy`), not the default one.
    #[must_use]
    pub fn requests_accuracy(&self) -> bool {
        // The text was read without errors before.
        self.source.document().is_ok_and(|document| {
            let settings = document.get_ref().get("equilibrium");
            settings.is_some_and(|settings| settings.get_ref().get("accuracy").is_some())
        })
    }

    /// The text that the scene was read from.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.source.text
    }
}
