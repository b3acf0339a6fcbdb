//! What holds the hair, in files of grooms: it is there when it is asked for, and is never taken for the head.

use std::path::Path;

use frisure_files::Files;
use frisure_files::frame::FrameChoice;
use frisure_files::head::HeadFile;
use frisure_formats::contents::{self, Contents};
use frisure_formats::groom::{Format, Groom, decode, encode};
use frisure_formats::head;
use frisure_strands::{AccessoryMaterial, AccessoryMesh, Strands, Surface};
use glam::{DVec3, Vec3};

const FORMATS: [&str; 6] = ["usdc", "usda", "usdz", "abc", "glb", "obj"];

/// A tetrahedron of a size (m) at a point (m).
fn tetrahedron(at: DVec3, size: f64) -> Surface {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|p| at + size * p);
    let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    Surface::new(corners.to_vec(), faces).unwrap()
}

fn groom(with: bool) -> Groom {
    let mut hairs = Strands::new();
    hairs.push(&[Vec3::ZERO, Vec3::new(0.0, 0.01, -0.1), Vec3::new(0.0, 0.0, -0.2)], &[4e-5; 3]);
    let material = AccessoryMaterial {
        name: "plastic",
        colour: [0.5, 0.25, 0.125],
        gloss: 0.1,
        roughness: 0.25,
    };
    let mesh = |name: &str, x: f64| AccessoryMesh {
        name: name.into(),
        material,
        surface: tetrahedron(DVec3::X * x, 0.02),
    };
    let accessories =
        if with { vec![mesh("roller_0", 0.1), mesh("roller_1", 0.2)] } else { vec![] };
    let head = Some(tetrahedron(DVec3::ZERO, 0.2));
    Groom { head, accessories, ..Groom::of(hairs) }
}

fn file(extension: &str, groom: &Groom) -> Vec<u8> {
    encode(Format::named(extension).unwrap(), groom, FrameChoice::default()).unwrap()
}

fn has(bytes: &[u8], text: &str) -> bool {
    bytes.windows(text.len()).any(|part| part == text.as_bytes())
}

#[test]
fn a_groom_with_accessories_is_read_as_the_same_groom_without_them() {
    for extension in FORMATS {
        let format = Format::named(extension).unwrap();
        let (with, without) = (file(extension, &groom(true)), file(extension, &groom(false)));
        assert!(with.len() > without.len(), "{extension}");
        assert!(!has(&without, "accessories"), "{extension}");
        if format.is_read() {
            let read = |bytes: &[u8]| {
                decode(format, bytes, Path::new("a"), FrameChoice::default()).unwrap()
            };
            assert_eq!(read(&with), read(&without), "{extension}");
        }
    }
    // These are not packed.
    for (extension, name) in [
        ("usda", "roller_1"),
        ("abc", "roller_1Shape"),
        ("glb", "accessories/roller_1"),
        ("obj", "o accessories/roller_1"),
    ] {
        assert!(has(&file(extension, &groom(true)), name), "{extension}");
    }
}

#[test]
fn accessories_are_not_taken_for_a_head() {
    for extension in FORMATS {
        let name = format!("a.{extension}");
        let mut files = Files::default();
        files.provide(&name, &file(extension, &groom(true))[..]);
        let found = contents::of(Path::new(&name), &files).unwrap();
        let read = head::read(&HeadFile::new(name.clone().into()), &files);
        if extension.starts_with("usd") {
            assert_eq!(found, Contents { head: true, groom: true }, "{extension}");
            let (read, own) = (read.unwrap().surface, tetrahedron(DVec3::ZERO, 0.2));
            assert_eq!(read.triangles().len(), own.triangles().len(), "{extension}");
            assert!((read.area() / own.area() - 1.0).abs() < 1e-6);
        } else {
            assert!(read.is_err(), "{extension}: there is no head");
        }
    }
    let mut files = Files::default();
    files.provide("a.obj", &file("obj", &groom(true))[..]);
    let found = contents::of(Path::new("a.obj"), &files).unwrap();
    assert_eq!(found, Contents { head: false, groom: true });
}

#[test]
fn formats_of_strands_alone_say_which_can_hold_accessories() {
    for format in Format::ALL.iter().filter(|format| !format.holds_accessories()) {
        let error = encode(*format, &groom(true), FrameChoice::default()).unwrap_err().to_string();
        assert!(error.contains("cannot hold accessories; .obj"), "{error}");
    }
}
