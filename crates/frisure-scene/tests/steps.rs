//! Steps of scenes: what can be said, what is said about what is wrong, writing and editing them.

use std::path::Path;

use frisure_hairstyle::head::Region;
use frisure_hairstyle::styling::{
    Braid, Clip, Comb, Cut, CutLine, Direction, Dry, Grow, Growth, Height, Held, Humidity, Lasso,
    Operation, Part, Release, Roll, Selection, Spot, Straighten, StyleError, Tie, TiePlace, Twist,
    View, Wet,
};
use frisure_hairstyle::{Comb as Word, Level, Parting, Place, WetLocks, Wetting, preset};
use frisure_scene::edit::{self, EditError};
use frisure_scene::{Diagnostic, Scene, WriteStepError, parse_step, schema, write_step};
use glam::DVec3;
use proptest::prelude::*;
use serde_json::Value;

fn parse(text: &str) -> Result<Scene, Box<Diagnostic>> {
    Scene::parse("scene.toml", text, Path::new(""))
        .map_err(|e| Box::new(e.diagnostic().unwrap().clone()))
}

fn steps(text: &str) -> Vec<Operation> {
    parse(text).unwrap_or_else(|e| panic!("{e}\n{text}")).steps().to_vec()
}

fn one(text: &str) -> Operation {
    let parsed = parse_step("--step", text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!(steps(&format!("[[step]]\n{text}")), std::slice::from_ref(&parsed));
    assert_eq!(steps(&format!("step = [{{ {text} }}]")), std::slice::from_ref(&parsed));
    parsed
}

fn diagnostic(text: &str) -> Diagnostic {
    *parse(text).err().unwrap_or_else(|| panic!("this should be refused:\n{text}"))
}

const EVERYTHING: Selection = Selection::Everything;

fn fringe() -> Selection {
    Selection::Place(Place::Region(Region::Fringe))
}

#[test]
fn steps_come_in_their_order() {
    let scene = "[[step]]\nwet = {}\n\n[[step]]\ncut = { below = \"brows\", where = \"fringe\" }\n\
                 [[step]]\n[step.dry]\nkeep = 0.25\n";
    let cut = Cut {
        selection: fringe(),
        line: CutLine::Below(Height::Above(Level::Brows, 0.0)),
        held: Held::Hanging,
        ..Cut::default()
    };
    let dry = Dry { selection: EVERYTHING, keep: 0.25 };
    let expected = [Operation::Wet(Wet::default()), Operation::Cut(cut), Operation::Dry(dry)];
    assert_eq!(steps(scene), expected);
    assert_eq!(steps(""), []);
}

#[test]
fn every_operation_can_be_said() {
    let wet = Wet { selection: fringe(), to: 0.5, water: 0.3 };
    assert_eq!(one("wet = { to = \"50 %\", water = 0.3, where = 'fringe' }"), Operation::Wet(wet));
    assert_eq!(one("dry = {}"), Operation::Dry(Dry::default()));
    let damp = Operation::Humidity(Humidity { relative: 0.9 });
    assert_eq!((one("humidity = 0.9"), one("humidity = \"90 %\"")), (damp.clone(), damp));
    let cut =
        |line, held| Operation::Cut(Cut { selection: EVERYTHING, line, held, ..Cut::default() });
    let brows = CutLine::Below(Height::Above(Level::Brows, -0.01));
    assert_eq!(one("cut = { below = 'brows', raise = '-1 cm' }"), cut(brows, Held::Hanging));
    let flat = CutLine::Below(Height::At(0.04));
    assert_eq!(one("cut = { below = '4 cm', held = 'hanging' }"), cut(flat, Held::Hanging));
    assert_eq!(one("cut = { below = '4 cm', held = 'down' }"), cut(flat, Held::Down));
    let resting = Cut { line: flat, resting: true, ..Cut::default() };
    assert_eq!(one("cut = { below = '4 cm', resting = true }"), Operation::Cut(resting));
    let plane = CutLine::Plane { point: DVec3::new(0.0, 0.05, 1.0), normal: DVec3::NEG_Z };
    let text = "cut = { plane = { point = [0, '5 cm', 1], normal = [0, 0, -1] } }";
    assert_eq!(one(text), cut(plane, Held::Hanging));
    let sphere = CutLine::Sphere { centre: DVec3::ZERO, radius: 0.2 };
    let text = "cut = { sphere = { centre = [0, 0, 0], radius = '20 cm' }, elevation = '90 deg' }";
    assert_eq!(one(text), cut(sphere, Held::Elevated(std::f64::consts::FRAC_PI_2)));
    assert_eq!(one("cut = { off_skin = '8 cm' }"), cut(CutLine::OffSkin(0.08), Held::Hanging));
    assert_eq!(one("cut = { length = '10 cm' }"), cut(CutLine::Length(0.1), Held::Hanging));
    let gathered = CutLine::Gathered(DVec3::new(0.0, -0.2, 0.1));
    assert_eq!(one("cut = { gathered = [0, '-20 cm', 0.1] }"), cut(gathered, Held::Hanging));
    let grow = |amount, stages| Operation::Grow(Grow { selection: EVERYTHING, amount, stages });
    assert_eq!(one("grow = { by = '2 cm' }"), grow(Growth::By(0.02), 1));
    assert_eq!(one("grow = { to = '20 cm', stages = 12 }"), grow(Growth::To(0.2), 12));
    let month = 30.436875 * 86_400.0;
    assert_eq!(one("grow = { months = 3 }"), grow(Growth::For(3.0 * month), 1));
    assert_eq!(one("grow = { time = '3 months' }"), grow(Growth::For(3.0 * month), 1));
    let comb = |towards, strength, hold| {
        Operation::Comb(Comb { selection: EVERYTHING, towards, strength, until: None, hold })
    };
    let left = Direction::Named(Word::Left);
    assert_eq!(one("comb = { to = 'left' }"), comb(left, Comb::STRENGTH, false));
    let along = Direction::Along(DVec3::Y);
    assert_eq!(one("comb = { to = [0, 1, 0], strength = 5, hold = true }"), comb(along, 5.0, true));
    let Operation::Comb(stopped) = one("comb = { to = 'back', until = [0, '9 cm', 0.1] }") else {
        panic!()
    };
    assert_eq!(stopped.until, Some(DVec3::new(0.0, 0.09, 0.1)));
    let part = |line| Operation::Part(Part { line });
    let middle = Parting::Straight { offset: 0.0 };
    assert_eq!(one("part = { at = 'middle' }"), part(middle));
    let through = Parting::Through(vec![[0.02, 0.0], [0.03, 0.08]]);
    let text = "part = { line = [['2 cm', 0], ['3 cm', '8 cm']] }";
    assert_eq!(one(text), part(through));
    let roll = Roll { selection: EVERYTHING, radius: 0.01, pitch: 5e-3 };
    assert_eq!(one("roll = { radius = '1 cm' }"), roll.into());
    let braid = Braid { selection: EVERYTHING, width: 0.02, pitch: 0.04 };
    assert_eq!(one("braid = { width = '2 cm', pitch = '4 cm' }"), braid.into());
    let twist = Twist { selection: EVERYTHING, width: 0.02, pitch: 0.03 };
    assert_eq!(one("twist = { width = '2 cm' }"), twist.into());
    assert_eq!(one("twist = {}"), Twist::default().into());
    let tie = Tie { selection: EVERYTHING, to: TiePlace::High, braided: false };
    assert_eq!(one("tie = { to = 'high' }"), tie.into());
    assert_eq!(one("tie = {}"), Tie::default().into());
    let tie =
        Tie { selection: EVERYTHING, to: TiePlace::At(DVec3::new(0.0, 0.12, 0.05)), braided: true };
    assert_eq!(one("tie = { to = [0, '12 cm', '5 cm'], braided = true }"), tie.into());
    assert_eq!(one("straighten = {}"), Straighten { selection: EVERYTHING }.into());
    let clip = Clip { selection: EVERYTHING, at: 0.5, to: DVec3::new(0.0, -0.1, 0.2) };
    assert_eq!(one("clip = { at = 0.5, to = [0, '-10 cm', '20 cm'] }"), clip.into());
    let release = Release { selection: fringe() };
    assert_eq!(one("release = { where = 'fringe' }"), Operation::Release(release));
}

#[test]
fn wisps_can_be_chosen_in_every_way() {
    let chosen = |text: &str| {
        let Operation::Release(release) = one(&format!("release = {{ where = {text} }}")) else {
            panic!("a release")
        };
        release.selection
    };
    let place = Selection::Place;
    assert_eq!(chosen("'everything'"), EVERYTHING);
    assert_eq!(chosen("'all'"), place(Place::Everywhere));
    assert_eq!(
        chosen("['fringe', 'left-side']"),
        Selection::Any(vec![fringe(), place(Place::LeftOf(Region::Sides))])
    );
    assert_eq!(chosen("{ wisps = [3, 1] }"), Selection::Wisps(vec![3, 1]));
    let plane = Selection::Beyond { point: DVec3::ZERO, normal: DVec3::X };
    assert_eq!(chosen("{ plane = { point = [0, 0, 0], normal = [1, 0, 0] } }"), plane);
    let spots = vec![Spot::At(DVec3::new(0.0, 0.0, 0.1)), Spot::Tape([0.02, 0.05])];
    let brush = Selection::Brush { spots, radius: 0.02 };
    assert_eq!(
        chosen("{ brush = { at = [[0, 0, '10 cm'], ['2 cm', '5 cm']], radius = '2 cm' } }"),
        brush
    );
    let view = View { eye: DVec3::NEG_Y, target: DVec3::ZERO, field_of_view: 0.5, aspect: 0.8 };
    let polygon = vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    let lasso = Selection::Lasso(Lasso { view, polygon, through: true });
    let camera = "{ eye = [0, -1, 0], target = [0, 0, 0], field_of_view = 0.5, aspect = 0.8 }";
    let text = format!(
        "{{ lasso = {{ camera = {camera}, polygon = [[0, 0], [1, 0], [0, 1]], through = true }} }}"
    );
    assert_eq!(chosen(&text), lasso);
    let inner = Selection::Not(Box::new(Selection::All(vec![plane, fringe()])));
    assert_eq!(
        chosen(
            "{ any = ['fringe', { not = { all = [{ plane = { point = [0, 0, 0], \
             normal = [1, 0, 0] } }, 'fringe'] } }] }"
        ),
        Selection::Any(vec![fringe(), inner])
    );
}

#[test]
fn growth_and_wetting_of_a_type_can_be_changed() {
    let spec = |keys: &str| parse(keys).unwrap().hairstyle_spec().unwrap();
    let preset = preset("caucasian-straight").unwrap();
    let (usual, hair) = (spec(""), preset.hair_type());
    assert_eq!(usual.length.growth_rate, hair.growth_rate);
    assert_eq!(usual.wetting, hair.paper_wetting);
    assert_eq!(spec("hair.wetting = 'measured'").wetting, hair.wetting);
    let capillary = Wetting { locks: WetLocks::Capillary, ..hair.wetting };
    assert_eq!(spec("hair.wetting = 'capillary'").wetting, capillary);
    let friction = |keys: &str| {
        let contact = spec(keys).contact;
        [contact.friction, contact.skin_friction, contact.wet_friction, contact.scales]
    };
    assert_eq!(friction(""), [0.0, 0.0, 1.3, 1.4]);
    assert_eq!(friction("contact.coefficients = 'free'"), friction(""));
    let measured = "hair.type = 'wavy'\n[contact]\ncoefficients = 'measured'\n";
    assert_eq!(friction(measured), [0.54, 0.54, 1.3, 1.4]);
    let given = format!("{measured}skin_friction = 0.2\nwet_friction = 1\nscales = 1");
    assert_eq!(friction(&given), [0.54, 0.2, 1.0, 1.0]);
    assert_eq!(spec("").contact.lock_friction, 0.0);
    assert_eq!(spec("contact.lock_friction = 0.4").contact.lock_friction, 0.4);
    let diagnostic = parse("contact.lock_friction = 2").unwrap().hairstyle_spec().unwrap_err();
    assert!(diagnostic.to_string().contains("between 0 and 1.5"), "{diagnostic}");
    let diagnostic = parse("contact.scales = 0.9").unwrap().hairstyle_spec().unwrap_err();
    assert!(diagnostic.to_string().contains("between 1 and 2"), "{diagnostic}");
    let fast = spec("hair.growth_rate = '0.864 mm/day'").length.growth_rate;
    assert!((fast - 1e-8).abs() < 1e-22, "{fast}");
    let diagnostic =
        parse("hair.growth_rate = '30 cm/month'").unwrap().hairstyle_spec().unwrap_err();
    assert!(diagnostic.to_string().contains("between 0 and 26 cm a month"), "{diagnostic}");
}

/// Step, column of what is wrong, its key, and parts of the sentence with its hint.
type Case = (&'static str, usize, &'static str, &'static [&'static str]);

