//! The head: its skin, where hair grows on it, how far it is, and the spheres it is made of.
//!
//! A [`Head`] is checked when it is made; after that nothing about it can fail. Everything is in
//! metres, z up; the face looks towards −y and the head's left is +x.

mod correspondence;
mod derived;
mod distance;
mod face;
mod facial_hair;
mod fans;
mod far;
mod faults;
mod guess;
mod holes;
mod landmarks;
mod mannequin;
mod mesher;
mod packed;
mod people;
mod samples;
mod scalp;
mod sculpt;
mod seams;
mod spheres;
mod splat;
mod spline;
mod subdivide;
#[cfg(test)]
pub(crate) mod test_shapes;
mod texture;
mod triangles;
mod upright;
mod voxel_grid;
mod voxels;

use frisure_digest::Digest;
use frisure_strands::{Surface, Tint};
use glam::DVec3;
use thiserror::Error;

pub(crate) use correspondence::{Correspondence, Corresponding};
use derived::Derived;
pub use distance::SignedDistance;
pub use faults::MeshFaults;
pub use holes::ScalpHoles;
pub use landmarks::{Landmarks, Region};
pub(crate) use scalp::Edge;
pub use scalp::Hairline;
pub use spheres::Sphere;
pub(crate) use texture::Texture;
pub use texture::textured;
pub use upright::Stance;

/// A head that hair can be planted on.
///
/// ```
/// use frisure_hairstyle::head::Head;
///
/// let head = Head::mannequin();
/// let skin = head.surface().positions()[0];
/// assert!(head.signed_distance().value(skin).abs() < 2e-3);
/// assert!(head.signed_distance().value(head.landmarks().whorl * 1.5) > 0.04); // outside
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    surface: Surface,
    scalp: Vec<f64>,
    /// Whether the scalp is the landmarks' hairline, not one that came with the mesh.
    natural: bool,
    landmarks: Landmarks,
    signed_distance: SignedDistance,
    stance: Stance,
    /// Whether the faces of the mesh that it was made from looked inwards.
    turned: bool,
    spheres: Derived<Vec<Sphere>>,
    fingerprint: u64,
    frame: (DVec3, DVec3),
}

/// Where the scalp of a mesh comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum ScalpSource {
    /// Guess it from the shape of the head.
    Guess,
    /// One weight 0..1 per vertex of the mesh.
    Weights(Vec<f64>),
}

/// Why a mesh is not a [`Head`].
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HeadError {
    /// The scalp's weights are not one per vertex.
    #[error("the scalp has {weights} weights, but the mesh has {vertices} vertices")]
    WeightCount {
        /// Number of weights given.
        weights: usize,
        /// Number of vertices of the mesh.
        vertices: usize,
    },
    /// A weight is not between 0 and 1.
    #[error("the scalp's weight of vertex {vertex} is {weight}; it must be between 0 and 1")]
    WeightRange {
        /// Index of the vertex, from 0.
        vertex: usize,
        /// Its weight.
        weight: f64,
    },
    /// No skin has a positive weight.
    #[error("hair grows nowhere: no face of the mesh has a scalp weight above zero")]
    NoScalp,
    /// The scalp is a mesh of its own that is not on the head.
    #[error("the scalp is {:.1} cm away from the head: hair would grow in the air", 100.0 * .distance)]
    FloatingScalp {
        /// Median distance of its vertices from the head (m).
        distance: f64,
    },
    /// The mesh is far from the size of a human head.
    #[error(
        "the mesh is {size} m high; a head is about 0.25 m, a bust up to 1 m. Check its units (metres)"
    )]
    Size {
        /// Height of the mesh (m).
        size: f64,
    },
    /// More faces meet at a vertex than at any of a head.
    #[error(
        "{faces} faces meet at vertex {vertex}; there may be {MOST_FACES}. Divide them into rings"
    )]
    Fan {
        /// Index of the vertex, from 0.
        vertex: usize,
        /// Faces that have it as a corner.
        faces: usize,
    },
    /// The mesh is too far from the origin for the precision of strands.
    #[error("the mesh reaches {distance} m from the origin; it must stay within 100 m. Centre it")]
    Distance {
        /// Largest coordinate (m), without its sign.
        distance: f64,
    },
}

/// Name of [`Head::mannequin`] among the built-in heads.
const MANNEQUIN: &str = "mannequin";

/// Farthest (m) from the origin that a head may be: there a strand's `f32` still tells 8 µm.
const FARTHEST: f64 = 100.0;

