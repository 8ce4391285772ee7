//! Grading: the ratio of neighbouring gaps.
//!
//! Gaps that must grow by at most a factor G from one to the next are limited by a field with slope γ = 1 − 1/G: if the gap
//! after a point is at most g(p) and g grows by at most γ per length, neighbouring gaps differ by a factor of at most
//! 1/(1 − γ) = G. The field is the lower envelope of the gaps that all other bounds gave in a first pass: sweeps in both
//! directions along the path (twice around a closed one) make it.

use super::Sample;
use crate::geometry::Point;
use crate::scalar::Scalar;

/// One value of the field: the largest gap after a sample of the first pass.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct GapLimit<S> {
    /// Where.
    pub point: Point<S>,
    /// Segment of C, and parameter, to find it by.
    pub at: (u32, S),
    /// Largest gap.
    pub gap: S,
}

/// The slope of the field for a ratio; `tighten` in (0, 1] makes it flatter.
pub fn slope<S: Scalar>(ratio: &S, tighten: &S) -> S {
    (S::one() - &(S::one() / ratio)) * tighten
}

/// Lowers the limits until they rise by at most `slope` per length from one to the next.
pub fn smooth<S: Scalar>(limits: &mut [GapLimit<S>], closed: bool, slope: &S) {
    let n = limits.len();
    if n < 2 {
        return;
    }
    let rounds = if closed { 2 * n } else { n };
    let relax = |limits: &mut [GapLimit<S>], from: usize, to: usize| {
        let (Some(a), Some(b)) = (limits.get(from).cloned(), limits.get_mut(to)) else { return };
        let allowed = a.point.distance(&b.point) * slope + &a.gap;
        if allowed < b.gap {
            b.gap = allowed;
        }
    };
    for i in 1..rounds {
        relax(limits, (i - 1) % n, i % n);
    }
    for i in (1..rounds).rev() {
        relax(limits, i % n, (i - 1) % n);
    }
}

/// The field at a point near the limits `i` and `i` + 1.
pub fn value<S: Scalar>(limits: &[GapLimit<S>], i: usize, p: &Point<S>, slope: &S) -> Option<S> {
    let n = limits.len();
    let near = [i, (i + 1) % n.max(1)];
    near.iter().filter_map(|&j| limits.get(j)).map(|l| l.point.distance(p) * slope + &l.gap).reduce(Scalar::min)
}

/// The largest ratio of neighbouring gaps among consecutive samples; 1 where there are fewer than two gaps.
pub fn measure<S: Scalar>(samples: &[Sample<S>], closed: bool) -> S {
    let n = samples.len();
    let gap = |i: usize| {
        let (a, b) = (samples.get(i % n)?, samples.get((i + 1) % n)?);
        Some(a.point.distance(&b.point))
    };
    let gaps = if closed { n } else { n.saturating_sub(1) };
    let pairs = if closed { gaps } else { gaps.saturating_sub(1) };
    let mut worst = S::one();
    for i in 0..pairs {
        let (Some(a), Some(b)) = (gap(i), gap((i + 1) % n)) else { continue };
        let ratio = if a > b { a / &b } else { b / &a };
        if ratio > worst {
            worst = ratio;
        }
    }
    worst
}
