//! The checkpoint digest: a number that identifies a picture.

/// The 64-bit FNV-1a hash (Fowler, Noll and Vo) over words of eight bytes.
#[derive(Clone, Debug)]
pub(super) struct Digest(u64);

impl Digest {
    pub(super) fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// The digest of some bytes.
    pub(super) fn of(bytes: &[u8]) -> u64 {
        let mut all = Self::new();
        all.put(bytes);
        all.value()
    }

    /// Adds bytes, and how many they are.
    pub(super) fn put(&mut self, bytes: &[u8]) {
        let (words, rest) = bytes.as_chunks::<8>();
        words.iter().for_each(|word| self.word(u64::from_le_bytes(*word)));
        rest.iter().for_each(|byte| self.word(u64::from(*byte)));
        self.word(bytes.len() as u64);
    }

    /// Adds a named field.
    pub(super) fn field<const N: usize, const B: usize>(
        &mut self,
        name: &str,
        values: [[u8; B]; N],
    ) {
        self.put(name.as_bytes());
        self.put(values.as_flattened());
    }

    fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3);
        // Multiplying only carries upwards.
        self.0 ^= self.0 >> 32;
    }

    pub(super) fn value(&self) -> u64 {
        self.0
    }
}
