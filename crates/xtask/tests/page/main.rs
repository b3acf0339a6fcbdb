//! The salon's page in a real browser.
//!
//! Where no Chromium is installed these tests say so and pass; with `FRISURE_NEEDS_BROWSER` set they
//! fail then. Pictures of the run are kept in `target/tmp/page`.

#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "figures and reasons, for whoever reads a test's output"
)]

mod chromium;
mod failures;
mod lessons;
mod picture;
mod salon;
mod session;
mod site;

use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// A laptop's window.
pub(crate) const SIZE: [u32; 2] = [1280, 800];

/// A browser, and the right to use it: pictures made without a graphics card take all there is, so
/// one test at a time. `None` where there is no browser.
pub(crate) fn browser() -> Option<(PathBuf, MutexGuard<'static, ()>)> {
    static ONE: Mutex<()> = Mutex::new(());
    static BUILT: OnceLock<()> = OnceLock::new();
    let Some(program) = chromium::installed() else {
        let needed = std::env::var_os("FRISURE_NEEDS_BROWSER").is_some();
        assert!(!needed, "FRISURE_NEEDS_BROWSER is set, but there is no Chromium");
        eprintln!("not tested: there is no Chromium");
        return None;
    };
    let turn = ONE.lock().unwrap_or_else(PoisonError::into_inner);
    BUILT.get_or_init(site::build);
    Some((program, turn))
}
