//! Wavefront `.obj` polylines (`v` and `l`): read by nearly everything, without thickness. What holds the hair follows as objects of
//! faces.
//!
//! Metres, y up with the face towards +z, unless the caller says otherwise, as programs expect of OBJ and as heads
//! are read: a groom predicted on an OBJ head in metres lies on that head.

use std::io::{self, Write};

use frisure_strands::{AccessoryMesh, Strands};
use glam::Vec3;

use super::data::Groom;
use super::format::Declaration;
use super::lines::Lines;
use crate::accessory_names::OBJECT;
use frisure_files::frame::{Frame, FrameChoice};

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["obj"],
    title: "Wavefront polylines",
    frame: Frame::METRES_Y,
    holds_guides: false,
    usual_points: None,
    most_hairs: None,
    check: |_| Ok(()),
    write: |out, samples, frame| {
        encode(out, samples.groom.strands(), frame)?;
        encode_meshes(out, samples.groom, frame)
    },
    moves: false,
    read: Some(decode),
};

/// Writes strands as one `l` each.
fn encode(out: &mut dyn Write, strands: &Strands, frame: Frame) -> io::Result<()> {
    let (count, points) = (strands.len(), strands.points().len());
    let up = frame.up.name();
    writeln!(out, "# frisure: {count} strands, {points} points; unit {} m, {up} up", frame.metres)?;
    let mut line = Vec::with_capacity(1 << 12);
    for &point in strands.points() {
        write_vertex(out, point, frame, &mut line)?;
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

/// Writes what holds the hair as one object each, after the points of the strands.
fn encode_meshes(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    let mut line = Vec::with_capacity(1 << 7);
    // OBJ counts from 1.
    let mut first = groom.strands().points().len() + 1;
    for AccessoryMesh { name, surface, .. } in &groom.accessories {
        writeln!(out, "o {OBJECT}{name}")?;
        for point in surface.positions() {
            write_vertex(out, point.as_vec3(), frame, &mut line)?;
        }
        for face in surface.triangles() {
            let [a, b, c] = face.map(|v| first + v as usize);
            writeln!(out, "f {a} {b} {c}")?;
        }
        first += surface.positions().len();
    }
    Ok(())
}

fn write_vertex(
    out: &mut dyn Write,
    point: Vec3,
    frame: Frame,
    line: &mut Vec<u8>,
) -> io::Result<()> {
    line.clear();
    line.push(b'v');
    let Vec3 { x, y, z } = frame.position_to_file(point);
    for c in [x, y, z] {
        line.push(b' ');
        push_decimal(line, c);
    }
    line.push(b'\n');
    out.write_all(line)
}

/// A coordinate with seven decimals, a thousandth of a hair's diameter; the general formatter takes
/// most of the time of such a file.
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

/// Bytes of a file into hairs (m), or what is wrong with them. Faces and all else are passed over.
fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut points: Vec<[f32; 3]> = Vec::new();
    let mut lines = Lines::default();
    let mut line: Vec<u32> = Vec::new();
    let mut goes_on = false;
    for (number, text) in bytes.split(|b| *b == b'\n').enumerate() {
        let within = |what: String| format!("in line {}, {what}", number + 1);
        let mut words = text.split(u8::is_ascii_whitespace).filter(|w| !w.is_empty()).peekable();
        let kind = if goes_on { Some(&b"l"[..]) } else { words.next() };
        match kind {
            Some(b"v") => points.push(position(&mut words).map_err(within)?),
            Some(b"l") => {
                goes_on = false;
                for word in words {
                    if word == b"\\" {
                        goes_on = true;
                        break;
                    }
                    line.push(index(word, points.len()).map_err(within)?);
                }
                if !goes_on {
                    lines.push(&line);
                    line.clear();
                }
            }
            Some(b"curv" | b"curv2") => {
                return Err(within(
                    "there is a spline (`curv`), and only lines (`l`) are read".into(),
                ));
            }
            _ => {}
        }
    }
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err("it is empty".into());
    }
    if lines.is_empty() && !points.is_empty() {
        return Err("it has points, but no lines (`l`)".into());
    }
    let curves = lines.curves(&points, &[])?;
    Ok(Groom::of(curves.strands(choice.or(FORMAT.frame))?))
}

fn position<'a>(words: &mut impl Iterator<Item = &'a [u8]>) -> Result<[f32; 3], String> {
    let mut point = [0.0; 3];
    for x in &mut point {
        let word = words.next().ok_or("a point has fewer than 3 numbers")?;
        let parsed = std::str::from_utf8(word).ok().and_then(|w| w.parse().ok());
        *x = parsed.ok_or_else(|| format!("`{}` is no number", String::from_utf8_lossy(word)))?;
    }
    Ok(point)
}

/// The number of a point, from 0: in the file from 1, or from the last one backwards.
fn index(word: &[u8], points: usize) -> Result<u32, String> {
    // What follows a slash is a texture coordinate.
    let first = word.split(|b| *b == b'/').next().unwrap_or(word);
    let parsed = std::str::from_utf8(first).ok().and_then(|w| w.parse::<i64>().ok());
    let found = parsed.and_then(|i| match i {
        1.. => Some(i - 1),
        0 => None,
        _ => i.checked_add(points as i64),
    });
    let found = found.and_then(|i| u32::try_from(i).ok());
    found.ok_or_else(|| format!("`{}` is no point", String::from_utf8_lossy(word)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_other_programs_are_read() {
        let text = "o hair\nv 0 1 0 1.0\nv 0 0.5 0\nv 0 0 0.1\nf 1 2 3\nl 1 2\nl 2/7 3\n\
                    v 0 0 1\nl -1 -2 \\\n 1\r\n";
        let groom = decode(text.as_bytes(), FrameChoice::default()).unwrap();
        assert_eq!(groom.hairs.offsets(), [0, 3, 6]);
        assert_eq!(groom.hairs.strand(1).points[0], Vec3::NEG_Y);
        for wrong in
            ["l 1 2", "v 0 0 0\nl 1 0", "v 0 0\n", "v 0 0 x", "v 0 0 0", "curv 0 1 1 2", "", "\r\n"]
        {
            assert!(decode(wrong.as_bytes(), FrameChoice::default()).is_err(), "{wrong}");
        }
        assert!(decode(b"v 0 0 0\nv 0 1 0\nl -3 1", FrameChoice::default()).is_err());
    }

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
