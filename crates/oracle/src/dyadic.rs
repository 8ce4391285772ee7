//! Numbers m·2ᵉ with integers m of any size: doubles, and whatever sums and products of them give, exactly.

use num_bigint::{BigInt, Sign};
use num_traits::{One, Signed, ToPrimitive, Zero};
use std::cmp::Ordering;

/// The number mantissa·2^exponent.
#[derive(Clone, Debug)]
pub struct Dyadic {
    /// m.
    pub mantissa: BigInt,
    /// e.
    pub exponent: i64,
}

impl Dyadic {
    /// Zero.
    pub fn zero() -> Self {
        Self { mantissa: BigInt::zero(), exponent: 0 }
    }

    /// 2^e.
    pub fn power_of_two(exponent: i64) -> Self {
        Self { mantissa: BigInt::one(), exponent }
    }

    /// A finite double, exactly; `None` for infinities and NaN.
    pub fn from_f64(x: f64) -> Option<Self> {
        if !x.is_finite() {
            return None;
        }
        let bits = x.to_bits();
        let biased = i64::try_from((bits >> 52) & 0x7FF).unwrap_or(0);
        let fraction = bits & ((1 << 52) - 1);
        let (significand, exponent) =
            if biased == 0 { (fraction, -1074) } else { (fraction | (1 << 52), biased - 1075) };
        let trailing = significand.trailing_zeros().min(63);
        let magnitude = BigInt::from(significand >> trailing);
        let mantissa = if x < 0.0 { -magnitude } else { magnitude };
        Some(if mantissa.is_zero() {
            Self::zero()
        } else {
            Self { mantissa, exponent: exponent + i64::from(trailing) }
        })
    }

    /// The same number without factors of two in the mantissa.
    #[must_use]
    pub fn reduced(self) -> Self {
        match self.mantissa.trailing_zeros() {
            Some(zeros) if zeros > 0 => {
                Self { exponent: self.exponent + i64::try_from(zeros).unwrap_or(0), mantissa: self.mantissa >> zeros }
            }
            Some(_) => self,
            None => Self::zero(),
        }
    }

    /// −1, 0 or 1.
    pub fn sign(&self) -> i32 {
        match self.mantissa.sign() {
            Sign::Minus => -1,
            Sign::NoSign => 0,
            Sign::Plus => 1,
        }
    }

    /// Both mantissas at the smaller exponent.
    fn aligned(&self, other: &Self) -> (BigInt, BigInt, i64) {
        let exponent = self.exponent.min(other.exponent);
        let at = |x: &Self| &x.mantissa << usize::try_from(x.exponent - exponent).unwrap_or(0);
        (at(self), at(other), exponent)
    }

    /// The sum.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        if self.mantissa.is_zero() {
            return other.clone();
        }
        if other.mantissa.is_zero() {
            return self.clone();
        }
        let (a, b, exponent) = self.aligned(other);
        Self { mantissa: a + b, exponent }
    }

    /// The difference.
    #[must_use]
    pub fn minus(&self, other: &Self) -> Self {
        self.plus(&other.negated())
    }

    /// The product.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        Self { mantissa: &self.mantissa * &other.mantissa, exponent: self.exponent + other.exponent }
    }

    /// The product with an integer.
    #[must_use]
    pub fn times_int(&self, n: i32) -> Self {
        Self { mantissa: &self.mantissa * n, exponent: self.exponent }
    }

    /// The product with 2ⁿ.
    #[must_use]
    pub fn shifted(mut self, n: i64) -> Self {
        self.exponent += n;
        self
    }

    /// The opposite.
    #[must_use]
    pub fn negated(&self) -> Self {
        Self { mantissa: -&self.mantissa, exponent: self.exponent }
    }

    /// The absolute value.
    #[must_use]
    pub fn abs(&self) -> Self {
        Self { mantissa: self.mantissa.abs(), exponent: self.exponent }
    }

    /// The mean.
    #[must_use]
    pub fn midpoint(a: &Self, b: &Self) -> Self {
        a.plus(b).shifted(-1).reduced()
    }

    /// log₂ of the absolute value, to about ten digits; −∞ for zero.
    pub fn log2(&self) -> f64 {
        let bits = self.mantissa.bits();
        if bits == 0 {
            return f64::NEG_INFINITY;
        }
        let drop = bits.saturating_sub(60);
        let top = (self.mantissa.abs() >> drop).to_f64().unwrap_or(1.0);
        let exponent = self.exponent + i64::try_from(drop).unwrap_or(0);
        #[allow(clippy::cast_precision_loss, reason = "exponents are far below 2⁵³")]
        let exponent = exponent as f64;
        top.log2() + exponent
    }

    /// The nearest double in the normal range, one of the two neighbours below it; infinite beyond it.
    pub fn to_f64(&self) -> f64 {
        let bits = self.mantissa.bits();
        let drop = bits.saturating_sub(53);
        let mut top = self.mantissa.abs();
        if drop > 0 {
            top = ((top >> (drop - 1)) + 1_u32) >> 1_u32;
        }
        let top = top.to_f64().unwrap_or(0.0);
        let exponent = self.exponent + i64::try_from(drop).unwrap_or(0);
        let half = exponent.clamp(-2400, 2400) / 2;
        let power = |e: i64| 2.0_f64.powi(i32::try_from(e).unwrap_or(0));
        let rest = exponent.clamp(-2400, 2400) - half;
        let magnitude = scale(scale(top, half / 2, &power), half - half / 2, &power);
        let magnitude = scale(scale(magnitude, rest / 2, &power), rest - rest / 2, &power);
        if self.mantissa.is_negative() { -magnitude } else { magnitude }
    }
}

