//! The largest empty tangent disk at a foot point (paper, sections 3.1 and 7.1; `docs/mathematics.md`, sections 2 and 3).
//!
//! r(f, d) = inf over q ∈ C with d·(q−f) > 0 of |q−f|² / (2 d·(q−f)). The disks tangent at f in direction d are nested, so
//! shrinking never admits a point that was excluded: one traversal of the arc hierarchy, entering a box only if it meets the
//! current disk and shrinking at each arc that enters it, finds the infimum. The paper restarts a closest-point search over
//! all segments after each shrinking instead. A disk that nothing bounds is a half-plane: it has no medial point.
//!
//! On one arc, A/B of `medial::pencil` is to be compared with β = 1/(2r) of the disk so far. A − βB is a polynomial of degree
//! six at most; where its coefficients in Bernstein's basis are all negative, no point of the arc lies inside the disk. These
//! coefficients follow from the values and derivatives at the ends of a piece. A piece that they do not rule out is split,
//! at the maximum of A/B (bracketed Newton) where there is one inside, and its parts are asked again: no maximum is missed,
//! however many there are. A radius is exact to a few roundoffs times the condition of the quotient, and never more than
//! 2^(−3/4 digits) too large for a maximum that no slope showed; it errs to a radius that is too large, by the noise of the
//! coordinates, only where a plain difference was the best form at hand.

use super::foot::Foot;
use super::pencil::{Pencil, Values};
use crate::bezier::Cubic;
use crate::bezier::newton::falling_zero;
use crate::buffer::Keep;
use crate::curve::{Arc, Curve, CurveParam, Segment};
use crate::geometry::{Aabb, Point, Vector};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// The largest empty disk tangent to C at a foot point.
#[derive(Clone, Debug, PartialEq)]
pub struct TangentDisk<S> {
    /// Its radius; infinite where no point of C bounds it.
    pub radius: S,
    /// The point of C that bounds it: the foot itself where the curvature does.
    pub touch: Option<Touch<S>>,
}

/// What bounds a tangent disk.
#[derive(Clone, Debug, PartialEq)]
pub struct Touch<S> {
    /// Where it touches.
    pub at: CurveParam<S>,
    /// Index of the arc there.
    pub arc: u32,
}

/// The smallest disk so far: the largest A/B, and what belongs to it.
struct Smallest<'f, S> {
    foot: &'f Foot<S>,
    /// 1/(2r); 0 while nothing bounds the disk.
    bend: S,
    /// `bend`, enlarged by the slack.
    bend_loose: S,
    /// How much larger than the infimum the radius may be, relatively: 2 to the power of −3/4 of the scalar's digits.
    slack: S,
    centre: Point<S>,
    radius: S,
    /// `radius` squared and 32 roundoffs more, so that no box is left out because the centre is rounded.
    reach_sq: S,
    touch: Option<Touch<S>>,
}

/// The state of a search.
struct Search<'f, S> {
    smallest: Smallest<'f, S>,
    /// The pencil of the segment (and [part](Pencil::part) of it) that was looked at last.
    pencil: Option<(u32, bool, Pencil<S>)>,
}

/// What a [`Guard`] remembers of an arc.
#[derive(Debug)]
struct Guarded<S> {
    arc: u32,
    bounds: Aabb<S>,
    cubic: Cubic<S>,
}

/// Arcs that a guard can hold; where more meet its disk, it is not used.
const GUARDED: usize = 24;

/// All arcs that meet a disk a little larger than the last one found.
///
/// The disks of neighbouring feet differ little. As long as the next one, bounded by what bounded the last, lies inside the
/// guard's disk, nothing but the remembered arcs can enter it, and the hierarchy need not be asked. The result is the same.
#[derive(Debug)]
pub struct Guard<S> {
    centre: Point<S>,
    radius: S,
    arcs: ArrayVec<Guarded<S>, GUARDED>,
    /// The arcs are complete.
    valid: bool,
    /// What bounded the last disk.
    hint: Option<Touch<S>>,
}

