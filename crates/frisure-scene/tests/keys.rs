//! Keys of a scene set and taken out as text: what comes out says what was meant, and else every byte is
//! as it was.

use std::path::Path;

use frisure_hairstyle::PRESETS;
use frisure_scene::edit::{EditError, set_key, set_keys, unset_key};
use frisure_scene::{Scene, template};
use proptest::prelude::*;

fn set(text: &str, key: &str, value: &str) -> String {
    set_key(text, key, value).unwrap_or_else(|e| panic!("{key} = {value}: {e}\n{text}"))
}

fn unset(text: &str, key: &str) -> String {
    unset_key(text, key).unwrap_or_else(|e| panic!("{key}: {e}\n{text}"))
}

fn scene(text: &str) -> Scene {
    Scene::parse("scene", text, Path::new("")).unwrap()
}

const SCENE: &str = "# My head.\n\nname = 'Anna' # and so on\n\n[hair]  # all of it\ntype = \"caucasian-curly\"\n\n\
# The curl.\n[hair.curl]\nradius   = '9 mm'   # wide\n# long\npitch = '20 mm'\n\n[look]\ncolour = 'brown'\n";

#[test]
fn a_value_is_replaced_where_it_stands() {
    let out = set(SCENE, "hair.curl.radius", "\"11 mm\"");
    assert_eq!(out, SCENE.replace("'9 mm'", "\"11 mm\""));
    assert_eq!(set(SCENE, "name", "\"B\""), SCENE.replace("'Anna'", "\"B\""));
}

#[test]
fn a_key_joins_those_of_its_table() {
    let out = set(SCENE, "hair.length", "\"20 cm\"");
    assert_eq!(out, SCENE.replace("curly\"\n", "curly\"\nlength = \"20 cm\"\n"));
    let out = set(SCENE, "seed", "7");
    assert_eq!(out, SCENE.replace("and so on\n", "and so on\nseed = 7\n"));
}

#[test]
fn a_table_that_is_missing_is_made() {
    let out = set(SCENE, "wisps.count", "50");
    assert_eq!(out, format!("{SCENE}\n[wisps]\ncount = 50\n"));
    let out = set(SCENE, "hair.fibre.diameter", "\"60 um\"");
    assert!(out.contains("\n\n[hair.fibre]\ndiameter = \"60 um\"\n"), "{out}");
    assert_eq!(out.replace("\n[hair.fibre]\ndiameter = \"60 um\"\n", ""), SCENE);
    assert_eq!(set("", "look.dye.colour", "\"#ff0000\""), "\n[look.dye]\ncolour = \"#ff0000\"\n");
    assert_eq!(set("", "seed", "3"), "seed = 3\n");
}

#[test]
fn tables_in_one_line_and_dotted_keys_stay_so() {
    let inline = "hair = { length = '9 cm', curl = { radius = '8 mm' } } # x\n";
    let out = set(inline, "hair.curl.pitch", "\"2 cm\"");
    assert_eq!(out, inline.replace("'8 mm' }", "'8 mm', pitch = \"2 cm\" }"));
    assert_eq!(unset(&out, "hair.curl.pitch"), inline);
    let dotted = "hair.length = '9 cm'\nhair.curl.radius = '8 mm'\n\n[look]\ncolour = 'red'\n";
    let out = set(dotted, "hair.curl.pitch", "\"2 cm\"");
    let line = "hair.curl.radius = '8 mm'\n";
    assert_eq!(out, dotted.replace(line, &format!("{line}hair.curl.pitch = \"2 cm\"\n")));
    assert_eq!(unset(&out, "hair.curl.pitch"), dotted);
    let out = set(dotted, "hair.fibre.diameter", "\"60 um\"");
    assert!(out.contains("hair.fibre.diameter = \"60 um\"\n"), "{out}");
}

#[test]
fn line_ends_and_a_missing_last_one_stay() {
    let windows = SCENE.replace('\n', "\r\n");
    let out = set(&windows, "hair.length", "\"20 cm\"");
    assert_eq!(out, set(SCENE, "hair.length", "\"20 cm\"").replace('\n', "\r\n"));
    assert_eq!(unset(&out, "hair.length"), windows);
    assert_eq!(set("seed = 1", "seed", "2"), "seed = 2");
    assert_eq!(set("seed = 1", "name", "'x'"), "seed = 1\nname = 'x'");
    let marked = format!("\u{feff}{SCENE}");
    assert_eq!(set(&marked, "seed", "7"), format!("\u{feff}{}", set(SCENE, "seed", "7")));
}

#[test]
fn a_key_goes_with_its_line_and_no_comment_else() {
    let out = unset(SCENE, "hair.curl.pitch");
    assert_eq!(out, SCENE.replace("pitch = '20 mm'\n", ""));
    assert_eq!(unset(SCENE, "look.dye"), SCENE);
    let dyed = format!("{SCENE}\n[look.dye]\n# as last week\ncolour = 'red'\nstrength = 0.5\n");
    let out = unset(&dyed, "look.dye");
    assert!(out.ends_with("# as last week\n") && !out.contains("dye"), "{out}");
    assert!(!unset(&dyed, "look.dye.colour").contains("strength"));
}

