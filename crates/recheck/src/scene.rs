//! C\* and trees of boxes: what all claims are evaluated on.

use feature_sampling::curve::ideal::{Enclosed, IdealSegment, Outgoing, coefficients};
use feature_sampling::curve::{Curve, EndId};

use crate::bernstein::Real;
use crate::feet::box_of;

/// Each segment is an obstacle in so many stretches.
const STRETCHES: u32 = 8;

/// C\* with the stretches that it is made of.
pub(crate) struct Scene<'c> {
    pub(crate) curve: Curve<'c, f64>,
    ideal: Vec<IdealSegment<f64>>,
    /// All of C but repetitions: segment, first and last parameter.
    pub(crate) stretches: Vec<(u32, [f64; 2])>,
    pub(crate) obstacles: BoxTree,
}

impl<'c> Scene<'c> {
    pub(crate) fn new(curve: Curve<'c, f64>) -> Self {
        let mut ideal = Vec::new();
        // A vector is never full.
        let _ = coefficients(&curve, &mut ideal);
        let mut scene = Self { curve, ideal, stretches: Vec::new(), obstacles: BoxTree::default() };
        for (segment, index) in curve.segments.iter().zip(0..) {
            if segment.twin.is_none() {
                let at = |k: u32| f64::from(k) / f64::from(STRETCHES);
                scene.stretches.extend((0..STRETCHES).map(|k| (index, [at(k), at(k + 1)])));
            }
        }
        let boxes: Vec<Box2> = scene.stretches.iter().map(|(segment, span)| scene.bounds(*segment, *span)).collect();
        scene.obstacles = BoxTree::new(&boxes);
        scene
    }

    /// A segment seen from one of its ends.
    pub(crate) fn from(&self, end: EndId) -> Option<&Outgoing<f64>> {
        self.ideal.get(end.segment() as usize).map(|s| s.from(end.side()))
    }

    /// Ends of a segment, but not this one, at its very point. They need not be joined.
    pub(crate) fn at_point_of(&self, near: EndId, segment: u32) -> impl Iterator<Item = EndId> {
        let point = self.curve.end_point(near);
        [0, 1]
            .map(|side| EndId::new(segment, side))
            .into_iter()
            .filter(move |&e| e != near && point.is_some() && self.curve.end_point(e) == point)
    }

    /// A box around a stretch of a segment; everything where there is none.
    pub(crate) fn bounds(&self, segment: u32, [a, b]: [f64; 2]) -> Box2 {
        let Some(o) = self.from(EndId::new(segment, 0)) else { return Box2::EVERYTHING };
        Box2::of(&box_of(o, Real::point(a), Real::point(b)))
    }
}

/// A box in plain numbers: x and y, least and most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Box2 {
    low: [f64; 2],
    high: [f64; 2],
}

impl Box2 {
    const EVERYTHING: Self = Self { low: [f64::NEG_INFINITY; 2], high: [f64::INFINITY; 2] };

    pub(crate) fn of(v: &Enclosed<f64>) -> Self {
        Self { low: [*v.x.lo(), *v.y.lo()], high: [*v.x.hi(), *v.y.hi()] }
    }

    fn hull(self, other: Self) -> Self {
        let pick = |f: fn(f64, f64) -> f64, a: [f64; 2], b: [f64; 2]| [f(a[0], b[0]), f(a[1], b[1])];
        Self { low: pick(f64::min, self.low, other.low), high: pick(f64::max, self.high, other.high) }
    }

    /// At most the square of the distance from any point of one to any point of the other.
    pub(crate) fn distance_sq(&self, p: &Enclosed<f64>) -> f64 {
        let p = Self::of(p);
        let gap = |i: usize| (self.low[i] - p.high[i]).max(p.low[i] - self.high[i]).max(0.0);
        let (x, y) = (gap(0), gap(1));
        // Two differences, two squares and a sum are rounded: five roundoffs at most.
        (x * x + y * y) * (1.0 - 8.0 * f64::EPSILON)
    }
}

/// Boxes in a row and the boxes around runs of them.
#[derive(Debug, Default)]
pub(crate) struct BoxTree {
    /// The root is 1, the halves of k are 2k and 2k + 1; item i is `first` + i.
    nodes: Vec<Box2>,
    first: usize,
    count: usize,
}

impl BoxTree {
    pub(crate) fn new(boxes: &[Box2]) -> Self {
        let first = boxes.len().next_power_of_two();
        let nowhere = Box2 { low: [f64::INFINITY; 2], high: [f64::NEG_INFINITY; 2] };
        let mut nodes = vec![nowhere; 2 * first];
        nodes[first..first + boxes.len()].copy_from_slice(boxes);
        for k in (1..first).rev() {
            nodes[k] = nodes[2 * k].hull(nodes[2 * k + 1]);
        }
        Self { nodes, first, count: boxes.len() }
    }

    /// The items whose boxes may hold a point nearer to p than the root of `reach_sq`.
    pub(crate) fn near(&self, p: &Enclosed<f64>, reach_sq: f64, out: &mut Vec<usize>) {
        out.clear();
        if self.count == 0 {
            return;
        }
        let mut pending = vec![1];
        while let Some(k) = pending.pop() {
            let node = &self.nodes[k];
            // Written so that what is no number is never left out.
            if node.low[0] > node.high[0] || node.distance_sq(p) > reach_sq {
                continue;
            }
            if k >= self.first {
                out.push(k - self.first);
            } else {
                pending.extend([2 * k + 1, 2 * k]);
            }
        }
    }
}
