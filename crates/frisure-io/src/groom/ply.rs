//! Stanford `.ply`, binary little-endian: points with radius and strand number, and edges.
//!
//! Metres, z up, unless told otherwise: the strands as they were computed.

use std::io::{self, Write};

use frisure_strands::Strands;

use super::checked::Curves;
use super::lines::Lines;
use super::{Format, Groom};
use crate::frame::{Frame, FrameChoice, UpAxis};

/// Checks that the format has room: vertex indices are signed in most readers.
pub(super) fn check(strands: &Strands) -> Result<(), String> {
    let points = strands.points().len();
    if i32::try_from(points).is_ok() {
        return Ok(());
    }
    Err(format!("{points} points"))
}

/// Writes what [`check`] has passed.
#[expect(clippy::cast_possible_truncation, reason = "counts were checked to fit")]
pub(super) fn encode(out: &mut dyn Write, strands: &Strands, frame: Frame) -> io::Result<()> {
    let up = match frame.up {
        UpAxis::Y => 'y',
        UpAxis::Z => 'z',
    };
    let points = strands.points().len();
    let edges: usize = strands.iter().map(|s| s.points.len().saturating_sub(1)).sum();
    write!(
        out,
        "ply\nformat binary_little_endian 1.0\n\
         comment frisure: {} strands; unit {} m, {up} up\n\
         element vertex {points}\n\
         property float x\nproperty float y\nproperty float z\n\
         property float radius\nproperty uint strand\n\
         element edge {edges}\n\
         property int vertex1\nproperty int vertex2\n\
         end_header\n",
        strands.len(),
        frame.metres
    )?;
    for (i, strand) in strands.iter().enumerate() {
        for (p, r) in strand.points.iter().zip(strand.radii) {
            let (p, r) = (frame.position_to_file(*p), frame.length_to_file(*r));
            let words = [p.x.to_bits(), p.y.to_bits(), p.z.to_bits(), r.to_bits(), i as u32];
            out.write_all(words.map(u32::to_le_bytes).as_flattened())?;
        }
    }
    for pair in strands.offsets().windows(2) {
        for a in pair[0]..pair[1].saturating_sub(1).max(pair[0]) {
            out.write_all([a, a + 1].map(u32::to_le_bytes).as_flattened())?;
        }
    }
    Ok(())
}

/// How numbers are written.
#[derive(Clone, Copy, PartialEq)]
enum Encoding {
    Text,
    Little,
    Big,
}

/// Kinds of numbers.
#[derive(Clone, Copy)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn of(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }
}

/// What a row of an element has: a number, or a number of numbers and these.
struct Property {
    name: String,
    count: Option<Kind>,
    kind: Kind,
}

struct Element {
    name: String,
    rows: usize,
    properties: Vec<Property>,
}

/// Bytes of a file into hairs (m), or what is wrong with them.
///
/// Strands are told by `strand` of the vertices, or else by the edges.
pub(super) fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let (encoding, elements, rest) = header(bytes)?;
    let mut body = Body { rest, encoding };
    let (mut points, mut diameters, mut strands) = (Vec::new(), Vec::new(), Vec::new());
    let mut lines = Lines::default();
    for element in &elements {
        let column = |name: &str| element.properties.iter().position(|p| p.name == name);
        match element.name.as_str() {
            "vertex" => {
                let (Some(x), Some(y), Some(z)) = (column("x"), column("y"), column("z")) else {
                    return Err("its vertices have no x, y and z".into());
                };
                let (radius, strand) = (column("radius"), column("strand"));
                body.rows(element, |row| {
                    points.push([x, y, z].map(|c| row[c] as f32));
                    diameters.extend(radius.map(|c| (2.0 * row[c]) as f32));
                    strands.extend(strand.map(|c| row[c]));
                })?;
            }
            "edge" => {
                let (Some(a), Some(b)) = (column("vertex1"), column("vertex2")) else {
                    return Err("its edges have no vertex1 and vertex2".into());
                };
                // Whatever is no index leads beyond the points.
                let index = |x: f64| if x >= 0.0 { x as u32 } else { u32::MAX };
                body.rows(element, |row| lines.push(&[index(row[a]), index(row[b])]))?;
            }
            _ => body.rows(element, |_| ())?,
        }
    }
    let curves = if strands.is_empty() {
        if lines.is_empty() && !points.is_empty() {
            return Err("its vertices have no `strand`, and it has no edges".into());
        }
        lines.curves(&points, &diameters)?
    } else {
        let counts = strands.chunk_by(|a, b| a == b).map(<[f64]>::len).collect();
        Curves { counts, points, diameters, ..Curves::default() }
    };
    Ok(Groom::of(curves.strands(choice.or(Format::Ply.frame()))?))
}

