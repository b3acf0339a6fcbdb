//! What styling does to a hairstyle: laws that hold for any hair.

use std::sync::LazyLock;

use frisure_hairstyle::head::{Head, Region};
use frisure_hairstyle::styling::{
    Clip, Comb, Cut, CutLine, Direction, Dry, Grow, Growth, Height, Held, Humidity, Lasso,
    Operation, Part, Release, Roll, Selection, Sides, Spot, StyleError, Tie, TiePlace, Tuck, Twist,
    View, Wet, WispState,
};
use frisure_hairstyle::{
    Body, Curl, HairContact, Hairs, Hairstyle, HairstyleSpec, Moisture, PRESETS, Parting, Place,
    PredictOptions, StrandOptions, StyleOptions, predict, preset, selected, settling_report,
    strands, style,
};
use frisure_strands::AttributeValues;
use glam::DVec3;

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

fn spec(name: &str, wisps: usize, contact: HairContact) -> HairstyleSpec {
    let mut spec = preset(name).unwrap().spec();
    spec.wisps.count = wisps;
    spec.wisps.hairs = Hairs::Count(300);
    spec.contact.hair = contact;
    spec
}

fn hairstyle(name: &str, wisps: usize) -> Hairstyle {
    predict(&spec(name, wisps, HairContact::Layers), &HEAD, PredictOptions::default(), &()).unwrap()
}

fn done(before: &Hairstyle, operation: &Operation) -> Hairstyle {
    style(before, &HEAD, operation, StyleOptions::default(), &()).unwrap()
}

fn wet() -> Operation {
    Operation::Wet(Wet::default())
}

fn dry() -> Operation {
    Operation::Dry(Dry::default())
}

fn cut_below(z: f64, selection: Selection) -> Operation {
    let line = CutLine::Below(Height::At(z));
    Operation::Cut(Cut { selection, line, held: Held::Down, ..Cut::default() })
}

fn grow(amount: Growth) -> Operation {
    Operation::Grow(Grow { selection: Selection::Everything, amount, stages: 1 })
}

/// Whether two hairstyles are the same to the last bit.
fn same(a: &Hairstyle, b: &Hairstyle) -> bool {
    let shapes = a.equilibria().iter().zip(b.equilibria());
    let drawn = |h: &Hairstyle| strands(h, &HEAD, StrandOptions::default(), &()).unwrap().strands;
    shapes.clone().all(|(a, b)| a.shape == b.shape && a.rod == b.rod) && drawn(a) == drawn(b)
}

/// Largest distance (m) of the tips of two hairstyles.
fn farthest_tip(a: &Hairstyle, b: &Hairstyle) -> f64 {
    let tips = a.equilibria().iter().zip(b.equilibria());
    tips.map(|(a, b)| a.tip().distance(b.tip())).fold(0.0, f64::max)
}

#[test]
fn drying_is_the_inverse_of_wetting_to_the_last_bit() {
    for contact in [HairContact::Layers, HairContact::Wisps] {
        let before =
            predict(&spec("caucasian-curly", 40, contact), &HEAD, PredictOptions::default(), &())
                .unwrap();
        let wetted = done(&before, &wet());
        assert!(!same(&before, &wetted));
        assert!(same(&before, &done(&wetted, &dry())));
        // By halves, and by regions.
        let half = Operation::Wet(Wet { to: 0.5, ..Wet::default() });
        let fringe = Selection::Place(Place::Region(Region::Fringe));
        let wetter = Operation::Wet(Wet { selection: fringe.clone(), ..Wet::default() });
        let dried = Operation::Dry(Dry { selection: fringe, ..Dry::default() });
        let there = done(&done(&done(&done(&before, &half), &wetter), &dried), &dry());
        assert!(same(&before, &there));
    }
}

#[test]
fn wet_hair_weighs_the_same_and_hangs_lower_and_straighter() {
    for preset in PRESETS {
        let before = hairstyle(preset.name, 60);
        let after = done(&before, &wet());
        assert!((after.mass() / before.mass() - 1.0).abs() < 1e-12, "{}", preset.name);
        let mean = |h: &Hairstyle, of: fn(&frisure_hairstyle::Guide, DVec3) -> f64| {
            let each = h.guides().iter().zip(h.equilibria());
            each.map(|(guide, rest)| of(guide, rest.tip())).sum::<f64>() / 60.0
        };
        let height = |h: &Hairstyle| mean(h, |_, tip| tip.z);
        let spanned = |h: &Hairstyle| mean(h, |g, tip| tip.distance(g.root.position));
        assert!(height(&after) < height(&before), "{}", preset.name);
        assert!(spanned(&after) > spanned(&before), "{}", preset.name);
    }
}

#[test]
fn fully_wet_hair_has_the_numbers_of_the_paper() {
    // §3.2.1: E ÷ 5, radius + 13 %, length + 1 %, wisps − 40 %; ρ makes up for what has swollen.
    let before = hairstyle("caucasian-curly", 10);
    let after = done(&before, &wet());
    for (dry, wet) in before.guides().iter().zip(after.guides()) {
        let (a, b) = (dry.rod.spec(), wet.rod.spec());
        let close = |x: f64, y: f64| assert!((x - y).abs() <= 1e-12 * y.abs(), "{x} {y}");
        close(b.material.youngs_modulus(), 0.2 * a.material.youngs_modulus());
        close(b.material.shear_modulus(), 0.2 * a.material.shear_modulus());
        close(b.section.mean_radius(), 1.13 * a.section.mean_radius());
        close(b.section.axis_ratio(), a.section.axis_ratio());
        close(b.length, 1.01 * a.length);
        close(wet.thickness.packed(0.1), 0.6 * dry.thickness.packed(0.1));
        close(wet.layer.at(0.05), 0.6 * dry.layer.at(0.05));
        close(wet.rod.weight() * b.length, dry.rod.weight() * a.length);
        // As much turn in all.
        let turn = |rod: &frisure_rod::Rod| rod.natural().mean(0.0, rod.length()).x * rod.length();
        close(turn(&wet.rod), turn(&dry.rod));
    }
    let soaked = done(&before, &Operation::Wet(Wet { water: 0.3, ..Wet::default() }));
    assert!((soaked.mass() / before.mass() - 1.3).abs() < 1e-12);
    let wetness = |h: &Hairstyle| {
        strands(h, &HEAD, StrandOptions::default(), &())
            .unwrap()
            .strands
            .attribute("wetness")
            .cloned()
    };
    assert!(wetness(&before).is_none());
    let all_wet = AttributeValues::F32(vec![1.0; 300 * before.spec().wisps.points]);
    assert_eq!(wetness(&after).unwrap().values, all_wet);
}

