//! A layer: prims in a tree, each with attributes and relationships.

use super::value::{Base, Kind, Value};

/// Properties that a prim may have: they are looked for one by one.
const MOST_PROPERTIES: usize = 10_000;

/// What one file holds.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Layer {
    /// Of those that [`metadata_kind`] knows.
    pub(crate) metadata: Vec<(String, Value)>,
    pub(crate) prims: Vec<Prim>,
}

/// A prim.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Prim {
    pub(crate) name: String,
    /// Such as `BasisCurves`; empty where it is left open.
    pub(crate) type_name: String,
    pub(crate) specifier: Specifier,
    /// Names of the schemas that are applied to it.
    pub(crate) schemas: Vec<String>,
    /// Of those that [`metadata_kind`] knows.
    pub(crate) metadata: Vec<(String, Value)>,
    /// What it would take from elsewhere (`references`, `payload`, `variantSets`, …), which is not followed.
    pub(crate) elsewhere: Vec<String>,
    pub(crate) attributes: Vec<Attribute>,
    pub(crate) relationships: Vec<Relationship>,
    pub(crate) children: Vec<Prim>,
}

/// Whether a prim is one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Specifier {
    #[default]
    Def,
    /// Says something of a prim that is defined elsewhere.
    Over,
    /// To be inherited from.
    Class,
}

impl Specifier {
    pub(crate) const ALL: [Self; 3] = [Self::Def, Self::Over, Self::Class];

    pub(crate) fn word(self) -> &'static str {
        match self {
            Self::Def => "def",
            Self::Over => "over",
            Self::Class => "class",
        }
    }
}

/// An attribute.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Attribute {
    pub(crate) name: String,
    /// With its role, such as `point3f[]`.
    pub(crate) type_name: String,
    pub(crate) uniform: bool,
    pub(crate) custom: bool,
    /// Its default, or else the first of its samples in time.
    pub(crate) value: Option<Value>,
    pub(crate) connections: Vec<String>,
    /// Of those that [`metadata_kind`] knows.
    pub(crate) metadata: Vec<(String, Value)>,
}

/// A relationship.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Relationship {
    pub(crate) name: String,
    pub(crate) targets: Vec<String>,
}

/// The kinds of the metadata that are kept. Text does not tell them.
pub(crate) fn metadata_kind(key: &str) -> Option<Kind> {
    let base = match key {
        "metersPerUnit" => Base::Double,
        "elementSize" => Base::Int,
        "active" => Base::Bool,
        "defaultPrim" | "interpolation" | "kind" | "upAxis" => Base::Token,
        "displayName" | "documentation" => Base::String,
        _ => return None,
    };
    Some(Kind::one(base))
}

/// The metadata of prims that bring something from elsewhere.
pub(crate) fn is_from_elsewhere(key: &str) -> bool {
    let all = ["references", "payload", "inherits", "specializes", "variantSets", "clips"];
    all.contains(&key)
}

fn get<'a>(metadata: &'a [(String, Value)], key: &str) -> Option<&'a Value> {
    metadata.iter().find(|(k, _)| k == key).map(|(_, value)| value)
}

impl Layer {
    pub(crate) fn meta(&self, key: &str) -> Option<&Value> {
        get(&self.metadata, key)
    }
}

impl Prim {
    pub(crate) fn new(type_name: &str, name: &str) -> Self {
        Self { name: name.into(), type_name: type_name.into(), ..Self::default() }
    }

    pub(crate) fn meta(&self, key: &str) -> Option<&Value> {
        get(&self.metadata, key)
    }

    pub(crate) fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.name == name)
    }

    /// Refuses more properties than any prim has.
    pub(crate) fn check_properties(&self) -> Result<(), String> {
        if self.attributes.len() + self.relationships.len() <= MOST_PROPERTIES {
            return Ok(());
        }
        Err(format!("prim `{}` has more than {MOST_PROPERTIES} properties", self.name))
    }

    /// The value of an attribute, if it has one.
    pub(crate) fn value(&self, name: &str) -> Option<&Value> {
        self.attribute(name)?.value.as_ref()
    }

    /// The word that an attribute has.
    pub(crate) fn word(&self, name: &str) -> Option<&str> {
        self.value(name)?.word()
    }

    /// Adds an attribute that may change in time.
    pub(crate) fn varying(&mut self, type_name: &str, name: &str, value: Value) -> &mut Attribute {
        self.attributes.push(Attribute {
            name: name.into(),
            type_name: type_name.into(),
            value: Some(value),
            ..Attribute::default()
        });
        self.attributes.last_mut().expect("it was just added")
    }

    /// Adds an attribute that is always the same.
    pub(crate) fn uniform(&mut self, type_name: &str, name: &str, value: Value) {
        self.varying(type_name, name, value).uniform = true;
    }

    /// Adds an attribute, with what it has one value for.
    pub(crate) fn primvar(&mut self, type_name: &str, name: &str, value: Value, per: &str) {
        let attribute = self.varying(type_name, name, value);
        attribute.metadata.push(("interpolation".into(), Value::token(per)));
    }

    /// Adds an output of a shader or material.
    pub(crate) fn output(&mut self, name: &str) -> &mut Attribute {
        let (name, type_name) = (name.into(), "token".into());
        self.attributes.push(Attribute { name, type_name, ..Attribute::default() });
        self.attributes.last_mut().expect("it was just added")
    }

    pub(crate) fn relate(&mut self, name: &str, target: &str) {
        let targets = vec![target.into()];
        self.relationships.push(Relationship { name: name.into(), targets });
    }
}

impl Attribute {
    pub(crate) fn meta(&self, key: &str) -> Option<&Value> {
        get(&self.metadata, key)
    }
}
