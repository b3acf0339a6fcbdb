//! The list of the sections, as of the layers of a picture: an eye, a lock and a name for each.

use eframe::egui::{Id, Key, Role, TextEdit, Ui, WidgetInfo};

use super::{icons, widgets};
use crate::locale::tr;
use crate::state::{Command, Salon, Section};

/// Shows the list, and what makes a section.
pub(super) fn show(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    for (index, section) in salon.sections.iter().enumerate() {
        ui.horizontal(|ui| row(ui, salon, index, section, out));
    }
    if salon.sections.is_empty() {
        ui.weak(tr!("sections-hint"));
    }
    if widgets::with_icon(ui, icons::SECTION, "add-section").clicked() {
        out.push(Command::AddSection);
    }
}

fn row(ui: &mut Ui, salon: &Salon, index: usize, section: &Section, out: &mut Vec<Command>) {
    let Section { name, hidden, locked, .. } = section;
    let toggle = |ui: &mut Ui, icon, id: &str, on: bool| {
        let label = tr!(id, name = name.as_str());
        let response = ui.selectable_label(on, icon).on_hover_text(tr!(&format!("{id}.help")));
        response.widget_info(|| WidgetInfo::selected(Role::Button, true, on, &label));
        response.clicked()
    };
    let eye = if *hidden { icons::HIDDEN } else { icons::SHOWN };
    if toggle(ui, eye, "section-eye", *hidden) {
        out.push(Command::HideSection(index, !hidden));
    }
    let lock = if *locked { icons::LOCKED } else { icons::UNLOCKED };
    if toggle(ui, lock, "section-lock", *locked) {
        out.push(Command::LockSection(index, !locked));
    }
    let on = salon.selected.label == *name;
    if on {
        // The selected one can be given another name.
        rename(ui, index, name, out);
    } else {
        let label = match section.count() {
            Some(count) => tr!("selected-count", label = name.as_str(), count = count),
            None => name.clone(),
        };
        let response = ui.selectable_label(false, label).on_hover_text(tr!("section-select"));
        if response.clicked() {
            out.push(Command::SelectSection(index, widgets::select_mode(ui)));
        }
    }
    let delete = ui.small_button(icons::DELETE).on_hover_text(tr!("section-delete-help"));
    delete.widget_info(|| {
        WidgetInfo::labeled(Role::Button, true, tr!("section-delete", name = name.as_str()))
    });
    if delete.clicked() {
        out.push(Command::RemoveSection(index));
    }
}

/// A field for the name of a section: what is typed is kept until Enter, or until the field loses the focus.
fn rename(ui: &mut Ui, index: usize, name: &str, out: &mut Vec<Command>) {
    let id = Id::unique(("section", index, name));
    let mut text = ui.data_mut(|data| data.get_temp::<String>(id)).unwrap_or_else(|| name.into());
    let field = ui.add(TextEdit::singleline(&mut text).desired_width(130.0).char_limit(60));
    field.widget_info(|| WidgetInfo::labeled(Role::TextInput, true, tr!("section-new-name")));
    if field.lost_focus() {
        ui.data_mut(|data| data.remove_temp::<String>(id));
        if !ui.input(|i| i.key_pressed(Key::Escape)) {
            out.push(Command::RenameSection(index, text));
        }
    } else if field.changed() {
        ui.data_mut(|data| data.insert_temp(id, text));
    }
}
