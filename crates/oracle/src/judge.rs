//! What is right and what is wrong about a list of roots.
//!
//! The truth is exact: the number of roots of the polynomial *with these doubles as coefficients*, by [`Sturm`]. What may be
//! expected of an answer in doubles is less. Rounding every coefficient once, by u = 2⁻⁵³ of itself, moves a root x by its
//! **attainable error**; with η = u·Σ|aⱼ||x|ʲ and the Taylor coefficients cⱼ of p about x it is, up to a small factor,
//!
//! ρ(x) = u|x| + min over j ≥ 1 of (η/|cⱼ|)^(1/j)
//!
//! (j = 1: a simple root, u times its condition; j = k: a k-fold one or a cluster of k). So an answer is judged like this,
//! each bracket being widened by [`SLACK`]·ρ:
//!
//! * **missed**: a root of the interval in no widened bracket;
//! * **ghost**: a widened bracket without a root. If it claims to be a touching or a cluster, or lies at an end of the
//!   interval (the root may be just outside), it is none where |p| is below [`NEAR_MISS`]·n·η somewhere in the bracket: such a
//!   p cannot be told, with evaluations in doubles, from one with a root;
//! * **miscount**: brackets that (widened) do not meet others or the ends of the interval, and hold more roots than they
//!   say, or a number of other parity.

use crate::dyadic::Dyadic;
use crate::exact::Exact;
use crate::sturm::{Multiplicities, Sturm, beyond_all_roots};
use feature_sampling::polynomial::{Root, RootKind};
use std::fmt;

/// Attainable errors by which brackets are widened before roots are counted in them.
pub const SLACK: f64 = 4.0;

/// |p| up to this many η for each coefficient counts as "may be zero" at a finding. The Bernstein form on an interval errs by
/// up to 4η for each; the root finder gives up where it is within 16 times that.
pub const NEAR_MISS: f64 = 64.0;

/// Something wrong about an answer.
#[derive(Clone, Debug, PartialEq)]
pub enum Fault {
    /// A bracket that is not lower ≤ value ≤ upper inside the interval, or meets its neighbour.
    Disorder(usize),
    /// A root that is nowhere near any finding, to the precision of a double.
    Missed(f64),
    /// A finding without a root; |p|/η at its value.
    Ghost(usize, f64),
    /// Findings from the first to the second index hold this many roots.
    Miscount(usize, usize, usize),
    /// A simple root whose value is off by this many attainable errors.
    Inaccurate(usize, f64),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Disorder(i) => write!(f, "finding {i} is out of order"),
            Self::Missed(x) => write!(f, "the root {x:?} is missed"),
            Self::Ghost(i, size) => write!(f, "finding {i} is a ghost, |p| is {size:.3e} η there"),
            Self::Miscount(i, j, n) => write!(f, "findings {i} to {j} hold {n} roots"),
            Self::Inaccurate(i, e) => write!(f, "finding {i} is off by {e:.2} attainable errors"),
        }
    }
}

/// How good an answer without faults is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Quality {
    /// The largest error of a simple root in attainable errors.
    pub error: f64,
    /// The largest width of the bracket of a simple root in attainable errors.
    pub simple_width: f64,
    /// The largest width of another bracket in attainable errors of a root of its multiplicity.
    pub cluster_width: f64,
}

impl Quality {
    /// The worse of both in each respect.
    #[must_use]
    pub const fn worst(self, other: Self) -> Self {
        Self {
            error: self.error.max(other.error),
            simple_width: self.simple_width.max(other.simple_width),
            cluster_width: self.cluster_width.max(other.cluster_width),
        }
    }
}

/// A polynomial that is not zero and all that is known of it.
#[derive(Clone, Debug)]
pub struct Judge {
    exact: Exact,
    sturm: Sturm,
    multiplicities: Option<Multiplicities>,
}

/// An exact interval.
#[derive(Clone, Debug)]
pub struct Interval {
    /// Lower end.
    pub lo: Dyadic,
    /// Upper end.
    pub hi: Dyadic,
}

impl Interval {
    /// Between two doubles; `None` if one is not finite.
    pub fn between(lo: f64, hi: f64) -> Option<Self> {
        Some(Self { lo: Dyadic::from_f64(lo)?, hi: Dyadic::from_f64(hi)? })
    }

