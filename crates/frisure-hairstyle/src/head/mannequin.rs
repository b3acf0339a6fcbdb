//! A training head, modelled by code.
//!
//! The sculpture works in centimetres and in a frame for people: x sideways (mirrored: only the left
//! half is described), y forward to the face, z up; the origin is the centre of the cranium.
//! Proportions are those of an adult: 15.5 cm wide, 19.5 cm deep, 23 cm from chin to vertex, eyes at
//! half height, ears between brow and base of the nose.

use fearless_simd::{Level, Select, Simd, SimdBase, dispatch, f64x4};
use frisure_strands::{Features, Surface, Tint};
use glam::{DMat3, DVec3, dvec3};

use super::distance::SignedDistance;
use super::facial_hair::{self, FacialLines};
use super::landmarks::Landmarks;
use super::mesher::{LANES, Lattice, mesh};
use super::sculpt::{Places, carve, chain, changed, cone, ellipsoid, join, meet, turned};

/// The mannequin's skin (m), about 75 000 triangles.
pub(crate) fn surface() -> Surface {
    let level = Level::new();
    mesh(&lattice(), |places| {
        let places = places.map(in_sculpture);
        let values =
            dispatch!(level, simd => <[f64; LANES]>::from(head(Places::new(simd, places))));
        values.map(|value| 0.01 * value)
    })
}

/// A place (m) in the sculpture's frame (cm).
fn in_sculpture(p: DVec3) -> DVec3 {
    dvec3(p.x.abs(), -p.y, p.z) * 100.0
}

/// Where things are on the mannequin.
pub(crate) fn landmarks() -> Landmarks {
    let at = |x: f64, forward: f64, z: f64| dvec3(x, -forward, z) * 0.01;
    Landmarks {
        cranium_centre: DVec3::ZERO,
        cranium_radii: dvec3(0.0775, 0.0975, 0.11),
        upright: DMat3::IDENTITY,
        whorl: at(0.0, -6.9, 8.0),
        face: -DVec3::Y,
        width: 0.155,
        hairline: at(0.0, 8.1, 7.3),
        brow: at(0.0, 9.8, 1.5),
        ear: at(7.6, -1.5, -2.0),
        nape: at(0.0, -6.4, -8.8),
    }
}

/// Lips, cheeks, brows and the lashes of the closed lids.
pub(crate) fn features(surface: &Surface, skin: &SignedDistance) -> Features {
    // A start in front of the skin, moved onto it.
    let place = |x: f64, forward: f64, z: f64| {
        let mut p = dvec3(x, -forward, z) * 0.01;
        for _ in 0..4 {
            let (distance, out) = skin.value_gradient(p);
            p -= out * (distance / out.length_squared().max(0.25));
        }
        p
    };
    let brow = [(1.2, 9.6, 1.5), (2.0, 9.5, 1.75), (2.9, 9.2, 1.95), (3.8, 8.6, 1.95)];
    let brow = brow.into_iter().chain([(4.6, 7.8, 1.7), (5.2, 6.9, 1.2)]);
    // The seam of `eyes`.
    let lid = [-0.95, -0.6, -0.2, 0.2, 0.6, 0.95]
        .map(|a: f64| place(3.2 + 1.5 * a, 8.4 - 0.3 * (a + 0.3).powi(2), -1.63 + 0.4 * a * a));
    let lines = FacialLines {
        brow: brow.map(|(x, y, z)| place(x, y, z)).collect(),
        fullness: 1.0,
        upper: lid.to_vec(),
        lower: Vec::new(),
        eye: dvec3(0.032, -0.0685, -0.0105),
        middle: 0.0,
    };
    let bare = Features { tints: tints(surface.positions()), ..Features::default() };
    facial_hair::grown(bare, &lines, skin)
}

/// The tints of places (m).
fn tints(positions: &[DVec3]) -> Vec<Tint> {
    let level = Level::new();
    let mut tints = Vec::with_capacity(positions.len());
    for chunk in positions.chunks(LANES) {
        let places: [DVec3; LANES] =
            std::array::from_fn(|n| in_sculpture(chunk[n.min(chunk.len() - 1)]));
        // Before the face nothing is red, and most of the mesh is behind it.
        if places.iter().all(|p| p.z < -10.0) {
            tints.extend(chunk.iter().map(|_| Tint::default()));
            continue;
        }
        let [lips, ears] = dispatch!(level, simd => red(Places::new(simd, places)));
        tints.extend((0..chunk.len()).map(|n| tint(places[n], lips[n], ears[n])));
    }
    tints
}

