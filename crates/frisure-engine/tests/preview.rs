//! Previews: an exact response depends on the request alone, whatever was computed before.

mod common;

use common::{CURLY, Counted, asked, exact, failed, show, shown};
use frisure_engine::Session;
use frisure_engine::{Quality, Response, SceneRef};

/// The small scene, with wisps that make way for each other.
fn among_wisps() -> String {
    CURLY.replace("\"layers\"", "\"wisps\"").replace("count = 24", "count = 12")
}

/// The same scene with a part replaced.
fn with(asked: &SceneRef, from: &str, to: &str) -> SceneRef {
    assert!(asked.text.contains(from), "{from}");
    SceneRef { text: asked.text.replace(from, to), ..asked.clone() }
}

fn styled() -> SceneRef {
    let steps = "\n[[step]]\nwet = {}\n[[step]]\ncut = { length = '9 cm' }\n[[step]]\ndry = {}\n";
    asked(&format!("{CURLY}{steps}"), 3)
}

#[test]
fn exact_previews_have_the_same_bytes_whatever_came_before() {
    let first = styled();
    let undone = SceneRef { done: 1, ..first.clone() };
    let wider = with(&first, "9 mm", "11 mm");
    let thinner = with(&wider, "clumping = 0.5", "clumping = 0.9");
    let shorter = with(&thinner, "'9 cm'", "'6 cm'");
    let darker = with(&shorter, "brown", "black");
    let other = with(&first, "count = 24", "count = 20");
    let chain =
        [&first, &undone, &first, &wider, &thinner, &shorter, &darker, &undone, &other, &first];
    let mut session = Session::new();
    for (i, asked) in chain.into_iter().enumerate() {
        // Every other one is dragged to.
        if i % 2 == 1 {
            shown(show(&mut session, asked, Quality::Coarse, &()));
        }
        let warm = exact(&mut session, asked);
        let cold = exact(&mut Session::new(), asked);
        assert_eq!(warm.strands, cold.strands, "answer {i}");
        let numbers = |n: frisure_engine::Numbers| frisure_engine::Numbers { seconds: 0.0, ..n };
        assert_eq!(numbers(warm.numbers), numbers(cold.numbers));
        assert_eq!((warm.roots, warm.wetness), (cold.roots, cold.wetness));
    }
}

#[test]
fn among_wisps_too() {
    let first = asked(&among_wisps(), 0);
    let second = with(&first, "9 mm", "10 mm");
    let mut session = Session::new();
    shown(show(&mut session, &first, Quality::Coarse, &()));
    exact(&mut session, &first);
    shown(show(&mut session, &second, Quality::Coarse, &()));
    let cold = exact(&mut Session::new(), &second);
    assert_eq!(exact(&mut session, &second).strands, cold.strands);
}

#[test]
fn the_head_is_sent_once() {
    let mut session = Session::new();
    let asked = asked(CURLY, 0);
    assert!(exact(&mut session, &asked).head.is_some());
    assert!(exact(&mut session, &asked).head.is_none());
    assert!(exact(&mut session, &with(&asked, "9 mm", "8 mm")).head.is_none());
}

#[test]
fn coarse_hair_is_some_of_the_same_hair() {
    let mut session = Session::new();
    let asked = asked(&CURLY.replace("hairs = 300", "hairs = 12_000"), 0);
    let all = exact(&mut session, &asked);
    let some = shown(show(&mut session, &asked, Quality::Coarse, &()));
    assert!(some.stride > 1 && some.numbers.drawn < all.numbers.drawn);
    let points = |shown: &frisure_engine::Preview, hair: usize| {
        let ends = &shown.strands.offsets[hair..hair + 2];
        shown.strands.points[3 * ends[0] as usize..3 * ends[1] as usize].to_vec()
    };
    for hair in 0..some.numbers.drawn {
        assert_eq!(points(&some, hair), points(&all, hair * some.stride));
    }
    assert_eq!(some.strands.guide.len(), some.numbers.drawn);
}

