//! Proofs that a stretch of C stays out of the tangent disks of a stretch of feet.
//!
//! For feet f with direction d (of length |d|, not necessarily 1) and a point q of C, the open disk of radius R tangent at f
//! towards d does not contain q iff
//!
//! ```text
//! G = |q−f|² − K d·(q−f) ≥ 0,   K = 2R/|d|.
//! ```
//!
//! f runs through a cell, q through a piece of a segment, and the inequality is wanted for all pairs at once. Every form here
//! is a polynomial in q's parameter v with coefficients that are enclosed over the cell; it is non-negative where all of
//! its Bernstein coefficients are. Near pairs make both terms of G vanish, so the common factors are divided out first, as in
//! `medial::pencil`, exactly and before anything is enclosed. Seen outgoing from a joint (`curve::ideal`), with the foot at
//! F(u), q at Q(v), T = F'(u), k_ij = c_i × c_j:
//!
//! * **same segment**: q−f = (v−u)D, D = c₁+c₂(u+v)+c₃(u²+uv+v²), and T×(q−f) = (v−u)²E with E = k₁₂+k₁₃(2u+v)+k₂₃(u²+2uv).
//!   G/(v−u)² has degree 4. Where the handle is retracted (c₁ = 0) T/u takes the place of T, and E = k₂₃(2v+u);
//! * **across a joint**, or any two ends at one point: q−f = vD_Q − uD_F, and T×(q−f) = u²(k₁₂+2k₁₃u+k₂₃u²) + uv M×D_Q + v² c₁×(b₂+vb₃) + v c₁×b₁ with M =
//!   2c₂+3c₃u. The last term vanishes at a smooth joint. What is left is a quadratic form a u² + b uv + c v² whose
//!   coefficients are bounded separately: scale-free at the joint;
//! * **at a fan**: f is the joint itself, one factor v is divided out;
//! * **anything else**: plain differences, degree 6, d·(q−f) by its mean value over the stretch of feet.
//!
//! The same forms evaluated at a single q bound radii from above ([`reaches`]): a disk that contains q is not empty.
//! Proofs: `docs/certificates.md`, sections 3 and 4.

use crate::curve::ideal::{Enclosed, IdealSegment, Outgoing};
use crate::curve::{Curve, EndId, JointKind};
use crate::scalar::{Directed, Enclosure as Interval, Field};
use num_traits::Zero;

/// A stretch of feet on one side of a segment, or a fan of directions at an end: everything the forms need of it.
#[derive(Clone, Debug)]
pub struct Feet<S> {
    /// The segment; for a fan any segment that ends in its joint.
    pub segment: u32,
    /// The parameter from either end of the segment; `None` for a fan.
    pub from: Option<[Interval<S>; 2]>,
    /// The end of the segment that is nearer: parameters and tangents are seen from there.
    pub side: usize,
    /// The direction is on the left of the outgoing tangent.
    pub left: bool,
    /// Encloses f.
    pub point: Enclosed<S>,
    /// Encloses d.
    pub direction: Enclosed<S>,
    /// Encloses |d|; above zero.
    pub length: Interval<S>,
    /// For a fan: d = (1−λ)e₁ + λe₂, e₁ exactly normal to the branch of this end.
    pub fan: Option<FanFeet<S>>,
    /// For a stretch: its middle, and how directions change.
    pub mean: Option<MeanFoot<S>>,
}

/// How d·(q−f) changes along a stretch of feet, for a fixed q. With d' = ±left(T') its derivative is d'·(q−f) − d·F' = d'·(q−f),
/// since d is normal to F'. So d·(q−f) = dₘ·(q−fₘ) + (u−uₘ) d'(ξ)·(q−F(ξ)) with some ξ of the stretch: of first order in the length of
/// the stretch *and* in the distance of q, where the product of enclosures is off by the length alone.
#[derive(Clone, Debug)]
pub struct MeanFoot<S> {
    /// fₘ.
    pub point: Enclosed<S>,
    /// dₘ.
    pub direction: Enclosed<S>,
    /// d', over all of the stretch.
    pub change: Enclosed<S>,
    /// u − uₘ.
    pub offset: Interval<S>,
}

