//! A measured fibre: the lines in which it was seen to hang.

use glam::DVec3;
use thiserror::Error;

/// Fewest points of a line. Six numbers place its root, and three or four are the fibre's.
pub const FEWEST_POINTS: usize = 5;

/// Longest line, and farthest point from the origin (m): as for hairs in files.
const FARTHEST: f64 = 5000.0;

/// Strongest field of gravity (m/s²): a centrifuge.
const STRONGEST: f64 = 1e5;

/// One line of a fibre at rest, clamped at its first point and free at its other end.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    points: Vec<DVec3>,
    arc: Option<Vec<f64>>,
    gravity: DVec3,
    state: usize,
}

/// Why a line cannot be fitted.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum PoseError {
    /// Too few points.
    #[error("a line has {given} points; it must have at least {FEWEST_POINTS}")]
    FewPoints {
        /// How many were given.
        given: usize,
    },
    /// A coordinate that is no number or far away.
    #[error("point {point} is ({}, {}, {}) m; coordinates must be finite and at most {FARTHEST} m", at.x, at.y, at.z)]
    Point {
        /// Its index.
        point: usize,
        /// Where it is.
        at: DVec3,
    },
    /// A line without length.
    #[error("all points of a line are the same; it must have a length")]
    NoLength,
    /// Arc lengths that are not one for each point.
    #[error("a line of {points} points has {arcs} arc lengths; it must have one for each point")]
    ArcCount {
        /// Points.
        points: usize,
        /// Arc lengths.
        arcs: usize,
    },
    /// Arc lengths that do not increase.
    #[error(
        "the arc length of point {point} is {arc} m; arc lengths must be finite, at least 0, and greater from point to point"
    )]
    Arc {
        /// The index of the point.
        point: usize,
        /// Its arc length (m).
        arc: f64,
    },
    /// An arc length beyond the end of the fibre, or a length that is no length.
    #[error(
        "the length is {length} m; it must be finite and at least that of the last arc length, {arc} m"
    )]
    Length {
        /// The length (m).
        length: f64,
        /// The last arc length (m), or 0.
        arc: f64,
    },
    /// Gravity that is no number.
    #[error("gravity is ({}, {}, {}) m/s²; it must be finite and at most {STRONGEST} m/s²", at.x, at.y, at.z)]
    Gravity {
        /// What was given.
        at: DVec3,
    },
    /// A fibre without a line.
    #[error("a fibre has no line; it must have at least one")]
    NoPose,
    /// A state of wetness that no line is in.
    #[error("line {pose} is in state {state}; states are counted from 0, and each has a line")]
    State {
        /// The index of the line.
        pose: usize,
        /// Its state.
        state: usize,
    },
}

impl Pose {
    /// A line of points (m) from the root on, in gravity (m/s², in the same axes; zero for a fibre without weight, in water or lying
    /// flat).
    ///
    /// `arc` is the arc length of each point from the clamp (m). Without it the place of a point along the fibre is unknown, the first
    /// point is the clamp, and the last one is the tip. `state` is 0, or the number of another state of wetness that has a stiffness of
    /// its own.
    ///
    /// # Errors
    /// [`PoseError`], with the index of the point.
    pub fn new(
        points: Vec<DVec3>,
        arc: Option<Vec<f64>>,
        gravity: DVec3,
        state: usize,
    ) -> Result<Self, PoseError> {
        if points.len() < FEWEST_POINTS {
            return Err(PoseError::FewPoints { given: points.len() });
        }
        let wrong =
            points.iter().position(|p| !(p.is_finite() && p.abs().max_element() <= FARTHEST));
        if let Some(point) = wrong {
            return Err(PoseError::Point { point, at: points[point] });
        }
        if points.iter().all(|p| *p == points[0]) {
            return Err(PoseError::NoLength);
        }
        if !(gravity.length() <= STRONGEST) {
            return Err(PoseError::Gravity { at: gravity });
        }
        if let Some(arc) = &arc {
            if arc.len() != points.len() {
                return Err(PoseError::ArcCount { points: points.len(), arcs: arc.len() });
            }
            let mut before = f64::NEG_INFINITY;
            for (point, &arc) in arc.iter().enumerate() {
                if !(arc >= 0.0 && arc > before && arc <= FARTHEST) {
                    return Err(PoseError::Arc { point, arc });
                }
                before = arc;
            }
        }
        Ok(Self { points, arc, gravity, state })
    }