impl<S: Scalar> Guard<S> {
    /// A guard that knows nothing yet.
    pub fn new() -> Self {
        let zero = S::zero();
        Self {
            centre: Point::new(zero.clone(), zero.clone()),
            radius: zero,
            arcs: ArrayVec::new(),
            valid: false,
            hint: None,
        }
    }

    /// The disk lies inside.
    fn holds(&self, disk: &Smallest<'_, S>) -> bool {
        self.valid
            && disk.touch.is_some()
            && disk.radius < self.radius
            && disk.centre.distance_sq(&self.centre) <= (self.radius.clone() - &disk.radius).square()
    }

    /// Remembers the arcs around a disk, a quarter larger than it is.
    fn renew(&mut self, curve: &Curve<'_, S>, disk: &Smallest<'_, S>) {
        self.arcs.clear();
        self.valid = disk.touch.is_some();
        if !self.valid {
            return;
        }
        self.centre = disk.centre.clone();
        self.radius = disk.radius.clone() * &S::ratio(5, 4);
        let reach_sq = self.radius.clone().square();
        curve.hierarchy().traverse(
            &disk.centre,
            self,
            |g, bounds| g.valid && bounds.distance_sq(&g.centre) <= reach_sq,
            |g, leaf, bounds| {
                for (index, arc) in curve.arcs_in(leaf) {
                    let Some(segment) = curve.segment(arc.segment) else { continue };
                    let cubic = segment.cubic.part(&arc.span[0], &arc.span[1]);
                    g.valid &= g.arcs.try_push(Guarded { arc: index, bounds: bounds.clone(), cubic }).is_ok();
                }
            },
        );
    }
}

impl<S: Scalar> Default for Guard<S> {
    fn default() -> Self {
        Self::new()
    }
}

/// Finds the largest empty tangent disk at a foot.
pub fn tangent_disk<S: Scalar>(curve: &Curve<'_, S>, foot: &Foot<S>) -> TangentDisk<S> {
    let mut search = Search::new(foot);
    search.all(curve);
    search.result(curve)
}

/// [`tangent_disk`] for one of a row of neighbouring feet: the same result, found faster.
pub fn tangent_disk_beside<S: Scalar>(curve: &Curve<'_, S>, foot: &Foot<S>, guard: &mut Guard<S>) -> TangentDisk<S> {
    let mut search = Search::new(foot);
    let hint = guard.hint.as_ref().map(|h| h.arc);
    if let Some(Touch { at, arc }) = &guard.hint {
        search.visit(curve, *arc, Some(&at.t));
    }
    if guard.holds(&search.smallest) {
        for Guarded { arc, bounds, cubic } in &guard.arcs {
            let near = hint != Some(*arc) && search.smallest.meets(bounds, curve.noise);
            if near && !search.smallest.is_left_out_by(cubic, curve.noise) {
                search.visit(curve, *arc, None);
            }
        }
    } else {
        search.all(curve);
        guard.renew(curve, &search.smallest);
    }
    if let Some(touch) = &search.smallest.touch {
        guard.hint = Some(touch.clone());
    }
    search.result(curve)
}

/// What is looked at: an arc through a pencil.
struct Span<'p, S> {
    pencil: &'p Pencil<S>,
    arc: &'p Arc<S>,
    index: u32,
}

/// A parameter of a pencil with the values there.
struct Place<S> {
    v: S,
    values: Values<S>,
}

impl<S: Scalar> Place<S> {
    #[inline]
    fn new(pencil: &Pencil<S>, v: S) -> Self {
        let values = pencil.at(&v);
        Self { v, values }
    }
}

/// Pieces of an arc that wait while the first of them is searched.
const DEPTH: usize = 48;

/// Pieces of one arc that are looked at, at most: what is left then counts as ruled out. Real drawings need a fifth.
const PIECES: usize = 512;

