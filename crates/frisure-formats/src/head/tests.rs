use std::fs;

use super::*;
use frisure_files::frame::UpAxis;

/// A tetrahedron 20 units high, with a group and texture coordinates.
const TETRAHEDRON: &str = "\
v 0 20 0\nv 10 0 5\nv -10 0 5\nv 0 0 -10\nvt 0.5 0.9\nvt 0.5 0.1\n\
g top\nf 1/1 3/2 2/2\ng\nf 1/1 2/2 4/2\nf 1/1 4/2 3/2\nf 2/2 3/2 4/2\n";

fn head(text: impl AsRef<[u8]>, change: impl FnOnce(&mut HeadFile)) -> Result<HeadMesh, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("head.obj");
    fs::write(&path, text).unwrap();
    let scalp = ScalpSource::Guess;
    let frame = FrameChoice { metres: Some(0.01), ..FrameChoice::default() };
    let mut file = HeadFile { path, frame, turn: None, scalp };
    change(&mut file);
    if let ScalpSource::Weights(name) | ScalpSource::Mask(name) = &mut file.scalp {
        *name = folder.path().join(&*name);
        if name.extension().is_some() {
            fs::write(&*name, "1\n0.5 # half\n\n0\n0\n").unwrap();
        }
    }
    let place = format!("{}/", folder.path().display());
    read(&file, &Files::default()).map_err(|e| e.to_string().replace(&place, ""))
}

#[test]
fn y_up_becomes_z_up_with_the_face_towards_minus_y() {
    let mesh = head(TETRAHEDRON, |_| {}).unwrap();
    assert_eq!(mesh.scalp, None);
    assert!(mesh.surface.positions()[0].distance(DVec3::new(0.0, 0.0, 0.2)) < 1e-15);
    // Half-way to the face (+z in the file) is towards −y.
    assert!(mesh.surface.positions()[1].distance(DVec3::new(0.1, -0.05, 0.0)) < 1e-15);
    let z_up = head(TETRAHEDRON, |h| h.frame.up = Some(UpAxis::Z)).unwrap();
    assert!(z_up.surface.positions()[0].distance(DVec3::new(0.0, 0.2, 0.0)) < 1e-15);
}

#[test]
fn groups_and_lists_of_weights() {
    let group = |g: &str| {
        head(TETRAHEDRON, |h| h.scalp = ScalpSource::Group(g.into())).map(|m| m.scalp.unwrap())
    };
    assert_eq!(group("top").unwrap(), [1.0, 1.0, 1.0, 0.0]);
    assert_eq!(group("hat").unwrap_err(), "`head.obj` has no group `hat`; it has `top`");
    let list = head(TETRAHEDRON, |h| h.scalp = ScalpSource::Weights("w.txt".into()));
    assert_eq!(list.unwrap().scalp.unwrap(), [1.0, 0.5, 0.0, 0.0]);
    let short = format!("{TETRAHEDRON}v 0 0 0\n");
    let list = head(short, |h| h.scalp = ScalpSource::Weights("w.txt".into()));
    assert_eq!(
        list.unwrap_err(),
        "`w.txt` is not a list of scalp weights: it has 4 numbers, and the mesh has 5 vertices"
    );
}

#[test]
fn faces_that_lie_on_each_other_are_refused() {
    let faces = "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
    let text = |layers: usize| format!("{TETRAHEDRON}{}", faces.repeat(layers));
    let error = head(text(4000), |_| {}).unwrap_err();
    assert!(error.contains("within 0.200 m: they lie on each other"), "{error}");
    assert!(head(text(10), |_| {}).is_ok());
    // One face around and around.
    let corners = " 1 2 3".repeat(330);
    let error = head(format!("{TETRAHEDRON}f{corners}\n"), |_| {}).unwrap_err();
    assert!(error.contains("they lie on each other"), "{error}");
}

#[test]
fn marks_and_line_ends_of_other_systems_are_read() {
    let plain = head(TETRAHEDRON, |_| {}).unwrap();
    let marked = head(format!("\u{feff}{TETRAHEDRON}"), |_| {}).unwrap();
    let old = head(TETRAHEDRON.replace('\n', "\r"), |_| {}).unwrap();
    let windows = head(TETRAHEDRON.replace('\n', "\r\n"), |_| {}).unwrap();
    assert!([marked, old, windows].iter().all(|mesh| *mesh == plain));
}

