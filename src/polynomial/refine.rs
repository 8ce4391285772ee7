//! Refinement of isolated roots.
//!
//! A root with a change of sign is found by Halley's method inside its bracket, first with values in the scalar's own
//! precision, in the end with values as if in twice that precision: so it comes out rounded correctly but for about one unit
//! in the last place, however ill-conditioned it is up to a condition of 1/u. The bracket returned is the isolating one cut
//! to that.
//!
//! A k-fold root is ill-conditioned, but the root of the (k−1)-st derivative inside its bracket is simple; it is the
//! mean of the cluster up to second order, and it is what is returned as the value.
//!
//! **Width of clusters.** Isolation answers with stretches where |p| is some roundings at most. What is in there for the
//! coefficients as given is looked at in twice the precision.
//!
//! * If there is none, it is what one rounding of each coefficient cannot rule out: see below.
//! * If all real roots are within 2ρ of the mean, it is one cluster, and 2ρ on both sides of its mean are its bracket: no wider
//!   than four attainable errors ρ = min over j of (η/|cⱼ|)^(1/j), η = u·Σ|aⱼ||x|ʲ, cⱼ the Taylor coefficients there. No
//!   power of a fraction is needed: r ≤ 2ρ says |cⱼ|(r/2)ʲ ≤ η for all j.
//! * If there are as many as there seemed to be, they can be told apart and are reported each by itself.
//! * Otherwise some have left the real line. Then it is told apart what one rounding of each coefficient leaves: what isolation
//!   cannot resolve is a stretch with |p| ≤ 2η(1 + small). Where p is like c·∏(x − zᵢ) with k factors, Pólya's
//!   inequality (1928) says that {x: |p| ≤ 2η} has a length of at most 4(2η/2c)^(1/k) = 4ρₖ, ρₖ = (η/c)^(1/k) being the attainable
//!   error of a k-fold root.

use super::bernstein::{Given, Piece};
use super::isolate::{Found, Isolated, isolate};
use super::newton::{narrowing, quick_halley};
use super::roots::push;
use super::{Polynomial, Root, RootKind, Roots, twofold};
use crate::scalar::Scalar;

/// Rounds of looking for the order and the middle of a cluster.
const ROUNDS: usize = 4;

