//! A book: experiments with their findings.

use crate::{Effort, Experiment, Finding, Item};

/// Every experiment that was run, with its finding.
pub struct Book<'a> {
    /// Quick or full.
    pub effort: Effort,
    /// In the order of the report.
    pub chapters: Vec<(&'a Experiment, Finding)>,
}

impl Book<'_> {
    /// Whether every criterion of every finding holds.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.chapters.iter().all(|(_, finding)| finding.holds())
    }

    /// Names (with extensions) and bytes of plots and pictures.
    #[must_use]
    pub fn pictures(&self) -> Vec<(String, Vec<u8>)> {
        let mut files = Vec::new();
        for (experiment, finding) in &self.chapters {
            for (number, item) in finding.items.iter().enumerate() {
                match item {
                    Item::Plot(plot) => {
                        files.push((plot_name(experiment, number), plot.to_string().into_bytes()));
                    }
                    Item::Picture(picture) => {
                        files.push((format!("{}.png", picture.name), picture.png.clone()));
                    }
                    Item::Text(_) | Item::Table(_) => {}
                }
            }
        }
        files
    }
}

/// The file of the plot that is the `number`th item of a finding.
pub(super) fn plot_name(experiment: &Experiment, number: usize) -> String {
    format!("{}-{number}.svg", experiment.name)
}
