//! The window.

#[cfg(target_arch = "wasm32")]
mod placeholder;
pub mod probe;

#[cfg(target_arch = "wasm32")]
pub use placeholder::App;
