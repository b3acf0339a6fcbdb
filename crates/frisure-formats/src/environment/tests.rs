use std::path::Path;

use super::*;

/// A gradient with a lamp in it.
fn pixel(x: usize, y: usize) -> [f32; 3] {
    if (x, y) == (5, 2) { [4096.0, 2048.0, 32.0] } else { [x as f32, y as f32, 8.0] }
}

const WIDTH: usize = 16;
const HEIGHT: usize = 8;

fn radiance_bytes(rows: impl FnOnce(&mut Vec<u8>)) -> Vec<u8> {
    let mut out = b"#?RADIANCE\n# a comment\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    rows(&mut out);
    out
}

/// Mantissas and an exponent, exact for small whole numbers.
fn rgbe(x: usize, y: usize) -> [u8; 4] {
    let rgb = pixel(x, y);
    let most = rgb.iter().copied().fold(0.0, f32::max);
    let exponent = most.log2().floor() + 1.0;
    let [r, g, b] = rgb.map(|x| (x * (8.0 - exponent).exp2()) as u8);
    [r, g, b, (exponent + 128.0) as u8]
}

fn plain(out: &mut Vec<u8>) {
    for i in 0..WIDTH * HEIGHT {
        out.extend(rgbe(i % WIDTH, i / WIDTH));
    }
}

fn runs(out: &mut Vec<u8>) {
    for y in 0..HEIGHT {
        out.extend([2, 2, 0, WIDTH as u8]);
        for channel in 0..4 {
            let row: Vec<u8> = (0..WIDTH).map(|x| rgbe(x, y)[channel]).collect();
            for same in row.chunk_by(|a, b| a == b) {
                match same {
                    [one] => out.extend([1, *one]),
                    same => out.extend([128 + same.len() as u8, same[0]]),
                }
            }
        }
    }
}

fn exr_bytes(width: usize, height: usize, of: impl Fn(usize, usize) -> [f32; 3] + Sync) -> Vec<u8> {
    use exr::prelude::*;
    let mut out = std::io::Cursor::new(Vec::new());
    let pixels = |Vec2(x, y): Vec2<usize>| {
        let [r, g, b] = of(x, y);
        (r, g, b)
    };
    let channels = SpecificChannels::rgb(pixels);
    Image::from_channels((width, height), channels).write().to_buffered(&mut out).unwrap();
    out.into_inner()
}

fn read_as(name: &str, bytes: &[u8]) -> Result<Environment, EnvironmentError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    read(&path, &Files::default(), usize::MAX)
}

fn says(result: Result<Environment, EnvironmentError>, part: &str) {
    let error = result.unwrap_err().to_string();
    assert!(error.contains(part), "{error}");
}

#[test]
fn both_formats_keep_their_light() {
    let files = [
        ("plain.hdr", radiance_bytes(plain)),
        ("runs.HDR", radiance_bytes(runs)),
        ("a.exr", exr_bytes(WIDTH, HEIGHT, pixel)),
    ];
    for (name, bytes) in files {
        let found = read_as(name, &bytes).unwrap();
        assert_eq!((found.width, found.height), (WIDTH, HEIGHT), "{name}");
        for (i, light) in found.pixels.iter().enumerate() {
            assert_eq!(*light, pixel(i % WIDTH, i / WIDTH), "{name} {i}");
        }
    }
}

#[test]
fn exposure_is_taken_back() {
    let text = b"#?RGBE\nEXPOSURE=2\nEXPOSURE=4\n\n-Y 1 +X 2\n";
    let bytes = [&text[..], &[128, 64, 32, 132, 1, 1, 1, 1]].concat();
    assert_eq!(read_as("a.hdr", &bytes).unwrap().pixels, [[1.0, 0.5, 0.25]; 2]);
}

#[test]
fn cut_files_are_refused_wherever_they_end() {
    let exr = exr_bytes(WIDTH, HEIGHT, pixel);
    for (name, bytes) in
        [("a.hdr", radiance_bytes(runs)), ("b.hdr", radiance_bytes(plain)), ("c.exr", exr)]
    {
        for end in (0..bytes.len()).step_by(7) {
            assert!(read_as(name, &bytes[..end]).is_err(), "{name} {end}");
        }
    }
    let bytes = radiance_bytes(plain);
    says(read_as("a.hdr", &bytes[..bytes.len() - 1]), "breaks in row 7 of 8");
}

#[test]
fn what_is_no_environment_says_why() {
    says(read(Path::new("nowhere.hdr"), &Files::default(), usize::MAX), "there is no file");
    says(read_as("a.png", b"x"), "`.hdr` and `.exr`");
    let error = read_as("a.JPG", b"x").unwrap_err();
    assert!(error.hint().contains("cuts off"));
    says(read_as("a.hdr", b"GIF89a"), "does not begin with `#?`");
    says(read_as("a.exr", b"GIF89a"), "no OpenEXR");
    let sized = |size: &str| format!("#?RADIANCE\n\n{size}\n").into_bytes();
    says(read_as("a.hdr", &sized("-Y 4 +X 4")), "4 x 4 pixels; an environment is twice as wide");
    says(read_as("a.hdr", &sized("-Y 20000 +X 40000")), "at most 16384 x 8192");
    let mut large = Files::default();
    large.provide("a.hdr", sized("-Y 4 +X 8"));
    let error = read(Path::new("a.hdr"), &large, 31).unwrap_err();
    assert!(error.hint().contains("smaller"), "{error}");
    says(Err(error), "8 x 4 pixels; at most 31 have room");
    says(read_as("a.hdr", &sized("+X 8 -Y 4")), "turned");
    says(read_as("a.hdr", &sized("large")), "`large` for a size");
    says(read_as("a.hdr", b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n"), "32-bit_rle_xyze");
    says(read_as("a.exr", &exr_bytes(8, 8, pixel)), "twice as wide");
}

#[test]
fn light_that_is_none_is_named_by_its_place() {
    let with = |bad: f32| {
        let of = move |x, y| if (x, y) == (3, 1) { [0.0, bad, 0.0] } else { [1.0; 3] };
        read_as("a.exr", &exr_bytes(8, 4, of))
    };
    says(with(-1.0), "[0.0, -1.0, 0.0] in column 3 of row 1; light is not negative");
    says(with(f32::NAN), "column 3 of row 1; light is finite");
    says(with(f32::INFINITY), "light is finite");
    assert_eq!(with(-1e-3).unwrap().pixels[11], [0.0; 3]);
}
