//! From one sample to the next, in turns of bounded work.
//!
//! Every search of the sampler (where the reach of a sample ends, where a disk is left, how far a chord may span) is a small
//! machine with its state in a struct and one function `turn` that does a bounded part of the work: at most one look-up of
//! the size at a point, or the chord error of one piece of a cubic, and a few evaluations of a cubic beside it. [`Search`]
//! strings them together. [`next`] turns until there is an answer; [`super::resumable`] turns as often as it is allowed to.
//! There is one sampler, so both give the same samples to the bit.
//!
//! Two things are not bounded turns: ρ-sampling, whose search is one turn, and the floors without a d_min, where a look-up
//! of a size marches along the path ([`super::size`]). The resumable sampler refuses both.

use super::chord::piece_error_sq;
use super::run::{Pos, Run};
use super::size::{Size, Sizes};
use super::{Bound, Condition, SamplingOptions, rho};
use crate::geometry::Point;
use crate::lfs::FeatureSize;
use crate::scalar::Scalar;

/// Where the next sample lies, and why.
#[derive(Clone, Debug, PartialEq)]
pub struct Next<S> {
    /// The position; the run's end if the run is done.
    pub pos: Pos<S>,
    /// What decided it.
    pub bound: Bound,
}

/// Upper bounds for one step beside the feature condition.
#[derive(Clone, Debug)]
pub struct Caps<S> {
    /// Largest chord error.
    pub chord: Option<S>,
    /// Largest gap: d_max.
    pub max: Option<S>,
    /// Largest gap by grading.
    pub graded: Option<S>,
}

/// Share of a length to which positions are bracketed: 2^−20, or what the scalar resolves.
fn precision<S: Scalar>() -> S {
    S::one().mul_pow2(-20).max(S::unit_roundoff().mul_pow2(4))
}

/// The share where ε is so large that a march must not try long steps: it converges slowly, so it ends earlier.
fn coarse_precision<S: Scalar>() -> S {
    S::one().mul_pow2(-11)
}

/// Whether ε is below 2/√5 ≈ 0.894 (16/18 is a little less): the condition then has one zero along the path.
fn crosses_once<S: Scalar>(factor: &S) -> bool {
    factor.clone() * &S::int(9) < S::int(8)
}

/// Marching steps before a search gives up and takes the safe side; each step of a march gains at least a share of what is
/// left, so that this is never reached on a curve.
const STEPS: u32 = 4096;

/// The sample after `s`.
pub fn next<S: Scalar, F: FeatureSize<S>>(
    run: &Run<'_, S>,
    sizes: &Sizes<'_, S, F>,
    options: &SamplingOptions<S>,
    caps: &Caps<S>,
    s: &Pos<S>,
) -> Next<S> {
    let mut search = Search::new(run, s);
    // Every machine below ends after a number of turns that it counts.
    loop {
        if let Some(next) = search.turn(run, sizes, options, caps) {
            return next;
        }
    }
}

/// The search for the sample after another one, between two turns.
#[derive(Clone, Debug)]
pub struct Search<S> {
    from: Pos<S>,
    here: Point<S>,
    next: Next<S>,
    stage: Stage<S>,
}

/// What the search is about.
#[derive(Clone, Debug)]
enum Stage<S> {
    /// Nothing has been looked at.
    Fresh,
    /// How far the sample itself serves.
    Covered(Covered<S>),
    /// How far a sample may lie behind x.
    Ahead { x: Pos<S>, reach: S, floored: bool, leaves: Leaves<S>, check: bool },
    /// The stretch between the two is looked at.
    Check { reach: S, floored: bool, checked: Checked<S> },
    /// The feature condition is settled; d_max is next.
    Max(Option<Leaves<S>>),
    /// Grading.
    Graded(Option<Leaves<S>>),
    /// Chord error.
    Chord(Option<ChordSearch<S>>),
    /// d_min.
    Min(Option<Reaches<S>>),
}

impl<S: Scalar> Search<S> {
    /// The search for the sample after `s`.
    pub fn new(run: &Run<'_, S>, s: &Pos<S>) -> Self {
        Self {
            from: s.clone(),
            here: run.point(s),
            next: Next { pos: run.end.clone(), bound: Bound::End },
            stage: Stage::Fresh,
        }
    }

