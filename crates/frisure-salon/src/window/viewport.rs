//! The head in the middle of the window, and the hand on it.

use std::path::PathBuf;
use std::sync::{Arc, Mutex};

use eframe::egui::{
    self, Align2, Color32, CursorIcon, FontId, Key, PointerButton, Pos2, Rect, Response, Sense,
    Shape, Stroke, Ui, vec2,
};
use eframe::egui_wgpu::Callback;
use frisure::files::Files;
use frisure::look::{Camera, EnvironmentMap, Lights, Look};
use frisure::scene::Scene;
use frisure_engine::GuideData;
use frisure_engine::{environment_map, picture};
use frisure_view::{Line, Mark, Plane, Shadows};
use glam::{DVec3, Vec3};

use super::theatre::{Picture, Side};
use super::{probe, theme};
use crate::state::{Badge, Command, Mode, Salon, Tool};

/// What the viewport remembers between frames.
#[derive(Default)]
pub(super) struct Viewport {
    /// Corners of a lasso that is being drawn (points of the window).
    lasso: Vec<Pos2>,
    /// Places under a brush or a comb that is being drawn (m).
    stroke: Vec<DVec3>,
    /// When something last moved (s).
    moved: f64,
    /// Part of the hairs drawn while something moves.
    share: f32,
    marks: Option<MarksOf>,
    marks_version: u64,
    /// The picture of surroundings that was read last: its path, and what it shows.
    surroundings: Option<(PathBuf, Option<EnvironmentMap>)>,
    pub(super) trouble: Arc<Mutex<Option<String>>>,
    /// The device is slow, as somebody said who asked for one sample.
    is_slow: bool,
}

struct MarksOf {
    hair: u64,
    chosen: Option<Vec<bool>>,
    falling: Option<crate::state::Plane>,
    marks: Option<Arc<Vec<Mark>>>,
}

/// Seconds after the last movement until all hairs are drawn.
const REST: f64 = 0.25;

/// Hairs that are drawn while something moves, at least: fewer are no hair.
const FEWEST: f32 = 4000.0;

/// Radians for a drag over the viewport's height.
const TURN: f64 = 3.5;

impl Viewport {
    /// A viewport on a device that is slow, or not.
    pub(super) fn new(is_slow: bool) -> Self {
        Self { is_slow, ..Self::default() }
    }

