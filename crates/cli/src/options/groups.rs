//! Options that several commands have in common: the drawing, the output, how finely lfs is known, the bounds of sampling, the
//! plotter.

use std::num::NonZero;
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use lineart::drawing::Drawing;
use lineart::export::OptionValue;
use lineart::units::Length;

use crate::engine::{Bounds, Density, Effort, ModelOptions};
use crate::errors::Failure;

/// What may be spent on a proof.
#[derive(Args, Debug)]
pub(crate) struct EffortArgs {
    /// Where samples are placed to be proved: aim this share below ε [default: 0.005]
    #[arg(long, value_name = "SHARE", allow_negative_numbers = true)]
    pub(crate) slack: Option<f64>,
    /// Answer unknown where more cells of the foot set would be needed [default: 4000000]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_cells: Option<u32>,
}

impl EffortArgs {
    pub(super) fn check(&self) -> Result<Effort, Failure> {
        let slack = self.slack.unwrap_or(0.005);
        if slack > 0.0 && slack < 1.0 {
            Ok(Effort { slack, cells: self.max_cells.unwrap_or(4_000_000) })
        } else {
            Err(Failure::usage(format!("--slack is {slack}; it lies between 0 and 1")))
        }
    }
}

/// The drawing.
#[derive(Args, Debug)]
pub(crate) struct InputArg {
    /// An SVG drawing, or a CSV of control points (path,closed,x0,y0,…,x3,y3); - is standard input
    #[arg(value_name = "IN")]
    pub(crate) file: String,
}

/// Where the result goes.
#[derive(Args, Debug)]
pub(crate) struct OutputArgs {
    /// The result; its extension decides the format; - is standard output
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// The format, whatever the extension
    #[arg(long, value_name = "NAME")]
    pub(crate) format: Option<String>,
}

/// How finely the medial axis is followed.
#[derive(Args, Debug)]
#[command(next_help_heading = "Computation")]
pub(crate) struct ModelArgs {
    /// Foot points per cubic, the same on each; without it, as many as --tolerance takes
    #[arg(long, value_name = "N", conflicts_with = "tolerance", value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) steps: Option<u32>,
    /// Relative error of the local feature size to refine to [default: 0.001]
    #[arg(long, value_name = "T", allow_negative_numbers = true)]
    pub(crate) tolerance: Option<f64>,
    /// Joints that turn by less are smooth, in degrees
    #[arg(long, value_name = "DEG", default_value_t = 1.0, allow_negative_numbers = true)]
    pub(crate) corner_angle: f64,
    /// Give up (exit code 5) where more medial points are needed
    #[arg(long, value_name = "N", default_value_t = 20_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_medial_points: u32,
    /// Threads to use; the result does not depend on it [default: all]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) threads: Option<u16>,
    /// No summary, no warnings, no progress
    #[arg(long)]
    pub(crate) quiet: bool,
}

/// The corner angle is one.
pub(crate) fn check_corner_angle(angle: f64) -> Result<f64, Failure> {
    if (0.0..=90.0).contains(&angle) {
        Ok(angle)
    } else {
        Err(Failure::usage(format!("--corner-angle is {angle}; it lies between 0 and 90 degrees")))
    }
}

impl ModelArgs {
    /// The tolerance that lfs is refined to where --steps is not given.
    const TOLERANCE: f64 = 1e-3;

    /// The options, if they make sense.
    pub(crate) fn check(&self) -> Result<ModelOptions, Failure> {
        let tolerance = self.tolerance.unwrap_or(Self::TOLERANCE);
        if !(tolerance > 0.0 && tolerance < 1.0) {
            return Err(Failure::usage(format!("--tolerance is {tolerance}; it lies between 0 and 1")));
        }
        let available = || std::thread::available_parallelism().map_or(1, NonZero::get);
        let threads = self.threads.map_or_else(available, usize::from);
        let corner_angle = check_corner_angle(self.corner_angle)?;
        let max_medial_points = usize::try_from(self.max_medial_points).unwrap_or(usize::MAX);
        Ok(ModelOptions { steps: self.steps, tolerance, corner_angle, max_medial_points, threads, quiet: self.quiet })
    }

