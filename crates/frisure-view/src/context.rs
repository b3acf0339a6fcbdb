//! The context of one frame.

use wgpu::{BindGroup, Device, Queue};

use crate::frame::Frame;
use crate::lamps::Lamp;
use crate::renderer::Renderer;

/// The device, the frame and what was prepared for it, while it is drawn.
pub(crate) struct FrameContext<'a> {
    pub(crate) renderer: &'a Renderer,
    pub(crate) device: &'a Device,
    pub(crate) queue: &'a Queue,
    pub(crate) frame: &'a Frame<'a>,
    /// Its numbers, for shaders.
    pub(crate) picture: BindGroup,
    pub(crate) lamps: Vec<Lamp>,
    /// Strands that are drawn, and vertices of these.
    pub(crate) strands: usize,
    pub(crate) vertices: usize,
}
