//! Histories: the text of a scene, all that was done to its hair and undone again, in one file.
//!
//! A history is TOML: `history = 1`, the version; `done`, how many of its steps are done, the others
//! being undone; `steps`, how many it has; `scene`, a text; and the steps as scenes have them. Its last
//! line counts them once more, with a checksum of all before it, so that a file that was cut off cannot
//! be taken for a shorter one.

use std::path::Path;

use frisure_hairstyle::styling::Operation;
use thiserror::Error;

use crate::error::SceneError;
use crate::record::{Record, parse_record};
use crate::scene;
use crate::write::{WriteStepError, write_step};
use frisure_files::{self as files, ReadError, WriteError};

/// The version of the files written, and the newest that is read.
pub const VERSION: u64 = 1;

/// Largest history that is read or written (bytes).
pub const MAX_SIZE: u64 = 4 * scene::MAX_SIZE;

/// What a history is called in errors about its size.
const WHAT: &str = "a history";

/// A scene, and what is done to its hair.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HistoryFile {
    /// The text of the scene that everything begins from.
    pub scene_text: String,
    /// What was done, in order, and after it what was undone and can be done again.
    pub operations: Vec<Operation>,
    /// How many of the operations are done.
    pub done: usize,
}

/// What is whole of a history that was cut off or changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Recovered {
    /// The scene and the steps that are whole.
    pub history: HistoryFile,
    /// How many steps are lost.
    pub lost: usize,
}

/// Why a history cannot be read.
#[derive(Debug, Error)]
pub enum ReadHistoryError {
    /// Its file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// It is something else.
    #[error("`{name}` is no history: such a file begins with `history = {VERSION}`")]
    NotHistory {
        /// The file.
        name: String,
    },
    /// It is of a newer version.
    #[error(
        "`{name}` was written by a newer frisure, in version {version}; this one reads {VERSION}"
    )]
    Newer {
        /// The file.
        name: String,
        /// Its version.
        version: u64,
    },
    /// Its end is missing, but the scene and some steps are there.
    #[error("{}", cut_off(name, *whole, *promised))]
    CutOff {
        /// The file.
        name: String,
        /// How many steps are whole.
        whole: usize,
        /// How many there were.
        promised: usize,
    },
    /// So much is missing that not even the scene is whole.
    #[error("`{name}` ends before its first step: it was cut off, and nothing can be recovered")]
    NothingLeft {
        /// The file.
        name: String,
    },
    /// It is not as it was written.
    #[error("`{name}` was changed or damaged after it was written: its checksum is wrong")]
    Changed {
        /// The file.
        name: String,
    },
    /// It has fewer steps than are done, or another number than it counts.
    #[error(
        "`{name}` contradicts itself: {done} of {count} steps are done, and {promised} counted"
    )]
    Contradicts {
        /// The file.
        name: String,
        /// How many steps are done, as it counts.
        done: usize,
        /// How many steps there are.
        count: usize,
        /// How many there are, as it counts.
        promised: usize,
    },
    /// Something in it is wrong.
    #[error(transparent)]
    Diagnostic(#[from] SceneError),
}

/// Why a history cannot be written.
#[derive(Debug, Error)]
pub enum WriteHistoryError {
    /// A step that cannot be written.
    #[error("step {} cannot be saved", index + 1)]
    Step {
        /// Its number, from 0.
        index: usize,
        /// Why not.
        source: WriteStepError,
    },
    /// More steps are done than there are.
    #[error("{done} steps are done, and there are {count}")]
    Done {
        /// How many are done.
        done: usize,
        /// How many there are.
        count: usize,
    },
    /// It would be larger than what can be read again.
    #[error("the history is larger than {MAX_SIZE} bytes")]
    TooLarge,
    /// The file cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl HistoryFile {
    /// Reads a history.
    ///
    /// # Errors
    /// [`ReadHistoryError`]; of a file that was cut off [`recover`] gives what is whole.
    pub fn read(path: &Path) -> Result<Self, ReadHistoryError> {
        let text = read_text(path)?;
        Self::parse(&path.display().to_string(), &text)
    }

    /// Reads the text of a history; errors call it `name`.
    ///
    /// # Errors
    /// [`ReadHistoryError`].
    pub fn parse(name: &str, text: &str) -> Result<Self, ReadHistoryError> {
        check_version(name, text)?;
        let named = || name.to_owned();
        let Some(end) = End::of(text) else {
            return Err(match whole(name, text) {
                Ok(Record { steps, promised, .. }) => {
                    ReadHistoryError::CutOff { name: named(), whole: steps.len(), promised }
                }
                Err(_) => ReadHistoryError::NothingLeft { name: named() },
            });
        };
        if end.checksum != checksum(end.body) {
            return Err(ReadHistoryError::Changed { name: named() });
        }
        let Record { done, promised, scene, steps } = parse_record(name, end.body)?;
        let count = steps.len();
        if done > count || promised != count || end.steps != count {
            return Err(ReadHistoryError::Contradicts { name: named(), done, count, promised });
        }
        Ok(Self { scene_text: scene, operations: steps, done })
    }

    /// The text of the history, which [`Self::parse`] reads as the same.
    ///
    /// # Errors
    /// [`WriteHistoryError`].
    pub fn text(&self) -> Result<String, WriteHistoryError> {
        let (done, count) = (self.done, self.operations.len());
        if done > count {
            return Err(WriteHistoryError::Done { done, count });
        }
        let scene = quoted(&self.scene_text);
        let mut text =
            format!("history = {VERSION}\ndone = {done}\nsteps = {count}\nscene = {scene}\n");
        for (index, operation) in self.operations.iter().enumerate() {
            let step = write_step(operation)
                .map_err(|source| WriteHistoryError::Step { index, source })?;
            text.push('\n');
            text.push_str(&step);
        }
        let end = End { body: &text, steps: count, checksum: checksum(&text) }.line();
        text.push_str(&end);
        if text.len() as u64 > MAX_SIZE { Err(WriteHistoryError::TooLarge) } else { Ok(text) }
    }