impl<S: Directed> Feet<S> {
    /// Encloses d·(q−f) for all feet, q being this point, and q−f this difference.
    fn ahead(&self, q: &Enclosed<S>, difference: &Enclosed<S>) -> Interval<S> {
        let plain = self.direction.dot(difference);
        let Some(mean) = &self.mean else { return plain };
        let other = mean.direction.dot(&q.minus(&mean.point)) + &(mean.offset.clone() * &mean.change.dot(difference));
        // Both hold.
        Interval::new(plain.lo().clone().max(other.lo().clone()), plain.hi().clone().min(other.hi().clone()))
    }
}

/// Directions of a fan.
#[derive(Clone, Debug)]
pub struct FanFeet<S> {
    /// The branch that e₁ is normal to.
    pub branch: EndId,
    /// (1−λ)e₁.
    pub first: Enclosed<S>,
    /// e₂.
    pub second: Enclosed<S>,
    /// λ.
    pub share: Interval<S>,
}

/// A piece of a segment: parameters between 0 and 1 from its start.
#[derive(Clone, Debug)]
pub struct Stretch<S> {
    /// The segment.
    pub segment: u32,
    /// Where the piece starts and ends, ascending.
    pub span: [S; 2],
}

/// What proofs look at: the curve and the coefficients of C\*.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a, S> {
    /// The curve.
    pub curve: &'a Curve<'a, S>,
    /// One entry a segment ([`crate::curve::ideal::coefficients`]).
    pub ideal: &'a [IdealSegment<S>],
}

impl<S: Directed> Scene<'_, S> {
    /// A segment of C\* seen from one of its ends.
    #[inline]
    pub fn outgoing(&self, end: EndId) -> Option<&Outgoing<S>> {
        self.ideal.get(end.segment() as usize).map(|s| s.from(end.side()))
    }

    /// The ends of a segment, other than this one, that lie at its point to the bit, whether the door joined them or not: the end of a
    /// stroke may lie at a joint of another one.
    fn meeting(&self, near: EndId, segment: u32) -> impl Iterator<Item = EndId> {
        let point = self.curve.end_point(near);
        let ends = [0, 1].map(|side| EndId::new(segment, side));
        ends.into_iter().filter(move |end| *end != near && self.curve.end_point(*end) == point)
    }

    /// A segment is that of the feet, or has an end at one of theirs: [`clears`] has a form for it with a factor divided out.
    pub(super) fn touches(&self, feet: &Feet<S>, segment: u32) -> bool {
        feet.segment == segment
            || [0, 1].into_iter().any(|side| {
                (feet.from.is_some() || side == feet.side)
                    && self.meeting(EndId::new(feet.segment, side), segment).next().is_some()
            })
    }

    /// Two ends that meet are those of one smooth joint: their tangents are opposite for good.
    fn smooth(&self, near: EndId, other: EndId) -> bool {
        self.curve.end(near).is_some_and(|e| e.kind == JointKind::Smooth) && self.curve.joint(near).any(|e| e == other)
    }
}

impl<S: Directed> Stretch<S> {
    /// Lower and upper parameter, seen from one of the segment's ends.
    #[inline]
    fn seen_from(&self, side: usize) -> [Interval<S>; 2] {
        let [a, b] = &self.span;
        let (a, b) = (Interval::point(a.clone()), Interval::point(b.clone()));
        if side == 0 { [a, b] } else { [Interval::one_minus(&b), Interval::one_minus(&a)] }
    }
}

impl<S: Directed> Interval<S> {
    /// 1 − v.
    #[inline]
    fn one_minus(v: &Self) -> Self {
        Self::int(1) - v
    }
}

