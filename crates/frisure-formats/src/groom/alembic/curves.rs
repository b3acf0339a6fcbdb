//! Points on curves that are given by control points.
//!
//! Catmull-Rom curves run through their points, which are taken as they are, the first and last too. Of Bézier
//! curves and B-splines, points on the curve are taken.

/// The weights of a point of a strand on up to four values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stencil {
    /// The first of the values.
    pub(super) from: usize,
    /// Parts of it and of those after it; together 1.
    pub(super) weights: [f32; 4],
}

/// How many points are taken of a piece of a Bézier curve, which has three control points of its own.
const OF_BEZIER: usize = 4;
/// How many are taken of a piece of a B-spline, which has one.
const OF_SPLINE: usize = 2;

/// Points on a Bézier curve of `count` control points; they are one more than three for each piece.
pub(super) fn bezier(count: usize) -> Result<Vec<Stencil>, String> {
    if count % 3 != 1 {
        return Err(format!("a Bézier curve of {count} points is none of 4, 7, 10, …"));
    }
    let last = Stencil { from: count - 1, weights: [1.0, 0.0, 0.0, 0.0] };
    let point = |k: usize| {
        let t = (k % OF_BEZIER) as f64 / OF_BEZIER as f64;
        let s = 1.0 - t;
        let weights = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
        Stencil { from: 3 * (k / OF_BEZIER), weights: weights.map(|w| w as f32) }
    };
    Ok((0..(count - 1) / 3 * OF_BEZIER).map(point).chain([last]).collect())
}

/// Points on a B-spline of `count` control points, of a degree that is lowered where there are too few, over
/// `knots` if there are as many as it needs, and else over evenly spaced ones.
pub(super) fn spline(count: usize, degree: usize, knots: &[f32]) -> Result<Vec<Stencil>, String> {
    let degree = degree.clamp(1, 3).min(count.saturating_sub(1));
    if count == 0 || degree == 0 {
        return Ok(vec![Stencil { from: 0, weights: [1.0, 0.0, 0.0, 0.0] }; count]);
    }
    let given = knots.len() == count + degree + 1;
    let knot = |i: usize| if given { f64::from(knots[i]) } else { i as f64 };
    let increases = (0..count + degree).all(|i| knot(i) <= knot(i + 1));
    if !increases || !knot(0).is_finite() || !knot(count + degree).is_finite() {
        return Err("its knots do not increase".into());
    }
    let mut points = Vec::with_capacity(OF_SPLINE * (count - degree) + 1);
    for span in degree..count {
        let (from, to) = (knot(span), knot(span + 1));
        if to > from {
            points.extend((0..OF_SPLINE).map(|k| {
                let t = from + (to - from) * k as f64 / OF_SPLINE as f64;
                Stencil { from: span - degree, weights: basis(&knot, span, degree, t) }
            }));
        }
    }
    let end = (degree..count).rev().find(|&s| knot(s + 1) > knot(s));
    let span = end.ok_or("its knots are all the same")?;
    let weights = basis(&knot, span, degree, knot(count));
    points.push(Stencil { from: span - degree, weights });
    Ok(points)
}

/// The functions of a B-spline that are not 0 within a span of its knots (Piegl and Tiller, The NURBS Book, 2.2).
fn basis(knot: &impl Fn(usize) -> f64, span: usize, degree: usize, t: f64) -> [f32; 4] {
    let mut values = [0.0; 4];
    values[0] = 1.0;
    for d in 1..=degree {
        let mut saved = 0.0;
        for (r, value) in values.iter_mut().enumerate().take(d) {
            let (left, right) = (t - knot(span + 1 + r - d), knot(span + 1 + r) - t);
            let term = *value / (left + right);
            *value = saved + right * term;
            saved = left * term;
        }
        values[d] = saved;
    }
    values.map(|v| v as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(values: &[f32], stencils: &[Stencil]) -> Vec<f32> {
        let mix = |s: &Stencil| {
            (0..4).map(|k| s.weights[k] * values.get(s.from + k).copied().unwrap_or(0.0)).sum()
        };
        stencils.iter().map(mix).collect()
    }

    #[test]
    fn bezier_curves_end_at_their_ends() {
        // x = 3t, through the middle control points evenly spaced.
        let x = at(&[0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0], &bezier(7).unwrap());
        let even: Vec<f32> = (0..9).map(|k| 0.75 * k as f32).collect();
        assert_eq!(x, even);
        assert_eq!(bezier(1).unwrap().len(), 1);
        assert!(bezier(5).is_err() && bezier(0).is_err());
    }

    #[test]
    fn even_splines_are_those_of_the_textbook() {
        let points = spline(5, 3, &[]).unwrap();
        assert_eq!(points.len(), 5);
        // (1, 4, 1) / 6 at a knot, (1, 23, 23, 1) / 48 half-way.
        let sixth = 1.0 / 6.0;
        for (a, b) in points[0].weights.iter().zip([sixth, 4.0 * sixth, sixth, 0.0]) {
            assert!((a - b).abs() < 1e-7);
        }
        for (a, b) in points[1].weights.iter().zip([1.0, 23.0, 23.0, 1.0]) {
            assert!((a - b / 48.0).abs() < 1e-7);
        }
    }

    #[test]
    fn clamped_splines_end_at_their_ends() {
        let knots = [0.0, 0.0, 0.0, 0.0, 1.0, 2.0, 2.0, 2.0, 2.0];
        let x = at(&[5.0, 6.0, 7.0, 8.0, 9.0], &spline(5, 3, &knots).unwrap());
        assert_eq!((x[0], x[x.len() - 1]), (5.0, 9.0));
        assert!(x.windows(2).all(|w| w[0] < w[1]));
        // Any number of control points makes some curve.
        for n in 0..9 {
            assert_eq!(spline(n, 3, &[]).unwrap().is_empty(), n == 0);
        }
        assert!(spline(4, 3, &[0.0; 8]).is_err());
        assert!(spline(4, 3, &[0.0, 1.0, 2.0, f32::NAN, 4.0, 5.0, 6.0, 7.0]).is_err());
    }
}
