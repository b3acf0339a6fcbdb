//! Results of the last picture that the next one can use.

use frisure_look::{Background, EnvironmentLight, Lights};
use frisure_render::preview;
use frisure_render::preview::DirectionalLights;
use frisure_strands::Strands;
use glam::{DVec3, Vec3};
use wgpu::{BindGroup, Buffer, BufferUsages, CommandEncoder, Device, Queue, TextureView};

use crate::ambient::{AmbientVolume, environment_texture};
use crate::context::FrameContext;
use crate::frame::Frame;
use crate::gpu;
use crate::renderer::Renderer;
use crate::ribbons::{Shaded, Sorted};
use crate::shadow_maps::ShadowMaps;
use crate::uniforms;

/// Results of the last picture.
#[derive(Debug, Default)]
pub(crate) struct FrameCache {
    pub(crate) numbers: Option<(Buffer, BindGroup)>,
    lights: Option<(Lights, DVec3, DirectionalLights)>,
    environment: Option<(AmbientKey, AmbientVolume)>,
    pub(crate) environment_map: Option<(Option<EnvironmentLight>, TextureView)>,
    pub(crate) maps: Option<ShadowMaps>,
    pub(crate) shaded: Option<Shaded>,
    pub(crate) sorted: Option<Sorted>,
}

/// The key of the environment's light.
type AmbientKey = (Option<(u64, Vec3)>, Option<u64>, [Vec3; preview::DIRECTION_COUNT]);

impl FrameCache {
    pub(crate) fn lights(&self) -> Option<&DirectionalLights> {
        self.lights.as_ref().map(|(_, _, at_point)| at_point)
    }

    pub(crate) fn environment(&self) -> Option<&AmbientVolume> {
        self.environment.as_ref().map(|(_, environment)| environment)
    }

    /// Makes what the picture needs and is not there.
    pub(crate) fn prepare(
        &mut self,
        renderer: &Renderer,
        device: &Device,
        queue: &Queue,
        frame: &Frame<'_>,
    ) {
        self.numbers.get_or_insert_with(|| {
            let bytes = [0; uniforms::BYTES];
            let buffer = gpu::buffer(device, queue, "numbers", &bytes, BufferUsages::UNIFORM);
            let entire = [buffer.as_entire_binding()];
            let group = gpu::group(device, &renderer.layouts.picture, &entire);
            (buffer, group)
        });
        let at_point = self.at_point(frame);
        let of_hair = frame.hair.map(|hair| (hair.shape(), hair.extinction()));
        let key = (of_hair, frame.skin.map(crate::skin::Skin::version), at_point.environment);
        if self.environment.as_ref().is_none_or(|(known, _)| *known != key) {
            let things = (frame.hair, frame.skin);
            let environment = AmbientVolume::new(
                &renderer.layouts.environment,
                device,
                queue,
                things,
                at_point.environment,
            );
            self.environment = Some((key, environment));
        }
        self.maps.get_or_insert_with(|| ShadowMaps::new(renderer, device, queue));
        if let Some(hair) = frame.hair
            && self.shaded.as_ref().is_none_or(|shaded| shaded.shape != hair.shape())
        {
            self.shaded = Some(Shaded::new(renderer, device, hair));
        }
        let seen = matches!(frame.look.background, Background::Environment);
        let around = seen.then_some(&frame.lights.environment);
        if self.environment_map.as_ref().is_none_or(|(of, _)| of.as_ref() != around) {
            let view = gpu::whole(&environment_texture(device, queue, around));
            self.environment_map = Some((around.cloned(), view));
        }
    }

    /// The lights at the middle of the picture, computed again only where they changed.
    fn at_point(&mut self, frame: &Frame<'_>) -> DirectionalLights {
        let place = middle(frame);
        if let Some((lights, of, at_point)) = &self.lights
            && lights == frame.lights
            && *of == place
        {
            return at_point.clone();
        }
        let at_point = DirectionalLights::new(frame.lights, place);
        self.lights = Some((frame.lights.clone(), place, at_point.clone()));
        at_point
    }

    /// Shadows, where lamps, hair or head have moved.
    pub(crate) fn draw_maps(&mut self, job: &FrameContext<'_>, encoder: &mut CommandEncoder) {
        let ribbons = self.shaded.as_ref().map(|shaded| &shaded.group);
        if let Some(maps) = &mut self.maps {
            maps.draw(job, encoder, ribbons);
        }
    }
}

/// The point at which lamps are aimed.
fn middle(frame: &Frame<'_>) -> DVec3 {
    match (frame.skin, frame.hair) {
        (Some(skin), _) => skin.middle(),
        (None, Some(hair)) => {
            let (low, high) = hair.bounds();
            0.5 * (low + high).as_dvec3()
        }
        _ => frisure_render::head_centre(&Strands::new(), None),
    }
}
