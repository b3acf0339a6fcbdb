//! A stage as a groom.

use frisure_look::Melanin;
use frisure_strands::{Strands, Surface};
use glam::{DMat4, Vec3};

use super::super::curves::Curves;
use super::super::data::{Groom, HairColour};
use super::basis::{self, Taps};
use super::names::{PIGMENTS, TEXTURE};
use super::primvars::{self, Per, given, mixed};
use crate::accessory_names::PRIMVAR;
use frisure_files::frame::Frame;
use frisure_usd::{Mesh, Stage, StagePrim, Value};

/// Diameter of fibres of a prim without widths, where others have some (m).
const USUAL_DIAMETER: f64 = 70e-6;

/// The groom of a stage.
pub(super) fn groom(stage: &Stage, frame: Frame) -> Result<Groom, String> {
    let (mut hairs, mut guides) = (Vec::new(), Vec::new());
    let (mut found, mut times) = (false, 0);
    let (mut colour, mut coloured) = (None, false);
    for place in &stage.prims {
        let described = |e: String| stage.fault(place, &e);
        let Some(taps) = taps(place).map_err(described)? else { continue };
        found = true;
        times = times.max(place.prim.attribute("points").map_or(0, |points| points.times));
        let curves = curves(place, &taps, frame).map_err(described)?;
        let (own_hairs, own_guides) = divided(curves, place, &taps).map_err(described)?;
        // That of the first prim with hairs.
        if !coloured && !own_hairs.counts.is_empty() {
            (colour, coloured) = (self::colour(place, &taps, stage), true);
        }
        hairs.push(own_hairs);
        guides.push(own_guides);
    }
    if !found {
        return Err(format!("it has no curves{}", stage.hint()));
    }
    Ok(Groom {
        name: name(stage).unwrap_or_default(),
        hairs: joined(hairs, frame)?,
        guides: joined(guides, frame)?,
        head: head(stage, frame)?,
        accessories: Vec::new(),
        colour,
        times,
    })
}

/// The name for people.
fn name(stage: &Stage) -> Option<String> {
    let named = stage.prims.iter().find_map(|p| p.prim.meta("displayName"));
    named?.word().map(str::to_owned)
}

/// Points on a prim's curves; none of what has no curves.
fn taps(place: &StagePrim) -> Result<Option<Taps>, String> {
    let is_basis = match place.prim.type_name.as_str() {
        "BasisCurves" => true,
        "NurbsCurves" => false,
        _ => return Ok(None),
    };
    let points = place.prim.value("points").map_or(0, Value::len);
    let counts = place.prim.value("curveVertexCounts").and_then(Value::to_integers);
    let mut vertices = Vec::new();
    // Before anything is made of them.
    let mut left = points;
    for (i, count) in counts.unwrap_or_default().into_iter().enumerate() {
        let count = usize::try_from(count).ok().filter(|&n| n > 0 && n <= left);
        let count =
            count.ok_or_else(|| format!("curve {i} has more vertices than there are, or none"))?;
        left -= count;
        vertices.push(count);
    }
    if left > 0 {
        return Err(format!("{left} of {points} points are of no curve"));
    }
    if u32::try_from(points).is_err() {
        return Err(format!("it has {points} points"));
    }
    let taps = if is_basis {
        basis::basis_curves(place.prim, &vertices)
    } else {
        basis::nurbs_curves(place.prim, &vertices)
    };
    taps.map(Some)
}

/// The curves of one prim.
fn curves(place: &StagePrim, taps: &Taps, frame: Frame) -> Result<Curves, String> {
    let positions = place.prim.value("points").and_then(Value::to_floats).unwrap_or_default();
    if positions.len() != 3 * taps.vertices {
        return Err("its points have not three coordinates each".into());
    }
    let positions: &[[f32; 3]] = positions.as_chunks().0;
    let widths = given(place, "widths", Per::Vertex, taps)?;
    let widths = widths.map(|w| w.of_single_numbers("widths")).transpose()?;
    let mut diameters = widths.and_then(|w| w.at_points(taps)).unwrap_or_default();
    let size = scale(&place.world);
    if size != 1.0 {
        diameters.iter_mut().for_each(|d| *d *= size);
    }
    let points = taps
        .taps
        .iter()
        .map(|tap| std::array::from_fn(|axis| mixed(tap, |i| positions[i as usize][axis])));
    Ok(Curves {
        counts: taps.counts.clone(),
        points: placed(points.collect(), &place.world),
        diameters,
        attributes: primvars::attributes(place, taps, frame)?,
    })
}

/// Hairs and guides of the curves of a prim.
fn divided(curves: Curves, place: &StagePrim, taps: &Taps) -> Result<(Curves, Curves), String> {
    let is_guide = match primvars::guides(place, taps)? {
        Some(all) if all.iter().any(|&g| g != all[0]) => {
            let (guides, hairs): (Vec<_>, Vec<_>) = (0..all.len()).partition(|&i| all[i]);
            return Ok((curves.picked(&hairs), curves.picked(&guides)));
        }
        Some(all) => all.first() == Some(&true),
        None => place.is_guide || place.prim.name.to_lowercase().contains("guide"),
    };
    let none = Curves::default();
    Ok(if is_guide { (none, curves) } else { (curves, none) })
}

