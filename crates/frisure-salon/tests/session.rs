//! Whole sessions on the state, without a window.

mod common;

use common::{STRAY, World};
use frisure::hairstyle::Place;
use frisure::hairstyle::head::Region;
use frisure_engine::{Diagnostic, Quality, Response};
use frisure_salon::state::{
    Badge, CONTROLS, Command, Destination, Growing, Mode, Plane, Shot, Tool,
};
use glam::DVec3;
use std::path::PathBuf;

const FRINGE: Place = Place::Region(Region::Fringe);

#[test]
fn a_session_from_the_gallery_to_a_groom() {
    let mut world = World::new();
    assert!(world.salon.is_gallery() && world.salon.badge() == Badge::Empty);
    world.small("curly");
    let (dry, mass) = (world.tips(), world.salon.shown().unwrap().0.numbers.mass);

    world.run(Command::Water);
    assert!(world.salon.is_wet());
    assert!(world.tips() < dry, "wet curls are longer");

    world.run(Command::Choose(FRINGE, Mode::Replace));
    let chosen = world.salon.chosen();
    assert!(chosen.count().is_some_and(|n| n > 0 && n < 40), "{chosen:?}");

    world.run(Command::Take(Tool::Cut));
    world.run(Command::Plane(Plane::level(0.0)));
    let falling = world.salon.falling().expect("hair that falls");
    assert!(falling.hairs > 0 && falling.share > 0.0 && falling.share < 0.5);
    world.run(Command::Cut);
    let cut = world.salon.shown().unwrap().0.numbers.mass;
    assert!(cut < mass, "{cut} {mass}");
    let told = world.salon.messages().iter().any(|m| m.text.contains("of hair fell"));
    assert!(told, "{:?}", world.salon.messages());

    world.run(Command::Water);
    assert!(!world.salon.is_wet());
    let steps = world.salon.scene().unwrap().scene.steps().len();
    assert_eq!(steps, 3);

    world.run(Command::Undo);
    assert!(world.salon.is_wet());
    assert_eq!(world.salon.scene().unwrap().scene.steps().len(), 2);
    world.run(Command::Redo);

    world.run(Command::Save(Destination::Path("curls.toml".into())));
    let saved = String::from_utf8(world.files["curls.toml"].clone()).unwrap();
    assert_eq!(saved, world.text());
    assert!(!world.salon.document().unwrap().is_changed());

    world.run(Command::Export(Destination::Path("curls.hair".into())));
    assert_eq!(&world.files["curls.hair"][..4], b"HAIR");

    // The file says all: opened again, it is the same hair.
    let mut again = World::new();
    let (path, name) = (Some(PathBuf::from("curls.toml")), "curls.toml".to_owned());
    again.run(Command::Open { path, name, text: saved });
    let hair = |world: &World| world.salon.shown().unwrap().0.strands.clone();
    assert!(hair(&again) == hair(&world), "the same bytes");
}

#[test]
fn a_slider_that_is_held_shows_coarse_hair_and_leaves_one_edit() {
    let mut world = World::new();
    world.small("wavy");
    let edits = world.salon.document().unwrap().edits().len();
    for cm in [12.0, 14.0, 16.0, 18.0] {
        world.run(Command::Drag("hair.length", cm));
        assert_eq!(world.salon.shown().unwrap().0.quality, Quality::Coarse);
        assert_eq!(world.salon.badge(), Badge::Settling);
    }
    world.run(Command::LetGo);
    assert_eq!(world.salon.shown().unwrap().0.quality, Quality::Exact);
    let document = world.salon.document().unwrap();
    assert_eq!(document.edits().len(), edits + 1);
    assert_eq!(document.edits().last().unwrap().label, "Length: 18.0 cm");
    let mean = world.salon.scene().unwrap().spec.length.mean;
    assert!((mean - 0.18).abs() < 1e-9);
}

#[test]
fn every_slider_sets_what_it_shows() {
    let mut world = World::new();
    world.salon.run(Command::Begin("wavy".into()));
    for control in CONTROLS {
        let (low, high) = control.range;
        let value = control.clean(low + 0.37 * (high - low));
        world.salon.run(Command::Set(control.key, value));
        let understood = world.salon.scene().unwrap();
        let shown = control.value(&understood.scene, &understood.spec);
        let near = 10_f64.powi(-(control.decimals as i32)).max(1e-6 * value.abs());
        assert!((shown - value).abs() <= near, "{}: {value} became {shown}", control.key);
        world.salon.run(Command::Reset(control.key));
    }
    assert!(world.salon.messages().is_empty(), "{:?}", world.salon.messages());
}

