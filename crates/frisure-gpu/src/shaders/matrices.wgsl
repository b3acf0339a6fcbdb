// Symmetric matrices, as frisure-rod's `batch/lanes.rs` has them.

struct Sym3 {
    xx: f32,
    xy: f32,
    xz: f32,
    yy: f32,
    yz: f32,
    zz: f32,
}

fn sym_times(s: Sym3, v: vec3<f32>) -> vec3<f32> {
    return vec3(
        dot(vec3(s.xx, s.xy, s.xz), v),
        dot(vec3(s.xy, s.yy, s.yz), v),
        dot(vec3(s.xz, s.yz, s.zz), v),
    );
}

// `Mᵀ S M`.
fn between(s: Sym3, m: mat3x3<f32>) -> Sym3 {
    let x = sym_times(s, m[0]);
    let y = sym_times(s, m[1]);
    let z = sym_times(s, m[2]);
    return Sym3(
        dot(m[0], x),
        dot(m[0], y),
        dot(m[0], z),
        dot(m[1], y),
        dot(m[1], z),
        dot(m[2], z),
    );
}

// Plus `a bᵀ + b aᵀ`.
fn plus_outer(s: Sym3, a: vec3<f32>, b: vec3<f32>) -> Sym3 {
    return Sym3(
        s.xx + 2.0 * a.x * b.x,
        s.xy + a.x * b.y + a.y * b.x,
        s.xz + a.x * b.z + a.z * b.x,
        s.yy + 2.0 * a.y * b.y,
        s.yz + a.y * b.z + a.z * b.y,
        s.zz + 2.0 * a.z * b.z,
    );
}

// Minus `k v vᵀ`.
fn minus_square(s: Sym3, k: f32, v: vec3<f32>) -> Sym3 {
    let w = k * v;
    return Sym3(
        s.xx - w.x * v.x,
        s.xy - w.x * v.y,
        s.xz - w.x * v.z,
        s.yy - w.y * v.y,
        s.yz - w.y * v.z,
        s.zz - w.z * v.z,
    );
}

fn plus_diagonal(s: Sym3, d: vec3<f32>) -> Sym3 {
    return Sym3(s.xx + d.x, s.xy, s.xz, s.yy + d.y, s.yz, s.zz + d.z);
}
