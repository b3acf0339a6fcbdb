//! Which files a head is in, as a scene names them.

use std::path::PathBuf;

use glam::DVec3;

use crate::frame::FrameChoice;

/// A head in files.
#[derive(Clone, Debug, PartialEq)]
pub struct HeadFile {
    /// The mesh: OBJ, USD, glTF or PLY.
    pub path: PathBuf,
    /// Unit and axes, where the scene says them.
    pub frame: FrameChoice,
    /// Turns about the axes x, y and z of the upright head (rad), one after the other, where the scene says them.
    pub turn: Option<DVec3>,
    /// The part on which hair grows.
    pub scalp: ScalpSource,
}

impl HeadFile {
    /// A mesh with the unit and axes that it states, and a scalp that is guessed from its shape.
    #[must_use]
    pub fn new(path: PathBuf) -> Self {
        Self { path, frame: FrameChoice::default(), turn: None, scalp: ScalpSource::Guess }
    }
}

/// The part of a mesh on which hair grows.
#[derive(Clone, Debug, PartialEq)]
pub enum ScalpSource {
    /// A guess from the shape.
    Guess,
    /// A group of faces, by name.
    Group(String),
    /// Weights from numbers at the vertices: `red`, `green`, `blue`, `alpha`, `brightness`, or another name in the file.
    Colour(String),
    /// The white part of a PNG over the texture coordinates.
    Mask(PathBuf),
    /// Weights from a text file, a number per vertex.
    Weights(PathBuf),
}
