//! Every program of this package: the target that has the name of the program.

#![no_main]

use std::sync::LazyLock;

use frisure_fuzz::{Target, target};
use libfuzzer_sys::fuzz_target;

static TARGET: LazyLock<Target> =
    LazyLock::new(|| target(env!("CARGO_BIN_NAME")).expect("the programs have the names of targets"));

fuzz_target!(|bytes: &[u8]| (TARGET.run)(bytes));
