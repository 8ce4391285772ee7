//! The number.

use std::cmp::Ordering;
use std::fmt;
use std::ops::{Add, Div, Mul, Neg, Sub};

use feature_sampling::scalar::{Field, Scalar};
use num_traits::{One, Zero};
use rug::Float;
use rug::float::Special;
use rug::ops::NegAssign;

/// A binary floating-point number with BITS bits of significand; operations are correctly rounded to nearest, ties to even.
///
/// The exponent has more than 60 bits: results neither overflow nor underflow in practice, and there are no subnormal
/// numbers. BITS is at least 2; the [ladder](crate::ladder) has the ones in use.
#[derive(Clone, PartialEq)]
pub struct Mpfr<const BITS: u32>(Float);

impl<const BITS: u32> Mpfr<BITS> {
    /// The number nearest to that of another precision; exact where BITS is not less.
    pub fn rounded<const OTHER: u32>(other: &Mpfr<OTHER>) -> Self {
        Self(Float::with_val(BITS, &other.0))
    }

    /// The number nearest to a float of MPFR.
    pub fn from_float(value: &Float) -> Self {
        Self(Float::with_val(BITS, value))
    }

    /// The float of MPFR inside.
    pub const fn as_float(&self) -> &Float {
        &self.0
    }
}

impl<const BITS: u32> fmt::Debug for Mpfr<BITS> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

impl<const BITS: u32> fmt::Display for Mpfr<BITS> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.0, f)
    }
}

impl<const BITS: u32> Default for Mpfr<BITS> {
    fn default() -> Self {
        Self(Float::new(BITS))
    }
}

impl<const BITS: u32> PartialOrd for Mpfr<BITS> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        self.0.partial_cmp(&other.0)
    }
}

/// The four operations, with the right operand owned and borrowed; the storage of the left one is used again.
macro_rules! operation {
    ($trait:ident, $name:ident) => {
        impl<const BITS: u32> $trait for Mpfr<BITS> {
            type Output = Self;

            fn $name(self, other: Self) -> Self {
                Self(self.0.$name(&other.0))
            }
        }

        impl<const BITS: u32> $trait<&Self> for Mpfr<BITS> {
            type Output = Self;

            fn $name(self, other: &Self) -> Self {
                Self(self.0.$name(&other.0))
            }
        }
    };
}

operation!(Add, add);
operation!(Sub, sub);
operation!(Mul, mul);
operation!(Div, div);

impl<const BITS: u32> Neg for Mpfr<BITS> {
    type Output = Self;

    fn neg(mut self) -> Self {
        self.0.neg_assign();
        self
    }
}

impl<const BITS: u32> Zero for Mpfr<BITS> {
    fn zero() -> Self {
        Self::default()
    }

    fn is_zero(&self) -> bool {
        self.0.is_zero()
    }
}

impl<const BITS: u32> One for Mpfr<BITS> {
    fn one() -> Self {
        Self::int(1)
    }
}

impl<const BITS: u32> Field for Mpfr<BITS> {
    fn int(n: i32) -> Self {
        Self(Float::with_val(BITS, n))
    }

    fn mul_pow2(self, e: i32) -> Self {
        Self(self.0 << e)
    }

    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    fn abs(self) -> Self {
        Self(self.0.abs())
    }
}

impl<const BITS: u32> Scalar for Mpfr<BITS> {
    const BITS: u32 = BITS;

    fn infinity() -> Self {
        Self(Float::with_val(BITS, Special::Infinity))
    }

    fn is_finite(&self) -> bool {
        self.0.is_finite()
    }

    fn from_f64(v: f64) -> Self {
        Self(Float::with_val(BITS, v))
    }

    fn to_f64(&self) -> f64 {
        self.0.to_f64()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn laws() {
        type M = Mpfr<256>;
        assert!(M::zero().is_zero() && M::one() == M::int(1) && -M::int(3) == M::int(-3), "constants");
        assert_eq!(M::int(3).mul_pow2(-2), M::from_f64(0.75), "powers of two");
        assert_eq!(M::unit_roundoff(), M::one().mul_pow2(-256), "2^-BITS");
        assert!(!M::infinity().is_finite() && M::infinity() > M::from_f64(f64::MAX), "infinity");
        let third = M::int(1) / &M::int(3);
        let back = third.clone() * &M::int(3) - M::one();
        assert!(back.abs() <= M::unit_roundoff(), "a third, three times");
        assert!((third - &M::from_f64(1.0 / 3.0)).abs() > M::unit_roundoff(), "not the double");
        let two = M::int(2).sqrt().square() - M::int(2);
        assert!(two.abs() <= M::unit_roundoff().mul_pow2(3), "√2²");
        assert_eq!(M::from_f64(0.1).to_f64().to_bits(), 0.1_f64.to_bits(), "doubles come back");
    }

    #[test]
    fn with_53_bits_it_is_a_double() {
        // Away from the ends of the exponent range the results of all operations agree to the bit.
        let mut state = 1_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let unit = (state >> 11) as f64 / (1_u64 << 53) as f64;
            (unit - 0.5) * 2_f64.powi(i32::try_from(state % 60).unwrap_or(0) - 30)
        };
        for _ in 0..20_000 {
            let (a, b) = (random(), random());
            let (x, y) = (Mpfr::<53>::from_f64(a), Mpfr::<53>::from_f64(b));
            for (found, expected) in [
                (x.clone() + &y, a + b),
                (x.clone() - &y, a - b),
                (x.clone() * &y, a * b),
                (x.clone() / &y, a / b),
                (x.clone().abs().sqrt(), a.abs().sqrt()),
            ] {
                assert_eq!(found.to_f64().to_bits(), expected.to_bits(), "{a:e} {b:e}");
            }
            assert_eq!(x < y, a < b, "order");
        }
    }
}
