//! A proof that a stretch of an arc stays clear of another arc.
//!
//! Strokes that run side by side, an outline drawn twice with other handles say, are told apart by distances only where
//! the stretch is as short as their gap g. Their *hulls* part much sooner. A stretch of chord L and an arc beside it
//! bulge from the chord's direction by about κL²/6 each, so a line along the chord parts them once L² is below 3g/κ: for g
//! = 1e-6 of the radius of curvature the stretch may be a thousand times longer than the gap.
//!
//! The arc is first cut down to the slab across the chord in which the stretch lies. An arc that turns by little, with both
//! end tangents within 45° of the chord, is a graph over it, so the parameters where it enters and leaves the slab are found
//! by a bracket, whose outer end is taken. What remains and the stretch are then compared by their control points: all
//! of a cubic lies in their hull. Nothing is claimed where this does not apply.
//!
//! The proof is one of real numbers; its rounding is that of coordinates, for which the caller's margin must leave room.

use super::{Arc, Segment};
use crate::bezier::Cubic;
use crate::geometry::{Point, Vector};
use crate::scalar::Scalar;

/// A stretch of an arc, seen from its chord.
#[derive(Debug)]
pub(super) struct Stretch<S> {
    /// Where the chord starts.
    origin: Point<S>,
    /// The chord's direction.
    along: Vector<S>,
    across: Vector<S>,
    /// The stretch between these coordinates along the chord.
    slab: [S; 2],
    /// And between these across it.
    width: [S; 2],
}

impl<S: Scalar> Stretch<S> {
    /// The stretch of a segment between two of its parameters; `None` where it has no chord.
    pub(super) fn new(segment: &Segment<S>, from: &S, to: &S) -> Option<Self> {
        let piece = segment.cubic.part(from, to);
        let origin = piece.start().clone();
        let along = piece.end().minus(&origin).unit()?;
        let across = along.left();
        let slab = extent(&piece, &origin, &along);
        let width = extent(&piece, &origin, &across);
        Some(Self { origin, along, across, slab, width })
    }

    /// Proves that no point of the arc is nearer than `margin` to the stretch; `false` says nothing.
    pub(super) fn clear_of(&self, segment: &Segment<S>, arc: &Arc<S>, margin: &S) -> bool {
        let [from, to] = &arc.span;
        let [low, high] = [self.slab[0].clone() - margin, self.slab[1].clone() + margin];
        let ends = [segment.tangent(from), segment.tangent(to)];
        let slopes = ends.clone().map(|u| u.dot(&self.along));
        // Arcs turn one way. Where that is by less than a half turn, all tangents lie between those at the ends: within 45°
        // of the chord, whose cosine squared is a half.
        let [u, w] = ends;
        let forwards = slopes.iter().all(|c| *c > S::zero());
        let backwards = slopes.iter().all(|c| *c < S::zero());
        if u.dot(&w) < S::ratio(1, 2)
            || !(forwards || backwards)
            || slopes.into_iter().any(|c| c.square().twice() < S::one())
        {
            return false;
        }
        let place = |t: &S| segment.point(t).minus(&self.origin).dot(&self.along);
        // Where the arc, run through in the chord's direction, enters the slab and where it leaves it.
        let (first, last) = if forwards { (from, to) } else { (to, from) };
        if place(last) < low || place(first) > high {
            return true;
        }
        let slack = (high.clone() - &low).mul_pow2(-3);
        let enters = outside(first, last, &slack, |t| low.clone() - &place(t));
        let leaves = outside(last, first, &slack, |t| place(t) - &high);
        let (a, b) = if forwards { (enters, leaves) } else { (leaves, enters) };
        let width = extent(&segment.cubic.part(&a, &b), &self.origin, &self.across);
        width[0].clone() - &self.width[1] > *margin || self.width[0].clone() - &width[1] > *margin
    }
}

