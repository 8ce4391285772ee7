//! Steps 6 and 7 of the door: ends that meet are united in joints, and joints get their kind.
//!
//! Consecutive segments meet by construction; ends of different open paths meet if they are near each other, which cells of
//! the snapping distance find. A joint of two ends that turns little is made tangent-continuous.

use super::{Door, index_of};
use crate::buffer::Store;
use crate::curve::joint::{end_mut, end_ref, members_of};
use crate::curve::{EndId, JointKind, Path, Segment, obstacle_end};
use crate::geometry::{Point, Vector};
use crate::order::sort;
use crate::scalar::Scalar;
use core::cmp::Ordering;

impl<S: Scalar> Door<'_, S> {
    /// Step 6: consecutive segments, then ends of open paths.
    pub(super) fn join(&mut self, segments: &mut [Segment<S>], paths: &[Path], order: &mut impl Store<u32>) {
        for path in paths {
            for k in 0..path.count {
                let here = path.first + k;
                let next = if k + 1 < path.count { here + 1 } else { path.first };
                if k + 1 == path.count && !path.closed {
                    continue;
                }
                unite(segments, EndId::new(here, 1), EndId::new(next, 0));
            }
        }
        // Ends of open paths, in cells of the snapping distance, so that near ends lie in neighbouring cells.
        let ends = |i: u32| {
            let p = paths.get((i >> 1) as usize)?;
            (!p.closed).then(|| if i & 1 == 0 { EndId::new(p.first, 0) } else { EndId::new(p.first + p.count - 1, 1) })
        };
        let short = self.short();
        let cell_of = |p: &Point<S>| {
            // Truncation makes one cell around zero twice as wide; neighbours are still neighbours. Coordinates beyond 2^63
            // cells share a cell.
            let cell = |v: &S| (v.clone() / &short).to_i64();
            (cell(&p.x), cell(&p.y))
        };
        order.shorten(0);
        for i in 0..index_of(2 * paths.len()) {
            if ends(i).is_some() && order.push(i).is_err() {
                return;
            }
        }
        let view: &[Segment<S>] = segments;
        let point = |i: u32| {
            let e = ends(i)?;
            view.get(e.segment() as usize).map(|s| s.end_point(e.side()).clone())
        };
        let key = |i: u32| point(i).map_or((i64::MAX, i64::MAX, i), |p| (cell_of(&p).0, cell_of(&p).1, i));
        sort(order.items_mut(), |&i, &j| key(i) < key(j));
        for n in 0..order.items().len() {
            let Some(&i) = order.items().get(n) else { break };
            let (Some(e), Some(p)) = (ends(i), segments_point(segments, ends(i))) else { continue };
            if let Some(leader) = near_earlier_end(segments, order.items(), i, &p, &short, &ends, &cell_of)
                && let Some(q) = segments_point(segments, Some(leader))
            {
                self.note_snap(&p, &q);
                if unite(segments, leader, e) {
                    self.report.joined += 1;
                    set_end_point(segments, e, q);
                }
            }
        }
    }

    /// Step 7: every joint gets its kind, and smooth ones their common tangent.
    pub(super) fn classify(&mut self, segments: &mut [Segment<S>]) {
        for i in 0..index_of(segments.len()) {
            if segments.get(i as usize).is_none_or(|s| s.twin.is_some()) {
                continue;
            }
            for side in 0..2 {
                let first = EndId::new(i, side);
                let mut others = members_of(segments, first).skip(1);
                let (second, third) = (others.next(), others.next());
                let lowest = members_of(segments, first).all(|e| e >= first);
                drop(others);
                match (second, third) {
                    _ if !lowest => {}
                    (None, _) => self.report.open_ends += 1,
                    (Some(second), None) if self.smooth(segments, first, second) => self.report.smooth_joints += 1,
                    _ => {
                        self.report.corners += 1;
                        let mut e = first;
                        while let Some(end) = end_mut(segments, e) {
                            if end.kind == JointKind::Corner {
                                break;
                            }
                            end.kind = JointKind::Corner;
                            e = end.next;
                        }
                    }
                }
            }
        }
    }

    /// Makes a joint of two ends smooth if it turns little and both branches have handles there.
    fn smooth(&mut self, segments: &mut [Segment<S>], a: EndId, b: EndId) -> bool {
        let (Some(ea), Some(eb)) = (end_ref(segments, a), end_ref(segments, b)) else { return false };
        let (ua, ub) = (ea.leaving.clone(), eb.leaving.clone());
        if ea.retracted || eb.retracted {
            return false;
        }
        let sine = ua.cross(&ub).abs();
        if ua.dot(&ub) >= S::zero() || sine >= self.options.corner_sine {
            return false;
        }
        let Some(u) = ub.minus(&ua).unit() else { return false };
        let (Some(ha), Some(hb)) = (handle_length(segments, a), handle_length(segments, b)) else { return false };
        // Turning a handle of length h by half the kink moves the curve by at most 4/9 of h · kink/2. A kink below 1° and
        // its sine agree to 5e-5.
        let moved = ha.max(hb) * &sine * &S::ratio(2, 9);
        if moved > self.options.displacement.clone() * self.diagonal {
            return false;
        }
        if sine > S::unit_roundoff().mul_pow2(6) {
            self.report.smoothed += 1;
        }
        if moved > self.report.displacement {
            self.report.displacement = moved;
        }
        turn_handle(segments, a, u.opposite());
        turn_handle(segments, b, u);
        true
    }
}

