//! The data of the salon, and the messages that it shows.

use std::collections::VecDeque;
use std::sync::Arc;

use frisure::formats::contents::Contents;
use frisure::hairstyle::HairstyleSpec;
use frisure::hairstyle::styling::Operation;
use frisure::scene::{GroomFile, HeadSource, Scene, SceneError};
use frisure_engine::{AdoptionReport, Diagnostic, GuideData, Preview, SceneRef};

use super::controls::files_panel;
use super::cut_plane::{CutPlane, CutPreview};
use super::document::Document;
use super::exercise::Exercise;
use super::head_mesh::HeadMesh;
use super::jobs::{Effect, Jobs};
use super::orbit::Orbit;
use super::reference::Reference;
use super::scissors::Scissors;
use super::section::Section;
use super::selection::Selected;
use super::tour::Tour;
use crate::locale::tr;

/// The state of the salon. Outside this module it is read only; [`Salon::run`] changes it.
#[derive(Debug, Default)]
pub struct Salon {
    /// The edited document; `None` at the start.
    pub document: Option<Document>,
    /// The parsed current text of the document.
    pub scene: Option<Arc<ParsedScene>>,
    /// The hair that the viewport shows.
    pub(super) current: Option<CurrentHair>,
    /// The head below the hair.
    pub head: Option<Arc<HeadMesh>>,
    /// The key of hair that the engine refused, to avoid a second request.
    pub(super) refused: Option<(HairKey, Diagnostic)>,
    /// Opened files whose contents are still unknown.
    pub(super) pending_files: VecDeque<String>,
    /// The fit of the groom in the last message about it.
    pub(super) held: Option<AdoptionReport>,
    /// The hair that the next step applies to.
    pub selected: Selected,
    /// The text that the selection was made in.
    pub(super) selected_in: Option<String>,
    /// Other hair, shown beside the current one.
    pub comparison: Option<Comparison>,
    /// One hair that is shown alone.
    pub isolated: Option<IsolatedHair>,
    /// The active tool.
    pub tool: Tool,
    /// The cutting plane.
    pub plane: CutPlane,
    /// How scissors and clippers are set.
    pub scissors: Scissors,
    /// The tour, while somebody takes it.
    pub tour: Option<Tour>,
    /// The exercise, while somebody does one.
    pub exercise: Option<Exercise>,
    /// Whether each step is also done on the other side of the head.
    pub mirror: bool,
    pub(super) cut_preview: Option<(u64, CutPlane, Arc<CutPreview>)>,
    /// The brush.
    pub brush: Brush,
    /// The hair as it lay when the stroke of the comb began that is being drawn.
    pub(super) combing: Option<Arc<Preview>>,
    /// The sections of the current text.
    pub sections: Vec<Section>,
    /// The hair, and the one that is shown beside it, without hidden sections.
    pub(super) drawn: [Option<DrawnHair>; 2],
    /// The camera.
    pub orbit: Orbit,
    /// Whether the head turns slowly, as on a turntable.
    pub spins: bool,
    /// A photo to compare with.
    pub reference: Option<Reference>,
    pub(super) framed: bool,
    pub(super) gallery: bool,
    /// Messages for the user, the oldest first.
    pub messages: Vec<Message>,
    /// The partial final picture.
    pub partial_picture: Option<PartialPicture>,
    pub(super) progress: Option<(String, f32)>,
    pub(super) background_progress: Option<(String, f32)>,
    /// The text that was autosaved last.
    pub(super) autosaved: Option<String>,
    pub(super) changed_at: Option<f64>,
    /// An unsaved document that an earlier run autosaved, until the user decides about it.
    pub recoverable: Option<Document>,
    pub(super) jobs: Jobs,
    pub(super) version: u64,
    /// Mass of the hair before the running cut (kg).
    pub(super) mass_before: Option<f64>,
}

