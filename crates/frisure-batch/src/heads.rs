//! The heads that hair grows on, each made once.

use std::sync::{Arc, Mutex, PoisonError};

use frisure::files::Files;
use frisure::hairstyle::head::Head;
use frisure::scene::{HeadSource, Scene, SceneError};
use frisure_stylist::carry;

/// How many are remembered, some megabytes each.
const KEPT: usize = 8;

/// Heads by what scenes say of them; the last used at the end.
#[derive(Debug, Default)]
pub(crate) struct Heads(Mutex<Vec<(HeadSource, Arc<Head>)>>);

impl Heads {
    /// The head of a scene.
    pub(crate) fn of(&self, scene: &Scene) -> Result<Arc<Head>, SceneError> {
        if let Some(head) = self.known(&scene.head) {
            return Ok(head);
        }
        // Made without holding the lock: making one runs on all threads, which may come here meanwhile.
        let head = Arc::new(carry::head(scene, &Files::default())?.0);
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if known.len() >= KEPT {
            known.remove(0);
        }
        known.push((scene.head.clone(), head.clone()));
        Ok(head)
    }

    fn known(&self, source: &HeadSource) -> Option<Arc<Head>> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = known.iter().position(|(other, _)| other == source)?;
        let used = known.remove(place);
        let head = used.1.clone();
        known.push(used);
        Some(head)
    }
}
