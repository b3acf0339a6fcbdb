// The 3×3 blocks by which the turns of joints are eliminated: frisure-rod's `batch/pivot.rs`.

// A pivot this small against its diagonal is zero but for rounding.
const ROUNDING: f32 = 5e-7;

// The model of the energy as a function of a joint's turn x and of the turn θ after it: `½ xᵀ H x + xᵀ M θ`.
struct JointModel {
    // H, without the joint's own stiffness.
    block: Sym3,
    // Its columns are the rows of M.
    rows: mat3x3<f32>,
}

// With slope g and curvature P of what hangs from the joint, and the Jacobian J of its turn.
fn joint_model(table: Table, c: vec3<f32>, j: mat3x3<f32>, g: vec3<f32>, p: Sym3) -> JointModel {
    let rows = mat3x3<f32>(
        sym_times(p, j[0]) - 0.5 * cross(g, j[0]),
        sym_times(p, j[1]) - 0.5 * cross(g, j[1]),
        sym_times(p, j[2]) - 0.5 * cross(g, j[2]),
    );
    return JointModel(add_second(table, c, g, between(p, j)), rows);
}

// `L D Lᵀ` of a symmetric block.
struct Factor {
    l21: f32,
    l31: f32,
    l32: f32,
    // D⁻¹.
    inverse: vec3<f32>,
    // The least pivot, but for rounding: positive if the block is.
    least: f32,
}

fn factor_of(block: Sym3) -> Factor {
    let d1 = 1.0 / block.xx;
    let l21 = block.xy * d1;
    let l31 = block.xz * d1;
    let second = block.yy - l21 * block.xy;
    let e = block.yz - l31 * block.xy;
    let d2 = 1.0 / second;
    let l32 = e * d2;
    let third = block.zz - l31 * block.xz - l32 * e;
    let beyond = min(second - ROUNDING * block.yy, third - ROUNDING * block.zz);
    return Factor(l21, l31, l32, vec3(d1, d2, 1.0 / third), min(block.xx, beyond));
}

// `L⁻¹` of a vector.
fn lower(factor: Factor, v: vec3<f32>) -> vec3<f32> {
    let y = v.y - factor.l21 * v.x;
    return vec3(v.x, y, v.z - factor.l31 * v.x - factor.l32 * y);
}

// `L⁻ᵀ` of a vector.
fn raise(factor: Factor, v: vec3<f32>) -> vec3<f32> {
    let y = v.y - factor.l32 * v.z;
    return vec3(v.x - factor.l31 * v.z - factor.l21 * y, y, v.z);
}

// `L⁻¹` of a matrix by rows.
fn lower_rows(factor: Factor, m: mat3x3<f32>) -> mat3x3<f32> {
    let y = m[1] - factor.l21 * m[0];
    let z = m[2] - factor.l31 * m[0] - factor.l32 * y;
    return mat3x3<f32>(m[0], y, z);
}

// `L⁻ᵀ D⁻¹` of a matrix by rows, by rows.
fn raise_rows(factor: Factor, m: mat3x3<f32>) -> mat3x3<f32> {
    let z = factor.inverse.z * m[2];
    let y = factor.inverse.y * m[1] - factor.l32 * z;
    let x = factor.inverse.x * m[0] - factor.l31 * z - factor.l21 * y;
    return mat3x3<f32>(x, y, z);
}