/// The one root in [lower, upper], where p changes its sign; `rising`: from − to +.
///
/// A step taken from a value in twice the precision is as wrong as the slope is, in proportion: an error of 2N²u·Σ|aⱼ||x|ʲ/|x|
/// leaves that share of the step. Where this is below the resolution no further step is needed to see it.
///
/// The bracket may be `width`·|x| wide. Where it stays inside [lower, upper] and values in the scalar's own precision are good
/// enough for it, by a factor of two, no others are asked for. Steps have to shrink fast then: seen from afar a pair of roots
/// is a double root, to which steps lead by a third each, and what is left is half of the last.
#[inline]
pub(super) fn crossing<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    (lower, upper): (S, S),
    rising: bool,
    start: S,
    width: &S,
) -> Root<S> {
    let half_way = S::one().mul_pow2(-(S::BITS / 2).cast_signed());
    let resolution = S::unit_roundoff().half();
    let mut x = if lower < start && start < upper { start } else { S::midpoint(&lower, &upper) };
    let mut previous = upper.clone() - &lower;
    let (mut is_converging, mut is_precise) = (false, false);
    let mut found = None;
    for _ in 0..S::BITS {
        let (plain, slope, bend) = p.jet(&x);
        let value = if is_precise { twofold::value(p, &x) } else { plain };
        let step = quick_halley(&value, &slope, &bend);
        let next = x.clone() - &step;
        let step = step.abs();
        let size = next.clone().abs();
        let is_finest = step <= size.clone() * &resolution.clone().mul_pow2(2);
        if !(lower <= next && next <= upper && (is_finest || step.clone().twice() <= previous)) {
            break;
        }
        x = next;
        // What is left is step³/previous², a quotient that is not waited for: products are compared. Where they underflow to 0 neither
        // is less than the other, and another step is taken.
        let (cube, before) = (step.clone().square() * &step, previous.clone().square());
        if is_precise {
            // step³/previous² + wobble·step/|slope| < size·resolution, the wobble being 2N²u·Σ|aⱼ||x|ʲ/|x|, without divisions
            let magnitude = p.magnitude(&x);
            let scale = slope.clone().abs() * &size;
            let unsure = wobble::<S, N>() * &magnitude * &step * &before;
            let allowed = scale.clone() * &size * &resolution * &before;
            if is_finest || cube * &scale + &unsure < allowed {
                found = keeps_digits(&slope, &size).then(|| (x.clone(), slope, magnitude));
                break;
            }
            previous = step;
        } else {
            let wide = size.clone() * width;
            let is_fast = is_converging && step.clone().mul_pow2(4) <= previous;
            let is_plain = is_fast && !wide.is_zero() && is_good_for(p, &wide, &x, &slope, &step);
            if is_plain && cube.clone().mul_pow2(3) < wide.clone() * &before {
                let half = wide.half();
                let (left, right) = (x.clone() - &half, x.clone() + &half);
                if lower < left && right < upper {
                    return Root { lower: left, upper: right, value: x, kind: RootKind::Simple };
                }
            }
            let least = size * &half_way;
            is_precise = is_finest || (is_converging && !is_plain && cube <= least.clone() * &before);
            previous = if is_precise { step.max(least) } else { step };
        }
        is_converging = true;
    }
    let (x, slope, magnitude) = found.unwrap_or_else(|| {
        let precise = |x: &S| {
            let (_, slope, bend) = p.jet(x);
            (twofold::value(p, x), slope, bend)
        };
        // The slope is not as good as the value where roots are close: nothing less than a last step below the resolution
        // will do.
        let zero = narrowing(precise, lower.clone(), upper.clone(), rising, x, |_| S::zero());
        let magnitude = p.magnitude(&zero.x);
        (zero.x, zero.slope, magnitude)
    });
    let radius = spread::<S, N>(&x, &slope, &magnitude);
    Root {
        lower: lower.max(x.clone() - &radius),
        upper: upper.min(x.clone() + &radius),
        value: x,
        kind: RootKind::Simple,
    }
}

/// What plain values leave of a step of Halley's that led to x is an eighth of this width at most: 2Nu·Σ|aⱼ||x|ʲ/|p'| from the
/// value and, with a step below |x|/N, no more from the slope.
#[inline]
fn is_good_for<S: Scalar, const N: usize>(p: &Polynomial<S, N>, width: &S, x: &S, slope: &S, step: &S) -> bool {
    let n = S::int(i32::try_from(N).unwrap_or(i32::MAX));
    let size = x.clone().abs();
    let noise = p.magnitude(x) * &(n.clone() * &S::unit_roundoff()).mul_pow2(5);
    keeps_digits(slope, &size) && n * step <= size && noise <= slope.clone().abs() * width
}

/// The products in a last step of Halley's, p·p' and p'², lose no digits that matter at the lower end of the scalar's range.
#[inline]
fn keeps_digits<S: Scalar>(slope: &S, size: &S) -> bool {
    let product = slope.clone().square() * size;
    !product.mul_pow2(-(2 * S::BITS).cast_signed()).is_zero()
}

/// 2N²u: times the magnitude, divided by |x|, what p'(x) may be off by.
#[inline]
fn wobble<S: Scalar, const N: usize>() -> S {
    let n = i32::try_from(2 * N * N).unwrap_or(i32::MAX);
    S::int(n) * &S::unit_roundoff()
}

/// What a simple root may be off by: one unit in the last place of x (1.4u|x| comes to that, rounded), and what values in
/// twice the precision leave.
#[inline]
pub(super) fn spread<S: Scalar, const N: usize>(x: &S, slope: &S, magnitude: &S) -> S {
    let slope = slope.clone().abs();
    if slope.is_zero() {
        return S::infinity();
    }
    let rest = twofold::residue::<S, N>() * magnitude / &slope;
    (rest + &(x.clone().abs() * &S::ratio(7, 5))) * &S::unit_roundoff()
}

