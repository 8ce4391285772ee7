//! Points of the plane.

use super::Vector;
use crate::scalar::Scalar;

/// A place in the plane, in user units.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Point<S> {
    /// Horizontal coordinate, to the right.
    pub x: S,
    /// Vertical coordinate, downwards as in SVG.
    pub y: S,
}

impl<S: Scalar> Point<S> {
    /// The point (x, y).
    #[inline]
    pub const fn new(x: S, y: S) -> Self {
        Self { x, y }
    }

    /// The point with these double coordinates, rounded to the scalar.
    #[inline]
    pub fn from_f64(x: f64, y: f64) -> Self {
        Self::new(S::from_f64(x), S::from_f64(y))
    }

    /// The vector from `from` to `self`.
    #[inline]
    pub fn minus(&self, from: &Self) -> Vector<S> {
        Vector::new(self.x.clone() - &from.x, self.y.clone() - &from.y)
    }

    /// `self` + v.
    #[inline]
    pub fn plus(&self, v: &Vector<S>) -> Self {
        Self::new(self.x.clone() + &v.x, self.y.clone() + &v.y)
    }

    /// `self` + k·v.
    #[inline]
    pub fn plus_scaled(&self, k: &S, v: &Vector<S>) -> Self {
        Self::new(v.x.clone() * k + &self.x, v.y.clone() * k + &self.y)
    }

    /// Squared distance.
    #[inline]
    pub fn distance_sq(&self, other: &Self) -> S {
        self.minus(other).norm_sq()
    }

    /// Distance.
    #[inline]
    pub fn distance(&self, other: &Self) -> S {
        self.minus(other).norm()
    }

    /// The point in the middle.
    #[inline]
    pub fn middle(&self, other: &Self) -> Self {
        Self::new((self.x.clone() + &other.x).half(), (self.y.clone() + &other.y).half())
    }

    /// Both coordinates are finite.
    #[inline]
    pub fn is_finite(&self) -> bool {
        self.x.is_finite() && self.y.is_finite()
    }
}
