//! A run's samples, evenly spread.
//!
//! Greedy sampling leaves whatever is left for the last gap, often a sliver. An ε' ≤ ε near the smallest that needs as many
//! samples spreads the slack over all gaps: the count is the same, every bound still holds (each is scaled down together,
//! lengths by the scale, chord error by its square), and no two neighbours sit needlessly close at a seam, an end or a corner.
//!
//! The scale is found by at most six trials: a run of n gaps whose last one is a share of a full one suggests the scale
//! (n − 1 + share)/n. Trials that need more samples bound it from below. They stop when the last gap is at least 15/16 of
//! the one before it; the smallest ε' itself is not looked for (`docs/mathematics.md`, section 11).

use super::run::{Pos, Run};
use super::size::{Sizes, Stretches};
use super::step::{self, Caps, Next};
use super::{Bound, Sample, SamplingError, SamplingOptions};
use crate::buffer::Store;
use crate::curve::contact::Contact;
use crate::lfs::FeatureSize;
use crate::scalar::Scalar;

/// Trials after the first; each brings the last gap nearer to the others.
const TRIALS: u32 = 5;

/// What a trial gave.
struct Trial<S> {
    /// Gaps of the run.
    gaps: u32,
    /// The last gap as a share of the one before it, at most 1.
    share: S,
}

/// Appends the samples strictly inside a run.
///
/// `cap` limits the gap after a position (grading); it is asked before every step.
///
/// # Errors
/// See [`SamplingError`].
pub fn inner_samples<S: Scalar, F: FeatureSize<S>>(
    run: &Run<'_, S>,
    features: &F,
    contacts: &[Contact<S>],
    options: &SamplingOptions<S>,
    cap: &impl Fn(&Pos<S>) -> Option<S>,
    out: &mut impl Store<Sample<S>>,
) -> Result<(), SamplingError> {
    let base = out.items().len();
    let spreader = Spreader { run, features, contacts, options, cap, base, stretches: Stretches::default() };
    let first = spreader.trial(&S::one(), out)?;
    if options.even && first.gaps > 1 && first.share < S::ratio(15, 16) {
        let gaps = first.gaps;
        let target = |share: &S, gaps: u32| {
            let n = S::int(i32::try_from(gaps).unwrap_or(i32::MAX));
            (n.clone() - &S::one() + share) / &n
        };
        let (mut low, mut high, mut last) = (S::zero(), S::one(), S::one());
        let mut guess = target(&first.share, gaps);
        for _ in 0..TRIALS {
            if guess >= high || guess <= low {
                break;
            }
            let trial = spreader.trial(&guess, out)?;
            last = guess.clone();
            if trial.gaps <= gaps {
                high = guess.clone();
                if trial.share >= S::ratio(15, 16) {
                    break;
                }
                guess = guess * &target(&trial.share, gaps);
                if guess <= low {
                    guess = S::midpoint(&low, &high);
                }
            } else {
                low = guess;
                guess = S::midpoint(&low, &high);
            }
        }
        if last != high {
            spreader.trial(&high, out)?;
        }
    }
    spreader.keep_distance(out);
    spreader.look_up(out);
    Ok(())
}

struct Spreader<'r, S, F, C> {
    run: &'r Run<'r, S>,
    features: &'r F,
    contacts: &'r [Contact<S>],
    options: &'r SamplingOptions<S>,
    cap: &'r C,
    base: usize,
    stretches: Stretches<S>,
}

