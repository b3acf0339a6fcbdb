//! Wetting and drying.

use frisure_hairstyle::head::Region;
use frisure_hairstyle::styling::{Dry, Humidity, Operation, Selection, Wet};
use frisure_hairstyle::{
    HairContact, Hairstyle, PRESETS, Place, PredictOptions, StrandOptions, predict, strands,
};
use frisure_strands::AttributeValues;
use glam::DVec3;

use crate::{HEAD, done, dry, hairstyle, same, spec, wet};

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
fn damp_air_softens_hair_and_dry_air_stiffens_it() {
    let before = hairstyle("caucasian-curly", 10);
    let stiffness = |relative: f64| {
        let after = done(&before, &Operation::Humidity(Humidity { relative }));
        after.guides()[0].rod.spec().material.youngs_modulus()
    };
    assert_eq!(stiffness(0.6), before.guides()[0].rod.spec().material.youngs_modulus());
    assert!(stiffness(0.9) < stiffness(0.6) && stiffness(0.6) < stiffness(0.2));
}
