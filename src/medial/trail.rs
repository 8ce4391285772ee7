//! The trail of a walk around the curve: what every walk does at a foot, at a touching and at a joint, however it chooses its
//! feet.
//!
//! [`super::walk`] refines between feet until lfs is good enough, [`super::uniform`] takes equal steps, one foot at a time. Both
//! go along the same sides, turn around the same joints and break their polylines at the same places; that part is here.

use super::disk::{Guard, TangentDisk, Touch, tangent_disk_beside};
use super::foot::{Foot, Side};
use super::walk::MedialPoint;
use crate::buffer::{BufferFull, Sink};
use crate::curve::contact::{Contact, point_length, reach};
use crate::curve::joint::clockwise_rank;
use crate::curve::nearest::{Locality, nearest_beside};
use crate::curve::{Arc, Curve, CurveParam, EndId, JointKind};
use crate::geometry::{Point, Vector};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// A foot that has been looked at.
#[derive(Clone, Debug)]
pub(super) struct Station<S> {
    pub(super) at: CurveParam<S>,
    pub(super) foot: Point<S>,
    pub(super) direction: Vector<S>,
    pub(super) side: Side,
    /// Finite, or there is no medial point.
    pub(super) radius: S,
    pub(super) centre: Point<S>,
    /// What bounds the disk, and the point there.
    pub(super) touch: Option<(Touch<S>, Point<S>)>,
}

impl<S: Clone> Station<S> {
    /// The medial point, as a vertex of a polyline.
    fn vertex(&self, polyline: u32) -> MedialPoint<S> {
        MedialPoint {
            at: self.at.clone(),
            foot: self.foot.clone(),
            side: self.side,
            centre: self.centre.clone(),
            radius: self.radius.clone(),
            polyline,
        }
    }
}

/// Edges of the medial axis along an arc that coincides with another stroke: they leave it by less than a ten-thousandth of
/// its length, since it turns by at most 30°.
const COINCIDING: i32 = 64;

/// How a walk passes a contact on an arc.
pub(super) enum Passage<S> {
    /// Not on this arc.
    Elsewhere,
    /// The medial axis runs into the curve here.
    Point(S),
    /// Strokes coincide between two parameters, in the walk's direction: the medial axis is the stretch itself, in so many
    /// edges.
    Stretch([S; 2], i32),
}

impl<S: Scalar> Passage<S> {
    /// Parameter of the end of an edge of a stretch.
    pub(super) fn edge([a, b]: &[S; 2], k: i32, edges: i32) -> S {
        if k == edges { b.clone() } else { (b.clone() - a) * &S::ratio(k, edges) + a }
    }
}

/// What a walk does where a segment ends.
pub(super) enum Joint<S> {
    /// It goes on, and its polyline with it.
    On,
    /// It goes on with a new polyline.
    Break,
    /// It emits the joint itself; whether its polyline ends there.
    Corner(bool),
    /// It turns through three directions; whether its polyline ends then.
    Fan([Vector<S>; 3], bool),
}

/// A walk between two feet.
pub(super) struct Trail<'c, S> {
    pub(super) curve: &'c Curve<'c, S>,
    contacts: &'c [Contact<S>],
    polyline: u32,
    /// The current polyline has a vertex.
    started: bool,
    /// Whether the last station was emitted by the element before, so that the next element need not repeat it.
    pub(super) joined: bool,
    guard: Guard<S>,
}

impl<'c, S: Scalar> Trail<'c, S> {
    pub(super) fn new(curve: &'c Curve<'c, S>, contacts: &'c [Contact<S>], polyline: u32) -> Self {
        Self { curve, contacts, polyline, started: false, joined: false, guard: Guard::new() }
    }

    /// Number of the current polyline.
    pub(super) const fn polyline(&self) -> u32 {
        self.polyline
    }

    /// Ends the current polyline.
    pub(super) fn break_line(&mut self) {
        if self.started {
            self.polyline += 1;
        }
        self.started = false;
        self.joined = false;
    }

    /// Adds a station to the current polyline, or ends that where there is no medial point.
    pub(super) fn emit(&mut self, s: &Station<S>, out: &mut impl Sink<MedialPoint<S>>) -> Result<(), BufferFull> {
        if !s.radius.is_finite() {
            self.break_line();
            return Ok(());
        }
        self.started = true;
        out.take(s.vertex(self.polyline))
    }

    /// The disk at a foot.
    pub(super) fn disk(&mut self, foot: &Foot<S>) -> TangentDisk<S> {
        tangent_disk_beside(self.curve, foot, &mut self.guard)
    }

    /// Looks at a foot.
    pub(super) fn station(&mut self, foot: Foot<S>) -> Station<S> {
        let TangentDisk { radius, touch } = self.disk(&foot);
        let touch = touch.and_then(|t| self.curve.point(&t.at).map(|p| (t, p)));
        let centre =
            if radius.is_finite() { foot.point.plus_scaled(&radius, &foot.direction) } else { foot.point.clone() };
        Station { at: foot.at, foot: foot.point, direction: foot.direction, side: foot.side, radius, centre, touch }
    }