#[test]
fn the_fringe_cut_wet_springs_up_when_it_dries() {
    // The paper's Fig. 5.
    let mut spec = spec("caucasian-curly", 100, HairContact::Layers);
    let places = vec![Place::Region(Region::Fringe)];
    let comb = Some(frisure_hairstyle::Comb::Forward);
    spec.regions = vec![frisure_hairstyle::RegionStyle { places, comb, ..Default::default() }];
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let fringe = Selection::Place(Place::Region(Region::Fringe));
    let chosen = selected(&before, &HEAD, &fringe).unwrap();
    let tips = |h: &Hairstyle| {
        let tips = h.equilibria().iter().zip(&chosen).filter(|(_, chosen)| **chosen);
        let (sum, count) = tips.fold((0.0, 0.0), |(s, n), (rest, _)| (s + rest.tip().z, n + 1.0));
        sum / count
    };
    let line = -0.03;
    let wetted = done(&before, &wet());
    let cut = done(&wetted, &cut_below(line, fringe));
    let after = done(&cut, &dry());
    assert!(tips(&wetted) < tips(&before));
    assert!(tips(&after) > tips(&cut) + 0.005, "{} {}", tips(&cut), tips(&after));
    assert!(tips(&after) > line + 0.03, "{}", tips(&after));
    // What was not cut lies as before.
    let rest = before.equilibria().iter().zip(after.equilibria()).zip(&chosen);
    assert!(rest.filter(|(_, chosen)| !**chosen).all(|((a, b), _)| a.shape == b.shape));
}

#[test]
fn a_lasso_takes_what_is_seen_in_it_and_a_brush_what_is_rooted_under_it() {
    let hair = hairstyle("straight", 150);
    let marks = HEAD.landmarks();
    let side = |left: f64, through: bool| {
        let view = View {
            eye: marks.cranium_centre + DVec3::new(0.0, -1.0, 0.05),
            target: marks.cranium_centre,
            field_of_view: 0.6,
            aspect: 1.0,
        };
        let polygon = vec![[0.0, -9.0], [9.0 * left, -9.0], [9.0 * left, 9.0], [0.0, 9.0]];
        let lasso = Selection::Lasso(Lasso { view, polygon, through });
        selected(&hair, &HEAD, &lasso).unwrap()
    };
    let (left, right, through) = (side(1.0, false), side(-1.0, false), side(1.0, true));
    let count = |chosen: &[bool]| chosen.iter().filter(|c| **c).count();
    assert!(count(&left) > 10 && count(&right) > 10);
    // The head's left is on the right of a picture of its face.
    for (i, rest) in hair.equilibria().iter().enumerate() {
        let x: f64 = rest.centre_line(20).iter().map(|p| p.x).sum::<f64>() / 20.0;
        assert!(!(left[i] && right[i]));
        assert!(!left[i] || x > -0.01, "{x}");
    }
    assert!(count(&through) > count(&left), "the head hides some");
    let brush = |spot: Spot| {
        let brush = Selection::Brush { spots: vec![spot], radius: 0.03 };
        selected(&hair, &HEAD, &brush).unwrap()
    };
    let near = brush(Spot::At(marks.whorl + DVec3::Z * 0.05));
    for (near, guide) in near.iter().zip(hair.guides()) {
        let distance = guide.root.position.distance(marks.whorl);
        assert!(*near == (distance < 0.03) || (distance - 0.03).abs() < 0.02, "{distance}");
    }
    assert!(count(&near) > 0 && count(&brush(Spot::Tape([0.0, 0.05]))) > 0);
    let both = Selection::All(vec![Selection::Place(Place::Left), Selection::Place(Place::Right)]);
    assert_eq!(selected(&hair, &HEAD, &both), Err(StyleError::NothingSelected));
    let all = Selection::Any(vec![
        Selection::Wisps(vec![3]),
        Selection::Not(Box::new(Selection::Wisps(vec![3]))),
    ]);
    assert_eq!(count(&selected(&hair, &HEAD, &all).unwrap()), 150);
}

#[test]
fn a_mirrored_selection_has_the_wisps_rooted_on_the_other_side() {
    let hair = hairstyle("caucasian-straight", 150);
    let temple = HEAD.landmarks().ear + DVec3::new(0.0, -0.02, 0.04);
    let sphere = |centre: DVec3| Selection::Brush { spots: vec![Spot::At(centre)], radius: 0.05 };
    let beside = Selection::Beyond { point: DVec3::X * 0.02, normal: DVec3::new(1.0, 0.2, 0.3) };
    let half = Selection::Not(Box::new(Selection::Place(Place::LeftOf(Region::Fringe))));
    let chosen = [sphere(temple), beside, half];
    for selection in chosen.iter().chain([&Selection::All(chosen.to_vec())]) {
        let other = selection.mirrored(&|wisp| wisp);
        assert_eq!(other.mirrored(&|wisp| wisp), *selection);
        let (here, there) = (selected(&hair, &HEAD, selection), selected(&hair, &HEAD, &other));
        let mean = |chosen: &[bool]| {
            let roots = hair.guides().iter().zip(chosen).filter(|(_, chosen)| **chosen);
            let (sum, n) = roots.fold((DVec3::ZERO, 0.0), |(sum, n), (guide, _)| {
                (sum + guide.root.position, n + 1.0)
            });
            sum / n
        };
        let (here, there) = (mean(&here.unwrap()), mean(&there.unwrap()));
        // The roots themselves are not symmetric: 150 of them are 2 cm apart.
        assert!(
            (here.x + there.x).abs() < 0.01 && (here - there).with_x(0.0).length() < 0.01,
            "{here} {there}"
        );
    }
    let (numbers, opposite) = (Selection::Wisps(vec![3, 4, 9]), |wisp| 12 - wisp / 2 * 2);
    assert_eq!(numbers.mirrored(&opposite), Selection::Wisps(vec![4, 8, 10]));
}

