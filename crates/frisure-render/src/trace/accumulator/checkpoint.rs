//! Checkpoints: an accumulator as bytes.
//!
//! Little-endian: a magic number of eight bytes that holds the version, the digest, width and height, then for
//! each tile its number of samples and its pixels' sums, and a checksum of all before it.

use frisure_digest::checksum;
use glam::Vec3;
use thiserror::Error;

use super::{Accumulator, Pixel, Tile};
use crate::film::MAX_SIZE;
use crate::trace::options::{MAX_PIXELS, MAX_SAMPLES};

/// The version of the bytes written, and the only one that is read.
pub const VERSION: u8 = 1;

/// First bytes of a checkpoint.
pub const MAGIC: [u8; 8] = [b'f', b'r', b'i', b'x', b'p', b'o', b's', VERSION];

/// Bytes before the tiles.
const HEAD: usize = 24;

/// Bytes of a pixel.
const PIXEL: usize = 21 * 4;

/// Why bytes are no checkpoint.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum AccumulatorError {
    /// The bytes are of another format or version.
    #[error("it is not an unfinished picture of version {VERSION}")]
    Magic,
    /// Cut off, or changed.
    #[error("it was cut off or changed")]
    Damaged,
}

impl Accumulator {
    /// The size of a checkpoint (bytes).
    #[must_use]
    pub fn checkpoint_size(&self) -> usize {
        HEAD + self.pixels() * (PIXEL + 1) + 16
    }

    /// The number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.width * self.height
    }

    /// The bytes from which [`Self::from_bytes`] makes it again.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.checkpoint_size());
        bytes.extend(MAGIC);
        bytes.extend(self.digest.to_le_bytes());
        bytes.extend((self.width as u32).to_le_bytes());
        bytes.extend((self.height as u32).to_le_bytes());
        for tile in &self.tiles {
            bytes.extend(tile.samples.to_le_bytes());
            tile.pixels.iter().for_each(|pixel| write(&mut bytes, pixel));
        }
        // A digest of all that stands before it, so that a file which was cut off is not taken for a picture.
        let sum = checksum(&bytes);
        bytes.extend(sum);
        bytes
    }

    /// The accumulator whose bytes these are.
    ///
    /// # Errors
    /// [`AccumulatorError`], if they are not.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, AccumulatorError> {
        if !bytes.starts_with(&MAGIC) {
            return Err(AccumulatorError::Magic);
        }
        let (content, sum) = bytes.split_last_chunk::<16>().ok_or(AccumulatorError::Damaged)?;
        if checksum(content) != *sum {
            return Err(AccumulatorError::Damaged);
        }
        let mut reader = Reader(&content[MAGIC.len()..]);
        reader.accumulator().ok_or(AccumulatorError::Damaged)
    }
}

fn write(bytes: &mut Vec<u8>, pixel: &Pixel) {
    let Pixel { light, half, alpha, albedo, normal, tangent, depth, hits, hair, wisp, lead } =
        pixel;
    for v in [light, half, albedo, normal, tangent] {
        v.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    [alpha, depth, hits, hair].into_iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    bytes.extend(wisp.to_le_bytes());
    bytes.extend(lead.to_le_bytes());
}

/// The bytes left to read; methods return `None` at their end.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn accumulator(&mut self) -> Option<Accumulator> {
        let digest = u64::from_le_bytes(self.take()?);
        let (width, height) = (self.count()? as usize, self.count()? as usize);
        let sides = [width, height];
        if sides.iter().any(|n| !(1..=MAX_SIZE).contains(n)) || width * height > MAX_PIXELS {
            return None;
        }
        // Before memory is allocated for them: a tile has its number of samples besides.
        if self.0.len() < width * height * PIXEL {
            return None;
        }
        let mut accumulator = Accumulator::new(width, height, digest);
        accumulator.tiles.iter_mut().try_for_each(|tile| self.tile(tile))?;
        self.0.is_empty().then_some(accumulator)
    }

    fn tile(&mut self, tile: &mut Tile) -> Option<()> {
        tile.samples = self.count().filter(|n| *n as usize <= MAX_SAMPLES)?;
        tile.pixels.iter_mut().try_for_each(|pixel| {
            *pixel = self.pixel()?;
            Some(())
        })
    }

    fn pixel(&mut self) -> Option<Pixel> {
        let mut vector = || Some(Vec3::new(self.number()?, self.number()?, self.number()?));
        let [light, half] = [vector()?, vector()?];
        let [albedo, normal, tangent] = [vector()?, vector()?, vector()?];
        let [alpha, depth] = [self.number()?, self.number()?];
        let [hits, hair] = [self.number()?, self.number()?];
        let [wisp, lead] = [self.count()?, self.count()?];
        Some(Pixel { light, half, alpha, albedo, normal, tangent, depth, hits, hair, wisp, lead })
    }

    fn number(&mut self) -> Option<f32> {
        self.take().map(f32::from_le_bytes)
    }

    fn count(&mut self) -> Option<u32> {
        self.take().map(u32::from_le_bytes)
    }

    fn take<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (first, rest) = self.0.split_first_chunk::<N>()?;
        self.0 = rest;
        Some(*first)
    }
}
