//! Lights approximated by directions: each lamp as a delta light, the environment by a few radiances.

use std::f32::consts::{PI, TAU};

use frisure_look::{EnvironmentLight, EnvironmentMap, Lights};
use glam::{DVec3, Vec3};

use super::directions::{DIRECTION_COUNT, directions};

/// The lights of a scene as one point has them: lamps by direction, the environment by a few radiances.
#[derive(Clone, Debug, PartialEq)]
pub struct DirectionalLights {
    /// Unit direction to each lamp, and irradiance on a surface that faces it.
    pub lamps: Vec<(Vec3, Vec3)>,
    /// Mean radiance of the environment about each of fourteen directions (Lebedev's rule).
    pub environment: [Vec3; DIRECTION_COUNT],
}

/// Most lamps that an environment map becomes; chosen.
const FOUND: usize = 3;

/// Radiance of a spot that becomes a lamp, over the mean; chosen by trial.
const BRIGHT: f32 = 12.0;

/// Cosine of the angular radius of a spot that becomes one lamp: 15°; chosen.
const APART: f32 = 0.966;

impl DirectionalLights {
    /// Approximates lights as `place` (m) has them: the brightest spots of an environment map become lamps.
    #[must_use]
    pub fn new(lights: &Lights, place: DVec3) -> Self {
        let around = directions();
        let arriving = lights.lamps.iter().filter_map(|lamp| lamp.arriving(place));
        let lit = arriving.filter(|(_, irradiance)| irradiance.max_element() > 0.0);
        let mut lamps: Vec<_> = lit.map(|(towards, e)| (towards.as_vec3(), e)).collect();
        let environment = match &lights.environment {
            environment @ EnvironmentLight::Gradient { .. } => {
                around.map(|(towards, _)| environment.radiance(towards))
            }
            EnvironmentLight::Map(map) => {
                let (bright, rest) = split(map);
                lamps.extend(bright);
                spread(&rest, &around)
            }
        };
        Self { lamps, environment }
    }
}

/// A part of an environment: direction, radiance, solid angle (sr).
type Part = (Vec3, Vec3, f32);

/// Number of parts of an environment map of few pixels: 2.2° apart. Chosen.
const FEW: usize = 8192;

/// Small parts of an environment map: its pixels, or finer.
fn parts(map: &EnvironmentMap) -> Box<dyn Iterator<Item = Part> + '_> {
    if map.pixel_count() >= FEW {
        return Box::new(map.pixels());
    }
    // A Fibonacci spiral: uniform steps in z, turned by the golden angle each.
    let solid = 4.0 * PI / FEW as f32;
    Box::new((0..FEW).map(move |i| {
        let z = 1.0 - (2.0 * i as f32 + 1.0) / FEW as f32;
        let (sin, cos) = (TAU * (i as f32 * 0.618_034).fract()).sin_cos();
        let r = (1.0 - z * z).sqrt();
        let towards = Vec3::new(r * cos, r * sin, z);
        (towards, map.radiance(towards), solid)
    }))
}

/// Splits an environment map into its brightest spots, as lamps, and the rest.
fn split(map: &EnvironmentMap) -> (Vec<(Vec3, Vec3)>, Vec<Part>) {
    let threshold = BRIGHT * map.mean().element_sum();
    let (mut bright, mut rest): (Vec<Part>, Vec<Part>) =
        parts(map).partition(|(_, radiance, _)| radiance.element_sum() > threshold);
    let mut lamps = Vec::new();
    while lamps.len() < FOUND && !bright.is_empty() {
        let by_light = |a: &&Part, b: &&Part| a.1.element_sum().total_cmp(&b.1.element_sum());
        let Some(&(top, ..)) = bright.iter().max_by(by_light) else { break };
        let (near, far) = bright.into_iter().partition(|(d, ..)| d.dot(top) >= APART);
        let near: Vec<Part> = near;
        let light: Vec3 = near.iter().map(|(_, radiance, solid)| *radiance * *solid).sum();
        let middle: Vec3 = near.iter().map(|(d, l, solid)| *d * (l.element_sum() * solid)).sum();
        lamps.push((middle.normalize_or(top), light));
        bright = far;
    }
    rest.extend(bright);
    (lamps, rest)
}

/// Mean radiance about each direction: of the parts nearest to it, scaled so that the total light is kept.
fn spread(parts: &[Part], around: &[(Vec3, f32); DIRECTION_COUNT]) -> [Vec3; DIRECTION_COUNT] {
    const N: usize = DIRECTION_COUNT;
    let (mut light, mut solid) = ([Vec3::ZERO; N], [0.0_f32; N]);
    for (towards, radiance, of) in parts {
        let nearness = |(d, _): &(Vec3, f32)| d.dot(*towards);
        let nearest = (0..N).max_by(|a, b| nearness(&around[*a]).total_cmp(&nearness(&around[*b])));
        let Some(i) = nearest else { continue };
        light[i] += *radiance * *of;
        solid[i] += *of;
    }
    let whole: Vec3 = light.iter().sum();
    let mut means = [Vec3::ZERO; N];
    for i in 0..N {
        means[i] = light[i] / solid[i].max(1e-9);
    }
    let found: Vec3 = means.iter().zip(around).map(|(mean, (_, weight))| *mean * *weight).sum();
    // Means about directions, weighted by the quadrature, differ from the true mean: one factor by colour mends that.
    let factor = whole / (4.0 * PI) / found.max(Vec3::splat(1e-20));
    means.map(|mean| mean * factor)
}

#[cfg(test)]
mod tests {
    use super::*;
    use frisure_look::{Lamp, PointLight};

    fn fluence(lights: &DirectionalLights) -> Vec3 {
        let weighted = lights.environment.iter().zip(directions()).map(|(l, (_, w))| *l * w);
        lights.lamps.iter().map(|l| l.1).sum::<Vec3>() + 4.0 * PI * weighted.sum::<Vec3>()
    }

    #[test]
    fn all_light_of_an_environment_is_kept_and_its_sun_becomes_a_lamp() {
        for (width, height, sun) in [(1, 1, 0), (8, 4, 13), (256, 128, 5000)] {
            let mut pixels = vec![[0.2, 0.3, 0.5]; width * height];
            pixels[sun] = [900.0, 800.0, 600.0];
            let map = EnvironmentMap::new(width, height, pixels).unwrap();
            let mean = map.mean();
            let lights = Lights { lamps: Vec::new(), environment: EnvironmentLight::Map(map) };
            let plain = DirectionalLights::new(&lights, DVec3::ZERO);
            let ratio = fluence(&plain) / (4.0 * PI * mean);
            assert!((ratio - Vec3::ONE).abs().max_element() < 0.02, "{width}: {ratio}");
            assert_eq!(plain.lamps.is_empty(), width == 1);
            // A pixel of 1.4° is one lamp.
            assert!(width != 256 || plain.lamps.len() == 1);
        }
    }

    #[test]
    fn a_lamp_at_a_place_is_seen_from_there() {
        let lamp: Lamp = PointLight::new(DVec3::X * 2.0, Vec3::splat(8.0)).unwrap().into();
        let lights = Lights { lamps: vec![lamp], ..Lights::dark() };
        let plain = DirectionalLights::new(&lights, DVec3::ZERO);
        assert_eq!(plain.lamps, [(Vec3::X, Vec3::splat(2.0))]);
        assert_eq!(plain.environment, [Vec3::ZERO; DIRECTION_COUNT]);
    }
}
