//! The toolbars: files and edits, selection, and the status line.

use eframe::egui::{Align, ComboBox, Layout, ProgressBar, Role, Theme, Ui, WidgetInfo};
use frisure::hairstyle::styling::{Grow, Growth, Operation, Release, Selection};

use super::dialogs::Dialog;
use super::widgets::Room;
use super::{icons, theme, widgets};
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
                right(ui, dialog);
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
            let help = "sliders and history";
            let room = Room::Wide;
            if widgets::fitting_toggle(ui, room, icons::SETTINGS, ("Panels", *side), help).clicked()
            {
                *side = !*side;
            }
        }
        right(ui, dialog);
    });
}

fn left(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>, dialog: &mut Option<Dialog>) {
    let (open, help) = (salon.is_gallery(), "hair to start with");
    let gallery = ("Gallery", open);
    if widgets::fitting_toggle(ui, Room::Wide, icons::GALLERY, gallery, help).clicked() {
        out.push(Command::Gallery(!open));
    }
    let dialogs = [
        (Dialog::Open, icons::OPEN, "Open…", "Open a scene, a head or a groom (Ctrl O)"),
        (Dialog::Save, icons::SAVE, "Save…", "Save the scene (Ctrl S)"),
        (Dialog::Export, icons::EXPORT, "Export…", "Write the hair as a groom (Ctrl E)"),
        (
            Dialog::Picture,
            icons::PICTURE,
            "Picture…",
            "Render a final picture or a turntable (Ctrl P)",
        ),
    ];
    for (which, icon, label, help) in dialogs {
        let enabled = salon.document.is_some() || !which.needs_document();
        ui.add_enabled_ui(enabled, |ui| {
            if widgets::fitting(ui, Room::Wide, icon, label, help).clicked() {
                *dialog = Some(which);
            }
        });
    }
    ui.separator();
    if let Some(document) = salon.document.as_ref().filter(|_| !salon.is_gallery()) {
        edits(ui, salon, document, out);
    }
}

fn right(ui: &mut Ui, dialog: &mut Option<Dialog>) {
    if widgets::icon(ui, icons::HELP, "Help", "keys and tools (F1)").clicked() {
        *dialog = Some(Dialog::Help);
    }
    let dark = ui.visuals().dark_mode;
    let (icon, other) = if dark { (icons::LIGHT, "Light") } else { (icons::DARK, "Dark") };
    if widgets::icon(ui, icon, other, "a light or a dark window").clicked() {
        ui.ctx().set_theme(if dark { Theme::Light } else { Theme::Dark });
    }
}

fn edits(ui: &mut Ui, salon: &Salon, document: &Document, out: &mut Vec<Command>) {
    let (at, edits) = (document.at(), document.edits().len());
    let moves = [
        (icons::UNDO, "Undo", "Ctrl Z", at > 0, Command::Undo),
        (icons::REDO, "Redo", "Ctrl Shift Z", at + 1 < edits, Command::Redo),
    ];
    for (icon, label, help, enabled, command) in moves {
        ui.add_enabled_ui(enabled, |ui| {
            if widgets::icon(ui, icon, label, help).clicked() {
                out.push(command);
            }
        });
    }
    ui.separator();
    let (icon, label) = if salon.is_wet() { (icons::DRY, "Dry") } else { (icons::WET, "Wet") };
    if widgets::fitting(ui, Room::Narrow, icon, label, "Wet or dry the selected hair (W)").clicked()
    {
        out.push(Command::ToggleWet);
    }
    let help = "Grow the selected hair (G)";
    if widgets::fitting(ui, Room::Wide, icons::GROW, "Grow a month", help).clicked() {
        out.push(grow_a_month());
    }
    let compared = salon.comparison.is_some();
    let help = "The hair before the last edit and now, side by side (X)";
    let compare = ("Compare", compared);
    if widgets::fitting_toggle(ui, Room::Wide, icons::COMPARE, compare, help).clicked() {
        out.push(Command::ToggleCompare);
    }
    let help = "Do each step on the other side of the head, too (M)";
    let mirror = ("Mirror", salon.mirror);
    if widgets::fitting_toggle(ui, Room::Wide, icons::MIRROR, mirror, help).clicked() {
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
        ui.strong("Selected:");
        let selected = &salon.selected;
        ui.label(match selected.count() {
            Some(count) => format!("{} ({count} wisps)", selected.label),
            None => selected.label.clone(),
        });
        let all = selected.is_everything();
        if widgets::icon_toggle(ui, icons::ALL, "All", all, "Select all hair (A)").clicked() {
            out.push(Command::SelectAll);
        }
        let help = "Select the hair that is not selected (I)";
        if widgets::with_icon(ui, icons::INVERT, "Invert", help).clicked() {
            out.push(Command::InvertSelection);
        }
        for (label, place) in PLACES {
            let help = "Select this part of the scalp. Shift adds, Alt removes.";
            if widgets::plain(ui, label, help).clicked() {
                out.push(Command::Select(place, mode));
            }
        }
        ui.separator();
        operations(ui, out);
    });
}

fn operations(ui: &mut Ui, out: &mut Vec<Command>) {
    let list =
        ComboBox::from_id_salt("hold").selected_text(format!("{} Hold…", icons::HOLD)).width(80.0);
    let shown = list.show_ui(ui, |ui| {
        for button in frisure::scene::buttons() {
            if ui.selectable_label(false, button.label).clicked() {
                out.push(Command::Apply(button.operation()));
            }
        }
    });
    shown.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Hold"));
    if widgets::with_icon(ui, icons::RELEASE, "Release", "Release held hair (R)").clicked() {
        out.push(release());
    }
    if widgets::plain(ui, "Grow 1 cm", "Grow the selected hair").clicked() {
        out.push(grow(Growth::By(0.01)));
    }
}

/// The status line: messages, numbers of the hair, and the background job.
pub(super) fn status(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    for (index, message) in salon.messages.iter().enumerate().rev().take(2) {
        ui.horizontal_wrapped(|ui| {
            if ui.small_button("×").on_hover_text("Dismiss").clicked() {
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
            ui.weak(format!(
                "{wisps} wisps · {hairs:.0} hairs · {length:.1} cm mean · {mass:.0} g"
            ));
        }
        if let Some((stage, done, waiting)) = salon.background() {
            ui.separator();
            let text = format!("{stage} {:.0} %", done * 100.0);
            ui.add(ProgressBar::new(done).text(text).desired_width(220.0));
            if waiting > 0 {
                ui.weak(format!("{waiting} more"));
            }
            if widgets::plain(ui, "Stop", "Cancel the background jobs").clicked() {
                out.push(Command::Stop);
            }
        }
    });
}
