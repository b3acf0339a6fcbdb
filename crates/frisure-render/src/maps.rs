//! Maps of what each pixel shows: which hair, how far, and in which direction it runs; for programs that learn.
//!
//! The same rays measure all maps, so that they agree with each other at every pixel. Strands are the curves of
//! [`crate::accel`] with their true place and a width that can be that of the [`preview`](crate::preview).

use frisure_look::Camera;
use frisure_progress::{Cancelled, Progress};
use frisure_strands::{Strands, Surface};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::accel::{AccelError, CurveOptions, Hit, Ray, SceneBvh};

/// Steps of a depth (m): a power of two, so that single precision has them exactly. 4 µm, a twentieth of a hair; maps of
/// coarser numbers take less space.
const DEPTH_STEP: f64 = 1.0 / 262_144.0;

/// Farthest that is seen (m); chosen.
const FARTHEST: f32 = 1e3;

/// A pinhole camera in pixels, in the convention of OpenCV: x to the right, y down, z along the view, and the middle of
/// the first pixel at (0, 0).
///
/// ```
/// use frisure_look::Camera;
/// use frisure_render::maps::Pinhole;
/// use glam::DVec3;
///
/// let camera = Camera::look_at(DVec3::NEG_Y, DVec3::ZERO, DVec3::Z, 1.0)?;
/// let pinhole = Pinhole::new(&camera, 640, 480);
/// let [u, v, depth] = pinhole.project(DVec3::ZERO).to_array();
/// assert!((u - 319.5).abs() < 1e-9 && (v - 239.5).abs() < 1e-9 && (depth - 1.0).abs() < 1e-9);
/// # Ok::<(), frisure_look::CameraError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pinhole {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Focal length (pixels), of both axes.
    pub focal: f64,
    /// The axes of the camera in the world: right, down, along the view; unit vectors.
    pub axes: [DVec3; 3],
    /// Its position (m).
    pub eye: DVec3,
}

impl Pinhole {
    /// A camera with a picture of `width` × `height` pixels.
    #[must_use]
    pub fn new(camera: &Camera, width: usize, height: usize) -> Self {
        let focal = 0.5 * height as f64 / (0.5 * camera.vertical_fov()).tan();
        let axes = [camera.right(), -camera.up(), camera.forward()];
        Self { size: [width, height], focal, axes, eye: camera.eye() }
    }

    /// The matrix K of the camera: from directions (x, y, z) of the camera to (u, v, 1) times z (pixels).
    #[must_use]
    pub fn intrinsics(&self) -> [[f64; 3]; 3] {
        let [u, v] = self.middle();
        [[self.focal, 0.0, u], [0.0, self.focal, v], [0.0, 0.0, 1.0]]
    }

    /// Rotation from the world to the camera; its rows are the camera's axes.
    #[must_use]
    pub fn rotation(&self) -> [[f64; 3]; 3] {
        self.axes.map(|axis| axis.to_array())
    }

    /// Translation from the world to the camera (m): a point is at `rotation · point + translation`.
    #[must_use]
    pub fn translation(&self) -> [f64; 3] {
        self.axes.map(|axis| -axis.dot(self.eye))
    }

    /// The camera's place and axes in the world as a matrix of rows (m), in the convention of Blender: x to the right, y
    /// up, and the view along −z.
    #[must_use]
    pub fn to_world(&self) -> [[f64; 4]; 4] {
        let [right, down, forward] = self.axes;
        let (up, back) = (-down, -forward);
        let row = |of: fn(DVec3) -> f64| [of(right), of(up), of(back), of(self.eye)];
        [row(|v| v.x), row(|v| v.y), row(|v| v.z), [0.0, 0.0, 0.0, 1.0]]
    }

    /// Column and row (pixels) of a point (m), and its depth along the view (m).
    #[must_use]
    pub fn project(&self, point: DVec3) -> DVec3 {
        let [x, y, z] = self.axes.map(|axis| axis.dot(point - self.eye));
        let [u, v] = self.middle();
        DVec3::new(u + self.focal * x / z, v + self.focal * y / z, z)
    }

    /// The middle of the picture (pixels).
    fn middle(&self) -> [f64; 2] {
        self.size.map(|side| 0.5 * (side as f64 - 1.0))
    }

    /// The direction from the eye through a place in the picture (pixels), in the axes of the camera, one along the view.
    fn slopes(&self, place: DVec2) -> DVec3 {
        let [u, v] = self.middle();
        DVec3::new((place.x - u) / self.focal, (place.y - v) / self.focal, 1.0)
    }

