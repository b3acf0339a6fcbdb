//! The heads that scenes were last about.

use std::path::Path;
use std::sync::{Arc, LazyLock};

use frisure::files::{Files, Stamp};
use frisure::hairstyle::head::Head;
use frisure::scene::{HeadSource, ScalpSource, Scene, SceneError};

use crate::carry;

/// How many heads are remembered, some megabytes each.
const KEPT: usize = 3;

/// The built-in head, which takes a second to make.
static MANNEQUIN: LazyLock<Arc<Head>> = LazyLock::new(|| Arc::new(Head::mannequin()));

/// A head, and what had to be guessed of it.
pub(crate) type Noted = (Arc<Head>, Option<String>);

/// Heads by what scenes say of them.
#[derive(Debug, Default)]
pub(crate) struct Heads {
    /// The last used at the end.
    known: Vec<Known>,
}

#[derive(Debug)]
struct Known {
    source: HeadSource,
    /// Of its files: a mesh may be edited meanwhile.
    stamps: Vec<Option<Stamp>>,
    head: Noted,
}

impl Heads {
    /// The head of a scene: the same one for as long as the scene and its files say the same.
    pub(crate) fn of(&mut self, scene: &Scene, files: &Files) -> Result<Noted, SceneError> {
        if scene.head == HeadSource::Mannequin {
            return Ok((MANNEQUIN.clone(), None));
        }
        let stamps = stamps(&scene.head, files);
        let same = |known: &Known| known.source == scene.head && known.stamps == stamps;
        let known = match self.known.iter().position(same) {
            Some(place) => self.known.remove(place),
            None => {
                let (head, note) = carry::head(scene, files)?;
                Known { source: scene.head.clone(), stamps, head: (Arc::new(head), note) }
            }
        };
        let head = known.head.clone();
        self.known.push(known);
        if self.known.len() > KEPT {
            self.known.remove(0);
        }
        Ok(head)
    }
}

fn stamps(source: &HeadSource, files: &Files) -> Vec<Option<Stamp>> {
    let HeadSource::Mesh(file) = source else { return Vec::new() };
    let scalp = match &file.scalp {
        ScalpSource::Mask(path) | ScalpSource::Weights(path) => Some(path.as_path()),
        ScalpSource::Guess | ScalpSource::Group(_) | ScalpSource::Colour(_) => None,
    };
    let paths: [Option<&Path>; 2] = [Some(&file.path), scalp];
    paths.into_iter().flatten().map(|path| files.stamp(path)).collect()
}
