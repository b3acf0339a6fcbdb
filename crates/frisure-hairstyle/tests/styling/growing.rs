//! Growing.

use frisure_hairstyle::styling::{Cut, CutLine, Grow, Growth, Operation, Selection};
use frisure_hairstyle::{
    Body, Curl, HairContact, Hairstyle, PredictOptions, StyleOptions, predict, style,
};

use crate::{HEAD, done, farthest_tip, grow, hairstyle, spec};

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
