//! Scenes: what can be said, what it means, and what is said about what is wrong.

use std::path::Path;

use frisure_hairstyle::{Body, Ellipticity, Flow, Hairs, Handedness, Lift, PRESETS};
use frisure_io::frame::{FrameChoice, UpAxis};
use frisure_io::scene::{
    Behind, Dye, Fade, Fault, HeadSource, NaturalColour, ScalpSource, Scene, SceneError, schema,
    template,
};
use frisure_optics::{Melanin, SHADES};
use frisure_rod::{Branch, ElementKind, NaturalStrain, Resolution, TorsionConstant};
use glam::DVec3;
use serde_json::Value;

fn parse(text: &str) -> Result<Scene, SceneError> {
    Scene::parse("scene.toml", text, Path::new("scenes"))
}

fn good(text: &str) -> Scene {
    parse(text).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// What is wrong with a scene, for a whole head or for one hair.
fn fault(text: &str) -> Fault {
    let error = match parse(text) {
        Err(error) => error,
        Ok(scene) => match (scene.hairstyle_spec(), scene.single_hair()) {
            (Err(error), _) | (_, Err(error)) => error,
            _ => panic!("this should be refused:\n{text}"),
        },
    };
    error.fault().unwrap_or_else(|| panic!("{error}")).clone()
}

#[test]
fn an_empty_file_is_a_scene() {
    for text in ["", "\u{feff}", "# nothing\n", "[hair]\n[wisps]\n"] {
        let scene = good(text);
        assert_eq!(scene.hair_type, "caucasian-straight");
        assert_eq!(scene.head, HeadSource::Mannequin);
        assert!(scene.hairstyle_spec().is_ok() && scene.single_hair().is_ok());
    }
}

#[test]
fn a_type_gives_its_preset_unchanged() {
    for preset in PRESETS {
        let scene = good(&format!("[hair]\ntype = \"{}\"", preset.name));
        assert_eq!(scene.hairstyle_spec().unwrap(), preset.spec());
    }
}

#[test]
fn every_template_is_its_preset_and_so_it_is_uncommented() {
    for preset in PRESETS {
        let text = template(preset);
        assert_eq!(good(&text).hairstyle_spec().unwrap(), preset.spec(), "{text}");
        // With the numbers in its comments, which are rounded.
        let loud = text.replace("\n# ", "\n").replacen("A scene for", "# A scene for", 1);
        let loud = loud.replacen("Quantities are", "# Quantities are", 1);
        let spec = good(&loud).hairstyle_spec().unwrap();
        let near = |a: f64, b: f64| (a / b - 1.0).abs() < 0.05;
        assert!(near(spec.length.mean, preset.spec().length.mean));
        assert!(near(spec.curl.strain.length(), preset.spec().curl.strain.length()), "{loud}");
        assert_eq!(spec.wisps.count, preset.spec().wisps.count);
    }
}

#[test]
fn every_key_arrives() {
    let scene = good(
        r##"
        name = "All"
        seed = 9223372036854775807
        gravity = "1.62 m/s^2"
        [hair]
        type = "frizzy"
        length = "25 cm"
        length_variation = "10 %"
        fibre = { diameter = "80 um", axis_ratio = 1.5, youngs_modulus = "4 GPa", poisson_ratio = 0.25, density = "1.2 g/cm^3", torsion = "polar", variation = 0.07, axis_ratio_variation = 0.08 }
        curl = { kappa1 = "1 1/mm", tau = 20, handedness = "as-given", variation_between = 0.1, variation_along = 0.2, variation_scale = "4 cm" }
        root = { d1 = [0, 1, 0], t = [0, 0, 1] }
        [head]
        mesh = "a/head.obj"
        up = "z"
        unit = "cm"
        scalp_mask = "mask.png"
        [implantation]
        flow = "parted"
        parting = "-1 cm"
        lift = "45 deg"
        jitter = "5 deg"
        [wisps]
        count = 11
        hairs_per_wisp = 12
        clumping = 0.13
        fuzziness = 0.14
        length_variation = 0.15
        flyaways = 0.16
        blending = 0.17
        points = 18
        [contact]
        body = "spheres"
        stiffness = "0.2 kPa"
        volume = 0.3
        [equilibrium]
        elements = 21
        element = "helix"
        branch = "lowest"
        starts = 22
        [look]
        eumelanin = 0.3
        pheomelanin = 0.4
        variation = 0.5
        white_share = 0.25
        roots = { pigment = 1.5, fade = "3 cm" }
        tips.pigment = 0.6
        dye = { colour = "#0000ff", strength = 0.8, regrowth = "4 cm" }
        roughness = 0.25
        roughness_around = 0.35
        tilt = "2 deg"
        index = 1.5
        skin = "#ff8000"
        background = [0, 0.5, 1]
        [camera]
        azimuth = "90 deg"
        elevation = "-10 deg"
        field_of_view = "30 deg"
        [light]
        azimuth = "10 deg"
        strength = 2
        [output]
        width = 31
        height = 32
        samples = 3
        "##,
    );
    let spec = scene.hairstyle_spec().unwrap();
    assert_eq!((scene.name.as_str(), spec.seed), ("All", u64::MAX >> 1));
    assert_eq!((spec.gravity, spec.length.mean, spec.length.variation_between), (1.62, 0.25, 0.1));
    assert!((spec.fibre.section.mean_radius() - 40e-6).abs() < 1e-18);
    assert!((spec.fibre.section.axis_ratio() - 1.5).abs() < 1e-12);
    assert_eq!(spec.fibre.material.youngs_modulus(), 4e9);
    assert_eq!(spec.fibre.material.shear_modulus(), 1.6e9);
    assert_eq!(spec.fibre.material.density(), 1200.0);
    assert_eq!(spec.fibre.torsion, TorsionConstant::Polar);
    assert_eq!(spec.curl.strain, DVec3::new(1000.0, 0.0, 20.0));
    assert_eq!(spec.curl.handedness, Handedness::AsGiven);
    assert_eq!((spec.curl.variation_between, spec.curl.variation_along), (0.1, 0.2));
    assert_eq!(spec.curl.variation_scale, 0.04);
    assert_eq!(spec.implantation.flow, Flow::Parted { offset: -0.01 });
    assert_eq!(spec.implantation.lift, Lift::Uniform(45_f64.to_radians()));
    assert!((spec.implantation.jitter - 5_f64.to_radians()).abs() < 1e-15);
    let w = spec.wisps;
    assert_eq!((w.count, w.hairs, w.points), (11, Hairs::PerWisp(12), 18));
    assert_eq!((spec.fibre.variation, spec.fibre.axis_ratio_variation), (0.07, 0.08));
    assert_eq!((w.clumping, w.fuzziness, w.length_variation), (0.13, 0.14, 0.15));
    assert_eq!((w.flyaways, w.blending), (0.16, 0.17));
    assert_eq!(spec.contact.body, Body::Spheres);
    assert_eq!((spec.contact.stiffness, spec.contact.volume), (200.0, 0.3));
    assert_eq!(spec.equilibrium.resolution, Resolution::Elements(21));
    assert_eq!(spec.equilibrium.element, ElementKind::Helix);

    let hair = scene.single_hair().unwrap();
    assert_eq!(hair.options.branch, Branch::Lowest { starts: 22, seed: u64::MAX >> 1 });
    assert_eq!(hair.rod.root().frame().z_axis, DVec3::Z);
    assert_eq!(hair.rod.root().frame().x_axis, DVec3::Y);
    assert_eq!(*hair.rod.natural(), NaturalStrain::Uniform(spec.curl.strain));

    let HeadSource::Mesh(head) = &scene.head else { panic!("a mesh was given") };
    assert_eq!(head.path, Path::new("scenes/a/head.obj"));
    assert_eq!(head.frame, FrameChoice { metres: Some(0.01), up: Some(UpAxis::Z) });
    assert_eq!(head.scalp, ScalpSource::Mask("scenes/mask.png".into()));
    assert_eq!(scene.look.skin, Some([1.0, 128.0 / 255.0, 0.0]));
    assert_eq!(scene.look.background, Behind::Colour([0.0, 0.5, 1.0]));
    let look = scene.look;
    let pigments = NaturalColour::Pigments { eumelanin: 0.3, pheomelanin: 0.4 };
    assert_eq!((look.natural, look.variation, look.white_share), (pigments, Some(0.5), 0.25));
    assert_eq!(look.roots, Some(Fade { pigment: 1.5, length: 0.03 }));
    assert_eq!(look.tips, Some(Fade { pigment: 0.6, length: 0.05 }));
    assert_eq!(look.dye, Some(Dye { colour: [0.0, 0.0, 1.0], strength: 0.8, regrowth: 0.04 }));
    assert_eq!((look.roughness, look.roughness_around), (Some(0.25), Some(0.35)));
    assert!((look.tilt.unwrap().to_degrees() - 2.0).abs() < 1e-12);
    assert_eq!((look.index, look.seed), (Some(1.5), spec.seed));
    assert!((scene.camera.azimuth.to_degrees() - 90.0).abs() < 1e-12);
    assert!((scene.light.direction.unwrap().0.to_degrees() - 10.0).abs() < 1e-12);
    assert_eq!((scene.output.width, scene.output.height, scene.output.samples), (31, 32, 3));
}

#[test]
fn a_colour_of_hair_is_said_by_name_by_pigments_or_as_measured() {
    let of = |keys: &str| good(&format!("[look]\n{keys}")).look;
    let pigments = |eumelanin: f32, pheomelanin: f32| NaturalColour::Pigments {
        eumelanin: f64::from(eumelanin),
        pheomelanin: f64::from(pheomelanin),
    };
    for shade in &SHADES {
        let look = of(&format!("colour = \"{}\"", shade.name));
        let Melanin { eumelanin, pheomelanin } = shade.melanin;
        assert_eq!(look.natural, pigments(eumelanin, pheomelanin));
        assert_eq!(look.white_share, f64::from(shade.white_share));
    }
    assert_eq!(of("").natural, of("colour = \"brown\"").natural);
    let NaturalColour::Pigments { eumelanin, .. } =
        of("colour = \"auburn\"\neumelanin = 0.5").natural
    else {
        panic!("pigments were given")
    };
    assert_eq!(eumelanin, 0.5);
    assert_eq!(
        of("reflectance = \"#ff0000\"").natural,
        NaturalColour::Reflectance([1.0, 0.0, 0.0])
    );
    assert_eq!(
        of("absorption = [0.1, 0.2, 3]").natural,
        NaturalColour::Absorption([0.1, 0.2, 3.0])
    );
}

#[test]
fn the_number_of_hairs_is_said_in_one_of_three_ways() {
    let hairs = |keys: &str| good(keys).hairstyle_spec().unwrap().wisps.hairs;
    assert_eq!(hairs("hair.type = \"african-coily\""), Hairs::Density(161e4));
    assert_eq!(hairs("wisps.density = \"190 1/cm^2\""), Hairs::Density(190e4));
    assert_eq!(hairs("wisps.hairs = 5000"), Hairs::Count(5000));
    assert_eq!(hairs("wisps.hairs_per_wisp = 50"), Hairs::PerWisp(50));
}

#[test]
fn the_paper_s_section_is_nearly_round_and_the_measured_one_is_the_default() {
    let fibre = |more: &str| {
        let text = format!("hair.type = \"african-coily\"\n{more}");
        good(&text).hairstyle_spec().unwrap().fibre
    };
    assert_eq!(fibre(""), fibre("hair.ellipticity = \"measured\""));
    assert!((fibre("").section.axis_ratio() - 1.75).abs() < 1e-12);
    let paper = fibre("hair.ellipticity = \"paper\"");
    assert!((paper.section.eccentricity() - 0.2).abs() < 1e-12);
    assert_eq!(paper.axis_ratio_variation, 0.0);
    let preset = PRESETS.iter().find(|p| p.name == "african-coily").unwrap();
    assert_eq!(paper, preset.hair_type().fibre(Ellipticity::Paper).unwrap());
    // A diameter of one's own goes with either shape.
    let thick = fibre("hair.ellipticity = \"paper\"\nhair.fibre.diameter = \"90 um\"");
    assert!((thick.section.eccentricity() - 0.2).abs() < 1e-7);
    assert!((thick.section.mean_radius() - 45e-6).abs() < 1e-15);
}

#[test]
fn part_of_a_curl_or_section_keeps_the_rest_of_the_type() {
    let base = "[hair]\ntype = \"caucasian-curly\"\n";
    let preset = good(base).hairstyle_spec().unwrap();
    let (_, pitch) = preset.curl.radius_pitch().unwrap();
    let spec = good(&format!("{base}curl.radius = \"2 cm\"")).hairstyle_spec().unwrap();
    let (r, p) = spec.curl.radius_pitch().unwrap();
    assert!((r - 0.02).abs() < 1e-12 && (p - pitch).abs() < 1e-12);
    let spec = good(&format!("{base}fibre.diameter = \"90 um\"")).hairstyle_spec().unwrap();
    assert!((spec.fibre.section.mean_radius() - 45e-6).abs() < 1e-15);
    assert!((spec.fibre.section.axis_ratio() - 1.5).abs() < 1e-12);
    let spec = good(&format!("{base}fibre.eccentricity = 0.5")).hairstyle_spec().unwrap();
    assert!((spec.fibre.section.mean_radius() - 36e-6).abs() < 1e-15);
    assert!((spec.fibre.section.eccentricity() - 0.5).abs() < 1e-12);
    // Strains are not mixed with the type's: the missing ones are 0.
    let spec = good(&format!("{base}curl.tau = 5")).hairstyle_spec().unwrap();
    assert_eq!(spec.curl.strain, DVec3::new(0.0, 0.0, 5.0));
}

#[test]
fn strains_along_one_hair() {
    let text = r#"
        [[hair.curl.along]]
        kappa1 = 10
        [[hair.curl.along]]
        s = "10 cm"
        kappa1 = "30 1/m"
    "#;
    let scene = good(text);
    let hair = scene.single_hair().unwrap();
    assert!((hair.rod.natural().at(0.05).x - 20.0).abs() < 1e-12);
    let refused = fault(text);
    assert_eq!(refused.key, "hair.curl.along");
    assert!(refused.problem.contains("one hair"), "{refused}");
    let back = fault("hair.curl.along = [{ s = 0.1 }, { s = 0.05, kappa1 = 3 }]");
    assert_eq!((back.key.as_str(), back.value.as_str()), ("hair.curl.along[1].s", "0.05"));
}

#[test]
fn a_mesh_may_be_in_another_folder() {
    let HeadSource::Mesh(head) = good("head.mesh = '/data/head.obj'").head else {
        panic!("a mesh was given")
    };
    assert_eq!(head.path, Path::new("/data/head.obj"));
    assert_eq!((head.frame, head.scalp), (FrameChoice::default(), ScalpSource::Guess));
}

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
        ("[hair.curl]\nkappa1 = 1e6", 2, 10, "hair.curl.kappa1", "1e6", &["at most 20000 rad/m"]),
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
            "[hair.fibre]\nyoungs_modulus = \"1e-9 Pa\"",
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
        ("[head]\nup = \"z\"", 2, 6, "head.up", "", &["the scene has none", "add `mesh"]),
        (
            "[implantation]\nflow = \"whorl\"\nparting = 0.01",
            3,
            11,
            "implantation.parting",
            "",
            &["only parted hair"],
        ),
        // Not TOML.
        ("[hair", 1, 6, "", "", &[]),
        ("a = 1\na = 2", 2, 1, "", "", &["duplicate key"]),
        ("seed = 99999999999999999999", 1, 8, "", "", &[]),
        ("\n\n  x", 3, 4, "", "", &[]),
        ("name = \"a\u{0}\"", 1, 10, "", "", &[]),
    ];
    for &(text, line, column, key, value, parts) in cases {
        let fault = fault(text);
        let whole = fault.to_string();
        let facts = (fault.line, fault.column, fault.key.as_str());
        assert_eq!(facts, (line, column, key), "{whole}\n{text}");
        assert!(value.is_empty() || fault.value == value, "{value}: {fault:?}");
        for part in parts {
            assert!(whole.contains(part), "{part}: {whole}");
        }
        assert!(whole.starts_with(&format!("scene.toml:{line}:{column}: ")), "{whole}");
        assert!(fault.span.end <= text.len());
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
        // Neither is a unit.
        ("hair.length = '25 m'", ""),
        ("wisps.count = 0", ""),
    ] {
        assert_eq!(fault(text).hint, meant, "{text}");
    }
}

