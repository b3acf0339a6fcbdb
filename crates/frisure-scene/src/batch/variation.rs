//! Reading how a key varies.

use std::ops::Range;
use std::path::Path;

use toml::Spanned;
use toml::de::DeValue;

use super::names::{self, ValueType};
use super::sheet::{Column, Sheet};
use super::table::{Field, Table};
use super::way::{Kind, Parameter, Scale, Value, Way, Written, kind_of};
use crate::error::{Diagnostic, Result, SceneError};
use crate::quantity::RATIO;
use crate::source::Source;

/// Keys that say how a key varies.
pub(super) const KEYS: [&str; 11] = [
    "from",
    "to",
    "log",
    "steps",
    "normal",
    "lognormal",
    "values",
    "weights",
    "table",
    "column",
    "unit",
];

/// Those of them of which one is needed.
const FIRST: [&str; 6] = ["from", "to", "normal", "lognormal", "values", "table"];

/// Most values of one key in a grid.
const MOST_STEPS: i64 = 1_000_000;

/// Deviations from the mean that a limit may be away on its far side: beyond, nearly nothing would be drawn.
const FAR: f64 = 3.0;

/// A key of the scene, and what is written for it.
pub(super) struct Entry<'a> {
    pub(super) path: String,
    pub(super) text: String,
    pub(super) field: Field<'a>,
}

/// A key that varies, and its position in the batch.
pub(super) struct Varied {
    pub(super) parameter: Parameter,
    pub(super) place: Range<usize>,
}

impl Entry<'_> {
    /// What the key takes.
    pub(super) fn value_type(&self, source: &Source) -> Result<ValueType> {
        names::value_type(&self.path).map_err(|no_key| {
            let unknown = Diagnostic::new(no_key.problem).hint(no_key.hint).key(self.path.as_str());
            unknown.at(source, self.field.key.clone())
        })
    }

    fn varied(&self, kind: Kind, way: Way) -> Varied {
        let parameter = Parameter { key: self.path.clone(), kind, way };
        Varied { parameter, place: self.field.key.clone() }
    }

    fn chosen(&self, choices: Vec<Written>, sums: Option<Vec<f64>>) -> Varied {
        let equal = || (1..=choices.len()).map(|i| i as f64).collect();
        let sums = sums.unwrap_or_else(equal);
        self.varied(kind_of(&choices), Way::Choice { choices, sums })
    }

    /// The error about a single value, where several are needed.
    fn one_value(&self, allowed: &str, source: &Source) -> SceneError {
        let one = Diagnostic::outside(allowed).key(self.path.as_str()).value(self.text.as_str());
        one.hint("`[set]` gives all heads one value").at(source, self.field.value.span())
    }

    /// Reads a key of the grid.
    pub(super) fn on_grid(&self, source: &Source) -> Result<Varied> {
        let value_type = self.value_type(source)?;
        let choices = match self.field.value.get_ref() {
            DeValue::Array(items) => self.values(items, value_type, source)?,
            DeValue::Table(table) => {
                let table = Table::read(source, table, &self.path, &KEYS)?;
                let variation = Variation { entry: self, table, value_type, source };
                if variation.table.has("values") {
                    variation.table.only(&["values"])?;
                    variation.values()?
                } else {
                    variation.table.only(&["from", "to", "steps", "log"])?;
                    variation.steps()?
                }
            }
            _ => {
                let allowed = "a list, or a table with `from`, `to` and `steps`";
                return Err(self.one_value(allowed, source));
            }
        };
        Ok(self.varied(kind_of(&choices), Way::Grid(choices)))
    }

    /// Reads a key that is drawn; adds the table that it is a column of to `sheets`.
    pub(super) fn drawn(
        &self,
        source: &Source,
        folder: &Path,
        sheets: &mut Vec<Sheet>,
    ) -> Result<Varied> {
        let value_type = self.value_type(source)?;
        match self.field.value.get_ref() {
            DeValue::Table(table) => {
                let table = Table::read(source, table, &self.path, &KEYS)?;
                Variation { entry: self, table, value_type, source }.varied(folder, sheets)
            }
            DeValue::Array(items) => Ok(self.chosen(self.values(items, value_type, source)?, None)),
            _ => {
                let allowed =
                    "a list, or a table that says how it varies, such as { from = ..., to = ... }";
                Err(self.one_value(allowed, source))
            }
        }
    }

    /// The items of a list.
    fn values(
        &self,
        items: &[Spanned<DeValue<'_>>],
        value_type: ValueType,
        source: &Source,
    ) -> Result<Vec<Written>> {
        if items.is_empty() {
            let refused = Diagnostic::outside("a list of values").key(self.path.as_str());
            let span = self.field.value.span();
            return Err(refused.value(self.text.as_str()).at(source, span));
        }
        let dimension = value_type.dimension();
        let written = |item: &Spanned<_>| Written::literal(source.slice(item.span()), dimension);
        Ok(items.iter().map(written).collect())
    }
}

