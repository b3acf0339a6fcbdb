// A piece of hair on the screen or in a map: the part of each pixel that it covers.

struct Line {
    // A corner of the parallelogram that holds it (pixels).
    at: vec2<f32>,
    // Depths at this corner's end.
    end: f32,
    // From the middle, across (pixels).
    offset: f32,
    // Half of its extent across, and the rise that softens it (pixels).
    half: f32,
    rise: f32,
    exists: bool,
}

// Corner (0 to 3) of a piece that a vertex is: six, two triangles, for each.
fn corner_of(vertex: u32) -> u32 {
    // 0, 1, 2 and 2, 1, 3, in two bits each.
    return (0xda4u >> (2u * (vertex % 6u))) & 3u;
}

// Number of a piece in its list.
fn piece_of(vertex: u32) -> u32 {
    return vertex / 6u;
}

// Corner `corner` (0 to 3) of a piece from p to q (pixels) that is 2 `width` wide, its edges softened over
// at least `softness` pixels. It runs along the axis to which it is closer, so that it owns whole columns of
// pixels and shares none with the next piece of its strand.
fn ribbon_corner(p: vec2<f32>, q: vec2<f32>, width: f32, softness: vec2<f32>, corner: u32) -> Line {
    var line: Line;
    let d = abs(q - p);
    let steep = d.y > d.x;
    let a = select(p, p.yx, steep);
    let b = select(q, q.yx, steep);
    let end = corner & 1u;
    let side = select(-1.0, 1.0, corner >= 2u);
    let run = b.x - a.x;
    line.exists = abs(run) > 1e-4 && width > 0.0;
    let slope = (b.y - a.y) / select(run, 1.0, abs(run) < 1e-4);
    // The extent across, measured along the second axis, is the width over the cosine of the slope.
    line.half = width * sqrt(1.0 + slope * slope);
    line.rise = clamp(abs(slope), softness.x, softness.y);
    let reach = line.half + 0.5 + 0.5 * line.rise;
    line.end = f32(end);
    line.offset = side * reach;
    let middle = select(a, b, end == 1u);
    let corner_at = vec2<f32>(middle.x, middle.y + line.offset);
    line.at = select(corner_at, corner_at.yx, steep);
    return line;
}

fn ramp(x: f32, inverse: f32) -> f32 {
    let y = max(x, 0.0);
    return 0.5 * y * y * inverse;
}

// Integral up to x of a box of width 1 smeared by a box of width `rise`, as `preview/composite.rs` has it.
fn edge(x: f32, rise: f32, inverse: f32) -> f32 {
    let outer = 0.5 + 0.5 * rise;
    let inner = 0.5 - 0.5 * rise;
    let y = clamp(x, -outer, outer);
    return ramp(y + outer, inverse) - ramp(y + inner, inverse) - ramp(y - inner, inverse);
}

// Part of a pixel that is covered.
fn covered(offset: f32, half: f32, rise: f32) -> f32 {
    let inverse = 1.0 / rise;
    return max(edge(offset + half, rise, inverse) - edge(offset - half, rise, inverse), 0.0);
}