#[test]
fn layers_are_as_long_as_the_line_is_far_from_the_skin() {
    let before = hairstyle("caucasian-straight", 60);
    let cut = |line: CutLine, held: Held| {
        done(
            &before,
            &Operation::Cut(Cut { selection: Selection::Everything, line, held, ..Cut::default() }),
        )
    };
    let out = Held::Elevated(std::f64::consts::FRAC_PI_2);
    let lengths = |h: &Hairstyle| h.wisps().iter().map(|w| w.length).collect::<Vec<_>>();
    for length in lengths(&cut(CutLine::OffSkin(0.08), out)) {
        // Straight out of the skin, but where it is hollow.
        assert!((0.0799..0.13).contains(&length), "{length}");
    }
    assert!(lengths(&cut(CutLine::Length(0.08), Held::default())).iter().all(|l| *l == 0.08));
    let centre = HEAD.landmarks().cranium_centre;
    let sphere = cut(CutLine::Sphere { centre, radius: 0.2 }, out);
    for (wisp, guide) in sphere.wisps().iter().zip(sphere.guides()) {
        let end = guide.root.position + guide.root.normal * wisp.length;
        assert!((end.distance(centre) - 0.2).abs() < 1e-9 || wisp.length > 0.2);
    }
    // A stationary guide leaves hair the longer the farther it is rooted.
    let point = HEAD.landmarks().whorl + DVec3::Z * 0.1;
    let gathered = cut(CutLine::Gathered(point), Held::default());
    for (wisp, guide) in gathered.wisps().iter().zip(before.guides()) {
        let expected = guide.root.position.distance(point).min(guide.rod.length());
        assert!((wisp.length - expected).abs() < 1e-12);
    }
}

#[test]
fn a_cut_takes_what_is_below_and_cutting_again_takes_nothing() {
    let before = hairstyle("caucasian-wavy", 60);
    let line = 0.02;
    let above = Selection::Beyond { point: DVec3::Z * (line + 0.01), normal: DVec3::Z };
    let cut = cut_below(line, above.clone());
    let after = done(&before, &cut);
    let chosen = selected(&before, &HEAD, &above).unwrap();
    let each = before.grown() / 60.0;
    let mut removed = 0.0;
    for (i, chosen) in chosen.iter().enumerate() {
        let (old, new) = (&before.guides()[i], &after.guides()[i]);
        let held = old.root.position.z - line;
        let expected = if *chosen { old.rod.length().min(held) } else { old.rod.length() };
        assert!((new.rod.length() - expected).abs() < 1e-15);
        let rod = old.rod.spec();
        let thick = rod.material.density() * rod.section.area();
        removed += each * thick * (old.rod.length() - new.rod.length());
    }
    assert!((before.mass() - after.mass() - removed).abs() < 1e-12 * before.mass());
    assert!(removed > 0.1 * before.mass());
    assert!(same(&after, &done(&after, &cut)));
}

#[test]
fn a_cut_above_roots_names_the_wisps() {
    let before = hairstyle("caucasian-wavy", 30);
    let error = style(
        &before,
        &HEAD,
        &cut_below(0.05, Selection::Everything),
        StyleOptions::default(),
        &(),
    )
    .unwrap_err();
    let StyleError::AboveRoot { wisps, selected } = &error else { panic!("{error}") };
    assert_eq!(*selected, 30);
    for (i, guide) in before.guides().iter().enumerate() {
        assert_eq!(wisps.contains(&i), guide.root.position.z < 0.051);
    }
    assert!(error.to_string().contains("above the roots of"), "{error}");
}

#[test]
fn every_hair_cut_as_it_hangs_ends_at_the_line() {
    let mut spec = spec("caucasian-straight", 120, HairContact::Layers);
    spec.curl = Curl::STRAIGHT;
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let line =
        CutLine::Plane { point: DVec3::new(0.0, 0.0, -0.10), normal: DVec3::new(0.3, 0.0, -1.0) };
    let cut = Cut { selection: Selection::Everything, line, held: Held::Hanging, ..Cut::default() };
    let after = done(&before, &Operation::Cut(cut));
    let beyond = |p: DVec3| (p - DVec3::Z * -0.1).dot(DVec3::new(0.3, 0.0, -1.0).normalize());
    let (mut cut, mut at_line) = (0, 0);
    let (old, new) = (
        strands(&before, &HEAD, StrandOptions::default(), &()).unwrap().strands,
        strands(&after, &HEAD, StrandOptions::default(), &()).unwrap().strands,
    );
    for (old, new) in old.iter().zip(new.iter()) {
        let end = |points: &[glam::Vec3]| beyond(points.last().unwrap().as_dvec3());
        if end(old.points) > 0.005 {
            cut += 1;
            at_line += usize::from(end(new.points).abs() < 3e-3);
        }
    }
    // Hair that has lost weight springs up a little, and where it parts at an ear it moves more.
    assert!(cut > 100 && at_line * 10 > cut * 9, "{at_line} of {cut}");
}

/// Lengths (m) of the drawn hairs.
fn drawn_lengths(hair: &Hairstyle) -> Vec<f64> {
    let drawn = strands(hair, &HEAD, StrandOptions::default(), &()).unwrap().strands;
    let length = |points: &[glam::Vec3]| -> f64 {
        points.windows(2).map(|p| f64::from(p[0].distance(p[1]))).sum()
    };
    drawn.iter().map(|strand| length(strand.points)).collect()
}

