//! What a comb or a clip pulls at a guide with.

use frisure_rod::potential::Field;
use glam::{DMat3, DVec3};

use super::braid::BraidPath;
use crate::math::outer;

/// A pull at a guide, as an energy per length of hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pull {
    /// A comb: the same force on every length of hair up to where the comb is, energy `−f·r`.
    Comb {
        /// Force per length (N/m).
        force: DVec3,
        /// Arc length (m) beyond which hair hangs free.
        until: f64,
    },
    /// A clip: a short piece of hair is held at a point, as a spring that never pulls harder than
    /// `f`: `½ c d²` at the distance d = |r − p| up to f/c, `f d − ½ f²/c` farther away.
    Clip {
        /// Arc length (m) at which the piece begins and ends.
        piece: [f64; 2],
        /// The point p (m) at which the piece begins.
        point: DVec3,
        /// The way of the piece from there: a unit vector through a tie, zero where all of it is held at the point.
        way: DVec3,
        /// Stiffness c (Pa).
        stiffness: f64,
        /// Largest force f per length (N/m).
        most: f64,
    },
    /// A braid: hair is held along its way in one of three locks, from a tie on, as a clip holds it at a point.
    Braid {
        /// The way.
        path: BraidPath,
        /// Arc length (m) at which hair is in the tie, and where it is in the elastic or ends.
        piece: [f64; 2],
        /// Stiffness c (Pa).
        stiffness: f64,
        /// Largest force f per length (N/m).
        most: f64,
    },
}

frisure_digest::digest_fields!(
    Pull: Comb { force, until },
    Clip { piece, point, way, stiffness, most },
    Braid { path, piece, stiffness, most }
);

impl Pull {
    /// The same, `factor` times as strong.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        match self {
            Self::Comb { force, until } => Self::Comb { force: force * factor, until },
            Self::Clip { piece, point, way, stiffness, most } => {
                Self::Clip { piece, point, way, stiffness: stiffness * factor, most: most * factor }
            }
            Self::Braid { path, piece, stiffness, most } => {
                Self::Braid { path, piece, stiffness: stiffness * factor, most: most * factor }
            }
        }
    }
}

impl Pull {
    /// A clip on its way to another place, of which it has gone the share 0 to 1; the other pull where either is no clip.
    pub(crate) fn moved(self, other: Self, share: f64) -> Self {
        let (Self::Clip { point: from, .. }, Self::Clip { piece, point: to, way, stiffness, most }) =
            (self, other)
        else {
            return other;
        };
        Self::Clip { piece, point: from.lerp(to, share), way, stiffness, most }
    }
}

impl Pull {
    /// The piece (arc lengths, m) that is held in a braid, where hair is packed as the hand has packed it.
    pub(crate) fn braided(&self) -> Option<[f64; 2]> {
        match *self {
            Self::Braid { piece, .. } => Some(piece),
            Self::Comb { .. } | Self::Clip { .. } => None,
        }
    }

    /// How far (m) the point at arc length `s` (m) and position `p` (m) is from where it is pulled with the largest force.
    pub(crate) fn switch_distance(&self, s: f64, p: DVec3) -> f64 {
        self.spring(s).map_or(f64::INFINITY, |(point, stiffness, most)| {
            (p.distance(point) - most / stiffness).abs()
        })
    }

    /// What holds the hair at an arc length (m): the point (m), the stiffness (Pa) and the largest force per length (N/m).
    fn spring(&self, s: f64) -> Option<(DVec3, f64, f64)> {
        match *self {
            Self::Comb { .. } => None,
            Self::Clip { piece: [from, to], point, way, stiffness, most } => {
                (from..=to).contains(&s).then(|| (point + way * (s - from), stiffness, most))
            }
            Self::Braid { path, piece: [from, to], stiffness, most } => {
                (from..=to).contains(&s).then(|| (path.place_beyond(s - from), stiffness, most))
            }
        }
    }
}

impl Field for Pull {
    fn energy(&self, s: f64, p: DVec3) -> f64 {
        if let Self::Comb { force, until } = *self {
            return if s <= until { -force.dot(p) } else { 0.0 };
        }
        let Some((point, stiffness, most)) = self.spring(s) else { return 0.0 };
        // A spring up to the distance f/c, a constant force beyond (Huber): value and slope meet there.
        let (away, near) = (p.distance(point), most / stiffness);
        if away < near { 0.5 * stiffness * away * away } else { most * (away - 0.5 * near) }
    }

    fn derivatives(&self, s: f64, p: DVec3) -> Option<(DVec3, DMat3)> {
        if let Self::Comb { force, until } = *self {
            // E = −f·r is linear: no stiffness.
            return (s <= until).then_some((-force, DMat3::ZERO));
        }
        let (point, stiffness, most) = self.spring(s)?;
        let away = p - point;
        let distance = away.length();
        if distance * stiffness < most {
            return Some((away * stiffness, DMat3::from_diagonal(DVec3::splat(stiffness))));
        }
        // The force keeps its size and turns with the direction: stiffness f/d at right angles to it, none along it.
        let way = away / distance;
        let across = DMat3::IDENTITY - outer(way, way);
        Some((way * most, across * (most / distance)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn derivatives_agree_with_differences() {
        let point = DVec3::new(0.01, 0.02, -0.03);
        let way = DVec3::new(0.6, 0.0, 0.8);
        let clip = Pull::Clip { piece: [0.0, 0.1], point, way, stiffness: 20.0, most: 0.1 };
        assert_eq!(clip.energy(0.05, point + way * 0.05), 0.0);
        for away in [DVec3::X * 1e-3, DVec3::new(0.01, -0.02, 0.03)] {
            let p = point + way * 0.05 + away;
            let (gradient, hessian) = clip.derivatives(0.05, p).unwrap();
            let h = 1e-6;
            for axis in 0..3 {
                let mut step = DVec3::ZERO;
                step[axis] = h;
                let slope = (clip.energy(0.05, p + step) - clip.energy(0.05, p - step)) / (2.0 * h);
                assert!((slope - gradient[axis]).abs() < 1e-8, "{slope} {gradient}");
                let at = |p| clip.derivatives(0.05, p).unwrap().0;
                let column = (at(p + step) - at(p - step)) / (2.0 * h);
                assert!((column - hessian.col(axis)).length() < 1e-6);
            }
            assert!(gradient.length() <= 0.1 + 1e-12);
        }
        assert!(clip.derivatives(0.2, point).is_none());
    }
}
