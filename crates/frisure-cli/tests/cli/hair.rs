//! `frisure hair`, `presets`, `new`, `measured` and `schema`.

use std::process::Stdio;

use crate::room::{Room, scene};
use serde_json::Value;

/// A stiff, light rod that is clamped horizontally, one element of a helix.
const BEAM: &str = "\
[hair]
length = \"10 cm\"
fibre = { diameter = \"1 mm\", axis_ratio = 1, youngs_modulus = \"4 GPa\", density = \"1.3 g/cm^3\" }
curl = { kappa1 = 0, tau = 0 }
";

fn json(text: &str, more: &[&str]) -> Value {
    let arguments = [&["hair", "-", "--json"], more].concat();
    let ran = Room::new().feed(&arguments, text.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (Some(0), ""), "{}", ran.out);
    serde_json::from_str(&ran.out).unwrap()
}

#[test]
fn a_beam_bends_as_beams_do() {
    let report = json(BEAM, &[]);
    let get = |path: &str| report.pointer(path).and_then(Value::as_f64).unwrap();
    // w L⁴ / 8 E I, for a small deflection.
    let (radius, length): (f64, f64) = (0.5e-3, 0.1);
    let area = std::f64::consts::PI * radius * radius;
    let inertia = area * radius * radius / 4.0;
    let weight = 1300.0 * area * 9.81;
    let deflection = weight * length.powi(4) / (8.0 * 4e9 * inertia);
    assert!((get("/tip/2") / -deflection - 1.0).abs() < 1e-3, "{}", get("/tip/2"));
    assert!((get("/tip/0") - 0.1).abs() < 1e-5 && get("/tip/1").abs() < 1e-12);
    // A linear spring: the weight gives twice what elasticity keeps.
    assert!((get("/energy/elastic") / -get("/energy/gravity") - 0.5).abs() < 1e-3);
    let sum = get("/energy/elastic") + get("/energy/gravity") + get("/energy/contact");
    assert!((sum / get("/energy/total") - 1.0).abs() < 1e-12);
    assert_eq!(report["length"], 0.1);
    assert_eq!(report["stable"], true);
    assert!(get("/gradient_norm") < 1e-8 && get("/min_eigenvalue") > 0.9);
    assert!(report["iterations"].is_u64() && report["elements"].is_u64());
    assert!(get("/error_estimate") < 1e-4);
    assert!(report.get("points").is_none());
}

#[test]
fn a_diameter_of_no_hair_is_told() {
    let text = BEAM.replace("1 mm", "70 mm");
    let ran = Room::new().feed(&["hair", "-"], text.as_bytes());
    assert!(
        ran.code == Some(0) && ran.err.contains("7.000e-2 m is not that of a hair"),
        "{}",
        ran.err
    );
}

#[test]
fn without_weight_a_hair_is_its_natural_helix() {
    let text = "gravity = 0\nequilibrium.elements = 4\n[hair]\nlength = \"10 cm\"\n\
                [hair.curl]\nradius = \"1 cm\"\npitch = 0\n";
    let report = json(text, &["--points", "101"]);
    assert_eq!(report["elements"], 4);
    assert_eq!(report["energy"]["total"], 0.0);
    let points = report["points"].as_array().unwrap();
    assert_eq!(points.len(), 101);
    for (i, point) in points.iter().enumerate() {
        let s = 0.001 * i as f64 / 0.01;
        let [x, y, z] = [0, 1, 2].map(|k| point[k].as_f64().unwrap());
        // A circle of 1 cm, from +x downwards: κ1 turns about d1 = +y.
        assert!((x - 0.01 * s.sin()).abs() < 1e-12 && y.abs() < 1e-12);
        assert!((z - 0.01 * (s.cos() - 1.0)).abs() < 1e-12, "{z}");
    }
}

#[test]
fn roots_natural_strains_along_and_branches_arrive() {
    let up = "[hair]\nlength = \"2 cm\"\ncurl.kappa1 = 0\nroot = { t = [0, 0, 1], d1 = [1, 0, 0] }";
    let tip = json(up, &[])["tip"][2].as_f64().unwrap();
    assert!((tip - 0.02).abs() < 1e-6, "{tip}");
    let hook = "[hair]\nlength = \"4 cm\"\n[[hair.curl.along]]\ns = \"3 cm\"\n\
                [[hair.curl.along]]\ns = \"3.01 cm\"\nkappa1 = \"3 1/cm\"\n";
    let kinked = json(hook, &[])["tip"][2].as_f64().unwrap();
    assert!(kinked < -0.005, "{kinked}");
    let lowest =
        format!("{up}\n[equilibrium]\nbranch = \"lowest\"\nstarts = 3\nelement = \"helix\"");
    assert_eq!(json(&lowest, &[])["stable"], true);
}

#[test]
fn the_table_is_for_people_and_the_same_each_time() {
    let run = || Room::new().feed(&["hair", "-", "--points", "2"], BEAM.as_bytes());
    let ran = run();
    assert_eq!(ran.code, Some(0));
    for part in ["length           10.00 cm", "stable equilibrium", "J\n", " cm\n"] {
        assert!(ran.out.contains(part), "{part}: {}", ran.out);
    }
    assert_eq!(ran.out, run().out);
}

#[test]
fn what_is_no_equilibrium_says_so_in_its_exit_code() {
    // Coils of 0.3 mm in a hair of 3 m that three elements cannot follow, in a hundred gravities.
    let text = "gravity = 1000\nequilibrium.elements = 3\n[hair]\nlength = 3\n\
                fibre = { diameter = \"45 um\", axis_ratio = 1.3 }\ncurl = { radius = \"0.3 mm\", pitch = \"0.2 mm\" }\n";
    let ran = Room::new().feed(&["hair", "-", "--json"], text.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (Some(3), ""));
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(report["stable"], false);
}

#[test]
fn a_missed_accuracy_has_an_exit_code_of_its_own() {
    // An atom's breadth, which rounding allows no number of elements to show.
    let text = format!("{BEAM}[equilibrium]\naccuracy = 1e-18\n");
    let ran = Room::new().feed(&["hair", "-", "--json"], text.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (Some(4), ""));
    let report: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!((&report["accuracy_met"], &report["stable"]), (&false.into(), &true.into()));
    assert!(report["error_estimate"].as_f64() > report["requested_accuracy"].as_f64());
    let table = Room::new().feed(&["hair", "-"], text.as_bytes());
    assert!(table.code == Some(4) && table.out.contains("1.0e-15 mm: MISSED"), "{}", table.out);
    // Met, by default too; no question for a number of elements.
    let default = json(BEAM, &[]);
    assert_eq!(
        (&default["accuracy_met"], &default["requested_accuracy"]),
        (&true.into(), &5e-4.into())
    );
    let given = json(&format!("{BEAM}[equilibrium]\nelements = 12\n"), &[]);
    assert!(given["accuracy_met"].is_null() && given["requested_accuracy"].is_null());
}

#[test]
fn every_scene_of_the_repository_has_a_hair() {
    for entry in std::fs::read_dir(scene("")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let ran = Room::new().run(&["hair", path.to_str().unwrap()]);
            assert_eq!(ran.code, Some(0), "{}", ran.err);
        }
    }
}

