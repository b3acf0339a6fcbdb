//! Stanford `.ply`, binary little-endian: points with radius and strand number, and edges.
//!
//! Metres, z up, unless told otherwise: the strands as they were computed.

use std::io::{self, Write};

use frisure_strands::Strands;

use crate::frame::{Frame, UpAxis};

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
}
