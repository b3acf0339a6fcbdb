//! Kinds of values: how each is read from TOML, written, and described in the JSON Schema.

use frisure_look::Face;
use glam::DVec3;
use schemars::{Schema, json_schema};
use toml::Value;

use crate::error::ValueError;
use crate::quantity::{self, Dimension, QuantityError};

/// A kind of value.
pub(crate) trait Kind {
    /// The value in SI units.
    type Value;

    /// Reads a TOML value; the error says what is allowed.
    fn read(value: &Value) -> Result<Self::Value, ValueError>;

    /// JSON Schema of the values.
    fn schema() -> Schema;
}

/// A kind of value that can be written.
pub(crate) trait ToText: Kind {
    /// Returns the value as a scene writes it: short, and exact to the last bit when it is read.
    fn text(value: &Self::Value) -> String;
}

/// Returns a list as a scene writes it.
pub(crate) fn list_text<T>(items: &[T], text: impl Fn(&T) -> String) -> String {
    format!("[{}]", items.iter().map(text).collect::<Vec<_>>().join(", "))
}

/// Returns a table as a scene writes it on one line.
pub(crate) fn table_text<'a>(entries: impl IntoIterator<Item = (&'a str, String)>) -> String {
    let entries: Vec<_> =
        entries.into_iter().map(|(key, value)| format!("{key} = {value}")).collect();
    if entries.is_empty() { "{}".into() } else { format!("{{ {} }}", entries.join(", ")) }
}

/// A bare number that reads as exactly this one; whole ones without a point.
fn number_text(x: f64) -> String {
    let whole = x.fract() == 0.0 && x.abs() < 1e15 && x.to_bits() != (-0.0_f64).to_bits();
    if whole { format!("{x:.0}") } else { format!("{x:?}") }
}

/// A number in SI units or a text with a unit.
pub(crate) fn read_quantity(
    value: &Value,
    dimension: &'static Dimension,
) -> Result<f64, ValueError> {
    let example = format!("{}, such as \"{}\"", dimension.name, dimension.example);
    let text = match value {
        #[expect(
            clippy::cast_precision_loss,
            reason = "as for any number with more than 15 digits"
        )]
        Value::Integer(i) => return Ok(*i as f64),
        Value::Float(x) if x.is_finite() => return Ok(*x),
        Value::Float(_) => return Err(ValueError::new("a finite number")),
        Value::String(text) => text,
        _ => return Err(ValueError::new(example)),
    };
    let units = dimension.units().collect::<Vec<_>>().join(", ");
    let units = format!("units of {}: {units}", dimension.name.trim_start_matches("a "));
    dimension.parse(text).map_err(|error| match error {
        QuantityError::NotFinite => ValueError::new("a finite number"),
        QuantityError::NoNumber => ValueError::new(example),
        QuantityError::NoUnit => ValueError::new(example)
            .hint(format!("add a unit; a number without quotes is in {}", dimension.si)),
        QuantityError::UnknownUnit { belongs_to: Some(other), unit, .. } => {
            ValueError::new(example).hint(format!("`{unit}` is a unit of {other}; {units}"))
        }
        QuantityError::UnknownUnit { .. } => ValueError::new(example).hint(units),
    })
}

fn quantity_schema(dimension: &'static Dimension) -> Schema {
    let unit = if dimension.si.is_empty() { "a pure number" } else { dimension.si };
    json_schema!({
        "type": ["number", "string"],
        "x-unit": unit,
        "examples": [dimension.example],
    })
}

