//! The start of the salon on a canvas.

use super::options::{self, PageOptions};
use super::platform::Browser;
use super::worker_client::WebWorker;
use super::{failure, graphics, js_api};
use crate::locale::Locale;
use crate::state::Command;
use crate::window::{App, Parts, waker};
use eframe::{CreationContext, WebOptions, WebRunner};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

/// Starts the salon on a canvas.
#[wasm_bindgen]
pub async fn start(canvas: HtmlCanvasElement, options: PageOptions) -> Result<(), JsValue> {
    failure::set_handler(options.failed());
    options::set(&options);
    let wgpu_options = graphics::configuration(&options.backend());
    let web_options = WebOptions { wgpu_options, ..Default::default() };
    let create = move |cc: &CreationContext<'_>| {
        js_api::connect(&cc.egui_ctx);
        graphics::report_loss(cc);
        app(cc, &options)
    };
    WebRunner::new().start(canvas, web_options, Box::new(create)).await
}

type Created = Result<Box<dyn eframe::App>, Box<dyn std::error::Error + Send + Sync>>;

fn app(cc: &CreationContext<'_>, options: &PageOptions) -> Created {
    let wake = waker(&cc.egui_ctx);
    let parts = Parts {
        workers: [
            Box::new(WebWorker::start(wake.clone())?),
            Box::new(WebWorker::start(wake.clone())?),
        ],
        platform: Box::new(Browser::new(wake)),
        locale: options.language().and_then(|tag| Locale::of(&tag)),
        samples: options.samples().map_or(4, |samples| samples as u32),
    };
    let mut app = App::new(cc, parts);
    if let Some(name) = options.scene() {
        app.run(Command::Begin(name));
    }
    if let Some(name) = options.exercise() {
        app.run(Command::BeginExercise(name));
    }
    Ok(Box::new(app))
}
