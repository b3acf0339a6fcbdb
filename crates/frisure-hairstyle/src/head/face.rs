//! The faces of people: features that differ from those of their model, drawn by a seed.

use glam::DVec3;

use super::packed::Reader;
use crate::random::{Purpose, Stream};

/// What each feature moves, and how far at one standard deviation; `heads/make.py` has the names and the deviations.
const FEATURES: &[u8] = include_bytes!("../../heads/features.bin");

/// The most that a feature differs (standard deviations). Chosen: with more, lips and lids come apart.
const MOST: f64 = 2.0;

/// Moves what a head has in its file (m): its vertices, and then its places in the order of the file. The face 0 is that of the model.
pub(super) fn vary(face: u32, places: &mut [DVec3]) {
    if face == 0 {
        return;
    }
    let mut file = Reader(FEATURES);
    for feature in 0..usize::from(file.u16()) {
        let step = f64::from(file.f32());
        let rows = usize::from(file.u16());
        let (moved, ways) = (file.columns::<1>(rows), file.columns::<3>(rows));
        // A stream for each feature: one more of them leaves the others as they are.
        let normal = Stream::new(face.into(), Purpose::Feature, feature).normal();
        let size = step * normal.clamp(-MOST, MOST);
        for ([place], way) in moved.into_iter().zip(ways) {
            let way = way.map(|steps| f64::from(steps.cast_signed()));
            places[usize::from(place)] += size * DVec3::from_array(way);
        }
    }
}
