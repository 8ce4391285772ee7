//! Enclosures: intervals for long proofs, a few roundoffs wider than they could be and several times faster.
//!
//! An [`Interval`](super::Interval) is as tight as its scalar allows; for that it looks at residuals and signs, which costs
//! more than the arithmetic. Where an inequality is proved over a whole cell the width of the cell dwarfs any rounding, so an
//! [`Enclosure`] rounds to nearest and then moves outwards by four roundoffs ([`Directed::below`], [`Directed::above`]),
//! without a branch. Whatever is not finite becomes the whole line: nothing is ever proved by an overflow.

use super::{Directed, Field};
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{One, Zero};

/// All real numbers from `lo` to `hi`; the whole line where one of them is not finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Enclosure<S> {
    lo: S,
    hi: S,
}

impl<S: Directed> Enclosure<S> {
    /// The numbers between two exact ends; the whole line if they are out of order or not finite.
    #[inline]
    pub fn new(lo: S, hi: S) -> Self {
        // The difference of finite ends in order is finite and not negative, or overflows.
        let width = hi.clone() - &lo;
        if width >= S::zero() && width.is_finite() { Self { lo, hi } } else { Self::entire() }
    }

    /// What rounds to between these two.
    #[inline]
    fn around(lo: S, hi: S) -> Self {
        Self::new(lo.below(), hi.above())
    }

    /// One number.
    #[inline]
    pub fn point(v: S) -> Self {
        Self { lo: v.clone(), hi: v }
    }

    /// The whole line.
    #[inline]
    pub fn entire() -> Self {
        Self { lo: -S::infinity(), hi: S::infinity() }
    }

    /// Lower end.
    #[inline]
    pub const fn lo(&self) -> &S {
        &self.lo
    }

    /// Upper end.
    #[inline]
    pub const fn hi(&self) -> &S {
        &self.hi
    }

    /// A number inside, near the middle; 0 for the whole line.
    pub fn middle(&self) -> S {
        if !self.lo.is_finite() {
            return S::zero();
        }
        let m = self.lo.clone().half() + &self.hi.clone().half();
        m.clamp(self.lo.clone(), self.hi.clone())
    }

    /// At least hi − lo.
    #[inline]
    pub fn width(&self) -> S {
        (self.hi.clone() - &self.lo).above()
    }

    /// Largest absolute value of a member.
    #[inline]
    pub fn magnitude(&self) -> S {
        self.lo.clone().abs().max(self.hi.clone().abs())
    }

    /// Whether v is a member.
    #[inline]
    pub fn contains(&self, v: &S) -> bool {
        self.lo <= *v && *v <= self.hi
    }

    /// The smallest one that contains both.
    #[inline]
    pub fn hull(&self, other: &Self) -> Self {
        Self { lo: self.lo.clone().min(other.lo.clone()), hi: self.hi.clone().max(other.hi.clone()) }
    }

    /// No member of this is above any member of the other.
    #[inline]
    pub fn certainly_le(&self, other: &Self) -> bool {
        self.hi <= other.lo
    }
}

impl<S: Directed> Zero for Enclosure<S> {
    #[inline]
    fn zero() -> Self {
        Self::point(S::zero())
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.lo.is_zero() && self.hi.is_zero()
    }
}

impl<S: Directed> One for Enclosure<S> {
    #[inline]
    fn one() -> Self {
        Self::point(S::one())
    }
}

impl<S: Directed> Neg for Enclosure<S> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl<S: Directed> Add<&Self> for Enclosure<S> {
    type Output = Self;
    #[inline]
    fn add(self, b: &Self) -> Self {
        Self::around(self.lo + &b.lo, self.hi + &b.hi)
    }
}

impl<S: Directed> Sub<&Self> for Enclosure<S> {
    type Output = Self;
    #[inline]
    fn sub(self, b: &Self) -> Self {
        Self::around(self.lo - &b.hi, self.hi - &b.lo)
    }
}

impl<S: Directed> Mul<&Self> for Enclosure<S> {
    type Output = Self;

    /// All four products: rounding is monotone, so the smallest rounded one is the smallest one rounded.
    #[inline]
    fn mul(self, b: &Self) -> Self {
        let (p, q) = (self.lo.clone() * &b.lo, self.lo * &b.hi);
        let (r, s) = (self.hi.clone() * &b.lo, self.hi * &b.hi);
        // Not a number, or an overflow of any of the four, shows in their sum.
        let sum = p.clone() + &q + &r + &s;
        if !sum.is_finite() {
            return Self::entire();
        }
        let lo = p.clone().min(q.clone()).min(r.clone().min(s.clone()));
        let hi = p.max(q).max(r.max(s));
        Self::around(lo, hi)
    }
}