    /// The options that decide the result, for headers.
    pub(crate) fn describe(&self) -> Vec<(&'static str, OptionValue)> {
        let resolution = match self.steps {
            Some(steps) => ("steps", OptionValue::Number(f64::from(steps))),
            None => ("tolerance", OptionValue::Number(self.tolerance.unwrap_or(Self::TOLERANCE))),
        };
        vec![resolution, ("corner-angle", OptionValue::Number(self.corner_angle))]
    }
}

/// How densely to sample.
#[derive(Args, Debug)]
#[command(next_help_heading = "Bounds")]
pub(crate) struct SamplingArgs {
    /// Every point of a curve has a sample nearer than E times its local feature size [default: 0.5]
    #[arg(long, value_name = "E", conflicts_with = "rho", allow_negative_numbers = true)]
    pub(crate) epsilon: Option<f64>,
    /// Like --epsilon, with the smallest local feature size between neighbours in the place of the point's own
    #[arg(long, value_name = "R", allow_negative_numbers = true)]
    pub(crate) rho: Option<f64>,
    /// Largest distance of the curve from the chord between neighbours
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) chord_error: Option<Length>,
    /// Smallest distance between neighbours; wins over the upper bounds
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) min_distance: Option<Length>,
    /// Largest distance between neighbours
    #[arg(long, value_name = "L", allow_negative_numbers = true)]
    pub(crate) max_distance: Option<Length>,
    /// Largest ratio of two neighbouring gaps, above 1
    #[arg(long, value_name = "G", allow_negative_numbers = true)]
    pub(crate) grading: Option<f64>,
    /// Where on a closed path the first sample lies, as a share of its parameters, in [0, 1)
    #[arg(long, value_name = "F", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) start: f64,
    /// Give up (exit code 5) where one path would need more samples
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) max_samples: u32,
}

/// A share of lfs: beyond 1 the condition says nothing about the curve's shape any more.
pub(crate) fn share(name: &str, value: f64) -> Result<f64, Failure> {
    if value > 0.0 && value <= 1.0 {
        Ok(value)
    } else {
        Err(Failure::usage(format!("--{name} is {value}; it has to be above 0 and at most 1")))
    }
}

/// A length option of a drawing in user units. Lengths that have no size in this drawing are usage errors: another option
/// value is needed, not another drawing.
pub(crate) fn resolve(name: &str, length: Length, per_mm: Option<f64>, diagonal: f64) -> Result<f64, Failure> {
    length.resolve(per_mm, diagonal).map_err(|error| Failure::usage(format!("--{name}: {error}")))
}

/// A finite number above a limit.
pub(crate) fn above(name: &str, limit: f64, value: f64) -> Result<f64, Failure> {
    if value > limit && value.is_finite() {
        Ok(value)
    } else {
        Err(Failure::usage(format!("--{name} is {value}; it has to be a finite number above {limit}")))
    }
}

impl SamplingArgs {
    /// What can be said without the drawing.
    pub(crate) fn check(&self) -> Result<(), Failure> {
        self.density()?;
        if let Some(grading) = self.grading {
            above("grading", 1.0, grading)?;
        }
        if !(0.0..1.0).contains(&self.start) {
            return Err(Failure::usage(format!("--start is {}; it lies in [0, 1)", self.start)));
        }
        let positive = [
            ("chord-error", self.chord_error),
            ("min-distance", self.min_distance),
            ("max-distance", self.max_distance),
        ];
        for (name, length) in positive.into_iter().filter_map(|(name, length)| Some((name, length?))) {
            above(name, 0.0, length.value())?;
        }
        Ok(())
    }

    fn density(&self) -> Result<Density, Failure> {
        match self.rho {
            Some(rho) => share("rho", rho).map(Density::Rho),
            None => share("epsilon", self.epsilon.unwrap_or(0.5)).map(Density::Epsilon),
        }
    }

