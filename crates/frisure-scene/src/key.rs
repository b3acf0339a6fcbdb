//! One key of a scene: a value as written, and what kind of value it has to be.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

use frisure_hairstyle::InvalidSpec;
use frisure_look::{Backdrop, Face, linear_from_srgb};
use glam::DVec3;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer};
use serde_spanned::Spanned;
use toml::Value;

use super::error::{Fault, SceneError};
use super::source::Source;
use crate::quantity::{self, Dimension, QuantityError};

/// A value that may be written in a scene, with its place there; nothing is checked yet.
pub(super) struct Key<K> {
    written: Option<Spanned<Value>>,
    kind: PhantomData<K>,
}

/// What kind of value a key has.
pub(super) trait Kind {
    /// The value when it is understood, SI units.
    type Value;

    /// Understands a TOML value, or says what is allowed.
    fn read(value: &Value) -> Result<Self::Value, Refusal>;

    /// JSON Schema of the values.
    fn schema() -> Schema;
}

/// A kind of value that is written as a person would, as far as that is exact.
pub(super) trait ToText: Kind {
    /// The value as a scene writes it; it reads as the same to the last bit.
    fn text(value: &Self::Value) -> String;
}

/// A list as a scene writes it.
pub(super) fn list_text<T>(items: &[T], text: impl Fn(&T) -> String) -> String {
    format!("[{}]", items.iter().map(text).collect::<Vec<_>>().join(", "))
}

/// A bare number that reads as exactly this one; whole ones without a point.
fn number_text(x: f64) -> String {
    let whole = x.fract() == 0.0 && x.abs() < 1e15 && x.to_bits() != (-0.0_f64).to_bits();
    if whole { format!("{x:.0}") } else { format!("{x:?}") }
}

/// A value that is not of its kind.
#[derive(Default)]
pub(super) struct Refusal {
    /// What would be allowed, in words.
    allowed: String,
    /// What to try; may be empty.
    hint: String,
    /// What is wrong, where it is not that the value is outside what is allowed.
    problem: String,
    /// What stands there in other words, where the text itself would be long.
    value: Option<Box<str>>,
    /// Path inside the value, such as `.plane.normal` or `[1]`, to what is wrong.
    inside: Box<str>,
    /// Whether it is the key that is wrong, not its value.
    in_key: bool,
}

impl Refusal {
    pub(super) fn new(allowed: impl Into<String>) -> Self {
        Self { allowed: allowed.into(), ..Self::default() }
    }

    /// What is wrong, in words.
    pub(super) fn because(problem: impl Into<String>) -> Self {
        Self { problem: problem.into(), ..Self::default() }
    }

    /// A key of a table that has none of that name.
    pub(super) fn unknown_key(name: &str, known: &[&str]) -> Self {
        let hint = match nearest(name, known.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("known keys: {}", known.join(", ")),
        };
        let refusal = Self::because(format!("unknown key `{name}`")).hint(hint);
        Self { in_key: true, ..refusal }.inside(&format!(".{name}"))
    }

    /// A number that a hairstyle refuses, in a part of the value.
    pub(super) fn out_of_range(error: &InvalidSpec, inside: &str) -> Self {
        let refusal = Self::new(error.allowed).inside(inside);
        Self { value: Some(error.value.as_str().into()), ..refusal }
    }

    pub(super) fn hint(self, hint: impl Into<String>) -> Self {
        Self { hint: hint.into(), ..self }
    }

    pub(super) fn has_hint(&self) -> bool {
        !self.hint.is_empty()
    }

    /// The same, where something else is allowed too.
    pub(super) fn or(self, also: &str) -> Self {
        Self { allowed: format!("{}, {also}", self.allowed), ..self }
    }

    /// The same, of a part of the value that is read.
    pub(super) fn inside(self, part: &str) -> Self {
        Self { inside: format!("{part}{}", self.inside).into(), ..self }
    }

