//! Refinement of isolated roots.
//!
//! A root with a change of sign is finished by Newton's method inside its bracket; the bracket returned is the
//! isolating one cut to the root's own uncertainty.
//!
//! A k-fold root is ill-conditioned, but the root of the (k−1)-st derivative inside its bracket is simple; it is the
//! mean of the cluster up to second order, and it is what is returned as the value.

use super::isolate::{Found, Isolated};
use super::newton::{Zero, in_bracket};
use super::{Polynomial, Root, RootKind};
use crate::scalar::Scalar;

/// Rounds of looking for the order and the middle of a cluster.
const ROUNDS: usize = 4;

/// The root or cluster in an isolated bracket.
#[inline]
pub(super) fn refine<S: Scalar, const N: usize>(p: &Polynomial<S, N>, isolated: Isolated<S>) -> Root<S> {
    match isolated.found {
        Found::One(start) => crossing(p, isolated.lower, isolated.upper, isolated.after > 0, start),
        Found::Cluster(count) => cluster(p, &isolated, count),
    }
}

/// The one root in [lower, upper], where p changes its sign; `rising`: from − to +.
#[inline]
fn crossing<S: Scalar, const N: usize>(p: &Polynomial<S, N>, lower: S, upper: S, rising: bool, start: S) -> Root<S> {
    let Zero { x, slope } = in_bracket(|x| p.eval_with_derivative(x), lower.clone(), upper.clone(), rising, start);
    let radius = spread(p, &x, &slope);
    Root {
        lower: lower.max(x.clone() - &radius),
        upper: upper.min(x.clone() + &radius),
        value: x,
        kind: RootKind::Simple,
    }
}

/// How far rounding may move a simple root: twice the noise of p over its slope, and the resolution of x.
#[inline]
fn spread<S: Scalar, const N: usize>(p: &Polynomial<S, N>, x: &S, slope: &S) -> S {
    let slope = slope.clone().abs();
    let ulps = S::unit_roundoff().mul_pow2(2);
    if slope.is_zero() {
        return S::infinity();
    }
    let noise = S::int(i32::try_from(N).unwrap_or(i32::MAX)) * &p.magnitude(x);
    (noise / &slope + &x.clone().abs()) * &ulps
}

/// Roots too close to be told apart: how many, where, crossing or touching.
#[cold]
fn cluster<S: Scalar, const N: usize>(p: &Polynomial<S, N>, isolated: &Isolated<S>, count: usize) -> Root<S> {
    let Isolated { lower, upper, before, after, .. } = isolated;
    let centre = S::midpoint(lower, upper);
    let degree = p.degree().unwrap_or(0).max(1);
    let reach = (upper.clone() - lower) * &S::ratio(3, 4);
    let (mut x, mut k) = (centre, count);
    if count == 0 {
        // too small a guess still leads to the middle of a multiple root, from where its order shows better
        for _ in 0..ROUNDS {
            let seen = dominant(p, &x, &reach);
            if seen == k {
                break;
            }
            k = seen;
            x = mean(p, lower, upper, x, k);
        }
    }
    let parity_known = *before != 0 && *after != 0;
    if !parity_known {
        // at an end of the interval only some of a cluster may be seen from inside
        k = k.max(dominant(p, &x, &reach));
    }
    if parity_known && (before != after) != (k % 2 == 1) {
        k = if k < degree { k + 1 } else { k.saturating_sub(1) };
    }
    let k = k.clamp(1, degree);
    let x = mean(p, lower, upper, x, k);
    if k == 1 && parity_known {
        return crossing(p, lower.clone(), upper.clone(), *after > 0, x);
    }
    let kind = match k {
        1 => RootKind::Simple,
        2 if parity_known => RootKind::Even,
        3 if parity_known => RootKind::Odd,
        _ => RootKind::Cluster(u8::try_from(k).unwrap_or(u8::MAX)),
    };
    if k == 1 {
        let (_, slope) = p.eval_with_derivative(&x);
        let radius = spread(p, &x, &slope);
        let lower = lower.clone().max(x.clone() - &radius);
        let upper = upper.clone().min(x.clone() + &radius);
        return Root { value: x, lower, upper, kind };
    }
    Root { value: x, lower: lower.clone(), upper: upper.clone(), kind }
}

/// The order k ≥ 1 whose Taylor term is largest at this distance from a point: about a k-fold root the k-th leads, from a
/// point beside it perhaps a lower one.
fn dominant<S: Scalar, const N: usize>(p: &Polynomial<S, N>, at: &S, distance: &S) -> usize {
    let mut best = (1, S::zero());
    let mut power = S::one();
    for (k, c) in p.taylor(at).coefficients.into_iter().enumerate().skip(1) {
        power = power * distance;
        let term = c.abs() * &power;
        if term > best.1 {
            best = (k, term);
        }
    }
    best.0
}

/// The root of the (k−1)-st derivative in [lower, upper], by Newton's method held there.
fn mean<S: Scalar, const N: usize>(p: &Polynomial<S, N>, lower: &S, upper: &S, start: S, k: usize) -> S {
    let mut x = start;
    let order = S::int(i32::try_from(k).unwrap_or(1));
    let resolution = S::unit_roundoff().twice();
    for _ in 0..S::BITS {
        let c = p.taylor(&x).coefficients;
        let (Some(value), Some(slope)) = (c.get(k - 1), c.get(k)) else { break };
        if slope.is_zero() {
            break;
        }
        let next = (x.clone() - &(value.clone() / &(slope.clone() * &order))).clamp(lower.clone(), upper.clone());
        let moved = (next.clone() - &x).abs();
        x = next;
        if moved <= x.clone().abs() * &resolution {
            break;
        }
    }
    x
}