#[test]
fn undo_goes_back_to_the_first_byte_and_redo_to_the_last() {
    let mut world = World::new();
    world.small("curly");
    let first = world.text().to_owned();
    for i in 0..60 {
        world.salon.run(Command::Set("hair.length", 10.0 + f64::from(i)));
    }
    world.salon.run(Command::Wet);
    let last = world.text().to_owned();
    while world.salon.document().unwrap().at() > 0 {
        world.salon.run(Command::Undo);
    }
    assert_eq!(world.text(), first);
    for _ in 0..100 {
        world.salon.run(Command::Redo);
    }
    assert_eq!(world.text(), last);
    world.run(Command::GoTo(0));
    assert!(world.salon.is_settled());
}

#[test]
fn wisps_chosen_by_lasso_stay_the_same_when_the_hair_moves() {
    let mut world = World::new();
    world.small("curly");
    world.run(Command::LookFrom(0.0, 0.0));
    world.run(Command::Frame(1.0));
    let polygon = vec![[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 1.0]];
    world.run(Command::DrawLasso { polygon, aspect: 1.0, mode: Mode::Replace });
    let chosen = world.salon.chosen().wisps.clone().expect("wisps");
    world.run(Command::Wet);
    assert!(world.text().contains("lasso"));
    world.run(Command::Grow(Growing::By(0.03)));
    assert!(world.text().contains("wisps = ["), "{}", world.text());
    let hair = world.salon.shown().unwrap().0.clone();
    for (wet, chosen) in hair.wetness.iter().zip(&chosen) {
        assert_eq!(*wet > 0.0, *chosen);
    }
}

#[test]
fn a_brush_chooses_what_is_rooted_under_it() {
    let mut world = World::new();
    world.small("straight");
    world.run(Command::BrushSize(0.05));
    let head = world.salon.head().expect("a head").clone();
    let (from, way) = (DVec3::new(0.0, 0.0, 1.0), DVec3::NEG_Z);
    let top = head.hit(from, way).expect("the top of the head");
    world.run(Command::Paint(vec![top], Mode::Replace));
    let hair = world.salon.shown().unwrap().0.clone();
    for (root, chosen) in hair.roots.iter().zip(world.salon.chosen().wisps.as_ref().unwrap()) {
        let root = glam::Vec3::from_array(*root).as_dvec3();
        assert_eq!(root.distance(top) < 0.05, *chosen, "{root}");
    }
}

#[test]
fn one_hair_is_shown_with_frames_at_right_angles() {
    let mut world = World::new();
    world.small("curly");
    world.run(Command::Take(Tool::Pick));
    world.run(Command::Alone(Some(7)));
    let hair = world.salon.alone().unwrap().hair.clone().expect("a hair");
    assert_eq!(hair.wisp, 7);
    for frame in &hair.frames {
        let [a, b, t] = frame.map(glam::Vec3::from_array);
        assert!(a.dot(b).abs() < 1e-4 && a.cross(b).distance(t) < 1e-4);
    }
    world.run(Command::Alone(Some(100_000)));
    assert!(world.salon.messages().iter().any(|m| m.is_error));
    assert!(world.salon.alone().is_none());
}

#[test]
fn before_and_after_are_two_heads_of_hair() {
    let mut world = World::new();
    world.small("curly");
    world.run(Command::Wet);
    world.run(Command::Compare(Some(0)));
    let before = world.salon.compared().unwrap().hair.clone().expect("hair");
    assert!(before.numbers.tips > world.tips());
    assert!(before.wetness.iter().all(|w| *w == 0.0));
    world.run(Command::Compare(None));
    assert!(world.salon.compared().is_none());
}

#[test]
fn a_picture_is_made_beside() {
    let mut world = World::new();
    world.small("straight");
    let shot = Shot::Picture { size: [32, 32], paths: 2, noise: 0.5 };
    world.run(Command::Shoot(shot, Destination::Download("a.png".into())));
    assert_eq!(&world.files["a.png"][1..4], b"PNG");
    let film = Shot::Turntable { size: [16, 16], frames: 2 };
    world.run(Command::Shoot(film, Destination::Download("b.png".into())));
    assert_eq!(&world.files["b.png"][1..4], b"PNG");
}

#[test]
fn what_was_not_saved_survives_a_crash() {
    let mut world = World::new();
    world.small("curly");
    assert_eq!(world.kept, None, "nothing was done yet");
    world.run(Command::Wet);
    let (kept, text) = (world.kept.clone().expect("kept"), world.text().to_owned());

    let mut next = World::new();
    next.salon.found_kept(&kept);
    assert!(next.salon.recoverable().is_some());
    next.run(Command::Recover(true));
    assert_eq!(next.text(), text);
    assert!(next.salon.document().unwrap().is_changed() && next.salon.is_wet());
    next.run(Command::Save(Destination::Path("x.toml".into())));
    assert_eq!(next.kept, None, "saved work needs no keeping");
}

