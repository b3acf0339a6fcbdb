//! Hair that moves: the same strands at several times.

use frisure_strands::{AttributeValues, Strands};
use thiserror::Error;

use super::attributes::ID;
use super::data::Groom;

/// Time codes in a second, of formats that count time so: the frames of a film.
pub(super) const FRAMES_PER_SECOND: f64 = 24.0;

/// A groom with its points and widths at several times, evenly apart. What else is said of it does not change.
///
/// ```
/// use frisure_formats::groom::{Groom, Motion};
/// use frisure_strands::Strands;
/// use glam::Vec3;
///
/// let hair = |length: f32| {
///     let mut hairs = Strands::new();
///     hairs.push(&[Vec3::ZERO, Vec3::new(0.0, 0.0, -length)], &[35e-6; 2]);
///     Groom::of(hairs)
/// };
/// let mut motion = Motion::new(hair(0.1), 1.0);
/// motion.push(&hair(0.05))?;
/// assert_eq!(motion.times().collect::<Vec<_>>(), [0.0, 1.0]);
/// # Ok::<(), frisure_formats::groom::MotionError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    groom: Groom,
    interval: f64,
    /// After the first.
    later: Vec<Pose>,
}

/// Where strands are at one time (m), without attributes.
#[derive(Clone, Debug, PartialEq)]
struct Pose {
    hairs: Strands,
    guides: Strands,
}

/// Why a groom is not a later one of the same strands.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum MotionError {
    /// There are more strands, or fewer.
    #[error("sample {sample} has {found} {kind}s, and the first has {expected}")]
    Strands {
        /// Number of the sample, from 1.
        sample: usize,
        /// Hair or guide.
        kind: &'static str,
        /// How many there are.
        found: usize,
        /// How many there are at first.
        expected: usize,
    },
    /// A strand has more points, or fewer.
    #[error("sample {sample} has {found} points in {kind} {strand}, and the first has {expected}")]
    Points {
        /// Number of the sample, from 1.
        sample: usize,
        /// Hair or guide.
        kind: &'static str,
        /// Index of the strand, from 0.
        strand: usize,
        /// How many points it has.
        found: usize,
        /// How many it has at first.
        expected: usize,
    },
    /// The strands are others, by their numbers.
    #[error("sample {sample} has other {kind}s than the first: {kind} {strand} has another number")]
    Others {
        /// Number of the sample, from 1.
        sample: usize,
        /// Hair or guide.
        kind: &'static str,
        /// Index of the first such strand, from 0.
        strand: usize,
    },
}

impl Motion {
    /// A groom at its first time, 0. Further ones come `interval` (s) apart.
    ///
    /// # Panics
    /// If the interval is not positive and finite.
    #[must_use]
    pub fn new(groom: Groom, interval: f64) -> Self {
        assert!(interval > 0.0 && interval.is_finite(), "an interval of {interval} s");
        Self { groom, interval, later: Vec::new() }
    }

    /// Adds the next sample: points and widths of `groom`, which has the same strands.
    ///
    /// # Errors
    /// [`MotionError`].
    pub fn push(&mut self, groom: &Groom) -> Result<(), MotionError> {
        let sample = self.later.len() + 2;
        same_strands("hair", sample, &self.groom.hairs, &groom.hairs)?;
        same_strands("guide", sample, &self.groom.guides, &groom.guides)?;
        let [hairs, guides] =
            [&groom.hairs, &groom.guides].map(|s| s.clone().with_attributes(|_| false));
        self.later.push(Pose { hairs, guides });
        Ok(())
    }

    /// The groom at its first time.
    #[must_use]
    pub fn first(&self) -> &Groom {
        &self.groom
    }

    /// The times of the samples (s).
    pub fn times(&self) -> impl ExactSizeIterator<Item = f64> {
        let interval = self.interval;
        (0..self.later.len() + 1).map(move |sample| sample as f64 * interval)
    }

    /// From one sample to the next (s).
    #[must_use]
    pub fn interval(&self) -> f64 {
        self.interval
    }

