//! Foot points: the pairs (f, d) that make the whole medial axis.
//!
//! Paper, section 3.1, walks along the curve and takes the normal on both sides. The complete *foot set* has more: at an
//! open end a half circle of directions, at a corner a cone of them, and corners themselves. It is all pairs (f, d), d a unit
//! vector with d·u ≤ 0 for the direction u of every branch that leaves f. It is complete: if m has nearest points p ≠ q,
//! then d = (m−p)/|m−p| is in p's cone and m = p + r(p, d)·d, where r is the radius of the largest empty tangent disk.

use crate::curve::{Curve, CurveParam, EndId};
use crate::geometry::{Point, Vector};
use crate::scalar::Scalar;

/// Which kind of foot a medial point stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The normal (−B'y, B'x) at a point of a segment.
    Left,
    /// The opposite normal.
    Right,
    /// A direction between the normals at an open end or on the outer side of a corner.
    Fan,
    /// A corner, crossing or cusp itself, with m = f and radius 0.
    Corner,
}

impl Side {
    /// The other side of a segment.
    const fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
            other => other,
        }
    }
}

impl core::fmt::Display for Side {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Left => "left",
            Self::Right => "right",
            Self::Fan => "fan",
            Self::Corner => "corner",
        })
    }
}

/// A foot point with a direction: a tangent disk stands on f, its centre lies in direction d. Made by [`Foot::normal`] and
/// [`Foot::fan`], and always on an obstacle, never on a twin.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Foot<S> {
    /// Where on C; for a fan the end that it belongs to.
    pub at: CurveParam<S>,
    /// The point f.
    pub point: Point<S>,
    /// The unit vector d.
    pub direction: Vector<S>,
    /// Length of B' at f, for the divided form; 0 for fans and retracted ends, which do not use it.
    pub speed: S,
    /// Which kind.
    pub side: Side,
    /// The joint that f stands on, if f is an end of its segment.
    pub end: Option<EndId>,
}

impl<S: Scalar> Foot<S> {
    /// The foot at a place on C with the normal to the left or to the right; `None` if there is no such place. On a twin it is
    /// the same foot on the segment that stands for it: only that one is an obstacle.
    pub fn normal(curve: &Curve<'_, S>, at: CurveParam<S>, side: Side) -> Option<Self> {
        match curve.segment(at.segment)?.twin {
            Some(twin) => {
                let side = if twin.reversed() { side.opposite() } else { side };
                Self::on_obstacle(curve, twin.place(at.t), side)
            }
            None => Self::on_obstacle(curve, at, side),
        }
    }

    /// [`Foot::normal`] on a segment that is no twin.
    pub(super) fn on_obstacle(curve: &Curve<'_, S>, at: CurveParam<S>, side: Side) -> Option<Self> {
        let segment = curve.segment(at.segment)?;
        let end = if at.t <= S::zero() {
            Some(EndId::new(at.segment, 0))
        } else if at.t >= S::one() {
            Some(EndId::new(at.segment, 1))
        } else {
            None
        };
        let normal = segment.tangent(&at.t).left();
        let direction = if side == Side::Right { normal.opposite() } else { normal };
        let speed = segment.power.derivative(&at.t).norm();
        Some(Self { point: segment.point(&at.t), at, direction, speed, side, end })
    }

    /// The foot at an end of a segment with a given unit direction; on a twin as in [`Foot::normal`].
    pub fn fan(curve: &Curve<'_, S>, end: EndId, direction: Vector<S>) -> Option<Self> {
        let twin = curve.segment(end.segment())?.twin;
        Self::fan_of_obstacle(curve, twin.map_or(end, |twin| twin.end(end.side())), direction)
    }

    /// [`Foot::fan`] on a segment that is no twin.
    pub(super) fn fan_of_obstacle(curve: &Curve<'_, S>, end: EndId, direction: Vector<S>) -> Option<Self> {
        let t = if end.side() == 0 { S::zero() } else { S::one() };
        let point = curve.end_point(end)?.clone();
        let at = CurveParam { segment: end.segment(), t };
        Some(Self { at, point, direction, speed: S::zero(), side: Side::Fan, end: Some(end) })
    }
}
