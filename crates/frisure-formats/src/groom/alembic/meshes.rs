//! What holds the hair as polygon meshes.

use frisure_files::frame::Frame;
use frisure_ogawa::write::{Object, Pod, Property, Sample};
use frisure_strands::{AccessoryMesh, Surface};
use glam::Vec3;

use super::names::{MESH, XFORM};
use super::objects::{schema_of_object, still};

/// The objects of accessories: a transform with one for each; none without accessories.
pub(super) fn accessories(all: &[AccessoryMesh], frame: Frame) -> Option<Object<'_>> {
    let children = all.iter().map(|a| transform(&a.name, vec![mesh(a, frame)]));
    (!all.is_empty()).then(|| transform("accessories", children.collect()))
}

/// A transform that moves nothing.
fn transform<'a>(name: &str, children: Vec<Object<'a>>) -> Object<'a> {
    Object {
        name: name.into(),
        metadata: schema_of_object(XFORM, "", ".xform"),
        properties: vec![still(Vec::new())],
        children,
    }
}

fn mesh(AccessoryMesh { name, surface, .. }: &AccessoryMesh, frame: Frame) -> Object<'_> {
    let base = "schemaBaseType=AbcGeom_GeomBase_v1";
    let place = move |p: &glam::DVec3| frame.position_to_file(p.as_vec3());
    let points = Sample::of(Pod::F32, 3, surface.positions().len(), move |out| {
        let all = surface.positions().iter().flat_map(|p| place(p).to_array());
        all.for_each(|x| out.extend(x.to_le_bytes()));
    });
    let faces = surface.triangles();
    let indices = Sample::of(Pod::I32, 1, 3 * faces.len(), move |out| {
        // Alembic goes round the corners of a face clockwise.
        let corners = faces.iter().flat_map(|&[a, b, c]| [c, b, a]);
        corners.for_each(|v| out.extend(v.cast_signed().to_le_bytes()));
    });
    let counts = Sample::of(Pod::I32, 1, faces.len(), move |out| {
        faces.iter().for_each(|_| out.extend(3_i32.to_le_bytes()));
    });
    let geometry = vec![
        bounds(surface, place),
        Property::arrays("P", "geoScope=vtx;interpretation=point", vec![points]),
        Property::array(".faceIndices", "", indices),
        Property::array(".faceCounts", "", counts),
    ];
    Object {
        name: format!("{name}Shape"),
        metadata: schema_of_object(MESH, base, ".geom"),
        properties: vec![Property::compound(".geom", &format!("schema={MESH};{base}"), geometry)],
        children: Vec::new(),
    }
}

/// The box around a mesh.
fn bounds(surface: &Surface, place: impl Fn(&glam::DVec3) -> Vec3) -> Property<'static> {
    let nothing = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let points = surface.positions().iter().map(place);
    let (low, high) = points.fold(nothing, |(l, h), p| (l.min(p), h.max(p)));
    let corners = [low, high].map(|p| p.as_dvec3().to_array());
    let value = Sample::of(Pod::F64, 6, 1, move |out| {
        corners.as_flattened().iter().for_each(|x| out.extend(x.to_le_bytes()));
    });
    Property::scalar(".selfBnds", "interpretation=box", value)
}
