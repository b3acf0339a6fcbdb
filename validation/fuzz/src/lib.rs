//! The readers of frisure as targets of fuzzing: each takes bytes, reads them, and uses what it read. A target panics only if frisure has
//! a fault.
//!
//! `tests/mutated.rs` runs them with mutations of the corpus on the stable compiler; the package in `fuzz` runs them with
//! libFuzzer, guided by coverage. docs/reliability.md says how.

#![forbid(unsafe_code)]

pub mod mutate;
mod readers;

pub use readers::targets;

/// Reads bytes, and uses what it reads.
pub type Reader = Box<dyn Fn(&[u8]) + Send + Sync>;

/// A reader under test.
pub struct Target {
    /// Its name, such as `groom-usda`: letters, digits and hyphens.
    pub name: String,
    /// Files to begin with.
    pub corpus: Vec<Vec<u8>>,
    /// The reader.
    pub run: Reader,
}

impl std::fmt::Debug for Target {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Target").field("name", &self.name).finish_non_exhaustive()
    }
}

/// The target of a name.
#[must_use]
pub fn target(name: &str) -> Option<Target> {
    targets().into_iter().find(|target| target.name == name)
}
