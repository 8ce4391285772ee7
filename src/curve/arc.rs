//! Arcs: pieces of a cubic with monotone curvature and little turning, the leaves of the hierarchy.
//!
//! A cubic is cut at its inflections and at the extrema of its curvature, and then until no piece turns by more than 30°.
//! Inversion in a foot point turns the family of its tangent disks into parallel half-planes and keeps vertices (extrema of
//! curvature are a notion of circle geometry), so the image of such a *spiral arc* is again a spiral: seen from its own
//! chord's length away, a linear function has one maximum on it at most. That makes the search for the disk it bounds short;
//! its result does not depend on it ([`crate::medial::disk`]; `docs/mathematics.md`, section 5).

use super::{Segment, index_of};
use crate::bezier::critical;
use crate::buffer::{BufferFull, Keep, Store};
use crate::geometry::hierarchy::{self, Item, Node};
use crate::geometry::{Aabb, Point, distance_sq_to_segment};
use crate::order::sort;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Where an arc starts; it ends where the next one of its segment starts. This is what a curve keeps of its arcs, at a third less
/// memory: [`Curve::arc`](super::Curve::arc) makes an [`Arc`] of it.
#[derive(Clone, Copy, Debug, Default)]
pub struct ArcStart<S> {
    /// The segment.
    pub segment: u32,
    /// Parameter where it starts.
    pub t: S,
    /// Turning accumulated along the strand there.
    pub turn: S,
}

/// A piece of a segment.
#[derive(Clone, Copy, Debug, Default)]
pub struct Arc<S> {
    /// The segment.
    pub segment: u32,
    /// Parameters where it starts and ends, ascending.
    pub span: [S; 2],
    /// Turning accumulated along the strand at those two parameters; it falls along segments that the strand runs
    /// through backwards.
    pub turn: [S; 2],
}

/// Inner cut points of one cubic, ascending: inflections and vertices.
type Cuts<S> = ArrayVec<S, 8>;

/// Appends the arcs of a segment, without turning (which depends on the strand).
///
/// Cuts are inflections and vertices, to the attainable error of the root finder, and then middles of parameters.
///
/// # Errors
/// [`BufferFull`] where `arcs` cannot take them.
pub fn cut<S: Scalar>(index: u32, segment: &Segment<S>, arcs: &mut impl Store<ArcStart<S>>) -> Result<(), BufferFull> {
    let mut cuts: Cuts<S> = ArrayVec::new();
    let margin = S::unit_roundoff().mul_pow2(8);
    let inside = |t: &S| *t > margin && *t < S::one() - &margin;
    for t in critical::inflections(&segment.power).into_iter().chain(critical::vertices(&segment.power)) {
        if inside(&t) && cuts.try_push(t).is_err() {
            break;
        }
    }
    sort(&mut cuts, |a, b| a < b);
    // A cut closer than this to the one before it adds nothing.
    let least = S::unit_roundoff().sqrt();
    let mut from = S::zero();
    for to in cuts.into_iter().chain([S::one()]) {
        if to < S::one() && to.clone() - &from < least {
            continue;
        }
        halve(index, segment, &from, &to, arcs)?;
        from = to;
    }
    Ok(())
}

/// Halves [from, to] until each piece turns by at most 30°, at most 2^12 times.
fn halve<S: Scalar>(
    index: u32,
    segment: &Segment<S>,
    from: &S,
    to: &S,
    arcs: &mut impl Store<ArcStart<S>>,
) -> Result<(), BufferFull> {
    let mut ends: ArrayVec<S, 13> = ArrayVec::new();
    ends.keep(to.clone());
    let mut start = from.clone();
    while let Some(end) = ends.last().cloned() {
        let (u, w) = (segment.tangent(&start), segment.tangent(&end));
        // cos 30° squared is 3/4.
        let cos = u.dot(&w);
        let little = cos > S::zero() && cos.square() * &S::int(4) >= S::int(3);
        if little || ends.is_full() {
            arcs.push(ArcStart { segment: index, t: start, turn: S::zero() })?;
            start = end;
            ends.pop();
        } else if ends.try_push(S::midpoint(&start, &end)).is_err() {
            break;
        }
    }
    Ok(())
}

