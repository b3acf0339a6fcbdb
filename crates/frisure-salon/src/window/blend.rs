//! Moves the hair that is shown from its coarse shape to the exact one, so that it does not jump when the exact one arrives.

use std::collections::BTreeMap;
use std::sync::Arc;

use frisure_engine::{Preview, Quality, StrandsData};
use glam::Vec3;

use super::renderer::Versioned;

/// Duration of the move (s). Chosen: long enough to be seen as a motion, short enough not to be waited for.
const DURATION: f64 = 0.3;

/// Versions of hair on its way have this bit, which no version of the salon has.
const ON_ITS_WAY: u64 = 1 << 63;

/// The move from coarse to exact hair.
#[derive(Default)]
pub(super) struct Blend {
    /// The hair that was shown last.
    last: Option<Versioned<Preview>>,
    /// The move that is going on.
    current: Option<Move>,
    /// Number of pictures on the way so far.
    shown: u64,
}

struct Move {
    /// Displacement of each point of the exact hair at the beginning (m), three numbers each.
    from: Vec<f32>,
    /// Time of the beginning (s).
    begun: f64,
}

impl Blend {
    /// The hair to show at a time (s): `hair`, or hair on its way to it where `hair` is exact and follows coarse hair of the same
    /// roots.
    pub(super) fn shown(&mut self, hair: Versioned<Preview>, now: f64) -> Versioned<Preview> {
        let (exact, version) = &hair;
        if self.last.as_ref().is_none_or(|(_, last)| last != version) {
            let from = self.last.take().and_then(|(coarse, _)| displacements(&coarse, exact));
            self.current = from.map(|from| Move { from, begun: now });
            self.last = Some(hair.clone());
        }
        let Some(Move { from, begun }) = &self.current else { return hair };
        let done = (now - begun) / DURATION;
        if !(0.0..1.0).contains(&done) {
            self.current = None;
            return hair;
        }
        // A cubic that begins and ends at rest.
        let left = (1.0 - done * done * (3.0 - 2.0 * done)) as f32;
        let mut on_its_way = Preview::clone(exact);
        for (point, from) in on_its_way.strands.points.iter_mut().zip(from) {
            *point += left * from;
        }
        self.shown += 1;
        (Arc::new(on_its_way), ON_ITS_WAY | self.shown)
    }

    /// Whether the hair that was shown last is on its way.
    pub(super) fn is_moving(&self) -> bool {
        self.current.is_some()
    }
}

/// How far each point of exact hair is from its place in coarse hair (m), three numbers each; `None` where the two do not belong
/// together. Coarse hair has some of the strands only: those between move as the one of their wisp with the nearest root does.
fn displacements(coarse: &Preview, exact: &Preview) -> Option<Vec<f32>> {
    let follows = coarse.quality == Quality::Coarse && exact.quality == Quality::Exact;
    if !follows || coarse.roots != exact.roots {
        return None;
    }
    let (coarse, exact) = (Curves(&coarse.strands), Curves(&exact.strands));
    let of_exact = exact.by_wisp();
    // For each wisp its coarse strands, each with the exact strand of the same root.
    let pairs: BTreeMap<u32, Vec<(usize, usize)>> = coarse
        .by_wisp()
        .into_iter()
        .filter_map(|(wisp, strands)| {
            let candidates = of_exact.get(&wisp)?;
            let twin = |strand: usize| {
                nearest(candidates.iter().map(|&c| (c, exact.root(c))), coarse.root(strand))
            };
            Some((wisp, strands.into_iter().filter_map(|s| Some((s, twin(s)?))).collect()))
        })
        .collect();
    let mut all = vec![0.0; exact.0.points.len()];
    for (strand, wisp) in exact.0.guide.iter().enumerate() {
        let Some(pairs) = pairs.get(wisp) else { continue };
        let roots = pairs.iter().map(|&pair| (pair, coarse.root(pair.0)));
        let Some((from, twin)) = nearest(roots, exact.root(strand)) else { continue };
        let (first, end) = exact.ends(strand);
        for point in first..end {
            let part = (point - first) as f32 / (end - first).max(2).saturating_sub(1) as f32;
            let moved = coarse.at(from, part) - exact.at(twin, part);
            all[3 * point..3 * point + 3].copy_from_slice(&moved.to_array());
        }
    }
    Some(all)
}

/// What is nearest to a place.
fn nearest<T>(all: impl Iterator<Item = (T, Vec3)>, to: Vec3) -> Option<T> {
    let distance = |(_, place): &(T, Vec3)| place.distance_squared(to);
    all.min_by(|a, b| distance(a).total_cmp(&distance(b))).map(|(which, _)| which)
}

