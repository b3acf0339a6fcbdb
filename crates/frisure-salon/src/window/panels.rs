//! The panels at the side: what can be set, and what was done.

use eframe::egui::{CollapsingHeader, ComboBox, RichText, ScrollArea, Ui};

use super::widgets;
use crate::state::{CONTROLS, Choice, Command, Panel, Salon};

/// All of them.
pub(super) fn show(ui: &mut Ui, salon: &Salon, choices: &[Choice], out: &mut Vec<Command>) {
    let Some(understood) = salon.scene() else { return };
    ScrollArea::vertical().auto_shrink([false, false]).show(ui, |ui| {
        for panel in Panel::ALL {
            let open = matches!(panel, Panel::Fibre | Panel::Curl | Panel::Length);
            let header = CollapsingHeader::new(RichText::new(panel.title()).strong());
            header.default_open(open).show(ui, |ui| {
                for choice in choices.iter().filter(|choice| choice.panel == panel) {
                    words(ui, salon, choice, out);
                }
                for control in CONTROLS.iter().filter(|control| control.panel == panel) {
                    let value = control.value(&understood.scene, &understood.spec);
                    out.extend(widgets::slider(ui, control, value));
                }
                if panel == Panel::Implantation {
                    head(ui, salon, out);
                }
            });
        }
    });
}

/// A list of words.
fn words(ui: &mut Ui, salon: &Salon, choice: &Choice, out: &mut Vec<Command>) {
    let current = salon.document().and_then(|d| frisure_key(d.text(), choice.key));
    let chosen = choice.options.iter().find(|(written, _)| Some(written) == current.as_ref());
    let said = chosen.map_or("as usual", |(_, said)| said.as_str());
    ui.horizontal(|ui| {
        let label = ui.label(choice.label).on_hover_text(choice.help);
        let list = ComboBox::from_id_salt(choice.key).selected_text(said).width(150.0);
        let shown = list.show_ui(ui, |ui| {
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

fn head(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some(understood) = salon.scene() else { return };
    let mesh = match &understood.scene.head {
        frisure::io::scene::HeadSource::Mannequin => None,
        frisure::io::scene::HeadSource::Mesh(file) => Some(file.path.display().to_string()),
    };
    ui.separator();
    match mesh {
        None => {
            ui.label("Head: the mannequin.");
            ui.weak("Drop an .obj mesh on the window to use another.");
        }
        Some(path) => {
            ui.label(format!("Head: {path}"));
            if widgets::plain(ui, "Use the mannequin", "").clicked() {
                out.push(Command::Head(None));
            }
        }
    }
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
