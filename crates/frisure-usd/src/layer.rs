//! A layer: prims in a tree, each with attributes and relationships.

use super::value::{Data, ScalarType, Value, ValueType};

/// Prims within prims, at most.
pub const MAX_DEPTH: usize = 200;

/// Properties that a prim may have: they are looked for one by one.
const MOST_PROPERTIES: usize = 10_000;

/// The contents of one file.
///
/// ```
/// use frisure_usd::{Layer, Prim, Value, read, write_text};
///
/// let mut prim = Prim::new("Mesh", "head");
/// prim.varying("float", "width", Value::float(0.5));
/// let layer = Layer { prims: vec![prim], ..Layer::default() };
/// let mut text = Vec::new();
/// write_text(&mut text, &layer)?;
/// assert!(text.starts_with(b"#usda 1.0"));
/// let same = read(&text)?;
/// assert_eq!(same.prims[0].value("width").and_then(Value::number), Some(0.5));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Layer {
    /// The metadata keys that the reader supports.
    pub metadata: Vec<(String, Value)>,
    /// Its root prims.
    pub prims: Vec<Prim>,
}

/// A prim.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Prim {
    /// Its name.
    pub name: String,
    /// Its type, such as `BasisCurves`; empty where the layer does not state it.
    pub type_name: String,
    /// Whether it is defined here.
    pub specifier: Specifier,
    /// Names of the schemas that are applied to it.
    pub schemas: Vec<String>,
    /// The metadata keys that the reader supports.
    pub metadata: Vec<(String, Value)>,
    /// Its composition arcs (`references`, `payload`, `variantSets`, …), which are not followed.
    pub arcs: Vec<String>,
    /// Its attributes, in their order.
    pub attributes: Vec<Attribute>,
    /// Its relationships, in their order.
    pub relationships: Vec<Relationship>,
    /// The prims in it.
    pub children: Vec<Prim>,
}

/// Whether a prim is one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Specifier {
    /// Defines a prim.
    #[default]
    Def,
    /// Overrides a prim of another layer.
    Over,
    /// To be inherited from.
    Class,
}

impl Specifier {
    /// All specifiers, in the order of their numbers in binary layers.
    pub const ALL: [Self; 3] = [Self::Def, Self::Over, Self::Class];

    /// The word of the text format.
    pub fn word(self) -> &'static str {
        match self {
            Self::Def => "def",
            Self::Over => "over",
            Self::Class => "class",
        }
    }
}

/// An attribute.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Attribute {
    /// Its name.
    pub name: String,
    /// Its type with its role, such as `point3f[]`.
    pub type_name: String,
    /// Whether it never changes in time.
    pub uniform: bool,
    /// Whether no schema declares it.
    pub custom: bool,
    /// Its default, or else the first of its samples in time.
    pub value: Option<Value>,
    /// Values at times (time codes, increasing), to be written; none of a layer that was read.
    pub samples: Vec<(f64, Value)>,
    /// How many samples in time it has in a layer that was read; [`Self::value`] has one of them at most.
    pub times: usize,
    /// Paths of the attributes that it is connected to.
    pub connections: Vec<String>,
    /// The metadata keys that the reader supports.
    pub metadata: Vec<(String, Value)>,
}

/// A relationship.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Relationship {
    /// Its name.
    pub name: String,
    /// The paths that it points to.
    pub targets: Vec<String>,
}

/// The types of the metadata that are kept: the text format does not state them.
pub(crate) fn metadata_type(key: &str) -> Option<ValueType> {
    let scalar = match key {
        "metersPerUnit" | "startTimeCode" | "endTimeCode" | "timeCodesPerSecond"
        | "framesPerSecond" => ScalarType::Double,
        "elementSize" => ScalarType::Int,
        "active" => ScalarType::Bool,
        "defaultPrim" | "interpolation" | "kind" | "upAxis" => ScalarType::Token,
        "displayName" | "documentation" => ScalarType::String,
        _ => return None,
    };
    Some(ValueType::one(scalar))
}

/// Whether a metadata key of a prim is a composition arc.
pub(crate) fn is_composition_arc(key: &str) -> bool {
    let all = ["references", "payload", "inherits", "specializes", "variantSets", "clips"];
    all.contains(&key)
}

fn get<'a>(metadata: &'a [(String, Value)], key: &str) -> Option<&'a Value> {
    metadata.iter().find(|(k, _)| k == key).map(|(_, value)| value)
}

