//! A groom from the curves of an Alembic file: the first sample of all that move.

use frisure_look::Melanin;
use frisure_strands::{Attribute, Domain};
use glam::{DMat4, DVec3, Vec3};

use super::super::attributes as names;
use super::curves::{Stencil, bezier, spline};
use super::names::{FRAME, KNOWN, OURS, UNREAL};
use super::part::{self, Part};
use super::write::fits;
use crate::groom::curves::Curves;
use crate::groom::data::{Groom, HairColour};
use frisure_files::frame::{Frame, FrameChoice, UpAxis};
use frisure_ogawa::parameter::{Numbers, Parameter, Scope};
use frisure_ogawa::read::{Archive, Kind, Object, Property};

/// How deep objects can be in each other.
const DEEPEST: usize = 64;

/// How many attributes curves can have: those of an object take memory for each strand.
const MOST_ATTRIBUTES: usize = 64;

/// Bytes of a file into a groom, or what is wrong with them.
pub(super) fn decode(bytes: &[u8], choice: FrameChoice) -> Result<Groom, String> {
    let archive = Archive::open(bytes)?;
    let mut found = Found::default();
    let mut open = vec![(archive.top(), DMat4::IDENTITY, 0)];
    while let Some((object, placed, depth)) = open.pop() {
        let within = |what| format!("in `{}`: {what}", object.name);
        let placed = visit(&archive, &object, placed, &mut found).map_err(within)?;
        let children = archive.children(&object).map_err(within)?;
        if depth >= DEEPEST && !children.is_empty() {
            return Err(format!("its objects are more than {DEEPEST} deep in each other"));
        }
        open.extend(children.into_iter().rev().map(|child| (child, placed, depth + 1)));
    }
    let usual = found.frame.unwrap_or(FRAME);
    found.groom(choice.or(usual))
}

/// The contents of a file.
#[derive(Default)]
struct Found {
    /// Name of the first transform.
    name: Option<String>,
    frame: Option<Frame>,
    colour: Option<[f32; 3]>,
    melanin: Option<Melanin>,
    hairs: Vec<Part>,
    guides: Vec<Part>,
    /// Most samples in time of the points of any curves; 0 if none move.
    times: usize,
}

impl Found {
    fn groom(self, frame: Frame) -> Result<Groom, String> {
        let usual = part::usual_diameter(frame);
        let guides = Curves::joined(self.guides.into_iter().map(|part| part.curves), usual);
        let mut hairs = self.hairs;
        let colour = part::shared_colour(&mut hairs);
        let mut hairs = part::joined_by_id(hairs, usual);
        part::follow(&mut hairs, &guides);
        let melanin = self.melanin;
        let colour = self.colour.or(colour).map(|colour| HairColour { melanin, colour });
        Ok(Groom {
            name: self.name.unwrap_or_default(),
            hairs: part::finished(hairs, frame).strands(frame)?,
            guides: part::finished(guides, frame)
                .strands(frame)
                .map_err(|e| format!("of its guides, {e}"))?,
            head: None,
            accessories: Vec::new(),
            colour,
            times: self.times,
        })
    }
}

/// Takes what an object has; the matrix is where its children are.
fn visit<'a>(
    archive: &Archive<'a>,
    object: &Object<'a>,
    placed: DMat4,
    found: &mut Found,
) -> Result<DMat4, String> {
    let schema = object.schema();
    let (is_transform, is_curves) =
        (schema.starts_with(b"AbcGeom_Xform_"), schema.starts_with(b"AbcGeom_Curve_"));
    if !is_transform && !is_curves {
        return Ok(placed);
    }
    let properties = archive.properties(object)?;
    if is_transform {
        let Some(transform) = named(&properties, ".xform") else { return Ok(placed) };
        let parts = archive.parts(&transform)?;
        said(archive, &parts, found)?;
        if found.name.is_none() {
            found.name = Some(object.name.clone());
        }
        return transformed(archive, &parts, placed);
    }
    let Some(geometry) = named(&properties, ".geom") else { return Ok(placed) };
    let geometry = archive.parts(&geometry)?;
    if let Some(Kind::Values { samples: samples @ 2.., .. }) =
        named(&geometry, "P").map(|points| points.kind)
    {
        found.times = found.times.max(samples);
    }
    if let Some((part, guides)) = curves(archive, &geometry, placed)? {
        let rows = |of: bool| (0..guides.len()).filter(|&i| guides[i] == of).collect::<Vec<_>>();
        match (rows(true), rows(false)) {
            (_, hairs) if hairs.len() == guides.len() => found.hairs.push(part),
            (those, hairs) if hairs.is_empty() && !those.is_empty() => found.guides.push(part),
            (those, hairs) => {
                found.guides.push(part.picked(&those));
                found.hairs.push(part.picked(&hairs));
            }
        }
    }
    Ok(placed)
}

