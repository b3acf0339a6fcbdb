//! The accessories of a hairstyle.

use super::accessory::Accessory;
use super::{elastics, pins, rollers, ties};
use crate::hairstyle::{Hairstyle, WispState};
use crate::head::Head;

/// Computes the objects that hold the hair of a hairstyle on its head; none where nothing is held.
///
/// The same hairstyle gives the same objects: first rollers, then ties, elastics, pins and clips, each in the order of their wisps.
///
/// ```
/// use frisure_hairstyle::styling::{Operation, Release, Tie};
/// use frisure_hairstyle::{
///     AccessoryKind, PredictOptions, StyleOptions, accessories, head::Head, predict, preset, style,
/// };
///
/// let mut spec = preset("caucasian-straight").expect("a preset").spec();
/// (spec.wisps.count, spec.length.mean) = (20, 0.4);
/// let head = Head::mannequin();
/// let free = predict(&spec, &head, PredictOptions::default(), &())?;
/// let tied = style(&free, &head, &Tie::default().into(), StyleOptions::default(), &())?;
/// let found = accessories(&tied, &head);
/// assert_eq!(found.len(), 1);
/// assert_eq!(found[0].kind, AccessoryKind::Tie);
/// assert!(accessories(&free, &head).is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn accessories(hairstyle: &Hairstyle, head: &Head) -> Vec<Accessory> {
    if !hairstyle.wisps().iter().any(WispState::is_held) {
        return Vec::new();
    }
    let mut all = rollers::rollers(hairstyle, head);
    all.extend(ties::ties(hairstyle, head));
    all.extend(elastics::elastics(hairstyle, head));
    all.extend(pins::pins(hairstyle, head));
    all
}
