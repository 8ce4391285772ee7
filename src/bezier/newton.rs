//! Newton's method held in a bracket, to an absolute width.
//!
//! `polynomial::newton::in_bracket` serves another end: it goes on until x has all its digits *relative to x*, which roots
//! need and parameters of a segment do not (near t = 0 it would go on for digits that nobody sees), and it bisects whenever
//! a step does not halve the one before. One function for both would need the stop, the fallback and the start as
//! parameters, and share nothing but the loop.

use crate::scalar::Scalar;

/// A zero of a function between `lo` and `hi`, where it changes from positive to negative.
///
/// `f` returns value and derivative. The search starts at `x`, between `lo` and `hi`. Each step halves the bracket unless
/// Newton's stays inside it. The loop ends when the step is below `width`, or the next would be: two steps s and s' of Newton's
/// in a row promise one of s'·(s'/s)², since each is proportional to the square of the one before; or after 2·BITS + 16 steps
/// at the latest. The caller has seen f(lo) > 0 > f(hi).
#[inline]
pub(crate) fn falling_zero<S: Scalar>(mut lo: S, mut x: S, mut hi: S, width: &S, f: impl Fn(&S) -> (S, S)) -> S {
    // The step before, if it was Newton's.
    let mut last_sq = S::zero();
    for _ in 0..2 * S::BITS + 16 {
        let (value, slope) = f(&x);
        if value > S::zero() {
            lo = x.clone();
        } else if value < S::zero() {
            hi = x.clone();
        } else {
            return x;
        }
        let newton = x.clone() - &(value / &slope);
        let inside = slope < S::zero() && newton > lo && newton < hi;
        let next = if inside { newton } else { S::midpoint(&lo, &hi) };
        let step = (next.clone() - &x).abs();
        let step_sq = step.clone().square();
        x = next;
        let settled = inside && step_sq.clone() * &step <= last_sq * width;
        if settled || step <= *width || hi.clone() - &lo <= *width {
            break;
        }
        last_sq = if inside { step_sq } else { S::zero() };
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_zero_of_a_cubic() {
        let f = |x: &f64| (0.3 - x * x * x, -3.0 * x * x);
        let x = falling_zero(0.0, 0.5, 1.0, &1e-14, f);
        assert!((x - 0.3_f64.cbrt()).abs() < 1e-14, "{x}");
    }
}
