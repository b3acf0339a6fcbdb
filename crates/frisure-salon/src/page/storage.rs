//! Local storage of the browser: texts by name.

use thiserror::Error;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{DomException, Storage};

/// Prefix of the names; pages of the same host share the storage.
const PREFIX: &str = "frisure:";

/// The reason why a text cannot be stored.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum StorageError {
    /// The browser forbids it, as private windows and settings may.
    #[error("the browser does not allow this page to store data: {0}")]
    Forbidden(String),
    /// The storage is full; browsers allow a page about five megabytes.
    #[error("the browser's storage has no room for {bytes} bytes")]
    Full {
        /// Size of the text.
        bytes: usize,
    },
}

/// Returns the text of a name.
///
/// # Errors
/// The browser forbids it.
pub fn get(name: &str) -> Result<Option<String>, StorageError> {
    storage()?.get_item(&key(name)).map_err(|e| forbidden(&e))
}

/// Stores a text.
///
/// # Errors
/// The browser forbids it, or there is no room; the stored text stays.
pub fn set(name: &str, text: &str) -> Result<(), StorageError> {
    storage()?.set_item(&key(name), text).map_err(|e| match e.dyn_ref::<DomException>() {
        Some(error) if error.name() == "QuotaExceededError" => {
            StorageError::Full { bytes: text.len() }
        }
        _ => forbidden(&e),
    })
}

/// Deletes a text.
///
/// # Errors
/// The browser forbids it.
pub fn remove(name: &str) -> Result<(), StorageError> {
    storage()?.remove_item(&key(name)).map_err(|e| forbidden(&e))
}

fn key(name: &str) -> String {
    format!("{PREFIX}{name}")
}

fn storage() -> Result<Storage, StorageError> {
    let window = web_sys::window().ok_or_else(|| StorageError::Forbidden("no window".into()))?;
    let storage = window.local_storage().map_err(|e| forbidden(&e))?;
    storage.ok_or_else(|| StorageError::Forbidden("it is switched off".into()))
}

fn forbidden(error: &JsValue) -> StorageError {
    let message = error.dyn_ref::<DomException>().map(DomException::message);
    StorageError::Forbidden(message.unwrap_or_else(|| format!("{error:?}")))
}
