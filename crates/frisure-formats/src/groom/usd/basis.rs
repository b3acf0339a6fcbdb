//! Points on curves that are given by others.
//!
//! Linear and Catmull–Rom curves pass through their vertices, which are taken as they are; Bézier curves, B-splines
//! and NURBS are evaluated, at about as many points as they have vertices. Sources: OpenUSD's documentation of
//! `UsdGeomBasisCurves` (bases, wraps, counts of vertex and varying values) and `UsdGeomNurbsCurves`.

use frisure_usd::{Prim, Value};

/// A point on a curve: what it takes of each vertex, and between which varying values it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Tap {
    /// Indices of vertices, within all curves.
    pub(super) vertices: [u32; 4],
    pub(super) weights: [f32; 4],
    /// Index of the varying value before, within all curves, and the one after.
    pub(super) varying: [u32; 2],
    /// Part of the way from one to the other.
    pub(super) part: f32,
}

impl Tap {
    /// The vertex that it takes most of.
    pub(super) fn nearest(&self) -> u32 {
        let most = (0..4).max_by(|&a, &b| self.weights[a].total_cmp(&self.weights[b]));
        self.vertices[most.unwrap_or(0)]
    }
}

/// Points on all curves of a prim.
#[derive(Default)]
pub(super) struct Taps {
    /// How many points each curve has.
    pub(super) counts: Vec<usize>,
    pub(super) taps: Vec<Tap>,
    /// How many vertices and varying values the curves have.
    pub(super) vertices: usize,
    pub(super) varying: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Linear,
    CatmullRom,
    BSpline,
    Bezier,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Wrap {
    Open,
    Pinned,
    Closed,
}

/// Points on `BasisCurves` with `counts` vertices each.
pub(super) fn basis_curves(prim: &Prim, counts: &[usize]) -> Result<Taps, String> {
    let word = |name, usual| prim.word(name).unwrap_or(usual);
    let kind = match (word("type", "cubic"), word("basis", "bezier")) {
        ("linear", _) => Kind::Linear,
        (_, "bezier") => Kind::Bezier,
        (_, "bspline") => Kind::BSpline,
        (_, "catmullRom") => Kind::CatmullRom,
        (_, basis) => return Err(format!("curves of basis `{basis}` are not read")),
    };
    let wrap = match word("wrap", "nonperiodic") {
        "nonperiodic" => Wrap::Open,
        "pinned" => Wrap::Pinned,
        "periodic" => Wrap::Closed,
        wrap => return Err(format!("curves of wrap `{wrap}` are not known")),
    };
    let mut taps = Taps::default();
    for (i, &count) in counts.iter().enumerate() {
        taps.curve(kind, wrap, count).map_err(|what| {
            format!("curve {i} has {count} vertices: a {kind:?} curve has {what}")
        })?;
    }
    Ok(taps)
}

impl Taps {
    fn curve(&mut self, kind: Kind, wrap: Wrap, count: usize) -> Result<(), &'static str> {
        let before = self.taps.len();
        let varying = match (kind, wrap) {
            (Kind::Bezier, wrap) => self.bezier(count, wrap == Wrap::Closed)?,
            (Kind::Linear, Wrap::Open | Wrap::Pinned) | (Kind::CatmullRom, Wrap::Pinned) => {
                at_least(count, 2)?;
                (0..count).for_each(|i| self.tap(&[(i, 1.0)], i));
                count
            }
            (Kind::Linear | Kind::CatmullRom, Wrap::Closed) => {
                at_least(count, 3)?;
                (0..=count).for_each(|i| self.tap(&[(i % count, 1.0)], i % count));
                count
            }
            // The first and the last vertex only say how it begins and ends.
            (Kind::CatmullRom, Wrap::Open) => {
                at_least(count, 4)?;
                (1..count - 1).for_each(|i| self.tap(&[(i, 1.0)], i - 1));
                count - 2
            }
            (Kind::BSpline, Wrap::Open) => {
                at_least(count, 4)?;
                (1..count - 1).for_each(|i| self.knot([i - 1, i, i + 1], i - 1));
                count - 2
            }
            // Pinned by vertices beyond its ends, which are as far from them as those within.
            (Kind::BSpline, Wrap::Pinned) => {
                at_least(count, 2)?;
                self.tap(&[(0, 1.0)], 0);
                (1..count - 1).for_each(|i| self.knot([i - 1, i, i + 1], i));
                self.tap(&[(count - 1, 1.0)], count - 1);
                count
            }
            (Kind::BSpline, Wrap::Closed) => {
                at_least(count, 3)?;
                for i in (0..count).chain([0]) {
                    self.knot([(i + count - 1) % count, i, (i + 1) % count], i);
                }
                count
            }
        };
        self.end(before, count, varying);
        Ok(())
    }

