//! Straight segments: projection and distance.

use super::Point;
use crate::scalar::Scalar;

/// The parameter in [0, 1] of the point of the segment a–b nearest to p, and that point. A segment of length zero answers
/// with its start.
#[inline]
pub fn project_to_segment<S: Scalar>(p: &Point<S>, a: &Point<S>, b: &Point<S>) -> (S, Point<S>) {
    let ab = b.minus(a);
    let along = p.minus(a).dot(&ab);
    let length_sq = ab.norm_sq();
    if along <= S::zero() {
        return (S::zero(), a.clone());
    }
    if along >= length_sq {
        return (S::one(), b.clone());
    }
    let t = along / &length_sq;
    let q = a.plus_scaled(&t, &ab);
    (t, q)
}

/// Squared distance from p to the segment a–b.
#[inline]
pub fn distance_sq_to_segment<S: Scalar>(p: &Point<S>, a: &Point<S>, b: &Point<S>) -> S {
    let (_, q) = project_to_segment(p, a, b);
    p.distance_sq(&q)
}
