//! Numbers the kernel computes with.
//!
//! Every formula of the kernel is written once, over the traits of this module, and runs in `f32`, `f64` and any
//! other type that keeps their laws (arbitrary precision lives in a crate of its own and implements them there).
//!
//! * [`Field`] is algebra alone: + − × ÷ √ and small integers. It has no comparison on purpose, so that formulas over
//!   it also hold for intervals.
//! * [`Scalar`] adds what algorithms need to decide: an order, a precision, conversion at the door.
//! * [`Directed`] adds operations rounded outwards, and with them [`Interval`]: a `Field` that encloses, never a `Scalar`;
//!   [`Enclosure`] is its faster sibling, a few roundoffs wider.
//!
//! Only + − × ÷ √ and comparisons are used anywhere in the kernel. IEEE 754 fixes the results of these to the bit, so
//! `std` and `libm` builds agree on every target with IEEE arithmetic.
//!
//! **Manners.** The left operand is owned, the right one borrowed (`a * &b`), and nothing is `Copy`: for machine floats
//! this compiles to the same code, for numbers with a heap part it reuses the left operand's storage. A `clone()` in the
//! kernel means that the value is truly needed twice.

pub mod eft;
mod enclosure;
mod float;
mod interval;
mod math;

pub use eft::Directed;
pub use enclosure::Enclosure;
pub use interval::{Interval, Sign3};

use core::fmt::Debug;
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{One, Zero};

/// Algebra only: the operations that floats, arbitrary-precision numbers and intervals share.
///
/// Laws hold up to the type's own rounding: `int(n)` encloses or rounds n, `mul_pow2` is exact unless it leaves the range
/// of the type, `sqrt` of a negative number is not a number and is never asked for by the kernel.
pub trait Field:
    Clone
    + Debug
    + Zero
    + One
    + Neg<Output = Self>
    + Sub<Output = Self>
    + Div<Output = Self>
    + for<'a> Add<&'a Self, Output = Self>
    + for<'a> Sub<&'a Self, Output = Self>
    + for<'a> Mul<&'a Self, Output = Self>
    + for<'a> Div<&'a Self, Output = Self>
{
    /// The integer n (rounded to nearest, or enclosed).
    fn int(n: i32) -> Self;

    /// `self` × 2^e, exact unless the result leaves the normal range.
    fn mul_pow2(self, e: i32) -> Self;

    /// Non-negative square root, correctly rounded (or enclosing).
    fn sqrt(self) -> Self;

    /// Absolute value.
    fn abs(self) -> Self;

    /// The square, `self * self`.
    #[inline]
    fn square(self) -> Self {
        let same = self.clone();
        self * &same
    }

    /// Half of `self`, exact.
    #[inline]
    fn half(self) -> Self {
        self.mul_pow2(-1)
    }

    /// Twice `self`, exact.
    #[inline]
    fn twice(self) -> Self {
        self.mul_pow2(1)
    }
}

/// A field that can decide: algorithms that branch ask for this.
///
/// `PartialOrd` is total on finite values and infinities. The kernel checks for NaN at its door and never makes one.
pub trait Scalar: Field + PartialOrd {
    /// Bits of the significand (24 for `f32`, 53 for `f64`); tolerances derive from it.
    const BITS: u32;

    /// 2^−BITS, the largest relative error of one rounding.
    #[inline]
    fn unit_roundoff() -> Self {
        Self::one().mul_pow2(1 - Self::BITS.cast_signed()).half()
    }

    /// Positive infinity: an empty minimum, the lfs of a curve without medial axis.
    fn infinity() -> Self;

    /// Neither infinite nor NaN.
    fn is_finite(&self) -> bool;

    /// Rounds (or copies) a double. Never used for decimal literals: write `int(1) / &int(10)`.
    fn from_f64(v: f64) -> Self;

    /// The nearest double.
    fn to_f64(&self) -> f64;

    /// Towards zero to an integer, saturating.
    #[allow(clippy::cast_possible_truncation, reason = "a saturating cast is meant")]
    fn to_i64(&self) -> i64 {
        self.to_f64() as i64
    }

    /// A value inside [a, b], near its middle.
    #[inline]
    fn midpoint(a: &Self, b: &Self) -> Self {
        let m = (a.clone() + b).half();
        if m < *a {
            a.clone()
        } else if m > *b {
            b.clone()
        } else {
            m
        }
    }

    /// The smaller of the two; `self` if they are equal.
    #[inline]
    fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of the two; `self` if they are equal.
    #[inline]
    fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }

    /// The nearest value in [lo, hi].
    #[inline]
    fn clamp(self, lo: Self, hi: Self) -> Self {
        self.max(lo).min(hi)
    }

    /// The fraction num/den.
    #[inline]
    fn ratio(num: i32, den: i32) -> Self {
        Self::int(num) / &Self::int(den)
    }
}
