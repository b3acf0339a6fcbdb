//! Batches: what is drawn, and what is said about what is wrong.

use std::path::Path;

use frisure_scene::Scene;
use frisure_scene::batch::{Batch, Kind, Value, ViewOutput};

fn batch(text: &str) -> Batch {
    Batch::parse("batch", text, Path::new("")).unwrap_or_else(|e| panic!("{text}\n{e}"))
}

/// The numbers of each head at some places, a list for each. A head is drawn once: its scene is written and parsed.
fn numbers<const N: usize>(batch: &Batch, places: [usize; N]) -> [Vec<f64>; N] {
    let mut all = [const { Vec::new() }; N];
    for index in 0..batch.heads() {
        let values = batch.sample(index).values;
        for (list, place) in all.iter_mut().zip(places) {
            list.push(match &values[place] {
                Value::Number(x) => *x,
                Value::Whole(i) => *i as f64,
                other => panic!("{other:?}"),
            });
        }
    }
    all
}

/// Mean and standard deviation.
fn moments(all: &[f64]) -> [f64; 2] {
    let count = all.len() as f64;
    let mean = all.iter().sum::<f64>() / count;
    let square = all.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count;
    [mean, square.sqrt()]
}

fn near(found: f64, expected: f64, part: f64) {
    assert!((found - expected).abs() < part * expected.abs(), "{found} is not {expected}");
}

/// Of a uniform distribution: (a + b)/2 and (b − a)/√12; of a log-uniform the mean (b − a)/ln(b/a); of a
/// log-normal the median.
#[test]
fn draws_have_the_moments_of_their_distributions() {
    let batch = batch(
        r#"samples = 4000
        [vary]
        "hair.length" = { from = "10 cm", to = "40 cm" }
        "hair.fibre.diameter" = { normal = ["70 um", "5 um"] }
        "hair.curl.radius" = { from = "2 mm", to = "20 mm", log = true }
        "hair.curl.pitch" = { lognormal = ["20 mm", 0.3] }
        "#,
    );
    let [lengths, diameters, radii, mut pitches] = numbers(&batch, [0, 1, 2, 3]);
    let [mean, deviation] = moments(&lengths);
    near(mean, 0.25, 0.02);
    near(deviation, 0.3 / 12.0_f64.sqrt(), 0.03);
    let [mean, deviation] = moments(&diameters);
    near(mean, 70e-6, 0.01);
    near(deviation, 5e-6, 0.05);
    near(moments(&radii)[0], 18e-3 / 10.0_f64.ln(), 0.05);
    pitches.sort_by(f64::total_cmp);
    near(pitches[2000], 20e-3, 0.03);
}

#[test]
fn a_head_depends_on_its_number_and_its_own_keys_alone() {
    let vary = "[vary]\n\"hair.length\" = { from = \"10 cm\", to = \"40 cm\" }\n";
    let few = batch(&format!("samples = 3\n{vary}"));
    let many = batch(
        &format!("samples = 30\n{vary}\"hair.gloss\" = [1]").replace("hair.gloss", "wisps.count"),
    );
    for index in 0..3 {
        let (a, b) = (few.sample(index), many.sample(index));
        assert_eq!((a.seed, &a.values[0]), (b.seed, &b.values[0]));
    }
    let seeds: std::collections::BTreeSet<u64> = (0..30).map(|i| many.sample(i).seed).collect();
    assert_eq!(seeds.len(), 30);
    let other = batch(&format!("seed = 2\nsamples = 3\n{vary}"));
    assert_ne!(other.sample(0).values, few.sample(0).values);
    assert_eq!(few.digest(), batch(&format!("# longer\nsamples = 5\n{vary}")).digest());
    assert_ne!(few.digest(), other.digest());
}

#[test]
fn scenes_say_what_their_heads_have() {
    let batch = batch(
        r#"samples = 5
        [set]
        hair.fibre.diameter = "80 um"
        [vary]
        hair.length = { from = "10 cm", to = "40 cm" }
        wisps.count = { from = 3, to = 9 }
        hair.type = ["straight", "curly"]
        "region[0].where" = ["top"]
        "region[0].length" = ["5 cm", 0.06]
        "#,
    );
    let kinds: Vec<Kind> = batch.parameters().map(|(_, kind)| kind).collect();
    assert_eq!(kinds, [Kind::Number, Kind::Whole, Kind::Text, Kind::Text, Kind::Number]);
    for index in 0..5 {
        let sample = batch.sample(index);
        let scene = Scene::parse("scene", sample.text.unwrap(), Path::new("")).unwrap();
        let spec = scene.hairstyle_spec().unwrap();
        assert_eq!(spec.seed, sample.seed);
        assert_eq!(Value::Whole(spec.wisps.count as i64), sample.values[1]);
        assert_eq!(Value::Number(spec.length.mean), sample.values[0]);
        assert_eq!(spec.fibre.section.mean_radius(), 40e-6);
        assert_eq!(spec.regions.len(), 1);
    }
}

