//! A table of text as it stands in its file: headings, and rows with their lines.

use std::path::{Path, PathBuf};

use super::error::{MeasurementError, Place};
use frisure_files::read_text;

/// Largest file that is read (bytes).
const LIMIT: u64 = 64 << 20;

/// Separators that spreadsheets write; the one that the headings have most of is taken.
const SEPARATORS: [u8; 3] = [b',', b';', b'\t'];

/// A table, nothing understood yet.
#[derive(Clone, Debug)]
pub(crate) struct Table {
    pub(crate) path: PathBuf,
    pub(crate) headings: Vec<String>,
    pub(crate) rows: Vec<Row>,
    /// Whether a comma may be a decimal point.
    pub(crate) decimal_comma: bool,
}

/// A row with as many cells as there are headings.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    /// Line of the file on which it starts, from 1.
    pub(crate) line: u64,
    pub(crate) cells: Vec<String>,
}

impl Table {
    pub(crate) fn read(path: &Path) -> Result<Self, MeasurementError> {
        Self::parse(&read_text(path, LIMIT, "a table of measurements")?, path)
    }

    pub(crate) fn parse(text: &str, path: &Path) -> Result<Self, MeasurementError> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let refuse = |problem: &str| MeasurementError::NoTable {
            path: path.into(),
            problem: problem.to_owned(),
        };
        let first = text.lines().find(|l| !l.trim().is_empty() && !l.starts_with('#'));
        let first = first.ok_or_else(|| refuse("it is empty"))?;
        let separator = separator(first);
        let mut reader = csv::ReaderBuilder::new()
            .delimiter(separator)
            .comment(Some(b'#'))
            .trim(csv::Trim::All)
            .from_reader(text.as_bytes());
        if let Some((line, wrong)) = wrong_quote(text, separator) {
            return Err(refuse(&format!("a cell on line {line} {wrong}")));
        }
        let headings = reader.headers().map_err(|e| refuse(&described(&e)))?;
        let headings: Vec<String> = headings.iter().map(str::to_owned).collect();
        let mut rows = Vec::new();
        for record in reader.records() {
            let record = record.map_err(|e| refuse(&described(&e)))?;
            let line = record.position().map_or(0, csv::Position::line);
            rows.push(Row { line, cells: record.iter().map(str::to_owned).collect() });
        }
        if rows.is_empty() {
            return Err(refuse("it has headings and no rows"));
        }
        Ok(Self { path: path.into(), headings, rows, decimal_comma: separator != b',' })
    }

    /// The number in a cell; none where nothing was measured.
    pub(crate) fn number(&self, row: &Row, column: usize) -> Result<Option<f64>, MeasurementError> {
        let cell = row.cells[column].as_str();
        if matches!(cell.to_ascii_lowercase().as_str(), "" | "-" | "na" | "n/a" | "nan" | "none") {
            return Ok(None);
        }
        let plain = if self.decimal_comma && !cell.contains('.') {
            cell.replace(',', ".")
        } else {
            cell.to_owned()
        };
        let number = plain.parse::<f64>().ok().filter(|x| x.is_finite());
        number.map(Some).ok_or_else(|| MeasurementError::Value {
            at: Box::new(self.place(row, column)),
            value: cell.to_owned(),
            allowed: "a number".to_owned(),
            hint: "",
        })
    }

    pub(crate) fn place(&self, row: &Row, column: usize) -> Place {
        Place { path: self.path.clone(), line: row.line, column: self.headings[column].clone() }
    }

    /// The name of the file without its folder.
    pub(crate) fn name(&self) -> String {
        self.path.file_name().unwrap_or_default().to_string_lossy().into_owned()
    }
}

fn separator(line: &str) -> u8 {
    let count = |s: u8| line.bytes().filter(|&b| b == s).count();
    // The first of several with as many: a table of one column has none of any.
    SEPARATORS.into_iter().rev().max_by_key(|&s| count(s)).unwrap_or(b',')
}

/// The line of a cell whose quotes enclose it in part, or have no end, and what is wrong with it: a reader of CSV would take other cells
/// or the rest of the file for that cell.
///
/// Quotes are those of RFC 4180, section 2: they enclose a whole cell, and are doubled inside it.
fn wrong_quote(text: &str, separator: u8) -> Option<(u64, &'static str)> {
    let (mut line, mut opened, mut begins, mut new_line) = (1, None, true, true);
    let mut bytes = text.bytes().peekable();
    while let Some(byte) = bytes.next() {
        match (byte, opened) {
            (b'#', None) if new_line => {
                while bytes.next_if(|byte| !matches!(byte, b'\r' | b'\n')).is_some() {}
            }
            (b'"', None) if begins => opened = Some(line),
            (b'"', Some(_)) if bytes.next_if_eq(&b'"').is_none() => {
                opened = None;
                while bytes.next_if_eq(&b' ').is_some() {}
                let ends = |&next: &u8| next == separator || matches!(next, b'\r' | b'\n');
                if !bytes.peek().is_none_or(ends) {
                    return Some((line, "goes on behind the quote that ends it"));
                }
            }
            _ => {}
        }
        new_line = matches!(byte, b'\r' | b'\n');
        begins = opened.is_none() && (byte == separator || new_line);
        line += u64::from(byte == b'\n');
    }
    opened.map(|line| (line, "begins with a quote that never ends"))
}

fn described(error: &csv::Error) -> String {
    match error.kind() {
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.as_ref().map_or(0, csv::Position::line);
            format!("line {line} has {len} cells, the headings are {expected_len}")
        }
        _ => error.to_string(),
    }
}
