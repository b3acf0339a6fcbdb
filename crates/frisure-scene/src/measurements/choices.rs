//! What a person says about tables.

use frisure_hairstyle::Preset;

/// What a person says about tables.
#[derive(Clone, Debug, Default)]
pub struct Choices {
    /// Columns by their heading, and the heading that they are read as: `diameter (um)`.
    pub columns: Vec<(String, String)>,
    /// Rows that count: those with this text in the column of that heading. A `*` stands for any text.
    pub rows: Vec<(String, String)>,
    /// Of curvatures measured with windows of several lengths, this one (m).
    pub window: Option<f64>,
    /// Whether sections have a shape and no size.
    pub shape_only: bool,
    /// The type that everything else is from; without it, that with the nearest curl.
    pub hair_type: Option<&'static Preset>,
    /// How steep the curl is.
    pub steepness: Option<Steepness>,
}

/// What says how steep the helix is whose curvature is known. A hair pressed flat does not: its
/// torsion is lost.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steepness {
    /// Advance per turn (m).
    Pitch(f64),
    /// Radius of the helix (m).
    Radius(f64),
    /// Length along the hair over the distance that it spans; more than 1.
    CurlIndex(f64),
    /// Turns per length of hair (1/m).
    Turns(f64),
}
