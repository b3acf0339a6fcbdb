//! `.npz`: arrays of `NumPy` in a zip, for programs that learn.
//!
//! `positions` of N × P × 3 where all strands have the same number of points, else `points` of all and
//! `offsets`; `radii`, and an array for each attribute; those of guides with `guide_` in front. `metres` and
//! `up` say unit and axes. Metres, z up, unless the caller says otherwise. An attribute whose name would be taken for one
//! of these has `attribute_` in front.
//!
//! The zip is of the crate `zip`, without its other methods of compression; the headers of arrays are a line
//! of text each.

mod array;

use std::collections::BTreeMap;
use std::io::{self, Cursor, Read, Write};

use frisure_look::Melanin;
use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use zip::write::{SimpleFileOptions, ZipWriter};
use zip::{CompressionMethod, ZipArchive};

use self::array::{Array, header};
use super::attributes as names;
use super::checked::MAX_STRANDS;
use super::curves::Curves;
use super::data::{Groom, HairColour};
use super::format::Declaration;
use frisure_files::frame::{Frame, FrameChoice, UpAxis};

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["npz"],
    title: "arrays for NumPy",
    frame: Frame::METRES_Z,
    holds_guides: true,
    usual_points: None,
    most_hairs: None,
    check: |_| Ok(()),
    write: |out, samples, frame| encode(out, samples.groom, frame),
    moves: false,
    read: Some(decode),
};

/// Prefix of the names of arrays of guides.
const GUIDE: &str = "guide_";

/// Prefix of attributes whose names mean something else here.
const ATTRIBUTE: &str = "attribute_";

/// How much larger arrays can be than the file that they are packed in, and what they can have in any case.
const MOST_PACKED: u64 = 16;
const FREE: u64 = 64 << 20;

/// Arrays of a file beside those of strands.
const METRES: &str = "metres";
const UP: &str = "up";
const NAME: &str = "name";
const HAIR_COLOUR: &str = "hair_color";
const MELANIN: &str = "melanin";

/// Arrays of strands: their points, how many each has, and radii.
const POSITIONS: &str = "positions";
const STRANDS: &str = "strands";
const POINTS: &str = "points";
const OFFSETS: &str = "offsets";
const RADII: &str = "radii";

/// The name of the array of an attribute.
fn array_name(attribute: &str) -> String {
    const TAKEN: [&str; 10] =
        [POSITIONS, STRANDS, POINTS, OFFSETS, RADII, METRES, UP, NAME, HAIR_COLOUR, MELANIN];
    let is_taken =
        TAKEN.contains(&attribute) || is_of_guides(attribute) || attribute.starts_with(ATTRIBUTE);
    if is_taken { format!("{ATTRIBUTE}{attribute}") } else { attribute.to_owned() }
}

/// Whether an array is one of guides.
fn is_of_guides(name: &str) -> bool {
    name.starts_with(GUIDE) && name != names::GUIDE_WEIGHTS
}

/// Writes hairs and guides.
fn encode(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    let mut zip = ZipWriter::new_stream(out);
    strands(&mut zip, "", &groom.hairs, frame)?;
    if !groom.guides.is_empty() {
        strands(&mut zip, GUIDE, &groom.guides, frame)?;
    }
    array(&mut zip, METRES, "<f8", &[], 8, |out| out.extend(frame.metres.to_le_bytes()))?;
    text(&mut zip, UP, frame.up.name())?;
    text(&mut zip, NAME, &groom.name)?;
    if let Some(HairColour { colour, melanin }) = groom.colour {
        array(&mut zip, HAIR_COLOUR, "<f4", &[3], 12, |out| names::push(out, colour))?;
        if let Some(Melanin { eumelanin, pheomelanin }) = melanin {
            array(&mut zip, MELANIN, "<f4", &[2], 8, |out| {
                names::push(out, [eumelanin, pheomelanin]);
            })?;
        }
    }
    zip.finish()?;
    Ok(())
}

type Zip<'a> = ZipWriter<zip::write::StreamWriter<&'a mut dyn Write>>;

