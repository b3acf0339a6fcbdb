//! `.data` of USC-HairSalon: the format of data sets of hairstyles and of what learns from them.
//!
//! A number of strands, and for each a number of points and the points; all little-endian, i32 and f32.
//! Metres, y up, face towards +z, as that data set has them. A strand of one point means that nothing grows from
//! there. Most programs expect 100 points of each strand.
//!
//! Source of the layout: Hu et al., Single-View Hair Modeling Using A Hairstyle Database, 2015, and the page
//! of its data set.

use std::io::{self, Write};

use frisure_strands::Strands;

use super::curves::Curves;
use super::data::Groom;
use super::format::Declaration;
use frisure_files::frame::{Frame, FrameChoice};

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["data"],
    title: "hairstyles of USC-HairSalon",
    frame: Frame::METRES_Y,
    holds_guides: false,
    usual_points: Some(100),
    most_hairs: None,
    check: |groom| check(groom.strands()),
    write: |out, samples, frame| encode(out, samples.groom.strands(), frame),
    moves: false,
    read: Some(decode),
};

/// Checks that the format has room: counts are signed.
fn check(strands: &Strands) -> Result<(), String> {
    match i32::try_from(strands.points().len().max(strands.len())) {
        Ok(_) => Ok(()),
        Err(_) => Err(format!("{} points", strands.points().len())),
    }
}

/// Writes what [`check`] has passed.
fn encode(out: &mut dyn Write, strands: &Strands, frame: Frame) -> io::Result<()> {
    out.write_all(&(strands.len() as i32).to_le_bytes())?;
    let mut bytes = Vec::new();
    for strand in strands.iter() {
        bytes.clear();
        bytes.extend((strand.points.len() as i32).to_le_bytes());
        for &p in strand.points {
            let p = frame.position_to_file(p).to_array();
            bytes.extend_from_slice(p.map(f32::to_le_bytes).as_flattened());
        }
        out.write_all(&bytes)?;
    }
    Ok(())
}

/// Bytes of a file into hairs (m), or what is wrong with them.
fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let (first, mut rest) = bytes.split_first_chunk().ok_or("it has no number of strands")?;
    let strands = i32::from_le_bytes(*first);
    // Each has at least its number of points.
    if strands < 0 || rest.len() / 4 < strands as usize {
        return Err(format!("{strands} strands cannot be in {} bytes", bytes.len()));
    }
    let mut curves = Curves::default();
    for strand in 0..strands {
        let cut = || format!("it is cut short at strand {strand} of {strands}");
        let (count, tail) = rest.split_first_chunk().ok_or_else(cut)?;
        let count = i32::from_le_bytes(*count);
        let count =
            usize::try_from(count).map_err(|_| format!("strand {strand} has {count} points"))?;
        let size = count.checked_mul(12).ok_or_else(cut)?;
        let (points, tail) = tail.split_at_checked(size).ok_or_else(cut)?;
        rest = tail;
        // Nothing grows there.
        if count < 2 {
            continue;
        }
        let words = points.as_chunks::<4>().0.as_chunks().0.iter();
        curves.points.extend(words.map(|p: &[[u8; 4]; 3]| p.map(f32::from_le_bytes)));
        curves.counts.push(count);
    }
    if !rest.is_empty() {
        return Err(format!("{} bytes follow its last strand", rest.len()));
    }
    Ok(Groom::of(curves.strands(choice.or(FORMAT.frame))?))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn the_layout_is_that_of_the_data_set() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::new(0.0, -0.5, 1.75), Vec3::new(0.25, 0.0, 1.5)], &[1e-5; 2]);
        let mut out = Vec::new();
        encode(&mut out, &strands, Frame::METRES_Y).unwrap();
        let words: Vec<u32> = out.as_chunks().0.iter().map(|w| u32::from_le_bytes(*w)).collect();
        let floats = [0.0, 1.75, 0.5, 0.25, 1.5, -0.0].map(f32::to_bits);
        assert_eq!(words[..2], [1, 2]);
        assert_eq!(words[2..], floats);
    }

    #[test]
    fn roots_without_hair_are_left_out() {
        let mut bytes = 3_i32.to_le_bytes().to_vec();
        for count in [1, 2, 0] {
            bytes.extend(i32::to_le_bytes(count));
            bytes.extend((0..3 * count).flat_map(|k| (0.1 * k as f32).to_le_bytes()));
        }
        let groom = decode(&bytes, FrameChoice::default()).unwrap();
        assert_eq!(groom.hairs.offsets(), [0, 2]);
        for n in 0..bytes.len() {
            assert!(decode(&bytes[..n], FrameChoice::default()).is_err(), "{n}");
        }
        bytes[0] = 0xff;
        assert!(decode(&bytes, FrameChoice::default()).is_err());
    }
}
