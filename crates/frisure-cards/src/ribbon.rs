//! A strip along a cluster of strands, that turns with them.

use frisure_strands::Strands;
use glam::{Vec2, Vec3};

/// Stations along a cluster, before those that are not needed are left out: as many as the longest strand has points, within
/// these bounds. Fewer than the points of a tight curl would draw another curl.
const STATIONS: std::ops::RangeInclusive<usize> = 32..=160;

/// Weight of the direction across the outward one against the spread of the strands: a lock that is as thick as it is wide
/// lies on the head. Chosen.
const OUTWARD: f32 = 0.35;

/// Part of a strip, to each side, over which its direction is averaged: a twist that no lock follows is noise.
const SMOOTH: f32 = 0.1;

/// Largest part of the radius at which a strip bends to a side that half of its width may be: from 1 on its inner edge goes
/// backwards, and the strip folds. Chosen.
const MOST_BENT: f32 = 0.7;

/// Factor on the length over which the middle of a strip is averaged, from one try to the next.
const SMOOTHER: f32 = 1.5;

/// Part of the strands that a strip is as wide as; what is beyond is cut off.
const WITHIN: f32 = 0.97;

/// Largest turn of a strip between two stations of its mesh (rad). Chosen.
const MOST_TURN: f32 = 1.0;

/// Least half of the width of a strip (m).
const NARROWEST: f32 = 5e-4;

/// A place along a strip.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Station {
    /// Middle (m).
    pub(crate) middle: Vec3,
    /// Unit vector along the hair.
    pub(crate) along: Vec3,
    /// Unit vector to the strip's right, seen from outside with the root above.
    pub(crate) across: Vec3,
    /// Half the width (m).
    pub(crate) half: f32,
    /// Distance from the root along the middle (m).
    pub(crate) distance: f32,
}

impl Station {
    /// The side that is seen from outside.
    pub(crate) fn normal(&self) -> Vec3 {
        self.along.cross(self.across)
    }

    /// Both edges (m).
    pub(crate) fn edges(&self) -> [Vec3; 2] {
        [-1.0, 1.0].map(|side| self.middle + side * self.half * self.across)
    }
}

/// Which way a strip lies in its cluster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Side {
    /// Along the width of the strands.
    Wide,
    /// Along their thickness, across the other.
    Thick,
}

/// The strip of a cluster.
pub(crate) struct Ribbon {
    /// Places from root to tip, one for each point of the even strands, and perhaps one beyond.
    pub(crate) stations: Vec<Station>,
    /// Those that the mesh has, rising: the first and the last are among them.
    pub(crate) kept: Vec<usize>,
    /// Whether it runs along the axis of a curl instead of following it.
    pub(crate) along_axis: bool,
}

/// Strands with as many points each.
pub(crate) struct Even {
    strands: Strands,
    /// Points of each strand.
    pub(crate) stations: usize,
}

impl Even {
    pub(crate) fn new(strands: &Strands) -> Self {
        let longest = strands.iter().map(|strand| strand.points.len()).max().unwrap_or(0);
        let stations = longest.clamp(*STATIONS.start(), *STATIONS.end());
        Self { strands: strands.resampled(stations).strands, stations }
    }

    /// Points of a strand, from root to tip (m), and its radii (m).
    pub(crate) fn line(&self, row: usize) -> (&[Vec3], &[f32]) {
        let strand = self.strands.strand(row);
        (strand.points, strand.radii)
    }
}

