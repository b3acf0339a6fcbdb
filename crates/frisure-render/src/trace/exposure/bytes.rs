//! An exposure as bytes, to be put away.
//!
//! Little-endian: a mark of eight bytes that holds the version, the fingerprint, width and height, then
//! for each tile its number of samples and its pixels' sums, and a checksum of all before it.

use glam::Vec3;
use thiserror::Error;

use super::{Exposure, Pixel, Tile};
use crate::preview::MAX_SIZE;
use crate::trace::fingerprint::Fingerprint;
use crate::trace::{MAX_PIXELS, MAX_SAMPLES};

/// The version of the bytes written, and the only one that is read.
pub const VERSION: u8 = 1;

/// Begins the bytes of an exposure.
pub const MARK: [u8; 8] = [b'f', b'r', b'i', b'x', b'p', b'o', b's', VERSION];

/// Bytes before the tiles.
const HEAD: usize = 24;

/// Bytes of a pixel.
const PIXEL: usize = 21 * 4;

/// Why bytes are no exposure.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
pub enum ExposureError {
    /// They are something else, or of another version.
    #[error("it is not an unfinished picture of version {VERSION}")]
    Mark,
    /// Cut off, or changed.
    #[error("it was cut off or changed")]
    Damaged,
}

impl Exposure {
    /// The bytes from which [`Self::from_bytes`] makes it again.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(HEAD + self.width * self.height * (PIXEL + 1) + 8);
        bytes.extend(MARK);
        bytes.extend(self.fingerprint.to_le_bytes());
        bytes.extend((self.width as u32).to_le_bytes());
        bytes.extend((self.height as u32).to_le_bytes());
        for tile in &self.tiles {
            bytes.extend(tile.samples.to_le_bytes());
            tile.pixels.iter().for_each(|pixel| write(&mut bytes, pixel));
        }
        let sum = Fingerprint::of(&bytes);
        bytes.extend(sum.to_le_bytes());
        bytes
    }

    /// The exposure whose bytes these are.
    ///
    /// # Errors
    /// [`ExposureError`], if they are not.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, ExposureError> {
        if !bytes.starts_with(&MARK) {
            return Err(ExposureError::Mark);
        }
        let (content, sum) = bytes.split_last_chunk::<8>().ok_or(ExposureError::Damaged)?;
        if Fingerprint::of(content) != u64::from_le_bytes(*sum) {
            return Err(ExposureError::Damaged);
        }
        let mut reader = Reader(&content[MARK.len()..]);
        reader.exposure().ok_or(ExposureError::Damaged)
    }
}

fn write(bytes: &mut Vec<u8>, pixel: &Pixel) {
    let Pixel { light, half, alpha, albedo, normal, tangent, depth, met, hair, wisp, lead } = pixel;
    for v in [light, half, albedo, normal, tangent] {
        v.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    }
    [alpha, depth, met, hair].into_iter().for_each(|x| bytes.extend(x.to_le_bytes()));
    bytes.extend(wisp.to_le_bytes());
    bytes.extend(lead.to_le_bytes());
}

/// What is left to read; `None` where it ends too early.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn exposure(&mut self) -> Option<Exposure> {
        let fingerprint = u64::from_le_bytes(self.take()?);
        let (width, height) = (self.count()? as usize, self.count()? as usize);
        let sides = [width, height];
        if sides.iter().any(|n| !(1..=MAX_SIZE).contains(n)) || width * height > MAX_PIXELS {
            return None;
        }
        let mut exposure = Exposure::new(width, height, fingerprint);
        exposure.tiles.iter_mut().try_for_each(|tile| self.tile(tile))?;
        self.0.is_empty().then_some(exposure)
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
        let [met, hair] = [self.number()?, self.number()?];
        let [wisp, lead] = [self.count()?, self.count()?];
        Some(Pixel { light, half, alpha, albedo, normal, tangent, depth, met, hair, wisp, lead })
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
