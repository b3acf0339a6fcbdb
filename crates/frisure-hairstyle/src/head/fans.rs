//! A mesh whose sheets meet in vertices or edges, made a manifold: each sheet gets vertices of its own.
//!
//! Surface nets have one vertex in each cell, even where two sheets of the surface pass through it (Gibson 1998,
//! "Constrained elastic surface nets"); Nielson 2004, "Dual marching cubes", gives each sheet its own vertex. Here the
//! sheets are separated at the end, so that no triangle changes its place.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::DVec3;

/// A side of a triangle: the triangle, and the corner opposite the side.
type Side = (usize, usize);

/// Gives each fan of triangles around a vertex a vertex of its own, at the same position (m); the first fan keeps the old one.
///
/// The triangles are to be turned alike. Afterwards an edge has one triangle on each side, and a vertex one fan.
pub(super) fn part_sheets(positions: &mut Vec<DVec3>, triangles: &mut [[u32; 3]]) {
    let pairs = pairs(positions, triangles);
    // Corners of the triangles; those across a shared edge belong to one fan.
    let mut parent: Vec<u32> = (0..3 * triangles.len() as u32).collect();
    for ((t, i), (u, j)) in pairs {
        // The two triangles run along their common edge in opposite directions.
        for (a, b) in [((i + 1) % 3, (j + 2) % 3), ((i + 2) % 3, (j + 1) % 3)] {
            let (x, y) = ((3 * t + a) as u32, (3 * u + b) as u32);
            let (x, y) = (root(&mut parent, x), root(&mut parent, y));
            parent[x.max(y) as usize] = x.min(y);
        }
    }
    let old = positions.len();
    // The first fan of each old vertex, and the new vertex of each other fan.
    let mut first = vec![u32::MAX; old];
    let mut others = BTreeMap::new();
    for corner in 0..3 * triangles.len() {
        let fan = root(&mut parent, corner as u32);
        let vertex = &mut triangles[corner / 3][corner % 3];
        let kept = &mut first[*vertex as usize];
        if *kept == u32::MAX {
            *kept = fan;
        }
        if *kept != fan {
            let place = positions[*vertex as usize];
            *vertex = *others.entry(fan).or_insert_with(|| {
                positions.push(place);
                positions.len() as u32 - 1
            });
        }
    }
}

