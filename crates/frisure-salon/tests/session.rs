//! Whole sessions of the state, without a window.

mod common;

use common::{STRAY, World};
use frisure::hairstyle::Place;
use frisure::hairstyle::head::Region;
use frisure::hairstyle::styling::{Dry, Grow, Growth, Operation, Selection, Wet};
use frisure::scene::edit;
use frisure_engine::{Diagnostic, Quality, Response};
use frisure_salon::state::{
    Badge, CONTROLS, CombPlace, CombStroke, Command, CutHold, CutPlane, Destination, Document,
    EXERCISES, Exercise, ExerciseCard, RenderTask, Scissors, SelectMode, Snip, TOUR, Tool, code,
};
use glam::{DVec3, Vec3};
use std::path::PathBuf;

const FRINGE: Place = Place::Region(Region::Fringe);

fn wet() -> Command {
    Command::Apply(Operation::Wet(Wet::default()))
}

fn grow(amount: Growth) -> Command {
    let selection = Selection::Everything;
    Command::Apply(Operation::Grow(Grow { selection, amount, stages: 1 }))
}

#[test]
fn a_session_from_the_gallery_to_a_groom() {
    let mut world = World::new();
    assert!(world.salon.is_gallery() && world.salon.badge() == Badge::Empty);
    world.small("curly");
    let (dry, mass) = (world.tips(), world.salon.preview().unwrap().0.numbers.mass);

    world.run(Command::ToggleWet);
    assert!(world.salon.is_wet());
    assert!(world.tips() < dry, "wet curls are longer");

    world.run(Command::Select(FRINGE, SelectMode::Replace));
    let selected = &world.salon.selected;
    assert!(selected.count().is_some_and(|n| n > 0 && n < 40), "{selected:?}");

    world.run(Command::Take(Tool::Cut));
    world.run(Command::Plane(CutPlane::level(0.0)));
    let preview = world.salon.cut_preview().expect("hair that falls");
    assert!(preview.hairs > 0 && preview.share > 0.0 && preview.share < 0.5);
    world.run(Command::Cut);
    let cut = world.salon.preview().unwrap().0.numbers.mass;
    assert!(cut < mass, "{cut} {mass}");
    let reported = world.salon.messages.iter().any(|m| m.text.contains("Cut off"));
    assert!(reported, "{:?}", world.salon.messages);

    world.run(Command::ToggleWet);
    assert!(!world.salon.is_wet());
    let steps = world.salon.scene.as_ref().unwrap().scene.steps().len();
    assert_eq!(steps, 3);

    world.run(Command::Undo);
    assert!(world.salon.is_wet());
    assert_eq!(world.salon.scene.as_ref().unwrap().scene.steps().len(), 2);
    world.run(Command::Redo);

    world.run(Command::Save(Destination::Path("curls.toml".into())));
    let saved = String::from_utf8(world.files["curls.toml"].clone()).unwrap();
    assert_eq!(saved, world.text());
    assert!(!world.salon.document.as_ref().unwrap().is_changed());

    world.run(Command::Export(Destination::Path("curls.hair".into())));
    assert_eq!(&world.files["curls.hair"][..4], b"HAIR");

    // The file says all: opened again, it is the same hair.
    let mut again = World::new();
    let (path, name) = (Some(PathBuf::from("curls.toml")), "curls.toml".to_owned());
    again.run(Command::Open { path, name, text: saved });
    let hair = |world: &World| world.salon.preview().unwrap().0.strands.clone();
    assert!(hair(&again) == hair(&world), "the same bytes");
}

