// What hairs are, and how far each has come. Hairs are in blocks of 64, one for each invocation of a workgroup: in a block,
// first one number of each hair, then the next of each, so that invocations side by side read side by side.
//
// Moments are in units of the hair's own (EI/L + ρSg L², with the largest stiffness), energies in the same.

struct Rest {
    // How many of `order` are to come to rest.
    hairs: u32,
    // Joints of each hair.
    joints: u32,
    // Turns of frames that are stored of each hair: one for all, or one after each joint.
    turns: u32,
    // Sweeps in this dispatch, and of a hair in all.
    sweeps: u32,
    most: u32,
    // Gradient at rest.
    tolerance: f32,
}

// How far a hair has come.
struct Progress {
    energy: f32,
    // Of the stiffness; and with how much the last step that was taken was, and the last that was not.
    damping: f32,
    good: f32,
    bad: f32,
    sweeps: u32,
    state: u32,
}

// Nothing is done yet; the last trial was not taken, or was; at rest; given up.
const FRESH: u32 = 0;
const STAYED: u32 = 1;
const MOVED: u32 = 2;
const SETTLED: u32 = 3;
const LOST: u32 = 4;

@group(0) @binding(0) var<uniform> rest: Rest;
// Hairs that are still on the way.
@group(0) @binding(1) var<storage, read> order: array<u32>;
// ζ before the first joint, K, and what no joint can change.
@group(0) @binding(2) var<storage, read> roots: array<f32>;
// a of each joint.
@group(0) @binding(3) var<storage, read> arms: array<f32>;
// C, by columns.
@group(0) @binding(4) var<storage, read> turns: array<f32>;
// c of each joint.
@group(0) @binding(5) var<storage, read_write> controls: array<f32>;
// Of each joint: up, the trial's turn and up, the step, its gain.
@group(0) @binding(6) var<storage, read_write> work: array<f32>;
@group(0) @binding(7) var<storage, read_write> progress: array<Progress>;

const LANES: u32 = 64;
const OF_ROOT: u32 = 7;
const OF_WORK: u32 = 21;
const UP: u32 = 0;
const TRIAL: u32 = 3;
const TRIAL_UP: u32 = 6;
const STEP: u32 = 9;
const GAIN: u32 = 12;

// The hair of this invocation.
var<private> hair: u32;

// Where number `k` of the hair is, among `of` of each.
fn place(of_hair: u32, k: u32) -> u32 {
    return (hair / LANES * of_hair + k) * LANES + hair % LANES;
}

fn root_numbers(k: u32) -> vec3<f32> {
    let at = place(OF_ROOT, k);
    return vec3(roots[at], roots[at + LANES], roots[at + 2 * LANES]);
}

fn root_up() -> vec3<f32> {
    return root_numbers(0u);
}

fn stiffness_of_joints() -> vec3<f32> {
    return root_numbers(3u);
}

fn constant_energy() -> f32 {
    return roots[place(OF_ROOT, 6u)];
}

fn arm_of(joint: u32) -> vec3<f32> {
    let at = place(3 * rest.joints, 3 * joint);
    return vec3(arms[at], arms[at + LANES], arms[at + 2 * LANES]);
}

fn turn_column(turn: u32, column: u32) -> vec3<f32> {
    let at = place(9 * rest.turns, 9 * turn + 3 * column);
    return vec3(turns[at], turns[at + LANES], turns[at + 2 * LANES]);
}

// C after a joint.
fn turn_after(joint: u32) -> mat3x3<f32> {
    let turn = select(joint, 0u, rest.turns == 1u);
    return mat3x3<f32>(turn_column(turn, 0u), turn_column(turn, 1u), turn_column(turn, 2u));
}

fn control_of(joint: u32) -> vec3<f32> {
    let at = place(3 * rest.joints, 3 * joint);
    return vec3(controls[at], controls[at + LANES], controls[at + 2 * LANES]);
}

fn set_control(joint: u32, c: vec3<f32>) {
    let at = place(3 * rest.joints, 3 * joint);
    controls[at] = c.x;
    controls[at + LANES] = c.y;
    controls[at + 2 * LANES] = c.z;
}

fn worked(joint: u32, which: u32) -> vec3<f32> {
    let at = place(OF_WORK * rest.joints, OF_WORK * joint + which);
    return vec3(work[at], work[at + LANES], work[at + 2 * LANES]);
}

fn set_worked(joint: u32, which: u32, v: vec3<f32>) {
    let at = place(OF_WORK * rest.joints, OF_WORK * joint + which);
    work[at] = v.x;
    work[at + LANES] = v.y;
    work[at + 2 * LANES] = v.z;
}

// By rows.
fn gain_of(joint: u32) -> mat3x3<f32> {
    return mat3x3<f32>(
        worked(joint, GAIN),
        worked(joint, GAIN + 3),
        worked(joint, GAIN + 6),
    );
}

fn set_gain(joint: u32, gain: mat3x3<f32>) {
    set_worked(joint, GAIN, gain[0]);
    set_worked(joint, GAIN + 3, gain[1]);
    set_worked(joint, GAIN + 6, gain[2]);
}
