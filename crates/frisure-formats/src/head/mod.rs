//! Heads: a mesh into a [`Surface`] with z up, and where on it hair grows.
//!
//! One module per format, told by the first bytes of a file; each gives a mesh as it stands there.

mod gltf;
mod mesh;
mod obj;
mod ply;
mod scalp;
mod usd;

use std::path::{Component, Path, PathBuf};

use frisure_strands::{Surface, SurfaceError};
use glam::DVec3;
use thiserror::Error;

use frisure_files::frame::{Frame, FrameChoice};
use frisure_files::{Files, ReadError, to_text};

pub use mesh::Group;
use mesh::Mesh;

/// The extensions that heads have, without a dot. What a file is, its first bytes tell.
pub const EXTENSIONS: [&str; 8] = ["obj", "usd", "usda", "usdc", "usdz", "glb", "gltf", "ply"];

/// Largest mesh, mask or list of weights that is read (bytes).
pub const MAX_SIZE: u64 = 1 << 30;

/// Sizes (m) that a head, with or without shoulders, can have.
const SENSIBLE: (f64, f64) = (0.05, 3.0);

/// A head in files.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadFile {
    /// The mesh: OBJ, USD, glTF or PLY.
    pub path: PathBuf,
    /// Unit and axes, where the scene says them.
    pub frame: FrameChoice,
    /// Where hair grows.
    pub scalp: ScalpSource,
}

/// Where on a mesh hair grows.
#[derive(Clone, Debug, PartialEq)]
pub enum ScalpSource {
    /// To be guessed from the shape.
    Guess,
    /// On a group of faces, by name.
    Group(String),
    /// By what is painted on the vertices: `red`, `green`, `blue`, `alpha`, `brightness`, or another name that the file has.
    Colour(String),
    /// Where a PNG over the texture coordinates is white.
    Mask(PathBuf),
    /// As a text file says, a number per vertex.
    Weights(PathBuf),
}

/// A head's mesh as it stands in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadMesh {
    /// The mesh, in metres, z up.
    pub surface: Surface,
    /// Density of hair at each vertex, 0 to 1; `None` where the scalp is to be guessed.
    pub scalp: Option<Vec<f64>>,
    /// The unit that it was taken to be in, where neither file nor scene said one and it cannot be metres.
    pub guessed_unit: Option<&'static str>,
}

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
        "`{}` is {} m across, and a head is between 5 cm and 3 m; {}",
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
        /// The group asked for.
        group: String,
        /// The groups there are.
        known: Vec<String>,
    },
    /// The file has no such number at its vertices.
    #[error("`{}` has no `{channel}` at its vertices; it has {}", path.display(), list(known))]
    NoChannel {
        /// The file.
        path: PathBuf,
        /// What was asked for.
        channel: String,
        /// What there is.
        known: Vec<String>,
    },
    /// Hair would grow nowhere.
    #[error("the scalp has no area: {what}")]
    NoScalp {
        /// What was asked for.
        what: String,
    },
}

impl HeadFileError {
    /// The key of a scene that has to change.
    #[must_use]
    pub fn key(&self, head: &HeadFile) -> &'static str {
        let path = match self {
            Self::NoGroup { .. } => return "head.scalp_group",
            Self::NoChannel { .. } => return "head.scalp_colour",
            Self::Size { .. } | Self::Surface { .. } => return "head.mesh",
            Self::NoScalp { .. } => None,
            Self::Line { path, .. } | Self::Format { path, .. } => Some(path),
            Self::Read(error) => Some(error.path()),
        };
        match &head.scalp {
            _ if path == Some(&head.path) => "head.mesh",
            ScalpSource::Guess => "head.mesh",
            ScalpSource::Group(_) => "head.scalp_group",
            ScalpSource::Colour(_) => "head.scalp_colour",
            ScalpSource::Mask(_) => "head.scalp_mask",
            ScalpSource::Weights(_) => "head.scalp_weights",
        }
    }
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
    let units = [("m", 1.0), ("dm", 0.1), ("in", 0.0254), ("cm", 0.01), ("mm", 0.001)];
    let sensible = |&&(_, u): &&(&str, f64)| {
        let metres = size / scale * u;
        (0.15..0.8).contains(&metres)
    };
    match units.iter().find(sensible) {
        Some((name, _)) => format!("is it in \"{name}\"? set `unit = \"{name}\"`"),
        None => "set `scale`, in metres per unit of the mesh".into(),
    }
}

