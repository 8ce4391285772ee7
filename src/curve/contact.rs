//! Where the curve touches itself: crossings, T-junctions, overlaps.
//!
//! A stretch of curve of length h can meet another, non-local one only if that one comes nearer to its middle than h, and not
//! if a line parts the two (`curve::apart`): so arcs are halved while something non-local may touch, and what is left at the
//! smallest size does. The cost is that of O(log) closest-point searches a contact, and of √(κ/g) for each length along which
//! strokes of curvature κ run side by side with a gap g.
//!
//! A contact is an interval of parameters, since strokes can coincide along a stretch. Straight ones do if two points of one
//! lie on the other, curved ones if ten points of a stretch lie on one other arc: two different cubics have nine in
//! common at most (Bézout). Touching means: nearer than [`reach`], a billionth of the diagonal (or a few roundoffs, where
//! the scalar has fewer bits). Between ten even points that touch, the gap is no more than some twenty times that, the
//! Lebesgue constant of interpolation in them.

use super::apart::Stretch;
use super::nearest::{Locality, nearest_on_arc};
use super::{Arc, Curve, CurveParam, JointKind, Segment};
use crate::buffer::{BufferFull, Keep, Store};
use crate::geometry::Point;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// A stretch of a segment that touches some other part of C.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Contact<S> {
    /// The segment.
    pub segment: u32,
    /// Where the contact starts and ends; the same parameter, nearly, at a crossing.
    pub span: [S; 2],
}

impl<S: Scalar> Contact<S> {
    /// The parameter in its middle.
    pub fn middle(&self) -> S {
        S::midpoint(&self.span[0], &self.span[1])
    }
}

/// How near is touching, in user units.
pub fn reach<S: Scalar>(curve: &Curve<'_, S>) -> S {
    let billionth = S::one() / &S::int(1_000_000_000);
    billionth.max(S::unit_roundoff().mul_pow2(3)) * curve.diagonal
}

/// A contact no longer than this is a point: strokes that cross, or leave a corner, under 13° or more touch for that long.
pub(crate) fn point_length<S: Scalar>(curve: &Curve<'_, S>) -> S {
    reach(curve) * &S::int(8)
}

/// Appends all contacts of one segment, by ascending parameter. Joints are none: what meets there is known, and whoever
/// walks along the curve looks for strokes that pass through one. What leaves a corner together for longer than a point does
/// coincide.
///
/// # Errors
/// [`BufferFull`] where `out` cannot take more.
#[inline(never)]
pub fn find<S: Scalar>(curve: &Curve<'_, S>, segment: u32, out: &mut impl Store<Contact<S>>) -> Result<(), BufferFull> {
    let Some(s) = curve.segment(segment) else { return Ok(()) };
    let finder = Finder { curve, reach: reach(curve), coarse: curve.diagonal.clone() / &S::int(100_000) };
    let first = out.items().len();
    for arc in curve.arcs_of(s) {
        finder.arc(segment, s, &arc, first, out)?;
    }
    finder.settle(s, first, out);
    Ok(())
}

struct Finder<'w, 'c, S> {
    curve: &'w Curve<'c, S>,
    reach: S,
    /// Stretches of this size that touch at both ends and in the middle coincide.
    coarse: S,
}

/// Points of a stretch that must lie on another arc for the two to coincide: one more than two cubics can share.
const WITNESSES: i32 = 10;

/// Arcs that are kept in mind, at most; where more are near, the hierarchy is asked again for every part.
const CANDIDATES: usize = 128;

/// What may touch a stretch of an arc. What may touch a part of it is among them: parts move theirs to the front.
type Candidates = ArrayVec<u32, CANDIDATES>;

/// A stretch of an arc, as its candidates see it.
struct View<S> {
    middle: Point<S>,
    /// Squared distance from the middle beyond which nothing touches.
    limit: S,
    /// What is local to both ends is so to all of it: arcs turn by 30°, loops by far more than the two radians around a place.
    ends: [Locality<S>; 2],
    hull: Option<Stretch<S>>,
}

