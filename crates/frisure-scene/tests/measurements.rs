//! Tables of measured hair, as programs and people write them, into a fibre and its curl.

use std::f64::consts::TAU;
use std::fs;
use std::path::{Path, PathBuf};

use frisure_hairstyle::preset;
use frisure_scene::Scene;
use frisure_scene::measurements::{Choices, Estimate, MeasurementError, Steepness, measured};
use proptest::prelude::*;
use tempfile::TempDir;

/// Two sections of fibermorph's own demonstration, whose scale is not calibrated (MIT).
const SECTIONS: &str = "ID,area,eccentricity,min,max\n\
    140918_demo_section,354.9896193771626,0.5691283490493467,19.437954312316432,23.63999401397925\n\
    140918_demo_section2,214.2006920415225,0.8809651510494583,11.398997397829351,24.09013408274446\n";

/// The summary of its curvatures, with two windows an image (MIT).
const CURVATURES: &str = ",ID,curv_mean_mean,curv_mean_median,curv_median_mean,curv_median_median,\
    length_mean,length_median,hair_count\n\
    0,004_demo_curv_WindowSize-0.5mm,1.0970,0.8315,1.0105,0.8300,2.748,2.810,9\n\
    0,004_demo_curv_WindowSize-1.0mm,1.0866,0.8711,1.0425,0.8312,2.748,2.810,9\n\
    0,027_demo_nocurv_WindowSize-0.5mm,0.0868,0.0699,0.0660,0.0516,3.051,2.856,8\n\
    0,027_demo_nocurv_WindowSize-1.0mm,0.0309,0.0347,0.0284,0.0330,3.051,2.856,8\n";

/// Medians of people by what they call their hair (Lasisi et al. 2021, MIT).
const PEOPLE: &str = "# n = 80\n\
    self_reported,n,curvature_per_mm_median,curvature_per_mm_p10,curvature_per_mm_p90,\
    axis_ratio_median,axis_ratio_p10,axis_ratio_p90,min_diameter_um_median,max_diameter_um_median\n\
    straight,10,0.067,0.032,0.139,1.42,1.31,1.51,51,75\n\
    very curly,35,0.382,0.153,0.560,1.73,1.45,1.96,57,99\n";

struct Tables {
    folder: TempDir,
    paths: Vec<PathBuf>,
}

impl Tables {
    fn new(files: &[(&str, &str)]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let paths = files.iter().map(|(name, text)| {
            let path = folder.path().join(name);
            fs::write(&path, text).unwrap();
            path
        });
        let paths = paths.collect();
        Self { folder, paths }
    }

    fn read(&self, choices: &Choices) -> Result<Estimate, MeasurementError> {
        let paths: Vec<&Path> = self.paths.iter().map(AsRef::as_ref).collect();
        measured(&paths, choices)
    }
}

fn one(text: &str) -> Result<Estimate, MeasurementError> {
    with(text, &Choices::default())
}

fn with(text: &str, choices: &Choices) -> Result<Estimate, MeasurementError> {
    Tables::new(&[("table.csv", text)]).read(choices)
}

fn pairs(of: &[(&str, &str)]) -> Vec<(String, String)> {
    of.iter().map(|(a, b)| ((*a).to_owned(), (*b).to_owned())).collect()
}

fn near(value: f64, expected: f64, relative: f64) {
    assert!((value / expected - 1.0).abs() < relative, "{value} is not {expected}");
}

