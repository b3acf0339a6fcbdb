//! Grooms in every format: what is written is read, and nothing that is read panics.

use std::path::Path;

use frisure_files::frame::{FrameChoice, UpAxis};
use frisure_formats::groom::attributes as names;
use frisure_formats::groom::attributes::{of_points, of_strands};
use frisure_formats::groom::{Format, Groom, HairColour, decode, encode};
use frisure_strands::{AttributeValues as Values, Domain, Strands};
use glam::Vec3;
use proptest::prelude::*;

/// Three hairs and two guides with everything that grooms can have.
fn groom() -> Groom {
    let mut hairs = strands(&[3, 3, 3]);
    let points = hairs.points().len();
    let many = |x: f32| (0..points).map(|i| x * i as f32).collect::<Vec<_>>();
    for attribute in [
        of_strands(names::GUIDE, Values::U32(vec![1, 0, 1])),
        of_strands(names::CLOSEST_GUIDES, Values::U32x3(vec![[1, 0, 0], [0, 1, 1], [1, 1, 0]])),
        of_strands(names::GUIDE_WEIGHTS, Values::F32x3(vec![[0.5, 0.25, 0.25]; 3])),
        of_strands(names::ID, Values::U32(vec![10, 11, 12])),
        of_strands(names::CLUMP, Values::U32(vec![7, 8, 7])),
        // The last follows a guide of another group.
        of_strands(names::GROUP, Values::U32(vec![0, 5, 5])),
        of_strands(names::ROOT_UV, Values::F32x2(vec![[0.25, 0.5], [0.75, 0.125], [0.0, 1.0]])),
        of_strands(names::AXIS_RATIO, Values::F32(vec![1.25, 1.5, 1.75])),
        of_points(
            names::COLOUR,
            Values::F32x3(many(0.1).iter().map(|&x| [x, 0.5, 0.25]).collect()),
        ),
        of_points(names::WETNESS, Values::F32(many(0.125))),
        of_points(names::DIRECTOR, Values::F32x3(vec![[0.0, 0.6, -0.8]; points])),
        of_points(names::NATURAL_STRAIN, Values::F32x3(vec![[100.0, -2.5, 7.0]; points])),
    ] {
        hairs.set_attribute(attribute).unwrap();
    }
    let mut guides = strands(&[3, 3]);
    for attribute in [
        of_strands(names::GUIDE, Values::U32(vec![0, 1])),
        of_strands(names::GROUP, Values::U32(vec![5, 0])),
    ] {
        guides.set_attribute(attribute).unwrap();
    }
    let colour = Some(HairColour { melanin: None, colour: [0.25, 0.125, 0.0625] });
    Groom { name: "fine_hair".into(), hairs, guides, colour, ..Groom::default() }
}

fn strands(counts: &[usize]) -> Strands {
    let mut strands = Strands::new();
    for (i, &n) in counts.iter().enumerate() {
        let line: Vec<Vec3> = (0..n)
            .map(|k| Vec3::new(0.013 * i as f32, 0.02 * k as f32 - 0.1, 0.11 - 0.017 * k as f32))
            .collect();
        let radii: Vec<f32> = (0..n).map(|k| 4e-5 - 2e-6 * k as f32).collect();
        strands.push(&line, &radii);
    }
    strands
}

fn read(format: Format, bytes: &[u8]) -> Result<Groom, String> {
    let path = Path::new("hair");
    decode(format, bytes, path, FrameChoice::default()).map_err(|e| e.to_string())
}

fn readable() -> impl Iterator<Item = Format> {
    Format::ALL.iter().copied().filter(|f| f.is_read())
}

fn named(extension: &str) -> Format {
    Format::named(extension).unwrap()
}

fn written(format: Format, groom: &Groom) -> Vec<u8> {
    encode(format, groom, FrameChoice::default()).unwrap()
}

/// Largest distance (m) of points that should be the same.
fn apart(a: &Strands, b: &Strands) -> f32 {
    assert_eq!(a.offsets(), b.offsets());
    a.points().iter().zip(b.points()).map(|(p, q)| p.distance(*q)).fold(0.0, f32::max)
}

