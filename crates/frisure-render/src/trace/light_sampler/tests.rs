use glam::DVec3;

use super::*;
use crate::trace::sampler::Sampler;
use frisure_look::{Camera, Daylight, DistantLight, PointLight};

const PLACE: Vec3 = Vec3::new(0.03, -0.05, 0.02);

/// Lights of all kinds, by what they are.
fn kinds() -> Vec<(&'static str, Lights)> {
    let mut pixels = vec![[0.1, 0.2, 0.3]; 32 * 16];
    pixels[32 * 5 + 7] = [400.0, 300.0, 100.0];
    pixels[32 * 9..][..32].fill([0.0; 3]);
    let map = EnvironmentMap::new(32, 16, pixels).unwrap().turned(0.7).scaled(1.5);
    let disc = AreaLight::disc(DVec3::new(0.4, -0.3, 0.5), -DVec3::ONE, 0.2, Vec3::splat(9.0));
    let (x, side) = (DVec3::X, [0.3, 0.8]);
    let square = AreaLight::rectangle(DVec3::new(-0.6, 0.1, 0.0), x, DVec3::Z, side, Vec3::ONE);
    let point = PointLight::new(DVec3::new(0.0, 1.0, 1.0), Vec3::splat(2.0));
    let wide = DistantLight::new(DVec3::Y, Vec3::new(1.0, 2.0, 3.0), 0.8).unwrap();
    let environment =
        EnvironmentLight::Gradient { sky: Vec3::new(0.5, 0.6, 0.9), ground: Vec3::splat(0.1) };
    let local = vec![disc.unwrap().into(), square.unwrap().into()];
    let mut all = local.clone();
    all.extend([Lamp::from(point.unwrap()), wide.into()]);
    let map = EnvironmentLight::Map(map);
    vec![
        ("studio", Lights::studio(&Camera::default())),
        ("environment", Lights { lamps: Vec::new(), environment: environment.clone() }),
        ("map", Lights { lamps: Vec::new(), environment: map.clone() }),
        ("local", Lights { lamps: local, ..Lights::dark() }),
        ("all", Lights { lamps: all.clone(), environment }),
        ("all and map", Lights { lamps: all, environment: map }),
    ]
}

/// Numbers for the sample of an index.
fn numbers(index: u32) -> (f32, [f32; 2]) {
    let mut sampler = Sampler::new(3, 11, index);
    (sampler.one(), sampler.pair())
}

/// Directions all over the sphere, in cells of a grid, and the solid angle of each.
const FINE: u32 = 640;
fn direction(i: u32, j: u32) -> Vec3 {
    let z = 1.0 - (2 * i + 1) as f32 / FINE as f32;
    about(Vec3::Z, z, TAU * (j as f32 + 0.5) / (2 * FINE) as f32)
}
const SOLID: f32 = 2.0 * TAU / (2 * FINE * FINE) as f32;

/// Density of all lights together that BSDF sampling can hit.
fn density(light_sampler: &LightSampler, towards: Vec3) -> f32 {
    let mut all = 0.0;
    light_sampler.emitted(PLACE, towards, None, |_, pdf| all += pdf);
    all
}

/// Mean over samples of light times a function of its direction.
fn mean(light_sampler: &LightSampler, from: Vec3, n: u32, f: impl Fn(Vec3) -> f32) -> Vec3 {
    let sum = (0..n).map(|i| {
        let (which, place) = numbers(i);
        let light = light_sampler.sample(from, which, place);
        if light.pdf > 0.0 { light.radiance * (f(light.towards) / light.pdf) } else { Vec3::ZERO }
    });
    sum.sum::<Vec3>() / n as f32
}

fn close(found: Vec3, expected: Vec3, tolerance: f32, what: &str) {
    let worst = ((found - expected) / expected.max(Vec3::splat(1e-9))).abs().max_element();
    assert!(worst < tolerance, "{what}: {found}, not {expected}");
}

