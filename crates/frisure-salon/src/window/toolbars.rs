//! The toolbars: files and edits, selection, and the status line.

use eframe::egui::{Align, ComboBox, Layout, ProgressBar, RichText, Role, Theme, Ui, WidgetInfo};
use frisure::hairstyle::styling::{Grow, Growth, Operation, Release, Selection};

use super::dialogs::Dialog;
use super::widgets::Room;
use super::{icons, theme, widgets};
use crate::locale::{self, Locale, tr};
use crate::state::{Command, Document, PLACES, Salon};

/// The top toolbar: in a narrow window in as many rows as it takes. `side` says whether the panels are open, where they take the
/// place of the picture.
pub(super) fn main(
    ui: &mut Ui,
    salon: &Salon,
    side: &mut bool,
    out: &mut Vec<Command>,
    dialog: &mut Option<Dialog>,
) {
    if Room::of(ui) == Room::Wide {
        ui.horizontal_centered(|ui| {
            left(ui, salon, out, dialog);
            ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
                right(ui, out, dialog);
                if let Some(document) = &salon.document {
                    let changed = if document.is_changed() { " •" } else { "" };
                    ui.weak(format!("{}{changed}", document.name()));
                }
            });
        });
        return;
    }
    ui.horizontal_wrapped(|ui| {
        left(ui, salon, out, dialog);
        if Room::of(ui) == Room::Phone && salon.document.is_some() {
            let panels = "panels";
            if widgets::fitting_toggle(ui, Room::Wide, icons::SETTINGS, panels, *side).clicked() {
                *side = !*side;
            }
        }
        right(ui, out, dialog);
    });
}

fn left(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>, dialog: &mut Option<Dialog>) {
    let open = salon.is_gallery();
    if widgets::fitting_toggle(ui, Room::Wide, icons::GALLERY, "gallery", open).clicked() {
        out.push(Command::Gallery(!open));
    }
    let dialogs = [
        (Dialog::Open, icons::OPEN, "open"),
        (Dialog::Save, icons::SAVE, "save"),
        (Dialog::Export, icons::EXPORT, "export"),
        (Dialog::Picture, icons::PICTURE, "picture"),
    ];
    for (which, icon, id) in dialogs {
        let enabled = salon.document.is_some() || !which.needs_document();
        ui.add_enabled_ui(enabled, |ui| {
            if widgets::fitting(ui, Room::Wide, icon, id).clicked() {
                *dialog = Some(which);
            }
        });
    }
    ui.separator();
    if let Some(document) = salon.document.as_ref().filter(|_| !salon.is_gallery()) {
        edits(ui, salon, document, out);
    }
}

fn right(ui: &mut Ui, out: &mut Vec<Command>, dialog: &mut Option<Dialog>) {
    if widgets::icon(ui, icons::HELP, "help").clicked() {
        *dialog = Some(Dialog::Help);
    }
    let menu = ui.menu_button(RichText::new(icons::LANGUAGE).size(16.0), |ui| {
        for locale in Locale::ALL {
            if ui.selectable_label(locale::current() == locale, locale.endonym()).clicked() {
                out.push(Command::Speak(locale));
                ui.close();
            }
        }
    });
    let menu =
        menu.response.on_hover_text(format!("{}: {}", tr!("language"), tr!("language.help")));
    menu.widget_info(|| WidgetInfo::labeled(Role::Button, true, tr!("language")));
    let dark = ui.visuals().dark_mode;
    let (icon, other) =
        if dark { (icons::LIGHT, "theme-light") } else { (icons::DARK, "theme-dark") };
    if widgets::icon(ui, icon, other).clicked() {
        ui.ctx().set_theme(if dark { Theme::Light } else { Theme::Dark });
    }
}

fn edits(ui: &mut Ui, salon: &Salon, document: &Document, out: &mut Vec<Command>) {
    let (at, edits) = (document.at(), document.edits().len());
    let moves = [
        (icons::UNDO, "undo", at > 0, Command::Undo),
        (icons::REDO, "redo", at + 1 < edits, Command::Redo),
    ];
    for (icon, id, enabled, command) in moves {
        ui.add_enabled_ui(enabled, |ui| {
            if widgets::icon(ui, icon, id).clicked() {
                out.push(command);
            }
        });
    }
    ui.separator();
    let (icon, id) = if salon.is_wet() { (icons::DRY, "dry") } else { (icons::WET, "wet") };
    if widgets::fitting(ui, Room::Narrow, icon, id).clicked() {
        out.push(Command::ToggleWet);
    }
    if widgets::fitting(ui, Room::Wide, icons::GROW, "grow-month").clicked() {
        out.push(grow_a_month());
    }
    let compared = salon.comparison.is_some();
    if widgets::fitting_toggle(ui, Room::Wide, icons::COMPARE, "compare", compared).clicked() {
        out.push(Command::ToggleCompare);
    }
    if widgets::fitting_toggle(ui, Room::Wide, icons::MIRROR, "mirror", salon.mirror).clicked() {
        out.push(Command::ToggleMirror);
    }
}