#[test]
fn faults_name_place_value_range_and_hint() {
    let cases: &[Case] = &[
        ("wett = {}", 1, "wett", &["unknown key `wett` in `[step[1]]`", "did you mean `wet`?"]),
        ("", 0, "", &["does nothing", "a step has one of wet, dry, humidity"]),
        (
            "wet = {}\ndry = {}",
            0,
            "dry",
            &["one thing", "`wet` and `dry`", "`[[step]]` of its own"],
        ),
        ("wet = true", 7, "wet", &["it must be a table of keys"]),
        ("wet = { too = 1 }", 9, "wet.too", &["did you mean `to`?"]),
        ("wet = { to = 1.5 }", 14, "wet.to", &["is 1.5; it must be between 0 and 1"]),
        ("wet = { water = '50 %' }", 17, "wet.water", &["is '50 %'; it must be between 0 and 0.4"]),
        ("dry = { keep = -1 }", 16, "dry.keep", &["between 0 and 1"]),
        ("humidity = '5 cm'", 12, "humidity", &["a number"]),
        ("humidity = 2", 12, "humidity", &["is 2; it must be between 0 and 1"]),
        ("cut = {}", 7, "cut", &["does not say where", "below = \"chin\""]),
        ("cut = { below = 'brow' }", 17, "cut.below", &["did you mean \"brows\"?"]),
        ("cut = { below = 4, length = 1 }", 29, "cut.length", &["says again what"]),
        ("cut = { length = 1, raise = 1 }", 29, "cut.raise", &["only a level", "take it away"]),
        ("cut = { below = 4, raise = 1 }", 28, "cut.raise", &["only a level"]),
        ("cut = { below = 'eyes', raise = 2 }", 33, "cut.raise", &["between -1 and 1 m"]),
        ("cut = { below = 200 }", 17, "cut.below", &["is 200; it must be within 100 m"]),
        ("cut = { length = 1, held = 'down' }", 28, "cut.held", &["changes nothing"]),
        ("cut = { length = 1, elevation = 1 }", 33, "cut.elevation", &["changes nothing"]),
        ("cut = { below = 1, held = 'up' }", 27, "cut.held", &["one of \"down\", \"hanging\""]),
        ("cut = { below = 1, held = 'down', elevation = 1 }", 47, "cut.elevation", &["says again"]),
        ("cut = { below = 1, elevation = '200 deg' }", 32, "cut.elevation", &["180 deg"]),
        ("cut = { plane = 3 }", 17, "cut.plane", &["it must be a table"]),
        ("cut = { plane = { point = [0, 0, 0] } }", 17, "cut.plane", &["`normal` is missing"]),
        (
            "cut = { plane = { point = [0, 0, 0], norm = 1 } }",
            38,
            "cut.plane.norm",
            &["did you mean `normal`?"],
        ),
        (
            "cut = { plane = { point = [0, 'x', 0], normal = [0, 0, 1] } }",
            31,
            "cut.plane.point[1]",
            &["is 'x'; it must be a length"],
        ),
        (
            "cut = { plane = { point = [0, 0, 0], normal = [0, 0, 0] } }",
            47,
            "cut.plane.normal",
            &["a direction, which has a length"],
        ),
        (
            "cut = { sphere = { centre = [0, 0, 0], radius = 0 } }",
            49,
            "cut.sphere.radius",
            &["between 1 mm and 100 m"],
        ),
        ("grow = {}", 8, "grow", &["does not say how much", "months = 3"]),
        ("grow = { by = 1, months = 1 }", 27, "grow.months", &["says again"]),
        (
            "grow = { months = 300 }",
            19,
            "grow.months",
            &["is 300; it must be between 0 and 20 years"],
        ),
        ("grow = { time = '21 years' }", 17, "grow.time", &["between 0 and 20 years"]),
        ("grow = { by = 1, stages = 0 }", 27, "grow.stages", &["between 1 and 1000"]),
        ("comb = {}", 8, "comb", &["needs `to`"]),
        ("comb = { to = 'lefft' }", 15, "comb.to", &["did you mean \"left\"?"]),
        ("comb = { to = [0, 0, 0] }", 15, "comb.to", &["a direction"]),
        ("comb = { to = 'left', hold = 1 }", 30, "comb.hold", &["true or false"]),
        (
            "part = { at = 0, where = 'top' }",
            18,
            "part.where",
            &["unknown key `where`", "about the whole head: leave `where` out"],
        ),
        ("part = {}", 8, "part", &["needs `at`"]),
        ("part = { at = '10 cm' }", 15, "part.at", &["within 6 cm"]),
        ("part = { line = [[0, 0]] }", 17, "part.line", &["of 1 points", "2 to 100 points"]),
        ("roll = {}", 8, "roll", &["needs `radius`"]),
        ("roll = { radius = 1 }", 19, "roll.radius", &["between 1 mm and 10 cm"]),
        ("braid = { width = 0.01 }", 9, "braid", &["needs `pitch`"]),
        ("twist = { width = 2 }", 19, "twist.width", &["between 1 mm and 10 cm"]),
        ("twist = { pitch = '1 mm' }", 19, "twist.pitch", &["between 5 mm and 50 cm"]),
        ("clip = { at = 0, to = [0, 0, 0] }", 15, "clip.at", &["between 0.05 and 1"]),
        ("clip = { at = 1, to = [0, 0, 101] }", 23, "clip.to", &["within 100 m"]),
        ("tie = { to = 'hihg' }", 14, "tie.to", &["did you mean \"high\"?"]),
        ("tie = { to = [0, 0, 101] }", 14, "tie.to", &["within 100 m"]),
        ("release = { where = 'fringes' }", 21, "release.where", &["did you mean \"fringe\"?"]),
        ("release = { where = [] }", 21, "release.where", &["one place or more"]),
        ("release = { where = 3 }", 21, "release.where", &["a part of the scalp"]),
        ("release = { where = {} }", 21, "release.where", &["says nothing", "wisps, plane"]),
        ("release = { where = ['fringe', 'x'] }", 32, "release.where[1]", &["one of \"fringe\""]),
        (
            "release = { where = { nott = 'fringe' } }",
            23,
            "release.where.nott",
            &["did you mean `not`?"],
        ),
        (
            "release = { where = { wisps = [1], any = [] } }",
            21,
            "release.where",
            &["two choices of wisps in one table"],
        ),
        (
            "release = { where = { any = ['top', { wisps = [0, -1] }] } }",
            51,
            "release.where.any[1].wisps[1]",
            &["a whole number"],
        ),
        (
            "release = { where = { not = { brush = { at = [[0, 0]], radius = 0 } } } }",
            65,
            "release.where.not.brush.radius",
            &["between 0.1 mm and 1 m"],
        ),
        (
            "release = { where = { lasso = { camera = 1, polygon = [] } } }",
            42,
            "release.where.lasso.camera",
            &["a camera, which has `eye`"],
        ),
    ];
    for (text, column, key, parts) in cases {
        let scene = format!("[[step]]\nwet = {{}}\n[[step]]\n{text}\n");
        let found = diagnostic(&scene);
        let path = if key.is_empty() { "step[1]".into() } else { format!("step[1].{key}") };
        assert_eq!(found.key, path, "{found}");
        let sentence = found.to_string();
        for part in *parts {
            assert!(sentence.contains(part), "{text}: {part}: {sentence}");
        }
        if *column > 0 {
            assert_eq!((found.line, found.column), (4, *column), "{sentence}");
            // The same step by itself.
            let alone = parse_step("--step", *text).unwrap_err().diagnostic().unwrap().clone();
            assert_eq!((alone.line, alone.column), (1, *column), "{alone}");
            assert_eq!((alone.key.as_str(), alone.file.as_str()), (*key, "--step"));
        }
    }
    assert_eq!(diagnostic("step = 3").allowed, "a list of tables");
    assert_eq!(diagnostic("step = [3]").key, "step[0]");
}

