//! The rows of a batch: what is known of each head.

use bytes::Bytes;
use frisure::render::maps::Pinhole;
use frisure::scene::batch::Value;
use frisure_engine::HairstyleMetrics;

/// A head of a batch.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Its index in the batch.
    pub index: usize,
    /// The seed of its scene.
    pub seed: u64,
    /// The value of each of [`frisure::scene::batch::Batch::parameters`]; SI units.
    pub values: Vec<Value>,
    /// The text of its scene, if there is one.
    pub scene: Option<String>,
    /// Its measures, or the message of an error.
    pub outcome: Result<Measured, String>,
}

/// Measures of a head; SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// The hairstyle and its guides.
    pub metrics: HairstyleMetrics,
    /// Space that the hair takes, air included, and that of the fibres themselves (m³), if it was measured.
    pub volume: Option<[f64; 2]>,
    /// Points of each guide.
    pub points: usize,
    /// The points of all guides from root to tip, evenly spaced: x, y, z (m).
    pub lines: Vec<f32>,
    /// Its views as a Parquet file with one group of rows; empty if the batch has none.
    pub(crate) views: Bytes,
}

/// One view, encoded.
pub(crate) struct StoredView {
    pub(crate) camera: Pinhole,
    /// Factor on the width of hairs.
    pub(crate) width: f32,
    /// Each output of the batch.
    pub(crate) outputs: Vec<Bytes>,
}
