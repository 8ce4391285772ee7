//! Sturm's theorem (1829): the exact number of roots in an interval.
//!
//! For a square-free p let p₀ = p, p₁ = p', pᵢ₊₁ = −(remainder of pᵢ₋₁ by pᵢ). With V(x) the number of sign changes in
//! p₀(x), p₁(x), …, zeros left out, the number of roots in (a, b] is V(a) − V(b). Remainders are taken up to positive
//! factors, over the integers; a polynomial that is not square-free is first divided by its greatest common divisor with p'.

use crate::dyadic::Dyadic;
use crate::exact::Exact;

/// The chain of a polynomial that is not zero.
#[derive(Clone, Debug)]
pub struct Sturm {
    chain: Vec<Exact>,
    /// The polynomial has multiple roots (real or not).
    repeated: bool,
}

impl Sturm {
    /// The chain of the square-free part of p.
    pub fn new(p: &Exact) -> Self {
        let mut chain = vec![p.clone().primitive()];
        let mut next = p.derivative().primitive();
        while next.degree().is_some() {
            let rest = chain.last().map(|last| last.remainder(&next).primitive().negated());
            chain.push(std::mem::replace(&mut next, rest.unwrap_or_else(|| Exact::new(Vec::new(), 0))));
        }
        let repeated = chain.last().is_some_and(|common| common.degree().unwrap_or(0) > 0);
        if repeated && let Some(common) = chain.last().cloned() {
            for member in &mut chain {
                *member = member.quotient(&common);
            }
        }
        Self { chain, repeated }
    }

    /// The polynomial has a multiple root, real or complex.
    pub const fn has_repeated_roots(&self) -> bool {
        self.repeated
    }

    /// The square-free part of the polynomial (a constant multiple of it).
    pub fn square_free(&self) -> Option<&Exact> {
        self.chain.first()
    }

    fn variations(&self, x: &Dyadic) -> usize {
        let (mut changes, mut last) = (0, 0);
        for sign in self.chain.iter().map(|p| p.value(x).sign()).filter(|sign| *sign != 0) {
            changes += usize::from(last != 0 && sign != last);
            last = sign;
        }
        changes
    }

    /// x is a root.
    pub fn is_root(&self, x: &Dyadic) -> bool {
        self.chain.first().is_some_and(|p| p.degree().unwrap_or(0) > 0 && p.value(x).sign() == 0)
    }

    /// The number of different roots in [lo, hi]; 0 if lo > hi.
    pub fn count(&self, lo: &Dyadic, hi: &Dyadic) -> usize {
        if lo > hi {
            return 0;
        }
        self.variations(lo).saturating_sub(self.variations(hi)) + usize::from(self.is_root(lo))
    }

    /// The number of different roots strictly between lo and hi; 0 if lo ≥ hi.
    pub fn count_inside(&self, lo: &Dyadic, hi: &Dyadic) -> usize {
        if lo >= hi {
            return 0;
        }
        self.variations(lo).saturating_sub(self.variations(hi)).saturating_sub(usize::from(self.is_root(hi)))
    }

    /// Disjoint brackets of the roots in [lo, hi], ascending, each of a width of at most 2^−bits of its larger end in
    /// modulus (or a point).
    pub fn roots(&self, lo: &Dyadic, hi: &Dyadic, bits: u32) -> Vec<(Dyadic, Dyadic)> {
        let mut found = Vec::new();
        let mut pending = vec![(lo.clone(), hi.clone())];
        while let Some((lo, hi)) = pending.pop() {
            match self.count(&lo, &hi) {
                0 => {}
                1 => found.push(self.narrowed(lo, hi, bits)),
                _ => {
                    let mid = Dyadic::midpoint(&lo, &hi);
                    if self.is_root(&mid) {
                        // a neighbourhood of the middle without other roots
                        let mut gap = hi.minus(&lo).shifted(-2).reduced();
                        while self.count(&mid.minus(&gap), &mid.plus(&gap)) > 1 {
                            gap = gap.shifted(-1);
                        }
                        pending.push((mid.plus(&gap), hi));
                        found.push((mid.clone(), mid.clone()));
                        pending.push((lo, mid.minus(&gap)));
                    } else {
                        pending.push((mid.clone(), hi));
                        pending.push((lo, mid));
                    }
                }
            }
        }
        found.sort_by(|a, b| a.0.cmp(&b.0));
        found
    }

