//! A groom's curves: flat arrays, one offset per strand.

use glam::Vec3;
use thiserror::Error;

/// Many polylines with a radius at each point, stored flat, with named attributes.
///
/// Strand `i` owns points `offset(i)..offset(i + 1)`; point 0 of a strand is its root.
///
/// ```
/// use frisure_strands::{Attribute, AttributeValues, Domain, Strands};
/// use glam::Vec3;
///
/// let mut strands = Strands::new();
/// for i in 0..3 {
///     // A hair of 70 µm that hangs 10 cm down (m).
///     let root = Vec3::X * 0.01 * i as f32;
///     strands.push(&[root, root - Vec3::Z * 0.1], &[35e-6; 2]);
/// }
/// assert_eq!((strands.len(), strands.points().len()), (3, 6));
/// assert_eq!(strands.strand(1).points[0], Vec3::new(0.01, 0.0, 0.0));
///
/// // One value per strand: the wisp that it belongs to.
/// let values = AttributeValues::U32(vec![7, 7, 8]);
/// strands.set_attribute(Attribute { name: "guide".into(), domain: Domain::Strand, values })?;
/// assert!(strands.attribute("guide").is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Strands {
    offsets: Vec<u32>,
    points: Vec<Vec3>,
    radii: Vec<f32>,
    attributes: Vec<Attribute>,
}

/// One strand, borrowed from [`Strands`].
#[derive(Clone, Copy, Debug)]
pub struct Strand<'a> {
    /// Points from root to tip (m).
    pub points: &'a [Vec3],
    /// Mean radius of the fibre at each point (m).
    pub radii: &'a [f32],
}

/// What an [`Attribute`] has one value for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Domain {
    /// One value per strand.
    Strand,
    /// One value per point.
    Point,
}

/// The values of an [`Attribute`].
#[derive(Clone, Debug, PartialEq)]
pub enum AttributeValues {
    /// Indices and identifiers.
    U32(Vec<u32>),
    /// Triples of indices.
    U32x3(Vec<[u32; 3]>),
    /// Scalars.
    F32(Vec<f32>),
    /// Pairs, such as texture coordinates.
    F32x2(Vec<[f32; 2]>),
    /// Triples, such as directions and colours.
    F32x3(Vec<[f32; 3]>),
}

impl AttributeValues {
    /// How many values there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::U32(v) => v.len(),
            Self::U32x3(v) => v.len(),
            Self::F32(v) => v.len(),
            Self::F32x2(v) => v.len(),
            Self::F32x3(v) => v.len(),
        }
    }

    /// Whether there is no value at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

impl AttributeValues {
    /// Appends values of the same kind; of another kind nothing is appended, and the answer is false.
    pub fn append(&mut self, more: &Self) -> bool {
        match (self, more) {
            (Self::U32(a), Self::U32(b)) => a.extend(b),
            (Self::U32x3(a), Self::U32x3(b)) => a.extend(b),
            (Self::F32(a), Self::F32(b)) => a.extend(b),
            (Self::F32x2(a), Self::F32x2(b)) => a.extend(b),
            (Self::F32x3(a), Self::F32x3(b)) => a.extend(b),
            _ => return false,
        }
        true
    }

    /// The values of some rows, in their order.
    #[must_use]
    pub fn picked(&self, rows: impl Iterator<Item = usize>) -> Self {
        match self {
            Self::U32(v) => Self::U32(rows.map(|i| v[i]).collect()),
            Self::U32x3(v) => Self::U32x3(rows.map(|i| v[i]).collect()),
            Self::F32(v) => Self::F32(rows.map(|i| v[i]).collect()),
            Self::F32x2(v) => Self::F32x2(rows.map(|i| v[i]).collect()),
            Self::F32x3(v) => Self::F32x3(rows.map(|i| v[i]).collect()),
        }
    }
}

/// A named array over the strands or over their points.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// Name, lower case with underscores (`guide`, `root_uv`, `d1`).
    pub name: String,
    /// What there is one value for.
    pub domain: Domain,
    /// The values, in the order of strands or of points.
    pub values: AttributeValues,
}

/// An attribute that does not fit the strands it is put on.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum AttributeError {
    /// The number of values is not the number of strands or points.
    #[error("attribute `{name}` has {found} values for {expected} {of}")]
    Count {
        /// Name of the attribute.
        name: String,
        /// Number of values given.
        found: usize,
        /// Number of strands or points.
        expected: usize,
        /// `strands` or `points`.
        of: &'static str,
    },
    /// There is already an attribute of that name.
    #[error("there is already an attribute `{name}`")]
    Duplicate {
        /// Name of the attribute.
        name: String,
    },
}

impl Default for Strands {
    fn default() -> Self {
        Self::new()
    }
}

impl Strands {
    /// Creates an empty set of strands.
    #[must_use]
    pub fn new() -> Self {
        Self::with_capacity(0, 0)
    }

    /// Creates an empty set with room for `strands` strands and `points` points in all.
    #[must_use]
    pub fn with_capacity(strands: usize, points: usize) -> Self {
        let mut offsets = Vec::with_capacity(strands + 1);
        offsets.push(0);
        Self {
            offsets,
            points: Vec::with_capacity(points),
            radii: Vec::with_capacity(points),
            attributes: Vec::new(),
        }
    }

    /// Appends a strand: points from root to tip (m) and a radius (m) for each.
    ///
    /// # Panics
    /// If the two slices differ in length, if there are more than `u32::MAX` points in all, or if
    /// attributes were set already (they would no longer fit).
    pub fn push(&mut self, points: &[Vec3], radii: &[f32]) {
        assert_eq!(points.len(), radii.len(), "one radius per point");
        assert!(self.attributes.is_empty(), "push strands before attributes");
        self.points.extend_from_slice(points);
        self.radii.extend_from_slice(radii);
        let end = u32::try_from(self.points.len()).expect("fewer than 2^32 points");
        self.offsets.push(end);
    }

