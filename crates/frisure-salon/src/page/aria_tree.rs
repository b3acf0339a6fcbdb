//! Invisible elements of the page for screen readers, one for each widget, which forward actions to it.
//!
//! egui draws on a canvas and does not export its accessibility tree to browsers.

use crate::window::automation::{self, Widget};
use eframe::egui::accesskit::{Action, NodeId, Role};
use eframe::egui::{Context, FullOutput, Plugin};
use std::cell::RefCell;
use std::collections::BTreeMap;
use wasm_bindgen::prelude::*;
use web_sys::{Document, Event, HtmlElement, KeyboardEvent, Node};

/// The element of a widget.
struct Entry {
    widget: Widget,
    element: HtmlElement,
    _listeners: [Closure<dyn Fn(Event)>; 2],
}

/// The elements of all widgets.
struct AriaTree {
    home: HtmlElement,
    entries: BTreeMap<NodeId, Entry>,
}

thread_local! {
    // Elements are not `Send`, and egui's plugins must be.
    static TREE: RefCell<Option<AriaTree>> = const { RefCell::new(None) };
}

/// Keeps the elements of the window in `home`.
pub(crate) fn install(home: HtmlElement, ctx: &Context) {
    TREE.set(Some(AriaTree { home, entries: BTreeMap::new() }));
    ctx.add_plugin(Updater);
}

impl AriaTree {
    /// Creates, updates and removes elements.
    fn update(&mut self, ctx: &Context) -> Result<(), JsValue> {
        let widgets: Vec<(NodeId, Widget)> =
            automation::widgets().into_iter().filter_map(|w| Some((w.node?, w))).collect();
        let roles: BTreeMap<NodeId, Role> = widgets.iter().map(|(n, w)| (*n, w.role)).collect();
        self.entries.retain(|node, entry| {
            let stays = roles.get(node) == Some(&entry.widget.role);
            if !stays {
                entry.element.remove();
            }
            stays
        });
        let order: Vec<NodeId> = widgets.iter().map(|(node, _)| *node).collect();
        for (node, widget) in widgets {
            match self.entries.get_mut(&node) {
                Some(entry) if entry.widget == widget => {}
                Some(entry) => {
                    set_attributes(&entry.element, &widget, ctx.zoom_factor())?;
                    entry.widget = widget;
                }
                None => self.insert(node, widget, ctx)?,
            }
        }
        self.sort(&order)
    }

    /// Sorts the elements into reading order; it touches only those out of order.
    fn sort(&self, order: &[NodeId]) -> Result<(), JsValue> {
        let mut next = self.home.first_child();
        for entry in order.iter().filter_map(|node| self.entries.get(node)) {
            let element: &Node = &entry.element;
            if next.as_ref() == Some(element) {
                next = element.next_sibling();
            } else {
                self.home.insert_before(element, next.as_ref())?;
            }
        }
        Ok(())
    }

    fn insert(&mut self, node: NodeId, widget: Widget, ctx: &Context) -> Result<(), JsValue> {
        let Some((tag, _)) = kind(widget.role) else { return Ok(()) };
        let document: Document = self.home.owner_document().ok_or("no document")?;
        let element: HtmlElement = document.create_element(tag)?.unchecked_into();
        set_attributes(&element, &widget, ctx.zoom_factor())?;
        let clicked = listener(ctx, move |ctx, _| automation::perform(ctx, node, Action::Click));
        let keyed = listener(ctx, move |ctx, event| {
            let key = event.unchecked_into::<KeyboardEvent>().key();
            match key.as_str() {
                "ArrowUp" | "ArrowRight" => automation::perform(ctx, node, Action::Increment),
                "ArrowDown" | "ArrowLeft" => automation::perform(ctx, node, Action::Decrement),
                _ => {}
            }
        });
        element.set_onclick(Some(clicked.as_ref().unchecked_ref()));
        element.set_onkeydown(Some(keyed.as_ref().unchecked_ref()));
        self.home.append_child(&element)?;
        self.entries.insert(node, Entry { widget, element, _listeners: [clicked, keyed] });
        Ok(())
    }
}

/// Updates the elements after each frame.
struct Updater;

impl Plugin for Updater {
    fn debug_name(&self) -> &'static str {
        "aria tree"
    }

    fn output_hook(&mut self, ctx: &Context, _: &mut FullOutput) {
        let updated =
            TREE.with_borrow_mut(|tree| tree.as_mut().map_or(Ok(()), |tree| tree.update(ctx)));
        if let Err(reason) = updated {
            web_sys::console::warn_2(
                &"the description for screen readers cannot be updated".into(),
                &reason,
            );
        }
    }
}

fn listener(ctx: &Context, act: impl Fn(&Context, Event) + 'static) -> Closure<dyn Fn(Event)> {
    let ctx = ctx.clone();
    Closure::new(move |event| act(&ctx, event))
}

/// The tag of a role's element, and its ARIA role if the tag does not imply it.
fn kind(role: Role) -> Option<(&'static str, &'static str)> {
    Some(match role {
        Role::Label => ("span", ""),
        Role::Heading => ("h2", ""),
        Role::Button => ("button", ""),
        Role::Link => ("button", "link"),
        Role::CheckBox => ("button", "checkbox"),
        Role::Switch => ("button", "switch"),
        Role::RadioButton => ("button", "radio"),
        Role::ComboBox => ("button", "combobox"),
        Role::Tab => ("button", "tab"),
        Role::MenuItem => ("button", "menuitem"),
        Role::Slider => ("div", "slider"),
        Role::SpinButton => ("div", "spinbutton"),
        Role::TextInput | Role::MultilineTextInput => ("div", "textbox"),
        Role::ProgressIndicator => ("div", "progressbar"),
        Role::Image => ("div", "img"),
        _ => return None,
    })
}

fn set_attributes(element: &HtmlElement, widget: &Widget, zoom: f32) -> Result<(), JsValue> {
    let Some((tag, role)) = kind(widget.role) else { return Ok(()) };
    if !role.is_empty() {
        element.set_attribute("role", role)?;
    }
    if tag == "div" {
        element.set_tab_index(0);
    }
    match widget.role {
        Role::Label | Role::Heading => element.set_text_content(Some(&widget.label)),
        _ => element.set_attribute("aria-label", &widget.label)?,
    }
    if let Some(on) = widget.on {
        let name = if role.is_empty() { "aria-pressed" } else { "aria-checked" };
        element.set_attribute(name, if on { "true" } else { "false" })?;
    }
    if let Some([value, least, most]) = widget.number {
        element.set_attribute("aria-valuenow", &value.to_string())?;
        element.set_attribute("aria-valuemin", &least.to_string())?;
        element.set_attribute("aria-valuemax", &most.to_string())?;
    }
    if !widget.value.is_empty() && widget.role != Role::Label {
        element.set_attribute("aria-valuetext", &widget.value)?;
    }
    element.set_attribute("aria-disabled", if widget.enabled { "false" } else { "true" })?;
    let rect = widget.rect * zoom;
    let style = element.style();
    for (name, points) in [
        ("left", rect.left()),
        ("top", rect.top()),
        ("width", rect.width()),
        ("height", rect.height()),
    ] {
        style.set_property(name, &format!("{points:.0}px"))?;
    }
    Ok(())
}
