//! What is wrong with a mesh on which hair grows all the same.

use std::collections::BTreeMap;

use frisure_strands::Surface;
use glam::DVec3;

use super::Head;
use super::seams::{Sets, joined};

/// Faults of the mesh of a head.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct MeshFaults {
    /// Whether its faces looked inwards, and were turned.
    pub turned: bool,
    /// The share of its edges at which one face looks outwards and the other inwards, if those are more than one in fifty.
    pub mixed: Option<f64>,
    /// The number of faces that have the corners of another, if those are more than one in fifty: hair grows on both.
    pub doubled: Option<usize>,
    /// The number of parts of the mesh with space between them, and the middle (m) of the smallest, if they are several.
    pub apart: Option<(usize, DVec3)>,
    /// The area on which hair grows over that of a head as wide as this one, if it is much larger.
    pub scalp: Option<f64>,
}

/// The share of edges or of faces that is told. Chosen: meshes of people have fewer.
const TOLD: f64 = 0.02;

/// Parts with less space between them (m) are one: eyes, lashes, teeth and caps lie that near. Chosen.
const SPACE: f64 = 0.03;

/// Least area (m²) of a part that counts. Chosen.
const LEAST: f64 = 1e-4;

/// The area of a scalp (m²) over the square of the width of the cranium (m): about that of the built-in heads, 0.06 m² at 15 cm.
const SCALP: f64 = 2.7;

/// How many times as large a scalp is told. Chosen: those of all built-in heads are smaller, as a test asks.
const LARGE: f64 = 1.8;

impl Head {
    /// What is wrong with the mesh, as far as it matters to hair.
    #[must_use]
    pub fn mesh_faults(&self) -> MeshFaults {
        let surface = self.surface();
        let same = joined(surface.positions());
        let faces = surface.triangles();
        let weight = |t: &[u32; 3]| t.iter().map(|&v| self.scalp()[v as usize]).sum::<f64>() / 3.0;
        let grown: f64 = (0..faces.len())
            .map(|face| weight(&faces[face]) * 0.5 * surface.doubled_area_vector(face).length())
            .sum();
        let scalp = grown / (SCALP * self.landmarks().width.powi(2));
        MeshFaults {
            turned: self.turned,
            mixed: mixed(faces, &same),
            doubled: doubled(faces, &same),
            apart: apart(surface, &same),
            scalp: (self.natural && scalp > LARGE).then_some(scalp),
        }
    }
}

/// The share of the edges that two faces, and no others, run through in the same direction.
fn mixed(faces: &[[u32; 3]], same: &[u32]) -> Option<f64> {
    // How many faces run through an edge upwards, and downwards.
    let mut ways: BTreeMap<[u32; 2], [u32; 2]> = BTreeMap::new();
    for triangle in faces {
        let [a, b, c] = triangle.map(|v| same[v as usize]);
        for [a, b] in [[a, b], [b, c], [c, a]] {
            ways.entry([a.min(b), a.max(b)]).or_default()[usize::from(a > b)] += 1;
        }
    }
    let against = ways.values().filter(|[up, down]| up + down == 2 && up != down).count();
    let share = against as f64 / ways.len().max(1) as f64;
    (share > TOLD).then_some(share)
}

/// The number of faces with the corners of another.
fn doubled(faces: &[[u32; 3]], same: &[u32]) -> Option<usize> {
    let mut corners: Vec<[u32; 3]> = faces
        .iter()
        .map(|triangle| {
            let mut corners = triangle.map(|v| same[v as usize]);
            corners.sort_unstable();
            corners
        })
        .collect();
    corners.sort_unstable();
    let twice = corners.windows(2).filter(|pair| pair[0] == pair[1]).count();
    (twice as f64 > TOLD * faces.len() as f64).then_some(twice)
}

/// A part of a mesh: the box around it (m), and its area (m²).
#[derive(Clone, Copy)]
struct Part {
    low: DVec3,
    high: DVec3,
    area: f64,
}

impl Part {
    fn is_near(&self, other: &Self) -> bool {
        (self.low - other.high).max(other.low - self.high).max_element() < SPACE
    }

    fn and(&self, other: &Self) -> Self {
        Self {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            area: self.area + other.area,
        }
    }
}