    /// These strands and then others, which have the attributes of the first of these; the others' own attributes, and all
    /// attributes where there is no first, are left out.
    ///
    /// # Panics
    /// If there are more than `u32::MAX` points in all.
    #[must_use]
    pub fn followed_by(&self, others: &Self) -> Self {
        let mut both = self.clone();
        both.attributes.clear();
        for strand in others.iter() {
            both.push(strand.points, strand.radii);
        }
        if self.points.is_empty() {
            return both;
        }
        for attribute in &self.attributes {
            let count = match attribute.domain {
                Domain::Strand => others.len(),
                Domain::Point => others.points.len(),
            };
            let mut values = attribute.values.clone();
            values.append(&attribute.values.picked(std::iter::repeat_n(0, count)));
            both.attributes.push(Attribute { values, ..attribute.clone() });
        }
        both
    }

    /// Number of strands.
    #[must_use]
    pub fn len(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Whether there is no strand.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Points of all strands (m), one strand after another.
    #[must_use]
    pub fn points(&self) -> &[Vec3] {
        &self.points
    }

    /// Radii of all points (m), in the order of [`Self::points`].
    #[must_use]
    pub fn radii(&self) -> &[f32] {
        &self.radii
    }

    /// Multiplies all radii.
    pub(crate) fn scale_radii(&mut self, factor: f32) {
        self.radii.iter_mut().for_each(|radius| *radius *= factor);
    }

    /// Index of the first point of each strand, and the number of points at the end.
    #[must_use]
    pub fn offsets(&self) -> &[u32] {
        &self.offsets
    }

    /// Strand `index`.
    ///
    /// # Panics
    /// If `index` is not less than [`Self::len`].
    #[must_use]
    pub fn strand(&self, index: usize) -> Strand<'_> {
        let range = self.offsets[index] as usize..self.offsets[index + 1] as usize;
        Strand { points: &self.points[range.clone()], radii: &self.radii[range] }
    }

    /// The strands in order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Strand<'_>> {
        (0..self.len()).map(|i| self.strand(i))
    }

    /// Adds a named attribute.
    ///
    /// # Errors
    /// If the number of values does not fit, or the name is taken.
    pub fn set_attribute(&mut self, attribute: Attribute) -> Result<(), AttributeError> {
        let (expected, of) = match attribute.domain {
            Domain::Strand => (self.len(), "strands"),
            Domain::Point => (self.points.len(), "points"),
        };
        let (name, found) = (&attribute.name, attribute.values.len());
        if found != expected {
            return Err(AttributeError::Count { name: name.clone(), found, expected, of });
        }
        if self.attribute(name).is_some() {
            return Err(AttributeError::Duplicate { name: name.clone() });
        }
        self.attributes.push(attribute);
        Ok(())
    }

    /// The attribute of that name, if there is one.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.iter().find(|a| a.name == name)
    }

    /// All attributes, in the order in which they were set.
    #[must_use]
    pub fn attributes(&self) -> &[Attribute] {
        &self.attributes
    }

    /// The strands with only the attributes whose names `keep` accepts.
    #[must_use]
    pub fn with_attributes(mut self, keep: impl Fn(&str) -> bool) -> Self {
        self.attributes.retain(|attribute| keep(&attribute.name));
        self
    }

    /// Smallest and largest corner of the box around all points (m); `None` without points.
    #[must_use]
    pub fn bounds(&self) -> Option<(Vec3, Vec3)> {
        let first = *self.points.first()?;
        Some(self.points.iter().fold((first, first), |(lo, hi), &p| (lo.min(p), hi.max(p))))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_strands() -> Strands {
        let mut strands = Strands::new();
        strands.push(&[Vec3::ZERO, Vec3::X], &[1.0, 0.5]);
        strands.push(&[Vec3::Y, Vec3::Z, Vec3::ONE], &[1.0, 0.5, 0.25]);
        strands
    }

    #[test]
    fn strands_keep_their_points_apart() {
        let strands = two_strands();
        assert_eq!(strands.len(), 2);
        assert_eq!(strands.strand(1).points, &[Vec3::Y, Vec3::Z, Vec3::ONE]);
        assert_eq!(strands.iter().map(|s| s.points.len()).sum::<usize>(), 5);
        assert_eq!(strands.bounds(), Some((Vec3::ZERO, Vec3::ONE)));
    }

    #[test]
    fn strands_that_follow_others_have_the_attributes_of_the_first() {
        let (mut strands, others) = (two_strands(), two_strands());
        let values = AttributeValues::U32(vec![7, 8]);
        let guide = Attribute { name: "guide".into(), domain: Domain::Strand, values };
        strands.set_attribute(guide).unwrap();
        let both = strands.followed_by(&others);
        assert_eq!((both.len(), both.points().len()), (4, 10));
        let guides = &both.attribute("guide").unwrap().values;
        assert_eq!(*guides, AttributeValues::U32(vec![7, 8, 7, 7]));
        assert!(Strands::new().followed_by(&strands).attributes().is_empty());
    }

    #[test]
    fn attributes_must_fit() {
        let mut strands = two_strands();
        let guide = |n| Attribute {
            name: "guide".into(),
            domain: Domain::Strand,
            values: AttributeValues::U32(vec![0; n]),
        };
        assert!(matches!(strands.set_attribute(guide(3)), Err(AttributeError::Count { .. })));
        assert_eq!(strands.set_attribute(guide(2)), Ok(()));
        assert!(matches!(strands.set_attribute(guide(2)), Err(AttributeError::Duplicate { .. })));
    }
}