/// Appends the roots of p on a piece, simple ones in brackets of `width`·|x| if they may be so wide. Where coefficients are known better than [`Given::Rounded`] this is the closer look at a
/// cluster, which takes no other.
#[inline]
pub(super) fn search<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    piece: Piece<S, N>,
    given: Given,
    width: &S,
    roots: &mut Roots<S, N>,
) {
    isolate(p, piece, given, |isolated| match isolated.found {
        Found::One(start) => {
            let ends = (isolated.lower, isolated.upper);
            push(roots, crossing(p, ends, isolated.after > 0, start, width));
        }
        Found::Cluster(count) if given == Given::Rounded => cluster(p, &isolated, count, roots),
        Found::Cluster(count) => push(roots, group(p, &isolated, count)),
    });
}

/// Roots that isolation could not tell apart: one cluster, or after a closer look several findings.
#[cold]
fn cluster<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    isolated: &Isolated<S>,
    count: usize,
    roots: &mut Roots<S, N>,
) {
    let Isolated { lower, upper, before, after, .. } = isolated;
    let together = group(p, isolated, count);
    let is_simple = together.kind == RootKind::Simple;
    let is_sure = is_simple && *before != 0 && *after != 0;
    if lower >= upper || is_sure {
        return push(roots, together);
    }
    let mut apart = closer(p, lower, upper, Given::Exactly);
    let seen: usize = apart.iter().map(|root| usize::from(root.kind.multiplicity())).sum();
    if is_simple && seen <= 1 {
        return push(roots, together);
    }
    let radius = attainable(p, &together.value, upper.clone() - lower);
    let (from, to) = (together.value.clone() - &radius, together.value.clone() + &radius);
    let are_near = apart.iter().all(|root| from <= root.lower && root.upper <= to);
    let is_one = !is_simple && !apart.is_empty() && are_near;
    if !is_one && seen < usize::from(together.kind.multiplicity()) {
        apart = closer(p, lower, upper, Given::Once);
    }
    if is_one || apart.is_empty() {
        let (lower, upper) = (lower.clone().max(from), upper.clone().min(to));
        push(roots, Root { lower, upper, ..together });
    } else {
        apart.iter().for_each(|root| push(roots, root.clone()));
    }
}

/// What is in a bracket for coefficients known better.
fn closer<S: Scalar, const N: usize>(p: &Polynomial<S, N>, lower: &S, upper: &S, given: Given) -> Roots<S, N> {
    let mut found = Roots::new();
    search(p, Piece::seated(p, lower.clone(), upper.clone(), given), given, &S::zero(), &mut found);
    found
}

/// Two attainable errors at x, rounded down by up to a quarter; `most` if it is less.
fn attainable<S: Scalar, const N: usize>(p: &Polynomial<S, N>, x: &S, most: S) -> S {
    let allowed = S::unit_roundoff() * &p.magnitude(x);
    let c = twofold::taylor(p, x).coefficients;
    let mut radius = most;
    for _ in 0..8 * S::BITS {
        let half = radius.clone().half();
        let mut power = S::one();
        let fits = c.iter().skip(1).all(|c| {
            power = power.clone() * &half;
            c.clone().abs() * &power <= allowed
        });
        if fits {
            break;
        }
        radius = radius * &S::ratio(3, 4);
    }
    radius
}

