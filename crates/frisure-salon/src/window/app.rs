//! The application: passes responses, input and effects between the state, the workers and the platform.
//!
//! Each frame takes responses, draws the panels and the viewport, collects the commands of widgets, keys and
//! pointer, runs them on the state, and executes the effects.

use std::path::Path;
use std::sync::Arc;

use eframe::egui::{self, CentralPanel, Panel, Ui};
use frisure::formats::contents::{self, Contents};
use frisure::formats::picture::scene_text;
use frisure::hairstyle::styling::{Dry, Operation, Wet};
use frisure_engine::Request;
use web_time::{Duration, Instant};

use super::dialogs::Dialogs;
use super::platform::{InputFile, Platform};
use super::viewport::Viewport;
use super::widgets::Room;
use super::{
    automation, exercise, gallery, keys, ndc, overlay, panels, reference, renderer, theme,
    toolbars, tools, tour, widgets,
};
use crate::locale::{self, Locale, tr};
use crate::state::{Command, Document, Effect, Nearness, Queue, Salon};
use crate::work::{Wake, Worker};

/// A callback that repaints a window.
#[must_use]
pub fn waker(context: &egui::Context) -> Wake {
    let context = context.clone();
    Arc::new(move || context.request_repaint())
}

/// The salon in a window.
pub struct App {
    salon: Salon,
    workers: [Box<dyn Worker>; 2],
    platform: Box<dyn Platform>,
    viewport: Viewport,
    dialogs: Dialogs,
    pictures: gallery::Pictures,
    photo: reference::Photo,
    start: Instant,
    aspect: f64,
    has_renderer: bool,
    /// Whether the panels at the side are open where they take the place of the picture.
    side: bool,
    /// Whether a text field had the focus at the end of the last frame.
    typing: bool,
}

/// The parts of a window that depend on the platform.
pub struct Parts {
    /// The workers of [`Queue::Hair`] and [`Queue::Background`].
    pub workers: [Box<dyn Worker>; 2],
    /// Files, dialogs and storage.
    pub platform: Box<dyn Platform>,
    /// Samples per pixel: 4, or 1 on a slow device.
    pub samples: u32,
    /// The language; `None` is the one chosen before, or that of the system.
    pub locale: Option<Locale>,
}

impl App {
    /// Creates the salon in a window. Without a wgpu device the window does not show the head.
    #[must_use]
    pub fn new(cc: &eframe::CreationContext<'_>, parts: Parts) -> Self {
        theme::install(&cc.egui_ctx);
        let has_renderer = cc.wgpu_render_state.is_some();
        let Parts { workers, mut platform, mut samples, locale } = parts;
        let chosen = || platform.read_language().and_then(|tag| Locale::of(&tag));
        locale::set(locale.or_else(chosen).unwrap_or_else(Locale::of_system));
        if let Some(state) = &cc.wgpu_render_state {
            // Software that draws in place of a graphics card is slow, whatever was asked for.
            let is_software = state.adapter.get_info().device_type == wgpu::DeviceType::Cpu;
            samples = if is_software { 1 } else { samples };
            renderer::install(state, samples);
        }
        let mut salon = Salon::new();
        if let Some(text) = platform.read_autosave() {
            salon.offer_recovery(&text);
        }
        Self {
            salon,
            workers,
            platform,
            viewport: Viewport::new(samples == 1),
            dialogs: Dialogs::default(),
            pictures: gallery::Pictures::default(),
            photo: reference::Photo::default(),
            start: Instant::now(),
            aspect: 1.0,
            has_renderer,
            side: false,
            typing: false,
        }
    }

    /// Continues with the state of a window that was closed.
    pub fn restore(&mut self, mut salon: Salon) {
        salon.restart_jobs();
        self.salon = salon;
    }

    /// Takes the state, for another window to restore.
    pub fn take_salon(&mut self) -> Salon {
        std::mem::take(&mut self.salon)
    }

    /// The state.
    #[must_use]
    pub fn salon(&self) -> &Salon {
        &self.salon
    }

    /// How near to the goal of the exercise the hair is.
    pub fn nearness(&mut self) -> Option<Nearness> {
        self.salon.nearness()
    }