impl Ribbon {
    /// The strip along some strands; `outward` is the direction away from the head at a place, and the mesh is within
    /// `tolerance` (m) of the strip.
    pub(crate) fn new(
        even: &Even,
        rows: &[usize],
        outward: impl Fn(Vec3) -> Vec3,
        side: Side,
        tolerance: f32,
    ) -> Self {
        let count = even.stations;
        let mean = |k: usize| {
            rows.iter().map(|&row| even.line(row).0[k]).sum::<Vec3>() / rows.len() as f32
        };
        let means: Vec<Vec3> = (0..count).map(mean).collect();
        let mut stations = along(even, rows, &means, &outward, side);
        // A strip that cannot follow the curl of its strands runs along the axis of the curl, which is drawn on it.
        let mut over = 1.0;
        while bent(&stations) > MOST_BENT && over < count as f32 {
            stations = along(even, rows, &smoothed(&means, over), &outward, side);
            over *= SMOOTHER;
        }
        stations.extend(beyond(even, rows, &stations[count - 1]));
        let kept = needed(&stations, tolerance);
        Self { stations, kept, along_axis: over > 1.0 }
    }

    /// How thick the strands lie over how wide they do: 0 for a flat lock, 1 for a round one.
    pub(crate) fn roundness(&self, even: &Even, rows: &[usize]) -> f32 {
        let (mut thick, mut wide) = (0.0, 0.0);
        for &row in rows {
            for (p, station) in even.line(row).0.iter().zip(&self.stations) {
                let d = *p - station.middle;
                thick += d.dot(station.normal()).powi(2);
                wide += d.dot(station.across).powi(2);
            }
        }
        (thick / f32::max(wide, f32::MIN_POSITIVE)).sqrt()
    }

    /// Length along the middle (m).
    pub(crate) fn length(&self) -> f32 {
        self.stations.last().map_or(0.0, |s| s.distance)
    }

    /// Largest width (m).
    pub(crate) fn width(&self) -> f32 {
        2.0 * self.stations.iter().map(|s| s.half).fold(0.0, f32::max)
    }

    /// Where point `k` of a strand lies in the strip: across (−1 and 1 are the edges), along (m), and out of it (m).
    pub(crate) fn place(&self, k: usize, p: Vec3) -> Vec3 {
        let station = &self.stations[k];
        let d = p - station.middle;
        let along = (station.distance + d.dot(station.along)).clamp(0.0, self.length());
        let across = d.dot(station.across) / self.half(along);
        Vec3::new(across, along, d.dot(station.normal()))
    }

    /// Half the width of the mesh at a distance along it (m): between the stations that it keeps it is linear.
    pub(crate) fn half(&self, along: f32) -> f32 {
        let at = |i: usize| &self.stations[self.kept[i]];
        let inner = &self.kept[1..self.kept.len() - 1];
        let next = 1 + inner.partition_point(|&i| self.stations[i].distance < along);
        let (a, b) = (at(next - 1), at(next));
        let span = b.distance - a.distance;
        let t = if span > 0.0 { ((along - a.distance) / span).clamp(0.0, 1.0) } else { 0.0 };
        a.half + t * (b.half - a.half)
    }
}

/// The stations of a strip whose middle goes through these places (m).
fn along(
    even: &Even,
    rows: &[usize],
    middles: &[Vec3],
    outward: impl Fn(Vec3) -> Vec3,
    side: Side,
) -> Vec<Station> {
    let along = tangents(middles);
    let mut across = directions(even, rows, middles, &along, outward);
    if side == Side::Thick {
        across.iter_mut().zip(&along).for_each(|(across, along)| *across = along.cross(*across));
    }
    let count = middles.len();
    let widths: Vec<f32> =
        (0..count).map(|k| width(even, rows, k, middles[k], across[k])).collect();
    let mut distance = 0.0;
    (0..count)
        .map(|k| {
            distance += if k > 0 { middles[k].distance(middles[k - 1]) } else { 0.0 };
            let near = widths[k.saturating_sub(1)..(k + 2).min(count)].iter().copied();
            // As wide as the widest beside it: a mean would cut off hair.
            let half = near.fold(NARROWEST, f32::max);
            Station { middle: middles[k], along: along[k], across: across[k], half, distance }
        })
        .collect()
}

