// Rotations of joints, without an angle or a division: frisure-rod's `batch/turn.rs` in single precision.

// Largest square of a joint's turn (rad²) up to which the series are exact: a little more than half a turn.
const LARGEST_SQUARE: f32 = 9.9;

// c₁ to c₅ of a turn's square: c_k = Σ (−x)ʲ / (k + 2j)!.
struct Table {
    square: f32,
    c1: f32,
    c2: f32,
    c3: f32,
    c4: f32,
    c5: f32,
}

// What c has eight terms of c₄ and c₅ for, which is what single precision sees up to the largest square.
fn table_of(c: vec3<f32>) -> Table {
    let square = dot(c, c);
    let down = vec2(-square);
    var s = vec2<f32>(1.0 / 6402373705728000.0, 1.0 / 121645100408832000.0);
    s = fma(down, s, vec2<f32>(1.0 / 20922789888000.0, 1.0 / 355687428096000.0));
    s = fma(down, s, vec2<f32>(1.0 / 87178291200.0, 1.0 / 1307674368000.0));
    s = fma(down, s, vec2<f32>(1.0 / 479001600.0, 1.0 / 6227020800.0));
    s = fma(down, s, vec2<f32>(1.0 / 3628800.0, 1.0 / 39916800.0));
    s = fma(down, s, vec2<f32>(1.0 / 40320.0, 1.0 / 362880.0));
    s = fma(down, s, vec2<f32>(1.0 / 720.0, 1.0 / 5040.0));
    s = fma(down, s, vec2<f32>(1.0 / 24.0, 1.0 / 120.0));
    let c32 = fma(down, s.yx, vec2<f32>(1.0 / 6.0, 0.5));
    let c1 = fma(-square, c32.x, 1.0);
    return Table(square, c1, c32.y, c32.x, s.x, s.y);
}

// `I + a [c]× + b [c]×²`.
fn matrix(table: Table, c: vec3<f32>, a: f32, b: f32) -> mat3x3<f32> {
    let rest = 1.0 - table.square * b;
    let ac = a * c;
    let bc = b * c;
    let xy = bc.x * c.y;
    let xz = bc.x * c.z;
    let yz = bc.y * c.z;
    return mat3x3<f32>(
        bc.x * c.x + rest, xy + ac.z, xz - ac.y,
        xy - ac.z, bc.y * c.y + rest, yz + ac.x,
        xz + ac.y, yz - ac.x, bc.z * c.z + rest,
    );
}

// `exp([c]×)`.
fn rotation(table: Table, c: vec3<f32>) -> mat3x3<f32> {
    return matrix(table, c, table.c1, table.c2);
}

// The right Jacobian of the exponential.
fn jacobian(table: Table, c: vec3<f32>) -> mat3x3<f32> {
    return matrix(table, c, -table.c2, table.c3);
}

// Adds the second derivative of the turn, contracted with `lambda`.
fn add_second(table: Table, c: vec3<f32>, lambda: vec3<f32>, sum: Sym3) -> Sym3 {
    let d2 = table.c4 - 0.5 * table.c3;
    let d3 = 0.5 * (3.0 * table.c5 - table.c4);
    let once = cross(c, lambda);
    let swirl = d3 * cross(c, once) + d2 * once;
    let other = swirl - 0.5 * table.c3 * lambda;
    let along = table.c3 * dot(lambda, c);
    return plus_diagonal(plus_outer(sum, c, other), vec3(along));
}

// `exp(−[c]×) v`.
fn turned_back(table: Table, c: vec3<f32>, v: vec3<f32>) -> vec3<f32> {
    let once = cross(c, v);
    return table.c2 * cross(c, once) + (v - table.c1 * once);
}