    /// Runs a command.
    pub fn run(&mut self, command: Command) {
        self.salon.run(command);
    }

    /// Offers an autosaved text of another window.
    pub fn offer_recovery(&mut self, text: &str) {
        self.salon.offer_recovery(text);
    }

    /// Takes an opened or dropped file: a scene, a head or a groom.
    pub fn take(&mut self, file: InputFile) {
        let extension = file.name.rsplit_once('.').map(|(_, e)| e.to_ascii_lowercase());
        match extension.as_deref() {
            Some("toml") => match String::from_utf8(file.bytes) {
                Ok(text) => {
                    let (path, name) = (file.path, file.name);
                    self.run(Command::Open { path, name, text });
                }
                Err(_) => {
                    let text = tr!("not-text", name = file.name);
                    self.salon.notify(text, tr!("not-text.hint"), true);
                }
            },
            Some("png") => match scene_text::extract(&file.bytes) {
                Some(text) => {
                    let name = file.name.trim_end_matches(".png").to_owned();
                    self.run(Command::Open { path: None, name, text });
                }
                // A picture without a scene is one to compare with.
                None => self.run(Command::Refer(file.name, file.bytes)),
            },
            Some("jpg" | "jpeg") => self.run(Command::Refer(file.name, file.bytes)),
            // The buffer of a glTF mesh; for a file with a path, the engine reads the buffer.
            Some("bin") => {
                self.upload(file);
                self.run(Command::Retry);
            }
            _ if contents::by_name(Path::new(&file.name)) == Contents::default() => {
                self.run(Command::File(file.name));
            }
            _ => {
                let path = file.path.as_ref().map(|path| path.display().to_string());
                let path = path.unwrap_or_else(|| file.name.clone());
                self.upload(file);
                self.run(Command::File(path));
            }
        }
    }

    /// Sends a file without a path to the workers, which keep it under its name.
    fn upload(&mut self, file: InputFile) {
        let InputFile { path: None, name, bytes } = file else { return };
        for worker in &mut self.workers {
            // Job 0 is not in a queue: the state ignores its response.
            worker.send(0, Request::ProvideFile { path: name.clone(), bytes: bytes.clone() });
        }
    }

