//! Setting and removing single keys in the text of a scene.
//!
//! The edit is made on the document, so that a key goes where keys of its table are; of the text that
//! comes out only the part that differs is taken over. Keys that are removed are cut out of the text
//! with their line, so that comments stay.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::DeValue;
use toml_edit::{ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

use super::dependent::{dependents, supplement};
use super::error::EditError;
use crate::error::quoted;
use crate::scene::Scene;
use crate::source::Source;

type Result<T, E = EditError> = std::result::Result<T, E>;

/// What errors call the text.
const NAME: &str = "scene";

/// Most names and indices of a path. Chosen below the 80 that the parser of TOML reads.
const DEEPEST: usize = 64;

/// The text with a key (`hair.curl.radius`, `region[1].length`) set to a value, written as in a scene
/// (`"9 mm"` with its quotes, `0.5`, `[1, 2]`). Tables that are missing are made; the number after the
/// last of a list makes another item. Keys that the key excludes are removed.
///
/// # Errors
/// [`EditError`], also where the scene would mean nothing then, or a number would be out of range; the
/// error has the position in the edited text.
pub fn set_key(text: &str, key: &str, value: &str) -> Result<String> {
    set_keys(text, &[(key, Some(value))])
}

/// The text without a key, or without a table or an item of a list and all that is in it.
///
/// # Errors
/// As [`set_key`].
pub fn unset_key(text: &str, key: &str) -> Result<String> {
    set_keys(text, &[(key, None)])
}

/// The text with several keys set, or removed where the value is `None`, in this order: for values that
/// mean something only together.
///
/// # Errors
/// As [`set_key`].
pub fn set_keys(text: &str, changes: &[(&str, Option<&str>)]) -> Result<String> {
    if let Some((key, _)) =
        changes.iter().find(|(key, _)| key.matches(['.', '[']).count() >= DEEPEST)
    {
        return Err(EditError::Deep { key: quoted(key), most: DEEPEST });
    }
    let before = Source::new(NAME, text);
    let mark = &text[..text.len() - before.text.len()];
    before.document()?;
    let scene = Scene::parse(NAME, before.text.as_str(), Path::new("")).ok();
    let mut now = before.text.clone();
    let mut touched: Vec<String> = Vec::new();
    for (key, value) in changes {
        let word = value.map(|value| value.trim().trim_matches(['"', '\'']));
        let mut gone = dependents(key, word, |key| written(&now, key));
        gone.retain(|other| {
            !changes.iter().any(|(key, value)| key == other && value.is_some())
                && is_there(&now, other)
        });
        for other in &gone {
            now = removed(&now, other)?;
        }
        let given = |other: &&(&str, String)| !changes.iter().any(|(key, _)| *key == other.0);
        let other = scene.as_ref().filter(|_| value.is_some());
        if let Some((other, value)) = other
            .zip(word)
            .and_then(|(scene, word)| supplement(key, word, scene, &gone, |key| written(&now, key)))
            .as_ref()
            .filter(given)
        {
            now = inserted(&now, other, value)?;
            touched.push((*other).to_owned());
        }
        now = match value {
            Some(value) => inserted(&now, key, value)?,
            None => removed(&now, key)?,
        };
        touched.extend(gone);
        touched.push((*key).to_owned());
    }
    check(&before.text, scene.as_ref(), &now, &touched)?;
    Ok(format!("{mark}{now}"))
}

/// Refuses a text that means nothing, and one in which something else has changed.
fn check(before: &str, scene: Option<&Scene>, now: &str, touched: &[String]) -> Result<()> {
    let after = Scene::parse(NAME, now, Path::new(""))?;
    if scene.is_some_and(|scene| scene.hairstyle_spec().is_ok()) {
        after.hairstyle_spec()?;
    }
    let rest = |text: &str| {
        let mut table = text.parse::<toml::Table>().ok()?;
        // From the last: items of lists have numbers.
        touched.iter().rev().for_each(|key| without(&mut table, key));
        Some(without_empty(table))
    };
    if rest(before) == rest(now) { Ok(()) } else { Err(EditError::Scattered) }
}

fn without(table: &mut toml::Table, path: &str) {
    // A list that lost or got an item is compared by the scene that it makes.
    let (first, rest) = path.split_once('.').unwrap_or((path, ""));
    match first.split_once('[') {
        Some((list, _)) => drop(table.remove(list)),
        None if rest.is_empty() => drop(table.remove(first)),
        None => {
            if let Some(inner) = table.get_mut(first).and_then(toml::Value::as_table_mut) {
                without(inner, rest);
            }
        }
    }
}

/// A table without the tables in it that say nothing.
fn without_empty(table: toml::Table) -> toml::Table {
    let kept = |(key, value)| match value {
        toml::Value::Table(inner) => {
            let inner = without_empty(inner);
            (!inner.is_empty()).then_some((key, toml::Value::Table(inner)))
        }
        value => Some((key, value)),
    };
    table.into_iter().filter_map(kept).collect()
}

fn source(text: &str) -> Source {
    Source { name: NAME.into(), text: text.to_owned() }
}

fn is_there(text: &str, key: &str) -> bool {
    source(text).find(key).is_some()
}

/// The value of a key without its quotes, if it is written.
fn written(text: &str, key: &str) -> Option<String> {
    let source = source(text);
    let (span, _) = source.find(key)?;
    Some(source.slice(span).trim_matches(['"', '\'']).to_owned())
}

/// The text with a key and its value.
fn inserted(text: &str, key: &str, value: &str) -> Result<String> {
    let value: Value = value.trim().parse().map_err(|e: toml_edit::TomlError| {
        EditError::Value { key: key.to_owned(), problem: e.message().to_owned() }
    })?;
    edited(text, |document| {
        descend(document.as_table_mut(), false, key, value)
            .ok_or_else(|| EditError::NoPlace { key: key.to_owned() })
    })
}

/// Edits a text as a document, and takes over nothing but what differs.
fn edited(text: &str, edit: impl FnOnce(&mut DocumentMut) -> Result<()>) -> Result<String> {
    let unfinished = !text.is_empty() && !text.ends_with('\n');
    let whole = if unfinished { format!("{text}\n") } else { text.to_owned() };
    let plain = whole.replace("\r\n", "\n");
    let mut document: DocumentMut = plain.parse().map_err(|_| EditError::Scattered)?;
    if document.to_string() != plain {
        return Err(EditError::Scattered);
    }
    edit(&mut document)?;
    let after = document.to_string();
    let (start, end) = difference(&plain, &after);
    let place = place_of(&whole, &plain, start)..place_of(&whole, &plain, plain.len() - end);
    let line_end = if whole.contains("\r\n") { "\r\n" } else { "\n" };
    let new = after[start..after.len() - end].replace('\n', line_end);
    let mut text = format!("{}{new}{}", &whole[..place.start], &whole[place.end..]);
    if unfinished && text.ends_with('\n') {
        text.truncate(text.trim_end_matches(['\r', '\n']).len());
    }
    Ok(text)
}

/// How many bytes two texts begin with, and then end with, in common.
fn difference(a: &str, b: &str) -> (usize, usize) {
    let same = |(x, y): &(u8, u8)| x == y;
    let mut start = a.bytes().zip(b.bytes()).take_while(same).count();
    while !a.is_char_boundary(start) {
        start -= 1;
    }
    let (a, b) = (&a[start..], &b[start..]);
    let mut end = a.bytes().rev().zip(b.bytes().rev()).take_while(same).count();
    while !a.is_char_boundary(a.len() - end) {
        end -= 1;
    }
    (start, end)
}

/// Where a byte of a text with plain line ends is in the text itself.
fn place_of(text: &str, plain: &str, byte: usize) -> usize {
    if text.len() == plain.len() {
        return byte;
    }
    let ends = plain[..byte].matches('\n').count();
    let with_return = text.match_indices('\n').take(ends);
    byte + with_return.filter(|(i, _)| text[..*i].ends_with('\r')).count()
}

/// Sets a value in a table, which may be in brackets, or in one inside it.
fn descend(table: &mut dyn TableLike, bracketed: bool, path: &str, value: Value) -> Option<()> {
    let (first, rest) = path.split_once('.').unwrap_or((path, ""));
    let (name, index) = match first.split_once('[') {
        Some((name, index)) => (name, Some(index.strip_suffix(']')?.parse::<usize>().ok()?)),
        None => (first, None),
    };
    if name.is_empty() {
        return None;
    }
    match (index, rest) {
        (None, "") => return set(table, bracketed, name, value),
        (Some(_), "") => return None,
        _ => {}
    }
    if !table.contains_key(name) {
        let child = child(table, index.is_some(), rest.contains('.'));
        table.insert(name, child);
    }
    let item = table.get_mut(name)?;
    let bracketed = bracketed || item.is_value();
    let inner: &mut dyn TableLike = match (index, item) {
        (None, item) => item.as_table_like_mut()?,
        (Some(index), Item::ArrayOfTables(list)) => {
            if index == list.len() {
                list.push(spaced());
            }
            list.get_mut(index)?
        }
        (Some(index), Item::Value(Value::Array(list))) => {
            if index == list.len() {
                list.push(InlineTable::new());
            }
            list.get_mut(index)?.as_inline_table_mut()?
        }
        _ => return None,
    };
    descend(inner, bracketed, rest, value)
}

/// A table with an empty line before it.
fn spaced() -> Table {
    let mut table = Table::new();
    table.decor_mut().set_prefix("\n");
    table
}

/// A new table or list of tables for inside a table; `passing` is one that only holds another.
fn child(parent: &dyn TableLike, list: bool, passing: bool) -> Item {
    if parent.is_dotted() {
        let mut table = Table::new();
        table.set_dotted(true);
        return if list {
            Item::Value(Value::Array(Default::default()))
        } else {
            Item::Table(table)
        };
    }
    if list {
        return Item::ArrayOfTables(ArrayOfTables::new());
    }
    let mut table = spaced();
    table.set_implicit(passing);
    Item::Table(table)
}

/// Sets a value, with the white space and comments of the old one.
fn set(table: &mut dyn TableLike, bracketed: bool, name: &str, mut value: Value) -> Option<()> {
    match table.get_mut(name) {
        Some(Item::Value(old)) => {
            *value.decor_mut() = old.decor().clone();
            *old = value;
        }
        // Not over a table and all that is in it.
        Some(item) if !item.is_none() => return None,
        _ => {
            value.decor_mut().clear();
            // Space before the closing bracket stays there.
            let last = table.iter_mut().last().filter(|_| bracketed);
            if let Some((_, Item::Value(last))) = last
                && let Some(end) = last.decor().suffix().cloned()
            {
                value.decor_mut().set_suffix(end);
                last.decor_mut().set_suffix("");
            }
            table.insert(name, Item::Value(value));
        }
    }
    Some(())
}

/// The text without a key; as it is, if it has none.
fn removed(text: &str, key: &str) -> Result<String> {
    let source = source(text);
    let document = source.document()?;
    let Some(found) = Found::at(&DeValue::Table(document.get_ref().clone()), key, text) else {
        return Ok(text.to_owned());
    };
    if found.inline {
        return edited(text, |document| {
            take(document.as_table_mut(), key).ok_or_else(|| EditError::NoPlace { key: key.into() })
        });
    }
    let mut lines: Vec<Range<usize>> = found.entries.iter().map(|e| lines(text, e)).collect();
    lines.sort_by_key(|lines| lines.start);
    lines.dedup();
    let mut out = text.to_owned();
    for lines in lines.into_iter().rev() {
        out.replace_range(lines, "");
    }
    Ok(out)
}

/// The whole lines of a place in a text.
fn lines(text: &str, place: &Range<usize>) -> Range<usize> {
    let start = text[..place.start].rfind('\n').map_or(0, |i| i + 1);
    let end = text[place.end..].find('\n').map_or(text.len(), |i| place.end + i + 1);
    start..end
}

/// The text of a key.
struct Found {
    /// Keys with their values, and headers.
    entries: Vec<Range<usize>>,
    /// Whether it is inside a table or list in brackets.
    inline: bool,
}

impl Found {
    fn at(table: &DeValue<'_>, path: &str, text: &str) -> Option<Self> {
        let (first, rest) = path.split_once('.').unwrap_or((path, ""));
        let (name, index) = first.split_once('[').unwrap_or((first, ""));
        let (key, value) = table.as_table()?.get_key_value(name)?;
        let key = key.span();
        let is_bracketed = |value: &Spanned<DeValue<'_>>| {
            text[value.span().start..].starts_with(['{', '[']) && !is_header(value, text)
        };
        let listed = match index.strip_suffix(']') {
            Some(index) => Some(value.get_ref().get(index.parse::<usize>().ok()?)?),
            None => None,
        };
        let inside = is_bracketed(value) && !has_tables(value, text);
        let inner = listed.unwrap_or(value);
        if !rest.is_empty() {
            let found = Self::at(inner.get_ref(), rest, text)?;
            return Some(Self { inline: found.inline || inside, ..found });
        }
        let mut entries = Vec::new();
        collect((listed.is_none()).then_some(key), inner, text, &mut entries);
        Some(Self { entries, inline: inside && listed.is_some() })
    }
}

