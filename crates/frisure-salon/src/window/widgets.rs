//! Widgets that several parts of the window use.

use eframe::egui::emath::Numeric;
use eframe::egui::{
    Align, Button, DragValue, Layout, Response, RichText, Role, Slider, Ui, Widget, WidgetInfo,
};

use crate::locale::{self, tr};
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

/// A button with a label and a help of its own.
pub(super) fn button(ui: &mut Ui, label: &str, help: &str) -> Response {
    with_help(ui, Button::new(label), help)
}

/// A button of a message: its text, and its attribute `help` if it has one.
pub(super) fn plain(ui: &mut Ui, id: &str) -> Response {
    with_help(ui, Button::new(tr!(id)), &help_of(id))
}

/// A button of a message with an icon before its label.
pub(super) fn with_icon(ui: &mut Ui, icon: &str, id: &str) -> Response {
    let label = tr!(id);
    let response = with_help(ui, Button::new(format!("{icon} {label}")), &help_of(id));
    named(&response, &label, None);
    response
}

/// A button that shows its icon alone; its label is its name for screen readers, and stands before the help.
pub(super) fn icon(ui: &mut Ui, icon: &str, id: &str) -> Response {
    let (label, help) = (tr!(id), help_of(id));
    let help = if help.is_empty() { label.clone() } else { format!("{label}: {help}") };
    let response = with_help(ui, Button::new(RichText::new(icon).size(16.0)), &help);
    named(&response, &label, None);
    response
}

/// A toggle button of a message with an icon before its label.
pub(super) fn icon_toggle(ui: &mut Ui, icon: &str, id: &str, on: bool) -> Response {
    let label = tr!(id);
    let response = with_help(ui, Button::selectable(on, format!("{icon} {label}")), &help_of(id));
    named(&response, &label, Some(on));
    response
}

/// A button with an icon, and with its label from some room on.
pub(super) fn fitting(ui: &mut Ui, from: Room, icon: &str, id: &str) -> Response {
    match Room::of(ui) < from {
        true => self::icon(ui, icon, id),
        false => with_icon(ui, icon, id),
    }
}

/// A toggle button with an icon, and with its label from some room on.
pub(super) fn fitting_toggle(ui: &mut Ui, from: Room, icon: &str, id: &str, on: bool) -> Response {
    if Room::of(ui) >= from {
        return icon_toggle(ui, icon, id, on);
    }
    let button = Button::selectable(on, RichText::new(icon).size(16.0));
    let label = tr!(id);
    let response = with_help(ui, button, &format!("{label}: {}", help_of(id)));
    named(&response, &label, Some(on));
    response
}

/// The tooltip of a message, its attribute `help`; empty without one.
fn help_of(id: &str) -> String {
    locale::attribute(id, "help").unwrap_or_default()
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

/// A widget with the label of a message before it, and its help.
pub(super) fn labelled(ui: &mut Ui, id: &str, widget: impl Widget) -> Response {
    let name = ui.label(tr!(id));
    let response = ui.add(widget).labelled_by(name.id);
    match help_of(id) {
        help if help.is_empty() => response,
        help => response.on_hover_text(help),
    }
}

/// The combination of selections for the pressed modifier keys.
pub(super) fn select_mode(ui: &Ui) -> SelectMode {
    ui.input(|i| match (i.modifiers.shift, i.modifiers.alt) {
        (_, true) => SelectMode::Remove,
        (true, _) => SelectMode::Add,
        _ => SelectMode::Replace,
    })
}

/// A number that is dragged or typed, with a point or a comma.
pub(super) fn number<N: Numeric>(value: &mut N) -> DragValue<'_> {
    DragValue::new(value).custom_parser(locale::parse_number)
}

/// A slider with its label and a reset button.
pub(super) fn slider(ui: &mut Ui, control: &'static Control, value: f64, out: &mut Vec<Command>) {
    let (label, help) = (control.label(), control.help());
    ui.horizontal(|ui| {
        ui.label(&*label).on_hover_text(&*help);
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            let reset = Button::new(RichText::new(tr!("reset")).small().weak()).frame(false);
            let reset = ui.add(reset).on_hover_text(tr!("reset.help"));
            reset.widget_info(|| {
                WidgetInfo::labeled(Role::Button, true, tr!("reset-of", label = &*label))
            });
            if reset.clicked() {
                out.push(Command::Reset(control.key));
            }
        });
    });
    let (low, high) = control.range;
    let mut now = value.clamp(low, high);
    ui.spacing_mut().slider_width = (ui.available_width() - NUMBER_WIDTH).max(60.0);
    let unit = control.displayed_unit();
    let space = if unit.is_empty() { "" } else { " " };
    let slider = Slider::new(&mut now, low..=high)
        .logarithmic(control.logarithmic)
        .smallest_positive(0.01)
        .max_decimals(control.decimals)
        .custom_parser(locale::parse_number)
        .suffix(format!("{space}{unit}"));
    let response = ui.add(slider).on_hover_text(&*help);
    response.widget_info(|| WidgetInfo::slider(true, value, &*label));
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
