//! The calls into the library, with a stand-in for it that the C compiler makes.

use std::path::PathBuf;
use std::process::Command;

use frisure_denoise::{DenoiseError, Denoiser, Noisy, VARIABLE};

/// Builds the stand-in, with the name that a version of the library has for one function.
fn stand_in(set_bool: &str) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let library = folder.path().join("libstandin.so");
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/stand_in.c");
    let name = format!("-DSET_BOOL={set_bool}");
    let made = Command::new("cc")
        .args(["-shared", "-fPIC", &name, "-o"])
        .arg(&library)
        .arg(source)
        .status()
        .expect("a C compiler, `cc`");
    assert!(made.success());
    (folder, library)
}

/// One test, since it sets a variable of the process.
#[test]
fn layers_go_in_and_a_picture_comes_out() {
    // SAFETY: no other thread of this program reads or sets variables.
    let name = |path: &str| unsafe { std::env::set_var(VARIABLE, path) };
    name("/nowhere/libOpenImageDenoise.so");
    let missing = Denoiser::find().unwrap_err();
    assert!(
        matches!(&missing, DenoiseError::Library(what) if what.contains("nowhere")),
        "{missing}"
    );

    for version in ["oidnSetFilterBool", "oidnSetFilter1b"] {
        let (_folder, library) = stand_in(version);
        name(library.to_str().unwrap());
        let denoiser = Denoiser::find().unwrap();
        let layer = |x: f32| (0..6).map(|i| [x + i as f32, x, 2.0 * x]).collect::<Vec<_>>();
        let (light, albedo, direction) = (layer(1.0), layer(2.0), layer(3.0));
        let noisy =
            Noisy { width: 3, height: 2, light: &light, albedo: &albedo, direction: &direction };
        for _ in 0..2 {
            let clean = denoiser.denoise(&noisy).unwrap();
            assert_eq!(clean[0], [321.0, 321.0, 642.0]);
            assert_eq!(clean[5], [321.0 + 555.0, 321.0, 642.0]);
        }
        let narrow = denoiser.denoise(&Noisy { width: 1, height: 6, ..noisy });
        assert_eq!(narrow, Err(DenoiseError::Refused("too narrow".into())));
        let wrong = denoiser.denoise(&Noisy { albedo: &albedo[1..], ..noisy });
        assert!(matches!(wrong, Err(DenoiseError::Size { layer: "albedo", found: 5, .. })));
        let empty = Noisy { width: 0, light: &[], albedo: &[], direction: &[], ..noisy };
        assert!(denoiser.denoise(&empty).is_err());
    }

    let (_folder, library) = stand_in("oidnSetFilterNothing");
    name(library.to_str().unwrap());
    assert!(Denoiser::find().unwrap_err().to_string().contains("oidnSetFilter1b"));
}