/// How far (cm) places are from the lips and from an ear.
#[inline(always)]
fn red<S: Simd>(p: Places<S>) -> [[f64; LANES]; 2] {
    [upper_lip(p).min(lower_lip(p)).into(), ear(p).into()]
}

/// The tint of a place (cm, in the sculpture's frame), by how far (cm) it is from the lips and from an ear.
fn tint(p: DVec3, lips: f64, ear: f64) -> Tint {
    if p.z < -10.0 {
        return Tint::default();
    }
    let ball = |centre: DVec3, radius: f64| (1.0 - p.distance(centre) / radius).max(0.0);
    let lips = ((0.22 - lips) / 0.2).clamp(0.0, 1.0);
    let cheek = 1.1 * ball(dvec3(4.1, 6.9, -3.9), 3.2);
    let nose = ball(dvec3(0.0, 11.3, -4.3), 1.9);
    let ear = if ear.abs() < 0.1 { 0.7 } else { 0.0 };
    let flush = cheek.max(nose).max(ear).min(1.0);
    Tint { lips: lips as f32, flush: flush as f32, ..Tint::default() }
}

/// Height of the foot (cm).
const FOOT: f64 = -52.5;

/// Height of the lower end of the neck (m): the distance to what is lower comes from a coarser grid.
pub(crate) const NECK: f64 = -0.165;

/// The box (m) that the fine grid of the distance fits: that of the bust without a torso, so that its nodes stay where they
/// were.
pub(crate) const FRAME: (DVec3, DVec3) = (
    dvec3(-0.167_955_203_001_988_57, -0.116_427_103_003_770_85, -0.245),
    dvec3(0.167_955_191_517_644_43, 0.112_732_751_585_463_3, 0.109_319_634_896_746_08),
);

/// Fine where the face is, coarse at the torso (m).
fn lattice() -> Lattice {
    let across = |x: f64| match x.abs() {
        x if x < 0.095 => 2.6e-3,
        x if x < 0.185 => 5.0e-3,
        _ => 8.0e-3,
    };
    let along = |y: f64| if y < -0.06 { 2.3e-3 } else { 3.4e-3 };
    let up = |z: f64| match z {
        z if z < -0.13 => 5.5e-3,
        z if (-0.09..0.0).contains(&z) => 2.0e-3,
        z if z < 0.025 => 2.3e-3,
        _ => 3.9e-3,
    };
    let right = Lattice::axis(0.0, 0.23, across);
    let left = right.iter().skip(1).rev().map(|x| -x);
    let x = left.chain(right.iter().copied()).collect();
    // The head's nodes begin at a height of their own, so that they do not depend on how far down the torso goes.
    let below = (1..=16).rev().map(|n| HEAD_FROM - TORSO_STEP * f64::from(n));
    let z = below.chain(Lattice::axis(HEAD_FROM, 0.125, up)).collect();
    Lattice { axes: [x, Lattice::axis(-0.135, 0.145, along), z] }
}

/// Height (m) from which the nodes of the head begin, and the step between those below it.
const HEAD_FROM: f64 = -0.26;
const TORSO_STEP: f64 = 17.5e-3;

#[inline(always)]
fn head<S: Simd>(p: Places<S>) -> f64x4<S> {
    // Each part is asked for only where it can matter: farther away no fillet reaches it.
    let zero = f64x4::splat(p.x.simd, 0.0);
    let (above, low) = (p.z.simd_gt(-16.0), p.z.simd_lt(6.0));
    let cranium = changed(
        above,
        zero,
        #[inline(always)]
        |_| cranium(p),
    );
    let neck = changed(
        low,
        zero,
        #[inline(always)]
        |_| neck(p),
    );
    let mut f = above.select(cranium, neck);
    let front = above & p.z.simd_lt(9.5) & p.y.simd_gt(-7.5);
    f = changed(
        front,
        f,
        #[inline(always)]
        |f| join(f, face(p), 2.4),
    );
    f = changed(
        above & low,
        f,
        #[inline(always)]
        |f| join(f, neck, 2.6),
    );
    f = changed(
        p.z.simd_lt(-11.0),
        f,
        #[inline(always)]
        |f| join(f, torso(p), 3.0),
    );
    let features = p.y.simd_gt(4.5) & p.z.simd_gt(-11.5) & p.z.simd_lt(3.5);
    f = changed(
        features,
        f,
        #[inline(always)]
        |f| mouth(p, nose(p, eyes(p, f))),
    );
    // The bust stands on a flat foot, above the elbows.
    meet(join(f, ear(p), 0.5), FOOT - p.z, 2.0)
}

