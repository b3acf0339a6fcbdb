//! What can be asked of a [`crate::Stylist`], and what it answers: plain data, so that they can pass
//! between threads and between a page and its workers.

use frisure::formats::contents::Contents;
use serde::{Deserialize, Serialize};

use crate::held::Held;

/// A scene as someone is editing it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Asked {
    /// What errors call it: a path, or a name for a scene that was not saved yet.
    pub name: String,
    /// Its text (TOML), with all steps.
    pub text: String,
    /// The folder that paths in it are relative to.
    pub folder: String,
    /// How many of its steps are done; those behind were undone.
    pub done: usize,
}

/// How good an answer is wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Effort {
    /// While a slider moves: few sweeps from where the hair was, and every few hairs drawn.
    Coarse,
    /// At rest, all hairs.
    #[default]
    Exact,
}

/// Where a picture is taken from.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Viewpoint {
    /// Place of the camera (m).
    pub eye: [f64; 3],
    /// What it looks at (m).
    pub target: [f64; 3],
    /// From the picture's bottom to its top (rad).
    pub field_of_view: f64,
}

/// A job.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Order {
    /// Keeps a file for scenes that name it (a head, a scalp, surroundings), where there is no file
    /// system: by its path, or by its name alone. Answer: [`Answer::Kept`].
    Keep {
        /// Its path, as scenes name it from their folder, or just its name.
        path: String,
        /// What is in it.
        #[serde(with = "crate::bytes::whole")]
        bytes: Vec<u8>,
    },
    /// What is in a file: a head, hair, or both. Answer: [`Answer::Contents`].
    Contents {
        /// Its path, or the name under which it was kept.
        path: String,
    },
    /// The hair, for the eye. Answer: [`Answer::Shown`].
    Show {
        /// Of what.
        asked: Asked,
        /// How well.
        effort: Effort,
    },
    /// Which wisps a step would be about. Answer: [`Answer::Chosen`].
    Choose {
        /// In what.
        asked: Asked,
        /// The step (TOML, one line, such as `wet = { where = "fringe" }`).
        step: String,
    },
    /// One guide with its material frames. Answer: [`Answer::Hair`].
    Hair {
        /// In what.
        asked: Asked,
        /// Which.
        wisp: usize,
        /// Points along it, at least 2.
        points: usize,
    },
    /// All hairs as the bytes of a groom file. Answer: [`Answer::File`].
    Groom {
        /// Of what.
        asked: Asked,
        /// The extension that names the format, such as `hair`.
        format: String,
    },
    /// A traced picture. Answers: [`Answer::Exposed`] while it grows, then [`Answer::File`] (a PNG).
    Picture {
        /// Of what.
        asked: Asked,
        /// From where; `None` is the scene's camera.
        viewpoint: Option<Viewpoint>,
        /// Pixels across and down.
        size: [usize; 2],
        /// Most paths per pixel.
        paths: usize,
        /// Noise at which it is good enough (part of a display's scale, such as 0.02).
        noise: f64,
    },
    /// Pictures around the head. Answers: [`Answer::Progress`], then one [`Answer::File`] (an animated
    /// PNG).
    Turntable {
        /// Of what.
        asked: Asked,
        /// From where the first is taken.
        viewpoint: Option<Viewpoint>,
        /// Pixels across and down.
        size: [usize; 2],
        /// How many.
        frames: usize,
    },
}

/// What comes back.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Answer {
    /// A stage of the work has come this far (0 to 1).
    Progress {
        /// What is being done, in words for a person.
        stage: String,
        /// How far.
        fraction: f32,
    },
    /// The hair.
    Shown(Box<Shown>),
    /// For each wisp, whether it is chosen.
    Chosen(Vec<bool>),
    /// One hair.
    Hair(Box<OneHair>),
    /// A picture as it is so far.
    Exposed {
        /// Pixels across and down.
        size: [usize; 2],
        /// Red, green, blue, alpha (sRGB), rows from the top.
        #[serde(with = "crate::bytes::whole")]
        rgba: Vec<u8>,
        /// How far it is (0 to 1).
        fraction: f32,
        /// Its noise now (part of a display's scale).
        noise: f32,
    },
    /// A finished file.
    File {
        /// What it is called, with its extension.
        name: String,
        /// What is in it.
        #[serde(with = "crate::bytes::whole")]
        bytes: Vec<u8>,
    },
    /// The file is kept.
    Kept,
    /// What is in the file.
    Contents(Contents),
    /// It was told to stop.
    Cancelled,
    /// It cannot be done.
    Refused(Refusal),
}

/// Why something cannot be done, for a person.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Refusal {
    /// What is wrong, with the value and what it may be.
    pub problem: String,
    /// The key of the scene it is about, such as `hair.length`; may be empty.
    pub key: String,
    /// Line of the scene's text, from 1; 0 if it is about no line.
    pub line: usize,
    /// What to do; may be empty.
    pub hint: String,
}

/// Hair to look at.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Shown {
    /// How well it was done.
    pub effort: Effort,
    /// The drawn hairs.
    pub strands: StrandsData,
    /// For how many hairs each of them stands: 1 if all are drawn, more for a coarse answer and for more
    /// hairs than can be looked at.
    pub every: usize,
    /// The head, if it is another than in the last answer of this stylist: positions (m), three each.
    pub head: Option<HeadData>,
    /// What is known about it.
    pub numbers: Numbers,
    /// Where each wisp is rooted (m).
    pub roots: Vec<[f32; 3]>,
    /// How wet each wisp is (0 to 1).
    pub wetness: Vec<f32>,
    /// How well the hair of another program hangs as it was modelled; none for hair that was predicted.
    pub held: Option<Held>,
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

/// A head as plain arrays.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HeadData {
    /// Vertices (m), three numbers each.
    pub positions: Vec<f64>,
    /// Triangles, three vertices each.
    pub triangles: Vec<[u32; 3]>,
    /// What had to be guessed of it, for people; may be empty.
    pub note: String,
}

/// A hairstyle in numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Numbers {
    /// Guides.
    pub wisps: usize,
    /// Those at rest: at a minimum of their energy.
    pub stable: usize,
    /// Those at a saddle: a breath would move them.
    pub unstable: usize,
    /// Those that did not come to rest yet.
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
    /// Seconds it took.
    pub seconds: f64,
}

/// One guide, to be looked at alone (paper, Fig. 3).
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct OneHair {
    /// Which wisp it leads.
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
    /// Elements it was solved with.
    pub elements: usize,
    /// Iterations of the minimiser.
    pub iterations: usize,
    /// Relative gradient that is left.
    pub gradient: f64,
    /// Smallest eigenvalue's sign in words: `stable`, `saddle` or `moving`.
    pub stability: String,
}
