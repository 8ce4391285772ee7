//! The effective ε of a set of samples: the least ε for which it is an ε-sample, between two bounds.
//!
//! The floored condition for one ε implies it for every larger one: ε·lfs grows, and where the stretch around a singular place becomes
//! shorter ε·lfs takes the place of a floor that it exceeds (`docs/mathematics.md`, section 1). So there is a least one, and each
//! verdict bounds it: one that is proved from above, one that is refuted from below, by the ratio |p−s| / lfs(p) that its witness
//! shows. [`bracket`] asks for verdicts until the bounds agree to a relative tolerance, or until nothing but unknown lies between.

use crate::scalar::Scalar;

/// Bounds of the effective ε.
#[derive(Clone, Debug, PartialEq)]
pub struct EffectiveEpsilon<S> {
    /// For every smaller ε the samples are no ε-sample; 0 where nothing was refuted.
    pub lower: S,
    /// For this ε and every larger one they are an ε-sample; infinite where nothing was proved.
    pub upper: S,
}

/// The answer for one ε.
#[derive(Clone, Debug, PartialEq)]
pub enum Decision<S> {
    /// It is an ε-sample.
    Proved,
    /// It is none, not even for this ratio, which is at least ε.
    Refuted(S),
    /// Neither was shown.
    Unknown,
}

/// Verdicts that are asked for, at most.
const ROUNDS: u32 = 64;

/// No ε above this is tried.
const LARGEST: i32 = 64;

/// Brackets the effective ε, from a first guess, until upper ≤ (1 + tolerance)·lower.
///
/// # Errors
/// What `decide` answers.
pub fn bracket<S: Scalar, E>(
    guess: &S,
    tolerance: &S,
    mut decide: impl FnMut(&S) -> Result<Decision<S>, E>,
) -> Result<EffectiveEpsilon<S>, E> {
    let mut found = EffectiveEpsilon { lower: S::zero(), upper: S::infinity() };
    // Smallest and largest ε for which nothing was shown.
    let mut unknown: Option<[S; 2]> = None;
    let mut at = guess.clone();
    for _ in 0..ROUNDS {
        match decide(&at)? {
            Decision::Proved => found.upper = found.upper.min(at.clone()),
            Decision::Refuted(ratio) => found.lower = found.lower.max(ratio).max(at.clone()),
            Decision::Unknown => {
                let [a, b] = unknown.unwrap_or_else(|| [at.clone(), at.clone()]);
                unknown = Some([a.min(at.clone()), b.max(at.clone())]);
            }
        }
        match next(&found, unknown.as_ref(), &at, tolerance) {
            Some(then) => at = then,
            None => break,
        }
    }
    Ok(found)
}

/// Where to ask next.
fn next<S: Scalar>(found: &EffectiveEpsilon<S>, unknown: Option<&[S; 2]>, at: &S, tolerance: &S) -> Option<S> {
    let EffectiveEpsilon { lower, upper } = found;
    if !upper.is_finite() {
        let larger = at.clone().max(lower.clone()).max(unknown.map_or_else(S::zero, |u| u[1].clone()));
        return Some(larger * &S::ratio(5, 4)).filter(|e| *e <= S::int(LARGEST));
    }
    if *lower <= S::zero() {
        let smaller = unknown.map_or_else(|| at.clone(), |u| u[0].clone()).min(upper.clone());
        return Some(smaller * &S::ratio(3, 4)).filter(|e| *e > S::ratio(1, 1 << 20));
    }
    let wide = |a: &S, b: &S, share: &S| b.clone() - a > a.clone() * share;
    if !wide(lower, upper, tolerance) {
        return None;
    }
    match unknown {
        Some([a, b]) => {
            // What is unknown is the dearest to ask about, and need not be known to better than half the tolerance.
            let share = tolerance.clone().half();
            let (below, above) = (wide(lower, a, &share), wide(b, upper, &share));
            match (below, above) {
                (true, _) => Some(S::midpoint(lower, a)),
                (_, true) => Some(S::midpoint(b, upper)),
                _ => None,
            }
        }
        None => Some(S::midpoint(lower, upper)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A set whose effective ε is known; nothing is shown within a share of it.
    fn decide(truth: f64, blind: f64, asked: &mut u32) -> impl FnMut(&f64) -> Result<Decision<f64>, ()> {
        move |&epsilon| {
            *asked += 1;
            Ok(if epsilon > truth * (1.0 + blind) {
                Decision::Proved
            } else if epsilon < truth * (1.0 - blind) {
                Decision::Refuted(epsilon.max(0.9 * truth))
            } else {
                Decision::Unknown
            })
        }
    }

    #[test]
    fn brackets_what_is_known() {
        for truth in [0.013, 0.3, 0.4999, 0.5, 0.6, 2.0, 17.0] {
            for blind in [0.0, 1e-4, 2e-3] {
                let mut asked = 0;
                let found = bracket(&0.5, &5e-3, decide(truth, blind, &mut asked)).expect("no error");
                let EffectiveEpsilon { lower, upper } = found;
                assert!(lower <= truth && truth <= upper, "{truth}: [{lower}, {upper}]");
                assert!(upper - lower <= (5.5e-3 + 2.0 * blind) * truth, "{truth} {blind}: [{lower}, {upper}]");
                assert!(asked < 32, "{truth} {blind}: asked {asked} times");
            }
        }
    }

    #[test]
    fn what_is_never_shown_stays_open() {
        let nothing: Result<_, ()> = bracket(&0.5, &5e-3, |_| Ok(Decision::<f64>::Unknown));
        assert_eq!(nothing, Ok(EffectiveEpsilon { lower: 0.0, upper: f64::INFINITY }));
        let always: Result<_, ()> = bracket(&0.5, &5e-3, |e| Ok(Decision::Refuted(*e)));
        assert_eq!(always.map(|f| f.upper), Ok(f64::INFINITY));
    }
}
