//! What a [`crate::Session`] returns: plain data that can pass between threads and between a page and its workers.

use frisure::formats::contents::Contents;
use serde::{Deserialize, Serialize};

use crate::adoption::AdoptionReport;
use crate::diagnostic::Diagnostic;
use crate::error::Error;
use crate::quality::Quality;

/// The response to a [`crate::Request`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Response {
    /// A stage of the work has come this far (0 to 1).
    Progress {
        /// Its name for a person.
        stage: String,
        /// The fraction.
        fraction: f32,
    },
    /// The hair to look at.
    Preview(Box<Preview>),
    /// For each wisp, whether it is selected.
    Selected(Vec<bool>),
    /// One guide.
    Guide(Box<GuideData>),
    /// A picture that is not finished.
    PartialPicture {
        /// Pixels across and down.
        size: [usize; 2],
        /// Red, green, blue, alpha (sRGB), rows from the top.
        #[serde(with = "crate::bytes::whole")]
        rgba: Vec<u8>,
        /// Fraction of its samples (0 to 1).
        fraction: f32,
        /// Its noise (part of a display's scale).
        noise: f32,
    },
    /// A finished file.
    File {
        /// Its name with extension.
        name: String,
        /// Its content.
        #[serde(with = "crate::bytes::whole")]
        bytes: Vec<u8>,
    },
    /// The file is known to the session.
    FileProvided,
    /// The content of the file.
    Contents(Contents),
    /// The request was cancelled.
    Cancelled,
    /// The request cannot be executed.
    Failed(Diagnostic),
}

impl Response {
    /// The progress of a stage (0 to 1).
    #[must_use]
    pub fn progress(stage: &str, fraction: f64) -> Self {
        Self::Progress { stage: stage.to_owned(), fraction: fraction as f32 }
    }
}

impl From<Error> for Response {
    fn from(error: Error) -> Self {
        match &error {
            Error::Cancelled(_) => Self::Cancelled,
            error => Self::Failed(error.into()),
        }
    }
}

/// Hair to look at.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Preview {
    /// The quality.
    pub quality: Quality,
    /// The drawn hairs.
    pub strands: StrandsData,
    /// Every n-th hair is drawn: 1 if all are, more for a coarse preview and for more hairs than can be
    /// looked at.
    pub stride: usize,
    /// The head, if it differs from that of the last preview of the session.
    pub head: Option<HeadData>,
    /// Its numbers.
    pub numbers: Numbers,
    /// Root of each wisp (m).
    pub roots: Vec<[f32; 3]>,
    /// Wetness of each wisp (0 to 1).
    pub wetness: Vec<f32>,
    /// How well the groom of another program keeps its shape; none for hair that was predicted.
    pub adoption: Option<AdoptionReport>,
    /// What holds the hair, in every preview anew; empty where nothing is held, and if `output.accessories` is false.
    pub accessories: AccessoryData,
}

/// Strands as plain arrays: see `frisure::strands::Strands`.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StrandsData {
    /// First point of each strand, and the number of points at the end.
    pub offsets: Vec<u32>,
    /// Points (m), three numbers each.
    #[serde(with = "crate::bytes")]
    pub points: Vec<f32>,
    /// Radius at each point (m).
    #[serde(with = "crate::bytes")]
    pub radii: Vec<f32>,
    /// The wisp of each strand.
    pub guide: Vec<u32>,
    /// Wetness at each point (0 to 1); empty if all is dry.
    #[serde(with = "crate::bytes")]
    pub wetness: Vec<f32>,
}

/// What holds hair (rollers, hair ties, elastics, pins, clips) as one mesh in parts, in the head's frame.
/// [`AccessoryData::meshes`] has a mesh for each part, as `frisure_view::Skin::with_accessories` takes them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AccessoryData {
    /// Vertices (m), three numbers each.
    #[serde(with = "crate::bytes")]
    pub positions: Vec<f32>,
    /// Outward unit normal at each vertex, three numbers each.
    #[serde(with = "crate::bytes")]
    pub normals: Vec<f32>,
    /// Triangles, three vertices each, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// The objects, in the order of their vertices and triangles.
    pub parts: Vec<AccessoryPart>,
}

/// One object of [`AccessoryData`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AccessoryPart {
    /// Its name: `roller_0`, `tie_0`, `elastic_0`, `pin_0`, `clip_0` and so on.
    pub name: String,
    /// Number of its vertices, which follow those of the part before.
    pub vertices: usize,
    /// Number of its triangles, which follow those of the part before.
    pub triangles: usize,
    /// Diffuse reflectance (linear sRGB).
    pub colour: [f32; 3],
    /// Strength of its gloss, in the unit of `look.gloss`.
    pub gloss: f32,
    /// Roughness of its gloss (α of GGX).
    pub roughness: f32,
}

/// A head as plain arrays.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeadData {
    /// Vertices (m), three numbers each.
    pub positions: Vec<f64>,
    /// Triangles, three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// Red of lips, blood beneath the skin, garment and scalp at each vertex, four numbers from 0 to 1 each; may be empty.
    #[serde(with = "crate::bytes")]
    pub tints: Vec<f32>,
    /// Eyes: centre (m), radius (m) and unit direction of the gaze.
    pub eyes: Vec<[f64; 7]>,
    /// Brows, followed by lashes.
    pub hairs: StrandsData,
    /// How many of them are lashes.
    pub lashes: usize,
    /// Levels that cuts are named by, and their heights (m).
    pub levels: Vec<(String, f64)>,
    /// What was guessed of it, for a person; may be empty.
    pub note: String,
}

/// A hairstyle in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    /// Guides.
    pub wisps: usize,
    /// Those at a minimum of their energy.
    pub stable: usize,
    /// Those at a saddle of their energy.
    pub unstable: usize,
    /// Those that did not converge yet.
    pub moving: usize,
    /// Hairs that grow on the head.
    pub hairs: f64,
    /// Hairs drawn.
    pub drawn: usize,
    /// Mass of all hair (kg).
    pub mass: f64,
    /// Mean length along the guides (m).
    pub length: f64,
    /// Mean height of the guides' tips (m).
    pub tips: f64,
    /// Time of the computation (s).
    pub seconds: f64,
}

/// One guide with its material frames (paper, Fig. 3).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GuideData {
    /// Its wisp.
    pub wisp: usize,
    /// Points from root to tip (m).
    pub points: Vec<[f32; 3]>,
    /// Material frames there: d1, d2, t.
    pub frames: Vec<[[f32; 3]; 3]>,
    /// Length (m).
    pub length: f64,
    /// Semi-axes of its section (m).
    pub section: [f64; 2],
    /// Elastic, gravitational and contact energy (J).
    pub energy: [f64; 3],
    /// Elements of its discretisation.
    pub elements: usize,
    /// Iterations of the minimiser.
    pub iterations: usize,
    /// Relative gradient of the energy.
    pub gradient: f64,
    /// The sign of the smallest eigenvalue: `stable`, `saddle` or `moving`.
    pub stability: String,
}
