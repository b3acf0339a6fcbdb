//! Hashing of indices to random bits, where each strand and each sample needs its own in any order.

/// Mixes 32 bits: the finaliser of MurmurHash3 (Appleby 2011).
pub(crate) fn mix(mut x: u32) -> u32 {
    x = (x ^ (x >> 16)).wrapping_mul(0x85eb_ca6b);
    x = (x ^ (x >> 13)).wrapping_mul(0xc2b2_ae35);
    x ^ (x >> 16)
}
