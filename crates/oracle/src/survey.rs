//! Counts of what the kernel gets wrong on many cases: what `cargo test` asserts on a few and the examples print for many.

use crate::closest::{Closest, brute};
use crate::judge::{Fault, Interval, Judge, Quality, SLACK};
use crate::nasty;
use crate::proof::refuted;
use crate::queries;
use crate::random::Random;
use crate::solve::{Ask, prove, solve};
use feature_sampling::bezier::nearest::{distance_quintic, nearest};
use feature_sampling::polynomial::{Holds, Root, RootKind};

/// The outcome for one class of nasty polynomials.
#[derive(Clone, Debug, Default)]
pub struct RootSurvey {
    /// Polynomials asked about; each is asked for its roots in [0, 1], in a random interval, and all.
    pub polynomials: usize,
    /// Roots with multiplicity in all these answers, exactly counted.
    pub roots: usize,
    /// Of these, at an end of the interval.
    pub at_ends: usize,
    /// Roots in no bracket.
    pub missed: usize,
    /// Of these, at an end.
    pub missed_at_ends: usize,
    /// Brackets without root.
    pub ghosts: usize,
    /// Groups of brackets that hold more roots than they say, or another parity.
    pub miscounts: usize,
    /// Simple roots off by more than [`SLACK`] attainable errors, or brackets out of order.
    pub inaccurate: usize,
    /// Planted roots (rounding may have lifted them off the axis) in no bracket.
    pub planted_missed: usize,
    /// Certified answers with a false statement.
    pub refuted: usize,
    /// Certified brackets.
    pub certified: usize,
    /// Of these, brackets with exactly one root.
    pub proved: usize,
    /// Simple roots of the plain mode that are outside of their brackets, however close.
    pub outside: usize,
    /// Errors and widths.
    pub quality: Quality,
    /// The first faults, in words, with the polynomial.
    pub examples: Vec<String>,
}

impl RootSurvey {
    /// Nothing is wrong.
    pub const fn is_clean(&self) -> bool {
        self.missed + self.ghosts + self.miscounts + self.inaccurate + self.planted_missed + self.refuted == 0
    }
}

/// Asks for the roots of `count` polynomials of a class.
pub fn roots(class: nasty::Class, count: usize, seed: u64) -> RootSurvey {
    let mut random = Random::new(seed);
    let mut survey = RootSurvey::default();
    for _ in 0..count {
        let case = nasty::case(class, &mut random);
        let Some(judge) = Judge::new(&case.coefficients) else { continue };
        survey.polynomials += 1;
        let (lo, width) = (random.between(-1.0, 1.0), random.between(0.01, 2.0));
        let (random_lo, random_hi) = match case.planted.first() {
            // an end exactly at a root
            Some(root) if random.integer(0, 3) == 0 => (*root, root + width * root.abs().max(f64::MIN_POSITIVE)),
            _ => (lo, lo + width),
        };
        for ask in [Ask::Unit, Ask::Between(random_lo, random_hi), Ask::Real] {
            let within = match ask {
                Ask::Unit => Interval::between(0.0, 1.0),
                Ask::Between(lo, hi) => Interval::between(lo, hi),
                Ask::Real => Some(judge.everywhere()),
            };
            let (Some(within), Ok(found)) = (within, solve(&case.coefficients, ask)) else {
                survey.note(format!("{ask:?} of {:?}: no answer", case.coefficients));
                survey.missed += 1;
                continue;
            };
            let at_ends = [&within.lo, &within.hi].into_iter().filter(|end| judge.is_root(end)).count();
            survey.roots += judge.count(&within);
            survey.at_ends += at_ends;
            for fault in judge.faults(&found, &within) {
                match fault {
                    Fault::Missed(x) => {
                        survey.missed += 1;
                        let at_end = [&within.lo, &within.hi].into_iter().any(|end| end.to_f64() == x);
                        survey.missed_at_ends += usize::from(at_end);
                    }
                    Fault::Ghost(..) => survey.ghosts += 1,
                    Fault::Miscount(..) => survey.miscounts += 1,
                    Fault::Disorder(_) | Fault::Inaccurate(..) => survey.inaccurate += 1,
                }
                survey.note(format!("{ask:?} of {:?}: {fault}; found {found:?}", case.coefficients));
            }
            for planted in inside(&case.planted, &within) {
                if !judge.is_covered(&found, planted) {
                    survey.planted_missed += 1;
                    survey.note(format!("{ask:?} of {:?}: planted {planted:?} missed", case.coefficients));
                }
            }
            survey.quality = survey.quality.worst(judge.quality(&found));
            for root in found.iter().filter(|root| root.kind == RootKind::Simple) {
                let bracket = Interval::between(root.lower, root.upper);
                survey.outside += usize::from(bracket.is_some_and(|bracket| judge.count_distinct(&bracket) == 0));
            }
            let certified = prove(&case.coefficients, ask).unwrap_or_default();
            survey.certified += certified.len();
            survey.proved += certified.iter().filter(|root| root.holds == Holds::One).count();
            if let Some(cause) = refuted(&judge, &certified, &within) {
                survey.refuted += 1;
                survey.note(format!("{ask:?} of {:?}: {cause}; certified {certified:?}", case.coefficients));
            }
        }
    }
    survey
}

