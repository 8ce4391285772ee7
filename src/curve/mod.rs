//! The curve C: a finite set of piecewise cubic paths, made from a drawing once, at the door.
//!
//! Real drawings close with lines of 1e-16, repeat a stroke, kink by 0.01° where they mean to be smooth, and hide cusps in
//! cubics. [`door`] settles all of this once; everything behind it speaks of the C that it makes:
//!
//! * [`Segment`]s, each a cubic that knows its joints and its arcs; their [`Source`]s in the drawing stand in a list of their
//!   own, which a program on a chip need not keep;
//! * **joints** ([`joint`]): where ends meet, as circular lists of [`EndId`]s, each [`JointKind::Open`], `Smooth` or
//!   `Corner`. Topology knows no distances: it is settled at the door and only followed afterwards;
//! * [`Arc`]s ([`arc`]): pieces of monotone curvature with little turning, the leaves of one bounding hierarchy;
//! * **strands**: maximal chains of smoothly joined segments, along which turning is accumulated. Two pieces of curve are
//!   *local* to each other if less than about one radian of turning lies between them on one strand: such a stretch cannot
//!   come back to itself, so only non-local pieces can come near ([`nearest`], [`contact`]).

mod apart;
pub mod arc;
pub mod contact;
pub mod door;
pub mod given;
pub mod ideal;
pub mod joint;
pub mod nearest;
mod strands;
mod twin;

use crate::bezier::{Cubic, PowerBasis};
use crate::geometry::hierarchy::{Hierarchy, Node};
use crate::geometry::{Point, Vector};
use crate::scalar::Scalar;
pub use arc::{Arc, ArcStart};
use core::num::NonZeroU32;
pub use joint::{EndId, JointEnd, JointKind};

/// A place on the curve: a segment of C and a parameter in [0, 1] of it.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct CurveParam<S> {
    /// Index into [`Curve::segments`].
    pub segment: u32,
    /// Parameter of that segment's cubic.
    pub t: S,
}

/// Where a segment of C comes from in the drawing, to translate parameters back.
///
/// A cubic is split at exact cusps: the segment is the window [`from`, `to`] of its source. A straight cubic with uneven
/// speed is run through at uniform speed instead: `handles` are the positions of the window's inner control points along
/// the line, the ends at 0 and 1 (1/3 and 2/3 for uniform speed).
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Source<S> {
    /// Index into the path's list of cubics as it came to the door.
    pub segment: u32,
    /// Parameter of the source where the segment starts.
    pub from: S,
    /// Parameter of the source where it ends.
    pub to: S,
    /// Inner control points along a straight source.
    pub handles: Option<[S; 2]>,
}

impl<S: Scalar> Source<S> {
    /// The source's parameter of the point that the segment has at t.
    ///
    /// Exact to a few units of roundoff for a window, to 2^−BITS of the line's length for a straight source (bisection).
    pub fn parameter(&self, t: &S) -> S {
        let t = self.handles.as_ref().map_or_else(|| t.clone(), |handles| uneven_parameter(handles, t));
        if t >= S::one() {
            return self.to.clone();
        }
        (self.to.clone() - &self.from) * &t + &self.from
    }
}

impl<S: Scalar> Source<S> {
    /// The parameter of the segment where the source has the parameter t: what [`Self::parameter`] undoes.
    pub fn place(&self, t: &S) -> S {
        let width = self.to.clone() - &self.from;
        if *t >= self.to || width <= S::zero() {
            return S::one();
        }
        let s = ((t.clone() - &self.from) / &width).clamp(S::zero(), S::one());
        let Some([alpha, beta]) = &self.handles else { return s };
        let (three, r) = (S::int(3), S::one() - &s);
        let a = alpha.clone() * &three * &r * &r;
        let b = beta.clone() * &three * &r * &s;
        ((a + &b + &s.clone().square()) * &s).clamp(S::zero(), S::one())
    }
}

/// Solves 3α s(1−s)² + 3β s²(1−s) + s³ = x for s in [0, 1], where the left side is monotone.
fn uneven_parameter<S: Scalar>([alpha, beta]: &[S; 2], x: &S) -> S {
    let (mut lo, mut hi) = (S::zero(), S::one());
    if *x <= lo {
        return lo;
    }
    if *x >= hi {
        return hi;
    }
    let three = S::int(3);
    for _ in 0..S::BITS + 8 {
        let s = S::midpoint(&lo, &hi);
        let r = S::one() - &s;
        let a = alpha.clone() * &three * &r * &r;
        let b = beta.clone() * &three * &r * &s;
        let along = (a + &b + &s.clone().square()) * &s;
        if along < *x {
            lo = s;
        } else {
            hi = s;
        }
    }
    S::midpoint(&lo, &hi)
}

