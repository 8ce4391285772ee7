//! The Bernstein form on an interval: change of basis, halving, sign patterns.
//!
//! On [lo, hi] with x = lo + (hi − lo)s, p(x) = L⁻¹ Σ bᵢ C(n,i) sⁱ(1−s)ⁿ⁻ⁱ. The bᵢ are kept *times L*, the least common
//! multiple of the binomial coefficients C(n,0…n): then bᵢ = Σ_{j≤i} C(i,j) (L/C(n,j)) qⱼ holds integers only (qⱼ:
//! coefficients in s), needs no division, and signs, the only thing asked of them, stay the same. With b₀ = L·p(lo) and
//! bₙ = L·p(hi), the curve lies in the hull of its coefficients, and the number of sign variations bounds the number of
//! roots inside, with equal parity (Lane and Riesenfeld 1981).
//!
//! **Rounding.** A piece carries a bound of the error of each of its coefficients, its *noise*, so what is beyond the noise
//! has the sign that the exact polynomial's coefficient has; every word here about signs is a theorem. With n = N − 1, in
//! units of u (times 1 + O(nu), which the rounding up of the constants pays for):
//!
//! * *change of basis*: one product and at most n sums lead to bᵢ, and the weights of |qⱼ| in it are at most L: N·L·Σ|qⱼ|;
//! * *scaling to the interval*: qⱼ = cⱼwʲ with w = hi − lo rounded: at most 2n + 1 roundings of |qⱼ|;
//! * *shift to the interval*: as in twice the precision (`twofold`), one rounding of |cⱼ| and 8N²u·Σ C(i,j)|aᵢ|loⁱ⁻ʲ; times
//!   wʲ and summed over j the latter is at most 8N²u·Σ|aⱼ|hiʲ;
//! * *halving*: n levels of averages of numbers of at most max |bᵢ| ≤ L·Σ|qⱼ| in modulus round once each: n·L·Σ|qⱼ| more for
//!   each halving. A middle that is no number of the scalar is rounded; for [`Given::Provably`] both halves are then written anew.
//!
//! What Σ|qⱼ| measures is the size of p *on the piece*: writing p anew on a short piece near a zero leaves little noise.
//! Where nothing is to be proved about the given coefficients, N·u·L·Σ|aⱼ|hiʲ is added: about what the roundings
//! do that lead to a coefficient, if the polynomial was multiplied out from roots.

use super::eval::{ascend, descend};
use super::{Polynomial, twofold};
use crate::scalar::Scalar;
use core::array::from_fn;

/// Binomial data of degree N − 1.
struct Binomials<const N: usize>;

impl<const N: usize> Binomials<N> {
    /// L/C(n,j), with n = N − 1 and L the least common multiple of C(n,0), …, C(n,n).
    const FACTORS: [i32; N] = factors::<N>();
    /// L itself.
    const MULTIPLE: i32 = multiple::<N>();
}

const fn gcd(a: i64, b: i64) -> i64 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// C(n,j); n is small, every intermediate product is divisible.
const fn binomial(n: i64, j: i64) -> i64 {
    let mut c = 1;
    let mut i = 0;
    while i < j {
        c = c * (n - i) / (i + 1);
        i += 1;
    }
    c
}

#[allow(clippy::cast_possible_wrap, clippy::cast_possible_truncation, reason = "N ≤ 16 is asserted: L ≤ 45045")]
const fn multiple<const N: usize>() -> i32 {
    assert!(N >= 1 && N <= 16, "1 to 16 coefficients");
    let n = N as i64 - 1;
    let mut l = 1;
    let mut j = 0;
    while j <= n {
        let c = binomial(n, j);
        l = l / gcd(l, c) * c;
        j += 1;
    }
    l as i32
}

#[allow(clippy::cast_possible_wrap, clippy::cast_possible_truncation, reason = "quotients of L ≤ 45045")]
const fn factors<const N: usize>() -> [i32; N] {
    let mut f = [0; N];
    let mut j = 0;
    while j < N {
        f[j] = (multiple::<N>() as i64 / binomial(N as i64 - 1, j as i64)) as i32;
        j += 1;
    }
    f
}

/// Bernstein coefficients, times L, of the polynomial with coefficients q on [0, 1].
#[inline]
pub(crate) fn on_unit<S: Scalar, const N: usize>(q: &[S; N]) -> [S; N] {
    let mut b: [S; N] = from_fn(|j| q[j].clone() * &S::int(Binomials::<N>::FACTORS[j]));
    for done in 1..N {
        descend(&mut b, done - 1, |upper, lower| *upper = upper.clone() + &*lower);
    }
    b
}

