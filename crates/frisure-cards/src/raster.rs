//! Which part of each texel a piece of hair covers.

use glam::Vec2;

/// Calls `visit(x, y, part, t)` for each cell of a grid of `width` by `height` that a straight piece of hair covers in part: `part` of
/// it, at `t` along the piece (0 to 1).
///
/// `a` and `b` are in cells, `half` half its width (m), and `metres` the size of a cell (m), which may be higher than wide. A piece
/// narrower than a cell covers as much of a cell as its width is of the cell's.
pub(crate) fn piece(
    [a, b]: [Vec2; 2],
    half: f32,
    metres: Vec2,
    (width, height): (usize, usize),
    mut visit: impl FnMut(usize, usize, f32, f32),
) {
    let (p, q) = (a * metres, b * metres);
    let along = q - p;
    let length = along.length();
    // Across the hair, cells are as wide as this.
    let way = if length > 0.0 { along / length } else { Vec2::Y };
    let cell = (way.y * metres.x).hypot(way.x * metres.y);
    let reach = Vec2::splat(half + cell) / metres;
    let (low, high) = (a.min(b) - reach, a.max(b) + reach);
    // The casts saturate: what is left of the grid or above it becomes 0.
    let from = (low.x.floor() as usize, low.y.floor() as usize);
    let to = (
        (high.x.ceil().max(0.0) as usize).min(width),
        (high.y.ceil().max(0.0) as usize).min(height),
    );
    let most = (2.0 * half / cell).min(1.0);
    for y in from.1..to.1 {
        for x in from.0..to.0 {
            let d = Vec2::new(x as f32 + 0.5, y as f32 + 0.5) * metres - p;
            let t = if length > 0.0 { d.dot(way) } else { 0.0 };
            // Half a cell beyond an end belongs to the neighbouring piece, or is nothing.
            if t < -0.5 * cell || t > length + 0.5 * cell {
                continue;
            }
            let apart = d.perp_dot(way).abs();
            let part = ((half + 0.5 * cell - apart) / cell).min(most);
            if part > 0.0 {
                visit(x, y, part, if length > 0.0 { (t / length).clamp(0.0, 1.0) } else { 0.0 });
            }
        }
    }
}

/// Calls `visit(x, y, weights)` for each cell whose middle lies in a triangle (in cells), with the weights of its corners.
pub(crate) fn triangle(
    [a, b, c]: [Vec2; 3],
    (width, height): (usize, usize),
    mut visit: impl FnMut(usize, usize, [f32; 3]),
) {
    let area = (b - a).perp_dot(c - a);
    if !(area.abs() > 1e-9) {
        return;
    }
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let from = ((low.x - 0.5).ceil() as usize, (low.y - 0.5).ceil() as usize);
    let to = (
        ((high.x + 0.5).max(0.0) as usize).min(width),
        ((high.y + 0.5).max(0.0) as usize).min(height),
    );
    for y in from.1..to.1 {
        for x in from.0..to.0 {
            let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let (wb, wc) = ((p - a).perp_dot(c - a) / area, (b - a).perp_dot(p - a) / area);
            let weights = [1.0 - wb - wc, wb, wc];
            if weights.iter().all(|w| *w >= 0.0) {
                visit(x, y, weights);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_covers_the_area_that_it_has() {
        for (half, metres) in [
            (0.2, Vec2::ONE),
            (1.7, Vec2::ONE),
            (0.3, Vec2::new(1.0, 2.5)),
            (1.5, Vec2::new(1.0, 2.5)),
        ] {
            for end in [Vec2::new(5.3, 58.0), Vec2::new(30.0, 57.0), Vec2::new(58.0, 22.0)] {
                let ends = [Vec2::new(5.0, 6.0), end];
                let mut covered = 0.0;
                piece(ends, half, metres, (64, 64), |_, _, part, _| covered += part);
                let area = 2.0 * half * ((ends[1] - ends[0]) * metres).length();
                let covered = covered * metres.x * metres.y;
                assert!(
                    (covered / area - 1.0).abs() < 0.13,
                    "{half} {metres} {end}: {covered} {area}"
                );
            }
        }
    }
}
