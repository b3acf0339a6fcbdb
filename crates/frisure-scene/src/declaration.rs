//! Declarations of scene keys: reading, error messages, the JSON Schema, `docs/scene.md`, batch keys and the controls of programs
//! follow from them.

use frisure_hairstyle::{Range, Scalar};
use schemars::Schema;
use toml::Value;

use crate::control::{OptionList, Panel, Slider, Unit};
use crate::error::ValueError;
use crate::kind::Kind;
use crate::scene::Scene;

/// A key of a scene, or a table of keys.
#[derive(Debug)]
pub struct Declaration {
    /// Path, such as `wisps.clumping` or `region[].length`, with `[]` for the index of an item in a list.
    pub path: &'static str,
    /// Documentation.
    pub doc: String,
    pub(crate) value: ValueKind,
}

/// What a key takes.
#[derive(Debug)]
pub(crate) enum ValueKind {
    /// A table of keys, or a list of such tables.
    Table,
    /// A number.
    Number(Number),
    /// Anything else, with its schema, and how programs offer it.
    Other(fn() -> Schema, Option<OptionList>),
}

/// A key that takes a number.
#[derive(Debug)]
pub(crate) struct Number {
    pub(crate) read: fn(&Value) -> Result<f64, ValueError>,
    pub(crate) schema: fn() -> Schema,
    /// The range of the key itself, and whether reading checks it.
    pub(crate) range: Option<(Range, bool)>,
    pub(crate) access: Access,
    pub(crate) slider: Option<Slider>,
}

/// Where the number of a key is in a scene.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Access {
    /// In several fields, or in none: code reads it. The function returns what a slider displays.
    Code(fn(&Scene) -> f64),
    /// In the description of the hairstyle.
    Hairstyle(&'static frisure_hairstyle::Number),
    /// In another field of the scene.
    Field { get: fn(&Scene) -> f64, set: fn(&mut Scene, f64) },
}

impl Access {
    pub(crate) fn get(self, scene: &Scene) -> f64 {
        match self {
            Self::Code(get) | Self::Field { get, .. } => get(scene),
            Self::Hairstyle(number) => number.get(&scene.spec).unwrap_or(f64::NAN),
        }
    }

    pub(crate) fn set(self, scene: &mut Scene, value: f64) {
        match self {
            Self::Code(_) => {}
            Self::Hairstyle(number) => number.set(&mut scene.spec, value),
            Self::Field { set, .. } => set(scene, value),
        }
    }
}

/// A table, or a list of tables.
pub(crate) fn table() -> ValueKind {
    ValueKind::Table
}

/// A key with a value of a kind.
pub(crate) fn value<K: Kind>() -> ValueKind {
    ValueKind::Other(K::schema, None)
}

/// A key with a number.
pub(crate) fn number<K: Kind<Value: Scalar>>() -> Number {
    Number {
        read: |value| K::read(value).map(Scalar::to_f64),
        schema: K::schema,
        range: None,
        access: Access::Code(|_| f64::NAN),
        slider: None,
    }
}

impl ValueKind {
    /// Offers the keywords of the key as a list of options.
    pub(crate) fn options(self, panel: Panel, label: &'static str, help: &'static str) -> Self {
        match self {
            Self::Other(schema, _) => Self::Other(schema, Some(OptionList { panel, label, help })),
            other => other,
        }
    }
}

impl Number {
    /// Gives the key a range, which is checked when a scene is read (SI units).
    pub(crate) fn range(self, min: f64, max: f64, allowed: &'static str) -> Self {
        Self { range: Some((Range::new("", min, max, allowed), true)), ..self }
    }

    /// Gives the key bounds for its schema, which code checks (SI units).
    pub(crate) fn bounds(self, min: f64, max: f64) -> Self {
        Self { range: Some((Range::new("", min, max, ""), false)), ..self }
    }

    /// Reads the number into a field of the scene.
    pub(crate) fn field(self, access: Access) -> Self {
        Self { access, ..self }
    }

    /// Offers the key as a slider, with a range in the unit.
    pub(crate) fn slider(
        self,
        panel: Panel,
        label: &'static str,
        unit: Unit,
        range: (f64, f64),
        decimals: usize,
        help: &'static str,
    ) -> Self {
        let slider = Slider { panel, label, unit, range, decimals, logarithmic: false, help };
        Self { slider: Some(slider), ..self }
    }

