//! Text of Mitsuba 3's `linearcurve` and `bsplinecurve`: a line `x y z radius` for each point, and an empty
//! line after each strand.
//!
//! Metres, y up, unless the caller says otherwise. As `linearcurve` the strands are what they are; a `bsplinecurve` only
//! passes near the points.

use std::io::{self, Write};

use frisure_strands::Strands;

use super::checked::check_strands;
use super::format::Declaration;
use frisure_files::frame::Frame;

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["txt"],
    title: "curves for Mitsuba 3",
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
    let mut text = Vec::with_capacity(1 << 14);
    for strand in strands.iter() {
        text.clear();
        for (p, r) in strand.points.iter().zip(strand.radii) {
            let p = frame.position_to_file(*p);
            writeln!(text, "{} {} {} {}", p.x, p.y, p.z, frame.length_to_file(*r))?;
        }
        text.push(b'\n');
        out.write_all(&text)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn strands_end_in_an_empty_line() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::new(0.5, -0.25, 1.5), Vec3::ZERO], &[3.5e-5, 1e-5]);
        strands.push(&[Vec3::Z, Vec3::X], &[3.5e-5; 2]);
        let mut out = Vec::new();
        encode(&mut out, &strands, Frame::METRES_Y).unwrap();
        let text = String::from_utf8(out).unwrap();
        let first = "0.5 1.5 0.25 0.000035\n0 0 -0 0.00001\n\n";
        assert_eq!(text, format!("{first}0 1 -0 0.000035\n1 0 -0 0.000035\n\n"));
        strands.push(&[Vec3::X], &[1e-5]);
        assert!(check_strands("strand", &strands).is_err());
    }
}
