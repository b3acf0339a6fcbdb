//! The sky by day.
//!
//! Clear: Preetham, Shirley & Smits 1999, *A practical analytic model for daylight*: luminance and
//! chromaticity of the sky after Perez, and the sun through Rayleigh scattering and haze, here at one
//! wavelength for each of red, green and blue. Overcast: Moon & Spencer 1942, type 16 of ISO 15469.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::environment_light::EnvironmentLight;
use super::environment_map::EnvironmentMap;
use super::error::{InvalidLight, amount, within};
use super::lamp::DistantLight;
use super::lights::Lights;
use crate::colour::{luminance, srgb_from_xyz};

/// A clear day.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Daylight {
    /// Around the head to the sun (rad): 0 in front of the face, π/2 at the head's left.
    pub sun_azimuth: f64,
    /// Of the sun above the horizon (rad), 0 to π/2.
    pub sun_elevation: f64,
    /// Haze: 2 after rain, 3 clear, 6 hazy, 10 dull; 1.9 to 10.
    pub turbidity: f64,
}

impl Default for Daylight {
    /// A clear morning, with the sun before the face and to its left.
    fn default() -> Self {
        let deg = f64::to_radians;
        Self { sun_azimuth: deg(50.0), sun_elevation: deg(40.0), turbidity: 3.0 }
    }
}

/// Angular radius of the sun (rad): 16 minutes of arc.
pub const SUN_RADIUS: f64 = 0.004_65;

/// Illuminance of the sun above the atmosphere (klx), and its colour there: 5900 K against the white of sRGB.
/// The illuminance's source is not recorded; a test holds the sum at the ground to 60 to 110 klx.
const SUN: f64 = 133.8;
const SUN_COLOUR: [f64; 3] = [1.05, 0.99, 0.96];

/// Wavelengths (µm) that stand for red, green and blue. Chosen.
const WAVELENGTHS: [f64; 3] = [0.61, 0.55, 0.465];

/// Diffuse reflectance of the ground: grass, earth and stone; chosen.
const ALBEDO: f64 = 0.2;

/// Light at a place in the open from all sides (the sum of irradiances, each facing its light), as bright
/// as the camera of the studio is set for; chosen by eye.
const EXPOSED: f64 = 9.5;

/// Factor on the exposure under clouds: a camera is set for the face, which sees half of the sky; chosen by eye.
const UNDER_CLOUDS: f32 = 1.35;

/// Columns and rows of the sky that is computed: 0.7° each. Chosen; the sun is a lamp of its own.
const WIDTH: usize = 512;
const HEIGHT: usize = 256;

impl Lights {
    /// Sun and sky of a clear day over pale ground, as bright as a camera would be set for. The one lamp
    /// is the sun.
    ///
    /// # Errors
    /// [`InvalidLight`], if the sun is below the horizon or the haze impossible.
    pub fn daylight(day: &Daylight) -> Result<Self, InvalidLight> {
        let around = "between -100 and 100 rad";
        let azimuth = within("the sun's azimuth", day.sun_azimuth, (-100.0, 100.0), around)?;
        let above = "between 0 and pi/2 rad";
        let elevation = within("the sun's elevation", day.sun_elevation, (0.0, FRAC_PI_2), above)?;
        let haze = within("the turbidity", day.turbidity, (1.9, 10.0), "between 1.9 and 10")?;

        let towards = towards(azimuth, elevation);
        let sun = sunlight(elevation, haze);
        let sky = Sky::new(elevation, haze);
        let sky = |d: DVec3| sky.colour(d.z.asin(), d.dot(towards).clamp(-1.0, 1.0).acos());
        let exposed = Exposed::new(sky, sun * elevation.sin(), luminance(sun))?;
        let sun = amount("the sun's light", (sun * exposed.factor).as_vec3())?;
        let lamp = DistantLight::new(towards, sun, SUN_RADIUS)?;
        Ok(Self { lamps: vec![lamp.into()], environment: exposed.environment })
    }