    /// Shows it, and says what the hand does.
    pub(super) fn show(&mut self, ui: &mut Ui, salon: &mut Salon, out: &mut Vec<Command>) {
        let rect = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(rect, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Image, true, "The head"));
        probe::record("The head", rect);
        let sides = sides(rect, salon.compared().is_some());
        let here = sides.iter().find(|(_, r)| {
            response.interact_pointer_pos().or(response.hover_pos()).is_some_and(|p| r.contains(p))
        });
        let mine = here.map_or(sides[0].1, |(_, r)| *r);
        self.hand(ui, &response, mine, salon, out);
        let now = ui.input(|i| i.time);
        let pace = self.pace(ui, now, salon);
        for (side, rect) in &sides {
            if let Some(picture) = self.picture(salon, *side, *rect, pace) {
                ui.painter().add(Callback::new_paint_callback(*rect, picture));
            }
        }
        overlay(ui, salon, &sides);
        self.drawn_shapes(ui, mine, salon);
    }

    /// Something moved.
    pub(super) fn moves(&mut self, now: f64) {
        self.moved = now;
    }

    /// Part of the hairs to draw now, and how well: all when still; while something moves so many that
    /// pictures follow the hand.
    fn pace(&mut self, ui: &Ui, now: f64, salon: &Salon) -> (f32, Shadows) {
        let held = salon.document().is_some_and(crate::state::Document::is_draft);
        if now - self.moved > REST && !held {
            // Maps of density are what costs most without a graphics card.
            return (1.0, if self.is_slow { Shadows::None } else { Shadows::Fine });
        }
        if self.share == 0.0 {
            self.share = 0.3;
        }
        let took = ui.input(|i| i.unstable_dt);
        let factor = if took > 0.05 {
            0.75
        } else if took < 0.022 {
            1.25
        } else {
            1.0
        };
        let drawn = salon.shown().map_or(1, |(hair, _)| hair.numbers.drawn.max(1));
        let least = (FEWEST / drawn as f32).min(1.0);
        self.share = (self.share * factor).clamp(least, 1.0);
        ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(REST + 0.01));
        // Steps, so that not every frame draws another choice of hairs.
        let steps = (self.share.log2() * 2.0).round() / 2.0;
        let shadows = match (self.is_slow, self.share < 1.0) {
            (true, _) => Shadows::None,
            (false, true) => Shadows::Coarse,
            (false, false) => Shadows::Fine,
        };
        (steps.exp2().min(1.0), shadows)
    }

    /// What pointer and wheel do.
    fn hand(
        &mut self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        salon: &Salon,
        out: &mut Vec<Command>,
    ) {
        let before = out.len();
        self.camera_by_hand(ui, response, rect, salon, out);
        let pointer = response.interact_pointer_pos();
        let drags = response.dragged_by(PointerButton::Primary) && !camera_keys(ui);
        match (salon.tool(), pointer) {
            (Tool::Lasso, Some(at))
                if drags && self.lasso.last().is_none_or(|last| last.distance(at) > 2.0) =>
            {
                self.lasso.push(at);
            }
            (Tool::Brush | Tool::Comb, Some(at)) if drags || response.clicked() => {
                let (from, way) = salon.orbit().ray(place(at, rect), aspect(rect));
                let hit = salon.head().and_then(|head| head.hit(from, way));
                self.stroke.extend(hit);
            }
            (Tool::Cut, Some(_)) if drags => {
                let delta = f64::from(response.drag_delta().y / rect.height());
                let across = f64::from(response.drag_delta().x / rect.height());
                let mut plane = *salon.plane();
                if ui.input(|i| i.modifiers.shift) {
                    // The plane leans as the hand draws it on the screen.
                    let right = salon.orbit().camera().right();
                    plane.tilt(-across * 3.0 * right.x, -across * 3.0 * right.y);
                } else {
                    let height =
                        2.0 * salon.orbit().distance * (0.5 * salon.orbit().field_of_view).tan();
                    plane.raise(-delta * height);
                }
                out.push(Command::Plane(plane));
            }
            (Tool::Pick, Some(at)) if response.clicked() => {
                let (from, way) = salon.orbit().ray(place(at, rect), aspect(rect));
                if let Some(hit) = salon.head().and_then(|head| head.hit(from, way)) {
                    out.push(Command::Alone(salon.wisp_at(hit)));
                }
            }
            _ => {}
        }
        if response.drag_stopped() || response.clicked() {
            self.lift(ui, rect, salon, out);
        }
        if out.len() > before {
            self.moved = ui.input(|i| i.time);
        }
        let cursor = match salon.tool() {
            Tool::Orbit => CursorIcon::Grab,
            Tool::Cut => CursorIcon::ResizeVertical,
            _ => CursorIcon::Crosshair,
        };
        if response.hovered() {
            ui.ctx().set_cursor_icon(cursor);
        }
    }

    /// The hand lets go of what it drew.
    fn lift(&mut self, ui: &Ui, rect: Rect, salon: &Salon, out: &mut Vec<Command>) {
        let mode = ui.input(|i| match (i.modifiers.shift, i.modifiers.alt) {
            (_, true) => Mode::Remove,
            (true, _) => Mode::Add,
            _ => Mode::Replace,
        });
        let lasso = std::mem::take(&mut self.lasso);
        let stroke = std::mem::take(&mut self.stroke);
        match salon.tool() {
            Tool::Lasso if lasso.len() >= 3 => {
                let polygon = lasso.into_iter().map(|p| place(p, rect)).collect();
                out.push(Command::DrawLasso { polygon, aspect: aspect(rect), mode });
            }
            Tool::Brush if !stroke.is_empty() => out.push(Command::Paint(stroke, mode)),
            Tool::Comb if stroke.len() >= 2 => {
                let way = stroke[stroke.len() - 1] - stroke[0];
                out.push(Command::Stroke(stroke, way));
            }
            _ => {}
        }
    }

    /// Turning, moving and coming nearer: with the tool for it, or with the other buttons at any time.
    fn camera_by_hand(
        &self,
        ui: &Ui,
        response: &Response,
        rect: Rect,
        salon: &Salon,
        out: &mut Vec<Command>,
    ) {
        let delta = response.drag_delta();
        let (dx, dy) = (f64::from(delta.x / rect.height()), f64::from(delta.y / rect.height()));
        let moved = delta != egui::Vec2::ZERO;
        let primary = response.dragged_by(PointerButton::Primary);
        let turns = response.dragged_by(PointerButton::Secondary)
            || (primary && (salon.tool() == Tool::Orbit || camera_keys(ui)));
        let shift = ui.input(|i| i.modifiers.shift) && salon.tool() == Tool::Orbit;
        if response.dragged_by(PointerButton::Middle) || (turns && shift) {
            if moved {
                out.push(Command::Pan(dx, -dy));
            }
        } else if turns && moved {
            out.push(Command::Turn(dx * TURN, dy * TURN));
        }
        if response.hovered() {
            let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
            let factor = f64::from(pinch) * (f64::from(scroll) * 0.004).exp();
            if (factor - 1.0).abs() > 1e-6 {
                out.push(Command::Zoom(factor));
            }
        }
        if response.double_clicked() && salon.tool() == Tool::Orbit {
            out.push(Command::Frame(aspect(rect)));
        }
    }

    /// The picture of one side.
    fn picture(
        &mut self,
        salon: &mut Salon,
        side: Side,
        rect: Rect,
        (share, shadows): (f32, Shadows),
    ) -> Option<Picture> {
        let understood = salon.scene()?.clone();
        let camera = salon.orbit().camera();
        let middle = salon.head().map_or(DVec3::ZERO, |head| {
            let (low, high) = head.framed();
            0.5 * (low + high)
        });
        let (look, lights) = self.lit(&understood.scene, &camera, middle);
        let (hair, version) = match side {
            Side::Now => salon.shown().map(|(hair, version)| (hair.clone(), version))?,
            Side::Before => {
                let compared = salon.compared()?;
                (compared.hair.clone()?, compared.version)
            }
        };
        let marks = (side == Side::Now).then(|| self.marks(salon)).flatten();
        let alone = salon.alone().and_then(|alone| alone.hair.clone());
        let (mut lines, mut planes) = (Vec::new(), Vec::new());
        // The others are out of the way.
        let isolated = alone.is_some() && side == Side::Now;
        if let Some(hair) = alone.as_ref().filter(|_| isolated) {
            lines = frames(hair);
        }
        if salon.tool() == Tool::Cut && side == Side::Now {
            planes.push(cutting_plane(salon.plane()));
        }
        let tone = understood.scene.output.tone;
        let head = salon.head().map(|head| (head.clone(), Arc::as_ptr(head) as usize as u64));
        Some(Picture {
            side,
            hair: (!isolated).then_some((hair, version)),
            head,
            camera,
            lights,
            look,
            marks,
            lines,
            planes,
            share,
            shadows,
            tone,
            stops: understood.scene.output.exposure as f32,
            rect,
            trouble: self.trouble.clone(),
        })
    }

    /// The scene's look and light, or the default if they cannot be.
    fn lit(&mut self, scene: &Scene, camera: &Camera, middle: DVec3) -> (Look, Lights) {
        self.look_around(scene);
        let around = self.surroundings.as_ref().and_then(|(_, map)| map.as_ref());
        picture::spec(scene, around).look_and_lights(camera, middle).unwrap_or_else(|error| {
            self.complain(error.to_string());
            (Look::default(), Lights::studio(camera))
        })
    }

    /// Reads the picture of surroundings that a scene names, once.
    fn look_around(&mut self, scene: &Scene) {
        let Some(named) = &scene.environment else {
            self.surroundings = None;
            return;
        };
        if self.surroundings.as_ref().is_some_and(|(path, _)| path == named) {
            return;
        }
        let map = environment_map(scene, &Files::default()).unwrap_or_else(|error| {
            self.complain(error.to_string());
            None
        });
        self.surroundings = Some((named.clone(), map));
    }

    fn complain(&self, problem: String) {
        if let Ok(mut trouble) = self.trouble.lock() {
            *trouble = Some(problem);
        }
    }

    /// What is special about strands: chosen, or about to fall.
    fn marks(&mut self, salon: &mut Salon) -> Option<(Arc<Vec<Mark>>, u64)> {
        let falling = salon.falling();
        let (hair, version) = salon.shown()?;
        let chosen = salon.chosen();
        let wisps = chosen.wisps.clone().filter(|_| !chosen.is_everything());
        let plane = falling.as_ref().map(|_| *salon.plane());
        let same = self
            .marks
            .as_ref()
            .is_some_and(|m| (m.hair, &m.chosen, m.falling) == (version, &wisps, plane));
        if !same {
            let is =
                |guide: u32| wisps.as_ref().is_some_and(|w| w.get(guide as usize) == Some(&true));
            let special = wisps.is_some() || falling.is_some();
            let marks = special.then(|| {
                let mark = |(i, guide): (usize, &u32)| Mark {
                    chosen: is(*guide),
                    falls_from: falling.as_ref().map_or(1.0, |f| f.from[i]),
                };
                Arc::new(hair.strands.guide.iter().enumerate().map(mark).collect::<Vec<_>>())
            });
            self.marks_version += 1;
            self.marks = Some(MarksOf { hair: version, chosen: wisps, falling: plane, marks });
        }
        let marks = self.marks.as_ref()?.marks.clone()?;
        Some((marks, self.marks_version))
    }

    /// What is being drawn with the hand.
    fn drawn_shapes(&self, ui: &Ui, rect: Rect, salon: &Salon) {
        let painter = ui.painter().with_clip_rect(rect);
        if self.lasso.len() > 1 {
            let fill = theme::ACCENT.gamma_multiply(0.15);
            painter.add(Shape::line(self.lasso.clone(), Stroke::new(2.0, theme::ACCENT)));
            painter.add(Shape::convex_polygon(vec![], fill, Stroke::NONE));
        }
        let Some(pointer) = ui.input(|i| i.pointer.hover_pos()).filter(|p| rect.contains(*p))
        else {
            return;
        };
        if matches!(salon.tool(), Tool::Brush | Tool::Comb) {
            let orbit = salon.orbit();
            let height = 2.0 * orbit.distance * (0.5 * orbit.field_of_view).tan();
            let radius = salon.brush() / height * f64::from(rect.height());
            painter.circle_stroke(pointer, radius as f32, Stroke::new(1.5, theme::ACCENT));
        }
        for place in &self.stroke {
            if let Some([x, y]) = salon.orbit().project(*place, aspect(rect)) {
                painter.circle_filled(at([x, y], rect), 2.5, theme::ACCENT);
            }
        }
    }
}

