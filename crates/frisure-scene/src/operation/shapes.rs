//! Lines, places and directions that a step can name.

use frisure_hairstyle::styling::{Direction, Height, Held, Sides, TiePlace};
use frisure_hairstyle::{Comb, Level, Product};
use glam::DVec3;
use schemars::{Schema, json_schema};
use toml::Value;

use super::tables::tables;
use crate::choice::{Choice, OneOf};
use crate::error::ValueError;
use crate::keywords::{Keyword, keywords};
use crate::kind::{Kind, Length, Point, Ratio, Time, ToText, Vector};

tables! {
    /// A plane: a point of it (m) and its normal.
    Plane: (DVec3, DVec3) as [(point, normal)],
    "a plane, such as { point = [0, 0, \"5 cm\"], normal = [0, 0, -1] }" {
        point: Point, "A point of it, within 100 m of the origin.";
        normal: Vector, "Towards the side that is meant; any length but zero.";
    }

    /// A sphere: its centre and radius (m).
    Sphere: (DVec3, f64) as [(centre, radius)],
    "a sphere, such as { centre = [0, 0, \"5 cm\"], radius = \"20 cm\" }" {
        centre: Point, "Within 100 m of the origin.";
        radius: Length, "1 mm to 100 m.";
    }
}

keywords! {
    Keyword<Held> {
        "down" => Self(Held::Down), "combed straight down from its root, as in the paper";
        "hanging" => Self(Held::Hanging), "as it hangs";
    }
}

keywords! {
    Keyword<Product> {
        "gel" => Self(Product::Gel), "a yield stress of 60 Pa, and a film that keeps three quarters of what drying would lose of a held shape";
        "mousse" => Self(Product::Mousse), "15 Pa, and two fifths";
        "oil" => Self(Product::Oil), "2 Pa, and less friction; it does not wash out";
    }
}

keywords! {
    Keyword<Sides> {
        "both" => Self(Sides::Both), "behind both ears";
        "left" => Self(Sides::Left), "behind the left ear";
        "right" => Self(Sides::Right), "behind the right ear";
    }
}

keywords! {
    Keyword<TiePlace> {
        "high" => Self(TiePlace::High), "at the back below the crown";
        "middle" => Self(TiePlace::Middle), "in the middle of the back of the head";
        "low" => Self(TiePlace::Low), "above the nape";
        "left" => Self(TiePlace::Left), "behind the left ear";
        "right" => Self(TiePlace::Right), "behind the right ear";
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

/// Where a hair tie is: a word, or a point.
pub(super) struct Tied;

impl Kind for Tied {
    type Value = TiePlace;

    fn read(value: &Value) -> Result<TiePlace, ValueError> {
        if value.is_str() {
            return OneOf::<Keyword<TiePlace>>::read(value).map(|Keyword(place)| place);
        }
        let hint = "or a word: \"high\", \"middle\", \"low\", \"left\", \"right\"";
        Point::read(value).map(TiePlace::At).map_err(|error| error.hint(hint))
    }

    fn schema() -> Schema {
        json_schema!({ "anyOf": [OneOf::<Keyword<TiePlace>>::schema(), Point::schema()] })
    }
}

impl ToText for Tied {
    fn text(place: &TiePlace) -> String {
        match place {
            TiePlace::At(point) => Point::text(point),
            word => OneOf::<Keyword<TiePlace>>::text(&Keyword(*word)),
        }
    }
}