/// Roots too close to be told apart: how many, where, crossing or touching.
fn group<S: Scalar, const N: usize>(p: &Polynomial<S, N>, isolated: &Isolated<S>, count: usize) -> Root<S> {
    let Isolated { lower, upper, before, after, .. } = isolated;
    let centre = S::midpoint(lower, upper);
    let degree = p.degree().unwrap_or(0).max(1);
    let reach = (upper.clone() - lower) * &S::ratio(3, 4);
    let parity_known = *before != 0 && *after != 0;
    // At an end of the interval only some of a cluster may be seen from inside.
    let is_counted = count > 0 && parity_known;
    let (mut x, mut k) = (centre, if is_counted { count } else { 0 });
    if !is_counted {
        // too small a guess still leads to the middle of a multiple root, from where its order shows better
        for _ in 0..ROUNDS {
            let seen = dominant(p, &x, &reach).max(count);
            if seen == k {
                break;
            }
            k = seen;
            x = mean(p, lower, upper, x, k);
        }
    }
    if parity_known && (before != after) != (k % 2 == 1) {
        k = if k < degree { k + 1 } else { k.saturating_sub(1) };
    }
    let k = k.clamp(1, degree);
    let x = mean(p, lower, upper, x, k);
    if k == 1 && parity_known {
        return crossing(p, (lower.clone(), upper.clone()), *after > 0, x, &S::zero());
    }
    let kind = match k {
        1 => RootKind::Simple,
        2 if parity_known => RootKind::Even,
        3 if parity_known => RootKind::Odd,
        _ => RootKind::Cluster(u8::try_from(k).unwrap_or(u8::MAX)),
    };
    if k == 1 {
        let root = at_end(p, lower, upper, x);
        let is_inside = *lower < root.lower && root.upper < *upper;
        if !is_inside || twofold::sign(p, &root.lower) * twofold::sign(p, &root.upper) < 0 {
            return root;
        }
        let kind = RootKind::Cluster(u8::try_from(degree.min(2)).unwrap_or(1));
        return Root { value: root.value, lower: lower.clone(), upper: upper.clone(), kind };
    }
    Root { value: x, lower: lower.clone(), upper: upper.clone(), kind }
}

/// A simple root at an end of the interval asked for, perhaps just outside of it: then its place is that end.
fn at_end<S: Scalar, const N: usize>(p: &Polynomial<S, N>, lower: &S, upper: &S, start: S) -> Root<S> {
    let mut x = start;
    let mut slope = S::zero();
    for _ in 0..ROUNDS {
        slope = p.eval_with_derivative(&x).1;
        if slope.is_zero() {
            break;
        }
        x = (x.clone() - &(twofold::value(p, &x) / &slope)).clamp(lower.clone(), upper.clone());
    }
    let radius = spread::<S, N>(&x, &slope, &p.magnitude(&x));
    let (lower, upper) = (lower.clone().max(x.clone() - &radius), upper.clone().min(x.clone() + &radius));
    Root { value: x, lower, upper, kind: RootKind::Simple }
}

/// The order k ≥ 1 whose Taylor term is largest at this distance from a point: about a k-fold root the k-th leads, from a
/// point beside it perhaps a lower one.
fn dominant<S: Scalar, const N: usize>(p: &Polynomial<S, N>, at: &S, distance: &S) -> usize {
    let mut best = (1, S::zero());
    let mut power = S::one();
    for (k, c) in twofold::taylor(p, at).coefficients.into_iter().enumerate().skip(1) {
        power = power * distance;
        let term = c.abs() * &power;
        if term > best.1 {
            best = (k, term);
        }
    }
    best.0
}

/// The root of the (k−1)-st derivative in [lower, upper], by Newton's method held there.
///
/// Of more than k roots it is a multiple one: derivatives in twice the precision, and an end where steps do not shrink any
/// more, keep the method from being thrown out by its own noise there.
fn mean<S: Scalar, const N: usize>(p: &Polynomial<S, N>, lower: &S, upper: &S, start: S, k: usize) -> S {
    let mut x = start;
    let order = S::int(i32::try_from(k).unwrap_or(1));
    let resolution = S::unit_roundoff().twice();
    let mut previous = S::infinity();
    for _ in 0..S::BITS {
        let c = twofold::taylor(p, &x).coefficients;
        let (Some(value), Some(slope)) = (c.get(k - 1), c.get(k)) else { break };
        if slope.is_zero() {
            break;
        }
        let next = (x.clone() - &(value.clone() / &(slope.clone() * &order))).clamp(lower.clone(), upper.clone());
        let moved = (next.clone() - &x).abs();
        if moved >= previous {
            break;
        }
        x = next;
        if moved <= x.clone().abs() * &resolution {
            break;
        }
        previous = moved;
    }
    x
}
