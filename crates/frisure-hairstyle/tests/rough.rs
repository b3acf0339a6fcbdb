//! Hair for the eye: some of the same hairs, and guides that go on from where others rest.

use std::sync::LazyLock;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{Cut, CutLine, Held, Operation, Selection, Wet};
use frisure_hairstyle::{
    Effort, HairContact, Hairs, HairstyleSpec, predict, predict_again, predict_roughly, preset,
};

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

const LITTLE: Effort = Effort { iterations: 2, sweeps: 1 };

fn spec() -> HairstyleSpec {
    let mut spec = preset("caucasian-curly").unwrap().spec();
    spec.length.mean = 0.12;
    spec.wisps.count = 20;
    spec.wisps.hairs = Hairs::Count(300);
    spec.equilibrium.resolution = frisure_rod::Resolution::Elements(12);
    spec.contact.hair = HairContact::Layers;
    spec
}

#[test]
fn every_so_manyth_hair_is_the_same_hair() {
    let hair = predict(&spec(), &HEAD, &()).unwrap();
    let (all, some) =
        (hair.strands(&HEAD, &()).unwrap(), hair.some_strands(&HEAD, 7, &()).unwrap());
    assert_eq!((all.len(), some.len(), hair.drawn()), (300, 43, 300));
    for i in 0..some.len() {
        assert_eq!(some.strand(i).points, all.strand(7 * i).points);
        assert_eq!(some.strand(i).radii, all.strand(7 * i).radii);
    }
    assert_eq!(hair.some_strands(&HEAD, 0, &()).unwrap(), all);
}

#[test]
fn what_is_known_changes_no_byte() {
    let before = predict(&spec(), &HEAD, &()).unwrap();
    before.strands(&HEAD, &()).unwrap();
    let mut other = spec();
    other.curl.strain *= 1.1;
    other.wisps.hairs = Hairs::Count(200);
    let (cold, warm) = (
        predict(&other, &HEAD, &()).unwrap(),
        predict_again(&other, &HEAD, Some(&before), &()).unwrap(),
    );
    assert_eq!(cold.strands(&HEAD, &()), warm.strands(&HEAD, &()));
    let mut drawn = spec();
    (drawn.wisps.hairs, drawn.wisps.clumping) = (Hairs::Count(100), 0.3);
    drawn.implantation.baby_hairs = 0.5;
    let redrawn = before.redrawn(&drawn).unwrap();
    let cold = predict(&drawn, &HEAD, &()).unwrap();
    assert_eq!(cold.strands(&HEAD, &()), redrawn.strands(&HEAD, &()));
    // What guides depend on is another matter.
    assert!(before.redrawn(&other).is_none());
    drawn.wisps.fuzziness += 0.1;
    assert!(before.redrawn(&drawn).is_none());
    let wet = before.styled(&HEAD, &Operation::Wet(Wet::default()), &()).unwrap();
    assert!(wet.redrawn(&spec()).is_none());
}

#[test]
fn rough_hair_may_be_of_anything_before() {
    let before = predict(&spec(), &HEAD, &()).unwrap();
    let mut other = spec();
    (other.wisps.count, other.seed) = (25, 9);
    let rough = predict_roughly(&other, &HEAD, Some(&before), LITTLE, &()).unwrap();
    assert_eq!(rough.guides().len(), 25);
    // Guides are those of an exact hairstyle, and hang about as they do.
    let exact = predict(&other, &HEAD, &()).unwrap();
    for (a, b) in rough.guides().iter().zip(exact.guides()) {
        assert_eq!((a.root, &a.rod), (b.root, &b.rod));
    }
    let mut still = rough;
    for _ in 0..60 {
        still = predict_roughly(&other, &HEAD, Some(&still), LITTLE, &()).unwrap();
    }
    assert_eq!(still.report(&HEAD).not_converged, 0);
    let alone = predict_roughly(&spec(), &HEAD, None, Effort::NONE, &()).unwrap();
    assert_eq!(alone.strands(&HEAD, &()), before.strands(&HEAD, &()));
}

#[test]
fn rough_steps_go_on_from_those_before() {
    let hair = predict(&spec(), &HEAD, &()).unwrap();
    let line = CutLine::Length(0.08);
    let cut = Operation::Cut(Cut { selection: Selection::Everything, line, held: Held::Down });
    let exact = hair.styled(&HEAD, &cut, &()).unwrap();
    let rough = hair.styled_roughly(&HEAD, &cut, Some(&exact), (LITTLE, 5), &()).unwrap();
    assert_eq!(rough.wisps(), exact.wisps());
    let apart =
        |(a, b): (&frisure_rod::Equilibrium, &frisure_rod::Equilibrium)| a.tip().distance(b.tip());
    let farthest = rough.equilibria().iter().zip(exact.equilibria()).map(apart).fold(0.0, f64::max);
    assert!(farthest < 1e-3, "{farthest}");
    // The hairs that are drawn are cut like those of the exact one.
    let length =
        |points: &[glam::Vec3]| points.windows(2).map(|p| p[0].distance(p[1])).sum::<f32>();
    let drawn = |hair: &frisure_hairstyle::Hairstyle| hair.some_strands(&HEAD, 5, &()).unwrap();
    let (some, all) = (drawn(&rough), drawn(&exact));
    for i in 0..some.len() {
        assert!((length(some.strand(i).points) - length(all.strand(i).points)).abs() < 2e-3);
    }
    // Without anything to go on from, too.
    let rough = hair.styled_roughly(&HEAD, &cut, None, (LITTLE, 5), &()).unwrap();
    assert_eq!(rough.wisps(), exact.wisps());
    // And what is done next is done in full.
    let wet = Operation::Wet(Wet::default());
    let report = rough.styled(&HEAD, &wet, &()).unwrap().report(&HEAD);
    assert_eq!(report.not_converged, 0);
}
