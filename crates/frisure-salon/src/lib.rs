//! The salon: shows, edits and styles a head of hair, in a window or in a page.
//!
//! [`state`] is the application without a toolkit; [`work`] executes its requests on another thread; [`window`]
//! shows it; `page` has what a browser needs.

// `wasm_bindgen` generates unsafe code.
#![cfg_attr(not(target_arch = "wasm32"), forbid(unsafe_code))]

pub mod locale;
#[cfg(target_arch = "wasm32")]
pub mod page;
pub mod state;
pub mod window;
pub mod work;
