//! Whole paths: runs between corners, seams and ends, and the passes that grading needs.

use super::grading::{self, GapLimit};
use super::run::{Pos, Run, RunEnd};
use super::spread::inner_samples;
use super::{Bound, Sample, SamplingError, SamplingOptions};
use crate::buffer::Store;
use crate::curve::contact::Contact;
use crate::curve::{Curve, CurveParam, JointKind, Path};
use crate::lfs::FeatureSize;
use crate::scalar::Scalar;

/// Passes that tighten the field before grading gives up; each flattens it by a quarter.
const PASSES: u32 = 12;

/// Appends the samples of one path, in path order; a closed path's first sample is not repeated.
///
/// `contacts` are those of the whole curve ([`crate::curve::contact::find`]), sorted as found. `scratch` is used where a
/// grading is asked for: one entry a sample.
///
/// # Errors
/// See [`SamplingError`]; what was appended is then of no use.
pub fn sample_path<S: Scalar, F: FeatureSize<S>>(
    curve: &Curve<'_, S>,
    features: &F,
    contacts: &[Contact<S>],
    path: u32,
    options: &SamplingOptions<S>,
    out: &mut impl Store<Sample<S>>,
    scratch: &mut impl Store<GapLimit<S>>,
) -> Result<(), SamplingError> {
    options.check()?;
    let Some(&p) = curve.paths.get(path as usize) else { return Ok(()) };
    let sampler = Sampler { curve, features, contacts, index: path, options };
    let base = out.items().len();
    sampler.pass(&|_| None, out)?;
    let Some(ratio) = &options.grading else { return Ok(()) };
    let mut tighten = S::one();
    for _ in 0..PASSES {
        let samples = out.items().get(base..).unwrap_or_default();
        if grading::measure(samples, p.closed) <= *ratio {
            break;
        }
        let slope = grading::slope(ratio, &tighten);
        scratch.shorten(0);
        let n = samples.len();
        for i in 0..n {
            let next = if i + 1 < n {
                i + 1
            } else if p.closed {
                0
            } else {
                i.saturating_sub(1)
            };
            let (Some(a), Some(b)) = (samples.get(i), samples.get(next)) else { continue };
            scratch.push(GapLimit {
                point: a.point.clone(),
                at: (a.at.segment, a.at.t.clone()),
                gap: a.point.distance(&b.point),
            })?;
        }
        grading::smooth(scratch.items_mut(), p.closed, &slope);
        out.shorten(base);
        let limits = scratch.items();
        let cap = |at: &CurveParam<S>| {
            let place = curve.point(at)?;
            // Samples of a closed path may start anywhere on it: the search is relative to the first one.
            let first = limits.first()?;
            let turn = |seg: u32, t: &S| (seg, t) < (first.at.0, &first.at.1);
            let key = (turn(at.segment, &at.t), at.segment, &at.t);
            let i = limits.partition_point(|l| (turn(l.at.0, &l.at.1), l.at.0, &l.at.1) <= key).saturating_sub(1);
            grading::value(limits, i, &place, &slope)
        };
        sampler.pass(&cap, out)?;
        tighten = tighten * &S::ratio(3, 4);
    }
    Ok(())
}

struct Sampler<'s, 'c, S, F> {
    curve: &'s Curve<'c, S>,
    features: &'s F,
    contacts: &'s [Contact<S>],
    index: u32,
    options: &'s SamplingOptions<S>,
}

impl<S: Scalar, F: FeatureSize<S>> Sampler<'_, '_, S, F> {
    /// All runs once.
    fn pass(
        &self,
        cap: &impl Fn(&CurveParam<S>) -> Option<S>,
        out: &mut impl Store<Sample<S>>,
    ) -> Result<(), SamplingError> {
        for leg in Legs::new(self.curve, self.index, &self.options.start) {
            match leg {
                Leg::Fixed(at, bound) => {
                    if let Some(point) = self.curve.point(&at) {
                        let lfs = self.features.lfs(&at, &point);
                        out.push(Sample { path: self.index, at, point, lfs, bound })?;
                    }
                }
                Leg::Run(run) => {
                    inner_samples(&run, self.features, self.contacts, self.options, &|p| cap(&run.place(p)), out)?;
                }
            }
        }
        Ok(())
    }
}

/// A part of a path as the sampler meets it.
#[derive(Clone, Debug)]
pub enum Leg<'c, S> {
    /// A place that is always a sample: the first of a path, a corner, an end.
    Fixed(CurveParam<S>, Bound),
    /// The stretch up to the next such place.
    Run(Run<'c, S>),
}

/// The legs of one path, in path order. One step looks at no more joints than the path has.
#[derive(Clone, Debug)]
pub struct Legs<'c, S> {
    curve: &'c Curve<'c, S>,
    index: u32,
    path: Path,
    /// Segment of the path that the runs count from.
    first: u32,
    /// Where the run of a closed path without corners starts and ends.
    seam: Option<S>,
    /// Where the next run starts.
    from: u32,
    /// What comes next is a sample.
    fixed: bool,
}