    /// Its points (m).
    #[must_use]
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The arc length of each point (m), if it is known.
    #[must_use]
    pub fn arc(&self) -> Option<&[f64]> {
        self.arc.as_deref()
    }

    /// Gravity (m/s²).
    #[must_use]
    pub fn gravity(&self) -> DVec3 {
        self.gravity
    }

    /// Its state of wetness.
    #[must_use]
    pub fn state(&self) -> usize {
        self.state
    }
}

/// The lines of one fibre.
#[derive(Clone, Debug, PartialEq)]
pub struct Fibre {
    poses: Vec<Pose>,
    length: Option<f64>,
}

impl Fibre {
    /// A fibre that was seen in one line or several.
    ///
    /// `length` (m) is that of the whole fibre, from the clamp to the tip. Without it the last arc length is the tip's, or it is fitted where
    /// no arc lengths are known.
    ///
    /// # Errors
    /// [`PoseError`].
    pub fn new(poses: Vec<Pose>, length: Option<f64>) -> Result<Self, PoseError> {
        if poses.is_empty() {
            return Err(PoseError::NoPose);
        }
        let states = poses.iter().map(|pose| pose.state).max().unwrap_or(0) + 1;
        let missing = (0..states).find(|state| poses.iter().all(|pose| pose.state != *state));
        if missing.is_some() {
            let pose = (0..poses.len()).max_by_key(|&i| poses[i].state).unwrap_or(0);
            return Err(PoseError::State { pose, state: poses[pose].state });
        }
        let last = poses.iter().filter_map(|pose| pose.arc.as_ref()?.last().copied());
        let last = last.fold(0.0, f64::max);
        if let Some(length) = length
            && !(length > 0.0 && length <= FARTHEST && length >= last)
        {
            return Err(PoseError::Length { length, arc: last });
        }
        Ok(Self { poses, length })
    }

    /// Its lines.
    #[must_use]
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// How many states of wetness it has.
    #[must_use]
    pub fn states(&self) -> usize {
        self.poses.iter().map(|pose| pose.state).max().unwrap_or(0) + 1
    }

    /// Its length (m) in a state, where it is known: as given, or the last arc length of the lines in that state.
    #[must_use]
    pub fn length(&self, state: usize) -> Option<f64> {
        let in_state = self.poses.iter().filter(|pose| pose.state == state);
        let last = in_state.filter_map(|pose| pose.arc.as_ref()?.last().copied());
        self.length.or_else(|| last.reduce(f64::max))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(count: usize) -> Vec<DVec3> {
        (0..count).map(|i| DVec3::X * i as f64 * 0.01).collect()
    }

    #[test]
    fn wrong_lines_are_refused_with_the_index() {
        let pose = |points, arc| Pose::new(points, arc, DVec3::NEG_Z * 9.81, 0).unwrap_err();
        assert_eq!(pose(line(4), None), PoseError::FewPoints { given: 4 });
        let mut bad = line(6);
        bad[3].y = f64::NAN;
        assert!(pose(bad, None).to_string().starts_with("point 3 is (0.03, NaN, 0) m;"));
        assert_eq!(pose(vec![DVec3::X; 6], None), PoseError::NoLength);
        assert_eq!(pose(line(5), Some(vec![0.0; 3])), PoseError::ArcCount { points: 5, arcs: 3 });
        let arc = vec![0.0, 0.1, 0.1, 0.2, 0.3];
        assert_eq!(pose(line(5), Some(arc)), PoseError::Arc { point: 2, arc: 0.1 });
        assert!(Pose::new(line(5), None, DVec3::NAN, 0).is_err());
        let pose = Pose::new(line(5), Some(vec![0.0, 0.01, 0.02, 0.03, 0.04]), DVec3::ZERO, 1);
        let pose = pose.unwrap();
        assert_eq!(Fibre::new(vec![], None), Err(PoseError::NoPose));
        let state = Fibre::new(vec![pose.clone()], None);
        assert_eq!(state, Err(PoseError::State { pose: 0, state: 1 }));
        let dry = Pose::new(line(5), None, DVec3::ZERO, 0).unwrap();
        let short = Fibre::new(vec![dry.clone(), pose.clone()], Some(0.03));
        assert_eq!(short, Err(PoseError::Length { length: 0.03, arc: 0.04 }));
        let fibre = Fibre::new(vec![dry, pose], None).unwrap();
        assert_eq!((fibre.states(), fibre.length(0), fibre.length(1)), (2, None, Some(0.04)));
    }
}
