//! One step of Catmull and Clark's subdivision of a mesh of quadrangles (1978, doi:10.1016/0010-4485(78)90110-0).

use std::collections::BTreeMap;
use std::ops::{Add, Mul};

/// A mesh of quadrangles with a value of any kind at each vertex.
pub(super) struct Quads<T> {
    pub(super) values: Vec<T>,
    pub(super) faces: Vec<[u32; 4]>,
}

/// Sum of what lies around a vertex.
#[derive(Clone, Copy)]
struct Around<T> {
    faces: T,
    face_count: f32,
    edges: T,
    edge_count: f32,
    rim: T,
    rim_count: f32,
}

impl<T: Copy + Default + Add<Output = T> + Mul<f32, Output = T>> Quads<T> {
    /// Four faces for each: vertices first, then the middles of edges, then those of faces. A rim stays a curve of its own.
    pub(super) fn subdivided(&self) -> Self {
        let middle = |face: &[u32; 4]| {
            face.iter().fold(T::default(), |sum, v| sum + self.values[*v as usize]) * 0.25
        };
        let centres: Vec<T> = self.faces.iter().map(middle).collect();
        // 1. Edges with the faces on their sides.
        let mut edges: BTreeMap<(u32, u32), (u32, Vec<usize>)> = BTreeMap::new();
        for (index, face) in self.faces.iter().enumerate() {
            for k in 0..4 {
                let (a, b) = (face[k], face[(k + 1) % 4]);
                let next = edges.len() as u32;
                edges.entry((a.min(b), a.max(b))).or_insert((next, Vec::new())).1.push(index);
            }
        }
        // 2. New points of edges, and sums around vertices.
        let zero = T::default();
        let none = Around {
            faces: zero,
            face_count: 0.0,
            edges: zero,
            edge_count: 0.0,
            rim: zero,
            rim_count: 0.0,
        };
        let mut around = vec![none; self.values.len()];
        let mut on_edges = vec![zero; edges.len()];
        for (&(a, b), (index, sides)) in &edges {
            let ends = [a, b].map(|v| self.values[v as usize]);
            let half = (ends[0] + ends[1]) * 0.5;
            let rim = sides.len() == 1;
            let centre = sides.iter().fold(zero, |sum, f| sum + centres[*f]);
            on_edges[*index as usize] =
                if rim { half } else { half * 0.5 + centre * (0.5 / sides.len() as f32) };
            for v in [a, b] {
                let at = &mut around[v as usize];
                (at.edges, at.edge_count) = (at.edges + half, at.edge_count + 1.0);
                if rim {
                    (at.rim, at.rim_count) = (at.rim + half, at.rim_count + 1.0);
                }
            }
        }
        for (face, centre) in self.faces.iter().zip(&centres) {
            for v in face {
                let at = &mut around[*v as usize];
                (at.faces, at.face_count) = (at.faces + *centre, at.face_count + 1.0);
            }
        }
        // 3. New points of vertices: (F + 2R + (n − 3)P)/n, on a rim (R + P)/2.
        let moved = self.values.iter().zip(&around).map(|(p, at)| {
            if at.rim_count > 0.0 {
                return *p * 0.5 + at.rim * (0.5 / at.rim_count);
            }
            let n = at.face_count.max(1.0);
            let (f, r) = (at.faces * (1.0 / n), at.edges * (1.0 / at.edge_count.max(1.0)));
            (f + r * 2.0 + *p * (n - 3.0)) * (1.0 / n)
        });
        let mut values: Vec<T> = moved.collect();
        let first_edge = values.len() as u32;
        values.extend(on_edges);
        let first_face = values.len() as u32;
        values.extend(centres);
        // 4. A quadrangle at each corner of each face.
        let edge = |a: u32, b: u32| first_edge + edges[&(a.min(b), a.max(b))].0;
        let mut faces = Vec::with_capacity(4 * self.faces.len());
        for (index, face) in self.faces.iter().enumerate() {
            for k in 0..4 {
                let (before, here, after) = (face[(k + 3) % 4], face[k], face[(k + 1) % 4]);
                faces.push([
                    here,
                    edge(here, after),
                    first_face + index as u32,
                    edge(before, here),
                ]);
            }
        }
        Self { values, faces }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_of_four_faces_stays_plane_and_its_rim_keeps_its_middle() {
        let values: Vec<f32> = vec![0.0, 1.0, 2.0, 0.0, 1.0, 2.0, 0.0, 1.0, 2.0];
        let faces = vec![[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6], [4, 5, 8, 7]];
        let fine = Quads { values, faces }.subdivided();
        assert_eq!((fine.values.len(), fine.faces.len()), (25, 16));
        // A linear function stays one in the middle, and each edge of an inner face is shared.
        assert!((fine.values[4] - 1.0).abs() < 1e-6);
        assert!(fine.values.iter().all(|v| (-1e-6..=2.0 + 1e-6).contains(v)));
    }
}
