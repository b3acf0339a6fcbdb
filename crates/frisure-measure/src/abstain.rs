//! Why a photo was not measured.

use serde::Serialize;
use thiserror::Error;

/// Least number of waves. Chosen: fewer do not tell a wave from a bow.
pub(crate) const LEAST_WAVES: f64 = 1.5;

/// Least amplitude and wavelength (pixels of the photo). Chosen.
pub(crate) const LEAST_AMPLITUDE: f64 = 3.0;
pub(crate) const LEAST_WAVELENGTH: f64 = 12.0;

/// Least part of the line's variance about its axis that the wave explains. Tuned on renders with seeds below 1000.
pub(crate) const LEAST_EXPLAINED: f64 = 0.6;

/// Largest standard deviation of radius or pitch, as a part of it. Tuned on renders with seeds below 1000.
pub(crate) const MOST_DEVIATION: f64 = 0.1;

/// Largest angle (rad) to the vertical of a lock that hangs: 20 degrees. Chosen: its weight would bend it as a whole.
pub(crate) const MOST_TILT: f64 = 0.35;

/// Factor by which the amplitudes of middle line, ridge lines and directions may differ. Tuned on renders with seeds below 1000.
pub(crate) const MOST_APART: f64 = 1.6;

/// Shortest and longest line of a lock (m). Chosen: the longest hair on record is 5.6 m.
pub(crate) const LENGTHS: [f64; 2] = [1e-3, 6.0];

/// Least length that may be given of a hair, over that of its line in the photo, which is known to some per cent. Chosen.
pub(crate) const SHORTEST: f64 = 0.8;

/// Why no radius and pitch are given.
#[derive(Clone, Copy, Debug, Error, PartialEq, Serialize)]
#[serde(tag = "reason", rename_all = "snake_case")]
pub enum Abstention {
    /// The background is not smooth.
    #[error("the background is not plain: it varies by {:.0} % (at most 6 % is plain)", 100.0 * deviation)]
    Background {
        /// Standard deviation of its brightness, of 0 to 1.
        deviation: f64,
    },
    /// Nothing differs from the background.
    #[error("no hair differs from the background")]
    NoHair,
    /// Too much of the picture differs from the background.
    #[error("{:.0} % of the picture differs from the background", 100.0 * part)]
    Crowded {
        /// Part of the picture that differs.
        part: f64,
    },
    /// Several things of about the same size are in the picture.
    #[error("there are several things in the picture, and the second has {:.0} % of the first's size", 100.0 * part)]
    Several {
        /// Size of the second over that of the first.
        part: f64,
    },
    /// The lock is straight, within what the picture tells.
    #[error("the middle line is straight within {:.2} mm; if all hairs run along it, the curvature of the curl is at most {most_curvature:.0} 1/m (a radius of {:.0} mm or more in a plane)", 1e3 * deviation, 1e3 / most_curvature)]
    Straight {
        /// Deviation from a straight line (m), root mean square.
        deviation: f64,
        /// Upper bound of the curvature (1/m).
        most_curvature: f64,
    },
    /// The lock has too few waves.
    #[error("only {waves:.1} waves are seen (at least 1.5 are needed)")]
    FewWaves {
        /// Waves seen, about.
        waves: f64,
    },
    /// The waves are too small for the picture.
    #[error(
        "the waves are {amplitude:.1} px high and {wavelength:.1} px long (at least 3 px and 12 px are needed)"
    )]
    Coarse {
        /// Amplitude (pixels of the photo).
        amplitude: f64,
        /// Wavelength (pixels of the photo).
        wavelength: f64,
    },
    /// No wave explains the line of the lock.
    #[error("no wave runs along the lock: the best explains {:.0} % of its line (at least {:.0} % are needed)", 100.0 * explained, 100.0 * LEAST_EXPLAINED)]
    NoWave {
        /// Part of the line's variance that is explained.
        explained: f64,
    },
    /// Two wavelengths explain the line about as well.
    #[error("waves of {:.1} mm and of {:.1} mm are about equally likely", 1e3 * first, 1e3 * second)]
    Ambiguous {
        /// The better wavelength (m).
        first: f64,
        /// The other (m).
        second: f64,
    },
    /// It does not hang.
    #[error("the lock lies {:.0} degrees from the vertical (at most {:.0} are a lock that hangs)", tilt.abs().to_degrees(), MOST_TILT.to_degrees())]
    Aslant {
        /// Angle of its axis to the photo's vertical (rad).
        tilt: f64,
    },
    /// Hairs do not run as the wave of the whole does.
    #[error("the outline has a wave of {:.2} mm, and the lines in it one of {:.2} mm: they are not hairs that run with it", 1e3 * line, 1e3 * other)]
    Disagree {
        /// Amplitude (m) of the middle line.
        line: f64,
        /// Amplitude (m) by ridge lines or by directions.
        other: f64,
    },
    /// The line of the lock has a length that hair has not.
    #[error("the line of the lock is {:.3} m long by the scale of the photo (hair is from {:.3} to {:.0} m)", length, LENGTHS[0], LENGTHS[1])]
    Scale {
        /// Length of the line (m).
        length: f64,
    },
    /// The hair is given as shorter than what is seen of it.
    #[error("{:.0} mm of the lock are seen, and its hair is given as {:.0} mm long", 1e3 * seen, 1e3 * given)]
    Short {
        /// Length of the line that is seen (m).
        seen: f64,
        /// Length that was given (m).
        given: f64,
    },
    /// No line runs along the wave.
    #[error("no line of hair runs along the wave")]
    Unsupported,
    /// The error bars are too wide.
    #[error("the error bars are too wide: {:.0} % of the radius, {:.0} % of the pitch (at most {:.0} %)", 100.0 * radius, 100.0 * pitch, 100.0 * MOST_DEVIATION)]
    Uncertain {
        /// Standard deviation of the radius over the radius.
        radius: f64,
        /// Standard deviation of the pitch over the pitch.
        pitch: f64,
    },
}

impl Abstention {
    /// What can be done about it.
    #[must_use]
    pub fn hint(&self) -> &'static str {
        match self {
            Self::Background { .. } => {
                "photograph the lock in front of paper or cloth of one colour, or give --crop around the lock, without the ruler"
            }
            Self::NoHair => "use a background that is much lighter or darker than the hair",
            Self::Crowded { .. } => "leave background free on both sides of the lock; see --crop",
            Self::Several { .. } => {
                "give --crop x,y,width,height around one lock, without the ruler"
            }
            Self::Straight { .. } => {
                "nothing is wrong if the hair is straight; of hairs that cross, take a single one"
            }
            Self::FewWaves { .. } => "photograph a longer lock",
            Self::Coarse { .. } => "go nearer, so that a wave is 12 px long and 6 px wide at least",
            Self::NoWave { .. } => "take fewer hairs that run together, or a single one",
            Self::Aslant { .. } => {
                "turn the photo so that down is down; --hang none is for a lock that lies flat"
            }
            Self::Disagree { .. } | Self::Unsupported => {
                "look at --overlay: what was followed is no lock, or its hairs cross; give --crop around one lock"
            }
            Self::Scale { .. } => "is the scale right, such as 52 px/mm and not 52 mm/px?",
            Self::Short { .. } => {
                "give the length of the hair from the place where it is held to its tip, or none; and is the scale right?"
            }
            Self::Ambiguous { .. } => "take fewer hairs, or a single one",
            Self::Uncertain { .. } => {
                "photograph a longer lock or from nearer; diameter, length and hair type, if they are given, tell more of the fibre"
            }
        }
    }
}
