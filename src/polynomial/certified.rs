//! Roots with proofs.
//!
//! The answers of [`Polynomial::certified_in_unit`] and its siblings are theorems about the polynomial whose coefficients
//! *are* the given numbers, proved in the scalar's own arithmetic rounded to nearest, without touching a rounding mode:
//!
//! * **no root outside of the brackets**: every other stretch of the interval was excluded by Bernstein coefficients of one
//!   sign, each farther from 0 than the proved bound of its error (`bernstein`, "Rounding");
//! * **[`Holds::One`], exactly one root, simple**: an enclosing stretch has Bernstein coefficients with exactly one sign
//!   variation, whatever the signs of those that are not certain; so it holds exactly one root (Lane and Riesenfeld 1981). At
//!   the ends of the bracket the values, computed with error-free transformations, exceed the proved bound of their error
//!   (`twofold`) and have opposite signs; so that root is in the bracket;
//! * **[`Holds::Odd`] and [`Holds::Even`]**: the signs of p at both ends are certain, nothing else is. Beside multiple roots this
//!   is said of simple ones too, where they are closer than the noise or exactly where a piece was halved.
//!
//! Noise here comes from arithmetic alone. It falls with the size of the piece down to about 16N²u²·Σ|aⱼ||x|ʲ, so roots are
//! separated and proved that no answer can tell which takes coefficients to be known up to a rounding. What can not be proved in
//! floating point at all is that a polynomial *has* a multiple root; such a bracket keeps its parity, at a width of about
//! the square of that attainable with coefficients rounded once. `feature_sampling` has no integers of any size: `fsample roots
//! --certified` settles these by Sturm's theorem.
//!
//! Reciprocals (roots beyond the border) are rounded outwards by four units. Where scaling or underflow would make a
//! coefficient inexact the answer is one bracket, the whole interval, about which nothing is said.

use super::bernstein::{Given, Piece};
use super::isolate::{Found, Isolated, has_no_root, isolate};
use super::refine::crossing;
use super::roots::{RootsError, border};
use super::{Polynomial, twofold};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Attempts to widen a bracket until the signs at its ends are certain.
const ATTEMPTS: usize = 12;

/// What is proved about the roots in a bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// Exactly one root, and it is simple.
    One,
    /// An odd number of roots, counted with multiplicity: at least one.
    Odd,
    /// An even number of roots, counted with multiplicity: perhaps none.
    Even,
    /// Nothing.
    Unknown,
}

impl Holds {
    /// What is known of two brackets together, each with roots of its own.
    const fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::Unknown, _) | (_, Self::Unknown) => Self::Unknown,
            (Self::Even, Self::Even) | (Self::One | Self::Odd, Self::One | Self::Odd) => Self::Even,
            _ => Self::Odd,
        }
    }
}

/// A bracket with what is proved about it; lower ≤ value ≤ upper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certified<S> {
    /// The best guess of a root in it.
    pub value: S,
    /// Lower end.
    pub lower: S,
    /// Upper end.
    pub upper: S,
    /// The proved.
    pub holds: Holds,
}

/// Brackets in ascending order, disjoint but for common ends; outside of them there is no root.
pub type CertifiedRoots<S, const N: usize> = ArrayVec<Certified<S>, N>;