/// The hint for a step by itself, which is the same in a scene.
fn hint(text: &str) -> String {
    let alone = parse_step("--step", text).expect_err(text).diagnostic().unwrap().clone();
    assert_eq!(diagnostic(&format!("[[step]]\n{text}\n")).hint, alone.hint, "{text}");
    alone.hint
}

#[test]
fn a_bare_number_out_of_range_is_told_its_unit() {
    for (text, meant) in [
        ("cut = { below = 0, elevation = 45 }", "is in rad; did you mean \"45 deg\"?"),
        ("cut = { length = 8 }", "is in m; did you mean \"8 cm\"?"),
        ("cut = { below = 200 }", "is in m; write a unit, as in \"25 cm\""),
        ("roll = { radius = 15 }", "did you mean \"15 mm\"?"),
        ("part = { at = -2.5 }", "is in m; write a unit, as in \"25 cm\""),
        ("dry = { keep = 50 }", "did you mean \"50 %\"?"),
        ("dry = { keep = '50' }", "did you mean \"50 %\"?"),
        ("humidity = 80", "did you mean \"80 %\"?"),
        ("release = { where = { brush = { at = [0, 0], radius = 2 } } }", "\"2 cm\"?"),
    ] {
        let hint = hint(text);
        assert!(hint.ends_with(meant), "{text}: {hint}");
    }
    // No unit makes these right.
    for text in ["grow = { months = 300 }", "wet = { to = -1 }", "cut = { length = '8 m' }"] {
        assert_eq!(hint(text), "", "{text}");
    }
}

