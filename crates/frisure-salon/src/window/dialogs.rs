//! Questions that the window asks.

use std::path::PathBuf;

use eframe::egui::{
    self, ColorImage, ComboBox, DragValue, Grid, Modal, TextureHandle, TextureOptions, Ui,
};

use super::outside::Outside;
use super::{keys, widgets};
use crate::state::{Command, Destination, FORMATS, Salon, Shot};

/// A question that is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialog {
    Open,
    Save,
    Export,
    Picture,
    Help,
}

/// What was answered so far.
pub(super) struct Dialogs {
    pub(super) open: Option<Dialog>,
    path: String,
    format: usize,
    size: [usize; 2],
    paths: usize,
    noise: f64,
    frames: usize,
    film: bool,
    texture: Option<(u64, TextureHandle)>,
    /// The question has just been opened: its field wants the keyboard.
    is_new: bool,
    /// A path to open, for the window.
    pub(super) wanted: Option<PathBuf>,
}

impl Default for Dialogs {
    fn default() -> Self {
        Self {
            open: None,
            path: String::new(),
            format: 0,
            size: [1024, 1024],
            paths: 256,
            noise: 3.0,
            frames: 24,
            film: false,
            texture: None,
            is_new: false,
            wanted: None,
        }
    }
}

impl Dialogs {
    /// Opens a question, with the usual answer.
    pub(super) fn ask(&mut self, dialog: Dialog, salon: &Salon, outside: &dyn Outside) {
        (self.open, self.is_new) = (Some(dialog), true);
        let saved = salon.document().and_then(|d| d.path().map(PathBuf::from));
        let usual = |extension: &str| outside.folder().join(salon.file_name(extension));
        let path = match dialog {
            Dialog::Save => saved.unwrap_or_else(|| usual("toml")),
            Dialog::Export => usual(FORMATS[self.format].0),
            Dialog::Picture => usual("png"),
            Dialog::Open | Dialog::Help => PathBuf::new(),
        };
        self.path = path.display().to_string();
    }