#[test]
fn presets_start_scenes() {
    let room = Room::new();
    let list = room.run(&["presets"]);
    assert_eq!(list.code, Some(0));
    let rows = list.out.lines().skip(1).take_while(|l| !l.is_empty());
    let names: Vec<_> = rows.filter_map(|l| l.split(' ').next()).collect();
    assert!(names.len() >= 20 && names.contains(&"caucasian-curly"));
    for name in names {
        let new = room.run(&["new", name]);
        assert_eq!(new.code, Some(0));
        assert!(new.out.contains(&format!("type = \"{name}\"")));
        let hair = room.feed(&["hair", "-"], new.out.as_bytes());
        assert_eq!(hair.code, Some(0), "{}", hair.err);
    }
}

#[test]
fn a_preset_tells_its_numbers() {
    let room = Room::new();
    let sheet = room.run(&["presets", "african-coily"]);
    assert_eq!(sheet.code, Some(0));
    for row in ["hairs                    161 per cm^2", "growth                   0.85 cm a month"]
    {
        assert!(sheet.out.contains(row), "{}", sheet.out);
    }
    let one: Value =
        serde_json::from_str(&room.run(&["presets", "african-coily", "--json"]).out).unwrap();
    assert_eq!((&one["density"], &one["axis_ratio"]), (&161e4.into(), &1.75.into()));
    let all: Value = serde_json::from_str(&room.run(&["presets", "--json"]).out).unwrap();
    assert!(all.as_array().unwrap().contains(&one));
}

#[test]
fn the_schema_is_a_schema() {
    let ran = Room::new().run(&["schema"]);
    let schema: Value = serde_json::from_str(&ran.out).unwrap();
    assert_eq!(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
    assert_eq!(schema["properties"]["seed"]["type"], "integer");
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    // Nobody reads: the pipe is closed before the program writes.
    let room = Room::new();
    for arguments in [&["schema"][..], &["presets"], &["--help"]] {
        let mut child = room.command(arguments).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "");
    }
}

#[test]
fn steps_and_regions_are_told_to_be_for_a_head() {
    let room = Room::new()
        .with("steps.toml", "step = [{ cut = { length = '5 cm' } }]")
        .with("regions.toml", "region = [{ where = 'all', curl = 3 }]")
        .with("plain.toml", "");
    for (scene, told) in [("steps.toml", true), ("regions.toml", true), ("plain.toml", false)] {
        let ran = room.run(&["hair", scene]);
        assert_eq!((ran.code, ran.err.contains("are for a head")), (Some(0), told), "{}", ran.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let room = Room::new();
    for arguments in [&["schema"][..], &["--help"], &["hair", "--help"], &["--version"]] {
        let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
        let output = room.command(arguments).stdout(Stdio::from(full)).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{arguments:?}");
        assert!(String::from_utf8_lossy(&output.stderr).contains("No space left"));
    }
}

#[test]
fn measured_hair_becomes_a_scene_that_says_what_was_not_measured() {
    let table = "curvature (1/mm),diameter (um)\n0.1,70\n0.1,72\n";
    let room = Room::new().with("hairs.csv", table);
    let ran = room.run(&["measured", "hairs.csv", "--pitch", "24 mm", "-o", "mine.toml"]);
    assert_eq!((ran.code, ran.out.as_str()), (Some(0), ""), "{}", ran.err);
    assert!(ran.err.contains("note: How much diameters and curvatures differ"), "{}", ran.err);
    let hair = room.run(&["hair", "mine.toml", "--json"]);
    assert_eq!(hair.code, Some(0), "{}", hair.err);

    let ran = room.run(&["measured", "hairs.csv", "--pitch", "9 cm"]);
    assert_eq!(ran.code, Some(2));
    assert!(
        ran.err.contains("a pitch of 9 cm does not go with a curvature of 0.1 1/mm"),
        "{}",
        ran.err
    );
    let ran = room.run(&["measured", "hairs.csv", "--pitch", "9 cm", "--radius", "1 mm"]);
    assert_eq!(ran.code, Some(2));
}