/// Most faces that meet at a vertex: each knows the others, which takes 100 MB then. Chosen; a sphere has some hundred at a pole.
const MOST_FACES: usize = 5000;

/// Lowest and greatest height of a mesh (m) that may be a human head or bust.
const HEIGHTS: std::ops::RangeInclusive<f64> = 0.08..=2.5;

impl Head {
    /// The built-in training head, modelled by code: about 90 000 triangles, the centre of the
    /// cranium at the origin, 23 cm from chin to vertex, with shoulders, chest and back down to the elbows.
    #[must_use]
    pub fn mannequin() -> Self {
        let surface = mannequin::surface();
        let landmarks = mannequin::landmarks();
        let scalp = scalp::weights(&surface, &landmarks);
        let distance =
            SignedDistance::with_torso(&surface, mannequin::NECK, Some(mannequin::FRAME));
        let features = mannequin::features(&surface, &distance);
        let surface = surface.with_features(features).expect("a tint for each vertex");
        let head = Self::assemble(surface, scalp, true, landmarks, distance, Stance::Upright);
        Self { frame: mannequin::FRAME, ..head }
    }

    /// The names of the built-in heads, the mannequin first.
    pub fn names() -> impl Iterator<Item = &'static str> {
        std::iter::once(MANNEQUIN).chain(people::names())
    }

    /// A built-in head by its name: the mannequin, or a person with open eyes, brows, lashes and a garment. `None`, if no
    /// head has this name.
    ///
    /// ```
    /// use frisure_hairstyle::head::Head;
    ///
    /// assert!(Head::names().any(|name| name == "european-woman"));
    /// assert!(Head::named("no one").is_none());
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        if name == MANNEQUIN {
            return Some(Self::mannequin());
        }
        Self::with_face(name, 0)
    }

    /// A built-in person whose face differs from that of the model: nose, mouth, chin, cheeks, eyes and brows are moved and sized by random
    /// numbers that the seed `face` gives, 0 for the model's own. The scalp, the ears and the shoulders are those of the model. `None`, if
    /// no person has this name; the mannequin is none.
    #[must_use]
    pub fn with_face(name: &str, face: u32) -> Option<Self> {
        let person = people::Person::named(name, face)?;
        // A longer nose moves neither hairline nor roots: landmarks, and the box in which roots are put in order, are those of the model.
        let model = match face {
            0 => None,
            _ => Some(people::Person::named(name, 0)?.surface),
        };
        let model = model.as_ref().unwrap_or(&person.surface);
        let (landmarks, frame) = (Landmarks::guess(model), model.bounds());
        let scalp = scalp::weights(&person.surface, &landmarks);
        let neck = landmarks.cranium_centre.z + mannequin::NECK * landmarks.width / 0.155;
        let distance = SignedDistance::with_torso(&person.surface, neck, None);
        let surface = person.surface.clone();
        let surface = surface.with_features(person.features(&distance)).ok()?;
        let head = Self::assemble(surface, scalp, true, landmarks, distance, Stance::Upright);
        Some(Self { frame, ..head })
    }

    /// A head from a mesh (m, z up, face towards −y), which may be open at the shoulders. Of one that leans or lies, as [`Self::stance`]
    /// tells, the landmarks and the scalp lie with it. Vertices that no face uses are left out, with their weights; faces that look inwards
    /// are turned, which [`Self::mesh_faults`] tells.
    ///
    /// # Errors
    /// [`HeadError`], if the mesh cannot be a human head, the weights are not one number 0..1 per
    /// vertex, or hair grows on no face or on faces that are not on the head.
    pub fn from_surface(surface: Surface, scalp: ScalpSource) -> Result<Self, HeadError> {
        let natural = scalp == ScalpSource::Guess;
        let given = match scalp {
            ScalpSource::Guess => None,
            ScalpSource::Weights(weights) => Some(checked(weights, surface.positions().len())?),
        };
        let (surface, kept) = surface.without_strays();
        let turned = surface.volume() < 0.0;
        let surface = if turned { surface.turned_over() } else { surface };
        let (low, high) = surface.bounds();
        let size = high.z - low.z;
        if !HEIGHTS.contains(&size) {
            return Err(HeadError::Size { size });
        }
        let distance = low.abs().max(high.abs()).max_element();
        if distance > FARTHEST {
            return Err(HeadError::Distance { distance });
        }
        if let Some((vertex, faces)) = largest_fan(&surface).filter(|fan| fan.1 > MOST_FACES) {
            return Err(HeadError::Fan { vertex, faces });
        }
        let signed_distance = SignedDistance::new(&surface);
        let stance = upright::stance(&surface, &signed_distance);
        let landmarks = match stance {
            Stance::Upright => Landmarks::guess(&surface),
            Stance::Leans(upright) | Stance::Lies(upright) => {
                Landmarks::guess_leaning(&surface, upright)
            }
        };
        let scalp = match given {
            None => scalp::weights(&surface, &landmarks),
            Some(weights) => kept.iter().map(|&v| weights[v as usize]).collect(),
        };
        if !grows(&surface, &scalp) {
            return Err(HeadError::NoScalp);
        }
        if let Some(distance) = holes::floating_scalp(&surface, &scalp).filter(|_| !natural) {
            return Err(HeadError::FloatingScalp { distance });
        }
        let head = Self::assemble(surface, scalp, natural, landmarks, signed_distance, stance);
        Ok(Self { turned, ..head })
    }

    fn assemble(
        surface: Surface,
        scalp: Vec<f64>,
        natural: bool,
        landmarks: Landmarks,
        signed_distance: SignedDistance,
        stance: Stance,
    ) -> Self {
        let surface = with_scalp(surface, &scalp);
        let spheres = Derived::new();
        let fingerprint = fingerprint(&surface, &scalp);
        let frame = surface.bounds();
        Self {
            frame,
            surface,
            scalp,
            natural,
            landmarks,
            signed_distance,
            stance,
            turned: false,
            spheres,
            fingerprint,
        }
    }

    /// Smallest and largest corner of the box (m) by which places are put in order: that of the mesh, and of the mannequin
    /// that of its bust, so that roots stay where they were before it had a torso.
    pub(crate) fn frame(&self) -> (DVec3, DVec3) {
        self.frame
    }

    /// A number that two heads share only if skin and scalp are the same.
    pub(crate) fn fingerprint(&self) -> u64 {
        self.fingerprint
    }

    /// The skin (m).
    #[must_use]
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Per vertex, how densely hair grows: 0 nowhere, 1 fully, between across the hairline.
    #[must_use]
    pub fn scalp(&self) -> &[f64] {
        &self.scalp
    }

    /// The edge of the hair, where it is not one that came with the mesh.
    pub(crate) fn edge(&self, hairline: &Hairline, seed: u64) -> Option<Edge> {
        self.natural.then(|| Edge::new(&self.landmarks, hairline, seed))
    }

    /// Where things are on the head.
    #[must_use]
    pub fn landmarks(&self) -> &Landmarks {
        &self.landmarks
    }

    /// Whether the head stands upright with its face towards −y, and the rotation that would make it.
    #[must_use]
    pub fn stance(&self) -> Stance {
        self.stance
    }

    /// The holes of the mesh where hair grows: none grows in them, and hair falls into the head. `None` without any.
    #[must_use]
    pub fn scalp_holes(&self) -> Option<ScalpHoles> {
        holes::scalp_holes(&self.surface, &self.scalp)
    }

    /// Distance to the skin, positive outside.
    #[must_use]
    pub fn signed_distance(&self) -> &SignedDistance {
        &self.signed_distance
    }

    /// The head as spheres, largest errors first mended: dense on the scalp, coarser elsewhere. Fitted when they are first asked for.
    #[must_use]
    pub fn spheres(&self) -> &[Sphere] {
        self.spheres.get_or(|| {
            spheres::fit(&self.surface, &self.scalp, &self.landmarks, &self.signed_distance)
        })
    }
}

