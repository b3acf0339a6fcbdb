//! Which files a head is in, as a scene names them.

use std::path::PathBuf;

use crate::frame::FrameChoice;

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
