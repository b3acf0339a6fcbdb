//! Every other request: selections, guides, files, pictures, turntables.

mod common;

use std::sync::Arc;

use common::{CURLY, Counted, asked, exact, failed};
use frisure_engine::{Diagnostic, LoadedScene, Quality, Request, Response, Session, Viewpoint};

fn file(answer: Response) -> (String, Vec<u8>) {
    match answer {
        Response::File { name, bytes } => (name, bytes),
        other => panic!("{other:?}"),
    }
}

fn execute(session: &mut Session, request: &Request) -> Response {
    session.execute(request, &())
}

#[test]
fn a_step_selects_wisps_and_errors_name_its_line() {
    let mut session = Session::new();
    let choose = |step: &str| Request::Select { scene: asked(CURLY, 0), step: step.into() };
    let mut chosen = |step: &str| match execute(&mut session, &choose(step)) {
        Response::Selected(wisps) => wisps,
        other => panic!("{other:?}"),
    };
    let all = chosen("wet = {}");
    assert!(all.len() == 24 && all.iter().all(|c| *c));
    let back = chosen("cut = { length = '5 cm', where = 'back' }");
    assert!(back.contains(&true) && back.contains(&false));
    assert_eq!(chosen("wet = { where = { wisps = [3] } }").iter().filter(|c| **c).count(), 1);
    assert_eq!(chosen("humidity = 0.9").len(), 24);
    let wrong = failed(execute(&mut session, &choose("wet = { whare = 'back' }")));
    assert!(wrong.line == 1 && wrong.hint.contains("where"), "{wrong:?}");
    let nobody = failed(execute(&mut session, &choose("wet = { where = { wisps = [99] } }")));
    assert!(nobody.problem.contains("99"), "{nobody:?}");
}

#[test]
fn one_hair_has_its_frames_and_numbers() {
    let mut session = Session::new();
    let hair = |wisp| Request::Guide { scene: asked(CURLY, 0), wisp, points: 30 };
    let Response::Guide(one) = execute(&mut session, &hair(5)) else { panic!() };
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
    assert!(failed(execute(&mut session, &hair(24))).problem.contains("24"));
}

#[test]
fn a_groom_is_what_the_command_line_writes() {
    let mut session = Session::new();
    let groom = |format: &str| Request::Groom { scene: asked(CURLY, 0), format: format.into() };
    let folder = tempfile::tempdir().unwrap();
    for format in ["hair", "obj", "ply"] {
        let (name, bytes) = file(execute(&mut session, &groom(format)));
        assert_eq!(name, format!("small.{format}"));
        let path = folder.path().join(&name);
        let scene = frisure::scene::Scene::parse("s", CURLY, "".as_ref()).unwrap();
        let head = frisure::hairstyle::head::Head::mannequin();
        use frisure::hairstyle::{PredictOptions, StrandOptions, predict, strands};
        let hair = predict(&scene.hairstyle_spec().unwrap(), &head, PredictOptions::default(), &())
            .unwrap();
        let strands = strands(&hair, &head, StrandOptions::default(), &()).unwrap().strands;
        let (scene, head, hairstyle) = (Arc::new(scene), Arc::new(head), Arc::new(hair));
        let loaded = LoadedScene { scene, head, note: None, hairstyle, adoption: None };
        let groom = loaded.groom(strands, false);
        frisure::formats::groom::write_groom(&path, &groom, Default::default()).unwrap();
        assert_eq!(std::fs::read(path).unwrap(), bytes);
    }
    assert!(failed(execute(&mut session, &groom("png"))).problem.contains(".ply"));
}

fn picture(viewpoint: Option<Viewpoint>, size: [usize; 2], paths: usize) -> Request {
    Request::Picture { scene: asked(CURLY, 0), viewpoint, size, paths, noise: 0.0 }
}

fn decoded(bytes: &[u8]) -> (u32, u32, Vec<u8>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let frame = reader.next_frame(&mut pixels).unwrap();
    (frame.width, frame.height, pixels)
}

#[test]
fn a_picture_is_traced_from_anywhere() {
    let mut session = Session::new();
    let progress = Counted::new(usize::MAX);
    let (name, bytes) = file(session.execute(&picture(None, [40, 48], 2), &progress));
    let (width, height, front) = decoded(&bytes);
    assert_eq!((name.as_str(), width, height), ("small.png", 40, 48));
    assert!(progress.reports() > 0);
    let (eye, target) = ([0.0, 1.0, 0.1], [0.0; 3]);
    let back = Viewpoint { eye, target, field_of_view: 0.5 };
    let (_, bytes) = file(execute(&mut session, &picture(Some(back), [40, 48], 2)));
    assert_ne!(decoded(&bytes).2, front);
}