#[inline(always)]
fn cranium<S: Simd>(p: Places<S>) -> f64x4<S> {
    let back = ellipsoid(p, dvec3(0.0, -1.7, 2.2), dvec3(7.5, 8.0, 8.5));
    let front = ellipsoid(p, dvec3(0.0, 1.5, 2.4), dvec3(6.7, 8.0, 8.25));
    join(back, front, 2.5)
}

#[inline(always)]
fn face<S: Simd>(p: Places<S>) -> f64x4<S> {
    let mask = ellipsoid(p, dvec3(0.0, 3.2, -3.6), dvec3(5.9, 5.6, 7.0));
    let muzzle = ellipsoid(p, dvec3(0.0, 5.9, -7.0), dvec3(3.4, 3.75, 3.6));
    let cheek = turned(p, dvec3(4.1, 5.6, -3.5), dvec3(1.6, 1.9, 1.4), 0.0, 0.5);
    let flesh = turned(p, dvec3(3.2, 4.8, -6.4), dvec3(2.3, 2.8, 2.9), 0.0, 0.3);
    let arch = cone(p, dvec3(4.4, 5.7, -2.7), dvec3(5.8, 1.5, -2.4), 0.8, 0.5);
    let jaw = chain(
        p,
        [
            (dvec3(5.1, 0.4, -4.0), 1.0),
            (dvec3(4.7, 1.2, -7.0), 1.0),
            (dvec3(3.9, 2.8, -8.7), 0.9),
            (dvec3(2.2, 6.2, -10.4), 1.0),
            (dvec3(0.0, 7.5, -10.8), 1.1),
        ],
    );
    let chin = ellipsoid(p, dvec3(0.0, 7.6, -10.4), dvec3(1.7, 1.55, 1.4));
    let floor = ellipsoid(p, dvec3(0.0, 3.2, -8.2), dvec3(4.0, 4.6, 2.8));
    let brow = chain(
        p,
        [(dvec3(0.6, 8.85, 1.1), 0.35), (dvec3(2.8, 8.45, 1.6), 0.35), (dvec3(5.1, 6.3, 0.7), 0.1)],
    );
    let f = join(join(mask, muzzle, 2.0), join(join(cheek, arch, 1.0), flesh, 2.0), 2.5);
    let f = join(f, join(jaw, floor, 2.5), 3.0);
    join(join(f, chin, 1.6), brow, 2.6)
}

#[inline(always)]
fn eyes<S: Simd>(p: Places<S>, skin: f64x4<S>) -> f64x4<S> {
    let socket = turned(p, dvec3(3.3, 9.6, -0.7), dvec3(1.9, 1.6, 1.05), 0.0, -0.3);
    let inner = ellipsoid(p, dvec3(1.75, 9.6, -0.9), dvec3(0.55, 1.0, 0.7));
    let f = carve(carve(skin, socket, 1.4), inner, 1.0);
    let centre = dvec3(3.2, 6.85, -1.05);
    let lid = turned(p, centre, dvec3(1.75, 1.35, 1.2), 0.0, -0.28);
    let f = join(f, lid, 0.7);
    // Closed lids: the upper one overhangs the lower one along a line that sags in the middle.
    let across = (p.x - centre.x) / 1.5;
    let seam = centre.z - 0.58 + 0.40 * across * across;
    let upper = meet(lid - 0.13, seam - p.z, 0.1);
    let line = lid.abs() + (p.z - seam).abs() + 0.6 * (across * across - 0.5).max(0.0) - 0.07;
    // Only in front: the lid's ellipsoid has a back, too, deep inside.
    let crease = line.max(centre.y + 0.3 - p.y);
    carve(join(f, upper, 0.1), crease, 0.2)
}

