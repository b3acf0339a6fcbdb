//! Tables of a batch with known keys.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::names::ValueType;
use super::way::{Value, Written, understood, word};
use crate::error::{Diagnostic, Result, SceneError};
use crate::kind::read_quantity;
use crate::similar::nearest;
use crate::source::Source;

/// A key with its value, in the text.
#[derive(Clone)]
pub(super) struct Field<'a> {
    pub(super) key: Range<usize>,
    pub(super) value: &'a Spanned<DeValue<'a>>,
}

/// A table of which all keys are known.
pub(super) struct Table<'a> {
    source: &'a Source,
    /// Its path in the batch, or that of the scene key that it is about.
    path: String,
    fields: BTreeMap<String, Field<'a>>,
}

/// The path of a key in a table.
pub(super) fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

impl<'a> Table<'a> {
    /// Reads the keys of a table.
    ///
    /// # Errors
    /// [`SceneError`] for a key that is not known.
    pub(super) fn read(
        source: &'a Source,
        table: &'a DeTable<'a>,
        path: &str,
        known: &[&str],
    ) -> Result<Self> {
        let mut fields = BTreeMap::new();
        for (key, value) in table {
            let name = key.get_ref().as_ref();
            if !known.contains(&name) {
                let hint = match nearest(name, known.iter().copied()) {
                    Some(near) => format!("did you mean `{near}`?"),
                    None => format!("known keys: {}", known.join(", ")),
                };
                let unknown = Diagnostic::new(format!("unknown key `{name}`")).hint(hint);
                return Err(unknown.key(join(path, name)).at(source, key.span()));
            }
            fields.insert(name.to_owned(), Field { key: key.span(), value });
        }
        Ok(Self { source, path: path.to_owned(), fields })
    }

    pub(super) fn field(&self, key: &str) -> Option<&Field<'a>> {
        self.fields.get(key)
    }

    pub(super) fn has(&self, key: &str) -> bool {
        self.fields.contains_key(key)
    }

    /// The value of a key as it is written.
    pub(super) fn text(&self, key: &str) -> &'a str {
        self.fields.get(key).map_or("", |field| self.source.slice(field.value.span()))
    }

    /// The span of the value of a key.
    pub(super) fn span(&self, key: &str) -> Range<usize> {
        self.fields.get(key).map_or(0..0, |field| field.value.span())
    }

    /// The error about the value of a key that is not allowed.
    pub(super) fn refuse(&self, key: &str, allowed: impl Into<String>) -> SceneError {
        self.refuse_at(key, self.span(key), allowed)
    }

    /// The error about a part of the value of a key that is not allowed.
    pub(super) fn refuse_at(
        &self,
        key: &str,
        span: Range<usize>,
        allowed: impl Into<String>,
    ) -> SceneError {
        let refused = Diagnostic::outside(allowed).key(join(&self.path, key));
        refused.value(self.source.slice(span.clone())).at(self.source, span)
    }

    /// The whole number of a key.
    pub(super) fn whole(&self, key: &str, min: i64, max: i64) -> Result<Option<i64>> {
        if !self.has(key) {
            return Ok(None);
        }
        match Written::literal(self.text(key), None).value {
            Value::Whole(x) if (min..=max).contains(&x) => Ok(Some(x)),
            _ if max == i64::MAX => Err(self.refuse(key, format!("a whole number, {min} or more"))),
            _ => Err(self.refuse(key, format!("a whole number between {min} and {max}"))),
        }
    }

    /// The flag of a key.
    pub(super) fn flag(&self, key: &str) -> Result<Option<bool>> {
        let Some(field) = self.fields.get(key) else { return Ok(None) };
        let flag = field.value.get_ref().as_bool();
        flag.map(Some).ok_or_else(|| self.refuse(key, "true or false"))
    }

    /// The text of a key.
    pub(super) fn word(&self, key: &str) -> Result<Option<String>> {
        if !self.has(key) {
            return Ok(None);
        }
        word(self.text(key)).map(Some).ok_or_else(|| self.refuse(key, "a text in quotes"))
    }

    /// The list of a key, which is not empty.
    pub(super) fn list(&self, key: &str) -> Option<&'a [Spanned<DeValue<'a>>]> {
        let items = self.fields.get(key)?.value.get_ref().as_array()?;
        (!items.is_empty()).then_some(items)
    }

    /// The number of a key, in SI units.
    pub(super) fn number(&self, key: &str, value_type: ValueType) -> Result<Option<f64>> {
        if !self.has(key) {
            return Ok(None);
        }
        self.quantity(key, self.span(key), value_type).map(Some)
    }

    /// The number in the value of a key, in SI units.
    pub(super) fn quantity(
        &self,
        key: &str,
        span: Range<usize>,
        value_type: ValueType,
    ) -> Result<f64> {
        let text = self.source.slice(span.clone());
        match value_type {
            ValueType::Quantity(dimension) => {
                let value = understood(text);
                let value = value.ok_or_else(|| self.refuse_at(key, span.clone(), "a number"))?;
                read_quantity(&value, dimension)
                    .map_err(|e| e.at(self.source.path_at(&span), self.source, span))
            }
            ValueType::Whole => match Written::literal(text, None).value {
                Value::Whole(x) => Ok(x as f64),
                _ => Err(self.refuse_at(key, span, "a whole number")),
            },
            ValueType::Other => {
                let problem = format!("`{}` has no numbers between two", self.path);
                let other = Diagnostic::new(problem).key(join(&self.path, key));
                Err(other.hint("list what it may be: `values = [...]`").at(self.source, span))
            }
        }
    }

    /// Refuses keys beside some that belong together.
    pub(super) fn only(&self, allowed: &[&str]) -> Result<()> {
        let Some((key, field)) =
            self.fields.iter().find(|(key, _)| !allowed.contains(&key.as_str()))
        else {
            return Ok(());
        };
        let with = allowed.join("`, `");
        let problem = format!("`{key}` does not go with the rest: it would be `{with}`");
        let stray = Diagnostic::new(problem).key(join(&self.path, key));
        Err(stray.at(self.source, field.key.clone()))
    }
}
