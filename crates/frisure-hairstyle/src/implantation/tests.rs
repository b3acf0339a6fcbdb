use std::f64::consts::{PI, TAU};

use super::*;
use crate::head::test_shapes::mannequin as head;
use crate::presets::preset;
use crate::random::Purpose;
use crate::spec::{Comb, Hairline, Lift, Parting, Place, Turn};

fn spec(flow: Flow, change: impl FnOnce(&mut HairstyleSpec)) -> HairstyleSpec {
    let mut spec = preset("caucasian-straight").unwrap().spec();
    spec.implantation = Implantation { flow, lift: Lift::Uniform(0.5), ..Implantation::default() };
    change(&mut spec);
    spec
}

fn layout(flow: Flow, change: impl FnOnce(&mut HairstyleSpec)) -> Layout {
    Layout::new(&spec(flow, change), head()).unwrap()
}

/// The skin nearest to a point near it.
fn root(p: DVec3) -> Root {
    let (distance, away) = head().signed_distance().value_gradient(p);
    Root { position: p - away * distance, normal: away.normalize() }
}

const FLOWS: [Flow; 3] = [Flow::Whorl, Flow::Parted { offset: 0.02 }, Flow::SweptBack];

#[test]
fn hair_leaves_at_the_stated_angle_or_more_steeply() {
    let roots = Scalp::new(head()).stratified(2000, 1, Purpose::HairRoots);
    for flow in FLOWS {
        let layout = layout(flow, |_| {});
        let angles = roots.iter().map(|r| layout.direction(r).dot(r.normal).asin());
        let stated = angles.clone().filter(|a| (a - 0.5).abs() < 1e-9).count();
        assert!(angles.clone().all(|a| a > 0.5 - 1e-9), "{flow:?}");
        // It is steeper only in the eye of a whorl and where streams meet.
        assert!(stated > 1800, "{flow:?}: {stated}");
    }
}

#[test]
fn neighbouring_hair_goes_the_same_way() {
    let roots = Scalp::new(head()).stratified(20_000, 1, Purpose::HairRoots);
    let positions: Vec<DVec3> = roots.iter().map(|r| r.position).collect();
    let grid = crate::math::Grid::new(&positions, 2e-3);
    for flow in FLOWS {
        for count in [1, 2] {
            let layout = layout(flow, |s| s.implantation.whorls.count = count);
            let far = |p: DVec3| layout.whorls.iter().all(|w| w.centre.distance(p) > 0.012);
            for (i, a) in roots.iter().enumerate().filter(|(_, r)| far(r.position)) {
                for b in grid.near(a.position).filter(|&j| j > i).map(|j| &roots[j]) {
                    let apart = a.position.distance(b.position);
                    if apart > 2e-3 || layout.apart(a.position, a.position, b.position) {
                        continue;
                    }
                    let turn = layout.direction(a).angle_between(layout.direction(b));
                    let skin = a.normal.angle_between(b.normal);
                    // The ends of a parting are as sharp as the line.
                    let sharp = layout.partings.away(a.position, a.normal);
                    if sharp.is_some_and(|a| a.distance < 6e-3) {
                        continue;
                    }
                    assert!(turn < 0.45 + 2.0 * skin, "{flow:?}: {turn} at {}", a.position);
                }
            }
        }
    }
}

/// How often, and which way, the flow turns on a small circle about a point.
fn winding(layout: &Layout, centre: DVec3, radius: f64) -> f64 {
    const STEPS: i32 = 180;
    let middle = root(centre);
    let x = middle.normal.any_orthonormal_vector();
    let y = middle.normal.cross(x);
    let angle = |i: i32| {
        let (sin, cos) = (TAU * f64::from(i) / f64::from(STEPS)).sin_cos();
        let d = layout.direction(&root(middle.position + (x * cos + y * sin) * radius));
        d.dot(y).atan2(d.dot(x))
    };
    let turn = |i: i32| (angle(i + 1) - angle(i) + PI).rem_euclid(TAU) - PI;
    (0..STEPS).map(turn).sum::<f64>() / TAU
}

