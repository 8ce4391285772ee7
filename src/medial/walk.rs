//! The walk around the curve that makes medial polylines.
//!
//! Every path is walked along its left side, forwards, and along its right side, backwards; open paths in one round, turning
//! at their ends. Where the walk passes an outer corner or an open end it stops and lets the direction turn (a *fan*); at an
//! inner corner, a crossing or a touching the polyline runs into the curve itself (m = f). So consecutive medial points
//! belong together, and a polyline breaks only where a tangent disk is unbounded.
//!
//! **Steps.** [`Resolution::Steps`] is the paper's parameter: N equal parameter steps a segment ([`super::uniform`]).
//! [`Resolution::Tolerance`] refines until the polyline is a good copy of the medial axis *for lfs*. A cell between two feet, with length h, is
//! halved while
//!
//! * a piece of curve that is not local to it comes nearer than h: anything the cell could have missed touches its disks
//!   within that reach, so features are found at every scale;
//! * the disks of its ends or middle are bounded by different features and their centres differ by more than 2τr (a branch
//!   point lies between), τ being the tolerance and r the smallest radius;
//! * the middle medial point lies off the chord of the other two by more than 2τr, or that chord is longer than r/2;
//!
//! and the cell still matters (h is above the floor of all lengths, and its radii are not above every lfs of the drawing) and
//! is not explained by two strokes: where just one stroke lies opposite, as in a channel, a cusp or an acute crossing, the
//! axis runs smoothly between them, and only its distance from the chord counts (`docs/mathematics.md`, section 8).
//! The tolerance is relative to the radius, because |p − m| ≥ r for every p ∈ C: an error below τ·r is a relative error of
//! lfs below τ. The criterion is an estimate; what it has proved is tested against truth (`docs/accuracy.md`).

use super::disk::tangent_disk;
use super::foot::{Foot, Side};
use super::trail::{Joint, Passage, Station, Trail};
use super::uniform::walk_uniform;
use crate::buffer::{BufferFull, Keep, Sink};
use crate::curve::contact::{Contact, reach};
use crate::curve::nearest::{Locality, nearest_beside, nearest_on_arc};
use crate::curve::{Arc, Curve, CurveParam, EndId};
use crate::geometry::{Point, Vector, distance_sq_to_segment};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// One vertex of a medial polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MedialPoint<S> {
    /// Its foot on C; for a fan or a corner, the end of a segment.
    pub at: CurveParam<S>,
    /// The foot point f.
    pub foot: Point<S>,
    /// Which kind of foot.
    pub side: Side,
    /// The medial point m.
    pub centre: Point<S>,
    /// |m − f|.
    pub radius: S,
    /// Polyline number; consecutive points with the same number are joined by an edge.
    pub polyline: u32,
}

impl<S: Scalar + Default> Default for MedialPoint<S> {
    fn default() -> Self {
        Self {
            at: CurveParam::default(),
            foot: Point::default(),
            side: Side::Corner,
            centre: Point::default(),
            radius: S::default(),
            polyline: 0,
        }
    }
}

/// How many feet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resolution<S> {
    /// Equal parameter steps a segment (the paper's N), at least 1.
    Steps(u32),
    /// As many as the relative error of lfs asks for, in (0, 1).
    Tolerance(S),
}

/// Walks around one path and appends its medial points. `polyline` is the number that the first polyline gets; the number
/// after the last one is returned.
///
/// `contacts` are the touchings of the whole curve, as [`crate::curve::contact::find`] gives them. `relevance` bounds lfs
/// on all of C from above ([`relevance`]): larger disks are not refined.
///
/// # Errors
/// [`BufferFull`] where `out` cannot take more.
pub fn walk<S: Scalar>(
    curve: &Curve<'_, S>,
    path: u32,
    resolution: &Resolution<S>,
    contacts: &[Contact<S>],
    relevance: &S,
    polyline: u32,
    out: &mut impl Sink<MedialPoint<S>>,
) -> Result<u32, BufferFull> {
    match resolution {
        Resolution::Steps(n) => walk_uniform(curve, path, *n, contacts, polyline, out),
        Resolution::Tolerance(t) => {
            Walker { trail: Trail::new(curve, contacts, polyline), tolerance: t, relevance, floor: floor(curve), out }
                .path(path)
        }
    }
}

