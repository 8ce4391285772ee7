//! The judge of roots, closest points and feature sizes, and the properties that tests and fuzzers share.
//!
//! A root finder in floating point cannot be tested against another one: where the first errs, the second may too. Every
//! double is an integer times a power of two, so a polynomial with double coefficients has an exact number of roots in any
//! interval between doubles, and integers of arbitrary size tell it without a rounding: Sturm's theorem.
//!
//! * [`dyadic`]: numbers m·2ᵉ with integers m of any size;
//! * [`exact`]: polynomials over the integers: values, remainders, greatest common divisors, square-free factors;
//! * [`sturm`]: the number of roots in an interval, with multiplicity where asked;
//! * [`judge`]: what is right and what is wrong about a list of roots, by these counts;
//! * [`proof`]: whether certified answers are true, by the same counts;
//! * [`nasty`]: polynomials that break solvers, from a seed;
//! * [`solve`]: the kernel's root finder for any number of coefficients;
//! * [`queries`]: cubics with a point each, in the three classes of the closest-point benches;
//! * [`closest`]: the closest point by brute force, and exactly where that disagrees;
//! * [`feature_size`]: lfs at single points, to nearly all digits of the scalar: never below the true one;
//! * [`decode`]: bytes of a fuzzer read as polynomials, curves and documents;
//! * [`property`]: what must hold for any such bytes. One function for each fuzz target; the same functions run on random
//!   bytes and on the committed corpus in `cargo test`;
//! * [`survey`]: counts of wrong answers over many cases;
//! * [`verdict`]: whether proofs and refutations of ε-samples are true, by a dense look at random curves.
//!
//! Nothing of the product judges itself: of the kernel only the functions under test are called (but [`feature_size`] takes
//! tangent disks from it, for certificates that do not use these). One answer is handed on to
//! users: `fsample roots --certified` prints [`judge::Judge::certified`].

pub mod closest;
pub mod decode;
pub mod dyadic;
pub mod exact;
pub mod feature_size;
pub mod judge;
pub mod nasty;
pub mod proof;
pub mod property;
pub mod queries;
pub mod random;
pub mod solve;
pub mod sturm;
pub mod survey;
pub mod verdict;
