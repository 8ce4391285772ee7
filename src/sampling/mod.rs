//! ε-samples of a curve (paper, section 3.3), and more bounds by the same mechanism.
//!
//! S is an ε-sample of C if every p ∈ C has a sample s with |p − s| < ε·lfs(p). From a sample s the next one is found in two
//! moves: x is the first point of the path where |x − s| reaches ε·lfs(x), and the next sample y is the farthest point such
//! that every p between x and y has |p − y| < ε·lfs(p). For ε < 2/√5 this y is where the path leaves the disk D(x, ε·lfs(x))
//! ([`step`]). Greedy is then optimal for its start, and at most one sample above the best start.
//!
//! * [`run`]: the stretches between points that must be samples (path ends, corners), as one coordinate;
//! * [`size`]: how far a sample may serve, from lfs and the floors;
//! * [`step`]: the next sample; [`chord`]: chord error; [`rho`]: ρ-sampling;
//! * [`spread`]: a run's samples, evenly spread: a smaller ε' that needs as many, by a few trials;
//! * [`resumable`]: the same samples one by one, in calls of bounded work, for motor controllers; [`flatten`]: chord error
//!   alone, one cubic at a time and without a curve;
//! * [`grading`]: ratio of neighbouring gaps; [`sampler`]: whole paths.
//!
//! **Precedence.** Path ends and corners are always samples; then d_min holds; then the upper bounds (ε, chord error, d_max,
//! grading). Each sample says which bound decided it ([`Bound`]).
//!
//! **In floating point** every decision errs to the safe side: x and y are the inner ends of their brackets, and lfs is
//! taken as (1 − tolerance) times the estimate.

pub mod chord;
pub mod flatten;
pub mod grading;
pub mod resumable;
pub mod rho;
pub mod run;
pub mod sampler;
pub mod size;
pub mod spread;
pub mod step;

use crate::buffer::BufferFull;
use crate::curve::CurveParam;
use crate::geometry::Point;
use crate::scalar::Scalar;
use core::fmt;
pub use sampler::sample_path;

/// The sampling condition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition<S> {
    /// ε-sampling: |p − s| < ε·lfs(p). ε in (0, 1].
    Epsilon(S),
    /// ρ-sampling (Ohrhallinger, Mitchell, Wimmer 2016): the smallest lfs between the two neighbouring samples takes the
    /// place of lfs(p). ρ in (0, 1].
    Rho(S),
    /// No condition on features: only the other bounds hold.
    Unbounded,
}

/// What samples must fulfil. Lengths are in user units.
#[derive(Clone, Debug, PartialEq)]
pub struct SamplingOptions<S> {
    /// The feature condition.
    pub condition: Condition<S>,
    /// Largest distance of the curve between two samples from the chord between them.
    pub chord_error: Option<S>,
    /// d_min: smallest distance of consecutive samples, where path ends and corners allow it.
    pub min_distance: Option<S>,
    /// d_max: largest distance of consecutive samples.
    pub max_distance: Option<S>,
    /// Largest ratio of neighbouring gaps, above 1.
    pub grading: Option<S>,
    /// Where the first sample of a closed path without corners lies: a share, in [0, 1), of its segments.
    pub start: S,
    /// Relative error of the lfs that the sampler is given; it is allowed for.
    pub tolerance: S,
    /// Floor around corners, crossings and cusps where no d_min is given, relative to the diagonal (1e-3).
    pub singular_floor: S,
    /// Floor everywhere else, relative to the diagonal (1e-7).
    pub floor: S,
    /// Spread the slack of the last gap of a run over all its gaps ([`spread`]). Without it samples are as far apart as the
    /// bounds allow, which is what a study of a bound needs, and the last gap is whatever is left.
    pub even: bool,
    /// Largest number of samples on one path.
    pub limit: u32,
}

