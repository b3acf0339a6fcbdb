//! The panels at the side: what can be set, and what was done.

use std::path::Path;

use eframe::egui::{CollapsingHeader, ComboBox, RichText, ScrollArea, Ui};
use frisure::formats::contents::Contents;
use frisure::scene::HeadSource;

use super::widgets;
use crate::state::{CONTROLS, Choice, Command, Control, Panel, Salon};

/// All of them.
pub(super) fn show(ui: &mut Ui, salon: &Salon, choices: &[Choice], out: &mut Vec<Command>) {
    let Some(understood) = salon.scene() else { return };
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        for panel in Panel::ALL {
            let open = matches!(panel, Panel::Files | Panel::Fibre | Panel::Curl | Panel::Length);
            let header = CollapsingHeader::new(RichText::new(panel.title()).strong());
            header.default_open(open).show(ui, |ui| {
                if panel == Panel::Files {
                    return files(ui, salon, choices, out);
                }
                let groom = salon.files().groom;
                let all = CONTROLS.iter().filter(|control| control.panel == panel);
                let (used, idle): (Vec<&Control>, Vec<&Control>) =
                    all.partition(|control| !groom || control.counts_for_groom());
                let words_count = idle.is_empty();
                for choice in choices.iter().filter(|c| words_count && c.panel == panel) {
                    words(ui, salon, choice, out);
                }
                for control in used {
                    let value = control.value(&understood.scene, &understood.spec);
                    out.extend(widgets::slider(ui, control, value));
                }
                if !idle.is_empty() {
                    ui.weak("The rest is as the groom has it.");
                }
            });
        }
    });
}

/// A list of words.
fn words(ui: &mut Ui, salon: &Salon, choice: &Choice, out: &mut Vec<Command>) {
    let current = salon.document().and_then(|d| frisure_key(d.text(), choice.key));
    let chosen = choice.options.iter().find(|(written, _)| Some(written) == current.as_ref());
    let said = chosen.map_or(choice.usual, |(_, said)| said.as_str());
    ui.horizontal(|ui| {
        let label = ui.label(choice.label).on_hover_text(choice.help);
        let list = ComboBox::from_id_salt(choice.key).selected_text(said).width(150.0);
        let shown = list.show_ui(ui, |ui| {
            let unsaid = choice.panel == Panel::Files;
            if unsaid && ui.selectable_label(current.is_none(), choice.usual).clicked() {
                out.push(Command::Reset(choice.key));
            }
            for (written, said) in &choice.options {
                let on = Some(written) == current.as_ref();
                let option = ui.selectable_label(on, said);
                if option.clicked() && !on {
                    out.push(Command::Word(choice.key, written.clone()));
                }
            }
        });
        shown.response.labelled_by(label.id).on_hover_text(choice.help);
    });
}

/// The value of a key as the text writes it.
fn frisure_key(text: &str, key: &str) -> Option<String> {
    let document: toml_edit::DocumentMut = text.parse().ok()?;
    let item = key.split('.').try_fold(document.as_item(), |item, part| item.get(part))?;
    Some(format!("\"{}\"", item.as_str()?))
}

/// The head and the hair that come from files.
fn files(ui: &mut Ui, salon: &Salon, choices: &[Choice], out: &mut Vec<Command>) {
    let Some(understood) = salon.scene() else { return };
    let scene = &understood.scene;
    let frame = |ui: &mut Ui, table: &str, out: &mut Vec<Command>| {
        let own = choices.iter().filter(|choice| choice.panel == Panel::Files);
        own.filter(|choice| choice.key.starts_with(table)).for_each(|c| words(ui, salon, c, out));
    };
    match &scene.head {
        HeadSource::Mannequin => {
            ui.label("Head: the mannequin.");
        }
        HeadSource::Mesh(file) => {
            named(ui, "Head", &file.path);
            frame(ui, "head.", out);
            if widgets::plain(ui, "Use the mannequin", "").clicked() {
                out.push(Command::Head(None));
            }
        }
    }
    match &scene.groom {
        None => {
            ui.label("Hair: of its own.");
        }
        Some(file) => {
            named(ui, "Hair", &file.path);
            frame(ui, "groom.", out);
            if let Some(held) = salon.shown().and_then(|(hair, _)| hair.adoption.as_ref()) {
                ui.weak(held.to_string());
            }
            let help = "Let fibre, curl, length and implantation make the hair";
            if widgets::plain(ui, "Use hair of its own", help).clicked() {
                out.push(Command::Groom(None));
            }
        }
    }
    if salon.files() != (Contents { head: true, groom: true }) {
        ui.weak("Drop a head or a groom on the window to use it.");
    }
}

/// A file by its name; its path is told where the pointer rests.
fn named(ui: &mut Ui, what: &str, path: &Path) {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    ui.label(format!("{what}: {name}")).on_hover_text(path.display().to_string());
}

/// What was done, the newest last.
pub(super) fn history(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some(document) = salon.document() else { return };
    let compared = salon.compared().map(|c| c.edit);
    ScrollArea::vertical().auto_shrink([false, false]).stick_to_bottom(true).show(ui, |ui| {
        for (index, edit) in document.edits().iter().enumerate() {
            ui.horizontal(|ui| {
                let before = compared == Some(index);
                let compare = ui.selectable_label(before, RichText::new("vs").small());
                let compare = compare.on_hover_text("See it beside the hair as it is now");
                compare.widget_info(|| {
                    let label = format!("Compare with {}", edit.label);
                    let kind = eframe::egui::Role::Button;
                    eframe::egui::WidgetInfo::selected(kind, true, before, label)
                });
                if compare.clicked() {
                    out.push(Command::Compare((!before).then_some(index)));
                }
                let text = RichText::new(&edit.label);
                let text = if index > document.at() { text.weak() } else { text };
                let row = ui.selectable_label(index == document.at(), text);
                if row.clicked() {
                    out.push(Command::GoTo(index));
                }
            });
        }
    });
}
