//! The commands, one per file.

pub(crate) mod hair;
pub(crate) mod new;
pub(crate) mod predict;
pub(crate) mod presets;
pub(crate) mod schema;

use std::io::Read;
use std::path::Path;

use frisure::io::files;
use frisure::io::scene::{MAX_SIZE, Scene};

use crate::failure::Failure;

/// The scene in a file, or on standard input for `-`.
fn read_scene(path: &Path) -> Result<Scene, Failure> {
    if path != Path::new("-") {
        return Ok(Scene::read(path)?);
    }
    let name = Path::new("<stdin>");
    let mut bytes = Vec::new();
    let input = std::io::stdin().lock();
    input.take(MAX_SIZE + 1).read_to_end(&mut bytes).map_err(|e| Failure::failed(&e))?;
    if bytes.len() as u64 > MAX_SIZE {
        return Err(files::ReadError::TooLarge {
            path: name.into(),
            limit: MAX_SIZE,
            what: "a scene",
        }
        .into());
    }
    Ok(Scene::parse("<stdin>", files::to_text(bytes, name)?, Path::new(""))?)
}