    /// Ends a curve that began at a tap.
    fn end(&mut self, before: usize, count: usize, varying: usize) {
        self.counts.push(self.taps.len() - before);
        self.vertices += count;
        self.varying += varying;
    }

    /// Adds the point at which two pieces of a B-spline meet.
    fn knot(&mut self, [before, at, after]: [usize; 3], varying: usize) {
        let sixth = 1.0 / 6.0;
        self.tap(&[(before, sixth), (at, 4.0 * sixth), (after, sixth)], varying);
    }

    /// Ends of the pieces and two points between; how many varying values there are.
    fn bezier(&mut self, count: usize, closed: bool) -> Result<usize, &'static str> {
        let fits = if closed {
            count >= 3 && count.is_multiple_of(3)
        } else {
            count >= 4 && count % 3 == 1
        };
        if !fits {
            return Err(if closed { "3 for each piece" } else { "3 for each piece and 1" });
        }
        let pieces = count / 3;
        let varying = if closed { pieces } else { pieces + 1 };
        for piece in 0..pieces {
            let at = |k: usize| (3 * piece + k) % count;
            self.tap(&[(at(0), 1.0)], piece);
            for t in [1.0_f32 / 3.0, 2.0 / 3.0] {
                let u = 1.0 - t;
                let weights = [u * u * u, 3.0 * u * u * t, 3.0 * u * t * t, t * t * t];
                let parts: Vec<_> = (0..4).map(|k| (at(k), weights[k])).collect();
                self.tap(&parts, piece);
                let last = self.taps.len() - 1;
                let after = self.varying + (piece + 1) % varying;
                self.taps[last].varying[1] = index(after);
                self.taps[last].part = t;
            }
        }
        let end = 3 * pieces % count;
        self.tap(&[(end, 1.0)], pieces % varying);
        Ok(varying)
    }

    fn tap(&mut self, parts: &[(usize, f32)], varying: usize) {
        let varying = [index(self.varying + varying); 2];
        let mut tap =
            Tap { vertices: [index(self.vertices); 4], weights: [0.0; 4], varying, part: 0.0 };
        for (k, (vertex, weight)) in parts.iter().enumerate() {
            tap.vertices[k] = index(self.vertices + vertex);
            tap.weights[k] = *weight;
        }
        self.taps.push(tap);
    }
}

fn at_least(count: usize, least: usize) -> Result<(), &'static str> {
    let names = ["", "", "at least 2", "at least 3", "at least 4"];
    if count >= least { Ok(()) } else { Err(names[least]) }
}

/// Vertices were counted to be fewer than that.
fn index(i: usize) -> u32 {
    i as u32
}

/// Points on `NurbsCurves` with `counts` vertices each, of order 2 to 4.
pub(super) fn nurbs_curves(prim: &Prim, counts: &[usize]) -> Result<Taps, String> {
    let numbers = |name: &str| prim.value(name).and_then(Value::numbers).unwrap_or_default();
    let (orders, knots) = (numbers("order"), numbers("knots"));
    let importance = numbers("pointWeights");
    let mut taps = Taps::default();
    let mut first_knot = 0_usize;
    if orders.len() != counts.len() {
        return Err(format!("it has {} orders for {} curves", orders.len(), counts.len()));
    }
    if !importance.is_empty() && importance.len() != counts.iter().sum::<usize>() {
        return Err(format!("it has {} weights of points", importance.len()));
    }
    for (i, (&count, order)) in counts.iter().zip(orders).enumerate() {
        let order = [2, 3, 4].into_iter().find(|&o| f64::from(o) == order).ok_or_else(|| {
            format!("curve {i} is of order {order}, and orders of 2 to 4 are read")
        })? as usize;
        let own = knots.get(first_knot..).and_then(|k| k.get(..count + order));
        let own = own.ok_or_else(|| format!("the knots of curve {i} are missing"))?;
        first_knot += count + order;
        let rising = own.windows(2).all(|k| k[0] <= k[1]) && own.iter().all(|k| k.is_finite());
        if count < order || !rising || !(own[order - 1] < own[count]) {
            return Err(format!("curve {i} has {count} vertices and knots that do not fit"));
        }
        let weights = importance.get(taps.vertices..).unwrap_or_default();
        taps.nurbs(own, order, count, weights);
    }
    Ok(taps)
}

