//! The closest point at one go: nine places are looked at, the best one is polished, and what comes out is proved.
//!
//! **Candidate.** From the best of nine places Euler's step (to the near zero of value, slope and bend of g, where g rises) leads
//! towards the bottom, and Halley's method to it, mostly in two steps.
//!
//! **Proof.** Let t be stationary, r = F'(t) ≈ 0. Then F(t + s) − F(t) = rs + s²Q(s) with a quartic Q, whose coefficients are inner
//! products of B − q and the derivatives of B at t. Where Q is positive on [−t, 1 − t], nothing on the curve is closer. The least
//! Bernstein coefficient of Q on a part of that is a lower bound of it; four parts, two on each side of t, mostly do, and where they do
//! not they are halved. Where Q comes out negative at an end of a part, that place is *closer*, and is the next one to start from. An
//! end of the curve is proved in the same way by F(t + s) − F(t) = sR(s), R of degree 5.
//!
//! Most queries take the same path through all this, so a processor foresees its branches; finding all zeros of g, or branch and
//! bound from the outset ([`branch`](super::branch)), cannot be foreseen. What is not proved here is left to that.
//!
//! **Rounding.** Let W be the sum of |B'|², |B''/2|² and the moduli of the coefficients of Q. Terms with B − q have errors of about
//! u|B − q|√W, which is below uW or below uF. Bernstein coefficients, twelve times too large, are off by less than 2⁸uW apart from
//! that. Asked for is g(t)² ≤ (16u)²W(W + F), hence |r| ≤ 32u(W + √(WF)), and coefficients above 2²⁰uW, or above 2¹⁰uW·W/Q(0) where
//! Q(0) is below 2⁻¹⁰W, down to 2⁻²⁰W. Then with σ = Q(0)/2W: for |s| ≤ σ, Q is above Q(0)/2, and F falls at most r²/2Q(0) below F(t),
//! as it may below any point that is stationary to the precision of r: by (32u)²(W + F)·W/Q(0), the square of some dozen roundings of
//! the curve's size where it is not flat there. For |s| > σ, |s|Q > 32uW pays for the first part of r, and the second takes
//! (32u)²WF/4Q at most: 2⁻⁸uF.

use super::Nearest;
use super::view::View;
use crate::bezier::PowerBasis;
use crate::buffer::Keep;
use crate::geometry::Point;
use crate::polynomial::Polynomial;
use crate::polynomial::bernstein;
use crate::polynomial::newton::{converge, quick_halley};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Stretches between the places that are looked at.
const STRETCHES: usize = 8;

/// Candidates tried for a query.
const CANDIDATES: usize = 3;

/// Parts waiting for their proof.
const PENDING: usize = 8;

/// Parts looked at.
const LOOKS: usize = 40;

/// With fewer bits hardly anything passes the bounds for rounding, and nothing is tried.
const FEWEST_BITS: u32 = 40;

/// What is known of a candidate.
enum Verdict<S> {
    /// Nothing is closer.
    Closest,
    /// This parameter may be closer.
    Closer(S),
    Unknown,
}

/// The closest point to q on [0, 1], or nothing where this way leads to no proof.
#[inline]
pub(super) fn proved<S: Scalar>(b: &PowerBasis<S>, q: &Point<S>) -> Option<Nearest<S>> {
    let view = View::new(b, q);
    let size = b.a.iter().fold(view.offset.norm_sq(), |sum, a| sum + &a.norm_sq());
    if S::BITS < FEWEST_BITS || !Polynomial::<S, 6>::is_comfortable(&size) {
        return None;
    }
    let mut from = view.best_place();
    for _ in 0..CANDIDATES {
        let t = view.bottom(&from)?;
        match view.judge(&t) {
            (Verdict::Closest, distance_sq) => return Some(Nearest { point: b.eval(&t), t, distance_sq }),
            (Verdict::Closer(place), _) => from = place,
            (Verdict::Unknown, _) => break,
        }
    }
    None
}

/// i/8.
#[inline]
#[allow(clippy::cast_possible_wrap, clippy::cast_possible_truncation, reason = "i ≤ 8")]
fn place<S: Scalar>(i: usize) -> S {
    S::int(i as i32).mul_pow2(-3)
}