fn strands(zip: &mut Zip<'_>, prefix: &str, strands: &Strands, frame: Frame) -> io::Result<()> {
    let points = strands.points();
    let alike = alike(strands);
    // Each row is a strand, where all have as many points.
    let shape: Vec<usize> = match alike {
        Some(count) => vec![strands.len(), count],
        None => vec![points.len()],
    };
    let with = |extent: &[usize]| [&shape[..], extent].concat();
    let name = if alike.is_some() { POSITIONS } else { POINTS };
    array(zip, &format!("{prefix}{name}"), "<f4", &with(&[3]), 12 * points.len(), |out| {
        points.iter().for_each(|p| names::push(out, frame.position_to_file(*p).to_array()));
    })?;
    if alike.is_none() {
        let offsets = strands.offsets();
        let name = format!("{prefix}{OFFSETS}");
        array(zip, &name, "<i8", &[offsets.len()], 8 * offsets.len(), |out| {
            offsets.iter().for_each(|o| out.extend(i64::from(*o).to_le_bytes()));
        })?;
    }
    array(zip, &format!("{prefix}{RADII}"), "<f4", &shape, 4 * points.len(), |out| {
        strands.radii().iter().for_each(|r| names::push(out, [frame.length_to_file(*r)]));
    })?;
    for attribute in strands.attributes() {
        let each = match attribute.domain {
            Domain::Strand => vec![strands.len()],
            Domain::Point => shape.clone(),
        };
        let name = format!("{prefix}{}", array_name(&attribute.name));
        values(zip, &name, attribute, &each, frame)?;
    }
    Ok(())
}

/// The number of points that every strand has.
fn alike(strands: &Strands) -> Option<usize> {
    let first = strands.iter().next().map_or(0, |s| s.points.len());
    strands.iter().all(|s| s.points.len() == first).then_some(first)
}

fn values(
    zip: &mut Zip<'_>,
    name: &str,
    attribute: &Attribute,
    each: &[usize],
    frame: Frame,
) -> io::Result<()> {
    let values = &names::in_file_axes(attribute, frame).values;
    let (is_whole, width) = names::layout(values);
    let extent: &[usize] = if width > 1 { &[width] } else { &[] };
    let kind = if is_whole { "<u4" } else { "<f4" };
    array(zip, name, kind, &[each, extent].concat(), 4 * width * values.len(), |out| {
        (0..values.len()).for_each(|row| names::push_value(out, values, row));
    })
}

fn text(zip: &mut Zip<'_>, name: &str, text: &str) -> io::Result<()> {
    let letters: Vec<u32> = text.chars().map(u32::from).collect();
    if letters.is_empty() {
        return Ok(());
    }
    array(zip, name, &format!("<U{}", letters.len()), &[], 4 * letters.len(), |out| {
        letters.iter().for_each(|c| out.extend(c.to_le_bytes()));
    })
}

/// Adds an array of `size` bytes. They are not packed: numbers of hair gain little, and take long.
fn array(
    zip: &mut Zip<'_>,
    name: &str,
    kind: &str,
    shape: &[usize],
    size: usize,
    fill: impl FnOnce(&mut Vec<u8>),
) -> io::Result<()> {
    let mut bytes = header(kind, shape);
    bytes.reserve_exact(size);
    fill(&mut bytes);
    // Without a date: the same groom gives the same bytes.
    let options = SimpleFileOptions::default()
        .compression_method(CompressionMethod::Stored)
        .last_modified_time(zip::DateTime::default())
        .large_file(bytes.len() > 1 << 31);
    zip.start_file(format!("{name}.npy"), options)?;
    zip.write_all(&bytes)
}

/// Bytes of a file into a groom, or what is wrong with them.
fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let mut arrays = arrays(bytes)?;
    let metres = arrays.remove(METRES).and_then(|a| a.number());
    let up = arrays.remove(UP).and_then(|a| a.text());
    let up = up.map(|t| if t == "y" { UpAxis::Y } else { UpAxis::Z });
    let frame = choice.or(FrameChoice { metres, up, ..FrameChoice::default() }.or(FORMAT.frame));
    let name = arrays.remove(NAME).and_then(|a| a.text()).unwrap_or_default();
    let colour = colour(&mut arrays);
    let keys: Vec<String> = arrays.keys().cloned().collect();
    let mut guides = BTreeMap::new();
    // Without points of guides they are attributes with such names, of another program.
    let has_guides =
        [POSITIONS, STRANDS, POINTS].iter().any(|k| keys.contains(&format!("{GUIDE}{k}")));
    for key in keys.iter().filter(|k| has_guides && is_of_guides(k)) {
        if let Some(array) = arrays.remove(key) {
            guides.insert(key[GUIDE.len()..].to_owned(), array);
        }
    }
    if ![POSITIONS, STRANDS, POINTS].iter().any(|k| arrays.contains_key(*k)) {
        return Err(format!("it has no `positions` and no `points`, but {}", keys.join(", ")));
    }
    let hairs = curves(arrays, frame)?.strands(frame)?;
    let guides = if guides.is_empty() {
        Strands::new()
    } else {
        let of_guides = |e: String| format!("of its guides: {e}");
        curves(guides, frame).and_then(|c| c.strands(frame)).map_err(of_guides)?
    };
    Ok(Groom { name, hairs, guides, colour, ..Groom::default() })
}

