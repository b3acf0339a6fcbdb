//! A training head, modelled by code.
//!
//! The sculpture works in centimetres and in a frame for people: x sideways (mirrored: only the left
//! half is described), y forward to the face, z up; the origin is the centre of the cranium.
//! Proportions are those of an adult: 15.5 cm wide, 19.5 cm deep, 23 cm from chin to vertex, eyes at
//! half height, ears between brow and base of the nose.

use frisure_strands::Surface;
use glam::{DMat3, DVec3, dvec3};

use super::landmarks::Landmarks;
use super::mesher::{Lattice, mesh};
use super::sculpt::{carve, chain, cone, ellipsoid, join, meet, turned};

/// The mannequin's skin (m), about 60 000 triangles.
pub(crate) fn surface() -> Surface {
    mesh(&lattice(), |p| 0.01 * head(dvec3(p.x.abs(), -p.y, p.z) * 100.0))
}

/// Where things are on the mannequin.
pub(crate) fn landmarks() -> Landmarks {
    let at = |x: f64, forward: f64, z: f64| dvec3(x, -forward, z) * 0.01;
    Landmarks {
        cranium_centre: DVec3::ZERO,
        cranium_radii: dvec3(0.0775, 0.0975, 0.11),
        whorl: at(0.0, -6.9, 8.0),
        face: -DVec3::Y,
        width: 0.155,
        hairline: at(0.0, 8.1, 7.3),
        brow: at(0.0, 9.8, 1.5),
        ear: at(7.6, -1.5, -2.0),
        nape: at(0.0, -6.4, -8.8),
    }
}

/// Fine where the face is, coarse at the shoulders (m).
fn lattice() -> Lattice {
    let across = |x: f64| if x.abs() < 0.095 { 2.2e-3 } else { 4.5e-3 };
    let along = |y: f64| if y < -0.06 { 2.0e-3 } else { 3.0e-3 };
    let up = |z: f64| match z {
        z if z < -0.13 => 4.5e-3,
        z if z < 0.025 => 1.9e-3,
        _ => 3.2e-3,
    };
    let right = Lattice::axis(0.0, 0.215, across);
    let left = right.iter().skip(1).rev().map(|x| -x);
    let x = left.chain(right.iter().copied()).collect();
    Lattice { axes: [x, Lattice::axis(-0.135, 0.145, along), Lattice::axis(-0.285, 0.125, up)] }
}

fn head(p: DVec3) -> f64 {
    let skull = join(cranium(p), face(p), 2.4);
    let body = join(join(skull, neck(p), 2.2), shoulders(p), 2.5);
    let features = mouth(p, nose(p, eyes(p, body)));
    let whole = join(features, ear(p), 0.5);
    // The bust stands on a flat foot.
    meet(whole, -27.0 - p.z, 1.2)
}

fn cranium(p: DVec3) -> f64 {
    let back = ellipsoid(p, dvec3(0.0, -1.7, 2.2), dvec3(7.5, 8.0, 8.5));
    let front = ellipsoid(p, dvec3(0.0, 1.5, 2.4), dvec3(6.7, 8.0, 8.25));
    join(back, front, 2.5)
}