/// Whether a value is a table with a header.
fn is_header(value: &Spanned<DeValue<'_>>, text: &str) -> bool {
    value.get_ref().is_table() && text[value.span().start..].starts_with('[')
}

/// Whether a value is a list of tables with headers.
fn has_tables(value: &Spanned<DeValue<'_>>, text: &str) -> bool {
    value.get_ref().as_array().is_some_and(|list| list.iter().any(|item| is_header(item, text)))
}

/// Adds the places of all lines of a value.
fn collect(
    key: Option<Range<usize>>,
    value: &Spanned<DeValue<'_>>,
    text: &str,
    out: &mut Vec<Range<usize>>,
) {
    let bracketed = text[value.span().start..].starts_with('{');
    match value.get_ref() {
        DeValue::Table(table) if !bracketed => {
            if is_header(value, text) {
                out.push(value.span().start..value.span().start);
            }
            table.iter().for_each(|(key, value)| collect(Some(key.span()), value, text, out));
        }
        DeValue::Array(list) if has_tables(value, text) => {
            list.iter().for_each(|item| collect(None, item, text, out));
        }
        _ => {
            let own = value.span();
            out.push(key.map_or(own.start, |key| key.start)..own.end);
        }
    }
}

/// Takes a key out of a table in brackets.
fn take(table: &mut dyn TableLike, path: &str) -> Option<()> {
    let (first, rest) = path.split_once('.').unwrap_or((path, ""));
    let (name, index) = first.split_once('[').unwrap_or((first, ""));
    let index = match index.strip_suffix(']') {
        Some(index) => Some(index.parse::<usize>().ok()?),
        None => None,
    };
    match (index, rest) {
        (None, "") => {
            let gone = table.remove(name)?;
            let end = gone.as_value().and_then(|v| v.decor().suffix()).cloned();
            // Space before the closing bracket stays.
            if let (Some(end), Some((_, Item::Value(last)))) = (end, table.iter_mut().last())
                && last.decor().suffix().is_none_or(|s| s.as_str().is_none_or(str::is_empty))
            {
                last.decor_mut().set_suffix(end);
            }
            Some(())
        }
        (Some(index), "") => {
            let list = table.get_mut(name)?.as_array_mut()?;
            (index < list.len()).then(|| drop(list.remove(index)))
        }
        (None, rest) => take(table.get_mut(name)?.as_table_like_mut()?, rest),
        (Some(index), rest) => match table.get_mut(name)? {
            Item::ArrayOfTables(list) => take(list.get_mut(index)?, rest),
            item => take(item.as_array_mut()?.get_mut(index)?.as_inline_table_mut()?, rest),
        },
    }
}