/// Bernstein coefficients, times L, of p on [lo, hi].
#[inline]
pub(crate) fn on_interval<S: Scalar, const N: usize>(p: &Polynomial<S, N>, lo: &S, hi: &S) -> [S; N] {
    let mut q = p.taylor(lo).coefficients;
    let width = hi.clone() - lo;
    let mut power = S::one();
    for c in &mut q {
        *c = c.clone() * &power;
        power = power * &width;
    }
    on_unit(&q)
}

/// The integer L by which the coefficients of [`on_unit`] are too large.
#[inline]
pub(crate) fn scale<S: Scalar, const N: usize>() -> S {
    S::int(Binomials::<N>::MULTIPLE)
}

/// Replaces coefficients by those of the right half and writes those of the left half beside, by de Casteljau's scheme at ½.
///
/// In place, since arrays that were just computed are slow to move. Sums are halved at the end, all at once, by powers of two:
/// the same numbers in fewer steps.
#[inline]
pub(crate) fn halve<S: Scalar, const N: usize>(b: &mut [S; N], left: &mut [S; N]) {
    for (k, l) in left.iter_mut().enumerate() {
        *l = b[0].clone().mul_pow2(-places(k));
        ascend(b, k, |lower, upper| *lower = lower.clone() + &*upper);
    }
    for (i, c) in b.iter_mut().enumerate() {
        *c = c.clone().mul_pow2(-places(N - 1 - i));
    }
}

/// A number below N as an exponent.
#[inline]
#[allow(clippy::cast_possible_wrap, clippy::cast_possible_truncation, reason = "below N ≤ 16")]
const fn places(k: usize) -> i32 {
    k as i32
}

/// Where the control polygon over [lo, hi] crosses zero between coefficients i and i + 1, which have opposite signs: a
/// first guess of a root.
#[inline]
pub(crate) fn polygon_zero<S: Scalar, const N: usize>(b: &[S; N], i: u32, lo: &S, hi: &S) -> S {
    let width = hi.clone() - lo;
    let (Some(left), Some(right)) = (b.get(i as usize), b.get(i as usize + 1)) else {
        return width.half() + lo;
    };
    let fraction = left.clone() / &(left.clone() - right);
    let interval = S::ratio(1, i32::try_from(N).unwrap_or(2) - 1);
    (S::int(i.cast_signed()) + &fraction) * &interval * &width + lo
}

/// Which coefficients are certainly positive, certainly negative: one bit each, lowest first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Signs {
    /// Above the noise.
    pub(crate) positive: u32,
    /// Below minus the noise.
    pub(crate) negative: u32,
}

impl Signs {
    /// The pattern of b, with everything of modulus up to `noise` left undecided.
    #[inline]
    pub(crate) fn of<S: Scalar, const N: usize>(b: &[S; N], noise: &S) -> Self {
        let floor = -noise.clone();
        let mut signs = Self { positive: 0, negative: 0 };
        for (i, c) in b.iter().enumerate() {
            signs.positive |= u32::from(*c > *noise) << i;
            signs.negative |= u32::from(*c < floor) << i;
        }
        signs
    }

    /// The bits of N coefficients.
    #[inline]
    #[allow(clippy::cast_possible_truncation, reason = "N ≤ 16")]
    pub(crate) const fn full<const N: usize>() -> u32 {
        u32::MAX >> (u32::BITS - N as u32)
    }

    /// The coefficients of known sign.
    #[inline]
    pub(crate) const fn decided(self) -> u32 {
        self.positive | self.negative
    }

    /// One bit for each pair of neighbours of opposite signs, both decided.
    #[inline]
    pub(crate) const fn changes(self) -> u32 {
        (self.positive & (self.negative >> 1)) | (self.negative & (self.positive >> 1))
    }

    /// Sign of coefficient i: −1, +1, or 0 if undecided.
    #[inline]
    pub(crate) const fn at(self, i: u32) -> i8 {
        ((self.positive >> i) & 1) as i8 - ((self.negative >> i) & 1) as i8
    }
}

/// What is taken to be known of the coefficients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Given {
    /// They are known up to the few roundings that computing them takes: less is not told apart.
    Rounded,
    /// They are known up to one rounding each.
    Once,
    /// They are these very numbers.
    Exactly,
    /// They are, and what is found is a theorem: pieces end just where they say.
    Provably,
}

/// A polynomial in Bernstein form on [lo, hi], 0 ≤ lo < hi, with the noise of its coefficients.
#[derive(Clone, Debug)]
pub(crate) struct Piece<S, const N: usize> {
    /// Bernstein coefficients times L.
    pub(crate) b: [S; N],
    /// Lower end.
    pub(crate) lo: S,
    /// Upper end.
    pub(crate) hi: S,
    /// Bound of the error of every coefficient.
    pub(crate) noise: S,
    /// What each halving adds to it.
    pub(crate) growth: S,
    /// Writing the polynomial anew would not help.
    pub(crate) settled: bool,
}

