//! Where exact predicates are exact.
//!
//! Shewchuk's expansions are error-free as long as no product overflows or underflows: he states that exponents between
//! −142 and 201 are safe for all four of his predicates in double precision. So each coordinate must be zero or of modulus
//! in [2^−142, 2^201]. Every finite `f32` but the smallest subnormals is in this range.

use crate::geometry::Point;
use crate::scalar::{Field, Scalar};
use core::fmt;

/// Least binary exponent of a non-zero coordinate.
const LEAST: i32 = -142;

/// Greatest binary exponent.
const GREATEST: i32 = 201;

/// A coordinate for which exact predicates are not guaranteed to be exact: infinite, not a number, of modulus above 2^201,
/// or not zero but below 2^−142. Scale the drawing, or round tiny coordinates to zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OutOfDomain {
    /// The coordinate, as a double.
    pub coordinate: f64,
}

impl fmt::Display for OutOfDomain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "coordinate {:e} is outside the range of exact geometry (0, or 2^-142 to 2^201 in size)",
            self.coordinate
        )
    }
}

impl core::error::Error for OutOfDomain {}

/// Checks one point, once, at the door: afterwards [`Exact`](super::Exact) is exact about it.
///
/// # Errors
/// [`OutOfDomain`] with the first coordinate outside.
pub fn check_domain<S: Scalar>(p: &Point<S>) -> Result<(), OutOfDomain> {
    let (least, greatest) = (1.0.mul_pow2(LEAST), 1.0.mul_pow2(GREATEST));
    for c in [&p.x, &p.y] {
        let coordinate = c.to_f64();
        let size = Field::abs(coordinate);
        let inside = size <= greatest && (size >= least || c.is_zero());
        if !inside {
            return Err(OutOfDomain { coordinate });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_door() {
        for good in [0.0_f64, -0.0, 1.0, -1e60, 1e-42, 2.0_f64.mul_pow2(200), 1.0_f64.mul_pow2(-142)] {
            assert_eq!(check_domain(&Point::new(good, 1.0)), Ok(()), "{good:e}");
        }
        for bad in [f64::INFINITY, 1e61, -1e300, 1e-43, f64::MIN_POSITIVE, 5e-324] {
            assert_eq!(check_domain(&Point::new(1.0, bad)), Err(OutOfDomain { coordinate: bad }), "{bad:e}");
        }
        assert!(check_domain(&Point::new(f64::NAN, 0.0)).is_err());
        assert_eq!(check_domain(&Point::new(f32::MAX, f32::MIN_POSITIVE)), Ok(()));
        assert!(check_domain(&Point::new(f32::from_bits(1), 0.0)).is_err(), "the smallest subnormal");
    }
}