impl<S: Directed> Div<&Self> for Enclosure<S> {
    type Output = Self;

    /// The whole line where the divisor may be zero.
    #[inline]
    fn div(self, b: &Self) -> Self {
        if b.contains(&S::zero()) || !b.lo.is_finite() {
            return Self::entire();
        }
        let one = S::one();
        let inverse = Self::around(one.clone() / &b.hi, one / &b.lo);
        self * &inverse
    }
}

macro_rules! owned {
    ($($trait:ident $name:ident),*) => {$(
        impl<S: Directed> $trait for Enclosure<S> {
            type Output = Self;
            #[inline]
            fn $name(self, b: Self) -> Self {
                $trait::$name(self, &b)
            }
        }
    )*};
}
owned!(Add add, Sub sub, Mul mul, Div div);

impl<S: Directed> Field for Enclosure<S> {
    #[inline]
    fn int(n: i32) -> Self {
        Self::new(S::int_down(n), S::int_up(n))
    }

    #[inline]
    fn mul_pow2(self, e: i32) -> Self {
        Self::around(self.lo.mul_pow2(e), self.hi.mul_pow2(e))
    }

    #[inline]
    fn half(self) -> Self {
        Self::around(self.lo.half(), self.hi.half())
    }

    #[inline]
    fn twice(self) -> Self {
        Self::around(self.lo.twice(), self.hi.twice())
    }

    /// Of the members that are not negative; 0 at least.
    #[inline]
    fn sqrt(self) -> Self {
        let zero = S::zero;
        let (lo, hi) = (self.lo.max(zero()).sqrt(), self.hi.max(zero()).sqrt());
        if !hi.is_finite() {
            return Self::entire();
        }
        Self::new(lo.below().max(zero()), hi.above())
    }

    #[inline]
    fn abs(self) -> Self {
        let zero = S::zero();
        if self.lo >= zero {
            self
        } else if self.hi <= zero {
            -self
        } else {
            Self { lo: zero, hi: self.magnitude() }
        }
    }

    /// Tighter than the product of two independent ones: never negative.
    #[inline]
    fn square(self) -> Self {
        let a = self.abs();
        let (lo, hi) = (a.lo.square(), a.hi.square());
        if !hi.is_finite() {
            return Self { lo: S::zero(), hi: S::infinity() };
        }
        Self::new(lo.below().max(S::zero()), hi.above())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Interval;

    /// Every operation contains what the tight interval of the same operands contains.
    #[test]
    fn holds_the_tight_interval() {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            // Signs, magnitudes from 2^-60 to 2^60, and now and then a zero or something tiny.
            let m = (state >> 12) as f64 / (1_u64 << 52) as f64 - 0.5;
            match state % 17 {
                0 => 0.0,
                1 => m * f64::MIN_POSITIVE,
                _ => m * ((state >> 5) % 60).pow(3) as f64 * 1e-3,
            }
        };
        for _ in 0..200_000 {
            let (a, b, c, d) = (next(), next(), next(), next());
            let (x, y) = (Interval::between(a, b), Interval::between(c, d));
            let (u, v) = (Enclosure::new(*x.lo(), *x.hi()), Enclosure::new(*y.lo(), *y.hi()));
            let holds = |e: Enclosure<f64>, i: Interval<f64>| *e.lo() <= *i.lo() && *i.hi() <= *e.hi();
            assert!(holds(u + v, x + y), "{x:?} + {y:?}");
            assert!(holds(u - v, x - y), "{x:?} - {y:?}");
            assert!(holds(u * v, x * y), "{x:?} * {y:?}");
            assert!(holds(u / v, x / y), "{x:?} / {y:?}");
            assert!(holds(u.square(), x.square()), "{x:?} squared");
            assert!(holds(u.abs().sqrt(), x.abs().sqrt()), "root of {x:?}");
            assert!(holds(u.mul_pow2(-3), x.mul_pow2(-3)), "{x:?} / 8");
        }
    }

    #[test]
    fn an_overflow_proves_nothing() {
        let huge = Enclosure::point(f64::MAX);
        assert_eq!(huge * huge, Enclosure::entire());
        assert_eq!(huge + huge, Enclosure::entire());
        assert_eq!(Enclosure::entire() * Enclosure::zero(), Enclosure::<f64>::entire());
        assert_eq!(Enclosure::int(1) / Enclosure::new(-1.0, 1.0), Enclosure::entire());
    }
}
