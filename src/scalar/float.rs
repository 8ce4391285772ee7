//! `f32` and `f64` as scalars.

use super::{Field, Scalar, math};

/// Implements the scalar traits for a machine float; `mul_pow2` builds 2^e from its bits, e held in the normal range.
macro_rules! machine_float {
    ($float:ident, $repr:ident, $sqrt:path, $bits:expr) => {
        impl Field for $float {
            #[inline]
            #[allow(
                clippy::cast_precision_loss,
                clippy::cast_lossless,
                reason = "the kernel's integers are small: exact in 24 bits"
            )]
            fn int(n: i32) -> Self {
                n as $float
            }

            #[inline]
            fn mul_pow2(self, e: i32) -> Self {
                const BIAS: i32 = $float::MAX_EXP - 1;
                let e = e.clamp(1 - BIAS, BIAS);
                let exponent = (e + BIAS).cast_unsigned();
                self * $float::from_bits($repr::from(exponent) << ($float::MANTISSA_DIGITS - 1))
            }

            #[inline]
            fn sqrt(self) -> Self {
                $sqrt(self)
            }

            #[inline]
            fn abs(self) -> Self {
                $float::abs(self)
            }
        }

        impl Scalar for $float {
            const BITS: u32 = $bits;

            #[inline]
            fn unit_roundoff() -> Self {
                $float::EPSILON / 2.0
            }

            #[inline]
            fn infinity() -> Self {
                $float::INFINITY
            }

            #[inline]
            fn is_finite(&self) -> bool {
                $float::is_finite(*self)
            }

            #[inline]
            #[allow(clippy::cast_possible_truncation, reason = "rounding to the type is what this function is for")]
            fn from_f64(v: f64) -> Self {
                v as $float
            }

            #[inline]
            fn to_f64(&self) -> f64 {
                f64::from(*self)
            }

            // Of its own for `f32`, so that a chip without double precision links none. Once: where integers have 32 bits it is
            // long.
            #[inline(never)]
            #[allow(clippy::cast_possible_truncation, reason = "a saturating cast is meant")]
            fn to_i64(&self) -> i64 {
                *self as i64
            }
        }
    };
}

machine_float!(f32, u32, math::sqrt_f32, 24);
machine_float!(f64, u64, math::sqrt_f64, 53);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_are_exact() {
        assert_eq!(3.0_f64.mul_pow2(-2), 0.75, "a quarter of three");
        assert_eq!(3.0_f32.mul_pow2(10), 3072.0, "three times 1024");
        assert_eq!(1.0_f64.mul_pow2(-1022), f64::MIN_POSITIVE, "the smallest normal power");
        assert_eq!(f64::unit_roundoff(), 2.0_f64.powi(-53), "half of the machine epsilon");
        assert_eq!(f32::unit_roundoff(), 2.0_f32.powi(-24), "half of the machine epsilon");
    }

    #[test]
    fn midpoint_stays_inside() {
        let (a, b) = (1.0_f64, 1.0_f64.next_up());
        let m = Scalar::midpoint(&a, &b);
        assert!(a <= m && m <= b, "between neighbours");
    }
}