impl<'f, S: Scalar> Search<'f, S> {
    fn new(foot: &'f Foot<S>) -> Self {
        let smallest = Smallest {
            foot,
            bend: S::zero(),
            bend_loose: S::zero(),
            slack: S::one().mul_pow2(-(S::BITS * 3 / 4).cast_signed()),
            centre: foot.point.clone(),
            radius: S::infinity(),
            reach_sq: S::infinity(),
            touch: None,
        };
        Self { smallest, pencil: None }
    }

    /// Looks at all arcs that enter the disk.
    fn all(&mut self, curve: &Curve<'_, S>) {
        let foot = self.smallest.foot;
        curve.hierarchy().traverse(
            &foot.point,
            self,
            |s, bounds| s.smallest.meets(bounds, curve.noise),
            |s, leaf, _| {
                for (arc, _) in curve.arcs_in(leaf) {
                    s.visit(curve, arc, None);
                }
            },
        );
    }

    /// The disk found. One whose arc leaves the tangent by less than the coordinates' noise over the whole diagonal is a
    /// half-plane: nothing but rounding bounds it.
    fn result(self, curve: &Curve<'_, S>) -> TangentDisk<S> {
        let Smallest { radius, touch, .. } = self.smallest;
        let flat = curve.diagonal.clone().square() / &(curve.noise.clone() * &S::int(64));
        if flat.is_finite() && radius > flat {
            return TangentDisk { radius: S::infinity(), touch: None };
        }
        TangentDisk { radius, touch }
    }

    /// Shrinks the disk where the arc enters it, perhaps near the parameter `guess`.
    fn visit(&mut self, curve: &Curve<'_, S>, index: u32, guess: Option<&S>) {
        let Some(arc) = curve.arcs.get(index as usize) else { return };
        let Some(segment) = curve.segment(arc.segment) else { return };
        let middle = S::midpoint(&arc.span[0], &arc.span[1]);
        let part = Pencil::part(self.smallest.foot, arc.segment, &middle);
        let known = matches!(&self.pencil, Some((s, p, _)) if *s == arc.segment && *p == part);
        if !known {
            let pencil = Pencil::new(curve, self.smallest.foot, arc.segment, segment, &middle);
            self.pencil = Some((arc.segment, part, pencil));
        }
        if let Some((_, _, pencil)) = &self.pencil {
            self.smallest.search_arc(&Span { pencil, arc, index }, segment, guess);
        }
    }
}

