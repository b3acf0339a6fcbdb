//! Errors of the BVH.

use glam::{DVec3, Vec3};
use thiserror::Error;

/// Largest coordinate (m) of anything traced: further out, single precision is coarser than a hair.
pub(super) const FARTHEST: f32 = 100.0;

/// Why strands or a mesh cannot be traced. Strands, points and vertices count from 0.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum AccelError {
    /// A coordinate is not finite, or too far out.
    #[error(
        "point {point} of strand {strand} is at {position}: coordinates must be numbers \
         from -100 to 100 m"
    )]
    Position {
        /// Index of the strand.
        strand: usize,
        /// Index of the point in its strand.
        point: usize,
        /// Position (m).
        position: Vec3,
    },
    /// A radius that a fibre cannot have.
    #[error(
        "point {point} of strand {strand} has radius {radius} m: it must be from 1e-7 to 0.01 m"
    )]
    Radius {
        /// Index of the strand.
        strand: usize,
        /// Index of the point in its strand.
        point: usize,
        /// The radius (m).
        radius: f32,
    },
    /// A length in the options is not positive.
    #[error("`{option}` must be a length above 1e-6 m, not {value} m")]
    Option {
        /// Name of the option.
        option: &'static str,
        /// The value given (m).
        value: f32,
    },
    /// A vertex of the mesh is too far out.
    #[error("vertex {vertex} of the head is at {position}: coordinates must be from -100 to 100 m")]
    Vertex {
        /// Index of the vertex.
        vertex: usize,
        /// Position (m).
        position: DVec3,
    },
    /// More pieces than can be counted.
    #[error("strand {strand} is one too many: more than 2^31 pieces of hair")]
    TooMany {
        /// Index of the first strand that is too many.
        strand: usize,
    },
}
