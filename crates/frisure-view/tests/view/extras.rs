//! Shares, marks, lines and planes.

use frisure_look::{Camera, Lights, Look};
use frisure_strands::{Strands, Surface};
use frisure_view::{Frame, Hair, Line, Mark, Plane, Skin};
use glam::Vec3;

use crate::Turn;
use crate::support::measure::compare;
use crate::wig::{self, Style};

const SIZE: [u32; 2] = [128, 128];

struct Scene {
    gpu: Turn,
    hair: Hair,
    skin: Skin,
    camera: Camera,
    lights: Lights,
    look: Look,
}

impl Scene {
    fn new(strands: &Strands, ball: &Surface) -> Option<Self> {
        let gpu = crate::gpu()?;
        let (device, queue, look) = (&gpu.device, &gpu.queue, Look::default());
        let camera =
            Camera::framing(frisure_render::framed_bounds(strands, Some(ball)), 0.4, 0.1, 1.0);
        let hair = Hair::new(&gpu.renderer, device, queue, strands, &look.hair);
        let skin = Skin::new(&gpu.renderer, device, queue, ball);
        Some(Self { gpu, hair, skin, camera, lights: Lights::studio(&camera), look })
    }

    fn wig() -> Option<Self> {
        Self::new(&wig::strands(&Style::STRAIGHT, 2000, 16), &wig::ball())
    }

    fn frame(&self) -> Frame<'_> {
        let (hair, skin) = (Some(&self.hair), Some(&self.skin));
        Frame { hair, skin, ..Frame::new(self.camera, &self.lights, &self.look) }
    }

    fn draw(&self, frame: &Frame<'_>) -> Vec<u8> {
        self.gpu.picture(frame, SIZE).unwrap()
    }

    fn bare(&self) -> Frame<'_> {
        Frame { hair: None, skin: None, ..self.frame() }
    }
}

/// Mean red, green, blue of a part of the rows.
fn mean(picture: &[u8], rows: std::ops::Range<usize>) -> [f64; 3] {
    let part = &picture[rows.start * 512..rows.end * 512];
    let sum = |c: usize| part.chunks(4).map(|pixel| f64::from(pixel[c])).sum::<f64>();
    [0, 1, 2].map(|c| sum(c) / (part.len() / 4) as f64)
}

#[test]
fn a_quarter_of_the_hair_looks_like_all_of_it() {
    let Some(scene) = Scene::wig() else { return };
    let whole = scene.draw(&scene.frame());
    let quarter = scene.draw(&Frame { share: 0.25, ..scene.frame() });
    let d = compare(&whole, &quarter, &scene.draw(&scene.bare()), SIZE);
    for (a, b) in d.means[0].iter().zip(&d.means[1]) {
        assert!((b / a - 1.0).abs() < 0.05, "{d:?}");
    }
}

#[test]
fn chosen_hair_turns_towards_its_colour_and_back() {
    let Some(mut scene) = Scene::wig() else { return };
    let before = scene.draw(&scene.frame());
    scene.hair.mark(&scene.gpu.queue, &[Mark { chosen: true, ..Mark::default() }; 2000]);
    let chosen = scene.draw(&scene.frame());
    let (a, b) = (mean(&before, 20..60), mean(&chosen, 20..60));
    assert!(b[2] - b[0] > a[2] - a[0] + 10.0, "{a:?} {b:?}");
    scene.hair.mark(&scene.gpu.queue, &[]);
    assert_eq!(scene.draw(&scene.frame()), before);
}

#[test]
fn what_falls_is_red_and_what_stays_is_not() {
    let Some(mut scene) = Scene::wig() else { return };
    let before = scene.draw(&scene.frame());
    scene.hair.mark(&scene.gpu.queue, &[Mark { falls_from: 0.6, ..Mark::default() }; 2000]);
    let marked = scene.draw(&scene.frame());
    let redder = |rows: std::ops::Range<usize>| {
        let (a, b) = (mean(&before, rows.clone()), mean(&marked, rows));
        (b[0] - b[1]) - (a[0] - a[1])
    };
    assert!(redder(0..30).abs() < 1.0, "{}", redder(0..30));
    assert!(redder(80..120) > 2.0, "{}", redder(80..120));
}

#[test]
fn lines_are_hidden_by_the_head_unless_on_top() {
    let Some(scene) = Scene::wig() else { return };
    let away = scene.camera.forward().as_vec3();
    let right = scene.camera.right().as_vec3();
    let line = |place: Vec3, on_top: bool| Line {
        from: place - 0.2 * right,
        to: place + 0.2 * right,
        width: 3.0,
        colour: [0.0, 1.0, 0.0, 1.0],
        on_top,
    };
    let green = |line: Line| {
        let picture = scene.draw(&Frame { lines: &[line], hair: None, ..scene.frame() });
        picture.chunks(4).filter(|p| p[1] > 200 && p[0] < 60 && p[2] < 60).count()
    };
    let (near, far) = (green(line(-0.2 * away, false)), green(line(0.2 * away, false)));
    assert!(near > 300, "{near}");
    assert!(far < near * 3 / 4 && far > 30, "{near} {far}");
    let over = green(line(0.2 * away, true));
    assert!(over > far + 40, "{over} {far}");
}

#[test]
fn a_plane_tints_what_is_behind_it() {
    let Some(scene) = Scene::wig() else { return };
    let away = scene.camera.forward().as_vec3();
    let green = [0.0, 1.0, 0.0, 0.5];
    let tinted = |distance: f32| {
        let plane = Plane::across(distance * away, away, 0.5, green);
        let frame = Frame { planes: &[plane], ..scene.frame() };
        let picture = scene.draw(&frame);
        let middle = &picture[(36 * 128 + 64) * 4..][..3];
        let corner = &picture[..3];
        [middle, corner].map(|p| f64::from(p[1]) - 0.5 * (f64::from(p[0]) + f64::from(p[2])))
    };
    let (before, behind) = (tinted(-0.3), tinted(0.3));
    assert!(before[0] > 60.0 && before[1] > 60.0, "{before:?}");
    assert!(behind[0] < 30.0 && behind[1] > 60.0, "{behind:?}");
}
