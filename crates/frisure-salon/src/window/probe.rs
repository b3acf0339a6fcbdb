//! What is on the screen and what the salon knows, for an onlooker that is no eye: a test, a program,
//! a screen reader on a page. Where nobody looks, nothing is collected.
//!
//! Widgets come by themselves, under their accessible names, from egui's accessibility tree; what
//! has no widget (a handle in the picture) is named with [`record`].

use eframe::egui::accesskit::{self, NodeId, Role, Toggled};
use eframe::egui::{Context, Event, FullOutput, Plugin, RawInput, Rect, pos2};
use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};

/// Something on the screen.
#[derive(Clone, Debug, PartialEq)]
pub struct Widget {
    /// Its node in the accessibility tree; `None` if it was [`record`]ed.
    pub node: Option<NodeId>,
    /// What it is.
    pub role: Role,
    /// Its accessible name.
    pub label: String,
    /// What it says or holds, in words.
    pub value: String,
    /// What it holds, if that is a number: itself, its least and its most.
    pub number: Option<[f64; 3]>,
    /// Whether it is on, if it can be.
    pub on: Option<bool>,
    /// Whether it can be used.
    pub enabled: bool,
    /// Where it is (egui's points).
    pub rect: Rect,
}

#[derive(Default)]
struct Seen {
    watched: bool,
    widgets: Vec<Widget>,
    recorded: BTreeMap<String, Rect>,
    state: Option<String>,
    asked: VecDeque<String>,
    events: Vec<Event>,
    passes: u64,
}

thread_local! {
    // One window in a thread: egui's own.
    static SEEN: RefCell<Seen> = RefCell::default();
}

fn seen<T>(with: impl FnOnce(&mut Seen) -> T) -> T {
    SEEN.with(|seen| with(&mut seen.borrow_mut()))
}

/// Starts to look. Looking on costs the window nothing: it draws no frame more than it does anyway.
pub fn watch(ctx: &Context) {
    if !seen(|s| std::mem::replace(&mut s.watched, true)) {
        ctx.enable_accesskit();
        ctx.add_plugin(Onlooker);
        ctx.request_repaint();
    }
}

/// Names a place in the picture that is no widget, for this frame.
pub fn record(label: &str, rect: Rect) {
    seen(|s| {
        if s.watched {
            s.recorded.insert(label.to_owned(), rect);
        }
    });
}

/// Tells what the salon knows, as JSON; `state` is called only if somebody looks.
pub fn tell(state: impl FnOnce() -> String) {
    if seen(|s| s.watched) {
        let state = state();
        seen(|s| s.state = Some(state));
    }
}

/// The next thing that an onlooker asks the salon to do, by the name of its command.
#[must_use]
pub fn asked() -> Option<String> {
    seen(|s| s.asked.pop_front())
}

/// Asks the salon to do something: see [`asked`].
pub fn ask(ctx: &Context, command: &str) {
    seen(|s| s.asked.push_back(command.to_owned()));
    ctx.request_repaint();
}

/// What [`tell`] told last.
#[must_use]
pub fn state() -> Option<String> {
    seen(|s| s.state.clone())
}

/// All that was on the screen in the last frame.
#[must_use]
pub fn widgets() -> Vec<Widget> {
    seen(|s| s.widgets.clone())
}

/// How many frames were looked at.
#[must_use]
pub fn passes() -> u64 {
    seen(|s| s.passes)
}

/// The widget of this name: of several, one that can be clicked goes before words.
#[must_use]
pub fn widget(label: &str) -> Option<Widget> {
    let named = widgets().into_iter().filter(|w| w.label == label);
    named.min_by_key(|w| (w.role == Role::Label, !w.enabled))
}

/// Does to a widget what a screen reader asks for.
pub fn act(ctx: &Context, node: NodeId, action: accesskit::Action) {
    let (target_tree, target_node) = (accesskit::TreeId::ROOT, node);
    let request = accesskit::ActionRequest { action, target_tree, target_node, data: None };
    seen(|s| s.events.push(Event::AccessKitActionRequest(request)));
    ctx.request_repaint();
}

/// Looks at what egui puts out.
struct Onlooker;

impl Plugin for Onlooker {
    fn debug_name(&self) -> &'static str {
        "onlooker"
    }

    fn input_hook(&mut self, _: &Context, input: &mut RawInput) {
        input.events.append(&mut seen(|s| std::mem::take(&mut s.events)));
    }

    fn output_hook(&mut self, _: &Context, output: &mut FullOutput) {
        let Some(tree) = &output.platform_output.accesskit_update else { return };
        let named = named(tree);
        seen(|s| {
            let recorded = std::mem::take(&mut s.recorded);
            s.widgets = named;
            s.widgets.extend(recorded.into_iter().map(|(label, rect)| place(label, rect)));
            s.passes += 1;
        });
    }
}

fn place(label: String, rect: Rect) -> Widget {
    let (role, value) = (Role::Unknown, String::new());
    Widget { node: None, role, label, value, number: None, on: None, enabled: true, rect }
}

/// The nodes of a tree that have a name and a place, in the order in which they are read.
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

/// What a node is called: by itself, by the labels beside it, or, if it is words, what they say.
fn name(node: &accesskit::Node, nodes: &BTreeMap<NodeId, &accesskit::Node>) -> Option<String> {
    let said = |node: &accesskit::Node| node.label().or(node.value()).map(str::to_owned);
    if let Some(label) = node.label() {
        return Some(label.to_owned());
    }
    let beside: Vec<String> =
        node.labelled_by().iter().filter_map(|id| nodes.get(id).and_then(|n| said(n))).collect();
    match beside.is_empty() {
        false => Some(beside.join(" ")),
        true => said(node).filter(|words| node.role() == Role::Label && !words.is_empty()),
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
    fn widgets_are_found_by_their_names_and_used_as_a_screen_reader_does() {
        let ctx = Context::default();
        watch(&ctx);
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
                act(&ctx, button.node.expect("a node"), accesskit::Action::Click);
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
    fn what_is_asked_is_done_once_and_nothing_is_told_to_nobody() {
        let ctx = Context::default();
        tell(|| unreachable!("nobody looks"));
        ask(&ctx, "wet");
        assert_eq!(asked().as_deref(), Some("wet"));
        assert_eq!(asked(), None);
        watch(&ctx);
        tell(|| "{}".into());
        assert_eq!(state().as_deref(), Some("{}"));
    }
}