#[test]
fn the_flow_winds_once_about_each_whorl() {
    for count in [1, 2] {
        let layout = layout(Flow::Whorl, |s| s.implantation.whorls.count = count);
        assert_eq!(layout.whorls.len(), count);
        for whorl in &layout.whorls {
            assert!((winding(&layout, whorl.centre, 0.008) - 1.0).abs() < 1e-6);
        }
        // No other turn anywhere near: the front of the scalp has none.
        let front = head().landmarks().hairline + DVec3::new(0.0, 0.03, 0.0);
        assert!(winding(&layout, front, 0.01).abs() < 1e-6);
    }
}

#[test]
fn whorls_turn_clockwise_unless_told_otherwise() {
    for (turn, sign) in [(Turn::Clockwise, -1.0), (Turn::Anticlockwise, 1.0)] {
        let layout = layout(Flow::Whorl, |s| s.implantation.whorls.turn = turn);
        let centre = layout.whorls[0].centre;
        let aside = root(centre + DVec3::new(0.02, 0.0, 0.0));
        let radius = aside.position - centre;
        // Seen from outside, with the normal towards the eye.
        let moment = aside.normal.dot(radius.cross(layout.direction(&aside)));
        assert!(moment * sign > 0.3 * radius.length(), "{turn:?}: {moment}");
    }
}

#[test]
fn hair_runs_over_the_forehead_down_the_sides_and_together_at_the_nape() {
    let layout = layout(Flow::Whorl, |_| {});
    let marks = head().landmarks();
    let at = |p: DVec3| layout.direction(&root(p));
    assert!(at(marks.hairline + DVec3::new(0.0, 0.01, 0.005)).y < -0.5);
    for side in [-1.0, 1.0] {
        assert!(at(DVec3::new(0.076 * side, 0.0, 0.02)).z < -0.5);
        let skin = root(marks.nape + DVec3::new(0.03 * side, 0.0, 0.01));
        let nape = layout.direction(&skin).reject_from(skin.normal);
        assert!(nape.x * side < 0.0 && nape.z < -0.3, "{nape}");
    }
}

#[test]
fn a_parting_parts() {
    let s_curve = Parting::Through(vec![[0.03, 0.01], [0.0, 0.06], [0.02, 0.11]]);
    for parting in [Parting::Straight { offset: 0.0 }, Parting::Zigzag { offset: 0.02 }, s_curve] {
        for flow in FLOWS {
            let layout = layout(flow, |s| s.implantation.partings = vec![parting.clone()]);
            check_sides(&layout);
        }
    }
}

#[test]
fn a_parting_fades_where_it_ends_amid_hair() {
    let layout = layout(Flow::Parted { offset: 0.0 }, |_| {});
    let line = layout.partings.lines().next().unwrap();
    let strength = |p: &DVec3| layout.partings.away(*p, root(*p).normal).unwrap().strength;
    assert!(strength(&line[0]) > 0.99 && strength(&line[line.len() / 2]) > 0.99);
    let end = root(*line.last().unwrap());
    assert!(strength(&end.position) < 0.05);
    // Hair on both sides of the end is combed back together, and covers it.
    let aside = DVec3::X.reject_from(end.normal).normalize() * 4e-3;
    let [left, right] = [aside, -aside].map(|step| layout.direction(&root(end.position + step)));
    assert!(left.y > 0.3 && right.y > 0.3 && left.angle_between(right) < 0.9, "{left} {right}");
}

/// Hair beside each piece of a parting leaves it, and the two sides cannot go together.
fn check_sides(layout: &Layout) {
    let lines: Vec<Vec<DVec3>> = layout.partings.lines().map(<[_]>::to_vec).collect();
    for line in lines {
        for pair in line.windows(2).skip(4).step_by(3).take(20) {
            let middle = root(0.5 * (pair[0] + pair[1]));
            // It fades before an end amid hair.
            let away = layout.partings.away(middle.position, middle.normal).unwrap();
            if away.strength < 0.5 {
                continue;
            }
            let aside = (pair[1] - pair[0]).cross(middle.normal).normalize();
            let sides = [-1.0, 1.0].map(|side| root(middle.position + aside * (side * 1.5e-3)));
            assert!(layout.apart(sides[0].position, sides[0].position, sides[1].position));
            for (side, root) in [-1.0, 1.0].into_iter().zip(&sides) {
                assert!(layout.direction(root).dot(aside) * side > 0.05, "{}", root.position);
            }
        }
    }
}

