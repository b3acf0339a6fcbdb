//! A hairstyle in numbers.

use frisure::hairstyle::{SettlingReport, settling_report};

use crate::runner::LoadedScene;

/// Measures of a hairstyle and its guides; SI units.
#[derive(Clone, Debug, PartialEq)]
pub struct HairstyleMetrics {
    /// How the guides came to rest.
    pub settling: SettlingReport,
    /// Number of hairs that grow on the head.
    pub hairs: f64,
    /// Mass of all hair that grows on the head (kg); water does not change it (the paper, §3.2.1).
    pub mass: f64,
    /// Mean length along the guides (m).
    pub length: f64,
    /// Mean height of the tips of the guides (m).
    pub tip_height: f64,
    /// Mean height of roots over tips, each over the length of its guide: 1 hangs straight down.
    pub drop: f64,
}

impl LoadedScene {
    /// Measures the hairstyle.
    #[must_use]
    pub fn metrics(&self) -> HairstyleMetrics {
        let hairstyle = &self.hairstyle;
        let count = hairstyle.guides().len();
        let mean =
            |of: &dyn Fn(usize) -> f64| (0..count).map(of).sum::<f64>() / count.max(1) as f64;
        let length = |i: usize| hairstyle.guides()[i].rod.length();
        let tip = |i: usize| hairstyle.equilibria()[i].tip().z;
        let root = |i: usize| hairstyle.equilibria()[i].rod.root().position().z;
        HairstyleMetrics {
            settling: settling_report(hairstyle, &self.head),
            hairs: hairstyle.grown(),
            mass: hairstyle.mass(),
            length: mean(&length),
            tip_height: mean(&tip),
            drop: mean(&|i| (root(i) - tip(i)) / length(i)),
        }
    }
}
