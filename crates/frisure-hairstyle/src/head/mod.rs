//! The head: its skin, where hair grows on it, how far it is, and the spheres it is made of.
//!
//! A [`Head`] is checked when it is made; after that nothing about it can fail. Everything is in
//! metres, z up; the face looks towards −y and the head's left is +x.

mod distance;
mod far;
mod guess;
mod landmarks;
mod mannequin;
mod mesher;
mod scalp;
mod sculpt;
mod spheres;
#[cfg(test)]
mod test_shapes;
mod triangles;
mod voxels;

use frisure_strands::Surface;
use thiserror::Error;

pub use distance::SignedDistance;
pub use landmarks::{Landmarks, Region};
pub use spheres::Sphere;

/// A head that hair can be planted on.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    surface: Surface,
    scalp: Vec<f64>,
    landmarks: Landmarks,
    signed_distance: SignedDistance,
    spheres: Vec<Sphere>,
}

/// Where the scalp of a mesh comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum ScalpSource {
    /// Guess it from the shape of the head.
    Guess,
    /// One weight 0..1 per vertex of the mesh.
    Weights(Vec<f64>),
}

/// Why a mesh is not a [`Head`].
#[derive(Clone, Debug, Error, PartialEq)]
pub enum HeadError {
    /// The scalp's weights are not one per vertex.
    #[error("the scalp has {weights} weights, but the mesh has {vertices} vertices")]
    WeightCount {
        /// Number of weights given.
        weights: usize,
        /// Number of vertices of the mesh.
        vertices: usize,
    },
    /// A weight is not between 0 and 1.
    #[error("the scalp's weight of vertex {vertex} is {weight}; it must be between 0 and 1")]
    WeightRange {
        /// Index of the vertex, from 0.
        vertex: usize,
        /// Its weight.
        weight: f64,
    },
    /// No skin has a positive weight.
    #[error("hair grows nowhere: no face of the mesh has a scalp weight above zero")]
    NoScalp,
    /// The mesh is far from the size of a human head.
    #[error(
        "the mesh is {size} m high; a head is about 0.25 m, a bust up to 1 m. Check its units (metres)"
    )]
    Size {
        /// Height of the mesh (m).
        size: f64,
    },
}

/// Lowest and greatest height of a mesh (m) that may be a human head or bust.
const HEIGHTS: std::ops::RangeInclusive<f64> = 0.08..=2.5;

impl Head {
    /// The built-in training head, modelled by code: about 60 000 triangles, the centre of the
    /// cranium at the origin, 23 cm from chin to vertex, on a bust.
    #[must_use]
    pub fn mannequin() -> Self {
        let surface = mannequin::surface();
        let landmarks = mannequin::landmarks();
        let scalp = scalp::weights(&surface, &landmarks);
        Self::assemble(surface, scalp, landmarks)
    }

    /// A head from a mesh (m, z up, face towards −y), which may be open at the shoulders.
    ///
    /// # Errors
    /// [`HeadError`], if the mesh cannot be a human head, the weights are not one number 0..1 per
    /// vertex, or hair grows on no face.
    pub fn from_surface(surface: Surface, scalp: ScalpSource) -> Result<Self, HeadError> {
        let (low, high) = surface.bounds();
        let size = high.z - low.z;
        if !HEIGHTS.contains(&size) {
            return Err(HeadError::Size { size });
        }
        let landmarks = Landmarks::guess(&surface);
        let scalp = match scalp {
            ScalpSource::Guess => scalp::weights(&surface, &landmarks),
            ScalpSource::Weights(weights) => checked(weights, surface.positions().len())?,
        };
        if !grows(&surface, &scalp) {
            return Err(HeadError::NoScalp);
        }
        Ok(Self::assemble(surface, scalp, landmarks))
    }

    fn assemble(surface: Surface, scalp: Vec<f64>, landmarks: Landmarks) -> Self {
        let signed_distance = SignedDistance::new(&surface);
        let spheres = spheres::fit(&surface, &scalp, &signed_distance);
        Self { surface, scalp, landmarks, signed_distance, spheres }
    }

    /// The skin (m).
    #[must_use]
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Per vertex, how densely hair grows: 0 nowhere, 1 fully, between across the hairline.
    #[must_use]
    pub fn scalp(&self) -> &[f64] {
        &self.scalp
    }

    /// Where things are on the head.
    #[must_use]
    pub fn landmarks(&self) -> &Landmarks {
        &self.landmarks
    }

    /// Distance to the skin, positive outside.
    #[must_use]
    pub fn signed_distance(&self) -> &SignedDistance {
        &self.signed_distance
    }

    /// The head as spheres, largest errors first mended: dense on the scalp, coarser elsewhere.
    #[must_use]
    pub fn spheres(&self) -> &[Sphere] {
        &self.spheres
    }
}

fn checked(weights: Vec<f64>, vertices: usize) -> Result<Vec<f64>, HeadError> {
    if weights.len() != vertices {
        return Err(HeadError::WeightCount { weights: weights.len(), vertices });
    }
    match weights.iter().position(|w| !(0.0..=1.0).contains(w)) {
        Some(vertex) => Err(HeadError::WeightRange { vertex, weight: weights[vertex] }),
        None => Ok(weights),
    }
}

fn grows(surface: &Surface, scalp: &[f64]) -> bool {
    surface.triangles().iter().enumerate().any(|(face, triangle)| {
        triangle.iter().any(|&v| scalp[v as usize] > 0.0)
            && surface.doubled_area_vector(face).length() > 0.0
    })
}
