//! Polynomials that break root finders, from a seed.
//!
//! Each case comes with the roots it was made from. Where the coefficients are integers below 2⁵³ these are its exact roots
//! with their multiplicities. Elsewhere coefficients are rounded, which splits multiple roots or lifts them off the axis:
//! then the truth about the polynomial is what [`Judge`](crate::judge::Judge) counts, and the planted roots are what its
//! maker would like to have back, each within its attainable error.

use crate::random::Random;
use crate::solve::{expanded, expanded_integers};
use std::fmt;

/// A way of being nasty.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// Well separated simple roots: nothing nasty, for comparison.
    Good,
    /// Double to quintuple roots, coefficients exact.
    Multiple,
    /// Double to quintuple roots, coefficients rounded.
    MultipleRounded,
    /// Two roots 1e-12 apart.
    Pair,
    /// Roots at 0, at 1, or both, simple or multiple, coefficients exact.
    Ends,
    /// Roots at 1 or at 0 and anywhere, coefficients rounded.
    EndsRounded,
    /// Leading coefficients that are zero.
    DegreeDrop,
    /// Leading coefficients of 1e-20.
    TinyLeading,
    /// Coefficients times 1e-150 … 1e150.
    ScaledValues,
    /// Roots times 1e-25 … 1e25.
    ScaledRoots,
    /// Wilkinson's: equally spaced roots, degree 5 to 10.
    Wilkinson,
    /// Three roots within 1e-3 … 1e-7.
    TripleCluster,
}

impl Class {
    /// All of them.
    pub const ALL: [Self; 12] = [
        Self::Good,
        Self::Multiple,
        Self::MultipleRounded,
        Self::Pair,
        Self::Ends,
        Self::EndsRounded,
        Self::DegreeDrop,
        Self::TinyLeading,
        Self::ScaledValues,
        Self::ScaledRoots,
        Self::Wilkinson,
        Self::TripleCluster,
    ];
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Good => "well separated",
            Self::Multiple => "2- to 5-fold, exact",
            Self::MultipleRounded => "2- to 5-fold, rounded",
            Self::Pair => "pair 1e-12 apart",
            Self::Ends => "roots at 0 and 1, exact",
            Self::EndsRounded => "roots at 0 and 1, rounded",
            Self::DegreeDrop => "leading zeros",
            Self::TinyLeading => "leading 1e-20",
            Self::ScaledValues => "values times 1e±150",
            Self::ScaledRoots => "roots times 1e±25",
            Self::Wilkinson => "equally spaced, degree 5-10",
            Self::TripleCluster => "triple cluster",
        })
    }
}

/// A polynomial and the roots it was made from.
#[derive(Clone, Debug)]
pub struct Case {
    /// How it is nasty.
    pub class: Class,
    /// Ascending powers.
    pub coefficients: Vec<f64>,
    /// The roots it was made from, repeated as often as planted.
    pub planted: Vec<f64>,
    /// The coefficients were not rounded: these are the roots.
    pub exact: bool,
}

