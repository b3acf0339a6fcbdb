//! Interactive pictures of hair on a GPU.

mod canvas;
mod error;
mod frame;
mod gpu;
mod hair;
mod half;
mod lamps;
mod maps;
mod paint;
mod renderer;
mod room;
mod skin;
mod uniforms;

pub use canvas::Canvas;
pub use error::ViewError;
pub use frame::{Frame, Line, MAX_PLANES, Mark, MarkColours, Plane, Shadows};
pub use hair::Hair;
pub use renderer::Renderer;
pub use skin::Skin;
