//! Evaluation: values, derivatives, Taylor coefficients, and the size of the rounding error to expect.

use super::Polynomial;
use crate::scalar::Scalar;
use core::array::from_fn;

/// Calls `combine` with each two neighbours of c[from..], the upper one first, from the top down. Written without indices:
/// a compiler that goes for size keeps their checks, and with them a panic.
#[inline]
pub(super) fn descend<S, const N: usize>(c: &mut [S; N], from: usize, mut combine: impl FnMut(&mut S, &mut S)) {
    let mut coefficients = c.iter_mut().skip(from).rev();
    let Some(mut upper) = coefficients.next() else { return };
    for lower in coefficients {
        combine(upper, lower);
        upper = lower;
    }
}

/// The same for all but the last `without`, the lower one first, from the bottom up.
#[inline]
pub(super) fn ascend<S, const N: usize>(c: &mut [S; N], without: usize, mut combine: impl FnMut(&mut S, &mut S)) {
    let mut coefficients = c.iter_mut().take(N - without.min(N));
    let Some(mut lower) = coefficients.next() else { return };
    for upper in coefficients {
        combine(lower, upper);
        lower = upper;
    }
}

impl<S: Scalar, const N: usize> Polynomial<S, N> {
    /// The polynomial with these coefficients, ascending powers.
    #[inline]
    pub const fn new(coefficients: [S; N]) -> Self {
        Self { coefficients }
    }

    /// p(x) by Horner's scheme; error at most about 2N·u·Σ|aⱼ xʲ|.
    #[inline]
    pub fn eval(&self, x: &S) -> S {
        let mut value = S::zero();
        for c in self.coefficients.iter().rev() {
            value = value * x + c;
        }
        value
    }

    /// p(x) and p'(x) in one pass of Horner's scheme; errors as for [`Polynomial::eval`].
    #[inline]
    pub fn eval_with_derivative(&self, x: &S) -> (S, S) {
        let mut value = S::zero();
        let mut slope = S::zero();
        for c in self.coefficients.iter().rev() {
            slope = slope * x + &value;
            value = value * x + c;
        }
        (value, slope)
    }

    /// p(x), p'(x) and p''(x)/2, errors as for [`Polynomial::eval`] but for a factor of about 2.
    ///
    /// In y = x² both E and O of p(x) = E(y) + x·O(y) take half as many steps, side by side:
    /// p' = O + 2yO' + 2xE' and p''/2 = E' + 4y(E''/2) + x(3O' + 4y(O''/2)).
    #[inline]
    pub(crate) fn jet(&self, x: &S) -> (S, S, S) {
        let y = x.clone().square();
        // value, derivative, half the second derivative of the even and the odd part
        let mut parts = [[S::zero(), S::zero(), S::zero()], [S::zero(), S::zero(), S::zero()]];
        for (j, c) in self.coefficients.iter().enumerate().rev() {
            let [v, d, h] = &mut parts[j % 2];
            *h = h.clone() * &y + &*d;
            *d = d.clone() * &y + &*v;
            *v = v.clone() * &y + c;
        }
        let [[e, e1, e2], [o, o1, o2]] = parts;
        let slope = y.clone() * &o1.clone().twice() + &o + &(x.clone().twice() * &e1);
        let outer = y.clone().mul_pow2(2);
        let bend = outer.clone() * &e2 + &e1 + &((outer * &o2 + &(o1.clone().twice() + &o1)) * x);
        (o * x + &e, slope, bend)
    }

    /// Σ|aⱼ| |x|ʲ: times the unit roundoff, what rounding each coefficient may change p(x) by.
    #[inline]
    pub fn magnitude(&self, x: &S) -> S {
        let x = x.clone().abs();
        let mut sum = S::zero();
        for c in self.coefficients.iter().rev() {
            sum = sum * &x + &c.clone().abs();
        }
        sum
    }

    /// Taylor coefficients c about x: p(x + v) = Σ cⱼ vʲ, that is cⱼ = p⁽ʲ⁾(x)/j!, by repeated Horner steps.
    #[inline]
    pub fn taylor(&self, x: &S) -> Self {
        let mut c = self.coefficients.clone();
        for done in 0..N {
            descend(&mut c, done, |upper, lower| *lower = upper.clone() * x + &*lower);
        }
        Self::new(c)
    }

    /// p(−x): its roots are those of p with the sign changed; exact.
    #[inline]
    pub fn mirrored(&self) -> Self {
        Self::new(from_fn(|j| {
            let c = self.coefficients[j].clone();
            if j % 2 == 1 { -c } else { c }
        }))
    }

    /// xⁿ⁻¹ p(1/x): the coefficients in reverse order; its roots other than 0 are the reciprocals of those of p.
    #[inline]
    pub fn reversed(&self) -> Self {
        Self::new(from_fn(|j| self.coefficients[N - 1 - j].clone()))
    }

    /// The degree without leading zeros; `None` for the zero polynomial.
    #[inline]
    pub fn degree(&self) -> Option<usize> {
        self.coefficients.iter().rposition(|c| !c.is_zero())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_and_derivatives() {
        let p = Polynomial::new([1.0_f64, -2.0, 0.0, 4.0]);
        assert_eq!(p.eval(&2.0), 29.0);
        assert_eq!(p.eval_with_derivative(&2.0), (29.0, 46.0));
        assert_eq!(p.taylor(&2.0).coefficients, [29.0, 46.0, 24.0, 4.0]);
        assert_eq!(p.jet(&2.0), (29.0, 46.0, 24.0));
        let sixth = Polynomial::new([3.0_f64, -1.0, 4.0, 1.0, -5.0, 9.0, 2.0]);
        let [c0, c1, c2, ..] = sixth.taylor(&-3.0).coefficients;
        assert_eq!(sixth.jet(&-3.0), (c0, c1, c2));
        assert_eq!(p.magnitude(&-2.0), 37.0);
        assert_eq!(p.mirrored().eval(&-2.0), 29.0);
        assert_eq!(p.reversed().coefficients, [4.0, 0.0, -2.0, 1.0]);
        assert_eq!(p.degree(), Some(3));
        assert_eq!(Polynomial::new([0.0_f32; 4]).degree(), None);
    }
}
