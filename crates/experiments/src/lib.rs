//! The tables and figures of *Feature-Sized Sampling for Vector Line Art*, computed again.
//!
//! Each experiment is a type that implements [`Experiment`]: a list of *units* of work that do not depend on each other, what
//! one unit finds (named numbers), and a [`Report`] made of what all of them found. Nothing here prints, reads files or
//! draws progress bars: functions take drawings and return data. So the units can be spread over machines ([`shard`]) and
//! put together later, and a report made from shards is the same, to the byte, as one made in a single run (but for
//! measured times, which are what they were where they were measured).
//!
//! | module | what it holds |
//! |---|---|
//! | [`report`] | tables with notes, and their Markdown, CSV and JSON |
//! | [`plot`] | plots on logarithmic axes, as SVG |
//! | [`shard`] | running some of the units, keeping what they found, putting it together |
//! | [`clock`] | time on one core |
//! | [`source`] | the curves that an experiment is about |
//! | [`table1`] | Table 1: error and time against steps; [`prototype`] is Ohrhallinger, Mitchell and Wimmer (2016) re-created |
//! | `truth`, `agreement` | the ground truth of Table 1; where scalars disagree with it, and why |
//! | [`bars`] | bar charts, as SVG |
//! | [`silhouette`], [`figure6`] | outlines of images and drawings, and their reconstruction |
//! | [`study`] | the reconstruction study: sample sets, correctness, shares by ε |
//! | [`table3`], [`figure7`] | the study as a table and as a plot |
//! | [`meshing`], [`mesh_study`] | sampling, meshing and simulating at a density; all modes and densities |
//! | [`table4`], [`figure10`] | the study as a table and as plots |
//! | [`figure12`] | Figures 12 and 13: pictures of meshes and simulations |
//! | [`table2`] | Table 2: hull test and quintic solver; [`shrinking`] is the paper's method, [`companion`] the general solver |
//!
//! What the paper prints is kept beside what is computed, in the module of its table.

mod agreement;
pub mod bars;
pub mod clock;
pub mod companion;
pub mod figure10;
pub mod figure12;
pub mod figure6;
pub mod figure7;
pub mod mesh_study;
pub mod meshing;
pub mod plot;
pub mod prototype;
pub mod report;
pub mod shard;
pub mod shrinking;
pub mod silhouette;
pub mod source;
pub mod study;
pub mod table1;
pub mod table2;
pub mod table3;
pub mod table4;
mod truth;

pub use report::Report;

use std::fmt;

/// Something that can be computed in parts.
pub trait Experiment: Sync {
    /// Its name on the command line and of its files: `table1`.
    fn name(&self) -> &'static str;

    /// What it was asked: curves (by name and content) and options. Shards are put together only if this agrees.
    fn fingerprint(&self) -> String;

    /// How many units of work there are.
    fn units(&self) -> u32;

    /// Its units are timed: they must run one after the other, with nothing beside them.
    fn timed(&self) -> bool {
        false
    }

    /// Does one unit. `unit` is below [`Experiment::units`].
    ///
    /// # Errors
    /// A curve that the kernel refuses, or a limit that was reached.
    fn run(&self, unit: u32) -> Result<Vec<Finding>, ExperimentError>;

    /// The tables and plots, from what all units found, in the order of the units.
    ///
    /// # Errors
    /// A finding that should be there and is not (a shard made by another version).
    fn report(&self, findings: &[Vec<Finding>]) -> Result<Report, ExperimentError>;
}

/// A number that a unit found. Names are unique in a unit; they hold neither commas nor line breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What it is.
    pub name: String,
    /// The number; may be infinite or NaN ("not measured").
    pub value: f64,
}

impl Finding {
    /// A named number.
    pub fn new(name: impl Into<String>, value: f64) -> Self {
        Self { name: name.into(), value }
    }
}

/// The value of a name in what a unit found.
///
/// # Errors
/// [`ExperimentError`] naming what is missing.
pub fn value(findings: &[Finding], name: &str) -> Result<f64, ExperimentError> {
    findings
        .iter()
        .find(|finding| finding.name == name)
        .map(|finding| finding.value)
        .ok_or_else(|| ExperimentError::new(format!("there is no “{name}” among the findings of this unit")))
}

/// Why an experiment could not be done, in one line: the curve, and the cause.
#[derive(Clone, Debug, PartialEq)]
pub struct ExperimentError {
    message: String,
}

impl ExperimentError {
    /// With these words.
    pub fn new(message: impl Into<String>) -> Self {
        Self { message: message.into() }
    }
}

impl fmt::Display for ExperimentError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for ExperimentError {}
