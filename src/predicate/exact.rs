//! Exact predicates for machine floats.

use super::{Predicates, Sign};
use crate::geometry::Point;
use robust::Coord;

/// Exact signs for `f64`, and for `f32` by promotion to `f64`, for points of the domain of
/// [`check_domain`](super::check_domain).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Exact;

/// Implements both predicates for a float that converts to `f64` without loss.
macro_rules! exact {
    ($float:ty) => {
        impl Predicates<$float> for Exact {
            #[inline]
            fn orient2d(a: &Point<$float>, b: &Point<$float>, c: &Point<$float>) -> Sign {
                Sign::of(&robust::orient2d(coord(a), coord(b), coord(c)))
            }

            #[inline]
            fn incircle(a: &Point<$float>, b: &Point<$float>, c: &Point<$float>, d: &Point<$float>) -> Sign {
                Sign::of(&robust::incircle(coord(a), coord(b), coord(c), coord(d)))
            }
        }
    };
}

exact!(f32);
exact!(f64);

/// The point in the form `robust` takes.
#[inline]
fn coord<T: Copy + Into<f64>>(p: &Point<T>) -> Coord<f64> {
    Coord { x: p.x.into(), y: p.y.into() }
}