    fn ray(&self, slopes: DVec3) -> Ray {
        let [right, down, forward] = self.axes;
        let direction = slopes.x * right + slopes.y * down + slopes.z * forward;
        Ray::new(self.eye.as_vec3(), direction.normalize().as_vec3())
    }
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MappedPixel {
    /// Coverage by hair, 0 to 1.
    pub hair: f32,
    /// Coverage by the body with its brows and lashes, 0 to 1. What remains is background.
    pub body: f32,
    /// Distance along the view (m) of the hair of [`Self::strand`], else of the body; infinite for background alone.
    pub depth: f32,
    /// The hair: of the rays of the pixel that meet hair first, that of the ray nearest to the pixel's middle.
    pub strand: Option<MappedHair>,
}

/// The hair of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MappedHair {
    /// Index of the strand.
    pub index: u32,
    /// Unit tangent from root to tip, in the camera's axes: right, down, along the view.
    pub tangent: [f32; 3],
    /// Unit direction in the picture in which the tangent is seen: right, down. Zero for hair that runs along the ray.
    pub direction: [f32; 2],
}

/// Strands and a body, of which maps can be made from any camera.
#[derive(Clone, Debug)]
pub struct Mapper {
    bvh: SceneBvh,
    /// Strands with a smaller index are hair; others are brows and lashes.
    hairs: usize,
}

impl Mapper {
    /// Takes strands, `width` times as wide as they are, and the body with its brows and lashes, which are as wide as they are.
    ///
    /// # Errors
    /// [`AccelError`], for a coordinate or radius out of range.
    pub fn new(strands: &Strands, body: Option<&Surface>, width: f32) -> Result<Self, AccelError> {
        let features = body.and_then(Surface::features).filter(|f| !f.hairs.is_empty());
        let wide = strands.clone().with_attributes(|_| false).widened(width);
        let all = match features {
            Some(features) => wide.followed_by(&features.hairs),
            None => wide,
        };
        let bvh = SceneBvh::new(&all, body, &CurveOptions::default())?;
        Ok(Self { bvh, hairs: strands.len() })
    }

    /// The maps of a picture, row by row from the top left; `samples` rays (1 to 8) along each side of a pixel.
    ///
    /// Reports the stage `maps`. The same input gives the same numbers on any number of threads.
    ///
    /// # Errors
    /// [`Cancelled`].
    pub fn maps(
        &self,
        camera: &Pinhole,
        samples: usize,
        progress: &dyn Progress,
    ) -> Result<Vec<MappedPixel>, Cancelled> {
        let places = places(samples.clamp(1, 8));
        let [width, height] = camera.size;
        progress.report("maps", 0.0);
        let rows = (0..height).into_par_iter().map(|row| {
            progress.check()?;
            let pixel =
                |column: usize| self.pixel(camera, DVec2::new(column as f64, row as f64), &places);
            Ok((0..width).map(pixel).collect::<Vec<_>>())
        });
        let rows: Vec<Vec<MappedPixel>> = rows.collect::<Result<_, Cancelled>>()?;
        progress.report("maps", 1.0);
        Ok(rows.concat())
    }

    fn pixel(&self, camera: &Pinhole, middle: DVec2, places: &[DVec2]) -> MappedPixel {
        let share = 1.0 / places.len() as f32;
        let (mut hairs, mut bodies) = (0_u8, 0_u8);
        let (mut hair, mut depth) = (None, None);
        for place in places {
            let slopes = camera.slopes(middle + *place);
            let ray = camera.ray(slopes);
            let Some(hit) = self.bvh.closest_hit(&ray, FARTHEST) else { continue };
            let here = f64::from(hit.t()) / slopes.length();
            match hit {
                Hit::Hair(hit) if (hit.strand as usize) < self.hairs => {
                    hairs += 1;
                    hair.get_or_insert((mapped(camera, slopes, hit.strand, hit.tangent), here));
                }
                _ => {
                    bodies += 1;
                    depth.get_or_insert(here);
                }
            }
        }
        let depth = hair.map(|(_, depth)| depth).or(depth);
        let stepped = |depth: f64| ((depth / DEPTH_STEP).round() * DEPTH_STEP) as f32;
        MappedPixel {
            hair: f32::from(hairs) * share,
            body: f32::from(bodies) * share,
            depth: depth.map_or(f32::INFINITY, stepped),
            strand: hair.map(|(hair, _)| hair),
        }
    }
}