/// An upper bound of lfs over all of C: lfs is 1-Lipschitz, and at a foot it is at most the radius of either disk there.
///
/// Infinite only if no disk at any segment's start is bounded.
pub fn relevance<S: Scalar>(curve: &Curve<'_, S>) -> S {
    let mut least = S::infinity();
    for (segment, i) in curve.segments.iter().zip(0_u32..) {
        if segment.twin.is_some() {
            continue;
        }
        for side in [Side::Left, Side::Right] {
            for t in [S::zero(), S::one().half()] {
                let at = CurveParam { segment: i, t };
                if let Some(foot) = Foot::on_obstacle(curve, at, side) {
                    least = least.min(tangent_disk(curve, &foot).radius);
                }
            }
        }
    }
    least + curve.diagonal
}

/// A station at the far end of a cell that is still to be split or accepted.
struct Pending<S> {
    station: Station<S>,
    /// Nothing that is not local comes nearer to the cell that ends here than its length.
    clear: bool,
}

/// Strokes that are known where something else is looked for. A brush stroke drawn as ten outlines that nearly coincide has so
/// many beside each other; where there are more, cells are halved until they are as short as the gaps.
type Strokes<S> = ArrayVec<Locality<S>, 16>;

/// Halvings of a cell: 2^−56 of a segment is below every floor.
const DEPTH: usize = 56;

struct Walker<'w, 'c, S, Out> {
    trail: Trail<'c, S>,
    tolerance: &'w S,
    relevance: &'w S,
    /// Lengths below this are nothing.
    floor: S,
    out: &'w mut Out,
}

/// Lengths below this are nothing.
fn floor<S: Scalar>(curve: &Curve<'_, S>) -> S {
    let billionth = S::one() / &S::int(1_000_000_000);
    billionth.max(S::unit_roundoff().mul_pow2(2)) * curve.diagonal
}

impl<S: Scalar, Out: Sink<MedialPoint<S>>> Walker<'_, '_, S, Out> {
    /// All of one path; the number after its last polyline.
    fn path(mut self, path: u32) -> Result<u32, BufferFull> {
        let Some(path) = self.trail.curve.paths.get(path as usize) else { return Ok(self.trail.polyline()) };
        let last = path.first + path.count - 1;
        for segment in path.first..=last {
            self.side(segment, Side::Left)?;
            let next = if segment < last { Some(segment + 1) } else { path.closed.then_some(path.first) };
            self.turn(EndId::new(segment, 1), next.map(|n| EndId::new(n, 0)))?;
        }
        if path.closed {
            self.trail.break_line();
        }
        for segment in (path.first..=last).rev() {
            self.side(segment, Side::Right)?;
            let next = if segment > path.first { Some(segment - 1) } else { path.closed.then_some(last) };
            self.turn(EndId::new(segment, 0), next.map(|n| EndId::new(n, 1)))?;
        }
        self.trail.break_line();
        Ok(self.trail.polyline())
    }

    /// One side of one segment, in the direction that keeps it on the left.
    fn side(&mut self, index: u32, side: Side) -> Result<(), BufferFull> {
        let curve = self.trail.curve;
        let Some(segment) = curve.segment(index) else { return Ok(()) };
        if segment.twin.is_some() {
            self.trail.break_line();
            return Ok(());
        }
        let forwards = side == Side::Left;
        let start_t = if forwards { S::zero() } else { S::one() };
        let Some(mut here) = self.trail.side_station(CurveParam { segment: index, t: start_t }, side) else {
            return Ok(());
        };
        // A fan that comes to this normal does not come to the curve.
        if !self.trail.joined || here.side == Side::Corner {
            self.trail.emit(&here, self.out)?;
        }
        let (first, count) = segment.arcs;
        for n in 0..count {
            let Some(arc) = &curve.arc(first + if forwards { n } else { count - 1 - n }) else { break };
            let touched = self.trail.contacts_in(index, arc);
            let points = touched.len();
            for m in 0..points {
                let Some(contact) = touched.get(if forwards { m } else { points - 1 - m }) else { break };
                here = self.contact(here, contact, arc, side)?;
            }
            let t = if forwards { &arc.span[1] } else { &arc.span[0] };
            let Some(there) = self.trail.side_station(CurveParam { segment: index, t: t.clone() }, side) else { break };
            here = self.cell(here, there, arc, side)?;
        }
        self.trail.joined = true;
        Ok(())
    }

