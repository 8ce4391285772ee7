//! C as another program's door has made it.
//!
//! A plotter's controller that gets lfs from its host needs no door of its own: the host sends the cubics of C, as they are
//! once strokes are snapped, split and smoothed, and says where the corners are. [`segment`] makes a [`Segment`] of each. It
//! serves the sampler ([`crate::sampling`]), which goes along paths from corner to corner; it has no arcs, and its joints
//! name no other ends, so that neither medial axis nor touchings can be computed from it.

use super::{EndId, JointEnd, JointKind, Segment};
use crate::bezier::Cubic;
use crate::geometry::{Aabb, Vector};
use crate::scalar::Scalar;

/// A segment of C from its cubic. `index` is its place in the list, `path` that of its path; `corners` says whether C has a
/// corner where it starts and where it ends.
///
/// Exact but for the cubic's powers and the directions of its ends: a few roundoffs.
pub fn segment<S: Scalar>(index: u32, path: u32, cubic: Cubic<S>, corners: [bool; 2]) -> Segment<S> {
    let mut segment = bare(index, path, cubic);
    for (end, corner) in segment.ends.iter_mut().zip(corners) {
        if corner {
            end.kind = JointKind::Corner;
        }
    }
    segment
}

/// Diagonal and noise of given segments, as [`Curve`](super::Curve) wants them.
#[derive(Clone, Debug, PartialEq)]
pub struct Extent<S> {
    /// Diagonal of the box of all control points.
    pub diagonal: S,
    /// Largest error of a difference of two coordinates: a few roundoffs of the largest one.
    pub noise: S,
}

impl<S: Scalar> Extent<S> {
    /// Of these segments; zero where there are none.
    pub fn of(segments: &[Segment<S>]) -> Self {
        let mut bounds = Aabb::empty();
        for s in segments {
            bounds.merge(&s.cubic.control_box());
        }
        if segments.is_empty() { Self { diagonal: S::zero(), noise: S::zero() } } else { Self::of_box(&bounds) }
    }

    /// Of control points in a box.
    pub(super) fn of_box(bounds: &Aabb<S>) -> Self {
        let Aabb { min, max } = bounds;
        let largest = (min.x.clone().abs().max(max.x.clone().abs())).max(min.y.clone().abs().max(max.y.clone().abs()));
        Self { diagonal: bounds.extent().norm(), noise: largest * &S::unit_roundoff() * &S::int(4) }
    }
}

/// A segment that knows its cubic alone: its ends are open, arcs and strand are still to come.
pub(super) fn bare<S: Scalar>(index: u32, path: u32, cubic: Cubic<S>) -> Segment<S> {
    let end = |side: usize| {
        let (leaving, retracted) = leaving_direction(&cubic, side);
        JointEnd { kind: JointKind::Open, next: EndId::new(index, side), leaving, retracted }
    };
    Segment {
        ends: [end(0), end(1)],
        power: cubic.power_basis(),
        cubic,
        path,
        arcs: (0, 0),
        twin: None,
        strand: u32::MAX,
        loop_turn: S::zero(),
    }
}

/// The unit direction in which a cubic leaves an end, and whether its handle there is retracted.
fn leaving_direction<S: Scalar>(cubic: &Cubic<S>, side: usize) -> (Vector<S>, bool) {
    let [a, b, c, d] = if side == 0 { cubic.points.clone() } else { cubic.reversed().points };
    if let Some(u) = b.minus(&a).unit() {
        return (u, false);
    }
    let u = c.minus(&a).unit().or_else(|| d.minus(&a).unit());
    (u.unwrap_or_else(|| Vector::new(S::one(), S::zero())), true)
}