#[test]
fn impossible_pictures_fail_before_the_computation() {
    let mut session = Session::new();
    let mut diagnostic = |wrong: Request| failed(execute(&mut session, &wrong));
    assert!(diagnostic(picture(None, [0, 48], 2)).problem.contains("0×48"));
    assert!(diagnostic(picture(None, [9000, 9000], 2)).problem.contains("9000"));
    assert!(diagnostic(picture(None, [40, 48], 0)).problem.contains("paths"));
    let eye = [0.0, 1.0, 0.1];
    let nowhere = Viewpoint { eye, target: eye, field_of_view: 0.5 };
    assert!(diagnostic(picture(Some(nowhere), [40, 48], 1)).problem.contains("camera"));
    let inside = Viewpoint { eye: [0.0, 0.0, 0.02], target: eye, field_of_view: 0.5 };
    assert!(diagnostic(picture(Some(inside), [40, 48], 1)).problem.contains("inside the head"));
    let wide = Viewpoint { eye, target: [0.0; 3], field_of_view: f64::NAN };
    diagnostic(picture(Some(wide), [40, 48], 1));
    let turn = |size, frames| {
        let asked = asked(CURLY, 0);
        Request::Turntable { scene: asked, viewpoint: None, size, frames }
    };
    assert!(diagnostic(turn([40, 48], 0)).problem.contains("turntable"));
    assert!(diagnostic(turn([4000, 4000], 36)).hint.contains("fewer"));
    assert!(diagnostic(turn([0, 4000], 36)).problem.contains("0×4000"));
}

#[test]
fn a_picture_can_be_cancelled() {
    let mut session = Session::new();
    exact(&mut session, &asked(CURLY, 0));
    let answer = session.execute(&picture(None, [64, 64], 4096), &Counted::new(40));
    assert_eq!(answer, Response::Cancelled);
}

#[test]
fn a_film_shows_one_scene_after_the_other() {
    let mut session = Session::new();
    let film = |done: &[usize]| {
        let text = format!("{CURLY}\n[[step]]\nwet = {{}}\n");
        let scenes = done.iter().map(|done| asked(&text, *done)).collect();
        Request::Film { scenes, viewpoint: None, size: [40, 48] }
    };
    let (_, bytes) = file(execute(&mut session, &film(&[0, 0, 1])));
    let reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().unwrap();
    // What changes nothing is seen once.
    assert_eq!(reader.info().animation_control.unwrap().num_frames, 2);
    assert!(failed(execute(&mut session, &film(&[]))).problem.contains("film"));
}

#[test]
fn a_turntable_goes_round() {
    let mut session = Session::new();
    let (size, frames) = ([40, 48], 3);
    let (eye, target) = ([0.0, -1.0, 0.1], [0.0; 3]);
    for viewpoint in [None, Some(Viewpoint { eye, target, field_of_view: 0.5 })] {
        let turn = Request::Turntable { scene: asked(CURLY, 0), viewpoint, size, frames };
        let (_, bytes) = file(execute(&mut session, &turn));
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
fn a_head_can_be_provided_as_bytes() {
    let mut session = Session::new();
    let text = format!("{CURLY}\n[head]\nmesh = 'heads/bust.obj'\nup = 'z'\n");
    let show = Request::Preview { scene: asked(&text, 0), quality: Quality::Exact };
    let missing = failed(execute(&mut session, &show));
    assert_eq!(missing.key, "head.mesh");
    let mut bytes = String::new();
    let surface = frisure::hairstyle::head::Head::mannequin().surface().clone();
    for p in surface.positions() {
        bytes += &format!("v {} {} {}\n", p.x, p.y, p.z);
    }
    for [a, b, c] in surface.triangles() {
        bytes += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
    let provide = |bytes: Vec<u8>| Request::ProvideFile { path: "bust.obj".into(), bytes };
    assert_eq!(execute(&mut session, &provide(bytes.clone().into())), Response::FileProvided);
    let shown = common::shown(execute(&mut session, &show));
    assert_eq!(shown.head.unwrap().triangles.len(), surface.triangles().len());
    // A file that is no head, under the same name.
    execute(&mut session, &provide(b"\x89PNG\r\n".to_vec()));
    let wrong = failed(execute(&mut session, &show));
    assert!(wrong.key == "head.mesh" && wrong.line > 0, "{wrong:?}");
    execute(&mut session, &provide(bytes.into()));
    common::shown(execute(&mut session, &show));
}

#[test]
fn requests_and_responses_survive_serialisation() {
    let request = picture(None, [3, 4], 5);
    let bytes = postcard::to_stdvec(&request).unwrap();
    assert_eq!(postcard::from_bytes::<Request>(&bytes).unwrap(), request);
    let answer = Response::Preview(Box::new(exact(&mut Session::new(), &asked(CURLY, 0))));
    let bytes = postcard::to_stdvec(&answer).unwrap();
    assert_eq!(postcard::from_bytes::<Response>(&bytes).unwrap(), answer);
    let file = Response::File { name: "a".into(), bytes: vec![1, 2, 3] };
    let bytes = postcard::to_stdvec(&file).unwrap();
    assert_eq!(postcard::from_bytes::<Response>(&bytes).unwrap(), file);
    assert_eq!(failed(Response::Failed(Diagnostic::default())), Diagnostic::default());
}