#[test]
fn coarse_hair_goes_to_where_exact_hair_is() {
    let mut session = Session::new();
    let start = asked(&among_wisps(), 0);
    exact(&mut session, &start);
    let end = with(&start, "9 mm", "10 mm");
    let far = |some: &frisure_engine::Preview, all: &frisure_engine::Preview| {
        let apart = |(a, b): (&[f32], &[f32])| {
            a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum::<f32>().sqrt()
        };
        let (a, b) = (some.strands.points.chunks(3), all.strands.points.chunks(3));
        a.zip(b).map(apart).sum::<f32>() / (some.strands.points.len() / 3) as f32
    };
    let first = shown(show(&mut session, &end, Quality::Coarse, &()));
    for _ in 0..20 {
        shown(show(&mut session, &end, Quality::Coarse, &()));
    }
    let late = shown(show(&mut session, &end, Quality::Coarse, &()));
    let rest = exact(&mut session, &end);
    assert!(far(&late, &rest) <= far(&first, &rest));
    assert!(far(&late, &rest) < 0.01, "{}", far(&late, &rest));
}

#[test]
fn what_was_cancelled_anywhere_goes_on_to_the_same_bytes() {
    let asked = styled();
    let cold = exact(&mut Session::new(), &asked);
    let mut session = Session::new();
    let mut cancelled = 0;
    for most in [0, 1, 7, 30, 60, 110, 200] {
        let progress = Counted::new(most);
        match show(&mut session, &asked, Quality::Exact, &progress) {
            Response::Cancelled => cancelled += 1,
            answer => assert_eq!(shown(answer).strands, cold.strands),
        }
        let coarse = show(&mut session, &asked, Quality::Coarse, &Counted::new(most / 2));
        assert!(matches!(coarse, Response::Cancelled | Response::Preview(_)), "{coarse:?}");
    }
    assert!(cancelled > 1);
    assert_eq!(exact(&mut session, &asked).strands, cold.strands);
}

#[test]
fn progress_is_reported() {
    let progress = Counted::new(usize::MAX);
    shown(show(&mut Session::new(), &asked(CURLY, 0), Quality::Exact, &progress));
    assert!(progress.reports() > 3);
}

#[test]
fn an_impossible_scene_fails_with_its_line() {
    let mut session = Session::new();
    let mut diagnostic =
        |text: &str, done| failed(show(&mut session, &asked(text, done), Quality::Exact, &()));
    let unit = diagnostic("seed = 1\n[hair]\nlength = 9000\n", 0);
    assert_eq!((unit.key.as_str(), unit.line), ("hair.length", 3));
    assert!(!unit.hint.is_empty());
    let unknown = diagnostic("[hair]\nlenght = '9 cm'\n", 0);
    assert!(unknown.line == 2 && unknown.hint.contains("length"), "{unknown:?}");
    let syntax = diagnostic("[hair\n", 0);
    assert!(syntax.line == 1 && syntax.key.is_empty());
    let file = diagnostic("[head]\nmesh = 'nowhere.obj'\n", 0);
    assert_eq!((file.key.as_str(), file.line), ("head.mesh", 2));
    let step =
        diagnostic(&format!("{CURLY}\n[[step]]\nwet = {{ where = {{ wisps = [99] }} }}\n"), 1);
    assert!(step.line > 0 && step.key.starts_with("step[0]"), "{step:?}");
    let many = diagnostic("[wisps]\nhairs = 2_000_000\n", 0);
    assert_eq!((many.key.as_str(), many.line), ("wisps.hairs", 2));
    let crowded = diagnostic("[wisps]\ncount = 50_000\n", 0);
    assert_eq!(crowded.key, "wisps.count");
    // What was undone is not done, though it cannot be.
    exact(
        &mut session,
        &asked(&format!("{CURLY}\n[[step]]\nwet = {{ where = {{ wisps = [99] }} }}\n"), 0),
    );
}

#[test]
fn previews_have_what_holds_the_hair_as_long_as_it_is_held_and_shown() {
    let steps = "\n[[step]]\nroll = { radius = '9 mm' }\n[[step]]\nrelease = {}\n";
    let rolled = asked(&format!("{CURLY}{steps}"), 1);
    let mut session = Session::new();
    let on_rollers = exact(&mut session, &rolled).accessories;
    let meshes = on_rollers.meshes();
    assert!(!meshes.is_empty() && meshes.len() == on_rollers.parts.len());
    assert!(meshes.iter().all(|mesh| mesh.name.starts_with("roller_")));
    assert_eq!(on_rollers.positions.len(), on_rollers.normals.len());
    let released = SceneRef { done: 2, ..rolled.clone() };
    assert!(exact(&mut session, &released).accessories.parts.is_empty());
    let hidden = with(&rolled, "[look]", "[output]\naccessories = false\n[look]");
    assert!(exact(&mut session, &hidden).accessories.parts.is_empty());
}
