//! The pencil of disks tangent at a foot point, seen from another segment, without cancellation.
//!
//! The disk through f with centre in direction d that touches the point q has the curvature
//!
//! ```text
//! 1/r = 2 A/B   with   A = d·(q−f),   B = |q−f|².
//! ```
//!
//! Along a segment q(t), A and the vector q−f are polynomials. Where q comes near f, both A and B vanish and the quotient of
//! the plain differences is noise, so three forms are used:
//!
//! * **same segment**: the segment is a₀ + a₁t + a₂t² + a₃t³ and f its point at s. With q−f = (t−s)Δ and the unit normal d at
//!   s, (t−s)² is a factor of both and is left out: Δ = a₁ + a₂(s+t) + a₃(s²+st+t²), A = d·(a₂ + a₃(2s+t)), B = |Δ|². As
//!   t → s, 2A/B is the curvature;
//! * **across a joint** e: with u = s−e on f's segment F and v = t−e' on q's segment Q,
//!   q−f = v b₁ + v² b₂ + v³ b₃ − u D_F and, if the joint is smooth,
//!   N(s)·(q−f) = u² E_F(s,e) + u v M×D_Q ± μ v² N_Q·(b₂ + v b₃): each term is small by itself, none is a difference of
//!   large ones. Here D_F = (B_F(s)−B_F(e))/u, M = (B_F'(s)−B_F'(e))/u, μ = |B_F'(e)|/|B_Q'(e')|, and the sign says whether
//!   the two segments run the same way;
//! * **anything else**: plain differences.
//!
//! From A the noise of the coordinates is subtracted, so that rounding never makes a disk collapse, nor bends a straight
//! line.
//!
//! Derivations: `docs/mathematics.md`, section 4.

use super::foot::{Foot, Side};
use crate::curve::{Curve, EndId, JointKind, Segment};
use crate::geometry::Vector;
use crate::scalar::Scalar;

/// A(v) and Δ(v) for one foot and one segment, v = t − shift. 1/r = 2A/|Δ|².
#[derive(Clone, Debug)]
pub(super) struct Pencil<S> {
    /// Coefficients of A, ascending.
    a: [S; 4],
    /// Coefficients of Δ, ascending.
    delta: [Vector<S>; 4],
    /// Parameter of the segment where v = 0.
    pub(super) shift: S,
    /// Squared distances up to this are a touching: the noise of plain differences. 0 for the other forms.
    pub(super) touching: S,
}

/// Values of a pencil at one parameter.
pub(super) struct Values<S> {
    /// A: positive where a disk in direction d can touch.
    pub(super) a: S,
    /// B = |Δ|².
    pub(super) b: S,
    /// A'B − AB': has the sign of the derivative of A/B.
    pub(super) slope: S,
    /// Δ.
    pub(super) delta: Vector<S>,
    /// A'.
    pub(super) a_slope: S,
    /// Δ'.
    pub(super) delta_slope: Vector<S>,
    /// B'/2: negative while Δ comes nearer to 0.
    pub(super) approach: S,
}

/// A − βB beyond its tangent at a parameter v.
pub(super) struct Beyond<S> {
    /// The coefficients of w² to w⁵ in A(v+w) − βB(v+w). That of w⁶ is −β|d₃|², never positive.
    pub(super) coefficients: [S; 4],
    /// Their rounding, and that of their sum for |w| ≤ 1.
    pub(super) rounding: S,
    /// The sum of the squares of the coefficients of w, w² and w³ in Δ(v+w).
    pub(super) speeds_sq: S,
}

impl<S: Scalar> Pencil<S> {
    /// Which of a segment's pencils serves best around the parameter t; the same answer means the same pencil.
    ///
    /// On the foot's own segment: whether t is nearer to f around the ends than along the segment. On any other: whether t
    /// lies in its second half.
    pub(super) fn part(foot: &Foot<S>, index: u32, t: &S) -> bool {
        let half = S::one().half();
        if index == foot.at.segment && foot.side != Side::Fan {
            (t.clone() - &foot.at.t).abs() > half
        } else {
            *t > half
        }
    }

    /// The pencil of `foot` seen from the segment with this index. `t` says which part of it is of interest: only its
    /// precision depends on that, through [`Pencil::part`].
    #[inline]
    pub(super) fn new(curve: &Curve<'_, S>, foot: &Foot<S>, index: u32, segment: &Segment<S>, t: &S) -> Self {
        let half = S::one().half();
        if index == foot.at.segment && foot.side != Side::Fan {
            // A closed segment can come back to f at its other end: that is seen across the joint. Anywhere nearer the
            // divided form is the only precise one.
            let around =
                Self::part(foot, index, t) && curve.ring(EndId::new(index, 0)).any(|e| e == EndId::new(index, 1));
            if !around {
                return Self::own(curve, foot, segment);
            }
        }
        let near_end = foot.end.unwrap_or_else(|| EndId::new(foot.at.segment, usize::from(foot.at.t > half)));
        let candidate = |e: &EndId| e.segment() == index && (*e != near_end || foot.side == Side::Fan);
        let mut ends = curve.ring(near_end).filter(candidate);
        if let Some(first) = ends.next() {
            // A segment that meets the joint with both ends is seen across the one that is nearer.
            let nearer = ends.find(|e| (e.side() == 1) == (*t > half));
            let other = nearer.filter(|_| (first.side() == 1) != (*t > half)).unwrap_or(first);
            return Self::across(curve, foot, near_end, other, segment);
        }
        Self::plain(curve, foot, segment)
    }

