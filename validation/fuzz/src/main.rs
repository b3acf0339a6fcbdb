//! Writes the corpus of a target into a folder, for libFuzzer to begin with: `frisure-fuzz scene FOLDER`.

#![forbid(unsafe_code)]

use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            let _ = writeln!(io::stderr().lock(), "{message}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<(), String> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let names = || {
        let targets = frisure_fuzz::targets();
        targets.into_iter().map(|target| target.name).collect::<Vec<_>>().join(", ")
    };
    let [name, folder] = arguments.as_slice() else {
        return Err(format!("usage: frisure-fuzz TARGET FOLDER\nTargets: {}", names()));
    };
    let Some(target) = frisure_fuzz::target(name) else {
        return Err(format!("there is no target `{name}`; there are {}", names()));
    };
    let folder = Path::new(folder);
    let wrong = |e: io::Error| format!("{}: {e}", folder.display());
    fs::create_dir_all(folder).map_err(wrong)?;
    for (i, bytes) in target.corpus.iter().enumerate() {
        fs::write(folder.join(format!("{name}-{i}")), bytes).map_err(wrong)?;
    }
    Ok(())
}