    /// At a retracted end the curvature is unbounded on one side: there the medial axis runs into the curve.
    pub(super) fn runs_in(&self, at: &CurveParam<S>, side: Side) -> bool {
        let Some(segment) = self.curve.segment(at.segment) else { return false };
        let end = usize::from(at.t > S::zero());
        if (at.t > S::zero() && at.t < S::one()) || !segment.end(end).retracted {
            return false;
        }
        // B' vanishes: B'×B'' is 6v² times the product of the next two Taylor coefficients, on either side of the end.
        let [_, b2, b3] = segment.power.taylor(&at.t);
        let bend = b2.cross(&b3);
        (bend > S::zero()) == (side == Side::Left) && !bend.is_zero()
    }

    /// Looks at the normal to one side of a place, where the medial axis does not run into the curve.
    pub(super) fn side_station(&mut self, at: CurveParam<S>, side: Side) -> Option<Station<S>> {
        if self.runs_in(&at, side) {
            return self.on_curve(at);
        }
        let foot = Foot::on_obstacle(self.curve, at, side)?;
        Some(self.station(foot))
    }

    /// Looks at a direction of an end.
    pub(super) fn fan_station(&mut self, end: EndId, direction: Vector<S>) -> Option<Station<S>> {
        let foot = Foot::fan_of_obstacle(self.curve, end, direction)?;
        Some(self.station(foot))
    }

    /// A vertex on the curve itself.
    pub(super) fn on_curve(&self, at: CurveParam<S>) -> Option<Station<S>> {
        let foot = self.curve.point(&at)?;
        Some(Station {
            at,
            centre: foot.clone(),
            foot,
            direction: Vector::zero(),
            side: Side::Corner,
            radius: S::zero(),
            touch: None,
        })
    }

    /// Contacts that have a place strictly inside an arc.
    pub(super) fn contacts_in(&self, segment: u32, arc: &Arc<S>) -> &'c [Contact<S>] {
        let [from, to] = &arc.span;
        let contacts = self.contacts;
        let low = contacts.partition_point(|c| c.segment < segment || (c.segment == segment && c.span[1] <= *from));
        let high = contacts.partition_point(|c| c.segment < segment || (c.segment == segment && c.span[0] < *to));
        contacts.get(low..high).unwrap_or_default()
    }

    /// How the walk passes a contact on an arc.
    pub(super) fn passage(&self, contact: &Contact<S>, arc: &Arc<S>, side: Side) -> Passage<S> {
        let [start, end] = &contact.span;
        let (a, b) = (start.clone().max(arc.span[0].clone()), end.clone().min(arc.span[1].clone()));
        let point = |t: &S| self.curve.segment(arc.segment).map(|s| s.point(t));
        let length = point(&a).zip(point(&b)).map_or_else(S::zero, |(p, q)| p.distance(&q));
        if length <= point_length(self.curve) {
            let t = contact.middle();
            let inside = t > arc.span[0] && t < arc.span[1];
            return if inside { Passage::Point(t) } else { Passage::Elsewhere };
        }
        let edges = if length * &S::int(10_000) < *self.curve.diagonal { 1 } else { COINCIDING };
        Passage::Stretch(if side == Side::Left { [a, b] } else { [b, a] }, edges)
    }

    /// What comes at the end of one segment, on its left side as the walk arrives there. `follows` is the end by which the walk
    /// goes on.
    pub(super) fn joint(&self, end: EndId, follows: Option<EndId>) -> Joint<S> {
        let curve = self.curve;
        let Some(arriving) = curve.end(end) else { return Joint::On };
        if curve.segment(end.segment()).is_some_and(|s| s.twin.is_some()) {
            return Joint::Break;
        }
        if arriving.kind == JointKind::Smooth {
            let next = curve.ring(end).nth(1);
            return if next == follows { Joint::On } else { Joint::Break };
        }
        // The next branch clockwise: from the left side over ahead to the right side.
        let mut next = end;
        let mut best: Option<S> = None;
        for e in curve.ring(end) {
            let Some(branch) = curve.end(e) else { continue };
            // A branch along the same line as the arriving one is no turn at all, its own reverse a full one.
            let rank = if e == end { S::int(4) } else { clockwise_rank(&arriving.leaving, &branch.leaving) };
            if best.as_ref().is_none_or(|b| rank < *b) {
                best = Some(rank);
                next = e;
            }
        }
        let Some(branch) = curve.end(next) else { return Joint::On };
        let rank = best.unwrap_or_else(|| S::int(4));
        let breaks = follows.is_some_and(|f| f != next) || (follows.is_none() && next != end);
        // Half a turn has rank 2: more than that leaves room for a fan, unless another stroke passes here.
        if rank > S::int(2)
            && !self.touched(end)
            && let Some(middle) = arriving.leaving.plus(&branch.leaving).opposite().unit()
        {
            return Joint::Fan([arriving.leaving.left().opposite(), middle, branch.leaving.left()], breaks);
        }
        Joint::Corner(breaks)
    }

    /// Something that is not joined here touches the joint: no disk fits at it.
    fn touched(&self, end: EndId) -> bool {
        let Some(p) = self.curve.end_point(end) else { return false };
        let mut branches: ArrayVec<Locality<S>, 8> = ArrayVec::new();
        for e in self.curve.ring(end) {
            let t = if e.side() == 0 { S::zero() } else { S::one() };
            let Some(locality) = Locality::of(self.curve, &CurveParam { segment: e.segment(), t }) else { continue };
            if branches.try_push(locality).is_err() {
                return false;
            }
        }
        let limit = reach(self.curve) * &S::int(4);
        nearest_beside(self.curve, p, &branches, limit.square()).is_some()
    }
}
