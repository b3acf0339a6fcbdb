//! The window: shows the state of the salon and turns input into commands.

mod app;
pub mod automation;
mod blend;
#[cfg(not(target_arch = "wasm32"))]
pub mod desktop;
mod dialogs;
mod exercise;
mod gallery;
mod icons;
mod keys;
mod lights;
mod ndc;
mod overlay;
mod panels;
pub mod platform;
mod reference;
mod renderer;
mod sections;
mod theme;
mod toolbars;
mod tools;
mod tour;
mod viewport;
mod widgets;

pub use app::{App, Parts, waker};
