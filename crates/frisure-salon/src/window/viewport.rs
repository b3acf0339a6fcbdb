//! The viewport: the head with its hair, and the pointer on it.

use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use eframe::egui::{
    self, Color32, CursorIcon, Key, PointerButton, Pos2, Rect, Response, Sense, Shape, Stroke, Ui,
    Vec2, pos2,
};
use eframe::egui_wgpu::Callback;
use frisure::files::Files;
use frisure::look::{Camera, EnvironmentMap, Lights, Look};
use frisure::scene::Scene;
use frisure_engine::GuideData;
use frisure_engine::{environment_map, picture};
use frisure_view::{Line, Mark, Plane, Shadows};
use glam::{DVec3, Vec3};

use super::blend::Blend;
use super::ndc::{aspect, from_ndc, to_ndc};
use super::renderer::{Pane, Picture, Side, Versioned, View};
use super::{automation, overlay, theme, widgets};
use crate::locale::tr;
use crate::state::{CombPlace, CombStroke, Command, CutPlane, Exercise, Salon, Snip, Tool, Way};

/// The state of the viewport between frames.
#[derive(Default)]
pub(super) struct Viewport {
    /// Corners of the lasso that is being drawn (points of the window).
    lasso: Vec<Pos2>,
    /// Hits of the brush stroke that is being drawn (m).
    stroke: Vec<DVec3>,
    /// Where the comb has been in the stroke that is being drawn.
    combed: Vec<CombPlace>,
    /// Where it was (points of the window) when the hair was last told to follow it.
    followed: Option<Pos2>,
    /// Time of the last motion (s).
    last_motion: f64,
    /// Fraction of the strands drawn during motion.
    share: f32,
    marks: Option<StrandMarks>,
    marks_version: u64,
    /// The environment map that was read last, and its path.
    environment: Option<(PathBuf, Option<EnvironmentMap>)>,
    /// The last error of the renderer.
    pub(super) error: Arc<Mutex<Option<String>>>,
    /// Whether the device is slow, as software is that draws in place of a graphics card.
    is_slow: bool,
    /// How far the picture without motion is done, on a slow device.
    refinement: Option<Refinement>,
    /// Where before and now meet in a comparison: share of the width, in −½ to ½ from the middle.
    divider: f32,
    /// The move from coarse to exact hair.
    blend: Blend,
    /// Time of the frame (s).
    now: f64,
}

/// A picture of a slow device on its way to all strands.
#[derive(Clone, Copy)]
struct Refinement {
    /// The hair that it is of.
    hair: u64,
    /// Fraction of the strands drawn.
    share: f32,
    /// Whether more would take too long, or all are drawn.
    done: bool,
}

struct StrandMarks {
    hair: u64,
    wisps: Option<Vec<bool>>,
    plane: Option<CutPlane>,
    /// The version of the goal, where hair that is not at it is marked.
    goal: Option<u64>,
    marks: Option<Arc<Vec<Mark>>>,
}

/// Time after the last motion until all strands are drawn (s).
const REST: f64 = 0.25;

/// Time of a frame (s) from which on no further strands are drawn: the window waits for a picture, and the next has twice as many.
/// Chosen: a third of a second is felt as a halt.
const PATIENCE: f32 = 0.15;

/// Way of the comb, in radii, after which hair follows it anew. Chosen.
const FOLLOWING: f64 = 1.0 / 3.0;

/// Minimum number of strands drawn during motion. Chosen by trial.
const MIN_STRANDS: f32 = 4000.0;

/// Speed at which the head turns by itself (rad/s): once around in twelve seconds. Chosen.
const SPIN: f64 = std::f64::consts::TAU / 12.0;

/// Angle of a drag over the viewport's height (rad).
const TURN: f64 = 3.5;

impl Viewport {
    pub(super) fn new(is_slow: bool) -> Self {
        Self { is_slow, ..Self::default() }
    }