/// Keys that make the hand turn the head whatever tool it holds.
fn camera_keys(ui: &Ui) -> bool {
    ui.input(|i| i.key_down(Key::Space))
}

/// The viewport, or its two halves.
fn sides(rect: Rect, compared: bool) -> Vec<(Side, Rect)> {
    if !compared {
        return vec![(Side::Now, rect)];
    }
    let (left, right) = rect.split_left_right_at_fraction(0.5);
    vec![
        (Side::Before, left.with_max_x(left.right() - 1.0)),
        (Side::Now, right.with_min_x(right.left() + 1.0)),
    ]
}

/// A place of the window in the picture: −1 to 1 to the right and up.
fn place(at: Pos2, rect: Rect) -> [f64; 2] {
    let half = 0.5 * rect.size();
    let from = at - rect.center();
    [f64::from(from.x / half.x), -f64::from(from.y / half.y)]
}

/// The other way round.
fn at([x, y]: [f64; 2], rect: Rect) -> Pos2 {
    rect.center() + vec2(0.5 * rect.width() * x as f32, -0.5 * rect.height() * y as f32)
}

pub(super) fn aspect(rect: Rect) -> f64 {
    f64::from(rect.width() / rect.height().max(1.0))
}

/// One hair with its material frames (paper, Fig. 3).
fn frames(hair: &GuideData) -> Vec<Line> {
    const EVERY: usize = 6;
    let line = |from: Vec3, to: Vec3, width, colour| Line { from, to, width, colour, on_top: true };
    let points: Vec<Vec3> = hair.points.iter().map(|p| Vec3::from_array(*p)).collect();
    let thread = points.windows(2).map(|p| line(p[0], p[1], 3.0, [0.98, 0.82, 0.35, 1.0]));
    let mut lines: Vec<Line> = thread.collect();
    let arm = (0.05 * hair.length as f32).clamp(1e-3, 8e-3);
    let colours = [[0.93, 0.3, 0.28, 1.0], [0.35, 0.8, 0.38, 1.0], [0.35, 0.55, 0.98, 1.0]];
    for (point, frame) in points.iter().zip(&hair.frames).step_by(EVERY) {
        for (axis, colour) in frame.iter().zip(colours) {
            lines.push(line(*point, *point + arm * Vec3::from_array(*axis), 2.0, colour));
        }
    }
    lines
}