fn named<'a>(properties: &[Property<'a>], name: &str) -> Option<Property<'a>> {
    properties.iter().find(|p| p.name == name.as_bytes()).copied()
}

/// Reads the properties that frisure writes for a whole file.
fn said<'a>(
    archive: &Archive<'a>,
    transform: &[Property<'a>],
    found: &mut Found,
) -> Result<(), String> {
    let Some(user) = named(transform, ".userProperties") else { return Ok(()) };
    let user = archive.parts(&user)?;
    if let (Some(metres), Some(up)) = (named(&user, "frisure_metres"), named(&user, "frisure_up")) {
        let word = archive.sample(&metres)?.first_chunk().copied();
        let up = if archive.sample(&up)?.starts_with(b"z") { UpAxis::Z } else { UpAxis::Y };
        found.frame = word.map(|word| Frame { metres: f64::from_le_bytes(word), up });
    }
    if let Some(colour) = named(&user, "frisure_color")
        && let Some((3, Numbers::Real(rgb))) = archive.numbers(&colour)?
        && let [r, g, b] = rgb[..]
    {
        found.colour = Some([r, g, b]);
    }
    if let Some(melanin) = named(&user, "frisure_melanin")
        && let Some((2, Numbers::Real(pair))) = archive.numbers(&melanin)?
        && let [eumelanin, pheomelanin] = pair[..]
        && [eumelanin, pheomelanin].iter().all(|m| (0.0..1e3).contains(m))
    {
        found.melanin = Some(Melanin { eumelanin, pheomelanin });
    }
    Ok(())
}

/// The matrix of the children of a transform.
fn transformed<'a>(
    archive: &Archive<'a>,
    transform: &[Property<'a>],
    placed: DMat4,
) -> Result<DMat4, String> {
    let inherits = match named(transform, ".inherits") {
        Some(property) => archive.sample(&property)?.first() != Some(&0),
        None => true,
    };
    let mut matrix = if inherits { placed } else { DMat4::IDENTITY };
    let (Some(operations), Some(values)) = (named(transform, ".ops"), named(transform, ".vals"))
    else {
        return Ok(matrix);
    };
    let mut values = archive.sample(&values)?.as_chunks().0.iter().map(|w| f64::from_le_bytes(*w));
    let mut next = || values.next().ok_or("a transform has too few numbers");
    for operation in archive.sample(&operations)? {
        let one = match operation >> 4 {
            0 => DMat4::from_scale(DVec3::new(next()?, next()?, next()?)),
            1 => DMat4::from_translation(DVec3::new(next()?, next()?, next()?)),
            2 => {
                let axis = DVec3::new(next()?, next()?, next()?).normalize_or(DVec3::X);
                DMat4::from_axis_angle(axis, next()?.to_radians())
            }
            3 => {
                let mut rows = [0.0; 16];
                for x in &mut rows {
                    *x = next()?;
                }
                // Points are rows there: its rows are columns here.
                DMat4::from_cols_array(&rows)
            }
            4 => DMat4::from_rotation_x(next()?.to_radians()),
            5 => DMat4::from_rotation_y(next()?.to_radians()),
            6 => DMat4::from_rotation_z(next()?.to_radians()),
            kind => return Err(format!("a transform has an operation of kind {kind}")),
        };
        // The last of them is done first.
        matrix *= one;
    }
    Ok(matrix)
}

/// The numbers of a property of a name; nothing where there is none.
fn numbers<'a>(
    archive: &Archive<'a>,
    properties: &[Property<'a>],
    name: &str,
) -> Result<Option<(usize, Numbers)>, String> {
    match named(properties, name) {
        Some(property) => archive.numbers(&property),
        None => Ok(None),
    }
}

