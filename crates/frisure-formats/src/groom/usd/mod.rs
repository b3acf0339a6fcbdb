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

use std::io::{self, Cursor, Write};

use zip::CompressionMethod;
use zip::write::{SimpleFileOptions, ZipWriter};

use super::checked::check_curves;
use super::data::Groom;
use super::format::{Declaration, Writer};
use crate::stage_frame::stage_frame;
use frisure_files::frame::{Frame, FrameChoice};
use frisure_usd as usd;

/// The declarations of the formats.
pub(super) static USDC: Declaration =
    declaration(&["usdc", "usd"], "Universal Scene Description, binary", encode_binary);
pub(super) static USDA: Declaration =
    declaration(&["usda"], "Universal Scene Description, text", encode_text);
pub(super) static USDZ: Declaration =
    declaration(&["usdz"], "Universal Scene Description, package", encode_package);

const fn declaration(
    extensions: &'static [&'static str],
    title: &'static str,
    write: Writer,
) -> Declaration {
    Declaration {
        extensions,
        title,
        frame: Frame::METRES_Z,
        holds_guides: true,
        usual_points: None,
        most_hairs: None,
        check: check_curves,
        write,
        read: Some(decode),
    }
}

/// Writes what [`check_curves`] has passed, as text.
fn encode_text(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    usd::write_text(out, &write::layer(groom, frame))
}

/// Writes what [`check_curves`] has passed, in binary.
fn encode_binary(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    usd::write_binary(out, &write::layer(groom, frame))
}

/// Writes what [`check_curves`] has passed, in binary and as a package.
fn encode_package(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    // Where layers are read as they lie in the archive, they have to lie so.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::default())
        .with_alignment(64);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    archive.start_file("groom.usdc", options)?;
    encode_binary(&mut archive, groom, frame)?;
    out.write_all(archive.finish()?.get_ref())
}

/// A groom from the bytes of a stage of any kind, or what is wrong with it.
fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let layer = usd::read(bytes)?;
    let stage = usd::Stage::of(&layer)?;
    read::groom(&stage, stage_frame(&stage, choice))
}
