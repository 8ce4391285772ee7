//! C as another program's door has made it.
//!
//! A plotter's controller needs no door of its own: its host sends the cubics of C, as they are once strokes are snapped,
//! split and smoothed, and says where the corners are. [`segment`] makes a [`Segment`] of each. That serves the sampler
//! ([`crate::sampling`]), which goes along paths from corner to corner.
//!
//! **Medial axis and touchings** need more, and it follows from the cubics as they come: [`join`] finds what the last one
//! meets or repeats, by comparing it with those before; [`arc`] and [`cut`] make its arcs, at parameters that the host has
//! found ([`arc::cut`](super::arc::cut)); [`finish`], once all are there, gives joints their kinds, and makes strands and the
//! hierarchy. Ends meet where their points are equal to the bit, which is how a door leaves them. The result is the curve
//! that the door had made, but for ends that happen to lie on a joint of other strokes: they are members of it here.

use super::joint::{end_mut, end_ref, members_of};
use super::{ArcStart, EndId, JointEnd, JointKind, Segment, Twin, index_of, strands, twin};
use crate::bezier::Cubic;
use crate::buffer::{BufferFull, Store};
use crate::geometry::hierarchy::{Item, Node};
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

/// Joins the last segment to those before it. Compares it with each of them: O(n), and no other work.
///
/// Ends at equal points meet. A cubic that repeats an earlier one, in either direction, becomes its twin.
pub fn join<S: Scalar>(segments: &mut [Segment<S>]) {
    let Some((segment, before)) = segments.split_last_mut() else { return };
    let index = index_of(before.len());
    let reversed = segment.cubic.reversed();
    for (k, other) in (0..).zip(before.iter()).filter(|(_, s)| s.twin.is_none()) {
        let same = other.cubic == segment.cubic;
        if same || other.cubic == reversed {
            segment.twin = Some(Twin::new(k, !same));
            return;
        }
    }
    for side in 0..2 {
        let p = segment.end_point(side).clone();
        let meets = |s: &Segment<S>, own: usize| s.twin.is_none() && *s.end_point(own) == p;
        let met = before.iter_mut().filter(|s| s.twin.is_none()).find_map(|s| {
            let own = [0, 1].into_iter().find(|&own| meets(s, own))?;
            s.ends.get_mut(own)
        });
        let next = match met {
            Some(end) => core::mem::replace(&mut end.next, EndId::new(index, side)),
            // A loop: its start is alone, or in a list already.
            None if side == 1 && *segment.cubic.start() == p => {
                core::mem::replace(&mut segment.ends[0].next, EndId::new(index, side))
            }
            None => continue,
        };
        segment.ends[side].next = next;
    }
}

/// Gives the last segment its arc, from end to end; none to a twin.
///
/// # Errors
/// [`BufferFull`] where `arcs` cannot take it.
pub fn arc<S: Scalar>(segments: &mut [Segment<S>], arcs: &mut impl Store<ArcStart<S>>) -> Result<(), BufferFull> {
    let index = index_of(segments.len()).saturating_sub(1);
    let Some(segment) = segments.last_mut() else { return Ok(()) };
    segment.arcs = (index_of(arcs.items().len()), 0);
    if segment.twin.is_none() {
        arcs.push(ArcStart { segment: index, t: S::zero(), turn: S::zero() })?;
        segment.arcs.1 = 1;
    }
    Ok(())
}

/// Cuts the last arc of the last segment at a parameter; `false` where that is not inside of it, or there is no arc.
///
/// # Errors
/// [`BufferFull`] where `arcs` cannot take one more.
pub fn cut<S: Scalar>(
    segments: &mut [Segment<S>],
    arcs: &mut impl Store<ArcStart<S>>,
    t: S,
) -> Result<bool, BufferFull> {
    let (Some(segment), Some(last)) = (segments.last_mut(), arcs.items().last()) else { return Ok(false) };
    // What is not a number does not fit either.
    let fits = t > last.t && t < S::one();
    if segment.arcs.1 == 0 || !fits {
        return Ok(false);
    }
    let rest = ArcStart { t, ..last.clone() };
    arcs.push(rest)?;
    segment.arcs.1 += 1;
    Ok(true)
}

/// Makes one curve of segments that have been joined and cut: kinds of joints, strands, and the hierarchy over arcs, of which
/// `leaf` in a row share a leaf. `items` is scratch, one entry a leaf. The fields of [`Curve`](super::Curve) are then what
/// was given, `leaf` and [`Extent`].
///
/// # Errors
/// [`BufferFull`] where a store cannot take its entries.
pub fn finish<S: Scalar>(
    segments: &mut [Segment<S>],
    arcs: &mut [ArcStart<S>],
    leaf: u32,
    items: &mut impl Store<Item<S>>,
    nodes: &mut impl Store<Node<S>>,
) -> Result<(), BufferFull> {
    for first in (0..index_of(2 * segments.len())).map(|k| EndId::new(k >> 1, (k & 1) as usize)) {
        if segments.get(first.segment() as usize).is_none_or(|s| s.twin.is_some()) {
            continue;
        }
        let kind = kind_of(segments, first);
        let second = end_ref(segments, first).map(|end| end.next).filter(|second| first < *second);
        // One tangent line, as the door would have it.
        if kind == JointKind::Smooth
            && let Some(second) = second
            && let (Some(a), Some(b)) = (end_ref(segments, first), end_ref(segments, second))
            && let Some(u) = b.leaving.minus(&a.leaving).unit()
        {
            set_leaving(segments, first, u.opposite());
            set_leaving(segments, second, u);
        }
        if let Some(end) = end_mut(segments, first) {
            end.kind = kind;
        }
    }
    twin::follow(segments);
    strands::number(segments, arcs);
    super::arc::enclose(segments, arcs, leaf, items, nodes)
}

/// Two ends that are no corners are smooth, one is open; everything else is a corner.
fn kind_of<S: Scalar>(segments: &[Segment<S>], first: EndId) -> JointKind {
    let sharp = |e: EndId| end_ref(segments, e).is_some_and(|e| e.kind == JointKind::Corner || e.retracted);
    let mut others = members_of(segments, first).skip(1);
    match (others.next(), others.next()) {
        (None, _) => JointKind::Open,
        (Some(second), None) if !sharp(first) && !sharp(second) => JointKind::Smooth,
        _ => JointKind::Corner,
    }
}

fn set_leaving<S>(segments: &mut [Segment<S>], e: EndId, leaving: Vector<S>) {
    if let Some(end) = end_mut(segments, e) {
        end.leaving = leaving;
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
        turn: S::zero(),
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
