//! Cards as a stage: a mesh for each level, of which the first is seen.

use frisure_cards::{CardMesh, Cards};
use frisure_files::frame::Frame;
use frisure_usd::{Layer, Prim, Value};
use glam::Vec3;

/// Path of the materials.
const MATERIALS: &str = "/cards/materials";

/// The stage; `named` gives the file of a texture of a level.
pub(super) fn layer(cards: &Cards, named: impl Fn(usize, &str) -> String) -> Layer {
    let frame = Frame::METRES_Z;
    let mut root = Prim::new("Xform", "cards");
    root.metadata.push(("kind".into(), Value::token("component")));
    for (level, of) in cards.levels.iter().enumerate() {
        root.children.push(mesh(&of.mesh, level, frame));
    }
    let mut folder = Prim::new("Scope", "materials");
    folder.children =
        (0..cards.levels.len()).map(|level| material(level, &named(level, "color"))).collect();
    root.children.push(folder);
    let metadata = [
        ("defaultPrim", Value::token("cards")),
        ("documentation", Value::string("Hair cards by frisure")),
        ("metersPerUnit", Value::double(frame.metres)),
        ("upAxis", Value::token("Z")),
    ];
    let metadata = metadata.into_iter().map(|(key, value)| (key.into(), value)).collect();
    Layer { metadata, prims: vec![root] }
}

fn mesh(mesh: &CardMesh, level: usize, frame: Frame) -> Prim {
    let mut prim = Prim::new("Mesh", &format!("hair_LOD{level}"));
    let triples =
        |all: Vec<Vec3>| Value::float_tuples(&all.iter().map(Vec3::to_array).collect::<Vec<_>>());
    let points: Vec<Vec3> = mesh.positions.iter().map(|p| frame.position_to_file(*p)).collect();
    let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = points.iter().fold(nothing, |(l, h), p| (l.min(*p), h.max(*p)));
    prim.uniform("token", "subdivisionScheme", Value::token("none"));
    prim.uniform("bool", "doubleSided", Value::bool(true));
    if level > 0 {
        prim.varying("token", "visibility", Value::token("invisible"));
    }
    prim.varying("float3[]", "extent", Value::float_tuples(&[low.to_array(), high.to_array()]));
    prim.varying("int[]", "faceVertexCounts", Value::ints(vec![3; mesh.triangles.len()]));
    let corners = mesh.triangles.as_flattened().iter().map(|v| v.cast_signed()).collect();
    prim.varying("int[]", "faceVertexIndices", Value::ints(corners));
    prim.varying("point3f[]", "points", triples(points));
    let normals = mesh.normals.iter().map(|n| frame.direction_to_file(*n)).collect();
    prim.primvar("normal3f[]", "primvars:normals", triples(normals), "vertex");
    let uvs: Vec<[f32; 2]> = mesh.uvs.iter().map(|[u, v]| [*u, 1.0 - v]).collect();
    prim.primvar("texCoord2f[]", "primvars:st", Value::float_tuples(&uvs), "vertex");
    prim.schemas.push("MaterialBindingAPI".into());
    prim.relate("material:binding", &format!("{MATERIALS}/hair_LOD{level}"));
    prim
}

/// A preview material with the colour and the covered part of a texture.
fn material(level: usize, file: &str) -> Prim {
    let name = format!("hair_LOD{level}");
    let path = format!("{MATERIALS}/{name}");
    let mut reader = Prim::new("Shader", "st");
    reader.uniform("token", "info:id", Value::token("UsdPrimvarReader_float2"));
    reader.varying("string", "inputs:varname", Value::string("st"));
    output(&mut reader, "float2", "outputs:result");
    let mut texture = Prim::new("Shader", "color");
    texture.uniform("token", "info:id", Value::token("UsdUVTexture"));
    texture.varying("asset", "inputs:file", Value::asset(&format!("./{file}")));
    texture.varying("token", "inputs:sourceColorSpace", Value::token("sRGB"));
    for side in ["inputs:wrapS", "inputs:wrapT"] {
        texture.varying("token", side, Value::token("clamp"));
    }
    connect(&mut texture, "float2", "inputs:st", format!("{path}/st.outputs:result"));
    output(&mut texture, "float3", "outputs:rgb");
    output(&mut texture, "float", "outputs:a");
    let mut preview = Prim::new("Shader", "preview");
    preview.uniform("token", "info:id", Value::token("UsdPreviewSurface"));
    connect(&mut preview, "color3f", "inputs:diffuseColor", format!("{path}/color.outputs:rgb"));
    connect(&mut preview, "float", "inputs:opacity", format!("{path}/color.outputs:a"));
    preview.varying("float", "inputs:roughness", Value::float(0.4));
    preview.output("outputs:surface");
    let mut material = Prim::new("Material", &name);
    material.output("outputs:surface").connections.push(format!("{path}/preview.outputs:surface"));
    material.children = vec![preview, texture, reader];
    material
}

fn connect(prim: &mut Prim, kind: &str, name: &str, source: String) {
    let input = prim.output(name);
    input.type_name = kind.into();
    input.connections.push(source);
}

fn output(prim: &mut Prim, kind: &str, name: &str) {
    prim.output(name).type_name = kind.into();
}
