//! The window: the salon's state on the screen, and hands on it.
//!
//! Each frame takes in answers, draws the bars, the panels and the head, gathers the commands that
//! widgets, keys and pointer give, and has the state do them; the errands that come of it go to workers and
//! to the world outside.

mod bars;
#[cfg(not(target_arch = "wasm32"))]
pub mod desktop;
mod dialogs;
mod gallery;
mod keys;
pub mod outside;
mod panels;
pub mod probe;
mod theatre;
mod theme;
mod viewport;
mod widgets;

use std::path::Path;
use std::sync::Arc;

use eframe::egui::{self, CentralPanel, Panel as Edge, Ui};
use frisure::formats::contents::{self, Contents};
use frisure_engine::Request;
use web_time::{Duration, Instant};

use crate::state::{Choice, Command, Document, Errand, Lane, Salon, choices};
use crate::work::Worker;
use dialogs::{Dialog, Dialogs};
use outside::{Given, Outside};
use viewport::Viewport;

/// Called, from any thread, when the window has something to look at.
pub type Wake = Arc<dyn Fn() + Send + Sync>;

/// Wakes a window.
#[must_use]
pub fn wake(context: &egui::Context) -> Wake {
    let context = context.clone();
    Arc::new(move || context.request_repaint())
}

/// The salon in a window.
pub struct App {
    salon: Salon,
    hair: Box<dyn Worker>,
    aside: Box<dyn Worker>,
    outside: Box<dyn Outside>,
    viewport: Viewport,
    dialogs: Dialogs,
    pictures: gallery::Pictures,
    choices: Vec<Choice>,
    since: Instant,
    aspect: f64,
    has_theatre: bool,
}

/// What a window is made of.
pub struct Parts {
    /// Computes the hair that is seen.
    pub hair: Box<dyn Worker>,
    /// Does what takes its time.
    pub aside: Box<dyn Worker>,
    /// The world outside.
    pub outside: Box<dyn Outside>,
    /// Samples of each pixel that are asked for: 4, or 1 on a slow device.
    pub samples: u32,
}

impl App {
    /// A window on a salon; without a graphics device of wgpu the head is not drawn, and all else is.
    #[must_use]
    pub fn new(cc: &eframe::CreationContext<'_>, parts: Parts) -> Self {
        theme::install(&cc.egui_ctx);
        let has_theatre = cc.wgpu_render_state.is_some();
        if let Some(state) = &cc.wgpu_render_state {
            theatre::build(state, parts.samples);
        }
        let Parts { hair, aside, mut outside, samples } = parts;
        let mut salon = Salon::new();
        if let Some(text) = outside.kept() {
            salon.found_kept(&text);
        }
        Self {
            salon,
            hair,
            aside,
            outside,
            viewport: Viewport::new(samples == 1),
            dialogs: Dialogs::default(),
            pictures: gallery::Pictures::default(),
            choices: choices(),
            since: Instant::now(),
            aspect: 1.0,
            has_theatre,
        }
    }

    /// Takes up a salon from a window that is no more.
    pub fn take_over(&mut self, mut salon: Salon) {
        salon.begin_again();
        self.salon = salon;
    }

    /// Gives the salon away, for another window to take over.
    pub fn hand_over(&mut self) -> Salon {
        std::mem::take(&mut self.salon)
    }

    /// The state.
    #[must_use]
    pub fn salon(&self) -> &Salon {
        &self.salon
    }

    /// Does a command, as a widget or a key would.
    pub fn run(&mut self, command: Command) {
        self.salon.run(command);
    }

    /// Offers a text that another window kept.
    pub fn found_kept(&mut self, text: &str) {
        self.salon.found_kept(text);
    }

    /// Takes a file that somebody opened or dropped: a scene, a head, a groom.
    pub fn take(&mut self, given: Given) {
        let extension = given.name.rsplit_once('.').map(|(_, e)| e.to_ascii_lowercase());
        match extension.as_deref() {
            Some("toml") => match String::from_utf8(given.bytes) {
                Ok(text) => {
                    let (path, name) = (given.path, given.name);
                    self.salon.run(Command::Open { path, name, text });
                }
                Err(_) => {
                    let hint = "A scene is a text in UTF-8, such as `frisure new` prints.";
                    self.salon.tell(format!("{} is no text", given.name), hint, true);
                }
            },
            // What lies beside a glTF mesh; where there are paths, it is found.
            Some("bin") => {
                self.keep(given);
                self.run(Command::TryAgain);
            }
            _ if contents::by_name(Path::new(&given.name)) == Contents::default() => {
                self.run(Command::File(given.name));
            }
            _ => {
                let path = given.path.as_ref().map(|path| path.display().to_string());
                let path = path.unwrap_or_else(|| given.name.clone());
                self.keep(given);
                self.run(Command::File(path));
            }
        }
    }

