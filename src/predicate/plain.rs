//! Predicates in plain floating point.

use super::{Predicates, Sign};
use crate::geometry::Point;
use crate::scalar::Scalar;

/// The determinants as computed: for every scalar, quick, and wrong where rounding decides the sign (relative to the
/// products involved, within about 4u of zero for `orient2d` and 12u for `incircle`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Plain;

impl<S: Scalar> Predicates<S> for Plain {
    #[inline]
    fn orient2d(a: &Point<S>, b: &Point<S>, c: &Point<S>) -> Sign {
        Sign::of(&b.minus(a).cross(&c.minus(a)))
    }

    #[inline]
    fn incircle(a: &Point<S>, b: &Point<S>, c: &Point<S>, d: &Point<S>) -> Sign {
        let (a, b, c) = (a.minus(d), b.minus(d), c.minus(d));
        let determinant = a.norm_sq() * &b.cross(&c) + &(b.norm_sq() * &c.cross(&a)) + &(c.norm_sq() * &a.cross(&b));
        Sign::of(&determinant)
    }
}
