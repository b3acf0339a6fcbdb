//! Whatever is read, nothing panics and nothing takes memory that is not there.

use std::path::Path;

use frisure_files::Files;
use frisure_files::frame::FrameChoice;
use frisure_formats::groom::read_groom;
use frisure_formats::head;
use frisure_hairstyle::styling::{Dry, Operation};
use frisure_scene::quantity::LENGTH;
use frisure_scene::{HeadFile, ScalpSource, Scene, edit, template, write_step};
use proptest::prelude::*;

fn use_scene(text: &str) {
    match Scene::parse("any", text, Path::new("")) {
        Ok(scene) => {
            // Each edit reads the text a few times.
            if scene.steps().len() < 100 {
                edit_steps(text, scene.steps());
            }
            let _ = scene.hairstyle_spec();
            let _ = scene.single_hair();
        }
        Err(error) => {
            let diagnostic = error.diagnostic().expect("the text was read");
            assert!(
                diagnostic.span.start <= diagnostic.span.end
                    && diagnostic.span.end <= diagnostic.text.len()
            );
            assert!(diagnostic.line >= 1 && diagnostic.column >= 1);
            assert!(!diagnostic.to_string().is_empty());
        }
    }
}

/// A scene can be edited, or says why not.
fn edit_steps(text: &str, steps: &[Operation]) {
    let dry = Operation::Dry(Dry::default());
    for at in [0, steps.len() / 2, steps.len()] {
        let _ = edit::insert(text, at, std::slice::from_ref(&dry));
        let _ = edit::replace(text, at, &dry);
        let _ = edit::remove(text, at);
    }
    let written = steps.iter().filter_map(|step| write_step(step).ok()).count();
    assert_eq!(written, steps.len(), "a step that can be read can be written");
}

fn use_file(name: &str, bytes: &[u8], read: impl FnOnce(&Path)) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    read(&path);
}

fn use_head(bytes: &[u8]) {
    let frame = FrameChoice { metres: Some(0.1), ..FrameChoice::default() };
    use_file("head.obj", bytes, |path| {
        for scalp in
            [ScalpSource::Guess, ScalpSource::Group("g".into()), ScalpSource::Colour("red".into())]
        {
            let path = path.to_path_buf();
            let _ = head::read(
                &HeadFile { path: path.clone(), frame, turn: None, scalp },
                &Files::default(),
            );
            // The mesh as its own mask and list of weights.
            for scalp in [ScalpSource::Mask(path.clone()), ScalpSource::Weights(path.clone())] {
                let _ = head::read(
                    &HeadFile { path: path.clone(), frame, turn: None, scalp },
                    &Files::default(),
                );
            }
        }
    });
}

/// A scene with every kind of key, one to a line.
fn whole_scene() -> String {
    let loud = template(&frisure_hairstyle::PRESETS[3]).replace("\n# ", "\n");
    // The head is a mesh, below.
    let is_head = |l: &&str| *l == "[head]" || l.starts_with("model = ");
    let lines = loud.lines().filter(|l| l.contains('=') || l.starts_with('['));
    let lines = lines.filter(|l| !is_head(l));
    let mut text: Vec<_> = lines.map(str::to_owned).collect();
    text.push("[hair.root]\nd1 = [0, 1, 0]\nd2 = [0, 0, 1]\nt = [1, 0, 0]\n".into());
    text.push("[equilibrium]\nelements = 20\nbranch = \"lowest\"\nstarts = 4\n".into());
    text.push("[[step]] # c\nrelease = { where = { any = [\"top\", { wisps = [1] }] } }\n".into());
    text.push("[[step]]\n[step.cut]\nplane.point = [0, 0, 0]\nplane.normal = [0, 0, 1]\n".into());
    text.push("[head]\nmesh = \"a.obj\"\nunit = \"cm\"\nscalp_mask = \"b.png\"\n".into());
    text.join("\n")
}

/// A text with a piece replaced by another.
fn mutated(text: &str, at: usize, length: usize, piece: &str) -> String {
    let boundary = |mut i: usize| {
        i = i.min(text.len());
        while !text.is_char_boundary(i) {
            i -= 1;
        }
        i
    };
    let (start, end) = (boundary(at), boundary(at + length));
    format!("{}{piece}{}", &text[..start], &text[end..])
}

