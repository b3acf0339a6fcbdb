//! glTF 2.0, as JSON with its buffers beside it or in it, and as one binary file (GLB).
//!
//! Read here and not by the crate `gltf`, which checks no accessor against its buffer, and refuses files whose
//! positions state no bounds; `docs/dependencies.md` has the comparison. Source: Khronos, "glTF 2.0 Specification".

use base64::engine::{DecodePaddingMode, GeneralPurpose, GeneralPurposeConfig};
use base64::{Engine, alphabet};
use glam::{DMat4, DQuat, DVec3};
use percent_encoding::percent_decode_str;
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value;
use std::collections::BTreeMap;

use super::format::{Beside, MeshFormat};
use super::mesh::{Mesh, vertex_index};
use super::source::MAX_SIZE;
use crate::accessory_names::EXTRA;
use frisure_files::frame::Frame;

/// The declaration of the format.
pub(super) static FORMAT: MeshFormat = MeshFormat {
    extensions: &["glb", "gltf"],
    expected: "a glTF mesh",
    begins: |bytes| bytes.starts_with(b"glTF") || bytes.trim_ascii_start().starts_with(b"{"),
    is_text: false,
    read: |bytes, beside| Ok(parse(bytes, beside)?),
};

/// Nodes within nodes, at most.
const MAX_DEPTH: usize = 200;

/// Vertices, and corners of faces, that nodes place in all, at most: many can show one mesh.
const MOST: usize = 10_000_000;

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Document {
    scene: Option<usize>,
    scenes: Vec<Scene>,
    nodes: Vec<Node>,
    meshes: Vec<Named>,
    materials: Vec<Material>,
    accessors: Vec<Accessor>,
    buffer_views: Vec<View>,
    buffers: Vec<Buffer>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Scene {
    nodes: Vec<usize>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Node {
    name: String,
    children: Vec<usize>,
    mesh: Option<usize>,
    matrix: Option<[f64; 16]>,
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
    scale: Option<[f64; 3]>,
    extras: Value,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Named {
    name: String,
    primitives: Vec<Primitive>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Material {
    name: String,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Primitive {
    attributes: BTreeMap<String, usize>,
    indices: Option<usize>,
    material: Option<usize>,
    mode: Option<u32>,
    extensions: BTreeMap<String, IgnoredAny>,
}

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Accessor {
    buffer_view: Option<usize>,
    byte_offset: usize,
    component_type: u32,
    normalized: bool,
    count: usize,
    #[serde(rename = "type")]
    shape: String,
    sparse: Option<Sparse>,
}

/// Values that take the place of some of an accessor's.
#[derive(Default, Deserialize)]
#[serde(default)]
struct Sparse {
    count: usize,
    indices: Span,
    values: Span,
}

/// The start of numbers.
#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct Span {
    buffer_view: usize,
    byte_offset: usize,
    component_type: u32,
}

#[derive(Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
struct View {
    buffer: usize,
    byte_offset: usize,
    byte_length: usize,
    byte_stride: Option<usize>,
}

#[derive(Default, Deserialize)]
#[serde(default)]
struct Buffer {
    uri: Option<String>,
}

/// Reads a file; `beside` gives the bytes of another by the name that it has in this one.
fn parse(bytes: &[u8], beside: &dyn Fn(&str) -> Result<Vec<u8>, String>) -> Result<Mesh, String> {
    let (json, binary) = if bytes.starts_with(b"glTF") { chunks(bytes)? } else { (bytes, None) };
    let document: Document = serde_json::from_slice(json).map_err(|e| e.to_string())?;
    let mut buffers = Vec::new();
    for (i, buffer) in document.buffers.iter().enumerate() {
        buffers.push(match (&buffer.uri, binary) {
            (Some(uri), _) => contents(uri, beside).map_err(|e| format!("buffer {i}: {e}"))?,
            (None, Some(binary)) if i == 0 => binary.to_vec(),
            (None, _) => return Err(format!("buffer {i} has no bytes")),
        });
        if buffers.iter().map(Vec::len).sum::<usize>() as u64 > MAX_SIZE {
            return Err(format!("its buffers have more than {MAX_SIZE} bytes"));
        }
    }
    let frame = Some(Frame::METRES_Y);
    let mesh = Mesh { frame, states_unit: true, ..Mesh::default() };
    let seen = vec![false; document.nodes.len()];
    let mut reader = Reader { document: &document, buffers, seen, mesh };
    for &root in &reader.roots() {
        reader.node(root, DMat4::IDENTITY, 0)?;
    }
    let mut mesh = reader.mesh;
    if mesh.positions.is_empty() {
        return Err("its scene has no meshes of triangles".into());
    }
    mesh.join();
    Ok(mesh)
}

/// The JSON and the bytes of a binary file.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let word = |at: usize| {
        let b = bytes.get(at..at + 4)?;
        Some(u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize)
    };
    if word(4) != Some(2) {
        return Err("it is binary glTF of another version than 2".into());
    }
    let mut found = [None, None];
    let mut at = 12;
    while let (Some(length), Some(kind)) = (word(at), word(at + 4)) {
        let chunk = bytes.get(at + 8..at + 8 + length).ok_or("it is cut short")?;
        match kind {
            0x4E4F_534A => found[0] = Some(chunk),
            0x004E_4942 => found[1] = Some(chunk),
            _ => {}
        }
        at += 8 + length;
    }
    Ok((found[0].ok_or("it has no JSON")?, found[1]))
}

/// The bytes that an address names.
fn contents(uri: &str, beside: Beside<'_>) -> Result<Vec<u8>, String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let (_, data) = data.split_once("base64,").ok_or("its data are not base64")?;
        return BASE64.decode(data).map_err(|e| format!("its data are not base64: {e}"));
    }
    beside(&percent_decode_str(uri).decode_utf8_lossy())
}

/// With or without padding: exporters differ.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &alphabet::STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_padding_mode(DecodePaddingMode::Indifferent)
        .with_decode_allow_trailing_bits(true),
);

