//! What is done to a head of hair, each step until all is at rest again.
//!
//! `cargo bench -p frisure-hairstyle --bench styling`

use divan::Bencher;
use frisure_hairstyle::head::{Head, Region};
use frisure_hairstyle::styling::{
    Cut, CutLine, Grow, Growth, Height, Held, Operation, Selection, Wet,
};
use frisure_hairstyle::{
    HairContact, Hairs, Hairstyle, Place, PredictOptions, StyleOptions, predict, preset, style,
};
use frisure_rod::Resolution;

fn main() {
    divan::main();
}

const CONTACTS: [HairContact; 2] = [HairContact::Layers, HairContact::Wisps];

/// The head of the paper: 100 guides × 15 elements.
fn hairstyle(head: &Head, contact: HairContact) -> Hairstyle {
    let mut spec = preset("caucasian-curly").expect("a preset").spec();
    spec.wisps.count = 100;
    spec.wisps.hairs = Hairs::Count(20_000);
    spec.contact.hair = contact;
    spec.equilibrium.resolution = Resolution::Elements(15);
    predict(&spec, head, PredictOptions::default(), &()).expect("a valid description")
}

fn styled(bencher: Bencher<'_, '_>, contact: usize, before: &[Operation], operation: &Operation) {
    let head = Head::mannequin();
    let start = hairstyle(&head, CONTACTS[contact]);
    let hair = before.iter().fold(start, |hair, operation| {
        style(&hair, &head, operation, StyleOptions::default(), &())
            .expect("an operation that can be done")
    });
    bencher.bench(|| style(&hair, &head, operation, StyleOptions::default(), &()));
}

fn wetting() -> Operation {
    Operation::Wet(Wet::default())
}

fn fringe() -> Operation {
    Operation::Cut(Cut {
        selection: Selection::Place(Place::Region(Region::Fringe)),
        line: CutLine::Below(Height::At(0.0)),
        held: Held::Down,
        ..Cut::default()
    })
}

/// All hair wetted: in layers, and among wisps.
#[divan::bench(args = 0..2, sample_count = 8)]
fn wet(bencher: Bencher<'_, '_>, contact: usize) {
    styled(bencher, contact, &[], &wetting());
}

/// The wet fringe cut.
#[divan::bench(args = 0..2, sample_count = 8)]
fn cut(bencher: Bencher<'_, '_>, contact: usize) {
    styled(bencher, contact, &[wetting()], &fringe());
}

/// All hair cut at the chin as it hangs: each drawn hair where it crosses the line.
#[divan::bench(args = 0..2, sample_count = 8)]
fn cut_as_it_hangs(bencher: Bencher<'_, '_>, contact: usize) {
    styled(bencher, contact, &[], &Operation::Cut(Cut::default()));
}

/// All hair dried after the fringe was cut.
#[divan::bench(args = 0..2, sample_count = 8)]
fn dry(bencher: Bencher<'_, '_>, contact: usize) {
    let drying = Operation::Dry(frisure_hairstyle::styling::Dry::default());
    styled(bencher, contact, &[wetting(), fringe()], &drying);
}

/// A centimetre grown.
#[divan::bench(args = 0..2, sample_count = 8)]
fn grow(bencher: Bencher<'_, '_>, contact: usize) {
    let (selection, amount) = (Selection::Everything, Growth::By(0.01));
    styled(bencher, contact, &[], &Operation::Grow(Grow { selection, amount, stages: 1 }));
}