    /// One turn; the answer, once there is one. Run, sizes, options and caps must be the same at every turn.
    #[inline(never)]
    pub fn turn<F: FeatureSize<S>, const BOUNDED: bool>(
        &mut self,
        run: &Run<'_, S>,
        sizes: &Sizes<'_, S, F, BOUNDED>,
        options: &SamplingOptions<S>,
        caps: &Caps<S>,
    ) -> Option<Next<S>> {
        let s = &self.from;
        match &mut self.stage {
            Stage::Fresh => {
                self.stage = match sizes.factor() {
                    None => Stage::Max(None),
                    Some(_) if !BOUNDED && matches!(options.condition, Condition::Rho(_)) => {
                        let (pos, floored) = rho::next(run, sizes, s);
                        self.next = Next { pos, bound: if floored { Bound::Floor } else { Bound::Epsilon } };
                        Stage::Max(None)
                    }
                    Some(_) => Stage::Covered(Covered::new(s)),
                };
            }
            Stage::Covered(covered) => {
                let factor = sizes.factor()?;
                let found = covered.turn(run, sizes, factor, &self.here)?;
                self.stage = match found {
                    None => Stage::Max(None),
                    Some((x, reach, floored)) => {
                        let centre = run.point(&x);
                        let check = !crosses_once(factor) || floored;
                        // For large ε, and where floors let bends be sharper than the size, the stretch between x and y must
                        // be looked at, and that needs some room at x.
                        let radius = if check {
                            reach.clone() * &(S::one() - &coarse_precision::<S>().twice())
                        } else {
                            reach.clone()
                        };
                        let leaves = Leaves::new(&x, centre, radius, run.end.clone());
                        Stage::Ahead { x, reach, floored, leaves, check }
                    }
                };
            }
            Stage::Ahead { x, reach, floored, leaves, check } => {
                let y = leaves.turn(run)?;
                if *check {
                    let checked = Checked::new(run, x, y);
                    self.stage = Stage::Check { reach: reach.clone(), floored: *floored, checked };
                } else {
                    self.next = ahead(run, s, y, reach, *floored);
                    self.stage = Stage::Max(None);
                }
            }
            Stage::Check { reach, floored, checked } => {
                let factor = sizes.factor()?;
                let y = checked.turn(run, sizes, factor)?;
                self.next = ahead(run, s, y, reach, *floored);
                self.stage = Stage::Max(None);
            }
            Stage::Max(leaves) => {
                let y = capped(leaves, run, s, &self.here, caps.max.as_ref(), &self.next.pos)?;
                if y < self.next.pos {
                    self.next = Next { pos: y, bound: Bound::Max };
                }
                self.stage = Stage::Graded(None);
            }
            Stage::Graded(leaves) => {
                let graded = if BOUNDED { None } else { caps.graded.as_ref() };
                let y = capped(leaves, run, s, &self.here, graded, &self.next.pos)?;
                if y < self.next.pos {
                    self.next = Next { pos: y, bound: Bound::Grading };
                }
                self.stage = Stage::Chord(None);
            }
            Stage::Chord(search) => {
                if let Some(allowed) = &caps.chord {
                    let search = search.get_or_insert_with(|| ChordSearch::new(s, &self.next.pos, allowed));
                    let y = search.turn(run)?;
                    if y < self.next.pos {
                        self.next = Next { pos: y, bound: Bound::Chord };
                    }
                }
                self.stage = Stage::Min(None);
            }
            Stage::Min(reaches) => {
                if let Some(reaches) = reaches {
                    let pos = reaches.turn(run)?;
                    self.next = Next { pos, bound: Bound::Min };
                } else if let Some(min) = &options.min_distance
                    && self.next.pos < run.end
                    && run.point(&self.next.pos).distance(&self.here) < *min
                {
                    // d_min goes before the upper bounds. The margin keeps rounding from bringing the gap below it.
                    let margin = S::one() + &S::unit_roundoff().mul_pow2(8);
                    *reaches = Some(Reaches::new(run, s, &self.here, min.clone() * &margin));
                    return None;
                }
                // A step must lead on, whatever rounding does to a bound, and to another point.
                if self.next.pos <= *s || (self.next.pos < run.end && run.point(&self.next.pos) == self.here) {
                    let on = run.advance(s, &run.curve.noise.clone().mul_pow2(2));
                    self.next.pos = on.max_of(&self.next.pos);
                }
                return Some(self.next.clone());
            }
        }
        None
    }
}

