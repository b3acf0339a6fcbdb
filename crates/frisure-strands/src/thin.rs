//! Fewer strands that cover as much: a choice spread evenly over the roots, and wider.

use std::collections::BinaryHeap;

use glam::Vec3;

use crate::near::Near;
use crate::strands::{Attribute, Domain, Strands};

/// Neighbours whose distance gives the density of roots around one. Chosen.
const NEIGHBOURS: usize = 8;

/// Exponent of the weight of a neighbour, as published.
const EXPONENT: i32 = 8;

/// Fewer strands in the place of many.
#[derive(Clone, Debug, PartialEq)]
pub struct Thinned {
    /// The strands that are left, wider, with their attributes.
    pub strands: Strands,
    /// Their places among those before, rising.
    pub rows: Vec<usize>,
    /// Factor on their widths.
    pub widening: f32,
}

impl Strands {
    /// Some of the strands, in the order of `rows`, with their attributes.
    ///
    /// # Panics
    /// If a row is not less than [`Self::len`].
    #[must_use]
    pub fn picked(&self, rows: &[usize]) -> Self {
        let points = rows.iter().map(|&i| self.strand(i).points.len()).sum();
        let mut strands = Self::with_capacity(rows.len(), points);
        for &i in rows {
            let strand = self.strand(i);
            strands.push(strand.points, strand.radii);
        }
        let places = || rows.iter().flat_map(|&i| self.offsets()[i]..self.offsets()[i + 1]);
        for attribute in self.attributes() {
            let values = match attribute.domain {
                Domain::Strand => attribute.values.picked(rows.iter().copied()),
                Domain::Point => attribute.values.picked(places().map(|i| i as usize)),
            };
            let attribute = Attribute { values, ..attribute.clone() };
            strands.set_attribute(attribute).expect("the attributes fitted all strands");
        }
        strands
    }

    /// At most `count` of the strands, spread over the roots, and so much wider that they cover as much as all did.
    ///
    /// Strands are taken out one after another, always the one with the nearest neighbours (weighted sample elimination,
    /// [Yuksel 2015], "Sample Elimination for Generating Poisson Disk Sample Sets", with a radius for each root from the
    /// density around it): where roots are twice as dense before, they are twice as dense after. Strands without length
    /// cover nothing and are not chosen.
    ///
    /// All widths are multiplied by the area of all strands (the sum of length times width) over that of the chosen ones.
    /// With the same area of hair before a picture's pixel the part that it covers is the same on average, `1 − exp(−area)`
    /// for hairs at random places.
    #[must_use]
    pub fn thinned(&self, count: usize) -> Thinned {
        let areas: Vec<f64> = (0..self.len()).map(|i| self.area(i)).collect();
        let long: Vec<usize> = (0..self.len()).filter(|&i| areas[i] > 0.0).collect();
        let roots: Vec<Vec3> = long.iter().map(|&i| self.strand(i).points[0]).collect();
        let rows: Vec<usize> = chosen(&roots, count).iter().map(|&i| long[i]).collect();
        let (all, kept): (f64, f64) = (areas.iter().sum(), rows.iter().map(|&i| areas[i]).sum());
        let widening = if kept > 0.0 { (all / kept) as f32 } else { 1.0 };
        Thinned { strands: self.picked(&rows).widened(widening), rows, widening }
    }

    /// The strands with all widths times a factor.
    #[must_use]
    pub fn widened(mut self, factor: f32) -> Self {
        self.scale_radii(factor);
        self
    }

    /// Length times width of a strand (m²).
    fn area(&self, index: usize) -> f64 {
        let strand = self.strand(index);
        let pieces = strand.points.windows(2).zip(strand.radii.windows(2));
        pieces.map(|(p, r)| f64::from(p[0].distance(p[1])) * f64::from(r[0] + r[1])).sum()
    }
}

/// `count` of the roots, in rising order.
fn chosen(roots: &[Vec3], count: usize) -> Vec<usize> {
    let mut rows: Vec<usize> = (0..roots.len()).collect();
    // By halves: then each root has few neighbours that matter.
    while rows.len() > count {
        let target = count.max(rows.len() / 2);
        let places: Vec<Vec3> = rows.iter().map(|&i| roots[i]).collect();
        let kept = eliminated(&places, target);
        rows = kept.iter().map(|&i| rows[i]).collect();
    }
    rows
}

