//! What a graphics processor can refuse.

use frisure_rod::batch::Unsettled;
use thiserror::Error;

/// Why hairs were not brought to rest on a graphics processor. [`frisure_rod::batch::Batch`] does the same without one.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum Error {
    /// There is none, or no driver for it.
    #[error(
        "no {what} that can compute (Vulkan, Metal or DirectX 12): {why}; hint: install its driver, \
         or bring hairs to rest with frisure_rod::batch::Batch, which needs none"
    )]
    NoAdapter {
        /// What was looked for.
        what: &'static str,
        /// What the graphics interface says.
        why: String,
    },
    /// There is one, but it does not have what this needs.
    #[error(
        "{name} cannot be used: {why}; hint: frisure_rod::batch::Batch does the same on the processor"
    )]
    Unfit {
        /// The adapter.
        name: String,
        /// What the graphics interface says.
        why: String,
    },
    /// No elements, or more than the device has room for.
    #[error(
        "hairs of {given} elements: this device takes 1 to {most}; hint: six elements a turn of the curl keep \
         tips within a per cent of the length, and frisure_rod::batch::Batch takes any number"
    )]
    Elements {
        /// Elements of each hair.
        given: usize,
        /// Most of them.
        most: usize,
    },
    /// Not as many turns as joints.
    #[error("{given} turns of joints: these hairs have {needed}, one for each element")]
    Turns {
        /// How many were given.
        given: usize,
        /// How many joints there are.
        needed: usize,
    },
    /// It ran out of memory, or refused a command.
    #[error(
        "the graphics processor refused: {0}; hint: frisure_rod::batch::Batch does the same on the processor"
    )]
    Refused(String),
    /// It is gone: unplugged, reset, or its driver gave it up.
    #[error(
        "the graphics processor was lost: {0}; hint: make a new Device, or use frisure_rod::batch::Batch"
    )]
    Lost(String),
}

impl From<Error> for Unsettled {
    fn from(error: Error) -> Self {
        match error {
            Error::Elements { given: 0, .. } => Self::NoElements,
            Error::Turns { given, needed } => Self::Turns { given, needed },
            other => Self::Device(Box::new(other)),
        }
    }
}
