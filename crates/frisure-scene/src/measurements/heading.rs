//! What the heading of a column says: a property of hair, its unit, and what was made of many.

use crate::quantity::{AREA, DENSITY, Dimension, LENGTH, PRESSURE, RATIO, STRAIN};

/// A property of hair that a table can tell. SI units.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Property {
    Curvature,
    ShortAxis,
    LongAxis,
    Area,
    Eccentricity,
    AxisRatio,
    Diameter,
    CurlRadius,
    Pitch,
    CurlIndex,
    Turns,
    Length,
    YoungsModulus,
    ShearModulus,
    Density,
}

/// How a number becomes the property.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Reading {
    Times(f64),
    /// The property is so many over the number.
    Over(f64),
}

/// A name that a property goes by.
#[derive(Debug)]
pub(super) struct Name {
    text: &'static str,
    pub(super) property: Property,
    pub(super) dimension: &'static Dimension,
    reading: Reading,
}

const fn name(text: &'static str, property: Property, dimension: &'static Dimension) -> Name {
    Name { text, property, dimension, reading: Reading::Times(1.0) }
}

const fn read(name: Name, reading: Reading) -> Name {
    Name { reading, ..name }
}

/// In plain words: lower case, one space, `fibre` for `fiber`.
const NAMES: &[Name] = &[
    name("curvature", Property::Curvature, &STRAIN),
    name("curv", Property::Curvature, &STRAIN),
    // Of the circle that hair laid flat follows (de la Mettrie et al. 2007).
    read(name("curve diameter", Property::Curvature, &LENGTH), Reading::Over(2.0)),
    read(name("curve radius", Property::Curvature, &LENGTH), Reading::Over(1.0)),
    read(name("radius of curvature", Property::Curvature, &LENGTH), Reading::Over(1.0)),
    name("min", Property::ShortAxis, &LENGTH),
    name("min diameter", Property::ShortAxis, &LENGTH),
    name("minor diameter", Property::ShortAxis, &LENGTH),
    name("minimum diameter", Property::ShortAxis, &LENGTH),
    name("minor axis", Property::ShortAxis, &LENGTH),
    name("short axis", Property::ShortAxis, &LENGTH),
    name("max", Property::LongAxis, &LENGTH),
    name("max diameter", Property::LongAxis, &LENGTH),
    name("major diameter", Property::LongAxis, &LENGTH),
    name("maximum diameter", Property::LongAxis, &LENGTH),
    name("major axis", Property::LongAxis, &LENGTH),
    name("long axis", Property::LongAxis, &LENGTH),
    name("area", Property::Area, &AREA),
    name("section area", Property::Area, &AREA),
    name("cross section area", Property::Area, &AREA),
    name("cross sectional area", Property::Area, &AREA),
    name("eccentricity", Property::Eccentricity, &RATIO),
    name("axis ratio", Property::AxisRatio, &RATIO),
    name("aspect ratio", Property::AxisRatio, &RATIO),
    name("diameter", Property::Diameter, &LENGTH),
    name("fibre diameter", Property::Diameter, &LENGTH),
    name("hair diameter", Property::Diameter, &LENGTH),
    read(name("fibre radius", Property::Diameter, &LENGTH), Reading::Times(2.0)),
    name("curl radius", Property::CurlRadius, &LENGTH),
    name("helix radius", Property::CurlRadius, &LENGTH),
    read(name("curl diameter", Property::CurlRadius, &LENGTH), Reading::Times(0.5)),
    read(name("helix diameter", Property::CurlRadius, &LENGTH), Reading::Times(0.5)),
    name("pitch", Property::Pitch, &LENGTH),
    name("curl pitch", Property::Pitch, &LENGTH),
    name("helix pitch", Property::Pitch, &LENGTH),
    name("curl index", Property::CurlIndex, &RATIO),
    name("turns", Property::Turns, &STRAIN),
    name("turns per length", Property::Turns, &STRAIN),
    name("hair length", Property::Length, &LENGTH),
    name("youngs modulus", Property::YoungsModulus, &PRESSURE),
    name("elastic modulus", Property::YoungsModulus, &PRESSURE),
    name("shear modulus", Property::ShearModulus, &PRESSURE),
    name("mass density", Property::Density, &DENSITY),
    name("density", Property::Density, &DENSITY),
];

/// What was made of many numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aggregate {
    Mean,
    Median,
    Deviation,
    /// A percentile or an extreme: read by nobody.
    Other,
}

