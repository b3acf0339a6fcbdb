//! Strands with fewer points: those that the others miss most.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::Vec3;

use crate::resample::{Resampled, to_segment};
use crate::strands::{Attribute, Domain, Strands};

impl Strands {
    /// Each strand with at most `most` of its points, at least 2: root, tip and those that the line between the others
    /// would miss by most, taken one after another ([Douglas & Peucker 1973] to a number of points). The points that stay
    /// are where they were, with their attributes.
    #[must_use]
    pub fn simplified(&self, most: usize) -> Resampled {
        let mut strands = Self::with_capacity(self.len(), self.len() * most.min(64));
        let mut places = Vec::new();
        let (mut error, mut worst) = (0.0_f32, 0);
        let (mut line, mut radii) = (Vec::new(), Vec::new());
        for (index, strand) in self.iter().enumerate() {
            let (kept, apart) = important(strand.points, most.max(2));
            line.clear();
            radii.clear();
            line.extend(kept.iter().map(|&i| strand.points[i]));
            radii.extend(kept.iter().map(|&i| strand.radii[i]));
            strands.push(&line, &radii);
            let first = self.offsets()[index] as usize;
            places.extend(kept.iter().map(|i| first + i));
            if apart > error {
                (error, worst) = (apart, index);
            }
        }
        for attribute in self.attributes() {
            let values = match attribute.domain {
                Domain::Strand => attribute.values.clone(),
                Domain::Point => attribute.values.picked(places.iter().copied()),
            };
            let attribute = Attribute { values, ..attribute.clone() };
            strands.set_attribute(attribute).expect("the attributes fitted the old strands");
        }
        Resampled { strands, error, worst }
    }
}

/// The points that stay, rising, and the largest distance (m) of another from the line through them.
fn important(points: &[Vec3], most: usize) -> (Vec<usize>, f32) {
    if points.len() <= most {
        return ((0..points.len()).collect(), 0.0);
    }
    // Pieces by their error, the point that has it, and their ends; of equal errors the nearest to the root first.
    let mut pieces = BinaryHeap::new();
    let piece = |from: usize, to: usize| {
        let apart = |i: usize| to_segment(points[i], points[from], points[to]);
        let all = (from + 1..to).map(|i| (apart(i), i));
        let (error, at) =
            all.fold((0.0_f32, from), |best, next| if next.0 > best.0 { next } else { best });
        (error.to_bits(), Reverse(at), from, to)
    };
    pieces.push(piece(0, points.len() - 1));
    let mut kept = vec![0, points.len() - 1];
    while kept.len() < most {
        let Some(&(error, Reverse(at), from, to)) = pieces.peek() else { break };
        if error == 0 {
            break;
        }
        pieces.pop();
        kept.push(at);
        pieces.push(piece(from, at));
        pieces.push(piece(at, to));
    }
    kept.sort_unstable();
    (kept, pieces.peek().map_or(0.0, |p| f32::from_bits(p.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strands::AttributeValues;

    /// A hook: straight for most of its length, and half a circle at the tip.
    fn hook() -> Strands {
        let straight = (0..20).map(|i| Vec3::new(0.0, 0.0, -0.01 * i as f32));
        let round = (1..=12).map(|i| {
            let angle = std::f32::consts::PI * i as f32 / 12.0;
            Vec3::new(0.02 - 0.02 * angle.cos(), 0.0, -0.19 - 0.02 * angle.sin())
        });
        let line: Vec<Vec3> = straight.chain(round).collect();
        let mut strands = Strands::new();
        strands.push(&line, &vec![3e-5; line.len()]);
        strands
    }

    #[test]
    fn points_stay_where_the_hair_bends() {
        let all = hook();
        let few = all.simplified(8);
        let line = few.strands.strand(0).points;
        assert_eq!((line.len(), line[0], line[7]), (8, all.points()[0], all.points()[31]));
        assert!(line[1..].iter().all(|p| p.z < -0.18), "{line:?}");
        // No chord spans more than three of the twelve pieces of the semicircle: 0.02 (1 − cos 22.5°). Evenly spaced points
        // for comparison.
        assert!(few.error < 1.53e-3 && few.error < 0.3 * all.resampled(8).error, "{}", few.error);
    }

    #[test]
    fn the_error_is_the_largest_distance_of_a_point_left_out() {
        let all = hook();
        for most in 2..32 {
            let few = all.simplified(most);
            let line = few.strands.strand(0).points;
            let apart = |p: &Vec3| {
                let pieces = line.windows(2).map(|pair| to_segment(*p, pair[0], pair[1]));
                pieces.fold(f32::INFINITY, f32::min)
            };
            let largest = all.points().iter().map(apart).fold(0.0, f32::max);
            assert!(largest <= few.error + 1e-9, "{most}: {largest} {}", few.error);
            assert!(most > 2 || few.error > 0.01);
        }
        assert_eq!(all.simplified(32).error, 0.0);
    }

    #[test]
    fn attributes_go_with_the_points_that_stay() {
        let mut all = hook();
        let values = AttributeValues::U32((0..32).collect());
        all.set_attribute(Attribute { name: "n".into(), domain: Domain::Point, values }).unwrap();
        let few = all.simplified(5).strands;
        let Some(AttributeValues::U32(kept)) = few.attribute("n").map(|a| &a.values) else {
            panic!("n is there")
        };
        for (p, n) in few.points().iter().zip(kept) {
            assert_eq!(*p, all.points()[*n as usize]);
        }
    }

    #[test]
    fn straight_hair_needs_two_points_and_a_root_alone_stays() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::ZERO, Vec3::X, 2.0 * Vec3::X], &[1e-5; 3]);
        strands.push(&[Vec3::Y], &[1e-5]);
        strands.push(&[Vec3::Z; 4], &[1e-5; 4]);
        assert_eq!(strands.simplified(2).strands.offsets(), [0, 2, 3, 5]);
    }
}
