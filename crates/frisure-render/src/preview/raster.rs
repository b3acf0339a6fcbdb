//! Which cells of a grid a triangle covers.

use glam::{Vec2, Vec3};

/// Calls `visit(x, y, weights)` for each cell of `from..to` (column, row) whose centre lies in the
/// triangle or on its edge, with the barycentric weights of the corners there.
pub(super) fn triangle(
    corners: [Vec2; 3],
    from: (usize, usize),
    to: (usize, usize),
    mut visit: impl FnMut(usize, usize, Vec3),
) {
    let [a, b, c] = corners;
    let area = (b - a).perp_dot(c - a);
    if !(area.abs() > 1e-12) {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    // The cast saturates: what is left of the grid becomes 0.
    let first = |low: f32, from: usize| ((low - 0.5).ceil() as usize).max(from);
    let last = |high: f32, to: usize| ((high + 0.5).floor().max(0.0) as usize).min(to);
    let scale = 1.0 / area;
    for y in first(low.y, from.1)..last(high.y, to.1) {
        for x in first(low.x, from.0)..last(high.x, to.0) {
            let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let wb = (p - a).perp_dot(c - a) * scale;
            let wc = (b - a).perp_dot(p - a) * scale;
            let weights = Vec3::new(1.0 - wb - wc, wb, wc);
            // A hair's breadth of tolerance, so that neighbours leave no gap between them.
            if weights.min_element() >= -1e-5 {
                visit(x, y, weights);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_of_two_triangles_has_no_gap() {
        let mut seen = [[0; 8]; 8];
        let [a, b, c, d] = [(0.7, 0.6), (7.3, 0.6), (7.3, 7.4), (0.7, 7.4)].map(Vec2::from);
        for corners in [[a, b, c], [a, d, c]] {
            triangle(corners, (0, 0), (8, 8), |x, y, w| {
                assert!((w.element_sum() - 1.0).abs() < 1e-5);
                seen[y][x] += 1;
            });
        }
        for (y, row) in seen.iter().enumerate() {
            for (x, &n) in row.iter().enumerate() {
                let inside = (1..7).contains(&x) && (1..7).contains(&y);
                assert_eq!(n > 0, inside, "{x} {y}");
            }
        }
    }

    #[test]
    fn cells_outside_the_window_are_left_alone() {
        let big = [(-100.0, -100.0), (300.0, -100.0), (-100.0, 300.0)].map(Vec2::from);
        let mut n = 0;
        triangle(big, (2, 3), (5, 7), |_, _, _| n += 1);
        assert_eq!(n, 12);
    }
}