#[test]
fn hair_next_to_a_parting_is_combed_to_either_side() {
    let parting = vec![Parting::Straight { offset: 0.0 }];
    let layout = layout(Flow::SweptBack, |s| s.implantation.partings = parting);
    let line = layout.partings.lines().next().unwrap();
    let (from, to) = (line[line.len() / 2], line[line.len() / 2 + 1]);
    let middle = root(0.5 * (from + to));
    let aside = (to - from).cross(middle.normal).normalize();
    let over = |distance: f64| {
        let own = root(middle.position + aside * distance);
        let other = root(middle.position + aside * 5e-3).position;
        let side = |index| layout.combed_from(&own, 1, index).position;
        (0..1000).filter(|&index| layout.apart(own.position, side(index), other)).count()
    };
    // Half of the hairs on the line; P(N > 0.5 mm / 0.8 mm) = 0.27 beside it; none 3 mm from it.
    assert!((450..550).contains(&over(0.0)), "{}", over(0.0));
    assert!((220..310).contains(&over(0.5e-3)), "{}", over(0.5e-3));
    assert_eq!(over(3e-3), 0);
}

#[test]
fn a_parting_off_the_scalp_is_refused_with_its_point() {
    let line = vec![[0.0, 0.02], [0.0, 0.08], [0.0, -0.04]];
    let partings = vec![Parting::Straight { offset: 0.0 }, Parting::Through(line)];
    let spec = spec(Flow::SweptBack, |s| s.implantation.partings = partings);
    let error = Layout::new(&spec, head()).unwrap_err();
    assert_eq!((error.index, error.place, error.point), (1, 2, [0.0, -0.04]));
    assert!(error.to_string().contains("0 cm across, -4 cm back"), "{error}");
}

#[test]
fn partings_that_are_no_lines_are_refused() {
    for (line, what) in [
        (vec![[0.0, 0.05]], "2 to 100 points"),
        (vec![[0.0, 0.05], [0.0, 0.05]], "1 mm apart"),
        (vec![[0.0, 0.0], [0.0, 0.1], [0.03, 0.05], [-0.03, 0.04]], "does not cross itself"),
        (vec![[0.0, 0.0], [0.0, f64::NAN]], "within 25 cm"),
    ] {
        let error = Parting::Through(line).check().unwrap_err();
        assert!(error.allowed.contains(what), "{error}");
    }
}

#[test]
fn regions_have_directions_and_lengths_of_their_own() {
    let fringe = RegionStyle {
        places: vec![Place::Region(crate::head::Region::Fringe)],
        length: Some(RegionLength::DownTo(crate::spec::Level::Brows)),
        comb: Some(Comb::Forward),
        ..RegionStyle::default()
    };
    let layout = layout(Flow::SweptBack, |s| s.regions = vec![fringe]);
    let marks = head().landmarks();
    let in_fringe = root(marks.hairline + DVec3::new(0.0, 0.005, 0.005));
    let crown = root(marks.whorl);
    assert!(layout.direction(&in_fringe).y < -0.4 && layout.direction(&crown).y > 0.2);
    assert_eq!(layout.length(head(), &crown), None);
    // The way from there to the brows is a little longer than the straight line.
    let length = layout.length(head(), &in_fringe).unwrap();
    let least = in_fringe.position.distance(marks.brow);
    assert!((least..least + 0.015).contains(&length), "{length}, {least}");
    assert!(layout.apart(in_fringe.position, in_fringe.position, crown.position));
}

#[test]
fn hair_cut_to_the_chin_is_not_caught_on_an_ear() {
    let all = RegionStyle {
        places: vec![Place::Everywhere],
        length: Some(RegionLength::DownTo(crate::spec::Level::Chin)),
        ..RegionStyle::default()
    };
    let layout = layout(Flow::Parted { offset: 0.0 }, |s| s.regions = vec![all]);
    let marks = head().landmarks();
    // Hair from the sides, below the brows, goes straight down past the ears, give or take a comb.
    let low = |r: &Root| r.position.z < marks.brow.z;
    for r in Scalp::new(head()).stratified(2000, 1, Purpose::HairRoots).into_iter().filter(low) {
        let least = r.position.z - regions::height(crate::spec::Level::Chin, marks);
        let length = layout.length(head(), &r).unwrap();
        assert!(length < least.max(0.0) + 0.08, "{length}, {least} from {}", r.position);
    }
}