fn face(p: DVec3) -> f64 {
    let mask = ellipsoid(p, dvec3(0.0, 3.2, -3.6), dvec3(5.8, 5.6, 7.0));
    let muzzle = ellipsoid(p, dvec3(0.0, 5.6, -7.2), dvec3(3.6, 3.7, 3.6));
    let cheek = turned(p, dvec3(4.3, 5.6, -3.6), dvec3(1.7, 2.0, 1.5), 0.0, 0.5);
    let arch = cone(p, dvec3(4.6, 5.8, -2.8), dvec3(6.2, 1.5, -2.3), 0.9, 0.7);
    let jaw = chain(
        p,
        &[
            (dvec3(5.2, 0.6, -4.5), 1.0),
            (dvec3(4.7, 1.6, -8.0), 1.2),
            (dvec3(2.6, 6.2, -10.6), 1.1),
            (dvec3(0.0, 7.7, -10.9), 1.1),
        ],
    );
    let chin = ellipsoid(p, dvec3(0.0, 7.7, -10.4), dvec3(1.9, 1.5, 1.4));
    let floor = ellipsoid(p, dvec3(0.0, 3.2, -8.2), dvec3(4.3, 4.6, 3.0));
    let brow = chain(
        p,
        &[(dvec3(0.7, 8.95, 1.2), 0.6), (dvec3(3.0, 8.5, 1.5), 0.6), (dvec3(5.0, 6.8, 0.9), 0.5)],
    );
    let f = join(join(mask, muzzle, 2.0), join(cheek, arch, 1.0), 2.5);
    let f = join(f, join(jaw, floor, 2.0), 2.5);
    join(join(f, chin, 1.6), brow, 1.8)
}

fn eyes(p: DVec3, skin: f64) -> f64 {
    let socket = turned(p, dvec3(3.2, 9.7, -0.9), dvec3(2.0, 1.7, 1.25), 0.0, -0.25);
    let inner = ellipsoid(p, dvec3(1.6, 9.9, -0.5), dvec3(0.7, 1.2, 0.9));
    let f = carve(carve(skin, socket, 1.4), inner, 1.0);
    let centre = dvec3(3.15, 6.9, -1.05);
    let ball = (p - centre).length() - 1.32;
    let f = join(f, ball, 0.5);
    // Closed lids: the upper one is thicker and overhangs the lower one along a curved line.
    let seam = -0.42 - 0.10 * ((p.x - 3.1) / 1.3).powi(2) * -3.0;
    let upper = meet((p - centre).length() - 1.42, seam - (p.z - centre.z), 0.12);
    join(f, upper, 0.12)
}

fn nose(p: DVec3, skin: f64) -> f64 {
    let bridge = chain(
        p,
        &[
            (dvec3(0.0, 8.9, 0.6), 0.75),
            (dvec3(0.0, 9.6, -1.2), 0.65),
            (dvec3(0.0, 10.7, -3.4), 0.75),
            (dvec3(0.0, 11.05, -4.2), 0.85),
        ],
    );
    let side = cone(p, dvec3(0.5, 8.6, -0.6), dvec3(1.0, 9.3, -4.2), 0.5, 1.0);
    let wing = turned(p, dvec3(1.25, 9.75, -4.75), dvec3(0.65, 1.0, 0.7), 0.2, 0.35);
    let column = cone(p, dvec3(0.0, 10.9, -4.6), dvec3(0.0, 9.6, -5.3), 0.4, 0.4);
    let f = join(join(bridge, side, 1.2), wing, 0.5);
    let f = join(skin, join(f, column, 0.4), 0.9);
    let nostril = turned(p, dvec3(0.62, 10.25, -5.45), dvec3(0.33, 0.6, 0.5), 0.2, 0.35);
    carve(f, nostril, 0.25)
}

fn mouth(p: DVec3, skin: f64) -> f64 {
    let upper = chain(
        p,
        &[
            (dvec3(0.0, 9.75, -7.0), 0.38),
            (dvec3(0.6, 9.75, -6.95), 0.42),
            (dvec3(2.4, 8.4, -7.5), 0.25),
        ],
    );
    let lower = chain(
        p,
        &[
            (dvec3(0.0, 9.45, -8.0), 0.55),
            (dvec3(0.9, 9.3, -7.95), 0.5),
            (dvec3(2.3, 8.35, -7.6), 0.25),
        ],
    );
    let fold = cone(p, dvec3(0.0, 9.9, -9.15), dvec3(1.6, 9.2, -9.0), 0.65, 0.5);
    let groove = cone(p, dvec3(0.0, 10.55, -5.9), dvec3(0.0, 10.6, -6.5), 0.3, 0.3);
    let slit = chain(
        p,
        &[
            (dvec3(0.0, 10.1, -7.48), 0.1),
            (dvec3(0.9, 9.85, -7.42), 0.1),
            (dvec3(2.5, 8.7, -7.55), 0.08),
        ],
    );
    let f = carve(carve(skin, fold, 0.9), groove, 0.4);
    let f = join(f, join(upper, lower, 0.15), 0.35);
    carve(f, slit, 0.25)
}