impl<S: Scalar> Smallest<'_, S> {
    /// The box may hold a point inside the current disk.
    #[inline]
    fn meets(&self, bounds: &Aabb<S>, noise: &S) -> bool {
        if self.touch.is_some() {
            return bounds.distance_sq(&self.centre) < self.reach_sq;
        }
        // Half-plane: the box's corner farthest in direction d.
        let d = &self.foot.direction;
        let zero = S::zero();
        let x = if d.x >= zero { &bounds.max.x } else { &bounds.min.x };
        let y = if d.y >= zero { &bounds.max.y } else { &bounds.min.y };
        d.dot(&Point::new(x.clone(), y.clone()).minus(&self.foot.point)) > -noise.clone()
    }

    /// Proves, cheaply and far from tightly, that all of a cubic lies outside the current disk: the coefficients of |q−c|²
    /// in Bernstein's basis are at least r², by more than rounding and the coordinates' noise. `false` says nothing.
    #[inline]
    fn is_left_out_by(&self, cubic: &Cubic<S>, noise: &S) -> bool {
        let [q0, q1, q2, q3] = cubic.points.each_ref().map(|p| p.minus(&self.centre));
        let (n0, n1, n2, n3) = (q0.norm_sq(), q1.norm_sq(), q2.norm_sq(), q3.norm_sq());
        let rounding = (n0.clone() + &n1 + &n2 + &n3) * &S::unit_roundoff().mul_pow2(5);
        let least = (noise.clone().mul_pow2(3) + &self.radius).square() + &rounding;
        let three = S::int(3);
        let nine = S::int(9);
        let (five, ten) = (least.clone() * &S::int(5), least.clone() * &S::int(10));
        (n0 >= least)
            & (n3 >= least)
            & (q0.dot(&q1) >= least)
            & (q2.dot(&q3) >= least)
            & (q0.dot(&q2).twice() + &(n1 * &three) >= five)
            & (q1.dot(&q3).twice() + &(n2 * &three) >= five)
            & (q1.dot(&q2) * &nine + &q0.dot(&q3) >= ten)
    }

    fn search_arc(&mut self, span: &Span<'_, S>, segment: &Segment<S>, guess: Option<&S>) {
        let Span { pencil, arc, .. } = span;
        if pencil.turns_away(&arc.span) {
            return;
        }
        let moving = arc.moving(segment);
        let [start, end] = moving.each_ref().map(|t| Place::new(pencil, t.clone() - &pencil.shift));
        self.offer(&start.values, span, &moving[0]);
        self.offer(&end.values, span, &moving[1]);
        // Seen from the retracted end itself the quotient has its largest values beside it, and none at the end.
        for (from, t) in moving.iter().zip(&arc.span) {
            if from != t {
                self.offer(&pencil.at(&(t.clone() - &pencil.shift)), span, t);
            }
        }
        let length = end.v.clone() - &start.v;
        if guess.is_some() || !self.excludes(&start, &end, &length) {
            self.search(span, start, end, guess);
        }
    }

    /// Offers maxima of A/B between two places until no piece between can hold a larger one.
    ///
    /// A piece that [`Self::excludes`] does not rule out is split: at the foot's nearest point on it, where that lies inside
    /// (near it the quotient changes on a scale that the ends do not show); at a maximum, where the slopes at its ends
    /// promise one; else in its middle. The first maximum is sought from the parameter `guess` on.
    fn search(&mut self, span: &Span<'_, S>, start: Place<S>, end: Place<S>, guess: Option<&S>) {
        let (pencil, zero) = (span.pencil, S::zero());
        let mut guess = guess.map(|t| t.clone() - &pencil.shift);
        let width = S::unit_roundoff().mul_pow2(6);
        let least = self.slack.clone() * &(end.v.clone() - &start.v);
        let mut left = start;
        let mut rights: ArrayVec<Place<S>, DEPTH> = ArrayVec::new();
        rights.keep(end);
        for _ in 0..PIECES {
            let Some(right) = rights.last() else { return };
            let length = right.v.clone() - &left.v;
            // With a guess the whole is known to hold a maximum.
            if length <= least || rights.is_full() || (guess.is_none() && self.excludes(&left, right, &length)) {
                left = match rights.pop() {
                    Some(right) => right,
                    None => return,
                };
                continue;
            }
            let (l, r) = (&left.values, &right.values);
            let near = r.delta.minus(&l.delta).norm_sq() >= l.b.clone().min(r.b.clone());
            let split = if near && l.approach < zero && r.approach > zero {
                let middle = S::midpoint(&left.v, &right.v);
                falling_zero(left.v.clone(), middle, right.v.clone(), &width, |v| pencil.recession(v))
            } else if l.slope > zero && r.slope < zero {
                let middle = S::midpoint(&left.v, &right.v);
                let start = guess.filter(|v| *v > left.v && *v < right.v).unwrap_or(middle);
                falling_zero(left.v.clone(), start, right.v.clone(), &width, |v| pencil.slope(v))
            } else {
                S::midpoint(&left.v, &right.v)
            };
            guess = None;
            // What was found so close to an end that nothing is split off is seen with its neighbourhood.
            let margin = length.mul_pow2(-10);
            let place = Place::new(pencil, split);
            self.offer(&place.values, span, &(place.v.clone() + &pencil.shift));
            let inside = place.v.clone() - &left.v > margin && right.v.clone() - &place.v > margin;
            let place = if inside {
                place
            } else {
                let middle = Place::new(pencil, S::midpoint(&left.v, &right.v));
                self.offer(&middle.values, span, &(middle.v.clone() + &pencil.shift));
                middle
            };
            if rights.try_push(place).is_err() {
                return;
            }
        }
    }

    /// No point between two places bounds a disk smaller than the current one by more than the slack: all coefficients of
    /// A − β B in Bernstein's basis are negative, up to what [`Self::leaves_tangent`] ignores. β is 1/(2r), a little
    /// enlarged.
    fn excludes(&self, left: &Place<S>, right: &Place<S>, length: &S) -> bool {
        if self.radius.is_zero() {
            return true;
        }
        let third = length.clone() / &S::int(3);
        let (l, r) = (&left.values, &right.values);
        let a =
            [l.a.clone(), l.a_slope.clone() * &third + &l.a, r.a.clone() - &(r.a_slope.clone() * &third), r.a.clone()];
        let (d0, d3) = (&l.delta, &r.delta);
        let d1 = d0.plus_scaled(&third, &l.delta_slope);
        let d2 = d3.plus_scaled(&-third, &r.delta_slope);
        let size = |v: &Vector<S>| v.x.clone().abs().max(v.y.clone().abs());
        let noise = size(d0).max(size(&d1)).max(size(&d2)).max(size(d3)) * &S::unit_roundoff().mul_pow2(3);
        if self.touch.is_none() {
            return a.iter().all(|a| *a <= noise);
        }
        let [a0, a1, a2, a3] = a;
        let beta = &self.bend_loose;
        let below = |a: S, b: S, weight: i32| a <= b * beta + &(noise.clone() * &S::int(weight));
        let three = S::int(3);
        let nine = S::int(9);
        let a12 = a1.clone() + &a2;
        // All seven at once: mostly all of them hold, and they are of one pattern.
        below(a0.clone(), l.b.clone(), 1)
            & below(a3.clone(), r.b.clone(), 1)
            & below(a0.clone() + &a1, d0.dot(&d1).twice(), 2)
            & below(a2.clone() + &a3, d2.dot(d3).twice(), 2)
            & below(a1.clone() * &three + &a0 + &a2, d0.dot(&d2).twice() + &(d1.norm_sq() * &three), 5)
            & below(a2 * &three + &a1 + &a3, d1.dot(d3).twice() + &(d2.norm_sq() * &three), 5)
            & below(a12 * &nine + &a0 + &a3, (d0.dot(d3) + &(d1.dot(&d2) * &nine)).twice(), 20)
    }

    /// The chord to the point makes an angle with the tangent that is more than rounding: a straight line bounds no disk.
    #[inline]
    fn leaves_tangent(e: &Values<S>) -> bool {
        e.a.clone().square() > e.b.clone() * &S::unit_roundoff().mul_pow2(3).square()
    }

    /// Takes the disk through a point of the arc if it is smaller than the one so far.
    #[inline]
    fn offer(&mut self, e: &Values<S>, span: &Span<'_, S>, t: &S) {
        let touching = e.b <= span.pencil.touching && span.pencil.touching > S::zero();
        let radius = if touching {
            S::zero()
        } else if e.a > S::zero() && e.a > self.bend.clone() * &e.b && Self::leaves_tangent(e) {
            (e.b.clone() / &e.a).half()
        } else {
            return;
        };
        if !radius.is_finite() || radius >= self.radius {
            return;
        }
        self.centre = self.foot.point.plus_scaled(&radius, &self.foot.direction);
        let radius_sq = radius.clone().square();
        self.reach_sq = radius_sq.clone() * &S::unit_roundoff().mul_pow2(5) + &radius_sq;
        self.bend = if touching { S::infinity() } else { e.a.clone() / &e.b };
        self.bend_loose = self.bend.clone() * &self.slack + &self.bend;
        self.radius = radius;
        self.touch = Some(Touch { at: CurveParam { segment: span.arc.segment, t: t.clone() }, arc: span.index });
    }
}
