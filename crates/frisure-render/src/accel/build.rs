//! Building a hierarchy: binned surface-area heuristic, eight children at a time.
//!
//! A range of things is split in two where (area × number of leaves) is least, the larger part again,
//! until there are eight: a node. Sorting is in place and its order depends on nothing but the input;
//! large nodes build their children in parallel and line them up in order, so that the tree is the
//! same on any number of threads.

use glam::Vec3A;
use rayon::prelude::*;

use super::bounds::Bounds;
use super::hierarchy::{Child, Leaf, Node};
use super::simd::{LANES, Lanes};

/// A thing to be sorted in: its box and its index.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(16))]
pub(super) struct Primitive {
    low: [f32; 3],
    index: u32,
    high: [f32; 3],
}

impl Primitive {
    pub(super) fn new(bounds: Bounds, index: u32) -> Self {
        Self { low: bounds.low.to_array(), index, high: bounds.high.to_array() }
    }

    #[inline]
    pub(super) fn bounds(&self) -> Bounds {
        Bounds { low: Vec3A::from(self.low), high: Vec3A::from(self.high) }
    }

    pub(super) fn index(&self) -> usize {
        self.index as usize
    }

    /// Twice the middle of the box.
    #[inline]
    fn middle(&self) -> Vec3A {
        Vec3A::from(self.low) + Vec3A::from(self.high)
    }
}

/// Nodes (the root first) and leaves.
pub(super) struct Tree<L> {
    pub(super) nodes: Vec<Node>,
    pub(super) leaves: Vec<L>,
}

/// Levels that are split where it is best; below, ranges are halved, so that the depth is bounded
/// whatever the input.
const FREE_LEVELS: usize = 18;

/// Levels of nodes at most: 2³¹ things, eight to a leaf, are halved 28 times, thrice a level.
pub(super) const DEEPEST: usize = FREE_LEVELS + 10;

/// Things in a node from which its children are built in parallel.
const PARALLEL: usize = 1 << 17;

/// Things that are put in bins at once, in parallel with others.
const CHUNK: usize = 1 << 14;

/// Bins per axis: rays are 7 % faster than with 16.
const BINS: usize = 32;

struct Builder<'a, L: Leaf> {
    things: &'a L::Things,
    pad: f32,
}

/// Sorts things into a tree, boxes grown by `pad`.
pub(super) fn tree<L: Leaf>(things: &L::Things, primitives: &mut [Primitive], pad: f32) -> Tree<L> {
    let mut tree = Tree { nodes: Vec::new(), leaves: Vec::new() };
    if !primitives.is_empty() {
        Builder { things, pad }.node(primitives, 0, &mut tree);
    }
    tree
}

impl<L: Leaf> Builder<'_, L> {
    /// Appends the node over `primitives` and everything below it.
    fn node(&self, primitives: &mut [Primitive], level: usize, tree: &mut Tree<L>) {
        let wide = primitives.len() > PARALLEL;
        let parts = eight(primitives, level >= FREE_LEVELS);
        let index = tree.nodes.len();
        let mut node = Node {
            low: [Lanes([f32::INFINITY; LANES]); 3],
            high: [Lanes([f32::NEG_INFINITY; LANES]); 3],
            child: [Child::NONE; LANES],
        };
        for (lane, part) in parts.iter().enumerate() {
            let bounds = part.bounds.grown(self.pad);
            for axis in 0..3 {
                node.low[axis].0[lane] = bounds.low[axis];
                node.high[axis].0[lane] = bounds.high[axis];
            }
        }
        tree.nodes.push(node);
        if wide {
            self.children_in_parallel(parts, level, index, tree);
        } else {
            for (lane, part) in parts.into_iter().enumerate() {
                tree.nodes[index].child[lane] = self.child(part, level + 1, tree);
            }
        }
    }

    fn child(&self, part: Part<'_>, level: usize, tree: &mut Tree<L>) -> Child {
        if part.things.len() <= LANES {
            tree.leaves.push(L::new(self.things, part.things));
            return Child::leaf(tree.leaves.len() - 1);
        }
        let index = tree.nodes.len();
        self.node(part.things, level, tree);
        Child::node(index)
    }

    fn children_in_parallel(
        &self,
        parts: Vec<Part<'_>>,
        level: usize,
        index: usize,
        tree: &mut Tree<L>,
    ) {
        let children: Vec<(Child, Tree<L>)> = parts
            .into_par_iter()
            .map(|part| {
                let mut tree = Tree { nodes: Vec::new(), leaves: Vec::new() };
                (self.child(part, level + 1, &mut tree), tree)
            })
            .collect();
        for (lane, (child, below)) in children.into_iter().enumerate() {
            let (nodes, leaves) = (tree.nodes.len(), tree.leaves.len());
            tree.nodes[index].child[lane] = child.behind(nodes, leaves);
            tree.nodes.extend(below.nodes.into_iter().map(|mut node| {
                node.child = node.child.map(|child| child.behind(nodes, leaves));
                node
            }));
            tree.leaves.extend(below.leaves);
        }
    }
}

/// A range of things, and the box around them.
struct Part<'a> {
    things: &'a mut [Primitive],
    bounds: Bounds,
}

impl<'a> Part<'a> {
    fn new(things: &'a mut [Primitive]) -> Self {
        let bounds = things.iter().fold(Bounds::EMPTY, |b, p| b.union(p.bounds()));
        Self { things, bounds }
    }