#[test]
fn other_words_lead_to_those_that_there_are() {
    for (text, meant) in [
        ("release = { where = 'neck' }", "did you mean \"nape\"?"),
        ("release = { where = 'Bangs' }", "did you mean \"fringe\"?"),
        ("release = { where = ['top', 'hairline'] }", "did you mean \"fringe\"?"),
        ("release = { where = 'left side' }", "did you mean \"left-side\"?"),
        ("release = { where = 'left-back' }", "write { all = [\"left\", \"back\"] }"),
        ("release = { where = { not = 'neck left' } }", "write { all = [\"nape\", \"left\"] }"),
        (
            "release = { where = ['top', 'left-back'] }",
            "write { any = [{ all = [\"left\", \"back\"] }, …] }",
        ),
        ("cut = { below = 'eyebrows' }", "did you mean \"brows\"?"),
    ] {
        let hint = hint(text);
        assert!(hint.ends_with(meant), "{text}: {hint}");
    }
    for text in ["cut = { below = 'mouth' }", "cut = { below = 'waist' }"] {
        let sentence = parse_step("--step", text).unwrap_err().to_string();
        let allowed = "one of \"brows\", \"eyes\", \"ears\", \"chin\", \"nape\", \"shoulders\", \"chest\", or a height such as \"4 cm\"";
        assert!(sentence.contains(allowed), "{sentence}");
    }
    let months = hint("grow = { months = '12 months' }");
    assert_eq!(months, "with a unit it is `time = \"12 months\"`");
    // A region has no table of choices.
    assert_eq!(diagnostic("[[region]]\nwhere = 'left-back'").hint, "");
    assert_eq!(diagnostic("[[region]]\nwhere = 'bangs'").hint, "did you mean \"fringe\"?");
}

