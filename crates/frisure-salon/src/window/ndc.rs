//! Points of the window as normalized device coordinates of the picture.

use eframe::egui::{Pos2, Rect, vec2};

/// A point of the window in normalized device coordinates: −1 to 1, right and up.
pub(super) fn to_ndc(at: Pos2, rect: Rect) -> [f64; 2] {
    let half = 0.5 * rect.size();
    let from = at - rect.center();
    [f64::from(from.x / half.x), -f64::from(from.y / half.y)]
}

/// The inverse of [`to_ndc`].
pub(super) fn from_ndc([x, y]: [f64; 2], rect: Rect) -> Pos2 {
    rect.center() + vec2(0.5 * rect.width() * x as f32, -0.5 * rect.height() * y as f32)
}

/// Width over height.
pub(super) fn aspect(rect: Rect) -> f64 {
    f64::from(rect.width() / rect.height().max(1.0))
}

#[cfg(test)]
mod tests {
    use eframe::egui::pos2;

    use super::*;

    #[test]
    fn picture_coordinates_round_trip() {
        let rect = Rect::from_min_max(pos2(10.0, 20.0), pos2(310.0, 220.0));
        for p in [rect.min, rect.max, rect.center(), pos2(50.0, 60.0)] {
            assert!(from_ndc(to_ndc(p, rect), rect).distance(p) < 1e-3);
        }
        assert_eq!(to_ndc(rect.right_top(), rect), [1.0, 1.0]);
    }
}
