//! Are certified answers true? Each is a statement about exact numbers of roots, so Sturm's theorem says yes or no, without any
//! slack.

use crate::dyadic::Dyadic;
use crate::judge::{Interval, Judge};
use feature_sampling::polynomial::{Certified, Holds};

/// The first false statement among these about the roots in an interval, in words.
pub fn refuted(judge: &Judge, found: &[Certified<f64>], within: &Interval) -> Option<String> {
    let mut from = within.lo.clone();
    // the place where the next gap begins belongs to it
    let mut is_closed = true;
    for (i, root) in found.iter().enumerate() {
        let ordered = root.lower <= root.value && root.value <= root.upper;
        let apart = found.get(i + 1).is_none_or(|next| root.upper <= next.lower);
        let Some(bracket) = Interval::between(root.lower, root.upper).filter(|_| ordered && apart) else {
            return Some(format!("bracket {i} is out of order"));
        };
        let count = judge.count(&bracket);
        let is_true = match root.holds {
            Holds::One => count == 1,
            Holds::Odd => count % 2 == 1,
            Holds::Even => count.is_multiple_of(2),
            Holds::Unknown => true,
        };
        if !is_true {
            return Some(format!("bracket {i} holds {count} roots"));
        }
        if roots_in_gap(judge, &from, is_closed, &bracket.lo, false) > 0 {
            return Some(format!("a root before bracket {i}"));
        }
        if bracket.hi >= from {
            from = bracket.hi;
            is_closed = false;
        }
    }
    (roots_in_gap(judge, &from, is_closed, &within.hi, true) > 0).then(|| "a root after the last bracket".to_owned())
}

/// Roots between two places, with the places themselves where they belong to it.
fn roots_in_gap(judge: &Judge, from: &Dyadic, with_from: bool, to: &Dyadic, with_to: bool) -> usize {
    let all = judge.count_distinct(&Interval { lo: from.clone(), hi: to.clone() });
    let ends = [(from, with_from), (to, with_to)];
    let cut = if from == to { !(with_from && with_to) && judge.is_root(from) } else { false };
    if from >= to {
        return all - usize::from(cut && all > 0);
    }
    all - ends.into_iter().filter(|(end, with)| !with && judge.is_root(end)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn one(lower: f64, upper: f64) -> Certified<f64> {
        Certified { value: lower, lower, upper, holds: Holds::One }
    }

    #[test]
    fn false_statements_are_refuted() {
        // (x − ¼)(x − ¾)(x + 2), times 16
        let judge = Judge::new(&[6.0, -29.0, 16.0, 16.0]).expect("not zero");
        let unit = Interval::between(0.0, 1.0).expect("finite");
        let (a, b) = (one(0.2, 0.3), one(0.7, 0.8));
        assert_eq!(refuted(&judge, &[a, b], &unit), None);
        assert!(refuted(&judge, &[a], &unit).is_some_and(|cause| cause.contains("after")));
        assert!(refuted(&judge, &[b], &unit).is_some_and(|cause| cause.contains("before")));
        assert!(refuted(&judge, &[], &unit).is_some());
        assert!(refuted(&judge, &[b, a], &unit).is_some());
        assert!(refuted(&judge, &[one(0.2, 0.8)], &unit).is_some_and(|cause| cause.contains("2 roots")));
        assert_eq!(refuted(&judge, &[Certified { holds: Holds::Even, ..one(0.2, 0.8) }], &unit), None);
        assert!(refuted(&judge, &[Certified { holds: Holds::Odd, ..one(0.2, 0.8) }], &unit).is_some());
        assert!(refuted(&judge, &[a, one(0.4, 0.5), b], &unit).is_some(), "no root there");
    }
}