/// The sides that belong together, two for each edge of a sheet.
fn pairs(positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<(Side, Side)> {
    let sides = sides(positions.len(), triangles);
    let mut found = Vec::with_capacity(sides.len() / 2);
    for sides in sides.chunk_by(|x, y| x.0 == y.0) {
        // Mostly there is nothing to choose.
        if let [(_, false, back), (_, true, forth)] = sides {
            found.push((*forth, *back));
            continue;
        }
        let (a, b) = sides[0].0;
        let [a, b] = [a, b].map(|v| positions[v as usize]);
        let of = |way: bool| sides.iter().filter(move |s| s.1 == way).map(|s| s.2);
        let mut back: Vec<Side> = of(false).collect();
        for forth in of(true) {
            let opposite = |(t, i): Side| positions[triangles[t][i] as usize];
            // The triangle that bounds the same wedge of the inside: the next one around the edge, clockwise as
            // seen along it, because the normal of the first is on its other side.
            let angle = |side: &Side| turn(b - a, opposite(forth) - a, opposite(*side) - a);
            let nearest =
                (0..back.len()).min_by(|&x, &y| angle(&back[x]).total_cmp(&angle(&back[y])));
            found.extend(nearest.map(|k| (forth, back.swap_remove(k))));
        }
    }
    found
}

/// All sides of triangles by their ends, the lower of both first, and by whether they run from it.
fn sides(vertices: usize, triangles: &[[u32; 3]]) -> Vec<((u32, u32), bool, Side)> {
    let all = || {
        triangles.iter().enumerate().flat_map(|(t, corners)| {
            (0..3).map(move |i| {
                let (a, b) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
                ((a.min(b), a.max(b)), a < b, (t, i))
            })
        })
    };
    // Each into the part of its lower end, which is then short to sort.
    let mut starts = vec![0; vertices + 1];
    all().for_each(|((a, _), ..)| starts[a as usize + 1] += 1);
    for v in 0..vertices {
        starts[v + 1] += starts[v];
    }
    let mut sides = vec![((0, 0), false, (0, 0)); 3 * triangles.len()];
    let mut next = starts.clone();
    for side in all() {
        let at = &mut next[side.0.0 as usize];
        sides[*at] = side;
        *at += 1;
    }
    starts.windows(2).for_each(|ends| sides[ends[0]..ends[1]].sort_unstable());
    sides
}

/// The angle (rad, from 0 to 2π) about `axis` from the direction `to` forwards to `from`: how far `to` is behind.
fn turn(axis: DVec3, from: DVec3, to: DVec3) -> f64 {
    let axis = axis.normalize_or_zero();
    let (from, to) = (from.reject_from_normalized(axis), to.reject_from_normalized(axis));
    to.cross(from).dot(axis).atan2(to.dot(from)).rem_euclid(TAU)
}

/// The first element of a set; shortens the way there.
fn root(parent: &mut [u32], mut v: u32) -> u32 {
    while parent[v as usize] != v {
        parent[v as usize] = parent[parent[v as usize] as usize];
        v = parent[v as usize];
    }
    v
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::Head;

    /// Directed edges that are there twice or have no counterpart, and vertices with more than one fan.
    fn faults(count: usize, triangles: &[[u32; 3]]) -> (usize, usize) {
        let mut next = BTreeMap::new();
        let (mut edges, mut degree) = (0, vec![0_usize; count]);
        for &[a, b, c] in triangles {
            for (v, from, to) in [(a, b, c), (b, c, a), (c, a, b)] {
                edges += usize::from(next.insert((v, from), to).is_some());
                degree[v as usize] += 1;
            }
        }
        edges += next.iter().filter(|((v, _), to)| !next.contains_key(&(*v, **to))).count();
        // Around each vertex, from its first neighbour on: all of its triangles are met, or there are more fans.
        let mut vertices = 0;
        let mut at = u32::MAX;
        for &(v, start) in next.keys() {
            if v == at {
                continue;
            }
            at = v;
            let (mut now, mut met) = (start, 0);
            while let Some(&to) = next.get(&(v, now)) {
                (now, met) = (to, met + 1);
                if now == start || met > degree[v as usize] {
                    break;
                }
            }
            vertices += usize::from(met != degree[v as usize]);
        }
        (edges, vertices)
    }

    /// A cube of 12 triangles turned outwards, its low corner at `low`, edges of length 1.
    fn cube(low: [i32; 3]) -> Vec<[[i32; 3]; 3]> {
        let mut all = Vec::new();
        for axis in 0..3 {
            for side in 0..2 {
                let corner = |u: i32, v: i32| {
                    let mut p = low;
                    p[axis] += side;
                    p[(axis + 1) % 3] += u;
                    p[(axis + 2) % 3] += v;
                    p
                };
                let mut quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                if side == 0 {
                    quad.reverse();
                }
                all.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
            }
        }
        all
    }

    /// Two cubes as one mesh, with the vertices that they share.
    fn joined(second: [i32; 3]) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let (mut known, mut positions) = (BTreeMap::new(), Vec::new());
        let faces = [cube([0; 3]), cube(second)].concat();
        let triangles = faces.into_iter().map(|face| {
            face.map(|p| {
                *known.entry(p).or_insert_with(|| {
                    positions.push(DVec3::from_array(p.map(f64::from)));
                    positions.len() as u32 - 1
                })
            })
        });
        let triangles = triangles.collect();
        (positions, triangles)
    }

    #[test]
    fn cubes_that_meet_in_an_edge_or_a_corner_are_two_cubes() {
        for (second, shared) in [([1, 1, 0], 2), ([1, 0, 1], 2), ([1, 1, 1], 1), ([5, 0, 0], 0)] {
            let (mut positions, mut triangles) = joined(second);
            assert_eq!(positions.len(), 16 - shared);
            assert_eq!(faults(positions.len(), &triangles) == (0, 0), shared == 0);
            let before: Vec<_> =
                triangles.iter().map(|t| t.map(|v| positions[v as usize])).collect();
            part_sheets(&mut positions, &mut triangles);
            assert_eq!((positions.len(), faults(positions.len(), &triangles)), (16, (0, 0)));
            let after: Vec<_> =
                triangles.iter().map(|t| t.map(|v| positions[v as usize])).collect();
            assert_eq!(before, after);
            // The triangles of a cube keep to themselves.
            let (one, two) = triangles.split_at(12);
            assert!(one.as_flattened().iter().all(|v| !two.as_flattened().contains(v)));
        }
    }

    #[test]
    fn every_edge_of_the_mannequin_has_two_triangles_and_every_vertex_one_fan() {
        let head = Head::mannequin();
        let surface = head.surface();
        assert_eq!(faults(surface.positions().len(), surface.triangles()), (0, 0));
    }
}