/// The hair that a ray with these slopes meets.
fn mapped(camera: &Pinhole, slopes: DVec3, index: u32, tangent: glam::Vec3) -> MappedHair {
    let tangent = DVec3::from_array(camera.axes.map(|axis| axis.dot(tangent.as_dvec3())));
    // The derivative of (x/z, y/z) along the tangent, times z.
    let seen = tangent.truncate() - tangent.z * slopes.truncate();
    let direction = seen.try_normalize().unwrap_or_default().as_vec2();
    MappedHair { index, tangent: tangent.as_vec3().to_array(), direction: direction.to_array() }
}

/// Places of the rays in a pixel, from its middle (pixels); the nearest to it first.
fn places(samples: usize) -> Vec<DVec2> {
    let along = |i: usize| (i as f64 + 0.5) / samples as f64 - 0.5;
    let grid = (0..samples).flat_map(|y| (0..samples).map(move |x| DVec2::new(along(x), along(y))));
    let mut places: Vec<DVec2> = grid.collect();
    // A stable sort: of equal distances, the upper and the left one first.
    places.sort_by(|a, b| a.length_squared().total_cmp(&b.length_squared()));
    places
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn camera() -> Pinhole {
        let look = Camera::look_at(DVec3::new(0.3, -1.0, 0.2), DVec3::ZERO, DVec3::Z, 0.4);
        Pinhole::new(&look.unwrap(), 64, 48)
    }

    fn dot(row: &[f64], point: &[f64]) -> f64 {
        row.iter().zip(point).map(|(a, b)| a * b).sum()
    }

    #[test]
    fn the_matrices_project_as_the_camera_does() {
        let camera = camera();
        let point = DVec3::new(0.03, 0.05, -0.04);
        let (k, r, t) = (camera.intrinsics(), camera.rotation(), camera.translation());
        let seen: Vec<f64> =
            r.iter().zip(t).map(|(row, t)| dot(row, &point.to_array()) + t).collect();
        let [u, v, w] = k.map(|row| dot(&row, &seen));
        let expected = camera.project(point);
        assert!((expected - DVec3::new(u / w, v / w, w)).length() < 1e-9, "{expected}");
        // Blender's matrix brings a point before the camera to its place in the world.
        let local = [seen[0], -seen[1], -seen[2], 1.0];
        let world = camera.to_world().map(|row| dot(&row, &local));
        assert!((DVec3::new(world[0], world[1], world[2]) - point).length() < 1e-12);
    }

    #[test]
    fn a_hair_is_mapped_where_it_is_projected() {
        let camera = camera();
        let ends = [Vec3::new(-0.1, 0.02, -0.05), Vec3::new(0.12, -0.03, 0.08)];
        let mut strands = Strands::new();
        strands.push(&ends, &[4e-5; 2]);
        let pixels = Mapper::new(&strands, None, 10.0).unwrap().maps(&camera, 4, &()).unwrap();
        let [a, b] = ends.map(|p| camera.project(p.as_dvec3()));
        let seen = (b - a).truncate().normalize();
        let mut found = 0;
        for (index, pixel) in pixels.iter().enumerate() {
            let Some(hair) = pixel.strand else {
                assert!(pixel.hair == 0.0 && pixel.depth.is_infinite());
                continue;
            };
            found += 1;
            let place = DVec2::new((index % 64) as f64, (index / 64) as f64) - a.truncate();
            assert!(place.perp_dot(seen).abs() < 1.0, "{place} is beside the hair");
            let direction = glam::Vec2::from_array(hair.direction).as_dvec2();
            assert!(direction.dot(seen) > 1.0 - 1e-6, "{direction} is not {seen}");
            let part = (place.dot(seen) / (b - a).truncate().length()).clamp(0.0, 1.0);
            // 1/z is linear in the picture.
            let depth = 1.0 / (1.0 / a.z).mul_add(1.0 - part, part / b.z);
            // A ray is up to 0.7 pixels away from the pixel's middle, and meets the hair before its axis.
            let along = (a.z - b.z).abs() / (b - a).truncate().length();
            let near = 0.75 * along + 4e-4;
            assert!((f64::from(pixel.depth) - depth).abs() < near, "{} {depth}", pixel.depth);
            assert!(pixel.hair > 0.0 && pixel.body == 0.0);
        }
        assert!(found > 20, "{found}");
    }
}