/// A line averaged over `over` points (the deviation of a Gaussian) that keeps its ends: beyond them it goes on as its image in
/// the end.
fn smoothed(line: &[Vec3], over: f32) -> Vec<Vec3> {
    let last = line.len() as isize - 1;
    let at = |k: isize| -> Vec3 {
        let inside = |k: isize| line[k.clamp(0, last) as usize];
        match k {
            k if k < 0 => 2.0 * line[0] - inside(-k),
            k if k > last => 2.0 * line[last as usize] - inside(2 * last - k),
            k => inside(k),
        }
    };
    // Beyond three deviations there is nothing.
    let reach = (3.0 * over).ceil() as isize;
    let weight = |d: isize| (-0.5 * (d as f32 / over).powi(2)).exp();
    let total: f32 = (-reach..=reach).map(weight).sum();
    (0..=last)
        .map(|k| (-reach..=reach).map(|d| weight(d) * at(k + d)).sum::<Vec3>() / total)
        .collect()
}

/// The largest half of a width over the radius at which the strip bends to that side there.
fn bent(stations: &[Station]) -> f32 {
    let bent = |pair: &[Station]| {
        let (a, b) = (&pair[0], &pair[1]);
        let turn = (b.along - a.along).dot((a.across + b.across).normalize_or_zero()).abs();
        turn * a.half.max(b.half) / (b.distance - a.distance).max(1e-9)
    };
    stations.windows(2).map(bent).fold(0.0, f32::max)
}

fn tangents(line: &[Vec3]) -> Vec<Vec3> {
    let last = line.len() - 1;
    let tangent = |k: usize| line[(k + 1).min(last)] - line[k.saturating_sub(1)];
    (0..=last).map(|k| tangent(k).normalize_or(Vec3::NEG_Z)).collect()
}

/// The direction of largest spread at each station, as smooth along the strip as the spread is sure.
fn directions(
    even: &Even,
    rows: &[usize],
    middles: &[Vec3],
    along: &[Vec3],
    outward: impl Fn(Vec3) -> Vec3,
) -> Vec<Vec3> {
    let bases = transported(along);
    // A line's direction as twice its angle in the moving basis: opposite directions are the same line.
    let axis = |k: usize| {
        let [e1, e2] = bases[k];
        let mut spread = Vec2::ZERO;
        let mut size = 0.0;
        for &row in rows {
            let d = even.line(row).0[k] - middles[k];
            let (x, y) = (d.dot(e1), d.dot(e2));
            spread += Vec2::new(x * x - y * y, 2.0 * x * y);
            size += x * x + y * y;
        }
        let out = outward(middles[k]);
        let out = Vec2::new(out.dot(e1), out.dot(e2));
        // A quarter turn of the line is half a turn of twice its angle.
        let lies = -Vec2::new(out.x * out.x - out.y * out.y, 2.0 * out.x * out.y);
        spread + OUTWARD * size.max(1e-12) * lies
    };
    let axes: Vec<Vec2> = (0..along.len()).map(axis).collect();
    let reach = (SMOOTH * along.len() as f32).round() as usize;
    let mut found = Vec::with_capacity(along.len());
    let mut before = Vec3::ZERO;
    let mut outside = 0.0;
    for k in 0..along.len() {
        let near = k.saturating_sub(reach)..(k + reach + 1).min(along.len());
        let sum: Vec2 = axes[near].iter().map(|a| a.normalize_or_zero() * a.length().sqrt()).sum();
        let angle = 0.5 * sum.y.atan2(sum.x);
        let [e1, e2] = bases[k];
        let across = angle.cos() * e1 + angle.sin() * e2;
        let across = if across.dot(before) < 0.0 { -across } else { across };
        before = across;
        outside += along[k].cross(across).dot(outward(middles[k]));
        found.push(across);
    }
    if outside < 0.0 {
        found.iter_mut().for_each(|across| *across = -*across);
    }
    found
}

