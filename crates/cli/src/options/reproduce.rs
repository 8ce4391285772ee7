//! Options of `reproduce`: which of the paper's tables and figures, on what.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use fsample_experiments::shard::Shard;
use fsample_experiments::study::Grid;

use crate::errors::Failure;

/// Compute the tables and figures of the paper again.
///
/// Each experiment runs on the curves given with --curve; without, on drawings that come with the program, and its tables
/// say so. Into the folder -o go Markdown, JSON, one CSV per table and SVG plots; without -o the first table goes to
/// standard output as CSV. Long experiments can be spread: each machine runs its --shard, and --merge makes the report
/// from what they found, under the same curves and options.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample reproduce table2 --quick
  fsample reproduce table2 --curve bunny.svg --curve complex.svg --curve spiral.svg -o results
  fsample reproduce table2 --curve a.svg --curve b.svg --shard 1/2 -o parts
  fsample reproduce table2 --curve a.svg --curve b.svg --merge parts/table2.shard-*.csv -o results")]
pub(crate) struct ReproduceArgs {
    /// The experiments
    #[arg(value_enum, required = true, value_name = "NAME")]
    pub(crate) experiment: Vec<ExperimentName>,
    /// A curve (as IN of other commands); may be repeated
    #[arg(long, value_name = "FILE", num_args = 1..)]
    pub(crate) curve: Vec<String>,
    /// Do only part I of N
    #[arg(long, value_name = "I/N", conflicts_with = "merge")]
    pub(crate) shard: Option<Shard>,
    /// Compute nothing; put these parts together
    #[arg(long, value_name = "FILES", num_args = 1..)]
    pub(crate) merge: Vec<PathBuf>,
    /// The folder for results; it is made where there is none
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Sample sets to study beside our own (table3, figure7): “set E O N”, then N lines “x y”; may be xz-compressed
    #[arg(long, value_name = "FILE", help_heading = "Reconstruction")]
    pub(crate) samples: Option<PathBuf>,
    /// Distance of the values of ε that are studied (table3, figure7), a multiple of 0.001 [default: 0.01]
    #[arg(long, value_name = "S", help_heading = "Reconstruction", allow_negative_numbers = true)]
    pub(crate) epsilon_step: Option<f64>,
    /// Starts of the samples of each ε (table3, figure7) [default: 100]
    #[arg(long, value_name = "N", help_heading = "Reconstruction", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) starts: Option<u32>,
    /// PNG images of shapes, or folders of them (figure6)
    #[arg(long, value_name = "FILES", num_args = 1.., help_heading = "Reconstruction")]
    pub(crate) masks: Vec<PathBuf>,
    /// A small version of the experiment, in seconds
    #[arg(long)]
    pub(crate) quick: bool,
    /// Threads to use, except where time is measured; the result does not depend on it [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    /// No warnings, no progress
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Experiments of `reproduce`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ExperimentName {
    /// Error and time against steps per cubic
    Table1,
    /// Time, and what the hull test and the quintic solver save
    Table2,
    /// How far nine reconstruction algorithms reach under ε-sampling, on the curve named complex or else the first
    Table3,
    /// Triangles, time and error of the simulation on meshes of six densities
    Table4,
    /// Exact reconstructions of real-world outlines
    Figure6,
    /// Exact reconstructions by ε, on the same curve as table3
    Figure7,
    /// The same as plots, and error against triangles
    Figure10,
    /// Pictures of meshes
    Figure12,
    /// Pictures of meshes and simulations of the first curve at six densities
    Figure13,
    /// All of them
    All,
}

impl ReproduceArgs {
    /// Values of ε and starts of the study.
    pub(crate) fn grid(&self) -> Result<Grid, Failure> {
        let (step, starts) = if self.quick { (0.05, 10) } else { (0.01, 100) };
        let step = self.epsilon_step.unwrap_or(step);
        let Some(thousandths) = (1..=500_u32).find(|n| (f64::from(*n) - 1000.0 * step).abs() < 1e-6) else {
            let message = format!("--epsilon-step is {step}; it is a multiple of 0.001, up to 0.5");
            return Err(Failure::usage(message));
        };
        Ok(Grid::new(thousandths, self.starts.unwrap_or(starts)))
    }

    /// What was asked for: each once, in the order of the paper.
    pub(crate) fn names(&self) -> Vec<ExperimentName> {
        let asked = |name: &ExperimentName| {
            *name != ExperimentName::All
                && (self.experiment.contains(name) || self.experiment.contains(&ExperimentName::All))
        };
        ExperimentName::value_variants().iter().copied().filter(asked).collect()
    }
}
