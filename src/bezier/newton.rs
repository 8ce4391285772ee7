//! Newton's method held in a bracket, to an absolute width.
//!
//! `polynomial::newton::in_bracket` serves another end: it goes on until x has all its digits *relative to x*, which roots
//! need and parameters of a segment do not (near t = 0 it would go on for digits that nobody sees), and it bisects whenever
//! a step does not halve the one before. One function for both would need the stop, the fallback and the start as
//! parameters, and share nothing but the loop.

use crate::scalar::Scalar;

/// A zero of a function between `lo` and `hi`, where it changes from positive to negative.
///
/// `f` returns value and derivative. Each step halves the bracket unless Newton's step stays well inside it; the loop ends
/// when the step is below `width`, or after 2·BITS + 16 steps at the latest. The caller has seen f(lo) > 0 > f(hi).
#[inline]
pub(crate) fn falling_zero<S: Scalar>(mut lo: S, mut hi: S, width: &S, f: impl Fn(&S) -> (S, S)) -> S {
    let mut x = S::midpoint(&lo, &hi);
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
        let next = if slope < S::zero() && newton > lo && newton < hi { newton } else { S::midpoint(&lo, &hi) };
        let step = (next.clone() - &x).abs();
        x = next;
        if step <= *width || hi.clone() - &lo <= *width {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_zero_of_a_cubic() {
        let f = |x: &f64| (0.3 - x * x * x, -3.0 * x * x);
        let x = falling_zero(0.0, 1.0, &1e-14, f);
        assert!((x - 0.3_f64.cbrt()).abs() < 1e-14, "{x}");
    }
}
