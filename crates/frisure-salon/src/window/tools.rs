//! The tools, and the settings of the active one.

use eframe::egui::{Button, ComboBox, RichText, Role, TextWrapMode, Ui, WidgetInfo};
use frisure::hairstyle::Comb as Side;
use frisure::hairstyle::styling::Direction;
use glam::DVec3;

use super::overlay::level_name;
use super::widgets::Room;
use super::{icons, theme, widgets};
use crate::locale::{self, tr};
use crate::state::{Command, CutHold, Salon, Scissors, Tool, VIEWS, comb};

/// The tools: each with its icon and its message, whose help names its key.
const TOOLS: [(Tool, &str, &str); 10] = [
    (Tool::Orbit, icons::TURN, "tool-turn"),
    (Tool::Lasso, icons::LASSO, "tool-lasso"),
    (Tool::Brush, icons::BRUSH, "tool-brush"),
    (Tool::Part, icons::PARTING, "tool-part"),
    (Tool::Scissors, icons::SCISSORS, "tool-scissors"),
    (Tool::Cut, icons::CUT, "tool-cut"),
    (Tool::Lift, icons::LIFT, "tool-lift"),
    (Tool::Clippers, icons::CLIPPERS, "tool-clippers"),
    (Tool::Comb, icons::COMB, "tool-comb"),
    (Tool::Pick, icons::ONE_HAIR, "tool-one-hair"),
];

/// The tools, and the settings of the active one.
pub(super) fn show(ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    ui.horizontal_wrapped(|ui| {
        for (tool, icon, id) in TOOLS {
            let on = salon.tool == tool;
            if widgets::fitting_toggle(ui, Room::Narrow, icon, id, on).clicked() {
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
                ui.weak(tr!("lasso-hint"));
            }
            Tool::Part => {
                ui.weak(tr!("part-hint"));
            }
            Tool::Orbit => views(ui, salon, out),
        }
    });
}

fn views(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    for (id, azimuth, elevation) in VIEWS {
        if widgets::button(ui, &tr!(id), &tr!("view.help")).clicked() {
            out.push(Command::LookFrom(f64::to_radians(azimuth), f64::to_radians(elevation)));
        }
    }
    if widgets::icon_toggle(ui, icons::SPIN, "spin", salon.spins).clicked() {
        out.push(Command::ToggleSpin);
    }
    if widgets::plain(ui, "keep-view").clicked() {
        out.push(Command::KeepView);
    }
}

fn cut(ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
    let mut plane = salon.plane;
    let mut height = plane.point.z * 100.0;
    let field = widgets::number(&mut height).range(-150.0..=20.0).suffix(" cm").max_decimals(1);
    if widgets::labelled(ui, "cut-height", field.speed(0.1)).changed() {
        plane.point = DVec3::new(0.0, 0.0, height / 100.0);
    }
    if let Some((above, level)) = salon.head.as_ref().and_then(|h| h.above_level(plane.point.z)) {
        let (side, level) = (if above < 0.0 { "below" } else { "above" }, level_name(level));
        let cm = locale::number(100.0 * above.abs(), 1);
        ui.weak(tr!("cut-level", cm = cm, side = side, level = level.as_ref()));
    }
    for (id, angle) in [("cut-roll", &mut plane.roll), ("cut-pitch", &mut plane.pitch)] {
        let mut degrees = angle.to_degrees();
        let field = widgets::number(&mut degrees).range(-80.0..=80.0).suffix("°").max_decimals(0);
        if widgets::labelled(ui, id, field).changed() {
            *angle = degrees.to_radians();
        }
    }
    if widgets::plain(ui, "level-plane").clicked() {
        (plane.roll, plane.pitch) = (0.0, 0.0);
    }
    if plane != salon.plane {
        out.push(Command::Plane(plane));
    }
    scissors(ui, salon.scissors, out);
    let preview = salon.cut_preview();
    ui.add_enabled_ui(preview.as_ref().is_some_and(|preview| preview.hairs > 0), |ui| {
        let button = Button::new(RichText::new(tr!("cut-here")).strong()).fill(theme::CUT_COLOUR);
        if ui.add(button).on_hover_text(tr!("cut-here.help")).clicked() {
            out.push(Command::Cut);
        }
    });
    if preview.as_ref().is_some_and(|preview| preview.hairs == 0) {
        ui.label(tr!("cut-nothing"));
    } else if let (Some(preview), Some((hair, _))) = (preview, salon.preview()) {
        let grams = preview.share * hair.numbers.mass * 1e3;
        let part = preview.hairs as f64 / hair.numbers.drawn.max(1) as f64 * 100.0;
        let (part, grams) = (format!("{part:.0}"), format!("{grams:.1}"));
        ui.label(tr!("cut-preview", part = part, grams = grams));
    }
}

