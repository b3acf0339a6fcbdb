//! The salon on a page: started by `page/start.js`, its workers by `page/worker.js`.

pub mod driving;
pub mod files;
mod graphics;
mod mirror;
mod outside;
pub mod storage;
mod trouble;
pub mod worker;

use crate::state::Command;

use crate::window::{App, Parts, wake};
use crate::work::web::WebWorker;
use eframe::{CreationContext, WebOptions, WebRunner};
use frisure::scene::edit;
use frisure_engine::Request;
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
    fn samples(this: &Opened) -> Option<f64>;
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

/// An order that draws no more hairs than the page's address allows (`?hairs=`): for slow devices.
pub(crate) fn fewer_hairs(mut order: Request) -> Request {
    let most = opened().and_then(|opened| opened.hairs());
    if let (Request::Preview { scene: asked, .. }, Some(most)) = (&mut order, most)
        && let Ok(text) = edit::set_key(&asked.text, "wisps.hairs", &format!("{most:.0}"))
    {
        asked.text = text;
    }
    order
}

/// Starts the salon on a canvas.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement, opened: Opened) -> Result<(), JsValue> {
    trouble::call(opened.broken());
    let graphics = graphics::wanted(&opened.backend());
    OPENED.with(|known| *known.borrow_mut() = Some(opened.clone()));
    let options = WebOptions { wgpu_options: graphics, ..Default::default() };
    let create = move |cc: &CreationContext<'_>| {
        driving::drive(&cc.egui_ctx);
        graphics::tell_when_lost(cc);
        app(cc, &opened)
    };
    WebRunner::new().start(canvas, options, Box::new(create)).await
}

fn app(cc: &CreationContext<'_>, opened: &Opened) -> Created {
    let wake = wake(&cc.egui_ctx);
    let parts = Parts {
        hair: Box::new(WebWorker::start(wake.clone())?),
        aside: Box::new(WebWorker::start(wake.clone())?),
        outside: Box::new(outside::Page::new(wake)),
        samples: opened.samples().map_or(4, |samples| samples as u32),
    };
    let mut app = App::new(cc, parts);
    if let Some(name) = opened.scene() {
        app.run(Command::Begin(name));
    }
    Ok(Box::new(app))
}

type Created = Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>>;