#[test]
fn files_of_other_formats_are_told_which_are_read() {
    let named = |name: &'static str, bytes: &[u8]| {
        head(bytes, |h| {
            let other = h.path.with_file_name(name);
            fs::rename(&h.path, &other).unwrap();
            h.path = other;
        })
    };
    for (name, bytes) in
        [("head.stl", &b"\xff\x00binary"[..]), ("head.fbx", b"Kaydara FBX"), ("head", b"")]
    {
        let error = named(name, bytes).unwrap_err();
        assert!(error.contains("OBJ, USD, glTF or PLY"), "{error}");
    }
    // The content decides where the name says nothing.
    assert!(named("head.txt", TETRAHEDRON.as_bytes()).is_ok());
}

#[test]
fn what_cannot_be_a_head() {
    let fault = |text: &str| head(text, |_| {}).unwrap_err();
    assert_eq!(fault(""), "`head.obj` is not a mesh that hair can grow on: it has no vertices");
    let faceless = fault("v 0 0 0\n");
    assert!(faceless.ends_with("hair can grow on: it has vertices and no faces"), "{faceless}");
    assert_eq!(
        fault("v 0 0 0\nv 20 0 0\nf 1 2 2\n"),
        "`head.obj` cannot be a head: the mesh has no face with an area"
    );
    assert_eq!(
        fault("v 0 0 0\nv 1 0 0\nf 1 2 7\n"),
        "head.obj:3: the face names vertex 7, and there are 2 so far"
    );
    let binary = head([0x89, b'P', 0xff, 0x00], |_| {}).unwrap_err();
    assert_eq!(binary, "`head.obj` is not UTF-8 text (byte 1 of line 1)");
    let folder = head("", |h| assert!(h.path.pop())).unwrap_err();
    assert!(folder.ends_with("is a directory, not a file"), "{folder}");
    let none = head("", |h| h.path.set_file_name("no.obj")).unwrap_err();
    assert_eq!(none, "there is no file `no.obj`");
}

#[test]
fn a_head_has_the_size_of_a_head() {
    let size = |scale: f64| head(TETRAHEDRON, |h| h.frame.metres = Some(scale)).unwrap_err();
    assert_eq!(
        size(1.0),
        "`head.obj` is 20.000 m across, and a head is between 5 cm and 2.5 m; \
         is it in \"cm\"? set `unit = \"cm\"`"
    );
    assert!(size(0.001).contains("5 cm and 2.5 m"));
    assert!(size(1e300).contains("5 cm and 2.5 m"));
    // Squares overflow long before coordinates do.
    let huge = head("v 1e200 0 0\nv 0 1e200 0\nv 0 0 1e200\nf 1 2 3\n", |_| {}).unwrap_err();
    assert!(huge.contains("set `scale`"), "{huge}");
}

#[test]
fn a_scalp_has_an_area_and_a_mask_needs_coordinates() {
    let flat = format!("{TETRAHEDRON}g line\nf 1 2 2\n");
    // Its vertices belong to other faces, so hair grows there all the same.
    assert!(head(flat, |h| h.scalp = ScalpSource::Group("line".into())).is_ok());
    let apart = format!("{TETRAHEDRON}v 0 0 0\nv 1 0 0\ng line\nf 5 6 6\n");
    let fault = head(apart, |h| h.scalp = ScalpSource::Group("line".into())).unwrap_err();
    assert_eq!(fault, "the scalp has no area: no face of group `line` has an area");
    let bare = "v 0 20 0\nv 10 0 5\nv -10 0 5\nf 1 2 3\n";
    let fault = head(bare, |h| h.scalp = ScalpSource::Mask("m.png".into())).unwrap_err();
    assert!(fault.contains("needs texture coordinates"), "{fault}");
    let fault = head(TETRAHEDRON, |h| h.scalp = ScalpSource::Mask("m.png".into())).unwrap_err();
    assert!(fault.starts_with("`m.png` is not a PNG picture"), "{fault}");
}