#[test]
fn hair_that_is_trimmed_until_it_rests_ends_at_the_line() {
    // Curls spring up when what fell no longer pulls at them.
    let before = hairstyle("caucasian-curly", 60);
    let height = HEAD.landmarks().brow.z;
    let selection = Selection::Beyond { point: DVec3::Z * (height + 0.03), normal: DVec3::Z };
    let chosen = selected(&before, &HEAD, &selection).unwrap();
    let line = CutLine::Below(Height::At(height));
    let hanging = Cut { selection, line, ..Cut::default() };
    let lowest = |points: &mut dyn Iterator<Item = DVec3>| {
        points.map(|p| p.z - height).fold(f64::INFINITY, f64::min)
    };
    // Of the chosen guides that were cut: how far (m) above the line the lowest place of each rests.
    let gaps = |after: &Hairstyle| {
        let cut = |i: &usize| chosen[*i] && after.wisps()[*i].length < before.wisps()[*i].length;
        let ends = (0..60).filter(cut).map(|i| {
            let rest = &after.equilibria()[i];
            let chain = rest.chain();
            lowest(&mut (0..=200).map(|k| rest.at(&chain, f64::from(k) / 200.0).0))
        });
        let mut ends: Vec<f64> = ends.collect();
        ends.sort_by(f64::total_cmp);
        ends
    };
    let once = gaps(&done(&before, &Operation::Cut(hanging.clone())));
    let resting = done(&before, &Operation::Cut(Cut { resting: true, ..hanging }));
    let trimmed = gaps(&resting);
    assert!(once.len() > 10 && trimmed.len() > 10, "{once:?} {trimmed:?}");
    assert!(once[once.len() / 2] > 5e-3, "curls spring up: {once:?}");
    let near = trimmed.iter().filter(|gap| gap.abs() < 1e-3).count();
    assert!(near * 10 >= trimmed.len() * 8, "{trimmed:?}");
    // Each drawn hair of theirs ends at the line or before it, but for the spacing of drawn points.
    let drawn = strands(&resting, &HEAD, StrandOptions::default(), &()).unwrap().strands;
    let Some(AttributeValues::U32(guide)) = drawn.attribute("guide").map(|a| &a.values) else {
        panic!("hairs say their guides")
    };
    for (hair, guide) in drawn.iter().zip(guide).filter(|(_, guide)| chosen[**guide as usize]) {
        let gap = lowest(&mut hair.points.iter().map(|p| p.as_dvec3()));
        assert!(gap > -2e-3, "{guide}: {gap}");
    }
}

#[test]
fn point_cutting_ends_hairs_evenly_up_to_a_depth_before_the_line() {
    // What hairs stray makes their drawn lines longer.
    let mut even = spec("caucasian-straight", 60, HairContact::Layers);
    even.wisps.fuzziness = 0.0;
    let before = predict(&even, &HEAD, PredictOptions::default(), &()).unwrap();
    let line = CutLine::Length(0.12);
    let blunt = Cut { line, ..Cut::default() };
    let soft = Cut { point_cut: 0.03, ..blunt.clone() };
    let cut = |cut: &Cut| done(&before, &Operation::Cut(cut.clone()));
    let (blunt, soft) = (cut(&blunt), cut(&soft));
    // The guides are the same.
    for (a, b) in blunt.equilibria().iter().zip(soft.equilibria()) {
        assert_eq!(a.shape, b.shape);
    }
    let ends: Vec<f64> = (drawn_lengths(&blunt).iter().zip(drawn_lengths(&soft)))
        // Where guides part the lines between them are longer than hairs are.
        .filter(|(blunt, _)| (0.119..0.122).contains(*blunt))
        .map(|(blunt, soft)| blunt - soft)
        .collect();
    // A drawn hair is a curve through points, which is not quite as long as the hair.
    assert!(ends.len() > 100 && ends.iter().all(|x| (-5e-4..0.0305).contains(x)), "{ends:?}");
    let mean = ends.iter().sum::<f64>() / ends.len() as f64;
    // Uniform: the mean of n hairs is within three standard errors, 0.03/√(12 n).
    assert!((mean - 0.015).abs() < 3.0 * 0.03 / (12.0 * ends.len() as f64).sqrt(), "{mean}");
}

#[test]
fn thinning_cuts_its_share_of_the_hairs_and_other_hairs_the_next_time() {
    let before = hairstyle("caucasian-straight", 60);
    let thin = Cut { line: CutLine::Length(0.1), share: 0.4, ..Cut::default() };
    let thin = Operation::Cut(thin);
    let once = done(&before, &thin);
    let twice = done(&once, &thin);
    for (a, b) in before.guides().iter().zip(twice.guides()) {
        assert_eq!(a.rod, b.rod);
    }
    let long = drawn_lengths(&before);
    let share = |hair: &Hairstyle| {
        let now = drawn_lengths(hair);
        let long = long.iter().zip(&now).filter(|(before, _)| **before > 0.12);
        let (count, cut) = long.fold((0.0, 0.0), |(count, cut), (_, now)| {
            (count + 1.0, cut + f64::from(u8::from(*now < 0.115)))
        });
        cut / count
    };
    // 300 hairs: three standard deviations of a share are 0.085.
    let (first, second) = (share(&once), share(&twice));
    assert!((first - 0.4).abs() < 0.085 && (second - 0.64).abs() < 0.085, "{first} {second}");
}

#[test]
fn hair_that_grew_and_is_cut_back_lies_as_before() {
    let mut spec = spec("caucasian-wavy", 40, HairContact::Layers);
    spec.length.variation_between = 0.0;
    spec.length.mean = 0.12;
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let grown = done(&before, &grow(Growth::By(0.04)));
    assert!(farthest_tip(&before, &grown) > 0.02);
    let cut = Cut { line: CutLine::Length(0.12), ..Cut::default() };
    let after = done(&grown, &Operation::Cut(cut));
    for (a, b) in before.guides().iter().zip(after.guides()) {
        assert_eq!(a.rod, b.rod);
    }
    let mut moved: Vec<f64> = before
        .equilibria()
        .iter()
        .zip(after.equilibria())
        .map(|(a, b)| a.tip().distance(b.tip()))
        .collect();
    moved.sort_by(f64::total_cmp);
    // All but those that an ear has caught meanwhile.
    assert!(moved[35] < 1e-6, "{moved:?}");
}

