//! Cem Yuksel's `.hair`: a header of 128 bytes, then flat little-endian arrays.
//!
//! The format names no unit and no axes. frisure writes centimetres, z up, unless the caller says otherwise, and
//! the fibre's mean *diameter* as thickness, and says so in the header's text; the reader takes files
//! of centimetres, z up.
//!
//! Source of the layout: <http://www.cemyuksel.com/research/hairmodels/> ("HAIR file format").

use std::borrow::Cow;
use std::io::{self, Write};
use std::iter;

use frisure_strands::{AttributeValues, Domain, Strands};

use super::attributes::{COLOUR as COLOUR_ATTRIBUTE, of_points};
use super::curves::Curves;
use super::data::Groom;
use super::format::Declaration;
use frisure_files::frame::{Frame, FrameChoice};

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["hair"],
    title: "Cem Yuksel's hair file",
    frame: Frame::CENTIMETRES_Z,
    holds_guides: false,
    usual_points: None,
    most_hairs: None,
    check: |groom| check(groom.strands()),
    write: |out, samples, frame| encode(out, samples.groom.strands(), frame),
    moves: false,
    read: Some(decode),
};

const HEADER: usize = 128;
/// Name of the attribute of the points that are not opaque, from 0 to 1.
const TRANSPARENCY_ATTRIBUTE: &str = "transparency";
const SEGMENTS: u32 = 1;
const POINTS: u32 = 2;
const THICKNESS: u32 = 4;
const TRANSPARENCY: u32 = 8;
const COLOUR: u32 = 16;

/// The text in the header: at most 88 bytes.
fn info(frame: Frame) -> String {
    let up = frame.up.name();
    // Exactly a centimetre is what nearly all files have.
    let unit = if frame.metres == 0.01 {
        "centimetres".into()
    } else {
        format!("unit {} m", frame.metres)
    };
    let mut info = format!("frisure; {unit}, {up} up, thickness = diameter");
    info.truncate(88);
    info
}

/// Colour of strands that have none of their own: brown.
const DEFAULT_COLOUR: [f32; 3] = [0.25, 0.15, 0.09];

/// Checks that the format has room: strands of 2 to 65 536 points.
fn check(strands: &Strands) -> Result<(), String> {
    for (i, strand) in strands.iter().enumerate() {
        let points = strand.points.len();
        if points < 2 || points > 1 + usize::from(u16::MAX) {
            return Err(format!("strand {i} of {points} points: 2 to 65536 are possible"));
        }
    }
    if u32::try_from(strands.len()).is_err() {
        return Err(format!("{} strands", strands.len()));
    }
    Ok(())
}

/// Writes what [`check`] has passed.
fn encode(out: &mut dyn Write, strands: &Strands, frame: Frame) -> io::Result<()> {
    let segments = |i: usize| strands.offsets()[i + 1] - strands.offsets()[i] - 1;
    let first = if strands.is_empty() { 0 } else { segments(0) };
    // A single count in the header serves when all strands are alike.
    let alike = (0..strands.len()).all(|i| segments(i) == first);
    let colours = strands.attribute(COLOUR_ATTRIBUTE).and_then(|a| match (&a.domain, &a.values) {
        (Domain::Point, AttributeValues::F32x3(c)) => Some(Cow::Borrowed(c)),
        // The format has colours of points alone.
        (Domain::Strand, AttributeValues::F32x3(c)) => {
            let each = strands.iter().zip(c);
            let each = each.flat_map(|(strand, c)| iter::repeat_n(*c, strand.points.len()));
            Some(Cow::Owned(each.collect()))
        }
        _ => None,
    });
    let transparency = strands.attribute(TRANSPARENCY_ATTRIBUTE);
    let transparency = transparency.and_then(|a| match (&a.domain, &a.values) {
        (Domain::Point, AttributeValues::F32(t)) => Some(t),
        _ => None,
    });
    let thickness = strands.radii().first().map_or(0.0, |r| frame.length_to_file(2.0 * r));
    let mut arrays = POINTS | THICKNESS;
    if !alike {
        arrays |= SEGMENTS;
    }
    if transparency.is_some() {
        arrays |= TRANSPARENCY;
    }
    if colours.is_some() {
        arrays |= COLOUR;
    }

    let mut header = Vec::with_capacity(HEADER);
    header.extend_from_slice(b"HAIR");
    for n in [strands.len() as u32, strands.points().len() as u32, arrays, first] {
        header.extend_from_slice(&n.to_le_bytes());
    }
    for x in [thickness, 0.0].iter().chain(&DEFAULT_COLOUR) {
        header.extend_from_slice(&x.to_le_bytes());
    }
    header.extend_from_slice(info(frame).as_bytes());
    header.resize(HEADER, 0);
    out.write_all(&header)?;

    if !alike {
        for i in 0..strands.len() {
            out.write_all(&(segments(i) as u16).to_le_bytes())?;
        }
    }
    for p in strands.points() {
        write_floats(out, frame.position_to_file(*p).to_array())?;
    }
    for r in strands.radii() {
        write_floats(out, [frame.length_to_file(2.0 * r)])?;
    }
    for t in transparency.into_iter().flatten() {
        write_floats(out, [*t])?;
    }
    for c in colours.iter().flat_map(|colours| colours.iter()) {
        write_floats(out, *c)?;
    }
    Ok(())
}

