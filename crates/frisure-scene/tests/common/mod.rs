//! Scenes as texts, and what is said about them.

#![allow(dead_code, reason = "each test file uses some of these")]

use std::path::Path;

use frisure_scene::{Diagnostic, Scene, SceneError};

pub(crate) fn parse(text: &str) -> Result<Scene, SceneError> {
    Scene::parse("scene.toml", text, Path::new("scenes"))
}

pub(crate) fn good(text: &str) -> Scene {
    parse(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// What is wrong with a scene, for a whole head or for one hair.
pub(crate) fn diagnostic(text: &str) -> Diagnostic {
    let error = match parse(text) {
        Err(error) => error,
        Ok(scene) => match (scene.hairstyle_spec(), scene.single_hair()) {
            (Err(error), _) | (_, Err(error)) => error,
            _ => panic!("this should be refused:\n{text}"),
        },
    };
    error.diagnostic().unwrap_or_else(|| panic!("{error}")).clone()
}