/// No point of the piece lies inside the open disks of radius R at any of the feet. `false` means: not proved.
pub fn clears<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>, piece: &Stretch<S>, radius: &S) -> bool {
    let Some(k) = inverse(feet, radius) else { return false };
    // On the same segment the divided form is as good as plain differences everywhere.
    near(scene, feet, piece, radius, &k)
        || !(feet.from.is_some() && feet.segment == piece.segment) && plain(scene, feet, piece, &k)
}

/// The same by the forms alone that have a common factor divided out.
pub(super) fn clears_nearby<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>, piece: &Stretch<S>, radius: &S) -> bool {
    inverse(feet, radius).is_some_and(|k| near(scene, feet, piece, radius, &k))
}

/// K.
fn inverse<S: Directed>(feet: &Feet<S>, radius: &S) -> Option<Interval<S>> {
    let k = Interval::point(radius.clone()).twice() / &feet.length;
    k.hi().is_finite().then_some(k)
}

fn near<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>, piece: &Stretch<S>, radius: &S, k: &Interval<S>) -> bool {
    let Some(from) = &feet.from else {
        let at = EndId::new(feet.segment, feet.side);
        let own = Some(at).filter(|at| at.segment() == piece.segment);
        return own.into_iter().chain(scene.meeting(at, piece.segment)).any(|end| at_fan(scene, feet, end, piece, k));
    };
    feet.segment == piece.segment && own(scene, feet, from, piece, k)
        || [feet.side, 1 - feet.side].into_iter().any(|side| {
            let near = EndId::new(feet.segment, side);
            scene.meeting(near, piece.segment).any(|other| across(scene, feet, near, other, from, piece, radius))
        })
}

/// Same segment, divided by (v−u)².
fn own<S: Directed>(
    scene: &Scene<'_, S>,
    feet: &Feet<S>,
    from: &[Interval<S>; 2],
    piece: &Stretch<S>,
    k: &Interval<S>,
) -> bool {
    let Some(o) = scene.outgoing(EndId::new(feet.segment, feet.side)) else { return false };
    let [v0, v1] = piece.seen_from(feet.side);
    let u = if feet.side == 0 { &from[0] } else { &from[1] };
    if o.retracted {
        // E = k₂₃(2v+u) vanishes with u and v, and so does D: on the side that it curves away from, the sign decides.
        let k23 = o.c[1].cross(&o.c[2]);
        if if feet.left { *k23.hi() <= S::zero() } else { *k23.lo() >= S::zero() } {
            return true;
        }
    }
    let (delta, a) = own_terms(o, u, feet.left);
    least(quartic(&delta, &a, k, &v0, &v1)) >= S::zero()
}

/// D as a quadratic in v, and E as a linear function of v with the sign of the direction.
fn own_terms<S: Directed>(o: &Outgoing<S>, u: &Interval<S>, left: bool) -> ([Enclosed<S>; 3], [Interval<S>; 2]) {
    let [c1, c2, c3] = &o.c;
    let d1 = c2.plus_scaled(u, c3);
    let d0 = c1.plus_scaled(u, &d1);
    let k23 = c2.cross(c3);
    let a = if o.retracted {
        [k23.clone() * u, k23.twice()]
    } else {
        let (k12, k13) = (c1.cross(c2), c1.cross(c3));
        let e0 = (k23.clone() * u + &k13.clone().twice()) * u + &k12;
        [e0, (k23.twice() * u) + &k13]
    };
    ([d0, d1, c3.clone()], if left { a } else { a.map(|x| -x) })
}

