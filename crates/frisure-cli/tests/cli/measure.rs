//! `frisure measure`.

use std::f64::consts::TAU;

use frisure::formats::picture::png::encode;

use crate::room::Room;

const WIDTH: usize = 240;
const HEIGHT: usize = 700;

/// A dark line on light paper, as PNG: a wave of an amplitude and a length in pixels.
fn photo(amplitude: f64, wavelength: f64) -> Vec<u8> {
    let mut rgba = vec![210_u8; 4 * WIDTH * HEIGHT];
    for i in 0..12_000 {
        let y = 50.0 + 0.05 * f64::from(i);
        let x = 0.5 * WIDTH as f64 + amplitude * (TAU * y / wavelength).cos();
        for v in (y as usize - 2)..(y as usize + 4) {
            for u in (x as usize - 2)..(x as usize + 4) {
                let square = (u as f64 - x).powi(2) + (v as f64 - y).powi(2);
                let value = 210.0 - 160.0 * (-0.5 * square).exp();
                let at = 4 * (v * WIDTH + u);
                for byte in &mut rgba[at..at + 3] {
                    *byte = (*byte).min(value as u8);
                }
            }
        }
    }
    rgba.iter_mut().skip(3).step_by(4).for_each(|alpha| *alpha = 255);
    encode(WIDTH as u32, HEIGHT as u32, &rgba).unwrap()
}

#[test]
fn a_wave_is_measured_into_a_scene_that_is_read() {
    let room = Room::new().with("lock.png", photo(30.0, 110.0));
    let ran = room.run(&[
        "measure",
        "lock.png",
        "--scale",
        "10 px/mm",
        "--type",
        "coily",
        "--diameter",
        "80 um",
        "-o",
        "out/mine.toml",
        "--overlay",
        "out/seen.png",
    ]);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{}", ran.out);
    assert!(ran.out.starts_with("radius             3.0"), "{}", ran.out);
    assert!(
        ran.out.contains("pitch              11.0") || ran.out.contains("pitch              10.9"),
        "{}",
        ran.out
    );
    let scene = std::fs::read_to_string(room.path("out/mine.toml")).unwrap();
    assert!(scene.contains("type = \"coily\"") && scene.contains("[hair.curl]"), "{scene}");
    assert_eq!(room.run(&["hair", "out/mine.toml"]).code, Some(0));
    let seen = std::fs::read(room.path("out/seen.png")).unwrap();
    assert!(seen.starts_with(b"\x89PNG"));

    // The same photo and the same arguments give the same bytes on any number of threads.
    let json = |threads: &str| {
        let arguments =
            ["measure", "lock.png", "--scale", "1000 px/cm", "--json", "--threads", threads];
        room.run(&arguments).out
    };
    let one = json("1");
    assert!(one.contains("\"status\": \"measured\"") && one.contains("\"natural\": ["), "{one}");
    assert_eq!(one, json("2"));
    let flat =
        room.run(&["measure", "lock.png", "--scale", "100 um/px", "--hang", "none", "--quiet"]);
    assert_eq!((flat.code, flat.out.as_str()), (Some(0), ""));
}

#[test]
fn what_the_photo_does_not_tell_has_an_exit_status_and_a_reason() {
    let room =
        Room::new().with("straight.png", photo(0.0, 100.0)).with("arc.png", photo(80.0, 900.0));
    for (name, said) in [("straight.png", "straight within"), ("arc.png", "waves are seen")] {
        let ran = room.run(&["measure", name, "--scale", "10 px/mm", "-o", "mine.toml"]);
        assert_eq!((ran.code, ran.out.as_str()), (Some(5), ""), "{}", ran.err);
        assert!(ran.err.contains(said) && ran.err.contains("help:"), "{}", ran.err);
        let json = room.run(&["measure", name, "--scale", "10 px/mm", "--json"]);
        assert_eq!(json.code, Some(5));
        assert!(json.out.contains("\"status\": \"abstained\""), "{}", json.out);
    }
    assert!(!room.names().contains(&"mine.toml".to_owned()));
}

/// The beginning of a PNG of 20000 by 20000 pixels.
const HUGE: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x4e\x20\0\0\x4e\x20\x08\x02\0\0\0\x6c\x12\xd1\x6e\0\0\0\0IDAT\x35\xaf\x06\x1e";

#[test]
fn wrong_input_is_told_with_file_range_and_hint() {
    let room = Room::new()
        .with("lock.png", photo(30.0, 110.0))
        .with("text.png", "no picture")
        .with("cut.png", &photo(30.0, 110.0)[..200])
        .with("huge.png", HUGE)
        .with("cut.jpg", [0xff, 0xd8, 0xff, 0xe0, 0, 16])
        .with("dot.png", encode(1, 1, &[0; 4]).unwrap());
    let scale = ["--scale", "10 px/mm"];
    let cases: [(&str, &[&str], &[&str]); 15] = [
        ("none.png", &scale, &["none.png", "there is no file"]),
        ("text.png", &scale, &["text.png: it is neither PNG nor JPEG", ".jpg"]),
        ("cut.png", &scale, &["cut.png: "]),
        (
            "huge.png",
            &scale,
            &["20000 x 20000 pixels are too many", "160000000", "save it smaller"],
        ),
        ("cut.jpg", &scale, &["cut.jpg: "]),
        ("dot.png", &scale, &["dot.png: 1 x 1 pixels are too few", "32 x 32"]),
        ("lock.png", &["--scale", "10"], &["no unit", "52 px/mm"]),
        ("lock.png", &["--scale", "NaN px/mm"], &["start with a number"]),
        ("lock.png", &["--scale", "0 px/mm"], &["from 10 px/m to 1e7 px/m"]),
        ("lock.png", &["--scale", "-5 px/mm"], &["from 10 px/m"]),
        ("lock.png", &["--scale", "5 furlongs"], &["`furlongs` is no unit of a scale", "dpi"]),
        (
            "lock.png",
            &["--scale", "10 px/mm", "--crop", "200,0,100,100"],
            &["200,0,100,100", "240 x 700", "--crop"],
        ),
        ("lock.png", &["--scale", "10 px/mm", "--crop", "1,2,3"], &["four whole numbers"]),
        ("lock.png", &["--scale", "10 px/mm", "-o", "a.txt"], &["`a.txt` does not end in .toml"]),
        (
            "lock.png",
            &["--scale", "10 px/mm", "--overlay", "lock.png"],
            &["is read and would be overwritten"],
        ),
    ];
    for (name, arguments, parts) in cases {
        let ran = room.run(&[&["measure", name], arguments].concat());
        assert_eq!(ran.code, Some(2), "{name} {arguments:?}: {}", ran.err);
        for part in parts {
            assert!(ran.err.contains(part), "{name} {arguments:?}: {part}: {}", ran.err);
        }
    }
}
