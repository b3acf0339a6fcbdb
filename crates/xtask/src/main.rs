//! Builds and serves the page of the salon: `cargo run --release -p xtask -- page --serve`.

mod page;
mod serve;

use clap::{Args, Parser, Subcommand};
use std::process::ExitCode;

/// Jobs around the workspace that cargo does not do.
#[derive(Parser)]
#[command(name = "xtask")]
struct Arguments {
    #[command(subcommand)]
    job: Job,
}

#[derive(Subcommand)]
enum Job {
    /// Build the page of the salon into `out/page`, ready for any static host
    Page(Page),
}

#[derive(Args)]
struct Page {
    /// Serve it on this computer, at this port
    #[arg(long, value_name = "PORT", num_args = 0..=1, default_missing_value = "8080")]
    serve: Option<u16>,

    /// Serve what is in `out/page` without building it
    #[arg(long, requires = "serve")]
    built: bool,

    /// Serve it under this path, as some hosts do
    #[arg(long, value_name = "PATH", default_value = "", requires = "serve")]
    under: String,

    /// Serve it without the headers that let the page share memory with its workers, as some hosts do
    #[arg(long, requires = "serve")]
    plain: bool,

    /// Build quickly, for trying things out: larger, and its size is not checked
    #[arg(long)]
    dev: bool,
}

fn main() -> ExitCode {
    let Job::Page(asked) = Arguments::parse().job;
    match run(&asked) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            complain(&failure);
            ExitCode::FAILURE
        }
    }
}

fn run(asked: &Page) -> anyhow::Result<()> {
    if !asked.built {
        page::build(asked.dev)?;
    }
    match asked.serve {
        Some(port) => serve::serve(&page::folder(), port, &asked.under, asked.plain),
        None => Ok(()),
    }
}

fn complain(failure: &anyhow::Error) {
    use std::io::Write;
    // With a closed stderr there is nobody to tell.
    let _ = writeln!(std::io::stderr().lock(), "xtask: {failure:#}");
}

/// A line for whoever started this; a closed pipe is no reason to stop.
pub(crate) fn say(line: &str) {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    let _ = writeln!(out, "{line}").and_then(|()| out.flush());
}