/// One cubic of C.
#[derive(Clone, Copy, Debug, Default)]
pub struct Segment<S> {
    /// Its control points.
    pub cubic: Cubic<S>,
    /// The same cubic in powers of t.
    pub power: PowerBasis<S>,
    /// Index into [`Curve::paths`].
    pub path: u32,
    /// Its two ends: at t = 0 and at t = 1.
    pub ends: [JointEnd<S>; 2],
    /// First arc, and how many there are; none for a twin.
    pub arcs: (u32, u32),
    /// A segment that another one repeats exactly: only that other one is an obstacle.
    pub twin: Option<Twin>,
    /// The strand it belongs to.
    pub strand: u32,
    /// Turning accumulated along the strand at t = 1.
    pub turn: S,
    /// Turning along the whole strand if it is a closed loop, else 0.
    pub loop_turn: S,
}

/// The segment that a repeated one coincides with, in one word, with or without an `Option` around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Twin(NonZeroU32);

impl Twin {
    /// The segment that stands for both (below 2^30: a curve has no more), and whether the two run in opposite directions.
    #[inline]
    pub(crate) const fn new(segment: u32, reversed: bool) -> Self {
        Self(NonZeroU32::MIN.saturating_add(segment << 1 | reversed as u32))
    }

    /// Index of the segment that stands for both.
    #[inline]
    pub const fn segment(self) -> u32 {
        (self.0.get() - 1) >> 1
    }

    /// The two run in opposite directions.
    #[inline]
    pub const fn reversed(self) -> bool {
        (self.0.get() - 1) & 1 == 1
    }

    /// A parameter, on the segment that stands for both.
    pub(crate) fn place<S: Scalar>(self, t: S) -> CurveParam<S> {
        CurveParam { segment: self.segment(), t: if self.reversed() { S::one() - &t } else { t } }
    }

    /// The end on the segment that stands for both.
    pub(crate) const fn end(self, side: usize) -> EndId {
        EndId::new(self.segment(), side ^ self.reversed() as usize)
    }
}

/// A path of C: consecutive segments.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Path {
    /// Index of the path as it came to the door.
    pub source: u32,
    /// First segment.
    pub first: u32,
    /// Number of segments, at least 1.
    pub count: u32,
    /// The last segment ends where the first one starts.
    pub closed: bool,
}

impl Path {
    /// Segments counted around the path.
    #[inline]
    pub(crate) fn around(&self, k: u32) -> u32 {
        // A path has a segment; one without would otherwise link the panic of a division by zero.
        k.checked_rem(self.count).unwrap_or(0)
    }
}

/// The curve C, borrowed from the buffers that [`door::enter`] filled.
#[derive(Clone, Copy, Debug)]
pub struct Curve<'a, S> {
    /// All cubics, path by path.
    pub segments: &'a [Segment<S>],
    /// Where each segment comes from in the drawing; empty where the program did not keep it.
    pub sources: &'a [Source<S>],
    /// All paths.
    pub paths: &'a [Path],
    /// Where all arcs start, segment by segment, by ascending parameter.
    pub arcs: &'a [ArcStart<S>],
    /// The hierarchy over the arcs.
    pub nodes: &'a [Node<S>],
    /// Consecutive arcs that share a leaf of the hierarchy, at least 1.
    pub leaf: u32,
    /// Diagonal of the box of all control points of the drawing: the unit of relative tolerances.
    pub diagonal: &'a S,
    /// Largest error of a difference of two coordinates: a few roundoffs of the largest coordinate.
    pub noise: &'a S,
}

