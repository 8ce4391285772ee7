//! The kernel's root finder, whose number of coefficients is fixed when it is compiled, for lists of any length up to 16.

use feature_sampling::polynomial::{Certified, Polynomial, Root, RootsError};

/// Which of the kernel's interfaces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ask {
    /// [`Polynomial::roots_in_unit_within`].
    Unit,
    /// [`Polynomial::roots_between_within`].
    Between(f64, f64),
    /// [`Polynomial::real_roots_within`].
    Real,
}

/// The most coefficients there may be.
pub const MOST: usize = 16;

/// Calls a function with the number of coefficients as its parameter.
macro_rules! by_size {
    ($coefficients:expr, $function:ident($($argument:expr),*)) => {
        match $coefficients.len() {
            0..=2 => $function::<2>($($argument),*),
            3 => $function::<3>($($argument),*),
            4 => $function::<4>($($argument),*),
            5 => $function::<5>($($argument),*),
            6 => $function::<6>($($argument),*),
            7 => $function::<7>($($argument),*),
            8 => $function::<8>($($argument),*),
            9..=11 => $function::<11>($($argument),*),
            12..=MOST => $function::<MOST>($($argument),*),
            more => panic!("{more} coefficients; {MOST} at most"),
        }
    };
}

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
    solve_within(coefficients, ask, 0.0)
}

/// The kernel's answer in brackets of a relative width.
///
/// # Errors
/// The kernel's own.
///
/// # Panics
/// If there are more than [`MOST`] coefficients.
pub fn solve_within(coefficients: &[f64], ask: Ask, width: f64) -> Result<Vec<Root<f64>>, RootsError> {
    by_size!(coefficients, solve_as(coefficients, ask, width))
}

/// The kernel's certified answer.
///
/// # Errors
/// The kernel's own.
///
/// # Panics
/// If there are more than [`MOST`] coefficients.
pub fn prove(coefficients: &[f64], ask: Ask) -> Result<Vec<Certified<f64>>, RootsError> {
    by_size!(coefficients, prove_as(coefficients, ask))
}

fn prove_as<const N: usize>(coefficients: &[f64], ask: Ask) -> Result<Vec<Certified<f64>>, RootsError> {
    let p = polynomial::<N>(coefficients);
    let found = match ask {
        Ask::Unit => p.certified_in_unit(),
        Ask::Between(lo, hi) => p.certified_between(&lo, &hi),
        Ask::Real => p.certified_real_roots(),
    };
    found.map(|roots| roots.into_iter().collect())
}

fn polynomial<const N: usize>(coefficients: &[f64]) -> Polynomial<f64, N> {
    Polynomial::new(std::array::from_fn(|j| coefficients.get(j).copied().unwrap_or(0.0)))
}

fn solve_as<const N: usize>(coefficients: &[f64], ask: Ask, width: f64) -> Result<Vec<Root<f64>>, RootsError> {
    let p = polynomial::<N>(coefficients);
    let found = match ask {
        Ask::Unit => p.roots_in_unit_within(&width),
        Ask::Between(lo, hi) => p.roots_between_within(&lo, &hi, &width),
        Ask::Real => p.real_roots_within(&width),
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
