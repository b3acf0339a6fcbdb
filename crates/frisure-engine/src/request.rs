//! What a [`crate::Session`] executes: plain data that can pass between threads and between a page and its workers.

use serde::{Deserialize, Serialize};

use crate::picture::Viewpoint;
use crate::quality::Quality;
#[cfg(doc)]
use crate::response::Response;

/// A scene as it is being edited.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneRef {
    /// Its name in errors: a path, or a name for a scene without a file.
    pub name: String,
    /// Its text (TOML), with all steps.
    pub text: String,
    /// The folder that paths in it are relative to.
    pub folder: String,
    /// How many of its steps are applied; the rest are undone.
    pub done: usize,
}

/// A request to a [`crate::Session`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Request {
    /// Provides a file that scenes name (a head, a scalp, an environment map), where there is no file
    /// system: by its path, or by its name alone. Response: [`Response::FileProvided`].
    ProvideFile {
        /// Its path, as scenes name it from their folder, or just its name.
        path: String,
        /// Its content.
        #[serde(with = "crate::bytes::whole")]
        bytes: Vec<u8>,
    },
    /// The kind of content of a file: a head, hair, or both. Response: [`Response::Contents`].
    Contents {
        /// Its path, or the name under which it was provided.
        path: String,
    },
    /// The hair to look at. Response: [`Response::Preview`].
    Preview {
        /// The scene.
        scene: SceneRef,
        /// The quality.
        quality: Quality,
    },
    /// The wisps that a step would act on. Response: [`Response::Selected`].
    Select {
        /// The scene.
        scene: SceneRef,
        /// The step (TOML, one line, such as `wet = { where = "fringe" }`).
        step: String,
    },
    /// One guide with its material frames. Response: [`Response::Guide`].
    Guide {
        /// The scene.
        scene: SceneRef,
        /// Its wisp.
        wisp: usize,
        /// Points along it, at least 2.
        points: usize,
    },
    /// All hairs as the bytes of a groom file. Response: [`Response::File`].
    Groom {
        /// The scene.
        scene: SceneRef,
        /// The extension that names the format, such as `hair`.
        format: String,
    },
    /// A traced picture. Responses: [`Response::PartialPicture`] while it grows, then [`Response::File`] (a PNG).
    Picture {
        /// The scene.
        scene: SceneRef,
        /// The camera; `None` is the scene's.
        viewpoint: Option<Viewpoint>,
        /// Pixels across and down.
        size: [usize; 2],
        /// Most paths per pixel.
        paths: usize,
        /// Noise at which sampling stops (part of a display's scale, such as 0.02).
        noise: f64,
    },
    /// Pictures around the head. Responses: [`Response::Progress`], then one [`Response::File`] (an animated
    /// PNG).
    Turntable {
        /// The scene.
        scene: SceneRef,
        /// The camera of the first; `None` is the scene's.
        viewpoint: Option<Viewpoint>,
        /// Pixels across and down.
        size: [usize; 2],
        /// Number of pictures.
        frames: usize,
    },
    /// A film of hairstyles one after the other, such as the steps of a session. Responses: [`Response::Progress`], then one
    /// [`Response::File`] (an animated PNG), named as the last scene.
    Film {
        /// The scenes, at least one; the hair of equal beginnings is computed once.
        scenes: Vec<SceneRef>,
        /// The camera; `None` is that of each scene.
        viewpoint: Option<Viewpoint>,
        /// Pixels across and down.
        size: [usize; 2],
    },
}
