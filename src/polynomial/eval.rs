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
        assert_eq!(p.magnitude(&-2.0), 37.0);
        assert_eq!(p.mirrored().eval(&-2.0), 29.0);
        assert_eq!(p.reversed().coefficients, [4.0, 0.0, -2.0, 1.0]);
        assert_eq!(p.degree(), Some(3));
        assert_eq!(Polynomial::new([0.0_f32; 4]).degree(), None);
    }
}