    fn meets(&self, other: &Self) -> bool {
        self.lo <= other.hi && other.lo <= self.hi
    }
}

impl Judge {
    /// `None` for the zero polynomial and for coefficients that are not finite.
    pub fn new(coefficients: &[f64]) -> Option<Self> {
        let exact = Exact::from_f64(coefficients)?;
        exact.degree()?;
        let sturm = Sturm::new(&exact);
        let multiplicities = sturm.has_repeated_roots().then(|| Multiplicities::new(&exact));
        Some(Self { exact, sturm, multiplicities })
    }

    /// The interval that holds every real root that a double can hold.
    pub fn everywhere(&self) -> Interval {
        let far = beyond_all_roots(&self.exact);
        let far = Dyadic::from_f64(f64::MAX).map_or(far.clone(), |max| if far < max { far } else { max });
        Interval { lo: far.negated(), hi: far }
    }

    /// The number of roots, each as often as its multiplicity says.
    pub fn count(&self, within: &Interval) -> usize {
        match &self.multiplicities {
            Some(all) => all.count(&within.lo, &within.hi),
            None => self.sturm.count(&within.lo, &within.hi),
        }
    }

    /// The number of different roots.
    pub fn count_distinct(&self, within: &Interval) -> usize {
        self.sturm.count(&within.lo, &within.hi)
    }

    /// x is a root.
    pub fn is_root(&self, x: &Dyadic) -> bool {
        self.sturm.is_root(x)
    }

    /// x lies in a widened bracket, or within its own slack of one.
    pub fn is_covered(&self, found: &[Root<f64>], x: f64) -> bool {
        let Some(x) = Interval::between(x, x).map(|x| self.widened(&x)) else { return false };
        found.iter().filter_map(exactly).any(|(bracket, _)| self.widened(&bracket).meets(&x))
    }

    /// Roots to 64 bits (rounded to doubles) with multiplicities, ascending.
    pub fn roots(&self, within: &Interval) -> Vec<(f64, usize)> {
        let (lo, hi) = (&within.lo, &within.hi);
        match &self.multiplicities {
            Some(all) => all.roots(lo, hi, 64).into_iter().map(|(lo, hi, m)| (middle(&lo, &hi), m)).collect(),
            None => self.sturm.roots(lo, hi, 64).into_iter().map(|(lo, hi)| (middle(&lo, &hi), 1)).collect(),
        }
    }

    /// All roots within an interval between doubles, proved: each finding holds exactly as many roots, counted with their
    /// multiplicities, as its kind says, and there is no other root in the interval. Brackets are the narrowest doubles
    /// allow but for one step, and apart; roots closer than that share one.
    pub fn certified(&self, within: &Interval) -> Vec<Root<f64>> {
        let (lo, hi) = (&within.lo, &within.hi);
        let all = match &self.multiplicities {
            Some(all) => all.roots(lo, hi, 64),
            None => self.sturm.roots(lo, hi, 64).into_iter().map(|(lo, hi)| (lo, hi, 1)).collect(),
        };
        let mut groups: Vec<(f64, f64, f64, usize)> = Vec::new();
        for (a, b, multiplicity) in all {
            let (lower, upper) = (a.enclosing().0, b.enclosing().1);
            let value = middle(&a, &b).clamp(lower, upper);
            match groups.last_mut() {
                Some((_, _, end, count)) if lower <= *end => {
                    *end = upper.max(*end);
                    *count += multiplicity;
                }
                _ => groups.push((value, lower, upper, multiplicity)),
            }
        }
        groups
            .into_iter()
            .map(|(value, lower, upper, count)| {
                let kind = match count {
                    1 => RootKind::Simple,
                    2 => RootKind::Even,
                    3 => RootKind::Odd,
                    k => RootKind::Cluster(u8::try_from(k).unwrap_or(u8::MAX)),
                };
                Root { value, lower, upper, kind }
            })
            .collect()
    }

    /// The attainable error ρ at x.
    pub fn attainable(&self, x: &Dyadic) -> f64 {
        self.attainable_up_to(x, 1)
    }