/// The extension that packs a primitive's numbers into bytes of its own.
const DRACO: &str = "KHR_draco_mesh_compression";

struct Reader<'a> {
    document: &'a Document,
    buffers: Vec<Vec<u8>>,
    seen: Vec<bool>,
    mesh: Mesh,
}

/// Numbers of an accessor.
struct Numbers {
    all: Vec<f64>,
    width: usize,
}

impl Reader<'_> {
    /// The nodes of the scene, or of a file without scenes those that are in no other.
    fn roots(&self) -> Vec<usize> {
        let document = self.document;
        if let Some(scene) = document.scenes.get(document.scene.unwrap_or(0)) {
            return scene.nodes.clone();
        }
        let mut is_root = vec![true; document.nodes.len()];
        for child in document.nodes.iter().flat_map(|n| &n.children) {
            if let Some(root) = is_root.get_mut(*child) {
                *root = false;
            }
        }
        (0..is_root.len()).filter(|&i| is_root[i]).collect()
    }

    fn node(&mut self, index: usize, above: DMat4, depth: usize) -> Result<(), String> {
        let node =
            self.document.nodes.get(index).ok_or_else(|| format!("there is no node {index}"))?;
        if depth > MAX_DEPTH || std::mem::replace(&mut self.seen[index], true) {
            return Err(format!("node {index} is in several places, or too deep"));
        }
        if node.extras.get(EXTRA).is_some() {
            return Ok(());
        }
        let world = above * place(node);
        if let Some(mesh) = node.mesh {
            let found = self.document.meshes.get(mesh);
            let found = found.ok_or_else(|| format!("there is no mesh {mesh}"))?;
            for (i, primitive) in found.primitives.iter().enumerate() {
                let first = self.mesh.triangles.len();
                self.primitive(primitive, &world)
                    .map_err(|e| format!("mesh {mesh}, part {i}: {e}"))?;
                self.mesh.group(&node.name, first);
                if found.name != node.name {
                    self.mesh.group(&found.name, first);
                }
            }
        }
        node.children.iter().try_for_each(|child| self.node(*child, world, depth + 1))
    }

    fn primitive(&mut self, primitive: &Primitive, world: &DMat4) -> Result<(), String> {
        // Triangles, strips and fans.
        let mode = primitive.mode.unwrap_or(4);
        let Some(&positions) = primitive.attributes.get("POSITION") else { return Ok(()) };
        if !(4..=6).contains(&mode) {
            return Ok(());
        }
        // A file can hold the same numbers uncompressed besides.
        let has_bytes = |a: &Accessor| a.buffer_view.is_some() || a.sparse.is_some();
        if primitive.extensions.contains_key(DRACO)
            && !self.document.accessors.get(positions).is_some_and(has_bytes)
        {
            return Err(format!(
                "it is compressed with Draco ({DRACO}), which is not read: export it without compression"
            ));
        }
        let positions = self.numbers(positions)?;
        let (first, points) = (self.mesh.positions.len(), positions.all.len() / 3);
        if positions.width != 3 || first + points > MOST {
            return Err(format!("{points} vertices of {} coordinates", positions.width));
        }
        let moved = |p: &[f64; 3]| world.transform_point3(DVec3::from_array(*p)).to_array();
        self.mesh.positions.extend(positions.all.as_chunks().0.iter().map(moved));
        let corners = match primitive.indices {
            Some(indices) => self.numbers(indices)?.all,
            None => (0..points).map(|i| i as f64).collect(),
        };
        if 3 * self.mesh.triangles.len() + corners.len() > MOST {
            return Err(format!("it has more than {MOST} corners"));
        }
        let mirrored = world.determinant() < 0.0;
        let first_triangle = self.mesh.triangles.len();
        for [a, b, c] in fans(mode, &corners) {
            let corner = |v: f64| {
                let found = vertex_index(v, points).map(|v| first as u32 + v);
                found.ok_or_else(|| format!("a face names vertex {v}, and there are {points}"))
            };
            let (b, c) = if mirrored { (c, b) } else { (b, c) };
            self.mesh.triangles.push([corner(a)?, corner(b)?, corner(c)?]);
        }
        self.textures(primitive, first, points, first_triangle)?;
        self.channels(primitive, first, points)?;
        let material = primitive.material.and_then(|m| self.document.materials.get(m));
        if let Some(material) = material {
            self.mesh.group(&material.name, first_triangle);
        }
        Ok(())
    }

    /// Colours and numbers of our own at the newest vertices.
    fn channels(
        &mut self,
        primitive: &Primitive,
        first: usize,
        points: usize,
    ) -> Result<(), String> {
        for (name, &accessor) in &primitive.attributes {
            let is_ours = name.starts_with('_') || name.starts_with("COLOR_");
            if !is_ours {
                continue;
            }
            let values = self.numbers(accessor)?;
            if values.all.len() != points * values.width {
                return Err(format!("{name} has not one value for each vertex"));
            }
            if name == "COLOR_0" {
                self.mesh.colours(first, &values.all, values.width);
            } else {
                self.mesh.values(name, first, &values.all, values.width);
            }
        }
        Ok(())
    }

    /// The texture coordinates of the newest triangles; v grows downwards there.
    fn textures(
        &mut self,
        primitive: &Primitive,
        first: usize,
        points: usize,
        first_triangle: usize,
    ) -> Result<(), String> {
        let Some(&accessor) = primitive.attributes.get("TEXCOORD_0") else {
            self.mesh.triangle_uvs.resize(self.mesh.triangles.len(), None);
            return Ok(());
        };
        let values = self.numbers(accessor)?;
        if values.width != 2 || values.all.len() != 2 * points {
            return Err("TEXCOORD_0 has not one value for each vertex".into());
        }
        // One for each vertex, wherever a part before had none.
        self.mesh.uvs.resize(first, [0.0; 2]);
        self.mesh.uvs.extend(values.all.as_chunks().0.iter().map(|[u, v]| [*u, 1.0 - *v]));
        let newest = &self.mesh.triangles[first_triangle..];
        self.mesh.triangle_uvs.extend(newest.iter().map(|t| Some(*t)));
        Ok(())
    }

    fn numbers(&self, index: usize) -> Result<Numbers, String> {
        let accessor = self.document.accessors.get(index);
        let accessor = accessor.ok_or_else(|| format!("there is no accessor {index}"))?;
        self.of_accessor(accessor).map_err(|e| format!("accessor {index}: {e}"))
    }

    fn of_accessor(&self, accessor: &Accessor) -> Result<Numbers, String> {
        let width = match accessor.shape.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            other => return Err(format!("its type is `{other}`")),
        };
        let kind = accessor.component_type;
        let at = |view, offset| (view, offset, kind);
        let mut all = match (accessor.buffer_view, &accessor.sparse) {
            (Some(view), _) => self.span(at(view, accessor.byte_offset), width, accessor.count)?,
            // Zeros, but for the values that follow.
            (None, Some(_)) if accessor.count <= MOST => vec![0.0; accessor.count * width],
            (None, Some(_)) => return Err(format!("it has more than {MOST} values")),
            (None, None) => return Err("it has no bytes".into()),
        };
        if let Some(Sparse { count, indices, values }) = &accessor.sparse {
            let Span { buffer_view, byte_offset, component_type } = *indices;
            let rows = self.span((buffer_view, byte_offset, component_type), 1, *count)?;
            let values = self.span(at(values.buffer_view, values.byte_offset), width, *count)?;
            for (&row, value) in rows.iter().zip(values.chunks_exact(width)) {
                let row = vertex_index(row, accessor.count);
                let row = row.ok_or("a sparse value is beyond its end")? as usize;
                all[row * width..][..width].copy_from_slice(value);
            }
        }
        let scale = if accessor.normalized { size_and_full(kind)?.1 } else { 1.0 };
        all.iter_mut().for_each(|x| *x /= scale);
        Ok(Numbers { all, width })
    }

    /// `count` values of `width` numbers from an offset of a buffer view, of a type of components.
    fn span(
        &self,
        (view, offset, kind): (usize, usize, u32),
        width: usize,
        count: usize,
    ) -> Result<Vec<f64>, String> {
        let (size, _) = size_and_full(kind)?;
        let view = self.document.buffer_views.get(view).ok_or("it has no bytes")?;
        let buffer = self.buffers.get(view.buffer).ok_or("it has no buffer")?;
        let end = view.byte_offset.checked_add(view.byte_length);
        let bytes = end
            .and_then(|end| buffer.get(view.byte_offset..end))
            .and_then(|bytes| bytes.get(offset..))
            .ok_or("its buffer is too short")?;
        let one = size * width;
        let stride = view.byte_stride.unwrap_or(one);
        let last = count.checked_sub(1).and_then(|n| n.checked_mul(stride));
        let fits =
            last.and_then(|last| last.checked_add(one)).is_some_and(|end| end <= bytes.len());
        if stride < one || !fits && count > 0 {
            return Err(format!("its buffer is too short for {count} values"));
        }
        let mut all = Vec::with_capacity(count * width);
        for value in 0..count {
            for c in 0..width {
                let at = value * stride + c * size;
                let number = component(kind, &bytes[at..at + size]);
                if !number.is_finite() {
                    return Err(format!("value {value} is {number}"));
                }
                all.push(number);
            }
        }
        Ok(all)
    }
}

