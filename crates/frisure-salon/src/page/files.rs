//! Files in and out of a page: picked by the user, or saved as downloads.

use crate::work::Wake;
use js_sys::{Array, Uint8Array};
use std::cell::RefCell;
use std::collections::VecDeque;
use std::rc::Rc;
use wasm_bindgen::prelude::*;
use wasm_bindgen_futures::{JsFuture, spawn_local};
use web_sys::{Blob, BlobPropertyBag, Document, File, HtmlAnchorElement, HtmlInputElement, Url};

/// A file that the user picked or dropped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PickedFile {
    /// Its name, without folders.
    pub name: String,
    /// Its contents, or the error of reading them.
    pub bytes: Result<Vec<u8>, String>,
}

/// The queue of picked files.
pub type Inbox = Rc<RefCell<VecDeque<PickedFile>>>;

/// Saves bytes as a download.
///
/// # Errors
/// The browser's message.
pub fn download(name: &str, bytes: &[u8]) -> Result<(), String> {
    save(name, bytes).map_err(|e| message(&e))
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
    // Some browsers save nothing if the URL is revoked at once.
    let later = Closure::once_into_js(move || Url::revoke_object_url(&address));
    let window = web_sys::window().ok_or("no window")?;
    window.set_timeout_with_callback_and_timeout_and_arguments_0(later.unchecked_ref(), 60_000)?;
    Ok(())
}

/// Shows the browser's dialog to pick files; they arrive in `inbox`, and `wake` is called for each.
///
/// `accept` has the extensions, such as `.toml,.obj`. Browsers show the dialog only during a click or a key press.
///
/// # Errors
/// The browser's message.
pub fn pick(accept: &str, inbox: Inbox, wake: Wake) -> Result<(), String> {
    show_picker(accept, inbox, wake).map_err(|e| message(&e))
}

fn show_picker(accept: &str, inbox: Inbox, wake: Wake) -> Result<(), JsValue> {
    let document = document()?;
    let input: HtmlInputElement = document.create_element("input")?.unchecked_into();
    input.set_type("file");
    input.set_accept(accept);
    input.set_multiple(true);
    input.set_id("picked-files");
    input.set_hidden(true);
    if let Some(before) = document.get_element_by_id("picked-files") {
        before.remove();
    }
    // In the document, so that it is not collected while the dialog is open.
    document.body().ok_or("no body")?.append_child(&input)?;
    let picked = input.clone();
    let read = Closure::once_into_js(move || {
        picked.remove();
        let Some(files) = picked.files() else { return };
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
    let bytes = read.map(|buffer| Uint8Array::new(&buffer).to_vec()).map_err(|e| message(&e));
    inbox.borrow_mut().push_back(PickedFile { name: file.name(), bytes });
    wake();
}

fn document() -> Result<Document, JsValue> {
    Ok(web_sys::window().and_then(|w| w.document()).ok_or("no document")?)
}

fn message(value: &JsValue) -> String {
    let error = value.dyn_ref::<js_sys::Error>().map(|e| String::from(e.message()));
    error.or_else(|| value.as_string()).unwrap_or_else(|| format!("{value:?}"))
}

/// The MIME type of a file by its name.
fn kind_of(name: &str) -> &'static str {
    match name.rsplit('.').next() {
        Some("png") => "image/png",
        Some("toml") => "application/toml",
        Some("obj") => "model/obj",
        _ => "application/octet-stream",
    }
}
