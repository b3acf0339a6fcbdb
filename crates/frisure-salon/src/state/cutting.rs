//! The cutting plane that a hand drags and tilts, and the hair that would fall.

use frisure::hairstyle::styling::{Cut, CutLine, Held, Operation, Selection};
use frisure_engine::StrandsData;
use glam::DVec3;

/// A plane before the head; hair on the side of its normal falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Its middle, where the handle is (m).
    pub point: DVec3,
    /// How far it leans to the head's left (rad): positive leaves more hair there.
    pub roll: f64,
    /// How far it leans to the back (rad): positive leaves more hair there.
    pub pitch: f64,
    /// Whether hair is cut as it hangs, each at the plane, or combed straight down first.
    pub held: Hold,
}

/// How hair is held while it is cut by a plane.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hold {
    /// As it hangs.
    #[default]
    Hanging,
    /// Combed straight down, as in the paper.
    Down,
}

/// Steepest lean (rad).
const STEEPEST: f64 = 1.4;
/// Farthest from the origin (m).
const FARTHEST: f64 = 2.0;

impl Plane {
    /// A level plane at a height (m).
    #[must_use]
    pub fn level(z: f64) -> Self {
        let point = DVec3::new(0.0, 0.0, z);
        Self { point, roll: 0.0, pitch: 0.0, held: Hold::Hanging }
    }

    /// Towards the hair that falls.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        let (sr, cr) = self.roll.sin_cos();
        let (sp, cp) = self.pitch.sin_cos();
        DVec3::new(-sr * cp, -sp * cr, -cr * cp).normalize()
    }

    /// Moves it along its normal, against what falls (m): up, for a level one.
    pub fn raise(&mut self, by: f64) {
        if by.is_finite() {
            self.point = (self.point - by * self.normal()).clamp_length_max(FARTHEST);
        }
    }

    /// Tilts it by angles (rad).
    pub fn tilt(&mut self, roll: f64, pitch: f64) {
        if roll.is_finite() && pitch.is_finite() {
            self.roll = (self.roll + roll).clamp(-STEEPEST, STEEPEST);
            self.pitch = (self.pitch + pitch).clamp(-STEEPEST, STEEPEST);
        }
    }

    /// The step that cuts there.
    #[must_use]
    pub fn operation(&self, selection: Selection) -> Operation {
        let held = match self.held {
            Hold::Hanging => Held::Hanging,
            Hold::Down => Held::Down,
        };
        // A tenth of a millimetre and a hundredth of a degree are finer than any hand.
        let round = |v: DVec3, to: f64| (v / to).round() * to;
        let line = CutLine::Plane {
            point: tidy(round(self.point, 1e-4)),
            normal: tidy(round(self.normal(), 1e-4)),
        };
        Operation::Cut(Cut { selection, line, held })
    }

    /// What would fall of the drawn hairs of chosen wisps (`None`: of all).
    #[must_use]
    pub fn falling(&self, strands: &StrandsData, chosen: Option<&[bool]>) -> Falling {
        let (point, normal) = (self.point.as_vec3(), self.normal().as_vec3());
        let beyond = |i: usize| {
            let p = &strands.points[3 * i..3 * i + 3];
            (glam::Vec3::new(p[0], p[1], p[2]) - point).dot(normal)
        };
        let mut from = Vec::with_capacity(strands.guide.len());
        let (mut fell, mut all, mut hairs) = (0.0_f64, 0.0_f64, 0);
        for (ends, guide) in strands.offsets.windows(2).zip(&strands.guide) {
            let (first, last) = (ends[0] as usize, ends[1] as usize);
            let is_chosen = chosen.is_none_or(|c| c.get(*guide as usize).copied().unwrap_or(false));
            let pieces = last.saturating_sub(first + 1).max(1) as f32;
            let kept = if is_chosen { kept(first..last, beyond) / pieces } else { 1.0 };
            let length = f64::from(pieces);
            all += length;
            fell += length * f64::from(1.0 - kept);
            hairs += usize::from(kept < 1.0);
            from.push(kept);
        }
        Falling { from, share: if all > 0.0 { fell / all } else { 0.0 }, hairs }
    }
}

/// Pieces of a strand before it first meets the plane; a root that is beyond it keeps what it has.
fn kept(points: std::ops::Range<usize>, beyond: impl Fn(usize) -> f32) -> f32 {
    let (first, pieces) = (points.start, points.len().saturating_sub(1));
    let mut before = if points.is_empty() { return 0.0 } else { beyond(first) };
    for k in 1..=pieces {
        let here = beyond(first + k);
        if before <= 0.0 && here > 0.0 {
            return (k - 1) as f32 + before / (before - here);
        }
        before = here;
    }
    pieces as f32
}

/// −0 is written as 0.
fn tidy(v: DVec3) -> DVec3 {
    v + DVec3::ZERO
}

/// What a cut would take.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Falling {
    /// For each strand, the part of it that stays (1: all of it).
    pub from: Vec<f32>,
    /// Part of all drawn length that falls.
    pub share: f64,
    /// Drawn hairs that lose something.
    pub hairs: usize,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Hairs of 10 cm that hang straight down from height 0, with points every centimetre.
    fn curtain(count: usize) -> StrandsData {
        let mut strands = StrandsData { offsets: vec![0], ..Default::default() };
        for i in 0..count {
            for k in 0..11 {
                strands.points.extend([0.01 * i as f32, 0.0, -0.01 * k as f32]);
                strands.radii.push(4e-5);
            }
            strands.offsets.push(strands.radii.len() as u32);
            strands.guide.push(i as u32);
        }
        strands
    }

    #[test]
    fn what_is_below_a_level_plane_falls() {
        let strands = curtain(4);
        let falling = Plane::level(-0.025).falling(&strands, None);
        assert_eq!(falling.hairs, 4);
        assert!(falling.from.iter().all(|f| (f - 0.25).abs() < 1e-5), "{falling:?}");
        assert!((falling.share - 0.75).abs() < 1e-6);
        let one = Plane::level(-0.025).falling(&strands, Some(&[true, false, false, false]));
        assert_eq!(one.hairs, 1);
    }

    #[test]
    fn a_tilted_plane_leaves_more_where_it_leans_to() {
        let mut plane = Plane::level(-0.05);
        plane.tilt(0.5, 0.0);
        let falling = plane.falling(&curtain(4), None);
        assert!(falling.from.windows(2).all(|f| f[0] < f[1]), "{:?}", falling.from);
        assert!(plane.operation(Selection::Everything).check().is_ok());
    }
}
