//! Strands of similar place and shape, together.

use frisure_strands::Strands;
use glam::Vec3;
use rayon::prelude::*;

/// Places that strands are compared at: the root, and the middles of as many sections of equal length.
const SHAPE: usize = 6;

/// Points of a strand in each section, whose mean is its middle: a single point says in which part of its turn a curl is there.
const EACH: usize = 8;

/// Weight of each of these points in the distance of two strands: hair that grows in one place stays together at its
/// root, where a card is fixed. Chosen.
const WEIGHTS: [f32; SHAPE] = [2.0, 1.0, 1.0, 1.0, 1.0, 1.0];

/// Rounds of assignment. More change few strands.
const ROUNDS: usize = 8;

type Shape = [Vec3; SHAPE];

/// Which strands are together.
pub(crate) struct Clusters {
    /// Rows of strands, rising, of each cluster. None is empty.
    pub(crate) members: Vec<Vec<usize>>,
}

impl Clusters {
    /// At most `count` clusters by k-means, from seeds spread over the roots.
    pub(crate) fn new(strands: &Strands, count: usize) -> Self {
        let shapes: Vec<Shape> = shapes(strands);
        let seeds = strands.thinned(count).rows;
        let weights = vec![1.0; shapes.len()];
        Self { members: together(&shapes, &weights, &seeds) }
    }

    /// At most `count` clusters, each of whole clusters of these.
    pub(crate) fn merged(&self, strands: &Strands, count: usize) -> Self {
        let all = shapes(strands);
        let shapes: Vec<Shape> =
            self.members.iter().map(|rows| mean(rows.iter().map(|&i| (1.0, &all[i])))).collect();
        let mut middles = Strands::new();
        shapes.iter().for_each(|shape| middles.push(shape, &[1e-4; SHAPE]));
        let weights: Vec<f32> = self.members.iter().map(|rows| rows.len() as f32).collect();
        let seeds = middles.thinned(count).rows;
        let merged = together(&shapes, &weights, &seeds);
        let members = |clusters: &Vec<usize>| {
            let mut rows: Vec<usize> =
                clusters.iter().flat_map(|&c| self.members[c].iter().copied()).collect();
            rows.sort_unstable();
            rows
        };
        Self { members: merged.iter().map(members).collect() }
    }
}

fn shapes(strands: &Strands) -> Vec<Shape> {
    const POINTS: usize = 1 + (SHAPE - 1) * EACH;
    let even = strands.resampled(POINTS).strands;
    let shape = |line: &[Vec3; POINTS]| {
        let section = |k: usize| &line[1 + (k - 1) * EACH..1 + k * EACH];
        std::array::from_fn(|k| match k {
            0 => line[0],
            k => section(k).iter().sum::<Vec3>() / EACH as f32,
        })
    };
    even.points().as_chunks::<POINTS>().0.iter().map(shape).collect()
}

fn mean<'a>(shapes: impl Iterator<Item = (f32, &'a Shape)>) -> Shape {
    let (mut sum, mut total) = ([Vec3::ZERO; SHAPE], 0.0);
    for (weight, shape) in shapes {
        (0..SHAPE).for_each(|k| sum[k] += weight * shape[k]);
        total += weight;
    }
    sum.map(|p| p / f32::max(total, f32::MIN_POSITIVE))
}

/// Rows that are nearest to the same mean (Lloyd's algorithm).
fn together(shapes: &[Shape], weights: &[f32], seeds: &[usize]) -> Vec<Vec<usize>> {
    let mut means: Vec<Shape> = seeds.iter().map(|&i| shapes[i]).collect();
    let mut members = Vec::new();
    for _ in 0..ROUNDS {
        let nearest: Vec<usize> =
            shapes.par_iter().map(|shape| nearest_of(shape, &means)).collect();
        members = vec![Vec::new(); means.len()];
        nearest.iter().enumerate().for_each(|(row, &cluster)| members[cluster].push(row));
        for (rows, middle) in members.iter().zip(&mut means) {
            if !rows.is_empty() {
                *middle = mean(rows.iter().map(|&i| (weights[i], &shapes[i])));
            }
        }
    }
    members.retain(|rows| !rows.is_empty());
    members
}

fn nearest_of(shape: &Shape, means: &[Shape]) -> usize {
    let (mut best, mut found) = (f32::INFINITY, 0);
    for (i, other) in means.iter().enumerate() {
        let mut distance = 0.0;
        for k in 0..SHAPE {
            distance += WEIGHTS[k] * shape[k].distance_squared(other[k]);
            if distance >= best {
                break;
            }
        }
        if distance < best {
            (best, found) = (distance, i);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Locks of hair on a row, each of some strands that bend the same way.
    fn locks(count: usize, each: usize) -> Strands {
        let mut strands = Strands::new();
        for i in 0..count * each {
            let (lock, within) = (i % count, (i / count) as f32);
            let root = Vec3::new(0.02 * lock as f32 + 0.0005 * within, 0.0, 0.0);
            let way = if lock % 2 == 0 { 0.02 } else { -0.02 };
            let line: Vec<Vec3> = (0..9)
                .map(|k| root + Vec3::new(0.0, way * k as f32 / 8.0, -0.01 * k as f32))
                .collect();
            strands.push(&line, &[4e-5; 9]);
        }
        strands
    }

    #[test]
    fn strands_of_a_lock_stay_together() {
        let clusters = Clusters::new(&locks(10, 7), 10);
        assert_eq!(clusters.members.len(), 10);
        for rows in &clusters.members {
            assert_eq!(rows.len(), 7);
            assert!(rows.iter().all(|row| row % 10 == rows[0] % 10));
        }
    }

    #[test]
    fn merging_keeps_clusters_whole_and_loses_no_strand() {
        let strands = locks(10, 7);
        let fine = Clusters::new(&strands, 10);
        let coarse = fine.merged(&strands, 3);
        assert!(coarse.members.len() <= 3);
        let mut all: Vec<usize> = coarse.members.concat();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..70));
        for rows in &fine.members {
            let whole = |other: &&Vec<usize>| rows.iter().all(|row| other.contains(row));
            assert_eq!(coarse.members.iter().filter(whole).count(), 1);
        }
    }
}
