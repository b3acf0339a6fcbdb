//! Values on curves: constant, for each curve, for each vertex, and between.

use frisure_strands::{Attribute, Domain};
use glam::{DMat4, DVec3, Vec3};

use super::super::attributes::{COLOUR, real_values, turn_directions, whole_values};
use super::basis::{Tap, Taps};
use super::names::{IS_GUIDE, OURS, PIGMENTS, PRIMVARS};
use frisure_files::frame::Frame;
use frisure_usd::{self as usd, Data, StagePrim, Value, ValueType};

/// Attributes that have no name inside, at most: a constant is small in a file, and one value for each strand
/// here.
const MOST_OWN: usize = 32;

/// The interpolation of values: one for each of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Per {
    Prim,
    Curve,
    Vertex,
    Varying,
}

impl Per {
    fn of(attribute: &usd::Attribute, usual: Self) -> Self {
        match attribute.meta("interpolation").and_then(Value::word) {
            Some("constant") => Self::Prim,
            Some("uniform") => Self::Curve,
            Some("vertex") => Self::Vertex,
            Some("varying" | "faceVarying") => Self::Varying,
            _ => usual,
        }
    }

    fn domain(self) -> Domain {
        match self {
            Self::Prim | Self::Curve => Domain::Strand,
            Self::Vertex | Self::Varying => Domain::Point,
        }
    }
}

/// An attribute of a prim, without indices, of the right number.
pub(super) struct Given {
    pub(super) per: Per,
    /// How many numbers make one value.
    width: usize,
    data: Data,
}

/// Reads an attribute of curves; none where it is not there or has no value.
pub(super) fn given(
    place: &StagePrim,
    name: &str,
    usual: Per,
    taps: &Taps,
) -> Result<Option<Given>, String> {
    let Some(attribute) = place.prim.attribute(name) else { return Ok(None) };
    let Some(value) = &attribute.value else { return Ok(None) };
    let several = attribute.meta("elementSize").and_then(Value::number).unwrap_or(1.0);
    let several = [1, 2, 3].into_iter().find(|&n| f64::from(n) == several);
    let Some(several) = several else { return Ok(None) };
    let width = value.ty.width() * several as usize;
    let data = place.prim.resolved(attribute, value, width)?;
    let found = data.len() / width;
    let mut per = Per::of(attribute, usual);
    // Single widths are often given without a word.
    if found == 1 && attribute.meta("interpolation").is_none() {
        per = Per::Prim;
    }
    let expected = match per {
        Per::Prim => 1,
        Per::Curve => taps.counts.len(),
        Per::Vertex => taps.vertices,
        Per::Varying => taps.varying,
    };
    if found == expected && data.len() == expected * width {
        return Ok(Some(Given { per, width, data }));
    }
    Err(format!("`{name}` has {found} values where {expected} are needed"))
}

impl Given {
    /// Refuses values of several numbers each, as of `float3[]` or with an `elementSize`.
    pub(super) fn of_single_numbers(self, name: &str) -> Result<Self, String> {
        if self.width == 1 {
            return Ok(self);
        }
        Err(format!("each value of `{name}` has {} numbers where 1 is needed", self.width))
    }

    /// The only value, of a constant.
    pub(super) fn constant(&self) -> Option<Vec<f32>> {
        if self.per == Per::Prim { floats(&self.data) } else { None }
    }

    /// Numbers at the points of all curves.
    pub(super) fn at_points(&self, taps: &Taps) -> Option<Vec<f32>> {
        let values = floats(&self.data)?;
        if self.per.domain() == Domain::Point {
            return Some(self.spread(&values, taps));
        }
        let of_curves = self.spread(&values, taps);
        let each = taps.counts.iter().zip(of_curves.chunks_exact(self.width));
        Some(each.flat_map(|(&n, value)| value.repeat(n)).collect())
    }

    /// Floats for each curve or for each point.
    fn spread(&self, values: &[f32], taps: &Taps) -> Vec<f32> {
        let width = self.width;
        let component = |of: &dyn Fn(usize) -> f32| (0..width).map(of).collect::<Vec<_>>();
        match self.per {
            Per::Prim => values.repeat(taps.counts.len()),
            Per::Curve => values.to_vec(),
            Per::Vertex => {
                let mut all = Vec::with_capacity(taps.taps.len() * width);
                for tap in &taps.taps {
                    for c in 0..width {
                        all.push(mixed(tap, |i| values[i as usize * width + c]));
                    }
                }
                all
            }
            Per::Varying => {
                let at = |tap: &Tap| {
                    let [a, b] = tap.varying.map(|i| i as usize * width);
                    component(&|c| values[a + c] + (values[b + c] - values[a + c]) * tap.part)
                };
                taps.taps.iter().flat_map(at).collect()
            }
        }
    }