fn piece() -> impl Strategy<Value = String> {
    let words = [
        "nan",
        "inf",
        "-",
        "0",
        "1e308",
        "\"",
        "'''",
        "[",
        "]",
        "[[",
        "]]",
        "{",
        "}",
        "=",
        "\n",
        "#",
        ".",
        "\"25 cm\"",
        "\"25 GPa\"",
        "[hair]\n",
        "99999999999",
        "true",
        "1979-05-27",
        "é",
        "\u{0}",
        "\u{feff}",
        "along = [{}]",
        "[[step]]\nwet = {}\n",
        "step = [{ dry = {} }]\n",
    ];
    prop_oneof![proptest::sample::select(words.to_vec()).prop_map(str::to_owned), ".{0,12}",]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 512, ..ProptestConfig::default() })]

    #[test]
    fn any_text_as_a_scene(text in "\\PC{0,200}") {
        use_scene(&text);
    }

    #[test]
    fn scenes_with_mistakes(
        edits in proptest::collection::vec((0_usize..1500, 0_usize..30, piece()), 1..4)
    ) {
        let mut text = whole_scene();
        for (at, length, piece) in edits {
            text = mutated(&text, at, length, &piece);
        }
        use_scene(&text);
    }

    #[test]
    fn any_quantity(text in "[-+0-9.eE µa-z/^]{0,16}") {
        if let Ok(value) = LENGTH.parse(&text) {
            prop_assert!(value.is_finite());
        }
    }

    #[test]
    fn any_bytes_as_a_scene_file(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        use_file("a.toml", &bytes, |path| {
            let _ = Scene::read(path);
        });
    }

    #[test]
    fn any_bytes_as_a_head(bytes in proptest::collection::vec(any::<u8>(), 0..300)) {
        use_head(&bytes);
    }

    #[test]
    fn any_lines_as_a_head(
        lines in proptest::collection::vec("(v|vt|f|g|o|usemtl)( [-0-9./e]{1,5}){0,5}", 0..20)
    ) {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\ng g\n{}\n", lines.join("\n"));
        use_head(text.as_bytes());
    }

    #[test]
    fn any_ply_as_a_head(
        lines in proptest::collection::vec(
            "(element (vertex|face) [0-9]{1,20}|property (list uchar int|float|double|uchar) (x|y|z|red|vertex_indices))",
            0..8,
        ),
        order in "(ascii|binary_little_endian|binary_big_endian)",
        rest in proptest::collection::vec(any::<u8>(), 0..100),
    ) {
        let head = format!("ply\nformat {order} 1.0\n{}\nend_header\n", lines.join("\n"));
        use_head(&[head.as_bytes(), &rest].concat());
    }

    #[test]
    fn any_stage_as_a_head(
        counts in proptest::collection::vec(-1_i64..6, 0..6),
        indices in proptest::collection::vec(-1_i64..9, 0..20),
        points in proptest::collection::vec(-1e3_f64..1e3, 0..24),
        per in "(vertex|faceVarying|uniform|constant|)",
        orientation in "(leftHanded|rightHanded)",
    ) {
        let points: Vec<_> = points.as_chunks().0.iter().map(|[x, y, z]| (x, y, z)).collect();
        use_head(format!(
            r#"#usda 1.0
            def Mesh "g" {{
                uniform token orientation = "{orientation}"
                point3f[] points = {points:?}
                int[] faceVertexCounts = {counts:?}
                int[] faceVertexIndices = {indices:?}
                color3f[] primvars:displayColor = {points:?} (interpolation = "{per}")
                int[] primvars:displayColor:indices = {indices:?}
                texCoord2f[] primvars:st = [(0, 0), (0, 1), (1, 1)] (interpolation = "{per}")
                def GeomSubset "red" {{ int[] indices = {indices:?} }}
            }}"#
        ).as_bytes());
    }

    #[test]
    fn any_json_as_a_head(
        numbers in proptest::collection::vec(prop_oneof![0_u64..8, any::<u64>()], 9),
        data in "[A-Za-z0-9]{0,80}",
    ) {
        let n = &numbers;
        use_head(format!(
            r#"{{"nodes":[{{"mesh":{}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{}}}}}]}}],
            "accessors":[{{"bufferView":{},"componentType":5126,"count":{},"type":"VEC3","byteOffset":{}}}],
            "bufferViews":[{{"buffer":{},"byteOffset":{},"byteLength":{},"byteStride":{}}}],
            "buffers":[{{"uri":"data:;base64,{data}"}}]}}"#,
            n[0] % 2, n[1] % 2, n[2] % 2, n[3], n[4], n[5] % 2, n[6], n[7], n[8]
        ).as_bytes());
    }

    #[test]
    fn any_bytes_as_a_groom(
        counts in proptest::array::uniform4(prop_oneof![0_u32..20, any::<u32>()]),
        rest in proptest::collection::vec(any::<u8>(), 0..400),
    ) {
        let mut bytes = b"HAIR".to_vec();
        bytes.extend(counts.iter().flat_map(|c| c.to_le_bytes()));
        bytes.extend(rest);
        use_file("a.hair", &bytes, |path| {
            if let Ok(groom) = read_groom(path, FrameChoice::default()) {
                assert!(groom.hairs.points().iter().all(|p| p.is_finite()));
            }
        });
    }
}

