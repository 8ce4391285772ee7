//! The Bernstein form on an interval: change of basis, halving, sign patterns.
//!
//! On [lo, hi] with x = lo + (hi − lo)s, p(x) = L⁻¹ Σ bᵢ C(n,i) sⁱ(1−s)ⁿ⁻ⁱ. The bᵢ are kept *times L*, the least common
//! multiple of the binomial coefficients C(n,0…n): then bᵢ = Σ_{j≤i} C(i,j) (L/C(n,j)) qⱼ holds integers only (qⱼ:
//! coefficients in s), needs no division, and signs, the only thing asked of them, stay the same. With b₀ = L·p(lo) and
//! bₙ = L·p(hi), the curve lies in the hull of its coefficients, and the number of sign variations bounds the number of
//! roots inside, with equal parity (Lane and Riesenfeld 1981).
//!
//! **Rounding.** The change of basis errs by at most (n+2)u per unit of Σ|bᵢ's terms| ≤ L·Σ|aⱼ|; halving averages, and
//! each of n levels rounds once, in proportion to coefficients which shrink with the piece. The bound carried along is
//! 2N·u·L·Σ|aⱼ|reachʲ (twice that after a shift of the origin), with reach = the interval's end farther from 0; it also
//! covers a rounding of every input coefficient, since p is taken to be known no better.

use super::Polynomial;
use super::eval::descend;
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

/// The coefficients of both halves, by de Casteljau's scheme at ½.
#[inline]
pub(crate) fn halve<S: Scalar, const N: usize>(b: [S; N]) -> ([S; N], [S; N]) {
    let mut right = b;
    let left = from_fn(|k| {
        let first = right[0].clone();
        for i in 0..N - 1 - k {
            let sum = right[i].clone() + &right[i + 1];
            right[i] = sum.half();
        }
        first
    });
    (left, right)
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
    /// The upper end of the interval the noise was computed for.
    pub(crate) reach: S,
}

impl<S: Scalar, const N: usize> Piece<S, N> {
    /// p on [0, 1]; `weight` is Σ|aⱼ|.
    #[inline]
    pub(crate) fn unit(p: &Polynomial<S, N>, weight: &S) -> Self {
        let noise = Self::noise_per_weight() * weight;
        Self { b: on_unit(&p.coefficients), lo: S::zero(), hi: S::one(), noise, reach: S::one() }
    }

    /// p on [lo, hi], 0 ≤ lo < hi.
    pub(crate) fn seated(p: &Polynomial<S, N>, lo: S, hi: S) -> Self {
        let noise = Self::noise_per_weight().twice() * &p.magnitude(&hi);
        Self { b: on_interval(p, &lo, &hi), lo, hi: hi.clone(), noise, reach: hi }
    }

    /// All coefficients are beyond the noise on one side: no root.
    #[inline]
    pub(crate) fn excludes_zero(&self) -> bool {
        let signs = Signs::of(&self.b, &self.noise);
        signs.positive == Signs::full::<N>() || signs.negative == Signs::full::<N>()
    }

    /// 2N·u·L.
    #[inline]
    fn noise_per_weight() -> S {
        let n = i32::try_from(2 * N).unwrap_or(i32::MAX);
        S::unit_roundoff() * &(S::int(n) * &scale::<S, N>())
    }

    /// Both halves; `None` if there is no number strictly between the ends.
    #[inline]
    pub(crate) fn halves(self) -> Result<(Self, Self), Self> {
        let mid = S::midpoint(&self.lo, &self.hi);
        if !(self.lo < mid && mid < self.hi) {
            return Err(self);
        }
        let (l, r) = halve(self.b);
        Ok((
            Self { b: l, lo: self.lo, hi: mid.clone(), noise: self.noise.clone(), reach: self.reach.clone() },
            Self { b: r, lo: mid, hi: self.hi, noise: self.noise, reach: self.reach },
        ))
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
        let (l, r) = halve(b);
        assert_eq!(l, [0.0, 0.0, 0.0, 0.375]);
        assert_eq!(r, [0.375, 0.75, 1.5, 3.0]);
        let p = Polynomial::new([0.0_f64, 0.0, 0.0, 1.0]);
        assert_eq!(Piece::seated(&p, 0.5, 1.0).b, r, "seated on the right half");
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