#[test]
fn pdfs_integrate_to_one_and_samples_follow_them() {
    // Cells of 32 × 32 directions.
    const CELL: u32 = 32;
    const CELLS: u32 = FINE / CELL;
    for (name, lights) in kinds() {
        let light_sampler = LightSampler::new(&lights);
        let mut expected = vec![0.0_f32; (CELLS * CELLS * 2) as usize];
        for i in 0..FINE {
            for j in 0..2 * FINE {
                let cell = i / CELL * 2 * CELLS + j / CELL;
                expected[cell as usize] += density(&light_sampler, direction(i, j)) * SOLID;
            }
        }
        let whole: f32 = expected.iter().sum();
        let n = 40_000;
        let mut found = vec![0_u32; expected.len()];
        let mut hit_by_bsdf = 0_u32;
        for index in 0..n {
            let mut sampler = Sampler::new(5, index, 0);
            let light = light_sampler.sample(PLACE, sampler.one(), sampler.pair());
            if light.is_delta {
                continue;
            }
            hit_by_bsdf += 1;
            let i = ((1.0 - light.towards.z) * 0.5 * CELLS as f32) as u32;
            // As `about` counts its turns.
            let (x, y) = Vec3::Z.any_orthonormal_pair();
            let turn = light.towards.dot(y).atan2(light.towards.dot(x)) / TAU;
            let j = (turn.rem_euclid(1.0) * (2 * CELLS) as f32) as u32;
            found[(i.min(CELLS - 1) * 2 * CELLS + j.min(2 * CELLS - 1)) as usize] += 1;
        }
        let share = hit_by_bsdf as f32 / n as f32;
        assert!((whole - share).abs() < 0.01, "{name}: {whole} {share}");
        // χ² over cells that expect at least ten; the grid itself errs by a percent at edges of lamps.
        let (mut chi, mut cells) = (0.0, 0.0);
        for (expected, found) in expected.iter().zip(&found) {
            let expected = expected / whole * hit_by_bsdf as f32;
            if expected >= 10.0 {
                let error = 0.02 * expected;
                chi += (*found as f32 - expected).powi(2) / (expected + error * error);
                cells += 1.0;
            }
        }
        assert!(chi < cells + 6.0 * f32::sqrt(2.0 * cells), "{name}: {chi} of {cells}");
    }
}

#[test]
fn the_emitted_radiance_and_pdf_are_those_of_the_sample() {
    for (name, lights) in kinds() {
        let light_sampler = LightSampler::new(&lights);
        for index in 0..2000 {
            let (which, place) = numbers(index);
            let light = light_sampler.sample(PLACE, which, place);
            if light.is_delta {
                continue;
            }
            let mut found = false;
            light_sampler.emitted(PLACE, light.towards, None, |radiance, pdf| {
                found |= (radiance - light.radiance).abs().max_element() < 1e-3 * light.radiance.x
                    && (pdf / light.pdf - 1.0).abs() < 2e-3;
            });
            assert!(found, "{name}: {light:?}");
        }
    }
}

#[test]
fn light_sampling_and_bsdf_sampling_integrate_to_the_same_energy() {
    // Two ways to integrate light times a smooth function over all directions. The hot pixel is forty
    // directions of the grid wide.
    let f = |towards: Vec3| (1.2 + towards.dot(Vec3::new(0.5, 0.3, -0.4))).max(0.0);
    for (name, mut lights) in kinds() {
        lights.lamps.retain(|lamp| !matches!(lamp, Lamp::Point(_)));
        let light_sampler = LightSampler::new(&lights);
        let mut met = Vec3::ZERO;
        for i in 0..FINE {
            for j in 0..2 * FINE {
                let towards = direction(i, j);
                light_sampler
                    .emitted(PLACE, towards, None, |light, _| met += light * (f(towards) * SOLID));
            }
        }
        close(mean(&light_sampler, PLACE, 1 << 15, f), met, 0.025, name);
    }
}

#[test]
fn irradiance_is_that_of_closed_forms() {
    let up = |towards: Vec3| towards.z.max(0.0);
    let irradiance = |lights: &Lights, n| mean(&LightSampler::new(lights), Vec3::ZERO, n, up);
    let colour = Vec3::new(1.0, 2.0, 0.5);
    let one = |lamp: Lamp| Lights { lamps: vec![lamp], ..Lights::dark() };

    let (high, down) = (DVec3::Z * 0.7, -DVec3::Z);
    let disc = AreaLight::disc(high, down, 0.5, colour).unwrap();
    close(irradiance(&one(disc.into()), 4096), colour * (PI * 0.25 / 0.74), 3e-3, "disc");
    // Howell's C-11: a quarter of a square, above whose corner the place is, twice as wide as high.
    let (a, b) = (0.4_f32 / 0.7, 0.2_f32 / 0.7);
    let side = |a: f32, b: f32| a / (1.0 + a * a).sqrt() * (b / (1.0 + a * a).sqrt()).atan();
    let factor = 4.0 * (side(a, b) + side(b, a)) / TAU;
    let rectangle = AreaLight::rectangle(high, down, DVec3::X, [0.4, 0.8], colour).unwrap();
    close(irradiance(&one(rectangle.into()), 4096), colour * (PI * factor), 3e-3, "rectangle");
    let point = PointLight::new(DVec3::new(3.0, 0.0, 4.0), colour).unwrap();
    close(irradiance(&one(point.into()), 1), colour * (0.8 / 25.0), 1e-5, "point");
    // The sun, as a disc and as a direction.
    for radius in [0.0, frisure_look::SUN_RADIUS, 0.09, 1.0] {
        let sun = DistantLight::new(DVec3::Z, colour, radius).unwrap();
        close(irradiance(&one(sun.into()), 4096), colour, 2e-3, "sun");
    }
    // From behind, nothing.
    let turned = AreaLight::disc(high, DVec3::Z, 0.5, colour).unwrap();
    assert_eq!(irradiance(&one(turned.into()), 64), Vec3::ZERO);

    let even = Lights::even(colour);
    let map = EnvironmentMap::new(7, 3, vec![colour.to_array(); 21]).unwrap();
    let map = Lights { lamps: Vec::new(), environment: EnvironmentLight::Map(map) };
    for sky in [even, map] {
        close(irradiance(&sky, 4096), colour * PI, 3e-3, "sky");
    }
}

