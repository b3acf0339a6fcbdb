//! The list of what was done to a hairstyle can be undone, redone, edited and replayed.

use std::sync::LazyLock;

use frisure_hairstyle::head::Head;
use frisure_hairstyle::styling::{
    Cut, CutLine, Dry, Grow, Growth, Height, Held, Operation, Selection, StyleError, Wet,
};
use frisure_hairstyle::{
    HairContact, Hairs, Hairstyle, History, PredictOptions, StrandOptions, StyleOptions, predict,
    preset, strands, style,
};
use frisure_progress::{Cancelled, Progress};

static HEAD: LazyLock<Head> = LazyLock::new(Head::mannequin);

fn start() -> Hairstyle {
    let mut spec = preset("caucasian-wavy").unwrap().spec();
    spec.wisps.count = 20;
    spec.wisps.hairs = Hairs::Count(200);
    spec.contact.hair = HairContact::Layers;
    predict(&spec, &HEAD, PredictOptions::default(), &()).unwrap()
}

fn wet() -> Operation {
    Operation::Wet(Wet::default())
}

fn dry() -> Operation {
    Operation::Dry(Dry::default())
}

fn cut(length: f64) -> Operation {
    Operation::Cut(Cut { line: CutLine::Length(length), ..Cut::default() })
}

fn grow(by: f64) -> Operation {
    let (selection, amount) = (Selection::Everything, Growth::By(by));
    Operation::Grow(Grow { selection, amount, stages: 1 })
}

fn same(a: &Hairstyle, b: &Hairstyle) -> bool {
    let shapes = a.equilibria().iter().zip(b.equilibria());
    let drawn = |h: &Hairstyle| strands(h, &HEAD, StrandOptions::default(), &()).unwrap().strands;
    a.wisps() == b.wisps()
        && shapes.clone().all(|(a, b)| a.shape == b.shape)
        && drawn(a) == drawn(b)
}

fn history(operations: &[Operation]) -> History {
    let mut history = History::new(start());
    for operation in operations {
        history.apply(operation.clone(), &HEAD, &()).unwrap();
    }
    history
}

#[test]
fn what_is_undone_and_done_again_is_the_same_to_the_last_bit() {
    let mut history = history(&[wet(), cut(0.12), dry()]);
    let end = history.current().clone();
    for _ in 0..3 {
        assert_eq!(history.undo(&HEAD, &()), Ok(true));
    }
    assert_eq!(history.undo(&HEAD, &()), Ok(false));
    assert!(same(history.current(), history.start()));
    for _ in 0..3 {
        assert_eq!(history.redo(&HEAD, &()), Ok(true));
    }
    assert_eq!(history.redo(&HEAD, &()), Ok(false));
    assert!(same(history.current(), &end));
    let operations = history.operations().to_vec();
    let again = History::replay(start(), operations, 3, &HEAD, &()).unwrap();
    assert!(same(again.current(), &end));
}

#[test]
fn a_list_edited_in_the_middle_is_that_list_done_from_the_start() {
    let mut edited = history(&[wet(), cut(0.15), dry()]);
    edited.replace(1, cut(0.10), &HEAD, &()).unwrap();
    assert!(same(edited.current(), history(&[wet(), cut(0.10), dry()]).current()));
    edited.insert(2, grow(0.01), &HEAD, &()).unwrap();
    let whole = [wet(), cut(0.10), grow(0.01), dry()];
    assert_eq!(edited.operations(), whole);
    assert!(same(edited.current(), history(&whole).current()));
    edited.remove(1, &HEAD, &()).unwrap();
    assert!(same(edited.current(), history(&[wet(), grow(0.01), dry()]).current()));
    // Among what is undone, an edit changes nothing yet.
    edited.undo(&HEAD, &()).unwrap();
    let now = edited.current().clone();
    edited.replace(2, cut(0.1), &HEAD, &()).unwrap();
    assert!(same(edited.current(), &now) && edited.done() == 2);
}

#[test]
fn what_was_forgotten_is_computed_again() {
    let mut long = history(&vec![grow(0.001); 40]);
    let end = long.current().clone();
    long.go_to(3, &HEAD, &()).unwrap();
    assert!(same(long.current(), history(&vec![grow(0.001); 3]).current()));
    long.go_to(40, &HEAD, &()).unwrap();
    assert!(same(long.current(), &end));
}

struct Stop;

impl Progress for Stop {
    fn report(&self, _stage: &str, _fraction: f64) {}

    fn is_cancelled(&self) -> bool {
        true
    }
}

#[test]
fn an_edit_that_fails_loses_nothing() {
    let mut history = history(&[cut(0.12), dry()]);
    history.undo(&HEAD, &()).unwrap();
    let (now, operations) = (history.current().clone(), history.operations().to_vec());
    let height = CutLine::Below(Height::At(0.3));
    let above =
        Cut { selection: Selection::Everything, line: height, held: Held::Down, ..Cut::default() };
    let error = history.replace(0, Operation::Cut(above), &HEAD, &()).unwrap_err();
    assert_eq!(error.step, 0);
    assert!(matches!(error.error, StyleError::AboveRoot { selected: 20, .. }), "{error}");
    let error = history.apply(wet(), &HEAD, &Stop).unwrap_err();
    assert_eq!(error.error, StyleError::Cancelled(Cancelled));
    assert!(same(history.current(), &now));
    assert_eq!((history.operations(), history.done()), (operations.as_slice(), 1));
}

#[test]
fn another_list_is_taken_over_with_what_is_known() {
    let mut history = history(&[wet(), cut(0.12), dry()]);
    let cut_hair = history.known(2).unwrap().clone();
    let list = vec![wet(), cut(0.12), grow(0.01)];
    history.follow(list.clone(), 2, &HEAD, &()).unwrap();
    assert!(std::sync::Arc::ptr_eq(&cut_hair, history.known(2).unwrap()));
    assert_eq!((history.done(), history.operations()), (2, list.as_slice()));
    history.follow(list, 3, &HEAD, &()).unwrap();
    let grown = style(&cut_hair, &HEAD, &grow(0.01), StyleOptions::default(), &()).unwrap();
    assert!(same(history.current(), &grown));
    // Of a list that cannot be done it does what it can.
    let error = history.follow(vec![wet(), grow(9.0), dry()], 3, &HEAD, &()).unwrap_err();
    assert_eq!((error.step, history.done()), (1, 1));
    assert!(history.known(1).is_some() && history.known(2).is_none());
}
