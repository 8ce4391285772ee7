//! Signs of polynomials on an interval.
//!
//! A polynomial of degree n on [v₀, v₁] is Σ C(n,i) aᵢ (1−x)^(n−i) xⁱ, x from 0 to 1. Here the weighted numbers ãᵢ = C(n,i) aᵢ are
//! kept: products are plain convolutions, raising the degree is a product with the binomials of 1 = ((1−x)+x)^m, and where no ãᵢ
//! is negative, neither is the polynomial.
//!
//! With w = v₁ − v₀ and the polynomial's own Taylor coefficients tₖ at v₀, ãᵢ = Σₖ C(n−k, i−k) tₖ wᵏ. Since 0 ≤ v₀ ≤ v₁ all weights
//! are non-negative, and coefficients that are intervals lose nothing to being used more than once.

use feature_sampling::scalar::{Enclosure, Field};

/// An interval that holds a real number.
pub(crate) type Real = Enclosure<f64>;

/// Most weighted coefficients of a form: degree six.
pub(crate) type Form = [Real; 7];

const BINOMIAL: [[i32; 7]; 7] = [
    [1, 0, 0, 0, 0, 0, 0],
    [1, 1, 0, 0, 0, 0, 0],
    [1, 2, 1, 0, 0, 0, 0],
    [1, 3, 3, 1, 0, 0, 0],
    [1, 4, 6, 4, 1, 0, 0],
    [1, 5, 10, 10, 5, 1, 0],
    [1, 6, 15, 20, 15, 6, 1],
];

fn zero() -> Real {
    Real::point(0.0)
}

/// Weighted coefficients on [from, to] of the polynomial with these coefficients of powers, ascending; 0 ≤ from ≤ to.
pub(crate) fn on<const N: usize>(mut powers: [Real; N], from: Real, to: Real) -> [Real; N] {
    // Taylor coefficients at `from`, then times the powers of the width.
    for i in 0..N {
        for j in (i..N - 1).rev() {
            powers[j] = powers[j] + from * powers[j + 1];
        }
    }
    // The difference of ordered ends is not negative, whatever its rounding says.
    let width = (to - from).abs();
    let mut scale = width;
    for t in powers.iter_mut().skip(1) {
        *t = *t * scale;
        scale = scale * width;
    }
    core::array::from_fn(|i| {
        (0..=i).fold(zero(), |sum, k| {
            let weight = BINOMIAL[N - 1 - k][i - k];
            sum + if weight == 1 { powers[k] } else { powers[k] * Real::int(weight) }
        })
    })
}

/// Adds the product of two polynomials to a form of degree (a's + b's).
pub(crate) fn add_product(form: &mut Form, a: &[Real], b: &[Real]) {
    for (i, x) in a.iter().enumerate() {
        for (j, y) in b.iter().enumerate() {
            form[i + j] = form[i + j] + *x * *y;
        }
    }
}

/// Adds the square of a polynomial: no square is negative, and mixed products count twice.
fn add_square(form: &mut Form, a: &[Real]) {
    for (i, x) in a.iter().enumerate() {
        form[2 * i] = form[2 * i] + x.square();
        for (j, y) in a.iter().enumerate().skip(i + 1) {
            form[i + j] = form[i + j] + (*x * *y).twice();
        }
    }
}

/// x² + y² − k·a: x and y of the same degree n, a of a lower degree than 2n.
pub(crate) fn disk<const N: usize, const M: usize>(x: &[Real; N], y: &[Real; N], k: Real, a: &[Real; M]) -> Form {
    let mut form = [zero(); 7];
    add_square(&mut form, x);
    add_square(&mut form, y);
    let raise = 2 * (N - 1) - (M - 1);
    let ones: [Real; 7] = core::array::from_fn(|i| Real::int(-BINOMIAL[raise][i]));
    let scaled = a.map(|a| k * a);
    add_product(&mut form, &scaled, &ones[..=raise]);
    form
}

/// At most every weighted coefficient: where this is not negative, neither is the polynomial.
pub(crate) fn least(form: &[Real]) -> f64 {
    form.iter().map(|c| *c.lo()).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 − 3v + v³ on [1/2, 3/2]: values at the ends, and the sign of what is and is not negative.
    #[test]
    fn ends_are_values() {
        let p = [2.0, -3.0, 0.0, 1.0].map(Real::point);
        let b = on(p, Real::point(0.5), Real::point(1.5));
        assert!(b[0].contains(&0.625) && b[3].contains(&0.875), "{b:?}");
        // A double root at 1, which coefficients over a wide interval cannot show.
        assert!(least(&b) < 0.0, "{b:?}");
        assert!(least(&on(p, Real::point(0.0), Real::point(0.5))) > 0.0);
    }

    /// x² + y² − 2a for x = v, y = 1, a = v is (v−1)² on [0, 3].
    #[test]
    fn a_disk_is_what_it_says() {
        let (from, to) = (Real::point(0.0), Real::point(3.0));
        let x = on([zero(), Real::point(1.0)], from, to);
        let y = on([Real::point(1.0), zero()], from, to);
        let form = disk(&x, &y, Real::point(2.0), &x);
        let expected = [1.0, -4.0, 4.0];
        assert!(form.iter().zip(expected).all(|(c, e)| c.contains(&e)), "{form:?}");
        assert!(form[3..].iter().all(|c| c.contains(&0.0)));
    }
}
