//! Arguments of `frisure fit`.

use std::path::PathBuf;

use clap::Args;
use frisure::scene::quantity::LENGTH;

const EXAMPLES: &str = "\
Examples:
  frisure fit digitised.csv --noise '0.1 mm' -o fits.html -o fits.json
  frisure fit upright.usda upside-down.usda --gravity '0 0 -1' --gravity '0 0 1' --noise '0.1 mm'
  frisure fit digitised.csv --known stiffness-over-weight=9.4e-5+-5e-6 --known axis-ratio=1.4

A line is a fibre that is clamped at its first point, hangs, and touches nothing. Lines are those
of a table (.csv, .tsv, .txt: one row for each point, with the headings x (mm), y (mm), z (mm), and
if wanted fibre, pose, s (mm), gx, gy, gz, state) or of a groom. Of several grooms each is a pose
of the same fibres in the same order.

Numbers that can be known: stiffness-over-weight (EI/(rho S g), m^3), torsion-ratio (GJ/EI),
axis-ratio, curvature and torsion (1/m); after +- the standard deviation, 0 without it.
docs/fit.md describes the method, and what one pose cannot tell.";

/// Arguments of `frisure fit`.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(crate) struct FitFibres {
    /// Digitised lines: one table, or grooms.
    #[arg(value_name = "LINES", required = true)]
    pub(crate) lines: Vec<PathBuf>,

    /// Write a page with plots (.html) or all numbers (.json). May be repeated.
    #[arg(long = "output", short, value_name = "REPORT")]
    pub(crate) outputs: Vec<PathBuf>,

    /// Standard deviation of each coordinate of each point. [default: what the fit leaves over]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) noise: Option<f64>,

    /// Length of the fibres from the clamp to the tip. [default: the last arc length, or fitted]
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) length: Option<f64>,

    /// Direction of gravity in the axes of a groom, one for all or one for each; its size counts, and
    /// `0 0 0` is hair without weight. [default: 0 0 -1]
    #[arg(long, value_name = "X Y Z", value_parser = direction, allow_hyphen_values = true)]
    pub(crate) gravity: Vec<[f64; 3]>,

    /// What is known of all fibres: NAME=NUMBER, or NAME=NUMBER+-DEVIATION. May be repeated.
    #[arg(long, value_name = "NAME=NUMBER", value_parser = known)]
    pub(crate) known: Vec<(Quantity, f64, f64)>,

    /// Knots between which the natural strain is linear, for curls that vary along the fibre.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) knots: usize,
}

/// A number that can be known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Quantity {
    StiffnessOverWeight,
    TorsionRatio,
    AxisRatio,
    Curvature,
    Torsion,
}

impl Quantity {
    /// Its name on the command line.
    pub(crate) fn name(self) -> &'static str {
        QUANTITIES.iter().find(|(_, quantity)| *quantity == self).map_or("", |(name, _)| *name)
    }
}

const QUANTITIES: [(&str, Quantity); 5] = [
    ("stiffness-over-weight", Quantity::StiffnessOverWeight),
    ("torsion-ratio", Quantity::TorsionRatio),
    ("axis-ratio", Quantity::AxisRatio),
    ("curvature", Quantity::Curvature),
    ("torsion", Quantity::Torsion),
];

fn length(text: &str) -> Result<f64, String> {
    let value = LENGTH.parse(text);
    let value = value.map_err(|e| format!("{e}; it must be such as \"{}\"", LENGTH.example))?;
    if value > 0.0 { Ok(value) } else { Err("it must be more than 0".to_owned()) }
}

fn number(text: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
    number.ok_or_else(|| format!("`{}` is no finite number", text.trim()))
}

fn direction(text: &str) -> Result<[f64; 3], String> {
    let parts: Result<Vec<f64>, String> = text.split_whitespace().map(number).collect();
    let vector = <[f64; 3]>::try_from(parts?);
    vector.map_err(|parts| format!("{} numbers; write three, such as `0 0 -1`", parts.len()))
}

fn known(text: &str) -> Result<(Quantity, f64, f64), String> {
    let Some((name, value)) = text.split_once('=') else {
        return Err("write NAME=NUMBER, such as `axis-ratio=1.4`".to_owned());
    };
    let found = QUANTITIES.iter().find(|(known, _)| *known == name.trim());
    let Some(&(_, quantity)) = found else {
        let names: Vec<&str> = QUANTITIES.iter().map(|(name, _)| *name).collect();
        return Err(format!("`{}` is unknown; write one of {}", name.trim(), names.join(", ")));
    };
    let (value, deviation) = match value.split_once("+-").or(value.split_once('±')) {
        Some((value, deviation)) => (number(value)?, number(deviation)?),
        None => (number(value)?, 0.0),
    };
    Ok((quantity, value, deviation))
}
