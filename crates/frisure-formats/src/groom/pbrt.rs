//! Curves of pbrt-v4, to be included in a scene: one `Shape "curve"` for each strand, with a Bézier piece between
//! each two points.
//!
//! The pieces are those of the Catmull-Rom curve through the points, so that the strand is smooth and passes
//! through every one of them. Metres, y up, unless the caller says otherwise. The widths are those of root and tip, between
//! which pbrt interpolates.

use std::io::{self, Write};

use frisure_strands::Strands;
use glam::Vec3;

use super::checked::check_strands;
use super::format::Declaration;
use frisure_files::frame::Frame;

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["pbrt"],
    title: "curves for pbrt-v4",
    frame: Frame::METRES_Y,
    holds_guides: false,
    usual_points: None,
    most_hairs: None,
    check: |groom| check_strands("strand", groom.strands()),
    write: |out, samples, frame| encode(out, samples.groom.strands(), frame),
    moves: false,
    read: None,
};

/// Writes what [`check_strands`] has passed.
fn encode(out: &mut dyn Write, strands: &Strands, frame: Frame) -> io::Result<()> {
    let up = frame.up.name();
    let count = strands.len();
    writeln!(out, "# frisure: {count} strands; unit {} m, {up} up", frame.metres)?;
    let mut text = Vec::with_capacity(1 << 14);
    for strand in strands.iter() {
        let points: Vec<Vec3> = strand.points.iter().map(|p| frame.position_to_file(*p)).collect();
        text.clear();
        text.extend_from_slice(b"Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" [");
        for p in bezier(&points) {
            write!(text, " {} {} {}", p.x, p.y, p.z)?;
        }
        let width = |r: Option<&f32>| frame.length_to_file(2.0 * r.copied().unwrap_or(0.0));
        let (root, tip) = (width(strand.radii.first()), width(strand.radii.last()));
        writeln!(text, " ] \"float width0\" {root} \"float width1\" {tip}")?;
        out.write_all(&text)?;
    }
    Ok(())
}

/// Control points of the Catmull-Rom curve through points: three for each piece, and the first.
fn bezier(points: &[Vec3]) -> Vec<Vec3> {
    let tangent = |i: usize| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(points.len() - 1));
        (points[after] - points[before]) / (after - before) as f32
    };
    let pieces = points.windows(2).enumerate().flat_map(|(i, pair)| {
        [pair[0] + tangent(i) / 3.0, pair[1] - tangent(i + 1) / 3.0, pair[1]]
    });
    points.first().copied().into_iter().chain(pieces).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_pass_through_their_points() {
        let points: Vec<Vec3> = (0..4).map(|k| Vec3::new(k as f32, (k * k) as f32, 0.0)).collect();
        let control = bezier(&points);
        assert_eq!(control.len(), 10);
        for (k, p) in points.iter().enumerate() {
            assert_eq!(control[3 * k], *p);
        }
        // A parabola is its own Catmull-Rom curve but at its ends.
        assert!((control[4] - Vec3::new(4.0 / 3.0, 5.0 / 3.0, 0.0)).length() < 1e-6);
    }

    #[test]
    fn a_strand_is_a_line_of_text() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::ZERO, Vec3::Z * 3.0], &[0.5, 0.25]);
        let mut out = Vec::new();
        encode(&mut out, &strands, Frame::METRES_Z).unwrap();
        assert_eq!(
            String::from_utf8(out).unwrap(),
            "# frisure: 1 strands; unit 1 m, z up\nShape \"curve\" \"string type\" \"cylinder\" \
             \"point3 P\" [ 0 0 0 0 0 1 0 0 2 0 0 3 ] \"float width0\" 1 \"float width1\" 0.5\n"
        );
    }
}
