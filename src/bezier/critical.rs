//! Parameters where a cubic changes its character: inflections, vertices (extrema of curvature), slowest points.
//!
//! With B' = a₁ + 2a₂t + 3a₃t² and so on, the curvature is B'×B''/|B'|³. It vanishes with the quadratic
//! B'×B''/2 = a₁×a₂ + 3(a₁×a₃)t + 3(a₂×a₃)t², and its derivative with the quintic (B'×B''')(B'·B') − 3(B'×B'')(B'·B'').
//! The speed |B'| is stationary where B'·B'' = 0, a cubic in t; it vanishes at cusps, which are among these.
//!
//! Medial axes have their branch tips at vertices and run to infinity at inflections; cusps have lfs 0. Algorithms split
//! curves there, so a root lost costs accuracy and one too many costs only time.
//!
//! Straight and pointlike cubics make these polynomials vanish *but for rounding*. Coefficients of a cubic carry an
//! error of about u·M each, M being the largest coordinate; a polynomial all of whose coefficients are below what such
//! errors produce is taken to be zero, and then there are no critical points. Everything is homogeneous: scaling a curve
//! by a power of two changes no result (DESIGN: tolerances relative to the cubic's own size).

use super::PowerBasis;
use crate::geometry::Vector;
use crate::polynomial::Polynomial;
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Parameters in [0, 1] where the curvature vanishes, ascending (a cusp counts once).
///
/// Exact up to the attainable error of [`Polynomial::roots_in_unit`]. Straight cubics have none.
pub fn inflections<S: Scalar>(b: &PowerBasis<S>) -> ArrayVec<S, 2> {
    let Some(size) = Size::of(b) else { return ArrayVec::new() };
    let [a1, a2, a3] = &size.a;
    let three = S::int(3);
    let p = [a1.cross(a2), a1.cross(a3) * &three, a2.cross(a3) * &three];
    if size.is_negligible(&p) {
        return ArrayVec::new();
    }
    roots(p)
}

/// Parameters in [0, 1] where the curvature is stationary (vertices of the curve), ascending.
///
/// Straight cubics have none. A cusp, where curvature is unbounded, is among the roots.
pub fn vertices<S: Scalar>(b: &PowerBasis<S>) -> ArrayVec<S, 5> {
    let Some(size) = Size::of(b) else { return ArrayVec::new() };
    let [a1, a2, a3] = &size.a;
    let three = S::int(3);
    let (c12, c13, c23) = (a1.cross(a2), a1.cross(a3), a2.cross(a3));
    if size.is_negligible(&[c12.clone(), c13.clone() * &three, c23.clone() * &three]) {
        return ArrayVec::new();
    }
    // B'×B'' / 6, B'×B''' / 6, B'·B'' / 2 and B'·B', so that the quintic is 6[(B'×B''')/6 · B'·B' − 6 (B'×B'')/6 · (B'·B'')/2 ]
    let bend = [c12 / &three, c13.clone(), c23.clone()];
    let twist = [c13, c23.twice()];
    let slow = slowness(&size.a);
    let (d11, d12, d13) = (a1.norm_sq(), a1.dot(a2), a1.dot(a3));
    let (d22, d23, d33) = (a2.norm_sq(), a2.dot(a3), a3.norm_sq());
    let speed = [
        d11,
        d12.mul_pow2(2),
        d22.mul_pow2(2) + &(d13 * &S::int(6)),
        d23 * &S::int(12),
        d33 * &S::int(9),
    ];
    let mut p: [S; 6] = core::array::from_fn(|_| S::zero());
    let six = S::int(6);
    for (i, t) in twist.iter().enumerate() {
        for (j, v) in speed.iter().enumerate() {
            accumulate(&mut p, i + j, t.clone() * v);
        }
    }
    for (i, c) in bend.iter().enumerate() {
        for (j, d) in slow.iter().enumerate() {
            accumulate(&mut p, i + j, -(c.clone() * d * &six));
        }
    }
    roots(p)
}

/// Parameters in [0, 1] where the speed |B'| is stationary, ascending; cusps are among them.
///
/// A cubic of constant speed (a line with evenly spaced control points) has none.
pub fn slowest<S: Scalar>(b: &PowerBasis<S>) -> ArrayVec<S, 3> {
    let Some(size) = Size::of(b) else { return ArrayVec::new() };
    let p = slowness(&size.a);
    if size.is_negligible(&p) {
        return ArrayVec::new();
    }
    roots(p)
}

/// B'·B''/2 = (a₁ + 2a₂t + 3a₃t²)·(a₂ + 3a₃t).
fn slowness<S: Scalar>(a: &[Vector<S>; 3]) -> [S; 4] {
    let [a1, a2, a3] = a;
    let (three, nine) = (S::int(3), S::int(9));
    [
        a1.dot(a2),
        a1.dot(a3) * &three + &a2.norm_sq().twice(),
        a2.dot(a3) * &nine,
        a3.norm_sq() * &nine,
    ]
}

/// p[i] += term.
fn accumulate<S: Scalar, const N: usize>(p: &mut [S; N], i: usize, term: S) {
    if let Some(c) = p.get_mut(i) {
        *c = term + &*c;
    }
}

/// Root values in [0, 1]; none for the zero polynomial or one that overflowed.
fn roots<S: Scalar, const N: usize, const M: usize>(p: [S; N]) -> ArrayVec<S, M> {
    let found = Polynomial::new(p).roots_in_unit().unwrap_or_default();
    found.into_iter().take(M).map(|r| r.value).collect()
}

/// A cubic brought to a size near 1 by its largest coefficient, and the noise of products of its coefficients.
struct Size<S> {
    a: [Vector<S>; 3],
    noise: S,
}

impl<S: Scalar> Size<S> {
    /// `None` for a point, or a cubic that is not finite.
    fn of(b: &PowerBasis<S>) -> Option<Self> {
        let reach = |v: &Vector<S>| v.x.clone().abs().max(v.y.clone().abs());
        let own = b.a.iter().fold(S::zero(), |m, v| m.max(reach(v)));
        let origin = b.origin.x.clone().abs().max(b.origin.y.clone().abs());
        // coefficients carry the rounding of coordinates of size `origin` or their own
        let relative = origin / &own + &S::one();
        let noise = S::unit_roundoff().mul_pow2(6) * &relative;
        if !(own > S::zero() && own.is_finite() && noise < S::one()) {
            return None;
        }
        let a = core::array::from_fn(|i| Vector::new(b.a[i].x.clone() / &own, b.a[i].y.clone() / &own));
        Some(Self { a, noise })
    }

    /// All coefficients (products of two coefficients of the cubic, times small integers) are below the noise.
    fn is_negligible<const N: usize>(&self, p: &[S; N]) -> bool {
        p.iter().all(|c| c.clone().abs() <= self.noise)
    }
}
