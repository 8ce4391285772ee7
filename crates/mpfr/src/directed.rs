//! Outward rounding by MPFR's own rounding modes, so that intervals have ends of any precision.

use std::cmp::Ordering;

use feature_sampling::scalar::{Directed, Field, Scalar};
use num_traits::Zero;
use rug::Float;
use rug::float::Round;
use rug::ops::{AddAssignRound, DivAssignRound, MulAssignRound};

use crate::Mpfr;

/// a ∘ b, rounded one way; `nothing` where that is not a number, but for 0 × ∞, which is 0 (an infinite end of an interval
/// stands for unbounded finite numbers).
fn rounded<const BITS: u32>(
    a: &Mpfr<BITS>,
    nothing: Mpfr<BITS>,
    operation: impl FnOnce(&mut Float) -> Ordering,
    product: bool,
) -> Mpfr<BITS> {
    let mut result = a.as_float().clone();
    // Whether it was rounded does not matter.
    let _ = operation(&mut result);
    if !result.is_nan() {
        return Mpfr::from_float(&result);
    }
    if product { Mpfr::zero() } else { nothing }
}

macro_rules! two_ways {
    ($down:ident, $up:ident, $method:ident, $product:literal) => {
        fn $down(&self, b: &Self) -> Self {
            rounded(self, -Self::infinity(), |v| v.$method(b.as_float(), Round::Down), $product)
        }

        fn $up(&self, b: &Self) -> Self {
            rounded(self, Self::infinity(), |v| v.$method(b.as_float(), Round::Up), $product)
        }
    };
}

impl<const BITS: u32> Directed for Mpfr<BITS> {
    two_ways!(add_down, add_up, add_assign_round, false);
    two_ways!(mul_down, mul_up, mul_assign_round, true);

    fn div_down(&self, b: &Self) -> Self {
        if b.is_zero() {
            return -Self::infinity();
        }
        rounded(self, -Self::infinity(), |v| v.div_assign_round(b.as_float(), Round::Down), false)
    }

    fn div_up(&self, b: &Self) -> Self {
        if b.is_zero() {
            return Self::infinity();
        }
        rounded(self, Self::infinity(), |v| v.div_assign_round(b.as_float(), Round::Up), false)
    }

    fn sqrt_down(&self) -> Self {
        if *self <= Self::zero() {
            return Self::zero();
        }
        rounded(self, Self::zero(), |v| v.sqrt_round(Round::Down), false)
    }

    fn sqrt_up(&self) -> Self {
        if *self <= Self::zero() {
            return Self::zero();
        }
        rounded(self, Self::infinity(), |v| v.sqrt_round(Round::Up), false)
    }

    fn from_f64_down(v: f64) -> Self {
        let value = Float::with_val_round(BITS, v, Round::Down).0;
        if value.is_nan() { -Self::infinity() } else { Self::from_float(&value) }
    }

    fn from_f64_up(v: f64) -> Self {
        let value = Float::with_val_round(BITS, v, Round::Up).0;
        if value.is_nan() { Self::infinity() } else { Self::from_float(&value) }
    }

    fn int_down(n: i32) -> Self {
        Self::from_float(&Float::with_val_round(BITS, n, Round::Down).0)
    }

    fn int_up(n: i32) -> Self {
        Self::from_float(&Float::with_val_round(BITS, n, Round::Up).0)
    }

    fn mul_pow2_down(&self, e: i32) -> Self {
        self.clone().mul_pow2(e)
    }

    fn mul_pow2_up(&self, e: i32) -> Self {
        self.clone().mul_pow2(e)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use feature_sampling::scalar::Interval;

    #[test]
    fn narrow_and_nested() {
        let third = |bits: u32| match bits {
            64 => third_of::<64>(),
            _ => third_of::<256>(),
        };
        // Width of the enclosure of 1/3, and whether three times that encloses 1.
        let ((narrow, holds), (wide, also)) = (third(256), third(64));
        assert!(holds && also, "enclosures");
        assert!(
            narrow > 0.0 && narrow <= 2_f64.powi(-257) && wide <= 2_f64.powi(-65),
            "one step wide: {narrow} {wide}"
        );
    }

    fn third_of<const BITS: u32>() -> (f64, bool) {
        let third = Interval::<Mpfr<BITS>>::int(1) / &Interval::int(3);
        let width = third.width().to_f64();
        let one = third * &Interval::int(3);
        let root = Interval::<Mpfr<BITS>>::int(2).sqrt().square();
        (width, one.contains(&Mpfr::int(1)) && root.contains(&Mpfr::int(2)))
    }
}