#[test]
fn one_hot_pixel_is_sampled_without_noise() {
    let (width, height) = (1024, 512);
    let mut pixels = vec![[0.2; 3]; width * height];
    pixels[width * 100 + 333] = [3e6; 3];
    let map = EnvironmentMap::new(width, height, pixels).unwrap();
    let expected = map.mean() * (2.0 * TAU);
    let light_sampler =
        LightSampler::new(&Lights { lamps: Vec::new(), environment: EnvironmentLight::Map(map) });
    for index in 0..512 {
        let (which, place) = numbers(index);
        let light = light_sampler.sample(PLACE, which, place);
        // Each sample alone gives all of the light.
        close(light.radiance / light.pdf, expected, 2e-3, "hot");
    }
}

#[test]
fn wide_environment_maps_keep_their_mean_radiance() {
    let (width, height) = (5000, 3);
    let pixels = (0..width * height).map(|i| [(i % 7) as f32, 1.0, (i % 11) as f32]).collect();
    let map = EnvironmentMap::new(width, height, pixels).unwrap();
    let weights = [0.25, 0.5, 0.25].map(f64::from);
    let mut expected = DVec3::ZERO;
    for i in 0..width * height {
        let pixel = DVec3::new((i % 7) as f64, 1.0, (i % 11) as f64);
        expected += pixel * weights[i / width] / width as f64;
    }
    close(map.mean(), expected.as_vec3(), 1e-4, "mean");
}

#[test]
fn an_environment_map_has_the_documented_orientation() {
    // Four columns: behind to the left, in front at the left, in front at the right, behind to the right;
    // two rows.
    let pixels = (0..8).map(|i| [i as f32; 3]).collect();
    let map = EnvironmentMap::new(4, 2, pixels).unwrap();
    let at = |x: f32, y: f32, z: f32| map.radiance(Vec3::new(x, y, z).normalize()).x;
    // The face looks along −y, its left is +x.
    assert_eq!([at(1.0, 1.0, 1.0), at(1.0, -1.0, 1.0), at(-1.0, -1.0, 1.0)], [0.0, 1.0, 2.0]);
    assert_eq!([at(-1.0, 1.0, 1.0), at(1.0, 1.0, -1.0)], [3.0, 4.0]);
    // Turned by a right angle, what was in front at the right is in front at the left.
    let turned = map.turned(std::f64::consts::FRAC_PI_2);
    assert_eq!(turned.radiance(Vec3::new(1.0, -1.0, 1.0).normalize()).x, 2.0);
}

#[test]
fn days_are_lit_by_sun_and_sky_alike() {
    let lights = Lights::daylight(&Daylight::default()).unwrap();
    let light_sampler = LightSampler::new(&lights);
    let up = |towards: Vec3| towards.z.max(0.0);
    let Lamp::Distant(sun) = lights.lamps[0] else { panic!("the sun is far away") };
    let mut sky = Vec3::ZERO;
    for i in 0..FINE / 2 {
        for j in 0..2 * FINE {
            let towards = direction(i, j);
            sky += lights.environment.radiance(towards) * (towards.z * SOLID);
        }
    }
    let expected = sky + sun.irradiance() * sun.direction().z as f32;
    close(mean(&light_sampler, Vec3::ZERO, 1 << 14, up), expected, 0.01, "day");
}

#[test]
fn no_light_is_no_light() {
    let light_sampler = LightSampler::new(&Lights::dark());
    assert_eq!(light_sampler.sample(PLACE, 0.5, [0.5; 2]).pdf, 0.0);
    light_sampler.emitted(PLACE, Vec3::Z, None, |light, _| assert_eq!(light, Vec3::ZERO));
}

#[test]
fn only_visible_area_lights_are_seen() {
    let disc = AreaLight::disc(DVec3::Y, -DVec3::Y, 0.2, Vec3::splat(3.0)).unwrap();
    for shown in [false, true] {
        let lamp = disc.shown(shown).into();
        let light_sampler = LightSampler::new(&Lights { lamps: vec![lamp], ..Lights::dark() });
        let seen = |blocked| light_sampler.visible_area_light(PLACE, Vec3::Y, blocked).is_some();
        assert_eq!((seen(None), seen(Some(0.5))), (shown, false));
        assert!(light_sampler.visible_area_light(PLACE, Vec3::X, None).is_none());
    }
}
