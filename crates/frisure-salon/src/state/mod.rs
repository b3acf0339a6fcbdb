//! The salon without a window: what is edited, what is chosen, what is being computed.
//!
//! Whatever a person does is a [`Command`]; whatever has to be done outside is an [`Errand`]; what comes
//! back is an answer. Nothing here knows a toolkit, a thread or a clock, so that tests drive whole
//! sessions, and the window, the page and the keyboard do the same as they.
//!
//! The document is the text of a scene. Every command edits that text, and the hair follows from it.

mod autosave;
mod command;
mod controls;
mod cutting;
mod desk;
mod document;
mod files;
mod gallery;
mod hair;
mod keeping;
mod orbit;
mod picture;
mod selecting;
mod touch;

use std::collections::VecDeque;
use std::sync::Arc;

use frisure::hairstyle::HairstyleSpec;
use frisure::scene::Scene;
use frisure_engine::{AdoptionReport, Diagnostic, GuideData, Preview, Response, SceneRef};

pub use command::{Command, Growing, Tool};
pub use controls::{CONTROLS, Choice, Control, Panel, choices, control_of};
pub use cutting::{Falling, Hold, Plane};
pub use desk::{Errand, Lane, Ticket};
pub use document::{Document, Edit};
pub use files::FILES_PANEL;
pub use gallery::{Card, SCENES, TYPES, card};
pub use hair::Badge;
pub use keeping::{Destination, FORMATS, Save};
pub use orbit::{Orbit, VIEWS};
pub use picture::{Exposed, Shot};
pub use selecting::{Chosen, Mode, PLACES};
pub use touch::HeadMesh;

use desk::{Desk, Purpose};
use hair::HairKey;

/// The salon.
#[derive(Debug)]
pub struct Salon {
    /// What is edited; nothing yet at the start.
    document: Option<Document>,
    scene: Option<Arc<Understood>>,
    /// What the hair that is seen belongs to.
    shown: Option<Seen>,
    /// The head that it grows on.
    head: Option<Arc<HeadMesh>>,
    /// A scene whose hair cannot be, so that it is not asked for again and again.
    refused: Option<(HairKey, Diagnostic)>,
    /// Files that were opened, and are not known yet.
    offered: VecDeque<String>,
    /// How well the groom was held, as it was told last.
    held: Option<AdoptionReport>,
    chosen: Chosen,
    /// The text in which that was chosen.
    chosen_in: Option<String>,
    /// The hair as it was, beside it as it is.
    compared: Option<Compared>,
    /// One hair on its own.
    alone: Option<Alone>,
    /// What the hand holds.
    tool: Tool,
    plane: Plane,
    falling: Option<(u64, Plane, Arc<Falling>)>,
    /// Radius of the brush (m).
    brush: f64,
    orbit: Orbit,
    framed: bool,
    /// Whether the gallery is open.
    gallery: bool,
    messages: Vec<Message>,
    exposed: Option<Exposed>,
    progress: Option<(String, f32)>,
    aside_progress: Option<(String, f32)>,
    kept: Option<String>,
    changed_at: Option<f64>,
    recoverable: Option<Document>,
    desk: Desk,
    version: u64,
    /// Mass of the hair before a cut that is under way (kg).
    mass_before: Option<f64>,
}

/// The current text, understood.
#[derive(Debug)]
pub struct Understood {
    /// The scene.
    pub scene: Scene,
    /// What its hair is computed from.
    pub spec: HairstyleSpec,
}

/// Hair that is seen.
#[derive(Clone, Debug)]
struct Seen {
    /// None for hair of a file that may be another by now.
    key: Option<HairKey>,
    hair: Arc<Preview>,
    version: u64,
    /// How many coarse answers to this text there were.
    rough: usize,
}

/// Hair to compare with.
#[derive(Clone, Debug)]
pub struct Compared {
    /// Which of the document's texts.
    pub edit: usize,
    /// What it is called.
    pub label: String,
    /// The hair, once it is there.
    pub hair: Option<Arc<Preview>>,
    /// Differs for each hair.
    pub version: u64,
}

/// One hair that is looked at alone.
#[derive(Clone, Debug)]
pub struct Alone {
    /// Which wisp it leads.
    pub wisp: usize,
    /// The hair, once it is there.
    pub hair: Option<Arc<GuideData>>,
    /// Of which hair that is seen it was told.
    version: u64,
}

/// Something to tell.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Message {
    /// What.
    pub text: String,
    /// What to do about it; may be empty.
    pub hint: String,
    /// Whether something went wrong.
    pub is_error: bool,
}

impl Default for Salon {
    fn default() -> Self {
        Self {
            document: None,
            scene: None,
            shown: None,
            head: None,
            refused: None,
            offered: VecDeque::new(),
            held: None,
            chosen: Chosen::default(),
            chosen_in: None,
            compared: None,
            alone: None,
            tool: Tool::default(),
            plane: Plane::level(-0.1),
            falling: None,
            brush: 0.02,
            orbit: Orbit::default(),
            framed: false,
            gallery: true,
            messages: Vec::new(),
            exposed: None,
            progress: None,
            aside_progress: None,
            kept: None,
            changed_at: None,
            recoverable: None,
            desk: Desk::default(),
            version: 0,
            mass_before: None,
        }
    }
}

/// Most messages that are kept.
const MESSAGES: usize = 6;