/// Points in the space of the stage.
fn placed(mut points: Vec<[f32; 3]>, world: &DMat4) -> Vec<[f32; 3]> {
    if *world != DMat4::IDENTITY {
        for p in &mut points {
            let moved = world.transform_point3(Vec3::from_array(*p).as_dvec3());
            *p = moved.as_vec3().to_array();
        }
    }
    points
}

/// How much larger lengths become, in the mean of all directions.
fn scale(world: &DMat4) -> f32 {
    let size = world.determinant().abs().cbrt();
    // Turns leave a trace of rounding.
    if (size - 1.0).abs() < 1e-6 { 1.0 } else { size as f32 }
}

/// Strands of several prims.
fn joined(parts: Vec<Curves>, frame: Frame) -> Result<Strands, String> {
    let parts = parts.into_iter().filter(|part| !part.counts.is_empty());
    Curves::joined(parts, (USUAL_DIAMETER / frame.metres) as f32).strands(frame)
}

/// The colour of a prim's hair: that of its material, or one for all its curves.
fn colour(place: &StagePrim, taps: &Taps, stage: &Stage) -> Option<HairColour> {
    let constant = |name: &str| given(place, name, Per::Prim, taps).ok()??.constant();
    let three = |v: Vec<f32>| <[f32; 3]>::try_from(v).ok();
    let shown = || three(constant("primvars:displayColor")?);
    let colour = diffuse(place, stage).and_then(three).or_else(shown)?;
    let [eumelanin, pheomelanin] = PIGMENTS.map(|name| Some(constant(name)?[0]));
    let melanin = match (eumelanin, pheomelanin) {
        (Some(eumelanin), Some(pheomelanin)) => Some(Melanin { eumelanin, pheomelanin }),
        _ => None,
    };
    Some(HairColour { melanin, colour })
}

/// The colour of the preview material that a prim has.
fn diffuse(place: &StagePrim, stage: &Stage) -> Option<Vec<f32>> {
    let bound = place.prim.relationships.iter().find(|r| r.name == "material:binding")?;
    let path = bound.targets.first()?;
    let mut shaders = stage.prim(path)?.children.iter();
    let shader = shaders.find(|s| s.word("info:id") == Some("UsdPreviewSurface"))?;
    let colour = shader.attribute("inputs:diffuseColor")?;
    // From a texture or so: no single colour.
    if colour.connections.is_empty() { colour.value.as_ref()?.to_floats() } else { None }
}

/// The head, where the stage has exactly one mesh besides accessories.
fn head(stage: &Stage, frame: Frame) -> Result<Option<Surface>, String> {
    let is_head = |p: &&StagePrim| {
        p.prim.type_name == "Mesh" && !p.is_guide && p.prim.attribute(PRIMVAR).is_none()
    };
    let mut meshes = stage.prims.iter().filter(is_head);
    let (Some(place), None) = (meshes.next(), meshes.next()) else { return Ok(None) };
    let mut mesh = place.mesh().map_err(|e| stage.fault(place, &e))?;
    let metres = |p: &[f64; 3]| frame.position_from_file((*p).into());
    let positions = mesh.positions.iter().map(metres).collect();
    let triangles = std::mem::take(&mut mesh.triangles);
    let texture = texture(place, &mesh, &triangles);
    let surface =
        Surface::new(positions, triangles).map_err(|e| stage.fault(place, &e.to_string()))?;
    Ok(Some(match texture {
        Some(texture) => surface.clone().with_texture(texture).unwrap_or(surface),
        None => surface,
    }))
}

/// The texture coordinates at the corners of triangles, where the mesh has them at corners or vertices.
fn texture(place: &StagePrim, mesh: &Mesh, triangles: &[[u32; 3]]) -> Option<Vec<[[f32; 2]; 3]>> {
    let attribute = place.prim.attribute(TEXTURE)?;
    let value = attribute.value.as_ref().filter(|value| value.ty.width() == 2)?;
    let numbers = place.prim.resolved(attribute, value, 2).ok()?.numbers()?;
    let rows = numbers.as_chunks::<2>().0;
    let row = |i: usize| rows.get(i).map(|uv| uv.map(|x| x as f32));
    let three = |[a, b, c]: [usize; 3]| Some([row(a)?, row(b)?, row(c)?]);
    match attribute.meta("interpolation").and_then(Value::word)? {
        "faceVarying" => mesh.corners.iter().map(|corners| three(*corners)).collect(),
        "vertex" | "varying" => triangles.iter().map(|t| three(t.map(|v| v as usize))).collect(),
        _ => None,
    }
}