    /// The refusal of a value that stands at a place of a scene.
    pub(super) fn at(self, span: Range<usize>, source: &Source) -> SceneError {
        self.at_path(&source.path_at(&span), source)
    }

    /// The refusal of the value at a path such as `step[1].cut.below`.
    pub(super) fn at_path(self, path: &str, source: &Source) -> SceneError {
        let Self { allowed, hint, problem, value, inside, in_key } = self;
        let key = format!("{path}{inside}");
        let span = if in_key { source.locate_key(&key) } else { source.locate(&key) };
        let value = value.map_or_else(|| source.slice(span.clone()).to_owned(), String::from);
        let fault = Fault { problem, ..Fault::outside(allowed) };
        fault.hint(hint).key(key).value(value).at(source, span)
    }
}

impl<K> Default for Key<K> {
    fn default() -> Self {
        Self { written: None, kind: PhantomData }
    }
}

impl<K> fmt::Debug for Key<K> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.written.fmt(f)
    }
}

impl<'de, K> Deserialize<'de> for Key<K> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let written = Some(Spanned::deserialize(deserializer)?);
        Ok(Self { written, kind: PhantomData })
    }
}

impl<K: Kind> JsonSchema for Key<K> {
    fn schema_name() -> Cow<'static, str> {
        "Key".into()
    }

    fn inline_schema() -> bool {
        true
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        K::schema()
    }
}

impl<K> Key<K> {
    /// Whether the key is written at all.
    pub(super) fn is_given(&self) -> bool {
        self.written.is_some()
    }

    /// Bytes of the value, if it is written.
    pub(super) fn span(&self) -> Option<Range<usize>> {
        self.written.as_ref().map(Spanned::span)
    }
}

impl<K: Kind> Key<K> {
    /// The value, if the key is written.
    ///
    /// # Errors
    /// With the key's place, if the value is not of its kind.
    pub(super) fn get(&self, source: &Source) -> Result<Option<K::Value>, SceneError> {
        let Some(written) = &self.written else { return Ok(None) };
        let refuse = |refusal: Refusal| refusal.at(written.span(), source);
        K::read(written.get_ref()).map(Some).map_err(refuse)
    }

    /// The value, or `default` if the key is not written.
    pub(super) fn or(&self, default: K::Value, source: &Source) -> Result<K::Value, SceneError> {
        Ok(self.get(source)?.unwrap_or(default))
    }
}

/// The nearest of some words to one that is none of them, if one is near.
pub(super) fn nearest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    near(word, known).map(|(_, known)| known)
}

/// The same, with the number of letters that are wrong.
pub(super) fn near<'a>(
    word: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<(usize, &'a str)> {
    known
        .into_iter()
        .map(|k| (strsim::damerau_levenshtein(word, k), k))
        .min_by_key(|&(distance, _)| distance)
        // Half the letters wrong is another word.
        .filter(|&(distance, k)| distance <= 1 + k.chars().count() / 3)
}

/// The word of a choice that a person may have meant by another.
fn meant<C: Choice>(word: &str) -> Option<&'static str> {
    let word = word.to_lowercase();
    let known = || C::words().into_iter().map(|w| w.0);
    let synonym = C::synonyms().iter().find(|(other, _)| *other == word).map(|s| s.1);
    let near = near(&word, known());
    synonym.or_else(|| match near {
        // Two words together are near to many, but are both of them.
        Some((2.., _)) if two_words::<C>(&word).is_some() => None,
        near => near.map(|(_, known)| known),
    })
}

/// Two words of a choice that are written as one, such as `left-back`.
pub(super) fn two_words<C: Choice>(word: &str) -> Option<[&'static str; 2]> {
    let (one, other) = word.split_once(['-', '_', ' '])?;
    let known = |word: &str| {
        let synonym = C::synonyms().iter().find(|(other, _)| *other == word).map(|s| s.1);
        C::words().into_iter().map(|w| w.0).find(|known| *known == word).or(synonym)
    };
    Some([known(one)?, known(other)?])
}

