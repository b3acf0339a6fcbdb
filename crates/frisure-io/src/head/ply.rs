//! Stanford polygons (PLY), as text and in binary of either order.
//!
//! Source of the format: Greg Turk, "The PLY Polygon File Format" (1994).

use super::mesh::{COLOURS, MAX_CORNERS, Mesh};
use crate::frame::Frame;

/// What a number of the file is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    fn full(self) -> f64 {
        match self {
            Self::U8 => 255.0,
            Self::U16 => 65535.0,
            _ => 1.0,
        }
    }
}

struct Property {
    name: String,
    kind: Kind,
    /// Of a list, what its number is.
    list: Option<Kind>,
}

struct Element {
    name: String,
    count: usize,
    properties: Vec<Property>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Order {
    Text,
    Little,
    Big,
}

/// Reads a file.
pub(super) fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    let (order, elements, rest) = header(bytes)?;
    let mut body = Body { order, rest };
    let mut mesh = Mesh { frame: Some(Frame::METRES_Y), ..Mesh::default() };
    for element in &elements {
        match element.name.as_str() {
            "vertex" => vertices(&mut mesh, element, &mut body)?,
            "face" => faces(&mut mesh, element, &mut body)?,
            _ => pass(element, &mut body)?,
        }
    }
    mesh.triangle_uvs.resize(mesh.triangles.len(), None);
    mesh.join();
    Ok(mesh)
}

fn header(bytes: &[u8]) -> Result<(Order, Vec<Element>, &[u8]), String> {
    let mut rest = bytes;
    let mut order = None;
    let mut elements: Vec<Element> = Vec::new();
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
            ["format", "ascii", _] => order = Some(Order::Text),
            ["format", "binary_little_endian", _] => order = Some(Order::Little),
            ["format", "binary_big_endian", _] => order = Some(Order::Big),
            ["comment" | "obj_info", ..] | [] => {}
            ["element", name, count] => {
                let count = count.parse().map_err(|_| bad())?;
                elements.push(Element { name: name.into(), count, properties: Vec::new() });
            }
            ["property", "list", count, kind, name] => {
                let (list, kind) = (Kind::of(count), Kind::of(kind).ok_or_else(bad)?);
                let property =
                    Property { name: name.into(), kind, list: Some(list.ok_or_else(bad)?) };
                elements.last_mut().ok_or_else(bad)?.properties.push(property);
            }
            ["property", kind, name] => {
                let kind = Kind::of(kind).ok_or_else(bad)?;
                let property = Property { name: name.into(), kind, list: None };
                elements.last_mut().ok_or_else(bad)?.properties.push(property);
            }
            _ => return Err(bad()),
        }
    }
    Ok((order.ok_or("its header has no format")?, elements, rest))
}

/// Numbers one after another.
struct Body<'a> {
    order: Order,
    rest: &'a [u8],
}

impl Body<'_> {
    fn number(&mut self, kind: Kind) -> Result<f64, String> {
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
    fn count(&mut self, kind: Kind) -> Result<usize, String> {
        let count = self.number(kind)?;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked")]
        if count >= 0.0 && count <= self.rest.len() as f64 {
            Ok(count as usize)
        } else {
            Err(format!("it is cut short: a list of {count}"))
        }
    }
}

/// Refuses more things than bytes: each has at least one.
fn check(element: &Element, body: &Body) -> Result<(), String> {
    if element.properties.is_empty() || element.count <= body.rest.len() {
        return Ok(());
    }
    let Element { name, count, .. } = element;
    Err(format!("it is cut short: {count} of `{name}` in {} bytes", body.rest.len()))
}

fn pass(element: &Element, body: &mut Body) -> Result<(), String> {
    check(element, body)?;
    if element.properties.is_empty() {
        return Ok(());
    }
    for _ in 0..element.count {
        for property in &element.properties {
            let count = property.list.map_or(Ok(1), |kind| body.count(kind))?;
            for _ in 0..count {
                body.number(property.kind)?;
            }
        }
    }
    Ok(())
}

fn vertices(mesh: &mut Mesh, element: &Element, body: &mut Body) -> Result<(), String> {
    check(element, body)?;
    let properties = &element.properties;
    if properties.iter().any(|p| p.list.is_some()) {
        return Err("its vertices have lists".into());
    }
    let place = |name: &str| properties.iter().position(|p| p.name == name);
    let [Some(x), Some(y), Some(z)] = ["x", "y", "z"].map(place) else {
        return Err("its vertices have not x, y and z".into());
    };
    let mut columns: Vec<Vec<f64>> = vec![Vec::new(); properties.len()];
    for vertex in 0..element.count {
        for (property, column) in properties.iter().zip(&mut columns) {
            let number = body.number(property.kind)?;
            if !number.is_finite() {
                return Err(format!("`{}` of vertex {vertex} is {number}", property.name));
            }
            column.push(number);
        }
    }
    let first = mesh.positions.len();
    let count = element.count;
    mesh.positions.extend((0..count).map(|i| [columns[x][i], columns[y][i], columns[z][i]]));
    textures(mesh, &columns, place);
    for (property, column) in properties.iter().zip(&columns) {
        if !["x", "y", "z", "nx", "ny", "nz"].contains(&property.name.as_str()) {
            let full =
                if COLOURS.contains(&property.name.as_str()) { property.kind.full() } else { 1.0 };
            mesh.channel(&property.name, first, column.iter().map(|v| v / full));
        }
    }
    let three = ["red", "green", "blue"].map(|name| mesh.channels.get(name).cloned());
    if let [Some(r), Some(g), Some(b)] = three {
        let mean = (0..r.len()).map(|i| (r[i] + g[i] + b[i]) / 3.0);
        mesh.channel(super::mesh::BRIGHTNESS, 0, mean);
    }
    Ok(())
}

