//! Checks of descriptions.

use super::description::{Hairs, HairstyleSpec, Parting, RegionLength, RegionStyle, Wisps};
use super::numbers::{NUMBERS, within};
use super::ranges::InvalidSpec;
use crate::math::segments_cross;

/// Most hairs of a head.
const MAX_HAIRS: usize = 1_000_000;

/// Most points of all drawn hairs of a head: 3 GB of positions and radii.
const MAX_POINTS: usize = 200_000_000;

impl HairstyleSpec {
    /// Checks every number against the range in which it means something.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first field that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        self.check_except(&[])
    }

    /// As [`Self::check`], without the numbers at these paths, for callers that allow more of them.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first other field that is out of range.
    pub fn check_except(&self, paths: &[&str]) -> Result<(), InvalidSpec> {
        let mut checked = NUMBERS.iter().filter(|number| !paths.contains(&number.range.field));
        checked.try_for_each(|number| number.check(self))?;
        self.implantation.partings.iter().try_for_each(Parting::check)?;
        self.regions.iter().try_for_each(RegionStyle::check)?;
        // Without a head, the number of hairs of a density is unknown.
        if !matches!(self.wisps.hairs, Hairs::Density(_)) {
            self.wisps.check_size(0.0)?;
        }
        self.equilibrium.resolution.check().map_err(|e| InvalidSpec {
            field: "equilibrium",
            value: e.value.to_string(),
            allowed: e.allowed,
        })
    }
}

impl Wisps {
    /// Checks how much is drawn on a scalp of this weighted area (m²).
    pub(crate) fn check_size(&self, scalp_area: f64) -> Result<(), InvalidSpec> {
        let hairs = self.hair_count(scalp_area);
        let refuse = |field, allowed| Err(InvalidSpec { field, value: hairs.to_string(), allowed });
        if hairs > MAX_HAIRS {
            return match self.hairs {
                Hairs::Count(_) => refuse("wisps.hairs", "between 1 and 1000000"),
                Hairs::PerWisp(_) => {
                    refuse("wisps.hairs_per_wisp", "so few that a head has at most 1000000 hairs")
                }
                Hairs::Density(_) => {
                    refuse("wisps.density", "so low that this head has at most 1000000 hairs")
                }
            };
        }
        if hairs.saturating_mul(self.points) > MAX_POINTS {
            let value = format!("{} for each of {hairs} hairs", self.points);
            let allowed = "so few that there are at most 200000000 points in all";
            return Err(InvalidSpec { field: "wisps.points", value, allowed });
        }
        Ok(())
    }
}

impl Parting {
    /// Checks what can be checked without a head.
    ///
    /// # Errors
    /// [`InvalidSpec`], if it is out of reach, not a line, or crosses itself.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        let points = match self {
            Self::Straight { offset } | Self::Zigzag { offset } => {
                return within("implantation.partings.offset", *offset);
            }
            Self::Through(points) => points,
        };
        let field = "implantation.partings.line";
        let refuse = |value: String, allowed| Err(InvalidSpec { field, value, allowed });
        if !(2..=100).contains(&points.len()) {
            return refuse(format!("of {} points", points.len()), "a line of 2 to 100 points");
        }
        let reached = |p: &[f64; 2]| p[0].abs() <= 0.25 && (-0.05..=0.45).contains(&p[1]);
        if let Some([x, y]) = points.iter().find(|p| !reached(p)) {
            let allowed = "within 25 cm across, and -5 to 45 cm back";
            return refuse(format!("through [{x}, {y}] m"), allowed);
        }
        if points.windows(2).any(|w| (w[0][0] - w[1][0]).hypot(w[0][1] - w[1][1]) < 1e-3) {
            return refuse(
                "through two points at one place".into(),
                "of points 1 mm apart or more",
            );
        }
        let crossed = (0..points.len() - 1).find_map(|i| {
            let later = (i + 2..points.len() - 1)
                .find(|&j| segments_cross(points[i], points[i + 1], points[j], points[j + 1]));
            later.map(|j| (i + 1, j + 1))
        });
        match crossed {
            Some((i, j)) => {
                let value = format!("crossing itself: piece {i} crosses piece {j}");
                refuse(value, "a line that does not cross itself")
            }
            None => Ok(()),
        }
    }
}

impl RegionStyle {
    /// Checks every number against the range in which it means something.
    ///
    /// # Errors
    /// [`InvalidSpec`], naming the first field that is out of range.
    pub fn check(&self) -> Result<(), InvalidSpec> {
        if self.places.is_empty() {
            let value = "nowhere".to_owned();
            return Err(InvalidSpec { field: "region.where", value, allowed: "one place or more" });
        }
        if let Some(RegionLength::Mean(length)) = self.length {
            within("region.length", length)?;
        }
        if let Some(lift) = self.lift {
            within("region.lift", lift)?;
        }
        within("region.curl", self.curl.unwrap_or(1.0))
    }
}
