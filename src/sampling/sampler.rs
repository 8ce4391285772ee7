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
    let sampler = Sampler { curve, features, contacts, index: path, path: p, options };
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
    path: Path,
    options: &'s SamplingOptions<S>,
}

impl<S: Scalar, F: FeatureSize<S>> Sampler<'_, '_, S, F> {
    /// All runs once.
    fn pass(
        &self,
        cap: &impl Fn(&CurveParam<S>) -> Option<S>,
        out: &mut impl Store<Sample<S>>,
    ) -> Result<(), SamplingError> {
        let count = self.path.count;
        if !self.path.closed {
            let mut from = 0;
            self.fixed(0, 0, Bound::Start, out)?;
            for k in 1..=count {
                if k < count && !self.corner_at(k) {
                    continue;
                }
                let run = self.run(from, k);
                inner_samples(&run, self.features, self.contacts, self.options, &|p| cap(&run.place(p)), out)?;
                self.fixed(k - 1, 1, if k == count { Bound::End } else { Bound::Corner }, out)?;
                from = k;
            }
            return Ok(());
        }
        let total = S::int(i32::try_from(count).unwrap_or(i32::MAX)) * &self.options.start;
        let begin = self.curve.paths.get(self.index as usize).map_or(0, |_| whole_part(&total, count));
        let Some(corner) = (0..count).map(|n| (begin + n) % count).find(|&k| self.corner_at(k)) else {
            let t = (total - &S::int(i32::try_from(begin).unwrap_or(0))).clamp(S::zero(), S::one());
            return self.loop_from(begin, t, cap, out);
        };
        let mut from = 0;
        self.fixed(corner, 0, Bound::Start, out)?;
        for k in 1..=count {
            if k < count && !self.corner_at((corner + k) % count) {
                continue;
            }
            let run = Run { first: corner, ..self.run(from, k) };
            inner_samples(&run, self.features, self.contacts, self.options, &|p| cap(&run.place(p)), out)?;
            if k < count {
                self.fixed((corner + k) % count, 0, Bound::Corner, out)?;
            }
            from = k;
        }
        Ok(())
    }

    /// A closed path without corners.
    fn loop_from(
        &self,
        begin: u32,
        t: S,
        cap: &impl Fn(&CurveParam<S>) -> Option<S>,
        out: &mut impl Store<Sample<S>>,
    ) -> Result<(), SamplingError> {
        let count = self.path.count;
        let end = if t > S::zero() { Pos { k: count, t: t.clone() } } else { Pos { k: count - 1, t: S::one() } };
        let run = Run {
            curve: self.curve,
            path: self.path,
            index: self.index,
            first: begin,
            start: Pos { k: 0, t },
            end,
            ends: [RunEnd::Seam, RunEnd::Seam],
        };
        self.push(run.place(&run.start), Bound::Start, out)?;
        inner_samples(&run, self.features, self.contacts, self.options, &|p| cap(&run.place(p)), out)
    }

    /// The joint before segment k of the path is a corner.
    fn corner_at(&self, k: u32) -> bool {
        self.curve.segment(self.path.first + k % self.path.count).is_some_and(|s| s.end(0).kind == JointKind::Corner)
    }

    /// The run from the start of segment `from` to the start of segment `to` (or the end of the path).
    fn run(&self, from: u32, to: u32) -> Run<'_, S> {
        Run {
            curve: self.curve,
            path: self.path,
            index: self.index,
            first: 0,
            start: Pos { k: from, t: S::zero() },
            end: Pos { k: to - 1, t: S::one() },
            ends: [self.ending(from, 0), self.ending(to - 1, 1)],
        }
    }

    fn ending(&self, k: u32, side: usize) -> RunEnd {
        let end = self.curve.segment(self.path.first + k % self.path.count).map(|s| s.end(side));
        match end {
            Some(e) if e.kind == JointKind::Corner || e.retracted => RunEnd::Singular,
            _ => RunEnd::Open,
        }
    }

    /// A sample at an end of a segment.
    fn fixed(&self, k: u32, side: usize, bound: Bound, out: &mut impl Store<Sample<S>>) -> Result<(), SamplingError> {
        let t = if side == 0 { S::zero() } else { S::one() };
        self.push(CurveParam { segment: self.path.first + k, t }, bound, out)
    }

    fn push(&self, at: CurveParam<S>, bound: Bound, out: &mut impl Store<Sample<S>>) -> Result<(), SamplingError> {
        if let Some(point) = self.curve.point(&at) {
            let lfs = self.features.lfs(&at, &point);
            out.push(Sample { path: self.index, at, point, lfs, bound })?;
        }
        Ok(())
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