impl<S: Scalar> Finder<'_, '_, S> {
    fn arc(
        &self,
        index: u32,
        segment: &Segment<S>,
        arc: &Arc<S>,
        first: usize,
        out: &mut impl Store<Contact<S>>,
    ) -> Result<(), BufferFull> {
        let mut from = arc.span[0].clone();
        let mut candidates = Candidates::new();
        // Ends of stretches, with the number of candidates of the stretch that they are a part of, if all are known.
        let mut pending: ArrayVec<(S, Option<usize>), 56> = ArrayVec::new();
        pending.keep((arc.span[1].clone(), None));
        while let Some((to, known)) = pending.pop() {
            let middle = S::midpoint(&from, &to);
            let length = segment.point(&from).distance(&segment.point(&to));
            // An arc of at most 30° is less than 1.05 chords long, so half of it is within 0.55 chords of its middle.
            let within = length.clone() * &S::ratio(3, 4) + &self.reach;
            let view = View {
                middle: segment.point(&middle),
                limit: (within.clone() + &self.reach).square(),
                ends: [&from, &to].map(|t| Locality::on_arc(segment, arc, t)),
                hull: Stretch::new(segment, &from, &to),
            };
            let (count, complete) = self.narrow(&view, &mut candidates, known);
            let near = candidates.get(..count).unwrap_or_default();
            if near.is_empty() {
                from = to;
                continue;
            }
            if self.on_one_line(segment, &view, [&from, &to], near)
                || self.on_one_arc(segment, &view, [&from, &to], near)
            {
                self.add(segment, index, [&from, &to], first, out)?;
                from = to;
                continue;
            }
            let small = length <= self.reach || middle <= from || middle >= to;
            let touched = |t: &S, within: &S| {
                let own = Locality::on_arc(segment, arc, t);
                near.iter().any(|&other| self.passes(other, &own, &segment.point(t), within))
            };
            let same = !small && length <= self.coarse && [&middle, &from, &to].iter().all(|t| touched(t, &self.reach));
            if small || same {
                if same || touched(&middle, &within) {
                    self.add(segment, index, [&from, &to], first, out)?;
                }
                from = to;
            } else if pending.remaining_capacity() >= 2 {
                let known = complete.then_some(count);
                pending.keep((to, known));
                pending.keep((middle, known));
            } else {
                from = to;
            }
        }
        Ok(())
    }

    /// Moves to the front what may touch a stretch: of the first `known` candidates, or of the whole curve. How many there are,
    /// and whether these are all.
    fn narrow(&self, view: &View<S>, candidates: &mut Candidates, known: Option<usize>) -> (usize, bool) {
        if let Some(known) = known {
            let mut count = 0;
            for i in 0..known {
                if candidates.get(i).is_some_and(|&arc| self.may_touch(view, arc)) {
                    // An error where the two are the same: nothing to do.
                    if let Ok([a, b]) = candidates.get_disjoint_mut([i, count]) {
                        core::mem::swap(a, b);
                    }
                    count += 1;
                }
            }
            return (count, true);
        }
        candidates.clear();
        let mut state = (candidates, true);
        self.curve.hierarchy().traverse(
            &view.middle,
            &mut state,
            |(_, complete), bounds| *complete && bounds.distance_sq(&view.middle) < view.limit,
            |(candidates, complete), leaf, _| {
                for (arc, _) in self.curve.arcs_in(leaf) {
                    *complete &= !self.may_touch(view, arc) || candidates.try_push(arc).is_ok();
                }
            },
        );
        let (candidates, complete) = state;
        (candidates.len(), complete)
    }

