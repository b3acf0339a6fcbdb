//! Positions of numbers on an axis, and its ticks.

/// Kind of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal distances are equal differences.
    #[default]
    Linear,
    /// Equal distances are equal ratios.
    Log,
}

impl Scale {
    /// The coordinate of a number before scaling to the drawing; `None` if it cannot be drawn.
    pub(crate) fn place(self, x: f64) -> Option<f64> {
        match self {
            Self::Linear => Some(x).filter(|x| x.is_finite()),
            Self::Log => Some(x.log10()).filter(|x| x.is_finite()),
        }
    }
}

/// A range of coordinates, and its ticks.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) scale: Scale,
}

impl Axis {
    /// The range of the numbers, with a margin; extended to whole decades if a logarithmic axis has few.
    pub(crate) fn around(scale: Scale, numbers: impl Iterator<Item = f64>) -> Self {
        let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
        for x in numbers.filter_map(|x| scale.place(x)) {
            (from, to) = (from.min(x), to.max(x));
        }
        if from > to {
            (from, to) = (0.0, 1.0);
        }
        match scale {
            Scale::Log => {
                // A few decades are shown whole, for a tick at either end.
                if to - from < 1.5 {
                    (from, to) = (from.floor(), to.ceil().max(from.floor() + 1.0));
                }
                let margin = 0.02 * (to - from);
                (from, to) = (from - margin, to + margin);
            }
            Scale::Linear => {
                let margin = 0.04 * (to - from).max(1e-12 * from.abs().max(to.abs()).max(1e-300));
                // Zero needs no margin.
                from = if from >= 0.0 && from <= margin { 0.0 } else { from - margin };
                to += margin;
            }
        }
        Self { from, to, scale }
    }

    /// Coordinates and labels of the ticks.
    pub(crate) fn ticks(&self) -> Vec<(f64, String)> {
        match self.scale {
            Scale::Log => {
                let step = ((self.to - self.from) / 9.0).ceil().max(1.0);
                let first = self.from.ceil();
                let count = ((self.to - first) / step) as usize;
                (0..=count)
                    .map(|i| {
                        let at = first + i as f64 * step;
                        (at, power(at as i32))
                    })
                    .collect()
            }
            Scale::Linear => {
                let step = nice((self.to - self.from) / 6.0);
                let first = (self.from / step).ceil();
                let count = ((self.to / step).floor() - first).max(0.0) as usize;
                let digits = (-step.log10().floor()).max(0.0) as usize;
                (0..=count)
                    .map(|i| {
                        let at = (first + i as f64) * step;
                        (at, format!("{:.digits$}", if at == 0.0 { 0.0 } else { at }))
                    })
                    .collect()
            }
        }
    }
}

/// The next larger round number (1, 2 or 5 and zeros).
fn nice(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0].into_iter().find(|f| f * power >= step * 0.999);
    factor.unwrap_or(10.0) * power
}

/// The label of a power of ten.
fn power(exponent: i32) -> String {
    match exponent {
        0 => "1".into(),
        1 => "10".into(),
        2 => "100".into(),
        3 => "1000".into(),
        -1 => "0.1".into(),
        -2 => "0.01".into(),
        _ => {
            let digits = "⁰¹²³⁴⁵⁶⁷⁸⁹";
            let raised = exponent.to_string();
            let one = |c: char| match c.to_digit(10) {
                Some(d) => digits.chars().nth(d as usize).unwrap_or('?'),
                None => '⁻',
            };
            format!("10{}", raised.chars().map(one).collect::<String>())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::around(Scale::Linear, [0.3, 7.9].into_iter());
        let ticks = axis.ticks();
        assert!(ticks.iter().all(|t| t.0 >= axis.from && t.0 <= axis.to));
        assert!(ticks.iter().any(|t| t.1 == "4"), "{ticks:?}");
        let axis = Axis::around(Scale::Log, [1e-7, 3.0].into_iter());
        assert_eq!(axis.ticks()[0].1, "10⁻⁷");
    }

    #[test]
    fn what_cannot_be_drawn_is_left_out() {
        let axis = Axis::around(Scale::Log, [0.0, -1.0, f64::NAN, 10.0, 1000.0].into_iter());
        assert!(axis.from > 0.9 && axis.to < 3.1);
        assert!(!Axis::around(Scale::Linear, std::iter::empty()).ticks().is_empty());
    }
}
