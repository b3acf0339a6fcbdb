//! Grooms in stages of Universal Scene Description: `.usda` text, `.usdc` binary.
//!
//! `docs/formats.md` has the prims and primvars.

mod basis;
mod look;
mod names;
mod primvars;
mod read;
mod write;

#[cfg(test)]
mod tests;

use std::io::{self, Write};

use super::Groom;
use crate::frame::{Frame, FrameChoice};
use crate::usd;

pub(super) use write::check;

/// Writes what [`check`] has passed, as text.
pub(super) fn encode_text(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    usd::write_text(out, &write::layer(groom, frame))
}

/// Writes what [`check`] has passed, in binary.
pub(super) fn encode_binary(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    usd::write_binary(out, &write::layer(groom, frame))
}

/// A groom from the bytes of a stage of any kind, or what is wrong with it.
pub(super) fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let layer = usd::read(bytes)?;
    read::groom(&usd::Stage::of(&layer, choice)?)
}
