// Layers of a density map: from the first hair of each texel on, farther apart the deeper they are.

// Distance of the second layer (m) over that of the third from it, less 1: layers at A (R^k - 1).
const LAYER_A: f32 = 0.006;
const LAYER_LOG_R: f32 = 0.24686;
const LAST_LAYER: f32 = 15.0;

// Layer at a distance behind the first hair (m); evenly spaced before it.
fn layer(distance: f32) -> f32 {
    let behind = log(1.0 + max(distance, 0.0) / LAYER_A);
    return (behind + min(distance, 0.0) / LAYER_A) / LAYER_LOG_R;
}
