//! Files in and out of a page: chosen by the person who sits there, or saved to their downloads.

use crate::window::Wake;
use js_sys::{Array, Uint8Array};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, BlobPropertyBag, Document, File, HtmlAnchorElement, HtmlInputElement, Url};

/// A chosen file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chosen {
    /// Its name, without folders.
    pub name: String,
    /// What is in it, or why it cannot be read.
    pub bytes: Result<Vec<u8>, String>,
}

/// Where chosen files arrive.
pub type Inbox = Rc<RefCell<VecDeque<Chosen>>>;

/// Saves bytes to the browser's downloads.
///
/// # Errors
/// The browser's words.
pub fn download(name: &str, bytes: &[u8]) -> Result<(), String> {
    save(name, bytes).map_err(|e| words(&e))
}

fn save(name: &str, bytes: &[u8]) -> Result<(), JsValue> {
    let kind = BlobPropertyBag::new();
    kind.set_type(kind_of(name));
    let parts = Array::of1(&Uint8Array::from(bytes));
    let blob = Blob::new_with_u8_array_sequence_and_options(&parts, &kind)?;
    let address = Url::create_object_url_with_blob(&blob)?;
    let link: HtmlAnchorElement = document()?.create_element("a")?.unchecked_into();
    link.set_href(&address);
    link.set_download(name);
    link.click();
    // The browser holds what it saves; given back at once, some save nothing.
    let later = Closure::once_into_js(move || Url::revoke_object_url(&address));
    let window = web_sys::window().ok_or("no window")?;
    window.set_timeout_with_callback_and_timeout_and_arguments_0(later.unchecked_ref(), 60_000)?;
    Ok(())
}

/// Lets the person choose files; they arrive in `inbox`, and `wake` is called for each.
///
/// `accept` is what the dialogue offers, such as `.toml,.obj`. Browsers open the dialogue only as an
/// answer to a click or a key.
///
/// # Errors
/// The browser's words.
pub fn choose(accept: &str, inbox: Inbox, wake: Wake) -> Result<(), String> {
    ask(accept, inbox, wake).map_err(|e| words(&e))
}

fn ask(accept: &str, inbox: Inbox, wake: Wake) -> Result<(), JsValue> {
    let document = document()?;
    let input: HtmlInputElement = document.create_element("input")?.unchecked_into();
    input.set_type("file");
    input.set_accept(accept);
    input.set_multiple(true);
    input.set_id("chosen-files");
    input.set_hidden(true);
    if let Some(before) = document.get_element_by_id("chosen-files") {
        before.remove();
    }
    // In the page, so that the browser keeps it while the dialogue is open.
    document.body().ok_or("no body")?.append_child(&input)?;
    let chosen = input.clone();
    let read = Closure::once_into_js(move || {
        chosen.remove();
        let Some(files) = chosen.files() else { return };
        for file in (0..files.length()).filter_map(|i| files.get(i)) {
            spawn_local(arrive(file, Rc::clone(&inbox), Wake::clone(&wake)));
        }
    });
    input.set_onchange(Some(read.unchecked_ref()));
    input.click();
    Ok(())
}

async fn arrive(file: File, inbox: Inbox, wake: Wake) {
    let read = JsFuture::from(file.array_buffer()).await;
    let bytes = read.map(|buffer| Uint8Array::new(&buffer).to_vec()).map_err(|e| words(&e));
    inbox.borrow_mut().push_back(Chosen { name: file.name(), bytes });
    wake();
}

fn document() -> Result<Document, JsValue> {
    Ok(web_sys::window().and_then(|w| w.document()).ok_or("no document")?)
}

fn words(told: &JsValue) -> String {
    let error = told.dyn_ref::<js_sys::Error>().map(|e| String::from(e.message()));
    error.or_else(|| told.as_string()).unwrap_or_else(|| format!("{told:?}"))
}

/// The kind of a file (MIME) by its name.
fn kind_of(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("png") => "image/png",
        Some("toml") => "application/toml",
        Some("obj") => "model/obj",
        _ => "application/octet-stream",
    }
}