#[test]
fn a_step_said_in_another_way_is_told_how() {
    for (text, told) in [
        ("curl = { radius = 1 }", "did you mean `roll`?"),
        ("snip = {}", "did you mean `cut`?"),
        ("trim = {}", "did you mean `cut`?"),
        ("shampoo = {}", "did you mean `wet`?"),
        ("wash = {}", "did you mean `wet`?"),
        ("ponytail = {}", "did you mean `tie`?"),
        ("rope = {}", "did you mean `twist`?"),
        ("twist = '2 cm'", "write `twist = { width = '2 cm' }`"),
        ("blow-dry = {}", "did you mean `dry`?"),
        ("below = 'chin'", "there is a `cut.below`"),
        ("wet = true", "write `wet = {}`"),
        ("dry = 0.5", "write `dry = { keep = 0.5 }`"),
        ("cut = 'chin'", "write `cut = { below = 'chin' }`"),
        ("cut = 'shoulders'", "write `cut = { below = 'shoulders' }`"),
        ("cut = 'waist'", "write `cut = { below = \"chin\" }`"),
        ("release = 'fringe'", "write `release = { where = 'fringe' }`"),
        ("braid = '2 cm'", "write `braid = { width = \"2 cm\", pitch = \"4 cm\" }`"),
        ("part = { at = 0, where = 'top' }", "leave `where` out"),
    ] {
        let hint = hint(text);
        assert!(hint.ends_with(told), "{text}: {hint}");
    }
}

#[test]
fn a_text_that_is_no_single_step_is_told_what_is() {
    for (text, told) in [
        ("dry", "write `dry = {}`"),
        ("trim", "write `cut = { below = \"chin\" }`"),
        ("[[step]]\nwet = {}", "leave out `[[step]]`, and write what follows it"),
        ("[[step]] wet = {}", "leave out `[[step]]`, and write what follows it"),
        ("wet = {} dry = {}", "`--step` takes one step: give each a `--step` of its own"),
        ("wet = {}; dry = {}", "`--step` takes one step: give each a `--step` of its own"),
        ("wet = {}, dry = {}", "`--step` takes one step: give each a `--step` of its own"),
        ("wet = {}\ndry = {}", "`--step` takes one step: give each a `--step` of its own"),
        ("wet = {", ""),
        ("", "a step has one of wet, dry"),
    ] {
        let diagnostic = parse_step("--step", text).unwrap_err().diagnostic().unwrap().clone();
        assert!(diagnostic.hint.starts_with(told), "{text}: {}", diagnostic.hint);
    }
    let header = "what follows `[[step]]` begins on a line of its own";
    assert_eq!(diagnostic("seed = 1\n[[step]] wet = {}\n").hint, header);
}

#[test]
fn one_place_of_a_brush_needs_no_list() {
    for place in ["[0.06, -0.04, 0.09]", "['6 cm', '-4 cm']"] {
        let brush = |at: &str| {
            one(&format!("release = {{ where = {{ brush = {{ at = {at}, radius = 0.02 }} }} }}"))
        };
        assert_eq!(brush(place), brush(&format!("[{place}]")));
    }
    let wrong = "release = { where = { brush = { at = [0.06], radius = 0.02 } } }";
    assert!(parse_step("--step", wrong).unwrap_err().to_string().contains("a point [x, y, z]"));
}

#[test]
fn choices_of_choices_end_somewhere() {
    let nested = |depth: usize| {
        let open = "{ not = ".repeat(depth);
        format!("release = {{ where = {open}'top'{} }}", " }".repeat(depth))
    };
    assert!(parse_step("--step", nested(32)).is_ok());
    let refused = parse_step("--step", nested(33)).unwrap_err().to_string();
    assert!(refused.contains("more than 32 deep"), "{refused}");
    assert!(parse_step("--step", nested(5000)).is_err());
    let lists = |depth: usize| {
        let open = "{ any = [".repeat(depth);
        format!("release = {{ where = {open}'top'{} }}", "] }".repeat(depth))
    };
    assert!(parse_step("--step", lists(32)).is_ok());
    assert!(parse_step("--step", lists(33)).is_err());
}

#[test]
fn a_step_that_cannot_be_done_is_shown() {
    let scene = parse(
        "[[step]]\nwet = {}\n[[step]]\ncut = { below = 'eyes', where = 'nape' }\n[[step]]\n\
         [step.cut]\nlength = 1\n",
    )
    .unwrap();
    let diagnostic =
        |index, error: &StyleError| scene.step_error(index, error).diagnostic().unwrap().clone();
    let nothing = diagnostic(1, &StyleError::NothingSelected);
    assert_eq!((nothing.line, nothing.column), (4, 33));
    assert_eq!(nothing.key, "step[1].cut.where");
    let above = diagnostic(1, &StyleError::AboveRoot { wisps: vec![3, 4], selected: 9 });
    assert_eq!((above.line, above.column, above.key.as_str()), (4, 7, "step[1].cut"));
    assert!(above.to_string().contains("2 of 9 wisps: 3, 4") && above.hint.contains("cut lower"));
    let left_out = "where = { all = ['nape', { above = 'eyes' }] }";
    assert!(above.hint.contains(left_out), "{}", above.hint);
    // What is proposed can be said.
    one(&format!("release = {{ {left_out} }}"));
    let all = diagnostic(2, &StyleError::AboveRoot { wisps: vec![0], selected: 1 }).hint;
    assert!(all.ends_with("`where = { not = { wisps = [0] } }`"), "{all}");
    // Nothing says which wisps; the header of the table stands for it.
    let none = diagnostic(2, &StyleError::NoSuchWisp { wisp: 7, count: 5 });
    assert_eq!((none.line, none.column, none.key.as_str()), (6, 1, "step[2]"));
    let length = frisure_hairstyle::InvalidSpec {
        field: "cut.length",
        value: "1".into(),
        allowed: "less than this",
    };
    let length = diagnostic(2, &length.into());
    assert_eq!((length.line, length.key.as_str()), (7, "step[2].cut.length"));
    // Of a step that there is not.
    let _ = diagnostic(9, &StyleError::NothingSelected);
}

