//! The curve that proofs speak of: coefficients in intervals, tangent-continuous for good.
//!
//! The door makes a joint smooth by turning both handles into one stored direction u. Control points are rounded, so taken at
//! their word the handles would miss each other by some 1e-16, and a curve with such kinks has lfs = 0 at every joint. What is
//! meant, and what every proof is about, is the curve **C\***: its control points are those stored, but an inner one beside a
//! smooth joint at P is P + λu with λ = (H − P)·u/|u|², the orthogonal projection of the stored handle H on the line through P
//! with the stored direction. Both branches then have exactly one tangent line. C\* is within a few roundoffs of the stored
//! curve, and a repeated cubic repeats it there too.
//!
//! [`IdealSegment`] holds the coefficients of powers of C\* in intervals, **outgoing** from either end: B = P + c₁v + c₂v² +
//! c₃v³ with v = 0 at that end. A joint of two branches is thus seen the same way from both, whatever their directions.

use super::{Curve, JointKind, Segment};
use crate::buffer::{BufferFull, Store};
use crate::geometry::{Point, Vector};
use crate::scalar::{Directed, Enclosure as Interval, Field};

/// A vector (or a point, from the origin) enclosed.
pub type Enclosed<S> = Vector<Interval<S>>;

/// A cubic seen from one of its ends, in intervals.
#[derive(Clone, Copy, Debug)]
pub struct Outgoing<S> {
    /// The end, from the origin; exact.
    pub end: Enclosed<S>,
    /// c₁, c₂, c₃.
    pub c: [Enclosed<S>; 3],
    /// c₁ is exactly zero: the handle is retracted.
    pub retracted: bool,
}

/// A segment of C\* seen from both ends.
#[derive(Clone, Copy, Debug)]
pub struct IdealSegment<S> {
    sides: [Outgoing<S>; 2],
}

/// A point as an exact enclosure.
#[inline]
pub fn exact<S: Directed>(p: &Point<S>) -> Enclosed<S> {
    Vector::new(Interval::point(p.x.clone()), Interval::point(p.y.clone()))
}

/// A vector as an exact enclosure.
#[inline]
pub fn exact_vector<S: Directed>(v: &Vector<S>) -> Enclosed<S> {
    Vector::new(Interval::point(v.x.clone()), Interval::point(v.y.clone()))
}

impl<S: Directed> IdealSegment<S> {
    /// The coefficients of a segment.
    pub fn new(segment: &Segment<S>) -> Self {
        let [p0, p1, p2, p3] = &segment.cubic.points;
        let first = handle(p0, p1, segment, 0);
        let last = handle(p3, p2, segment, 1);
        let across = exact(p3).minus(&exact(p0));
        let side = |end: &Point<S>, own: &Enclosed<S>, other: &Enclosed<S>, across: &Enclosed<S>, retracted| {
            // From this end: w₁ to its handle, w₂ to the other handle, w₃ to the other end.
            let w2 = across.plus(other);
            let three = Interval::int(3);
            Outgoing {
                end: exact(end),
                c: [
                    own.scaled(&three),
                    w2.minus(&own.scaled(&Interval::int(2))).scaled(&three),
                    across.minus(&w2.minus(own).scaled(&three)),
                ],
                retracted,
            }
        };
        let [a, b] = &segment.ends;
        Self {
            sides: [
                side(p0, &first, &last, &across, a.retracted),
                side(p3, &last, &first, &across.opposite(), b.retracted),
            ],
        }
    }

    /// The segment seen from its end at t = 0 (side 0) or t = 1 (side 1).
    #[inline]
    pub const fn from(&self, side: usize) -> &Outgoing<S> {
        let [a, b] = &self.sides;
        if side == 0 { a } else { b }
    }
}

/// The handle of C\* at an end: the stored one, or its projection on the tangent line of a smooth joint.
fn handle<S: Directed>(end: &Point<S>, inner: &Point<S>, segment: &Segment<S>, side: usize) -> Enclosed<S> {
    let stored = exact(inner).minus(&exact(end));
    let joint = segment.end(side);
    if joint.kind != JointKind::Smooth {
        return stored;
    }
    let u = exact_vector(&joint.leaving);
    let length = stored.dot(&u) / &u.norm_sq();
    u.scaled(&length)
}

/// Appends the coefficients of all segments.
///
/// # Errors
/// [`BufferFull`] where `out` cannot take one entry a segment.
pub fn coefficients<S: Directed>(
    curve: &Curve<'_, S>,
    out: &mut impl Store<IdealSegment<S>>,
) -> Result<(), BufferFull> {
    curve.segments.iter().try_for_each(|s| out.push(IdealSegment::new(s)))
}

impl<S: Directed> Outgoing<S> {
    /// B(v), from the origin.
    #[inline]
    pub fn point(&self, v: &Interval<S>) -> Enclosed<S> {
        let [c1, c2, c3] = &self.c;
        let inner = c1.plus_scaled(v, &c2.plus_scaled(v, c3));
        self.end.plus_scaled(v, &inner)
    }

    /// B'(v).
    #[inline]
    pub fn derivative(&self, v: &Interval<S>) -> Enclosed<S> {
        let [c1, c2, c3] = &self.c;
        let two_c2 = Vector::new(c2.x.clone().twice(), c2.y.clone().twice());
        c1.plus_scaled(v, &two_c2.plus_scaled(v, &c3.scaled(&Interval::int(3))))
    }

    /// The tangent at v: B'(v), divided by v where the handle is retracted.
    #[inline]
    pub fn tangent(&self, v: &Interval<S>) -> Enclosed<S> {
        if !self.retracted {
            return self.derivative(v);
        }
        let [_, c2, c3] = &self.c;
        let two_c2 = Vector::new(c2.x.clone().twice(), c2.y.clone().twice());
        two_c2.plus_scaled(v, &c3.scaled(&Interval::int(3)))
    }
}
