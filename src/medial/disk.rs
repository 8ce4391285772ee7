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
use super::pencil::{Beyond, Pencil, Values};
use crate::bezier::Cubic;
use crate::bezier::newton::{falling_zero, falling_zero_near};
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
    cubic: Cubic<S>,
    /// The centre of the last disk that was found not to reach it, and a distance it keeps from there at least.
    seen_from: Point<S>,
    keeps: S,
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
    /// 0 where the arcs are not complete.
    radius: S,
    arcs: ArrayVec<Guarded<S>, GUARDED>,
    /// What bounded the last disk.
    hint: Option<Touch<S>>,
}

impl<S: Scalar> Guard<S> {
    /// A guard that knows nothing yet.
    pub fn new() -> Self {
        let zero = S::zero();
        Self { centre: Point::new(zero.clone(), zero.clone()), radius: zero, arcs: ArrayVec::new(), hint: None }
    }

    /// The disk lies inside.
    fn holds(&self, disk: &Smallest<'_, S>) -> bool {
        disk.radius < self.radius
            && disk.centre.distance_sq(&self.centre) <= (self.radius.clone() - &disk.radius).square()
    }

    /// Remembers the arcs around a disk, a quarter larger than it is.
    fn renew(&mut self, curve: &Curve<'_, S>, disk: &Smallest<'_, S>) {
        self.arcs.clear();
        self.radius = S::zero();
        if disk.touch.is_none() {
            return;
        }
        self.centre = disk.centre.clone();
        self.radius = disk.radius.clone() * &S::ratio(5, 4);
        curve.hierarchy().traverse(
            &disk.centre,
            self,
            |g, bounds| bounds.distance_sq(&g.centre) <= g.radius.clone().square(),
            |g, leaf, _| {
                for (index, arc) in curve.arcs_in(leaf) {
                    let Some(segment) = curve.segment(arc.segment) else { continue };
                    let cubic = segment.cubic.part(&arc.span[0], &arc.span[1]);
                    // A leaf of several arcs is larger than each of them.
                    if curve.leaf > 1 && cubic.control_box().distance_sq(&g.centre) > g.radius.clone().square() {
                        continue;
                    }
                    let arc = Guarded { arc: index, cubic, seen_from: g.centre.clone(), keeps: S::zero() };
                    if g.arcs.try_push(arc).is_err() {
                        g.radius = S::zero();
                    }
                }
            },
        );
    }
}

