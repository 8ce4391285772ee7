//! Directed rounding from error-free transformations.
//!
//! An operation rounded to nearest is at most one step away from the same operation rounded down or up, and the sign of its
//! exact residual says whether that step is due. The residual comes from TwoSum (Knuth 1969) for + and −, and from Dekker's
//! product (1971) with Veltkamp's splitting for ×, ÷ and √; `f32` has its residuals in doubles. No rounding mode is
//! touched and no fused operation is needed, so results agree to the bit wherever arithmetic is IEEE 754.
//!
//! **Where a residual cannot be trusted, always step.** Dekker's product is exact while neither the splitting overflows
//! (operands below 2^990) nor the smallest partial product underflows (product at least 2^−960). Outside of that the result
//! is stepped outwards whatever the residual says: still a bound, at most one step wider than the best one. Steps at
//! the ends of the range do what they should: down from +∞ is the largest finite number, up from −0 the smallest subnormal.

use super::Scalar;

/// A scalar with outward-rounded operations: the ends of an [`Interval`](super::Interval).
///
/// `_down` is at most, `_up` at least the exact result. The tightest bound is not promised, but machine floats miss it by at
/// most one step and only near the ends of their range. A result that does not exist (∞ − ∞, 0 × ∞, 0 ÷ 0) is −∞ downwards and
/// +∞ upwards, except that 0 × ±∞ is 0: an infinite end of an interval stands for unbounded finite numbers.
///
/// Arbitrary-precision numbers implement this with their own rounding argument.
pub trait Directed: Scalar {
    /// At most `self` + b.
    fn add_down(&self, b: &Self) -> Self;
    /// At least `self` + b.
    fn add_up(&self, b: &Self) -> Self;
    /// At most `self` × b.
    fn mul_down(&self, b: &Self) -> Self;
    /// At least `self` × b.
    fn mul_up(&self, b: &Self) -> Self;
    /// At most `self` ÷ b, b ≠ 0.
    fn div_down(&self, b: &Self) -> Self;
    /// At least `self` ÷ b, b ≠ 0.
    fn div_up(&self, b: &Self) -> Self;
    /// At most √`self`, and at least 0; 0 for negative numbers.
    fn sqrt_down(&self) -> Self;
    /// At least √`self`; 0 for negative numbers.
    fn sqrt_up(&self) -> Self;
    /// At most the double v.
    fn from_f64_down(v: f64) -> Self;
    /// At least the double v.
    fn from_f64_up(v: f64) -> Self;
    /// At most n.
    fn int_down(n: i32) -> Self;
    /// At least n.
    fn int_up(n: i32) -> Self;
    /// At most `self` × 2^e.
    fn mul_pow2_down(&self, e: i32) -> Self;
    /// At least `self` × 2^e.
    fn mul_pow2_up(&self, e: i32) -> Self;

    /// At most every real number that rounds to `self`, with a few roundoffs to spare: cheap, and without branches.
    #[inline]
    fn below(&self) -> Self {
        self.clone() - &self.clone().abs().mul_pow2(2 - Self::BITS.cast_signed())
    }

    /// At least every real number that rounds to `self`, with a few roundoffs to spare.
    #[inline]
    fn above(&self) -> Self {
        self.clone().abs().mul_pow2(2 - Self::BITS.cast_signed()) + self
    }

    /// At most `self` − b.
    #[inline]
    fn sub_down(&self, b: &Self) -> Self {
        self.add_down(&-b.clone())
    }

    /// At least `self` − b.
    #[inline]
    fn sub_up(&self, b: &Self) -> Self {
        self.add_up(&-b.clone())
    }
}

/// The sum rounded to nearest, and its exact error; the error is not a number where the sum overflows on the way.
#[inline]
pub const fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

/// The two halves of a double: 26 bits each (Veltkamp), exact below 2^990.
#[inline]
const fn split(a: f64) -> (f64, f64) {
    let c = 134_217_729.0 * a; // 2^27 + 1
    let hi = c - (c - a);
    (hi, a - hi)
}

/// The product rounded to nearest, and its exact error; see the module's header for the range.
#[inline]
pub const fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let (ah, al) = split(a);
    let (bh, bl) = split(b);
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

