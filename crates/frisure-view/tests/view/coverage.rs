//! A hair covers as much as it is wide.

use frisure_look::{Background, Camera, HairLook, Lights, Look};
use frisure_strands::Strands;
use frisure_view::{Frame, Hair};
use glam::{DVec3, Vec3};

const SIZE: [u32; 2] = [128, 128];
/// Factor on the width of a lonely hair.
const WIDER: f32 = 6.0;

/// Pixels that a hair of a true width (pixels) covers in all, for each pixel of its length.
fn covered(width: f32, angle: f32, offset: f32) -> Option<f32> {
    let gpu = crate::gpu()?;
    let camera = Camera::look_at(DVec3::NEG_Y, DVec3::ZERO, DVec3::Z, 0.2).unwrap();
    // Metres in a pixel, a metre away.
    let pixel = 2.0 * 0.1_f32.tan() / 128.0;
    let (sine, cosine) = angle.sin_cos();
    let at =
        |s: f32| Vec3::new(s * cosine - offset * sine, 0.0, s * sine + offset * cosine) * pixel;
    let mut strands = Strands::new();
    let points: Vec<Vec3> = (0..=8_u8).map(|i| at(10.0 * f32::from(i) - 40.0)).collect();
    strands.push(&points, &[0.5 * width * pixel / WIDER; 9]);
    let hair = Hair::new(&gpu.renderer, &gpu.device, &gpu.queue, &strands, &HairLook::default());
    let look = Look { background: Background::Transparent, ..Look::default() };
    let lights = Lights::even(Vec3::ONE);
    let frame = Frame { hair: Some(&hair), ..Frame::new(camera, &lights, &look) };
    let picture = gpu.picture(&frame, SIZE).unwrap();
    let all: f32 = picture.chunks(4).map(|pixel| f32::from(pixel[3]) / 255.0).sum();
    Some(all / 80.0)
}

#[test]
fn at_any_width_angle_and_place() {
    for width in [0.1, 0.3, 0.9, 2.5] {
        for angle in [0.0, 0.3, 0.7, 1.2, std::f32::consts::FRAC_PI_2] {
            for offset in [0.0, 0.37, 0.5] {
                let Some(covered) = covered(width, angle, offset) else { return };
                // Opacity has 255 steps, and ends are rounded to whole pixels.
                let off = (covered - width).abs();
                assert!(
                    off < 0.03 * width + 0.012,
                    "{width} px at {angle} rad, {offset}: {covered}"
                );
            }
        }
    }
}