    /// Plain differences.
    fn plain(curve: &Curve<'_, S>, foot: &Foot<S>, segment: &Segment<S>) -> Self {
        let [a1, a2, a3] = &segment.power.a;
        let d = &foot.direction;
        let origin = segment.power.origin.minus(&foot.point);
        Self {
            a: [d.dot(&origin) - curve.noise, d.dot(a1), d.dot(a2), d.dot(a3)],
            delta: [origin, a1.clone(), a2.clone(), a3.clone()],
            shift: S::zero(),
            touching: (curve.noise.clone() * &S::int(4)).square(),
        }
    }

    /// The foot's own segment, divided by (t−s)².
    fn own(curve: &Curve<'_, S>, foot: &Foot<S>, segment: &Segment<S>) -> Self {
        let [a1, a2, a3] = &segment.power.a;
        let s = &foot.at.t;
        let d1 = a2.plus_scaled(s, a3);
        let d0 = a1.plus_scaled(s, &d1);
        let e0 = foot.direction.dot(&a2.plus_scaled(&s.clone().twice(), a3));
        let e1 = foot.direction.dot(a3);
        Self {
            a: [e0 - curve.noise, e1, S::zero(), S::zero()],
            delta: [d0, d1, a3.clone(), Vector::zero()],
            shift: S::zero(),
            touching: S::zero(),
        }
    }

    /// Across the joint in which `near` (of the foot's segment) and `other` (of this segment) meet.
    fn across(curve: &Curve<'_, S>, foot: &Foot<S>, near: EndId, other: EndId, segment: &Segment<S>) -> Self {
        let shift = if other.side() == 0 { S::zero() } else { S::one() };
        let [b1, b2, b3] = segment.power.taylor(&shift);
        let d = &foot.direction;
        let own = curve.segment(near.segment());
        let smooth = own.is_some_and(|o| o.end(near.side()).kind == JointKind::Smooth);
        // Along the common tangent the component of b₁ in direction d is exactly zero when f is the joint itself.
        let on_joint = foot.end == Some(near);
        if on_joint && foot.side != Side::Fan && smooth {
            // A and B have the common factor v².
            return Self {
                a: [d.dot(&b2) - curve.noise, d.dot(&b3), S::zero(), S::zero()],
                delta: [b1, b2, b3, Vector::zero()],
                shift,
                touching: S::zero(),
            };
        }
        if on_joint {
            return Self {
                a: [S::zero(), d.dot(&b1), d.dot(&b2), d.dot(&b3)],
                delta: [Vector::zero(), b1, b2, b3],
                shift,
                touching: S::zero(),
            };
        }
        let Some(own) = own else { return Self::plain(curve, foot, segment) };
        let e = if near.side() == 0 { S::zero() } else { S::one() };
        let s = &foot.at.t;
        let u = s.clone() - &e;
        let [c1, c2, c3] = &own.power.a;
        // D_F(s,e) = c₁ + c₂(s+e) + c₃(s²+se+e²), E_F = N(s)·(c₂ + c₃(2s+e)); d is N(s)/|N(s)| up to its sign.
        let sum = s.clone() + &e;
        let d_f = c1.plus_scaled(&sum, c2).plus_scaled(&(sum.clone() * s + &e), c3);
        let e_f = d.dot(&c2.plus_scaled(&(sum.clone() + s), c3));
        let delta0 = d_f.scaled(&-u.clone());
        let a0 = u.clone().square() * &e_f;
        let speed_q = b1.norm();
        if !smooth || foot.speed <= S::zero() || speed_q <= S::zero() {
            return Self {
                a: [a0, d.dot(&b1), d.dot(&b2), d.dot(&b3)],
                delta: [delta0, b1, b2, b3],
                shift,
                touching: S::zero(),
            };
        }
        // d·(q−e) with d written as the turned tangent at the joint plus what F's tangent turns on its way from there.
        // Everything is relative to |N(s)| = speed; sigma is the side that d is on.
        let tangent = own.power.derivative(s);
        let sigma = if tangent.left().dot(d) < S::zero() { -S::one() } else { S::one() };
        let k = sigma / &foot.speed;
        let m = Vector::new(c2.x.clone().twice(), c2.y.clone().twice()).plus_scaled(&(sum * &S::int(3)), c3);
        let tangent_e = own.power.derivative(&e);
        let mu = tangent_e.norm() / &speed_q;
        let mu = if tangent_e.dot(&b1) < S::zero() { -mu } else { mu };
        let uk = u * &k;
        let muk = mu * &k;
        let a1 = m.cross(&b1) * &uk;
        let a2 = m.cross(&b2) * &uk + &(b1.cross(&b2) * &muk);
        let a3 = m.cross(&b3) * &uk + &(b1.cross(&b3) * &muk);
        Self { a: [a0, a1, a2, a3], delta: [delta0, b1, b2, b3], shift, touching: S::zero() }
    }

