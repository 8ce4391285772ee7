//! One cubic Bézier segment in its two forms.
//!
//! Control points describe it ([`Cubic`]); coefficients of powers of t evaluate it ([`PowerBasis`]):
//! B(t) = a₀ + a₁ t + a₂ t² + a₃ t³ with a₁ = 3(p₁−p₀), a₂ = 3(p₂−2p₁+p₀), a₃ = p₃−3p₂+3p₁−p₀.
//! Source: paper, Equation 1. What [`crate::medial`] divides out of differences of them: `docs/mathematics.md`, section 4.

use crate::geometry::{Aabb, Point, Vector};
use crate::scalar::Scalar;

/// A cubic Bézier segment by its four control points, in user units.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Cubic<S> {
    /// p₀ … p₃; the curve starts at p₀ and ends at p₃.
    pub points: [Point<S>; 4],
}

impl<S: Scalar> Cubic<S> {
    /// The cubic with these control points.
    #[inline]
    pub const fn new(p0: Point<S>, p1: Point<S>, p2: Point<S>, p3: Point<S>) -> Self {
        Self { points: [p0, p1, p2, p3] }
    }

    /// A straight line from a to b, raised to a cubic with uniform speed.
    pub fn line(a: Point<S>, b: Point<S>) -> Self {
        let third = b.minus(&a);
        let third = Vector::new(third.x / &S::int(3), third.y / &S::int(3));
        let p1 = a.plus(&third);
        let p2 = b.plus(&third.opposite());
        Self::new(a, p1, p2, b)
    }

    /// A quadratic Bézier curve, raised to a cubic of the same parametrisation.
    pub fn quadratic(a: Point<S>, control: &Point<S>, b: Point<S>) -> Self {
        let two_thirds = S::ratio(2, 3);
        let p1 = a.plus_scaled(&two_thirds, &control.minus(&a));
        let p2 = b.plus_scaled(&two_thirds, &control.minus(&b));
        Self::new(a, p1, p2, b)
    }

    /// First control point.
    #[inline]
    pub fn start(&self) -> &Point<S> {
        &self.points[0]
    }

    /// Last control point.
    #[inline]
    pub fn end(&self) -> &Point<S> {
        &self.points[3]
    }

    /// Coefficients of powers of t.
    #[inline]
    pub fn power_basis(&self) -> PowerBasis<S> {
        let [p0, p1, p2, p3] = &self.points;
        let three = S::int(3);
        let d01 = p1.minus(p0);
        let d12 = p2.minus(p1);
        let d23 = p3.minus(p2);
        let dd0 = d12.minus(&d01);
        let dd1 = d23.minus(&d12);
        PowerBasis { origin: p0.clone(), a: [d01.scaled(&three), dd0.scaled(&three), dd1.minus(&dd0)] }
    }

    /// The point B(t), by de Casteljau's scheme: inside the hull for t in [0, 1], exact at both ends.
    pub fn eval(&self, t: &S) -> Point<S> {
        let [_, l, _] = self.split_points(t);
        l
    }

    /// De Casteljau at t: the second-level points on both sides and the point itself in the middle.
    fn split_points(&self, t: &S) -> [Point<S>; 3] {
        let lerp = |a: &Point<S>, b: &Point<S>| {
            let s = S::one() - t;
            Point::new(a.x.clone() * &s + &(b.x.clone() * t), a.y.clone() * &s + &(b.y.clone() * t))
        };
        let [p0, p1, p2, p3] = &self.points;
        let (q0, q1, q2) = (lerp(p0, p1), lerp(p1, p2), lerp(p2, p3));
        let (r0, r1) = (lerp(&q0, &q1), lerp(&q1, &q2));
        let b = lerp(&r0, &r1);
        [r0, b, r1]
    }

    /// The two halves at t; they share the point B(t) to the bit.
    pub fn split_at(&self, t: &S) -> (Self, Self) {
        let lerp = |a: &Point<S>, b: &Point<S>| {
            let s = S::one() - t;
            Point::new(a.x.clone() * &s + &(b.x.clone() * t), a.y.clone() * &s + &(b.y.clone() * t))
        };
        let [p0, p1, p2, p3] = self.points.clone();
        let q0 = lerp(&p0, &p1);
        let q2 = lerp(&p2, &p3);
        let [r0, b, r1] = self.split_points(t);
        (Self::new(p0, q0, r0, b.clone()), Self::new(b, r1, q2, p3))
    }

    /// The part between two parameters, `from` below `to`, as a cubic of its own; ends at 0 and 1 stay to the bit.
    pub fn part(&self, from: &S, to: &S) -> Self {
        let (_, right) = self.split_at(from);
        if *from >= S::one() {
            return right;
        }
        let inner = (to.clone() - from) / &(S::one() - from);
        if inner >= S::one() { right } else { right.split_at(&inner).0 }
    }

    /// Moves one end (side 0 or 1) to a point and its handle along with it, so that the tangent there stays what it was.
    pub fn move_end(&mut self, side: usize, to: Point<S>) {
        let [a, b, c, d] = &mut self.points;
        let (end, handle) = if side == 0 { (a, b) } else { (d, c) };
        let by = to.minus(end);
        *handle = handle.plus_scaled(&S::one(), &by);
        *end = to;
    }

    /// The same curve run through backwards.
    pub fn reversed(&self) -> Self {
        let [p0, p1, p2, p3] = self.points.clone();
        Self::new(p3, p2, p1, p0)
    }

    /// The box of the four control points; it holds the curve (convex hull property).
    #[inline]
    pub fn control_box(&self) -> Aabb<S> {
        Aabb::around(&self.points)
    }

    /// All coordinates are finite.
    pub fn is_finite(&self) -> bool {
        self.points.iter().all(Point::is_finite)
    }
}

/// A cubic by coefficients of powers of t: B(t) = origin + a₁ t + a₂ t² + a₃ t³.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct PowerBasis<S> {
    /// B(0).
    pub origin: Point<S>,
    /// a₁, a₂, a₃.
    pub a: [Vector<S>; 3],
}

impl<S: Scalar> PowerBasis<S> {
    /// The point B(t).
    #[inline]
    pub fn eval(&self, t: &S) -> Point<S> {
        let [a1, a2, a3] = &self.a;
        let v = a1.plus_scaled(t, &a2.plus_scaled(t, a3));
        self.origin.plus_scaled(t, &v)
    }

    /// B'(t).
    #[inline]
    pub fn derivative(&self, t: &S) -> Vector<S> {
        let [a1, a2, a3] = &self.a;
        let three_a3 = a3.scaled(&S::int(3));
        let two_a2 = Vector::new(a2.x.clone().twice(), a2.y.clone().twice());
        a1.plus_scaled(t, &two_a2.plus_scaled(t, &three_a3))
    }

    /// B''(t).
    #[inline]
    pub fn second_derivative(&self, t: &S) -> Vector<S> {
        let [_, a2, a3] = &self.a;
        let v = a2.plus_scaled(t, &a3.scaled(&S::int(3)));
        Vector::new(v.x.twice(), v.y.twice())
    }

    /// Taylor coefficients about t: B(t + v) − B(t) = b₁ v + b₂ v² + b₃ v³.
    #[inline]
    pub fn taylor(&self, t: &S) -> [Vector<S>; 3] {
        let b1 = self.derivative(t);
        let [_, a2, a3] = &self.a;
        let b2 = a2.plus_scaled(t, &a3.scaled(&S::int(3)));
        [b1, b2, a3.clone()]
    }
}