    /// Shows the viewport and collects the commands of the pointer.
    pub(super) fn show(&mut self, ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
        self.now = ui.input(|i| i.time);
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response
            .widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, tr!("the-head")));
        automation::record("The head", rect);
        if salon.spins {
            let elapsed = f64::from(ui.input(|i| i.stable_dt)).min(0.1);
            out.push(Command::Turn(elapsed * SPIN, 0.0));
            self.note_motion(ui.input(|i| i.time));
            ui.ctx().request_repaint();
        }
        let compares = salon.comparison.is_some();
        let handle = compares.then(|| self.divide(ui, rect));
        let panes = panes(rect, handle);
        self.handle_pointer(ui, &response, rect, salon, out);
        let (share, shadows) = self.adapt_quality(ui, salon);
        for Pane { side, shown } in &panes {
            if let Some(mut picture) = self.picture(salon, *side, rect) {
                (picture.view.share, picture.view.shadows) = (share, shadows);
                let painter = ui.painter().with_clip_rect(*shown);
                painter.add(Callback::new_paint_callback(rect, picture));
            }
        }
        if self.blend.is_moving() {
            self.note_motion(self.now);
            ui.ctx().request_repaint();
        }
        if let Some(x) = handle {
            let bar = Stroke::new(2.0, Color32::WHITE);
            ui.painter().vline(x, rect.y_range(), bar);
            ui.painter().circle(pos2(x, rect.center().y), 9.0, theme::ACCENT, bar);
        }
        if matches!(salon.tool, Tool::Cut | Tool::Scissors) {
            overlay::levels(ui, salon, rect);
        }
        overlay::show(ui, salon, &panes, self.is_moving());
        self.draw_stroke(ui, rect, salon);
    }

    /// Where before and now meet (points of the window): dragged with the pointer, or moved by the arrow keys when it has the focus.
    fn divide(&mut self, ui: &Ui, rect: Rect) -> f32 {
        /// Width of the strip that takes the pointer (points).
        const GRIP: f32 = 22.0;
        /// Step of an arrow key, as a share of the width.
        const STEP: f32 = 0.05;
        let middle = rect.center().x + self.divider * rect.width();
        let strip =
            Rect::from_x_y_ranges(middle - GRIP / 2.0..=middle + GRIP / 2.0, rect.y_range());
        let response = ui.interact(strip, ui.scope_id().with("divider"), Sense::click_and_drag());
        let share = f64::from(self.divider) + 0.5;
        response.widget_info(|| egui::WidgetInfo::slider(true, share, tr!("before-and-after")));
        automation::record("Before and after", strip);
        let mut to = self.divider + response.drag_delta().x / rect.width().max(1.0);
        if response.has_focus() {
            let pressed = |key| ui.input_mut(|i| i.consume_key(egui::Modifiers::NONE, key));
            to += STEP
                * f32::from(i8::from(pressed(Key::ArrowRight)) - i8::from(pressed(Key::ArrowLeft)));
        }
        self.divider = to.clamp(-0.5, 0.5);
        if response.hovered() || response.dragged() {
            ui.ctx().set_cursor_icon(CursorIcon::ResizeHorizontal);
        }
        rect.center().x + self.divider * rect.width()
    }

    /// Whether the picture is on its way from coarse to exact hair.
    pub(super) fn is_moving(&self) -> bool {
        self.blend.is_moving()
    }

    /// Records a motion, so that fewer strands are drawn for a while.
    pub(super) fn note_motion(&mut self, now: f64) {
        self.last_motion = now;
    }

    /// The fraction of the strands to draw and the quality of shadows: everything without motion; during motion the amount
    /// with a frame time between 22 ms and 50 ms.
    fn adapt_quality(&mut self, ui: &Ui, salon: &Salon) -> (f32, Shadows) {
        let (now, frame_time) = ui.input(|i| (i.time, i.unstable_dt));
        if now - self.last_motion > REST && !salon.is_dragging() {
            // Density maps are the slowest part without a graphics card.
            return match self.is_slow {
                true => (self.refined_share(ui, salon, frame_time), Shadows::None),
                false => (1.0, Shadows::Fine),
            };
        }
        self.refinement = None;
        if self.share == 0.0 {
            self.share = 0.3;
        }
        let factor = match frame_time {
            t if t > 0.05 => 0.75,
            t if t < 0.022 => 1.25,
            _ => 1.0,
        };
        let drawn = salon.preview().map_or(1, |(hair, _)| hair.numbers.drawn.max(1));
        let least = (MIN_STRANDS / drawn as f32).min(1.0);
        self.share = (self.share * factor).clamp(least, 1.0);
        ui.ctx().request_repaint_after(Duration::from_secs_f64(REST + 0.01));
        // In steps of half an octave, so that the set of strands does not change at every frame.
        let steps = (self.share.log2() * 2.0).round() / 2.0;
        let shadows = match (self.is_slow, self.share < 1.0) {
            (true, _) => Shadows::None,
            (false, true) => Shadows::Coarse,
            (false, false) => Shadows::Fine,
        };
        (steps.exp2().min(1.0), shadows)
    }

    /// The fraction of the strands to draw on a slow device without motion: twice as many with each frame, until one takes long.
    fn refined_share(&mut self, ui: &Ui, salon: &Salon, frame_time: f32) -> f32 {
        let hair = salon.preview().map_or(0, |(_, version)| version);
        let begun = self.refinement.filter(|refinement| refinement.hair == hair);
        let share = if self.share > 0.0 { self.share } else { 0.3 };
        let mut next = begun.unwrap_or(Refinement { hair, share, done: share >= 1.0 });
        // The time of a frame says how long the one before took: the first has none to go by.
        if !next.done && begun.is_some() {
            next.done = frame_time > PATIENCE;
            if !next.done {
                next.share = (2.0 * next.share).min(1.0);
            }
        }
        if !next.done {
            ui.ctx().request_repaint();
            next.done = next.share >= 1.0;
        }
        self.refinement = Some(next);
        next.share
    }

    fn handle_pointer(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        salon: &Salon,
        out: &mut Vec<Command>,
    ) {
        let before = out.len();
        move_camera(ui, response, rect, salon, out);
        if let Some(at) = response.interact_pointer_pos() {
            self.use_tool(ui, response, at, rect, salon, out);
        }
        if response.drag_stopped() || response.clicked() {
            self.finish_stroke(ui, rect, salon, out);
        }
        if out.len() > before {
            self.note_motion(ui.input(|i| i.time));
        }
        if response.hovered() {
            ui.ctx().set_cursor_icon(match salon.tool {
                Tool::Orbit => CursorIcon::Grab,
                Tool::Cut => CursorIcon::ResizeVertical,
                _ => CursorIcon::Crosshair,
            });
        }
    }

    fn use_tool(
        &mut self,
        ui: &Ui,
        response: &Response,
        at: Pos2,
        rect: Rect,
        salon: &Salon,
        out: &mut Vec<Command>,
    ) {
        let drags = response.dragged_by(PointerButton::Primary) && !orbit_key(ui);
        let hit = || {
            let (from, direction) = salon.orbit.ray(to_ndc(at, rect), aspect(rect));
            salon.head.as_ref().and_then(|head| head.hit(from, direction))
        };
        match salon.tool {
            Tool::Lasso
                if drags && self.lasso.last().is_none_or(|last| last.distance(at) > 2.0) =>
            {
                self.lasso.push(at);
            }
            // Scissors cut straight from where the stroke began.
            Tool::Scissors | Tool::Part if drags => {
                self.lasso.truncate(1);
                self.lasso.push(at);
            }
            Tool::Comb if drags => {
                self.combed.push(CombPlace { at: to_ndc(at, rect), skin: hit() });
                let radius = salon.brush.radius / view_height(salon) * f64::from(rect.height());
                let before = *self.followed.get_or_insert(at);
                if f64::from(before.distance(at)) > FOLLOWING * radius {
                    self.followed = Some(at);
                    let path = self.combed.clone();
                    out.push(Command::DragComb(CombStroke { path, aspect: aspect(rect) }));
                }
            }
            tool if tool.is_brush() && (drags || response.clicked()) => self.stroke.extend(hit()),
            Tool::Cut if drags => {
                let delta = response.drag_delta() / rect.height();
                let mut plane = salon.plane;
                if ui.input(|i| i.modifiers.shift) {
                    // Tilts about the direction of view.
                    let by = -3.0 * f64::from(delta.x) * salon.orbit.camera().right();
                    plane.tilt(by.x, by.y);
                } else {
                    plane.raise(-f64::from(delta.y) * view_height(salon));
                }
                out.push(Command::Plane(plane));
            }
            Tool::Pick if response.clicked() => {
                if let Some(hit) = hit() {
                    out.push(Command::Isolate(salon.wisp_at(hit)));
                }
            }
            _ => {}
        }
    }

    /// Turns the drawn lasso or stroke into a command.
    fn finish_stroke(&mut self, ui: &Ui, rect: Rect, salon: &Salon, out: &mut Vec<Command>) {
        let mode = widgets::select_mode(ui);
        let lasso = std::mem::take(&mut self.lasso);
        let stroke = std::mem::take(&mut self.stroke);
        let path = std::mem::take(&mut self.combed);
        self.followed = None;
        match salon.tool {
            Tool::Lasso if lasso.len() >= 3 => {
                let polygon = lasso.into_iter().map(|p| to_ndc(p, rect)).collect();
                out.push(Command::DrawLasso { polygon, aspect: aspect(rect), mode });
            }
            Tool::Scissors if lasso.len() == 2 => {
                let ends = [lasso[0], lasso[1]].map(|p| to_ndc(p, rect));
                out.push(Command::Snip(Snip { ends, aspect: aspect(rect) }));
            }
            Tool::Part if lasso.len() == 2 => {
                let ends = [lasso[0], lasso[1]].map(|p| to_ndc(p, rect));
                out.push(Command::Part(Snip { ends, aspect: aspect(rect) }));
            }
            Tool::Brush if !stroke.is_empty() => out.push(Command::Paint(stroke, mode)),
            Tool::Lift if !stroke.is_empty() => out.push(Command::Lift(stroke)),
            Tool::Clippers if !stroke.is_empty() => out.push(Command::Clip(stroke)),
            Tool::Comb if path.len() >= 2 => {
                out.push(Command::Comb(CombStroke { path, aspect: aspect(rect) }));
            }
            _ => {}
        }
    }

    /// The picture of one side.
    fn picture(&mut self, salon: &mut Salon, side: Side, rect: Rect) -> Option<Picture> {
        let parsed = salon.scene.clone()?;
        let camera = salon.orbit.camera();
        let middle = salon.head.as_ref().map_or(DVec3::ZERO, |head| {
            let (low, high) = head.framed();
            0.5 * (low + high)
        });
        let (look, lights) = self.look_and_lights(&parsed.scene, &camera, middle);
        let (hair, version) = match side {
            Side::Now => self.blend.shown(salon.drawn()?, self.now),
            Side::Before => salon.drawn_comparison()?,
        };
        let is_now = side == Side::Now;
        let marks = if is_now { self.marks(salon) } else { None };
        let isolated = salon.isolated.as_ref().and_then(|i| i.hair.as_ref()).filter(|_| is_now);
        let planes = (is_now && salon.tool == Tool::Cut).then(|| cutting_plane(&salon.plane));
        let output = &parsed.scene.output;
        Some(Picture {
            side,
            hair: isolated.is_none().then_some((hair, version)),
            head: salon.head.as_ref().map(|head| (head.clone(), Arc::as_ptr(head) as usize as u64)),
            marks,
            view: View {
                camera,
                lights,
                look,
                lines: isolated.map(|hair| material_frames(hair)).unwrap_or_default(),
                planes: planes.into_iter().collect(),
                share: 1.0,
                shadows: Shadows::None,
                tone: output.tone,
                stops: output.exposure as f32,
            },
            rect,
            error: self.error.clone(),
        })
    }

    /// The scene's look and lights, or the default ones if the scene's are invalid.
    fn look_and_lights(&mut self, scene: &Scene, camera: &Camera, middle: DVec3) -> (Look, Lights) {
        self.read_environment(scene);
        let map = self.environment.as_ref().and_then(|(_, map)| map.as_ref());
        picture::spec(scene, map).look_and_lights(camera, middle).unwrap_or_else(|error| {
            self.report(error.to_string());
            (Look::default(), Lights::studio(camera))
        })
    }

    /// Reads the environment map of a scene, once.
    fn read_environment(&mut self, scene: &Scene) {
        let Some(file) = &scene.environment else {
            self.environment = None;
            return;
        };
        if self.environment.as_ref().is_some_and(|(path, _)| path == file) {
            return;
        }
        let map = environment_map(scene, &Files::default()).unwrap_or_else(|error| {
            self.report(error.to_string());
            None
        });
        self.environment = Some((file.clone(), map));
    }

    fn report(&self, problem: String) {
        if let Ok(mut error) = self.error.lock() {
            *error = Some(problem);
        }
    }

    /// The marks of strands that are selected or would be cut.
    fn marks(&mut self, salon: &mut Salon) -> Option<Versioned<Vec<Mark>>> {
        let preview = salon.cut_preview();
        let (hair, version) = salon.drawn()?;
        let selected = &salon.selected;
        let wisps = selected.wisps.clone().filter(|_| !selected.is_everything());
        let plane = preview.as_ref().map(|_| salon.plane);
        let way = salon.way_to_goal();
        let goal = way.as_ref().and(salon.exercise.as_ref()).map(Exercise::version);
        let known = self.marks.as_ref().map(|m| (m.hair, &m.wisps, m.plane, m.goal));
        if known != Some((version, &wisps, plane, goal)) {
            let is_selected =
                |guide: u32| wisps.as_ref().is_some_and(|w| w.get(guide as usize) == Some(&true));
            let mark = |(i, guide): (usize, &u32)| match (&way, &preview) {
                (Some(way), None) => match way(i) {
                    Some(Way::Long(kept)) => Mark { chosen: false, falls_from: kept },
                    other => Mark { chosen: other.is_some(), falls_from: 1.0 },
                },
                _ => Mark {
                    chosen: is_selected(*guide),
                    falls_from: preview.as_ref().map_or(1.0, |preview| preview.kept[i]),
                },
            };
            let marks = (wisps.is_some() || preview.is_some() || way.is_some())
                .then(|| Arc::new(hair.strands.guide.iter().enumerate().map(mark).collect()));
            self.marks_version += 1;
            self.marks = Some(StrandMarks { hair: version, wisps, plane, goal, marks });
        }
        let marks = self.marks.as_ref()?.marks.clone()?;
        Some((marks, self.marks_version))
    }

    /// Draws the lasso or stroke, and the circle of the brush.
    fn draw_stroke(&self, ui: &Ui, rect: Rect, salon: &Salon) {
        let painter = ui.painter().with_clip_rect(rect);
        if self.lasso.len() > 1 {
            let colour =
                if salon.tool == Tool::Scissors { theme::CUT_COLOUR } else { theme::ACCENT };
            painter.add(Shape::line(self.lasso.clone(), Stroke::new(2.0, colour)));
        }
        let pointer = ui.input(|i| i.pointer.hover_pos()).filter(|p| rect.contains(*p));
        let Some(pointer) = pointer else { return };
        if salon.tool.is_brush() {
            let radius = salon.brush.radius / view_height(salon) * f64::from(rect.height());
            painter.circle_stroke(pointer, radius as f32, Stroke::new(1.5, theme::ACCENT));
        }
        if salon.tool == Tool::Lift {
            overlay::lifted(ui, salon, rect, pointer);
        }
        let on_skin = self.stroke.iter().filter_map(|p| salon.orbit.project(*p, aspect(rect)));
        for at in on_skin.chain(self.combed.iter().map(|place| place.at)) {
            painter.circle_filled(from_ndc(at, rect), 2.5, theme::ACCENT);
        }
    }
}

