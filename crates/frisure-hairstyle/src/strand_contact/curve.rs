//! The line of a hair that others touch: smooth, so that the place that is nearest to a point moves without jumps.
//!
//! The clamped quadratic B-spline with the points of a hair as its control points: from point to point of a hair in contact its turns are
//! small, and it leaves the links by an eighth of turn times length at most. The nearest place of a chain of straight links jumps where a point
//! on the inner side of a bend passes from one link to the next, and the force with it. docs/theory.md, "Hairs that push each other"

use glam::DVec3;

use super::layout::Layout;
use crate::parallel;

/// A place on the line of a hair: a mean of three of its points, one after the other, with weights that are not negative and sum to one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Place {
    /// The first of the points.
    pub(super) first: u32,
    pub(super) weights: [f64; 3],
}

impl Place {
    /// The mean of the values of its points.
    #[inline]
    pub(super) fn of(&self, values: &[DVec3]) -> DVec3 {
        weighted(values, self.first, self.weights)
    }
}

#[inline]
fn weighted(values: &[DVec3], first: u32, [a, b, c]: [f64; 3]) -> DVec3 {
    let at = first as usize;
    values[at] * a + values[at + 1] * b + values[at + 2] * c
}

/// Where a point is nearest to the line of another hair.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nearest {
    pub(super) place: Place,
    /// From there to the point (m).
    pub(super) away: DVec3,
    /// Derivative of the line there by its parameter (m), and that of the weights; none at an end of the line, beyond which the point is.
    pub(super) along: Option<(DVec3, [f64; 3])>,
}

/// One parabola of the line: that around a point that is no end, from the middle of the link before it to that of the link after it. At the ends of
/// a hair it begins and ends with the hair.
struct Parabola {
    first: u32,
    /// Shares of the neighbouring points in the places where it begins and ends: a half, or one.
    ends: [f64; 2],
    /// Coefficients by the parameter t: c = c0 + c1 t + c2 t².
    coefficients: [DVec3; 3],
}

impl Parabola {
    /// That around the point `middle` of a hair whose points are `range`.
    fn new(points: &[DVec3], range: &std::ops::Range<usize>, middle: u32) -> Self {
        let at = middle as usize;
        let share = |at_end: bool| if at_end { 1.0 } else { 0.5 };
        let ends = [share(at == range.start + 1), share(at + 2 == range.end)];
        let (before, here, after) = (points[at - 1], points[at], points[at + 1]);
        let begin = here + (before - here) * ends[0];
        let end = here + (after - here) * ends[1];
        let coefficients = [begin, (here - begin) * 2.0, begin - here * 2.0 + end];
        Self { first: middle - 1, ends, coefficients }
    }

    /// The parameter, 0 to 1, at which it is nearest to `x`, or nearest to its beginning where it is so twice.
    fn nearest(&self, x: DVec3) -> f64 {
        let [c0, c1, c2] = self.coefficients;
        // f = (c − x)·c', and its derivative.
        let slope = |t: f64| {
            let (away, along) = (c0 - x + (c1 + c2 * t) * t, c1 + c2 * (2.0 * t));
            (away.dot(along), along.length_squared() + 2.0 * away.dot(c2))
        };
        let at_begin = slope(0.0).0;
        if at_begin >= 0.0 {
            return 0.0;
        }
        let at_end = slope(1.0).0;
        if at_end <= 0.0 {
            return 1.0;
        }
        // Newton's method between a place before and one behind.
        let (mut low, mut high, mut t) = (0.0, 1.0, at_begin / (at_begin - at_end));
        for _ in 0..NEWTON {
            let (f, derivative) = slope(t);
            *(if f < 0.0 { &mut low } else { &mut high }) = t;
            let next = t - f / derivative;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            let moved = (next - t).abs();
            t = next;
            if moved < MOVED {
                break;
            }
        }
        t
    }

    fn at(&self, t: f64, x: DVec3, is_end: bool) -> Nearest {
        let [c0, c1, c2] = self.coefficients;
        let [before, after] = self.ends;
        let (u, v) = ((1.0 - t) * (1.0 - t), t * t);
        let weights = [before * u, 1.0 - before * u - after * v, after * v];
        let place = Place { first: self.first, weights };
        let (du, dv) = (-2.0 * (1.0 - t) * before, 2.0 * t * after);
        let along = (!is_end).then(|| (c1 + c2 * (2.0 * t), [du, -du - dv, dv]));
        Nearest { place, away: x - (c0 + (c1 + c2 * t) * t), along }
    }
}

/// How far (m) the lines of hairs are from their links at most: a quarter of the second differences of their points, and at the ends too.
pub(super) fn farthest_from_links(layout: &Layout, points: &[DVec3]) -> f64 {
    let of_strand = |strand: usize| {
        let windows = points[layout.points(strand)].windows(3);
        windows.map(|p| (p[0] - p[1] * 2.0 + p[2]).length_squared()).fold(0.0, f64::max)
    };
    let largest = parallel::map(layout.strands(), of_strand).into_iter().fold(0.0, f64::max);
    0.25 * largest.sqrt()
}

