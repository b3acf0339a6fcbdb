use frisure_strands::Surface;
use glam::{DVec3, Vec3};

use super::super::attributes::{self, of_points, of_strands};
use super::super::motion::Motion;
use super::*;
use frisure_files::frame::UpAxis;
use frisure_look::Melanin;
use frisure_strands::{AttributeValues as Values, Strands};

use super::super::data::HairColour;

fn strands(count: usize, points: usize) -> Strands {
    let mut strands = Strands::new();
    for i in 0..count {
        let x = 0.01 * i as f32;
        let line: Vec<Vec3> =
            (0..points).map(|k| Vec3::new(x, -0.1, 1.5 - 0.02 * k as f32)).collect();
        let radii: Vec<f32> = (0..points).map(|k| 4e-5 - 1e-6 * k as f32).collect();
        strands.push(&line, &radii);
    }
    strands
}

/// A groom with everything that a stage can hold.
fn whole() -> Groom {
    let mut hairs = strands(3, 4);
    for attribute in [
        of_strands(attributes::GUIDE, Values::U32(vec![1, 0, u32::MAX])),
        of_strands(
            attributes::CLOSEST_GUIDES,
            Values::U32x3(vec![[1, 0, 0], [0, 1, 1], [0, 1, 0]]),
        ),
        of_strands(attributes::GUIDE_WEIGHTS, Values::F32x3(vec![[0.5, 0.25, 0.25]; 3])),
        of_strands(attributes::ID, Values::U32(vec![7, 8, 9])),
        of_strands(attributes::GROUP, Values::U32(vec![0, 5, 2])),
        of_strands(attributes::ROOT_UV, Values::F32x2(vec![[0.25, 0.5], [0.0, 1.0], [0.1, 0.3]])),
        of_points(attributes::COLOUR, Values::F32x3(vec![[0.25, 0.125, 0.0625]; 12])),
        of_points(attributes::DIRECTOR, Values::F32x3(vec![[0.0, 0.6, 0.8]; 12])),
        of_points(attributes::WETNESS, Values::F32(vec![0.5; 12])),
        of_strands(attributes::AXIS_RATIO, Values::F32(vec![1.25, 1.5, 1.75])),
        of_points(attributes::NATURAL_STRAIN, Values::F32x3(vec![[12.5, -3.0, 0.125]; 12])),
    ] {
        hairs.set_attribute(attribute).unwrap();
    }
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z].map(|p| p * 0.125).to_vec();
    let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    // With a seam: corners of one vertex differ.
    let texture = (0..4u8).map(|f| [0u8, 1, 2].map(|c| [f32::from(f) * 0.25, f32::from(c * f)]));
    let head = Surface::new(corners, faces).unwrap().with_texture(texture.collect()).unwrap();
    let melanin = Some(Melanin { eumelanin: 1.5, pheomelanin: 0.25 });
    Groom {
        name: "a \"groom\"\n".into(),
        hairs,
        guides: strands(2, 3),
        head: Some(head),
        colour: Some(HairColour { melanin, colour: [0.5, 0.25, 0.125] }),
        accessories: Vec::new(),
        times: 0,
    }
}

fn bytes(groom: &Groom, frame: Frame, binary: bool) -> Vec<u8> {
    check_curves(groom).unwrap();
    let mut out = Vec::new();
    let encode = if binary { write_binary } else { write_text };
    encode(&mut out, &Samples::still(groom), frame).unwrap();
    out
}

fn text(body: &str) -> Result<Groom, String> {
    let head = "#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n";
    decode(format!("{head}{body}").as_bytes(), FrameChoice::default())
}

#[test]
fn text_and_binary_hold_the_same_layer() {
    for frame in [Frame::METRES_Z, Frame::CENTIMETRES_Y] {
        let layer = write::layer(&Samples::still(&whole()), frame);
        let from_text = usd::read(&bytes(&whole(), frame, false)).unwrap();
        assert_eq!(from_text, layer);
        let mut from_binary = usd::read(&bytes(&whole(), frame, true)).unwrap();
        // Fields have no order there.
        let sort = |layer: &mut usd::Layer| {
            fn of(prim: &mut usd::Prim) {
                prim.metadata.sort_by(|a, b| a.0.cmp(&b.0));
                for a in &mut prim.attributes {
                    a.metadata.sort_by(|a, b| a.0.cmp(&b.0));
                }
                prim.children.iter_mut().for_each(of);
            }
            layer.metadata.sort_by(|a, b| a.0.cmp(&b.0));
            layer.prims.iter_mut().for_each(of);
        };
        let mut layer = layer;
        sort(&mut layer);
        sort(&mut from_binary);
        assert_eq!(from_binary, layer);
    }
}

