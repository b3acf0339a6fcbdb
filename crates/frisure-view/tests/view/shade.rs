//! Hair takes light from hair, as the law of Beer and Lambert has it.

use frisure_look::Melanin;
use frisure_look::{Background, Camera, DistantLight, HairLook, Lights, Look, ToneCurve};
use frisure_render::preview::chosen_width;
use frisure_strands::Strands;
use frisure_view::{Frame, Hair};
use glam::{DVec3, Vec3};

use crate::support::measure::linear;

const SIZE: [u32; 2] = [48, 48];
/// Hairs in a row of 8 cm, and the width of each (m): a row keeps a tenth of the light.
const COLUMNS: u16 = 80;
const WIDTH: f32 = 1e-4;
/// Distance of one row from the next (m).
const ABOVE: f32 = 0.8e-3;

/// Rows of parallel hairs above each other, in no order across.
fn block(rows: u16) -> Strands {
    let factor = chosen_width(usize::from(rows * COLUMNS));
    let mut strands = Strands::new();
    for row in 0..rows {
        for column in 0..COLUMNS {
            let place = f32::from(row * COLUMNS + column) * 0.618_034;
            let at = |x: f32| Vec3::new(x, 0.08 * (place.fract() - 0.5), f32::from(row) * ABOVE);
            strands.push(&[at(-0.04), at(0.0), at(0.04)], &[0.5 * WIDTH / factor; 3]);
        }
    }
    strands
}

/// Light that the underside sends downwards while a lamp shines from above.
fn below(rows: u16) -> Option<f64> {
    let gpu = crate::gpu()?;
    let melanin = Melanin { eumelanin: 30.0, pheomelanin: 0.0 };
    let black = HairLook { melanin, ..HairLook::default() };
    let hair = Hair::new(&gpu.renderer, &gpu.device, &gpu.queue, &block(rows), &black);
    let camera = Camera::look_at(DVec3::NEG_Z, DVec3::ZERO, DVec3::Y, 0.03).unwrap();
    let lamp = DistantLight::new(DVec3::Z, Vec3::splat(60.0), 0.0).unwrap();
    let lights = Lights { lamps: vec![lamp.into()], ..Lights::dark() };
    let look = Look { background: Background::Transparent, ..Look::default() };
    let frame = Frame {
        hair: Some(&hair),
        tone: ToneCurve::Plain,
        stops: 3.0,
        ..Frame::new(camera, &lights, &look)
    };
    let picture = gpu.picture(&frame, SIZE).unwrap();
    let light = picture.chunks(4).map(|p| linear(p[1]) * f64::from(p[3]) / 255.0);
    Some(light.sum::<f64>() / picture.chunks(4).map(|p| f64::from(p[3]) / 255.0).sum::<f64>())
}

/// Each depth x of h hairs sends light that has met h − x of them on its way there and x on its way to the eye:
/// h e^−h in all.
#[test]
fn light_falls_with_the_hair_it_has_met() {
    let light = [20, 30, 40, 50].map(below);
    for (i, (less, more)) in [(2.0, 3.0), (3.0, 4.0), (4.0, 5.0_f64)].into_iter().enumerate() {
        let (Some(a), Some(b)) = (light[i], light[i + 1]) else { return };
        let (found, expected) = ((a / b).ln(), (more - less) - (more / less).ln());
        assert!((found - expected).abs() < 0.12, "{less} to {more}: {found} for {expected}");
    }
}
