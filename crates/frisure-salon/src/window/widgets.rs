//! Widgets that are used in more than one place.

use eframe::egui::{Button, Response, RichText, Slider, Ui, Widget};

use crate::state::{Command, Control};

/// Room for the value beside a slider (points).
const VALUE: f32 = 104.0;

/// A plain button.
pub(super) fn plain(ui: &mut Ui, label: &str, help: &str) -> Response {
    with_help(ui, Button::new(label), help)
}

/// A button that stays down.
pub(super) fn toggle(ui: &mut Ui, label: &str, on: bool, help: &str) -> Response {
    with_help(ui, Button::selectable(on, label), help)
}

fn with_help(ui: &mut Ui, button: impl Widget, help: &str) -> Response {
    let response = ui.add(button);
    if help.is_empty() { response } else { response.on_hover_text(help) }
}

/// A slider of a control under its name; the commands it gives, if it is moved.
pub(super) fn slider(ui: &mut Ui, control: &'static Control, value: f64) -> Vec<Command> {
    let mut commands = Vec::new();
    ui.horizontal(|ui| {
        let name = ui.label(control.label).on_hover_text(control.help);
        ui.with_layout(eframe::egui::Layout::right_to_left(eframe::egui::Align::Center), |ui| {
            let reset = Button::new(RichText::new("reset").small().weak()).frame(false);
            let reset = ui.add(reset).on_hover_text("As the hair type has it");
            reset.widget_info(|| {
                let label = format!("Reset {}", control.label);
                eframe::egui::WidgetInfo::labeled(eframe::egui::Role::Button, true, label)
            });
            if reset.clicked() {
                commands.push(Command::Reset(control.key));
            }
        });
        name.id
    });
    let mut now = value.clamp(control.range.0, control.range.1);
    ui.spacing_mut().slider_width = (ui.available_width() - VALUE).max(60.0);
    let suffix = match control.unit {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    let slider = Slider::new(&mut now, control.range.0..=control.range.1)
        .logarithmic(control.logarithmic)
        .smallest_positive(0.01)
        .max_decimals(control.decimals)
        .suffix(suffix);
    let response = ui.add(slider).on_hover_text(control.help);
    response.widget_info(|| eframe::egui::WidgetInfo::slider(true, value, control.label));
    // A value that is shown rounded is no change.
    let moved = control.clean(now) != control.clean(value);
    let held = response.dragged() || response.drag_stopped();
    if response.changed() && moved {
        commands.push(match held {
            true => Command::Drag(control.key, now),
            false => Command::Set(control.key, now),
        });
    }
    if response.drag_stopped() {
        commands.push(Command::LetGo);
    }
    commands
}
