//! Pieces of hair by their depth.

use glam::Vec3;
use rayon::prelude::*;

use super::curves::Place;

/// Bins of depth. Chosen.
const BINS: usize = 1 << 13;

/// The first vertices of pieces, those nearest to the eye first, and the depth (m) at which each part of the
/// list begins.
pub(crate) struct Nearest {
    pub(crate) pieces: Vec<u32>,
    nearest: f32,
    step: f32,
    /// Pieces nearer than each step.
    before: Vec<u32>,
}

impl Nearest {
    /// Sorts the first `strands` of the strands whose vertices begin at `firsts`.
    pub(super) fn new(
        places: &[Place],
        firsts: &[u32],
        strands: usize,
        eye: Vec3,
        forward: Vec3,
    ) -> Self {
        let strands = strands.min(firsts.len().saturating_sub(1));
        let end = firsts.get(strands).copied().unwrap_or(0) as usize;
        let depth = |p: &Place| (Vec3::from_slice(p) - eye).dot(forward);
        let depths: Vec<f32> = places[..end].par_iter().with_min_len(4096).map(depth).collect();
        let (nearest, farthest) = depths
            .par_iter()
            .with_min_len(4096)
            .fold(|| (f32::INFINITY, 0.0_f32), |(low, high), &d| (low.min(d), high.max(d)))
            .reduce(|| (f32::INFINITY, 0.0), |a, b| (a.0.min(b.0), a.1.max(b.1)));
        let step = ((farthest - nearest) / (BINS - 1) as f32).max(1e-7);
        let inverse = 0.5 / step;
        // The cast saturates.
        let bin = |i: usize| {
            (((depths[i] + depths[i + 1] - 2.0 * nearest) * inverse) as usize).min(BINS - 1)
        };
        let mut before = vec![0_u32; BINS + 1];
        each_piece(firsts, strands, |i| before[bin(i) + 1] += 1);
        for i in 0..BINS {
            before[i + 1] += before[i];
        }
        let mut next = before.clone();
        let mut pieces = vec![0; before[BINS] as usize];
        each_piece(firsts, strands, |i| {
            let place = &mut next[bin(i)];
            pieces[*place as usize] = i as u32;
            *place += 1;
        });
        Self { pieces, nearest, step, before }
    }

    /// Depth (m) of the piece at a place in the list.
    pub(crate) fn depth(&self, place: usize) -> f32 {
        let bin = self.before.partition_point(|&n| n as usize <= place).max(1) - 1;
        self.nearest + bin as f32 * self.step
    }
}

/// Visits the first vertex of each piece of the first strands.
fn each_piece(firsts: &[u32], strands: usize, mut visit: impl FnMut(usize)) {
    for ends in firsts[..=strands].windows(2) {
        for i in ends[0]..ends[1].saturating_sub(1) {
            visit(i as usize);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_nearer_comes_first() {
        let places: Vec<Place> =
            (0..100_u16).map(|i| [0.0, f32::from(i * 37 % 100), 0.0, 1.0]).collect();
        let firsts: Vec<u32> = (0..=50).map(|i| 2 * i).collect();
        let sorted = Nearest::new(&places, &firsts, 50, -Vec3::Y, Vec3::Y);
        assert_eq!(sorted.pieces.len(), 50);
        let depth = |&i: &u32| 0.5 * (places[i as usize][1] + places[i as usize + 1][1]) + 1.0;
        let depths: Vec<f32> = sorted.pieces.iter().map(depth).collect();
        assert!(depths.windows(2).all(|d| d[0] <= d[1] + sorted.step));
        assert!((sorted.depth(25) - depths[25]).abs() <= 2.0 * sorted.step);
    }

    #[test]
    fn no_hair_has_no_pieces() {
        assert!(Nearest::new(&[], &[0], 0, Vec3::ZERO, Vec3::Y).pieces.is_empty());
    }
}
