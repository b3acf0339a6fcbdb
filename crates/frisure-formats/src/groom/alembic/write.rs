//! A groom as the objects of an Alembic file.

use std::borrow::Cow;
use std::io::{self, Write};

use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
use glam::Vec3;

use super::super::attributes as names;
use super::meshes::accessories;
use super::names::{CURVES, KNOWN, OURS, UNREAL, XFORM};
use super::objects::{schema_of_object, still};
use crate::groom::attributes::{indices, of_strands, push};
use crate::groom::data::{Groom, HairColour};
use crate::groom::motion::{Samples, same_widths};
use frisure_files::frame::Frame;
use frisure_ogawa::parameter::Scope;
use frisure_ogawa::write::{Object, Pod, Property, Sample, TimeSampling, write_archive};

/// Writes what the check has passed.
pub(super) fn encode(out: &mut dyn Write, samples: &Samples<'_>, frame: Frame) -> io::Result<()> {
    let Samples { groom, hairs: all_hairs, guides: all_guides, interval } = samples;
    let of_guides = with_extras(&groom.guides, guide_extras(&groom.guides));
    let of_hairs = with_extras(&groom.hairs, hair_extras(groom));
    let mut parts = Vec::new();
    if !groom.guides.is_empty() {
        parts.push(Part {
            name: "guides".into(),
            is_guide: true,
            has_guides: true,
            group: None,
            rows: (0..groom.guides.len()).collect(),
            strands: &groom.guides,
            samples: all_guides,
            attributes: &of_guides,
        });
    }
    let group = group_of_hairs(groom);
    let has_guides = !groom.guides.is_empty();
    let mut of_groups = groups(all_hairs, &of_hairs, group.as_deref());
    of_groups.iter_mut().for_each(|part| part.has_guides = has_guides);
    parts.extend(of_groups);
    let children = parts.iter().map(|p| p.object(frame, groom.colour));
    let children = children.chain(accessories(&groom.accessories, frame)).collect();
    let top = Object {
        name: object_name(&groom.name),
        metadata: schema_of_object(XFORM, "", ".xform"),
        properties: vec![transform(groom, frame)],
        children,
    };
    let metadata = "_ai_AlembicVersion=Alembic 1.8.12;_ai_Application=frisure";
    let count = all_hairs.len() as u32;
    let sampling = (count > 1).then_some(TimeSampling { count, interval: *interval });
    write_archive(out, metadata, sampling, vec![top])
}

/// Attributes with some in place of those of the same names.
fn with_extras(strands: &Strands, extras: Vec<Attribute>) -> Vec<Cow<'_, Attribute>> {
    let kept = strands.attributes().iter().filter(|a| extras.iter().all(|e| e.name != a.name));
    let kept: Vec<_> = kept.map(Cow::Borrowed).collect();
    kept.into_iter().chain(extras.into_iter().map(Cow::Owned)).collect()
}

/// Guides have their own indices as [`names::ID`], which those of hairs point at.
fn guide_extras(guides: &Strands) -> Vec<Attribute> {
    let own = indices(guides, names::GUIDE).map(<[u32]>::to_vec);
    let own = own.unwrap_or_else(|| (0..guides.len() as u32).collect());
    vec![of_strands(names::ID, AttributeValues::U32(own))]
}

/// The group of each hair: that of the guide that it follows most. Unreal looks for the guides of a hair
/// in its group only, and at the border of two groups hairs follow guides of the other.
fn group_of_hairs(groom: &Groom) -> Option<Vec<u32>> {
    let own = indices(&groom.hairs, names::GROUP)?;
    let of_guides = indices(&groom.guides, names::GROUP);
    let (Some(guide), Some(of_guides)) = (indices(&groom.hairs, names::GUIDE), of_guides) else {
        return Some(own.to_vec());
    };
    let group = |(own, guide): (&u32, &u32)| *of_guides.get(*guide as usize).unwrap_or(own);
    Some(own.iter().zip(guide).map(group).collect())
}

/// Attributes that Unreal needs for each hair.
fn hair_extras(groom: &Groom) -> Vec<Attribute> {
    let hairs = &groom.hairs;
    let mut extras = Vec::new();
    if indices(hairs, names::ID).is_none() {
        let ids = (0..hairs.len() as u32).collect();
        extras.push(of_strands(names::ID, AttributeValues::U32(ids)));
    }
    // A hair grows in the wisp of the guide that it follows most.
    if let Some(guide) = indices(hairs, names::GUIDE)
        && hairs.attribute(names::CLUMP).is_none()
    {
        extras.push(of_strands(names::CLUMP, AttributeValues::U32(guide.to_vec())));
    }
    if let Some(guide) = indices(hairs, names::GUIDE)
        && !groom.guides.is_empty()
        && hairs.attribute(names::CLOSEST_GUIDES).is_none()
    {
        let closest = guide.iter().map(|&g| [g; 3]).collect();
        let weights = vec![[1.0, 0.0, 0.0]; hairs.len()];
        extras.push(of_strands(names::CLOSEST_GUIDES, AttributeValues::U32x3(closest)));
        extras.push(of_strands(names::GUIDE_WEIGHTS, AttributeValues::F32x3(weights)));
    }
    extras
}

