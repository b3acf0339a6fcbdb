//! Wisps: the guide's curve and the hairs that follow it. Graphics programs call a wisp a *clump*.

mod bound_strand;
mod waves;
mod wisp;

pub(crate) use bound_strand::{BoundStrand, BoundStrands, WISP_SAMPLES};
pub(crate) use waves::Waves;
pub(crate) use wisp::{Place, Wisp};
