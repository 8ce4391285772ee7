//! Bytes of a fuzzer, read as polynomials and curves.
//!
//! A fuzzer changes bytes; every string of bytes has to mean something, near strings should mean near things, and the first
//! byte chooses among families so that interesting ones (exact multiple roots, clusters, extreme sizes) are a few bits away
//! instead of a miracle. Bytes that are missing count as zero.

use crate::solve::{expanded, expanded_integers};
use feature_sampling::bezier::Cubic;
use feature_sampling::bezier::nearest::distance_quintic;
use feature_sampling::geometry::Point;

/// Bytes to take numbers from.
#[derive(Clone, Debug)]
pub struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    /// From the first byte on.
    pub const fn new(data: &'a [u8]) -> Self {
        Self(data)
    }

    /// Some are left.
    pub const fn more(&self) -> bool {
        !self.0.is_empty()
    }

    /// The next byte.
    pub fn byte(&mut self) -> u8 {
        let (first, rest) = self.0.split_first().map_or((0, self.0), |(first, rest)| (*first, rest));
        self.0 = rest;
        first
    }

    /// The next N bytes.
    pub fn bytes<const N: usize>(&mut self) -> [u8; N] {
        std::array::from_fn(|_| self.byte())
    }

    /// Any double, from 8 bytes.
    pub fn any(&mut self) -> f64 {
        f64::from_bits(u64::from_le_bytes(self.bytes()))
    }

    /// A double with the mantissa and sign of 8 bytes and an exponent in −32 … 31.
    pub fn moderate(&mut self) -> f64 {
        let bits = u64::from_le_bytes(self.bytes());
        let exponent = 1023 - 32 + ((bits >> 52) & 63);
        f64::from_bits((bits & !(0x7FF << 52)) | (exponent << 52))
    }

    /// A byte with sign.
    pub fn small(&mut self) -> i32 {
        i32::from(i8::from_le_bytes(self.bytes()))
    }

    /// A coordinate: a multiple of 1/256 within ±128, from 2 bytes.
    pub fn coordinate(&mut self) -> f64 {
        f64::from(i16::from_le_bytes(self.bytes())) / 256.0
    }
}

/// Coefficients of a polynomial, ascending powers, from 1 to 16 of them. They may be anything that a double can be.
pub fn polynomial(bytes: &mut Bytes<'_>) -> Vec<f64> {
    let head = bytes.byte();
    let size = usize::from(bytes.byte());
    match head % 8 {
        0 => (0..1 + size % 8).map(|_| bytes.any()).collect(),
        1 => (0..1 + size % 16).map(|_| bytes.moderate()).collect(),
        2 => {
            // exact products: (64x − k)
            let numerators: Vec<i32> = (0..1 + size % 7).map(|_| bytes.small()).collect();
            expanded_integers(64, &numerators)
        }
        3 => {
            // exact products with repeated factors
            let mut numerators = Vec::new();
            let limit = 2 + size % 6;
            while numerators.len() < limit && bytes.more() {
                let (k, times) = (bytes.small(), 1 + bytes.byte() % 5);
                numerators.extend((0..times).map(|_| k));
            }
            numerators.truncate(limit);
            expanded_integers(16, &numerators)
        }
        4 => {
            // rounded products with clusters: a base and small differences
            let base = f64::from(bytes.small()) / 64.0;
            let roots: Vec<f64> = (0..1 + size % 7)
                .map(|_| {
                    let (digit, exponent) = (bytes.small(), bytes.byte() % 64);
                    base + f64::from(digit) * 2.0_f64.powi(-i32::from(exponent))
                })
                .collect();
            expanded(1.0, &roots)
        }
        5 => {
            let (cubic, query) = cubic_and_query(bytes);
            distance_quintic(&cubic.power_basis(), &query).coefficients.to_vec()
        }
        6 => {
            // small integers, times a power of two each
            (0..1 + size % 12)
                .map(|_| {
                    let (digit, exponent) = (bytes.small(), bytes.small());
                    f64::from(digit) * 2.0_f64.powi(exponent)
                })
                .collect()
        }
        _ => {
            // small integers
            (0..1 + size % 16).map(|_| f64::from(bytes.small())).collect()
        }
    }
}

/// An interval lo < hi of doubles, often with round ends.
pub fn interval(bytes: &mut Bytes<'_>) -> (f64, f64) {
    let head = bytes.byte();
    let mut end = |kind: u8| match kind % 4 {
        0 => f64::from(bytes.small()) / 64.0,
        1 => f64::from(bytes.small()) * 2.0_f64.powi(bytes.small() / 2),
        2 => bytes.moderate(),
        _ => f64::from(bytes.small()) / 16.0,
    };
    let (a, b) = (end(head), end(head >> 2));
    if a < b {
        (a, b)
    } else if b < a {
        (b, a)
    } else {
        (a, a + a.abs().max(1.0))
    }
}

/// A cubic and a point: lattice points, nearly degenerate ones, and points near the curve or its centres of curvature.
pub fn cubic_and_query(bytes: &mut Bytes<'_>) -> (Cubic<f64>, Point<f64>) {
    let head = bytes.byte();
    let number = |bytes: &mut Bytes<'_>| match head & 3 {
        0 => bytes.coordinate(),
        1 => f64::from(bytes.small()),
        2 => f64::from(bytes.small() / 16),
        _ => bytes.moderate(),
    };
    let mut point = || Point::new(number(bytes), number(bytes));
    let mut cubic = Cubic::new(point(), point(), point(), point());
    if head & 4 != 0 {
        // retracted handles
        cubic.points[1] = cubic.points[0];
    }
    if head & 8 != 0 {
        cubic.points[2] = cubic.points[3];
    }
    let b = cubic.power_basis();
    let t = f64::from(bytes.byte()) / 255.0;
    let free = Point::new(number(bytes), number(bytes));
    let query = match (head >> 4) % 4 {
        0 => free,
        1 => b.eval(&t),
        2 => {
            let (d, dd) = (b.derivative(&t), b.second_derivative(&t));
            let centre = b.eval(&t).plus_scaled(&(d.norm_sq() / d.cross(&dd)), &d.left());
            if centre.is_finite() && centre.x.abs().max(centre.y.abs()) < 1e12 { centre } else { free }
        }
        _ => {
            let p = b.eval(&t);
            Point::new(p.x + free.x * 1e-9, p.y + free.y * 1e-9)
        }
    };
    (cubic, query)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_bytes_mean_something() {
        assert_eq!(polynomial(&mut Bytes::new(&[])), [0.0]);
        let (lo, hi) = interval(&mut Bytes::new(&[]));
        assert!(lo < hi);
        let (cubic, query) = cubic_and_query(&mut Bytes::new(&[]));
        assert!(cubic.is_finite() && query.is_finite());
    }

    #[test]
    fn repeated_factors() {
        // head 3, up to 2 + 3 factors: 8/16 three times, −16/16 twice
        let c = polynomial(&mut Bytes::new(&[3, 3, 8, 2, 0xF0, 1]));
        let judge = crate::judge::Judge::new(&c).expect("not zero");
        assert_eq!(judge.roots(&judge.everywhere()), [(-1.0, 2), (0.5, 3)]);
    }
}
