//! Options of the commands on curves: samples, medial polylines, lfs, certificates, and what a drawing is made of.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lineart::drawing::Drawing;
use lineart::units::Length;

use super::groups::{
    EffortArgs, InputArg, Layer, ModelArgs, OutputArgs, PlotterArgs, SamplingArgs, above, resolve, share,
};
use crate::engine::{Effort, Width};
use crate::errors::Failure;

/// Place points along the curves of a drawing.
///
/// Every point p of a curve gets a sample nearer than ε times the local feature size at p, with as few samples as that
/// takes. More bounds can be added; each sample says which one decided it. Path ends and corners are always samples;
/// next in rank comes --min-distance, then the upper bounds.
///
/// Without -o, a table path,segment,t,x,y,lfs,bound goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample sample drawing.svg                              a table on standard output
  fsample sample drawing.svg -o samples.svg               a picture in layers
  fsample sample drawing.svg --epsilon 0.66 -o points.ply for a mesher
  fsample sample drawing.svg --certified                  proved to be an ε-sample
  fsample sample drawing.svg --chord-error 0.1mm --min-distance 0.05mm --feed 2000 -o plot.gcode
  fsample sample - --format json < drawing.svg            from and to a pipe")]
pub(crate) struct SampleArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) sampling: SamplingArgs,
    /// Prove the result: with every rounding accounted for, each point of the curves has a sample as near as --epsilon says.
    /// Samples that cannot be proved are not written, and the exit code is 1
    #[arg(long, conflicts_with = "rho")]
    pub(crate) certified: bool,
    #[command(flatten)]
    pub(crate) effort: EffortArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
    /// Layers of an SVG result, from drawing, lfs, medial, samples
    #[arg(long, value_name = "NAMES", value_delimiter = ',', help_heading = "SVG")]
    pub(crate) layers: Option<Vec<Layer>>,
    #[command(flatten)]
    pub(crate) plotter: PlotterArgs,
    /// Send lfs along with a job, for a controller that does not compute it
    #[arg(long, help_heading = "Job")]
    pub(crate) with_lfs: bool,
}

/// Compute the medial axis of a drawing, as polylines.
///
/// Each row is a foot point on a curve with the centre of the largest empty disk that touches the curve there, on one
/// side. Directions without a bounded disk have no row.
///
/// Without -o, a table path,segment,t,x,y,side,mx,my,radius,polyline goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample medial drawing.svg -o medial.svg
  fsample medial drawing.svg --steps 1000 > medial.csv")]
pub(crate) struct MedialArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

/// Compute the local feature size: the distance to the medial axis.
///
/// By default at every foot point of the medial axis; with --at, at the given points. For these the path, segment and
/// parameter are those of the nearest point of the drawing.
///
/// With --certified, two more columns bound lfs from below and above, proved in rounded-outwards arithmetic; the summary says between
/// which bounds the smallest lfs of the whole drawing lies (its reach) and where, and a picture shows the band that the medial
/// axis lies in.
///
/// Without -o, a table path,segment,t,x,y,lfs (and lower,upper) goes to standard output.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample lfs drawing.svg -o lfs.svg                      the curves, coloured
  fsample lfs drawing.svg --at points.txt > lfs.csv       points.txt: one \"x y\" or \"x,y\" per line
  echo 10 20 | fsample lfs drawing.svg --at -
  fsample lfs drawing.svg --certified --width 0.001 > bounds.csv")]
pub(crate) struct LfsArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    #[command(flatten)]
    pub(crate) output: OutputArgs,
    /// Points to ask about, one "x y" or "x,y" per line; - is standard input
    #[arg(long, value_name = "POINTS")]
    pub(crate) at: Option<String>,
    /// Prove bounds of lfs from below and above
    #[arg(long)]
    pub(crate) certified: bool,
    /// How far apart bounds may be, as a share of the upper one [default: 0.01]
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true, requires = "certified")]
    pub(crate) width: Option<f64>,
    /// Bounds stay wider where more cells of the foot set would be needed [default: 4000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..), requires = "certified")]
    pub(crate) max_cells: Option<u32>,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

impl LfsArgs {
    /// How exactly lfs is to be enclosed, if it is.
    pub(crate) fn width(&self) -> Result<Option<Width>, Failure> {
        let share = self.width.unwrap_or(0.01);
        if !(share > 0.0 && share < 1.0) {
            return Err(Failure::usage(format!("--width is {share}; it lies between 0 and 1")));
        }
        Ok(self.certified.then(|| Width { share, cells: self.max_cells.unwrap_or(4_000_000) }))
    }
}

/// Prove that samples are an ε-sample of a drawing, or find a point where they are not.
///
/// Every point p of a curve must have a sample nearer than ε times the local feature size at p (or than the floor that
/// holds where that falls to 0). The answer is proved in rounded-outwards arithmetic for all points at once: proved, refuted
/// (with a point) or unknown. Without --samples, samples are placed first, with some slack, so that they can be proved.
///
/// The exit code is 0 for proved and 1 otherwise.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample certify drawing.svg --epsilon 0.5
  fsample sample drawing.svg --epsilon 0.495 > s.csv && fsample certify drawing.svg --samples s.csv --epsilon 0.5
  fsample certify drawing.svg --epsilon 0.5 -o certificate.json
  fsample certify drawing.svg --check certificate.json")]
