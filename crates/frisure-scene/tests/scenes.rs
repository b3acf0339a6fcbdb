//! Scenes: what can be said, and what it means.

mod common;

use std::path::Path;

use common::{diagnostic, good};
use frisure_files::frame::{FrameChoice, UpAxis};
use frisure_hairstyle::{
    Body, Ellipticity, Flow, Hairline, Hairs, Handedness, Lift, PRESETS, Pose,
};
use frisure_look::{
    Backdrop, Dye, Fade, Melanin, SHADES, absorption_of_colour, colour_of_temperature,
    linear_from_srgb,
};
use frisure_rod::{Branch, ElementKind, NaturalStrain, Resolution, TorsionConstant};
use frisure_scene::{HeadSource, NaturalLook, ScalpSource, Scene, schema, template, worn_template};
use glam::{DVec3, Vec3};
use serde_json::Value;

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
fn built_in_heads_have_names_and_a_wrong_one_gets_the_list() {
    let of = |model: &str| good(&format!("head.model = \"{model}\"")).head;
    assert_eq!(of("mannequin"), HeadSource::Mannequin);
    assert_eq!(of("older-man"), HeadSource::Person { name: "older-man", face: 0 });
    let wrong = diagnostic("head.model = \"old-man\"").to_string();
    for name in ["mannequin", "african-woman", "asian-man", "european-woman", "older-man"] {
        assert!(wrong.contains(name), "{wrong}");
    }
    let face = good("[head]\nmodel = \"older-man\"\nface = 7").head;
    assert_eq!(face, HeadSource::Person { name: "older-man", face: 7 });
    assert_eq!(good("head.face = 0").head, HeadSource::Mannequin);
    let wrong = diagnostic("[head]\nface = 7").to_string();
    assert!(wrong.contains("one face") && wrong.contains("european-woman"), "{wrong}");
    diagnostic("[head]\nmodel = \"older-man\"\nface = 1000001");
    // A mesh and a built-in head are two heads.
    diagnostic("[head]\nmodel = \"asian-man\"\nmesh = \"head.obj\"");
    diagnostic("[head]\nmodel = \"asian-man\"\nscale = 2");
}