#[test]
fn a_groom_comes_back_with_all_it_has() {
    for binary in [false, true] {
        let read = decode(&bytes(&whole(), Frame::METRES_Z, binary), FrameChoice::default());
        let (read, whole) = (read.unwrap(), whole());
        assert_eq!(read.hairs.points(), whole.hairs.points());
        assert_eq!(read.guides.points(), whole.guides.points());
        assert_eq!(read.hairs.radii(), whole.hairs.radii());
        for attribute in whole.hairs.attributes() {
            assert_eq!(read.hairs.attribute(&attribute.name), Some(attribute));
        }
        assert_eq!(read, Groom { hairs: read.hairs.clone(), ..whole });
    }
}

#[test]
fn each_of_three_guides_is_a_number_of_its_own() {
    let layer = write::layer(&Samples::still(&whole()), Frame::METRES_Z);
    let hairs = layer.prims[0].children.iter().find(|prim| prim.name == "hairs").unwrap();
    // Without indices, which equal weights have.
    let of = |name: &str| {
        let attribute = hairs.attribute(name).unwrap();
        hairs.resolved(attribute, attribute.value.as_ref().unwrap(), 1).unwrap()
    };
    // The three of each hair in `whole`, by columns.
    for (k, column) in [[1, 0, 0], [0, 1, 1], [0, 1, 0]].into_iter().enumerate() {
        let guides = of(&format!("primvars:groom_closest_guide_{k}"));
        assert_eq!(guides, usd::Data::I32(column.to_vec()));
        let weights = of(&format!("primvars:groom_guide_weight_{k}"));
        assert_eq!(weights, usd::Data::F32(vec![[0.5, 0.25, 0.25][k]; 3]));
    }
    assert!(hairs.attribute("primvars:groom_guide_weight_0:indices").is_some());
}

#[test]
fn other_units_and_axes_come_back_as_they_were() {
    for binary in [false, true] {
        let frame = Frame { metres: 0.01, up: UpAxis::Y };
        let read = decode(&bytes(&whole(), frame, binary), FrameChoice::default()).unwrap();
        for (a, b) in read.hairs.points().iter().zip(whole().hairs.points()) {
            assert!(a.distance(*b) < 1e-6);
        }
        let d1 = |groom: &Groom| groom.hairs.attribute(attributes::DIRECTOR).cloned();
        assert_eq!(d1(&read), d1(&whole()));
        let described = FrameChoice { metres: Some(0.1), ..FrameChoice::default() };
        let larger = decode(&bytes(&strands(1, 5).into_groom(), frame, binary), described).unwrap();
        assert!((larger.hairs.points()[0].z - 15.0).abs() < 1e-4);
    }
}

trait IntoGroom {
    fn into_groom(self) -> Groom;
}

impl IntoGroom for Strands {
    fn into_groom(self) -> Groom {
        Groom::of(self)
    }
}

#[test]
fn no_groom_and_guides_alone() {
    for groom in [Groom::default(), Groom { guides: strands(2, 5), ..Groom::default() }] {
        for binary in [false, true] {
            let bytes = bytes(&groom, Frame::METRES_Z, binary);
            assert_eq!(decode(&bytes, FrameChoice::default()).unwrap(), groom);
        }
    }
}

#[test]
fn curves_have_two_points() {
    assert!(check_curves(&Groom::of(strands(2, 2))).is_ok());
    let error = check_curves(&Groom::of(strands(2, 1))).unwrap_err();
    assert_eq!(error, "hair 0 of 1 points: a curve has at least 2");
}

const CURVE: &str = "uniform token type = \"linear\"\nint[] curveVertexCounts = [2]\n\
    point3f[] points = [(1, 0, 0), (1, 0, 0.5)]\n";

#[test]
fn what_prims_are_in_moves_turns_and_scales_them() {
    let groom = text(&format!(
        "def Xform \"a\" {{
            double3 xformOp:translate = (0, 0, 2)
            float3 xformOp:rotateXYZ = (90, 0, 90)
            float3 xformOp:scale.timeSamples = {{ 1: (2, 2, 2), 2: (9, 9, 9) }}
            uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateXYZ\", \"xformOp:scale\"]
            def BasisCurves \"hair\" {{ {CURVE} float[] widths = [0.001] (interpolation = \"constant\") }}
        }}"
    ))
    .unwrap();
    // (1, 0, 0.5) twice as large, about x: (2, -1, 0), about z: (1, 2, 0).
    let p = groom.hairs.points();
    assert!(p[0].distance(Vec3::new(0.0, 2.0, 2.0)) < 1e-6, "{p:?}");
    assert!(p[1].distance(Vec3::new(1.0, 2.0, 2.0)) < 1e-6, "{p:?}");
    assert!((groom.hairs.radii()[0] - 0.001).abs() < 1e-9);
}