/// What the feature condition gave; a step must lead on.
fn ahead<S: Scalar>(run: &Run<'_, S>, s: &Pos<S>, y: Pos<S>, reach: &S, floored: bool) -> Next<S> {
    let pos = if y <= *s { run.advance(s, &(reach.clone() * &precision::<S>())) } else { y };
    Next { pos, bound: if floored { Bound::Floor } else { Bound::Epsilon } }
}

/// One turn towards where the path leaves the disk of an upper bound on the gap; `stop` if there is no such bound.
fn capped<S: Scalar>(
    leaves: &mut Option<Leaves<S>>,
    run: &Run<'_, S>,
    s: &Pos<S>,
    here: &Point<S>,
    cap: Option<&S>,
    stop: &Pos<S>,
) -> Option<Pos<S>> {
    let Some(cap) = cap else { return Some(stop.clone()) };
    leaves.get_or_insert_with(|| Leaves::new(s, here.clone(), cap.clone(), stop.clone())).turn(run)
}

/// The last position (inner end of a bracket) up to which every p has |p − s| < size(p), with its size; `None` if that is
/// the whole rest of the run.
///
/// |p − s| − size(p) grows by at most (1 + ε) per length, so a march by −(…)/(1 + ε) cannot jump over the first zero. For
/// ε below 2/√5 every zero is crossed upwards, away from floors: there is one at most, and the march may try longer steps.
#[derive(Clone, Debug)]
struct Covered<S> {
    inner: Pos<S>,
    /// |inner − s| − size, negative, and the size; `None` before the first look.
    known: Option<(S, Size<S>)>,
    /// The step that is being tried from `inner`.
    step: Option<S>,
    /// Looks so far.
    looks: u32,
}

/// A position, the size there, and whether a floor decided it.
type Reach<S> = (Pos<S>, S, bool);

impl<S: Scalar> Covered<S> {
    fn new(s: &Pos<S>) -> Self {
        Self { inner: s.clone(), known: None, step: None, looks: 0 }
    }

    /// At most one look at a size.
    #[inline(never)]
    fn turn<F: FeatureSize<S>, const BOUNDED: bool>(
        &mut self,
        run: &Run<'_, S>,
        sizes: &Sizes<'_, S, F, BOUNDED>,
        factor: &S,
        here: &Point<S>,
    ) -> Option<Option<Reach<S>>> {
        let excess = |p: &Pos<S>| {
            let point = run.point(p);
            let size = sizes.at(p, &point);
            let e = if size.reach.is_finite() { point.distance(here) - &size.reach } else { -S::infinity() };
            (e, size)
        };
        let Some((lack, size)) = &mut self.known else {
            self.known = Some(excess(&self.inner));
            return None;
        };
        // Where a floor holds, bends may be sharper than the size: the condition can have any number of zeros.
        let unique = crosses_once(factor) && !size.floored;
        let width = if unique { precision::<S>() } else { coarse_precision() };
        let left = -lack.clone();
        // On a straight stretch with constant size the zero is `left` away; that is tried first.
        let safe = left.clone() / &(S::one() + factor);
        if self.step.is_none() {
            // No medial axis: nothing ends the reach of s.
            if !lack.is_finite() || self.inner >= run.end {
                return Some(None);
            }
            // Sizes are positive: they have a floor.
            if left <= size.reach.clone() * &width || self.looks >= STEPS {
                return Some(Some((self.inner.clone(), size.reach.clone(), size.floored)));
            }
            self.step = Some(if unique { left } else { safe.clone() });
        }
        let step = self.step.clone()?;
        if self.looks >= STEPS {
            return Some(Some((self.inner.clone(), size.reach.clone(), size.floored)));
        }
        self.looks += 1;
        let p = run.advance(&self.inner, &step);
        let (e, at) = excess(&p);
        if e < S::zero() && (step <= safe || !at.floored) {
            self.inner = p;
            *lack = e;
            *size = at;
            self.step = None;
            return None;
        }
        if e < S::zero() {
            // A long step must not lead on to a floor.
            self.step = Some(safe);
            return None;
        }
        if step <= at.reach * &width {
            return Some(Some((self.inner.clone(), size.reach.clone(), size.floored)));
        }
        // Between the two by the secant, a little less. The safe step is safe up to rounding: where the size falls as fast
        // as it can, the zero lies at its very end.
        let secant = step.clone() * &*lack / &(lack.clone() - &e);
        let least = if step > safe { safe } else { step.half() };
        self.step = Some(secant.max(least) * &S::ratio(1023, 1024));
        None
    }
}

