//! The `frisure` command.
fn main() {}