/// 2^−960 and 2^990: between them residuals of products are exact.
const TINY: f64 = f64::from_bits((1023 - 960) << 52);
const HUGE: f64 = f64::from_bits((1023 + 990) << 52);

/// Residual of a product p = a·b: its sign is that of the exact product minus p; not a number where it cannot be told.
#[inline]
fn product_residual(a: f64, b: f64, p: f64) -> f64 {
    if p.abs() >= TINY && p.abs() <= HUGE && a.abs() <= HUGE && b.abs() <= HUGE {
        two_product(a, b).1
    } else if a == 0.0 || b == 0.0 || a.is_infinite() || b.is_infinite() {
        0.0
    } else if p == 0.0 {
        // Underflow: the sign is that of the factors, so a positive product is not stepped below 0.
        a.signum() * b.signum()
    } else {
        f64::NAN
    }
}

/// Sign of the exact a − q·b, where q·b is near a; not a number where it cannot be told.
#[inline]
fn division_residual(a: f64, b: f64, q: f64) -> f64 {
    if a.abs() >= TINY && a.abs() <= HUGE && b.abs() >= TINY && b.abs() <= HUGE && q.abs() >= TINY && q.abs() <= HUGE {
        let (p, e) = two_product(q, b);
        // a − p is exact (p lies within a factor of two of a), so the comparison is the exact one.
        let r = a - p;
        if r > e {
            1.0
        } else if r < e {
            -1.0
        } else {
            0.0
        }
    } else if a == 0.0 || a.is_infinite() || b.is_infinite() {
        0.0
    } else if q == 0.0 {
        // Underflow: a − q·b is a.
        a.signum()
    } else {
        f64::NAN
    }
}

/// Steps down unless the residual says that the rounded value is not above the exact one.
macro_rules! step {
    (down $v:expr, $residual:expr) => {{
        let (v, r) = ($v, $residual);
        if r >= 0.0 { v } else { v.next_down() }
    }};
    (up $v:expr, $residual:expr) => {{
        let (v, r) = ($v, $residual);
        if r <= 0.0 { v } else { v.next_up() }
    }};
}

/// Implements the trait from residuals: of a sum, of a product, of a quotient, of a square root.
macro_rules! directed {
    ($float:ident, $sum:expr, $product:expr, $quotient:expr, $root:expr) => {
        impl Directed for $float {
            #[inline]
            fn add_down(&self, b: &Self) -> Self {
                let s = self + b;
                if s.is_nan() { $float::NEG_INFINITY } else { step!(down s, $sum(*self, *b, s)) }
            }
            #[inline]
            fn add_up(&self, b: &Self) -> Self {
                let s = self + b;
                if s.is_nan() { $float::INFINITY } else { step!(up s, $sum(*self, *b, s)) }
            }
            #[inline]
            fn mul_down(&self, b: &Self) -> Self {
                let p = self * b;
                if p.is_nan() {
                    return if *self == 0.0 || *b == 0.0 { 0.0 } else { $float::NEG_INFINITY };
                }
                step!(down p, $product(*self, *b, p))
            }
            #[inline]
            fn mul_up(&self, b: &Self) -> Self {
                let p = self * b;
                if p.is_nan() {
                    return if *self == 0.0 || *b == 0.0 { 0.0 } else { $float::INFINITY };
                }
                step!(up p, $product(*self, *b, p))
            }
            #[inline]
            fn div_down(&self, b: &Self) -> Self {
                let q = self / b;
                if q.is_nan() || *b == 0.0 {
                    return $float::NEG_INFINITY;
                }
                let r = $quotient(*self, *b, q);
                step!(down q, if *b < 0.0 { -r } else { r })
            }
            #[inline]
            fn div_up(&self, b: &Self) -> Self {
                let q = self / b;
                if q.is_nan() || *b == 0.0 {
                    return $float::INFINITY;
                }
                let r = $quotient(*self, *b, q);
                step!(up q, if *b < 0.0 { -r } else { r })
            }
            #[inline]
            fn sqrt_down(&self) -> Self {
                if self.is_nan() || *self <= 0.0 {
                    return 0.0;
                }
                let s = super::Field::sqrt(*self);
                step!(down s, $root(*self, s)).max(0.0)
            }
            #[inline]
            fn sqrt_up(&self) -> Self {
                if *self <= 0.0 {
                    return 0.0;
                }
                let s = super::Field::sqrt(*self);
                if s.is_nan() { $float::INFINITY } else { step!(up s, $root(*self, s)) }
            }
            #[inline]
            fn from_f64_down(v: f64) -> Self {
                let s = Self::from_f64(v);
                if s.is_nan() { $float::NEG_INFINITY } else if f64::from(s) <= v { s } else { s.next_down() }
            }
            #[inline]
            fn from_f64_up(v: f64) -> Self {
                let s = Self::from_f64(v);
                if s.is_nan() { $float::INFINITY } else if f64::from(s) >= v { s } else { s.next_up() }
            }
            #[inline]
            fn int_down(n: i32) -> Self {
                Self::from_f64_down(f64::from(n))
            }
            #[inline]
            fn int_up(n: i32) -> Self {
                Self::from_f64_up(f64::from(n))
            }
            #[inline]
            fn below(&self) -> Self {
                // Four units of roundoff, and the smallest normal number for products that underflow.
                self - (self.abs() * (2.0 * $float::EPSILON) + $float::MIN_POSITIVE)
            }
            #[inline]
            fn above(&self) -> Self {
                self + (self.abs() * (2.0 * $float::EPSILON) + $float::MIN_POSITIVE)
            }
            #[inline]
            fn mul_pow2_down(&self, e: i32) -> Self {
                power(*self, e, Self::mul_down, $float::NEG_INFINITY)
            }
            #[inline]
            fn mul_pow2_up(&self, e: i32) -> Self {
                power(*self, e, Self::mul_up, $float::INFINITY)
            }
        }
    };
}