impl<S: Scalar> View<'_, S> {
    /// Where F is least among 0, 1/8, …, 1.
    #[inline]
    fn best_place(&self) -> S {
        let values: [S; STRETCHES + 1] = core::array::from_fn(|i| self.distance_sq(&place(i)));
        // In pairs: a processor finds four minima at a time.
        let [a, b, c, d, e, f, g, h, i] = values.clone();
        let least = a.min(b).min(c.min(d)).min(e.min(f).min(g.min(h))).min(i);
        let found = values.iter().enumerate().fold(0, |set, (i, v)| set | u32::from(*v == least) << i);
        place((found.trailing_zeros() as usize).min(STRETCHES))
    }

    /// Where F stops falling, from a place on: a zero of g or an end; nothing where the way there is unclear.
    #[inline]
    fn bottom(&self, from: &S) -> Option<S> {
        let (value, slope, bend) = self.slope(from);
        if (*from <= S::zero() && value >= S::zero()) || (*from >= S::one() && value <= S::zero()) {
            return Some(from.clone());
        }
        let width = place(1);
        let (lo, hi) = ((from.clone() - &width).max(S::zero()), (from.clone() + &width).min(S::one()));
        let mut start = from.clone() - &euler(&value, &slope, &bend);
        if !(lo < start && start < hi) {
            start = self.next_start(from, &value, &lo, &hi)?;
        }
        let resolution = S::unit_roundoff().twice() * &hi;
        converge(|t| self.slope(t), quick_halley, (lo, hi), start, |_| resolution.clone()).ok()
    }

    /// Euler's step from half a stretch further down, and a quarter from there: where g does not rise yet, the first one fails.
    #[cold]
    fn next_start(&self, from: &S, value: &S, lo: &S, hi: &S) -> Option<S> {
        let (mut at, mut falls, mut step) = (from.clone(), *value < S::zero(), place::<S>(1).half());
        for _ in 0..2 {
            at = if falls { at + &step } else { at - &step };
            let (value, slope, bend) = self.slope(&at);
            let start = at.clone() - &euler(&value, &slope, &bend);
            if *lo < start && start < *hi {
                return Some(start);
            }
            (falls, step) = (value < S::zero(), step.half());
        }
        None
    }

    /// Whether nothing on [0, 1] is closer than B(t), t stationary or an end; with F(t).
    #[inline]
    fn judge(&self, t: &S) -> (Verdict<S>, S) {
        let [_, _, a3] = &self.basis.a;
        let (away, velocity, bend) = self.jet(t);
        let (value, distance_sq) = (away.dot(&velocity), away.norm_sq());
        let (speed, curl) = (velocity.norm_sq(), bend.norm_sq());
        let c = [
            speed.clone() + &away.dot(&bend).twice(),
            (away.dot(a3) + &velocity.dot(&bend)).twice(),
            curl.clone() + &velocity.dot(a3).twice(),
            bend.dot(a3).twice(),
            a3.norm_sq(),
        ];
        let weight = c.iter().fold(speed + &curl, |sum, c| sum + &c.clone().abs());
        let floor = S::unit_roundoff().mul_pow2(20) * &weight;
        let rest = S::one() - t;
        let verdict = if *t <= S::zero() || rest <= S::zero() {
            let slope = value.twice();
            let [c0, c1, c2, c3, c4] = c;
            let (c, inwards) = if *t <= S::zero() {
                ([slope, c0, c1, c2, c3, c4], S::one())
            } else {
                ([-slope, c0, -c1, c2, -c3, c4], -S::one())
            };
            judge_part(bernstein::on_unit(&c), t, &inwards, &floor)
        } else {
            let flat = weight.clone().mul_pow2(-10);
            let noise = S::unit_roundoff().mul_pow2(4);
            let is_stationary = value.square() <= noise.square() * &weight * &(weight.clone() + &distance_sq);
            let is_steep = c[0] >= flat.clone().mul_pow2(-10);
            if !(is_stationary & is_steep) {
                return (Verdict::Unknown, distance_sq);
            }
            judge_sides(&c, t, &rest, &(floor * &(flat / &c[0]).max(S::one())))
        };
        (verdict, distance_sq)
    }
}

/// Euler's step: the zero of value + slope·d + bend·d² in −d where it rises; NaN where it has none.
#[inline]
fn euler<S: Scalar>(value: &S, slope: &S, bend: &S) -> S {
    let root = (slope.clone().square() - &(value.clone() * bend).mul_pow2(2)).sqrt();
    value.clone().twice() / &(root + slope)
}

/// The verdict where the polynomial with coefficients c, in s, must be above `floor` on [−t, rest].
#[inline]
fn judge_sides<S: Scalar>(c: &[S; 5], t: &S, rest: &S, floor: &S) -> Verdict<S> {
    let back = -t.clone();
    let halves = |width: &S| {
        let mut outer = bernstein::on_unit(&stretched(c, width));
        let mut inner = outer.clone();
        bernstein::halve(&mut outer, &mut inner);
        [inner, outer]
    };
    let (before, after) = (halves(&back), halves(rest));
    let least = |[inner, outer]: &[[S; 5]; 2]| {
        inner.iter().zip(outer).fold(S::infinity(), |least, (a, b)| least.min(a.clone().min(b.clone())))
    };
    if (least(&before) > *floor) & (least(&after) > *floor) {
        return Verdict::Closest;
    }
    judge_halves(before, t, &back, floor).or_else(|| judge_halves(after, t, rest, floor))
}

