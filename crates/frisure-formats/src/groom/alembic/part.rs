//! The curves of one object, and several of them as one.

use frisure_strands::{Attribute, AttributeValues, Domain};
use glam::Vec3;

use super::super::attributes as names;
use super::curves::Stencil;
use crate::groom::checked::{Curves, USUAL_RADIUS};
use frisure_files::frame::Frame;
use frisure_ogawa::parameter::Scope;

/// Curves as a file has them.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    /// How many points each has.
    pub(super) counts: Vec<usize>,
    /// In the unit and axes of the file.
    pub(super) points: Vec<[f32; 3]>,
    /// At the points; empty where there are none.
    pub(super) diameters: Vec<f32>,
    /// With directions in the axes of the file.
    pub(super) attributes: Vec<Attribute>,
    /// The one colour of all.
    pub(super) colour: Option<[f32; 3]>,
}

/// Does the same with the values of an attribute, of whichever kind.
macro_rules! each_kind {
    ($values:expr, $v:ident => $made:expr) => {
        match $values {
            AttributeValues::U32($v) => AttributeValues::U32($made),
            AttributeValues::U32x3($v) => AttributeValues::U32x3($made),
            AttributeValues::F32($v) => AttributeValues::F32($made),
            AttributeValues::F32x2($v) => AttributeValues::F32x2($made),
            AttributeValues::F32x3($v) => AttributeValues::F32x3($made),
        }
    };
}

impl Part {
    /// Values of a scope as one for each point.
    pub(super) fn per_point(&self, scope: Scope, values: &[f32]) -> Vec<f32> {
        match scope {
            Scope::Constant => vec![values[0]; self.points.len()],
            Scope::Uniform => {
                let each = self.counts.iter().zip(values);
                each.flat_map(|(&n, &v)| std::iter::repeat_n(v, n)).collect()
            }
            Scope::Varying => values.to_vec(),
        }
    }

    fn starts(&self) -> Vec<usize> {
        let mut end = 0;
        let start = |n: &usize| {
            end += n;
            end - n
        };
        self.counts.iter().map(start).collect()
    }

    /// Some of the curves, in an order.
    pub(super) fn picked(&self, rows: &[usize]) -> Self {
        fn of<T: Copy>(values: &[T], picked: impl Iterator<Item = usize>) -> Vec<T> {
            picked.map(|i| values[i]).collect()
        }
        let starts = self.starts();
        let points = || rows.iter().flat_map(|&r| starts[r]..starts[r] + self.counts[r]);
        let attribute = |a: &Attribute| {
            let values = match a.domain {
                Domain::Strand => each_kind!(&a.values, v => of(v, rows.iter().copied())),
                Domain::Point => each_kind!(&a.values, v => of(v, points())),
            };
            Attribute { values, ..a.clone() }
        };
        Self {
            counts: rows.iter().map(|&r| self.counts[r]).collect(),
            points: of(&self.points, points()),
            diameters: if self.diameters.is_empty() {
                Vec::new()
            } else {
                of(&self.diameters, points())
            },
            attributes: self.attributes.iter().map(attribute).collect(),
            colour: self.colour,
        }
    }

    /// The points on its curves, where these are control points.
    pub(super) fn evaluated(&self, stencils: &[Vec<Stencil>]) -> Self {
        let starts = self.starts();
        let places: Vec<(usize, Stencil)> = stencils
            .iter()
            .zip(&starts)
            .flat_map(|(s, &start)| s.iter().map(move |s| (start + s.from, *s)))
            .collect();
        let attribute = |a: &Attribute| match a.domain {
            Domain::Strand => a.clone(),
            Domain::Point => Attribute { values: mixed_values(&a.values, &places), ..a.clone() },
        };
        Self {
            counts: stencils.iter().map(Vec::len).collect(),
            points: places.iter().map(|place| mixed(&self.points, place)).collect(),
            diameters: if self.diameters.is_empty() {
                Vec::new()
            } else {
                let one = |i: usize| [self.diameters[i]];
                places.iter().map(|place| mixed_of(one, place)[0]).collect()
            },
            attributes: self.attributes.iter().map(attribute).collect(),
            colour: self.colour,
        }
    }

    /// What every reader hands over, with directions in our axes.
    pub(super) fn curves(self, frame: Frame) -> Curves {
        let Self { counts, points, diameters, mut attributes, .. } = self;
        for attribute in &mut attributes {
            if let (names::DIRECTOR, AttributeValues::F32x3(directions)) =
                (attribute.name.as_str(), &mut attribute.values)
            {
                for d in directions {
                    *d = frame.direction_from_file(Vec3::from_array(*d)).to_array();
                }
            }
        }
        let mut diameters = diameters;
        // What has no width has the usual one, in the unit of the file.
        let usual = (2.0 * f64::from(USUAL_RADIUS) / frame.metres) as f32;
        diameters.iter_mut().filter(|d| d.is_nan()).for_each(|d| *d = usual);
        Curves { counts, points, diameters, attributes }
    }
}

fn mixed<const N: usize>(values: &[[f32; N]], place: &(usize, Stencil)) -> [f32; N] {
    mixed_of(|i| values[i], place)
}

fn mixed_of<const N: usize>(
    value: impl Fn(usize) -> [f32; N],
    (from, stencil): &(usize, Stencil),
) -> [f32; N] {
    let mut sum = [0.0; N];
    for (k, w) in stencil.weights.iter().enumerate().filter(|(_, w)| **w != 0.0) {
        let value = value(from + k);
        sum.iter_mut().zip(value).for_each(|(s, v)| *s += w * v);
    }
    sum
}

