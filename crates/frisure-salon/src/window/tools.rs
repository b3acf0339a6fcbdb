//! The tools, and the settings of the active one.

use eframe::egui::{Button, ComboBox, DragValue, RichText, Role, TextWrapMode, Ui, WidgetInfo};
use frisure::hairstyle::Comb as Side;
use frisure::hairstyle::styling::Direction;
use glam::DVec3;

use super::widgets::Room;
use super::{icons, theme, widgets};
use crate::state::{Command, CutHold, Salon, Scissors, Tool, VIEWS, comb};

/// The tools: each with its icon, its label, and its key with what it does.
const TOOLS: [(Tool, &str, &str, &str); 9] = [
    (Tool::Orbit, icons::TURN, "Turn", "V: orbit, pan and zoom"),
    (Tool::Lasso, icons::LASSO, "Lasso", "L: draw around hair to select it"),
    (Tool::Brush, icons::BRUSH, "Brush", "B: paint over the scalp to select hair by its roots"),
    (Tool::Scissors, icons::SCISSORS, "Scissors", "S: draw across hair, which is cut there"),
    (Tool::Cut, icons::CUT, "Cut", "C: drag a cutting plane through the selected hair"),
    (Tool::Lift, icons::LIFT, "Lift", "U: paint over the scalp; hair is lifted off it and cut"),
    (
        Tool::Clippers,
        icons::CLIPPERS,
        "Clippers",
        "J: paint over the scalp; a guard says what is left",
    ),
    (Tool::Comb, icons::COMB, "Comb", "K: drag in the direction of combing"),
    (Tool::Pick, icons::ONE_HAIR, "One hair", "H: click to see one hair with its material frames"),
];

/// The tools, and the settings of the active one.
pub(super) fn show(ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (tool, icon, label, help) in TOOLS {
            let named = (label, salon.tool == tool);
            if widgets::fitting_toggle(ui, Room::Narrow, icon, named, help).clicked() {
                out.push(Command::Take(tool));
            }
        }
        if Room::of(ui) == Room::Wide {
            ui.separator();
        } else {
            // A narrow window has the settings in rows of their own.
            ui.end_row();
        }
        // What is left of a row must not break words.
        ui.style_mut().wrap_mode = Some(TextWrapMode::Extend);
        match salon.tool {
            Tool::Cut => cut(ui, salon, out),
            Tool::Scissors => scissors(ui, salon.scissors, out),
            Tool::Lift => {
                brush(ui, salon, out);
                lift(ui, salon.scissors, out);
            }
            Tool::Clippers => {
                brush(ui, salon, out);
                clippers(ui, salon.scissors, out);
            }
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
    if let Some((above, level)) = salon.head.as_ref().and_then(|h| h.above_level(plane.point.z)) {
        let side = if above < 0.0 { "below" } else { "above" };
        ui.weak(format!("{:.1} cm {side} the {level}", 100.0 * above.abs()));
    }
    for (label, angle) in [("to its left", &mut plane.roll), ("to the back", &mut plane.pitch)] {
        let mut degrees = angle.to_degrees();
        let field = DragValue::new(&mut degrees).range(-80.0..=80.0).suffix("°").max_decimals(0);
        if widgets::labelled(ui, label, field).changed() {
            *angle = degrees.to_radians();
        }
    }
    if widgets::plain(ui, "Level", "Make the plane level").clicked() {
        (plane.roll, plane.pitch) = (0.0, 0.0);
    }
    if plane != salon.plane {
        out.push(Command::Plane(plane));
    }
    scissors(ui, salon.scissors, out);
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

/// How scissors cut at a line.
fn scissors(ui: &mut Ui, now: Scissors, out: &mut Vec<Command>) {
    let mut set = now;
    let name = |hold| CutHold::ALL.iter().find(|(h, _)| *h == hold).map_or("", |(_, name)| name);
    let list = ComboBox::from_id_salt("held").selected_text(name(now.hold)).width(150.0);
    let shown = list.show_ui(ui, |ui| {
        for (hold, name) in CutHold::ALL {
            ui.selectable_value(&mut set.hold, hold, name);
        }
    });
    let help = "How the hair is held: as it hangs; trimmed until it rests at the line; or combed straight down, as in the paper";
    let held = shown.response.on_hover_text(help);
    held.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, "Held"));
    edge(ui, &mut set);
    send(set, now, out);
}

/// The edge that scissors leave.
fn edge(ui: &mut Ui, set: &mut Scissors) {
    let (mut soft, mut share) = (set.soft * 1e3, set.share * 100.0);
    let field = DragValue::new(&mut soft).range(0.0..=100.0).suffix(" mm").max_decimals(0);
    let help = "Point cutting: each hair ends up to this far before the line, for a soft edge";
    if widgets::labelled(ui, "Soft edge", field).on_hover_text(help).changed() {
        set.soft = soft / 1e3;
    }
    let field = DragValue::new(&mut share).range(5.0..=100.0).suffix(" %").max_decimals(0);
    let help = "Thinning scissors: the fraction of the hairs that is cut";
    if widgets::labelled(ui, "Of hairs", field).on_hover_text(help).changed() {
        set.share = share / 100.0;
    }
}

fn lift(ui: &mut Ui, now: Scissors, out: &mut Vec<Command>) {
    let mut set = now;
    let (mut angle, mut length) = (set.elevation.to_degrees(), set.lifted * 100.0);
    let field = DragValue::new(&mut angle).range(0.0..=180.0).suffix("°").max_decimals(0);
    let help = "From flat along the skin: 0 leaves one length, 45 graduates, 90 makes layers";
    if widgets::labelled(ui, "Elevation", field).on_hover_text(help).changed() {
        set.elevation = angle.to_radians();
    }
    let field = DragValue::new(&mut length).range(0.5..=100.0).suffix(" cm").max_decimals(1);
    let help = "How far from the skin lifted hair is cut";
    if widgets::labelled(ui, "Cut at", field.speed(0.1)).on_hover_text(help).changed() {
        set.lifted = length / 100.0;
    }
    edge(ui, &mut set);
    send(set, now, out);
}

fn clippers(ui: &mut Ui, now: Scissors, out: &mut Vec<Command>) {
    let mut set = now;
    let mut guard = set.guard * 1e3;
    let field = DragValue::new(&mut guard).range(1.0..=50.0).suffix(" mm").max_decimals(1);
    if widgets::labelled(ui, "Guard", field.speed(0.1))
        .on_hover_text("What is left of the hair")
        .changed()
    {
        set.guard = guard / 1e3;
    }
    for mm in [3.0, 6.0, 9.0, 12.0] {
        if widgets::plain(ui, &format!("{mm} mm"), "Put on this guard").clicked() {
            set.guard = mm / 1e3;
        }
    }
    send(set, now, out);
}

fn send(set: Scissors, before: Scissors, out: &mut Vec<Command>) {
    if set != before {
        out.push(Command::Scissors(set));
    }
}

fn brush(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let mut radius = salon.brush.radius * 100.0;
    let field = DragValue::new(&mut radius).range(0.2..=10.0).suffix(" cm").max_decimals(1);
    if widgets::labelled(ui, "Radius", field.speed(0.05)).changed() {
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