    /// The bounds in user units, if they agree with each other.
    pub(crate) fn bounds(&self, drawing: &Drawing, diagonal: f64) -> Result<Bounds, Failure> {
        self.check()?;
        let length = |name, length: Option<Length>| {
            length.map(|length| resolve(name, length, drawing.user_units_per_mm, diagonal)).transpose()
        };
        let bounds = Bounds {
            density: self.density()?,
            chord_error: length("chord-error", self.chord_error)?,
            min_distance: length("min-distance", self.min_distance)?,
            max_distance: length("max-distance", self.max_distance)?,
            grading: self.grading,
            start: self.start,
            limit: self.max_samples,
        };
        match (self.min_distance, self.max_distance, bounds.min_distance, bounds.max_distance) {
            (Some(min), Some(max), Some(smallest), Some(largest)) if smallest > largest => {
                Err(Failure::usage(format!("--min-distance {min} is above --max-distance {max}")))
            }
            _ => Ok(bounds),
        }
    }
}

impl Bounds {
    /// The bounds that are set, for headers.
    pub(crate) fn describe(&self) -> Vec<(&'static str, OptionValue)> {
        let density = match self.density {
            Density::Epsilon(epsilon) => ("epsilon", Some(epsilon)),
            Density::Rho(rho) => ("rho", Some(rho)),
        };
        [
            density,
            ("chord-error", self.chord_error),
            ("min-distance", self.min_distance),
            ("max-distance", self.max_distance),
            ("grading", self.grading),
            ("start", Some(self.start)),
        ]
        .into_iter()
        .filter_map(|(name, value)| Some((name, OptionValue::Number(value?))))
        .collect()
    }
}

/// A layer of an SVG result.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Layer {
    Drawing,
    Lfs,
    Medial,
    Samples,
}

/// What a plotter needs to be told.
#[derive(Args, Debug)]
#[command(next_help_heading = "G-code")]
pub(crate) struct PlotterArgs {
    /// A line that lifts the pen; may be given several times [default: "G0 Z5"]
    #[arg(long, value_name = "LINE", allow_hyphen_values = true)]
    pub(crate) pen_up: Vec<String>,
    /// A line that lowers the pen; may be given several times [default: "G1 Z0"]
    #[arg(long, value_name = "LINE", allow_hyphen_values = true)]
    pub(crate) pen_down: Vec<String>,
    /// Drawing speed in mm/min [default: 1500]
    #[arg(long, value_name = "V", allow_negative_numbers = true)]
    pub(crate) feed: Option<f64>,
    /// Travel speed in mm/min [default: 3000]
    #[arg(long, value_name = "V", allow_negative_numbers = true)]
    pub(crate) travel_feed: Option<f64>,
}

impl PlotterArgs {
    /// Some option of this group is given.
    pub(crate) fn is_given(&self) -> bool {
        !self.pen_up.is_empty() || !self.pen_down.is_empty() || self.feed.is_some() || self.travel_feed.is_some()
    }

    /// The machine, if what is said of it makes sense.
    pub(crate) fn machine(&self) -> Result<lineart::export::gcode::Machine, Failure> {
        let mut machine = lineart::export::gcode::Machine::default();
        for (name, given, lines) in
            [("pen-up", &self.pen_up, &mut machine.pen_up), ("pen-down", &self.pen_down, &mut machine.pen_down)]
        {
            if let Some(line) = given.iter().find(|line| line.chars().any(char::is_control)) {
                return Err(Failure::usage(format!("--{name} {line:?}: one line each; repeat the option for more")));
            }
            if !given.is_empty() {
                lines.clone_from(given);
            }
        }
        if let Some(feed) = self.feed {
            machine.feed = above("feed", 0.0, feed)?;
        }
        if let Some(feed) = self.travel_feed {
            machine.travel_feed = above("travel-feed", 0.0, feed)?;
        }
        Ok(machine)
    }
}
