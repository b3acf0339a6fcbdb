//! An estimate as a scene that says where each number is from.

use std::fmt::Write;

use super::error::per_millimetre;
use super::estimate::Estimate;
use super::sample::Sample;
use crate::quantity::{DENSITY, Dimension, LENGTH, PRESSURE, RATIO};

/// Widest comment line.
const WIDTH: usize = 96;

/// Largest spreads that a scene takes.
const MOST_OF_DIAMETER: f64 = 0.5;
const MOST: f64 = 1.0;

impl Estimate {
    /// A scene with what was measured, each number with its source, and at its head what was not.
    #[must_use]
    pub fn scene(&self) -> String {
        let mut out = String::new();
        let sources: Vec<String> = self.sources.iter().map(|name| printable(name)).collect();
        comment(&mut out, &format!("Hair as measured: {}.", sources.join(", ")), "");
        out.push_str("#\n");
        for note in &self.notes {
            comment(&mut out, &printable(note), "- ");
        }
        // Writing to a String cannot fail.
        let _ =
            write!(out, "\nname = \"Measured hair\"\n\n[hair]\ntype = \"{}\"", self.hair_type.name);
        let _ = writeln!(out, "  # what was not measured is this type's");
        if let Some(length) = &self.length {
            key(&mut out, "length", length.mean, &LENGTH, &of(length, "hairs"));
        }
        self.fibre(&mut out);
        self.curl(&mut out);
        out
    }

    fn fibre(&self, out: &mut String) {
        let all = [&self.diameter, &self.axis_ratio, &self.youngs_modulus, &self.shear_modulus];
        if all.into_iter().chain([&self.density]).all(Option::is_none) {
            return;
        }
        out.push_str("\n[hair.fibre]\n");
        if let Some(d) = &self.diameter {
            key(out, "diameter", d.mean, &LENGTH, &of_sample(d, "sections", |x| LENGTH.written(x)));
            spread(out, "variation", d.variation(), MOST_OF_DIAMETER, "of the mean");
        }
        if let Some(ratio) = &self.axis_ratio {
            key(
                out,
                "axis_ratio",
                ratio.mean,
                &RATIO,
                &of_sample(ratio, "sections", |x| RATIO.written(x)),
            );
            // The scene's spread is of what the ratio exceeds 1 by: a circle stays one.
            let excess = ratio.deviation.map(|d| d / (ratio.mean - 1.0)).filter(|v| v.is_finite());
            spread(out, "axis_ratio_variation", excess, MOST, "of what it exceeds 1 by");
        }
        for (name, sample, dimension) in [
            ("youngs_modulus", &self.youngs_modulus, &PRESSURE),
            ("shear_modulus", &self.shear_modulus, &PRESSURE),
            ("density", &self.density, &DENSITY),
        ] {
            if let Some(sample) = sample {
                key(
                    out,
                    name,
                    sample.mean,
                    dimension,
                    &of_sample(sample, "hairs", |x| dimension.written(x)),
                );
            }
        }
    }

    fn curl(&self, out: &mut String) {
        let Some((radius, pitch)) = self.helix else { return };
        out.push_str("\n[hair.curl]\n");
        let from = self.curvature.as_ref().map_or(String::new(), |c| {
            let source = of_sample(c, "hairs", per_millimetre);
            format!("curvature {}, {source}", per_millimetre(c.mean))
        });
        key(out, "radius", radius, &LENGTH, &from);
        key(out, "pitch", pitch, &LENGTH, "per turn");
        let between = self.curvature.as_ref().and_then(Sample::variation);
        spread(out, "variation_between", between, MOST, "between hairs");
        if let Some((along, hairs)) = self.variation_along {
            let what = format!("along a hair, the median of {hairs}");
            spread(out, "variation_along", Some(along), MOST, &what);
        }
    }
}

fn key(out: &mut String, name: &str, value: f64, dimension: &Dimension, source: &str) {
    let value = match dimension.si {
        "" => dimension.written(value),
        _ => format!("\"{}\"", dimension.written(value)),
    };
    line(out, name, &value, source);
}

/// A spread, at most what a scene takes.
fn spread(out: &mut String, name: &str, value: Option<f64>, most: f64, what: &str) {
    if let Some(value) = value {
        let cut =
            if value > most { format!(", {value:.2} as measured: cut") } else { String::new() };
        let text = format!("{:.3}", value.min(most));
        line(out, name, &text, &format!("standard deviation, {what}{cut}"));
    }
}

fn line(out: &mut String, name: &str, value: &str, source: &str) {
    let key = format!("{name} = {value}");
    let _ = match source {
        "" => writeln!(out, "{key}"),
        _ => writeln!(out, "{key:<32}  # {source}"),
    };
}

/// What a number is the mean of.
fn of(sample: &Sample, what: &str) -> String {
    match (sample.groups, sample.count) {
        (0, 1) => format!("one of the {what}"),
        (0, count) => format!("mean of {count} {what}"),
        (1, count) => format!("told of {count} {what} together"),
        (groups, count) => format!("mean of {groups} groups, {count} {what} in all"),
    }
}

/// The same, with the median of many.
fn of_sample(sample: &Sample, what: &str, written: impl Fn(f64) -> String) -> String {
    match (sample.groups, sample.count) {
        (0, 3..) => format!("{}; median {}", of(sample, what), written(sample.median)),
        _ => of(sample, what),
    }
}

/// A comment in lines of at most [`WIDTH`].
fn comment(out: &mut String, text: &str, bullet: &str) {
    let indent = " ".repeat(bullet.len());
    let mut line = format!("# {bullet}");
    let empty = line.len();
    for word in text.split_whitespace() {
        if line.len() > empty && line.len() + word.len() > WIDTH {
            let _ = writeln!(out, "{}", line.trim_end());
            line = format!("# {indent}");
        }
        line.push_str(word);
        line.push(' ');
    }
    let _ = writeln!(out, "{}", line.trim_end());
}

/// Without what would end a comment.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { '?' } else { c }).collect()
}
