//! Combing, clips, ties, tucks and partings.

use frisure_hairstyle::head::Region;
use frisure_hairstyle::styling::{
    Clip, Comb, Direction, Operation, Part, Release, Selection, Sides, StyleError, Tie, TiePlace,
    Tuck, WispState,
};
use frisure_hairstyle::{
    HairContact, Hairstyle, HairstyleSpec, Parting, Place, Pose, PredictOptions, StyleOptions,
    predict, selected, settling_report, style,
};
use frisure_rod::Equilibrium;
use glam::DVec3;

use crate::{HEAD, done, farthest_tip, hairstyle, spec};

#[test]
fn combed_hair_falls_to_an_equilibrium_that_need_not_be_the_old_one() {
    let before = hairstyle("caucasian-straight", 80);
    let sides = Selection::Place(Place::Region(Region::Sides));
    let comb = |hold: bool| {
        let (selection, towards) = (sides.clone(), Direction::Named(frisure_hairstyle::Comb::Back));
        Operation::Comb(Comb { selection, towards, strength: 4.0, hold, ..Comb::default() })
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

/// Hair is drawn to where the comb stops, and what is beyond it hangs.
#[test]
fn hair_beyond_a_comb_that_stops_hangs_free() {
    let before = hairstyle("caucasian-straight", 40);
    let sides = Selection::Place(Place::Region(Region::Sides));
    let comb = |until| {
        let towards = Direction::Along(DVec3::Y);
        let (selection, hold) = (sides.clone(), true);
        done(&before, &Comb { selection, towards, until, hold, ..Comb::default() }.into())
    };
    let crown = HEAD.landmarks().whorl;
    let (through, stopped) = (comb(None), comb(Some(crown)));
    let chosen = selected(&before, &HEAD, &sides).unwrap();
    let mut seen = 0;
    for wisp in (0..40).filter(|&i| chosen[i]) {
        let [through, stopped, before] =
            [&through, &stopped, &before].map(|h| h.equilibria()[wisp].centre_line(101));
        let length = through.windows(2).map(|pair| pair[0].distance(pair[1])).sum::<f64>();
        let comb = crown.distance(before[0]) / length;
        if comb > 0.6 {
            continue;
        }
        // The last tenth: as it hangs without a comb, and not along it.
        let end = |line: &[DVec3]| (line[100] - line[90]).normalize();
        assert!(end(&through).y > 0.8 && end(&stopped).z < -0.9, "{wisp}: {:?}", end(&stopped));
        // Before the comb it is drawn back.
        let middle = (50.0 * comb) as usize;
        assert!(stopped[middle].y > before[middle].y + 2e-3, "{wisp}");
        seen += 1;
    }
    assert!(seen > 2, "{seen}");
    assert_eq!(settling_report(&stopped, &HEAD).not_converged, 0);
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
fn a_braid_hangs_along_gravity() {
    let tie = Operation::Tie(Tie { to: TiePlace::Low, braided: true, ..Tie::default() });
    for down in [DVec3::X, DVec3::Z, DVec3::new(0.0, 0.8, -0.6)] {
        let mut long = spec("caucasian-straight", 12, HairContact::Layers);
        (long.length.mean, long.pose) = (0.6, Pose::of(down).unwrap());
        let before = predict(&long, &HEAD, PredictOptions::default(), &()).unwrap();
        let braided = done(&before, &tie);
        let mean = |x: f64| {
            let sum: DVec3 = braided.equilibria().iter().map(|r| r.at(&r.chain(), x).0).sum();
            sum / braided.equilibria().len() as f64
        };
        let hangs = (mean(1.0) - mean(0.6)).normalize().dot(down);
        assert!(hangs > 0.8, "{down}: {hangs}");
    }
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
        // It leaves the head as one: hair in the tie runs the same way, whichever side it comes from.
        let ways = tied.wisps().iter().zip(tied.equilibria()).filter_map(|(wisp, rest)| {
            let (at, _) = wisp.clipped()?;
            let (chain, tie) = (rest.chain(), 0.012 / rest.rod.length());
            let along = |s: f64| rest.at(&chain, s).0;
            Some((along((at + tie).min(1.0)) - along(at)).normalize())
        });
        let ways: Vec<DVec3> = ways.collect();
        let mean = ways.iter().sum::<DVec3>().normalize();
        let aside = ways.iter().filter(|way| way.angle_between(mean) > 0.5).count();
        assert!(10 * aside <= ways.len(), "{to:?}: {aside} of {}", ways.len());
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
    let StyleError::NothingGathered { needed, length } = error else { panic!("{error}") };
    assert!(length < needed && (length - 0.01).abs() < 5e-3, "{length} {needed}");
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
fn hair_is_not_held_inside_the_head() {
    let before = hairstyle("caucasian-straight", 10);
    let inside = HEAD.landmarks().cranium_centre;
    let tie = Tie { selection: Selection::Everything, to: TiePlace::At(inside), braided: false };
    let clip = Clip { to: inside, ..Clip::default() };
    for operation in [Operation::Tie(tie), Operation::Clip(clip)] {
        let refused = style(&before, &HEAD, &operation, StyleOptions::default(), &());
        let Err(StyleError::InsideHead { depth, skin }) = refused.map(|_| ()) else {
            panic!("{operation:?} is done")
        };
        assert!(depth > 0.05, "{depth}");
        assert!(HEAD.signed_distance().value(skin).abs() < 1e-3, "{skin}");
        // Where the error says, it goes.
        let clip = Operation::Clip(Clip { to: skin, ..Clip::default() });
        assert!(style(&before, &HEAD, &clip, StyleOptions::default(), &()).is_ok());
    }
}

#[test]
fn wisps_without_thickness_are_those_of_a_thickness_of_nothing() {
    let at = |volume: f64| {
        let mut spec = spec("caucasian-wavy", 6, HairContact::Density);
        spec.contact.volume = volume;
        predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap()
    };
    let [none, hardly] = [at(0.0), at(1e-320)];
    let tips =
        |hair: &Hairstyle| hair.equilibria().iter().map(Equilibrium::tip).collect::<Vec<_>>();
    assert_eq!(tips(&none), tips(&hardly));
}

#[test]
fn a_second_tie_takes_hair_out_of_the_first_whether_it_reaches_or_not() {
    let tie = |to: TiePlace| Operation::Tie(Tie { to, ..Tie::default() });
    let mut spec = spec("caucasian-straight", 40, HairContact::Layers);
    spec.length.mean = 0.25;
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let high = done(&before, &tie(TiePlace::High));
    let low = done(&high, &tie(TiePlace::Low));
    let once = done(&before, &tie(TiePlace::Low));
    let held = |h: &Hairstyle| -> Vec<bool> { h.wisps().iter().map(WispState::is_held).collect() };
    let differ = held(&low).iter().zip(held(&once)).filter(|(a, b)| **a != *b).count();
    assert!(differ <= 2, "{differ}");
    // Nothing is left at the first place.
    let old: Vec<DVec3> = high.wisps().iter().filter_map(|w| Some(w.clipped()?.1)).collect();
    for wisp in low.wisps() {
        assert!(wisp.clipped().is_none_or(|(_, at)| old.iter().all(|p| p.distance(at) > 0.03)));
    }
}

#[test]
fn a_tie_draws_coils_straight_and_holds_without_weight() {
    let tie = |spec: &HairstyleSpec| {
        let before = predict(spec, &HEAD, PredictOptions::default(), &()).unwrap();
        let tied = done(&before, &Operation::Tie(Tie { to: TiePlace::High, ..Tie::default() }));
        tied.wisps().iter().filter(|wisp| wisp.is_held()).count()
    };
    let mut coily = spec("african-coily", 20, HairContact::Layers);
    coily.length.mean = 0.25;
    // The head is in the way of a few.
    assert!(tie(&coily) >= 16, "{}", tie(&coily));
    let mut weightless = spec("caucasian-straight", 20, HairContact::Layers);
    (weightless.length.mean, weightless.gravity) = (0.25, 0.0);
    assert!(tie(&weightless) >= 16, "{}", tie(&weightless));
}

#[test]
fn a_clip_that_no_hair_can_reach_is_refused() {
    let before = hairstyle("straight", 10);
    let clip = |to: DVec3| Operation::Clip(Clip { to, at: 1.0, ..Clip::default() });
    let refused = |to: DVec3| {
        style(&before, &HEAD, &clip(to), StyleOptions::default(), &()).map(|_| ()).unwrap_err()
    };
    let error = refused(DVec3::Z * 2.0);
    let StyleError::NothingGathered { needed, length } = error else { panic!("{error}") };
    assert!(needed > 1.5 && length < 0.6, "{needed} {length}");
}