/// The curves of an object, and which of them are guides; nothing where they are closed, as no hair is.
fn curves<'a>(
    archive: &Archive<'a>,
    geometry: &[Property<'a>],
    placed: DMat4,
) -> Result<Option<(Part, Vec<bool>)>, String> {
    let Some((counts, points)) = control_points(archive, geometry, placed)? else {
        return Ok(None);
    };
    let Some(stencils) = basis(archive, geometry, &counts)? else { return Ok(None) };
    let mut part = Part { curves: Curves { counts, points, ..Curves::default() }, colour: None };
    let parameters = match named(geometry, ".arbGeomParams") {
        Some(compound) => archive.parts(&compound)?,
        None => Vec::new(),
    };
    // Some programs write the width as a parameter of Unreal's only.
    if let Some(width) = named(geometry, "width").or(named(&parameters, "groom_width"))
        && let Some(Parameter { scope, extent: 1, values: Numbers::Real(values) }) =
            archive.parameter(&width, part.curves.counts.len(), part.curves.points.len())?
    {
        let scale = placed.determinant().abs().cbrt();
        let scaled: Vec<f32> = values.iter().map(|w| (f64::from(*w) * scale) as f32).collect();
        part.curves.diameters = part.per_point(scope, &scaled);
    }
    let mut guides = vec![false; part.curves.counts.len()];
    for property in &parameters {
        parameter(archive, property, placed, &mut part, &mut guides)?;
    }
    // Texture coordinates of strands are those of their roots.
    let has_roots = part.curves.attributes.iter().any(|a| a.name == names::ROOT_UV);
    if let Some(uv) = named(geometry, "uv").filter(|_| !has_roots)
        && let Some(found) =
            archive.parameter(&uv, part.curves.counts.len(), part.curves.points.len())?
        && let Some(uv) = attribute(names::ROOT_UV, found, part.curves.counts.len())
        && fits(&uv.name, uv.domain, &uv.values)
    {
        part.curves.attributes.push(uv);
    }
    if let Some(stencils) = stencils {
        part = part.evaluated(&stencils);
    }
    Ok(Some((part, guides)))
}

/// The number of control points of each curve, and all points.
type ControlPoints = (Vec<usize>, Vec<[f32; 3]>);

/// The control points where they are in the file's space; nothing where the object has none.
fn control_points<'a>(
    archive: &Archive<'a>,
    geometry: &[Property<'a>],
    placed: DMat4,
) -> Result<Option<ControlPoints>, String> {
    let Some((1, Numbers::Whole(counts))) = numbers(archive, geometry, "nVertices")? else {
        return Ok(None);
    };
    let counts: Vec<usize> = counts.into_iter().map(|n| n as usize).collect();
    let Some((3, Numbers::Real(points))) = numbers(archive, geometry, "P")? else {
        return Ok(None);
    };
    let points: &[[f32; 3]] = points.as_chunks().0;
    let total = counts.iter().try_fold(0_usize, |sum, &n| sum.checked_add(n));
    if total != Some(points.len()) {
        let total = total.map_or("too many".into(), |n| n.to_string());
        return Err(format!("its curves have {total} points, and it has {}", points.len()));
    }
    if let Some(i) = counts.iter().position(|&n| n == 0) {
        return Err(format!("curve {i} has no point"));
    }
    let moved = |p: &[f32; 3]| {
        placed.transform_point3(Vec3::from_array(*p).as_dvec3()).as_vec3().to_array()
    };
    let points = if placed == DMat4::IDENTITY {
        points.to_vec()
    } else {
        points.iter().map(moved).collect()
    };
    Ok(Some((counts, points)))
}

/// The stencils of each curve, none where its points are control points; nothing where the curves are closed.
fn basis<'a>(
    archive: &Archive<'a>,
    geometry: &[Property<'a>],
    counts: &[usize],
) -> Result<Option<Option<Vec<Vec<Stencil>>>>, String> {
    let how = match named(geometry, "curveBasisAndType") {
        Some(p) => archive.sample(&p)?,
        None => &[],
    };
    // Linear, open, no basis, where nothing is said.
    let (kind, closed, basis) = match how {
        [kind, closed, basis, ..] => (*kind, *closed, *basis),
        _ => (1, 0, 0),
    };
    if closed != 0 {
        return Ok(None);
    }
    if let Some((1, Numbers::Real(weights))) = numbers(archive, geometry, "w")?
        && weights.iter().any(|w| *w != weights[0])
    {
        return Err("its points have weights, and those are not read".into());
    }
    let orders = match numbers(archive, geometry, ".orders")? {
        Some((1, Numbers::Whole(orders))) => orders,
        _ => Vec::new(),
    };
    let knots = match numbers(archive, geometry, ".knots")? {
        Some((1, Numbers::Real(knots))) => knots,
        _ => Vec::new(),
    };
    stencils(kind, basis, counts, &orders, &knots).map(Some)
}