/// Reads a head and its scalp.
///
/// # Errors
/// [`HeadFileError`].
pub fn read(head: &HeadFile, files: &Files) -> Result<HeadMesh, HeadFileError> {
    let path = &head.path;
    let mesh = parse(path, files)?;
    if mesh.triangles.is_empty() {
        let problem = if mesh.positions.is_empty() {
            "it has no vertices"
        } else {
            "it has vertices and no faces"
        };
        return Err(not_a_mesh(path, problem));
    }
    let (frame, guessed_unit) = frame(&mesh, head.frame);
    let metres = |p: &[f64; 3]| frame.position_from_file(DVec3::from_array(*p));
    let positions: Vec<DVec3> = mesh.positions.iter().map(metres).collect();
    // Before anything is computed from coordinates: the squares of huge ones overflow.
    let size = extent(&positions, &mesh.triangles);
    if size > 0.0 && !(size >= SENSIBLE.0 && size <= SENSIBLE.1) {
        return Err(HeadFileError::Size { path: path.clone(), size, scale: frame.metres });
    }
    let surface = Surface::new(positions, mesh.triangles.clone())
        .map_err(|source| HeadFileError::Surface { path: path.clone(), source })?;
    let scalp = match &head.scalp {
        ScalpSource::Guess => None,
        ScalpSource::Group(name) => Some(scalp::from_group(&mesh, name, path)?),
        ScalpSource::Colour(name) => Some(scalp::from_channel(&mesh, name, path)?),
        ScalpSource::Mask(mask) => Some(scalp::from_mask(&mesh, (mask, files), path)?),
        ScalpSource::Weights(weights) => Some(scalp::from_text(&mesh, weights, files)?),
    };
    if let Some(weights) = &scalp {
        check_area(&surface, weights, &head.scalp)?;
    }
    Ok(HeadMesh { surface, scalp, guessed_unit })
}

/// The mesh of a file, of the format that its first bytes tell.
fn parse(path: &Path, files: &Files) -> Result<Mesh, HeadFileError> {
    let bytes = files.read_bytes(path, MAX_SIZE, "a mesh")?;
    let (expected, mesh) = if frisure_usd::is_one(&bytes) {
        ("a USD stage with meshes", usd::parse(&bytes))
    } else if bytes.starts_with(b"ply") {
        ("a PLY mesh", ply::parse(&bytes))
    } else if bytes.starts_with(b"glTF") || bytes.trim_ascii_start().starts_with(b"{") {
        let beside = |name: &str| {
            // Only what lies with it: a mesh from elsewhere is not to look around.
            let within = |part| matches!(part, Component::Normal(_));
            if !Path::new(name).components().all(within) {
                return Err(format!("`{name}` is not beside it"));
            }
            let file = path.parent().unwrap_or(Path::new("")).join(name);
            files.read_bytes(&file, MAX_SIZE, "a buffer").map_err(|e| e.to_string())
        };
        ("a glTF mesh", gltf::parse(&bytes, &beside))
    } else {
        let text = to_text(bytes, path)?;
        return obj::parse(&text).map_err(|(line, problem)| {
            let path = path.into();
            HeadFileError::Line { path, line, problem }
        });
    };
    mesh.map_err(|problem| HeadFileError::Format { path: path.into(), expected, problem })
}

/// Unit and axes of a mesh: as told, else as the file has them, else as its format has them and its size lets it be.
fn frame(mesh: &Mesh, told: FrameChoice) -> (Frame, Option<&'static str>) {
    let usual = mesh.frame.unwrap_or(Frame::METRES_Y);
    let frame = told.or(usual);
    if told.metres.is_some() || mesh.tells_unit {
        return (frame, None);
    }
    let raw: Vec<DVec3> = mesh.positions.iter().map(|p| DVec3::from_array(*p)).collect();
    let size = extent(&raw, &mesh.triangles);
    if (SENSIBLE.0..=SENSIBLE.1).contains(&(size * frame.metres)) {
        return (frame, None);
    }
    // The commonest first: 25 units are rather centimetres than inches.
    let units = [("cm", 0.01), ("mm", 0.001), ("in", 0.0254), ("dm", 0.1)];
    let usual_size = |(_, metres): &&(&str, f64)| (0.15..0.8).contains(&(size * metres));
    match units.iter().find(usual_size) {
        Some((name, metres)) => (Frame { metres: *metres, ..frame }, Some(name)),
        None => (frame, None),
    }
}

fn not_a_mesh(path: &Path, problem: impl Into<String>) -> HeadFileError {
    let (expected, problem) = ("an OBJ mesh", problem.into());
    HeadFileError::Format { path: path.into(), expected, problem }
}

/// Longest side of the box around the vertices that faces use: files keep strays of what was cut
/// away.
fn extent(positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let used = triangles.iter().flatten().map(|&v| positions[v as usize]);
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = used.fold(nothing, |(low, high), p| (low.min(p), high.max(p)));
    (high - low).max_element()
}

/// Refuses a scalp on which no face has any hair.
fn check_area(
    surface: &Surface,
    weights: &[f64],
    asked: &ScalpSource,
) -> Result<(), HeadFileError> {
    let area: f64 = (0..surface.triangles().len())
        .map(|i| {
            let density: f64 = surface.triangles()[i].iter().map(|&v| weights[v as usize]).sum();
            density / 3.0 * 0.5 * surface.doubled_area_vector(i).length()
        })
        .sum();
    if area > 0.0 {
        return Ok(());
    }
    let what = match asked {
        ScalpSource::Guess => "no vertex has hair".to_owned(),
        ScalpSource::Group(name) => format!("no face of group `{name}` has an area"),
        ScalpSource::Colour(name) => format!("`{name}` is 0 everywhere on the mesh"),
        ScalpSource::Mask(path) => format!("`{}` is black everywhere on the mesh", path.display()),
        ScalpSource::Weights(path) => format!("every weight in `{}` is 0", path.display()),
    };
    Err(HeadFileError::NoScalp { what })
}

#[cfg(test)]
mod tests;