#[test]
fn hair_follows_the_comb_and_the_stroke_makes_one_edit() {
    let mut world = World::new();
    world.small("wavy");
    world.run(Command::Take(Tool::Comb));
    let before = world.text().to_owned();
    let at_rest = world.salon.preview().unwrap().0.strands.clone();
    // From a place amid the hair to the right.
    let (hair, orbit) = (world.salon.preview().unwrap().0.clone(), world.salon.orbit);
    let points = hair.strands.points.as_chunks::<3>().0;
    let from = Vec3::from_array(points[hair.strands.offsets[1] as usize / 2]).as_dvec3();
    let stroke = |length: f64| {
        let place = |i: i32| {
            let p = from + orbit.camera().right() * (length * f64::from(i) / 10.0);
            CombPlace { at: orbit.project(p, 1.5).unwrap(), skin: None }
        };
        CombStroke { path: (0..=10).map(place).collect(), aspect: 1.5 }
    };
    for length in [0.02, 0.04, 0.06] {
        world.run(Command::DragComb(stroke(length)));
        assert!(world.salon.is_dragging());
        let (hair, _) = world.salon.preview().unwrap();
        assert_eq!(hair.quality, Quality::Coarse);
        assert!(hair.strands != at_rest, "it has followed");
    }
    assert_eq!(world.salon.document.as_ref().unwrap().edits().len(), 1);
    // Another tool ends the stroke without an edit.
    world.run(Command::Take(Tool::Orbit));
    assert!(world.text() == before && !world.salon.is_dragging() && world.salon.is_settled());
    assert!(world.salon.preview().unwrap().0.strands == at_rest);

    world.run(Command::DragComb(stroke(0.06)));
    // So does a stroke that ends where it began.
    world.run(Command::Comb(stroke(0.0)));
    assert!(world.text() == before && !world.salon.is_dragging());

    world.run(Command::DragComb(stroke(0.04)));
    world.run(Command::Comb(stroke(0.06)));
    assert!(!world.salon.is_dragging() && world.salon.is_settled());
    assert_eq!(world.salon.document.as_ref().unwrap().edits().len(), 2);
    let followed = world.salon.preview().unwrap().0.strands.clone();
    // The answer is that of the stroke alone.
    let mut again = World::new();
    again.small("wavy");
    again.run(Command::Comb(stroke(0.06)));
    assert_eq!(again.text(), world.text());
    assert!(again.salon.preview().unwrap().0.strands == followed, "the same bytes");
}

#[test]
fn a_dragged_slider_shows_coarse_hair_and_makes_one_edit() {
    let mut world = World::new();
    world.of("wavy", 16);
    let edits = world.salon.document.as_ref().unwrap().edits().len();
    for cm in [12.0, 14.0, 16.0, 18.0] {
        world.run(Command::Drag("hair.length", cm));
        assert_eq!(world.salon.preview().unwrap().0.quality, Quality::Coarse);
        assert_eq!(world.salon.badge(), Badge::Settling);
    }
    world.run(Command::EndDrag);
    assert_eq!(world.salon.preview().unwrap().0.quality, Quality::Exact);
    let document = world.salon.document.as_ref().unwrap();
    assert_eq!(document.edits().len(), edits + 1);
    assert_eq!(document.edits().last().unwrap().label, "Length: 18.0 cm");
    let mean = world.salon.scene.as_ref().unwrap().spec.length.mean;
    assert!((mean - 0.18).abs() < 1e-9);
}

#[test]
fn every_slider_sets_the_value_it_shows() {
    let mut world = World::new();
    world.salon.run(Command::Begin("wavy".into()));
    for control in CONTROLS.iter() {
        let (low, high) = control.range;
        let value = control.clean(low + 0.37 * (high - low));
        world.salon.run(Command::Set(control.key, value));
        let parsed = world.salon.scene.as_ref().unwrap();
        let shown = control.value(&parsed.scene);
        let near = 10_f64.powi(-(control.decimals as i32)).max(1e-6 * value.abs());
        assert!((shown - value).abs() <= near, "{}: {value} became {shown}", control.key);
        world.salon.run(Command::Reset(control.key));
    }
    assert!(world.salon.messages.is_empty(), "{:?}", world.salon.messages);
}

