//! `where`: the wisps that a step selects.

use std::f64::consts::PI;

use frisure_hairstyle::Place;
use frisure_hairstyle::styling::{Lasso, Selection, Spot, View};
use schemars::{Schema, json_schema};
use toml::Value;

use super::shapes::{Below, Plane};
use super::tables::{Fields, described, tables};
use crate::choice::{Choice, OneOf, two_words};
use crate::error::ValueError;
use crate::kind::{
    Angle, Count, Flag, Kind, Length, Pair, Point, Ratio, ToText, list_text, table_text,
};

/// Name of the schema of `where`, which refers to itself.
pub(crate) const WHERE: &str = "where";

/// How deep a choice may be made of others; TOML itself ends at 80 lists and tables.
const DEEPEST: usize = 32;

/// Most words and tables of a choice, all together. Chosen: a person writes ten, and each looks at all wisps.
const MOST_PARTS: usize = 1000;

/// Most wisps of a list. Chosen: more than a head has.
const MOST_WISPS: usize = 100_000;

/// Most places of a brush and corners of a lasso. Chosen: a hand that draws for minutes makes fewer.
const MOST_POINTS: usize = 10_000;

/// What a table can say, one of these.
const KEYS: [&str; 8] = ["above", "wisps", "plane", "brush", "lasso", "any", "all", "not"];

/// A choice of wisps: a word, a list of words, or a table.
pub(crate) struct Where;

/// A word for a choice.
#[derive(Clone, Copy)]
enum Word {
    Everything,
    Of(Place),
}

impl Choice for Word {
    fn keywords() -> Vec<(&'static str, &'static str, Self)> {
        let places = Place::keywords().into_iter().map(|(word, what, p)| (word, what, Self::Of(p)));
        let everything = ("everything", "all wisps, as without `where`", Self::Everything);
        places.chain([everything]).collect()
    }

    fn synonyms() -> &'static [(&'static str, &'static str)] {
        Place::synonyms()
    }
}

impl Kind for Where {
    type Value = Selection;

    fn read(value: &Value) -> Result<Selection, ValueError> {
        // Before any is read: each takes time here, and more on a head.
        let parts = parts(value);
        if parts > MOST_PARTS {
            let problem =
                format!("{parts} choices of wisps in all; there are at most {MOST_PARTS}");
            let hint = "{ wisps = [0, 12] } has up to 100000 wisps by number";
            return Err(ValueError::because(problem).hint(hint));
        }
        selection(value, 0)
    }

    fn schema() -> Schema {
        json_schema!({ "$ref": format!("#/$defs/{WHERE}") })
    }
}

impl ToText for Where {
    fn text(chosen: &Selection) -> String {
        let one = |key, value| table_text([(key, value)]);
        let is_place = |chosen: &Selection| matches!(chosen, Selection::Place(_));
        match chosen {
            Selection::Everything => "\"everything\"".into(),
            Selection::Place(place) => OneOf::<Place>::text(place),
            Selection::Any(parts) if !parts.is_empty() && parts.iter().all(is_place) => {
                list_text(parts, Self::text)
            }
            Selection::Above(height) => one("above", Below::text(height)),
            Selection::Wisps(wisps) => one("wisps", list_text(wisps, ToString::to_string)),
            Selection::Beyond { point, normal } => one("plane", Plane::text(&(*point, *normal))),
            Selection::Brush { spots, radius } => {
                one("brush", Brush::text(&(spots.clone(), *radius)))
            }
            Selection::Lasso(lasso) => one("lasso", lasso_text(lasso)),
            Selection::Any(parts) => one("any", list_text(parts, Self::text)),
            Selection::All(parts) => one("all", list_text(parts, Self::text)),
            Selection::Not(part) => one("not", Self::text(part)),
        }
    }
}

fn lasso_text(lasso: &Lasso) -> String {
    let camera = Camera::text(&lasso.view);
    let polygon = list_text(&lasso.polygon, |corner| list_text(corner, Ratio::text));
    let through = lasso.through.then(|| ("through", "true".to_owned()));
    table_text([("camera", camera), ("polygon", polygon)].into_iter().chain(through))
}

