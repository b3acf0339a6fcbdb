//! The toolbars: files and edits, tools, selection, and the status line.

use eframe::egui::{
    Align, Button, ComboBox, DragValue, Layout, ProgressBar, RichText, Role, Slider, Theme, Ui,
    WidgetInfo, vec2,
};
use frisure::hairstyle::Comb as Side;
use frisure::hairstyle::styling::{Direction, Grow, Growth, Operation, Release, Selection};
use glam::DVec3;

use super::dialogs::Dialog;
use super::{theme, widgets};
use crate::state::{Command, CutHold, Document, PLACES, Salon, Tool, VIEWS, comb};

/// The top toolbar.
pub(super) fn main(
    ui: &mut Ui,
    salon: &Salon,
    out: &mut Vec<Command>,
    dialog: &mut Option<Dialog>,
) {
    ui.horizontal_centered(|ui| {
        if widgets::toggle(ui, "Gallery", salon.is_gallery(), "Hair to start with").clicked() {
            out.push(Command::Gallery(!salon.is_gallery()));
        }
        let dialogs = [
            (Dialog::Open, "Open…", "Open a scene, a head or a groom (Ctrl O)"),
            (Dialog::Save, "Save…", "Save the scene (Ctrl S)"),
            (Dialog::Export, "Export…", "Write the hair as a groom (Ctrl E)"),
            (Dialog::Picture, "Picture…", "Render a final picture or a turntable (Ctrl P)"),
        ];
        for (which, label, help) in dialogs {
            let enabled = salon.document.is_some() || !which.needs_document();
            if widgets::enabled(ui, enabled, label, help) {
                *dialog = Some(which);
            }
        }
        ui.separator();
        if let Some(document) = salon.document.as_ref() {
            ui.add_enabled_ui(!salon.is_gallery(), |ui| edits(ui, salon, document, out));
        }
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            if widgets::plain(ui, "Help", "Keys and tools (F1)").clicked() {
                *dialog = Some(Dialog::Help);
            }
            let dark = ui.visuals().dark_mode;
            let other = if dark { "Light" } else { "Dark" };
            if widgets::plain(ui, other, "A light or a dark window").clicked() {
                ui.ctx().set_theme(if dark { Theme::Light } else { Theme::Dark });
            }
            if let Some(document) = &salon.document {
                let changed = if document.is_changed() { " •" } else { "" };
                ui.weak(format!("{}{changed}", document.name()));
            }
        });
    });
}

fn edits(ui: &mut Ui, salon: &Salon, document: &Document, out: &mut Vec<Command>) {
    if widgets::enabled(ui, document.at() > 0, "Undo", "Ctrl Z") {
        out.push(Command::Undo);
    }
    if widgets::enabled(ui, document.at() + 1 < document.edits().len(), "Redo", "Ctrl Shift Z") {
        out.push(Command::Redo);
    }
    ui.separator();
    let text = RichText::new(if salon.is_wet() { "Dry" } else { "Wet" }).strong().size(16.0);
    let button = Button::new(text).min_size(vec2(64.0, 28.0));
    if ui.add(button).on_hover_text("Wet or dry the selected hair (W)").clicked() {
        out.push(Command::ToggleWet);
    }
    if widgets::plain(ui, "Grow a month", "Grow the selected hair (G)").clicked() {
        out.push(grow_a_month());
    }
    let compared = salon.comparison.is_some();
    let help = "The hair before the last edit and now, side by side (X)";
    if widgets::toggle(ui, "Compare", compared, help).clicked() {
        out.push(Command::ToggleCompare);
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

/// The tools, and the settings of the active one.
pub(super) fn tools(ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        let tools = [
            (Tool::Orbit, "Turn", "V: orbit, pan and zoom"),
            (Tool::Lasso, "Lasso", "L: draw around hair to select it"),
            (Tool::Brush, "Brush", "B: paint over the scalp to select hair by its roots"),
            (Tool::Cut, "Cut", "C: drag a cutting plane"),
            (Tool::Comb, "Comb", "K: drag in the direction of combing"),
            (Tool::Pick, "One hair", "H: click to see one hair with its material frames"),
        ];
        for (tool, label, help) in tools {
            if widgets::toggle(ui, label, salon.tool == tool, help).clicked() {
                out.push(Command::Take(tool));
            }
        }
        ui.separator();
        match salon.tool {
            Tool::Cut => cut(ui, salon, out),
            Tool::Brush => brush(ui, salon, out),
            Tool::Comb => {
                brush(ui, salon, out);
                sides(ui, out);
            }
            Tool::Pick => one_hair(ui, salon, out),
            Tool::Lasso => {
                ui.weak("Draw around hair. Shift adds, Alt removes.");
            }
            Tool::Orbit => views(ui, out),
        }
    });
}

