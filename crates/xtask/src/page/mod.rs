//! The page: the salon for WebAssembly, its JavaScript, and what is written by hand.

mod compile;
mod files;
mod sizes;

pub(crate) use sizes::beside;

use anyhow::{Context, Result};
use std::path::PathBuf;
use xtask::workspace::{root, say};

/// Where the page is built.
pub(crate) fn folder() -> PathBuf {
    root().join("out/page")
}

/// Compiles the salon, writes the page, tells its size, and refuses one that is too large.
pub(crate) fn build(dev: bool) -> Result<()> {
    let wasm = compile::salon(dev)?;
    let folder = folder();
    files::empty(&folder)?;
    compile::bind(&wasm, &folder)?;
    files::write_by_hand(&folder)?;
    let sizes = sizes::compress(&folder, dev).context("cannot compress the page")?;
    say(&sizes.table());
    say(&format!("the page is in {}", folder.display()));
    match dev {
        true => Ok(()),
        false => sizes.check(),
    }
}