/// Across a joint in which `near` (of the feet's segment) and `other` (of the piece's) meet.
fn across<S: Directed>(
    scene: &Scene<'_, S>,
    feet: &Feet<S>,
    near: EndId,
    other: EndId,
    from: &[Interval<S>; 2],
    piece: &Stretch<S>,
    radius: &S,
) -> bool {
    let (Some(f), Some(q)) = (scene.outgoing(near), scene.outgoing(other)) else { return false };
    let u = if near.side() == 0 { &from[0] } else { &from[1] };
    let left = feet.left == (near.side() == feet.side);
    let speed = f.derivative(u).norm();
    if *speed.lo() <= S::zero() {
        return false;
    }
    let k = Interval::point(radius.clone()).twice() / &speed;
    let k = if left { k } else { -k };
    let [v0, v1] = piece.seen_from(other.side());
    let [c1, c2, c3] = &f.c;
    let [b1, b2, b3] = &q.c;
    let d_f = c1.plus_scaled(u, &c2.plus_scaled(u, c3));
    let m = c2.scaled(&Interval::int(2)).plus_scaled(u, &c3.scaled(&Interval::int(3)));
    // At a corner the term of first order may be left out where it takes q away from the disk.
    if !scene.smooth(near, other) {
        let first = c1.cross(b1) * &k;
        if *first.hi() > S::zero() {
            return false;
        }
    }
    let (k12, k13, k23) = (c1.cross(c2), c1.cross(c3), c2.cross(c3));
    let bend = (k23 * u + &k13.twice()) * u + &k12;
    let a = d_f.norm_sq() - &(bend * &k);
    // −2 D_F·b − k M×b for each of b₁, b₂, b₃: the coefficients of the mixed term.
    let mixed = [b1, b2, b3].map(|b| -(d_f.dot(b).twice() + &(m.cross(b) * &k)));
    let b = least(quadratic(&mixed, &v0, &v1));
    let turned = [c1.cross(b2), c1.cross(b3)];
    let c = least(quartic(&[b1.clone(), b2.clone(), b3.clone()], &turned, &k, &v0, &v1));
    non_negative(a.lo(), &b, &c, [u.lo(), u.hi()], [v0.lo(), v1.hi()])
}

/// The feet are a fan, the piece belongs to a branch of its joint: a factor v is divided out.
fn at_fan<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>, end: EndId, piece: &Stretch<S>, k: &Interval<S>) -> bool {
    let (Some(q), Some(fan)) = (scene.outgoing(end), &feet.fan) else { return false };
    let [v0, v1] = piece.seen_from(end.side());
    let [b1, b2, b3] = &q.c;
    // A retracted handle leaves one more factor v out.
    let terms = if q.retracted { [b2.clone(), b3.clone(), Enclosed::zero()] } else { [b1, b2, b3].map(Clone::clone) };
    let away = |d: &Enclosed<S>| least(quadratic(&terms.clone().map(|b| -d.dot(&b)), &v0, &v1)) >= S::zero();
    if away(&feet.direction) {
        return true;
    }
    if fan.branch != end {
        return false;
    }
    if q.retracted {
        // e₁ is normal to b₂; what is left of its part is v e₁·b₃.
        return away(&fan.second) && *fan.first.dot(b3).hi() <= S::zero();
    }
    // G/v = v(|D|² − K(1−λ)e₁·(b₂+vb₃)) − Kλ e₂·D: where the branch bends into the disk, what e₂ takes it away by is of lower order.
    let a = [fan.first.dot(b2), fan.first.dot(b3)];
    let bent = quartic(&terms, &a, k, &v0, &v1);
    if away(&fan.second) && least(bent.clone()) >= S::zero() {
        return true;
    }
    let [q0, q1, q2, q3, q4] = bent;
    let share = fan.share.clone() * k;
    let [l0, l1, l2] = quadratic(&terms.map(|b| -(fan.second.dot(&b) * &share)), &v0, &v1);
    let n = Interval::int;
    let part = |share: Interval<S>, above: Interval<S>, below: Interval<S>, of: i32| (share + &above + &below) / &n(of);
    let coefficients = [
        v0.clone() * &q0 + &l0,
        part(v0.clone() * &q1 * &n(4) + &(v1.clone() * &q0), l0.clone() * &n(3), l1.clone().twice(), 5),
        part(
            (v0.clone() * &q2 * &n(3) + &(v1.clone() * &q1).twice()).twice(),
            l0.clone() * &n(3) + &(l1.clone() * &n(6)),
            l2.clone(),
            10,
        ),
        part(
            (v0.clone() * &q3).twice().twice() + &(v1.clone() * &q2 * &n(6)),
            l0 + &(l1.clone() * &n(6)),
            l2.clone() * &n(3),
            10,
        ),
        part(v0.clone() * &q4 + &(v1.clone() * &q3 * &n(4)), l1.twice(), l2.clone() * &n(3), 5),
        v1 * &q4 + &l2,
    ];
    least(coefficients) >= S::zero()
}

