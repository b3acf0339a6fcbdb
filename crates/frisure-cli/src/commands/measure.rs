//! `frisure measure`: the curl of a lock in a photo.

use std::path::Path;

use frisure::formats::picture::photo::{PhotoReadError, Pixels, read};
use frisure::formats::picture::png;
use frisure::hairstyle::{Ellipticity, HairType};
use frisure::measure::{
    Abstention, Fibre, GivenFibre, Measurement, Options, Outcome, Photo, draw, measure, scene,
    table,
};
use frisure::rod::{Material, Section};
use frisure_engine::Error;
use serde::Serialize;

use super::parse_scene;
use crate::args::MeasurePhoto as Arguments;
use crate::diagnostics::ExitStatus;
use crate::progress::Bar;
use crate::{console, interrupt, outputs};

/// Standard deviation of Young's modulus between people, relative: docs/hair-types.md has 3 to 5 GPa. Chosen.
const MODULUS_SPREAD: f64 = 0.15;

/// Standard deviation of a number of the fibre that was measured, relative. Chosen.
const MEASURED_SPREAD: f64 = 0.03;

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
    let pixels = read(&arguments.photo).map_err(|e| match e {
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
    let fibre =
        fibre(arguments).map_err(|e| Error::because(&e, "see --diameter and --axis-ratio"))?;
    let (scale, hang) = (arguments.scale, arguments.hang.into());
    Ok(Options { scale, hang, fibre, length: arguments.length })
}

/// The fibre of the type, with what is given; stiffness over weight goes with E d² and, of an ellipse, the inverse of the axis ratio.
fn fibre(arguments: &Arguments) -> Result<Fibre, frisure::rod::InvalidQuantity> {
    let kind: &HairType = arguments.hair_type.hair_type();
    let of_type = kind.fibre(Ellipticity::Measured)?;
    let diameter = arguments.diameter.unwrap_or(kind.diameter);
    let ratio = arguments.axis_ratio.unwrap_or(kind.axis_ratio);
    let young = arguments.youngs_modulus.unwrap_or(kind.youngs_modulus);
    let shear = shear_modulus(kind, young);
    let spread = |given: bool, of_type: f64| if given { MEASURED_SPREAD } else { of_type };
    let deviations = [
        2.0 * spread(arguments.diameter.is_some(), kind.diameter_variation),
        spread(arguments.axis_ratio.is_some(), kind.axis_ratio_deviation / kind.axis_ratio),
        spread(arguments.youngs_modulus.is_some(), MODULUS_SPREAD),
    ];
    Ok(Fibre {
        section: Section::from_diameter(diameter, ratio)?,
        material: Material::new(young, shear, of_type.material.density())?,
        torsion: of_type.torsion,
        spread: deviations.iter().map(|d| d * d).sum::<f64>().sqrt(),
    })
}

/// The shear modulus (Pa) that goes with a given Young's modulus (Pa): their ratio is the type's.
fn shear_modulus(kind: &HairType, young: f64) -> f64 {
    kind.shear_modulus * young / kind.youngs_modulus
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
        Ok(found) if !quiet => console::print(&table(found, arguments.hang.into())),
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
    let kind: &HairType = arguments.hair_type.hair_type();
    let given = GivenFibre {
        length: arguments.length,
        diameter: arguments.diameter,
        axis_ratio: arguments.axis_ratio,
        moduli: arguments.youngs_modulus.map(|young| [young, shear_modulus(kind, young)]),
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
