//! Automation: the widgets on the screen and the state, for tests, programs and screen readers on a page.
//!
//! Widgets come from egui's accessibility tree, under their accessible names; [`record`] names rectangles that are not
//! widgets. Nothing is collected before [`enable`].

use eframe::egui::accesskit::{self, NodeId, Role, Toggled};
use eframe::egui::{Context, Event, FullOutput, Plugin, RawInput, Rect, pos2};
use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};

/// A widget on the screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Widget {
    /// Its node in the accessibility tree; `None` if it was [`record`]ed.
    pub node: Option<NodeId>,
    /// Its role.
    pub role: Role,
    /// Its accessible name.
    pub label: String,
    /// Its value as text.
    pub value: String,
    /// Its value, minimum and maximum, if it is numeric.
    pub number: Option<[f64; 3]>,
    /// Whether it is on, if it is a toggle.
    pub on: Option<bool>,
    /// Whether it is enabled.
    pub enabled: bool,
    /// Its rectangle (points).
    pub rect: Rect,
}

#[derive(Default)]
struct Collected {
    enabled: bool,
    widgets: Vec<Widget>,
    recorded: BTreeMap<String, Rect>,
    state: Option<String>,
    commands: VecDeque<String>,
    events: Vec<Event>,
    frames: u64,
}

thread_local! {
    // A thread has one window.
    static COLLECTED: RefCell<Collected> = RefCell::default();
}

fn collected<T>(with: impl FnOnce(&mut Collected) -> T) -> T {
    COLLECTED.with_borrow_mut(with)
}

/// Starts to collect, without additional frames.
pub fn enable(ctx: &Context) {
    if !collected(|s| std::mem::replace(&mut s.enabled, true)) {
        ctx.enable_accesskit();
        ctx.add_plugin(Collector);
        ctx.request_repaint();
    }
}

/// Names a rectangle that is not a widget, for this frame.
pub fn record(label: &str, rect: Rect) {
    collected(|s| {
        if s.enabled {
            s.recorded.insert(label.to_owned(), rect);
        }
    });
}

/// Publishes the state as JSON; calls `state` only if automation is enabled.
pub fn publish_state(state: impl FnOnce() -> String) {
    if collected(|s| s.enabled) {
        let state = state();
        collected(|s| s.state = Some(state));
    }
}

/// The next queued command.
#[must_use]
pub fn next_command() -> Option<String> {
    collected(|s| s.commands.pop_front())
}

/// Queues a command for the window, by name.
pub fn queue_command(ctx: &Context, command: &str) {
    collected(|s| s.commands.push_back(command.to_owned()));
    ctx.request_repaint();
}

/// The last published state.
#[must_use]
pub fn state() -> Option<String> {
    collected(|s| s.state.clone())
}

/// The widgets of the last frame.
#[must_use]
pub fn widgets() -> Vec<Widget> {
    collected(|s| s.widgets.clone())
}

/// The number of collected frames.
#[must_use]
pub fn frames() -> u64 {
    collected(|s| s.frames)
}

/// The widget with a name; of several, an enabled one that is not a label.
#[must_use]
pub fn widget(label: &str) -> Option<Widget> {
    let named = widgets().into_iter().filter(|w| w.label == label);
    named.min_by_key(|w| (w.role == Role::Label, !w.enabled))
}

/// Performs an action of a screen reader on a widget.
pub fn perform(ctx: &Context, node: NodeId, action: accesskit::Action) {
    let (target_tree, target_node) = (accesskit::TreeId::ROOT, node);
    let request = accesskit::ActionRequest { action, target_tree, target_node, data: None };
    collected(|s| s.events.push(Event::AccessKitActionRequest(request)));
    ctx.request_repaint();
}

/// Collects the output of egui.
struct Collector;

impl Plugin for Collector {
    fn debug_name(&self) -> &'static str {
        "collector"
    }

    fn input_hook(&mut self, _: &Context, input: &mut RawInput) {
        input.events.append(&mut collected(|s| std::mem::take(&mut s.events)));
    }

    fn output_hook(&mut self, _: &Context, output: &mut FullOutput) {
        let Some(tree) = &output.platform_output.accesskit_update else { return };
        let named = named(tree);
        collected(|s| {
            let recorded = std::mem::take(&mut s.recorded);
            s.widgets = named;
            s.widgets.extend(recorded.into_iter().map(|(label, rect)| place(label, rect)));
            s.frames += 1;
        });
    }
}