/// Plain differences.
fn plain<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>, piece: &Stretch<S>, k: &Interval<S>) -> bool {
    let Some(q) = scene.outgoing(EndId::new(piece.segment, 0)) else { return false };
    let [v0, v1] = piece.seen_from(0);
    let points = control_points(q, &v0, &v1);
    let d = points.clone().map(|p| p.minus(&feet.point));
    let [p0, p1, p2, p3] = &points;
    let [d0, d1, d2, d3] = &d;
    let ahead = [feet.ahead(p0, d0), feet.ahead(p1, d1), feet.ahead(p2, d2), feet.ahead(p3, d3)];
    sextic(&d, ahead.map(|a| a * k)) >= S::zero()
}

/// Bernstein control points of a piece.
fn control_points<S: Directed>(q: &Outgoing<S>, v0: &Interval<S>, v1: &Interval<S>) -> [Enclosed<S>; 4] {
    let [c1, c2, c3] = &q.c;
    let three = Interval::int(3);
    // Polar forms of v, v² and v³ at (v0,v0,v0), (v0,v0,v1), (v0,v1,v1), (v1,v1,v1).
    let at = |e1: Interval<S>, e2: Interval<S>, e3: Interval<S>| {
        q.end.plus_scaled(&e1, c1).plus_scaled(&e2, c2).plus_scaled(&e3, c3)
    };
    let (s0, s1, m) = (v0.clone().square(), v1.clone().square(), v0.clone() * v1);
    [
        at(v0.clone(), s0.clone(), s0.clone() * v0),
        at((v0.clone().twice() + v1) / &three, (s0.clone() + &m.clone().twice()) / &three, s0 * v1),
        at((v1.clone().twice() + v0) / &three, (s1.clone() + &m.twice()) / &three, s1.clone() * v0),
        at(v1.clone(), s1.clone(), s1 * v1),
    ]
}

/// The smallest lower bound.
fn least<S: Directed, const N: usize>(coefficients: [Interval<S>; N]) -> S {
    coefficients.into_iter().map(|g| g.lo().clone()).fold(S::infinity(), S::min)
}

/// Bernstein coefficients of p₀ + p₁v + p₂v² on [v0, v1].
fn quadratic<S: Directed>(p: &[Interval<S>; 3], v0: &Interval<S>, v1: &Interval<S>) -> [Interval<S>; 3] {
    let [p0, p1, p2] = p;
    let at = |v: &Interval<S>| (p2.clone() * v + p1) * v + p0;
    let middle = p1.clone() * &(v0.clone() + v1).half() + &(p2.clone() * &(v0.clone() * v1)) + p0;
    [at(v0), middle, at(v1)]
}

/// Bernstein coefficients of |Δ|² − K A on [v0, v1], Δ quadratic and A linear in v.
fn quartic<S: Directed>(
    delta: &[Enclosed<S>; 3],
    a: &[Interval<S>; 2],
    k: &Interval<S>,
    v0: &Interval<S>,
    v1: &Interval<S>,
) -> [Interval<S>; 5] {
    let [e0, e1, e2] = delta;
    let at = |v: &Interval<S>| e0.plus_scaled(v, &e1.plus_scaled(v, e2));
    let (d0, d2) = (at(v0), at(v1));
    let d1 = e0.plus_scaled(&(v0.clone() + v1).half(), e1).plus_scaled(&(v0.clone() * v1), e2);
    let [a0, a1] = a;
    let (f0, f1) = ((a1.clone() * v0 + a0) * k, (a1.clone() * v1 + a0) * k);
    let middle = (f0.clone() + &f1).half();
    let three = Interval::int(3);
    [
        d0.norm_sq() - &f0,
        d0.dot(&d1) - &(f0.clone() + &middle).half(),
        (d1.norm_sq().twice() + &d0.dot(&d2)) / &three - &middle,
        d1.dot(&d2) - &(middle.clone() + &f1).half(),
        d2.norm_sq() - &f1,
    ]
}

