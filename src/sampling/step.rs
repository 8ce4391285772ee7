//! From one sample to the next.

use super::chord::chord_error;
use super::run::{Pos, Run};
use super::size::Sizes;
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
    let here = run.point(s);
    let mut next = by_features(run, sizes, options, s, &here);
    for (cap, bound) in [(&caps.max, Bound::Max), (&caps.graded, Bound::Grading)] {
        if let Some(cap) = cap {
            let y = leaves(run, s, &here, cap, &next.pos);
            if y < next.pos {
                next = Next { pos: y, bound };
            }
        }
    }
    if let Some(chord) = &caps.chord {
        let y = by_chord(run, s, &next.pos, chord);
        if y < next.pos {
            next = Next { pos: y, bound: Bound::Chord };
        }
    }
    if let Some(min) = &options.min_distance
        && next.pos < run.end
        && run.point(&next.pos).distance(&here) < *min
    {
        // d_min goes before the upper bounds. The margin keeps rounding from bringing the gap below it.
        let margin = S::one() + &S::unit_roundoff().mul_pow2(8);
        next = Next { pos: reaches(run, s, &here, &(min.clone() * &margin)), bound: Bound::Min };
    }
    // A step must lead on, whatever rounding does to a bound.
    if next.pos <= *s {
        next.pos = run.advance(s, &run.curve.noise.clone().mul_pow2(2));
    }
    next
}

/// The two moves of the feature condition.
fn by_features<S: Scalar, F: FeatureSize<S>>(
    run: &Run<'_, S>,
    sizes: &Sizes<'_, S, F>,
    options: &SamplingOptions<S>,
    s: &Pos<S>,
    here: &Point<S>,
) -> Next<S> {
    let Some(factor) = sizes.factor() else { return Next { pos: run.end.clone(), bound: Bound::End } };
    if matches!(options.condition, Condition::Rho(_)) {
        let (pos, floored) = rho::next(run, sizes, s);
        return Next { pos, bound: if floored { Bound::Floor } else { Bound::Epsilon } };
    }
    let Some((x, reach, floored)) = covered(run, sizes, factor, s, here) else {
        return Next { pos: run.end.clone(), bound: Bound::End };
    };
    let centre = run.point(&x);
    let mut y = if crosses_once(factor) && !floored {
        leaves(run, &x, &centre, &reach, &run.end)
    } else {
        // For large ε, and where floors let bends be sharper than the size, the stretch between x and y must be looked at,
        // and that needs some room at x.
        let room = reach.clone() * &(S::one() - &coarse_precision::<S>().twice());
        let y = leaves(run, &x, &centre, &room, &run.end);
        checked(run, sizes, factor, &x, y)
    };
    // A step must lead on.
    if y <= *s {
        y = run.advance(s, &(reach * &precision::<S>()));
    }
    Next { pos: y, bound: if floored { Bound::Floor } else { Bound::Epsilon } }
}

/// The last position (inner end of a bracket) up to which every p has |p − s| < size(p), with its size; `None` if that is
/// the whole rest of the run.
///
/// |p − s| − size(p) grows by at most (1 + ε) per length, so a march by −(…)/(1 + ε) cannot jump over the first zero. For
/// ε below 2/√5 every zero is crossed upwards, away from floors: there is one at most, and the march may try longer steps.
fn covered<S: Scalar, F: FeatureSize<S>>(
    run: &Run<'_, S>,
    sizes: &Sizes<'_, S, F>,
    factor: &S,
    s: &Pos<S>,
    here: &Point<S>,
) -> Option<(Pos<S>, S, bool)> {
    let excess = |p: &Pos<S>| {
        let point = run.point(p);
        let size = sizes.at(p, &point);
        let e = if size.reach.is_finite() { point.distance(here) - &size.reach } else { -S::infinity() };
        (e, size)
    };
    let slope = S::one() + factor;
    let mut inner = s.clone();
    let (mut lack, mut size) = excess(&inner);
    // Sizes are positive: they have a floor.
    for _ in 0..STEPS {
        if !lack.is_finite() {
            // No medial axis: nothing ends the reach of s.
            return None;
        }
        if inner >= run.end {
            return None;
        }
        // Where a floor holds, bends may be sharper than the size: the condition can have any number of zeros.
        let unique = crosses_once(factor) && !size.floored;
        let width = if unique { precision::<S>() } else { coarse_precision() };
        let left = -lack.clone();
        if left <= size.reach.clone() * &width {
            break;
        }
        // On a straight stretch with constant size the zero is `left` away; that is tried first.
        let safe = left.clone() / &slope;
        let mut step = if unique { left } else { safe.clone() };
        loop {
            let p = run.advance(&inner, &step);
            let (e, at) = excess(&p);
            if e < S::zero() && (step <= safe || !at.floored) {
                inner = p;
                lack = e;
                size = at;
                break;
            }
            if e < S::zero() {
                // A long step must not lead on to a floor.
                step = safe.clone();
                continue;
            }
            if step <= at.reach * &width {
                return Some((inner, size.reach, size.floored));
            }
            // Between the two by the secant, a little less. The safe step is safe up to rounding: where the size falls as fast
            // as it can, the zero lies at its very end.
            let secant = step.clone() * &lack / &(lack.clone() - &e);
            let least = if step > safe { safe.clone() } else { step.half() };
            step = secant.max(least) * &S::ratio(1023, 1024);
        }
    }
    Some((inner, size.reach, size.floored))
}

