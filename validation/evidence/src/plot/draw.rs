//! A plot as SVG.

use std::fmt::{Display, Formatter, Result};

use super::frame::{BOTTOM, COLOURS, Frame, LEFT, RIGHT, TOP, escaped};
use super::legend::Legend;
use super::{Mark, Plot, Series};

/// The plot as an SVG element.
impl Display for Plot {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [width, height] = self.size;
        let frame = Frame::of(self);
        let legend = Legend::of(self, &frame);
        let height = height + legend.below();
        write!(
            f,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" role=\"img\" font-family=\"sans-serif\" \
             font-size=\"12\"><title>{}</title><rect width=\"100%\" height=\"100%\" \
             fill=\"#fff\"/>",
            escaped(&self.title)
        )?;
        axes(f, self, &frame)?;
        for (i, series) in self.series.iter().enumerate() {
            draw(f, series, COLOURS[series.colour.unwrap_or(i) % COLOURS.len()], &frame)?;
        }
        legend.draw(f)?;
        write!(f, "</svg>")
    }
}

fn axes(f: &mut Formatter<'_>, plot: &Plot, frame: &Frame) -> Result {
    let [width, height] = frame.size;
    let (left, right, top, bottom) = (LEFT, width - RIGHT, TOP, height - BOTTOM);
    for (place, name) in frame.axes[0].ticks() {
        let x = frame.x(place);
        write!(f, "<path d=\"M{x:.1} {top}V{bottom}\" stroke=\"#e4e4e4\"/>")?;
        let y = bottom + 17.0;
        write!(f, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{name}</text>")?;
    }
    for (place, name) in frame.axes[1].ticks() {
        let y = frame.y(place);
        write!(f, "<path d=\"M{left} {y:.1}H{right}\" stroke=\"#e4e4e4\"/>")?;
        let (x, y) = (left - 7.0, y + 4.0);
        write!(f, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"end\">{name}</text>")?;
    }
    write!(f, "<path d=\"M{left} {top}V{bottom}H{right}V{top}Z\" fill=\"none\" stroke=\"#666\"/>")?;
    let middle = 0.5 * (left + right);
    write!(
        f,
        "<text x=\"{middle:.1}\" y=\"20\" text-anchor=\"middle\" font-weight=\"bold\">{}</text>",
        escaped(&plot.title)
    )?;
    let y = height - 14.0;
    write!(
        f,
        "<text x=\"{middle:.1}\" y=\"{y:.1}\" text-anchor=\"middle\">{}</text>",
        escaped(&plot.labels[0])
    )?;
    let middle = 0.5 * (top + bottom);
    write!(
        f,
        "<text transform=\"translate(17 {middle:.1}) rotate(-90)\" \
         text-anchor=\"middle\">{}</text>",
        escaped(&plot.labels[1])
    )
}

fn draw(f: &mut Formatter<'_>, series: &Series, colour: &str, frame: &Frame) -> Result {
    let lines = series.mark != Mark::Points;
    if lines {
        let path = path(&series.points, frame);
        let dash = if series.mark == Mark::Dashed { " stroke-dasharray=\"6 4\"" } else { "" };
        write!(
            f,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.6\" \
             stroke-linejoin=\"round\"{dash}/>"
        )?;
    }
    if matches!(series.mark, Mark::Points | Mark::Both) {
        for (x, y) in series.points.iter().filter_map(|p| frame.at(*p)) {
            write!(f, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>")?;
        }
    }
    Ok(())
}

/// An SVG path through points, with a gap where a number cannot be drawn.
fn path(points: &[(f64, f64)], frame: &Frame) -> String {
    let mut path = String::new();
    let mut last: Option<(f64, f64)> = None;
    for (i, point) in points.iter().enumerate() {
        let Some((x, y)) = frame.at(*point) else {
            last = None;
            continue;
        };
        // Points too close to the last one to be visible are left out.
        let near = last.is_some_and(|(a, b)| (x - a).hypot(y - b) < 0.7);
        if near && i + 1 < points.len() {
            continue;
        }
        path += &format!("{}{x:.1} {y:.1}", if last.is_some() { 'L' } else { 'M' });
        last = Some((x, y));
    }
    path
}

#[cfg(test)]
mod tests {
    use super::super::Scale;
    use super::*;

    #[test]
    fn a_plot_is_well_formed_and_the_same_each_time() {
        let mut plot = Plot::new("a < b", "Γ", "y", [Scale::Log, Scale::Linear]);
        plot.add("one", Mark::Both, (1..9).map(|i| (f64::from(i), 1.0 / f64::from(i))));
        plot.add("", Mark::Dashed, [(1.0, f64::NAN), (2.0, 0.5), (3.0, 0.2)]);
        let text = plot.to_string();
        assert_eq!(text, plot.to_string());
        assert!(text.contains("a &lt; b") && text.ends_with("</svg>"));
        assert!(!text.contains("NaN") && !text.contains("inf"), "{text}");
        assert_eq!(text.matches("<circle").count(), 8 + 1);
    }

    #[test]
    fn a_legend_covers_no_point() {
        let mut plot = Plot::new("", "x", "y", [Scale::Linear; 2]);
        plot.add("a few", Mark::Points, [(0.0, 0.0), (1.0, 1.0)]);
        assert!(plot.to_string().contains("viewBox=\"0 0 640 400\""));
        plot.add("all", Mark::Points, (0..900).map(|i| (f64::from(i % 30), f64::from(i / 30))));
        // The legend is below the axes then.
        assert!(plot.to_string().contains("viewBox=\"0 0 640 425\""), "{plot}");
    }

    #[test]
    fn a_plot_of_nothing_is_drawn() {
        let plot = Plot::new("", "x", "y", [Scale::Linear; 2]);
        assert!(!plot.to_string().contains("NaN"));
    }
}
