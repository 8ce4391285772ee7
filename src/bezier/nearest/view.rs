//! A cubic seen from a query point: squared distances and their derivatives, from the curve itself.

use crate::bezier::PowerBasis;
use crate::geometry::{Point, Vector};
use crate::scalar::Scalar;

/// A cubic B and a query q; F(t) = |B(t) − q|², g = F'/2 = (B − q)·B'.
pub(super) struct View<'b, S> {
    /// B.
    pub(super) basis: &'b PowerBasis<S>,
    /// B(0) − q.
    pub(super) offset: Vector<S>,
}

impl<'b, S: Scalar> View<'b, S> {
    /// q and the curve must have finite coordinates, with finite squares of their differences times 50.
    #[inline]
    pub(super) fn new(basis: &'b PowerBasis<S>, q: &Point<S>) -> Self {
        Self { basis, offset: basis.origin.minus(q) }
    }

    /// B(t) − q.
    #[inline]
    pub(super) fn away(&self, t: &S) -> Vector<S> {
        let [a1, a2, a3] = &self.basis.a;
        self.offset.plus_scaled(t, &a1.plus_scaled(t, &a2.plus_scaled(t, a3)))
    }

    /// F(t).
    #[inline]
    pub(super) fn distance_sq(&self, t: &S) -> S {
        self.away(t).norm_sq()
    }

    /// B − q, B' and B''/2 at t.
    #[inline]
    pub(super) fn jet(&self, t: &S) -> (Vector<S>, Vector<S>, Vector<S>) {
        let [a1, a2, a3] = &self.basis.a;
        let bend = a2.plus_scaled(t, &a3.scaled(&S::int(3)));
        let velocity = a1.plus_scaled(t, &a2.plus(&bend));
        (self.away(t), velocity, bend)
    }

    /// g(t), g'(t) and g''(t)/2 from the curve itself: their errors are those of B(t) − q and B'(t), much smaller than those of
    /// the quintic's coefficients where the curve is slow or q is near.
    #[inline]
    pub(super) fn slope(&self, t: &S) -> (S, S, S) {
        let [_, _, a3] = &self.basis.a;
        let (away, velocity, bend) = self.jet(t);
        let change = velocity.norm_sq() + &away.dot(&bend).twice();
        (away.dot(&velocity), change, (velocity.dot(&bend) + &away.dot(a3)) * &S::int(3))
    }
}
