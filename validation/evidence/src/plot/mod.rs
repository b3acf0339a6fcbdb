//! Curves, drawn as SVG.
//!
//! Plotting libraries lay out text by the fonts of the machine, or add
//! hundreds of kilobytes of code. A report needs only lines, points, two kinds of axis and a legend, and the
//! same bytes everywhere.

mod axis;
mod draw;
mod frame;
mod legend;

pub(crate) use frame::escaped;

pub use axis::Scale;

/// The style of a series.
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

/// A series of points.
#[derive(Clone, Debug)]
pub struct Series {
    /// Name in the legend; a series with an empty name has no entry.
    pub name: String,
    /// x and y.
    pub points: Vec<(f64, f64)>,
    /// Style.
    pub mark: Mark,
    /// Index of the colour; by default the index of the series.
    pub colour: Option<usize>,
}

/// A plot with axes.
#[derive(Clone, Debug)]
pub struct Plot {
    /// Title.
    pub title: String,
    /// Name and unit of x and y.
    pub labels: [String; 2],
    /// Kinds of axes.
    pub scales: [Scale; 2],
    /// Series in drawing order.
    pub series: Vec<Series>,
    /// Whether a unit of x is as long as one of y, as for shapes.
    pub equal: bool,
    /// Width and height of the drawing (pixels).
    pub size: [f64; 2],
}

impl Plot {
    /// Creates a plot without series.
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