#[test]
fn matrices_quaternions_and_inverses() {
    let groom = text(&format!(
        "def Xform \"a\" {{
            matrix4d xformOp:transform = ( (0, 1, 0, 0), (-1, 0, 0, 0), (0, 0, 1, 0), (0, 0, 3, 1) )
            quatf xformOp:orient = (0.70710677, 0, 0, 0.70710677)
            uniform token[] xformOpOrder = [\"xformOp:transform\", \"!invert!xformOp:orient\"]
            def BasisCurves \"hair\" {{ {CURVE} }}
        }}"
    ))
    .unwrap();
    // Both turn by 90 degrees about z, one forth, one back.
    assert!(groom.hairs.points()[0].distance(Vec3::new(1.0, 0.0, 3.0)) < 1e-6);
}

#[test]
fn what_is_not_to_be_seen_is_not_read() {
    let hidden = [
        "over BasisCurves \"a\"",
        "class BasisCurves \"a\"",
        "def BasisCurves \"a\" (active = false)",
    ];
    for head in hidden {
        assert_eq!(text(&format!("{head} {{ {CURVE} }}")).unwrap_err(), "it has no curves");
    }
    let body = format!("def BasisCurves \"a\" {{ token visibility = \"invisible\"\n{CURVE} }}");
    assert!(text(&body).is_err());
    let elsewhere = text("def Xform \"a\" (prepend references = @b.usd@</hair> (offset = 1)\n) {}");
    assert!(elsewhere.unwrap_err().contains("references, which are not followed"));
}