impl Layer {
    /// The value of a metadata key.
    pub fn meta(&self, key: &str) -> Option<&Value> {
        get(&self.metadata, key)
    }
}

impl Prim {
    /// A prim of a type, with nothing in it.
    pub fn new(type_name: &str, name: &str) -> Self {
        Self { name: name.into(), type_name: type_name.into(), ..Self::default() }
    }

    /// The value of a metadata key.
    pub fn meta(&self, key: &str) -> Option<&Value> {
        get(&self.metadata, key)
    }

    /// The attribute of a name.
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.name == name)
    }

    /// Refuses more properties than any prim has.
    pub fn check_properties(&self) -> Result<(), String> {
        if self.attributes.len() + self.relationships.len() <= MOST_PROPERTIES {
            return Ok(());
        }
        Err(format!("prim `{}` has more than {MOST_PROPERTIES} properties", self.name))
    }

    /// The value of an attribute, if it has one.
    pub fn value(&self, name: &str) -> Option<&Value> {
        self.attribute(name)?.value.as_ref()
    }

    /// The scalars of an attribute's value. Where the prim has indices for it (`NAME:indices`), each index gives the
    /// `width` scalars that it names.
    ///
    /// # Errors
    /// What is wrong with the indices.
    pub fn resolved(
        &self,
        attribute: &Attribute,
        value: &Value,
        width: usize,
    ) -> Result<Data, String> {
        let name = &attribute.name;
        let Some(indices) = self.value(&format!("{name}:indices")) else {
            return Ok(value.data.clone());
        };
        let count = value.data.len() / width;
        let indices = indices
            .to_integers()
            .ok_or_else(|| format!("`{name}` has indices that are no integers"))?;
        let row = |i: i64| usize::try_from(i).ok().filter(|&i| i < count);
        let rows: Option<Vec<usize>> = indices.into_iter().map(row).collect();
        let rows = rows.ok_or_else(|| format!("`{name}` has an index of no value"))?;
        Ok(value.data.picked(&rows, width))
    }

    /// The word that an attribute has.
    pub fn word(&self, name: &str) -> Option<&str> {
        self.value(name)?.word()
    }

    /// Adds an attribute that may change in time.
    pub fn varying(&mut self, type_name: &str, name: &str, value: Value) -> &mut Attribute {
        self.attributes.push(Attribute {
            name: name.into(),
            type_name: type_name.into(),
            value: Some(value),
            ..Attribute::default()
        });
        self.attributes.last_mut().expect("it was just added")
    }

    /// Adds an attribute with values at times (time codes, increasing), or with one that it always has.
    ///
    /// # Panics
    /// If there is no value.
    pub fn over_time(
        &mut self,
        type_name: &str,
        name: &str,
        mut samples: Vec<(f64, Value)>,
    ) -> &mut Attribute {
        let value = match samples.len() {
            0 => panic!("`{name}` has no value"),
            1 => samples.pop().map(|(_, value)| value),
            _ => None,
        };
        let (name, type_name) = (name.into(), type_name.into());
        self.attributes.push(Attribute { name, type_name, value, samples, ..Attribute::default() });
        self.attributes.last_mut().expect("it was just added")
    }

    /// Adds an attribute that is always the same.
    pub fn uniform(&mut self, type_name: &str, name: &str, value: Value) {
        self.varying(type_name, name, value).uniform = true;
    }

    /// Adds an attribute, with what it has one value for.
    pub fn primvar(&mut self, type_name: &str, name: &str, value: Value, per: &str) {
        let attribute = self.varying(type_name, name, value);
        attribute.metadata.push(("interpolation".into(), Value::token(per)));
    }

    /// Adds an output of a shader or material.
    pub fn output(&mut self, name: &str) -> &mut Attribute {
        let (name, type_name) = (name.into(), "token".into());
        self.attributes.push(Attribute { name, type_name, ..Attribute::default() });
        self.attributes.last_mut().expect("it was just added")
    }

    /// Adds a relationship with one target.
    pub fn relate(&mut self, name: &str, target: &str) {
        let targets = vec![target.into()];
        self.relationships.push(Relationship { name: name.into(), targets });
    }
}

impl Attribute {
    /// The value of a metadata key.
    pub fn meta(&self, key: &str) -> Option<&Value> {
        get(&self.metadata, key)
    }
}
