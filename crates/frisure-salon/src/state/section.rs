//! Sections: named parts of the hair, shown or not, locked or not.

use frisure::hairstyle::styling::Selection;
use frisure_engine::StrandsData;

/// A section of the scene, and what the salon knows of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// Its name.
    pub name: String,
    /// Its wisps as the scene has them.
    pub(super) selection: Selection,
    /// Whether it is not shown.
    pub hidden: bool,
    /// Whether steps leave it as it is.
    pub locked: bool,
    /// Whether each wisp is in it; `None` until this is computed.
    pub wisps: Option<Vec<bool>>,
}

impl Section {
    /// How many wisps are in it.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        self.wisps.as_ref().map(|wisps| wisps.iter().filter(|is| **is).count())
    }
}

/// The hairs of wisps that are not hidden.
pub(super) fn shown(strands: &StrandsData, hidden: &[bool]) -> StrandsData {
    let is_hidden = |wisp: u32| hidden.get(wisp as usize).copied().unwrap_or(false);
    let mut kept = StrandsData { offsets: vec![0], ..StrandsData::default() };
    for (ends, guide) in strands.offsets.windows(2).zip(&strands.guide) {
        if is_hidden(*guide) {
            continue;
        }
        let points = ends[0] as usize..ends[1] as usize;
        kept.points.extend_from_slice(&strands.points[3 * points.start..3 * points.end]);
        kept.radii.extend(strands.radii.get(points.clone()).unwrap_or_default());
        kept.wetness.extend(strands.wetness.get(points.clone()).unwrap_or_default());
        kept.guide.push(*guide);
        let so_far = kept.offsets.last().copied().unwrap_or(0);
        kept.offsets.push(so_far + ends[1] - ends[0]);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_hairs_are_left_out_with_all_that_is_theirs() {
        let strands = StrandsData {
            offsets: vec![0, 2, 3, 5],
            points: (0..15).map(|i| i as f32).collect(),
            radii: vec![1.0, 2.0, 3.0, 4.0, 5.0],
            guide: vec![7, 0, 7],
            wetness: Vec::new(),
        };
        let mut hidden = vec![false; 8];
        assert_eq!(shown(&strands, &hidden), strands);
        hidden[0] = true;
        let kept = shown(&strands, &hidden);
        assert_eq!((kept.offsets, kept.guide), (vec![0, 2, 4], vec![7, 7]));
        assert_eq!(kept.radii, [1.0, 2.0, 4.0, 5.0]);
        assert_eq!(kept.points[6..], [9.0, 10.0, 11.0, 12.0, 13.0, 14.0]);
    }
}