    /// Goes on to and through the part of a contact that lies on an arc. Where strokes coincide along a stretch the medial
    /// axis is the stretch itself.
    fn contact(
        &mut self,
        from: Station<S>,
        contact: &Contact<S>,
        arc: &Arc<S>,
        side: Side,
    ) -> Result<Station<S>, BufferFull> {
        let segment = arc.segment;
        let (ends, edges) = match self.trail.passage(contact, arc, side) {
            Passage::Elsewhere => return Ok(from),
            Passage::Point(t) => {
                return match self.trail.on_curve(CurveParam { segment, t }) {
                    Some(there) => self.cell(from, there, arc, side),
                    None => Ok(from),
                };
            }
            Passage::Stretch(ends, edges) => (ends, edges),
        };
        let t = ends[0].clone();
        let Some(mut here) = self.trail.on_curve(CurveParam { segment, t }) else { return Ok(from) };
        if from.at != here.at {
            self.cell(from, here.clone(), arc, side)?;
        }
        for k in 1..=edges {
            let t = Passage::edge(&ends, k, edges);
            let Some(there) = self.trail.on_curve(CurveParam { segment, t }) else { break };
            self.trail.emit(&there, self.out)?;
            here = there;
        }
        Ok(here)
    }

    /// Emits everything after `from` up to and including `to`, which lie on one arc; gives back `to`.
    fn cell(&mut self, from: Station<S>, to: Station<S>, arc: &Arc<S>, side: Side) -> Result<Station<S>, BufferFull> {
        let mut here = from;
        let mut pending: ArrayVec<Pending<S>, DEPTH> = ArrayVec::new();
        pending.keep(Pending { station: to, clear: false });
        while let Some(mut top) = pending.pop() {
            let length = here.foot.distance(&top.station.foot);
            let (low, high) = if here.at.t < top.station.at.t {
                (&here.at.t, &top.station.at.t)
            } else {
                (&top.station.at.t, &here.at.t)
            };
            let t = S::midpoint(low, high);
            let apart = t > *low && t < *high;
            // Next to an end of unbounded curvature medial points move like the square root of the length: a stretch that is
            // short still matters there.
            let tip = here.side == Side::Corner || top.station.side == Side::Corner;
            let spread = tip
                && here.radius.is_finite()
                && top.station.radius.is_finite()
                && here.centre.distance(&top.station.centre) > self.floor.clone() * &S::int(100);
            if (length > self.floor || spread) && apart && !pending.is_full() {
                let at = CurveParam { segment: top.station.at.segment, t };
                if !top.clear {
                    top.clear = length <= self.floor || self.clear(arc, &at, side, &length);
                }
                if let Some(foot) = Foot::on_obstacle(self.trail.curve, at, side) {
                    let middle = self.trail.station(foot);
                    if (!top.clear || self.rough(&here, &middle, &top.station))
                        && !self.between_two(arc, side, [&here, &middle, &top.station])
                    {
                        let clear = top.clear;
                        pending.keep(top);
                        if pending.try_push(Pending { station: middle, clear }).is_ok() {
                            continue;
                        }
                        let Some(back) = pending.pop() else { break };
                        top = back;
                    } else {
                        self.trail.emit(&middle, self.out)?;
                    }
                }
            }
            self.trail.emit(&top.station, self.out)?;
            here = top.station;
        }
        Ok(here)
    }

    /// Nothing that is not local to this place, and could touch a disk on this side of it, comes nearer than `length`.
    fn clear(&self, arc: &Arc<S>, at: &CurveParam<S>, side: Side, length: &S) -> bool {
        let Some(segment) = self.trail.curve.segment(at.segment) else { return true };
        let mut strokes = Strokes::new();
        strokes.keep(Locality::on_arc(segment, arc, &at.t));
        self.alone(arc, None, &segment.point(&at.t), side, length, strokes)
    }

