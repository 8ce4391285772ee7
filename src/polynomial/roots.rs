//! The two interfaces: all real roots, and the roots in an interval.
//!
//! The isolator works on intervals 0 ≤ lo < hi of moderate size and needs p(0) ≠ 0. Everything else is brought there
//! exactly: zeros of the lowest coefficients are roots at 0 and are divided out; negative roots are those of p(−x);
//! roots beyond a [`border`] are reciprocals of those of the reversed polynomial in [1/hi, 1/border], where nothing can overflow
//! and where leading coefficients that vanish or nearly vanish are roots at or near t = 0, that is, x = ∞.

use super::bernstein::{Given, Piece};
use super::refine::search;
use super::{Polynomial, ends, twofold};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;
use core::array::from_fn;
use core::fmt;

/// Intervals up to here are searched directly, the rest through reciprocals. A root there would be found from both sides, and the noise
/// around a cluster would be cut in two: so it is the first of three numbers where p is well above its rounding errors, or the one where it
/// is most. They have few digits, so that [0, border] is halved exactly for long.
pub(super) fn border<S: Scalar, const N: usize>(p: &Polynomial<S, N>) -> S {
    let clear = S::one().mul_pow2(-(S::BITS / 4).cast_signed());
    let mut best = (S::one(), -S::one());
    for numerator in [1397, 1213, 1657] {
        let place = S::int(numerator).mul_pow2(-10);
        let share = p.eval(&place).abs() / &p.magnitude(&place);
        if share > best.1 {
            best = (place, share);
        }
        if best.1 >= clear {
            break;
        }
    }
    best.0
}

/// What is known about the roots in a bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RootKind {
    /// One root with a change of sign.
    Simple,
    /// p touches zero without a change of sign, within its rounding error: a double root, two roots closer than can be
    /// told, or a near miss.
    Even,
    /// A flat change of sign: a triple root, or three roots (of which two may be complex) closer than can be told.
    Odd,
    /// About this many roots, counted with multiplicity, closer to each other (or to an end of the interval asked for)
    /// than can be told.
    Cluster(u8),
}

impl RootKind {
    /// The number of roots with multiplicity, as far as known.
    #[inline]
    pub const fn multiplicity(self) -> u8 {
        match self {
            Self::Simple => 1,
            Self::Even => 2,
            Self::Odd => 3,
            Self::Cluster(k) => k,
        }
    }
}

/// A root or an indistinguishable group of roots; lower ≤ value ≤ upper.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root<S> {
    /// The root; for a group, its mean.
    pub value: S,
    /// Lower end of the bracket (an estimate by error bounds, cut to the isolating interval).
    pub lower: S,
    /// Upper end of the bracket.
    pub upper: S,
    /// One root or several.
    pub kind: RootKind,
}

/// Roots in ascending order, with disjoint brackets (they may share an end).
pub type Roots<S, const N: usize> = ArrayVec<Root<S>, N>;

/// Why there is no list of roots.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum RootsError {
    /// A coefficient is infinite or not a number: check the input.
    NotFinite,
    /// All coefficients are zero: every number is a root. Not a mistake, an answer.
    ZeroPolynomial,
    /// The interval is empty, reversed, or its ends are not finite: pass lo < hi.
    BadInterval,
}

impl fmt::Display for RootsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::NotFinite => "a coefficient of the polynomial is infinite or not a number",
            Self::ZeroPolynomial => "the polynomial is zero: every number is a root",
            Self::BadInterval => "the interval for the roots is empty or not finite",
        })
    }
}

impl core::error::Error for RootsError {}

