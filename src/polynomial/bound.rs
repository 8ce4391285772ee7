//! Bounds of the moduli of all roots, from the coefficients alone (paper, Section 7.1).
//!
//! Both are theorems about any complex root x of p = a₀ + … + aₙ xⁿ with aₙ ≠ 0, n ≥ 1.
//!
//! **Cauchy** (1829): |x| ≤ 1 + A with A = max over i < n of |aᵢ/aₙ|. *Proof.* Let |x| > 1 + A. Then
//! Σ_{i<n} |aᵢ||x|ⁱ ≤ A|aₙ| (|x|ⁿ − 1)/(|x| − 1) < |aₙ||x|ⁿ, since |x| − 1 > A (for A = 0 the left side is 0). The
//! leading term outweighs all others, so p(x) ≠ 0. ∎
//!
//! **Kojima** (1917): |x| ≤ K = max(|a₀/a₁|, 2|a₁/a₂|, …, 2|aₙ₋₁/aₙ|), all divisors being non-zero. *Proof.* By
//! induction downwards |aₙ₋ᵢ| ≤ |aₙ|(K/2)ⁱ for i < n, and |a₀| ≤ K|a₁| ≤ 2|aₙ|(K/2)ⁿ. For |x| > K,
//! Σ_{i<n} |aᵢ||x|ⁱ < |aₙ||x|ⁿ (½ + ¼ + … + 2^−(n−1) + 2·2^−n) = |aₙ||x|ⁿ, so p(x) ≠ 0. (For K = 0 all aᵢ vanish and
//! x = 0.) ∎ With a zero divisor the quotient is unbounded and Cauchy's bound takes its place.
//!
//! In floating point a quotient, a doubling and a sum err by at most three roundings; the results are enlarged by four,
//! so they stay bounds. A quotient may overflow: the bound is then infinite, which is still true.

use super::Polynomial;
use crate::scalar::Scalar;

impl<S: Scalar, const N: usize> Polynomial<S, N> {
    /// Cauchy's bound of the moduli of all roots, rounded outwards; `None` if the polynomial is constant.
    ///
    /// Infinite where the quotient of two coefficients overflows. Coefficients must be finite.
    pub fn cauchy_bound(&self) -> Option<S> {
        let n = self.degree().filter(|&n| n > 0)?;
        let leading = self.coefficients.get(n)?.clone().abs();
        let mut largest = S::zero();
        for c in self.coefficients.iter().take(n) {
            largest = largest.max(c.clone().abs());
        }
        Some(outwards(S::one() + &(largest / &leading)))
    }

    /// Kojima's bound of the moduli of all roots, rounded outwards; Cauchy's where a divisor is zero (or so small that
    /// a quotient of non-zero coefficients vanishes or overflows); `None` if the polynomial is constant.
    pub fn kojima_bound(&self) -> Option<S> {
        let n = self.degree().filter(|&n| n > 0)?;
        let mut largest = S::zero();
        for (i, (low, high)) in self.coefficients.iter().zip(self.coefficients.iter().skip(1)).take(n).enumerate() {
            if high.is_zero() {
                return self.cauchy_bound();
            }
            let quotient = low.clone().abs() / &high.clone().abs();
            if !quotient.is_finite() || (quotient.is_zero() && !low.is_zero()) {
                return self.cauchy_bound();
            }
            largest = largest.max(if i == 0 { quotient } else { quotient.twice() });
        }
        Some(outwards(largest))
    }

    /// The smaller of [`Polynomial::cauchy_bound`] and [`Polynomial::kojima_bound`]; `None` if the polynomial is
    /// constant.
    pub fn root_bound(&self) -> Option<S> {
        Some(self.cauchy_bound()?.min(self.kojima_bound()?))
    }
}

/// Enlarged by four roundings.
fn outwards<S: Scalar>(bound: S) -> S {
    let slack = S::unit_roundoff().mul_pow2(2) + &S::one();
    bound * &slack
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_the_roots() {
        // (x − 1)(x − 2)(x − 3)
        let p = Polynomial::new([-6.0_f64, 11.0, -6.0, 1.0]);
        let cauchy = p.cauchy_bound().unwrap_or_default();
        let kojima = p.kojima_bound().unwrap_or_default();
        assert!((cauchy - 12.0).abs() < 1e-12, "1 + 11");
        assert!((kojima - 12.0).abs() < 1e-12, "2·6/1");
        assert_eq!(p.root_bound(), Some(cauchy.min(kojima)));
    }

    #[test]
    fn zero_divisors_and_constants() {
        let p = Polynomial::new([-4.0_f64, 0.0, 1.0, 0.0]);
        assert_eq!(p.kojima_bound(), p.cauchy_bound(), "a₁ = 0");
        assert!(p.root_bound().is_some_and(|b| b >= 5.0));
        assert_eq!(Polynomial::new([3.0_f64, 0.0]).root_bound(), None, "constant");
        assert_eq!(Polynomial::new([0.0_f64]).root_bound(), None, "zero");
        // the monomial has its roots at 0
        assert_eq!(Polynomial::new([0.0_f64, 0.0, 2.0]).root_bound(), Some(outwards(1.0)));
    }
}
