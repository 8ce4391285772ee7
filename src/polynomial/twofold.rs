//! Twice the precision where it matters: error-free transformations of sums and products, in any scalar.
//!
//! In binary arithmetic rounded to nearest the error of a sum and of a product is itself a number of the type, and a few
//! more operations compute it: [`two_sum`] (Knuth 1969), [`Split::times`] (Dekker 1971, with Veltkamp's splitting). Horner's
//! scheme with these errors carried along as a second polynomial (Graillat, Langlois and Louvet 2005) is as good as one in
//! twice the precision, rounded at the end:
//!
//! |[`value`] − p(x)| ≤ u|p(x)| + 8N²u²·Σ|aⱼ||x|ʲ
//!
//! *Proof.* Let s be the plain result and eᵢ the exact errors of its n = N − 1 products and n sums, |eᵢ| ≤ u·mᵢ, where
//! Σ mᵢ|x|ⁱ over both kinds is at most 2n(1+u)²ⁿ·Σ|aⱼ||x|ʲ: each intermediate result is at most (1+u)²ⁿ times what moduli
//! give. Then p(x) = s + Σ eᵢxⁱ exactly. The second sum has n terms of one addition, one product and one addition each, so it
//! comes out with a relative error of at most γ₃ₙ of the sum of moduli, 2n(1+u)²ⁿu·γ₃ₙ Σ|aⱼ||x|ʲ ≤ 6.1n²u²·Σ|aⱼ||x|ʲ; the
//! final addition rounds once, u(|p(x)| + that). ∎ The repeated scheme for [`taylor`] coefficients does the same for each cⱼ
//! with Σ C(i,j)|aᵢ||x|ⁱ⁻ʲ in the place of Σ|aⱼ||x|ʲ, and at most 2n operations lead to any of them through n levels.
//!
//! **Range.** Splitting multiplies by 2^⌈BITS/2⌉ and must not overflow; errors of products must not underflow. Coefficients
//! of comfortable size and |x| < 2 see to the first. [`is_in_range`] tells whether the second can matter: where it holds,
//! anything that underflowed is below 2^−4·BITS of the magnitude, far below the bound above.

use super::Polynomial;
use super::eval::descend;
use crate::scalar::Scalar;

/// The sum rounded to nearest and its exact error.
#[inline]
pub(super) fn two_sum<S: Scalar>(a: S, b: &S) -> (S, S) {
    let s = a.clone() + b;
    let bb = s.clone() - &a;
    let aa = s.clone() - &bb;
    (s, (a - &aa) + &(b.clone() - &bb))
}

/// Rounded to half as many digits, BITS − ⌈BITS/2⌉: off by 2^(⌈BITS/2⌉ − BITS)·|x| at most. Near the largest number x itself.
#[inline]
pub(super) fn half_the_digits<S: Scalar>(x: S) -> S {
    let high = Split::new(x.clone()).high;
    if high.is_finite() { high } else { x }
}

/// The sum has no rounding error, nor has half of it.
#[inline]
pub(super) fn is_exact_sum<S: Scalar>(a: &S, b: &S) -> bool {
    let (sum, error) = two_sum(a.clone(), b);
    error.is_zero() && sum.clone().half().twice() == sum
}

/// A factor with its two halves of half as many bits.
#[derive(Clone, Debug)]
pub(super) struct Split<S> {
    whole: S,
    high: S,
    low: S,
}

impl<S: Scalar> Split<S> {
    /// Veltkamp's splitting.
    #[inline]
    pub(super) fn new(whole: S) -> Self {
        let shifted = whole.clone().mul_pow2(S::BITS.div_ceil(2).cast_signed()) + &whole;
        let high = shifted.clone() - &(shifted - &whole);
        let low = whole.clone() - &high;
        Self { whole, high, low }
    }

    /// The product rounded to nearest and its exact error.
    #[inline]
    pub(super) fn times(&self, other: &Self) -> (S, S) {
        let product = self.whole.clone() * &other.whole;
        let mut error = self.high.clone() * &other.high - &product;
        error = error + &(self.high.clone() * &other.low);
        error = error + &(self.low.clone() * &other.high);
        (product, error + &(self.low.clone() * &other.low))
    }
}