/// The keys of a table in the schema, with those of the tables in it.
fn leaves<'a>(schema: &'a Value, path: &str, out: &mut Vec<(String, &'a Value)>) {
    for (key, inner) in schema["properties"].as_object().into_iter().flatten() {
        out.push((format!("{path}{key}"), inner));
        leaves(inner, &format!("{path}{key}."), out);
    }
}

#[test]
fn ranges_of_the_schema_are_those_that_are_checked() {
    let mut all = Vec::new();
    leaves(&schema()["properties"]["step"]["items"], "", &mut all);
    assert!(all.len() > 50, "{}", all.len());
    let (mut checked, mut refused) = (0, 0);
    for (path, key) in all {
        assert!(key["description"].is_string(), "{path}");
        for (bound, outwards) in [("minimum", -1.0), ("maximum", 1.0)] {
            let Some(limit) = key[bound].as_f64() else { continue };
            let count = key["type"] == "integer";
            let by = if count { 1.0 } else { (limit.abs() * 0.01).max(1e-9) };
            let text = |x: f64| {
                let x = if count { format!("{x:.0}") } else { format!("{x:?}") };
                let rest = match path.as_str() {
                    "cut.raise" => "cut.below = 'eyes'",
                    "cut.elevation" | "cut.point_cut" | "cut.share" => "cut.below = 0",
                    "grow.stages" => "grow.by = 0",
                    "comb.strength" => "comb.to = 'left'",
                    "roll.pitch" => "roll.radius = 0.01",
                    "braid.width" => "braid.pitch = 0.1",
                    "braid.pitch" => "braid.width = 0.01",
                    "clip.at" => "clip.to = [0, 0, 0]",
                    "product.amount" => "product.kind = 'gel'",
                    _ => "",
                };
                format!("{rest}\n{path} = {x}")
            };
            let outside = parse_step("--step", text(limit + outwards * by));
            let diagnostic = outside.unwrap_err().diagnostic().unwrap().clone();
            assert_eq!(diagnostic.key, path, "{diagnostic}");
            refused += 1;
            let inside = text(limit - outwards * by);
            parse_step("--step", inside).unwrap_or_else(|e| panic!("{e}"));
            checked += 1;
        }
    }
    assert!(checked > 30 && refused == checked);
    assert!(schema()["$defs"]["where"]["anyOf"].is_array());
}

fn number(min: f64, max: f64) -> BoxedStrategy<f64> {
    let tidy = prop_oneof![Just(100.0), Just(1000.0), Just(16.0)]
        .prop_flat_map(move |by| (min..=max).prop_map(move |x| (x * by).round() / by));
    let ends = prop_oneof![Just(min), Just(max)];
    prop_oneof![min..=max, tidy, ends].prop_map(move |x| x.clamp(min, max)).boxed()
}

fn point() -> impl Strategy<Value = DVec3> {
    [number(-100.0, 100.0), number(-0.3, 0.3), number(-1.0, 1.0)].prop_map(DVec3::from)
}

fn normal() -> impl Strategy<Value = DVec3> {
    let any = [number(-1.0, 1.0), number(-1e8, 1e8), number(-1e-3, 1e-3)].prop_map(DVec3::from);
    any.prop_filter("a direction", |d| (1e-9..=1e9).contains(&d.length()))
}

fn place() -> impl Strategy<Value = Place> {
    let region = prop_oneof![Just(Region::Fringe), Just(Region::Sides)];
    prop_oneof![
        Just(Place::Everywhere),
        Just(Place::Left),
        Just(Place::Region(Region::Nape)),
        region.clone().prop_map(Place::LeftOf),
        region.prop_map(Place::RightOf),
    ]
}

fn selection() -> impl Strategy<Value = Selection> {
    let spot = prop_oneof![
        point().prop_map(Spot::At),
        [number(-1.0, 1.0), number(-100.0, 100.0)].prop_map(Spot::Tape),
    ];
    let brush = (proptest::collection::vec(spot, 1..4), number(1e-4, 1.0))
        .prop_map(|(spots, radius)| Selection::Brush { spots, radius });
    let view = (point(), number(2e-3, 3.12), number(1e-3, 1e3)).prop_map(
        |(eye, field_of_view, aspect)| {
            let target = DVec3::new(0.0, 2.0, 0.0);
            View { eye, target, field_of_view, aspect }
        },
    );
    let corner = [number(-1e3, 1e3), number(-1.0, 1.0)];
    let lasso = (view, proptest::collection::vec(corner, 3..6), any::<bool>())
        .prop_map(|(view, polygon, through)| Selection::Lasso(Lasso { view, polygon, through }));
    let leaf = prop_oneof![
        Just(Selection::Everything),
        place().prop_map(Selection::Place),
        proptest::collection::vec(0_usize..20_000, 1..5).prop_map(Selection::Wisps),
        number(-100.0, 100.0).prop_map(|z| Selection::Above(Height::At(z))),
        Just(Selection::Above(Height::Above(Level::Chin, 0.0))),
        (point(), normal()).prop_map(|(point, normal)| Selection::Beyond { point, normal }),
        brush,
        lasso,
    ];
    leaf.prop_recursive(4, 16, 3, |inner| {
        let list = proptest::collection::vec(inner.clone(), 1..3);
        prop_oneof![
            list.clone().prop_map(Selection::Any),
            list.prop_map(Selection::All),
            inner.prop_map(|part| Selection::Not(Box::new(part))),
        ]
    })
}

