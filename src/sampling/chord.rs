//! Chord error: how far a stretch of curve strays from the straight segment between its ends.
//!
//! Exact up to rounding: over one cubic the distance from the chord's line is extremal at its ends and where B' is parallel to
//! the chord (a quadratic). Only where the piece reaches beyond the chord's ends can the distance from an end point count:
//! its extrema are roots of the closest-point quintic.

use super::run::{Pos, Run};
use crate::bezier::PowerBasis;
use crate::geometry::{Point, Vector, distance_sq_to_segment};
use crate::polynomial::Polynomial;
use crate::scalar::Scalar;

/// Largest distance of the run between `a` and `b` from the straight segment between these two points.
pub fn chord_error<S: Scalar>(run: &Run<'_, S>, a: &Pos<S>, b: &Pos<S>) -> S {
    let (from, to) = (run.point(a), run.point(b));
    let mut worst = S::zero();
    for k in a.k..=b.k {
        let Some(segment) = run.segment(k) else { break };
        let t0 = if k == a.k { a.t.clone() } else { S::zero() };
        let t1 = if k == b.k { b.t.clone() } else { S::one() };
        let piece = piece_error_sq(&segment.power, &t0, &t1, &from, &to);
        if piece > worst {
            worst = piece;
        }
    }
    worst.sqrt()
}

/// The square of the largest distance of B([t0, t1]) from the segment from–to.
pub fn piece_error_sq<S: Scalar>(power: &PowerBasis<S>, t0: &S, t1: &S, from: &Point<S>, to: &Point<S>) -> S {
    let mut worst = S::zero();
    let chord = to.minus(from);
    let length_sq = chord.norm_sq();
    // Says whether the point lies beyond the chord's ends.
    let mut look = |t: &S| {
        let p = power.eval(t);
        let d = distance_sq_to_segment(&p, from, to);
        if d > worst {
            worst = d;
        }
        let along = p.minus(from).dot(&chord);
        along < S::zero() || along > length_sq
    };
    let mut beyond = look(t0) | look(t1);
    // n·B'(t) = 0 and, for the reach along the chord, c·B'(t) = 0.
    for direction in [chord.left(), chord.clone()] {
        for t in stationary(power, &direction).into_iter().flatten() {
            if t > *t0 && t < *t1 {
                beyond |= look(&t);
            }
        }
    }
    if beyond {
        for end in [from, to] {
            for t in farthest(power, end, t0, t1) {
                look(&t);
            }
        }
    }
    worst
}

/// Real roots of d·B'(t), at most two.
fn stationary<S: Scalar>(power: &PowerBasis<S>, d: &Vector<S>) -> [Option<S>; 2] {
    let [a1, a2, a3] = &power.a;
    let (c, b, a) = (d.dot(a1), d.dot(a2).twice(), d.dot(a3) * &S::int(3));
    let scale = a.clone().abs().max(b.clone().abs()).max(c.clone().abs());
    if scale.is_zero() {
        return [None, None];
    }
    let (a, b, c) = (a / &scale, b / &scale, c / &scale);
    let discriminant = b.clone().square() - &(a.clone() * &c * &S::int(4));
    if discriminant < S::zero() {
        return [None, None];
    }
    // The root of larger size first, the other one from the product of both: no cancellation.
    let root = discriminant.sqrt();
    let q = if b < S::zero() { root - &b } else { -(root + &b) }.half();
    let first = (!a.is_zero()).then(|| q.clone() / &a).filter(Scalar::is_finite);
    let second = (!q.is_zero()).then(|| c / &q).filter(Scalar::is_finite);
    [first, second]
}

/// Inner parameters where the distance from a point is extremal.
fn farthest<S: Scalar>(power: &PowerBasis<S>, p: &Point<S>, t0: &S, t1: &S) -> impl Iterator<Item = S> + use<S> {
    let [a1, a2, a3] = &power.a;
    let a0 = power.origin.minus(p);
    let (two, three) = (S::int(2), S::int(3));
    // (B − p)·B', ascending.
    let polynomial = Polynomial::new([
        a0.dot(a1),
        a1.norm_sq() + &(a0.dot(a2) * &two),
        a1.dot(a2) * &three + &(a0.dot(a3) * &three),
        a1.dot(a3) * &S::int(4) + &(a2.norm_sq() * &two),
        a2.dot(a3) * &S::int(5),
        a3.norm_sq() * &three,
    ]);
    polynomial.roots_inside(t0, t1, &S::zero()).into_iter().flatten().map(|r| r.value)
}
