//! What styling does to a hairstyle: laws that hold for any hair, by step.

mod cutting;
mod growing;
mod holding;
mod selecting;
mod setting;
mod wetting;

use frisure_hairstyle::head::{Head, Region};
use frisure_hairstyle::styling::{
    Cut, CutLine, Dry, Grow, Growth, Height, Held, Operation, Release, Selection, StyleError, Wet,
};
use frisure_hairstyle::{
    HairContact, Hairs, Hairstyle, HairstyleSpec, Place, PredictOptions, StrandOptions,
    StyleOptions, predict, preset, strands, style,
};
use std::sync::LazyLock;

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

fn spec(name: &str, wisps: usize, contact: HairContact) -> HairstyleSpec {
    let mut spec = preset(name).unwrap().spec();
    spec.wisps.count = wisps;
    spec.wisps.hairs = Hairs::Count(300);
    spec.contact.hair = contact;
    spec
}

fn hairstyle(name: &str, wisps: usize) -> Hairstyle {
    predict(&spec(name, wisps, HairContact::Layers), &HEAD, PredictOptions::default(), &()).unwrap()
}

fn done(before: &Hairstyle, operation: &Operation) -> Hairstyle {
    style(before, &HEAD, operation, StyleOptions::default(), &()).unwrap()
}

fn wet() -> Operation {
    Operation::Wet(Wet::default())
}

fn dry() -> Operation {
    Operation::Dry(Dry::default())
}

fn cut_below(z: f64, selection: Selection) -> Operation {
    let line = CutLine::Below(Height::At(z));
    Operation::Cut(Cut { selection, line, held: Held::Down, ..Cut::default() })
}

fn grow(amount: Growth) -> Operation {
    Operation::Grow(Grow { selection: Selection::Everything, amount, stages: 1 })
}

/// Whether two hairstyles are the same to the last bit.
fn same(a: &Hairstyle, b: &Hairstyle) -> bool {
    let shapes = a.equilibria().iter().zip(b.equilibria());
    let drawn = |h: &Hairstyle| strands(h, &HEAD, StrandOptions::default(), &()).unwrap().strands;
    shapes.clone().all(|(a, b)| a.shape == b.shape && a.rod == b.rod) && drawn(a) == drawn(b)
}

/// Largest distance (m) of the tips of two hairstyles.
fn farthest_tip(a: &Hairstyle, b: &Hairstyle) -> f64 {
    let tips = a.equilibria().iter().zip(b.equilibria());
    tips.map(|(a, b)| a.tip().distance(b.tip())).fold(0.0, f64::max)
}

#[test]
fn bad_operations_are_refused() {
    let before = hairstyle("straight", 10);
    let refused = |operation: &Operation| {
        style(&before, &HEAD, operation, StyleOptions::default(), &()).unwrap_err()
    };
    let nobody = Selection::Not(Box::new(Selection::Everything));
    assert_eq!(
        refused(&Operation::Wet(Wet { selection: nobody, ..Wet::default() })),
        StyleError::NothingSelected
    );
    let tenth = Selection::Wisps(vec![10]);
    assert_eq!(
        refused(&Operation::Release(Release { selection: tenth })),
        StyleError::NoSuchWisp { wisp: 10, count: 10 }
    );
    for wetness in [-0.1, 1.1, f64::NAN] {
        let wet = Operation::Wet(Wet { to: wetness, ..Wet::default() });
        assert!(matches!(refused(&wet), StyleError::Invalid(_)));
    }
    let error = refused(&grow(Growth::By(2.9)));
    assert!(matches!(error, StyleError::TooLong { wisp: 0, .. }));
    let words = error.to_string();
    let (_, metres) = words.split_once("would grow to ").unwrap();
    assert_eq!(metres.find(" m;"), Some(4), "two decimals: {words}");
}

#[test]
fn what_is_done_to_different_wisps_can_be_done_in_any_order() {
    let before = hairstyle("caucasian-wavy", 60);
    let place = |region| Selection::Place(Place::Region(region));
    let wet = Operation::Wet(Wet { selection: place(Region::Back), ..Wet::default() });
    let cut = cut_below(0.045, place(Region::Fringe));
    let (a, b) = (done(&done(&before, &wet), &cut), done(&done(&before, &cut), &wet));
    assert!(same(&a, &b));
    // Wet hair is longer: what is left of it is shorter than of dry hair.
    let dry_first = done(&before, &cut_below(0.045, place(Region::Top)));
    let wet_first = done(&done(&before, &self::wet()), &cut_below(0.045, place(Region::Top)));
    let shorter = dry_first.wisps().iter().zip(wet_first.wisps());
    assert!(shorter.clone().all(|(dry, wet)| wet.length <= dry.length));
    assert!(shorter.clone().any(|(dry, wet)| wet.length < dry.length));
}
