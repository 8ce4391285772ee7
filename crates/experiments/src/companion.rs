//! Roots of a polynomial as eigenvalues of its companion matrix: what a general linear algebra library offers.
//!
//! The companion matrix is a Hessenberg matrix already; Francis's implicit double-shift QR iteration (Golub and Van Loan,
//! *Matrix Computations*, section 7.5) deflates its eigenvalues from the bottom. This finds all roots, complex ones
//! included, where the closest point of a cubic needs a few in [0, 1]: Table 2 shows what that costs. It is here to be
//! compared with and is used for nothing else.

/// Iterations for one eigenvalue before giving up.
const ITERATIONS: usize = 60;

/// Leading coefficients below this share of the largest are dropped: the root they stand for is far outside [0, 1].
const VANISHING: f64 = 1e-13;

/// Imaginary parts up to this count as rounding of a double root.
const REAL: f64 = 1e-7;

/// The real roots in [0, 1] of a quintic with these coefficients, in ascending powers; in no order. The flag says that the
/// iteration ended by itself.
pub fn roots_in_unit(coefficients: &[f64; 6]) -> (Vec<f64>, bool) {
    let largest = coefficients.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let degree = (1..6).rev().find(|&i| coefficients[i].abs() > VANISHING * largest);
    let Some(degree) = degree else { return (Vec::new(), true) };
    let mut h = [[0.0; 5]; 5];
    for i in 0..degree {
        h[0][i] = -coefficients[degree - 1 - i] / coefficients[degree];
        if i > 0 {
            h[i][i - 1] = 1.0;
        }
    }
    let (eigenvalues, converged) = eigenvalues(h, degree);
    let real = eigenvalues.into_iter().filter(|(re, im)| im.abs() <= REAL && (-REAL..=1.0 + REAL).contains(re));
    (real.map(|(re, _)| re.clamp(0.0, 1.0)).collect(), converged)
}

/// Eigenvalues of the leading n × n part of an upper Hessenberg matrix, as real and imaginary parts.
fn eigenvalues(mut h: [[f64; 5]; 5], n: usize) -> (Vec<(f64, f64)>, bool) {
    let mut found = Vec::with_capacity(n);
    let (mut high, mut iteration) = (n, 0);
    while high > 0 {
        let mut low = high - 1;
        while low > 0 {
            let scale = h[low - 1][low - 1].abs() + h[low][low].abs();
            if h[low][low - 1].abs() <= f64::EPSILON * scale {
                h[low][low - 1] = 0.0;
                break;
            }
            low -= 1;
        }
        let size = high - low;
        if size == 1 {
            found.push((h[low][low], 0.0));
        } else if size == 2 {
            found.extend(pair(h[low][low], h[low][low + 1], h[low + 1][low], h[low + 1][low + 1]));
        } else if iteration < ITERATIONS {
            iteration += 1;
            francis_step(&mut h, low, high, iteration % 10 == 0);
            continue;
        } else {
            return (found, false);
        }
        high = low;
        iteration = 0;
    }
    (found, true)
}

/// Eigenvalues of a 2 × 2 matrix.
fn pair(a: f64, b: f64, c: f64, d: f64) -> [(f64, f64); 2] {
    let (half, mean) = ((a - d) / 2.0, f64::midpoint(a, d));
    let discriminant = half * half + b * c;
    if discriminant < 0.0 {
        let im = (-discriminant).sqrt();
        return [(mean, im), (mean, -im)];
    }
    // The one of larger modulus without cancellation, the other from the determinant.
    let root = discriminant.sqrt();
    let first = if mean >= 0.0 { mean + root } else { mean - root };
    let second = if first == 0.0 { 0.0 } else { (a * d - b * c) / first };
    [(first, 0.0), (second, 0.0)]
}