impl<'a, S: Scalar> Curve<'a, S> {
    /// A segment by its index.
    #[inline]
    pub fn segment(&self, index: u32) -> Option<&'a Segment<S>> {
        self.segments.get(index as usize)
    }

    /// Where a segment comes from in the drawing; `None` also where that was not kept.
    #[inline]
    pub fn source(&self, index: u32) -> Option<&'a Source<S>> {
        self.sources.get(index as usize)
    }

    /// The hierarchy over the arcs; its items are leaves, see [`Self::arcs_in`].
    #[inline]
    pub const fn hierarchy(&self) -> Hierarchy<'a, S> {
        Hierarchy::new(self.nodes)
    }

    /// An arc by its index.
    #[inline]
    pub fn arc(&self, index: u32) -> Option<Arc<S>> {
        arc::whole(self.segments, self.arcs, index)
    }

    /// The arcs of a leaf of the hierarchy, with their indices.
    #[inline]
    pub fn arcs_in(&self, leaf: u32) -> impl Iterator<Item = (u32, Arc<S>)> + use<'a, S> {
        let (segments, arcs, first) = (self.segments, self.arcs, leaf.saturating_mul(self.leaf));
        (first..first.saturating_add(self.leaf)).map_while(move |i| Some((i, arc::whole(segments, arcs, i)?)))
    }

    /// The arcs of a segment, by ascending parameter.
    #[inline]
    pub fn arcs_of(&self, segment: &Segment<S>) -> impl DoubleEndedIterator<Item = Arc<S>> + use<'a, S> {
        let (segments, arcs, (first, count)) = (self.segments, self.arcs, segment.arcs);
        (first..first.saturating_add(count)).filter_map(move |i| arc::whole(segments, arcs, i))
    }

    /// One end of a segment.
    #[inline]
    pub fn end(&self, id: EndId) -> Option<&'a JointEnd<S>> {
        self.segment(id.segment()).map(|s| s.end(id.side()))
    }

    /// The point at an end.
    #[inline]
    pub fn end_point(&self, id: EndId) -> Option<&'a Point<S>> {
        self.segment(id.segment()).map(|s| s.end_point(id.side()))
    }

    /// All ends that meet in the joint of this one, itself first; for the end of a twin, those of the segment that stands for it.
    pub fn joint(&self, id: EndId) -> impl Iterator<Item = EndId> + 'a {
        self.ring(obstacle_end(self.segments, id))
    }

    /// The same for an end of an obstacle. It would not come to an end for a twin's, whose `next` leads into a list without it.
    pub(crate) fn ring(&self, id: EndId) -> impl Iterator<Item = EndId> + 'a {
        let segments = self.segments;
        joint::members(id, move |e| segments.get(e.segment() as usize).map(|s| s.end(e.side()).next))
    }

    /// The point at a place, or `None` for a segment that does not exist.
    pub fn point(&self, at: &CurveParam<S>) -> Option<Point<S>> {
        self.segment(at.segment).map(|s| s.point(&at.t))
    }
}

/// An index below 2^31 as u32; larger counts were refused before.
fn index_of(i: usize) -> u32 {
    u32::try_from(i).unwrap_or(u32::MAX)
}

/// An end; that of a twin as the same end of the segment that stands for it.
fn obstacle_end<S>(segments: &[Segment<S>], end: EndId) -> EndId {
    match segments.get(end.segment() as usize).and_then(|s| s.twin) {
        Some(twin) => twin.end(end.side()),
        None => end,
    }
}

impl<S: Scalar> Segment<S> {
    /// The end at t = 0 (side 0) or t = 1 (side 1).
    #[inline]
    pub const fn end(&self, side: usize) -> &JointEnd<S> {
        let [start, end] = &self.ends;
        if side == 0 { start } else { end }
    }

    /// The point of an end.
    #[inline]
    pub fn end_point(&self, side: usize) -> &Point<S> {
        if side == 0 { self.cubic.start() } else { self.cubic.end() }
    }

    /// The point at t; the shared end points to the bit at 0 and 1.
    #[inline]
    pub fn point(&self, t: &S) -> Point<S> {
        if *t >= S::one() { self.cubic.end().clone() } else { self.power.eval(t) }
    }

    /// Unit tangent at t, in the direction of growing t.
    ///
    /// At an end it is the direction that the joint settled; inside, C has no point without tangent (the door splits
    /// exact cusps), and a derivative that vanishes by rounding answers with the chord's direction.
    #[inline]
    pub fn tangent(&self, t: &S) -> Vector<S> {
        if *t <= S::zero() {
            return self.end(0).leaving.clone();
        }
        if *t >= S::one() {
            return self.end(1).leaving.opposite();
        }
        let d = self.power.derivative(t);
        let n = d.norm();
        if n > S::zero() && n.is_finite() {
            return Vector::new(d.x / &n, d.y / &n);
        }
        d.unit()
            .or_else(|| self.cubic.end().minus(self.cubic.start()).unit())
            .unwrap_or_else(|| self.end(0).leaving.clone())
    }
}
