//! The largest empty tangent disk at a foot point (paper, sections 3.1 and 7.1; `docs/mathematics.md`, sections 2 and 3).
//!
//! r(f, d) = inf over q ∈ C with d·(q−f) > 0 of |q−f|² / (2 d·(q−f)). The disks tangent at f in direction d are nested, so
//! shrinking never admits a point that was excluded: one traversal of the arc hierarchy, entering a box only if it meets the
//! current disk and shrinking at each arc that enters it, finds the infimum. The paper restarts a closest-point search over
//! all segments after each shrinking instead. A disk that nothing bounds is a half-plane: it has no medial point.
//!
//! On one arc the quotient A/B of `medial::pencil` is looked at in both ends, and where its slope changes from rising to
//! falling the maximum between is found by bracketed Newton (for how many there can be see [`crate::curve::arc`]). The result
//! is exact to a few roundoffs times the condition of the quotient; it errs to a radius that is too large, by the noise of
//! the coordinates, only where a plain difference was the best form at hand.

use super::foot::Foot;
use super::pencil::{Pencil, Values};
use crate::bezier::newton::falling_zero;
use crate::curve::{Arc, Curve, CurveParam, Segment};
use crate::geometry::{Aabb, Point};
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
    centre: Point<S>,
    radius: S,
    radius_sq: S,
    touch: Option<Touch<S>>,
}

/// The state of a search.
struct Search<'f, S> {
    smallest: Smallest<'f, S>,
    /// The pencil of the segment (and [part](Pencil::part) of it) that was looked at last.
    pencil: Option<(u32, bool, Pencil<S>)>,
}

/// What a [`Guard`] remembers of an arc.
type Guarded<S> = (u32, Aabb<S>);

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
    /// The arc that bounded the last disk.
    hint: Option<u32>,
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
            |g, arc, bounds| g.valid &= g.arcs.try_push((arc, bounds.clone())).is_ok(),
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
    if let Some(hint) = guard.hint {
        search.visit(curve, hint);
    }
    if guard.holds(&search.smallest) {
        for (arc, bounds) in &guard.arcs {
            if guard.hint != Some(*arc) && search.smallest.meets(bounds, curve.noise) {
                search.visit(curve, *arc);
            }
        }
    } else {
        search.all(curve);
        guard.renew(curve, &search.smallest);
    }
    if let Some(touch) = &search.smallest.touch {
        guard.hint = Some(touch.arc);
    }
    search.result(curve)
}

/// What is looked at: an arc through a pencil, to a precision in its parameter.
struct Span<'p, S> {
    pencil: &'p Pencil<S>,
    arc: &'p Arc<S>,
    index: u32,
    width: S,
}

impl<'f, S: Scalar> Search<'f, S> {
    fn new(foot: &'f Foot<S>) -> Self {
        let smallest = Smallest {
            foot,
            bend: S::zero(),
            centre: foot.point.clone(),
            radius: S::infinity(),
            radius_sq: S::infinity(),
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
            |s, arc, _| s.visit(curve, arc),
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

    /// Shrinks the disk where the arc enters it.
    fn visit(&mut self, curve: &Curve<'_, S>, index: u32) {
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
            self.smallest.search_arc(pencil, segment, arc, index);
        }
    }
}

impl<S: Scalar> Smallest<'_, S> {
    /// The box may hold a point inside the current disk.
    #[inline]
    fn meets(&self, bounds: &Aabb<S>, noise: &S) -> bool {
        if self.touch.is_some() {
            return bounds.distance_sq(&self.centre) < self.radius_sq;
        }
        // Half-plane: the box's corner farthest in direction d.
        let d = &self.foot.direction;
        let zero = S::zero();
        let x = if d.x >= zero { &bounds.max.x } else { &bounds.min.x };
        let y = if d.y >= zero { &bounds.max.y } else { &bounds.min.y };
        d.dot(&Point::new(x.clone(), y.clone()).minus(&self.foot.point)) > -noise.clone()
    }

    fn search_arc(&mut self, pencil: &Pencil<S>, segment: &Segment<S>, arc: &Arc<S>, index: u32) {
        let [from, to] = &arc.span;
        let span = Span { width: S::unit_roundoff().mul_pow2(6), pencil, arc, index };
        for t in [from, to] {
            self.offer(&pencil.at(&(t.clone() - &pencil.shift)), &span, t);
        }
        let [from, to] = &arc.moving(segment);
        let (v0, v1) = (from.clone() - &pencil.shift, to.clone() - &pencil.shift);
        let (e0, e1) = (pencil.at(&v0), pencil.at(&v1));
        // Seen from the retracted end itself the quotient has its largest values here, and none at the end.
        for (t, e, end) in [(from, &e0, &arc.span[0]), (to, &e1, &arc.span[1])] {
            if t != end {
                self.offer(e, &span, t);
            }
        }
        let zero = S::zero();
        // Seen from a distance of its own length or more, an arc has one maximum inside, or none.
        let far = e1.delta.minus(&e0.delta).norm_sq() < e0.b.clone().min(e1.b.clone());
        if !far && e0.approach < zero && e1.approach > zero {
            // The point nearest to f lies inside: near it the quotient can change on a scale that the ends do not show.
            let v = falling_zero(v0.clone(), v1.clone(), &span.width, |v| pencil.recession(v));
            let e = pencil.at(&v);
            self.offer(&e, &span, &(v.clone() + &pencil.shift));
            let at_v = pencil.at(&v);
            self.search_beside(&span, (v.clone(), e), (v0, e0));
            self.search_beside(&span, (v, at_v), (v1, e1));
        } else if let Some(u) = pencil.joint_offset(&v0, &v1) {
            // The arc starts (or ends) at the joint that f is u away from. Where the curvature jumps there the quotient
            // changes over parameters of the order of u, and its maximum lies near √u.
            let sign = if v1 > -v0.clone() { S::one() } else { -S::one() };
            let reach = v1.clone().max(-v0.clone());
            let mut inner = (S::zero(), if sign > S::zero() { e0 } else { e1 });
            let ends = [u.clone() * &S::int(8), u.sqrt().half(), reach];
            for v in ends {
                if v <= inner.0 || v > v1.clone().max(-v0.clone()) {
                    continue;
                }
                let at = v.clone() * &sign;
                let e = pencil.at(&at);
                self.offer(&e, &span, &(at.clone() + &pencil.shift));
                let outer = pencil.at(&at);
                let from = inner.0.clone() * &sign;
                if sign > S::zero() {
                    self.search_span(&span, (from, inner.1), (at, e));
                } else {
                    self.search_span(&span, (at, e), (from, inner.1));
                }
                inner = (v, outer);
            }
        } else if far {
            self.search_span(&span, (v0, e0), (v1, e1));
        } else if e0.b < e1.b {
            self.search_beside(&span, (v0, e0), (v1, e1));
        } else {
            self.search_beside(&span, (v1, e1), (v0, e0));
        }
    }

