//! Arrays of `NumPy`: a line of text that says kind and shape, and the numbers.
//!
//! Source: `numpy.lib.format`.

/// An array.
pub(super) struct Array {
    /// Its lengths; none of a single value.
    pub(super) shape: Vec<usize>,
    pub(super) data: Data,
}

/// What an array has, the last index fastest.
pub(super) enum Data {
    Real(Vec<f64>),
    Whole(Vec<i64>),
    /// A single text.
    Text(String),
}

const MAGIC: &[u8] = b"\x93NUMPY";

/// What stands before the numbers: of a kind such as `<f4`, with their lengths.
pub(super) fn header(kind: &str, shape: &[usize]) -> Vec<u8> {
    let lengths: String = shape.iter().map(|n| format!("{n}, ")).collect();
    // A single length keeps its comma.
    let lengths = if shape.len() > 1 { lengths.trim_end_matches(", ") } else { lengths.trim_end() };
    let mut text = format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': ({lengths}), }}");
    let before = MAGIC.len() + 4;
    let total = (before + text.len() + 1).next_multiple_of(64);
    text.extend(std::iter::repeat_n(' ', total - before - text.len() - 1));
    text.push('\n');
    let mut bytes = [MAGIC, &[1, 0]].concat();
    bytes.extend((text.len() as u16).to_le_bytes());
    bytes.extend(text.into_bytes());
    bytes
}

impl Array {
    /// An array, or nothing where it is of a kind that grooms do not have.
    pub(super) fn read(bytes: &[u8]) -> Result<Option<Self>, String> {
        let rest = bytes.strip_prefix(MAGIC).ok_or("it is no array of NumPy")?;
        let cut = "its header is cut short";
        let ([major, _minor], rest) = rest.split_first_chunk().ok_or(cut)?;
        let (size, rest) = if *major == 1 {
            let (size, rest) = rest.split_first_chunk().ok_or(cut)?;
            (usize::from(u16::from_le_bytes(*size)), rest)
        } else {
            let (size, rest) = rest.split_first_chunk().ok_or(cut)?;
            (u32::from_le_bytes(*size) as usize, rest)
        };
        let (text, numbers) = rest.split_at_checked(size).ok_or(cut)?;
        let text = std::str::from_utf8(text).map_err(|_| "its header is no text")?;
        let kind = value(text, "descr").ok_or("its header has no `descr`")?;
        let kind = kind.trim_start_matches(['\'', '"']).split(['\'', '"']).next().unwrap_or("");
        let order = value(text, "fortran_order").ok_or("its header has no `fortran_order`")?;
        let shape = shape(text)?;
        if order.starts_with("True") && shape.len() > 1 {
            return Err(
                "its order is Fortran's, and only C's is read (`numpy.ascontiguousarray`)".into()
            );
        }
        let Some((width, data)) = data(kind, numbers)? else { return Ok(None) };
        let expected = shape.iter().try_fold(width, |n, &m| n.checked_mul(m));
        if expected != Some(numbers.len()) {
            return Err(format!("{} bytes are not {shape:?} of `{kind}`", numbers.len()));
        }
        Ok(Some(Self { shape, data }))
    }
}

/// What follows a key.
fn value<'a>(text: &'a str, key: &str) -> Option<&'a str> {
    let at = text.find(&format!("'{key}'")).or_else(|| text.find(&format!("\"{key}\"")))?;
    let rest = text[at + key.len() + 2..].trim_start();
    Some(rest.strip_prefix(':')?.trim_start())
}

fn shape(text: &str) -> Result<Vec<usize>, String> {
    let rest = value(text, "shape").and_then(|v| v.strip_prefix('('));
    let inside = rest.and_then(|v| v.split_once(')')).ok_or("its header has no `shape`")?.0;
    let lengths = inside.split(',').map(str::trim).filter(|n| !n.is_empty());
    let parsed =
        lengths.map(|n| n.trim_end_matches('L').parse().map_err(|_| format!("`{n}` is no length")));
    parsed.collect()
}

/// Numbers of a kind, and the bytes of one.
fn data(kind: &str, bytes: &[u8]) -> Result<Option<(usize, Data)>, String> {
    fn words<const N: usize>(bytes: &[u8]) -> impl Iterator<Item = [u8; N]> {
        bytes.as_chunks().0.iter().copied()
    }
    if kind.starts_with('>') {
        return Err(format!("its kind is `{kind}`, and only little-endian numbers are read"));
    }
    let whole = |v: Vec<i64>| Data::Whole(v);
    Ok(Some(match kind.trim_start_matches(['<', '|', '=']) {
        "f4" => (4, Data::Real(words(bytes).map(|w| f64::from(f32::from_le_bytes(w))).collect())),
        "f8" => (8, Data::Real(words(bytes).map(f64::from_le_bytes).collect())),
        "i1" => (1, whole(bytes.iter().map(|&b| i64::from(b as i8)).collect())),
        "u1" | "b1" => (1, whole(bytes.iter().map(|&b| i64::from(b)).collect())),
        "i2" => (2, whole(words(bytes).map(|w| i64::from(i16::from_le_bytes(w))).collect())),
        "u2" => (2, whole(words(bytes).map(|w| i64::from(u16::from_le_bytes(w))).collect())),
        "i4" => (4, whole(words(bytes).map(|w| i64::from(i32::from_le_bytes(w))).collect())),
        "u4" => (4, whole(words(bytes).map(|w| i64::from(u32::from_le_bytes(w))).collect())),
        "i8" | "u8" => (8, whole(words(bytes).map(i64::from_le_bytes).collect())),
        text if text.starts_with('U') => {
            let letters = words(bytes).map(u32::from_le_bytes).take_while(|c| *c != 0);
            let text = letters.filter_map(char::from_u32).take(1000).collect();
            (bytes.len(), Data::Text(text))
        }
        _ => return Ok(None),
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headers_are_numpys() {
        let bytes = header("<f4", &[2, 100, 3]);
        assert_eq!(bytes.len() % 64, 0);
        let text = std::str::from_utf8(&bytes[10..]).unwrap();
        assert!(
            text.starts_with("{'descr': '<f4', 'fortran_order': False, 'shape': (2, 100, 3), }")
        );
        assert!(String::from_utf8_lossy(&header("<f8", &[])).contains("'shape': (), }"));
        assert!(String::from_utf8_lossy(&header("<f8", &[3])).contains("'shape': (3,), }"));
    }

    #[test]
    fn shapes_must_fit_the_numbers() {
        let with = |shape: &[usize], bytes: usize| [header("<i4", shape), vec![0; bytes]].concat();
        assert!(Array::read(&with(&[2, 3], 24)).unwrap().is_some());
        assert!(Array::read(&with(&[2, 3], 25)).is_err());
        assert!(Array::read(&with(&[usize::MAX, 3], 24)).is_err());
        assert!(Array::read(&with(&[], 4)).unwrap().is_some());
        for n in 0..128 {
            let _ = Array::read(&with(&[2, 3], 24)[..n]);
        }
    }
}