#[test]
fn the_look_of_a_face_is_read() {
    let scene = good(
        "[hair]\ntype = \"african-coily\"\n[look]\niris = \"#0000ff\"\ngarment = \"#ffffff\"\n\
         scatter = \"2 mm\"\ngloss = 0.5",
    );
    let skin = scene.look.skin;
    assert_eq!((skin.iris, skin.garment), (Vec3::Z, Vec3::ONE));
    assert_eq!((skin.scatter, skin.gloss), (2e-3, 0.5));
    diagnostic("look.scatter = \"5 cm\"");
    let iris = |kind: &str| good(&format!("hair.type = \"{kind}\"")).look.skin.iris;
    assert!(iris("african-coily").x > iris("african-coily").z);
    assert!(iris("caucasian-straight").z > iris("caucasian-straight").x);
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
        // It begins on a person, who has a hairline of her own.
        let mut expected = preset.spec();
        expected.implantation.hairline = Hairline::usual(NaturalLook::of(preset).model);
        assert_eq!(good(&text).hairstyle_spec().unwrap(), expected, "{text}");
        // As it is worn, it is held out of the face and cut.
        let (natural, worn) = (NaturalLook::of(preset), good(&worn_template(preset)));
        let hold = if natural.pinned { 2.0 } else { expected.implantation.hold };
        assert_eq!(worn.hairstyle_spec().unwrap().implantation.hold, hold);
        assert_eq!(worn.steps().len(), usize::from(natural.cut));
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
        hold = 0.12
        [wisps]
        count = 11
        hairs_per_wisp = 12
        clumping = 0.13
        fuzziness = 0.14
        length_variation = 0.15
        flyaways = 0.16
        growing = 0.19
        blending = 0.17
        splits = 20
        split_variation = 0.21
        split_clumping = 0.22
        subsplits = 23
        split_phase = 0.24
        hair_phase = 0.25
        radius_variation = 0.26
        points = 18
        [contact]
        body = "spheres"
        stiffness = "0.2 kPa"
        volume = 0.3
        [equilibrium]
        elements = 210
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
    assert_eq!((w.flyaways, w.growing, w.blending), (0.16, 0.19, 0.17));
    assert_eq!((w.splits, w.split_variation, w.split_clumping), (20, 0.21, 0.22));
    assert_eq!((w.subsplits, w.split_phase, w.hair_phase), (23, 0.24, 0.25));
    assert_eq!((w.radius_variation, spec.implantation.hold), (0.26, 0.12));
    assert_eq!(spec.contact.body, Body::Spheres);
    assert_eq!((spec.contact.stiffness, spec.contact.volume), (200.0, 0.3));
    assert_eq!(spec.equilibrium.resolution, Resolution::Elements(210));
    assert_eq!(spec.equilibrium.element, ElementKind::Helix);

    let hair = scene.single_hair().unwrap();
    assert_eq!(hair.options.branch, Branch::Lowest { starts: 22, seed: u64::MAX >> 1 });
    assert_eq!(hair.rod.root().frame().z_axis, DVec3::Z);
    assert_eq!(hair.rod.root().frame().x_axis, DVec3::Y);
    assert_eq!(*hair.rod.natural(), NaturalStrain::Uniform(spec.curl.strain));

    let HeadSource::Mesh(head) = &scene.head else { panic!("a mesh was given") };
    assert_eq!(head.path, Path::new("scenes/a/head.obj"));
    assert_eq!(
        head.frame,
        FrameChoice { metres: Some(0.01), up: Some(UpAxis::Z), ..FrameChoice::default() }
    );
    assert_eq!(head.scalp, ScalpSource::Mask("scenes/mask.png".into()));
    assert_eq!(scene.look.skin.colour, linear_from_srgb([1.0, 128.0 / 255.0, 0.0]));
    assert_eq!(scene.look.backdrop, Backdrop::Colour(linear_from_srgb([0.0, 0.5, 1.0])));
    let hair = scene.look.hair;
    let pigments = Melanin { eumelanin: 0.3, pheomelanin: 0.4 };
    assert_eq!((hair.melanin, hair.absorption), (pigments, None));
    assert_eq!((hair.variation, hair.white_share), (0.5, 0.25));
    assert_eq!(hair.roots, Fade { factor: 1.5, length: 0.03 });
    assert_eq!(hair.tips, Fade { factor: 0.6, length: 0.05 });
    let blue = absorption_of_colour(linear_from_srgb([0.0, 0.0, 1.0]), 0.35);
    assert_eq!(hair.dye, Some(Dye { absorption: blue, strength: 0.8, regrowth: 0.04 }));
    let surface = hair.surface;
    assert_eq!((surface.longitudinal_roughness, surface.azimuthal_roughness), (0.25, 0.35));
    assert!((surface.tilt.to_degrees() - 2.0).abs() < 1e-5);
    assert_eq!((surface.index, hair.seed), (1.5, spec.seed as u32));
    assert!((scene.camera.azimuth.to_degrees() - 90.0).abs() < 1e-12);
    assert!((scene.light.direction.unwrap().0.to_degrees() - 10.0).abs() < 1e-12);
    assert_eq!((scene.output.width, scene.output.height, scene.output.samples), (31, 32, 3));
}

