//! Outputs are whole or untouched, whatever happens while they are written.

use std::fs;
use std::io;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Duration;

use frisure_files::frame::FrameChoice;
use frisure_files::{WriteError, check_destination, write_atomically};
use frisure_formats::groom::{self, Groom, GroomError, read_groom, write_groom};
use frisure_formats::picture::exr::{self, Channel, Values};
use frisure_formats::picture::{self, Format, PictureError};
use frisure_formats::report;
use frisure_strands::Strands;
use glam::Vec3;

fn text(path: &Path, text: &str) -> Result<(), WriteError> {
    write_atomically(path, |out| out.write_all(text.as_bytes()))
}

fn names(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name());
    names.map(|n| n.into_string().unwrap()).collect()
}

fn groom() -> Groom {
    let mut strands = Strands::new();
    strands.push(&[Vec3::ZERO, Vec3::X, Vec3::ONE], &[1e-5; 3]);
    strands.push(&[Vec3::ZERO, Vec3::Y], &[1e-5; 2]);
    Groom::of(strands)
}

#[test]
fn a_write_that_fails_leaves_the_old_file_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    text(&path, "old").unwrap();
    let failing = write_atomically(&path, |out| {
        out.write_all(&vec![b'x'; 1 << 20])?;
        Err(io::Error::other("the disk is full"))
    });
    assert!(matches!(failing, Err(WriteError::Io { .. })));
    let panicking = std::panic::catch_unwind(|| {
        let _ = write_atomically(&path, |_| panic!("half-way"));
    });
    assert!(panicking.is_err());
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(names(folder.path()), ["a.txt"]);
    text(&path, "new").unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "new");
}

#[test]
fn destinations_that_cannot_be() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no/such/a.txt");
    let protected = folder.path().join("protected.txt");
    fs::write(&protected, "old").unwrap();
    let mut permissions = fs::metadata(&protected).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(&protected, permissions).unwrap();
    for check in [check_destination, |p: &Path| text(p, "new")] {
        assert!(matches!(check(&missing), Err(WriteError::NoFolder { .. })));
        assert!(matches!(check(folder.path()), Err(WriteError::Directory { .. })));
        assert!(matches!(check(&protected), Err(WriteError::ReadOnly { .. })));
    }
    assert_eq!(fs::read_to_string(&protected).unwrap(), "old");
    // A file where a folder should be.
    assert!(check_destination(&protected.join("a.txt")).is_err());
}

#[cfg(unix)]
#[test]
fn links_permissions_and_devices_are_respected() {
    use std::os::unix::fs::{PermissionsExt, symlink};

    let folder = tempfile::tempdir().unwrap();
    let (target, link) = (folder.path().join("target"), folder.path().join("link"));
    fs::write(&target, "old").unwrap();
    fs::set_permissions(&target, fs::Permissions::from_mode(0o640)).unwrap();
    symlink(&target, &link).unwrap();
    text(&link, "new").unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read_to_string(&target).unwrap(), "new");
    assert_eq!(fs::metadata(&target).unwrap().permissions().mode() & 0o777, 0o640);
    // A new file is as open as any other that this process makes.
    let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
    text(&ours, "").unwrap();
    fs::write(&plain, "").unwrap();
    let mode = |p: &Path| fs::metadata(p).unwrap().permissions().mode();
    assert_eq!(mode(&ours), mode(&plain));

    text(Path::new("/dev/null"), "gone").unwrap();
    assert!(!fs::metadata("/dev/null").unwrap().is_file());
    if Path::new("/dev/full").exists() {
        assert!(matches!(text(Path::new("/dev/full"), "x"), Err(WriteError::Io { .. })));
    }
}

const LINE: &[u8] = b"all of it, or nothing of it\n";
const LINES: usize = 20_000;

/// Not a test of its own: the victim of the next one, run in a process of its own.
#[test]
#[ignore = "runs until it is killed"]
fn write_until_killed() {
    let Ok(path) = std::env::var("FRISURE_TEST_VICTIM") else { return };
    loop {
        write_atomically(path.as_ref(), |out| (0..LINES).try_for_each(|_| out.write_all(LINE)))
            .unwrap();
    }
}

#[test]
fn a_killed_process_leaves_a_whole_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    let whole = LINE.repeat(LINES);
    fs::write(&path, &whole).unwrap();
    for round in 0..10 {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args(["--exact", "write_until_killed", "--ignored"])
            .env("FRISURE_TEST_VICTIM", &path)
            .stdout(Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(Duration::from_millis(40 + 7 * round));
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(fs::read(&path).unwrap() == whole, "half a file");
    }
}

