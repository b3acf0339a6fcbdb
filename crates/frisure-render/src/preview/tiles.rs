//! The picture in squares, each with the pieces of hair and the faces that may touch it.

use rayon::prelude::*;

use super::area::{Area, TILE};
use super::curves::Curves;
use super::head::Head;
use super::projection::{NEAR, Projection};

/// How far across a hair its softened edge can reach (pixels): half a pixel and half of the rise of
/// a line within a column.
const REACH: f32 = 1.0;
/// Vertices per parallel job. Chosen; no result depends on it.
const CHUNK: usize = 1 << 16;

/// The tiles of a picture, and what lies in them.
pub(super) struct TileGrid {
    columns: usize,
    rows: usize,
    width: usize,
    height: usize,
    hair: Lists<HairPiece>,
    head: Lists<u32>,
}

/// A piece of hair in a tile: bits of its mean depth, which sort as the depth does since it is positive, and the index of its first vertex.
pub(super) type HairPiece = [u32; 2];

/// One list per tile, stored flat.
struct Lists<T> {
    offsets: Vec<usize>,
    items: Vec<T>,
}

impl<T: Copy + Default> Lists<T> {
    /// Sorts (tile, item) pairs into lists; each keeps the order of the pairs.
    fn new(tiles: usize, pairs: &[Vec<(u32, T)>]) -> Self {
        let mut offsets = vec![0; tiles + 1];
        for &(tile, _) in pairs.iter().flatten() {
            offsets[tile as usize + 1] += 1;
        }
        for i in 0..tiles {
            offsets[i + 1] += offsets[i];
        }
        let mut next = offsets.clone();
        let mut items = vec![T::default(); offsets[tiles]];
        for &(tile, item) in pairs.iter().flatten() {
            items[next[tile as usize]] = item;
            next[tile as usize] += 1;
        }
        Self { offsets, items }
    }

    fn of(&self, tile: usize) -> &[T] {
        &self.items[self.offsets[tile]..self.offsets[tile + 1]]
    }
}

impl TileGrid {
    pub(super) fn new(view: &Projection, curves: &Curves, head: Option<&Head>) -> Self {
        let (columns, rows) = (view.width.div_ceil(TILE), view.height.div_ceil(TILE));
        let (width, height) = (view.width, view.height);
        let (hair, none) = (Lists::new(columns * rows, &[]), Lists::new(columns * rows, &[]));
        let mut grid = Self { columns, rows, width, height, hair, head: none };
        let chunks = curves.vertices.len().div_ceil(CHUNK);
        let pairs: Vec<_> = (0..chunks)
            .into_par_iter()
            .map(|c| grid.hair_pairs(view, curves, c * CHUNK..(c + 1) * CHUNK))
            .collect();
        grid.hair = Lists::new(grid.len(), &pairs);
        if let Some(head) = head {
            grid.head = Lists::new(grid.len(), &[grid.head_pairs(view, head)]);
        }
        grid
    }

    /// Number of tiles.
    pub(super) fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Pixels of a tile.
    pub(super) fn area(&self, tile: usize) -> Area {
        let (x0, y0) = (tile % self.columns * TILE, tile / self.columns * TILE);
        Area { x0, y0, x1: (x0 + TILE).min(self.width), y1: (y0 + TILE).min(self.height) }
    }

    /// Pieces of hair that may touch a tile.
    pub(super) fn hair(&self, tile: usize) -> &[HairPiece] {
        self.hair.of(tile)
    }

    /// Faces of the head that may touch a tile.
    pub(super) fn head(&self, tile: usize) -> &[u32] {
        self.head.of(tile)
    }

    fn hair_pairs(
        &self,
        view: &Projection,
        curves: &Curves,
        range: std::ops::Range<usize>,
    ) -> Vec<(u32, HairPiece)> {
        let mut pairs = Vec::new();
        for i in range.start..range.end.min(curves.vertices.len()) {
            let Some((a, b)) = curves.piece(i) else { continue };
            let (p, q) = (view.project(a.position), view.project(b.position));
            let depth = p.z.min(q.z);
            if !(depth > NEAR) {
                continue;
            }
            let reach = REACH + 1.5 * a.half_width.max(b.half_width) * view.focal / depth;
            let (low, high) = (p.min(q) - reach, p.max(q) + reach);
            let piece = [(0.5 * (p.z + q.z)).to_bits(), i as u32];
            self.touched([low.x, low.y, high.x, high.y], |tile| pairs.push((tile, piece)));
        }
        pairs
    }

    fn head_pairs(&self, view: &Projection, head: &Head) -> Vec<(u32, u32)> {
        let mut pairs = Vec::new();
        for (i, corners) in head.faces().enumerate() {
            let [a, b, c] = corners.map(|p| view.project(p));
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            if low.z > NEAR {
                self.touched([low.x, low.y, high.x, high.y], |tile| pairs.push((tile, i as u32)));
            }
        }
        pairs
    }

    /// Calls `visit` for each tile that meets the box (left, top, right, bottom), in pixels.
    fn touched(&self, [left, top, right, bottom]: [f32; 4], mut visit: impl FnMut(u32)) {
        let tile = TILE as f32;
        if !(right >= 0.0 && bottom >= 0.0) {
            return;
        }
        // The casts saturate: what is left of the picture becomes 0.
        let columns = (left / tile) as usize..=((right / tile) as usize).min(self.columns - 1);
        for row in (top / tile) as usize..=((bottom / tile) as usize).min(self.rows - 1) {
            for column in columns.clone() {
                visit((row * self.columns + column) as u32);
            }
        }
    }
}
