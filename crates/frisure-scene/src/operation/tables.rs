//! Kinds of values that are tables.

use schemars::Schema;
use toml::{Table, Value};

use crate::error::ValueError;
use crate::kind::Kind;

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

/// Declares kinds of tables: `Name: Value as [PATTERN], ALLOWED { key: Kind, DOCUMENTATION; }`. All keys are needed; the pattern
/// makes the value from them, and takes it apart again.
macro_rules! tables {
    ($(
        $(#[$meta:meta])*
        $Name:ident: $Value:ty as [$($pattern:tt)*], $allowed:literal {
            $($key:ident: $Kind:ty, $doc:literal $(, $min:expr => $max:expr)?;)*
        }
    )*) => {$(
        $(#[$meta])*
        pub(super) struct $Name;

        impl $crate::kind::Kind for $Name {
            type Value = $Value;

            fn read(value: &toml::Value) -> Result<$Value, $crate::error::ValueError> {
                let known = [$(stringify!($key)),*];
                let fields = $crate::operation::tables::Fields::new(value, &known, $allowed)?;
                $(let $key = fields.need::<$Kind>(stringify!($key))?;)*
                Ok($($pattern)*)
            }

            fn schema() -> schemars::Schema {
                schemars::json_schema!({
                    "type": "object", "additionalProperties": false,
                    "properties": {
                        $(stringify!($key): tables!(@key $Kind, $doc $(, $min, $max)?)),*
                    },
                    "required": [$(stringify!($key)),*],
                })
            }
        }

        impl $crate::kind::ToText for $Name {
            fn text(value: &$Value) -> String {
                let $($pattern)* = value;
                $crate::kind::table_text([
                    $((stringify!($key), <$Kind as $crate::kind::ToText>::text($key))),*
                ])
            }
        }
    )*};
    (@key $Kind:ty, $doc:literal) => {
        $crate::operation::tables::described(&<$Kind>::schema(), $doc)
    };
    (@key $Kind:ty, $doc:literal, $min:expr, $max:expr) => {
        $crate::operation::tables::bounded(&<$Kind>::schema(), $min, $max, $doc)
    };
}

pub(super) use tables;
