//! The values of a scene by the paths of their keys.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Value;

use crate::choice::{Choice, OneOf};
use crate::declaration::{Number, without_index};
use crate::error::{Diagnostic, Result, SceneError};
use crate::exclusive::{GROUPS, check_given};
use crate::keys::KEYS;
use crate::keywords::Keyword;
use crate::kind::Kind;
use crate::scene::Scene;
use crate::source::Source;

/// A scene as TOML, with all of its numbers read.
pub(crate) struct Document<'a> {
    pub(crate) source: &'a Source,
    table: toml::Table,
    numbers: BTreeMap<String, f64>,
}

impl<'a> Document<'a> {
    /// Reads the TOML of a text, without numbers.
    ///
    /// # Errors
    /// [`SceneError`], if it is no TOML.
    pub(crate) fn parse(source: &'a Source) -> Result<Self> {
        let table = source.text.parse().map_err(|e| source.syntax(&e))?;
        Ok(Self { source, table, numbers: BTreeMap::new() })
    }

    /// Reads the TOML and every number of a scene.
    ///
    /// # Errors
    /// [`SceneError`] for a value that is no number of its kind, or out of a range that does not depend on other keys.
    pub(crate) fn read(source: &'a Source) -> Result<Self> {
        let mut document = Self::parse(source)?;
        for declared in KEYS.iter() {
            let Some(number) = declared.number() else { continue };
            for path in document.instances(declared.path) {
                if let Some(value) = document.value(&path) {
                    let value = document.read_number(&path, value, number)?;
                    document.numbers.insert(path, value);
                }
            }
        }
        Ok(document)
    }

    fn read_number(&self, path: &str, value: &Value, number: &Number) -> Result<f64> {
        let value = (number.read)(value).map_err(|error| error.at_path(path, self.source))?;
        match number.range {
            Some((range, true)) if !(range.min..=range.max).contains(&value) => {
                Err(self.outside(path, range.allowed))
            }
            _ => Ok(value),
        }
    }

    /// The paths of a key in the items of a list, or its own path.
    fn instances(&self, path: &str) -> Vec<String> {
        match path.split_once("[]") {
            None => vec![path.to_owned()],
            Some((list, rest)) => {
                (0..self.count_items(list)).map(|i| format!("{list}[{i}]{rest}")).collect()
            }
        }
    }

    /// Refuses keys that exclude each other.
    pub(crate) fn check_exclusive(&self) -> Result<()> {
        for group in GROUPS {
            let list = group[0][0].split_once("[]").map(|(list, _)| list);
            for item in 0..list.map_or(1, |list| self.count_items(list)) {
                let given = |keys: &&[&str]| -> Vec<String> {
                    let paths = keys.iter().map(|key| key.replace("[]", &format!("[{item}]")));
                    paths.filter(|path| self.has(path)).collect()
                };
                let given = group.iter().map(given).filter(|paths| !paths.is_empty());
                check_given(self.source, &given.collect::<Vec<_>>())?;
            }
        }
        Ok(())
    }

    /// Sets the fields of a scene that are numbers to those that are given.
    pub(crate) fn set_fields(&self, scene: &mut Scene) {
        for declared in KEYS.iter() {
            if let (Some(number), Some(value)) = (declared.number(), self.number(declared.path)) {
                number.access.set(scene, value);
            }
        }
    }

    /// The TOML value at a path such as `light.lamp[0].size`.
    pub(crate) fn value(&self, path: &str) -> Option<&Value> {
        let mut table = &self.table;
        let (tables, name) = path.rsplit_once('.').unwrap_or(("", path));
        for part in tables.split('.').filter(|part| !part.is_empty()) {
            let (name, index) = part.split_once('[').unwrap_or((part, ""));
            let value = table.get(name)?;
            table = match index.strip_suffix(']') {
                Some(index) => value.get(index.parse::<usize>().ok()?)?.as_table()?,
                None => value.as_table()?,
            };
        }
        table.get(name)
    }

    /// Whether a key is given; a list of tables without items is not.
    pub(crate) fn has(&self, path: &str) -> bool {
        self.value(path).is_some_and(|value| value.as_array().is_none_or(|list| !list.is_empty()))
    }

    /// The number of items of a list of tables.
    pub(crate) fn count_items(&self, path: &str) -> usize {
        self.value(path).and_then(Value::as_array).map_or(0, Vec::len)
    }

    /// Refuses a list of tables with more items than `most`, at the first that is too many.
    pub(crate) fn check_items(
        &self,
        path: &str,
        most: usize,
        items: &str,
        hint: &str,
    ) -> Result<()> {
        let count = self.count_items(path);
        if count <= most {
            return Ok(());
        }
        let problem = format!("{count} {items}; there are at most {most}");
        Err(self.error(&format!("{path}[{most}]"), problem, hint))
    }

    /// The number at a path, if it is given (SI units).
    pub(crate) fn number(&self, path: &str) -> Option<f64> {
        let declared = || {
            let general = without_index(path).0;
            KEYS.iter().any(|declared| declared.path == general)
        };
        debug_assert!(declared(), "`{path}` is not declared");
        self.numbers.get(path).copied()
    }

    /// The value of a kind at a path, if it is given.
    ///
    /// # Errors
    /// [`SceneError`], if the value is of another kind.
    pub(crate) fn get<K: Kind>(&self, path: &str) -> Result<Option<K::Value>> {
        let Some(value) = self.value(path) else { return Ok(None) };
        K::read(value).map(Some).map_err(|error| error.at_path(path, self.source))
    }

    /// The value of a kind at a path, or a default.
    ///
    /// # Errors
    /// [`SceneError`], if the value is of another kind.
    pub(crate) fn get_or<K: Kind>(&self, path: &str, default: K::Value) -> Result<K::Value> {
        Ok(self.get::<K>(path)?.unwrap_or(default))
    }

    /// The value that a keyword at a path stands for, or a default.
    ///
    /// # Errors
    /// [`SceneError`], if the value is no keyword of the set.
    pub(crate) fn keyword<T>(&self, path: &str, default: T) -> Result<T>
    where
        Keyword<T>: Choice,
    {
        Ok(self.get_or::<OneOf<Keyword<T>>>(path, Keyword(default))?.0)
    }

    /// The first of some keys in the text that is given.
    pub(crate) fn first<'p>(&self, paths: &[&'p str]) -> Option<&'p str> {
        let given = paths.iter().filter(|path| self.value(path).is_some()).copied();
        given.min_by_key(|path| self.span(path).start)
    }

    pub(crate) fn span(&self, path: &str) -> Range<usize> {
        self.source.locate(path)
    }

    /// The error about a value that is not allowed.
    pub(crate) fn outside(&self, path: &str, allowed: &str) -> SceneError {
        let span = self.span(path);
        let value = self.source.slice(span.clone());
        Diagnostic::outside(allowed).key(path).value(value).at(self.source, span)
    }

    /// The error about a key, with a hint that may be empty.
    pub(crate) fn error(
        &self,
        path: &str,
        problem: impl Into<String>,
        hint: impl Into<String>,
    ) -> SceneError {
        Diagnostic::new(problem).key(path).hint(hint).at(self.source, self.span(path))
    }

    /// The error about a key that needs another key beside it.
    pub(crate) fn missing(&self, given: &str, other: &str) -> SceneError {
        self.error(given, format!("`{given}` needs `{other}` beside it"), "")
    }
}
