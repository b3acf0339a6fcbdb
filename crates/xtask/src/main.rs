//! Jobs around the workspace: `cargo xtask measure`, `cargo xtask page --serve`.

#![forbid(unsafe_code)]

#[cfg(feature = "page")]
mod ci;
#[cfg(feature = "page")]
mod page;
#[cfg(feature = "page")]
mod serve;

use clap::{Args, Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;
use xtask::workspace::{root, say};

/// Jobs around the workspace that cargo does not do.
#[derive(Parser)]
#[command(name = "xtask")]
struct Arguments {
    #[command(subcommand)]
    job: Job,
}

#[derive(Subcommand)]
enum Job {
    /// Print the size of the code, the lengths of its functions, its comments and its circles
    Measure(Measure),

    /// Check the rules about the tree that no compiler checks: words, lengths, circles, links
    Tidy,

    /// Run the gate: all that a change must pass
    #[cfg(feature = "page")]
    Ci {
        /// Only format, spelling, lints, unit tests and one scene
        #[arg(long)]
        quick: bool,
    },

    /// Build the page of the salon into `out/page`, ready for any static host
    #[cfg(feature = "page")]
    Page(Page),
}

#[derive(Args)]
struct Measure {
    /// Another copy of the workspace
    #[arg(long, value_name = "DIR")]
    root: Option<PathBuf>,
}

#[cfg(feature = "page")]
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
    match run(&Arguments::parse().job) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            complain(&failure);
            ExitCode::FAILURE
        }
    }
}

fn run(job: &Job) -> anyhow::Result<()> {
    match job {
        Job::Measure(asked) => {
            let here = root();
            say(xtask::measure::report(asked.root.as_deref().unwrap_or(&here))?.trim_end());
            Ok(())
        }
        Job::Tidy => {
            let broken = xtask::tidy::broken(&root())?;
            broken.iter().for_each(|place| say(place));
            anyhow::ensure!(broken.is_empty(), "{} places break a rule", broken.len());
            Ok(())
        }
        #[cfg(feature = "page")]
        Job::Ci { quick } => ci::run(*quick),
        #[cfg(feature = "page")]
        Job::Page(asked) => build_page(asked),
    }
}

#[cfg(feature = "page")]
fn build_page(asked: &Page) -> anyhow::Result<()> {
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
