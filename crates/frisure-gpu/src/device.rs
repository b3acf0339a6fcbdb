//! A graphics processor that can compute.

use std::sync::{Arc, Mutex, PoisonError};

use frisure_rod::batch::Batch;
use pollster::block_on;
use wgpu::{Backends, ErrorFilter};

use crate::part::Measure;
use crate::room::Room;
use crate::{Error, OnDevice};

/// The shader, one subject a file.
pub(crate) const SHADER: &str = concat!(
    include_str!("shaders/matrices.wgsl"),
    include_str!("shaders/turn.wgsl"),
    include_str!("shaders/pivot.wgsl"),
    include_str!("shaders/hairs.wgsl"),
    include_str!("shaders/sweep.wgsl"),
    include_str!("shaders/settle.wgsl"),
);

/// A graphics processor, or a program that stands for one.
///
/// It can be shared by threads, which then take turns at the device. The room that a batch took on it stays for the next of
/// as many hairs and elements.
#[derive(Debug)]
pub struct Device {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) pipeline: wgpu::ComputePipeline,
    name: String,
    software: bool,
    faults: Arc<Faults>,
    /// Whoever has it waits for all that the device does, and hears of every fault.
    turn: Mutex<()>,
    /// Room that nobody is using.
    spare: Mutex<Option<Room>>,
}

/// What went wrong where nobody was asking.
#[derive(Debug, Default)]
struct Faults {
    lost: Mutex<Option<String>>,
    refused: Mutex<Option<String>>,
}

impl Faults {
    /// A device that is lost stays so.
    fn lost(&self) -> Option<String> {
        self.lost.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn refused(&self) -> Option<String> {
        self.refused.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

fn tell(slot: &Mutex<Option<String>>, what: String) {
    slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(what);
}

impl Device {
    /// The fastest that there is. Where there is no graphics processor this may be a program that stands for one
    /// ([`Self::is_software`]), which is slower than [`Batch`].
    ///
    /// # Errors
    /// [`Error::NoAdapter`] if there is none, [`Error::Unfit`] if it cannot compute with seven buffers at once.
    pub fn new() -> Result<Self, Error> {
        block_on(Self::open(false))
    }

    /// A program that stands for a graphics processor (lavapipe, WARP): for tests, the same on every machine that has
    /// that version of it.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn software() -> Result<Self, Error> {
        block_on(Self::open(true))
    }

    async fn open(software: bool) -> Result<Self, Error> {
        let mut descriptor = wgpu::InstanceDescriptor::new_without_display_handle();
        descriptor.backends = Backends::PRIMARY;
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            force_fallback_adapter: software,
            ..Default::default()
        };
        let adapter = wgpu::Instance::new(descriptor).request_adapter(&options).await;
        let what = if software { "software driver" } else { "graphics processor" };
        let adapter = adapter.map_err(|error| Error::NoAdapter { what, why: error.to_string() })?;
        Self::of(&adapter).await
    }

    async fn of(adapter: &wgpu::Adapter) -> Result<Self, Error> {
        let info = adapter.get_info();
        let name = match info.driver_info.as_str() {
            "" => format!("{} ({})", info.name, info.backend),
            driver => format!("{} ({}, {driver})", info.name, info.backend),
        };
        let unfit = |why: String| Error::Unfit { name: name.clone(), why };
        let had = adapter.limits();
        let limits = wgpu::Limits {
            max_storage_buffers_per_shader_stage: 7,
            max_storage_buffer_binding_size: had.max_storage_buffer_binding_size,
            max_buffer_size: had.max_buffer_size,
            ..wgpu::Limits::downlevel_defaults()
        };
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("hairs at rest"),
            required_limits: limits,
            ..Default::default()
        };
        let (device, queue) =
            adapter.request_device(&descriptor).await.map_err(|e| unfit(e.to_string()))?;
        let faults = Arc::new(Faults::default());
        let heard = Arc::clone(&faults);
        device.set_device_lost_callback(move |_, why| tell(&heard.lost, why));
        let heard = Arc::clone(&faults);
        device.on_uncaptured_error(Arc::new(move |e: wgpu::Error| {
            tell(&heard.refused, e.to_string());
        }));
        let pipeline = pipeline(&device);
        let software = info.device_type == wgpu::DeviceType::Cpu;
        let made = Self {
            device,
            queue,
            pipeline,
            name: name.clone(),
            software,
            faults,
            turn: Mutex::default(),
            spare: Mutex::default(),
        };
        match made.faults.refused() {
            Some(why) => Err(unfit(why)),
            None => Ok(made),
        }
    }

