//! The hairs of the comparison, their true shapes, and frisure's times: README.md.
//!
//! ```text
//! frisure-peers hairs OUT.json [COUNT [SEED]]   the one hair and COUNT more (1000), with true shapes
//! frisure-peers time HAIRS.json OUT.json        frisure's errors and processor times on them, on one thread
//! ```

#![forbid(unsafe_code)]

mod cpu;
mod hairs;
mod measure;
mod truth;

use std::error::Error;
use std::io::BufReader;
use std::path::Path;
use std::process::ExitCode;
use std::{env, fs};

use frisure::rod::{InvalidQuantity, Rod};
use serde::{Deserialize, Serialize};

use hairs::Hair;
use measure::Sample;
use truth::{Truth, truth};

/// A hair and its true shape; `None` if the boundary-value problem has no solution.
#[derive(Debug, Deserialize, Serialize)]
struct Case {
    hair: Hair,
    truth: Option<Truth>,
}

/// The input of all solvers.
#[derive(Debug, Deserialize, Serialize)]
struct Cases {
    seed: u64,
    one: Case,
    many: Vec<Case>,
}

fn main() -> ExitCode {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let done = match words[..] {
        ["hairs", out, ref rest @ ..] if rest.len() <= 2 => write_hairs(out, rest),
        ["time", hairs, out] => time(hairs, out),
        _ => {
            Err("usage: frisure-peers hairs OUT.json [COUNT [SEED]] | time HAIRS.json OUT.json"
                .into())
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            use std::io::Write as _;
            let _ = writeln!(std::io::stderr().lock(), "frisure-peers: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write_hairs(out: &str, rest: &[&str]) -> Result<(), Box<dyn Error>> {
    let number = |k: usize, default: u64| match rest.get(k) {
        None => Ok(default),
        Some(text) => text.parse().map_err(|_| format!("'{text}' is not a whole number")),
    };
    write(out, &cases(number(0, 1000)?, number(1, 7)?)?)
}

fn cases(count: u64, seed: u64) -> Result<Cases, InvalidQuantity> {
    let case = |rod: Rod| Case { hair: Hair::of(&rod), truth: truth(&rod) };
    let many = (0..count).map(|item| hairs::turned(seed, item).map(case));
    Ok(Cases { seed, one: case(hairs::the_one()?), many: many.collect::<Result<_, _>>()? })
}

fn time(from: &str, out: &str) -> Result<(), Box<dyn Error>> {
    let file = fs::File::open(from).map_err(|e| format!("{from}: {e}"))?;
    let cases: Cases =
        serde_json::from_reader(BufReader::new(file)).map_err(|e| format!("{from}: {e}"))?;
    write(out, &sample(&cases)?.measure(false))
}

/// The rods of the cases with a true shape.
fn sample(cases: &Cases) -> Result<Sample, Box<dyn Error>> {
    let one = cases.one.truth.as_ref().ok_or("the one hair has no true shape")?;
    let (mut rods, mut tips) = (Vec::new(), Vec::new());
    for (item, case) in (0..).zip(&cases.many) {
        if let Some(truth) = &case.truth {
            rods.push(hairs::turned(cases.seed, item)?);
            tips.push(truth.tip());
        }
    }
    if rods.is_empty() {
        return Err("no hair of the file has a true shape".into());
    }
    Ok(Sample { one: (hairs::the_one()?, one.tip()), rods, tips })
}

fn write(path: &str, what: &impl Serialize) -> Result<(), Box<dyn Error>> {
    let text = serde_json::to_string(what)?;
    fs::write(Path::new(path), text).map_err(|e| format!("{path}: {e}").into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_and_every_hair_is_a_minimum() {
        let made = cases(16, 7).unwrap();
        let written = serde_json::to_string(&made).unwrap();
        assert!(written == serde_json::to_string(&cases(16, 7).unwrap()).unwrap());
        let read: Cases = serde_json::from_str(&written).unwrap();
        for (made, read) in made.many.iter().zip(&read.many) {
            let (made, read) = (made.truth.as_ref().unwrap(), read.truth.as_ref().unwrap());
            // Parsing may change the last digit.
            assert!(made.tip().distance(read.tip()) < 1e-16);
        }
        let sample = sample(&read).unwrap();
        assert_eq!(sample.rods.len(), 16);
        let found = serde_json::to_value(sample.measure(true)).unwrap();
        for way in found.as_array().unwrap() {
            assert_eq!(way["failed"], 0, "{way}");
            assert!(way["seconds_one"].as_f64().unwrap() > 0.0, "{way}");
        }
    }
}