/// The last position (inner end of a bracket) before the path first leaves the disk of this radius around `centre`; not
/// beyond `stop`.
#[derive(Clone, Debug)]
struct Leaves<S> {
    inner: Pos<S>,
    centre: Point<S>,
    radius: S,
    stop: Pos<S>,
    turns: u32,
}

impl<S: Scalar> Leaves<S> {
    fn new(from: &Pos<S>, centre: Point<S>, radius: S, stop: Pos<S>) -> Self {
        Self { inner: from.clone(), centre, radius, stop, turns: 0 }
    }

    /// At most four evaluations of a cubic.
    fn turn(&mut self, run: &Run<'_, S>) -> Option<Pos<S>> {
        if !self.radius.is_finite() || self.inner >= self.stop {
            return Some(self.stop.clone());
        }
        let width = self.radius.clone() * &precision::<S>();
        let left = self.radius.clone() - &run.point(&self.inner).distance(&self.centre);
        if self.turns < STEPS && left > width {
            self.turns += 1;
            // Nothing on the way is farther than the way is long; a hair less, so that rounding does not lead outside. Where
            // a position's rounding is no longer small beside the radius, as in f32 on a straight line, a hair is not enough.
            let shares = [precision::<S>().half(), S::one().mul_pow2(-10), S::one().half()];
            for share in &shares {
                let p = run.advance(&self.inner, &(left.clone() * &(S::one() - share)));
                if run.point(&p).distance(&self.centre) < self.radius {
                    self.inner = p;
                    return None;
                }
            }
        }
        Some(self.inner.clone().min_of(&self.stop))
    }
}

/// The first position (outer end of a bracket) at which the distance from `centre` has reached a radius.
#[derive(Clone, Debug)]
struct Reaches<S> {
    leaves: Leaves<S>,
    /// Where the disk is still not left; `None` while that is searched.
    p: Option<Pos<S>>,
    turns: u32,
}

impl<S: Scalar> Reaches<S> {
    fn new(run: &Run<'_, S>, from: &Pos<S>, centre: &Point<S>, radius: S) -> Self {
        Self { leaves: Leaves::new(from, centre.clone(), radius, run.end.clone()), p: None, turns: 0 }
    }

    fn turn(&mut self, run: &Run<'_, S>) -> Option<Pos<S>> {
        let Some(p) = &self.p else {
            self.p = self.leaves.turn(run);
            return None;
        };
        let radius = &self.leaves.radius;
        if self.turns >= STEPS || *p >= run.end || run.point(p).distance(&self.leaves.centre) >= *radius {
            return Some(p.clone());
        }
        self.turns += 1;
        let width = (radius.clone() * &precision::<S>()).max(run.curve.noise.clone());
        self.p = Some(run.advance(p, &width));
        None
    }
}

/// Pulls y back until every p between x and y has |p − y| < size(p).
#[derive(Clone, Debug)]
struct Checked<S> {
    p: Pos<S>,
    y: Pos<S>,
    target: Point<S>,
    /// The search for a y nearer to p.
    back: Option<Leaves<S>>,
    turns: u32,
}

impl<S: Scalar> Checked<S> {
    fn new(run: &Run<'_, S>, x: &Pos<S>, y: Pos<S>) -> Self {
        Self { p: x.clone(), target: run.point(&y), y, back: None, turns: 0 }
    }

