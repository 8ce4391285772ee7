//! ρ-sampling (Ohrhallinger, Mitchell, Wimmer 2016): the reach of an interval takes the place of lfs.
//!
//! reach([s₀, s₁]) is the smallest lfs on the path between two consecutive samples. S is a ρ-sample if every p between them
//! has min(|p − s₀|, |p − s₁|) < ρ·reach([s₀, s₁]). Where lfs is small only near one end, this asks for more than
//! ε-sampling; but one ρ = 0.9 reconstructs what needs ε = 0.47, so fewer samples do in all.
//!
//! As y moves away from s the reach falls and the largest distance rises: the farthest y is found by bracketing. The
//! smallest lfs of an interval is enclosed by bisection, using that lfs is 1-Lipschitz.

use super::run::{Pos, Run};
use super::size::Sizes;
use crate::buffer::Keep;
use crate::lfs::FeatureSize;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// The farthest position y such that the stretch from s to y fulfils the condition (inner end of a bracket), and whether a
/// floor took part.
pub fn next<S: Scalar, F: FeatureSize<S>, const BOUNDED: bool>(
    run: &Run<'_, S>,
    sizes: &Sizes<'_, S, F, BOUNDED>,
    s: &Pos<S>,
) -> (Pos<S>, bool) {
    let here = run.point(s);
    let first = sizes.at(s, &here);
    if !first.reach.is_finite() {
        return (run.end.clone(), false);
    }
    // Where lfs is constant the enclosure of its minimum costs 1/precision look-ups a gap.
    let precision = S::one().mul_pow2(-8);
    let mut floored = first.floored;
    let mut inner = s.clone();
    let mut least = first.reach.clone();
    let mut step = first.reach;
    let shortest = least.clone() * &precision.clone().square();
    // The step doubles while it succeeds and halves while it fails: a bracket in about twice the bits of the precision.
    let mut grow = true;
    for _ in 0..256 {
        if inner >= run.end || step < shortest {
            break;
        }
        let y = run.advance(&inner, &step);
        let (reach, low) = least_size(run, sizes, &inner, &y, &precision);
        let all = reach.min(least.clone());
        if half_gap(run, s, &y) < all {
            inner = y;
            least = all;
            floored |= low;
            if grow {
                step = step.twice();
            }
        } else {
            grow = false;
            step = step.half();
        }
    }
    if inner <= *s {
        inner = run.advance(s, &shortest);
    }
    (inner, floored)
}

/// A lower bound, good to `precision`, of the size on [a, b], and whether a floor took part.
fn least_size<S: Scalar, F: FeatureSize<S>, const BOUNDED: bool>(
    run: &Run<'_, S>,
    sizes: &Sizes<'_, S, F, BOUNDED>,
    a: &Pos<S>,
    b: &Pos<S>,
    precision: &S,
) -> (S, bool) {
    let look = |p: &Pos<S>| {
        let point = run.point(p);
        let size = sizes.at(p, &point);
        (p.clone(), point, size.reach, size.floored)
    };
    let factor = sizes.factor().cloned().unwrap_or_else(S::one);
    let mut here = look(a);
    let end = look(b);
    let mut least = here.2.clone().min(end.2.clone());
    let mut floored = here.3 || end.3;
    let mut pending = ArrayVec::<_, 24>::new();
    pending.keep(end);
    while let Some(top) = pending.pop() {
        // Between two looks the size falls at most like its Lipschitz bound allows. Arcs of samples are nearly straight:
        // 5/4 of the chord bounds the length of the stretch.
        let length = here.1.distance(&top.1) * &S::ratio(5, 4);
        let bound = (here.2.clone() + &top.2 - &(length * &factor)).half();
        let good = bound >= least.clone() * &(S::one() - precision);
        if good || pending.remaining_capacity() < 2 {
            let floor = least.clone() * &(S::one() - precision);
            least = least.min(bound.max(floor));
            here = top;
            continue;
        }
        let middle = look(&run.between(&here.0, &top.0, &S::one().half()));
        floored |= middle.3;
        least = least.min(middle.2.clone());
        pending.keep(top);
        pending.keep(middle);
    }
    (least, floored)
}

/// The largest min(|p − s|, |p − y|) between s and y: where the two are equal.
fn half_gap<S: Scalar>(run: &Run<'_, S>, s: &Pos<S>, y: &Pos<S>) -> S {
    let (a, b) = (run.point(s), run.point(y));
    let (mut lo, mut hi) = (S::zero(), S::one());
    let mut half = S::zero();
    for _ in 0..24 {
        let at = S::midpoint(&lo, &hi);
        let p = run.point(&run.between(s, y, &at));
        let (da, db) = (p.distance(&a), p.distance(&b));
        half = half.max(da.clone().min(db.clone()));
        if da < db {
            lo = at;
        } else {
            hi = at;
        }
    }
    half
}
