//! Small meshes for tests.

use std::f64::consts::{PI, TAU};

use std::sync::OnceLock;

use frisure_strands::Surface;
use glam::DVec3;

use super::Head;

/// The mannequin, made once for all tests.
pub(crate) fn mannequin() -> &'static Head {
    static HEAD: OnceLock<Head> = OnceLock::new();
    HEAD.get_or_init(Head::mannequin)
}

/// A ball of the given radius (m), with `rings` rings of twice as many quads.
pub(crate) fn ball(radius: f64, rings: usize) -> Surface {
    let (positions, triangles) = part_of_ball(radius, rings, rings);
    Surface::new(positions, triangles).unwrap()
}

/// A ball open below, with a bag inside that opens through a slit in front: like a head with a
/// mouth.
pub(crate) fn open_ball_with_bag() -> Surface {
    let (mut positions, mut triangles) = part_of_ball(0.08, 48, 40);
    // The slit is narrower than a cell: only the bag's own wall tells of it.
    let (bag, faces) = part_of_ball(0.02, 16, 16);
    let base = positions.len() as u32;
    positions.extend(bag.iter().map(|p| *p + DVec3::new(0.0, -0.05, 0.0)));
    triangles.extend(faces.iter().map(|&[a, b, c]| [a + base, c + base, b + base]));
    Surface::new(positions, triangles).unwrap()
}

fn part_of_ball(radius: f64, rings: usize, kept: usize) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let around = 2 * rings;
    let point = |i: usize, j: usize| {
        let (polar, turn) =
            (PI * i as f64 / rings as f64, TAU * (j % around) as f64 / around as f64);
        let r = if i == 0 || i == rings { 0.0 } else { polar.sin() };
        radius * DVec3::new(r * turn.cos(), r * turn.sin(), polar.cos())
    };
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..kept {
        for j in 0..around {
            let base = positions.len() as u32;
            positions.extend([point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
            triangles.push([base, base + 1, base + 2]);
            triangles.push([base, base + 2, base + 3]);
        }
    }
    (positions, triangles)
}

/// Reads a mesh as modelling programs export it: metres, y up, z forward.
pub(crate) fn read_obj(text: &str) -> Surface {
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let v: Vec<f64> = words.map(|w| w.parse().unwrap()).collect();
                positions.push(DVec3::new(v[0], -v[2], v[1]));
            }
            Some("f") => {
                let index = |w: &str| w.split('/').next().unwrap().parse::<u32>().unwrap() - 1;
                let face: Vec<u32> = words.map(index).collect();
                triangles.extend((2..face.len()).map(|i| [face[0], face[i - 1], face[i]]));
            }
            _ => {}
        }
    }
    Surface::new(positions, triangles).unwrap()
}
