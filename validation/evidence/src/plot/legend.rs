//! The legend: in a free corner, or in lines below the axes.

use std::fmt::{Formatter, Result};

use super::frame::{BOTTOM, COLOURS, Frame, LEFT, RIGHT, TOP, escaped};
use super::{Mark, Plot, Series};

/// Height of a line (pixels).
const LINE: f64 = 17.0;

/// Width of a letter, and of the symbol before a name with its margins (pixels).
const LETTER: f64 = 6.6;
const SAMPLE: f64 = 36.0;

/// Margin (pixels).
const MARGIN: f64 = 8.0;

/// An entry of the legend, its colour, and the left end and middle of its line (pixels).
struct Entry<'a> {
    series: &'a Series,
    colour: &'static str,
    at: (f64, f64),
}

/// Names of series, and their positions.
pub(super) struct Legend<'a> {
    entries: Vec<Entry<'a>>,
    /// Left, top, width and height of the box, if the legend is inside the axes.
    frame: Option<[f64; 4]>,
    below: f64,
}

impl<'a> Legend<'a> {
    pub(super) fn of(plot: &'a Plot, frame: &Frame) -> Self {
        let named = plot.series.iter().enumerate().filter(|(_, s)| !s.name.is_empty());
        let colour = |i: usize, s: &Series| COLOURS[s.colour.unwrap_or(i) % COLOURS.len()];
        let entries: Vec<Entry<'a>> = named
            .map(|(i, series)| Entry { series, colour: colour(i, series), at: (0.0, 0.0) })
            .collect();
        match corner(&entries, plot, frame) {
            Some(corner) => Self::boxed(entries, corner),
            None => Self::flowing(entries, frame),
        }
    }

    /// Height that it adds to the drawing (pixels).
    pub(super) fn below(&self) -> f64 {
        self.below
    }

    /// Places the entries in a column, from a corner of the box.
    fn boxed(mut entries: Vec<Entry<'a>>, (x, y): (f64, f64)) -> Self {
        let [w, h] = size(&entries);
        for (row, entry) in entries.iter_mut().enumerate() {
            entry.at = (x + 7.0, y + 4.0 + LINE * (row as f64 + 0.5));
        }
        Self { frame: (!entries.is_empty()).then_some([x, y, w, h]), entries, below: 0.0 }
    }

    /// Places the entries in rows below the axes.
    fn flowing(mut entries: Vec<Entry<'a>>, frame: &Frame) -> Self {
        let [width, height] = frame.size;
        let (mut x, mut row) = (LEFT, 0.0);
        for entry in &mut entries {
            let w = width_of(entry.series);
            if x > LEFT && x + w > width - RIGHT {
                (x, row) = (LEFT, row + 1.0);
            }
            entry.at = (x, height + LINE * (row + 0.5));
            x += w;
        }
        Self { entries, frame: None, below: LINE * (row + 1.0) + MARGIN }
    }

    pub(super) fn draw(&self, f: &mut Formatter<'_>) -> Result {
        if let Some([x, y, w, h]) = self.frame {
            write!(
                f,
                "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{w:.1}\" height=\"{h:.1}\" fill=\"#fff\" \
                 fill-opacity=\"0.85\" stroke=\"#ccc\"/>"
            )?;
        }
        self.entries.iter().try_for_each(|entry| entry.draw(f))
    }
}

impl Entry<'_> {
    fn draw(&self, f: &mut Formatter<'_>) -> Result {
        let ((x, middle), colour) = (self.at, self.colour);
        let text = middle + 4.0;
        if self.series.mark != Mark::Points {
            let dash =
                if self.series.mark == Mark::Dashed { " stroke-dasharray=\"6 4\"" } else { "" };
            write!(
                f,
                "<path d=\"M{x:.1} {middle:.1}h18\" stroke=\"{colour}\" stroke-width=\"1.6\"{dash}/>"
            )?;
        }
        if matches!(self.series.mark, Mark::Points | Mark::Both) {
            let c = x + 9.0;
            write!(f, "<circle cx=\"{c:.1}\" cy=\"{middle:.1}\" r=\"3\" fill=\"{colour}\"/>")?;
        }
        let x = x + 24.0;
        write!(f, "<text x=\"{x:.1}\" y=\"{text:.1}\">{}</text>", escaped(&self.series.name))
    }
}

fn width_of(series: &Series) -> f64 {
    SAMPLE + LETTER * series.name.chars().count() as f64
}

/// Width and height of a box with the entries in a column.
fn size(entries: &[Entry<'_>]) -> [f64; 2] {
    let width = entries.iter().map(|e| width_of(e.series)).fold(0.0, f64::max);
    [width, LINE * entries.len() as f64 + MARGIN]
}

/// The upper left corner of a box that covers no series; `None` if there is no such place.
fn corner(entries: &[Entry<'_>], plot: &Plot, frame: &Frame) -> Option<(f64, f64)> {
    let [w, h] = size(entries);
    let [width, height] = frame.size;
    let (right, bottom) = (width - RIGHT - w - MARGIN, height - BOTTOM - h - MARGIN);
    let (left, top) = (LEFT + MARGIN, TOP + MARGIN);
    let inside = |x: f64, y: f64, p: &(f64, f64)| {
        p.0 > x - 3.0 && p.0 < x + w + 3.0 && p.1 > y - 3.0 && p.1 < y + h + 3.0
    };
    let points: Vec<(f64, f64)> = plot.series.iter().flat_map(|s| dense(s, frame)).collect();
    [(right, top), (left, top), (right, bottom), (left, bottom)]
        .into_iter()
        .find(|&(x, y)| !points.iter().any(|p| inside(x, y, p)))
}

/// Points of a series in pixels, lines as points along them.
fn dense(series: &Series, frame: &Frame) -> Vec<(f64, f64)> {
    let points: Vec<(f64, f64)> = series.points.iter().filter_map(|p| frame.at(*p)).collect();
    if series.mark == Mark::Points {
        return points;
    }
    let between = |pair: &[(f64, f64)]| {
        let ((x0, y0), (x1, y1)) = (pair[0], pair[1]);
        // Their spacing is less than the height of the box.
        let count = ((x1 - x0).hypot(y1 - y0) / 8.0).ceil().clamp(1.0, 200.0) as i32;
        (0..=count)
            .map(move |k| f64::from(k) / f64::from(count))
            .map(move |t| (x0 + t * (x1 - x0), y0 + t * (y1 - y0)))
    };
    points.windows(2).flat_map(between).collect()
}
