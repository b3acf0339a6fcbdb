//! A groom as a stage.

use std::collections::BTreeMap;

use frisure_strands::{AccessoryMesh, Attribute, AttributeValues, Domain, Strands, Surface};
use glam::Vec3;

use super::super::attributes::{CLUMP, COLOUR, DIRECTOR, GUIDE, in_file_axes, indices, of_strands};
use super::super::data::{Groom, HairColour};
use super::super::motion::{FRAMES_PER_SECOND, Samples, same_widths};
use super::look;
use super::names::{IS_GUIDE, OURS, PIGMENTS, PRIMVARS, REST_POSITION, SINGLES, TEXTURE};
use crate::accessory_names::PRIMVAR;
use frisure_files::frame::Frame;
use frisure_usd::{Data, Layer, Prim, Value};

/// The stage of a groom that the check has passed.
pub(super) fn layer(samples: &Samples<'_>, frame: Frame) -> Layer {
    let Samples { groom, hairs: all_hairs, guides: all_guides, interval } = samples;
    let mut root = Prim::new("Xform", "groom");
    root.metadata.push(("kind".into(), Value::token("component")));
    if !groom.name.is_empty() {
        root.metadata.push(("displayName".into(), Value::string(&groom.name.replace('\0', ""))));
    }
    let mut colours = Vec::new();
    let colour = colour(groom);
    if let Some(colour) = colour {
        colours.push(("hair", colour));
    }
    if !groom.hairs.is_empty() || groom.guides.is_empty() {
        let mut hairs = curves("hairs", all_hairs, *interval, frame);
        dress(&mut hairs, groom.colour.as_ref(), colour);
        root.children.push(hairs);
    }
    if !groom.guides.is_empty() {
        let mut guides = curves("guides", all_guides, *interval, frame);
        // Beside hairs they are not to be seen; alone they are all there is.
        if groom.hairs.is_empty() {
            dress(&mut guides, groom.colour.as_ref(), colour);
        } else {
            guides.uniform("token", "purpose", Value::token("guide"));
        }
        root.children.push(guides);
    }
    if let Some(head) = &groom.head {
        root.children.push(mesh("head", head, ("skin", look::SKIN), frame));
        colours.push(("skin", look::SKIN));
    }
    if !groom.accessories.is_empty() {
        root.children.push(accessories(&groom.accessories, frame));
        for AccessoryMesh { material, .. } in &groom.accessories {
            if colours.iter().all(|(name, _)| *name != material.name) {
                colours.push((material.name, material.colour));
            }
        }
    }
    if !colours.is_empty() {
        root.children.push(look::materials(&colours));
    }
    let mut metadata = metadata(frame);
    if all_hairs.len() > 1 {
        let end = time_code(all_hairs.len() - 1, *interval);
        let times = [
            ("startTimeCode", 0.0),
            ("endTimeCode", end),
            ("timeCodesPerSecond", FRAMES_PER_SECOND),
            ("framesPerSecond", FRAMES_PER_SECOND),
        ];
        metadata.extend(times.map(|(key, value)| (key.into(), Value::double(value))));
    }
    Layer { metadata, prims: vec![root] }
}

fn metadata(frame: Frame) -> Vec<(String, Value)> {
    let up = frame.up.name().to_uppercase();
    let all = [
        ("defaultPrim", Value::token("groom")),
        ("documentation", Value::string("A groom by frisure")),
        ("metersPerUnit", Value::double(frame.metres)),
        ("upAxis", Value::token(&up)),
    ];
    all.into_iter().map(|(key, value)| (key.into(), value)).collect()
}

/// The colour that all hair has in a preview: that of the groom, or the mean of those of the strands.
fn colour(groom: &Groom) -> Option<[f32; 3]> {
    let mean = || match &groom.strands().attribute(COLOUR)?.values {
        AttributeValues::F32x3(all) if !all.is_empty() => {
            let sum: glam::DVec3 = all.iter().map(|c| Vec3::from_array(*c).as_dvec3()).sum();
            Some((sum / all.len() as f64).as_vec3().to_array())
        }
        _ => None,
    };
    groom.colour.map(|c| c.colour).or_else(mean)
}

/// The time code of a sample.
fn time_code(sample: usize, interval: f64) -> f64 {
    sample as f64 * interval * FRAMES_PER_SECOND
}