    /// At most one look at a size.
    fn turn<F: FeatureSize<S>, const BOUNDED: bool>(
        &mut self,
        run: &Run<'_, S>,
        sizes: &Sizes<'_, S, F, BOUNDED>,
        factor: &S,
    ) -> Option<Pos<S>> {
        if let Some(leaves) = &mut self.back {
            let back = leaves.turn(run)?;
            self.back = None;
            if back >= self.y {
                return Some(self.y.clone());
            }
            self.target = run.point(&back);
            self.y = back;
            return None;
        }
        if self.p >= self.y || self.turns >= STEPS {
            return Some(self.y.clone());
        }
        self.turns += 1;
        let point = run.point(&self.p);
        let size = sizes.at(&self.p, &point);
        let left = size.reach.clone() - &point.distance(&self.target);
        let room = size.reach.clone() * &coarse_precision::<S>();
        if left < room {
            // Some y nearer to p is needed; nearer by more than the room, so that the march gets on.
            let nearer = size.reach - &room.twice();
            self.back = Some(Leaves::new(&self.p, point, nearer, self.y.clone()));
        } else {
            self.p = run.advance(&self.p, &(left / &(S::one() + factor)));
        }
        None
    }
}

/// The farthest position up to `stop` that keeps the chord error, found by bracketing from a first guess.
#[derive(Clone, Debug)]
struct ChordSearch<S> {
    s: Pos<S>,
    stop: Pos<S>,
    allowed: S,
    /// Shares of the way to `stop`: one that keeps the error, one that does not, the one that is measured.
    lo: S,
    hi: S,
    at: S,
    good: Pos<S>,
    /// Whose error is measured.
    to: Pos<S>,
    k: u32,
    worst: S,
    /// Brackets so far; `None` while the whole way is measured.
    round: Option<u32>,
}

impl<S: Scalar> ChordSearch<S> {
    fn new(s: &Pos<S>, stop: &Pos<S>, allowed: &S) -> Self {
        Self {
            s: s.clone(),
            stop: stop.clone(),
            // A hair inside, so that a check in other arithmetic agrees.
            allowed: allowed.clone() * &(S::one() - &S::unit_roundoff().mul_pow2(10)),
            lo: S::zero(),
            hi: S::one(),
            at: S::one(),
            good: s.clone(),
            to: stop.clone(),
            k: s.k,
            worst: S::zero(),
            round: None,
        }
    }

    /// The chord error of at most one piece of a cubic.
    #[inline(never)]
    fn turn(&mut self, run: &Run<'_, S>) -> Option<Pos<S>> {
        if self.k <= self.to.k
            && let Some(segment) = run.segment(self.k)
        {
            let t0 = if self.k == self.s.k { self.s.t.clone() } else { S::zero() };
            let t1 = if self.k == self.to.k { self.to.t.clone() } else { S::one() };
            let (from, to) = (run.point(&self.s), run.point(&self.to));
            let piece = piece_error_sq(&segment.power, &t0, &t1, &from, &to);
            if piece > self.worst {
                self.worst = piece;
            }
            self.k += 1;
            return None;
        }
        let e = self.worst.clone().sqrt();
        let allowed = &self.allowed;
        let guess = match self.round {
            None => {
                if e <= *allowed {
                    return Some(self.stop.clone());
                }
                self.round = Some(0);
                // Chord error grows like the square of the gap.
                (allowed.clone() / &e).sqrt()
            }
            Some(round) => {
                let mut done = round >= 47;
                if e <= *allowed {
                    self.lo = self.at.clone();
                    self.good = self.to.clone();
                    done |= e >= allowed.clone() * &S::ratio(999, 1000)
                        || self.hi.clone() - &self.lo <= self.hi.clone() * &S::ratio(1, 10_000);
                } else {
                    self.hi = self.at.clone();
                }
                if done {
                    let lost = self.good <= self.s;
                    return Some(if lost { run.advance(&self.s, allowed) } else { self.good.clone() });
                }
                self.round = Some(round + 1);
                let scaled =
                    if e > S::zero() { self.at.clone() * &(allowed.clone() / &e).sqrt() } else { self.hi.clone() };
                let scaled = scaled * &S::ratio(9999, 10_000);
                let margin = (self.hi.clone() - &self.lo).mul_pow2(-5);
                if scaled > self.lo.clone() + &margin && scaled < self.hi.clone() - &margin {
                    scaled
                } else {
                    S::midpoint(&self.lo, &self.hi)
                }
            }
        };
        self.to = run.between(&self.s, &self.stop, &guess);
        self.at = guess;
        self.k = self.s.k;
        self.worst = S::zero();
        None
    }
}