impl<S: Scalar, const N: usize> Piece<S, N> {
    /// p on [0, 1]; `weight` is Σ|aⱼ|.
    #[inline]
    pub(crate) fn unit(p: &Polynomial<S, N>, weight: &S) -> Self {
        let noise = Self::roundings(N + 1) * weight;
        let growth = Self::roundings(N) * weight;
        Self { b: on_unit(&p.coefficients), lo: S::zero(), hi: S::one(), noise, growth, settled: false }
    }

    /// p on [lo, hi], 0 ≤ lo < hi ≤ 2.
    pub(crate) fn seated(p: &Polynomial<S, N>, lo: S, hi: S, given: Given) -> Self {
        let width = hi.clone() - &lo;
        let mut q = if lo.is_zero() { p.coefficients.clone() } else { twofold::taylor(p, &lo).coefficients };
        let (mut power, mut local) = (S::one(), S::zero());
        for c in &mut q {
            *c = c.clone() * &power;
            local = local + &c.clone().abs();
            power = power * &width;
        }
        let magnitude = p.magnitude(&hi);
        let mut noise = Self::roundings(3 * N + 2) * &local;
        if !lo.is_zero() {
            noise = noise + &(Self::roundings(2) * &twofold::residue::<S, N>() * &magnitude);
        }
        match given {
            Given::Rounded => noise = noise + &(Self::roundings(N) * &magnitude),
            Given::Once => noise = noise + &(Self::roundings(1) * &magnitude),
            Given::Exactly | Given::Provably if twofold::is_in_range(&magnitude) => {}
            // nothing is certain
            Given::Exactly | Given::Provably => noise = S::infinity(),
        }
        let growth = Self::roundings(N) * &local;
        Self { b: on_unit(&q), lo, hi, noise, growth, settled: false }
    }

    /// p(hi) may be zero but for what [`super::ends`] allows; `weight` is Σ|aⱼ|hiʲ.
    #[inline]
    pub(crate) fn may_vanish_at_end(&self, weight: &S) -> bool {
        self.b[N - 1].clone().abs() <= Self::roundings(3 * N) * weight
    }

    /// k·u·L.
    #[inline]
    fn roundings(k: usize) -> S {
        let k = i32::try_from(k).unwrap_or(i32::MAX);
        S::unit_roundoff() * &(S::int(k) * &scale::<S, N>())
    }

    /// Cuts itself to its right half and `left`, a copy of it, to its left half; `false` if there is no number strictly between
    /// the ends. Where the middle is no number of the scalar coefficients are those of halves, and ends are rounded.
    #[inline]
    pub(crate) fn halve(&mut self, left: &mut Self) -> bool {
        let mid = S::midpoint(&self.lo, &self.hi);
        if !(self.lo < mid && mid < self.hi) {
            return false;
        }
        halve(&mut self.b, &mut left.b);
        self.noise = self.noise.clone() + &self.growth;
        left.noise = self.noise.clone();
        left.hi = mid.clone();
        self.lo = mid;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integer_factors() {
        assert_eq!(Binomials::<6>::FACTORS, [10, 2, 1, 1, 2, 10]);
        assert_eq!(Binomials::<5>::FACTORS, [12, 3, 2, 3, 12]);
        assert_eq!(Binomials::<1>::FACTORS, [1]);
        assert_eq!(Binomials::<16>::MULTIPLE, 45045);
    }

    #[test]
    fn basis_change_and_halving() {
        // t³: Bernstein coefficients 0, 0, 0, 1 (times L = 3)
        let b = on_unit(&[0.0_f64, 0.0, 0.0, 1.0]);
        assert_eq!(b, [0.0, 0.0, 0.0, 3.0]);
        let (mut l, mut r) = (b, b);
        halve(&mut r, &mut l);
        assert_eq!(l, [0.0, 0.0, 0.0, 0.375]);
        assert_eq!(r, [0.375, 0.75, 1.5, 3.0]);
        let p = Polynomial::new([0.0_f64, 0.0, 0.0, 1.0]);
        assert_eq!(Piece::seated(&p, 0.5, 1.0, Given::Rounded).b, r, "seated on the right half");
    }

    #[test]
    fn sign_patterns() {
        let s = Signs::of(&[1.0_f64, -1.0, 0.0, -2.0, 3.0], &0.5);
        assert_eq!(s.positive, 0b10001);
        assert_eq!(s.negative, 0b01010);
        assert_eq!(s.decided(), 0b11011);
        assert_eq!(s.changes(), 0b01001);
        assert_eq!((s.at(0), s.at(1), s.at(2)), (1, -1, 0));
        assert_eq!(Signs::full::<5>(), 0b11111);
    }
}
