//! The results of an experiment, as plain data.

use std::error::Error;

use crate::plot::Plot;

/// The results of an experiment.
#[derive(Clone, Debug, Default)]
pub struct Finding {
    /// Tables, plots, pictures and sentences, in the order of the report.
    pub items: Vec<Item>,
    /// Conditions on measured numbers.
    pub criteria: Vec<Criterion>,
    /// Times, which have no criteria.
    pub timings: Vec<Timing>,
    /// The error, if the experiment could not be run.
    pub failure: Option<String>,
}

/// A part of a finding.
#[derive(Clone, Debug)]
pub enum Item {
    /// A paragraph.
    Text(String),
    /// Numbers.
    Table(Table),
    /// Curves.
    Plot(Plot),
    /// A picture.
    Picture(Picture),
}

/// A table with a header row.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// Title.
    pub title: String,
    /// Names of the columns.
    pub head: Vec<String>,
    /// Cells; each row has one per column.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table.
    #[must_use]
    pub fn new(title: &str, head: &[&str]) -> Self {
        let head = head.iter().map(|&name| name.to_owned()).collect();
        Self { title: title.to_owned(), head, rows: Vec::new() }
    }

    /// Adds a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }
}

/// A picture with its caption.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Name of its file, without extension.
    pub name: String,
    /// Caption.
    pub caption: String,
    /// Width (pixels).
    pub width: usize,
    /// The file (PNG).
    pub png: Vec<u8>,
}

/// A measured time.
#[derive(Clone, Debug)]
pub struct Timing {
    /// Description of the computation.
    pub what: String,
    /// Wall-clock time (s).
    pub seconds: f64,
    /// A time to compare it with.
    pub beside: String,
}

/// The allowed range of a measured number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// At most this value.
    AtMost(f64),
    /// At least this value.
    AtLeast(f64),
    /// From the first to the second value, inclusive.
    Between(f64, f64),
}

/// A measured number and its limit.
#[derive(Clone, Debug)]
pub struct Criterion {
    /// Description of the measurement, with its unit.
    pub what: String,
    /// The number.
    pub measured: f64,
    /// The limit.
    pub limit: Limit,
}

impl Criterion {
    /// Whether the measured number is within the limit; false for NaN.
    #[must_use]
    pub fn holds(&self) -> bool {
        match self.limit {
            Limit::AtMost(most) => self.measured <= most,
            Limit::AtLeast(least) => self.measured >= least,
            Limit::Between(least, most) => (least..=most).contains(&self.measured),
        }
    }
}

impl Finding {
    /// The finding of an experiment that could not be run.
    #[must_use]
    pub fn failed(why: &dyn Error) -> Self {
        Self { failure: Some(why.to_string()), ..Self::default() }
    }

    /// Adds a paragraph.
    pub fn text(&mut self, text: impl Into<String>) {
        self.items.push(Item::Text(text.into()));
    }

    /// Adds a table.
    pub fn table(&mut self, table: Table) {
        self.items.push(Item::Table(table));
    }

    /// Adds curves.
    pub fn plot(&mut self, plot: Plot) {
        self.items.push(Item::Plot(plot));
    }

    /// Adds a picture.
    pub fn picture(&mut self, picture: Picture) {
        self.items.push(Item::Picture(picture));
    }

    /// Adds a criterion.
    pub fn check(&mut self, what: impl Into<String>, measured: f64, limit: Limit) {
        self.criteria.push(Criterion { what: what.into(), measured, limit });
    }

    /// Whether the experiment was run and every criterion holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.failure.is_none() && self.criteria.iter().all(Criterion::holds)
    }

    /// The verdict as text.
    #[must_use]
    pub fn verdict(&self) -> String {
        if let Some(why) = &self.failure {
            return format!("COULD NOT BE RUN: {why}");
        }
        let count = self.criteria.len();
        let failed = self.criteria.iter().filter(|c| !c.holds()).count();
        let criteria = if count == 1 { "criterion" } else { "criteria" };
        match failed {
            0 => format!("{count} of {count} {criteria} hold"),
            _ => format!("{failed} of {count} {criteria} FAIL"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nan_never_holds() {
        for limit in [Limit::AtMost(1.0), Limit::AtLeast(1.0), Limit::Between(0.0, 1.0)] {
            let criterion = |measured| Criterion { what: String::new(), measured, limit };
            assert!(!criterion(f64::NAN).holds());
            assert!(criterion(1.0).holds());
        }
    }
}