fn views(ui: &mut Ui, out: &mut Vec<Command>) {
    for (label, azimuth, elevation) in VIEWS {
        if widgets::plain(ui, label, "Set this view").clicked() {
            out.push(Command::LookFrom(f64::to_radians(azimuth), f64::to_radians(elevation)));
        }
    }
    if widgets::plain(ui, "Keep this view", "Save the view as the scene's camera").clicked() {
        out.push(Command::KeepView);
    }
}

fn cut(ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    let mut plane = salon.plane;
    let mut height = plane.point.z * 100.0;
    let field = DragValue::new(&mut height).range(-150.0..=20.0).suffix(" cm").max_decimals(1);
    if widgets::labelled(ui, "Height", field.speed(0.1)).changed() {
        plane.point = DVec3::new(0.0, 0.0, height / 100.0);
    }
    for (label, angle) in [("to its left", &mut plane.roll), ("to the back", &mut plane.pitch)] {
        let mut degrees = angle.to_degrees();
        let field = DragValue::new(&mut degrees).range(-80.0..=80.0).suffix("°").max_decimals(0);
        if widgets::labelled(ui, label, field).changed() {
            *angle = degrees.to_radians();
        }
    }
    let mut down = plane.held == CutHold::Down;
    let help = "Comb each hair straight down before the cut, as in the paper";
    if ui.checkbox(&mut down, "combed down").on_hover_text(help).changed() {
        plane.held = if down { CutHold::Down } else { CutHold::Hanging };
    }
    if widgets::plain(ui, "Level", "Make the plane level").clicked() {
        (plane.roll, plane.pitch) = (0.0, 0.0);
    }
    if plane != salon.plane {
        out.push(Command::Plane(plane));
    }
    let preview = salon.cut_preview();
    ui.add_enabled_ui(preview.as_ref().is_some_and(|preview| preview.hairs > 0), |ui| {
        let button = Button::new(RichText::new("Cut here").strong()).fill(theme::CUT_COLOUR);
        if ui.add(button).on_hover_text("Enter").clicked() {
            out.push(Command::Cut);
        }
    });
    if let (Some(preview), Some((hair, _))) = (preview, salon.preview()) {
        let grams = preview.share * hair.numbers.mass * 1e3;
        let part = preview.hairs as f64 / hair.numbers.drawn.max(1) as f64 * 100.0;
        ui.label(format!("{part:.0} % of the hairs lose {grams:.1} g"));
    }
}

fn brush(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let mut radius = salon.brush.radius * 100.0;
    let slider = Slider::new(&mut radius, 0.2..=6.0).suffix(" cm").max_decimals(1);
    if widgets::labelled(ui, "Radius", slider).changed() {
        out.push(Command::BrushSize(radius / 100.0));
    }
}

fn sides(ui: &mut Ui, out: &mut Vec<Command>) {
    let sides = [
        ("Forward", Side::Forward),
        ("Back", Side::Back),
        ("Down", Side::Down),
        ("Left", Side::Left),
        ("Right", Side::Right),
    ];
    for (label, side) in sides {
        if widgets::plain(ui, label, "Comb the selected hair to this side").clicked() {
            out.push(Command::Apply(comb(Direction::Named(side))));
        }
    }
}

fn one_hair(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some((hair, _)) = salon.preview() else { return };
    let last = hair.numbers.wisps.saturating_sub(1);
    let mut wisp = salon.isolated.as_ref().map_or(0, |isolated| isolated.wisp);
    if widgets::labelled(ui, "Wisp", DragValue::new(&mut wisp).range(0..=last)).changed() {
        out.push(Command::Isolate(Some(wisp)));
    }
    if salon.isolated.is_none() {
        ui.weak("Click on the head, or enter an index.");
    } else if widgets::plain(ui, "All hair", "Show all hair").clicked() {
        out.push(Command::Isolate(None));
    }
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
        if widgets::toggle(ui, "All", all, "Select all hair (A)").clicked() {
            out.push(Command::SelectAll);
        }
        if widgets::plain(ui, "Invert", "Select the hair that is not selected (I)").clicked() {
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
    let list = ComboBox::from_id_salt("hold").selected_text("Hold…").width(80.0);
    let shown = list.show_ui(ui, |ui| {
        for button in frisure::scene::buttons() {
            if ui.selectable_label(false, button.label).clicked() {
                out.push(Command::Apply(button.operation()));
            }
        }
    });
    shown.response.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Hold"));
    if widgets::plain(ui, "Release", "Release held hair (R)").clicked() {
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