/// Texture coordinates of vertices, under any of the names in use.
fn textures(mesh: &mut Mesh, columns: &[Vec<f64>], place: impl Fn(&str) -> Option<usize>) {
    for (u, v) in [("s", "t"), ("u", "v"), ("texture_u", "texture_v")] {
        if let (Some(u), Some(v)) = (place(u), place(v)) {
            mesh.uvs = columns[u].iter().zip(&columns[v]).map(|(u, v)| [*u, *v]).collect();
            return;
        }
    }
}

fn faces(mesh: &mut Mesh, element: &Element, body: &mut Body) -> Result<(), String> {
    check(element, body)?;
    let is_corners = |p: &Property| p.list.is_some() && p.name.starts_with("vertex_ind");
    if !element.properties.iter().any(is_corners) {
        return Err("its faces have no vertices".into());
    }
    let points = mesh.positions.len();
    for face in 0..element.count {
        for property in &element.properties {
            let count = property.list.map_or(Ok(1), |kind| body.count(kind))?;
            if !is_corners(property) {
                for _ in 0..count {
                    body.number(property.kind)?;
                }
                continue;
            }
            if !(3..=MAX_CORNERS).contains(&count) {
                return Err(format!("face {face} has {count} corners"));
            }
            let mut corners = Vec::with_capacity(count);
            for _ in 0..count {
                let vertex = body.number(property.kind)?;
                #[expect(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "checked"
                )]
                if vertex >= 0.0 && vertex < points as f64 && vertex < f64::from(u32::MAX) {
                    corners.push(vertex as u32);
                } else {
                    return Err(format!(
                        "face {face} names vertex {vertex}, and there are {points}"
                    ));
                }
            }
            for pair in corners[1..].windows(2) {
                let triangle = [corners[0], pair[0], pair[1]];
                mesh.triangles.push(triangle);
                // A vertex has one coordinate.
                mesh.triangle_uvs.push((mesh.uvs.len() == points).then_some(triangle));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\n\
        property float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n\
        element face 1\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 255 0 0\n1 0 0 0 0 0\n1 1 0 0 0 0\n0 1 0 51 51 51\n4 0 1 2 3\n";

    fn binary(big: bool) -> Vec<u8> {
        let order = if big { "big" } else { "little" };
        let head = TEXT.split_inclusive("end_header\n").next().unwrap();
        let mut bytes = head.replace("ascii", &format!("binary_{order}_endian")).into_bytes();
        let corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0_f32]];
        let colours = [[255, 0, 0], [0; 3], [0; 3], [51; 3]];
        for (p, c) in corners.iter().zip(colours) {
            for x in p {
                bytes.extend(if big { x.to_be_bytes() } else { x.to_le_bytes() });
            }
            bytes.extend(c);
        }
        bytes.push(4);
        for i in 0..4_i32 {
            bytes.extend(if big { i.to_be_bytes() } else { i.to_le_bytes() });
        }
        bytes
    }

    #[test]
    fn text_and_both_binary_orders_are_the_same_mesh() {
        let mesh = parse(TEXT.as_bytes()).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(mesh.channels["red"], [1.0, 0.0, 0.0, 0.2]);
        assert!((mesh.channels["brightness"][3] - 0.2).abs() < 1e-12);
        for big in [false, true] {
            assert_eq!(parse(&binary(big)).unwrap(), mesh);
        }
    }

    #[test]
    fn cut_anywhere_it_is_refused() {
        for whole in [TEXT.as_bytes().to_vec(), binary(false)] {
            // Text is whole without its last line end.
            for n in 0..whole.len() - 1 {
                assert!(parse(&whole[..n]).is_err(), "{n}");
            }
        }
    }

    #[test]
    fn counts_that_lie_are_told() {
        let lying = TEXT.replace("vertex 4", "vertex 18446744073709551615");
        assert!(parse(lying.as_bytes()).unwrap_err().starts_with("it is cut short"));
        let other = TEXT.replace("4 0 1 2 3", "4 0 1 2 7");
        assert_eq!(parse(other.as_bytes()).unwrap_err(), "face 0 names vertex 7, and there are 4");
        assert!(parse(TEXT.replace("4 0 1 2 3", "4000000 1").as_bytes()).is_err());
    }
}
