//! The eyeballs of a mesh: groups of faces that are named so, and lie on a sphere.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use frisure_strands::Eye;
use glam::{DMat3, DVec3};

use super::mesh::Mesh;

/// Radii of eyeballs (m). Chosen around those of people (0.012) and of characters that have larger ones.
const RADII: RangeInclusive<f64> = 0.008..=0.02;

/// Largest distance of a vertex from the sphere over its radius, of most of them: a cornea stands out. As near as renderers need.
const NEAR: f64 = 0.01;

/// Share of the vertices that lie so near. Chosen.
const MOST: f64 = 0.6;

/// Parts of names of what is about an eye and is none.
const BESIDE: [&str; 9] =
    ["brow", "lash", "lid", "shadow", "liner", "tear", "wet", "occlusion", "socket"];

/// The eyes of a mesh with vertices at `positions` (m, z up, face towards −y): at most two, the ones with most vertices. They look ahead.
pub(super) fn find(mesh: &Mesh, positions: &[DVec3]) -> Vec<Eye> {
    let named = |name: &str| {
        let name = name.to_lowercase();
        name.contains("eye") && !BESIDE.iter().any(|word| name.contains(word))
    };
    let groups = mesh.groups.values().filter(|group| named(&group.name));
    let mut triangles: Vec<usize> = groups.flat_map(|group| &group.triangles).copied().collect();
    triangles.sort_unstable();
    triangles.dedup();
    let mut balls: Vec<(usize, Eye)> = parts(mesh, &triangles)
        .into_iter()
        .filter_map(|part| {
            let places: Vec<DVec3> = part.iter().map(|&v| positions[v as usize]).collect();
            Some((places.len(), ball(&places)?))
        })
        .collect();
    // A stable sort: of as large ones the first of the file.
    balls.sort_by_key(|(vertices, _)| std::cmp::Reverse(*vertices));
    balls.truncate(2);
    balls.into_iter().map(|(_, eye)| eye).collect()
}

/// The vertices of each connected part of some triangles.
fn parts(mesh: &Mesh, triangles: &[usize]) -> Vec<Vec<u32>> {
    // Each vertex points to another of its part, the last to itself.
    let mut of: BTreeMap<u32, u32> = BTreeMap::new();
    let root = |of: &mut BTreeMap<u32, u32>, v: u32| {
        let mut at = v;
        while let Some(&next) = of.get(&at).filter(|next| **next != at) {
            at = next;
        }
        of.insert(v, at);
        at
    };
    for &triangle in triangles {
        let [a, b, c] = mesh.triangles[triangle].map(|v| root(&mut of, v));
        let first = a.min(b).min(c);
        of.extend([a, b, c].map(|v| (v, first)));
    }
    let vertices: Vec<u32> = of.keys().copied().collect();
    let mut parts: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for v in vertices {
        parts.entry(root(&mut of, v)).or_default().push(v);
    }
    parts.into_values().collect()
}

/// The eyeball whose skin some places are; none if they do not lie on such a sphere.
fn ball(places: &[DVec3]) -> Option<Eye> {
    // Least squares of |p − c|² − r², which is linear in c and r² − |c|²: with q = p − p̄, Σ q qᵀ c' = ½ Σ q |q|², c = p̄ + c'.
    let count = places.len() as f64;
    let mean = places.iter().sum::<DVec3>() / count;
    let (mut squares, mut cubes, mut size) = (DMat3::ZERO, DVec3::ZERO, 0.0);
    for q in places.iter().map(|p| *p - mean) {
        squares += DMat3::from_cols(q * q.x, q * q.y, q * q.z);
        cubes += q * (0.5 * q.length_squared());
        size += q.length_squared() / count;
    }
    // Flat parts have no sphere: compared with the cube of their size.
    if squares.determinant().abs() <= 1e-9 * (count * size).powi(3) {
        return None;
    }
    let off = squares.inverse() * cubes;
    let (centre, radius) = (mean + off, (size + off.length_squared()).sqrt());
    let near = places.iter().filter(|p| (p.distance(centre) / radius - 1.0).abs() < NEAR).count();
    let is_eye = RADII.contains(&radius) && near as f64 >= MOST * count;
    is_eye.then_some(Eye { centre, radius, gaze: -DVec3::Y })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ball in a mesh, in a group.
    fn add(mesh: &mut Mesh, group: &str, centre: [f64; 3], radius: f64) {
        let (first, start) = (mesh.triangles.len(), mesh.positions.len() as u32);
        for i in 0..12 {
            for k in 0..16 {
                let (polar, turn) = (0.1 + 0.24 * f64::from(i), 0.4 * f64::from(k));
                let d = [polar.sin() * turn.cos(), polar.cos(), polar.sin() * turn.sin()];
                mesh.positions.push([0, 1, 2].map(|x| centre[x] + radius * d[x]));
            }
        }
        for i in 0..191 {
            mesh.triangles.push([start + i, start + i + 1, start + (i + 16) % 192]);
        }
        mesh.group(group, first);
    }

    #[test]
    fn balls_in_groups_of_eyes_are_eyes() {
        let mut mesh = Mesh::default();
        add(&mut mesh, "Eyes", [0.03, -0.06, 0.01], 0.0125);
        add(&mut mesh, "Eyes", [-0.03, -0.06, 0.01], 0.0125);
        // Neither is one: another name, and a ball that is too large.
        add(&mut mesh, "eyelashes", [0.0, 0.0, 0.3], 0.0125);
        add(&mut mesh, "eye_of_the_storm", [0.0, 0.0, 0.6], 0.2);
        let positions: Vec<DVec3> = mesh.positions.iter().map(|p| DVec3::from_array(*p)).collect();
        let eyes = find(&mesh, &positions);
        assert_eq!(eyes.len(), 2);
        for (eye, x) in eyes.iter().zip([0.03, -0.03]) {
            assert!(eye.centre.distance(DVec3::new(x, -0.06, 0.01)) < 1e-9, "{eye:?}");
            assert!((eye.radius - 0.0125).abs() < 1e-9 && eye.gaze == -DVec3::Y);
        }
    }

    #[test]
    fn what_is_flat_or_small_is_no_eye() {
        let flat: Vec<DVec3> = (0..20).map(|i| DVec3::new(f64::from(i), 0.0, 0.0)).collect();
        assert_eq!(ball(&flat), None);
        assert_eq!(ball(&[DVec3::X]), None);
    }
}
