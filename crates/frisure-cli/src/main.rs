//! The program `frisure`; the library of this crate has everything.

#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    frisure_cli::run(std::env::args_os()).into()
}
