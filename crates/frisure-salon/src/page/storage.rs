//! What the browser keeps for this page: texts by name.

use thiserror::Error;
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{DomException, Storage};

/// Names begin so: other pages of the same host keep theirs in the same place.
const OURS: &str = "frisure:";

/// Why a text cannot be kept.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub enum StorageError {
    /// Private windows and settings may forbid it.
    #[error("this browser keeps nothing for this page: {0}")]
    Forbidden(String),
    /// Browsers give a page some five megabytes.
    #[error("there is no room left for {bytes} bytes in what this browser keeps for this page")]
    Full {
        /// What was to be kept.
        bytes: usize,
    },
}

/// The text of this name, if one is kept.
///
/// # Errors
/// The browser forbids it.
pub fn get(name: &str) -> Result<Option<String>, StorageError> {
    storage()?.get_item(&key(name)).map_err(|e| forbidden(&e))
}

/// Keeps a text.
///
/// # Errors
/// The browser forbids it, or there is no room; what was kept before stays.
pub fn set(name: &str, text: &str) -> Result<(), StorageError> {
    storage()?.set_item(&key(name), text).map_err(|e| match e.dyn_ref::<DomException>() {
        Some(told) if told.name() == "QuotaExceededError" => {
            StorageError::Full { bytes: text.len() }
        }
        _ => forbidden(&e),
    })
}

/// Forgets a text.
///
/// # Errors
/// The browser forbids it.
pub fn remove(name: &str) -> Result<(), StorageError> {
    storage()?.remove_item(&key(name)).map_err(|e| forbidden(&e))
}

fn key(name: &str) -> String {
    format!("{OURS}{name}")
}

fn storage() -> Result<Storage, StorageError> {
    let window = web_sys::window().ok_or_else(|| StorageError::Forbidden("no window".into()))?;
    let storage = window.local_storage().map_err(|e| forbidden(&e))?;
    storage.ok_or_else(|| StorageError::Forbidden("it is switched off".into()))
}

fn forbidden(told: &JsValue) -> StorageError {
    let words = told.dyn_ref::<DomException>().map(DomException::message);
    StorageError::Forbidden(words.unwrap_or_else(|| format!("{told:?}")))
}
