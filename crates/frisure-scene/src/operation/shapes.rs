//! Lines, places and directions that a step can name.

use frisure_hairstyle::styling::{Direction, Height, Held};
use frisure_hairstyle::{Comb, Level};
use glam::DVec3;
use schemars::{Schema, json_schema};
use toml::{Table, Value};

use crate::choice::{Choice, OneOf};
use crate::error::ValueError;
use crate::keywords::{Keyword, keywords};
use crate::kind::{Kind, Length, Point, Ratio, Time, ToText, Vector, table_text};

/// The keys of a table that is a value.
pub(super) struct Fields<'a>(&'a Table);

impl<'a> Fields<'a> {
    /// The table, if it has none but the known keys.
    pub(super) fn new(
        value: &'a Value,
        known: &[&str],
        allowed: &'static str,
    ) -> Result<Self, ValueError> {
        let table = value.as_table().ok_or_else(|| ValueError::new(allowed))?;
        match table.keys().find(|key| !known.contains(&key.as_str())) {
            Some(key) => Err(ValueError::unknown_key(key, known)),
            None => Ok(Self(table)),
        }
    }

    /// The value of a key, if it is written.
    pub(super) fn get<K: Kind>(&self, key: &str) -> Result<Option<K::Value>, ValueError> {
        let read = |value| K::read(value).map_err(|e| e.inside(&format!(".{key}")));
        self.0.get(key).map(read).transpose()
    }

    /// The value of a key that has to be written.
    pub(super) fn need<K: Kind>(&self, key: &str) -> Result<K::Value, ValueError> {
        let missing = || ValueError::because(format!("`{key}` is missing here"));
        self.get::<K>(key)?.ok_or_else(missing)
    }
}

/// A plane: a point of it (m) and its normal.
pub(super) struct Plane;

impl Kind for Plane {
    type Value = (DVec3, DVec3);

    fn read(value: &Value) -> Result<(DVec3, DVec3), ValueError> {
        let allowed = "a plane, such as { point = [0, 0, \"5 cm\"], normal = [0, 0, -1] }";
        let fields = Fields::new(value, &["point", "normal"], allowed)?;
        Ok((fields.need::<Point>("point")?, fields.need::<Vector>("normal")?))
    }

    fn schema() -> Schema {
        json_schema!({
            "type": "object", "additionalProperties": false,
            "properties": {
                "point": described(&Point::schema(), "A point of it, within 100 m of the origin."),
                "normal": described(
                    &Vector::schema(),
                    "Towards the side that is meant; any length but zero.",
                ),
            },
            "required": ["point", "normal"],
        })
    }
}

impl ToText for Plane {
    fn text((point, normal): &(DVec3, DVec3)) -> String {
        table_text([("point", Point::text(point)), ("normal", Vector::text(normal))])
    }
}

/// A sphere: its centre and radius (m).
pub(super) struct Sphere;

impl Kind for Sphere {
    type Value = (DVec3, f64);

    fn read(value: &Value) -> Result<(DVec3, f64), ValueError> {
        let allowed = "a sphere, such as { centre = [0, 0, \"5 cm\"], radius = \"20 cm\" }";
        let fields = Fields::new(value, &["centre", "radius"], allowed)?;
        Ok((fields.need::<Point>("centre")?, fields.need::<Length>("radius")?))
    }

    fn schema() -> Schema {
        json_schema!({
            "type": "object", "additionalProperties": false,
            "properties": {
                "centre": described(&Point::schema(), "Within 100 m of the origin."),
                "radius": described(&Length::schema(), "1 mm to 100 m."),
            },
            "required": ["centre", "radius"],
        })
    }
}

impl ToText for Sphere {
    fn text((centre, radius): &(DVec3, f64)) -> String {
        table_text([("centre", Point::text(centre)), ("radius", Length::text(radius))])
    }
}

/// A schema with a description.
pub(super) fn described(schema: &Schema, description: &str) -> Schema {
    let mut schema = schema.clone();
    schema.insert("description".into(), description.into());
    schema
}

/// The same, of a number within bounds (SI).
pub(super) fn bounded(schema: &Schema, least: f64, most: f64, description: &str) -> Schema {
    let mut schema = described(schema, description);
    schema.insert("minimum".into(), least.into());
    schema.insert("maximum".into(), most.into());
    schema
}

keywords! {
    Keyword<Held> {
        "down" => Self(Held::Down), "combed straight down from its root, as in the paper";
        "hanging" => Self(Held::Hanging), "as it hangs";
    }
}

/// Whether a value is a text that begins as a word does, not as a number.
fn is_word(value: &Value) -> bool {
    value.as_str().is_some_and(|text| text.trim_start().starts_with(char::is_alphabetic))
}

/// A height: a level of the head, or a length.
pub(super) struct Below;

impl Kind for Below {
    type Value = Height;

    fn read(value: &Value) -> Result<Height, ValueError> {
        if is_word(value) {
            let height = |error: ValueError| error.or("or a height such as \"4 cm\"");
            let Keyword(level) = OneOf::<Keyword<Level>>::read(value).map_err(height)?;
            return Ok(Height::Above(level, 0.0));
        }
        Length::read(value).map(Height::At)
    }

    fn schema() -> Schema {
        json_schema!({ "anyOf": [OneOf::<Keyword<Level>>::schema(), Length::schema()] })
    }
}

impl ToText for Below {
    fn text(height: &Height) -> String {
        match height {
            Height::At(z) => Length::text(z),
            Height::Above(level, _) => OneOf::<Keyword<Level>>::text(&Keyword(*level)),
        }
    }
}

/// A number of months, which are the unit of the key itself.
pub(super) struct Months;

impl Kind for Months {
    type Value = f64;

    fn read(value: &Value) -> Result<f64, ValueError> {
        Ratio::read(value).map_err(|error| match value.as_str() {
            Some(text) if Time::read(value).is_ok() => {
                error.hint(format!("with a unit it is `time = \"{text}\"`"))
            }
            _ => error,
        })
    }

    fn schema() -> Schema {
        Ratio::schema()
    }
}

impl ToText for Months {
    fn text(months: &f64) -> String {
        Ratio::text(months)
    }
}

/// Where hair is combed to: a word, or a direction.
pub(super) struct Towards;

impl Kind for Towards {
    type Value = Direction;

    fn read(value: &Value) -> Result<Direction, ValueError> {
        if value.is_str() {
            return OneOf::<Keyword<Comb>>::read(value).map(|Keyword(word)| Direction::Named(word));
        }
        let hint = "or a word: \"forward\", \"back\", \"down\", \"left\", \"right\"";
        Vector::read(value).map(Direction::Along).map_err(|e| e.hint(hint))
    }

    fn schema() -> Schema {
        json_schema!({ "anyOf": [OneOf::<Keyword<Comb>>::schema(), Vector::schema()] })
    }
}

impl ToText for Towards {
    fn text(towards: &Direction) -> String {
        match towards {
            Direction::Named(comb) => OneOf::<Keyword<Comb>>::text(&Keyword(*comb)),
            Direction::Along(direction) => Vector::text(direction),
        }
    }
}