#[test]
fn bad_operations_are_refused() {
    let before = hairstyle("straight", 10);
    let refused = |operation: &Operation| {
        style(&before, &HEAD, operation, StyleOptions::default(), &()).unwrap_err()
    };
    let nobody = Selection::Not(Box::new(Selection::Everything));
    assert_eq!(
        refused(&Operation::Wet(Wet { selection: nobody, ..Wet::default() })),
        StyleError::NothingSelected
    );
    let tenth = Selection::Wisps(vec![10]);
    assert_eq!(
        refused(&Operation::Release(Release { selection: tenth })),
        StyleError::NoSuchWisp { wisp: 10, count: 10 }
    );
    for wetness in [-0.1, 1.1, f64::NAN] {
        let wet = Operation::Wet(Wet { to: wetness, ..Wet::default() });
        assert!(matches!(refused(&wet), StyleError::Invalid(_)));
    }
    let error = refused(&grow(Growth::By(2.9)));
    assert!(matches!(error, StyleError::TooLong { wisp: 0, .. }));
    let words = error.to_string();
    let (_, metres) = words.split_once("would grow to ").unwrap();
    assert_eq!(metres.find(" m;"), Some(4), "two decimals: {words}");
}

#[test]
fn hair_grows_to_the_longest_that_is_computed_and_no_wisp_beyond() {
    let mut spec = spec("straight", 6, HairContact::None);
    spec.contact.body = Body::None;
    spec.length.mean = 2.9;
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let length = |h: &Hairstyle, i: usize| h.equilibria()[i].rod.length();
    // Lengths vary from wisp to wisp: some would grow beyond, and some are longer already.
    assert!((0..6).any(|i| length(&before, i) > 2.9 && length(&before, i) < 3.0));
    let after = done(&before, &grow(Growth::To(3.0)));
    for i in 0..6 {
        let (old, new) = (length(&before, i), length(&after, i));
        let longest = f64::min(3.0 / 2.9 * old, 3.0);
        assert!((new - longest.max(old)).abs() < 1e-9, "{i}: {old} to {new} m");
    }
}

#[test]
fn hair_that_is_dried_in_a_shape_keeps_part_of_it_until_it_is_wet_again() {
    let before = hairstyle("caucasian-straight", 20);
    let roll = Roll { selection: Selection::Everything, radius: 0.012, pitch: 0.005 };
    let release = Operation::Release(Release { selection: Selection::Everything });
    let rolled =
        done(&done(&done(&done(&before, &wet()), &Operation::Roll(roll)), &dry()), &release);
    let spanned = |h: &Hairstyle| {
        let each = h.guides().iter().zip(h.equilibria());
        each.map(|(g, r)| r.tip().distance(g.root.position)).sum::<f64>()
    };
    assert!(
        spanned(&rolled) < 0.95 * spanned(&before),
        "{} {}",
        spanned(&rolled),
        spanned(&before)
    );
    let again = done(&done(&rolled, &wet()), &dry());
    assert_eq!(again.guides()[3].rod, before.guides()[3].rod);
}

/// A straight hair style without gravity and contact, in which a shape is what holds it.
fn weightless(wisps: usize) -> Hairstyle {
    let mut spec = spec("caucasian-straight", wisps, HairContact::None);
    spec.gravity = 0.0;
    spec.contact.body = Body::None;
    spec.curl.strain = DVec3::ZERO;
    predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap()
}

#[test]
fn a_lock_in_a_twist_is_the_helix_of_a_quarter_of_its_width() {
    let (width, pitch) = (0.012, 0.03);
    let twist = Twist { width, pitch, ..Twist::default() };
    let twisted = done(&weightless(6), &twist.into());
    // A helix of radius r and pitch P has the curvature r / (r² + c²) and the torsion c / (r² + c²), c = P / 2π,
    // and a turn is 2π √(r² + c²) long.
    let (r, c) = (0.25 * width, pitch / std::f64::consts::TAU);
    let square = r * r + c * c;
    for (guide, rest) in twisted.guides().iter().zip(twisted.equilibria()) {
        let strain = guide.rod.spec().natural.at(0.1);
        assert!((strain.truncate().length() * square / r - 1.0).abs() < 1e-9);
        assert!((strain.z * square / c - 1.0).abs() < 1e-9);
        let length = guide.rod.length();
        let turn = std::f64::consts::TAU * square.sqrt() / length;
        let chain = rest.chain();
        let at = |x: f64| rest.at(&chain, x).0;
        for start in [0.0, 0.3, 0.9 - turn] {
            let whole = at(start).distance(at(start + turn));
            let half = at(start).distance(at(start + 0.5 * turn));
            assert!((whole / pitch - 1.0).abs() < 0.01, "{whole}");
            assert!((half / (0.5 * pitch).hypot(2.0 * r) - 1.0).abs() < 0.01, "{half}");
        }
    }
}

#[test]
fn a_twist_out_keeps_the_share_of_the_twist_that_it_was_dried_with() {
    let before = weightless(4);
    let (width, pitch, keep) = (0.012, 0.03, 0.6);
    let twist = Twist { width, pitch, ..Twist::default() };
    let release = Operation::Release(Release { selection: Selection::Everything });
    let dry = Operation::Dry(Dry { keep, ..Dry::default() });
    let steps = [wet(), twist.into(), dry, release];
    let after = steps.iter().fold(before.clone(), |hair, step| done(&hair, step));
    let (r, c) = (0.25 * width, pitch / std::f64::consts::TAU);
    let curvature = r / (r * r + c * c);
    for guide in after.guides() {
        let strain = guide.rod.spec().natural.at(0.5 * guide.rod.length());
        // The frames that the shape is taken between are a millimetre apart.
        let kept = strain.truncate().length() / curvature;
        assert!((kept / keep - 1.0).abs() < 0.02, "{kept}");
    }
    // Water opens it again.
    let again = done(&done(&after, &wet()), &Operation::Dry(Dry::default()));
    assert_eq!(again.guides()[2].rod, before.guides()[2].rod);
}

