//! Which points of hair are near each other, and stay the only ones that can be while guides move by some margin: neighbour lists
//! (Verlet lists).
//!
//! A search is made anew only for guides that may have moved by more than their margin; what it finds is entered with both guides.

use glam::DVec3;

use super::sieve::{LANES, Run, Sieve, SievePoint};
use crate::math::Grid;
use crate::parallel;

/// What the points of each guide are near to.
#[derive(Default)]
pub(super) struct NearLists {
    of: Vec<NearList>,
}

/// What the points of one guide are near to.
#[derive(Clone, Debug, Default)]
pub(super) struct NearList {
    /// Where the runs of each point begin; one more than points.
    starts: Vec<u32>,
    /// Guides pass each other along a piece, not at a point: runs of points take a tenth of a list of them.
    runs: Vec<Run>,
    /// The guides among them, in order.
    guides: Vec<u32>,
}

impl NearLists {
    /// Finds anew what is near the points of guides that are looked at again; `points` has those of all guides, one guide after the
    /// other.
    pub(super) fn update(&mut self, points: &[SearchPoint], again: &[bool]) {
        // Old lists go before new ones are made: both are the largest part of the memory.
        for (near, _) in self.of.iter_mut().zip(again).filter(|(_, again)| **again) {
            *near = NearList::default();
        }
        let levels = GridLevel::sort(points);
        let own: Vec<&[SearchPoint]> = points.chunk_by(|a, b| a.guide == b.guide).collect();
        let found: Vec<Option<NearList>> = parallel::map_slice(&own, |own| {
            again[own[0].guide as usize].then(|| NearList::search(own, &levels))
        });
        // What is near belongs to both guides: what a search found is entered with those that were not searched, too. So the
        // energy of a pair is the same from either side.
        let mut met: Vec<Vec<Met>> = vec![Vec::new(); found.len()];
        for (guide, near) in found.iter().enumerate() {
            for (k, run) in near.iter().flat_map(NearList::iter) {
                if !again[run.guide as usize] {
                    met[run.guide as usize].push((Run { guide: guide as u32, ..*run }, k));
                }
            }
        }
        self.of.resize_with(found.len(), NearList::default);
        let mut kept: Vec<_> = self.of.iter_mut().zip(found).collect();
        parallel::for_each_mut(&mut kept, |i, (near, found)| {
            **near =
                (found.take()).unwrap_or_else(|| std::mem::take(*near).amended(&met[i], again));
        });
    }

    /// Guides in groups of which no two are near each other, taken in the given order.
    pub(super) fn groups(&self, order: &[usize]) -> Vec<Vec<usize>> {
        self.coloured(order, |guide, taken| taken.extend(self.of_guide(guide).guides()))
    }

    /// Guides in groups of which no two are near each other, or near the same guide, taken in the given order.
    pub(super) fn groups_apart(&self, order: &[usize]) -> Vec<Vec<usize>> {
        self.coloured(order, |guide, taken| {
            for near in self.of_guide(guide).guides() {
                taken.push(near);
                taken.extend(self.of_guide(near).guides());
            }
        })
    }

    /// Greedy colouring, in the given order: each guide is in the first group that has none of those that `apart` finds.
    fn coloured(&self, order: &[usize], apart: impl Fn(usize, &mut Vec<usize>)) -> Vec<Vec<usize>> {
        const NONE: usize = usize::MAX;
        let mut group = vec![NONE; self.of.len()];
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let mut others = Vec::new();
        for &guide in order {
            others.clear();
            apart(guide, &mut others);
            let mut taken = vec![false; groups.len()];
            others.iter().filter(|&&g| group[g] != NONE).for_each(|&g| taken[group[g]] = true);
            let free = taken.iter().position(|taken| !taken).unwrap_or(groups.len());
            if free == groups.len() {
                groups.push(Vec::new());
            }
            group[guide] = free;
            groups[free].push(guide);
        }
        groups
    }

    /// What may be near a guide's points.
    pub(super) fn of_guide(&self, guide: usize) -> &NearList {
        &self.of[guide]
    }
}

/// Own points, with another guide that each of them is near to, and which point of that one.
type Met = (Run, u32);

/// A point of a guide while neighbours are looked for.
#[derive(Clone, Copy)]
pub(super) struct SearchPoint {
    pub(super) position: DVec3,
    /// Radius and margin (m): two points are near each other if they are not farther apart than the sum of these.
    pub(super) reach: f64,
    pub(super) guide: u32,
    /// Which point of the guide.
    pub(super) index: u32,
}

/// Points of about the same reach, so that a few that reach far do not make all searches wide.
struct GridLevel {
    /// The largest of them (m).
    reach: f64,
    grid: Grid,
    /// In the order of the grid.
    points: Vec<SearchPoint>,
    /// The same, as if they were those of one guide.
    sieve: Sieve,
}

/// Levels, each for half the reach of the one before; the last for all that is less. No result depends on it.
const LEVELS: usize = 3;

impl GridLevel {
    fn sort(points: &[SearchPoint]) -> Vec<Self> {
        let most = points.iter().map(|p| p.reach).fold(0.0, f64::max);
        let mut levels = vec![Vec::new(); LEVELS];
        for p in points {
            // The bound (m) keeps the ratio finite; the cast takes the whole part.
            let halvings = (most / p.reach.max(1e-9)).log2() as usize;
            levels[halvings.min(LEVELS - 1)].push(*p);
        }
        levels.into_iter().filter(|points| !points.is_empty()).map(Self::new).collect()
    }