/// p(x) as if evaluated in twice the precision; see the module's header for the error.
#[inline]
pub(super) fn value<S: Scalar, const N: usize>(p: &Polynomial<S, N>, x: &S) -> S {
    let factor = Split::new(x.clone());
    let mut powers = p.coefficients.iter().rev();
    let Some(mut sum) = powers.next().cloned() else { return S::zero() };
    let mut correction = S::zero();
    for c in powers {
        let (product, below) = Split::new(sum).times(&factor);
        let (next, rest) = two_sum(product, c);
        correction = correction * x + &(below + &rest);
        sum = next;
    }
    sum + &correction
}

/// Taylor coefficients about x: p(x + v) = Σ cⱼ vʲ, each as if computed in twice the precision.
#[inline]
pub(super) fn taylor<S: Scalar, const N: usize>(p: &Polynomial<S, N>, x: &S) -> Polynomial<S, N> {
    let factor = Split::new(x.clone());
    let mut pairs: [(S, S); N] = core::array::from_fn(|j| (p.coefficients[j].clone(), S::zero()));
    for done in 0..N {
        descend(&mut pairs, done, |(upper, beside), (lower, correction)| {
            let (product, below) = Split::new(upper.clone()).times(&factor);
            let (next, rest) = two_sum(product, lower);
            let carried = beside.clone() * x + &(below + &rest);
            *correction = carried + &*correction;
            *lower = next;
        });
    }
    Polynomial::new(pairs.map(|(sum, correction)| sum + &correction))
}

/// 8N²u: times u and the magnitude, the error of [`value`] beside its last rounding.
#[inline]
pub(super) fn residue<S: Scalar, const N: usize>() -> S {
    let n = i32::try_from(N).unwrap_or(16);
    S::unit_roundoff() * &S::int(8 * n * n)
}

/// The sign of p(x) where it is certain, 0 elsewhere.
#[inline]
pub(super) fn sign<S: Scalar, const N: usize>(p: &Polynomial<S, N>, x: &S) -> i8 {
    let (value, magnitude) = (value(p, x), p.magnitude(x));
    // twice the bound: it is itself rounded, and u|p(x)| ≤ |p(x)|/4 needs a part of it
    let bound = residue::<S, N>().twice() * &S::unit_roundoff() * &magnitude;
    if !is_in_range(&magnitude) {
        0
    } else if value > bound {
        1
    } else if value < -bound {
        -1
    } else {
        0
    }
}

/// Numbers 2^−4·BITS of this size are still exact: what underflows is of no account.
#[inline]
pub(super) fn is_in_range<S: Scalar>(magnitude: &S) -> bool {
    let down = -4 * S::BITS.cast_signed();
    magnitude.clone().mul_pow2(down).mul_pow2(-down) == *magnitude
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_exact() {
        let (s, e) = two_sum(1.0_f64, &1e-17);
        assert_eq!((s, e), (1.0, 1e-17));
        let third = 1.0 / 3.0;
        let (p, e) = Split::new(third).times(&Split::new(third));
        assert_eq!((p, e), crate::scalar::eft::two_product(third, third), "the kernel's own for doubles");
        let (p, e) = Split::new(0.1_f32).times(&Split::new(0.3));
        assert_eq!(f64::from(p) + f64::from(e), f64::from(0.1_f32) * f64::from(0.3_f32), "48 bits fit a double");
    }

    #[test]
    fn values_beside_a_multiple_root() {
        // (x − 1)⁵ at 1 + 2⁻⁹, where the plain scheme has no digit right
        let p = Polynomial::new([-1.0_f64, 5.0, -10.0, 10.0, -5.0, 1.0]);
        let x = 1.0 + 2.0_f64.powi(-9);
        assert_eq!(value(&p, &x), 2.0_f64.powi(-45));
        assert_eq!((sign(&p, &x), sign(&p, &1.0), sign(&p, &(2.0 - x))), (1, 0, -1));
        let factors = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0].into_iter().zip([-45, -36, -27, -18, -9, 0]);
        for (c, (factor, e)) in taylor(&p, &x).coefficients.into_iter().zip(factors) {
            assert_eq!(c, factor * 2.0_f64.powi(e));
        }
    }

    #[test]
    fn small_magnitudes_are_out_of_range() {
        assert!(is_in_range(&1.0_f64) && is_in_range(&1e-200_f64) && !is_in_range(&1e-300_f64));
        assert!(is_in_range(&1.0_f32) && !is_in_range(&1e-30_f32));
    }
}
