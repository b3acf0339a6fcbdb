// Newton's sweeps over the joints of a hair: backward for the laws, forward to apply them. The formulas are told in frisure-rod's
// `batch/sweep.rs`, line by line the same.

// Largest change of a joint's turn in one step (rad).
const LARGEST_TURN: f32 = 1.0;

// What a backward sweep finds.
struct Backward {
    // Square of the largest derivative of the energy by a joint's turn.
    gradient: f32,
    // What the quadratic model loses by the whole step.
    decrease: f32,
    // The least pivot of the eliminations, but for rounding: positive where the second variation is.
    pivot: f32,
    // Square of the largest turn of a joint (rad²).
    turned: f32,
}

// Which way up is after each joint of the given shape, and the energy there, but for what no joint can change.
fn begin() -> f32 {
    let stiffness = stiffness_of_joints();
    var energy = 0.0;
    var before = root_up();
    for (var i = 0u; i < rest.joints; i++) {
        let c = control_of(i);
        let up = turned_back(table_of(c), c, before);
        energy += 0.5 * dot(c, stiffness * c) + dot(arm_of(i), up);
        set_worked(i, UP, up);
        if i + 1 < rest.joints {
            before = up * turn_after(i);
        }
    }
    return energy;
}

// Takes over the trial if `accepted`, and finds the next step with stiffness `1 + damping` times as great.
fn backward(accepted: bool, damping: f32) -> Backward {
    let stiffness = stiffness_of_joints();
    let damped = (1.0 + damping) * stiffness;
    var found = Backward(0.0, 0.0, 1.0, 0.0);
    var hessian = Sym3();
    // Of the model, and of the energy itself with no joint moved.
    var slope = vec3<f32>();
    var pure = vec3<f32>();
    for (var left = rest.joints; left > 0u; left--) {
        let i = left - 1u;
        var c: vec3<f32>;
        var up: vec3<f32>;
        if accepted {
            c = worked(i, TRIAL);
            up = worked(i, TRIAL_UP);
            set_control(i, c);
            set_worked(i, UP, up);
        } else {
            c = control_of(i);
            up = worked(i, UP);
        }
        let arm = arm_of(i);
        let pull = cross(arm, up);
        let g = slope + pull;
        let h = pure + pull;
        let p = plus_diagonal(plus_outer(hessian, 0.5 * arm, up), vec3(-dot(arm, up)));

        let table = table_of(c);
        let j = jacobian(table, c);
        let bent = stiffness * c;
        let residue = g * j + bent;
        let exact = h * j + bent;
        found.gradient = max(found.gradient, dot(exact, exact));
        found.turned = max(found.turned, dot(c, c));

        let model = joint_model(table, c, j, g, p);
        let factor = factor_of(plus_diagonal(model.block, damped));
        found.pivot = min(found.pivot, factor.least);
        let lowered = lower(factor, residue);
        let q = lowered * factor.inverse;
        found.decrease += 0.5 * dot(lowered, q);
        let m = lower_rows(factor, model.rows);
        set_worked(i, STEP, raise(factor, q));
        set_gain(i, raise_rows(factor, m));

        if i == 0u {
            break;
        }
        let slope_before = g - m * q;
        let d = factor.inverse;
        var hessian_before = minus_square(p, d.x, m[0]);
        hessian_before = minus_square(hessian_before, d.y, m[1]);
        hessian_before = minus_square(hessian_before, d.z, m[2]);
        let back = turn_after(i - 1u) * rotation(table, c);
        slope = back * slope_before;
        pure = back * h;
        hessian = between(hessian_before, transpose(back));
    }
    return found;
}

// Tries the step, and gives the energy there, but for what no joint can change.
fn forward() -> f32 {
    let stiffness = stiffness_of_joints();
    var energy = 0.0;
    var before = root_up();
    for (var i = 0u; i < rest.joints; i++) {
        let was = control_of(i);
        let seen = turned_back(table_of(was), was, before);
        let off = cross(seen, worked(i, UP));
        var answer = off * gain_of(i) + worked(i, STEP);
        let square = dot(answer, answer);
        if square > LARGEST_TURN * LARGEST_TURN {
            answer *= LARGEST_TURN / sqrt(square);
        }
        let c = was - answer;
        let up = turned_back(table_of(c), c, before);
        energy += 0.5 * dot(c, stiffness * c) + dot(arm_of(i), up);
        set_worked(i, TRIAL, c);
        set_worked(i, TRIAL_UP, up);
        if i + 1 < rest.joints {
            before = up * turn_after(i);
        }
    }
    return energy;
}
