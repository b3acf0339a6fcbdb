//! Curves, drawn as SVG.
//!
//! A small drawer of our own: libraries that plot lay out text by the fonts of the machine, or bring
//! hundreds of kilobytes of code; a report needs lines, points, two kinds of axis and a legend, and the
//! same bytes everywhere.

mod axis;
mod draw;
mod frame;
mod legend;

pub(crate) use frame::escaped;

pub use axis::Scale;

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line.
    Line,
    /// A dashed line.
    Dashed,
    /// Points.
    Points,
    /// Points and a line through them.
    Both,
}

/// Numbers of one kind.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name in the legend; without one it is not there.
    pub name: String,
    /// x and y.
    pub points: Vec<(f64, f64)>,
    /// How it is drawn.
    pub mark: Mark,
    /// Which of the colours, from 0; by default its own.
    pub colour: Option<usize>,
}

/// Curves in a frame with axes.
#[derive(Clone, Debug)]
pub struct Plot {
    /// What it shows.
    pub title: String,
    /// Name and unit of x and y.
    pub labels: [String; 2],
    /// Kinds of axes.
    pub scales: [Scale; 2],
    /// What is drawn, in this order.
    pub series: Vec<Series>,
    /// Whether a unit of x is as long as one of y: for shapes.
    pub equal: bool,
    /// Width and height of the drawing (pixels).
    pub size: [f64; 2],
}

impl Plot {
    /// Axes without curves.
    #[must_use]
    pub fn new(title: &str, x: &str, y: &str, scales: [Scale; 2]) -> Self {
        Self {
            title: title.to_owned(),
            labels: [x.to_owned(), y.to_owned()],
            scales,
            series: Vec::new(),
            equal: false,
            size: [640.0, 400.0],
        }
    }

    /// Adds a series.
    pub fn add(
        &mut self,
        name: &str,
        mark: Mark,
        points: impl IntoIterator<Item = (f64, f64)>,
    ) -> &mut Series {
        let points = points.into_iter().collect();
        self.series.push(Series { name: name.to_owned(), points, mark, colour: None });
        self.series.last_mut().expect("just added")
    }
}
