//! Strands, and the turning along them (step 8 of the door).
//!
//! A strand is a maximal chain of smoothly joined segments, open or a loop. Each arc knows how far the strand has turned
//! where it starts and ends: that tells which pieces of curve are local to each other, without distances.

use super::joint::end_ref;
use super::{Arc, ArcStart, EndId, JointKind, Segment, arc, index_of};
use crate::scalar::Scalar;

/// The strand that follows a segment left through an end: the other end of a smooth joint.
fn smooth_neighbour<S>(segments: &[Segment<S>], e: EndId) -> Option<EndId> {
    let end = end_ref(segments, e)?;
    (end.kind == JointKind::Smooth).then_some(end.next)
}

/// Numbers the strands and accumulates turning along them.
pub(super) fn number<S: Scalar>(segments: &mut [Segment<S>], arcs: &mut [ArcStart<S>]) {
    let total = index_of(segments.len());
    let mut strands = 0;
    for i in 0..total {
        if segments.get(i as usize).is_none_or(|s| s.strand != u32::MAX || s.twin.is_some()) {
            continue;
        }
        // Back to where the strand begins, or once around its loop.
        let mut begin = EndId::new(i, 0);
        let mut closed = false;
        for _ in 0..total {
            let Some(before) = smooth_neighbour(segments, begin) else { break };
            begin = before.opposite();
            if begin == EndId::new(i, 0) {
                closed = true;
                break;
            }
        }
        let mut turn = S::zero();
        let mut entry = begin;
        for _ in 0..total {
            let k = entry.segment() as usize;
            let forwards = entry.side() == 0;
            if let Some(s) = segments.get_mut(k) {
                s.strand = strands;
                let (first, count) = s.arcs;
                if !forwards {
                    s.turn = turn.clone();
                }
                for n in 0..count {
                    let index = first + if forwards { n } else { count - 1 - n };
                    let end = arc::end(arcs, index);
                    let Some(start) = arcs.get_mut(index as usize) else { break };
                    let span = [start.t.clone(), end];
                    let after = Arc { segment: start.segment, span, turn: [S::zero(), S::zero()] }.turning(s) + &turn;
                    let before = core::mem::replace(&mut turn, after);
                    start.turn = if forwards { before } else { turn.clone() };
                }
                if forwards {
                    s.turn = turn.clone();
                }
            }
            match smooth_neighbour(segments, entry.opposite()) {
                Some(next) if next != begin => entry = next,
                _ => break,
            }
        }
        if closed {
            let mut entry = begin;
            for _ in 0..total {
                if let Some(s) = segments.get_mut(entry.segment() as usize) {
                    s.loop_turn = turn.clone();
                }
                match smooth_neighbour(segments, entry.opposite()) {
                    Some(next) if next != begin => entry = next,
                    _ => break,
                }
            }
        }
        strands += 1;
    }
}