/// Strands that have at least one point each.
#[derive(Clone, Copy)]
struct Curves<'a>(&'a StrandsData);

impl Curves<'_> {
    /// The strands of each wisp, without empty ones.
    fn by_wisp(self) -> BTreeMap<u32, Vec<usize>> {
        let mut wisps = BTreeMap::<u32, Vec<usize>>::new();
        for (strand, wisp) in self.0.guide.iter().enumerate() {
            let (first, end) = self.ends(strand);
            if first < end {
                wisps.entry(*wisp).or_default().push(strand);
            }
        }
        wisps
    }

    /// First point of a strand, and the one after its last.
    fn ends(self, strand: usize) -> (usize, usize) {
        let offset = |i: usize| self.0.offsets.get(i).map_or(0, |offset| *offset as usize);
        (offset(strand), offset(strand + 1))
    }

    fn point(self, point: usize) -> Vec3 {
        self.0.points.get(3 * point..3 * point + 3).map_or(Vec3::ZERO, Vec3::from_slice)
    }

    fn root(self, strand: usize) -> Vec3 {
        self.point(self.ends(strand).0)
    }

    /// The place at a part of a strand, from 0 at its root to 1 at its tip (m).
    fn at(self, strand: usize, part: f32) -> Vec3 {
        let (first, end) = self.ends(strand);
        let place = part * end.saturating_sub(first + 1) as f32;
        let before = first + (place as usize).min(end.saturating_sub(first + 1));
        let after = (before + 1).min(end.max(first + 1) - 1);
        self.point(before).lerp(self.point(after), place.fract())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight strands of two points, two to a wisp, with their tips at a height (m).
    fn hair(quality: Quality, strands: &[(u32, f32)], tip: f32) -> Arc<Preview> {
        let points = strands.iter().flat_map(|(_, x)| [*x, 0.0, 0.0, *x, 0.0, tip]).collect();
        let offsets = (0..=strands.len() as u32).map(|i| 2 * i).collect();
        let guide = strands.iter().map(|(wisp, _)| *wisp).collect();
        let strands = StrandsData { offsets, points, guide, ..StrandsData::default() };
        Arc::new(Preview { quality, strands, roots: vec![[0.0; 3]; 2], ..Preview::default() })
    }

    #[test]
    fn exact_hair_begins_where_coarse_hair_is_and_ends_where_it_is() {
        let coarse = hair(Quality::Coarse, &[(0, 0.0), (1, 1.0)], -1.0);
        let exact = hair(Quality::Exact, &[(0, 0.0), (0, 0.1), (1, 1.0), (1, 1.1)], -2.0);
        let mut blend = Blend::default();
        assert_eq!(blend.shown((coarse.clone(), 1), 0.0), (coarse, 1));
        let tips = |shown: &Preview| -> Vec<f32> {
            shown.strands.points.chunks_exact(6).map(|strand| strand[5]).collect()
        };
        let (first, _) = blend.shown((exact.clone(), 2), 10.0);
        assert_eq!(tips(&first), [-1.0; 4]);
        assert!(blend.is_moving());
        let (half, version) = blend.shown((exact.clone(), 2), 10.0 + DURATION / 2.0);
        assert_eq!((tips(&half), version), (vec![-1.5; 4], ON_ITS_WAY | 2));
        assert_eq!(blend.shown((exact.clone(), 2), 10.0 + DURATION), (exact, 2));
        assert!(!blend.is_moving());
    }

    #[test]
    fn other_hair_is_shown_at_once() {
        let coarse = hair(Quality::Coarse, &[(0, 0.0)], -1.0);
        let mut other = Preview::clone(&hair(Quality::Exact, &[(0, 0.0)], -2.0));
        other.roots.clear();
        let mut blend = Blend::default();
        blend.shown((coarse.clone(), 1), 0.0);
        let other = Arc::new(other);
        assert_eq!(blend.shown((other.clone(), 2), 0.0), (other, 2));
        // Coarse hair does not lag behind a slider either.
        assert_eq!(blend.shown((coarse.clone(), 3), 0.0), (coarse, 3));
        assert!(!blend.is_moving());
    }

    #[test]
    fn strands_without_points_stay_where_they_are() {
        let coarse = hair(Quality::Coarse, &[(0, 0.0)], -1.0);
        let mut exact = Preview::clone(&hair(Quality::Exact, &[(0, 0.0)], -2.0));
        exact.strands.offsets = vec![0, 0, 2];
        exact.strands.guide = vec![1, 0];
        assert_eq!(displacements(&coarse, &exact), Some(vec![0.0, 0.0, 0.0, 0.0, 0.0, 1.0]));
    }
}
