//! The salon driven by a program or read by a screen reader: `window.frisure` of the page.

use super::mirror;
use crate::window::probe::{self, Widget};
use crate::work::web::last_took;
use eframe::egui::{Context, Rect};
use serde_json::{Value, json};
use std::cell::RefCell;
use wasm_bindgen::prelude::*;
use web_sys::HtmlElement;

thread_local! {
    static CONTEXT: RefCell<Option<Context>> = const { RefCell::new(None) };
}

/// Lets the functions of this file reach the window.
pub(crate) fn drive(ctx: &Context) {
    CONTEXT.with(|known| *known.borrow_mut() = Some(ctx.clone()));
}

/// The window; from the first call on, what it shows is collected.
fn window() -> Option<Context> {
    let ctx = CONTEXT.with(|known| known.borrow().clone())?;
    probe::watch(&ctx);
    Some(ctx)
}

/// What the salon knows, as JSON; nothing before its first frame.
#[wasm_bindgen]
#[must_use]
pub fn state() -> Option<String> {
    window()?;
    probe::state()
}

/// Asks the salon to do something, by the name of its command.
#[wasm_bindgen]
pub fn command(name: &str) {
    if let Some(ctx) = window() {
        probe::ask(&ctx, name);
    }
}

/// Breaks down, to see what the page does then.
#[wasm_bindgen]
pub fn break_down() {
    panic!("asked to break down");
}

/// The widget of this accessible name, as JSON, in the canvas's own pixels; nothing if it is not on
/// the screen.
#[wasm_bindgen]
#[must_use]
pub fn widget(label: &str) -> Option<String> {
    let ctx = window()?;
    probe::widget(label).map(|w| described(&w, ctx.zoom_factor()).to_string())
}

/// All widgets, as JSON.
#[wasm_bindgen]
#[must_use]
pub fn widgets() -> Option<String> {
    let ctx = window()?;
    let all = probe::widgets().iter().map(|w| described(w, ctx.zoom_factor())).collect();
    Some(Value::Array(all).to_string())
}

/// Memory of the window's side of the program (bytes), frames that were looked at, and how long the
/// last work took (s), as JSON.
#[wasm_bindgen]
#[must_use]
pub fn measured() -> String {
    const PAGE: usize = 65_536;
    let memory = core::arch::wasm32::memory_size(0) * PAGE;
    json!({ "memory": memory, "frames": probe::passes(), "took": last_took() }).to_string()
}

/// Describes the salon in this element, for screen readers, from now on.
#[wasm_bindgen]
pub fn describe(element: HtmlElement) {
    if let Some(ctx) = window() {
        mirror::describe_in(element, &ctx);
        ctx.request_repaint();
    }
}

fn described(widget: &Widget, zoom: f32) -> Value {
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
