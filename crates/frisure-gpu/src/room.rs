//! Buffers on the device, and the dispatches that bring what is in them to rest.

use bytemuck::{Pod, Zeroable};
use wgpu::{BufferUsages, PollType};

use crate::part::{LANES, Measure, OF_WORK, Part};
use crate::{Device, Error};

/// Sweeps in one dispatch: so few that no driver takes it for one that hangs, and that hairs which need many do not keep
/// others waiting.
const SWEEPS: u32 = 8;

/// When a hair is at rest on the device, as in `shaders/hairs.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Rest {
    hairs: u32,
    joints: u32,
    turns: u32,
    sweeps: u32,
    most: u32,
    tolerance: f32,
}

/// How far a hair has come, as there.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Progress {
    energy: f32,
    damping: f32,
    good: f32,
    bad: f32,
    pub(crate) sweeps: u32,
    state: u32,
}

const SETTLED: u32 = 3;
const LOST: u32 = 4;

impl Progress {
    pub(crate) fn is_settled(&self) -> bool {
        self.state == SETTLED
    }

    fn is_over(&self) -> bool {
        self.state == SETTLED || self.state == LOST
    }
}

/// Room for hairs, here and on the device.
#[derive(Debug)]
pub(crate) struct Room {
    pub(crate) measure: Measure,
    pub(crate) part: Part,
    rest: wgpu::Buffer,
    order: wgpu::Buffer,
    roots: wgpu::Buffer,
    arms: wgpu::Buffer,
    turns: wgpu::Buffer,
    controls: wgpu::Buffer,
    progress: wgpu::Buffer,
    /// What is read here.
    controls_here: wgpu::Buffer,
    progress_here: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Room {
    pub(crate) fn new(device: &Device, measure: Measure) -> Self {
        let part = Part::new(measure);
        let make = |label, bytes: usize, usage| {
            device.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: bytes as u64,
                usage,
                mapped_at_creation: false,
            })
        };
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
        let both = storage | BufferUsages::COPY_SRC;
        let here = BufferUsages::MAP_READ | BufferUsages::COPY_DST;
        let uniform = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let hairs = measure.hairs;
        let progressed = size_of::<Progress>() * hairs;
        let rest = make("rest", size_of::<Rest>(), uniform);
        let order = make("order", 4 * hairs, storage);
        let roots = make("roots", 4 * part.roots.len(), storage);
        let arms = make("arms", 4 * part.arms.len(), storage);
        let turns = make("turns", 4 * part.turns.len(), storage);
        let controls = make("controls", 4 * part.controls.len(), both);
        let work = make("work", 4 * OF_WORK * measure.joints * hairs, BufferUsages::STORAGE);
        let progress = make("progress", progressed, both);
        let bound = [&rest, &order, &roots, &arms, &turns, &controls, &work, &progress];
        let entries = [0, 1, 2, 3, 4, 5, 6, 7].map(|i: u32| wgpu::BindGroupEntry {
            binding: i,
            resource: bound[i as usize].as_entire_binding(),
        });
        let group = device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("hairs"),
            layout: &device.pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        let controls_here = make("controls, here", 4 * part.controls.len(), here);
        let progress_here = make("progress, here", progressed, here);
        Self {
            measure,
            part,
            rest,
            order,
            roots,
            arms,
            turns,
            controls,
            progress,
            controls_here,
            progress_here,
            group,
        }
    }

    /// Brings the first `hairs` of the part to the device, as they start.
    pub(crate) fn load(&self, device: &Device, hairs: usize) -> Result<(), Error> {
        let part = &self.part;
        let write = |buffer, bytes: &[u8]| device.queue.write_buffer(buffer, 0, bytes);
        write(&self.roots, bytemuck::cast_slice(&part.roots));
        write(&self.arms, bytemuck::cast_slice(&part.arms));
        write(&self.turns, bytemuck::cast_slice(&part.turns));
        write(&self.controls, bytemuck::cast_slice(&part.controls));
        write(&self.progress, bytemuck::cast_slice(&vec![Progress::zeroed(); hairs]));
        device.queue.submit([]);
        wait(device)
    }

    /// Brings the first `hairs` to rest, in at most `most` sweeps of each, and tells how far each came.
    pub(crate) fn settle(
        &self,
        device: &Device,
        hairs: usize,
        tolerance: f32,
        most: u32,
    ) -> Result<Vec<Progress>, Error> {
        let mut order: Vec<u32> = (0..hairs as u32).collect();
        let mut progress: Vec<Progress> = Vec::new();
        // A dispatch more, in which those that have used up theirs are told.
        for _ in 0..=most.div_ceil(SWEEPS) {
            let rest = Rest {
                hairs: order.len() as u32,
                joints: self.measure.joints as u32,
                turns: self.measure.turns as u32,
                sweeps: SWEEPS,
                most,
                tolerance,
            };
            self.dispatch(device, &rest, &order);
            progress = read(device, &self.progress, &self.progress_here, hairs)?;
            order.retain(|&hair| !progress[hair as usize].is_over());
            if order.is_empty() {
                break;
            }
        }
        Ok(progress)
    }

    fn dispatch(&self, device: &Device, rest: &Rest, order: &[u32]) {
        let queue = &device.queue;
        queue.write_buffer(&self.rest, 0, bytemuck::bytes_of(rest));
        queue.write_buffer(&self.order, 0, bytemuck::cast_slice(order));
        let mut encoder = encoder(device);
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor::default());
            pass.set_pipeline(&device.pipeline);
            pass.set_bind_group(0, &self.group, &[]);
            pass.dispatch_workgroups(order.len().div_ceil(LANES) as u32, 1, 1);
        }
        queue.submit([encoder.finish()]);
    }

    /// Turns of joints, in the order of [`Part`].
    pub(crate) fn controls(&self, device: &Device) -> Result<Vec<f32>, Error> {
        let count = 3 * self.measure.joints * self.measure.hairs;
        read(device, &self.controls, &self.controls_here, count)
    }
}

/// What is in a buffer there, by way of one that can be read here.
fn read<T: Pod>(
    device: &Device,
    there: &wgpu::Buffer,
    here: &wgpu::Buffer,
    count: usize,
) -> Result<Vec<T>, Error> {
    let bytes = (count * size_of::<T>()) as u64;
    let mut encoder = encoder(device);
    encoder.copy_buffer_to_buffer(there, 0, here, 0, bytes);
    device.queue.submit([encoder.finish()]);
    let (send, arrived) = std::sync::mpsc::channel();
    // Nobody listens any more only where waiting has failed.
    here.map_async(wgpu::MapMode::Read, 0..bytes, move |result| drop(send.send(result)));
    wait(device)?;
    match arrived.try_recv() {
        Ok(Ok(())) => {}
        Ok(Err(error)) => return Err(Error::Lost(error.to_string())),
        Err(_) => return Err(Error::Lost("what it computed did not arrive".to_owned())),
    }
    let read = here.get_mapped_range(0..bytes).map_err(|e| Error::Lost(e.to_string()))?;
    // The bytes need not be where numbers may be.
    let found = bytemuck::pod_collect_to_vec(&read);
    drop(read);
    here.unmap();
    Ok(found)
}

fn encoder(device: &Device) -> wgpu::CommandEncoder {
    device.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
}

fn wait(device: &Device) -> Result<(), Error> {
    let waited = device.device.poll(PollType::wait_indefinitely());
    waited.map(drop).map_err(|error| Error::Lost(error.to_string()))
}
