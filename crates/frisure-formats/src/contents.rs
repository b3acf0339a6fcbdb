//! What a file holds: a head, hair, or both.
//!
//! Extensions say which format a file has, and with most formats that is enough. Stages of USD, `.obj` and `.ply`
//! can hold either.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::accessory_names::OBJECT;
#[cfg(feature = "usd")]
use crate::accessory_names::PRIMVAR;
use crate::groom::{self, Format};
use crate::{head, ply};
use frisure_files::{Files, ReadError};
#[cfg(feature = "usd")]
use frisure_usd::{self as usd, Stage};

/// Whether a file has a head and hair.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Contents {
    /// It has a mesh that can be a head.
    pub head: bool,
    /// It has strands.
    pub groom: bool,
}

/// Why a file is of no use.
#[derive(Debug, Error)]
pub enum ContentsError {
    /// The extension is of no format of heads or grooms.
    #[error("`{}` is neither a head nor a groom that can be read", path.display())]
    Unknown {
        /// The path given.
        path: PathBuf,
    },
    /// The file cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file is damaged, or has nothing of use.
    #[error("`{}` is of no use: {what}", path.display())]
    Useless {
        /// The path given.
        path: PathBuf,
        /// What is wrong, or missing.
        what: String,
    },
}

/// The extensions of heads and grooms that are read, without dots, each once.
#[must_use]
pub fn extensions() -> Vec<&'static str> {
    let grooms = Format::ALL.iter().filter(|f| f.is_read()).flat_map(|f| f.extensions());
    let mut all: Vec<&str> = grooms.copied().chain(head::extensions()).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// What a file of this name can hold.
#[must_use]
pub fn by_name(path: &Path) -> Contents {
    let extension = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let head = extension.is_some_and(|e| head::extensions().any(|known| known == e));
    Contents { head, groom: Format::of(path).is_ok_and(Format::is_read) }
}

/// What a file holds. Only as much of it is read as that needs; reading it finds further errors.
///
/// An `.obj` or `.ply` with faces is a head, also where it has lines besides: programs write edges of meshes so. A stage
/// of USD with meshes and curves is both.
///
/// # Errors
/// [`ContentsError`], for a file that cannot be read or has neither.
pub fn of(path: &Path, files: &Files) -> Result<Contents, ContentsError> {
    let named = by_name(path);
    match named {
        Contents { head: false, groom: false } => {
            return Err(ContentsError::Unknown { path: path.into() });
        }
        Contents { head: true, groom: true } => {}
        one if files.stamp(path).is_some() => return Ok(one),
        // Reading it gives the error.
        _ => {}
    }
    let bytes = files.read_bytes(path, groom::MAX_SIZE, "a groom or a head")?;
    let found = if let Some(found) = stage(&bytes) {
        found
    } else if bytes.starts_with(b"ply") {
        polygons(&bytes)
    } else {
        Ok(wavefront(&bytes))
    };
    let useless = |what: String| ContentsError::Useless { path: path.into(), what };
    match found.map_err(useless)? {
        Contents { head: false, groom: false } => {
            Err(useless("it has neither faces nor lines".into()))
        }
        found => Ok(found),
    }
}

/// The contents of a stage of USD; nothing for other files.
#[cfg(feature = "usd")]
fn stage(bytes: &[u8]) -> Option<Result<Contents, String>> {
    usd::is_usd(bytes).then(|| stage_contents(bytes))
}

#[cfg(not(feature = "usd"))]
fn stage(_: &[u8]) -> Option<Result<Contents, String>> {
    None
}

#[cfg(feature = "usd")]
fn stage_contents(bytes: &[u8]) -> Result<Contents, String> {
    let layer = usd::read(bytes)?;
    let stage = Stage::of(&layer)?;
    // What holds the hair of a groom is no head.
    let is_head = |place: &usd::StagePrim| {
        let own = !place.is_guide && place.prim.attribute(PRIMVAR).is_none();
        own && place.prim.type_name == "Mesh"
    };
    let guides = stage.prims.iter().any(|place| CURVES.contains(&place.prim.type_name.as_str()));
    let found = Contents { head: stage.prims.iter().any(is_head), groom: guides };
    match found {
        Contents { head: false, groom: false } => {
            Err(format!("it has neither meshes nor curves{}", stage.hint()))
        }
        found => Ok(found),
    }
}

