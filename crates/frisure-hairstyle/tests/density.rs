//! Hair as a density: a head at rest that is a function of its input.

use std::sync::LazyLock;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{Cut, CutLine, Dry, Height, Held, Operation, Selection, Wet};
use frisure_hairstyle::{
    Effort, Flow, HairContact, Hairstyle, HairstyleSpec, PredictOptions, Start, StyleOptions,
    predict, preset, settling_report, style,
};
use glam::DVec3;

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

/// Number of guides: so many that some lie in one place on the bed of hair.
const GUIDES: usize = 160;

/// Curls that are combed back, so that they lie on each other.
fn spec(contact: HairContact) -> HairstyleSpec {
    let mut spec = preset("caucasian-curly").unwrap().spec();
    spec.wisps.count = GUIDES;
    spec.implantation.flow = Flow::SweptBack;
    spec.implantation.hold = 3.0;
    spec.length.mean = 0.3;
    spec.contact.hair = contact;
    spec
}

fn predicted(spec: &HairstyleSpec) -> Hairstyle {
    predict(spec, &HEAD, PredictOptions::default(), &()).unwrap()
}

/// The same from where another head of hair lies, with so much work at most.
fn predicted_from(before: &Hairstyle, spec: &HairstyleSpec, effort: Effort) -> Hairstyle {
    let options = PredictOptions { previous: Some(before), start: Start::Previous, effort };
    predict(spec, &HEAD, options, &()).unwrap()
}

/// The hair of [`spec`] as a density, 2 % longer.
fn longer() -> HairstyleSpec {
    let mut longer = spec(HairContact::Density);
    longer.length.mean *= 1.02;
    longer
}

/// Largest distance (m) between the same points of two hairstyles, guide by guide, in order.
fn moves(a: &Hairstyle, b: &Hairstyle) -> Vec<f64> {
    let line = |style: &Hairstyle, i: usize| style.equilibria()[i].centre_line(40);
    let of_guide = |i: usize| {
        let (a, b) = (line(a, i), line(b, i));
        a.iter().zip(&b).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max)
    };
    let mut moves: Vec<f64> = (0..a.guides().len()).map(of_guide).collect();
    moves.sort_by(f64::total_cmp);
    moves
}

fn certified(hairstyle: &Hairstyle) {
    let report = settling_report(hairstyle, &HEAD);
    let joint = report.joint.expect("settled together");
    assert!(joint.stable && joint.gradient_norm <= 1e-8, "{joint:?}");
    assert!(joint.lowest_eigenvalue.unwrap() > joint.eigenvalue_error, "{joint:?}");
    assert_eq!((report.stable, report.not_converged), (GUIDES, 0), "{report:?}");
    assert!(report.penetration < 5e-4, "{report:?}");
}

#[test]
fn a_dense_head_is_at_a_certified_minimum_and_stays_there() {
    let density = predicted(&spec(HairContact::Density));
    certified(&density);
    // Wisps that lie in one place on the bed of hair make room.
    let layers = predicted(&spec(HairContact::Layers));
    assert!(moves(&layers, &density)[GUIDES - 1] > 1e-4, "{:?}", moves(&layers, &density));
    let again = predicted_from(&density, &spec(HairContact::Density), Effort::FULL);
    assert!(moves(&density, &again)[GUIDES - 1] < 1e-6, "{:?}", moves(&density, &again));
}

#[test]
fn a_warm_start_ends_at_a_certified_minimum_near_the_prediction() {
    let before = predicted(&spec(HairContact::Density));
    let warm = predicted_from(&before, &longer(), Effort::FULL);
    certified(&warm);
    // Some guides go downhill to another minimum of their own than that to which gravity leads, as without contact.
    let moves = moves(&warm, &predicted(&longer()));
    assert!(moves[GUIDES / 2] < 5e-4, "{moves:?}");
}

#[test]
fn a_millionth_of_the_length_moves_99_percent_by_less_than_a_tenth_of_a_millimetre() {
    let style = |factor: f64| {
        let mut spec = spec(HairContact::Density);
        spec.length.mean *= factor;
        predicted(&spec)
    };
    let moves = moves(&style(1.0), &style(1.0 + 1e-6));
    assert!(moves[GUIDES / 2] < 5e-6 && moves[GUIDES - 2] < 1e-4, "{moves:?}");
}

#[test]
fn a_dense_head_is_the_same_whatever_the_number_of_threads() {
    let positions = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let style = pool.install(|| predicted(&spec(HairContact::Density)));
        let shapes = style.equilibria().iter();
        shapes.flat_map(|rest| rest.shape.positions.clone()).collect::<Vec<DVec3>>()
    };
    let one = positions(1);
    assert_eq!(one, positions(2));
    assert_eq!(one, positions(8));
}

#[test]
fn steps_come_to_rest_together_and_drying_gives_back_what_was() {
    let before = predicted(&spec(HairContact::Density));
    let done = |of: &Hairstyle, operation: &Operation| {
        style(of, &HEAD, operation, StyleOptions::default(), &()).unwrap()
    };
    let wet = done(&before, &Operation::Wet(Wet::default()));
    certified(&wet);
    let dry = done(&wet, &Operation::Dry(Dry::default()));
    assert_eq!(moves(&before, &dry)[GUIDES - 1], 0.0);
    let line = CutLine::Below(Height::At(-0.2));
    let cut = Cut { selection: Selection::Everything, line, held: Held::Down, ..Cut::default() };
    certified(&done(&before, &Operation::Cut(cut)));
}

#[test]
fn a_draft_takes_few_steps_and_is_not_certified() {
    let before = predicted(&spec(HairContact::Density));
    let draft = predicted_from(&before, &longer(), Effort { iterations: 4, sweeps: 2 });
    let report = settling_report(&draft, &HEAD);
    assert!(report.joint.is_none() && report.sweeps <= 2, "{report:?}");
    let exact = moves(&draft, &predicted(&longer()));
    assert!(exact[GUIDES / 2] < 5e-3, "{exact:?}");
}
