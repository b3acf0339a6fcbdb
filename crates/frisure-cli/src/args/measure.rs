//! Arguments of `frisure measure`.

use std::ops::RangeInclusive;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use frisure::hairstyle::Preset;
use frisure::measure::{Crop, Hang, Scale};
use frisure::scene::quantity::{Dimension, LENGTH, PRESSURE, RATIO};
use frisure_engine::photo;

use super::{hair_type, positive};

const EXAMPLES: &str = "\
Examples:
  frisure measure lock.jpg --scale '52 px/mm'
  frisure measure lock.jpg --scale '600 dpi' --crop 400,0,900,3000 --length '18 cm' -o mine.toml
  frisure measure lock.png --scale '19 um/px' --hang none --overlay seen.png --json

Hang one lock, a few hairs or a single one, freely by its root in front of plain paper or cloth
that is much lighter or darker, with a ruler beside it, and photograph it from 1 m or more. Leave
the ruler out of the crop. The command prints radius and pitch of the curl as it hangs and as it
would be without weight, with the half width of an interval of 95 %. It needs 1.5 waves and more,
12 pixels long and with an amplitude of 3 pixels or more; where the photo does not tell, it says
why, and the exit status is 5. docs/photo.md describes the method and its errors.";

/// Arguments of `frisure measure`.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct MeasurePhoto {
    /// The photo (PNG or JPEG).
    pub(crate) photo: PathBuf,

    /// The scale of the photo, by its ruler: '52 px/mm', '520 px/cm', '1200 dpi', '19 um/px'.
    #[arg(long, value_name = "SCALE", value_parser = scale, allow_hyphen_values = true)]
    pub(crate) scale: Scale,

    /// Measure this part of the photo: left edge, upper edge, width and height (pixels).
    #[arg(long, value_name = "X,Y,W,H", value_parser = crop)]
    pub(crate) crop: Option<Crop>,

    /// Whether weight stretches the lock.
    #[arg(long, value_enum, value_name = "HANG", default_value_t = Hanging::Down)]
    pub(crate) hang: Hanging,

    /// The hair type whose fibre it is, for the stretch by weight; `frisure presets` describes them.
    #[arg(long = "type", value_name = "TYPE", hide_possible_values = true)]
    #[arg(value_parser = hair_type(), default_value = "caucasian-curly")]
    pub(crate) hair_type: &'static Preset,

    /// Length of the hairs. [default: that of the line that is seen]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) length: Option<f64>,

    /// Mean diameter of the hairs, such as '72 um'. [default: the type's]
    #[arg(long, value_name = "LENGTH", value_parser = diameter)]
    pub(crate) diameter: Option<f64>,

    /// Longer over shorter axis of their section. [default: the type's]
    #[arg(long, value_name = "RATIO", value_parser = ratio)]
    pub(crate) axis_ratio: Option<f64>,

    /// Young's modulus, such as '3.9 GPa'; the shear modulus keeps its ratio to it. [default: the type's]
    #[arg(long, value_name = "MODULUS", value_parser = modulus)]
    pub(crate) youngs_modulus: Option<f64>,

    /// Write a scene with the natural curl (.toml).
    #[arg(long, short, value_name = "SCENE")]
    pub(crate) output: Option<PathBuf>,

    /// Write the photo with what was found (.png): ridge lines blue, the fitted wave magenta, its axis yellow.
    #[arg(long, value_name = "PICTURE")]
    pub(crate) overlay: Option<PathBuf>,

    /// Print JSON (SI units) instead of a table.
    #[arg(long)]
    pub(crate) json: bool,
}

/// Whether weight stretches a lock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Hanging {
    /// It hangs by its root, and down is down in the photo.
    Down,
    /// It lies flat, or floats.
    None,
}

impl From<Hanging> for Hang {
    fn from(hanging: Hanging) -> Self {
        match hanging {
            Hanging::Down => Self::Down,
            Hanging::None => Self::None,
        }
    }
}

fn scale(text: &str) -> Result<Scale, String> {
    Scale::parse(text).map_err(|e| e.to_string())
}

fn crop(text: &str) -> Result<Crop, String> {
    let wrong = || "it must be four whole numbers, such as 400,0,900,3000".to_owned();
    let numbers: Result<Vec<usize>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.map_err(|_| wrong())?.as_slice() {
        &[x, y, width, height] => Ok(Crop { x, y, width, height }),
        _ => Err(wrong()),
    }
}

fn length(text: &str) -> Result<f64, String> {
    within(&LENGTH, text, &photo::LENGTHS, "from 1 mm to 3 m")
}

fn diameter(text: &str) -> Result<f64, String> {
    within(
        &LENGTH,
        text,
        &photo::DIAMETERS,
        "from 5 um to 0.5 mm; hair of the scalp has 40 to 120 um",
    )
}

fn ratio(text: &str) -> Result<f64, String> {
    within(&RATIO, text, &photo::AXIS_RATIOS, "from 1 to 20")
}

fn modulus(text: &str) -> Result<f64, String> {
    within(&PRESSURE, text, &photo::MODULI, "from 0.1 to 100 GPa; hair has 1 to 7 GPa")
}

fn within(
    dimension: &Dimension,
    text: &str,
    range: &RangeInclusive<f64>,
    allowed: &str,
) -> Result<f64, String> {
    let value = positive(dimension, text)?;
    if range.contains(&value) { Ok(value) } else { Err(format!("it must be {allowed}")) }
}
