//! Friction inside wisps: what of a bend they keep.

use std::sync::LazyLock;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{self, Comb, Direction, Grow, Growth, Operation, Release, Wet};
use frisure_hairstyle::{
    Body, HairContact, Hairs, Hairstyle, HairstyleSpec, HeadMethod, PredictOptions, Product,
    StyleOptions, predict, preset, settling_report, style,
};
use frisure_rod::Equilibrium;

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

/// Straight hair without any other friction.
fn spec(contact: HairContact, wisps: usize, lock: f64) -> HairstyleSpec {
    let mut spec = preset("caucasian-straight").unwrap().spec();
    spec.wisps.count = wisps;
    spec.wisps.hairs = Hairs::Count(300);
    spec.contact.hair = contact;
    spec.contact.lock_friction = lock;
    spec
}

fn predicted(contact: HairContact, wisps: usize, lock: f64) -> Hairstyle {
    predict(&spec(contact, wisps, lock), &HEAD, PredictOptions::default(), &()).unwrap()
}

fn done(h: &Hairstyle, operation: impl Into<Operation>) -> Hairstyle {
    style(h, &HEAD, &operation.into(), StyleOptions::default(), &()).unwrap()
}

fn gel(amount: f64) -> styling::Product {
    styling::Product { kind: Product::Gel, amount, ..styling::Product::default() }
}

fn comb(hold: bool) -> Comb {
    let towards = Direction::Named(frisure_hairstyle::Comb::Back);
    Comb { towards, strength: 4.0, hold, ..Comb::default() }
}

/// Mean over guides of how much of the way that the comb moved their tips is left.
fn retention(before: &Hairstyle, held: &Hairstyle, after: &Hairstyle) -> f64 {
    let tips = |h: &Hairstyle| h.equilibria().iter().map(Equilibrium::tip).collect::<Vec<_>>();
    let (before, held, after) = (tips(before), tips(held), tips(after));
    let moved = (0..before.len()).filter(|&i| held[i].distance(before[i]) > 5e-3);
    let kept = moved.map(|i| {
        let way = held[i] - before[i];
        (after[i] - before[i]).dot(way) / way.length_squared()
    });
    let kept: Vec<f64> = kept.collect();
    kept.iter().sum::<f64>() / kept.len() as f64
}

/// What short hair keeps of a comb.
fn kept(contact: HairContact, body: Body, lock: f64, product: f64) -> f64 {
    let mut spec = spec(contact, 12, lock);
    spec.length.mean = 0.06;
    spec.contact.body = body;
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let before = done(&before, gel(product));
    let held = done(&before, comb(true));
    let after = done(&held, Release::default());
    let report = settling_report(&after, &HEAD);
    assert_eq!(report.stable, 12, "{contact:?} {lock}: {report:?}");
    assert!(report.lock.ratio <= 1.0 + 1e-9, "{report:?}");
    assert_eq!(report.lock.ratio > 0.0, lock > 0.0, "{report:?}");
    retention(&before, &held, &after)
}

#[test]
fn locks_that_stick_keep_part_of_a_comb() {
    // No other friction. What lies on the head is pressed by that.
    for contact in [HairContact::Layers, HairContact::Wisps, HairContact::Density] {
        let kept = [0.0, 0.1, 0.4].map(|lock| kept(contact, Body::SignedDistance, lock, 0.0));
        assert!(kept[0].abs() < 1e-3 && kept[1] > 0.1, "{contact:?}: {kept:?}");
        assert!(kept[2] > kept[1] + 0.02, "{contact:?}: {kept:?}");
    }
}

#[test]
fn a_product_holds_locks_that_nothing_presses() {
    let kept = |lock, product| kept(HairContact::None, Body::None, lock, product);
    let (dry, free) = (kept(0.4, 0.0), kept(0.0, 1.0));
    let with = [0.3, 1.0].map(|product| kept(0.4, product));
    assert!((dry - free).abs() < 1e-3, "{dry} {free}");
    assert!(with[0] > dry + 0.01 && with[1] > with[0] + 0.02, "{dry} {with:?}");
}

#[test]
fn a_prediction_sticks_where_it_lies() {
    // Guides come down alone and stick then: on layers nothing moves.
    let [free, lock] = [0.0, 0.5].map(|lock| predicted(HairContact::Layers, 12, lock));
    for (a, b) in free.equilibria().iter().zip(lock.equilibria()) {
        assert_eq!(a.shape, b.shape);
    }
    let report = settling_report(&lock, &HEAD);
    assert_eq!((report.lock.ratio, report.lock.slipping), (0.0, 0.0));
}

#[test]
fn washing_and_growing_free_locks() {
    let before = done(&predicted(HairContact::Layers, 12, 0.5), gel(1.0));
    let after = done(&done(&before, comb(true)), Release::default());
    // What was done to other wisps, or to how they lie, changes nothing.
    let again = done(&done(&after, comb(true)), Release::default());
    assert!(settling_report(&again, &HEAD).lock.ratio > 0.9);
    let ratio = |h: &Hairstyle| settling_report(h, &HEAD).lock.ratio;
    assert!(ratio(&after) > 0.9, "{}", ratio(&after));
    // What slid and stuck anew carries no moment.
    assert_eq!(ratio(&done(&after, Wet::default())), 0.0);
    assert_eq!(ratio(&done(&after, Grow { amount: Growth::By(0.01), ..Grow::default() })), 0.0);
}

#[test]
fn all_wisps_together_agree_with_locks_that_stick() {
    let mut spec = spec(HairContact::Wisps, 10, 0.5);
    spec.contact.friction = 0.3;
    spec.equilibrium.method = HeadMethod::Continuation;
    let before = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap();
    let after = done(&done(&done(&before, gel(1.0)), comb(true)), Release::default());
    for style in [&before, &after] {
        let report = settling_report(style, &HEAD);
        let joint = report.joint.unwrap();
        assert!(joint.stable && joint.gradient_norm < 1e-6, "{joint:?}");
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let before = done(&predicted(HairContact::Wisps, 12, 0.5), gel(1.0));
            done(&done(&before, comb(true)), Release::default())
        })
    };
    let (one, three) = (on(1), on(3));
    for (a, b) in one.equilibria().iter().zip(three.equilibria()) {
        assert_eq!(a.shape, b.shape);
    }
}

#[test]
fn coefficients_out_of_range_are_refused() {
    for lock in [-0.1, 1.6, f64::NAN] {
        let spec = spec(HairContact::Layers, 10, lock);
        let error = predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap_err();
        assert!(error.to_string().contains("lock_friction"), "{error}");
    }
}
