//! Where the curve touches itself: crossings, T-junctions, overlaps.
//!
//! A stretch of curve of length h can meet another, non-local one only if that one comes nearer to its middle than h, and not
//! if a line parts the two ([`super::apart`]): so arcs are halved while something non-local may touch, and what is left at the
//! smallest size does. The cost is that of O(log) closest-point searches a contact, and of √(κ/g) for each length along which
//! strokes of curvature κ run side by side with a gap g.
//!
//! A contact is an interval of parameters, since strokes can coincide along a stretch: straight ones are recognised as a
//! whole, curved ones at a hundred-thousandth of the diagonal. Touching means: nearer than
//! [`reach`], a billionth of the diagonal (or a few roundoffs, where the scalar has fewer bits).

use super::apart::Stretch;
use super::nearest::{Locality, nearest_beside, nearest_non_local, nearest_on_arc};
use super::{Arc, Curve, CurveParam, JointKind, Segment};
use crate::buffer::{BufferFull, Keep, Store};
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

/// Appends all contacts of one segment, by ascending parameter. Joints are none: what meets there is known.
///
/// # Errors
/// [`BufferFull`] where `out` cannot take more.
pub fn find<S: Scalar>(curve: &Curve<'_, S>, segment: u32, out: &mut impl Store<Contact<S>>) -> Result<(), BufferFull> {
    let Some(s) = curve.segment(segment) else { return Ok(()) };
    let finder = Finder { curve, reach: reach(curve), coarse: curve.diagonal.clone() / &S::int(100_000) };
    let first = out.items().len();
    for arc in curve.arcs_of(s) {
        finder.arc(segment, s, arc, first, out)?;
    }
    Ok(())
}

