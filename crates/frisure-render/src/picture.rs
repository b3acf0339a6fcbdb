//! From the description of a picture to the scene that is rendered: cameras framed round the subject, lights and
//! materials around it.

use std::f64::consts::TAU;

use frisure_look::{
    Camera, CameraSpec, EnvironmentMap, Floor, InvalidLight, LightSpec, Lights, Look, LookSpec,
};
use frisure_strands::{Strands, Surface};
use glam::DVec3;

use crate::scene::{Scene, framed_bounds, head_centre};

/// Points of hair that are enough to frame it; more are thinned out. Chosen.
const FRAMED_POINTS: usize = 50_000;

/// Positions around the axis of a turntable at which its picture is framed. Chosen.
const TURNTABLE_POSITIONS: usize = 24;

/// How a picture is taken, relative to what it shows.
#[derive(Clone, Copy, Debug)]
pub struct PictureSpec<'a> {
    /// Direction and lens of the camera.
    pub camera: &'a CameraSpec,
    /// Lights, which may turn with the camera.
    pub light: &'a LightSpec,
    /// Materials.
    pub look: &'a LookSpec,
    /// An environment map in place of the setup's environment light.
    pub environment: Option<&'a EnvironmentMap>,
}

impl PictureSpec<'_> {
    /// The camera in front of strands and the head without its shoulders, as near as it can be with all of them in a
    /// picture of `aspect` width/height.
    #[must_use]
    pub fn frame(&self, strands: &Strands, surface: Option<&Surface>, aspect: f64) -> Camera {
        self.camera.frame(framed_points(strands, surface), aspect)
    }

    /// The scene seen from the camera that [`Self::frame`] finds for `framed`, of which `strands` may be a part.
    ///
    /// # Errors
    /// As [`Self::scene`].
    pub fn framed_scene<'s>(
        &self,
        strands: &'s Strands,
        framed: &Strands,
        surface: Option<&'s Surface>,
        aspect: f64,
    ) -> Result<Scene<'s>, InvalidLight> {
        self.scene(self.frame(framed, surface, aspect), strands, framed, surface)
    }

    /// The scene seen from a camera; a floor is under all of `framed`, of which `strands` may be a part.
    ///
    /// # Errors
    /// [`InvalidLight`], for a lamp at an impossible position.
    pub fn scene<'s>(
        &self,
        camera: Camera,
        strands: &'s Strands,
        framed: &Strands,
        surface: Option<&'s Surface>,
    ) -> Result<Scene<'s>, InvalidLight> {
        let (mut look, lights) = self.look_and_lights(&camera, head_centre(strands, surface))?;
        look.floor = self.look.floor.map(|colour| {
            let (low, high) = all_bounds(framed, surface);
            let on_foot = surface.is_some_and(|s| s.bounds().0.z <= low.z);
            Floor::under((low, high), on_foot, colour)
        });
        Ok(Scene { strands, surface, accessories: &[], camera, lights, look })
    }

    /// Materials and lights for a head with its middle ([`head_centre`]) at `centre` (m), without a floor.
    ///
    /// # Errors
    /// As [`Self::scene`].
    pub fn look_and_lights(
        &self,
        camera: &Camera,
        centre: DVec3,
    ) -> Result<(Look, Lights), InvalidLight> {
        let lights = self.light.lights(camera, centre, self.environment)?;
        Ok((self.look.look(&lights, camera, centre), lights))
    }

    /// The cameras of a turntable, all at one distance, each with its lights: they move around the head to its left, so
    /// that it seems to turn to its right.
    ///
    /// # Errors
    /// As [`Self::scene`].
    pub fn turntable(
        &self,
        strands: &Strands,
        surface: Option<&Surface>,
        frames: usize,
        aspect: f64,
    ) -> Result<Vec<(Camera, Lights)>, InvalidLight> {
        let (low, high) = framed_bounds(strands, surface);
        let axis = 0.5 * (low + high);
        let points: Vec<DVec3> = framed_points(strands, surface).collect();
        let around = points.iter().step_by(TURNTABLE_POSITIONS).flat_map(|p| {
            let (radius, height) = ((*p - axis).truncate().length(), p.z);
            (0..TURNTABLE_POSITIONS).map(move |i| {
                let (s, c) = (i as f64 / TURNTABLE_POSITIONS as f64 * TAU).sin_cos();
                DVec3::new(axis.x + radius * c, axis.y + radius * s, height)
            })
        });
        self.turntable_from(self.camera.frame(around, aspect), strands, surface, frames)
    }

    /// The cameras of a turntable that begins at `first`, each with its lights.
    ///
    /// # Errors
    /// As [`Self::scene`].
    pub fn turntable_from(
        &self,
        first: Camera,
        strands: &Strands,
        surface: Option<&Surface>,
        frames: usize,
    ) -> Result<Vec<(Camera, Lights)>, InvalidLight> {
        let (low, high) = framed_bounds(strands, surface);
        let (axis, centre) = (0.5 * (low + high), head_centre(strands, surface));
        let frame = |i: usize| {
            let camera = first.turned(axis, i as f64 / frames as f64 * TAU);
            Ok((camera, self.light.lights(&camera, centre, self.environment)?))
        };
        (0..frames).map(frame).collect()
    }
}

/// Bounds of strands and surface together (m).
fn all_bounds(strands: &Strands, surface: Option<&Surface>) -> (DVec3, DVec3) {
    let hair = strands.bounds().map(|(low, high)| (low.as_dvec3(), high.as_dvec3()));
    match (surface.map(Surface::bounds), hair) {
        (Some(a), Some(b)) => (a.0.min(b.0), a.1.max(b.1)),
        (a, b) => a.or(b).unwrap_or_default(),
    }
}

/// The points that a picture must show: of the hair, and of the head without the shoulders.
fn framed_points<'a>(
    strands: &'a Strands,
    surface: Option<&'a Surface>,
) -> impl Iterator<Item = DVec3> + Clone {
    let (low, high) = framed_bounds(strands, surface);
    // Whole strands, since points at one distance from the root might all be left out; and every tip.
    let step = strands.points().len() / FRAMED_POINTS + 1;
    let points = |ends: &'a [u32]| &strands.points()[ends[0] as usize..ends[1] as usize];
    let whole = strands.offsets().windows(2).step_by(step).flat_map(points);
    let tips = strands.offsets().windows(2).filter_map(move |ends| points(ends).last());
    let hair = whole.chain(tips).map(|p| p.as_dvec3());
    let inside = move |p: &DVec3| p.cmpge(low).all() && p.cmple(high).all();
    let skin = surface.into_iter().flat_map(|s| s.positions().iter().copied());
    hair.chain(skin).filter(inside)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn every_tip_is_framed_even_where_points_are_thinned_out() {
        // So many points that the stride skips tips, and one hair longer than all others.
        let mut strands = Strands::new();
        for i in 0..4000_u16 {
            let length = if i == 1234 { 0.4 } else { 0.2 };
            let points: Vec<Vec3> =
                (0..50_u8).map(|k| Vec3::NEG_Z * length * f32::from(k) / 49.0).collect();
            strands.push(&points, &[3e-5; 50]);
        }
        let lowest = framed_points(&strands, None).map(|p| p.z).fold(0.0, f64::min);
        assert!((lowest + 0.4).abs() < 1e-6, "{lowest}");
    }
}
