//! How well the hair of another program hangs as it was modelled, for people.

use std::fmt;

use frisure::hairstyle::Adoption;
use serde::{Deserialize, Serialize};

/// How well a groom's strands hang as they were modelled; SI units.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Held {
    /// Strands that became guides.
    pub strands: usize,
    /// Those that stay within a millimetre.
    pub within_a_millimetre: usize,
    /// Distance (m) of strands at rest from the groom: the median's.
    pub median_distance: f64,
    /// The largest of these distances (m).
    pub largest_distance: f64,
    /// Those whose shape is not stable.
    pub unstable: usize,
    /// How many times as stiff the worst of them would have to be.
    pub stiffness_needed: f64,
    /// Those that the groom has in the head.
    #[serde(default)]
    pub inside: usize,
    /// Strands of the groom that have no length and were left out.
    #[serde(default)]
    pub left_out: usize,
    /// Numbers of the strands that moved by more than a millimetre, the farthest first; at most a hundred.
    pub moved: Vec<usize>,
}

/// Distance (m) that nobody sees.
const UNSEEN: f64 = 1e-3;

/// Times as stiff that no fibre is.
const ABSURD: f64 = 1000.0;

/// Most strands that are named.
const NAMED: usize = 100;

impl Held {
    /// The numbers of an adoption.
    #[must_use]
    pub fn of(adoption: &Adoption) -> Self {
        let Adoption { distances, stiffness_needed, left_out, inside } = adoption;
        let mut order: Vec<usize> = (0..distances.len()).collect();
        order.sort_by(|&a, &b| distances[b].total_cmp(&distances[a]).then(a.cmp(&b)));
        let distance = |place: usize| order.get(place).map_or(0.0, |&i| distances[i]);
        let moved = order.iter().take_while(|&&i| distances[i] > UNSEEN).count();
        Self {
            strands: distances.len(),
            within_a_millimetre: distances.len() - moved,
            median_distance: distance(distances.len() / 2),
            largest_distance: distance(0),
            unstable: stiffness_needed.iter().filter(|f| **f > 1.0).count(),
            stiffness_needed: stiffness_needed.iter().copied().fold(1.0, f64::max),
            inside: *inside,
            left_out: *left_out,
            moved: order[..moved.min(NAMED)].to_vec(),
        }
    }
}

impl fmt::Display for Held {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { strands, within_a_millimetre, median_distance, largest_distance, .. } = self;
        write!(
            f,
            "{within_a_millimetre} of {strands} guides stay within 1 mm (median {:.2} mm, farthest {:.1} mm)",
            1e3 * median_distance,
            1e3 * largest_distance
        )?;
        if self.unstable > 0 {
            write!(f, "; {} could not be held, the worst ", self.unstable)?;
            match self.stiffness_needed {
                times if times < ABSURD => write!(f, "unless {times:.1} times as stiff")?,
                _ => f.write_str("by no fibre")?,
            }
        }
        if self.inside > 0 {
            write!(f, "; {} went through the head and come out of it", self.inside)?;
        }
        if self.left_out > 0 {
            write!(f, "; {} strands without length were left out", self.left_out)?;
        }
        if 2 * within_a_millimetre < *strands {
            f.write_str("; is it the head that it was made on, and the right way up?")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_moved_is_counted_and_named() {
        let distances = vec![1e-4, 0.02, 2e-4, 3e-3, 0.0];
        let stiffness_needed = vec![1.0, 6.5, 1.0, 1.0, 1.0];
        let adoption = Adoption { distances, stiffness_needed, left_out: 2, inside: 1 };
        let held = Held::of(&adoption);
        assert_eq!(held.moved, [1, 3]);
        assert_eq!(
            held.to_string(),
            "3 of 5 guides stay within 1 mm (median 0.20 mm, farthest 20.0 mm); 1 could not be held, the worst \
             unless 6.5 times as stiff; 1 went through the head and come out of it; 2 strands without length \
             were left out"
        );
    }
}