/// Orbits, pans and zooms: with the orbit tool, and with the other buttons at any time.
fn move_camera(ui: &Ui, response: &Response, rect: Rect, salon: &Salon, out: &mut Vec<Command>) {
    let delta = response.drag_delta() / rect.height();
    let (dx, dy) = (f64::from(delta.x), f64::from(delta.y));
    let is_orbit = salon.tool == Tool::Orbit;
    let primary = response.dragged_by(PointerButton::Primary);
    let turns =
        response.dragged_by(PointerButton::Secondary) || (primary && (is_orbit || orbit_key(ui)));
    let shift = ui.input(|i| i.modifiers.shift) && is_orbit;
    let pans = response.dragged_by(PointerButton::Middle) || (turns && shift);
    if delta != Vec2::ZERO && pans {
        out.push(Command::Pan(dx, -dy));
    } else if delta != Vec2::ZERO && turns {
        out.push(Command::Turn(dx * TURN, dy * TURN));
    }
    if response.hovered() {
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = f64::from(pinch) * (f64::from(scroll) * 0.004).exp();
        if (factor - 1.0).abs() > 1e-6 {
            out.push(Command::Zoom(factor));
        }
    }
    if response.double_clicked() && is_orbit {
        out.push(Command::Frame(aspect(rect)));
    }
}

