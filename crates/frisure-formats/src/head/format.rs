//! The declaration of a format of heads.

use super::mesh::Mesh;

/// Returns the bytes of another file, by its name in the one that is read.
pub(super) type Beside<'a> = &'a dyn Fn(&str) -> Result<Vec<u8>, String>;

/// A format of meshes.
pub(super) struct MeshFormat {
    /// The extensions that name it, without a dot.
    pub(super) extensions: &'static [&'static str],
    /// What errors expect, such as `an OBJ mesh`.
    pub(super) expected: &'static str,
    /// Whether a file that begins so is of this format.
    pub(super) begins: fn(&[u8]) -> bool,
    /// Whether files are UTF-8 text.
    pub(super) is_text: bool,
    /// Reads a mesh.
    pub(super) read: fn(&[u8], Beside<'_>) -> Result<Mesh, Problem>,
}

/// A fault of a file.
#[derive(Debug, PartialEq)]
pub(super) struct Problem {
    /// The line, from 1, where it has one.
    pub(super) line: Option<usize>,
    /// What is wrong.
    pub(super) what: String,
}

impl From<String> for Problem {
    fn from(what: String) -> Self {
        Self { line: None, what }
    }
}
