//! Every other order: wisps, one hair, files, pictures, turntables.

mod common;

use std::sync::Mutex;

use common::{CURLY, Counted, asked, exact, refused};
use frisure_stylist::order::{Answer, Effort, Order, Refusal, Viewpoint};
use frisure_stylist::{Stylist, Watch};

fn file(answer: Answer) -> (String, Vec<u8>) {
    match answer {
        Answer::File { name, bytes } => (name, bytes),
        other => panic!("{other:?}"),
    }
}

fn order(stylist: &mut Stylist, order: &Order) -> Answer {
    stylist.carry_out(order, &())
}

#[test]
fn a_step_chooses_wisps_and_says_what_is_wrong_with_it() {
    let mut stylist = Stylist::new();
    let choose = |step: &str| Order::Choose { asked: asked(CURLY, 0), step: step.into() };
    let mut chosen = |step: &str| match order(&mut stylist, &choose(step)) {
        Answer::Chosen(wisps) => wisps,
        other => panic!("{other:?}"),
    };
    let all = chosen("wet = {}");
    assert!(all.len() == 24 && all.iter().all(|c| *c));
    let back = chosen("cut = { length = '5 cm', where = 'back' }");
    assert!(back.contains(&true) && back.contains(&false));
    assert_eq!(chosen("wet = { where = { wisps = [3] } }").iter().filter(|c| **c).count(), 1);
    assert_eq!(chosen("humidity = 0.9").len(), 24);
    let wrong = refused(order(&mut stylist, &choose("wet = { whare = 'back' }")));
    assert!(wrong.line == 1 && wrong.hint.contains("where"), "{wrong:?}");
    let nobody = refused(order(&mut stylist, &choose("wet = { where = { wisps = [99] } }")));
    assert!(nobody.problem.contains("99"), "{nobody:?}");
}

#[test]
fn one_hair_has_its_frames_and_numbers() {
    let mut stylist = Stylist::new();
    let hair = |wisp| Order::Hair { asked: asked(CURLY, 0), wisp, points: 30 };
    let Answer::Hair(one) = order(&mut stylist, &hair(5)) else { panic!() };
    assert_eq!((one.points.len(), one.frames.len(), one.wisp), (30, 30, 5));
    let dot = |a: [f32; 3], b: [f32; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f32>();
    for frame in &one.frames {
        for i in 0..3 {
            for j in 0..3 {
                let expected = if i == j { 1.0 } else { 0.0 };
                assert!((dot(frame[i], frame[j]) - expected).abs() < 1e-5);
            }
        }
    }
    let along: f64 = one
        .points
        .windows(2)
        .map(|p| {
            let d = [0, 1, 2].map(|i| p[1][i] - p[0][i]);
            f64::from(dot(d, d).sqrt())
        })
        .sum();
    assert!(along < 1.001 * one.length && along > 0.9 * one.length, "{along} of {}", one.length);
    assert!(one.energy[0] > 0.0 && one.section[0] >= one.section[1] && one.elements == 12);
    assert!(refused(order(&mut stylist, &hair(24))).problem.contains("24"));
}

#[test]
fn a_groom_is_what_the_command_line_writes() {
    let mut stylist = Stylist::new();
    let groom = |format: &str| Order::Groom { asked: asked(CURLY, 0), format: format.into() };
    let folder = tempfile::tempdir().unwrap();
    for format in ["hair", "obj", "ply"] {
        let (name, bytes) = file(order(&mut stylist, &groom(format)));
        assert_eq!(name, format!("small.{format}"));
        let path = folder.path().join(&name);
        let scene = frisure::scene::Scene::parse("s", CURLY, "".as_ref()).unwrap();
        let head = frisure::hairstyle::head::Head::mannequin();
        use frisure::hairstyle::{PredictOptions, StrandOptions, predict, strands};
        let hair = predict(&scene.hairstyle_spec().unwrap(), &head, PredictOptions::default(), &())
            .unwrap();
        let strands = strands(&hair, &head, StrandOptions::default(), &()).unwrap().strands;
        let groom = frisure_stylist::groom::groom(&scene, &hair, &head, strands, false);
        frisure::formats::groom::write_groom(&path, &groom, Default::default()).unwrap();
        assert_eq!(std::fs::read(path).unwrap(), bytes);
    }
    assert!(refused(order(&mut stylist, &groom("png"))).problem.contains(".ply"));
}

/// Keeps what it is told.
#[derive(Default)]
struct Told(Mutex<Vec<Answer>>);

impl Watch for Told {
    fn tell(&self, answer: Answer) {
        self.0.lock().unwrap().push(answer);
    }

    fn cancelled(&self) -> bool {
        false
    }
}

fn picture(viewpoint: Option<Viewpoint>, size: [usize; 2], paths: usize) -> Order {
    Order::Picture { asked: asked(CURLY, 0), viewpoint, size, paths, noise: 0.0 }
}

fn decoded(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut pixels).unwrap();
    (frame.width, frame.height, pixels)
}