    /// The attainable error of a k-fold root, or a cluster of k, at x: that of the j-fold ones, j ≥ k, is not better.
    pub fn attainable_of(&self, x: &Dyadic, k: u8) -> f64 {
        self.attainable_up_to(x, usize::from(k))
    }

    /// u|x| + min over j ≥ `first` of (η/|cⱼ|)^(1/j).
    fn attainable_up_to(&self, x: &Dyadic, first: usize) -> f64 {
        let noise = self.exact.magnitude(x).log2() - 53.0;
        let (mut least, mut order) = (f64::INFINITY, 0.0);
        for (j, c) in self.exact.taylor(x).iter().enumerate().skip(1) {
            order += 1.0;
            if j >= first {
                least = least.min((noise - c.log2()) / order);
            }
        }
        let own = if x.sign() == 0 { 0.0 } else { (x.log2() - 53.0).exp2() };
        least.exp2() + own + f64::from_bits(1)
    }

    /// |p(x)|/η.
    pub fn backward_error(&self, x: &Dyadic) -> f64 {
        (self.exact.value(x).log2() - (self.exact.magnitude(x).log2() - 53.0)).exp2()
    }

    fn near_miss(&self) -> f64 {
        self.exact.integers().iter().map(|_| NEAR_MISS).sum()
    }

