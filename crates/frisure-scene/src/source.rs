//! The text of a scene, and the positions of its keys and values.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::error::{Diagnostic, SceneError, ValueError};

/// Most commas in a text. Chosen: two polygons of the most corners are drawn with 400 000, and so many items are built in half a second.
const MAX_COMMAS: usize = 500_000;

/// The text of a scene with its name, for errors with positions.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Source {
    pub(crate) name: String,
    pub(crate) text: String,
}

impl Source {
    /// A text with its name, without the byte order mark that some editors begin it with; TOML has none.
    pub(crate) fn new(name: &str, text: impl Into<String>) -> Self {
        let text = text.into();
        let text = text.strip_prefix('\u{feff}').map(str::to_owned).unwrap_or(text);
        Self { name: name.to_owned(), text }
    }

    /// The document, with the place of each key and value.
    pub(crate) fn document(&self) -> Result<Spanned<DeTable<'_>>, SceneError> {
        self.check_commas()?;
        DeTable::parse(&self.text).map_err(|e| self.syntax(&e))
    }

    /// Refuses a text with so many items in lists that it would take long to build them, only to refuse the list.
    fn check_commas(&self) -> Result<(), SceneError> {
        // Bytes: a comma is never a part of another letter.
        let mut commas = self.text.bytes().enumerate().filter(|(_, byte)| *byte == b',');
        let Some((byte, _)) = commas.nth(MAX_COMMAS) else { return Ok(()) };
        let problem = format!("more than {MAX_COMMAS} commas: no list of a scene is so long");
        let hint = "leave out what is listed too often";
        Err(Diagnostic::new(problem).hint(hint).at(self, byte..byte + 1))
    }

    /// An error of the TOML reader; `key` is unknown then.
    pub(crate) fn syntax(&self, error: &toml::de::Error) -> SceneError {
        let span = error.span().unwrap_or(0..0);
        if let Some(allowed) = whole_numbers(error.message()) {
            let (key, value) = (self.path_at(&span), self.slice(span.clone()).to_owned());
            let hint = "write a decimal point if it need not be whole";
            return Diagnostic::outside(allowed).key(key).value(value).hint(hint).at(self, span);
        }
        let mut message = error.message().to_owned();
        // The reader puts what it expected on lines of their own.
        if let Some((first, rest)) = message.clone().split_once('\n') {
            message = format!("{first} ({})", rest.replace('\n', ", "));
        }
        let hint = self.after_a_header(span.start).unwrap_or_default();
        Diagnostic::new(message).hint(hint).at(self, span)
    }

    /// A hint about text behind the header of a table.
    fn after_a_header(&self, byte: usize) -> Option<String> {
        let before = self.text.get(..byte)?;
        let header = before[before.rfind('\n').map_or(0, |i| i + 1)..].trim();
        let is_header = header.starts_with('[') && header.ends_with(']');
        is_header.then(|| format!("what follows `{header}` begins on a line of its own"))
    }

    /// Line and column of a byte, both from 1; columns count characters.
    pub(crate) fn position(&self, byte: usize) -> (usize, usize) {
        let mut byte = byte.min(self.text.len());
        while !self.text.is_char_boundary(byte) {
            byte -= 1;
        }
        let before = &self.text[..byte];
        let start = before.rfind('\n').map_or(0, |i| i + 1);
        (before.matches('\n').count() + 1, before[start..].chars().count() + 1)
    }

    /// The text of a span.
    pub(crate) fn slice(&self, span: Range<usize>) -> &str {
        self.text.get(span).unwrap_or("")
    }

    /// The span of the value at a path such as `hair.curl.radius` or `region[1].length`, or of the
    /// nearest thing around it that is written down; the empty span at the start if nothing is.
    pub(crate) fn locate(&self, path: &str) -> Range<usize> {
        self.follow(path).last.map_or(0..0, |found| found.value)
    }

    /// The same of the key, where it has one.
    pub(crate) fn locate_key(&self, path: &str) -> Range<usize> {
        self.follow(path).last.map_or(0..0, |found| found.key)
    }

    /// The span of the value at a path, if it is written, and whether it is a single value: no
    /// table and no list.
    pub(crate) fn find(&self, path: &str) -> Option<(Range<usize>, bool)> {
        let followed = self.follow(path);
        followed.last.filter(|_| followed.whole).map(|found| (found.value, found.single))
    }

    /// Goes along a path as far as it is written.
    fn follow(&self, path: &str) -> Followed {
        let mut followed = Followed { last: None, whole: false };
        let Ok(document) = self.document() else { return followed };
        let mut table = document.get_ref();
        let mut steps = path.split('.').peekable();
        while let Some(step) = steps.next() {
            let (name, indices) = step.split_once('[').unwrap_or((step, ""));
            let Some((key, mut value)) = table.get_key_value(name) else { return followed };
            let key = key.span();
            followed.last = Some(Found::new(key.clone(), value));
            for index in indices.split(['[', ']']).filter_map(|i| i.parse::<usize>().ok()) {
                let Some(item) = value.get_ref().get(index) else { return followed };
                value = item;
                followed.last = Some(Found::new(key.clone(), value));
            }
            match value.get_ref() {
                DeValue::Table(inner) => table = inner,
                _ if steps.peek().is_some() => return followed,
                _ => {}
            }
        }
        followed.whole = true;
        followed
    }

    /// The path of the value with exactly this span.
    pub(crate) fn path_at(&self, span: &Range<usize>) -> String {
        let mut path = String::new();
        if let Ok(document) = self.document() {
            find_in_table(document.get_ref(), span, &mut path);
        }
        path
    }
}