/// Most steps of Newton's method, or halvings. Chosen: 3 suffice on lines of hair.
const NEWTON: usize = 60;

/// The last step of Newton's method, which doubles the digits: the next would be rounding.
const MOVED: f64 = 1e-7;

/// From the place of the line of a hair around its point `from` on downhill, to where it is nearest to `x`.
pub(super) fn nearest(
    layout: &Layout,
    points: &[DVec3],
    strand: u32,
    from: u32,
    x: DVec3,
) -> Nearest {
    let range = layout.points(strand as usize);
    let (first, last) = (range.start as u32 + 1, range.end as u32 - 2);
    let mut middle = from.clamp(first, last);
    let mut came_from = None;
    loop {
        let parabola = Parabola::new(points, &range, middle);
        let t = parabola.nearest(x);
        let next = match t {
            0.0 if middle > first => middle - 1,
            1.0 if middle < last => middle + 1,
            _ => middle,
        };
        // Where two parabolas meet both have the same tangent: their common end is the place.
        if next == middle || came_from == Some(next) {
            let is_end = (t == 0.0 && middle == first) || (t == 1.0 && middle == last);
            return parabola.at(t, x, is_end);
        }
        came_from = Some(middle);
        middle = next;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hair of eleven points 6 mm apart that turns by up to 0.6 rad at each.
    fn bent() -> (Layout, Vec<DVec3>) {
        let mut points = vec![DVec3::ZERO];
        let (mut angle, mut at) = (0.0_f64, DVec3::ZERO);
        for k in 0..10 {
            angle += 0.6 * (1.3 * f64::from(k)).sin();
            at += DVec3::new(angle.cos(), angle.sin(), 0.2 * (0.7 * f64::from(k)).cos()) * 6e-3;
            points.push(at);
        }
        (Layout::new(&[10]), points)
    }

    /// Points of the line, close to each other, in an independent form: that of de Boor.
    fn line(points: &[DVec3]) -> Vec<DVec3> {
        let last = points.len() - 1;
        let parabola = |k: usize, t: f64| {
            let begin = if k == 1 { points[0] } else { points[k - 1].lerp(points[k], 0.5) };
            let end = if k + 1 == last { points[last] } else { points[k].lerp(points[k + 1], 0.5) };
            begin.lerp(points[k], t).lerp(points[k].lerp(end, t), t)
        };
        let steps = (0..=2000).map(|i| f64::from(i) / 2000.0);
        (1..last).flat_map(|k| steps.clone().map(move |t| parabola(k, t))).collect()
    }

    #[test]
    fn the_nearest_place_is_that_of_a_search_along_the_line() {
        let (layout, points) = bent();
        let line = line(&points);
        for k in 0..300 {
            let along = line[(k * 57) % line.len()];
            let turn = f64::from(k as u32) * 0.7;
            let x = along + DVec3::new(turn.cos(), 0.3 * turn.sin(), turn.sin()) * 1e-3;
            let from = (0..line.len()).min_by(|&a, &b| {
                x.distance_squared(line[a]).total_cmp(&x.distance_squared(line[b]))
            });
            let from = from.unwrap();
            let found = nearest(&layout, &points, 0, (from / 2001) as u32 + 1, x);
            let place = found.place.of(&points);
            assert!((x - place - found.away).length() < 1e-15);
            // The points of the line are up to 6 µm apart.
            let searched = x.distance(line[from]);
            assert!((found.away.length() - searched).abs() < 1e-7, "{k}: {searched} {found:?}");
            let weights = found.place.weights;
            assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-14);
            assert!(weights.iter().all(|weight| *weight >= 0.0));
            if let Some((derivative, slopes)) = found.along {
                assert!(found.away.dot(derivative).abs() < 1e-11 * derivative.length());
                let of_weights = weighted(&points, found.place.first, slopes);
                assert!(derivative.distance(of_weights) < 1e-14);
            }
        }
    }

    /// On the inner side of a bend the nearest place of straight links jumps by twice the distance times the turn.
    #[test]
    fn the_nearest_place_moves_without_jumps_where_a_hair_bends() {
        let (layout, points) = bent();
        for middle in 1..9 {
            let inwards = points[middle - 1] - points[middle] * 2.0 + points[middle + 1];
            let along = points[middle + 1] - points[middle - 1];
            let x = points[middle] + inwards.normalize() * 1e-3;
            let mut before: Option<DVec3> = None;
            for k in -100..=100 {
                let x = x + along * (f64::from(k) * 2e-3);
                let found = nearest(&layout, &points, 0, middle as u32, x);
                let place = found.place.of(&points);
                // 24 µm from one to the next, and up to some times as far where lines bend towards the point.
                assert!(before.is_none_or(|b| b.distance(place) < 1e-4), "{middle} {k}");
                before = Some(place);
            }
        }
    }
}
