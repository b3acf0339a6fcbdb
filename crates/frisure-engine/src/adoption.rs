//! How well the groom of another program keeps its shape as physical hair.

use std::fmt;

use frisure::hairstyle::Adoption;
use serde::{Deserialize, Serialize};

/// How well the strands of a groom keep the shape that was modelled; SI units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct AdoptionReport {
    /// Strands that became guides.
    pub strands: usize,
    /// Those that stay within a millimetre.
    pub within_a_millimetre: usize,
    /// Median distance (m) of strands in equilibrium from the groom.
    pub median_distance: f64,
    /// Largest of these distances (m).
    pub largest_distance: f64,
    /// Those that are unstable in this shape.
    pub unstable: usize,
    /// Factor on the bending stiffness that the worst of them needs.
    pub stiffness_needed: f64,
    /// Those that are inside the head in the groom.
    #[serde(default)]
    pub inside: usize,
    /// Those that are rooted more than a centimetre from the skin.
    #[serde(default)]
    pub off_skin: usize,
    /// Strands of the groom without length, which are left out.
    #[serde(default)]
    pub left_out: usize,
    /// At how many times the file has the groom, of which the first was taken; 0 or 1 of a groom that does not move.
    #[serde(default)]
    pub times: usize,
    /// Indices of the strands that moved by more than a millimetre, the farthest first; at most a hundred.
    pub moved: Vec<usize>,
}

/// Distance (m) below which a strand counts as unmoved; chosen: well below what a picture shows.
const UNMOVED: f64 = 1e-3;

/// Factor on the stiffness above which no fibre is possible; chosen.
const IMPOSSIBLE: f64 = 1000.0;

/// Most strands that are listed in `moved`.
const LISTED: usize = 100;

impl AdoptionReport {
    /// Summarises an adoption.
    #[must_use]
    pub fn of(adoption: &Adoption) -> Self {
        let Adoption { distances, stiffness_needed, left_out, inside, off_skin, times } = adoption;
        let mut order: Vec<usize> = (0..distances.len()).collect();
        order.sort_by(|&a, &b| distances[b].total_cmp(&distances[a]).then(a.cmp(&b)));
        let distance = |rank: usize| order.get(rank).map_or(0.0, |&i| distances[i]);
        let moved = order.iter().take_while(|&&i| distances[i] > UNMOVED).count();
        Self {
            strands: distances.len(),
            within_a_millimetre: distances.len() - moved,
            median_distance: distance(distances.len() / 2),
            largest_distance: distance(0),
            unstable: stiffness_needed.iter().filter(|f| **f > 1.0).count(),
            stiffness_needed: stiffness_needed.iter().copied().fold(1.0, f64::max),
            inside: *inside,
            off_skin: *off_skin,
            left_out: *left_out,
            times: *times,
            moved: order[..moved.min(LISTED)].to_vec(),
        }
    }
}

impl fmt::Display for AdoptionReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { strands, within_a_millimetre, median_distance, largest_distance, .. } = self;
        write!(
            f,
            "{within_a_millimetre} of {strands} guides stay within 1 mm (median {:.2} mm, farthest {:.1} mm)",
            1e3 * median_distance,
            1e3 * largest_distance
        )?;
        if self.unstable > 0 {
            write!(f, "; {} unstable with this fibre; ", are(self.unstable))?;
            match self.stiffness_needed {
                times if times < IMPOSSIBLE => {
                    write!(f, "the worst needs {times:.1} times the bending stiffness")?;
                }
                _ => f.write_str("no fibre is stiff enough for the worst")?,
            }
        }
        if self.inside > 0 {
            write!(f, "; {} inside the head in the groom and moved out", are(self.inside))?;
        }
        if self.off_skin > 0 {
            write!(f, "; {} rooted more than 1 cm from the skin", are(self.off_skin))?;
        }
        if self.left_out > 0 {
            write!(f, "; {} without length and left out", are(self.left_out))?;
        }
        if self.times > 1 {
            write!(f, "; of {} times that the groom has the first is taken", self.times)?;
        }
        if 2 * within_a_millimetre < *strands {
            f.write_str("; check that this is the head of the groom, and which axis is up")?;
        }
        Ok(())
    }
}

/// A count of strands with its verb.
fn are(count: usize) -> String {
    if count == 1 { "1 strand is".to_owned() } else { format!("{count} strands are") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strands_that_moved_are_counted_and_listed() {
        let distances = vec![1e-4, 0.02, 2e-4, 3e-3, 0.0];
        let stiffness_needed = vec![1.0, 6.5, 1.0, 1.0, 1.0];
        let (left_out, inside, off_skin, times) = (2, 1, 4, 3);
        let adoption = Adoption { distances, stiffness_needed, left_out, inside, off_skin, times };
        let report = AdoptionReport::of(&adoption);
        assert_eq!(report.moved, [1, 3]);
        assert_eq!(
            report.to_string(),
            "3 of 5 guides stay within 1 mm (median 0.20 mm, farthest 20.0 mm); 1 strand is unstable with \
             this fibre; the worst needs 6.5 times the bending stiffness; 1 strand is inside the head in the \
             groom and moved out; 4 strands are rooted more than 1 cm from the skin; 2 strands are without length and left out; of 3 times that the groom has the first \
             is taken"
        );
    }
}
