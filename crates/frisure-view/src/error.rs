//! Errors of the view.

use thiserror::Error;

/// Why something cannot be drawn or read.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum ViewError {
    /// A picture without pixels, or with more than the device has.
    #[error("a picture of {width}×{height} pixels: each side must have 1 to {most} here")]
    Size {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Most pixels along a side.
        most: u32,
    },
    /// More than the device can hold at once.
    #[error("{what} needs {needed} bytes, and this device holds {most} at once")]
    TooLarge {
        /// The name of the object.
        what: &'static str,
        /// Bytes.
        needed: u64,
        /// Most bytes.
        most: u64,
    },
    /// The device gave nothing back: it is gone, or its memory is full.
    #[error("the graphics device did not answer: {0}")]
    Lost(String),
}