fn segments_point<S: Scalar>(segments: &[Segment<S>], e: Option<EndId>) -> Option<Point<S>> {
    let e = e?;
    segments.get(e.segment() as usize).map(|s| s.end_point(e.side()).clone())
}

fn set_end_point<S: Scalar>(segments: &mut [Segment<S>], e: EndId, p: Point<S>) {
    if let Some(s) = segments.get_mut(e.segment() as usize) {
        s.cubic.move_end(e.side(), p);
        s.power = s.cubic.power_basis();
    }
}

/// Splices the lists of two ends into one; false if they were one already.
fn unite<S>(segments: &mut [Segment<S>], a: EndId, b: EndId) -> bool {
    let (a, b) = (obstacle_end(segments, a), obstacle_end(segments, b));
    // A list that holds b when walked from b's side is usually one entry long: walk that one.
    if a == b || members_of(segments, b).any(|e| e == a) {
        return false;
    }
    let (Some(na), Some(nb)) = (end_ref(segments, a).map(|e| e.next), end_ref(segments, b).map(|e| e.next)) else {
        return false;
    };
    if let Some(e) = end_mut(segments, a) {
        e.next = nb;
    }
    if let Some(e) = end_mut(segments, b) {
        e.next = na;
    }
    true
}

/// The end of an open path, earlier in `order` than end `i`, that lies within `short` of p.
fn near_earlier_end<S: Scalar>(
    segments: &[Segment<S>],
    order: &[u32],
    i: u32,
    p: &Point<S>,
    short: &S,
    ends: &impl Fn(u32) -> Option<EndId>,
    cell_of: &impl Fn(&Point<S>) -> (i64, i64),
) -> Option<EndId> {
    let cell_at = |n: usize| {
        let &j = order.get(n)?;
        let q = segments_point(segments, ends(j))?;
        Some((cell_of(&q), j))
    };
    let own = cell_of(p);
    for dx in -1..=1_i64 {
        for dy in -1..=1_i64 {
            let cell = (own.0.saturating_add(dx), own.1.saturating_add(dy));
            let mut n = order.partition_point(|&j| {
                segments_point(segments, ends(j)).is_some_and(|q| cell_of(&q).cmp(&cell) == Ordering::Less)
            });
            while let Some((c, j)) = cell_at(n) {
                if c != cell || (c, j) >= (own, i) {
                    break;
                }
                if let Some(e) = ends(j)
                    && segments_point(segments, Some(e)).is_some_and(|q| q.distance(p) <= *short)
                {
                    return Some(e);
                }
                n += 1;
            }
        }
    }
    None
}

fn handle_length<S: Scalar>(segments: &[Segment<S>], e: EndId) -> Option<S> {
    let [a, b, c, d] = &segments.get(e.segment() as usize)?.cubic.points;
    Some(if e.side() == 0 { a.distance(b) } else { d.distance(c) })
}

/// Turns the handle at an end into a direction, keeping its length.
fn turn_handle<S: Scalar>(segments: &mut [Segment<S>], e: EndId, leaving: Vector<S>) {
    let Some(h) = handle_length(segments, e) else { return };
    if let Some(s) = segments.get_mut(e.segment() as usize) {
        let [a, b, c, d] = &mut s.cubic.points;
        if e.side() == 0 {
            *b = a.plus_scaled(&h, &leaving);
        } else {
            *c = d.plus_scaled(&h, &leaving);
        }
    }
    if let Some(end) = end_mut(segments, e) {
        end.kind = JointKind::Smooth;
        end.leaving = leaving;
    }
}