impl Taps {
    /// Adds as many points as there are vertices, evenly spaced in the parameter.
    fn nurbs(&mut self, knots: &[f64], order: usize, count: usize, importance: &[f64]) {
        let before = self.taps.len();
        let (from, to) = (knots[order - 1], knots[count]);
        let varying = count - order + 2;
        for k in 0..count {
            let t = k as f64 / (count - 1) as f64;
            let u = from + (to - from) * t;
            let last = count - 1;
            let span = (order - 1..last).find(|&s| u < knots[s + 1]).unwrap_or_else(|| {
                // The end belongs to the last piece that has a length.
                (order - 1..=last).rev().find(|&s| knots[s] < knots[s + 1]).unwrap_or(last)
            });
            let mut weights = blend(knots, order, span, u);
            let first = span + 1 - order;
            if !importance.is_empty() {
                for (j, w) in weights.iter_mut().enumerate().take(order) {
                    *w *= importance[first + j];
                }
            }
            let sum: f64 = weights.iter().sum();
            let parts: Vec<_> =
                (0..order).map(|j| (first + j, (weights[j] / sum) as f32)).collect();
            let place = t * (varying - 1) as f64;
            let before = (place as usize).min(varying - 1);
            self.tap(&parts, before);
            let last = self.taps.len() - 1;
            self.taps[last].varying[1] = index(self.varying + (before + 1).min(varying - 1));
            let part = (place - before as f64) as f32;
            self.taps[last].part = part;
        }
        self.end(before, count, varying);
    }
}