/// A number in SI units or a text with a unit.
pub(super) fn read_quantity(value: &Value, dimension: &'static Dimension) -> Result<f64, Refusal> {
    let example = format!("{}, such as \"{}\"", dimension.name, dimension.example);
    let text = match value {
        #[expect(
            clippy::cast_precision_loss,
            reason = "as for any number with more than 15 digits"
        )]
        Value::Integer(i) => return Ok(*i as f64),
        Value::Float(x) if x.is_finite() => return Ok(*x),
        Value::Float(_) => return Err(Refusal::new("a finite number")),
        Value::String(text) => text,
        _ => return Err(Refusal::new(example)),
    };
    let units = dimension.units().collect::<Vec<_>>().join(", ");
    let units = format!("units of {}: {units}", dimension.name.trim_start_matches("a "));
    dimension.parse(text).map_err(|error| match error {
        QuantityError::NotFinite => Refusal::new("a finite number"),
        QuantityError::NoNumber => Refusal::new(example),
        QuantityError::NoUnit => Refusal::new(example)
            .hint(format!("add a unit; a number without quotes is in {}", dimension.si)),
        QuantityError::UnknownUnit { belongs_to: Some(other), unit, .. } => {
            Refusal::new(example).hint(format!("`{unit}` is a unit of {other}; {units}"))
        }
        QuantityError::UnknownUnit { .. } => Refusal::new(example).hint(units),
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
        pub(super) struct $name;

        impl Kind for $name {
            type Value = f64;

            fn read(value: &Value) -> Result<f64, Refusal> {
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
    /// A time (s).
    Time = TIME [];
}

/// Yes or no.
pub(super) struct Flag;

impl Kind for Flag {
    type Value = bool;

    fn read(value: &Value) -> Result<bool, Refusal> {
        value.as_bool().ok_or_else(|| Refusal::new("true or false"))
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
pub(super) struct Count;

impl Kind for Count {
    type Value = usize;

    fn read(value: &Value) -> Result<usize, Refusal> {
        value
            .as_integer()
            .and_then(|i| usize::try_from(i).ok())
            .ok_or_else(|| Refusal::new("a whole number, zero or more"))
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
pub(super) struct Text;

impl Kind for Text {
    type Value = String;

    fn read(value: &Value) -> Result<String, Refusal> {
        value.as_str().map(str::to_owned).ok_or_else(|| Refusal::new("a text in quotes"))
    }

    fn schema() -> Schema {
        json_schema!({ "type": "string" })
    }
}

/// Three numbers.
pub(super) struct Vector;

impl Kind for Vector {
    type Value = DVec3;

    fn read(value: &Value) -> Result<DVec3, Refusal> {
        let allowed = || Refusal::new("three finite numbers, such as [0, 0, 1]");
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

/// Three lengths (m).
pub(super) struct Point;

impl Kind for Point {
    type Value = DVec3;

    fn read(value: &Value) -> Result<DVec3, Refusal> {
        let allowed = "three lengths, such as [\"5 cm\", 0, \"12 cm\"]";
        let array = value.as_array().filter(|a| a.len() == 3);
        let array = array.ok_or_else(|| Refusal::new(allowed))?;
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
pub(super) struct Pair;

impl Kind for Pair {
    type Value = [f64; 2];

    fn read(value: &Value) -> Result<[f64; 2], Refusal> {
        let allowed = || Refusal::new("two lengths, such as [\"2 cm\", \"5 cm\"]");
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
pub(super) struct FaceSize;

impl Kind for FaceSize {
    type Value = Face;

    fn read(value: &Value) -> Result<Face, Refusal> {
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
pub(super) struct Points;

impl Kind for Points {
    type Value = Vec<[f64; 2]>;

    fn read(value: &Value) -> Result<Vec<[f64; 2]>, Refusal> {
        let allowed = "a list of places, such as [[\"2 cm\", \"0 cm\"], [\"3 cm\", \"8 cm\"]]";
        let places = value.as_array().ok_or_else(|| Refusal::new(allowed))?;
        places.iter().map(|place| Pair::read(place).map_err(|_| Refusal::new(allowed))).collect()
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
pub(super) struct Colour;

impl Kind for Colour {
    type Value = [f64; 3];

    fn read(value: &Value) -> Result<[f64; 3], Refusal> {
        let allowed =
            || Refusal::new("a colour such as \"#d8b49c\", or red, green and blue from 0 to 1");
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

/// What is behind the head: a word, or a colour.
pub(super) struct BackdropKind;

impl BackdropKind {
    const WORDS: [(&str, &str, Backdrop); 3] = [
        ("wall", "a grey wall that the lights fall on", Backdrop::Wall),
        ("transparent", "nothing: the picture can be laid over another", Backdrop::Transparent),
        (
            "surroundings",
            "the room, the sky or the environment that light it",
            Backdrop::Environment,
        ),
    ];
}

impl Kind for BackdropKind {
    type Value = Backdrop;

    fn read(value: &Value) -> Result<Backdrop, Refusal> {
        let word = Self::WORDS.iter().find(|word| value.as_str() == Some(word.0));
        match word {
            Some(word) => Ok(word.2),
            None => {
                Colour::read(value).map(|c| Backdrop::Colour(linear_from_srgb(c))).map_err(|_| {
                    let words = Self::WORDS.map(|word| format!("\"{}\"", word.0)).join(", ");
                    let refusal = Refusal::new(format!("{words}, or a colour such as \"#d8b49c\""));
                    let near =
                        value.as_str().and_then(|s| nearest(s, Self::WORDS.map(|word| word.0)));
                    refusal.hint(
                        near.map_or(String::new(), |near| format!("did you mean \"{near}\"?")),
                    )
                })
            }
        }
    }

    fn schema() -> Schema {
        let words =
            Self::WORDS.map(|(word, what, _)| json_schema!({ "const": word, "description": what }));
        let words = words.map(Schema::to_value);
        json_schema!({ "anyOf": [{ "oneOf": words }, Colour::schema()] })
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

/// One word out of a few.
pub(super) trait Choice: Sized + Copy + 'static {
    /// Each word, what it means and what it stands for.
    fn words() -> Vec<(&'static str, &'static str, Self)>;

    /// Words of other people, each with the one that is meant by it.
    fn synonyms() -> &'static [(&'static str, &'static str)] {
        &[]
    }
}

/// A key that takes one word out of a few.
pub(super) struct OneOf<C>(PhantomData<C>);

impl<C: Choice> Kind for OneOf<C> {
    type Value = C;

    fn read(value: &Value) -> Result<C, Refusal> {
        let words = C::words();
        let list = words.iter().map(|w| format!("\"{}\"", w.0)).collect::<Vec<_>>().join(", ");
        let outside = || Refusal::new(format!("one of {list}"));
        let word = value.as_str().ok_or_else(outside)?;
        words.iter().find(|w| w.0 == word).map(|w| w.2).ok_or_else(|| match meant::<C>(word) {
            Some(near) => outside().hint(format!("did you mean \"{near}\"?")),
            None => outside(),
        })
    }

    fn schema() -> Schema {
        let one_of: Vec<_> = C::words()
            .iter()
            .map(|(word, meaning, _)| json_schema!({ "const": word, "description": meaning }))
            .collect();
        json_schema!({ "oneOf": one_of })
    }
}

impl<C: Choice + PartialEq> ToText for OneOf<C> {
    fn text(value: &C) -> String {
        let word = C::words().into_iter().find(|(_, _, known)| known == value);
        format!("\"{}\"", word.map_or("", |word| word.0))
    }
}
