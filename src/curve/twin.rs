//! Cubics that the drawing repeats: one obstacle, not two.
//!
//! A stroke drawn twice (a fill and its outline, say) would make the local feature size zero all along it. Segments with
//! the same control points, in the same or the opposite order, are found by sorting; the first of each group stands for
//! all.

use super::{Segment, Twin};
use crate::geometry::Point;
use crate::order::sort;
use crate::scalar::Scalar;
use core::cmp::Ordering;

/// Marks every segment that repeats an earlier one. `order` is scratch with one entry a segment.
pub(super) fn mark<S: Scalar>(segments: &mut [Segment<S>], order: &mut [u32]) {
    for (slot, i) in order.iter_mut().zip(0_u32..) {
        *slot = i;
    }
    sort(order, |&a, &b| match (segments.get(a as usize), segments.get(b as usize)) {
        (Some(x), Some(y)) => compare(x, y).then(a.cmp(&b)) == Ordering::Less,
        _ => a < b,
    });
    let mut leader: Option<u32> = None;
    for &i in order.iter() {
        let same = leader.and_then(|l| {
            let (x, y) = (segments.get(l as usize)?, segments.get(i as usize)?);
            (compare(x, y) == Ordering::Equal).then(|| Twin::new(l, backwards(x) != backwards(y)))
        });
        match same {
            Some(twin) => {
                if let Some(s) = segments.get_mut(i as usize) {
                    s.twin = Some(twin);
                }
            }
            None => leader = Some(i),
        }
    }
}

/// A twin is the same curve as the segment that stands for it, to the bit, and its ends are of the same kinds.
pub(super) fn follow<S: Scalar>(segments: &mut [Segment<S>]) {
    for i in 0..segments.len() {
        let Some(t) = segments.get(i).and_then(|s| s.twin) else { continue };
        let Some(leader) = segments.get(t.segment() as usize) else { continue };
        let (cubic, ends) = if t.reversed() {
            let [a, b] = leader.ends.clone();
            (leader.cubic.reversed(), [b, a])
        } else {
            (leader.cubic.clone(), leader.ends.clone())
        };
        if let Some(s) = segments.get_mut(i) {
            s.cubic = cubic;
            s.ends = ends;
        }
    }
}

fn compare_points<S: Scalar>(a: &Point<S>, b: &Point<S>) -> Ordering {
    let by = |x: &S, y: &S| x.partial_cmp(y).unwrap_or(Ordering::Equal);
    by(&a.x, &b.x).then(by(&a.y, &b.y))
}

/// Whether the canonical direction (the lexicographically smaller list of points) is the opposite one.
fn backwards<S: Scalar>(s: &Segment<S>) -> bool {
    let [a, b, c, d] = &s.cubic.points;
    compare_points(d, a).then(compare_points(c, b)) == Ordering::Less
}

/// Compares canonical lists of control points.
fn compare<S: Scalar>(x: &Segment<S>, y: &Segment<S>) -> Ordering {
    let pick = |s: &Segment<S>, flip: bool, k: usize| {
        let [a, b, c, d] = s.cubic.points.clone();
        match (k, flip) {
            (0, false) | (3, true) => a,
            (1, false) | (2, true) => b,
            (2, false) | (1, true) => c,
            _ => d,
        }
    };
    let (fx, fy) = (backwards(x), backwards(y));
    (0..4).map(|k| compare_points(&pick(x, fx, k), &pick(y, fy, k))).find(|o| o.is_ne()).unwrap_or(Ordering::Equal)
}
