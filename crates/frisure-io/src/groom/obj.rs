//! Wavefront `.obj` polylines (`v` and `l`): read by nearly everything, without thickness.
//!
//! Metres, y up with the face towards +z, unless told otherwise, as programs expect of OBJ and as heads
//! are read: a groom predicted on an OBJ head in metres lies on that head.

use std::io::{self, Write};

use frisure_strands::Strands;
use glam::Vec3;

use crate::frame::{Frame, UpAxis};

/// Writes strands as one `l` each.
pub(super) fn encode(out: &mut dyn Write, strands: &Strands, frame: Frame) -> io::Result<()> {
    let (count, points) = (strands.len(), strands.points().len());
    let up = match frame.up {
        UpAxis::Y => 'y',
        UpAxis::Z => 'z',
    };
    writeln!(out, "# frisure: {count} strands, {points} points; unit {} m, {up} up", frame.metres)?;
    let mut line = Vec::with_capacity(1 << 12);
    for &point in strands.points() {
        line.clear();
        line.push(b'v');
        let Vec3 { x, y, z } = frame.position_to_file(point);
        for c in [x, y, z] {
            line.push(b' ');
            push_decimal(&mut line, c);
        }
        line.push(b'\n');
        out.write_all(&line)?;
    }
    for pair in strands.offsets().windows(2) {
        // A line needs two points.
        if pair[1] - pair[0] < 2 {
            continue;
        }
        line.clear();
        line.push(b'l');
        for i in pair[0]..pair[1] {
            line.push(b' ');
            // OBJ counts from 1.
            push_digits(&mut line, u64::from(i) + 1, 1);
        }
        line.push(b'\n');
        out.write_all(&line)?;
    }
    Ok(())
}

/// A coordinate with seven decimals, a thousandth of a hair's diameter; the general formatter takes
/// most of the time of such a file.
#[expect(clippy::cast_possible_truncation, reason = "coordinates of heads are far below 10^11 m")]
fn push_decimal(line: &mut Vec<u8>, value: f32) {
    if !value.is_finite() || value.abs() > 1e9 {
        line.extend_from_slice(value.to_string().as_bytes());
        return;
    }
    let scaled = (f64::from(value) * 1e7).round() as i64;
    if scaled < 0 {
        line.push(b'-');
    }
    let scaled = scaled.unsigned_abs();
    push_digits(line, scaled / 10_000_000, 1);
    line.push(b'.');
    push_digits(line, scaled % 10_000_000, 7);
}

/// Decimal digits, with zeros in front up to `width`.
fn push_digits(line: &mut Vec<u8>, mut value: u64, width: usize) {
    let mut digits = [b'0'; 20];
    let mut at = digits.len();
    while value > 0 {
        at -= 1;
        digits[at] = b'0' + (value % 10) as u8;
        value /= 10;
    }
    line.extend_from_slice(&digits[at.min(digits.len() - width)..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_in_metres_with_y_up() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::new(0.1, -0.25, 1.5), Vec3::new(-1e-7, 0.0, -12.0)], &[1e-5; 2]);
        strands.push(&[Vec3::ZERO], &[1e-5]);
        strands.push(&[Vec3::ZERO, Vec3::X, Vec3::Y], &[1e-5; 3]);
        let mut out = Vec::new();
        encode(&mut out, &strands, Frame::METRES_Y).unwrap();
        let text = String::from_utf8(out).unwrap();
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines[0], "# frisure: 3 strands, 6 points; unit 1 m, y up");
        assert_eq!(lines[1], "v 0.1000000 1.5000000 0.2500000");
        assert_eq!(lines[2], "v -0.0000001 -12.0000000 0.0000000");
        assert_eq!(&lines[7..], ["l 1 2", "l 4 5 6"]);
    }
}
