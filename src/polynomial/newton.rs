//! Newton's method held in a bracket.
//!
//! Each value narrows the bracket; a step that would leave it or does not halve the one before is replaced by a
//! bisection, so every second step at least halves something and the method cannot run away. It stops when the step d is
//! below the resolution of the scalar, or when the next one would be: after a step d₋ it is C d² at most, with C below
//! 1/d₋ where the method converges, hence below d²/d₋. (The sharper guess d·(d/d₋)², with C taken from the last two
//! steps, stops too early where terms of C happen to cancel: found with a product of (64x − k) for k = −39, −39, 24, 91,
//! 91, off by 1e-14.)
//!
//! Close to the zero the signs of values are those of rounding errors; the narrowed bracket is a guide, not a proof, and
//! is not returned.

use crate::scalar::Scalar;

/// A zero and what was seen on the way.
pub(crate) struct Zero<S> {
    /// The zero.
    pub(crate) x: S,
    /// The derivative at the last point it was evaluated, near x.
    pub(crate) slope: S,
}

/// The zero in [lo, hi] of a function, given with its derivative, that changes its sign there; `rising`: from − to +.
#[inline]
pub(crate) fn in_bracket<S: Scalar>(f: impl Fn(&S) -> (S, S), mut lo: S, mut hi: S, rising: bool, start: S) -> Zero<S> {
    let mut x = if lo < start && start < hi { start } else { S::midpoint(&lo, &hi) };
    let mut previous = hi.clone() - &lo;
    let mut newton = false;
    let mut slope = S::zero();
    let resolution = S::unit_roundoff().twice();
    for _ in 0..4 * S::BITS {
        let (value, derivative) = f(&x);
        slope = derivative;
        if value.is_zero() {
            break;
        }
        if (value > S::zero()) == rising {
            hi = x.clone();
        } else {
            lo = x.clone();
        }
        let step = value / &slope;
        let next = x.clone() - &step;
        let step = step.abs();
        if lo <= next && next <= hi && step.clone().twice() <= previous {
            let target = next.clone().abs() * &resolution;
            let ratio = step.clone() / &previous;
            let done = step <= target || (newton && ratio * &step <= target);
            x = next;
            if done {
                break;
            }
            previous = step;
            newton = true;
        } else {
            let middle = S::midpoint(&lo, &hi);
            if middle <= lo || middle >= hi {
                x = middle;
                break;
            }
            previous = hi.clone() - &lo;
            newton = false;
            x = middle;
        }
    }
    Zero { x, slope }
}