    /// Searches the arc between its end near the foot and its end away from it. Halved towards the near end, every piece is
    /// seen from its own length or more, but perhaps the last.
    fn search_beside(&mut self, span: &Span<'_, S>, near: (S, Values<S>), far: (S, Values<S>)) {
        let (at, e) = near;
        let (mut end, mut outer) = far;
        // A quarter of the scalar's digits: nearer to the foot differences are noise, in f32 soon.
        for _ in 0..S::BITS / 4 {
            if outer.delta.minus(&e.delta).norm_sq() < e.b.clone().min(outer.b.clone()) {
                break;
            }
            let middle = if at < end { S::midpoint(&at, &end) } else { S::midpoint(&end, &at) };
            let (inner, again) = (span.pencil.at(&middle), span.pencil.at(&middle));
            self.offer(&inner, span, &(middle.clone() + &span.pencil.shift));
            // A disk reaches no farther than its diameter.
            let beyond = span.pencil.touching > S::zero() && inner.b > self.radius_sq.clone().mul_pow2(2);
            if !beyond {
                self.search_ordered(span, (middle.clone(), again), (end, outer));
            }
            (end, outer) = (middle, inner);
        }
        self.search_ordered(span, (at, e), (end, outer));
    }

    /// [`Self::search_span`] of two parameters in either order.
    fn search_ordered(&mut self, span: &Span<'_, S>, a: (S, Values<S>), b: (S, Values<S>)) {
        if a.0 < b.0 { self.search_span(span, a, b) } else { self.search_span(span, b, a) }
    }

    /// Offers the inner maximum of A/B between two parameters, if there is one.
    fn search_span(&mut self, span: &Span<'_, S>, (mut v0, mut e0): (S, Values<S>), (mut v1, mut e1): (S, Values<S>)) {
        let Span { pencil, width, .. } = span;
        let zero = S::zero();
        // Only the part with A > 0 counts. Where A changes sign its zero takes the place of the end: A' B has the slope's sign.
        let rise = |v: &S| {
            let (a, slope) = pencil.a_and_slope(v);
            (-a, -slope)
        };
        if e0.a > zero && e1.a < zero {
            v1 = falling_zero(v0.clone(), v1, width, |v| pencil.a_and_slope(v));
            e1 = pencil.at(&v1);
        } else if e0.a < zero && e1.a > zero {
            v0 = falling_zero(v0, v1.clone(), width, rise);
            e0 = pencil.at(&v0);
        } else if e0.a <= zero && e1.a <= zero {
            // The arc can still rise above the tangent line between its ends.
            let Some(top) = pencil.crest(&v0, &v1, width) else { return };
            v0 = falling_zero(v0, top.clone(), width, rise);
            v1 = falling_zero(top, v1, width, |v| pencil.a_and_slope(v));
            (e0, e1) = (pencil.at(&v0), pencil.at(&v1));
        }
        // Where B vanishes (the foot itself at a fan or corner) the quotient comes from −∞: it rises away from there.
        let rises = e0.slope > zero || e0.b.is_zero();
        let falls = e1.slope < zero || e1.b.is_zero();
        if !rises && !falls {
            return;
        }
        if rises != falls {
            // Rising at both ends, or falling at both: a maximum and a minimum can hide between. They do where the slope,
            // followed from either end along its own tangent, would change its sign within the span.
            let ((s0, bend0), (s1, bend1)) = (pencil.slope(&v0), pencil.slope(&v1));
            let length = v1.clone() - &v0;
            let turn = if rises { S::one() } else { -S::one() };
            let dips = |s: S, bend: S| bend < zero && s < -bend * &length;
            let hidden = dips(s0 * &turn, bend0 * &turn) || dips(s1 * &turn, -(bend1 * &turn));
            if !hidden {
                return;
            }
            let turn = pencil.extremal_slope(&v0, &v1, rises);
            let slope = pencil.slope(&turn).0;
            if rises && slope < zero {
                v1 = turn;
            } else if falls && slope > zero {
                v0 = turn;
            } else {
                return;
            }
        }
        let v = falling_zero(v0, v1, width, |v| pencil.slope(v));
        let e = pencil.at(&v);
        self.offer(&e, span, &(v + &pencil.shift));
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
        self.radius_sq = radius.clone().square();
        self.bend = if touching { S::infinity() } else { e.a.clone() / &e.b };
        self.radius = radius;
        self.touch = Some(Touch { at: CurveParam { segment: span.arc.segment, t: t.clone() }, arc: span.index });
    }
}