fn cutting_plane(plane: &crate::state::Plane) -> Plane {
    let [r, g, b, _] = theme::FALLING.to_normalized_gamma_f32();
    Plane::across(plane.point.as_vec3(), plane.normal().as_vec3(), 0.22, [r, g, b, 0.22])
}

/// Words over the picture.
fn overlay(ui: &Ui, salon: &Salon, sides: &[(Side, Rect)]) {
    let font = FontId::proportional(13.0);
    let tag = |at: Pos2, align: Align2, text: &str, fill: Color32| {
        let galley = ui.painter().layout_no_wrap(text.to_owned(), font.clone(), Color32::WHITE);
        let rect = align.anchor_size(at, galley.size() + vec2(16.0, 8.0));
        ui.painter().rect_filled(rect, 6.0, fill);
        ui.painter().galley(rect.min + vec2(8.0, 4.0), galley, Color32::WHITE);
        rect
    };
    let dark = Color32::from_black_alpha(150);
    for (side, rect) in sides {
        let corner = rect.left_top() + vec2(10.0, 10.0);
        match side {
            Side::Before => {
                let label = salon.compared().map_or("", |c| c.label.as_str());
                tag(corner, Align2::LEFT_TOP, &format!("Before: {label}"), dark);
                let waits = salon.compared().is_some_and(|c| c.hair.is_none());
                if waits {
                    tag(rect.center(), Align2::CENTER_CENTER, "Coming…", dark);
                }
            }
            Side::Now => {
                let (text, fill) = badge(salon);
                let rect = tag(corner, Align2::LEFT_TOP, &text, fill);
                probe::record("badge", rect);
            }
        }
    }
    if let Some(hair) = salon.alone().and_then(|alone| alone.hair.as_ref()) {
        told(ui, hair, sides[sides.len() - 1].1);
    }
}

