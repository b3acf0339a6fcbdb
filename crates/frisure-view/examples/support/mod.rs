//! A device without a window, for examples and tests.

#![allow(dead_code, reason = "shared by programs that each use a part")]
#![allow(unreachable_pub, reason = "as above")]

pub mod measure;

use frisure_view::{Canvas, Frame, Renderer, ViewError};
use wgpu::{Adapter, Backends, Device, Queue};

/// A device to draw on.
pub struct Gpu {
    pub adapter: Adapter,
    pub device: Device,
    pub queue: Queue,
    pub renderer: Renderer,
}

impl Gpu {
    /// The first adapter that `WGPU_BACKEND` allows, with the limits that every browser has; `SAMPLES` per pixel of the head, 4 by default.
    pub fn new() -> Option<Self> {
        pollster::block_on(Self::open())
    }

    async fn open() -> Option<Self> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = Backends::from_env().unwrap_or_default();
        let instance = wgpu::Instance::new(descriptor);
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = instance.request_adapter(&options).await.ok()?;
        let limits = wgpu::Limits::downlevel_webgl2_defaults();
        let descriptor = wgpu::DeviceDescriptor {
            required_limits: limits.using_resolution(adapter.limits()),
            ..Default::default()
        };
        let (device, queue) = adapter.request_device(&descriptor).await.ok()?;
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let samples = std::env::var("SAMPLES").map_or(4, |s| s.parse().unwrap_or(4));
        let renderer = Renderer::new(&device, &queue, format, samples);
        Some(Self { adapter, device, queue, renderer })
    }

    /// Draws a frame.
    pub fn draw(&self, canvas: &mut Canvas, frame: &Frame<'_>) {
        let mut encoder =
            self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        self.renderer.draw(&self.device, &self.queue, &mut encoder, canvas, frame);
        self.queue.submit([encoder.finish()]);
    }

    /// Draws a frame of a size and reads it.
    pub fn picture(&self, frame: &Frame<'_>, size: [u32; 2]) -> Result<Vec<u8>, ViewError> {
        let mut canvas = Canvas::new(&self.device, size)?;
        self.draw(&mut canvas, frame);
        canvas.read(&self.device, &self.queue)
    }

    /// Waits until all is done.
    pub fn wait(&self) {
        // A lost device has nothing to wait for.
        let _ = self.device.poll(wgpu::PollType::wait_indefinitely());
    }
}
