//! Stanford `.ply`: what a file has, as text and in binary of either order.
//!
//! Source of the format: Greg Turk, "The PLY Polygon File Format" (1994).

use std::collections::BTreeSet;

/// The type of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
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
    fn of(word: &str) -> Option<Self> {
        Some(match word {
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

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::I32 | Self::U32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    /// Little-endian bytes as a number.
    fn number(self, b: [u8; 8]) -> f64 {
        match self {
            Self::I8 => f64::from(b[0].cast_signed()),
            Self::U8 => f64::from(b[0]),
            Self::I16 => f64::from(i16::from_le_bytes([b[0], b[1]])),
            Self::U16 => f64::from(u16::from_le_bytes([b[0], b[1]])),
            Self::I32 => f64::from(i32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::U32 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::F32 => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
            Self::F64 => f64::from_le_bytes(b),
        }
    }

    /// The largest that a colour of this kind has.
    pub(crate) fn full(self) -> f64 {
        match self {
            Self::U8 => 255.0,
            Self::U16 => 65535.0,
            _ => 1.0,
        }
    }
}

/// A property of an element.
pub(crate) struct Property {
    pub(crate) name: String,
    pub(crate) kind: Kind,
    /// The type of the length of a list; none for a single number.
    pub(crate) list: Option<Kind>,
}

/// An element, such as the vertices.
pub(crate) struct Element {
    pub(crate) name: String,
    pub(crate) count: usize,
    pub(crate) properties: Vec<Property>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    Text,
    Little,
    Big,
}

/// The elements of a file in their order, and its numbers.
pub(crate) fn open(bytes: &[u8]) -> Result<(Vec<Element>, Body<'_>), String> {
    let mut rest = bytes;
    let mut order = None;
    let mut elements: Vec<Element> = Vec::new();
    // Names of elements, and of properties of the last of them: a second one of a name would be taken for the first.
    let (mut named, mut columns) = (BTreeSet::new(), BTreeSet::new());
    for number in 1.. {
        let end = rest.iter().position(|&b| b == b'\n').ok_or("its header has no end")?;
        let line = String::from_utf8_lossy(&rest[..end]).into_owned();
        rest = &rest[end + 1..];
        let words: Vec<&str> = line.split_whitespace().collect();
        let bad =
            || format!("line {number}: `{}`", line.trim().chars().take(60).collect::<String>());
        match words[..] {
            ["ply"] if number == 1 => {}
            ["end_header"] => break,
            ["format", name, _] if order.is_none() => {
                order = Some(match name {
                    "ascii" => Order::Text,
                    "binary_little_endian" => Order::Little,
                    "binary_big_endian" => Order::Big,
                    _ => return Err(bad()),
                });
            }
            ["comment" | "obj_info", ..] | [] => {}
            ["element", name, count] => {
                let count = count.parse().map_err(|_| bad())?;
                columns.clear();
                if !named.insert(name.to_owned()) {
                    return Err(format!("{}, the second element of that name", bad()));
                }
                elements.push(Element { name: name.into(), count, properties: Vec::new() });
            }
            ["property", .., kind, name] => {
                let known = |word| Kind::of(word).ok_or_else(bad);
                let list = match words[1..words.len() - 2] {
                    [] => None,
                    ["list", count] => Some(known(count)?),
                    _ => return Err(bad()),
                };
                if !columns.insert(name.to_owned()) {
                    return Err(format!("{}, the second property of that name", bad()));
                }
                let property = Property { name: name.into(), kind: known(kind)?, list };
                elements.last_mut().ok_or_else(bad)?.properties.push(property);
            }
            _ => return Err(bad()),
        }
    }
    let order = order.ok_or("its header has no format")?;
    Ok((elements, Body { order, rest }))
}

/// Numbers one after another.
pub(crate) struct Body<'a> {
    order: Order,
    rest: &'a [u8],
}

impl Body<'_> {
    pub(crate) fn number(&mut self, kind: Kind) -> Result<f64, String> {
        if self.order == Order::Text {
            return self.word();
        }
        let (bytes, rest) = self.rest.split_at_checked(kind.size()).ok_or("it is cut short")?;
        self.rest = rest;
        let mut all = [0; 8];
        all[..bytes.len()].copy_from_slice(bytes);
        if self.order == Order::Big {
            all[..bytes.len()].reverse();
        }
        Ok(kind.number(all))
    }

    fn word(&mut self) -> Result<f64, String> {
        let start = self.rest.iter().position(|b| !b.is_ascii_whitespace());
        let rest = &self.rest[start.ok_or("it is cut short")?..];
        let end = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        let word = String::from_utf8_lossy(&rest[..end]);
        self.rest = &rest[end..];
        word.parse()
            .map_err(|_| format!("`{}` is not a number", word.chars().take(40).collect::<String>()))
    }

    /// The number of a list, which what is left of the file has to hold.
    pub(crate) fn count(&mut self, kind: Kind) -> Result<usize, String> {
        let count = self.number(kind)?;
        if count >= 0.0 && count <= self.rest.len() as f64 {
            Ok(count as usize)
        } else {
            Err(format!("it is cut short: a list of {count}"))
        }
    }

    /// Refuses more items than bytes: each has at least one.
    pub(crate) fn check(&self, element: &Element) -> Result<(), String> {
        let Element { name, count, properties } = element;
        // Things without a byte could be as many as anyone says.
        if properties.is_empty() && *count > 0 {
            return Err(format!("its element `{name}` has no properties"));
        }
        if *count <= self.rest.len() {
            return Ok(());
        }
        Err(format!("it is cut short: {count} of `{name}` in {} bytes", self.rest.len()))
    }

    /// Passes over an element.
    pub(crate) fn pass(&mut self, element: &Element) -> Result<(), String> {
        self.rows(element, |_| ())
    }

    /// Gives each row of an element; what is a list counts as its number.
    pub(crate) fn rows(
        &mut self,
        element: &Element,
        mut each: impl FnMut(&[f64]),
    ) -> Result<(), String> {
        self.check(element)?;
        let mut values = Vec::with_capacity(element.properties.len());
        for _ in 0..element.count {
            values.clear();
            for property in &element.properties {
                let Some(list) = property.list else {
                    values.push(self.number(property.kind)?);
                    continue;
                };
                let count = self.count(list)?;
                for _ in 0..count {
                    self.number(property.kind)?;
                }
                values.push(count as f64);
            }
            each(&values);
        }
        Ok(())
    }
}