#[test]
fn damp_air_softens_hair_and_dry_air_stiffens_it() {
    let before = hairstyle("caucasian-curly", 10);
    let stiffness = |relative: f64| {
        let after = done(&before, &Operation::Humidity(Humidity { relative }));
        after.guides()[0].rod.spec().material.youngs_modulus()
    };
    assert_eq!(stiffness(0.6), before.guides()[0].rod.spec().material.youngs_modulus());
    assert!(stiffness(0.9) < stiffness(0.6) && stiffness(0.6) < stiffness(0.2));
}

/// Mean natural curvature (1/m) of guides as they are.
fn curvature(hair: &Hairstyle) -> f64 {
    let of = |g: &frisure_hairstyle::Guide| {
        let at = |k| g.rod.natural().at(g.rod.length() * f64::from(k) / 50.0).truncate().length();
        (0..=50).map(at).sum::<f64>() / 51.0
    };
    hair.guides().iter().map(of).sum::<f64>() / hair.guides().len() as f64
}

#[test]
fn damp_air_takes_of_a_set_for_good() {
    let before = hairstyle("caucasian-straight", 6);
    let air = |h: &Hairstyle, relative| done(h, &Operation::Humidity(Humidity { relative }));
    let everything = Selection::Everything;
    let set = |h: &Hairstyle| {
        let roll =
            Operation::Roll(Roll { radius: 0.01, pitch: 0.0, selection: everything.clone() });
        let release = Operation::Release(Release { selection: everything.clone() });
        done(&done(&done(&done(h, &wet()), &roll), &dry()), &release)
    };
    let rolled = set(&before);
    let [natural, curled] = [&before, &rolled].map(curvature);
    assert!(curled > natural + 0.5 / 0.01, "{natural} {curled}");
    let left = |h: &Hairstyle| (curvature(h) - natural) / (curled - natural);
    // Drier air takes nothing; damp air takes what it opens, and gives nothing back.
    assert!((left(&air(&rolled, 0.3)) - 1.0).abs() < 0.01);
    let damp = air(&rolled, 0.9);
    let share = left(&air(&damp, 0.6));
    assert!((share - (1.0 - Moisture::in_air(0.9).open())).abs() < 0.03, "{share}");
    // By way of less damp air it is the same.
    let slowly = air(&air(&air(&rolled, 0.75), 0.9), 0.6);
    assert!((left(&slowly) - share).abs() < 1e-6, "{} {share}", left(&slowly));
    assert!(left(&air(&air(&rolled, 1.0), 0.6)).abs() < 1e-9);
    // Hair that dries in damp air sets no more than is left of a set there.
    let set_in_damp = air(&set(&air(&before, 0.9)), 0.6);
    assert!((left(&set_in_damp) - share).abs() < 0.03, "{} {share}", left(&set_in_damp));
}

#[test]
fn combed_hair_falls_to_an_equilibrium_that_need_not_be_the_old_one() {
    let before = hairstyle("caucasian-straight", 80);
    let sides = Selection::Place(Place::Region(Region::Sides));
    let comb = |hold: bool| {
        let (selection, towards) = (sides.clone(), Direction::Named(frisure_hairstyle::Comb::Back));
        Operation::Comb(Comb { selection, towards, strength: 4.0, hold })
    };
    let held = done(&before, &comb(true));
    let free = done(&before, &comb(false));
    let chosen = selected(&before, &HEAD, &sides).unwrap();
    let back = |h: &Hairstyle| {
        let tips = h.equilibria().iter().zip(&chosen).filter(|(_, chosen)| **chosen);
        tips.map(|(r, _)| r.tip().y).sum::<f64>()
    };
    assert!(back(&held) > back(&free) && back(&free) > back(&before));
    let (report, fallen) = (settling_report(&free, &HEAD), farthest_tip(&before, &free));
    assert!(report.not_converged == 0 && fallen > 0.03, "{report:?} {fallen}");
    // Let go later, it falls to the same.
    let released = done(&held, &Operation::Release(Release { selection: sides.clone() }));
    assert!(farthest_tip(&released, &free) < 1e-9);
    // What was not combed did not move.
    let others = before.equilibria().iter().zip(free.equilibria()).zip(&chosen);
    assert!(others.filter(|(_, chosen)| !**chosen).all(|((a, b), _)| a.shape == b.shape));
}

#[test]
fn a_clip_holds_hair_where_it_is_put() {
    let before = hairstyle("caucasian-straight", 80);
    let wisp = (0..80).find(|&i| before.guides()[i].region == Region::Sides).unwrap();
    let to = HEAD.landmarks().whorl + DVec3::new(0.0, 0.03, 0.03);
    let clip = Clip { selection: Selection::Wisps(vec![wisp]), at: 1.0, to };
    let clipped = done(&before, &Operation::Clip(clip));
    let distance = clipped.equilibria()[wisp].tip().distance(to);
    assert!(distance < 0.01, "{distance}");
    assert_eq!(settling_report(&clipped, &HEAD).not_converged, 0);
}

