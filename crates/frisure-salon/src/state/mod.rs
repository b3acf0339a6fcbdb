//! The state of the salon, without a window: the document, the selection, the tools and the jobs.
//!
//! The document is the text of a scene. Every [`Command`] edits that text or the view, and the hair follows
//! from the text. [`Salon::run`] executes commands and [`Salon::receive`] takes responses of the engine; both
//! queue [`Effect`]s for the program around them. Nothing here uses a toolkit, a thread or a clock, so tests
//! can run whole sessions, and the window, the page and the keyboard use the same commands.

mod combing;
mod command;
mod controls;
mod cut_plane;
mod document;
mod editing;
mod exercise;
mod exercising;
mod files;
mod gallery;
mod hair;
mod head_mesh;
mod jobs;
mod orbit;
mod reference;
mod rendering;
mod salon;
mod saving;
mod scissors;
mod section;
mod sectioning;
mod selection;
mod sharing;
mod styling;
mod tour;
mod tour_steps;
mod update;

pub use combing::{CombPlace, CombStroke};
pub use command::Command;
pub use controls::{CHOICES, CONTROLS, Choice, Control, choice_of, control_of, panel_title};
pub use cut_plane::{CutPlane, CutPreview};
pub use document::{Document, Edit};
pub use exercise::{EXERCISES, Exercise, ExerciseCard, Nearness, Way};
pub use gallery::{Card, SCENES, TYPES, card};
pub use hair::Badge;
pub use head_mesh::{HeadMesh, strands_of};
pub use jobs::{Destination, Effect, FORMATS, JobId, Queue, Save};
pub use orbit::{Orbit, VIEWS};
pub use reference::Reference;
pub use rendering::RenderTask;
pub use salon::{
    Compared, Comparison, IsolatedHair, Message, ParsedScene, PartialPicture, Salon, Tool,
};
pub use scissors::{CutHold, Scissors, Snip};
pub use section::Section;
pub use selection::{PLACES, SelectMode, Selected};
pub use sharing::code;
pub use styling::comb;
pub use tour::Tour;
pub use tour_steps::{TOUR, TourStep};