/// The basis functions that are not 0 in a span, by the recursion of Cox and de Boor.
fn blend(knots: &[f64], order: usize, span: usize, u: f64) -> [f64; 4] {
    let mut weights = [1.0, 0.0, 0.0, 0.0];
    for degree in 1..order {
        let mut left = 0.0;
        for j in 0..degree {
            let (high, low) = (knots[span + j + 1], knots[span + 1 + j - degree]);
            let share = if high > low { weights[j] / (high - low) } else { 0.0 };
            weights[j] = left + (high - u) * share;
            left = (u - low) * share;
        }
        weights[degree] = left;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    fn prim(kind: &str, basis: &str, wrap: &str) -> Prim {
        let mut prim = Prim::new("BasisCurves", "a");
        prim.uniform("token", "type", Value::token(kind));
        prim.uniform("token", "basis", Value::token(basis));
        prim.uniform("token", "wrap", Value::token(wrap));
        prim
    }

    /// Where the points of curves are whose vertices are at `x`.
    fn along(taps: &Taps, x: &[f32]) -> Vec<f32> {
        let at = |tap: &Tap| (0..4).map(|k| tap.weights[k] * x[tap.vertices[k] as usize]).sum();
        taps.taps.iter().map(at).collect()
    }

    #[test]
    fn evenly_spaced_vertices_give_evenly_spaced_points() {
        let x: Vec<f32> = (0..14).map(|i| i as f32).collect();
        for (basis, wrap, ends) in [
            ("bspline", "nonperiodic", (1.0, 5.0)),
            ("bspline", "pinned", (0.0, 6.0)),
            ("catmullRom", "nonperiodic", (1.0, 5.0)),
            ("catmullRom", "pinned", (0.0, 6.0)),
            ("bezier", "nonperiodic", (0.0, 6.0)),
            ("bezier", "pinned", (0.0, 6.0)),
        ] {
            let taps = basis_curves(&prim("cubic", basis, wrap), &[7, 7]).unwrap();
            let found = along(&taps, &x);
            assert_eq!((taps.vertices, taps.counts.len()), (14, 2));
            let (first, second) = found.split_at(taps.counts[0]);
            assert!((first[0] - ends.0).abs() < 1e-5, "{basis} {wrap} {found:?}");
            assert!((first[first.len() - 1] - ends.1).abs() < 1e-5, "{basis} {wrap}");
            assert!((second[0] - ends.0 - 7.0).abs() < 1e-5, "{basis} {wrap}");
            assert!(first.windows(2).all(|p| (p[1] - p[0] - 1.0).abs() < 1e-5), "{found:?}");
        }
    }

    #[test]
    fn counts_of_varying_values_are_those_of_the_documentation() {
        let varying = |kind, basis, wrap, n| {
            let taps = basis_curves(&prim(kind, basis, wrap), &[n]).unwrap();
            let last = taps.taps.iter().flat_map(|t| t.varying).max().unwrap();
            assert!((last as usize) < taps.varying);
            (taps.varying, taps.counts[0])
        };
        assert_eq!(varying("linear", "bezier", "nonperiodic", 5), (5, 5));
        assert_eq!(varying("linear", "bezier", "periodic", 5), (5, 6));
        assert_eq!(varying("cubic", "bezier", "nonperiodic", 7), (3, 7));
        assert_eq!(varying("cubic", "bezier", "periodic", 6), (2, 7));
        assert_eq!(varying("cubic", "bspline", "nonperiodic", 7), (5, 5));
        assert_eq!(varying("cubic", "bspline", "pinned", 7), (7, 7));
        assert_eq!(varying("cubic", "catmullRom", "nonperiodic", 7), (5, 5));
        assert_eq!(varying("cubic", "catmullRom", "periodic", 7), (7, 8));
    }

    #[test]
    fn too_few_vertices_are_told() {
        for (kind, basis, wrap, n) in [
            ("linear", "bezier", "nonperiodic", 1),
            ("cubic", "bezier", "nonperiodic", 5),
            ("cubic", "bezier", "periodic", 4),
            ("cubic", "bspline", "nonperiodic", 3),
            ("cubic", "catmullRom", "nonperiodic", 3),
            ("cubic", "catmullRom", "pinned", 0),
            ("cubic", "hermite", "nonperiodic", 4),
            ("cubic", "bezier", "round", 4),
        ] {
            assert!(basis_curves(&prim(kind, basis, wrap), &[n]).is_err(), "{kind} {basis} {wrap}");
        }
    }

    fn nurbs(order: i32, knots: &[f64], weights: &[f64], n: usize) -> Result<Taps, String> {
        let mut prim = Prim::new("NurbsCurves", "a");
        let doubles = |v: &[f64]| Value {
            array: true,
            data: frisure_usd::Data::F64(v.to_vec()),
            ..Value::double(0.0)
        };
        prim.varying("int[]", "order", Value::ints(vec![order]));
        prim.varying("double[]", "knots", doubles(knots));
        prim.varying("double[]", "pointWeights", doubles(weights));
        nurbs_curves(&prim, &[n])
    }

    #[test]
    fn a_quarter_of_a_circle_is_a_rational_curve() {
        let half = 0.5_f64.sqrt();
        let taps = nurbs(3, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &[1.0, half, 1.0], 3).unwrap();
        let (x, y) = (along(&taps, &[1.0, 1.0, 0.0]), along(&taps, &[0.0, 1.0, 1.0]));
        for (x, y) in x.iter().zip(&y) {
            assert!((x.hypot(*y) - 1.0).abs() < 1e-6);
        }
        assert_eq!((x[0], y[2]), (1.0, 1.0));
        assert!(nurbs(3, &[0.0, 0.0, 0.0, 1.0, 1.0], &[], 3).is_err());
        assert!(nurbs(5, &[0.0; 10], &[], 5).is_err());
        assert!(nurbs(3, &[0.0; 6], &[], 3).is_err());
    }

    #[test]
    fn nurbs_with_repeated_knots_at_the_ends_begin_and_end_at_vertices() {
        let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0];
        let taps = nurbs(4, &knots, &[], 5).unwrap();
        let x = along(&taps, &[0.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!((x[0], x[4]), (0.0, 4.0));
        assert!(x.windows(2).all(|p| p[0] < p[1]), "{x:?}");
        assert_eq!(taps.varying, 3);
    }
}