    /// A sky full of clouds over pale ground, as bright as a camera would be set for.
    #[must_use]
    pub fn overcast() -> Self {
        let cloud = DVec3::new(0.985, 1.0, 1.04);
        // L = L_z (1 + 2 sin elevation)/3: three times as bright at the zenith as at the horizon. [Moon & Spencer 1942]
        let sky = |d: DVec3| cloud * ((1.0 + 2.0 * d.z) / 3.0);
        let environment =
            Exposed::new(sky, DVec3::ZERO, 0.0).map_or(EnvironmentLight::DARK, |e| e.environment);
        Self { lamps: Vec::new(), environment: environment.scaled(UNDER_CLOUDS) }
    }
}

/// The unit direction at an azimuth and an elevation (rad): 0 in front of the face, then to its left.
fn towards(azimuth: f64, elevation: f64) -> DVec3 {
    let (sa, ca) = azimuth.sin_cos();
    let (se, ce) = elevation.sin_cos();
    DVec3::new(sa * ce, -ca * ce, se)
}

/// A sky with its ground, and the factor by which a camera's exposure makes it brighter.
struct Exposed {
    environment: EnvironmentLight,
    factor: f64,
}

impl Exposed {
    /// From the colour of the sky, and what the sun adds on level ground and on a surface that faces it.
    fn new(
        sky: impl Fn(DVec3) -> DVec3,
        on_ground: DVec3,
        facing: f64,
    ) -> Result<Self, InvalidLight> {
        let at = |x: usize, y: usize| {
            let azimuth = PI - 2.0 * PI * (x as f64 + 0.5) / WIDTH as f64;
            towards(azimuth, PI * (0.5 - (y as f64 + 0.5) / HEIGHT as f64))
        };
        let above: Vec<DVec3> = (0..WIDTH * HEIGHT / 2)
            .map(|i| sky(at(i % WIDTH, i / WIDTH)).max(DVec3::ZERO))
            .collect();
        let (mut level, mut around) = (on_ground, 0.0);
        for (i, colour) in above.iter().enumerate() {
            let angle = PI * (0.5 - ((i / WIDTH) as f64 + 0.5) / HEIGHT as f64);
            let solid = 2.0 * PI / WIDTH as f64 * PI / HEIGHT as f64 * angle.cos();
            // ∫ L cos dω on level ground, and ∫ L dω of all sides.
            level += *colour * (solid * angle.sin());
            around += luminance(*colour) * solid;
        }
        // A matt surface of reflectance a has the radiance a E/π.
        let ground = level * (ALBEDO / PI);
        // The width of a fibre, sin θ on average π/4, is what it receives of light from everywhere.
        let all = facing + PI / 4.0 * (around + 2.0 * PI * luminance(ground));
        let factor = EXPOSED / all;
        let pixels = above.iter().chain(std::iter::repeat_n(&ground, WIDTH * HEIGHT / 2));
        let pixels = pixels.map(|c| (*c * factor).as_vec3().to_array()).collect();
        Ok(Self {
            environment: EnvironmentLight::Map(EnvironmentMap::new(WIDTH, HEIGHT, pixels)?),
            factor,
        })
    }
}

/// Illuminance of the sun on a surface that faces it (klx, linear sRGB).
fn sunlight(elevation: f64, turbidity: f64) -> DVec3 {
    let zenith = 90.0 - elevation.to_degrees();
    // Relative optical mass, m = 1/(cos θ + 0.15 (93.885° − θ)^−1.253), with θ the sun's angle from the zenith. Rayleigh
    // exp(−0.008735 λ^−4.08 m), aerosol exp(−β λ^−1.3 m) with β = 0.04608 T − 0.04586. [Preetham 1999]
    let air = 1.0 / (elevation.sin() + 0.15 * (93.885 - zenith).powf(-1.253));
    let haze = (0.046_08 * turbidity - 0.045_86).max(0.0);
    let passed = WAVELENGTHS.map(|w| {
        let (rayleigh, aerosol) = (0.008_735 * w.powf(-4.08), haze * w.powf(-1.3));
        (-(rayleigh + aerosol) * air).exp()
    });
    SUN * DVec3::from(SUN_COLOUR) * DVec3::from(passed)
}