impl<S: Scalar, const N: usize> Polynomial<S, N> {
    /// The roots in [0, 1], ascending.
    ///
    /// Roots at the ends belong to it; at 1, one that is outside by no more than rounding error is reported too.
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`].
    #[inline]
    pub fn roots_in_unit(&self) -> Result<Roots<S, N>, RootsError> {
        self.roots_in_unit_within(&S::zero())
    }

    /// [`Self::roots_in_unit`] for those who need no more than brackets of a given width relative to the root.
    ///
    /// A simple root x has a bracket of `width`·|x| around its value, where that stays clear of other roots and of the ends
    /// and plain evaluations are good enough for it; otherwise, and with a width of 0, the narrowest. Everything else is
    /// the same. With 1e-12 in `f64` this takes about a tenth less time (`cargo bench --bench race`).
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`].
    #[inline]
    pub fn roots_in_unit_within(&self, width: &S) -> Result<Roots<S, N>, RootsError> {
        let weight = self.weight();
        if Self::is_comfortable(&weight) && !self.coefficients[0].is_zero() {
            let mut roots = Roots::new();
            let piece = Piece::unit(self, &weight);
            let at_end = piece.may_vanish_at_end(&weight);
            search(self, piece, Given::Rounded, width, &mut roots);
            if at_end {
                ends::check_inside(self, &S::one(), false, &mut roots);
            }
            return Ok(roots);
        }
        self.roots_inside(&S::zero(), &S::one(), width)
    }

    /// [`Polynomial::roots_between_within`] for 0 ≤ lo < hi ≤ 1, without what negative numbers and reciprocals take: a program that
    /// asks for no other roots is a good deal smaller.
    #[cold]
    pub(crate) fn roots_inside(&self, lo: &S, hi: &S, width: &S) -> Result<Roots<S, N>, RootsError> {
        if !(S::zero() <= *lo && lo < hi && *hi <= S::one()) {
            return Err(RootsError::BadInterval);
        }
        let (p, zeros) = self.prepared()?.without_zeros();
        let mut roots = Roots::new();
        if lo.is_zero() {
            push_zero(zeros, &mut roots);
        }
        let piece = Piece::seated(&p, lo.clone(), hi.clone(), Given::Rounded);
        search(&p, piece, Given::Rounded, width, &mut roots);
        ends::check_inside(&p, lo, true, &mut roots);
        ends::check_inside(&p, hi, false, &mut roots);
        Ok(roots)
    }

    /// The roots in [lo, hi], ascending.
    ///
    /// Roots at the ends belong to it, and so do roots beyond an end by no more than rounding error (then the value is
    /// that end).
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`], [`RootsError::BadInterval`].
    #[inline]
    pub fn roots_between(&self, lo: &S, hi: &S) -> Result<Roots<S, N>, RootsError> {
        self.roots_between_within(lo, hi, &S::zero())
    }

    /// [`Self::roots_between`] with brackets of a relative width: see [`Self::roots_in_unit_within`].
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`], [`RootsError::BadInterval`].
    #[cold]
    pub fn roots_between_within(&self, lo: &S, hi: &S, width: &S) -> Result<Roots<S, N>, RootsError> {
        if !(lo.is_finite() && hi.is_finite() && lo < hi) {
            return Err(RootsError::BadInterval);
        }
        let p = self.prepared()?;
        let mut roots = p.search_line(lo, hi, width);
        let (p, _) = p.without_zeros();
        ends::check(&p, lo, true, &mut roots);
        ends::check(&p, hi, false, &mut roots);
        Ok(roots)
    }

    /// All real roots, ascending. A root whose value exceeds the range of the scalar is left out. Brackets lie inside
    /// [−R, R], R = [`Polynomial::root_bound`].
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`].
    #[inline]
    pub fn real_roots(&self) -> Result<Roots<S, N>, RootsError> {
        self.real_roots_within(&S::zero())
    }

    /// [`Self::real_roots`] with brackets of a relative width w: see [`Self::roots_in_unit_within`]; beyond 1, where they are
    /// reciprocals of such, up to w/(1 − w²/4).
    ///
    /// # Errors
    /// [`RootsError::NotFinite`], [`RootsError::ZeroPolynomial`].
    pub fn real_roots_within(&self, width: &S) -> Result<Roots<S, N>, RootsError> {
        let p = self.prepared()?;
        Ok(match p.root_bound() {
            Some(_) => p.search_line(&-S::infinity(), &S::infinity(), width),
            None => Roots::new(),
        })
    }

    /// Checked and scaled.
    pub(super) fn prepared(&self) -> Result<Self, RootsError> {
        if !self.coefficients.iter().all(S::is_finite) {
            return Err(RootsError::NotFinite);
        }
        if self.degree().is_none() {
            return Err(RootsError::ZeroPolynomial);
        }
        Ok(self.normalised())
    }

    /// Divided by the highest power of x that divides it, and the exponent.
    pub(super) fn without_zeros(&self) -> (Self, usize) {
        let zeros = self.coefficients.iter().take_while(|c| c.is_zero()).count();
        let shifted = from_fn(|j| self.coefficients.get(j + zeros).cloned().unwrap_or_else(S::zero));
        (Self::new(shifted), zeros)
    }

    /// Roots in [lo, hi], ends may be infinite; coefficients of comfortable size.
    fn search_line(&self, lo: &S, hi: &S, width: &S) -> Roots<S, N> {
        let zero = S::zero();
        let (p, zeros) = self.without_zeros();
        let mut roots = Roots::new();
        if *lo < zero {
            let mut negative = Roots::new();
            let end = if *hi < zero { -hi.clone() } else { zero.clone() };
            search_positive(&p.mirrored(), (end, -lo.clone()), width, &mut negative);
            for r in negative.into_iter().rev() {
                push(&mut roots, Root { value: -r.value, lower: -r.upper, upper: -r.lower, kind: r.kind });
            }
        }
        if *lo <= zero && zero <= *hi {
            push_zero(zeros, &mut roots);
        }
        if *hi > zero {
            search_positive(&p, (lo.clone().max(zero), hi.clone()), width, &mut roots);
        }
        roots
    }
}

/// Appends the root 0 of a polynomial that x divides so many times.
fn push_zero<S: Scalar, const N: usize>(times: usize, roots: &mut Roots<S, N>) {
    let kind = match times {
        0 => return,
        1 => RootKind::Simple,
        2 => RootKind::Even,
        3 => RootKind::Odd,
        k => RootKind::Cluster(u8::try_from(k).unwrap_or(u8::MAX)),
    };
    push(roots, Root { value: S::zero(), lower: S::zero(), upper: S::zero(), kind });
}

/// Appends the roots in [lo, hi], 0 ≤ lo < hi ≤ ∞, p(0) ≠ 0.
fn search_positive<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    (lo, hi): (S, S),
    width: &S,
    roots: &mut Roots<S, N>,
) {
    if hi <= S::one() || hi <= border(p) {
        search(p, Piece::seated(p, lo, hi, Given::Rounded), Given::Rounded, width, roots);
    } else {
        search_beyond(p, (lo, hi), width, roots);
    }
}

/// The same where reciprocals are needed. A call of its own, so that its lists do not lie on the stack where they are not.
#[inline(never)]
fn search_beyond<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    (lo, hi): (S, S),
    width: &S,
    roots: &mut Roots<S, N>,
) {
    let (border, one) = (border(p), S::one());
    let mut near = Roots::new();
    if lo < border {
        search(p, Piece::seated(p, lo.clone(), border.clone(), Given::Rounded), Given::Rounded, width, &mut near);
    }
    let (reversed, _) = p.reversed().without_zeros();
    // rounded outwards: what this adds is cut off again
    let nudge = S::unit_roundoff().mul_pow2(2);
    let nearest = (nudge.clone() + &one) / &lo.clone().max(border.clone());
    let farthest = if hi.is_finite() { (one.clone() - &nudge) / &hi } else { S::zero() };
    let mut far = Roots::new();
    if farthest < nearest {
        let piece = Piece::seated(&reversed, farthest, nearest, Given::Rounded);
        search(&reversed, piece, Given::Rounded, width, &mut far);
    }
    let reciprocal = |t: &S| (one.clone() / t).clamp(lo.clone(), hi.clone());
    let mut far = far.into_iter().rev().filter(|r| !r.value.is_zero()).map(|r| Root {
        value: reciprocal(&r.value),
        lower: reciprocal(&r.upper),
        upper: if r.lower.is_zero() { hi.clone() } else { reciprocal(&r.lower) },
        kind: r.kind,
    });
    // a root at the border, found from both sides, is one root
    let mut first_far = far.next();
    if let (Some(left), Some(right)) = (near.last_mut(), &first_far)
        && left.upper >= border
        && right.lower <= border
    {
        *left = joined(p, left, right);
        first_far = None;
    }
    for r in near.into_iter().chain(first_far).chain(far) {
        if r.value.is_finite() {
            push(roots, r);
        }
    }
}

/// Two findings that meet at the boundary between two searches.
///
/// Two simple ones are one root seen from both sides if p changes its sign from end to end of both; then the value that
/// p is smaller at is the better one (the other may be cut at the boundary).
fn joined<S: Scalar, const N: usize>(p: &Polynomial<S, N>, left: &Root<S>, right: &Root<S>) -> Root<S> {
    let (lower, upper) = (left.lower.clone(), right.upper.clone());
    let size = |x: &S| p.eval(x).abs();
    let simple = left.kind == RootKind::Simple && right.kind == RootKind::Simple;
    // Beside a cluster plain values are noise.
    let is_above = |x: &S| twofold::value(p, x) > S::zero();
    let crosses = is_above(&lower) != is_above(&upper);
    if simple && crosses {
        let value = if size(&left.value) <= size(&right.value) { &left.value } else { &right.value };
        return Root { value: value.clone(), lower, upper, kind: RootKind::Simple };
    }
    // two simple roots make two; of clusters cut in two the larger part, and the parity that the ends show
    let parts = [left, right].map(|root| root.kind.multiplicity());
    let most = if simple { 2 } else { parts[0].max(parts[1]) };
    let kind = match most.saturating_add(u8::from((most % 2 == 1) != crosses)) {
        2 => RootKind::Even,
        3 => RootKind::Odd,
        k => RootKind::Cluster(k),
    };
    Root { value: S::midpoint(&left.value, &right.value), lower, upper, kind }
}

/// Appends; there are never more roots than coefficients, and if noise made it so, the last bracket grows.
#[inline]
pub(super) fn push<S: Scalar, const N: usize>(roots: &mut Roots<S, N>, root: Root<S>) {
    if let Err(full) = roots.try_push(root)
        && let Some(last) = roots.last_mut()
    {
        last.upper = full.element().upper;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inside_the_unit_interval_both_ways_are_one() {
        let polynomials = [
            [0.0_f32, 0.0, 1.0, -3.0, 2.0, 0.0],
            [-0.25, 1.0, -1.0, 0.0, 0.0, 0.0],
            [1.0e-30, -3.0e-30, 2.0e-30, 0.0, 0.0, 0.0],
            [-0.03, 0.61, -2.7, 4.1, -1.98, 0.0],
            [0.0, -1.0, 1.0, 0.0, 0.0, 0.0],
            [-1.0, 1.0, -1.0, 1.0, -1.0, 1.0],
            [0.0; 6],
            [f32::NAN; 6],
        ];
        for p in polynomials.map(Polynomial::new) {
            for [lo, hi] in [[0.0, 1.0], [0.0, 0.5], [0.5, 1.0], [0.25, 0.75], [0.3, 0.3], [0.5, f32::NAN]] {
                assert_eq!(p.roots_inside(&lo, &hi, &0.0), p.roots_between(&lo, &hi), "{p:?} in [{lo}, {hi}]");
            }
        }
        let line = Polynomial::new([-1.5_f32, 1.0]);
        assert_eq!(line.roots_inside(&0.0, &2.0, &0.0), Err(RootsError::BadInterval), "beyond its range");
    }
}
