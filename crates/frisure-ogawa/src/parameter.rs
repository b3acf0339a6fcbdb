//! Numbers of a property, and geometry parameters of curves.

use super::read::{Archive, Kind, Property};

/// Values, whatever their width in the file.
#[derive(Clone, Debug, PartialEq)]
pub enum Numbers {
    /// Integers; those below 0 wrap round, as -1 is written for nothing.
    Whole(Vec<u32>),
    /// Real numbers.
    Real(Vec<f32>),
}

impl Numbers {
    fn len(&self) -> usize {
        match self {
            Self::Whole(v) => v.len(),
            Self::Real(v) => v.len(),
        }
    }
}

/// The scope of values (`geoScope`): one for each of these.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// The whole object.
    Constant,
    /// Each curve.
    Uniform,
    /// Each point.
    Varying,
}

/// A parameter of curves.
pub struct Parameter {
    /// Its scope.
    pub scope: Scope,
    /// How many numbers make one value.
    pub extent: usize,
    /// Its numbers, value after value.
    pub values: Numbers,
}

impl<'a> Archive<'a> {
    /// The numbers of a property, and how many make one; nothing where it has none or is text.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn numbers(&self, property: &Property<'a>) -> Result<Option<(usize, Numbers)>, String> {
        let Kind::Values { pod, extent, .. } = property.kind else { return Ok(None) };
        let bytes = self.sample(property)?;
        let whole = |values: Vec<u32>| Numbers::Whole(values);
        let values = match pod {
            0 | 1 => whole(bytes.iter().map(|&b| u32::from(b)).collect()),
            2 => whole(bytes.iter().map(|&b| i32::from(b as i8) as u32).collect()),
            3 => whole(words(bytes).map(|w| u32::from(u16::from_le_bytes(w))).collect()),
            4 => whole(words(bytes).map(|w| i32::from(i16::from_le_bytes(w)) as u32).collect()),
            5 | 6 => whole(words(bytes).map(u32::from_le_bytes).collect()),
            7 | 8 => whole(words(bytes).map(|w| u64::from_le_bytes(w) as u32).collect()),
            10 => Numbers::Real(words(bytes).map(f32::from_le_bytes).collect()),
            11 => Numbers::Real(words(bytes).map(|w| f64::from_le_bytes(w) as f32).collect()),
            _ => return Ok(None),
        };
        let extent = usize::from(extent).max(1);
        if values.len() % extent != 0 {
            let name = String::from_utf8_lossy(property.name);
            return Err(format!(
                "`{name}` has {} values, {extent} of which make one",
                values.len()
            ));
        }
        Ok(Some((extent, values)))
    }

    /// A geometry parameter of curves, with indices or without; nothing where it is of no kind that hair has.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn parameter(
        &self,
        property: &Property<'a>,
        curves: usize,
        points: usize,
    ) -> Result<Option<Parameter>, String> {
        let inner = self.parts(property)?;
        let named = |name: &str| inner.iter().find(|p| p.name == name.as_bytes());
        let source = named(".vals").unwrap_or(property);
        let Some((extent, mut values)) = self.numbers(source)? else { return Ok(None) };
        if extent > 3 || values.len() == 0 {
            return Ok(None);
        }
        if let Some(indices) = named(".indices")
            && let Some((1, Numbers::Whole(indices))) = self.numbers(indices)?
        {
            values = picked(&values, extent, &indices)?;
        }
        let count = values.len() / extent;
        let scope =
            scope(property.metadata("geoScope"), count, curves, points).ok_or_else(|| {
                let name = String::from_utf8_lossy(property.name);
                format!("`{name}` has {count} values for {curves} curves of {points} points")
            })?;
        Ok(Some(Parameter { scope, extent, values }))
    }
}

fn words<const N: usize>(bytes: &[u8]) -> impl Iterator<Item = [u8; N]> {
    bytes.as_chunks().0.iter().copied()
}

fn picked(values: &Numbers, extent: usize, indices: &[u32]) -> Result<Numbers, String> {
    fn of<T: Copy>(values: &[T], extent: usize, indices: &[u32]) -> Option<Vec<T>> {
        let mut out = Vec::with_capacity(extent * indices.len());
        for &i in indices {
            let start = extent.checked_mul(i as usize)?;
            out.extend_from_slice(values.get(start..start.checked_add(extent)?)?);
        }
        Some(out)
    }
    let found = match values {
        Numbers::Whole(v) => of(v, extent, indices).map(Numbers::Whole),
        Numbers::Real(v) => of(v, extent, indices).map(Numbers::Real),
    };
    found.ok_or_else(|| "an index leads beyond its values".into())
}

/// The scope of values: as stated, if their number fits it.
fn scope(said: Option<&[u8]>, count: usize, curves: usize, points: usize) -> Option<Scope> {
    let order = match said {
        Some(b"con") => [Scope::Constant, Scope::Uniform, Scope::Varying],
        Some(b"uni") => [Scope::Uniform, Scope::Varying, Scope::Constant],
        _ => [Scope::Varying, Scope::Uniform, Scope::Constant],
    };
    order.into_iter().find(|scope| {
        count
            == match scope {
                Scope::Constant => 1,
                Scope::Uniform => curves,
                Scope::Varying => points,
            }
    })
}
