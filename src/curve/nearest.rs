//! The point of C nearest to a point of the plane, over all of it or over its non-local part.
//!
//! Over one arc the squared distance has one minimum inside at most unless the point lies near the arc's centres of
//! curvature, where the minima it could confuse differ by less than the tolerance of any caller here (the exact answer for
//! one cubic is [`crate::bezier`]'s closest point through the quintic). The search is a branch and bound over the
//! hierarchy, nearest boxes first: O(log n) for drawings as people make them.

use super::{Arc, Curve, CurveParam, Segment};
use crate::bezier::newton::falling_zero;
use crate::geometry::Point;
use crate::scalar::Scalar;

/// A point of C near some point of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearPoint<S> {
    /// Where on C.
    pub at: CurveParam<S>,
    /// The point there.
    pub point: Point<S>,
    /// Its squared distance.
    pub distance_sq: S,
}

/// A place on a strand, to tell what is local to it.
#[derive(Clone, Copy, Debug)]
pub struct Locality<S> {
    strand: u32,
    turn: S,
    loop_turn: S,
}

impl<S: Scalar> Locality<S> {
    /// The locality of the point at t of an arc.
    pub fn on_arc(segment: &Segment<S>, arc: &Arc<S>, t: &S) -> Self {
        let [start, end] = &arc.turn;
        let covered = segment.tangent(&arc.span[0]).minus(&segment.tangent(t)).norm();
        let turn = if end >= start { covered + start } else { start.clone() - &covered };
        Self { strand: segment.strand, turn, loop_turn: segment.loop_turn.clone() }
    }

    /// The locality of a place on the curve; `None` if there is no such place.
    pub fn of(curve: &Curve<'_, S>, at: &CurveParam<S>) -> Option<Self> {
        let segment = curve.segment(at.segment)?;
        let (first, count) = segment.arcs;
        let starts = curve.arcs.get(first as usize..)?.get(..count as usize)?;
        // The first arc that does not end before it.
        let later = starts.get(1..)?.partition_point(|a| a.t < at.t);
        let arc = curve.arc(first.saturating_add(u32::try_from(later).ok()?))?;
        Some(Self::on_arc(segment, &arc, &at.t))
    }

    /// Less than one radian of turning, along one strand, lies between this place and some point of the arc.
    #[inline]
    pub fn holds(&self, segment: &Segment<S>, arc: &Arc<S>) -> bool {
        if segment.strand != self.strand {
            return false;
        }
        let [a, b] = &arc.turn;
        let (low, high) = if a < b { (a, b) } else { (b, a) };
        let gap = |t: S| (low.clone() - &t).max(t - high);
        gap(self.turn.clone()) < S::one()
            || (self.loop_turn > S::zero()
                && (gap(self.turn.clone() + &self.loop_turn) < S::one()
                    || gap(self.turn.clone() - &self.loop_turn) < S::one()))
    }
}

/// The point of one arc nearest to p.
pub fn nearest_on_arc<S: Scalar>(segment: &Segment<S>, arc: &Arc<S>, p: &Point<S>) -> NearPoint<S> {
    let [from, to] = &arc.span;
    // Half the derivative of the squared distance, negated, and its derivative.
    let fall = |t: &S| {
        let v = segment.power.eval(t).minus(p);
        let d = segment.power.derivative(t);
        let dd = segment.power.second_derivative(t);
        (-v.dot(&d), -(d.norm_sq() + &v.dot(&dd)))
    };
    let near = |t: S| {
        let point = segment.point(&t);
        let distance_sq = point.distance_sq(p);
        NearPoint { at: CurveParam { segment: arc.segment, t }, point, distance_sq }
    };
    let [start, end] = arc.moving(segment);
    let (f0, f1) = (fall(&start).0, fall(&end).0);
    let (a, b) = (near(from.clone()), near(to.clone()));
    let ends = if b.distance_sq < a.distance_sq { b } else { a };
    if f0 > S::zero() && f1 < S::zero() {
        let width = S::unit_roundoff() * &S::int(4);
        let inner = near(falling_zero(start, end, &width, &fall));
        if inner.distance_sq < ends.distance_sq {
            return inner;
        }
    }
    ends
}

/// The point of C nearest to p, if it is nearer than `limit_sq` (a squared distance; infinity for any).
pub fn nearest<S: Scalar>(curve: &Curve<'_, S>, p: &Point<S>, limit_sq: S) -> Option<NearPoint<S>> {
    nearest_where(curve, p, limit_sq, |_, _| true)
}

/// The point of C nearest to p among what is not local to a place, if it is nearer than `limit_sq`.
pub fn nearest_non_local<S: Scalar>(
    curve: &Curve<'_, S>,
    p: &Point<S>,
    locality: &Locality<S>,
    limit_sq: S,
) -> Option<NearPoint<S>> {
    nearest_beside(curve, p, core::slice::from_ref(locality), limit_sq)
}

/// The point of C nearest to p among what is local to none of some places, if it is nearer than `limit_sq`.
pub fn nearest_beside<S: Scalar>(
    curve: &Curve<'_, S>,
    p: &Point<S>,
    localities: &[Locality<S>],
    limit_sq: S,
) -> Option<NearPoint<S>> {
    nearest_where(curve, p, limit_sq, |segment, arc| !localities.iter().any(|l| l.holds(segment, arc)))
}

fn nearest_where<S: Scalar>(
    curve: &Curve<'_, S>,
    p: &Point<S>,
    limit_sq: S,
    admit: impl Fn(&Segment<S>, &Arc<S>) -> bool,
) -> Option<NearPoint<S>> {
    let mut state: (S, Option<NearPoint<S>>) = (limit_sq, None);
    curve.hierarchy().nearest_first(
        p,
        &mut state,
        |s| s.0.clone(),
        |(bound, best), item| {
            for (_, arc) in curve.arcs_in(item) {
                let Some(segment) = curve.segment(arc.segment) else { return };
                if admit(segment, &arc) {
                    let near = nearest_on_arc(segment, &arc, p);
                    if near.distance_sq < *bound {
                        *bound = near.distance_sq.clone();
                        *best = Some(near);
                    }
                }
            }
        },
    );
    state.1
}
