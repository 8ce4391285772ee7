//! Joints: where ends of segments meet.
//!
//! The ends that meet in one point form a circular list. A joint of one end is open; of two ends it is smooth or a corner;
//! of three or more it is a corner (a junction). Lists carry no geometry but the unit direction in which each end's branch
//! leaves the joint: that is all that fans, cones and walks around the curve need.

use super::Segment;
use crate::geometry::Vector;
use crate::scalar::Scalar;

/// One end of one segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct EndId(u32);

impl EndId {
    /// The end at t = 0 (side 0) or t = 1 (side 1) of a segment.
    #[inline]
    pub const fn new(segment: u32, side: usize) -> Self {
        let side = if side & 1 == 0 { 0 } else { 1 };
        Self(segment << 1 | side)
    }

    /// The segment.
    #[inline]
    pub const fn segment(self) -> u32 {
        self.0 >> 1
    }

    /// 0 for the end at t = 0, 1 for the end at t = 1.
    #[inline]
    pub const fn side(self) -> usize {
        (self.0 & 1) as usize
    }

    /// The other end of the same segment.
    #[inline]
    pub const fn opposite(self) -> Self {
        Self(self.0 ^ 1)
    }
}

/// How the curve passes a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum JointKind {
    /// An end of an open path that nothing else meets: an ordinary point with a half circle of tangent disks.
    #[default]
    Open,
    /// Two ends with one tangent line: C is tangent-continuous.
    Smooth,
    /// Everything else: a turn, a junction, a retracted handle, a cusp. The local feature size is 0 there.
    Corner,
}

/// One end's part of a joint.
#[derive(Clone, Copy, Debug, Default)]
pub struct JointEnd<S> {
    /// The joint's kind, the same for all its ends.
    pub kind: JointKind,
    /// The next end of the joint's circular list; the end itself where it is alone.
    pub next: EndId,
    /// Unit direction in which the branch leaves the joint.
    pub leaving: Vector<S>,
    /// The derivative vanishes here (a retracted handle): curvature without bound.
    pub retracted: bool,
}

/// Walks a circular list once, `first` first. `next` follows the list; a list that is broken ends the walk.
pub(super) fn members(first: EndId, next: impl Fn(EndId) -> Option<EndId>) -> impl Iterator<Item = EndId> {
    core::iter::successors(Some(first), move |&e| next(e).filter(|&n| n != first))
}

/// An end by its number.
pub(super) fn end_ref<S>(segments: &[Segment<S>], e: EndId) -> Option<&JointEnd<S>> {
    segments.get(e.segment() as usize).and_then(|s| s.ends.get(e.side()))
}

/// An end by its number, to change.
pub(super) fn end_mut<S>(segments: &mut [Segment<S>], e: EndId) -> Option<&mut JointEnd<S>> {
    segments.get_mut(e.segment() as usize).and_then(|s| s.ends.get_mut(e.side()))
}

/// The ends of a joint, this one first.
pub(super) fn members_of<S>(segments: &[Segment<S>], e: EndId) -> impl Iterator<Item = EndId> + '_ {
    members(e, |e| end_ref(segments, e).map(|end| end.next))
}

/// Compares directions by how far one must turn clockwise (from left over ahead to right) from a reference direction.
///
/// Returns a number that grows with that angle over (0°, 360°]; the direction of the reference itself counts as the full
/// turn. Only dot and cross products are used: an angle θ maps to a monotone function of θ, not to θ.
pub(crate) fn clockwise_rank<S: Scalar>(reference: &Vector<S>, direction: &Vector<S>) -> S {
    let dot = reference.dot(direction);
    let cross = direction.cross(reference);
    // cross > 0: less than half a turn clockwise, where 1 − dot grows from 0 to 2.
    if cross > S::zero() || (cross.is_zero() && dot < S::zero()) { S::one() - &dot } else { S::int(3) + &dot }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rank_grows_clockwise() {
        let reference = Vector::new(1.0_f64, 0.0);
        // Clockwise from the reference: left of it is (−y, x), so clockwise goes through negative y.
        let ranks: [f64; 8] = core::array::from_fn(|k| {
            let angle = -core::f64::consts::FRAC_PI_4 * (k as f64 + 1.0);
            clockwise_rank(&reference, &Vector::new(angle.cos(), angle.sin()))
        });
        assert!(ranks.windows(2).all(|w| w[0] < w[1]), "{ranks:?}");
    }
}