#[test]
fn guides_are_told_by_primvar_purpose_or_name() {
    let both = |name: &str, more: &str| {
        text(&format!(
            "def BasisCurves \"hair\" {{ {CURVE} }}\ndef BasisCurves \"{name}\" {{ {CURVE} {more} }}"
        ))
        .unwrap()
    };
    assert_eq!(both("b", "").guides.len(), 0);
    assert_eq!(both("myGuides", "").guides.len(), 1);
    assert_eq!(both("b", "uniform token purpose = \"guide\"").guides.len(), 1);
    assert_eq!(both("b", "int primvars:groom_guide = 1").guides.len(), 1);
    assert_eq!(both("myGuides", "int primvars:groom_guide = 0").guides.len(), 0);
    let mixed = text(
        "def BasisCurves \"all\" { uniform token type = \"linear\"
            int[] curveVertexCounts = [2, 3]
            point3f[] points = [(0, 0, 0), (0, 0, 1), (1, 0, 0), (1, 0, 1), (1, 0, 2)]
            int[] primvars:groom_guide = [1, 0] (interpolation = \"uniform\")
            int[] primvars:groom_id = [5, 6] (interpolation = \"uniform\") }",
    )
    .unwrap();
    assert_eq!((mixed.hairs.points().len(), mixed.guides.points().len()), (3, 2));
    assert_eq!(attributes::indices(&mixed.guides, attributes::ID), Some(&[5][..]));
}

#[test]
fn values_of_every_interpolation_and_with_indices() {
    let groom = text(
        "def BasisCurves \"a\" {
            uniform token basis = \"bspline\"
            uniform token wrap = \"nonperiodic\"
            int[] curveVertexCounts = [4, 4]
            point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0),
                (0, 1, 0), (1, 1, 0), (2, 1, 0), (3, 1, 0)]
            float[] widths = [0.001, 0.002] (interpolation = \"uniform\")
            float[] primvars:frisure:wetness = [0, 0.25, 0.5, 1] (interpolation = \"varying\")
            int[] primvars:groom_id = [9, 4] (interpolation = \"uniform\")
            int[] primvars:groom_id:indices = [1, 1]
            float primvars:frisure:axis_ratio = 1.5
            float[] primvars:frisure:u = [0, 1, 2, 3, 0, 1, 2, 3] (interpolation = \"vertex\")
        }",
    )
    .unwrap();
    let hairs = &groom.hairs;
    assert_eq!(hairs.points()[3], Vec3::new(2.0, 1.0, 0.0));
    assert_eq!(hairs.radii(), [0.0005, 0.0005, 0.001, 0.001]);
    let values = |name: &str| hairs.attribute(name).map(|a| a.values.clone());
    assert_eq!(values("wetness"), Some(Values::F32(vec![0.0, 0.25, 0.5, 1.0])));
    assert_eq!(values("id"), Some(Values::U32(vec![4, 4])));
    assert_eq!(values("axis_ratio"), Some(Values::F32(vec![1.5, 1.5])));
    let Some(Values::F32(u)) = values("u") else { panic!("u is there") };
    assert!((u[0] - 1.0).abs() < 1e-6 && (u[3] - 2.0).abs() < 1e-6);
}

#[test]
fn names_of_ours_have_values_of_their_kind() {
    for (name, ty, value) in [
        ("id", "vector3f[]", "[(1, 2, 3)]"),
        ("group", "float[]", "[1]"),
        ("guide", "int3[]", "[(1, 2, 3)]"),
        ("closest_guides", "int[]", "[1]"),
        ("guide_weights", "float[]", "[1]"),
        ("root_uv", "float3[]", "[(1, 2, 3)]"),
        ("color", "int[]", "[1]"),
        ("wetness", "int[]", "[1]"),
        ("d1", "float[]", "[1]"),
    ] {
        let ours = format!("{ty} primvars:frisure:{name} = {value} (interpolation = \"uniform\")");
        let groom = text(&format!("def BasisCurves \"a\" {{ {CURVE} {ours} }}")).unwrap();
        assert!(groom.hairs.attribute(name).is_none(), "{name}");
    }
}

#[test]
fn values_that_do_not_fit_are_told_with_their_prim() {
    let fault = |more: &str| {
        let curve = format!("def Scope \"s\" {{ def BasisCurves \"a\" {{ {CURVE} {more} }} }}");
        text(&curve).unwrap_err()
    };
    assert_eq!(
        fault("float[] widths = [1, 2, 3]"),
        "</s/a>: `widths` has 3 values where 2 are needed"
    );
    assert!(
        fault("int[] primvars:groom_id = [1, 2] (interpolation = \"uniform\")").contains("1 are")
    );
    assert!(
        fault("int[] primvars:groom_id:indices = [7]\nint[] primvars:groom_id = [1]")
            .contains("index")
    );
    assert_eq!(
        fault("int2[] primvars:groom_guide = [(0, 1)] (interpolation = \"uniform\")"),
        "</s/a>: each value of `primvars:groom_guide` has 2 numbers where 1 is needed"
    );
    assert!(
        fault("float[] widths = [1, 2, 3, 4] (elementSize = 2)").contains("`widths` has 2 numbers")
    );
    let bad = text(
        "def BasisCurves \"a\" { int[] curveVertexCounts = [2, -1] point3f[] points = [(0, 0, 0)] }",
    );
    assert_eq!(bad.unwrap_err(), "</a>: curve 0 has more vertices than there are, or none");
    let nan = text(
        "def BasisCurves \"a\" { uniform token type = \"linear\"
        int[] curveVertexCounts = [2] point3f[] points = [(0, 0, 0), (nan, 0, 0)] }",
    );
    assert_eq!(nan.unwrap_err(), "point 1, of strand 0, is not finite");
}

#[test]
fn several_prims_are_one_groom() {
    let groom = text(&format!(
        "def BasisCurves \"a\" {{ {CURVE} float[] widths = [0.001, 0.001]
            int primvars:groom_id = 3\n int primvars:groom_group_id = 3 }}
         def BasisCurves \"b\" {{ {CURVE} int primvars:groom_group_id = 4 }}"
    ))
    .unwrap();
    assert_eq!(groom.hairs.radii(), [5e-4, 5e-4, 35e-6, 35e-6]);
    assert_eq!(attributes::indices(&groom.hairs, attributes::GROUP), Some(&[3, 4][..]));
    assert_eq!(groom.hairs.attribute(attributes::ID), None);
}

#[test]
fn cut_anywhere_a_file_is_refused_or_whole() {
    let small = Groom { head: None, guides: Strands::new(), ..whole() };
    for binary in [false, true] {
        let whole = bytes(&small, Frame::METRES_Z, binary);
        for n in 0..whole.len() - 1 {
            // Text is whole before its last line end.
            let read = decode(&whole[..n], FrameChoice::default());
            assert!(read.is_err(), "{n} of {}", whole.len());
        }
    }
}

