//! Inserting, replacing and removing steps in the text of a scene, with every other byte unchanged.
//!
//! The text is spliced at places that the TOML reader gives, never written anew: layout, line endings
//! and comments stay because nothing touches them. Comments directly above a step belong to it; those
//! with an empty line between stay where they are. What comes out is read again and has to say what was
//! meant, or nothing is changed.

use std::ops::Range;
use std::path::Path;

use frisure_hairstyle::styling::Operation;
use toml::de::DeTable;

use super::error::EditError;
use super::layout::{Inline, Layout, Tables};
use crate::error::SceneError;
use crate::operation::declaration;
use crate::scene::Scene;
use crate::source::Source;
use crate::write::write_step;

type Result<T, E = EditError> = std::result::Result<T, E>;

/// The text with steps added after all others.
///
/// # Errors
/// [`EditError`].
pub fn append(text: &str, steps: &[Operation]) -> Result<String> {
    insert(text, parse_steps("scene", text)?.len(), steps)
}

/// The text with steps added before the one with a number, from 0; the number of steps adds them after
/// all.
///
/// # Errors
/// [`EditError`].
pub fn insert(text: &str, at: usize, steps: &[Operation]) -> Result<String> {
    let before = parse_steps("scene", text)?;
    let count = before.len();
    if at > count {
        return Err(EditError::NoSuchStep { index: at, count });
    }
    let mut after = before;
    after.splice(at..at, steps.iter().cloned());
    if steps.is_empty() {
        return Ok(text.to_owned());
    }
    edited(text, &after, |text, layout| match layout {
        Layout::Tables(tables) => tables_inserted(text, &tables, at, steps),
        Layout::Inline(inline) => Ok(inline_inserted(text, &inline, at, steps)),
    })
}

/// The text with the step with a number, from 0, replaced.
///
/// # Errors
/// [`EditError`].
pub fn replace(text: &str, index: usize, step: &Operation) -> Result<String> {
    let mut after = parse_steps("scene", text)?;
    let count = after.len();
    *after.get_mut(index).ok_or(EditError::NoSuchStep { index, count })? = step.clone();
    let entry = entry(step)?;
    edited(text, &after, |text, layout| match layout {
        Layout::Tables(tables) => Ok(spliced(text, tables.steps[index].body.clone(), &entry)),
        Layout::Inline(inline) => {
            Ok(spliced(text, inline.steps[index].clone(), &format!("{{ {entry} }}")))
        }
    })
}

/// The text without the step with a number, from 0, and the comments that belong to it.
///
/// # Errors
/// [`EditError`].
pub fn remove(text: &str, index: usize) -> Result<String> {
    let mut after = parse_steps("scene", text)?;
    let count = after.len();
    if index >= count {
        return Err(EditError::NoSuchStep { index, count });
    }
    after.remove(index);
    edited(text, &after, |text, layout| match layout {
        Layout::Tables(tables) => table_removed(text, &tables, index),
        Layout::Inline(inline) => Ok(inline_removed(text, &inline, index)),
    })
}

/// Edits a text, and checks that it has the intended steps then, and otherwise all that it had.
fn edited(
    text: &str,
    steps: &[Operation],
    edit: impl FnOnce(&str, Layout) -> Result<String>,
) -> Result<String> {
    let source = Source::new("scene", text);
    let mark = &text[..text.len() - source.text.len()];
    let document = source.document()?;
    let layout = Layout::of(document.get_ref(), &source.text);
    let edited = edit(&source.text, layout)?;
    let kept = same_without_steps(&source.text, &edited);
    let meant = parse_steps("scene", &edited).is_ok_and(|found| found == steps);
    if kept && meant { Ok(format!("{mark}{edited}")) } else { Err(EditError::Scattered) }
}

/// Whether two texts have the same keys and values outside `step`.
fn same_without_steps(before: &str, after: &str) -> bool {
    let rest = |text: &str| {
        let mut table = text.parse::<toml::Table>().ok()?;
        table.remove("step");
        Some(table)
    };
    rest(before).is_some_and(|before| rest(after) == Some(before))
}

/// A step as an entry of its table.
fn entry(step: &Operation) -> Result<String> {
    write_step(step)?;
    Ok(format!("{} = {}", step.name(), declaration(step).write(step)))
}

fn spliced(text: &str, span: Range<usize>, with: &str) -> String {
    format!("{}{with}{}", &text[..span.start], &text[span.end..])
}

/// How lines of a text end.
fn line_end(text: &str) -> &'static str {
    if text.contains("\r\n") { "\r\n" } else { "\n" }
}

/// Whether a text ends with an empty line, or is empty.
fn ends_blank(text: &str) -> bool {
    let mut lines = text.rsplit('\n');
    let last = lines.next().unwrap_or("");
    last.trim().is_empty() && lines.next().is_none_or(|line| line.trim().is_empty())
}

