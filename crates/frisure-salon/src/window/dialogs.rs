//! The modal dialogs.

use std::path::PathBuf;

use eframe::egui::{
    self, ColorImage, ComboBox, DragValue, Grid, Modal, TextureHandle, TextureOptions, Ui,
};

use super::platform::Platform;
use super::{icons, widgets};
use crate::locale::{self, tr};
use crate::state::{Command, Destination, FORMATS, RenderTask, Salon, code};

/// A dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Dialog {
    Open,
    Save,
    Export,
    Picture,
    Help,
}

impl Dialog {
    pub(super) fn needs_document(self) -> bool {
        !matches!(self, Self::Open | Self::Help)
    }

    /// The message of its title.
    fn title(self) -> &'static str {
        match self {
            Self::Open => "open-title",
            Self::Save => "save-title",
            Self::Export => "export-title",
            Self::Picture => "picture-title",
            Self::Help => "help-title",
        }
    }
}

/// A kind of picture to render.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum PictureKind {
    Final,
    Turntable,
    Film,
}

impl PictureKind {
    /// All, with their messages.
    const ALL: [(Self, &'static str); 3] =
        [(Self::Final, "final-picture"), (Self::Turntable, "turntable"), (Self::Film, "film")];
}

/// The open dialog, and the contents of the fields.
pub(super) struct Dialogs {
    pub(super) current: Option<Dialog>,
    path: String,
    format: usize,
    size: [usize; 2],
    paths: usize,
    noise: f64,
    frames: usize,
    kind: PictureKind,
    texture: Option<(u64, TextureHandle)>,
    /// Whether the dialog has just been opened and its field takes the focus.
    is_new: bool,
    /// A path for the window to open.
    pub(super) path_to_open: Option<PathBuf>,
}

impl Default for Dialogs {
    fn default() -> Self {
        Self {
            current: None,
            path: String::new(),
            format: 0,
            size: [1024, 1024],
            paths: 256,
            noise: 3.0,
            frames: 24,
            kind: PictureKind::Final,
            texture: None,
            is_new: false,
            path_to_open: None,
        }
    }
}

impl Dialogs {
    /// Opens a dialog and proposes a path.
    pub(super) fn open(&mut self, dialog: Dialog, salon: &Salon, platform: &dyn Platform) {
        (self.current, self.is_new) = (Some(dialog), true);
        let saved = salon.document.as_ref().and_then(|d| d.path().map(PathBuf::from));
        let proposed = |extension: &str| platform.folder().join(salon.file_name(extension));
        let path = match dialog {
            Dialog::Save => saved.unwrap_or_else(|| proposed("toml")),
            Dialog::Export => proposed(FORMATS[self.format].0),
            Dialog::Picture => proposed("png"),
            Dialog::Open | Dialog::Help => PathBuf::new(),
        };
        self.path = path.display().to_string();
    }

    /// Shows the open dialog.
    pub(super) fn show(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        platform: &mut dyn Platform,
        out: &mut Vec<Command>,
    ) {
        let Some(dialog) = self.current else { return };
        let modal = Modal::new(egui::Id::unique("dialog")).show(ui.ctx(), |ui| {
            ui.set_width(if dialog == Dialog::Help { 560.0 } else { 460.0 });
            ui.heading(tr!(dialog.title()));
            ui.add_space(6.0);
            match dialog {
                Dialog::Open => self.open_file(ui, platform),
                Dialog::Save => self.save(ui, salon, platform, out),
                Dialog::Export => self.export(ui, salon, platform, out),
                Dialog::Picture => self.picture(ui, salon, platform, out),
                Dialog::Help => {
                    help(ui);
                    if widgets::with_icon(ui, icons::TOUR, "take-tour").clicked() {
                        out.push(Command::BeginTour);
                        self.current = None;
                    }
                }
            }
            ui.add_space(6.0);
            if widgets::plain(ui, "close").clicked() {
                self.current = None;
            }
        });
        if modal.should_close() {
            self.current = None;
        }
    }

    /// Shows a field for a path; returns whether Enter was pressed in it.
    fn path(&mut self, ui: &mut Ui) -> bool {
        let name = ui.label(tr!("file"));
        let field = egui::TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(name.id);
        if std::mem::take(&mut self.is_new) {
            field.request_focus();
        }
        field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter))
    }

