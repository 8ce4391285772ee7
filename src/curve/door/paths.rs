//! Steps 2 to 4 of the door: from one path of the drawing to segments.
//!
//! Short segments are dropped and their neighbours snapped together (a handle moves with its end), paths are closed, straight cubics become lines of
//! uniform speed from each point where they turn back to the next, cubics with an exact cusp are split there.

use super::{CurveError, Door, PathInput, index_of};
use crate::bezier::{Cubic, PowerBasis, critical};
use crate::buffer::Store;
use crate::curve::{Path, Segment, Source, given};
use crate::geometry::Point;
use crate::polynomial::Polynomial;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

impl<S: Scalar> Door<'_, S> {
    /// Steps 2 to 4 for one path.
    pub(super) fn take_path(
        &mut self,
        index: u32,
        input: &PathInput<'_, S>,
        segments: &mut impl Store<Segment<S>>,
        sources: &mut impl Store<Source<S>>,
        paths: &mut impl Store<Path>,
    ) -> Result<(), CurveError> {
        let first = segments.items().len();
        let short = self.short();
        let path = index_of(paths.items().len());
        let mut last: Option<Point<S>> = None;
        for (k, cubic) in input.cubics.iter().enumerate() {
            let k = index_of(k);
            if let Some(end) = &last
                && end.distance(cubic.start()) > short
            {
                return Err(CurveError::Disconnected { path: index, segment: k });
            }
            if length_of_polygon(cubic) < short {
                self.report.dropped += 1;
                // The chain of dropped pieces must not drift: `last` stays where the last kept segment ends, but a run of
                // them that leads away from it is a gap.
                if last.is_none() {
                    last = Some(cubic.start().clone());
                }
                continue;
            }
            let mut cubic = cubic.clone();
            if segments.items().len() > first
                && let Some(end) = &last
            {
                self.note_snap(end, cubic.start());
                cubic.move_end(0, end.clone());
            }
            last = Some(cubic.end().clone());
            self.take_cubic(path, k, cubic, segments, sources)?;
        }
        let count = segments.items().len() - first;
        if count == 0 {
            if !input.cubics.is_empty() {
                self.report.vanished += 1;
            }
            return Ok(());
        }
        let closed = self.close(path, input, first, segments, sources)?;
        let count = index_of(segments.items().len() - first);
        paths.push(Path { source: index, first: index_of(first), count, closed })?;
        Ok(())
    }

    /// Step 3: is the path closed, and with what.
    fn close(
        &mut self,
        path: u32,
        input: &PathInput<'_, S>,
        first: usize,
        segments: &mut impl Store<Segment<S>>,
        sources: &mut impl Store<Source<S>>,
    ) -> Result<bool, CurveError> {
        let Some((start, end)) = segments
            .items()
            .get(first)
            .zip(segments.items().last())
            .map(|(a, b)| (a.cubic.start().clone(), b.cubic.end().clone()))
        else {
            return Ok(false);
        };
        if start.distance(&end) <= self.short() {
            self.note_snap(&start, &end);
            if let Some(last) = segments.items_mut().last_mut() {
                last.cubic.move_end(1, start);
                last.power = last.cubic.power_basis();
            }
            if !input.closed {
                self.report.closed += 1;
            }
            return Ok(true);
        }
        if input.closed {
            let k = index_of(input.cubics.len());
            self.take_cubic(path, k, Cubic::line(end, start), segments, sources)?;
            self.report.closing_lines += 1;
        }
        Ok(input.closed)
    }

    /// Step 4: a straight cubic becomes lines, a cusped one two cubics.
    fn take_cubic(
        &mut self,
        path: u32,
        source: u32,
        mut cubic: Cubic<S>,
        segments: &mut impl Store<Segment<S>>,
        sources: &mut impl Store<Source<S>>,
    ) -> Result<(), CurveError> {
        if let Some(along) = self.straight(&cubic) {
            return self.take_straight(path, source, &cubic, along, segments, sources);
        }
        // Handles that rounding left over point anywhere, and would hook the curve at a scale below every floor.
        let left_over = self.nothing() * &S::int(100);
        for (near, far) in [(0, 1), (3, 2)] {
            if let (Some(a), Some(b)) = (cubic.points.get(near).cloned(), cubic.points.get_mut(far))
                && a.distance(b) < left_over
            {
                *b = a;
            }
        }
        let power = cubic.power_basis();
        let mut from = S::zero();
        let mut rest = cubic.clone();
        for t in critical::slowest(&power) {
            if !self.is_cusp(&cubic, &power, &t, &from) {
                continue;
            }
            let inner = (t.clone() - &from) / &(S::one() - &from);
            let (mut left, mut right) = rest.split_at(&inner);
            // The derivative is nothing at the cusp: make it exactly so.
            left.points[2] = left.points[3].clone();
            right.points[1] = right.points[0].clone();
            let window = Source { segment: source, from, to: t.clone(), handles: None };
            Self::add(path, window, left, segments, sources)?;
            self.report.cusps += 1;
            from = t;
            rest = right;
        }
        Self::add(path, Source { segment: source, from, to: S::one(), handles: None }, rest, segments, sources)
    }

    /// A cusp in the open interval (from, 1): so slow that the circle of curvature is below every floor.
    fn is_cusp(&self, cubic: &Cubic<S>, power: &PowerBasis<S>, t: &S, from: &S) -> bool {
        let margin = S::ratio(1, 1000);
        if *t < from.clone() + &margin || *t > S::one() - &margin {
            return false;
        }
        let speed_sq = power.derivative(t).norm_sq();
        let acceleration = power.second_derivative(t).norm();
        let size = length_of_polygon(cubic);
        acceleration > S::zero() && speed_sq <= self.nothing() * &acceleration.min(size)
    }

    fn add(
        path: u32,
        source: Source<S>,
        cubic: Cubic<S>,
        segments: &mut impl Store<Segment<S>>,
        sources: &mut impl Store<Source<S>>,
    ) -> Result<(), CurveError> {
        segments.push(given::bare(index_of(segments.items().len()), path, cubic))?;
        Ok(sources.push(source)?)
    }

    /// The positions of the control points of a straight cubic along its line, the first at 0.
    fn straight(&self, cubic: &Cubic<S>) -> Option<[S; 4]> {
        let [a, b, c, d] = &cubic.points;
        let inner = [b.minus(a), c.minus(a), d.minus(a)];
        let mut longest = &inner[2];
        for v in &inner[..2] {
            if v.norm_sq() > longest.norm_sq() {
                longest = v;
            }
        }
        if longest.norm() <= self.nothing() {
            return None;
        }
        let line = longest.unit()?;
        let off = inner.iter().fold(S::zero(), |m, v| m.max(v.cross(&line).abs()));
        // Control points that were rounded lie off the line by a few roundoffs of the coordinates.
        let largest = [a, b, c, d].iter().fold(S::zero(), |m, p| m.max(p.x.clone().abs()).max(p.y.clone().abs()));
        if off > largest * &S::unit_roundoff().mul_pow2(3) {
            return None;
        }
        let [x1, x2, x3] = inner.map(|v| v.dot(&line));
        Some([S::zero(), x1, x2, x3])
    }

    /// A straight cubic: a line of uniform speed from each point where it turns back to the next.
    fn take_straight(
        &mut self,
        path: u32,
        source: u32,
        cubic: &Cubic<S>,
        along: [S; 4],
        segments: &mut impl Store<Segment<S>>,
        sources: &mut impl Store<Source<S>>,
    ) -> Result<(), CurveError> {
        let turns = turning_points(&along);
        let short = self.short();
        let mut start = cubic.start().clone();
        let mut from = S::zero();
        let mut pieces = 0;
        for to in turns.into_iter().chain([S::one()]) {
            let last = to >= S::one();
            let end = if last { cubic.end().clone() } else { cubic.eval(&to) };
            // A hook shorter than any segment is none, unless nothing else is left of the cubic.
            if start.distance(&end) < short && !(last && pieces == 0) {
                if last && let Some(before) = segments.items_mut().last_mut() {
                    before.cubic = Cubic::line(before.cubic.start().clone(), end);
                    before.power = before.cubic.power_basis();
                }
                from = to;
                continue;
            }
            let [y0, y1, y2, y3] = window(&along, &from, &to);
            let length = y3 - &y0;
            let alpha = (y1 - &y0) / &length;
            let beta = (y2 - &y0) / &length;
            let third = S::ratio(1, 3);
            let uniform = (alpha.clone() - &third).abs().max((beta.clone() - &third.twice()).abs())
                <= S::unit_roundoff().mul_pow2(4);
            if !uniform {
                self.report.straightened += 1;
            }
            let handles = (!uniform).then_some([alpha, beta]);
            if pieces > 0 {
                self.report.cusps += 1;
            }
            let piece = Source { segment: source, from, to: to.clone(), handles };
            Self::add(path, piece, Cubic::line(start, end.clone()), segments, sources)?;
            pieces += 1;
            start = end;
            from = to;
        }
        Ok(())
    }
}

