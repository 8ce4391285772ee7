//! The kernel's root finder, whose number of coefficients is fixed when it is compiled, for lists of any length up to 16.

use feature_sampling::polynomial::{Polynomial, Root, RootsError};

/// Which of the kernel's interfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ask {
    /// [`Polynomial::roots_in_unit`].
    Unit,
    /// [`Polynomial::roots_between`].
    Between(f64, f64),
    /// [`Polynomial::real_roots`].
    Real,
}

/// The most coefficients there may be.
pub const MOST: usize = 16;

/// The kernel's answer.
///
/// Lists are filled up with zeros to the next length that is compiled in: 2 to 8, 11 or 16 coefficients.
///
/// # Errors
/// The kernel's own.
///
/// # Panics
/// If there are more than [`MOST`] coefficients.
pub fn solve(coefficients: &[f64], ask: Ask) -> Result<Vec<Root<f64>>, RootsError> {
    match coefficients.len() {
        0..=2 => solve_as::<2>(coefficients, ask),
        3 => solve_as::<3>(coefficients, ask),
        4 => solve_as::<4>(coefficients, ask),
        5 => solve_as::<5>(coefficients, ask),
        6 => solve_as::<6>(coefficients, ask),
        7 => solve_as::<7>(coefficients, ask),
        8 => solve_as::<8>(coefficients, ask),
        9..=11 => solve_as::<11>(coefficients, ask),
        12..=MOST => solve_as::<MOST>(coefficients, ask),
        more => panic!("{more} coefficients; {MOST} at most"),
    }
}

fn solve_as<const N: usize>(coefficients: &[f64], ask: Ask) -> Result<Vec<Root<f64>>, RootsError> {
    let p = Polynomial::<f64, N>::new(std::array::from_fn(|j| coefficients.get(j).copied().unwrap_or(0.0)));
    let found = match ask {
        Ask::Unit => p.roots_in_unit(),
        Ask::Between(lo, hi) => p.roots_between(&lo, &hi),
        Ask::Real => p.real_roots(),
    };
    found.map(|roots| roots.into_iter().collect())
}

/// leading·∏(x − r), expanded in doubles: the coefficients are rounded.
pub fn expanded(leading: f64, roots: &[f64]) -> Vec<f64> {
    let mut c = vec![leading];
    for r in roots {
        c.push(0.0);
        for j in (0..c.len()).rev() {
            let below = if j > 0 { c[j - 1] } else { 0.0 };
            c[j] = below - r * c[j];
        }
    }
    c
}

/// ∏(d·x − k) over the numerators k: exact as long as the integers stay below 2⁵³.
pub fn expanded_integers(d: i32, numerators: &[i32]) -> Vec<f64> {
    let mut c = vec![1.0];
    for k in numerators {
        c.push(0.0);
        for j in (0..c.len()).rev() {
            let below = if j > 0 { c[j - 1] } else { 0.0 };
            c[j] = f64::from(d) * below - f64::from(*k) * c[j];
        }
    }
    c
}
