//! The salon in words: elements of the page, unseen, one for each widget, where screen readers find
//! them. What is done to them is done to the widgets.
//!
//! egui draws on a canvas, which says nothing; its accessibility tree has no way into a browser of
//! its own yet.

use crate::window::probe::{self, Widget};
use eframe::egui::accesskit::{Action, NodeId, Role};
use eframe::egui::{Context, FullOutput, Plugin};
use std::cell::RefCell;
use std::collections::BTreeMap;
use wasm_bindgen::prelude::*;
use web_sys::{Document, Event, HtmlElement, KeyboardEvent, Node};

/// One element: what it was made of, and what listens to it.
struct Shown {
    widget: Widget,
    element: HtmlElement,
    _heard: [Closure<dyn Fn(Event)>; 2],
}

/// Keeps elements as the widgets are.
struct Mirror {
    home: HtmlElement,
    shown: BTreeMap<NodeId, Shown>,
}

thread_local! {
    // Not in the plugin: egui's plugins must be able to change threads, elements cannot.
    static MIRROR: RefCell<Option<Mirror>> = const { RefCell::new(None) };
}

/// Describes the window in this element from now on.
pub(crate) fn describe_in(home: HtmlElement, ctx: &Context) {
    MIRROR.with(|m| *m.borrow_mut() = Some(Mirror { home, shown: BTreeMap::new() }));
    ctx.add_plugin(Describer);
}

impl Mirror {
    /// Makes, changes and removes elements.
    fn follow(&mut self, ctx: &Context) -> Result<(), JsValue> {
        let widgets: Vec<(NodeId, Widget)> =
            probe::widgets().into_iter().filter_map(|w| Some((w.node?, w))).collect();
        let roles: BTreeMap<NodeId, Role> = widgets.iter().map(|(n, w)| (*n, w.role)).collect();
        self.shown.retain(|node, shown| {
            let stays = roles.get(node) == Some(&shown.widget.role);
            if !stays {
                shown.element.remove();
            }
            stays
        });
        let order: Vec<NodeId> = widgets.iter().map(|(node, _)| *node).collect();
        for (node, widget) in widgets {
            match self.shown.get_mut(&node) {
                Some(shown) if shown.widget == widget => {}
                Some(shown) => {
                    describe(&shown.element, &widget, ctx.zoom_factor())?;
                    shown.widget = widget;
                }
                None => self.show(node, widget, ctx)?,
            }
        }
        self.sort(&order)
    }

    /// Puts the elements in the order in which they are read; those in their place stay untouched.
    fn sort(&self, order: &[NodeId]) -> Result<(), JsValue> {
        let mut next = self.home.first_child();
        for shown in order.iter().filter_map(|node| self.shown.get(node)) {
            let element: &Node = &shown.element;
            if next.as_ref() == Some(element) {
                next = element.next_sibling();
            } else {
                self.home.insert_before(element, next.as_ref())?;
            }
        }
        Ok(())
    }

    fn show(&mut self, node: NodeId, widget: Widget, ctx: &Context) -> Result<(), JsValue> {
        let Some((tag, _)) = kind(widget.role) else { return Ok(()) };
        let document: Document = self.home.owner_document().ok_or("no document")?;
        let element: HtmlElement = document.create_element(tag)?.unchecked_into();
        describe(&element, &widget, ctx.zoom_factor())?;
        let clicked = listener(ctx, move |ctx, _| probe::act(ctx, node, Action::Click));
        let keyed = listener(ctx, move |ctx, event| {
            let key = event.unchecked_into::<KeyboardEvent>().key();
            match key.as_str() {
                "ArrowUp" | "ArrowRight" => probe::act(ctx, node, Action::Increment),
                "ArrowDown" | "ArrowLeft" => probe::act(ctx, node, Action::Decrement),
                _ => {}
            }
        });
        element.set_onclick(Some(clicked.as_ref().unchecked_ref()));
        element.set_onkeydown(Some(keyed.as_ref().unchecked_ref()));
        self.home.append_child(&element)?;
        self.shown.insert(node, Shown { widget, element, _heard: [clicked, keyed] });
        Ok(())
    }
}

/// Has the mirror follow each frame.
struct Describer;

impl Plugin for Describer {
    fn debug_name(&self) -> &'static str {
        "describer"
    }

    fn output_hook(&mut self, ctx: &Context, _: &mut FullOutput) {
        let followed = MIRROR.with(|m| m.borrow_mut().as_mut().map_or(Ok(()), |m| m.follow(ctx)));
        if let Err(reason) = followed {
            web_sys::console::warn_2(&"the salon cannot be described".into(), &reason);
        }
    }
}

fn listener(ctx: &Context, act: impl Fn(&Context, Event) + 'static) -> Closure<dyn Fn(Event)> {
    let ctx = ctx.clone();
    Closure::new(move |event| act(&ctx, event))
}

/// The element for a role, and the role's name in ARIA if the element does not say it.
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

fn describe(element: &HtmlElement, widget: &Widget, zoom: f32) -> Result<(), JsValue> {
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
