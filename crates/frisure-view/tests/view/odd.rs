//! What makes no sense is refused or left out; nothing panics.

use frisure_look::{Camera, HairLook, Lights, Look};
use frisure_strands::Strands;
use frisure_view::{Canvas, Frame, Hair, Line, Mark, Plane, ViewError};
use glam::{DVec3, Vec3};

use crate::support::Gpu;

const SIZE: [u32; 2] = [32, 48];

fn picture(gpu: &Gpu, strands: &Strands) -> Vec<u8> {
    let (lights, look) = (Lights::default(), Look::default());
    let mut hair = Hair::new(&gpu.renderer, &gpu.device, &gpu.queue, strands, &look.hair);
    hair.mark(&gpu.queue, &[Mark { chosen: true, falls_from: f32::NAN }]);
    let lines =
        [Line { from: Vec3::NAN, to: Vec3::ZERO, width: 1.0, colour: [1.0; 4], on_top: true }];
    let planes = [Plane { centre: Vec3::ZERO, arms: [Vec3::ZERO; 2], colour: [f32::NAN; 4] }];
    let frame = Frame {
        hair: Some(&hair),
        share: f32::NAN,
        lines: &lines,
        planes: &planes,
        ..Frame::new(Camera::default(), &lights, &look)
    };
    gpu.picture(&frame, SIZE).unwrap()
}

#[test]
fn strands_that_cannot_be_drawn_are_left_out() {
    let Some(gpu) = crate::gpu() else { return };
    let empty = picture(&gpu, &Strands::new());
    assert_eq!(empty.len(), 32 * 48 * 4);
    let mut strands = Strands::new();
    strands.push(&[], &[]);
    strands.push(&[Vec3::ZERO], &[1e-5]);
    strands.push(&[Vec3::ZERO, Vec3::NAN], &[1e-5; 2]);
    strands.push(&[Vec3::ZERO, Vec3::Z], &[1e-5, f32::INFINITY]);
    assert_eq!(picture(&gpu, &strands), empty);
    // Of no length, of no width, behind the eye, and far too long: they are drawn as far as can be.
    strands.push(&[Vec3::ZERO; 3], &[1e-5; 3]);
    strands.push(&[Vec3::ZERO, Vec3::X], &[0.0, -1.0]);
    strands.push(&[Vec3::NEG_Y * 9.0, Vec3::Y * 9.0], &[1e-5; 2]);
    strands.push(&[Vec3::ZERO, Vec3::Z * 1e30], &[1e-5; 2]);
    assert_eq!(picture(&gpu, &strands).len(), empty.len());
}

#[test]
fn impossible_sizes_are_refused_and_the_canvas_stays() {
    let Some(gpu) = crate::gpu() else { return };
    let most = gpu.device.limits().max_texture_dimension_2d;
    for size in [[0, 10], [10, 0], [most + 1, 10]] {
        let refused = Canvas::new(&gpu.device, size).unwrap_err();
        assert_eq!(refused, ViewError::Size { width: size[0], height: size[1], most });
    }
    let mut canvas = Canvas::new(&gpu.device, SIZE).unwrap();
    assert!(canvas.resize(&gpu.device, [0, 0]).is_err());
    assert_eq!(canvas.size(), SIZE);
    canvas.resize(&gpu.device, [7, 5]).unwrap();
    assert_eq!(canvas.read(&gpu.device, &gpu.queue).unwrap().len(), 7 * 5 * 4);
}

#[test]
fn an_eye_in_the_hair_sees_something() {
    let Some(gpu) = crate::gpu() else { return };
    let strands = crate::wig::strands(&crate::wig::Style::CURLY, 500, 16);
    let look = Look::default();
    let hair = Hair::new(&gpu.renderer, &gpu.device, &gpu.queue, &strands, &HairLook::default());
    let camera = Camera::look_at(DVec3::new(0.0, 0.0, 0.1), DVec3::ZERO, DVec3::Y, 1.0).unwrap();
    let lights = Lights::studio(&camera);
    let frame = Frame { hair: Some(&hair), ..Frame::new(camera, &lights, &look) };
    let seen = gpu.picture(&frame, SIZE).unwrap();
    assert_ne!(seen, gpu.picture(&Frame { hair: None, ..frame.clone() }, SIZE).unwrap());
}

#[test]
fn a_lost_device_is_an_error() {
    // Its own: the others go on.
    let Some(_turn) = crate::gpu() else { return };
    let Some(gpu) = Gpu::new() else { return };
    let (lights, look) = (Lights::default(), Look::default());
    let mut canvas = Canvas::new(&gpu.device, SIZE).unwrap();
    gpu.draw(&mut canvas, &Frame::new(Camera::default(), &lights, &look));
    gpu.device.destroy();
    gpu.draw(&mut canvas, &Frame::new(Camera::default(), &lights, &look));
    let read = canvas.read(&gpu.device, &gpu.queue);
    assert!(matches!(read, Err(ViewError::Lost(_))), "{read:?}");
}
