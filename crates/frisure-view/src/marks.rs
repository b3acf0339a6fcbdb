//! Marks on strands.

/// A mark on a strand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mark {
    /// Drawn towards the colour of what is chosen.
    pub chosen: bool,
    /// Part of the length (0 to 1, from the root) from which the strand will be cut off; 1 or more is nothing.
    pub falls_from: f32,
}

impl Default for Mark {
    /// No mark.
    fn default() -> Self {
        Self { chosen: false, falls_from: 1.0 }
    }
}

/// Colours of marks, as on the screen (sRGB, 0 to 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkColours {
    /// Chosen hair.
    pub chosen: [f32; 3],
    /// How far chosen hair is drawn towards it (0 to 1).
    pub strength: f32,
    /// Hair that will fall.
    pub falling: [f32; 3],
    /// How much of hair that will fall is still seen (0 to 1).
    pub remains: f32,
}

impl Default for MarkColours {
    fn default() -> Self {
        Self { chosen: [0.25, 0.62, 1.0], strength: 0.5, falling: [0.95, 0.2, 0.15], remains: 0.35 }
    }
}
