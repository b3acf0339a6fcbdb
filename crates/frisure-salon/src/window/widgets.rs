//! Widgets that several parts of the window use.

use eframe::egui::{
    Align, Button, Layout, Response, RichText, Role, Slider, Ui, Widget, WidgetInfo,
};

use crate::state::{Command, Control, SelectMode};

/// Width of the number beside a slider (points).
const NUMBER_WIDTH: f32 = 104.0;

/// How much room a window has: what it leaves out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Room {
    /// A phone held upright: the panels at the side take the place of the picture.
    Phone,
    /// A small window: the upper toolbar has icons without labels.
    Narrow,
    /// Everything fits.
    Wide,
}

impl Room {
    /// That of the window (points). Chosen: the upper toolbar with labels is 1120 wide, tools are 690.
    pub(super) fn of(ui: &Ui) -> Self {
        match ui.ctx().content_rect().width() {
            width if width < 700.0 => Self::Phone,
            width if width < 1150.0 => Self::Narrow,
            _ => Self::Wide,
        }
    }
}

/// A button.
pub(super) fn plain(ui: &mut Ui, label: &str, help: &str) -> Response {
    with_help(ui, Button::new(label), help)
}

/// A button with an icon before its label.
pub(super) fn with_icon(ui: &mut Ui, icon: &str, label: &str, help: &str) -> Response {
    let response = with_help(ui, Button::new(format!("{icon} {label}")), help);
    named(&response, label, None);
    response
}

/// A button that shows its icon alone; its label is its name for screen readers, and stands before the help.
pub(super) fn icon(ui: &mut Ui, icon: &str, label: &str, help: &str) -> Response {
    let help = if help.is_empty() { label.to_owned() } else { format!("{label}: {help}") };
    let response = with_help(ui, Button::new(RichText::new(icon).size(16.0)), &help);
    named(&response, label, None);
    response
}

/// A toggle button with an icon before its label.
pub(super) fn icon_toggle(ui: &mut Ui, icon: &str, label: &str, on: bool, help: &str) -> Response {
    let response = with_help(ui, Button::selectable(on, format!("{icon} {label}")), help);
    named(&response, label, Some(on));
    response
}

/// A button with an icon, and with its label from some room on.
pub(super) fn fitting(ui: &mut Ui, from: Room, icon: &str, label: &str, help: &str) -> Response {
    match Room::of(ui) < from {
        true => self::icon(ui, icon, label, help),
        false => with_icon(ui, icon, label, help),
    }
}

/// A toggle button with an icon, and with its label from some room on.
pub(super) fn fitting_toggle(
    ui: &mut Ui,
    from: Room,
    icon: &str,
    (label, on): (&str, bool),
    help: &str,
) -> Response {
    if Room::of(ui) >= from {
        return icon_toggle(ui, icon, label, on, help);
    }
    let button = Button::selectable(on, RichText::new(icon).size(16.0));
    let response = with_help(ui, button, &format!("{label}: {help}"));
    named(&response, label, Some(on));
    response
}

/// Names a button without its icon, which screen readers cannot say.
fn named(response: &Response, label: &str, on: Option<bool>) {
    let enabled = response.enabled();
    response.widget_info(|| match on {
        Some(on) => WidgetInfo::selected(Role::Button, enabled, on, label),
        None => WidgetInfo::labeled(Role::Button, enabled, label),
    });
}

fn with_help(ui: &mut Ui, button: impl Widget, help: &str) -> Response {
    let response = ui.add(button);
    if help.is_empty() { response } else { response.on_hover_text(help) }
}

/// A widget with a label before it.
pub(super) fn labelled(ui: &mut Ui, label: &str, widget: impl Widget) -> Response {
    let name = ui.label(label);
    ui.add(widget).labelled_by(name.id)
}

/// The combination of selections for the pressed modifier keys.
pub(super) fn select_mode(ui: &Ui) -> SelectMode {
    ui.input(|i| match (i.modifiers.shift, i.modifiers.alt) {
        (_, true) => SelectMode::Remove,
        (true, _) => SelectMode::Add,
        _ => SelectMode::Replace,
    })
}

/// A slider with its label and a reset button.
pub(super) fn slider(ui: &mut Ui, control: &'static Control, value: f64, out: &mut Vec<Command>) {
    ui.horizontal(|ui| {
        ui.label(control.label).on_hover_text(control.help);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let reset = Button::new(RichText::new("reset").small().weak()).frame(false);
            let reset = ui.add(reset).on_hover_text("Use the default of the hair type");
            reset.widget_info(|| {
                WidgetInfo::labeled(Role::Button, true, format!("Reset {}", control.label))
            });
            if reset.clicked() {
                out.push(Command::Reset(control.key));
            }
        });
    });
    let (low, high) = control.range;
    let mut now = value.clamp(low, high);
    ui.spacing_mut().slider_width = (ui.available_width() - NUMBER_WIDTH).max(60.0);
    let unit = control.unit.displayed;
    let space = if unit.is_empty() { "" } else { " " };
    let slider = Slider::new(&mut now, low..=high)
        .logarithmic(control.logarithmic)
        .smallest_positive(0.01)
        .max_decimals(control.decimals)
        .suffix(format!("{space}{unit}"));
    let response = ui.add(slider).on_hover_text(control.help);
    response.widget_info(|| WidgetInfo::slider(true, value, control.label));
    // The slider reports a change when it rounds the value, too.
    if response.changed() && control.clean(now) != control.clean(value) {
        out.push(match response.dragged() || response.drag_stopped() {
            true => Command::Drag(control.key, now),
            false => Command::Set(control.key, now),
        });
    }
    if response.drag_stopped() {
        out.push(Command::EndDrag);
    }
}