    /// Has workers keep a file that has no path.
    fn keep(&mut self, given: Given) {
        let Given { path: None, name, bytes } = given else { return };
        // Nobody waits for the answers.
        self.hair.send(0, Request::ProvideFile { path: name.clone(), bytes: bytes.clone() });
        self.aside.send(0, Request::ProvideFile { path: name, bytes });
    }

    /// Opens a file by its path.
    #[cfg(not(target_arch = "wasm32"))]
    pub fn open(&mut self, path: &Path) {
        match desktop::read(path) {
            Ok(given) => self.take(given),
            Err(problem) => self.salon.tell(problem, "Is the path right?", true),
        }
    }

    #[cfg(target_arch = "wasm32")]
    fn open(&mut self, _path: &Path) {}

    /// Takes in what came from workers and from outside, and hands out what is to be done.
    pub fn turn_over(&mut self) {
        for worker in [&mut self.hair, &mut self.aside] {
            while let Some((ticket, answer)) = worker.poll() {
                self.salon.receive(ticket, answer);
            }
        }
        while let Some(given) = self.outside.given() {
            self.take(given);
        }
        while let Some(command) = probe::asked() {
            self.asked(&command);
        }
        self.salon.tick(self.since.elapsed().as_secs_f64());
        for errand in self.salon.errands() {
            self.errand(errand);
        }
    }

    fn errand(&mut self, errand: Errand) {
        match errand {
            Errand::Work(lane, ticket, order) => self.worker(lane).send(ticket, *order),
            Errand::Cancel(lane, ticket) => self.worker(lane).cancel(ticket),
            Errand::Save(save) => {
                let result = self.outside.save(&save);
                self.salon.saved(&save, result);
            }
            Errand::Autosave(text) => {
                if let Err(problem) = self.outside.keep(text.as_deref()) {
                    let hint = "Save the scene now and then.";
                    let text = format!("your work cannot be kept over a crash: {problem}");
                    self.salon.tell(text, hint, true);
                }
            }
        }
    }

    fn worker(&mut self, lane: Lane) -> &mut Box<dyn Worker> {
        match lane {
            Lane::Hair => &mut self.hair,
            Lane::Aside => &mut self.aside,
        }
    }

    /// A command by its name, from a program that drives the page.
    fn asked(&mut self, command: &str) {
        let (name, rest) = command.split_once(' ').unwrap_or((command, ""));
        match name {
            "begin" => self.run(Command::Begin(rest.to_owned())),
            "wet" => self.run(Command::Wet),
            "dry" => self.run(Command::Dry(0.6)),
            "undo" => self.run(Command::Undo),
            "redo" => self.run(Command::Redo),
            "cut" => self.run(Command::Cut),
            "panic" => panic!("asked to"),
            other => {
                let hint = "begin NAME, wet, dry, cut, undo, redo";
                self.salon.tell(format!("there is no command `{other}`"), hint, true);
            }
        }
    }

    fn dropped(&mut self, ui: &Ui) {
        let files = ui.input(|i| i.raw.dropped_files.clone());
        for file in files {
            self.outside.take_in(file);
        }
        if ui.input(|i| !i.raw.hovered_files.is_empty()) {
            let rect = ui.ctx().content_rect();
            let painter = ui.ctx().layer_painter(egui::LayerId::new(
                egui::Order::Foreground,
                egui::Id::unique("drop"),
            ));
            painter.rect_filled(rect, 0.0, egui::Color32::from_black_alpha(160));
            painter.text(
                rect.center(),
                egui::Align2::CENTER_CENTER,
                "Drop a scene, a head or a groom",
                egui::FontId::proportional(24.0),
                egui::Color32::WHITE,
            );
        }
    }

    fn body(&mut self, ui: &mut Ui, out: &mut Vec<Command>) {
        let mut dialog = None;
        Edge::top("top").exact_size(44.0).show(ui, |ui| {
            bars::top(ui, &self.salon, out, &mut dialog);
        });
        Edge::bottom("status").show(ui, |ui| bars::status(ui, &self.salon, out));
        if let Some(dialog) = dialog {
            self.dialogs.ask(dialog, &self.salon, self.outside.as_ref());
        }
        if self.salon.is_gallery() {
            CentralPanel::default().show(ui, |ui| {
                gallery::show(ui, &self.salon, &mut self.pictures, out);
            });
            return;
        }
        Edge::top("tools").show(ui, |ui| bars::tools(ui, &mut self.salon, out));
        Edge::bottom("choosing").show(ui, |ui| bars::choosing(ui, &self.salon, out));
        let side = Edge::right("side").exact_size(330.0);
        side.resizable(false).show(ui, |ui| {
            Edge::bottom("history").exact_size(132.0).show(ui, |ui| {
                ui.strong("History");
                panels::history(ui, &self.salon, out);
            });
            CentralPanel::default().show(ui, |ui| {
                panels::show(ui, &self.salon, &self.choices, out);
            });
        });
        let frame = egui::Frame::NONE.fill(egui::Color32::from_gray(40));
        CentralPanel::default().frame(frame).show(ui, |ui| {
            self.aspect = viewport::aspect(ui.available_rect_before_wrap());
            if self.has_theatre {
                let rect = ui.available_rect_before_wrap();
                self.viewport.show(ui, &mut self.salon, out);
                if let (None, Some(understood)) = (self.salon.shown(), self.salon.scene()) {
                    let hair_type = understood.scene.hair_type;
                    gallery::meanwhile(ui, rect, hair_type, &mut self.pictures);
                }
            } else {
                ui.label("There is no graphics device to draw the head with.");
            }
        });
    }