macro_rules! quantities {
    ($($(#[$doc:meta])* $name:ident = $dimension:ident $units:expr;)*) => {$(
        $(#[$doc])*
        pub(crate) struct $name;

        impl Kind for $name {
            type Value = f64;

            fn read(value: &Value) -> Result<f64, ValueError> {
                read_quantity(value, &quantity::$dimension)
            }

            fn schema() -> Schema {
                quantity_schema(&quantity::$dimension)
            }
        }

        impl ToText for $name {
            fn text(value: &f64) -> String {
                let units: &[&str] = &$units;
                // Nothing is 0 in any unit.
                let text = if *value == 0.0 { None } else { quantity::$dimension.text(*value, units) };
                text.map_or_else(|| number_text(*value), |text| format!("\"{text}\""))
            }
        }
    )*};
}

quantities! {
    /// A length (m).
    Length = LENGTH ["cm", "mm", "m"];
    /// An angle (rad).
    Angle = ANGLE ["deg"];
    /// An elastic modulus (Pa).
    Modulus = PRESSURE [];
    /// A density (kg/m³).
    Density = DENSITY [];
    /// A curvature or twist (rad/m).
    Strain = STRAIN [];
    /// A number per area (1/m²).
    NumberDensity = NUMBER_DENSITY [];
    /// An acceleration (m/s²).
    Acceleration = ACCELERATION [];
    /// A pure number.
    Ratio = RATIO [];
    /// A speed (m/s).
    Speed = SPEED [];
    /// A speed of wind (m/s).
    Velocity = VELOCITY ["m/s"];
    /// A time (s).
    Time = TIME [];
}

/// Yes or no.
pub(crate) struct Flag;

impl Kind for Flag {
    type Value = bool;

    fn read(value: &Value) -> Result<bool, ValueError> {
        value.as_bool().ok_or_else(|| ValueError::new("true or false"))
    }

    fn schema() -> Schema {
        json_schema!({ "type": "boolean" })
    }
}

impl ToText for Flag {
    fn text(flag: &bool) -> String {
        flag.to_string()
    }
}

/// A whole number of at least 0.
pub(crate) struct Count;

impl Kind for Count {
    type Value = usize;

    fn read(value: &Value) -> Result<usize, ValueError> {
        value
            .as_integer()
            .and_then(|i| usize::try_from(i).ok())
            .ok_or_else(|| ValueError::new("a whole number, zero or more"))
    }

    fn schema() -> Schema {
        json_schema!({ "type": "integer", "minimum": 0 })
    }
}

impl ToText for Count {
    fn text(count: &usize) -> String {
        count.to_string()
    }
}

/// Any text.
pub(crate) struct Text;

impl Kind for Text {
    type Value = String;

    fn read(value: &Value) -> Result<String, ValueError> {
        value.as_str().map(str::to_owned).ok_or_else(|| ValueError::new("a text in quotes"))
    }

    fn schema() -> Schema {
        json_schema!({ "type": "string" })
    }
}

/// Three numbers.
pub(crate) struct Vector;

impl Kind for Vector {
    type Value = DVec3;

    fn read(value: &Value) -> Result<DVec3, ValueError> {
        let allowed = || ValueError::new("three finite numbers, such as [0, 0, 1]");
        let array = value.as_array().filter(|a| a.len() == 3).ok_or_else(allowed)?;
        let mut out = [0.0; 3];
        for (x, value) in out.iter_mut().zip(array) {
            *x = match value {
                Value::String(_) => return Err(allowed()),
                value => read_quantity(value, &quantity::RATIO).map_err(|_| allowed())?,
            };
        }
        Ok(out.into())
    }

    fn schema() -> Schema {
        json_schema!({
            "type": "array", "items": { "type": "number" }, "minItems": 3, "maxItems": 3,
            "examples": [[0, 0, 1]],
        })
    }
}

impl ToText for Vector {
    fn text(v: &DVec3) -> String {
        list_text(&v.to_array(), |x| number_text(*x))
    }
}

/// Gravity (m/s²): its acceleration, or the acceleration as a vector in the frame of the head.
pub(crate) struct Gravity;

impl Gravity {
    /// The acceleration as a vector, if it is written as one.
    pub(crate) fn vector(value: &Value) -> Option<Result<DVec3, ValueError>> {
        let read = |items: &Vec<Value>| {
            let allowed = || {
                let example =
                    "an acceleration, such as \"9.81 m/s^2\", or three, such as [0, 0, -9.81]";
                ValueError::new(example)
            };
            let [x, y, z] = items.as_slice() else { return Err(allowed()) };
            let read = |value| read_quantity(value, &quantity::ACCELERATION).map_err(|_| allowed());
            Ok(DVec3::new(read(x)?, read(y)?, read(z)?))
        };
        value.as_array().map(read)
    }
}

impl Kind for Gravity {
    type Value = f64;

    fn read(value: &Value) -> Result<f64, ValueError> {
        let Some(vector) = Self::vector(value) else { return Acceleration::read(value) };
        let vector = vector?;
        // The square of a large or small number would leave the range of numbers.
        let largest = vector.abs().max_element();
        Ok(if largest > 0.0 { largest * (vector / largest).length() } else { 0.0 })
    }

    fn schema() -> Schema {
        json_schema!({
            "type": ["number", "string", "array"], "items": { "type": ["number", "string"] }, "minItems": 3,
            "maxItems": 3, "x-unit": "m/s^2", "examples": ["9.81 m/s^2", [0, 0, -9.81]],
        })
    }
}

/// Three lengths (m).
pub(crate) struct Point;

impl Kind for Point {
    type Value = DVec3;

    fn read(value: &Value) -> Result<DVec3, ValueError> {
        let allowed = "three lengths, such as [\"5 cm\", 0, \"12 cm\"]";
        let array = value.as_array().filter(|a| a.len() == 3);
        let array = array.ok_or_else(|| ValueError::new(allowed))?;
        let mut out = [0.0; 3];
        for (i, (x, value)) in out.iter_mut().zip(array).enumerate() {
            *x = Length::read(value).map_err(|e| e.inside(&format!("[{i}]")))?;
        }
        Ok(out.into())
    }

    fn schema() -> Schema {
        json_schema!({
            "type": "array", "items": { "type": ["number", "string"] }, "minItems": 3,
            "maxItems": 3, "x-unit": "m", "examples": [["5 cm", 0, "12 cm"]],
        })
    }
}

impl ToText for Point {
    fn text(p: &DVec3) -> String {
        list_text(&p.to_array(), Length::text)
    }
}

/// Two lengths (m).
pub(crate) struct Pair;

impl Kind for Pair {
    type Value = [f64; 2];

    fn read(value: &Value) -> Result<[f64; 2], ValueError> {
        let allowed = || ValueError::new("two lengths, such as [\"2 cm\", \"5 cm\"]");
        match value.as_array().map(Vec::as_slice) {
            Some([across, back]) => Ok([Length::read(across)?, Length::read(back)?]),
            _ => Err(allowed()),
        }
    }

    fn schema() -> Schema {
        json_schema!({
            "type": "array", "items": { "type": ["number", "string"] }, "minItems": 2,
            "maxItems": 2, "examples": [["2 cm", "5 cm"]],
        })
    }
}

impl ToText for Pair {
    fn text(pair: &[f64; 2]) -> String {
        list_text(pair, Length::text)
    }
}

/// A diameter, or a width and a height (m).
pub(crate) struct FaceSize;

impl Kind for FaceSize {
    type Value = Face;

    fn read(value: &Value) -> Result<Face, ValueError> {
        match value {
            Value::Array(_) => Pair::read(value).map(Face::Rectangle),
            value => Length::read(value).map(Face::Disc),
        }
    }

    fn schema() -> Schema {
        json_schema!({ "anyOf": [Length::schema(), Pair::schema()] })
    }
}

/// A list of places on the skin, each across and back (m).
pub(crate) struct Points;

impl Kind for Points {
    type Value = Vec<[f64; 2]>;

    fn read(value: &Value) -> Result<Vec<[f64; 2]>, ValueError> {
        let allowed = "a list of places, such as [[\"2 cm\", \"0 cm\"], [\"3 cm\", \"8 cm\"]]";
        let places = value.as_array().ok_or_else(|| ValueError::new(allowed))?;
        places.iter().map(|place| Pair::read(place).map_err(|_| ValueError::new(allowed))).collect()
    }

    fn schema() -> Schema {
        json_schema!({
            "type": "array", "items": Pair::schema(), "minItems": 2, "maxItems": 100,
            "examples": [[["2 cm", "0 cm"], ["3 cm", "8 cm"]]],
        })
    }
}

impl ToText for Points {
    fn text(places: &Vec<[f64; 2]>) -> String {
        list_text(places, Pair::text)
    }
}

/// A colour as three sRGB values from 0 to 1.
pub(crate) struct Colour;

impl Kind for Colour {
    type Value = [f64; 3];

    fn read(value: &Value) -> Result<[f64; 3], ValueError> {
        let allowed =
            || ValueError::new("a colour such as \"#d8b49c\", or red, green and blue from 0 to 1");
        let rgb = match value {
            Value::String(text) => hexadecimal(text).ok_or_else(allowed)?,
            value => Vector::read(value).map_err(|_| allowed())?.to_array(),
        };
        if rgb.iter().all(|c| (0.0..=1.0).contains(c)) { Ok(rgb) } else { Err(allowed()) }
    }

    fn schema() -> Schema {
        json_schema!({
            "anyOf": [
                { "type": "string", "pattern": "^#[0-9a-fA-F]{6}$" },
                {
                    "type": "array", "minItems": 3, "maxItems": 3,
                    "items": { "type": "number", "minimum": 0, "maximum": 1 },
                },
            ],
            "examples": ["#d8b49c"],
        })
    }
}

fn hexadecimal(text: &str) -> Option<[f64; 3]> {
    let digits = text.strip_prefix('#').filter(|d| d.len() == 6 && d.is_ascii())?;
    let mut rgb = [0.0; 3];
    for (i, c) in rgb.iter_mut().enumerate() {
        // `from_str_radix` would take a sign.
        let pair = &digits[2 * i..2 * i + 2];
        if !pair.bytes().all(|b| b.is_ascii_hexdigit()) {
            return None;
        }
        *c = f64::from(u8::from_str_radix(pair, 16).ok()?) / 255.0;
    }
    Some(rgb)
}
