//! The picture of the hair on the device, inside the window's own frame.

use std::sync::{Arc, Mutex};

use eframe::egui_wgpu::{CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};
use eframe::{egui, wgpu};
use frisure::look::{Camera, Lights, Look, ToneCurve};
use frisure::strands::{Attribute, AttributeValues, Domain, Strands};
use frisure_engine::StrandsData;
use frisure_view::{Canvas, Frame, Hair, Line, Mark, Plane, Renderer, Shadows, Skin, ViewError};
use glam::Vec3;

use crate::state::HeadMesh;

/// Which of the pictures side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The hair as it is.
    Now,
    /// The hair as it was.
    Before,
}

/// A picture to be drawn.
pub(super) struct Picture {
    pub(super) side: Side,
    /// The hair, and a number that differs for each.
    pub(super) hair: Option<(Arc<dyn AsStrands>, u64)>,
    /// The head, and a number that differs for each.
    pub(super) head: Option<(Arc<HeadMesh>, u64)>,
    pub(super) camera: Camera,
    pub(super) lights: Lights,
    pub(super) look: Look,
    pub(super) marks: Option<(Arc<Vec<Mark>>, u64)>,
    pub(super) lines: Vec<Line>,
    pub(super) planes: Vec<Plane>,
    pub(super) share: f32,
    pub(super) shadows: Shadows,
    pub(super) tone: ToneCurve,
    pub(super) stops: f32,
    /// Where it is in the window (points).
    pub(super) rect: egui::Rect,
    /// What went wrong while it was drawn, for the window to tell.
    pub(super) trouble: Arc<Mutex<Option<String>>>,
}

/// Something that has strands.
pub(super) trait AsStrands: Send + Sync {
    fn strands(&self) -> &StrandsData;
}

impl AsStrands for frisure_engine::Preview {
    fn strands(&self) -> &StrandsData {
        &self.strands
    }
}

/// Plain arrays as strands; of arrays that do not fit together, what does.
fn as_strands(data: &StrandsData) -> Strands {
    let mut strands = Strands::with_capacity(data.guide.len(), data.radii.len());
    let points: Vec<Vec3> =
        data.points.as_chunks().0.iter().map(|p| Vec3::from_array(*p)).collect();
    for ends in data.offsets.windows(2) {
        let piece = ends[0] as usize..ends[1] as usize;
        if let (Some(points), Some(radii)) = (points.get(piece.clone()), data.radii.get(piece)) {
            strands.push(points, radii);
        }
    }
    let mut set = |name: &str, domain, values| {
        // What does not fit is left out.
        let _ = strands.set_attribute(Attribute { name: name.into(), domain, values });
    };
    set("guide", Domain::Strand, AttributeValues::U32(data.guide.clone()));
    if !data.wetness.is_empty() {
        set("wetness", Domain::Point, AttributeValues::F32(data.wetness.clone()));
    }
    strands
}

/// What is on the device.
struct Theatre {
    device: wgpu::Device,
    renderer: Renderer,
    stages: [Stage; 2],
    skin: Option<(Skin, u64)>,
}

#[derive(Default)]
struct Stage {
    canvas: Option<Canvas>,
    hair: Option<Dressed>,
    /// What the canvas shows.
    drawn: Option<Drawn>,
}

struct Dressed {
    hair: Hair,
    version: u64,
    look: frisure::look::HairLook,
    marks: u64,
}

/// All that a picture depends on: as long as it is the same, the canvas is, too.
#[derive(PartialEq)]
struct Drawn {
    size: [u32; 2],
    hair: u64,
    head: u64,
    marks: u64,
    camera: Camera,
    lights: Lights,
    look: Look,
    lines: Vec<Line>,
    planes: Vec<Plane>,
    share: f32,
    shadows: Shadows,
    stops: f32,
}

/// Makes the theatre of a window.
pub(super) fn build(state: &RenderState, samples: u32) {
    let renderer = Renderer::new(&state.device, &state.queue, state.target_format, samples);
    let theatre =
        Theatre { device: state.device.clone(), renderer, stages: Default::default(), skin: None };
    state.renderer.write().callback_resources.insert(theatre);
}