#[test]
fn grooms_by_extension() {
    let folder = tempfile::tempdir().unwrap();
    let formats = groom::Format::ALL;
    for extension in formats.iter().flat_map(|f| f.extensions()) {
        for name in [format!("a.{extension}"), format!("b.{}", extension.to_uppercase())] {
            let path = folder.path().join(name);
            write_groom(&path, &groom(), FrameChoice::default()).unwrap();
            let first = fs::read(&path).unwrap();
            write_groom(&path, &groom(), FrameChoice::default()).unwrap();
            assert!(!first.is_empty() && fs::read(&path).unwrap() == first);
        }
    }
    for name in ["a.xyz", "a", "hair"] {
        let error = write_groom(&folder.path().join(name), &groom(), FrameChoice::default());
        let error = error.unwrap_err();
        assert!(matches!(error, GroomError::Extension { .. }));
        assert!(error.to_string().contains("known are .hair, "), "{error}");
    }
    // Nothing but what was asked for.
    let all: usize = formats.iter().map(|f| f.extensions().len()).sum();
    assert_eq!(names(folder.path()).len(), 2 * all);
}

#[test]
fn a_groom_comes_back_from_its_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.hair");
    write_groom(&path, &groom(), FrameChoice::default()).unwrap();
    let read = read_groom(&path, FrameChoice::default()).unwrap();
    assert_eq!(read.hairs.offsets(), groom().hairs.offsets());
    assert_eq!(read.hairs.points(), groom().hairs.points());
    fs::write(&path, "HAIR").unwrap();
    let error = read_groom(&path, FrameChoice::default()).unwrap_err().to_string();
    assert!(
        error.ends_with("is not a usable .hair file: it has 4 bytes, and the header alone has 128")
    );
    assert!(read_groom(folder.path(), FrameChoice::default()).is_err());
}

#[test]
fn pictures_come_back_as_they_were() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.png");
    let pixels: Vec<u8> = (0..2 * 3 * 4).collect();
    picture::png::write(&path, 2, 3, &pixels).unwrap();
    let decoder = png::Decoder::new(io::BufReader::new(fs::File::open(&path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    assert_eq!((reader.info().width, reader.info().height), (2, 3));
    let mut read = vec![0; reader.output_buffer_size().unwrap()];
    reader.next_frame(&mut read).unwrap();
    assert_eq!(read, pixels);

    for (width, height) in [(0, 0), (2, 2), (u32::MAX, u32::MAX)] {
        let bad = picture::png::write(&path, width, height, &pixels);
        assert!(matches!(bad, Err(PictureError::Size { .. })));
    }
    assert_eq!(Format::of(Path::new("a.EXR")).unwrap(), Format::Exr);
    assert!(matches!(Format::of(Path::new("a.jpg")), Err(PictureError::Extension { .. })));
}

#[test]
fn layers_come_back_as_they_were() {
    use ::exr::prelude::{ReadChannels, ReadLayers};
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.exr");
    let channel = |name: &str, values| Channel { name: name.into(), values };
    let depths = vec![0.1, 1.5, 2.25, 1e10, 0.3, 7.0];
    let channels = vec![
        channel("R", Values::Half(vec![0.0, 0.5, 1.0, 2.0, -1.0, 1e9])),
        channel("wisp.id", Values::Whole(vec![0, 1, 2, 3, 4, 5_000_000])),
        channel("Z", Values::Single(depths.clone())),
    ];
    exr::write(&path, 3, 2, channels.clone(), "a test").unwrap();
    let again = fs::read(&path).unwrap();
    exr::write(&path, 3, 2, channels.clone(), "a test").unwrap();
    assert_eq!(fs::read(&path).unwrap(), again, "the same bytes each time");

    let image = ::exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(&path)
        .unwrap();
    let layer = &image.layer_data;
    assert_eq!((layer.size.0, layer.size.1), (3, 2));
    assert_eq!(layer.attributes.comments.as_ref().unwrap().to_string(), "a test");
    assert!((image.attributes.chromaticities.unwrap().red.0 - 0.64).abs() < 1e-6);
    let names: Vec<String> = layer.channel_data.list.iter().map(|c| c.name.to_string()).collect();
    assert_eq!(names, ["R", "Z", "wisp.id"]);
    let of = |i: usize| layer.channel_data.list[i].sample_data.values_as_f32().collect::<Vec<_>>();
    assert_eq!(of(0), [0.0, 0.5, 1.0, 2.0, -1.0, 65_504.0]);
    assert_eq!(of(1), depths);
    assert_eq!(of(2)[5], 5e6);

    let short = vec![channel("R", Values::Half(vec![0.0; 5]))];
    assert!(matches!(exr::write(&path, 3, 2, short, ""), Err(PictureError::Size { .. })));
}

#[test]
fn reports_keep_every_digit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.json");
    let numbers = [0.1 + 0.2, 1.0 / 3.0, 5e-324, 1.7976931348623157e308];
    report::write(&path, &numbers).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    let back: Vec<f64> = serde_json::from_str(&text).unwrap();
    assert_eq!(back, numbers);
}