#[test]
fn a_unit_that_nobody_says_is_guessed_from_the_size() {
    let of = |text: &str| head(text, |h| h.frame.metres = None).unwrap();
    let mesh = of(TETRAHEDRON);
    assert_eq!(mesh.guessed_unit, Some("cm"));
    assert!(mesh.surface.positions()[0].distance(DVec3::new(0.0, 0.0, 0.2)) < 1e-15);
    let metres = of("v 0 0.2 0\nv 0.1 0 0\nv 0 0 0.1\nf 1 2 3\n");
    assert_eq!(metres.guessed_unit, None);
    let none = head("v 0 2e9 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", |h| h.frame.metres = None);
    assert!(none.unwrap_err().contains("set `scale`"));
    assert_eq!(head(TETRAHEDRON, |_| {}).unwrap().guessed_unit, None);
    // A bust in decimetres is no body of 2.7 m.
    let decimetres = of("v 0 2.7 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    assert_eq!(decimetres.guessed_unit, Some("dm"));
}

#[test]
fn painted_scalps() {
    let painted = "v 0 20 0 1 0 0\nv 10 0 5 0.5 0 2\nv -10 0 5 0 0 0\nf 1 2 3\n";
    let colour = |name: &str| head(painted, |h| h.scalp = ScalpSource::Colour(name.into()));
    assert_eq!(colour("red").unwrap().scalp.unwrap(), [1.0, 0.5, 0.0]);
    assert_eq!(
        colour("scalp").unwrap_err(),
        "`head.obj` has no `scalp` at its vertices; it has `blue`, `brightness`, `green`, `red`"
    );
    assert_eq!(
        colour("green").unwrap_err(),
        "the scalp has no area: `green` is 0 everywhere on the mesh"
    );
}

/// A tetrahedron in a stage of centimetres, y up, higher by 3, with a subset, a material, coordinates and colours.
const STAGE: &str = r#"#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
)
def Xform "person"
{
    double3 xformOp:translate = (0, 3, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Mesh "skin"
    {
        point3f[] points = [(0, 20, 0), (10, 0, 5), (-10, 0, 5), (0, 0, -10)]
        int[] faceVertexCounts = [3, 3, 3, 3]
        int[] faceVertexIndices = [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]
        float[] primvars:hair = [1, 0.5, 0, 0] (interpolation = "vertex")
        color3f[] primvars:displayColor = [(1, 0, 0), (0, 0, 0)] (interpolation = "faceVarying")
        int[] primvars:displayColor:indices = [0, 1, 1, 0, 1, 1, 0, 1, 1, 1, 1, 1]
        texCoord2f[] primvars:st = [(0.5, 0.9), (0.5, 0.1), (0.5, 0.1), (0.5, 0.1)] (interpolation = "vertex")
        def GeomSubset "scalp"
        {
            uniform token elementType = "face"
            int[] indices = [0]
            rel material:binding = </materials/hairy>
        }
    }
}
"#;

#[test]
fn heads_in_stages() {
    let of = |scalp: ScalpSource| {
        head(STAGE, |h| (h.scalp, h.frame) = (scalp, FrameChoice::default())).unwrap()
    };
    let mesh = of(ScalpSource::Group("scalp".into()));
    assert!(mesh.surface.positions()[0].distance(DVec3::new(0.0, 0.0, 0.23)) < 1e-15);
    assert_eq!(mesh.scalp.unwrap(), [1.0, 1.0, 1.0, 0.0]);
    assert_eq!(of(ScalpSource::Group("hairy".into())).scalp.unwrap()[3], 0.0);
    assert_eq!(of(ScalpSource::Group("skin".into())).scalp.unwrap()[3], 1.0);
    assert_eq!(of(ScalpSource::Colour("hair".into())).scalp.unwrap(), [1.0, 0.5, 0.0, 0.0]);
    assert_eq!(of(ScalpSource::Colour("red".into())).scalp.unwrap(), [1.0, 0.0, 0.0, 0.0]);
    assert_eq!(of(ScalpSource::Weights("w.txt".into())).scalp.unwrap(), [1.0, 0.5, 0.0, 0.0]);
    let none = head("#usda 1.0\ndef Xform \"a\" {}\n", |_| {}).unwrap_err();
    assert_eq!(none, "`head.obj` is not a USD stage with meshes: it has no meshes");
}