fn mixed_values(values: &AttributeValues, places: &[(usize, Stencil)]) -> AttributeValues {
    let heaviest = |(from, stencil): &(usize, Stencil)| {
        let weights = stencil.weights.iter().enumerate();
        from + weights.max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(k, _)| k)
    };
    match values {
        AttributeValues::U32(v) => {
            AttributeValues::U32(places.iter().map(|p| v[heaviest(p)]).collect())
        }
        AttributeValues::U32x3(v) => {
            AttributeValues::U32x3(places.iter().map(|p| v[heaviest(p)]).collect())
        }
        AttributeValues::F32(v) => {
            AttributeValues::F32(places.iter().map(|p| mixed_of(|i| [v[i]], p)[0]).collect())
        }
        AttributeValues::F32x2(v) => {
            AttributeValues::F32x2(places.iter().map(|p| mixed(v, p)).collect())
        }
        AttributeValues::F32x3(v) => {
            AttributeValues::F32x3(places.iter().map(|p| mixed(v, p)).collect())
        }
    }
}

/// The colour that all parts have, or else each strand with that of its part.
pub(super) fn shared_colour(parts: &mut [Part]) -> Option<[f32; 3]> {
    let first = parts.first()?.colour;
    if parts.iter().all(|p| p.colour == first) {
        return first;
    }
    for part in parts {
        if let Some(colour) = part.colour
            && part.attributes.iter().all(|a| a.name != names::COLOUR)
        {
            let values = AttributeValues::F32x3(vec![colour; part.counts.len()]);
            let name = names::COLOUR.into();
            part.attributes.push(Attribute { name, domain: Domain::Strand, values });
        }
    }
    None
}

/// Parts as one, with the attributes that all of them have.
pub(super) fn joined(mut parts: Vec<Part>) -> Part {
    if parts.len() < 2 {
        return parts.pop().unwrap_or_default();
    }
    let some_have_width = parts.iter().any(|p| !p.diameters.is_empty());
    let mut all = Part { attributes: std::mem::take(&mut parts[0].attributes), ..Part::default() };
    for (i, part) in parts.into_iter().enumerate() {
        if some_have_width && part.diameters.is_empty() {
            all.diameters.extend(std::iter::repeat_n(f32::NAN, part.points.len()));
        }
        all.counts.extend(part.counts);
        all.points.extend(part.points);
        all.diameters.extend(part.diameters);
        if i > 0 {
            let mut rest = part.attributes;
            all.attributes.retain_mut(|a| {
                let of = |b: &Attribute| b.name == a.name && b.domain == a.domain;
                let Some(at) = rest.iter().position(of) else { return false };
                a.values.append(&rest.swap_remove(at).values)
            });
        }
    }
    all
}

/// Parts as one: hairs that were put into groups in the order of their numbers, if each has its own.
pub(super) fn joined_by_id(parts: Vec<Part>) -> Part {
    let several = parts.len() > 1;
    let all = joined(parts);
    let Some(ids) = all.whole(names::ID).filter(|_| several) else { return all };
    let mut rows: Vec<usize> = (0..ids.len()).collect();
    rows.sort_by_key(|&row| ids[row]);
    if rows.windows(2).any(|w| ids[w[0]] == ids[w[1]]) {
        return all;
    }
    all.picked(&rows)
}

impl Part {
    /// A whole number for each strand.
    fn whole(&self, name: &str) -> Option<&[u32]> {
        self.attributes.iter().find_map(|a| match (&a.values, a.domain) {
            (AttributeValues::U32(v), Domain::Strand) if a.name == name => Some(&v[..]),
            _ => None,
        })
    }
}

/// Turns the numbers of the guides that hairs follow into their indices. What names no guide has no weight.
pub(super) fn follow(hairs: &mut Part, guides: &Part) {
    if guides.counts.is_empty() {
        return;
    }
    let ids = guides.whole(names::ID);
    let mut order: Vec<usize> = (0..guides.counts.len()).collect();
    if let Some(ids) = ids {
        order.sort_by_key(|&row| ids[row]);
    }
    let index = |id: u32| match ids {
        Some(ids) => {
            order.binary_search_by_key(&id, |&row| ids[row]).ok().map(|at| order[at] as u32)
        }
        None => (id as usize).lt(&guides.counts.len()).then_some(id),
    };
    let mut missing = Vec::new();
    let at = |hairs: &Part, name: &str| hairs.attributes.iter().position(|a| a.name == name);
    if let Some(i) = at(hairs, names::CLOSEST_GUIDES)
        && let AttributeValues::U32x3(closest) = &mut hairs.attributes[i].values
    {
        for (row, three) in closest.iter_mut().enumerate() {
            for (k, id) in three.iter_mut().enumerate() {
                *id = index(*id).unwrap_or_else(|| {
                    missing.push((row, k));
                    0
                });
            }
        }
    }
    if let Some(i) = at(hairs, names::GUIDE_WEIGHTS)
        && let AttributeValues::F32x3(weights) = &mut hairs.attributes[i].values
    {
        missing.iter().for_each(|&(row, k)| weights[row][k] = 0.0);
    }
    if let Some(i) = at(hairs, names::GUIDE)
        && let AttributeValues::U32(guide) = &mut hairs.attributes[i].values
    {
        guide.iter_mut().for_each(|id| *id = index(*id).unwrap_or(0));
    }
}