    fn open_file(&mut self, ui: &mut Ui, platform: &mut dyn Platform) {
        ui.label(tr!("open-text"));
        if platform.has_paths() {
            let entered = self.path(ui);
            ui.horizontal(|ui| {
                if widgets::plain(ui, "open-file").clicked() || entered {
                    self.path_to_open = Some(PathBuf::from(self.path.trim()));
                    self.current = None;
                }
                if widgets::plain(ui, "browse").clicked() {
                    platform.show_open_dialog();
                    self.current = None;
                }
            });
        } else if widgets::plain(ui, "choose-file").clicked() {
            platform.show_open_dialog();
            self.current = None;
        }
    }

    /// The destination of a file with an extension.
    fn destination(&self, salon: &Salon, platform: &dyn Platform, extension: &str) -> Destination {
        match platform.has_paths() {
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

    fn save(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        platform: &dyn Platform,
        out: &mut Vec<Command>,
    ) {
        ui.label(tr!("save-text"));
        let entered = platform.has_paths() && self.path(ui);
        if widgets::plain(ui, "save-scene").clicked() || entered {
            out.push(Command::Save(self.destination(salon, platform, "toml")));
            self.current = None;
        }
        ui.add_space(6.0);
        let id = if platform.has_paths() { "copy-code" } else { "copy-link" };
        if let Some(document) = &salon.document
            && widgets::with_icon(ui, icons::SHARE, id).clicked()
        {
            ui.ctx().copy_text(platform.link("scene", &code(document.text())));
        }
        let steps = salon.scene.as_ref().map_or(0, |parsed| parsed.scene.steps().len());
        if let Some(document) = salon.document.as_ref().filter(|_| steps > 0)
            && widgets::with_icon(ui, icons::EXERCISES, "copy-exercise").clicked()
        {
            ui.ctx().copy_text(platform.link("exercise", &code(document.text())));
        }
    }

    fn export(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        platform: &dyn Platform,
        out: &mut Vec<Command>,
    ) {
        ui.label(tr!("export-text"));
        let before = self.format;
        let name = ui.label(tr!("format"));
        let list = ComboBox::from_id_salt("format").selected_text(FORMATS[self.format].1);
        let shown = list.show_ui(ui, |ui| {
            for (index, (extension, title)) in FORMATS.iter().enumerate() {
                let label = format!("{title} (.{extension})");
                ui.selectable_value(&mut self.format, index, label);
            }
        });
        shown.response.labelled_by(name.id);
        let extension = FORMATS[self.format].0;
        if self.format != before {
            let path = PathBuf::from(&self.path).with_extension(extension);
            self.path = path.display().to_string();
        }
        let entered = platform.has_paths() && self.path(ui);
        if widgets::plain(ui, "export-groom").clicked() || entered {
            out.push(Command::Export(self.destination(salon, platform, extension)));
            self.current = None;
        }
    }

    fn picture(
        &mut self,
        ui: &mut Ui,
        salon: &Salon,
        platform: &dyn Platform,
        out: &mut Vec<Command>,
    ) {
        ui.label(tr!("picture-text"));
        ui.horizontal(|ui| {
            for (kind, id) in PictureKind::ALL {
                ui.selectable_value(&mut self.kind, kind, tr!(id));
            }
        });
        let number = |ui: &mut Ui, id: &str, value: &mut usize, range| {
            let label = ui.label(tr!(id));
            ui.add(DragValue::new(value).range(range)).labelled_by(label.id);
        };
        ui.horizontal(|ui| {
            number(ui, "picture-width", &mut self.size[0], 16..=8192);
            number(ui, "picture-height", &mut self.size[1], 16..=8192);
        });
        match self.kind {
            PictureKind::Turntable => number(ui, "picture-frames", &mut self.frames, 2..=360),
            PictureKind::Film => drop(ui.weak(tr!("film-text"))),
            PictureKind::Final => drop(ui.horizontal(|ui| {
                number(ui, "picture-paths", &mut self.paths, 1..=4096);
                let label = ui.label(tr!("picture-noise"));
                let field = DragValue::new(&mut self.noise).range(0.2..=20.0).suffix(" %");
                ui.add(field.speed(0.1)).labelled_by(label.id);
            })),
        }
        if platform.has_paths() {
            self.path(ui);
        }
        let id = match self.kind {
            PictureKind::Final => "render-picture",
            PictureKind::Turntable => "make-turntable",
            PictureKind::Film => "make-film",
        };
        if widgets::plain(ui, id).clicked() {
            let task = match self.kind {
                PictureKind::Turntable => {
                    RenderTask::Turntable { size: self.size, frames: self.frames }
                }
                PictureKind::Film => RenderTask::Film { size: self.size },
                PictureKind::Final => RenderTask::Picture {
                    size: self.size,
                    paths: self.paths,
                    noise: self.noise / 100.0,
                },
            };
            out.push(Command::Render(task, self.destination(salon, platform, "png")));
        }
        self.partial_picture(ui, salon, out);
    }

    /// Shows the partial picture.
    fn partial_picture(&mut self, ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
        if let Some((stage, done, _)) = salon.background() {
            let stage = locale::named("stage", stage, stage);
            let text = format!("{stage} {:.0} %", done * 100.0);
            ui.add(egui::ProgressBar::new(done).text(text));
            if widgets::plain(ui, "stop-rendering").clicked() {
                out.push(Command::Stop);
            }
        }
        let Some(picture) = &salon.partial_picture else { return };
        let known = self.texture.as_ref().is_some_and(|(v, _)| *v == picture.version);
        let whole = picture.rgba.len() == 4 * picture.size[0] * picture.size[1];
        if !known && whole && !picture.rgba.is_empty() {
            let image = ColorImage::from_rgba_unmultiplied(picture.size, &picture.rgba);
            let texture = ui.ctx().load_texture("partial picture", image, TextureOptions::LINEAR);
            self.texture = Some((picture.version, texture));
        }
        if let Some((_, texture)) = &self.texture {
            ui.add(egui::Image::new(texture).max_size(egui::vec2(440.0, 360.0)));
            let noise = locale::number(f64::from(picture.noise) * 100.0, 1);
            ui.weak(tr!("noise-so-far", noise = noise));
        }
    }
}

/// Messages of the keys: a key each, whose attribute `does` is its effect.
const KEYS: &[&str] = &[
    "keys-orbit",
    "keys-lasso",
    "keys-brush",
    "keys-cut",
    "keys-scissors",
    "keys-lift",
    "keys-clippers",
    "keys-comb",
    "keys-part",
    "keys-one-hair",
    "keys-space",
    "keys-select",
    "keys-wet",
    "keys-grow",
    "keys-release",
    "keys-enter",
    "keys-undo",
    "keys-mirror",
    "keys-compare",
    "keys-views",
    "keys-frame",
    "keys-spin",
    "keys-arrows",
    "keys-files",
    "keys-escape",
    "keys-help",
];

fn help(ui: &mut Ui) {
    Grid::new("keys").num_columns(2).striped(true).show(ui, |ui| {
        for id in KEYS {
            ui.strong(tr!(id));
            ui.label(tr!(&format!("{id}.does")));
            ui.end_row();
        }
    });
    ui.add_space(6.0);
    ui.weak(tr!("mouse-buttons"));
}
