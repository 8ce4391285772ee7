//! Scaling by powers of two: the roots do not notice, overflow and underflow go away.

use super::Polynomial;
use crate::scalar::Scalar;
use core::array::from_fn;

/// 2^±COMFORT: coefficients of this size cannot overflow or vanish in anything the solver does, in any scalar.
const COMFORT: i32 = 32;

/// Steps of the ladder: enough for every double; scalars of wider range need no scaling.
const STEPS: usize = 80;

impl<S: Scalar, const N: usize> Polynomial<S, N> {
    /// Σ|aⱼ|; infinite or NaN if a coefficient is.
    #[inline]
    pub(crate) fn weight(&self) -> S {
        let mut sum = S::zero();
        for c in &self.coefficients {
            sum = sum + &c.clone().abs();
        }
        sum
    }

    /// The sum of moduli is of comfortable size: no scaling needed.
    #[inline]
    pub(crate) fn is_comfortable(weight: &S) -> bool {
        *weight < S::one().mul_pow2(COMFORT) && *weight > S::one().mul_pow2(-COMFORT)
    }

    /// The polynomial times a power of two that brings its largest coefficient near 1; exact but for coefficients
    /// more than the scalar's range below the largest.
    #[cold]
    pub(super) fn normalised(&self) -> Self {
        let mut scaled = self.clone();
        for step in [COMFORT, 4] {
            let (high, low) = (S::one().mul_pow2(step), S::one().mul_pow2(-step));
            for _ in 0..STEPS {
                let largest = scaled.coefficients.iter().fold(S::zero(), |m, c| m.max(c.clone().abs()));
                let e = if largest > high {
                    -step
                } else if largest < low && !largest.is_zero() {
                    step
                } else {
                    break;
                };
                scaled = Self::new(from_fn(|j| scaled.coefficients[j].clone().mul_pow2(e)));
            }
        }
        scaled
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Field;

    #[test]
    fn comes_near_one_exactly() {
        for e in [-1000, -300, -33, 0, 5, 200, 1000] {
            let p = Polynomial::new([3.0_f64.mul_pow2(e), (-5.0_f64).mul_pow2(e)]).normalised();
            let [a, b] = p.coefficients;
            assert_eq!(a / b, -0.6, "ratio kept at 2^{e}");
            assert!(b.abs() <= 16.0 && b.abs() >= 1.0 / 16.0, "size of {b} from 2^{e}");
        }
        let tiny = Polynomial::new([f64::from_bits(1), 0.0]).normalised();
        assert!(tiny.coefficients[0] >= 1.0 / 16.0, "the smallest double");
    }
}