#[test]
fn what_mistakes_are_made_in_is_a_scene() {
    let text = whole_scene();
    let scene = Scene::parse("whole", text.as_str(), Path::new("")).unwrap();
    assert_eq!(scene.steps().len(), 3);
    edit_steps(&text, scene.steps());
}

#[test]
fn deep_nesting_is_no_way_to_end_a_program() {
    for text in ["[", "a=[", "a={b=", "a.", "[a."] {
        use_scene(&text.repeat(200_000));
    }
}

#[test]
fn a_scene_of_many_steps_is_read_in_time() {
    let text = "[[step]]\ngrow = { by = \"1 mm\", where = [\"top\", \"nape\"] }\n".repeat(5000);
    use_scene(&text);
    use_scene(&format!("{text}[[step]]\nwet = {{ to = 2 }}"));
}

#[test]
fn a_scene_of_many_unknown_keys_is_refused_in_time() {
    let text: String = (0..500_000).map(|i| format!("key{} = 1\n", 999_999 - i)).collect();
    use_scene(&text);
    use_scene(&"[[region]]\nwhere = \"top\"\n".repeat(100_000));
    let long = "a".repeat(15 << 20);
    for text in [format!("[hair]\ntype = \"{long}\""), format!("{long} = 1")] {
        let error = Scene::parse("long", text, Path::new("")).unwrap_err();
        assert!(error.to_string().len() < 5000);
    }
}

#[test]
fn elements_too_long_for_the_curl_are_refused_with_the_number_that_suffices() {
    let spec = |elements: usize, more: &str| {
        let hair = format!("[hair]\ntype = \"frizzy\"\nlength = \"20 cm\"\n{more}");
        let text = format!("{hair}\n[equilibrium]\nelements = {elements}\n");
        let scene = Scene::parse("frizzy", text, Path::new(""))?;
        scene.hairstyle_spec()
    };
    let error = spec(15, "").unwrap_err().to_string();
    assert!(error.contains("at least 27") && error.contains("`elements = 27`"), "{error}");
    assert!(spec(26, "").is_err() && spec(27, "").is_ok());
    // Without a head the elements are exact helices.
    assert!(spec(1, "[contact]\nbody = \"none\"").is_ok());
    // Nor by an accuracy that takes more elements than a guide has.
    let coil = |length: &str| {
        let text = format!("[hair]\nlength = \"{length}\"\ncurl = {{ kappa1 = 20000 }}\n");
        Scene::parse("coil", text, Path::new(""))?.hairstyle_spec()
    };
    let error = coil("20 cm").unwrap_err().to_string();
    assert!(error.contains("at most 1000") && error.contains("shorter than 7.8"), "{error}");
    assert!(coil("7.8 cm").is_ok());
}

#[test]
fn numbers_of_no_hair_are_refused() {
    for (text, key) in [
        ("curl.pitch = -1e300", "hair.curl.pitch"),
        ("curl.radius = \"1 km\"", "hair.curl.radius"),
        ("fibre.diameter = \"70 mm\"", "hair.fibre.diameter"),
        ("fibre.mean_radius = \"35 mm\"", "hair.fibre.mean_radius"),
        ("fibre.diameter = \"70 nm\"", "hair.fibre.diameter"),
    ] {
        let scene = Scene::parse("hair", format!("[hair]\n{text}"), Path::new(""));
        let error = scene.and_then(|scene| scene.hairstyle_spec()).unwrap_err();
        assert_eq!(error.diagnostic().unwrap().key, key, "{error}");
    }
    let thick = Scene::parse("rod", "[hair]\nfibre.diameter = \"1 cm\"", Path::new(""));
    assert!(thick.unwrap().single_hair().is_ok(), "one hair may be any rod");
}

#[test]
fn a_scene_of_many_keys_is_read_in_time() {
    let mut text = "[hair.curl]\nalong = [\n".to_owned();
    for i in 0..20_000 {
        text += &format!("{{ s = {i}, kappa1 = 1 }},\n");
    }
    use_scene(&format!("{text}]"));
    // The error's key has to be found among all of them.
    use_scene(&format!("{text}{{ s = 0 }}]"));
}