/// Where `excess` falls to 0 between `out` and `inn`, from the side where it is positive and no farther from 0 than `slack`;
/// `out` itself where it is not positive there.
fn outside<S: Scalar>(out: &S, inn: &S, slack: &S, excess: impl Fn(&S) -> S) -> S {
    let (mut out, mut inn) = (out.clone(), inn.clone());
    let (mut above, mut below) = (excess(&out), excess(&inn));
    if above <= S::zero() || below > S::zero() {
        return out;
    }
    // Arcs that turn little run almost evenly: aiming a little outside, the secant is there in a few steps.
    for step in 0..S::BITS {
        if above <= *slack {
            break;
        }
        let aim = above.clone() - &slack.clone().mul_pow2(-1);
        let secant = (inn.clone() - &out) * &aim / &(above.clone() - &below) + &out;
        let t = if step % 4 == 3 { S::midpoint(&out, &inn) } else { secant };
        let value = excess(&t);
        if value > S::zero() {
            (out, above) = (t, value);
        } else {
            (inn, below) = (t, value);
        }
    }
    out
}

/// Smallest and largest coordinate of the control points in a direction.
fn extent<S: Scalar>(cubic: &Cubic<S>, origin: &Point<S>, direction: &Vector<S>) -> [S; 2] {
    let mut range = [S::infinity(), -S::infinity()];
    for p in &cubic.points {
        let at = p.minus(origin).dot(direction);
        let [low, high] = range;
        range = [low.min(at.clone()), high.max(at)];
    }
    range
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment(points: [[f64; 2]; 4]) -> Segment<f64> {
        let cubic = Cubic { points: points.map(|[x, y]| Point::new(x, y)) };
        let power = cubic.power_basis();
        let mut segment = Segment { power, cubic, ..Segment::default() };
        let leaving = |d: Vector<f64>| d.unit().expect("a handle");
        segment.ends[0].leaving = leaving(segment.power.derivative(&0.0));
        segment.ends[1].leaving = leaving(segment.power.derivative(&1.0)).opposite();
        segment
    }

    fn whole() -> Arc<f64> {
        Arc { segment: 0, span: [0.0, 1.0], turn: [0.0, 0.0] }
    }

    /// A bow of radius about 10, lifted.
    fn bow(lift: f64) -> Segment<f64> {
        segment([[-2.0, lift], [-0.7, 0.26 + lift], [0.7, 0.26 + lift], [2.0, lift]])
    }

    #[test]
    fn a_bow_is_clear_of_one_beside_it_in_either_direction() {
        let stretch = Stretch::new(&bow(0.0), &0.4998, &0.5002).expect("a chord");
        let (near, touching) = (bow(1e-6), bow(5e-8));
        assert!(stretch.clear_of(&near, &whole(), &1e-7), "a gap of 1e-6");
        assert!(!stretch.clear_of(&touching, &whole(), &1e-7), "a gap below the margin");
        let mut back = near.cubic.points;
        back.reverse();
        assert!(stretch.clear_of(&segment(back.map(|p| [p.x, p.y])), &whole(), &1e-7), "the same, backwards");
    }

    #[test]
    fn what_crosses_or_stands_across_is_not_clear() {
        let stretch = Stretch::new(&bow(0.0), &0.4, &0.6).expect("a chord");
        let across = segment([[0.0, -1.0], [0.0, -0.3], [0.0, 0.3], [0.0, 1.0]]);
        assert!(!stretch.clear_of(&across, &whole(), &1e-9), "a line across");
        let slanted = segment([[-2.0, -0.5], [-0.7, 0.0], [0.7, 0.4], [2.0, 0.9]]);
        assert!(!stretch.clear_of(&slanted, &whole(), &1e-9), "a line that crosses");
    }

    #[test]
    fn only_the_part_in_the_slab_counts() {
        // Crosses the bow's line far to the right of the stretch.
        let stretch = Stretch::new(&bow(0.0), &0.1, &0.15).expect("a chord");
        let slanted = segment([[-2.0, 0.8], [-0.7, 0.4], [0.7, 0.0], [2.0, -0.4]]);
        assert!(stretch.clear_of(&slanted, &whole(), &1e-9), "crosses elsewhere");
        let beyond = segment([[1.0, 0.0], [1.3, 0.0], [1.6, 0.0], [2.0, 0.0]]);
        assert!(stretch.clear_of(&beyond, &whole(), &1e-9), "does not enter the slab");
    }
}
