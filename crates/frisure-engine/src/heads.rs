//! The heads of scenes, each loaded once.

use std::sync::{Arc, LazyLock, Mutex, PoisonError};

use frisure::files::{Files, Stamp};
use frisure::hairstyle::head::{Head, ScalpSource};
use frisure::scene::{HeadSource, Scene, SceneError};

use crate::inputs::{head_files, head_mesh, head_note};

/// Most heads in the cache, some megabytes each; chosen.
const CAPACITY: usize = 8;

/// The built-in head, which takes a second to make.
static MANNEQUIN: LazyLock<Arc<Head>> = LazyLock::new(|| Arc::new(Head::mannequin()));

/// The head of a scene.
#[derive(Clone, Debug)]
pub struct LoadedHead {
    /// The head.
    pub head: Arc<Head>,
    /// What was guessed of it, for a person.
    pub note: Option<String>,
}

/// Heads by their description in scenes; shared by threads.
#[derive(Debug, Default)]
pub struct HeadCache {
    /// The last used at the end.
    entries: Mutex<Vec<Entry>>,
}

#[derive(Debug)]
struct Entry {
    source: HeadSource,
    /// Of its files: a mesh may be edited meanwhile.
    stamps: Vec<Option<Stamp>>,
    head: LoadedHead,
}

impl HeadCache {
    /// The head of a scene: the same one as long as the scene and its files are the same.
    ///
    /// # Errors
    /// [`SceneError`] at the key of the scene that has to change.
    pub fn load(&self, scene: &Scene, files: &Files) -> Result<LoadedHead, SceneError> {
        if scene.head == HeadSource::Mannequin {
            return Ok(LoadedHead { head: MANNEQUIN.clone(), note: None });
        }
        let stamps = stamps(&scene.head, files);
        if let Some(head) = self.find(&scene.head, &stamps) {
            return Ok(head);
        }
        // Loaded without the lock: loading runs on all threads, which may come here meanwhile.
        let head = load(scene, files)?;
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        if entries.len() >= CAPACITY {
            entries.remove(0);
        }
        entries.push(Entry { source: scene.head.clone(), stamps, head: head.clone() });
        Ok(head)
    }

    fn find(&self, source: &HeadSource, stamps: &[Option<Stamp>]) -> Option<LoadedHead> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let index = entries.iter().position(|e| e.source == *source && e.stamps == stamps)?;
        let used = entries.remove(index);
        let head = used.head.clone();
        entries.push(used);
        Some(head)
    }
}

fn load(scene: &Scene, files: &Files) -> Result<LoadedHead, SceneError> {
    let Some(mesh) = head_mesh(scene, files)? else {
        return Ok(LoadedHead { head: MANNEQUIN.clone(), note: None });
    };
    let note = head_note(scene, &mesh);
    let scalp = mesh.scalp.map_or(ScalpSource::Guess, ScalpSource::Weights);
    let head = Head::from_surface(mesh.surface, scalp);
    let head = head.map_err(|e| scene.error_at("head.mesh", e.to_string(), ""))?;
    Ok(LoadedHead { head: Arc::new(head), note })
}

fn stamps(source: &HeadSource, files: &Files) -> Vec<Option<Stamp>> {
    let HeadSource::Mesh(file) = source else { return Vec::new() };
    head_files(file).map(|path| files.stamp(path)).collect()
}
