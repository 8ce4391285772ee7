//! The closest point of a cubic (paper, Section 7.1).
//!
//! F(t) = |B(t) − q|² has degree 6; its minimum over an interval is at an end or where the quintic
//! g = F'/2 = (B − q)·B' changes from − to +. All critical points are the roots of g ([`critical_points`]), but for the
//! closest one most need not be found. A `survey` of nine places leads to a candidate, and a quartic that is positive proves
//! that nothing is closer; where it does not, and on parts of a cubic, `branch` and bound in the Bernstein form of g answers.
//!
//! **Accuracy.** The returned `distance_sq` is |B(t) − q|² for the returned t as evaluated. It exceeds the true minimum by
//! at most a few roundings of itself plus the square of the rounding error of B(t), in relation to the size of B − q on
//! the curve: pruning allows for the noise of the lower bound.
//!
//! Coordinates must be finite and so must the squares of their differences, times 50; the curve's door sees to it.

mod branch;
mod survey;
mod view;

use super::hull::hull_keeps_away;
use super::{Cubic, PowerBasis};
use crate::geometry::Point;
use crate::polynomial::Polynomial;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// A closest point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest<S> {
    /// Parameter on the cubic, in the interval asked for.
    pub t: S,
    /// B(t).
    pub point: Point<S>,
    /// |B(t) − q|², in squared user units.
    pub distance_sq: S,
}

/// The quintic (B − q)·B', half the derivative of the squared distance, in powers of t.
#[inline]
pub fn distance_quintic<S: Scalar>(b: &PowerBasis<S>, q: &Point<S>) -> Polynomial<S, 6> {
    let v = b.origin.minus(q);
    let [a1, a2, a3] = &b.a;
    let three = S::int(3);
    Polynomial::new([
        v.dot(a1),
        v.dot(a2).twice() + &a1.norm_sq(),
        (v.dot(a3) + &a1.dot(a2)) * &three,
        a1.dot(a3).mul_pow2(2) + &a2.norm_sq().twice(),
        a2.dot(a3) * &S::int(5),
        a3.norm_sq() * &three,
    ])
}

/// All parameters in [0, 1] where the distance from q is stationary, ascending: minima, maxima and flat points, up to the
/// attainable error of [`Polynomial::roots_in_unit`]. None where every parameter is stationary (a cubic that is a point).
pub fn critical_points<S: Scalar>(b: &PowerBasis<S>, q: &Point<S>) -> ArrayVec<S, 5> {
    let roots = distance_quintic(b, q).roots_in_unit().unwrap_or_default();
    roots.into_iter().take(5).map(|r| r.value).collect()
}

/// The closest point to q with parameter in [0, 1]; among equally close ones, any.
#[inline]
pub fn nearest<S: Scalar>(b: &PowerBasis<S>, q: &Point<S>) -> Nearest<S> {
    survey::proved(b, q).unwrap_or_else(|| branch::on_unit(b, q))
}

/// The closest point to q with parameter in [t0, t1] ⊂ [0, 1]; where t0 ≥ t1, the point at t0.
pub fn nearest_between<S: Scalar>(b: &PowerBasis<S>, q: &Point<S>, t0: &S, t1: &S) -> Nearest<S> {
    branch::between(b, q, t0, t1)
}

/// The closest point to q on any of the cubics that is closer than `bound_sq` (squared; pass infinity for no bound), with
/// the index of its cubic; `None` if there is none. The first of equally close ones wins.
///
/// Cubics whose hull is known to keep away from the best so far are not solved.
pub fn nearest_of<'c, S: Scalar + 'c>(
    cubics: impl IntoIterator<Item = &'c Cubic<S>>,
    q: &Point<S>,
    bound_sq: S,
) -> Option<(usize, Nearest<S>)> {
    let mut best = None;
    let mut bound = bound_sq;
    for (i, cubic) in cubics.into_iter().enumerate() {
        if hull_keeps_away(cubic, q, &bound) {
            continue;
        }
        let found = nearest(&cubic.power_basis(), q);
        if found.distance_sq < bound {
            bound = found.distance_sq.clone();
            best = Some((i, found));
        }
    }
    best
}
