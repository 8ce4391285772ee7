//! Exact orientation and in-circle for numbers of arbitrary precision.
//!
//! The determinant is computed in its own precision first; if it is farther from zero than its rounding error can be, its
//! sign is right. Otherwise it is computed again in rational arithmetic, which makes no error at all. The sign of a rounded
//! determinant alone is never answered.

use feature_sampling::geometry::Point;
use feature_sampling::predicate::{Predicates, Sign};
use feature_sampling::scalar::{Field, Scalar};
use num_traits::Zero;
use rug::Rational;

use crate::Mpfr;

/// Exact signs for [`Mpfr`], for all finite points.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Exact;

/// x and y of b − a, rounded.
fn minus<const BITS: u32>(a: &Point<Mpfr<BITS>>, b: &Point<Mpfr<BITS>>) -> [Mpfr<BITS>; 2] {
    [a.x.clone() - &b.x, a.y.clone() - &b.y]
}

/// The same, exactly. A number that is not finite has no rational; it counts as 0.
fn exact_minus<const BITS: u32>(a: &Point<Mpfr<BITS>>, b: &Point<Mpfr<BITS>>) -> [Rational; 2] {
    let rational = |v: &Mpfr<BITS>| v.as_float().to_rational().unwrap_or_default();
    [rational(&a.x) - rational(&b.x), rational(&a.y) - rational(&b.y)]
}

/// The sign of `value`, if its error of at most `roundings` u times `size` leaves no doubt.
fn certain<const BITS: u32>(value: &Mpfr<BITS>, size: Mpfr<BITS>, roundings: i32) -> Option<Sign> {
    let error = size * &(Mpfr::int(roundings) * &Mpfr::unit_roundoff());
    (value.clone().abs() > error).then(|| Sign::of(value))
}

impl<const BITS: u32> Predicates<Mpfr<BITS>> for Exact {
    fn orient2d(a: &Point<Mpfr<BITS>>, b: &Point<Mpfr<BITS>>, c: &Point<Mpfr<BITS>>) -> Sign {
        let ([ux, uy], [vx, vy]) = (minus(b, a), minus(c, a));
        let (left, right) = (ux * &vy, uy * &vx);
        let size = left.clone().abs() + &right.clone().abs();
        // Two differences, a product, a sum: (1 + u)⁴ at most; 8 leaves room for the products of errors.
        certain(&(left - &right), size, 8).unwrap_or_else(|| {
            let ([ux, uy], [vx, vy]) = (exact_minus(b, a), exact_minus(c, a));
            Sign::of(&Exactly(ux * vy - uy * vx))
        })
    }

    fn incircle(a: &Point<Mpfr<BITS>>, b: &Point<Mpfr<BITS>>, c: &Point<Mpfr<BITS>>, d: &Point<Mpfr<BITS>>) -> Sign {
        let sides = [minus(a, d), minus(b, d), minus(c, d)];
        let (mut sum, mut size) = (Mpfr::zero(), Mpfr::zero());
        for i in 0..3 {
            let ([px, py], [qx, qy], [rx, ry]) = (&sides[i], &sides[(i + 1) % 3], &sides[(i + 2) % 3]);
            let lift = px.clone().square() + &py.clone().square();
            let (left, right) = (qx.clone() * ry, qy.clone() * rx);
            size = size + &(lift.clone() * &(left.clone().abs() + &right.clone().abs()));
            sum = sum + &(lift * &(left - &right));
        }
        // Four differences, five products and sums, two more sums.
        certain(&sum, size, 24).unwrap_or_else(|| {
            let sides = [exact_minus(a, d), exact_minus(b, d), exact_minus(c, d)];
            let mut sum = Rational::new();
            for i in 0..3 {
                let ([px, py], [qx, qy], [rx, ry]) = (&sides[i], &sides[(i + 1) % 3], &sides[(i + 2) % 3]);
                let lift = Rational::from(px.square_ref()) + Rational::from(py.square_ref());
                sum += lift * (Rational::from(qx * ry) - Rational::from(qy * rx));
            }
            Sign::of(&Exactly(sum))
        })
    }
}

/// A rational with the traits that [`Sign::of`] asks for.
#[derive(PartialEq, PartialOrd)]
struct Exactly(Rational);

impl std::ops::Add for Exactly {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl Zero for Exactly {
    fn zero() -> Self {
        Self(Rational::new())
    }

    fn is_zero(&self) -> bool {
        self.0.cmp0() == std::cmp::Ordering::Equal
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use feature_sampling::predicate::{Exact as Shewchuk, Plain};

    #[test]
    fn signs_where_rounding_decides() {
        type M = Mpfr<64>;
        // Points of a line and of a circle, moved by steps far below the precision of their products.
        let p = |x: f64, y: f64| Point::new(M::from_f64(x), M::from_f64(y));
        let q = |x: f64, y: f64| Point::new(x, y);
        let mut wrong = 0;
        for i in -20..=20 {
            for k in -20..=20 {
                let (x, y) = (0.5 + f64::from(i) * 2_f64.powi(-53), 0.5 + f64::from(k) * 2_f64.powi(-53));
                let (found, known) = (
                    Exact::orient2d(&p(x, y), &p(12.0, 12.0), &p(24.0, 24.0)),
                    Shewchuk::orient2d(&q(x, y), &q(12.0, 12.0), &q(24.0, 24.0)),
                );
                assert_eq!(found, known, "{i} {k}");
                let (found, known) = (
                    Exact::incircle(&p(x, y), &p(-0.5, 0.5), &p(-0.5, -0.5), &p(0.5, -0.5)),
                    Shewchuk::incircle(&q(x, y), &q(-0.5, 0.5), &q(-0.5, -0.5), &q(0.5, -0.5)),
                );
                assert_eq!(found, known, "{i} {k}");
                let plain: Sign = Plain::incircle(&q(x, y), &q(-0.5, 0.5), &q(-0.5, -0.5), &q(0.5, -0.5));
                wrong += u32::from(plain != known);
            }
        }
        assert!(wrong > 0, "cases that a rounded determinant gets wrong are among them");
    }
}
