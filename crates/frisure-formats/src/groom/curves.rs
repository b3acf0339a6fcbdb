//! Curves as a file has them: picked, and several as one.

use frisure_strands::{Attribute, Domain};

/// Curves as a file has them.
#[derive(Clone, Debug, Default)]
pub(super) struct Curves {
    /// How many points each strand has.
    pub(super) counts: Vec<usize>,
    /// Points in the unit and axes of the file, one strand after another.
    pub(super) points: Vec<[f32; 3]>,
    /// Diameters at the points in the unit of the file; empty where it has none.
    pub(super) diameters: Vec<f32>,
    /// Further values of strands and points.
    pub(super) attributes: Vec<Attribute>,
}

impl Curves {
    /// The first point of each curve.
    pub(super) fn starts(&self) -> Vec<usize> {
        let mut end = 0;
        let start = |n: &usize| {
            end += n;
            end - n
        };
        self.counts.iter().map(start).collect()
    }

    /// Some of the curves, in an order.
    pub(super) fn picked(&self, rows: &[usize]) -> Self {
        let starts = self.starts();
        let points = || rows.iter().flat_map(|&r| starts[r]..starts[r] + self.counts[r]);
        let attribute = |a: &Attribute| {
            let values = match a.domain {
                Domain::Strand => a.values.picked(rows.iter().copied()),
                Domain::Point => a.values.picked(points()),
            };
            Attribute { values, ..a.clone() }
        };
        let diameters = if self.diameters.is_empty() {
            Vec::new()
        } else {
            points().map(|i| self.diameters[i]).collect()
        };
        Self {
            counts: rows.iter().map(|&r| self.counts[r]).collect(),
            points: points().map(|i| self.points[i]).collect(),
            diameters,
            attributes: self.attributes.iter().map(attribute).collect(),
        }
    }

    /// Several as one, with the attributes that all of them have. Where only some have diameters, the others get
    /// `usual`.
    pub(super) fn joined(parts: impl IntoIterator<Item = Self>, usual: f32) -> Self {
        let mut parts = parts.into_iter();
        let mut all = parts.next().unwrap_or_default();
        for mut part in parts {
            if all.diameters.is_empty() != part.diameters.is_empty() {
                all.fill_diameters(usual);
                part.fill_diameters(usual);
            }
            all.counts.extend(part.counts);
            all.points.extend(part.points);
            all.diameters.extend(part.diameters);
            all.attributes.retain_mut(|a| {
                let other = part.attributes.iter().find(|b| b.name == a.name);
                other.is_some_and(|b| b.domain == a.domain && a.values.append(&b.values))
            });
        }
        all
    }

    fn fill_diameters(&mut self, usual: f32) {
        if self.diameters.is_empty() {
            self.diameters = vec![usual; self.points.len()];
        }
    }
}