/// Control values of the window [from, to] of a cubic in Bernstein form, by blossoming.
fn window<S: Scalar>(x: &[S; 4], from: &S, to: &S) -> [S; 4] {
    let mix = |a: &S, b: &S, t: &S| (S::one() - t) * a + &(b.clone() * t);
    let blossom = |r: &S, s: &S, t: &S| {
        let [a, b, c, d] = x;
        let (p, q, r) = (mix(a, b, r), mix(b, c, r), mix(c, d, r));
        let (p, q) = (mix(&p, &q, s), mix(&q, &r, s));
        mix(&p, &q, t)
    };
    [blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)]
}

/// Where a cubic along a line turns back, ascending, in (0, 1).
fn turning_points<S: Scalar>(x: &[S; 4]) -> ArrayVec<S, 2> {
    let [x0, x1, x2, x3] = x;
    let (d0, d1, d2) = (x1.clone() - x0, x2.clone() - x1, x3.clone() - x2);
    let speed = Polynomial::new([d0.clone(), (d1.clone() - &d0).twice(), d2 - &d1.twice() + &d0]);
    let mut turns = ArrayVec::new();
    let roots: ArrayVec<S, 2> = critical::roots(speed.coefficients.clone());
    let mut before = S::zero();
    for (i, t) in roots.iter().enumerate() {
        let after = roots.get(i + 1).cloned().unwrap_or_else(S::one);
        let (left, right) = (S::midpoint(&before, t), S::midpoint(t, &after));
        before = t.clone();
        let turns_back = (speed.eval(&left) > S::zero()) != (speed.eval(&right) > S::zero());
        if turns_back && *t > S::zero() && *t < S::one() && turns.try_push(t.clone()).is_err() {
            break;
        }
    }
    turns
}

/// Length of the control polygon: at least the curve's.
fn length_of_polygon<S: Scalar>(cubic: &Cubic<S>) -> S {
    let [a, b, c, d] = &cubic.points;
    a.distance(b) + &b.distance(c) + &c.distance(d)
}