    fn new(points: Vec<SearchPoint>) -> Self {
        let reach = points.iter().map(|p| p.reach).fold(0.0, f64::max);
        let positions: Vec<DVec3> = points.iter().map(|p| p.position).collect();
        let grid = Grid::new(&positions, 2.0 * reach);
        let points: Vec<SearchPoint> = grid.order().iter().map(|&i| points[i as usize]).collect();
        let (positions, reaches): (Vec<DVec3>, Vec<f64>) =
            points.iter().map(|p| (p.position, p.reach)).unzip();
        let sieve = Sieve::new(std::iter::once((&positions[..], &reaches[..])));
        Self { reach, grid, points, sieve }
    }

    /// Calls `found` with those within reach of a point, and a few that hardly are not; `rows` is a place for runs.
    fn for_each_near(
        &self,
        p: &SearchPoint,
        rows: &mut Vec<Run>,
        mut found: impl FnMut(&SearchPoint),
    ) {
        rows.clear();
        for row in self.grid.rows_within(p.position, p.reach + self.reach) {
            rows.extend(Run::of_guide(0, row));
        }
        let own = SievePoint::new(p.position, p.reach);
        self.sieve.for_each_close(own, rows, |_, i| found(&self.points[i]));
    }
}

/// Guide and point of what each of a guide's points is near to, in the order of `met`: where those of each point begin, and all.
fn by_point(met: &[Met], points: usize) -> (Vec<usize>, Vec<(u32, u32)>) {
    // Counting sort: there are many for each point.
    let mut starts = vec![0; points + 1];
    let own = |run: &Run| run.first as usize..run.end as usize;
    for k in met.iter().flat_map(|(run, _)| own(run)) {
        starts[k + 1] += 1;
    }
    for k in 0..points {
        starts[k + 1] += starts[k];
    }
    let mut next = starts.clone();
    let mut touches = vec![(0, 0); starts[points]];
    for (run, point) in met {
        for k in own(run) {
            touches[next[k]] = (run.guide, *point);
            next[k] += 1;
        }
    }
    (starts, touches)
}

impl NearList {
    /// What the points `own` of one guide are near to.
    fn search(own: &[SearchPoint], levels: &[GridLevel]) -> Self {
        let mut near = Self::default();
        let mut rows = Vec::new();
        for p in own {
            near.begin_point();
            for level in levels {
                level.for_each_near(p, &mut rows, |q| {
                    let reach = p.reach + q.reach;
                    // Radii and margins of both: neither can come to touch the other before its margin is used up.
                    let is_near = q.position.distance_squared(p.position) < reach * reach;
                    if is_near && q.guide != p.guide {
                        near.add(Run { guide: q.guide, first: q.index, end: q.index + 1 });
                    }
                });
            }
        }
        near.finish()
    }

    /// What is added from now on is near the next point.
    fn begin_point(&mut self) {
        self.starts.push(self.runs.len() as u32);
    }

    /// Adds to what the last point is near to.
    fn add(&mut self, run: Run) {
        let begins = self.starts.last().is_none_or(|&start| self.runs.len() == start as usize);
        match self.runs.last_mut() {
            Some(last)
                if !begins
                    && last.guide == run.guide
                    && last.end == run.first
                    && (run.end - last.first) as usize <= LANES =>
            {
                last.end = run.end;
            }
            _ => self.runs.push(run),
        }
    }

    fn finish(mut self) -> Self {
        self.begin_point();
        self.runs.shrink_to_fit();
        let count = self.runs.iter().map(|run| run.guide as usize + 1).max().unwrap_or(0);
        let mut touched = vec![false; count];
        for run in &self.runs {
            touched[run.guide as usize] = true;
        }
        self.guides = (0..count as u32).filter(|&guide| touched[guide as usize]).collect();
        self.guides.shrink_to_fit();
        self
    }

    /// The guides among them, in order.
    pub(super) fn guides(&self) -> impl Iterator<Item = usize> {
        self.guides.iter().map(|&guide| guide as usize)
    }

    pub(super) fn points(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// What point `k` is near to; the order is that of the sums over it.
    pub(super) fn of_point(&self, k: usize) -> &[Run] {
        &self.runs[self.starts[k] as usize..self.starts[k + 1] as usize]
    }

    /// Each point with what it is near to.
    pub(super) fn iter(&self) -> impl Iterator<Item = (u32, &Run)> {
        (0..self.points()).flat_map(|k| self.of_point(k).iter().map(move |run| (k as u32, run)))
    }

    /// The same, but for what is near of those guides that were looked at again.
    fn amended(self, met: &[Met], again: &[bool]) -> Self {
        if met.is_empty() && !self.guides.iter().any(|&g| again[g as usize]) {
            return self;
        }
        let (starts, met) = by_point(met, self.points());
        let mut near = Self::default();
        for k in 0..self.points() {
            near.begin_point();
            let stays = self.of_point(k).iter().filter(|run| !again[run.guide as usize]);
            stays.for_each(|run| near.add(*run));
            for &(guide, point) in &met[starts[k]..starts[k + 1]] {
                near.add(Run { guide, first: point, end: point + 1 });
            }
        }
        near.finish()
    }
}
