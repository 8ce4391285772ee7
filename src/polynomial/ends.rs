//! Roots at the ends of the interval asked for.
//!
//! Somebody who plants a root at an end and computes coefficients from it has rounded several times: the root of what comes
//! out is beside the end, perhaps outside. So an end where |p| is at most [`ROUNDINGS`]·N roundings of each coefficient
//! counts as a root if p has none inside that could be meant.

use super::{Polynomial, Root, RootKind, Roots, twofold};
use crate::scalar::Scalar;
use core::cmp::Ordering;

/// Roundings for each coefficient.
const ROUNDINGS: usize = 2;

/// Adds the end `at` (the lower one or the upper one) where p may vanish there.
#[cold]
pub(super) fn check<S: Scalar, const N: usize>(p: &Polynomial<S, N>, at: &S, is_lower: bool, roots: &mut Roots<S, N>) {
    let one = S::one();
    // beyond 1 in t = 1/x, turned round
    if at.clone().abs() > one {
        let place = one / at;
        let is_inwards_up = !is_lower;
        if let Some(kind) = kind(&p.reversed(), &place, is_inwards_up, roots.iter().map(|r| S::one() / &r.value)) {
            insert(at, is_lower, kind, roots);
        }
    } else {
        check_inside(p, at, is_lower, roots);
    }
}

/// The same for an end in [−1, 1].
#[cold]
pub(super) fn check_inside<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    at: &S,
    is_lower: bool,
    roots: &mut Roots<S, N>,
) {
    if let Some(kind) = kind(p, at, is_lower, roots.iter().map(|r| r.value.clone())) {
        insert(at, is_lower, kind, roots);
    }
}

/// What is at `at`, besides the roots that are known; `None` if nothing is, or if they are what is there.
fn kind<S: Scalar, const N: usize>(
    p: &Polynomial<S, N>,
    at: &S,
    is_inwards_up: bool,
    mut known: impl Iterator<Item = S>,
) -> Option<RootKind> {
    let n = i32::try_from(ROUNDINGS * N).unwrap_or(i32::MAX);
    let noise = S::int(n) * &S::unit_roundoff() * &p.magnitude(at);
    let value = twofold::value(p, at);
    // nothing is said where this overflows
    if noise.partial_cmp(&value.clone().abs()).is_none_or(Ordering::is_lt) {
        return None;
    }
    let (_, slope, bend) = p.jet(at);
    // how far away a simple root is, and a double one, at most
    let simple = noise.clone() / &slope.clone().abs();
    let double = (noise / &bend.abs()).sqrt();
    let is_simple = simple <= double;
    // a simple root that makes p so small is within one of these, of two close to each other one may be farther away
    let reach = if is_simple { simple } else { double.mul_pow2(2) };
    if known.any(|x| (x - at).abs() <= reach) {
        return None;
    }
    // towards the inside a simple root would have been found
    let step = -(value / &slope);
    let is_outside = if is_inwards_up { step <= S::zero() } else { step >= S::zero() };
    match (is_simple, is_outside) {
        (true, true) => Some(RootKind::Simple),
        (true, false) => None,
        (false, _) => Some(RootKind::Cluster(2)),
    }
}

/// Inserts a root at an end.
fn insert<S: Scalar, const N: usize>(at: &S, is_lower: bool, kind: RootKind, roots: &mut Roots<S, N>) {
    let root = Root { value: at.clone(), lower: at.clone(), upper: at.clone(), kind };
    let place = if is_lower { 0 } else { roots.len() };
    // More roots than coefficients there cannot be: then this is one of those that are known.
    let _ = roots.try_insert(place, root);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn just_outside_is_at_the_end() {
        // 1 + 2⁻⁵² and 1 + 2⁻⁴⁰ beyond the end of [0, 1]
        let p = |gap: f64| Polynomial::new([-(1.0 + gap), 2.0 + gap, -1.0]); // (x − 1)(1 + gap − x)
        let none = p(2.0_f64.powi(-40)).roots_between(&0.0, &0.9).expect("finite");
        assert!(none.is_empty(), "{none:?}");
        let line = Polynomial::new([-1.0 - f64::EPSILON, 1.0]);
        let found = line.roots_in_unit().expect("finite");
        assert_eq!((found.len(), found[0].value, found[0].kind), (1, 1.0, RootKind::Simple));
        assert!(Polynomial::new([-1.0 - 1e-12, 1.0]).roots_in_unit().expect("finite").is_empty());
        let below = Polynomial::new([1.828_125_f64, 1.0]);
        let found = below.roots_between(&-1.828_125, &0.5).expect("finite");
        assert_eq!(found.len(), 1, "{found:?}");
        assert!((found[0].value + 1.828_125).abs() <= f64::EPSILON, "through reciprocals: {found:?}");
    }
}
