//! The gate: what every change must pass, each thing built and tested once.

use crate::page;
use anyhow::{Context, Result, anyhow, ensure};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};
use xtask::workspace::{root, say};

/// The deepest that a predicted hair may be inside the head (m).
const MOST_PENETRATION: f64 = 5e-4;

/// The smallest groom and picture of the README's main command that are not broken (bytes).
const LEAST_GROOM: u64 = 10_000_000;
const LEAST_PICTURE: u64 = 100_000;

/// Runs the gate; the quick one leaves out what takes minutes.
pub(crate) fn run(quick: bool) -> Result<()> {
    let gate = Gate::default();
    gate.step("format", || cargo("fmt --all --check"))?;
    gate.step("spelling", spelling)?;
    if quick {
        gate.step("lints", || cargo(CLIPPY))?;
        gate.step("unit tests", || {
            cargo("test --workspace --all-features --locked --lib --bins --test tidy --test architecture")
        })?;
        gate.step("one scene", || {
            // With an example, as in `.ci/run`: the features of the tests.
            cargo("build --workspace --all-features --locked --bins --example first_head")?;
            predict(&root().join("target/debug/frisure"), &root().join("scenes/short-asian.toml"))
        })?;
    } else {
        // Tests leave a third of two cores idle: what does not need them goes on beside them, and what is mostly one thing after another beside
        // what uses all cores.
        let gate = &gate;
        thread::scope(|scope| {
            let beside: [fn(&Gate) -> Result<()>; 2] = [other_builds, other_programs];
            let beside = beside.map(|steps| scope.spawn(move || steps(gate)));
            let first = tests(gate);
            let panics = |_| Err(anyhow!("the steps beside the tests panic"));
            let others = beside.into_iter().map(|steps| steps.join().unwrap_or_else(panics));
            others.fold(first, Result::and).map_err(|error| gate.failure().unwrap_or(error))
        })?;
    }
    gate.report();
    Ok(())
}

const CLIPPY: &str = "clippy --workspace --all-targets --all-features --locked -- -D warnings";

/// The steps that the tests need, and those with what the tests have built.
fn tests(gate: &Gate) -> Result<()> {
    gate.step("page", || page::build(false))?;
    gate.step("the README's test command", || run_tests(&readme_command("cargo test ")?))?;
    gate.step("examples", examples)
}

/// The steps that need the release build, lints, and documents. What a program prints comes when its step is done.
fn other_builds(gate: &Gate) -> Result<()> {
    gate.step("dependencies", dependencies)?;
    gate.step("the README's main command", main_command)?;
    gate.step("every scene", every_scene)?;
    // Not before the tests are compiled: both are built in the same folder, and one would wait for the other.
    gate.step("lints", || shell_beside(&format!("cargo {CLIPPY}")))?;
    gate.step("documentation", || {
        shell_beside(
            "RUSTDOCFLAGS='-D warnings' cargo doc --workspace --all-features --no-deps --locked",
        )
    })?;
    gate.step("packages", || {
        shell_beside("cargo package --workspace --no-verify --allow-dirty --locked --quiet")
    })?;
    gate.step("mutated files", || {
        // About a minute; the tests have made a shorter run of it.
        shell_beside("FRISURE_MUTATIONS=10000 cargo test --workspace --all-features --locked --test mutated -- --nocapture")
    })
}

/// The steps of programs in Python. Most of their work is one thing after another.
fn other_programs(gate: &Gate) -> Result<()> {
    gate.step("programs that open grooms", || {
        // `.ci/run` has built this one, with every feature.
        shell_beside("FRISURE=target/debug/frisure validation/clients/run")
    })?;
    gate.step("scripts for clusters", || shell_beside("validation/cluster/run"))?;
    gate.step("the Python package", || shell_beside("crates/frisure-python/tests/run"))?;
    // With the wheel of the step before.
    gate.step("the extension for Blender", || shell_beside("blender/tests/run"))
}

/// A program that gives way to the tests: they are the longer way and seldom use two cores, and what is left is enough for it.
fn beside(program: impl AsRef<OsStr>) -> Command {
    let mut command = Command::new("nice");
    command.args(["-n", "5"]).arg(program);
    command
}

