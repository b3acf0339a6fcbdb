//! What is in a picture, and the scene of the renderers.

use frisure::look::{Camera, CameraSpec, EnvironmentMap, Lights};
use frisure::progress::{Cancelled, Progress, SubStage};
use frisure::render::preview::{self, PreviewError, PreviewOptions};
use frisure::render::trace::{TraceError, TraceOptions, Tracer};
use frisure::render::{self, Image, PictureSpec};
use frisure::scene::Scene;
use frisure::strands::{AccessoryMesh, Strands, Surface};
use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::options::spec;
use crate::error::Error;
use crate::runner::LoadedScene;

/// The camera of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Viewpoint {
    /// Position of the camera (m).
    pub eye: [f64; 3],
    /// The point that it looks at (m).
    pub target: [f64; 3],
    /// Vertical field of view (rad).
    pub field_of_view: f64,
}

/// From where the pictures of a subject are taken.
#[derive(Clone, Debug, Default)]
pub enum Frames {
    /// One, from the scene's camera.
    #[default]
    Scene,
    /// One from each of these azimuths (rad, from the face to the head's left) in place of that of the scene's camera; at least one.
    Azimuths(Vec<f64>),
    /// So many from all around the head; the first is from the scene's camera.
    Turntable(usize),
}

/// What is in a picture.
#[derive(Clone, Debug)]
pub struct Subject<'a> {
    /// Camera, light and look.
    pub scene: &'a Scene,
    /// The hairs.
    pub strands: &'a Strands,
    /// The hairs that the camera is placed for, of which `strands` may be a part.
    pub framed: &'a Strands,
    /// The head.
    pub surface: Option<&'a Surface>,
    /// What holds the hair; the camera is not placed for it.
    pub accessories: Vec<AccessoryMesh>,
    /// The scene's environment map ([`crate::environment_map`]).
    pub environment: Option<&'a EnvironmentMap>,
}

impl LoadedScene {
    /// The subject of strands on the scene's head, with the scene's environment map, and with what holds the hair unless
    /// `output.accessories` is false.
    #[must_use]
    pub fn subject<'a>(
        &'a self,
        strands: &'a Strands,
        environment: Option<&'a EnvironmentMap>,
    ) -> Subject<'a> {
        let surface = Some(self.head.surface());
        let accessories = self.shown_accessories();
        Subject { scene: &self.scene, strands, framed: strands, surface, accessories, environment }
    }
}

