//! Tests of the real program: one binary, so that it is linked once.

mod batch;
mod hair;
mod help;
mod predict;
mod room;
mod style;
mod validate;
mod wrong;