fn header(bytes: &[u8]) -> Result<(Encoding, Vec<Element>, &[u8]), String> {
    let mut rest = bytes;
    let (mut encoding, mut elements) = (None, Vec::<Element>::new());
    for number in 1.. {
        let end = rest.iter().position(|b| *b == b'\n').ok_or("its header has no end")?;
        let line = std::str::from_utf8(&rest[..end]).map_err(|_| "its header is no text")?;
        rest = &rest[end + 1..];
        let wrong = || format!("line {number} of its header is `{}`", line.trim());
        let words: Vec<&str> = line.split_whitespace().collect();
        match (number, &words[..]) {
            (1, ["ply"]) => {}
            (1, _) => return Err("it does not begin with `ply`".into()),
            (_, ["comment" | "obj_info", ..] | []) => {}
            (_, ["format", kind, "1.0"]) => {
                encoding = Some(match *kind {
                    "ascii" => Encoding::Text,
                    "binary_little_endian" => Encoding::Little,
                    "binary_big_endian" => Encoding::Big,
                    _ => return Err(wrong()),
                });
            }
            (_, ["element", name, rows]) => {
                let rows = rows.parse().map_err(|_| wrong())?;
                elements.push(Element { name: (*name).into(), rows, properties: Vec::new() });
            }
            (_, ["property", of @ .., kind, name]) => {
                let kind = Kind::of(kind).ok_or_else(wrong)?;
                let count = match of {
                    [] => None,
                    ["list", count] => Some(Kind::of(count).ok_or_else(wrong)?),
                    _ => return Err(wrong()),
                };
                let element = elements.last_mut().ok_or_else(wrong)?;
                element.properties.push(Property { name: (*name).into(), count, kind });
            }
            (_, ["end_header"]) => {
                return Ok((encoding.ok_or("its header has no format")?, elements, rest));
            }
            _ => return Err(wrong()),
        }
    }
    unreachable!("the lines of a file end")
}

/// What follows the header.
struct Body<'a> {
    rest: &'a [u8],
    encoding: Encoding,
}

