//! Twist-free frames along a line: R. L. Bishop, *There is more than one way to frame a curve*, Amer. Math. Monthly 82 (1975).

use glam::{DMat3, DQuat, DVec3};

/// Twist-free (Bishop) frames with these unit tangents: columns d1, d2, t, each frame turned from the one before by the smallest
/// rotation between their tangents.
///
/// ```
/// use frisure_rod::twist_free_frames;
/// use glam::DVec3;
///
/// let frames = twist_free_frames(&[DVec3::Z, DVec3::X, DVec3::NEG_Z]);
/// assert!(frames[2].z_axis.distance(DVec3::NEG_Z) < 1e-12);
/// // The axis of bending stays.
/// assert!(frames.iter().all(|f| (f.transpose() * DVec3::Y).distance(frames[0].transpose() * DVec3::Y) < 1e-12));
/// ```
///
/// # Panics
/// If there is no tangent.
#[must_use]
pub fn twist_free_frames(tangents: &[DVec3]) -> Vec<DMat3> {
    let first = tangents[0];
    let d1 = first.any_orthonormal_vector();
    let mut frame = DMat3::from_cols(d1, first.cross(d1), first);
    let mut frames = vec![frame];
    for pair in tangents.windows(2) {
        // The smallest rotation from one tangent to the next, then d1 made orthogonal again.
        frame = DMat3::from_quat(DQuat::from_rotation_arc(pair[0], pair[1])) * frame;
        let (t, d1) = (pair[1], frame.x_axis);
        let d1 = (d1 - t * t.dot(d1)).normalize();
        frame = DMat3::from_cols(d1, t.cross(d1), t);
        frames.push(frame);
    }
    frames
}

/// The turns about d1 and d2 (rad) from each frame to the next.
#[must_use]
pub fn bending(frames: &[DMat3]) -> Vec<(f64, f64)> {
    let turn = |pair: &[DMat3]| {
        let turn = DQuat::from_mat3(&(pair[0].transpose() * pair[1])).to_scaled_axis();
        (turn.x, turn.y)
    };
    frames.windows(2).map(turn).collect()
}
