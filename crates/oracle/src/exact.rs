//! Polynomials with integer coefficients of any size.

use crate::dyadic::Dyadic;
use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// 2^exponent · Σ cⱼ xʲ with integers cⱼ, ascending powers, the last one not zero; no coefficients: the zero polynomial.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exact {
    c: Vec<BigInt>,
    exponent: i64,
}

impl Exact {
    /// The polynomial with these coefficients, ascending powers; `None` if one of them is not finite.
    pub fn from_f64(coefficients: &[f64]) -> Option<Self> {
        let dyadic: Option<Vec<Dyadic>> = coefficients.iter().map(|c| Dyadic::from_f64(*c)).collect();
        Some(Self::from_dyadic(&dyadic?))
    }

    /// The polynomial with these coefficients, ascending powers.
    pub fn from_dyadic(coefficients: &[Dyadic]) -> Self {
        let exponent = coefficients.iter().filter(|c| c.sign() != 0).map(|c| c.exponent).min().unwrap_or(0);
        let integer = |c: &Dyadic| match usize::try_from(c.exponent - exponent) {
            Ok(shift) if c.sign() != 0 => &c.mantissa << shift,
            _ => BigInt::zero(),
        };
        Self::new(coefficients.iter().map(integer).collect(), exponent)
    }

    /// Integer coefficients, times 2^exponent.
    pub fn new(mut c: Vec<BigInt>, exponent: i64) -> Self {
        while c.last().is_some_and(Zero::is_zero) {
            c.pop();
        }
        Self { c, exponent }
    }

    /// `None` for the zero polynomial.
    pub const fn degree(&self) -> Option<usize> {
        self.c.len().checked_sub(1)
    }

    /// The coefficients without the power of two.
    pub fn integers(&self) -> &[BigInt] {
        &self.c
    }

    /// p(x).
    pub fn value(&self, x: &Dyadic) -> Dyadic {
        let Some(n) = self.degree() else { return Dyadic::zero() };
        if x.exponent >= 0 {
            let x = &x.mantissa << usize::try_from(x.exponent).unwrap_or(0);
            let sum = self.c.iter().rev().fold(BigInt::zero(), |sum, c| sum * &x + c);
            return Dyadic { mantissa: sum, exponent: self.exponent };
        }
        // Homogeneous: Σ cⱼ mʲ (2^k)ⁿ⁻ʲ with x = m/2^k
        let k = usize::try_from(-x.exponent).unwrap_or(0);
        let mut sum = BigInt::zero();
        for (j, c) in self.c.iter().enumerate().rev() {
            sum = sum * &x.mantissa + (c << (k * (n - j)));
        }
        Dyadic { mantissa: sum, exponent: self.exponent + x.exponent * i64::try_from(n).unwrap_or(0) }
    }

    /// Taylor coefficients cⱼ = p⁽ʲ⁾(x)/j!.
    pub fn taylor(&self, x: &Dyadic) -> Vec<Dyadic> {
        let exponent = self.exponent;
        let mut c: Vec<Dyadic> = self.c.iter().map(|m| Dyadic { mantissa: m.clone(), exponent }.reduced()).collect();
        for done in 0..c.len() {
            for j in (done + 1..c.len()).rev() {
                c[j - 1] = c[j - 1].plus(&c[j].times(x));
            }
        }
        c
    }

    /// Σ |cⱼ| |x|ʲ.
    pub fn magnitude(&self, x: &Dyadic) -> Dyadic {
        Self { c: self.c.iter().map(Signed::abs).collect(), exponent: self.exponent }.value(&x.abs())
    }

    /// p'.
    #[must_use]
    pub fn derivative(&self) -> Self {
        Self::new(self.c.iter().enumerate().skip(1).map(|(j, c)| c * j).collect(), self.exponent)
    }

    /// The same zeros and signs with coprime integer coefficients.
    #[must_use]
    pub fn primitive(mut self) -> Self {
        let zeros = self.c.iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
        if zeros > 0 {
            for c in &mut self.c {
                *c >>= zeros;
            }
        }
        let mut content = BigInt::zero();
        for c in &self.c {
            content = content.gcd(c);
            if content.is_one() {
                break;
            }
        }
        if !content.is_zero() && !content.is_one() {
            for c in &mut self.c {
                *c /= &content;
            }
        }
        self.exponent = 0;
        self
    }

    /// The opposite.
    #[must_use]
    pub fn negated(mut self) -> Self {
        for c in &mut self.c {
            *c = -std::mem::take(c);
        }
        self
    }

    /// A positive multiple of the remainder of the division by a polynomial that is not zero; powers of two are ignored.
    #[must_use]
    pub fn remainder(&self, divisor: &Self) -> Self {
        let Some((leading, lower)) = divisor.c.split_last() else { return self.clone() };
        let (size, sign) = (leading.abs(), leading.signum());
        let mut rest = self.c.clone();
        while rest.len() > lower.len() {
            let Some(top) = rest.pop() else { break };
            if top.is_zero() {
                continue;
            }
            // |l|·rest − sign(l)·top·xᵏ·divisor: the leading terms cancel, the factor |l| is positive
            let factor = &sign * &top;
            let k = rest.len() - lower.len();
            for c in rest.iter_mut() {
                *c *= &size;
            }
            for (c, d) in rest.iter_mut().skip(k).zip(lower) {
                *c -= &factor * d;
            }
        }
        Self::new(rest, 0)
    }

