//! Intervals: enclosures of real numbers, rounded outwards.
//!
//! [`Interval<S>`] holds every real number between its ends; each operation returns an interval that contains all results
//! for all members of its operands. A formula written over [`Field`] is thus run in a scalar to find something, and in
//! intervals of that scalar to prove it. Ends may be infinite: [lo, +∞] is the set of finite numbers from lo upwards.
//!
//! An interval is a `Field` and never a [`Scalar`](super::Scalar): overlapping intervals have no order, and the missing
//! `PartialOrd` says so when the program is compiled. Ask [`Interval::certainly_lt`], [`Interval::possibly_lt`] and
//! [`Interval::sign3`] instead. (Moore 1966; the sign classes of the product as in IEEE 1788.)

use super::{Directed, Field};
use core::ops::{Add, Div, Mul, Neg, Sub};
use num_traits::{One, Zero};

/// All real numbers from `lo` to `hi`, lo ≤ hi.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<S> {
    lo: S,
    hi: S,
}

/// What an interval says about a sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign3 {
    /// All members are below zero.
    Negative,
    /// The interval is [0, 0].
    Zero,
    /// All members are above zero.
    Positive,
    /// Nothing is certain.
    Unknown,
}

impl<S: Directed> Interval<S> {
    /// The interval of these ends; the whole line if they are out of order or not numbers.
    #[inline]
    pub fn new(lo: S, hi: S) -> Self {
        if lo <= hi { Self { lo, hi } } else { Self::entire() }
    }

    /// The interval of one number.
    #[inline]
    pub fn point(v: S) -> Self {
        Self { lo: v.clone(), hi: v }
    }

    /// Encloses a double.
    #[inline]
    pub fn from_f64(v: f64) -> Self {
        Self::new(S::from_f64_down(v), S::from_f64_up(v))
    }

    /// The whole real line.
    #[inline]
    pub fn entire() -> Self {
        Self { lo: -S::infinity(), hi: S::infinity() }
    }

    /// The smallest interval that contains both numbers, in whatever order.
    #[inline]
    pub fn between(a: S, b: S) -> Self {
        if a <= b { Self::new(a, b) } else { Self::new(b, a) }
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

    /// A number inside, near the middle; 0 for the whole line, the finite end of a half line.
    pub fn middle(&self) -> S {
        match (self.lo.is_finite(), self.hi.is_finite()) {
            // Halves first: the sum of two large ends overflows.
            (true, true) => {
                let m = self.lo.clone().half() + &self.hi.clone().half();
                m.clamp(self.lo.clone(), self.hi.clone())
            }
            (true, false) => self.lo.clone(),
            (false, true) => self.hi.clone(),
            (false, false) => S::zero(),
        }
    }

    /// At least hi − lo.
    #[inline]
    pub fn width(&self) -> S {
        self.hi.sub_up(&self.lo)
    }

    /// Largest absolute value of a member.
    #[inline]
    pub fn magnitude(&self) -> S {
        self.lo.clone().abs().max(self.hi.clone().abs())
    }

    /// Smallest absolute value of a member.
    #[inline]
    pub fn mignitude(&self) -> S {
        if self.contains(&S::zero()) { S::zero() } else { self.lo.clone().abs().min(self.hi.clone().abs()) }
    }

    /// Whether v is a member.
    #[inline]
    pub fn contains(&self, v: &S) -> bool {
        self.lo <= *v && *v <= self.hi
    }

    /// Whether every member of the other interval is one of this.
    #[inline]
    pub fn encloses(&self, other: &Self) -> bool {
        self.lo <= other.lo && other.hi <= self.hi
    }

    /// Whether the two have a member in common.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        self.lo <= other.hi && other.lo <= self.hi
    }

    /// The smallest interval that contains both.
    #[inline]
    pub fn hull(&self, other: &Self) -> Self {
        Self { lo: self.lo.clone().min(other.lo.clone()), hi: self.hi.clone().max(other.hi.clone()) }
    }

