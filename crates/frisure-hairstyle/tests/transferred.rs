//! The hair of one head on another: roots correspond, fibres stay as they are, and all comes to rest outside the skin.

use frisure_hairstyle::head::Head;
use frisure_hairstyle::{
    Hairs, Hairstyle, PredictOptions, StrandOptions, adopt, guide_strands, penetration, predict,
    preset, strands, transfer,
};

const GUIDES: usize = 24;

/// A wavy groom of the mannequin, adopted on it.
fn adopted(mannequin: &Head) -> Hairstyle {
    adopted_of("caucasian-wavy", mannequin)
}

/// A groom of a hair type, adopted on the mannequin.
fn adopted_of(name: &str, mannequin: &Head) -> Hairstyle {
    let mut spec = preset(name).unwrap().spec();
    spec.wisps.count = GUIDES;
    spec.wisps.hairs = Hairs::Count(300);
    let predicted = predict(&spec, mannequin, PredictOptions::default(), &()).unwrap();
    let hairs = strands(&predicted, mannequin, StrandOptions::default(), &()).unwrap().strands;
    adopt(&spec, mannequin, &guide_strands(&predicted, 120), &hairs, &()).unwrap().0
}

#[test]
fn on_its_own_head_nothing_changes() {
    let head = Head::mannequin();
    let hair = adopted(&head);
    let same = transfer(&hair, &head, &head, &()).unwrap();
    let tips = hair.equilibria().iter().zip(same.equilibria());
    let mut moved: Vec<f64> = tips.map(|(a, b)| a.tip().distance(b.tip())).collect();
    moved.sort_by(f64::total_cmp);
    // The frames of roots turn by what the normals of mesh and distance field differ; a guide on an ear may slip.
    assert!(moved[GUIDES / 2] < 5e-5 && moved[GUIDES * 8 / 10] < 1e-3, "{moved:?}");
    let drawn = |hair: &Hairstyle| strands(hair, &head, StrandOptions::default(), &()).unwrap();
    let (before, after) = (drawn(&hair).strands, drawn(&same).strands);
    for (a, b) in before.iter().zip(after.iter()) {
        assert!(a.points[0].distance(b.points[0]) < 1e-4);
    }
}

#[test]
fn people_get_it_with_its_lengths_and_its_curl() {
    let mannequin = Head::mannequin();
    let hair = adopted(&mannequin);
    for name in ["european-woman", "asian-man"] {
        let head = Head::named(name).unwrap();
        let theirs = transfer(&hair, &mannequin, &head, &()).unwrap();
        assert_eq!(theirs.guides().len(), GUIDES);
        for (before, after) in hair.guides().iter().zip(theirs.guides()) {
            assert!(head.signed_distance().value(after.root.position).abs() < 1.5e-3);
            assert_eq!(before.rod.length(), after.rod.length());
            assert_eq!(before.rod.natural(), after.rod.natural());
            let (a, b) = (before.root.position.x, after.root.position.x);
            assert!(a.abs() < 0.01 || a * b > 0.0, "{name}: from one side to the other");
        }
        let rest = theirs.equilibria();
        assert!(rest.iter().all(|guide| guide.certificate.gradient_norm < 1e-4), "{name}");
        let drawn = strands(&theirs, &head, StrandOptions::default(), &()).unwrap().strands;
        assert_eq!(drawn.len(), 300);
        assert!(penetration(&drawn, &head) < 5e-4, "{name}: {}", penetration(&drawn, &head));
        // No hair floats: each begins at the skin.
        for strand in drawn.iter() {
            let gap = head.signed_distance().value(strand.points[0].as_dvec3());
            assert!(gap.abs() < 2e-3, "{name}: a root is {gap} m from the skin");
        }
    }
}

/// Curls whose guides turn in different ways on the other head are neither drawn out nor drawn in.
#[test]
fn drawn_hairs_keep_their_lengths() {
    let mannequin = Head::mannequin();
    let hair = adopted_of("caucasian-curly", &mannequin);
    let head = Head::named("european-woman").unwrap();
    let theirs = transfer(&hair, &mannequin, &head, &()).unwrap();
    let lengths = |hair: &Hairstyle, head: &Head| -> Vec<f32> {
        let drawn = strands(hair, head, StrandOptions::default(), &()).unwrap().strands;
        let length = |points: &[glam::Vec3]| points.windows(2).map(|p| p[0].distance(p[1])).sum();
        drawn.iter().map(|strand| length(strand.points)).collect()
    };
    let (before, after) = (lengths(&hair, &mannequin), lengths(&theirs, &head));
    let mut ratios: Vec<f32> = after.iter().zip(&before).map(|(a, b)| a / b).collect();
    ratios.sort_by(f32::total_cmp);
    let at = |part: f32| ratios[(part * (ratios.len() - 1) as f32) as usize];
    // What lies on skin is laid out of it, and cuts its own corners there.
    assert!((at(0.5) - 1.0).abs() < 0.01 && at(0.02) > 0.92 && at(0.98) < 1.03, "{ratios:?}");
    assert!(at(0.0) > 0.8 && at(1.0) < 1.2, "{ratios:?}");
}
