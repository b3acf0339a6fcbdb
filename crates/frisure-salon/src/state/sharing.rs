//! A scene as a code for a link: its text, compressed.

use std::io::{Read, Write};

use base64::Engine;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use flate2::Compression;
use flate2::read::DeflateDecoder;
use flate2::write::DeflateEncoder;

/// What a code begins with, which no name of a card does.
const MARK: &str = "z.";

/// Longest text (bytes) of a scene from a code. A guard on memory.
const LONGEST: u64 = 4 << 20;

/// The code of a text, for the address of a page: letters, digits, `-`, `_` and `.`.
#[must_use]
pub fn code(text: &str) -> String {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    // Writing to memory does not fail.
    let written = encoder.write_all(text.as_bytes()).and_then(|()| encoder.finish());
    format!("{MARK}{}", BASE64_URL_SAFE_NO_PAD.encode(written.unwrap_or_default()))
}

/// The text of a code; `None` for what is no code, `Some(Err)` for one that is damaged.
#[must_use]
pub(super) fn decoded(code: &str) -> Option<Result<String, String>> {
    let code = code.strip_prefix(MARK)?;
    let read = || {
        let bytes = BASE64_URL_SAFE_NO_PAD.decode(code).map_err(|e| e.to_string())?;
        let mut text = String::new();
        let mut decoder = DeflateDecoder::new(bytes.as_slice()).take(LONGEST);
        decoder.read_to_string(&mut text).map_err(|e| e.to_string())?;
        Ok(text)
    };
    Some(read())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_go_there_and_back_and_damaged_ones_are_told() {
        let text = "name = \"Größe\"\n[hair]\ntype = \"wavy\"\nlength = \"30 cm\"\n";
        let short = code(text);
        assert!(short.len() < 2 * text.len());
        assert!(short.chars().all(|c| c.is_ascii_alphanumeric() || "-_.".contains(c)), "{short}");
        assert_eq!(decoded(&short), Some(Ok(text.to_owned())));
        assert_eq!(decoded("Curly"), None);
        assert!(matches!(decoded("z.!!"), Some(Err(_))));
        assert!(matches!(decoded(&short[..short.len() - 6]), Some(Err(_))));
    }
}
