//! Textures as PNG.

use frisure_cards::Atlas;

use crate::picture::png;

/// A texture as PNG. Only the first is a picture; the others are numbers, and say nothing of sRGB.
pub(super) fn texture(atlas: &Atlas, index: usize) -> Vec<u8> {
    let size = atlas.size as u32;
    let rgba = &atlas.textures[index];
    let bytes =
        if index == 0 { png::encode(size, size, rgba) } else { png::encode_data(size, size, rgba) };
    bytes.expect("a texture has four bytes for each texel")
}
