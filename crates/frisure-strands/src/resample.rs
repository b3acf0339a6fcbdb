//! Strands with another number of points, evenly spaced along each.

use glam::Vec3;

use crate::strands::{Attribute, AttributeValues, Domain, Strands};

/// Strands of another number of points, and how far they are from what they were.
#[derive(Clone, Debug, PartialEq)]
pub struct Resampled {
    /// The strands.
    pub strands: Strands,
    /// Largest distance (m) of a point of the old strands from the new ones.
    pub error: f32,
    /// Index of the strand that has it.
    pub worst: usize,
}

impl Strands {
    /// Each strand as `points` points, at least 2, evenly spaced by arc length, with root and tip where
    /// they were.
    ///
    /// New points lie on the polyline of the old ones, so that nothing is invented: what bends between two
    /// old points is not in the file. Attributes of points go with them, interpolated where they are
    /// numbers and from the nearest point where they are indices; directions keep the length 1 if they had it. A
    /// strand of one point, or without length, becomes `points` times its root.
    ///
    /// # Panics
    /// If a strand has no point at all.
    #[must_use]
    pub fn resampled(&self, points: usize) -> Resampled {
        let points = points.max(2);
        let mut strands = Self::with_capacity(self.len(), self.len() * points);
        let (mut error, mut worst) = (0.0_f32, 0);
        let mut places = Vec::with_capacity(self.len() * points);
        let (mut line, mut radii) = (Vec::new(), Vec::new());
        for (index, strand) in self.iter().enumerate() {
            assert!(!strand.points.is_empty(), "a strand has a root");
            line.clear();
            radii.clear();
            let first = self.offsets()[index] as usize;
            let parts = parts(strand.points);
            let found = spaced(&parts, points);
            for place in &found {
                let at = |values: &[Vec3]| place.mix(|i| values[i], Vec3::lerp);
                line.push(at(strand.points));
                radii.push(place.mix(|i| strand.radii[i], lerp));
            }
            places.extend(found.iter().map(|p| Place {
                from: p.from + first,
                to: p.to + first,
                ..*p
            }));
            strands.push(&line, &radii);
            let apart = distance(strand.points, &parts, &line);
            if apart > error {
                (error, worst) = (apart, index);
            }
        }
        for attribute in self.attributes() {
            let moved = resampled(attribute, &places);
            strands.set_attribute(moved).expect("the attributes fitted the old strands");
        }
        Resampled { strands, error, worst }
    }
}

/// A place between two points: this part of the way from one to the other.
#[derive(Clone, Copy)]
struct Place {
    from: usize,
    to: usize,
    part: f32,
}

impl Place {
    fn mix<T>(&self, value: impl Fn(usize) -> T, lerp: impl Fn(T, T, f32) -> T) -> T {
        // The very value at an old point, to the last bit.
        if self.part <= 0.0 {
            value(self.from)
        } else if self.part >= 1.0 {
            value(self.to)
        } else {
            lerp(value(self.from), value(self.to), self.part)
        }
    }

    fn nearest(&self) -> usize {
        if self.part < 0.5 { self.from } else { self.to }
    }
}

fn lerp(a: f32, b: f32, t: f32) -> f32 {
    a + (b - a) * t
}

/// Arc length from the root to each point, in all of it; 0 everywhere where there is no length.
fn parts(points: &[Vec3]) -> Vec<f64> {
    let mut length = 0.0;
    let mut parts = vec![0.0];
    parts.extend(points.windows(2).map(|pair| {
        length += f64::from(pair[0].distance(pair[1]));
        length
    }));
    if length > 0.0 {
        parts.iter_mut().for_each(|part| *part /= length);
    }
    parts
}

/// Places evenly spaced along a strand.
fn spaced(parts: &[f64], count: usize) -> Vec<Place> {
    let last = parts.len() - 1;
    let mut piece = 0;
    (0..count)
        .map(|k| {
            // The tip itself, which rounding could miss.
            if k + 1 == count {
                return Place { from: last, to: last, part: 0.0 };
            }
            let s = k as f64 / (count - 1) as f64;
            while piece + 1 < last && parts[piece + 1] <= s {
                piece += 1;
            }
            // Points at the same place make a piece without length, of which the start stands for all.
            let to = (piece + 1).min(last);
            let span = parts[to] - parts[piece];
            let part = if span > 0.0 { (s - parts[piece]) / span } else { 0.0 };
            Place { from: piece, to, part: part.clamp(0.0, 1.0) as f32 }
        })
        .collect()
}

/// Largest distance of an old point from the piece of the new line that took its place.
fn distance(old: &[Vec3], parts: &[f64], new: &[Vec3]) -> f32 {
    let pieces = new.len() - 1;
    let apart = |(p, part): (&Vec3, &f64)| {
        // The new line is even in arc length: the piece follows from the part of the length.
        let piece = ((part * pieces as f64) as usize).min(pieces - 1);
        to_segment(*p, new[piece], new[piece + 1])
    };
    old.iter().zip(parts).map(apart).fold(0.0, f32::max)
}

