//! Arbitrary precision for the kernel: [`Mpfr<BITS>`](Mpfr) implements its scalar traits over MPFR.
//!
//! The kernel computes in whatever fulfils `Scalar`; here that is a binary floating-point number with BITS bits of
//! significand, each operation correctly rounded to nearest, and an exponent so wide that nothing overflows. So every formula
//! of the kernel has a judge: the same code, run in 256 bits, says how far `f32` and `f64` are off.
//!
//! | module | what it holds |
//! |---|---|
//! | [`number`] | the number |
//! | [`directed`] | outward rounding, for intervals of these numbers |
//! | [`enclosures`] | proved bounds of lfs in `f64` beside those in 128 bits |
//! | [`ladder`] | precisions chosen at run time |
//! | [`predicate`] | exact orientation and in-circle for these numbers |
//! | [`truth`] | the table of allowed errors, one entry for each public function of the kernel |
//!
//! **Building.** Needs GMP and MPFR with headers (Debian: `apt-get install libgmp-dev libmpfr-dev`) and is no default member
//! of the workspace for that reason. Tests: `cargo test -p feature-sampling-mpfr`. rug is held at 1.19.2 and
//! gmp-mpfr-sys at 1.5: with the libraries of Debian 12 these build in seconds, while newer ones ask for GMP 6.3 or build
//! everything from source.
//!
//! **Running.** `cargo run --release -p feature-sampling-mpfr -- lfs DRAWING` and `-- ladder DRAWING` compute lfs in any
//! precision of the [`ladder`], `-- accuracy` makes `docs/accuracy.md`; without arguments it says how.
//!
//! Numbers of this kind are on the heap: an operation takes about a hundred times as long as in `f64`.

pub mod directed;
pub mod enclosures;
pub mod ladder;
pub mod number;
pub mod predicate;
pub mod truth;

pub use number::Mpfr;