/// v × 2^e by exact powers in the normal range, each product rounded as `times` does.
#[inline]
fn power<S: Scalar>(v: S, e: i32, times: impl Fn(&S, &S) -> S, nothing: S) -> S {
    const STEP: i32 = 100;
    let mut v = v;
    let mut e = e.clamp(-4000, 4000);
    if v.partial_cmp(&nothing).is_none() {
        return nothing;
    }
    while e != 0 && !v.is_zero() && v.is_finite() {
        let k = e.clamp(-STEP, STEP);
        v = times(&v, &S::one().mul_pow2(k));
        e -= k;
    }
    v
}

directed!(
    f64,
    |a: f64, b: f64, s: f64| if s.is_infinite() && (a.is_infinite() || b.is_infinite()) {
        0.0
    } else {
        two_sum(a, b).1
    },
    product_residual,
    division_residual,
    |a: f64, s: f64| if a.is_infinite() { 0.0 } else { division_residual(a, s, s) }
);

/// In doubles the product of two floats is exact, and their sum has an exact residual.
#[inline]
fn float_sum(a: f32, b: f32, s: f32) -> f64 {
    if a.is_infinite() || b.is_infinite() {
        return 0.0;
    }
    let (sum, e) = two_sum(f64::from(a), f64::from(b));
    let r = sum - f64::from(s);
    if r == 0.0 { e } else { r }
}

#[inline]
fn float_product(a: f32, b: f32, p: f32) -> f64 {
    if a.is_infinite() || b.is_infinite() { 0.0 } else { f64::from(a) * f64::from(b) - f64::from(p) }
}

#[inline]
fn float_quotient(a: f32, b: f32, q: f32) -> f64 {
    if a.is_infinite() || b.is_infinite() || q.is_infinite() {
        // An infinite operand gives an exact quotient; an overflow is stepped.
        return if q.is_infinite() && a.is_finite() { f64::NAN } else { 0.0 };
    }
    f64::from(a) - f64::from(q) * f64::from(b)
}

directed!(f32, float_sum, float_product, float_quotient, |a: f32, s: f32| if a.is_infinite() {
    0.0
} else {
    f64::from(a) - f64::from(s) * f64::from(s)
});