/// The bytes of a component, and the number that normalized ones have for 1.
fn size_and_full(kind: u32) -> Result<(usize, f64), String> {
    Ok(match kind {
        5120 => (1, 127.0),
        5121 => (1, 255.0),
        5122 => (2, 32767.0),
        5123 => (2, 65535.0),
        5125 | 5126 => (4, 1.0),
        other => return Err(format!("its components are of type {other}")),
    })
}

fn component(kind: u32, b: &[u8]) -> f64 {
    match kind {
        5120 => f64::from(b[0].cast_signed()),
        5121 => f64::from(b[0]),
        5122 => f64::from(i16::from_le_bytes([b[0], b[1]])),
        5123 => f64::from(u16::from_le_bytes([b[0], b[1]])),
        5125 => f64::from(u32::from_le_bytes([b[0], b[1], b[2], b[3]])),
        _ => f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]])),
    }
}

/// Triangles of a list (4), a strip (5) or a fan (6).
fn fans(mode: u32, corners: &[f64]) -> Vec<[f64; 3]> {
    match mode {
        4 => corners.as_chunks().0.to_vec(),
        5 => {
            let turn = |(i, c): (usize, &[f64])| {
                if i % 2 == 0 { [c[0], c[1], c[2]] } else { [c[1], c[0], c[2]] }
            };
            corners.windows(3).enumerate().map(turn).collect()
        }
        _ => {
            let rest = corners.get(1..).unwrap_or_default();
            rest.windows(2).map(|pair| [corners[0], pair[0], pair[1]]).collect()
        }
    }
}