    /// The bracket of one root, narrowed.
    fn narrowed(&self, mut lo: Dyadic, mut hi: Dyadic, bits: u32) -> (Dyadic, Dyadic) {
        let zero = Dyadic::zero();
        for end in [&lo, &hi, &zero] {
            if *end >= lo && *end <= hi && self.is_root(end) {
                return (end.clone(), end.clone());
            }
        }
        let Some(p) = self.chain.first() else { return (lo, hi) };
        let rising = p.value(&hi).sign();
        loop {
            let width = hi.minus(&lo);
            let reach = lo.abs().max(hi.abs());
            if width.shifted(i64::from(bits)) <= reach {
                return (lo.reduced(), hi.reduced());
            }
            let mid = Dyadic::midpoint(&lo, &hi);
            match p.value(&mid).sign() {
                0 => return (mid.clone(), mid),
                sign if sign == rising => hi = mid,
                _ => lo = mid,
            }
        }
    }
}

/// A power of two beyond the modulus of every root of p: Cauchy's bound, rounded up.
pub fn beyond_all_roots(p: &Exact) -> Dyadic {
    let bits = |j: usize| p.integers().get(j).map_or(0, num_bigint::BigInt::bits);
    let leading = bits(p.degree().unwrap_or(0));
    let largest = (0..p.integers().len()).map(bits).max().unwrap_or(0);
    Dyadic::power_of_two(i64::try_from(largest + 2).unwrap_or(0) - i64::try_from(leading).unwrap_or(0))
}

/// Roots counted with multiplicity: one chain for each multiplicity that occurs.
#[derive(Clone, Debug)]
pub struct Multiplicities(Vec<(usize, Sturm)>);

impl Multiplicities {
    /// The chains of the square-free factors of p.
    pub fn new(p: &Exact) -> Self {
        Self(p.square_free_factors().iter().map(|(m, factor)| (*m, Sturm::new(factor))).collect())
    }

    /// The number of roots in [lo, hi], each as often as its multiplicity says.
    pub fn count(&self, lo: &Dyadic, hi: &Dyadic) -> usize {
        self.0.iter().map(|(m, sturm)| m * sturm.count(lo, hi)).sum()
    }

    /// Brackets as of [`Sturm::roots`] with the multiplicity of each, ascending.
    pub fn roots(&self, lo: &Dyadic, hi: &Dyadic, bits: u32) -> Vec<(Dyadic, Dyadic, usize)> {
        let mut all: Vec<_> = self
            .0
            .iter()
            .flat_map(|(m, sturm)| sturm.roots(lo, hi, bits).into_iter().map(|(lo, hi)| (lo, hi, *m)))
            .collect();
        all.sort_by(|a, b| a.0.cmp(&b.0));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(c: &[f64]) -> Exact {
        Exact::from_f64(c).expect("finite")
    }

    fn at(x: f64) -> Dyadic {
        Dyadic::from_f64(x).expect("finite")
    }

    #[test]
    fn counts_with_the_ends() {
        // x(x − 1)(x + 2)(x² + 1), twice the root 1
        let p = exact(&[0.0, 2.0, -3.0, 2.0, -2.0, 0.0, 1.0]);
        let sturm = Sturm::new(&p);
        assert!(sturm.has_repeated_roots());
        assert_eq!(sturm.count(&at(-5.0), &at(5.0)), 3);
        assert_eq!(sturm.count(&at(0.0), &at(1.0)), 2);
        assert_eq!(sturm.count_inside(&at(0.0), &at(1.0)), 0);
        assert_eq!(sturm.count(&at(-2.0), &at(-2.0)), 1);
        assert_eq!(sturm.count(&at(0.25), &at(0.75)), 0);
        let all = Multiplicities::new(&p);
        assert_eq!(all.count(&at(-5.0), &at(5.0)), 4);
        let far = beyond_all_roots(&p);
        let found = all.roots(&far.negated(), &far, 60);
        let values: Vec<(f64, usize)> = found.iter().map(|(lo, _, m)| (lo.to_f64(), *m)).collect();
        assert_eq!(values, [(-2.0, 1), (0.0, 1), (1.0, 2)]);
    }

    #[test]
    fn brackets_are_as_narrow_as_asked() {
        let sturm = Sturm::new(&exact(&[-2.0, 0.0, 1.0]));
        let found = sturm.roots(&at(-2.0), &at(2.0), 200);
        assert_eq!(found.len(), 2);
        let (lo, hi) = &found[1];
        assert!(lo.times(lo) < at(2.0) && hi.times(hi) > at(2.0), "√2 is inside");
        assert!(hi.minus(lo).log2() < -199.0);
    }

    #[test]
    fn closer_than_doubles_can_tell() {
        // (x − ½)² − 2⁻²⁰⁰: no double is between its roots, but one
        let mut c = exact(&[0.25, -1.0, 1.0]).taylor(&Dyadic::zero());
        c[0] = c[0].minus(&Dyadic::power_of_two(-200));
        let sturm = Sturm::new(&Exact::from_dyadic(&c));
        assert_eq!(sturm.count(&at(0.0), &at(1.0)), 2);
        assert_eq!(sturm.count(&at(0.0), &at(0.5)), 1);
    }
}