#[test]
fn what_is_written_is_read() {
    let groom = groom();
    for format in readable() {
        let back = read(format, &written(format, &groom)).unwrap();
        let name = format.extension();
        assert!(apart(&back.hairs, &groom.hairs) < 1e-7, "{name}");
        if format.holds_guides() {
            assert!(apart(&back.guides, &groom.guides) < 1e-7, "{name}");
            assert_eq!(names::indices(&back.guides, names::GROUP), Some(&[5, 0][..]), "{name}");
            assert_eq!(back.colour, groom.colour, "{name}");
            for attribute in groom.hairs.attributes() {
                let found = back.hairs.attribute(&attribute.name);
                assert_eq!(found, Some(attribute), "{name}");
            }
            assert_eq!(back.hairs.attributes().len(), groom.hairs.attributes().len(), "{name}");
        }
    }
}

/// From each format to each other: nothing more is lost than either has no room for.
#[test]
fn any_format_becomes_any_other() {
    let groom = groom();
    for (first, second) in readable().flat_map(|a| readable().map(move |b| (a, b))) {
        let names = format!("{} to {}", first.extension(), second.extension());
        let once = read(first, &written(first, &groom)).unwrap();
        let twice =
            read(second, &written(second, &once)).unwrap_or_else(|e| panic!("{names}: {e}"));
        assert!(apart(&twice.hairs, &groom.hairs) < 2e-7, "{names}");
        let has_radii = |f: Format| !["obj", "data"].contains(&f.extension());
        if has_radii(first) && has_radii(second) {
            let pairs = twice.hairs.radii().iter().zip(groom.hairs.radii());
            assert!(pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f32::max) < 1e-10, "{names}");
        }
        if first.holds_guides() && second.holds_guides() {
            assert!(apart(&twice.guides, &groom.guides) < 2e-7, "{names}");
            assert_eq!(twice.colour, groom.colour, "{names}");
            for attribute in groom.hairs.attributes() {
                let found = twice.hairs.attribute(&attribute.name);
                assert_eq!(found, Some(attribute), "{names}");
            }
        }
    }
}

#[test]
fn strands_of_any_length_come_back() {
    let groom = Groom::of(strands(&[2, 5, 3, 17]));
    for format in readable() {
        let back = read(format, &written(format, &groom)).unwrap();
        assert!(apart(&back.hairs, &groom.hairs) < 1e-7, "{}", format.extension());
    }
}

#[test]
fn the_same_groom_gives_the_same_bytes() {
    for &format in Format::ALL {
        assert_eq!(written(format, &groom()), written(format, &groom()));
    }
}

/// Written by the Alembic library 1.8.12: two lines of three points under a transform by (1, 2, 3), with
/// properties of Unreal's.
#[test]
fn a_file_of_the_alembic_library_is_read() {
    let groom = read(named("abc"), include_bytes!("data/library.abc")).unwrap();
    assert_eq!((groom.name.as_str(), groom.hairs.offsets()), ("groom", &[0, 3, 6][..]));
    // Point i is (i, 2i, 0), in centimetres, y up.
    for (i, p) in groom.hairs.points().iter().enumerate() {
        let (x, y) = (i as f32 + 1.0, 2.0 * i as f32 + 2.0);
        assert!(p.distance(0.01 * Vec3::new(x, -3.0, y)) < 1e-7);
    }
    assert!(groom.hairs.radii().iter().all(|r| (r - 5e-4).abs() < 1e-9));
    assert_eq!(names::indices(&groom.hairs, names::ID), Some(&[4, 5][..]));
    let uv = groom.hairs.attribute(names::ROOT_UV).map(|a| &a.values);
    assert_eq!(uv, Some(&Values::F32x2(vec![[0.1, 0.2], [0.3, 0.4]])));
}