    /// Within `reach` of p, a point of the arc, there is nothing but these strokes and a few more that are hidden.
    ///
    /// A stroke behind the arc can touch a disk before it only past the arc's ends, or past a crossing, which ends a cell: it
    /// hides nothing between the feet of one. Nor does a stroke behind the one that faces the arc, or coinciding with it.
    fn alone(
        &self,
        arc: &Arc<S>,
        facing: Option<&Arc<S>>,
        p: &Point<S>,
        side: Side,
        reach: &S,
        mut strokes: Strokes<S>,
    ) -> bool {
        let limit = reach.clone().square();
        loop {
            let Some(near) = nearest_beside(self.trail.curve, p, &strokes, limit.clone()) else { return true };
            let hidden = self.behind(arc, &near.point, side) || facing.is_some_and(|f| self.covered(f, p, &near.point));
            // Each turn takes one more stroke: the room for them bounds the loop.
            let Some(stroke) = Locality::of(self.trail.curve, &near.at).filter(|_| hidden) else { return false };
            if strokes.try_push(stroke).is_err() {
                return false;
            }
        }
    }

    /// Seen from p, the point q is behind an arc or on it.
    fn covered(&self, facing: &Arc<S>, p: &Point<S>, q: &Point<S>) -> bool {
        let Some(segment) = self.trail.curve.segment(facing.segment) else { return false };
        let near = nearest_on_arc(segment, facing, q).point;
        let ahead = near.minus(p).unit();
        ahead.is_some_and(|d| d.dot(&q.minus(&near)) >= -reach(self.trail.curve))
    }

    /// The point q lies on the other side of the arc: its nearest point there is an inner one, and clearly so.
    fn behind(&self, arc: &Arc<S>, q: &Point<S>, side: Side) -> bool {
        let Some(segment) = self.trail.curve.segment(arc.segment) else { return false };
        let near = nearest_on_arc(segment, arc, q);
        let left = segment.tangent(&near.at.t).left();
        let height = left.dot(&q.minus(&near.point));
        let depth = if side == Side::Left { -height } else { height };
        let inner = near.at.t > arc.span[0] && near.at.t < arc.span[1];
        inner && depth > self.trail.curve.noise.clone() * &S::int(8)
    }

    /// The polyline from a to b through m is not good enough yet.
    fn rough(&self, a: &Station<S>, m: &Station<S>, b: &Station<S>) -> bool {
        let (ra, rm, rb) = (&a.radius, &m.radius, &b.radius);
        let least = ra.clone().min(rm.clone()).min(rb.clone());
        if least >= *self.relevance || !least.is_finite() {
            return false;
        }
        if !(ra.is_finite() && rm.is_finite() && rb.is_finite()) {
            return true;
        }
        // Short of half a radius an edge cannot hide a wiggle that its middle does not show.
        let floored = least.clone().max(self.floor.clone() * &S::int(100));
        if a.centre.distance_sq(&b.centre) > floored.clone().half().square() {
            return true;
        }
        let allowed = floored * self.tolerance;
        let allowed_sq = allowed.twice().square();
        if (!self.same_feature(a, m) || !self.same_feature(m, b)) && a.centre.distance_sq(&b.centre) > allowed_sq {
            return true;
        }
        distance_sq_to_segment(&m.centre, &a.centre, &b.centre) > allowed_sq
    }

    /// The cell is good enough because nothing but two strokes matters to it: its own and one opposite, as in a narrow
    /// channel, a cusp or an acute crossing. There the medial axis runs smoothly between them, and an edge may be much longer
    /// than its radii.
    fn between_two(&self, arc: &Arc<S>, side: Side, cell: [&Station<S>; 3]) -> bool {
        let [a, m, b] = cell;
        let Some((touch, _)) = &m.touch else { return false };
        let opposite = |s: &Station<S>| match &s.touch {
            Some((t, _)) => t.arc.abs_diff(touch.arc) <= 1 && self.same_path(t.arc, touch.arc),
            // The two strokes meet here.
            None => s.side == Side::Corner,
        };
        if !(opposite(a) && opposite(b)) {
            return false;
        }
        let (ra, rm, rb) = (&a.radius, &m.radius, &b.radius);
        let least = ra.clone().min(rm.clone()).min(rb.clone());
        let allowed = (least.max(self.floor.clone() * &S::int(100)) * self.tolerance).twice();
        if distance_sq_to_segment(&m.centre, &a.centre, &b.centre) > allowed.clone().square() {
            return false;
        }
        // An edge through the middle point of an S would pass the test above: its radii do not.
        let (before, after) = (a.centre.distance(&m.centre), m.centre.distance(&b.centre));
        let length = before.clone() + &after;
        if length > S::zero() {
            let linear = (ra.clone() * &after + &(rb.clone() * &before)) / &length;
            if (linear - rm).abs() > allowed.twice() {
                return false;
            }
        }
        let Some(own) = Locality::of(self.trail.curve, &m.at) else { return false };
        let Some(facing) = &self.trail.curve.arc(touch.arc) else { return false };
        if self.trail.curve.segment(facing.segment).is_none_or(|other| own.holds(other, facing)) {
            return false;
        }
        let Some(other) = Locality::of(self.trail.curve, &touch.at) else { return false };
        let mut strokes = Strokes::new();
        strokes.keep(own);
        strokes.keep(other);
        // Every disk of the cell lies within this distance of its middle.
        let reach = a.foot.distance(&b.foot) + &(ra.clone().max(rm.clone()).max(rb.clone()) * &S::int(3));
        self.alone(arc, Some(facing), &m.foot, side, &reach, strokes)
    }

