//! The curves of one object, and several of them as one.

use frisure_strands::{Attribute, AttributeValues, Domain};

use super::super::attributes as names;
use super::curves::Stencil;
use crate::groom::checked::USUAL_RADIUS;
use crate::groom::curves::Curves;
use frisure_files::frame::Frame;
use frisure_ogawa::parameter::Scope;

/// The curves of one object, with directions in the axes of the file.
#[derive(Clone, Debug, Default)]
pub(super) struct Part {
    pub(super) curves: Curves,
    /// The one colour of all.
    pub(super) colour: Option<[f32; 3]>,
}

impl Part {
    /// Values of a scope as one for each point.
    pub(super) fn per_point(&self, scope: Scope, values: &[f32]) -> Vec<f32> {
        match scope {
            Scope::Constant => vec![values[0]; self.curves.points.len()],
            Scope::Uniform => {
                let each = self.curves.counts.iter().zip(values);
                each.flat_map(|(&n, &v)| std::iter::repeat_n(v, n)).collect()
            }
            Scope::Varying => values.to_vec(),
        }
    }

    /// Some of the curves, in an order.
    pub(super) fn picked(&self, rows: &[usize]) -> Self {
        Self { curves: self.curves.picked(rows), colour: self.colour }
    }

    /// The points on its curves, where these are control points.
    pub(super) fn evaluated(&self, stencils: &[Vec<Stencil>]) -> Self {
        let Curves { points, diameters, attributes, .. } = &self.curves;
        let starts = self.curves.starts();
        let places: Vec<(usize, Stencil)> = stencils
            .iter()
            .zip(&starts)
            .flat_map(|(s, &start)| s.iter().map(move |s| (start + s.from, *s)))
            .collect();
        let attribute = |a: &Attribute| match a.domain {
            Domain::Strand => a.clone(),
            Domain::Point => Attribute { values: mixed_values(&a.values, &places), ..a.clone() },
        };
        let diameter = |place| mixed_of(|i| [diameters[i]], place)[0];
        let curves = Curves {
            counts: stencils.iter().map(Vec::len).collect(),
            points: places.iter().map(|place| mixed(points, place)).collect(),
            diameters: if diameters.is_empty() {
                Vec::new()
            } else {
                places.iter().map(diameter).collect()
            },
            attributes: attributes.iter().map(attribute).collect(),
        };
        Self { curves, colour: self.colour }
    }
}

/// Diameter of what has no width, in the unit of the file.
pub(super) fn usual_diameter(frame: Frame) -> f32 {
    (2.0 * f64::from(USUAL_RADIUS) / frame.metres) as f32
}

/// The curves with directions in our axes, and a diameter for what has none.
pub(super) fn finished(mut curves: Curves, frame: Frame) -> Curves {
    for attribute in &mut curves.attributes {
        names::turn_directions(attribute, |d| frame.direction_from_file(d));
    }
    let usual = usual_diameter(frame);
    curves.diameters.iter_mut().filter(|d| d.is_nan()).for_each(|d| *d = usual);
    curves
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
    let places = places.iter();
    match values {
        AttributeValues::U32(_) | AttributeValues::U32x3(_) => values.picked(places.map(heaviest)),
        AttributeValues::F32(v) => {
            AttributeValues::F32(places.map(|p| mixed_of(|i| [v[i]], p)[0]).collect())
        }
        AttributeValues::F32x2(v) => AttributeValues::F32x2(places.map(|p| mixed(v, p)).collect()),
        AttributeValues::F32x3(v) => AttributeValues::F32x3(places.map(|p| mixed(v, p)).collect()),
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
            && part.curves.attributes.iter().all(|a| a.name != names::COLOUR)
        {
            let values = AttributeValues::F32x3(vec![colour; part.curves.counts.len()]);
            let name = names::COLOUR.into();
            part.curves.attributes.push(Attribute { name, domain: Domain::Strand, values });
        }
    }
    None
}

/// Parts as one: hairs that were put into groups in the order of their numbers, if each has its own.
pub(super) fn joined_by_id(parts: Vec<Part>, usual: f32) -> Curves {
    let several = parts.len() > 1;
    let all = Curves::joined(parts.into_iter().map(|part| part.curves), usual);
    let Some(ids) = whole(&all, names::ID).filter(|_| several) else { return all };
    let mut rows: Vec<usize> = (0..ids.len()).collect();
    rows.sort_by_key(|&row| ids[row]);
    if rows.windows(2).any(|w| ids[w[0]] == ids[w[1]]) {
        return all;
    }
    all.picked(&rows)
}

/// A whole number for each strand.
fn whole<'a>(curves: &'a Curves, name: &str) -> Option<&'a [u32]> {
    curves.attributes.iter().find_map(|a| match (&a.values, a.domain) {
        (AttributeValues::U32(v), Domain::Strand) if a.name == name => Some(&v[..]),
        _ => None,
    })
}

/// Turns the numbers of the guides that hairs follow into their indices. What names no guide has no weight.
pub(super) fn follow(hairs: &mut Curves, guides: &Curves) {
    if guides.counts.is_empty() {
        return;
    }
    let ids = whole(guides, names::ID);
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
    let at = |hairs: &Curves, name: &str| hairs.attributes.iter().position(|a| a.name == name);
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