fn ear(p: DVec3) -> f64 {
    // u backwards and outwards, v up and a little backwards, w away from the skull.
    let frame = DMat3::from_rotation_z(-0.40) * DMat3::from_rotation_x(0.17);
    let q = frame.transpose() * (p - dvec3(7.2, -1.3, -2.0));
    let q = dvec3(-q.y, q.z, q.x);
    if q.length() > 6.0 {
        return q.length() - 4.0;
    }
    let plate = ellipsoid(q, dvec3(0.25, 0.1, 0.0), dvec3(1.6, 3.0, 0.45));
    let helix = chain(
        q,
        &[
            (dvec3(-0.9, -0.1, 0.25), 0.2),
            (dvec3(-1.1, 1.3, 0.35), 0.27),
            (dvec3(-0.5, 2.6, 0.40), 0.30),
            (dvec3(0.6, 3.0, 0.45), 0.30),
            (dvec3(1.6, 2.2, 0.45), 0.30),
            (dvec3(1.85, 0.8, 0.40), 0.28),
            (dvec3(1.45, -0.8, 0.32), 0.26),
            (dvec3(0.7, -2.0, 0.20), 0.28),
        ],
    );
    let fold = chain(
        q,
        &[
            (dvec3(0.3, 1.7, 0.3), 0.25),
            (dvec3(0.95, 0.6, 0.35), 0.3),
            (dvec3(0.7, -0.7, 0.35), 0.3),
            (dvec3(0.0, -1.35, 0.35), 0.25),
        ],
    );
    let lobe = ellipsoid(q, dvec3(-0.1, -2.5, 0.1), dvec3(0.85, 0.85, 0.35));
    let concha = ellipsoid(q, dvec3(-0.15, -0.3, 0.55), dvec3(0.75, 0.95, 0.75));
    let tragus = ellipsoid(q, dvec3(-1.0, -0.5, 0.3), dvec3(0.35, 0.5, 0.4));
    let f = join(join(plate, lobe, 0.6), fold, 0.35);
    let f = join(carve(f, concha, 0.35), helix, 0.3);
    join(f, tragus, 0.3)
}

fn neck(p: DVec3) -> f64 {
    let column = cone(p, dvec3(0.0, -1.4, -6.0), dvec3(0.0, -2.8, -16.0), 4.75, 5.2);
    let strap = cone(p, dvec3(4.6, -2.4, -6.5), dvec3(1.0, 1.9, -17.6), 0.9, 0.8);
    let throat = ellipsoid(p, dvec3(0.0, 2.3, -13.2), dvec3(0.9, 0.9, 1.6));
    let trapezius = chain(
        p,
        &[
            (dvec3(1.8, -5.2, -8.0), 1.6),
            (dvec3(4.2, -5.2, -15.0), 2.2),
            (dvec3(12.0, -4.2, -19.6), 2.2),
        ],
    );
    join(join(join(column, strap, 1.2), throat, 1.2), trapezius, 3.5)
}

fn shoulders(p: DVec3) -> f64 {
    let chest = ellipsoid(p, dvec3(0.0, -3.0, -27.0), dvec3(15.5, 8.2, 9.5));
    let shoulder = ellipsoid(p, dvec3(13.5, -3.8, -23.0), dvec3(6.0, 5.4, 4.6));
    let collar = chain(
        p,
        &[
            (dvec3(1.6, 1.9, -18.8), 0.7),
            (dvec3(7.0, 1.8, -18.8), 0.55),
            (dvec3(14.0, -2.0, -19.0), 0.8),
        ],
    );
    join(join(chest, shoulder, 4.0), collar, 1.5)
}