    /// The hairs at each time (m); only the first have attributes.
    pub fn hairs(&self) -> impl Iterator<Item = &Strands> {
        [&self.groom.hairs].into_iter().chain(self.later.iter().map(|pose| &pose.hairs))
    }

    /// The guides at each time (m); only the first have attributes.
    pub fn guides(&self) -> impl Iterator<Item = &Strands> {
        [&self.groom.guides].into_iter().chain(self.later.iter().map(|pose| &pose.guides))
    }
}

/// What is written of a groom that moves or does not: strands at all its times, at least one.
pub(super) struct Samples<'a> {
    /// What is said at all times.
    pub(super) groom: &'a Groom,
    pub(super) hairs: Vec<&'a Strands>,
    pub(super) guides: Vec<&'a Strands>,
    /// From one sample to the next (s).
    pub(super) interval: f64,
}

impl<'a> Samples<'a> {
    pub(super) fn still(groom: &'a Groom) -> Self {
        let (hairs, guides) = (vec![&groom.hairs], vec![&groom.guides]);
        Self { groom, hairs, guides, interval: 1.0 }
    }

    pub(super) fn of(motion: &'a Motion) -> Self {
        let (hairs, guides) = (motion.hairs().collect(), motion.guides().collect());
        Self { groom: &motion.groom, hairs, guides, interval: motion.interval }
    }
}

/// Whether strands have the same widths at all times.
pub(super) fn same_widths(samples: &[&Strands]) -> bool {
    samples.windows(2).all(|pair| pair[0].radii() == pair[1].radii())
}

/// Checks that strands are those of the first sample.
fn same_strands(
    kind: &'static str,
    sample: usize,
    first: &Strands,
    later: &Strands,
) -> Result<(), MotionError> {
    let (expected, found) = (first.len(), later.len());
    if expected != found {
        return Err(MotionError::Strands { sample, kind, found, expected });
    }
    let counts = first.iter().zip(later.iter()).map(|(a, b)| (a.points.len(), b.points.len()));
    if let Some((strand, (expected, found))) = counts.enumerate().find(|(_, (a, b))| a != b) {
        return Err(MotionError::Points { sample, kind, strand, found, expected });
    }
    let ids = |strands: &Strands| match strands.attribute(ID).map(|a| a.values.clone()) {
        Some(AttributeValues::U32(ids)) => ids,
        _ => Vec::new(),
    };
    let other = ids(first).into_iter().zip(ids(later)).position(|(a, b)| a != b);
    other.map_or(Ok(()), |strand| Err(MotionError::Others { sample, kind, strand }))
}

#[cfg(test)]
mod tests {
    use frisure_strands::{Attribute, Domain};
    use glam::Vec3;

    use super::*;

    fn hairs(counts: &[usize], ids: &[u32]) -> Groom {
        let mut hairs = Strands::new();
        for &count in counts {
            let points: Vec<Vec3> = (0..count).map(|i| Vec3::Z * i as f32).collect();
            hairs.push(&points, &vec![35e-6; count]);
        }
        let values = AttributeValues::U32(ids.to_vec());
        hairs.set_attribute(Attribute { name: ID.into(), domain: Domain::Strand, values }).unwrap();
        Groom::of(hairs)
    }

    #[test]
    fn other_strands_are_told() {
        let mut motion = Motion::new(hairs(&[3, 4], &[0, 1]), 0.5);
        motion.push(&hairs(&[3, 4], &[0, 1])).unwrap();
        for (other, told) in [
            (hairs(&[3], &[0]), "sample 3 has 1 hairs, and the first has 2"),
            (hairs(&[3, 5], &[0, 1]), "sample 3 has 5 points in hair 1, and the first has 4"),
            (
                hairs(&[3, 4], &[0, 7]),
                "sample 3 has other hairs than the first: hair 1 has another number",
            ),
        ] {
            assert_eq!(motion.push(&other).unwrap_err().to_string(), told);
        }
        assert_eq!(motion.times().collect::<Vec<_>>(), [0.0, 0.5]);
        assert!(motion.hairs().count() == 2 && motion.guides().count() == 2);
    }
}