impl<'c, S: Scalar> Legs<'c, S> {
    /// The legs of a path, none if there is no such path. `start` is [`SamplingOptions::start`].
    pub fn new(curve: &'c Curve<'c, S>, index: u32, start: &S) -> Self {
        let path = curve.paths.get(index as usize).copied().unwrap_or_default();
        let mut legs = Self { curve, index, path, first: 0, seam: None, from: 0, fixed: true };
        if path.closed {
            let count = path.count;
            let total = S::int(i32::try_from(count).unwrap_or(i32::MAX)) * start;
            let begin = whole_part(&total, count);
            if let Some(corner) = (0..count).map(|n| path.around(begin + n)).find(|&k| legs.corner_at(k)) {
                legs.first = corner;
            } else {
                let t = (total - &S::int(i32::try_from(begin).unwrap_or(0))).clamp(S::zero(), S::one());
                legs.first = begin;
                legs.seam = Some(t);
            }
        }
        legs
    }

    /// The joint before segment k of the path is a corner.
    fn corner_at(&self, k: u32) -> bool {
        self.curve.segment(self.path.first + self.path.around(k)).is_some_and(|s| s.end(0).kind == JointKind::Corner)
    }

    /// The run from the start of segment `from` to the start of segment `to` (or the end of the path).
    fn run(&self, from: u32, to: u32) -> Run<'c, S> {
        Run {
            curve: self.curve,
            path: self.path,
            index: self.index,
            first: self.first,
            start: Pos { k: from, t: S::zero() },
            end: Pos { k: to - 1, t: S::one() },
            ends: [self.ending(from, 0), self.ending(to - 1, 1)],
        }
    }

    /// The run around a closed path without corners.
    fn round(&self, t: &S) -> Run<'c, S> {
        let count = self.path.count;
        let end = if *t > S::zero() { Pos { k: count, t: t.clone() } } else { Pos { k: count - 1, t: S::one() } };
        Run {
            curve: self.curve,
            path: self.path,
            index: self.index,
            first: self.first,
            start: Pos { k: 0, t: t.clone() },
            end,
            ends: [RunEnd::Seam, RunEnd::Seam],
        }
    }

    /// What lies at an end of the segment that is k on from the first.
    fn ending(&self, k: u32, side: usize) -> RunEnd {
        let end = self.curve.segment(self.path.first + self.path.around(self.first + k)).map(|s| s.end(side));
        match end {
            Some(e) if e.kind == JointKind::Corner || e.retracted => RunEnd::Singular,
            _ => RunEnd::Open,
        }
    }

    /// An end of a segment of the path.
    fn place(&self, k: u32, side: usize) -> CurveParam<S> {
        let t = if side == 0 { S::zero() } else { S::one() };
        CurveParam { segment: self.path.first + k, t }
    }
}

impl<'c, S: Scalar> Iterator for Legs<'c, S> {
    type Item = Leg<'c, S>;

    fn next(&mut self) -> Option<Leg<'c, S>> {
        let count = self.path.count;
        if self.fixed {
            self.fixed = false;
            if let Some(t) = &self.seam {
                return (self.from == 0 && count > 0).then(|| {
                    let run = self.round(t);
                    Leg::Fixed(run.place(&run.start), Bound::Start)
                });
            }
            return match (self.path.closed, self.from) {
                _ if count == 0 => None,
                (_, 0) => Some(Leg::Fixed(self.place(self.first, 0), Bound::Start)),
                (true, k) => {
                    (k < count).then(|| Leg::Fixed(self.place(self.path.around(self.first + k), 0), Bound::Corner))
                }
                (false, k) => {
                    Some(Leg::Fixed(self.place(k - 1, 1), if k == count { Bound::End } else { Bound::Corner }))
                }
            };
        }
        if self.from >= count {
            return None;
        }
        self.fixed = true;
        let from = self.from;
        if let Some(t) = &self.seam {
            self.from = count;
            return Some(Leg::Run(self.round(t)));
        }
        let to = (from + 1..count).find(|&k| self.corner_at(self.first + k)).unwrap_or(count);
        self.from = to;
        Some(Leg::Run(self.run(from, to)))
    }
}

/// The largest integer at most v, in [0, below).
fn whole_part<S: Scalar>(v: &S, below: u32) -> u32 {
    let (mut lo, mut hi) = (0, below);
    while hi - lo > 1 {
        let k = lo + (hi - lo) / 2;
        if S::int(i32::try_from(k).unwrap_or(i32::MAX)) <= *v {
            lo = k;
        } else {
            hi = k;
        }
    }
    lo
}
