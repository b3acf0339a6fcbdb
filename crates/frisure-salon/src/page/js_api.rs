//! The functions behind `window.frisure` of the page, for programs and screen readers.

use super::aria_tree;
use super::worker_client::last_duration;
use crate::window::automation::{self, Widget};
use eframe::egui::{Context, Rect};
use serde_json::{Value, json};
use std::cell::RefCell;
use wasm_bindgen::prelude::*;
use web_sys::HtmlElement;

thread_local! {
    static CONTEXT: RefCell<Option<Context>> = const { RefCell::new(None) };
}

/// Connects the functions of this module to the window.
pub(crate) fn connect(ctx: &Context) {
    CONTEXT.set(Some(ctx.clone()));
}

/// The window; the first call enables automation.
fn window() -> Option<Context> {
    let ctx = CONTEXT.with_borrow(Clone::clone)?;
    automation::enable(&ctx);
    Some(ctx)
}

/// The state as JSON; `None` before the first frame.
#[wasm_bindgen]
#[must_use]
pub fn state() -> Option<String> {
    window()?;
    automation::state()
}

/// Runs a command by name.
#[wasm_bindgen]
pub fn command(name: &str) {
    if let Some(ctx) = window() {
        automation::queue_command(&ctx, name);
    }
}

/// Panics, to test the error page.
#[wasm_bindgen]
pub fn break_down() {
    panic!("panic by command");
}

/// The widget with an accessible name, as JSON, in pixels of the canvas; `None` if it is not on the screen.
#[wasm_bindgen]
#[must_use]
pub fn widget(label: &str) -> Option<String> {
    let ctx = window()?;
    automation::widget(label).map(|w| widget_json(&w, ctx.zoom_factor()).to_string())
}

/// All widgets, as JSON.
#[wasm_bindgen]
#[must_use]
pub fn widgets() -> Option<String> {
    let ctx = window()?;
    let all = automation::widgets().iter().map(|w| widget_json(w, ctx.zoom_factor())).collect();
    Some(Value::Array(all).to_string())
}

/// The memory of the window's side of the program (bytes), the number of collected frames, and the duration of
/// the last job (s), as JSON.
#[wasm_bindgen]
#[must_use]
pub fn measured() -> String {
    const PAGE: usize = 65_536;
    let memory = core::arch::wasm32::memory_size(0) * PAGE;
    json!({ "memory": memory, "frames": automation::frames(), "took": last_duration() }).to_string()
}

/// Starts to update a description of the salon for screen readers in an element.
#[wasm_bindgen]
pub fn describe(element: HtmlElement) {
    if let Some(ctx) = window() {
        aria_tree::install(element, &ctx);
        ctx.request_repaint();
    }
}

fn widget_json(widget: &Widget, zoom: f32) -> Value {
    let Widget { role, label, value, number, on, enabled, rect, node: _ } = widget;
    let Rect { min, .. } = *rect * zoom;
    let size = rect.size() * zoom;
    json!({
        "label": label,
        "role": format!("{role:?}"),
        "value": value,
        "number": number.map(|n| n[0]),
        "on": on,
        "enabled": enabled,
        "x": min.x, "y": min.y, "width": size.x, "height": size.y,
    })
}