/// Two unit vectors across each tangent that turn as little as possible ([Bergou et al. 2008], "Discrete Elastic Rods").
fn transported(along: &[Vec3]) -> Vec<[Vec3; 2]> {
    let mut e1 = along[0].any_orthonormal_vector();
    let basis = |&t: &Vec3| {
        e1 = (e1 - e1.dot(t) * t).normalize_or(t.any_orthonormal_vector());
        [e1, t.cross(e1)]
    };
    along.iter().map(basis).collect()
}

/// Half of the width that holds most strands (m).
fn width(even: &Even, rows: &[usize], k: usize, middle: Vec3, across: Vec3) -> f32 {
    let mut all: Vec<f32> = rows
        .iter()
        .map(|&row| {
            let (points, radii) = even.line(row);
            (points[k] - middle).dot(across).abs() + radii[k]
        })
        .collect();
    let at = ((all.len() - 1) as f32 * WITHIN).ceil() as usize;
    *all.select_nth_unstable_by(at, f32::total_cmp).1
}

/// A station beyond the mean of the tips, for the strands that are longer.
fn beyond(even: &Even, rows: &[usize], tip: &Station) -> Option<Station> {
    let mut all: Vec<f32> = rows
        .iter()
        .map(|&row| (even.line(row).0[even.stations - 1] - tip.middle).dot(tip.along))
        .collect();
    let at = ((all.len() - 1) as f32 * WITHIN) as usize;
    let more = *all.select_nth_unstable_by(at, f32::total_cmp).1;
    let middle = tip.middle + more * tip.along;
    (more > 1e-3).then_some(Station { middle, distance: tip.distance + more, ..*tip })
}

/// The stations without which an edge would be more than `tolerance` (m) away, or the strip would turn by more than
/// [`MOST_TURN`] between two: its edges would cross.
fn needed(stations: &[Station], tolerance: f32) -> Vec<usize> {
    let edges: Vec<[Vec3; 2]> = stations.iter().map(Station::edges).collect();
    let mut kept = vec![0, stations.len() - 1];
    let mut open = vec![(0, stations.len() - 1)];
    while let Some((from, to)) = open.pop() {
        let apart = |i: usize| {
            let side = |k: usize| to_segment(edges[i][k], edges[from][k], edges[to][k]);
            side(0).max(side(1))
        };
        let all = (from + 1..to).map(|i| (apart(i), i));
        let (error, at) =
            all.fold((0.0, from), |best, next| if next.0 > best.0 { next } else { best });
        let turned = stations[from].across.dot(stations[to].across) < MOST_TURN.cos();
        let at = match error > tolerance {
            true => at,
            false if turned && to - from > 1 => (from + to) / 2,
            false => continue,
        };
        kept.push(at);
        open.extend([(from, at), (at, to)]);
    }
    kept.sort_unstable();
    kept
}