/// The active tool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Tool {
    /// Orbits the camera.
    #[default]
    Orbit,
    /// Selects the hair inside a drawn shape.
    Lasso,
    /// Selects the hair with roots under the brush.
    Brush,
    /// Moves the cutting plane.
    Cut,
    /// Parts hair along a stroke across the picture, into a section on each side.
    Part,
    /// Cuts the hair that a stroke across the picture crosses.
    Scissors,
    /// Lifts the hair under the brush off the skin, and cuts it there.
    Lift,
    /// Cuts the hair under the brush to the length of a guard.
    Clippers,
    /// Combs hair along a stroke.
    Comb,
    /// Picks one hair to show alone.
    Pick,
}

impl Tool {
    /// Whether it is used by painting over the scalp.
    #[must_use]
    pub fn is_brush(self) -> bool {
        matches!(self, Self::Brush | Self::Comb | Self::Lift | Self::Clippers)
    }
}

/// The brush of the tools that paint over the scalp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Its radius (m).
    pub radius: f64,
}

impl Default for Brush {
    fn default() -> Self {
        Self { radius: 0.02 }
    }
}

/// A parsed text of the document.
#[derive(Debug)]
pub struct ParsedScene {
    /// The scene.
    pub scene: Scene,
    /// The parameters that its hair is computed from.
    pub spec: HairstyleSpec,
}

/// Everything that the shape of the hair depends on: scenes with equal keys have the same hair.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct HairKey {
    spec: HairstyleSpec,
    steps: Vec<Operation>,
    head: HeadSource,
    pub(super) groom: Option<GroomFile>,
}

impl HairKey {
    pub(super) fn of(parsed: &ParsedScene) -> Self {
        Self {
            spec: parsed.spec.clone(),
            steps: parsed.scene.steps().to_vec(),
            head: parsed.scene.head.clone(),
            groom: parsed.scene.groom.clone(),
        }
    }
}

/// The hair that the viewport shows.
#[derive(Clone, Debug)]
pub(super) struct CurrentHair {
    /// `None` for hair of a file that may have changed.
    pub(super) key: Option<HairKey>,
    pub(super) hair: Arc<Preview>,
    pub(super) version: u64,
    /// Number of coarse responses to this text so far.
    pub(super) coarse_count: usize,
}

/// The hair without hidden sections.
#[derive(Clone, Debug)]
pub(super) struct DrawnHair {
    /// The version of the hair that it is part of.
    pub(super) of: u64,
    /// Whether each wisp is hidden.
    pub(super) hidden: Vec<bool>,
    pub(super) hair: Arc<Preview>,
    pub(super) version: u64,
}

/// What is shown beside the current hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compared {
    /// The text of an index in the document.
    Edit(usize),
    /// The goal of the exercise.
    Goal,
}

/// Other hair, shown beside the current one.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// What it is.
    pub of: Compared,
    /// The label of that edit, or the name of the goal.
    pub label: String,
    /// The hair; `None` until it is computed.
    pub hair: Option<Arc<Preview>>,
    /// Differs for each hair.
    pub version: u64,
}

/// One hair that is shown alone.
#[derive(Clone, Debug)]
pub struct IsolatedHair {
    /// Index of its wisp.
    pub wisp: usize,
    /// The hair; `None` until it is computed.
    pub hair: Option<Arc<GuideData>>,
    /// Version of the head of hair that it was taken from.
    pub(super) version: u64,
}

/// A partial final picture.
#[derive(Clone, Debug, PartialEq)]
pub struct PartialPicture {
    /// Width and height (pixels).
    pub size: [usize; 2],
    /// Red, green, blue, alpha (sRGB), rows from the top.
    pub rgba: Arc<Vec<u8>>,
    /// Noise (as a fraction of the display's range).
    pub noise: f32,
    /// Differs for each state of the picture.
    pub version: u64,
}

/// A message for the user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Message {
    /// The message.
    pub text: String,
    /// A hint for the user; may be empty.
    pub hint: String,
    /// Whether it reports an error.
    pub is_error: bool,
}

/// Maximum number of messages.
const MAX_MESSAGES: usize = 6;

impl Salon {
    /// A salon with its gallery open.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The hair that the viewport shows, with a number that differs for each.
    #[must_use]
    pub fn preview(&self) -> Option<(&Arc<Preview>, u64)> {
        self.current.as_ref().map(|current| (&current.hair, current.version))
    }