fn scale(x: f64, e: i64, power: &impl Fn(i64) -> f64) -> f64 {
    x * power(e)
}

impl Dyadic {
    /// The largest double that is not above, and the smallest that is not below.
    pub fn enclosing(&self) -> (f64, f64) {
        let near = self.to_f64();
        let Some(exact) = Self::from_f64(near) else {
            return if near > 0.0 { (f64::MAX, near) } else { (near, f64::MIN) };
        };
        match exact.cmp(self) {
            Ordering::Less => (near, near.next_up()),
            Ordering::Equal => (near, near),
            Ordering::Greater => (near.next_down(), near),
        }
    }
}

impl PartialEq for Dyadic {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Dyadic {}

impl PartialOrd for Dyadic {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Dyadic {
    fn cmp(&self, other: &Self) -> Ordering {
        let (a, b, _) = self.aligned(other);
        a.cmp(&b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_there_and_back() {
        for x in [0.0, 1.0, -0.1, 1e-300, 5e-324, f64::MAX, f64::MIN_POSITIVE, -123.456, 1e-310] {
            let exact = Dyadic::from_f64(x).expect("finite");
            assert_eq!(exact.to_f64(), x, "{x}");
            if x != 0.0 {
                assert!((exact.log2() - x.abs().log2()).abs() < 1e-9, "log2 of {x}: {}", exact.log2());
            }
        }
        assert!(Dyadic::from_f64(f64::NAN).is_none() && Dyadic::from_f64(f64::INFINITY).is_none());
    }

    #[test]
    fn doubles_around() {
        let tenth = Dyadic::from_f64(0.1).expect("finite");
        assert_eq!(tenth.enclosing(), (0.1, 0.1));
        let more = tenth.plus(&Dyadic::power_of_two(-100));
        assert_eq!(more.enclosing(), (0.1, 0.1_f64.next_up()));
        assert_eq!(more.negated().enclosing(), (-(0.1_f64.next_up()), -0.1));
        assert_eq!(Dyadic::power_of_two(-2000).enclosing(), (0.0, 5e-324));
    }

    #[test]
    fn sums_and_products_are_exact() {
        let [a, b] = [0.1, 0.2].map(|x| Dyadic::from_f64(x).expect("finite"));
        let sum = a.plus(&b);
        assert!(sum < Dyadic::from_f64(0.1 + 0.2).expect("finite"), "the double sum is rounded up");
        assert_eq!(sum.minus(&b), a);
        assert_eq!(a.times(&b).log2().round(), -6.0);
        assert_eq!(Dyadic::midpoint(&a, &b).shifted(1), sum);
        assert!(a.negated() < Dyadic::zero() && a.negated().abs() == a);
    }
}