fn selection(value: &Value, depth: usize) -> Result<Selection, ValueError> {
    if depth > DEEPEST {
        return Err(ValueError::because(format!(
            "this is a choice of choices more than {DEEPEST} deep"
        )));
    }
    match value {
        Value::Array(words) if words.is_empty() => Err(ValueError::new("one place or more")),
        Value::Array(words) => union_of_words(words),
        Value::Table(_) => table(value, depth),
        Value::String(_) => word(value),
        _ => Err(ValueError::new(
            "a part of the scalp such as \"fringe\", a list of parts, or a table such as \
             { not = \"fringe\" }",
        )),
    }
}

/// How many words and tables a choice consists of.
fn parts(value: &Value) -> usize {
    match value {
        Value::Array(list) => list.iter().map(parts).sum(),
        Value::Table(table) => {
            let joined = ["any", "all", "not"].into_iter().filter_map(|key| table.get(key));
            1 + joined.map(parts).sum::<usize>()
        }
        _ => 1,
    }
}

/// A keyword outside of a list.
fn word(value: &Value) -> Result<Selection, ValueError> {
    let both = |[one, other]: [&str; 2]| format!("{{ all = [\"{one}\", \"{other}\"] }}");
    one_word(value, |words| format!("for wisps in both write {}", both(words)))
}

/// A word; `of_two` is what to try where it is two of them together.
fn one_word(value: &Value, of_two: impl Fn([&str; 2]) -> String) -> Result<Selection, ValueError> {
    let place = OneOf::<Word>::read(value).map_err(|error| {
        match value.as_str().and_then(two_words::<Word>) {
            Some(words) if !error.has_hint() => error.hint(of_two(words)),
            _ => error,
        }
    })?;
    Ok(match place {
        Word::Everything => Selection::Everything,
        Word::Of(place) => Selection::Place(place),
    })
}

fn union_of_words(words: &[Value]) -> Result<Selection, ValueError> {
    let both = |[one, other]: [&str; 2]| {
        let both = format!("{{ all = [\"{one}\", \"{other}\"] }}");
        format!(
            "a list has single words; for wisps in both among others write {{ any = [{both}, …] }}"
        )
    };
    each(words, |value| one_word(value, both)).map(Selection::Any)
}

/// A list, if it has not more than `most` of something.
fn at_most<'a>(list: &'a [Value], most: usize, what: &str) -> Result<&'a [Value], ValueError> {
    if list.len() <= most {
        return Ok(list);
    }
    let problem = format!("{} {what}; there are at most {most}", list.len());
    Err(ValueError::because(problem).hint("leave out what does not matter, or make it two steps"))
}

/// Reads every value of a list.
fn each<T>(
    list: &[Value],
    read: impl Fn(&Value) -> Result<T, ValueError>,
) -> Result<Vec<T>, ValueError> {
    let item = |(i, value)| read(value).map_err(|e: ValueError| e.inside(&format!("[{i}]")));
    list.iter().enumerate().map(item).collect()
}

fn table(value: &Value, depth: usize) -> Result<Selection, ValueError> {
    let allowed = "a table with one of its keys";
    Fields::new(value, &KEYS, allowed)?;
    let entries: Vec<_> = value.as_table().into_iter().flatten().collect();
    let (key, value) = match entries.as_slice() {
        [] => return Err(ValueError::because(format!("this says nothing: {}", one_of_the_keys()))),
        [(key, value)] => (key.as_str(), *value),
        [(one, _), (other, _), ..] => {
            let problem = format!("`{one}` and `{other}` are two choices of wisps in one table");
            let hint =
                "for wisps in both write { all = [{ … }, { … }] }, in either { any = [ … ] }";
            return Err(ValueError::because(problem).hint(hint));
        }
    };
    let inside = |e: ValueError| e.inside(&format!(".{key}"));
    let chosen = of_key(key, value, depth + 1).map_err(inside)?;
    // What is joined was checked when it was read.
    if !matches!(chosen, Selection::Any(_) | Selection::All(_) | Selection::Not(_)) {
        chosen.check().map_err(|error| {
            let place = error.field.strip_prefix(WHERE).unwrap_or("");
            ValueError::out_of_range(&error, place)
        })?;
    }
    Ok(chosen)
}

