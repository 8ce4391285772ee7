//! The table of allowed errors: one entry for each public function of the kernel.
//!
//! An entry says what kind of result a function has and, where it rounds, by how many ulp it may be off in `f32` and in `f64`.
//! The judge is the same function in [`Truth`], 256 bits, on the same input: the input is rounded to the scalar under test first
//! and lifted without error. `tests/truth.rs` measures every entry, fails where a public function of the kernel's source has
//! none, and compares `docs/accuracy.md`, which [`document`] makes from this table, with what is committed.
//!
//! **Ulp.** One ulp here is 2^(1−BITS) of a *size* that the entry names: of the result itself where the function is well
//! conditioned, otherwise of what rounding is relative to (the sum of the moduli of the terms of a sum, the largest coordinate
//! of a curve). A function that cancels cannot be good relative to a result near zero, and is not blamed for it.
//!
//! The judge runs the same formula, so it finds rounding and not a wrong formula; those are the business of the brute-force
//! tests of the kernel.

pub mod arithmetic;
pub mod curves;
pub mod document;
pub mod input;
pub mod scan;
pub mod shapes;
pub mod table;

use feature_sampling::scalar::Scalar;

use crate::Mpfr;
use input::Gen;

/// What judges.
pub type Truth = Mpfr<256>;

/// What kind of result a function has.
#[derive(Clone, Copy)]
pub enum Kind {
    /// Nothing is rounded: copies, comparisons, indices, powers of two. The word says which.
    Exact(&'static str),
    /// Whatever is computed is computed by the function of this name, which has an entry of its own.
    Through(&'static str),
    /// The result encloses the exact one; by how much it is wider is the word. Judged by `tests/interval.rs` for
    /// `Interval` and `Directed`, by proof for what is built on them (`docs/certificates.md`).
    Encloses(&'static str),
    /// An error of another kind than rounding, or one that is not measured; the words say which.
    Bounded(&'static str),
    /// Rounded, and measured.
    Measured(Measured),
}

/// A function that rounds.
#[derive(Clone, Copy)]
pub struct Measured {
    /// What the size of an ulp is taken from.
    pub size: &'static str,
    /// Ulps allowed in `f32` and in `f64`.
    pub allowed: [f64; 2],
    /// Cases that are tried.
    pub cases: u32,
    /// The largest error of one case, in `f32` and in `f64`.
    pub run: [fn(&mut Gen) -> f64; 2],
}

/// A line of the table.
#[derive(Clone, Copy)]
pub struct Entry {
    /// Module, type and name: `geometry::point::Point::distance`.
    pub function: &'static str,
    /// What is known about it.
    pub kind: Kind,
}

/// The scalars, as [`Measured`] orders them.
pub const SCALARS: [&str; 2] = ["f32", "f64"];

impl Measured {
    /// The largest error of all cases in a scalar, in ulp. The cases are the same every time.
    pub fn worst(&self, scalar: usize) -> f64 {
        let Some(run) = self.run.get(scalar) else { return f64::INFINITY };
        let mut input = Gen::new(0x5eed);
        (0..self.cases).fold(0.0, |worst: f64, _| {
            let error = run(&mut input);
            // A NaN is the largest error of all.
            if error <= worst { worst } else { error }
        })
    }
}

/// The number, without error: `f32` and `f64` fit into a double.
pub fn lift<S: Scalar>(v: &S) -> Truth {
    Truth::from_f64(v.to_f64())
}

/// |found − truth| in ulp of `size`; infinite where something is not finite, or where `size` is 0 and the two differ.
pub fn ulps<S: Scalar>(found: &S, truth: &Truth, size: &Truth) -> f64 {
    use feature_sampling::scalar::Field;
    use num_traits::{One, Zero};
    if !(found.is_finite() && truth.is_finite()) {
        return if found.is_finite() == truth.is_finite() { 0.0 } else { f64::INFINITY };
    }
    let error = (lift(found) - truth).abs();
    if error.is_zero() {
        return 0.0;
    }
    let ulp = size.clone().abs() * &Truth::one().mul_pow2(1 - i32::try_from(S::BITS).unwrap_or(0));
    (error / &ulp).to_f64()
}