/// The last position (inner end of a bracket) before the path first leaves the disk of this radius around `centre`; not
/// beyond `stop`.
fn leaves<S: Scalar>(run: &Run<'_, S>, from: &Pos<S>, centre: &Point<S>, radius: &S, stop: &Pos<S>) -> Pos<S> {
    if !radius.is_finite() {
        return stop.clone();
    }
    let width = radius.clone() * &precision::<S>();
    // Nothing on the way is farther than the way is long; a hair less, so that rounding does not lead outside. Where a
    // position's rounding is no longer small beside the radius, as in f32 on a straight line, a hair is not enough.
    let shares = [precision::<S>().half(), S::one().mul_pow2(-10), S::one().half()];
    let mut inner = from.clone();
    'march: for _ in 0..STEPS {
        if inner >= *stop {
            return stop.clone();
        }
        let left = radius.clone() - &run.point(&inner).distance(centre);
        if left <= width {
            break;
        }
        for share in &shares {
            let p = run.advance(&inner, &(left.clone() * &(S::one() - share)));
            if run.point(&p).distance(centre) < *radius {
                inner = p;
                continue 'march;
            }
        }
        break;
    }
    inner.min_of(stop)
}

/// The first position (outer end of a bracket) at which the distance from `centre` has reached a radius.
fn reaches<S: Scalar>(run: &Run<'_, S>, from: &Pos<S>, centre: &Point<S>, radius: &S) -> Pos<S> {
    let width = (radius.clone() * &precision::<S>()).max(run.curve.noise.clone());
    let mut p = leaves(run, from, centre, radius, &run.end);
    for _ in 0..STEPS {
        if p >= run.end || run.point(&p).distance(centre) >= *radius {
            break;
        }
        p = run.advance(&p, &width);
    }
    p
}

/// Pulls y back until every p between x and y has |p − y| < size(p).
fn checked<S: Scalar, F: FeatureSize<S>>(
    run: &Run<'_, S>,
    sizes: &Sizes<'_, S, F>,
    factor: &S,
    x: &Pos<S>,
    mut y: Pos<S>,
) -> Pos<S> {
    let slope = S::one() + factor;
    let mut p = x.clone();
    let mut target = run.point(&y);
    for _ in 0..STEPS {
        if p >= y {
            break;
        }
        let point = run.point(&p);
        let size = sizes.at(&p, &point);
        let left = size.reach.clone() - &point.distance(&target);
        let room = size.reach.clone() * &coarse_precision::<S>();
        if left < room {
            // Some y nearer to p is needed; nearer by more than the room, so that the march gets on.
            let nearer = size.reach - &room.twice();
            let back = leaves(run, &p, &point, &nearer, &y);
            if back >= y {
                break;
            }
            y = back;
            target = run.point(&y);
        } else {
            p = run.advance(&p, &(left / &slope));
        }
    }
    y
}

/// The farthest position up to `stop` that keeps the chord error, found by bracketing from a first guess.
fn by_chord<S: Scalar>(run: &Run<'_, S>, s: &Pos<S>, stop: &Pos<S>, allowed: &S) -> Pos<S> {
    // A hair inside, so that a check in other arithmetic agrees.
    let allowed = allowed.clone() * &(S::one() - &S::unit_roundoff().mul_pow2(10));
    let error = chord_error(run, s, stop);
    if error <= allowed {
        return stop.clone();
    }
    // Chord error grows like the square of the gap.
    let (mut lo, mut hi) = (S::zero(), S::one());
    let mut guess = (allowed.clone() / &error).sqrt();
    let mut good = s.clone();
    for _ in 0..48 {
        let at = guess.clone();
        let p = run.between(s, stop, &at);
        let e = chord_error(run, s, &p);
        if e <= allowed {
            lo = at.clone();
            good = p;
            if e >= allowed.clone() * &S::ratio(999, 1000) || hi.clone() - &lo <= hi.clone() * &S::ratio(1, 10_000) {
                break;
            }
        } else {
            hi = at.clone();
        }
        let scaled = if e > S::zero() { at * &(allowed.clone() / &e).sqrt() } else { hi.clone() };
        let scaled = scaled * &S::ratio(9999, 10_000);
        let margin = (hi.clone() - &lo).mul_pow2(-5);
        guess =
            if scaled > lo.clone() + &margin && scaled < hi.clone() - &margin { scaled } else { S::midpoint(&lo, &hi) };
    }
    if good <= *s { run.advance(s, &allowed) } else { good }
}