    /// Its name, how it is spoken to, and its driver.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether it is a program on the processor rather than a graphics processor.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.software
    }

    /// Brings hairs to rest as `batch` says; its precision does not matter.
    #[must_use]
    pub fn with(&self, batch: Batch) -> OnDevice<'_> {
        OnDevice::new(self, batch)
    }

    /// Room of this measure: what was used before, or new.
    pub(crate) fn room(&self, measure: Measure) -> Result<Room, Error> {
        let spare = self.spare.lock().unwrap_or_else(PoisonError::into_inner).take();
        match spare.filter(|room| room.measure == measure) {
            Some(room) => Ok(room),
            None => self.watched(|| Ok(Room::new(self, measure))),
        }
    }

    /// Keeps room for the next batch.
    pub(crate) fn keep(&self, room: Room) {
        *self.spare.lock().unwrap_or_else(PoisonError::into_inner) = Some(room);
    }

    /// Does something on the device, once no other thread does; whatever goes wrong there meanwhile is an error.
    pub(crate) fn watched<T>(&self, f: impl FnOnce() -> Result<T, Error>) -> Result<T, Error> {
        let _turn = self.turn.lock().unwrap_or_else(PoisonError::into_inner);
        let filters = [ErrorFilter::Validation, ErrorFilter::OutOfMemory, ErrorFilter::Internal];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let done = f();
        // The last one first, as they are nested. Out of memory is the reason for commands without sense.
        let found: Vec<_> = scopes.into_iter().rev().map(|scope| block_on(scope.pop())).collect();
        let refused = found.into_iter().flatten().map(|error| error.to_string()).next();
        if let Some(why) = self.faults.lost() {
            return Err(Error::Lost(why));
        }
        match refused.or(self.faults.refused()) {
            Some(why) => Err(Error::Refused(why)),
            None => done,
        }
    }
}

fn pipeline(device: &wgpu::Device) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("settle"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("settle"),
        layout: None,
        module: &module,
        entry_point: Some("settle"),
        compilation_options: wgpu::PipelineCompilationOptions {
            zero_initialize_workgroup_memory: false,
            ..Default::default()
        },
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shader_is_valid() {
        let module = naga::front::wgsl::parse_str(SHADER).unwrap_or_else(|e| {
            panic!("{}", e.emit_to_string(SHADER));
        });
        let flags = naga::valid::ValidationFlags::all();
        let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
        validator.validate(&module).unwrap();
    }

    /// The device, if there is one; there must be if `FRISURE_NEEDS_GPU` says so.
    fn device() -> Option<Device> {
        let needed = std::env::var_os("FRISURE_NEEDS_GPU").is_some();
        match Device::new() {
            Ok(device) => Some(device),
            Err(error) => {
                assert!(!needed, "FRISURE_NEEDS_GPU is set: {error}");
                None
            }
        }
    }

    /// A device that is gone is an error, and stays one.
    #[test]
    fn a_lost_device_is_told() {
        let Some(device) = device() else { return };
        device.device.destroy();
        for _ in 0..2 {
            let found = device.with(Batch::default()).settle(&[crate::tests::rod()]);
            assert!(matches!(found, Err(Error::Lost(_))), "{found:?}");
        }
    }

    /// What the device refuses is an error, and says what it was; the next batch is none the worse.
    #[test]
    fn what_is_refused_is_told() {
        let Some(device) = device() else { return };
        let refused = device.watched(|| {
            Ok(device.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("more than there is"),
                size: u64::MAX / 8 * 4,
                usage: wgpu::BufferUsages::STORAGE,
                mapped_at_creation: false,
            }))
        });
        let Err(Error::Refused(why)) = refused else { panic!("{refused:?}") };
        assert!(why.contains("more than there is"), "{why}");
        assert!(device.with(Batch::default()).settle(&[crate::tests::rod()]).is_ok());
    }

    #[test]
    fn a_program_says_that_it_is_one() {
        if let Ok(device) = Device::software() {
            assert!(device.is_software() && !device.name().is_empty());
        }
    }
}
