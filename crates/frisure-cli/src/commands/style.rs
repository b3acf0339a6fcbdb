//! `frisure style`: adds, removes and lists the steps of a scene.

use std::fmt::Write as _;
use std::fs::{File, TryLockError};
use std::path::Path;
use std::time::Duration;

use frisure::formats::groom::Format;
use frisure::hairstyle::styling::Operation;
use frisure::scene::edit::{self, EditError};
use frisure::scene::{parse_step, write_step};
use frisure_engine::Error;

use super::{parse_scene, read_text};
use crate::args::Style;
use crate::diagnostics::ExitStatus;
use crate::{console, interrupt, outputs};

/// The name of steps of the command line in errors.
const STEP: &str = "--step";

/// Changes the steps of a scene as the arguments say, or lists them.
pub(crate) fn run(arguments: &Style, quiet: bool) -> Result<ExitStatus, Error> {
    check_output(arguments.output.as_deref())?;
    let _lock = lock_folder(&arguments.scene)?;
    let text = read_text(&arguments.scene)?;
    // An error in the scene itself is shown with its name and line.
    let scene = parse_scene(&arguments.scene, text.clone())?;
    if arguments.list {
        console::say(&list(scene.steps()))?;
        return Ok(ExitStatus::Success);
    }
    // A scene with numbers that `predict` refuses takes no steps.
    scene.hairstyle_spec()?;
    let read = |step: &String| parse_step(STEP, step.as_str());
    let steps = arguments.steps.iter().map(read).collect::<Result<Vec<_>, _>>()?;
    let before = text;
    let text = edited(&before, arguments, &steps).map_err(edit_error)?;
    let output = arguments.output.as_deref().unwrap_or(&arguments.scene);
    if output == arguments.scene && !is_standard(output) {
        check_unchanged(output, &before)?;
    }
    write(output, &text)?;
    if !quiet && !is_standard(output) {
        let left = arguments.remove.map_or(0, |_| 1);
        console::say(&summary(output, scene.steps().len() + steps.len() - left))?;
    }
    Ok(ExitStatus::Success)
}

/// Checks that what is written is named as a scene is: it would replace a groom or a picture of that name.
fn check_output(output: Option<&Path>) -> Result<(), Error> {
    let Some(path) = output.filter(|path| !is_standard(path)) else { return Ok(()) };
    if path.extension().is_some_and(|found| found.eq_ignore_ascii_case("toml")) {
        return Ok(());
    }
    let is_groom = Format::of(path).is_ok();
    let path = path.display();
    let hint = match is_groom {
        true => format!("`frisure predict SCENE -o {path}` writes the hair of a scene"),
        false => "`-o` writes the scene: give it a name such as `styled.toml`".to_owned(),
    };
    Err(Error::invalid(format!("`{path}` does not end in .toml, as a scene does"), &hint))
}

/// Waits until no other `frisure style` edits a scene of this folder, where folders can be locked:
/// two at once would lose steps.
fn lock_folder(scene: &Path) -> Result<Option<File>, Error> {
    let folder = scene.parent().filter(|folder| !folder.as_os_str().is_empty());
    let folder = File::open(folder.unwrap_or(Path::new("."))).ok().filter(|_| !is_standard(scene));
    while let Some(Err(TryLockError::WouldBlock)) = folder.as_ref().map(File::try_lock) {
        interrupt::check()?;
        std::thread::sleep(Duration::from_millis(20));
    }
    Ok(folder)
}

/// Checks that the scene is a file that no other program has changed since it was read.
fn check_unchanged(path: &Path, before: &str) -> Result<(), Error> {
    if !path.is_file() {
        let message = format!("`{}` cannot be written back: it is no file", path.display());
        return Err(Error::invalid(message, "write to another one with `-o`"));
    }
    if read_text(path)? != before {
        let message = format!("`{}` was changed by another program meanwhile", path.display());
        return Err(Error::invalid(message, "run the same command again"));
    }
    Ok(())
}

fn edited(text: &str, arguments: &Style, steps: &[Operation]) -> Result<String, EditError> {
    let removed = arguments.remove.map(|number| edit::remove(text, number - 1)).transpose()?;
    let text = removed.as_deref().unwrap_or(text);
    match arguments.at {
        Some(number) => edit::insert(text, number - 1, steps),
        None => edit::append(text, steps),
    }
}

fn edit_error(error: EditError) -> Error {
    let hint = match &error {
        EditError::NoSuchStep { .. } => "`frisure style SCENE --list` numbers the steps",
        EditError::Scattered => "edit the scene by hand",
        _ => "",
    };
    match error {
        EditError::Scene(error) => error.into(),
        error => Error::because(&error, hint),
    }
}

/// The steps as text, numbered.
fn list(steps: &[Operation]) -> String {
    if steps.is_empty() {
        return "the scene has no steps\n".into();
    }
    let width = steps.len().to_string().len();
    let mut out = String::new();
    for (i, step) in steps.iter().enumerate() {
        let text = write_step(step).unwrap_or_else(|_| step.name().to_owned());
        // The line after the header.
        let text = text.lines().last().unwrap_or("");
        // Writing to a String cannot fail.
        let _ = writeln!(out, "{:width$}  {text}", i + 1);
    }
    out
}

fn is_standard(path: &Path) -> bool {
    path == Path::new("-")
}

fn write(path: &Path, text: &str) -> Result<(), Error> {
    if is_standard(path) {
        return console::print(text);
    }
    outputs::write_text(path, text)
}

fn summary(path: &Path, count: usize) -> String {
    let steps = match count {
        0 => "no steps".to_owned(),
        1 => "1 step".to_owned(),
        count => format!("{count} steps"),
    };
    format!("{} has {steps}\n", console::shown(path))
}