/// Strands that become one object.
struct Part<'a> {
    name: String,
    is_guide: bool,
    /// Whether there are guides in the file.
    has_guides: bool,
    /// The group, where all are of one.
    group: Option<u32>,
    /// At their first time.
    strands: &'a Strands,
    /// At each time.
    samples: &'a [&'a Strands],
    attributes: &'a [Cow<'a, Attribute>],
    rows: Vec<usize>,
}

/// Hairs by their group.
fn groups<'a>(
    samples: &'a [&'a Strands],
    attributes: &'a [Cow<'a, Attribute>],
    group: Option<&[u32]>,
) -> Vec<Part<'a>> {
    let hairs = samples[0];
    if hairs.is_empty() {
        return Vec::new();
    }
    let part = |name: String, group: u32, rows: Vec<usize>| Part {
        name,
        is_guide: false,
        has_guides: false,
        group: Some(group),
        strands: hairs,
        samples,
        attributes,
        rows,
    };
    let Some(group) = group else {
        return vec![part("hair".into(), 0, (0..hairs.len()).collect())];
    };
    let mut all = group.to_vec();
    all.sort_unstable();
    all.dedup();
    // Groups in any number are no groups.
    if all.len() > 1000 {
        return vec![Part { group: None, ..part("hair".into(), 0, (0..hairs.len()).collect()) }];
    }
    let mut rows: Vec<Vec<usize>> = vec![Vec::new(); all.len()];
    for (row, g) in group.iter().enumerate() {
        if let Ok(i) = all.binary_search(g) {
            rows[i].push(row);
        }
    }
    all.into_iter().zip(rows).map(|(g, rows)| part(group_name(g), g, rows)).collect()
}

fn group_name(group: u32) -> String {
    let known = names::GROUPS.get(group as usize);
    known.map_or_else(|| format!("group_{group}"), |&name| name.into())
}

