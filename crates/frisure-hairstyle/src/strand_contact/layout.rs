//! Where the joints and points of many hairs are in long arrays.

use std::ops::Range;

use glam::DVec3;

use crate::parallel;

/// Hairs of several numbers of joints, one after the other. A hair has one more point than joints.
pub(super) struct Layout {
    /// The first joint of each hair; one more than hairs.
    joints: Vec<u32>,
    /// Hairs that are worked on together: of as many joints.
    chunks: Vec<Range<usize>>,
}

/// Most hairs of a chunk: enough to fill vectors, few enough for all threads to have work. Chosen; no result depends on the number of
/// threads.
const CHUNK: usize = 128;

/// Values of a long list that are worked on together, and summed up by themselves. Chosen; no result depends on the number of threads.
pub(super) const BLOCK: usize = 4096;

impl Layout {
    /// Hairs of so many joints each, at least one.
    pub(super) fn new(counts: &[usize]) -> Self {
        let mut joints = vec![0];
        let mut chunks: Vec<Range<usize>> = Vec::new();
        for (strand, &count) in counts.iter().enumerate() {
            joints.push(joints[strand] + count as u32);
            match chunks.last_mut() {
                Some(chunk) if chunk.len() < CHUNK && counts[chunk.start] == count => {
                    chunk.end = strand + 1;
                }
                _ => chunks.push(strand..strand + 1),
            }
        }
        Self { joints, chunks }
    }

    pub(super) fn strands(&self) -> usize {
        self.joints.len() - 1
    }

    pub(super) fn chunks(&self) -> &[Range<usize>] {
        &self.chunks
    }

    pub(super) fn joints(&self, strand: usize) -> Range<usize> {
        self.joints[strand] as usize..self.joints[strand + 1] as usize
    }

    pub(super) fn points(&self, strand: usize) -> Range<usize> {
        let joints = self.joints(strand);
        joints.start + strand..joints.end + strand + 1
    }

    /// Joints of all hairs.
    pub(super) fn joint_count(&self) -> usize {
        self.joints[self.strands()] as usize
    }

    /// Points of all hairs.
    pub(super) fn point_count(&self) -> usize {
        self.joint_count() + self.strands()
    }

    /// A slice of values by hair, cut where chunks end.
    pub(super) fn by_strand<'a, T>(&self, values: &'a mut [T]) -> Vec<&'a mut [T]> {
        split_mut(values, self.chunks.iter().map(ExactSizeIterator::len))
    }

    /// A slice of values by joint, cut where chunks end.
    pub(super) fn by_joint<'a, T>(&self, values: &'a mut [T]) -> Vec<&'a mut [T]> {
        split_mut(values, self.chunks.iter().map(|c| c.clone().map(|s| self.joints(s).len()).sum()))
    }

    /// A slice of values by point, cut where chunks end.
    pub(super) fn by_point<'a, T>(&self, values: &'a mut [T]) -> Vec<&'a mut [T]> {
        split_mut(values, self.chunks.iter().map(|c| c.clone().map(|s| self.points(s).len()).sum()))
    }
}

/// The lowest and the highest corner of the box around these points.
pub(super) fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    let low = |points: &[DVec3]| points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = |points: &[DVec3]| points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    let blocks: Vec<&[DVec3]> = points.chunks(BLOCK).collect();
    let (lows, highs): (Vec<DVec3>, Vec<DVec3>) =
        parallel::map_slice(&blocks, |block| (low(block), high(block))).into_iter().unzip();
    (low(&lows), high(&highs))
}

/// A slice cut into pieces of these lengths.
pub(super) fn split_mut<T>(
    mut values: &mut [T],
    lengths: impl Iterator<Item = usize>,
) -> Vec<&mut [T]> {
    let mut pieces = Vec::new();
    for length in lengths {
        let (piece, rest) = values.split_at_mut(length);
        pieces.push(piece);
        values = rest;
    }
    pieces
}