    /// Offers what a crash left.
    fn recovery(&mut self, ui: &mut Ui, out: &mut Vec<Command>) {
        let Some(document) = self.salon.recoverable() else { return };
        egui::Modal::new(egui::Id::unique("recover")).show(ui.ctx(), |ui| {
            ui.heading("Take up where you were?");
            ui.label(format!("The salon ended before “{}” was saved.", document.name()));
            ui.horizontal(|ui| {
                if widgets::plain(ui, "Take it up", "").clicked() {
                    out.push(Command::Recover(true));
                }
                if widgets::plain(ui, "Forget it", "").clicked() {
                    out.push(Command::Recover(false));
                }
            });
        });
    }

    /// What an onlooker is told.
    fn told(&self) -> String {
        let document = self.salon.document();
        let (badge, _) = viewport::badge(&self.salon);
        let hair = self.salon.shown().map(|(hair, _)| &hair.numbers);
        serde_json::json!({
            "gallery": self.salon.is_gallery(),
            "name": document.map(Document::name),
            "text": document.map(Document::text),
            "history": document.map(|d| d.edits().iter().map(|e| e.label.clone()).collect::<Vec<_>>()),
            "at": document.map(Document::at),
            "badge": badge,
            "settled": self.salon.is_settled(),
            "chosen": self.salon.chosen().label,
            "chosenWisps": self.salon.chosen().count(),
            "wet": self.salon.is_wet(),
            "drawn": hair.map(|n| n.drawn),
            "mass": hair.map(|n| n.mass),
            "tips": hair.map(|n| n.tips),
            "held": self.salon.shown().and_then(|(hair, _)| hair.adoption.as_ref()).map(ToString::to_string),
            "aside": self.salon.aside().is_some(),
            "messages": self.salon.messages().iter().map(|m| m.text.clone()).collect::<Vec<_>>(),
        })
        .to_string()
    }
}

impl eframe::App for App {
    fn logic(&mut self, ctx: &egui::Context, _frame: &mut eframe::Frame) {
        self.turn_over();
        if self.salon.is_busy() {
            ctx.request_repaint_after(Duration::from_millis(200));
        }
    }

    fn ui(&mut self, ui: &mut Ui, _frame: &mut eframe::Frame) {
        self.dropped(ui);
        let mut out = Vec::new();
        self.body(ui, &mut out);
        // Escape that closes a question is no key for the head behind it.
        let was_asking = self.dialogs.open.is_some();
        self.dialogs.show(ui, &self.salon, self.outside.as_mut(), &mut out);
        self.recovery(ui, &mut out);
        if let Some(path) = self.dialogs.wanted.take() {
            self.open(&path);
        }
        let (commands, dialog) = {
            let asking = self.dialogs.open.is_some() || self.salon.recoverable().is_some();
            keys::commands(ui, &self.salon, self.aspect, was_asking || asking)
        };
        if let Some(dialog) =
            dialog.filter(|d| needs_no_hair(*d) || self.salon.document().is_some())
        {
            self.dialogs.ask(dialog, &self.salon, self.outside.as_ref());
        }
        if !commands.is_empty() {
            self.viewport.moves(ui.input(|i| i.time));
        }
        out.extend(commands);
        if !out.is_empty() {
            ui.ctx().request_repaint();
        }
        for command in out {
            self.salon.run(command);
        }
        if let Some(trouble) = self.viewport.trouble.lock().ok().and_then(|mut t| t.take()) {
            self.salon.tell(trouble, "", true);
        }
        self.turn_over();
        probe::tell(|| self.told());
    }

    #[cfg(target_arch = "wasm32")]
    fn as_any_mut(&mut self) -> Option<&mut dyn std::any::Any> {
        Some(&mut *self)
    }
}

fn needs_no_hair(dialog: Dialog) -> bool {
    matches!(dialog, Dialog::Open | Dialog::Help)
}
