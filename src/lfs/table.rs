//! lfs from a table: another program has computed it at places along C, and this one answers between them.
//!
//! Each segment of C has a *column*: values at n + 1 equal steps of its parameter. Let none of them be above lfs at its place.
//! lfs is 1-Lipschitz, so lfs(p) ≥ v − |p − q| for the value v at q, and the larger of what the two neighbours say is
//! answered: **never above lfs**, up to rounding, wherever p is. What is lost is at most twice the distance to the nearer of
//! the two places, and that distance where lfs does not change.
//!
//! **Samples from a table are true ε-samples**, though its values may be rounded down one by one and the answer may then jump
//! at their places. Let g(p) be the largest of lfs(q) − |p − q| over all places q of the table. It is 1-Lipschitz, at most lfs,
//! and at least the answer. The sampler marches by steps that could not pass a zero of |p − s| − ε·g(p), because for its
//! smaller size they are shorter still, and stops where the condition holds for that smaller size.
//!
//! A value of 0 (a corner, a segment without a column) leaves the sampler its floor. A look-up evaluates a cubic twice. On a
//! twin the column of the segment counts that it repeats. [`super::gather`] fills a table from a medial walk.

use super::FeatureSize;
use crate::curve::{Curve, CurveParam};
use crate::geometry::Point;
use crate::scalar::Scalar;

/// The values of one segment: a part of the list of all values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// Index of the first value, at t = 0.
    pub first: u32,
    /// How many there are: one more than steps.
    pub count: u32,
}

impl Column {
    /// The parameter of the value k: k steps of equal length.
    pub fn parameter<S: Scalar>(&self, k: u32) -> S {
        let int = |n: u32| S::int(i32::try_from(n).unwrap_or(i32::MAX));
        let steps = self.count.saturating_sub(1).max(1);
        if k >= steps { S::one() } else { int(k) / &int(steps) }
    }

    /// The step that holds a parameter.
    pub(super) fn step<S: Scalar>(&self, t: &S) -> u32 {
        let steps = self.count.saturating_sub(1);
        let at = (t.clone() * &S::int(i32::try_from(steps).unwrap_or(i32::MAX))).to_i64();
        u32::try_from(at.max(0)).unwrap_or(u32::MAX).min(steps.saturating_sub(1))
    }
}

/// A table of lfs, borrowed. `value` reads the list of all values, in whatever form it is kept.
#[derive(Clone, Copy, Debug)]
pub struct LfsTable<'a, S, V> {
    curve: &'a Curve<'a, S>,
    columns: &'a [Column],
    value: V,
}

impl<'a, S: Scalar, V: Fn(u32) -> S> LfsTable<'a, S, V> {
    /// The table of a curve: a column a segment.
    pub const fn new(curve: &'a Curve<'a, S>, columns: &'a [Column], value: V) -> Self {
        Self { curve, columns, value }
    }

    /// What the value k of a column says of the point p.
    fn told(&self, segment: u32, column: &Column, k: u32, p: &Point<S>) -> S {
        let q = self.curve.point(&CurveParam { segment, t: column.parameter(k) });
        q.map_or_else(S::zero, |q| (self.value)(column.first.saturating_add(k)) - &q.distance(p))
    }
}

impl<S: Scalar, V: Fn(u32) -> S> FeatureSize<S> for LfsTable<'_, S, V> {
    fn lfs(&self, at: &CurveParam<S>, p: &Point<S>) -> S {
        let twin = self.curve.segment(at.segment).and_then(|s| s.twin);
        let CurveParam { segment, t } = twin.map_or_else(|| at.clone(), |twin| twin.place(at.t.clone()));
        let Some(column) = self.columns.get(segment as usize).filter(|c| c.count > 1) else { return S::zero() };
        let k = column.step(&t);
        let (before, after) = (self.told(segment, column, k, p), self.told(segment, column, k + 1, p));
        before.max(after).max(S::zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Cubic;
    use crate::curve::given;

    /// lfs of a place: its distance from the point (1, 2), for example.
    fn truth(p: &Point<f64>) -> f64 {
        p.distance(&Point::new(1.0, 2.0))
    }

    #[test]
    fn never_above_and_short_by_no_more_than_the_distance_to_a_place() {
        let p = Point::new;
        let cubic = Cubic::new(p(0.0, 0.0), p(2.0, 1.0), p(-1.0, 1.5), p(3.0, 0.5));
        let segments = [given::segment(0, 0, cubic, [false; 2])];
        let extent = given::Extent::of(&segments);
        let curve = Curve {
            segments: &segments,
            sources: &[],
            paths: &[],
            arcs: &[],
            nodes: &[],
            leaf: 1,
            diagonal: &extent.diagonal,
            noise: &extent.noise,
        };
        for steps in [1_u32, 2, 7, 64] {
            let column = Column { first: 3, count: steps + 1 };
            let place = |k: u32| curve.point(&CurveParam { segment: 0, t: column.parameter(k) }).unwrap();
            let columns = [column];
            let table = LfsTable::new(&curve, &columns, |k| truth(&place(k - 3)));
            for n in 0..=1000 {
                let at = CurveParam { segment: 0, t: f64::from(n) / 1000.0 };
                let q = curve.point(&at).unwrap();
                let (told, lfs) = (table.lfs(&at, &q), truth(&q));
                let near = (0..=steps).map(|k| place(k).distance(&q)).fold(f64::INFINITY, f64::min);
                assert!(told <= lfs + 1e-14, "{told} is above {lfs}");
                assert!(told >= lfs - 2.0 * near - 1e-14, "{told} for {lfs} at {near} from a place");
            }
            let outside = CurveParam { segment: 0, t: 2.0 };
            assert!(table.lfs(&outside, &place(steps)) <= truth(&place(steps)) + 1e-14);
            let elsewhere = CurveParam { segment: 1, t: 0.5 };
            assert!(table.lfs(&elsewhere, &place(0)) <= 0.0, "a segment without a column has a floor and no more");
        }
    }
}