    /// The quotient by a primitive polynomial that divides this one (powers of two are ignored).
    #[must_use]
    pub fn quotient(&self, divisor: &Self) -> Self {
        let Some((leading, lower)) = divisor.c.split_last() else { return self.clone() };
        let mut rest = self.c.clone();
        let mut quotient = Vec::new();
        while rest.len() > lower.len() {
            let Some(top) = rest.pop() else { break };
            let digit = top / leading;
            let k = rest.len() - lower.len();
            for (c, d) in rest.iter_mut().skip(k).zip(lower) {
                *c -= &digit * d;
            }
            quotient.push(digit);
        }
        quotient.reverse();
        Self::new(quotient, 0)
    }

    /// The greatest common divisor, primitive.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone().primitive(), other.clone().primitive());
        while b.degree().is_some() {
            let rest = a.remainder(&b).primitive();
            a = std::mem::replace(&mut b, rest);
        }
        a
    }

    /// Coprime square-free polynomials with their multiplicities: p is their product, each to its power, times a constant.
    /// Yun's algorithm (1976, doi:10.1145/800205.806320). Constants are left out.
    pub fn square_free_factors(&self) -> Vec<(usize, Self)> {
        let p = self.clone().primitive();
        let slope = p.derivative();
        if slope.degree().is_none() {
            return Vec::new();
        }
        let common = p.gcd(&slope);
        if common.degree() == Some(0) {
            return vec![(1, p)];
        }
        let mut b = p.quotient(&common);
        let mut d = slope.quotient(&common).less(&b.derivative());
        let mut factors = Vec::new();
        for multiplicity in 1..=p.c.len() {
            if b.degree().unwrap_or(0) == 0 {
                break;
            }
            let factor = b.gcd(&d);
            let c = d.quotient(&factor);
            b = b.quotient(&factor);
            d = c.less(&b.derivative());
            if factor.degree().unwrap_or(0) > 0 {
                factors.push((multiplicity, factor));
            }
        }
        factors
    }

    /// The difference (powers of two are ignored).
    #[must_use]
    fn less(&self, other: &Self) -> Self {
        let size = self.c.len().max(other.c.len());
        let zero = BigInt::zero();
        let at = |c: &[BigInt], j: usize| c.get(j).unwrap_or(&zero).clone();
        Self::new((0..size).map(|j| at(&self.c, j) - at(&other.c, j)).collect(), 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn poly(c: &[i64]) -> Exact {
        Exact::new(c.iter().map(|c| BigInt::from(*c)).collect(), 0)
    }

    #[test]
    fn values_and_taylor_coefficients() {
        let p = Exact::from_f64(&[1.0, -2.0, 0.0, 4.0]).expect("finite");
        let half = Dyadic::power_of_two(-1);
        assert_eq!(p.value(&half).to_f64(), 0.5);
        let c: Vec<f64> = p.taylor(&half).iter().map(Dyadic::to_f64).collect();
        assert_eq!(c, [0.5, 1.0, 6.0, 4.0]);
        assert_eq!(p.magnitude(&half.negated()).to_f64(), 2.5);
        assert_eq!(Exact::from_f64(&[0.0, 0.0]).expect("finite").degree(), None);
        assert!(Exact::from_f64(&[f64::NAN]).is_none());
    }

    #[test]
    fn remainders_keep_their_sign() {
        // x² − 1 = (x − 2)(x + 2) + 3
        let (a, b) = (poly(&[-1, 0, 1]), poly(&[2, -1]));
        assert_eq!(a.remainder(&b), poly(&[3]));
        assert_eq!(poly(&[-1, 0, 1]).remainder(&poly(&[-4, 2])).primitive(), poly(&[1]));
    }

    #[test]
    fn factors_by_multiplicity() {
        // (x − 1)(x − 2)²(2x + 1)⁴
        let factors = [poly(&[-1, 1]), poly(&[-2, 1]), poly(&[1, 2])];
        let multiplicities = [1, 2, 4];
        let mut p = poly(&[3]);
        for (f, m) in factors.iter().zip(multiplicities) {
            for _ in 0..m {
                let mut product = vec![BigInt::zero(); p.c.len() + f.c.len() - 1];
                for (i, a) in p.c.iter().enumerate() {
                    for (j, b) in f.c.iter().enumerate() {
                        product[i + j] += a * b;
                    }
                }
                p = Exact::new(product, 0);
            }
        }
        let found = p.square_free_factors();
        assert_eq!(found.len(), 3, "{found:?}");
        for ((m, f), (expected, multiplicity)) in found.into_iter().zip(factors.iter().zip(multiplicities)) {
            assert_eq!(m, multiplicity);
            assert!(f == *expected || f.clone().negated() == *expected, "{f:?}");
        }
    }
}
