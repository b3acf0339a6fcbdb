//! The entry points of the salon: commands, responses of the engine, and time.

use frisure::formats::contents::Contents;
use frisure_engine::Response;

use super::command::Command;
use super::document::Document;
use super::jobs::{Effect, JobId, Queue};
use super::reference::Reference;
use super::salon::{IsolatedHair, Salon};
use super::selection::Selected;
use crate::locale::{self, Locale, tr};

impl Salon {
    /// Executes a command.
    pub fn run(&mut self, command: Command) {
        match command {
            Command::Begin(name) => self.begin(&name),
            Command::Open { path, name, text } => {
                self.open_document(Document::new(name, path, tr!("opened"), text));
            }
            Command::Gallery(open) => self.gallery = open,
            Command::Drag(key, value) => self.set(key, value, true),
            Command::EndDrag => self.end_drag(),
            Command::Set(key, value) => self.set(key, value, false),
            Command::SetOption(key, value) => self.set_option(key, &value),
            Command::Reset(key) => self.reset(key),
            Command::File(path) => self.queue_file(path),
            Command::Retry => self.retry(),
            Command::Head(path) => self.set_file(path, Contents { head: true, groom: false }),
            Command::Face(face) => self.set_face(face),
            Command::Groom(path) => self.set_file(path, Contents { head: false, groom: true }),
            Command::Take(tool) => self.take_tool(tool),
            Command::BrushSize(radius) => self.set_brush(radius),
            Command::Undo => self.go_to(|at| at.checked_sub(1)),
            Command::Redo => self.go_to(|at| Some(at + 1)),
            Command::GoTo(to) => self.go_to(|_| Some(to)),
            Command::Isolate(wisp) => {
                self.isolated = wisp.map(|wisp| IsolatedHair { wisp, hair: None, version: 0 });
            }
            Command::Compare(edit) => self.compare(edit),
            Command::ToggleCompare => {
                let at = self.document.as_ref().map_or(0, Document::at);
                self.compare(self.comparison.is_none().then(|| at.saturating_sub(1)));
            }
            Command::Turn(right, up) => self.orbit.turn(right, up),
            Command::ToggleSpin => self.spins = !self.spins,
            Command::Refer(name, bytes) => self.refer(name, &bytes),
            Command::ReferOver(over) => self.refer_over(over),
            Command::EndReference => self.reference = None,
            Command::Pan(right, up) => self.orbit.pan(right, up),
            Command::Zoom(factor) => self.orbit.zoom(factor),
            Command::LookFrom(azimuth, elevation) => self.orbit.look_from(azimuth, elevation),
            Command::Frame(aspect) => self.frame_all(aspect),
            Command::KeepView => self.keep_view(),
            Command::Save(to) => self.save(to),
            Command::Export(to) => self.export(to),
            Command::Render(task, to) => self.render(task, to),
            Command::Stop => self.jobs.cancel_background(),
            Command::Recover(wanted) => self.recover(wanted),
            Command::Dismiss(index) => self.dismiss(index),
            Command::Plane(plane) => self.move_plane(plane),
            Command::Scissors(scissors) => self.scissors = scissors.clean(),
            Command::BeginTour => self.begin_tour(),
            Command::NextOfTour => self.next_of_tour(),
            Command::EndTour => self.tour = None,
            Command::AddSection
            | Command::Part(_)
            | Command::SelectSection(..)
            | Command::RenameSection(..)
            | Command::HideSection(..)
            | Command::LockSection(..)
            | Command::RemoveSection(_) => self.section(command),
            Command::BeginExercise(_)
            | Command::CompareGoal
            | Command::ToggleGoalMarks
            | Command::RestartExercise
            | Command::ToggleReplay
            | Command::EndExercise => self.practise(command),
            Command::Speak(locale) => self.speak(locale),
            Command::ToggleMirror => self.mirror = !self.mirror,
            Command::Apply(_)
            | Command::ToggleWet
            | Command::DragComb(_)
            | Command::Comb(_)
            | Command::Cut
            | Command::Snip(_)
            | Command::Lift(_)
            | Command::Clip(_) => self.style(command),
            selecting => self.select(selecting),
        }
        self.schedule();
    }

    /// Sets the language. Labels of edits stay in the language in which they were made.
    fn speak(&mut self, locale: Locale) {
        locale::set(locale);
        if self.selected.is_everything() {
            self.selected = Selected::default();
        }
        self.jobs.effects.push_back(Effect::KeepLanguage(locale));
    }

    /// Removes a message.
    fn dismiss(&mut self, index: usize) {
        if index < self.messages.len() {
            self.messages.remove(index);
        }
    }

    /// Lays the photo to compare with over the picture, or beside it.
    fn refer_over(&mut self, over: Option<f32>) {
        if let Some(reference) = &mut self.reference {
            reference.over = over.map(|opacity| opacity.clamp(0.0, 1.0));
        }
    }

    /// Shows a photo to compare with.
    fn refer(&mut self, name: String, bytes: &[u8]) {
        self.version += 1;
        match Reference::decode(name, bytes, self.version) {
            Ok(reference) => self.reference = Some(reference),
            Err(error) => self.notify(error.to_string(), tr!("reference.hint"), true),
        }
    }

    /// Takes a response of the engine.
    pub fn receive(&mut self, job: JobId, response: Response) {
        match self.jobs.queue_of(job) {
            Some(Queue::Hair) => self.receive_hair(response),
            Some(Queue::Background) => self.receive_background(response),
            None => {}
        }
        self.schedule();
    }

    /// Takes the current time, in seconds from an arbitrary origin.
    pub fn tick(&mut self, now: f64) {
        self.autosave(now);
        self.advance_replay(now);
        self.schedule();
    }

    /// Starts the jobs again after a loss of the workers.
    pub fn restart_jobs(&mut self) {
        self.jobs.clear();
        (self.progress, self.background_progress) = (None, None);
        self.schedule();
    }
}
