//! Heads: a mesh into a [`Surface`] with z up, and where on it hair grows.
//!
//! One module per format, recognised by the first bytes of a file; each gives a mesh as it stands there.

mod eyes;
mod format;
mod gltf;
mod mesh;
mod obj;
mod ply;
mod scalp;
mod source;
#[cfg(feature = "usd")]
mod usd;

use std::path::{Component, Path};

use frisure_files::frame::{Frame, FrameChoice, rotation};
pub use frisure_files::head::{HeadFile, ScalpSource};
use frisure_files::{Files, to_text};
use frisure_strands::{Features, Surface};
use glam::DVec3;

use format::{MeshFormat, Problem};
pub use mesh::Group;
use mesh::Mesh;
use source::not_a_mesh;
pub use source::{HeadFileError, MAX_SIZE};

/// The formats of heads; a new format is its own file, and its line here.
///
/// The first whose bytes a file begins with reads it. OBJ begins with anything and is the last.
static FORMATS: &[&MeshFormat] = &[
    #[cfg(feature = "usd")]
    &usd::FORMAT,
    &ply::FORMAT,
    &gltf::FORMAT,
    &obj::FORMAT,
];

/// The extensions that heads have, without a dot; the first bytes of a file decide its format.
pub fn extensions() -> impl Iterator<Item = &'static str> {
    FORMATS.iter().flat_map(|format| format.extensions).copied()
}

/// Sizes (m) that a head, with or without shoulders or a whole body, can have.
const SENSIBLE: (f64, f64) = (0.05, 2.5);

/// Largest area of all faces, over the square of the longest side of the box around them. Chosen: heads have 1 to 5, and
/// each layer of faces on each other makes the distance to the skin slower to compute.
const MOST_LAYERS: f64 = 100.0;

/// A head's mesh as it stands in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadMesh {
    /// The mesh, in metres, z up; with its eyes, if groups of faces named so lie on spheres.
    pub surface: Surface,
    /// Density of hair at each vertex, 0 to 1; `None` where the scalp is to be guessed.
    pub scalp: Option<Vec<f64>>,
    /// The unit that the reader assumed, if neither file nor scene states one and it cannot be metres.
    pub guessed_unit: Option<&'static str>,
    /// Smallest and largest texture coordinate, where a scalp mask was repeated because some are not between 0 and 1.
    pub mask_repeated: Option<[f64; 2]>,
}

/// Reads a head and its scalp, in the unit, the axes and the turns that it is given.
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
    let turn = head.turn.map(rotation);
    let metres = |p: &[f64; 3]| {
        let p = frame.position_from_file(DVec3::from_array(*p));
        turn.map_or(p, |turn| turn * p)
    };
    let positions: Vec<DVec3> = mesh.positions.iter().map(metres).collect();
    // Before anything is computed from coordinates: the squares of huge ones overflow.
    let size = extent(&positions, &mesh.triangles);
    if size > 0.0 && !(size >= SENSIBLE.0 && size <= SENSIBLE.1) {
        return Err(HeadFileError::Size { path: path.clone(), size, scale: frame.metres });
    }
    let area = total_area(&positions, &mesh.triangles);
    if area > MOST_LAYERS * size * size {
        let problem =
            format!("its faces have {area:.3} m² within {size:.3} m: they lie on each other");
        return Err(not_a_mesh(path, &problem));
    }
    let surface = Surface::new(positions, mesh.triangles.clone())
        .map_err(|source| HeadFileError::Surface { path: path.clone(), source })?;
    let surface = match mesh.texture() {
        Some(texture) => surface.clone().with_texture(texture).unwrap_or(surface),
        None => surface,
    };
    let eyes = eyes::find(&mesh, surface.positions());
    let surface = match eyes.is_empty() {
        true => surface,
        false => {
            let features = Features { eyes, ..Features::default() };
            surface.with_features(features).expect("it has no tints")
        }
    };
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
    let masked = matches!(head.scalp, ScalpSource::Mask(_));
    let mask_repeated = masked.then(|| scalp::beyond(&mesh)).flatten();
    Ok(HeadMesh { surface, scalp, guessed_unit, mask_repeated })
}

/// The mesh of a file, of the format that its first bytes decide.
fn parse(path: &Path, files: &Files) -> Result<Mesh, HeadFileError> {
    let bytes = files.read_bytes(path, MAX_SIZE, "a mesh")?;
    let beside = |name: &str| {
        // Only files in the same folder or below: a mesh cannot make the program read other files.
        let within = |part| matches!(part, Component::Normal(_));
        if !Path::new(name).components().all(within) {
            return Err(format!("`{name}` is not beside it"));
        }
        let file = path.parent().unwrap_or(Path::new("")).join(name);
        files.read_bytes(&file, MAX_SIZE, "a buffer").map_err(|e| e.to_string())
    };
    if bytes.starts_with(b"PK") && has_arrays(&bytes) {
        let problem = "it has arrays of NumPy, as a groom has, and no mesh".into();
        return Err(HeadFileError::Format { path: path.into(), expected: ANY, problem });
    }
    let format = FORMATS.iter().find(|format| (format.begins)(&bytes)).copied();
    let format = format.unwrap_or(&obj::FORMAT);
    let named =
        |extension: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(extension));
    if format.is_text && !format.extensions.iter().any(|e| named(e)) && !is_obj(&bytes) {
        let (expected, problem) = (ANY, "it begins as none of them does".into());
        return Err(HeadFileError::Format { path: path.into(), expected, problem });
    }
    // The error says which byte is not text.
    let bytes = if format.is_text { to_text(bytes, path)?.into_bytes() } else { bytes };
    (format.read)(&bytes, &beside).map_err(|Problem { line, what }| match line {
        Some(line) => HeadFileError::Line { path: path.into(), line, problem: what },
        None => {
            HeadFileError::Format { path: path.into(), expected: format.expected, problem: what }
        }
    })
}

/// What a file of a head is expected to be.
const ANY: &str = "a mesh that is read (OBJ, USD, glTF or PLY)";

/// Whether the first file of a zip is an array of `NumPy`: its name follows a header of 30 bytes.
fn has_arrays(zip: &[u8]) -> bool {
    let Some(&length) = zip.get(26..28).and_then(|b| b.first_chunk::<2>()) else { return false };
    let name = zip.get(30..).and_then(|rest| rest.get(..u16::from_le_bytes(length).into()));
    name.is_some_and(|name| name.ends_with(b".npy"))
}

/// Whether bytes are text with a vertex of OBJ, whatever the name of the file.
fn is_obj(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| {
        text.split(['\n', '\r']).any(|line| line.split_whitespace().next() == Some("v"))
    })
}

/// Unit and axes of a mesh: chosen by the caller, else stated in the file, else those of its format, or another unit in
/// which its size is that of a head.
fn frame(mesh: &Mesh, choice: FrameChoice) -> (Frame, Option<&'static str>) {
    let usual = mesh.frame.unwrap_or(Frame::METRES_Y);
    let frame = choice.or(usual);
    if choice.metres.is_some() || mesh.states_unit {
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

/// Longest side of the box around the vertices that faces use: files keep strays of what was cut
/// away.
fn extent(positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let used = triangles.iter().flatten().map(|&v| positions[v as usize]);
    let nothing = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = used.fold(nothing, |(low, high), p| (low.min(p), high.max(p)));
    (high - low).max_element()
}

/// The area of all faces (m²).
fn total_area(positions: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
    let area = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|v| positions[v as usize]);
        0.5 * (b - a).cross(c - a).length()
    };
    triangles.iter().map(area).sum()
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