/// The range of whole numbers, if that is what the TOML reader refuses: it names the types that it tried.
fn whole_numbers(message: &str) -> Option<&'static str> {
    let refused = [
        "as i128",
        "as u128",
        "value was too large",
        "value was too small",
        "too large to fit",
        "too small to fit",
    ];
    refused
        .iter()
        .any(|part| message.contains(part))
        .then_some("within 2^63 of 0, as every whole number")
}

/// How far a path is written.
struct Followed {
    last: Option<Found>,
    whole: bool,
}

/// The spans of a value and its key.
struct Found {
    key: Range<usize>,
    value: Range<usize>,
    single: bool,
}

impl Found {
    fn new(key: Range<usize>, value: &Spanned<DeValue<'_>>) -> Self {
        let single = !value.get_ref().is_table() && !value.get_ref().is_array();
        Self { key, value: value.span(), single }
    }
}

fn find_in_table(table: &DeTable<'_>, span: &Range<usize>, path: &mut String) -> bool {
    table.iter().any(|(key, value)| {
        let length = path.len();
        if !path.is_empty() {
            path.push('.');
        }
        path.push_str(key.get_ref());
        let found = find(value, span, path);
        if !found {
            path.truncate(length);
        }
        found
    })
}

fn find(value: &Spanned<DeValue<'_>>, span: &Range<usize>, path: &mut String) -> bool {
    let here = value.span() == *span;
    match value.get_ref() {
        DeValue::Table(table) => find_in_table(table, span, path) || here,
        DeValue::Array(array) => {
            let length = path.len();
            array.iter().enumerate().any(|(i, item)| {
                path.push_str(&format!("[{i}]"));
                let found = find(item, span, path);
                if !found {
                    path.truncate(length);
                }
                found
            }) || here
        }
        _ => here,
    }
}

impl Diagnostic {
    /// The error about a span of a text.
    pub(crate) fn at(self, source: &Source, span: Range<usize>) -> SceneError {
        let (line, column) = source.position(span.start);
        let (file, text) = (source.name.clone(), source.text.clone());
        SceneError::Invalid(Box::new(Self { file, text, line, column, span, ..self.shortened() }))
    }
}

impl ValueError {
    /// The error about the value at a path such as `step[1].cut.below`.
    pub(crate) fn at_path(self, path: &str, source: &Source) -> SceneError {
        let key = format!("{path}{}", self.inside);
        let span = if self.in_key { source.locate_key(&key) } else { source.locate(&key) };
        self.at(key, source, span)
    }

    /// The error about the value of a key at a position.
    pub(crate) fn at(self, key: String, source: &Source, span: Range<usize>) -> SceneError {
        let Self { allowed, hint, problem, value, .. } = self;
        let value = value.map_or_else(|| source.slice(span.clone()).to_owned(), String::from);
        let diagnostic = Diagnostic { problem, ..Diagnostic::outside(allowed) };
        diagnostic.hint(hint).key(key).value(value).at(source, span)
    }
}
