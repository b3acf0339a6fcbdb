//! Every reader on mutated files: nothing panics, and a groom that is read is written as a file that is read again.
//!
//! Mutations are drawn from a fixed seed, so a run is repeated exactly. `FRISURE_MUTATIONS=100000 cargo test -p frisure-fuzz --test
//! mutated -- --nocapture` makes a longer run and prints its figures; an input that fails is left in `target/tmp`.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use frisure::rod::SplitMix64;
use frisure_fuzz::mutate::mutated;
use frisure_fuzz::{Target, targets};

/// Mutations of each target, if the environment gives no number: seconds in all.
const MUTATIONS: u64 = 1500;

#[expect(clippy::print_stdout, reason = "figures of a long run, with --nocapture")]
#[test]
fn mutated_files_end_no_program() {
    let asked = std::env::var("FRISURE_MUTATIONS").ok().map(|n| n.parse().expect("a number"));
    let mutations = asked.unwrap_or(MUTATIONS);
    let mut failed = Vec::new();
    for Target { name, corpus, run } in targets() {
        assert!(!corpus.is_empty(), "{name}");
        let mut random = SplitMix64(0);
        let works = |bytes: &[u8]| catch_unwind(AssertUnwindSafe(|| run(bytes))).is_ok();
        let mut check = |input: Vec<u8>, what: String| {
            if !works(&input) {
                let file = format!("mutated-{name}-{what}");
                fs::write(Path::new(env!("CARGO_TARGET_TMPDIR")).join(&file), &input).unwrap();
                failed.push(file);
            }
        };
        for (i, input) in corpus.iter().enumerate() {
            check(input.clone(), format!("corpus-{i}"));
        }
        for i in 0..mutations {
            check(mutated(&corpus, &mut random), i.to_string());
        }
        println!("{name}: {} of the corpus, {mutations} mutations", corpus.len());
    }
    assert!(failed.is_empty(), "these are in target/tmp: {failed:?}");
}

#[test]
fn each_target_is_a_program_of_libfuzzer() {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/Cargo.toml");
    let manifest = fs::read_to_string(manifest).unwrap();
    let named =
        manifest.lines().filter_map(|line| line.strip_prefix("name = \"")?.strip_suffix('"'));
    // The first name is the package's.
    let named: Vec<&str> = named.skip(1).collect();
    let targets = targets();
    let expected: Vec<&str> = targets.iter().map(|target| target.name.as_str()).collect();
    assert_eq!(named, expected, "fuzz/Cargo.toml lists the targets in their order");
}