/// The steps so far, with their times.
#[derive(Default)]
struct Gate {
    times: Mutex<Vec<(&'static str, Duration)>>,
    /// Whether a step has failed: no other begins then.
    failed: AtomicBool,
    /// What the failed steps said, with the end of what they printed: other steps may print much after them.
    failures: Mutex<Vec<String>>,
}

impl Gate {
    fn step(&self, name: &'static str, run: impl FnOnce() -> Result<()>) -> Result<()> {
        ensure!(!self.failed.load(Ordering::Relaxed), "\"{name}\" is not begun: a step has failed");
        say(&format!("\n== {name}"));
        let start = Instant::now();
        run().with_context(|| format!("step \"{name}\" fails")).inspect_err(|error| {
            self.failed.store(true, Ordering::Relaxed);
            self.failures.lock().unwrap_or_else(PoisonError::into_inner).push(format!("{error:#}"));
            say(&format!("{error:#}"));
        })?;
        let time = start.elapsed();
        say(&format!("{:.1} s for the step \"{name}\"", time.as_secs_f64()));
        self.times.lock().unwrap_or_else(PoisonError::into_inner).push((name, time));
        Ok(())
    }

    /// What has failed, if anything has.
    fn failure(&self) -> Option<anyhow::Error> {
        let failures = self.failures.lock().unwrap_or_else(PoisonError::into_inner);
        (!failures.is_empty()).then(|| anyhow!(failures.join("\n")))
    }

