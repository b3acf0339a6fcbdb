// A hair on its way to rest, one in each invocation: frisure-rod's `batch/settle.rs`. What is given up here is no answer; the
// judge begins it anew.

// Damping after a first failed pivot or a step that went up, as a fraction of the stiffness.
const FIRST_DAMPING: f32 = 0.3;
// Least factor by which damping grows, and what it shrinks to after a step that was taken; below the least it is none.
const GROWTH: f32 = 4.0;
const SHRINKING: f32 = 0.2;
const LEAST_DAMPING: f32 = 0.01;
// How much more than what failed lately damping stays, what of that is left after each step that was taken, and below which
// it is forgotten.
const ABOVE_BAD: f32 = 1.5;
const FADING: f32 = 0.25;
const FORGOTTEN: f32 = 0.05;
// Largest factor by which damping grows at once.
const MOST_GROWTH: f32 = 16.0;
// Damping from which on a hair is given up.
const LARGEST_DAMPING: f32 = 1e9;
// Part of the expected decrease that a step has to reach.
const ENOUGH: f32 = 1e-4;
// Relative error of an energy.
const NOISE: f32 = 1e-6;

// After a step that failed, or a pivot that is negative by `lacking`: it takes that much stiffness at least.
fn stiffen(given: Progress, lacking: f32) -> Progress {
    var now = given;
    now.bad = now.damping;
    let least = max(FIRST_DAMPING, GROWTH * now.damping);
    if now.good > 2.0 * now.damping {
        now.damping = max(sqrt(now.good * max(now.damping, FORGOTTEN)), FIRST_DAMPING);
    } else {
        let stiffness = stiffness_of_joints();
        let weakest = min(stiffness.x, min(stiffness.y, stiffness.z));
        let most = MOST_GROWTH * max(FIRST_DAMPING, now.damping);
        now.damping = max(min(lacking / weakest, most), least);
    }
    return now;
}

// After a step that was taken. What was not stiff enough a step ago is not tried again at once.
fn soften(given: Progress) -> Progress {
    var now = given;
    now.good = now.damping;
    now.bad *= FADING;
    let softer = max(SHRINKING * now.damping, select(ABOVE_BAD * now.bad, 0.0, now.bad < FORGOTTEN));
    now.damping = select(min(softer, now.damping), 0.0, softer < LEAST_DAMPING);
    return now;
}

@compute @workgroup_size(64)
fn settle(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= rest.hairs {
        return;
    }
    hair = order[id.x];
    var now = progress[hair];
    if now.state == FRESH {
        now = Progress(begin(), 0.0, 0.0, 0.0, 0u, STAYED);
    }
    for (var k = 0u; k < rest.sweeps; k++) {
        let found = backward(now.state == MOVED, now.damping);
        now.state = STAYED;
        let positive = found.pivot > 0.0;
        let at_rest = found.gradient <= rest.tolerance * rest.tolerance;
        let undamped = now.damping == 0.0;
        if at_rest && undamped && positive {
            now.state = SETTLED;
            break;
        }
        if !(found.turned < LARGEST_SQUARE)
            || now.damping > LARGEST_DAMPING
            || now.sweeps >= rest.most
            || (at_rest && undamped) {
            now.state = LOST;
            break;
        }
        now.sweeps += 1u;
        if at_rest {
            // Only the undamped sweep tells what kind of rest it is.
            now.damping = 0.0;
        } else if !positive {
            now = stiffen(now, -found.pivot);
        } else {
            let tried = forward();
            let noise = NOISE * max(abs(now.energy), abs(constant_energy()));
            let down = tried <= now.energy - ENOUGH * found.decrease
                || (found.decrease < noise && tried <= now.energy + noise);
            if down {
                now.state = MOVED;
                now.energy = tried;
                now = soften(now);
            } else {
                now = stiffen(now, 0.0);
            }
        }
    }
    progress[hair] = now;
}
