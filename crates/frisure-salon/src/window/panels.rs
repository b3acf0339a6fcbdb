//! The side panels: controls, files, and the history.

use std::path::Path;

use eframe::egui::{CollapsingHeader, ComboBox, RichText, Role, ScrollArea, Ui, WidgetInfo};
use frisure::formats::contents::Contents;
use frisure::scene::{HeadSource, Panel};

use super::widgets;
use crate::state::{CHOICES, CONTROLS, Choice, Command, Control, ParsedScene, Salon};

/// Shows the panels.
pub(super) fn show(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some(parsed) = &salon.scene else { return };
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        for panel in Panel::ALL {
            let open = matches!(panel, Panel::Files | Panel::Fibre | Panel::Curl | Panel::Length);
            let header = CollapsingHeader::new(RichText::new(panel.title()).strong());
            header.default_open(open).show(ui, |ui| match panel {
                Panel::Files => files(ui, salon, parsed, out),
                panel => controls(ui, salon, parsed, panel, out),
            });
        }
    });
}

/// The controls of a panel; for a groom only those that apply to it.
fn controls(
    ui: &mut Ui,
    salon: &Salon,
    parsed: &ParsedScene,
    panel: Panel,
    out: &mut Vec<Command>,
) {
    let groom = salon.files().groom;
    let all = CONTROLS.iter().filter(|control| control.panel == panel);
    let (used, unused): (Vec<&Control>, Vec<&Control>) =
        all.partition(|control| !groom || control.applies_to_groom());
    if unused.is_empty() {
        CHOICES.iter().filter(|c| c.panel == panel).for_each(|c| options(ui, salon, c, out));
    }
    for control in used {
        widgets::slider(ui, control, control.value(&parsed.scene), out);
    }
    if !unused.is_empty() {
        ui.weak("The groom determines the other parameters.");
    }
}

/// The list of a choice.
fn options(ui: &mut Ui, salon: &Salon, choice: &Choice, out: &mut Vec<Command>) {
    let current = salon.document.as_ref().and_then(|d| string_of(d.text(), choice.key));
    let selected = choice.options.iter().find(|(written, _)| Some(written) == current.as_ref());
    let title = selected.map_or(choice.default, |(_, title)| *title);
    ui.horizontal(|ui| {
        let label = ui.label(choice.label).on_hover_text(choice.help);
        let list = ComboBox::from_id_salt(choice.key).selected_text(title).width(150.0);
        let shown = list.show_ui(ui, |ui| {
            let has_default = choice.panel == Panel::Files;
            if has_default && ui.selectable_label(current.is_none(), choice.default).clicked() {
                out.push(Command::Reset(choice.key));
            }
            for (written, title) in &choice.options {
                let on = Some(written) == current.as_ref();
                if ui.selectable_label(on, *title).clicked() && !on {
                    out.push(Command::SetOption(choice.key, written.clone()));
                }
            }
        });
        shown.response.labelled_by(label.id).on_hover_text(choice.help);
    });
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
            file_name(ui, "Head", &file.path);
            units(ui, "head.", out);
            if widgets::plain(ui, "Use the mannequin", "").clicked() {
                out.push(Command::Head(None));
            }
        }
        HeadSource::Person(name) => {
            ui.label(format!("Head: {name}"));
        }
        HeadSource::Mannequin => {
            ui.label("Head: the mannequin");
        }
    }
    if let Some(file) = &parsed.scene.groom {
        file_name(ui, "Hair", &file.path);
        units(ui, "groom.", out);
        if let Some(held) = salon.preview().and_then(|(hair, _)| hair.adoption.as_ref()) {
            ui.weak(held.to_string());
        }
        let help = "Compute the hair from fibre, curl, length and implantation";
        if widgets::plain(ui, "Use the scene's own hair", help).clicked() {
            out.push(Command::Groom(None));
        }
    } else {
        ui.label("Hair: the scene's own");
    }
    if salon.files() != (Contents { head: true, groom: true }) {
        ui.weak("Drop a head or a groom on the window to use it.");
    }
}

/// The name of a file, with its path as the tooltip.
fn file_name(ui: &mut Ui, what: &str, path: &Path) {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    ui.label(format!("{what}: {name}")).on_hover_text(path.display().to_string());
}

/// The edits, the last one at the bottom.
pub(super) fn history(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some(document) = &salon.document else { return };
    let compared = salon.comparison.as_ref().map(|c| c.edit);
    ScrollArea::vertical().auto_shrink([false, false]).stick_to_bottom(true).show(ui, |ui| {
        for (index, edit) in document.edits().iter().enumerate() {
            ui.horizontal(|ui| {
                let on = compared == Some(index);
                let compare = ui.selectable_label(on, RichText::new("vs").small());
                let compare = compare.on_hover_text("Show it beside the current hair");
                compare.widget_info(|| {
                    let label = format!("Compare with {}", edit.label);
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
