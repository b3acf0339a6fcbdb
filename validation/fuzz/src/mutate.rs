//! Files with mistakes in them, drawn from a seed.

use frisure::rod::SplitMix64;

/// Largest input (bytes). Chosen: mutations of small files reach as much code.
pub const LARGEST: usize = 1 << 14;

/// Words that readers treat specially, in text and in binary.
const WORDS: &[&[u8]] = &[
    b"nan",
    b"inf",
    b"-1",
    b"0",
    b"1e39",
    b"1e308",
    b"99999999999",
    b"\"",
    b"[",
    b"]",
    b"{",
    b"}",
    b"(",
    b")",
    b"=",
    b"\n",
    b"#",
    b".",
    b"/",
    b",",
    b"\xff\xff\xff\xff",
    b"\xff\xff\xff\x7f",
    b"\0\0\0\0",
    b"\0\0\x80\x7f",
    b"\xc3\xa9",
];

/// A number below an end, 0 if that is 0.
fn below(random: &mut SplitMix64, end: usize) -> usize {
    (random.unit() * end as f64) as usize
}

/// An input of a corpus with one to five mistakes in it: bits, bytes, words that readers treat specially, parts left out,
/// repeated, or taken from another file.
///
/// # Panics
/// If the corpus is empty.
#[must_use]
pub fn mutated(corpus: &[Vec<u8>], random: &mut SplitMix64) -> Vec<u8> {
    let mut bytes = corpus[below(random, corpus.len())].clone();
    for _ in 0..=below(random, 4) {
        let at = below(random, bytes.len() + 1);
        let end = (at + 1 + below(random, 12)).min(bytes.len());
        match below(random, 7) {
            0 if at < bytes.len() => bytes[at] ^= 1 << below(random, 8),
            1 if at < bytes.len() => bytes[at] = below(random, 256) as u8,
            2 => drop(bytes.drain(at..end)),
            3 => bytes.truncate(at),
            4 => {
                let part = bytes[at..end].to_vec();
                let times = 1 + below(random, 20);
                drop(bytes.splice(at..at, part.repeat(times)));
            }
            5 => {
                let other = &corpus[below(random, corpus.len())];
                let from = below(random, other.len());
                let part = other[from..(from + 40).min(other.len())].to_vec();
                drop(bytes.splice(at..end, part));
            }
            _ => drop(bytes.splice(at..end, WORDS[below(random, WORDS.len())].iter().copied())),
        }
    }
    bytes.truncate(LARGEST);
    bytes
}
