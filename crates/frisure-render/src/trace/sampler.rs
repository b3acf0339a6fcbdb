//! The sampler: the random numbers of one sample of one pixel, independent of threads.
//!
//! The first two dimensions of the Sobol' sequence, in pairs that are shuffled and Owen-scrambled for each pixel
//! and each pair by hashing (Burley 2020, *Practical hash-based Owen scrambling*, §3 and listing 1).

use crate::hash::mix;

/// The random numbers of one sample of one pixel.
#[derive(Clone, Debug)]
pub(super) struct Sampler {
    pixel: u32,
    index: u32,
    pair: u32,
}

impl Sampler {
    pub(super) fn new(seed: u32, pixel: u32, index: u32) -> Self {
        Self { pixel: mix(pixel ^ mix(seed)), index, pair: 0 }
    }

    /// Two numbers in [0, 1).
    pub(super) fn pair(&mut self) -> [f32; 2] {
        // Golden-ratio steps keep the keys of successive pairs far apart; the two constants below only differ.
        let key = mix(self.pixel ^ mix(self.pair.wrapping_mul(0x9e37_79b9)));
        self.pair += 1;
        // The order of the points is shuffled within powers of two, so that every such block stays stratified.
        let index = scrambled(self.index, key);
        let x = scrambled(index.reverse_bits(), mix(key ^ 0xa511_e9b3));
        let y = scrambled(second(index), mix(key ^ 0x63d8_3595));
        [unit(x), unit(y)]
    }

    /// One number in [0, 1).
    pub(super) fn one(&mut self) -> f32 {
        self.pair()[0]
    }
}

/// Nested uniform scrambling of a fraction of 32 bits (Laine & Karras 2011, with the constants of Burley 2020).
fn scrambled(x: u32, key: u32) -> u32 {
    let mut x = x.reverse_bits();
    x = x.wrapping_add(key);
    x ^= x.wrapping_mul(0x6c50_b47c);
    x ^= x.wrapping_mul(0xb82f_1e52);
    x ^= x.wrapping_mul(0xc7af_e638);
    x ^= x.wrapping_mul(0x8d22_f6e6);
    x.reverse_bits()
}

/// The second dimension of Sobol's sequence, whose matrix is Pascal's triangle modulo 2.
fn second(index: u32) -> u32 {
    let (mut x, mut column, mut index) = (0, 1_u32 << 31, index);
    while index != 0 {
        if index & 1 != 0 {
            x ^= column;
        }
        column ^= column >> 1;
        index >>= 1;
    }
    x
}

fn unit(x: u32) -> f32 {
    (x >> 8) as f32 / (1_u32 << 24) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pairs_are_stratified() {
        // Any 256 samples of a pair that begin at a multiple of 256 have one in each of 16 × 16 cells.
        let mut seen = [false; 256];
        for index in 0..256 {
            let mut sampler = Sampler::new(7, 3, index);
            sampler.pair();
            let [x, y] = sampler.pair();
            seen[(x * 16.0) as usize * 16 + (y * 16.0) as usize] = true;
        }
        assert!(seen.iter().all(|cell| *cell));
    }
}
