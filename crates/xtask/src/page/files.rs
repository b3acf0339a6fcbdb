//! The files of the page that are written by hand.

use anyhow::{Context, Result};
use flate2::Crc;
use std::fs;
use std::path::Path;

/// An empty folder.
pub(crate) fn empty(folder: &Path) -> Result<()> {
    if folder.exists() {
        fs::remove_dir_all(folder).with_context(|| format!("cannot empty {}", folder.display()))?;
    }
    fs::create_dir_all(folder).with_context(|| format!("cannot make {}", folder.display()))
}

/// Copies them, with the build's name and the size of its WebAssembly filled in.
pub(crate) fn write_by_hand(folder: &Path) -> Result<()> {
    let wasm = fs::read(folder.join("salon_bg.wasm"))?;
    let build = build_name(&wasm, &fs::read(folder.join("salon.js"))?);
    let source = xtask::workspace::root().join("crates/frisure-salon/page");
    for entry in fs::read_dir(&source).with_context(|| format!("no {}", source.display()))? {
        let from = entry?.path();
        let Some(name) = from.file_name() else { continue };
        let to = folder.join(name);
        match from.extension().and_then(|e| e.to_str()) {
            Some("html" | "js") => {
                let text = fs::read_to_string(&from)?;
                fs::write(&to, filled_in(&text, &build, wasm.len()))
            }
            _ => fs::copy(&from, &to).map(|_| ()),
        }
        .with_context(|| format!("cannot write {}", to.display()))?;
    }
    Ok(())
}

fn filled_in(text: &str, build: &str, bytes: usize) -> String {
    text.replace("{{build}}", build).replace("{{bytes}}", &bytes.to_string())
}

/// What files of this build are asked for with (`?v=`), so that a browser never mixes two builds.
fn build_name(wasm: &[u8], script: &[u8]) -> String {
    let mut sum = Crc::new();
    sum.update(wasm);
    sum.update(script);
    format!("{:08x}", sum.sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_names_its_build() {
        let text = filled_in("<html data-build=\"{{build}}\" data-bytes=\"{{bytes}}\">", "ab", 7);
        assert_eq!(text, "<html data-build=\"ab\" data-bytes=\"7\">");
        assert_ne!(build_name(b"a", b""), build_name(b"b", b""));
    }
}