#[test]
fn items_of_lists_are_made_set_and_taken_out() {
    let (place, length) =
        (("region[0].where", Some("\"fringe\"")), ("region[0].length", Some("\"9 cm\"")));
    let one = set_keys(SCENE, &[place, length]).unwrap();
    assert_eq!(one, format!("{SCENE}\n[[region]]\nwhere = \"fringe\"\nlength = \"9 cm\"\n"));
    let (place, length) = (("region[1].where", Some("\"nape\"")), ("region[1].lift", Some("0.5")));
    let two = set_keys(&one, &[place, length]).unwrap();
    assert_eq!(scene(&two).hairstyle_spec().unwrap().regions.len(), 2);
    let out = set(&two, "region[0].down_to", "\"brows\"");
    assert!(!out.contains("length = \"9 cm\"") && out.contains("down_to"), "{out}");
    let out = unset(&two, "region[0]");
    assert_eq!(scene(&out).hairstyle_spec().unwrap().regions.len(), 1);
    assert!(out.contains("nape") && !out.contains("fringe"));
    let inline = "light = { lamp = [{ azimuth = 0.1 }, { azimuth = 0.2 }] }\n";
    assert_eq!(scene(&unset(inline, "light.lamp[0]")).light.lamps.len(), 1);
    assert!(
        set(inline, "light.lamp[1].temperature", "3000").contains("azimuth = 0.2, temperature")
    );
    assert!(set_key(SCENE, "region[4].length", "0.1").is_err());
}

#[test]
fn whoever_says_it_in_one_way_does_not_say_it_in_another() {
    let ways = [
        ("hair.fibre", "mean_radius = 4e-5\n", "diameter", "'70 um'"),
        ("hair.fibre", "eccentricity = 0.3\n", "axis_ratio", "1.4"),
        ("hair.fibre", "poisson_ratio = 0.4\n", "shear_modulus", "'1 GPa'"),
        ("hair.curl", "kappa1 = 100\ntau = 20\n", "radius", "'6 mm'"),
        ("wisps", "hairs = 100\n", "density", "'150 1/cm^2'"),
        ("wisps", "density = '150 1/cm^2'\n", "hairs_per_wisp", "10"),
        ("implantation", "lift_scale = 2\n", "lift", "'30 deg'"),
        ("implantation", "flow = 'whorl'\n", "parting", "'middle'"),
        ("implantation", "parting = 'middle'\n", "flow", "'swept-back'"),
        ("implantation", "partings = [{ at = 'middle' }]\n", "parting", "'left'"),
        ("equilibrium", "elements = 10\n", "accuracy", "'1 mm'"),
        ("look", "eumelanin = 1\npheomelanin = 2\nwhite_share = 0.5\n", "colour", "'red'"),
        ("look", "reflectance = '#ff8800'\n", "eumelanin", "0.4"),
        ("look", "colour = 'red'\n", "absorption", "[1, 2, 3]"),
        ("light", "azimuth = 0.2\nsize = 0.2\n", "setup", "'dark'"),
        ("light", "setup = 'daylight'\nturbidity = 4\n", "setup", "'studio'"),
        ("light", "setup = 'rim'\nazimuth = 0.1\n", "sun_azimuth", "0.3"),
        ("light", "setup = 'daylight'\nturbidity = 4\n", "environment", "'a.hdr'"),
    ];
    for (table, other, key, value) in ways {
        let before = format!("# above\n[{table}]\n# of it\n{other}# below\n");
        scene(&before);
        let after = set(&before, &format!("{table}.{key}"), value);
        scene(&after).hairstyle_spec().unwrap();
        for comment in ["# above\n", "# of it\n", "# below\n"] {
            assert!(after.contains(comment), "{after}");
        }
    }
}

#[test]
fn only_what_was_set_changes_where_strains_give_way_to_a_helix() {
    let text = "[hair.curl]\nkappa1 = 60\nkappa2 = 0\ntau = 40\n";
    let before = scene(text).hairstyle_spec().unwrap().curl.radius_pitch().unwrap();
    let after = scene(&set(text, "hair.curl.radius", "'20 mm'")).hairstyle_spec().unwrap();
    let (radius, pitch) = after.curl.radius_pitch().unwrap();
    assert!((radius - 0.02).abs() < 1e-9 && (pitch / before.1 - 1.0).abs() < 1e-3);
    let axes = "[hair.fibre]\nsemi_axis_a = '45 um'\nsemi_axis_b = '30 um'\n";
    let after = scene(&set(axes, "hair.fibre.diameter", "'60 um'")).hairstyle_spec().unwrap();
    assert!((after.fibre.section.axis_ratio() - 1.5).abs() < 1e-3);
}

