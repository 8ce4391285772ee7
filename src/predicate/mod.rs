//! Signs of determinants: on which side, inside or outside.
//!
//! Topology (which points are neighbours, whether a triangulation is valid) must be decided by exact signs: a wrong one
//! makes algorithms loop or build what cannot exist. Algorithms ask [`Predicates`] for a [`Sign`] and never compare a
//! determinant themselves. Two backends:
//!
//! * [`Plain`]: the determinant in the scalar's own arithmetic; for any scalar; wrong where rounding decides.
//! * [`Exact`]: Shewchuk's adaptive predicates (1997, doi:10.1007/PL00009321) through the crate `robust`; for `f64`, and
//!   for `f32` by promotion, which is exact. Exact on the domain of [`check_domain`].
//!
//! **Signs are mathematical**: the sign of the determinant, in coordinates (x, y) as they are stored. Where y points
//! upwards, positive orientation is counter-clockwise, to the left of a→b. In this crate y points *downwards* as in SVG,
//! so on the screen it looks clockwise; and "left" as used throughout the kernel, (−y, x), agrees with the sign, not
//! with the look.
//!
//! A predicate is exact about the coordinates it is given. Points computed before (samples, centres) are rounded, and the
//! sign is that of the rounded points.

mod domain;
mod exact;
mod plain;

pub use domain::{OutOfDomain, check_domain};
pub use exact::Exact;
pub use plain::Plain;

use crate::geometry::Point;

/// The sign of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Sign {
    /// Below zero.
    Negative,
    /// Zero: collinear, cocircular.
    Zero,
    /// Above zero.
    Positive,
}

impl Sign {
    /// The sign of a number; zero for what is neither above nor below.
    #[inline]
    pub fn of<T: PartialOrd + num_traits::Zero>(value: &T) -> Self {
        let zero = T::zero();
        if *value > zero {
            Self::Positive
        } else if *value < zero {
            Self::Negative
        } else {
            Self::Zero
        }
    }

    /// The sign of −x.
    #[inline]
    pub const fn opposite(self) -> Self {
        match self {
            Self::Negative => Self::Positive,
            Self::Zero => Self::Zero,
            Self::Positive => Self::Negative,
        }
    }
}

/// Signs of the two determinants planar algorithms need.
pub trait Predicates<S> {
    /// The sign of (b − a) × (c − a), twice the signed area of the triangle: positive if c lies to the left of a→b (in the
    /// kernel's sense, direction (−y, x)), zero if the three are collinear.
    fn orient2d(a: &Point<S>, b: &Point<S>, c: &Point<S>) -> Sign;

    /// The sign of the determinant with rows (x − x_d, y − y_d, |p − d|²) for p = a, b, c: positive if d lies strictly
    /// inside the circle through a, b, c and these are positively oriented, zero if all four are on one circle or line;
    /// with a, b, c negatively oriented the sign is reversed.
    fn incircle(a: &Point<S>, b: &Point<S>, c: &Point<S>, d: &Point<S>) -> Sign;
}

#[cfg(test)]
mod tests {
    use super::*;

    fn both<S>(points: &[Point<S>; 4]) -> [(Sign, Sign); 2]
    where
        Plain: Predicates<S>,
        Exact: Predicates<S>,
    {
        let [a, b, c, d] = points;
        [
            (<Plain as Predicates<S>>::orient2d(a, b, c), <Plain as Predicates<S>>::incircle(a, b, c, d)),
            (<Exact as Predicates<S>>::orient2d(a, b, c), <Exact as Predicates<S>>::incircle(a, b, c, d)),
        ]
    }

    #[test]
    fn sign_conventions() {
        let square =
            |dx: f64, dy: f64| [Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(1.0, 1.0), Point::new(dx, dy)];
        for (d, sign) in [((0.5, 0.5), Sign::Positive), ((0.0, 1.0), Sign::Zero), ((-1.0, 1.0), Sign::Negative)] {
            let points = square(d.0, d.1);
            assert_eq!(both(&points), [(Sign::Positive, sign); 2]);
            let small = points.map(|p| Point::<f32>::from_f64(p.x, p.y));
            assert_eq!(both(&small), [(Sign::Positive, sign); 2]);
            let [a, b, c, d] = points;
            assert_eq!(both(&[b, a, c, d]), [(Sign::Negative, sign.opposite()); 2]);
        }
        let (a, b) = (Point::new(0.0, 0.0), Point::new(2.0, 1.0));
        let left = a.plus(&b.minus(&a).left());
        assert_eq!(Exact::orient2d(&a, &b, &left), Sign::Positive, "left is positive");
    }
}
