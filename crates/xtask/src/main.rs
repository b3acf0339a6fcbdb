//! Builds and serves the page of the salon.

fn main() {}
