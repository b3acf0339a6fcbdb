//! Shapes that hair keeps when it dries in them.

use frisure_hairstyle::styling::{Dry, Humidity, Operation, Release, Roll, Selection, Twist};
use frisure_hairstyle::{Body, HairContact, Hairstyle, Moisture, PredictOptions, predict};
use glam::DVec3;

use crate::{HEAD, done, dry, hairstyle, spec, wet};

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