#[test]
fn a_grid_is_every_pair() {
    let batch = batch(
        r#"samples = 2
        same_seed = true
        [grid]
        hair.length = { from = "10 cm", to = "30 cm", steps = 3 }
        wisps.count = [4, 5]
        "#,
    );
    assert_eq!(batch.heads(), 12);
    let [lengths, counts] = numbers(&batch, [0, 1]);
    let expected = [0.1, 0.1, 0.2, 0.2, 0.3, 0.3].map(|x: f64| (1e6 * x).round());
    let rounded = |all: &[f64]| all.iter().map(|x| (1e6 * x).round()).collect::<Vec<_>>();
    assert_eq!(rounded(&lengths[..6]), expected);
    // Again from the start, so that the batch can grow at its end.
    assert_eq!(lengths[..6], lengths[6..]);
    assert_eq!(counts[..4], [4.0, 5.0, 4.0, 5.0]);
    assert_eq!(batch.sample(0).seed, batch.sample(7).seed);
}

#[test]
fn rows_of_a_table_stay_together() {
    let folder = tempfile::tempdir().unwrap();
    let table =
        "id;length (cm);d;mean_um;type\n1;10,5;70;70;straight\n2;20;;5;wavy\n3;30;90;90;curly\n";
    std::fs::write(folder.path().join("people.csv"), table).unwrap();
    let text = r#"samples = 40
        [vary]
        "hair.length" = { table = "people.csv", column = "length" }
        "hair.fibre.diameter" = { table = "people.csv", column = "d", unit = "um" }
        "hair.type" = { table = "people.csv", column = "type" }
        "#;
    let batch = Batch::parse("batch", text, folder.path()).unwrap();
    let mut seen = std::collections::BTreeSet::new();
    for index in 0..40 {
        let values = batch.sample(index).values;
        let Value::Text(word) = &values[2] else { panic!("{values:?}") };
        // The second has no diameter.
        let expected = if word == "straight" { [0.105, 70e-6] } else { [0.3, 90e-6] };
        for (value, expected) in values.iter().zip(expected) {
            let Value::Number(x) = value else { panic!("{values:?}") };
            near(*x, expected, 1e-12);
        }
        seen.insert(word.clone());
    }
    assert_eq!(seen.into_iter().collect::<Vec<_>>(), ["curly", "straight"]);

    // A heading may say the unit.
    let said = text.replace("\"d\", unit = \"um\"", "\"mean_um\"");
    let said = Batch::parse("batch", said, folder.path()).unwrap();
    let [thick] = numbers(&said, [1]);
    let smallest = thick.into_iter().fold(f64::INFINITY, f64::min);
    near(smallest, 5e-6, 1e-12);

    for (from, to, part) in [
        ("\"d\", unit = \"um\"", "\"d\"", "people.csv:2: `d` is 70: a length needs a unit"),
        ("\"um\"", "\"GPa\"", "`GPa` is not a unit of a length"),
        ("\"length\"", "\"length\", unit = \"m\"", "it must be between 1 mm and 3 m"),
        ("\"length\"", "\"length\", unit = \"m\"", "people.csv:2: `length (cm)` is 10,5"),
        ("\"d\"", "\"dd\"", "has no column `dd`"),
        ("people.csv\", column = \"len", "people.txt\", column = \"len", "there is no file"),
        ("\"type\"", "\"id\"", "it must be one of"),
    ] {
        let wrong = text.replace(from, to);
        let error = Batch::parse("batch", wrong.as_str(), folder.path());
        let error = error.map(|batch| batch.heads()).unwrap_err().to_string();
        assert!(error.contains(part), "{wrong}\n{error}");
    }
}

#[test]
fn views_have_cameras_and_outputs_in_order() {
    let heads = |views: &str| batch(&format!("samples = 1\n{views}"));
    let all =
        heads("views.cameras = ['front', 'side', { azimuth = '30 deg', elevation = '-10 deg' }]");
    let views = all.views().unwrap();
    let names: Vec<&str> = views.cameras.iter().map(|camera| camera.name.as_str()).collect();
    assert_eq!(names, ["front", "side", "camera-02"]);
    near(views.cameras[1].azimuth, std::f64::consts::FRAC_PI_2, 1e-12);
    near(views.cameras[2].elevation, -10_f64.to_radians(), 1e-12);
    assert_eq!((views.width, views.height, views.hairs, views.samples), (512, 512, 20_000, 3));
    assert_eq!(views.outputs, ViewOutput::ALL);

    let orbit = heads(
        "[views]\ncameras = { count = 4, elevation = 0.1 }\noutputs = ['strand', 'color', 'strand']",
    );
    let views = orbit.views().unwrap();
    near(views.cameras[3].azimuth, 1.5 * std::f64::consts::PI, 1e-12);
    assert_eq!((views.cameras.len(), views.cameras[3].elevation), (4, 0.1));
    assert_eq!(views.outputs, [ViewOutput::Color, ViewOutput::Strand]);

    // The digest has the views; a batch without them has the digest that it had before there were any.
    let digests: std::collections::BTreeSet<String> =
        [heads("").digest(), all.digest(), orbit.digest()].into();
    assert_eq!((heads("").views(), digests.len()), (None, 3));
}