#[inline(always)]
fn nose<S: Simd>(p: Places<S>, skin: f64x4<S>) -> f64x4<S> {
    let bridge = chain(
        p,
        [
            (dvec3(0.0, 8.8, 0.8), 0.65),
            (dvec3(0.0, 9.35, -0.9), 0.6),
            (dvec3(0.0, 10.5, -3.3), 0.65),
            (dvec3(0.0, 10.9, -4.15), 0.72),
        ],
    );
    let side = cone(p, dvec3(0.1, 8.3, -0.6), dvec3(0.45, 9.2, -4.4), 0.7, 1.15);
    let wing = turned(p, dvec3(1.1, 9.75, -4.75), dvec3(0.5, 0.9, 0.55), 0.2, 0.35);
    let column = cone(p, dvec3(0.0, 10.8, -4.6), dvec3(0.0, 9.6, -5.3), 0.4, 0.35);
    let f = join(join(bridge, side, 2.2), wing, 0.8);
    let f = join(skin, join(f, column, 0.7), 0.9);
    let nostril = turned(p, dvec3(0.58, 10.1, -5.4), dvec3(0.27, 0.5, 0.35), 0.2, 0.35);
    carve(f, nostril, 0.25)
}

#[inline(always)]
fn upper_lip<S: Simd>(p: Places<S>) -> f64x4<S> {
    chain(
        p,
        [
            (dvec3(0.0, 9.5, -7.05), 0.42),
            (dvec3(0.6, 9.45, -7.0), 0.45),
            (dvec3(2.3, 8.2, -7.33), 0.3),
        ],
    )
}

#[inline(always)]
fn lower_lip<S: Simd>(p: Places<S>) -> f64x4<S> {
    chain(
        p,
        [
            (dvec3(0.0, 9.2, -7.95), 0.55),
            (dvec3(0.9, 9.0, -7.9), 0.5),
            (dvec3(2.2, 8.1, -7.55), 0.3),
        ],
    )
}

#[inline(always)]
fn mouth<S: Simd>(p: Places<S>, skin: f64x4<S>) -> f64x4<S> {
    let (upper, lower) = (upper_lip(p), lower_lip(p));
    let fold = cone(p, dvec3(0.0, 9.9, -9.0), dvec3(1.6, 9.2, -8.9), 0.6, 0.5);
    let groove = cone(p, dvec3(0.0, 10.45, -5.9), dvec3(0.0, 10.4, -6.5), 0.3, 0.3);
    let slit = chain(
        p,
        [
            (dvec3(0.0, 10.0, -7.50), 0.14),
            (dvec3(0.9, 9.76, -7.43), 0.14),
            (dvec3(2.35, 8.75, -7.40), 0.04),
        ],
    );
    let f = carve(carve(skin, fold, 1.2), groove, 0.5);
    let f = join(f, join(upper, lower, 0.15), 0.9);
    carve(f, slit, 0.35)
}

#[inline(always)]
fn ear<S: Simd>(p: Places<S>) -> f64x4<S> {
    // u backwards and outwards, v up and a little backwards, w away from the skull.
    let frame = DMat3::from_rotation_z(-0.33) * DMat3::from_rotation_x(-0.15);
    let q = (p - dvec3(7.1, -1.3, -2.0)).mapped(frame.transpose());
    let q = Places { x: -q.y, y: q.z, z: q.x };
    let away = q.length();
    changed(
        away.simd_le(6.0),
        away - 4.0,
        #[inline(always)]
        |_| ear_near(q),
    )
}

/// The ear at places of its own frame.
#[inline(always)]
fn ear_near<S: Simd>(q: Places<S>) -> f64x4<S> {
    let plate = ellipsoid(q, dvec3(0.25, 0.1, 0.0), dvec3(1.6, 3.0, 0.45));
    let root = ellipsoid(q, dvec3(-0.35, -0.8, -0.8), dvec3(0.9, 2.1, 0.95));
    let helix = chain(
        q,
        [
            (dvec3(-0.9, -0.1, 0.20), 0.2),
            (dvec3(-1.1, 1.3, 0.30), 0.26),
            (dvec3(-0.5, 2.6, 0.36), 0.28),
            (dvec3(0.6, 3.0, 0.42), 0.28),
            (dvec3(1.5, 2.3, 0.42), 0.28),
            (dvec3(1.80, 0.9, 0.38), 0.27),
            (dvec3(1.45, -0.8, 0.24), 0.28),
            (dvec3(0.6, -2.0, 0.10), 0.30),
        ],
    );
    let fold = chain(
        q,
        [
            (dvec3(0.3, 1.7, 0.3), 0.25),
            (dvec3(0.95, 0.6, 0.32), 0.3),
            (dvec3(0.7, -0.7, 0.32), 0.3),
            (dvec3(0.0, -1.35, 0.32), 0.25),
        ],
    );
    let lobe = ellipsoid(q, dvec3(-0.2, -2.4, -0.1), dvec3(0.85, 0.85, 0.42));
    let concha = ellipsoid(q, dvec3(-0.1, -0.3, 0.5), dvec3(0.85, 1.05, 0.62));
    let tragus = ellipsoid(q, dvec3(-1.0, -0.5, 0.2), dvec3(0.35, 0.55, 0.4));
    let f = join(join(join(plate, root, 0.6), lobe, 0.6), fold, 0.35);
    let f = join(carve(f, concha, 0.35), helix, 0.3);
    join(f, tragus, 0.3)
}

