//! Statistics of a handful of numbers.

/// What is told of measured numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// Mean.
    pub mean: f64,
    /// Median.
    pub median: f64,
    /// Standard deviation between single hairs, where hairs were told one by one or with one.
    pub deviation: Option<f64>,
    /// How many hairs or sections.
    pub count: usize,
    /// In how many groups they were told; 0 if one by one. The median is then that of groups, each as often as it
    /// counts.
    pub groups: usize,
}

/// A row that stands for many hairs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    pub(super) centre: f64,
    /// Standard deviation inside, if it is told.
    pub(super) deviation: Option<f64>,
    pub(super) count: usize,
}

/// Fewest numbers of which a spread is told: of fewer it is off by half and more.
const LEAST_FOR_SPREAD: usize = 5;

impl Sample {
    /// Of single numbers; none of none.
    pub(super) fn of(numbers: &[f64]) -> Option<Self> {
        let count = numbers.len();
        let mean = (count > 0).then(|| numbers.iter().sum::<f64>() / count as f64)?;
        let squares: f64 = numbers.iter().map(|x| (x - mean).powi(2)).sum();
        let enough = count >= LEAST_FOR_SPREAD;
        let deviation = enough.then(|| (squares / (count - 1) as f64).sqrt());
        Some(Self { mean, median: median(numbers), deviation, count, groups: 0 })
    }

    /// Of groups: the spread is that inside them, not that between them, who may be people.
    pub(super) fn of_groups(groups: &[Group]) -> Option<Self> {
        let count: usize = groups.iter().map(|g| g.count).sum();
        let weighted = |x: f64, group: &Group| x * group.count as f64 / count as f64;
        let mean = groups.iter().map(|g| weighted(g.centre, g)).sum();
        let squares = groups.iter().map(|g| g.deviation.map(|d| weighted(d * d, g)));
        let mut sorted: Vec<&Group> = groups.iter().collect();
        sorted.sort_by(|a, b| a.centre.total_cmp(&b.centre));
        let mut counted = 0;
        let middle = sorted.iter().find(|g| {
            counted += g.count;
            2 * counted >= count
        });
        let median = middle.map_or(0.0, |g| g.centre);
        let deviation = squares.sum::<Option<f64>>().map(f64::sqrt);
        (count > 0).then_some(Self { mean, median, deviation, count, groups: groups.len() })
    }

    /// Standard deviation as a fraction of the mean.
    #[must_use]
    pub fn variation(&self) -> Option<f64> {
        self.deviation.map(|d| d / self.mean).filter(|v| v.is_finite())
    }
}

/// The middle number; 0 of none.
pub(super) fn median(numbers: &[f64]) -> f64 {
    let mut sorted = numbers.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    match n {
        0 => 0.0,
        _ if n % 2 == 1 => sorted[n / 2],
        _ => 0.5 * (sorted[n / 2 - 1] + sorted[n / 2]),
    }
}

/// The standard deviation of which the middle half of the numbers speaks, as a fraction of their median:
/// windows at the end of a hair, or across another hair, tell nonsense and would rule an ordinary one.
pub(super) fn robust_variation(numbers: &[f64]) -> Option<f64> {
    let middle = median(numbers);
    let distances: Vec<f64> = numbers.iter().map(|x| (x - middle).abs()).collect();
    // Of a normal distribution half lies within 0.6745 standard deviations.
    let variation = median(&distances) / 0.6745 / middle;
    (numbers.len() >= 2 * LEAST_FOR_SPREAD && variation.is_finite()).then_some(variation)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_numbers_and_of_groups() {
        let sample = Sample::of(&[1.0, 2.0, 3.0, 4.0, 10.0]).unwrap();
        assert_eq!((sample.mean, sample.median, sample.count), (4.0, 3.0, 5));
        assert!((sample.deviation.unwrap() - 12.5_f64.sqrt()).abs() < 1e-12);
        assert_eq!(Sample::of(&[1.0, 2.0]).unwrap().deviation, None);
        assert_eq!(Sample::of(&[]), None);

        let group = |centre, deviation, count| Group { centre, deviation, count };
        let groups = [group(1.0, Some(0.1), 1), group(2.0, Some(0.2), 3)];
        let sample = Sample::of_groups(&groups).unwrap();
        assert_eq!((sample.mean, sample.count), (1.75, 4));
        assert!((sample.deviation.unwrap() - (0.13_f64 / 4.0).sqrt()).abs() < 1e-12);
        assert_eq!(Sample::of_groups(&[group(1.0, None, 2)]).unwrap().deviation, None);
        assert_eq!(Sample::of_groups(&[]), None);
    }

    #[test]
    fn a_few_wild_windows_do_not_rule() {
        let mut windows: Vec<f64> = (0..21).map(|i| 1.0 + 0.01 * f64::from(i - 10)).collect();
        let calm = robust_variation(&windows).unwrap();
        windows.extend([40.0, 50.0]);
        assert!((robust_variation(&windows).unwrap() - calm).abs() < 0.3 * calm);
        assert_eq!(robust_variation(&[1.0; 3]), None);
        assert_eq!(robust_variation(&[0.0; 30]), None);
    }
}
