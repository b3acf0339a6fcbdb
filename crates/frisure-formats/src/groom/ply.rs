//! Stanford `.ply`, binary little-endian: points with radius and strand number, and edges.
//!
//! Metres, z up, unless the caller says otherwise: the strands as they were computed.

use std::io::{self, Write};

use frisure_strands::Strands;

use super::curves::Curves;
use super::data::Groom;
use super::format::Declaration;
use super::lines::Lines;
use crate::ply::open;
use frisure_files::frame::{Frame, FrameChoice};

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["ply"],
    title: "Stanford points and edges",
    frame: Frame::METRES_Z,
    holds_guides: false,
    usual_points: None,
    most_hairs: None,
    check: |groom| check(groom.strands()),
    write: |out, samples, frame| encode(out, samples.groom.strands(), frame),
    moves: false,
    read: Some(decode),
};

/// Checks that the format has room: vertex indices are signed in most readers.
fn check(strands: &Strands) -> Result<(), String> {
    let points = strands.points().len();
    if i32::try_from(points).is_ok() {
        return Ok(());
    }
    Err(format!("{points} points"))
}

/// Writes what [`check`] has passed.
fn encode(out: &mut dyn Write, strands: &Strands, frame: Frame) -> io::Result<()> {
    let up = frame.up.name();
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

/// Bytes of a file into hairs (m), or what is wrong with them.
///
/// Strands follow from `strand` of the vertices, or else by the edges.
fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let (elements, mut body) = open(bytes)?;
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
            _ => body.pass(element)?,
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
    Ok(Groom::of(curves.strands(choice.or(FORMAT.frame))?))
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
        for (from, to) in [
            ("0 1\n1 2", "0 1\n1 4"),
            ("0 1\n1 2", "0 1\n1"),
            ("vertex 4", "vertex 9999999"),
            // What is there twice is not taken for the first.
            ("element face 1", "element vertex 0"),
            ("double z", "double x\nproperty double z"),
            ("format ascii", "format binary_big_endian 1.0\nformat ascii"),
        ] {
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
