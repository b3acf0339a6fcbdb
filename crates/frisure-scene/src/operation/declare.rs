//! Declarations of operations: reading, writing, hints and schema follow from them.

use frisure_hairstyle::Range;
use frisure_hairstyle::styling::Operation;
use schemars::{Schema, json_schema};
use toml::Value;

use super::selection::Where;
use crate::declaration::{add_range, in_prose};
use crate::error::ValueError;
use crate::error::{Diagnostic, SceneError};
use crate::exclusive::check_given;
use crate::kind::{Kind, ToText, table_text};
use crate::source::Source;

/// How an operation is written in a scene.
pub(crate) struct Declaration {
    pub(crate) name: &'static str,
    /// What it does.
    pub(crate) doc: String,
    /// A step with it.
    pub(crate) example: &'static str,
    /// The key that a value means which is written in place of the table; none if the operation is written
    /// as that value.
    pub(crate) main: Option<&'static str>,
    /// Other names for it.
    pub(crate) synonyms: &'static [&'static str],
    /// How a program offers it for hair that is selected.
    pub(crate) buttons: &'static [Button],
    /// Keys that exclude each other.
    pub(crate) groups: &'static [Group],
    pub(crate) keys: Vec<StepKey>,
    /// The operation with its default values.
    pub(crate) start: fn() -> Operation,
}

/// A button for an operation on selected hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Button {
    /// Its label, such as "In braids".
    pub label: &'static str,
    /// The step, such as `braid = { width = "2 cm", pitch = "4 cm" }`.
    pub step: &'static str,
}

/// Keys of which at most one is written.
pub(crate) struct Group {
    pub(crate) keys: &'static [&'static str],
    /// What is wrong if none of them is written, after the name of the operation, and what to try; none if
    /// none is needed.
    pub(crate) needed: Option<(&'static str, &'static str)>,
}

/// A key of an operation.
pub(crate) struct StepKey {
    pub(crate) name: &'static str,
    pub(crate) schema: Schema,
    /// An example, if the key has to be written.
    pub(crate) needed: Option<&'static str>,
    pub(crate) read: fn(&mut Operation, &Value) -> Result<(), ValueError>,
    /// The value as a scene writes it; none if the operation does not have the key.
    pub(crate) write: fn(&Operation) -> Option<String>,
}

/// The text of a doc comment, with the range of the value in place of `{}`.
pub(super) fn doc(lines: &[&str], range: Option<Range>) -> String {
    let text = lines.iter().map(|line| line.trim()).collect::<Vec<_>>().join("\n");
    match range {
        Some(range) => text.replace("{}", &in_prose(range.allowed)),
        None => text,
    }
}

/// The schema of a key with its description and range.
pub(crate) fn schema_of<K: Kind>(doc: String, range: Option<Range>) -> Schema {
    let mut schema = K::schema();
    if let Some(range) = range.filter(|_| schema.get("type").is_some()) {
        add_range(&mut schema, range);
    }
    schema.insert("description".into(), doc.into());
    schema
}

/// The key that selects wisps.
pub(super) fn where_key() -> StepKey {
    StepKey {
        name: "where",
        schema: schema_of::<Where>("Which wisps. Default all.".into(), None),
        needed: None,
        read: |operation, value| {
            let selection = Where::read(value)?;
            if let Some(selected) = operation.selection_mut() {
                *selected = selection;
            }
            Ok(())
        },
        write: |operation| {
            let selected = operation.selection()?;
            (*selected != frisure_hairstyle::styling::Selection::Everything)
                .then(|| Where::text(selected))
        },
    }
}

