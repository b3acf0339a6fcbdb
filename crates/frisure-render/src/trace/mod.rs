//! The final picture: an unbiased path tracer.
//!
//! Beside the attributes that [`crate::Scene`] lists it uses `d1` (three numbers per point), the director along
//! the semi-axis a of the section, and `axis_ratio` (a/b, per strand); without them fibres are round. Rays hit
//! round tubes of the mean radius.
//!
//! A [`Tracer`] holds a scene ready for rays. It adds samples to an [`Accumulator`] (the film), tile by tile, until
//! it is done or stopped; the accumulator is a picture at any time, and can be written to a checkpoint and resumed.
//! In the order of the computation: `lens` makes camera rays through the pixel filter, `sampler` gives each sample
//! of each pixel its random numbers, `integrator` follows the path with next-event estimation, multiple importance
//! sampling and Russian roulette; it evaluates the `bsdf` of `fibres` and of `rough_plastic` (skin and `floor`)
//! and samples lights by the `light_sampler`. [`crate::accel`] intersects rays.

mod accumulator;
mod bsdf;
mod fibres;
mod floor;
mod integrator;
mod lens;
mod light_sampler;
mod options;
mod rough_plastic;
mod sampler;
mod scene_digest;
mod subsurface;
mod tracer;

pub use accumulator::{
    Accumulator, AccumulatorError, Layers, MAGIC as ACCUMULATOR_MAGIC,
    VERSION as ACCUMULATOR_VERSION,
};
pub use options::{MAX_PIXELS, MAX_SAMPLES, TraceError, TraceOptions};
pub use tracer::{Tracer, render};
