//! The largest empty tangent disk at a foot point (paper, sections 3.1 and 7.1; DESIGN fact 1).
//!
//! r(f, d) = inf over q ∈ C with d·(q−f) > 0 of |q−f|² / (2 d·(q−f)). The disks tangent at f in direction d are nested, so
//! shrinking never admits a point that was excluded: one traversal of the arc hierarchy, entering a box only if it meets the
//! current disk and shrinking at each arc that enters it, finds the infimum. The paper restarts a closest-point search over
//! all segments after each shrinking instead. A disk that nothing bounds is a half-plane: it has no medial point.
//!
//! On one arc the quotient A/B of [`super::pencil`] is looked at in both ends, and where its slope changes from rising to
//! falling the maximum between is found by bracketed Newton (arcs have one at most, see [`crate::curve::arc`]). The result
//! is exact to a few roundoffs times the condition of the quotient; it errs to a radius that is too large, by the noise of
//! the coordinates, only where a plain difference was the best form at hand.

use super::foot::Foot;
use super::pencil::Pencil;
use crate::bezier::newton::falling_zero;
use crate::curve::{Arc, Curve, CurveParam};
use crate::geometry::{Aabb, Point};
use crate::scalar::Scalar;

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

/// The state of a search: the largest A/B so far, and the disk that belongs to it.
struct Search<'f, S> {
    foot: &'f Foot<S>,
    /// 1/(2r); 0 while nothing bounds the disk.
    bend: S,
    centre: Point<S>,
    radius: S,
    radius_sq: S,
    touch: Option<Touch<S>>,
    pencil: Option<(u32, bool, Pencil<S>)>,
}

/// Finds the largest empty tangent disk at a foot. `hint` is an arc likely to bound it (the one that bounds a neighbour's):
/// it makes the search faster and does not change the result.
pub fn tangent_disk<S: Scalar>(curve: &Curve<'_, S>, foot: &Foot<S>, hint: Option<u32>) -> TangentDisk<S> {
    let mut search = Search {
        foot,
        bend: S::zero(),
        centre: foot.point.clone(),
        radius: S::infinity(),
        radius_sq: S::infinity(),
        touch: None,
        pencil: None,
    };
    if let Some(hint) = hint {
        search.visit(curve, hint);
    }
    curve.hierarchy().traverse(&mut search, |s, bounds| s.meets(bounds, curve.noise), |s, arc| s.visit(curve, arc));
    TangentDisk { radius: search.radius, touch: search.touch }
}

impl<S: Scalar> Search<'_, S> {
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

    /// Shrinks the disk where the arc enters it.
    fn visit(&mut self, curve: &Curve<'_, S>, index: u32) {
        let Some(arc) = curve.arcs.get(index as usize) else { return };
        let Some(segment) = curve.segment(arc.segment) else { return };
        let [from, to] = &arc.span;
        let half = S::one().half();
        let middle = S::midpoint(from, to);
        let second_half = middle > half;
        let known = matches!(&self.pencil, Some((s, h, _)) if *s == arc.segment && *h == second_half);
        if !known {
            let pencil = Pencil::new(curve, self.foot, arc.segment, segment, &middle);
            self.pencil = Some((arc.segment, second_half, pencil));
        }
        let Some((_, _, pencil)) = self.pencil.take() else { return };
        self.search_arc(&pencil, arc, index, &middle);
        self.pencil = Some((arc.segment, second_half, pencil));
    }

    fn search_arc(&mut self, pencil: &Pencil<S>, arc: &Arc<S>, index: u32, middle: &S) {
        let [from, to] = &arc.span;
        let (v0, v1) = (from.clone() - &pencil.shift, to.clone() - &pencil.shift);
        let (e0, e1) = (pencil.at(&v0), pencil.at(&v1));
        self.offer(&e0.a, &e0.b, arc, index, from);
        self.offer(&e1.a, &e1.b, arc, index, to);
        // Where B vanishes (the foot itself at a fan or corner) the quotient comes from −∞: it rises away from there.
        let rises = e0.slope > S::zero() || e0.b.is_zero();
        let falls = e1.slope < S::zero() || e1.b.is_zero();
        if rises && falls {
            let width = S::unit_roundoff().sqrt() * &(to.clone() - from).half().half();
            let start = middle.clone() - &pencil.shift;
            let v = falling_zero(v0, v1, start, &width, |v| pencil.slope(v));
            let e = pencil.at(&v);
            self.offer(&e.a, &e.b, arc, index, &(v + &pencil.shift));
        }
    }

    #[inline]
    fn offer(&mut self, a: &S, b: &S, arc: &Arc<S>, index: u32, t: &S) {
        if !(*a > S::zero() && *a > self.bend.clone() * b) {
            return;
        }
        let touch = Touch { at: CurveParam { segment: arc.segment, t: t.clone() }, arc: index };
        let bend = a.clone() / b;
        let radius = if b.is_zero() { S::zero() } else { b.clone() / a };
        let radius = radius.half();
        if !radius.is_finite() {
            return;
        }
        self.centre = self.foot.point.plus_scaled(&radius, &self.foot.direction);
        self.radius_sq = radius.clone().square();
        self.radius = radius;
        self.bend = bend;
        self.touch = Some(touch);
    }
}