#[inline(always)]
fn neck<S: Simd>(p: Places<S>) -> f64x4<S> {
    let column = cone(p, dvec3(0.0, -1.7, -6.0), dvec3(0.0, -3.2, -16.0), 4.3, 4.7);
    let strap = cone(p, dvec3(3.9, -2.6, -5.5), dvec3(0.9, 1.2, -17.2), 0.8, 0.7);
    let throat = ellipsoid(p, dvec3(0.0, 1.2, -12.8), dvec3(1.0, 0.9, 1.6));
    let nape = ellipsoid(p, dvec3(0.0, -4.6, -7.0), dvec3(3.6, 2.6, 5.5));
    let trapezius = chain(
        p,
        [
            (dvec3(1.8, -5.2, -8.0), 1.5),
            (dvec3(3.8, -5.4, -15.0), 2.0),
            (dvec3(10.5, -4.8, -19.0), 2.0),
        ],
    );
    let f = join(join(column, strap, 1.6), throat, 2.2);
    join(join(f, nape, 2.5), trapezius, 3.5)
}

#[inline(always)]
fn torso<S: Simd>(p: Places<S>) -> f64x4<S> {
    let ribs = ellipsoid(p, dvec3(0.0, -1.2, -33.0), dvec3(14.0, 10.2, 17.5));
    let waist = ellipsoid(p, dvec3(0.0, -0.6, -50.0), dvec3(12.4, 8.8, 15.0));
    let plate = cone(p, dvec3(2.5, -1.6, -24.5), dvec3(11.0, -2.4, -24.8), 6.0, 4.6);
    let pectoral = turned(p, dvec3(6.2, 5.0, -29.5), dvec3(6.0, 3.0, 5.4), 0.3, -0.25);
    let blade = turned(p, dvec3(7.8, -8.0, -28.0), dvec3(4.6, 2.3, 7.2), -0.12, 0.28);
    let spine = cone(p, dvec3(0.0, -12.3, -24.0), dvec3(0.0, -10.6, -47.0), 0.5, 0.5);
    let f = join(join(ribs, waist, 6.0), plate, 4.0);
    let f = carve(join(join(f, pectoral, 4.5), blade, 4.0), spine, 6.0);
    let f = join(join(f, trapezius(p), 4.0), upper_arm(p), 4.0);
    join(f, collar_bone(p), 2.0)
}

/// The muscle from the neck over the shoulder, and down beside the spine.
#[inline(always)]
fn trapezius<S: Simd>(p: Places<S>) -> f64x4<S> {
    let over = cone(p, dvec3(10.5, -4.6, -19.6), dvec3(15.0, -3.4, -20.9), 2.2, 2.0);
    let down = cone(p, dvec3(2.5, -7.0, -19.0), dvec3(1.5, -8.6, -32.0), 3.2, 1.6);
    join(over, down, 4.0)
}

#[inline(always)]
fn upper_arm<S: Simd>(p: Places<S>) -> f64x4<S> {
    let deltoid = ellipsoid(p, dvec3(15.6, -2.9, -24.8), dvec3(4.3, 4.7, 6.0));
    let arm = cone(p, dvec3(16.0, -3.1, -27.0), dvec3(17.4, -3.6, -54.0), 4.1, 3.7);
    join(deltoid, arm, 4.0)
}

#[inline(always)]
fn collar_bone<S: Simd>(p: Places<S>) -> f64x4<S> {
    chain(
        p,
        [
            (dvec3(1.9, 2.2, -20.2), 0.75),
            (dvec3(6.5, 2.5, -19.6), 0.6),
            (dvec3(11.0, 0.2, -19.4), 0.65),
            (dvec3(14.5, -2.2, -20.1), 0.8),
        ],
    )
}