/// What a column holds.
#[derive(Clone, Debug)]
pub(super) enum Meaning {
    /// A property, with the unit as written and what was made of many, the last thing last.
    Value { name: &'static Name, unit: Option<String>, aggregates: Vec<Aggregate> },
    /// How many a row stands for.
    Count,
    /// Which hair a row is of, where a hair has several.
    Hair,
    /// Nothing that is read here.
    Other,
}

impl Property {
    /// Smallest and largest value that is taken for a measurement of hair (SI).
    pub(super) fn range(self) -> (f64, f64) {
        match self {
            // A window gone wild has the radius of a pixel.
            Self::Curvature => (0.0, 2e5),
            Self::Turns => (0.0, 2e4),
            Self::ShortAxis | Self::LongAxis | Self::Diameter => (1e-6, 1e-3),
            Self::Area => (1e-12, 1e-6),
            Self::Eccentricity => (0.0, 0.9987),
            Self::AxisRatio => (1.0, 20.0),
            Self::CurlRadius => (5e-5, 1.0),
            Self::Pitch => (0.0, 10.0),
            Self::CurlIndex => (1.0, 100.0),
            Self::Length => (1e-3, 3.0),
            Self::YoungsModulus | Self::ShearModulus => (1e6, 1e11),
            Self::Density => (100.0, 5000.0),
        }
    }
}

impl Name {
    /// The property from a number in SI units.
    pub(super) fn property_of(&self, number: f64) -> f64 {
        match self.reading {
            Reading::Times(factor) => factor * number,
            Reading::Over(factor) => factor / number,
        }
    }

    /// The number (SI) that would be this property.
    pub(super) fn number_of(&self, property: f64) -> f64 {
        match self.reading {
            Reading::Times(factor) => property / factor,
            Reading::Over(factor) => factor / property,
        }
    }

    /// What a relative deviation needs: the factor alone, as `2/x` varies as much as `x` does.
    pub(super) fn keeps_scale(&self) -> bool {
        matches!(self.reading, Reading::Times(_))
    }

    /// A heading with a unit.
    pub(super) fn example(&self) -> String {
        let unit = self.dimension.example.split_once(' ').map(|(_, unit)| format!(" ({unit})"));
        let unit = match self.property {
            Property::ShortAxis | Property::LongAxis | Property::Diameter => {
                Some(" (um)".to_owned())
            }
            Property::Curvature | Property::Turns if self.dimension.si == "rad/m" => {
                Some(" (1/mm)".to_owned())
            }
            _ => unit,
        };
        format!("{}{}", self.text, unit.unwrap_or_default())
    }

