// Closes the pixels that let nothing through any more. Needs `common`.

@group(1) @binding(0) var hair: texture_2d<f32>;

// Coverage at which a pixel counts as finished. Chosen by eye.
const FINISHED: f32 = 0.995;

@vertex
fn at_depth(@builtin(vertex_index) corner: u32, @location(0) depth: f32) -> @builtin(position) vec4<f32> {
    return vec4<f32>(everything(corner).xy, buffer_depth(max(depth, NEAR)), 1.0);
}

@fragment
fn close(@builtin(position) at: vec4<f32>) {
    if textureLoad(hair, vec2<i32>(at.xy), 0).a < FINISHED {
        discard;
    }
}
