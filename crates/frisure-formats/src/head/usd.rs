//! Heads in stages of Universal Scene Description: all their meshes but those that hold hair, in their places.

use super::format::MeshFormat;
use super::mesh::Mesh;
use crate::accessory_names::PRIMVAR;
use crate::stage_frame::stage_frame;
use frisure_files::frame::FrameChoice;
use frisure_usd::{self as usd, Prim, Stage, StagePrim, Value};

/// The declaration of the format.
pub(super) static FORMAT: MeshFormat = MeshFormat {
    extensions: &["usd", "usda", "usdc", "usdz"],
    expected: "a USD stage with meshes",
    begins: usd::is_usd,
    is_text: false,
    read: |bytes, _| Ok(parse(bytes)?),
};

/// The meshes of a stage as one.
fn parse(bytes: &[u8]) -> Result<Mesh, String> {
    let layer = usd::read(bytes)?;
    let stage = Stage::of(&layer)?;
    let mut mesh =
        Mesh { frame: Some(stage_frame(&stage, FrameChoice::default())), ..Mesh::default() };
    mesh.states_unit = layer.meta("metersPerUnit").is_some();
    let is_head = |p: &&StagePrim| {
        p.prim.type_name == "Mesh" && !p.is_guide && p.prim.attribute(PRIMVAR).is_none()
    };
    let meshes = stage.prims.iter().filter(is_head);
    for place in meshes {
        add(&mut mesh, place).map_err(|e| stage.fault(place, &e))?;
    }
    if mesh.positions.is_empty() {
        return Err(format!("it has no meshes{}", stage.hint()));
    }
    mesh.join();
    Ok(mesh)
}

fn add(mesh: &mut Mesh, place: &StagePrim) -> Result<(), String> {
    let prim = place.prim;
    let own = place.mesh()?;
    let (first, first_triangle) = (mesh.positions.len(), mesh.triangles.len());
    let points = own.positions.len();
    let offset = u32::try_from(first).ok().filter(|o| o.checked_add(points as u32).is_some());
    let offset = offset.ok_or("there are too many vertices")?;
    mesh.positions.extend(&own.positions);
    mesh.triangles.extend(own.triangles.iter().map(|t| t.map(|v| v + offset)));
    mesh.group(&prim.name, first_triangle);
    mesh.group(material(prim), first_triangle);
    for subset in prim.children.iter().filter(|c| c.type_name == "GeomSubset") {
        add_subset(mesh, subset, &own, first_triangle);
    }
    for attribute in &prim.attributes {
        let Some(name) = attribute.name.strip_prefix("primvars:") else { continue };
        let Some(values) = corner_values(prim, &attribute.name, &own, points) else { continue };
        // The first pairs are where textures are.
        if values.width == 2 && mesh.triangle_uvs.len() == first_triangle {
            values.textures(mesh, &own);
        } else {
            values.channels(mesh, name, first, &own);
        }
    }
    mesh.triangle_uvs.resize(mesh.triangles.len(), None);
    Ok(())
}

/// Makes a subset of faces a group, of its own name and that of its material.
fn add_subset(mesh: &mut Mesh, subset: &Prim, own: &usd::Mesh, first_triangle: usize) {
    let faces = subset.value("indices").and_then(Value::to_integers).unwrap_or_default();
    let mut members = Vec::new();
    for face in faces.into_iter().filter_map(|face| usize::try_from(face).ok()) {
        // The triangles of a face are together, and faces in order.
        let first = own.faces.partition_point(|f| *f < face);
        let fan = own.faces[first..].iter().take_while(|f| **f == face);
        members.extend(fan.enumerate().map(|(k, _)| first_triangle + first + k));
    }
    mesh.group_of(&subset.name, members.iter().copied());
    mesh.group_of(material(subset), members.into_iter());
}

/// The name of the material that a prim has.
fn material(prim: &Prim) -> &str {
    let bound = prim.relationships.iter().find(|r| r.name == "material:binding");
    let path = bound.and_then(|r| r.targets.first());
    path.and_then(|path| path.rsplit('/').next()).unwrap_or("")
}

/// Numbers at corners of faces or at vertices.
struct Values {
    numbers: Vec<f64>,
    width: usize,
    of_corners: bool,
    points: usize,
}

/// The values of a primvar, without indices; none of those that are not for vertices or corners, or do not fit.
fn corner_values(prim: &Prim, name: &str, own: &usd::Mesh, points: usize) -> Option<Values> {
    let attribute = prim.attribute(name)?;
    let value = attribute.value.as_ref()?;
    let width = value.ty.width();
    let numbers = prim.resolved(attribute, value, width).ok()?.numbers()?;
    if !numbers.iter().all(|x| x.is_finite()) {
        return None;
    }
    let of_corners = match attribute.meta("interpolation").and_then(Value::word)? {
        "faceVarying" => true,
        "vertex" | "varying" => false,
        _ => return None,
    };
    let expected = if of_corners { own.corner_count } else { points };
    (numbers.len() == expected * width).then_some(Values { numbers, width, of_corners, points })
}

impl Values {
    /// For each vertex, the mean of its corners.
    fn of_vertices(&self, own: &usd::Mesh) -> Vec<f64> {
        if !self.of_corners {
            return self.numbers.clone();
        }
        let width = self.width;
        let mut sums = vec![0.0; self.points * width];
        let mut counts = vec![0_u32; self.points];
        for (triangle, corners) in own.triangles.iter().zip(&own.corners) {
            for (&vertex, &corner) in triangle.iter().zip(corners) {
                let vertex = vertex as usize;
                counts[vertex] += 1;
                for c in 0..width {
                    sums[vertex * width + c] += self.numbers[corner * width + c];
                }
            }
        }
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum /= f64::from(counts[i / width].max(1));
        }
        sums
    }

    /// Keeps them as numbers of the newest vertices.
    fn channels(&self, mesh: &mut Mesh, name: &str, first: usize, own: &usd::Mesh) {
        let all = self.of_vertices(own);
        match (name, self.width) {
            ("displayColor", 3 | 4) => mesh.colours(first, &all, self.width),
            ("displayOpacity", 1) => mesh.channel("alpha", first, all.into_iter()),
            _ => mesh.values(name, first, &all, self.width),
        }
    }

    /// Gives the newest triangles these texture coordinates.
    fn textures(&self, mesh: &mut Mesh, own: &usd::Mesh) {
        let Ok(first) = u32::try_from(mesh.uvs.len()) else { return };
        mesh.uvs.extend(self.numbers.as_chunks::<2>().0);
        for (triangle, corners) in own.triangles.iter().zip(&own.corners) {
            let uvs = if self.of_corners {
                corners.map(|c| u32::try_from(c).unwrap_or(0))
            } else {
                *triangle
            };
            mesh.triangle_uvs.push(Some(uvs.map(|c| first + c)));
        }
    }
}
