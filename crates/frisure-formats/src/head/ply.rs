//! Stanford polygons (PLY), as text and in binary of either order.
//!
//! Source of the format: Greg Turk, "The PLY Polygon File Format" (1994).

use super::format::MeshFormat;
use super::mesh::{COLOURS, MAX_CORNERS, Mesh, vertex_index};
use crate::ply::{Body, Element, Property, open};
use frisure_files::frame::Frame;

/// The declaration of the format.
pub(super) static FORMAT: MeshFormat = MeshFormat {
    extensions: &["ply"],
    expected: "a PLY mesh",
    begins: |bytes| bytes.starts_with(b"ply"),
    is_text: false,
    read: |bytes, _| Ok(parse(bytes)?),
};

/// Reads a file.
fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    let (elements, mut body) = open(bytes)?;
    let mut mesh = Mesh { frame: Some(frame(bytes)), ..Mesh::default() };
    for element in &elements {
        match element.name.as_str() {
            "vertex" => vertices(&mut mesh, element, &mut body)?,
            "face" => faces(&mut mesh, element, &mut body)?,
            _ => body.pass(element)?,
        }
    }
    mesh.triangle_uvs.resize(mesh.triangles.len(), None);
    mesh.join();
    Ok(mesh)
}

/// A line in the header of Blender's files, which have z up.
const BLENDER: &str = "comment Created in Blender";

/// The format says no axes: y is up, but in files of a program that always has z.
fn frame(bytes: &[u8]) -> Frame {
    let lines = bytes.split(|byte| *byte == b'\n');
    let mut header = lines.take_while(|line| !line.starts_with(b"end_header")).take(1000);
    let blender = header.any(|line| line.starts_with(BLENDER.as_bytes()));
    if blender { Frame::METRES_Z } else { Frame::METRES_Y }
}

fn vertices(mesh: &mut Mesh, element: &Element, body: &mut Body) -> Result<(), String> {
    body.check(element)?;
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
    body.check(element)?;
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
                corners.push(vertex_index(vertex, points).ok_or_else(|| {
                    format!("face {face} names vertex {vertex}, and there are {points}")
                })?);
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
    fn what_blender_writes_has_z_up() {
        let blender = TEXT.replace("made by hand", "Created in Blender version 5.0.1");
        assert_eq!(parse(blender.as_bytes()).unwrap().frame, Some(Frame::METRES_Z));
        assert_eq!(parse(TEXT.as_bytes()).unwrap().frame, Some(Frame::METRES_Y));
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