/// The surface, whose tints say how much hair grows at each vertex (0 to 1); a mesh that is skin alone has no other tints.
fn with_scalp(surface: Surface, scalp: &[f64]) -> Surface {
    let mut features = surface.features().cloned().unwrap_or_default();
    features.tints.resize(scalp.len(), Tint::default());
    for (tint, weight) in features.tints.iter_mut().zip(scalp) {
        tint.scalp = *weight as f32;
    }
    surface.with_features(features).expect("a tint for each vertex")
}

/// The digest of a head.
fn fingerprint(surface: &Surface, scalp: &[f64]) -> u64 {
    let positions = surface.positions().iter().flat_map(DVec3::to_array);
    Digest::new("head")
        .packed("positions", positions.map(f64::to_le_bytes))
        .packed("triangles", surface.triangles().iter().flatten().map(|v| v.to_le_bytes()))
        .packed("scalp", scalp.iter().map(|weight| weight.to_le_bytes()))
        .key()
}

/// The vertex at which most faces meet, and how many.
fn largest_fan(surface: &Surface) -> Option<(usize, usize)> {
    // Corners at the same place are one.
    let same = triangles::weld(surface.positions());
    let mut faces = vec![0; same.len()];
    let corners = surface.triangles().iter().flatten();
    corners.for_each(|&vertex| faces[same[vertex as usize] as usize] += 1);
    faces.into_iter().enumerate().max_by_key(|&(_, faces)| faces)
}

