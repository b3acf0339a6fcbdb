//! glTF 2.0 in one binary file (`.glb`): lines for a preview in a browser, without thickness.
//!
//! Metres and y up, face towards +z, as glTF demands. One mesh of `LINES` for hairs and one for guides, in one
//! buffer, lit by nothing, each point with its colour; what holds the hair as meshes of triangles under one node.
//!
//! The JSON is a few lines, so that no crate for it is needed.

use std::io::{self, Write};

use frisure_strands::{AccessoryMesh, AttributeValues, Domain, Strands, Surface};
use glam::Vec3;
use serde_json::{Value, json};

use super::attributes::COLOUR;
use super::data::Groom;
use super::format::Declaration;
use crate::accessory_names::EXTRA;
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
    let of_meshes = groom.accessories.iter().map(|a| mesh_size(&a.surface)).sum::<u64>();
    let size: u64 = parts(groom).map(|(_, s)| size(s)).sum();
    if size == 0 {
        return Err("a groom without lines".into());
    }
    let size = size + of_meshes;
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

fn mesh_size(mesh: &Surface) -> u64 {
    24 * mesh.positions().len() as u64 + 12 * mesh.triangles().len() as u64
}

/// The lists of a document, as they grow.
#[derive(Default)]
struct Lists {
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    materials: Vec<Value>,
    bytes: u64,
}

impl Lists {
    /// Adds a view of so many bytes and an accessor for it; returns the index of the accessor.
    fn accessor(&mut self, size: usize, of_indices: bool, count: usize) -> usize {
        // 5126: f32, 5125: u32; 34962: of vertices, 34963: of indices.
        let (kind, target, shape) =
            if of_indices { (5125, 34963, "SCALAR") } else { (5126, 34962, "VEC3") };
        let view = self.views.len();
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.bytes, "byteLength": size, "target": target
        }));
        self.bytes += size as u64;
        self.accessors.push(json!({
            "bufferView": view, "componentType": kind, "count": count, "type": shape
        }));
        self.accessors.len() - 1
    }

    /// Adds an accessor for positions with their bounds.
    fn positions(&mut self, count: usize, (low, high): (Vec3, Vec3)) -> usize {
        let accessor = self.accessor(12 * count, false, count);
        self.accessors[accessor]["min"] = json!(low.to_array());
        self.accessors[accessor]["max"] = json!(high.to_array());
        accessor
    }

    /// Adds a mesh and a node for it.
    fn mesh(&mut self, name: &str, primitive: &Value) {
        self.nodes.push(json!({ "mesh": self.meshes.len(), "name": name }));
        self.meshes.push(json!({ "name": name, "primitives": [primitive] }));
    }

    fn lines(&mut self, name: &str, strands: &Strands, frame: Frame) {
        let points = strands.points().len();
        let first = self.positions(points, bounds(strands.points().iter().copied(), frame));
        self.accessor(12 * points, false, points);
        self.accessor(8 * lines(strands), true, 2 * lines(strands));
        self.mesh(
            name,
            &json!({
                "attributes": { "POSITION": first, "COLOR_0": first + 1 },
                "indices": first + 2, "mode": 1, "material": 0
            }),
        );
    }

    fn accessory(&mut self, accessory: &AccessoryMesh, frame: Frame) {
        let AccessoryMesh { name, material, surface } = accessory;
        let (points, faces) = (surface.positions().len(), surface.triangles().len());
        let first = self.positions(points, bounds(places(surface), frame));
        self.accessor(12 * points, false, points);
        self.accessor(12 * faces, true, 3 * faces);
        let found = self.materials.iter().position(|m| m["name"] == material.name);
        let made = found.unwrap_or_else(|| {
            let [r, g, b] = material.colour;
            self.materials.push(json!({ "name": material.name, "pbrMetallicRoughness": {
                "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0,
                // Roughness of glTF is the square root of α.
                "roughnessFactor": material.roughness.sqrt()
            }}));
            self.materials.len() - 1
        });
        self.mesh(
            &format!("accessories/{name}"),
            &json!({
                "attributes": { "POSITION": first, "NORMAL": first + 1 },
                "indices": first + 2, "material": made
            }),
        );
    }
}

fn places(surface: &Surface) -> impl Iterator<Item = Vec3> {
    surface.positions().iter().map(|p| p.as_vec3())
}

/// Writes what [`check`] has passed.
fn encode(out: &mut dyn Write, groom: &Groom, frame: Frame) -> io::Result<()> {
    let colour = groom.colour.map_or(BROWN, |c| c.colour);
    let mut lists = Lists {
        materials: vec![json!({ "name": "hair", "extensions": { "KHR_materials_unlit": {} } })],
        ..Lists::default()
    };
    parts(groom).for_each(|(name, strands)| lists.lines(name, strands, frame));
    let mut roots: Vec<usize> = (0..lists.nodes.len()).collect();
    groom.accessories.iter().for_each(|accessory| lists.accessory(accessory, frame));
    if !groom.accessories.is_empty() {
        let children: Vec<usize> = (roots.len()..lists.nodes.len()).collect();
        roots.push(lists.nodes.len());
        let extras = json!({ EXTRA: true });
        lists.nodes.push(json!({ "name": "accessories", "children": children, "extras": extras }));
    }
    let Lists { views, accessors, meshes, nodes, materials, bytes } = lists;
    let json = json!({
        "asset": { "version": "2.0", "generator": "frisure" },
        "extensionsUsed": ["KHR_materials_unlit"],
        "scene": 0,
        "scenes": [{ "nodes": roots }],
        "nodes": nodes,
        "meshes": meshes,
        "materials": materials,
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
        write_lines(out, strands, colour, frame)?;
    }
    groom.accessories.iter().try_for_each(|a| write_mesh(out, &a.surface, frame))
}

fn write_lines(
    out: &mut dyn Write,
    strands: &Strands,
    colour: [f32; 3],
    frame: Frame,
) -> io::Result<()> {
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
    Ok(())
}

fn write_mesh(out: &mut dyn Write, mesh: &Surface, frame: Frame) -> io::Result<()> {
    for p in places(mesh) {
        write_words(out, frame.position_to_file(p).to_array().map(f32::to_bits))?;
    }
    for n in mesh.vertex_normals() {
        write_words(out, frame.direction_to_file(n.as_vec3()).to_array().map(f32::to_bits))?;
    }
    mesh.triangles().iter().try_for_each(|face| write_words(out, *face))
}

/// Smallest and largest coordinates, as the file has them.
fn bounds(points: impl Iterator<Item = Vec3>, frame: Frame) -> (Vec3, Vec3) {
    let points = points.map(|p| frame.position_to_file(p));
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