#[test]
fn undo_and_redo_restore_every_text_exactly() {
    let mut world = World::new();
    world.small("curly");
    let first = world.text().to_owned();
    for i in 0..60 {
        world.salon.run(Command::Set("hair.length", 10.0 + f64::from(i)));
    }
    world.salon.run(wet());
    let last = world.text().to_owned();
    while world.salon.document.as_ref().unwrap().at() > 0 {
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
fn wisps_selected_by_lasso_stay_the_same_when_the_hair_moves() {
    let mut world = World::new();
    world.small("curly");
    world.run(Command::LookFrom(0.0, 0.0));
    world.run(Command::Frame(1.0));
    let polygon = vec![[-1.0, 0.0], [1.0, 0.0], [1.0, 1.0], [-1.0, 1.0]];
    world.run(Command::DrawLasso { polygon, aspect: 1.0, mode: SelectMode::Replace });
    let selected = world.salon.selected.wisps.clone().expect("wisps");
    world.run(wet());
    assert!(world.text().contains("lasso"));
    world.run(grow(Growth::By(0.03)));
    assert!(world.text().contains("wisps = ["), "{}", world.text());
    let hair = world.salon.preview().unwrap().0.clone();
    for (wet, selected) in hair.wetness.iter().zip(&selected) {
        assert_eq!(*wet > 0.0, *selected);
    }
}

#[test]
fn a_brush_selects_the_hair_rooted_under_it() {
    let mut world = World::new();
    world.small("straight");
    world.run(Command::BrushSize(0.05));
    let head = world.salon.head.as_ref().expect("a head").clone();
    let (from, direction) = (DVec3::new(0.0, 0.0, 1.0), DVec3::NEG_Z);
    let top = head.hit(from, direction).expect("the top of the head");
    world.run(Command::Paint(vec![top], SelectMode::Replace));
    let hair = world.salon.preview().unwrap().0.clone();
    for (root, selected) in hair.roots.iter().zip(world.salon.selected.wisps.as_ref().unwrap()) {
        let root = Vec3::from_array(*root).as_dvec3();
        assert_eq!(root.distance(top) < 0.05, *selected, "{root}");
    }
}

/// A stroke of scissors in the picture from the front, between two places (m).
fn snip(world: &World, ends: [DVec3; 2]) -> Command {
    let at = |p| world.salon.orbit.project(p, 1.5).expect("before the camera");
    Command::Snip(Snip { ends: ends.map(at), aspect: 1.5 })
}

#[test]
fn scissors_fingers_and_clippers_cut_the_hair_under_them() {
    let mut world = World::new();
    world.small("straight");
    world.run(Command::LookFrom(0.0, 0.0));
    let mass = |world: &World| world.salon.preview().unwrap().0.numbers.mass;
    let whole = mass(&world);

    // Scissors: what hangs before the face falls, the hair behind the head stays.
    let across = [DVec3::new(-0.09, -0.12, -0.03), DVec3::new(0.09, -0.12, -0.03)];
    let soft = Scissors { hold: CutHold::Resting, soft: 0.01, ..Scissors::default() };
    world.run(Command::Scissors(soft));
    world.run(Command::Take(Tool::Scissors));
    world.run(snip(&world, across));
    let text = world.text().to_owned();
    assert!(text.contains("plane") && text.contains("wisps = ["), "{text}");
    assert!(text.contains("resting = true") && text.contains("point_cut = \"1 cm\""), "{text}");
    let trimmed = mass(&world);
    assert!(trimmed < 0.99 * whole && trimmed > 0.5 * whole, "{trimmed} {whole}");
    // Beside the head there is no hair to cut.
    world.run(snip(&world, [DVec3::new(0.3, 0.0, 0.1), DVec3::new(0.35, 0.0, 0.1)]));
    assert!(
        world.text() == text && world.salon.messages.iter().any(|m| m.text.contains("no hair"))
    );

    // Fingers lift the hair on top; clippers then take most of it.
    let head = world.salon.head.as_ref().expect("a head").clone();
    let top = head.hit(DVec3::Z, DVec3::NEG_Z).expect("the top of the head");
    world.run(Command::BrushSize(0.06));
    world.run(Command::Take(Tool::Lift));
    world.run(Command::Lift(vec![top]));
    assert!(world.text().contains("elevation"), "{}", world.text());
    let layered = mass(&world);
    world.run(Command::Take(Tool::Clippers));
    world.run(Command::Clip(vec![top]));
    let shorn = mass(&world);
    assert!(shorn < layered && layered < trimmed, "{shorn} {layered} {trimmed}");
    let nearest = world.salon.wisp_at(top).expect("a wisp");
    world.run(Command::Isolate(Some(nearest)));
    let hair = world.salon.isolated.as_ref().unwrap().hair.clone().expect("a hair");
    assert!((5e-3..8e-3).contains(&hair.length), "a guard of 6 mm leaves {} m", hair.length);
}

#[test]
fn a_mirror_does_each_step_on_both_sides_as_one_edit() {
    let mut world = World::new();
    world.small("straight");
    world.run(Command::ToggleMirror);
    world.run(Command::BrushSize(0.05));
    let head = world.salon.head.as_ref().expect("a head").clone();
    let temple =
        head.hit(DVec3::new(1.0, -0.03, 0.05), DVec3::NEG_X).expect("the head's left side");
    let edits = |world: &World| world.salon.document.as_ref().unwrap().edits().len();
    let steps = |world: &World| world.salon.scene.as_ref().unwrap().scene.steps().to_vec();
    let before = edits(&world);
    world.run(Command::Take(Tool::Clippers));
    world.run(Command::Clip(vec![temple]));
    assert_eq!((edits(&world), steps(&world).len()), (before + 1, 2));
    assert_eq!(steps(&world)[0].mirrored(&|wisp| wisp), steps(&world)[1]);
    // What is the same on both sides is done once.
    world.run(Command::Select(FRINGE, SelectMode::Replace));
    world.run(wet());
    assert_eq!(steps(&world).len(), 3);
    // Hair that a stroke crosses is known by number: the wisps on the other side are those rooted opposite.
    world.run(Command::SelectAll);
    world.run(Command::LookFrom(0.0, 0.0));
    world.run(Command::Take(Tool::Scissors));
    world.run(snip(&world, [DVec3::new(0.02, -0.1, -0.06), DVec3::new(0.12, -0.1, -0.05)]));
    let last = steps(&world);
    assert_eq!(last.len(), 5, "{}", world.text());
    world.run(Command::Undo);
    assert_eq!(steps(&world).len(), 3);
}

#[test]
fn an_isolated_hair_has_orthonormal_frames() {
    let mut world = World::new();
    world.small("curly");
    world.run(Command::Take(Tool::Pick));
    world.run(Command::Isolate(Some(7)));
    let hair = world.salon.isolated.as_ref().unwrap().hair.clone().expect("a hair");
    assert_eq!(hair.wisp, 7);
    for frame in &hair.frames {
        let [a, b, t] = frame.map(Vec3::from_array);
        assert!(a.dot(b).abs() < 1e-4 && a.cross(b).distance(t) < 1e-4);
    }
    world.run(Command::Isolate(Some(100_000)));
    assert!(world.salon.messages.iter().any(|m| m.is_error));
    assert!(world.salon.isolated.is_none());
}

#[test]
fn a_comparison_shows_the_hair_of_the_earlier_edit() {
    let mut world = World::new();
    world.small("curly");
    world.run(wet());
    world.run(Command::Compare(Some(0)));
    let before = world.salon.comparison.as_ref().unwrap().hair.clone().expect("hair");
    assert!(before.numbers.tips > world.tips());
    assert!(before.wetness.iter().all(|w| *w == 0.0));
    world.run(Command::Compare(None));
    assert!(world.salon.comparison.is_none());
}

#[test]
fn pictures_are_rendered_in_the_background() {
    let mut world = World::new();
    world.small("straight");
    let task = RenderTask::Picture { size: [32, 32], paths: 2, noise: 0.5 };
    world.run(Command::Render(task, Destination::Download("a.png".into())));
    assert_eq!(&world.files["a.png"][1..4], b"PNG");
    let inside = frisure::formats::picture::scene_text::extract(&world.files["a.png"]);
    assert_eq!(inside.as_deref(), Some(world.text()), "a picture has its scene inside");
    world.run(wet());
    let film = RenderTask::Film { size: [16, 16] };
    world.run(Command::Render(film, Destination::Download("film.png".into())));
    let chunks = |name: &[u8]| world.files["film.png"].windows(4).filter(|c| *c == name).count();
    assert_eq!((chunks(b"acTL"), chunks(b"fcTL")), (1, 2), "dry and wet");
    let film = RenderTask::Turntable { size: [16, 16], frames: 2 };
    world.run(Command::Render(film, Destination::Download("b.png".into())));
    assert_eq!(&world.files["b.png"][1..4], b"PNG");
}

#[test]
fn a_link_opens_the_scene_that_it_was_made_of() {
    let mut world = World::new();
    world.small("wavy");
    world.run(wet());
    let (text, link) = (world.text().to_owned(), code(world.text()));
    let mut other = World::new();
    other.run(Command::Begin(link.clone()));
    assert_eq!(other.text(), text);
    assert!(other.salon.is_wet());
    other.run(Command::Begin(link[..link.len() - 9].to_owned()));
    assert!(other.salon.messages.iter().any(|m| m.text.contains("link is damaged")));
    assert_eq!(other.text(), text, "a damaged link leaves the scene");
}

#[test]
fn the_tour_can_be_taken_step_by_step() {
    let mut world = World::new();
    world.salon.run(Command::BeginTour);
    assert_eq!(world.salon.document.as_ref().map(Document::name), Some("Curly"));
    assert!(!world.salon.is_step_done());
    world.salon.run(Command::Turn(0.2, 0.0));
    assert!(world.salon.is_step_done());
    // The others on a head with fewer hairs, for the time's sake.
    world.small("curly");
    world.run(Command::NextOfTour);
    let steps: [&[Command]; 4] = [
        &[Command::ToggleWet],
        &[Command::Select(FRINGE, SelectMode::Replace)],
        &[Command::Take(Tool::Cut), Command::Plane(CutPlane::level(-0.02)), Command::Cut],
        &[Command::SelectAll, Command::ToggleWet, Command::ToggleCompare],
    ];
    for commands in steps {
        assert!(!world.salon.is_step_done(), "{:?}", world.salon.tour);
        commands.iter().for_each(|command| world.run(command.clone()));
        assert!(world.salon.is_step_done(), "{:?}", world.salon.tour);
        world.run(Command::NextOfTour);
    }
    assert_eq!(world.salon.tour.as_ref().map(|tour| tour.at), Some(TOUR.len()));
    world.run(Command::NextOfTour);
    assert_eq!(world.salon.tour, None);
    world.run(Command::EndTour);
    world.run(Command::NextOfTour);
    assert_eq!(world.salon.tour, None);
}

#[test]
fn unsaved_work_is_recovered_after_a_crash() {
    let mut world = World::new();
    world.small("curly");
    assert_eq!(world.autosaved, None, "there are no edits yet");
    world.run(wet());
    let (autosaved, text) =
        (world.autosaved.clone().expect("an autosave"), world.text().to_owned());

    let mut next = World::new();
    next.salon.offer_recovery(&autosaved);
    assert!(next.salon.recoverable.is_some());
    next.run(Command::Recover(true));
    assert_eq!(next.text(), text);
    assert!(next.salon.document.as_ref().unwrap().is_changed() && next.salon.is_wet());
    next.run(Command::Save(Destination::Path("x.toml".into())));
    assert_eq!(next.autosaved, None, "saved work needs no autosave");
}

#[test]
fn a_full_disk_loses_no_work() {
    let mut world = World::new();
    world.small("curly");
    world.run(wet());
    world.full = true;
    world.run(Command::Save(Destination::Path("x.toml".into())));
    assert!(world.salon.messages.iter().any(|m| m.is_error && m.text.contains("no space")));
    assert!(world.salon.document.as_ref().unwrap().is_changed());
    assert!(world.autosaved.is_some());
}

#[test]
fn an_invalid_scene_is_reported_with_its_line_and_the_hair_stays() {
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
        let message = world.salon.messages.last().expect("a message");
        assert!(message.is_error && message.text.contains("line"), "{message:?}");
        assert_eq!(world.text(), before);
        assert!(world.salon.is_settled());
    }
}

#[test]
fn hair_that_cannot_be_computed_is_reported_once() {
    let mut world = World::new();
    world.small("curly");
    let text = "[head]\nmesh = \"nowhere.obj\"\n".to_owned();
    world.run(Command::Open { path: None, name: "bad.toml".into(), text });
    assert!(matches!(world.salon.badge(), Badge::Refused(_)), "{:?}", world.salon.badge());
    assert!(world.salon.messages.last().unwrap().text.contains("nowhere.obj"));
}

#[test]
fn absurd_commands_leave_a_valid_state() {
    let mut world = World::new();
    let nan = f64::NAN;
    let absurd = || {
        vec![
            Command::Undo,
            Command::Cut,
            wet(),
            Command::EndDrag,
            Command::GoTo(99),
            Command::Compare(Some(99)),
            Command::Isolate(Some(usize::MAX)),
            Command::Drag("hair.length", nan),
            Command::EndDrag,
            Command::Drag("no.such.key", 1.0),
            Command::Set("hair.length", f64::INFINITY),
            Command::SetOption("look.colour", "\"plaid\"".into()),
            Command::SetOption("look.colour", "]]]".into()),
            grow(Growth::By(nan)),
            grow(Growth::For(1e300)),
            Command::Apply(Operation::Dry(Dry { keep: -3.0, ..Dry::default() })),
            Command::Paint(vec![DVec3::splat(nan)], SelectMode::Add),
            Command::Paint(vec![], SelectMode::Add),
            Command::BrushSize(nan),
            Command::DrawLasso {
                polygon: vec![[nan; 2]; 5],
                aspect: nan,
                mode: SelectMode::Remove,
            },
            Command::DrawLasso {
                polygon: vec![[0.0; 2]; 9],
                aspect: 1.0,
                mode: SelectMode::Replace,
            },
            Command::DragComb(CombStroke { path: vec![], aspect: nan }),
            Command::DragComb(CombStroke {
                path: vec![CombPlace { at: [nan; 2], skin: Some(DVec3::splat(nan)) }; 3],
                aspect: 1.0,
            }),
            Command::Comb(CombStroke {
                path: vec![CombPlace { at: [0.0; 2], skin: Some(DVec3::ZERO) }; 3],
                aspect: 1.0,
            }),
            Command::Plane(CutPlane { point: DVec3::splat(nan), ..CutPlane::level(0.0) }),
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
    world.of("curly", 12);
    for command in absurd() {
        world.run(command);
    }
    world.salon.receive(12_345, STRAY);
    world.run(Command::GoTo(0));
    world.run(Command::SelectAll);
    assert!(world.salon.is_settled(), "{:?} {:?}", world.salon.badge(), world.salon.messages);
}

#[test]
fn a_failed_job_leaves_the_hair_as_it_was() {
    let mut world = World::new();
    world.small("curly");
    world.salon.run(wet());
    let effects = world.salon.effects();
    let Some(frisure_salon::state::Effect::Execute(_, job, _)) = effects.first() else {
        panic!("{effects:?}")
    };
    let error = Diagnostic { problem: "it broke".into(), ..Diagnostic::default() };
    world.salon.receive(*job, Response::Failed(error));
    world.settle();
    assert!(matches!(world.salon.badge(), Badge::Refused(_)));
    world.run(Command::Undo);
    assert!(world.salon.is_settled());
}

#[test]
fn restarted_workers_run_the_lost_jobs_again() {
    let mut world = World::new();
    world.small("curly");
    world.salon.run(wet());
    // The order was handed out, and nobody carries it out.
    assert!(!world.salon.effects().is_empty() && world.salon.effects().is_empty());
    world.salon.restart_jobs();
    world.settle();
    assert!(world.salon.is_settled() && world.salon.is_wet());
}

/// An exercise of the gallery with few hairs, so that tests are quick, as the code of a link.
fn small_exercise(card: &ExerciseCard) -> Command {
    let few =
        [("wisps.count", Some("24")), ("wisps.hairs", Some("240")), ("wisps.points", Some("10"))];
    Command::BeginExercise(code(&edit::set_keys(card.scene, &few).expect("a scene")))
}

#[test]
fn the_solution_of_each_exercise_reaches_its_goal() {
    for card in &EXERCISES {
        let mut world = World::new();
        world.run(small_exercise(card));
        let nearness = world.salon.nearness().expect("a measure");
        assert!(nearness.done.abs() < 1e-9, "{}: {nearness:?} at the beginning", card.name);
        world.run(Command::CompareGoal);
        assert!(world.salon.comparison.as_ref().is_some_and(|c| c.hair.is_some()));
        world.run(Command::ToggleGoalMarks);
        let marked = |world: &mut World| {
            let count = world.salon.drawn().expect("hair").0.strands.guide.len();
            let way = world.salon.way_to_goal().expect("marks");
            (count, (0..count).filter(|hair| way(*hair).is_some()).count())
        };
        let (all, far) = marked(&mut world);
        assert!(far > 0, "{}", card.name);
        // Marks are those of the hairs that are drawn, also where some are hidden.
        world.run(Command::Select(FRINGE, SelectMode::Replace));
        world.run(Command::AddSection);
        world.run(Command::HideSection(0, true));
        let (shown, far_and_shown) = marked(&mut world);
        assert!(shown < all && far_and_shown <= far, "{}", card.name);
        world.run(Command::ToggleReplay);
        // Two seconds pass with each round: the next step comes when the hair of the last one has been seen.
        let shows = |world: &World| {
            world.salon.exercise.as_ref().is_some_and(|exercise| exercise.replay.is_some())
        };
        for _ in 0..20 {
            world.settle();
            if !shows(&world) {
                break;
            }
        }
        assert!(!shows(&world), "{}", card.name);
        let nearness = world.salon.nearness().expect("a measure");
        assert!(nearness.done > 0.999, "{}: {nearness:?}", card.name);
        let steps = world.salon.exercise.as_ref().map_or(0, Exercise::steps);
        let scene = &world.salon.scene.as_ref().unwrap().scene;
        assert_eq!(scene.steps().len(), steps, "{}", card.name);
        world.run(Command::RestartExercise);
        assert!(world.salon.nearness().expect("a measure").done < 0.5, "{}", card.name);
        world.run(Command::EndExercise);
        assert!(world.salon.exercise.is_none() && world.salon.comparison.is_none());
    }
}

#[test]
fn an_undo_ends_the_solution() {
    let mut world = World::new();
    world.run(small_exercise(&EXERCISES[1]));
    world.run(Command::ToggleReplay);
    let steps = |world: &World| world.salon.scene.as_ref().map_or(0, |s| s.scene.steps().len());
    for _ in 0..20 {
        if steps(&world) > 0 {
            break;
        }
        world.settle();
    }
    assert_eq!(steps(&world), 1);
    world.run(Command::Undo);
    for _ in 0..4 {
        world.settle();
    }
    assert_eq!(steps(&world), 0);
    assert!(world.salon.exercise.as_ref().is_some_and(|exercise| exercise.replay.is_none()));
}

/// What a learner does is not the solution to the letter, and is measured by where the hair is.
#[test]
fn another_way_to_a_fringe_counts_as_well() {
    let mut world = World::new();
    world.run(small_exercise(&EXERCISES[0]));
    world.run(Command::Select(FRINGE, SelectMode::Replace));
    world.run(Command::Take(Tool::Cut));
    let level = |world: &World, name: &str| {
        let levels = &world.salon.head.as_ref().expect("a head").levels;
        levels.iter().find(|(level, _)| level == name).expect("the level").1
    };
    // Far too long at first, and dry.
    let plane = CutPlane::level(level(&world, "chin"));
    world.run(Command::Plane(plane));
    world.run(Command::Cut);
    let long = world.salon.nearness().expect("a measure");
    assert!(long.done < 0.8 && long.long > 0.01, "{long:?}");
    let plane = CutPlane::level(level(&world, "eyes"));
    world.run(Command::Plane(plane));
    world.run(Command::Cut);
    let near = world.salon.nearness().expect("a measure");
    assert!(near.is_passed(), "{near:?}");
    // Far too short.
    world.run(Command::Plane(CutPlane::level(level(&world, "brows") + 0.03)));
    world.run(Command::Cut);
    let short = world.salon.nearness().expect("a measure");
    assert!(short.short > 0.01 && short.done < near.done, "{short:?}");
}

#[test]
fn sections_hide_and_lock_hair_and_are_in_the_scene() {
    let mut world = World::new();
    world.small("straight");
    world.run(Command::AddSection);
    assert!(world.salon.sections.is_empty(), "all hair is no section");
    world.run(Command::Select(FRINGE, SelectMode::Replace));
    world.run(Command::AddSection);
    let count = world.salon.sections[0].count().expect("wisps");
    assert!(count > 0 && count < 40, "{count}");
    let all = world.salon.drawn().expect("hair").0.strands.guide.len();
    let version = world.salon.preview().unwrap().1;

    // Hidden hair is not drawn; nothing is computed again.
    world.run(Command::HideSection(0, true));
    let shown = world.salon.drawn().expect("hair").0.strands.guide.len();
    assert!(shown < all && world.salon.preview().unwrap().1 == version, "{shown} of {all}");
    assert!(world.text().contains("hidden = true"), "{}", world.text());

    // Steps leave it as it is.
    world.run(Command::SelectAll);
    world.run(wet());
    let wetness = |world: &World| world.salon.preview().unwrap().0.wetness.clone();
    let dry = wetness(&world).iter().filter(|w| **w == 0.0).count();
    assert_eq!(dry, count, "{}", world.text());
    world.run(Command::SelectSection(0, SelectMode::Replace));
    let steps = world.salon.scene.as_ref().unwrap().scene.steps().len();
    world.run(Command::ToggleWet);
    assert_eq!(world.salon.scene.as_ref().unwrap().scene.steps().len(), steps, "all is hidden");
    assert!(world.salon.messages.iter().any(|m| m.text.contains("locked or hidden")));

    // The text says all: opened again, it has the same sections.
    world.run(Command::RenameSection(0, "  my \"fringe\"  ".into()));
    let text = world.text().to_owned();
    let mut again = World::new();
    again.run(Command::Open { path: None, name: "again".into(), text });
    assert_eq!(again.salon.sections, world.salon.sections);
    assert_eq!(again.salon.sections[0].name, "my \"fringe\"");
    again.run(Command::HideSection(0, false));
    assert_eq!(again.salon.drawn().expect("hair").0.strands.guide.len(), all);
    again.run(Command::RemoveSection(0));
    assert!(again.salon.sections.is_empty() && !again.text().contains("section"));
    again.run(Command::Undo);
    assert_eq!(again.salon.sections.len(), 1);
}

#[test]
fn a_parting_divides_the_hair_into_two_sections() {
    let mut world = World::new();
    world.small("straight");
    world.run(Command::LookFrom(0.0, 1.4));
    let snip = |x: f64| Snip { ends: [[x, -0.9], [x, 0.9]], aspect: 1.0 };
    world.run(Command::Part(snip(0.0)));
    let counts = |world: &World| -> Vec<usize> {
        world.salon.sections.iter().map(|s| s.count().expect("wisps")).collect()
    };
    let halves = counts(&world);
    assert!(halves.len() == 2 && halves.iter().sum::<usize>() == 40, "{halves:?}");
    assert!(halves.iter().all(|half| *half > 10), "{halves:?}");
    // Only what is neither hidden nor locked is parted again.
    world.run(Command::LockSection(0, true));
    world.run(Command::LookFrom(std::f64::consts::FRAC_PI_2, 0.1));
    world.run(Command::Part(snip(0.0)));
    let parts = counts(&world);
    assert!(parts.len() == 4 && parts[2] + parts[3] == parts[1], "{parts:?}");
    // A line beside the head parts nothing.
    world.run(Command::Part(snip(0.95)));
    assert_eq!(world.salon.sections.len(), 4);
    assert!(world.salon.messages.iter().any(|m| m.text.contains("parts no hair")));
}

#[test]
fn a_photo_to_compare_with_is_shown_laid_over_and_removed() {
    let mut world = World::new();
    world.small("straight");
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 2, 1);
    encoder.set_color(png::ColorType::Rgb);
    let mut writer = encoder.write_header().expect("a header");
    writer.write_image_data(&[255, 0, 0, 0, 0, 255]).expect("pixels");
    writer.finish().expect("an end");
    world.run(Command::Refer("her.png".into(), png));
    let reference = world.salon.reference.as_ref().expect("a photo");
    assert_eq!((reference.size, &reference.rgb[..]), ([2, 1], &[255, 0, 0, 0, 0, 255][..]));
    world.run(Command::ReferOver(Some(7.0)));
    assert_eq!(world.salon.reference.as_ref().and_then(|r| r.over), Some(1.0));
    world.run(Command::Refer("broken.jpg".into(), vec![0xff, 0xd8, 0]));
    assert!(world.salon.messages.last().is_some_and(|m| m.is_error && m.text.contains("broken")));
    assert_eq!(world.salon.reference.as_ref().map(|r| r.name.as_str()), Some("her.png"));
    world.run(Command::EndReference);
    assert!(world.salon.reference.is_none());
}
