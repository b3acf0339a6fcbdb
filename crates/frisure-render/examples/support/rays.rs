//! Rays as a path tracer sends them at a head of hair.

#![allow(dead_code, reason = "shared by programs that each use a part")]
#![allow(unreachable_pub, reason = "as above")]

use std::f32::consts::TAU;

use frisure_look::Camera;
use frisure_render::accel::{Hit, Ray, SceneBvh};
use glam::{DVec3, Vec3};

const SIDE: u32 = 512;

/// Rays of each kind.
pub struct Rays {
    /// From the eye, through 512² pixels.
    pub primary: Vec<Ray>,
    /// In random directions from what those meet.
    pub bounce: Vec<Ray>,
    /// From there to a lamp.
    pub shadow: Vec<Ray>,
}

impl Rays {
    pub fn new(scene: &SceneBvh) -> Self {
        let primary = primary(scene);
        let hits: Vec<Hit> =
            primary.iter().filter_map(|r| scene.closest_hit(r, f32::INFINITY)).collect();
        let from = |(i, hit): (usize, &Hit)| Ray::new(hit.ray_origin(direction(i)), direction(i));
        let bounce = hits.iter().enumerate().map(from).collect();
        let lamp = Vec3::new(-0.5, -0.6, 0.7).normalize();
        let shadow = hits.iter().map(|hit| Ray::new(hit.ray_origin(lamp), lamp)).collect();
        Self { primary, bounce, shadow }
    }
}

/// The picture that a portrait camera takes.
fn primary(scene: &SceneBvh) -> Vec<Ray> {
    let Some((low, high)) = scene.bounds() else { return Vec::new() };
    let camera = Camera::framing((low.as_dvec3(), high.as_dvec3()), 0.5, 0.08, 1.0);
    let tan = (0.5 * camera.vertical_fov()).tan();
    let across = |i: u32| (f64::from(2 * i + 1) / f64::from(SIDE) - 1.0) * tan;
    let towards = |x: u32, y: u32| -> DVec3 {
        camera.forward() + across(x) * camera.right() - across(y) * camera.up()
    };
    let eye = camera.eye().as_vec3();
    (0..SIDE * SIDE).map(|i| Ray::new(eye, towards(i % SIDE, i / SIDE).as_vec3())).collect()
}

/// Directions spread evenly over the sphere (the additive recurrence of the plastic number).
fn direction(i: usize) -> Vec3 {
    let [u, v] = [0.754_877_666_f64, 0.569_840_291].map(|a| (a * i as f64).fract() as f32);
    let z = 2.0 * u - 1.0;
    let r = (1.0 - z * z).max(0.0).sqrt();
    Vec3::new(r * (TAU * v).cos(), r * (TAU * v).sin(), z)
}
