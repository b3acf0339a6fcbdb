//! One picture, in the order in which it is drawn.

use bytemuck::cast_slice;
use frisure_render::preview::parts::FewLights;
use frisure_render::{Background, Camera, Lights, preview};
use frisure_strands::Strands;
use glam::{DVec3, Vec3};
use wgpu::{Buffer, BufferUsages, CommandEncoder, Device, Queue, RenderPass};

use crate::canvas::{Canvas, Fine};
use crate::frame::{Frame, Line, Shadows};
use crate::gpu;
use crate::hair::{Hair, ROW};
use crate::lamps::{Lamp, strongest};
use crate::maps::Maps;
use crate::renderer::Renderer;
use crate::room::{RoomOnDevice, surroundings};
use crate::uniforms;

/// Parts of the hair, nearest first, between which finished pixels are closed: where each ends, in parts of
/// all. The nearest hair hides most of what is behind it.
const PARTS: [f32; 6] = [0.1, 0.2, 0.32, 0.48, 0.7, 1.0];

/// What was computed for the last picture and may be right for the next.
#[derive(Debug, Default)]
pub(crate) struct Known {
    picture: Option<Buffer>,
    group: Option<wgpu::BindGroup>,
    room: Option<(RoomKey, FewLights, RoomOnDevice)>,
    maps: Option<Maps>,
    shaded: Option<Shaded>,
    sorted: Option<Sorted>,
}

/// What the room's light depends on.
#[derive(Clone, Debug, PartialEq)]
struct RoomKey {
    hair: Option<(u64, Vec3)>,
    skin: Option<u64>,
    lights: Lights,
}

/// Light at each vertex.
#[derive(Debug)]
struct Shaded {
    shape: u64,
    lights: wgpu::Texture,
    /// Places and lights for ribbons.
    group: wgpu::BindGroup,
}

/// Pieces from near to far.
#[derive(Debug)]
struct Sorted {
    key: (u64, usize, Vec3, Vec3),
    pieces: Buffer,
    room: u64,
    levels: Buffer,
    /// Where parts end.
    ends: Vec<u32>,
}

impl Known {
    /// The picture has another size.
    pub(crate) fn forget_picture(&mut self) {
        self.group = None;
    }
}

impl Renderer {
    /// Draws into the canvas: shadows, light along the hairs, head, hair, lines. The commands take effect when
    /// the caller submits the encoder.
    pub fn draw(
        &self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        canvas: &mut Canvas,
        frame: &Frame<'_>,
    ) {
        let hair = frame.hair.filter(|hair| hair.strands() > 0);
        let frame = &Frame { hair, ..frame.clone() };
        self.prepare(device, queue, canvas, frame);
        let Known { group: Some(picture), room: Some((_, lights, room)), .. } = &canvas.known
        else {
            return;
        };
        let (strands, factor) = hair.map_or((0, 1.0), |hair| hair.shared(frame.share));
        let vertices = hair.map_or(0, |hair| hair.vertices_of(strands));
        let lamps = lamps(lights, frame);
        let numbers = uniforms::packed(frame, canvas.size, room, &lamps, factor, vertices);
        if let Some(buffer) = &canvas.known.picture {
            queue.write_buffer(buffer, 0, cast_slice(&numbers));
        }
        let picture = picture.clone();
        self.draw_maps(device, queue, encoder, canvas, frame, &lamps, &picture);
        self.shade(encoder, canvas, frame, vertices, &picture);
        self.draw_head_depth(encoder, canvas, frame, &picture);
        self.draw_hair(device, queue, encoder, canvas, frame, strands, &picture);
        self.draw_head(device, encoder, canvas, frame, &picture);
        self.compose(device, queue, encoder, canvas, frame, &picture);
    }