impl RootSurvey {
    fn note(&mut self, text: String) {
        if self.examples.len() < 3 {
            self.examples.push(text);
        }
    }
}

fn inside<'a>(planted: &'a [f64], within: &Interval) -> impl Iterator<Item = f64> + 'a {
    let (lo, hi) = (within.lo.to_f64(), within.hi.to_f64());
    planted.iter().copied().filter(move |x| lo <= *x && *x <= hi)
}

/// The outcome for one class of closest-point queries.
#[derive(Clone, Debug, Default)]
pub struct ClosestSurvey {
    /// Queries asked.
    pub queries: usize,
    /// Answers where brute force and kernel differ, or that were picked for the exact check anyway.
    pub checked: usize,
    /// Answers farther than the closest point by more than 1e-12 of the distance.
    pub wrong: usize,
    /// The largest excess over the least distance, relative to it, of the answers checked.
    pub excess: f64,
    /// Quintics whose roots in [0, 1], counted with multiplicity, are not as many as Sturm's theorem says.
    pub miscounted: usize,
    /// Of these, quintics with an answer that is not simple: roots closer than rounding can tell.
    pub ambiguous: usize,
    /// Faults that [`Judge::faults`] finds in the miscounted.
    pub faults: usize,
    /// The first wrong ones, in words.
    pub examples: Vec<String>,
}

/// The relative excess of the distance that is allowed.
pub const ALLOWED: f64 = 1e-12;

/// Asks for the closest points of `count` queries of a class, and for the roots of their quintics.
pub fn closest(class: queries::Class, count: usize, seed: u64) -> ClosestSurvey {
    let mut random = Random::new(seed);
    let mut survey = ClosestSurvey::default();
    let unit = Interval::between(0.0, 1.0);
    for i in 0..count {
        let (cubic, q) = queries::query(class, &mut random);
        let b = cubic.power_basis();
        survey.queries += 1;
        let found = nearest(&b, &q);
        let (least, _) = brute(&b, &q);
        // Both are evaluated in doubles; whoever is farther by more than a tenth of what is allowed is looked at exactly.
        let differ = (found.distance_sq - least).abs() > 0.2 * ALLOWED * least;
        if differ || i % 1024 == 0 {
            survey.checked += 1;
            let excess = Closest::new(&b, &q).map_or(f64::INFINITY, |exact| exact.excess(found.t));
            survey.excess = survey.excess.max(excess);
            if excess > ALLOWED {
                survey.wrong += 1;
                survey.note(format!("{cubic:?} {q:?}: t = {:?}, {excess:e} too far", found.t));
            }
        }
        let quintic = distance_quintic(&b, &q).coefficients;
        let (Some(judge), Some(unit)) = (Judge::new(&quintic), &unit) else { continue };
        let roots = solve(&quintic, Ask::Unit).unwrap_or_default();
        let claimed: usize = roots.iter().map(|r| usize::from(r.kind.multiplicity())).sum();
        if claimed != judge.count(unit) {
            survey.miscounted += 1;
            survey.ambiguous += usize::from(roots.iter().any(|r: &Root<f64>| r.kind != RootKind::Simple));
            let faults = judge.faults(&roots, unit);
            survey.faults += faults.len();
            for fault in faults {
                survey.note(format!("{quintic:?}: {fault}; found {roots:?}"));
            }
        }
    }
    survey
}

impl ClosestSurvey {
    fn note(&mut self, text: String) {
        if self.examples.len() < 5 {
            self.examples.push(text);
        }
    }
}

/// What the widths and errors are measured in, for headings.
pub fn units() -> String {
    format!("errors and widths in attainable errors; a finding is widened by {SLACK} of them")
}
