//! How hair is wound: the axis about which the centre line of a guide turns.

use frisure_rod::Equilibrium;
use glam::{DMat2, DVec2, DVec3};

use super::mesh::Axis;

/// Distance (m) of the points of a guide that its axis is fitted to. Chosen: thirty to a turn on the usual roller.
const STEP: f64 = 3e-3;

/// A wound guide.
#[derive(Clone, Debug)]
pub(super) struct Winding {
    /// Its wisp.
    pub(super) wisp: usize,
    /// Points (m) of its centre line from root to tip.
    pub(super) points: Vec<DVec3>,
    /// The axis that it is wound about; its centre is half-way along the winding.
    pub(super) axis: Axis,
}

impl Winding {
    /// The winding of a guide at rest; none of one that turns less than `turns` about its axis.
    pub(super) fn of(wisp: usize, rest: &Equilibrium, turns: f64) -> Option<Self> {
        let count = (rest.rod.length() / STEP).ceil() as usize + 2;
        let points = rest.centre_line(count);
        // A helix has the binormal of its axis, but for a part that turns round with it.
        let pieces: Vec<DVec3> = points.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let turned = |pair: &[DVec3]| pair[0].cross(pair[1]);
        let direction = pieces.windows(2).map(turned).sum::<DVec3>().try_normalize()?;
        let angle: f64 = pieces.windows(2).map(|p| p[0].angle_between(p[1])).sum();
        if angle < turns * std::f64::consts::TAU {
            return None;
        }
        let centre = centre(&points, direction)?;
        let (low, high) = span(&points, &Axis { centre, direction });
        let axis = Axis { centre: centre + 0.5 * (low + high) * direction, direction };
        Some(Self { wisp, points, axis })
    }
}

/// How far points reach along an axis (m), from its centre.
pub(super) fn span(points: &[DVec3], axis: &Axis) -> (f64, f64) {
    let along = points.iter().map(|p| axis.split(*p).0);
    along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)))
}

/// The point (m) from which points, seen along a direction, are equally far: the least-squares circle of Kåsa (1976, IEEE Trans.
/// Instrum. Meas. 25), which is linear.
fn centre(points: &[DVec3], direction: DVec3) -> Option<DVec3> {
    let u = direction.any_orthonormal_vector();
    let v = direction.cross(u);
    let mean = points.iter().sum::<DVec3>() / points.len() as f64;
    let flat = |p: &DVec3| DVec2::new((*p - mean).dot(u), (*p - mean).dot(v));
    let (mut matrix, mut right) = (DMat2::ZERO, DVec2::ZERO);
    for q in points.iter().map(flat) {
        matrix += DMat2::from_cols(q * q.x, q * q.y);
        right += 0.5 * q.length_squared() * q;
    }
    let scale = matrix.col(0).x + matrix.col(1).y;
    // Points on a line have no circle.
    (matrix.determinant() > 1e-6 * scale * scale).then(|| {
        let c = matrix.inverse() * right;
        mean + c.x * u + c.y * v
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_has_the_centre_of_its_circle() {
        let direction = DVec3::new(1.0, 2.0, -0.5).normalize();
        let u = direction.any_orthonormal_vector();
        let about = DVec3::new(0.1, 0.2, 0.3);
        let arc: Vec<DVec3> = (0..30)
            .map(|k| {
                let (sine, cosine) = (0.1 * f64::from(k)).sin_cos();
                let out = cosine * u + sine * direction.cross(u);
                about + 0.02 * out + 1e-3 * f64::from(k) * direction
            })
            .collect();
        let found = Axis { centre: centre(&arc, direction).unwrap(), direction };
        assert!(found.split(about).1.length() < 1e-12);
        let line: Vec<DVec3> = (0..9).map(|k| DVec3::X * f64::from(k)).collect();
        assert_eq!(centre(&line, DVec3::Z), None);
    }
}