fn to_segment(p: Vec3, a: Vec3, b: Vec3) -> f32 {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    let t = if t.is_finite() { t.clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat lock, 10 mm wide and 2 mm thick, that turns by `turn` (rad) from root to tip.
    fn lock(turn: f32) -> Even {
        let mut strands = Strands::new();
        for i in 0..60 {
            let (x, y) = (1e-3 * (i % 11) as f32 - 5e-3, 1e-3 * (i / 11) as f32 * 0.4 - 1e-3);
            let line: Vec<Vec3> = (0..20)
                .map(|k| {
                    let t = k as f32 / 19.0;
                    let (s, c) = (turn * t).sin_cos();
                    Vec3::new(c * x - s * y, s * x + c * y, -0.15 * t)
                })
                .collect();
            strands.push(&line, &[5e-5; 20]);
        }
        Even::new(&strands)
    }

    fn ribbon(turn: f32, tolerance: f32) -> Ribbon {
        let rows: Vec<usize> = (0..60).collect();
        Ribbon::new(&lock(turn), &rows, |_| Vec3::Y, Side::Wide, tolerance)
    }

    #[test]
    fn a_strip_lies_along_the_width_of_its_lock() {
        let ribbon = ribbon(0.0, 1e-4);
        for station in &ribbon.stations {
            assert!(station.across.x.abs() > 0.99, "{station:?}");
            // The side that looks outward.
            assert!(station.normal().y > 0.99);
            assert!((station.half - 5e-3).abs() < 6e-4, "{}", station.half);
        }
        // A straight strip of one width needs only its ends.
        assert_eq!(ribbon.kept.len(), 2);
        assert!((ribbon.length() - 0.15).abs() < 1e-3);
    }

    #[test]
    fn a_strip_turns_with_its_lock() {
        let ribbon = ribbon(1.5, 5e-4);
        let (first, last) = (ribbon.stations[0], ribbon.stations[31]);
        let turned = first.across.dot(last.across).abs().acos();
        assert!((turned - 1.5).abs() < 0.35, "{turned}");
        // No station is turned around against its neighbour.
        assert!(ribbon.stations.windows(2).all(|pair| pair[0].across.dot(pair[1].across) > 0.9));
        assert!(ribbon.kept.len() > 2);
    }

    /// A lock of coils in step, `wide` and `thick` (m), about a straight axis.
    fn coils(radius: f32, wide: f32, thick: f32) -> Even {
        let mut strands = Strands::new();
        for i in 0..64 {
            let place = |i: u8, size: f32| size * (f32::from(i) / 7.0 - 0.5);
            let root = Vec3::new(place(i % 8, wide), place(i / 8, thick), 0.0);
            let line: Vec<Vec3> = (0..120)
                .map(|k| {
                    let (s, c) = (0.7 * k as f32).sin_cos();
                    root + Vec3::new(radius * c, radius * s, -1e-3 * k as f32)
                })
                .collect();
            strands.push(&line, &[5e-5; 120]);
        }
        Even::new(&strands)
    }

    #[test]
    fn a_strip_that_is_wider_than_its_curl_runs_along_the_axis() {
        let rows: Vec<usize> = (0..64).collect();
        let new = |even: &Even, side| Ribbon::new(even, &rows, |_| Vec3::Y, side, 1e-3);
        for side in [Side::Wide, Side::Thick] {
            let ribbon = new(&coils(2e-3, 8e-3, 4e-3), side);
            assert!(ribbon.along_axis && bent(&ribbon.stations) <= MOST_BENT);
            // The axis of 12 cm and not the curl of 20 cm, and wide enough for the coils: the middle 97 % of them.
            assert!((ribbon.length() - 0.119).abs() < 4e-3, "{}", ribbon.length());
            let half = if side == Side::Wide { 4e-3 } else { 2e-3 };
            let widest = ribbon.stations.iter().map(|s| s.half).fold(0.0, f32::max);
            assert!((half..half + 2.6e-3).contains(&widest), "{widest}");
        }
        // A narrow strip follows a wide curl.
        assert!(!new(&coils(2e-2, 2e-3, 1e-3), Side::Wide).along_axis);
    }

    #[test]
    fn a_second_strip_lies_across_the_first() {
        let rows: Vec<usize> = (0..64).collect();
        let new = |even: &Even, side| Ribbon::new(even, &rows, |_| Vec3::Y, side, 1e-3);
        let (flat, round) = (coils(0.0, 8e-3, 1e-3), coils(0.0, 4e-3, 4e-3));
        let wide = new(&flat, Side::Wide);
        assert!((wide.roundness(&flat, &rows) - 0.125).abs() < 0.01);
        assert!(new(&round, Side::Wide).roundness(&round, &rows) > 0.9);
        let thick = new(&flat, Side::Thick);
        for (a, b) in wide.stations.iter().zip(&thick.stations) {
            assert!(a.across.dot(b.across).abs() < 1e-4);
        }
    }

    #[test]
    fn one_strand_alone_has_a_strip() {
        let ribbon = Ribbon::new(&lock(0.0), &[0], |_| Vec3::Y, Side::Wide, 1e-4);
        assert!(ribbon.stations.iter().all(|s| s.across.is_normalized() && s.half >= NARROWEST));
    }
}