/// A table that says how a key varies.
struct Variation<'a> {
    entry: &'a Entry<'a>,
    table: Table<'a>,
    value_type: ValueType,
    source: &'a Source,
}

impl Variation<'_> {
    fn varied(&self, folder: &Path, sheets: &mut Vec<Sheet>) -> Result<Varied> {
        let table = &self.table;
        if table.has("values") {
            table.only(&["values", "weights"])?;
            let choices = self.values()?;
            let weights = self.weights(choices.len())?;
            return Ok(self.entry.chosen(choices, weights));
        }
        if table.has("table") {
            table.only(&["table", "column", "unit"])?;
            let sheet = self.column(folder, sheets)?;
            return Ok(self.entry.varied(Kind::Text, Way::Column { sheet, cells: Vec::new() }));
        }
        let whole = self.is_whole();
        let kind = if whole { Kind::Whole } else { Kind::Number };
        for (name, scale) in [("normal", Scale::Linear), ("lognormal", Scale::Log)] {
            if table.has(name) {
                table.only(&[name, "from", "to"])?;
                return Ok(self.entry.varied(kind, self.normal(name, scale)?));
            }
        }
        if table.has("from") || table.has("to") {
            table.only(&["from", "to", "log"])?;
            let range = self.range()?;
            let scale = self.scale(range[0])?;
            return Ok(self.entry.varied(kind, Way::Uniform { range, scale, whole }));
        }
        let problem = format!("nothing says how `{}` varies", self.entry.path);
        Err(self.error(problem, format!("one of `{}` does", FIRST.join("`, `"))))
    }

    fn is_whole(&self) -> bool {
        matches!(self.value_type, ValueType::Whole)
    }

    /// The error about the whole table, with a hint that may be empty.
    fn error(&self, problem: String, hint: String) -> SceneError {
        let error = Diagnostic::new(problem).key(self.entry.path.as_str()).hint(hint);
        error.at(self.source, self.entry.field.value.span())
    }

    fn missing(&self, key: &str) -> SceneError {
        self.error(format!("`{}` has no `{key}`", self.entry.path), String::new())
    }

    /// The items of `values`.
    fn values(&self) -> Result<Vec<Written>> {
        let refused = || {
            let refused = Diagnostic::outside("a list of values").key(self.entry.path.as_str());
            refused.value(self.table.text("values")).at(self.source, self.table.span("values"))
        };
        let items = self.table.list("values").ok_or_else(refused)?;
        self.entry.values(items, self.value_type, self.source)
    }

    /// The values of a grid from one number to another.
    fn steps(&self) -> Result<Vec<Written>> {
        let [from, to] = self.range()?;
        let scale = self.scale(from)?;
        let steps = self.table.whole("steps", 2, MOST_STEPS)?;
        let steps = steps.ok_or_else(|| self.missing("steps"))?;
        let last = (steps - 1) as f64;
        let ends = if scale == Scale::Log { [from.ln(), to.ln()] } else { [from, to] };
        let at = |i: i64| match i {
            0 => from,
            i if i == steps - 1 => to,
            i => {
                let x = ends[0] + (ends[1] - ends[0]) * (i as f64 / last);
                if scale == Scale::Log { x.exp() } else { x }
            }
        };
        let written = |x| if self.is_whole() { Written::whole(x) } else { Written::number(x) };
        let mut all: Vec<Written> = (0..steps).map(|i| written(at(i))).collect();
        all.dedup();
        Ok(all)
    }

    /// `from` and `to`, in order.
    fn range(&self) -> Result<[f64; 2]> {
        let from = self.table.number("from", self.value_type)?;
        let to = self.table.number("to", self.value_type)?;
        let from = from.ok_or_else(|| self.missing("from"))?;
        let to = to.ok_or_else(|| self.missing("to"))?;
        self.check_order(from, to)?;
        Ok([from, to])
    }

    fn check_order(&self, from: f64, to: f64) -> Result<()> {
        if from < to {
            return Ok(());
        }
        let low = self.table.text("from");
        Err(self.table.refuse("to", format!("more than `from`, which is {low}")))
    }

    fn scale(&self, from: f64) -> Result<Scale> {
        match self.table.flag("log")?.unwrap_or(false) {
            false => Ok(Scale::Linear),
            true if from > 0.0 => Ok(Scale::Log),
            true => Err(self.table.refuse("from", "more than 0, with `log`")),
        }
    }

    /// The sums of weights, one for each of a number of values.
    fn weights(&self, count: usize) -> Result<Option<Vec<f64>>> {
        if !self.table.has("weights") {
            return Ok(None);
        }
        let allowed = format!("{count} numbers of 0 or more, one for each value, and not all 0");
        let refuse = || self.table.refuse("weights", allowed.as_str());
        let items = self.table.list("weights").filter(|items| items.len() == count);
        let mut sum = 0.0;
        let mut sums = Vec::with_capacity(count);
        for item in items.ok_or_else(refuse)? {
            sum += match Written::literal(self.source.slice(item.span()), None).value {
                Value::Number(x) if x >= 0.0 && x.is_finite() => x,
                Value::Whole(i) if i >= 0 => i as f64,
                _ => return Err(refuse()),
            };
            sums.push(sum);
        }
        if sum > 0.0 { Ok(Some(sums)) } else { Err(refuse()) }
    }

    fn normal(&self, name: &str, scale: Scale) -> Result<Way> {
        let (table, is_log) = (&self.table, scale == Scale::Log);
        let allowed = if is_log {
            "the median and the relative deviation, such as [\"70 um\", 0.2]"
        } else {
            "the mean and the standard deviation, such as [\"35 um\", \"5 um\"]"
        };
        let Some([centre_item, deviation_item]) = table.list(name) else {
            return Err(table.refuse(name, allowed));
        };
        let positive = |item: &Spanned<_>| table.refuse_at(name, item.span(), "more than 0");
        let centre = table.quantity(name, centre_item.span(), self.value_type)?;
        let of_deviation = if is_log { ValueType::Quantity(&RATIO) } else { self.value_type };
        let deviation = table.quantity(name, deviation_item.span(), of_deviation)?;
        if is_log && centre <= 0.0 {
            return Err(positive(centre_item));
        }
        if deviation <= 0.0 {
            return Err(positive(deviation_item));
        }
        let lowest = if is_log { 0.0 } else { f64::NEG_INFINITY };
        let from = table.number("from", self.value_type)?.unwrap_or(lowest);
        let to = table.number("to", self.value_type)?.unwrap_or(f64::INFINITY);
        if is_log && from < 0.0 {
            return Err(table.refuse("from", "0 or more, with `lognormal`"));
        }
        self.check_order(from, to)?;
        let away = |x: f64| match scale {
            Scale::Linear => (x - centre) / deviation,
            Scale::Log => (x / centre).ln() / deviation,
        };
        for (end, far) in [("from", away(from) > FAR), ("to", away(to) < -FAR)] {
            if far {
                let allowed = "within three deviations of the mean, or nearly nothing is left";
                return Err(table.refuse(end, allowed));
            }
        }
        Ok(Way::Normal { centre, deviation, limits: [from, to], scale, whole: self.is_whole() })
    }

    /// Takes a column of a table, and returns the number of its sheet.
    fn column(&self, folder: &Path, sheets: &mut Vec<Sheet>) -> Result<usize> {
        let name = self.table.word("table")?.ok_or_else(|| self.missing("table"))?;
        let heading = self.table.word("column")?.ok_or_else(|| self.missing("column"))?;
        let unit = self.table.word("unit")?;
        let place = match sheets.iter().position(|sheet| sheet.name == name) {
            Some(place) => place,
            None => {
                let sheet = Sheet::read(&name, folder).map_err(|error| {
                    let diagnostic = Diagnostic::new(error.to_string()).hint(error.hint());
                    let diagnostic = diagnostic.key(format!("{}.table", self.entry.path));
                    diagnostic.at(self.source, self.table.span("table"))
                })?;
                sheets.push(sheet);
                sheets.len() - 1
            }
        };
        let (key, span) = (self.entry.path.clone(), self.table.span("column"));
        let column = Column { key, heading, unit, value_type: self.value_type, span };
        sheets[place].take(column, self.source)?;
        Ok(place)
    }
}