impl<S: Scalar, const N: usize> Polynomial<S, N> {
    /// All roots in [0, 1], proved; see [`Polynomial::certified_between`].
    ///
    /// ```
    /// use feature_sampling::polynomial::{Holds, Polynomial};
    /// // (x − 1/4)(x − 3/4)(x + 2), times 16
    /// let roots = Polynomial::new([6.0_f64, -29.0, 16.0, 16.0]).certified_in_unit()?;
    /// assert_eq!(roots.len(), 2);
    /// assert!(roots.iter().all(|root| root.holds == Holds::One && root.upper - root.lower < 1e-15));
    /// // (x − 1/4)² can not be told from a near miss: 0 or 2 roots
    /// let touching = Polynomial::new([1.0_f64, -8.0, 16.0]).certified_in_unit()?;
    /// assert_eq!(touching.len(), 1);
    /// assert_eq!(touching[0].holds, Holds::Even);
    /// # Ok::<(), feature_sampling::polynomial::RootsError>(())
    /// ```
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`].
    #[inline]
    pub fn certified_in_unit(&self) -> Result<CertifiedRoots<S, N>, RootsError> {
        // Most polynomials without roots show it at once.
        let weight = self.weight();
        if Self::is_comfortable(&weight) && has_no_root(&Piece::unit(self, &weight)) {
            return Ok(CertifiedRoots::new());
        }
        self.certified_between(&S::zero(), &S::one())
    }

    /// All roots in [lo, hi], proved. A bracket reaches beyond an end of the interval only where its root can not be told
    /// from that end.
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`], [`RootsError::BadInterval`].
    pub fn certified_between(&self, lo: &S, hi: &S) -> Result<CertifiedRoots<S, N>, RootsError> {
        if !(lo.is_finite() && hi.is_finite() && lo < hi) {
            return Err(RootsError::BadInterval);
        }
        let p = self.prepared()?;
        if !p.is_scaled_exactly(self) {
            return Ok(unknown(lo, hi));
        }
        // An end is an ordinary place to have a root: look a little beyond. Half as many digits halve exactly for longer.
        let beyond = |x: &S| x.clone().abs().mul_pow2(2 - (S::BITS / 2).cast_signed());
        let (from, to) = (lo.clone() - &beyond(lo), hi.clone() + &beyond(hi));
        let mut roots = p.certified_line(&twofold::half_the_digits(from), &twofold::half_the_digits(to));
        roots.retain(|root| p.cut(root, lo, hi));
        Ok(roots)
    }

    /// All real roots whose modulus is in the range of the scalar, proved.
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`].
    pub fn certified_real_roots(&self) -> Result<CertifiedRoots<S, N>, RootsError> {
        let p = self.prepared()?;
        let Some(bound) = p.root_bound() else { return Ok(CertifiedRoots::new()) };
        if !p.is_scaled_exactly(self) {
            return Ok(unknown(&-bound.clone(), &bound));
        }
        Ok(p.certified_line(&-S::infinity(), &S::infinity()))
    }

    /// No coefficient lost a digit when it was scaled to this.
    fn is_scaled_exactly(&self, original: &Self) -> bool {
        self.coefficients.iter().zip(&original.coefficients).all(|(scaled, c)| {
            if c.is_zero() {
                scaled.is_zero()
            } else {
                !scaled.is_zero() && twofold::is_in_range(&scaled.clone().abs())
            }
        })
    }

    /// Cuts a bracket at the ends of the interval asked for; `false` if its root is outside.
    fn cut(&self, root: &mut Certified<S>, lo: &S, hi: &S) -> bool {
        if root.upper < *lo || root.lower > *hi {
            return false;
        }
        let is_one = root.holds == Holds::One;
        if root.upper > *hi && is_one {
            let at_end = twofold::sign(self, hi);
            if at_end != 0 && at_end == twofold::sign(self, &root.lower) {
                return false;
            }
            if at_end != 0 && at_end == twofold::sign(self, &root.upper) {
                root.upper = hi.clone();
            }
        }
        if root.lower < *lo && is_one {
            let at_end = twofold::sign(self, lo);
            if at_end != 0 && at_end == twofold::sign(self, &root.upper) {
                return false;
            }
            if at_end != 0 && at_end == twofold::sign(self, &root.lower) {
                root.lower = lo.clone();
            }
        }
        root.value = root.value.clone().clamp(root.lower.clone(), root.upper.clone());
        true
    }

    /// Roots in [lo, hi], ends may be infinite; scaled coefficients.
    fn certified_line(&self, lo: &S, hi: &S) -> CertifiedRoots<S, N> {
        let zero = S::zero();
        // Roots at 0 are exact. The others are those of p/xᵏ, and what is proved about these must not have 0 in it.
        let (p, zeros) = self.without_zeros();
        let mut roots = CertifiedRoots::new();
        if *lo < zero {
            let end = if *hi < zero { -hi.clone() } else { zero.clone() };
            let mirrored = p.mirrored();
            for mut r in mirrored.certified_positive(&end, &-lo.clone()).into_iter().rev() {
                if zeros > 0 {
                    mirrored.leave_zero(&mut r);
                }
                push(&mut roots, Certified { value: -r.value, lower: -r.upper, upper: -r.lower, holds: r.holds });
            }
        }
        if zeros > 0 && *lo <= zero && zero <= *hi {
            let holds = match zeros {
                1 => Holds::One,
                k if k % 2 == 1 => Holds::Odd,
                _ => Holds::Even,
            };
            let at_zero = Certified { value: zero.clone(), lower: zero.clone(), upper: zero.clone(), holds };
            match roots.last_mut() {
                Some(last) if last.upper.is_zero() => last.absorb(at_zero),
                _ => push(&mut roots, at_zero),
            }
        }
        if *hi > zero {
            for mut r in p.certified_positive(&lo.clone().max(zero), hi) {
                if zeros > 0 {
                    p.leave_zero(&mut r);
                    if r.lower.is_zero()
                        && let Some(last) = roots.last_mut()
                    {
                        last.absorb(r);
                        continue;
                    }
                }
                push(&mut roots, r);
            }
        }
        roots
    }

    /// Narrows a bracket of one root that begins at 0, where p(0) ≠ 0: up to a place where p has the sign of p(0) there is none.
    fn leave_zero(&self, root: &mut Certified<S>) {
        if !(root.lower.is_zero() && root.holds == Holds::One) {
            return;
        }
        let (mut place, at_zero) = (root.value.clone(), twofold::sign(self, &S::zero()));
        for _ in 0..ATTEMPTS {
            place = place.mul_pow2(-1);
            if at_zero != 0 && place > S::zero() && twofold::sign(self, &place) == at_zero {
                root.lower = place;
                return;
            }
        }
    }

    /// Roots in [lo, hi], 0 ≤ lo < hi ≤ ∞, p(0) ≠ 0.
    fn certified_positive(&self, lo: &S, hi: &S) -> CertifiedRoots<S, N> {
        let border = border(self);
        let mut roots = CertifiedRoots::new();
        if *lo < border {
            self.prove(lo.clone(), hi.clone().min(border.clone()), &mut roots);
        }
        if *hi <= border {
            return roots;
        }
        let (reversed, _) = self.reversed().without_zeros();
        let nudge = S::unit_roundoff().mul_pow2(2);
        let (less, more) = (S::one() - &nudge, S::one() + &nudge);
        let wide = S::one().mul_pow2(2 - (S::BITS / 2).cast_signed());
        let farthest = if hi.is_finite() { (S::one() - &wide) / hi } else { S::zero() };
        let nearest = (S::one() + &wide) / &lo.clone().max(border.clone());
        let mut far = CertifiedRoots::new();
        reversed.prove(twofold::half_the_digits(farthest), twofold::half_the_digits(nearest), &mut far);
        let bound = self.root_bound().unwrap_or_else(S::infinity);
        for r in far.into_iter().rev() {
            let lower = less.clone() / &r.upper;
            if !lower.is_finite() {
                continue;
            }
            let upper = if r.lower.is_zero() { bound.clone() } else { more.clone() / &r.lower };
            let value = (S::one() / &r.value).clamp(lower.clone(), upper.clone());
            // At the border from both sides, perhaps the same: once more, on all these brackets together.
            let (mut from, mut to) = (lower.clone(), upper.clone());
            let known = roots.len();
            while let Some(last) = roots.last().filter(|last| last.upper >= from).cloned() {
                from = from.min(last.lower);
                to = to.max(last.upper);
                roots.pop();
            }
            if roots.len() < known {
                self.prove(from, to, &mut roots);
            } else {
                push(&mut roots, Certified { value, lower, upper, holds: r.holds });
            }
        }
        roots
    }

    /// Appends what is proved about [lo, hi], 0 ≤ lo < hi, p(0) ≠ 0.
    fn prove(&self, lo: S, hi: S, roots: &mut CertifiedRoots<S, N>) {
        let first = Piece::seated(self, lo, hi, Given::Provably);
        isolate(self, first, Given::Provably, |isolated| push(roots, self.proved(isolated)));
    }

    /// The bracket of an isolated root, narrowed as far as signs are certain.
    fn proved(&self, isolated: Isolated<S>) -> Certified<S> {
        let Isolated { lower, upper, before, after, found } = isolated;
        let Found::One(start) = found else {
            let holds = match (before, after) {
                (0, _) | (_, 0) => Holds::Unknown,
                (a, b) if a == b => Holds::Even,
                _ => Holds::Odd,
            };
            return Certified { value: S::midpoint(&lower, &upper), lower, upper, holds };
        };
        let narrow = crossing(self, (lower.clone(), upper.clone()), after > 0, start, &S::zero());
        let (mut below, mut above) = (narrow.value.clone() - &narrow.lower, narrow.upper.clone() - &narrow.value);
        let (mut from, mut to) = (narrow.lower, narrow.upper);
        for _ in 0..ATTEMPTS {
            if from == lower || twofold::sign(self, &from) == before {
                break;
            }
            below = below.mul_pow2(2);
            from = (narrow.value.clone() - &below).max(lower.clone());
        }
        for _ in 0..ATTEMPTS {
            if to == upper || twofold::sign(self, &to) == after {
                break;
            }
            above = above.mul_pow2(2);
            to = (narrow.value.clone() + &above).min(upper.clone());
        }
        if from != lower && twofold::sign(self, &from) != before {
            from = lower;
        }
        if to != upper && twofold::sign(self, &to) != after {
            to = upper;
        }
        Certified { value: narrow.value, lower: from, upper: to, holds: Holds::One }
    }
}

impl<S: Scalar> Certified<S> {
    /// Takes in the next bracket, which begins where this one ends, at 0, one of the roots.
    fn absorb(&mut self, next: Self) {
        self.value = S::zero();
        self.upper = next.upper;
        self.holds = self.holds.and(next.holds);
    }
}

/// One bracket about which nothing is known.
fn unknown<S: Scalar, const N: usize>(lo: &S, hi: &S) -> CertifiedRoots<S, N> {
    let mut roots = CertifiedRoots::new();
    let value = S::midpoint(lo, hi);
    push(&mut roots, Certified { value, lower: lo.clone(), upper: hi.clone(), holds: Holds::Unknown });
    roots
}

/// Appends; where there is no room the last bracket grows and says nothing any more.
fn push<S: Scalar, const N: usize>(roots: &mut CertifiedRoots<S, N>, root: Certified<S>) {
    if let Err(full) = roots.try_push(root)
        && let Some(last) = roots.last_mut()
    {
        last.upper = full.element().upper;
        last.holds = Holds::Unknown;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_everywhere_and_at_the_ends() {
        // (x + 3)(x − 1)(x − 1024), roots beyond the border and at an end of [0, 1]
        let p = Polynomial::new([3072.0_f64, -2051.0, -1022.0, 1.0]);
        let all = p.certified_real_roots().expect("finite");
        for (root, truth) in all.iter().zip([-3.0, 1.0, 1024.0]) {
            assert_eq!(root.holds, Holds::One, "{root:?}");
            assert!(
                root.lower <= truth && truth <= root.upper && root.upper - root.lower < 1e-14 * truth.abs(),
                "{root:?}"
            );
        }
        assert_eq!(all.len(), 3);
        let unit = p.certified_in_unit().expect("finite");
        assert_eq!((unit.len(), unit[0].holds), (1, Holds::One));
        assert!(unit[0].lower <= 1.0 && unit[0].upper >= 1.0, "{unit:?}");
        assert!(p.certified_between(&1.001, &1023.9).expect("finite").is_empty());
    }

    #[test]
    fn closer_than_coefficients_rounded_once_could_tell() {
        // two roots 2e-8 apart about ½, and none
        let p = Polynomial::new([0.25_f64, -1.0, 1.0]);
        assert_eq!(p.certified_in_unit().expect("finite")[0].holds, Holds::Even, "a double root");
        let apart = Polynomial::new([0.25 - 3.0 * 2.0_f64.powi(-55), -1.0, 1.0]).certified_in_unit().expect("finite");
        assert_eq!(apart.iter().map(|r| r.holds).collect::<ArrayVec<_, 3>>().as_slice(), [Holds::One, Holds::One]);
        let above = Polynomial::new([0.25 + 2.0_f64.powi(-54), -1.0, 1.0]).certified_in_unit().expect("finite");
        assert!(above.is_empty(), "a near miss is proved to be none: {above:?}");
    }

    #[test]
    fn what_can_not_be_scaled_is_not_answered() {
        let p = Polynomial::new([1e-320_f64, 1.0, 1e300]);
        let answer = p.certified_in_unit().expect("finite");
        assert_eq!((answer.len(), answer[0].holds), (1, Holds::Unknown));
        assert_eq!(Polynomial::new([0.0_f64; 3]).certified_real_roots(), Err(RootsError::ZeroPolynomial));
        assert!(Polynomial::new([2.0_f64, 0.0]).certified_real_roots().expect("finite").is_empty(), "a constant");
    }

    #[test]
    fn brackets_that_end_at_a_root_at_0() {
        // x(x − 1)(x + 2⁻³⁰), and what is said where a bracket cannot be shortened
        let p = Polynomial::new([0.0_f64, -(2.0_f64.powi(-30)), 2.0_f64.powi(-30) - 1.0, 1.0]);
        let roots = p.certified_real_roots().expect("finite");
        assert!(roots.iter().all(|r| r.holds == Holds::One) && roots.len() == 3, "{roots:?}");
        assert!(roots[0].upper < 0.0 && roots[1].lower == 0.0 && roots[1].upper == 0.0, "{roots:?}");
        let bracket = |lower: f64, upper: f64, holds| Certified { value: upper, lower, upper, holds };
        let parity = |a, b| {
            let mut both = bracket(-1.0, 0.0, a);
            both.absorb(bracket(0.0, 2.0, b));
            assert_eq!((both.lower, both.value, both.upper), (-1.0, 0.0, 2.0));
            both.holds
        };
        assert_eq!((parity(Holds::One, Holds::One), parity(Holds::One, Holds::Odd)), (Holds::Even, Holds::Even));
        assert_eq!((parity(Holds::Even, Holds::Even), parity(Holds::Even, Holds::One)), (Holds::Even, Holds::Odd));
        assert_eq!(
            (parity(Holds::Unknown, Holds::One), parity(Holds::Odd, Holds::Unknown)),
            (Holds::Unknown, Holds::Unknown)
        );
    }

    /// Two roots 2e-15 apart in an interval whose middles have to be rounded after 26 halvings: brackets have opposite signs at their ends
    /// all the same.
    #[test]
    fn a_bracket_is_where_its_piece_is() {
        let p = Polynomial::new([0.24969488382342317_f64, -31.941421508790878, 1020.2514648437499, 79.9375, 1.0]);
        let mut roots = CertifiedRoots::new();
        p.prove(0.0, 0.0625 * (1.0 + 2.0_f64.powi(-26)), &mut roots);
        assert_eq!(roots.len(), 2, "{roots:?}");
        for root in roots {
            let signs = [&root.lower, &root.upper].map(|end| twofold::sign(&p, end));
            assert!(matches!(root.holds, Holds::One | Holds::Odd) && signs[0] * signs[1] < 0, "{root:?}: {signs:?}");
        }
    }

    #[test]
    fn single_precision() {
        let p = Polynomial::new([-0.25_f32, 1.0, -0.5, 2.0]);
        let roots = p.certified_in_unit().expect("finite");
        assert_eq!((roots.len(), roots[0].holds), (1, Holds::One));
        assert!(roots[0].upper - roots[0].lower <= 4.0 * f32::EPSILON * roots[0].value, "{roots:?}");
    }
}
