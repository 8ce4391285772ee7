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
//! by a power of two changes no result, since tolerances are relative to the cubic's own size.

use super::PowerBasis;
use crate::buffer::Keep;
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
#[inline(never)]
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
    let speed = [d11, d12.mul_pow2(2), d22.mul_pow2(2) + &(d13 * &S::int(6)), d23 * &S::int(12), d33 * &S::int(9)];
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
    [a1.dot(a2), a1.dot(a3) * &three + &a2.norm_sq().twice(), a2.dot(a3) * &nine, a3.norm_sq() * &nine]
}

/// p[i] += term.
fn accumulate<S: Scalar, const N: usize>(p: &mut [S; N], i: usize, term: S) {
    if let Some(c) = p.get_mut(i) {
        *c = term + &*c;
    }
}

/// Root values in [0, 1], at most `M`; none for the zero polynomial or one that overflowed.
///
/// A scalar of few bits is a chip's: there every polynomial goes through the quintics' code, the only instance that is
/// linked, and 9 KiB of flash are worth more than the time.
pub(crate) fn roots<S: Scalar, const N: usize, const M: usize>(p: [S; N]) -> ArrayVec<S, M> {
    if S::BITS <= f32::MANTISSA_DIGITS && N < 6 {
        let mut all: [S; 6] = core::array::from_fn(|_| S::zero());
        for (wide, own) in all.iter_mut().zip(p) {
            *wide = own;
        }
        return values(&Polynomial::new(all));
    }
    values(&Polynomial::new(p))
}

fn values<S: Scalar, const N: usize, const M: usize>(p: &Polynomial<S, N>) -> ArrayVec<S, M> {
    let found = p.roots_in_unit().unwrap_or_default();
    let mut values = ArrayVec::new();
    for root in found.into_iter().take(M) {
        values.keep(root.value);
    }
    values
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Cubic;
    use crate::geometry::Point;

    fn cubic(p: [(f64, f64); 4]) -> PowerBasis<f64> {
        let [a, b, c, d] = p.map(|(x, y)| Point::new(x, y));
        Cubic::new(a, b, c, d).power_basis()
    }

    /// Brute force: sign changes of f on a fine grid.
    fn changes(f: impl Fn(f64) -> f64) -> usize {
        let n = 20_000;
        let values: Vec<f64> = (0..=n).map(|i| f((f64::from(i) + 0.37) / (f64::from(n) + 1.0))).collect();
        values.windows(2).filter(|w| (w[0] > 0.0) != (w[1] > 0.0)).count()
    }

    #[test]
    fn symmetric_cases() {
        let s_shape = cubic([(0.0, 0.0), (1.0, 1.0), (2.0, -1.0), (3.0, 0.0)]);
        let found = inflections(&s_shape);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0] - 0.5).abs() < 1e-15, "{found:?}");
        let parabola = Cubic::quadratic(Point::new(-1.0, 1.0), &Point::new(0.0, -1.0), Point::new(1.0, 1.0));
        let found = vertices(&parabola.power_basis());
        assert!(found.iter().any(|t: &f64| (t - 0.5).abs() < 1e-12), "the vertex of the parabola: {found:?}");
        let cusp = cubic([(0.0, 0.0), (1.0, 1.0), (0.0, 1.0), (1.0, 0.0)]);
        let found = slowest(&cusp);
        assert!(found.iter().any(|t| (t - 0.5).abs() < 1e-12), "the cusp: {found:?}");
    }

    #[test]
    fn straight_and_pointlike_cubics_have_none() {
        let line = Cubic::line(Point::new(0.1_f64, 0.7), Point::new(931.3, -12.9)).power_basis();
        assert!(inflections(&line).is_empty() && vertices(&line).is_empty() && slowest(&line).is_empty());
        let far = Cubic::line(Point::new(1000.1_f32, 0.7), Point::new(1001.3, 4.9)).power_basis();
        assert!(inflections(&far).is_empty() && vertices(&far).is_empty());
        let uneven = cubic([(0.0, 0.0), (1.0, 2.0), (1.5, 3.0), (4.0, 8.0)]);
        assert!(inflections(&uneven).is_empty() && vertices(&uneven).is_empty());
        let point = cubic([(3.0, 3.0); 4]);
        assert!(inflections(&point).is_empty() && vertices(&point).is_empty() && slowest(&point).is_empty());
    }

    #[test]
    fn agrees_with_sign_changes_of_the_curvature() {
        let mut seed = 1_u64;
        let mut random = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f64::from(u32::try_from(seed >> 33).unwrap_or(0)) / f64::from(1_u32 << 31)
        };
        for _ in 0..100 {
            let b = cubic(core::array::from_fn(|_| (random(), random())));
            let bend = |t: f64| b.derivative(&t).cross(&b.second_derivative(&t));
            assert_eq!(inflections(&b).len(), changes(bend), "{b:?}");
            let third = Vector::new(6.0 * b.a[2].x, 6.0 * b.a[2].y);
            let turn = |t: f64| {
                let (d, dd) = (b.derivative(&t), b.second_derivative(&t));
                d.cross(&third) * d.norm_sq() - 3.0 * d.cross(&dd) * d.dot(&dd)
            };
            let found = vertices(&b);
            assert_eq!(found.len(), changes(turn), "{b:?}: {found:?}");
            let slow = |t: f64| b.derivative(&t).dot(&b.second_derivative(&t));
            assert_eq!(slowest(&b).len(), changes(slow), "{b:?}");
            let scaled = PowerBasis {
                origin: Point::new(b.origin.x * 1024.0, b.origin.y * 1024.0),
                a: b.a.map(|v| v.scaled(&1024.0)),
            };
            assert_eq!(vertices(&scaled), found, "scaling by a power of two changes no bit");
        }
    }
}
