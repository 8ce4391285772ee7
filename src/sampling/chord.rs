//! Chord error: how far a stretch of curve strays from the straight segment between its ends.
//!
//! Exact up to rounding: over one cubic the distance from the chord's line is extremal at its ends and where B' is parallel to
//! the chord (a quadratic). Only where the piece reaches beyond the chord's ends can the distance from an end point count:
//! its extrema are roots of the closest-point quintic. A scalar of few bits is a chip's, and has no room for a root finder: there
//! a piece that reaches beyond its chord by a, and is off its line by b, gets √(a² + b²), which is too much by √2 at most.

use super::run::{Pos, Run};
use crate::bezier::PowerBasis;
use crate::geometry::{Point, Vector, distance_sq_to_segment};
use crate::polynomial::Polynomial;
use crate::scalar::Scalar;

/// Largest distance of the run between `a` and `b` from the straight segment between these two points.
pub fn chord_error<S: Scalar>(run: &Run<'_, S>, a: &Pos<S>, b: &Pos<S>) -> S {
    let (from, to) = (run.point(a), run.point(b));
    let mut worst = S::zero();
    for k in a.k..=b.k {
        let Some(segment) = run.segment(k) else { break };
        let t0 = if k == a.k { a.t.clone() } else { S::zero() };
        let t1 = if k == b.k { b.t.clone() } else { S::one() };
        let piece = piece_error_sq(&segment.power, &t0, &t1, &from, &to);
        if piece > worst {
            worst = piece;
        }
    }
    worst.sqrt()
}

/// The square of the largest distance of B([t0, t1]) from the segment from–to.
pub fn piece_error_sq<S: Scalar>(power: &PowerBasis<S>, t0: &S, t1: &S, from: &Point<S>, to: &Point<S>) -> S {
    let mut worst = S::zero();
    let chord = to.minus(from);
    let length_sq = chord.norm_sq();
    // A loop that ends where it starts reaches beyond both ends, in any direction.
    let (along, unit_sq) =
        if length_sq.is_zero() { (Vector::new(S::one(), S::zero()), S::one()) } else { (chord, length_sq.clone()) };
    let (mut reach, mut width) = (S::zero(), S::zero());
    let mut look = |t: &S| {
        let p = power.eval(t);
        worst = worst.clone().max(distance_sq_to_segment(&p, from, to));
        let p = p.minus(from);
        let x = p.dot(&along);
        reach = reach.clone().max(x.clone() - &length_sq).max(-x);
        width = width.clone().max(p.cross(&along).abs());
    };
    look(t0);
    look(t1);
    // n·B'(t) = 0 and, for the reach along the chord, c·B'(t) = 0.
    for direction in [along.left(), along.clone()] {
        for t in stationary(power, &direction).into_iter().flatten() {
            if t > *t0 && t < *t1 {
                look(&t);
            }
        }
    }
    if reach > S::zero() {
        if S::BITS <= f32::MANTISSA_DIGITS {
            return worst.max((reach.square() + &width.square()) / &unit_sq);
        }
        for end in [from, to] {
            for t in farthest(power, end, t0, t1) {
                worst = worst.max(distance_sq_to_segment(&power.eval(&t), from, to));
            }
        }
    }
    worst
}

/// Real roots of d·B'(t), at most two.
fn stationary<S: Scalar>(power: &PowerBasis<S>, d: &Vector<S>) -> [Option<S>; 2] {
    let [a1, a2, a3] = &power.a;
    let (c, b, a) = (d.dot(a1), d.dot(a2).twice(), d.dot(a3) * &S::int(3));
    let scale = a.clone().abs().max(b.clone().abs()).max(c.clone().abs());
    if scale.is_zero() {
        return [None, None];
    }
    let (a, b, c) = (a / &scale, b / &scale, c / &scale);
    let discriminant = b.clone().square() - &(a.clone() * &c * &S::int(4));
    if discriminant < S::zero() {
        return [None, None];
    }
    // The root of larger size first, the other one from the product of both: no cancellation.
    let root = discriminant.sqrt();
    let q = if b < S::zero() { root - &b } else { -(root + &b) }.half();
    let first = (!a.is_zero()).then(|| q.clone() / &a).filter(Scalar::is_finite);
    let second = (!q.is_zero()).then(|| c / &q).filter(Scalar::is_finite);
    [first, second]
}

/// Inner parameters where the distance from a point is extremal.
fn farthest<S: Scalar>(power: &PowerBasis<S>, p: &Point<S>, t0: &S, t1: &S) -> impl Iterator<Item = S> + use<S> {
    let [a1, a2, a3] = &power.a;
    let a0 = power.origin.minus(p);
    let (two, three) = (S::int(2), S::int(3));
    // (B − p)·B', ascending.
    let polynomial = Polynomial::new([
        a0.dot(a1),
        a1.norm_sq() + &(a0.dot(a2) * &two),
        a1.dot(a2) * &three + &(a0.dot(a3) * &three),
        a1.dot(a3) * &S::int(4) + &(a2.norm_sq() * &two),
        a2.dot(a3) * &S::int(5),
        a3.norm_sq() * &three,
    ]);
    polynomial.roots_inside(t0, t1, &S::zero()).into_iter().flatten().map(|r| r.value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bezier::Cubic;

    fn errors(p: [(f32, f32); 4]) -> (f64, f64) {
        let [a, b, c, d] = p.map(|(x, y)| Point::new(x, y));
        let [e, f, g, h] = p.map(|(x, y)| Point::new(f64::from(x), f64::from(y)));
        let small = piece_error_sq(&Cubic::new(a, b, c, d).power_basis(), &0.0, &1.0, &a, &d);
        let exact = piece_error_sq(&Cubic::new(e, f, g, h).power_basis(), &0.0, &1.0, &e, &h);
        (f64::from(small).sqrt(), exact.sqrt())
    }

    /// The largest distance of a row of points.
    fn reference(p: [(f32, f32); 4]) -> f64 {
        let [a, b, c, d] = p.map(|(x, y)| Point::new(f64::from(x), f64::from(y)));
        let power = Cubic::new(a, b, c, d).power_basis();
        let distance_sq = |k: u32| distance_sq_to_segment(&power.eval(&(f64::from(k) / 1e4)), &a, &d);
        (0..=10_000).map(distance_sq).fold(0.0, f64::max).sqrt()
    }

    #[test]
    fn a_loop_that_ends_where_it_starts_is_not_flat() {
        let drop = [(1.0, 1.0), (5.0, 4.0), (-3.0, 4.0), (1.0, 1.0)];
        let (small, exact) = errors(drop);
        assert!((exact - reference(drop)).abs() < 1e-6 && exact > 2.0, "{exact}");
        assert!(small >= exact && small <= 1.5 * exact, "{small} for {exact}");
    }

    #[test]
    fn few_bits_are_above_and_by_less_than_the_root_of_two() {
        let mut seed = 7_u32;
        let mut random = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (seed >> 8) as f32 / 16_777_216.0
        };
        let mut beyond = 0;
        for _ in 0..2000 {
            let p: [(f32, f32); 4] = core::array::from_fn(|_| (random(), random()));
            let ((small, exact), truth) = (errors(p), reference(p));
            assert!((exact - truth).abs() <= 1e-6 && exact >= truth - 1e-12, "{exact} for {truth}: {p:?}");
            assert!(small >= exact * (1.0 - 1e-5) && small <= exact * 1.4143, "{small} for {exact}: {p:?}");
            beyond += u32::from(small > exact * 1.001);
        }
        assert!(beyond > 50, "{beyond} reach beyond their chords");
    }
}
