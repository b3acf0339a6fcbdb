//! The keyboard: every tool has a key.

use eframe::egui::{Key, KeyboardShortcut, Modifiers, Ui};

use super::dialogs::Dialog;
use crate::state::{Command, Document, Growing, Salon, Tool, VIEWS};

/// What a key does, as the help shows it.
pub(super) const HELP: &[(&str, &str)] = &[
    ("V", "turn the head (drag); Shift: move it; wheel: nearer and farther"),
    ("L", "lasso: draw around hair; Shift adds, Alt takes away"),
    ("B", "brush: paint over the scalp"),
    ("C", "cutting plane: drag it; Shift-drag tilts it; Enter cuts"),
    ("K", "comb: drag along the hair's way"),
    ("H", "pick one hair, to see its material frames"),
    ("Space", "while held: turn the head whatever the tool"),
    ("A / I", "choose all hair / what is not chosen"),
    ("W", "wet or dry what is chosen"),
    ("G", "let it grow by a month"),
    ("R", "let go of what is held"),
    ("Enter", "cut at the plane"),
    ("Ctrl Z / Ctrl Shift Z", "undo / redo"),
    ("X", "before and after, side by side"),
    ("1 … 6", "front, three-quarter, left, back, right, top"),
    ("F", "all in the picture"),
    ("Arrows, + / −", "turn, nearer and farther"),
    ("Ctrl O / S / E / P", "open / save / export / picture"),
    ("Esc", "put the tool down; choose all"),
    ("F1", "this help"),
];

/// The commands that keys give in this frame, and the dialog that one opens.
///
/// While a question is open (`asking`), keys belong to it.
pub(super) fn commands(
    ui: &Ui,
    salon: &Salon,
    aspect: f64,
    asking: bool,
) -> (Vec<Command>, Option<Dialog>) {
    let mut out = Vec::new();
    if asking {
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
    // A field that is being typed in keeps its letters.
    if ui.ctx().egui_wants_keyboard_input() || salon.is_gallery() {
        if salon.is_gallery() && hit(Modifiers::NONE, Key::Escape) {
            out.push(Command::Gallery(false));
        }
        return (out, dialog);
    }
    letters(&hit, salon, &mut out);
    camera(&hit, aspect, &mut out);
    (out, dialog)
}

fn letters(hit: &dyn Fn(Modifiers, Key) -> bool, salon: &Salon, out: &mut Vec<Command>) {
    let none = Modifiers::NONE;
    let tools = [
        (Key::V, Tool::Orbit),
        (Key::L, Tool::Lasso),
        (Key::B, Tool::Brush),
        (Key::C, Tool::Cut),
        (Key::K, Tool::Comb),
        (Key::H, Tool::Pick),
    ];
    out.extend(tools.iter().filter(|(k, _)| hit(none, *k)).map(|(_, t)| Command::Take(*t)));
    let plain = [
        (Key::A, Command::ChooseAll),
        (Key::I, Command::Invert),
        (Key::W, Command::Water),
        (Key::G, Command::Grow(Growing::Months(1.0))),
        (Key::R, Command::Release),
    ];
    out.extend(plain.into_iter().filter(|(k, _)| hit(none, *k)).map(|(_, c)| c));
    if salon.tool() == Tool::Cut && hit(none, Key::Enter) {
        out.push(Command::Cut);
    }
    if hit(none, Key::X) {
        out.push(compare(salon));
    }
    if hit(none, Key::Escape) {
        out.extend([Command::Take(Tool::Orbit), Command::Alone(None), Command::ChooseAll]);
    }
}

/// Before and after: what was before the last change, or the end of it.
pub(super) fn compare(salon: &Salon) -> Command {
    let at = salon.document().map_or(0, Document::at);
    Command::Compare(salon.compared().is_none().then(|| at.saturating_sub(1)))
}

fn camera(hit: &dyn Fn(Modifiers, Key) -> bool, aspect: f64, out: &mut Vec<Command>) {
    /// Radians that an arrow turns.
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