    /// Opens a file by its path.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn open(&mut self, path: &Path) {
        match super::desktop::read(path) {
            Ok(file) => self.take(file),
            Err(problem) => self.salon.notify(problem, tr!("check-path"), true),
        }
    }

    #[cfg(target_arch = "wasm32")]
    fn open(&mut self, _path: &Path) {}

    /// Takes responses and input files, runs automation commands, and executes the effects.
    pub fn process_events(&mut self) {
        for worker in &mut self.workers {
            while let Some((job, response)) = worker.poll() {
                self.salon.receive(job, response);
            }
        }
        while let Some(file) = self.platform.next_file() {
            self.take(file);
        }
        while let Some(command) = automation::next_command() {
            self.run_named(&command);
        }
        self.salon.tick(self.start.elapsed().as_secs_f64());
        for effect in self.salon.effects() {
            self.perform(effect);
        }
    }

    fn perform(&mut self, effect: Effect) {
        match effect {
            Effect::Execute(queue, job, request) => self.worker(queue).send(job, *request),
            Effect::Cancel(queue, job) => self.worker(queue).cancel(job),
            Effect::Save(save) => {
                let result = self.platform.save(&save);
                self.salon.saved(&save, result);
            }
            Effect::KeepLanguage(locale) => self.platform.write_language(locale.tag()),
            Effect::Autosave(text) => {
                if let Err(problem) = self.platform.write_autosave(text.as_deref()) {
                    let text = tr!("not-autosaved", problem = problem);
                    self.salon.notify(text, tr!("not-autosaved.hint"), true);
                }
            }
        }
    }

    fn worker(&mut self, queue: Queue) -> &mut dyn Worker {
        self.workers[queue as usize].as_mut()
    }

    /// Runs a command of a program that drives the page, by its name.
    fn run_named(&mut self, command: &str) {
        let (name, argument) = command.split_once(' ').unwrap_or((command, ""));
        let command = match name {
            "begin" => Command::Begin(argument.to_owned()),
            "wet" => Command::Apply(Operation::Wet(Wet::default())),
            "dry" => Command::Apply(Operation::Dry(Dry::default())),
            "undo" => Command::Undo,
            "redo" => Command::Redo,
            "cut" => Command::Cut,
            "panic" => panic!("panic by command"),
            other => {
                let hint = "The commands are begin NAME, wet, dry, cut, undo, redo.";
                return self.salon.notify(format!("there is no command `{other}`"), hint, true);
            }
        };
        self.run(command);
    }

    fn drag_and_drop(&mut self, ui: &Ui) {
        for file in ui.input(|i| i.raw.dropped_files.clone()) {
            self.platform.read_dropped(file);
        }
        if ui.input(|i| !i.raw.hovered_files.is_empty()) {
            let rect = ui.ctx().content_rect();
            let layer = egui::LayerId::new(egui::Order::Foreground, egui::Id::unique("drop"));
            let painter = ui.ctx().layer_painter(layer);
            painter.rect_filled(rect, 0.0, egui::Color32::from_black_alpha(160));
            let (text, font) = (tr!("drop-here"), egui::FontId::proportional(24.0));
            let centre = egui::Align2::CENTER_CENTER;
            painter.text(rect.center(), centre, text, font, egui::Color32::WHITE);
        }
    }

    fn body(&mut self, ui: &mut Ui, out: &mut Vec<Command>) {
        let (mut dialog, room) = (None, Room::of(ui));
        let mut top = Panel::top("top");
        if room == Room::Wide {
            top = top.exact_size(44.0);
        }
        top.show(ui, |ui| {
            toolbars::main(ui, &self.salon, &mut self.side, out, &mut dialog);
        });
        Panel::bottom("status").show(ui, |ui| toolbars::status(ui, &self.salon, out));
        if let Some(dialog) = dialog {
            self.dialogs.open(dialog, &self.salon, self.platform.as_ref());
        }
        if self.salon.is_gallery() {
            CentralPanel::default().show(ui, |ui| {
                gallery::show(ui, &self.salon, &mut self.pictures, out);
            });
            return;
        }
        Panel::top("tools").show(ui, |ui| tools::show(ui, &mut self.salon, out));
        Panel::bottom("selection").show(ui, |ui| toolbars::selection(ui, &self.salon, out));
        if room == Room::Phone && self.side {
            CentralPanel::default().show(ui, |ui| self.side(ui, out));
            return;
        }
        if room != Room::Phone {
            let side = Panel::right("side").exact_size(330.0);
            side.resizable(false).show(ui, |ui| self.side(ui, out));
        }
        let frame = egui::Frame::NONE.fill(egui::Color32::from_gray(40));
        CentralPanel::default().frame(frame).show(ui, |ui| self.centre(ui, out));
        tour::show(ui, &self.salon, out);
        exercise::show(ui, &mut self.salon, out);
        self.photo.show(ui, &self.salon, out);
    }

    /// The panels with sliders, and the history.
    fn side(&mut self, ui: &mut Ui, out: &mut Vec<Command>) {
        Panel::bottom("history").exact_size(132.0).show(ui, |ui| {
            ui.strong(tr!("history"));
            panels::history(ui, &self.salon, out);
        });
        CentralPanel::default()
            .show(ui, |ui| panels::show(ui, &self.salon, &mut self.pictures, out));
    }

    fn centre(&mut self, ui: &mut Ui, out: &mut Vec<Command>) {
        let rect = ui.available_rect_before_wrap();
        self.aspect = ndc::aspect(rect);
        if !self.has_renderer {
            ui.label(tr!("no-graphics"));
            return;
        }
        self.viewport.show(ui, &mut self.salon, out);
        if let (None, Some(parsed)) = (self.salon.preview(), &self.salon.scene) {
            gallery::placeholder(ui, rect, parsed.scene.hair_type, &mut self.pictures);
        }
    }

    /// Offers the recovered document.
    fn recovery(&self, ui: &mut Ui, out: &mut Vec<Command>) {
        let Some(document) = &self.salon.recoverable else { return };
        egui::Modal::new(egui::Id::unique("recover")).show(ui.ctx(), |ui| {
            ui.heading(tr!("recover-title"));
            ui.label(tr!("recover-text", name = document.name()));
            ui.horizontal(|ui| {
                if widgets::plain(ui, "recover").clicked() {
                    out.push(Command::Recover(true));
                }
                if widgets::plain(ui, "discard").clicked() {
                    out.push(Command::Recover(false));
                }
            });
        });
    }

    /// The state as JSON, for automation.
    fn state_json(&self) -> String {
        let document = self.salon.document.as_ref();
        let (badge, _) = overlay::badge(&self.salon, self.viewport.is_moving());
        let hair = self.salon.preview().map(|(hair, _)| hair);
        let numbers = hair.map(|hair| &hair.numbers);
        let exercise = self.salon.exercise.as_ref().map(|exercise| {
            serde_json::json!({
                "title": exercise.title,
                "goal": exercise.goal().is_some(),
                "shows": self.salon.shows_solution(),
                "done": exercise.last_nearness().map(|nearness| nearness.done),
            })
        });
        let tour =
            self.salon.tour.as_ref().map(
                |tour| serde_json::json!({ "at": tour.at, "done": self.salon.is_step_done() }),
            );
        serde_json::json!({
            "gallery": self.salon.is_gallery(),
            "name": document.map(Document::name),
            "text": document.map(Document::text),
            "history": document.map(|d| d.edits().iter().map(|e| e.label.clone()).collect::<Vec<_>>()),
            "at": document.map(Document::at),
            "badge": badge,
            "settled": self.salon.is_settled(),
            "selected": self.salon.selected.label,
            "selectedWisps": self.salon.selected.count(),
            "wet": self.salon.is_wet(),
            "drawn": numbers.map(|n| n.drawn),
            "mass": numbers.map(|n| n.mass),
            "tips": numbers.map(|n| n.tips),
            "held": hair.and_then(|hair| hair.adoption.as_ref()).map(ToString::to_string),
            "background": self.salon.background().is_some(),
            "exercise": exercise,
            "tour": tour,
            "messages": self.salon.messages.iter().map(|m| m.text.clone()).collect::<Vec<_>>(),
        })
        .to_string()
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.process_events();
        if self.salon.is_busy() || self.salon.shows_solution() {
            ctx.request_repaint_after(Duration::from_millis(200));
        }
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.drag_and_drop(ui);
        let mut out = Vec::new();
        self.body(ui, &mut out);
        // The Escape that closes a dialog must not reach the viewport.
        let was_modal = self.dialogs.current.is_some();
        self.dialogs.show(ui, &self.salon, self.platform.as_mut(), &mut out);
        self.recovery(ui, &mut out);
        if let Some(path) = self.dialogs.path_to_open.take() {
            self.open(&path);
        }
        let modal = was_modal || self.dialogs.current.is_some() || self.salon.recoverable.is_some();
        // The Enter or Escape that ends what was typed in a field must not reach the viewport either.
        let typed = std::mem::replace(&mut self.typing, ui.ctx().text_edit_focused());
        let typing = typed || self.typing;
        let (commands, dialog) = keys::commands(ui, &self.salon, self.aspect, modal, typing);
        let has_document = self.salon.document.is_some();
        if let Some(dialog) = dialog.filter(|d| has_document || !d.needs_document()) {
            self.dialogs.open(dialog, &self.salon, self.platform.as_ref());
        }
        if !commands.is_empty() {
            self.viewport.note_motion(ui.input(|i| i.time));
        }
        out.extend(commands);
        if !out.is_empty() {
            ui.ctx().request_repaint();
        }
        for command in out {
            self.salon.run(command);
        }
        if let Some(error) = self.viewport.error.lock().ok().and_then(|mut e| e.take()) {
            self.salon.notify(error, "", true);
        }
        self.process_events();
        automation::publish_state(|| self.state_json());
    }

    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(&mut *self)
    }
}
