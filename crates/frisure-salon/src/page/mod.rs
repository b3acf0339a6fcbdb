//! The salon on a page: started by `page/start.js`, its workers by `page/worker.js`.

pub mod driving;
pub mod files;
mod graphics;
mod mirror;
pub mod storage;
mod trouble;
pub mod worker;

use crate::window::App;
use eframe::{CreationContext, WebOptions, WebRunner};
use std::cell::RefCell;
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

#[wasm_bindgen]
extern "C" {
    /// What the page hands over: see `page/start.js`.
    #[derive(Clone)]
    pub type Opened;
    #[wasm_bindgen(method, getter)]
    fn backend(this: &Opened) -> String;
    #[wasm_bindgen(method, getter)]
    pub(crate) fn module(this: &Opened) -> JsValue;
    #[wasm_bindgen(method, getter)]
    pub(crate) fn build(this: &Opened) -> String;
    #[wasm_bindgen(method, getter)]
    pub(crate) fn worker(this: &Opened) -> String;
    #[wasm_bindgen(method, getter)]
    fn scene(this: &Opened) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn hairs(this: &Opened) -> Option<f64>;
    #[wasm_bindgen(method, getter)]
    fn broken(this: &Opened) -> js_sys::Function;
}

thread_local! {
    static OPENED: RefCell<Option<Opened>> = const { RefCell::new(None) };
}

/// What this page was opened with; `None` in a worker.
pub(crate) fn opened() -> Option<Opened> {
    OPENED.with(|opened| opened.borrow().clone())
}

/// The scene that the page's address asks for (`?scene=`).
#[must_use]
pub fn scene_asked() -> Option<String> {
    opened()?.scene()
}

/// How many hairs to draw at most, if the page's address says (`?hairs=`).
#[must_use]
pub fn hairs_asked() -> Option<usize> {
    // JavaScript's numbers are f64; a cast from one stays within the range.
    opened()?.hairs().map(|hairs| hairs as usize)
}

/// Starts the salon on a canvas.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement, opened: Opened) -> Result<(), JsValue> {
    trouble::call(opened.broken());
    let graphics = graphics::wanted(&opened.backend());
    OPENED.with(|known| *known.borrow_mut() = Some(opened));
    let options = WebOptions { wgpu_options: graphics, ..Default::default() };
    let create = |cc: &CreationContext<'_>| {
        driving::drive(&cc.egui_ctx);
        graphics::tell_when_lost(cc);
        Ok(Box::new(App::new(cc)) as Box<dyn eframe::App>)
    };
    WebRunner::new().start(canvas, options, Box::new(create)).await
}