/// Distance of a point from a piece of a line.
pub(crate) fn to_segment(p: Vec3, a: Vec3, b: Vec3) -> f32 {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}

fn resampled(attribute: &Attribute, places: &[Place]) -> Attribute {
    if attribute.domain == Domain::Strand {
        return attribute.clone();
    }
    let values = match &attribute.values {
        AttributeValues::U32(v) => {
            AttributeValues::U32(places.iter().map(|p| v[p.nearest()]).collect())
        }
        AttributeValues::U32x3(v) => {
            AttributeValues::U32x3(places.iter().map(|p| v[p.nearest()]).collect())
        }
        AttributeValues::F32(v) => {
            AttributeValues::F32(places.iter().map(|p| p.mix(|i| v[i], lerp)).collect())
        }
        AttributeValues::F32x2(v) => {
            let mix = |a: [f32; 2], b: [f32; 2], t| [lerp(a[0], b[0], t), lerp(a[1], b[1], t)];
            AttributeValues::F32x2(places.iter().map(|p| p.mix(|i| v[i], mix)).collect())
        }
        AttributeValues::F32x3(v) => {
            AttributeValues::F32x3(places.iter().map(|p| p.mix(|i| v[i], turned)).collect())
        }
    };
    Attribute { values, ..attribute.clone() }
}

/// Interpolates two triples; between two directions the result is a direction.
fn turned(a: [f32; 3], b: [f32; 3], t: f32) -> [f32; 3] {
    let (a, b) = (Vec3::from_array(a), Vec3::from_array(b));
    let mixed = a.lerp(b, t);
    if a.is_normalized() && b.is_normalized() {
        return mixed.try_normalize().unwrap_or(a).to_array();
    }
    mixed.to_array()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arc(points: usize) -> Strands {
        let mut strands = Strands::new();
        let angle = |k: usize| k as f32 / (points - 1) as f32;
        let line: Vec<Vec3> =
            (0..points).map(|k| Vec3::new(angle(k).cos(), angle(k).sin(), 0.0)).collect();
        let radii: Vec<f32> = (0..points).map(angle).collect();
        strands.push(&line, &radii);
        strands
    }

    #[test]
    fn points_are_evenly_spaced_on_the_old_line() {
        let Resampled { strands, error, .. } = arc(1001).resampled(11);
        let line = strands.strand(0).points;
        assert_eq!(line.len(), 11);
        // Chord of a tenth of a radian, and its sagitta.
        for pair in line.windows(2) {
            assert!((pair[0].distance(pair[1]) - 2.0 * 0.05_f32.sin()).abs() < 1e-5);
        }
        assert!((error - (1.0 - 0.05_f32.cos())).abs() < 1e-5, "{error}");
        assert!((strands.strand(0).radii[5] - 0.5).abs() < 1e-4);
    }

    #[test]
    fn ends_and_old_points_stay_to_the_last_bit() {
        let old = arc(5);
        let finer = old.resampled(9).strands;
        for k in [0, 4] {
            assert_eq!(finer.points()[2 * k], old.points()[k]);
        }
        assert!(old.resampled(9).error < 1e-6);
        assert_eq!(old.resampled(2).strands.points(), [old.points()[0], old.points()[4]]);
    }

    #[test]
    fn attributes_go_with_their_points() {
        let mut strands = arc(3);
        let values =
            AttributeValues::F32x3(vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let d1 = Attribute { name: "d1".into(), domain: Domain::Point, values };
        strands.set_attribute(d1).unwrap();
        let values = AttributeValues::U32(vec![7]);
        let guide = Attribute { name: "guide".into(), domain: Domain::Strand, values };
        strands.set_attribute(guide.clone()).unwrap();
        let finer = strands.resampled(5).strands;
        assert_eq!(finer.attribute("guide"), Some(&guide));
        let Some(AttributeValues::F32x3(d1)) = finer.attribute("d1").map(|a| &a.values) else {
            panic!("d1 is there")
        };
        assert!(d1.iter().all(|d| Vec3::from_array(*d).is_normalized()));
        assert!(Vec3::from_array(d1[2]).distance(Vec3::Y) < 1e-6);
        assert_eq!(d1[4], [0.0, 0.0, 1.0]);
    }

    #[test]
    fn strands_without_length_keep_their_root() {
        let mut strands = Strands::new();
        strands.push(&[Vec3::X], &[1.0]);
        strands.push(&[Vec3::Y; 3], &[1.0; 3]);
        let Resampled { strands, error, .. } = strands.resampled(4);
        assert_eq!(strands.strand(0).points, [Vec3::X; 4]);
        assert_eq!(strands.strand(1).points, [Vec3::Y; 4]);
        assert_eq!(error, 0.0);
    }
}
