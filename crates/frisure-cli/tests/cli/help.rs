//! What the program says about itself, as snapshots.

use crate::room::Room;

fn help(arguments: &[&str]) -> String {
    let ran = Room::new().run(arguments);
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""));
    ran.out
}

#[test]
fn help_of_everything() {
    insta::assert_snapshot!("frisure", help(&["--help"]));
    insta::assert_snapshot!("predict", help(&["predict", "--help"]));
    insta::assert_snapshot!("batch", help(&["batch", "--help"]));
    insta::assert_snapshot!("render", help(&["render", "--help"]));
    insta::assert_snapshot!("view", help(&["view", "--help"]));
    insta::assert_snapshot!("convert", help(&["convert", "--help"]));
    insta::assert_snapshot!("cards", help(&["cards", "--help"]));
    insta::assert_snapshot!("transfer", help(&["transfer", "--help"]));
    insta::assert_snapshot!("style", help(&["style", "--help"]));
    insta::assert_snapshot!("hair", help(&["hair", "--help"]));
    insta::assert_snapshot!("presets-help", help(&["presets", "--help"]));
    insta::assert_snapshot!("new", help(&["new", "--help"]));
    insta::assert_snapshot!("measured", help(&["measured", "--help"]));
    insta::assert_snapshot!("measure", help(&["measure", "--help"]));
    insta::assert_snapshot!("fit", help(&["fit", "--help"]));
    insta::assert_snapshot!("validate", help(&["validate", "--help"]));
    insta::assert_snapshot!("schema", help(&["schema", "--help"]));
}

#[test]
fn version_is_that_of_the_package() {
    assert_eq!(help(&["--version"]), concat!("frisure ", env!("CARGO_PKG_VERSION"), "\n"));
}

#[test]
fn no_command_and_unknown_ones_are_usage_errors() {
    for arguments in [
        &[][..],
        &["predikt"],
        &["predict"],
        &["hair", "a.toml", "--points", "1"],
        &["hair", "a.toml", "--points", "many"],
        &["presets", "--threads", "0"],
        &["new", "curlyish"],
        &["presets", "curlyish"],
    ] {
        let ran = Room::new().run(arguments);
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{arguments:?}: {}", ran.err);
    }
}
