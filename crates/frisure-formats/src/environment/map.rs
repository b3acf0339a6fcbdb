//! An environment map in memory, and the sizes that one can have.

/// Most pixels across and down.
const MOST: [usize; 2] = [16_384, 8192];

/// An equirectangular picture of everything around, its upper edge straight above.
#[derive(Clone, Debug, PartialEq)]
pub struct Environment {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// Radiance of each pixel, linear sRGB, row by row from the top; finite and not negative.
    pub pixels: Vec<[f32; 3]>,
}

/// Refuses sizes that no environment has, and more pixels than `most`, for which there is memory.
pub(super) fn check_size(width: usize, height: usize, most: usize) -> Result<(), String> {
    let [across, down] = MOST;
    if width > across || height > down {
        return Err(format!(
            "has {width} x {height} pixels; an environment has at most {across} x {down}"
        ));
    }
    if width * height > most {
        return Err(format!(
            "has {width} x {height} pixels; at most {most} have room in the memory that is free"
        ));
    }
    // Programs differ by a pixel.
    let ratio = width as f64 / height.max(1) as f64;
    if height == 0 || (width.abs_diff(2 * height) > 2 && !(1.9..=2.1).contains(&ratio)) {
        return Err(format!(
            "has {width} x {height} pixels; an environment is twice as wide as it is high"
        ));
    }
    Ok(())
}