impl<S: Scalar> Default for SamplingOptions<S> {
    /// ε = 1/2, no other bound, evenly spread, lfs good to 1e-3.
    fn default() -> Self {
        let thousandth = S::ratio(1, 1000);
        Self {
            condition: Condition::Epsilon(S::one().half()),
            chord_error: None,
            min_distance: None,
            max_distance: None,
            grading: None,
            start: S::zero(),
            tolerance: thousandth.clone(),
            singular_floor: thousandth,
            floor: S::ratio(1, 10_000_000),
            even: true,
            limit: 10_000_000,
        }
    }
}

/// The bound that decided where a sample lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Bound {
    /// First sample of a path.
    #[default]
    Start,
    /// ε (or ρ).
    Epsilon,
    /// Chord error.
    Chord,
    /// d_min: an upper bound asked for less.
    Min,
    /// d_max.
    Max,
    /// Grading.
    Grading,
    /// The floor took the place of ε·lfs.
    Floor,
    /// Last sample of an open path.
    End,
    /// A corner.
    Corner,
}

impl fmt::Display for Bound {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Start => "start",
            Self::Epsilon => "epsilon",
            Self::Chord => "chord",
            Self::Min => "min",
            Self::Max => "max",
            Self::Grading => "grading",
            Self::Floor => "floor",
            Self::End => "end",
            Self::Corner => "corner",
        })
    }
}

/// A sample.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Sample<S> {
    /// Path of C.
    pub path: u32,
    /// Place on C.
    pub at: CurveParam<S>,
    /// The point there.
    pub point: Point<S>,
    /// lfs as the sampler was given it; infinite where there is no medial axis.
    pub lfs: S,
    /// What decided it.
    pub bound: Bound,
}

/// Why there are no samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum SamplingError {
    /// ε or ρ is not in (0, 1], or not a number.
    Condition,
    /// A length is negative, zero where that makes no sense, or not a number.
    Length,
    /// d_min is larger than d_max: no samples can fulfil both.
    Contradiction,
    /// The grading ratio is not above 1.
    Grading,
    /// The start is not in [0, 1).
    Start,
    /// More samples than [`SamplingOptions::limit`]: raise it, or set d_min.
    Limit(u32),
    /// The resumable sampler was asked for ρ, grading or even spreading, or for ε without a d_min.
    NotResumable,
    /// A lent buffer is too small.
    Full(BufferFull),
}

impl From<BufferFull> for SamplingError {
    fn from(full: BufferFull) -> Self {
        Self::Full(full)
    }
}

impl fmt::Display for SamplingError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Condition => write!(f, "epsilon and rho must lie in (0, 1]"),
            Self::Length => write!(f, "a length bound must be a positive finite number"),
            Self::Contradiction => write!(f, "the least distance is larger than the greatest"),
            Self::Grading => write!(f, "the grading ratio must be above 1"),
            Self::Start => write!(f, "the start must lie in [0, 1)"),
            Self::Limit(n) => write!(f, "a path needs more than {n} samples"),
            Self::NotResumable => {
                write!(f, "the resumable sampler needs a least distance and takes no rho, grading or even spreading")
            }
            Self::Full(full) => full.fmt(f),
        }
    }
}

impl core::error::Error for SamplingError {}

impl<S: Scalar> SamplingOptions<S> {
    /// Checks every bound by itself and against the others.
    ///
    /// # Errors
    /// See [`SamplingError`].
    pub fn check(&self) -> Result<(), SamplingError> {
        let positive = |v: &S| *v > S::zero() && v.is_finite();
        match &self.condition {
            Condition::Epsilon(e) | Condition::Rho(e) if !(positive(e) && *e <= S::one()) => {
                return Err(SamplingError::Condition);
            }
            _ => {}
        }
        for length in [&self.chord_error, &self.min_distance, &self.max_distance].into_iter().flatten() {
            if !positive(length) {
                return Err(SamplingError::Length);
            }
        }
        if let (Some(min), Some(max)) = (&self.min_distance, &self.max_distance)
            && min > max
        {
            return Err(SamplingError::Contradiction);
        }
        if self.grading.as_ref().is_some_and(|g| !(*g > S::one() && g.is_finite())) {
            return Err(SamplingError::Grading);
        }
        if !(self.start >= S::zero() && self.start < S::one()) {
            return Err(SamplingError::Start);
        }
        Ok(())
    }
}
