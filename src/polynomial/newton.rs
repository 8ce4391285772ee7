//! Halley's method held in a bracket.
//!
//! From value f, slope f' and bend h = f''/2 a step is d = f/(f' − f/f'·h), in this order lest products underflow; near a simple zero each error is C times the
//! cube of the one before (Halley 1694), for hardly more time than Newton's square: the three are evaluated side by side.
//!
//! Each value narrows the bracket; a step that would leave it or does not halve the one before is replaced by a
//! bisection, so every second step at least halves something and the method cannot run away. It stops when the step d is
//! below the resolution of x, or when what is left is below the target: after a step d₋ that is C d³ at most, with C below
//! 1/d₋² where the method converges, hence below d³/d₋², and 4ud, since d is rounded (found by random bytes: a reciprocal root
//! at 5e-14 reached from far away, off by 5e-15 of itself). (A sharper guess that takes C from the last two steps stops too early where terms of C
//! happen to cancel: found, for Newton's method, with a product of (64x − k) for k = −39, −39, 24, 91, 91, off by 1e-14.)
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
    /// The modulus of the last step.
    pub(crate) step: S,
}

/// Where to begin.
pub(crate) struct Start<S> {
    /// The first point; the middle of the bracket if it is not inside.
    pub(crate) x: S,
    /// The modulus of the step that led there, if one did.
    pub(crate) step: Option<S>,
}

/// The zero in [lo, hi] of a function, given with its derivative and half its second derivative, that changes its sign
/// there; `rising`: from − to +. `target` is the error to stop at, for a given x.
#[inline]
pub(crate) fn in_bracket<S: Scalar>(
    f: impl Fn(&S) -> (S, S, S),
    lo: S,
    hi: S,
    rising: bool,
    start: Start<S>,
    target: impl Fn(&S) -> S,
) -> Zero<S> {
    let mut converging = start.step.is_some();
    let mut previous = start.step.unwrap_or_else(|| hi.clone() - &lo);
    let mut x = if lo < start.x && start.x < hi { start.x } else { S::midpoint(&lo, &hi) };
    let (resolution, rounding) = (S::unit_roundoff().twice(), S::unit_roundoff().mul_pow2(2));
    // As long as steps shrink inside the bracket it need not be narrowed, and nothing is there that a processor could not
    // foresee.
    for _ in 0..S::BITS {
        let (value, slope, bend) = f(&x);
        let divisor = slope.clone() - &(value.clone() / &slope * &bend);
        let step = value.clone() / &divisor;
        let next = x.clone() - &step;
        let step = step.abs();
        let is_finest = step <= next.clone().abs() * &resolution;
        if !(lo <= next && next <= hi && (is_finest || step.clone().twice() <= previous)) {
            if value.is_zero() {
                return Zero { x, slope, step: S::zero() };
            }
            break;
        }
        let rest = ((step.clone() / &previous).square() + &rounding) * &step;
        let done = is_finest || (converging && rest <= target(&next));
        x = next;
        previous = step;
        converging = true;
        if done {
            return Zero { x, slope, step: previous };
        }
    }
    narrowing(f, lo, hi, rising, x, target)
}

/// The same where steps went astray: each value narrows the bracket.
#[cold]
fn narrowing<S: Scalar>(
    f: impl Fn(&S) -> (S, S, S),
    mut lo: S,
    mut hi: S,
    rising: bool,
    mut x: S,
    target: impl Fn(&S) -> S,
) -> Zero<S> {
    let mut previous = hi.clone() - &lo;
    let mut converging = false;
    let mut slope = S::zero();
    let (resolution, rounding) = (S::unit_roundoff().twice(), S::unit_roundoff().mul_pow2(2));
    for _ in 0..4 * S::BITS {
        let (value, derivative, bend) = f(&x);
        slope = derivative;
        if value.is_zero() {
            break;
        }
        if (value > S::zero()) == rising {
            hi = x.clone();
        } else {
            lo = x.clone();
        }
        let divisor = slope.clone() - &(value.clone() / &slope * &bend);
        let step = value / &divisor;
        let next = x.clone() - &step;
        let step = step.abs();
        let is_finest = step <= next.clone().abs() * &resolution;
        if lo <= next && next <= hi && (is_finest || step.clone().twice() <= previous) {
            let rest = ((step.clone() / &previous).square() + &rounding) * &step;
            let done = is_finest || (converging && rest <= target(&next));
            x = next;
            previous = step;
            if done {
                break;
            }
            converging = true;
        } else {
            let middle = S::midpoint(&lo, &hi);
            let ends = middle <= lo || middle >= hi;
            x = middle;
            previous = hi.clone() - &lo;
            if ends {
                break;
            }
            converging = false;
        }
    }
    Zero { x, slope, step: previous }
}