/// One case of a class.
pub fn case(class: Class, random: &mut Random) -> Case {
    match class {
        Class::Good => {
            let mut roots: Vec<f64> = Vec::new();
            while roots.len() < 5 {
                let r = random.between(-1.0, 2.0);
                if roots.iter().all(|other| (other - r).abs() > 0.05) {
                    roots.push(r);
                }
            }
            rounded(class, random, roots)
        }
        Class::Multiple => {
            let m = random.integer(2, 5);
            let k = random.integer(1, 63);
            let mut numerators: Vec<i32> = (0..m).map(|_| k).collect();
            numerators.extend((m..5).map(|_| random.integer(-128, 192)));
            integers(class, &numerators)
        }
        Class::MultipleRounded => {
            let m = random.integer(2, 5);
            let r = random.unit();
            let mut roots: Vec<f64> = (0..m).map(|_| r).collect();
            roots.extend((m..5).map(|_| random.between(-2.0, 3.0)));
            rounded(class, random, roots)
        }
        Class::Pair => {
            let r = random.unit();
            let mut roots = vec![r, r + 1e-12];
            roots.extend((0..3).map(|_| random.between(-2.0, 3.0)));
            rounded(class, random, roots)
        }
        Class::Ends => {
            let (zeros, ones) = (random.integer(0, 2), random.integer(0, 2));
            let mut numerators: Vec<i32> = (0..zeros).map(|_| 0).collect();
            numerators.extend((0..ones).map(|_| 64));
            while numerators.len() < 5 {
                numerators.push(if numerators.is_empty() { 0 } else { random.integer(-128, 192) });
            }
            integers(class, &numerators)
        }
        Class::EndsRounded => {
            let mut roots = vec![f64::from(random.integer(0, 1))];
            roots.extend((0..4).map(|_| random.between(-2.0, 3.0)));
            rounded(class, random, roots)
        }
        Class::DegreeDrop => {
            let degree = random.integer(1, 4);
            let roots: Vec<f64> = (0..degree).map(|_| random.between(-0.5, 1.5)).collect();
            let mut case = rounded(class, random, roots);
            case.coefficients.resize(6, 0.0);
            case
        }
        Class::TinyLeading => {
            let degree = random.integer(1, 4);
            let roots: Vec<f64> = (0..degree).map(|_| random.between(-0.5, 1.5)).collect();
            let mut case = rounded(class, random, roots);
            case.coefficients.resize_with(6, || 1e-20 * random.between(-1.0, 1.0));
            case
        }
        Class::ScaledValues => {
            let roots: Vec<f64> = (0..5).map(|_| random.between(-1.0, 2.0)).collect();
            let mut case = rounded(class, random, roots);
            let scale = 10.0_f64.powi(random.integer(-150, 150));
            for c in &mut case.coefficients {
                *c *= scale;
            }
            case
        }
        Class::ScaledRoots => {
            let scale = 10.0_f64.powi(random.integer(-25, 25));
            let roots: Vec<f64> = (0..5).map(|_| scale * random.between(-1.0, 2.0)).collect();
            rounded(class, random, roots)
        }
        Class::Wilkinson => {
            let degree = random.integer(5, 10);
            let (first, last) = (random.between(-0.2, 0.2), random.between(0.8, 1.2));
            let step = (last - first) / f64::from(degree - 1);
            let roots: Vec<f64> = (0..degree).map(|i| first + f64::from(i) * step).collect();
            rounded(class, random, roots)
        }
        Class::TripleCluster => {
            let (r, spread) = (random.unit(), 10.0_f64.powf(random.between(-7.0, -3.0)));
            let mut roots = vec![r, r + spread * random.unit(), r - spread * random.unit()];
            roots.extend((0..2).map(|_| random.between(-2.0, 3.0)));
            rounded(class, random, roots)
        }
    }
}

fn rounded(class: Class, random: &mut Random, mut planted: Vec<f64>) -> Case {
    let leading = if random.integer(0, 1) == 0 { 1.0 } else { random.between(-3.0, 3.0) };
    planted.sort_by(f64::total_cmp);
    Case { class, coefficients: expanded(leading, &planted), planted, exact: false }
}

fn integers(class: Class, numerators: &[i32]) -> Case {
    let mut planted: Vec<f64> = numerators.iter().map(|k| f64::from(*k) / 64.0).collect();
    planted.sort_by(f64::total_cmp);
    Case { class, coefficients: expanded_integers(64, numerators), planted, exact: true }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::Judge;

    #[test]
    fn the_planted_roots_of_exact_cases_are_the_roots() {
        let mut random = Random::new(1);
        for class in [Class::Multiple, Class::Ends] {
            for _ in 0..200 {
                let case = case(class, &mut random);
                assert!(case.exact);
                let judge = Judge::new(&case.coefficients).expect("not zero");
                let mut truth = Vec::new();
                for (root, multiplicity) in judge.roots(&judge.everywhere()) {
                    truth.extend(std::iter::repeat_n(root, multiplicity));
                }
                assert_eq!(truth, case.planted, "{case:?}");
            }
        }
    }
}