    /// What is wrong with these findings of the roots within an interval.
    pub fn faults(&self, found: &[Root<f64>], within: &Interval) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut groups: Vec<(Interval, usize, usize)> = Vec::new();
        for (i, root) in found.iter().enumerate() {
            let Some((bracket, value)) = exactly(root) else {
                faults.push(Fault::Disorder(i));
                continue;
            };
            let ordered =
                bracket.lo <= value && value <= bracket.hi && bracket.lo >= within.lo && bracket.hi <= within.hi;
            let apart = found.get(i + 1).is_none_or(|next| root.upper <= next.lower);
            if !(ordered && apart) {
                faults.push(Fault::Disorder(i));
            }
            let wide = self.widened(&bracket);
            if self.count_distinct(&wide) == 0 {
                let least = [&bracket.lo, &value, &bracket.hi].map(|x| self.backward_error(x));
                let least = least.into_iter().fold(f64::INFINITY, f64::min);
                let at_end = bracket.lo == within.lo || bracket.hi == within.hi;
                if (root.kind == RootKind::Simple && !at_end) || least > self.near_miss() {
                    faults.push(Fault::Ghost(i, least));
                }
            }
            if root.kind == RootKind::Simple {
                let at_end = bracket.lo == within.lo || bracket.hi == within.hi;
                // at an end the root may be outside
                let may_be_outside = at_end && self.backward_error(&value) <= self.near_miss();
                let off = self.attainable(&value) * SLACK;
                let near = Dyadic::from_f64(off).map(|d| Interval { lo: value.minus(&d), hi: value.plus(&d) });
                if !may_be_outside && near.is_some_and(|near| self.count_distinct(&near) == 0) {
                    let error = self.error(root, &wide).unwrap_or(f64::INFINITY);
                    if error > SLACK {
                        faults.push(Fault::Inaccurate(i, error));
                    }
                }
            }
            match groups.last_mut() {
                Some((group, _, last)) if group.meets(&wide) => {
                    group.hi = wide.hi.max(group.hi.clone());
                    *last = i;
                }
                _ => groups.push((wide, i, i)),
            }
        }
        self.check_gaps(&groups, within, &mut faults);
        for (group, first, last) in &groups {
            let claimed: usize =
                found.iter().take(last + 1).skip(*first).map(|r| usize::from(r.kind.multiplicity())).sum();
            let held = self.count(group);
            let inside = group.lo > within.lo && group.hi < within.hi;
            if inside && (held > claimed || (claimed - held) % 2 == 1) {
                faults.push(Fault::Miscount(*first, *last, held));
            }
        }
        faults
    }

    /// Roots between the groups.
    fn check_gaps(&self, groups: &[(Interval, usize, usize)], within: &Interval, faults: &mut Vec<Fault>) {
        let mut from = within.lo.clone();
        let mut closed = true;
        let ends = groups.iter().map(|(group, ..)| Some(group)).chain([None]);
        for group in ends {
            let to = group.map_or(&within.hi, |group| &group.lo);
            let at_start = usize::from(closed && self.sturm.is_root(&from) && group.is_none_or(|g| g.lo > from));
            let at_end = usize::from(group.is_none() && *to > from && self.sturm.is_root(to));
            let inside = self.sturm.count_inside(&from, to);
            if at_start > 0 {
                faults.push(Fault::Missed(from.to_f64()));
            }
            if at_end > 0 {
                faults.push(Fault::Missed(to.to_f64()));
            }
            if inside > 0 {
                for (lo, hi) in self.sturm.roots(&from, to, 64) {
                    if lo > from && hi < *to {
                        faults.push(Fault::Missed(middle(&lo, &hi)));
                    }
                }
            }
            if let Some(group) = group {
                if group.hi >= within.hi {
                    return;
                }
                if group.hi >= from {
                    from = group.hi.clone();
                    closed = false;
                }
            }
        }
    }

    /// How good findings are. Those without a root have no error; [`Judge::faults`] says whether they may be.
    pub fn quality(&self, found: &[Root<f64>]) -> Quality {
        let mut quality = Quality::default();
        for root in found {
            let Some((bracket, value)) = exactly(root) else { continue };
            let width = (root.upper - root.lower) / self.attainable_of(&value, root.kind.multiplicity());
            let error = self.error(root, &self.widened(&bracket));
            let one = match (root.kind, error) {
                (RootKind::Simple, Some(error)) => Quality { error, simple_width: width, cluster_width: 0.0 },
                (RootKind::Simple, None) => Quality { error: 0.0, simple_width: width, cluster_width: 0.0 },
                _ => Quality { error: 0.0, simple_width: 0.0, cluster_width: width },
            };
            quality = quality.worst(one);
        }
        quality
    }

    /// The distance from the value to the nearest root in the widened bracket, in attainable errors of that root.
    fn error(&self, root: &Root<f64>, wide: &Interval) -> Option<f64> {
        let value = Dyadic::from_f64(root.value)?;
        let distances = self.sturm.roots(&wide.lo, &wide.hi, 80).into_iter().map(|(truth, _)| {
            let distance = truth.minus(&value).abs().to_f64();
            // The value itself is rounded to a double, which is part of ρ.
            distance / self.attainable(&truth)
        });
        distances.min_by(f64::total_cmp)
    }

    /// The bracket with [`SLACK`] attainable errors on both sides.
    fn widened(&self, bracket: &Interval) -> Interval {
        let by = |x: &Dyadic| Dyadic::from_f64((self.attainable(x) * SLACK).min(f64::MAX)).unwrap_or_else(Dyadic::zero);
        Interval { lo: bracket.lo.minus(&by(&bracket.lo)), hi: bracket.hi.plus(&by(&bracket.hi)) }
    }
}

/// The double in the middle.
fn middle(lo: &Dyadic, hi: &Dyadic) -> f64 {
    Dyadic::midpoint(lo, hi).to_f64()
}

