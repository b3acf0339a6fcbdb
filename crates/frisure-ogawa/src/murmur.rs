//! `MurmurHash3` (x64, 128 bits, seed 0), the digest that Alembic stores with each sample.
//!
//! Part of the file format, so that readers find equal samples; nothing else uses it.
//! Source: Austin Appleby, `MurmurHash3.cpp`, in the public domain.

const C1: u64 = 0x87c3_7b91_1142_53d5;
const C2: u64 = 0x4cf5_ad43_2745_937f;

/// The digest of `bytes`.
pub(crate) fn murmur3(bytes: &[u8]) -> [u8; 16] {
    let (mut h1, mut h2) = (0_u64, 0_u64);
    let (blocks, tail) = bytes.as_chunks::<16>();
    for block in blocks {
        let [k1, k2] = halves(block);
        h1 ^= first(k1);
        h1 = h1.rotate_left(27).wrapping_add(h2).wrapping_mul(5).wrapping_add(0x52dc_e729);
        h2 ^= second(k2);
        h2 = h2.rotate_left(31).wrapping_add(h1).wrapping_mul(5).wrapping_add(0x3849_5ab5);
    }
    let mut last = [0; 16];
    last[..tail.len()].copy_from_slice(tail);
    // Zeros hash to zero, so that an absent tail needs no branch.
    let [k1, k2] = halves(&last);
    h1 ^= first(k1) ^ bytes.len() as u64;
    h2 ^= second(k2) ^ bytes.len() as u64;
    h1 = h1.wrapping_add(h2);
    h2 = h2.wrapping_add(h1);
    (h1, h2) = (mixed(h1), mixed(h2));
    h1 = h1.wrapping_add(h2);
    h2 = h2.wrapping_add(h1);
    let mut out = [0; 16];
    out[..8].copy_from_slice(&h1.to_le_bytes());
    out[8..].copy_from_slice(&h2.to_le_bytes());
    out
}

fn halves(block: &[u8; 16]) -> [u64; 2] {
    let (words, _) = block.as_chunks();
    [u64::from_le_bytes(words[0]), u64::from_le_bytes(words[1])]
}

fn first(k: u64) -> u64 {
    k.wrapping_mul(C1).rotate_left(31).wrapping_mul(C2)
}

fn second(k: u64) -> u64 {
    k.wrapping_mul(C2).rotate_left(33).wrapping_mul(C1)
}

fn mixed(mut h: u64) -> u64 {
    h ^= h >> 33;
    h = h.wrapping_mul(0xff51_afd7_ed55_8ccd);
    h ^= h >> 33;
    h = h.wrapping_mul(0xc4ce_b9fe_1a85_ec53);
    h ^ (h >> 33)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Digests in files of the Alembic library 1.8.12.
    #[test]
    fn digests_are_those_of_the_library() {
        let hex = |bytes: &[u8]| murmur3(bytes).map(|b| format!("{b:02x}")).concat();
        assert_eq!(hex(&[1]), "16fe7483905cce7a85670e43e4678877");
        assert_eq!(hex(b"ref\0"), "15adccc5d3cca8668555df10667d6599");
        assert_eq!(hex(&[3, 0, 0, 0, 3, 0, 0, 0]), "1171dea6747ab509fdaefbe74f7195af");
        let matrix = [1.0_f64, 2.0, 3.0].map(f64::to_le_bytes);
        assert_eq!(hex(matrix.as_flattened()), "715f49c2e26036e859c9a5bb9c4ffd7a");
    }
}
