//! Draws the hair with wgpu in the window's own render pass.

use std::sync::{Arc, Mutex};

use eframe::egui_wgpu::{CallbackResources, CallbackTrait, RenderState, ScreenDescriptor};
use eframe::{egui, wgpu};
use frisure::look::{Camera, HairLook, Lights, Look, ToneCurve};
use frisure::render::all_hair;
use frisure_engine::{AccessoryData, Preview};
use frisure_view::{Canvas, Frame, Hair, Line, Mark, Plane, Renderer, Shadows, Skin, ViewError};

use crate::state::{HeadMesh, strands_of};

/// One of the two pictures side by side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// The current hair.
    Now,
    /// The hair of an earlier edit.
    Before,
}

/// One side of a comparison, or the only one.
pub(super) struct Pane {
    pub(super) side: Side,
    /// The part of the window that shows it.
    pub(super) shown: egui::Rect,
}

/// A value with a number that is unique to it.
pub(super) type Versioned<T> = (Arc<T>, u64);

/// A picture to draw.
pub(super) struct Picture {
    pub(super) side: Side,
    pub(super) hair: Option<Versioned<Preview>>,
    pub(super) head: Option<Versioned<HeadMesh>>,
    pub(super) marks: Option<Versioned<Vec<Mark>>>,
    pub(super) view: View,
    /// The rectangle in the window (points).
    pub(super) rect: egui::Rect,
    /// The last error, for a message.
    pub(super) error: Arc<Mutex<Option<String>>>,
}

/// The parameters of a picture other than hair and head.
#[derive(Clone, PartialEq)]
pub(super) struct View {
    pub(super) camera: Camera,
    pub(super) lights: Lights,
    pub(super) look: Look,
    pub(super) lines: Vec<Line>,
    pub(super) planes: Vec<Plane>,
    pub(super) share: f32,
    pub(super) shadows: Shadows,
    pub(super) tone: ToneCurve,
    pub(super) stops: f32,
}

/// The resources on the device.
struct Gpu {
    device: wgpu::Device,
    renderer: Renderer,
    targets: [Target; 2],
    skin: Option<Dressed>,
}

/// The head with what holds the hair.
struct Dressed {
    skin: Skin,
    /// Versions of the head, and of the hair whose accessories were compared last.
    versions: [u64; 2],
    worn: AccessoryData,
}

impl Dressed {
    /// The head with the accessories of a picture; what was drawn before where nothing has changed.
    fn of(
        before: Option<Self>,
        renderer: &Renderer,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        picture: &Picture,
    ) -> Option<Self> {
        let (mesh, head) = picture.head.as_ref()?;
        // The head is drawn once for both sides of a comparison: with what holds the hair of the current one.
        let hair = picture.hair.as_ref().filter(|_| picture.side == Side::Now);
        let before = before.filter(|before| before.versions[0] == *head);
        let version = hair.map_or(0, |(_, version)| *version);
        let worn = match (hair, before) {
            (None, Some(before)) => return Some(before),
            (Some((hair, _)), Some(before))
                if before.versions[1] == version || before.worn == hair.accessories =>
            {
                return Some(Self { versions: [*head, version], ..before });
            }
            (hair, _) => hair.map(|(hair, _)| hair.accessories.clone()).unwrap_or_default(),
        };
        let surface = mesh.surface()?;
        let skin = Skin::with_accessories(renderer, device, queue, surface, &worn.meshes());
        Some(Self { skin, versions: [*head, version], worn })
    }
}

/// The canvas of one side, and the hair on it.
#[derive(Default)]
struct Target {
    canvas: Option<Canvas>,
    hair: Option<UploadedHair>,
    /// Everything that the drawn picture depends on: size, versions of hair, head and marks, and the view.
    drawn: Option<([u32; 2], [u64; 3], View)>,
}

struct UploadedHair {
    hair: Hair,
    /// Of the hair, and of the head whose brows and lashes are with it.
    versions: [u64; 2],
    look: HairLook,
    marks: u64,
}

