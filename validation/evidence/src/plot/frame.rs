//! The frame of a plot: its colours, its margins, and the pixels of its points.

use super::Plot;
use super::axis::Axis;

/// Colours that people with colour blindness can distinguish (Okabe & Ito 2008).
pub(super) const COLOURS: [&str; 7] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#555555"];

/// Margins for labels at the left, right, top and bottom (pixels).
pub(super) const LEFT: f64 = 74.0;
pub(super) const RIGHT: f64 = 16.0;
pub(super) const TOP: f64 = 34.0;
pub(super) const BOTTOM: f64 = 52.0;

/// Maps numbers to pixels of the drawing.
pub(super) struct Frame {
    pub(super) axes: [Axis; 2],
    pub(super) size: [f64; 2],
}

impl Frame {
    pub(super) fn of(plot: &Plot) -> Self {
        let numbers = |k: usize| {
            let one = move |p: &(f64, f64)| if k == 0 { p.0 } else { p.1 };
            plot.series.iter().flat_map(move |s| s.points.iter().map(one))
        };
        let mut axes = [0, 1].map(|k| Axis::around(plot.scales[k], numbers(k)));
        if plot.equal {
            let paper = [plot.size[0] - LEFT - RIGHT, plot.size[1] - TOP - BOTTOM];
            let each = [0, 1].map(|k| (axes[k].to - axes[k].from) / paper[k]);
            let larger = each[0].max(each[1]);
            for k in 0..2 {
                let more = 0.5 * (larger * paper[k] - (axes[k].to - axes[k].from));
                axes[k].from -= more;
                axes[k].to += more;
            }
        }
        Self { axes, size: plot.size }
    }

    /// Pixels of a place on an axis.
    pub(super) fn x(&self, place: f64) -> f64 {
        let axis = &self.axes[0];
        LEFT + (place - axis.from) / (axis.to - axis.from) * (self.size[0] - LEFT - RIGHT)
    }

    pub(super) fn y(&self, place: f64) -> f64 {
        let axis = &self.axes[1];
        let up = (place - axis.from) / (axis.to - axis.from);
        self.size[1] - BOTTOM - up * (self.size[1] - TOP - BOTTOM)
    }

    /// Pixels of a point; `None` if a number cannot be drawn.
    pub(super) fn at(&self, (x, y): (f64, f64)) -> Option<(f64, f64)> {
        Some((self.x(self.axes[0].scale.place(x)?), self.y(self.axes[1].scale.place(y)?)))
    }
}

/// Text with XML escapes.
pub(crate) fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
