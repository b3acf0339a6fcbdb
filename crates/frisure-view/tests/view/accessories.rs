//! What holds hair has its own colour, in the view as in the preview.

use frisure_look::{Camera, Lights};
use frisure_render::preview;
use frisure_strands::{AccessoryMaterial, AccessoryMesh, Strands, Surface};
use frisure_view::{Frame, Skin};
use glam::{DVec3, Vec3};

use crate::wig;

const SIZE: [u32; 2] = [128, 128];

/// The mean colour (sRGB, 0 to 255) of the middle of a picture.
fn middle(rgba: &[u8]) -> Vec3 {
    let rows = 60..68;
    let pixels = rows.flat_map(|y| (60..68).map(move |x| 4 * (y * 128 + x)));
    let sum: Vec3 = pixels.map(|i| Vec3::from([0, 1, 2].map(|c| f32::from(rgba[i + c])))).sum();
    sum / 64.0
}

#[test]
fn an_accessory_before_the_head_has_the_colour_that_the_preview_gives_it() {
    let Some(gpu) = crate::gpu() else { return };
    let (ball, strands) = (wig::ball(), Strands::new());
    let material =
        AccessoryMaterial { name: "felt", colour: [0.05, 0.3, 0.1], gloss: 0.05, roughness: 0.5 };
    let (low, high) = ball.bounds();
    let centre = 0.5 * (low + high);
    let larger: Vec<DVec3> =
        ball.positions().iter().map(|p| centre + 1.1 * (*p - centre)).collect();
    let surface = Surface::new(larger, ball.triangles().to_vec()).unwrap();
    let accessories = [AccessoryMesh { name: "cover_0".into(), material, surface }];
    let mut scene = frisure_render::Scene::portrait(&strands, Some(&ball));
    scene.accessories = &accessories;
    scene.camera = Camera::framing(ball.bounds(), 0.4, 0.1, 1.0);
    scene.lights = Lights::studio(&scene.camera);
    let (renderer, device, queue) = (&gpu.renderer, &gpu.device, &gpu.queue);
    let skin = Skin::with_accessories(renderer, device, queue, &ball, &accessories);
    let bare = Skin::new(renderer, device, queue, &ball);
    let empty = Frame::new(scene.camera, &scene.lights, &scene.look);
    let view = |skin: &Skin| {
        middle(&gpu.picture(&Frame { skin: Some(skin), ..empty.clone() }, SIZE).unwrap())
    };
    let options = preview::PreviewOptions { width: 128, height: 128, ..Default::default() };
    let shown = middle(&preview::render(&scene, &options, &()).unwrap().to_srgb8());
    let apart = (view(&skin) - shown).abs().max_element();
    assert!(apart < 8.0, "{} {shown}", view(&skin));
    assert!(shown.y > 1.5 * shown.x, "green: {shown}");
    assert!(view(&bare).x > view(&bare).y, "skin: {}", view(&bare));
}