    /// Writes the history, all or nothing: whenever it is interrupted, the old file or the new one is
    /// there.
    ///
    /// # Errors
    /// [`WriteHistoryError`]; the file is then as it was.
    pub fn write(&self, path: &Path) -> Result<(), WriteHistoryError> {
        let text = self.text()?;
        Ok(files::write_atomically(path, |out| out.write_all(text.as_bytes()))?)
    }
}

/// What is whole of a history that [`HistoryFile::read`] refuses as cut off or changed: its scene, and its
/// steps up to the first that is not whole.
///
/// # Errors
/// [`ReadHistoryError`], if not even the scene is whole, or what is there cannot be read.
pub fn recover(path: &Path) -> Result<Recovered, ReadHistoryError> {
    let text = read_text(path)?;
    recover_text(&path.display().to_string(), &text)
}

/// The same of a text; errors call it `name`.
///
/// # Errors
/// [`ReadHistoryError`].
pub fn recover_text(name: &str, text: &str) -> Result<Recovered, ReadHistoryError> {
    check_version(name, text)?;
    let cut = End::of(text).is_none();
    let record = whole(name, text).map_err(|error| match cut {
        true => ReadHistoryError::NothingLeft { name: name.to_owned() },
        false => error.into(),
    })?;
    let Record { done, promised, scene, steps } = record;
    let lost = promised.saturating_sub(steps.len());
    let done = done.min(steps.len());
    Ok(Recovered { history: HistoryFile { scene_text: scene, operations: steps, done }, lost })
}

fn cut_off(name: &str, whole: usize, promised: usize) -> String {
    let (place, left) = match whole {
        0 => ("before its first step".to_owned(), "the scene".to_owned()),
        1 => (format!("after step 1 of {promised}"), "the one whole step".to_owned()),
        n => (format!("after step {n} of {promised}"), format!("the {n} whole steps")),
    };
    format!("`{name}` ends {place}: it was cut off; {left} can be recovered")
}

/// The text of a file, which may end in the middle of a letter.
fn read_text(path: &Path) -> Result<String, ReadError> {
    let mut bytes = files::read_bytes(path, MAX_SIZE, WHAT)?;
    if let Err(error) = std::str::from_utf8(&bytes)
        && error.error_len().is_none()
    {
        bytes.truncate(error.valid_up_to());
    }
    files::to_text(bytes, path)
}

/// The steps of a history that has no end: those whose lines are whole.
fn whole(name: &str, text: &str) -> Result<Record, SceneError> {
    // A line without its end may be part of a longer one, and still mean something: 0.9 of 0.95.
    let lines = &text[..text.rfind('\n').map_or(0, |i| i + 1)];
    // The header of a step of which nothing more is there.
    let steps = lines.trim_end().strip_suffix("[[step]]").unwrap_or(lines);
    parse_record(name, steps)
}

/// Refuses what is no history, and histories of versions to come.
fn check_version(name: &str, text: &str) -> Result<(), ReadHistoryError> {
    const KEY: &str = "history = ";
    let line = text.lines().next().unwrap_or("");
    let version = line.strip_prefix(KEY).and_then(|number| number.trim().parse().ok());
    match version {
        Some(version) if version > VERSION => {
            Err(ReadHistoryError::Newer { name: name.to_owned(), version })
        }
        Some(VERSION) => Ok(()),
        // Not even the first line is whole.
        None if text == line && (KEY.starts_with(line) || line == KEY) => {
            Err(ReadHistoryError::NothingLeft { name: name.to_owned() })
        }
        _ => Err(ReadHistoryError::NotHistory { name: name.to_owned() }),
    }
}

/// The last line of a history.
struct End<'a> {
    /// The text before it.
    body: &'a str,
    steps: usize,
    checksum: u64,
}

impl<'a> End<'a> {
    /// The end of a text, if it has one.
    fn of(text: &'a str) -> Option<Self> {
        let whole = text.strip_suffix('\n').unwrap_or(text);
        let start = whole.rfind('\n')? + 1;
        let (steps, sum) =
            whole[start..].strip_prefix("# end: ")?.split_once(" steps, checksum ")?;
        let hexadecimal = sum.len() == 16 && sum.bytes().all(|b| b.is_ascii_hexdigit());
        let checksum = u64::from_str_radix(sum, 16).ok().filter(|_| hexadecimal)?;
        Some(Self { body: &text[..start], steps: steps.parse().ok()?, checksum })
    }

    fn line(&self) -> String {
        format!("# end: {} steps, checksum {:016x}\n", self.steps, self.checksum)
    }
}

/// FNV-1a, 64 bits: against accidents, not against forgers.
/// <http://www.isthe.com/chongo/tech/comp/fnv/>
fn checksum(text: &str) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    text.bytes().fold(start, |sum: u64, b| (sum ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3))
}

/// A text as a TOML string of several lines, to be read as it is in an editor.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"\"\"\n");
    let mut rest = text.chars().peekable();
    let mut after_quote = false;
    while let Some(c) = rest.next() {
        // Three in a row, or one before the last three, would end the string.
        let ends = c == '"' && (after_quote || rest.peek().is_none());
        after_quote = c == '"' && !ends;
        match c {
            '\\' => out.push_str("\\\\"),
            '"' if ends => out.push_str("\\\""),
            '\n' | '\t' => out.push(c),
            c if c.is_control() => out.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => out.push(c),
        }
    }
    out + "\"\"\""
}
