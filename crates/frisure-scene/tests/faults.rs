//! Scenes: what is said about what is wrong.

mod common;

use common::{diagnostic, parse};
use frisure_scene::Scene;

/// Text, line, column, key, value, and parts of the sentence with its hint.
type Case = (&'static str, usize, usize, &'static str, &'static str, &'static [&'static str]);

#[test]
fn faults_name_place_value_range_and_hint() {
    let cases: &[Case] = &[
        // Keys.
        (
            "[hair]\nlenght = 1",
            2,
            1,
            "hair.lenght",
            "",
            &["unknown key `lenght`", "did you mean `length`?"],
        ),
        ("[hare]", 1, 2, "hare", "", &["did you mean `hair`?"]),
        ("length = 1", 1, 1, "length", "", &["there is a `hair.length`"]),
        (
            "[equilibrium]\ngravity = 9.81",
            2,
            1,
            "equilibrium.gravity",
            "",
            &["`gravity` is a key of the scene itself", "above the first table"],
        ),
        (
            "[hair.fibre]\nyoung = 1",
            2,
            1,
            "hair.fibre.young",
            "",
            &["known keys", "youngs_modulus"],
        ),
        (
            "[hair]\n curl.along = [{x = 1}]",
            2,
            17,
            "hair.curl.along[0].x",
            "",
            &["unknown key `x`"],
        ),
        ("[[stepp]]\nwet = {}", 1, 3, "stepp", "", &["did you mean `step`?"]),
        (
            "[wisps]\nstrands = \"simulated\"\n[groom]\nfile = \"a.hair\"",
            2,
            11,
            "wisps.strands",
            "",
            &["shapes of their own", "leave out `strands`"],
        ),
        (
            "[wisps]\ncontact = \"contacts\"",
            2,
            11,
            "wisps.contact",
            "",
            &["only simulated hairs", "strands = \"simulated\""],
        ),
        // Kinds.
        ("hair = 3", 1, 8, "hair", "3", &["it must be a table"]),
        ("[hair.curl]\nalong = 3", 2, 9, "hair.curl.along", "3", &["a list of tables"]),
        ("[[hair]]", 1, 1, "hair", "", &["it must be a table"]),
        ("[hair]\nlength = true", 2, 10, "hair.length", "true", &["a length, such as \"25 cm\""]),
        (
            "[hair]\nlength = \"25\"",
            2,
            10,
            "hair.length",
            "\"25\"",
            &["a length", "add a unit", "in m"],
        ),
        (
            "[hair]\nlength = \"25 GPa\"",
            2,
            10,
            "hair.length",
            "\"25 GPa\"",
            &["unit of a modulus", "cm"],
        ),
        ("[hair]\nlength = \"long\"", 2, 10, "hair.length", "\"long\"", &["a length, such as"]),
        ("[hair]\nlength = nan", 2, 10, "hair.length", "nan", &["a finite number"]),
        ("[hair]\nlength = inf", 2, 10, "hair.length", "inf", &["a finite number"]),
        ("[hair]\nlength = \"1e999 m\"", 2, 10, "hair.length", "\"1e999 m\"", &["a finite number"]),
        ("[wisps]\ncount = 1.5", 2, 9, "wisps.count", "1.5", &["a whole number"]),
        ("[wisps]\ncount = -1", 2, 9, "wisps.count", "-1", &["a whole number"]),
        ("seed = -1", 1, 8, "seed", "-1", &["a whole number"]),
        (
            "[hair]\ntype = \"nordic\"",
            2,
            8,
            "hair.type",
            "\"nordic\"",
            &["one of", "\"caucasian-curly\""],
        ),
        ("[hair]\ntype = \"frizy\"", 2, 8, "hair.type", "\"frizy\"", &["did you mean \"frizzy\"?"]),
        ("[look]\nskin = \"#12345g\"", 2, 8, "look.skin", "\"#12345g\"", &["a colour"]),
        ("[look]\nbackground = \"wal\"", 2, 14, "look.background", "\"wal\"", &["\"wall\""]),
        ("[camera]\nf_number = 0.1", 2, 12, "camera.f_number", "0.1", &["0.5 and 64"]),
        ("[output]\ntone = \"film\"", 2, 8, "output.tone", "\"film\"", &["\"filmic\""]),
        ("[output]\nexposure = 30", 2, 12, "output.exposure", "30", &["-20 and 20"]),
        ("[look]\nskin = [0, 0, 2]", 2, 8, "look.skin", "[0, 0, 2]", &["from 0 to 1"]),
        ("[hair]\nroot.t = [0, 1]", 2, 10, "hair.root.t", "[0, 1]", &["three finite numbers"]),
        // Ranges.
        ("[hair]\nlength = 0", 2, 10, "hair.length", "0", &["between 1 mm and 3 m"]),
        ("[hair]\nlength = \"5 km\"", 2, 10, "hair.length", "\"5 km\"", &["cm"]),
        ("[hair]\nlength = \"5 m\"", 2, 10, "hair.length", "\"5 m\"", &["between 1 mm and 3 m"]),
        ("[hair.fibre]\ndiameter = 0", 2, 12, "hair.fibre.diameter", "0", &["greater than zero"]),
        (
            "[hair.fibre]\nmean_radius = -1",
            2,
            15,
            "hair.fibre.mean_radius",
            "-1",
            &["greater than zero"],
        ),
        ("[hair.fibre]\neccentricity = 1", 2, 16, "hair.fibre.eccentricity", "1", &["less than 1"]),
        ("[hair.fibre]\naxis_ratio = 0.5", 2, 14, "hair.fibre.axis_ratio", "0.5", &["at least 1"]),
        (
            "[hair.fibre]\npoisson_ratio = 0.6",
            2,
            17,
            "hair.fibre.poisson_ratio",
            "0.6",
            &["at most 0.5"],
        ),
        (
            "[hair.fibre]\nyoungs_modulus = \"0 GPa\"",
            2,
            18,
            "hair.fibre.youngs_modulus",
            "\"0 GPa\"",
            &["greater"],
        ),
        ("[hair.curl]\nradius = 0", 2, 10, "hair.curl.radius", "0", &["greater than zero"]),
        ("[hair.curl]\nkappa1 = 5e4", 2, 10, "hair.curl.kappa1", "5e4", &["at most 20000 rad/m"]),
        ("[hair.curl]\ntau = -1e300", 2, 7, "hair.curl.tau", "-1e300", &["-1e5 and 1e5 rad/m"]),
        (
            "[hair.curl]\nradius = 1e-200\npitch = 0",
            2,
            10,
            "hair.curl.radius",
            "1e-200",
            &["at least 10 um"],
        ),
        (
            "[[hair.curl.along]]\ns = 0\nkappa2 = 1e6",
            3,
            10,
            "hair.curl.along[0].kappa2",
            "1e6",
            &["-1e5 and 1e5 rad/m"],
        ),
        (
            "[[hair.curl.along]]\ns = -1e300",
            2,
            5,
            "hair.curl.along[0].s",
            "-1e300",
            &["between -100 and 100 m"],
        ),
        ("hair.curl.along = []", 1, 19, "hair.curl.along", "[]", &["at least one table"]),
        ("pose.down = [0, 0, 0]", 1, 13, "pose.down", "[0, 0, 0]", &["that is not zero"]),
        ("gravity = [0, 9.81]", 1, 11, "gravity", "[0, 9.81]", &["or three, such as"]),
        ("gravity = [0, 0, '9 kg']", 1, 11, "gravity", "[0, 0, '9 kg']", &["or three, such as"]),
        ("[wisps]\ncount = 0", 2, 9, "wisps.count", "0", &["between 1 and 20000"]),
        (
            "[wisps]\nhairs = 10_000_000",
            2,
            9,
            "wisps.hairs",
            "10_000_000",
            &["between 1 and 1000000"],
        ),
        (
            "[equilibrium]\nelements = 10_000_000",
            2,
            12,
            "equilibrium.elements",
            "10_000_000",
            &["between 1 and 10000"],
        ),
        (
            "[equilibrium]\nelements = 0",
            2,
            12,
            "equilibrium.elements",
            "0",
            &["between 1 and 10000"],
        ),
        ("[equilibrium]\naccuracy = 0", 2, 12, "equilibrium.accuracy", "0", &["greater than zero"]),
        (
            "[equilibrium]\nstarts = 3",
            2,
            10,
            "equilibrium.starts",
            "",
            &["add `branch = \"lowest\"`"],
        ),
        ("gravity = -1", 1, 11, "gravity", "-1", &["between 0 and 1000"]),
        (
            "[implantation]\nlift = \"100 deg\"",
            2,
            8,
            "implantation.lift",
            "\"100 deg\"",
            &["90 deg"],
        ),
        (
            "[camera]\nelevation = \"90 deg\"",
            2,
            13,
            "camera.elevation",
            "\"90 deg\"",
            &["-85 and 85 deg"],
        ),
        ("[output]\nwidth = 0", 2, 9, "output.width", "0", &["between 1 and 16384"]),
        ("[head]\nmesh = \"a\"\nscale = 0", 3, 9, "head.scale", "0", &["greater than zero"]),
        (
            "[hair.root]\nt = [0, 0, 2]\nd1 = [1, 0, 0]",
            1,
            1,
            "hair.root",
            "",
            &["right-handed orthonormal"],
        ),
        (
            "[wisps]\nhairs = 1_000_000\npoints = 1000",
            3,
            10,
            "wisps.points",
            "1000",
            &["at most 200000000 points"],
        ),
        (
            "[hair.fibre]\ndiameter = \"5 um\"\nyoungs_modulus = \"1 MPa\"\n[hair]\nlength = \"3 m\"",
            1,
            1,
            "hair.fibre",
            "",
            &["too limp", "check the units"],
        ),
        (
            "[wisps]\nhairs_per_wisp = 50_000",
            2,
            18,
            "wisps.hairs_per_wisp",
            "50_000",
            &["so few that a head has at most 1000000 hairs"],
        ),
        (
            "[wisps]\ndensity = \"0 1/cm^2\"",
            2,
            11,
            "wisps.density",
            "\"0 1/cm^2\"",
            &["between 1 and 1000 1/cm^2"],
        ),
        (
            "[wisps]\ndensity = \"190 cm\"",
            2,
            11,
            "wisps.density",
            "\"190 cm\"",
            &["a number per area", "`cm` is a unit of a length"],
        ),
        (
            "[look]\ncolour = \"blonde\"",
            2,
            10,
            "look.colour",
            "\"blonde\"",
            &["one of \"white\", ", "did you mean \"blond\"?"],
        ),
        (
            "[look]\ncolour = \"red\"\nreflectance = \"#aa3300\"",
            3,
            15,
            "look.reflectance",
            "\"#aa3300\"",
            &["`look.colour` says on line 2"],
        ),
        (
            "[look]\nabsorption = [1, -1, 0]",
            2,
            14,
            "look.absorption",
            "[1, -1, 0]",
            &["0 and 1000"],
        ),
        (
            "hair.fibre.variation = 0.6",
            1,
            24,
            "hair.fibre.variation",
            "0.6",
            &["between 0 and 0.5"],
        ),
        (
            "hair.ellipticity = \"round\"",
            1,
            20,
            "hair.ellipticity",
            "\"round\"",
            &["one of \"measured\", \"paper\""],
        ),
        // Contradictions.
        (
            "[wisps]\nhairs = 1000\ndensity = \"190 1/cm^2\"",
            3,
            11,
            "wisps.density",
            "\"190 1/cm^2\"",
            &["`wisps.hairs` says on line 2", "keep one of the two"],
        ),
        (
            "[wisps]\nhairs = 1000\nhairs_per_wisp = 10",
            3,
            18,
            "wisps.hairs_per_wisp",
            "10",
            &["`wisps.hairs` says on line 2"],
        ),
        (
            "[hair]\nellipticity = \"paper\"\nfibre.axis_ratio = 1.5",
            3,
            20,
            "hair.fibre.axis_ratio",
            "1.5",
            &["`hair.ellipticity` says on line 2"],
        ),
        (
            "[hair.fibre]\ndiameter = 1e-4\n\nmean_radius = 1e-4",
            4,
            15,
            "hair.fibre.mean_radius",
            "1e-4",
            &["`hair.fibre.diameter` says on line 2", "keep one of the two"],
        ),
        (
            "[hair.curl]\nradius = 1\ntau = 2",
            3,
            7,
            "hair.curl.tau",
            "2",
            &["`hair.curl.radius` says on line 2"],
        ),
        (
            "[hair.fibre]\nshear_modulus = 1\npoisson_ratio = 0",
            3,
            17,
            "hair.fibre.poisson_ratio",
            "0",
            &["on line 2"],
        ),
        (
            "[hair.fibre]\nsemi_axis_a = 1\nsemi_axis_b = 1\ndiameter = 1",
            4,
            12,
            "hair.fibre.diameter",
            "1",
            &["line 2"],
        ),
        (
            "[implantation]\nlift = 1\nlift_scale = 1",
            3,
            14,
            "implantation.lift_scale",
            "1",
            &["line 2"],
        ),
        (
            "[equilibrium]\nelements = 9\naccuracy = 1",
            3,
            12,
            "equilibrium.accuracy",
            "1",
            &["line 2"],
        ),
        ("[head]\nmesh = \"a\"\nunit = \"m\"\nscale = 1", 4, 9, "head.scale", "1", &["line 3"]),
        (
            "[hair.fibre]\nsemi_axis_a = 1",
            2,
            15,
            "hair.fibre.semi_axis_a",
            "",
            &["needs `semi_axis_b`"],
        ),
        ("[hair.root]\nt = [1, 0, 0]", 2, 5, "hair.root.t", "", &["needs `d1`"]),
        ("pose.down = [0, 0, 0]", 1, 13, "pose.down", "[0, 0, 0]", &["not zero"]),
        (
            "[pose]\npitch = \"200 deg\"",
            2,
            9,
            "pose.pitch",
            "\"200 deg\"",
            &["between -180 and 180 deg"],
        ),
        (
            "[pose]\ndown = [0, 1, 0]\nroll = 0.1",
            3,
            8,
            "pose.roll",
            "0.1",
            &["says again", "line 2"],
        ),
        (
            "gravity = [0, 0, -9.81]\n[pose]\nroll = 0.1",
            3,
            8,
            "pose.roll",
            "0.1",
            &["says again", "line 1"],
        ),
        (
            "[wind]\nspeed = \"300 km/h\"",
            2,
            9,
            "wind.speed",
            "\"300 km/h\"",
            &["between 0 and 60 m/s"],
        ),
        (
            "[head]\nmesh = \"a.obj\"\nturn = [400, 0, 0]",
            3,
            8,
            "head.turn",
            "[400, 0, 0]",
            &["-360 and 360"],
        ),
        ("[head]\nup = \"z\"", 2, 6, "head.up", "", &["the scene has none", "add `mesh"]),
        (
            "[implantation]\nflow = \"whorl\"\nparting = 0.01",
            3,
            11,
            "implantation.parting",
            "",
            &["only parted hair"],
        ),
        (
            "seed = 99999999999999999999",
            1,
            8,
            "seed",
            "99999999999999999999",
            &["within 2^63 of 0"],
        ),
        // Not TOML.
        ("[hair", 1, 6, "", "", &[]),
        ("a = 1\na = 2", 2, 1, "", "", &["duplicate key"]),
        ("\n\n  x", 3, 4, "", "", &[]),
        ("name = \"a\u{0}\"", 1, 10, "", "", &[]),
    ];
    for &(text, line, column, key, value, parts) in cases {
        let diagnostic = diagnostic(text);
        let whole = diagnostic.to_string();
        let facts = (diagnostic.line, diagnostic.column, diagnostic.key.as_str());
        assert_eq!(facts, (line, column, key), "{whole}\n{text}");
        assert!(value.is_empty() || diagnostic.value == value, "{value}: {diagnostic:?}");
        for part in parts {
            assert!(whole.contains(part), "{part}: {whole}");
        }
        assert!(whole.starts_with(&format!("scene.toml:{line}:{column}: ")), "{whole}");
        assert!(diagnostic.span.end <= text.len());
    }
}

#[test]
fn a_bare_number_out_of_range_is_told_its_unit() {
    for (text, meant) in [
        ("hair.length = 25", "a number without quotes is in m; did you mean \"25 cm\"?"),
        ("implantation.lift = 45", "a number without quotes is in rad; did you mean \"45 deg\"?"),
        ("camera.elevation = -30", "a number without quotes is in rad; did you mean \"-30 deg\"?"),
        (
            "hair.growth_rate = 1.2",
            "a number without quotes is in m/s; did you mean \"1.2 cm/month\"?",
        ),
        ("wisps.flyaways = 5", "did you mean \"5 %\"?"),
        // Wind is not as slow as hair grows.
        ("wind.speed = 200", "a number without quotes is in m/s; did you mean \"200 km/h\"?"),
        ("wind.speed = -1", "a number without quotes is in m/s; write a unit, as in \"5 m/s\""),
        // Neither is a unit.
        ("hair.length = '25 m'", ""),
        ("wisps.count = 0", ""),
    ] {
        assert_eq!(diagnostic(text).hint, meant, "{text}");
    }
}

#[test]
fn a_key_of_another_table_is_told_where_it_belongs() {
    for (text, place) in [
        ("lenght = '20 cm'", "did you mean `hair.length`?"),
        ("length = '20 cm'", "there is a `hair.length`"),
        ("[head]\nflayaways = 0.1", "did you mean `wisps.flyaways`?"),
        ("ligth = {}", "did you mean `light`?"),
        ("[[step]]\ntie.at = 'nape'", "known keys: braided, to, where"),
    ] {
        assert_eq!(diagnostic(text).hint, place, "{text}");
    }
}

#[test]
fn one_hair_has_ranges_of_its_own() {
    for (text, key, allowed) in [
        ("hair.length = 5e-324", "hair.length", "between 1 um and 100 m"),
        ("hair.length = 1e300", "hair.length", "between 1 um and 100 m"),
        ("equilibrium.tolerance = 0", "equilibrium.tolerance", "between 1e-8 and 0.1"),
        ("gravity = -1", "gravity", "between 0 and 1000 m/s²"),
        ("gravity = 1e6", "gravity", "between 0 and 1000 m/s²"),
        ("gravity = [0, 1e200, -1e200]", "gravity", "between 0 and 1000 m/s²"),
        ("wind.speed = 100", "wind.speed", "between 0 and 60 m/s"),
        ("pose.pitch = 4", "pose.pitch", "between -180 and 180 deg"),
    ] {
        let error = parse(text).unwrap().single_hair().unwrap_err();
        let found = error.diagnostic().unwrap();
        assert_eq!((found.key.as_str(), found.allowed.as_str()), (key, allowed), "{text}");
    }
    // What no head has, and one hair may.
    let stiff = "gravity = 0\nhair.length = \"10 m\"\nhair.fibre.diameter = \"2 mm\"";
    assert!(parse(stiff).unwrap().single_hair().is_ok());
}

#[test]
fn the_length_of_the_direction_of_gravity_means_nothing() {
    let down = |length: f64| {
        let text = format!("pose.down = [{length:e}, {length:e}, 0]");
        parse(&text).unwrap().hairstyle_spec().unwrap().pose
    };
    for length in [1e300, 1e-300, 5e-324] {
        assert_eq!(down(length), down(1.0), "{length}");
    }
}

#[test]
fn more_steps_than_a_day_in_the_salon_has_are_refused() {
    let steps = |count: usize| "[[step]]\nwet = {}\n".repeat(count);
    let told = diagnostic(&steps(10_001)).to_string();
    assert!(told.contains("there are 10001 steps; 10000 are possible"), "{told}");
    assert!(parse(&steps(10_000)).is_ok());
}

/// The text of a scene with a list of so many items, the most of them, and what they are called.
type ListCase<'a> = (&'a dyn Fn(usize) -> String, usize, &'static str);

/// A list of so many tables.
fn tables(list: &'static str, item: &'static str) -> impl Fn(usize) -> String {
    move |count| format!("[[{list}]]\n{item}\n").repeat(count)
}

/// A step on a choice with so many items.
fn choice(start: &'static str, item: &'static str, end: &'static str) -> impl Fn(usize) -> String {
    move |count| format!("[[step]]\nwet.where = {start}{}{end}", item.repeat(count))
}

#[test]
fn lists_longer_than_a_person_writes_are_refused_at_once() {
    let knots = |count: usize| {
        let knots: Vec<String> =
            (0..count).map(|s| format!("{{s = {}}}", 1e-4 * s as f64)).collect();
        format!("hair.curl.along = [{}]", knots.join(", "))
    };
    let cases: [ListCase<'_>; 12] = [
        (&tables("implantation.partings", "at = 'middle'"), 32, "partings"),
        (&tables("region", "where = 'top'"), 1000, "regions"),
        (&tables("light.lamp", "azimuth = 0\nelevation = 0"), 100, "lamps"),
        (&knots, 10_000, "knots"),
        (&|count| format!("[[region]]\nwhere = [{}]", "'top',".repeat(count)), 100, "parts"),
        (&choice("[", "'top',", "]"), 1000, "choices of wisps in all"),
        (&choice("{any=[", "'top',", "]}"), 999, "choices of wisps in all"),
        (&choice("{all=[", "{not='top'},", "]}"), 499, "choices of wisps in all"),
        (&choice("{wisps=[", "1,", "]}"), 100_000, "wisps"),
        (&choice("{brush={radius=0.01,at=[", "[0,0],", "]}}"), 10_000, "places"),
        (
            &choice(
                "{lasso={camera={eye=[0,-1,0],target=[0,0,0],field_of_view=1,aspect=1},polygon=[",
                "[0,0],",
                "]}}",
            ),
            10_000,
            "corners",
        ),
        (
            &|count| {
                let section = |i| format!("[[section]]\nname = '{i}'\nwhere = 'top'\n");
                (0..count).map(section).collect()
            },
            200,
            "sections",
        ),
    ];
    for (text, most, what) in cases {
        let told = diagnostic(&text(most + 1)).to_string();
        assert!(told.contains(what) && told.contains("there are at most"), "{told}");
        assert!(told.contains(" ("), "no hint: {told}");
        parse(&text(most)).unwrap_or_else(|e| panic!("{most} {what}: {e}"));
    }
}

#[test]
fn straight_hair_in_few_elements_is_not_called_a_tight_curl() {
    let told = diagnostic("hair.type = \"straight\"\nequilibrium.elements = 1").to_string();
    assert!(told.contains("`equilibrium.elements` is 1") && !told.contains("tight"), "{told}");
}

#[test]
fn columns_count_characters() {
    let diagnostic = diagnostic("name = \"é\"\n[hair]\ntype = \"é\" # é");
    assert_eq!((diagnostic.line, diagnostic.column, diagnostic.value.as_str()), (3, 8, "\"é\""));
}

#[test]
fn files_that_are_no_scenes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.toml");
    let message = |bytes: Option<&[u8]>| {
        if let Some(bytes) = bytes {
            std::fs::write(&path, bytes).unwrap();
        }
        Scene::read(&path).unwrap_err().to_string().replace(path.to_str().unwrap(), "P")
    };
    assert_eq!(message(None), "there is no file `P`");
    assert_eq!(message(Some(b"seed = 1\n# \xff")), "`P` is not UTF-8 text (byte 3 of line 2)");
    assert_eq!(
        message(Some(&vec![b'#'; (16 << 20) + 1])),
        "`P` is larger than 16777216 bytes, too large for a scene"
    );
    let error = Scene::read(folder.path()).unwrap_err().to_string();
    assert!(error.ends_with("is a directory, not a file"), "{error}");
}

#[test]
fn faults_of_sections_name_their_place() {
    let first = "[[section]]\nname = \"top\"\nwhere = \"top\"\n";
    for (text, line, words) in [
        ("where = \"top\"", 4, "has no name"),
        ("name = \"a\"", 4, "is nowhere"),
        ("name = \" \"\nwhere = \"top\"", 5, "1 to 60 letters"),
        ("name = \"top\"\nwhere = \"nape\"", 5, "`section[0]` has the same name"),
        ("name = \"a\"\nwhere = \"tpo\"", 6, "did you mean \"top\"?"),
        ("name = \"a\"\nwhere = \"top\"\nlocked = 1", 7, "true or false"),
    ] {
        let f = diagnostic(&format!("{first}[[section]]\n{text}"));
        assert_eq!(f.line, line, "{f}");
        assert!(f.to_string().contains(words), "{f}");
    }
    let many: String =
        (0..201).map(|i| first.replace("\"top\"\nw", &format!("\"{i}\"\nw"))).collect();
    assert!(diagnostic(&many).to_string().contains("at most 200"));
}

#[test]
fn sections_are_read_in_their_order() {
    let text = "[[section]]\nname = \"left\"\nwhere = \"left\"\nlocked = true\n\
                [[section]]\nname = \"some\"\nwhere = { wisps = [0, 3] }\nhidden = true\n";
    let scene = Scene::parse("scene", text, std::path::Path::new("")).expect("a scene");
    let [left, some] = &scene.sections[..] else { panic!("{:?}", scene.sections) };
    assert_eq!((left.name.as_str(), left.hidden, left.locked), ("left", false, true));
    assert_eq!((some.name.as_str(), some.hidden, some.locked), ("some", true, false));
    for section in [left, some] {
        let written = frisure_scene::write_selection(&section.selection).expect("a choice");
        assert!(text.contains(&format!("where = {written}")), "{written}");
    }
}

#[test]
fn faults_of_partings_and_regions_name_their_place() {
    let parting = "[[implantation.partings]]\n";
    let cases = [
        ("line = [[\"1 cm\", 0]]", "implantation.partings[0].line", "2 to 100 points"),
        ("line = [[0, 0], [0, 0.1], [0.03, 0.05], [-0.03, 0.04]]", "", "piece 1 crosses piece 3"),
        ("line = [[0, 0], [0, 9]]", "implantation.partings[0].line", "[0, 9] m"),
        ("line = [[0, 0], [0]]", "implantation.partings[0].line", "a list of places"),
        ("at = \"midle\"", "implantation.partings[0].at", "did you mean \"middle\"?"),
        ("at = \"9 cm\"", "implantation.partings[0].at", "within 6 cm"),
    ];
    for (text, key, words) in cases {
        let f = diagnostic(&format!("{parting}{text}"));
        assert_eq!((f.line, f.key.contains(key)), (2, true), "{f}");
        assert!(f.to_string().contains(words), "{f}");
    }
    assert!(diagnostic(parting).to_string().contains("`at` or `line`"));
    for (text, line, words) in [
        ("where = \"frige\"", 2, "did you mean \"fringe\"?"),
        ("where = [\"top\", \"knape\"]", 2, "did you mean \"nape\"?"),
        ("where = []", 2, "one place or more"),
        ("comb = \"back\"", 1, "is nowhere"),
        ("where = \"top\"\nlength = 0", 3, "1 mm and 3 m"),
        ("where = \"top\"\nlift = \"91 deg\"", 3, "90 deg"),
        ("where = \"top\"\nlength = 1\ndown_to = \"ears\"", 4, "says again"),
    ] {
        let f = diagnostic(&format!("[[region]]\n{text}"));
        assert_eq!(f.line, line, "{f}");
        assert!(f.to_string().contains(words), "{f}");
    }
}

#[test]
fn lists_that_no_scene_has_are_refused_before_their_items_are_built() {
    for list in ["[light]\nlamp = [", "[hair]\ncurl.along = [", "[wrong]\nlist = ["] {
        let f = diagnostic(&format!("{list}{}]", "{},".repeat(600_000)));
        assert_eq!(f.line, 2, "{f}");
        assert!(f.to_string().contains("more than 500000 commas"), "{f}");
    }
}

#[test]
fn a_list_without_items_is_no_value() {
    for (text, key) in [
        ("[head]\nturn = []", "head.turn"),
        ("[head]\nscalp_mask = []", "head.scalp_mask"),
        ("[groom]\nup = []", "groom.up"),
    ] {
        let f = diagnostic(text);
        assert_eq!((f.line, f.key.as_str()), (2, key), "{f}");
    }
}