/// Whether the key is held that orbits with every tool.
fn orbit_key(ui: &Ui) -> bool {
    ui.input(|i| i.key_down(Key::Space))
}

/// The viewport, or its two parts that meet at `divider` (points).
fn panes(rect: Rect, divider: Option<f32>) -> Vec<Pane> {
    match divider {
        None => vec![Pane { side: Side::Now, shown: rect }],
        Some(x) => vec![
            Pane { side: Side::Before, shown: rect.with_max_x(x) },
            Pane { side: Side::Now, shown: rect.with_min_x(x) },
        ],
    }
}

/// Height of the picture at the camera's target (m).
fn view_height(salon: &Salon) -> f64 {
    2.0 * salon.orbit.distance * (0.5 * salon.orbit.field_of_view).tan()
}

/// The lines of one hair with its material frames. \[paper\] Fig. 3
fn material_frames(hair: &GuideData) -> Vec<Line> {
    const STRIDE: usize = 6;
    let line = |from: Vec3, to: Vec3, width, colour| Line { from, to, width, colour, on_top: true };
    let points: Vec<Vec3> = hair.points.iter().map(|p| Vec3::from_array(*p)).collect();
    let centreline = points.windows(2).map(|p| line(p[0], p[1], 3.0, [0.98, 0.82, 0.35, 1.0]));
    let mut lines: Vec<Line> = centreline.collect();
    let arm = (0.05 * hair.length as f32).clamp(1e-3, 8e-3);
    let colours = [[0.93, 0.3, 0.28, 1.0], [0.35, 0.8, 0.38, 1.0], [0.35, 0.55, 0.98, 1.0]];
    for (point, frame) in points.iter().zip(&hair.frames).step_by(STRIDE) {
        for (axis, colour) in frame.iter().zip(colours) {
            lines.push(line(*point, *point + arm * Vec3::from_array(*axis), 2.0, colour));
        }
    }
    lines
}

fn cutting_plane(plane: &CutPlane) -> Plane {
    let [r, g, b, _] = theme::CUT_COLOUR.to_normalized_gamma_f32();
    Plane::across(plane.point.as_vec3(), plane.normal().as_vec3(), 0.22, [r, g, b, 0.22])
}
