//! Hair for the eye: some of the same hairs, and guides that go on from where others rest.

use std::sync::LazyLock;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{Cut, CutLine, Operation, Wet};
use frisure_hairstyle::{
    Draft, Effort, HairContact, Hairs, Hairstyle, HairstyleSpec, PredictOptions, Start,
    StrandOptions, StyleOptions, predict, preset, redrawn, settling_report, strands, style,
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
    let hair = predict(&spec(), &HEAD, PredictOptions::default(), &()).unwrap();
    let (all, some) = (
        strands(&hair, &HEAD, StrandOptions::default(), &()).unwrap().strands,
        strands(&hair, &HEAD, every(7), &()).unwrap().strands,
    );
    assert_eq!((all.len(), some.len(), hair.drawn()), (300, 43, 300));
    for i in 0..some.len() {
        assert_eq!(some.strand(i).points, all.strand(7 * i).points);
        assert_eq!(some.strand(i).radii, all.strand(7 * i).radii);
    }
    assert_eq!(strands(&hair, &HEAD, every(0), &()).unwrap().strands, all);
}

#[test]
fn what_is_known_changes_no_byte() {
    let before = predict(&spec(), &HEAD, PredictOptions::default(), &()).unwrap();
    strands(&before, &HEAD, StrandOptions::default(), &()).unwrap();
    let mut other = spec();
    other.curl.strain *= 1.1;
    other.wisps.hairs = Hairs::Count(200);
    let (cold, warm) = (
        predict(&other, &HEAD, PredictOptions::default(), &()).unwrap(),
        predict(
            &other,
            &HEAD,
            PredictOptions { previous: Some(&before), ..PredictOptions::default() },
            &(),
        )
        .unwrap(),
    );
    assert_eq!(
        strands(&cold, &HEAD, StrandOptions::default(), &()),
        strands(&warm, &HEAD, StrandOptions::default(), &())
    );
    let mut drawn = spec();
    (drawn.wisps.hairs, drawn.wisps.clumping) = (Hairs::Count(100), 0.3);
    drawn.implantation.baby_hairs = 0.5;
    let again = redrawn(&before, &drawn).unwrap();
    let cold = predict(&drawn, &HEAD, PredictOptions::default(), &()).unwrap();
    assert_eq!(
        strands(&cold, &HEAD, StrandOptions::default(), &()),
        strands(&again, &HEAD, StrandOptions::default(), &())
    );
    // What guides depend on is another matter.
    assert!(redrawn(&before, &other).is_none());
    drawn.wisps.fuzziness += 0.1;
    assert!(redrawn(&before, &drawn).is_none());
    let wet = style(&before, &HEAD, &Operation::Wet(Wet::default()), StyleOptions::default(), &())
        .unwrap();
    assert!(redrawn(&wet, &spec()).is_none());
}

fn little_from(previous: &Hairstyle) -> PredictOptions<'_> {
    PredictOptions { previous: Some(previous), start: Start::Previous, effort: LITTLE }
}

fn draft(like: Option<&Hairstyle>) -> StyleOptions<'_> {
    StyleOptions { draft: Some(Draft { effort: LITTLE, stride: 5, like }), stages: None }
}

fn every(stride: usize) -> StrandOptions<'static> {
    StrandOptions { stride, checkpoint: None }
}

#[test]
fn rough_hair_may_be_of_anything_before() {
    let before = predict(&spec(), &HEAD, PredictOptions::default(), &()).unwrap();
    let mut other = spec();
    (other.wisps.count, other.seed) = (25, 9);
    let rough = predict(&other, &HEAD, little_from(&before), &()).unwrap();
    assert_eq!(rough.guides().len(), 25);
    // Guides are those of an exact hairstyle, and hang about as they do.
    let exact = predict(&other, &HEAD, PredictOptions::default(), &()).unwrap();
    for (a, b) in rough.guides().iter().zip(exact.guides()) {
        assert_eq!((a.root, &a.rod), (b.root, &b.rod));
    }
    let mut still = rough;
    for _ in 0..60 {
        still = predict(&other, &HEAD, little_from(&still), &()).unwrap();
    }
    assert_eq!(settling_report(&still, &HEAD).not_converged, 0);
    let alone = predict(
        &spec(),
        &HEAD,
        PredictOptions { effort: Effort::NONE, ..PredictOptions::default() },
        &(),
    )
    .unwrap();
    assert_eq!(
        strands(&alone, &HEAD, StrandOptions::default(), &()),
        strands(&before, &HEAD, StrandOptions::default(), &())
    );
}

#[test]
fn rough_steps_go_on_from_those_before() {
    let hair = predict(&spec(), &HEAD, PredictOptions::default(), &()).unwrap();
    let line = CutLine::Length(0.08);
    let cut = Operation::Cut(Cut { line, ..Cut::default() });
    let exact = style(&hair, &HEAD, &cut, StyleOptions::default(), &()).unwrap();
    let rough = style(&hair, &HEAD, &cut, draft(Some(&exact)), &()).unwrap();
    assert_eq!(rough.wisps(), exact.wisps());
    let apart =
        |(a, b): (&frisure_rod::Equilibrium, &frisure_rod::Equilibrium)| a.tip().distance(b.tip());
    let farthest = rough.equilibria().iter().zip(exact.equilibria()).map(apart).fold(0.0, f64::max);
    assert!(farthest < 1e-3, "{farthest}");
    // The hairs that are drawn are cut like those of the exact one.
    let length =
        |points: &[glam::Vec3]| points.windows(2).map(|p| p[0].distance(p[1])).sum::<f32>();
    let drawn = |hair: &Hairstyle| strands(hair, &HEAD, every(5), &()).unwrap().strands;
    let (some, all) = (drawn(&rough), drawn(&exact));
    for i in 0..some.len() {
        assert!((length(some.strand(i).points) - length(all.strand(i).points)).abs() < 2e-3);
    }
    // Without anything to go on from, too.
    let rough = style(&hair, &HEAD, &cut, draft(None), &()).unwrap();
    assert_eq!(rough.wisps(), exact.wisps());
    // And what is done next is done in full.
    let wet = Operation::Wet(Wet::default());
    let report =
        settling_report(&style(&rough, &HEAD, &wet, StyleOptions::default(), &()).unwrap(), &HEAD);
    assert_eq!(report.not_converged, 0);
}