fn tables_inserted(text: &str, tables: &Tables, at: usize, steps: &[Operation]) -> Result<String> {
    let place = match tables.steps.get(at) {
        Some(step) => tables.attached(text, step.header),
        None => tables.after_last(text).ok_or(EditError::Scattered)?,
    };
    let (before, after) = text.split_at(place);
    let written: std::result::Result<Vec<_>, _> = steps.iter().map(write_step).collect();
    let mut new = String::new();
    if !before.is_empty() && !before.ends_with('\n') {
        new.push('\n');
    }
    if !ends_blank(before) {
        new.push('\n');
    }
    new.push_str(&written?.join("\n"));
    if !after.is_empty() {
        new.push('\n');
    }
    Ok(format!("{before}{}{after}", new.replace('\n', line_end(text))))
}

fn table_removed(text: &str, tables: &Tables, index: usize) -> Result<String> {
    let step = &tables.steps[index];
    let end = tables.end_of(index).ok_or(EditError::Scattered)?;
    let (before, after) = (&text[..tables.attached(text, step.header)], &text[end..]);
    let after = after.split_once('\n').map_or("", |(_, rest)| rest);
    if !ends_blank(before) {
        return Ok(format!("{before}{after}"));
    }
    // One empty line is enough where there were two.
    let mut rest = after;
    while let Some((_, more)) = rest.split_once('\n').filter(|(line, _)| line.trim().is_empty()) {
        rest = more;
    }
    if rest.trim().is_empty() {
        let kept = before.trim_end();
        let end = if kept.is_empty() { "" } else { line_end(text) };
        return Ok(format!("{kept}{end}"));
    }
    Ok(format!("{before}{rest}"))
}

fn inline_inserted(text: &str, inline: &Inline, at: usize, steps: &[Operation]) -> String {
    let items: Vec<_> =
        steps.iter().map(|s| format!("{{ {} = {} }}", s.name(), declaration(s).write(s))).collect();
    let end = line_end(text);
    let Some(first) = inline.steps.first() else {
        let inside = inline.list.start + 1..inline.list.end - 1;
        return spliced(text, inside.start..inside.start, &items.join(", "));
    };
    // A list with its first item on a line of its own has every item on one.
    let (indent, is_long) = indent(text, first.start);
    let between = if is_long { format!(",{end}{indent}") } else { ", ".into() };
    let new = items.join(&between);
    if let Some(next) = inline.steps.get(at) {
        return spliced(text, next.start..next.start, &format!("{new}{between}"));
    }
    let last = inline.steps[inline.steps.len() - 1].end;
    let comma = inline.comma(text);
    let line = text[last..].find('\n').map_or(text.len(), |i| last + i);
    let line = line - usize::from(text[..line].ends_with('\r'));
    if !is_long || line >= inline.list.end {
        return spliced(text, last..last, &format!("{between}{new}"));
    }
    // A comment beside the last item stays beside it.
    let (own, new_comma) = if comma { ("", ",") } else { (",", "") };
    let rest = spliced(text, line..line, &format!("{end}{indent}{new}{new_comma}"));
    spliced(&rest, last..last, own)
}

/// The white space before a place on its line, and whether there is nothing else before it.
fn indent(text: &str, place: usize) -> (&str, bool) {
    let start = text[..place].rfind('\n').map_or(0, |i| i + 1);
    let before = &text[start..place];
    (before, before.trim().is_empty())
}

fn inline_removed(text: &str, inline: &Inline, index: usize) -> String {
    let item = inline.steps[index].clone();
    let next = inline.steps.get(index + 1);
    let (space, is_long) = indent(text, item.start);
    let line = text[item.end..].find('\n').map_or(text.len(), |i| item.end + i + 1);
    let stop = next.map_or(inline.list.end - 1, |next| next.start);
    if is_long && line <= stop {
        return spliced(text, item.start - space.len()..line, "");
    }
    let gap = match (next, index.checked_sub(1)) {
        (Some(next), _) => item.start..next.start,
        (None, Some(previous)) => inline.steps[previous].end..item.end,
        (None, None) => inline.list.start + 1..inline.list.end - 1,
    };
    spliced(text, gap, "")
}

impl Layout {
    fn of(document: &DeTable<'_>, text: &str) -> Self {
        match Inline::of(document, text) {
            Some(inline) => Self::Inline(inline),
            None => Self::Tables(Tables::of(document, text)),
        }
    }
}

/// The operations of the text of a scene.
fn parse_steps(name: &str, text: &str) -> Result<Vec<Operation>, SceneError> {
    Scene::parse(name, text, Path::new("")).map(|scene| scene.steps)
}