/// Grows the selected hair by a mean month.
pub(super) fn grow_a_month() -> Command {
    /// Mean length of a month (s).
    const MONTH: f64 = 365.2425 / 12.0 * 86_400.0;
    grow(Growth::For(MONTH))
}

fn grow(amount: Growth) -> Command {
    let selection = Selection::Everything;
    Command::Apply(Operation::Grow(Grow { selection, amount, stages: 1 }))
}

/// Releases the selected hair.
pub(super) fn release() -> Command {
    Command::Apply(Operation::Release(Release { selection: Selection::Everything }))
}

/// The selection, and the operations on it.
pub(super) fn selection(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let mode = widgets::select_mode(ui);
    ui.horizontal_wrapped(|ui| {
        ui.strong(tr!("selected"));
        let selected = &salon.selected;
        ui.label(match selected.count() {
            Some(count) => tr!("selected-count", label = &*selected.label, count = count),
            None => selected.label.clone(),
        });
        let all = selected.is_everything();
        if widgets::icon_toggle(ui, icons::ALL, "select-all", all).clicked() {
            out.push(Command::SelectAll);
        }
        if widgets::with_icon(ui, icons::INVERT, "select-invert").clicked() {
            out.push(Command::InvertSelection);
        }
        for (id, place) in PLACES {
            if widgets::button(ui, &tr!(id), &tr!("place.help")).clicked() {
                out.push(Command::Select(place, mode));
            }
        }
        ui.separator();
        operations(ui, out);
    });
}

fn operations(ui: &mut Ui, out: &mut Vec<Command>) {
    let list = ComboBox::from_id_salt("hold")
        .selected_text(format!("{} {}…", icons::HOLD, tr!("hold")))
        .width(80.0);
    let shown = list.show_ui(ui, |ui| {
        for button in frisure::scene::buttons() {
            let label = locale::named("button", button.label, button.label);
            if ui.selectable_label(false, &*label).clicked() {
                out.push(Command::Apply(button.operation()));
            }
        }
    });
    shown.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, tr!("hold")));
    if widgets::with_icon(ui, icons::RELEASE, "release").clicked() {
        out.push(release());
    }
    if widgets::plain(ui, "grow-cm").clicked() {
        out.push(grow(Growth::By(0.01)));
    }
}

/// The status line: messages, numbers of the hair, and the background job.
pub(super) fn status(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    for (index, message) in salon.messages.iter().enumerate().rev().take(2) {
        ui.horizontal_wrapped(|ui| {
            if ui.small_button("×").on_hover_text(tr!("dismiss")).clicked() {
                out.push(Command::Dismiss(index));
            }
            let colour =
                if message.is_error { theme::CUT_COLOUR } else { ui.visuals().text_color() };
            ui.colored_label(colour, &message.text);
            if !message.hint.is_empty() {
                ui.weak(&message.hint);
            }
        });
    }
    ui.horizontal(|ui| {
        if let Some((hair, _)) = salon.preview() {
            let n = &hair.numbers;
            let (length, mass) = (n.length * 100.0, n.mass * 1e3);
            let (wisps, hairs) = (n.wisps, n.hairs);
            ui.weak(tr!(
                "status-hair",
                wisps = wisps,
                hairs = format!("{hairs:.0}"),
                length = format!("{length:.1}"),
                mass = format!("{mass:.0}"),
            ));
        }
        if let Some((stage, done, waiting)) = salon.background() {
            ui.separator();
            let stage = locale::named("stage", stage, stage);
            let text = format!("{stage} {:.0} %", done * 100.0);
            ui.add(ProgressBar::new(done).text(text).desired_width(220.0));
            if waiting > 0 {
                ui.weak(tr!("jobs-waiting", count = waiting));
            }
            if widgets::plain(ui, "stop").clicked() {
                out.push(Command::Stop);
            }
        }
    });
}
