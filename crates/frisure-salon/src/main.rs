//! The salon in a window.

fn main() {}