fn place(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(matrix);
    }
    let rotation = node.rotation.map_or(DQuat::IDENTITY, DQuat::from_array);
    let rotation = if rotation.length() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY };
    DMat4::from_scale_rotation_translation(
        node.scale.map_or(DVec3::ONE, DVec3::from_array),
        rotation,
        node.translation.map_or(DVec3::ZERO, DVec3::from_array),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles with a seam, coloured, in a node that is moved and mirrored.
    fn binary() -> Vec<u8> {
        changed("", "", [0, 1, 2, 0, 2, 3])
    }

    /// The same with a part of the JSON replaced, and with these corners.
    fn changed(from: &str, to: &str, corners: [u16; 6]) -> Vec<u8> {
        let mut bin = Vec::new();
        for x in [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0_f32] {
            bin.extend(x.to_le_bytes());
        }
        bin.extend([255, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 255, 255, 255]);
        for i in corners {
            bin.extend(i.to_le_bytes());
        }
        let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
            "nodes":[{"name":"head","mesh":0,"translation":[0,0,2],"scale":[-1,1,1]}],
            "meshes":[{"name":"skin","primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"indices":2,"material":0}]}],
            "materials":[{"name":"scalp"}],
            "accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},
                {"bufferView":1,"componentType":5121,"normalized":true,"count":4,"type":"VEC4"},
                {"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],
            "bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":16},
                {"buffer":0,"byteOffset":64,"byteLength":12}],
            "buffers":[{"byteLength":76}]}"#;
        let mut json = json.replacen(from, to, 1).into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let mut bytes = b"glTF".to_vec();
        bytes.extend(2_u32.to_le_bytes());
        bytes.extend(0_u32.to_le_bytes());
        for (kind, chunk) in [(0x4E4F_534A_u32, &json), (0x004E_4942, &bin)] {
            bytes.extend(u32::try_from(chunk.len()).unwrap().to_le_bytes());
            bytes.extend(kind.to_le_bytes());
            bytes.extend(chunk);
        }
        bytes
    }

    fn none(_: &str) -> Result<Vec<u8>, String> {
        Err("there is no file".into())
    }

    #[test]
    fn a_binary_file_is_read() {
        let mesh = parse(&binary(), &none).unwrap();
        assert_eq!(mesh.positions, [[0.0, 0.0, 2.0], [-1.0, 0.0, 2.0], [0.0, 1.0, 2.0]]);
        // Mirrored, and the seam closed.
        assert_eq!(mesh.triangles, [[0, 2, 1], [0, 1, 2]]);
        assert_eq!(mesh.channels["red"], [1.0, 0.5, 0.0]);
        let names: Vec<_> = mesh.groups.keys().map(String::as_str).collect();
        assert_eq!(names, ["head", "scalp", "skin"]);
    }

    #[test]
    fn cut_anywhere_and_wrong_anywhere() {
        let mut bytes = binary();
        for n in 0..bytes.len() {
            assert!(parse(&bytes[..n], &none).is_err(), "{n}");
        }
        for i in 0..bytes.len() {
            let good = bytes[i];
            for bad in [0xff, b'9', good ^ 1] {
                bytes[i] = bad;
                let _ = parse(&bytes, &none);
            }
            bytes[i] = good;
        }
    }

    #[test]
    fn what_is_out_of_range_is_named() {
        let usual = [0, 1, 2, 0, 2, 3];
        let faults = [
            ("", "", [0, 1, 2, 0, 2, 4], "mesh 0, part 0: a face names vertex 4, and there are 4"),
            (r#""indices":2"#, r#""indices":9"#, usual, "there is no accessor 9"),
            (r#""bufferView":2"#, r#""bufferView":9"#, usual, "accessor 2: it has no bytes"),
            (
                r#""count":6"#,
                r#""count":7"#,
                usual,
                "accessor 2: its buffer is too short for 7 values",
            ),
            (r#""byteOffset":64"#, r#""byteOffset":65"#, usual, "its buffer is too short"),
            (r#"{"buffer":0"#, r#"{"buffer":1"#, usual, "accessor 0: it has no buffer"),
            (r#""count":6"#, r#""count":18446744073709551615"#, usual, "too short"),
            (r#""mesh":0"#, r#""mesh":3"#, usual, "there is no mesh 3"),
            (r#""nodes":[0]"#, r#""nodes":[5]"#, usual, "there is no node 5"),
        ];
        for (from, to, corners, part) in faults {
            let error = parse(&changed(from, to, corners), &none).unwrap_err();
            assert!(error.contains(part), "{to}: {error}");
        }
    }

    #[test]
    fn nodes_in_circles_have_an_end() {
        let circle = r#"{"nodes":[{"children":[1]},{"children":[0]}],"scenes":[{"nodes":[0]}]}"#;
        assert!(parse(circle.as_bytes(), &none).unwrap_err().contains("several places"));
        assert!(parse("[".repeat(100_000).as_bytes(), &none).is_err());
    }

    #[test]
    fn buffers_beside_and_within() {
        for whole in ["data:;base64,aGFpcg==", "data:;base64,aGFpcg"] {
            assert_eq!(contents(whole, &none).unwrap(), b"hair");
        }
        assert!(contents("data:;base64,a-", &none).is_err());
        let asked = |name: &str| Err(format!("asked for {name}"));
        let json = r#"{"buffers":[{"uri":"my%20head.bin","byteLength":4}]}"#;
        assert_eq!(parse(json.as_bytes(), &asked).unwrap_err(), "buffer 0: asked for my head.bin");
    }

    /// A triangle whose third vertex is moved by a sparse accessor; the rest are zeros or in a view.
    fn sparse(base: &str, row: u8) -> Result<Mesh, String> {
        let mut bin = Vec::new();
        for x in [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0_f32, 0.0, 2.0, 0.0] {
            bin.extend(x.to_le_bytes());
        }
        bin.push(row);
        let json = r#"{"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "accessors":[{BASE"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
                "indices":{"bufferView":2,"componentType":5121},"values":{"bufferView":1}}}],
            "bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12},
                {"buffer":0,"byteOffset":48,"byteLength":1}],
            "buffers":[{"uri":"a.bin"}]}"#;
        parse(json.replace("BASE", base).as_bytes(), &|_| Ok(bin.clone()))
    }

    #[test]
    fn sparse_values_take_the_place_of_others() {
        let mesh = sparse(r#""bufferView":0,"#, 2).unwrap();
        assert_eq!(mesh.positions, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
        assert_eq!(sparse("", 2).unwrap().positions, [[0.0; 3], [0.0, 2.0, 0.0]]);
        assert!(sparse("", 3).unwrap_err().contains("a sparse value is beyond its end"));
    }

    #[test]
    fn draco_is_named() {
        let json = r#"{"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"accessors":[{"componentType":5126,"count":3,"type":"VEC3"}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":{"bufferView":0}}}]}]}"#;
        let error = parse(json.as_bytes(), &none).unwrap_err();
        assert!(error.contains("compressed with Draco (KHR_draco_mesh_compression)"), "{error}");
    }
}