fn cut() -> impl Strategy<Value = Cut> {
    let level = prop_oneof![Just(Level::Brows), Just(Level::Nape), Just(Level::Chin)];
    let open = prop_oneof![
        number(-100.0, 100.0).prop_map(|z| CutLine::Below(Height::At(z))),
        (level, number(-1.0, 1.0)).prop_map(|(l, by)| CutLine::Below(Height::Above(l, by))),
        (point(), normal()).prop_map(|(point, normal)| CutLine::Plane { point, normal }),
        (point(), number(1e-3, 100.0))
            .prop_map(|(centre, radius)| CutLine::Sphere { centre, radius }),
        number(0.0, 3.0).prop_map(CutLine::OffSkin),
    ];
    let held = prop_oneof![
        Just(Held::Down),
        Just(Held::Hanging),
        number(0.0, std::f64::consts::PI).prop_map(Held::Elevated),
    ];
    let closed = prop_oneof![
        number(1e-3, 3.0).prop_map(CutLine::Length),
        point().prop_map(CutLine::Gathered),
    ];
    let resting =
        (open.clone(), any::<bool>()).prop_map(|(line, rest)| (line, Held::Hanging, rest));
    let held = (open, held).prop_map(|(line, held)| (line, held, false));
    let closed = closed.prop_map(|line| (line, Held::Hanging, false));
    let how = prop_oneof![held, resting, closed];
    (selection(), how, number(0.0, 0.5), number(0.0, 1.0)).prop_map(
        |(selection, (line, held, resting), point_cut, share)| Cut {
            selection,
            line,
            held,
            resting,
            point_cut,
            share,
        },
    )
}

fn tie_place() -> impl Strategy<Value = TiePlace> {
    prop_oneof![
        Just(TiePlace::High),
        Just(TiePlace::Middle),
        Just(TiePlace::Low),
        Just(TiePlace::Left),
        Just(TiePlace::Right),
        point().prop_map(TiePlace::At),
    ]
}

fn held_hair() -> impl Strategy<Value = Operation> {
    prop_oneof![
        (selection(), number(1e-3, 0.1), number(0.0, 0.1))
            .prop_map(|(selection, radius, pitch)| Roll { selection, radius, pitch }.into()),
        (selection(), number(1e-3, 0.1), number(5e-3, 0.5))
            .prop_map(|(selection, width, pitch)| Braid { selection, width, pitch }.into()),
        (selection(), number(1e-3, 0.1), number(5e-3, 0.5))
            .prop_map(|(selection, width, pitch)| Twist { selection, width, pitch }.into()),
        (selection(), tie_place(), any::<bool>()).prop_map(|(selection, to, braided)| Tie {
            selection,
            to,
            braided
        }
        .into()),
        selection().prop_map(|selection| Straighten { selection }.into()),
        (selection(), number(0.05, 1.0), point()).prop_map(|(selection, at, to)| Clip {
            selection,
            at,
            to
        }
        .into()),
    ]
}

fn operation() -> impl Strategy<Value = Operation> {
    let amount = prop_oneof![
        number(0.0, 3.0).prop_map(Growth::By),
        number(1e-3, 3.0).prop_map(Growth::To),
        number(0.0, 6e8).prop_map(Growth::For),
        (0_u16..200).prop_map(|m| Growth::For(f64::from(m) * 30.436875 * 86_400.0)),
    ];
    let word = prop_oneof![Just(Word::Forward), Just(Word::Left), Just(Word::Down)];
    let towards = prop_oneof![word.prop_map(Direction::Named), normal().prop_map(Direction::Along)];
    let line = prop_oneof![
        number(-0.06, 0.06).prop_map(|offset| Parting::Straight { offset }),
        Just(Parting::Zigzag { offset: 0.0 }),
        number(0.0, 0.2).prop_map(|x| Parting::Through(vec![[x, 0.0], [-x, 0.4]])),
    ];
    prop_oneof![
        (selection(), number(0.0, 1.0), number(0.0, 0.4))
            .prop_map(|(selection, to, water)| Operation::Wet(Wet { selection, to, water })),
        (selection(), number(0.0, 1.0))
            .prop_map(|(selection, keep)| Operation::Dry(Dry { selection, keep })),
        number(0.0, 1.0).prop_map(|relative| Operation::Humidity(Humidity { relative })),
        cut().prop_map(Operation::Cut),
        (selection(), amount, 1_usize..1001).prop_map(|(selection, amount, stages)| {
            Operation::Grow(Grow { selection, amount, stages })
        }),
        (selection(), towards, number(0.0, 100.0), prop::option::of(point()), any::<bool>())
            .prop_map(|(selection, towards, strength, until, hold)| {
                Operation::Comb(Comb { selection, towards, strength, until, hold })
            }),
        line.prop_map(|line| Operation::Part(Part { line })),
        held_hair(),
        selection().prop_map(|selection| Operation::Release(Release { selection })),
    ]
}

/// Scenes with steps written in every way.
fn scenes() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        "",
        "name = \"a\"",
        "# title\n[[step]]\nwet = {}\n",
        "# title\n\n[hair]\nlength = 0.1 # c\n\n# wet\n[[step]] # w\nwet = {} # v\n\n# d\n[[step]]\n\
         [step.dry]\nkeep = 0.1\n# in it\n\n# rest\n\n# out\n[output]\n# width = 3\n",
        "step = []",
        "step = [{ wet = {} }]\n[hair]\n",
        "step = [\n  { wet = {} }, # a\n  # b\n  { dry = {} } # c\n]\n",
        "step = [\n  { wet = {} },\n\t{ dry = {} }, # c\n  # d\n]\r\n",
        "step = [{ wet = {} },\n { dry = {} }]",
        "[[step]]\r\nwet.to = 0.1\r\nwet.water = 0.2 # c\r\n\r\n[[step]]\r\ndry = {}\r\n",
        "name = '''\n[[step]]\n# no'''\n[[step]]\nwet = {}",
        "name = '''\n# no'''\n[[step]]\nwet = {}",
    ])
}