    /// Whether this is the name.
    pub(super) fn is(&self, text: &str) -> bool {
        self.text == text
    }
}

impl Meaning {
    /// Understands a heading such as `max diameter (um)`, `curvature_per_mm_median` or `n`.
    pub(super) fn of(heading: &str) -> Self {
        let (text, bracketed) = brackets(heading);
        let words = words(text);
        let mut words: Vec<&str> = words.iter().map(String::as_str).collect();
        let mut aggregates = strip_aggregates(&mut words);
        let unit = bracketed.or_else(|| strip_unit(&mut words));
        // Before and after the unit: the one nearer to the name was made first.
        let mut earlier = strip_aggregates(&mut words);
        earlier.append(&mut aggregates);
        if let Some(first) = words.first().and_then(|w| aggregate(w)).filter(|_| words.len() > 1) {
            words.remove(0);
            earlier.push(first);
        }
        let text = words.join(" ");
        if unit.is_none() && earlier.is_empty() {
            match text.as_str() {
                "n" | "count" | "hair count" | "number of hairs" => return Self::Count,
                "hair" | "label" | "hair id" | "strand" | "fibre" | "fibre id" => {
                    return Self::Hair;
                }
                _ => {}
            }
        }
        match NAMES.iter().find(|n| n.text == text) {
            Some(name) => Self::Value { name, unit, aggregates: earlier },
            None => Self::Other,
        }
    }
}

/// The unit that a heading says, in brackets or at its end.
pub(crate) fn unit_of(heading: &str) -> Option<String> {
    let (text, bracketed) = brackets(heading);
    let words = words(text);
    let mut words: Vec<&str> = words.iter().map(String::as_str).collect();
    strip_aggregates(&mut words);
    bracketed.or_else(|| strip_unit(&mut words))
}

/// The heading without what it has in brackets at its end, and that.
pub(crate) fn brackets(heading: &str) -> (&str, Option<String>) {
    let heading = heading.trim();
    let open = match heading.chars().last() {
        Some(')') => heading.rfind('('),
        Some(']') => heading.rfind('['),
        _ => None,
    };
    match open {
        Some(at) => {
            let unit = heading[at + 1..heading.len() - 1].trim();
            (&heading[..at], Some(unit.to_owned()))
        }
        None => (heading, None),
    }
}

fn words(text: &str) -> Vec<String> {
    let plain: String = text
        .to_lowercase()
        .chars()
        .filter(|c| !matches!(c, '\'' | '’'))
        .map(|c| match c {
            'μ' | 'µ' => 'u',
            '²' => '2',
            c if c.is_alphanumeric() || c == '/' || c == '^' || c == '%' => c,
            _ => ' ',
        })
        .collect();
    plain.split_whitespace().map(|w| w.replace("fiber", "fibre")).collect()
}

fn aggregate(word: &str) -> Option<Aggregate> {
    let percentile = |w: &str| {
        let digits = w.strip_prefix(['p', 'q']);
        digits.is_some_and(|d| !d.is_empty() && d.bytes().all(|b| b.is_ascii_digit()))
    };
    match word {
        "mean" | "average" | "avg" => Some(Aggregate::Mean),
        "median" => Some(Aggregate::Median),
        "sd" | "std" | "stdev" | "deviation" => Some(Aggregate::Deviation),
        "se" | "sem" | "minimum" | "maximum" | "quartile" => Some(Aggregate::Other),
        word if percentile(word) => Some(Aggregate::Other),
        _ => None,
    }
}

/// Aggregates at the end, the last one last.
fn strip_aggregates(words: &mut Vec<&str>) -> Vec<Aggregate> {
    let mut found = Vec::new();
    while words.len() > 1 {
        let Some(aggregate) = aggregate(words[words.len() - 1]) else { break };
        words.pop();
        found.insert(0, aggregate);
    }
    found
}

/// A unit at the end in plain words: `um`, `um2`, `per mm`, `gpa`.
fn strip_unit(words: &mut Vec<&str>) -> Option<String> {
    let (&last, rest) = words.split_last()?;
    let unit = match (rest.last(), last) {
        (Some(&"per"), "m" | "cm" | "mm") => format!("1/{last}"),
        (Some(_), "um" | "nm" | "mm" | "cm" | "m" | "in") => last.to_owned(),
        (Some(_), "um2" | "mm2" | "um^2" | "mm^2") => format!("{}^2", &last[..2]),
        (Some(_), "gpa") => "GPa".to_owned(),
        (Some(_), "mpa") => "MPa".to_owned(),
        (Some(_), "percent" | "%") => "%".to_owned(),
        (Some(_), "1/mm" | "1/cm" | "1/m" | "g/cm3" | "kg/m3") => last.replace("m3", "m^3"),
        _ => return None,
    };
    words.truncate(words.len() - if unit.starts_with("1/") && last.len() < 3 { 2 } else { 1 });
    Some(unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(heading: &str) -> Option<(Property, Option<String>, Vec<Aggregate>)> {
        match Meaning::of(heading) {
            Meaning::Value { name, unit, aggregates } => Some((name.property, unit, aggregates)),
            _ => None,
        }
    }

    #[test]
    fn headings_as_people_write_them() {
        let cases: &[(&str, Property, Option<&str>, &[Aggregate])] = &[
            ("diameter (um)", Property::Diameter, Some("um"), &[]),
            ("Fiber Diameter [µm]", Property::Diameter, Some("µm"), &[]),
            ("max_diameter_um", Property::LongAxis, Some("um"), &[]),
            ("curvature_per_mm", Property::Curvature, Some("1/mm"), &[]),
            ("curvature_per_mm_median", Property::Curvature, Some("1/mm"), &[Aggregate::Median]),
            ("min_diameter_um_median", Property::ShortAxis, Some("um"), &[Aggregate::Median]),
            ("axis_ratio_p10", Property::AxisRatio, None, &[Aggregate::Other]),
            ("Mean axis ratio", Property::AxisRatio, None, &[Aggregate::Mean]),
            ("curv_median_mean", Property::Curvature, None, &[Aggregate::Median, Aggregate::Mean]),
            ("Young's modulus (GPa)", Property::YoungsModulus, Some("GPa"), &[]),
            ("turns per cm", Property::Turns, Some("1/cm"), &[]),
            ("cross-sectional area (µm²)", Property::Area, Some("µm²"), &[]),
            ("area_um2", Property::Area, Some("um^2"), &[]),
            ("min", Property::ShortAxis, None, &[]),
            ("diameter_sd_um", Property::Diameter, Some("um"), &[Aggregate::Deviation]),
        ];
        for (heading, property, unit, aggregates) in cases {
            let expected = (*property, unit.map(str::to_owned), aggregates.to_vec());
            assert_eq!(told(heading), Some(expected), "{heading}");
        }
    }

    #[test]
    fn what_says_nothing_of_hair() {
        for heading in ["", "ID", "colour", "()", "length_mean", "per mm", "_", "median", "(um)"] {
            assert_eq!(told(heading), None, "{heading}");
        }
        assert!(matches!(Meaning::of("hair_count"), Meaning::Count));
        assert!(matches!(Meaning::of("Label"), Meaning::Hair));
    }
}