/// The same for the two halves of a side that begins at t.
#[cold]
fn judge_halves<S: Scalar>([inner, outer]: [[S; 5]; 2], t: &S, width: &S, floor: &S) -> Verdict<S> {
    let half = width.clone().half();
    judge_part(inner, t, &half, floor).or_else(|| judge_part(outer, &(half.clone() + t), &half, floor))
}

/// The verdict where the polynomial with these Bernstein coefficients on [start, start + width] must be above `floor`.
fn judge_part<S: Scalar, const N: usize>(b: [S; N], start: &S, width: &S, floor: &S) -> Verdict<S> {
    let mut pending: ArrayVec<([S; N], S, S), PENDING> = ArrayVec::new();
    pending.keep((b, start.clone(), width.clone()));
    for _ in 0..LOOKS {
        let Some((right, start, width)) = pending.last_mut() else { return Verdict::Closest };
        if right.iter().all(|v| v > floor) {
            pending.truncate(pending.len().saturating_sub(1));
            continue;
        }
        if right.first().is_none_or(|v| v <= floor) {
            return Verdict::Closer(start.clone());
        }
        if right.last().is_none_or(|v| v <= floor) {
            return Verdict::Closer(start.clone() + &*width);
        }
        let mut left = right.clone();
        bernstein::halve(right, &mut left);
        *width = width.clone().half();
        let left = (left, start.clone(), width.clone());
        *start = start.clone() + &*width;
        if pending.try_push(left).is_err() {
            break;
        }
    }
    Verdict::Unknown
}

impl<S> Verdict<S> {
    /// The verdict of two parts.
    #[inline]
    fn or_else(self, other: impl FnOnce() -> Self) -> Self {
        if matches!(self, Self::Closest) { other() } else { self }
    }
}

/// The coefficients, in s, of the polynomial with coefficients c at ws.
#[inline]
fn stretched<S: Scalar, const N: usize>(c: &[S; N], w: &S) -> [S; N] {
    let mut power = S::one();
    c.clone().map(|c| {
        let scaled = c * &power;
        power = power.clone() * w;
        scaled
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Cubic;
    use crate::bezier::nearest::branch;

    fn random(state: &mut u64) -> f64 {
        *state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*state >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn points(state: &mut u64) -> (PowerBasis<f64>, Point<f64>) {
        let mut point = || Point::new(random(state), random(state));
        (Cubic::new(point(), point(), point(), point()).power_basis(), point())
    }

    #[test]
    fn proved_answers_are_those_of_branch_and_bound() {
        let (mut state, mut count) = (7, 0);
        for _ in 0..20_000 {
            let (b, q) = points(&mut state);
            let Some(found) = proved(&b, &q) else { continue };
            count += 1;
            let other = branch::on_unit(&b, &q);
            // B(t) itself is rounded
            let excess = found.distance_sq.sqrt() - other.distance_sq.sqrt();
            assert!(excess.abs() <= 4e-15, "{found:?} {other:?}");
        }
        assert!(count > 19_900, "the survey settles nearly everything: {count}");
    }

    /// Every stationary point but the closest, and places that are not even stationary, are refused.
    #[test]
    fn no_other_point_is_proved() {
        let (mut state, mut minima, mut others) = (11, 0, 0);
        for _ in 0..5_000 {
            let (b, q) = points(&mut state);
            let view = View::new(&b, &q);
            let least = branch::on_unit(&b, &q).distance_sq;
            let zeros = crate::bezier::nearest::critical_points(&b, &q);
            for t in zeros.into_iter().chain([0.0, 1.0, random(&mut state)]) {
                let (verdict, value) = view.judge(&t);
                if value > least * (1.0 + 1e-12) {
                    assert!(!matches!(verdict, Verdict::Closest), "{b:?} {q:?} {t}");
                    others += 1;
                    minima += i32::from(view.slope(&t).1 > 0.0);
                }
            }
        }
        assert!(others > 10_000 && minima > 1_000, "{others} places, {minima} of them where g rises");
    }

    #[test]
    fn two_equally_close_points_are_left_to_branch_and_bound() {
        let p = |x: f64, y: f64| Point::new(x, y);
        let b = Cubic::new(p(0.0, 0.0), p(0.0, 4.0), p(3.0, 4.0), p(3.0, 0.0)).power_basis();
        assert!(proved(&b, &p(1.5, 1.0)).is_none());
    }
}
