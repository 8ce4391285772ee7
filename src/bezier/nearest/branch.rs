//! The closest point by branch and bound on the Bernstein form of g, the quintic that is half the derivative of F.
//!
//! * no sign variation: F is monotone, the ends of the piece have it;
//! * one variation from + to −: a maximum, the ends have it again;
//! * one variation from − to +: one minimum, found by Halley's method in the bracket;
//! * anywhere, F has the degree-6 Bernstein coefficients Fᵢ₊₁ = Fᵢ + h gᵢ/3 (gᵢ those of g, h the length of the piece),
//!   whose least is a lower bound of F on the piece: if it is not below the best value so far, the piece is done.
//!
//! Splitting points are evaluated and are candidates themselves, so the bound is good from the start. Near centres of
//! curvature g has nearly multiple roots, where root finders lose or misplace solutions; here F is flat there, the bound
//! closes after a few halvings, and every answer is the value of F at a point of the curve.
//!
//! **Noise.** Signs of coefficients within their rounding error say nothing. Where one matters, g is written anew from the
//! curve on the stretch in question, where its errors are in proportion to the stretch, and halving goes on until what is
//! left of them cannot matter.

use super::view::View;
use super::{Nearest, distance_quintic};
use crate::bezier::PowerBasis;
use crate::buffer::Keep;
use crate::geometry::Point;
use crate::polynomial::Polynomial;
use crate::polynomial::bernstein::{self, Signs};
use crate::polynomial::newton::{careful_halley, in_bracket, quick_halley};
use crate::scalar::Scalar;
use arrayvec::ArrayVec;

/// Pieces waiting. Depth first: one for each halving; what does not fit is left at the value of its ends.
const PENDING: usize = 64;

/// The closest point to q with parameter in [0, 1].
#[cold]
pub(super) fn on_unit<S: Scalar>(b: &PowerBasis<S>, q: &Point<S>) -> Nearest<S> {
    let search = Search::new(b, q);
    let g = bernstein::on_unit(&search.quintic.coefficients);
    search.search(g, S::zero(), S::one())
}

/// The closest point to q with parameter in [t0, t1]; where t0 ≥ t1, the point at t0.
pub(super) fn between<S: Scalar>(b: &PowerBasis<S>, q: &Point<S>, t0: &S, t1: &S) -> Nearest<S> {
    let search = Search::new(b, q);
    if t0 < t1 {
        let g = bernstein::on_interval(&search.quintic, t0, t1);
        search.search(g, t0.clone(), t1.clone())
    } else {
        search.answer(t0.clone(), search.view.distance_sq(t0))
    }
}

/// A search for the least F.
struct Search<'b, S> {
    view: View<'b, S>,
    quintic: Polynomial<S, 6>,
    /// Bound of the error of the quintic's Bernstein coefficients, times 10, on [0, 1] or a part of it.
    noise: S,
    /// Products of two numbers of the size of the quintic's coefficients stay in the scalar's range.
    is_tame: bool,
}

/// A stretch that may hold a minimum below the best value so far.
#[derive(Clone)]
struct Stretch<S> {
    /// Bernstein coefficients of g, times 10.
    g: [S; 6],
    /// Bound of their error.
    noise: S,
    lo: S,
    hi: S,
    /// F(lo).
    start: S,
    /// Lower bound of F.
    floor: S,
}

impl<'b, S: Scalar> Search<'b, S> {
    #[inline]
    fn new(basis: &'b PowerBasis<S>, q: &Point<S>) -> Self {
        let quintic = distance_quintic(basis, q);
        let weight = quintic.weight();
        let is_tame = Polynomial::<S, 6>::is_comfortable(&weight);
        Self { view: View::new(basis, q), quintic, noise: noise(&weight), is_tame }
    }

    #[inline]
    fn answer(&self, t: S, distance_sq: S) -> Nearest<S> {
        Nearest { point: self.view.basis.eval(&t), t, distance_sq }
    }

    /// Branch and bound on [lo, hi], with the Bernstein coefficients of g there.
    #[inline]
    fn search(&self, g: [S; 6], lo: S, hi: S) -> Nearest<S> {
        let (start, end) = (self.view.distance_sq(&lo), self.view.distance_sq(&hi));
        let mut best = if end < start { (hi.clone(), end) } else { (lo.clone(), start.clone()) };
        // the last one is looked at next
        let mut pending: ArrayVec<Stretch<S>, PENDING> = ArrayVec::new();
        pending.keep(Stretch { g, noise: self.noise.clone(), lo, hi, start, floor: S::zero() });
        if let Some(stretch) = pending.last_mut()
            && !self.look(stretch, &mut best)
        {
            return self.answer(best.0, best.1);
        }
        for _ in 0..16 * S::BITS {
            let Some(right) = pending.last_mut() else { break };
            let mid = S::midpoint(&right.lo, &right.hi);
            if !(right.floor < worthwhile(&best.1) && right.lo < mid && mid < right.hi) {
                pending.truncate(pending.len().saturating_sub(1));
                continue;
            }
            let value = self.view.distance_sq(&mid);
            if value < best.1 {
                best = (mid.clone(), value.clone());
            }
            let mut left = Stretch {
                g: right.g.clone(),
                noise: right.noise.clone(),
                lo: right.lo.clone(),
                hi: mid.clone(),
                start: right.start.clone(),
                floor: S::zero(),
            };
            bernstein::halve(&mut right.g, &mut left.g);
            (right.lo, right.start) = (mid, value);
            let is_left_open = self.look(&mut left, &mut best);
            let is_right_open = self.look(right, &mut best);
            match (is_left_open, is_right_open) {
                (false, false) => pending.truncate(pending.len().saturating_sub(1)),
                (false, true) => {}
                (true, false) => *right = left,
                (true, true) => {
                    // the more promising one on top
                    if left.floor > right.floor {
                        core::mem::swap(&mut left, right);
                    }
                    if pending.is_full() {
                        pending.retain(|waiting| waiting.floor < worthwhile(&best.1));
                    }
                    // What finds no room is left at the value of its ends.
                    let _ = pending.try_push(left);
                }
            }
        }
        self.answer(best.0, best.1)
    }