    /// The common members, if any.
    #[inline]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let (lo, hi) = (self.lo.clone().max(other.lo.clone()), self.hi.clone().min(other.hi.clone()));
        (lo <= hi).then_some(Self { lo, hi })
    }

    /// Every member of this is below every member of the other.
    #[inline]
    pub fn certainly_lt(&self, other: &Self) -> bool {
        self.hi < other.lo
    }

    /// No member of this is above any member of the other.
    #[inline]
    pub fn certainly_le(&self, other: &Self) -> bool {
        self.hi <= other.lo
    }

    /// Some member of this is below some member of the other.
    #[inline]
    pub fn possibly_lt(&self, other: &Self) -> bool {
        self.lo < other.hi
    }

    /// What is known of the sign.
    #[inline]
    pub fn sign3(&self) -> Sign3 {
        let zero = S::zero();
        if self.lo > zero {
            Sign3::Positive
        } else if self.hi < zero {
            Sign3::Negative
        } else if self.lo.is_zero() && self.hi.is_zero() {
            Sign3::Zero
        } else {
            Sign3::Unknown
        }
    }

    /// The smaller of two numbers, enclosed.
    #[inline]
    pub fn min(&self, other: &Self) -> Self {
        Self { lo: self.lo.clone().min(other.lo.clone()), hi: self.hi.clone().min(other.hi.clone()) }
    }

    /// The larger of two numbers, enclosed.
    #[inline]
    pub fn max(&self, other: &Self) -> Self {
        Self { lo: self.lo.clone().max(other.lo.clone()), hi: self.hi.clone().max(other.hi.clone()) }
    }
}

impl<S: Directed> Zero for Interval<S> {
    #[inline]
    fn zero() -> Self {
        Self::point(S::zero())
    }

    #[inline]
    fn is_zero(&self) -> bool {
        self.lo.is_zero() && self.hi.is_zero()
    }
}

impl<S: Directed> One for Interval<S> {
    #[inline]
    fn one() -> Self {
        Self::point(S::one())
    }
}

impl<S: Directed> Neg for Interval<S> {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { lo: -self.hi, hi: -self.lo }
    }
}

impl<S: Directed> Add<&Self> for Interval<S> {
    type Output = Self;
    #[inline]
    fn add(self, b: &Self) -> Self {
        Self { lo: self.lo.add_down(&b.lo), hi: self.hi.add_up(&b.hi) }
    }
}

impl<S: Directed> Sub<&Self> for Interval<S> {
    type Output = Self;
    #[inline]
    fn sub(self, b: &Self) -> Self {
        Self { lo: self.lo.sub_down(&b.hi), hi: self.hi.sub_up(&b.lo) }
    }
}

impl<S: Directed> Mul<&Self> for Interval<S> {
    type Output = Self;

    /// By the signs of the ends: two products, or four where both factors straddle zero.
    ///
    /// | a \ b | b ≥ 0 | b ≤ 0 | mixed |
    /// |---|---|---|---|
    /// | a ≥ 0 | [a₀b₀, a₁b₁] | [a₁b₀, a₀b₁] | [a₁b₀, a₁b₁] |
    /// | a ≤ 0 | [a₀b₁, a₁b₀] | [a₁b₁, a₀b₀] | [a₀b₁, a₀b₀] |
    /// | mixed | [a₀b₁, a₁b₁] | [a₁b₀, a₀b₀] | min, max of both |
    #[inline]
    fn mul(self, b: &Self) -> Self {
        let z = S::zero();
        let a = self;
        let of = |l: &S, m: &S, h: &S, k: &S| Self { lo: l.mul_down(m), hi: h.mul_up(k) };
        if a.lo >= z {
            if b.lo >= z {
                of(&a.lo, &b.lo, &a.hi, &b.hi)
            } else if b.hi <= z {
                of(&a.hi, &b.lo, &a.lo, &b.hi)
            } else {
                of(&a.hi, &b.lo, &a.hi, &b.hi)
            }
        } else if a.hi <= z {
            if b.lo >= z {
                of(&a.lo, &b.hi, &a.hi, &b.lo)
            } else if b.hi <= z {
                of(&a.hi, &b.hi, &a.lo, &b.lo)
            } else {
                of(&a.lo, &b.hi, &a.lo, &b.lo)
            }
        } else if b.lo >= z {
            of(&a.lo, &b.hi, &a.hi, &b.hi)
        } else if b.hi <= z {
            of(&a.hi, &b.lo, &a.lo, &b.lo)
        } else {
            Self { lo: a.lo.mul_down(&b.hi).min(a.hi.mul_down(&b.lo)), hi: a.lo.mul_up(&b.lo).max(a.hi.mul_up(&b.hi)) }
        }
    }
}