fn write_floats<const N: usize>(out: &mut dyn Write, values: [f32; N]) -> io::Result<()> {
    // One call per value set: calls through `dyn` are what this costs.
    let mut bytes = [[0; 4]; N];
    for (b, v) in bytes.iter_mut().zip(values) {
        *b = v.to_le_bytes();
    }
    out.write_all(bytes.as_flattened())
}

/// Bytes of a file into hairs (m), or what is wrong with them; thickness is taken as the diameter.
fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let (header, mut rest) = bytes.split_at_checked(HEADER).ok_or_else(|| {
        format!("it has {} bytes, and the header alone has {HEADER}", bytes.len())
    })?;
    if !header.starts_with(b"HAIR") {
        return Err("it does not begin with `HAIR`".into());
    }
    let word = |i: usize| {
        let at = 4 + 4 * i;
        u32::from_le_bytes([header[at], header[at + 1], header[at + 2], header[at + 3]])
    };
    let (strands, points, arrays, default_segments) = (word(0), word(1), word(2), word(3));
    let default_thickness = f32::from_bits(word(4));
    if arrays & POINTS == 0 {
        return Err("it has no points".into());
    }
    check_size(rest.len(), strands, points, arrays)?;

    let (strands, points) = (strands as usize, points as usize);
    let mut take = |n: usize| {
        let (head, tail) = rest.split_at(n);
        rest = tail;
        head
    };
    let counts: Vec<usize> = if arrays & SEGMENTS == 0 {
        vec![default_segments as usize + 1; strands]
    } else {
        let words = take(2 * strands).chunks_exact(2);
        words.map(|b| usize::from(u16::from_le_bytes([b[0], b[1]])) + 1).collect()
    };
    // Bad counts are refused before memory is allocated for them.
    let total: usize = counts.iter().sum();
    if total != points {
        return Err(format!("its strands have {total} points, and the header says {points}"));
    }
    let positions = floats(take(12 * points)).as_chunks().0.to_vec();
    let diameters = if arrays & THICKNESS == 0 {
        vec![default_thickness; points]
    } else {
        floats(take(4 * points))
    };
    let mut attributes = Vec::new();
    if arrays & TRANSPARENCY != 0 {
        let values = AttributeValues::F32(floats(take(4 * points)));
        attributes.push(of_points(TRANSPARENCY_ATTRIBUTE, values));
    }
    if arrays & COLOUR != 0 {
        let values = AttributeValues::F32x3(floats(take(12 * points)).as_chunks().0.to_vec());
        attributes.push(of_points(COLOUR_ATTRIBUTE, values));
    }
    let curves = Curves { counts, points: positions, diameters, attributes };
    Ok(Groom::of(curves.strands(choice.or(FORMAT.frame))?))
}