#[test]
fn a_full_disk_loses_nothing() {
    let mut world = World::new();
    world.small("curly");
    world.run(Command::Wet);
    world.full = true;
    world.run(Command::Save(Destination::Path("x.toml".into())));
    assert!(world.salon.messages().iter().any(|m| m.is_error && m.text.contains("no space")));
    assert!(world.salon.document().unwrap().is_changed());
    assert!(world.kept.is_some());
}

#[test]
fn what_is_no_scene_is_refused_with_its_line_and_the_hair_stays() {
    let mut world = World::new();
    world.small("curly");
    let before = world.text().to_owned();
    let texts = [
        "[hair]\ntype = \"curvy\"\n",
        "[hair]\nlength = \"9 m\"\n",
        "not a scene at all",
        "\u{0}\u{0}",
        "[head]\nmesh = \"nowhere.obj\"\n\n[hair]\nlengt = 3\n",
    ];
    for text in texts {
        let name = "bad.toml".to_owned();
        world.run(Command::Open { path: None, name, text: text.to_owned() });
        let message = world.salon.messages().last().expect("a message");
        assert!(message.is_error && message.text.contains("line"), "{message:?}");
        assert_eq!(world.text(), before);
        assert!(world.salon.is_settled());
    }
}

#[test]
fn hair_that_cannot_be_is_told_once_and_undone() {
    let mut world = World::new();
    world.small("curly");
    let text = "[head]\nmesh = \"nowhere.obj\"\n".to_owned();
    world.run(Command::Open { path: None, name: "bad.toml".into(), text });
    assert!(matches!(world.salon.badge(), Badge::Refused(_)), "{:?}", world.salon.badge());
    assert!(world.salon.messages().last().unwrap().text.contains("nowhere.obj"));
}

#[test]
fn absurd_commands_leave_a_salon() {
    let mut world = World::new();
    let nan = f64::NAN;
    let absurd = || {
        vec![
            Command::Undo,
            Command::Cut,
            Command::Wet,
            Command::LetGo,
            Command::GoTo(99),
            Command::Compare(Some(99)),
            Command::Alone(Some(usize::MAX)),
            Command::Drag("hair.length", nan),
            Command::LetGo,
            Command::Drag("no.such.key", 1.0),
            Command::Set("hair.length", f64::INFINITY),
            Command::Word("look.colour", "\"plaid\"".into()),
            Command::Word("look.colour", "]]]".into()),
            Command::Grow(Growing::By(nan)),
            Command::Grow(Growing::Months(1e300)),
            Command::Dry(-3.0),
            Command::Paint(vec![DVec3::splat(nan)], Mode::Add),
            Command::Paint(vec![], Mode::Add),
            Command::BrushSize(nan),
            Command::DrawLasso { polygon: vec![[nan; 2]; 5], aspect: nan, mode: Mode::Remove },
            Command::DrawLasso { polygon: vec![[0.0; 2]; 9], aspect: 1.0, mode: Mode::Replace },
            Command::Stroke(vec![DVec3::ZERO; 3], DVec3::ZERO),
            Command::Plane(Plane { point: DVec3::splat(nan), ..Plane::level(0.0) }),
            Command::Turn(nan, nan),
            Command::Zoom(0.0),
            Command::Frame(nan),
            Command::Head(Some("\"quoted\"\n.obj".into())),
            Command::Export(Destination::Path("x.docx".into())),
            Command::Begin("nothing".into()),
            Command::Dismiss(99),
            Command::Stop,
            Command::Recover(true),
        ]
    };
    for command in absurd() {
        world.salon.run(command);
    }
    world.small("curly");
    for command in absurd() {
        world.run(command);
    }
    world.salon.receive(12_345, STRAY);
    world.run(Command::GoTo(0));
    world.run(Command::ChooseAll);
    assert!(world.salon.is_settled(), "{:?} {:?}", world.salon.badge(), world.salon.messages());
}

#[test]
fn a_stylist_who_fails_leaves_the_hair_as_it_was() {
    let mut world = World::new();
    world.small("curly");
    world.salon.run(Command::Wet);
    let errands = world.salon.errands();
    let Some(frisure_salon::state::Errand::Work(_, ticket, _)) = errands.first() else {
        panic!("{errands:?}")
    };
    let refusal = Diagnostic { problem: "it broke".into(), ..Diagnostic::default() };
    world.salon.receive(*ticket, Response::Failed(refusal));
    world.settle();
    assert!(matches!(world.salon.badge(), Badge::Refused(_)));
    world.run(Command::Undo);
    assert!(world.salon.is_settled());
}

#[test]
fn other_workers_begin_again_with_what_was_under_way() {
    let mut world = World::new();
    world.small("curly");
    world.salon.run(Command::Wet);
    // The order was handed out, and nobody carries it out.
    assert!(!world.salon.errands().is_empty() && world.salon.errands().is_empty());
    world.salon.begin_again();
    world.settle();
    assert!(world.salon.is_settled() && world.salon.is_wet());
}