/// The hair that the scene of an estimate describes.
fn described(estimate: &Estimate) -> frisure_hairstyle::HairstyleSpec {
    let text = estimate.scene();
    let scene = Scene::parse("measured.toml", text.clone(), Path::new(""));
    scene.and_then(|s| s.hairstyle_spec()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

#[test]
fn sections_by_their_diameters() {
    let estimate = one(SECTIONS).unwrap();
    let [a, b] = [(19.437_954_f64, 23.639_994_f64), (11.398_997, 24.090_134)];
    let mean = 0.5e-6 * ((a.0 * a.1).sqrt() + (b.0 * b.1).sqrt());
    near(estimate.diameter.as_ref().unwrap().mean, mean, 1e-7);
    let ratio = 0.5 * (a.1 / a.0 + b.1 / b.0);
    near(estimate.axis_ratio.as_ref().unwrap().mean, ratio, 1e-7);
    assert!(
        estimate.notes.iter().any(|n| n.contains("not that of scalp hair")),
        "no word of scale"
    );
    let section = described(&estimate).fibre.section;
    near(2.0 * section.mean_radius(), mean, 1e-3);
    near(section.axis_ratio(), ratio, 1e-3);

    let shape = with(SECTIONS, &Choices { shape_only: true, ..Choices::default() }).unwrap();
    assert!(shape.diameter.is_none());
    let type_diameter = shape.hair_type.hair_type().diameter;
    near(2.0 * described(&shape).fibre.section.mean_radius(), type_diameter, 1e-9);
}

#[test]
fn area_and_eccentricity_say_the_same_as_diameters() {
    let whole = one("area (um^2),eccentricity\n4000,0.8\n").unwrap();
    near(whole.diameter.unwrap().mean, (4.0 * 4000e-12 / std::f64::consts::PI).sqrt(), 1e-12);
    near(whole.axis_ratio.unwrap().mean, 1.0 / 0.6, 1e-12);
    let ratio = one("diameter_um,axis ratio\n70,1.5\n80,1.7\n").unwrap();
    near(ratio.diameter.unwrap().mean, 75e-6, 1e-12);
    near(ratio.axis_ratio.unwrap().mean, 1.6, 1e-12);
}

#[test]
fn radii_told_as_diameters_are_noticed() {
    let estimate = one("min (um),max (um),area (um^2)\n30,40,3769.9\n").unwrap();
    assert!(estimate.notes.iter().any(|n| n.contains("4.0 times")), "{:?}", estimate.notes);
}

#[test]
fn spread_between_hairs_is_that_of_the_table() {
    let rows = "60\n65\n70\n75\n80\n";
    let estimate = one(&format!("diameter (um)\n{rows}")).unwrap();
    let variation = 62.5_f64.sqrt() / 70.0;
    near(estimate.diameter.as_ref().unwrap().variation().unwrap(), variation, 1e-12);
    near(described(&estimate).fibre.variation, variation, 5e-3);

    let ratios = one("axis ratio\n1.2\n1.4\n1.5\n1.6\n1.8\n").unwrap();
    let excess = 0.05_f64.sqrt() / 0.5;
    near(described(&ratios).fibre.axis_ratio_variation, excess, 5e-3);
}

#[test]
fn curvature_of_the_longest_window_and_the_rows_asked_for() {
    let choices = Choices { rows: pairs(&[("ID", "004_demo_curv*")]), ..Choices::default() };
    let estimate = with(CURVATURES, &choices).unwrap();
    let curvature = estimate.curvature.as_ref().unwrap();
    near(curvature.mean, 1042.5, 1e-9);
    assert_eq!((curvature.count, curvature.groups, curvature.deviation), (9, 1, None));
    near(described(&estimate).curl.strain.truncate().length(), 1042.5, 1e-3);

    let short = Choices { window: Some(0.5e-3), ..choices };
    near(with(CURVATURES, &short).unwrap().curvature.unwrap().mean, 1010.5, 1e-9);
}

#[test]
fn images_of_different_hair_are_pointed_out() {
    let estimate = one(CURVATURES).unwrap();
    near(estimate.curvature.as_ref().unwrap().mean, (9.0 * 1042.5 + 8.0 * 28.4) / 17.0, 1e-9);
    assert!(estimate.notes.iter().any(|n| n.contains("--rows")), "{:?}", estimate.notes);
    let straight = Choices { rows: pairs(&[("ID", "027*")]), ..Choices::default() };
    let straight = with(CURVATURES, &straight).unwrap();
    near(straight.curvature.as_ref().unwrap().mean, 28.4, 1e-9);
    assert!(straight.notes.iter().any(|n| n.contains("straighter")), "{:?}", straight.notes);
}

#[test]
fn windows_tell_each_hair_and_how_it_varies() {
    // Two hairs of 100 windows around 0.4 and 0.6 1/mm, and one window gone wild.
    let hair = |label: u32, mean: f64| {
        let window = |i: u32| {
            let wave = (f64::from(i) * TAU / 100.0).sin();
            let curvature = if i == 50 { 40.0 } else { mean * (1.0 + 0.1 * wave) };
            format!("{i},{curvature},{label}\n")
        };
        (0..100).map(window).collect::<String>()
    };
    let text = |label, mean| format!(",curv,label\n{}", hair(label, mean));
    let tables = Tables::new(&[
        ("WithinElement_a_WindowSize-1.0mm_Label-1.csv", &text(1, 0.4)),
        ("WithinElement_a_WindowSize-1.0mm_Label-2.csv", &text(2, 0.6)),
    ]);
    let estimate = tables.read(&Choices::default()).unwrap();
    let curvature = estimate.curvature.as_ref().unwrap();
    near(curvature.mean, 500.0, 0.01);
    assert_eq!(curvature.count, 2);
    // The quartiles of a sine of 0.1 are ±0.0707, and those of a normal distribution 0.6745.
    let (along, hairs) = estimate.variation_along.unwrap();
    near(along, 0.1 * 0.5_f64.sqrt() / 0.6745, 0.05);
    assert_eq!(hairs, 2);
    near(described(&estimate).curl.variation_along, along, 0.01);
    drop(tables.folder);
}

#[test]
fn a_summary_of_the_same_image_does_not_count_twice() {
    let hairs = ",curv_mean,curv_median,length\n0,0.5,0.4,3\n1,0.7,0.6,3\n";
    let tables = Tables::new(&[
        ("ImageSum_a_WindowSize-1.0mm.csv", hairs),
        ("curvature_summary_data.csv", CURVATURES),
    ]);
    let curvature = tables.read(&Choices::default()).unwrap().curvature.unwrap();
    // Of a hair the median, since a few windows go wrong.
    near(curvature.mean, 500.0, 1e-9);
    assert_eq!((curvature.count, curvature.groups), (2, 0));
}

#[test]
fn people_by_what_they_call_their_hair() {
    let of = |name: &str| {
        let choices = Choices { rows: pairs(&[("self_reported", name)]), ..Choices::default() };
        with(PEOPLE, &choices).unwrap()
    };
    let curly = of("very curly");
    near(curly.axis_ratio.as_ref().unwrap().mean, 1.73, 1e-12);
    near(curly.diameter.as_ref().unwrap().mean, (57.0_f64 * 99.0).sqrt() * 1e-6, 1e-9);
    near(curly.curvature.as_ref().unwrap().mean, 382.0, 1e-9);
    assert!(curly.notes.iter().any(|n| n.contains("Passed over") && n.contains("self_reported")));
    // What differs between people says nothing of the hairs of a head.
    assert_eq!(curly.curvature.as_ref().unwrap().deviation, None);
    assert_eq!(curly.hair_type.name, "kinky");
    assert_eq!(of("straight").diameter.unwrap().count, 10);
}

#[test]
fn moduli_are_independent_of_each_other() {
    let estimate = one("Young's modulus (GPa),shear modulus (GPa)\n3.89,0.89\n").unwrap();
    let material = described(&estimate).fibre.material;
    near(material.youngs_modulus(), 3.89e9, 1e-9);
    near(material.shear_modulus(), 0.89e9, 1e-9);
}

#[test]
fn a_spreadsheet_with_commas_for_points() {
    let text = "\u{feff}Haar;Curve diameter (mm);Pitch (mm)\r\n1;20,5;24\r\n2;19,5;26\r\n";
    let estimate = one(text).unwrap();
    near(estimate.curvature.as_ref().unwrap().mean, 0.5 * (2.0 / 0.0205 + 2.0 / 0.0195), 1e-9);
    near(estimate.helix.unwrap().1, 0.025, 1e-9);
}

#[test]
fn groups_with_deviations_tell_how_hairs_differ() {
    let text = "n,diameter_mean_um,diameter_sd_um,curve diameter mean (mm),curve diameter sd (mm)\n\
                30,70,7,20,4\n";
    let estimate = one(text).unwrap();
    near(estimate.diameter.as_ref().unwrap().variation().unwrap(), 0.1, 1e-9);
    // To first order 2/x varies by as large a part as x.
    near(estimate.curvature.as_ref().unwrap().variation().unwrap(), 0.2, 1e-9);
}

#[test]
fn a_second_number_makes_the_helix_and_its_lack_is_told() {
    let text = "curvature (1/mm)\n0.1\n";
    let choices = Choices { steepness: Some(Steepness::Radius(0.008)), ..Choices::default() };
    let (radius, pitch) = with(text, &choices).unwrap().helix.unwrap();
    near(radius, 0.008, 1e-12);
    let advance = pitch / TAU;
    near(radius / (radius * radius + advance * advance), 100.0, 1e-12);

    let filled = Choices { hair_type: preset("caucasian-curly"), ..Choices::default() };
    let filled = with(text, &filled).unwrap();
    let (radius, pitch) = filled.helix.unwrap();
    near(pitch / radius, 24.0 / 10.0, 1e-9);
    assert!(filled.notes.iter().any(|n| n.starts_with("Torsion")), "{:?}", filled.notes);

    let wide = Choices { steepness: Some(Steepness::Radius(0.02)), ..Choices::default() };
    let error = with(text, &wide).unwrap_err().to_string();
    assert!(error.contains("at most 10 mm"), "{error}");
}

#[test]
fn columns_of_other_names() {
    let text = "A,B\n90,60\n";
    let columns = pairs(&[("A", "max diameter (um)"), ("B", "min diameter (um)")]);
    let estimate = with(text, &Choices { columns, ..Choices::default() }).unwrap();
    near(estimate.axis_ratio.unwrap().mean, 1.5, 1e-12);
}

#[test]
fn what_is_wrong_is_named() {
    let cases: &[(&str, &str)] = &[
        ("", "empty"),
        ("diameter (um)\n", "no rows"),
        ("diameter (um),n\n70\n", "line 2 has 1 cells"),
        ("diameter (um)\n70\nthick\n", "table.csv:3: `diameter (um)` is thick"),
        ("diameter (um)\n0.07\n", "must be between 1 um and 1 mm"),
        ("diameter (um)\n-70\n", "must be between 1 um and 1 mm"),
        ("diameter (mm)\n70\n", "must be between 1 um and 1 mm"),
        ("diameter\n70\n", "it has no unit"),
        ("diameter (GPa)\n70\n", "`GPa` is not a unit of a length"),
        ("eccentricity\n1\n", "must be between 0 and"),
        ("axis ratio\n0.7\n", "must be between 1 and 20"),
        ("min (um),max (um)\n80,60\n", "at most the longer diameter"),
        ("curve diameter (mm)\n0\n", "must be at least"),
        ("colour,mood\nred,good\n", "nothing in these tables is about hair"),
        ("diameter (um)\nNA\n\n", "nothing in these tables is about hair"),
        ("n,diameter (um)\n0,70\n", "a whole number of at least 1"),
        ("diameter (um),Fiber diameter (um)\n70,80\n", "say the same"),
    ];
    for (text, expected) in cases {
        let error = one(text).unwrap_err().to_string();
        assert!(error.contains(expected), "{text:?}: {error}");
    }
    let hint = one("density (kg/m3)\n1300\n").unwrap_err().hint();
    assert!(hint.contains("=density (g/cm^3)'"), "{hint}");
    let tables = Tables::new(&[("a.csv", SECTIONS)]);
    let twice = [tables.paths[0].as_path(), tables.paths[0].as_path()];
    let error = measured(&twice, &Choices::default()).unwrap_err().to_string();
    assert!(error.contains("is given twice"), "{error}");
    let refuse = |choices: Choices| with(SECTIONS, &choices).unwrap_err().to_string();
    let no_column = refuse(Choices { rows: pairs(&[("who", "me")]), ..Choices::default() });
    assert!(no_column.contains("no table has a column `who`; there are ID, area"), "{no_column}");
    let no_rows = refuse(Choices { rows: pairs(&[("ID", "me")]), ..Choices::default() });
    assert!(no_rows.contains("no row has `me`"), "{no_rows}");
    let no_meaning = refuse(Choices { columns: pairs(&[("ID", "mood")]), ..Choices::default() });
    assert!(no_meaning.contains("`mood` is not a property of hair"), "{no_meaning}");
}

proptest! {
    #[test]
    fn any_table_makes_a_scene_or_an_error(
        heading in "(diameter|axis ratio|curv|min|max|area|eccentricity|pitch|n|label|[a-z ]{0,9})",
        unit in "( \\(um\\)|_mm| \\[1/mm\\]|_per_mm|)",
        cells in proptest::collection::vec("(-?[0-9]{0,4}[.,]?[0-9]{0,3}|nan|inf|\"|.{0,5})", 1..20),
    ) {
        let text = format!("{heading}{unit},curvature (1/mm)\n{}", cells.join("\n"));
        if let Ok(estimate) = one(&text) {
            let scene = estimate.scene();
            prop_assert!(Scene::parse("m.toml", scene.clone(), Path::new("")).is_ok(), "{}", scene);
        }
    }
}