/// How scissors cut at a line.
fn scissors(ui: &mut Ui, now: Scissors, out: &mut Vec<Command>) {
    let mut set = now;
    let list = ComboBox::from_id_salt("held").selected_text(tr!(now.hold.id())).width(150.0);
    let shown = list.show_ui(ui, |ui| {
        for hold in CutHold::ALL {
            ui.selectable_value(&mut set.hold, hold, tr!(hold.id()));
        }
    });
    let held = shown.response.on_hover_text(tr!("cut-held.help"));
    held.widget_info(|| WidgetInfo::labeled(Role::ComboBox, true, tr!("cut-held")));
    edge(ui, &mut set);
    send(set, now, out);
}

/// The edge that scissors leave.
fn edge(ui: &mut Ui, set: &mut Scissors) {
    let (mut soft, mut share) = (set.soft * 1e3, set.share * 100.0);
    let field = widgets::number(&mut soft).range(0.0..=100.0).suffix(" mm").max_decimals(0);
    if widgets::labelled(ui, "soft-edge", field).changed() {
        set.soft = soft / 1e3;
    }
    let field = widgets::number(&mut share).range(5.0..=100.0).suffix(" %").max_decimals(0);
    if widgets::labelled(ui, "of-hairs", field).changed() {
        set.share = share / 100.0;
    }
}

fn lift(ui: &mut Ui, now: Scissors, out: &mut Vec<Command>) {
    let mut set = now;
    let (mut angle, mut length) = (set.elevation.to_degrees(), set.lifted * 100.0);
    let field = widgets::number(&mut angle).range(0.0..=180.0).suffix("°").max_decimals(0);
    if widgets::labelled(ui, "lift-elevation", field).changed() {
        set.elevation = angle.to_radians();
    }
    let field = widgets::number(&mut length).range(0.5..=100.0).suffix(" cm").max_decimals(1);
    if widgets::labelled(ui, "lift-length", field.speed(0.1)).changed() {
        set.lifted = length / 100.0;
    }
    edge(ui, &mut set);
    send(set, now, out);
}

fn clippers(ui: &mut Ui, now: Scissors, out: &mut Vec<Command>) {
    let mut set = now;
    let mut guard = set.guard * 1e3;
    let field = widgets::number(&mut guard).range(1.0..=50.0).suffix(" mm").max_decimals(1);
    if widgets::labelled(ui, "guard", field.speed(0.1)).changed() {
        set.guard = guard / 1e3;
    }
    for mm in [3.0, 6.0, 9.0, 12.0] {
        if widgets::button(ui, &format!("{mm} mm"), &tr!("guard.put-on")).clicked() {
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
    let field = widgets::number(&mut radius).range(0.2..=10.0).suffix(" cm").max_decimals(1);
    if widgets::labelled(ui, "brush-radius", field.speed(0.05)).changed() {
        out.push(Command::BrushSize(radius / 100.0));
    }
}

fn sides(ui: &mut Ui, out: &mut Vec<Command>) {
    let sides = [
        ("comb-forward", Side::Forward),
        ("comb-back", Side::Back),
        ("comb-down", Side::Down),
        ("comb-left", Side::Left),
        ("comb-right", Side::Right),
    ];
    for (id, side) in sides {
        if widgets::button(ui, &tr!(id), &tr!("comb-side.help")).clicked() {
            out.push(Command::Apply(comb(Direction::Named(side))));
        }
    }
}

fn one_hair(ui: &mut Ui, salon: &Salon, out: &mut Vec<Command>) {
    let Some((hair, _)) = salon.preview() else { return };
    let last = hair.numbers.wisps.saturating_sub(1);
    let mut wisp = salon.isolated.as_ref().map_or(0, |isolated| isolated.wisp);
    if widgets::labelled(ui, "wisp", widgets::number(&mut wisp).range(0..=last)).changed() {
        out.push(Command::Isolate(Some(wisp)));
    }
    if salon.isolated.is_none() {
        ui.weak(tr!("one-hair-hint"));
    } else if widgets::plain(ui, "show-all-hair").clicked() {
        out.push(Command::Isolate(None));
    }
}
