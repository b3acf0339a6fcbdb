//! Tables of people who were measured: a head of a batch is one row, so that what goes together stays
//! together.

use std::ops::Range;
use std::path::Path;

use frisure_hairstyle::Draws;

use super::names::ValueType;
use super::way::Written;
use crate::error::{Diagnostic, SceneError};
use crate::measurements::MeasurementError;
use crate::measurements::heading::{brackets, unit_of};
use crate::measurements::table::{Row, Table};
use crate::quantity::{Dimension, QuantityError};
use crate::similar::nearest;
use crate::source::Source;

/// A table, and which of its rows count.
#[derive(Clone, Debug)]
pub(super) struct Sheet {
    /// Its path as the batch writes it.
    pub(super) name: String,
    pub(super) table: Table,
    /// The columns that are used.
    columns: Vec<(usize, Column)>,
    /// How many rows have all of them.
    rows: usize,
}

/// A column that keys are drawn from.
#[derive(Clone, Debug)]
pub(super) struct Column {
    /// The key.
    pub(super) key: String,
    pub(super) heading: String,
    /// The unit of its numbers, if the batch gives it.
    pub(super) unit: Option<String>,
    pub(super) value_type: ValueType,
    /// Where the batch names it.
    pub(super) span: Range<usize>,
}

impl Sheet {
    pub(super) fn read(name: &str, folder: &Path) -> Result<Self, MeasurementError> {
        let table = Table::read(&folder.join(name))?;
        Ok(Self { name: name.to_owned(), table, columns: Vec::new(), rows: 0 })
    }

    /// Takes a column, if the table has it.
    pub(super) fn take(&mut self, column: Column, source: &Source) -> Result<(), SceneError> {
        let headings = &self.table.headings;
        let bare = |heading: &str| brackets(heading).0.trim().to_owned();
        let place = headings.iter().position(|heading| *heading == column.heading);
        let place = place.or_else(|| headings.iter().position(|h| bare(h) == column.heading));
        let Some(place) = place else {
            let problem = format!("`{}` has no column `{}`", self.name, column.heading);
            let near = nearest(&column.heading, headings.iter().map(String::as_str));
            let hint = match near {
                Some(near) => format!("did you mean `{near}`?"),
                None => format!("it has: {}", headings.join(", ")),
            };
            let diagnostic =
                Diagnostic::new(problem).hint(hint).key(format!("{}.column", column.key));
            return Err(diagnostic.at(source, column.span));
        };
        self.columns.push((place, column));
        Ok(())
    }

    /// Which row the head of a number has.
    pub(super) fn row(&self, seed: u64, head: usize) -> usize {
        Draws::new(seed, &format!("table {}", self.name), head).one_of(self.rows)
    }

    /// For each key what it has in the rows that count: those in which nothing is missing that is used.
    pub(super) fn settle(
        &mut self,
        source: &Source,
    ) -> Result<Vec<(String, Vec<Written>)>, SceneError> {
        self.rows = self.counted().count();
        let rows: Vec<&Row> = self.counted().collect();
        if rows.is_empty() {
            let (_, column) = &self.columns[0];
            let problem = format!("no row of `{}` has all of the columns that are used", self.name);
            let diagnostic = Diagnostic::new(problem).key(format!("{}.table", column.key));
            return Err(diagnostic.at(source, column.span.clone()));
        }
        let cells = |(place, column): &(usize, Column)| {
            let read = |row: &&Row| self.cell(row, *place, column, source);
            let cells: Result<Vec<Written>, SceneError> = rows.iter().map(read).collect();
            cells.map(|cells| (column.key.clone(), cells))
        };
        self.columns.iter().map(cells).collect()
    }

    /// The rows in which nothing is missing that is used.
    fn counted(&self) -> impl Iterator<Item = &Row> {
        let is_there = |cell: &str| {
            !matches!(cell.to_ascii_lowercase().as_str(), "" | "-" | "na" | "n/a" | "nan" | "none")
        };
        let counts =
            move |row: &&Row| self.columns.iter().all(|(place, _)| is_there(&row.cells[*place]));
        self.table.rows.iter().filter(counts)
    }

    /// Where a key has the value of a row that counts, and what is written there.
    pub(super) fn place_of(&self, key: &str, row: usize) -> Option<String> {
        let (place, _) = self.columns.iter().find(|(_, column)| column.key == key)?;
        let row = self.counted().nth(row)?;
        Some(format!("{} is {}", self.table.place(row, *place), row.cells[*place]))
    }

    fn cell(
        &self,
        row: &Row,
        place: usize,
        column: &Column,
        source: &Source,
    ) -> Result<Written, SceneError> {
        let text = row.cells[place].as_str();
        let number = self.table.number(row, place).ok().flatten();
        let refuse = |problem: String, hint: String| {
            let at = self.table.place(row, place);
            let diagnostic = Diagnostic::new(format!("{at} is {text}: {problem}")).hint(hint);
            diagnostic.key(format!("{}.column", column.key)).at(source, column.span.clone())
        };
        match (column.value_type, number) {
            (ValueType::Whole, Some(x)) if x.fract() == 0.0 && x.abs() < 1e15 => {
                Ok(Written::whole(x))
            }
            (ValueType::Whole, _) => Err(refuse("it must be a whole number".into(), String::new())),
            (ValueType::Quantity(dimension), number) => {
                let heading = &self.table.headings[place];
                let unit = column.unit.clone().or_else(|| unit_of(heading));
                let read = match number {
                    Some(x) => in_unit(dimension, x, unit.as_deref()),
                    None => dimension.parse(text),
                };
                match read {
                    Ok(x) => Ok(Written::number(x)),
                    // A parting may be a word.
                    Err(QuantityError::NoNumber) => Ok(Written::word(text)),
                    Err(QuantityError::NoUnit) => {
                        let hint = format!(
                            "say it with `unit`, such as `unit = \"{}\"`, or in the heading: `{} ({0})`",
                            dimension.example.split_once(' ').map_or("", |(_, unit)| unit),
                            column.heading
                        );
                        Err(refuse(format!("{} needs a unit", dimension.name), hint))
                    }
                    Err(error) => {
                        let units = dimension.units().collect::<Vec<_>>().join(", ");
                        Err(refuse(
                            error.to_string(),
                            format!("units of {}: {units}", dimension.name),
                        ))
                    }
                }
            }
            (ValueType::Other, _) => Ok(match text {
                "true" | "false" => Written::literal(text, None),
                text => Written::word(text),
            }),
        }
    }
}

/// A number of a cell in a unit, SI units.
fn in_unit(dimension: &Dimension, x: f64, unit: Option<&str>) -> Result<f64, QuantityError> {
    dimension.parse(&format!("{x} {}", unit.unwrap_or("")))
}