/// The keys of an operation: `name: Kind` for a key with the name of the field that it sets, then in this
/// order, each where it applies, `in RANGE`, `needed "example"`, `unless |operation| REFUSAL`,
/// `set |operation, value| STATEMENT` and `get |operation| VALUE`.
macro_rules! keys {
    ($Type:ident: $(
        $(#[doc = $doc:literal])+
        $key:ident: $Kind:ty
        $(, in $range:expr)?
        $(, needed $example:literal)?
        $(, unless |$it:ident| $error:expr)?
        $(, set |$to:ident, $value:ident| $set:expr, get |$of:ident| $get:expr)?;
    )*) => {
        vec![$({
            #[allow(unused_mut, unused_assignments)]
            let mut range: Option<Range> = None;
            $(range = Some($range);)?
            #[allow(unused_mut, unused_assignments)]
            let mut needed: Option<&'static str> = None;
            $(needed = Some($example);)?
            StepKey {
                name: stringify!($key),
                schema: schema_of::<$Kind>(doc(&[$($doc),+], range), range),
                needed,
                read: |operation, written| {
                    let Operation::$Type(operation) = operation else { return Ok(()) };
                    let value = <$Kind as Kind>::read(written)?;
                    $(
                        let $it = &*operation;
                        if let Some(error) = $error {
                            return Err(error);
                        }
                    )?
                    keys!(@set operation, value, $key $(, $to, $value, $set)?);
                    Ok(())
                },
                write: |operation| {
                    let Operation::$Type(operation) = operation else { return None };
                    #[allow(unused_mut, unused_assignments)]
                    let mut always = false;
                    $(always = !$example.is_empty();)?
                    keys!(@get $Type, $Kind, operation, always, $key $(, $of, $get)?)
                },
            }
        }),*]
    };
    (@set $operation:ident, $value:ident, $key:ident) => { $operation.$key = $value };
    (@set $operation:ident, $value:ident, $key:ident, $to:ident, $name:ident, $set:expr) => {
        { let ($to, $name) = ($operation, $value); $set; }
    };
    (@get $Type:ident, $Kind:ty, $operation:ident, $always:ident, $key:ident) => {{
        let text = <$Kind as ToText>::text(&$operation.$key);
        ($always || text != <$Kind as ToText>::text(&$Type::default().$key)).then_some(text)
    }};
    (@get $Type:ident, $Kind:ty, $operation:ident, $always:ident, $key:ident, $of:ident, $get:expr) => {{
        let $of = $operation;
        let _ = $always;
        $get.map(|value| <$Kind as ToText>::text(&value))
    }};
}

/// Declares how operations are written: `name: Type { fields of [`Declaration`] } keys { as in `keys!` }`.
macro_rules! operations {
    ($(
        $(#[doc = $doc:literal])+
        $name:ident: $Type:ident { $($field:ident: $value:expr),* $(,)? } keys { $($keys:tt)* }
    )*) => {
        /// All operations.
        pub(crate) static ALL: LazyLock<Vec<Declaration>> = LazyLock::new(|| vec![$({
            let mut declared = Declaration {
                name: stringify!($name),
                doc: doc(&[$($doc),+], None),
                keys: keys!($Type: $($keys)*),
                $($field: $value,)*
                ..Declaration::new(|| $Type::default().into())
            };
            declared.finish();
            declared
        }),*]);

        /// How an operation is written.
        pub(crate) fn declaration(operation: &Operation) -> &'static Declaration {
            // An operation that is not declared fails to compile here.
            let name = match operation {
                $(Operation::$Type(_) => stringify!($name),)*
            };
            find(name).expect("each operation is declared above")
        }
    };
}

pub(super) use {keys, operations};

impl Declaration {
    /// A declaration of an operation without keys.
    pub(super) fn new(start: fn() -> Operation) -> Self {
        Self {
            name: "",
            doc: String::new(),
            example: "",
            main: Some("where"),
            synonyms: &[],
            buttons: &[],
            groups: &[],
            keys: Vec::new(),
            start,
        }
    }

    /// Adds what every operation has that selects wisps.
    pub(super) fn finish(&mut self) {
        if (self.start)().selection().is_some() {
            self.keys.push(where_key());
        }
    }

    /// The schema of the operation's key.
    pub(crate) fn schema(&self) -> Schema {
        if self.main.is_none() {
            return self.keys[0].schema.clone();
        }
        let keys = self.keys.iter().map(|key| (key.name, key.schema.as_value()));
        json_schema!({
            "type": "object", "additionalProperties": false, "description": self.doc,
            "properties": keys.collect::<std::collections::BTreeMap<_, _>>(),
        })
    }

    /// Reads the operation from its value at `path`.
    pub(crate) fn read(
        &self,
        value: &Value,
        path: &str,
        source: &Source,
    ) -> Result<Operation, SceneError> {
        let mut operation = (self.start)();
        let refuse = |error: ValueError, path: &str| error.at_path(path, source);
        if self.main.is_none() {
            let read = (self.keys[0].read)(&mut operation, value);
            return read.map(|()| operation).map_err(|e| refuse(e, path));
        }
        let empty = toml::Table::new();
        let table = value.as_table().unwrap_or(&empty);
        for group in self.groups {
            let given = group.keys.iter().filter(|key| table.contains_key(**key));
            let given: Vec<_> = given.map(|key| vec![join(path, key)]).collect();
            check_given(source, &given)?;
            if let Some((problem, hint)) = group.needed
                && !group.keys.iter().any(|key| table.contains_key(*key))
            {
                let diagnostic =
                    Diagnostic::new(format!("`{path}` {problem}")).key(path).hint(hint);
                return Err(diagnostic.at(source, source.locate(path)));
            }
        }
        for key in &self.keys {
            match (table.get(key.name), key.needed) {
                (Some(value), _) => (key.read)(&mut operation, value)
                    .map_err(|e| refuse(e, &join(path, key.name)))?,
                (None, Some(example)) => {
                    return Err(missing(key.name, example, path, source));
                }
                (None, None) => {}
            }
        }
        Ok(operation)
    }

    /// The value of the operation's key, on one line.
    pub(crate) fn write(&self, operation: &Operation) -> String {
        let written = self.keys.iter().filter_map(|key| Some((key.name, (key.write)(operation)?)));
        if self.main.is_none() {
            return written.map(|(_, text)| text).collect();
        }
        table_text(written)
    }
}

/// The path of a key in a table.
pub(crate) fn join(path: &str, key: &str) -> String {
    if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") }
}

/// The error about an operation without a key that it needs.
fn missing(key: &str, example: &str, here: &str, source: &Source) -> SceneError {
    let diagnostic = Diagnostic::new(format!("`{here}` needs `{key}`")).key(here);
    diagnostic.hint(format!("write for example `{example}`")).at(source, source.locate(here))
}