#[test]
fn a_key_of_another_table_is_told_where_it_belongs() {
    for (text, place) in [
        ("lenght = '20 cm'", "did you mean `hair.length`?"),
        ("length = '20 cm'", "there is a `hair.length`"),
        ("[head]\nflayaways = 0.1", "did you mean `wisps.flyaways`?"),
        ("ligth = {}", "did you mean `light`?"),
    ] {
        assert_eq!(fault(text).hint, place, "{text}");
    }
}

#[test]
fn columns_count_characters() {
    let fault = fault("name = \"é\"\n[hair]\ntype = \"é\" # é");
    assert_eq!((fault.line, fault.column, fault.value.as_str()), (3, 8, "\"é\""));
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

/// Every leaf of the schema: path and schema.
fn leaves<'a>(schema: &'a Value, path: &str, out: &mut Vec<(String, &'a Value)>) {
    for (key, inner) in schema["properties"].as_object().into_iter().flatten() {
        let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
        if inner.get("properties").is_some() {
            leaves(inner, &path, out);
        } else {
            out.push((path, inner));
        }
    }
}

#[test]
fn the_schema_describes_every_key() {
    let mut all = Vec::new();
    leaves(schema(), "", &mut all);
    assert!(all.len() > 60, "{}", all.len());
    for (path, key) in all {
        assert!(key["description"].is_string(), "{path}");
        assert!(!key.to_string().contains("null"), "{path}: {key}");
    }
    assert_eq!(schema()["additionalProperties"], false);
    assert_eq!(schema()["properties"]["hair"]["properties"]["length"]["x-unit"], "m");
}

#[test]
fn ranges_of_the_schema_are_those_that_are_checked() {
    let mut all = Vec::new();
    leaves(schema(), "", &mut all);
    for (path, key) in all {
        for (bound, outwards) in [("minimum", -1.0), ("maximum", 1.0)] {
            let Some(limit) = key[bound].as_f64() else { continue };
            let text = |x: f64| {
                let count = key["type"] == "integer";
                let x = if count { format!("{x:.0}") } else { format!("{x:?}") };
                let rest = match path.as_str() {
                    "head.scale" => "head.mesh = \"a\"\n",
                    "groom.guides" => "groom.file = \"a.usd\"\n",
                    // As many as fit on a head depends on how many wisps there are.
                    "wisps.hairs_per_wisp" => "wisps.count = 5\n",
                    "equilibrium.starts" => "equilibrium.branch = \"lowest\"\n",
                    "camera.focus" => "camera.f_number = 4\n",
                    "look.dye.strength" | "look.dye.regrowth" => "look.dye.colour = \"#a03020\"\n",
                    _ => "",
                };
                format!("{rest}{path} = {x}")
            };
            let step = (limit.abs() * 0.01).max(if key["type"] == "integer" { 1.0 } else { 1e-9 });
            let fault = fault(&text(limit + outwards * step));
            assert_eq!(fault.key, path, "{fault}");
            // Inside; a limit that is itself excluded has the inside right beside it.
            let inside = text(limit - outwards * step);
            // Lengths and moduli above zero are bounded again by what can be computed.
            if limit != 0.0 {
                let scene = good(&inside);
                // One hair may have more elements than those of a head.
                if path == "equilibrium.elements" && bound == "maximum" {
                    assert!(scene.single_hair().is_ok(), "{inside}");
                } else {
                    assert!(scene.hairstyle_spec().is_ok(), "{inside}");
                }
            }
        }
    }
}

#[test]
fn partings_and_regions_arrive() {
    use frisure_hairstyle::head::Region;
    use frisure_hairstyle::{Comb, Hairline, Level, Parting, Place, RegionLength, Turn};
    let spec = good(
        r#"
        [implantation]
        flow = "whorl"
        whorls = 2
        whorl_offset = ["1 cm", "-5 mm"]
        whorl_turn = "anticlockwise"
        baby_hairs = "20 %"
        hairline = { irregularity = "1 mm", height = "1 cm", recession = "2 cm", widows_peak = "5 mm" }
        [[implantation.partings]]
        line = [["2 cm", "0 cm"], [0.03, 0.08]]
        [[implantation.partings]]
        at = "zigzag"
        [[region]]
        where = ["fringe", "left-side"]
        down_to = "brows"
        comb = "forward"
        [[region]]
        where = "nape"
        length = "4 cm"
        lift = 0.1
        curl = 0.5
        "#,
    )
    .hairstyle_spec()
    .unwrap();
    let i = &spec.implantation;
    assert_eq!(i.flow, Flow::Whorl);
    let line = Parting::Through(vec![[0.02, 0.0], [0.03, 0.08]]);
    assert_eq!(i.partings, [line, Parting::Zigzag { offset: 0.0 }]);
    assert_eq!((i.whorls.count, i.whorls.offset), (2, [0.01, -0.005]));
    assert_eq!((i.whorls.turn, i.baby_hairs), (Turn::Anticlockwise, 0.2));
    let hairline =
        Hairline { irregularity: 0.001, height: 0.01, recession: 0.02, widows_peak: 0.005 };
    assert_eq!(i.hairline, hairline);
    let [fringe, nape] = spec.regions.as_slice() else { panic!("two regions") };
    assert_eq!(fringe.places, [Place::Region(Region::Fringe), Place::LeftOf(Region::Sides)]);
    assert_eq!(fringe.length, Some(RegionLength::DownTo(Level::Brows)));
    assert_eq!((fringe.comb, fringe.lift), (Some(Comb::Forward), None));
    assert_eq!(nape.length, Some(RegionLength::Mean(0.04)));
    assert_eq!((nape.lift, nape.curl), (Some(0.1), Some(0.5)));
    for (text, flow) in [("\"right\"", -0.04), ("\"1 cm\"", 0.01), ("\"zigzag\"", 0.0)] {
        let scene = good(&format!("[implantation]\nparting = {text}")).hairstyle_spec().unwrap();
        assert_eq!(scene.implantation.flow, Flow::Parted { offset: flow });
        assert_eq!(scene.implantation.partings.len(), usize::from(text.contains("zig")));
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
        let f = fault(&format!("{parting}{text}"));
        assert_eq!((f.line, f.key.contains(key)), (2, true), "{f}");
        assert!(f.to_string().contains(words), "{f}");
    }
    assert!(fault(parting).to_string().contains("`at` or `line`"));
    for (text, line, words) in [
        ("where = \"frige\"", 2, "did you mean \"fringe\"?"),
        ("where = [\"top\", \"knape\"]", 2, "did you mean \"nape\"?"),
        ("where = []", 2, "one place or more"),
        ("comb = \"back\"", 1, "is nowhere"),
        ("where = \"top\"\nlength = 0", 3, "1 mm and 3 m"),
        ("where = \"top\"\nlift = \"91 deg\"", 3, "90 deg"),
        ("where = \"top\"\nlength = 1\ndown_to = \"ears\"", 4, "says again"),
    ] {
        let f = fault(&format!("[[region]]\n{text}"));
        assert_eq!(f.line, line, "{f}");
        assert!(f.to_string().contains(words), "{f}");
    }
}

#[test]
fn lights_are_understood_or_refused_at_their_key() {
    use frisure_io::scene::{Face, LampColour, LampPlace, Setup};
    let read = |text: &str| Scene::parse("a", format!("[light]\n{text}"), Path::new("folder"));
    let light = |text: &str| read(text).unwrap().light;
    assert_eq!(light("").setup, Setup::Studio);
    assert_eq!(light("setup = 'rim'\nsize = '40 deg'").size, Some(40_f64.to_radians()));
    let map = light("environment = 'a.hdr'\nrotation = '30 deg'\nsky_strength = 2");
    let file = map.environment.unwrap();
    assert_eq!((map.setup, map.sky_strength), (Setup::Dark, 2.0));
    assert_eq!(file.path, Path::new("folder").join("a.hdr"));
    let day = light("setup = 'daylight'\nsun_elevation = '10 deg'\nturbidity = 5").sun;
    assert!((day.elevation.to_degrees() - 10.0).abs() < 1e-12 && day.turbidity == 5.0);
    assert_eq!(light("turbidity = 5").setup, Setup::Daylight);
    let behind = |text: &str| read(text).unwrap().look.background;
    for sky in ["setup = 'overcast'", "turbidity = 5", "environment = 'a.hdr'"] {
        assert_eq!(behind(sky), Behind::Surroundings);
        assert_eq!(behind(&format!("{sky}\n[look]\nbackground = 'wall'")), Behind::Wall);
    }
    assert_eq!(behind("setup = 'rim'"), Behind::Wall);
    let lamps = light(
        "[[light.lamp]]\nazimuth = '-30 deg'\ndistance = '1.5 m'\nsize = ['60 cm', '90 cm']\n\
         temperature = 3200\nshown = true\n\
         [[light.lamp]]\nposition = [0, '-1 m', '2 m']\ncolour = '#ff8000'\nstrength = 0.5\n\
         [[light.lamp]]\nelevation = '80 deg'\nangle = '0 deg'",
    )
    .lamps;
    let LampPlace::Beside { distance, face: Some(face), .. } = lamps[0].place else {
        panic!("{lamps:?}")
    };
    assert_eq!((distance, face.size, face.shown), (1.5, Face::Rectangle([0.6, 0.9]), true));
    assert_eq!(lamps[0].colour, LampColour::Temperature(3200.0));
    assert!(matches!(lamps[1].place, LampPlace::At { face: None, .. }));
    assert!(matches!(lamps[2].place, LampPlace::Far { angle: Some(0.0), .. }));

    let wrong = [
        ("setup = 'sun'", "did you mean \"daylight\"?"),
        ("setup = 'soft'\nturbidity = 3", "`light.turbidity` is about a sun that is not there"),
        ("setup = 'daylight'\nturbidity = 20", "between 1.9 and 10"),
        ("setup = 'daylight'\nazimuth = 0", "there is the sun"),
        ("setup = 'dark'\nsize = 0.1", "there is none"),
        ("setup = 'overcast'\nenvironment = 'a.exr'", "second sky"),
        ("rotation = 1", "there is none"),
        ("size = '180 deg'", "between 0 and 170 deg"),
        ("[[light.lamp]]\nstrength = 1", "`light.lamp[0]` is nowhere"),
        ("[[light.lamp]]\nazimuth = 0\nsize = '1 m'", "needs `distance` beside it"),
        ("[[light.lamp]]\nposition = [0, 0, 1]\nazimuth = 0", "says again"),
        ("[[light.lamp]]\nposition = [0, 0, 1]\nangle = 0.1", "very far away"),
        ("[[light.lamp]]\nposition = [0, 0, 1]\nshown = true", "needs `size` beside it"),
        ("[[light.lamp]]\nazimuth = 0\ntemperature = 100", "between 1667 and 25000 K"),
        ("[[light.lamp]]\nazimuth = 0\ndistance = '1 cm'\nsize = 0", "between 1 mm and 100 m"),
    ];
    for (text, part) in wrong {
        let error = read(text).unwrap_err().to_string();
        assert!(error.contains(part), "{text}: {error}");
    }
    let none = read("environment = 'nowhere.hdr'").unwrap().environment().unwrap_err().to_string();
    assert!(none.contains("there is no file") && none.contains("a:2:15"), "{none}");
    let screen = read("environment = 'a.png'").unwrap().environment().unwrap_err().to_string();
    assert!(screen.contains("`.hdr` and `.exr`") && screen.contains("cuts off"), "{screen}");
}