/// Smallest Bernstein coefficient (lower bound) of |Δ|² − A, Δ and A cubic with these control points.
fn sextic<S: Directed>(d: &[Enclosed<S>; 4], [a0, a1, a2, a3]: [Interval<S>; 4]) -> S {
    let [d0, d1, d2, d3] = d;
    let n = Interval::int;
    let five = n(5);
    least([
        d0.norm_sq() - &a0,
        d0.dot(d1) - &(a0.clone() + &a1).half(),
        (d0.dot(d2).twice() + &(d1.norm_sq() * &n(3)) - &(a0.clone() + &(a1.clone() * &n(3)) + &a2)) / &five,
        (d0.dot(d3) + &(d1.dot(d2) * &n(9)) - &((a0 + &a3).half() + &((a1.clone() + &a2) * &n(9)).half())) / &n(10),
        (d1.dot(d3).twice() + &(d2.norm_sq() * &n(3)) - &(a1 + &(a2.clone() * &n(3)) + &a3)) / &five,
        d2.dot(d3) - &(a2 + &a3).half(),
        d3.norm_sq() - &a3,
    ])
}

/// a u² + b uv + c v² ≥ 0 for all u, v ≥ 0 of these ranges.
fn non_negative<S: Directed>(a: &S, b: &S, c: &S, u: [&S; 2], v: [&S; 2]) -> bool {
    let zero = S::zero();
    let (ai, bi, ci) = (Interval::point(a.clone()), Interval::point(b.clone()), Interval::point(c.clone()));
    if *a >= zero && *c >= zero {
        let four = (ai.clone() * &ci).mul_pow2(2);
        if *b >= zero || bi.clone().square().certainly_le(&four) {
            return true;
        }
    }
    // The smallest value on a rectangle is at a corner, at a vertex on an edge, or at a minimum inside, where it is 0.
    let edge = |x: &S, p: &Interval<S>, r: &Interval<S>, y: [&S; 2]| {
        let x = Interval::point(x.clone());
        let x2 = x.clone().square();
        let at = |y: &S| {
            let y = Interval::point(y.clone());
            p.clone() * &x2 + &(bi.clone() * &x * &y) + &(r.clone() * &y.square())
        };
        let ends = *at(y[0]).lo() >= zero && *at(y[1]).lo() >= zero;
        if !ends || *r.lo() <= zero {
            return ends;
        }
        // The vertex of a rising parabola, wherever it is.
        let vertex = -(bi.clone() * &x) / &r.clone().twice();
        if *vertex.hi() <= *y[0] || *vertex.lo() >= *y[1] {
            return true;
        }
        let least = (p.clone() - &(bi.clone().square() / &r.clone().mul_pow2(2))) * &x2;
        *least.lo() >= zero
    };
    edge(u[0], &ai, &ci, v) && edge(u[1], &ai, &ci, v) && edge(v[0], &ci, &ai, u) && edge(v[1], &ci, &ai, u)
}

