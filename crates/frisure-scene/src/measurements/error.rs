//! Why tables cannot be used.

use std::fmt;
use std::path::PathBuf;

use frisure_files::ReadError;
use thiserror::Error;

use crate::quantity::RATIO;

/// Most tables that are read at once.
pub(super) const MOST_TABLES: usize = 10_000;

/// Where a number stands.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The table.
    pub path: PathBuf,
    /// Line, from 1.
    pub line: u64,
    /// Heading of the column.
    pub column: String,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: `{}`", self.path.display(), self.line, self.column)
    }
}

/// Why tables tell nothing.
#[derive(Debug, Error)]
pub enum MeasurementError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// It is no table.
    #[error("`{}` is not a table of measurements: {problem}", path.display())]
    NoTable {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        problem: String,
    },
    /// A file is given twice.
    #[error("`{}` is given twice", .0.display())]
    Twice(PathBuf),
    /// Two columns that say the same.
    #[error("{}: columns `{first}` and `{second}` say the same", path.display())]
    SameColumns {
        /// The table.
        path: PathBuf,
        /// One heading.
        first: String,
        /// The other.
        second: String,
    },
    /// More files than anyone measures.
    #[error("{0} tables are more than {MOST_TABLES}")]
    TooMany(usize),
    /// A cell holds something else.
    #[error("{at} is {value}, and must be {allowed}")]
    Value {
        /// Where.
        at: Box<Place>,
        /// What stands there.
        value: String,
        /// What may.
        allowed: String,
        /// What to try; may be empty.
        hint: &'static str,
    },
    /// A column whose unit is not known.
    #[error("{}: column `{column}`: {problem}", path.display())]
    Unit {
        /// The table.
        path: PathBuf,
        /// Its heading.
        column: String,
        /// A heading that would do.
        heading: String,
        /// What is wrong.
        problem: String,
    },
    /// No table has this column.
    #[error("no table has a column `{column}`; there are {known}")]
    NoColumn {
        /// Its heading.
        column: String,
        /// Those that there are.
        known: String,
    },
    /// A heading that says nothing of hair.
    #[error("`{title}` is not a property of hair; known are {known}")]
    NoMeaning {
        /// The heading that a column was to be read as.
        title: String,
        /// Those that are understood.
        known: String,
    },
    /// No row is left.
    #[error("no row has `{value}` in the column `{column}`")]
    NoRows {
        /// The column asked for.
        column: String,
        /// The text asked for.
        value: String,
    },
    /// No column is about hair, or all cells are empty.
    #[error("nothing in these tables is about hair")]
    Nothing {
        /// The headings that are understood.
        known: String,
    },
    /// No helix has both this curvature and that.
    #[error("{what} does not go with a curvature of {curvature}: it must be {allowed}")]
    NoHelix {
        /// What was said of the helix.
        what: String,
        /// Its curvature.
        curvature: String,
        /// What would go with it.
        allowed: String,
    },
}

impl MeasurementError {
    /// What a person may try; empty if the message says it.
    #[must_use]
    pub fn hint(&self) -> String {
        match self {
            Self::Value { hint, .. } => (*hint).to_owned(),
            Self::Unit { column, heading, .. } => format!(
                "write it into the heading, or say what the column is: `--column '{column}={heading}'`"
            ),
            Self::SameColumns { second, .. } => {
                format!("say what the other is, or `--column '{second}=other'` to pass it over")
            }
            Self::Read(ReadError::NotText { .. }) => {
                "save the table as UTF-8 text: spreadsheets call it CSV UTF-8".to_owned()
            }
            Self::Nothing { known } => format!("columns that are understood: {known}"),
            _ => String::new(),
        }
    }
}

/// Headings that are understood, for a message.
pub(super) fn known_headings() -> String {
    "curvature (1/mm), curve diameter (mm), diameter (um), min diameter (um), max diameter (um), \
     area (um^2), axis ratio, eccentricity, curl radius (mm), curl diameter (mm), pitch (mm), curl index, \
     turns (1/cm), hair length (cm), Young's modulus (GPa), shear modulus (GPa), density (g/cm^3), \
     hair, n"
        .to_owned()
}

/// A curvature (1/m) as it is told of hair.
pub(super) fn per_millimetre(curvature: f64) -> String {
    format!("{} 1/mm", RATIO.written(1e-3 * curvature))
}
