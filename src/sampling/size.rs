//! How far a sample may serve: max(ε·lfs, floor).
//!
//! At corners, crossings, T-junctions, cusps and retracted handles lfs falls to 0 and no finite ε-sample exists. There a
//! *floor* takes its place: the user's d_min anywhere, otherwise a thousandth of the diagonal on the *stretch* around such a
//! point, that is the part of the path around it where ε·lfs is below that floor, and a ten-millionth elsewhere (strokes that
//! nearly coincide). Where a stretch ends, ε·lfs equals the floor: the size stays continuous.
//!
//! Whether a position lies on a stretch is found by marching along the path in both directions until ε·lfs reaches the
//! floor or a singular point is met. lfs is 1-Lipschitz, so a step of (floor − ε·lfs)/ε cannot jump over the stretch's end.
//! What is marched through errs to the small side, by the tolerance of lfs and 2^−10 of the floor, and it does not depend
//! on the scale that [`super::spread`] tries: a stretch here is part of a true one. The answer is remembered for the
//! interval that was marched through.

use super::run::{Pos, Run, RunEnd};
use super::{Condition, SamplingOptions};
use crate::curve::contact::Contact;
use crate::geometry::Point;
use crate::lfs::FeatureSize;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;
use core::cell::{Cell, RefCell};

/// A size and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Size<S> {
    /// The sample must be nearer than this.
    pub reach: S,
    /// A floor took the place of ε·lfs.
    pub floored: bool,
}

/// The remembered interval: its ends, and whether a singular point lies on it.
type Stretch<S> = (Pos<S>, Pos<S>, bool);

/// What was found of a run's stretches: the last few intervals that were marched through. It does not depend on the scale.
#[derive(Debug)]
pub struct Stretches<S> {
    known: RefCell<ArrayVec<Stretch<S>, 32>>,
}

impl<S> Default for Stretches<S> {
    fn default() -> Self {
        Self { known: RefCell::new(ArrayVec::new()) }
    }
}

impl<S: Scalar> Stretches<S> {
    /// Whether a singular point lies on the stretch around p, if that is known.
    fn recall(&self, p: &Pos<S>) -> Option<bool> {
        self.known.try_borrow().ok()?.iter().find(|(from, to, _)| p >= from && p <= to).map(|s| s.2)
    }

    /// Remembers an interval, in place of the oldest where there is no room.
    fn remember(&self, stretch: Stretch<S>) {
        // Nothing is borrowed when this is called, and there is room: neither can fail, and neither links a panic.
        if let Ok(mut known) = self.known.try_borrow_mut() {
            if known.is_full() {
                known.pop_at(0);
            }
            let _ = known.try_push(stretch);
        }
    }
}

/// Sizes along one run.
///
/// `BOUNDED` are those of [`super::resumable`], which refuses what takes no bounded number of turns: there is a d_min, and the
/// condition is not ρ. What only the others need is then not linked.
pub struct Sizes<'r, S, F, const BOUNDED: bool = false> {
    run: &'r Run<'r, S>,
    features: &'r F,
    contacts: &'r [Contact<S>],
    options: &'r SamplingOptions<S>,
    /// ε·(1 − tolerance), or ρ likewise; `None` without feature condition.
    factor: Option<S>,
    /// ε·(1 + tolerance), without scale: what is below the floor with this factor is so in truth.
    certain: S,
    stretches: &'r Stretches<S>,
    /// The last point looked at, and its lfs: a bound for the next.
    last: Cell<Option<(Point<S>, S)>>,
}

impl<'r, S: Scalar, F: FeatureSize<S>, const BOUNDED: bool> Sizes<'r, S, F, BOUNDED> {
    /// Sizes along a run; `scale` in (0, 1] multiplies ε.
    pub fn new(
        run: &'r Run<'r, S>,
        features: &'r F,
        contacts: &'r [Contact<S>],
        options: &'r SamplingOptions<S>,
        scale: &S,
        stretches: &'r Stretches<S>,
    ) -> Self {
        let (factor, certain) = match &options.condition {
            Condition::Epsilon(e) | Condition::Rho(e) => {
                (Some((S::one() - &options.tolerance) * e * scale), (S::one() + &options.tolerance) * e)
            }
            Condition::Unbounded => (None, S::one()),
        };
        Self { run, features, contacts, options, factor, certain, stretches, last: Cell::new(None) }
    }

    /// Goes on from the last look-up of other sizes along the same run: later look-ups are faster, not different.
    pub fn resume(&self, last: Option<(Point<S>, S)>) {
        self.last.set(last);
    }

    /// The last point that was looked at, and its lfs, for [`Self::resume`].
    pub fn looked(self) -> Option<(Point<S>, S)> {
        self.last.into_inner()
    }

    /// ε·(1 − tolerance)·scale.
    pub fn factor(&self) -> Option<&S> {
        self.factor.as_ref()
    }