impl CallbackTrait for Picture {
    fn prepare(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        screen: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(theatre) = resources.get_mut::<Theatre>() {
            let scale = screen.pixels_per_point;
            let size = [self.rect.width(), self.rect.height()];
            let size = size.map(|x| (x * scale).round().max(1.0) as u32);
            if let Err(error) = theatre.stage(device, queue, encoder, self, size)
                && let Ok(mut trouble) = self.trouble.lock()
            {
                *trouble = Some(error.to_string());
            }
        }
        Vec::new()
    }

    fn paint(
        &self,
        _info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let Some(theatre) = resources.get::<Theatre>() else { return };
        if let Some(canvas) = &theatre.stages[self.side as usize].canvas {
            theatre.renderer.show(&theatre.device, pass, canvas);
        }
    }
}

impl Theatre {
    fn stage(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        picture: &Picture,
        size: [u32; 2],
    ) -> Result<(), ViewError> {
        self.head(device, queue, picture);
        let stage = &mut self.stages[picture.side as usize];
        let most = device.limits().max_texture_dimension_2d;
        let size = size.map(|x| x.min(most));
        match &mut stage.canvas {
            Some(canvas) if canvas.size() == size => {}
            Some(canvas) => {
                canvas.resize(device, size)?;
                stage.drawn = None;
            }
            None => stage.canvas = Some(Canvas::new(device, size)?),
        }
        stage.dress(&self.renderer, device, queue, picture);
        let drawn = Drawn {
            size,
            hair: picture.hair.as_ref().map_or(0, |h| h.1),
            head: picture.head.as_ref().map_or(0, |h| h.1),
            marks: picture.marks.as_ref().map_or(0, |m| m.1),
            camera: picture.camera,
            lights: picture.lights.clone(),
            look: picture.look.clone(),
            lines: picture.lines.clone(),
            planes: picture.planes.clone(),
            share: picture.share,
            shadows: picture.shadows,
            stops: picture.stops,
        };
        if stage.drawn.as_ref() == Some(&drawn) {
            return Ok(());
        }
        let mut frame = Frame::new(picture.camera, &picture.lights, &picture.look);
        frame.hair = stage.hair.as_ref().map(|dressed| &dressed.hair);
        frame.skin = self.skin.as_ref().map(|(skin, _)| skin);
        frame.share = picture.share;
        frame.shadows = picture.shadows;
        frame.lines = &picture.lines;
        frame.planes = &picture.planes;
        frame.tone = picture.tone;
        frame.stops = picture.stops;
        if let Some(canvas) = &mut stage.canvas {
            self.renderer.draw(device, queue, encoder, canvas, &frame);
        }
        stage.drawn = Some(drawn);
        Ok(())
    }

    fn head(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, picture: &Picture) {
        let Some((mesh, version)) = &picture.head else {
            self.skin = None;
            return;
        };
        if self.skin.as_ref().is_none_or(|(_, known)| known != version) {
            let skin = mesh.surface().map(|s| Skin::new(&self.renderer, device, queue, s));
            self.skin = skin.map(|skin| (skin, *version));
        }
    }
}

impl Stage {
    /// Brings hair, its colours and its marks up to date.
    fn dress(
        &mut self,
        renderer: &Renderer,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        picture: &Picture,
    ) {
        let Some((hair, version)) = &picture.hair else {
            self.hair = None;
            return;
        };
        let look = picture.look.hair;
        if self.hair.as_ref().is_none_or(|dressed| dressed.version != *version) {
            let strands = as_strands(hair.strands());
            let hair = Hair::new(renderer, device, queue, &strands, &look);
            self.hair = Some(Dressed { hair, version: *version, look, marks: 0 });
        }
        let Some(dressed) = &mut self.hair else { return };
        if dressed.look != look {
            dressed.hair.recolour(renderer, device, queue, &look);
            dressed.look = look;
        }
        let (marks, version) = match &picture.marks {
            Some((marks, version)) => (marks.as_slice(), *version),
            None => (&[][..], 0),
        };
        if dressed.marks != version {
            dressed.hair.mark(queue, marks);
            dressed.marks = version;
        }
    }
}