fn one_of_the_keys() -> String {
    format!("it needs one of {}", KEYS.join(", "))
}

fn of_key(key: &str, value: &Value, depth: usize) -> Result<Selection, ValueError> {
    let joined = || {
        let list = value.as_array().ok_or_else(|| ValueError::new("a list of choices of wisps"))?;
        each(list, |item| selection(item, depth))
    };
    Ok(match key {
        "above" => Selection::Above(Below::read(value)?),
        "wisps" => Selection::Wisps(wisps(value)?),
        "plane" => {
            let (point, normal) = Plane::read(value)?;
            Selection::Beyond { point, normal }
        }
        "brush" => {
            let (spots, radius) = Brush::read(value)?;
            Selection::Brush { spots, radius }
        }
        "lasso" => Selection::Lasso(lasso(value)?),
        "any" => Selection::Any(joined()?),
        "all" => Selection::All(joined()?),
        _ => Selection::Not(Box::new(selection(value, depth)?)),
    })
}

fn wisps(value: &Value) -> Result<Vec<usize>, ValueError> {
    let allowed = "a list of numbers of wisps, such as [0, 12]";
    let list = value.as_array().ok_or_else(|| ValueError::new(allowed))?;
    each(at_most(list, MOST_WISPS, "wisps")?, Count::read)
}

fn lasso(value: &Value) -> Result<Lasso, ValueError> {
    let allowed = "a lasso, which has a `camera` and a `polygon`";
    let fields = Fields::new(value, &["camera", "polygon", "through"], allowed)?;
    let (view, polygon) = (fields.need::<Camera>("camera")?, fields.need::<Polygon>("polygon")?);
    Ok(Lasso { view, polygon, through: fields.get::<Flag>("through")?.unwrap_or(false) })
}

/// Places of a brush: points, or places measured on the skin.
struct Spots;

impl Kind for Spots {
    type Value = Vec<Spot>;

    fn read(value: &Value) -> Result<Vec<Spot>, ValueError> {
        let allowed = "a list of points [[x, y, z], …] or of places on the skin \
                       [[\"2 cm\", \"5 cm\"], …]";
        let list = value.as_array().ok_or_else(|| ValueError::new(allowed))?;
        // One place is a list of one.
        if list.first().is_some_and(|first| !first.is_array()) {
            return spot(value).map(|spot| vec![spot]);
        }
        each(at_most(list, MOST_POINTS, "places")?, spot)
    }

    fn schema() -> Schema {
        let spot = json_schema!({ "anyOf": [Pair::schema(), Point::schema()] });
        json_schema!({
            "anyOf": [
                { "type": "array", "items": spot, "maxItems": MOST_POINTS },
                Pair::schema(),
                Point::schema(),
            ],
            "examples": [[["2 cm", "5 cm"], [0, "-4 cm", "9 cm"]]],
        })
    }
}

fn spot(value: &Value) -> Result<Spot, ValueError> {
    match value.as_array().map(Vec::len) {
        Some(2) => Pair::read(value).map(Spot::Tape),
        Some(3) => Point::read(value).map(Spot::At),
        _ => Err(ValueError::new("a point [x, y, z], or a place on the skin [across, back]")),
    }
}

impl ToText for Spots {
    fn text(spots: &Vec<Spot>) -> String {
        list_text(spots, |spot| match spot {
            Spot::At(p) => Point::text(p),
            Spot::Tape(place) => Pair::text(place),
        })
    }
}