/// Curves through the points of strands at each of their times.
fn curves(name: &str, samples: &[&Strands], interval: f64, frame: Frame) -> Prim {
    let strands = samples[0];
    let mut prim = Prim::new("BasisCurves", name);
    prim.uniform("token", "type", Value::token("cubic"));
    prim.uniform("token", "basis", Value::token("catmullRom"));
    prim.uniform("token", "wrap", Value::token("pinned"));
    let points = |strands: &Strands| -> Vec<Vec3> {
        strands.points().iter().map(|p| frame.position_to_file(*p)).collect()
    };
    let widths = |strands: &Strands| -> Vec<f32> {
        strands.radii().iter().map(|r| frame.length_to_file(2.0 * r)).collect()
    };
    let at_times = |value: &dyn Fn(&Strands) -> Value, samples: &[&Strands]| {
        let at =
            |(sample, strands): (usize, &&Strands)| (time_code(sample, interval), value(strands));
        samples.iter().enumerate().map(at).collect::<Vec<_>>()
    };
    let boxes = |strands: &Strands| {
        let thickest = widths(strands).into_iter().fold(0.0, f32::max);
        extent(&points(strands), 0.5 * thickest)
    };
    prim.over_time("float3[]", "extent", at_times(&boxes, samples));
    let counts = strands.offsets().windows(2).map(|o| signed(o[1] - o[0])).collect();
    prim.varying("int[]", "curveVertexCounts", Value::ints(counts));
    prim.over_time("point3f[]", "points", at_times(&|s| triples(&points(s)), samples));
    let of_widths = if same_widths(samples) { &samples[..1] } else { samples };
    let all = at_times(&|s| Value::floats(widths(s)), of_widths);
    let attribute = prim.over_time("float[]", "widths", all);
    attribute.metadata.push(("interpolation".into(), Value::token("vertex")));
    let is_guide = i32::from(name == "guides");
    prim.primvar("int", IS_GUIDE, Value::int(is_guide), "constant");
    for attribute in strands.attributes() {
        put(&mut prim, attribute, frame);
    }
    if is_guide == 0 {
        put_clumps(&mut prim, strands, frame);
    }
    prim
}

/// Writes the wisp of each hair, by which engines put hairs together: that of the guide that it follows most.
fn put_clumps(prim: &mut Prim, strands: &Strands, frame: Frame) {
    if let (Some(guide), None) = (indices(strands, GUIDE), strands.attribute(CLUMP)) {
        put(prim, &of_strands(CLUMP, AttributeValues::U32(guide.to_vec())), frame);
    }
}

/// Writes an attribute under each of its names.
fn put(prim: &mut Prim, attribute: &Attribute, frame: Frame) {
    let per = match attribute.domain {
        Domain::Strand => "uniform",
        Domain::Point => "vertex",
    };
    let (value, usual) = values(attribute, frame);
    let mut known = false;
    for (_, primvar, kind) in PRIMVARS.iter().filter(|(name, ..)| *name == attribute.name) {
        known = true;
        if *kind == "int3" {
            threes(prim, primvar, &value, per);
        } else {
            indexed(prim, &format!("{kind}[]"), primvar, value.clone(), per);
        }
    }
    if let Some((_, prefix)) = SINGLES.iter().find(|(name, _)| *name == attribute.name) {
        singles(prim, prefix, attribute, per);
    }
    let own = format!("{OURS}{}", identifier(&attribute.name));
    if !known && prim.attribute(&own).is_none() {
        indexed(prim, usual, &own, value, per);
    }
}

/// Writes real numbers, each value once with an index for each strand or point if that is at most half of them: the weights of many
/// hairs are the same.
fn indexed(prim: &mut Prim, kind: &str, primvar: &str, value: Value, per: &str) {
    let width = value.ty.width();
    if let Data::F32(all) = &value.data
        && all.len() > width
    {
        let (mut values, mut indices) = (Vec::new(), Vec::new());
        let mut places = BTreeMap::new();
        for row in all.chunks_exact(width) {
            let key: Vec<u32> = row.iter().map(|x| x.to_bits()).collect();
            let next = places.len();
            let place = *places.entry(key).or_insert_with(|| {
                values.extend_from_slice(row);
                next
            });
            indices.push(place as i32);
        }
        if 2 * places.len() <= indices.len() {
            let once = Value { data: Data::F32(values), ..value };
            prim.primvar(kind, primvar, once, per);
            prim.varying("int[]", &format!("{primvar}:indices"), Value::ints(indices));
            return;
        }
    }
    prim.primvar(kind, primvar, value, per);
}

/// A name that stages can have.
fn identifier(name: &str) -> String {
    let fit = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = name.chars().map(fit).collect();
    if name.starts_with(|c: char| c.is_ascii_digit()) { format!("_{name}") } else { name }
}

/// Writes three integers for each as three values: Blender reads no others.
fn threes(prim: &mut Prim, primvar: &str, value: &Value, per: &str) {
    let Data::I32(all) = &value.data else { return };
    prim.primvar("int[]", primvar, Value::ints(all.clone()), per);
    let attribute = prim.attributes.last_mut().expect("it was just added");
    attribute.metadata.push(("elementSize".into(), Value::int(3)));
}

/// Writes each of three values as a primvar of its own.
fn singles(prim: &mut Prim, prefix: &str, attribute: &Attribute, per: &str) {
    for k in 0..3 {
        let (kind, value) = match &attribute.values {
            AttributeValues::U32x3(v) => {
                ("int[]", Value::ints(v.iter().map(|three| signed(three[k])).collect()))
            }
            AttributeValues::F32x3(v) => {
                ("float[]", Value::floats(v.iter().map(|three| three[k]).collect()))
            }
            _ => return,
        };
        indexed(prim, kind, &format!("{prefix}{k}"), value, per);
    }
}