/// Where an arc ends.
pub(super) fn end<S: Scalar>(arcs: &[ArcStart<S>], index: u32) -> S {
    let segment = arcs.get(index as usize).map(|arc| arc.segment);
    match arcs.get(index as usize + 1) {
        Some(next) if Some(next.segment) == segment => next.t.clone(),
        _ => S::one(),
    }
}

/// The arc that starts at an index.
#[inline]
pub(super) fn whole<S: Scalar>(segments: &[Segment<S>], arcs: &[ArcStart<S>], index: u32) -> Option<Arc<S>> {
    let ArcStart { segment, t, turn } = arcs.get(index as usize)?.clone();
    let (end, after) = match arcs.get(index as usize + 1) {
        Some(next) if next.segment == segment => (next.t.clone(), next.turn.clone()),
        _ => (S::one(), segments.get(segment as usize)?.turn.clone()),
    };
    Some(Arc { segment, span: [t, end], turn: [turn, after] })
}

/// The hierarchy over arcs, of which `leaf` in a row share a leaf; `items` is scratch, one entry a leaf.
///
/// # Errors
/// [`BufferFull`] where a store cannot take its entries.
pub(super) fn enclose<S: Scalar>(
    segments: &[Segment<S>],
    arcs: &[ArcStart<S>],
    leaf: u32,
    items: &mut impl Store<Item<S>>,
    nodes: &mut impl Store<Node<S>>,
) -> Result<(), BufferFull> {
    let (leaf, count) = (leaf.max(1), index_of(arcs.len()));
    for index in 0..count.div_ceil(leaf) {
        let mut bounds = Aabb::empty();
        for i in index * leaf..(index * leaf).saturating_add(leaf).min(count) {
            if let Some(arc) = whole(segments, arcs, i)
                && let Some(s) = segments.get(arc.segment as usize)
            {
                bounds.merge(&arc.bounds(s));
            }
        }
        items.push(Item { bounds, index })?;
    }
    hierarchy::build(items.items_mut(), nodes)
}

impl<S: Scalar> Arc<S> {
    /// A box around the arc: of its own control points.
    pub fn bounds(&self, segment: &Segment<S>) -> Aabb<S> {
        let [from, to] = &self.span;
        segment.cubic.part(from, to).control_box()
    }

    /// The part of its parameters in which the signs of derivatives mean something: all but the last √u beside a retracted
    /// end, where B' vanishes. The curve moves by no more than a roundoff of its size there.
    pub fn moving(&self, segment: &Segment<S>) -> [S; 2] {
        let [from, to] = &self.span;
        let margin = (to.clone() - from) * &S::unit_roundoff().sqrt();
        let start = *from <= S::zero() && segment.end(0).retracted;
        let end = *to >= S::one() && segment.end(1).retracted;
        [if start { from.clone() + &margin } else { from.clone() }, if end { to.clone() - &margin } else { to.clone() }]
    }

    /// Proves that all of the arc is at least the root of `limit_sq` away from p, up to roundoff; `false` says nothing.
    ///
    /// The arc is convex and lies in the triangle of its chord and end tangents. With angles α and β there, α + β its
    /// turning, the triangle's height is sin α sin β / sin(α + β) chords, a quarter of the turning or little more; a
    /// third of the length that stands for the turning covers the difference below half a radian.
    pub(super) fn is_beyond(&self, segment: &Segment<S>, p: &Point<S>, limit_sq: &S) -> bool {
        let [from, to] = &self.span;
        let (a, b) = (segment.point(from), segment.point(to));
        let distance_sq = distance_sq_to_segment(p, &a, &b);
        if distance_sq < *limit_sq {
            return false;
        }
        let turning = self.turning(segment);
        if turning > S::ratio(9, 16) {
            return false;
        }
        let bow_sq = a.distance_sq(&b) * &(turning / &S::int(3)).square();
        // (√d − √h)² ≥ l follows from d ≥ l + h and (d − l − h)² ≥ 4 l h.
        let rest = distance_sq - limit_sq - &bow_sq;
        rest >= S::zero() && rest.square() >= bow_sq * limit_sq * &S::int(4)
    }

    /// How much it turns: the length of the difference of its end tangents, a little less than the angle in radians.
    pub fn turning(&self, segment: &Segment<S>) -> S {
        let [from, to] = &self.span;
        segment.tangent(from).minus(&segment.tangent(to)).norm()
    }
}