#[test]
fn shares_of_regions_are_those_of_the_regions() {
    let marks = head().landmarks();
    let roots = Scalp::new(head()).stratified(5000, 1, Purpose::HairRoots);
    let mut sure = 0;
    for r in &roots {
        let shares = marks.shares(r.position);
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        if let Some(i) = shares.iter().position(|&s| s > 0.6) {
            assert_eq!(crate::head::Region::ALL[i], marks.region(r.position), "{}", r.position);
        }
        sure += usize::from(shares.iter().any(|&s| s > 0.99));
    }
    assert!(sure > 3000, "{sure}");
}

#[test]
fn hair_thins_at_the_line_and_not_along_facets() {
    let spec = spec(Flow::SweptBack, |s| s.implantation.hairline = Hairline::EVEN);
    let roots = Scalp::grown(head(), &spec).stratified(40_000, 1, Purpose::HairRoots);
    let edge = head().edge(&Hairline::EVEN, 1).unwrap();
    let inside: Vec<f64> = roots.iter().map(|r| edge.inside(r.position)).collect();
    // None outside the line's own width: the facets are twice as wide.
    assert!(inside.iter().all(|&d| d > -2.5e-3), "{inside:?}");
    let within = |from: f64, to: f64| inside.iter().filter(|d| (from..to).contains(*d)).count();
    let (rim, outer, inner) = (within(-0.002, 0.001), within(0.001, 0.004), within(0.009, 0.012));
    assert!(3 * rim < outer && outer < inner, "{rim} {outer} {inner}");
}

#[test]
fn hairlines_recede_and_peak_where_told() {
    let marks = head().landmarks();
    let inside = |hairline: Hairline, p: DVec3| head().edge(&hairline, 1).unwrap().inside(p);
    let temple = root(DVec3::new(0.055, -0.055, 0.06)).position;
    let moved = |change: Hairline, p: DVec3| inside(Hairline::EVEN, p) - inside(change, p);
    let even = Hairline::EVEN;
    let higher = moved(Hairline { height: 0.01, ..even }, marks.hairline);
    assert!((higher - 0.01).abs() < 1e-3, "{higher}");
    assert!(moved(Hairline { widows_peak: 0.01, ..even }, marks.hairline) < -0.008);
    assert!(moved(Hairline { recession: 0.01, ..even }, temple) > 0.005);
    assert!(moved(Hairline { recession: 0.01, ..even }, marks.nape).abs() < 1e-4);
    let higher = moved(Hairline { nape: 0.01, ..even }, marks.nape);
    assert!((0.007..0.0101).contains(&higher), "{higher}");
    // Hair before the middle of the ear, and none there with short sideburns; at the temple nothing changes.
    let before_ear = root(DVec3::new(0.07, marks.ear.y - 0.024, marks.ear.z)).position;
    assert!(inside(even, before_ear) > 0.0, "{before_ear}");
    assert!(inside(Hairline { sideburns: 0.02, ..even }, before_ear) < 0.0);
    assert!(moved(Hairline { sideburns: 0.02, ..even }, temple).abs() < 1e-4);
}

/// The direction (unit) of the axis about which the natural curl of a root winds.
fn axis(layout: &Layout, strain: DVec3, root: &Root) -> DVec3 {
    let tangent = layout.direction(root);
    let lean = layout.lean(root, tangent, strain);
    let out = lean.reject_from_normalized(tangent).normalize();
    (out * strain.truncate().length() + tangent * strain.z).normalize()
}

#[test]
fn curls_above_the_forehead_lean_where_they_are_combed() {
    let comb = RegionStyle {
        places: vec![Place::Region(crate::head::Region::Fringe)],
        comb: Some(Comb::Left),
        ..RegionStyle::default()
    };
    let curly = preset("caucasian-curly").unwrap().spec();
    let with = |regions| {
        let flow = Flow::SweptBack;
        let implantation = Implantation { flow, ..curly.implantation.clone() };
        Layout::new(&HairstyleSpec { implantation, regions, ..curly.clone() }, head()).unwrap()
    };
    let forehead = root(head().landmarks().hairline + DVec3::new(0.0, 0.008, 0.006));
    let back = axis(&with(Vec::new()), curly.curl.strain, &forehead);
    assert!(back.y > 0.3, "{back}");
    let left = axis(&with(vec![comb]), curly.curl.strain, &forehead);
    assert!(left.x > 0.5, "{left}");
}