/// The values in the axes of the file, and the type of those without a role.
fn values(attribute: &Attribute, frame: Frame) -> (Value, &'static str) {
    match &in_file_axes(attribute, frame).values {
        AttributeValues::U32(v) => (Value::ints(v.iter().map(|&x| signed(x)).collect()), "int[]"),
        AttributeValues::U32x3(v) => {
            let v: Vec<_> = v.iter().map(|t| t.map(signed)).collect();
            (Value::int_tuples(&v), "int3[]")
        }
        AttributeValues::F32(v) => (Value::floats(v.clone()), "float[]"),
        AttributeValues::F32x2(v) => (Value::float_tuples(v), "float2[]"),
        AttributeValues::F32x3(v) if attribute.name == DIRECTOR => {
            (Value::float_tuples(v), "vector3f[]")
        }
        AttributeValues::F32x3(v) => (Value::float_tuples(v), "float3[]"),
    }
}

/// Integers of stages have a sign; those beyond come back as they were.
fn signed(x: u32) -> i32 {
    x.cast_signed()
}

/// Colour, pigments and material.
fn dress(prim: &mut Prim, shared: Option<&HairColour>, colour: Option<[f32; 3]>) {
    let Some(colour) = colour else { return };
    if prim.attribute("primvars:displayColor").is_none() {
        let value = Value::float_tuples(&[colour]);
        prim.primvar("color3f[]", "primvars:displayColor", value, "constant");
    }
    if let Some(melanin) = shared.and_then(|c| c.melanin) {
        let pigments = [melanin.eumelanin, melanin.pheomelanin];
        for (name, amount) in PIGMENTS.into_iter().zip(pigments) {
            prim.primvar("float", name, Value::float(amount), "constant");
        }
    }
    look::bind(prim, "hair");
}

/// What holds the hair: a mesh each, under one prim.
fn accessories(all: &[AccessoryMesh], frame: Frame) -> Prim {
    let mut group = Prim::new("Xform", "accessories");
    for AccessoryMesh { name, material, surface } in all {
        let mut prim = mesh(&identifier(name), surface, (material.name, material.colour), frame);
        prim.primvar("int", PRIMVAR, Value::int(1), "constant");
        group.children.push(prim);
    }
    group
}

/// A mesh with the material of a name and colour.
fn mesh(name: &str, surface: &Surface, (material, colour): (&str, [f32; 3]), frame: Frame) -> Prim {
    let mut prim = Prim::new("Mesh", name);
    prim.uniform("token", "subdivisionScheme", Value::token("none"));
    let points: Vec<Vec3> =
        surface.positions().iter().map(|p| frame.position_to_file(p.as_vec3())).collect();
    let normals: Vec<Vec3> =
        surface.vertex_normals().iter().map(|n| frame.direction_to_file(n.as_vec3())).collect();
    prim.varying("float3[]", "extent", extent(&points, 0.0));
    let corners = surface.triangles().as_flattened().iter().map(|&v| signed(v)).collect();
    let counts = vec![3; surface.triangles().len()];
    prim.varying("int[]", "faceVertexCounts", Value::ints(counts));
    prim.varying("int[]", "faceVertexIndices", Value::ints(corners));
    prim.varying("point3f[]", "points", triples(&points));
    // Blender's nodes that move hair with a surface ask for both, by these names.
    prim.primvar("float3[]", REST_POSITION, triples(&points), "vertex");
    texture(&mut prim, surface);
    prim.primvar("normal3f[]", "normals", triples(&normals), "vertex");
    let colour = Value::float_tuples(&[colour]);
    prim.primvar("color3f[]", "primvars:displayColor", colour, "constant");
    look::bind(&mut prim, material);
    prim
}

/// Writes the texture coordinates of faces' corners, each value once.
fn texture(prim: &mut Prim, surface: &Surface) {
    if surface.texture().is_empty() {
        return;
    }
    let (mut values, mut indices) = (Vec::new(), Vec::new());
    let mut places = BTreeMap::new();
    for uv in surface.texture().as_flattened() {
        let place = *places.entry(uv.map(f32::to_bits)).or_insert_with(|| {
            values.push(*uv);
            (values.len() - 1) as u32
        });
        indices.push(signed(place));
    }
    prim.primvar("texCoord2f[]", TEXTURE, Value::float_tuples(&values), "faceVarying");
    prim.varying("int[]", &format!("{TEXTURE}:indices"), Value::ints(indices));
}

fn triples(points: &[Vec3]) -> Value {
    let points: Vec<[f32; 3]> = points.iter().map(Vec3::to_array).collect();
    Value::float_tuples(&points)
}

/// The corners of the box around points, with so much room to all sides.
fn extent(points: &[Vec3], room: f32) -> Value {
    let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let (low, high) = points.iter().fold(nothing, |(l, h), p| (l.min(*p), h.max(*p)));
    if points.is_empty() {
        return Value::float_tuples(&[[0.0; 3]; 2]);
    }
    Value::float_tuples(&[(low - room).to_array(), (high + room).to_array()])
}
