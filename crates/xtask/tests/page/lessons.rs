//! The tour and the exercises, as an apprentice takes them in a browser.

use crate::SIZE;
use crate::salon::Salon;
use base64::Engine;
use base64::prelude::BASE64_URL_SAFE_NO_PAD;
use flate2::Compression;
use flate2::write::DeflateEncoder;
use std::io::Write;

const QUERY: &str = "?backend=webgl&samples=1&hairs=240";

/// A scene that takes no time.
const SMALL: &str = "[hair]\ntype = \"caucasian-curly\"\nlength = \"14 cm\"\n[wisps]\ncount = 24\n";

/// The exercises of the gallery.
const EXERCISES: [(&str, &str); 6] = [
    ("fringe", include_str!("../../../frisure-salon/exercises/fringe.toml")),
    ("bob", include_str!("../../../frisure-salon/exercises/bob.toml")),
    ("layers", include_str!("../../../frisure-salon/exercises/layers.toml")),
    ("curly-cut", include_str!("../../../frisure-salon/exercises/curly-cut.toml")),
    ("braid", include_str!("../../../frisure-salon/exercises/braid.toml")),
    ("twist-out", include_str!("../../../frisure-salon/exercises/twist-out.toml")),
];

#[test]
fn the_tour_is_taken_step_by_step() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    salon.click("Take the tour");
    salon.until("s.tour && s.tour.at == 0 && !s.tour.done");
    // A head with fewer hairs, for the time's sake.
    salon.page.drop_file("small.toml", SMALL);
    salon.until("s.name == 'small.toml' && s.settled && s.tour");
    let [x, y] = salon.middle("The head");
    salon.page.drag([x - 100.0, y], [x + 60.0, y]);
    salon.until("s.tour.done");
    salon.click("Next");
    salon.click("Wet");
    salon.until("s.wet && s.settled && s.tour.at == 1 && s.tour.done");
    salon.click("Next");
    salon.click("Fringe");
    salon.until("s.selectedWisps > 0 && s.tour.at == 2 && s.tour.done");
    salon.picture("tour");
    salon.click("Next");
    salon.click("Cut");
    // Drags the plane above the selected tips.
    salon.page.drag([x, y + 120.0], [x, y + 50.0]);
    salon.click("Cut here");
    salon.until("s.settled && s.tour.at == 3 && s.tour.done");
    salon.click("Next");
    salon.click("Dry");
    salon.until("!s.wet && s.settled");
    salon.page.key("x", "KeyX");
    salon.until("s.tour.at == 4 && s.tour.done");
    salon.click("Next");
    salon.click("End");
    salon.until("!s.tour");
    salon.is_quiet();
}

#[test]
fn an_exercise_of_the_gallery_is_begun() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    salon.runs();
    // The exercises are below the cards of hair.
    salon.page.scroll(SIZE.map(|size| f64::from(size) / 2.0), 4000.0);
    salon.click("Begin: A bob");
    salon.until("s.exercise && s.exercise.title == 'A bob' && s.exercise.goal && s.drawn");
    salon.until("s.settled && s.exercise.done === 0");
    salon.picture("exercise-bob-begins");
    salon.is_quiet();
}

#[test]
fn the_solution_of_each_exercise_reaches_its_goal() {
    let Some(mut salon) = Salon::open(QUERY, &[], &[]) else { return };
    for (i, (name, scene)) in EXERCISES.into_iter().enumerate() {
        salon.again(&format!("{QUERY}&exercise={}", code(&few(scene))));
        salon.runs();
        if i > 0 {
            // The hair of the last exercise was not saved.
            salon.click("Discard");
        }
        salon.until("s.exercise && s.exercise.goal && s.settled && s.exercise.done === 0");
        let before = salon.picture(&format!("exercise-{name}"));
        salon.click("Show me");
        salon.until("s.exercise.shows");
        salon.until("!s.exercise.shows && s.settled && s.exercise.done > 0.999");
        let after = salon.picture(&format!("exercise-{name}-done"));
        assert!(after.change(&before, [0.0, 0.0, 0.6, 1.0]) > 0.003, "{name} looks as before");
    }
    salon.is_quiet();
}

/// The scene with few guides and hairs, for the time's sake.
fn few(scene: &str) -> String {
    let start = scene.find("[wisps]").expect("wisps");
    let value = start + scene[start..].find("count = ").expect("a count") + "count = ".len();
    let end = value + scene[value..].find('\n').expect("an end");
    format!("{}24\nhairs = 2000\npoints = 10{}", &scene[..value], &scene[end..])
}

/// The code of a scene for the address of the page, as `docs/page.md` has it.
fn code(scene: &str) -> String {
    let mut encoder = DeflateEncoder::new(Vec::new(), Compression::best());
    encoder.write_all(scene.as_bytes()).expect("written to memory");
    format!("z.{}", BASE64_URL_SAFE_NO_PAD.encode(encoder.finish().expect("written to memory")))
}