    /// How much there is to win by splitting it.
    fn size(&self, halve: bool) -> f32 {
        if self.things.len() <= LANES {
            return f32::NEG_INFINITY;
        }
        if halve { self.things.len() as f32 } else { self.bounds.half_area() }
    }
}

/// Splits things into at most eight parts.
fn eight(primitives: &mut [Primitive], halve: bool) -> Vec<Part<'_>> {
    let mut parts = Vec::with_capacity(LANES);
    parts.push(Part::new(primitives));
    while parts.len() < LANES {
        let sizes = parts.iter().map(|part| part.size(halve)).enumerate();
        let Some((largest, size)) = sizes.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
        if size == f32::NEG_INFINITY {
            break;
        }
        let Part { things, .. } = parts.swap_remove(largest);
        let at = if halve { None } else { best_split(things) };
        let at = at.unwrap_or(things.len() / 2);
        let (left, right) = things.split_at_mut(at);
        parts.push(Part::new(left));
        parts.push(Part::new(right));
    }
    parts
}

/// Things whose middles lie in the same slice of the box of all middles.
#[derive(Clone, Copy)]
struct Bin {
    count: usize,
    bounds: Bounds,
}

type Bins = [[Bin; BINS]; 3];

const NO_BINS: Bins = [[Bin { count: 0, bounds: Bounds::EMPTY }; BINS]; 3];

impl Bin {
    fn and(self, other: Self) -> Self {
        Self { count: self.count + other.count, bounds: self.bounds.union(other.bounds) }
    }

    /// Expected work in it: leaves are tested eight things at a time.
    fn cost(&self) -> f32 {
        self.bounds.half_area() * self.count.div_ceil(LANES) as f32
    }
}

/// How middles fall into bins.
#[derive(Clone, Copy)]
struct Grid {
    low: Vec3A,
    scale: Vec3A,
}

impl Grid {
    #[inline]
    fn bins_of(&self, primitive: &Primitive) -> [usize; 3] {
        let x = (primitive.middle() - self.low) * self.scale;
        // The cast saturates at 0.
        x.to_array().map(|x| (x as usize).min(BINS - 1))
    }
}

/// Sorts things into the two sides of the best split found, and says where the second begins; `None`
/// if all middles coincide.
fn best_split(things: &mut [Primitive]) -> Option<usize> {
    let grid = grid(things)?;
    let bins = if things.len() > 2 * CHUNK {
        let chunks = things.par_chunks(CHUNK).map(|chunk| fill(chunk, &grid));
        chunks.reduce(|| NO_BINS, merge)
    } else {
        fill(things, &grid)
    };
    let (axis, bin) = cheapest(&bins)?;
    Some(partition(things, |p| grid.bins_of(p)[axis] < bin))
}

fn grid(things: &[Primitive]) -> Option<Grid> {
    let first = things.first()?.middle();
    let (low, high) = things.iter().fold((first, first), |(low, high), p| {
        let middle = p.middle();
        (low.min(middle), high.max(middle))
    });
    let extent = high - low;
    // An axis without extent has one bin.
    let scale = extent.to_array().map(|e| if e > 0.0 { 0.9999 * BINS as f32 / e } else { 0.0 });
    let scale = Vec3A::from(scale);
    (extent.max_element() > 0.0 && scale.is_finite()).then_some(Grid { low, scale })
}

fn fill(things: &[Primitive], grid: &Grid) -> Bins {
    let mut bins = NO_BINS;
    for thing in things {
        let bounds = thing.bounds();
        for (axis, bin) in grid.bins_of(thing).into_iter().enumerate() {
            let bin = &mut bins[axis][bin];
            bin.count += 1;
            bin.bounds = bin.bounds.union(bounds);
        }
    }
    bins
}

/// Counts, minima and maxima: the order of merging does not matter.
fn merge(mut a: Bins, b: Bins) -> Bins {
    for (a, b) in a.iter_mut().flatten().zip(b.into_iter().flatten()) {
        *a = a.and(b);
    }
    a
}

/// Axis and first bin of the second side of the cheapest split with something on both sides.
fn cheapest(bins: &Bins) -> Option<(usize, usize)> {
    let mut best = None;
    let mut least = f32::INFINITY;
    for (axis, bins) in bins.iter().enumerate() {
        let mut right = [bins[BINS - 1]; BINS];
        for i in (0..BINS - 1).rev() {
            right[i] = bins[i].and(right[i + 1]);
        }
        let mut left = bins[0];
        for i in 1..BINS {
            let cost = left.cost() + right[i].cost();
            if left.count > 0 && right[i].count > 0 && cost < least {
                (least, best) = (cost, Some((axis, i)));
            }
            left = left.and(bins[i]);
        }
    }
    best
}

/// Moves things that are `first` before the others, and says how many they are.
fn partition(things: &mut [Primitive], first: impl Fn(&Primitive) -> bool) -> usize {
    let (mut begin, mut end) = (0, things.len());
    loop {
        while begin < end && first(&things[begin]) {
            begin += 1;
        }
        while begin < end && !first(&things[end - 1]) {
            end -= 1;
        }
        if begin >= end {
            return begin;
        }
        things.swap(begin, end - 1);
    }
}
