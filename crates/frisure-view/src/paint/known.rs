//! What was computed for the last picture and may be right for the next.

use frisure_render::preview::parts::FewLights;
use frisure_render::{Background, Lights, Room, preview};
use frisure_strands::Strands;
use glam::{DVec3, Vec3};
use wgpu::{BindGroup, Buffer, BufferUsages, CommandEncoder, Device, Queue, TextureView};

use super::Job;
use super::hair::{Shaded, Sorted};
use crate::frame::Frame;
use crate::gpu;
use crate::maps::Maps;
use crate::renderer::Renderer;
use crate::room::{RoomOnDevice, surroundings};
use crate::uniforms;

/// All of it.
#[derive(Debug, Default)]
pub(crate) struct Known {
    pub(super) numbers: Option<(Buffer, BindGroup)>,
    lights: Option<(Lights, DVec3, FewLights)>,
    room: Option<(RoomKey, RoomOnDevice)>,
    pub(super) surroundings: Option<(Option<Room>, TextureView)>,
    pub(super) maps: Option<Maps>,
    pub(super) shaded: Option<Shaded>,
    pub(super) sorted: Option<Sorted>,
}

/// What the room's light depends on.
type RoomKey = (Option<(u64, Vec3)>, Option<u64>, [Vec3; preview::parts::AROUND]);

impl Known {
    pub(super) fn lights(&self) -> Option<&FewLights> {
        self.lights.as_ref().map(|(_, _, few)| few)
    }

    pub(super) fn room(&self) -> Option<&RoomOnDevice> {
        self.room.as_ref().map(|(_, room)| room)
    }

    /// Makes what the picture needs and is not there.
    pub(super) fn prepare(
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
        let few = self.few(frame);
        let of_hair = frame.hair.map(|hair| (hair.shape(), hair.taken()));
        let key = (of_hair, frame.skin.map(crate::Skin::version), few.room);
        if self.room.as_ref().is_none_or(|(known, _)| *known != key) {
            let things = (frame.hair, frame.skin);
            let room = RoomOnDevice::new(&renderer.layouts.room, device, queue, things, few.room);
            self.room = Some((key, room));
        }
        self.maps.get_or_insert_with(|| Maps::new(renderer, device, queue));
        if let Some(hair) = frame.hair
            && self.shaded.as_ref().is_none_or(|shaded| shaded.shape != hair.shape())
        {
            self.shaded = Some(Shaded::new(renderer, device, hair));
        }
        let seen = matches!(frame.look.background, Background::Surroundings);
        let around = seen.then_some(&frame.lights.room);
        if self.surroundings.as_ref().is_none_or(|(of, _)| of.as_ref() != around) {
            let view = gpu::whole(&surroundings(device, queue, around));
            self.surroundings = Some((around.cloned(), view));
        }
    }

    /// The lights in few numbers.
    fn few(&mut self, frame: &Frame<'_>) -> FewLights {
        let place = middle(frame);
        if let Some((lights, of, few)) = &self.lights
            && lights == frame.lights
            && *of == place
        {
            return few.clone();
        }
        let few = FewLights::new(frame.lights, place);
        self.lights = Some((frame.lights.clone(), place, few.clone()));
        few
    }

    /// Shadows, where lamps, hair or head have moved.
    pub(super) fn draw_maps(&mut self, job: &Job<'_>, encoder: &mut CommandEncoder) {
        let ribbons = self.shaded.as_ref().map(|shaded| &shaded.group);
        if let Some(maps) = &mut self.maps {
            maps.draw(job, encoder, ribbons);
        }
    }
}

/// What lamps are aimed at.
fn middle(frame: &Frame<'_>) -> DVec3 {
    match (frame.skin, frame.hair) {
        (Some(skin), _) => skin.middle(),
        (None, Some(hair)) => {
            let (low, high) = hair.bounds();
            0.5 * (low + high).as_dvec3()
        }
        _ => preview::middle(&Strands::new(), None),
    }
}