/// Text after `samples = 2`, line and column, and parts of the sentence with its hint.
type Case = (&'static str, usize, usize, &'static [&'static str]);

#[test]
fn faults_name_place_value_range_and_hint() {
    let cases: &[Case] = &[
        ("vari = 1", 2, 1, &["unknown key `vari`", "did you mean `vary`?"]),
        ("rows = 0", 2, 8, &["`rows` is 0", "between 1 and 100000"]),
        ("seed = -1", 2, 8, &["`seed` is -1", "0 or more"]),
        ("seed = 1.5", 2, 8, &["a whole number"]),
        ("same_seed = 1", 2, 13, &["true or false"]),
        ("scene = 1", 2, 9, &["a text in quotes"]),
        ("scene = \"none.toml\"", 2, 9, &["there is no file", "relative to the batch"]),
        ("vary = 3", 2, 8, &["it must be a table"]),
        ("vary.hair.lenght = [1]", 2, 11, &["`lenght` is no key of `hair`", "`length`?"]),
        ("vary.length = [1]", 2, 6, &["there is a `hair.length`"]),
        ("vary.hair = [1]", 2, 6, &["`hair` is a table", "fibre"]),
        ("vary.region = [1]", 2, 6, &["is a list of tables", "`region[0]`"]),
        ("vary.region.length = [1]", 2, 13, &["is a list of tables", "`region[0]`"]),
        ("vary.\"hair[0].length\" = [1]", 2, 6, &["`hair` is no list"]),
        ("vary.hair.length = []", 2, 20, &["a list of values"]),
        ("vary.hair.length = '5 cm'", 2, 20, &["'5 cm'", "`[set]` gives all heads one value"]),
        ("vary.hair.length = { mean = 1 }", 2, 22, &["unknown key `mean`", "normal"]),
        ("vary.hair.length = {}", 2, 20, &["nothing says how", "`from`"]),
        ("vary.hair.length = { from = 1 }", 2, 20, &["has no `to`"]),
        ("vary.hair.length = { from = 1, to = 0.5 }", 2, 37, &["more than `from`, which is 1"]),
        ("vary.hair.length = { from = '1', to = 2 }", 2, 29, &["a length", "add a unit"]),
        ("vary.hair.length = { from = '1 kPa', to = 2 }", 2, 29, &["is a unit of a modulus"]),
        ("vary.hair.length = { from = '1 cm', to = '9 m' }", 2, 42, &["'9 m'", "1 mm and 3 m"]),
        ("vary.hair.length = { from = 0, to = 1, log = true }", 2, 29, &["more than 0"]),
        ("vary.hair.length = { from = 1, to = 2, steps = 3 }", 2, 40, &["does not go with"]),
        ("vary.hair.length = { normal = 1 }", 2, 31, &["the mean and the standard deviation"]),
        ("vary.hair.length = { normal = [1, 0] }", 2, 35, &["more than 0"]),
        ("vary.hair.length = { normal = [1, 0.1], to = 0.5 }", 2, 46, &["three deviations"]),
        ("vary.hair.length = { lognormal = [-1, 0.1] }", 2, 35, &["more than 0"]),
        ("vary.hair.type = { from = 1, to = 2 }", 2, 27, &["no numbers", "values"]),
        ("vary.hair.type = ['curly', 'curlyy']", 2, 28, &["one of", "did you mean \"curly\"?"]),
        ("vary.hair.type = { values = ['wavy'], weights = [1, 2] }", 2, 49, &["1 numbers"]),
        ("vary.hair.type = { values = ['wavy'], weights = [0] }", 2, 49, &["not all 0"]),
        ("vary.wisps.count = { from = 1, to = 2.5 }", 2, 37, &["a whole number"]),
        ("vary.wisps.count = [0, 5]", 2, 21, &["`wisps.count` is 0", "between 1 and 20000"]),
        ("set.wisps.count = 0", 2, 19, &["`wisps.count` is 0", "between 1 and 20000"]),
        ("set.wisps.cont = 3", 2, 11, &["`cont` is no key of `wisps`", "`count`?"]),
        ("grid.wisps.count = 3", 2, 20, &["it must be a list"]),
        ("grid.hair.length = { from = 1, to = 2 }", 2, 20, &["has no `steps`"]),
        ("grid.hair.length = [1]\nset.hair.length = 2", 2, 11, &["is said twice"]),
        ("views = 1", 2, 9, &["`views` is 1", "a table"]),
        ("views = { size = [8, 8] }", 2, 1, &["`views` has no cameras", "around the head"]),
        ("views = { cameras = [] }", 2, 21, &["a list of 1 to 360 cameras", "`count`"]),
        (
            "views = { cameras = ['frontt'] }",
            2,
            22,
            &["one of", "\"back\"", "did you mean \"front\"?"],
        ),
        ("views = { cameras = [1] }", 2, 22, &["a name in quotes"]),
        ("views = { cameras = ['back', 'back'] }", 2, 30, &["`back` before it takes the same"]),
        ("views = { cameras = ['side', 'left'] }", 2, 30, &["`side` before it takes the same"]),
        (
            "views = { cameras = [{ azimut = 1 }] }",
            2,
            24,
            &["unknown key", "did you mean `azimuth`?"],
        ),
        ("views = { cameras = [{ azimuth = '30' }] }", 2, 34, &["an angle", "add a unit"]),
        (
            "views = { cameras = [{ elevation = '86 deg' }] }",
            2,
            36,
            &["between -85 deg and 85 deg"],
        ),
        ("views = { cameras = {} }", 2, 21, &["a table with the `count`"]),
        ("views = { cameras = { count = 361 } }", 2, 31, &["between 1 and 360"]),
        (
            "views = { cameras = ['back'], size = [0, 9] }",
            2,
            39,
            &["`views.size` is 0", "1 and 4096"],
        ),
        ("views = { cameras = ['back'], size = [9, 4097] }", 2, 42, &["is 4097", "1 and 4096"]),
        ("views = { cameras = ['back'], size = 512 }", 2, 38, &["width and height"]),
        ("views = { cameras = ['back'], hairs = 0 }", 2, 39, &["between 1 and 1000000"]),
        ("views = { cameras = ['back'], samples = 9 }", 2, 41, &["between 1 and 8"]),
        ("views = { cameras = ['back'], outputs = ['colour'] }", 2, 42, &["one of", "\"color\"?"]),
        ("views = { cameras = ['back'], outputs = [] }", 2, 41, &["a list of color, mask"]),
        ("views = { camera = ['back'] }", 2, 11, &["did you mean `cameras`?"]),
        ("[vary", 2, 6, &["]"]),
    ];
    for (text, line, column, parts) in cases {
        let whole = format!("samples = 2\n{text}\n");
        let error = Batch::parse("batch", whole, Path::new("")).map(|b| b.heads()).unwrap_err();
        let diagnostic = error.diagnostic().unwrap_or_else(|| panic!("{text}: {error}"));
        let told = error.to_string();
        assert_eq!((diagnostic.line, diagnostic.column), (*line, *column), "{text}: {told}");
        for part in *parts {
            assert!(told.contains(part), "{text}: {part}: {told}");
        }
    }
    let grid = "hair.length = { from = 1, to = 2, steps = 100000 }\nwisps.count = { from = 1, to = 20000, steps = 20000 }";
    let many = Batch::parse("batch", format!("[grid]\n{grid}"), Path::new(""));
    assert!(many.unwrap_err().to_string().contains("more than 1000000000 heads"));
    let none = Batch::parse("batch", "[vary]\nhair.length = [1]", Path::new(""));
    assert!(none.unwrap_err().to_string().contains("`samples` is missing"));
}

#[test]
fn a_scene_can_go_elsewhere() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("scenes")).unwrap();
    std::fs::write(folder.path().join("scenes/a.toml"), "[head]\nmesh = 'b.obj'").unwrap();
    let batch =
        Batch::parse("batch", "scene = 'scenes/a.toml'\nsamples = 1", folder.path()).unwrap();
    assert!(batch.sample(0).text.unwrap().contains("mesh = 'b.obj'"));
    let text = batch.scene_elsewhere(0).unwrap();
    let scene = Scene::parse("scene", text, Path::new("/elsewhere")).unwrap();
    let frisure_scene::HeadSource::Mesh(file) = scene.head else { panic!() };
    assert_eq!(file.path, folder.path().join("scenes/b.obj"));
}

#[test]
fn what_is_wrong_in_the_scene_is_told_there() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("a.toml");
    std::fs::write(&scene, "[hair]\nlength = '5 m'").unwrap();
    let text = "scene = 'a.toml'\nsamples = 1";
    let error = Batch::parse("batch", text, folder.path()).map(|b| b.heads()).unwrap_err();
    let diagnostic = error.diagnostic().expect("a diagnostic");
    assert_eq!((diagnostic.file.as_str(), diagnostic.line), (scene.to_str().unwrap(), 2));
}