proptest! {
    #[test]
    fn what_is_written_is_read_to_the_last_bit(operation in operation()) {
        prop_assert!(operation.check().is_ok(), "{operation:?}");
        let text = write_step(&operation).unwrap();
        // `Debug` tells 0 from -0.
        prop_assert_eq!(format!("{:?}", steps(&text)), format!("{:?}", [operation]), "{}", text);
    }

    #[test]
    fn editing_changes_one_step_and_no_comment(
        text in scenes(), new in operation(), at in 0_usize..3, what in 0..3,
    ) {
        let mut expected = steps(text);
        let count = expected.len();
        let edited = match what {
            0 => edit::insert(text, at, std::slice::from_ref(&new)),
            1 => edit::replace(text, at, &new),
            _ => edit::remove(text, at),
        };
        if at > count || what > 0 && at == count {
            let refused = matches!(edited, Err(EditError::NoSuchStep { .. }));
            prop_assert!(refused);
            return Ok(());
        }
        let edited = edited.unwrap_or_else(|e| panic!("{e}: {text}"));
        match what {
            0 => expected.insert(at, new),
            1 => expected[at] = new,
            _ => { expected.remove(at); }
        }
        prop_assert_eq!(steps(&edited), expected, "{}", edited);
        if what < 2 {
            for comment in text.split('\n').filter_map(|line| line.split_once('#')) {
                prop_assert!(edited.contains(comment.1), "{}: {}", comment.1, edited);
            }
        }
    }
}

#[test]
fn steps_are_written_as_a_person_would() {
    for text in [
        "cut = { below = \"4 cm\", where = \"fringe\" }",
        "cut = { below = \"brows\", raise = \"-5 mm\", elevation = \"45 deg\" }",
        "wet = {}",
        "wet = { to = 0.5, where = [\"left-side\", \"nape\"] }",
        "grow = { months = 3, stages = 12 }",
        "comb = { to = [0, 0.5, 1], strength = 10, hold = true, where = { wisps = [1, 2] } }",
        "part = { at = \"middle\" }",
        "part = { at = \"zigzag\" }",
        "clip = { at = 0.5, to = [0, \"-125 mm\", \"1 m\"] }",
        "humidity = 0.9",
        "straighten = { where = { not = { plane = { point = [0, \"1 cm\", 0], \
         normal = [0, 1, 0] } } } }",
    ] {
        assert_eq!(write_step(&one(text)).unwrap(), format!("[[step]]\n{text}\n"));
    }
}

#[test]
fn what_cannot_be_said_is_not_written() {
    let bad = Operation::Humidity(Humidity { relative: f64::NAN });
    assert!(matches!(write_step(&bad), Err(WriteStepError::Invalid(_))));
    let held = Cut {
        selection: EVERYTHING,
        line: CutLine::Length(0.1),
        held: Held::Down,
        ..Cut::default()
    };
    assert!(matches!(write_step(&Operation::Cut(held)), Err(WriteStepError::Invalid(_))));
    let aside = Part { line: Parting::Zigzag { offset: 0.01 } };
    let unsaid = Err(WriteStepError::Unsaid { operation: "part" });
    assert_eq!(write_step(&Operation::Part(aside)), unsaid);
    let wet = one("wet = {}");
    assert!(matches!(edit::append("", &[wet.clone(), bad]), Err(EditError::Step(_))));
    assert!(matches!(edit::append("[hare]", &[wet]), Err(EditError::Scene(_))));
}

#[test]
fn edits_leave_the_layout_as_it_is() {
    let dry = one("dry = {}");
    let dry = std::slice::from_ref(&dry);
    let added = |text: &str, at| edit::insert(text, at, dry).unwrap();
    assert_eq!(added("", 0), "[[step]]\ndry = {}\n");
    assert_eq!(added("seed = 2", 0), "seed = 2\n\n[[step]]\ndry = {}\n");
    // Keys that are commented out stay in their table.
    let template = "[output]\n# width = 900\n";
    assert_eq!(added(template, 0), "[output]\n# width = 900\n\n[[step]]\ndry = {}\n");
    let two = "# A\n\n# first\n[[step]]\nwet = {} # w\n# in\n\n# second\n[[step]]\nwet = {}\n\n# out\n\
               [output]\n";
    assert_eq!(added(two, 0), two.replace("# first\n", "[[step]]\ndry = {}\n\n# first\n"),);
    assert_eq!(added(two, 1), two.replace("# second\n", "[[step]]\ndry = {}\n\n# second\n"));
    assert_eq!(added(two, 2), two.replace("# out\n", "[[step]]\ndry = {}\n\n# out\n"));
    assert_eq!(
        edit::replace(two, 0, &dry[0]).unwrap(),
        two.replace("wet = {} # w", "dry = {} # w")
    );
    assert_eq!(edit::remove(two, 0).unwrap(), two.replace("# first\n[[step]]\nwet = {} # w\n", ""),);
    assert_eq!(edit::remove(two, 1).unwrap(), two.replace("# second\n[[step]]\nwet = {}\n\n", ""));
    assert_eq!(edit::remove("seed = 1\n\n[[step]]\nwet = {}\n", 0).unwrap(), "seed = 1\n");
    // Line ends and marks.
    let windows = "\u{feff}[[step]]\r\nwet = {}\r\n";
    assert_eq!(added(windows, 1), format!("{windows}\r\n[[step]]\r\ndry = {{}}\r\n"));
    // Lists.
    let list = "step = [\n    { wet = {} }, # a\n]\n";
    assert_eq!(added(list, 1), "step = [\n    { wet = {} }, # a\n    { dry = {} },\n]\n");
    assert_eq!(added(list, 0), "step = [\n    { dry = {} },\n    { wet = {} }, # a\n]\n");
    assert_eq!(edit::remove(list, 0).unwrap(), "step = [\n]\n");
    let short = "step = [{ wet = {} }]";
    assert_eq!(added(short, 1), "step = [{ wet = {} }, { dry = {} }]");
    assert_eq!(edit::replace(short, 0, &dry[0]).unwrap(), "step = [{ dry = {} }]");
}

#[test]
fn steps_mixed_with_other_tables_are_left_alone() {
    let mixed = "[[step]]\n[hair]\n[step.wet]\nto = 0.5\n[output]\n";
    assert_eq!(steps(mixed).len(), 1);
    for edited in [edit::remove(mixed, 0), edit::append(mixed, &[one("dry = {}")])] {
        assert!(matches!(edited, Err(EditError::Scattered)), "{edited:?}");
    }
}