#[test]
fn a_braided_tail_crosses_from_side_to_side_and_lies_on_the_back() {
    let tie = Operation::Tie(Tie { to: TiePlace::Low, braided: true, ..Tie::default() });
    let mut long = spec("caucasian-straight", 30, HairContact::Layers);
    long.length.mean = 0.5;
    let before = predict(&long, &HEAD, PredictOptions::default(), &()).unwrap();
    let braided = done(&before, &tie);
    let held: Vec<usize> = (0..30).filter(|&i| braided.wisps()[i].is_held()).collect();
    assert!(held.len() >= 27, "{held:?}");
    let report = settling_report(&braided, &HEAD);
    assert!(report.stable == 30 && report.penetration < 2e-3, "{report:?}");
    // Below the tie, at each height: the places across of all wisps, and their mean.
    let (top, bottom) = (-0.14, -0.24);
    let lines = held.iter().map(|&i| braided.equilibria()[i].centre_line(400));
    let lines: Vec<_> = lines.filter(|line| line.last().is_some_and(|p| p.z < bottom)).collect();
    assert!(lines.len() >= 20, "{} long tails", lines.len());
    let at = |line: &[DVec3], z: f64| {
        let from = line.iter().rposition(|p| p.z > z)?;
        line.get(from + 1).map(|p| p.x)
    };
    let heights = (0..60).map(|i| top + (bottom - top) * f64::from(i) / 59.0);
    let across: Vec<Vec<f64>> = heights
        .map(|z| lines.iter().map(|line| at(line, z).expect("a long tail")).collect())
        .collect();
    let mut crossings = 0;
    for wisp in 0..lines.len() {
        let off = |row: &Vec<f64>| row[wisp] - row.iter().sum::<f64>() / row.len() as f64;
        let signs: Vec<bool> = across.iter().map(|row| off(row) > 0.0).collect();
        crossings += signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
    }
    assert!(crossings >= 2 * lines.len(), "{crossings} crossings of {} wisps", lines.len());
    // The braid is as narrow as three locks.
    let width = across.iter().map(|row| {
        let most = row.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        most - row.iter().copied().fold(f64::INFINITY, f64::min)
    });
    let width = width.fold(0.0, f64::max);
    assert!(width > 0.01 && width < 0.06, "{width}");
    let free = done(&braided, &Operation::Release(Release::default()));
    assert!(!free.wisps().iter().any(WispState::is_held));
    // Hair that reaches the tie, and ends in it.
    let mut short = spec("caucasian-straight", 20, HairContact::Layers);
    short.length.mean = 0.22;
    let short = predict(&short, &HEAD, PredictOptions::default(), &()).unwrap();
    let error = style(&short, &HEAD, &tie, StyleOptions::default(), &()).map(|_| ()).unwrap_err();
    assert!(matches!(error, StyleError::TooShortToBraid { .. }), "{error}");
}

#[test]
fn a_tie_gathers_what_is_long_enough_and_lets_it_go_again() {
    let tie =
        |to: TiePlace| Operation::Tie(Tie { selection: Selection::Everything, to, braided: false });
    let mut long = spec("caucasian-straight", 40, HairContact::Layers);
    long.length.mean = 0.4;
    let before = predict(&long, &HEAD, PredictOptions::default(), &()).unwrap();
    let centre = HEAD.landmarks().cranium_centre;
    for to in [TiePlace::High, TiePlace::Middle, TiePlace::Low, TiePlace::Left] {
        let tied = done(&before, &tie(to));
        // The head is in the way of a few, of more where hair comes from the other side: they stay out.
        let held = tied.wisps().iter().filter(|wisp| wisp.is_held()).count();
        let least = if to == TiePlace::Left { 30 } else { 37 };
        assert!(held >= least, "{to:?}: {held}");
        let report = settling_report(&tied, &HEAD);
        assert_eq!(report.stable, 40, "{to:?}");
        assert!(report.penetration < 2e-3, "{to:?}: {}", report.penetration);
        // Wisps pass through a bundle of some centimetres off the head.
        let lines: Vec<_> = tied.equilibria().iter().map(|e| e.centre_line(200)).collect();
        let through = |p: DVec3, reach: f64| {
            lines.iter().filter(|line| line.iter().any(|q| q.distance(p) < reach)).count()
        };
        let middle = lines
            .iter()
            .flatten()
            .copied()
            .max_by(|a, b| through(*a, 0.02).cmp(&through(*b, 0.02)).then(a.x.total_cmp(&b.x)));
        let middle = middle.unwrap();
        assert!(through(middle, 0.035) >= held, "{to:?}: {}", through(middle, 0.035));
        // Where it was asked for: behind the head, on the left …
        let behind = (middle - centre).dot(HEAD.landmarks().face);
        assert!(behind < 0.0, "{to:?}: {middle}");
        if to == TiePlace::Left {
            assert!(middle.x > 0.05, "{middle}");
        }
    }
    let high = done(&before, &tie(TiePlace::High));
    let free = done(&high, &Operation::Release(Release::default()));
    assert!(!free.wisps().iter().any(WispState::is_held));
    // Short hair does not reach it, and the error says what it takes.
    let mut short = spec("caucasian-straight", 20, HairContact::Layers);
    short.length.mean = 0.01;
    let short = predict(&short, &HEAD, PredictOptions::default(), &()).unwrap();
    let error = style(&short, &HEAD, &tie(TiePlace::High), StyleOptions::default(), &());
    let error = error.map(|_| ()).unwrap_err();
    let StyleError::NothingGathered { needed, longest } = error else { panic!("{error}") };
    assert!(longest < needed);
}

#[test]
fn tucked_hair_is_behind_the_ear_and_friction_keeps_some_of_it_there() {
    let mut spec = spec("caucasian-straight", 80, HairContact::Layers);
    spec.length.mean = 0.3;
    // Without friction it slips off the ear again.
    (spec.contact.friction, spec.contact.skin_friction) = (0.47, 0.47);
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let tuck =
        |sides, hold| done(&before, &Operation::Tuck(Tuck { sides, hold, ..Tuck::default() }));
    let land = HEAD.landmarks();
    // Where a guide on the left passes the height of the ear: in front of its middle, or behind it (m).
    let ahead = |h: &Hairstyle, i: usize| {
        let line = h.equilibria()[i].centre_line(400);
        let at = line.iter().find(|p| p.z < land.ear.z)?;
        Some((*at - land.ear).dot(land.face))
    };
    let left = |i: usize| before.equilibria()[i].tip().x > land.cranium_centre.x;
    let veil: Vec<usize> =
        (0..80).filter(|&i| left(i) && ahead(&before, i).is_some_and(|x| x > 0.005)).collect();
    assert!(veil.len() >= 4, "{}", veil.len());
    let (held, free) = (tuck(Sides::Left, true), tuck(Sides::Left, false));
    // This ear is small: of what is let go friction keeps a part.
    for (name, after, most) in [("held", &held, veil.len() / 4), ("free", &free, veil.len() - 1)] {
        let still = veil.iter().filter(|&&i| ahead(after, i).is_some_and(|x| x > 0.005)).count();
        assert!(still <= most, "{name}: {still} of {} before the ear", veil.len());
        let report = settling_report(after, &HEAD);
        assert!(report.stable >= 79 && report.penetration < 1e-3, "{name}: {report:?}");
    }
    assert!(held.wisps().iter().any(WispState::is_held));
    assert!(!free.wisps().iter().any(WispState::is_held));
    let right = (0..80).filter(|&i| before.equilibria()[i].tip().x < -0.02);
    let moved = right.map(|i| free.equilibria()[i].tip().distance(before.equilibria()[i].tip()));
    assert!(moved.fold(0.0, f64::max) < 1e-9, "the right side stays");
}