/// How points of strands come from control points, curve by curve; nothing where they are the same.
fn stencils(
    kind: u8,
    basis: u8,
    counts: &[usize],
    orders: &[u32],
    knots: &[f32],
) -> Result<Option<Vec<Vec<Stencil>>>, String> {
    let variable = kind == 2;
    match (kind, basis) {
        (1, _) | (0, 0 | 3) => return Ok(None),
        (0, 1) => {
            // Most have the same number of points.
            return counts.iter().map(|&n| bezier(n)).collect::<Result<_, _>>().map(Some);
        }
        (0, 2) | (2, _) => {}
        (0, 4) => return Err("its curves are Hermite curves, and those are not read".into()),
        _ => return Err(format!("its curves are of kind {kind} and basis {basis}")),
    }
    if variable && orders.len() != counts.len() {
        return Err(format!("it has {} orders for {} curves", orders.len(), counts.len()));
    }
    let degree = |i: usize| if variable { (orders[i] as usize).saturating_sub(1) } else { 3 };
    if let Some(i) = (0..counts.len()).find(|&i| !(1..=3).contains(&degree(i))) {
        return Err(format!("curve {i} is of degree {}, and 1 to 3 are read", degree(i)));
    }
    let needed: usize = counts.iter().enumerate().map(|(i, n)| n + degree(i) + 1).sum();
    let mut rest = if needed == knots.len() { knots } else { &[] };
    let each = |(i, &n): (usize, &usize)| {
        let (own, tail) = rest.split_at((n + degree(i) + 1).min(rest.len()));
        rest = tail;
        spline(n, degree(i), own).map_err(|e| format!("of curve {i}, {e}"))
    };
    counts.iter().enumerate().map(each).collect::<Result<_, _>>().map(Some)
}

/// Takes a parameter, if it is one of grooms.
fn parameter<'a>(
    archive: &Archive<'a>,
    property: &Property<'a>,
    placed: DMat4,
    part: &mut Part,
    guides: &mut [bool],
) -> Result<(), String> {
    let Ok(written) = std::str::from_utf8(property.name) else { return Ok(()) };
    let known = |theirs: &str| KNOWN.iter().find(|(_, t)| *t == theirs).map(|(ours, _)| *ours);
    let unreal = written.strip_prefix(UNREAL);
    let is_guide = unreal == Some("guide");
    let ours = written.strip_prefix(OURS).filter(|name| is_plain(name));
    let Some(name) = unreal.and_then(known).or(ours).or(is_guide.then_some("")) else {
        return Ok(());
    };
    let (strands, points) = (part.curves.counts.len(), part.curves.points.len());
    let Some(found) = archive.parameter(property, strands, points)? else { return Ok(()) };
    if is_guide {
        if let Numbers::Whole(flags) = found.values {
            match found.scope {
                Scope::Constant => guides.fill(flags[0] != 0),
                Scope::Uniform => guides.iter_mut().zip(flags).for_each(|(g, f)| *g = f != 0),
                Scope::Varying => {}
            }
        }
        return Ok(());
    }
    if let (names::COLOUR, Scope::Constant, 3, Numbers::Real(c)) =
        (name, found.scope, found.extent, &found.values)
    {
        part.colour = Some([c[0], c[1], c[2]]);
        return Ok(());
    }
    // One guide is one of three.
    let single = found.extent == 1 && unreal.is_some();
    let name = match (name, &found.values) {
        (names::CLOSEST_GUIDES, Numbers::Whole(_)) if single => names::GUIDE,
        _ => name,
    };
    let Some(mut attribute) = attribute(name, found, strands) else { return Ok(()) };
    if unreal.is_some() && name != names::GUIDE && !fits(name, attribute.domain, &attribute.values)
    {
        return Ok(());
    }
    names::turn_directions(&mut attribute, |d| {
        placed.transform_vector3(d.as_dvec3()).normalize_or_zero().as_vec3()
    });
    match part.curves.attributes.iter().position(|a| a.name == attribute.name) {
        // Ours say it better where there are both: groups are changed for Unreal.
        Some(at) if ours.is_some() => part.curves.attributes[at] = attribute,
        Some(_) => {}
        None if part.curves.attributes.len() < MOST_ATTRIBUTES => {
            part.curves.attributes.push(attribute);
        }
        None => return Err(format!("it has more than {MOST_ATTRIBUTES} attributes")),
    }
    Ok(())
}

/// Whether a name is one that an attribute of ours can have.
fn is_plain(name: &str) -> bool {
    let plain = |b: u8| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'_';
    !name.is_empty() && name.len() <= 64 && name.bytes().all(plain)
}

/// An attribute; what an object has one of is each strand's.
fn attribute(name: &str, found: Parameter, strands: usize) -> Option<Attribute> {
    fn spread<T: Copy>(values: Vec<T>, found: (Scope, usize), strands: usize) -> Vec<T> {
        let (scope, extent) = found;
        if scope == Scope::Constant { values[..extent].repeat(strands) } else { values }
    }
    let Parameter { scope, extent, values } = found;
    let values = match values {
        Numbers::Whole(v) => names::whole_values(spread(v, (scope, extent), strands), extent)?,
        Numbers::Real(v) => names::real_values(spread(v, (scope, extent), strands), extent)?,
    };
    let domain = if scope == Scope::Varying { Domain::Point } else { Domain::Strand };
    Some(Attribute { name: name.into(), domain, values })
}
