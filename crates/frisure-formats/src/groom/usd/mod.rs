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
use super::motion::Samples;
use crate::stage_frame::stage_frame;
use frisure_files::frame::{Frame, FrameChoice};
use frisure_usd as usd;

/// The declarations of the formats.
pub(super) static USDC: Declaration =
    declaration(&["usdc", "usd"], "Universal Scene Description, binary", write_binary);
pub(super) static USDA: Declaration =
    declaration(&["usda"], "Universal Scene Description, text", write_text);
pub(super) static USDZ: Declaration =
    declaration(&["usdz"], "Universal Scene Description, package", write_package);

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
        moves: true,
        read: Some(decode),
    }
}

/// Writes what [`check_curves`] has passed, as text.
fn write_text(out: &mut dyn Write, samples: &Samples<'_>, frame: Frame) -> io::Result<()> {
    usd::write_text(out, &write::layer(samples, frame))
}

/// Writes what [`check_curves`] has passed, in binary.
fn write_binary(out: &mut dyn Write, samples: &Samples<'_>, frame: Frame) -> io::Result<()> {
    usd::write_binary(out, &write::layer(samples, frame))
}

/// Writes what [`check_curves`] has passed, in binary and as a package.
fn write_package(out: &mut dyn Write, samples: &Samples<'_>, frame: Frame) -> io::Result<()> {
    // Where layers are read as they lie in the archive, they have to lie so.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::default())
        .with_alignment(64);
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    archive.start_file("groom.usdc", options)?;
    write_binary(&mut archive, samples, frame)?;
    out.write_all(archive.finish()?.get_ref())
}

/// A groom from the bytes of a stage of any kind, or what is wrong with it.
fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let layer = usd::read(bytes)?;
    let stage = usd::Stage::of(&layer)?;
    read::groom(&stage, stage_frame(&stage, choice))
}
