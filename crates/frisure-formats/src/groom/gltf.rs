//! glTF 2.0 in one binary file (`.glb`): lines for a preview in a browser, without thickness.
//!
//! Metres and y up, face towards +z, as glTF demands. One mesh of `LINES` for hairs and one for guides, in one
//! buffer, lit by nothing, each point with its colour.
//!
//! The JSON is a few lines, so that no crate for it is needed.

use std::io::{self, Write};

use frisure_strands::{AttributeValues, Domain, Strands};
use glam::Vec3;
use serde_json::{Value, json};

use super::attributes::COLOUR;
use super::data::Groom;
use super::format::Declaration;
use frisure_files::frame::Frame;

/// The declaration of the format.
pub(super) static FORMAT: Declaration = Declaration {
    extensions: &["glb"],
    title: "glTF lines for the web",
    frame: Frame::METRES_Y,
    holds_guides: true,
    usual_points: None,
    most_hairs: None,
    check,
    write: |out, samples, frame| encode(out, samples.groom, frame),
    moves: false,
    read: None,
};

/// Colour of hair without a colour: brown.
const BROWN: [f32; 3] = [0.1, 0.05, 0.025];

/// Checks that the format has room: lines, in a buffer of 4 GiB.
fn check(groom: &Groom) -> Result<(), String> {
    let size: u64 = parts(groom).map(|(_, s)| size(s)).sum();
    if size == 0 {
        return Err("a groom without lines".into());
    }
    if size > u64::from(u32::MAX) / 2 {
        return Err(format!("{size} bytes"));
    }
    Ok(())
}

/// Strands that have lines, with their names.
fn parts(groom: &Groom) -> impl Iterator<Item = (&'static str, &Strands)> {
    let all = [("hair", &groom.hairs), ("guides", &groom.guides)];
    all.into_iter().filter(|(_, strands)| lines(strands) > 0)
}

fn lines(strands: &Strands) -> usize {
    strands.iter().map(|s| s.points.len().saturating_sub(1)).sum()
}

fn size(strands: &Strands) -> u64 {
    24 * strands.points().len() as u64 + 8 * lines(strands) as u64
}

/// Writes what [`check`] has passed.
fn encode(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    let colour = groom.colour.map_or(BROWN, |c| c.colour);
    let (mut views, mut accessors) = (Vec::new(), Vec::new());
    let (mut meshes, mut nodes) = (Vec::new(), Vec::new());
    let mut bytes: u64 = 0;
    for (name, strands) in parts(groom) {
        let first = accessors.len();
        let points = strands.points().len();
        let (low, high) = bounds(strands, frame);
        // 5126: f32, 5125: u32; 34962: of vertices, 34963: of indices.
        for (size, target) in
            [(12 * points, 34962), (12 * points, 34962), (8 * lines(strands), 34963)]
        {
            views.push(json!({
                "buffer": 0, "byteOffset": bytes, "byteLength": size, "target": target
            }));
            bytes += size as u64;
        }
        let of = |view: usize, kind: u32, count: usize, shape: &str| -> Value {
            json!({ "bufferView": view, "componentType": kind, "count": count, "type": shape })
        };
        let mut position = of(first, 5126, points, "VEC3");
        position["min"] = json!(low.to_array());
        position["max"] = json!(high.to_array());
        accessors.push(position);
        accessors.push(of(first + 1, 5126, points, "VEC3"));
        accessors.push(of(first + 2, 5125, 2 * lines(strands), "SCALAR"));
        nodes.push(json!({ "mesh": meshes.len(), "name": name }));
        meshes.push(json!({ "name": name, "primitives": [{
            "attributes": { "POSITION": first, "COLOR_0": first + 1 },
            "indices": first + 2, "mode": 1, "material": 0
        }]}));
    }
    let json = json!({
        "asset": { "version": "2.0", "generator": "frisure" },
        "extensionsUsed": ["KHR_materials_unlit"],
        "scene": 0,
        "scenes": [{ "nodes": (0..nodes.len()).collect::<Vec<_>>() }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": [{ "name": "hair", "extensions": { "KHR_materials_unlit": {} } }],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{ "byteLength": bytes }]
    });
    let mut json = serde_json::to_vec(&json).map_err(io::Error::other)?;
    json.resize(json.len().next_multiple_of(4), b' ');

    let total = 12 + 8 + json.len() as u64 + 8 + bytes;
    out.write_all(b"glTF")?;
    write_words(out, [2, total as u32, json.len() as u32])?;
    out.write_all(b"JSON")?;
    out.write_all(&json)?;
    write_words(out, [bytes as u32])?;
    out.write_all(b"BIN\0")?;
    for (_, strands) in parts(groom) {
        for p in strands.points() {
            let p = frame.position_to_file(*p).to_array();
            write_words(out, p.map(f32::to_bits))?;
        }
        write_colours(out, strands, colour)?;
        for strand in strands.offsets().windows(2) {
            for a in strand[0]..strand[1].saturating_sub(1).max(strand[0]) {
                write_words(out, [a, a + 1])?;
            }
        }
    }
    Ok(())
}

/// Smallest and largest coordinates, as the file has them.
fn bounds(strands: &Strands, frame: Frame) -> (Vec3, Vec3) {
    let points = strands.points().iter().map(|p| frame.position_to_file(*p));
    points.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)))
}

fn write_colours(out: &mut dyn Write, strands: &Strands, usual: [f32; 3]) -> io::Result<()> {
    let own = strands.attribute(COLOUR).and_then(|a| match &a.values {
        AttributeValues::F32x3(values) => Some((a.domain, values)),
        _ => None,
    });
    for (i, strand) in strands.offsets().windows(2).enumerate() {
        for point in strand[0] as usize..strand[1] as usize {
            let colour = match own {
                Some((Domain::Point, values)) => values[point],
                Some((Domain::Strand, values)) => values[i],
                None => usual,
            };
            write_words(out, colour.map(|c| c.clamp(0.0, 1.0).to_bits()))?;
        }
    }
    Ok(())
}

fn write_words<const N: usize>(out: &mut dyn Write, words: [u32; N]) -> io::Result<()> {
    out.write_all(words.map(u32::to_le_bytes).as_flattened())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lengths_are_told() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::X, Vec3::Y, Vec3::Z], &[1e-5; 3]);
        strands.push(&[Vec3::X], &[1e-5]);
        strands.push(&[Vec3::ZERO, Vec3::Y], &[1e-5; 2]);
        let groom = Groom { guides: strands.clone(), ..Groom::of(strands) };
        check(&groom).unwrap();
        let mut out = Vec::new();
        encode(&mut out, &groom, Frame::METRES_Y).unwrap();
        let word = |at: usize| u32::from_le_bytes(out[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&out[..4], word(4), word(8)), (&b"glTF"[..], 2, out.len()));
        let json: Value = serde_json::from_slice(&out[20..20 + word(12)]).unwrap();
        let bin = 20 + word(12);
        assert_eq!(word(bin), 2 * (6 * 24 + 3 * 8));
        assert_eq!(json["buffers"][0]["byteLength"], word(bin));
        assert_eq!(json["accessors"][3]["max"], json!([1.0, 1.0, 0.0]));
        assert_eq!(json["accessors"][5]["count"], 6);
        // The last line goes between the last two points.
        assert_eq!((word(out.len() - 8), word(out.len() - 4)), (4, 5));
    }

    #[test]
    fn points_without_lines_have_no_place() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::X], &[1e-5]);
        assert!(check(&Groom::of(strands)).is_err());
        assert!(check(&Groom::default()).is_err());
    }
}
