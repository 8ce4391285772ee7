//! Is an angle at least 90 degrees? Exactly.
//!
//! The angle at p between a and b is at least 90° where (a − p)·(b − p) ≤ 0. Squares and pixel outlines have exact right
//! angles, so the sign is worked out without error: first in plain arithmetic with a bound of its rounding error, and where
//! that leaves it open from an exact expansion (Dekker 1971, Shewchuk 1997): each difference is two doubles, each of the
//! two products of differences eight, and the sum of sixteen doubles is kept as a non-overlapping expansion whose last
//! non-zero component has the sign.

use std::cmp::Ordering;

use feature_sampling::geometry::Point;

/// The sign of (a − p)·(b − p): negative where the angle at p is obtuse, zero where it is a right angle.
///
/// Exact unless a product of coordinates underflows, which takes differences below 2^−450.
pub fn dot_sign(p: Point<f64>, a: Point<f64>, b: Point<f64>) -> Ordering {
    let (ux, uy, vx, vy) = (a.x - p.x, a.y - p.y, b.x - p.x, b.y - p.y);
    let (s, t) = (ux * vx, uy * vy);
    // Each product carries at most three roundings, the sum one more: 4·2^−53, with a margin.
    let error = (s.abs() + t.abs()) * (8.0 * 2.0_f64.powi(-53));
    let dot = s + t;
    if dot.abs() > error { dot.total_cmp(&0.0) } else { exact(p, a, b) }
}

/// The angle at p between a and b is at least 90 degrees.
pub fn is_wide(p: Point<f64>, a: Point<f64>, b: Point<f64>) -> bool {
    dot_sign(p, a, b) != Ordering::Greater
}

#[cold]
fn exact(p: Point<f64>, a: Point<f64>, b: Point<f64>) -> Ordering {
    let mut sum = Expansion { parts: [0.0; 16], len: 0 };
    for (u, v) in [(two_sum(a.x, -p.x), two_sum(b.x, -p.x)), (two_sum(a.y, -p.y), two_sum(b.y, -p.y))] {
        for x in [u.0, u.1] {
            for y in [v.0, v.1] {
                let high = x * y;
                sum.add(x.mul_add(y, -high));
                sum.add(high);
            }
        }
    }
    sum.sign()
}

/// a + b as the rounded sum and its error.
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let of_b = sum - a;
    (sum, (a - (sum - of_b)) + (b - of_b))
}

/// A sum of doubles without rounding, in non-overlapping parts of increasing size.
struct Expansion {
    parts: [f64; 16],
    len: usize,
}

impl Expansion {
    /// Shewchuk's Grow-Expansion.
    fn add(&mut self, value: f64) {
        let mut carry = value;
        for part in self.parts.iter_mut().take(self.len) {
            let (sum, error) = two_sum(carry, *part);
            *part = error;
            carry = sum;
        }
        if let Some(place) = self.parts.get_mut(self.len) {
            *place = carry;
            self.len += 1;
        }
    }

    fn sign(&self) -> Ordering {
        let parts = self.parts.iter().take(self.len).rev();
        parts
            .map(|part| part.partial_cmp(&0.0).unwrap_or(Ordering::Equal))
            .find(|sign| sign.is_ne())
            .unwrap_or(Ordering::Equal)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sign(p: (f64, f64), a: (f64, f64), b: (f64, f64)) -> Ordering {
        let point = |(x, y)| Point::new(x, y);
        dot_sign(point(p), point(a), point(b))
    }

    #[test]
    fn right_angles_are_right() {
        assert_eq!(sign((0.1, 0.1), (0.3, 0.1), (0.1, 0.7)), Ordering::Equal, "along the axes");
        // 3-4-5, far from the origin: exact coordinates, rounded products.
        let far = 2.0_f64.powi(40);
        assert_eq!(sign((far, far), (far + 3.0, far + 4.0), (far - 4.0, far + 3.0)), Ordering::Equal, "turned");
        let tiny = 2.0_f64.powi(-12);
        assert_eq!(
            sign((far, far), (far + 3.0, far + 4.0), (far - 4.0, far + 3.0 + tiny)),
            Ordering::Greater,
            "a bit acute"
        );
        assert_eq!(
            sign((far, far), (far + 3.0, far + 4.0), (far - 4.0, far + 3.0 - tiny)),
            Ordering::Less,
            "a bit obtuse"
        );
    }

    #[test]
    fn agrees_with_integers() {
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            i64::try_from(state >> 33).expect("31 bits") - (1 << 30)
        };
        for k in 0..2000 {
            let (p, u) = ((next(), next()), (next(), next()));
            // A vector nearly at a right angle with u.
            let v = (-u.1 + k % 3 - 1, u.0);
            let exact = i128::from(u.0) * i128::from(v.0) + i128::from(u.1) * i128::from(v.1);
            #[allow(clippy::cast_precision_loss, reason = "all below 2^53")]
            let float = |x: i64, y: i64| (x as f64 / 1024.0, y as f64 / 1024.0);
            let found = sign(float(p.0, p.1), float(p.0 + u.0, p.1 + u.1), float(p.0 + v.0, p.1 + v.1));
            assert_eq!(found, exact.cmp(&0), "case {k}");
        }
    }
}
