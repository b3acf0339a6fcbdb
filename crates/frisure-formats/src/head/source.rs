//! The files of a head, and why they cannot be used.

use std::path::{Path, PathBuf};

use frisure_files::ReadError;
use frisure_strands::SurfaceError;
use thiserror::Error;

/// Largest mesh, mask or list of weights that is read (bytes).
pub const MAX_SIZE: u64 = 1 << 30;

/// Why a head cannot be used.
#[derive(Debug, Error)]
pub enum HeadFileError {
    /// A file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A line of a file is wrong.
    #[error("{}:{line}: {problem}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// The file is something else than it should be.
    #[error("`{}` is not {expected}: {problem}", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// What was expected, such as `an OBJ mesh`.
        expected: &'static str,
        /// What is wrong.
        problem: String,
    },
    /// The mesh cannot be a surface.
    #[error("`{}` cannot be a head: {source}", path.display())]
    Surface {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: SurfaceError,
    },
    /// The mesh has not the size of a head.
    #[error(
        "`{}` is {} m across, and a head is between 5 cm and 2.5 m; {}",
        path.display(),
        short(*size),
        unit_hint(*size, *scale)
    )]
    Size {
        /// The file.
        path: PathBuf,
        /// Longest side of the box around it (m).
        size: f64,
        /// Metres per unit that it was read with.
        scale: f64,
    },
    /// There is no such group of faces.
    #[error("`{}` has no group `{group}`; it has {}", path.display(), list(known))]
    NoGroup {
        /// The file.
        path: PathBuf,
        /// The group given.
        group: String,
        /// The groups there are.
        known: Vec<String>,
    },
    /// The file has no such number at its vertices.
    #[error("`{}` has no `{channel}` at its vertices; it has {}", path.display(), list(known))]
    NoChannel {
        /// The file.
        path: PathBuf,
        /// What was requested.
        channel: String,
        /// What there is.
        known: Vec<String>,
    },
    /// Hair would grow nowhere.
    #[error("the scalp has no area: {what}")]
    NoScalp {
        /// What was requested.
        what: String,
    },
}

fn list(groups: &[String]) -> String {
    if groups.is_empty() {
        return "none".into();
    }
    // A scan can have thousands.
    let shown = groups.iter().take(12).map(|g| format!("`{g}`")).collect::<Vec<_>>().join(", ");
    if groups.len() > 12 { format!("{shown} and {} more", groups.len() - 12) } else { shown }
}

/// A size to read, not to compute with.
fn short(size: f64) -> String {
    if (1e-3..1e6).contains(&size) { format!("{size:.3}") } else { format!("{size:.3e}") }
}

/// The unit in which a mesh of that size would be a head of usual size.
fn unit_hint(size: f64, scale: f64) -> String {
    let units = [("m", 1.0), ("cm", 0.01), ("mm", 0.001), ("in", 0.0254), ("dm", 0.1)];
    let sensible = |&&(_, u): &&(&str, f64)| {
        let metres = size / scale * u;
        (0.15..0.8).contains(&metres)
    };
    match units.iter().find(sensible) {
        Some((name, _)) => format!("is it in \"{name}\"? set `unit = \"{name}\"`"),
        None => "set `scale`, in metres per unit of the mesh".into(),
    }
}

/// The error for a file that is no mesh with faces.
pub(super) fn not_a_mesh(path: &Path, problem: impl Into<String>) -> HeadFileError {
    let (expected, problem) = ("a mesh that hair can grow on", problem.into());
    HeadFileError::Format { path: path.into(), expected, problem }
}