/// Bracket and value; `None` where they are not finite.
fn exactly(root: &Root<f64>) -> Option<(Interval, Dyadic)> {
    Some((Interval::between(root.lower, root.upper)?, Dyadic::from_f64(root.value)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn simple(value: f64, radius: f64) -> Root<f64> {
        Root { value, lower: value - radius, upper: value + radius, kind: RootKind::Simple }
    }

    fn unit() -> Interval {
        Interval::between(0.0, 1.0).expect("finite")
    }

    #[test]
    fn a_right_answer_passes_and_wrong_ones_do_not() {
        // (x − ¼)(x − ¾)(x + 2), times 16
        let judge = Judge::new(&[6.0, -29.0, 16.0, 16.0]).expect("not zero");
        let right = [simple(0.25, 1e-16), simple(0.75, 1e-16)];
        assert_eq!(judge.faults(&right, &unit()), []);
        assert!(judge.quality(&right).error < 1e-6, "exact values");
        assert_eq!(judge.faults(&right[..1], &unit()), [Fault::Missed(0.75)]);
        assert_eq!(judge.faults(&[], &unit()), [Fault::Missed(0.25), Fault::Missed(0.75)]);
        let ghost = [right[0], simple(0.5, 1e-16), right[1]];
        assert!(matches!(judge.faults(&ghost, &unit())[..], [Fault::Ghost(1, _), ..]), "a ghost");
        let swapped = [right[1], right[0]];
        assert!(judge.faults(&swapped, &unit()).contains(&Fault::Disorder(0)));
        let off = [simple(0.25 + 1e-13, 2e-13), right[1]];
        assert!(matches!(judge.faults(&off, &unit())[..], [Fault::Inaccurate(0, e)] if e > 100.0), "inaccurate");
        let even = [Root { kind: RootKind::Even, ..right[0] }, right[1]];
        assert_eq!(judge.faults(&even, &unit()), [Fault::Miscount(0, 0, 1)]);
    }

    #[test]
    fn ends_belong_to_the_interval() {
        let judge = Judge::new(&[0.0, 1.0, -1.0]).expect("not zero");
        let (a, b) = (simple(0.0, 0.0), simple(1.0, 0.0));
        assert_eq!(judge.faults(&[a, b], &unit()), []);
        assert_eq!(judge.faults(&[a], &unit()), [Fault::Missed(1.0)]);
        assert_eq!(judge.faults(&[b], &unit()), [Fault::Missed(0.0)]);
        assert_eq!(judge.faults(&[], &unit()), [Fault::Missed(0.0), Fault::Missed(1.0)]);
    }

    #[test]
    fn touching_and_nearly_touching() {
        // (x − ½)² and the same plus what rounding cannot tell from it
        for raised in [0.0, 1e-17] {
            let judge = Judge::new(&[0.25 + raised, -1.0, 1.0]).expect("not zero");
            let even = Root { value: 0.5, lower: 0.5 - 1e-8, upper: 0.5 + 1e-8, kind: RootKind::Even };
            assert_eq!(judge.faults(&[even], &unit()), []);
            assert!(!judge.faults(&[Root { kind: RootKind::Simple, ..even }], &unit()).is_empty());
        }
        let judge = Judge::new(&[0.2501, -1.0, 1.0]).expect("not zero");
        let even = Root { value: 0.5, lower: 0.5 - 1e-8, upper: 0.5 + 1e-8, kind: RootKind::Even };
        assert!(matches!(judge.faults(&[even], &unit())[..], [Fault::Ghost(0, _)]), "well above zero");
        assert_eq!(judge.faults(&[], &unit()), []);
    }

    #[test]
    fn certified_brackets() {
        // (x − ½)³(3x − 1), and two roots closer than doubles can tell
        let judge = Judge::new(&[0.125, -1.125, 3.75, -5.5, 3.0]).expect("not zero");
        let found = judge.certified(&unit());
        assert_eq!(found.iter().map(|r| r.kind).collect::<Vec<_>>(), [RootKind::Simple, RootKind::Odd]);
        assert_eq!((found[1].lower, found[1].value, found[1].upper), (0.5, 0.5, 0.5));
        assert!(found[0].lower < found[0].upper && found[0].upper <= found[0].lower.next_up().next_up(), "{found:?}");
        assert_eq!(judge.faults(&found, &unit()), []);
        let close = Judge::new(&[-f64::from_bits(1), 0.0, 1.0]).expect("not zero");
        assert_eq!(close.certified(&unit()).len(), 1, "√5e-324 is a double's neighbourhood away from nothing");
    }

    #[test]
    fn attainable_errors() {
        let judge = Judge::new(&[0.25, -1.0, 1.0]).expect("not zero");
        let half = Dyadic::power_of_two(-1);
        let rho = judge.attainable(&half);
        assert!((rho / f64::EPSILON.sqrt() - 0.5_f64.sqrt()).abs() < 0.01, "√(u·Σ|a||x|ʲ) of a double root: {rho}");
        let judge = Judge::new(&[-1.0, 3.0]).expect("not zero");
        let third = Dyadic::from_f64(1.0 / 3.0).expect("finite");
        assert!((judge.attainable(&third) / f64::EPSILON - 0.5).abs() < 0.01, "two coefficients and the root itself");
    }
}