impl Part<'_> {
    fn object(&self, frame: Frame, colour: Option<HairColour>) -> Object<'_> {
        let mut geometry = vec![
            self.bounds(frame),
            Property::arrays("P", "geoScope=vtx;interpretation=point", self.positions(frame)),
            Property::array("nVertices", "", self.counts()),
            // Linear, not closed, no basis (twice).
            Property::scalar("curveBasisAndType", "", bytes(&[1, 0, 0, 0])),
            parameters("width", Scope::Varying, "", self.widths(frame)),
        ];
        geometry.push(Property::compound(".arbGeomParams", "", self.parameters(frame, colour)));
        let base = "schemaBaseType=AbcGeom_GeomBase_v1";
        let curves = Object {
            name: format!("{}Shape", self.name),
            metadata: schema_of_object(CURVES, base, ".geom"),
            properties: vec![Property::compound(
                ".geom",
                &format!("schema={CURVES};{base}"),
                geometry,
            )],
            children: Vec::new(),
        };
        // Programs call what is under a transform by the name of that.
        Object {
            name: self.name.clone(),
            metadata: schema_of_object(XFORM, "", ".xform"),
            properties: vec![still(Vec::new())],
            children: vec![curves],
        }
    }

    /// A range of points for each strand.
    fn ranges(&self) -> impl Iterator<Item = std::ops::Range<usize>> {
        let offsets = self.strands.offsets();
        self.rows.iter().map(|&row| offsets[row] as usize..offsets[row + 1] as usize)
    }

    fn points(&self) -> usize {
        self.ranges().map(|r| r.len()).sum()
    }

    fn bounds(&self, frame: Frame) -> Property<'static> {
        let corners = |strands: &Strands| {
            let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
            for p in self.ranges().flatten().map(|i| strands.points()[i]) {
                let p = frame.position_to_file(p);
                (low, high) = (low.min(p), high.max(p));
            }
            let corners = [low.to_array(), high.to_array()];
            let bytes = corners.as_flattened().iter().flat_map(|x| f64::from(*x).to_le_bytes());
            let bytes: Vec<u8> = bytes.collect();
            Sample::of(Pod::F64, 6, 1, move |out| out.extend_from_slice(&bytes))
        };
        let samples = self.samples.iter().map(|strands| corners(strands)).collect();
        Property::scalars(".selfBnds", "interpretation=box", samples)
    }

    fn positions(&self, frame: Frame) -> Vec<Sample<'_>> {
        let samples = self.samples.iter().map(|&strands| {
            Sample::of(Pod::F32, 3, self.points(), move |out| {
                for i in self.ranges().flatten() {
                    push(out, frame.position_to_file(strands.points()[i]).to_array());
                }
            })
        });
        samples.collect()
    }

    fn counts(&self) -> Sample<'_> {
        Sample::of(Pod::I32, 1, self.rows.len(), move |out| {
            for range in self.ranges() {
                out.extend((range.len() as i32).to_le_bytes());
            }
        })
    }

    fn widths(&self, frame: Frame) -> Vec<Sample<'_>> {
        let samples = if same_widths(self.samples) { &self.samples[..1] } else { self.samples };
        let samples = samples.iter().map(|&strands| {
            Sample::of(Pod::F32, 1, self.points(), move |out| {
                for i in self.ranges().flatten() {
                    push(out, [frame.length_to_file(2.0 * strands.radii()[i])]);
                }
            })
        });
        samples.collect()
    }

    /// Parameters that Unreal reads, and attributes of ours, which it ignores.
    fn parameters(&self, frame: Frame, colour: Option<HairColour>) -> Vec<Property<'_>> {
        let guide = [u8::from(self.is_guide), 0];
        let guide = Sample::of(Pod::I16, 1, 1, move |out| out.extend_from_slice(&guide));
        let mut all = vec![parameter("groom_guide", Scope::Constant, "", guide)];
        if let Some(group) = self.group {
            let id = (group as i32).to_le_bytes();
            let id = Sample::of(Pod::I32, 1, 1, move |out| out.extend_from_slice(&id));
            all.push(parameter("groom_group_id", Scope::Constant, "", id));
            let name = || Sample::texts(&[&self.name]);
            all.push(parameter("groom_group_name", Scope::Constant, "", name()));
            // Unreal makes one set of cards for each name.
            all.push(parameter("groom_group_cards_id", Scope::Constant, "", name()));
        } else if let Some(groups) = indices(self.strands, names::GROUP) {
            let called: Vec<String> =
                self.rows.iter().map(|&row| group_name(groups[row])).collect();
            let called: Vec<&str> = called.iter().map(String::as_str).collect();
            all.push(parameter("groom_group_name", Scope::Uniform, "", Sample::texts(&called)));
        }
        for attribute in self.attributes {
            if attribute.name == names::GROUP && self.is_one_group(attribute) {
                continue;
            }
            // The group of hairs was said, but perhaps not that of each.
            let ours = attribute.name == names::GROUP && self.group.is_some();
            all.push(self.attribute(attribute, frame, ours));
        }
        if self.attributes.iter().all(|a| a.name != names::COLOUR)
            && !self.is_guide
            && let Some(HairColour { colour, .. }) = colour
        {
            let values = Sample::of(Pod::F32, 3, 1, move |out| push(out, colour));
            all.push(parameter("groom_color", Scope::Constant, "rgb", values));
        }
        all
    }

    /// Whether an attribute says what the group of the whole says already.
    fn is_one_group(&self, attribute: &Attribute) -> bool {
        match (&attribute.values, self.group) {
            (AttributeValues::U32(v), Some(g)) => {
                attribute.domain == Domain::Strand && self.rows.iter().all(|&row| v[row] == g)
            }
            _ => false,
        }
    }

    /// An attribute under Unreal's name, if it has one, or else under ours.
    fn attribute<'a>(&'a self, attribute: &'a Attribute, frame: Frame, ours: bool) -> Property<'a> {
        let Attribute { name, domain, values } = attribute;
        let is_known = |known: &str| known == name && fits(known, *domain, values);
        let known = KNOWN.iter().filter(|_| !ours).find(|(known, _)| is_known(known));
        // Without guides Unreal makes its own, of the same numbers as hairs.
        let lost = [names::CLOSEST_GUIDES, names::GUIDE_WEIGHTS].contains(&name.as_str());
        let known = known.filter(|_| !lost || self.has_guides);
        // A colour for each point is all that the specification has.
        let spread = *domain == Domain::Strand && known.is_some() && name == names::COLOUR;
        let at = move |each: &mut dyn FnMut(usize)| match domain {
            Domain::Strand if spread => {
                self.rows.iter().zip(self.ranges()).for_each(|(&row, r)| r.for_each(|_| each(row)));
            }
            Domain::Strand => self.rows.iter().for_each(|&row| each(row)),
            Domain::Point => self.ranges().flatten().for_each(each),
        };
        let per_point = spread || *domain == Domain::Point;
        let count = if per_point { self.points() } else { self.rows.len() };
        let (is_whole, extent) = names::layout(values);
        let pod = match (is_whole, known) {
            (false, _) => Pod::F32,
            (true, Some(_)) => Pod::I32,
            (true, None) => Pod::U32,
        };
        let turned = names::in_file_axes(attribute, frame);
        let filled = Sample::of(pod, extent as u8, count, move |out| {
            at(&mut |row| names::push_value(out, &turned.values, row));
        });
        let meaning = match (name.as_str(), extent) {
            (names::COLOUR, 3) if pod == Pod::F32 => "rgb",
            (_, 2 | 3) => "vector",
            _ => "",
        };
        let written = known
            .map_or_else(|| format!("{OURS}{name}"), |(_, theirs)| format!("{UNREAL}{theirs}"));
        let scope = if per_point { Scope::Varying } else { Scope::Uniform };
        parameter(&written, scope, meaning, filled)
    }
}