fn place(label: String, rect: Rect) -> Widget {
    let (role, value) = (Role::Unknown, String::new());
    Widget { node: None, role, label, value, number: None, on: None, enabled: true, rect }
}

/// The nodes of a tree with a name and a rectangle, in reading order.
fn named(tree: &accesskit::TreeUpdate) -> Vec<Widget> {
    let nodes: BTreeMap<NodeId, &accesskit::Node> =
        tree.nodes.iter().map(|(id, node)| (*id, node)).collect();
    let Some(root) = &tree.tree else { return Vec::new() };
    let mut found = Vec::new();
    let mut open = vec![root.root];
    while let Some(id) = open.pop() {
        let Some(node) = nodes.get(&id) else { continue };
        open.extend(node.children().iter().rev());
        found.extend(as_widget(id, node, &nodes));
    }
    found
}

fn as_widget(
    id: NodeId,
    node: &accesskit::Node,
    nodes: &BTreeMap<NodeId, &accesskit::Node>,
) -> Option<Widget> {
    let label = name(node, nodes)?;
    let b = node.bounds()?;
    let rect = Rect { min: pos2(b.x0 as f32, b.y0 as f32), max: pos2(b.x1 as f32, b.y1 as f32) };
    let number = node.numeric_value().map(|value| {
        let least = node.min_numeric_value().unwrap_or(f64::MIN);
        [value, least, node.max_numeric_value().unwrap_or(f64::MAX)]
    });
    let value = node.value().unwrap_or_default().to_owned();
    let on = node.toggled().map(|toggled| toggled == Toggled::True);
    let (role, enabled) = (node.role(), !node.is_disabled());
    Some(Widget { node: Some(id), role, label, value, number, on, enabled, rect })
}

/// The name of a node: its own, that of its labels, or the text of a label.
fn name(node: &accesskit::Node, nodes: &BTreeMap<NodeId, &accesskit::Node>) -> Option<String> {
    let text = |node: &accesskit::Node| node.label().or(node.value()).map(str::to_owned);
    if let Some(label) = node.label() {
        return Some(label.to_owned());
    }
    let labels: Vec<String> =
        node.labelled_by().iter().filter_map(|id| nodes.get(id).and_then(|n| text(n))).collect();
    match labels.is_empty() {
        false => Some(labels.join(" ")),
        true => text(node).filter(|text| node.role() == Role::Label && !text.is_empty()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::{Slider, Ui, vec2};

    fn frame(ctx: &Context, ui: impl FnMut(&mut Ui)) {
        let rect = Rect::from_min_size(pos2(0.0, 0.0), vec2(400.0, 300.0));
        let input = RawInput { screen_rect: Some(rect), ..Default::default() };
        let mut output = ctx.run_ui(input, ui);
        // Nothing is drawn here.
        output.textures_delta.clear();
    }

    #[test]
    fn widgets_are_found_by_name_and_take_actions() {
        let ctx = Context::default();
        enable(&ctx);
        let (mut wet, mut length) = (0, 0.2);
        for pass in 0..3 {
            frame(&ctx, |ui| {
                ui.label("Some words");
                wet += usize::from(ui.button("Wet").clicked());
                ui.add(Slider::new(&mut length, 0.1..=0.5).text("Length"));
                ui.add_enabled_ui(false, |ui| ui.button("Dry"));
                record("handle", Rect::from_min_size(pos2(5.0, 6.0), vec2(2.0, 2.0)));
            });
            if pass == 1 {
                let button = widget("Wet").expect("a button");
                assert!(button.enabled && button.role == Role::Button && button.rect.width() > 5.0);
                perform(&ctx, button.node.expect("a node"), accesskit::Action::Click);
            }
        }
        assert_eq!(wet, 1);
        assert!(!widget("Dry").expect("a button").enabled);
        assert_eq!(widget("Some words").expect("words").value, "Some words");
        assert_eq!(widget("Length").and_then(|w| w.number).map(|n| n[0]), Some(0.2));
        assert_eq!(widget("handle").map(|w| w.rect.min), Some(pos2(5.0, 6.0)));
        assert_eq!(widget("Curl"), None);
    }

    #[test]
    fn commands_are_taken_once_and_the_state_is_published_only_when_enabled() {
        let ctx = Context::default();
        publish_state(|| unreachable!("automation is not enabled"));
        queue_command(&ctx, "wet");
        assert_eq!(next_command().as_deref(), Some("wet"));
        assert_eq!(next_command(), None);
        enable(&ctx);
        publish_state(|| "{}".into());
        assert_eq!(state().as_deref(), Some("{}"));
    }
}