impl<S: Directed> Div<&Self> for Interval<S> {
    type Output = Self;

    /// The whole line, or a half line, where the divisor can be zero.
    #[inline]
    fn div(self, b: &Self) -> Self {
        let z = S::zero();
        if b.lo < z && b.hi > z || b.is_zero() {
            return Self::entire();
        }
        // Now b ≥ 0 or b ≤ 0: the latter is the former with both signs changed.
        let (a, b) = if b.hi <= z { (-self, -b.clone()) } else { (self, b.clone()) };
        let (near, far) = (&b.lo, &b.hi);
        let lo = if a.lo >= z {
            a.lo.div_down(far)
        } else if near.is_zero() {
            -S::infinity()
        } else {
            a.lo.div_down(near)
        };
        let hi = if a.hi <= z {
            a.hi.div_up(far)
        } else if near.is_zero() {
            S::infinity()
        } else {
            a.hi.div_up(near)
        };
        Self { lo, hi }
    }
}

macro_rules! owned {
    ($($trait:ident $name:ident),*) => {$(
        impl<S: Directed> $trait for Interval<S> {
            type Output = Self;
            #[inline]
            fn $name(self, b: Self) -> Self {
                $trait::$name(self, &b)
            }
        }
    )*};
}
owned!(Add add, Sub sub, Mul mul, Div div);

impl<S: Directed> Field for Interval<S> {
    #[inline]
    fn int(n: i32) -> Self {
        Self { lo: S::int_down(n), hi: S::int_up(n) }
    }

    #[inline]
    fn mul_pow2(self, e: i32) -> Self {
        Self { lo: self.lo.mul_pow2_down(e), hi: self.hi.mul_pow2_up(e) }
    }

    #[inline]
    fn half(self) -> Self {
        let half = S::one().half();
        Self { lo: self.lo.mul_down(&half), hi: self.hi.mul_up(&half) }
    }

    #[inline]
    fn twice(self) -> Self {
        Self { lo: self.lo.add_down(&self.lo), hi: self.hi.add_up(&self.hi) }
    }

    /// Of the members that are not negative; the whole half line where there is none.
    #[inline]
    fn sqrt(self) -> Self {
        if self.hi < S::zero() {
            return Self { lo: S::zero(), hi: S::infinity() };
        }
        Self { lo: self.lo.sqrt_down(), hi: self.hi.sqrt_up() }
    }

    #[inline]
    fn abs(self) -> Self {
        if self.lo >= S::zero() {
            self
        } else if self.hi <= S::zero() {
            -self
        } else {
            Self { lo: S::zero(), hi: self.magnitude() }
        }
    }

    /// Tighter than the product of two independent intervals: never negative.
    #[inline]
    fn square(self) -> Self {
        let a = self.abs();
        Self { lo: a.lo.mul_down(&a.lo).max(S::zero()), hi: a.hi.mul_up(&a.hi) }
    }
}