/// Creates the renderer of a window.
pub(super) fn install(state: &RenderState, samples: u32) {
    let renderer = Renderer::new(&state.device, &state.queue, state.target_format, samples);
    let gpu =
        Gpu { device: state.device.clone(), renderer, targets: Default::default(), skin: None };
    state.renderer.write().callback_resources.insert(gpu);
}

impl CallbackTrait for Picture {
    fn prepare(
        &self,
        _device: &wgpu::Device,
        queue: &wgpu::Queue,
        screen: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(gpu) = resources.get_mut::<Gpu>() {
            let size = self.rect.size() * screen.pixels_per_point;
            let size = [size.x, size.y].map(|x| x.round().max(1.0) as u32);
            if let Err(error) = gpu.draw(queue, encoder, self, size)
                && let Ok(mut slot) = self.error.lock()
            {
                *slot = Some(error.to_string());
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
        let Some(gpu) = resources.get::<Gpu>() else { return };
        if let Some(canvas) = &gpu.targets[self.side as usize].canvas {
            gpu.renderer.show(&gpu.device, pass, canvas);
        }
    }
}

fn version<T>(versioned: Option<&Versioned<T>>) -> u64 {
    versioned.map_or(0, |(_, version)| *version)
}

impl Gpu {
    fn draw(
        &mut self,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        picture: &Picture,
        size: [u32; 2],
    ) -> Result<(), ViewError> {
        let Self { device, renderer, targets, skin } = self;
        *skin = Dressed::of(skin.take(), renderer, device, queue, picture);
        let target = &mut targets[picture.side as usize];
        let most = device.limits().max_texture_dimension_2d;
        let size = size.map(|x| x.min(most));
        match &mut target.canvas {
            Some(canvas) if canvas.size() == size => {}
            Some(canvas) => canvas.resize(device, size)?,
            None => target.canvas = Some(Canvas::new(device, size)?),
        }
        target.update_hair(renderer, device, queue, picture);
        let versions = [
            version(picture.hair.as_ref()),
            version(picture.head.as_ref()),
            version(picture.marks.as_ref()),
        ];
        let view = &picture.view;
        if target.drawn.as_ref().is_some_and(|(s, v, w)| (s, v, w) == (&size, &versions, view)) {
            return Ok(());
        }
        let mut frame = Frame::new(view.camera, &view.lights, &view.look);
        frame.hair = target.hair.as_ref().map(|uploaded| &uploaded.hair);
        frame.skin = skin.as_ref().map(|dressed| &dressed.skin);
        frame.share = view.share;
        frame.shadows = view.shadows;
        frame.lines = &view.lines;
        frame.planes = &view.planes;
        frame.tone = view.tone;
        frame.stops = view.stops;
        if let Some(canvas) = &mut target.canvas {
            renderer.draw(device, queue, encoder, canvas, &frame);
        }
        target.drawn = Some((size, versions, view.clone()));
        Ok(())
    }
}

impl Target {
    /// Uploads the hair, its colours and its marks if they have changed.
    fn update_hair(
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
        let look = picture.view.look.hair;
        let versions = [*version, self::version(picture.head.as_ref())];
        if self.hair.as_ref().is_none_or(|uploaded| uploaded.versions != versions) {
            let surface = picture.head.as_ref().and_then(|(head, _)| head.surface());
            let strands = strands_of(&hair.strands);
            let strands = all_hair(&strands, surface);
            let hair = Hair::new(renderer, device, queue, &strands, &look);
            self.hair = Some(UploadedHair { hair, versions, look, marks: 0 });
        }
        let Some(uploaded) = &mut self.hair else { return };
        if uploaded.look != look {
            uploaded.hair.recolour(renderer, device, queue, &look);
            uploaded.look = look;
        }
        let (marks, version) = match &picture.marks {
            Some((marks, version)) => (marks.as_slice(), *version),
            None => (&[][..], 0),
        };
        if uploaded.marks != version {
            uploaded.hair.mark(queue, marks);
            uploaded.marks = version;
        }
    }
}