    /// Whether the gallery is open.
    #[must_use]
    pub fn is_gallery(&self) -> bool {
        self.gallery || self.document.is_none()
    }

    /// Whether the user drags a slider or the comb.
    #[must_use]
    pub fn is_dragging(&self) -> bool {
        self.document.as_ref().is_some_and(Document::is_draft)
    }

    /// Progress of the job for the shown hair: its stage and the completed fraction.
    #[must_use]
    pub fn progress(&self) -> Option<(&str, f32)> {
        self.jobs.hair.as_ref()?;
        self.progress.as_ref().map(|(stage, done)| (stage.as_str(), *done))
    }

    /// Progress of the background job (stage and completed fraction), and the number of jobs behind it.
    #[must_use]
    pub fn background(&self) -> Option<(&str, f32, usize)> {
        self.jobs.background.as_ref()?;
        let (stage, done) = self.background_progress.as_ref().map_or(("", 0.0), |(s, d)| (s, *d));
        Some((stage, done, self.jobs.waiting()))
    }

    /// Whether a job is running or about to start.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        let waits = !self.pending_files.is_empty() || self.changed_at.is_some();
        self.jobs.hair.is_some() || self.jobs.background.is_some() || waits
    }

    /// Returns the queued effects, in order; each is returned once.
    pub fn effects(&mut self) -> Vec<Effect> {
        self.jobs.effects.drain(..).collect()
    }

    /// Whether head and hair are from files.
    #[must_use]
    pub fn files(&self) -> Contents {
        self.scene.as_ref().map_or(Contents::default(), |parsed| Contents {
            head: matches!(parsed.scene.head, HeadSource::Mesh(_)),
            groom: parsed.scene.groom.is_some(),
        })
    }

    /// Adds a message.
    pub fn notify(&mut self, text: impl Into<String>, hint: impl Into<String>, is_error: bool) {
        let message = Message { text: text.into(), hint: hint.into(), is_error };
        if self.messages.last() != Some(&message) {
            self.messages.push(message);
        }
        let surplus = self.messages.len().saturating_sub(MAX_MESSAGES);
        self.messages.drain(..surplus);
    }

    pub(super) fn report_error(&mut self, error: &Diagnostic) {
        let line = if error.line > 0 { tr!("line", line = error.line) } else { String::new() };
        let key = if error.key.is_empty() { String::new() } else { format!("{}: ", error.key) };
        self.notify(format!("{line}{key}{}", error.problem), hint_for(error), true);
    }

    /// The scene with its current text, for a request.
    pub(super) fn scene_ref(&self) -> Option<SceneRef> {
        let (document, parsed) = (self.document.as_ref()?, self.scene.as_ref()?);
        Some(scene_ref(document, document.text(), parsed))
    }

    /// The text without the draft of what is dragged.
    pub(super) fn base(&self) -> Option<&str> {
        let document = self.document.as_ref()?;
        Some(&document.edits()[document.at()].text)
    }
}

/// A text of a document, for a request.
pub(super) fn scene_ref(document: &Document, text: &str, parsed: &ParsedScene) -> SceneRef {
    SceneRef {
        name: document.name().to_owned(),
        text: text.to_owned(),
        folder: document.folder().display().to_string(),
        done: parsed.scene.steps().len(),
    }
}

/// Parses a text of a document.
pub(super) fn parse(document: &Document, text: &str) -> Result<ParsedScene, SceneError> {
    let scene = Scene::parse(document.name(), text, document.folder())?;
    let spec = scene.hairstyle_spec()?;
    Ok(ParsedScene { scene, spec })
}

/// A hint for an error in a file, without the scene keys of the engine's hint.
fn hint_for(error: &Diagnostic) -> String {
    let is_missing = error.problem.contains("there is no file");
    match error.key.as_str() {
        "groom.file" | "head.mesh" if is_missing => {
            tr!("drop-the-file")
        }
        "groom.file" if error.line > 0 && !error.hint.is_empty() => {
            tr!("choose-unit-and-axis", panel = &*files_panel())
        }
        "head.mesh" if !error.hint.is_empty() => {
            tr!("choose-unit", panel = &*files_panel())
        }
        _ => error.hint.clone(),
    }
}
