//! One tile of the picture.

/// Side of a tile (pixels). Chosen; no result depends on it.
pub(super) const TILE: usize = 32;

/// Pixels `x0..x1` × `y0..y1` of the picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    pub(super) x0: usize,
    pub(super) y0: usize,
    pub(super) x1: usize,
    pub(super) y1: usize,
}
