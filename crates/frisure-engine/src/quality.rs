//! The quality of a hairstyle.

use frisure::hairstyle::Hairstyle;
use serde::{Deserialize, Serialize};

/// Points of coarse strands, per thread: as many as a slider leaves time for; chosen by trial.
const COARSE_POINTS: usize = 70_000;

/// Most points of strands to look at: a page in a browser has 4 GiB in all.
const MOST_POINTS: usize = 16_000_000;

/// The quality of a hairstyle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Quality {
    /// While a slider moves: few sweeps from the last hairstyle, and only some of the hairs.
    Coarse,
    /// In equilibrium, with all hairs.
    #[default]
    Exact,
}

impl Quality {
    /// The stride between the hairs that are drawn for a view.
    pub(crate) fn stride(self, hairstyle: &Hairstyle) -> usize {
        let most = match self {
            Self::Coarse => MOST_POINTS.min(COARSE_POINTS * rayon::current_num_threads()),
            Self::Exact => MOST_POINTS,
        };
        points(hairstyle).div_ceil(most).max(1)
    }
}

/// The number of points of all hairs.
pub(crate) fn points(hairstyle: &Hairstyle) -> usize {
    hairstyle.drawn().saturating_mul(hairstyle.spec().wisps.points)
}

#[cfg(test)]
mod tests {
    use frisure::hairstyle::head::Head;
    use frisure::hairstyle::{PredictOptions, predict};
    use frisure::scene::Scene;

    use super::*;

    #[test]
    fn a_preview_of_a_million_hairs_leaves_some_out() {
        let text = "[hair]\nlength = '5 cm'\n[wisps]\ncount = 4\nhairs = 1_000_000\npoints = 32";
        let scene = Scene::parse("a", text, "".as_ref()).unwrap();
        let spec = scene.hairstyle_spec().unwrap();
        let hair = predict(&spec, &Head::mannequin(), PredictOptions::default(), &()).unwrap();
        assert_eq!(hair.drawn(), 1_000_000);
        assert_eq!(Quality::Exact.stride(&hair), 2);
        assert!(Quality::Coarse.stride(&hair) > 2);
    }
}
