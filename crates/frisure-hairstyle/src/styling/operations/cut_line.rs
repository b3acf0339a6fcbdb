//! Where scissors go, and how hair is held meanwhile.

use glam::DVec3;

use crate::styling::height::Height;

/// Where the scissors go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CutLine {
    /// A horizontal plane; what is below falls. \[paper\] §3.2
    Below(Height),
    /// A plane; what is on the side that the normal points to falls.
    Plane {
        /// A point of the plane (m).
        point: DVec3,
        /// Towards the hair that falls; any length but zero.
        normal: DVec3,
    },
    /// A sphere around the head; what is outside falls.
    Sphere {
        /// Centre (m).
        centre: DVec3,
        /// Radius (m).
        radius: f64,
    },
    /// This far (m) from the skin: what is farther away falls.
    OffSkin(f64),
    /// This much hair is left (m), along the fibre, wherever it is rooted.
    Length(f64),
    /// All hair is pulled straight to this point (m) and cut there: a stationary guide, which leaves
    /// hair the longer the farther it is rooted.
    Gathered(DVec3),
}

/// How hair is held while it is cut; [`CutLine::Length`] and [`CutLine::Gathered`] need no hold.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Held {
    /// Combed straight down from its root, as if the head were not in the way: below a horizontal
    /// plane at z_c the paper's rule, L = z_root − z_c. \[paper\] §3.2
    Down,
    /// Not at all: each hair is cut where its curve first meets the line.
    #[default]
    Hanging,
    /// Straight out from its root at an elevation (rad): 0 is flat along the skin downwards (one
    /// length), π/4 graduates, π/2 is perpendicular to the skin (layers), more turns it upwards.
    Elevated(f64),
}