/// The sky after Perez: five coefficients each for chromaticity x, y and luminance, and the values at the
/// zenith.
struct Sky {
    perez: [[f64; 5]; 3],
    /// At the zenith, over the distribution there.
    zenith: [f64; 3],
}

/// Slope and offset in the turbidity of Perez' coefficients A to E, of x, y and luminance. [Preetham 1999].
const PEREZ: [[[f64; 2]; 5]; 3] = [
    [
        [-0.0193, -0.2592],
        [-0.0665, 0.0008],
        [-0.0004, 0.2125],
        [-0.0641, -0.8989],
        [-0.0033, 0.0452],
    ],
    [
        [-0.0167, -0.2608],
        [-0.0950, 0.0092],
        [-0.0079, 0.2102],
        [-0.0441, -1.6537],
        [-0.0109, 0.0529],
    ],
    [[0.1787, -1.4630], [-0.3554, 0.4275], [-0.0227, 5.3251], [0.1206, -2.5771], [-0.0670, 0.3703]],
];

/// Chromaticity x and y at the zenith: rows for turbidity squared, turbidity and 1, columns for the sun's
/// zenith angle cubed to 1. [Preetham 1999].
const ZENITH: [[[f64; 4]; 3]; 2] = [
    [
        [0.001_66, -0.003_75, 0.002_09, 0.0],
        [-0.029_03, 0.063_77, -0.032_02, 0.003_94],
        [0.116_93, -0.211_96, 0.060_52, 0.258_86],
    ],
    [
        [0.002_75, -0.006_10, 0.003_17, 0.0],
        [-0.042_14, 0.089_70, -0.041_53, 0.005_16],
        [0.153_46, -0.267_56, 0.066_70, 0.266_88],
    ],
];

impl Sky {
    fn new(sun_elevation: f64, t: f64) -> Self {
        let s = FRAC_PI_2 - sun_elevation;
        let perez = PEREZ.map(|of| of.map(|[slope, offset]| slope * t + offset));
        let chromaticity = ZENITH.map(|rows| {
            let row = |r: [f64; 4]| ((r[0] * s + r[1]) * s + r[2]) * s + r[3];
            (row(rows[0]) * t + row(rows[1])) * t + row(rows[2])
        });
        // Luminance at the zenith (kcd/m²) and the coefficients of Perez: [Preetham 1999].
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * s);
        let luminance = (4.0453 * t - 4.9710) * chi.tan() - 0.2155 * t + 2.4192;
        let [x, y] = chromaticity;
        let mut zenith = [x, y, luminance.max(0.0)];
        for (value, perez) in zenith.iter_mut().zip(&perez) {
            *value /= distribution(perez, FRAC_PI_2, s);
        }
        Self { perez, zenith }
    }

    /// Radiance (kcd/m², linear sRGB) at an elevation and an angle from the sun (rad).
    fn colour(&self, elevation: f64, from_sun: f64) -> DVec3 {
        let at = |i: usize| self.zenith[i] * distribution(&self.perez[i], elevation, from_sun);
        let (x, y, luminance) = (at(0), at(1), at(2));
        let over = luminance / y;
        srgb_from_xyz(DVec3::new(x * over, luminance, (1.0 - x - y) * over)).max(DVec3::ZERO)
    }
}

