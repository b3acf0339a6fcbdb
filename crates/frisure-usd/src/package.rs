//! Packages, `.usdz`: a zip archive without compression, whose first file is the layer to open.
//!
//! Source: Pixar, "Usdz File Format Specification".

/// The first bytes of a file.
pub(super) const MAGIC: &[u8] = b"PK\x03\x04";

/// Bytes of the head of a file in the archive, without its name.
const HEAD: usize = 30;

/// The first file of a package.
pub(super) fn first(bytes: &[u8]) -> Result<&[u8], String> {
    let head = bytes.get(..HEAD).ok_or("the package is cut short")?;
    let short = |at: usize| usize::from(u16::from_le_bytes([head[at], head[at + 1]]));
    let size = u32::from_le_bytes([head[18], head[19], head[20], head[21]]);
    // Bit 3 of the flags: the size stands behind the file.
    if short(8) != 0 || short(6) & 8 != 0 || size == u32::MAX {
        return Err("the first file of the package is compressed, or does not say its size".into());
    }
    let rest = bytes.get(HEAD + short(26) + short(28)..);
    let file = rest.and_then(|rest| rest.get(..size as usize));
    file.ok_or_else(|| format!("the package is cut short: its first file has {size} bytes"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_file_is_taken() {
        let mut bytes = MAGIC.to_vec();
        bytes.extend([20, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2, 3, 4, 5, 0, 0, 0, 5, 0, 0, 0]);
        bytes.extend([1, 0, 2, 0]);
        bytes.extend(b"axx#usdaPK");
        assert_eq!(first(&bytes).unwrap(), b"#usda");
        for n in 0..bytes.len() - 2 {
            assert!(first(&bytes[..n]).is_err(), "{n}");
        }
        bytes[8] = 8;
        assert!(first(&bytes).is_err());
    }
}