impl<S: Scalar, F: FeatureSize<S>, C: Fn(&Pos<S>) -> Option<S>> Spreader<'_, S, F, C> {
    /// Greedy samples with all bounds scaled, in place of what the last trial left.
    fn trial(&self, scale: &S, out: &mut impl Store<Sample<S>>) -> Result<Trial<S>, SamplingError> {
        out.shorten(self.base);
        let run = self.run;
        let sizes = Sizes::new(run, self.features, self.contacts, self.options, scale, &self.stretches);
        let chord = self.options.chord_error.as_ref().map(|c| c.clone() * scale * scale);
        let max = self.options.max_distance.as_ref().map(|m| m.clone() * scale);
        let mut here = run.start.clone();
        let mut point = run.point(&here);
        let mut before = S::infinity();
        for gaps in 1..=self.options.limit {
            let graded = (self.cap)(&here).map(|g| g * scale);
            let caps = Caps { chord: chord.clone(), max: max.clone(), graded };
            let Next { pos, bound } = step::next(run, &sizes, self.options, &caps, &here);
            let there = run.point(&pos);
            let gap = there.distance(&point);
            if pos >= run.end {
                let share = if before > gap && before.is_finite() { gap / &before } else { S::one() };
                return Ok(Trial { gaps, share });
            }
            out.push(Sample { path: run.index, at: run.place(&pos), point: there.clone(), lfs: S::infinity(), bound })?;
            before = gap;
            here = pos;
            point = there;
        }
        Err(SamplingError::Limit(self.options.limit))
    }

    /// The last inner sample is moved back, or dropped, where it is nearer than d_min to the run's end.
    fn keep_distance(&self, out: &mut impl Store<Sample<S>>) {
        let Some(min) = &self.options.min_distance else { return };
        let count = out.items().len();
        if count <= self.base {
            return;
        }
        let before = if count >= self.base + 2 {
            out.items().get(count - 2).map(|s| self.position_of(s))
        } else {
            Some(self.run.start.clone())
        };
        let (Some(last), Some(before)) = (out.items().last(), before) else { return };
        match last_kept(self.run, min, &before, &self.position_of(last)) {
            LastKept::AsItIs => {}
            LastKept::Moved(pos) => {
                if let Some(s) = out.items_mut().last_mut() {
                    s.at = self.run.place(&pos);
                    s.point = self.run.point(&pos);
                    s.bound = Bound::Min;
                }
            }
            LastKept::Dropped => out.shorten(count - 1),
        }
    }

    /// The run's position of one of its samples.
    fn position_of(&self, s: &Sample<S>) -> Pos<S> {
        let n = s.at.segment - self.run.path.first;
        let mut k = (n + self.run.path.count - self.run.first) % self.run.path.count;
        if k == self.run.start.k && s.at.t < self.run.start.t {
            k += self.run.path.count;
        }
        Pos { k, t: s.at.t.clone() }
    }

    /// Fills in lfs.
    fn look_up(&self, out: &mut impl Store<Sample<S>>) {
        for s in out.items_mut().iter_mut().skip(self.base) {
            s.lfs = self.features.lfs(&s.at, &s.point);
        }
    }
}

/// What becomes of the last inner sample of a run.
pub(super) enum LastKept<S> {
    /// It keeps d_min to the run's end.
    AsItIs,
    /// It is moved back to here.
    Moved(Pos<S>),
    /// There is no room for it.
    Dropped,
}

/// What becomes of the last inner sample, at `last`, with the sample at `before` before it.
///
/// It is moved to the last position that keeps d_min to the run's end: what lies behind that is within d_min of the end, and
/// what lies before it is nearer to it than it was to `last`. Where even that comes too near to the sample before it, every
/// point between has one of the two within d_min, and the sample goes.
pub(super) fn last_kept<S: Scalar>(run: &Run<'_, S>, min: &S, before: &Pos<S>, last: &Pos<S>) -> LastKept<S> {
    let end = run.point(&run.end);
    let keeps = |p: &Pos<S>| run.point(p).distance(&end) >= *min;
    if keeps(last) {
        return LastKept::AsItIs;
    }
    let half = S::one().half();
    // A run may end where it starts: then its middle is tried.
    let (mut low, mut high) = (before.clone(), last.clone());
    if !keeps(&low) {
        low = run.between(before, last, &half);
        if !keeps(&low) {
            return LastKept::Dropped;
        }
    }
    for _ in 0..S::BITS + 4 {
        let middle = run.between(&low, &high, &half);
        if keeps(&middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    if run.point(&low).distance(&run.point(before)) >= *min { LastKept::Moved(low) } else { LastKept::Dropped }
}
