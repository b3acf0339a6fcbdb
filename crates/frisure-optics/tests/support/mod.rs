//! Numbers, directions and sums that several tests need.
#![allow(dead_code, reason = "each test uses some of it")]

use std::f32::consts::{PI, TAU};

use frisure_optics::scattering::{Fibre, FibreSpec, HairBsdf};
use glam::{DVec3, Vec3};

/// A small generator of random numbers (Steele et al. 2014, SplitMix64): the same ones every time.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// In [0, 1).
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Four of them, below 1 in `f32` too.
    pub(crate) fn four(&mut self) -> [f32; 4] {
        [(); 4].map(|()| (self.next() as f32).min(0.999_999_9))
    }

    /// Of the normal distribution.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * (1.0 - self.next()).ln()).sqrt();
        radius * (std::f64::consts::TAU * self.next()).cos()
    }
}

/// A local direction of inclination and azimuth (rad).
pub(crate) fn direction(theta: f32, phi: f32) -> Vec3 {
    Vec3::new(theta.cos() * phi.cos(), theta.cos() * phi.sin(), theta.sin())
}

/// A fibre without absorption.
pub(crate) fn white(axis_ratio: f32, beta_m: f32, beta_n: f32) -> FibreSpec {
    FibreSpec {
        axis_ratio,
        longitudinal_roughness: beta_m,
        azimuthal_roughness: beta_n,
        ..Default::default()
    }
}

/// ∫ f cos dω (green) and ∫ pdf dω of one hit, by the midpoint rule.
pub(crate) fn integrals(fibre: &Fibre, wo: Vec3, h: f32, (n, m): (u16, u16)) -> (f64, f64) {
    let hit = HairBsdf::new(fibre, wo, h);
    let (mut energy, mut density) = (0.0, 0.0);
    for i in 0..n {
        let theta = PI * ((f32::from(i) + 0.5) / f32::from(n) - 0.5);
        for j in 0..m {
            let at = hit.evaluate(direction(theta, TAU * (f32::from(j) + 0.5) / f32::from(m)));
            energy += f64::from(at.f_cos.y * theta.cos());
            density += f64::from(at.pdf * theta.cos());
        }
    }
    let cell = f64::from(PI / f32::from(n) * TAU / f32::from(m));
    (energy * cell, density * cell)
}

/// How a ray left a dielectric cylinder.
pub(crate) struct Exit {
    /// Direction.
    pub(crate) to: DVec3,
    /// Number of ways through the inside: 0 R, 1 TT, 2 TRT and so on.
    pub(crate) ways: usize,
}

/// Follows one ray through an elliptical cylinder along z, by Snell and Fresnel in space; `tilt` gives
/// the angle by which the normal is turned about z at each meeting.
pub(crate) fn follow(
    (a, b): (f64, f64),
    index: f64,
    (mut at, mut to): (DVec3, DVec3),
    random: &mut Random,
    mut tilt: impl FnMut(&mut Random) -> f64,
) -> Option<Exit> {
    let mut inside = false;
    for meeting in 0..200 {
        let smooth = DVec3::new(at.x / (a * a), at.y / (b * b), 0.0).normalize();
        let (s, c) = tilt(random).sin_cos();
        let normal = DVec3::new(smooth.x * c - smooth.y * s, smooth.x * s + smooth.y * c, 0.0);
        let ratio = if inside { index } else { 1.0 / index };
        let facing = if inside { -normal } else { normal };
        let cosine = -to.dot(facing);
        if cosine <= 0.0 {
            return None;
        }
        let sine2 = ratio * ratio * (1.0 - cosine * cosine);
        let far = (1.0 - sine2).max(0.0).sqrt();
        let crosses = sine2 < 1.0 && random.next() >= fresnel(cosine, far, ratio);
        if crosses {
            to = (to * ratio + facing * (ratio * cosine - far)).normalize();
            inside = !inside;
        } else {
            to += facing * (2.0 * cosine);
        }
        if !inside {
            // A rough surface may send it back in; such rays are few and are left out.
            return (to.dot(smooth) > 0.0).then_some(Exit { to, ways: meeting });
        }
        let (u, v) = (DVec3::new(at.x / a, at.y / b, 0.0), DVec3::new(to.x / a, to.y / b, 0.0));
        let length = -2.0 * u.dot(v) / v.length_squared();
        if length <= 0.0 {
            return None;
        }
        at += to * length;
    }
    None
}

/// Reflectance at cosines on both sides, for the ratio of the near index to the far one.
fn fresnel(near: f64, far: f64, ratio: f64) -> f64 {
    let s = (ratio * near - far) / (ratio * near + far);
    let p = (near - ratio * far) / (near + ratio * far);
    0.5 * (s * s + p * p)
}

/// Where a ray to unit `eye` meets the ellipse first, at offset `h`: found on a line of the section,
/// by the quadratic.
pub(crate) fn meet((a, b): (f64, f64), eye: DVec3, h: f64) -> DVec3 {
    let e = DVec3::new(eye.x, eye.y, 0.0).normalize();
    let across = e.cross(DVec3::Z);
    let width = ((a * across.x).powi(2) + (b * across.y).powi(2)).sqrt();
    let start = across * (h * width);
    let q = |u: DVec3, v: DVec3| u.x * v.x / (a * a) + u.y * v.y / (b * b);
    let (two, one, none) = (q(e, e), q(start, e), q(start, start) - 1.0);
    start + e * ((-one + (one * one - two * none).max(0.0).sqrt()) / two)
}
