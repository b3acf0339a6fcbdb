//! Cards in one binary glTF 2.0 file.
//!
//! The levels are meshes of their own. The scene has the first, with the others as its levels by `MSFT_lod`; a second scene has
//! all of them. The material is transparent, double-sided, and has the direction of hair as `KHR_materials_anisotropy`.

use frisure_cards::{CardMesh, Cards, Level, TEXTURES};
use frisure_files::frame::Frame;
use glam::Vec3;
use serde_json::{Value, json};

use super::error::CardsFileError;
use super::texture::texture;

/// Part of the screen's height that the hair fills where a level begins, for [`cards`](frisure_cards::cards) of 2.5 times fewer cards
/// in each. Chosen: half the size, half the texels.
fn coverage(level: usize) -> f64 {
    0.5_f64.powi(level as i32 + 1)
}

/// The bytes of the file.
pub(super) fn encode(cards: &Cards) -> Result<Vec<u8>, CardsFileError> {
    let mut file = File::default();
    for (level, of) in cards.levels.iter().enumerate() {
        file.add(level, of);
    }
    let levels = cards.levels.len();
    let mut nodes: Vec<Value> =
        (0..levels).map(|i| json!({ "name": format!("hair_LOD{i}"), "mesh": i })).collect();
    let mut used = vec!["KHR_materials_anisotropy"];
    if levels > 1 {
        used.push("MSFT_lod");
        let others: Vec<usize> = (1..levels).collect();
        nodes[0]["extensions"] = json!({ "MSFT_lod": { "ids": others } });
        let screen: Vec<f64> = (0..levels).map(coverage).collect();
        nodes[0]["extras"] = json!({ "MSFT_screencoverage": screen });
    }
    let all: Vec<usize> = (0..levels).collect();
    let document = json!({
        "asset": { "version": "2.0", "generator": "frisure" },
        "extensionsUsed": used,
        "scene": 0,
        "scenes": [{ "name": "hair", "nodes": [0] }, { "name": "all levels", "nodes": all }],
        "nodes": nodes,
        "meshes": file.meshes,
        "materials": file.materials,
        "textures": file.textures,
        "images": file.images,
        // Linear with mip maps; the places of cards end at their borders.
        "samplers": [{ "magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071 }],
        "accessors": file.accessors,
        "bufferViews": file.views,
        "buffers": [{ "byteLength": file.bytes.len() }],
    });
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let size = 12 + 8 + text.len() as u64 + 8 + file.bytes.len() as u64;
    if size > u64::from(u32::MAX) {
        return Err(CardsFileError::Size { size });
    }
    let mut out = Vec::with_capacity(size as usize);
    out.extend_from_slice(b"glTF");
    out.extend([2, size as u32, text.len() as u32].iter().flat_map(|n| n.to_le_bytes()));
    out.extend_from_slice(b"JSON");
    out.extend_from_slice(&text);
    out.extend((file.bytes.len() as u32).to_le_bytes());
    out.extend_from_slice(b"BIN\0");
    out.extend_from_slice(&file.bytes);
    Ok(out)
}

/// The parts of the file while it is made.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    images: Vec<Value>,
    textures: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
}

impl File {
    fn add(&mut self, level: usize, of: &Level) {
        let first = self.images.len();
        for (index, name) in TEXTURES.iter().enumerate() {
            let view = self.view(&texture(&of.atlas, index), None);
            let image = self.images.len();
            self.images.push(json!({
                "name": format!("lod{level}-{name}"), "bufferView": view, "mimeType": "image/png"
            }));
            self.textures.push(json!({ "source": image, "sampler": 0 }));
        }
        self.materials.push(json!({
            "name": format!("hair_LOD{level}"),
            "doubleSided": true,
            "alphaMode": "BLEND",
            "pbrMetallicRoughness": {
                "baseColorTexture": { "index": first }, "metallicFactor": 0.0, "roughnessFactor": 0.4
            },
            "extensions": { "KHR_materials_anisotropy": {
                "anisotropyStrength": 0.8, "anisotropyTexture": { "index": first + 1 }
            }},
            // No property of glTF's materials is a depth, a number or a way along hair.
            "extras": { "frisure_data": { "index": first + 2 } },
        }));
        let mesh = self.mesh(&of.mesh, level);
        self.meshes.push(json!({ "name": format!("hair_LOD{level}"), "primitives": [mesh] }));
    }

    fn mesh(&mut self, mesh: &CardMesh, level: usize) -> Value {
        let frame = Frame::METRES_Y;
        let positions: Vec<Vec3> =
            mesh.positions.iter().map(|p| frame.position_to_file(*p)).collect();
        let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let (low, high) = positions.iter().fold(nothing, |(l, h), p| (l.min(*p), h.max(*p)));
        let normals = mesh.normals.iter().map(|n| frame.direction_to_file(*n).to_array());
        let tangents = mesh.tangents.iter().map(|t| {
            let [x, y, z] = frame.direction_to_file(*t).to_array();
            // The third axis, normal times tangent, is towards the root, in which the texture goes up.
            [x, y, z, 1.0]
        });
        let places: Vec<[f32; 3]> = positions.iter().map(Vec3::to_array).collect();
        let position = self.accessor(&places, "VEC3");
        self.accessors[position]["min"] = json!(low.to_array());
        self.accessors[position]["max"] = json!(high.to_array());
        let normal = self.accessor(&normals.collect::<Vec<_>>(), "VEC3");
        let tangent = self.accessor(&tangents.collect::<Vec<_>>(), "VEC4");
        let uv = self.accessor(&mesh.uvs, "VEC2");
        let corners = mesh.triangles.as_flattened();
        let bytes: Vec<u8> = corners.iter().flat_map(|v| v.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(34963));
        let indices = self.accessors.len();
        // 5125: u32.
        self.accessors.push(json!({
            "bufferView": view, "componentType": 5125, "count": corners.len(), "type": "SCALAR"
        }));
        json!({
            "attributes": {
                "POSITION": position, "NORMAL": normal, "TANGENT": tangent, "TEXCOORD_0": uv
            },
            "indices": indices, "material": level, "mode": 4,
        })
    }

    /// Numbers of vertices; returns the number of the accessor.
    fn accessor<const N: usize>(&mut self, values: &[[f32; N]], shape: &str) -> usize {
        let bytes: Vec<u8> = values.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(34962));
        // 5126: f32.
        self.accessors.push(json!({
            "bufferView": view, "componentType": 5126, "count": values.len(), "type": shape
        }));
        self.accessors.len() - 1
    }

    /// Bytes; returns the number of their view.
    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(view);
        self.views.len() - 1
    }
}