#[test]
fn what_is_wrong_is_told() {
    let cases: [(Format, &[u8], &str); 9] = [
        (named("abc"), b"\x89HDF\r\n\x1a\n and so on", "HDF5"),
        (named("abc"), b"Ogawa\x00\x00\x01\0\0\0\0\0\0\0\0", "did not finish"),
        (named("abc"), b"ogre", "does not begin with `Ogawa`"),
        (named("npz"), b"PK", "its zip is damaged"),
        (named("data"), b"\xff\xff\xff\x7f", "2147483647 strands cannot be in 4 bytes"),
        (named("obj"), b"v 0 0 0\nl 1 2", "names point 1 of 1"),
        (named("obj"), b"v 0 0 0\nv 0 0", "in line 2, a point has fewer than 3 numbers"),
        (named("ply"), b"ply\nformat ascii 1.0\nelement vertex 9\nend_header\n", "no x, y and z"),
        (named("ply"), b"obj", "its header has no end"),
    ];
    for (format, bytes, expected) in cases {
        let error = read(format, bytes).unwrap_err();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn nobody_follows_a_guide_that_is_not_there() {
    let one = Groom { guides: strands(&[3]), ..groom() };
    let error = read(named("npz"), &written(named("npz"), &one)).unwrap_err();
    assert!(error.ends_with("strand 0 follows guide 1, and it has 1"), "{error}");
}

/// An attribute may have any name, also that of something else in the file.
#[test]
fn attributes_with_names_of_other_things_come_back() {
    let names = [
        "guide_",
        "guide_id",
        "guide_positions",
        "positions",
        "points",
        "strands",
        "offsets",
        "radii",
        "widths",
        "velocities",
        "metres",
        "up",
        "name",
        "hair_color",
        "melanin",
        "attribute_",
        "attribute_up",
        "attribute_attribute_up",
        "xform",
        "st",
    ];
    for guides in [strands(&[2, 3]), Strands::new()] {
        for format in readable() {
            for name in names {
                let mut hairs = strands(&[3, 2, 4]);
                hairs.set_attribute(of_strands(name, Values::U32(vec![7, 8, 9]))).unwrap();
                let wanted = hairs.attribute(name).cloned();
                let groom = Groom { hairs, guides: guides.clone(), ..Groom::default() };
                let bytes = written(format, &groom);
                let of = format.extension();
                let back = read(format, &bytes).unwrap_or_else(|e| panic!("{of} {name}: {e}"));
                assert_eq!(back.hairs.len(), 3, "{of} {name}");
                // Formats without attributes of others have none.
                let kept = back.hairs.attribute(name).cloned();
                assert!(kept.is_none() || kept == wanted, "{of} {name}: {kept:?}");
                assert!(kept.is_some() || of != "npz", "{of} {name}");
            }
        }
    }
}

/// Numbers of guides that are not in the file would be taken for those of hairs.
#[test]
fn hairs_alone_follow_nobody_in_unreal() {
    let alone = Groom { guides: Strands::new(), ..groom() };
    let bytes = written(named("abc"), &alone);
    let has = |name: &[u8]| bytes.windows(name.len()).any(|w| w == name);
    assert!(!has(b"groom_closest_guides") && has(b"frisure_closest_guides"));
    let back = read(named("abc"), &bytes).unwrap();
    let closest = |g: &Groom| g.hairs.attribute(names::CLOSEST_GUIDES).cloned();
    assert_eq!(closest(&back), closest(&alone));
}

#[test]
fn nothing_is_something() {
    for format in readable() {
        let empty = encode(format, &Groom::default(), FrameChoice::default());
        if let Ok(bytes) = empty {
            let back =
                read(format, &bytes).unwrap_or_else(|e| panic!("{}: {e}", format.extension()));
            assert!(back.hairs.is_empty() && back.guides.is_empty(), "{}", format.extension());
        }
    }
}

#[test]
fn any_unit_and_axes_come_back() {
    let groom = groom();
    for format in readable() {
        let choice =
            FrameChoice { metres: Some(0.0254), up: Some(UpAxis::Z), ..FrameChoice::default() };
        let bytes = encode(format, &groom, choice).unwrap();
        let back = decode(format, &bytes, Path::new("a"), choice).unwrap();
        assert!(apart(&back.hairs, &groom.hairs) < 1e-7, "{}", format.extension());
        if let Some(a) = back.hairs.attribute(names::DIRECTOR) {
            assert_eq!(
                (a.domain, a),
                (Domain::Point, groom.hairs.attribute(names::DIRECTOR).unwrap())
            );
        }
    }
}

/// Engines put hairs together by their wisps: those of the guides, where a groom says nothing else.
#[test]
fn hairs_of_a_guide_are_one_wisp() {
    let mut groom = groom();
    groom.hairs = groom.hairs.with_attributes(|name| name != names::CLUMP);
    for format in ["abc", "usda", "usdc"].map(named) {
        let back = read(format, &written(format, &groom)).unwrap();
        assert_eq!(names::indices(&back.hairs, names::CLUMP), Some(&[1, 0, 1][..]));
    }
    let has = |bytes: &[u8], name: &[u8]| bytes.windows(name.len()).any(|w| w == name);
    for format in ["abc", "usda"].map(named) {
        assert!(has(&written(format, &groom), b"groom_group_cards_id"));
    }
}

/// glTF 2.0, section 3.4: "The units for all linear distances are meters", y is up.
#[test]
fn gltf_is_in_metres_with_y_up() {
    let frame = named("glb").frame();
    let usual =
        FrameChoice { metres: Some(frame.metres), up: Some(frame.up), ..FrameChoice::default() };
    assert_eq!((frame.metres, frame.up), (1.0, UpAxis::Y));
    assert_eq!(encode(named("glb"), &groom(), usual).unwrap(), written(named("glb"), &groom()));
    let centimetres = FrameChoice { metres: Some(0.01), ..FrameChoice::default() };
    for choice in [centimetres, FrameChoice { up: Some(UpAxis::Z), ..FrameChoice::default() }] {
        let error = encode(named("glb"), &groom(), choice).unwrap_err().to_string();
        assert_eq!(error, "a .glb file is in metres, y up, by its specification");
    }
}

#[test]
fn files_cut_short_are_told_or_read_in_part() {
    for format in readable() {
        let whole = written(format, &groom());
        for n in 0..whole.len() {
            if let Err(error) = read(format, &whole[..n]) {
                assert!(!error.is_empty());
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    /// Bytes, and words where words are, are other ones.
    #[test]
    fn damaged_files(
        which in any::<prop::sample::Index>(),
        edits in proptest::collection::vec(
            (any::<prop::sample::Index>(), prop_oneof![
                any::<u8>().prop_map(|b| vec![b]),
                any::<u32>().prop_map(|w| w.to_le_bytes().to_vec()),
                (0_u64..30_000).prop_map(|w| w.to_le_bytes().to_vec()),
                Just(u64::MAX.to_le_bytes().to_vec()),
                Just(f32::NAN.to_le_bytes().to_vec()),
                "[0-9eE.,:(){}\\-\n x/]{1,6}".prop_map(String::into_bytes),
            ]),
            1..6,
        )
    ) {
        let formats: Vec<Format> = readable().collect();
        let format = *which.get(&formats);
        let mut bytes = written(format, &groom());
        for (at, piece) in edits {
            let at = at.index(bytes.len());
            let end = (at + piece.len()).min(bytes.len());
            bytes[at..end].copy_from_slice(&piece[..end - at]);
        }
        if let Ok(groom) = read(format, &bytes) {
            prop_assert!(groom.hairs.points().iter().all(|p| p.is_finite()));
        }
    }

    #[test]
    fn any_bytes(
        which in any::<prop::sample::Index>(),
        magic in proptest::sample::select(vec!["", "Ogawa", "ply\n", "PK\x03\x04", "v 1 2 3\n"]),
        rest in proptest::collection::vec(any::<u8>(), 0..300),
    ) {
        let formats: Vec<Format> = readable().collect();
        let _ = read(*which.get(&formats), &[magic.as_bytes(), &rest].concat());
    }
}
