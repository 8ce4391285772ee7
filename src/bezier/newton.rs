//! Newton's method held in a bracket, to an absolute width.
//!
//! `polynomial::newton::in_bracket` serves another end: it goes on until x has all its digits *relative to x*, which roots
//! need and parameters of a segment do not (near t = 0 it would go on for digits that nobody sees), and it bisects whenever
//! a step does not halve the one before. One function for both would need the stop, the fallback and the start as
//! parameters, and share nothing but the loop.

use crate::scalar::Scalar;

/// A zero of a function between `lo` and `hi`, where it changes from positive to negative.
///
/// `f` returns value and derivative. The search starts in the middle. Each step halves the bracket unless Newton's stays
/// inside it. The loop ends when the step is below `width`, or the next would be: two steps s and s' of Newton's
/// in a row promise one of s'·(s'/s)², since each is proportional to the square of the one before; or after 2·BITS + 16 steps
/// at the latest. The caller has seen f(lo) > 0 > f(hi).
///
/// One function for all callers: it is needed where arcs are first met, not at every foot, and a chip's flash is small.
#[inline(never)]
pub(crate) fn falling_zero<S: Scalar>(mut lo: S, mut hi: S, width: &S, f: &dyn Fn(&S) -> (S, S)) -> S {
    let mut x = S::midpoint(&lo, &hi);
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

/// Steps of [`falling_zero_near`]: from a neighbour's zero it takes two or three.
const NEAR_STEPS: u32 = 8;

/// A zero at which a function falls, by Newton's method from `x` alone: `None` where that leaves [`lo`, `hi`], comes to where
/// the function does not fall, or goes on for long. It ends like [`falling_zero`].
#[inline]
pub(crate) fn falling_zero_near<S: Scalar>(mut x: S, lo: &S, hi: &S, width: &S, f: impl Fn(&S) -> (S, S)) -> Option<S> {
    let mut last_sq = S::zero();
    for _ in 0..NEAR_STEPS {
        let (value, slope) = f(&x);
        let step = value / &slope;
        x = x - &step;
        // Not a number is neither.
        if !(slope < S::zero() && x >= *lo && x <= *hi) {
            return None;
        }
        let step = step.abs();
        let step_sq = step.clone().square();
        if step <= *width || step_sq.clone() * &step <= last_sq * width {
            return Some(x);
        }
        last_sq = step_sq;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_zero_of_a_cubic() {
        let f = |x: &f64| (0.3 - x * x * x, -3.0 * x * x);
        let x = falling_zero(0.0, 1.0, &1e-14, &f);
        assert!((x - 0.3_f64.cbrt()).abs() < 1e-14, "{x}");
        let near = |x: f64| falling_zero_near(x, &0.0, &1.0, &1e-14, f);
        assert!(near(0.6).is_some_and(|x| (x - 0.3_f64.cbrt()).abs() < 1e-14));
        assert_eq!(near(0.0), None, "it does not fall there");
        assert_eq!(near(0.01), None, "the first step leads far away");
        assert_eq!(near(f64::NAN), None);
    }
}