tables! {
    /// A brush: its places and its radius (m).
    Brush: (Vec<Spot>, f64) as [(at, radius)],
    "a brush, such as { at = [[\"2 cm\", \"5 cm\"]], radius = \"2 cm\" }" {
        at: Spots, "Where it was: points [x, y, z] in the head's frame, or places [across, back] on the \
            skin as in a parting's `line`; one, or a list.";
        radius: Length, "0.1 mm to 1 m.", 1e-4 => 1.0;
    }

    /// A pinhole camera.
    Camera: View as [View { eye, target, field_of_view, aspect }],
    "a camera, which has `eye`, `target`, `field_of_view` and `aspect`" {
        eye: Point, "Its place: a point in the head's frame (m), within 100 m of the origin.";
        target: Point, "The point it looks at, in the same frame; apart from the eye.";
        field_of_view: Angle, "From the picture's bottom to its top, 0.1 to 179 deg.",
            0.1 * PI / 180.0 => 179.0 * PI / 180.0;
        aspect: Ratio, "Width over height; 0.001 to 1000.";
    }
}

/// Corners in a picture.
struct Polygon;

impl Kind for Polygon {
    type Value = Vec<[f64; 2]>;

    fn read(value: &Value) -> Result<Vec<[f64; 2]>, ValueError> {
        let allowed = "a list of corners [[u, v], …], from -1 to 1 across the picture and up";
        let list = value.as_array().ok_or_else(|| ValueError::new(allowed))?;
        each(at_most(list, MOST_POINTS, "corners")?, |corner| {
            match corner.as_array().map(Vec::as_slice) {
                Some([u, v]) => Ok([Ratio::read(u)?, Ratio::read(v)?]),
                _ => Err(ValueError::new("a corner of two numbers, such as [0.5, -0.5]")),
            }
        })
    }

    fn schema() -> Schema {
        let corner = json_schema!({
            "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 2,
        });
        json_schema!({
            "type": "array", "items": corner, "minItems": 3, "maxItems": MOST_POINTS,
        })
    }
}

fn lasso_schema() -> Schema {
    json_schema!({
        "type": "object", "additionalProperties": false, "required": ["camera", "polygon"],
        "properties": {
            "camera": described(
                &Camera::schema(),
                "The camera of the picture. `eye` and `target` are points in metres in the head's \
                 frame (x to its left, the face towards -y, z up, the middle of the head near 0), such \
                 as { eye = [0, -1, 0.1], target = [0, 0, 0], field_of_view = \"30 deg\", aspect = 0.8 } \
                 from the front.",
            ),
            "polygon": described(
                &Polygon::schema(),
                "Corners, from -1 to 1 from left to right and from bottom to top.",
            ),
            "through": described(
                &Flag::schema(),
                "Whether it also takes hair that the head hides. Default false.",
            ),
        },
    })
}

/// The JSON Schema of `where`.
pub(crate) fn where_schema() -> Schema {
    let one = Where::schema();
    let list = json_schema!({ "type": "array", "items": one, "maxItems": MOST_PARTS });
    let word = OneOf::<Word>::schema();
    let wisps = json_schema!({
        "type": "array", "items": Count::schema(), "maxItems": MOST_WISPS,
    });
    let of = described;
    let tables = json_schema!({
        "type": "object", "additionalProperties": false, "minProperties": 1, "maxProperties": 1,
        "properties": {
            "above": of(&Below::schema(), "Rooted above a level of the head, or a height (m)."),
            "wisps": of(&wisps, "By number."),
            "plane": of(&Plane::schema(), "Rooted on the side of a plane that its normal points to."),
            "brush": of(
                &Brush::schema(),
                "Rooted under a brush drawn over the scalp, such as { at = [[0, \"-4 cm\", \"9 cm\"]], \
                 radius = \"2 cm\" }.",
            ),
            "lasso": of(&lasso_schema(), "Mostly seen inside a polygon drawn on a picture."),
            "any": of(&list, "In any of these."),
            "all": of(&list, "In all of these."),
            "not": of(&one, "Not in this one."),
        },
    });
    json_schema!({
        "description": "Which wisps: a part of the scalp as in `[[region]]`, or \"everything\"; a list \
                        of parts; or a table with one key; at most 1000 words and tables in all. Without it: everything.",
        "anyOf": [
            word,
            { "type": "array", "items": word, "minItems": 1, "maxItems": MOST_PARTS },
            tables,
        ],
    })
}
