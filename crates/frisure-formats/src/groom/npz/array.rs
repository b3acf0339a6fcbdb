//! Arrays of `NumPy`: a line of text that says kind and shape, and the numbers.
//!
//! Source: `numpy.lib.format`.

/// An array, with its numbers as they are in the file.
pub(super) struct Array {
    /// Its lengths; none of a single value.
    pub(super) shape: Vec<usize>,
    kind: Kind,
    /// Header and numbers.
    bytes: Vec<u8>,
    /// Index of the first byte of the numbers.
    start: usize,
}

/// The type of values: a letter and a size in bytes, as in `f4`. Text has four bytes for each letter.
#[derive(Clone, Copy)]
struct Kind {
    letter: char,
    size: usize,
}

impl Kind {
    fn of(descr: &str) -> Option<Self> {
        let mut rest = descr.trim_start_matches(['<', '|', '=']).chars();
        let letter = rest.next()?;
        let size = rest.as_str().parse().ok()?;
        match (letter, size) {
            ('f', 4 | 8) | ('i' | 'u', 1 | 2 | 4 | 8) | ('b', 1) => Some(Self { letter, size }),
            ('U', letters) => Some(Self { letter, size: letters.saturating_mul(4) }),
            _ => None,
        }
    }
}

const MAGIC: &[u8] = b"\x93NUMPY";

/// The header of an array: its type, such as `<f4`, and its lengths.
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
    pub(super) fn read(bytes: Vec<u8>) -> Result<Option<Self>, String> {
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
        let descr = value(text, "descr").ok_or("its header has no `descr`")?;
        let descr = descr.trim_start_matches(['\'', '"']).split(['\'', '"']).next().unwrap_or("");
        if descr.starts_with('>') {
            return Err(format!("its kind is `{descr}`, and only little-endian numbers are read"));
        }
        let order = value(text, "fortran_order").ok_or("its header has no `fortran_order`")?;
        let shape = shape(text)?;
        if order.starts_with("True") && shape.len() > 1 {
            let hint = "`numpy.ascontiguousarray`";
            return Err(format!("its order is Fortran's, and only C's is read ({hint})"));
        }
        let Some(kind) = Kind::of(descr) else { return Ok(None) };
        let expected = shape.iter().try_fold(kind.size, |n, &m| n.checked_mul(m));
        if expected != Some(numbers.len()) {
            return Err(format!("{} bytes are not {shape:?} of `{descr}`", numbers.len()));
        }
        let start = bytes.len() - numbers.len();
        Ok(Some(Self { shape, kind, bytes, start }))
    }

    fn words<const N: usize>(&self) -> std::slice::Iter<'_, [u8; N]> {
        self.bytes[self.start..].as_chunks().0.iter()
    }

    /// Its numbers, where they are real ones.
    pub(super) fn real(&self) -> Option<Vec<f32>> {
        Some(match (self.kind.letter, self.kind.size) {
            ('f', 4) => self.words().map(|w| f32::from_le_bytes(*w)).collect(),
            ('f', 8) => self.words().map(|w| f64::from_le_bytes(*w) as f32).collect(),
            _ => return None,
        })
    }

    /// Its numbers, where they are whole ones.
    pub(super) fn whole(&self) -> Option<Vec<i128>> {
        Some(match (self.kind.letter, self.kind.size) {
            ('i', 1) => self.words().map(|&[b]| (b as i8).into()).collect(),
            ('u' | 'b', 1) => self.words().map(|&[b]| b.into()).collect(),
            ('i', 2) => self.words().map(|w| i16::from_le_bytes(*w).into()).collect(),
            ('u', 2) => self.words().map(|w| u16::from_le_bytes(*w).into()).collect(),
            ('i', 4) => self.words().map(|w| i32::from_le_bytes(*w).into()).collect(),
            ('u', 4) => self.words().map(|w| u32::from_le_bytes(*w).into()).collect(),
            ('i', 8) => self.words().map(|w| i64::from_le_bytes(*w).into()).collect(),
            ('u', 8) => self.words().map(|w| u64::from_le_bytes(*w).into()).collect(),
            _ => return None,
        })
    }

    /// A single real number, to its last bit.
    pub(super) fn number(&self) -> Option<f64> {
        match (self.kind.letter, self.kind.size, &self.shape[..]) {
            ('f', 8, [] | [1]) => self.words().next().map(|w| f64::from_le_bytes(*w)),
            ('f', 4, [] | [1]) => self.words().next().map(|w| f64::from(f32::from_le_bytes(*w))),
            _ => None,
        }
    }

    /// Its text, where it is one.
    pub(super) fn text(&self) -> Option<String> {
        if self.kind.letter != 'U' {
            return None;
        }
        let letters = self.words().map(|w| u32::from_le_bytes(*w)).take_while(|c| *c != 0);
        Some(letters.filter_map(char::from_u32).take(1000).collect())
    }
}

/// The text after a key.
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
        assert!(Array::read(with(&[2, 3], 24)).unwrap().is_some());
        assert!(Array::read(with(&[2, 3], 25)).is_err());
        assert!(Array::read(with(&[usize::MAX, 3], 24)).is_err());
        assert!(Array::read(with(&[], 4)).unwrap().is_some());
        for n in 0..128 {
            let _ = Array::read(with(&[2, 3], 24)[..n].to_vec());
        }
    }
}
