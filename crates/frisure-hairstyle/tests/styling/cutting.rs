//! Cutting, trimming, thinning.

use frisure_hairstyle::head::Region;
use frisure_hairstyle::styling::{
    Cut, CutLine, Growth, Height, Held, Operation, Selection, StyleError,
};
use frisure_hairstyle::{
    Curl, HairContact, Hairstyle, Place, PredictOptions, StrandOptions, StyleOptions, predict,
    selected, strands, style,
};
use frisure_strands::AttributeValues;
use glam::DVec3;

use crate::{HEAD, cut_below, done, dry, hairstyle, same, spec, wet};

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
fn what_thinning_cuts_off_has_a_mass() {
    let before = hairstyle("caucasian-straight", 60);
    let thin = Cut { line: CutLine::Length(0.05), share: 0.6, ..Cut::default() };
    let thinned = done(&before, &Operation::Cut(thin));
    let length = |hair: &Hairstyle| {
        let sum: f64 = hair.guides().iter().map(|guide| guide.rod.length()).sum();
        sum / hair.guides().len() as f64
    };
    // Six in ten have 5 cm; by the luck of 300 hairs 0.085 more or fewer of them.
    let left = 1.0 - 0.6 * (1.0 - 0.05 / length(&before));
    assert!((thinned.mass() / before.mass() - left).abs() < 0.085, "{left}");
    assert!(before.left_by_thinning().iter().all(|left| *left == 1.0));
    // A cut that is shorter leaves all hairs alike, and a cut that is longer none of the short ones.
    let to = |length: f64| Operation::Cut(Cut { line: CutLine::Length(length), ..Cut::default() });
    let short = done(&thinned, &to(0.04));
    assert!((short.mass() / done(&before, &to(0.04)).mass() - 1.0).abs() < 1e-12);
    let ten = done(&thinned, &to(0.1));
    let left = 1.0 - 0.6 * (1.0 - 0.05 / 0.1);
    assert!((ten.mass() / done(&before, &to(0.1)).mass() - left).abs() < 0.05, "{left}");
    // All grow by as much.
    let grown = done(&thinned, &crate::grow(Growth::By(0.02)));
    let uncut = done(&before, &crate::grow(Growth::By(0.02)));
    let lost = |long: &Hairstyle, short: &Hairstyle| long.mass() - short.mass();
    assert!((lost(&uncut, &grown) / lost(&before, &thinned) - 1.0).abs() < 1e-6);
}

#[test]
fn a_cut_changes_no_hair_that_it_does_not_reach() {
    for name in ["caucasian-straight", "caucasian-curly"] {
        let before = hairstyle(name, 30);
        let line = CutLine::Length(2.0);
        let cut = done(&before, &Operation::Cut(Cut { line, ..Cut::default() }));
        assert!(same(&before, &cut), "{name}");
        // Of a part of the hair, the others keep their lengths: what follows guides on both sides is drawn at most an eighth longer than it is.
        let nape = Selection::Place(Place::Region(Region::Nape));
        let line = CutLine::Length(0.05);
        let cut = done(&before, &Operation::Cut(Cut { selection: nape, line, ..Cut::default() }));
        let lengths = drawn_lengths(&before).into_iter().zip(drawn_lengths(&cut));
        assert!(lengths.clone().any(|(before, after)| after < before - 0.01), "{name}");
        for (before, after) in lengths {
            assert!(after < 1.13 * before + 1e-3, "{name}: {before} {after}");
        }
    }
}

#[test]
fn drawn_hairs_cut_to_a_length_are_no_longer_than_that() {
    for name in ["caucasian-straight", "caucasian-curly", "african-coily"] {
        let before = hairstyle(name, 40);
        let line = CutLine::Length(0.1);
        let cut = done(&before, &Operation::Cut(Cut { line, ..Cut::default() }));
        let lengths = drawn_lengths(&cut);
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        // Lines between the points of a hair, and what skin moves it aside.
        assert!(longest < 0.103, "{name}: {longest}");
        let cut = lengths.iter().filter(|length| **length > 0.095).count();
        assert!(2 * cut > lengths.len(), "{name}: {cut} of {}", lengths.len());
    }
}