    /// lfs as given.
    pub fn lfs(&self, p: &Pos<S>, point: &Point<S>) -> S {
        let place = self.run.place(p);
        let lfs = match self.last.take() {
            Some((q, lfs)) => self.features.lfs_below(&place, point, &(q.distance(point) + &lfs)),
            None => self.features.lfs(&place, point),
        };
        self.last.set(Some((point.clone(), lfs.clone())));
        lfs
    }

    /// The size at a position of the run, whose point is known.
    pub fn at(&self, p: &Pos<S>, point: &Point<S>) -> Size<S> {
        let Some(factor) = &self.factor else {
            return Size { reach: S::infinity(), floored: false };
        };
        let lfs = self.lfs(p, point);
        self.floored(p, lfs, factor)
    }

    /// max(factor·lfs, floor).
    pub fn floored(&self, p: &Pos<S>, lfs: S, factor: &S) -> Size<S> {
        let reach = if lfs.is_finite() { lfs * factor } else { S::infinity() };
        if let Some(min) = &self.options.min_distance {
            let floored = reach < *min;
            return Size { reach: reach.max(min.clone()), floored };
        }
        if BOUNDED {
            return Size { reach, floored: false };
        }
        let diagonal = self.run.curve.diagonal;
        let singular = self.options.singular_floor.clone() * diagonal;
        if reach >= singular {
            return Size { reach, floored: false };
        }
        let floor = if self.on_stretch(p, &singular) { singular } else { self.options.floor.clone() * diagonal };
        let floored = reach < floor;
        Size { reach: reach.max(floor), floored }
    }

    /// A singular point lies on the stretch around p where ε·lfs is below `floor`.
    fn on_stretch(&self, p: &Pos<S>, floor: &S) -> bool {
        if let Some(singular) = self.stretches.recall(p) {
            return singular;
        }
        let (to, after) = self.march(p, floor, true);
        let (from, before) = self.march(p, floor, false);
        let singular = after || before;
        self.stretches.remember((from, to, singular));
        singular
    }

    /// Marches from p to where ε·lfs reaches the floor. The last position below it, and whether the way met a singular
    /// point.
    fn march(&self, p: &Pos<S>, floor: &S, forwards: bool) -> (Pos<S>, bool) {
        let run = self.run;
        let least = floor.clone().mul_pow2(-10);
        let mut here = p.clone();
        let mut met = false;
        let (stop, ending) = if forwards { (&run.end, &run.ends[1]) } else { (&run.start, &run.ends[0]) };
        // Each step moves by a 1024th of the floor at least, or to the end of a segment: the loop ends.
        loop {
            let room = floor.clone() - &(self.lfs(&here, &run.point(&here)) * &self.certain);
            if room <= least {
                return (here, met);
            }
            met |= self.singular_between(&here, &here);
            if here == *stop {
                return (here, met || *ending == RunEnd::Singular);
            }
            let step = room / &self.certain;
            let next = if forwards { run.advance(&here, &step) } else { self.retreat(&here, &step) };
            let (a, b) = if forwards { (&here, &next) } else { (&next, &here) };
            met |= self.singular_between(a, b);
            here = next;
        }
    }

    /// [`Run::advance`] backwards.
    fn retreat(&self, p: &Pos<S>, length: &S) -> Pos<S> {
        let run = self.run;
        let here = if p.t <= S::zero() && p.k > run.start.k { Pos { k: p.k - 1, t: S::one() } } else { p.clone() };
        let Some(segment) = run.segment(here.k) else { return run.start.clone() };
        let speed = segment.power.derivative(&here.t).norm();
        let bend =
            segment.power.second_derivative(&here.t).norm().max(segment.power.second_derivative(&S::zero()).norm());
        let root = (bend * length).twice() + &speed.clone().square();
        let slope = speed + &root.sqrt();
        let to = if slope > S::zero() { here.t.clone() - &(length.clone().twice() / &slope) } else { S::zero() };
        let [first, _] = run.window(here.k);
        if to > first && to < here.t { Pos { k: here.k, t: to } } else { Pos { k: here.k, t: first } }
    }

    /// A contact lies between two positions of the same or of neighbouring segments, ends included.
    fn singular_between(&self, a: &Pos<S>, b: &Pos<S>) -> bool {
        if a.k < b.k {
            return self.singular_on(a.k, a.t.clone(), S::one()) || self.singular_on(b.k, S::zero(), b.t.clone());
        }
        self.singular_on(b.k, a.t.clone(), b.t.clone())
    }

    /// A contact lies between two parameters of segment k of the run, ends included.
    fn singular_on(&self, k: u32, from: S, to: S) -> bool {
        let index = self.run.segment_index(k);
        let (index, from, to) = match self.run.curve.segment(index).and_then(|s| s.twin) {
            Some(twin) if twin.reversed() => (twin.segment(), twin.place(to).t, twin.place(from).t),
            Some(twin) => (twin.segment(), from, to),
            None => (index, from, to),
        };
        let first = self.contacts.partition_point(|c| c.segment < index);
        self.contacts
            .get(first..)
            .unwrap_or_default()
            .iter()
            .take_while(|c| c.segment == index)
            .any(|c| c.span[0] <= to && c.span[1] >= from)
    }
}
