//! Pictures of a hairstyle with maps of their hairs, from the cameras of a batch: data for programs that learn.

use frisure::files::Files;
use frisure::hairstyle::StrandOptions;
use frisure::look::CameraSpec;
use frisure::progress::Progress;
use frisure::render::maps::{MappedPixel, Mapper, Pinhole};
use frisure::render::preview::{PreviewOptions, chosen_width};
use frisure::scene::batch::{ViewCamera, ViewOutput, Views};
use frisure::strands::{AttributeValues, Strands};

use super::options::{developed, spec};
use super::subject::{Subject, project};
use crate::error::Error;
use crate::inputs::environment_map;
use crate::runner::LoadedScene;

/// A picture of a hairstyle, and what each pixel of it shows.
#[derive(Clone, Debug)]
pub struct View {
    /// The camera in pixels.
    pub camera: Pinhole,
    /// Red, green, blue and alpha (sRGB) of each pixel, row by row from the top left; empty unless the batch stores it, since it
    /// takes most of the time.
    pub color: Vec<u8>,
    /// What each pixel shows; the index of a hair is that among all drawn hairs of the head.
    pub pixels: Vec<MappedPixel>,
}

/// The hairs of a hairstyle that its views show.
#[derive(Debug)]
pub struct Viewed<'a> {
    loaded: &'a LoadedScene,
    views: &'a Views,
    strands: Strands,
    mapper: Mapper,
    /// The hairs are the first of all and each so many after it.
    stride: usize,
    /// Factor on the width of the hairs, with which they cover as much as all.
    width: f32,
}

impl<'a> Viewed<'a> {
    /// Draws the hairs that the views of a batch show.
    ///
    /// # Errors
    /// [`Error::Cancelled`], and [`Error::Invalid`] for hairs that cannot be seen.
    pub fn new(
        loaded: &'a LoadedScene,
        views: &'a Views,
        progress: &dyn Progress,
    ) -> Result<Self, Error> {
        let stride = loaded.hairstyle.drawn().div_ceil(views.hairs).max(1);
        let options = StrandOptions { stride, ..StrandOptions::default() };
        let strands = loaded.draw(options, progress)?.strands;
        let width = chosen_width(strands.len());
        let mapper = Mapper::new(&strands, Some(loaded.head.surface()), width);
        let mapper = mapper.map_err(|e| Error::because(&e, ""))?;
        Ok(Self { loaded, views, strands, mapper, stride, width })
    }

    /// The factor on the width of hairs.
    #[must_use]
    pub fn width(&self) -> f32 {
        self.width
    }

    /// The index of the guide that a hair follows most, by the index of the hair among all.
    #[must_use]
    pub fn guide(&self, hair: u32) -> Option<u32> {
        match self.strands.attribute("guide").map(|a| &a.values) {
            Some(AttributeValues::U32(guides)) => guides.get(hair as usize / self.stride).copied(),
            _ => None,
        }
    }

    /// The picture from a camera, and its maps.
    ///
    /// # Errors
    /// [`Error::Cancelled`], and [`Error::Invalid`] for a scene that cannot be shown.
    pub fn view(&self, camera: &ViewCamera, progress: &dyn Progress) -> Result<View, Error> {
        let Views { width, height, samples, .. } = *self.views;
        let mut scene = (*self.loaded.scene).clone();
        let ViewCamera { azimuth, elevation, .. } = *camera;
        scene.camera = CameraSpec { azimuth, elevation, ..scene.camera };
        let environment = environment_map(&scene, &Files::default())?;
        let subject = Subject {
            scene: &scene,
            strands: &self.strands,
            framed: &self.strands,
            surface: Some(self.loaded.head.surface()),
            // The maps of hair have none either.
            accessories: Vec::new(),
            environment: environment.as_ref(),
        };
        let aspect = width as f64 / height as f64;
        let framed =
            spec(&scene, environment.as_ref()).frame(&self.strands, subject.surface, aspect);
        let color = match self.views.outputs.contains(&ViewOutput::Color) {
            true => {
                let options = PreviewOptions {
                    width,
                    height,
                    samples: scene.output.samples,
                    width_scale: Some(self.width),
                };
                let image = project(&subject.render_scene(framed)?, &options, progress)?;
                developed(&image, &scene.output)
            }
            false => Vec::new(),
        };
        let camera = Pinhole::new(&framed, width, height);
        let mut pixels = self.mapper.maps(&camera, samples, progress)?;
        for hair in pixels.iter_mut().filter_map(|pixel| pixel.strand.as_mut()) {
            hair.index *= self.stride as u32;
        }
        Ok(View { camera, color, pixels })
    }
}