/// The number of parts with space between the boxes around them, and the middle of the smallest.
fn apart(surface: &Surface, same: &[u32]) -> Option<(usize, DVec3)> {
    let mut sets = Sets::new(surface.positions().len());
    for triangle in surface.triangles() {
        let [a, b, c] = triangle.map(|v| same[v as usize]);
        sets.join(a, b);
        sets.join(b, c);
    }
    let mut parts: BTreeMap<u32, Part> = BTreeMap::new();
    for (face, triangle) in surface.triangles().iter().enumerate() {
        let [a, b, c] = surface.corners(face);
        let own = Part {
            low: a.min(b).min(c),
            high: a.max(b).max(c),
            area: 0.5 * surface.doubled_area_vector(face).length(),
        };
        let part = parts.entry(sets.of(same[triangle[0] as usize])).or_insert(own);
        *part = Part { area: part.area, ..part.and(&own) };
        part.area += own.area;
    }
    // What lies near a part is one with it, and the box around both may be near another.
    let mut groups: Vec<Part> = Vec::new();
    for mut part in parts.into_values() {
        while let Some(near) = groups.iter().position(|group| group.is_near(&part)) {
            part = part.and(&groups.swap_remove(near));
        }
        groups.push(part);
    }
    groups.retain(|group| group.area > LEAST);
    let smallest = groups.iter().min_by(|a, b| a.area.total_cmp(&b.area))?;
    (groups.len() > 1).then(|| (groups.len(), 0.5 * (smallest.low + smallest.high)))
}

#[cfg(test)]
mod tests {
    use super::super::ScalpSource;
    use super::super::test_shapes::ball;
    use super::*;

    fn head(surface: Surface) -> Head {
        Head::from_surface(surface, ScalpSource::Guess).expect("a head")
    }

    /// Two meshes as one.
    fn both(a: &Surface, b: &Surface, shift: DVec3) -> Surface {
        let first = a.positions().len() as u32;
        let moved = b.positions().iter().map(|p| *p + shift);
        let positions = a.positions().iter().copied().chain(moved).collect();
        let more = b.triangles().iter().map(|t| t.map(|v| v + first));
        let triangles = a.triangles().iter().copied().chain(more).collect();
        Surface::new(positions, triangles).expect("two surfaces")
    }

    #[test]
    fn heads_without_faults_have_none() {
        for name in Head::names() {
            assert_eq!(Head::named(name).unwrap().mesh_faults(), MeshFaults::default(), "{name}");
        }
        assert_eq!(head(ball(0.1, 24)).mesh_faults(), MeshFaults::default());
    }

    #[test]
    fn a_head_that_is_inside_out_is_turned_and_one_that_is_mixed_is_told() {
        let right = head(ball(0.1, 24));
        let turned = head(ball(0.1, 24).turned_over());
        assert_eq!(turned.surface(), right.surface());
        assert_eq!(turned.mesh_faults(), MeshFaults { turned: true, ..MeshFaults::default() });
        let surface = ball(0.1, 24);
        let mut faces = surface.triangles().to_vec();
        faces.iter_mut().step_by(3).for_each(|face| face.swap(0, 1));
        let mixed = head(Surface::new(surface.positions().to_vec(), faces).unwrap());
        assert!(mixed.mesh_faults().mixed.is_some_and(|share| share > 0.3));
    }

    #[test]
    fn doubled_faces_and_parts_that_lie_apart_are_told() {
        let surface = ball(0.1, 24);
        let count = surface.triangles().len();
        let twice = head(both(&surface, &surface, DVec3::ZERO)).mesh_faults();
        assert_eq!(twice.doubled, Some(count));
        assert_eq!(twice.apart, None);
        let small = ball(0.02, 12);
        let beside = head(both(&surface, &small, DVec3::X * 0.4)).mesh_faults();
        let (parts, middle) = beside.apart.expect("two parts");
        assert!(parts == 2 && middle.distance(DVec3::X * 0.4) < 1e-3, "{middle}");
        // Inside the head lie eyes and teeth.
        assert_eq!(head(both(&surface, &small, DVec3::ZERO)).mesh_faults().apart, None);
    }

    #[test]
    fn a_vertex_of_no_face_moves_no_scalp() {
        let surface = ball(0.1, 24);
        let mut positions = vec![DVec3::X];
        positions.extend_from_slice(surface.positions());
        let faces = surface.triangles().iter().map(|t| t.map(|v| v + 1)).collect();
        let stray = head(Surface::new(positions.clone(), faces).unwrap());
        assert_eq!(stray, head(surface.clone()));
        // Weights are those of the vertices of the file.
        let faces = surface.triangles().iter().map(|t| t.map(|v| v + 1)).collect();
        let weights: Vec<f64> = positions.iter().map(|p| f64::from(u8::from(p.z > 0.0))).collect();
        let given = ScalpSource::Weights(weights.clone());
        let given = Head::from_surface(Surface::new(positions, faces).unwrap(), given).unwrap();
        assert_eq!(given.scalp(), &weights[1..]);
    }
}