fn colour(arrays: &mut BTreeMap<String, Array>) -> Option<HairColour> {
    let mut pair = |name: &str, count: usize| {
        let values = arrays.remove(name)?.real()?;
        (values.len() == count).then_some(values)
    };
    let (colour, melanin) = (pair(HAIR_COLOUR, 3), pair(MELANIN, 2));
    let melanin = melanin.map(|m| Melanin { eumelanin: m[0], pheomelanin: m[1] });
    colour.map(|c| HairColour { colour: [c[0], c[1], c[2]], melanin })
}

/// All arrays that a groom can have, by their names.
fn arrays(bytes: &[u8]) -> Result<BTreeMap<String, Array>, String> {
    let described = |e: zip::result::ZipError| format!("its zip is damaged: {e}");
    let mut zip = ZipArchive::new(Cursor::new(bytes)).map_err(described)?;
    // What is unpacked is counted: a small file can hold a lot of zeros.
    let mut left = MOST_PACKED * bytes.len() as u64 + FREE;
    let mut arrays = BTreeMap::new();
    for i in 0..zip.len() {
        let file = zip.by_index(i).map_err(described)?;
        let name = file.name().map_err(described)?;
        let Some(name) = name.strip_suffix(".npy").map(str::to_owned) else { continue };
        let plain = |b: u8| b.is_ascii_alphanumeric() || b"_.:-".contains(&b);
        if name.is_empty() || name.len() > 64 || !name.bytes().all(plain) {
            continue;
        }
        if file.size() > left {
            return Err(format!("`{name}` is {} bytes, far more than the file", file.size()));
        }
        let mut inner = Vec::new();
        let mut limited = file.take(left + 1);
        let size = limited.read_to_end(&mut inner).map_err(|e| format!("`{name}`: {e}"))?;
        let size = size as u64;
        left =
            left.checked_sub(size).ok_or_else(|| format!("`{name}` is far more than the file"))?;
        if let Some(array) = Array::read(inner).map_err(|e| format!("`{name}`: {e}"))? {
            arrays.insert(name, array);
        }
    }
    Ok(arrays)
}

/// Strands of arrays.
fn curves(mut arrays: BTreeMap<String, Array>, frame: Frame) -> Result<Curves, String> {
    let rows = arrays.remove(POSITIONS).or_else(|| arrays.remove(STRANDS));
    let (counts, points) = match rows {
        Some(array) => even(array)?,
        None => uneven(&mut arrays)?,
    };
    let mut curves = Curves { counts, points, ..Curves::default() };
    let total = curves.points.len();
    if let Some(radii) = arrays.remove(RADII) {
        let radii = radii.real().ok_or("`radii` are no real numbers")?;
        if radii.len() != total {
            return Err(format!("`radii` are {}, and there are {total} points", radii.len()));
        }
        curves.diameters = radii.into_iter().map(|r| 2.0 * r).collect();
    }
    for (name, array) in arrays {
        let name = name.strip_prefix(ATTRIBUTE).map_or(name.clone(), str::to_owned);
        curves.attributes.extend(attribute(name, array, curves.counts.len(), total, frame)?);
    }
    Ok(curves)
}

type Rows = (Vec<usize>, Vec<[f32; 3]>);

fn triples(array: &Array) -> Option<Vec<[f32; 3]>> {
    Some(array.real()?.as_chunks().0.to_vec())
}

fn even(array: Array) -> Result<Rows, String> {
    let shape = &array.shape;
    let (&[strands, count, 3], Some(points)) = (&shape[..], triples(&array)) else {
        return Err(format!("`positions` are {shape:?}, and should be real numbers, N × P × 3"));
    };
    // Rows without points would be as many as anyone likes.
    if count == 0 && strands > 0 || strands > MAX_STRANDS {
        return Err(format!("`positions` are {strands} strands of {count} points"));
    }
    Ok((vec![count; strands], points))
}

fn uneven(arrays: &mut BTreeMap<String, Array>) -> Result<Rows, String> {
    let points = arrays.remove(POINTS).ok_or("it has neither `positions` nor `points`")?;
    let (&[total, 3], Some(points)) = (&points.shape[..], triples(&points)) else {
        return Err(format!("`points` are {:?}, and should be real numbers, N × 3", points.shape));
    };
    let offsets = arrays.remove(OFFSETS).and_then(|a| a.whole());
    let offsets = offsets.ok_or("it has `points`, but no whole `offsets`")?;
    if offsets.first() != Some(&0) || offsets.last() != Some(&(total as i128)) {
        return Err(format!("`offsets` do not go from 0 to {total}"));
    }
    let counts = offsets.windows(2).enumerate().map(|(i, w)| {
        let count = w[1].checked_sub(w[0]).and_then(|n| usize::try_from(n).ok());
        count.ok_or_else(|| format!("`offsets` decrease at strand {i}"))
    });
    Ok((counts.collect::<Result<_, _>>()?, points))
}