    fn report(&self) {
        say("\nall gates passed");
        for (name, time) in self.times.lock().unwrap_or_else(PoisonError::into_inner).iter() {
            say(&format!("{:7.1} s  {name}", time.as_secs_f64()));
        }
    }
}

fn cargo(arguments: &str) -> Result<()> {
    shell(&format!("cargo {arguments}"))
}

/// Runs a line of a shell in the workspace.
fn shell(line: &str) -> Result<()> {
    say(line);
    let status = Command::new("bash").args(["-c", line]).current_dir(root()).status()?;
    ensure!(status.success(), "`{line}` ends with {status}");
    Ok(())
}

/// Runs a line of tests in the workspace; its error has the lines of what was printed that tell which failed.
fn run_tests(line: &str) -> Result<()> {
    let log = root().join("target/tests.log");
    let logged = format!("set -o pipefail; {{ {line}; }} 2>&1 | tee '{}'", log.display());
    shell(&logged).map_err(|error| {
        let printed = fs::read_to_string(&log).unwrap_or_default();
        let tells = |line: &&str| {
            ["FAILED", "panicked at", "error"].iter().any(|word| line.contains(word))
                && !line.ends_with("... ok")
        };
        let lines: Vec<&str> = printed.lines().filter(tells).collect();
        anyhow!("{error}:\n{}", end_of(&lines.join("\n")))
    })
}

/// The same as [`shell`]; says afterwards what the line printed.
fn shell_beside(line: &str) -> Result<()> {
    let Output { status, stdout, stderr } =
        beside("bash").args(["-c", line]).current_dir(root()).stdin(Stdio::null()).output()?;
    let (errors, output) = (String::from_utf8_lossy(&stderr), String::from_utf8_lossy(&stdout));
    say(&format!("{line}\n{errors}{output}"));
    ensure!(
        status.success(),
        "`{line}` ends with {status}:\n{}\n{}",
        end_of(&errors),
        end_of(&output)
    );
    Ok(())
}

/// The last lines of what a program printed: its error is among them.
fn end_of(printed: &str) -> String {
    const MOST: usize = 20;
    let lines: Vec<&str> = printed.trim_end().lines().collect();
    lines[lines.len().saturating_sub(MOST)..].join("\n")
}

/// Checks the spelling where `typos` is installed; `.ci/run` installs it.
fn spelling() -> Result<()> {
    let program = root().join("target/typos/bin/typos");
    let program = if program.is_file() { program } else { "typos".into() };
    match Command::new(program).current_dir(root()).status() {
        Ok(status) => {
            ensure!(status.success(), "there are misspelled words; _typos.toml has the exceptions");
        }
        Err(_) => say("skipped: `typos` is not installed (`pip install typos`)"),
    }
    Ok(())
}

/// Checks the rules of `deny.toml` where `cargo-deny` is installed; `.ci/run` installs it.
fn dependencies() -> Result<()> {
    let program = root().join("target/deny/bin/cargo-deny");
    let program = if program.is_file() { program } else { "cargo-deny".into() };
    let check = ["--locked", "check", "bans", "licenses", "sources"];
    match Command::new(program).args(check).current_dir(root()).status() {
        Ok(status) => ensure!(status.success(), "a dependency breaks a rule of deny.toml"),
        Err(_) => say("skipped: `cargo-deny` is not installed (`cargo install cargo-deny`)"),
    }
    Ok(())
}

/// The first line of the README that begins so.
fn readme_command(start: &str) -> Result<String> {
    let readme = fs::read_to_string(root().join("README.md"))?;
    let line = readme.lines().find(|line| line.starts_with(start));
    Ok(line.with_context(|| format!("README.md has no `{start}`"))?.to_owned())
}

/// Runs every example that takes no arguments; the tests have built them.
fn examples() -> Result<()> {
    for package in xtask::source::packages(&root())? {
        let Ok(folder) = fs::read_dir(package.folder.join("examples")) else { continue };
        let mut files = folder.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>>>()?;
        files.retain(|path| path.extension().is_some_and(|kind| kind == "rs"));
        files.sort();
        for file in files {
            if !fs::read_to_string(&file)?.contains("env::args") {
                let name = file.file_stem().unwrap_or_default();
                say(&format!("{}: {}", package.name, name.display()));
                run_example(Path::new(name))?;
            }
        }
    }
    Ok(())
}

fn run_example(name: &Path) -> Result<()> {
    let program = root().join("target/debug/examples").join(name);
    let output = Command::new(program).current_dir(root()).stdin(Stdio::null()).output()?;
    let said = String::from_utf8_lossy(&output.stderr);
    ensure!(output.status.success(), "the example {} fails: {said}", name.display());
    Ok(())
}

/// Runs the README's main command and checks its groom and its picture.
fn main_command() -> Result<()> {
    let out = root().join("out");
    for file in ["curly.hair", "curly.png"] {
        let _ = fs::remove_file(out.join(file));
    }
    shell_beside(&readme_command("cargo run ")?)?;
    for (file, start, least) in [
        ("curly.hair", &b"HAIR"[..], LEAST_GROOM),
        ("curly.png", b"\x89PNG\r\n\x1a\n", LEAST_PICTURE),
    ] {
        let bytes = fs::read(out.join(file))?;
        ensure!(bytes.starts_with(start), "out/{file} does not begin as such a file does");
        ensure!(bytes.len() as u64 > least, "out/{file} has only {} bytes", bytes.len());
    }
    Ok(())
}

fn every_scene() -> Result<()> {
    let mut scenes = Vec::new();
    for entry in fs::read_dir(root().join("scenes"))? {
        scenes.push(entry?.path());
    }
    scenes.retain(|path| path.extension().is_some_and(|kind| kind == "toml"));
    scenes.sort();
    let frisure = root().join("target/release/frisure");
    scenes.iter().try_for_each(|scene| predict(&frisure, scene))
}

/// Predicts a scene; every guide must converge, and no hair may be in the head.
fn predict(frisure: &Path, scene: &Path) -> Result<()> {
    let name = scene.file_stem().unwrap_or_default().to_string_lossy();
    let report = format!("out/{name}.json");
    let mut command = beside(frisure);
    command.arg("predict").arg(scene).args(["--report", &report]);
    let Output { status, stdout, stderr } = command.current_dir(root()).output()?;
    say(&format!("{}{}", String::from_utf8_lossy(&stderr), String::from_utf8_lossy(&stdout)));
    ensure!(status.success(), "{} ends with {status}", scene.display());
    let report = fs::read_to_string(root().join(report))?;
    ensure!(report.contains("\"not_converged\": 0"), "{name}: guides have not converged");
    for line in report.lines().filter(|line| line.contains("penetration\":")) {
        let depth = line.split(':').nth(1).unwrap_or_default().trim().trim_end_matches(',');
        let depth: f64 = depth.parse().with_context(|| format!("{name}: {line}"))?;
        ensure!(depth <= MOST_PENETRATION, "{name}: a hair is {depth} m inside the head");
    }
    Ok(())
}