/// One implicit double-shift step on the rows and columns low..high, at least three of them.
fn francis_step(h: &mut [[f64; 5]; 5], low: usize, high: usize, exceptional: bool) {
    let m = high - 1;
    let (sum, product) = if exceptional {
        let w = h[m][m - 1].abs() + h[m - 1][m - 2].abs();
        (1.5 * w, w * w)
    } else {
        (h[m - 1][m - 1] + h[m][m], h[m - 1][m - 1] * h[m][m] - h[m - 1][m] * h[m][m - 1])
    };
    let mut x = h[low][low] * (h[low][low] - sum) + h[low][low + 1] * h[low + 1][low] + product;
    let mut y = h[low + 1][low] * (h[low][low] + h[low + 1][low + 1] - sum);
    let mut z = h[low + 1][low] * h[low + 2][low + 1];
    for k in low..m {
        let last = k + 1 == m;
        reflect(h, [x, y, if last { 0.0 } else { z }], k, low, high, if last { 2 } else { 3 });
        if !last {
            x = h[k + 1][k];
            y = h[k + 2][k];
            z = if k + 3 <= m { h[k + 3][k] } else { 0.0 };
        }
    }
}

/// Turns rows and columns k, k + 1, … so that v becomes a multiple of the first unit vector.
fn reflect(h: &mut [[f64; 5]; 5], v: [f64; 3], k: usize, low: usize, high: usize, count: usize) {
    let scale = v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    if scale == 0.0 {
        return;
    }
    let mut u = v.map(|c| c / scale);
    let norm = (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt();
    u[0] += if u[0] >= 0.0 { norm } else { -norm };
    let factor = 2.0 / (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    #[expect(clippy::needless_range_loop, reason = "a column runs across rows")]
    for column in k.saturating_sub(1).max(low)..high {
        let dot: f64 = (0..count).map(|i| u[i] * h[k + i][column]).sum();
        for i in 0..count {
            h[k + i][column] -= factor * dot * u[i];
        }
    }
    for row in h.iter_mut().take((k + 4).min(high)).skip(low) {
        let dot: f64 = (0..count).map(|i| u[i] * row[k + i]).sum();
        for i in 0..count {
            row[k + i] -= factor * dot * u[i];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coefficients of (x − r₁)(x − r₂)…
    fn planted(roots: &[f64]) -> [f64; 6] {
        let mut c = [0.0; 6];
        c[0] = 1.0;
        for (n, r) in roots.iter().enumerate() {
            for i in (0..=n + 1).rev() {
                c[i] = if i > 0 { c[i - 1] } else { 0.0 } - r * c[i];
            }
        }
        c
    }

    fn check(roots: &[f64], expected: &[f64], tolerance: f64) {
        let (mut found, converged) = roots_in_unit(&planted(roots));
        found.sort_by(f64::total_cmp);
        assert!(converged, "{roots:?}");
        assert_eq!(found.len(), expected.len(), "{roots:?}: {found:?}");
        for (a, b) in found.iter().zip(expected) {
            assert!((a - b).abs() < tolerance, "{roots:?}: {found:?}");
        }
    }

    #[test]
    fn planted_roots() {
        check(&[0.1, 0.3, 0.5, 0.7, 0.9], &[0.1, 0.3, 0.5, 0.7, 0.9], 1e-11);
        check(&[-3.0, 0.25, 0.5, 4.0, 100.0], &[0.25, 0.5], 1e-12);
        check(&[0.0, 1.0, 2.0], &[0.0, 1.0], 1e-12);
        check(&[0.75], &[0.75], 1e-15);
        check(&[-1.0, -2.0], &[], 0.0);
    }

    #[test]
    fn complex_roots_are_left_out() {
        // (x² + 1)(x² − x + 1)(x − 0.5)
        let (found, converged) = roots_in_unit(&[-0.5, 1.5, -2.0, 2.5, -1.5, 1.0]);
        assert!(converged && found.len() == 1 && (found[0] - 0.5).abs() < 1e-12, "{found:?}");
        assert_eq!(roots_in_unit(&[0.0; 6]), (vec![], true), "the zero polynomial");
        assert_eq!(roots_in_unit(&[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]), (vec![], true), "a constant");
    }
}