fn checked(weights: Vec<f64>, vertices: usize) -> Result<Vec<f64>, HeadError> {
    if weights.len() != vertices {
        return Err(HeadError::WeightCount { weights: weights.len(), vertices });
    }
    match weights.iter().position(|w| !(0.0..=1.0).contains(w)) {
        Some(vertex) => Err(HeadError::WeightRange { vertex, weight: weights[vertex] }),
        None => Ok(weights),
    }
}

fn grows(surface: &Surface, scalp: &[f64]) -> bool {
    surface.triangles().iter().enumerate().any(|(face, triangle)| {
        triangle.iter().any(|&v| scalp[v as usize] > 0.0)
            && surface.doubled_area_vector(face).length() > 0.0
    })
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use test_shapes::{ball, mannequin};

    #[test]
    fn bad_heads_are_refused() {
        let make = |scalp| Head::from_surface(ball(0.1, 8), scalp);
        let count = ball(0.1, 8).positions().len();
        let short = make(ScalpSource::Weights(vec![1.0]));
        assert_eq!(short, Err(HeadError::WeightCount { weights: 1, vertices: count }));
        let mut weights = vec![1.0; count];
        weights[3] = f64::NAN;
        let nan = make(ScalpSource::Weights(weights));
        assert!(matches!(nan, Err(HeadError::WeightRange { vertex: 3, .. })));
        assert_eq!(make(ScalpSource::Weights(vec![0.0; count])), Err(HeadError::NoScalp));
        let rim = |i: usize| (TAU * i as f64 / 6000.0).sin_cos();
        let rim = (0..6000).map(|i| DVec3::new(0.1 * rim(i).0, 0.1 * rim(i).1, 0.0));
        let corners = std::iter::once(DVec3::Z * 0.2).chain(rim).collect();
        let faces = (0..6000).map(|i| [0, 1 + i, 1 + (i + 1) % 6000]).collect();
        let cone = Head::from_surface(Surface::new(corners, faces).unwrap(), ScalpSource::Guess);
        assert_eq!(cone, Err(HeadError::Fan { vertex: 0, faces: 6000 }));
        let far = Head::from_surface(ball(100.0, 8), ScalpSource::Guess);
        assert_eq!(far, Err(HeadError::Size { size: 200.0 }));
    }

    #[test]
    fn a_ball_is_head_enough() {
        let head = Head::from_surface(ball(0.1, 24), ScalpSource::Guess).unwrap();
        assert!(!head.spheres().is_empty());
    }

    #[test]
    fn the_mannequin_has_human_measures() {
        let head = mannequin();
        let (low, high) = head.surface().bounds();
        assert!((high.z - 0.11).abs() < 4e-3, "{high}");
        assert!(low.y < -0.11 && low.y > -0.125, "the nose's tip: {low}");
        let scalp = |p: DVec3| nearest_weight(head, p);
        assert_eq!(scalp(DVec3::new(0.0, 0.0, 0.11)), 1.0);
        assert_eq!(scalp(DVec3::new(0.0, 0.098, 0.01)), 1.0);
        assert_eq!(scalp(DVec3::new(0.0, -0.096, 0.03)), 0.0);
        assert_eq!(scalp(DVec3::new(0.0, -0.115, -0.04)), 0.0);
        assert_eq!(scalp(DVec3::new(0.085, 0.015, -0.02)), 0.0);
        assert!(head.landmarks().azimuth(head.landmarks().ear) > 1.5);
        // People have 550 to 750 cm² of scalp.
        let area = scalp_area(head);
        assert!((0.05..0.075).contains(&area), "{area}");
    }

    #[test]
    fn long_hair_has_shoulders_and_a_back_to_lie_on() {
        let head = mannequin();
        let inside = |x: f64, forward: f64, z: f64| {
            head.signed_distance().value(DVec3::new(x, -forward, z)) < 0.0
        };
        assert!(inside(0.06, -0.09, -0.3) && inside(0.0, 0.07, -0.3) && inside(0.16, -0.03, -0.25));
        assert!(
            inside(0.05, -0.07, -0.45) && !inside(0.0, -0.13, -0.3) && !inside(0.24, 0.0, -0.3)
        );
        // The cost of a start: the bust without a torso had 76 616.
        assert!(head.surface().triangles().len() < 100_000, "{}", head.surface().triangles().len());
    }

    #[test]
    fn the_distance_vanishes_on_smooth_skin() {
        let head = mannequin();
        let gaps = |chosen: fn(f64) -> bool| {
            let skin = head.surface().positions().iter().filter(|p| chosen(p.z));
            let mut gaps: Vec<f64> = skin.map(|&p| head.signed_distance().value(p).abs()).collect();
            gaps.sort_by(f64::total_cmp);
            gaps
        };
        let quantile = |gaps: &[f64], q: f64| gaps[(q * (gaps.len() - 1) as f64) as usize];
        let above = gaps(|z| z > mannequin::NECK);
        assert!(quantile(&above, 0.98) < 3e-4, "{}", quantile(&above, 0.98));
        // In the nostrils and behind the ears a grid of 3 mm rounds the creases.
        assert!(quantile(&above, 1.0) < 1.5e-3, "{}", quantile(&above, 1.0));
        // So does one of 8 mm between arm and ribs and at the edge of the foot.
        let below = gaps(|z| z < mannequin::NECK && z > -0.5);
        assert!(quantile(&below, 0.9) < 3e-4, "{}", quantile(&below, 0.9));
    }

    #[test]
    fn the_same_bytes_whatever_the_number_of_threads() {
        let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let many = rayon::ThreadPoolBuilder::new().num_threads(5).build().unwrap();
        let surface = alone.install(mannequin::surface);
        assert_eq!(surface.positions(), mannequin().surface().positions());
        assert_eq!(surface.triangles(), mannequin().surface().triangles());
        let heads = [alone, many].map(|pool| {
            pool.install(|| Head::from_surface(ball(0.1, 24), ScalpSource::Guess).unwrap())
        });
        assert_eq!(heads[0], heads[1]);
    }

    #[test]
    fn distances_near_and_far_are_those_to_the_mesh() {
        let head = mannequin();
        let (low, high) = mannequin::FRAME;
        for i in 0..60 {
            let a = f64::from(i);
            let way = DVec3::new((1.3 * a).sin(), (2.1 * a).sin(), (0.7 * a).sin());
            let p = 0.5 * (low + high) + 0.5 * way * (high - low + DVec3::splat(0.08));
            let faces = 0..head.surface().triangles().len();
            let exact = faces
                .map(|f| triangles::closest_point(p, head.surface().corners(f)).distance(p))
                .fold(f64::INFINITY, f64::min);
            let found = head.signed_distance().value(p).abs();
            // Deep in the torso the coarser grid rounds the crease where two sides are equally far.
            let most = if p.z > mannequin::NECK { 1.5e-3 } else { 6e-3 };
            assert!((found - exact).abs() < most, "{found}, not {exact}, at {p}");
        }
    }

    #[test]
    fn regions_are_where_a_hairdresser_looks_for_them() {
        let l = mannequin().landmarks();
        for (region, p) in [
            (Region::Fringe, l.hairline),
            (Region::Top, DVec3::new(0.0, -0.01, 0.11)),
            (Region::Crown, l.whorl),
            (Region::Sides, DVec3::new(0.075, 0.0, 0.03)),
            (Region::Sides, DVec3::new(-0.075, 0.0, 0.03)),
            (Region::Back, DVec3::new(0.0, 0.097, 0.0)),
            (Region::Nape, l.nape),
        ] {
            assert_eq!(l.region(p), region, "{p}");
        }
    }

    fn nearest_weight(head: &Head, p: DVec3) -> f64 {
        let near = head.surface().positions().iter().zip(head.scalp());
        *near.min_by(|a, b| a.0.distance(p).total_cmp(&b.0.distance(p))).unwrap().1
    }

    fn scalp_area(head: &Head) -> f64 {
        let weight = |t: &[u32; 3]| t.iter().map(|&v| head.scalp()[v as usize]).sum::<f64>() / 3.0;
        let area = |i: usize| 0.5 * head.surface().doubled_area_vector(i).length();
        head.surface().triangles().iter().enumerate().map(|(i, t)| area(i) * weight(t)).sum()
    }
}
