//! Camera rays: the pixel filter and the thin lens.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};
use std::sync::LazyLock;

use glam::Vec3;

use super::integrator::Integrator;
use super::options::TraceOptions;
use super::sampler::Sampler;
use crate::accel::Ray;
use frisure_look::Camera;

/// Radius of the pixel filter (pixels); chosen.
const FILTER: f32 = 1.5;

/// Entries of the table of quantiles, which are linear between them. Chosen.
const STEPS: usize = 256;

/// Quantiles of the pixel filter (pixels from its middle): its inverse cumulative distribution.
///
/// The filter is the four-term Blackman–Harris window (Harris 1978): its side lobes are low, so that edges have
/// neither stairs nor rings. Samples are drawn from it, so that each has the same weight and pixels are
/// independent (Ernst, Stamminger and Greiner 2006, *Filter importance sampling*).
static QUANTILES: LazyLock<[f32; STEPS + 1]> = LazyLock::new(|| {
    // The running sum of the window at the midpoints of fine steps, read off where it passes each multiple of 1/STEPS.
    const FINE: usize = 64 * STEPS;
    let window = |i: usize| {
        let x = std::f64::consts::TAU * (i as f64 + 0.5) / FINE as f64;
        0.358_75 - 0.488_29 * x.cos() + 0.141_28 * (2.0 * x).cos() - 0.011_68 * (3.0 * x).cos()
    };
    let whole: f64 = (0..FINE).map(window).sum();
    let (mut quantiles, mut passed, mut step) = ([FILTER; STEPS + 1], 0.0, 0);
    for i in 0..FINE {
        while step < STEPS && passed >= whole * step as f64 / STEPS as f64 {
            quantiles[step] = FILTER * (2.0 * i as f32 / FINE as f32 - 1.0);
            step += 1;
        }
        passed += window(i);
    }
    quantiles
});

/// A camera with its film: makes camera rays.
pub(super) struct Lens {
    eye: Vec3,
    forward: Vec3,
    /// Half the film's width and height at distance 1.
    right: Vec3,
    up: Vec3,
    size: [f32; 2],
    /// Radius of the aperture (m), the focus distance of the camera along the view (m), if it has one, and the one used.
    aperture_radius: f32,
    given_focus: Option<f32>,
    focus: f32,
}

impl Lens {
    pub(super) fn new(camera: &Camera, options: &TraceOptions, focus: f32) -> Self {
        let size = [options.width, options.height].map(|n| n as f32);
        let tan = (0.5 * camera.vertical_fov()).tan() as f32;
        let aperture = camera.aperture();
        Self {
            eye: camera.eye().as_vec3(),
            forward: camera.forward().as_vec3(),
            right: camera.right().as_vec3() * (tan * size[0] / size[1]),
            up: camera.up().as_vec3() * tan,
            size,
            aperture_radius: aperture.map_or(0.0, |a| a.radius as f32),
            given_focus: aperture.and_then(|a| a.focus).map(|focus| focus as f32),
            focus,
        }
    }

    /// A point of the film, drawn from a pixel's filter: −1 to 1 to the right and upwards.
    pub(super) fn film_point(&self, (x, y): (usize, usize), u: [f32; 2]) -> [f32; 2] {
        let [dx, dy] = u.map(sample_filter);
        [
            2.0 * (x as f32 + 0.5 + dx) / self.size[0] - 1.0,
            1.0 - 2.0 * (y as f32 + 0.5 + dy) / self.size[1],
        ]
    }

    /// The camera ray through a point of the film, and the cosine of its angle with the view (thin lens: pbrt-v4,
    /// §5.2.3).
    pub(super) fn camera_ray(&self, [x, y]: [f32; 2], sampler: &mut Sampler) -> (Ray, f32) {
        let direction = self.forward + self.right * x + self.up * y;
        let ray = match self.aperture_radius > 0.0 {
            true => {
                let [a, b] = sample_disc(sampler.pair()).map(|r| r * self.aperture_radius);
                // All rays of a film point meet in the plane of focus, whatever their point on the aperture.
                let offset = a * self.right.normalize() + b * self.up.normalize();
                Ray::new(self.eye + offset, direction * self.focus - offset)
            }
            false => Ray::new(self.eye, direction),
        };
        (ray, ray.direction().dot(self.forward))
    }

    /// The focus distance along the view (m): the camera's, or that of the nearest hit in the middle of the
    /// picture.
    pub(super) fn focus_distance(&self, integrator: &Integrator) -> f32 {
        // 13 × 13 rays over the middle 15 % of the film (chosen), as an autofocus has a spot.
        const AROUND: i32 = 6;
        let grid = (-AROUND..=AROUND).flat_map(|i| (-AROUND..=AROUND).map(move |j| [i, j]));
        let rays = grid.map(|place| {
            let [x, y] = place.map(|n| 0.15 * n as f32 / AROUND as f32);
            Ray::new(self.eye, self.forward + self.right * x + self.up * y)
        });
        let along = |ray: Ray| Some(integrator.distance(&ray)? * ray.direction().dot(self.forward));
        self.given_focus.or_else(|| rays.filter_map(along).reduce(f32::min)).unwrap_or(1.0)
    }
}

/// Samples an offset from the pixel filter (pixels), from a number in [0, 1).
fn sample_filter(u: f32) -> f32 {
    let place = u * STEPS as f32;
    let step = (place as usize).min(STEPS - 1);
    let (from, to) = (QUANTILES[step], QUANTILES[step + 1]);
    from + (to - from) * (place - step as f32)
}

/// Samples the unit disc uniformly from two numbers in [0, 1) (the concentric map of Shirley and Chiu 1997).
fn sample_disc(u: [f32; 2]) -> [f32; 2] {
    let [a, b] = u.map(|u| 2.0 * u - 1.0);
    if a == 0.0 && b == 0.0 {
        return [0.0; 2];
    }
    let (r, angle) = match a.abs() > b.abs() {
        true => (a, FRAC_PI_4 * b / a),
        false => (b, FRAC_PI_2 - FRAC_PI_4 * a / b),
    };
    [r * angle.cos(), r * angle.sin()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_filter_is_even_about_its_middle_and_ends_where_it_should() {
        let n = 100_000;
        let all = || (0..n).map(|i| sample_filter((i as f32 + 0.5) / n as f32));
        let mean = all().sum::<f32>() / n as f32;
        let variance = all().map(|x| x * x).sum::<f32>() / n as f32;
        assert!(mean.abs() < 2e-3, "{mean}");
        // The window's own deviation, 0.1385 of its width, by quadrature.
        assert!((variance.sqrt() / (2.0 * FILTER) - 0.1385).abs() < 2e-3, "{variance}");
        assert!(all().all(|x| x.abs() <= FILTER));
        assert!(all().zip(all().skip(1)).all(|(a, b)| a <= b));
    }

    #[test]
    fn points_of_the_disc_are_spread_evenly() {
        let n = 200;
        let (mut inside, mut square) = (0, 0.0);
        for i in 0..n * n {
            let u = [i % n, i / n].map(|k| (k as f32 + 0.5) / n as f32);
            let [x, y] = sample_disc(u);
            inside += usize::from(x * x + y * y < 0.25);
            square += f64::from(x * x + y * y);
        }
        let whole = f64::from(n * n);
        assert!((inside as f64 / whole - 0.25).abs() < 0.01);
        assert!((square / whole - 0.5).abs() < 0.01);
    }
}