/// An upper bound of the radii of the largest empty disks at all of the feet, from a point of C that they cannot contain.
/// Infinite where the point gives none.
pub fn reaches<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>, segment: u32, t: &S) -> S {
    let piece = Stretch { segment, span: [t.clone(), t.clone()] };
    let mut best = S::infinity();
    let mut offer = |b: &Interval<S>, a: Interval<S>, length: &Interval<S>| {
        if *a.lo() > S::zero() {
            let r = b.clone() * length / &a.twice();
            best = best.clone().min(r.hi().clone());
        }
    };
    if let Some(from) = &feet.from {
        if feet.segment == segment
            && let Some(o) = scene.outgoing(EndId::new(segment, feet.side))
        {
            let [v, _] = piece.seen_from(feet.side);
            let u = if feet.side == 0 { &from[0] } else { &from[1] };
            let ([d0, d1, d2], [a0, a1]) = own_terms(o, u, feet.left);
            let d = d0.plus_scaled(&v, &d1.plus_scaled(&v, &d2));
            offer(&d.norm_sq(), a1 * &v + &a0, &feet.length);
        }
        for side in 0..2 {
            let near = EndId::new(feet.segment, side);
            let u = if side == 0 { &from[0] } else { &from[1] };
            for other in scene.meeting(near, segment) {
                let (Some(f), Some(q)) = (scene.outgoing(near), scene.outgoing(other)) else { continue };
                let speed = f.derivative(u).norm();
                if f.retracted || *speed.lo() <= S::zero() {
                    continue;
                }
                let smooth = scene.smooth(near, other);
                let [v, _] = piece.seen_from(other.side());
                let [c1, c2, c3] = &f.c;
                let [b1, b2, b3] = &q.c;
                let d_f = c1.plus_scaled(u, &c2.plus_scaled(u, c3));
                let d_q = b1.plus_scaled(&v, &b2.plus_scaled(&v, b3));
                let m = c2.scaled(&Interval::int(2)).plus_scaled(u, &c3.scaled(&Interval::int(3)));
                let (k12, k13, k23) = (c1.cross(c2), c1.cross(c3), c2.cross(c3));
                let bend = ((k23 * u + &k13.twice()) * u + &k12) * &u.clone().square();
                let mixed = m.cross(&d_q) * u * &v;
                let turned = c1.cross(&b2.plus_scaled(&v, b3)) * &v.clone().square();
                let first = if smooth { Interval::zero() } else { c1.cross(b1) * &v };
                let a = bend + &mixed + &turned + &first;
                let left = feet.left == (side == feet.side);
                let b = d_q.scaled(&v).minus(&d_f.scaled(u)).norm_sq();
                offer(&b, if left { a } else { -a }, &speed);
            }
        }
    }
    if let Some(q) = scene.outgoing(EndId::new(segment, 0)) {
        let q = q.point(&Interval::point(t.clone()));
        let d = q.minus(&feet.point);
        offer(&d.norm_sq(), feet.ahead(&q, &d), &feet.length);
    }
    best
}

/// An upper bound of the radii of curvature towards the direction at all of the feet; infinite where one does not curve there.
pub fn osculates<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>) -> S {
    let (Some(from), Some(o)) = (&feet.from, scene.outgoing(EndId::new(feet.segment, feet.side))) else {
        return S::infinity();
    };
    let u = if feet.side == 0 { &from[0] } else { &from[1] };
    let (_, [a0, a1]) = own_terms(o, u, feet.left);
    // E(u, u): half of T × B''; D(u, u) = B'(u).
    let cubed = feet.length.clone().square() * &feet.length;
    let (cubed, e) = if o.retracted {
        // D = uT and E = 3k₂₃u: one u is divided out.
        (cubed * u, a1.half() * &Interval::int(3))
    } else {
        (cubed, a1 * u + &a0)
    };
    if *e.lo() > S::zero() { (cubed / &e.twice()).hi().clone() } else { S::infinity() }
}

/// Curvature towards the direction at the feet; `None` where it has no bound.
pub fn curvature<S: Directed>(scene: &Scene<'_, S>, feet: &Feet<S>) -> Option<Interval<S>> {
    let (Some(from), Some(o)) = (&feet.from, scene.outgoing(EndId::new(feet.segment, feet.side))) else { return None };
    if o.retracted {
        return None;
    }
    let u = if feet.side == 0 { &from[0] } else { &from[1] };
    let (_, [a0, a1]) = own_terms(o, u, feet.left);
    let k = (a1 * u + &a0).twice() / &(feet.length.clone().square() * &feet.length);
    (k.lo().is_finite() && k.hi().is_finite()).then_some(k)
}
