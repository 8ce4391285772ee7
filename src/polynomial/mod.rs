//! Real polynomials of small degree and their real roots (paper, Section 7.1).
//!
//! The closest point of a cubic Bézier curve is a root of a quintic, curvature extrema are roots of another, tangent
//! disks touch where a quartic vanishes: the kernel solves polynomials millions of times, and one lost root is a wrong
//! medial axis. So this module is built around *not losing roots*:
//!
//! 1. **Isolation** ([`isolate`](self)): the polynomial is written in Bernstein form on an interval. By the rule of
//!    signs (Descartes; Lane and Riesenfeld 1981, doi:10.1007/BF01934440) the number of sign variations of the
//!    coefficients bounds the number of roots inside and has its parity: none excludes, one isolates, more are halved.
//!    Coefficients below a bound of their own rounding error count as "sign unknown", never as a sign.
//! 2. **Refinement**: an isolated root is finished by Newton's method kept inside its bracket.
//! 3. What cannot be told apart in the given precision (double roots, clusters, near misses) is reported as such
//!    ([`RootKind`]), with a bracket, instead of being dropped or invented.
//!
//! Two interfaces: [`Polynomial::real_roots`] finds all real roots (inside the tighter of Cauchy's and Kojima's bounds,
//! [`Polynomial::cauchy_bound`], [`Polynomial::kojima_bound`]); [`Polynomial::roots_between`] finds those of an interval,
//! with [`Polynomial::roots_in_unit`] as its fast case [0, 1]. On [0, 1] the two bounds are of no use: they cut the
//! interval in 0.00 % of closest-point quintics. [`Polynomial::certified_between`] and its siblings prove what they say.
//!
//! **Attainable error.** Coefficients are taken to be known to one rounding each. A simple root is then determined up
//! to u·Σ|aⱼ xʲ| / |p'(x)| and a k-fold one up to the k-th root of such a quotient, u being the unit roundoff of the
//! scalar. Roots closer than that to each other, or to the real line, or to the end of an interval, are not
//! distinguishable from coinciding ones: they are reported together, in a bracket of at most four times that error. What is
//! distinguishable is computed for the coefficients as given, to the last place. How it is done, with proofs, and how well it
//! does: `docs/roots.md`.

pub(crate) mod bernstein;
mod bound;
mod certified;
mod ends;
mod eval;
mod isolate;
pub(crate) mod newton;
mod refine;
mod roots;
mod scale;
mod twofold;

pub use certified::{Certified, CertifiedRoots, Holds};
pub use roots::{Root, RootKind, Roots, RootsError};

#[cfg(doctest)]
#[doc = include_str!("../../docs/roots.md")]
mod page {}

/// A polynomial a₀ + a₁ x + … + a₍ₙ₋₁₎ xⁿ⁻¹ with N coefficients, ascending powers; leading coefficients may be zero.
///
/// N is at least 1; root finding accepts N ≤ 16 (degree 15), which is checked when the program is compiled.
///
/// ```
/// use feature_sampling::polynomial::Polynomial;
/// // (x − 1/4)(x − 3/4)(x + 2), times 16
/// let p = Polynomial::new([6.0_f64, -29.0, 16.0, 16.0]);
/// let roots = p.roots_in_unit()?;
/// assert_eq!(roots.len(), 2, "two of the three lie in [0, 1]");
/// assert!((roots[0].value - 0.25).abs() < 1e-15 && (roots[1].value - 0.75).abs() < 1e-15);
/// assert_eq!(p.real_roots()?.len(), 3);
/// # Ok::<(), feature_sampling::polynomial::RootsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polynomial<S, const N: usize> {
    /// The coefficients a₀, a₁, …, ascending powers.
    pub coefficients: [S; N],
}