/// Compares the counts in the header with the bytes that follow it, before anything is allocated
/// for them: counts lie.
fn check_size(found: usize, strands: u32, points: u32, arrays: u32) -> Result<(), String> {
    let [strands, points] = [strands, points].map(u64::from);
    let each = |flag: u32, bytes: u64| if arrays & flag == 0 { 0 } else { bytes };
    let per_point = 12 + each(THICKNESS, 4) + each(TRANSPARENCY, 4) + each(COLOUR, 12);
    let needed = strands * each(SEGMENTS, 2) + points * per_point;
    if (found as u64) < needed {
        return Err(format!("it is cut short: {found} bytes after the header instead of {needed}"));
    }
    // Without an array of segments nothing in the file backs up the number of strands.
    if strands > points {
        return Err(format!("{strands} strands cannot share {points} points"));
    }
    Ok(())
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.as_chunks().0.iter().map(|&b| f32::from_le_bytes(b)).collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::super::attributes::of_strands;
    use super::*;

    const CM: Frame = Frame::CENTIMETRES_Z;

    fn groom(counts: &[usize]) -> Strands {
        let mut strands = Strands::new();
        for (i, &n) in counts.iter().enumerate() {
            let points: Vec<_> =
                (0..n).map(|k| Vec3::new(i as f32 * 0.25, k as f32 * 0.5, -0.125)).collect();
            strands.push(&points, &vec![1.0 / 32_768.0; n]);
        }
        strands
    }

    fn bytes(strands: &Strands) -> Vec<u8> {
        let mut out = Vec::new();
        encode(&mut out, strands, CM).unwrap();
        out
    }

    #[test]
    fn the_header_is_yuksels() {
        let b = bytes(&groom(&[3, 2]));
        assert_eq!(&b[..4], b"HAIR");
        let word = |at: usize| u32::from_le_bytes(b[at..at + 4].try_into().unwrap());
        let float = |at: usize| f32::from_bits(word(at));
        assert_eq!((word(4), word(8), word(12), word(16)), (2, 5, 7, 2));
        assert_eq!(float(20), 2.0 / 32_768.0 * 100.0);
        assert_eq!(float(24), 0.0);
        assert_eq!([float(28), float(32), float(36)], DEFAULT_COLOUR);
        let info = b"frisure; centimetres, z up, thickness = diameter\0";
        assert_eq!(&b[40..40 + info.len()], info);
        // Segments, points, thickness.
        assert_eq!(b.len(), 128 + 2 * 2 + 5 * 12 + 5 * 4);
        assert_eq!(&b[128..132], &[2, 0, 1, 0]);
        assert_eq!(float(132 + 12 + 4), 50.0);
    }

    #[test]
    fn what_was_written_is_read() {
        for counts in [&[3, 2][..], &[4, 4, 4], &[2], &[]] {
            let strands = groom(counts);
            let read = decode(&bytes(&strands), FrameChoice::default()).unwrap().hairs;
            assert_eq!(read.offsets(), strands.offsets());
            for (a, b) in read.points().iter().zip(strands.points()) {
                assert!(a.distance(*b) < 1e-7);
            }
            for (a, b) in read.radii().iter().zip(strands.radii()) {
                assert!((a - b).abs() < 1e-11);
            }
        }
    }

    #[test]
    fn colours_and_transparency_come_back() {
        let mut strands = groom(&[3, 2]);
        let colours = AttributeValues::F32x3(vec![[0.5, 0.25, 0.125]; 5]);
        let transparency = AttributeValues::F32(vec![0.75; 5]);
        strands.set_attribute(of_points(TRANSPARENCY_ATTRIBUTE, transparency)).unwrap();
        strands.set_attribute(of_points(COLOUR_ATTRIBUTE, colours)).unwrap();
        let read = decode(&bytes(&strands), FrameChoice::default()).unwrap().hairs;
        assert_eq!(read.attributes(), strands.attributes());
    }

    #[test]
    fn colours_of_strands_are_those_of_their_points() {
        let mut strands = groom(&[3, 2]);
        let colours = AttributeValues::F32x3(vec![[0.5, 0.25, 0.125], [1.0; 3]]);
        strands.set_attribute(of_strands(COLOUR_ATTRIBUTE, colours)).unwrap();
        let read = decode(&bytes(&strands), FrameChoice::default()).unwrap().hairs;
        let [a, b] = [[0.5, 0.25, 0.125], [1.0; 3]];
        let expected = of_points(COLOUR_ATTRIBUTE, AttributeValues::F32x3(vec![a, a, a, b, b]));
        assert_eq!(read.attribute(COLOUR_ATTRIBUTE), Some(&expected));
    }

    #[test]
    fn equal_strands_need_no_segments() {
        let b = bytes(&groom(&[4, 4]));
        assert_eq!(b[12], 6);
        assert_eq!(b[16], 3);
    }

    #[test]
    fn cut_files_and_lying_counts_are_refused() {
        let whole = bytes(&groom(&[3, 2]));
        for n in 0..whole.len() {
            assert!(decode(&whole[..n], FrameChoice::default()).is_err(), "{n}");
        }
        for (at, value) in [(4, u32::MAX), (8, u32::MAX), (4, 1), (8, 4), (12, 0), (12, 31)] {
            let mut b = whole.clone();
            b[at..at + 4].copy_from_slice(&value.to_le_bytes());
            assert!(decode(&b, FrameChoice::default()).is_err(), "{value} at {at}");
        }
        let mut huge = bytes(&groom(&[2, 2]));
        huge[16..20].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(decode(&huge, FrameChoice::default()).is_err());
    }

    #[test]
    fn points_that_are_not_finite_are_refused() {
        let mut b = bytes(&groom(&[2]));
        b[128..132].copy_from_slice(&f32::NAN.to_le_bytes());
        let error = decode(&b, FrameChoice::default());
        assert_eq!(error, Err("point 0, of strand 0, is not finite".into()));
    }

    #[test]
    fn strands_without_points_have_no_place() {
        assert!(check(&groom(&[0])).is_err());
        assert!(check(&groom(&[65_536])).is_ok());
        assert!(check(&groom(&[65_537])).is_err());
    }
}