#[test]
fn only_what_was_set_changes_where_gravity_is_a_vector() {
    let text = "gravity = [0, 5, -5]\n";
    let weaker = scene(&set(text, "gravity", "\"1.62 m/s^2\"")).hairstyle_spec().unwrap();
    assert_eq!(weaker.gravity, 1.62);
    assert!((weaker.pose.pitch + 45_f64.to_radians()).abs() < 1e-15);
    let nods = scene(&set(text, "pose.pitch", "\"10 deg\"")).hairstyle_spec().unwrap();
    assert_eq!(nods.gravity, 5.0 * 2.0_f64.sqrt());
    assert!((nods.pose.pitch - 10_f64.to_radians()).abs() < 1e-15);
    let held = "[pose]\npitch = 0.1\nroll = 0.2\n";
    let upright = scene(&set(held, "gravity", "[0, 0, -1]")).hairstyle_spec().unwrap();
    assert_eq!((upright.gravity, upright.pose.pitch, upright.pose.roll), (1.0, 0.0, 0.0));
}

#[test]
fn what_cannot_be_said_is_refused_with_its_place() {
    let diagnostic = |text: &str, key: &str, value: &str| match set_key(text, key, value) {
        Err(EditError::Scene(error)) => error.diagnostic().unwrap().clone(),
        other => panic!("{other:?}"),
    };
    let unit = diagnostic(SCENE, "hair.length", "\"20 kg\"");
    assert!(unit.key == "hair.length" && unit.line > 0);
    let range = diagnostic(SCENE, "hair.length", "\"90 m\"");
    assert!(range.key == "hair.length" && range.allowed.contains("3 m"), "{range:?}");
    assert!(diagnostic(SCENE, "hair.lenght", "1").hint.contains("length"));
    assert!(diagnostic(SCENE, "wisps.hairs", "0").line > 0);
    assert!(diagnostic("[hair\n", "seed", "1").line == 1);
    assert!(matches!(set_key(SCENE, "hair.length", "20 cm"), Err(EditError::Value { .. })));
    assert!(matches!(set_key(SCENE, "hair", "1"), Err(EditError::NoPlace { .. })));
    assert!(matches!(set_key(SCENE, "", "1"), Err(EditError::NoPlace { .. })));
    let deep = set_key(SCENE, &["a"; 30_000].join("."), "1");
    assert!(matches!(deep, Err(EditError::Deep { .. })));
    assert!(set_key(SCENE, "name.x", "1").is_err());
    // A scene that is wrong can be mended.
    assert!(set_key("[hair]\nlength = 90\n", "hair.length", "0.2").is_ok());
}

/// Keys that sliders and lists set, with values.
fn change() -> impl Strategy<Value = (&'static str, String)> {
    let number = |range: std::ops::Range<f64>| range.prop_map(|x| format!("{x:.3}"));
    prop_oneof![
        number(0.02..0.5).prop_map(|x| ("hair.length", x)),
        number(0.003..0.05).prop_map(|x| ("hair.curl.radius", x)),
        number(0.003..0.05).prop_map(|x| ("hair.curl.pitch", x)),
        (40..120_u32).prop_map(|d| ("hair.fibre.diameter", format!("\"{d} um\""))),
        number(1.0..1.8).prop_map(|x| ("hair.fibre.axis_ratio", x)),
        (1..500_u32).prop_map(|n| ("wisps.count", n.to_string())),
        (1..500_u32).prop_map(|n| ("wisps.hairs", n.to_string())),
        number(0.0..1.0).prop_map(|x| ("wisps.clumping", x)),
        Just(("implantation.parting", "'middle'".to_owned())),
        Just(("implantation.flow", "'whorl'".to_owned())),
        number(0.0..3.0).prop_map(|x| ("look.eumelanin", x)),
        Just(("look.colour", "'auburn'".to_owned())),
        Just(("light.setup", "'daylight'".to_owned())),
        number(0.0..1.0).prop_map(|x| ("light.azimuth", x)),
        Just(("camera.azimuth", "'90 deg'".to_owned())),
        number(0.0..2.0).prop_map(|x| ("output.exposure", x)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn edits_of_any_template_keep_comments_and_can_be_undone(
        preset in 0..PRESETS.len(),
        changes in prop::collection::vec(change(), 1..8),
        windows: bool,
    ) {
        let start = template(&PRESETS[preset]);
        let start = if windows { start.replace('\n', "\r\n") } else { start };
        let comments = |text: &str| {
            text.lines().filter(|l| l.starts_with('#')).map(str::to_owned).collect::<Vec<_>>()
        };
        let mut text = start.clone();
        for (key, value) in &changes {
            match set_key(&text, key, value) {
                Ok(edited) => {
                    scene(&edited).hairstyle_spec().unwrap();
                    prop_assert_eq!(&set(&edited, key, value), &edited);
                    text = edited;
                }
                // The sun has no studio lamp.
                Err(EditError::Scene(e)) => prop_assert!(e.to_string().contains("light"), "{}", e),
                Err(e) => return Err(TestCaseError::fail(format!("{key} = {value}: {e}\n{text}"))),
            }
            prop_assert_eq!(comments(&text), comments(&start));
        }
        for (key, _) in &changes {
            text = unset(&text, key);
        }
        prop_assert_eq!(text.matches('\n').count(), text.matches("\r\n").count().max(text.matches('\n').count() * usize::from(!windows)));
        prop_assert_eq!(scene(&text).look, scene(&start).look);
    }
}
