//! Radiances of vertices of hair that have been computed: the pieces on both sides of a vertex need it, and pieces in several tiles.

use std::sync::atomic::{AtomicU32, Ordering};

use glam::Vec3;
use rayon::prelude::*;

/// A radiance for each vertex, computed when it is first asked for.
///
/// Each value is a function of its vertex alone, so that it makes no difference which thread computes it, or that two do.
pub(super) struct RadianceCache {
    /// Bits of red, green and blue, each plus one: 0 where blue is not known, and where blue is known all are.
    known: Vec<[AtomicU32; 3]>,
}

impl RadianceCache {
    /// An empty cache for vertices `0..count`.
    pub(super) fn new(count: usize) -> Self {
        let unknown = |_| [0; 3].map(AtomicU32::new);
        Self { known: (0..count).into_par_iter().map(unknown).collect() }
    }

    /// The radiance of vertex `index`, which `compute` gives where it is not known.
    pub(super) fn get(&self, index: usize, compute: impl FnOnce() -> Vec3) -> Vec3 {
        let [red, green, blue] = &self.known[index];
        let value = |bits: u32| f32::from_bits(bits.wrapping_sub(1));
        // Pairs with the release below: red and green were written before blue.
        match blue.load(Ordering::Acquire) {
            0 => {
                let radiance = compute();
                let bits = radiance.to_array().map(|x| x.to_bits().wrapping_add(1));
                red.store(bits[0], Ordering::Relaxed);
                green.store(bits[1], Ordering::Relaxed);
                blue.store(bits[2], Ordering::Release);
                radiance
            }
            known => {
                let [red, green] = [red, green].map(|x| value(x.load(Ordering::Relaxed)));
                Vec3::new(red, green, value(known))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_radiance_is_computed_once() {
        let cache = RadianceCache::new(3);
        let radiance = Vec3::new(0.0, 0.25, 1e3);
        assert_eq!(cache.get(1, || radiance), radiance);
        assert_eq!(cache.get(1, || panic!("it is known")), radiance);
        assert_eq!(cache.get(2, || Vec3::ZERO), Vec3::ZERO);
        assert_eq!(cache.get(2, || panic!("black is known, too")), Vec3::ZERO);
    }
}