impl Salon {
    /// A salon with its gallery open.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Takes an answer to an order.
    pub fn receive(&mut self, ticket: Ticket, answer: Response) {
        match self.desk.lane_of(ticket) {
            Some(Lane::Hair) => self.receive_hair(answer),
            Some(Lane::Aside) => self.receive_aside(answer),
            // Of work that was given up.
            None => {}
        }
        self.schedule();
    }

    /// Lets time pass: `now` in seconds from any start.
    pub fn tick(&mut self, now: f64) {
        self.keep_now_and_then(now);
        self.schedule();
    }

    /// The workers are other ones, who know nothing of what was under way: it is ordered anew.
    pub fn begin_again(&mut self) {
        self.desk.forget();
        (self.progress, self.aside_progress) = (None, None);
        self.schedule();
    }

    /// What is to be done outside, in order; each once.
    pub fn errands(&mut self) -> Vec<Errand> {
        self.desk.errands.drain(..).collect()
    }

    /// What is edited.
    #[must_use]
    pub fn document(&self) -> Option<&Document> {
        self.document.as_ref()
    }

    /// The current text, understood.
    #[must_use]
    pub fn scene(&self) -> Option<&Arc<Understood>> {
        self.scene.as_ref()
    }

    /// The hair that is seen, with a number that differs for each.
    #[must_use]
    pub fn shown(&self) -> Option<(&Arc<Preview>, u64)> {
        self.shown.as_ref().map(|seen| (&seen.hair, seen.version))
    }

    /// The head that it grows on.
    #[must_use]
    pub fn head(&self) -> Option<&Arc<HeadMesh>> {
        self.head.as_ref()
    }

    /// What the next step is about.
    #[must_use]
    pub fn chosen(&self) -> &Chosen {
        &self.chosen
    }

    /// The hair as it was, if it is to be seen beside.
    #[must_use]
    pub fn compared(&self) -> Option<&Compared> {
        self.compared.as_ref()
    }

    /// The hair that is looked at alone.
    #[must_use]
    pub fn alone(&self) -> Option<&Alone> {
        self.alone.as_ref()
    }

    /// What the hand holds.
    #[must_use]
    pub fn tool(&self) -> Tool {
        self.tool
    }

    /// The cutting plane.
    #[must_use]
    pub fn plane(&self) -> &Plane {
        &self.plane
    }

    /// Radius of the brush (m).
    #[must_use]
    pub fn brush(&self) -> f64 {
        self.brush
    }

    /// The camera.
    #[must_use]
    pub fn orbit(&self) -> &Orbit {
        &self.orbit
    }

    /// Whether the gallery is open.
    #[must_use]
    pub fn is_gallery(&self) -> bool {
        self.gallery || self.document.is_none()
    }

    /// What is to be told, the oldest first.
    #[must_use]
    pub fn messages(&self) -> &[Message] {
        &self.messages
    }

    /// The final picture as it is so far.
    #[must_use]
    pub fn exposed(&self) -> Option<&Exposed> {
        self.exposed.as_ref()
    }

    /// How far the hair is: what is being done, and the part that is done.
    #[must_use]
    pub fn progress(&self) -> Option<(&str, f32)> {
        self.desk.hair.as_ref()?;
        self.progress.as_ref().map(|(stage, done)| (stage.as_str(), *done))
    }

    /// How far the work beside is, and how many orders wait for it.
    #[must_use]
    pub fn aside(&self) -> Option<(&str, f32, usize)> {
        self.desk.aside.as_ref()?;
        let (stage, done) = self.aside_progress.as_ref().map_or(("", 0.0), |(s, d)| (s, *d));
        Some((stage, done, self.desk.waiting()))
    }

    /// What a crash left, if nobody has decided about it.
    #[must_use]
    pub fn recoverable(&self) -> Option<&Document> {
        self.recoverable.as_ref()
    }

    /// Whether anything is under way or about to be.
    #[must_use]
    pub fn is_busy(&self) -> bool {
        let waits = !self.offered.is_empty() || self.changed_at.is_some();
        self.desk.hair.is_some() || self.desk.aside.is_some() || waits
    }

    /// Tells something.
    pub fn tell(&mut self, text: impl Into<String>, hint: impl Into<String>, is_error: bool) {
        let message = Message { text: text.into(), hint: hint.into(), is_error };
        if self.messages.last() != Some(&message) {
            self.messages.push(message);
        }
        let surplus = self.messages.len().saturating_sub(MESSAGES);
        self.messages.drain(..surplus);
    }

    fn complain(&mut self, refusal: &Diagnostic) {
        let place = match refusal.line {
            0 => String::new(),
            line => format!("line {line}: "),
        };
        let key = match refusal.key.as_str() {
            "" => String::new(),
            key => format!("{key}: "),
        };
        let hint = self.hint_for(refusal);
        self.tell(format!("{place}{key}{}", refusal.problem), hint, true);
    }

    /// The scene as it is now, for an order.
    fn asked(&self) -> Option<SceneRef> {
        let (document, understood) = (self.document.as_ref()?, self.scene.as_ref()?);
        Some(asked(document, document.text(), understood.scene.steps().len()))
    }
}

fn asked(document: &Document, text: &str, done: usize) -> SceneRef {
    SceneRef {
        name: document.name().to_owned(),
        text: text.to_owned(),
        folder: document.folder().display().to_string(),
        done,
    }
}