/// Whether an attribute is of the kind that its name promises.
pub(super) fn fits(name: &str, domain: Domain, values: &AttributeValues) -> bool {
    match name {
        names::ID | names::GROUP | names::CLUMP => {
            matches!((domain, values), (Domain::Strand, AttributeValues::U32(_)))
        }
        names::ROOT_UV => matches!((domain, values), (Domain::Strand, AttributeValues::F32x2(_))),
        names::CLOSEST_GUIDES => {
            matches!((domain, values), (Domain::Strand, AttributeValues::U32x3(_)))
        }
        names::GUIDE_WEIGHTS => {
            matches!((domain, values), (Domain::Strand, AttributeValues::F32x3(_)))
        }
        names::COLOUR => matches!(values, AttributeValues::F32x3(_)),
        _ => false,
    }
}

fn bytes(bytes: &[u8; 4]) -> Sample<'static> {
    let bytes = *bytes;
    Sample::of(Pod::U8, 4, 1, move |out| out.extend_from_slice(&bytes))
}

/// A geometry parameter of a name, for strands or points.
fn parameter<'a>(name: &str, scope: Scope, meaning: &str, values: Sample<'a>) -> Property<'a> {
    parameters(name, scope, meaning, vec![values])
}

/// The same at each time, or with one sample for all of them.
fn parameters<'a>(
    name: &str,
    scope: Scope,
    meaning: &str,
    samples: Vec<Sample<'a>>,
) -> Property<'a> {
    let scope = match scope {
        Scope::Constant => "con",
        Scope::Uniform => "uni",
        Scope::Varying => "vtx",
    };
    let (pod, extent) = samples[0].kind();
    let meaning =
        if meaning.is_empty() { String::new() } else { format!("interpretation={meaning};") };
    let metadata = format!(
        "arrayExtent=1;geoScope={scope};{meaning}isGeomParam=true;podExtent={extent};podName={}",
        pod.name()
    );
    Property::arrays(name, &metadata, samples)
}

/// A name that programs take: letters, digits, underscores.
fn object_name(name: &str) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = name.chars().map(plain).take(64).collect();
    if name.is_empty() { "groom".into() } else { name }
}

/// The top transform, which moves nothing and says what the groom is.
fn transform(groom: &Groom, frame: Frame) -> Property<'static> {
    let short = |n: i16| Sample::of(Pod::I16, 1, 1, move |out| out.extend(n.to_le_bytes()));
    let up = frame.up.name();
    let metres = frame.metres;
    let unit = Sample::of(Pod::F64, 1, 1, move |out| out.extend(metres.to_le_bytes()));
    let mut user = vec![
        Property::scalar("groom_version_major", "", short(1)),
        Property::scalar("groom_version_minor", "", short(5)),
        Property::scalar("groom_tool", "", Sample::texts(&["frisure"])),
        Property::scalar("frisure_metres", "", unit),
        Property::scalar("frisure_up", "", Sample::texts(&[up])),
    ];
    if let Some(HairColour { colour, .. }) = groom.colour {
        let values = Sample::of(Pod::F32, 3, 1, move |out| push(out, colour));
        user.push(Property::scalar("frisure_color", "interpretation=rgb", values));
    }
    if let Some(melanin) = groom.colour.and_then(|c| c.melanin) {
        let pair = [melanin.eumelanin, melanin.pheomelanin];
        let values = Sample::of(Pod::F32, 2, 1, move |out| push(out, pair));
        user.push(Property::scalar("frisure_melanin", "interpretation=vector", values));
    }
    still(vec![Property::compound(".userProperties", "", user)])
}