    /// A, B and the slope's sign at v = t − shift.
    #[inline]
    pub(super) fn at(&self, v: &S) -> Values<S> {
        let (a, a_slope) = self.a_and_slope(v);
        let (d, d_slope) = self.delta_and_slope(v);
        let b = d.norm_sq();
        let approach = d.dot(&d_slope);
        let slope = a_slope.clone() * &b - &(a.clone() * &approach).twice();
        Values { a, b, slope, delta: d, a_slope, delta_slope: d_slope, approach }
    }

    /// No disk in direction d touches the segment between two parameters: it bends to the other side of the tangent. Looked at only where
    /// A is linear: on the foot's own segment, and on one that begins at the joint the foot stands on. `false` says nothing.
    #[inline]
    pub(super) fn turns_away(&self, span: &[S; 2]) -> bool {
        let [a0, a1, a2, a3] = &self.a;
        let linear = self.touching.is_zero() && self.shift.is_zero() && a2.is_zero() && a3.is_zero();
        linear && span.iter().all(|t| a1.clone() * t + a0 <= S::zero())
    }

    /// A'B − AB' and its derivative A''B − AB''.
    #[inline]
    pub(super) fn slope(&self, v: &S) -> (S, S) {
        let (a, a_slope) = self.a_and_slope(v);
        let (d, d_slope) = self.delta_and_slope(v);
        let [_, _, a2, a3] = &self.a;
        let [_, _, d2, d3] = &self.delta;
        let three_v = v.clone() * &S::int(3);
        let a_bend = (a3.clone() * &three_v + a2).twice();
        let d_bend = d2.plus_scaled(&three_v, d3);
        let b = d.norm_sq();
        let b_slope = d.dot(&d_slope).twice();
        // B'' = 2(|Δ'|² + Δ·Δ''), Δ'' = 2 (d₂ + 3 d₃ v).
        let b_bend = (d_slope.norm_sq() + &d.dot(&d_bend).twice()).twice();
        (a_slope * &b - &(a.clone() * &b_slope), a_bend * &b - &(a * &b_bend))
    }

    /// What A − βB has beyond its tangent at v.
    #[inline]
    pub(super) fn beyond_tangent(&self, v: &S, at: &Values<S>, beta: &S) -> Beyond<S> {
        let [_, _, a2, a3] = &self.a;
        let [_, _, d2, d3] = &self.delta;
        let three_v = v.clone() * &S::int(3);
        let a2 = a3.clone() * &three_v + a2;
        let (d0, d1, d2) = (&at.delta, &at.delta_slope, d2.plus_scaled(&three_v, d3));
        let b2 = d1.norm_sq() + &d0.dot(&d2).twice();
        let b3 = (d1.dot(&d2) + &d0.dot(d3)).twice();
        let b4 = d1.dot(d3).twice() + &d2.norm_sq();
        let b5 = d2.dot(d3).twice();
        let speeds_sq = d1.norm_sq() + &d2.norm_sq() + &d3.norm_sq();
        let size = a2.clone().abs() + &a3.clone().abs() + &((at.b.clone() + &speeds_sq) * beta);
        Beyond {
            coefficients: [a2 - &(b2 * beta), a3.clone() - &(b3 * beta), -(b4 * beta), -(b5 * beta)],
            rounding: size * &S::unit_roundoff().mul_pow2(6),
            speeds_sq,
        }
    }

    /// −B'/2 and its derivative.
    #[inline]
    pub(super) fn recession(&self, v: &S) -> (S, S) {
        let (d, d_slope) = self.delta_and_slope(v);
        let [_, _, d2, d3] = &self.delta;
        let d_bend = d2.plus_scaled(&(v.clone() * &S::int(3)), d3);
        (-d.dot(&d_slope), -(d_slope.norm_sq() + &d.dot(&d_bend).twice()))
    }

    /// A and A' at v.
    #[inline]
    pub(super) fn a_and_slope(&self, v: &S) -> (S, S) {
        let [a0, a1, a2, a3] = &self.a;
        let h2 = a3.clone() * v + a2;
        let h1 = h2.clone() * v + a1;
        let value = h1.clone() * v + a0;
        let slope = (a3.clone() * v + &h2) * v + &h1;
        (value, slope)
    }

    #[inline]
    fn delta_and_slope(&self, v: &S) -> (Vector<S>, Vector<S>) {
        let [d0, d1, d2, d3] = &self.delta;
        let h2 = d2.plus_scaled(v, d3);
        let h1 = d1.plus_scaled(v, &h2);
        let value = d0.plus_scaled(v, &h1);
        let slope = h1.plus_scaled(v, &h2.plus_scaled(v, d3));
        (value, slope)
    }
}
