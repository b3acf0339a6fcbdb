//! The text of a scene inside a picture of it (PNG), so that the picture opens as the scene.

use std::io::Cursor;

use png::text_metadata::{EncodableTextChunk, ITXtChunk};

/// Keyword of the text chunk.
const KEYWORD: &str = "frisure:scene";

/// Longest text (bytes) that is taken from a picture: that of a scene file. A guard on memory.
const LONGEST: usize = 4 << 20;

/// Bytes of a PNG before its second chunk: the signature, and the header with its length, name and checksum.
const HEAD: usize = 8 + 25;

/// A PNG with the text of a scene inside, compressed, as an `iTXt` chunk after the header; the same bytes if they are no PNG.
#[must_use]
pub fn embed(png: Vec<u8>, text: &str) -> Vec<u8> {
    if png.len() < HEAD || !png.starts_with(b"\x89PNG\r\n\x1a\n") {
        return png;
    }
    let mut chunk = ITXtChunk::new(KEYWORD, text);
    let mut all = png[..HEAD].to_vec();
    if chunk.compress_text().is_err() || chunk.encode(&mut all).is_err() {
        return png;
    }
    all.extend(&png[HEAD..]);
    all
}

/// The text of the scene inside a PNG; `None` if there is none.
#[must_use]
pub fn extract(png: &[u8]) -> Option<String> {
    let reader = png::Decoder::new(Cursor::new(png)).read_info().ok()?;
    let chunk = reader.info().utf8_text.iter().find(|chunk| chunk.keyword == KEYWORD)?;
    let mut chunk = chunk.clone();
    chunk.decompress_text_with_limit(LONGEST).ok()?;
    chunk.get_text().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::png as picture;

    #[test]
    fn a_scene_comes_out_of_a_picture_as_it_went_in() {
        let plain = picture::encode(2, 1, &[0, 0, 0, 255, 9, 9, 9, 255]).unwrap();
        let text = "name = \"Locken, größer\"\n[hair]\ntype = \"curly\"\n".repeat(50);
        let with = embed(plain.clone(), &text);
        assert_eq!(extract(&with).as_deref(), Some(text.as_str()));
        assert_eq!(extract(&plain), None);
        // Its pixels are the same, and what is no PNG is left alone.
        let pixels = |bytes: &[u8]| {
            let mut reader = png::Decoder::new(Cursor::new(bytes.to_vec())).read_info().unwrap();
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            pixels
        };
        assert_eq!(pixels(&with), pixels(&plain));
        assert_eq!(embed(b"no picture".to_vec(), "x"), b"no picture");
        for length in 0..with.len() {
            let _ = extract(&with[..length]);
        }
    }
}
