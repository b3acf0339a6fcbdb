//! The command line of `frisure validate`.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use frisure_evidence::EXPERIMENTS;

const VALIDATE_EXAMPLES: &str = "\
Examples:
  frisure validate
  frisure validate elastica buckling -o out/physics
  frisure validate --full

The command writes index.html, which opens offline, and report.md with its pictures. It replaces an
earlier report in the folder. docs/validation.md has the questions and results of the experiments.";

/// Arguments of `frisure validate`.
#[derive(Args, Debug)]
#[command(after_help = VALIDATE_EXAMPLES)]
pub(crate) struct Validate {
    /// The experiments to run, by default all.
    #[arg(value_name = "EXPERIMENT", hide_possible_values = true)]
    #[arg(value_parser = PossibleValuesParser::new(EXPERIMENTS.iter().map(|e| e.name)))]
    pub(crate) experiments: Vec<String>,

    /// Fewer hairs and coarser scans, under the same criteria: about two minutes. This is the default.
    #[arg(long)]
    pub(crate) quick: bool,

    /// Everything: ten to fifteen minutes on two cores.
    #[arg(long, conflicts_with = "quick")]
    pub(crate) full: bool,

    /// Write the report into this folder.
    #[arg(long, short, value_name = "FOLDER", default_value = "out/validation")]
    pub(crate) output: PathBuf,

    /// Print the experiments with their questions, and run none.
    #[arg(long, conflicts_with_all = ["experiments", "quick", "full", "output"])]
    pub(crate) list: bool,
}