/// The places without those that have the nearest neighbours, down to `target`, at least half of them.
fn eliminated(places: &[Vec3], target: usize) -> Vec<usize> {
    let Some(near) = Near::new(places) else {
        // All in one place.
        return (0..target).map(|i| i * places.len() / target).collect();
    };
    // The radius at which `target` discs of the density here would touch in a hexagonal pattern.
    let left = places.len() as f32 / target.max(1) as f32;
    let radius = |i: usize| (near.area(i, NEIGHBOURS) * left / 12.0_f32.sqrt()).sqrt();
    let radii: Vec<f32> = (0..places.len()).map(radius).collect();
    let mut pairs: Vec<Vec<(u32, f32)>> = Vec::with_capacity(places.len());
    for i in 0..places.len() {
        let mut own = Vec::new();
        near.within(places[i], 2.0 * radii[i], |j, distance| {
            let reach = 2.0 * radii[i].min(radii[j]);
            if j != i && distance < reach {
                own.push((j as u32, (1.0 - distance / reach).powi(EXPONENT)));
            }
        });
        pairs.push(own);
    }
    let mut weights: Vec<f32> = pairs.iter().map(|own| own.iter().map(|(_, w)| w).sum()).collect();
    // Of equal weights the last goes first. Positive numbers have the order of their bits.
    let entry = |i: usize, weight: f32| (weight.max(0.0).to_bits(), i);
    let mut heap: BinaryHeap<(u32, usize)> =
        weights.iter().enumerate().map(|(i, w)| entry(i, *w)).collect();
    let mut stays = vec![true; places.len()];
    let mut left = places.len();
    while left > target {
        let Some((bits, i)) = heap.pop() else { break };
        // Weights change while they wait: an old one is no longer true.
        if !stays[i] || bits != entry(i, weights[i]).0 {
            continue;
        }
        stays[i] = false;
        left -= 1;
        for &(j, weight) in &pairs[i] {
            let j = j as usize;
            weights[j] -= weight;
            if stays[j] {
                heap.push(entry(j, weights[j]));
            }
        }
    }
    (0..places.len()).filter(|&i| stays[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strands::AttributeValues;

    /// Roots on a disc in the order of Vogel's spiral, whose density is `dense` times higher on one half.
    fn field(count: usize, dense: usize) -> Strands {
        let mut strands = Strands::new();
        for i in 0..count * dense {
            let turn = 2.399_963 * i as f32;
            let r = 0.1 * ((i as f32 + 0.5) / (count * dense) as f32).sqrt();
            let root = Vec3::new(r * turn.cos(), r * turn.sin(), 0.0);
            if root.x > 0.0 || i % dense == 0 {
                let length = 0.05 + 0.05 * (0.7 * i as f32).sin().abs();
                strands.push(&[root, root + length * Vec3::Z], &[4e-5, 2e-5]);
            }
        }
        strands
    }

    fn nearest(strands: &Strands) -> f32 {
        let roots: Vec<Vec3> = strands.iter().map(|s| s.points[0]).collect();
        let near = |i: usize| {
            let others = (0..roots.len()).filter(|j| *j != i);
            others.map(|j| roots[i].distance(roots[j])).fold(f32::INFINITY, f32::min)
        };
        (0..roots.len()).map(near).fold(f32::INFINITY, f32::min)
    }

    #[test]
    fn fewer_strands_cover_the_same_area() {
        let all = field(2000, 1);
        let area = |s: &Strands| (0..s.len()).map(|i| s.area(i)).sum::<f64>();
        for count in [1, 7, 200, 1999, 2000] {
            let thinned = all.thinned(count);
            assert_eq!((thinned.strands.len(), thinned.rows.len()), (count, count));
            assert!((area(&thinned.strands) / area(&all) - 1.0).abs() < 1e-5);
        }
        assert_eq!(all.thinned(2000).strands, all);
    }

    #[test]
    fn chosen_roots_keep_their_distance() {
        // In a hexagonal pattern of 200 in this disc neighbours are 13.5 mm apart; at random the nearest pair is below 1 mm.
        let kept = field(2000, 1).thinned(200).strands;
        assert!(nearest(&kept) > 7.5e-3, "{}", nearest(&kept));
    }

    #[test]
    fn dense_hair_stays_dense() {
        let all = field(2000, 4);
        let right = |s: &Strands| s.iter().filter(|s| s.points[0].x > 0.0).count() as f64;
        let before = right(&all) / all.len() as f64;
        let thinned = all.thinned(400).strands;
        let after = right(&thinned) / 400.0;
        // At random the deviation would be 0.02; the subset of the spiral on the left has pairs that are nearer than others.
        assert!((before - after).abs() < 0.05, "{before} {after}");
    }

    #[test]
    fn attributes_go_with_their_strands() {
        let mut all = field(50, 1);
        let values = AttributeValues::U32((0..50).collect());
        all.set_attribute(Attribute { name: "id".into(), domain: Domain::Strand, values }).unwrap();
        let Thinned { strands, rows, .. } = all.thinned(9);
        let ids = rows.iter().map(|&i| i as u32).collect();
        assert_eq!(strands.attribute("id").map(|a| &a.values), Some(&AttributeValues::U32(ids)));
        assert!(rows.is_sorted());
    }

    #[test]
    fn strands_without_length_are_not_chosen() {
        let mut strands = Strands::new();
        for i in 0..10 {
            let root = Vec3::new(i as f32, 0.0, 0.0);
            let length = if i % 2 == 0 { 0.0 } else { 0.1 };
            strands.push(&[root, root + Vec3::Z * length], &[1e-5; 2]);
        }
        assert_eq!(strands.thinned(9).rows, [1, 3, 5, 7, 9]);
        assert_eq!(strands.thinned(5).widening, 1.0);
        assert_eq!(Strands::new().thinned(3).rows, [0; 0]);
    }

    #[test]
    fn roots_in_one_place_are_no_trouble() {
        let mut strands = Strands::new();
        for i in 0..100 {
            let tip = Vec3::new((i as f32).cos(), (i as f32).sin(), 0.0);
            strands.push(&[Vec3::ZERO, 0.1 * tip], &[1e-5; 2]);
        }
        assert_eq!(strands.thinned(10).rows.len(), 10);
    }
}