/// An attribute, if an array is one: for strands or points, of one to three numbers.
fn attribute(
    name: String,
    array: Array,
    strands: usize,
    points: usize,
    frame: Frame,
) -> Result<Option<Attribute>, String> {
    let Some((domain, extent)) = meaning(&name, &array.shape, strands, points) else {
        return Ok(None);
    };
    let values = match array.whole() {
        Some(whole) => whole_values(&name, &whole, extent)?,
        None => array.real().and_then(|real| names::real_values(real, extent)),
    };
    let Some(values) = values else { return Ok(None) };
    let mut attribute = Attribute { name, domain, values };
    names::turn_directions(&mut attribute, |d| frame.direction_from_file(d));
    Ok(Some(attribute))
}

/// Whole numbers as an attribute has them: of 32 bits without a sign, where -1 is the largest, as it is written for nothing; other numbers below
/// 0 as real ones, if single precision has them all.
fn whole_values(
    name: &str,
    whole: &[i128],
    extent: usize,
) -> Result<Option<AttributeValues>, String> {
    if whole.iter().all(|x| (-1..=i128::from(u32::MAX)).contains(x)) {
        return Ok(names::whole_values(whole.iter().map(|&x| x as u32).collect(), extent));
    }
    match whole.iter().position(|x| x.abs() > MOST_REAL) {
        None => Ok(names::real_values(whole.iter().map(|&x| x as f32).collect(), extent)),
        Some(at) => Err(format!(
            "`{name}` has {} in row {}, and whole numbers of an attribute are from -1 to {}, or within {MOST_REAL} of 0",
            whole[at],
            at / extent,
            u32::MAX
        )),
    }
}

/// Up to here every whole number is one of single precision.
const MOST_REAL: i128 = 1 << 24;

/// The domain of an array, and how many numbers make one value.
fn meaning(name: &str, shape: &[usize], strands: usize, points: usize) -> Option<(Domain, usize)> {
    let small = |extent: usize| (1..=3).contains(&extent).then_some(extent);
    let of_strands = || match *shape {
        [n] if n == strands => Some((Domain::Strand, 1)),
        [n, extent] if n == strands => Some((Domain::Strand, small(extent)?)),
        _ => None,
    };
    // Of points, with a row for each strand or without.
    let of_points = || match *shape {
        [n] if n == points => Some((Domain::Point, 1)),
        [n, extent] if n == points => Some((Domain::Point, small(extent)?)),
        [n, count] if n == strands && n.checked_mul(count) == Some(points) => {
            Some((Domain::Point, 1))
        }
        [n, count, extent] if n == strands && n.checked_mul(count) == Some(points) => {
            Some((Domain::Point, small(extent)?))
        }
        _ => None,
    };
    // Strands of two or three points are distinguished from pairs and triples by the arrays that have these.
    let several = [names::CLOSEST_GUIDES, names::GUIDE_WEIGHTS, names::ROOT_UV, names::COLOUR];
    if several.contains(&name) || shape.len() == 1 {
        of_strands().or_else(of_points)
    } else {
        of_points().or_else(of_strands)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn with_whole(name: &str, numbers: &[i64]) -> Vec<u8> {
        let mut out = Vec::new();
        let mut zip = ZipWriter::new_stream(&mut out as &mut dyn Write);
        let rows = numbers.len();
        array(&mut zip, POSITIONS, "<f4", &[rows, 2, 3], 24 * rows, |out| {
            (0..6 * rows).for_each(|i| names::push(out, [0.01 * i as f32]));
        })
        .unwrap();
        array(&mut zip, name, "<i8", &[rows], 8 * rows, |out| {
            numbers.iter().for_each(|x| out.extend(x.to_le_bytes()));
        })
        .unwrap();
        zip.finish().unwrap();
        out
    }

    #[test]
    fn whole_numbers_are_read_as_they_are_or_refused() {
        let read =
            |numbers: &[i64]| decode(&with_whole("My.attr-2", numbers), FrameChoice::default());
        let values = |numbers: &[i64]| {
            let groom = read(numbers).unwrap();
            groom.hairs.attribute("My.attr-2").unwrap().values.clone()
        };
        assert_eq!(
            values(&[-1, 0, 4_294_967_295]),
            AttributeValues::U32(vec![u32::MAX, 0, u32::MAX])
        );
        assert_eq!(values(&[-5, 300]), AttributeValues::F32(vec![-5.0, 300.0]));
        let error = read(&[7, 4_294_967_297]).unwrap_err();
        assert!(error.contains("`My.attr-2` has 4294967297 in row 1"), "{error}");
        assert!(read(&[-16_777_217]).is_err());
    }
}