    /// Shows the open question.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        outside: &mut dyn Outside,
        out: &mut Vec<Command>,
    ) {
        let Some(dialog) = self.open else { return };
        let title = match dialog {
            Dialog::Open => "Open a scene, a head or a groom",
            Dialog::Save => "Save the scene",
            Dialog::Export => "Export the hair",
            Dialog::Picture => "Take a picture",
            Dialog::Help => "Keys and tools",
        };
        let modal = Modal::new(egui::Id::unique("dialog")).show(ui.ctx(), |ui| {
            ui.set_width(if dialog == Dialog::Help { 560.0 } else { 460.0 });
            ui.heading(title);
            ui.add_space(6.0);
            match dialog {
                Dialog::Open => self.opening(ui, outside),
                Dialog::Save => self.saving(ui, salon, outside, out),
                Dialog::Export => self.exporting(ui, salon, outside, out),
                Dialog::Picture => self.taking(ui, salon, outside, out),
                Dialog::Help => help(ui),
            }
            ui.add_space(6.0);
            if widgets::plain(ui, "Close", "Escape").clicked() {
                self.open = None;
            }
        });
        if modal.should_close() {
            self.open = None;
        }
    }

    /// A field for a path; whether Enter was pressed in it.
    fn path(&mut self, ui: &mut Ui) -> bool {
        let name = ui.label("File");
        let field = egui::TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(name.id);
        if std::mem::take(&mut self.is_new) {
            field.request_focus();
        }
        field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter))
    }

    fn opening(&mut self, ui: &mut Ui, outside: &mut dyn Outside) {
        ui.label(
            "A scene is a .toml file. Meshes become the head, curves and lines the hair of the scene that is open: \
             USD, Alembic, glTF, .obj, .ply, .hair, .data, .npz. All can be dropped on the window.",
        );
        if outside.has_paths() {
            let entered = self.path(ui);
            ui.horizontal(|ui| {
                if widgets::plain(ui, "Open file", "").clicked() || entered {
                    self.wanted = Some(PathBuf::from(self.path.trim()));
                    self.open = None;
                }
                if widgets::plain(ui, "Browse…", "The system's own dialog").clicked() {
                    outside.ask_for_file();
                    self.open = None;
                }
            });
        } else if widgets::plain(ui, "Choose a file…", "").clicked() {
            outside.ask_for_file();
            self.open = None;
        }
    }

    /// Where a file with this extension goes.
    fn destination(&self, salon: &Salon, outside: &dyn Outside, extension: &str) -> Destination {
        match outside.has_paths() {
            true => {
                let path = PathBuf::from(self.path.trim());
                Destination::Path(match path.extension() {
                    Some(_) => path,
                    None => path.with_extension(extension),
                })
            }
            false => Destination::Download(salon.file_name(extension)),
        }
    }

    fn saving(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        outside: &dyn Outside,
        out: &mut Vec<Command>,
    ) {
        ui.label("The scene is a text with all that was done; the command line reads the same.");
        let entered = outside.has_paths() && self.path(ui);
        if widgets::plain(ui, "Save scene", "").clicked() || entered {
            out.push(Command::Save(self.destination(salon, outside, "toml")));
            self.open = None;
        }
    }

    fn exporting(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        outside: &dyn Outside,
        out: &mut Vec<Command>,
    ) {
        ui.label("All hairs as they are now, in metres, z up.");
        let before = self.format;
        let name = ui.label("Format");
        let list = ComboBox::from_id_salt("format").selected_text(FORMATS[self.format].1);
        let shown = list.show_ui(ui, |ui| {
            for (index, (extension, said)) in FORMATS.iter().enumerate() {
                let label = format!("{said} (.{extension})");
                ui.selectable_value(&mut self.format, index, label);
            }
        });
        shown.response.labelled_by(name.id);
        let extension = FORMATS[self.format].0;
        if self.format != before {
            let path = PathBuf::from(&self.path).with_extension(extension);
            self.path = path.display().to_string();
        }
        let entered = outside.has_paths() && self.path(ui);
        if widgets::plain(ui, "Export groom", "").clicked() || entered {
            out.push(Command::Export(self.destination(salon, outside, extension)));
            self.open = None;
        }
    }

    fn taking(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        outside: &dyn Outside,
        out: &mut Vec<Command>,
    ) {
        ui.label("Made in the background, from where you look now.");
        ui.horizontal(|ui| {
            ui.selectable_value(&mut self.film, false, "Final picture");
            ui.selectable_value(&mut self.film, true, "Turntable");
        });
        let number = |ui: &mut Ui, name: &str, value: &mut usize, range| {
            let label = ui.label(name);
            ui.add(DragValue::new(value).range(range)).labelled_by(label.id);
        };
        ui.horizontal(|ui| {
            number(ui, "Width", &mut self.size[0], 16..=8192);
            number(ui, "Height", &mut self.size[1], 16..=8192);
        });
        if self.film {
            number(ui, "Pictures", &mut self.frames, 2..=360);
        } else {
            ui.horizontal(|ui| {
                number(ui, "Paths a pixel, at most", &mut self.paths, 1..=4096);
                let label = ui.label("Noise");
                let field = DragValue::new(&mut self.noise).range(0.2..=20.0).suffix(" %");
                ui.add(field.speed(0.1)).labelled_by(label.id);
            });
        }
        if outside.has_paths() {
            self.path(ui);
        }
        let label = if self.film { "Make turntable" } else { "Render picture" };
        if widgets::plain(ui, label, "").clicked() {
            let shot = match self.film {
                true => Shot::Turntable { size: self.size, frames: self.frames },
                false => {
                    Shot::Picture { size: self.size, paths: self.paths, noise: self.noise / 100.0 }
                }
            };
            out.push(Command::Shoot(shot, self.destination(salon, outside, "png")));
        }
        self.developing(ui, salon, out);
    }

    /// The picture as it grows.
    fn developing(&mut self, ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
        if let Some((stage, done, _)) = salon.aside() {
            let text = format!("{stage} {:.0} %", done * 100.0);
            ui.add(egui::ProgressBar::new(done).text(text));
            if widgets::plain(ui, "Stop rendering", "").clicked() {
                out.push(Command::Stop);
            }
        }
        let Some(exposed) = salon.exposed() else { return };
        let known = self.texture.as_ref().is_some_and(|(v, _)| *v == exposed.version);
        let whole = exposed.rgba.len() == 4 * exposed.size[0] * exposed.size[1];
        if !known && whole && !exposed.rgba.is_empty() {
            let image = ColorImage::from_rgba_unmultiplied(exposed.size, &exposed.rgba);
            let texture = ui.ctx().load_texture("exposed", image, TextureOptions::LINEAR);
            self.texture = Some((exposed.version, texture));
        }
        if let Some((_, texture)) = &self.texture {
            ui.add(egui::Image::new(texture).max_size(egui::vec2(440.0, 360.0)));
            ui.weak(format!("noise {:.1} %", exposed.noise * 100.0));
        }
    }
}

fn help(ui: &mut Ui) {
    Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
        for (key, what) in keys::HELP {
            ui.strong(*key);
            ui.label(*what);
            ui.end_row();
        }
    });
    ui.add_space(6.0);
    ui.weak("The right mouse button turns the head whatever the tool, the middle one moves it.");
}
