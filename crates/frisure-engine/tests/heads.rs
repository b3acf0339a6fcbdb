//! Heads that do not stand upright.

use std::path::{Path, PathBuf};

use frisure::files::Files;
use frisure::hairstyle::head::Stance;
use frisure::scene::{Scene, SceneError};
use frisure_engine::{HeadCache, LoadedHead};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes/heads")
}

fn load(keys: &str) -> Result<LoadedHead, SceneError> {
    let text = format!("[head]\nmesh = \"female-head.obj\"\n{keys}\n");
    let scene = Scene::parse("a.toml", text, &folder()).unwrap();
    HeadCache::default().load(&scene, &Files::default())
}

#[test]
fn a_head_with_the_wrong_axis_up_is_refused_with_the_turn_that_mends_it() {
    assert!(load("").is_ok());
    let error = load("up = \"z\"").unwrap_err();
    let found = error.diagnostic().unwrap();
    let (message, hint) = (found.message(), &found.hint);
    assert!(message.contains("does not stand upright"), "{message}");
    let turn = hint.split('`').find(|part| part.starts_with("turn = ")).unwrap();
    let mended = load(&format!("up = \"z\"\n{turn}")).unwrap();
    assert_eq!(mended.head.stance(), Stance::Upright, "{turn}");
    // The crown of the head is up again, near where the other axis has it.
    let known = load("").unwrap().head.landmarks().clone();
    let found = mended.head.landmarks();
    let high = |l: &frisure::hairstyle::head::Landmarks| (l.whorl - l.cranium_centre).normalize();
    assert!(high(found).distance(high(&known)) < 0.4, "{turn}");
}

#[test]
fn a_head_that_leans_is_taken_with_a_warning_that_has_the_turn() {
    let text = std::fs::read_to_string(folder().join("female-head.obj")).unwrap();
    let tilt = glam::DMat3::from_rotation_x(f64::to_radians(20.0));
    let tilted = |line: &str| match line.strip_prefix("v ") {
        None => line.to_owned(),
        Some(numbers) => {
            let p: Vec<f64> = numbers.split_whitespace().map(|x| x.parse().unwrap()).collect();
            let p = tilt * glam::DVec3::new(p[0], p[1], p[2]);
            format!("v {} {} {}", p.x, p.y, p.z)
        }
    };
    let text: Vec<String> = text.lines().map(tilted).collect();
    let room = tempfile::tempdir().unwrap();
    std::fs::write(room.path().join("a.obj"), text.join("\n")).unwrap();
    let load = |line: &str| {
        let text = format!("[head]\nmesh = \"a.obj\"\n{line}\n");
        let scene = Scene::parse("a.toml", text, room.path()).unwrap();
        HeadCache::default().load(&scene, &Files::default()).unwrap()
    };
    let note = load("").note.unwrap();
    assert!(note.contains("leans by about"), "{note}");
    let turn = note.split('`').find(|part| part.starts_with("turn = ")).unwrap();
    let mended = load(turn);
    assert_eq!(mended.head.stance(), Stance::Upright, "{turn}");
    // Who turns it has looked at it.
    for taken in [mended, load("turn = [0, 0, 0]")] {
        assert!(taken.note.is_none_or(|note| !note.contains("leans")));
    }
}

#[test]
fn who_turns_a_head_is_warned_and_not_corrected() {
    let taken = load("up = \"z\"\nturn = [0, 0, 0]").unwrap();
    assert!(taken.note.unwrap().contains("does not stand upright"));
    // One that stands is no reason for a warning.
    let upright = load("turn = [0, 0, 0]").unwrap();
    assert!(upright.note.is_none_or(|note| !note.contains("upright")));
}