#[test]
fn a_picture_is_traced_from_anywhere() {
    let mut stylist = Stylist::new();
    let told = Told::default();
    let (name, bytes) = file(stylist.carry_out(&picture(None, [40, 48], 2), &told));
    let (width, height, front) = decoded(&bytes);
    assert_eq!((name.as_str(), width, height), ("small.png", 40, 48));
    assert!(!told.0.lock().unwrap().is_empty());
    let (eye, target) = ([0.0, 1.0, 0.1], [0.0; 3]);
    let back = Viewpoint { eye, target, field_of_view: 0.5 };
    let (_, bytes) = file(order(&mut stylist, &picture(Some(back), [40, 48], 2)));
    assert_ne!(decoded(&bytes).2, front);
}

#[test]
fn pictures_that_cannot_be_are_refused_before_the_work() {
    let mut stylist = Stylist::new();
    let mut refusal = |wrong: Order| refused(order(&mut stylist, &wrong));
    assert!(refusal(picture(None, [0, 48], 2)).problem.contains("0×48"));
    assert!(refusal(picture(None, [9000, 9000], 2)).problem.contains("9000"));
    assert!(refusal(picture(None, [40, 48], 0)).problem.contains("paths"));
    let eye = [0.0, 1.0, 0.1];
    let nowhere = Viewpoint { eye, target: eye, field_of_view: 0.5 };
    assert!(refusal(picture(Some(nowhere), [40, 48], 1)).problem.contains("camera"));
    let inside = Viewpoint { eye: [0.0, 0.0, 0.02], target: eye, field_of_view: 0.5 };
    assert!(refusal(picture(Some(inside), [40, 48], 1)).problem.contains("inside the head"));
    let wide = Viewpoint { eye, target: [0.0; 3], field_of_view: f64::NAN };
    refusal(picture(Some(wide), [40, 48], 1));
    let turn = |size, frames| {
        let asked = asked(CURLY, 0);
        Order::Turntable { asked, viewpoint: None, size, frames }
    };
    assert!(refusal(turn([40, 48], 0)).problem.contains("turntable"));
    assert!(refusal(turn([4000, 4000], 36)).hint.contains("fewer"));
    assert!(refusal(turn([0, 4000], 36)).problem.contains("0×4000"));
}

#[test]
fn a_picture_can_be_cancelled() {
    let mut stylist = Stylist::new();
    exact(&mut stylist, &asked(CURLY, 0));
    let answer = stylist.carry_out(&picture(None, [64, 64], 4096), &Counted::new(40));
    assert_eq!(answer, Answer::Cancelled);
}

#[test]
fn a_turntable_goes_round() {
    let mut stylist = Stylist::new();
    let (size, frames) = ([40, 48], 3);
    let (eye, target) = ([0.0, -1.0, 0.1], [0.0; 3]);
    for viewpoint in [None, Some(Viewpoint { eye, target, field_of_view: 0.5 })] {
        let turn = Order::Turntable { asked: asked(CURLY, 0), viewpoint, size, frames };
        let (_, bytes) = file(order(&mut stylist, &turn));
        let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
        assert_eq!(reader.info().animation_control.unwrap().num_frames, 3);
        let mut pictures = Vec::new();
        for _ in 0..frames {
            let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut pixels).unwrap();
            pictures.push(pixels);
        }
        assert!(pictures[0] != pictures[1] && pictures[1] != pictures[2]);
    }
}

#[test]
fn a_head_may_be_handed_over_as_bytes() {
    let mut stylist = Stylist::new();
    let text = format!("{CURLY}\n[head]\nmesh = 'heads/bust.obj'\nup = 'z'\n");
    let show = Order::Show { asked: asked(&text, 0), effort: Effort::Exact };
    let missing = refused(order(&mut stylist, &show));
    assert_eq!(missing.key, "head.mesh");
    let mut bytes = String::new();
    let surface = frisure::hairstyle::head::Head::mannequin().surface().clone();
    for p in surface.positions() {
        bytes += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for [a, b, c] in surface.triangles() {
        bytes += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    let keep = |bytes: Vec<u8>| Order::Keep { path: "bust.obj".into(), bytes };
    assert_eq!(order(&mut stylist, &keep(bytes.clone().into())), Answer::Kept);
    let shown = common::shown(order(&mut stylist, &show));
    assert_eq!(shown.head.unwrap().triangles.len(), surface.triangles().len());
    // A file that is no head, under the same name.
    order(&mut stylist, &keep(b"\x89PNG\r\n".to_vec()));
    let wrong = refused(order(&mut stylist, &show));
    assert!(wrong.key == "head.mesh" && wrong.line > 0, "{wrong:?}");
    order(&mut stylist, &keep(bytes.into()));
    common::shown(order(&mut stylist, &show));
}

#[test]
fn orders_and_answers_pass_between_workers() {
    let order = picture(None, [3, 4], 5);
    let bytes = postcard::to_stdvec(&order).unwrap();
    assert_eq!(postcard::from_bytes::<Order>(&bytes).unwrap(), order);
    let answer = Answer::Shown(Box::new(exact(&mut Stylist::new(), &asked(CURLY, 0))));
    let bytes = postcard::to_stdvec(&answer).unwrap();
    assert_eq!(postcard::from_bytes::<Answer>(&bytes).unwrap(), answer);
    let file = Answer::File { name: "a".into(), bytes: vec![1, 2, 3] };
    let bytes = postcard::to_stdvec(&file).unwrap();
    assert_eq!(postcard::from_bytes::<Answer>(&bytes).unwrap(), file);
    assert_eq!(refused(Answer::Refused(Refusal::default())), Refusal::default());
}
