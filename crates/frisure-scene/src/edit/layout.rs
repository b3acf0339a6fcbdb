//! Positions of the steps of a scene in its text.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// How the steps are written.
pub(super) enum Layout {
    /// As tables `[[step]]`; also where there are none.
    Tables(Tables),
    /// As a list `step = [ … ]`.
    Inline(Inline),
}

/// Steps as tables.
pub(super) struct Tables {
    /// In their order, which is that of the text.
    pub(super) steps: Vec<StepTable>,
    /// Where headers of any tables begin, in the order of the text.
    headers: Vec<usize>,
    /// Where values end, in the order of the text.
    ends: Vec<usize>,
}

/// One `[[step]]`.
pub(super) struct StepTable {
    /// Where its header begins.
    pub(super) header: usize,
    /// What is in it, from the first key to the last value.
    pub(super) body: Range<usize>,
}

/// Steps as a list.
pub(super) struct Inline {
    /// The list with its brackets.
    pub(super) list: Range<usize>,
    /// Its items.
    pub(super) steps: Vec<Range<usize>>,
}

/// Whether a value is a table with a header.
fn has_header(value: &Spanned<DeValue<'_>>, text: &str) -> bool {
    value.get_ref().is_table() && text[value.span().start..].starts_with('[')
}

impl Tables {
    pub(super) fn of(document: &DeTable<'_>, text: &str) -> Self {
        let items = document.get("step").and_then(|step| step.get_ref().as_array());
        let table = |step: &Spanned<DeValue<'_>>| StepTable {
            header: step.span().start,
            body: step.get_ref().as_table().and_then(body).unwrap_or(step.span()),
        };
        let steps = items.into_iter().flat_map(|steps| steps.iter()).map(table).collect();
        let mut found = Self { steps, headers: Vec::new(), ends: Vec::new() };
        found.walk(document, text);
        found.headers.sort_unstable();
        found.ends.sort_unstable();
        found
    }

    fn walk(&mut self, table: &DeTable<'_>, text: &str) {
        table.values().for_each(|value| self.walk_value(value, text));
    }

    fn walk_value(&mut self, value: &Spanned<DeValue<'_>>, text: &str) {
        if has_header(value, text) {
            self.headers.push(value.span().start);
        } else if !value.get_ref().is_array() {
            self.ends.push(value.span().end);
        }
        match value.get_ref() {
            DeValue::Table(table) => self.walk(table, text),
            DeValue::Array(array) => {
                // A list in brackets is a value; the span of a list of tables is that of a header.
                if !array.iter().any(|item| has_header(item, text)) {
                    self.ends.push(value.span().end);
                }
                array.iter().for_each(|item| self.walk_value(item, text));
            }
            _ => {}
        }
    }

    /// Where the lines of comment directly above a header begin; the comment that begins a
    /// text is about all of it.
    pub(super) fn attached(&self, text: &str, header: usize) -> usize {
        let line_start = |place: usize| text[..place].rfind('\n').map_or(0, |i| i + 1);
        let own = line_start(header);
        // Not into a value before it: a text of several lines may look like a comment.
        let floor = self.ends.iter().rev().find(|end| **end <= header).copied().unwrap_or(0);
        let mut start = own;
        while start > 0 {
            let above = line_start(start - 1);
            if above < floor || !text[above..start].trim_start().starts_with('#') {
                return start;
            }
            start = above;
        }
        own
    }

    /// Where the body of a step ends; none if other tables are within it.
    pub(super) fn end_of(&self, index: usize) -> Option<usize> {
        let step = &self.steps[index];
        let next = self.steps.get(index + 1).map(|next| next.header);
        let whole = next.is_none_or(|next| step.body.end <= next);
        let end = step.body.end;
        let foreign = |header: &usize| *header > step.header && *header < step.body.start;
        (whole && !self.headers.iter().any(foreign)).then_some(end)
    }

    /// Where a step after the last has its place: before the next table, or at the end.
    pub(super) fn after_last(&self, text: &str) -> Option<usize> {
        let Some(last) = self.steps.len().checked_sub(1) else { return Some(text.len()) };
        let end = self.end_of(last)?;
        let next = self.headers.iter().find(|header| **header >= end);
        Some(next.map_or(text.len(), |header| self.attached(text, *header).max(end)))
    }
}

/// From the first key of a table to its last value.
fn body(table: &DeTable<'_>) -> Option<Range<usize>> {
    let start = |(key, value): (&Spanned<_>, &Spanned<DeValue<'_>>)| {
        key.span().start.min(value.span().start)
    };
    let start = table.iter().map(start).min()?;
    let end = table.values().map(end).max()?;
    Some(start..end)
}

/// Where a value ends, with all that is in it.
fn end(value: &Spanned<DeValue<'_>>) -> usize {
    let inside = match value.get_ref() {
        DeValue::Table(table) => table.values().map(end).max(),
        DeValue::Array(array) => array.iter().map(end).max(),
        _ => None,
    };
    value.span().end.max(inside.unwrap_or(0))
}

impl Inline {
    /// The list of steps, if they are written as one.
    pub(super) fn of(document: &DeTable<'_>, text: &str) -> Option<Self> {
        let list = document.get("step")?;
        let items = list.get_ref().as_array()?;
        let inline = !items.iter().any(|item| has_header(item, text));
        let steps = items.iter().map(Spanned::span).collect();
        inline.then(|| Self { list: list.span(), steps })
    }

    /// Whether there is a comma after the last item.
    pub(super) fn comma(&self, text: &str) -> bool {
        let last = self.steps.last().map_or(self.list.start + 1, |item| item.end);
        let rest = &text[last..self.list.end];
        rest.lines().any(|line| line.split('#').next().is_some_and(|code| code.contains(',')))
    }
}
