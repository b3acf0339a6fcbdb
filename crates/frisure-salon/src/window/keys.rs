//! Key bindings.

use eframe::egui::{Key, KeyboardShortcut, Modifiers, Ui};

use super::dialogs::Dialog;
use super::toolbars::{grow_a_month, release};
use crate::state::{Command, Salon, Tool, VIEWS};

/// The commands of the keys pressed in this frame, and the dialog that one opens; none while a dialog is open
/// (`modal`), and only those with a modifier or F1 where a text field receives the others (`typing`).
pub(super) fn commands(
    ui: &Ui,
    salon: &Salon,
    aspect: f64,
    modal: bool,
    typing: bool,
) -> (Vec<Command>, Option<Dialog>) {
    let mut out = Vec::new();
    if modal {
        return (out, None);
    }
    let hit = |modifiers: Modifiers, key: Key| {
        ui.input_mut(|i| i.consume_shortcut(&KeyboardShortcut::new(modifiers, key)))
    };
    let ctrl = Modifiers::COMMAND;
    if hit(ctrl | Modifiers::SHIFT, Key::Z) || hit(ctrl, Key::Y) {
        out.push(Command::Redo);
    }
    if hit(ctrl, Key::Z) {
        out.push(Command::Undo);
    }
    let dialogs = [
        (Key::O, Dialog::Open),
        (Key::S, Dialog::Save),
        (Key::E, Dialog::Export),
        (Key::P, Dialog::Picture),
    ];
    let mut dialog = dialogs.into_iter().find(|(key, _)| hit(ctrl, *key)).map(|(_, d)| d);
    if hit(Modifiers::NONE, Key::F1) {
        dialog = Some(Dialog::Help);
    }
    // A focused text field receives the letters; any other focused widget receives the arrows, Enter and Space.
    let free = !ui.ctx().egui_wants_keyboard_input();
    if typing || salon.is_gallery() {
        if salon.is_gallery() && hit(Modifiers::NONE, Key::Escape) {
            out.push(Command::Gallery(false));
        }
        return (out, dialog);
    }
    letters(&hit, free, salon, &mut out);
    if free {
        camera(&hit, aspect, &mut out);
    }
    (out, dialog)
}

fn letters(
    hit: &dyn Fn(Modifiers, Key) -> bool,
    free: bool,
    salon: &Salon,
    out: &mut Vec<Command>,
) {
    let none = Modifiers::NONE;
    let tools = [
        (Key::V, Tool::Orbit),
        (Key::L, Tool::Lasso),
        (Key::B, Tool::Brush),
        (Key::C, Tool::Cut),
        (Key::S, Tool::Scissors),
        (Key::U, Tool::Lift),
        (Key::J, Tool::Clippers),
        (Key::K, Tool::Comb),
        (Key::P, Tool::Part),
        (Key::H, Tool::Pick),
    ];
    out.extend(tools.iter().filter(|(k, _)| hit(none, *k)).map(|(_, t)| Command::Take(*t)));
    let plain = [
        (Key::A, Command::SelectAll),
        (Key::I, Command::InvertSelection),
        (Key::W, Command::ToggleWet),
        (Key::G, grow_a_month()),
        (Key::R, release()),
    ];
    out.extend(plain.into_iter().filter(|(k, _)| hit(none, *k)).map(|(_, c)| c));
    if free && salon.tool == Tool::Cut && hit(none, Key::Enter) {
        out.push(Command::Cut);
    }
    if hit(none, Key::X) {
        out.push(Command::ToggleCompare);
    }
    if hit(none, Key::T) {
        out.push(Command::ToggleSpin);
    }
    if hit(none, Key::M) {
        out.push(Command::ToggleMirror);
    }
    if hit(none, Key::Escape) {
        out.extend([Command::Take(Tool::Orbit), Command::Isolate(None), Command::SelectAll]);
    }
}

fn camera(hit: &dyn Fn(Modifiers, Key) -> bool, aspect: f64, out: &mut Vec<Command>) {
    /// Angle of an arrow key (rad).
    const STEP: f64 = 0.15;
    let none = Modifiers::NONE;
    let numbers = [Key::Num1, Key::Num2, Key::Num3, Key::Num4, Key::Num5, Key::Num6];
    for (key, (_, azimuth, elevation)) in numbers.into_iter().zip(VIEWS) {
        if hit(none, key) {
            out.push(Command::LookFrom(azimuth.to_radians(), elevation.to_radians()));
        }
    }
    let moves = [
        (Key::ArrowLeft, Command::Turn(-STEP, 0.0)),
        (Key::ArrowRight, Command::Turn(STEP, 0.0)),
        (Key::ArrowUp, Command::Turn(0.0, -STEP)),
        (Key::ArrowDown, Command::Turn(0.0, STEP)),
        (Key::Plus, Command::Zoom(1.15)),
        (Key::Equals, Command::Zoom(1.15)),
        (Key::Minus, Command::Zoom(1.0 / 1.15)),
        (Key::F, Command::Frame(aspect)),
    ];
    out.extend(moves.into_iter().filter(|(k, _)| hit(none, *k)).map(|(_, c)| c));
}
