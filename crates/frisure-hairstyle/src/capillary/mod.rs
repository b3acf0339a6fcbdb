//! What water does between hairs: how strongly two of them stick together, and into how large locks they gather.
//!
//! A law of fibres that are rooted side by side, without a guide or a head: [`crate::styling`] makes wisps thinner by it,
//! [`crate::strands()`] gathers wet hairs into locks. docs/theory.md, "Wet locks".

mod bridge;
mod coalescence;

pub use bridge::Liquid;
pub use coalescence::{Coalescence, PACKING};