    /// Settles a stretch if it is monotone, cannot beat the best, or holds just one extremum; otherwise notes the lower
    /// bound of F on it and answers that it must be halved. `best` is (t, F(t)).
    #[inline]
    fn look(&self, stretch: &mut Stretch<S>, best: &mut (S, S)) -> bool {
        // the common case, all signs known, in few steps
        let (mut least, mut negative) = (S::infinity(), 0_u32);
        for (i, g) in stretch.g.iter().enumerate() {
            least = g.clone().abs().min(least);
            negative |= u32::from(*g < S::zero()) << i;
        }
        let mut is_known = least > stretch.noise;
        if !is_known {
            let (signs, is_certain) = self.look_closer(stretch, best);
            negative = signs.negative;
            is_known = signs.decided() == Signs::full::<6>();
            if is_certain && (signs.positive == 0 || signs.negative == 0) {
                return false;
            }
        }
        let positive = Signs::full::<6>() & !negative;
        // F only rises, only falls, or rises to a maximum and falls: the ends have the least value
        if is_known && positive & (positive + 1) == 0 {
            return false;
        }
        let one_minimum = is_known && negative & (negative + 1) == 0;
        let width = stretch.hi.clone() - &stretch.lo;
        let (mut sum, mut least) = (S::zero(), S::zero());
        for g in &stretch.g {
            sum = sum + g;
            if sum < least {
                least = sum.clone();
            }
        }
        // F₀ + h Σ gᵢ/3; the coefficients are ten times too large
        let floor = (least * &S::ratio(1, 30) - &stretch.noise) * &width + &stretch.start;
        if floor >= worthwhile(&best.1) {
            return false;
        }
        if !one_minimum {
            stretch.floor = floor;
            return true;
        }
        let start = bernstein::polygon_zero(&stretch.g, negative.trailing_ones() - 1, &stretch.lo, &stretch.hi);
        let resolution = S::unit_roundoff().twice() * &stretch.hi;
        let step = |value: &S, slope: &S, bend: &S| {
            if self.is_tame { quick_halley(value, slope, bend) } else { careful_halley(value, slope, bend) }
        };
        let zero = in_bracket(
            |t| self.view.slope(t),
            step,
            (stretch.lo.clone(), stretch.hi.clone()),
            start,
            |_| resolution.clone(),
        );
        let value = self.view.distance_sq(&zero);
        if value < best.1 {
            *best = (zero, value);
        }
        false
    }
}

impl<S: Scalar> Search<'_, S> {
    /// The signs of a stretch some of whose coefficients are noise, and whether they can be relied on.
    ///
    /// F cannot fall below what these signs promise by more than noise times width. Where that is more than a few roundings
    /// of the best value so far, g is written anew from the curve on this stretch alone: its noise is then in proportion to
    /// the distances and the length of the stretch, not to the size of the curve. What is still undecided then is not
    /// relied on; halves of it are smaller, and their noise falls with the square of their size. (Found by random bytes: a
    /// query 1e-9 beside the end of a stroke of length 30 with a retracted handle, answered 4e-10 too far.)
    #[cold]
    fn look_closer(&self, stretch: &mut Stretch<S>, best: &(S, S)) -> (Signs, bool) {
        let width = stretch.hi.clone() - &stretch.lo;
        let allowed = S::unit_roundoff().mul_pow2(2) * &best.1;
        let is_harmless = |noise: &S| noise.clone() * &width <= allowed;
        if !is_harmless(&stretch.noise) {
            let mut scale = S::one();
            let a = self.view.basis.taylor(&stretch.lo).map(|v| {
                scale = scale.clone() * &width;
                v.scaled(&scale)
            });
            // with the query at the origin
            let start = self.view.away(&stretch.lo);
            let local = PowerBasis { origin: Point::new(start.x, start.y), a };
            let quintic = distance_quintic(&local, &Point::new(S::zero(), S::zero()));
            stretch.g = bernstein::on_unit(&quintic.coefficients).map(|c| c / &width);
            stretch.noise = noise(&quintic.weight()) / &width;
        }
        if is_harmless(&stretch.noise) {
            return (Signs::of(&stretch.g, &S::zero()), true);
        }
        let signs = Signs::of(&stretch.g, &stretch.noise);
        (signs, signs.decided() == Signs::full::<6>())
    }
}

/// Bound of the error of the Bernstein coefficients, times 10, of a quintic on [0, 1] or a part of it; Σ|cⱼ| is its weight.
#[inline]
fn noise<S: Scalar>(weight: &S) -> S {
    S::unit_roundoff().mul_pow2(7) * weight
}

/// Below this a value is an improvement of more than a few roundings.
#[inline]
fn worthwhile<S: Scalar>(best: &S) -> S {
    let gain = S::one() - &S::unit_roundoff().mul_pow2(2);
    gain * best
}
