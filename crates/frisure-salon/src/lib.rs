//! The salon: a head of hair that is seen, changed and styled, in a window and in a page.
//!
//! [`state`] is all of it without a toolkit; [`work`] carries its orders out elsewhere; [`window`]
//! shows it, and `page` is what a browser needs.

// What `wasm_bindgen` generates is unsafe.
#![cfg_attr(not(target_arch = "wasm32"), forbid(unsafe_code))]

#[cfg(target_arch = "wasm32")]
pub mod page;
pub mod state;
pub mod window;
pub mod work;
