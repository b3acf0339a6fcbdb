//! Preview materials.

use frisure_usd::{Prim, Value};

/// Path of the materials.
const FOLDER: &str = "/groom/materials";

/// Diffuse reflectance of a head (linear): the matte plastic of a training head, as pictures have it.
pub(super) const SKIN: [f32; 3] = [0.40, 0.29, 0.235];

/// Roughness of the preview's highlight on hair and on skin: a preview has no fibres.
const ROUGHNESS: [(&str, f32); 2] = [("hair", 0.4), ("skin", 0.6)];

/// Materials by name and colour.
pub(super) fn materials(colours: &[(&str, [f32; 3])]) -> Prim {
    let mut folder = Prim::new("Scope", "materials");
    folder.children = colours.iter().map(|(name, colour)| material(name, *colour)).collect();
    folder
}

fn material(name: &str, colour: [f32; 3]) -> Prim {
    let roughness = ROUGHNESS.iter().find(|(n, _)| *n == name).map_or(0.5, |(_, r)| *r);
    let mut shader = Prim::new("Shader", "preview");
    shader.uniform("token", "info:id", Value::token("UsdPreviewSurface"));
    shader.varying("color3f", "inputs:diffuseColor", Value::float3(colour));
    shader.varying("float", "inputs:roughness", Value::float(roughness));
    shader.output("outputs:surface");
    let mut material = Prim::new("Material", name);
    let surface = format!("{FOLDER}/{name}/preview.outputs:surface");
    material.output("outputs:surface").connections.push(surface);
    material.children.push(shader);
    material
}

/// Gives a prim the material of a name.
pub(super) fn bind(prim: &mut Prim, name: &str) {
    prim.schemas.push("MaterialBindingAPI".into());
    prim.relate("material:binding", &format!("{FOLDER}/{name}"));
}