#[test]
fn a_colour_of_hair_is_said_by_name_by_pigments_or_as_measured() {
    let of = |keys: &str| good(&format!("[look]\n{keys}")).look.hair;
    for shade in &SHADES {
        let hair = of(&format!("colour = \"{}\"", shade.name));
        assert_eq!((hair.melanin, hair.absorption), (shade.melanin, None));
        assert_eq!(hair.white_share, shade.white_share);
    }
    // Without a word it is that of the type; one pigment by number leaves the other as in brown hair.
    assert_eq!(of("").melanin, of("colour = \"dark-blond\"").melanin);
    let given = of("eumelanin = 0.3").melanin;
    assert_eq!(
        (given.eumelanin, given.pheomelanin),
        (0.3, of("colour = \"brown\"").melanin.pheomelanin)
    );
    let coily = good("[hair]\ntype = \"african-coily\"").look;
    let overridden = good("[hair]\ntype = \"african-coily\"\n[look]\ncolour = \"dark-blond\"").look;
    assert_eq!(coily.hair.melanin, of("colour = \"black\"").melanin);
    assert_eq!(overridden.hair.melanin, of("").melanin);
    assert_eq!(overridden.skin, coily.skin);
    assert_eq!(of("colour = \"auburn\"\neumelanin = 0.5").melanin.eumelanin, 0.5);
    let red = of("reflectance = \"#ff0000\"");
    let roughness = red.surface.azimuthal_roughness;
    let absorption = absorption_of_colour(linear_from_srgb([1.0, 0.0, 0.0]), roughness);
    assert_eq!(red.absorption, Some(absorption));
    assert_eq!(of("absorption = [0.1, 0.2, 3]").absorption, Some(Vec3::new(0.1, 0.2, 3.0)));
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
    let refused = diagnostic(text);
    assert_eq!(refused.key, "hair.curl.along");
    assert!(refused.problem.contains("one hair"), "{refused}");
    let back = diagnostic("hair.curl.along = [{ s = 0.1 }, { s = 0.05, kappa1 = 3 }]");
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
                    "head.face" => "head.model = \"asian-man\"\n",
                    "head.scale" => "head.mesh = \"a\"\n",
                    "groom.guides" | "groom.scale" => "groom.file = \"a.usd\"\n",
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
            let diagnostic = diagnostic(&text(limit + outwards * step));
            assert_eq!(diagnostic.key, path, "{diagnostic}");
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
        hairline = { irregularity = "1 mm", height = "1 cm", recession = "2 cm", widows_peak = "5 mm", sideburns = "2 cm", nape = "1 cm" }
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
    let hairline = Hairline {
        irregularity: 0.001,
        height: 0.01,
        recession: 0.02,
        widows_peak: 0.005,
        sideburns: 0.02,
        nape: 0.01,
    };
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
fn lights_are_understood_or_refused_at_their_key() {
    use frisure_look::{Face, LampPlace, Setup};
    let read = |text: &str| Scene::parse("a", format!("[light]\n{text}"), Path::new("folder"));
    let light = |text: &str| read(text).unwrap().light;
    assert_eq!(light("").setup, Setup::Studio);
    assert_eq!(light("setup = 'rim'\nsize = '40 deg'").size, Some(40_f64.to_radians()));
    let map = read("environment = 'a.hdr'\nrotation = '30 deg'\nsky_strength = 2").unwrap();
    assert_eq!((map.light.setup, map.light.sky_strength), (Setup::Dark, 2.0));
    assert!((map.light.environment_rotation.to_degrees() - 30.0).abs() < 1e-12);
    assert_eq!(map.environment.unwrap(), Path::new("folder").join("a.hdr"));
    let day = light("setup = 'daylight'\nsun_elevation = '10 deg'\nturbidity = 5").setup;
    let Setup::Daylight(day) = day else { panic!("{day:?}") };
    assert!((day.sun_elevation.to_degrees() - 10.0).abs() < 1e-12 && day.turbidity == 5.0);
    assert!(matches!(light("turbidity = 5").setup, Setup::Daylight(_)));
    let behind = |text: &str| read(text).unwrap().look.backdrop;
    for sky in ["setup = 'overcast'", "turbidity = 5", "environment = 'a.hdr'"] {
        assert_eq!(behind(sky), Backdrop::Environment);
        assert_eq!(behind(&format!("{sky}\n[look]\nbackground = 'wall'")), Backdrop::Wall);
    }
    assert_eq!(behind("setup = 'rim'"), Backdrop::Wall);
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
    assert_eq!(lamps[0].colour, colour_of_temperature(3200.0));
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
}

#[test]
fn heads_are_held_and_blown_upon() {
    let held = |text: &str| good(text).hairstyle_spec().unwrap();
    let nods = held("[pose]\npitch = \"90 deg\"");
    assert!(nods.pose.down().distance(DVec3::NEG_Y) < 1e-15);
    // Any length of the direction is the same pose, and two ways of saying it are one.
    let lies = held("pose.down = [0, 3, 0]");
    assert!(lies.pose.down().distance(DVec3::Y) < 1e-15);
    let leans = held("pose.roll = \"30 deg\"").pose;
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let same = held(&format!("pose.down = [{sin}, 0, {}]", -cos)).pose;
    assert!((leans.roll - same.roll).abs() < 1e-12 && same.pitch.abs() < 1e-12);
    // Gravity as a vector is both.
    let moon = held("gravity = [0, 1.62, 0]");
    assert_eq!((moon.gravity, moon.pose), (1.62, lies.pose));
    let upright = held("gravity = ['0 m/s^2', 0, -3]");
    assert_eq!((upright.gravity, upright.pose), (3.0, Pose::default()));
    assert_eq!(held("gravity = [0, 0, 0]").gravity, 0.0);
    let blown = held("[wind]\nspeed = \"36 km/h\"\nazimuth = \"90 deg\"\nexposure = 0.5");
    assert!((blown.wind.speed - 10.0).abs() < 1e-12);
    // From the head's left to its right.
    assert!(blown.wind.direction().distance(DVec3::NEG_X) < 1e-15);
    let force = blown.load(&blown.fibre.section).force;
    assert!(
        (force.length() - 0.5 * blown.wind.drag(2.0 * blown.fibre.section.mean_radius())).abs()
            < 1e-18
    );
    assert_eq!(held("").wind.drag(70e-6), 0.0);
}
