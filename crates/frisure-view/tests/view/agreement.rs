//! The view and the preview show the same hair.

use frisure_look::Melanin;
use frisure_look::{Camera, Lights};
use frisure_render::preview;
use frisure_strands::{Attribute, AttributeValues, Domain, Features, Strands, Surface};
use frisure_view::{Frame, Hair, Skin};
use glam::Vec3;

use crate::support::measure::{Difference, compare};
use crate::wig::{self, Style};

const SIZE: [u32; 2] = [256, 256];

/// Draws a wig both ways, on a ball.
fn difference(
    strands: &Strands,
    ball: &Surface,
    melanin: Melanin,
    azimuth: f64,
) -> Option<Difference> {
    let gpu = crate::gpu()?;
    let mut scene = frisure_render::Scene::portrait(strands, Some(ball));
    scene.camera =
        Camera::framing(frisure_render::framed_bounds(strands, Some(ball)), azimuth, 0.1, 1.0);
    scene.lights = Lights::studio(&scene.camera);
    scene.look.hair.melanin = melanin;
    let all = scene.all_hair();
    let hair = Hair::new(&gpu.renderer, &gpu.device, &gpu.queue, &all, &scene.look.hair);
    let skin = Skin::new(&gpu.renderer, &gpu.device, &gpu.queue, ball);
    let empty = Frame::new(scene.camera, &scene.lights, &scene.look);
    let frame = Frame { hair: Some(&hair), skin: Some(&skin), ..empty.clone() };
    let view = gpu.picture(&frame, SIZE).unwrap();
    let options = preview::PreviewOptions { width: 256, height: 256, ..Default::default() };
    let image = preview::render(&scene, &options, &()).unwrap();
    Some(compare(&image.to_srgb8(), &view, &gpu.picture(&empty, SIZE).unwrap(), SIZE))
}

/// Mean colours within 7 in a hundred, the root mean square of blocks' luminances within 0.012 of white, what
/// is covered within 0.4 in a hundred of the picture.
fn assert_alike(what: &str, strands: &Strands, melanin: Melanin, azimuth: f64) {
    let Some(d) = difference(strands, &wig::ball(), melanin, azimuth) else { return };
    for (a, b) in d.means[0].iter().zip(&d.means[1]) {
        assert!((b / a - 1.0).abs() < 0.07, "{what}: {d:.4?}");
    }
    assert!(d.blocks[0] < 0.012 && d.blocks[1] < 0.12, "{what}: {d:.4?}");
    assert!((d.covered[0] - d.covered[1]).abs() < 0.004, "{what}: {d:.4?}");
}

fn wig(style: &Style) -> Strands {
    wig::strands(style, 4000, 24)
}

#[test]
fn straight_brown_hair_from_the_front() {
    assert_alike("front", &wig(&Style::STRAIGHT), Melanin::BROWN, 0.4);
}

#[test]
fn straight_blond_hair_from_behind() {
    assert_alike("behind", &wig(&Style::STRAIGHT), Melanin::BLOND, 3.0);
}

#[test]
fn curly_black_hair_from_the_side() {
    assert_alike("side", &wig(&Style::CURLY), Melanin::BLACK, 1.6);
}

#[test]
fn curly_white_hair_from_the_front() {
    assert_alike("white", &wig(&Style::CURLY), Melanin::WHITE, -0.5);
}

#[test]
fn wet_wavy_hair() {
    let mut strands = wig(&Style::WAVY);
    let values = AttributeValues::F32(vec![1.0; strands.points().len()]);
    let wetness = Attribute { name: "wetness".into(), domain: Domain::Point, values };
    strands.set_attribute(wetness).unwrap();
    assert_alike("wet", &strands, Melanin::BROWN, -0.8);
}

/// However few hairs the head has, for which the view draws each wider.
#[test]
fn brows_of_a_head_with_one_hair() {
    let brows = Features { hairs: wig::strands(&Style::STRAIGHT, 400, 24), ..Features::default() };
    let ball = wig::ball().with_features(brows).unwrap();
    let mut hidden = Strands::new();
    hidden.push(&[Vec3::ZERO, Vec3::Z * 0.01], &[1e-5; 2]);
    let Some(d) = difference(&hidden, &ball, Melanin::BLOND, 0.4) else { return };
    assert!(d.covered[0] > 0.01, "{d:.4?}");
    assert!((d.covered[0] / d.covered[1] - 1.0).abs() < 0.1, "{d:.4?}");
}
