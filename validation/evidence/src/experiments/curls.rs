//! Measurements along a curl.

use glam::DVec3;

/// A turn of a curl about the vertical.
#[derive(Clone, Copy, Debug)]
pub(super) struct Turn {
    /// Arc length over length in its middle.
    pub(super) middle: f64,
    /// Descent over arc length: 1 is straight down, 0 a flat ring.
    pub(super) descent: f64,
}

/// The turns of a line (evenly spaced points, over the length) about the vertical, from the tip up. A turn is
/// one revolution of the horizontal direction of the tangent.
pub(super) fn turns(line: &[DVec3]) -> Vec<Turn> {
    let last = line.len() - 1;
    let h = 1.0 / last as f64;
    // Azimuths, unwrapped.
    let mut azimuths: Vec<f64> = Vec::with_capacity(last);
    for pair in line.windows(2) {
        let t = pair[1] - pair[0];
        let angle = t.y.atan2(t.x);
        let before = azimuths.last().copied().unwrap_or(angle);
        let step = (angle - before).rem_euclid(std::f64::consts::TAU);
        let step = if step > std::f64::consts::PI { step - std::f64::consts::TAU } else { step };
        azimuths.push(before + step);
    }
    let mut found = Vec::new();
    let mut from = last - 1;
    for i in (0..last).rev() {
        if (azimuths[i] - azimuths[from]).abs() >= std::f64::consts::TAU {
            let arc = (from - i) as f64 * h;
            found.push(Turn {
                middle: 0.5 * (from + i) as f64 * h,
                descent: (line[i].z - line[from].z) / arc,
            });
            from = i;
        }
    }
    found
}

/// Standard deviation over mean.
pub(super) fn variation(values: &[f64]) -> f64 {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let square = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / n;
    square.sqrt() / mean
}

/// Curvature times length between evenly spaced points.
pub(super) fn curvatures(line: &[DVec3]) -> Vec<f64> {
    let h = 1.0 / (line.len() - 1) as f64;
    let turn = |p: &[DVec3]| (p[1] - p[0]).angle_between(p[2] - p[1]) / h;
    line.windows(3).map(turn).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_helix_has_turns_alike() {
        let pitch: f64 = 0.5;
        let point = |i: i32| {
            let angle = f64::from(i) * 0.01;
            DVec3::new(angle.cos(), angle.sin(), -pitch * angle)
        };
        let length = (1.0 + pitch * pitch).sqrt() * 40.0;
        let line: Vec<DVec3> = (0..=4000).map(|i| point(i) / length).collect();
        let turns = turns(&line);
        assert_eq!(turns.len(), 6);
        for turn in &turns {
            assert!((turn.descent - pitch / (1.0 + pitch * pitch).sqrt()).abs() < 1e-3, "{turn:?}");
        }
        assert!(variation(&curvatures(&line)) < 1e-6);
    }
}