    /// Whole numbers for each curve or for each point, from the nearest.
    fn integers(&self, taps: &Taps) -> Option<Vec<u32>> {
        let values: Vec<u32> = match &self.data {
            Data::I32(v) => v.iter().map(|x| x.cast_unsigned()).collect(),
            Data::I64(v) => v.iter().map(|&x| x as u32).collect(),
            _ => return None,
        };
        let of = |i: u32| &values[i as usize * self.width..(i as usize + 1) * self.width];
        Some(match self.per {
            Per::Prim => values.repeat(taps.counts.len()),
            Per::Curve => values,
            Per::Vertex => taps.taps.iter().flat_map(|t| of(t.nearest())).copied().collect(),
            Per::Varying => {
                let nearest = |t: &Tap| t.varying[usize::from(t.part >= 0.5)];
                taps.taps.iter().flat_map(|t| of(nearest(t))).copied().collect()
            }
        })
    }

    /// As an attribute of strands, if strands have attributes of this type.
    fn attribute(&self, name: &str, taps: &Taps) -> Option<Attribute> {
        let values = match self.integers(taps) {
            Some(whole) => whole_values(whole, self.width)?,
            None => real_values(self.spread(&floats(&self.data)?, taps), self.width)?,
        };
        Some(Attribute { name: name.into(), domain: self.per.domain(), values })
    }
}

/// The weighted sum of values at vertices; exact where the point is a vertex.
pub(super) fn mixed(tap: &Tap, value: impl Fn(u32) -> f32) -> f32 {
    if tap.weights[0] == 1.0 {
        return value(tap.vertices[0]);
    }
    (0..4).map(|k| tap.weights[k] * value(tap.vertices[k])).sum()
}

fn floats(data: &Data) -> Option<Vec<f32>> {
    match data {
        Data::F32(v) => Some(v.clone()),
        Data::F64(v) => Some(v.iter().map(|&x| x as f32).collect()),
        _ => None,
    }
}

/// All attributes of curves that have a name inside.
pub(super) fn attributes(
    place: &StagePrim,
    taps: &Taps,
    frame: Frame,
) -> Result<Vec<Attribute>, String> {
    let mut found: Vec<Attribute> = Vec::new();
    let mut add = |name: &str, primvar: &str, ty: Option<ValueType>| -> Result<(), String> {
        if found.iter().any(|a| a.name == name) {
            return Ok(());
        }
        let Some(given) = given(place, primvar, Per::Prim, taps)? else { return Ok(()) };
        // One colour for all is the hair's, not a hair's.
        if given.per == Per::Prim && name == COLOUR {
            return Ok(());
        }
        let fits = ty.is_none_or(|ty| {
            let whole = matches!(Data::empty(ty.scalar), Data::I32(_));
            ty.width() == given.width && whole == floats(&given.data).is_none()
        });
        found.extend(given.attribute(name, taps).filter(|_| fits));
        Ok(())
    };
    let mut own = 0;
    // In the order of the file, so that a groom goes round unchanged.
    for attribute in &place.prim.attributes {
        let primvar = attribute.name.as_str();
        if let Some((name, _, ty)) = PRIMVARS.iter().find(|(_, p, _)| *p == primvar) {
            // Of several of one name the first of the table.
            let others = PRIMVARS.iter().filter(|(n, ..)| n == name);
            let first = others.map(|(_, p, _)| *p).find(|p| place.prim.value(p).is_some());
            if first == Some(primvar) {
                add(name, primvar, ValueType::of(ty).map(|(ty, _)| ty))?;
            }
        } else if let Some(name) = primvar.strip_prefix(OURS).filter(|name| !name.contains(':'))
            && !PIGMENTS.contains(&primvar)
        {
            own += 1;
            if own > MOST_OWN {
                return Err(format!("it has more than {MOST_OWN} attributes `{OURS}…`"));
            }
            add(name, primvar, None)?;
        }
    }
    for attribute in &mut found {
        turn_directions(attribute, |d| frame.direction_from_file(turned(d, &place.world)));
    }
    Ok(found)
}

/// A direction of a prim in the axes of the stage.
fn turned(direction: Vec3, world: &DMat4) -> Vec3 {
    if *world == DMat4::IDENTITY {
        return direction;
    }
    world.transform_vector3(direction.as_dvec3()).try_normalize().unwrap_or(DVec3::ZERO).as_vec3()
}

/// Whether each curve is a guide; none where nothing is said.
pub(super) fn guides(place: &StagePrim, taps: &Taps) -> Result<Option<Vec<bool>>, String> {
    let Some(given) = given(place, IS_GUIDE, Per::Prim, taps)? else { return Ok(None) };
    if given.per.domain() != Domain::Strand {
        return Ok(None);
    }
    let given = given.of_single_numbers(IS_GUIDE)?;
    let all = given.integers(taps);
    Ok(all.map(|all| all.iter().map(|&x| x != 0).collect()))
}
