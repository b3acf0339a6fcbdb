//! Pictures of a scene: their subject, the accumulation of samples, turntables and files.

mod accumulate;
#[cfg(not(target_arch = "wasm32"))]
mod denoise;
#[cfg(not(target_arch = "wasm32"))]
mod file;
#[cfg(not(target_arch = "wasm32"))]
mod frames;
mod options;
mod subject;
mod traced;
mod turntable;
#[cfg(not(target_arch = "wasm32"))]
mod views;

#[cfg(not(target_arch = "wasm32"))]
pub use denoise::NoiseFilter;
#[cfg(not(target_arch = "wasm32"))]
pub use file::write;
#[cfg(not(target_arch = "wasm32"))]
pub use frames::{FinalPicture, FrameSet, TraceEnd};
pub use options::{aspect, developed, spec};
pub use subject::{Frames, Subject, Viewpoint};
#[cfg(not(target_arch = "wasm32"))]
pub use views::{View, Viewed};

pub(crate) use accumulate::{Pauses, accumulate};
pub(crate) use turntable::{check_turntable, film, previews, turntable};
