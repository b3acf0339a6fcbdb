//! The salon as WebAssembly, and the JavaScript that calls it.

use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// Compiles the salon for the page.
pub(crate) fn salon(dev: bool) -> Result<PathBuf> {
    have_target()?;
    let profile = if dev { "dev" } else { "page" };
    // A folder of its own: this build and those for this computer do not wait for each other.
    let target = target_folder().join("wasm");
    let done = cargo()
        .args(["build", "--lib", "-p", "frisure-salon", "--locked"])
        .args(["--target", TARGET, "--profile", profile, "--target-dir"])
        .arg(&target)
        // What cargo tells the programs that it runs is not about the page.
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env_remove("RUSTFLAGS")
        .current_dir(xtask::workspace::root())
        .status()
        .context("cannot run cargo")?;
    if !done.success() {
        bail!("the salon does not compile for {TARGET}");
    }
    let folder = if dev { "debug" } else { profile };
    Ok(target.join(TARGET).join(folder).join("frisure_salon.wasm"))
}

/// Writes `salon_bg.wasm` and the module `salon.js` that starts it.
pub(crate) fn bind(wasm: &Path, folder: &Path) -> Result<()> {
    let mut bindgen = wasm_bindgen_cli_support::Bindgen::new();
    bindgen
        .input_path(wasm)
        .out_name("salon")
        .web(true)?
        .typescript(false)
        .remove_name_section(true)
        .remove_producers_section(true)
        .generate(folder)
        .context(
            "wasm-bindgen refused the salon; are both its crates at one version in Cargo.lock?",
        )
}

fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// The folder of builds.
pub(super) fn target_folder() -> PathBuf {
    let asked = std::env::var_os("CARGO_TARGET_DIR").map(PathBuf::from);
    xtask::workspace::root().join(asked.unwrap_or_else(|| "target".into()))
}

/// Adds the target with rustup where it is missing.
fn have_target() -> Result<()> {
    if library_exists()? {
        return Ok(());
    }
    xtask::workspace::say(&format!("adding the target {TARGET}"));
    let added = Command::new("rustup").args(["target", "add", TARGET]).status();
    match added {
        Ok(status) if status.success() => Ok(()),
        Ok(_) => bail!("rustup could not add the target {TARGET}: see above"),
        Err(_) => bail!(
            "Rust's library for {TARGET} is missing, and there is no rustup to add it: install it \
             the way you installed Rust (a package named like rust-std-{TARGET})"
        ),
    }
}

fn library_exists() -> Result<bool> {
    let told = Command::new("rustc")
        .args(["--print", "target-libdir", "--target", TARGET])
        .output()
        .context("cannot run rustc")?;
    Ok(Path::new(String::from_utf8_lossy(&told.stdout).trim()).is_dir())
}

#[cfg(test)]
mod tests {
    /// The version of a crate in Cargo.lock.
    fn locked(name: &str) -> String {
        let lock =
            std::fs::read_to_string(xtask::workspace::root().join("Cargo.lock")).expect("lock");
        let start = lock.find(&format!("name = \"{name}\"\n")).expect("a locked crate");
        let line = lock[start..].lines().nth(1).expect("its version");
        line.trim_start_matches("version = ").trim_matches('"').to_owned()
    }

    #[test]
    fn the_two_halves_of_wasm_bindgen_are_of_one_version() {
        assert_eq!(locked("wasm-bindgen"), locked("wasm-bindgen-cli-support"));
    }
}