    /// The disks are bounded by the same or neighbouring arcs, or at nearly the same point.
    fn same_feature(&self, a: &Station<S>, b: &Station<S>) -> bool {
        match (&a.touch, &b.touch) {
            (Some((i, p)), Some((j, q))) => {
                i.arc.abs_diff(j.arc) <= 1 && self.same_path(i.arc, j.arc)
                    || p.distance_sq(q) <= a.foot.distance_sq(&b.foot)
            }
            _ => true,
        }
    }

    fn same_path(&self, i: u32, j: u32) -> bool {
        let path = |k: u32| {
            let arc = self.trail.curve.arcs.get(k as usize)?;
            self.trail.curve.segment(arc.segment).map(|s| s.path)
        };
        i == j || path(i) == path(j)
    }

    /// From the end of one segment, on its left side as it arrives there, to whatever comes next around the joint.
    ///
    /// `follows` is the end by which the walk goes on.
    fn turn(&mut self, end: EndId, follows: Option<EndId>) -> Result<(), BufferFull> {
        let joint = self.trail.joint(end, follows);
        let (fan, breaks) = match joint {
            Joint::On => return Ok(()),
            Joint::Break => (true, true),
            Joint::Corner(breaks) => {
                let at = CurveParam { segment: end.segment(), t: if end.side() == 0 { S::zero() } else { S::one() } };
                if let Some(corner) = self.trail.on_curve(at) {
                    self.trail.emit(&corner, self.out)?;
                }
                (false, breaks)
            }
            Joint::Fan([first, middle, last], breaks) => {
                self.fan(end, first, middle, last)?;
                (true, breaks)
            }
        };
        if breaks {
            self.trail.break_line();
        }
        // The next side starts with its own normal, which the fan ended with, or which the corner point precedes.
        self.trail.joined &= fan;
        Ok(())
    }

    /// The medial points of an end's directions from `first` over `middle` to `last`.
    fn fan(&mut self, end: EndId, first: Vector<S>, middle: Vector<S>, last: Vector<S>) -> Result<(), BufferFull> {
        let Some(mut here) = self.trail.fan_station(end, first) else { return Ok(()) };
        for to in [middle, last] {
            let Some(to) = self.trail.fan_station(end, to) else { continue };
            let mut pending: ArrayVec<Station<S>, DEPTH> = ArrayVec::new();
            pending.keep(to);
            while let Some(top) = pending.pop() {
                let spread = here.direction.minus(&top.direction).norm();
                let middle = here.direction.plus(&top.direction).unit().filter(|_| !pending.is_full());
                if let Some(m) = middle.and_then(|d| self.trail.fan_station(end, d)) {
                    let narrow = spread <= S::unit_roundoff().mul_pow2(8);
                    let quarter = S::one().mul_pow2(-2);
                    let split = !narrow && (spread > quarter || self.rough(&here, &m, &top));
                    if split && pending.remaining_capacity() >= 2 {
                        pending.keep(top);
                        pending.keep(m);
                        continue;
                    }
                    self.trail.emit(&m, self.out)?;
                }
                self.trail.emit(&top, self.out)?;
                here = top;
            }
        }
        Ok(())
    }
}