/// Types of prims that are strands.
#[cfg(feature = "usd")]
const CURVES: [&str; 2] = ["BasisCurves", "NurbsCurves"];

fn polygons(bytes: &[u8]) -> Result<Contents, String> {
    let (elements, _) = ply::open(bytes)?;
    let has = |name: &str| elements.iter().any(|e| e.name == name && e.count > 0);
    // Points that stand in rows are strands, too.
    let (head, points) = (has("face"), has("vertex"));
    Ok(Contents { head, groom: points && !head })
}

fn wavefront(bytes: &[u8]) -> Contents {
    let mut lines = bytes.split(|b| *b == b'\n').map(<[u8]>::trim_ascii_start);
    let begins =
        |line: &[u8], letter| line.len() > 1 && line[0] == letter && line[1].is_ascii_whitespace();
    let (mut groom, mut accessory) = (false, false);
    let head = lines.any(|line| {
        groom |= begins(line, b'l');
        if begins(line, b'o') {
            accessory = line[1..].trim_ascii().starts_with(OBJECT.as_bytes());
        }
        begins(line, b'f') && !accessory
    });
    Contents { head, groom: groom && !head }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: Contents = Contents { head: true, groom: false };
    const GROOM: Contents = Contents { head: false, groom: true };

    fn given(name: &str, bytes: &[u8]) -> Result<Contents, String> {
        let mut files = Files::default();
        files.provide(name, bytes);
        of(Path::new(name), &files).map_err(|e| e.to_string())
    }

    #[test]
    fn names_are_enough_for_most() {
        for name in ["a.hair", "a.ABC", "a.npz", "a.data"] {
            assert_eq!(given(name, b"").unwrap(), GROOM, "{name}");
        }
        for name in ["a.glb", "a.GLTF"] {
            assert_eq!(given(name, b"").unwrap(), HEAD, "{name}");
        }
        let missing = of(Path::new("nowhere.abc"), &Files::default()).unwrap_err();
        assert!(matches!(missing, ContentsError::Read(_)), "{missing}");
        for name in ["a.png", "a", "a.pbrt", ".obj"] {
            assert!(given(name, b"l 1 2").unwrap_err().contains("neither"), "{name}");
        }
    }

    #[test]
    fn wavefront_files_are_told_by_their_lines() {
        assert_eq!(given("a.obj", b"v 0 0 0\n  f 1 2 3\n").unwrap(), HEAD);
        assert_eq!(given("a.obj", b"v 0 0 0\nv 1 1 1\r\nl 1 2\r\n").unwrap(), GROOM);
        assert_eq!(given("a.obj", b"v 0 0 0\nl 1 2\nf 1 2 3\n").unwrap(), HEAD);
        for nothing in ["", "fl", "v 1 2 3\n# f\n", "l"] {
            let error = given("a.obj", nothing.as_bytes()).unwrap_err();
            assert!(error.ends_with("neither faces nor lines"), "{error}");
        }
    }

    #[test]
    fn polygons_are_told_by_their_header() {
        let file = |faces: usize| {
            format!(
                "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nelement edge 1\n\
                 property int vertex1\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
            )
        };
        assert_eq!(given("a.ply", file(0).as_bytes()).unwrap(), GROOM);
        assert_eq!(given("a.ply", file(3).as_bytes()).unwrap(), HEAD);
        assert!(given("a.ply", b"ply\nformat").unwrap_err().contains("a.ply"));
    }

    #[test]
    fn stages_are_told_by_their_prims() {
        let mesh = "def Mesh \"a\"\n{\n}\n";
        let curves = "def Xform \"x\"\n{\n def BasisCurves \"Mesh\"\n {\n uniform token purpose = \"guide\"\n }\n}\n";
        let stage = |prims: &str| given("a.usd", format!("#usda 1.0\n{prims}").as_bytes());
        assert_eq!(stage(mesh).unwrap(), HEAD);
        assert_eq!(stage(curves).unwrap(), GROOM);
        assert_eq!(
            stage(&format!("{mesh}{curves}")).unwrap(),
            Contents { head: true, groom: true }
        );
        assert!(
            stage("def Xform \"Mesh\"\n{\n}\n").unwrap_err().contains("neither meshes nor curves")
        );
        assert!(stage("def {").is_err());
    }
}