    /// The arc may touch the stretch: it is not local, not too far, and no line parts the two.
    fn may_touch(&self, view: &View<S>, arc: u32) -> bool {
        let Some(arc) = &self.curve.arc(arc) else { return false };
        let Some(segment) = self.curve.segment(arc.segment) else { return false };
        let margin = self.reach.clone() + self.curve.noise;
        !view.ends.iter().all(|l| l.holds(segment, arc))
            && !arc.is_beyond(segment, &view.middle, &view.limit)
            && nearest_on_arc(segment, arc, &view.middle).distance_sq < view.limit
            && !view.hull.as_ref().is_some_and(|h| h.clear_of(segment, arc, &margin))
    }

    /// The arc is not local to a place and comes nearer than `within` to its point.
    fn passes(&self, arc: u32, own: &Locality<S>, p: &Point<S>, within: &S) -> bool {
        let Some(arc) = &self.curve.arc(arc) else { return false };
        let Some(segment) = self.curve.segment(arc.segment) else { return false };
        let limit = within.clone().square();
        !own.holds(segment, arc)
            && !arc.is_beyond(segment, p, &limit)
            && nearest_on_arc(segment, arc, p).distance_sq < limit
    }

    /// Both ends of a straight stretch lie on the same other line, hence all of it.
    fn on_one_line(&self, segment: &Segment<S>, view: &View<S>, ends: [&S; 2], near: &[u32]) -> bool {
        let straight = |s: &Segment<S>| s.power.a.iter().skip(1).all(|v| v.norm() <= self.reach);
        straight(segment)
            && near.iter().any(|&other| {
                let its = self.curve.arcs.get(other as usize).and_then(|arc| self.curve.segment(arc.segment));
                its.is_some_and(straight)
                    && ends
                        .iter()
                        .zip(&view.ends)
                        .all(|(t, own)| self.passes(other, own, &segment.point(t), &self.reach))
            })
    }

    /// Evenly spaced points of the stretch lie on one other arc, too many for two cubics that differ.
    fn on_one_arc(&self, segment: &Segment<S>, view: &View<S>, [from, to]: [&S; 2], near: &[u32]) -> bool {
        near.iter().any(|&other| {
            (0..WITNESSES).all(|k| {
                let t = (to.clone() - from) * &S::ratio(k, WITNESSES - 1) + from;
                let p = segment.point(&t);
                view.ends.iter().all(|own| self.passes(other, own, &p, &self.reach))
            })
        })
    }

    /// Adds a contact, or grows the last one that it continues.
    fn add(
        &self,
        segment: &Segment<S>,
        index: u32,
        [from, to]: [&S; 2],
        first: usize,
        out: &mut impl Store<Contact<S>>,
    ) -> Result<(), BufferFull> {
        if out.items().len() > first
            && let Some(last) = out.items_mut().last_mut()
            && last.span[1] >= *from
        {
            last.span[1] = to.clone();
            return Ok(());
        }
        self.settle(segment, first, out);
        out.push(Contact { segment: index, span: [from.clone(), to.clone()] })
    }

    /// Takes the last contact back if it is no more than a corner of its segment.
    fn settle(&self, segment: &Segment<S>, first: usize, out: &mut impl Store<Contact<S>>) {
        let Some(last) = out.items().get(first..).and_then(<[_]>::last) else { return };
        let length = point_length(self.curve);
        let [start, end] = &last.span;
        // All the way from the corner: a loop comes back to the place of its corner, but not with the middle of its way.
        let is_corner = |side: usize| {
            let (corner, far) = if side == 0 { (S::zero(), end) } else { (S::one(), start) };
            let near = |t: &S| segment.point(t).distance(segment.end_point(side)) <= length;
            segment.end(side).kind == JointKind::Corner && near(far) && near(&S::midpoint(&corner, far))
        };
        if is_corner(0) || is_corner(1) {
            let kept = out.items().len() - 1;
            out.shorten(kept);
        }
    }
}

/// The place in the middle of a contact.
pub fn place<S: Scalar>(contact: &Contact<S>) -> CurveParam<S> {
    CurveParam { segment: contact.segment, t: contact.middle() }
}
