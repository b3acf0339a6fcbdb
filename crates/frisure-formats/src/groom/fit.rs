//! A groom with fewer hairs and points, for programs that take no more.

use frisure_strands::Strands;
use thiserror::Error;

use super::checked::THICKEST;
use super::data::Groom;

/// How many points strands have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Points {
    /// Those that they have.
    #[default]
    Own,
    /// So many each, evenly spaced along it: see [`Strands::resampled`].
    Even(usize),
    /// So many at most, those that it would miss most: see [`Strands::simplified`].
    AtMost(usize),
}

/// How many hairs and points are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fit {
    /// The number of hairs, if fewer are wanted than there are: see [`Strands::thinned`].
    pub hairs: Option<usize>,
    /// Whether fewer hairs have the width that they had; else they cover the area of all.
    pub keep_widths: bool,
    /// Points of hairs and guides.
    pub points: Points,
}

/// Why there is no such groom.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum FitError {
    /// More hairs are wanted than there are.
    #[error("{wanted} hairs are more than the groom has: {long} with a length and a width{}", without(*short))]
    Hairs {
        /// The number wanted.
        wanted: usize,
        /// Hairs with a length and a width.
        long: usize,
        /// Hairs without one of these.
        short: usize,
    },
    /// There is not one hair to choose from.
    #[error("the groom has no hairs to choose from")]
    NoHairs,
    /// So few hairs would be thicker than any reader takes.
    #[error(
        "{wanted} of {before} hairs would have to be {thick:.1} mm thick to cover what all of them cover: at most {most:.0} mm"
    )]
    Thick {
        /// The number wanted.
        wanted: usize,
        /// The number before.
        before: usize,
        /// Their largest thickness (mm).
        thick: f32,
        /// The most that there can be (mm).
        most: f32,
    },
}

fn without(short: usize) -> String {
    if short == 0 { String::new() } else { format!(", {short} without") }
}

/// A groom that was made to fit, and what was done to it.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The groom.
    pub groom: Groom,
    /// The number of hairs before, if there are fewer now.
    pub hairs_before: Option<usize>,
    /// Factor on the widths of hairs.
    pub widening: f32,
    /// Largest distance (m) of a point of a strand before from what it is now.
    pub error: f32,
}

impl Groom {
    /// The groom with fewer hairs and points.
    ///
    /// # Errors
    /// [`FitError`], if more hairs are wanted than there are, or so few that they would be thicker than 2 cm.
    pub fn fitted(&self, fit: Fit) -> Result<Fitted, FitError> {
        let hairs = fit.hairs.map(|count| thinned(&self.hairs, count, fit.keep_widths));
        let (hairs, widening) = hairs.transpose()?.unwrap_or_else(|| (self.hairs.clone(), 1.0));
        let before = Some(self.hairs.len()).filter(|before| *before > hairs.len());
        let with = |strands: &Strands| match fit.points {
            Points::Own => (strands.clone(), 0.0),
            Points::Even(points) => {
                let resampled = strands.resampled(points);
                (resampled.strands, resampled.error)
            }
            Points::AtMost(points) => {
                let simplified = strands.simplified(points);
                (simplified.strands, simplified.error)
            }
        };
        let ((hairs, of_hairs), (guides, of_guides)) = (with(&hairs), with(&self.guides));
        let Self { name, head, accessories, colour, times, .. } = self;
        let (name, head, accessories) = (name.clone(), head.clone(), accessories.clone());
        let groom = Self { name, hairs, guides, head, accessories, colour: *colour, times: *times };
        Ok(Fitted { groom, hairs_before: before, widening, error: of_hairs.max(of_guides) })
    }
}

impl Fit {
    /// Whether it leaves every groom as it is.
    #[must_use]
    pub fn is_nothing(self) -> bool {
        self.hairs.is_none() && self.points == Points::Own
    }
}

/// `count` of the hairs, and the factor on their widths.
fn thinned(hairs: &Strands, count: usize, keep_widths: bool) -> Result<(Strands, f32), FitError> {
    if hairs.is_empty() {
        return Err(FitError::NoHairs);
    }
    let thinned = hairs.thinned(count);
    let (found, before) = (thinned.rows.len(), hairs.len());
    if found < count {
        return Err(FitError::Hairs { wanted: count, long: found, short: before - found });
    }
    if keep_widths {
        return Ok((hairs.picked(&thinned.rows), 1.0));
    }
    let widest = thinned.strands.radii().iter().copied().fold(0.0, f32::max);
    if widest > THICKEST && thinned.widening > 1.0 {
        let (thick, most) = (2e3 * widest, 2e3 * THICKEST);
        return Err(FitError::Thick { wanted: count, before, thick, most });
    }
    Ok((thinned.strands, thinned.widening))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn groom(count: usize) -> Groom {
        let mut hairs = Strands::new();
        for i in 0..count {
            let root = Vec3::new(0.001 * i as f32, 0.0, 0.0);
            hairs.push(&[root, root - 0.1 * Vec3::Z], &[40e-6; 2]);
        }
        Groom::of(hairs)
    }

    #[test]
    fn fewer_hairs_are_wider() {
        let fit = Fit { hairs: Some(10), ..Fit::default() };
        let fitted = groom(100).fitted(fit).unwrap();
        assert_eq!((fitted.groom.hairs.len(), fitted.hairs_before), (10, Some(100)));
        assert!((fitted.groom.hairs.radii()[0] / 400e-6 - 1.0).abs() < 1e-5);
        let kept = groom(100).fitted(Fit { keep_widths: true, ..fit }).unwrap();
        assert_eq!((kept.groom.hairs.radii()[0], kept.widening), (40e-6, 1.0));
    }

    #[test]
    fn what_cannot_be_is_told() {
        let told = |groom: &Groom, hairs| {
            groom.fitted(Fit { hairs: Some(hairs), ..Fit::default() }).unwrap_err().to_string()
        };
        let mut some = groom(9);
        some.hairs.push(&[Vec3::ZERO; 2], &[4e-5; 2]);
        let expected =
            "10 hairs are more than the groom has: 9 with a length and a width, 1 without";
        assert_eq!(told(&some, 10), expected);
        assert!(some.fitted(Fit { hairs: Some(9), ..Fit::default() }).is_ok());
        assert_eq!(told(&Groom::default(), 1), "the groom has no hairs to choose from");
        assert!(told(&groom(1000), 1).contains("1 of 1000 hairs would have to be 80.0 mm thick"));
    }
}
