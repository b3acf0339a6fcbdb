//! The commands of the salon: everything that a user can do.

use std::path::PathBuf;

use frisure::hairstyle::Place;
use frisure::hairstyle::styling::Operation;
use glam::DVec3;

use super::combing::CombStroke;
use super::cut_plane::CutPlane;
use super::jobs::Destination;
use super::rendering::RenderTask;
use super::salon::Tool;
use super::scissors::{Scissors, Snip};
use super::selection::SelectMode;
use crate::locale::Locale;

/// A command of the user.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Opens the scene of a card of the gallery, by its name.
    Begin(String),
    /// Opens the text of a scene.
    Open {
        /// Its file, if it has one.
        path: Option<PathBuf>,
        /// Its name.
        name: String,
        /// The text.
        text: String,
    },
    /// Opens or closes the gallery.
    Gallery(bool),
    /// Drags the slider of a key to a value in its unit.
    Drag(&'static str, f64),
    /// Ends the drag of a slider.
    EndDrag,
    /// Sets the key of a slider to a value in its unit.
    Set(&'static str, f64),
    /// Sets the key of a choice to one of its options, as TOML.
    SetOption(&'static str, String),
    /// Removes a key, so that its default applies.
    Reset(&'static str),
    /// Opens a file by its path, or the name under which the engine keeps it; a head, a groom, or both.
    File(String),
    /// Tries refused hair again, because a missing file may be there now.
    Retry,
    /// Uses a mesh (a path) as the head; `None` is the mannequin.
    Head(Option<String>),
    /// Gives the built-in person the face of a seed.
    Face(u32),
    /// Uses the hair of a file (a path); `None` is the scene's own.
    Groom(Option<String>),
    /// Activates a tool.
    Take(Tool),
    /// Selects a part of the scalp.
    Select(Place, SelectMode),
    /// Selects all hair.
    SelectAll,
    /// Selects the hair that is not selected.
    InvertSelection,
    /// Selects the hair inside a polygon in the picture (−1 to 1, right and up).
    DrawLasso {
        /// Its corners.
        polygon: Vec<[f64; 2]>,
        /// Width over height of the picture.
        aspect: f64,
        /// The combination with the selection.
        mode: SelectMode,
    },
    /// Selects the hair with roots near positions on the skin (m).
    Paint(Vec<DVec3>, SelectMode),
    /// Sets the radius of the brush (m).
    BrushSize(f64),
    /// Applies an operation to the selected hair.
    Apply(Operation),
    /// Wets the selected hair, or dries it if it is wet.
    ToggleWet,
    /// Combs the selected hair beneath a stroke that is still drawn: the next one, or [`Self::Comb`], takes its place.
    DragComb(CombStroke),
    /// Combs the selected hair beneath a stroke.
    Comb(CombStroke),
    /// Moves the cutting plane.
    Plane(CutPlane),
    /// Sets scissors and clippers.
    Scissors(Scissors),
    /// Cuts the selected hair at the plane.
    Cut,
    /// Cuts the selected hair that a stroke across the picture crosses.
    Snip(Snip),
    /// Lifts selected hair with roots near positions on the skin (m), and cuts it there.
    Lift(Vec<DVec3>),
    /// Cuts selected hair with roots near positions on the skin (m) to the guard of the clippers.
    Clip(Vec<DVec3>),
    /// Makes a section of the selected hair.
    AddSection,
    /// Parts the selected hair along a stroke across the picture, into a section on each side.
    Part(Snip),
    /// Selects a section by its index.
    SelectSection(usize, SelectMode),
    /// Gives a section another name.
    RenameSection(usize, String),
    /// Hides a section, which steps leave as it is then, or shows it.
    HideSection(usize, bool),
    /// Locks a section, so that steps leave it as it is, or unlocks it.
    LockSection(usize, bool),
    /// Removes a section from the list; its hair stays.
    RemoveSection(usize),
    /// Begins the tour.
    BeginTour,
    /// Goes to the next step of the tour, or ends it after the last.
    NextOfTour,
    /// Ends the tour.
    EndTour,
    /// Begins an exercise of the gallery by its name, or one whose goal is the scene of a link.
    BeginExercise(String),
    /// Shows the goal of the exercise beside the hair, or no longer.
    CompareGoal,
    /// Marks hair that is not at its goal, or no longer.
    ToggleGoalMarks,
    /// Goes back to the beginning of the exercise.
    RestartExercise,
    /// Shows the solution of the exercise step by step, or stops.
    ToggleReplay,
    /// Ends the exercise.
    EndExercise,
    /// Does the next steps on both sides of the head, or no longer.
    ToggleMirror,
    /// Speaks a language from now on.
    Speak(Locale),
    /// Undoes an edit.
    Undo,
    /// Redoes an edit.
    Redo,
    /// Goes to one of the document's texts.
    GoTo(usize),
    /// Shows one hair alone; `None` shows all.
    Isolate(Option<usize>),
    /// Shows the hair of one of the document's texts beside the current one; `None` ends it.
    Compare(Option<usize>),
    /// Starts or ends the comparison with the text before the current one.
    ToggleCompare,
    /// Orbits the camera, by angles (rad).
    Turn(f64, f64),
    /// Turns the head slowly, or stops.
    ToggleSpin,
    /// Shows a photo (PNG or JPEG) of a name to compare with.
    Refer(String, Vec<u8>),
    /// Lays the photo over the picture with an opacity (0 to 1), or puts it beside.
    ReferOver(Option<f32>),
    /// Removes the photo.
    EndReference,
    /// Pans the camera, by fractions of the picture's height.
    Pan(f64, f64),
    /// Zooms by a factor.
    Zoom(f64),
    /// Looks from an azimuth and an elevation (rad).
    LookFrom(f64, f64),
    /// Frames everything in a picture of an aspect ratio.
    Frame(f64),
    /// Makes the view the scene's camera.
    KeepView,
    /// Writes the scene.
    Save(Destination),
    /// Writes the hair in the format of the extension.
    Export(Destination),
    /// Renders a final picture, or a film around the head.
    Render(RenderTask, Destination),
    /// Cancels the background jobs.
    Stop,
    /// Opens the recovered document, or deletes it.
    Recover(bool),
    /// Removes a message.
    Dismiss(usize),
}