impl<S: Scalar> Guarded<S> {
    /// Proves, cheaply and far from tightly, that all of the arc lies outside the disk; `false` says nothing.
    ///
    /// What was proved of an earlier disk still serves where the centres are near each other. Else a distance that the arc keeps
    /// from the centre follows from the coefficients of |q−c|² in Bernstein's basis. Both allow for rounding and the noise of
    /// the coordinates.
    #[inline]
    fn is_out_of_reach(&mut self, disk: &Smallest<'_, S>, noise: &S) -> bool {
        let rounding = S::unit_roundoff().mul_pow2(5);
        let reach = (noise.clone().mul_pow2(3) + &disk.radius) * &(S::one() + &rounding);
        let room = self.keeps.clone() - &reach;
        if room > S::zero() && room.square() > disk.centre.distance_sq(&self.seen_from) {
            return true;
        }
        let [q0, q1, q2, q3] = self.cubic.points.each_ref().map(|p| p.minus(&disk.centre));
        let (n0, n1, n2, n3) = (q0.norm_sq(), q1.norm_sq(), q2.norm_sq(), q3.norm_sq());
        let (fifth, tenth) = (S::ratio(1, 5), S::ratio(1, 10));
        let coefficients = [
            q0.dot(&q1),
            q2.dot(&q3),
            (q0.dot(&q2).twice() + &(n1.clone() * &S::int(3))) * &fifth,
            (q1.dot(&q3).twice() + &(n2.clone() * &S::int(3))) * &fifth,
            (q1.dot(&q2) * &S::int(9) + &q0.dot(&q3)) * &tenth,
        ];
        let least = coefficients.into_iter().fold(n0.clone().min(n3.clone()), S::min);
        let keeps_sq = least - &((n0 + &n1 + &n2 + &n3) * &rounding);
        if keeps_sq <= reach.square() {
            return false;
        }
        self.seen_from = disk.centre.clone();
        self.keeps = keeps_sq.sqrt();
        true
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
#[inline(never)]
pub fn tangent_disk_beside<S: Scalar>(curve: &Curve<'_, S>, foot: &Foot<S>, guard: &mut Guard<S>) -> TangentDisk<S> {
    let mut search = Search::new(foot);
    let hint = guard.hint.as_ref().map(|h| h.arc);
    if let Some(Touch { at, arc }) = &guard.hint {
        search.visit(curve, *arc, Some(&at.t));
    }
    if guard.holds(&search.smallest) {
        for guarded in &mut guard.arcs {
            if hint != Some(guarded.arc) && !guarded.is_out_of_reach(&search.smallest, curve.noise) {
                search.visit(curve, guarded.arc, None);
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
                for (index, arc) in curve.arcs_in(leaf) {
                    let meets = |segment| s.smallest.meets(&arc.bounds(segment), curve.noise);
                    if curve.leaf == 1 || curve.segment(arc.segment).is_some_and(meets) {
                        s.visit(curve, index, None);
                    }
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

    /// Shrinks the disk where the arc enters it, perhaps at a maximum near the parameter `guess`.
    fn visit(&mut self, curve: &Curve<'_, S>, index: u32, guess: Option<&S>) {
        let Some(arc) = &curve.arc(index) else { return };
        let Some(segment) = curve.segment(arc.segment) else { return };
        let middle = S::midpoint(&arc.span[0], &arc.span[1]);
        let part = Pencil::part(self.smallest.foot, arc.segment, &middle);
        let known = matches!(&self.pencil, Some((s, p, _)) if *s == arc.segment && *p == part);
        if !known {
            let pencil = Pencil::new(curve, self.smallest.foot, arc.segment, segment, &middle);
            self.pencil = Some((arc.segment, part, pencil));
        }
        if let Some((_, _, pencil)) = &self.pencil {
            let span = Span { pencil, arc, index };
            if !guess.is_some_and(|t| self.smallest.follow(&span, t)) {
                self.smallest.search_arc(&span, segment);
            }
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

    /// Looks at all of an arc.
    fn search_arc(&mut self, span: &Span<'_, S>, segment: &Segment<S>) {
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
        self.search(span, start, end);
    }

    /// Looks at all of an arc that a neighbour's disk touches at the parameter `guess`, if a maximum near there is the only
    /// one: Newton's method from the guess, and [`Self::is_only_maximum`]. `false` says nothing.
    fn follow(&mut self, span: &Span<'_, S>, guess: &S) -> bool {
        let Span { pencil, arc, .. } = span;
        let [from, to] = arc.span.each_ref().map(|t| t.clone() - &pencil.shift);
        let guess = guess.clone() - &pencil.shift;
        let v = falling_zero_near(guess, &from, &to, &S::unit_roundoff().mul_pow2(6), |v| pencil.slope(v));
        let Some(place) = v.map(|v| Place::new(pencil, v)) else { return false };
        self.offer(&place.values, span, &(place.v.clone() + &pencil.shift));
        self.is_only_maximum(pencil, &place, &from, &to)
    }

    /// Offers maxima of A/B between two places until no piece between can hold a larger one.
    ///
    /// A piece that [`Self::excludes`] does not rule out is split: at the foot's nearest point on it, where that lies inside
    /// (near it the quotient changes on a scale that the ends do not show); at a maximum, where the slopes at its ends
    /// promise one; else in its middle.
    fn search(&mut self, span: &Span<'_, S>, start: Place<S>, end: Place<S>) {
        let (pencil, zero) = (span.pencil, S::zero());
        let width = S::unit_roundoff().mul_pow2(6);
        let least = self.slack.clone() * &(end.v.clone() - &start.v);
        let mut left = start;
        let mut rights: ArrayVec<Place<S>, DEPTH> = ArrayVec::new();
        rights.keep(end);
        for _ in 0..PIECES {
            let Some(right) = rights.last() else { return };
            let length = right.v.clone() - &left.v;
            if length <= least || rights.is_full() || self.excludes(&left, right, &length) {
                left = match rights.pop() {
                    Some(right) => right,
                    None => return,
                };
                continue;
            }
            let (l, r) = (&left.values, &right.values);
            let near = r.delta.minus(&l.delta).norm_sq() >= l.b.clone().min(r.b.clone());
            let split = if near && l.approach < zero && r.approach > zero {
                falling_zero(left.v.clone(), right.v.clone(), &width, &|v| pencil.recession(v))
            } else if l.slope > zero && r.slope < zero {
                falling_zero(left.v.clone(), right.v.clone(), &width, &|v| pencil.slope(v))
            } else {
                S::midpoint(&left.v, &right.v)
            };
            // What was found so close to an end that nothing is split off is seen with its neighbourhood.
            let margin = length.mul_pow2(-10);
            let (low, high) = (left.v.clone() + &margin, right.v.clone() - &margin);
            let middle = S::midpoint(&low, &high);
            for v in [split, middle] {
                let place = Place::new(pencil, v);
                self.offer(&place.values, span, &(place.v.clone() + &pencil.shift));
                if place.v > low && place.v < high {
                    rights.keep(place);
                    break;
                }
            }
        }
    }

    /// No point between two parameters bounds a disk smaller than the current one by more than the slack, seen from a maximum
    /// of A/B between them that was offered.
    ///
    /// With w = v − v* and β = 1/(2r), A − βB = p + ρw + w²G(w): p is 0 or less, ρ what Newton's method left, G of degree
    /// four. Where G ≤ −g < 0, that is ρ²/4g at most. G is bounded from its innermost bracket outwards, on either side of v*.
    ///
    /// At a touching, |q−f| ≤ 4η for the noise η that A is diminished by, A − βB is at least −6η where r > 16η. So it lies
    /// within w² ≤ 6η/g, where |Δ| is at least half of what it is at v*, 16η, if 72η·(|d₁|²+|d₂|²+|d₃|²) ≤ g|Δ|² and |Δ| > 32η at
    /// v*. The disk is that through v*, nothing else having been looked at, or a half-plane: |Δ| ≤ 2r, and r > 16η.
    fn is_only_maximum(&self, pencil: &Pencil<S>, place: &Place<S>, from: &S, to: &S) -> bool {
        let Values { a, b, slope, .. } = &place.values;
        let touching = &pencil.touching;
        let far = touching.clone().mul_pow2(6);
        if *a > self.bend_loose.clone() * b || *b <= far {
            return false;
        }
        let Beyond { coefficients: [g0, g1, g2, g3], rounding, speeds_sq } =
            pencil.beyond_tangent(&place.v, &place.values, &self.bend);
        let bound = |width: S, g1: S, g3: S| {
            let outward = |inner: S, own: &S| (inner * &width).max(S::zero()) + own;
            outward(outward(outward(g3, &g2), &g1), &g0)
        };
        let right = bound(to.clone() - &place.v, g1.clone(), g3.clone());
        let left = bound(place.v.clone() - from, -g1, -g3);
        let g = -(right.max(left) + &rounding);
        let rest = slope.clone() / b;
        g > S::zero()
            && rest.square() <= g.clone().mul_pow2(2) * &self.slack * a
            && (speeds_sq * &S::int(18)).square() * touching <= (g * b).square()
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
