//! Texts and lines over the picture: the badge, names of what is compared, levels of the head, and how hair is lifted.

use std::borrow::Cow;

use eframe::egui::{Align2, Color32, FontId, Pos2, Rect, Shape, Stroke, Ui, pos2, vec2};
use frisure_engine::GuideData;
use glam::DVec3;

use super::ndc::{aspect, from_ndc, to_ndc};
use super::renderer::{Pane, Side};
use super::{automation, theme};
use crate::locale::{self, tr};
use crate::state::{Badge, Compared, Salon};

/// Draws a text on a filled box over the picture; returns the box.
fn text_box(ui: &Ui, at: Pos2, align: Align2, text: String, fill: Color32) -> Rect {
    let font = FontId::proportional(13.0);
    let galley = ui.painter().layout_no_wrap(text, font, Color32::WHITE);
    let rect = align.anchor_size(at, galley.size() + vec2(16.0, 8.0));
    ui.painter().rect_filled(rect, 6.0, fill);
    ui.painter().galley(rect.min + vec2(8.0, 4.0), galley, Color32::WHITE);
    rect
}

const DARK: Color32 = Color32::from_black_alpha(160);

/// Draws the texts over the picture.
pub(super) fn show(ui: &Ui, salon: &Salon, panes: &[Pane], moves: bool) {
    for Pane { side, shown } in panes {
        // Of a comparison both texts are seen, however narrow a part is.
        let (corner, align) = match side {
            Side::Now if panes.len() > 1 => {
                (shown.right_top() + vec2(-10.0, 10.0), Align2::RIGHT_TOP)
            }
            _ => (shown.left_top() + vec2(10.0, 10.0), Align2::LEFT_TOP),
        };
        match side {
            Side::Before => {
                let Some(comparison) = &salon.comparison else { continue };
                let text = match comparison.of {
                    Compared::Goal => comparison.label.clone(),
                    Compared::Edit(_) => tr!("before", label = &*comparison.label),
                };
                text_box(ui, corner, align, text, DARK);
                if comparison.hair.is_none() {
                    let (centre, text) = (Align2::CENTER_CENTER, tr!("computing"));
                    text_box(ui, shown.center(), centre, text, DARK);
                }
            }
            Side::Now => {
                let (text, fill) = badge(salon, moves);
                let rect = text_box(ui, corner, align, text, fill);
                automation::record("badge", rect);
            }
        }
    }
    if let Some(hair) = salon.isolated.as_ref().and_then(|isolated| isolated.hair.as_ref()) {
        let corner = panes[panes.len() - 1].shown.right_bottom() + vec2(-10.0, -10.0);
        text_box(ui, corner, Align2::RIGHT_BOTTOM, hair_report(hair), DARK);
    }
}

/// Draws how hair under the pointer would be lifted: straight to where it is cut.
pub(super) fn lifted(ui: &Ui, salon: &Salon, rect: Rect, pointer: Pos2) {
    let (from, direction) = salon.orbit.ray(to_ndc(pointer, rect), aspect(rect));
    let hit = salon.head.as_ref().and_then(|head| head.hit_and_normal(from, direction));
    let Some((root, normal)) = hit else { return };
    let end = salon.scissors.lifted_end(root, normal);
    let Some(end) = salon.orbit.project(end, aspect(rect)) else { return };
    let (painter, end) = (ui.painter().with_clip_rect(rect), from_ndc(end, rect));
    painter.line_segment([pointer, end], Stroke::new(2.0, theme::ACCENT));
    painter.circle_filled(end, 4.0, theme::CUT_COLOUR);
    let (degrees, cm) = (salon.scissors.elevation.to_degrees(), salon.scissors.lifted * 100.0);
    let text = format!("{degrees:.0}°, {cm:.1} cm");
    text_box(ui, end + vec2(8.0, 0.0), Align2::LEFT_CENTER, text, DARK);
}

/// Draws the levels of the head that cuts are named by, where it is seen from about its height.
pub(super) fn levels(ui: &Ui, salon: &Salon, rect: Rect) {
    /// Half the length of a line (m), beyond hair and shoulders.
    const HALF: f64 = 0.15;
    /// Greatest elevation (rad) from which heights lie one above the other. Chosen.
    const STEEPEST: f64 = 0.6;
    /// Distance of two names (points).
    const LINE: f32 = 13.0;
    let Some(head) = salon.head.as_ref().filter(|_| salon.orbit.elevation.abs() < STEEPEST) else {
        return;
    };
    let (painter, right) = (ui.painter().with_clip_rect(rect), salon.orbit.camera().right());
    let grey = Color32::from_black_alpha(90);
    // Names of levels near each other stand one below the other.
    let mut levels: Vec<_> = head.levels.iter().collect();
    levels.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut free = f32::NEG_INFINITY;
    for (name, z) in levels {
        let end =
            |side: f64| salon.orbit.project(DVec3::Z * *z + side * HALF * right, aspect(rect));
        let (Some(a), Some(b)) = (end(-1.0), end(1.0)) else { continue };
        let (a, b) = (from_ndc(a, rect), from_ndc(b, rect));
        painter.extend(Shape::dashed_line(&[a, b], Stroke::new(1.0, grey), 4.0, 4.0));
        let font = FontId::proportional(11.0);
        let y = b.y.max(free);
        free = y + LINE;
        painter.text(
            pos2(b.x + 4.0, y),
            Align2::LEFT_CENTER,
            level_name(name),
            font,
            Color32::from_black_alpha(170),
        );
    }
}

/// The name of a level of the head.
pub(super) fn level_name(name: &str) -> Cow<'_, str> {
    locale::named("level", name, name)
}

/// The text and the colour of the badge; `moves` if the picture is on its way to hair at rest.
pub(super) fn badge(salon: &Salon, moves: bool) -> (String, Color32) {
    let colour = |r, g, b| Color32::from_rgba_unmultiplied(r, g, b, 230);
    let red = colour(0xb0, 0x3a, 0x2e);
    // What is seen is at rest when it has arrived.
    let badge = if moves { Badge::Settling } else { salon.badge() };
    match badge {
        Badge::Empty => (tr!("badge-empty"), DARK),
        Badge::Settling => {
            let text = match salon.progress() {
                Some((stage, done)) if !stage.is_empty() => {
                    let stage = locale::named("stage", stage, stage);
                    format!("{} {stage}, {:.0} %", tr!("badge-settling"), done * 100.0)
                }
                _ => tr!("badge-settling"),
            };
            (text, colour(0xb0, 0x78, 0x10))
        }
        Badge::AtRest => (tr!("badge-at-rest"), colour(0x2c, 0x7a, 0x3e)),
        Badge::Unstable(count) => (tr!("badge-unstable", count = count), red),
        Badge::Refused(_) if salon.preview().is_some() => (tr!("badge-refused-earlier"), red),
        Badge::Refused(_) => (tr!("badge-refused"), red),
    }
}

/// The numbers of a hair that is shown alone.
fn hair_report(hair: &GuideData) -> String {
    let [elastic, gravity, contact] = hair.energy.map(|e| locale::number(e * 1e9, 1));
    let [a, b] = hair.section.map(|a| format!("{:.0}", a * 1e6));
    let stability = locale::named("stability", &hair.stability, &hair.stability);
    tr!(
        "hair-report",
        wisp = hair.wisp,
        length = locale::number(hair.length * 100.0, 1),
        a = a,
        b = b,
        elastic = elastic,
        gravity = gravity,
        contact = contact,
        elements = hair.elements,
        iterations = hair.iterations,
        gradient = format!("{:.0e}", hair.gradient),
        stability = &*stability,
    )
}
