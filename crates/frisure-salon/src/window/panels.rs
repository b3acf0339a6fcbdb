//! The side panels: controls, files, and the history.

use std::borrow::Cow;
use std::path::Path;

use eframe::egui::{CollapsingHeader, ComboBox, Id, RichText, Role, ScrollArea, Ui, WidgetInfo};
use frisure::formats::contents::Contents;
use frisure::scene::{HeadSource, Panel};

use super::gallery::Pictures;
use super::{lights, sections, widgets};
use crate::locale::{self, tr};
use crate::state::{
    CHOICES, CONTROLS, Choice, Command, Compared, Control, ParsedScene, Salon, panel_title,
};

/// Shows the panels.
pub(super) fn show(ui: &mut Ui, salon: &Salon, pictures: &mut Pictures, out: &mut Vec<Command>) {
    let Some(parsed) = &salon.scene else { return };
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        let header = CollapsingHeader::new(RichText::new(tr!("sections")).strong());
        // In a language that comes later, it is the same header.
        let header = header.id_salt("sections").open(opened(ui, salon));
        header.show(ui, |ui| sections::show(ui, salon, out));
        for panel in Panel::ALL {
            let open = matches!(panel, Panel::Files | Panel::Fibre | Panel::Curl | Panel::Length);
            let header = CollapsingHeader::new(RichText::new(&*panel_title(panel)).strong());
            header.default_open(open).show(ui, |ui| match panel {
                Panel::Files => files(ui, salon, parsed, out),
                panel => controls(ui, salon, parsed, panel, pictures, out),
            });
        }
    });
}

/// Opens the list of the sections when the first one is made.
fn opened(ui: &Ui, salon: &Salon) -> Option<bool> {
    let (id, any) = (Id::unique("has sections"), !salon.sections.is_empty());
    let before = ui.data_mut(|data| std::mem::replace(data.get_temp_mut_or_default(id), any));
    (any && !before).then_some(true)
}

/// The controls of a panel; for a groom only those that apply to it.
fn controls(
    ui: &mut Ui,
    salon: &Salon,
    parsed: &ParsedScene,
    panel: Panel,
    pictures: &mut Pictures,
    out: &mut Vec<Command>,
) {
    let groom = salon.files().groom;
    let all = CONTROLS.iter().filter(|control| control.panel == panel);
    let (used, unused): (Vec<&Control>, Vec<&Control>) =
        all.partition(|control| !groom || control.applies_to_groom());
    if unused.is_empty() {
        for choice in CHOICES.iter().filter(|choice| choice.panel == panel) {
            match choice.key {
                lights::KEY => {
                    let current = current(salon, choice.key);
                    lights::show(ui, choice, current.as_ref(), pictures, out);
                }
                _ => options(ui, salon, choice, out),
            }
        }
    }
    for control in used {
        widgets::slider(ui, control, control.value(&parsed.scene), out);
    }
    if !unused.is_empty() {
        ui.weak(tr!("groom-determines"));
    }
}

/// The list of a choice.
fn options(ui: &mut Ui, salon: &Salon, choice: &Choice, out: &mut Vec<Command>) {
    let current = current(salon, choice.key);
    let selected = choice.options.iter().find(|(written, _)| Some(written) == current.as_ref());
    let default = choice.default();
    let title = selected.map_or(Cow::Borrowed(&*default), |option| choice.title(option));
    let help = choice.help();
    ui.horizontal(|ui| {
        let label = ui.label(&*choice.label()).on_hover_text(&*help);
        let list = ComboBox::from_id_salt(choice.key).selected_text(&*title).width(150.0);
        let shown = list.show_ui(ui, |ui| {
            let has_default = choice.panel == Panel::Files;
            if has_default && ui.selectable_label(current.is_none(), &default).clicked() {
                out.push(Command::Reset(choice.key));
            }
            for option in &choice.options {
                let on = Some(&option.0) == current.as_ref();
                if ui.selectable_label(on, &*choice.title(option)).clicked() && !on {
                    out.push(Command::SetOption(choice.key, option.0.clone()));
                }
            }
        });
        shown.response.labelled_by(label.id).on_hover_text(&*help);
    });
}

/// The option that the scene has for a key, as TOML.
fn current(salon: &Salon, key: &str) -> Option<String> {
    salon.document.as_ref().and_then(|document| string_of(document.text(), key))
}

/// The string of a key in a text, as TOML.
fn string_of(text: &str, key: &str) -> Option<String> {
    let document: toml_edit::DocumentMut = text.parse().ok()?;
    let item = key.split('.').try_fold(document.as_item(), |item, part| item.get(part))?;
    Some(format!("\"{}\"", item.as_str()?))
}

/// The files of the head and the groom.
fn files(ui: &mut Ui, salon: &Salon, parsed: &ParsedScene, out: &mut Vec<Command>) {
    let units = |ui: &mut Ui, table: &str, out: &mut Vec<Command>| {
        let own = CHOICES.iter().filter(|choice| choice.key.starts_with(table));
        own.for_each(|choice| options(ui, salon, choice, out));
    };
    match &parsed.scene.head {
        HeadSource::Mesh(file) => {
            file_name(ui, "head-is", &file.path);
            units(ui, "head.", out);
            if widgets::plain(ui, "use-mannequin").clicked() {
                out.push(Command::Head(None));
            }
        }
        HeadSource::Person { name, face } => {
            let name = locale::named("head", name, name);
            ui.label(tr!("head-is", name = &*name));
            if widgets::plain(ui, "another-face").clicked() {
                out.push(Command::Face(face + 1));
            }
        }
        HeadSource::Mannequin => {
            ui.label(tr!("head-is-mannequin"));
        }
    }
    if let Some(file) = &parsed.scene.groom {
        file_name(ui, "hair-is", &file.path);
        units(ui, "groom.", out);
        if let Some(held) = salon.preview().and_then(|(hair, _)| hair.adoption.as_ref()) {
            ui.weak(held.to_string());
        }
        if widgets::plain(ui, "use-own-hair").clicked() {
            out.push(Command::Groom(None));
        }
    } else {
        ui.label(tr!("hair-is-own"));
    }
    if salon.files() != (Contents { head: true, groom: true }) {
        ui.weak(tr!("drop-head-or-groom"));
    }
}

/// The name of a file, with its path as the tooltip.
fn file_name(ui: &mut Ui, id: &str, path: &Path) {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    ui.label(tr!(id, name = &*name)).on_hover_text(path.display().to_string());
}

/// The edits, the last one at the bottom.
pub(super) fn history(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some(document) = &salon.document else { return };
    let compared = salon.comparison.as_ref().map(|c| c.of);
    ScrollArea::vertical().auto_shrink([false, false]).stick_to_bottom(true).show(ui, |ui| {
        for (index, edit) in document.edits().iter().enumerate() {
            ui.horizontal(|ui| {
                let on = compared == Some(Compared::Edit(index));
                let compare = ui.selectable_label(on, RichText::new(tr!("versus")).small());
                let compare = compare.on_hover_text(tr!("versus.help"));
                compare.widget_info(|| {
                    let label = tr!("compare-with", label = &*edit.label);
                    WidgetInfo::selected(Role::Button, true, on, label)
                });
                if compare.clicked() {
                    out.push(Command::Compare((!on).then_some(index)));
                }
                let text = RichText::new(&edit.label);
                let text = if index > document.at() { text.weak() } else { text };
                if ui.selectable_label(index == document.at(), text).clicked() {
                    out.push(Command::GoTo(index));
                }
            });
        }
    });
}