/// The badge: how the hair stands.
pub(super) fn badge(salon: &Salon) -> (String, Color32) {
    match salon.badge() {
        Badge::Empty => ("No hair yet".into(), Color32::from_black_alpha(150)),
        Badge::Settling => {
            let text = match salon.progress() {
                Some((stage, done)) if !stage.is_empty() => {
                    format!("Settling… {stage}, {:.0} %", done * 100.0)
                }
                _ => "Settling…".into(),
            };
            (text, Color32::from_rgba_unmultiplied(0xb0, 0x78, 0x10, 230))
        }
        Badge::AtRest => ("At rest".into(), Color32::from_rgba_unmultiplied(0x2c, 0x7a, 0x3e, 230)),
        Badge::Unstable(count) => {
            let text = format!("Unstable: {count} guides");
            (text, Color32::from_rgba_unmultiplied(0xb0, 0x3a, 0x2e, 230))
        }
        Badge::Refused(_) => {
            let text = match salon.shown() {
                Some(_) => "Not possible: as before",
                None => "Not possible",
            };
            (text.into(), Color32::from_rgba_unmultiplied(0xb0, 0x3a, 0x2e, 230))
        }
    }
}

/// Numbers of a hair that is looked at alone.
fn told(ui: &Ui, hair: &GuideData, rect: Rect) {
    let [elastic, gravity, contact] = hair.energy.map(|e| e * 1e9);
    let [a, b] = hair.section.map(|a| a * 1e6);
    let text = format!(
        "Wisp {}\nlength {:.1} cm, section {a:.0} × {b:.0} µm\nelastic {elastic:.1} nJ, gravity {gravity:.1} nJ, contact {contact:.1} nJ\n{} elements, {} iterations\nrelative gradient {:.0e}: {}\nd1 red, d2 green, tangent blue",
        hair.wisp,
        hair.length * 100.0,
        hair.elements,
        hair.iterations,
        hair.gradient,
        hair.stability,
    );
    let galley =
        ui.painter().layout_no_wrap(text, FontId::proportional(13.0), Color32::from_gray(235));
    let box_ = Align2::RIGHT_TOP
        .anchor_size(rect.right_top() + vec2(-10.0, 10.0), galley.size() + vec2(20.0, 16.0));
    ui.painter().rect_filled(box_, 6.0, Color32::from_black_alpha(170));
    ui.painter().galley(box_.min + vec2(10.0, 8.0), galley, Color32::WHITE);
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    #[test]
    fn places_of_the_picture_come_back() {
        let rect = Rect::from_min_max(pos2(10.0, 20.0), pos2(310.0, 220.0));
        for p in [rect.min, rect.max, rect.center(), pos2(50.0, 60.0)] {
            assert!(at(place(p, rect), rect).distance(p) < 1e-3);
        }
        assert_eq!(place(rect.right_top(), rect), [1.0, 1.0]);
    }
}