#[test]
fn a_byte_wrong_anywhere_is_no_way_to_end_a_program() {
    for binary in [false, true] {
        let mut bytes = bytes(&whole(), Frame::METRES_Z, binary);
        for i in 0..bytes.len() {
            let good = bytes[i];
            for bad in [0xff, good ^ 1] {
                bytes[i] = bad;
                let _ = decode(&bytes, FrameChoice::default());
            }
            bytes[i] = good;
        }
    }
}

#[test]
fn many_small_things_do_not_become_large() {
    let many = |line: &dyn Fn(usize) -> String, n: usize| (0..n).map(line).collect::<String>();
    let constants = many(&|i| format!("int primvars:frisure:a{i} = 1\n"), 33);
    let fault = text(&format!("def BasisCurves \"a\" {{ {CURVE} {constants} }}")).unwrap_err();
    assert!(fault.contains("more than 32 attributes"), "{fault}");
    let attributes = many(&|i| format!("int a{i}\n"), 10_001);
    let fault = text(&format!("def BasisCurves \"a\" {{ {attributes} }}")).unwrap_err();
    assert!(fault.contains("more than 10000 properties"), "{fault}");
    // A long name above many prims is not repeated in each.
    let inner = many(&|i| format!("def Xform \"b{i}\" {{}}\n"), 20_000);
    let long = "n".repeat(1_000_000);
    assert!(text(&format!("def Xform \"{long}\" {{ {inner} }}")).is_err());
}

#[test]
fn deep_nesting_has_an_end() {
    for piece in [
        "def \"a\" { ",
        "def \"a\" ( a = ",
        "def \"a\" { a b = [",
        "( ",
        "def \"a\" { variantSet \"b\" = { ",
    ] {
        assert!(text(&piece.repeat(100_000)).is_err());
    }
}

/// The groom of `whole`, and the same hanging elsewhere and thinner.
fn moving() -> Motion {
    let first = whole();
    let moved = |strands: &Strands, thinner: f32| {
        let mut moved = Strands::new();
        for strand in strands.iter() {
            let points: Vec<Vec3> = strands_points(strand.points);
            let radii: Vec<f32> = strand.radii.iter().map(|r| thinner * r).collect();
            moved.push(&points, &radii);
        }
        moved
    };
    let mut motion = Motion::new(first.clone(), 0.5);
    for thinner in [0.5, 0.25] {
        let hairs = moved(&first.hairs, thinner);
        motion.push(&Groom { hairs, guides: first.guides.clone(), ..Groom::default() }).unwrap();
    }
    motion
}

fn strands_points(points: &[Vec3]) -> Vec<Vec3> {
    points.iter().map(|p| *p + Vec3::new(0.0, 0.0, 0.25)).collect()
}

#[test]
fn hair_that_moves_has_its_points_and_widths_at_time_codes() {
    let motion = moving();
    let layer = write::layer(&Samples::of(&motion), Frame::METRES_Z);
    let times = ["startTimeCode", "endTimeCode", "timeCodesPerSecond"];
    let times = times.map(|key| layer.meta(key).and_then(usd::Value::number));
    assert_eq!(times, [Some(0.0), Some(24.0), Some(24.0)]);
    let prim = |name: &str| layer.prims[0].children.iter().find(|p| p.name == name).unwrap();
    let codes = |prim: &usd::Prim, name: &str| -> Vec<f64> {
        prim.attribute(name).unwrap().samples.iter().map(|(time, _)| *time).collect()
    };
    for name in ["points", "extent", "widths"] {
        assert_eq!(codes(prim("hairs"), name), [0.0, 12.0, 24.0], "{name}");
    }
    // Guides have the same widths at all times.
    assert_eq!(codes(prim("guides"), "points").len(), 3);
    assert!(codes(prim("guides"), "widths").is_empty());
    assert!(prim("guides").value("widths").is_some());
    // A reader of one time has the first.
    for write in [write_text, write_binary, write_package] {
        let mut bytes = Vec::new();
        write(&mut bytes, &Samples::of(&motion), Frame::METRES_Z).unwrap();
        let read = decode(&bytes, FrameChoice::default()).unwrap();
        assert_eq!(read.hairs.points(), whole().hairs.points());
        assert_eq!(read.hairs.radii(), whole().hairs.radii());
        assert_eq!(read.guides, whole().guides);
        // And says that there are others.
        assert_eq!((read.times, whole().told()), (3, None));
        assert!(read.told().unwrap().contains("of its 3 times the first"));
    }
}