impl Body<'_> {
    /// Gives each row of an element; what is a list counts as its number.
    fn rows(&mut self, element: &Element, mut each: impl FnMut(&[f64])) -> Result<(), String> {
        let Element { name, rows, properties } = element;
        // Rows without a byte could be as many as anyone says.
        if properties.is_empty() && *rows > 0 {
            return Err(format!("its element `{name}` has no properties"));
        }
        let mut values = Vec::with_capacity(properties.len());
        for row in 0..*rows {
            let cut = || format!("it is cut short at {name} {row} of {rows}");
            values.clear();
            for property in properties {
                let value = self.number(property.count.unwrap_or(property.kind)).ok_or_else(cut)?;
                values.push(value);
                if property.count.is_some() {
                    for _ in 0..value as u64 {
                        self.number(property.kind).ok_or_else(cut)?;
                    }
                }
            }
            each(&values);
        }
        Ok(())
    }

    fn number(&mut self, kind: Kind) -> Option<f64> {
        if self.encoding == Encoding::Text {
            let rest = self.rest.trim_ascii_start();
            let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
            self.rest = &rest[end..];
            return std::str::from_utf8(&rest[..end]).ok()?.parse().ok();
        }
        Some(match kind {
            Kind::I8 => f64::from(i8::from_le_bytes(self.word()?)),
            Kind::U8 => f64::from(u8::from_le_bytes(self.word()?)),
            Kind::I16 => f64::from(i16::from_le_bytes(self.word()?)),
            Kind::U16 => f64::from(u16::from_le_bytes(self.word()?)),
            Kind::I32 => f64::from(i32::from_le_bytes(self.word()?)),
            Kind::U32 => f64::from(u32::from_le_bytes(self.word()?)),
            Kind::F32 => f64::from(f32::from_le_bytes(self.word()?)),
            Kind::F64 => f64::from_le_bytes(self.word()?),
        })
    }

    /// The next bytes, in little-endian order.
    fn word<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (word, rest) = self.rest.split_first_chunk()?;
        self.rest = rest;
        let mut word = *word;
        if self.encoding == Encoding::Big {
            word.reverse();
        }
        Some(word)
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn vertices_and_edges_are_all_there() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::X, Vec3::Y, Vec3::Z], &[0.5, 0.25, 0.125]);
        strands.push(&[], &[]);
        strands.push(&[Vec3::X, Vec3::Y], &[0.5, 0.25]);
        let mut out = Vec::new();
        encode(&mut out, &strands, Frame::METRES_Z).unwrap();
        let end = b"end_header\n";
        let body = out.windows(end.len()).position(|w| w == end).unwrap() + end.len();
        let header = std::str::from_utf8(&out[..body]).unwrap();
        assert!(header.contains("element vertex 5\n") && header.contains("element edge 3\n"));
        let words: Vec<u32> =
            out[body..].as_chunks().0.iter().map(|&b| u32::from_le_bytes(b)).collect();
        assert_eq!(words.len(), 5 * 5 + 3 * 2);
        assert_eq!(words[8..10], [0.25_f32.to_bits(), 0]);
        assert_eq!(words[19], 2);
        assert_eq!(words[25..], [0, 1, 1, 2, 3, 4]);
    }

    #[test]
    fn files_of_other_programs_are_read() {
        let text = b"ply\nformat ascii 1.0\ncomment by hand\nelement vertex 4\n\
            property double x\nproperty double y\nproperty double z\nproperty uchar red\n\
            element face 1\nproperty list uchar int vertex_indices\n\
            element edge 2\nproperty int vertex1\nproperty int vertex2\nend_header\n\
            0 0 0 255\n0 0 -0.1 1\n0 0 -0.2 1\n1 1 1 0\n3 0 1 2\n0 1\n1 2\n";
        let groom = decode(text, FrameChoice::default()).unwrap();
        assert_eq!(groom.hairs.points(), [0.0, -0.1, -0.2].map(|z| Vec3::new(0.0, 0.0, z)));
        for (from, to) in
            [("0 1\n1 2", "0 1\n1 4"), ("0 1\n1 2", "0 1\n1"), ("vertex 4", "vertex 9999999")]
        {
            let wrong = String::from_utf8_lossy(text).replace(from, to);
            assert!(decode(wrong.as_bytes(), FrameChoice::default()).is_err(), "{to}");
        }
    }

    #[test]
    fn bytes_may_be_the_other_way_round() {
        let mut bytes = b"ply\nformat binary_big_endian 1.0\nelement vertex 2\n".to_vec();
        bytes.extend(b"property float x\nproperty float y\nproperty float z\nproperty uint strand\nend_header\n");
        for x in [0.25_f32, 0.5] {
            bytes.extend([x, 0.0, 0.0].map(f32::to_be_bytes).as_flattened());
            bytes.extend([0; 4]);
        }
        let groom = decode(&bytes, FrameChoice::default()).unwrap();
        assert_eq!(groom.hairs.points(), [Vec3::X * 0.25, Vec3::X * 0.5]);
    }
}
