//! Halley's method held in a bracket.
//!
//! From value f, slope f' and bend h = f''/2 a step is d = f/(f' − f/f'·h); near a simple zero each error is C times the cube of
//! the one before (Halley 1694), for hardly more time than Newton's square: the three are evaluated side by side.
//!
//! A step that would leave the bracket or does not halve the one before hands over to bisection, where each value narrows the
//! bracket, so every second step at least halves something and the method cannot run away. It stops when the step d is below
//! the resolution of x, or when what is left is below the target: after a step d₋ that is C d³ at most, with C below 1/d₋² where
//! the method converges, hence below d³/d₋², and 4ud, since d is rounded (found by random bytes: a reciprocal root at 5e-14
//! reached from far away, off by 5e-15 of itself). A sharper guess that takes C from the last two steps stops too early where
//! terms of C happen to cancel (found, for Newton's method, with a product of (64x − k) for k = −39, −39, 24, 91, 91, off by
//! 1e-14).
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

/// The step from value f, slope f' and half the second derivative h: f f'/(f'² − f h), with a single division to wait for.
/// Products must stay in the scalar's range. 0 where the slope vanishes, which [`in_bracket`] does not take for the end.
#[inline]
pub(crate) fn quick_halley<S: Scalar>(value: &S, slope: &S, bend: &S) -> S {
    value.clone() * slope / &(slope.clone().square() - &(value.clone() * bend))
}

/// The same as f/(f' − f/f'·h), whatever the range of products; infinite where the slope vanishes.
#[cold]
pub(crate) fn careful_halley<S: Scalar>(value: &S, slope: &S, bend: &S) -> S {
    if slope.is_zero() {
        return S::infinity();
    }
    let divisor = slope.clone() - &(value.clone() / slope * bend);
    value.clone() / &divisor
}

/// The quick step where its products stay in the range of the scalar, otherwise the careful one.
#[inline]
pub(crate) fn halley<S: Scalar>(value: &S, slope: &S, bend: &S) -> S {
    let is_normal = |x: S| {
        let places = S::BITS.cast_signed();
        x.clone().mul_pow2(-places).mul_pow2(places) == x && !x.is_zero() && x.is_finite()
    };
    if is_normal(value.clone() * slope) && is_normal(slope.clone().square()) {
        quick_halley(value, slope, bend)
    } else {
        careful_halley(value, slope, bend)
    }
}

/// The zero in [lo, hi] of a function, given with its derivative and half its second derivative, that changes its sign from −
/// to + there. `start` is the first point (the middle if it is not inside), `target` the error to stop at, for a given x.
#[inline]
pub(crate) fn in_bracket<S: Scalar>(
    f: impl Fn(&S) -> (S, S, S),
    step: impl Fn(&S, &S, &S) -> S,
    (lo, hi): (S, S),
    start: S,
    target: impl Fn(&S) -> S,
) -> S {
    let start = if lo < start && start < hi { start } else { S::midpoint(&lo, &hi) };
    match converge(&f, step, (lo.clone(), hi.clone()), start, &target) {
        Ok(x) => x,
        Err(x) => narrowing(f, lo, hi, true, x, target).x,
    }
}

/// The zero that steps lead to from a start in (lo, hi), or the point where they ceased to shrink or to stay inside.
///
/// As long as steps shrink nothing is here that a processor could not foresee.
#[inline]
pub(crate) fn converge<S: Scalar>(
    f: impl Fn(&S) -> (S, S, S),
    step: impl Fn(&S, &S, &S) -> S,
    (lo, hi): (S, S),
    mut x: S,
    target: impl Fn(&S) -> S,
) -> Result<S, S> {
    let mut converging = false;
    let mut previous = hi.clone() - &lo;
    let (resolution, rounding) = (S::unit_roundoff().twice(), S::unit_roundoff().mul_pow2(2));
    for _ in 0..S::BITS {
        let (value, slope, bend) = f(&x);
        let step = step(&value, &slope, &bend);
        let next = x.clone() - &step;
        let step = step.abs();
        let is_finest = step <= next.clone().abs() * &resolution;
        if !(lo <= next && next <= hi && (is_finest || step.clone().twice() <= previous)) {
            return if value.is_zero() { Ok(x) } else { Err(x) };
        }
        let rest = ((step.clone() / &previous).square() + &rounding) * &step;
        x = next;
        if is_finest || (converging && rest <= target(&x)) {
            return if step.is_zero() && !value.is_zero() { Err(x) } else { Ok(x) };
        }
        previous = step;
        converging = true;
    }
    Err(x)
}

/// The zero in [lo, hi] where steps went astray: each value narrows the bracket.
#[cold]
pub(crate) fn narrowing<S: Scalar>(
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
        let step = halley(&value, &slope, &bend);
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
    Zero { x, slope }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_any_size() {
        // f = x³ − 8 from 3, times powers of two whose products leave the range
        let exact = 3.0 - (19.0 / 27.0) / (1.0 - 19.0 * 9.0 / 729.0);
        for e in [-1000, -500, 0, 500] {
            let [f, s, h] = [19.0_f64, 27.0, 9.0].map(|c| c * 2.0_f64.powi(e));
            assert!((3.0 - halley(&f, &s, &h) - exact).abs() < 1e-15, "2^{e}");
        }
        assert_eq!(halley(&1.0_f64, &0.0, &1.0), f64::INFINITY, "a level place is not a zero");
    }

    #[test]
    fn a_level_start_is_not_the_zero() {
        // x³ − 3x + 1 is level at 1, where it is −1, and rises through 1.532…
        let f = |x: &f64| (x * x * x - 3.0 * x + 1.0, 3.0 * x * x - 3.0, 3.0 * x);
        let zero = in_bracket(f, quick_halley, (0.5, 2.0), 1.0, |_| 1e-15);
        assert!((zero - 1.532_088_886_237_956).abs() < 1e-14, "{zero}");
    }
}
