//! Whatever a stage holds, reading it panics never and takes no memory that the file does not back up.

use std::path::Path;
use std::sync::LazyLock;

use frisure_files::frame::FrameChoice;
use frisure_formats::groom::{Format, Groom, attributes, decode, encode};
use frisure_strands::{AttributeValues, Strands};
use glam::Vec3;
use proptest::prelude::*;

fn groom(count: u16) -> Groom {
    let mut hairs = Strands::new();
    for i in 0..count {
        let x = f32::from(i) * 1e-3;
        hairs.push(&[Vec3::new(x, 0.0, 0.2), Vec3::new(x, 0.01, 0.1)], &[4e-5, 3e-5]);
    }
    let ids = (0..u32::from(count)).collect();
    let id = attributes::of_strands(attributes::ID, AttributeValues::U32(ids));
    hairs.set_attribute(id).unwrap();
    Groom { guides: hairs.clone(), ..Groom::of(hairs) }
}

/// A groom of 20 hairs, in each format.
static WHOLE: LazyLock<[Vec<u8>; 2]> = LazyLock::new(|| {
    ["usda", "usdc"].map(|name| {
        encode(Format::named(name).unwrap(), &groom(20), FrameChoice::default()).unwrap()
    })
});

fn read(bytes: &[u8]) {
    if let Ok(groom) =
        decode(Format::named("usdc").unwrap(), bytes, Path::new("a"), FrameChoice::default())
    {
        assert!(groom.hairs.points().iter().all(|p| p.is_finite()));
    }
}

fn word() -> impl Strategy<Value = String> {
    let words = [
        "nan",
        "inf",
        "-1",
        "1e39",
        "99999999999",
        "(",
        ")",
        "[",
        "]",
        "{",
        "}",
        "<",
        ">",
        "@",
        "\"",
        "'''",
        "#",
        "=",
        ",",
        "None",
        "def",
        "over",
        "uniform",
        "rel",
        ".timeSamples",
        "point3f[]",
        "token",
        "é",
        "int[] curveVertexCounts = [2147483647]",
        "uniform token basis = \"bezier\"\n",
        "\u{0}",
        "variantSet \"a\" = {",
        "double3 xformOp:translate = (1e300, 0, 0)\n",
        "uniform token[] xformOpOrder = [\"xformOp:translate\"]\n",
        ":indices = [5]",
        "(interpolation = \"vertex\")",
        "elementSize = 3",
        "metersPerUnit = 0",
        "\\",
    ];
    prop_oneof![proptest::sample::select(words.to_vec()).prop_map(str::to_owned), ".{0,8}"]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn any_text(text in "\\PC{0,200}") {
        read(format!("#usda 1.0\n{text}").as_bytes());
    }

    #[test]
    fn text_with_mistakes(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), 0_usize..20, word()), 1..4)
    ) {
        let mut text = String::from_utf8(WHOLE[0].clone()).unwrap();
        for (at, length, word) in edits {
            // The written text is ASCII, edits are not.
            let mut start = at.index(text.len());
            while !text.is_char_boundary(start) {
                start -= 1;
            }
            let mut end = (start + length).min(text.len());
            while !text.is_char_boundary(end) {
                end += 1;
            }
            text.replace_range(start..end, &word);
        }
        read(text.as_bytes());
    }

    #[test]
    fn binary_with_wrong_bytes(
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)
    ) {
        let mut bytes = WHOLE[1].clone();
        for (at, byte) in edits {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        read(&bytes);
    }

    #[test]
    fn binary_with_wrong_numbers(
        edits in proptest::collection::vec(
            (any::<prop::sample::Index>(), prop_oneof![0_u64..64, any::<u64>(), (0_u32..64).prop_map(|n| 1 << n)]),
            1..4,
        )
    ) {
        let mut bytes = WHOLE[1].clone();
        for (at, number) in edits {
            let at = at.index(bytes.len() / 8 - 1) * 8;
            bytes[at..at + 8].copy_from_slice(&number.to_le_bytes());
        }
        read(&bytes);
    }

    #[test]
    fn any_binary(rest in proptest::collection::vec(any::<u8>(), 0..400)) {
        let mut bytes = b"PXR-USDC\x00\x08\x00\x00\x00\x00\x00\x00\x58\x00\x00\x00\x00\x00\x00\x00".to_vec();
        bytes.resize(88, 0);
        bytes.extend(rest);
        read(&bytes);
    }
}