struct Finder<'w, 'c, S> {
    curve: &'w Curve<'c, S>,
    reach: S,
    /// Stretches of this size that touch at both ends and in the middle coincide.
    coarse: S,
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
        let mut pending: ArrayVec<S, 56> = ArrayVec::new();
        pending.keep(arc.span[1].clone());
        while let Some(to) = pending.pop() {
            let middle = S::midpoint(&from, &to);
            let (a, b) = (segment.point(&from), segment.point(&to));
            let length = a.distance(&b);
            // An arc of at most 30° is less than 1.05 chords long, so half of it is within 0.55 chords of its middle.
            let within = length.clone() * &S::ratio(3, 4) + &self.reach;
            let Some(near) = self.other(segment, arc, &middle, &within) else {
                from = to;
                continue;
            };
            if self.clear(segment, arc, [&from, &middle, &to], &within) {
                from = to;
                continue;
            }
            if length <= self.coarse && self.apart(segment, arc, [&from, &middle, &to], &length) {
                from = to;
                continue;
            }
            if self.on_one_line(segment, arc, [&from, &to]) {
                Self::add(index, &from, &to, first, out)?;
                from = to;
                continue;
            }
            let small = length <= self.reach || middle <= from || middle >= to;
            let same = !small
                && length <= self.coarse
                && near <= self.reach
                && self.other(segment, arc, &from, &self.reach).is_some()
                && self.other(segment, arc, &to, &self.reach).is_some();
            if small || same {
                // What coincides with another stroke does so at a corner too.
                if same || !self.at_corner(segment, &from, &to) {
                    Self::add(index, &from, &to, first, out)?;
                }
                from = to;
            } else if pending.remaining_capacity() >= 2 {
                pending.keep(to);
                pending.keep(middle);
            } else {
                from = to;
            }
        }
        Ok(())
    }

    /// Both ends of a straight stretch lie on the same other line, hence all of it.
    fn on_one_line(&self, segment: &Segment<S>, arc: &Arc<S>, ends: [&S; 2]) -> bool {
        let straight = |s: &Segment<S>| s.power.a.iter().skip(1).all(|v| v.norm() <= self.reach);
        if !straight(segment) {
            return false;
        }
        let [a, b] = ends.map(|t| {
            let own = Locality::on_arc(segment, arc, t);
            nearest_non_local(self.curve, &segment.point(t), &own, self.reach.clone().square())
        });
        let (Some(a), Some(b)) = (a, b) else { return false };
        a.at.segment == b.at.segment && self.curve.segment(a.at.segment).is_some_and(straight)
    }

    /// Nothing that is not local to some point of the stretch comes near enough to touch it: each arc within reach of the
    /// stretch is parted from it by a line.
    fn clear(&self, segment: &Segment<S>, arc: &Arc<S>, [from, middle, to]: [&S; 3], within: &S) -> bool {
        let Some(stretch) = Stretch::new(segment, from, to) else { return false };
        let own = [from, to].map(|t| Locality::on_arc(segment, arc, t));
        let centre = segment.point(middle);
        // What touches at the smallest size is within 7/4 of `reach` of some middle.
        let limit = (within.clone() + &self.reach).square();
        let margin = self.reach.clone().twice() + self.curve.noise;
        let mut clear = true;
        self.curve.hierarchy().traverse(
            &centre,
            &mut clear,
            |clear, bounds| *clear && bounds.distance_sq(&centre) < limit,
            |clear, leaf, _| {
                *clear = self.curve.arcs_in(leaf).all(|(_, other)| {
                    let Some(its) = self.curve.segment(other.segment) else { return true };
                    own.iter().all(|l| l.holds(its, other))
                        || stretch.clear_of(its, other, &margin)
                        || nearest_on_arc(its, other, &centre).distance_sq >= limit
                });
            },
        );
        clear
    }

    /// A single other stroke runs beside this stretch without touching it, as strokes do where they leave a cusp.
    ///
    /// At this size both are parabolas at most, so the gap is a quadratic, known from its values at the ends and the middle.
    fn apart(&self, segment: &Segment<S>, arc: &Arc<S>, t: [&S; 3], length: &S) -> bool {
        let limit = (length.clone() + &self.reach).square();
        let mut other: Option<Locality<S>> = None;
        let mut gaps: ArrayVec<S, 3> = ArrayVec::new();
        for t in t {
            let p = segment.point(t);
            let own = Locality::on_arc(segment, arc, t);
            let Some(near) = nearest_non_local(self.curve, &p, &own, limit.clone()) else { return false };
            let same = other.as_ref().is_none_or(|o| {
                let its = self.curve.segment(near.at.segment);
                its.is_some_and(|s| self.curve.arcs_of(s).iter().any(|a| a.span[1] >= near.at.t && o.holds(s, a)))
            });
            if !same {
                return false;
            }
            if other.is_none() {
                other = Locality::of(self.curve, &near.at);
            }
            let ahead = segment.tangent(t).left().dot(&near.point.minus(&p));
            if ahead.clone().abs() <= self.reach {
                return false;
            }
            gaps.keep(ahead);
        }
        let (Some(other), [a, m, b]) = (other, gaps.as_slice()) else { return false };
        let same_side = (*a > S::zero()) == (*m > S::zero()) && (*m > S::zero()) == (*b > S::zero());
        // The quadratic's smallest value is above the smallest of the three less its bend.
        let bend = (a.clone() + b - &m.clone().twice()).abs();
        let least = a.clone().abs().min(m.clone().abs()).min(b.clone().abs());
        if !same_side || least <= bend {
            return false;
        }
        let middle = t[1];
        let own = Locality::on_arc(segment, arc, middle);
        nearest_beside(self.curve, &segment.point(middle), &[own, other], limit).is_none()
    }

    /// Distance from a point of the arc to what is not local to it, if below `limit`.
    fn other(&self, segment: &Segment<S>, arc: &Arc<S>, t: &S, limit: &S) -> Option<S> {
        let locality = Locality::on_arc(segment, arc, t);
        let p = segment.point(t);
        nearest_non_local(self.curve, &p, &locality, limit.clone().square()).map(|n| n.distance_sq.sqrt())
    }

    /// The stretch reaches a corner or joint of its own segment, where other branches meet it as a matter of course.
    fn at_corner(&self, segment: &Segment<S>, from: &S, to: &S) -> bool {
        let slack = self.reach.clone() * &S::int(4);
        let near = |side: usize, t: &S| {
            segment.end(side).kind == JointKind::Corner && segment.point(t).distance(segment.end_point(side)) <= slack
        };
        near(0, from) || near(1, to)
    }

    /// Adds a contact, or grows the last one that it continues.
    fn add(index: u32, from: &S, to: &S, first: usize, out: &mut impl Store<Contact<S>>) -> Result<(), BufferFull> {
        if out.items().len() > first
            && let Some(last) = out.items_mut().last_mut()
            && last.segment == index
            && last.span[1] >= *from
        {
            last.span[1] = to.clone();
            return Ok(());
        }
        out.push(Contact { segment: index, span: [from.clone(), to.clone()] })
    }
}

/// The place in the middle of a contact.
pub fn place<S: Scalar>(contact: &Contact<S>) -> CurveParam<S> {
    CurveParam { segment: contact.segment, t: contact.middle() }
}
