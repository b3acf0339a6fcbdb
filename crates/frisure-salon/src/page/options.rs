//! The options that the page passes to the program.

use frisure::scene::edit;
use frisure_engine::Request;
use std::cell::RefCell;
use wasm_bindgen::prelude::*;

#[wasm_bindgen]
extern "C" {
    /// The options of `page/start.js`.
    #[derive(Clone)]
    pub type PageOptions;
    #[wasm_bindgen(method, getter)]
    pub(super) fn backend(this: &PageOptions) -> String;
    #[wasm_bindgen(method, getter)]
    pub(super) fn module(this: &PageOptions) -> JsValue;
    #[wasm_bindgen(method, getter)]
    pub(super) fn build(this: &PageOptions) -> String;
    #[wasm_bindgen(method, getter)]
    pub(super) fn worker(this: &PageOptions) -> String;
    #[wasm_bindgen(method, getter)]
    pub(super) fn scene(this: &PageOptions) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    pub(super) fn exercise(this: &PageOptions) -> Option<String>;

    #[wasm_bindgen(method, getter)]
    pub(super) fn language(this: &PageOptions) -> Option<String>;

    #[wasm_bindgen(method, getter)]
    pub(super) fn hairs(this: &PageOptions) -> Option<f64>;
    #[wasm_bindgen(method, getter)]
    pub(super) fn samples(this: &PageOptions) -> Option<f64>;
    #[wasm_bindgen(method, getter)]
    pub(super) fn failed(this: &PageOptions) -> js_sys::Function;
}

thread_local! {
    static OPTIONS: RefCell<Option<PageOptions>> = const { RefCell::new(None) };
}

/// Stores the options of this page.
pub(super) fn set(options: &PageOptions) {
    OPTIONS.set(Some(options.clone()));
}

/// The options of this page; `None` in a worker.
pub(super) fn get() -> Option<PageOptions> {
    OPTIONS.with_borrow(Clone::clone)
}

/// Limits the strands of a request to the number in the page's address (`?hairs=`), for slow devices.
pub(super) fn limit_strands(mut request: Request) -> Request {
    let most = get().and_then(|options| options.hairs());
    if let (Request::Preview { scene, .. }, Some(most)) = (&mut request, most)
        && let Ok(text) = edit::set_key(&scene.text, "wisps.hairs", &format!("{most:.0}"))
    {
        scene.text = text;
    }
    request
}