    /// Draws the finished picture over the whole viewport of somebody else's pass.
    pub fn show(&self, device: &Device, pass: &mut RenderPass<'_>, canvas: &Canvas) {
        let view = gpu::whole(&canvas.targets.picture);
        let resources = [
            wgpu::BindingResource::TextureView(&view),
            wgpu::BindingResource::Sampler(&self.sampler),
        ];
        let group = gpu::group(device, &self.layouts.show, &resources);
        pass.set_pipeline(&self.pipelines.show);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// Makes what the picture needs and is not there.
    fn prepare(&self, device: &Device, queue: &Queue, canvas: &mut Canvas, frame: &Frame<'_>) {
        let known = &mut canvas.known;
        if known.group.is_none() {
            let size = 16 * (18 + 7 * 4 + 5 * 4);
            let bytes = vec![0; size];
            let buffer = gpu::buffer(device, queue, "numbers", &bytes, BufferUsages::UNIFORM);
            let entire = [buffer.as_entire_binding()];
            known.group = Some(gpu::group(device, &self.layouts.picture, &entire));
            known.picture = Some(buffer);
        }
        let key = RoomKey {
            hair: frame.hair.map(|hair| (hair.shape(), hair.taken())),
            skin: frame.skin.map(crate::Skin::version),
            lights: frame.lights.clone(),
        };
        if known.room.as_ref().is_none_or(|(known, ..)| !known.same_room(&key)) {
            let lights = FewLights::new(frame.lights, middle(frame));
            let things = (frame.hair, frame.skin);
            let room = RoomOnDevice::new(&self.layouts.room, device, queue, things, lights.room);
            known.room = Some((key, lights, room));
        } else if let Some((known, lights, _)) = &mut known.room
            && known.lights != key.lights
        {
            *lights = FewLights::new(frame.lights, middle(frame));
            *known = key;
        }
        if let Some(hair) = frame.hair
            && known.shaded.as_ref().is_none_or(|s| s.shape != hair.shape())
        {
            known.shaded = Some(Shaded::new(self, device, hair));
        }
        let shown = matches!(frame.look.background, Background::Surroundings);
        let room = shown.then_some(&frame.lights.room);
        if canvas.surroundings.as_ref().is_none_or(|(of, _)| of.as_ref() != room) {
            let view = gpu::whole(&surroundings(device, queue, room));
            canvas.surroundings = Some((room.cloned(), view));
        }
    }

    /// Shadows, where lamps, hair or head have moved.
    fn draw_maps(
        &self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        canvas: &mut Canvas,
        frame: &Frame<'_>,
        lamps: &[Lamp],
        picture: &wgpu::BindGroup,
    ) {
        let Known { maps, shaded, .. } = &mut canvas.known;
        let maps = maps.get_or_insert_with(|| Maps::new(self, device, queue));
        let ribbons = shaded.as_ref().map(|shaded| &shaded.group);
        maps.draw(self, device, queue, encoder, (picture, ribbons), frame, lamps);
    }

    /// The light that each vertex sends to the eye.
    fn shade(
        &self,
        encoder: &mut CommandEncoder,
        canvas: &Canvas,
        frame: &Frame<'_>,
        vertices: usize,
        picture: &wgpu::BindGroup,
    ) {
        let Known { shaded: Some(shaded), maps: Some(maps), room: Some((_, _, room)), .. } =
            &canvas.known
        else {
            return;
        };
        let Some(hair) = frame.hair else { return };
        let view = gpu::whole(&shaded.lights);
        let targets = [gpu::target(&view, Some([0.0; 4]))];
        let mut pass = gpu::pass(encoder, "light along the hairs", &targets, None);
        let rows = (vertices as u32).div_ceil(ROW).clamp(1, shaded.lights.height());
        pass.set_scissor_rect(0, 0, ROW, rows);
        pass.set_pipeline(&self.pipelines.shade);
        pass.set_bind_group(0, picture, &[]);
        pass.set_bind_group(1, maps.group(), &[]);
        pass.set_bind_group(2, &hair.groups.shade, &[]);
        pass.set_bind_group(3, &room.group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// How far away the head is, for hair that is behind it.
    fn draw_head_depth(
        &self,
        encoder: &mut CommandEncoder,
        canvas: &Canvas,
        frame: &Frame<'_>,
        picture: &wgpu::BindGroup,
    ) {
        let depth = gpu::whole(&canvas.targets.depth);
        let clear = Some(gpu::depth_target(&depth, true));
        let mut pass = gpu::pass(encoder, "depth of the head", &[], clear);
        if let Some(skin) = frame.skin {
            pass.set_pipeline(&self.pipelines.skin_depth);
            pass.set_bind_group(0, picture, &[]);
            skin.draw(&mut pass);
        }
    }

    /// The head, where hair does not hide it.
    fn draw_head(
        &self,
        device: &Device,
        encoder: &mut CommandEncoder,
        canvas: &mut Canvas,
        frame: &Frame<'_>,
        picture: &wgpu::BindGroup,
    ) {
        let (size, count) = (canvas.size, self.samples);
        let Known { maps: Some(maps), room: Some((_, _, room)), .. } = &canvas.known else {
            return;
        };
        let fine = canvas.fine.get_or_insert_with(|| Fine::new(device, size, count));
        let head = gpu::whole(&canvas.targets.head);
        let (light, depth) = (gpu::whole(&fine.light), gpu::whole(&fine.depth));
        let mut target = gpu::target(if count > 1 { &light } else { &head }, Some([0.0; 4]));
        if let Some(target) = &mut target
            && count > 1
        {
            target.resolve_target = Some(&head);
            target.ops.store = wgpu::StoreOp::Discard;
        }
        let hair = gpu::whole(&canvas.targets.hair);
        let resources = [wgpu::BindingResource::TextureView(&hair)];
        let covered = gpu::group(device, &self.layouts.finish, &resources);
        let mut pass = gpu::pass(encoder, "head", &[target], Some(gpu::depth_target(&depth, true)));
        if let Some(skin) = frame.skin {
            pass.set_pipeline(&self.pipelines.skin);
            pass.set_bind_group(0, picture, &[]);
            pass.set_bind_group(1, maps.group(), &[]);
            pass.set_bind_group(2, &covered, &[]);
            pass.set_vertex_buffer(1, room.on_skin.slice(..));
            skin.draw(&mut pass);
        }
    }

    /// The hair, nearest first.
    fn draw_hair(
        &self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        canvas: &mut Canvas,
        frame: &Frame<'_>,
        strands: usize,
        picture: &wgpu::BindGroup,
    ) {
        let known = &mut canvas.known;
        if let Some(hair) = frame.hair {
            Sorted::update(&mut known.sorted, device, queue, hair, strands, &frame.camera);
        }
        let view = gpu::whole(&canvas.targets.hair);
        let depth = gpu::whole(&canvas.targets.depth);
        let resources = [wgpu::BindingResource::TextureView(&view)];
        let covered = gpu::group(device, &self.layouts.finish, &resources);
        let none = [0];
        let (ends, known) = match (frame.hair, &known.sorted, &known.shaded) {
            (Some(_), Some(sorted), Some(shaded)) => (&sorted.ends[..], Some((sorted, shaded))),
            _ => (&none[..], None),
        };
        let mut begin = 0;
        for (i, &end) in ends.iter().enumerate() {
            let targets = [gpu::target(&view, (i == 0).then_some([0.0; 4]))];
            let depths = Some(gpu::depth_target(&depth, false));
            let mut pass = gpu::pass(encoder, "hair", &targets, depths);
            let Some((sorted, shaded)) = known else { continue };
            if end > begin {
                pass.set_pipeline(&self.pipelines.hair);
                pass.set_bind_group(0, picture, &[]);
                pass.set_bind_group(1, &shaded.group, &[]);
                let part = u64::from(begin) * 4..u64::from(end) * 4;
                pass.set_vertex_buffer(0, sorted.pieces.slice(part));
                pass.draw(0..4, 0..end - begin);
            }
            drop(pass);
            begin = end;
            let depths = Some(gpu::depth_target(&depth, false));
            let mut pass = gpu::pass(encoder, "finished pixels", &[], depths);
            pass.set_pipeline(&self.pipelines.finish);
            pass.set_bind_group(0, picture, &[]);
            pass.set_bind_group(1, &covered, &[]);
            let level = 4 * i as u64;
            pass.set_vertex_buffer(0, sorted.levels.slice(level..level + 4));
            pass.draw(0..3, 0..1);
        }
    }

    /// All of it together, developed, and lines over it.
    fn compose(
        &self,
        device: &Device,
        queue: &Queue,
        encoder: &mut CommandEncoder,
        canvas: &Canvas,
        frame: &Frame<'_>,
        picture: &wgpu::BindGroup,
    ) {
        let Some((_, around)) = &canvas.surroundings else { return };
        let targets = &canvas.targets;
        let (hair, head) = (gpu::whole(&targets.hair), gpu::whole(&targets.head));
        let resources = [
            wgpu::BindingResource::TextureView(&hair),
            wgpu::BindingResource::TextureView(&head),
            wgpu::BindingResource::TextureView(around),
            wgpu::BindingResource::Sampler(&self.sampler),
        ];
        let layers = gpu::group(device, &self.layouts.compose, &resources);
        let (view, depth) = (gpu::whole(&targets.picture), gpu::whole(&targets.depth));
        let mut pass = gpu::pass(encoder, "compose", &[gpu::target(&view, Some([0.0; 4]))], None);
        pass.set_pipeline(&self.pipelines.compose);
        pass.set_bind_group(0, picture, &[]);
        pass.set_bind_group(1, &layers, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);

        let (over, within): (Vec<&Line>, Vec<&Line>) =
            frame.lines.iter().filter(|line| sound(line)).partition(|line| line.on_top);
        let strokes: Vec<[f32; 12]> = within.iter().chain(&over).map(|line| stroke(line)).collect();
        if strokes.is_empty() {
            return;
        }
        let buffer =
            gpu::buffer(device, queue, "lines", cast_slice(&strokes), BufferUsages::VERTEX);
        let depths = Some(gpu::depth_target(&depth, false));
        let mut pass = gpu::pass(encoder, "lines", &[gpu::target(&view, None)], depths);
        pass.set_bind_group(0, picture, &[]);
        let pipelines = [&self.pipelines.lines, &self.pipelines.lines_on_top];
        let mut begin = 0;
        for (pipeline, count) in pipelines.into_iter().zip([within.len(), over.len()]) {
            let bytes = 48 * count as u64;
            if count > 0 {
                pass.set_pipeline(pipeline);
                pass.set_vertex_buffer(0, buffer.slice(begin..begin + bytes));
                pass.draw(0..4, 0..count as u32);
            }
            begin += bytes;
        }
    }
}

impl RoomKey {
    /// Whether the room's light is the same; lamps may not be.
    fn same_room(&self, other: &Self) -> bool {
        let things = |key: &Self| (key.hair, key.skin);
        let room = &self.lights.room;
        // Lamps come out of pictures of the surroundings only.
        things(self) == things(other) && *room == other.lights.room
    }
}

impl Shaded {
    fn new(renderer: &Renderer, device: &Device, hair: &Hair) -> Self {
        let height = (hair.vertices() as u32).div_ceil(ROW).max(1);
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let lights = gpu::texture(device, "lights", [ROW, height, 1], gpu::LIGHT, usage);
        let (places, view) = (hair.places(), gpu::whole(&lights));
        let resources = [&places, &view].map(wgpu::BindingResource::TextureView);
        let group = gpu::group(device, &renderer.layouts.ribbons, &resources);
        Self { shape: hair.shape(), lights, group }
    }
}

impl Sorted {
    /// Sorts anew, if hair, camera or share are others.
    fn update(
        known: &mut Option<Self>,
        device: &Device,
        queue: &Queue,
        hair: &Hair,
        strands: usize,
        camera: &Camera,
    ) {
        let (eye, forward) = (camera.eye().as_vec3(), camera.forward().as_vec3());
        let key = (hair.shape(), strands, eye, forward);
        if known.as_ref().is_some_and(|sorted| sorted.key == key) {
            return;
        }
        let nearest = hair.nearest(strands, eye, forward);
        let count = nearest.pieces.len();
        let ends: Vec<u32> = PARTS.iter().map(|part| (part * count as f32) as u32).collect();
        let ends: Vec<u32> = ends.iter().map(|&end| end.min(count as u32)).collect();
        let ends =
            if count > 0 { [&ends[..PARTS.len() - 1], &[count as u32]].concat() } else { vec![0] };
        let levels: Vec<f32> =
            ends.iter().map(|&end| nearest.depth((end as usize).saturating_sub(1))).collect();
        let bytes: &[u8] = cast_slice(&nearest.pieces);
        let (pieces, room) = match known.take() {
            Some(old) if old.room >= bytes.len() as u64 => {
                queue.write_buffer(&old.pieces, 0, bytes);
                (old.pieces, old.room)
            }
            _ => {
                let room = bytes.len() as u64;
                (gpu::buffer(device, queue, "pieces", bytes, BufferUsages::VERTEX), room)
            }
        };
        let levels =
            gpu::buffer(device, queue, "levels", cast_slice(&levels), BufferUsages::VERTEX);
        *known = Some(Self { key, pieces, room, levels, ends });
    }
}

/// The lamps of a picture.
fn lamps(lights: &FewLights, frame: &Frame<'_>) -> Vec<Lamp> {
    let (hair, head) = (frame.hair.map(Hair::bounds), frame.skin.map(crate::Skin::bounds));
    let shadowed = frame.shadows != Shadows::None;
    strongest(lights).into_iter().map(|lamp| Lamp::new(lamp, hair, head, shadowed)).collect()
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

/// Whether a line can be drawn.
fn sound(line: &Line) -> bool {
    line.from.is_finite() && line.to.is_finite() && line.width > 0.0 && line.width.is_finite()
}

/// A line as its shader has it.
fn stroke(line: &Line) -> [f32; 12] {
    let (p, q, c) = (line.from, line.to, line.colour);
    [p.x, p.y, p.z, line.width, q.x, q.y, q.z, 0.0, c[0], c[1], c[2], c[3]]
}
