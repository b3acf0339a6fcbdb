//! The salon.

#[cfg(target_arch = "wasm32")]
pub mod page;
pub mod window;
pub mod work;
