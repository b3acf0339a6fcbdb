//! The textures on which a picture is drawn.

use std::future::Future as _;

use wgpu::{Device, Queue, Texture, TextureFormat, TextureUsages};

use crate::cache::FrameCache;
use crate::error::ViewError;
use crate::gpu::{self, DEPTH, LIGHT};

/// Targets of one size, the finished picture among them, and what was computed for the last one.
#[derive(Debug)]
pub struct Canvas {
    pub(crate) size: [u32; 2],
    pub(crate) targets: Targets,
    /// For the head, with several samples per pixel, made when first needed.
    pub(crate) fine: Option<Fine>,
    pub(crate) cache: FrameCache,
}

/// Render targets.
#[derive(Debug)]
pub(crate) struct Targets {
    pub(crate) hair: Texture,
    pub(crate) head: Texture,
    pub(crate) depth: Texture,
    pub(crate) picture: Texture,
}

/// Targets with several samples per pixel.
#[derive(Debug)]
pub(crate) struct Fine {
    pub(crate) light: Texture,
    pub(crate) depth: Texture,
}

impl Canvas {
    /// A canvas of `size` pixels across and down.
    ///
    /// # Errors
    /// [`ViewError::Size`], if the device has no such pictures.
    pub fn new(device: &Device, size: [u32; 2]) -> Result<Self, ViewError> {
        check(device, size)?;
        Ok(Self {
            size,
            targets: Targets::new(device, size),
            fine: None,
            cache: FrameCache::default(),
        })
    }

    /// Gives it another size; what it showed is lost.
    ///
    /// # Errors
    /// [`ViewError::Size`]; the canvas is then as it was.
    pub fn resize(&mut self, device: &Device, size: [u32; 2]) -> Result<(), ViewError> {
        check(device, size)?;
        if size != self.size {
            self.size = size;
            self.targets = Targets::new(device, size);
            self.fine = None;
        }
        Ok(())
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The finished picture: red, green, blue as on the screen (sRGB) and unassociated alpha per pixel, row by
    /// row from the top left. Waits for the device, which pages cannot do.
    ///
    /// # Errors
    /// [`ViewError::Lost`], if the device does not answer; [`ViewError::TooLarge`].
    pub fn read(&self, device: &Device, queue: &Queue) -> Result<Vec<u8>, ViewError> {
        let row = 4 * self.size[0];
        let stride = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let needed = u64::from(stride) * u64::from(self.size[1]);
        let most = device.limits().max_buffer_size;
        if needed > most {
            return Err(ViewError::TooLarge { what: "the picture", needed, most });
        }
        let bytes = with_error_scope(device, || self.bytes(device, queue, needed, stride))?;
        let rows = bytes.chunks_exact(stride as usize);
        Ok(rows.flat_map(|all| &all[..row as usize]).copied().collect())
    }

    /// Rows of the picture, each filled up to `stride` bytes.
    fn bytes(
        &self,
        device: &Device,
        queue: &Queue,
        size: u64,
        stride: u32,
    ) -> Result<Vec<u8>, ViewError> {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("picture"),
            size,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        self.copy(device, queue, &buffer, stride);
        mapped(device, &buffer)
    }

    fn copy(&self, device: &Device, queue: &Queue, buffer: &wgpu::Buffer, stride: u32) {
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            self.targets.picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(stride),
                    rows_per_image: None,
                },
            },
            self.targets.picture.size(),
        );
        queue.submit([encoder.finish()]);
    }
}

/// The bytes of a buffer, once all work is done.
fn mapped(device: &Device, buffer: &wgpu::Buffer) -> Result<Vec<u8>, ViewError> {
    let (send, receive) = std::sync::mpsc::channel();
    buffer.slice(..).map_async(wgpu::MapMode::Read, move |result| {
        // Nobody listens where waiting failed.
        let _ = send.send(result);
    });
    device.poll(wgpu::PollType::wait_indefinitely()).map_err(lost)?;
    receive.try_recv().map_err(lost)?.map_err(lost)?;
    let view = buffer.slice(..).get_mapped_range().map_err(lost)?;
    Ok(view.to_vec())
}

/// Does something whose errors would otherwise end the program.
fn with_error_scope<T>(
    device: &Device,
    task: impl FnOnce() -> Result<T, ViewError>,
) -> Result<T, ViewError> {
    let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let result = task();
    let mut context = std::task::Context::from_waker(std::task::Waker::noop());
    // Where there are no pages, the answer is there at once.
    match std::pin::pin!(scope.pop()).poll(&mut context) {
        std::task::Poll::Ready(Some(error)) => Err(lost(error)),
        _ => result,
    }
}

fn lost(error: impl std::fmt::Display) -> ViewError {
    ViewError::Lost(error.to_string())
}

/// Whether there can be pictures of this size.
fn check(device: &Device, [width, height]: [u32; 2]) -> Result<(), ViewError> {
    let most = device.limits().max_texture_dimension_2d;
    let good = |n: u32| (1..=most).contains(&n);
    if good(width) && good(height) { Ok(()) } else { Err(ViewError::Size { width, height, most }) }
}

impl Targets {
    fn new(device: &Device, [width, height]: [u32; 2]) -> Self {
        let drawn = TextureUsages::RENDER_ATTACHMENT;
        let of = |label, format, usage| {
            gpu::texture(device, label, [width, height, 1], format, drawn | usage)
        };
        let none = TextureUsages::empty();
        Self {
            hair: of("hair", LIGHT, none),
            head: of("head", LIGHT, none),
            depth: of("depth", DEPTH, none),
            picture: of("picture", TextureFormat::Rgba8Unorm, TextureUsages::COPY_SRC),
        }
    }
}

impl Fine {
    pub(crate) fn new(device: &Device, size: [u32; 2], count: u32) -> Self {
        Self {
            light: gpu::samples(device, "head, fine", size, LIGHT, count),
            depth: gpu::samples(device, "depth, fine", size, DEPTH, count),
        }
    }
}