fn distribution([a, b, c, d, e]: &[f64; 5], elevation: f64, from_sun: f64) -> f64 {
    // F = (1 + A e^(B/cos θ)) (1 + C e^(D γ) + E cos² γ); the bound keeps the horizon finite.
    let up = elevation.sin().max(0.01);
    (1.0 + a * (b / up).exp()) * (1.0 + c * (d * from_sun).exp() + e * from_sun.cos().powi(2))
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn day(elevation: f64, turbidity: f64) -> Lights {
        let sun_elevation = elevation.to_radians();
        Lights::daylight(&Daylight { sun_elevation, turbidity, ..Daylight::default() }).unwrap()
    }

    fn sun(lights: &Lights) -> Vec3 {
        lights.lamps[0].arriving(DVec3::ZERO).unwrap().1
    }

    #[test]
    fn the_sun_gives_most_of_the_light_of_a_clear_day_and_reddens_as_it_sinks() {
        // On level ground with the sun at 45° two thirds to nine tenths of the light are the sun's.
        let sky = Sky::new(FRAC_PI_2 / 2.0, 2.5);
        let (n, mut level) = (200, 0.0);
        for i in 0..n * n {
            let elevation = FRAC_PI_2 * (f64::from(i / n) + 0.5) / f64::from(n);
            let d = towards(2.0 * PI * (f64::from(i % n) + 0.5) / f64::from(n), elevation);
            let sun = towards(0.0, FRAC_PI_2 / 2.0);
            let solid = 2.0 * PI * FRAC_PI_2 / f64::from(n * n) * elevation.cos();
            level += luminance(sky.colour(elevation, d.dot(sun).acos())) * elevation.sin() * solid;
        }
        let direct = luminance(sunlight(FRAC_PI_2 / 2.0, 2.5)) * (FRAC_PI_2 / 2.0).sin();
        let share = direct / (direct + level);
        assert!((0.67..0.9).contains(&share), "{share}");
        // Some 70 to 100 klx in all.
        assert!((60.0..110.0).contains(&(direct + level)), "{direct} {level}");
        let warmth = |e: f64| sun(&day(e, 3.0)).x / sun(&day(e, 3.0)).z;
        assert!(warmth(60.0) < warmth(30.0) && warmth(30.0) < 0.6 * warmth(8.0));
    }

    #[test]
    fn the_clear_sky_is_blue_and_brightest_about_the_sun() {
        let lights = day(40.0, 2.5);
        let towards_sun = towards(50_f64.to_radians(), 40_f64.to_radians());
        let blue = lights.environment.radiance(Vec3::new(-0.3, 0.3, 0.9).normalize());
        assert!(blue.z > 1.3 * blue.x, "{blue}");
        let near = lights.environment.radiance(towards_sun.as_vec3());
        assert!(near.y > 2.0 * blue.y, "{near} {blue}");
        let haze = day(40.0, 9.0).environment.radiance(Vec3::new(-0.3, 0.3, 0.9).normalize());
        assert!(haze.z / haze.x < 0.8 * blue.z / blue.x);
    }

    #[test]
    fn every_day_is_as_bright_as_the_camera_is_set_for() {
        for elevation in [0.0, 2.0, 30.0, 90.0] {
            for turbidity in [1.9, 3.0, 10.0] {
                let lights = day(elevation, turbidity);
                let all = sun(&lights) + (PI * PI) as f32 * lights.environment.mean();
                let all = luminance(all.as_dvec3());
                assert!((all / EXPOSED - 1.0).abs() < 0.02, "{elevation} {turbidity}: {all}");
            }
        }
        let grey = Lights::overcast().environment;
        let all = PI * PI * luminance(grey.mean().as_dvec3());
        assert!((all / EXPOSED / f64::from(UNDER_CLOUDS) - 1.0).abs() < 0.02);
        // Three times brighter above than at the horizon.
        let ratio = grey.radiance(Vec3::Z).y / grey.radiance(Vec3::new(1.0, 0.0, 0.02)).y;
        assert!((ratio - 3.0).abs() < 0.15, "{ratio}");
    }

    #[test]
    fn impossible_days_are_refused() {
        let with = |sun_elevation, turbidity| {
            Lights::daylight(&Daylight { sun_elevation, turbidity, ..Daylight::default() })
        };
        assert!(with(-0.1, 3.0).unwrap_err().to_string().contains("elevation is -0.1"));
        assert!(with(0.5, 1.0).unwrap_err().to_string().contains("turbidity is 1"));
        assert!(with(f64::NAN, 3.0).is_err());
    }
}
