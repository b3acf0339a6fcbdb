//! The `frisure` command: arguments in `args`, then one file per command in `commands`.
//!
//! The program `frisure` and the Python package call [`run`].

#![forbid(unsafe_code)]

mod args;
mod commands;
mod console;
mod diagnostics;
mod grooms;
mod hair_checkpoint;
mod interrupt;
mod outputs;
mod pictures;
mod progress;

use std::ffi::OsString;

use clap::Parser;

use args::{Arguments, Command, MAX_THREADS};
use diagnostics::{ExitStatus, exit_code};
use frisure::scene::quoted;
use frisure_engine::Error;

pub use diagnostics::plain;

/// The exit status of a command line that cannot be read, if it does not fit a byte; clap has 2 for all of them.
const USAGE: u8 = 2;

/// Runs the command of a command line, whose first argument is the name of the program, and returns its exit status.
///
/// Prints to standard output and standard error, and takes over Ctrl-C: call it once in a process, which ends then.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    interrupt::let_writes_fail();
    let arguments = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => arguments,
        Err(error) => {
            // What was asked for, such as the help, is a document as any other.
            if !error.use_stderr() {
                return match console::print_coloured(&error.render().ansi().to_string()) {
                    Ok(()) => ExitStatus::Success.into(),
                    Err(error) => {
                        console::show_error(&error);
                        exit_code(&error)
                    }
                };
            }
            // Where standard error is closed, the exit status still says what happened.
            let _ = error.print();
            return u8::try_from(error.exit_code()).unwrap_or(USAGE);
        }
    };
    match interrupt::run(move || execute(arguments)) {
        Ok(status) => status.into(),
        Err(error) => {
            progress::clear();
            outputs::remove_empty_folders();
            console::show_error(&error);
            exit_code(&error)
        }
    }
}

/// The environment's numbers of threads, the first of which that is set `rayon` takes where it gets none.
const THREADS: [&str; 2] = ["RAYON_NUM_THREADS", "RAYON_RS_NUM_CPUS"];

/// Starts the threads that compute: as many as asked for on the command line, or by the environment.
fn start_threads(asked: Option<usize>) -> Result<(), Error> {
    let asked = match asked {
        Some(threads) => Some(("--threads", threads)),
        None => THREADS.into_iter().map(threads_by).find_map(Result::transpose).transpose()?,
    };
    let Some((by, threads)) = asked else { return Ok(()) };
    // Each thread takes memory and time: the system would be busy with a million of them for ever.
    if threads > MAX_THREADS {
        let hint = format!("set it to at most {MAX_THREADS}, or leave it out");
        return Err(Error::invalid(format!("`{by}` asks for {threads} threads"), &hint));
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
    pool.build_global().map_err(|e| Error::failed(&e, "ask for fewer threads by `--threads`"))
}

/// The number of threads that a variable of the environment asks for, if it is set.
fn threads_by(name: &'static str) -> Result<Option<(&'static str, usize)>, Error> {
    let set = std::env::var_os(name).filter(|value| !value.is_empty());
    let Some(value) = set else { return Ok(None) };
    let number = value.to_str().and_then(|value| value.trim().parse().ok());
    let number = number.ok_or_else(|| {
        let problem = format!("`{name}` is \"{}\"", quoted(&value.to_string_lossy()));
        let allowed = format!("it must be a whole number of threads, at most {MAX_THREADS}");
        Error::invalid(format!("{problem}; {allowed}"), "set it so, or leave it out")
    })?;
    Ok(Some((name, number)))
}

fn execute(arguments: Arguments) -> Result<ExitStatus, Error> {
    start_threads(arguments.threads)?;
    let quiet = arguments.quiet;
    match arguments.command {
        Command::Predict(predict) => commands::predict::run(&predict, quiet),
        #[cfg(feature = "batch")]
        Command::Batch(batch) => commands::batch::run(&batch, quiet),
        #[cfg(not(feature = "batch"))]
        Command::Batch(_) => Err(commands::not_built("batch")),
        Command::Style(style) => commands::style::run(&style, quiet),
        Command::Render(render) => commands::render::run(render, quiet),
        Command::View(view) => commands::render::view(view, quiet),
        Command::Cards(cards) => commands::cards::run(&cards, quiet),
        Command::Convert(convert) => commands::convert::run(&convert, quiet),
        Command::Transfer(transfer) => commands::transfer::run(transfer, quiet),
        Command::Hair(hair) => commands::hair::run(&hair),
        Command::Presets(arguments) => commands::presets::run(&arguments),
        Command::New(new) => commands::new::run(&new),
        Command::Fit(fit) => commands::fit::run(&fit, quiet),
        Command::Measure(measure) => commands::measure::run(&measure, quiet),
        Command::Measured(measured) => commands::measured::run(&measured, quiet),
        Command::Schema => commands::schema::run(),
        #[cfg(feature = "validate")]
        Command::Validate(validate) => commands::validate::run(&validate, quiet),
        #[cfg(not(feature = "validate"))]
        Command::Validate(_) => Err(commands::not_built("validate")),
    }
}
