//! Precisions chosen at run time.
//!
//! The precision is part of a type, so a program that learns it late needs a `match` somewhere: here, once. A job is a value
//! that can [run](AtPrecision) in any scalar; it is compiled once for each rung.

use std::fmt::Display;

use feature_sampling::scalar::Scalar;

use crate::Mpfr;

/// The rungs, in bits, ascending.
pub const RUNGS: [u32; 5] = [64, 128, 256, 512, 1024];

/// Something that can be done in any scalar.
pub trait AtPrecision {
    /// What comes out.
    type Out;

    /// Does it.
    fn run<S: Scalar + Display>(self) -> Self::Out;
}

/// The lowest rung with at least so many bits; `None` above the highest.
pub fn rung(bits: u32) -> Option<u32> {
    RUNGS.into_iter().find(|rung| *rung >= bits)
}

/// Does a job at the lowest rung with at least so many bits; `None` above the highest.
pub fn at<J: AtPrecision>(bits: u32, job: J) -> Option<J::Out> {
    Some(match rung(bits)? {
        64 => job.run::<Mpfr<64>>(),
        128 => job.run::<Mpfr<128>>(),
        256 => job.run::<Mpfr<256>>(),
        512 => job.run::<Mpfr<512>>(),
        _ => job.run::<Mpfr<1024>>(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The binary exponent of |√2² − 2|, and the bits in use.
    struct Residual;

    impl AtPrecision for Residual {
        type Out = (f64, u32);

        fn run<S: Scalar + Display>(self) -> (f64, u32) {
            let residual = (S::int(2).sqrt().square() - S::int(2)).abs();
            (residual.to_f64().log2(), S::BITS)
        }
    }

    #[test]
    fn every_rung_is_what_it_says() {
        for bits in RUNGS {
            let (residual, in_use) = at(bits, Residual).expect("a rung");
            assert_eq!(in_use, bits, "the rung itself");
            assert!(residual <= 3.0 - f64::from(bits), "{bits}: 2^{residual}");
        }
        assert_eq!((rung(1), rung(65), rung(1025)), (Some(64), Some(128), None), "rounded up");
        assert!(at(2000, Residual).is_none(), "above the ladder");
    }
}
