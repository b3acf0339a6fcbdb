//! `frisure measure`: the curl of a lock in a photo.

use std::path::Path;

use frisure::formats::picture::photo::{PhotoReadError, Pixels, read};
use frisure::formats::picture::png;
use frisure::measure::{
    Abstention, GivenFibre, Measurement, Options, Outcome, Photo, draw, measure, scene, table,
};
use frisure_engine::photo::KnownFibre;
use frisure_engine::{Error, memory};
use serde::Serialize;

use super::parse_scene;
use crate::args::MeasurePhoto as Arguments;
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, interrupt, outputs};

/// The JSON report; SI units.
#[derive(Serialize)]
struct Report<'a> {
    /// `measured` or `abstained`.
    status: &'static str,
    #[serde(flatten)]
    measurement: Option<&'a Measurement>,
    abstention: Option<&'a Abstention>,
    message: Option<String>,
}

/// Reads the photo, measures it, prints the numbers and writes scene and overlay.
pub(crate) fn run(arguments: &Arguments, quiet: bool) -> Result<ExitStatus, Error> {
    let written: Vec<&Path> =
        [&arguments.output, &arguments.overlay].into_iter().flatten().map(AsRef::as_ref).collect();
    outputs::prepare(&written, &[&arguments.photo])?;
    check_extensions(arguments)?;
    let options = options(arguments)?;
    let most = memory::room(memory::PHOTO_PIXEL, 0.0);
    let pixels = read(&arguments.photo, most).map_err(|e| match e {
        PhotoReadError::Large { .. } => {
            Error::because(&e, "give the part with the lock alone, or save it smaller")
        }
        PhotoReadError::Damaged { .. } => {
            Error::because(&e, "copy it from the camera again, or save it anew as .png")
        }
        _ => Error::because(&e, "give a photo as .png or .jpg"),
    })?;
    let name = arguments.photo.display();
    let photo = Photo::new(pixels.width, pixels.height, &pixels.rgb, arguments.crop)
        .map_err(|e| Error::invalid(format!("{name}: {e}"), "see --crop"))?;
    let bar = Bar::new(quiet);
    let outcome = measure(&photo, &options, &bar)?;
    drop(bar);
    if let Some(path) = &arguments.overlay {
        overlay(path, pixels, &outcome)?;
    }
    report(arguments, &outcome, quiet)?;
    match &outcome.result {
        Ok(found) => {
            write_scene(arguments, found)?;
            Ok(if found.natural.is_some() { ExitStatus::Success } else { ExitStatus::Abstained })
        }
        Err(_) => Ok(ExitStatus::Abstained),
    }
}

fn check_extensions(arguments: &Arguments) -> Result<(), Error> {
    for (path, extension, flag) in
        [(&arguments.output, "toml", "-o"), (&arguments.overlay, "png", "--overlay")]
    {
        let Some(path) = path else { continue };
        if !path.extension().is_some_and(|found| found.eq_ignore_ascii_case(extension)) {
            let problem = format!("`{}` does not end in .{extension}", path.display());
            return Err(Error::invalid(problem, &format!("{flag} writes a .{extension} file")));
        }
    }
    Ok(())
}

fn options(arguments: &Arguments) -> Result<Options, Error> {
    let fibre = known(arguments)
        .fibre()
        .map_err(|e| Error::because(&e, "see --diameter and --axis-ratio"))?;
    let (scale, hang) = (arguments.scale, arguments.hang.into());
    Ok(Options { scale, hang, fibre, length: arguments.length })
}

/// What is known of the fibre.
fn known(arguments: &Arguments) -> KnownFibre {
    KnownFibre {
        hair_type: arguments.hair_type.hair_type(),
        diameter: arguments.diameter,
        axis_ratio: arguments.axis_ratio,
        youngs_modulus: arguments.youngs_modulus,
    }
}

fn report(arguments: &Arguments, outcome: &Outcome, quiet: bool) -> Result<(), Error> {
    if arguments.json {
        let (status, measurement, abstention) = match &outcome.result {
            Ok(found) => ("measured", Some(found), None),
            Err(why) => ("abstained", None, Some(why)),
        };
        let message = abstention.map(ToString::to_string);
        return console::print(&console::json(&Report {
            status,
            measurement,
            abstention,
            message,
        })?);
    }
    match &outcome.result {
        Ok(found) if !quiet => console::say(&table(found, arguments.hang.into())),
        Ok(_) => Ok(()),
        Err(why) => {
            console::note(&format!("not measured: {why}\nhelp: {}", why.hint()));
            Ok(())
        }
    }
}

fn write_scene(arguments: &Arguments, found: &Measurement) -> Result<(), Error> {
    let Some(path) = &arguments.output else { return Ok(()) };
    let source = arguments.photo.file_name().unwrap_or_default().to_string_lossy();
    let given = GivenFibre {
        length: arguments.length,
        diameter: arguments.diameter,
        axis_ratio: arguments.axis_ratio,
        moduli: known(arguments).moduli(),
    };
    let Some(text) = scene(found, arguments.hair_type.name, &given, &source) else {
        console::note(&format!("`{}` is not written: there is no natural curl", path.display()));
        return Ok(());
    };
    // Numbers that are each in range may be impossible together.
    parse_scene(path, text.clone())?.hairstyle_spec()?;
    outputs::write_text(path, &text)
}

fn overlay(path: &Path, mut pixels: Pixels, outcome: &Outcome) -> Result<(), Error> {
    draw(pixels.width, &mut pixels.rgb, &outcome.drawing);
    let rgba: Vec<u8> = pixels.rgb.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect();
    let size = |n: usize| u32::try_from(n).map_err(|e| Error::failed(&e, ""));
    let (width, height) = (size(pixels.width)?, size(pixels.height)?);
    interrupt::writing(|| png::write(path, width, height, &rgba)).map_err(|e| Error::failed(&e, ""))
}
