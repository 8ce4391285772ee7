//! Runs: the stretches of a path between points that must be samples, with one running coordinate.
//!
//! A closed path without corners is one run that ends where it began; an open path without corners one run from end to end;
//! corners cut a path into several. A position in a run is a segment count and a parameter ([`Pos`]); moving forwards by at
//! most a given length is all that stepping needs ([`Run::advance`]).

use crate::curve::{Curve, CurveParam, Path, Segment};
use crate::geometry::{Point, Vector};
use crate::scalar::Scalar;

/// A position in a run: `k` segments on from the run's first, parameter `t` there.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Default)]
pub struct Pos<S> {
    /// Segments passed.
    pub k: u32,
    /// Parameter in [0, 1].
    pub t: S,
}

/// What lies at an end of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RunEnd {
    /// An open end of the path, with positive lfs.
    Open,
    /// A point where lfs is 0: a corner, or an end with a retracted handle or in a junction.
    Singular,
    /// The seam of a closed path without corners.
    Seam,
}

/// A stretch of a path.
#[derive(Clone, Debug)]
pub struct Run<'c, S> {
    /// The curve.
    pub curve: &'c Curve<'c, S>,
    /// The path.
    pub path: Path,
    /// Index of the path in the curve.
    pub index: u32,
    /// Segment of the path, counted from its first, in which the run starts.
    pub first: u32,
    /// Where it starts.
    pub start: Pos<S>,
    /// Where it ends.
    pub end: Pos<S>,
    /// What lies at its start and end.
    pub ends: [RunEnd; 2],
}

impl<S: Scalar> Run<'_, S> {
    /// The place on C of a position.
    #[inline]
    pub fn place(&self, p: &Pos<S>) -> CurveParam<S> {
        CurveParam { segment: self.segment_index(p.k), t: p.t.clone() }
    }

    /// Index of the segment that is k on from the run's first.
    #[inline]
    pub fn segment_index(&self, k: u32) -> u32 {
        let n = self.first + k;
        let n = if n >= self.path.count { self.path.around(n) } else { n };
        self.path.first + n
    }

    /// The segment that is k on from the run's first.
    #[inline]
    pub fn segment(&self, k: u32) -> Option<&Segment<S>> {
        self.curve.segment(self.segment_index(k))
    }

    /// The point at a position.
    #[inline]
    pub fn point(&self, p: &Pos<S>) -> Point<S> {
        self.segment(p.k).map_or_else(|| Point::new(S::zero(), S::zero()), |s| s.point(&p.t))
    }

    /// Parameters of segment k that belong to the run.
    #[inline]
    pub fn window(&self, k: u32) -> [S; 2] {
        let from = if k == self.start.k { self.start.t.clone() } else { S::zero() };
        let to = if k == self.end.k { self.end.t.clone() } else { S::one() };
        [from, to]
    }

    /// Moves forwards by at most `length` along the curve, and nearly that much; stops at the end of the run.
    ///
    /// A step never passes the end of a segment: it stops there, however short that makes it.
    pub fn advance(&self, p: &Pos<S>, length: &S) -> Pos<S> {
        if *p >= self.end {
            return self.end.clone();
        }
        if p.t >= S::one() && p.k < self.end.k {
            return self.advance(&Pos { k: p.k + 1, t: S::zero() }, length);
        }
        let Some(segment) = self.segment(p.k) else { return self.end.clone() };
        let speed = segment.power.derivative(&p.t).norm();
        // B'' is linear in t: its length is largest at an end of the step's range.
        let bend = segment.power.second_derivative(&p.t).norm().max(segment.power.second_derivative(&S::one()).norm());
        // speed·Δ + bend·Δ²/2 = length
        let root = (bend * length).twice() + &speed.clone().square();
        let slope = speed + &root.sqrt();
        let to = if slope > S::zero() { length.clone().twice() / &slope + &p.t } else { S::one() };
        let [_, last] = self.window(p.k);
        if to < last {
            // Rounding must not stop the motion.
            if to > p.t {
                return Pos { k: p.k, t: to };
            }
            let least = p.t.clone() + &(S::unit_roundoff().twice() * &S::one().max(p.t.clone()));
            return Pos { k: p.k, t: least.min(last) };
        }
        if p.k == self.end.k { self.end.clone() } else { Pos { k: p.k, t: S::one() } }
    }

    /// A position between two others, `at` of the way in the parameter (a whole segment counts 1).
    pub fn between(&self, a: &Pos<S>, b: &Pos<S>, at: &S) -> Pos<S> {
        let segments = S::int(i32::try_from(b.k.saturating_sub(a.k)).unwrap_or(i32::MAX));
        let total = segments + &b.t - &a.t;
        self.forward(a, &(total * at)).min_of(b)
    }

    /// A position a number of parameters (a whole segment counts 1) further on.
    pub fn forward(&self, a: &Pos<S>, parameters: &S) -> Pos<S> {
        let mut rest = parameters.clone() + &a.t;
        let mut k = a.k;
        while rest > S::one() && k < self.end.k {
            rest = rest - &S::one();
            k += 1;
        }
        let p = Pos { k, t: rest.clamp(S::zero(), S::one()) };
        p.min_of(&self.end)
    }

    /// A direction for chords of zero length: the tangent.
    pub fn tangent(&self, p: &Pos<S>) -> Vector<S> {
        self.segment(p.k).map_or_else(Vector::zero, |s| s.tangent(&p.t))
    }
}

impl<S: Scalar> Pos<S> {
    /// The earlier of two positions.
    #[must_use]
    pub fn min_of(self, other: &Self) -> Self {
        if *other < self { other.clone() } else { self }
    }

    /// The later of two positions.
    #[must_use]
    pub fn max_of(self, other: &Self) -> Self {
        if *other > self { other.clone() } else { self }
    }
}