pub(crate) struct CertifyArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// Samples to judge, as fsample sample writes them (csv); - is standard input
    #[arg(long, value_name = "CSV")]
    pub(crate) samples: Option<String>,
    /// What is to be proved: a sample nearer than E times the local feature size, everywhere
    #[arg(long, value_name = "E", allow_negative_numbers = true, required_unless_present = "check")]
    pub(crate) epsilon: Option<f64>,
    /// A distance that is near enough in any case, to one of the two neighbours along the path
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) min_distance: Option<Length>,
    #[command(flatten)]
    pub(crate) effort: EffortArgs,
    /// Find the least ε for which they are an ε-sample, between two proved bounds; --epsilon is where the search starts
    #[arg(long, conflicts_with_all = ["output", "check"])]
    pub(crate) effective: bool,
    /// Write the certificate to this file, as JSON
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,
    /// Re-check this certificate of the drawing instead: evaluate every claim in it, and search for nothing. With --epsilon or
    /// --samples, it must be about no larger ε and about these samples; - is standard input
    #[arg(long, value_name = "JSON", conflicts_with_all = ["min_distance", "slack", "max_cells", "output"])]
    pub(crate) check: Option<String>,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

impl CertifyArgs {
    /// ε and what may be spent, if all options make sense without the drawing.
    pub(crate) fn check(&self) -> Result<(f64, Effort), Failure> {
        let epsilon = self.epsilon.unwrap_or_default();
        share("epsilon", epsilon)?;
        if let Some(length) = self.min_distance {
            above("min-distance", 0.0, length.value())?;
        }
        Ok((epsilon, self.effort.check()?))
    }

    /// The floor in user units.
    pub(crate) fn min_distance(&self, drawing: &Drawing, diagonal: f64) -> Result<Option<f64>, Failure> {
        self.min_distance.map(|l| resolve("min-distance", l, drawing.user_units_per_mm, diagonal)).transpose()
    }
}

impl SampleArgs {
    /// ε and what may be spent, if the result is to be proved.
    pub(crate) fn proof(&self) -> Result<Option<(f64, Effort)>, Failure> {
        if self.certified {
            return Ok(Some((self.sampling.epsilon.unwrap_or(0.5), self.effort.check()?)));
        }
        match self.effort {
            EffortArgs { slack: None, max_cells: None } => Ok(None),
            _ => Err(Failure::usage("--slack and --max-cells are for --certified")),
        }
    }
}

/// Tell what is in a drawing and what would be made of it.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample inspect drawing.svg
  fsample inspect drawing.svg --format json")]
pub(crate) struct InspectArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// The form of the answer
    #[arg(long, value_enum, default_value_t = InspectFormat::Text)]
    pub(crate) format: InspectFormat,
    /// Joints that turn by less are smooth, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) corner_angle: f64,
    /// No warnings on standard error
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// Forms of `inspect`'s answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum InspectFormat {
    Text,
    Json,
}

/// Set ε-samples beside other ways to flatten the same drawing.
///
/// For each method: points; the largest distance of the curve from its chords; chords that are missing from the
/// Delaunay triangulation of the points; grading, the largest ratio of two neighbouring gaps; the smallest and largest
/// gap. Methods: ε-samples, alone and with the chord error bounded; greedy chords of the same error; the fewest equal
/// steps per cubic of the same error; pieces of equal length, as vpype reads curves; the splitter that plotter firmware
/// (Marlin, grblHAL) runs on a G5 command.
#[derive(Args, Debug)]
#[command(after_help = "\
Examples:
  fsample compare drawing.svg
  fsample compare drawing.svg --diagonal 150mm --min-distance 0.05mm
  fsample compare drawing.svg --format csv > compare.csv")]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    pub(crate) input: InputArg,
    /// The form of the answer
    #[arg(long, value_enum, default_value_t = CompareFormat::Text)]
    pub(crate) format: CompareFormat,
    /// Share of the local feature size that separates samples at most
    #[arg(long, value_name = "E", default_value_t = 0.5, allow_negative_numbers = true)]
    pub(crate) epsilon: f64,
    /// Chord error of the methods that bound it
    #[arg(long, value_name = "L", default_value = "0.1mm", allow_negative_numbers = true)]
    pub(crate) chord_error: Length,
    /// Smallest distance between neighbouring ε-samples
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) min_distance: Option<Length>,
    /// Length of the pieces of the method that makes pieces of equal length
    #[arg(long, value_name = "L", default_value = "0.1mm", allow_negative_numbers = true)]
    pub(crate) piece: Length,
    /// Take the drawing to be of such a size that its diagonal has this physical length
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) diagonal: Option<Length>,
    /// Give up (exit code 5) where one path would need more ε-samples
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_samples: u32,
    #[command(flatten)]
    pub(crate) model: ModelArgs,
}

/// Forms of `compare`'s answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CompareFormat {
    Text,
    Csv,
    Json,
}
