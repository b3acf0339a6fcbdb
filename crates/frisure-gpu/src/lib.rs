//! Many hairs brought to rest on a graphics processor.
//!
//! What [`frisure_rod::batch::Batch`] does in the lanes of the processor's vectors, one hair in each invocation of a compute
//! shader (WebGPU's, hence Vulkan, Metal and DirectX 12): Newton's method by dynamic programming over the joints of a hair, in its own weight.
//!
//! ```no_run
//! use frisure_gpu::Device;
//! use frisure_rod::Rod;
//! use frisure_rod::batch::{Batch, Settle};
//!
//! # fn hairs() -> Vec<Rod> { Vec::new() }
//! let rods: Vec<Rod> = hairs();
//! let batch = Batch { elements: 30, ..Batch::default() };
//! // On the graphics processor, if there is one.
//! let device = Device::new();
//! let settle: Box<dyn Settle + '_> = match &device {
//!     Ok(device) if !device.is_software() => Box::new(device.with(batch)),
//!     _ => Box::new(batch),
//! };
//! let rest = settle.settle(&rods)?;
//! # Ok::<(), frisure_rod::batch::Unsettled>(())
//! ```
//!
//! # The judge
//!
//! Shaders compute in single precision. That is enough for the way, not for the end: what the device calls rest only starts
//! [`Batch`], which takes the last step or two in double precision and certifies each hair, as it does without a device. What the
//! device gives up it does from the start. So an answer is what `Batch` calls one, whatever the device does; a
//! hair with several equilibria may come to another of them, as with any other way.
//!
//! # What is the same, and what is not
//!
//! - The same device with the same driver gives the same bytes, on any number of threads. Other devices round otherwise: their
//!   answers agree within the tolerance of the batch.
//! - Memory: 150 bytes a joint on the device, at most about two million joints at once; larger batches go in parts. The room that the last
//!   batch took is kept for the next.
//! - Nothing is printed, and no environment variable read. [`OnDevice::settle`] reports where the time went.
//! - A device that is lost, out of memory or missing is an [`Error`]; nothing is tried again.
//!
//! # What it does not do
//!
//! - Hairs that touch something: [`Batch::settle_among`].
//! - Pages in a browser: it waits for the device, which they must not.
//! - Much, where the judge is needed: `docs/performance.md`, "On a graphics processor", tells what can be gained.
//!
//! [`Batch`]: frisure_rod::batch::Batch
//! [`Batch::settle_among`]: frisure_rod::batch::Batch::settle_among

mod device;
mod error;
mod part;
mod room;
mod settle;

pub use device::Device;
pub use error::Error;
pub use settle::{OnDevice, Report, Seconds, Unjudged};

#[cfg(test)]
mod tests {
    use frisure_rod::{Material, NaturalStrain, Rod, RodSpec, Root, Section, TorsionConstant};
    use glam::DVec3;

    /// A hair like any other.
    pub(crate) fn rod() -> Rod {
        Rod::new(RodSpec {
            length: 0.15,
            section: Section::from_diameter(70e-6, 1.2).unwrap(),
            material: Material::new(3.9e9, 0.9e9, 1300.0).unwrap(),
            torsion: TorsionConstant::SaintVenant,
            natural: NaturalStrain::helix(0.01, 0.03).unwrap(),
            root: Root::from_tangent(DVec3::ZERO, DVec3::X, DVec3::Z).unwrap(),
            gravity: 9.81,
        })
        .unwrap()
    }
}