    /// Gives the slider a logarithmic scale.
    pub(crate) fn logarithmic(self) -> Self {
        let slider = self.slider.map(|slider| Slider { logarithmic: true, ..slider });
        Self { slider, ..self }
    }

    /// Says which number the slider displays, if code reads the key (SI units).
    pub(crate) fn shows(self, get: fn(&Scene) -> f64) -> Self {
        Self { access: Access::Code(get), ..self }
    }
}

impl From<Number> for ValueKind {
    fn from(number: Number) -> Self {
        Self::Number(number)
    }
}

impl Declaration {
    /// Declares a key; `{}` in its documentation stands for the range of its number.
    pub(crate) fn new(path: &'static str, doc: &[&str], value: impl Into<ValueKind>) -> Self {
        let doc = doc.iter().map(|line| line.trim()).collect::<Vec<_>>().join("\n");
        let mut declared = Self { path, doc, value: value.into() };
        let described = frisure_hairstyle::number(&path.replace("[]", ""));
        if let (ValueKind::Number(number), Some(described)) = (&mut declared.value, described) {
            number.range = number.range.or(Some((described.range, false)));
            if described.is_field() {
                number.access = Access::Hairstyle(described);
            }
        }
        if let Some(range) = declared.range() {
            declared.doc = declared.doc.replace("{}", &in_prose(range.allowed));
        }
        declared
    }

    /// The range of the number (SI units).
    pub(crate) fn range(&self) -> Option<Range> {
        match &self.value {
            ValueKind::Number(number) => number.range.map(|(range, _)| range),
            ValueKind::Table | ValueKind::Other(..) => None,
        }
    }

    /// The number that the key takes, if it takes one.
    pub(crate) fn number(&self) -> Option<&Number> {
        match &self.value {
            ValueKind::Number(number) => Some(number),
            ValueKind::Table | ValueKind::Other(..) => None,
        }
    }

    /// The slider with which a program displays the key.
    #[must_use]
    pub fn slider(&self) -> Option<&Slider> {
        self.number()?.slider.as_ref()
    }

    /// The list with which a program displays the key.
    #[must_use]
    pub fn option_list(&self) -> Option<&OptionList> {
        match &self.value {
            ValueKind::Other(_, list) => list.as_ref(),
            ValueKind::Table | ValueKind::Number(_) => None,
        }
    }

    /// The number of a scene that the slider displays (SI units); NaN if the key has none.
    #[must_use]
    pub fn number_in(&self, scene: &Scene) -> f64 {
        self.number().map_or(f64::NAN, |number| number.access.get(scene))
    }
}

/// "between 1 mm and 3 m" as "1 mm to 3 m", in plain characters.
pub(crate) fn in_prose(allowed: &str) -> String {
    let (_, between) = allowed.split_once("between ").unwrap_or(("", allowed));
    between.replacen(" and ", " to ", 1).replace('²', "^2")
}

/// Splits a path into the path of its declaration, with `[]`, and the index in brackets.
pub(crate) fn without_index(key: &str) -> (String, String) {
    let brackets = key.find('[').zip(key.find(']')).filter(|(start, end)| start < end);
    match brackets {
        Some((start, end)) => {
            (format!("{}[]{}", &key[..start], &key[end + 1..]), key[start..=end].to_owned())
        }
        None => (key.to_owned(), String::new()),
    }
}

/// Adds the range of a number to its schema (SI units).
pub(crate) fn add_range(schema: &mut Schema, range: Range) {
    let whole = schema.get("type").is_some_and(|kind| kind == "integer");
    let bound = |x: f64| if whole { (x as i64).into() } else { x.into() };
    let bounds = [("minimum", range.min), ("maximum", range.max)];
    for (name, x) in bounds.into_iter().filter(|(_, x)| x.is_finite()) {
        schema.insert(name.into(), bound(x));
    }
}

/// The accessors of a field of a scene, such as `camera.azimuth`.
macro_rules! field {
    ($($field:ident).+) => {
        Access::Field {
            get: |scene| scene.$($field).+.to_f64(),
            set: |scene, value| scene.$($field).+ = Scalar::from_f64(value),
        }
    };
}

pub(crate) use field;