#[test]
fn drawn_hair_is_gathered_at_a_parting_on_its_own_side() {
    let layout = layout(Flow::Parted { offset: 0.02 }, |_| {});
    let (mut near, mut nearer) = (0, 0);
    let (mut beside, mut left) = (0, 0);
    let strip = 3e-3..15e-3;
    for from in Scalp::new(head()).stratified(20_000, 1, Purpose::HairRoots) {
        let to = layout.gathered(head(), from);
        assert!(to == from || head().signed_distance().value(to.position).abs() < 2e-4);
        assert!(!layout.partings.between(&layout.marks, from.position, to.position));
        let distance = |r: &Root| layout.partings.away(r.position, r.normal).unwrap().distance;
        let (before, after) = (distance(&from), distance(&to));
        assert!(after < before + 1e-4 && (before < 30e-3 || after > before - 1e-6));
        near += usize::from(before < 1.5e-3);
        nearer += usize::from(after < 1.5e-3);
        beside += usize::from(strip.contains(&before));
        left += usize::from(strip.contains(&after));
    }
    // What is gathered comes from a broad strip.
    assert!(10 * left > 7 * beside, "{left} of {beside}");
    assert!(nearer > 2 * near, "{nearer}, {near}");
}

#[test]
fn shoulders_and_chest_are_where_a_head_has_them() {
    use crate::spec::Level;
    for name in Head::names() {
        let head = Head::named(name).unwrap();
        let marks = head.landmarks();
        // Half of the width (m) at a height: of skin within 5 mm of it.
        let width = |z: f64| {
            let skin = head.surface().positions().iter().filter(|p| (p.z - z).abs() < 5e-3);
            skin.map(|p| p.x.abs()).fold(0.0, f64::max)
        };
        let at = |level| regions::height(level, marks);
        let [chin, shoulders, chest] = [Level::Chin, Level::Shoulders, Level::Chest].map(at);
        // The neck is 5 to 6 cm from its middle to its side, shoulders are 19 to 24.
        assert!((0.06..0.18).contains(&width(shoulders)), "{name}: {}", width(shoulders));
        assert!(width(shoulders - 0.02) > 0.12 && width(shoulders + 0.03) < 0.13, "{name}");
        assert!(width(chest) > 0.19 && shoulders - chest > 0.08 && shoulders < chin, "{name}");
    }
}

#[test]
fn hair_lies_on_what_is_rooted_on_its_way() {
    let marks = head().landmarks();
    let forehead = root(marks.hairline + DVec3::new(0.0, 0.006, 0.004));
    let way = |spec: &HairstyleSpec, head: &Head, at: &Root, length: f64| {
        let layout = Layout::new(spec, head).unwrap();
        Ways::new(spec, head, &layout).over_hair(at, length)
    };
    let combed = |comb| {
        let style = RegionStyle {
            places: vec![Place::Everywhere],
            length: None,
            comb: Some(comb),
            lift: None,
            curl: None,
        };
        spec(Flow::SweptBack, |s| s.regions = vec![style])
    };
    // Nothing is beneath hair that falls over the forehead, and the top of the head beneath hair that is combed back.
    let [down, back] =
        [Comb::Down, Comb::Back].map(|comb| way(&combed(comb), head(), &forehead, 0.2));
    assert!(down < 0.02 && back > 0.14, "{down} {back}");
    // No more than the hair is long.
    assert!(way(&combed(Comb::Back), head(), &forehead, 0.06) < 0.0601);
    // A whole number of steps is nothing special: all of a head moves with the least change of its length otherwise.
    let [shorter, longer] = [1.0 - 1e-6, 1.0 + 1e-6]
        .map(|factor| way(&combed(Comb::Back), head(), &forehead, 0.05 * factor));
    assert!((longer - shorter).abs() < 2e-7, "{longer} {shorter}");
    // At the side, what is below the root.
    let side = root(marks.cranium_centre + DVec3::new(0.09, 0.01, 0.05));
    let below = way(&combed(Comb::Down), head(), &side, 0.3);
    assert!((0.01..0.12).contains(&below), "{below}");
    // A head with a scalp of its own says the same.
    let scalp = crate::head::ScalpSource::Weights(head().scalp().to_vec());
    let own = Head::from_surface(head().surface().clone(), scalp).unwrap();
    let of_vertices = way(&combed(Comb::Down), &own, &side, 0.3);
    assert!((of_vertices - below).abs() < 0.015, "{of_vertices} {below}");
}
