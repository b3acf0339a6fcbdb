//! The targets.

use std::path::{Path, PathBuf};
use std::{env, fs, process};

use frisure::files::Files;
use frisure::files::frame::FrameChoice;
use frisure::files::head::{HeadFile, ScalpSource};
use frisure::formats::groom::{self, Format, Groom, attributes};
use frisure::formats::picture::photo;
use frisure::formats::{environment, head};
use frisure::render::trace::Accumulator;
use frisure::scene::batch::Batch;
use frisure::scene::history::HistoryFile;
use frisure::scene::measurements::{Choices, measured};
use frisure::scene::{Scene, parse_step, write_step};
use frisure::strands::{AttributeValues, Strands};
use glam::Vec3;

use crate::Target;

/// All targets.
#[must_use]
pub fn targets() -> Vec<Target> {
    groom_targets().chain(other_targets()).collect()
}

/// The files of a folder of the corpus, by name; none if there is no such folder.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("corpus").join(name);
    if !folder.exists() {
        return Vec::new();
    }
    let entries = fs::read_dir(&folder).unwrap_or_else(|e| panic!("{}: {e}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}

/// A groom with attributes, small enough that mutations meet its structure.
fn small_groom() -> Groom {
    let mut hairs = Strands::new();
    for i in 0..4_u16 {
        let x = f32::from(i) * 1e-3;
        hairs.push(
            &[Vec3::new(x, 0.0, 0.2), Vec3::new(x, 0.01, 0.1), Vec3::new(x, 0.02, 0.0)],
            &[4e-5, 3e-5, 2e-5],
        );
    }
    let guides = hairs.clone();
    let id = attributes::of_strands(attributes::ID, AttributeValues::U32(vec![0, 1, 2, 3]));
    hairs.set_attribute(id).unwrap();
    Groom { guides, ..Groom::of(hairs) }
}

fn read_groom(format: Format, bytes: &[u8]) -> Option<Groom> {
    groom::decode(format, bytes, Path::new("a"), FrameChoice::default()).ok()
}

/// Reads a groom, and what is written of it.
fn use_groom(format: Format, bytes: &[u8]) {
    let Some(found) = read_groom(format, bytes) else { return };
    assert!(found.hairs.points().iter().all(|p| p.is_finite()));
    for name in ["usda", "npz"] {
        let Some(other) = Format::named(name) else { continue };
        // Not every groom fits every format.
        let Ok(written) = groom::encode(other, &found, FrameChoice::default()) else { continue };
        let again = groom::decode(other, &written, Path::new("b"), FrameChoice::default());
        let again = again.unwrap_or_else(|e| panic!("a .{name} of ours is refused: {e}"));
        assert_eq!(again.hairs.len() + again.guides.len(), found.hairs.len() + found.guides.len());
    }
}

fn groom_targets() -> impl Iterator<Item = Target> {
    let given = corpus("groom");
    Format::ALL.iter().copied().filter(|format| format.is_read()).map(move |format| {
        let written = groom::encode(format, &small_groom(), FrameChoice::default());
        let mut files: Vec<Vec<u8>> = written.into_iter().collect();
        if format.extension().starts_with("usd") || files.is_empty() {
            files.extend(given.iter().cloned());
        }
        // What failed once.
        files.extend(corpus(&format!("groom-{}", format.extension())));
        let run = Box::new(move |bytes: &[u8]| use_groom(format, bytes));
        Target { name: format!("groom-{}", format.extension()), corpus: files, run }
    })
}

fn use_head(bytes: &[u8]) {
    let mut files = Files::default();
    files.provide("head", bytes);
    let frame = FrameChoice { metres: Some(0.1), up: None, ..FrameChoice::default() };
    let path = PathBuf::from("head");
    for scalp in [
        ScalpSource::Guess,
        ScalpSource::Group("top".into()),
        ScalpSource::Colour("red".into()),
        ScalpSource::Weights(path.clone()),
        ScalpSource::Mask(path.clone()),
    ] {
        let _ = head::read(&HeadFile { path: path.clone(), frame, turn: None, scalp }, &files);
    }
}

fn use_environment(bytes: &[u8]) {
    for name in ["a.hdr", "a.exr"] {
        let mut files = Files::default();
        files.provide(name, bytes);
        let _ = environment::read(Path::new(name), &files, usize::MAX);
    }
}

fn use_scene(text: &str) {
    let Ok(scene) = Scene::parse("any", text, Path::new("")) else { return };
    let _ = scene.hairstyle_spec();
    let _ = scene.single_hair();
    for step in scene.steps() {
        write_step(step).expect("a step that is read is written");
    }
}

fn use_measurements(bytes: &[u8]) {
    // The reader takes files; of each process its own.
    let path = env::temp_dir().join(format!("frisure-fuzz-{}.csv", process::id()));
    fs::write(&path, bytes).unwrap();
    if let Ok(estimate) = measured(&[&path], &Choices::default()) {
        // Numbers that no hair has are refused then, as `frisure measured` does before it writes.
        let _ = Scene::parse("measured", estimate.scene(), Path::new(""));
    }
    let _ = fs::remove_file(&path);
}

/// A target that reads text.
fn text_target(
    name: &str,
    corpus: Vec<Vec<u8>>,
    run: impl Fn(&str) + Send + Sync + 'static,
) -> Target {
    let run = Box::new(move |bytes: &[u8]| run(&String::from_utf8_lossy(bytes)));
    Target { name: name.into(), corpus, run }
}

fn other_targets() -> Vec<Target> {
    let target = |name: &str, corpus, run: fn(&[u8])| Target {
        name: name.into(),
        corpus,
        run: Box::new(run),
    };
    let light =
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x80\x80\x80\x40\x20\x10\x81";
    let checkpoint = [&b"frixpos\x01"[..], &[0; 8], &[1, 0, 0, 0, 1, 0, 0, 0], &[0; 104]].concat();
    let steps = vec![parse_step("wet", "wet = { to = 1 }").expect("a step")];
    let saved = HistoryFile { scene_text: "seed = 1\n".into(), operations: steps, done: 1 };
    let saved = saved.text().expect("a history").into_bytes();
    vec![
        target("head", corpus("head"), use_head),
        target("environment", vec![light.to_vec()], use_environment),
        target("photo", corpus("photo"), |bytes| {
            let _ = photo::decode(bytes, Path::new("any"));
        }),
        target("picture-checkpoint", vec![checkpoint], |bytes| {
            let _ = Accumulator::from_bytes(bytes);
        }),
        target("measurements", corpus("measured"), use_measurements),
        text_target("scene", corpus("scene"), use_scene),
        text_target("batch", corpus("batch"), |text| {
            let _ = Batch::parse("any", text, Path::new(""));
        }),
        text_target("step", corpus("step"), |text| {
            let _ = parse_step("any", text);
        }),
        text_target("history", vec![saved], |text| {
            let _ = HistoryFile::parse("any", text);
        }),
    ]
}