impl Subject<'_> {
    /// The tracer of the picture from a viewpoint; without one, from the scene's camera.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub fn tracer(
        &self,
        viewpoint: Option<Viewpoint>,
        options: &TraceOptions,
    ) -> Result<Tracer, Error> {
        let aspect = options.width as f64 / options.height as f64;
        self.tracer_from(self.camera(viewpoint, aspect)?, options)
    }

    /// The tracer of the picture from a camera.
    pub(super) fn tracer_from(
        &self,
        camera: Camera,
        options: &TraceOptions,
    ) -> Result<Tracer, Error> {
        let scene = self.render_scene(camera)?;
        Tracer::new(&scene, options).map_err(|e| match e {
            TraceError::Cancelled => Error::Cancelled(Cancelled),
            e => Error::because(&e, ""),
        })
    }

    /// The picture from the scene's camera in seconds, by projection.
    ///
    /// # Errors
    /// [`Error::Cancelled`] and [`Error::Invalid`].
    pub fn preview(
        &self,
        options: &PreviewOptions,
        progress: &dyn Progress,
    ) -> Result<Image, Error> {
        let aspect = options.width as f64 / options.height as f64;
        project(&self.render_scene(self.camera(None, aspect)?)?, options, progress)
    }

    /// Pictures by projection, in the order of `frames` from the number `first` on; `each` gets one after the other, since all of a
    /// turntable may take more memory than there is.
    ///
    /// # Errors
    /// [`Error::Cancelled`], [`Error::Invalid`], and those of `each`.
    pub fn previews(
        &self,
        frames: &Frames,
        first: usize,
        options: &PreviewOptions,
        progress: &dyn Progress,
        each: &mut dyn FnMut(usize, &Image) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let views = self.frames(frames, options.width as f64 / options.height as f64)?;
        let mut scene = self.render_scene(views[0].0)?;
        let count = views.len();
        for (index, (camera, lights)) in views.into_iter().enumerate().skip(first) {
            (scene.camera, scene.lights) = (camera, lights);
            let at = |part: usize| (index + part) as f64 / count as f64;
            let stage = SubStage { progress, stage: "picture", range: [at(0), at(1)] };
            each(index, &project(&scene, options, &stage)?)?;
        }
        Ok(())
    }

    /// The cameras and lights of `frames`, at least one. `aspect` is width over height.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub(super) fn frames(
        &self,
        frames: &Frames,
        aspect: f64,
    ) -> Result<Vec<(Camera, Lights)>, Error> {
        let azimuths = match frames {
            Frames::Turntable(count) => return self.views(None, *count, aspect),
            Frames::Scene => &[self.scene.camera.azimuth][..],
            Frames::Azimuths(azimuths) => azimuths,
        };
        let spec = spec(self.scene, self.environment);
        let view = |azimuth: &f64| {
            let from = CameraSpec { azimuth: *azimuth, ..*spec.camera };
            let spec = PictureSpec { camera: &from, ..spec };
            let camera = spec.frame(self.framed, self.surface, aspect);
            let scene = spec.scene(camera, self.strands, self.framed, self.surface);
            scene.map(|scene| (camera, scene.lights)).map_err(|e| Error::because(&e, ""))
        };
        azimuths.iter().map(view).collect()
    }

    /// The cameras and lights of `frames` pictures around the head; the first is from the viewpoint, or from the direction of
    /// the scene's camera. `aspect` is width over height.
    ///
    /// # Errors
    /// [`Error::Invalid`].
    pub fn views(
        &self,
        viewpoint: Option<Viewpoint>,
        frames: usize,
        aspect: f64,
    ) -> Result<Vec<(Camera, Lights)>, Error> {
        let spec = spec(self.scene, self.environment);
        let (strands, surface) = (self.strands, self.surface);
        let views = match viewpoint {
            Some(_) => {
                let first = self.camera(viewpoint, aspect)?;
                spec.turntable_from(first, strands, surface, frames)
            }
            None => spec.turntable(strands, surface, frames, aspect),
        };
        views.map_err(|e| Error::because(&e, ""))
    }

    /// The scene of the renderers from a camera.
    pub(super) fn render_scene(&self, camera: Camera) -> Result<render::Scene<'_>, Error> {
        let spec = spec(self.scene, self.environment);
        let scene = spec.scene(camera, self.strands, self.framed, self.surface);
        let scene = scene.map_err(|e| Error::because(&e, ""))?;
        Ok(render::Scene { accessories: &self.accessories, ..scene })
    }

    fn camera(&self, viewpoint: Option<Viewpoint>, aspect: f64) -> Result<Camera, Error> {
        let Some(Viewpoint { eye, target, field_of_view }) = viewpoint else {
            let spec = spec(self.scene, self.environment);
            return Ok(spec.frame(self.framed, self.surface, aspect));
        };
        let [eye, target] = [eye, target].map(DVec3::from_array);
        let camera = self.scene.camera.at(eye, target, field_of_view, aspect);
        camera.map_err(|e| Error::because(&e, "look from somewhere else"))
    }
}

/// Renders a scene by projection.
pub(super) fn project(
    scene: &render::Scene<'_>,
    options: &PreviewOptions,
    progress: &dyn Progress,
) -> Result<Image, Error> {
    preview::render(scene, options, progress).map_err(|e| match e {
        PreviewError::Cancelled => Error::Cancelled(Cancelled),
        e @ PreviewError::Size { .. } => Error::because(&e, ""),
    })
}