#[test]
fn a_new_parting_sends_hair_to_both_sides_of_it() {
    let before = hairstyle("caucasian-straight", 300);
    let offset = -0.03;
    let parted = done(&before, &Operation::Part(Part { line: Parting::Straight { offset } }));
    // Hair rooted between the middle and the parting on the right falls to the left now.
    let top =
        |h: &Hairstyle, i: usize| matches!(h.guides()[i].region, Region::Top | Region::Fringe);
    let between = (0..300).filter(|&i| {
        let x = before.guides()[i].root.position.x;
        top(&before, i) && x > offset + 0.005 && x < -0.005
    });
    let aside = |h: &Hairstyle| {
        let tips = between.clone().map(|i| h.equilibria()[i].tip().x);
        (tips.clone().filter(|x| *x > 0.0).count(), tips.count())
    };
    let ((left_before, _), (left_after, all)) = (aside(&before), aside(&parted));
    assert!(
        all >= 9 && left_after > left_before && 3 * left_after >= 2 * all,
        "{left_before} {left_after} {all}"
    );
    for (a, b) in before.guides().iter().zip(parted.guides()) {
        assert_eq!((a.rod.length(), a.rod.stiffness()), (b.rod.length(), b.rod.stiffness()));
    }
}

#[test]
fn what_is_done_to_different_wisps_can_be_done_in_any_order() {
    let before = hairstyle("caucasian-wavy", 60);
    let place = |region| Selection::Place(Place::Region(region));
    let wet = Operation::Wet(Wet { selection: place(Region::Back), ..Wet::default() });
    let cut = cut_below(0.045, place(Region::Fringe));
    let (a, b) = (done(&done(&before, &wet), &cut), done(&done(&before, &cut), &wet));
    assert!(same(&a, &b));
    // Wet hair is longer: what is left of it is shorter than of dry hair.
    let dry_first = done(&before, &cut_below(0.045, place(Region::Top)));
    let wet_first = done(&done(&before, &self::wet()), &cut_below(0.045, place(Region::Top)));
    let shorter = dry_first.wisps().iter().zip(wet_first.wisps());
    assert!(shorter.clone().all(|(dry, wet)| wet.length <= dry.length));
    assert!(shorter.clone().any(|(dry, wet)| wet.length < dry.length));
}

#[test]
fn hair_grows_at_its_own_rate_and_the_same_in_any_number_of_stages() {
    let before = hairstyle("caucasian-straight", 12);
    let month = 30.0 * 86_400.0;
    let grown = done(&before, &grow(Growth::For(month)));
    let by = month * before.spec().length.growth_rate;
    assert!((0.008..0.015).contains(&by), "about a centimetre a month: {by}");
    for (a, b) in before.wisps().iter().zip(grown.wisps()) {
        assert!((b.length - a.length - by).abs() < 1e-12);
    }
    let (selection, amount) = (Selection::Everything, Growth::For(month));
    let mut film = Vec::new();
    let options = StyleOptions { stages: Some(&mut film), ..StyleOptions::default() };
    let in_stages = Operation::Grow(Grow { selection, amount, stages: 4 });
    let last = style(&before, &HEAD, &in_stages, options, &()).unwrap();
    assert_eq!(film.len(), 3);
    // But for a hair that slips from one resting place to another on its way.
    let tips = last.equilibria().iter().zip(grown.equilibria());
    let differ = tips.filter(|(a, b)| a.tip().distance(b.tip()) > 1e-6).count();
    assert!(differ <= 1, "{differ}");
}

#[test]
fn hair_standing_up_grows_straight_then_buckles_at_its_own_threshold() {
    // ρSgL³/EI = 7.8373 (Greenhill); a circle, so that no direction is weaker.
    let mut spec = spec("straight", 12, HairContact::None);
    spec.contact.body = Body::None;
    spec.curl = Curl::STRAIGHT;
    spec.length.mean = 0.02;
    spec.implantation.lift = frisure_hairstyle::Lift::Uniform(std::f64::consts::FRAC_PI_2);
    spec.implantation.jitter = 0.0;
    spec.fibre.section = frisure_rod::Section::from_diameter(80e-6, 1.0).unwrap();
    spec.fibre.variation = 0.0;
    let mut hair = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let up = |i: usize| hair.guides()[i].rod.root().frame().z_axis.z;
    let top = (0..12).max_by(|&a, &b| up(a).total_cmp(&up(b))).unwrap();
    let rod = &hair.guides()[top].rod;
    let threshold = (7.8373 * rod.stiffness().x / (rod.weight() * up(top))).cbrt();
    let bent = |h: &Hairstyle| {
        let (root, tip) = (h.guides()[top].rod.root(), h.equilibria()[top].tip());
        1.0 - (tip - root.position()).normalize().dot(root.frame().z_axis)
    };
    let mut before = bent(&hair);
    let mut steepest = (0.0, 0.0);
    while hair.wisps()[top].length < 1.8 * threshold {
        hair = done(&hair, &grow(Growth::By(0.002)));
        let now = bent(&hair);
        if now - before > steepest.1 {
            steepest = (hair.wisps()[top].length, now - before);
        }
        before = now;
    }
    let ratio = steepest.0 / threshold;
    assert!((0.9..1.5).contains(&ratio), "falls at {} of {threshold}", steepest.0);
}
