//! Every experiment, in its quick form.

use frisure_evidence::report::Book;
use frisure_evidence::{EXPERIMENTS, Effort, Experiment};
use rayon::prelude::*;

#[test]
fn every_verdict_holds() {
    // Most experiments compute one thing after another: together they use all processors.
    let run = |experiment: &&Experiment| (experiment.run)(Effort::Quick, &());
    let findings: Vec<_> = EXPERIMENTS.par_iter().map(run).collect();
    let mut chapters = Vec::new();
    for (&experiment, finding) in EXPERIMENTS.iter().zip(findings) {
        let finding = finding.expect(experiment.name);
        assert!(!finding.criteria.is_empty(), "{} checks nothing", experiment.name);
        for criterion in &finding.criteria {
            assert!(criterion.holds(), "{}: {criterion:?}", experiment.name);
        }
        chapters.push((experiment, finding));
    }
    let book = Book { effort: Effort::Quick, chapters };
    assert!(book.holds());
    let (page, text) = (book.html(), book.markdown());
    for experiment in EXPERIMENTS {
        assert!(page.contains(experiment.title) && text.contains(experiment.title));
    }
    for wrong in ["NaN", "inf"] {
        let cells = text.split(['|', ' ', '\n']).filter(|cell| *cell == wrong).count();
        assert_eq!(cells, 0, "{wrong} in the report");
    }
}

#[test]
fn names_are_words_and_differ() {
    for (i, experiment) in EXPERIMENTS.iter().enumerate() {
        assert!(experiment.name.chars().all(|c| c.is_ascii_lowercase() || c == '-'));
        assert!(EXPERIMENTS[..i].iter().all(|e| e.name != experiment.name));
    }
}
